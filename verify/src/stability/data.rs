//! What was found, as plain data: the one source of the page, the JSON file and the CSV file. A changed field means a new
//! [`SCHEMA_VERSION`].

use super::breakdown::Breakdown;
use crate::methods::Family;
use crate::report::{Absent, Environment};
use serde::Serialize;

/// Version of the layout of the JSON file.
pub const SCHEMA_VERSION: u32 = 1;

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
}

impl Curve {
    /// The line of a method.
    #[must_use]
    pub fn line(&self, method: &str) -> Option<&Line> {
        self.lines.iter().find(|line| line.method == method)
    }
}

impl Stability {
    /// Methods that decide exactly and were wrong, refused, or changed their mind: each with what it did, where.
    #[must_use]
    pub fn broken_promises(&self) -> Vec<String> {
        let mut broken = Vec::new();
        for curve in &self.curves {
            for line in curve.lines.iter().filter(|line| line.family == Family::Exact) {
                for (value, count) in curve.values.iter().zip(&line.counts) {
                    if count.wrong > 0 || count.refused > 0 || count.wrong_t.is_some_and(|wrong| wrong > 0) {
                        broken.push(format!("{} at {value}, {}: {count:?}", curve.name, line.method));
                    }
                }
            }
        }
        broken
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
