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
    let near = |value: &f64| (value.ln() - easy.ln()).abs();
    let linear = |value: &f64| (value - easy).abs();
    let logarithmic = easy > 0.0 && values.iter().all(|value| *value > 0.0);
    let from = (0..values.len())
        .min_by(|i, j| {
            let of = |k: &usize| if logarithmic { near(&values[*k]) } else { linear(&values[*k]) };
            of(i).total_cmp(&of(j))
        })
        .unwrap_or(0);
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

#[cfg(test)]
mod tests {
    use super::breakdown;

    #[test]
    fn it_is_looked_for_away_from_the_easy_value() {
        let values = [0.01, 0.1, 1.0, 10.0, 100.0];
        let rates = [Some(0.5), Some(0.0), Some(0.0), Some(1e-5), Some(0.02)];
        let found = breakdown(&values, &rates, 1.0);
        assert_eq!(found.up, [Some(10.0), Some(10.0), Some(100.0), Some(100.0)]);
        assert_eq!(found.down, [Some(0.01); 4]);
        let unknown = breakdown(&values, &[None, None, Some(0.0), None, None], 1.0);
        assert_eq!((unknown.up, unknown.down), ([None; 4], [None; 4]));
    }

    #[test]
    fn an_easy_value_that_fails_breaks_both_ways() {
        let found = breakdown(&[1.0, 2.0], &[Some(1.0), Some(0.0)], 1.0);
        assert_eq!((found.up[3], found.down[3]), (Some(1.0), Some(1.0)));
    }
}
