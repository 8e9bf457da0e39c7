//! Times taken in turn: in each round every contestant traces a few frames, so that whatever else the machine does falls on
//! all of them alike.
//!
//! A turn begins with frames that are not counted, as long as those that are: in an animation the frames before are one's own and not
//! another's, and a scheduler may take several to give each thread a core of its own. Frames longer than [`LONG`] go without, since
//! no cache outlasts them.
//! Each round begins with another contestant. No two frames are alike ([`unseen`](super::unseen)). What is kept is every counted
//! frame's time, in all and for building, and what was found in the last one of each turn.

use super::contestant::{Contestant, Frame, Kind};
use super::spread::Spread;
use super::unseen::{Drawn, Left, Standing, Unseen};
use crate::subject::SubjectError;
use contract::Scene;
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
    drawn: Drawn,
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

    /// Why its times are not those of what it was to show; none if they are.
    #[must_use]
    pub fn reproach(&self, standing: Standing) -> Option<String> {
        self.drawn.reproach(standing)
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
    unseen: &mut Unseen<'_>,
    effort: Effort,
    tick: &dyn Fn(),
) -> Result<(Vec<Taken>, usize), SubjectError> {
    let mut taken = vec![Taken::default(); contestants.len()];
    let (start, mut round) = (Instant::now(), 0);
    loop {
        for k in 0..contestants.len() {
            let k = (k + round) % contestants.len();
            turn(contestants[k].as_mut(), unseen, &mut taken[k])?;
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
    unseen: &mut Unseen<'_>,
    taken: &mut Taken,
) -> Result<(), SubjectError> {
    if !taken.frames.iter().any(|[_, total]| *total > LONG) {
        several(|| one(contestant, unseen).map(drop))?;
    }
    let last = several(|| {
        let one = one(contestant, unseen)?;
        taken.frames.push(one.seconds);
        Ok(one)
    })?;
    unseen.hold(&last.scene, &last.left, &mut taken.drawn);
    Ok(())
}

/// Frames until the time of a turn is over; gives what came of the last.
fn several<T>(mut one: impl FnMut() -> Result<T, SubjectError>) -> Result<T, SubjectError> {
    let start = Instant::now();
    let mut last = one()?;
    for _ in 1..FRAMES {
        if start.elapsed() >= TURN {
            break;
        }
        last = one()?;
    }
    Ok(last)
}

/// A frame: seconds for building and in all, its spheres, and some of what it left.
struct One {
    seconds: [f64; 2],
    scene: Scene,
    left: Left,
}

fn one(contestant: &mut dyn Contestant, unseen: &mut Unseen<'_>) -> Result<One, SubjectError> {
    let (scene, camera) = (unseen.next(contestant.kind() == Kind::Limit), unseen.camera());
    let name = contestant.name().to_owned();
    let start = Instant::now();
    let frame = contestant.frame(&scene, camera);
    let elapsed = start.elapsed();
    let Frame { build, took, layers } = frame.map_err(|error| format!("{name}: {error}"))?;
    let seconds = [build.as_secs_f64(), took.unwrap_or(elapsed).as_secs_f64()];
    let left = unseen.draw(layers);
    Ok(One { seconds, scene, left })
}
