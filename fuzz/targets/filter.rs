//! A ray and up to four spheres from any bits: the filtered exact tracer answers as the unfiltered one does.
#![no_main]

use contract::{DEFAULT_LIGHT, Scene, Sphere};
use libfuzzer_sys::fuzz_target;
use reference::{Arithmetic, Ray, Tracer};

fuzz_target!(|input: ([f32; 6], [[f32; 4]; 4], u8)| {
    let (ray, spheres, count) = input;
    let spheres = spheres[..usize::from(count) % 5].iter();
    let sphere = |&[x, y, z, radius]: &[f32; 4]| Sphere { center: [x, y, z], radius, color: [0; 3] };
    let Ok(scene) = Scene::new(spheres.map(sphere).collect(), [0; 3], DEFAULT_LIGHT) else { return };
    if ray.iter().all(|x| x.is_finite()) {
        let ray = Ray { eye: [ray[0], ray[1], ray[2]], dir: [ray[3], ray[4], ray[5]] };
        let answer = |arithmetic| Tracer::new(arithmetic).trace(&ray, &scene).map(|h| (h.id, h.t.to_bits()));
        assert_eq!(answer(Arithmetic::Exact), answer(Arithmetic::ExactUnfiltered), "{ray:?} {scene:?}");
    }
});
