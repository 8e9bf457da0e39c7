//! Through the grid: slice by slice from the eye outward, in each slice the packet's rectangle of cells, in each
//! cell its spheres (Wald et al. 2006; the paper's Figure 3, top).
//!
//! The walk ends early when no later slice can win. A sphere not yet met is listed, if it has a hit that wins, in
//! the slice of that hit's point P (the lemma of [`crate::margin`]). If for every ray the nearest hit so far lies, by
//! A = t |d_X|, strictly before the end of the current slice, then so does any P with a smaller or equal t, and its
//! slice has been visited. A is computed with two roundings and enlarged by 2⁻²⁰ to cover them.

use crate::camera::Block;
use crate::frame::Seen;
use crate::frustum::Frustum;
use crate::grid::Grid;
use crate::machine::{LANES, Machine, Site};
use crate::sphere::Nearest;

/// 1 + 2⁻²⁰: more than the roundings of t |d_X| and of a slice's distance.
const BEYOND: f32 = 1.0 + 1.0 / (1u32 << 20) as f32;

/// The nearest hit of each ray of a packet.
#[inline(always)]
pub fn walk<M: Machine>(
    m: M,
    seen: &Seen,
    grid: &Grid,
    block: &Block<M>,
    frustum: &Frustum<M>,
) -> Nearest<M> {
    let mut nearest = Nearest::none(m);
    let axis = &grid.axes[frustum.order[0]];
    let (slices, strides) = (axis.n.unsigned_abs() as usize, grid.strides());
    let stride = frustum.order.map(|i| strides[i]);
    let eye = seen.eye[frustum.order[0]];
    // Slice number `s` in walking order, and the distances of its two planes from the eye.
    let index = |s: usize| if frustum.forward { s } else { slices - 1 - s };
    let distances = |s: usize| {
        let (lower, upper) = (axis.planes[index(s)], axis.planes[index(s) + 1]);
        if frustum.forward { [lower - eye, upper - eye] } else { [eye - upper, eye - lower] }
    };
    let farthest = distances(slices - 1)[1];

    for start in (0..slices).step_by(LANES) {
        let (mut near, mut far) = ([0.0; LANES], [-1.0; LANES]);
        for (lane, s) in (start..slices.min(start + LANES)).enumerate() {
            [near[lane], far[lane]] = distances(s);
        }
        let r = frustum.rectangles(m, seen.eye, grid, m.lanes(near), m.lanes(far), farthest);
        for (lane, s) in (start..slices.min(start + LANES)).enumerate() {
            let mut visited = false;
            for j in r.first[0][lane]..=r.last[0][lane] {
                for k in r.first[1][lane]..=r.last[1][lane] {
                    let (j, k) = (j.unsigned_abs() as usize, k.unsigned_abs() as usize);
                    for &id in grid.cell(index(s) * stride[0] + j * stride[1] + k * stride[2]) {
                        nearest =
                            nearest.meet(m, seen.form, block, &seen.spheres[id as usize], id.cast_signed());
                        visited = true;
                    }
                }
            }
            if visited && finished(m, frustum, &nearest, far[lane]) {
                return nearest;
            }
        }
    }
    nearest
}

/// Kernel: whether every ray's nearest hit lies before distance `far`.
#[inline(always)]
fn finished<M: Machine>(m: M, frustum: &Frustum<M>, nearest: &Nearest<M>, far: f32) -> bool {
    let reached = m.mul(m.mul(nearest.t, frustum.speed), m.splat(BEYOND));
    !m.any(m.not(m.le(reached, m.splat(far))), Site::Unfinished)
}
