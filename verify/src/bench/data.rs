//! What a benchmark found out, as plain data: the one source of the table, the page and the JSON file, whose shape these
//! types are. A changed field means a new [`SCHEMA_VERSION`]. Times are in seconds; what was not measured is null.

use super::baseline::Step;
use super::contestant::Kind;
use super::rounds::Timing;
use super::spread::geometric_mean;
use crate::report::{Absent, Environment};
use crate::verdict::Verdict;
use serde::Serialize;

/// Version of the layout of the JSON file.
pub const SCHEMA_VERSION: u32 = 2;

/// All of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Bench {
    /// [`SCHEMA_VERSION`]; first, so that a reader can stop here.
    pub schema_version: u32,
    /// What this file is: `bench`.
    pub kind: &'static str,
    /// Where, when and how the run was made; `seed` is that of the sampled rays.
    pub environment: Environment,
    /// The plan of the tracer under test.
    pub plan: String,
    /// Its SIMD level, to which Embree is held too.
    pub level: String,
    /// The outsiders that were there.
    pub outsiders: Vec<String>,
    /// Outsiders that were not.
    pub absent: Vec<Absent>,
    /// Over all scenes.
    pub summary: Summary,
    /// Scene by scene.
    pub scenes: Vec<SceneBench>,
    /// How times grow; empty if it was not asked.
    pub curves: Vec<Curve>,
    /// The run against an earlier one; none if none was named.
    pub baseline: Option<Held>,
}

/// A run held against an earlier one.
#[derive(Clone, Debug, Serialize)]
pub struct Held {
    /// The part by which a scene may be slower.
    pub tolerance: f64,
    /// Scene by scene.
    pub steps: Vec<Step>,
    /// Scenes of this run that the earlier one has not, or not at the same size, frame and threads.
    pub missing: Vec<String>,
}

impl Held {
    /// Whether a scene is slower by more.
    #[must_use]
    pub fn is_slower(&self) -> bool {
        self.steps.iter().any(|step| step.is_slower(self.tolerance))
    }
}

/// Over all scenes of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Geometric mean of the ratios to Embree.
    pub ratio_to_embree_mean: Option<f64>,
    /// The least of them.
    pub ratio_to_embree_least: Option<f64>,
    /// Geometric mean of the ratios to the limit.
    pub ratio_to_limit_mean: Option<f64>,
    /// The largest of them.
    pub ratio_to_limit_most: Option<f64>,
    /// The largest of the ratios to the best plan picked by hand.
    pub ratio_to_picked_most: Option<f64>,
}

/// One frame of one scene.
#[derive(Clone, Debug, Serialize)]
pub struct SceneBench {
    /// Its name.
    pub name: String,
    /// Spheres in the frame.
    pub spheres: usize,
    /// The frame, counted from 0.
    pub frame: usize,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Threads of every contestant.
    pub threads: usize,
    /// What the pictures were checked against.
    pub truth: Truth,
    /// Rounds of measuring.
    pub rounds: usize,
    /// Embree's best median over the subject's: how many times as fast the subject is.
    pub ratio_to_embree: Option<f64>,
    /// The way of Embree that was best.
    pub embree_best: Option<String>,
    /// The subject's median over the clairvoyant's: 1 would be no sphere met in vain.
    pub ratio_to_limit: Option<f64>,
    /// The subject's median over that of the best plan picked by hand: what is lost by choosing from the scene alone.
    pub ratio_to_picked: Option<f64>,
    /// The plan that was best.
    pub picked_best: Option<String>,
    /// Who took part.
    pub contestants: Vec<Row>,
}

/// The exact picture and how it came about.
#[derive(Clone, Debug, Serialize)]
pub struct Truth {
    /// In words.
    pub how: String,
    /// Rays that a picture was compared on: all pixels.
    pub rays: usize,
    /// Of these, rays for which the exact loop went over all spheres.
    pub by_full_loop: usize,
    /// Rays that hit.
    pub hits: usize,
}

/// One contestant on one scene.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Its name.
    pub name: String,
    /// Its part.
    pub kind: Kind,
    /// What it is.
    pub description: String,
    /// What became of its picture.
    pub verdict: Verdict,
    /// Pixels that differ from the exact picture: of who promised it in anything, of others in the sphere.
    pub differing: u64,
    /// Pixels that its promise or its rounding does not allow.
    pub wrong: u64,
    /// Pixels about which its rounding states nothing.
    pub not_stated: u64,
    /// The first wrong pixel.
    pub first_wrong: Option<[u32; 2]>,
    /// Its times, if it was timed.
    pub timing: Option<Timing>,
    /// Millions of rays a second, by the median of whole frames.
    pub mega_rays_per_second: Option<f64>,
    /// Why it has no times, or only those of a heat.
    pub remark: Option<String>,
}

/// The same measured at growing sizes.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    /// What grows: `spheres`, `pixels` or `threads`.
    pub over: &'static str,
    /// From small to large.
    pub points: Vec<Point>,
    /// What grew how much, in sentences.
    pub growth: Vec<Growth>,
}

/// A place on a curve.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// How many of what grows.
    pub x: f64,
    /// What was measured there.
    pub scene: SceneBench,
}

/// How much something grew between two points, and how much it may.
#[derive(Clone, Debug, Serialize)]
pub struct Growth {
    /// What.
    pub what: String,
    /// Smaller and larger x.
    pub between: [f64; 2],
    /// How many times as much.
    pub factor: f64,
    /// The most that is wanted, or the least if `at_least`.
    pub wanted: f64,
    /// Which of the two.
    pub at_least: bool,
}

impl Growth {
    /// Whether it is as wanted.
    #[must_use]
    pub fn holds(&self) -> bool {
        if self.at_least { self.factor >= self.wanted } else { self.factor <= self.wanted }
    }
}

impl Summary {
    /// Over these.
    #[must_use]
    pub fn of(scenes: &[SceneBench]) -> Self {
        let all = |ratio: fn(&SceneBench) -> Option<f64>| scenes.iter().filter_map(ratio).collect::<Vec<_>>();
        let (embree, limit) = (all(|s| s.ratio_to_embree), all(|s| s.ratio_to_limit));
        Self {
            ratio_to_embree_mean: geometric_mean(&embree),
            ratio_to_embree_least: embree.into_iter().reduce(f64::min),
            ratio_to_limit_mean: geometric_mean(&limit),
            ratio_to_limit_most: limit.into_iter().reduce(f64::max),
            ratio_to_picked_most: all(|s| s.ratio_to_picked).into_iter().reduce(f64::max),
        }
    }
}

impl SceneBench {
    /// The row of the tracer under test.
    #[must_use]
    pub fn subject(&self) -> Option<&Row> {
        self.rows(Kind::Subject).next()
    }

    /// The row of Embree's best way.
    #[must_use]
    pub fn embree(&self) -> Option<&Row> {
        self.rows(Kind::Embree).find(|row| Some(&row.name) == self.embree_best.as_ref())
    }

    /// The rows of a kind.
    pub fn rows(&self, kind: Kind) -> impl Iterator<Item = &Row> {
        self.contestants.iter().filter(move |row| row.kind == kind)
    }
}

impl Row {
    /// Median seconds of a whole frame.
    #[must_use]
    pub fn seconds(&self) -> Option<f64> {
        self.timing.map(|timing| timing.total.median)
    }
}

impl Bench {
    /// The word: wrong if the tracer under test is anywhere, or its limit, another plan of it or the reference; not judged if it was timed
    /// nowhere or what was asked for is missing; else equal or what it promised instead.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let scenes =
            self.scenes.iter().chain(self.curves.iter().flat_map(|c| c.points.iter().map(|p| &p.scene)));
        let subjects =
            scenes.clone().map(|scene| scene.subject().map_or(Verdict::NotJudged, |row| row.verdict));
        let ours = [Kind::Limit, Kind::Picked, Kind::Naive];
        let wrong = scenes.flat_map(|scene| &scene.contestants);
        let wrong = wrong.filter(|row| row.verdict == Verdict::Wrong && ours.contains(&row.kind));
        let wrong = wrong.map(|row| row.verdict);
        let missing = self.absent.iter().filter(|absent| absent.needed).map(|_| Verdict::NotJudged);
        Verdict::worst_of(subjects.chain(wrong).chain(missing))
    }

    /// What a report has to say of it if a tracer of this project was wrong or the one under test was not judged.
    #[must_use]
    pub fn broken_promises(&self) -> Vec<String> {
        let broken = matches!(self.verdict(), Verdict::Wrong | Verdict::NotJudged);
        broken
            .then(|| {
                "a tracer of this project gave a wrong picture when it was timed, or the one under test none"
                    .into()
            })
            .into_iter()
            .collect()
    }
}
