//! The filtered exact tracer against the unfiltered one, on a ray and up to four spheres.

use super::bytes::Bytes;
use super::view::rays_and_spheres;
use super::{listed, vector};
use contract::{DEFAULT_LIGHT, Scene};
use reference::{Arithmetic, Hit, Tracer};

/// One ray is traced by `Exact` and by `ExactUnfiltered`: id and t must be the same. 1 is judged, or nothing.
///
/// # Panics
/// If they differ.
pub fn filter(bytes: &[u8]) -> u64 {
    let mut from = Bytes(bytes);
    let (ray, spheres) = rays_and_spheres(&mut from, 4);
    let finite = ray.eye.iter().chain(&ray.dir).all(|x| x.is_finite());
    let Ok(scene) = Scene::new(spheres, [0; 3], DEFAULT_LIGHT) else { return 0 };
    if !finite {
        return 0;
    }
    let answer = |arithmetic| Tracer::new(arithmetic).trace(&ray, &scene);
    let [filtered, plain] = [Arithmetic::Exact, Arithmetic::ExactUnfiltered].map(answer);
    let bits = |hit: Option<Hit>| hit.map(|hit| (hit.id, hit.t.to_bits()));
    assert!(
        bits(filtered) == bits(plain),
        "filtered {filtered:?} is not unfiltered {plain:?}, {:x?} and {:x?}\n  eye {}, direction {}{}",
        bits(filtered),
        bits(plain),
        vector(ray.eye),
        vector(ray.dir),
        listed(scene.spheres())
    );
    1
}
