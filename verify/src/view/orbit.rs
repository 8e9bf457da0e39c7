//! A camera that is moved round a target, as on a turntable. In: the camera to begin with and what it looks at; angles, pixels and steps by which
//! it is moved. Out: the contract's camera, by the same code that aims every other one ([`Framing`]).
//!
//! The eye is kept as distance, azimuth and elevation about the axis that is up, in f64. The elevation stops short of the axis and the distance
//! within [`REACH`], so that there always is a direction of view; a move after which the contract refuses the camera, since f32 ends, is not
//! made. Until it is first moved the camera is the one it began with, to the bit.

use crate::scenes::frame::{Framing, FramingError};
use crate::scenes::vector::{Vector, cross, dot, sub, unit};
use contract::{Camera, Size, Sphere};
use std::f64::consts::{FRAC_PI_2, TAU};

/// How many times nearer or farther than at first the eye may go.
pub const REACH: f64 = 1e4;
/// The steepest view, in radians: half a degree from straight down.
const STEEPEST: f64 = FRAC_PI_2 - 0.009;
/// How much nearer one step of zooming goes.
pub const STEP: f64 = 1.1;

/// A camera on a turntable.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    home: Camera,
    start: Place,
    place: Place,
    /// Unit vectors: up, and two that span the table.
    axes: [Vector; 3],
    fov: f64,
    size: Size,
}

/// Where the eye is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    target: Vector,
    distance: f64,
    azimuth: f64,
    elevation: f64,
}

/// A move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Move {
    /// Round the target, to the right and up, in degrees.
    Orbit([f64; 2]),
    /// Eye and target together, so that the picture moves by so many pixels right and down.
    Pan([f64; 2]),
    /// Towards the target by so many steps of [`STEP`]; negative is away.
    Zoom(f64),
    /// Back to where it began.
    Home,
}

impl Orbit {
    /// Begins with a camera that looks about at the middle of a scene, and turns about the axis `up`; without one, about what is up in its
    /// picture.
    #[must_use]
    pub fn new(home: Camera, middle: Vector, up: Option<Vector>) -> Self {
        let eye = home.eye().map(f64::from);
        let [corner, du, dv] = [home.corner(), home.du(), home.dv()].map(|v| v.map(f64::from));
        let (width, height) = (f64::from(home.size().width()), f64::from(home.size().height()));
        let center: Vector = std::array::from_fn(|i| corner[i] + width / 2.0 * du[i] + height / 2.0 * dv[i]);
        let away = unit(center).unwrap_or([0.0, 0.0, -1.0]);
        let up = up.and_then(unit).or_else(|| unit(dv.map(|x| -x))).unwrap_or([0.0, 1.0, 0.0]);
        // The point of the line of view that lies nearest to the middle, or if that lies behind, as far before the eye.
        let offset = sub(middle, eye);
        let along = dot(offset, away);
        let distance = if along > 0.0 { along } else { dot(offset, offset).sqrt() };
        let distance = if distance > 0.0 && distance.is_finite() { distance } else { 1.0 };
        let target = std::array::from_fn(|i| eye[i] + distance * away[i]);
        let side = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let least = side.into_iter().map(|axis| cross(up, axis)).find_map(unit_enough);
        let first = least.unwrap_or([0.0, 0.0, 1.0]);
        let axes = [up, first, cross(up, first)];
        let towards = away.map(|x| -x);
        let [z, x, y] = axes.map(|axis| dot(axis, towards));
        let place = Place { target, distance, azimuth: y.atan2(x), elevation: z.clamp(-1.0, 1.0).asin() };
        let half = (dot(dv, dv) / dot(center, center)).sqrt() * height / 2.0;
        let fov = 2.0 * half.atan().to_degrees();
        Self { home, start: place, place, axes, fov, size: home.size() }
    }

    /// The camera as it stands.
    ///
    /// # Errors
    /// [`FramingError`] if the contract refuses it; after a [`Move`] that was made it does not.
    pub fn camera(&self) -> Result<Camera, FramingError> {
        if self.place == self.start && self.size == self.home.size() {
            return Ok(self.home);
        }
        let wish = Framing {
            eye: Some(self.eye()),
            target: Some(self.place.target),
            up: Some(self.axes[0]),
            fov: Some(self.fov),
            size: Some(self.size),
        };
        wish.camera_of(std::iter::empty::<&Sphere>)
    }

    /// Moves it; whether it could be, and anything changed.
    pub fn go(&mut self, by: Move) -> bool {
        let before = self.clone();
        let place = &mut self.place;
        match by {
            Move::Orbit([right, up]) => {
                place.azimuth = (place.azimuth + right.to_radians()).rem_euclid(TAU);
                place.elevation = (place.elevation + up.to_radians()).clamp(-STEEPEST, STEEPEST);
            }
            Move::Pan(pixels) => {
                let [right, up] = self.sides();
                let pixel = 2.0 * (self.fov / 2.0).to_radians().tan() / f64::from(self.size.height());
                let place = &mut self.place;
                let [x, y] = pixels.map(|pixels| pixels * pixel * place.distance);
                place.target = std::array::from_fn(|i| place.target[i] - x * right[i] + y * up[i]);
            }
            Move::Zoom(steps) => {
                let [nearest, farthest] = [self.start.distance / REACH, self.start.distance * REACH];
                place.distance = (place.distance * STEP.powf(-steps)).clamp(nearest, farthest);
            }
            Move::Home => *place = self.start,
        }
        self.or_back(before)
    }

    /// Takes another size of picture, with the same angle of its height; whether it could be.
    pub fn resize(&mut self, size: Size) -> bool {
        let before = self.clone();
        self.size = size;
        self.or_back(before)
    }

    /// Pixels of its picture.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// Keeps what has changed if there is a camera of it.
    fn or_back(&mut self, before: Self) -> bool {
        if self.camera().is_err() {
            *self = before;
            return false;
        }
        *self != before
    }

    /// Where the eye is.
    #[must_use]
    pub fn eye(&self) -> Vector {
        let towards = self.towards();
        std::array::from_fn(|i| self.place.target[i] + self.place.distance * towards[i])
    }

    /// What it looks at.
    #[must_use]
    pub fn target(&self) -> Vector {
        self.place.target
    }

    /// From the target to the eye, of length 1.
    fn towards(&self) -> Vector {
        let ((sin, cos), (rise, run)) = (self.place.azimuth.sin_cos(), self.place.elevation.sin_cos());
        let [up, x, y] = self.axes;
        std::array::from_fn(|i| rise * up[i] + run * (cos * x[i] + sin * y[i]))
    }

    /// To the right and up in the picture.
    fn sides(&self) -> [Vector; 2] {
        let away = self.towards().map(|x| -x);
        let right = unit(cross(away, self.axes[0])).unwrap_or(self.axes[1]);
        [right, cross(right, away)]
    }
}

/// Of length 1, unless it is so short that its direction is noise.
fn unit_enough(v: Vector) -> Option<Vector> {
    unit(v).filter(|_| dot(v, v) > 1e-6)
}
