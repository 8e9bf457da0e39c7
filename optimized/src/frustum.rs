//! What bounds a packet: its slopes along the major axis, and the rectangle of cells it meets in each slice.
//!
//! The major axis X is the one along which every ray of the packet moves most, all in the same sense. At
//! distance A = |P_X − eye_X| a ray is at P_Y = eye_Y + A · d_Y/|d_X|, with a slope of at most 1; likewise Z. The
//! frustum is the range of both slopes over *all* sixteen rays: by rounding, inner rays may lie outside the hull of
//! the corner rays.
//!
//! A slice reaches from plane to plane of the grid, in distances A0 <= A1 from the eye. Since a slope times A is
//! extreme at one end, the packet is in the slice between
//! eye_Y + min(lo A0, lo A1) and eye_Y + max(hi A0, hi A1). Rounding: A0, A1 and the slopes have relative error
//! u = 2⁻²⁴, product and sum round once each, in all at most 4u (|eye_Y| + A1) as the slope is at most 1; we take
//! off and put on `pad` = 16u (|eye_Y| + A_max). So if a point P of a ray lies in slice i (grid's module text), its Y
//! lies between the two, and by monotony of the cell map its cell is in the rectangle. Each slice is evaluated
//! afresh, sixteen at a time, one a lane; nothing is summed up from slice to slice.

use crate::camera::Block;
use crate::grid::Grid;
use crate::machine::{LANES, Machine, Site};

/// 16 units of f32 rounding.
const PAD: f32 = 16.0 / (1u32 << 24) as f32;

/// Rays that move most along one axis, in one sense.
#[derive(Clone, Copy)]
pub struct Frustum<M: Machine> {
    /// Major axis (0, 1, 2), then the other two.
    pub order: [usize; 3],
    /// Whether the rays go towards larger coordinates on it.
    pub forward: bool,
    /// |d_X| of each ray.
    pub speed: M::F,
    /// Lowest and highest slope of the second and the third axis.
    slopes: [[M::F; 2]; 2],
}

/// The cells that sixteen slices have in common with a packet: first and last on the second and third axis.
/// Where there are none, the last is below the first.
#[derive(Clone, Copy, Debug)]
pub struct Rectangles {
    /// First cells on the second and third axis.
    pub first: [[i32; LANES]; 2],
    /// Last cells.
    pub last: [[i32; LANES]; 2],
}

impl<M: Machine> Frustum<M> {
    /// The frustum of a block; `None` if its rays do not share a major axis and sense.
    #[inline(always)]
    pub fn of_block(m: M, block: &Block<M>) -> Option<Self> {
        let first = block.dir.map(
            #[inline(always)]
            |d| m.to_array(d)[0],
        );
        let axis = major(first);
        let forward = first[axis] > 0.0;
        let order = [axis, (axis + 1) % 3, (axis + 2) % 3];
        let [x, y, z] = order.map(
            #[inline(always)]
            |i| block.dir[i],
        );
        let speed = if forward { x } else { m.neg(x) };
        let zero = m.splat(0.0);
        let steeper = |d: M::F| m.lt(speed, m.max(d, m.neg(d)));
        let stray = m.or(m.le(speed, zero), m.or(steeper(y), steeper(z)));
        if m.any(stray, Site::Incoherent) {
            return None;
        }
        let range = |d: M::F| {
            let slope = m.div(d, speed);
            [m.smallest(slope), m.largest(slope)]
        };
        Some(Self { order, forward, speed, slopes: [range(y), range(z)] })
    }

    /// Kernel: the rectangles of the slices whose distances from the eye reach from `near` to `far`, one slice
    /// a lane. A slice behind the eye has `far < 0`.
    #[inline(always)]
    pub fn rectangles(
        &self,
        m: M,
        eye: [f32; 3],
        grid: &Grid,
        near: M::F,
        far: M::F,
        max: f32,
    ) -> Rectangles {
        let zero = m.splat(0.0);
        let behind = m.lt(far, zero);
        let near = m.max(near, zero);
        let mut rectangles = Rectangles { first: [[0; LANES]; 2], last: [[0; LANES]; 2] };
        for side in 0..2 {
            let axis = &grid.axes[self.order[side + 1]];
            let eye = eye[self.order[side + 1]];
            let [lo, hi] = self.slopes[side];
            let pad = m.splat(PAD * (eye.abs() + max));
            let low = m.min(m.mul(lo, near), m.mul(lo, far));
            let high = m.max(m.mul(hi, near), m.mul(hi, far));
            let low = m.sub(m.add(m.splat(eye), low), pad);
            let high = m.add(m.add(m.splat(eye), high), pad);
            let (start, end) = (m.splat(axis.planes[0]), m.splat(axis.planes[axis.planes.len() - 1]));
            let outside = m.or(m.lt(high, start), m.lt(end, low));
            let last = m.select_i(m.or(behind, outside), m.splat_i(-1), axis.cell(m, high));
            rectangles.first[side] = m.to_array_i(axis.cell(m, low));
            rectangles.last[side] = m.to_array_i(last);
        }
        rectangles
    }
}

/// The axis of largest magnitude, the first of equals.
fn major(d: [f32; 3]) -> usize {
    let [x, y, z] = d.map(f32::abs);
    if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    }
}
