//! Slower than before? A run held against the JSON file of an earlier one, made on the same processor with the same plan and
//! level.
//!
//! In: the file's text and a [`Bench`]. Out: a [`Step`] for each scene that both have, of the same spheres, pixels, frame and
//! threads. Compared is the ratio to Embree where both have it, since it does not feel what else the machine does; else rays a
//! second. The ratio to the limit is no measure: it falls behind when the kernel gets faster. Refused: a file of another shape or
//! machine, and one that has no scene of this run.

use super::data::{Bench, Held, SCHEMA_VERSION, SceneBench};
use crate::report::words::figure;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Why there is nothing to compare with.
#[derive(Debug, Error)]
pub enum BaselineError {
    /// It is no such file.
    #[error("the baseline is no JSON file of `cgt bench`: {0}")]
    Json(#[from] serde_json::Error),
    /// It is of another version.
    #[error("the baseline has schema {found}; {SCHEMA_VERSION} is read")]
    Schema {
        /// What it says.
        found: u32,
    },
    /// It is of another machine or another tracer.
    #[error("the baseline was made with {what} {theirs:?}, this run with {ours:?}")]
    Other {
        /// What differs.
        what: &'static str,
        /// There.
        theirs: String,
        /// Here.
        ours: String,
    },
    /// No scene is in both.
    #[error("the baseline has no scene of this run at the same size, frame and threads")]
    Nothing,
}

/// What is read of the file.
#[derive(Debug, Deserialize)]
struct Earlier {
    schema_version: u32,
    environment: Machine,
    plan: String,
    level: String,
    scenes: Vec<Before>,
}

#[derive(Debug, Deserialize)]
struct Machine {
    cpu: Option<String>,
}

#[derive(Debug, Deserialize)]
struct Before {
    name: String,
    spheres: usize,
    frame: usize,
    width: u32,
    height: u32,
    threads: usize,
    ratio_to_embree: Option<f64>,
    contestants: Vec<Contestant>,
}

#[derive(Debug, Deserialize)]
struct Contestant {
    kind: super::contestant::Kind,
    mega_rays_per_second: Option<f64>,
}

/// From then to now on one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Its name.
    pub scene: String,
    /// What is compared.
    pub measure: &'static str,
    /// Then.
    pub before: f64,
    /// Now.
    pub now: f64,
}

impl Step {
    /// Whether it is slower by more than this part.
    #[must_use]
    pub fn is_slower(&self, tolerance: f64) -> bool {
        self.now < self.before * (1.0 - tolerance)
    }

    /// In words.
    #[must_use]
    pub fn sentence(&self, tolerance: f64) -> String {
        let verdict = if self.is_slower(tolerance) { ": slower" } else { "" };
        format!(
            "baseline, {}: {} {} was {}, {:+.1} %{verdict}.",
            self.scene,
            self.measure,
            figure(self.now),
            figure(self.before),
            100.0 * (self.now / self.before - 1.0)
        )
    }
}

/// Holds a run against an earlier one; a scene may be slower by so much of its speed.
///
/// # Errors
/// [`BaselineError`] if they cannot be compared.
pub fn compare(text: &str, bench: &Bench, tolerance: f64) -> Result<Held, BaselineError> {
    let earlier: Earlier = serde_json::from_str(text)?;
    if earlier.schema_version != SCHEMA_VERSION {
        return Err(BaselineError::Schema { found: earlier.schema_version });
    }
    let cpu = |cpu: &Option<String>| cpu.clone().unwrap_or_default();
    let same = [
        ("the processor", cpu(&earlier.environment.cpu), cpu(&bench.environment.cpu)),
        ("the plan", earlier.plan, bench.plan.clone()),
        ("the level", earlier.level, bench.level.clone()),
    ];
    for (what, theirs, ours) in same {
        if theirs != ours {
            return Err(BaselineError::Other { what, theirs, ours });
        }
    }
    let (mut steps, mut missing) = (Vec::new(), Vec::new());
    for now in &bench.scenes {
        match earlier.scenes.iter().find_map(|before| before.step(now)) {
            Some(step) => steps.push(step),
            None => missing.push(now.name.clone()),
        }
    }
    if steps.is_empty() { Err(BaselineError::Nothing) } else { Ok(Held { tolerance, steps, missing }) }
}

impl Before {
    fn step(&self, now: &SceneBench) -> Option<Step> {
        let key = (&self.name, self.spheres, self.frame, self.width, self.height, self.threads);
        if key != (&now.name, now.spheres, now.frame, now.width, now.height, now.threads) {
            return None;
        }
        let rays =
            |c: &Contestant| c.mega_rays_per_second.filter(|_| c.kind == super::contestant::Kind::Subject);
        let (measure, before, now_at) = match (self.ratio_to_embree, now.ratio_to_embree) {
            (Some(before), Some(now)) => ("ratio to Embree", before, now),
            _ => ("Mray/s", self.contestants.iter().find_map(rays)?, now.subject()?.mega_rays_per_second?),
        };
        Some(Step { scene: self.name.clone(), measure, before, now: now_at })
    }
}
