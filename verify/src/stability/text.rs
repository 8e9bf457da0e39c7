//! Where each method breaks, as a table for the terminal.

use super::breakdown::WORDS;
use super::data::Stability;
use crate::plot::heat::share;
use crate::plot::power;
use crate::report::words::count;
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
            let most = line.counts.iter().filter_map(super::data::Count::rate).fold(0.0, f64::max);
            let (up, down) = (line.breakdown.up, line.breakdown.down);
            let either = |k: usize| match (down[k], up[k]) {
                _ if k == 1 && compared < 1_000_000 => "–".to_owned(),
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
                share(most)
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
            let cells =
                counts.iter().map(|c| format!("{:>11}", c.rate().map_or_else(|| "–".to_owned(), share)));
            _ = writeln!(text, "  {row:<32}{}", cells.collect::<String>());
        }
    }
    for absent in &stability.absent {
        _ = writeln!(text, "{}: not there. {}", absent.judge, absent.why);
    }
    text
}
