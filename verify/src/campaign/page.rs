//! A campaign as a page: what it comes to, what was at stake as bars and as a table, histograms, failures with their commands.

use super::merge::{Merged, Outcome};
use super::text::{bin, sentence};
use crate::plot::{alone, bars, escaped};
use crate::report::Environment;
use crate::report::chapter::Chapter;
use crate::report::words::count;
use askama::Template;
use std::fmt::Write;

/// What the chart shows of each property and film: what was judged, and how much of it lay where tracers go wrong.
const SHOWN: [&str; 17] = [
    "rays",
    "hits",
    "rays near tangents",
    "rays from inside a sphere",
    "rays from a surface",
    "rays with an equal second hit",
    "spheres within 4 ulp of a plane",
    "rays that f32 left to f64",
    "rays that f64 left to integers",
    "t rounded by integers",
    "frames refused",
    "frames wrong",
    "rays whose answer is known",
    "known tangents",
    "known ties",
    "pixels with spheres permuted",
    "pixels with axes turned",
];

/// The page.
///
/// # Errors
/// None that a template has whose parts are all there.
pub fn page(merged: &Merged, environment: &Environment) -> Result<String, askama::Error> {
    let (heading, class, sign) = match merged.outcome {
        Outcome::Held => ("No promise was broken", "equal", "="),
        Outcome::Broken => ("Promises were broken", "wrong", "≠"),
        Outcome::TooLittle => ("No verdict", "undecidable", "?"),
    };
    let (lead, body) = (sentence(merged), body(merged));
    let beside = "The same data, to be read by programs: campaign.json in the same folder; failures are cases in cases/.";
    let page = Chapter {
        over: &merged.plan.name,
        sign,
        heading,
        class,
        lead: &lead,
        body: &body,
        environment,
        beside: beside.into(),
    };
    page.render()
}

/// What was at stake, as a drawing of its own; rows of each property or film together.
#[must_use]
pub fn stakes(merged: &Merged) -> String {
    alone(&chart(merged), crate::plot::STYLE)
}

fn chart(merged: &Merged) -> String {
    let counts = merged
        .counts
        .iter()
        .filter(|(what, _)| what.split(": ").nth(1).is_some_and(|what| SHOWN.contains(&what)));
    let failures = ("different failures".to_owned(), merged.failures.len() as u64);
    let rows: Vec<(String, u64)> = counts.map(|(what, n)| (what.clone(), *n)).chain([failures]).collect();
    bars::bars("What was at stake", "how many", &rows)
}

fn body(merged: &Merged) -> String {
    let mut body = String::from("<section><h2>What was at stake</h2>");
    body += &chart(merged);
    body += "<details><summary>All counts</summary><table class=\"plainly\"><tbody>";
    for (what, n) in &merged.counts {
        _ = write!(body, "<tr><td>{}</td><td>{}</td></tr>", escaped(what), count(*n));
    }
    body += "</tbody></table></details></section>";
    for (what, bins) in &merged.histograms {
        let rows: Vec<(String, u64)> = bins.iter().enumerate().map(|(k, n)| (bin(k), *n)).collect();
        _ = write!(
            body,
            "<section><h2>{}</h2>{}</section>",
            escaped(what),
            bars::bars(what, "how many", &rows)
        );
    }
    if !merged.failures.is_empty() {
        body += "<section><h2>Failures</h2>";
        for failure in &merged.failures {
            _ = write!(
                body,
                "<h3>{}</h3><p>{} times, first in unit {}. {}</p><pre tabindex=\"0\" aria-label=\"Command\">cgt replay cases/{}.json</pre>",
                escaped(&failure.of),
                failure.times,
                failure.unit,
                escaped(&failure.message),
                failure.name
            );
        }
        body += "</section>";
    }
    let levels = escaped(&merged.levels.join(", "));
    _ = write!(
        body,
        "<section><h2>The plan</h2><dl class=\"facts wide\"><div><dt>seed</dt><dd>{}</dd></div><div><dt>units</dt><dd>{}</dd></div><div><dt>levels drawn from</dt><dd>{levels}</dd></div><div><dt>hash</dt><dd><code>{}</code></dd></div></dl></section>",
        merged.plan.seed, merged.units, merged.hash
    );
    body
}
