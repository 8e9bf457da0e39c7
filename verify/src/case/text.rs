//! The file of a case, `cgt-case` version 1: JSON with the scene in the project's own format, in which every number stands as a decimal
//! and as its bits ([`crate::scenes::write`]), and the tracer in words. What is written is read back the same. Refused are
//! unknown or missing fields, other versions, words that mean nothing, a level that this processor has not, and what
//! the contract refuses.

use super::plan_words::PlanWords;
use super::{Asked, Case, MOST_WORKERS};
use crate::foreign::PROMISES;
use crate::scenes::read::{ReadError, read_bytes};
use crate::scenes::write;
use crate::subject::{NAIVE_ALL, Subject};
use crate::verdict::Verdict;
use optimized::Level;
use optimized::host::NoSuchLevel;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use thiserror::Error;

const FORMAT: &str = "cgt-case";
const VERSION: u32 = 1;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: String,
    version: u32,
    why: String,
    expected: Expected,
    pixel: Option<[u32; 2]>,
    tracer: Tracer,
    scene: Box<RawValue>,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Expected {
    Equal,
    WithinBound,
    Undecidable,
    Wrong,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
enum Tracer {
    Naive(String),
    Grid { plan: Box<PlanWords>, level: String, workers: u8 },
    Foreign { name: String, promise: String },
}

/// Why a file is no case.
#[derive(Debug, Error)]
pub enum TextError {
    /// Not the JSON of a case; line and column are in the message.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// Another format or version.
    #[error("format `{format:.40}`, version {version}; `{FORMAT}`, version {VERSION} is read")]
    Version {
        /// As it stands there.
        format: String,
        /// As it stands there.
        version: u32,
    },
    /// The scene in it.
    #[error("its scene: {0}")]
    Scene(#[from] ReadError),
    /// The scene has no camera.
    #[error("its scene has no camera")]
    NoCamera,
    /// A word of the plan or the tracer means nothing.
    #[error("its tracer: {0}")]
    Words(String),
    /// The level is not here.
    #[error("its tracer: {0}")]
    Level(#[from] NoSuchLevel),
}

impl Case {
    /// The text, whose scene has one line a sphere.
    #[must_use]
    pub fn to_json(&self) -> String {
        let quoted = |text: &str| serde_json::Value::from(text).to_string();
        let tracer = match &self.asked {
            Asked::Naive(naive) => Tracer::Naive(naive.name().into()),
            &Asked::Grid { plan, level, workers } => {
                Tracer::Grid { plan: Box::new(plan.into()), level: level.name().into(), workers }
            }
            Asked::Foreign { name, promise, .. } => {
                // What a program may promise has a word.
                let word = PROMISES.iter().find(|(_, known)| known == promise).map_or("", |(word, _)| word);
                Tracer::Foreign { name: name.clone(), promise: word.into() }
            }
        };
        let expected = match self.expected {
            Verdict::Equal => "equal",
            Verdict::WithinBound => "within-bound",
            Verdict::Undecidable => "undecidable",
            Verdict::Wrong | Verdict::NotJudged => "wrong",
        };
        let pixel = self.pixel.map_or("null".into(), |[x, y]| format!("[{x}, {y}]"));
        // Plain strings and numbers cannot fail to be written.
        let tracer = serde_json::to_string_pretty(&tracer).unwrap_or_default();
        format!(
            "{{\"format\": \"{FORMAT}\", \"version\": {VERSION},\n\"why\": {},\n\"expected\": \"{expected}\",\n\"pixel\": {pixel},\n\"tracer\": {tracer},\n\"scene\": {}}}\n",
            quoted(&self.why),
            write::json(&self.frames, Some(&self.camera)).trim_end(),
        )
    }

    /// The case in a file's bytes.
    ///
    /// # Errors
    /// [`TextError`] for the first thing found wrong.
    pub fn from_json(bytes: &[u8]) -> Result<Self, TextError> {
        let file: File = serde_json::from_slice(bytes)?;
        if file.format != FORMAT || file.version != VERSION {
            return Err(TextError::Version { format: file.format, version: file.version });
        }
        let loaded = read_bytes("scene.json", file.scene.get().as_bytes(), None)?;
        let asked = match file.tracer {
            Tracer::Naive(name) => {
                let known = NAIVE_ALL.into_iter().find(|naive| naive.name() == name);
                Asked::Naive(
                    known.ok_or_else(|| TextError::Words(format!("no naive tracer is `{name:.40}`")))?,
                )
            }
            Tracer::Grid { plan, level, workers } => Asked::Grid {
                plan: (*plan).try_into().map_err(TextError::Words)?,
                level: if level == "best" { Level::best()? } else { Level::named(&level)? },
                workers: Some(workers).filter(|n| (1..=MOST_WORKERS).contains(n)).ok_or_else(|| {
                    TextError::Words(format!("{workers} workers; 1 to {MOST_WORKERS} can be had"))
                })?,
            },
            Tracer::Foreign { name, promise } => {
                let known = PROMISES.iter().find(|(word, _)| *word == promise);
                let unknown = || TextError::Words(format!("no program promises `{promise:.40}`"));
                Asked::Foreign { name, promise: known.ok_or_else(unknown)?.1, tracer: None }
            }
        };
        Ok(Self {
            frames: loaded.animation,
            camera: loaded.camera.ok_or(TextError::NoCamera)?,
            asked,
            expected: match file.expected {
                Expected::Equal => Verdict::Equal,
                Expected::WithinBound => Verdict::WithinBound,
                Expected::Undecidable => Verdict::Undecidable,
                Expected::Wrong => Verdict::Wrong,
            },
            pixel: file.pixel,
            why: file.why,
        })
    }
}
