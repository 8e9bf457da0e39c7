//! The textbook form in f64 (contract, rule 5), on glam's scalar vectors.

use crate::eights::each;
use crate::{Hit, Ray};
use contract::Sphere;
use glam::DVec3;
use multiversion::multiversion;

/// The nearest hit; t is rounded to f32 at the end.
#[multiversion(targets("x86_64+avx2"))]
#[allow(clippy::cast_possible_truncation, reason = "the one rounding of t that rule 5 prescribes")]
pub(crate) fn nearest(ray: &Ray, spheres: &[Sphere]) -> Option<Hit> {
    let (mut best, mut hit) = (f64::INFINITY, None);
    let meet = |id, sphere: &Sphere| {
        if let Some(t) = root(ray, sphere)
            && t < best
        {
            (best, hit) = (t, Some(id));
        }
    };
    each(spheres, |sphere| parts(ray, sphere).1 >= 0.0, meet);
    hit.map(|id| Hit { id, t: best as f32 })
}

#[inline]
fn root(ray: &Ray, sphere: &Sphere) -> Option<f64> {
    let ([a, b], discriminant) = parts(ray, sphere);
    let s = discriminant.sqrt();
    let (near, far) = ((-b - s) / a, (-b + s) / a);
    let t = if near > 0.0 { near } else { far };
    (t > 0.0).then_some(t)
}

/// a and b, and b² − a q.
#[inline]
fn parts(ray: &Ray, sphere: &Sphere) -> ([f64; 2], f64) {
    let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let (d, r) = (vector(ray.dir), f64::from(sphere.radius));
    let f = vector(ray.eye) - vector(sphere.center);
    let (a, b, q) = (d.dot(d), f.dot(d), f.dot(f) - r * r);
    ([a, b], b * b - a * q)
}
