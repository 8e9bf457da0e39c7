//! One block of the picture and all that its packet did, as the shipped tracer noted it.
//!
//! In: what a frame prepared, and the block's first pixel. Out: its slices, the cells that were visited in their order, and each sphere it
//! met with what became of it.

use super::{FigureError, Input};
use crate::spu::model::BlockTally;
use crate::watch::{Note, watched};
use contract::{Camera, Scene};
use optimized::camera::{BLOCK, CameraLanes, middles};
use optimized::frustum::{Bundle, Heading, Slices};
use optimized::host::Scalar;
use optimized::machine::{LANES, Site};
use optimized::seen::{Counts, Seen};
use optimized::sphere::NONE;

/// What became of a sphere that a packet met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fate {
    /// Outside one of the frustum's planes.
    Culled,
    /// Intersected with sixteen rays, and seen by none.
    InVain,
    /// Seen by a ray of the block.
    Seen,
}

/// A sphere and its fate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Met {
    /// Its id.
    pub id: u32,
    /// What became of it.
    pub fate: Fate,
    /// How often it was met: once for each visited cell that lists it.
    pub times: u32,
}

/// A block and what its packet did.
#[derive(Clone, Debug)]
pub struct Walked {
    /// First pixel.
    pub at: [u32; 2],
    /// Major axis and sense of its rays.
    pub heading: Heading,
    /// Lowest and highest slope on the second and third axis.
    pub slopes: [[f32; 2]; 2],
    /// Of each ray on both.
    pub slope: [[f32; LANES]; 2],
    /// How far along the major axis each ray's hit is, infinite for a miss.
    pub reached: [f32; LANES],
    /// Its slices.
    pub slices: Slices,
    /// Visited cells in their order: number of the slice, j, k.
    pub cells: Vec<[i32; 3]>,
    /// The spheres it met, each once, in the order in which they were met first.
    pub met: Vec<Met>,
    /// What the packet counted itself.
    pub counts: Counts,
}

/// The first pixel of the block to look at.
///
/// # Errors
/// [`FigureError::Beyond`] for a pixel that is none.
pub fn chosen(input: &Input<'_>, blocks: &[BlockTally]) -> Result<[u32; 2], FigureError> {
    let size = [input.camera.size().width(), input.camera.size().height()];
    if let Some(pixel) = input.pixel {
        if (0..2).any(|i| pixel[i] >= size[i]) {
            return Err(FigureError::Beyond { pixel, size });
        }
        return Ok(pixel.map(|x| x / BLOCK * BLOCK));
    }
    // Of equals the first; a block whose rays go one by one has no frustum.
    let rank = |block: &BlockTally| (block.counts.split_blocks == 0, block.hits > 0, block.counts.cells);
    let best = blocks.iter().rev().max_by_key(|block| rank(block));
    Ok(best.map_or([0, 0], |block| block.at))
}

/// Traces a block under watch.
///
/// # Errors
/// [`FigureError`] if there is no grid, the block's rays share no major axis, or they pass the grid by.
pub fn walked(seen: &Seen, scene: &Scene, camera: &Camera, at: [u32; 2]) -> Result<Walked, FigureError> {
    let grid = seen.grid.as_ref().ok_or(FigureError::NoGrid)?;
    let (xs, ys) = middles(Scalar, camera, at[0], at[1]);
    let block = CameraLanes::new(Scalar, camera).block(Scalar, xs, ys);
    let bundle = Bundle::of_block(Scalar, &block).ok_or(FigureError::Split { at })?;
    let packet = watched(seen, scene, block.dir);
    let (mut cells, mut met) = (Vec::new(), Vec::<Met>::new());
    let mut last = 0;
    for note in &packet.notes {
        match *note {
            Note::Cell { slice, j, k, live: true } => {
                cells.push([i32::try_from(slice).unwrap_or(i32::MAX), j, k]);
            }
            Note::Sphere(id) => {
                last = met.iter().position(|met| met.id == id).unwrap_or(met.len());
                if last == met.len() {
                    let seen = packet.ids.contains(&id.cast_signed());
                    let fate = if seen { Fate::Seen } else { Fate::InVain };
                    met.push(Met { id, fate, times: 0 });
                }
                met[last].times += 1;
            }
            Note::Any(Site::Culled, lanes) if lanes != 0 => met[last].fate = Fate::Culled,
            _ => {}
        }
    }
    if cells.is_empty() {
        return Err(FigureError::Outside { at });
    }
    let reached = std::array::from_fn(|lane| {
        if packet.ids[lane] == NONE { f32::INFINITY } else { packet.t[lane] * bundle.speed[lane] }
    });
    Ok(Walked {
        at,
        heading: bundle.frustum.heading,
        slopes: bundle.frustum.slope_arrays(Scalar),
        slope: bundle.slope,
        reached,
        slices: bundle.frustum.slices(Scalar, seen.eye, grid, seen.plan.margins),
        cells,
        met,
        counts: packet.counts,
    })
}
