//! A stability run as a part of a page: where each method breaks in one table, then each sweep as a heat map and as curves.

use super::breakdown::WORDS;
use super::data::{Count, Curve, Line, Map, Stability};
use crate::methods::Family;
use crate::plot::heat::{Cell, Heat, heat, share};
use crate::plot::{Axes, Mark, STYLE, Scaling, Series, alone, plot, power};
use crate::report::chapter::Chapter;
use crate::report::words::{NONE, count};
use askama::Template;

#[derive(Template)]
#[template(path = "stability-part.html")]
struct Part<'a> {
    stability: &'a Stability,
    rays: String,
    breakdowns: Vec<Breakdowns>,
    curves: Vec<Shown>,
    relations: Vec<Shown>,
    maps: Vec<Shown>,
}

/// Where methods break over one thing.
struct Breakdowns {
    title: String,
    axis: String,
    headings: Vec<String>,
    rows: Vec<(String, Vec<String>)>,
}

/// A sweep or a map.
struct Shown {
    title: String,
    what: String,
    heat: Option<String>,
    lines: Option<String>,
}

/// The part, as it stands in a page that has the style of charts.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn part(stability: &Stability) -> Result<String, askama::Error> {
    let shown =
        |by_truth: bool| stability.curves.iter().filter(move |c| c.by_truth == by_truth).map(curve).collect();
    let part = Part {
        stability,
        rays: count(stability.rays),
        breakdowns: stability.curves.iter().map(breakdowns).collect(),
        curves: shown(true),
        relations: shown(false),
        maps: stability.maps.iter().map(map).collect(),
    };
    part.render()
}

/// A page of its own.
///
/// # Errors
/// As [`part`].
pub fn page(stability: &Stability) -> Result<String, askama::Error> {
    let heading = "Where methods break";
    Chapter::plain(
        heading,
        ("stability", stability.schema_version),
        &part(stability)?,
        &stability.environment,
    )
    .render()
}

/// Each curve and map as a file of its own: its name, and an SVG document.
#[must_use]
pub fn files(stability: &Stability) -> Vec<(String, String)> {
    let curves = stability.curves.iter().map(|c| (&c.name, curve(c).heat));
    let maps = stability.maps.iter().map(|m| (&m.name, map(m).heat));
    let drawn = curves.chain(maps).filter_map(|(name, svg)| Some((name, svg?)));
    drawn.map(|(name, svg)| (format!("{name}.svg"), alone(&svg, STYLE))).collect()
}

fn cell(count: &Count) -> Cell {
    match count.rate() {
        None => Cell::None,
        Some(rate) if count.refused > 0 => Cell::Partly(rate),
        Some(rate) => Cell::Rate(rate),
    }
}

fn breakdowns(curve: &Curve) -> Breakdowns {
    let both = curve.values.first() != Some(&curve.easy) && curve.values.last() != Some(&curve.easy);
    let backward = curve.values.last() == Some(&curve.easy);
    let ways: &[(bool, &str)] = match (both, backward) {
        (true, _) => &[(false, "below: "), (true, "above: ")],
        (false, true) => &[(false, "")],
        (false, false) => &[(true, "")],
    };
    // What cannot be seen with so few rays is not "never".
    let most = curve.lines.iter().flat_map(|line| &line.counts).map(|c| c.rays).max().unwrap_or(0);
    let seen = |limit: usize| limit != 1 || most >= 1_000_000;
    let word = |line: &Line, up: bool, limit: usize| {
        let value = if up { line.breakdown.up[limit] } else { line.breakdown.down[limit] };
        match value {
            _ if !seen(limit) => NONE.to_owned(),
            Some(value) => power(value),
            None => curve.never(line, up).into(),
        }
    };
    Breakdowns {
        title: curve.title.clone(),
        axis: curve.axis.clone(),
        headings: ways.iter().flat_map(|(_, way)| WORDS.map(|word| format!("{way}{word}"))).collect(),
        rows: curve
            .lines
            .iter()
            .map(|line| {
                let cells = ways.iter().flat_map(|(up, _)| [0, 1, 2, 3].map(|k| word(line, *up, k)));
                (line.method.clone(), cells.collect())
            })
            .collect(),
    }
}

fn curve(curve: &Curve) -> Shown {
    let first_beyond = |at: f64| {
        let descending = curve.values.first() > curve.values.last();
        curve.values.iter().position(|value| if descending { *value < at } else { *value > at })
    };
    let map = Heat {
        title: &format!("{}: wrong rays of each method", curve.title),
        x: &curve.axis,
        rows: curve.lines.iter().map(|line| line.method.clone()).collect(),
        columns: curve.values.iter().map(|value| power(*value)).collect(),
        cells: curve.lines.iter().map(|line| line.counts.iter().map(cell).collect()).collect(),
        marks: curve.marks.iter().filter_map(|(at, what)| Some((first_beyond(*at)?, what.clone()))).collect(),
        row_marks: Vec::new(),
    };
    // Lines of what can be told apart: one method of each family, and the exact one.
    let mut met: Vec<Family> = Vec::new();
    let mut drawn: Vec<Series> = Vec::new();
    for line in &curve.lines {
        if met.contains(&line.family) && line.family != Family::Spu {
            continue;
        }
        met.push(line.family);
        let points = curve.values.iter().zip(&line.counts);
        let points = points.filter_map(|(value, count)| Some([*value, count.rate()?])).collect();
        drawn.push(Series { label: line.method.clone(), class: line.family.class(), points });
    }
    let linear = curve.values.iter().any(|value| *value <= 0.0);
    let axes = Axes {
        x: &curve.axis,
        y: if curve.by_truth { "wrong rays" } else { "rays that changed" },
        x_word: &power,
        y_word: share,
        x_scaling: if linear { Scaling::Linear } else { Scaling::Logarithmic },
        y_scaling: Scaling::WithZero,
        joined: true,
    };
    let marks: Vec<Mark> =
        curve.marks.iter().map(|(at, what)| Mark { at: *at, label: what.clone() }).collect();
    Shown {
        title: curve.title.clone(),
        what: curve.what.clone(),
        heat: heat(&map),
        lines: plot(&format!("{}: wrong rays over {}", curve.title, curve.axis), axes, &drawn, &marks),
    }
}

fn map(map: &Map) -> Shown {
    let shown = Heat {
        title: &map.title,
        x: &map.axis,
        rows: map.rows.clone(),
        columns: map.columns.clone(),
        cells: map.counts.iter().map(|row| row.iter().map(cell).collect()).collect(),
        marks: map.marks.clone(),
        row_marks: map.row_marks.clone(),
    };
    Shown { title: map.title.clone(), what: map.what.clone(), heat: heat(&shown), lines: None }
}
