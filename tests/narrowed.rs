//! Is the exact picture of a large scene, whose loops are narrowed to what can be seen in a tile, that of the full loop?

use contract::{Camera, DEFAULT_LIGHT, Image, Scene, Size, Sphere};
use reference::{Arithmetic, Tracer};
use verify::judge::compare::compare;
use verify::judge::narrowed::{LEAST, NarrowedError, SAMPLE, SURPLUS, View, narrowed, sample};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::seed;

fn made(name: &str, framing: &Framing) -> (Scene, Camera) {
    let loaded = Source::parse(name).and_then(|source| source.load()).expect("it is made");
    (loaded.animation.frames()[0].clone(), loaded.camera(framing).expect("it can be seen"))
}

fn full(scene: &Scene, camera: &Camera) -> Image {
    Tracer::new(Arithmetic::Exact).render(scene, camera).expect("it fits").image
}

/// The picture by narrowed loops, held against the full one in every pixel.
fn agree(what: &str, scene: &Scene, camera: &Camera) -> Image {
    let seed = seed();
    let found = narrowed(scene, camera, seed).unwrap_or_else(|error| panic!("{what}, seed {seed}: {error}"));
    let due = (SAMPLE / scene.spheres().len()).min(camera.size().pixels());
    assert_eq!(found.sampled, due, "{what}: rays of a sample");
    let truth = full(scene, camera);
    let c = compare(&truth, &found.image).expect("of the same size");
    assert_eq!([c.wrong_ids, c.wrong_t, c.wrong_color], [0; 3], "{what}: first {:?}", c.first_wrong);
    found.image
}

fn size(width: u32, height: u32) -> Framing {
    Framing { size: Some(Size::new(width, height).expect("a size")), ..Framing::default() }
}

#[test]
fn scenes_come_out_the_same() {
    for name in ["uniform:20000:3", "clump:10000:1", "sphereflake:4", "lattice:20", "uniform:1:1"] {
        for framing in [size(127, 71), size(8, 8), size(1, 90)] {
            let (scene, camera) = made(name, &framing);
            agree(name, &scene, &camera);
        }
    }
}

/// The derivation itself, without the pixel that is added and the tiles that hide what is near: the middle of each pixel that
/// shows a sphere lies where that sphere may be seen. At the silhouettes it comes close.
#[test]
fn what_is_seen_lies_where_it_may_be() {
    let (mut seen, mut close) = (0, 0);
    let wide =
        Framing { fov: Some(120.0), eye: Some([0.5, 0.5, 1.2]), target: Some([0.5; 3]), ..size(400, 225) };
    let far = |far: f64| {
        let fov = (2.0 / far).atan().to_degrees();
        Framing { eye: Some([0.5, 0.3, far]), target: Some([0.5; 3]), fov: Some(fov), ..size(400, 225) }
    };
    let views = [size(400, 225), wide, far(1e2), far(1e3), far(1e4), far(1e5)];
    for (name, framing) in
        views.iter().flat_map(|view| ["uniform:50:1", "uniform:500:1"].map(|name| (name, view)))
    {
        let (scene, camera) = made(name, framing);
        let (image, view) = (full(&scene, &camera), View::new(&camera).expect("a plain camera"));
        for (i, id) in (0_u32..).zip(&image.ids).filter(|(_, id)| **id != contract::MISS) {
            let middle = [i % 400, i / 400].map(|place| f64::from(place) + 0.5);
            let Some(range) = view.pixels(&scene.spheres()[*id as usize]) else { continue };
            for (middle, [lo, hi]) in middle.into_iter().zip(range) {
                let room = (middle - lo).min(hi - middle) - SURPLUS;
                assert!(room >= 0.0, "{name}, {framing:?}: pixel {i} lies {} beyond sphere {id}", -room);
                close += u32::from(room < 0.25);
            }
            seen += 1;
        }
    }
    assert!(seen > 100_000 && close > 500, "{seen} pixels, {close} of them close");
}

/// A ball near the eye, on every side of the middle: from where to where it may be seen, worked out by hand for a camera that looks along an axis.
#[test]
fn a_ball_near_the_eye_may_be_seen_as_far_as_its_box() {
    let (step, half) = (1.0f32 / 64.0, 32.0);
    let camera = Camera::new(
        [0.0; 3],
        [-half * step, half * step, -1.0],
        [step, 0.0, 0.0],
        [0.0, -step, 0.0],
        Size::new(64, 64).expect("a size"),
    );
    let view = View::new(&camera.expect("a camera")).expect("a plain one");
    let (depth, radius) = (1.25f32, 1.0f32);
    for x in [-3.0f32, -1.5, -0.25, 0.0, 0.25, 1.5, 3.0] {
        for y in [-2.0f32, 0.5, 2.0] {
            let range =
                view.pixels(&Sphere { center: [x, y, -depth], radius, color: [9; 3] }).expect("ahead");
            for (middle, [lo, hi]) in [x, -y].into_iter().zip(range) {
                // The nearest end of a side that is left of the middle is the farther one of a side right of it.
                let edge = |place: f32, outward: bool| {
                    let along = if outward { depth - radius } else { depth + radius };
                    f64::from(half + place / along / step)
                };
                let due = [
                    edge(middle - radius, middle < radius) - SURPLUS,
                    edge(middle + radius, middle > -radius) + SURPLUS,
                ];
                assert!(
                    (lo - due[0]).abs() < 0.01 && (hi - due[1]).abs() < 0.01,
                    "({x}, {y}): [{lo}, {hi}], {due:?} are due"
                );
            }
        }
    }
    // Behind the eye it is seen nowhere, and about the eye anywhere.
    let at = |z: f32| view.pixels(&Sphere { center: [0.0, 0.0, z], radius, color: [9; 3] });
    assert_eq!((at(1.25), at(0.5), at(-0.5)), (Some([[f64::NEG_INFINITY; 2]; 2]), None, None));
}

#[test]
fn eyes_within_and_behind_come_out_the_same() {
    let within = Framing { eye: Some([0.5, 0.5, 0.5]), target: Some([2.0, 0.7, 0.4]), ..size(96, 54) };
    let wide = Framing { fov: Some(150.0), ..within };
    let away = Framing { eye: Some([0.5, 0.5, 2.0]), target: Some([0.5, 0.6, 9.0]), ..size(96, 54) };
    let edge = Framing { eye: Some([1.0, 0.5, 0.5]), target: Some([1.0, 0.5, 0.0]), ..size(96, 54) };
    for (what, framing) in [("within", within), ("wide", wide), ("away", away), ("edge", edge)] {
        let (scene, camera) = made("uniform:5000:1", &framing);
        agree(what, &scene, &camera);
    }
}

#[test]
fn far_and_narrow_views_come_out_the_same() {
    // From 10^4 on a pixel's direction is rounded by more than a pixel's width.
    for far in [1e2, 1e3, 1e4, 3e4, 1e5_f64] {
        let fov = (2.0 / far).atan().to_degrees();
        let framing =
            Framing { eye: Some([0.5, 0.3, far]), target: Some([0.5; 3]), fov: Some(fov), ..size(96, 54) };
        let (scene, camera) = made("uniform:3000:1", &framing);
        agree(&format!("from {far}"), &scene, &camera);
    }
}

#[test]
fn cameras_out_of_square_come_out_the_same() {
    let (scene, straight) = made("uniform:3000:1", &size(64, 64));
    let skew = |k: f32| {
        let du = [0, 1, 2].map(|i| straight.du()[i] + k * straight.dv()[i]);
        Camera::new(straight.eye(), straight.corner(), du, straight.dv(), straight.size()).expect("a camera")
    };
    for k in [0.5, -3.0, 1e3, 1e6] {
        agree(&format!("skewed by {k}"), &scene, &skew(k));
    }
}

#[test]
fn ties_go_to_the_lowest_id() {
    let sphere = |k: u8| Sphere {
        center: [f32::from(k % 8), f32::from(k / 8 % 4), 0.0],
        radius: 0.4,
        color: [k, 0, 0],
    };
    let spheres: Vec<_> = (0..200).map(sphere).collect();
    let large = Sphere { center: [4.0, 2.0, -60.0], radius: 50.0, color: [9; 3] };
    let spheres = [&spheres[..], &[large], &spheres[..], &[large]].concat();
    let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("a scene");
    let animation = contract::Animation::from(scene.clone());
    let camera = size(160, 90).camera(&animation).expect("it can be seen");
    let image = agree("ties", &scene, &camera);
    assert!(image.ids.contains(&200), "the large one, which is kept for every tile, is seen");
    assert!(image.ids.iter().all(|&id| id <= 200 || id == contract::MISS), "a copy is seen");
}

#[test]
fn planted_faults_are_found() {
    let (scene, camera) = made("uniform:5000:1", &size(64, 36));
    let truth = full(&scene, &camera);
    let seed = seed();
    assert_eq!(
        sample(&scene, &camera, &truth, SAMPLE, seed),
        Ok(64 * 36),
        "all of a small picture is sampled"
    );
    let seen = truth.ids.iter().position(|&id| id != contract::MISS).expect("something is seen");
    let plant = |fault: fn(&mut Image, usize)| {
        let mut image = truth.clone();
        fault(&mut image, seen);
        sample(&scene, &camera, &image, SAMPLE, seed)
    };
    for (what, found) in [
        ("a lost sphere", plant(|image, i| image.ids[i] = contract::MISS)),
        ("another sphere", plant(|image, i| image.ids[i] ^= 1)),
        ("another t", plant(|image, i| image.t[i] = f32::from_bits(image.t[i].to_bits() + 1))),
    ] {
        let Err(NarrowedError::Differs { x, y, .. }) = found else {
            panic!("{what} was not found: {found:?}")
        };
        assert_eq!(y as usize * 64 + x as usize, seen, "{what} was found elsewhere");
    }
}

/// Of a large picture as many pixels are asked as was said, and they lie anywhere: a fault in all but the first row is met.
#[test]
fn a_sample_lies_anywhere() {
    let (scene, camera) = made("uniform:1000:1", &size(400, 225));
    let (seed, mut image) = (seed(), full(&scene, &camera));
    let asked = |image: &Image, work| sample(&scene, &camera, image, work, seed);
    assert_eq!(asked(&image, 4_096_000), Ok(4096), "rays times spheres are the work");
    assert_eq!(asked(&image, 1), Ok(LEAST), "however little work");
    image.t[400..].iter_mut().for_each(|t| *t = t.next_down());
    for work in [4_096_000, 1] {
        let Err(NarrowedError::Differs { x, y, .. }) = asked(&image, work) else {
            panic!("CGT_SEED={seed}: no pixel of the sample lies below the first row")
        };
        assert!(x < 400 && (1..225).contains(&y), "({x}, {y})");
    }
}

/// A sphere that is kept for every tile, and one of a higher id that touches it from within where the middle ray meets both at once.
#[test]
fn ties_with_what_is_everywhere_go_to_the_lowest_id() {
    let large = Sphere { center: [0.0, 0.0, -60.0], radius: 50.0, color: [9; 3] };
    let within = Sphere { center: [0.0, 0.0, -11.0], radius: 1.0, color: [99; 3] };
    let scene = Scene::new(vec![large, within], [0; 3], DEFAULT_LIGHT).expect("a scene");
    let (step, half) = (1.0 / 64.0, 80.5 / 64.0);
    let camera = Camera::new(
        [0.0; 3],
        [-half, half, -1.0],
        [step, 0.0, 0.0],
        [0.0, -step, 0.0],
        Size::new(161, 161).expect("a size"),
    );
    let image = agree("a tie with what is everywhere", &scene, &camera.expect("a camera"));
    assert_eq!((image.ids[80 * 161 + 80], image.t[80 * 161 + 80]), (0, 10.0), "the middle ray");
}
