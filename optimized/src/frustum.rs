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
//! u ([`Machine::unit`]), product and sum round once each, in all at most 4u (|eye_Y| + A1) as the slope is at most 1; we take
//! off and put on 16u (|eye_Y| + A_max), A_max the largest distance of any plane ([`pad`]). So if a point P of a ray lies in
//! slice i (grid's module text), its Y lies between the two, and by monotony of the cell map its cell is in the
//! rectangle. (`tests/margins.rs` runs this on floats of few bits, and finds that 2u is too little and 4u is not.) Each slice is evaluated afresh, sixteen at a time, one a lane; nothing is summed up from slice to slice.
//!
//! Where spheres are listed by centre, the cell of P need not list them, but that of the centre does, which is within
//! w = [`Grid::widen`] of P on each axis. So a slice takes in what the packet passes from A0 − w to A1 + w, and its
//! rectangle reaches w farther on each side; w counts into A_max.

use crate::camera::Block;
use crate::grid::{Grid, MAX_CELLS};
use crate::machine::{Chore, LANES, Machine, Site, three};
use crate::plan::Margins;

const _: () = assert!(MAX_CELLS.is_multiple_of(LANES));

/// What rounding may take off the bounds of a slice or put on, in scene units: 16u (|eye| + farthest), the eye's coordinate on a minor axis
/// and the largest distance of any plane on the major one.
#[inline(always)]
#[must_use]
pub fn pad(unit: f32, eye: f32, farthest: f32) -> f32 {
    16.0 * unit * (eye.abs() + farthest)
}

/// 1 + 16u: more than the roundings of t |d_X| and of a slice's distance.
#[inline(always)]
#[must_use]
pub fn beyond(unit: f32) -> f32 {
    1.0 + 16.0 * unit
}

/// The rays that move most along one axis, in one sense.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heading {
    /// Major axis (0, 1, 2), then the other two.
    pub order: [usize; 3],
    /// Whether the rays go towards larger coordinates on it.
    pub forward: bool,
}

/// The rays of a heading whose slopes lie in a range: what bounds a packet.
#[derive(Clone, Copy)]
pub struct Frustum<M: Machine> {
    /// Where they go.
    pub heading: Heading,
    /// Lowest and highest slope of the second and the third axis, in every lane.
    pub slopes: [[M::F; 2]; 2],
}

/// The rays of a block, bounded.
#[derive(Clone, Copy)]
pub struct Bundle<M: Machine> {
    /// What bounds them.
    pub frustum: Frustum<M>,
    /// |d_X| of each ray.
    pub speed: M::F,
    /// d_Y/|d_X| and d_Z/|d_X| of each ray.
    pub slope: [M::F; 2],
}

/// Where a packet is in sixteen slices, on one of the minor axes.
#[derive(Clone, Copy)]
pub struct Extent<M: Machine> {
    /// Lowest coordinate, in scene units.
    pub low: M::F,
    /// Highest coordinate.
    pub high: M::F,
    /// The slice lies behind the eye: the packet is not in it, whatever the other two say.
    pub behind: M::B,
}

/// The slices of a grid in the order in which a packet meets them, and what of each it may touch.
#[derive(Clone, Copy, Debug)]
pub struct Slices {
    /// How many there are.
    pub count: usize,
    /// First cell on the second and third axis.
    pub first: [[i32; MAX_CELLS]; 2],
    /// Last cell; below the first if the packet touches nothing of the slice.
    pub last: [[i32; MAX_CELLS]; 2],
    /// Distance of each slice's far plane from the eye, along the major axis.
    pub far: [f32; MAX_CELLS],
}

impl Slices {
    /// Whether the packet touches nothing of a slice.
    #[inline(always)]
    #[must_use]
    pub fn is_empty(&self, slice: usize) -> bool {
        self.last[0][slice] < self.first[0][slice] || self.last[1][slice] < self.first[1][slice]
    }
}

impl Heading {
    /// All six.
    #[must_use]
    pub fn all() -> [Self; 6] {
        [0, 1, 2, 3, 4, 5].map(|i| Self::new(i % 3, i < 3))
    }

    /// Along an axis, towards larger coordinates or smaller ones.
    #[must_use]
    pub fn new(axis: usize, forward: bool) -> Self {
        Self { order: [axis, (axis + 1) % 3, (axis + 2) % 3], forward }
    }

    /// A vector's components along the major axis, in the rays' sense, and the other two.
    #[inline(always)]
    #[must_use]
    pub fn along(&self, v: [f32; 3]) -> [f32; 3] {
        let [x, y, z] = three(
            self.order,
            #[inline(always)]
            |i| v[i],
        );
        [if self.forward { x } else { -x }, y, z]
    }

    /// From where to where a slice reaches in the rays' sense, if on the axis it reaches from `lower` to `upper` of the eye.
    #[inline(always)]
    #[must_use]
    pub fn ahead(&self, [lower, upper]: [f32; 2]) -> [f32; 2] {
        if self.forward { [lower, upper] } else { [-upper, -lower] }
    }

    /// Kernel: the same of sixteen vectors.
    #[inline(always)]
    pub fn along_lanes<M: Machine>(&self, m: M, v: [M::F; 3]) -> [M::F; 3] {
        let [x, y, z] = three(
            self.order,
            #[inline(always)]
            |i| v[i],
        );
        [if self.forward { x } else { m.neg(x) }, y, z]
    }

    /// Kernel: which rays of those components have this heading.
    #[inline(always)]
    pub fn has<M: Machine>(&self, m: M, [speed, y, z]: [M::F; 3]) -> M::B {
        let stray = m.or(m.le(speed, m.splat(0.0)), m.or(steeper(m, y, speed), steeper(m, z, speed)));
        m.not(stray)
    }

    /// Where a sphere's centre is from the eye, along (A, Y, Z); `f` is eye − centre.
    #[inline(always)]
    #[must_use]
    pub fn towards(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        self.along([-x, -y, -z])
    }

    /// The index in the grid of the slice that is met as number `s` of `count`.
    #[inline(always)]
    #[must_use]
    pub fn slice_index(&self, count: usize, s: usize) -> usize {
        if self.forward { s } else { count - 1 - s }
    }
}

impl<M: Machine> Bundle<M> {
    /// The rays of a block; `None` if they do not share a major axis and sense.
    #[inline(always)]
    pub fn of_block(m: M, block: &Block<M>) -> Option<Self> {
        let first = three(
            block.dir,
            #[inline(always)]
            |d| m.first(d),
        );
        let axis = major(first);
        let heading = Heading::new(axis, first[axis] > 0.0);
        let [speed, y, z] = heading.along_lanes(m, block.dir);
        if m.any(m.not(heading.has(m, [speed, y, z])), Site::Incoherent) {
            return None;
        }
        let slope = [m.div(y, speed), m.div(z, speed)];
        let slopes = [range(m, slope[0]), range(m, slope[1])];
        Some(Self { frustum: Frustum { heading, slopes }, speed, slope })
    }
}

impl<M: Machine> Frustum<M> {
    /// Rim: the slopes as plain numbers.
    #[inline(always)]
    pub fn slope_arrays(&self, m: M) -> [[f32; 2]; 2] {
        let [[lo_y, hi_y], [lo_z, hi_z]] = self.slopes;
        [[m.first(lo_y), m.first(hi_y)], [m.first(lo_z), m.first(hi_z)]]
    }

    /// The slices in the order in which the packet meets them.
    #[inline(always)]
    pub fn slices(&self, m: M, eye: [f32; 3], grid: &Grid, margins: Margins) -> Slices {
        let axis = &grid.axes[self.heading.order[0]];
        let count = axis.n.unsigned_abs() as usize;
        let mut slices =
            Slices { count, first: [[0; MAX_CELLS]; 2], last: [[-1; MAX_CELLS]; 2], far: [-1.0; MAX_CELLS] };
        let mut near = [0.0; MAX_CELLS];
        let position = eye[self.heading.order[0]];
        for (s, (near, far)) in near.iter_mut().zip(&mut slices.far).take(count).enumerate() {
            let index = self.heading.slice_index(count, s);
            let (lower, upper) = (axis.planes[index], axis.planes[index + 1]);
            [*near, *far] = self.heading.ahead([lower - position, upper - position]);
        }
        m.beside(
            Chore::Distances(count),
            #[inline(always)]
            || (),
        );
        let farthest = slices.far[count - 1].abs() + grid.widen;
        for start in (0..count).step_by(LANES) {
            let part = start..start + LANES;
            let (near, far) = (part_of(m, &near, start), part_of(m, &slices.far, start));
            for side in 0..2 {
                let eye = eye[self.heading.order[side + 1]];
                let pad = if margins == Margins::Derived { pad(m.unit(), eye, farthest) } else { 0.0 };
                let [first, last] = self.rectangle(m, side, eye, grid, near, far, pad);
                slices.first[side][part.clone()].copy_from_slice(&m.to_array_i(first));
                slices.last[side][part.clone()].copy_from_slice(&m.to_array_i(last));
            }
        }
        slices
    }

    /// Kernel: first and last cell on one of the minor axes in slices that reach from `near` to `far`, one slice a lane.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "a kernel takes values")]
    fn rectangle(
        &self,
        m: M,
        side: usize,
        eye: f32,
        grid: &Grid,
        near: M::F,
        far: M::F,
        pad: f32,
    ) -> [M::I; 2] {
        let axis = &grid.axes[self.heading.order[side + 1]];
        let Extent { low, high, behind } = self.extent(m, side, eye, grid.widen, near, far, pad);
        let (start, end) = (m.splat(axis.planes[0]), m.splat(axis.planes[axis.planes.len() - 1]));
        let outside = m.or(m.lt(high, start), m.lt(end, low));
        let last = m.select_i(m.or(behind, outside), m.splat_i(-1), axis.cell(m, high));
        [axis.cell(m, low), last]
    }

    /// Kernel: where the packet is on one of the minor axes in slices that reach from `near` to `far` of the eye, one slice a lane;
    /// `widen` farther all around, and `pad` for rounding ([`pad`]). Lengths are in scene units.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "a kernel takes values")]
    pub fn extent(
        &self,
        m: M,
        side: usize,
        eye: f32,
        widen: f32,
        near: M::F,
        far: M::F,
        pad: f32,
    ) -> Extent<M> {
        let (zero, widen, eye) = (m.splat(0.0), m.splat(widen), m.splat(eye));
        let (near, far) = (m.sub(near, widen), m.add(far, widen));
        let behind = m.lt(far, zero);
        let near = m.max(near, zero);
        let [lo, hi] = self.slopes[side];
        let border = m.add(widen, m.splat(pad));
        let low = m.sub(m.add(eye, m.min(m.mul(lo, near), m.mul(lo, far))), border);
        let high = m.add(m.add(eye, m.max(m.mul(hi, near), m.mul(hi, far))), border);
        Extent { low, high, behind }
    }
}

/// Rim: sixteen of the numbers.
#[inline(always)]
fn part_of<M: Machine>(m: M, values: &[f32; MAX_CELLS], start: usize) -> M::F {
    let mut lanes = [0.0; LANES];
    lanes.copy_from_slice(&values[start..start + LANES]);
    m.lanes(lanes)
}

/// Where a ray moves faster along d than along the major axis.
#[inline(always)]
fn steeper<M: Machine>(m: M, d: M::F, speed: M::F) -> M::B {
    m.lt(speed, m.max(d, m.neg(d)))
}

/// Lowest and highest slope of all rays.
#[inline(always)]
fn range<M: Machine>(m: M, slope: M::F) -> [M::F; 2] {
    [m.smallest(slope), m.largest(slope)]
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
