//! How far the f32 decision of [`crate::certain`] can be from the truth: the error bound of a sphere, for all rays.
//!
//! In: the unit roundoff of the arithmetic, how far the centre is from the eye, the radius. Out: three numbers in f32. Nothing
//! here is measured; every step below is an inequality in real numbers. `tests/bound.rs` runs the kernel on floats of few bits, over
//! all inputs of a domain, and finds that the bound holds for each and that half of it does not.
//!
//! # What is computed
//!
//! In coordinates relative to the eye, with the packet's major axis A first and pointing ahead, a sphere has its centre at
//! (c_A, c_Y, c_Z), m = max |c_i|, and a ray has the slopes y = d_Y/|d_A| and z = d_Z/|d_A|, both at most 1 in magnitude. Let
//!
//! ```text
//! e_Y = c_Y − y c_A      e_Z = c_Z − z c_A      e_X = e_Y z − e_Z y
//! a = 1 + y² + z²        D = a r² − |e|²        h = c_A + (y e_Y + z e_Z) / a
//! ```
//!
//! e is the cross product of centre and (1, y, z), so |e| = √a L with L the distance of the centre from the line: the ray hits if
//! and only if D >= 0 (and not behind the eye), and its roots, as distances along A, are h ± √D / a. They are t |d_A|, in
//! the order of the t. No root of a sphere needs the length of d, and no step subtracts large numbers to get a small one but
//! the first, where the ray's distance from the centre arises.
//!
//! # Model
//!
//! fl(x ∘ y) = (x ∘ y)(1 + δ), |δ| <= u: u = 2⁻ᵖ for p bits rounded to nearest ([`NEAREST`]: 2⁻²⁴), twice that for truncation
//! ([`TRUNCATING`]). γ_k = (1 + u)ᵏ − 1 bounds k of them. What follows holds for every u < 1/8, not to first order only.
//!
//! *Range.* Centres are within 2⁴⁰ of the eye, radii from 2⁻⁴⁰ to 2⁴⁰; beyond, the bound is infinite, and the sphere is never decided
//! in f32. So the largest product is below 2⁸⁵. A slope, a square or a product that underflows is off by 2⁻¹⁵⁰, so D by less than
//! 2⁻¹⁰⁸ r, which is below 2⁻⁴⁴ times u r².
//!
//! # The sign of D
//!
//! The centre is rounded once (c is a difference of f32), and so is each slope, which is off by at most u/2, since it is at
//! most 1. With |c_Y| <= |e_Y| + |y c_A|, and |y c_A| <= m,
//!
//! ```text
//! ê_Y − e_Y = α_Y + η y,   |η| <= u m (the rounding of c_A),   |α_Y| <= γ_2 |e_Y| + K m
//! K = (1 + u) (u [c_Y] + (1 + u) u/2 [slope] + (1 + u) u [product]) + u²
//! ```
//!
//! and likewise Z, with the same η. The map v = (v_Y, v_Z) → (v_Y z − v_Z y, v_Y, v_Z) takes e_Y, e_Z to e, and with s = (y, z) it takes
//! α + η s to a vector of the length √(a |α|² + a η² − (α·s − η)²), at most √a √(|α|² + η²), where |α| <= √2 K m but for the part with
//! γ_2. The products in e_X have three roundings each, slope included. So, with a <= 3,
//!
//! ```text
//! |ê − e| <= P + R |e|,   P = √(6K² + 3u²) m + 2γ_3 (K + u) m,   R = √3 γ_2 + √2 γ_3 (1 + γ_2)
//! ```
//!
//! |ê|² is summed with at most three roundings on a term. The computed a is off by at most β = (γ_2 + 2γ_5)/3 of itself, a r² by
//! κ = (1 + β)(1 + u)² − 1. Let ρ = √3 r >= √a r, x = P + R ρ, and z what is subtracted last, before its rounding.
//!
//! - If D >= 0, then |e| <= ρ and z >= −[κρ² + γ_3 (ρ + x)² + 2ρx + x²].
//! - If D < 0, then |e| > √a r, and |ê| >= |e| − R|e| − P; hence z <= (κ + γ_3) ρ² + 2ρx. (If the lower bound of |ê| is negative,
//!   then a r² itself is below that.)
//!
//! The last rounding adds u (ρ² + the larger). These are the two thresholds, [`Bound::miss_below`] and
//! [`Bound::hit_above`]; between them nothing is known. For a true hit they bound the error of D from both sides as well.
//!
//! # The root
//!
//! Of a true hit, |h − c_A| <= r, since the foot of the perpendicular lies within the sphere. 1/a is off by η = (1 + u)/(1 − β) − 1
//! of itself, so a product with it by τ − 1, τ = (1 + η)(1 + u). With the same |ê − e|, for Y and Z alone, and √2 √(a − 1) / a <= √(1/2),
//!
//! ```text
//! |(ŷ ê_Y + ẑ ê_Z) / a − (h − c_A)| <= τ [√(1/2) (1 + γ_3) (K + u) m + √(2/3) (γ_2 + γ_3 (1 + γ_2)) r] + (τ − 1) r
//! ```
//!
//! to which u m comes from c_A, and u times the sum. The half chord is taken from D with its threshold added or subtracted, so
//! it is right but for its own roundings, ((1 + η)(1 + u)³ − 1) of at most r + √(both thresholds). Two more sums of at most m + 2r
//! and so on are rounded. All of that together is [`Bound::root`].
//!
//! Each of the three is at most a form in r and m ([`Rule`]), of second degree for the signs and, since √(r m) <= (r + m)/2, of first
//! degree for the root; so a sphere's bound takes a few operations, and sixteen take no more.
//!
//! A solver checks each of these inequalities: `cargo run --release -- prove bound`.

use crate::camera::spread;
use crate::host::Scalar;
use crate::machine::Machine;

/// Unit roundoff of f32 rounded to nearest.
pub const NEAREST: f64 = 1.0 / (1u32 << 24) as f64;
/// Unit roundoff of f32 truncated, as the SPU does.
pub const TRUNCATING: f64 = 1.0 / (1u32 << 23) as f64;

/// 1 + 2⁻¹⁰: over the few roundings of the bound itself, and over what underflows within its range.
const SLACK: f64 = 1.0 + 1.0 / 1024.0;

/// What rounding can do to a sphere, whatever the ray. In scene units, squared for the first two.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bound {
    /// A computed D above this is positive in truth.
    pub hit_above: f32,
    /// A computed D below this is negative in truth.
    pub miss_below: f32,
    /// The computed ends of a root's interval are off by at most this.
    pub root: f32,
}

impl Bound {
    /// Decides nothing.
    pub const NONE: Self =
        Self { hit_above: f32::INFINITY, miss_below: f32::NEG_INFINITY, root: f32::INFINITY };
}

/// The bounds of an arithmetic: forms in r and m, with coefficients that are rounded up.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// Of r², r m and m².
    above: [f32; 3],
    /// Of r², r m and m².
    below: [f32; 3],
    /// Of r and m.
    root: [f32; 2],
}

impl Rule {
    /// For an arithmetic of that unit roundoff.
    #[must_use]
    pub fn new(unit: f64) -> Self {
        let u = unit;
        let gamma = |k| (1.0 + u).powi(k) - 1.0;
        let (g2, g3, g5) = (gamma(2), gamma(3), gamma(5));
        let (root2, root3) = (2f64.sqrt(), 3f64.sqrt());
        let k = (1.0 + u) * (u + (1.0 + u) * u / 2.0 + (1.0 + u) * u) + u * u;
        // P = p m and x = p m + q r.
        let p = (6.0 * k * k + 3.0 * u * u).sqrt() + 2.0 * g3 * (k + u);
        let q = root3 * (root3 * g2 + root2 * g3 * (1.0 + g2));
        let beta = (g2 + 2.0 * g5) / 3.0;
        let kappa = (1.0 + beta) * (1.0 + u) * (1.0 + u) - 1.0;
        let sum = root3 + q;
        let above = [3.0 * (kappa + g3) + 2.0 * root3 * q, 2.0 * root3 * p, 0.0];
        let below = [
            3.0 * kappa + g3 * sum * sum + 2.0 * root3 * q + q * q,
            2.0 * (g3 * sum + root3 + q) * p,
            (g3 + 1.0) * p * p,
        ];
        let last = [u * (3.0 + below[0]), u * below[1], u * below[2]];
        let above = [0, 1, 2].map(|i| above[i] + last[i]);
        let below = [0, 1, 2].map(|i| below[i] + last[i]);

        let eta = (1.0 + u) / (1.0 - beta) - 1.0;
        let tau = (1.0 + eta) * (1.0 + u);
        let across = [(2.0f64 / 3.0).sqrt() * (g2 + g3 * (1.0 + g2)), 0.5f64.sqrt() * (1.0 + g3) * (k + u)];
        let offset = [tau * across[0] + (tau - 1.0), tau * across[1]];
        let middle = [offset[0] + u * (1.0 + offset[0]), u + offset[1] + u * (1.0 + u + offset[1])];
        // √(a r² + b r m + c m²) <= √a r + √b (r + m) / 2 + √c m.
        let [a, b, c] = [0, 1, 2].map(|i: usize| (above[i] + below[i]).sqrt());
        let chord = [1.0 + a + b / 2.0, b / 2.0 + c];
        let half = chord.map(|chord| ((1.0 + eta) * gamma(3) + eta) * chord);
        let ends = [0, 1].map(|i| 2.0 * u * (1.0 + u) * (1.0 + chord[i] + middle[i] + half[i]));
        let root = [0, 1].map(|i| (middle[i] + half[i] + ends[i]) * (1.0 + u) / (1.0 - u));
        Self { above: above.map(up), below: below.map(up), root: root.map(up) }
    }

    /// The bound of a sphere whose centre's coordinates are at most `farthest` from the eye's.
    #[must_use]
    pub fn bound(&self, farthest: f32, radius: f32) -> Bound {
        let limit = (1u64 << 40) as f32;
        if farthest > limit || !(limit.recip()..=limit).contains(&radius) {
            return Bound::NONE;
        }
        let m = Scalar;
        let [above, below, root] = self.bounds(m, m.splat(farthest), m.splat(radius));
        Bound { hit_above: above[0], miss_below: below[0], root: root[0] }
    }

    /// Kernel: hit above, miss below and root of sixteen spheres in range.
    #[inline(always)]
    pub fn bounds<M: Machine>(&self, m: M, farthest: M::F, radius: M::F) -> [M::F; 3] {
        let squares = [m.mul(radius, radius), m.mul(radius, farthest), m.mul(farthest, farthest)];
        let above = m.dot(spread(m, self.above), squares);
        let below = m.dot(spread(m, self.below), squares);
        let [of_radius, of_farthest] = self.root;
        let root = m.add(m.mul(m.splat(of_radius), radius), m.mul(m.splat(of_farthest), farthest));
        [above, m.neg(below), root]
    }
}

#[allow(clippy::cast_possible_truncation, reason = "rounded up")]
fn up(x: f64) -> f32 {
    ((x * SLACK) as f32).next_up()
}
