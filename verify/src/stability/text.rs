//! Where each method breaks, as a table for the terminal.

use super::breakdown::WORDS;
use super::data::{Count, Stability};
use crate::plot::heat::share;
use crate::plot::power;
use crate::report::words::{NONE, count};
use std::fmt::Write;

/// The table.
#[must_use]
pub fn text(stability: &Stability) -> String {
    let mut text = format!("{} rays at each value\n", count(stability.rays));
    for curve in &stability.curves {
        let compared = curve.lines.iter().flat_map(|line| &line.counts).map(|c| c.rays).max().unwrap_or(0);
        _ = writeln!(text, "\n{} ({}), up to {} rays a value", curve.title, curve.axis, count(compared));
        _ = writeln!(
            text,
            "  {:<26}{:>22}{:>12}{:>22}{:>22}{:>14}",
            "method", WORDS[0], WORDS[1], WORDS[2], WORDS[3], "most"
        );
        for line in &curve.lines {
            let most = line.counts.iter().filter_map(Count::rate).reduce(f64::max);
            let (up, down) = (line.breakdown.up, line.breakdown.down);
            let either = |k: usize| match (down[k], up[k]) {
                _ if k == 1 && compared < 1_000_000 => NONE.to_owned(),
                (None, None) => {
                    let ways = [true, false].map(|up| curve.never(line, up));
                    ways.into_iter().find(|said| *said != "never").unwrap_or("never").to_owned()
                }
                (Some(a), Some(b)) if a.to_bits() != b.to_bits() => format!("{}, {}", power(a), power(b)),
                (Some(a), _) | (None, Some(a)) => power(a),
            };
            let cells = [0, 1, 2, 3].map(either);
            _ = writeln!(
                text,
                "  {:<26}{:>22}{:>12}{:>22}{:>22}{:>14}",
                line.method,
                cells[0],
                cells[1],
                cells[2],
                cells[3],
                most.map_or_else(|| NONE.to_owned(), share)
            );
        }
    }
    for map in &stability.maps {
        _ = writeln!(text, "\n{} ({})", map.title, map.axis);
        _ = writeln!(
            text,
            "  {:<32}{}",
            "",
            map.columns.iter().map(|c| format!("{c:>11}")).collect::<String>()
        );
        for (row, counts) in map.rows.iter().zip(&map.counts) {
            let cells = counts.iter().map(|count| format!("{:>11}", cell(count)));
            _ = writeln!(text, "  {row:<32}{}", cells.collect::<String>());
        }
        if map.counts.iter().flatten().any(|count| count.rays > 0 && count.refused > 0) {
            _ = writeln!(text, "  * of those that were answered; others were refused");
        }
    }
    for absent in &stability.absent {
        _ = writeln!(text, "{}: not there. {}", absent.judge, absent.why);
    }
    text
}

/// How much of a cell of a map is wrong, with a mark where some of it was refused.
fn cell(count: &Count) -> String {
    match count.rate() {
        None if count.refused > 0 => "refused".to_owned(),
        None => NONE.to_owned(),
        Some(rate) if count.refused > 0 => format!("{}*", share(rate)),
        Some(rate) => share(rate),
    }
}
