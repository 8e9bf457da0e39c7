//! Rule 1: the ray of a pixel, in f32 exactly as the contract writes it.

use contract::Camera;

/// Six f32 numbers, taken as exact from here on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub eye: [f32; 3],
    /// Where it goes, of any length.
    pub dir: [f32; 3],
}

impl Ray {
    /// The ray through the middle of pixel (x, y).
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "pixel indices are below 2^14, exact in f32")]
    pub fn of_pixel(camera: &Camera, x: u32, y: u32) -> Self {
        let x = x as f32 + 0.5;
        let y = y as f32 + 0.5;
        let (corner, du, dv) = (camera.corner(), camera.du(), camera.dv());
        let dir = [0, 1, 2].map(|i| (corner[i] + x * du[i]) + y * dv[i]);
        Self { eye: camera.eye(), dir }
    }
}
