//! An axis: where a value stands between two ends. Values come in, places go out; those that an axis has no place for are left out
//! by whoever draws.

/// How values are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scaling {
    /// By themselves.
    Linear,
    /// By their logarithm; zero has no place.
    Logarithmic,
    /// By their logarithm; zero stands before the first decade, apart.
    WithZero,
}

/// The part of an axis that zero has for itself.
const APART: f64 = 0.09;

/// An axis: its ends as they are measured along it, and where they stand.
pub(crate) struct Scale {
    low: f64,
    high: f64,
    ends: [f64; 2],
    zero: Option<f64>,
    logarithmic: bool,
}

impl Scale {
    /// Over all values that have a place; to whole decades if `whole`. `None` if none has.
    pub(crate) fn over(
        values: impl Iterator<Item = f64>,
        ends: [f64; 2],
        whole: bool,
        scaling: Scaling,
    ) -> Option<Self> {
        let logarithmic = scaling != Scaling::Linear;
        let mut none = true;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| has_place(*value, scaling)) {
            none = false;
            if !logarithmic || value > 0.0 {
                let value = if logarithmic { value.log10() } else { value };
                (low, high) = (low.min(value), high.max(value));
            }
        }
        if none {
            return None;
        }
        // Zeros alone: a decade for the eye.
        let (low, high) = if low > high { (0.0, 1.0) } else { (low, high) };
        let (low, high) = if whole { (low.floor(), high.ceil()) } else { (low, high) };
        let high = if high > low { high } else { low + 1.0 };
        let [from, to] = ends;
        let (zero, from) = match scaling {
            Scaling::WithZero => (Some(from), from + APART * (to - from)),
            _ => (None, from),
        };
        Some(Self { low, high, ends: [from, to], zero, logarithmic })
    }

    /// The place of a value that has one.
    pub(crate) fn at(&self, value: f64) -> f64 {
        if let Some(zero) = self.zero.filter(|_| value <= 0.0) {
            return zero;
        }
        let value = if self.logarithmic { value.log10() } else { value };
        self.ends[0] + (value - self.low) / (self.high - self.low) * (self.ends[1] - self.ends[0])
    }

    /// Zero if it has a place, the decades, and 2 and 5 of each if there are few; of many every so many.
    pub(crate) fn ticks(&self) -> Vec<f64> {
        #[allow(clippy::cast_possible_truncation, reason = "few decades")]
        let (low, high) = (self.low.ceil() as i32, self.high.floor() as i32);
        let within: &[f64] = if high - low <= 2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let every = usize::try_from((high - low) / 10 + 1).unwrap_or(1);
        let powers = (low..=high).rev().step_by(every);
        let all = powers.flat_map(|power| within.iter().map(move |x| x * 10f64.powi(power)));
        let zero = self.zero.map(|_| 0.0);
        zero.into_iter().chain(all.filter(|value| value.log10() <= self.high + 1e-9)).collect()
    }
}

/// Whether a value stands anywhere on an axis.
pub(crate) fn has_place(value: f64, scaling: Scaling) -> bool {
    match scaling {
        Scaling::Linear => value.is_finite(),
        Scaling::Logarithmic => value > 0.0 && value.is_finite(),
        Scaling::WithZero => value >= 0.0 && value.is_finite(),
    }
}

#[cfg(test)]
mod tests {
    use super::{Scale, Scaling, has_place};

    #[test]
    fn zero_stands_apart_and_the_rest_by_its_logarithm() {
        let scale = Scale::over([0.0, 1.0, 100.0].into_iter(), [0.0, 100.0], true, Scaling::WithZero)
            .expect("values");
        let at = [0.0, 1.0, 10.0, 100.0].map(|value| scale.at(value).round());
        assert_eq!(at, [0.0, 9.0, 55.0, 100.0]);
        assert_eq!(scale.ticks().first(), Some(&0.0));
        assert!(!has_place(0.0, Scaling::Logarithmic) && has_place(0.0, Scaling::WithZero));
        assert!(Scale::over([0.0].into_iter(), [0.0, 1.0], true, Scaling::Logarithmic).is_none());
        let zeros = Scale::over([0.0].into_iter(), [0.0, 1.0], true, Scaling::WithZero).expect("zero");
        assert!(zeros.at(0.0) < zeros.at(1.0));
    }

    #[test]
    fn many_decades_have_few_ticks() {
        let scale =
            Scale::over([1e-30, 1e30].into_iter(), [0.0, 1.0], true, Scaling::Logarithmic).expect("values");
        assert!(scale.ticks().len() <= 12, "{:?}", scale.ticks());
    }
}
