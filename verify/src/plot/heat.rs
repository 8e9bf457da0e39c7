//! Rows of cells: how often something goes wrong, for each of some methods or settings over another. Rates of 0 to 1 come in, an
//! `<svg>` element goes out whose cells are the stronger the more decades lie above the smallest rate; zero is empty, and what was not
//! measured is crossed out.

use super::{begin, escaped, line, words};
use std::fmt::Write;

/// What a cell shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cell {
    /// So many of all, 0 to 1.
    Rate(f64),
    /// So many of those that were measured; the rest was refused.
    Partly(f64),
    /// The method refused, or was not asked.
    None,
}

/// Rows over columns.
pub(crate) struct Heat<'a> {
    /// Called so by those who do not see it.
    pub(crate) title: &'a str,
    /// Under the columns.
    pub(crate) x: &'a str,
    /// Left of the rows.
    pub(crate) rows: Vec<String>,
    /// Each column's value as a word.
    pub(crate) columns: Vec<String>,
    /// Row by row.
    pub(crate) cells: Vec<Vec<Cell>>,
    /// Lines between two columns, before the one of that number, and what they mean.
    pub(crate) marks: Vec<(usize, String)>,
    /// Lines between two rows, above the one of that number.
    pub(crate) row_marks: Vec<usize>,
}

/// The smallest rate that has a colour of its own; what is below has the faintest.
const LEAST: f64 = 1e-6;
const LEFT: f64 = 190.0;
const RIGHT: f64 = 700.0;
const TOP: f64 = 26.0;
const HIGH: f64 = 22.0;
/// Columns that are all named.
const FEW: usize = 15;

/// How strong a rate is drawn, 0 to 1.
fn strength(rate: f64) -> f64 {
    if rate <= 0.0 {
        return 0.0;
    }
    let decades = -LEAST.log10();
    0.12 + 0.88 * ((rate.log10() + decades) / decades).clamp(0.0, 1.0)
}

/// The map, with its scale below; `None` without a cell.
#[must_use]
#[allow(clippy::cast_precision_loss, reason = "few cells")]
pub(crate) fn heat(map: &Heat<'_>) -> Option<String> {
    let (rows, columns) = (map.rows.len(), map.columns.len());
    if rows == 0 || columns == 0 {
        return None;
    }
    let wide = (RIGHT - LEFT) / columns as f64;
    let bottom = TOP + HIGH * rows as f64;
    let mut svg = begin([720.0, bottom + 92.0], map.title);
    for (row, (name, cells)) in map.rows.iter().zip(&map.cells).enumerate() {
        let y = TOP + HIGH * row as f64;
        words(&mut svg, "end", [LEFT - 8.0, y + 15.0], name);
        for (column, cell) in cells.iter().enumerate() {
            let x = LEFT + wide * column as f64;
            let told = |what: &str| escaped(&format!("{name}, {}: {what}", map.columns[column]));
            let at = format!(
                "x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"",
                x + 0.5,
                y + 0.5,
                wide - 1.0,
                HIGH - 1.0
            );
            let (rate, said, crossed) = match cell {
                Cell::Rate(rate) => (*rate, format!("{} wrong", share(*rate)), false),
                Cell::Partly(rate) => (*rate, format!("{} wrong, and others refused", share(*rate)), true),
                Cell::None => (0.0, "not measured".to_owned(), true),
            };
            let class = if rate > 0.0 { "cell" } else { "cell none" };
            let (told, strong) = (told(&said), strength(rate));
            _ = write!(
                svg,
                "<rect class=\"{class}\" {at} fill-opacity=\"{strong:.2}\"><title>{told}</title></rect>"
            );
            if crossed {
                line(&mut svg, "crossed", [x + 2.0, y + HIGH - 2.0], [x + wide - 2.0, y + 2.0]);
            }
        }
    }
    let mut last = f64::NEG_INFINITY;
    // Of many columns those are named that are powers of ten, if there are such.
    let round = |name: &&String| name.starts_with("10") || ["0", "1"].contains(&name.as_str());
    let rounded = columns > FEW && map.columns.iter().filter(round).count() > 2;
    for (column, name) in map.columns.iter().enumerate().filter(|(_, name)| !rounded || round(name)) {
        let at = LEFT + wide * (column as f64 + 0.5);
        if at - last > (name.chars().count() as f64 * 7.0 + 10.0).max(30.0) {
            words(&mut svg, "middle", [at, bottom + 16.0], name);
            last = at;
        }
    }
    words(&mut svg, "middle", [(LEFT + RIGHT) / 2.0, bottom + 36.0], map.x);
    for (column, label) in &map.marks {
        let at = LEFT + wide * *column as f64;
        line(&mut svg, "mark", [at, TOP - 6.0], [at, bottom]);
        words(&mut svg, if at > 450.0 { "end" } else { "start" }, [at, TOP - 10.0], label);
    }
    for row in &map.row_marks {
        let at = TOP + HIGH * *row as f64;
        line(&mut svg, "mark", [LEFT - 100.0, at], [RIGHT, at]);
    }
    scale(&mut svg, bottom + 52.0);
    Some(svg + "</svg>")
}

/// What the strengths mean.
fn scale(svg: &mut String, y: f64) {
    let shown = [0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0];
    for (k, rate) in (0_u32..).zip(shown) {
        let x = LEFT + 62.0 * f64::from(k);
        let class = if rate > 0.0 { "cell" } else { "cell none" };
        _ = write!(
            svg,
            "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"60\" height=\"12\" fill-opacity=\"{:.2}\"/>",
            strength(rate)
        );
        words(svg, "middle", [x + 30.0, y + 28.0], &share(rate));
    }
    words(svg, "end", [LEFT - 8.0, y + 11.0], "wrong");
}

/// A part of all in few signs.
pub(crate) fn share(rate: f64) -> String {
    match rate {
        r if r <= 0.0 => "0".into(),
        r if r < 1e-3 => super::power(r),
        r => format!("{} %", super::trimmed(r * 100.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::{Cell, Heat, heat, strength};

    #[test]
    fn zero_is_empty_and_one_is_full() {
        assert_eq!([0.0, 1e-9, 1.0].map(|r| (strength(r) * 100.0).round()), [0.0, 12.0, 100.0]);
        assert!(strength(1e-3) > strength(1e-4));
    }

    #[test]
    fn what_was_not_measured_is_no_zero() {
        let map = |cell| Heat {
            title: "t",
            x: "x",
            rows: vec!["a".into()],
            columns: vec!["1".into()],
            cells: vec![vec![cell]],
            marks: Vec::new(),
            row_marks: Vec::new(),
        };
        let drawn = |cell| heat(&map(cell)).expect("a cell");
        assert!(drawn(Cell::None).contains("not measured") && drawn(Cell::None).contains("crossed"));
        assert!(drawn(Cell::Rate(0.0)).contains("0 wrong") && !drawn(Cell::Rate(0.0)).contains("crossed"));
        assert!(
            drawn(Cell::Partly(0.0)).contains("others refused")
                && drawn(Cell::Partly(0.0)).contains("crossed")
        );
    }
}
