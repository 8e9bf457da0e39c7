//! The camera: an eye and a grid of directions, as four vectors of f32 and a size. How to aim one at a scene
//! is no business of the contract (the crate `verify` does it); how pixel (x, y) gets its ray is rule 1.

use crate::Size;
use thiserror::Error;

/// A pinhole camera that has been checked: every pixel of it has a finite direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    eye: [f32; 3],
    corner: [f32; 3],
    du: [f32; 3],
    dv: [f32; 3],
    size: Size,
}

/// Why a camera was refused.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum CameraError {
    /// A vector has a NaN or an infinity.
    #[error("camera {field} is {value:?}; every component must be finite")]
    NotFinite {
        /// `eye`, `corner`, `du` or `dv`.
        field: &'static str,
        /// As given.
        value: [f32; 3],
    },
    /// `du` and `dv` are parallel, or one of them is zero: the picture would have no area.
    #[error("camera du {du:?} and dv {dv:?} are parallel or zero: the picture has no area")]
    Degenerate {
        /// As given.
        du: [f32; 3],
        /// As given.
        dv: [f32; 3],
    },
    /// The direction of a pixel overflows f32.
    #[error("camera: the direction of pixel ({x}, {y}) is {direction:?}, beyond f32")]
    Overflow {
        /// Column.
        x: u32,
        /// Row.
        y: u32,
        /// As rule 1 gives it.
        direction: [f32; 3],
    },
}

impl Camera {
    /// Checks and keeps a camera. All vectors are in scene units; `corner` is the direction of the outer
    /// corner of pixel (0, 0), `du` and `dv` lead from one pixel to the next.
    ///
    /// # Errors
    /// [`CameraError`] for the first thing found wrong.
    pub fn new(
        eye: [f32; 3],
        corner: [f32; 3],
        du: [f32; 3],
        dv: [f32; 3],
        size: Size,
    ) -> Result<Self, CameraError> {
        for (field, value) in [("eye", eye), ("corner", corner), ("du", du), ("dv", dv)] {
            if !value.iter().all(|x| x.is_finite()) {
                return Err(CameraError::NotFinite { field, value });
            }
        }
        if parallel(du, dv) {
            return Err(CameraError::Degenerate { du, dv });
        }
        for x in [0, size.width() - 1] {
            for y in [0, size.height() - 1] {
                let direction = extreme_direction(corner, du, dv, x, y);
                if !direction.iter().all(|x| x.is_finite()) {
                    return Err(CameraError::Overflow { x, y, direction });
                }
            }
        }
        Ok(Self { eye, corner, du, dv, size })
    }

    /// Where all rays start.
    #[must_use]
    pub fn eye(&self) -> [f32; 3] {
        self.eye
    }

    /// Direction of the outer corner of pixel (0, 0).
    #[must_use]
    pub fn corner(&self) -> [f32; 3] {
        self.corner
    }

    /// From a pixel to the next in its row.
    #[must_use]
    pub fn du(&self) -> [f32; 3] {
        self.du
    }

    /// From a row to the next.
    #[must_use]
    pub fn dv(&self) -> [f32; 3] {
        self.dv
    }

    /// Size of the image in pixels.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }
}

/// Whether u x v = 0, decided exactly: a product of two f32 numbers is exact in f64.
fn parallel(u: [f32; 3], v: [f32; 3]) -> bool {
    let product = |i: usize, j: usize| f64::from(u[i]) * f64::from(v[j]);
    [(0, 1), (1, 2), (2, 0)].iter().all(|&(i, j)| product(i, j) == product(j, i))
}

/// Rule 1 for one of the four extreme pixels. Only validation uses it: a tracer writes its own, and this one
/// stays private so that none can call it.
#[allow(clippy::cast_precision_loss, reason = "sides are below 2^14, exact in f32")]
fn extreme_direction(corner: [f32; 3], du: [f32; 3], dv: [f32; 3], x: u32, y: u32) -> [f32; 3] {
    let (x, y) = (x as f32 + 0.5, y as f32 + 0.5);
    std::array::from_fn(|i| (corner[i] + x * du[i]) + y * dv[i])
}
