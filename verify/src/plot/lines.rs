//! A chart of lines or of bare points: values over values, on axes of any scaling.
//!
//! In: series of points. Out: an `<svg>` element with a line, marks and a label for each series; nothing if no point has a place.
//! Labels that would cover each other are moved apart; of many series they stand in a list beside the chart.

use super::scale::{Scale, Scaling, has_place};
use super::{begin, line, words};
use std::fmt::Write;

/// Of one line.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    /// What stands at its end.
    pub(crate) label: String,
    /// Its class in the page's style.
    pub(crate) class: &'static str,
    /// From left to right.
    pub(crate) points: Vec<[f64; 2]>,
}

/// A line across the chart at a value of the horizontal axis.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    /// The value.
    pub(crate) at: f64,
    /// What it means.
    pub(crate) label: String,
}

/// Both axes: what they show, and how a value on them is written.
#[derive(Clone, Copy)]
pub(crate) struct Axes<'a> {
    /// Under the horizontal one.
    pub(crate) x: &'a str,
    /// Over the vertical one.
    pub(crate) y: &'a str,
    /// A value on the horizontal one.
    pub(crate) x_word: &'a dyn Fn(f64) -> String,
    /// A value on the vertical one.
    pub(crate) y_word: fn(f64) -> String,
    /// How the horizontal one is spread.
    pub(crate) x_scaling: Scaling,
    /// How the vertical one is.
    pub(crate) y_scaling: Scaling,
    /// Whether a series' points are joined by a line.
    pub(crate) joined: bool,
}

/// The picture, and the part of it that the axes enclose.
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 400.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 540.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 350.0;
/// Between the baselines of two labels.
const APART: f64 = 19.0;
/// Of more series labels stand in a list.
const MANY: usize = 6;
/// Places of points that are all named.
const FEW: usize = 14;

/// The chart; `title` is what it is called by those who do not see it.
#[must_use]
pub(crate) fn plot(title: &str, axes: Axes<'_>, series: &[Series], marks: &[Mark]) -> Option<String> {
    let placed = |[x, y]: &[f64; 2]| has_place(*x, axes.x_scaling) && has_place(*y, axes.y_scaling);
    let series: Vec<Series> = series
        .iter()
        .map(|s| Series { points: s.points.iter().copied().filter(placed).collect(), ..s.clone() })
        .filter(|s| !s.points.is_empty())
        .collect();
    let all = || series.iter().flat_map(|series| &series.points).copied();
    let marked = marks.iter().map(|mark| mark.at);
    let x = Scale::over(all().map(|[x, _]| x).chain(marked), [LEFT + 16.0, RIGHT], false, axes.x_scaling)?;
    let y = Scale::over(all().map(|[_, y]| y), [BOTTOM, TOP], true, axes.y_scaling)?;
    let mut svg = begin([WIDTH, HEIGHT], title);
    for value in y.ticks() {
        let at = y.at(value);
        line(&mut svg, "grid", [LEFT, at], [RIGHT, at]);
        words(&mut svg, "end", [LEFT - 8.0, at + 4.0], &(axes.y_word)(value));
    }
    let mut places: Vec<f64> = all().map(|[x, _]| x).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    if places.len() > FEW && axes.x_scaling != Scaling::Linear {
        places = x.ticks();
        places.sort_by(f64::total_cmp);
        places.retain(|value| (LEFT..=RIGHT).contains(&x.at(*value)));
    }
    let mut last = f64::NEG_INFINITY;
    for value in places {
        let at = x.at(value);
        line(&mut svg, "grid", [at, TOP], [at, BOTTOM]);
        // Where points stand close to each other not all can be named.
        if at - last > 64.0 {
            words(&mut svg, "middle", [at, BOTTOM + 18.0], &(axes.x_word)(value));
            last = at;
        }
    }
    for (k, mark) in (0_u32..).zip(marks) {
        let at = x.at(mark.at);
        line(&mut svg, "mark", [at, TOP], [at, BOTTOM]);
        // Beside the line, on the side that has more room, each below the last.
        let (anchor, beside) = if at > (LEFT + RIGHT) / 2.0 { ("end", -6.0) } else { ("start", 6.0) };
        words(&mut svg, anchor, [at + beside, TOP + 14.0 + APART * f64::from(k)], &mark.label);
    }
    words(&mut svg, "middle", [(LEFT + RIGHT) / 2.0, HEIGHT - 8.0], axes.x);
    words(&mut svg, "start", [8.0, 14.0], axes.y);
    for series in &series {
        let points: Vec<_> = series.points.iter().map(|p| [x.at(p[0]), y.at(p[1])]).collect();
        if axes.joined {
            let path: Vec<_> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
            _ = write!(svg, "<polyline class=\"{}\" points=\"{}\"/>", series.class, path.join(" "));
        }
        for [x, y] in points {
            _ = write!(svg, "<circle class=\"{}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>", series.class);
        }
    }
    if series.len() > MANY {
        for (k, series) in (0_u32..).zip(&series) {
            let at = TOP + 8.0 + APART * f64::from(k);
            if axes.joined {
                let ends = [format!("{:.1},{at:.1}", RIGHT + 10.0), format!("{:.1},{at:.1}", RIGHT + 34.0)];
                _ = write!(svg, "<polyline class=\"{}\" points=\"{}\"/>", series.class, ends.join(" "));
            }
            _ = write!(
                svg,
                "<circle class=\"{}\" cx=\"{:.1}\" cy=\"{at:.1}\" r=\"3.5\"/>",
                series.class,
                RIGHT + 22.0
            );
            words(&mut svg, "start", [RIGHT + 40.0, at + 4.0], &series.label);
        }
    } else {
        for (series, at) in series.iter().zip(apart(&series, &y)) {
            let end = series.points.last().map_or(RIGHT, |point| x.at(point[0]));
            words(&mut svg, "start", [end + 10.0, at + 4.0], &series.label);
        }
    }
    Some(svg + "</svg>")
}

/// Heights of the labels: those of the last points, moved where they are too near to each other, none below the axis.
fn apart(series: &[Series], y: &Scale) -> Vec<f64> {
    let mut places: Vec<(usize, f64)> =
        series.iter().map(|s| s.points.last().map_or(TOP, |point| y.at(point[1]))).enumerate().collect();
    places.sort_by(|one, other| one.1.total_cmp(&other.1));
    let mut last = f64::NEG_INFINITY;
    for (_, at) in &mut places {
        *at = at.max(last + APART);
        last = *at;
    }
    let mut next = BOTTOM + APART;
    for (_, at) in places.iter_mut().rev() {
        *at = at.min(next - APART);
        next = *at;
    }
    places.sort_by_key(|(k, _)| *k);
    places.into_iter().map(|(_, at)| at).collect()
}
