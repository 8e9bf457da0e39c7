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
//! Nearly all hits are seen from outside, and not at the sphere's very rim: [`Apart`] does with b² − a q and one bound for all rays,
//! which must have D > κ a r², κ = 2⁻¹². With g = F²/q,
//!
//! - q: 5v F² from f and the sum, v q from the difference, at most 6v g of itself. b: 4v F n. a: 3v of itself.
//! - D: 9v a F² from b², 10v a F² from a q, v a F² from the difference: 20v a F².
//! - S: 20v a F² / √(κ a r²) and v S. Since D > 0, |b| >= √(a q), and so B + S is off by
//!   v (20 F² / (√κ r √q) + 4 √g + 2) of itself, where F²/√q <= g F.
//! - t: in all v g (13 + 1280 F/r), for which we take v g (16 + 1280 |f|₁/r), |f|₁ the sum of f's components.
//!
//! That D > 0 holds if 20 F² v < κ r², which it does if this error is below 2⁻²⁶; else nothing is said.

use crate::machine::LANES;
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

/// A sphere from whose surface the eye is certainly apart, on the outside.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// f.
    from: [f64; 3],
    /// q.
    power: f64,
    /// κ r².
    least: f64,
    /// 1 − the relative error of t, and 1 + that.
    ends: [f64; 2],
}

/// Directions of a packet's rays by axis and lane, and their squared lengths.
#[derive(Clone, Copy, Debug)]
pub struct Directions {
    /// d.
    dir: [[f64; LANES]; 3],
    /// a.
    square: [f64; LANES],
}

impl Directions {
    /// Of f32 directions.
    #[inline(always)]
    #[must_use]
    pub fn new(dir: &[[f32; LANES]; 3]) -> Self {
        let mut new = Self { dir: [[0.0; LANES]; 3], square: [0.0; LANES] };
        for lane in 0..LANES {
            let d = [f64::from(dir[0][lane]), f64::from(dir[1][lane]), f64::from(dir[2][lane])];
            (new.dir[0][lane], new.dir[1][lane], new.dir[2][lane]) = (d[0], d[1], d[2]);
            new.square[lane] = dot(d, d);
        }
        new
    }
}

impl Apart {
    /// A sphere as seen from an eye; `None` if the short way cannot be gone.
    #[inline(always)]
    #[must_use]
    pub fn new(eye: [f32; 3], sphere: &Sphere) -> Option<Self> {
        const KAPPA: f64 = 1.0 / 4096.0;
        let c = sphere.center;
        let f = [
            f64::from(eye[0]) - f64::from(c[0]),
            f64::from(eye[1]) - f64::from(c[1]),
            f64::from(eye[2]) - f64::from(c[2]),
        ];
        let (r, ff) = (f64::from(sphere.radius), dot(f, f));
        let q = ff - r * r;
        let error = MORE * V * ff * (16.0 * r + 1280.0 * (f[0].abs() + f[1].abs() + f[2].abs())) / (q * r);
        let apart = Self { from: f, power: q, least: KAPPA * r * r, ends: [1.0 - error, 1.0 + error] };
        (q > 0.0 && error < 1.0 / f64::from(1u32 << 26)).then_some(apart)
    }

    /// Lower and upper end of each ray's t, rounded to f32: where these are equal, the ray certainly hits and its t is rounded so. No branches, so that this becomes vectors.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "this is the rounding of rule 3")]
    pub fn ends(&self, rays: &Directions) -> [[f32; LANES]; 2] {
        let (mut lo, mut hi) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let d = [rays.dir[0][lane], rays.dir[1][lane], rays.dir[2][lane]];
            let (a, b) = (rays.square[lane], dot(self.from, d));
            let discriminant = b * b - a * self.power;
            let t = self.power / (discriminant.sqrt() - b);
            let hit = (discriminant > self.least * a) & (b < 0.0);
            lo[lane] = if hit { (t * self.ends[0]) as f32 } else { 0.0 };
            hi[lane] = if hit { (t * self.ends[1]) as f32 } else { 1.0 };
        }
        [lo, hi]
    }
}

#[inline(always)]
fn dot(u: [f64; 3], v: [f64; 3]) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}
