//! The two f32 forms (contract, rule 5): textbook and perpendicular. The order of operations is the contract's
//! to the letter, since others are compared with it bit for bit.

use crate::eights::each;
use crate::{Hit, Ray};
use contract::Sphere;
use multiversion::multiversion;

/// One of the two.
pub(crate) trait Form {
    /// Positive or zero where the ray's line meets the sphere, as far as this form knows.
    fn discriminant(ray: &Ray, sphere: &Sphere) -> f32;

    /// The smallest positive t at which the ray does, if there is one.
    fn root(ray: &Ray, sphere: &Sphere) -> Option<f32>;
}

/// The nearest hit by either form; equal t go to the lowest id.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn nearest<F: Form>(ray: &Ray, spheres: &[Sphere]) -> Option<Hit> {
    let (mut best, mut hit) = (f32::INFINITY, None);
    let meet = |id, sphere: &Sphere| {
        if let Some(t) = F::root(ray, sphere)
            && (t < best || hit.is_none())
        {
            (best, hit) = (t, Some(id));
        }
    };
    each(spheres, |sphere| F::discriminant(ray, sphere) >= 0.0, meet);
    hit.map(|id| Hit { id, t: best })
}

/// b² − a q.
pub(crate) enum Textbook {}

impl Form for Textbook {
    #[inline]
    fn discriminant(ray: &Ray, sphere: &Sphere) -> f32 {
        let [a, b, q] = Self::parts(ray, sphere);
        b * b - a * q
    }

    #[inline]
    fn root(ray: &Ray, sphere: &Sphere) -> Option<f32> {
        let ([a, b, _], discriminant) = (Self::parts(ray, sphere), Self::discriminant(ray, sphere));
        if discriminant >= 0.0 {
            let s = discriminant.sqrt();
            return first_positive((-b - s) / a, (-b + s) / a);
        }
        None
    }
}

impl Textbook {
    /// a, b and q.
    #[inline]
    fn parts(ray: &Ray, sphere: &Sphere) -> [f32; 3] {
        let (d, r) = (ray.dir, sphere.radius);
        let f = [0, 1, 2].map(|i| ray.eye[i] - sphere.center[i]);
        [dot(d, d), dot(f, d), dot(f, f) - r * r]
    }
}

/// r² − |f − (f·d / d·d) d|².
pub(crate) enum Perpendicular {}

impl Form for Perpendicular {
    #[inline]
    fn discriminant(ray: &Ray, sphere: &Sphere) -> f32 {
        let ([_, h, f @ ..], d, r) = (Self::parts(ray, sphere), ray.dir, sphere.radius);
        let l = [0, 1, 2].map(|i| f[i] - h * d[i]);
        r * r - dot(l, l)
    }

    #[inline]
    fn root(ray: &Ray, sphere: &Sphere) -> Option<f32> {
        let ([w, h, ..], discriminant) = (Self::parts(ray, sphere), Self::discriminant(ray, sphere));
        if discriminant >= 0.0 {
            let s = (discriminant * w).sqrt();
            return first_positive(-h - s, -h + s);
        }
        None
    }
}

impl Perpendicular {
    /// 1 / d·d, f·d / d·d, and f.
    #[inline]
    fn parts(ray: &Ray, sphere: &Sphere) -> [f32; 5] {
        let w = 1.0 / dot(ray.dir, ray.dir);
        let f = [0, 1, 2].map(|i| ray.eye[i] - sphere.center[i]);
        [w, dot(f, ray.dir) * w, f[0], f[1], f[2]]
    }
}

fn first_positive(near: f32, far: f32) -> Option<f32> {
    let t = if near > 0.0 { near } else { far };
    (t > 0.0).then_some(t)
}

#[inline]
fn dot(u: [f32; 3], v: [f32; 3]) -> f32 {
    (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2]
}
