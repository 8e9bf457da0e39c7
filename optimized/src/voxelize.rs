//! From a sphere's box to the cells that list it: four ways.
//!
//! All but the last give every cell that a real point of the ball may lie in (the grid's text has the argument),
//! the first under the condition that is checked and reported here. By centre gives one cell, and whoever walks
//! the grid must look as far around as the largest reach.

use crate::event::Event;
use crate::grid::{Axis, Bounds};
use crate::plan::Voxelizer;

/// First and last cell of a box on each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellBox {
    /// First.
    pub lo: [i32; 3],
    /// Last.
    pub hi: [i32; 3],
}

impl CellBox {
    /// Calls `visit` with the cells in which the voxelizer lists the sphere: for eight corners and for eight distinct
    /// cells at most, each once.
    #[inline]
    pub fn for_each(
        &self,
        voxelizer: Voxelizer,
        axes: &[Axis; 3],
        ball: &Bounds,
        mut visit: impl FnMut([i32; 3]),
    ) {
        match voxelizer {
            Voxelizer::EightCorners => {
                let ends = [0, 1, 2].map(|i| (self.lo[i], self.hi[i]));
                for i in distinct(ends[0]) {
                    for j in distinct(ends[1]) {
                        for k in distinct(ends[2]) {
                            visit([i, j, k]);
                        }
                    }
                }
            }
            Voxelizer::BoxRange | Voxelizer::ByCenter => self.all(visit),
            Voxelizer::Overlap => self.all(|cell| {
                if ball.meets_cell(axes, cell) {
                    visit(cell);
                }
            }),
        }
    }

    fn all(&self, mut visit: impl FnMut([i32; 3])) {
        for i in self.lo[0]..=self.hi[0] {
            for j in self.lo[1]..=self.hi[1] {
                for k in self.lo[2]..=self.hi[2] {
                    visit([i, j, k]);
                }
            }
        }
    }

    /// The event of eight corners that miss a cell between them.
    #[must_use]
    pub fn spans(&self, sphere: u32) -> Option<Event> {
        let span = |axis: usize| self.hi[axis] - self.lo[axis] + 1;
        let axis = (0..3).find(|&axis| span(axis) > 2)?;
        Some(Event::SpansCells { sphere, axis, cells: span(axis) })
    }
}

fn distinct((lo, hi): (i32, i32)) -> impl Iterator<Item = i32> + Clone {
    std::iter::once(lo).chain((hi != lo).then_some(hi))
}

impl Bounds {
    /// Whether the ball may have a point in a cell: the distance of its centre from the cell's box, in f64 from f32
    /// numbers (error below 2⁻⁵⁰ of the square), is at most its radius enlarged by 2⁻⁴⁰.
    fn meets_cell(&self, axes: &[Axis; 3], cell: [i32; 3]) -> bool {
        let mut square = 0.0;
        for i in 0..3 {
            let index = cell[i].unsigned_abs() as usize;
            let (lo, hi) = (f64::from(axes[i].planes[index]), f64::from(axes[i].planes[index + 1]));
            let center = f64::from(self.center[i]);
            let outside = (lo - center).max(center - hi).max(0.0);
            square += outside * outside;
        }
        let radius = f64::from(self.radius);
        square <= radius * radius * (1.0 + 1.0 / (1u64 << 40) as f64)
    }
}
