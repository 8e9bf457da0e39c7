//! Scenes and cameras as bytes. Numbers are little-endian, f32 by their bits, so that nothing is rounded on the way; what comes in is
//! checked as everywhere.
//!
//! A scene is a head of [`HEAD`] bytes and [`EACH`] for each sphere, in the order of ids:
//!
//! | byte | head | byte | sphere |
//! |---|---|---|---|
//! | 0 | light, three f32 | 0 | centre, three f32 |
//! | 12 | background: red, green, blue | 12 | radius, f32 |
//! | 15 | 0 | 16 | red, green, blue |
//! | | | 19 | 0 |
//!
//! A camera is [`CAMERA`] bytes: eye, corner, du and dv, three f32 each, then width and height, u32.

use contract::{Camera, CameraError, Scene, SceneError, Size, SizeError, Sphere};
use thiserror::Error;

/// Bytes before the first sphere.
pub const HEAD: usize = 16;
/// Bytes of a sphere.
pub const EACH: usize = 20;
/// Bytes of a camera.
pub const CAMERA: usize = 56;

/// Why bytes are no scene or no camera.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum WireError {
    /// No whole number of spheres.
    #[error("{bytes} bytes are no scene: that has {HEAD}, and {EACH} for each sphere")]
    SceneLength {
        /// As given.
        bytes: usize,
    },
    /// Too few bytes, or too many.
    #[error("{bytes} bytes are no camera: that has {CAMERA}")]
    CameraLength {
        /// As given.
        bytes: usize,
    },
    /// Memory for the spheres could not be had.
    #[error("no memory for {spheres} spheres")]
    NoMemory {
        /// How many there are.
        spheres: usize,
    },
    /// The contract refuses the scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The contract refuses the camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
    /// The contract refuses the camera's size.
    #[error(transparent)]
    Size(#[from] SizeError),
}

/// A scene's bytes.
#[must_use]
pub fn scene_bytes(scene: &Scene) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEAD + EACH * scene.spheres().len());
    let mut put = |numbers: &[f32], [r, g, b]: [u8; 3]| {
        bytes.extend(numbers.iter().flat_map(|x| x.to_bits().to_le_bytes()));
        bytes.extend([r, g, b, 0]);
    };
    put(&scene.light(), scene.background());
    for Sphere { center: [x, y, z], radius, color } in scene.spheres() {
        put(&[*x, *y, *z, *radius], *color);
    }
    bytes
}

/// The scene that bytes are.
///
/// # Errors
/// [`WireError`] for the first thing found wrong.
pub fn scene(bytes: &[u8]) -> Result<Scene, WireError> {
    let length = WireError::SceneLength { bytes: bytes.len() };
    let (head, rest) = bytes.split_at_checked(HEAD).ok_or(length)?;
    let count = rest.len() / EACH;
    if rest.len() != count * EACH {
        return Err(length);
    }
    Scene::check_count(count)?;
    let mut spheres = Vec::new();
    spheres.try_reserve_exact(count).map_err(|_| WireError::NoMemory { spheres: count })?;
    spheres.extend(rest.chunks_exact(EACH).map(|sphere| {
        let [x, y, z, radius] = numbers(sphere);
        Sphere { center: [x, y, z], radius, color: [sphere[16], sphere[17], sphere[18]] }
    }));
    Ok(Scene::new(spheres, [head[12], head[13], head[14]], numbers(head))?)
}

/// A camera's bytes.
#[must_use]
pub fn camera_bytes(camera: &Camera) -> Vec<u8> {
    let vectors = [camera.eye(), camera.corner(), camera.du(), camera.dv()];
    let size = [camera.size().width(), camera.size().height()];
    let bits = vectors.as_flattened().iter().map(|x| x.to_bits()).chain(size);
    bits.flat_map(u32::to_le_bytes).collect()
}

/// The camera that bytes are.
///
/// # Errors
/// [`WireError`] for the first thing found wrong.
pub fn camera(bytes: &[u8]) -> Result<Camera, WireError> {
    if bytes.len() != CAMERA {
        return Err(WireError::CameraLength { bytes: bytes.len() });
    }
    let words: [u32; CAMERA / 4] = words(bytes);
    let vector = |at: usize| [0, 1, 2].map(|i| f32::from_bits(words[at + i]));
    let size = Size::new(words[12], words[13])?;
    Ok(Camera::new(vector(0), vector(3), vector(6), vector(9), size)?)
}

/// The first N words of at least so many.
fn words<const N: usize>(bytes: &[u8]) -> [u32; N] {
    std::array::from_fn(|i| u32::from_le_bytes(std::array::from_fn(|k| bytes[4 * i + k])))
}

fn numbers<const N: usize>(bytes: &[u8]) -> [f32; N] {
    words(bytes).map(f32::from_bits)
}
