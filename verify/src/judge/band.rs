//! The judge's own ruler: for one ray, one sphere and one rounding form, which answers can rounding explain?
//!
//! The form's errors are bounded from its operations alone (u = 2⁻²⁴ or 2⁻⁵³), on values that the judge
//! computes in f64 from the same input; the judge's own rounding (v = 2⁻⁵³) is put on top. With f = eye − c,
//! F = |f|, n = |d|, a = n², b = f·d, L the centre's distance from the line, to first order in u:
//!
//! - *Textbook.* f: uF. b: 4uFn. a: 3ua. q = f·f − r²: 6uF² + 2ur². b²: 9uaF². a q: ua (10F² + 6r²). The last
//!   difference: ua (F² + r²). So D is off by at most 21 ua (F² + r²). The root: 1u; the sum: 1u; the
//!   quotient: 3u of a and 1u.
//! - *Perpendicular.* w = 1/a: 4u. h = b w: 10uF/n. |l|²: 6uLF + 3uL² + 170 (uF)²; r²: ur²; the difference:
//!   uD. So D is off by at most u (6LF + 4L² + 2r²) + 170 (uF)². √(D w): 4u. The sum: 1u.
//!
//! - *Embree's sphere points* (its `sphere_intersector.h`), the perpendicular form with an estimate for w: `rcpps` is
//!   off by at most 1.5·2⁻¹² and one Newton step squares that, 2.25u, and rounds twice; with a's 3u, w: 8u (`rcp14`
//!   and fused steps lose less). h: 13uF/n. |l|²: 6uLF + 3uL² + 256 (uF)². √(D w): 6u. Of what it must find, its boxes
//!   take something off: a box is c ± r, rounded, and crossing one (`node_intersector1.h`, robust) may fail where less
//!   than 1u of t lies within; so the sphere is certain to be found, and before any box behind t (1 + 3u) is given up,
//!   if the ray hits the smaller one of radius r − e, e = u (max|cᵢ| + r) + u (F + r). Rays are asked
//!   from t = 2⁻¹²⁶ on, the least that is not flushed to zero.
//!
//! - *On the SPU* (contract, rule 6) every operation is off by less than 8u of its result, since a division is by less than 4u, a root
//!   by less than 4u and any other by less than 2u: both forms with 8u in place of u. What is lost of quotients below 2⁻⁷⁹ is less than
//!   what is put on for b.
//!
//! Terms of second order and v are covered by 2 % on top. A t that fits f32 is then rounded once more. In f32 that of a hit
//! is above 0, and on the SPU a normal number; in f64 it may become 0 by that last rounding.
//! Nothing is stated where f32 could over- or underflow on the way.

use crate::subject::Rounding;
use contract::Sphere;
use reference::Ray;

/// What rounding can make of a ray and a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Calling it a hit can be explained, with these t.
    pub may_hit: Option<Open>,
    /// Calling it a miss cannot be explained, nor can a hit on something behind this t.
    pub must_hit: Option<f64>,
}

/// The t of a hit that can be explained: from the first to the second of the near root, of the far root where the near one may
/// not count, or of either. What lies between two roots is the t of none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Open(pub [Option<[f64; 2]>; 2]);

impl Open {
    /// Whether it is one of them.
    #[must_use]
    pub fn holds(&self, t: f32) -> bool {
        self.0.iter().flatten().any(|[lo, hi]| (*lo..=*hi).contains(&f64::from(t)))
    }

    /// The least and the largest of them.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        let fold = |one: [f64; 2], other: &[f64; 2]| [one[0].min(other[0]), one[1].max(other[1])];
        self.0.iter().flatten().fold([f64::INFINITY, f64::NEG_INFINITY], fold)
    }

    /// Those up to `latest`, if there are any.
    #[must_use]
    pub fn until(self, latest: f64) -> Option<Self> {
        Self::of(self.0.map(|range| range.map(|[lo, hi]| [lo, hi.min(latest)])))
    }

    /// Ranges that are not empty, if there are any.
    fn of(ranges: [Option<[f64; 2]>; 2]) -> Option<Self> {
        let ranges = ranges.map(|range| range.filter(|[lo, hi]| lo <= hi));
        ranges.iter().any(Option::is_some).then_some(Self(ranges))
    }
}

/// The band of a ray and a sphere; `None` if the form's bound states nothing for them.
#[must_use]
pub fn band(rounding: Rounding, ray: &Ray, sphere: &Sphere) -> Option<Band> {
    let geometry = Geometry::new(ray, sphere);
    match rounding {
        Rounding::TextbookF64 => Some(geometry.textbook(V, above(0.0))),
        Rounding::TextbookF32 => geometry.in_range(GRADUAL).then(|| geometry.textbook(U, above(LEAST))),
        Rounding::PerpendicularF32 => {
            geometry.in_range(GRADUAL).then(|| geometry.perpendicular(&NAIVE, above(LEAST)))
        }
        Rounding::TextbookSpu => {
            geometry.in_range(REMAINS).then(|| geometry.textbook(ON_SPU, above(LEAST_NORMAL)))
        }
        Rounding::PerpendicularSpu => {
            let form = Perpendicular { unit: ON_SPU, ..NAIVE };
            geometry.in_range(REMAINS).then(|| geometry.perpendicular(&form, above(LEAST_NORMAL)))
        }
    }
}

/// The band of a ray and a sphere point of Embree's; `None` if nothing is stated for them.
#[must_use]
pub fn embree_band(ray: &Ray, sphere: &Sphere) -> Option<Band> {
    Geometry::new(ray, sphere).embree(sphere)
}

const U: f64 = 1.0 / (1u64 << 24) as f64;
const ON_SPU: f64 = 8.0 * U;
const V: f64 = 1.0 / (1u64 << 53) as f64;

/// 2⁴⁰ times the least f32, and 2⁴⁰ times the least that is not flushed to zero.
const GRADUAL: f64 = f64::from_bits((1023 - 109) << 52);
const FLUSHED: f64 = f64::from_bits((1023 - 86) << 52);
/// Above this the SPU's roots lose no remainder that counts: below 2⁻⁷⁹ they are off by 2⁻¹² of themselves, which then is less than what
/// 8u of the other terms make of D.
const REMAINS: f64 = f64::from_bits((1023 - 60) << 52);

/// What tells the perpendicular forms apart: u, and in u the errors of h and √(D w), and the second-order term of |l|².
struct Perpendicular {
    unit: f64,
    h: f64,
    root: f64,
    second: f64,
}

const NAIVE: Perpendicular = Perpendicular { unit: U, h: 10.0, root: 4.0, second: 170.0 };
const EMBREE: Perpendicular = Perpendicular { unit: U, h: 13.0, root: 6.0, second: 256.0 };

/// What comes before and after the formula itself: what a search may lose of D before the formula is asked, and the
/// least t that counts; the least that is given.
#[derive(Clone, Copy)]
struct Search {
    lost: f64,
    least: f64,
    floor: f64,
}

/// A search that asks the formula of every sphere, and gives no t below a floor.
fn above(floor: f64) -> Search {
    Search { lost: 0.0, least: LEAST, floor }
}

/// The least f32.
const LEAST: f64 = f32::from_bits(1) as f64;
/// The least normal f32, from which on rays are asked.
const LEAST_NORMAL: f64 = f64::from_bits((1023 - 126) << 52);
/// Embree drops a sphere of a number beyond 1.844·10¹⁸ and says nothing.
const LARGE: f64 = f64::from_bits((1023 + 60) << 52);

struct Geometry {
    a: f64,
    b: f64,
    ff: f64,
    rr: f64,
}

impl Geometry {
    fn new(ray: &Ray, sphere: &Sphere) -> Self {
        let d = ray.dir.map(f64::from);
        let f = [0, 1, 2].map(|i| f64::from(ray.eye[i]) - f64::from(sphere.center[i]));
        let dot = |u: [f64; 3], v: [f64; 3]| (0..3).map(|i| u[i] * v[i]).sum::<f64>();
        let r = f64::from(sphere.radius);
        Self { a: dot(d, d), b: dot(f, d), ff: dot(f, f), rr: r * r }
    }

    /// Whether f32 neither overflows nor loses anything that counts to underflow: the largest product a F² (and
    /// b², which is no larger) stays below 2¹²⁶, and so does (F² + r²)/a, which bounds t² and what is under the root;
    /// a r², r²/a and a stay above `small`. Then F² + r², a and 1/a stay below 2¹²⁶ too, and r² above `small`.
    fn in_range(&self, small: f64) -> bool {
        let large = 2f64.powi(126);
        let square = self.ff + self.rr;
        self.a * square < large
            && square < large * self.a
            && self.a * self.rr > small
            && self.rr > small * self.a
            && self.a > small
    }

    fn textbook(&self, unit: f64, search: Search) -> Band {
        let u = 1.02 * (unit + V);
        let (far, n) = (self.ff.sqrt(), self.a.sqrt());
        let discriminant = self.b * self.b - self.a * (self.ff - self.rr);
        let error = 21.0 * u * self.a * (self.ff + self.rr);
        let roots = |error: f64| {
            let b = Span::about(-self.b, 4.0 * u * far * n);
            let s = Span::root(discriminant, error).widen(u);
            let t = |sum: Span| sum.scale(1.0 / self.a).widen(5.0 * u);
            [t(b.minus(s)), t(b.plus(s))]
        };
        banded(discriminant, error, search, roots)
    }

    /// Sphere points of Embree. Its direction has no component below 10⁻¹⁸: with a above 2⁻⁴⁰ the ray strays by less
    /// than 2⁻³⁹ F, far below the 2 % that are put on top of what its boxes lose.
    fn embree(&self, sphere: &Sphere) -> Option<Band> {
        let r = f64::from(sphere.radius);
        let corner = sphere.center.iter().map(|x| f64::from(x.abs())).fold(0.0, f64::max);
        if !self.in_range(FLUSHED) || self.a < 2f64.powi(-40) || self.ff > LARGE * LARGE || corner + r > LARGE
        {
            return None;
        }
        // Far below any error of D: nearly all spheres of a ray go no further.
        let discriminant = self.b * self.b - self.a * (self.ff - self.rr);
        if discriminant < -2f64.powi(-20) * self.a * (self.ff + self.rr) {
            return Some(Band { may_hit: None, must_hit: None });
        }
        let far = self.ff.sqrt();
        let lost = 1.02 * U * ((corner + r) + (far + r));
        Some(self.perpendicular(
            &EMBREE,
            Search { lost: 2.0 * r * lost, least: LEAST_NORMAL, floor: LEAST_NORMAL },
        ))
    }

    fn perpendicular(&self, form: &Perpendicular, search: Search) -> Band {
        let (far, n) = (self.ff.sqrt(), self.a.sqrt());
        let ll = (self.ff - self.b * self.b / self.a).max(0.0);
        let u = 1.02 * form.unit;
        let error =
            u * (6.0 * ll.sqrt() * far + 4.0 * ll + 2.0 * self.rr + form.second * form.unit * self.ff);
        let roots = |error: f64| {
            let h = Span::about(-self.b / self.a, form.h * u * far / n);
            let s = Span::root((self.rr - ll) / self.a, error / self.a).widen(form.root * u);
            let t = |sum: Span| sum.widen(u);
            [t(h.minus(s)), t(h.plus(s))]
        };
        banded(self.rr - ll, error, search, roots)
    }
}

/// The shared ending of rule 5: near if it is above 0, else far; a hit if D >= 0 and t > 0. `roots` gives the roots for
/// a D that is off by so much.
fn banded(discriminant: f64, error: f64, search: Search, roots: impl Fn(f64) -> [Span; 2]) -> Band {
    let Search { lost, least, floor } = search;
    if discriminant + error < 0.0 {
        return Band { may_hit: None, must_hit: None };
    }
    // Rounding of t to f32 in the end (once more than needed for the f32 forms), and the least t.
    let ends = |error| roots(error).map(|t: Span| t.widen(U).add(least));
    let (may_hit, takes_far) = reachable(ends(error), floor);
    if discriminant - error - lost < 0.0 {
        return Band { may_hit, must_hit: None };
    }
    let [near, far] = ends(error + lost);
    let certain = !(takes_far && far.lo <= 0.0);
    // Boxes are crossed at t (1 + 3u) at most where something is lost.
    let delay = if lost > 0.0 { 1.0 + 4.0 * U } else { 1.0 };
    let (latest, _) = reachable([near, far], floor);
    Band { may_hit, must_hit: latest.filter(|_| certain).map(|open| open.ends()[1] * delay) }
}

/// Where a t above 0, and not below `floor`, can lie, and whether it can be that of the far root.
fn reachable([near, far]: [Span; 2], floor: f64) -> (Option<Open>, bool) {
    let takes_far = near.lo <= 0.0;
    let ranges = [Some(near), takes_far.then_some(far)].map(|root| {
        let Span { lo, hi } = root.filter(|root| root.hi > 0.0)?;
        // What rounds to more than the largest f32 is an infinite t.
        let top = if hi > f64::from(f32::MAX) { f64::INFINITY } else { hi };
        Some([lo.max(floor), top])
    });
    (Open::of(ranges), takes_far)
}

#[derive(Clone, Copy)]
struct Span {
    lo: f64,
    hi: f64,
}

impl Span {
    fn about(x: f64, error: f64) -> Self {
        Self { lo: x - error, hi: x + error }
    }

    fn root(x: f64, error: f64) -> Self {
        Self { lo: (x - error).max(0.0).sqrt(), hi: (x + error).max(0.0).sqrt() }
    }

    fn plus(self, other: Self) -> Self {
        Self { lo: self.lo + other.lo, hi: self.hi + other.hi }
    }

    fn minus(self, other: Self) -> Self {
        Self { lo: self.lo - other.hi, hi: self.hi - other.lo }
    }

    fn scale(self, factor: f64) -> Self {
        Self { lo: self.lo * factor, hi: self.hi * factor }
    }

    fn widen(self, relative: f64) -> Self {
        self.add(relative * self.lo.abs().max(self.hi.abs()))
    }

    fn add(self, error: f64) -> Self {
        Self { lo: self.lo - error, hi: self.hi + error }
    }
}
