//! How verdicts, counts and measures are put into words, the same in the page and on the terminal.
//! Values come in, short texts go out. A figure that was not taken is a dash, never a zero.

use crate::verdict::Verdict;

/// Stands where there is no figure.
pub(crate) const NONE: &str = "–";

/// All verdicts, from good to bad.
pub(crate) const VERDICTS: [Verdict; 5] =
    [Verdict::Equal, Verdict::WithinBound, Verdict::Undecidable, Verdict::Wrong, Verdict::NotJudged];

/// The verdict as a word.
#[must_use]
pub fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Equal => "equal",
        Verdict::WithinBound => "within bound",
        Verdict::Undecidable => "undecidable",
        Verdict::Wrong => "wrong",
        Verdict::NotJudged => "not judged",
    }
}

/// The verdict as one sign, for those who do not see its colour.
pub(crate) fn sign(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Equal => "=",
        Verdict::WithinBound => "≈",
        Verdict::Undecidable => "?",
        Verdict::Wrong => "≠",
        Verdict::NotJudged => "–",
    }
}

/// From whom a run has its verdict.
#[derive(Clone, Copy)]
pub(crate) enum Whose {
    Subject,
    Witness,
    Chapter,
}

/// What the verdict means for a whole run.
pub(crate) fn sentence(verdict: Verdict, whose: Whose) -> &'static str {
    match (verdict, whose) {
        (Verdict::NotJudged, _) => "Something here was not compared. That is no pass.",
        (Verdict::Equal, _) => "Every picture has the bits of the exact one.",
        (Verdict::Wrong, Whose::Chapter) => "A promise is broken, which is told below.",
        (Verdict::Wrong, Whose::Witness) => {
            "An outside judge and the exact picture differ beyond what the judge's rounding explains."
        }
        (Verdict::Undecidable, Whose::Witness) => {
            "Some rays lie outside what an outside judge states anything about."
        }
        (Verdict::WithinBound, Whose::Witness) => {
            "Every picture has the bits of the exact one, and where an outside judge differs, its rounding cannot decide."
        }
        (Verdict::WithinBound, _) => {
            "Every difference lies where the subject's stated arithmetic cannot decide."
        }
        (Verdict::Undecidable, _) => "Some pixels lie outside what a subject states anything about.",
        (Verdict::Wrong, Whose::Subject) => {
            "At least one pixel is wrong beyond what its subject's arithmetic explains."
        }
    }
}

/// A count with its thousands apart: 1 234 567, the spaces narrow and unbreakable.
pub(crate) fn count(value: impl Into<u64>) -> String {
    let digits = value.into().to_string();
    let groups: Vec<_> = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    groups.join("\u{202f}")
}

/// Three digits that matter, without an exponent where it reads well.
pub(crate) fn figure(value: f64) -> String {
    match value.abs() {
        size if !size.is_finite() => value.to_string(),
        size if size >= 1e6 || (size > 0.0 && size < 1e-4) => format!("{value:.2e}"),
        size if size >= 100.0 || size == 0.0 => format!("{value:.0}"),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 1.0 => format!("{value:.2}"),
        size if size >= 0.1 => format!("{value:.3}"),
        _ => format!("{value:.5}"),
    }
}

/// Seconds in the unit that fits.
pub(crate) fn duration(seconds: f64) -> String {
    match seconds {
        s if s >= 1.0 => format!("{} s", figure(s)),
        s if s >= 1e-3 => format!("{} ms", figure(s * 1e3)),
        s => format!("{} µs", figure(s * 1e6)),
    }
}

/// Millions of rays a second.
pub(crate) fn mega_rays(rays_per_second: Option<f64>) -> String {
    rays_per_second.map_or_else(|| NONE.to_owned(), |rays| figure(rays / 1e6))
}

/// So many of so many, in a million; none of none is none.
#[allow(clippy::cast_precision_loss, reason = "a picture has at most 2^27 pixels")]
pub(crate) fn per_million(wrong: u64, pixels: u64) -> f64 {
    if wrong == 0 { 0.0 } else { wrong as f64 * 1e6 / pixels as f64 }
}
