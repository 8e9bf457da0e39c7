//! How a set of times is told: its median, and how far it spreads.

use serde::{Deserialize, Serialize};

/// Of a set of times, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Spread {
    pub median: f64,
    pub lower_quartile: f64,
    pub upper_quartile: f64,
    pub least: f64,
    pub most: f64,
}

impl Spread {
    /// Of at least one time; of none all is 0.
    #[must_use]
    pub fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        let at = |part: f64| quantile(&times, part);
        Self {
            median: at(0.5),
            lower_quartile: at(0.25),
            upper_quartile: at(0.75),
            least: at(0.0),
            most: at(1.0),
        }
    }

    /// Half the way between the quartiles, in parts of the median.
    #[must_use]
    pub fn relative(&self) -> f64 {
        (self.upper_quartile - self.lower_quartile) / 2.0 / self.median
    }
}

/// Between the two of an ordered set that are nearest to the place asked for.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place within the set")]
fn quantile(ordered: &[f64], part: f64) -> f64 {
    let Some(last) = ordered.len().checked_sub(1) else { return 0.0 };
    let place = part * last as f64;
    let below = place as usize;
    let above = (below + 1).min(last);
    ordered[below] + (place - below as f64) * (ordered[above] - ordered[below])
}

/// The geometric mean; nothing of none.
#[must_use]
pub fn geometric_mean(values: &[f64]) -> Option<f64> {
    let logarithms: f64 = values.iter().map(|value| value.ln()).sum();
    (!values.is_empty()).then(|| (logarithms / values.len() as f64).exp())
}
