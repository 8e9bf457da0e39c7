//! The two f32 forms (contract, rule 5): textbook and perpendicular. The order of operations is the contract's
//! to the letter, since others are compared with it bit for bit.

use crate::{Hit, Ray};
use contract::Sphere;

/// The nearest hit by either form; equal t go to the lowest id.
#[inline]
pub(crate) fn nearest(
    ray: &Ray,
    spheres: &[Sphere],
    root: impl Fn(&Ray, &Sphere) -> Option<f32>,
) -> Option<Hit> {
    let (mut best, mut hit) = (f32::INFINITY, None);
    for (id, sphere) in (0..).zip(spheres) {
        if let Some(t) = root(ray, sphere)
            && (t < best || hit.is_none())
        {
            (best, hit) = (t, Some(id));
        }
    }
    hit.map(|id| Hit { id, t: best })
}

/// b² − a q.
#[inline]
pub(crate) fn textbook(ray: &Ray, sphere: &Sphere) -> Option<f32> {
    let (d, r) = (ray.dir, sphere.radius);
    let f = [0, 1, 2].map(|i| ray.eye[i] - sphere.center[i]);
    let a = dot(d, d);
    let b = dot(f, d);
    let q = dot(f, f) - r * r;
    let discriminant = b * b - a * q;
    if discriminant >= 0.0 {
        let s = discriminant.sqrt();
        return first_positive((-b - s) / a, (-b + s) / a);
    }
    None
}

/// r² − |f − (f·d / d·d) d|².
#[inline]
pub(crate) fn perpendicular(ray: &Ray, sphere: &Sphere) -> Option<f32> {
    let (d, r) = (ray.dir, sphere.radius);
    let w = 1.0 / dot(d, d);
    let f = [0, 1, 2].map(|i| ray.eye[i] - sphere.center[i]);
    let h = dot(f, d) * w;
    let l = [0, 1, 2].map(|i| f[i] - h * d[i]);
    let discriminant = r * r - dot(l, l);
    if discriminant >= 0.0 {
        let s = (discriminant * w).sqrt();
        return first_positive(-h - s, -h + s);
    }
    None
}

fn first_positive(near: f32, far: f32) -> Option<f32> {
    let t = if near > 0.0 { near } else { far };
    (t > 0.0).then_some(t)
}

#[inline]
fn dot(u: [f32; 3], v: [f32; 3]) -> f32 {
    (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2]
}
