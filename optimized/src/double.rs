//! One ray against one sphere in f64, with a bound on the error of each step: the stage between f32 and integers.
//!
//! In: a ray and a sphere, exact f32 numbers. Out: miss, hit with an interval of t, or undecided. Straight-line code, so that a
//! loop over sixteen lanes becomes vectors.
//!
//! # Derivation
//!
//! v = 2⁻⁵³; f = eye − c rounded once; F = |f|, n = |d|, a = n², b = f·d, q = f·f − r²; products of two f32 are exact. No
//! step leaves the range of f64 (products reach from 2⁻⁵⁹⁶ to 2⁵¹⁸). To first order in v, with 1 % put on in the end:
//!
//! - w = f × d. Each component has at most three roundings on |f_j d_k| + |f_k d_j|; the vector of these sums is no longer than
//!   √(4/3) F n, since its square is |f × d|² + 4 Σ f_j d_j f_k d_k <= (sin² + 4/3 cos²) F²n². So |δw| <= 3.47 v F n =: p.
//! - D = a r² − |w|² (b² − a q, without its cancellation): |w|² by 3v|w|² + 2p|w| + p²; a r² by 4v; the difference by 1v:
//!   E = v (7 F n |w| + 5 a r² + 5 |w|²) + 13 (v F n)².
//! - q: 6v F² + v r². b: 4v F n.
//! - S = √D: E/S, since |√x − √y| <= |x − y| / √x; and v S.
//! - With B = |b|: an eye outside that sees the sphere ahead has t = q / (B + S); one inside has (B + S) / a if b < 0, else
//!   −q / (B + S). Neither sum cancels. If b's sign is in doubt, B is off by twice b's error. Relative errors add up.
//!
//! # The short way
//!
//! Nearly all hits are seen from outside, and not at the sphere's very rim: [`short_ends`] does with b² − a q and one bound for all rays,
//! which must have D > κ a r², κ = 2⁻¹². With g = F²/q,
//!
//! - q: 5v F² from f and the sum, v q from the difference, at most 6v g of itself. b: 4v F n. a: 3v of itself.
//! - D: 9v a F² from b², 10v a F² from a q, v a F² from the difference: 20v a F².
//! - S: 20v a F² / √(κ a r²) and v S. Since D > 0, |b| >= √(a q), and so B + S is off by
//!   v (20 F² / (√κ r √q) + 4 √g + 2) of itself, where F²/√q <= g F.
//! - t: in all v g (13 + 1280 F/r), for which we take v g (16 + 1280 |f|₁/r), |f|₁ the sum of f's components.
//!
//! That D > 0 holds if 20 F² v < κ r², which it does if this error is below 2⁻²⁶; else nothing is said.

use crate::machine::{LANES, Machine};
use contract::Sphere;

const V: f64 = 1.0 / (1u64 << 53) as f64;
/// 1 % for terms of higher order and the bounds' own rounding.
const MORE: f64 = 1.01;

/// What f64 can say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// Certainly a miss.
    Miss,
    /// Certainly a hit, with t > 0 between the two.
    Hit([f64; 2]),
    /// Not known.
    Undecided,
}

/// Asks f64.
#[must_use]
#[inline(always)]
pub fn ask(eye: [f32; 3], dir: [f32; 3], sphere: &Sphere) -> Answer {
    let r = root(eye, dir, sphere.center, sphere.radius);
    if r.miss {
        Answer::Miss
    } else if r.hit {
        Answer::Hit([r.t * (1.0 - r.error), r.t * (1.0 + r.error)])
    } else {
        Answer::Undecided
    }
}

/// A root as computed, what is certain about it, and its relative error.
#[derive(Clone, Copy, Debug)]
pub struct Root {
    /// Certainly none.
    pub miss: bool,
    /// Certainly one.
    pub hit: bool,
    /// Where, if there is one.
    pub t: f64,
    /// Relative error, below 1/2 if `hit`.
    pub error: f64,
}

impl Root {
    /// Lower and upper end of the true root, both rounded to f32: where these have the same bits, it is rounded so. Without a
    /// certain hit they never have.
    #[must_use]
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, reason = "this is the rounding of rule 3")]
    pub fn ends(&self) -> [f32; 2] {
        let [lo, hi] = [(self.t * (1.0 - self.error)) as f32, (self.t * (1.0 + self.error)) as f32];
        if self.hit { [lo, hi] } else { [0.0, -0.0] }
    }
}

/// The root that rule 2 asks for, in f64.
#[must_use]
#[inline(always)]
pub fn root(eye: [f32; 3], dir: [f32; 3], center: [f32; 3], radius: f32) -> Root {
    let d = [f64::from(dir[0]), f64::from(dir[1]), f64::from(dir[2])];
    let f = [
        f64::from(eye[0]) - f64::from(center[0]),
        f64::from(eye[1]) - f64::from(center[1]),
        f64::from(eye[2]) - f64::from(center[2]),
    ];
    let rr = f64::from(radius) * f64::from(radius);
    let (a, b, ff) = (dot(d, d), dot(f, d), dot(f, f));
    let w = [f[1] * d[2] - f[2] * d[1], f[2] * d[0] - f[0] * d[2], f[0] * d[1] - f[1] * d[0]];
    let (ww, far) = (dot(w, w), a * ff);
    let discriminant = a * rr - ww;
    let slack = V * MORE * (7.0 * (far * ww).sqrt() + 5.0 * (a * rr + ww)) + 14.0 * V * V * far;
    let (q, b_slack) = (ff - rr, 4.0 * MORE * V * far.sqrt());
    let q_slack = MORE * V * (6.0 * ff + rr);
    let (outside, inside) = (q > q_slack, q < -q_slack);
    let miss = discriminant < -slack || (outside && b > b_slack);
    let s = discriminant.max(0.0).sqrt();
    let sum = b.abs() + s;
    let hit = discriminant > slack && (inside || (outside && b < -b_slack));
    let by_sum = inside && b < 0.0;
    let t = if by_sum { sum / a } else { q.abs() / sum };
    let own = if by_sum { 3.0 * V } else { q_slack / q.abs() };
    let error = MORE * (own + (2.0 * b_slack + slack / s + V * s) / sum + 4.0 * V);
    Root { miss, hit: hit && error < 0.5, t, error }
}

/// Kernel: the relative error of t by the short way for sixteen spheres, whose centres are given relative to the eye in magnitudes;
/// +∞ where it cannot be gone. In f32 of f32, which 1 % more covers, since ff >= 2 r² keeps q from cancelling.
#[inline(always)]
pub fn short_error<M: Machine>(m: M, [x, y, z]: [M::F; 3], radius: M::F) -> M::F {
    const UNIT: f32 = 1.02 / (1u64 << 53) as f32;
    let (ff, rr) = (m.dot([x, y, z], [x, y, z]), m.mul(radius, radius));
    let sum = m.add(m.add(x, y), z);
    let far = m.add(m.mul(m.splat(16.0 * UNIT), radius), m.mul(m.splat(1280.0 * UNIT), sum));
    let error = m.mul(m.div(ff, m.sub(ff, rr)), m.div(far, radius));
    let apart = m.and(m.le(m.add(rr, rr), ff), m.lt(error, m.splat(1.0 / (1u32 << 26) as f32)));
    m.select(apart, error, m.splat(f32::INFINITY))
}

/// Lower and upper end of each ray's t on its own sphere, by the short way, rounded to f32: where these are equal, the ray
/// certainly hits and its t is rounded so. No branches, so that this becomes vectors.
#[inline(always)]
#[must_use]
#[allow(clippy::cast_possible_truncation, reason = "this is the rounding of rule 3")]
pub fn short_ends(
    eye: [f32; 3],
    dir: &[[f32; LANES]; 3],
    center: &[[f32; LANES]; 3],
    radius: &[f32; LANES],
    error: &[f32; LANES],
) -> [[f32; LANES]; 2] {
    const KAPPA: f64 = 1.0 / 4096.0;
    let eye = [f64::from(eye[0]), f64::from(eye[1]), f64::from(eye[2])];
    let (mut lo, mut hi) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let d = [f64::from(dir[0][lane]), f64::from(dir[1][lane]), f64::from(dir[2][lane])];
        let f = [
            eye[0] - f64::from(center[0][lane]),
            eye[1] - f64::from(center[1][lane]),
            eye[2] - f64::from(center[2][lane]),
        ];
        let (r, e) = (f64::from(radius[lane]), f64::from(error[lane]));
        let (rr, a, b) = (r * r, dot(d, d), dot(f, d));
        let q = dot(f, f) - rr;
        let discriminant = b * b - a * q;
        let t = q / (discriminant.sqrt() - b);
        let hit = (discriminant > KAPPA * rr * a) & (b < 0.0) & (q > 0.0);
        lo[lane] = if hit { (t - t * e) as f32 } else { 0.0 };
        hi[lane] = if hit { (t + t * e) as f32 } else { 1.0 };
    }
    [lo, hi]
}

#[inline(always)]
fn dot(u: [f64; 3], v: [f64; 3]) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}
