//! What was found, as plain data: the one source of the page, the JSON file and the CSV file. A changed field means a new
//! [`SCHEMA_VERSION`].

use super::breakdown::{Breakdown, nearest};
use crate::methods::Family;
use crate::report::words::NONE;
use crate::report::{Absent, Environment};
use serde::Serialize;
use std::fmt::Display;

/// Version of the layout of the JSON file.
pub const SCHEMA_VERSION: u32 = 2;

/// All of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Stability {
    /// [`SCHEMA_VERSION`]; first, so that a reader can stop here.
    pub schema_version: u32,
    /// What this file is: `stability`.
    pub kind: &'static str,
    /// Where, when and how the run was made.
    pub environment: Environment,
    /// Methods that could have taken part and did not.
    pub absent: Vec<Absent>,
    /// Rays that were asked for at each value.
    pub rays: u64,
    /// Over what is turned up.
    pub curves: Vec<Curve>,
    /// Over two things at once.
    pub maps: Vec<Map>,
}

/// How often each method is wrong over one thing.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    /// Short.
    pub name: String,
    /// Heading.
    pub title: String,
    /// What stands under the axis.
    pub axis: String,
    /// What is seen.
    pub what: String,
    /// Against the truth; else a method against itself.
    pub by_truth: bool,
    /// The easy value.
    pub easy: f64,
    /// The values.
    pub values: Vec<f64>,
    /// What is assumed up to where.
    pub marks: Vec<(f64, String)>,
    /// Method by method.
    pub lines: Vec<Line>,
}

/// Of a method.
#[derive(Clone, Debug, Serialize)]
pub struct Line {
    /// Its name.
    pub method: String,
    /// What decides its answers.
    pub family: Family,
    /// Whether it promises the truth, bit for bit.
    pub exact: bool,
    /// At each value.
    pub counts: Vec<Count>,
    /// Where it breaks.
    pub breakdown: Breakdown,
}

/// At a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Count {
    /// Rays that were compared.
    pub rays: u64,
    /// Of these, rays that hit in truth, or before the change.
    pub hits: u64,
    /// Rays with another sphere.
    pub wrong: u64,
    /// Rays with the right sphere whose t has other bits; none where t is not compared.
    pub wrong_t: Option<u64>,
    /// Error of t at 99 in 100, in units in the last place, where the sphere is right; none where none was compared.
    pub t_ulp_p99: Option<u64>,
    /// Shots for which the method gave no picture.
    pub refused: u64,
}

/// One method over two things at once.
#[derive(Clone, Debug, Serialize)]
pub struct Map {
    /// Short.
    pub name: String,
    /// Heading.
    pub title: String,
    /// What is seen.
    pub what: String,
    /// What stands under the axis.
    pub axis: String,
    /// Columns.
    pub columns: Vec<String>,
    /// Rows.
    pub rows: Vec<String>,
    /// Of each row, whether its method promises the truth.
    pub exact: Vec<bool>,
    /// Row by row.
    pub counts: Vec<Vec<Count>>,
    /// The first column beyond an assumption, and what it is.
    pub marks: Vec<(usize, String)>,
    /// The first row beyond an assumption.
    pub row_marks: Vec<usize>,
}

impl Count {
    /// Wrong rays of all; none if none was compared.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        (self.rays > 0).then(|| self.wrong as f64 / self.rays as f64)
    }

    /// Whether a promise of the truth is kept: there was something to compare, and all of it is right.
    #[must_use]
    pub fn keeps(&self) -> bool {
        self.rays > 0 && self.wrong + self.refused + self.wrong_t.unwrap_or(0) == 0
    }
}

impl Curve {
    /// The line of a method.
    #[must_use]
    pub fn line(&self, method: &str) -> Option<&Line> {
        self.lines.iter().find(|line| line.method == method)
    }

    /// What is said of a line that was seen wrong nowhere from the easy value on, toward the axis's end or its beginning. Who
    /// did not answer was not right.
    #[must_use]
    pub fn never(&self, line: &Line, up: bool) -> &'static str {
        let easy = nearest(&self.values, self.easy);
        let way = line.counts.iter().enumerate().filter(|(k, _)| if up { *k >= easy } else { *k <= easy });
        let any = |of: fn(&Count) -> bool| way.clone().any(|(_, count)| of(count));
        match () {
            () if any(|count| count.refused > 0) => "refused",
            () if any(|count| count.rays == 0) => NONE,
            () => "never",
        }
    }
}

impl Stability {
    /// Methods that promise the truth and were wrong, refused, changed their mind, or were asked nothing: each with what it did,
    /// where.
    #[must_use]
    pub fn broken_promises(&self) -> Vec<String> {
        let mut broken = Vec::new();
        let mut ask = |what: &str, method: &str, value: &dyn Display, count: &Count| {
            if !count.keeps() {
                broken.push(format!("{what} at {value}, {method}: {count:?}"));
            }
        };
        for curve in &self.curves {
            for line in curve.lines.iter().filter(|line| line.exact) {
                for (value, count) in curve.values.iter().zip(&line.counts) {
                    ask(&curve.name, &line.method, value, count);
                }
            }
        }
        for map in &self.maps {
            let rows = map.rows.iter().zip(&map.counts).zip(&map.exact);
            for ((row, counts), _) in rows.filter(|(_, exact)| **exact) {
                for (column, count) in map.columns.iter().zip(counts) {
                    ask(&map.name, row, column, count);
                }
            }
        }
        broken
    }

    /// Rays that were compared in all. A run without any has said nothing.
    #[must_use]
    pub fn compared(&self) -> u64 {
        let lines = self.curves.iter().flat_map(|curve| &curve.lines).flat_map(|line| &line.counts);
        lines
            .chain(self.maps.iter().flat_map(|map| map.counts.iter().flatten()))
            .map(|count| count.rays)
            .sum()
    }

    /// A curve by its name.
    #[must_use]
    pub fn curve(&self, name: &str) -> Option<&Curve> {
        self.curves.iter().find(|curve| curve.name == name)
    }

    /// A map by its name.
    #[must_use]
    pub fn map(&self, name: &str) -> Option<&Map> {
        self.maps.iter().find(|map| map.name == name)
    }

    /// One line for each method at each value, and for each cell of a map.
    ///
    /// # Errors
    /// None that a buffer in memory has.
    pub fn csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record([
            "what",
            "method_or_row",
            "value",
            "rays",
            "hits",
            "wrong",
            "wrong_t",
            "t_ulp_p99",
            "refused",
        ])?;
        let mut write = |what: &str, row: &str, value: String, count: &Count| {
            let Count { rays, hits, wrong, wrong_t, t_ulp_p99, refused } = *count;
            let numbers = [Some(rays), Some(hits), Some(wrong), wrong_t, t_ulp_p99, Some(refused)];
            let numbers = numbers.map(|n| n.map_or_else(String::new, |n| n.to_string()));
            table.write_record([what.to_owned(), row.to_owned(), value].iter().chain(&numbers))
        };
        for curve in &self.curves {
            for line in &curve.lines {
                for (value, count) in curve.values.iter().zip(&line.counts) {
                    write(&curve.name, &line.method, value.to_string(), count)?;
                }
            }
        }
        for map in &self.maps {
            for (row, counts) in map.rows.iter().zip(&map.counts) {
                for (column, count) in map.columns.iter().zip(counts) {
                    write(&map.name, row, column.clone(), count)?;
                }
            }
        }
        table.into_inner().map_err(|error| csv::Error::from(error.into_error()))
    }
}
