//! Spheres, scenes, and animations as sequences of scenes whose number of spheres may change.
//! A [`Scene`] can only be made through [`Scene::new`], which refuses what no tracer can answer for.

use thiserror::Error;

/// A colour: red, green, blue, 0 to 255 each.
pub type Rgb = [u8; 3];

/// Light that reaches every surface (rule 4).
pub const AMBIENT: f32 = 0.5625;
/// Light by the cosine to [`Scene::light`] (rule 4).
pub const DIFFUSE: f32 = 0.4375;
/// Towards the light where a scene names none: (2, 3, 6) / 7, of length 1 but for rounding.
pub const DEFAULT_LIGHT: [f32; 3] = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
/// The most spheres in one scene: 2²⁷, a scene of 2.7 GB. Ids are u32 and could count 32 times as far.
pub const MAX_SPHERES: usize = 1 << 27;

/// A sphere: 20 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: [f32; 3],
    /// Radius, above zero.
    pub radius: f32,
    /// Surface colour.
    pub color: Rgb,
}

/// Spheres, background and light that have been checked: all numbers finite, all radii above zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    spheres: Vec<Sphere>,
    background: Rgb,
    light: [f32; 3],
}

/// Why a scene was refused.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum SceneError {
    /// A centre has a NaN or an infinity.
    #[error("sphere {sphere}: centre is {center:?}; every coordinate must be finite")]
    Center {
        /// Its id.
        sphere: usize,
        /// The centre as given.
        center: [f32; 3],
    },
    /// A radius is NaN, infinite, zero or negative.
    #[error("sphere {sphere}: radius is {radius:?}; it must be finite and above 0")]
    Radius {
        /// Its id.
        sphere: usize,
        /// The radius as given.
        radius: f32,
    },
    /// The light has a NaN or an infinity.
    #[error("light is {light:?}; every component must be finite")]
    Light {
        /// The direction as given.
        light: [f32; 3],
    },
    /// More spheres than [`MAX_SPHERES`].
    #[error("{count} spheres; the limit is {limit}", limit = MAX_SPHERES)]
    TooManySpheres {
        /// How many were given.
        count: usize,
    },
}

impl Scene {
    /// Checks and keeps the parts of a scene. No spheres at all is valid.
    ///
    /// # Errors
    /// [`SceneError`] for the first thing found wrong: the count, the light, then the spheres in order.
    pub fn new(spheres: Vec<Sphere>, background: Rgb, light: [f32; 3]) -> Result<Self, SceneError> {
        Self::check_count(spheres.len())?;
        if !light.iter().all(|x| x.is_finite()) {
            return Err(SceneError::Light { light });
        }
        for (sphere, s) in spheres.iter().enumerate() {
            if !s.center.iter().all(|x| x.is_finite()) {
                return Err(SceneError::Center { sphere, center: s.center });
            }
            if !(s.radius.is_finite() && s.radius > 0.0) {
                return Err(SceneError::Radius { sphere, radius: s.radius });
            }
        }
        Ok(Self { spheres, background, light })
    }

    /// Whether a scene may have so many spheres: to be asked before memory is taken for them.
    ///
    /// # Errors
    /// [`SceneError::TooManySpheres`] above [`MAX_SPHERES`].
    pub fn check_count(count: usize) -> Result<(), SceneError> {
        if count > MAX_SPHERES { Err(SceneError::TooManySpheres { count }) } else { Ok(()) }
    }

    /// The spheres; a sphere's id is its index here.
    #[must_use]
    pub fn spheres(&self) -> &[Sphere] {
        &self.spheres
    }

    /// What a miss shows.
    #[must_use]
    pub fn background(&self) -> Rgb {
        self.background
    }

    /// Towards the light, used as it is, not normalised.
    #[must_use]
    pub fn light(&self) -> [f32; 3] {
        self.light
    }
}

/// One scene or more, in order of time. The number of spheres may differ from frame to frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    frames: Vec<Scene>,
}

/// Why an animation was refused.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum AnimationError {
    /// There is no frame.
    #[error("an animation needs at least one frame")]
    NoFrames,
}

impl Animation {
    /// Keeps the frames.
    ///
    /// # Errors
    /// [`AnimationError::NoFrames`] if there is none.
    pub fn new(frames: Vec<Scene>) -> Result<Self, AnimationError> {
        if frames.is_empty() {
            return Err(AnimationError::NoFrames);
        }
        Ok(Self { frames })
    }

    /// The frames, at least one.
    #[must_use]
    pub fn frames(&self) -> &[Scene] {
        &self.frames
    }
}

impl From<Scene> for Animation {
    fn from(scene: Scene) -> Self {
        Self { frames: vec![scene] }
    }
}
