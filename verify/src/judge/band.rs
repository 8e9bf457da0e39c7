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
//! Terms of second order and v are covered by 2 % on top. A t that fits f32 is then rounded once more.
//! Nothing is stated where f32 could over- or underflow on the way.

use crate::subject::Rounding;
use contract::Sphere;
use reference::Ray;

/// What rounding can make of a ray and a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Calling it a miss can be explained.
    pub may_miss: bool,
    /// Calling it a hit can be explained, with t from the first to the second.
    pub may_hit: Option<[f64; 2]>,
}

/// The band of a ray and a sphere; `None` if the form's bound states nothing for them.
#[must_use]
pub fn band(rounding: Rounding, ray: &Ray, sphere: &Sphere) -> Option<Band> {
    let geometry = Geometry::new(ray, sphere);
    match rounding {
        Rounding::TextbookF64 => Some(geometry.textbook(V)),
        Rounding::TextbookF32 => geometry.in_range().then(|| geometry.textbook(U)),
        Rounding::PerpendicularF32 => geometry.in_range().then(|| geometry.perpendicular(U)),
    }
}

const U: f64 = 1.0 / (1u64 << 24) as f64;
const V: f64 = 1.0 / (1u64 << 53) as f64;

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
    /// b², which is no larger) stays below 2¹²⁶; r², a r² and r²/a stay 2⁴⁰ times above the least f32, and
    /// so does a; 1/a and (F² + r²)/a, which bounds t² and what is under the root, stay below 2¹²⁶ too.
    fn in_range(&self) -> bool {
        let (large, small) = (2f64.powi(126), 2f64.powi(-109));
        let square = self.ff + self.rr;
        square < large
            && self.a < large
            && self.a * square < large
            && self.rr > small
            && self.a > small
            && self.a * self.rr > small
            && self.rr / self.a > small
            && self.a.recip() < large
            && square / self.a < large
    }

    fn textbook(&self, u: f64) -> Band {
        let (far, n) = (self.ff.sqrt(), self.a.sqrt());
        let discriminant = self.b * self.b - self.a * (self.ff - self.rr);
        let error = 1.02 * 21.0 * (u + V) * self.a * (self.ff + self.rr);
        let b = Span::about(-self.b, 1.02 * 4.0 * (u + V) * far * n);
        let s = Span::root(discriminant, error).widen(1.02 * (u + V));
        let t = |sum: Span| sum.scale(1.0 / self.a).widen(1.02 * 5.0 * (u + V));
        roots(discriminant, error, t(b.minus(s)), t(b.plus(s)))
    }

    fn perpendicular(&self, u: f64) -> Band {
        let (far, n) = (self.ff.sqrt(), self.a.sqrt());
        let ll = (self.ff - self.b * self.b / self.a).max(0.0);
        let error = u * (6.0 * ll.sqrt() * far + 4.0 * ll + 2.0 * self.rr) + 170.0 * u * u * self.ff;
        let error = 1.02 * error + 10.0 * V * self.ff;
        let h = Span::about(-self.b / self.a, 1.02 * 10.0 * u * far / n);
        let s = Span::root((self.rr - ll) / self.a, error / self.a).widen(1.02 * 4.0 * u);
        let t = |sum: Span| sum.widen(1.02 * u);
        roots(self.rr - ll, error, t(h.minus(s)), t(h.plus(s)))
    }
}

/// The shared ending of rule 5: near if it is above 0, else far; a hit if D >= 0 and t > 0.
fn roots(discriminant: f64, error: f64, near: Span, far: Span) -> Band {
    // Rounding of t to f32 in the end (once more than needed for the f32 forms), and the least f32.
    let [near, far] = [near, far].map(|t| t.widen(U).add(2f64.powi(-149)));
    let takes_far = near.lo <= 0.0;
    let mut t: Option<[f64; 2]> = None;
    for root in [Some(near), takes_far.then_some(far)].into_iter().flatten().filter(|root| root.hi > 0.0) {
        let [lo, hi] = t.unwrap_or([root.lo, root.hi]);
        // What rounds to more than the largest f32 is an infinite t.
        let top = if root.hi > f64::from(f32::MAX) { f64::INFINITY } else { root.hi };
        t = Some([lo.min(root.lo).max(0.0), hi.max(top)]);
    }
    let may_hit = t.filter(|_| discriminant + error >= 0.0);
    Band { may_miss: discriminant - error < 0.0 || (takes_far && far.lo <= 0.0), may_hit }
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
