//! What was found, as plain data: the one source of the page, the JSON file and the CSV file. A changed field means a new
//! [`SCHEMA_VERSION`].

use super::model::Without;
use crate::report::Environment;
use serde::Serialize;

/// Version of the layout of the JSON file.
pub const SCHEMA_VERSION: u32 = 1;

/// All of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Ablation {
    /// [`SCHEMA_VERSION`]; first, so that a reader can stop here.
    pub schema_version: u32,
    /// What this file is: `ablation`.
    pub kind: &'static str,
    /// Where, when and how the run was made.
    pub environment: Environment,
    /// Scene by scene.
    pub scenes: Vec<SceneAblation>,
    /// The model of the paper's machine, whole, and without each of its features.
    pub model: Vec<Without>,
}

/// Of a scene.
#[derive(Clone, Debug, Serialize)]
pub struct SceneAblation {
    /// Its name.
    pub scene: String,
    /// Spheres.
    pub spheres: usize,
    /// Pixels of a row and rows.
    pub size: [u32; 2],
    /// The bases, each with its variants.
    pub bases: Vec<BaseRows>,
    /// The time of the plan that the scene chooses, by that of the best one picked by hand.
    pub chosen_by_best: Option<f64>,
    /// That plan's name.
    pub best_picked: Option<String>,
    /// What spoke for the chosen one.
    pub reasons: Vec<String>,
}

/// A base and what changes.
#[derive(Clone, Debug, Serialize)]
pub struct BaseRows {
    /// Its name.
    pub name: String,
    /// What its variants show.
    pub what: String,
    /// Its plan in words.
    pub plan: String,
    /// Nanoseconds a ray, building included.
    pub ns_per_ray: Option<f64>,
    /// Cycles a ray on the SPU, least and most.
    pub cycles_per_ray: Option<[f64; 2]>,
    /// Pixels with another sphere than the exact picture.
    pub wrong: Option<u64>,
    /// Whether its picture is the exact one to the last bit, of a plan that promises that.
    pub kept: Option<bool>,
    /// Each variant.
    pub rows: Vec<Row>,
}

/// A variant.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// What was changed.
    pub concern: String,
    /// To what.
    pub choice: String,
    /// Its time by the base's.
    pub time: Option<f64>,
    /// Its cycles by the base's, at most.
    pub cycles: Option<f64>,
    /// Pixels with another sphere than the exact picture.
    pub wrong: Option<u64>,
    /// Whether its picture is the exact one to the last bit, of a plan that promises that.
    pub kept: Option<bool>,
    /// Why it gave no picture.
    pub remark: Option<String>,
}

impl Ablation {
    /// Plans that promise the exact picture and did not give it, with where.
    #[must_use]
    pub fn broken_promises(&self) -> Vec<String> {
        let mut broken = Vec::new();
        for scene in &self.scenes {
            for base in &scene.bases {
                if base.kept == Some(false) {
                    broken.push(format!("{}, {}: {:?} wrong ids", scene.scene, base.name, base.wrong));
                }
                for row in base.rows.iter().filter(|row| row.kept == Some(false)) {
                    let Row { concern, choice, wrong, .. } = row;
                    broken.push(format!(
                        "{}, {}, {concern} {choice}: {wrong:?} wrong ids",
                        scene.scene, base.name
                    ));
                }
            }
        }
        broken
    }

    /// One line for each variant of each base on each scene, with a line of headings.
    ///
    /// # Errors
    /// None that a buffer in memory has.
    pub fn csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record([
            "scene",
            "base",
            "concern",
            "choice",
            "times_the_time",
            "times_the_cycles",
            "wrong_ids",
        ])?;
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        let whole = |value: Option<u64>| value.map_or_else(String::new, |value| value.to_string());
        for scene in &self.scenes {
            for base in &scene.bases {
                for row in &base.rows {
                    table.write_record([
                        &scene.scene,
                        &base.name,
                        &row.concern,
                        &row.choice,
                        &number(row.time),
                        &number(row.cycles),
                        &whole(row.wrong),
                    ])?;
                }
            }
        }
        table.into_inner().map_err(|error| csv::Error::from(error.into_error()))
    }
}
