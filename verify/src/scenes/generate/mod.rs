//! Scenes that are made, not read: a sphereflake, and spheres uniform in a cube, clumped, or on a lattice. A kind
//! with its count and seed comes in, a scene goes out, the same to the bit on every machine. More spheres than
//! the contract allows are refused before memory is taken for them.
//!
//! What makes it the same everywhere: integers from PCG, then only additions, multiplications, divisions and square
//! roots in f64, which IEEE 754 fixes, and one rounding to f32. No sine, logarithm or cube root of a
//! library takes part.

mod flake;
mod random;

use contract::{DEFAULT_LIGHT, MAX_SPHERES, Rgb, Scene, SceneError, Sphere};
use std::fmt;
use thiserror::Error;

/// What generated scenes stand before.
const BACKGROUND: Rgb = [24, 26, 34];

/// A scene that can be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Generator {
    /// Eric Haines' "balls": spheres on spheres, nine on each, so many levels above the first.
    Sphereflake {
        /// Levels; 4 gives 7,381 spheres.
        levels: u32,
    },
    /// Spheres anywhere in the unit cube.
    Uniform {
        /// How many.
        count: usize,
        /// Of the random numbers.
        seed: u64,
    },
    /// Spheres crowded round the middle of the unit cube, with a standard deviation of 1/8.
    Clump {
        /// How many.
        count: usize,
        /// Of the random numbers.
        seed: u64,
    },
    /// Spheres in a cube of rows, in the unit cube.
    Lattice {
        /// How many along each edge.
        side: usize,
    },
}

/// Why a scene was not made.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum GenerateError {
    /// More spheres than the contract allows.
    #[error("{what} has {count} spheres; the limit is {limit}", limit = MAX_SPHERES)]
    TooMany {
        /// What was asked for.
        what: Generator,
        /// How many that is; `u128::MAX` for more than can be counted.
        count: u128,
    },
    /// Memory could not be had.
    #[error("no memory for {what} ({bytes} bytes)")]
    NoMemory {
        /// What was asked for.
        what: Generator,
        /// What it needs.
        bytes: usize,
    },
    /// The contract refuses it: with so many spheres, radii vanish.
    #[error("{what}: {source}")]
    Scene {
        /// What was asked for.
        what: Generator,
        /// Why.
        source: SceneError,
    },
}

impl fmt::Display for Generator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sphereflake { levels } => write!(f, "sphereflake:{levels}"),
            Self::Uniform { count, seed } => write!(f, "uniform:{count}:{seed}"),
            Self::Clump { count, seed } => write!(f, "clump:{count}:{seed}"),
            Self::Lattice { side } => write!(f, "lattice:{side}"),
        }
    }
}

impl Generator {
    /// How many spheres it makes, whether or not they are allowed.
    #[must_use]
    pub fn count(self) -> u128 {
        match self {
            Self::Sphereflake { levels } => {
                9_u128.checked_pow(levels.saturating_add(1)).map_or(u128::MAX, |n| (n - 1) / 8)
            }
            Self::Uniform { count, .. } | Self::Clump { count, .. } => count as u128,
            Self::Lattice { side } => (side as u128).checked_pow(3).unwrap_or(u128::MAX),
        }
    }

    /// Makes the scene.
    ///
    /// # Errors
    /// [`GenerateError`] for too many spheres, or no memory for them.
    pub fn scene(self) -> Result<Scene, GenerateError> {
        let allowed = usize::try_from(self.count()).ok().filter(|&n| n <= MAX_SPHERES);
        let count = allowed.ok_or(GenerateError::TooMany { what: self, count: self.count() })?;
        let mut spheres: Vec<Sphere> = Vec::new();
        let bytes = count * size_of::<Sphere>();
        spheres.try_reserve_exact(count).map_err(|_| GenerateError::NoMemory { what: self, bytes })?;
        match self {
            Self::Sphereflake { levels } => flake::fill(&mut spheres, levels),
            Self::Uniform { count, seed } => random::uniform(&mut spheres, count, seed),
            Self::Clump { count, seed } => random::clump(&mut spheres, count, seed),
            Self::Lattice { side } => lattice(&mut spheres, side),
        }
        Scene::new(spheres, BACKGROUND, DEFAULT_LIGHT)
            .map_err(|source| GenerateError::Scene { what: self, source })
    }
}

/// Spheres of three quarters of the room they have; colours go with the place.
fn lattice(spheres: &mut Vec<Sphere>, side: usize) {
    let step = 1.0 / side as f64;
    let shade = |i: usize| 70 + (i * 170 / side) as u8;
    for z in 0..side {
        for y in 0..side {
            for x in 0..side {
                let center = [x, y, z].map(|i| ((i as f64 + 0.5) * step) as f32);
                let color = [shade(x), shade(y), shade(z)];
                spheres.push(Sphere { center, radius: (0.375 * step) as f32, color });
            }
        }
    }
}
