//! A frame on the model: the grid is built as on each SPU, then blocks are traced as on one, stripe by stripe.
//!
//! In: a plan, a scene, a camera, and every how many blocks one is traced. Out: [`Measured`]. All is done by `optimized`'s own code;
//! the picture is whole if every block is traced. Blocks that are passed over lie on a fixed lattice, and the rest stands for them.
//! [`blocks`] measures each block by itself.

use super::machine::Spu;
use super::recorder::{Booked, Tally, record};
use contract::{Camera, Image, MISS, Scene, Size};
use optimized::camera::{BLOCK, CameraLanes};
use optimized::crew::Crew;
use optimized::frame;
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::machine::{Machine, Stage};
use optimized::plan::Plan;
use optimized::seen::{Counts, Seen, Worker};
use optimized::stripe::{NO_COLUMN, Painter, Stripe};
use optimized::{Events, RenderError};
use rayon::prelude::*;

/// From stripe to stripe the lattice moves by so many blocks.
const SHIFT: u32 = 5;

/// What a stripe of four scanlines came to.
#[derive(Clone, Copy, Debug)]
pub struct StripeTally {
    /// Of the blocks that were traced.
    pub tally: Tally,
    /// How many these are.
    pub traced: u32,
    /// Of how many.
    pub blocks: u32,
}

/// What a frame came to.
#[derive(Debug)]
pub struct Measured {
    /// What the camera's rays read.
    pub seen: Seen,
    /// Building the grid, once.
    pub voxelize: Tally,
    /// Stripe by stripe from the top.
    pub stripes: Vec<StripeTally>,
    /// Of all blocks that were traced.
    pub trace: Tally,
    /// What these counted themselves.
    pub counts: Counts,
    /// What the scene did that the plan does not allow.
    pub events: Events,
    /// The picture; background where nothing was traced.
    pub image: Image,
}

impl Measured {
    /// Blocks that were traced, and all.
    #[must_use]
    pub fn blocks(&self) -> [u64; 2] {
        let sum = |of: fn(&StripeTally) -> u32| self.stripes.iter().map(|s| u64::from(of(s))).sum();
        [sum(|s| s.traced), sum(|s| s.blocks)]
    }

    /// By how much what was traced is to be multiplied.
    #[must_use]
    pub fn scale(&self) -> f64 {
        let [traced, blocks] = self.blocks();
        blocks as f64 / traced as f64
    }
}

/// Measures a frame with values as IEEE 754 has them, by the host's scalar machine.
///
/// # Errors
/// As [`measure`].
pub fn measure_nearest(
    plan: Plan,
    scene: &Scene,
    camera: &Camera,
    every: u32,
    row_done: &dyn Fn(),
) -> Result<Measured, RenderError> {
    measure(Spu(Scalar), plan, scene, camera, every, row_done)
}

/// Measures a frame, tracing one block of `every`; `row_done` is called after each stripe.
///
/// # Errors
/// [`RenderError`] if the plan refuses what the scene does.
pub fn measure<V: Machine + Send + Sync>(
    m: Spu<V>,
    plan: Plan,
    scene: &Scene,
    camera: &Camera,
    every: u32,
    row_done: &dyn Fn(),
) -> Result<Measured, RenderError> {
    let mut events = Events::default();
    let (seen, voxelize) = record(|| {
        m.stage(Stage::Voxelize);
        Seen::new(m, plan, scene, camera, &mut Memory::default(), &mut events, &Crew::alone())
    });
    let seen = seen?;
    let mut image = Image::new(camera.size(), scene.background())?;
    let (width, every) = (camera.size().width() as usize, every.max(1));
    let rows = width * BLOCK as usize;
    let (mut stripes, mut trace, mut worker) = (Vec::new(), Tally::default(), Worker::default());
    let layers = image.ids.chunks_mut(rows).zip(image.t.chunks_mut(rows)).zip(image.rgba.chunks_mut(rows));
    for (y, ((ids, t), rgba)) in (0..).step_by(BLOCK as usize).zip(layers) {
        let columns = &mut [NO_COLUMN];
        let mut stripe = Stripe { y, width, ids, t, rgba, columns };
        let blocks = camera.size().width().div_ceil(BLOCK);
        let first = y / BLOCK * SHIFT % every;
        let mut traced = 0;
        let ((), tally) = record(|| {
            let (lanes, painter) = (CameraLanes::new(m, camera), Painter::new(m, scene, camera));
            for x in (first.min(blocks - 1)..blocks).step_by(every as usize) {
                let at = [x * BLOCK, y];
                let kit = (&lanes, &painter);
                frame::block(m, &seen, scene, camera, kit, None, at, &mut stripe, &mut worker);
                traced += 1;
            }
        });
        trace += tally;
        stripes.push(StripeTally { tally, traced, blocks });
        row_done();
    }
    Ok(Measured { seen, voxelize, stripes, trace, counts: worker.counts, events, image })
}

/// What one block came to.
#[derive(Clone, Copy, Debug)]
pub struct BlockTally {
    /// Its first pixel.
    pub at: [u32; 2],
    /// What was booked for it: making, tracing and colouring its rays.
    pub booked: Booked,
    /// What its packets counted themselves.
    pub counts: Counts,
    /// Pixels of it that hit a sphere.
    pub hits: u32,
}

/// A frame block by block.
#[derive(Debug)]
pub struct Blocks {
    /// What the camera's rays read.
    pub seen: Seen,
    /// Row by row from the top, each from left to right.
    pub blocks: Vec<BlockTally>,
}

/// Measures each block by itself, several rows of them side by side; `row_done` is called after each. A branch is hinted anew in each, so
/// that the hints of all blocks together may be more than those of [`measure`]; all else is the same.
///
/// # Errors
/// As [`measure`].
pub fn blocks(
    plan: Plan,
    scene: &Scene,
    camera: &Camera,
    row_done: &(dyn Fn() + Sync),
) -> Result<Blocks, RenderError> {
    let (m, mut events) = (Spu(Scalar), Events::default());
    let seen = Seen::new(m, plan, scene, camera, &mut Memory::default(), &mut events, &Crew::alone())?;
    let rows: Vec<u32> = (0..camera.size().height()).step_by(BLOCK as usize).collect();
    let row = |y: &u32| {
        let row = row_of_blocks(m, &seen, scene, camera, *y);
        row_done();
        row
    };
    let blocks: Result<Vec<Vec<BlockTally>>, RenderError> = rows.par_iter().map(row).collect();
    Ok(Blocks { blocks: blocks?.concat(), seen })
}

fn row_of_blocks<V: Machine>(
    m: Spu<V>,
    seen: &Seen,
    scene: &Scene,
    camera: &Camera,
    y: u32,
) -> Result<Vec<BlockTally>, RenderError> {
    let size = camera.size();
    let rows = BLOCK.min(size.height() - y);
    let mut image = Image::new(Size::new(size.width(), rows)?, scene.background())?;
    let mut tallies = Vec::new();
    // What is made once can be used from the beginning of each block: by its own clock, and not by that of what came before.
    let ((lanes, painter), _) = record(|| (CameraLanes::new(m, camera), Painter::new(m, scene, camera)));
    for x in (0..size.width()).step_by(BLOCK as usize) {
        let width = size.width() as usize;
        let (ids, t, rgba) = (&mut image.ids, &mut image.t, &mut image.rgba);
        let mut stripe = Stripe { y, width, ids, t, rgba, columns: &mut [NO_COLUMN] };
        let mut worker = Worker::default();
        let kit = (&lanes, &painter);
        let ((), tally) =
            record(|| frame::block(m, seen, scene, camera, kit, None, [x, y], &mut stripe, &mut worker));
        let columns = x as usize..((x + BLOCK) as usize).min(width);
        let hits =
            image.ids.chunks(width).map(|row| row[columns.clone()].iter().filter(|id| **id != MISS).count());
        let hits = u32::try_from(hits.sum::<usize>()).unwrap_or(u32::MAX);
        tallies.push(BlockTally { at: [x, y], booked: tally.total(), counts: worker.counts, hits });
    }
    Ok(tallies)
}
