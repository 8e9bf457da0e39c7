//! What a judge says of a subject: plain data that the report writes and the command prints.
//! How it is found out stands in `judge`.

use serde::Serialize;

/// The word a judgement ends in, from good to bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Verdict {
    /// Ids, t and colours are those of the judge, bit for bit.
    Equal,
    /// There are differences, and each lies where the subject's stated arithmetic cannot decide.
    WithinBound,
    /// Some pixels lie outside the range for which the subject states anything; the others agree.
    Undecidable,
    /// At least one pixel is wrong beyond what the subject's arithmetic explains.
    Wrong,
    /// Nothing was compared, and why is said beside it. Never a pass.
    NotJudged,
}

impl Verdict {
    /// The worst of many, of which a wrong one is worse than one that nobody judged; of none that of none.
    #[must_use]
    pub fn worst_of(verdicts: impl IntoIterator<Item = Self>) -> Self {
        let badness = |verdict: &Self| match verdict {
            Self::Equal => 0,
            Self::WithinBound => 1,
            Self::Undecidable => 2,
            Self::NotJudged => 3,
            Self::Wrong => 4,
        };
        verdicts.into_iter().max_by_key(badness).unwrap_or(Self::NotJudged)
    }
}

/// A subject's picture held against the truth, pixel by pixel.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Comparison {
    /// Pixels compared.
    pub pixels: u64,
    /// Pixels where the truth is a hit.
    pub hits: u64,
    /// Pixels with a wrong id: `missing + extra + swapped`.
    pub wrong_ids: u64,
    /// The truth hits, the subject does not.
    pub missing: u64,
    /// The subject hits, the truth does not.
    pub extra: u64,
    /// Both hit, different spheres.
    pub swapped: u64,
    /// Pixels with the right id whose t has other bits than the truth's.
    pub wrong_t: u64,
    /// Error of t in units in the last place of the truth, over pixels where both hit the same sphere.
    pub t_ulp: UlpSummary,
    /// Pixels whose colour differs.
    pub wrong_color: u64,
    /// Largest difference of one colour channel, 0 to 255.
    pub color_max: u8,
    /// Column and row of the first pixel, in row order, with a wrong id; failing that with a wrong t;
    /// failing that with a wrong colour. Where some pixels are unexplained, of these alone; where a promise to be the naive picture is
    /// broken, the first that differs from that.
    pub first_wrong: Option<[u32; 2]>,
    /// Wrong pixels that the subject's stated error bound does not explain.
    pub unexplained: u64,
    /// Wrong pixels for which the subject's bound states nothing (over- or underflow on the way).
    pub undecidable: u64,
}

/// How far apart two sets of t are, in units in the last place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct UlpSummary {
    /// How many t were compared.
    pub count: u64,
    /// Half of them are at most this far off.
    pub median: u64,
    /// 99 in 100 are at most this far off.
    pub p99: u64,
    /// The farthest.
    pub max: u64,
}
