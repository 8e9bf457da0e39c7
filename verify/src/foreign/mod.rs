//! A tracer in any language, judged as any other: a program that reads a scene and rays as bits and answers with ids and t ([`wire`]).
//!
//! In: a command line. Out: a [`Subject`] and, for charts and maps, a contestant. It is started when it is first asked and kept for the frames that
//! follow; where several are asked at once, it runs several times. It has no colours, so the reference's rule 4 paints what it found. A Rust
//! tracer can be had as such a program by [`serve`].

mod entrant;
mod process;
mod serve;
pub mod wire;

pub use entrant::method;
pub use serve::serve;

use crate::case::Asked;
use crate::subject::{Promise, Rendered, Rounding, Subject, SubjectError};
use contract::{Camera, Image, MISS, Scene};
use process::{Answer, Process};
use reference::{Hit, Ray, shade};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use thiserror::Error;

/// What may be promised of a foreign tracer, and its word.
pub const PROMISES: [(&str, Promise); 4] = [
    ("f32-textbook", Promise::Rounded(Rounding::TextbookF32)),
    ("f32-perpendicular", Promise::Rounded(Rounding::PerpendicularF32)),
    ("f64", Promise::Rounded(Rounding::TextbookF64)),
    ("exact", Promise::Exact),
];

/// Why a foreign tracer gave no picture.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ForeignError {
    /// The command line has an open quotation.
    #[error("`{command}` is no command line: a quotation is not closed")]
    Words {
        /// As given.
        command: String,
    },
    /// The command line names no program.
    #[error("the command line names no program")]
    Empty,
    /// The program could not be started.
    #[error("`{program}` cannot be started: {cause}")]
    Start {
        /// Its name.
        program: String,
        /// Why.
        cause: String,
    },
    /// No memory for a question or an answer.
    #[error("no memory for {bytes} bytes of scene and rays")]
    Memory {
        /// What was needed.
        bytes: usize,
    },
    /// It ended too early.
    #[error("it ended ({how}) where {due} bytes were due {when}, of which {got} had come")]
    Ended {
        /// Its exit status.
        how: String,
        /// What was waited for.
        when: &'static str,
        /// Bytes that had come.
        got: usize,
        /// Bytes that were due.
        due: usize,
    },
    /// It said nothing for too long.
    #[error(
        "it said nothing for {seconds} s where {due} bytes were due {when}, of which {got} had come (--patience)"
    )]
    Silent {
        /// How long.
        seconds: f64,
        /// What was waited for.
        when: &'static str,
        /// Bytes that had come.
        got: usize,
        /// Bytes that were due.
        due: usize,
    },
    /// It sent something else than what was due.
    #[error("it sent `{said}` where `{due}` was due {when}")]
    Unexpected {
        /// The beginning of what came.
        said: String,
        /// The byte that was due.
        due: char,
        /// What was waited for.
        when: &'static str,
    },
    /// It sent more than its answer.
    #[error("it sent {bytes} bytes or more that nobody asked for")]
    Surplus {
        /// How many were there.
        bytes: usize,
    },
    /// It would not.
    #[error("it refused: {said}")]
    Refused {
        /// Its own words.
        said: String,
    },
}

/// A foreign tracer.
#[derive(Debug)]
pub struct Foreign {
    name: String,
    command: String,
    words: Vec<String>,
    promise: Promise,
    patience: Duration,
    idle: Mutex<Vec<Process>>,
}

/// The answers of a frame, ray by ray.
#[derive(Clone, Debug)]
pub(crate) struct Answers {
    pub(crate) ids: Vec<u32>,
    pub(crate) t: Vec<f32>,
    pub(crate) took: Duration,
}

impl Foreign {
    /// The tracer of a command line, split into words as a shell does it, with no shell; `NAME=COMMAND` gives it a name, else it is the program's.
    /// `patience` is how long it may say nothing while something is due.
    ///
    /// # Errors
    /// [`ForeignError::Words`] or [`ForeignError::Empty`] if there is no program in it.
    pub fn new(line: &str, promise: Promise, patience: Duration) -> Result<Self, ForeignError> {
        let is_name = |name: &str| {
            !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c))
        };
        let (named, command) = match line.split_once('=') {
            Some((name, command)) if is_name(name) => (Some(name.to_owned()), command),
            _ => (None, line),
        };
        let words = shlex::split(command).ok_or_else(|| ForeignError::Words { command: command.into() })?;
        let program = words.first().ok_or(ForeignError::Empty)?;
        let stem = Path::new(program).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let name = named.or(stem).unwrap_or_else(|| "own".into());
        Ok(Self { name, command: command.into(), words, promise, patience, idle: Mutex::default() })
    }

    /// Asks one frame of a process that has time, or of a new one. Who fails is stopped.
    pub(crate) fn ask(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
    ) -> Result<Answers, ForeignError> {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let waiting = idle().pop();
        let mut process = match waiting {
            Some(process) => process,
            None => Process::start(&self.words, threads, self.patience)?,
        };
        let pixels = camera.size().pixels();
        let Answer { bytes, took } = process.ask(wire::question(scene, camera)?, 8 * pixels)?;
        idle().push(process);
        let (ids, t) = bytes.split_at(4 * pixels);
        let ids: Vec<u32> = ids.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect();
        let t = t.as_chunks().0.iter().map(|word| f32::from_le_bytes(*word));
        // Whatever stands for a miss.
        let t = t.zip(&ids).map(|(t, id)| if *id == MISS { f32::INFINITY } else { t }).collect();
        Ok(Answers { ids, t, took })
    }
}

impl Subject for Arc<Foreign> {
    fn name(&self) -> &str {
        &self.name
    }

    fn description(&self) -> &str {
        &self.command
    }

    fn promise(&self) -> Promise {
        self.promise
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Rendered, SubjectError> {
        let Answers { ids, t, took } = self.ask(scene, camera, threads)?;
        let mut image = Image::new(camera.size(), scene.background())?;
        (image.ids, image.t) = (ids, t);
        painted(scene, camera, &mut image);
        (0..camera.size().height()).for_each(|_| row_done());
        Ok(Rendered { image, notes: Vec::new(), took: Some(took) })
    }

    fn option(&self) -> String {
        let word = PROMISES.iter().find(|(_, promise)| *promise == self.promise).map_or("", |(word, _)| word);
        let named = format!("{}={}", self.name, self.command);
        format!("--subject-cmd {} --promise {word}", shlex::try_quote(&named).unwrap_or_default())
    }

    fn asked(&self, _: usize) -> Option<Asked> {
        Some(Asked::Foreign {
            name: self.name.clone(),
            promise: self.promise,
            tracer: Some(Self::clone(self)),
        })
    }
}

/// Paints what ids and t say, by the reference's rule 4; an id of no sphere stays background.
fn painted(scene: &Scene, camera: &Camera, image: &mut Image) {
    let Image { ids, t, rgba, size } = image;
    let places = (0..size.height()).flat_map(|y| (0..size.width()).map(move |x| [x, y]));
    for (i, [x, y]) in places.enumerate() {
        if (ids[i] as usize) < scene.spheres().len() {
            rgba[i] = shade(scene, &Ray::of_pixel(camera, x, y), Hit { id: ids[i], t: t[i] });
        }
    }
}
