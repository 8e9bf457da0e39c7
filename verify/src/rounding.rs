//! The f64 stage's bounds held against whole numbers: what its shipped code says of a ray and a ball must be true, on floats of so few
//! bits that all inputs of a domain can be tried.
//!
//! In: a ray and a ball in whole numbers, and the [`Few`] to be used. Out: how much was decided, and the first falsehood in full. The truth
//! needs no root: t lies below, at or above a float x as the polynomial a x² + 2 b x + q and its slope say there, and x is a
//! whole number over a power of two.

use crate::few::{Few, nearest};
use contract::Sphere;
use optimized::double::{Answer, ask, root, short_ends, short_error};
use optimized::host::Scalar;
use optimized::machine::LANES;
use std::cmp::Ordering;
use std::ops::Add;

/// A ray and a ball; every number is a float of at most half as many bits as the one that computes.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Where the ray begins.
    pub eye: [i64; 3],
    /// Where it goes; not zero.
    pub dir: [i64; 3],
    /// The ball's centre.
    pub center: [i64; 3],
    /// Its radius.
    pub radius: i64,
}

impl Case {
    /// Where its smallest root above 0 lies as seen from x, a float of few bits that is not negative. None if there is none.
    #[must_use]
    pub fn root_from(&self, x: f64) -> Option<Ordering> {
        let truth = Polynomial::of(self);
        truth.hits().then(|| truth.root_from(x))
    }
}

/// Sixteen directions.
pub type Directions = [[i64; 3]; LANES];

/// What can be said, and false.
pub const FALSEHOODS: [&str; 5] = [
    "a hit is called a miss",
    "a miss is called a hit",
    "the root lies elsewhere",
    "the root is rounded otherwise",
    "the answer is not what was found",
];

/// What was said of rays and balls, and whether it was true.
#[derive(Clone, Debug, Default)]
pub struct Said {
    /// Rays and balls.
    pub inputs: u64,
    /// Of these, tangent ones.
    pub tangent: u64,
    /// … seen from inside the ball.
    pub inside: u64,
    /// … from its surface.
    pub surface: u64,
    /// … that hit.
    pub hit: u64,
    /// Certain hits, whose root was held against its interval.
    pub hits: u64,
    /// Of these, from inside.
    pub hits_inside: u64,
    /// Certain misses.
    pub misses: u64,
    /// Certain hits whose root was rounded.
    pub rounded: u64,
    /// The inputs of the float that a rounding changed: whose centre, seen from the eye, is not exact.
    pub inexact: u64,
    /// Said, and false, in the order of [`FALSEHOODS`].
    pub wrong: [u64; FALSEHOODS.len()],
    /// The first of these.
    pub first: Option<String>,
}

impl Add for Said {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            inputs: self.inputs + other.inputs,
            tangent: self.tangent + other.tangent,
            inside: self.inside + other.inside,
            surface: self.surface + other.surface,
            hit: self.hit + other.hit,
            hits: self.hits + other.hits,
            hits_inside: self.hits_inside + other.hits_inside,
            misses: self.misses + other.misses,
            rounded: self.rounded + other.rounded,
            inexact: self.inexact + other.inexact,
            wrong: std::array::from_fn(|i| self.wrong[i] + other.wrong[i]),
            first: self.first.or(other.first),
        }
    }
}

/// a x² + 2 b x + q, whose root is asked for.
#[derive(Clone, Copy, Debug)]
struct Polynomial {
    a: i128,
    b: i128,
    q: i128,
}

impl Polynomial {
    fn of(case: &Case) -> Self {
        let dot =
            |u: [i64; 3], v: [i64; 3]| -> i128 { (0..3).map(|i| i128::from(u[i]) * i128::from(v[i])).sum() };
        let f = [0, 1, 2].map(|i| case.eye[i] - case.center[i]);
        let r = i128::from(case.radius);
        Self { a: dot(case.dir, case.dir), b: dot(f, case.dir), q: dot(f, f) - r * r }
    }

    fn discriminant(&self) -> i128 {
        self.b * self.b - self.a * self.q
    }

    /// Whether it has a root above 0.
    fn hits(&self) -> bool {
        self.discriminant() >= 0 && (self.q < 0 || self.b < 0)
    }

    /// Where the smallest root above 0 lies as seen from x >= 0; there must be one.
    fn root_from(&self, x: f64) -> Ordering {
        let (m, s) = whole(x);
        let at = self.a * m * m + ((2 * self.b * m) << s) + (self.q << (2 * s));
        if self.q > 0 {
            // The lesser root, which lies before the vertex or at it.
            if self.a * m + (self.b << s) > 0 { Ordering::Less } else { at.cmp(&0) }
        } else if m == 0 {
            Ordering::Greater
        } else {
            0.cmp(&at)
        }
    }
}

/// A float that is not negative as a whole number over a power of two.
fn whole(x: f64) -> (i128, u32) {
    assert!(x >= 0.0 && x.is_finite(), "{x}");
    if x == 0.0 {
        return (0, 0);
    }
    let fraction = x.to_bits() & ((1 << 52) - 1) | 1 << 52;
    let zeros = fraction.trailing_zeros();
    let exponent = i64::from(zeros) + (x.to_bits() >> 52).cast_signed() - 1075;
    assert!(exponent.abs() <= 40, "{x} is out of range");
    let (m, shift) = (i128::from(fraction >> zeros), u32::try_from(exponent.abs()).expect("at most 40"));
    if exponent > 0 { (m << shift, 0) } else { (m, shift) }
}

#[allow(clippy::cast_precision_loss, reason = "the caller gives floats")]
fn floats(x: [i64; 3]) -> [f32; 3] {
    x.map(|x| x as f32)
}

impl Said {
    fn judge(&mut self, case: &Case, said: impl std::fmt::Debug, verdict: Option<usize>) {
        if let Some(what) = verdict {
            self.wrong[what] += 1;
            self.first.get_or_insert_with(|| format!("{}: {case:?}: {said:?}", FALSEHOODS[what]));
        }
    }

    fn count(&mut self, case: &Case, truth: &Polynomial, bits: u32) {
        self.inputs += 1;
        self.tangent += u64::from(truth.discriminant() == 0);
        self.inside += u64::from(truth.q < 0);
        self.surface += u64::from(truth.q == 0);
        self.hit += u64::from(truth.hits());
        let exact = |i: usize| {
            let f = (case.eye[i] - case.center[i]) as f64;
            nearest(f, bits) == f
        };
        self.inexact += u64::from(!(exact(0) && exact(1) && exact(2)));
    }

    /// Holds what [`root`] and [`ask`] say against the truth.
    pub fn root<const BITS: u32, const NARROW: u32, const TOLD: u32>(&mut self, case: &Case) {
        let truth = Polynomial::of(case);
        self.count(case, &truth, BITS);
        let sphere = Sphere { center: floats(case.center), radius: case.radius as f32, color: [0; 3] };
        let (eye, dir) = (floats(case.eye), floats(case.dir));
        let found = root::<Few<BITS, NARROW, TOLD>>(eye, dir, sphere.center, sphere.radius);
        let asked = ask::<Few<BITS, NARROW, TOLD>>(eye, dir, &sphere);
        let verdict = match (asked, found.miss, found.hit) {
            _ if found.miss && truth.hits() => Some(0),
            _ if found.hit && !truth.hits() && !found.miss => Some(1),
            (Answer::Miss, true, _) => {
                self.misses += 1;
                None
            }
            (Answer::Hit([lo, hi]), false, true) => {
                self.hits += 1;
                self.hits_inside += u64::from(truth.q < 0);
                let ends = [truth.root_from(lo.value()), truth.root_from(hi.value())];
                let [low, high] = found.ends();
                let same = low.to_bits() == high.to_bits();
                self.rounded += u64::from(same);
                if ends[0] == Ordering::Less || ends[1] == Ordering::Greater {
                    Some(2)
                } else {
                    (same && !rounds_within(&truth, [low, high], NARROW)).then_some(3)
                }
            }
            (Answer::Undecided, false, false) => None,
            _ => Some(4),
        };
        self.judge(case, found, verdict);
    }

    /// Holds what the short way says of sixteen directions against the truth.
    pub fn short<const BITS: u32, const NARROW: u32, const TOLD: u32>(
        &mut self,
        case: &Case,
        dirs: &Directions,
    ) {
        let center = floats(case.center);
        let f = [0, 1, 2].map(|i| (case.eye[i] - case.center[i]).unsigned_abs() as f32);
        let radius = [case.radius as f32; LANES];
        let error = short_error::<Few<BITS, NARROW, TOLD>, _>(Scalar, f.map(|x| [x; LANES]), radius);
        let dir = [0, 1, 2].map(|i| dirs.map(|d| d[i] as f32));
        let center = center.map(|x| [x; LANES]);
        let [lo, hi] =
            short_ends::<Few<BITS, NARROW, TOLD>>(floats(case.eye), &dir, &center, &radius, &error);
        for lane in 0..LANES {
            let case = Case { dir: dirs[lane], ..*case };
            let truth = Polynomial::of(&case);
            self.count(&case, &truth, BITS);
            // Where it is known to hit, both ends are: above 0, and on no more than half of it and one and a half times it.
            let [lo, hi] = [lo[lane], hi[lane]];
            if !(lo > 0.0 && hi < 2.0 * lo) {
                self.judge(&case, ([lo, hi], error[lane]), (lo == hi).then_some(3));
                continue;
            }
            self.hits += 1;
            self.rounded += u64::from(lo == hi);
            let verdict = if !truth.hits() {
                Some(1)
            } else if truth.q <= 0 || !rounds_within(&truth, [lo, hi], NARROW) {
                Some(if lo == hi { 3 } else { 2 })
            } else {
                None
            };
            self.judge(&case, ([lo, hi], error[lane]), verdict);
        }
    }
}

/// Whether the root, rounded to so many bits, is one of two floats of these or between them.
fn rounds_within(truth: &Polynomial, ends: [f32; 2], bits: u32) -> bool {
    let drop = 53 - bits;
    let [lo, hi] = ends.map(|end| f64::from(end).to_bits() >> drop);
    let middle = |rank: u64| (f64::from_bits(rank << drop) + f64::from_bits((rank + 1) << drop)) / 2.0;
    // A root half-way between two floats goes to the even one.
    let (from_below, from_above) = (truth.root_from(middle(lo - 1)), truth.root_from(middle(hi)));
    (from_below == Ordering::Greater || (lo & 1 == 0 && from_below == Ordering::Equal))
        && (from_above == Ordering::Less || (hi & 1 == 0 && from_above == Ordering::Equal))
}
