//! Rules 2 and 3 in integers: no rounding anywhere.
//!
//! Every finite f32 is an integer times 2⁻¹⁴⁹. Scaled by 2¹⁴⁹, eye, centre, radius and direction become
//! integers and t stays what it is, since both sides of |eye + t d − c|² = r² scale alike. With f = eye − c
//!
//! ```text
//! a t² + 2 b t + q = 0,   a = d·d,   b = f·d,   q = f·f − r²
//! t = (−b ± √D) / a,      D = b² − a q
//! ```
//!
//! For D ≥ 0 and a > 0, the product of the roots is q / a and their sum −2 b / a. So the smallest positive one
//! is: for q > 0 (eye outside) the one with −√D if b < 0, else none; for q < 0 (inside) the one with +√D; for
//! q = 0 (on the surface) the roots are 0 and −2b/a, so the one with +√D if b < 0, else none. A [`Root`] keeps
//! (p + σ √D) / a in that form, and all questions about it are signs of such expressions, answered by
//! squaring.

use crate::Ray;
use crate::interval::Interval;
use contract::Sphere;
use dashu_int::IBig;
use std::cmp::Ordering;

/// The number (p + σ √D) / a with σ = ±1, D >= 0, a > 0, all of them integers.
pub(crate) struct Root {
    p: IBig,
    sigma: Ordering,
    discriminant: IBig,
    a: IBig,
}

impl Root {
    /// The smallest positive root for a ray and a sphere, if the ray hits it.
    pub(crate) fn of(ray: &Ray, sphere: &Sphere) -> Option<Self> {
        let d = ray.dir.map(integer);
        let f = [0, 1, 2].map(|i| integer(ray.eye[i]) - integer(sphere.center[i]));
        let r = integer(sphere.radius);
        let a = dot(&d, &d);
        let b = dot(&f, &d);
        let q = dot(&f, &f) - &r * &r;
        let discriminant = &b * &b - &a * &q;
        if a == IBig::ZERO || discriminant < IBig::ZERO {
            return None;
        }
        let sigma = match (sign(&q), sign(&b)) {
            (Ordering::Greater, Ordering::Less) => Ordering::Less,
            (Ordering::Less, _) | (Ordering::Equal, Ordering::Less) => Ordering::Greater,
            _ => return None,
        };
        Some(Self { p: -b, sigma, discriminant, a })
    }

    /// Compares the roots of two spheres for the same ray.
    ///
    /// t − t' has the sign of x + y with x = p − p' and y = σ√D − σ'√D'. Where x and y have opposite signs,
    /// x² − y² = (x² − D − D') + 2 σ σ' √(D D') tells which outweighs the other.
    pub(crate) fn cmp(&self, other: &Self) -> Ordering {
        let x = &self.p - &other.p;
        let y = match (self.sigma, other.sigma) {
            (Ordering::Less, Ordering::Less) => other.discriminant.cmp(&self.discriminant),
            (Ordering::Greater, Ordering::Greater) => self.discriminant.cmp(&other.discriminant),
            // With σ = +1, D is above zero: q < 0, or q = 0 and b < 0.
            (sigma, _) => sigma,
        };
        let same = if self.sigma == other.sigma { Ordering::Greater } else { Ordering::Less };
        let squares = &x * &x - &self.discriminant - &other.discriminant;
        let product = IBig::from(4) * &self.discriminant * &other.discriminant;
        outweigh(sign(&x), y, || sign_of_sum(&squares, same, &product))
    }

    /// The nearest f32, ties to even: a search over bit patterns, whose order for positive f32 is that of
    /// their values, for the largest finite f32 not above t; then the middle between it and the next decides.
    /// The pattern of +∞ stands for 2¹²⁸.
    pub(crate) fn to_f32(&self) -> f32 {
        let infinity = f32::INFINITY.to_bits();
        let (mut below, mut above) = (0, infinity);
        while above - below > 1 {
            let middle = below + (above - below) / 2;
            if self.cmp_scaled(&(integer_of_bits(middle) * 2)) == Ordering::Less {
                above = middle;
            } else {
                below = middle;
            }
        }
        let middle = integer_of_bits(below) + integer_of_bits(below + 1);
        let bits = match self.cmp_scaled(&middle) {
            Ordering::Less => below,
            Ordering::Greater => below + 1,
            Ordering::Equal => below + below % 2,
        };
        f32::from_bits(bits)
    }

    /// An interval that holds t, of two f32 steps.
    pub(crate) fn to_interval(&self) -> Interval {
        let t = self.to_f32();
        Interval { lo: f64::from(t.next_down()), hi: f64::from(t.next_up()) }
    }

    /// Compares t with m / 2¹⁵⁰: the sign of (p 2¹⁵⁰ − a m) + σ √(D 2³⁰⁰).
    fn cmp_scaled(&self, m: &IBig) -> Ordering {
        let rational = (&self.p << 150) - &self.a * m;
        sign_of_sum(&rational, self.sigma, &(&self.discriminant << 300))
    }
}

/// The sign of x + σ √d, for σ = ±1.
fn sign_of_sum(x: &IBig, sigma: Ordering, d: &IBig) -> Ordering {
    let y = if *d == IBig::ZERO { Ordering::Equal } else { sigma };
    outweigh(sign(x), y, || (x * x).cmp(d))
}

/// The sign of x + y from the signs of x and y and, if these are opposite, of x² − y².
fn outweigh(x: Ordering, y: Ordering, squares: impl FnOnce() -> Ordering) -> Ordering {
    if x == Ordering::Equal || x == y {
        y
    } else if y == Ordering::Equal {
        x
    } else if x == Ordering::Greater {
        squares()
    } else {
        squares().reverse()
    }
}

fn sign(x: &IBig) -> Ordering {
    x.cmp(&IBig::ZERO)
}

fn dot(u: &[IBig; 3], v: &[IBig; 3]) -> IBig {
    &u[0] * &v[0] + &u[1] * &v[1] + &u[2] * &v[2]
}

/// x times 2¹⁴⁹, for finite x.
fn integer(x: f32) -> IBig {
    let magnitude = integer_of_bits(x.to_bits() & 0x7fff_ffff);
    if x < 0.0 { -magnitude } else { magnitude }
}

/// The f32 with these bits, sign bit clear, times 2¹⁴⁹.
fn integer_of_bits(bits: u32) -> IBig {
    let (exponent, fraction) = (bits >> 23, bits & 0x7f_ffff);
    if exponent == 0 {
        IBig::from(fraction)
    } else {
        IBig::from(fraction + 0x80_0000) << (exponent as usize - 1)
    }
}
