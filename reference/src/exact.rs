//! The truth for one ray: the loop over all spheres with every decision exact.
//!
//! [`nearest_unfiltered`] asks integers everything. [`nearest`] is the same loop with two filters in front:
//!
//! 1. *Certain miss.* With u = 2⁻⁵³, f64 arithmetic on f32 input and neither over- nor underflow, textbook
//!    error analysis of D = b² − a q gives, to first order,
//!    |δb| <= 4u |f||d|, |δ(b²)| <= 9u a|f|², |δq| <= 6u|f|² + 2u r², |δ(a q)| <= u a (10|f|² + 6r²), and the
//!    last subtraction u a (|f|² + r²); in sum at most 21u a (|f|² + r²). Terms of second order and the
//!    rounding of the bound itself are below one part in 10⁹, so a computed D below −32u a (|f|² + r²)
//!    is negative in truth. This settles nearly all spheres of a ray.
//! 2. *Intervals* ([`Interval`]) for D, q, b and the root of what is left. Signs that an interval does not
//!    settle, roots whose intervals overlap, and roots whose interval holds a rounding boundary of f32 go to
//!    integers, and are counted.

use crate::eights::each;
use crate::interval::Interval;
use crate::root::Root;
use crate::{Hit, Ray, Undecided};
use contract::Sphere;
use multiversion::multiversion;
use std::cmp::Ordering;

/// 32 units of f64 rounding: see the module's text.
const MISS_BOUND: f64 = 32.0 / (1u64 << 53) as f64;

/// The nearest hit, integers throughout.
pub(crate) fn nearest_unfiltered(ray: &Ray, spheres: &[Sphere]) -> Option<Hit> {
    let mut best: Option<(u32, Root)> = None;
    for (id, sphere) in (0..).zip(spheres) {
        let Some(root) = Root::of(ray, sphere) else { continue };
        if best.as_ref().is_none_or(|(_, nearest)| root.cmp(nearest) == Ordering::Less) {
            best = Some((id, root));
        }
    }
    best.map(|(id, root)| Hit { id, t: root.to_f32() })
}

/// The nearest hit, the same decisions with the filters in front.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn nearest(ray: &Ray, spheres: &[Sphere], undecided: &mut Undecided) -> Option<Hit> {
    let mut best: Option<(u32, Interval)> = None;
    let meet = |id, sphere: &Sphere| {
        let Some(t) = root_interval(ray, sphere, undecided) else { return };
        let nearer = match best {
            None => true,
            Some((_, nearest)) if t.hi < nearest.lo => true,
            Some((_, nearest)) if t.lo > nearest.hi => false,
            Some((other, _)) => {
                undecided.orders += 1;
                exact_root(ray, sphere).cmp(&exact_root(ray, &spheres[other as usize])) == Ordering::Less
            }
        };
        if nearer {
            best = Some((id, t));
        }
    };
    each(spheres, |sphere| !certain_miss(ray, sphere), meet);
    best.map(|(id, t)| Hit { id, t: rounded(ray, &spheres[id as usize], t, undecided) })
}

#[inline]
fn certain_miss(ray: &Ray, sphere: &Sphere) -> bool {
    let d = ray.dir.map(f64::from);
    let f = [0, 1, 2].map(|i| f64::from(ray.eye[i]) - f64::from(sphere.center[i]));
    let rr = f64::from(sphere.radius) * f64::from(sphere.radius);
    let a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let b = f[0] * d[0] + f[1] * d[1] + f[2] * d[2];
    let ff = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
    b * b - a * (ff - rr) < -MISS_BOUND * (a * (ff + rr))
}

/// An interval around the smallest positive root, if there is one.
fn root_interval(ray: &Ray, sphere: &Sphere, undecided: &mut Undecided) -> Option<Interval> {
    let dot = |u: [Interval; 3], v: [Interval; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let d = ray.dir.map(Interval::of);
    let f = [0, 1, 2].map(|i| Interval::of(ray.eye[i]) - Interval::of(sphere.center[i]));
    let r = Interval::of(sphere.radius);
    let (a, b, q) = (dot(d, d), dot(f, d), dot(f, f) - r * r);
    let discriminant = b * b - a * q;
    let root = discriminant.sqrt();

    let outside_and_ahead = q.is_positive() && b.is_negative();
    if discriminant.is_negative() || (q.is_positive() && b.is_positive()) {
        return None;
    }
    if discriminant.is_positive() && outside_and_ahead {
        return Some(q / (root - b));
    }
    if discriminant.is_positive() && q.is_negative() && a.is_positive() {
        return Some((root - b) / a);
    }
    undecided.hits += 1;
    let exact = Root::of(ray, sphere)?;
    Some(if outside_and_ahead { q / (root - b) } else { exact.to_interval() })
}

/// The f32 nearest to a root that is known to be there and to lie in `t`.
fn rounded(ray: &Ray, sphere: &Sphere, t: Interval, undecided: &mut Undecided) -> f32 {
    #[allow(clippy::cast_possible_truncation, reason = "this is the rounding of rule 3")]
    let (lo, hi) = (t.lo as f32, t.hi as f32);
    if lo.to_bits() == hi.to_bits() {
        return lo;
    }
    undecided.roundings += 1;
    exact_root(ray, sphere).to_f32()
}

fn exact_root(ray: &Ray, sphere: &Sphere) -> Root {
    Root::of(ray, sphere).expect("only spheres that are hit are compared and rounded")
}
