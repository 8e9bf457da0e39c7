//! What lies in an SPU's local store of 256 KiB, where program and data share the room and nothing is fetched by itself.
//!
//! In: a plan, the sizes of scene, grid and picture. Out: a [`Map`]. A scene that does not fit is refused with the map.
//!
//! *The program's size is estimated from the model*: a block that meets one sphere in one cell of a grid of one cell goes through
//! every kernel once, so the instructions that are booked for it, 4 bytes each, are about what lies in memory. Start-up, libraries
//! and what a compiler unrolls are not among them, by which the map errs low. *The stack* is an allowance of ours.

use super::machine::Spu;
use super::predict::INSTRUCTION;
use super::recorder::record;
use contract::{Camera, DEFAULT_LIGHT, Image, Scene, Size, Sphere};
use optimized::camera::{BLOCK, CameraLanes};
use optimized::crew::Crew;
use optimized::frame;
use optimized::grid::{Grid, Memory};
use optimized::host::Scalar;
use optimized::plan::{Cells, Plan, Resolution};
use optimized::seen::{Seen, Worker};
use optimized::stripe::{NO_COLUMN, Painter, Stripe};
use optimized::{Events, RenderError};
use serde::Serialize;
use std::fmt;
use thiserror::Error;

/// Bytes of a local store.
pub const CAPACITY: u64 = 256 * 1024;
/// Of a cell that is a queue.
pub const QUEUE: u64 = 32;
/// Of a sphere: centre and radius (the paper).
pub const SPHERE: u64 = 16;
/// Of its colour, for which those have no room.
pub const COLOR: u64 = 4;
/// Of a pixel.
pub const PIXEL: u64 = 4;
/// Of what is kept of a slice: a rectangle of four numbers and two distances.
pub const SLICE: u64 = 24;
/// For the stack, an allowance.
pub const STACK: u64 = 4 * 1024;

/// How many buffers there are for pixels: with two, one is written to memory while the other is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Buffers {
    /// One.
    Single,
    /// Two.
    Double,
}

/// Bytes by what they hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Map {
    /// The program, estimated.
    pub code: u64,
    /// Cells and what they list.
    pub grid: u64,
    /// Centres and radii.
    pub spheres: u64,
    /// Colours.
    pub colors: u64,
    /// Pixels of four scanlines, once or twice.
    pub pixels: u64,
    /// What is kept of slices.
    pub slices: u64,
    /// The stack.
    pub stack: u64,
}

/// A scene that does not fit.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("the local store holds {CAPACITY} bytes, {} are needed:\n{map}", map.total())]
pub struct LocalStoreFull {
    /// What would lie where.
    pub map: Map,
}

impl Map {
    /// The map of a scene of so many spheres.
    #[must_use]
    pub fn new(code: u64, grid: u64, spheres: usize, width: u32, slices: u64, buffers: Buffers) -> Self {
        let buffers = match buffers {
            Buffers::Single => 1,
            Buffers::Double => 2,
        };
        Self {
            code,
            grid,
            spheres: SPHERE * spheres as u64,
            colors: COLOR * spheres as u64,
            pixels: buffers * PIXEL * u64::from(BLOCK) * u64::from(width),
            slices: SLICE * slices,
            stack: STACK,
        }
    }

    /// All of it.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.code + self.grid + self.spheres + self.colors + self.pixels + self.slices + self.stack
    }

    /// Itself if it fits.
    ///
    /// # Errors
    /// [`LocalStoreFull`] with the map.
    pub fn fits(self) -> Result<Self, LocalStoreFull> {
        if self.total() <= CAPACITY { Ok(self) } else { Err(LocalStoreFull { map: self }) }
    }

    /// The most spheres for which it would fit, all else being so large.
    #[must_use]
    pub fn most_spheres(&self) -> u64 {
        let rest = self.total() - self.spheres - self.colors;
        CAPACITY.saturating_sub(rest) / (SPHERE + COLOR)
    }
}

impl fmt::Display for Map {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            ("code, estimated", self.code),
            ("grid", self.grid),
            ("spheres, 16 bytes each", self.spheres),
            ("their colours, 4 bytes each", self.colors),
            ("pixels of four scanlines", self.pixels),
            ("slices", self.slices),
            ("stack, an allowance", self.stack),
        ];
        for (what, bytes) in parts {
            writeln!(f, "  {what:<28}{bytes:>8}")?;
        }
        let (total, free) = (self.total(), CAPACITY.checked_sub(self.total()));
        match free {
            Some(free) => write!(f, "  {:<28}{total:>8}, {free} free", "in all"),
            None => write!(f, "  {:<28}{total:>8}, {} too many", "in all", total - CAPACITY),
        }
    }
}

/// Bytes of a grid as the SPU would hold it: queues, or offsets of 4 bytes and ids of 2.
#[must_use]
pub fn grid_bytes(grid: &Grid) -> u64 {
    let cells: u64 = grid.axes.iter().map(|axis| u64::from(axis.n.unsigned_abs())).product();
    if grid.has_queues() {
        return QUEUE * cells;
    }
    let mut ids = 0;
    for cell in 0..usize::try_from(cells).unwrap_or(usize::MAX) {
        grid.for_each_id(cell, true, |_| ids += 1);
    }
    4 * (cells + 1) + 2 * ids
}

/// Bytes of a grid of queues.
#[must_use]
pub fn queue_bytes(cells_on_axis: u64) -> u64 {
    QUEUE * cells_on_axis.pow(3)
}

/// Bytes of the program, estimated as the module's text says.
///
/// # Errors
/// [`RenderError`] if the plan refuses a scene of one sphere.
///
/// # Panics
/// Never: scene, camera and picture are made of numbers that are in range.
pub fn code_bytes(plan: Plan) -> Result<u64, RenderError> {
    let plan = Plan { resolution: Resolution::Fixed(1), ..plan };
    let sphere = Sphere { center: [0.0; 3], radius: 1.0, color: [200; 3] };
    let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("a sphere is a scene");
    let size = Size::new(BLOCK, BLOCK).expect("a block is a picture");
    let (corner, du, dv) = ([-0.2, 0.2, -5.0], [0.1, 0.0, 0.0], [0.0, -0.1, 0.0]);
    let camera = Camera::new([0.0, 0.0, 5.0], corner, du, dv, size).expect("it has an area");
    let mut image = Image::new(size, [0; 3])?;
    let m = Spu(Scalar);
    let (built, tally) = record(|| {
        let seen = Seen::new(
            m,
            plan,
            &scene,
            &camera,
            &mut Memory::default(),
            &mut Events::default(),
            &Crew::alone(),
        )?;
        let (lanes, painter) = (CameraLanes::new(m, &camera), Painter::new(m, &scene, &camera));
        let width = size.width() as usize;
        let (ids, t, rgba) = (&mut image.ids, &mut image.t, &mut image.rgba);
        let mut stripe = Stripe { y: 0, width, ids, t, rgba, columns: &mut [NO_COLUMN] };
        let mut worker = Worker::default();
        frame::block(m, &seen, &scene, &camera, (&lanes, &painter), None, [0, 0], &mut stripe, &mut worker);
        Ok(())
    });
    built.map(|()| {
        let all = tally.total();
        INSTRUCTION * (all.even + all.odd)
    })
}

/// Whether a plan's grid has a fixed size, and which: cells on an axis if they are queues.
#[must_use]
pub fn fixed_queues(plan: &Plan) -> Option<u64> {
    match (plan.cells, plan.resolution) {
        (Cells::Queue, Resolution::Fixed(n)) => Some(n.into()),
        _ => None,
    }
}
