//! Embree at its fastest, frame after frame: nothing is done within a frame that could be done before it.
//!
//! In: a device, a way to ask ([`Mode`]), a camera; then for each frame its spheres. Out: ids and t in memory that the
//! caller keeps. All directions are laid out beforehand as the library's packets want them, tile by tile so that rays
//! that follow each other are near each other; the eye is written into the packets once; flush-to-zero is set once for a
//! batch of packets; guard words and the subnormal canary are looked at once a strip. What remains beside the library's
//! own work is a copy of directions in and of answers out.

use super::device::Device;
use super::error::EmbreeError;
use super::ffi::{RawScene, flush};
use super::packet::{GROWTH, Packet, Valid};
use super::tracer::{Build, Width, checked};
use contract::{Camera, MISS, Scene, Size, Sphere};
use reference::Ray;
use std::fmt;
use std::sync::Mutex;

/// A way to ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mode {
    /// How scenes are built.
    pub build: Build,
    /// Rays at once.
    pub width: Width,
    /// Whether the library is told that packets are coherent; of one ray it makes no difference.
    pub coherent: bool,
}

impl Mode {
    /// Every way that may be the fastest.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut modes = Vec::new();
        for build in [Build::Plain, Build::Dynamic] {
            for width in Width::ALL {
                modes.push(Self { build, width, coherent: false });
                if width != Width::One {
                    modes.push(Self { build, width, coherent: true });
                }
            }
        }
        modes
    }
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let build = match self.build {
            Build::Robust => "robust",
            Build::Plain => "plain",
            Build::Dynamic => "dynamic",
        };
        write!(f, "{}-{build}{}", self.width, if self.coherent { "-coherent" } else { "" })
    }
}

/// Side of a tile in pixels: whole packets of every width.
const TILE: u32 = 8;
/// Packets that are traced with flush-to-zero set once. 32 of the largest are 64 KiB.
const BATCH: usize = 32;

/// A camera's rays and a scene for them.
pub struct Animated {
    device: Device,
    mode: Mode,
    size: Size,
    rays: Box<dyn Rays>,
    scene: Option<RawScene>,
}

impl Animated {
    /// Lays out the rays of a camera.
    #[must_use]
    pub fn new(device: &Device, mode: Mode, camera: &Camera) -> Self {
        let rays: Box<dyn Rays> = match mode.width {
            Width::One => Box::new(Laid::<1>::new(mode.width, camera)),
            Width::Four => Box::new(Laid::<4>::new(mode.width, camera)),
            Width::Eight => Box::new(Laid::<8>::new(mode.width, camera)),
            Width::Sixteen => Box::new(Laid::<16>::new(mode.width, camera)),
        };
        Self { device: device.clone(), mode, size: camera.size(), rays, scene: None }
    }

    /// Takes a frame's spheres and has them built, into the scene of the frame before if there are as many.
    ///
    /// # Errors
    /// [`EmbreeError::Call`] if the library refuses.
    pub fn build(&mut self, scene: &Scene) -> Result<(), EmbreeError> {
        let point = |s: &Sphere| [s.center[0], s.center[1], s.center[2], s.radius];
        let points = scene.spheres().iter().map(point);
        match &mut self.scene {
            Some(raw) if raw.count() == points.len() => checked(raw.fill(points)),
            _ => {
                let (flags, quality) = self.mode.build.flags();
                self.scene = Some(checked(RawScene::new(&self.device.raw, points, flags, quality))?);
                Ok(())
            }
        }
    }

    /// Traces all rays with so many threads. Pixel (x, y) stands at index `y * width + x`. Of a scene that was not built
    /// nothing is seen.
    ///
    /// # Errors
    /// [`EmbreeError::Overrun`] or [`EmbreeError::FlushStuck`] if the library broke what it was lent.
    ///
    /// # Panics
    /// If there are not as many places for ids or t as pixels, or a thread panicked.
    pub fn trace(&self, threads: usize, ids: &mut [u32], t: &mut [f32]) -> Result<(), EmbreeError> {
        assert_eq!([ids.len(), t.len()], [self.size.pixels(); 2], "a place for each pixel");
        let Some(scene) = &self.scene else {
            ids.fill(MISS);
            t.fill(f32::INFINITY);
            return Ok(());
        };
        let pixels = self.size.width() as usize * TILE as usize;
        let strips = Mutex::new(ids.chunks_mut(pixels).zip(t.chunks_mut(pixels)).enumerate());
        let next = || strips.lock().expect("no thread panics while it holds the list").next();
        let work = || {
            self.rays.trace(scene, self.mode, &next)?;
            if flush::subnormals_count() { Ok(()) } else { Err(EmbreeError::FlushStuck) }
        };
        if threads <= 1 {
            return work();
        }
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            threads.into_iter().try_for_each(|thread| thread.join().expect("a thread panicked"))
        })
    }
}

/// A strip of the picture, [`TILE`] rows or what is left: its number and its part of the layers.
type Strip<'a> = (usize, (&'a mut [u32], &'a mut [f32]));

/// Rays in packets of any width.
trait Rays: Send + Sync {
    /// Traces strips until there is no next one.
    fn trace<'a>(
        &self,
        scene: &RawScene,
        mode: Mode,
        next: &dyn Fn() -> Option<Strip<'a>>,
    ) -> Result<(), EmbreeError>;
}

/// A packet's directions, and where its first pixel stands in its strip.
struct Aim<const W: usize> {
    column: u32,
    row: u32,
    dir: [[f32; W]; 3],
}

/// The packets of a picture, strip by strip.
struct Laid<const W: usize> {
    size: Size,
    block: [u32; 2],
    /// Whether no packet reaches beyond the picture.
    whole: bool,
    eye: [f32; 3],
    strips: Vec<Vec<Aim<W>>>,
}

impl<const W: usize> Laid<W> {
    fn new(width: Width, camera: &Camera) -> Self {
        let (size, block) = (camera.size(), width.block());
        let [w, h] = block;
        let strip = |top: u32| {
            let mut aims = Vec::new();
            for left in (0..size.width()).step_by(TILE as usize) {
                for row in (0..TILE.min(size.height() - top)).step_by(h as usize) {
                    for column in (left..(left + TILE).min(size.width())).step_by(w as usize) {
                        aims.push(Aim { column, row, dir: directions(camera, block, [column, top + row]) });
                    }
                }
            }
            aims
        };
        let strips = (0..size.height()).step_by(TILE as usize).map(strip).collect();
        let whole = size.width() % w == 0 && size.height() % h == 0;
        Self { size, block, whole, eye: camera.eye(), strips }
    }

    /// Which lanes of a packet lie within a strip of so many rows.
    fn valid(&self, aim: &Aim<W>, rows: u32) -> Valid<W> {
        let [w, h] = self.block;
        if aim.column + w <= self.size.width() && aim.row + h <= rows {
            return Valid([-1; W]);
        }
        let mut lanes = (0..h).flat_map(|y| (0..w).map(move |x| [x, y]));
        Valid([(); W].map(|()| {
            let [x, y] = lanes.next().unwrap_or([w, h]);
            if aim.column + x < self.size.width() && aim.row + y < rows { -1 } else { 0 }
        }))
    }
}

/// Directions of a block whose first pixel is at (x, y), lanes row by row; those beyond the picture are another pixel's.
fn directions<const W: usize>(camera: &Camera, [w, h]: [u32; 2], [x, y]: [u32; 2]) -> [[f32; W]; 3] {
    let mut dir = [[0.0; W]; 3];
    let lanes = (0..h).flat_map(|row| (0..w).map(move |column| [x + column, y + row]));
    for (lane, [x, y]) in lanes.enumerate() {
        let (x, y) = (x.min(camera.size().width() - 1), y.min(camera.size().height() - 1));
        let ray = Ray::of_pixel(camera, x, y);
        for (axis, d) in dir.iter_mut().zip(ray.dir) {
            axis[lane] = d;
        }
    }
    dir
}

impl<const W: usize> Rays for Laid<W> {
    fn trace<'a>(
        &self,
        scene: &RawScene,
        mode: Mode,
        next: &dyn Fn() -> Option<Strip<'a>>,
    ) -> Result<(), EmbreeError> {
        let width = self.size.width() as usize;
        let mut packets: [Packet<W, GROWTH>; BATCH] = std::array::from_fn(|_| Packet::from_eye(self.eye));
        let mut valid: [Valid<W>; BATCH] = std::array::from_fn(|_| Valid([-1; W]));
        while let Some((strip, (ids, t))) = next() {
            let rows = u32::try_from(ids.len() / width).expect("few rows");
            for aims in self.strips[strip].chunks(BATCH) {
                for ((packet, valid), aim) in packets.iter_mut().zip(&mut valid).zip(aims) {
                    packet.aim(&aim.dir);
                    if !self.whole {
                        *valid = self.valid(aim, rows);
                    }
                }
                let asked = &mut packets[..aims.len()];
                scene.intersect_all(&valid[..aims.len()], asked, mode.coherent);
                for (packet, aim) in asked.iter().zip(aims) {
                    let (found, at) = packet.found();
                    let first = aim.row as usize * width + aim.column as usize;
                    let columns = width - aim.column as usize;
                    put(found, columns, width, &mut ids[first..]);
                    put(at, columns, width, &mut t[first..]);
                }
            }
            packets.iter().try_for_each(|packet| packet.check(mode.width))?;
        }
        Ok(())
    }
}

/// Copies a block's lanes into a layer that begins at its first pixel and has so many columns left.
#[inline]
fn put<T: Copy, const W: usize>(lanes: &[T; W], columns: usize, width: usize, layer: &mut [T]) {
    match W {
        1 => layer[0] = lanes[0],
        4 => put_rows::<T, 2>(lanes, columns, width, layer),
        _ => put_rows::<T, 4>(lanes, columns, width, layer),
    }
}

/// The same for rows of a length that the compiler knows, so that a whole row is a store and no call.
#[inline]
fn put_rows<T: Copy, const ROW: usize>(lanes: &[T], columns: usize, width: usize, layer: &mut [T]) {
    for (lanes, row) in lanes.as_chunks::<ROW>().0.iter().zip(layer.chunks_mut(width)) {
        match row.first_chunk_mut::<ROW>() {
            Some(row) if columns >= ROW => *row = *lanes,
            _ => row[..columns].copy_from_slice(&lanes[..columns]),
        }
    }
}
