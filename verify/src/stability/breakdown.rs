//! From where on a method breaks: the first value at which it is wrong at all, then once in a million rays, in a thousand, in a hundred.

use serde::Serialize;

/// How often, in order: at all, once in 10⁶, once in 10³, once in 10².
pub const LIMITS: [f64; 4] = [0.0, 1e-6, 1e-3, 1e-2];
/// In words.
pub const WORDS: [&str; 4] = ["first wrong", "1 in 10⁶", "1 in 10³", "1 in 100"];

/// Values at which each of [`LIMITS`] is reached first, away from the easy value; none if never.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Breakdown {
    /// Toward the axis's end.
    pub up: [Option<f64>; 4],
    /// Toward its beginning.
    pub down: [Option<f64>; 4],
}

/// Of rates along an axis; `None` where nothing was measured, which breaks nothing. The easy value itself belongs to both ways.
#[must_use]
pub fn breakdown(values: &[f64], rates: &[Option<f64>], easy: f64) -> Breakdown {
    let from = nearest(values, easy);
    let reached = |order: &mut dyn Iterator<Item = usize>| {
        let mut found = [None; 4];
        for k in order {
            let Some(rate) = rates.get(k).copied().flatten() else { continue };
            for (found, limit) in found.iter_mut().zip(LIMITS) {
                if found.is_none() && rate > 0.0 && rate >= limit {
                    *found = Some(values[k]);
                }
            }
        }
        found
    };
    Breakdown { up: reached(&mut (from..values.len())), down: reached(&mut (0..=from).rev()) }
}

/// Where on an axis the value is that is nearest to the easy one.
#[must_use]
pub fn nearest(values: &[f64], easy: f64) -> usize {
    let near = |value: &f64| (value.ln() - easy.ln()).abs();
    let linear = |value: &f64| (value - easy).abs();
    let logarithmic = easy > 0.0 && values.iter().all(|value| *value > 0.0);
    (0..values.len())
        .min_by(|i, j| {
            let of = |k: &usize| if logarithmic { near(&values[*k]) } else { linear(&values[*k]) };
            of(i).total_cmp(&of(j))
        })
        .unwrap_or(0)
}
