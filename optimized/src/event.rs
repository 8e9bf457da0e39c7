//! What a scene did that a plan's choices do not allow, as data with the place and the numbers.

use crate::plan::Plan;
use contract::{Size, SizeError};
use thiserror::Error;

/// A broken precondition.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Event {
    /// A seventeenth sphere was pushed onto a queue; the oldest fell out.
    #[error("cell {cell:?} is full: sphere {pushed} pushed out sphere {lost}; a queue holds 16")]
    CellFull {
        /// The cell on each axis.
        cell: [i32; 3],
        /// The id that came.
        pushed: u32,
        /// The id that went.
        lost: u32,
    },
    /// A sphere's box spans more than two cells on an axis, so its eight corners miss a cell between.
    #[error("sphere {sphere} spans {cells} cells on axis {axis}; eight corners reach two")]
    SpansCells {
        /// Its id.
        sphere: u32,
        /// 0, 1 or 2.
        axis: usize,
        /// Cells from first to last.
        cells: i32,
    },
    /// Ids need more than two bytes, of which one value means empty.
    #[error("{spheres} spheres; ids of 2 bytes number at most {limit}", limit = crate::queue::MAX_IDS)]
    TooManyIds {
        /// Spheres of the scene.
        spheres: usize,
    },
    /// Positions, radii or directions so large or small that a step of the form over- or underflows, for which no margin
    /// is derived ([`crate::margin::in_range`]).
    #[error("the scene is out of the range for which margins are derived")]
    OutOfRange,
}

/// The events of a frame: how many, and the first of them in full.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Events {
    first: Vec<Event>,
    count: u64,
}

impl Events {
    /// The most events that are kept in full.
    pub const KEPT: usize = 10_000;

    /// Adds one.
    pub fn push(&mut self, event: Event) {
        self.count += 1;
        if self.first.len() < Self::KEPT {
            self.first.push(event);
        }
    }

    /// How many there were.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The first of them, in the order in which they were found.
    #[must_use]
    pub fn first(&self) -> &[Event] {
        &self.first
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RenderError {
    /// No memory for it.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The system gives no thread to a worker.
    #[error("no threads for {workers} workers: {cause}")]
    Workers {
        /// As asked for.
        workers: usize,
        /// What it says.
        cause: String,
    },
    /// The plan refuses what the scene did.
    #[error("refused by the plan: {0}")]
    Refused(Event),
    /// A resolution of zero or above the limit.
    #[error("a grid of {cells} cells on an axis; it must be from 1 to {limit}", limit = crate::grid::MAX_CELLS)]
    Resolution {
        /// As asked for.
        cells: u8,
    },
    /// Lists that do not fit: more ids than u32 can number or memory holds, in a single cell or in as many as a plan asks for that refuses
    /// a coarser grid.
    #[error("the lists of a grid of {cells:?} cells do not fit, in 32 bits or in memory")]
    Lists {
        /// Cells on each axis.
        cells: [i32; 3],
    },
    /// A plan with tiles that lacks what these need.
    #[error("tiles need spheres listed once, by centre in lists, certified arithmetic, derived margins, and 1 to {limit} blocks on a side; the plan is: {plan}", limit = crate::tile::MAX_SIDE)]
    Tile {
        /// The plan.
        plan: Plan,
    },
    /// What a clairvoyant frame was given belongs to another scene.
    #[error("what is known names sphere {id}, the scene has {spheres}")]
    KnownId {
        /// The first such id.
        id: u32,
        /// Spheres of the scene.
        spheres: usize,
    },
    /// What a clairvoyant frame was given belongs to another one.
    #[error("what is known belongs to a picture of {}x{}, that asked for has {}x{}", known.width(), known.height(), asked.width(), asked.height())]
    Known {
        /// Size of the picture from which it is known.
        known: Size,
        /// Size of the one asked for.
        asked: Size,
    },
}
