//! A campaign as a page: what it comes to, what was at stake as bars, histograms, failures with their commands.

use super::merge::{Merged, Outcome};
use super::text::{bin, sentence};
use crate::plot::{alone, bars, escaped};
use crate::report::Environment;
use crate::report::chapter::Chapter;
use askama::Template;
use std::fmt::Write;

/// Counts of what is drawn, not of what it cost.
const COSTS: [&str; 3] = ["cells visited", "candidates", "grids"];

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
    let counts = merged.counts.iter().filter(|(what, _)| {
        let what = what.split(": ").nth(1).unwrap_or_default();
        !COSTS.contains(&what)
    });
    let rows: Vec<(String, u64)> = counts.map(|(what, n)| (what.clone(), *n)).collect();
    bars::bars("What was at stake", "how many", &rows)
}

fn body(merged: &Merged) -> String {
    let mut body = String::from("<section><h2>What was at stake</h2>");
    body += &chart(merged);
    body += "</section>";
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
