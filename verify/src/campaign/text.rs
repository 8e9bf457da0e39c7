//! A campaign for the terminal: what it comes to, what was at stake, what failed. And how far shards are.

use super::merge::{Merged, Outcome, Progress};
use crate::report::words::count;
use std::fmt::Write;

/// The outcome in a sentence.
#[must_use]
pub fn sentence(merged: &Merged) -> String {
    let rays: u64 = merged.counts.iter().filter(|(what, _)| what.ends_with(": rays")).map(|(_, n)| n).sum();
    match merged.outcome {
        Outcome::Held => {
            format!("No promise was broken in {} units, {} rays judged.", count(merged.units), count(rays))
        }
        Outcome::Broken => format!(
            "{} different failures in {} units, {} rays judged.",
            count(merged.failures.len() as u64),
            count(merged.units),
            count(rays)
        ),
        Outcome::TooLittle => format!("No verdict: too little was at stake: {}.", merged.lacking.join("; ")),
    }
}

/// What a value between two powers of two is called in a histogram.
#[must_use]
pub fn bin(k: usize) -> String {
    match k {
        0 => "0".into(),
        1 => "1".into(),
        _ if k <= 64 => {
            format!("{} to {}", count(1u64 << (k - 1)), count(u64::MAX >> (64 - k)))
        }
        _ => "more".into(),
    }
}

/// The table.
#[must_use]
pub fn text(merged: &Merged) -> String {
    let mut text = format!("{}: {}\n\n", merged.plan.name, sentence(merged));
    for (what, n) in &merged.counts {
        _ = writeln!(text, "{:>16}  {what}", count(*n));
    }
    for (what, bins) in &merged.histograms {
        _ = writeln!(text, "\n{what}");
        for (k, n) in bins.iter().enumerate().filter(|(_, n)| **n > 0) {
            _ = writeln!(text, "{:>16}  {}", count(*n), bin(k));
        }
    }
    for failure in &merged.failures {
        _ = writeln!(
            text,
            "\n{}, {} times, first in unit {}: {}",
            failure.of, failure.times, failure.unit, failure.message
        );
        _ = writeln!(text, "  cgt replay cases/{}.json", failure.name);
    }
    text
}

/// How far shards are, a line each; those of which there is no file are named.
#[must_use]
pub fn status(all: &[Progress]) -> String {
    let mut text = String::new();
    let mut sum = [0u64; 2];
    for progress in all {
        let [done, of] = progress.done;
        sum = [sum[0] + done, sum[1] + of];
        let word = if progress.whole { "whole" } else { "unfinished" };
        let failures =
            if progress.failures > 0 { format!(", {} failures", progress.failures) } else { String::new() };
        _ = writeln!(
            text,
            "shard {:>9}  {done:>9} of {of} units, {word}{failures}",
            progress.which.to_string()
        );
    }
    if let Some(of) = all.first().map(|progress| progress.which.of) {
        let begun =
            |shard: u64| all.iter().any(|progress| progress.which.shard == shard && progress.which.of == of);
        let absent: Vec<String> =
            (1..=of).filter(|shard| !begun(*shard)).map(|shard| shard.to_string()).collect();
        if !absent.is_empty() {
            let first = absent[..absent.len().min(20)].join(", ");
            let more =
                if absent.len() > 20 { format!(" and {} more", absent.len() - 20) } else { String::new() };
            _ = writeln!(text, "not begun: {first}{more}");
        }
    }
    _ = writeln!(text, "{} of {} units of these shards", sum[0], sum[1]);
    text
}
