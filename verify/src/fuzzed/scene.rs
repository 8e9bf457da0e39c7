//! A picture by any plan, at any level, by one to three workers, against the reference's of the same arithmetic.

use super::bytes::Bytes;
use super::plan::plan;
use super::{bits, listed, vector, view};
use crate::subject::{may_refuse, promise, tiles_are_served};
use contract::{Camera, Image, MISS, Scene};
use optimized::{Known, Level, Plan, Tracer};
use reference::Ray;

/// Every pixel is held against the reference's, in id, bits of t, and colour, if the plan promises that: in a fresh frame, or in the
/// memory of another one, and once more with what is then known of it. Of a plan that promises nothing, what it reports must at
/// least be a hit of that sphere in its arithmetic. Pixels are judged; none if scene, camera or plan are refused.
///
/// # Panics
/// If a pixel differs, or a refusal is not due.
pub fn scene(bytes: &[u8]) -> u64 {
    let mut from = Bytes(bytes);
    let (plan, level, workers) = (plan(&mut from), from.level(), from.byte());
    let workers = if workers < 224 { 1 } else { 1 + usize::from(workers % 3) };
    let (before, known) = (from.flag(), from.flag());
    let Ok(scene) = view::scene(&mut from, 12) else { return 0 };
    let Ok(camera) = view::camera(&mut from, scene.spheres()) else { return 0 };
    let frame = Frame { scene: &scene, camera: &camera, plan, level, workers };
    let mut session = match Tracer::new(plan, level).workers(workers).session() {
        Ok(session) => session,
        Err(error) => panic!("{error}; {frame}"),
    };
    if before {
        let fewer = scene.spheres()[scene.spheres().len() / 2..].to_vec();
        let fewer = Scene::new(fewer, [1, 2, 3], scene.light()).unwrap_or_else(|e| panic!("{e}: {frame}"));
        // Whatever comes of it: only its memory counts.
        _ = session.render(&fewer, &camera);
    }
    let image = match session.render(&scene, &camera) {
        Ok(rendering) if tiles_are_served(&plan) => rendering.image.clone(),
        Ok(_) => panic!("tiles that lack what they need are not refused; {frame}"),
        Err(error) if may_refuse(&plan, &error) => return 0,
        Err(error) => panic!("{error}; {frame}"),
    };
    let truth = reference::Tracer::new(promise(plan.arithmetic).naive()).threads(1).render(&scene, &camera);
    let truth = truth.unwrap_or_else(|error| panic!("{error}; {frame}")).image;
    if !plan.promises_equality() {
        return frame.reports_hits(&image);
    }
    let mut judged = frame.hold(&truth, &image);
    if known {
        match session.render_known(&scene, &camera, &Known::of(&truth)) {
            Ok(rendering) => judged += frame.hold(&truth, &rendering.image),
            Err(error) => panic!("{error}, of what is known; {frame}"),
        }
    }
    judged
}

struct Frame<'a> {
    scene: &'a Scene,
    camera: &'a Camera,
    plan: Plan,
    level: Level,
    workers: usize,
}

impl Frame<'_> {
    fn hold(&self, truth: &Image, image: &Image) -> u64 {
        assert_eq!(truth.size, image.size, "the size of the picture; {self}");
        for i in 0..truth.size.pixels() {
            let pixel = |image: &Image| (image.ids[i], image.t[i].to_bits(), image.rgba[i]);
            assert!(
                pixel(truth) == pixel(image),
                "the reference sees {}, the plan {}; {}; {self}",
                answer(truth, i),
                answer(image, i),
                self.ray_in_words(i)
            );
        }
        truth.size.pixels() as u64
    }

    fn reports_hits(&self, image: &Image) -> u64 {
        let tracer = reference::Tracer::new(promise(self.plan.arithmetic).naive());
        for (i, &id) in image.ids.iter().enumerate().filter(|(_, id)| **id != MISS) {
            let sphere = self.scene.spheres().get(id as usize).copied();
            let alone = Scene::new(sphere.into_iter().collect(), [0; 3], [0.0; 3]);
            let alone = alone.unwrap_or_else(|error| panic!("{error}; {self}"));
            let hit = tracer.trace(&self.ray(i), &alone);
            assert!(
                hit.is_some_and(|hit| hit.t.to_bits() == image.t[i].to_bits()),
                "the plan sees {}, which alone gives {hit:?}; {}; {self}",
                answer(image, i),
                self.ray_in_words(i)
            );
        }
        image.size.pixels() as u64
    }

    #[allow(clippy::cast_possible_truncation, reason = "of an image of at most 144 pixels")]
    fn ray(&self, i: usize) -> Ray {
        let (i, width) = (i as u32, self.camera.size().width());
        Ray::of_pixel(self.camera, i % width, i / width)
    }

    fn ray_in_words(&self, i: usize) -> String {
        let ray = self.ray(i);
        format!("pixel {i}, eye {}, direction {}", vector(ray.eye), vector(ray.dir))
    }
}

fn answer(image: &Image, i: usize) -> String {
    match image.ids[i] {
        MISS => format!("a miss (t {}, colour {:?})", bits(image.t[i]), image.rgba[i]),
        id => format!("sphere {id} at t = {}, colour {:?}", bits(image.t[i]), image.rgba[i]),
    }
}

impl std::fmt::Display for Frame<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { scene, camera, plan, level, workers } = self;
        write!(f, "{plan}, {level}, {workers} workers, {camera:?}{}", listed(scene.spheres()))
    }
}
