//! Rule 4: the colour of a hit, in f32 exactly as the contract writes it.

use crate::{Hit, Ray};
use contract::{AMBIENT, DIFFUSE, Scene};

/// Red, green, blue, 255: for a hit of any tracer, with t as it gives it.
///
/// # Panics
/// If the scene has no sphere of that id.
#[must_use]
pub fn shade(scene: &Scene, ray: &Ray, hit: Hit) -> [u8; 4] {
    let sphere = &scene.spheres()[hit.id as usize];
    let light = scene.light();
    let point = [0, 1, 2].map(|i| ray.eye[i] + hit.t * ray.dir[i]);
    let normal = [0, 1, 2].map(|i| point[i] - sphere.center[i]);
    let m = (normal[0] * light[0] + normal[1] * light[1]) + normal[2] * light[2];
    let s = AMBIENT + DIFFUSE * (m / sphere.radius);
    let s = if s > 0.0 { s } else { 0.0 };
    let s = if s < 1.0 { s } else { 1.0 };
    let [r, g, b] = sphere.color.map(|channel| to_byte(f32::from(channel) * s + 0.5));
    [r, g, b, 255]
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= x <= 255.5, cut off")]
fn to_byte(x: f32) -> u8 {
    x as u8
}
