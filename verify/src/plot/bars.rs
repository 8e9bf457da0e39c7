//! Bars from left to right on a logarithmic axis, each with its words and its number.
//!
//! In: words and counts. Out: an `<svg>` element; a count of zero has no bar.

use super::scale::{Scale, Scaling};
use super::{begin, line, power, words};
use crate::report::words::count;
use std::fmt::Write;

const WIDTH: f64 = 720.0;
const LEFT: f64 = 390.0;
const RIGHT: f64 = 630.0;
const TOP: f64 = 30.0;
const ROW: f64 = 20.0;

/// The chart; `title` is what it is called by those who do not see it, `x` stands under the axis.
pub(crate) fn bars(title: &str, x: &str, rows: &[(String, u64)]) -> String {
    let bottom = TOP + ROW * rows.len() as f64;
    let mut svg = begin([WIDTH, bottom + 50.0], title);
    let values = rows.iter().map(|(_, n)| *n as f64).chain([1.0]);
    let Some(scale) = Scale::over(values, [LEFT, RIGHT], true, Scaling::Logarithmic) else {
        return String::new();
    };
    let ticks = scale.ticks();
    // Of many decades every other one, so that their numbers stand apart.
    let every = 1 + ticks.len() / 8;
    for (k, tick) in ticks.into_iter().enumerate() {
        line(&mut svg, "grid", [scale.at(tick), TOP - 6.0], [scale.at(tick), bottom]);
        if k % every == 0 {
            words(&mut svg, "middle", [scale.at(tick), bottom + 18.0], &power(tick));
        }
    }
    words(&mut svg, "middle", [(LEFT + RIGHT) / 2.0, bottom + 40.0], x);
    for (k, (word, n)) in rows.iter().enumerate() {
        let y = TOP + ROW * k as f64;
        words(&mut svg, "end", [LEFT - 10.0, y + 12.0], word);
        if *n > 0 {
            let end = scale.at(*n as f64).max(LEFT + 2.0);
            _ = write!(
                svg,
                "<rect class=\"bar\" x=\"{LEFT:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"14\"/>",
                end - LEFT
            );
            words(&mut svg, "start", [end + 6.0, y + 12.0], &count(*n));
        } else {
            words(&mut svg, "start", [LEFT + 6.0, y + 12.0], "0");
        }
    }
    svg + "</svg>"
}
