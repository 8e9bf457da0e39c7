//! Both forms of rule 5 in the SPU's arithmetic (contract, rule 6): every sign of an operation is one of [`Spu`]'s, in the
//! contract's order to the letter, since others are compared with it bit for bit.

use crate::spu::Spu;
use crate::{Hit, Ray};
use contract::Sphere;

/// The nearest hit by either form; equal t go to the lowest id.
pub(crate) fn nearest(
    ray: &Ray,
    spheres: &[Sphere],
    root: impl Fn(&Ray, &Sphere) -> Option<Spu>,
) -> Option<Hit> {
    if ray.dir.iter().all(|&x| Spu::of(x).is_zero()) {
        return None;
    }
    let mut hit: Option<(u32, Spu)> = None;
    for (id, sphere) in (0..).zip(spheres) {
        if let Some(t) = root(ray, sphere)
            && hit.is_none_or(|(_, best)| t.less(best))
        {
            hit = Some((id, t));
        }
    }
    hit.map(|(id, t)| Hit { id, t: f32::from_bits(t.0) })
}

/// b² − a q.
pub(crate) fn textbook(ray: &Ray, sphere: &Sphere) -> Option<Spu> {
    let (d, r) = (ray.dir.map(Spu::of), Spu::of(sphere.radius));
    let f = from_center(ray, sphere);
    let a = dot(d, d);
    let b = dot(f, d);
    let q = dot(f, f) - r * r;
    let discriminant = b * b - a * q;
    let s = discriminant.sqrt();
    first_positive(discriminant, (-b - s) / a, (-b + s) / a)
}

/// r² − |f − (f·d / d·d) d|².
pub(crate) fn perpendicular(ray: &Ray, sphere: &Sphere) -> Option<Spu> {
    let (d, r) = (ray.dir.map(Spu::of), Spu::of(sphere.radius));
    let w = Spu::ONE / dot(d, d);
    let f = from_center(ray, sphere);
    let h = dot(f, d) * w;
    let l = [0, 1, 2].map(|i| f[i] - h * d[i]);
    let discriminant = r * r - dot(l, l);
    let s = (discriminant * w).sqrt();
    first_positive(discriminant, -h - s, -h + s)
}

fn from_center(ray: &Ray, sphere: &Sphere) -> [Spu; 3] {
    [0, 1, 2].map(|i| Spu::of(ray.eye[i]) - Spu::of(sphere.center[i]))
}

/// The ending of both forms: a t above 2¹²⁸ would be the pattern of no f32 but a NaN.
fn first_positive(discriminant: Spu, near: Spu, far: Spu) -> Option<Spu> {
    let t = if Spu::ZERO.less(near) { near } else { far };
    (Spu::ZERO.less_equal(discriminant) && Spu::ZERO.less(t) && t.less_equal(Spu::TWO_128)).then_some(t)
}

fn dot(u: [Spu; 3], v: [Spu; 3]) -> Spu {
    (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2]
}
