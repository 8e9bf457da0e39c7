//! A benchmark for the terminal: a line for each contestant that matters on each scene, then what holds over all scenes. Of
//! Embree's ways, and of plans picked by hand, the best is shown; the others are in the page and in the JSON file.

use super::contestant::Kind;
use super::data::{Bench, Curve, Growth, Row, SceneBench};
use crate::plot::short;
use crate::report::text::{clipped, style, wrapped};
use crate::report::word;
use crate::report::words::{NONE, count, duration, figure, sign};
use anstyle::Style;
use textwrap::core::display_width;

/// What choosing a plan from the scene alone may cost, in times of the best plan.
const PICKED: f64 = 1.15;

/// Heading of each column and the most it may take: with the spaces between them 100 columns.
const COLUMNS: [(&str, usize); 9] = [
    ("scene", 14),
    ("tracer", 26),
    ("verdict", 14),
    ("differ", 6),
    ("build", 8),
    ("trace", 8),
    ("± %", 4),
    ("Mray/s", 6),
    ("times", 6),
];
const VERDICT: usize = 2;
/// Columns from here on are numbers and stand to the right.
const FIRST_NUMBER: usize = 3;

type Cells = [String; COLUMNS.len()];

/// The benchmark as a table with its summary. `color` adds ANSI escapes to the verdicts.
#[must_use]
pub fn text(bench: &Bench, color: bool) -> String {
    let scenes = bench.scenes.iter();
    let rows: Vec<_> = scenes.flat_map(|scene| shown(scene).map(move |row| (scene, row))).collect();
    let cells: Vec<Cells> = rows.iter().map(|(scene, row)| cells(scene, row)).collect();
    let widths: [usize; COLUMNS.len()] = std::array::from_fn(|k| {
        let (heading, limit) = COLUMNS[k];
        let widest = cells.iter().map(|row| display_width(&row[k])).max().unwrap_or(0);
        widest.max(display_width(heading)).min(limit)
    });
    let mut text = line(&COLUMNS.map(|(heading, _)| heading.to_owned()), &widths, Style::new());
    for ((_, row), cells) in rows.iter().zip(&cells) {
        text += &line(cells, &widths, style(row.verdict, color));
    }
    for said in sentences(bench) {
        text += &(wrapped(&said) + "\n");
    }
    let verdict = bench.verdict();
    let shade = style(verdict, color);
    text + &format!("{shade}{} {}{shade:#}\n", sign(verdict), word(verdict))
}

/// All but those of Embree's ways, and of the plans picked by hand, that were not the best.
fn shown(scene: &SceneBench) -> impl Iterator<Item = &Row> {
    let is_best = |row: &Row, best: &Option<String>| best.is_none() || Some(&row.name) == best.as_ref();
    scene.contestants.iter().filter(move |row| match row.kind {
        Kind::Embree => is_best(row, &scene.embree_best),
        Kind::Picked => is_best(row, &scene.picked_best),
        Kind::Subject | Kind::Limit | Kind::Naive | Kind::Peer => true,
    })
}

fn cells(scene: &SceneBench, row: &Row) -> Cells {
    let or_none = |value: Option<String>| value.unwrap_or_else(|| NONE.to_owned());
    let own = scene.subject().and_then(Row::seconds);
    let times = row.seconds().zip(own).map(|(seconds, own)| figure(seconds / own));
    [
        scene.name.clone(),
        row.name.clone(),
        format!("{} {}", sign(row.verdict), word(row.verdict)),
        count(row.differing),
        or_none(row.timing.map(|t| duration(t.build.median))),
        or_none(row.timing.map(|t| duration(t.trace.median))),
        or_none(row.timing.map(|t| format!("{:.1}", 100.0 * t.total.relative()))),
        or_none(row.mega_rays_per_second.map(figure)),
        or_none(times),
    ]
}

fn line(row: &Cells, widths: &[usize; COLUMNS.len()], verdict: Style) -> String {
    let cell = |k: usize| {
        let shown = clipped(&row[k], widths[k]);
        let blank = " ".repeat(widths[k] - display_width(&shown));
        match k {
            VERDICT => format!("{verdict}{shown}{verdict:#}{blank}"),
            FIRST_NUMBER.. => blank + &shown,
            _ => shown + &blank,
        }
    };
    let line = (0..row.len()).map(cell).collect::<Vec<_>>().join(" ");
    format!("{}\n", line.trim_end())
}

/// What holds over all scenes, who was left out and why, and how times grew.
#[must_use]
pub fn sentences(bench: &Bench) -> Vec<String> {
    let mut said = Vec::new();
    let summary = bench.summary;
    if let (Some(mean), Some(least)) = (summary.ratio_to_embree_mean, summary.ratio_to_embree_least) {
        said.push(format!(
            "ratio to Embree: geometric mean {}, at least {}. Embree at {}, its best way on each scene, its build included.",
            figure(mean),
            figure(least),
            bench.level
        ));
    }
    if let (Some(mean), Some(most)) = (summary.ratio_to_limit_mean, summary.ratio_to_limit_most) {
        said.push(format!(
            "ratio to the limit: geometric mean {}, at most {}. The limit is the clairvoyant.",
            figure(mean),
            figure(most)
        ));
    }
    if let Some(most) = summary.ratio_to_picked_most {
        said.push(format!(
            "ratio to the best plan picked by hand: at most {}, where at most {} is wanted{}",
            figure(most),
            figure(PICKED),
            if most <= PICKED { "." } else { ": MISSED." }
        ));
    }
    for scene in &bench.scenes {
        let left_out = scene.contestants.iter().filter(|row| row.timing.is_none());
        said.extend(left_out.filter_map(|row| {
            row.remark.as_ref().map(|remark| format!("{} on {}: {remark}", row.name, scene.name))
        }));
    }
    said.extend(bench.curves.iter().flat_map(|curve: &Curve| curve.growth.iter().map(growth)));
    if let Some(held) = &bench.baseline {
        said.extend(held.steps.iter().map(|step| step.sentence(held.tolerance)));
        let missing = |scene: &String| {
            format!(
                "baseline, {scene}: not compared. It was not timed then, or not at this size, frame and threads."
            )
        };
        said.extend(held.missing.iter().map(missing));
    }
    said.extend(bench.absent.iter().map(|absent| format!("{}: not timed. {}", absent.judge, absent.why)));
    said
}

/// A growth as a sentence.
#[must_use]
pub fn growth(growth: &Growth) -> String {
    format!(
        "{} from {} to {}: {} times, {} {} is wanted{}",
        growth.what,
        short(growth.between[0]),
        short(growth.between[1]),
        figure(growth.factor),
        if growth.at_least { "at least" } else { "at most" },
        figure(growth.wanted),
        if growth.holds() { "." } else { ": MISSED." }
    )
}
