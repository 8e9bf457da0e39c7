//! Which method for which scene: what a run's own chart and maps say of each method, in sentences. Nothing here is known beforehand; a method
//! that fails somewhere new is told so by the next run.

use crate::chart::{Chart, Point};
use crate::methods::Family;
use crate::plot::power;
use crate::report::words::figure;
use crate::stability::Stability;
use crate::stability::data::{Count, Curve};
use askama::Template;
use serde::Serialize;

/// What is said of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// What it is called here.
    pub method: String,
    /// Whether it showed the right sphere everywhere, and was asked.
    pub never_wrong: bool,
    /// Fewer than one ray in [`OFTEN`] is wrong as long as all of these hold.
    pub holds_within: Vec<String>,
    /// Nanoseconds a ray on each scene from near.
    pub costs: Vec<(String, f64)>,
    /// Whether to take it.
    pub word: String,
}

/// One ray in so many that is wrong is too often.
pub const OFTEN: f64 = 1000.0;

/// What it is called, its name in the maps, and its name in the chart.
const ASKED: [(&str, &str, &str); 6] = [
    ("fast (exact)", "fast", "fast"),
    ("perpendicular form in f32 (safe)", "safe", "safe"),
    ("textbook form in f32", "naive-f32-textbook", "safe-textbook"),
    ("textbook form, as the SPU cuts it off", "safe-spu-textbook", "safe-spu-textbook"),
    ("textbook form in f64, no grid", "naive-f64", "naive-f64"),
    ("the paper's plan", "paper", "paper"),
];

/// Of each method that was asked, and of the outsiders that were there.
#[must_use]
pub fn advice(stability: &Stability, chart: &Chart) -> Vec<Advice> {
    let mut asked: Vec<(String, String, String)> =
        ASKED.map(|(a, b, c)| (a.to_owned(), b.to_owned(), c.to_owned())).into();
    if let Some(curve) = stability.curves.first() {
        let outsiders = curve.lines.iter().filter(|line| match line.family {
            Family::Embree => line.method.starts_with("embree-16"),
            family => matches!(family, Family::Peer | Family::Foreign),
        });
        let names = outsiders.map(|line| line.method.clone());
        asked.extend(names.map(|name| (name.clone(), name.clone(), name)));
    }
    let mut all: Vec<Advice> = asked
        .into_iter()
        .filter(|(_, mapped, _)| stability.curves.iter().any(|curve| curve.line(mapped).is_some()))
        .map(|(method, mapped, charted)| Advice {
            method,
            never_wrong: never_wrong(stability, &mapped),
            holds_within: stability.curves.iter().filter_map(|curve| limit(curve, &mapped)).collect(),
            costs: near(chart, &charted),
            word: String::new(),
        })
        .collect();
    let exact = all.iter().find(|advice| advice.method == ASKED[0].0);
    let exact = exact.map(|advice| advice.costs.clone()).unwrap_or_default();
    let fastest_right: Vec<bool> = all.iter().map(|advice| beats_all_right(advice, &all)).collect();
    for (advice, best) in all.iter_mut().zip(fastest_right) {
        advice.word = word(advice, &exact, best);
    }
    all
}

/// Whether no curve of truth saw it show another sphere, every one saw it, and there is one.
fn never_wrong(stability: &Stability, method: &str) -> bool {
    let curves: Vec<&Curve> = stability.curves.iter().filter(|curve| curve.by_truth).collect();
    let judged = |curve: &&Curve| {
        curve.line(method).is_some_and(|line| {
            line.counts.iter().all(|count| count.rays > 0 && count.wrong + count.refused == 0)
        })
    };
    !curves.is_empty() && curves.iter().all(judged)
}

/// What a curve says a method needs; none if it was hardly ever wrong there, or the curve is no matter of truth. To refuse is as bad as to
/// be wrong. Of tangency nothing is said: nobody can choose it.
fn limit(curve: &Curve, method: &str) -> Option<String> {
    let line = curve.line(method).filter(|_| curve.by_truth && curve.name != "tangency")?;
    let often = |count: &Count| count.refused > 0 || count.rate().is_some_and(|rate| rate * OFTEN >= 1.0);
    let wrong: Vec<bool> = line.counts.iter().map(often).collect();
    if !wrong.contains(&true) {
        return None;
    }
    // The stretch about the easy value in which it was never wrong.
    let easy = curve.values.iter().position(|value| value.to_bits() == curve.easy.to_bits()).unwrap_or(0);
    if wrong[easy] {
        return Some(format!("{}: wrong too often already at {}", curve.axis, power(curve.easy)));
    }
    let last = (easy..wrong.len()).take_while(|k| !wrong[*k]).last().unwrap_or(easy);
    let first = (0..=easy).rev().take_while(|k| !wrong[*k]).last().unwrap_or(easy);
    let at = |k: usize| power(curve.values[k]);
    let (open_below, open_above) = (first == 0, last + 1 == wrong.len());
    let range = match (open_below, open_above) {
        (true, true) => return None,
        (true, false) if curve.values[first] > curve.values[last] => format!("at least {}", at(last)),
        (true, false) => format!("at most {}", at(last)),
        (false, true) if curve.values[first] > curve.values[last] => format!("at most {}", at(first)),
        (false, true) => format!("at least {}", at(first)),
        (false, false) => format!("{} to {}", at(first), at(last)),
    };
    Some(format!("{}: {range}", curve.axis))
}

/// Its times on all scenes from near.
fn near(chart: &Chart, method: &str) -> Vec<(String, f64)> {
    let first = chart.views.iter().filter(|view| view.times_as_far.to_bits() == 1f64.to_bits());
    first
        .filter_map(|view| {
            let own =
                |point: &&Point| point.method == method || point.method.starts_with(&format!("{method}@"));
            Some((view.scene.clone(), view.points.iter().find(own)?.ns_per_ray?))
        })
        .collect()
}

/// The geometric mean of its times by another's, over scenes that both have.
fn times(costs: &[(String, f64)], others: &[(String, f64)]) -> Option<f64> {
    let ratios: Vec<f64> = costs
        .iter()
        .filter_map(|(scene, own)| Some(own / others.iter().find(|(name, _)| name == scene)?.1))
        .collect();
    crate::bench::spread::geometric_mean(&ratios)
}

fn beats_all_right(advice: &Advice, all: &[Advice]) -> bool {
    let right = all.iter().filter(|other| other.never_wrong && other.method != advice.method);
    advice.never_wrong
        && !advice.costs.is_empty()
        && right.filter_map(|other| times(&other.costs, &advice.costs)).all(|times| times > 1.0)
}

fn word(advice: &Advice, exact: &[(String, f64)], best: bool) -> String {
    let times = times(&advice.costs, exact);
    let right = advice.never_wrong;
    match times {
        _ if right && best => {
            "Take this: it was wrong nowhere, and nothing else that was right is faster.".into()
        }
        None => "Not timed here.".into(),
        Some(times) if right => {
            format!("Wrong nowhere, and it takes {} times as long as the exact one.", figure(times))
        }
        Some(times) if times < 1.0 => {
            format!("Takes {} of the exact one's time; only where all of its conditions hold.", figure(times))
        }
        Some(times) => format!(
            "Takes {} times as long as the exact one, and is wrong beyond its conditions: nothing speaks for it here.",
            figure(times)
        ),
    }
}

#[derive(Template)]
#[template(path = "advice-part.html")]
struct Part {
    rows: Vec<(Advice, Vec<String>)>,
}

/// The advice as a part of a page.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn part(advice: &[Advice]) -> Result<String, askama::Error> {
    let costs = |advice: &Advice| {
        advice.costs.iter().map(|(scene, ns)| format!("{scene} {} ns", figure(*ns))).collect()
    };
    Part { rows: advice.iter().map(|advice| (advice.clone(), costs(advice))).collect() }.render()
}
