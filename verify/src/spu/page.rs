//! A run of `cgt spu` as one HTML page that needs nothing but itself: curves, and each scene's table.

use super::curves::Curve;
use super::data::Report;
use super::survey::Survey;
use super::text::text;
use crate::plot::{Axes, Scaling, Series, plot, short};
use crate::report::chapter::Chapter;
use crate::report::words::figure;
use askama::Template;

#[derive(Template)]
#[template(path = "spu-part.html")]
struct Part<'a> {
    curves: Vec<(String, Vec<Chart>)>,
    scenes: Vec<(&'a str, String)>,
    host: Option<String>,
}

struct Chart {
    title: String,
    svg: String,
}

/// The page.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn page(report: &Report) -> Result<String, askama::Error> {
    let rate = report.surveys.first().map_or_else(String::new, |survey| {
        let [least, most] = survey.rates[super::predict::Policy::Hinted as usize].frames_per_second;
        format!("{} to {}", figure(least), figure(most))
    });
    let host = report.host.as_ref().map(ToString::to_string);
    let of = report.surveys.first().map_or_else(String::new, |survey| {
        format!(", {}, {} × {} pixels", survey.scene, survey.size[0], survey.size[1])
    });
    Chapter {
        over: "A frame on six SPUs at 3.2 GHz",
        sign: "",
        heading: &rate,
        class: "equal",
        lead: &format!("frames a second{of}. The least is the machine in the order as written, the most perfect scheduling; both with every loop hinted."),
        body: &part(&report.surveys, &report.curves, host)?,
        environment: &report.environment,
        beside: format!("The same data, to be read by programs: spu.json, schema {}.", report.schema_version),
    }
    .render()
}

/// Curves and surveys as a part of a page that has the style of charts.
///
/// # Errors
/// As [`page`].
pub fn part(surveys: &[Survey], curves: &[Curve], host: Option<String>) -> Result<String, askama::Error> {
    let part = Part {
        curves: curves.iter().map(|curve| (title(curve), charts(curve))).collect(),
        scenes: surveys.iter().map(|survey| (survey.scene.as_str(), text(survey))).collect(),
        host,
    };
    part.render()
}

fn title(curve: &Curve) -> String {
    match curve.over {
        "spheres" => format!("Over scene size: {}", curve.of),
        _ => format!("Over grid size: {}", curve.of),
    }
}

/// Classes of the page's style, one for each line of a chart.
const CLASSES: [&str; 7] = ["l0", "l1", "l2", "l3", "l4", "l5", "l6"];

/// A line's figure at a point, if it has one.
type Figure<'a> = Box<dyn Fn(&Survey) -> Option<f64> + 'a>;

fn chart(curve: &Curve, title: &str, y: &'static str, lines: Vec<(String, Figure<'_>)>) -> Option<Chart> {
    // A logarithmic axis has no place for zero.
    let series: Vec<_> = lines
        .into_iter()
        .zip(CLASSES)
        .map(|((label, of), class)| {
            let place =
                |point: &super::curves::Point| Some([point.x, of(&point.survey).filter(|y| *y > 0.0)?]);
            Series { label, class, points: curve.points.iter().filter_map(place).collect() }
        })
        .filter(|series: &Series| !series.points.is_empty())
        .collect();
    let x = if curve.over == "spheres" { "spheres" } else { "cells on an axis" };
    let scaling = Scaling::Logarithmic;
    let axes =
        Axes { x, y, x_word: &short, y_word: figure, x_scaling: scaling, y_scaling: scaling, joined: true };
    Some(Chart { title: title.into(), svg: plot(title, axes, &series, &[])? })
}

fn charts(curve: &Curve) -> Vec<Chart> {
    let hinted = super::predict::Policy::Hinted as usize;
    let Some(first) = curve.points.first() else { return Vec::new() };
    let stages = first.survey.rates[hinted].stages.iter().enumerate().map(|(k, stage)| {
        let of: Figure<'_> = Box::new(move |s: &Survey| Some(s.rates[hinted].stages[k].per_ray[1]));
        (stage.stage.to_owned(), of)
    });
    let rates = ["least", "most"].into_iter().zip(0..).map(|(label, bound): (_, usize)| {
        let of: Figure<'_> = Box::new(move |s: &Survey| Some(s.rates[hinted].frames_per_second[bound]));
        (label.to_owned(), of)
    });
    let loops = first.survey.loops.iter().enumerate().flat_map(|(k, kind)| {
        [0, hinted].map(|policy| {
            let label = format!("{}, {}", kind.walk, kind.policies[policy].policy);
            let of: Figure<'_> = Box::new(move |s: &Survey| s.loops[k].policies[policy].per_traversal);
            (label, of)
        })
    });
    let loops: Vec<_> = loops.collect();
    let by_cell = first.survey.loops.iter().enumerate().flat_map(|(k, kind)| {
        [0, hinted].map(|policy| {
            let label = format!("{}, {}", kind.walk, kind.policies[policy].policy);
            let of: Figure<'_> = Box::new(move |s: &Survey| s.loops[k].policies[policy].per_cell);
            (label, of)
        })
    });
    let part = |part: u64, of: u64| (of > 0).then(|| 100.0 * part as f64 / of as f64);
    let shares: Vec<(String, Figure<'_>)> = vec![
        ("repeats".into(), Box::new(move |s| part(s.mailbox.repeats, s.mailbox.fetched))),
        ("saved by a mailbox".into(), Box::new(|s| Some(100.0 * s.mailbox.saved[0]))),
        ("false positives".into(), Box::new(move |s| part(s.lists.false_positives, s.lists.ids))),
        ("dropped".into(), Box::new(move |s| part(s.lists.dropped, s.lists.ids))),
        ("wrong pixels".into(), Box::new(move |s| part(s.picture.wrong, s.picture.hits))),
    ];
    let tests: Vec<(String, Figure<'_>)> = vec![("factor".into(), Box::new(|s| s.culling.factor))];
    let all = [
        chart(curve, "Cycles a ray by stage, hinted, dependence bound", "cycles a ray", stages.collect()),
        chart(curve, "Frames a second on six SPUs, hinted", "frames a second", rates.collect()),
        chart(curve, "Mispredicts of the loop in a traversal", "mispredicts", loops),
        chart(curve, "Mispredicts of the loop by cells", "mispredicts", by_cell.collect()),
        chart(curve, "Tests without culling by tests with", "times", tests),
        chart(
            curve,
            "Repeats of fetched spheres; what a mailbox saves of tracing; of listed ids false positives and dropped; of hits wrong pixels (none has no place)",
            "per cent",
            shares,
        ),
    ];
    all.into_iter().flatten().collect()
}
