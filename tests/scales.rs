//! Is the picture of the fast plan the exact one at any distance and any scale, with no pixel undecided, by the verdict of the
//! judge itself?

use contract::{Animation, Camera, Scene, Size, Sphere};
use optimized::Level;
use verify::judge::judge;
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::count;
use verify::subject::{Grid, NamedPlan, Promise, Subject};
use verify::verdict::Verdict;

/// Pictures are `CGT_SCALES_WIDTH` pixels wide, 160 every day, and 9/16 as high.
fn size() -> Size {
    let width = u32::try_from(count("CGT_SCALES_WIDTH", 160)).expect("a width");
    Size::new(width, width * 9 / 16).expect("a size")
}

fn scene(word: &str) -> Scene {
    let loaded = Source::parse(word).and_then(|source| source.load()).expect("bundled or generated");
    loaded.animation.frames()[0].clone()
}

/// Judges the fast plan at every level; gives how many pixels hit.
fn equal(name: &str, scene: &Scene, camera: &Camera) -> u64 {
    let truth =
        reference::Tracer::new(reference::Arithmetic::Exact).render(scene, camera).expect("small").image;
    let mut hits = 0;
    for level in Level::available() {
        let subject = Grid::new(NamedPlan::Fast, level, true, None);
        assert_eq!(subject.promise(), Promise::Exact);
        let rendered = subject.render(scene, camera, 2, &|| ()).expect("the plan refuses nothing");
        let judgement = judge(scene, camera, &truth, &rendered.image, subject.promise(), None);
        let comparison = judgement.comparison.expect("pictures of one size");
        assert_eq!(
            judgement.verdict,
            Verdict::Equal,
            "{name}, {level}: {} {comparison:?}",
            judgement.because
        );
        assert_eq!(comparison.undecidable, 0, "{name}, {level}");
        hits = comparison.hits;
        eprintln!("{name}, {level}: {hits} hits. {}", rendered.notes.last().expect("the stages"));
    }
    hits
}

/// A camera so many radii away from a sphere, in a direction askew to all axes; the picture is six radii wide there. Directions
/// are as long as the way, so that far away they are as coarse as f32 is.
#[allow(clippy::cast_possible_truncation, reason = "any camera will do")]
fn looking_at(sphere: &Sphere, radii: f64) -> Camera {
    let [away, right, down] = [[0.48, 0.6, 0.64], [0.8, 0.0, -0.6], [0.36, -0.8, 0.48]];
    let (radius, size) = (f64::from(sphere.radius), size());
    let step = 6.0 * radius / f64::from(size.width());
    let [half, high] = [3.0 * radius, f64::from(size.height()) / 2.0 * step];
    let vector = |v: [f64; 3]| v.map(|x| x as f32);
    let eye = [0, 1, 2].map(|i| f64::from(sphere.center[i]) + radii * radius * away[i]);
    let corner = [0, 1, 2].map(|i| -radii * radius * away[i] - half * right[i] - high * down[i]);
    let [du, dv] = [right, down].map(|v| vector(v.map(|x| step * x)));
    Camera::new(vector(eye), vector(corner), du, dv, size).expect("a camera")
}

#[test]
fn equal_from_near_to_ten_million_radii_away() {
    for word in ["sphereflake:2", "1hvr"] {
        let scene = scene(word);
        let first = scene.spheres()[0];
        for radii in [10.0, 1e3, 1e5, 1e7] {
            let camera = looking_at(&first, radii);
            let hits = equal(&format!("{word}, {radii} radii away"), &scene, &camera);
            assert!(hits > size().pixels() as u64 / 50, "{word}, {radii} radii away: nothing is seen");
        }
    }
}

#[test]
fn equal_at_every_scale() {
    for word in ["sphereflake:2", "uniform:200:3"] {
        for factor in [1e-30f32, 1e-20, 1e-10, 1.0, 1e10, 1e20, 1e30] {
            let plain = scene(word);
            let scaled =
                |s: &Sphere| Sphere { center: s.center.map(|x| factor * x), radius: factor * s.radius, ..*s };
            let spheres = plain.spheres().iter().map(scaled).collect();
            let scene = Scene::new(spheres, plain.background(), plain.light()).expect("finite");
            let framing = Framing { size: Some(size()), ..Framing::default() };
            let camera = framing.camera(&Animation::from(scene.clone())).expect("in view");
            let hits = equal(&format!("{word} times {factor:e}"), &scene, &camera);
            assert!(hits > size().pixels() as u64 / 50, "{word} times {factor:e}: nothing is seen");
        }
    }
}
