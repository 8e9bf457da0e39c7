//! The textbook form in f64 (contract, rule 5), on glam's scalar vectors.

use crate::{Hit, Ray};
use contract::Sphere;
use glam::DVec3;

/// The nearest hit; t is rounded to f32 at the end.
#[allow(clippy::cast_possible_truncation, reason = "the one rounding of t that rule 5 prescribes")]
pub(crate) fn nearest(ray: &Ray, spheres: &[Sphere]) -> Option<Hit> {
    let (mut best, mut hit) = (f64::INFINITY, None);
    for (id, sphere) in (0..).zip(spheres) {
        if let Some(t) = root(ray, sphere)
            && t < best
        {
            (best, hit) = (t, Some(id));
        }
    }
    hit.map(|id| Hit { id, t: best as f32 })
}

#[inline]
fn root(ray: &Ray, sphere: &Sphere) -> Option<f64> {
    let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let (d, r) = (vector(ray.dir), f64::from(sphere.radius));
    let f = vector(ray.eye) - vector(sphere.center);
    let (a, b, q) = (d.dot(d), f.dot(d), f.dot(f) - r * r);
    let discriminant = b * b - a * q;
    if discriminant < 0.0 {
        return None;
    }
    let s = discriminant.sqrt();
    let (near, far) = ((-b - s) / a, (-b + s) / a);
    let t = if near > 0.0 { near } else { far };
    (t > 0.0).then_some(t)
}
