//! A sphere against the frustum's four planes.
//!
//! In coordinates relative to the eye, with A along the major axis, the frustum is
//! lo_Y A <= Y <= hi_Y A and lo_Z A <= Z <= hi_Z A (module [`crate::frustum`]). Each side is a plane through the eye with
//! an unnormalised normal of length N = √(1 + slope²), so that a ball of radius R around (A, Y, Z) has a point inside
//! if and only if Y − lo_Y A >= −R N, and so on. Four planes are four lanes.
//!
//! *Margin.* The reported point P lies in the frustum up to the rounding of the slopes, u |A_P| with A_P <= A + R (u is
//! [`Machine::unit`]), and within R of the centre. The signed distance is computed with at most 5u (|Y| + |A|) of error (u from the centre's
//! difference, u each from slope, product and sum). Both are below 16u (|f|₁ + R), |f|₁ the sum of the centre's
//! coordinates, which is added to R once a frame ([`radius`]); since N >= 1 it covers them. N is enlarged by 16u for
//! its own rounding. So whatever is dropped has no point P in the frustum: *hit => kept*. (`tests/margins.rs` runs this
//! on floats of few bits: u is too little, 2u is not.)

use crate::frustum::Frustum;
use crate::machine::{Machine, Site};
use crate::plan::Margins;

/// The four planes of a frustum, one a lane; further lanes repeat them.
#[derive(Clone, Copy)]
pub struct Planes<M: Machine> {
    /// Coefficients of A, Y and Z: (−lo, 1, 0), (hi, −1, 0), (−lo, 0, 1), (hi, 0, −1).
    normal: [M::F; 3],
    /// Minus the length of each.
    minus_length: M::F,
}

/// What a sphere's reach becomes for culling by a machine of that unit roundoff: see the module's text. `f` is eye − centre.
#[must_use]
pub fn radius(unit: f32, margins: Margins, f: [f32; 3], reach: f32) -> f32 {
    match margins {
        Margins::None => reach,
        Margins::Derived => (reach + 16.0 * unit * (f[0].abs() + f[1].abs() + f[2].abs() + reach)).next_up(),
    }
}

/// Kernel: the same for sixteen spheres whose reach is their radius, with margins; of their centres' coordinates the magnitudes.
#[inline(always)]
pub fn radii<M: Machine>(m: M, [x, y, z]: [M::F; 3], radius: M::F) -> M::F {
    // Twice the slack of one: it covers the rounding of this sum as well.
    let slack = m.mul(m.splat(32.0 * m.unit()), m.add(m.add(m.add(x, y), z), radius));
    m.add(radius, slack)
}

impl<M: Machine> Planes<M> {
    /// The planes of a frustum.
    #[inline(always)]
    pub fn new(m: M, frustum: &Frustum<M>, margins: Margins) -> Self {
        let [[lo_y, hi_y], [lo_z, hi_z]] = frustum.slope_arrays(m);
        let along = m.lanes_of_four([-lo_y, hi_y, -lo_z, hi_z]);
        let (one, longer) =
            (m.splat(1.0), if margins == Margins::Derived { 1.0 + 16.0 * m.unit() } else { 1.0 });
        let length = m.mul(m.sqrt(m.add(one, m.mul(along, along))), m.splat(longer));
        let normal = [along, m.lanes_of_four([1.0, -1.0, 0.0, 0.0]), m.lanes_of_four([0.0, 0.0, 1.0, -1.0])];
        Self { normal, minus_length: m.neg(length) }
    }

    /// Kernel: whether a ball lies wholly outside one of the planes. `center` is relative to the eye, along (A, Y, Z).
    #[inline(always)]
    pub fn cull(&self, m: M, center: [M::F; 3], radius: M::F) -> bool {
        let distance = m.dot(self.normal, center);
        m.any(m.lt(distance, m.mul(self.minus_length, radius)), Site::Culled)
    }
}
