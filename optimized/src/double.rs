//! One ray against one sphere in f64, with a bound on the error of each step: the stage between f32 and integers.
//!
//! In: a ray and a sphere, exact f32 numbers. Out: miss, hit with an interval of t, or undecided. Straight-line code, so that a
//! loop over sixteen lanes becomes vectors. It is written over [`Float`], of which f64 is what ships; `tests/rounding.rs` runs it on
//! floats of 8 and 16 bits over all inputs of its domains.
//!
//! # Derivation
//!
//! Every operation is fl(x ∘ y) = (x ∘ y)(1 + δ), |δ| <= v, so that k of them are off by at most γ_k = (1 + v)ᵏ − 1 of the true, or
//! by (1 − v)⁻ᵏ − 1 of the computed result. Products of two inputs are exact, and no step leaves the range of f64: products reach from 2⁻⁵⁹⁶ to
//! 2⁵¹⁸. (That of G and W below would leave it; so their roots are multiplied.) What follows holds for every v <= 2⁻⁸, with
//! M = [`Float::MORE`] >= 1 + 40 v. Let f = eye − c and d be exact, F = |f|, n = |d|,
//! a = n², b = f·d, q = F² − r², w = f × d, D = a r² − |w|² (which is b² − a q, without its cancellation); what is computed has a hat,
//! and by name A = fl(a r²), W = fl(|ŵ|²), G = fl(â F̂²) ("far").
//!
//! 1. A component of ŵ has three roundings (f, product, difference) on each of two terms: |ŵ_x − w_x| <= γ_3 (|f_y d_z| + |f_z d_y|).
//! 2. These sums are those of the components' magnitudes x_i = |f_i d_i|, and the squared length of the vector of them is
//!    F²n² − (Σ x_i)² + 4 Σ x_i x_j (i < j) <= F²n² + (Σ x_i)² / 3 <= 4/3 F²n². So |ŵ − w| <= √(4/3) γ_3 F n <= 3.48 v F n =: p.
//! 3. ||ŵ|² − |w|²| <= 2p |ŵ| + p², in terms of what was computed.
//! 4. A and W have three roundings each, the difference one more: |D̂ − D| <= ((1 − v)⁻³ − 1 + v)(A + W) + 2p |ŵ| + p².
//! 5. G has eight roundings (two in a, five in F²), W three: F n <= √G (1 − v)⁻⁴, |ŵ| <= √W (1 − v)^(−3/2).
//! 6. `slack` is computed with seven roundings on its first term, five on the second, two on the third. So it is no less than 4. if
//!    6.96 (1 − v)⁻¹⁴ <= 7 M (of 5. and these 12.5 would do), ((1 − v)⁻³ − 1 + v)(1 − v)⁻⁵ <= 5 M v, and 12.12 (1 − v)⁻¹⁰ <= 14.
//! 7. F² has five roundings, q one more: |q̂ − q| <= ((1 − v)⁻⁵ − 1) F̂² + v (F̂² + r²); `q_slack` is no less if
//!    ((1 − v)⁻⁵ − 1 + v) <= 6 M v (1 − v)³ and 1 <= M (1 − v)².
//! 8. b has four roundings on Σ |f_i d_i| <= F n: |b̂ − b| <= γ_4 F n; `b_slack` is no less if γ_4 (1 − v)⁻⁴ <= 4 M v (1 − v)².
//! 9. *Miss* if D < 0, or if the eye is outside (q > 0) and b > 0. *Hit* if D >= 0 and the eye is inside (q < 0), or outside with b < 0.
//!    Signs are certain beyond their slacks. An eye on the surface is neither inside nor outside.
//!
//! With S = √D, an eye outside has t = q / (S − b); one inside has (S − b) / a if b̂ < 0, else −q / (S + b). None cancels: with
//! Σ = S ∓ b and σ = |b̂| + ŝ, let β = `b_slack`, E = `slack`, x = E / D̂, y = ŝ / σ <= 1. A hit is only said if D̂ > 2 E, so x < 1/2.
//!
//! 10. √D̂ − √D is at most √D̂ z either way, where z = 1 − √(1 − x), that is x = 2z − z², and z < 0.3.
//! 11. |Σ − σ| <= β + z √D̂ + |ŝ − √D̂|, also where b's sign is in doubt; √D̂ <= ŝ (1 − v)⁻¹. So |Σ − σ| <= c σ with
//!     c = β/σ + (z + v) y / (1 − v).
//! 12. `error` is computed with eleven roundings at most: e >= M (1 − v)¹¹ e₀ >= (1 + 27 v) e₀, e₀ = ε + 2 β/σ + (x + v) y + 4v, where ε =
//!     `q_slack` / |q̂| for a quotient, and 3v for a sum over a. Only e < 1/2 is used.
//! 13. A quotient t̂ has two roundings (sum, division) and an end of the interval two: t lies between the ends if
//!     (1 + ε)(1 + v) <= (1 − c)(1 + e)(1 − v)³ and (1 − e)(1 + c)(1 + v)³ <= (1 − ε)(1 − v).
//! 14. A sum over a has four, two of them in a: if (1 + c)(1 + v)² <= (1 + e)(1 − v)⁴ and (1 − e)(1 + v)⁴ <= (1 − c)(1 − v)².
//!
//! Steps 6 to 8 and the last of 12 have one variable. 13 and 14 hold for all 0 < v <= 2⁻⁸, 0 <= z <= 0.3, 0 <= y <= 1, and ε, β/σ >= 0 with
//! (1 + 27 v) e₀ < 1/2: by first order, 2 β/σ + x y against β/σ + z y is room for what is of second. (Up to D̂ > E it would not be: c may then be
//! nearly y.)
//!
//! # The short way
//!
//! Nearly all hits are seen from outside, and not at the sphere's very rim: [`short_ends`] does with b² − a q and one bound for all rays,
//! for spheres with F² >= 2r² and rays with D > κ a r². With g = F²/q, and v <= 2⁻¹²:
//!
//! 1. q: five roundings of F², and one: |q̂ − q| <= 6.01 v g q, since g >= 1. b: |b̂ − b| <= 4.01 v F n.
//! 2. D: 8.1 v a F² from b, v a F² and a little from b²; 9.1 v a F² from a, q and their product; 1.1 v a F² from the difference:
//!    |D̂ − D| <= 20 v a F².
//! 3. The error said is e >= v g (16 + (20/√κ) F/r). It is used below √(2v) only, so that 20 v F² < κ r² / 10.
//! 4. D̂ > κ r² a (1 − v)³ is what is asked; so |D̂ − D| <= D̂ / 9.9, and D > 0. As b² > a q, |b| > F n / √g, and b's sign is certain.
//! 5. √D̂ − √D is at most 20 v a F² / (1.94 √κ √a r), since D̂ and D are both near κ a r² or above.
//! 6. Σ = S − b >= √a √q: with √D̂'s rounding, Σ is off by v (4.01 √g + 10.4 √g F / (√κ r) + 1.1) of itself.
//! 7. t: sum, division, and one and a little at the ends: v g (14.3 + (10.4/√κ) F/r) <= 0.9 e in first order, and in second less than 0.9 e²,
//!    which is below 0.1 e as e < 0.11.
//!
//! κ is 2⁻¹² for f64, so 20/√κ is 1280; for F we take |f|₁, the sum of f's components.
//!
//! A solver checks each inequality of both derivations: `cargo run --release -- prove rounding`.

use crate::float::Float;
use crate::machine::{LANES, Machine};
use contract::Sphere;

/// What f64 can say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer<F = f64> {
    /// Certainly a miss.
    Miss,
    /// Certainly a hit, with t > 0 between the two.
    Hit([F; 2]),
    /// Not known.
    Undecided,
}

/// Asks f64.
#[must_use]
#[inline(always)]
pub fn ask<F: Float>(eye: [f32; 3], dir: [f32; 3], sphere: &Sphere) -> Answer<F> {
    let r = root(eye, dir, sphere.center, sphere.radius);
    if r.miss {
        Answer::Miss
    } else if r.hit {
        Answer::Hit(r.interval())
    } else {
        Answer::Undecided
    }
}

/// A root as computed, what is certain about it, and its relative error.
#[derive(Clone, Copy, Debug)]
pub struct Root<F = f64> {
    /// Certainly none.
    pub miss: bool,
    /// Certainly one.
    pub hit: bool,
    /// Where, if there is one.
    pub t: F,
    /// Relative error, below 1/2 if `hit`.
    pub error: F,
}

impl<F: Float> Root<F> {
    /// Lower and upper end of the true root, if there is one for certain.
    #[must_use]
    #[inline(always)]
    pub fn interval(&self) -> [F; 2] {
        [self.t * (F::of(1.0) - self.error), self.t * (F::of(1.0) + self.error)]
    }

    /// The same, both rounded to f32: where these have the same bits, it is rounded so. Without a certain hit they never have.
    #[must_use]
    #[inline(always)]
    pub fn ends(&self) -> [f32; 2] {
        let [lo, hi] = self.interval();
        if self.hit { [lo.narrow(), hi.narrow()] } else { [0.0, -0.0] }
    }
}

/// The root that rule 2 asks for, in f64.
#[must_use]
#[inline(always)]
pub fn root<F: Float>(eye: [f32; 3], dir: [f32; 3], center: [f32; 3], radius: f32) -> Root<F> {
    let zero = F::of(0.0);
    let d = [F::of(dir[0]), F::of(dir[1]), F::of(dir[2])];
    let f = [
        F::of(eye[0]) - F::of(center[0]),
        F::of(eye[1]) - F::of(center[1]),
        F::of(eye[2]) - F::of(center[2]),
    ];
    let rr = F::of(radius) * F::of(radius);
    let (a, b, ff) = (dot(d, d), dot(f, d), dot(f, f));
    let w = [f[1] * d[2] - f[2] * d[1], f[2] * d[0] - f[0] * d[2], f[0] * d[1] - f[1] * d[0]];
    let (ww, far) = (dot(w, w), a * ff);
    let discriminant = a * rr - ww;
    let slack = F::at_least(F::UNIT * F::MORE)
        * (F::of(7.0) * (far.sqrt() * ww.sqrt()) + F::of(5.0) * (a * rr + ww))
        + F::at_least(14.0 * F::UNIT * F::UNIT) * far;
    let (q, b_slack) = (ff - rr, F::at_least(4.0 * F::MORE * F::UNIT) * far.sqrt());
    let q_slack = F::at_least(F::MORE * F::UNIT) * (F::of(6.0) * ff + rr);
    let (outside, inside) = (q > q_slack, q < -q_slack);
    let miss = discriminant < -slack || (outside && b > b_slack);
    let s = if discriminant > zero { discriminant.sqrt() } else { zero };
    let sum = b.abs() + s;
    let hit = discriminant > slack + slack && (inside || (outside && b < -b_slack));
    let by_sum = inside && b < zero;
    let t = if by_sum { sum / a } else { q.abs() / sum };
    let own = if by_sum { F::at_least(3.0 * F::UNIT) } else { q_slack / q.abs() };
    let (twice_b, s_slack) = (F::of(2.0) * b_slack, slack / s + F::at_least(F::UNIT) * s);
    let error = F::at_least(F::MORE) * (own + (twice_b + s_slack) / sum + F::at_least(4.0 * F::UNIT));
    Root { miss, hit: hit && error < F::of(0.5), t, error }
}

/// Kernel: the relative error of t by the short way for sixteen spheres, whose centres are given relative to the eye in magnitudes;
/// +∞ where it cannot be gone. In f32 of f32, which 1 % more covers, since ff >= 2 r² keeps q from cancelling.
#[inline(always)]
pub fn short_error<F: Float, M: Machine>(m: M, [x, y, z]: [M::F; 3], radius: M::F) -> M::F {
    let [near, far, limit] = const { short_terms::<F>() };
    let (ff, rr) = (m.dot([x, y, z], [x, y, z]), m.mul(radius, radius));
    let sum = m.add(m.add(x, y), z);
    let far = m.add(m.mul(m.splat(near), radius), m.mul(m.splat(far), sum));
    let error = m.mul(m.div(ff, m.sub(ff, rr)), m.div(far, radius));
    let apart = m.and(m.le(m.add(rr, rr), ff), m.lt(error, m.splat(limit)));
    m.select(apart, error, m.splat(f32::INFINITY))
}

/// 16 v, (20/√κ) v, each with 2 % more, and the limit.
#[allow(clippy::cast_possible_truncation, reason = "2 % cover it")]
const fn short_terms<F: Float>() -> [f32; 3] {
    let unit = (1.02 * F::UNIT) as f32;
    [16.0 * unit, (20.0 / F::ROOT_KAPPA) as f32 * unit, F::LIMIT as f32]
}

/// Lower and upper end of each ray's t on its own sphere, by the short way, rounded to f32: where these are equal, the ray
/// certainly hits and its t is rounded so. No branches, so that this becomes vectors.
#[inline(always)]
#[must_use]
pub fn short_ends<F: Float>(
    eye: [f32; 3],
    dir: &[[f32; LANES]; 3],
    center: &[[f32; LANES]; 3],
    radius: &[f32; LANES],
    error: &[f32; LANES],
) -> [[f32; LANES]; 2] {
    let zero = F::of(0.0);
    let kappa = F::at_least(F::ROOT_KAPPA * F::ROOT_KAPPA);
    let eye = [F::of(eye[0]), F::of(eye[1]), F::of(eye[2])];
    let (mut lo, mut hi) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let d = [F::of(dir[0][lane]), F::of(dir[1][lane]), F::of(dir[2][lane])];
        let f = [
            eye[0] - F::of(center[0][lane]),
            eye[1] - F::of(center[1][lane]),
            eye[2] - F::of(center[2][lane]),
        ];
        let (r, e) = (F::of(radius[lane]), F::at_least(f64::from(error[lane])));
        let (rr, a, b) = (r * r, dot(d, d), dot(f, d));
        let q = dot(f, f) - rr;
        let discriminant = b * b - a * q;
        let t = q / (discriminant.sqrt() - b);
        let hit = (discriminant > kappa * rr * a) & (b < zero) & (q > zero);
        lo[lane] = if hit { (t - t * e).narrow() } else { 0.0 };
        hi[lane] = if hit { (t + t * e).narrow() } else { 1.0 };
    }
    [lo, hi]
}

#[inline(always)]
fn dot<F: Float>(u: [F; 3], v: [F; 3]) -> F {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}
