//! The paper's four figures, drawn from a scene by the code that ships.
//!
//! In: a scene, a camera, a plan of 4x4 blocks, and a pixel if its block is to be looked at. Out: four [`Figure`]s. Nothing of the tracer is
//! written a second time: the screen's blocks cost what the SPU model books for them ([`screen`]); the walk is what the tracer's own packet
//! noted of its cells and spheres ([`block`], drawn by [`frustum`]); the loops are the shipped ones over slices of that packet ([`loops`]);
//! what a cell lists is read from the grid, and what it should list is decided in integers ([`corners`]). Refused are scenes without a grid,
//! plans without blocks, and blocks whose rays share no major axis.

pub mod block;
pub mod corners;
pub mod frustum;
pub mod loops;
pub mod page;
pub mod screen;
mod svg;

pub use svg::alone;

use crate::spu::model::{Blocks, blocks};
use contract::{Camera, Scene};
use optimized::plan::{Arithmetic, Packet, Plan};
use optimized::{Level, RenderError};
use thiserror::Error;

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// What to call the scene.
    pub name: &'a str,
    /// The scene.
    pub scene: &'a Scene,
    /// The camera. Every block is traced on a model: pictures of 320x180 pixels take a quarter of a second, of 1280x720 two.
    pub camera: &'a Camera,
    /// The plan: packets of 4x4 blocks, one of the two f32 forms.
    pub plan: Plan,
    /// A pixel of the block to look at; without one it is the block that visits most cells among those that hit something.
    pub pixel: Option<[u32; 2]>,
    /// The level at which stripes are timed on this computer.
    pub level: Level,
}

/// A drawing and what it shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// A word for files and anchors.
    pub name: &'static str,
    /// A heading.
    pub title: String,
    /// What is seen, with this scene's numbers.
    pub caption: String,
    /// An `<svg>` element that takes its colours from the page; [`alone`] makes a file of it.
    pub svg: String,
}

/// Why nothing was drawn.
#[derive(Debug, Error)]
pub enum FigureError {
    /// The tracer refuses the scene.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The model has no such packets.
    #[error("figures are of packets of one block and the two f32 forms; the plan is: {plan}")]
    Plan {
        /// The plan.
        plan: Plan,
    },
    /// There is nothing to walk through.
    #[error("the scene has no sphere, or none in the range of the margins: there is no grid to be drawn")]
    NoGrid,
    /// The pixel is none.
    #[error("pixel ({}, {}) lies beyond the picture of {}x{}", pixel[0], pixel[1], size[0], size[1])]
    Beyond {
        /// As asked for.
        pixel: [u32; 2],
        /// Of the picture.
        size: [u32; 2],
    },
    /// The block's rays go one by one.
    #[error("the rays of the block at ({}, {}) have no common major axis, so it has no frustum; name a pixel of another", at[0], at[1])]
    Split {
        /// Its first pixel.
        at: [u32; 2],
    },
    /// The block passes the grid by.
    #[error("the block at ({}, {}) comes to no cell; name a pixel of another, or a view of the scene", at[0], at[1])]
    Outside {
        /// Its first pixel.
        at: [u32; 2],
    },
}

/// All four, in the paper's order; `row_done` is called after each row of blocks.
///
/// # Errors
/// [`FigureError`] says what cannot be drawn.
pub fn figures(input: &Input<'_>, row_done: &(dyn Fn() + Sync)) -> Result<Vec<Figure>, FigureError> {
    let Blocks { seen, blocks } = traced(input, row_done)?;
    let grid = seen.grid.as_ref().ok_or(FigureError::NoGrid)?;
    let at = block::chosen(input, &blocks)?;
    let walked = block::walked(&seen, input.scene, input.camera, at)?;
    let stripes = screen::timed(input)?;
    Ok(vec![
        screen::draw(input, &blocks, &stripes, at),
        frustum::draw(input, grid, seen.eye, &walked),
        loops::draw(input, &loops::of(&walked.slices)),
        corners::draw(input, &corners::of(input.plan, input.scene, input.camera)?),
    ])
}

/// Every block on the model.
///
/// # Errors
/// [`FigureError`] for a plan without blocks, and if the tracer refuses the scene.
pub fn traced(input: &Input<'_>, row_done: &(dyn Fn() + Sync)) -> Result<Blocks, FigureError> {
    let plan = input.plan;
    if plan.packet != Packet::Block || !matches!(plan.arithmetic, Arithmetic::Rounded(_)) {
        return Err(FigureError::Plan { plan });
    }
    Ok(blocks(plan, input.scene, input.camera, row_done)?)
}
