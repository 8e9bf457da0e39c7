//! What is looked at: a scene, a camera, and the last frame. Bytes come in through an inbox, frames and sentences go out.

use crate::hash::hash;
use crate::wire::{self, WireError};
use contract::{Camera, Scene};
use optimized::{Level, Plan, RenderError, Rendering, Session, Tracer};
use thiserror::Error;

/// The most spheres that are taken: 2²², which with all that is made of them need less than a quarter of the memory that 32 bits can
/// address.
pub const MAX_SPHERES: usize = 1 << 22;
/// The most pixels of a frame: 2²⁵, one of 8K.
pub const MAX_PIXELS: usize = 1 << 25;
/// The most bytes that anything has which is taken.
const MAX_BYTES: usize = wire::HEAD + wire::EACH * MAX_SPHERES;

/// Why something was not done.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Refusal {
    /// More bytes than a scene may have here, or than there is memory for.
    #[error("no place for {bytes} bytes; a scene here has {MAX_BYTES} at most")]
    Bytes {
        /// As asked for.
        bytes: usize,
    },
    /// The bytes were no scene or no camera.
    #[error(transparent)]
    Wire(#[from] WireError),
    /// A larger picture than is taken here.
    #[error("a picture of {pixels} pixels; the limit here is {MAX_PIXELS}")]
    Pixels {
        /// As asked for.
        pixels: usize,
    },
    /// A frame without its scene or its camera.
    #[error("there is no {what} yet")]
    Missing {
        /// `scene` or `camera`.
        what: &'static str,
    },
    /// No level has that number.
    #[error("no level {level}; there are {levels}, from 0")]
    Level {
        /// As asked for.
        level: usize,
        /// How many there are.
        levels: usize,
    },
    /// The tracer has no picture.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// A scene, a camera, and the last frame.
#[derive(Debug, Default)]
pub struct View {
    inbox: Vec<u8>,
    scene: Option<Scene>,
    camera: Option<Camera>,
    /// The level of the last frame, and who traced it.
    session: Option<(usize, Session)>,
    /// Whether the session's frame is of this scene and camera.
    traced: bool,
}

impl View {
    /// Nothing yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { inbox: Vec::new(), scene: None, camera: None, session: None, traced: false }
    }

    /// Room for so many bytes, all zero, from which [`set_scene`](Self::set_scene) or [`set_camera`](Self::set_camera) reads.
    ///
    /// # Errors
    /// [`Refusal::Bytes`] if they are too many; there is no room at all then.
    pub fn inbox(&mut self, bytes: usize) -> Result<&mut [u8], Refusal> {
        self.inbox = Vec::new();
        if bytes > MAX_BYTES || self.inbox.try_reserve_exact(bytes).is_err() {
            return Err(Refusal::Bytes { bytes });
        }
        self.inbox.resize(bytes, 0);
        Ok(&mut self.inbox)
    }

    /// Takes the scene in the inbox, which is empty then. If it is refused, there is none.
    ///
    /// # Errors
    /// [`Refusal::Wire`].
    pub fn set_scene(&mut self) -> Result<(), Refusal> {
        (self.scene, self.traced) = (None, false);
        self.scene = Some(wire::scene(&std::mem::take(&mut self.inbox))?);
        Ok(())
    }

    /// Takes the camera in the inbox, which is empty then. If it is refused, there is none.
    ///
    /// # Errors
    /// [`Refusal::Wire`], [`Refusal::Pixels`].
    pub fn set_camera(&mut self) -> Result<(), Refusal> {
        (self.camera, self.traced) = (None, false);
        let camera = wire::camera(&std::mem::take(&mut self.inbox))?;
        let pixels = camera.size().pixels();
        if pixels > MAX_PIXELS {
            return Err(Refusal::Pixels { pixels });
        }
        self.camera = Some(camera);
        Ok(())
    }

    /// Traces a frame by the plan `fast`, grid included, at a level by its number in [`Level::available`].
    ///
    /// # Errors
    /// [`Refusal::Missing`], [`Refusal::Level`], [`Refusal::Render`].
    pub fn render(&mut self, level: usize) -> Result<&Rendering, Refusal> {
        self.traced = false;
        let scene = self.scene.as_ref().ok_or(Refusal::Missing { what: "scene" })?;
        let camera = self.camera.as_ref().ok_or(Refusal::Missing { what: "camera" })?;
        let levels = Level::available();
        let chosen = *levels.get(level).ok_or(Refusal::Level { level, levels: levels.len() })?;
        // What another level left has its memory, which goes with it.
        let kept = self.session.take().filter(|(of, _)| *of == level);
        let (_, session) = match kept {
            Some(kept) => self.session.insert(kept),
            None => self.session.insert((level, Tracer::new(Plan::fast(), chosen).session()?)),
        };
        let frame = session.render(scene, camera)?;
        self.traced = true;
        Ok(frame)
    }

    /// The last frame, if nothing came in since.
    #[must_use]
    pub fn frame(&self) -> Option<&Rendering> {
        self.session.as_ref().filter(|_| self.traced).map(|(_, session)| session.last())
    }

    /// The last frame's [`hash`].
    #[must_use]
    pub fn hash(&self) -> Option<[u8; 32]> {
        self.frame().map(|frame| hash(&frame.image))
    }
}
