//! What was found, as plain data: the one source of the page, the JSON file and the CSV file. A changed field means a new
//! [`SCHEMA_VERSION`]. Times are in seconds but where a name says otherwise; what was not measured is null.

use crate::methods::Family;
use crate::report::{Absent, Environment};
use crate::verdict::Comparison;
use serde::Serialize;

/// Version of the layout of the JSON file.
pub const SCHEMA_VERSION: u32 = 2;

/// All of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Chart {
    /// [`SCHEMA_VERSION`]; first, so that a reader can stop here.
    pub schema_version: u32,
    /// What this file is: `chart`.
    pub kind: &'static str,
    /// Where, when and how the run was made.
    pub environment: Environment,
    /// Methods that could have taken part and did not.
    pub absent: Vec<Absent>,
    /// Scene by scene, each from near to far.
    pub views: Vec<View>,
}

/// A frame from some distance.
#[derive(Clone, Debug, Serialize)]
pub struct View {
    /// The scene.
    pub scene: String,
    /// Its frame.
    pub frame: usize,
    /// Spheres.
    pub spheres: usize,
    /// Pixels of a row and rows.
    pub size: [u32; 2],
    /// How many times as far as the scene is seen by default.
    pub times_as_far: f64,
    /// From the eye to the middle of the scene, in radii of the median sphere.
    pub radii: f64,
    /// Pixels that hit.
    pub hits: u64,
    /// Rounds of measuring.
    pub rounds: usize,
    /// Method by method.
    pub points: Vec<Point>,
}

/// A method in a view.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// Its name.
    pub method: String,
    /// What decides its answers.
    pub family: Family,
    /// Whether it promises the truth, bit for bit.
    pub exact: bool,
    /// What it is.
    pub description: String,
    /// Nanoseconds a ray, building included, by the median frame.
    pub ns_per_ray: Option<f64>,
    /// Cycles a ray on the paper's processor, least and most, building and transfers included, hinted.
    pub spu_cycles_per_ray: Option<[f64; 2]>,
    /// Its picture against the exact one; of who paints no colours, these count as right.
    pub comparison: Option<Comparison>,
    /// Whether it paints colours.
    pub paints: bool,
    /// Why it gave no picture.
    pub remark: Option<String>,
}

impl Point {
    /// Wrong ids in a million pixels.
    #[must_use]
    pub fn wrong_per_million(&self) -> Option<f64> {
        let comparison = self.comparison.as_ref()?;
        Some(crate::report::words::per_million(comparison.wrong_ids, comparison.pixels))
    }
}

impl Chart {
    /// Methods that promise the truth, and showed something else than the exact picture, or nothing: each with what it did, where.
    #[must_use]
    pub fn broken_promises(&self) -> Vec<String> {
        let mut broken = Vec::new();
        for view in &self.views {
            for point in view.points.iter().filter(|point| point.exact) {
                let what = match &point.comparison {
                    Some(c) if c.pixels == 0 => "no pixel was compared".into(),
                    Some(c) if c.wrong_ids + c.wrong_t + c.wrong_color == 0 => continue,
                    Some(c) => {
                        format!("{} wrong ids, {} t, {} colours", c.wrong_ids, c.wrong_t, c.wrong_color)
                    }
                    None => point.remark.clone().unwrap_or_else(|| "no picture".into()),
                };
                broken.push(format!("{}, {} radii away, {}: {what}", view.scene, view.radii, point.method));
            }
        }
        broken
    }

    /// One line for each method in each view, with a line of headings.
    ///
    /// # Errors
    /// None that a buffer in memory has.
    pub fn csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record([
            "scene",
            "frame",
            "spheres",
            "width",
            "height",
            "times_as_far",
            "radii",
            "method",
            "family",
            "ns_per_ray",
            "spu_cycles_least",
            "spu_cycles_most",
            "pixels",
            "hits",
            "wrong_ids",
            "wrong_t",
            "t_ulp_median",
            "t_ulp_p99",
            "t_ulp_max",
            "wrong_colours",
            "colour_max",
        ])?;
        for view in &self.views {
            for point in &view.points {
                let number = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
                let of = |get: fn(&Comparison) -> u64| {
                    point.comparison.as_ref().map_or_else(String::new, |c| get(c).to_string())
                };
                let color = |get: fn(&Comparison) -> u64| if point.paints { of(get) } else { String::new() };
                let [least, most] = [0, 1].map(|i| number(point.spu_cycles_per_ray.map(|cycles| cycles[i])));
                let family = serde_json::to_value(point.family).ok();
                table.write_record([
                    view.scene.clone(),
                    view.frame.to_string(),
                    view.spheres.to_string(),
                    view.size[0].to_string(),
                    view.size[1].to_string(),
                    view.times_as_far.to_string(),
                    view.radii.to_string(),
                    point.method.clone(),
                    family.as_ref().and_then(|f| f.as_str()).unwrap_or_default().to_owned(),
                    number(point.ns_per_ray),
                    least,
                    most,
                    of(|c| c.pixels),
                    of(|c| c.hits),
                    of(|c| c.wrong_ids),
                    of(|c| c.wrong_t),
                    of(|c| c.t_ulp.median),
                    of(|c| c.t_ulp.p99),
                    of(|c| c.t_ulp.max),
                    color(|c| c.wrong_color),
                    color(|c| c.color_max.into()),
                ])?;
            }
        }
        table.into_inner().map_err(|error| csv::Error::from(error.into_error()))
    }
}
