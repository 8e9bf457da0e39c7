//! Times taken in turn: in each round every contestant traces a few frames, so that whatever else the machine does falls on
//! all of them alike.
//!
//! A turn begins with frames that are not counted, as long as those that are: in an animation the frames before are one's own and not
//! another's, and a scheduler may take several to give each thread a core of its own. Frames longer than [`LONG`] go without, since
//! no cache outlasts them.
//! Each round begins with another contestant. What is kept is every counted frame's time, in all and for building.

use super::contestant::Contestant;
use super::spread::Spread;
use crate::subject::SubjectError;
use contract::{Camera, Scene};
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// How long to measure.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// So many rounds; none for as many as the time allows, at least [`LEAST`] and at most [`MOST`].
    pub rounds: Option<usize>,
    /// Time for the rounds of one scene.
    pub time: Duration,
}

/// Fewest and most rounds where time decides.
pub const LEAST: usize = 5;
/// See [`LEAST`].
pub const MOST: usize = 200;
/// Frames of a turn, counted or not, go on until they have taken so long together, at most [`FRAMES`].
const TURN: Duration = Duration::from_millis(20);
const FRAMES: usize = 16;
/// See the module's text; in seconds.
pub const LONG: f64 = 0.5;

/// The times of one contestant.
#[derive(Clone, Debug, Default)]
pub struct Taken {
    /// Of each counted frame, seconds: building, and in all.
    frames: Vec<[f64; 2]>,
}

/// Where the time of a frame went.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Frames counted.
    pub frames: usize,
    /// Until all stood that rays share.
    pub build: Spread,
    /// From there to the end.
    pub trace: Spread,
    /// The whole frame.
    pub total: Spread,
}

impl Taken {
    /// The times told; none of no frame.
    #[must_use]
    pub fn timing(&self) -> Option<Timing> {
        let of = |part: fn(&[f64; 2]) -> f64| Spread::of(self.frames.iter().map(part).collect());
        (!self.frames.is_empty()).then(|| Timing {
            frames: self.frames.len(),
            build: of(|[build, _]| *build),
            trace: of(|[build, total]| total - build),
            total: of(|[_, total]| *total),
        })
    }

    /// The shortest frame so far.
    #[must_use]
    pub fn least(&self) -> f64 {
        self.frames.iter().map(|[_, total]| *total).fold(f64::INFINITY, f64::min)
    }
}

/// Rounds of all contestants; gives the times of each, in their order, and the number of rounds. `tick` is called after each.
///
/// # Errors
/// What kept a contestant from finishing, with its name.
pub fn rounds(
    contestants: &mut [Box<dyn Contestant>],
    scene: &Scene,
    camera: &Camera,
    effort: Effort,
    tick: &dyn Fn(),
) -> Result<(Vec<Taken>, usize), SubjectError> {
    let mut taken = vec![Taken::default(); contestants.len()];
    let (start, mut round) = (Instant::now(), 0);
    loop {
        for k in 0..contestants.len() {
            let k = (k + round) % contestants.len();
            turn(contestants[k].as_mut(), scene, camera, &mut taken[k])?;
        }
        round += 1;
        tick();
        let enough = match effort.rounds {
            Some(rounds) => round >= rounds,
            // No round is begun that would end too late.
            None => {
                let next = start.elapsed().mul_f64((round + 1) as f64 / round as f64);
                round >= MOST || (round >= LEAST && next > effort.time)
            }
        };
        if enough {
            return Ok((taken, round));
        }
    }
}

/// A turn of one contestant.
pub(super) fn turn(
    contestant: &mut dyn Contestant,
    scene: &Scene,
    camera: &Camera,
    taken: &mut Taken,
) -> Result<(), SubjectError> {
    if !taken.frames.iter().any(|[_, total]| *total > LONG) {
        several(|| one(contestant, scene, camera).map(drop))?;
    }
    several(|| {
        taken.frames.push(one(contestant, scene, camera)?);
        Ok(())
    })
}

/// Frames until the time of a turn is over.
fn several(mut one: impl FnMut() -> Result<(), SubjectError>) -> Result<(), SubjectError> {
    let start = Instant::now();
    for _ in 0..FRAMES {
        one()?;
        if start.elapsed() >= TURN {
            break;
        }
    }
    Ok(())
}

/// A frame: seconds for building, and in all.
fn one(contestant: &mut dyn Contestant, scene: &Scene, camera: &Camera) -> Result<[f64; 2], SubjectError> {
    let start = Instant::now();
    let frame = contestant.frame(scene, camera).map(|frame| (frame.build, frame.took));
    let elapsed = start.elapsed();
    let (build, took) = frame.map_err(|error| format!("{}: {error}", contestant.name()))?;
    Ok([build.as_secs_f64(), took.unwrap_or(elapsed).as_secs_f64()])
}
