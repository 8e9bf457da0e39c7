//! What the atoms of a trajectory look like, since formats like DCD and XTC hold positions only. The first
//! frame of another file comes in, radii and colours go out; without one every atom is drawn as [`UNKNOWN`]. A
//! frame with another number of atoms is refused.

use super::{Loaded, ReadError, Warning};
use crate::scenes::elements::{Element, UNKNOWN};
use contract::{Rgb, Sphere};

/// What [`Sphere::radius`] and [`Sphere::color`] are, atom by atom.
pub(super) struct Looks {
    file: String,
    atoms: Vec<(f32, Rgb)>,
    pub(super) warnings: Vec<Warning>,
}

impl Looks {
    pub(super) fn of(file: &str, loaded: &Loaded) -> Self {
        let spheres = loaded.animation.frames()[0].spheres();
        let atoms = spheres.iter().map(|s| (s.radius, s.color)).collect();
        Self { file: file.into(), atoms, warnings: loaded.warnings.clone() }
    }

    /// Refuses a frame with another number of atoms.
    pub(super) fn must_have(&self, count: usize, file: &str, frame: usize) -> Result<(), ReadError> {
        if self.atoms.len() == count {
            return Ok(());
        }
        Err(ReadError::AtomCount {
            file: file.into(),
            frame,
            count,
            atoms_file: self.file.clone(),
            atoms: self.atoms.len(),
        })
    }
}

/// Atom `i` at a place.
pub(super) fn atom(looks: Option<&Looks>, i: usize, center: [f32; 3]) -> Sphere {
    let (radius, color) = looks.map_or((UNKNOWN.radius, UNKNOWN.color), |l| l.atoms[i]);
    Sphere { center, radius, color }
}

/// An element at a place.
pub(super) fn element(e: &Element, center: [f32; 3]) -> Sphere {
    Sphere { center, radius: e.radius, color: e.color }
}

/// Said where no file of atoms was given.
pub(super) const NO_ATOMS: &str =
    "no file says what the atoms are (TRAJECTORY,ATOMS); all are drawn alike, 1.70 Angstrom";
