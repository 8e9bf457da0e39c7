//! The truth in integers, for the few rays that f64 leaves undecided.
//!
//! In: a ray, spheres, all exact f32 numbers. Out: the id and the correctly rounded t of rules 2 and 3. Nothing is refused and
//! nothing rounded, but t at the end.
//!
//! Positions and directions are scaled apart to integers by their least exponents. A sphere is then the parabola
//! p(t) = a t² + 2 b t + q, whose a belongs to the ray alone, and *one* question answers all others: how does a root compare with a
//! rational x? The sign of p(x) says whether x is outside the sphere, and the side of the vertex −b/a on which x lies says before
//! or behind (`place`). No square root is taken and none squared away:
//!
//! - *Which of two roots is nearer?* At a root t₁ of p₁, the other parabola has the value p₂(t₁) − p₁(t₁) = 2(b₂ − b₁) t₁ + q₂ − q₁,
//!   since the squares cancel. Its sign is how t₁ compares with a rational, and so is the side of p₂'s vertex.
//! - *To which f32 is a root rounded?* By comparisons with the middles between neighbours.

use crate::integer::Wide;
use contract::Sphere;
use std::cmp::Ordering;

/// Which root counts.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Which {
    /// The eye is outside.
    Nearer,
    /// The eye is inside or on the surface.
    Farther,
}

/// A ray's smallest positive root with a sphere.
struct Root {
    which: Which,
    a: Wide,
    b: Wide,
    q: Wide,
}

/// Numbers as integers times 2^exponent, by the least exponent among them.
struct Scale {
    exponent: i32,
}

impl Scale {
    fn of(numbers: impl Iterator<Item = f32>) -> Self {
        let exponent = numbers.filter(|&x| x != 0.0).map(|x| parts(x).1).min();
        Self { exponent: exponent.unwrap_or(0) }
    }

    fn integer(&self, x: f32) -> Wide {
        let (mantissa, exponent) = parts(x);
        if mantissa == 0 {
            Wide::ZERO
        } else {
            Wide::new(mantissa, (exponent - self.exponent).unsigned_abs())
        }
    }
}

/// x as an integer times a power of two; odd, so that the exponent is as large as can be.
fn parts(x: f32) -> (i64, i32) {
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 23 & 0xff).cast_signed(), i64::from(bits & 0x7f_ffff));
    let magnitude = if exponent == 0 { fraction } else { fraction | 0x80_0000 };
    let shift = if magnitude == 0 { 0 } else { magnitude.trailing_zeros() };
    let mantissa = magnitude >> shift;
    (if x < 0.0 { -mantissa } else { mantissa }, exponent.max(1) - 150 + shift.cast_signed())
}

/// The nearest sphere among some, by id, and its t. The lowest id has equal roots.
#[must_use]
pub fn nearest<'a>(
    eye: [f32; 3],
    dir: [f32; 3],
    spheres: impl Iterator<Item = (u32, &'a Sphere)> + Clone,
) -> Option<(u32, f32)> {
    let numbers = spheres.clone().flat_map(|(_, s)| s.center.into_iter().chain([s.radius]));
    let position = Scale::of(eye.into_iter().chain(numbers));
    let direction = Scale::of(dir.into_iter());
    let mut best: Option<(u32, Root)> = None;
    for (id, sphere) in spheres {
        let Some(root) = Root::of(eye, dir, sphere, &position, &direction) else { continue };
        let nearer = match &best {
            None => true,
            Some((other, nearest)) => match root.compare(nearest) {
                Ordering::Less => true,
                Ordering::Equal => id < *other,
                Ordering::Greater => false,
            },
        };
        if nearer {
            best = Some((id, root));
        }
    }
    best.map(|(id, root)| (id, root.rounded(position.exponent - direction.exponent)))
}

impl Root {
    fn of(
        eye: [f32; 3],
        dir: [f32; 3],
        sphere: &Sphere,
        position: &Scale,
        direction: &Scale,
    ) -> Option<Self> {
        let d = dir.map(|x| direction.integer(x));
        let f = [0, 1, 2].map(|i| position.integer(eye[i]).sub(&position.integer(sphere.center[i])));
        let r = position.integer(sphere.radius);
        let (a, b) = (dot(&d, &d), dot(&f, &d));
        let q = dot(&f, &f).sub(&r.mul(&r));
        if a.sign() == Ordering::Equal || b.mul(&b).sub(&a.mul(&q)).sign() == Ordering::Less {
            return None;
        }
        let which = match (q.sign(), b.sign()) {
            (Ordering::Greater, Ordering::Less) => Which::Nearer,
            (Ordering::Less, _) | (Ordering::Equal, Ordering::Less) => Which::Farther,
            _ => return None,
        };
        Some(Self { which, a, b, q })
    }

    /// This root against that of another sphere, for the same ray.
    fn compare(&self, other: &Self) -> Ordering {
        let steeper = other.b.sub(&self.b);
        let steeper = steeper.add(&steeper);
        let higher = other.q.sub(&self.q);
        let outside = match steeper.sign() {
            Ordering::Equal => higher.sign(),
            Ordering::Greater => self.against(&higher.negated(), &steeper),
            Ordering::Less => self.against(&higher, &steeper.negated()).reverse(),
        };
        place(outside, self.against(&other.b.negated(), &other.a), other.which)
    }

    /// This root against n / m, m > 0.
    fn against(&self, n: &Wide, m: &Wide) -> Ordering {
        let twice = self.b.add(&self.b);
        let value = self.a.mul(n).add(&twice.mul(m)).mul(n).add(&self.q.mul(m).mul(m));
        let side = self.a.mul(n).add(&self.b.mul(m));
        place(value.sign(), side.sign(), self.which).reverse()
    }

    /// The nearest f32, ties to even, of this root times 2^exponent: the lowest bit pattern with the root below the middle between
    /// it and the next, found by halving. The pattern of +∞ stands for 2¹²⁸.
    fn rounded(&self, exponent: i32) -> f32 {
        let (mut low, mut high) = (0, f32::INFINITY.to_bits());
        while low < high {
            let bits = low + (high - low) / 2;
            let order = self.against_middle(bits, exponent);
            if order == Ordering::Less || (order == Ordering::Equal && bits.is_multiple_of(2)) {
                high = bits;
            } else {
                low = bits + 1;
            }
        }
        f32::from_bits(low)
    }

    /// This root times 2^exponent against the middle between the f32 of these bits and the next.
    fn against_middle(&self, bits: u32, exponent: i32) -> Ordering {
        let (field, fraction) = ((bits >> 23).cast_signed(), i64::from(bits & 0x7f_ffff));
        let magnitude = if field == 0 { fraction } else { fraction | 0x80_0000 };
        let shift = field.max(1) - 151 - exponent;
        let up = Wide::new(2 * magnitude + 1, shift.max(0).unsigned_abs());
        self.against(&up, &Wide::new(1, (-shift).max(0).unsigned_abs()))
    }
}

/// Where x lies from a root, by the sign of the parabola at x and by the side of the vertex on which x is.
fn place(value: Ordering, side: Ordering, which: Which) -> Ordering {
    let before = match which {
        Which::Nearer => Ordering::Less,
        Which::Farther => Ordering::Greater,
    };
    match value {
        Ordering::Greater if side == before => before,
        Ordering::Equal if side != before.reverse() => Ordering::Equal,
        _ => before.reverse(),
    }
}

fn dot(u: &[Wide; 3], v: &[Wide; 3]) -> Wide {
    u[0].mul(&v[0]).add(&u[1].mul(&v[1])).add(&u[2].mul(&v[2]))
}
