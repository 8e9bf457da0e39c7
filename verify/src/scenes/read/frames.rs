//! Where readers put their frames and warnings. It keeps account of memory, so that reading a file of n bytes never takes more than
//! 10 n and 64 MB beside the file itself (`tests/memory.rs`); beyond that the file is refused.
//!
//! A plain file may become scenes of at most 6 n bytes and 32 MB: a list that grows takes three times its length while it is moved,
//! and the shortest line of a sphere has ten bytes. What a packed file of n bytes unpacks to may be many times as
//! large and hold as many spheres more, so there the bytes themselves are counted too: those unpacked, scenes that are whole, and
//! three times the one being read, which covers what readers have beside it.

use super::{Format, Loaded, ReadError};
use contract::{Animation, DEFAULT_LIGHT, Rgb, Scene, Sphere};
use std::fmt;

/// What a molecule stands before.
pub(super) const BACKGROUND: Rgb = [18, 20, 26];
/// The most warnings kept of a file; the last one then says how many more there were.
pub const MAX_WARNINGS: usize = 100;

/// Something a reader passed over, or had to guess.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The file.
    pub file: String,
    /// Its line, from 1; `None` where a line is not what it is about.
    pub line: Option<usize>,
    /// What was done about it.
    pub text: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.file, self.text),
            None => write!(f, "{}: {}", self.file, self.text),
        }
    }
}

/// What a reader is given.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    /// The file's name.
    pub(super) file: &'a str,
    /// What it holds, unpacked.
    pub(super) bytes: &'a [u8],
    /// Its own bytes, if it was packed.
    pub(super) packed: Option<usize>,
}

impl Input<'_> {
    /// What a packed file leaves for scenes and all else, in bytes.
    fn left(&self) -> Option<u64> {
        self.packed.map(|packed| budget(packed).saturating_sub(self.bytes.len() as u64))
    }
}

/// What may be taken for a file of so many bytes: 10 times as many and 64 MB, less 8 MB for what no account is kept of.
pub(super) fn budget(file: usize) -> u64 {
    10 * file as u64 + (56 << 20)
}

pub(super) struct Frames<'a> {
    input: Input<'a>,
    taken: u64,
    frames: Vec<Scene>,
    warnings: Vec<Warning>,
    unsaid: usize,
    pub(super) background: Rgb,
    pub(super) light: [f32; 3],
}

impl<'a> Frames<'a> {
    /// For a file.
    pub(super) fn new(input: Input<'a>) -> Self {
        let (frames, warnings) = (Vec::new(), Vec::new());
        let (background, light) = (BACKGROUND, DEFAULT_LIGHT);
        Self { input, taken: 0, frames, warnings, unsaid: 0, background, light }
    }

    pub(super) fn len(&self) -> usize {
        self.frames.len()
    }

    /// An empty list for a frame of so many spheres, if memory for it is due.
    pub(super) fn room(&self, spheres: usize) -> Result<Vec<Sphere>, ReadError> {
        self.allowed(spheres)?;
        let mut list = Vec::new();
        list.try_reserve_exact(spheres).map_err(|_| self.refused(spheres))?;
        Ok(list)
    }

    /// Puts a sphere into a list that is not yet a frame, if memory is due for the list to grow. `with` is how many spheres' worth is
    /// kept beside each.
    pub(super) fn put(
        &self,
        spheres: &mut Vec<Sphere>,
        sphere: Sphere,
        with: usize,
    ) -> Result<(), ReadError> {
        if spheres.len() == spheres.capacity() {
            self.allowed((1 + with) * spheres.len())?;
        }
        spheres.push(sphere);
        Ok(())
    }

    /// Keeps a frame.
    pub(super) fn push(&mut self, mut spheres: Vec<Sphere>) -> Result<(), ReadError> {
        self.allowed(spheres.len())?;
        self.taken = self.need(spheres.len());
        spheres.shrink_to_fit();
        let scene = Scene::new(spheres, self.background, self.light);
        let refused =
            |source| ReadError::Scene { file: self.input.file.into(), frame: self.frames.len(), source };
        self.frames.push(scene.map_err(refused)?);
        Ok(())
    }

    pub(super) fn warn(&mut self, line: Option<usize>, text: impl Into<String>) {
        if self.warnings.len() < MAX_WARNINGS {
            self.warnings.push(Warning { file: self.input.file.into(), line, text: text.into() });
        } else {
            self.unsaid += 1;
        }
    }

    /// Says that the last frame is cut, or refuses the file if it is the only one.
    pub(super) fn cut(&mut self, line: Option<usize>, detail: String) -> Result<(), ReadError> {
        if self.frames.is_empty() {
            let detail = line.map_or(detail.clone(), |n| format!("line {n}: {detail}"));
            return Err(ReadError::NoFrame { file: self.input.file.into(), detail });
        }
        let complete = self.frames.len();
        self.warn(
            line,
            format!("the file ends within frame {complete} ({detail}); {complete} complete kept"),
        );
        Ok(())
    }

    /// Gives what was read; `detail` says what was not found if that is nothing.
    pub(super) fn finish(mut self, format: Format, detail: &str) -> Result<Loaded, ReadError> {
        if self.unsaid > 0 {
            let text = format!("{} more warnings", self.unsaid);
            self.warnings.push(Warning { file: self.input.file.into(), line: None, text });
        }
        let nothing = |_| ReadError::NoFrame { file: self.input.file.into(), detail: detail.into() };
        let animation = Animation::new(self.frames).map_err(nothing)?;
        Ok(Loaded { animation, format, warnings: self.warnings, framing: None, camera: None })
    }

    fn limit(&self) -> u64 {
        6 * self.input.bytes.len() as u64 + (32 << 20)
    }

    /// Bytes with one more frame. A frame without spheres counts too: three times its size, for a list that
    /// grows by doubling.
    fn need(&self, spheres: usize) -> u64 {
        let frame = spheres.saturating_mul(size_of::<Sphere>()) as u64;
        self.taken.saturating_add(frame).saturating_add(3 * size_of::<Scene>() as u64)
    }

    /// Refuses what would take memory beyond the account.
    pub(super) fn allowed(&self, spheres: usize) -> Result<(), ReadError> {
        let twice = 2 * (spheres.saturating_mul(size_of::<Sphere>()) as u64);
        let left = self.input.left().is_none_or(|left| self.need(spheres).saturating_add(twice) <= left);
        if left && self.need(spheres) <= self.limit() { Ok(()) } else { Err(self.refused(spheres)) }
    }

    fn refused(&self, spheres: usize) -> ReadError {
        ReadError::Memory {
            file: self.input.file.into(),
            frame: self.frames.len(),
            need: self.need(spheres),
            input: self.input.packed.unwrap_or(self.input.bytes.len()),
            limit: self.limit().min(self.input.left().unwrap_or(u64::MAX)),
        }
    }
}
