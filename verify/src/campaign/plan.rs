//! What a campaign does, as a TOML file:
//!
//! ```toml
//! name = "hunt"
//! seed = 1
//!
//! [[draw]]
//! property = "pictures"   # certain, pictures, swarms, wild, relations
//! cases = 100_000
//!
//! [[film]]
//! scene = "2juy"
//! frames = "0..24"
//! size = "320x180"
//! subjects = ["fast", "safe"]
//!
//! [least]                 # below these the campaign has no verdict
//! "pictures: rays near tangents" = 100_000
//! ```
//!
//! A plan is known by a hash of what it says, not of how it is written: shards of one hash and one program belong together.

use crate::properties::{CHUNK, Property};
use crate::scenes::catalogue::{Source, SourceError};
use crate::scenes::frame::Framing;
use crate::scenes::read::Loaded;
use crate::subject::{Grid, NAIVE_ALL, NamedPlan, Subject};
use contract::Size;
use optimized::Level;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::ops::Range;
use thiserror::Error;

/// Chunks of drawn cases that are one unit.
pub const CHUNKS: u64 = 16;
/// The most units of a plan: when shards are merged, what each has found is in memory.
pub const MOST_UNITS: u64 = 100_000_000;

/// A campaign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// What it is called.
    pub name: String,
    /// Of all that is drawn.
    pub seed: u64,
    /// Properties, and how many cases of each are drawn.
    #[serde(default)]
    pub draw: Vec<Draw>,
    /// Scenes whose frames are judged.
    #[serde(default)]
    pub film: Vec<Film>,
    /// The least of each count without which there is no verdict.
    #[serde(default)]
    pub least: BTreeMap<String, u64>,
}

/// A property of drawn cases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Draw {
    /// Which.
    pub property: Property,
    /// How many; the last unit is filled up.
    pub cases: u64,
}

/// Frames of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Film {
    /// A name, a generator or a file, as for `cgt verify`.
    pub scene: String,
    /// From and to, the last one not among them: `0..24`.
    pub frames: String,
    /// Columns and rows: `320x180`.
    pub size: String,
    /// Who is judged: `fast`, `safe`, `paper`, and the naive tracers.
    pub subjects: Vec<String>,
}

/// Why a plan is none.
#[derive(Debug, Error)]
pub enum PlanError {
    /// Not TOML, or not with these names; the place is in the message.
    #[error("{0}")]
    Toml(Box<toml::de::Error>),
    /// Nothing to do.
    #[error("it draws nothing and has no film")]
    Empty,
    /// The same property stands there twice, and would draw the same cases.
    #[error("it draws `{word}` twice, of the same seed: the same cases")]
    Twice {
        /// The property.
        word: &'static str,
    },
    /// The same frames stand there twice for the same tracer, and would count twice.
    #[error("film of `{scene}`: `{subject}` is to be judged twice on a frame")]
    Again {
        /// The film's scene.
        scene: String,
        /// Who.
        subject: String,
    },
    /// No case is drawn.
    #[error("it draws no case of `{word}`")]
    NoCase {
        /// The property.
        word: &'static str,
    },
    /// Too much for one plan.
    #[error("it has {units} units; {MOST_UNITS} can be had")]
    TooMuch {
        /// How many.
        units: u128,
    },
    /// A film's words mean nothing.
    #[error("film of `{scene}`: {why}")]
    Film {
        /// Its scene.
        scene: String,
        /// What is wrong.
        why: String,
    },
    /// A film's scene cannot be had.
    #[error("film of `{scene}`: {cause}")]
    Scene {
        /// Its scene.
        scene: String,
        /// Why.
        cause: Box<SourceError>,
    },
}

/// A part of the work.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unit {
    /// So many chunks of a property's cases.
    Drawn(Property, Range<u64>),
    /// A frame of a film.
    Frame(usize, usize),
}

impl Film {
    fn wrong(&self, why: impl Into<String>) -> PlanError {
        PlanError::Film { scene: self.scene.clone(), why: why.into() }
    }

    /// Its frames.
    ///
    /// # Errors
    /// [`PlanError::Film`] if the words are no range of frames.
    pub fn range(&self) -> Result<Range<usize>, PlanError> {
        let ends =
            self.frames.split_once("..").and_then(|(from, to)| Some(from.parse().ok()?..to.parse().ok()?));
        let range: Range<usize> =
            ends.ok_or_else(|| self.wrong(format!("`{}` is no range A..B", self.frames)))?;
        if range.is_empty() { Err(self.wrong(format!("`{}` has no frame", self.frames))) } else { Ok(range) }
    }

    /// Whether two have a frame in common, of one size, however scene and size are written.
    fn overlaps(&self, other: &Self) -> bool {
        let [Ok(one), Ok(two)] = [self.range(), other.range()] else { return false };
        let [Ok(size), Ok(its)] = [self.size(), other.size()] else { return false };
        let same = match [&self.scene, &other.scene].map(|word| Source::parse(word)) {
            [Ok(scene), Ok(its)] => scene == its,
            _ => self.scene == other.scene,
        };
        same && size == its && one.start < two.end && two.start < one.end
    }

    /// Columns and rows of its pictures.
    ///
    /// # Errors
    /// [`PlanError::Film`] if the words are no size that an image can have.
    pub fn size(&self) -> Result<Size, PlanError> {
        let sides = self.size.split_once('x').and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
        let (width, height) = sides.ok_or_else(|| self.wrong(format!("`{}` is no size WxH", self.size)))?;
        Size::new(width, height).map_err(|error| self.wrong(error.to_string()))
    }

    /// Its subjects.
    ///
    /// # Errors
    /// [`PlanError::Film`] if there is none, or one that is not known.
    pub fn subjects(&self, level: Level) -> Result<Vec<Box<dyn Subject>>, PlanError> {
        let known = |name: &String| -> Result<Box<dyn Subject>, PlanError> {
            if let Some(plan) = NamedPlan::ALL.into_iter().find(|plan| plan.name() == name) {
                return Ok(Box::new(Grid::new(plan, level, false, None)));
            }
            let naive = NAIVE_ALL.into_iter().find(|naive| naive.name() == name);
            naive.map_or_else(
                || Err(self.wrong(format!("no tracer is `{name}`"))),
                |naive| Ok(Box::new(naive) as _),
            )
        };
        let subjects: Vec<_> = self.subjects.iter().map(known).collect::<Result<_, _>>()?;
        if subjects.is_empty() { Err(self.wrong("nobody is judged")) } else { Ok(subjects) }
    }

    /// Its scene, with the frames that are asked for.
    ///
    /// # Errors
    /// [`PlanError::Scene`] if it cannot be had, [`PlanError::Film`] if it has fewer frames.
    pub fn load(&self) -> Result<Loaded, PlanError> {
        let load = || Source::parse(&self.scene)?.load();
        let loaded =
            load().map_err(|cause| PlanError::Scene { scene: self.scene.clone(), cause: cause.into() })?;
        let (frames, last) = (loaded.animation.frames().len(), self.range()?.end - 1);
        if last < frames {
            Ok(loaded)
        } else {
            Err(self.wrong(format!("it has frames 0 to {}, not {last}", frames - 1)))
        }
    }

    /// How its frames are seen.
    ///
    /// # Errors
    /// As [`Film::size`].
    pub fn framing(&self) -> Result<Framing, PlanError> {
        Ok(Framing { size: Some(self.size()?), ..Framing::default() })
    }
}

impl Plan {
    /// The plan in a text.
    ///
    /// # Errors
    /// [`PlanError`] for the first thing found wrong; whether films can be had is found when they are.
    pub fn parse(text: &str) -> Result<Self, PlanError> {
        let plan: Self = toml::from_str(text).map_err(|error| PlanError::Toml(error.into()))?;
        if plan.draw.is_empty() && plan.film.is_empty() {
            return Err(PlanError::Empty);
        }
        for (i, draw) in plan.draw.iter().enumerate() {
            let word = draw.property.word();
            if draw.cases == 0 {
                return Err(PlanError::NoCase { word });
            }
            if plan.draw[..i].iter().any(|other| other.property == draw.property) {
                return Err(PlanError::Twice { word });
            }
        }
        let mut units: u128 = plan.draw.iter().map(|draw| u128::from(draw.units())).sum();
        for (i, film) in plan.film.iter().enumerate() {
            units += film.range()?.len() as u128;
            film.size()?;
            film.subjects(Level::SCALAR)?;
            for (k, subject) in film.subjects.iter().enumerate() {
                let again = |other: &Film| other.overlaps(film) && other.subjects.contains(subject);
                if film.subjects[..k].contains(subject) || plan.film[..i].iter().any(again) {
                    return Err(PlanError::Again { scene: film.scene.clone(), subject: subject.clone() });
                }
            }
        }
        if units > u128::from(MOST_UNITS) { Err(PlanError::TooMuch { units }) } else { Ok(plan) }
    }

    /// What the plan says, as 64 hexadecimal digits.
    #[must_use]
    pub fn hash(&self) -> String {
        // Plain numbers and texts cannot fail to be written.
        let text = serde_json::to_vec(self).unwrap_or_default();
        Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Its units, in the order of their numbers.
    pub fn units(&self) -> impl Iterator<Item = Unit> {
        let drawn = self.draw.iter().flat_map(|draw| {
            let chunks = draw.cases.div_ceil(CHUNK);
            (0..draw.units())
                .map(move |k| Unit::Drawn(draw.property, k * CHUNKS..((k + 1) * CHUNKS).min(chunks)))
        });
        let frames =
            self.film.iter().enumerate().flat_map(|(i, film)| {
                film.range().unwrap_or_default().map(move |frame| Unit::Frame(i, frame))
            });
        drawn.chain(frames)
    }
}

impl Draw {
    fn units(&self) -> u64 {
        self.cases.div_ceil(CHUNK * CHUNKS)
    }
}
