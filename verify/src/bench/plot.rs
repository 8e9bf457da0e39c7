//! A chart of lines as SVG: times against sizes on logarithmic axes, or speeds scene by scene.
//!
//! In: series of points above zero. Out: an `<svg>` element that takes its colours from the page, with a line, marks and a
//! label for each series; nothing for no points. Labels that would cover each other are moved apart.

use crate::report::words::figure;
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

/// Both axes: what they show, and how a value on them is written.
#[derive(Clone, Copy)]
pub(crate) struct Axes<'a> {
    /// Under the horizontal one.
    pub(crate) x: &'static str,
    /// Over the vertical one.
    pub(crate) y: &'static str,
    /// A value on the horizontal one.
    pub(crate) x_word: &'a dyn Fn(f64) -> String,
    /// A value on the vertical one.
    pub(crate) y_word: fn(f64) -> String,
    /// Whether the horizontal one is logarithmic, as the vertical one always is.
    pub(crate) logarithmic: bool,
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

/// The chart; `title` is what it is called by those who do not see it.
#[must_use]
pub(crate) fn plot(title: &str, axes: Axes<'_>, series: &[Series]) -> Option<String> {
    let all = || series.iter().flat_map(|series| &series.points).copied();
    let x = Scale::over(all().map(|[x, _]| x), [LEFT + 16.0, RIGHT], false, axes.logarithmic)?;
    let y = Scale::over(all().map(|[_, y]| y), [BOTTOM, TOP], true, true)?;
    let mut svg = format!(
        "<svg class=\"plot\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{}\">",
        escaped(title)
    );
    for value in y.ticks() {
        let at = y.at(value);
        line(&mut svg, "grid", [LEFT, at], [RIGHT, at]);
        words(&mut svg, "end", [LEFT - 8.0, at + 4.0], &(axes.y_word)(value));
    }
    let mut places: Vec<f64> = all().map(|[x, _]| x).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
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
    words(&mut svg, "middle", [(LEFT + RIGHT) / 2.0, HEIGHT - 8.0], axes.x);
    words(&mut svg, "start", [8.0, 14.0], axes.y);
    for series in series {
        let points: Vec<_> = series.points.iter().map(|p| [x.at(p[0]), y.at(p[1])]).collect();
        if axes.joined {
            let path: Vec<_> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
            _ = write!(svg, "<polyline class=\"{}\" points=\"{}\"/>", series.class, path.join(" "));
        }
        for [x, y] in points {
            _ = write!(svg, "<circle class=\"{}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>", series.class);
        }
    }
    for (series, at) in series.iter().zip(apart(series, &y)) {
        let end = series.points.last().map_or(RIGHT, |point| x.at(point[0]));
        words(&mut svg, "start", [end + 10.0, at + 4.0], &series.label);
    }
    Some(svg + "</svg>")
}

/// Heights of the labels: those of the last points, moved down where they are too near to the one above.
fn apart(series: &[Series], y: &Scale) -> Vec<f64> {
    let mut places: Vec<(usize, f64)> =
        series.iter().map(|s| s.points.last().map_or(TOP, |point| y.at(point[1]))).enumerate().collect();
    places.sort_by(|one, other| one.1.total_cmp(&other.1));
    let mut last = f64::NEG_INFINITY;
    for (_, at) in &mut places {
        *at = at.max(last + APART);
        last = *at;
    }
    places.sort_by_key(|(k, _)| *k);
    places.into_iter().map(|(_, at)| at).collect()
}

/// An axis: its ends as they are measured along it, and where they stand.
struct Scale {
    low: f64,
    high: f64,
    ends: [f64; 2],
    logarithmic: bool,
}

impl Scale {
    /// Over all values; to whole decades if `whole`.
    fn over(
        values: impl Iterator<Item = f64>,
        ends: [f64; 2],
        whole: bool,
        logarithmic: bool,
    ) -> Option<Self> {
        let values = values.filter(|value| *value > 0.0 && value.is_finite());
        let values = values.map(|value| if logarithmic { value.log10() } else { value });
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        if low > high {
            return None;
        }
        let (low, high) = if whole { (low.floor(), high.ceil()) } else { (low, high) };
        let high = if high > low { high } else { low + 1.0 };
        Some(Self { low, high, ends, logarithmic })
    }

    fn at(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.log10() } else { value };
        self.ends[0] + (value - self.low) / (self.high - self.low) * (self.ends[1] - self.ends[0])
    }

    /// The decades, and 2 and 5 of each if there are few.
    fn ticks(&self) -> Vec<f64> {
        #[allow(clippy::cast_possible_truncation, reason = "few decades")]
        let (low, high) = (self.low.round() as i32, self.high.round() as i32);
        let within: &[f64] = if high - low <= 2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let all = (low..=high).flat_map(|power| within.iter().map(move |x| x * 10f64.powi(power)));
        all.filter(|value| value.log10() <= self.high + 1e-9).collect()
    }
}

fn line(svg: &mut String, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
    _ = write!(svg, "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>");
}

fn words(svg: &mut String, anchor: &str, [x, y]: [f64; 2], text: &str) {
    _ = write!(svg, "<text text-anchor=\"{anchor}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escaped(text));
}

/// Text as it may stand in an element or an attribute.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A large number in few digits: 100, 10 k, 3.69 M.
#[must_use]
pub(crate) fn short(value: f64) -> String {
    match value {
        v if v >= 1e6 => format!("{} M", trimmed(v / 1e6)),
        v if v >= 1e4 => format!("{} k", trimmed(v / 1e3)),
        v => trimmed(v),
    }
}

/// Three digits without zeros behind the point.
fn trimmed(value: f64) -> String {
    let text = figure(value);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
