//! Where the marks of the charts stand: wrong pixels per million on a logarithmic axis that has a place for zero,
//! left of the decades and apart from them, and speed on a linear axis from zero. The subjects of one scene come
//! in, positions in percent of the width go out; the template draws them as inline SVG.

use super::SubjectReport;
use super::words::{figure, per_million};
use crate::plot::superscript;

/// Where zero stands, and where the decades begin and end, in percent.
const ZERO: f64 = 3.0;
const DECADES: (f64, f64) = (14.0, 96.0);
/// All pixels wrong is 10^6 in a million.
const TOP: i32 = 6;

/// The charts of one scene.
pub(super) struct Chart {
    pub(super) ticks: Vec<Tick>,
    pub(super) bars: Vec<Bar>,
    /// From where to where the decades' line is drawn.
    pub(super) base: [String; 2],
}

/// A line across the axis, and its label.
pub(super) struct Tick {
    pub(super) at: String,
    pub(super) label: String,
}

/// One subject's marks.
pub(super) struct Bar {
    /// Wrong ids, t and colours; none if nothing was compared.
    pub(super) wrong: Option<[Mark; 3]>,
    /// Width of the speed bar in percent.
    pub(super) speed: Option<String>,
}

/// A place on the axis and the number it stands for.
pub(super) struct Mark {
    pub(super) at: String,
    pub(super) per_million: String,
}

impl Chart {
    pub(super) fn new(subjects: &[SubjectReport]) -> Self {
        let compared = subjects.iter().filter_map(|subject| subject.comparison.as_ref());
        let lowest = lowest_decade(compared.map(|c| c.pixels).max().unwrap_or(0));
        let fastest = subjects.iter().filter_map(|subject| subject.rays_per_second).fold(0.0, f64::max);
        let bar = |subject: &SubjectReport| Bar {
            wrong: subject.comparison.as_ref().map(|c| {
                [c.wrong_ids, c.wrong_t, c.wrong_color]
                    .map(|wrong| Mark::new(per_million(wrong, c.pixels), lowest))
            }),
            speed: subject.rays_per_second.map(|rays| percent(100.0 * rays / fastest.max(1.0))),
        };
        let decades = (lowest..=TOP).map(|power| Tick {
            at: percent(place(10_f64.powi(power), lowest)),
            label: match power {
                0 => "1".to_owned(),
                1 => "10".to_owned(),
                _ => format!("10{}", superscript(&power.to_string())),
            },
        });
        let zero = Tick { at: percent(ZERO), label: "0".to_owned() };
        Self {
            ticks: std::iter::once(zero).chain(decades).collect(),
            bars: subjects.iter().map(bar).collect(),
            base: [percent(DECADES.0), percent(DECADES.1)],
        }
    }
}

impl Mark {
    fn new(per_million: f64, lowest: i32) -> Self {
        Self { at: percent(place(per_million, lowest)), per_million: figure(per_million) }
    }
}

/// The power of ten at or below one wrong pixel among all.
fn lowest_decade(pixels: u64) -> i32 {
    let one = per_million(1, pixels.max(1));
    (-3..TOP).rev().find(|power| 10_f64.powi(*power) <= one).unwrap_or(-3)
}

fn place(per_million: f64, lowest: i32) -> f64 {
    if per_million <= 0.0 {
        return ZERO;
    }
    let (first, last) = DECADES;
    let along = (per_million.log10() - f64::from(lowest)) / f64::from(TOP - lowest);
    first + along.clamp(0.0, 1.0) * (last - first)
}

fn percent(value: f64) -> String {
    format!("{value:.2}%")
}
