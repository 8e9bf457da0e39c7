//! The outline of a sphere as a packet's rays see it: between which slopes it lies, and how near it comes.
//!
//! In: centres relative to the eye along (A, Y, Z), A the major axis, and radii that have been enlarged for rounding
//! ([`crate::cull::radii`]), sixteen at a time. Out: [`Outline`]. A ray whose slopes lie outside it misses the sphere; so does a
//! packet whose range of slopes does not overlap it. That is the test of the frustum's four planes ([`crate::cull`]), which
//! all go through the eye along one of the minor axes, with its square root taken once for a sphere in place of once for a packet:
//! what is left of it for a packet are four comparisons.
//!
//! # Derivation
//!
//! If a ray with slope y hits the ball of radius R around (A, Y, Z), then in the plane of the first two it comes within R of
//! (A, Y). So y lies between the slopes of the two tangents from the eye to that circle,
//!
//! ```text
//! (A Y ± R √(A² − R² + Y²)) / ((A − R) (A + R))
//! ```
//!
//! if A > R. We take them if A >= 2R; a sphere that is nearer has an outline without limits, and one that lies behind, A + R < 0, has
//! none at all.
//!
//! *Rounding.* That the centre is rounded is covered by R, which has 16u (|c|₁ + R) added at least (u = [`Machine::unit`]; the centre is off
//! by u |c|₁ at most). From there on A, Y, R are exact numbers. A² − R² = (A − R)(A + R) is right to 3u of itself and at least
//! 3/4 A²; adding Y², to 5u, the root to 4u. So each of the two terms is right to 6u of itself and their sum to 7u of the sum of their
//! magnitudes, which after division is at most 4/3 (w + (1 + w)/2), w = |Y|/A: the slope is off by at most 16u (2w + 1). The slope
//! itself is at least w/3 − 1 in magnitude, since the tangent is off the centre's direction by an angle whose sine is at most 1/2
//! of the cosine of that direction's. So the error is below 112u (1 + |slope|); we take off and put on 256u (1 + |slope|). (`tests/margins.rs` runs this on
//! floats of few bits: with 1/32 of both margins a ray is lost, with 1/16 none is.)
//!
//! *Near.* A point of the sphere is at A − r along the major axis at least, and R − r covers the rounding of A and of the difference.

use crate::machine::Machine;

/// What is seen of sixteen spheres.
#[derive(Clone, Copy)]
pub struct Outline<M: Machine> {
    /// Lowest slopes along Y and Z.
    pub lo: [M::F; 2],
    /// Highest slopes; below the lowest for what lies behind.
    pub hi: [M::F; 2],
    /// How near along A a point of the sphere can be.
    pub near: M::F,
}

impl<M: Machine> Outline<M> {
    /// Kernel: of sixteen spheres.
    #[inline(always)]
    pub fn new(m: M, [a, y, z]: [M::F; 3], radius: M::F) -> Self {
        let zero = m.splat(0.0);
        let near = m.sub(a, radius);
        let square = m.mul(near, m.add(a, radius));
        let ahead = m.le(m.add(radius, radius), a);
        let behind = m.lt(m.add(a, radius), zero);
        let [y, z] = [tangents(m, [a, y], radius, square), tangents(m, [a, z], radius, square)];
        let (far, minus_far) = (m.splat(f32::INFINITY), m.splat(f32::NEG_INFINITY));
        let lo = [m.select(ahead, y[0], minus_far), m.select(ahead, z[0], minus_far)];
        let hi = [m.select(ahead, y[1], far), m.select(ahead, z[1], far)];
        Self {
            lo: [m.select(behind, far, lo[0]), m.select(behind, far, lo[1])],
            hi: [m.select(behind, minus_far, hi[0]), m.select(behind, minus_far, hi[1])],
            near,
        }
    }

    /// Kernel: which of them overlap a range of slopes, given from its lowest to its highest along Y and along Z.
    #[inline(always)]
    pub fn overlap(&self, m: M, range: [[M::F; 2]; 2]) -> M::B {
        overlap(m, self.lo, self.hi, range)
    }
}

/// Kernel: the slopes of the tangents to a circle around (A, Y), rounded outward; `square` is A² − R².
#[inline(always)]
fn tangents<M: Machine>(m: M, [a, y]: [M::F; 2], radius: M::F, square: M::F) -> [M::F; 2] {
    let across = m.mul(radius, m.sqrt(m.add(square, m.mul(y, y))));
    let along = m.mul(a, y);
    let [lo, hi] = [m.div(m.sub(along, across), square), m.div(m.add(along, across), square)];
    let slack = m.splat(256.0 * m.unit());
    let [lo_slack, hi_slack] = [m.mul(slack, m.max(lo, m.neg(lo))), m.mul(slack, m.max(hi, m.neg(hi)))];
    [m.sub(lo, m.add(slack, lo_slack)), m.add(hi, m.add(slack, hi_slack))]
}

/// Kernel: which outlines overlap a range of slopes.
#[inline(always)]
pub fn overlap<M: Machine>(m: M, lo: [M::F; 2], hi: [M::F; 2], range: [[M::F; 2]; 2]) -> M::B {
    let [y, z] = range;
    let y = m.and(m.le(lo[0], y[1]), m.le(y[0], hi[0]));
    m.and(y, m.and(m.le(lo[1], z[1]), m.le(z[0], hi[1])))
}
