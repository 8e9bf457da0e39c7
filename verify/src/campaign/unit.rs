//! The work of one unit, and what it found: the same on every machine that has the same SIMD levels, whatever its cores.

use super::plan::{Film, Plan, PlanError, Unit};
use crate::bench::scene::{BenchError, truth};
use crate::case::shrink::shrink;
use crate::case::{Case, worst};
use crate::judge::judge;
use crate::properties::stakes::Stakes;
use crate::scenes::read::Loaded;
use crate::subject::{Naive, Promise, Subject};
use crate::verdict::Verdict;
use contract::Animation;
use optimized::Level;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use thiserror::Error;

/// Questions that making a failure smaller may ask.
const QUESTIONS: u32 = 4_000;

/// What a unit found: a line of a shard's file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Found {
    /// Its number.
    pub unit: u64,
    /// Counts by what they are of.
    pub counts: BTreeMap<String, u64>,
    /// Histograms by what they are of: how often the value was 0, how often 1, from 2 to 3, from 4 to 7, and so on.
    pub histograms: BTreeMap<String, Vec<u64>>,
    /// What failed.
    pub failures: Vec<Broken>,
}

/// A failure, made small.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Broken {
    /// The property, or the film's subject.
    pub of: String,
    /// What is wrong.
    pub message: String,
    /// The smallest case found, as the text of its file.
    pub case: String,
}

impl Broken {
    /// Tells failures apart: the same smallest case is the same failure.
    #[must_use]
    pub fn key(&self) -> String {
        let digest = Sha256::digest(self.case.as_bytes());
        digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect()
    }
}

/// Why a unit could not be done.
#[derive(Debug, Error)]
#[allow(missing_docs, reason = "each says all itself")]
pub enum UnitError {
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error("frame {frame} of `{scene}`: {why}")]
    Frame { scene: String, frame: usize, why: String },
}

/// A plan ready for work: the scenes of its films stay in memory.
#[derive(Debug)]
pub struct Bench<'a> {
    plan: &'a Plan,
    level: Level,
    films: Vec<Loaded>,
}

impl<'a> Bench<'a> {
    /// Loads the films.
    ///
    /// # Errors
    /// [`PlanError`] if one cannot be had.
    pub fn new(plan: &'a Plan, level: Level) -> Result<Self, PlanError> {
        let films = plan.film.iter().map(Film::load).collect::<Result<_, _>>()?;
        Ok(Self { plan, level, films })
    }

    /// Of each film's scene a hash of its frames' numbers.
    #[must_use]
    pub fn scenes(&self) -> Vec<String> {
        let hash = |loaded: &Loaded| {
            let mut hash = Sha256::new();
            for scene in loaded.animation.frames() {
                hash.update(scene.background());
                hash.update(scene.light().map(f32::to_le_bytes).as_flattened());
                for sphere in scene.spheres() {
                    hash.update(sphere.center.map(f32::to_le_bytes).as_flattened());
                    hash.update(sphere.radius.to_le_bytes());
                    hash.update(sphere.color);
                }
            }
            hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
        };
        self.films.iter().map(hash).collect()
    }

    /// Does a unit.
    ///
    /// # Errors
    /// [`UnitError`] if a frame has no truth or a subject gives no picture where it may not refuse.
    pub fn work(&self, number: u64, unit: &Unit) -> Result<Found, UnitError> {
        let mut found = Found { unit: number, ..Found::default() };
        match unit {
            Unit::Drawn(property, chunks) => {
                let all: Vec<_> = chunks
                    .clone()
                    .into_par_iter()
                    .map(|chunk| property.drawn(self.plan.seed, chunk))
                    .collect();
                for (stakes, failure) in all {
                    found.add(property.word(), &stakes);
                    if let Some(failure) = failure {
                        found.failures.push(smaller(
                            property.word(),
                            &failure.case,
                            &failure.message,
                            &|case| property.fails(case),
                        ));
                    }
                }
            }
            Unit::Frame(film, frame) => self.frame(*film, *frame, &mut found)?,
        }
        Ok(found)
    }

    fn frame(&self, film: usize, frame: usize, found: &mut Found) -> Result<(), UnitError> {
        let (film, loaded) = (&self.plan.film[film], &self.films[film]);
        let fault = |why: String| UnitError::Frame { scene: film.scene.clone(), frame, why };
        let scene = &loaded.animation.frames()[frame];
        let camera = loaded.camera(&film.framing()?).map_err(|error| fault(error.to_string()))?;
        let quiet = |_: &str, _: u32| -> Box<dyn Fn() + Sync> { Box::new(|| ()) };
        let (truth, _) = truth(scene, &camera, self.plan.seed, &quiet)
            .map_err(|error: BenchError| fault(error.to_string()))?;
        let threads = rayon::current_num_threads();
        for subject in film.subjects(self.level)? {
            let gave =
                |error: &dyn std::fmt::Display| fault(format!("{} gave no picture: {error}", subject.name()));
            let image = subject.render(scene, &camera, threads, &|| ()).map_err(|error| gave(&error))?.image;
            let twin = match subject.promise() {
                Promise::EqualToNaive(rounding) => {
                    let twin = Naive(rounding).render(scene, &camera, threads, &|| ());
                    Some(twin.map_err(|error| gave(&error))?.image)
                }
                Promise::Exact | Promise::Rounded(_) => None,
            };
            let judgement = judge(scene, &camera, &truth, &image, subject.promise(), twin.as_ref());
            let mut stakes = Stakes::default();
            stakes.add("frames", 1);
            stakes.add(word(judgement.verdict), 1);
            if let Some(c) = &judgement.comparison {
                stakes.add("rays", c.pixels);
                stakes.add("hits", c.hits);
                stakes.add("wrong ids", c.wrong_ids);
                stakes.add("wrong t", c.wrong_t);
                stakes.bin("largest error of t in a frame, ulp", c.t_ulp.max);
            }
            let of = format!("{} on {}", subject.name(), film.scene);
            found.add(&of, &stakes);
            if let (Verdict::Wrong, Some(asked)) = (judgement.verdict, subject.asked(threads)) {
                let case = Case {
                    frames: Animation::from(scene.clone()),
                    camera,
                    asked,
                    expected: Verdict::Wrong,
                    pixel: None,
                    why: String::new(),
                };
                let fails = |case: &Case| case.judge().is_ok_and(|judged| worst(&judged) == Verdict::Wrong);
                found.failures.push(smaller(&of, &case, &judgement.because, &fails));
            }
        }
        Ok(())
    }
}

/// What frames of a verdict are counted as.
pub(super) fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Equal => "frames equal to the truth",
        Verdict::WithinBound => "frames within the bound of rounding",
        Verdict::Undecidable => "frames beyond a form's range",
        Verdict::Wrong => "frames wrong",
        Verdict::NotJudged => "frames not judged",
    }
}

fn smaller(of: &str, case: &Case, message: &str, fails: &dyn Fn(&Case) -> bool) -> Broken {
    let small = shrink(case, QUESTIONS, fails);
    // What is to be held of it from now on: that it keeps its promise. The message would tell equal cases apart.
    let why = format!("found by a campaign: {of}");
    let small = Case { expected: small.asked.promise().worst(), pixel: None, why, ..small };
    Broken { of: of.into(), message: message.into(), case: small.to_json() }
}

impl Found {
    fn add(&mut self, of: &str, stakes: &Stakes) {
        for (what, n) in stakes.counts() {
            *self.counts.entry(format!("{of}: {what}")).or_default() += n;
        }
        for (what, bins) in stakes.histograms() {
            add_bins(self.histograms.entry(format!("{of}: {what}")).or_default(), bins);
        }
    }

    /// Together with what another found.
    pub fn and(&mut self, other: &Self) {
        for (what, n) in &other.counts {
            *self.counts.entry(what.clone()).or_default() += n;
        }
        for (what, bins) in &other.histograms {
            add_bins(self.histograms.entry(what.clone()).or_default(), bins);
        }
        self.failures.extend(other.failures.iter().cloned());
    }
}

fn add_bins(sum: &mut Vec<u64>, bins: &[u64]) {
    sum.resize(sum.len().max(bins.len()), 0);
    for (sum, n) in sum.iter_mut().zip(bins) {
        *sum += n;
    }
}
