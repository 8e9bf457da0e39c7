//! What goes over the pipe. All numbers are little-endian; one frame is one question and one answer:
//!
//! | who | bytes | what |
//! |---|---|---|
//! | judge | 4 | `CGTQ` |
//! | judge | 16 | u32 each: version of the protocol, 1; number of spheres n; columns w and rows h of the picture |
//! | judge | 48 | f32: the camera's eye, corner, du, dv, three each (rule 1 of [`contract`]) |
//! | judge | 24 w h | f32: x, y, z of the start and of the direction of each ray, row by row from the top |
//! | tracer | 1 | `r`: it has read all of it |
//! | judge | 1 | `g`: go, the clock runs |
//! | judge | 16 n | f32: x, y, z of the centre and the radius of sphere 0, 1, 2, … |
//! | tracer | 1 | `d`: done, the clock stops |
//! | tracer | 4 w h | u32: of each ray the sphere it hits, or 4294967295 for none |
//! | tracer | 4 w h | f32: of each ray t of the hit; whatever stands for a miss is not looked at |
//!
//! The spheres come last, so that nothing can be built or traced while no clock runs; taking them counts, as it does for every contestant.
//! In place of `r` or `d` a tracer may send `e`, a u32 and so many bytes of text, at most [`MOST_TEXT`], to refuse the frame and say why.

use super::ForeignError;
use contract::{Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use reference::Ray;
use std::io::{self, ErrorKind, Read};

/// The first bytes of a question.
pub const MAGIC: [u8; 4] = *b"CGTQ";
/// Version of the protocol.
pub const VERSION: u32 = 1;
/// It has read the question.
pub const READ: u8 = b'r';
/// Go.
pub const GO: u8 = b'g';
/// It has traced all rays.
pub const DONE: u8 = b'd';
/// It will not.
pub const REFUSED: u8 = b'e';
/// The longest reason that is read, in bytes.
pub const MOST_TEXT: u32 = 4096;

/// A frame as a question: what is sent at first, and what once that has been read, with [`GO`] before it.
///
/// # Errors
/// [`ForeignError::Memory`] if its bytes cannot be had.
pub fn question(scene: &Scene, camera: &Camera) -> Result<[Vec<u8>; 2], ForeignError> {
    let (spheres, size) = (scene.spheres(), camera.size());
    let room = |bytes| {
        let mut room = Vec::new();
        let had = room.try_reserve_exact(bytes);
        had.map(|()| room).map_err(|_| ForeignError::Memory { bytes })
    };
    let (mut bytes, mut last) = (room(68 + 24 * size.pixels())?, room(1 + 16 * spheres.len())?);
    bytes.extend(MAGIC);
    // A scene holds fewer spheres than u32 has numbers (contract).
    let count = u32::try_from(spheres.len()).unwrap_or(u32::MAX);
    for number in [VERSION, count, size.width(), size.height()] {
        bytes.extend(number.to_le_bytes());
    }
    let mut put = |numbers: [f32; 3]| bytes.extend(numbers.into_iter().flat_map(f32::to_le_bytes));
    [camera.eye(), camera.corner(), camera.du(), camera.dv()].into_iter().for_each(&mut put);
    for y in 0..size.height() {
        for x in 0..size.width() {
            let ray = Ray::of_pixel(camera, x, y);
            bytes.extend(ray.eye.into_iter().chain(ray.dir).flat_map(f32::to_le_bytes));
        }
    }
    last.push(GO);
    for sphere in spheres {
        last.extend(sphere.center.into_iter().chain([sphere.radius]).flat_map(f32::to_le_bytes));
    }
    Ok([bytes, last])
}

fn invalid(why: impl std::fmt::Display) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, why.to_string())
}

/// The beginning of a stream's next question, its camera and how many spheres will come; none at the stream's end. Its rays are passed over,
/// since the camera has them.
///
/// # Errors
/// What the stream or the contract refuses.
pub fn asked(stream: &mut impl Read) -> io::Result<Option<(Camera, u32)>> {
    let mut magic = [0; 4];
    match stream.read_exact(&mut magic) {
        Err(error) if error.kind() == ErrorKind::UnexpectedEof => return Ok(None),
        other => other?,
    }
    let [version, spheres, width, height] = words(stream)?.map(u32::from_le_bytes);
    if magic != MAGIC || version != VERSION {
        let magic = magic.escape_ascii();
        return Err(invalid(format!("`{magic}`, version {version}; `CGTQ`, version {VERSION} is read")));
    }
    let size = Size::new(width, height).map_err(invalid)?;
    let mut three = || words(stream).map(|words: [_; 3]| words.map(f32::from_le_bytes));
    let [eye, corner, du, dv] = [three()?, three()?, three()?, three()?];
    let camera = Camera::new(eye, corner, du, dv, size).map_err(invalid)?;
    let rays = 24 * size.pixels() as u64;
    let passed = io::copy(&mut stream.take(rays), &mut io::sink())?;
    if passed == rays { Ok(Some((camera, spheres))) } else { Err(ErrorKind::UnexpectedEof.into()) }
}

/// The end of a question: go, and the spheres. Colours are not sent: all is black.
///
/// # Errors
/// What the stream or the contract refuses.
pub fn told(stream: &mut impl Read, spheres: u32) -> io::Result<Scene> {
    let mut go = [0];
    stream.read_exact(&mut go)?;
    if go != [GO] {
        return Err(invalid(format!("`{}` for `g`", go.escape_ascii())));
    }
    let mut balls = Vec::new();
    for _ in 0..spheres {
        let [x, y, z, radius] = words(stream)?.map(f32::from_le_bytes);
        balls.push(Sphere { center: [x, y, z], radius, color: [0; 3] });
    }
    Scene::new(balls, [0; 3], DEFAULT_LIGHT).map_err(invalid)
}

fn words<const N: usize>(stream: &mut impl Read) -> io::Result<[[u8; 4]; N]> {
    let mut words = [[0; 4]; N];
    stream.read_exact(words.as_flattened_mut())?;
    Ok(words)
}
