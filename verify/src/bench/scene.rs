//! One frame of one scene: the exact picture is made, every contestant's is checked against it, those that pass are timed in
//! turn, in frames that nobody has seen ([`Unseen`]), and then checked once more: memory that is used again may hold what no first frame
//! shows.
//!
//! Embree can be asked in many ways. All are checked and run a heat; only the best [`KEPT`] there are timed in rounds, and of
//! the others their heat is told. Who is left out gives back its memory at once: a tree over ten million spheres takes more
//! than a gigabyte.

use super::check::{check, held};
use super::contestant::{Contestant, Kind};
use super::data::{Row, SceneBench, Truth};
use super::ours::Ours;
use super::outsiders::Field;
use super::rounds::{Effort, LONG, Taken, rounds, turn};
use super::unseen::{Standing, Unseen};
use crate::judge::narrowed::{NarrowedError, narrowed};
use crate::subject::{NamedPlan, SubjectError};
use crate::verdict::Verdict;
use contract::{Camera, Image, MISS, Scene};
use optimized::Level;
use reference::{Arithmetic, RenderError, Tracer};
use thiserror::Error;

/// See the module's text.
pub const KEPT: usize = 3;
/// Turns of a heat.
const HEAT: usize = 3;
/// Where spheres times pixels are more, the exact picture is made by narrowed loops.
pub const NARROWED_FROM: u128 = 10_000_000_000;

/// What is timed on every scene.
#[derive(Debug)]
pub struct Setting<'a> {
    /// The plan of the tracer under test.
    pub plan: NamedPlan,
    /// Its level.
    pub level: Level,
    /// Threads of every contestant.
    pub threads: usize,
    /// The outsiders, with as many threads.
    pub field: &'a Field,
    /// Whether plans picked by hand are timed too.
    pub picked: bool,
    /// How long.
    pub effort: Effort,
    /// Of random rays.
    pub seed: u64,
}

/// A frame to be timed.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// The frame's number.
    pub frame: usize,
    /// Its spheres.
    pub scene: &'a Scene,
    /// The camera.
    pub camera: &'a Camera,
}

/// Told what is being done: a word for it and how many steps it has; what it gives is called once a step.
pub type Progress<'a> = &'a dyn Fn(&str, u32) -> Box<dyn Fn() + Sync>;

/// Why a scene was not timed at all.
#[derive(Debug, Error)]
pub enum BenchError {
    /// There is no truth.
    #[error("no truth to check by: {0}")]
    Truth(#[from] RenderError),
    /// There is none either.
    #[error("no truth to check by: {0}")]
    Narrowed(#[from] NarrowedError),
    /// A contestant failed that had passed, or could not begin.
    #[error("a contestant failed: {0}")]
    Contestant(SubjectError),
}

/// Checks and times.
///
/// # Errors
/// [`BenchError`] if there is no truth, or a contestant gives up in the middle.
pub fn bench(
    input: &Input<'_>,
    setting: &Setting<'_>,
    progress: Progress<'_>,
) -> Result<SceneBench, BenchError> {
    let Input { scene, camera, .. } = *input;
    let (image, truth) = truth(scene, camera, setting.seed, progress)?;
    let entrants = entrants(input, setting, &image).map_err(BenchError::Contestant)?;
    let (rows, rounds) = race(entrants, input, &image, setting.effort, setting.seed, progress)?;
    Ok(told(input, setting, truth, rounds, rows))
}

/// Checks contestants against the exact picture and times those that pass. Gives a row of each, in their order, and the number of
/// rounds.
///
/// # Errors
/// [`BenchError::Contestant`] if one gives up in the middle.
pub fn race(
    entrants: Vec<Box<dyn Contestant>>,
    input: &Input<'_>,
    truth: &Image,
    effort: Effort,
    seed: u64,
    progress: Progress<'_>,
) -> Result<(Vec<Row>, usize), BenchError> {
    let Input { scene, camera, .. } = *input;
    let mut unseen = Unseen::new(scene, camera, truth, seed);
    let tick = progress("check", u32::try_from(entrants.len()).unwrap_or(u32::MAX));
    let (mut rows, mut passed) = (Vec::new(), Vec::new());
    for mut entrant in entrants {
        let (row, _) = checked(entrant.as_mut(), input, truth);
        if row.remark.is_none() {
            let heat = if row.kind == Kind::Embree {
                heat(entrant.as_mut(), &mut unseen)?
            } else {
                Taken::default()
            };
            passed.push(Passed { entrant, place: rows.len(), heat });
        }
        rows.push(row);
        leave_out(&mut passed, &mut rows, camera);
        tick();
    }
    let (mut entrants, mut places) = (Vec::new(), Vec::new());
    for Passed { entrant, place, .. } in passed {
        entrants.push(entrant);
        places.push(place);
    }
    let mut measured = 0;
    if !entrants.is_empty() {
        let least = effort.rounds.unwrap_or(super::rounds::LEAST);
        let tick = progress("rounds", u32::try_from(least).unwrap_or(u32::MAX));
        let outcome = rounds(&mut entrants, &mut unseen, effort, &*tick);
        let (taken, count) = outcome.map_err(BenchError::Contestant)?;
        measured = count;
        for ((entrant, place), taken) in entrants.iter_mut().zip(places).zip(&taken) {
            let (after, standing) = checked(entrant.as_mut(), input, truth);
            match (&after.remark, standing.and_then(|standing| taken.reproach(standing))) {
                (Some(why), _) => {
                    let remark = Some(format!("Passed at first, and no longer after the rounds. {why}"));
                    rows[place] = Row { remark, ..after };
                }
                (None, Some(why)) => {
                    let remark = Some(format!("{why} Not timed."));
                    rows[place] = Row { verdict: Verdict::Wrong, remark, ..after };
                }
                (None, None) => time(&mut rows[place], taken, camera),
            }
        }
    }
    Ok((rows, measured))
}

/// The exact picture, and how it came about.
///
/// # Errors
/// [`BenchError`] if there is none.
pub fn truth(
    scene: &Scene,
    camera: &Camera,
    seed: u64,
    progress: Progress<'_>,
) -> Result<(Image, Truth), BenchError> {
    let pixels = camera.size().pixels();
    let (image, how, by_full_loop) = if scene.spheres().len() as u128 * pixels as u128 <= NARROWED_FROM {
        let tick = progress("exact", camera.size().height());
        let image = Tracer::new(Arithmetic::Exact).render_with(scene, camera, &*tick)?.image;
        (image, "every pixel by the exact loop over all spheres".to_owned(), pixels)
    } else {
        let tick = progress("exact, narrowed", 1);
        let truth = narrowed(scene, camera, seed)?;
        tick();
        let how = format!(
            "every pixel by the exact loop over the spheres that can be seen in its tile, {} of them over all spheres",
            truth.sampled
        );
        (truth.image, how, truth.sampled)
    };
    let hits = image.ids.iter().filter(|&&id| id != MISS).count();
    Ok((image, Truth { how, rays: pixels, by_full_loop, hits }))
}

/// All contestants, the tracer under test first.
fn entrants(
    input: &Input<'_>,
    setting: &Setting<'_>,
    truth: &Image,
) -> Result<Vec<Box<dyn Contestant>>, SubjectError> {
    let Setting { plan, level, threads, field, picked, .. } = *setting;
    let subject = Ours::new(plan, input.scene, level, threads)?;
    let limit = Ours::clairvoyant(plan, input.scene, level, threads, truth)?;
    let mut entrants: Vec<Box<dyn Contestant>> = vec![Box::new(subject), Box::new(limit)];
    if picked {
        for (name, plan) in super::ours::picked(input.scene) {
            entrants.push(Box::new(Ours::of(name, plan, level, threads)?));
        }
    }
    entrants.extend(field.contestants(input.camera));
    Ok(entrants)
}

/// A contestant's row after its picture was checked, and how far the picture is off. The row has a remark if it may not be timed.
pub(super) fn checked(
    entrant: &mut dyn Contestant,
    input: &Input<'_>,
    truth: &Image,
) -> (Row, Option<Standing>) {
    let (kind, oath) = (entrant.kind(), entrant.oath());
    let mut row = Row {
        name: entrant.name().into(),
        kind,
        description: entrant.description(),
        verdict: Verdict::NotJudged,
        differing: 0,
        wrong: 0,
        not_stated: 0,
        first_wrong: None,
        timing: None,
        mega_rays_per_second: None,
        remark: None,
    };
    let mut standing = None;
    match entrant.frame(input.scene, input.camera) {
        Err(error) => row.remark = Some(format!("Gave no picture: {error}. Not timed.")),
        Ok(frame) => {
            let checked = check(input.scene, input.camera, truth, frame.layers, oath);
            standing = held(truth, frame.layers).ok().map(|comparison| Standing::new(oath, &comparison));
            row.verdict = checked.verdict();
            (row.differing, row.wrong, row.not_stated) =
                (checked.differing, checked.wrong, checked.not_stated);
            row.first_wrong = checked.first;
            if !checked.passes(kind, input.camera.size().pixels()) {
                row.remark = Some(match checked.first {
                    Some([x, y]) => {
                        format!("{} pixels are wrong, first ({x}, {y}). Not timed.", checked.wrong)
                    }
                    None => format!(
                        "Its rounding states nothing of its answer in {} pixels. Not timed.",
                        checked.not_stated
                    ),
                });
            }
        }
    }
    (row, standing)
}

/// Who may be timed, its place among the rows, and its heat if it had one.
struct Passed {
    entrant: Box<dyn Contestant>,
    place: usize,
    heat: Taken,
}

/// A few turns, so that one bad moment leaves nobody out; of long frames one.
fn heat(entrant: &mut dyn Contestant, unseen: &mut Unseen<'_>) -> Result<Taken, BenchError> {
    let mut taken = Taken::default();
    for _ in 0..HEAT {
        turn(entrant, unseen, &mut taken).map_err(BenchError::Contestant)?;
        if taken.least() > LONG {
            break;
        }
    }
    Ok(taken)
}

/// Leaves out the slowest of Embree's ways if there are too many, with the times of its heat.
fn leave_out(passed: &mut Vec<Passed>, rows: &mut [Row], camera: &Camera) {
    let ways = passed.iter().enumerate().filter(|(_, p)| p.entrant.kind() == Kind::Embree);
    if ways.clone().count() <= KEPT {
        return;
    }
    let slowest = ways.max_by(|x, y| x.1.heat.least().total_cmp(&y.1.heat.least())).map(|(k, _)| k);
    if let Some(k) = slowest {
        let Passed { place, heat, .. } = passed.remove(k);
        time(&mut rows[place], &heat, camera);
        rows[place].remark = Some("Slower than others of its kind in its heat, and timed no further.".into());
    }
}

fn time(row: &mut Row, taken: &Taken, camera: &Camera) {
    row.timing = taken.timing();
    row.mega_rays_per_second = row.seconds().map(|seconds| camera.size().pixels() as f64 / seconds / 1e6);
}

fn told(input: &Input<'_>, setting: &Setting<'_>, truth: Truth, rounds: usize, rows: Vec<Row>) -> SceneBench {
    let mut bench = SceneBench {
        name: input.name.into(),
        spheres: input.scene.spheres().len(),
        frame: input.frame,
        width: input.camera.size().width(),
        height: input.camera.size().height(),
        threads: setting.threads,
        truth,
        rounds,
        ratio_to_embree: None,
        embree_best: None,
        ratio_to_limit: None,
        ratio_to_picked: None,
        picked_best: None,
        contestants: rows,
    };
    let seconds = |kind| {
        // Whose heat is all there is was not timed beside the others.
        let timed = bench.rows(kind).filter(|row| row.remark.is_none());
        let timed = timed.filter_map(|row| Some((row.seconds()?, row.name.clone())));
        timed.min_by(|x, y| x.0.total_cmp(&y.0))
    };
    let [subject, limit, picked, embree] =
        [Kind::Subject, Kind::Limit, Kind::Picked, Kind::Embree].map(seconds);
    if let Some((subject, _)) = subject {
        bench.ratio_to_limit = limit.map(|(limit, _)| subject / limit);
        bench.ratio_to_picked = picked.as_ref().map(|(picked, _)| subject / picked);
        bench.ratio_to_embree = embree.as_ref().map(|(embree, _)| embree / subject);
    }
    bench.embree_best = embree.map(|(_, name)| name);
    bench.picked_best = picked.map(|(_, name)| name);
    bench
}
