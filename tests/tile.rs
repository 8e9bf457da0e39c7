//! Tiles: are no hits lost between a sphere's outline and the rays, is the short way to t within its bound, and is every picture the
//! exact one, whatever the tile, the grid and the frame before?

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Size, Sphere};
use optimized::bound::{NEAREST, Rule};
use optimized::certain::{Ball, Rays, Side};
use optimized::crew::Crew;
use optimized::double::{short_ends, short_error};
use optimized::grid::{Grid, Memory};
use optimized::host::{Scalar, Work};
use optimized::machine::{LANES, Machine};
use optimized::plan::{
    Arithmetic, Cells, Culling, Margins, OnEvent, Packet, Plan, Reason, Resolution, Voxelizer,
};
use optimized::silhouette::Outline;
use optimized::{Event, Form, Known, Level, RenderError, Tracer, cull};
use rand::{Rng, RngExt};
use rayon::prelude::*;
use reference::{Arithmetic as Naive, Ray};
use verify::matrix::Matrix;
use verify::seed::{count, generator, seed};

fn exact(scene: &Scene, camera: &Camera) -> Image {
    reference::Tracer::new(Naive::Exact).threads(1).render(scene, camera).expect("small").image
}

type Pixel = (u32, u32, [u8; 4]);

fn pixels(image: &Image) -> Vec<Pixel> {
    let all = image.ids.iter().zip(&image.t).zip(&image.rgba);
    all.map(|((id, t), rgba)| (*id, t.to_bits(), *rgba)).collect()
}

fn assert_equal(truth: &Image, given: &Image, what: &dyn Fn() -> String) {
    assert_eq!(truth.size, given.size, "{}", what());
    for (i, (truth, given)) in pixels(truth).into_iter().zip(pixels(given)).enumerate() {
        assert_eq!(truth, given, "exact, tile; pixel {i}; {}", what());
    }
}

/// A direction, and a sphere that its ray from the eye comes near, often by its very rim.
fn near_miss(eye: [f32; 3], rng: &mut impl Rng) -> (Ray, Sphere) {
    let unit = |rng: &mut _| -> [f64; 3] { std::array::from_fn(|_| RngExt::random_range(rng, -1.0f64..1.0)) };
    let (d, e) = (unit(rng), unit(rng));
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let across: [f64; 3] = std::array::from_fn(|i| e[i] - d[i] * dot(e, d) / dot(d, d));
    let length = dot(across, across).sqrt().max(1e-9);
    let radius = 2f64.powf(rng.random_range(-12.0..4.0));
    // How far off its middle, in radii: anything, or the rim to within a few roundings.
    let off = if rng.random() {
        rng.random_range(0.0..1.2)
    } else {
        1.0 - 2f64.powf(rng.random_range(-24.0..-6.0))
    };
    let far = radius * 2f64.powf(rng.random_range(0.05f64..17.0)) / dot(d, d).sqrt();
    #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
    let center =
        std::array::from_fn(|i| (f64::from(eye[i]) + far * d[i] + off * radius * across[i] / length) as f32);
    #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
    let (dir, radius) = (d.map(|x| x as f32), radius as f32);
    (Ray { eye, dir }, Sphere { center, radius, color: [9; 3] })
}

fn truth(ray: &Ray, sphere: Sphere) -> Option<f32> {
    let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
    reference::Tracer::new(Naive::Exact).trace(ray, &scene).map(|hit| hit.t)
}

/// A point relative to the eye, and the direction, in components along the ray's major axis and the other two.
fn turned(ray: &Ray, center: [f32; 3]) -> ([f32; 3], [f64; 3]) {
    let axis = (0..3).max_by(|&i, &j| ray.dir[i].abs().total_cmp(&ray.dir[j].abs())).expect("three");
    let sense = ray.dir[axis].signum();
    let along = |v: [f32; 3]| [sense * v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3]];
    (along([0, 1, 2].map(|i| center[i] - ray.eye[i])), along(ray.dir).map(f64::from))
}

/// What the kernels say of a ray and a sphere that it hits at t, or what is wrong about it. `slack`, if not 1, spoils them.
fn held(ray: &Ray, sphere: &Sphere, t: f32, slack: f32) -> Result<bool, String> {
    let m = Scalar;
    let (c, d) = turned(ray, sphere.center);
    let magnitude = c.map(|x| [x.abs(); LANES]);
    let radius = cull::radii(m, magnitude, [slack * sphere.radius; LANES]);
    let outline = Outline::new(m, c.map(|x| [x; LANES]), radius);
    for i in 0..2 {
        // Products of two f32 are exact in f64.
        let (lo, hi) = (f64::from(outline.lo[i][0]) * d[0], f64::from(outline.hi[i][0]) * d[0]);
        if lo > d[i + 1] || d[i + 1] > hi {
            return Err(format!("the outline {lo:e} to {hi:e} does not hold the ray's {:e}", d[i + 1]));
        }
    }
    let reached = f64::from(t.next_up()) * d[0];
    if f64::from(outline.near[0]) > reached {
        return Err(format!("nearer than near: {:e}, {reached:e}", outline.near[0]));
    }
    let error = short_error::<f64, _>(m, magnitude, [sphere.radius; LANES]);
    let error = error.map(|error| if slack == 1.0 { error } else { 0.0 * error });
    let lanes = |v: [f32; 3]| v.map(|x| [x; LANES]);
    let ends =
        short_ends::<f64>(ray.eye, &lanes(ray.dir), &lanes(sphere.center), &[sphere.radius; LANES], &error);
    let [lo, hi] = [ends[0][0], ends[1][0]];
    if lo.to_bits() == hi.to_bits() && lo.to_bits() != t.to_bits() {
        return Err(format!("t is {t:e}, the short way gives {lo:e}"));
    }
    Ok(lo.to_bits() == hi.to_bits())
}

#[test]
fn outlines_hold_what_is_hit_and_the_short_way_is_within_its_bound() {
    let (seed, cases) = (seed(), count("CGT_TILE_RAYS", 1_000_000));
    let each = (0..cases).into_par_iter().map(|i| {
        let mut rng = generator(seed, i);
        let eye = std::array::from_fn(|_| rng.random_range(-20.0f32..20.0));
        let (ray, sphere) = near_miss(eye, &mut rng);
        let Some(t) = truth(&ray, sphere) else { return [0, 0, 0, 0] };
        let sound = held(&ray, &sphere, t, 1.0);
        let short =
            sound.unwrap_or_else(|what| panic!("CGT_SEED={seed}, case {i}: {what}; {ray:?}, {sphere:?}"));
        // Outlines of nine tenths of the radius, and no bound at all: both must be found out.
        let spoilt = held(&ray, &sphere, t, 0.9).err().unwrap_or_default();
        [1, u64::from(short), u64::from(spoilt.contains("outline")), u64::from(spoilt.contains("short"))]
    });
    let sum = each.reduce(|| [0; 4], |x, y| [0, 1, 2, 3].map(|i| x[i] + y[i]));
    let [hits, short, outside, wrong] = sum;
    eprintln!(
        "CGT_SEED={seed}: {cases} rays, {hits} hits, {short} decided by the short way; spoilt, {outside} miss the outline, {wrong} are wrong"
    );
    assert!(hits > cases / 3 && short > hits / 4, "too little was at stake");
    assert!(outside > hits / 20, "outlines too small are hardly ever found out");
    assert!(wrong > 20, "a missing bound is not found out");
}

/// With the eye at the origin centres are exact, and the outline of the bare radius has its own slack alone against its own rounding.
#[test]
fn outlines_cover_their_own_rounding_and_need_to() {
    let (seed, cases) = (seed(), count("CGT_TILE_RAYS", 1_000_000));
    let each = (0..cases).into_par_iter().map(|i| {
        let mut rng = generator(seed, i);
        let (ray, sphere) = near_miss([0.0; 3], &mut rng);
        if truth(&ray, sphere).is_none() {
            return [0, 0];
        }
        let (c, d) = turned(&ray, sphere.center);
        let outline = Outline::new(Scalar, c.map(|x| [x; LANES]), [sphere.radius; LANES]);
        let mut without = 0;
        for side in 0..2 {
            let [lo, hi] = [outline.lo[side][0], outline.hi[side][0]].map(f64::from);
            let (lowest, slope, highest) = (lo * d[0], d[side + 1], hi * d[0]);
            assert!(
                lowest <= slope && slope <= highest,
                "CGT_SEED={seed}, case {i}: the outline {lo:e} to {hi:e} does not hold {:e}; {ray:?}, {sphere:?}",
                slope / d[0]
            );
            let slack = |x: f64| (1.0 + x.abs()) / 65536.0;
            without += u64::from((lo + slack(lo)) * d[0] > slope || (hi - slack(hi)) * d[0] < slope);
        }
        [1, without]
    });
    let [hits, without] = each.reduce(|| [0; 2], |x, y| [x[0] + y[0], x[1] + y[1]]);
    eprintln!("CGT_SEED={seed}: {hits} hits, {without} of them outside without the slack");
    assert!(hits > cases / 3 && without > 20, "too little was at stake");
}

/// Tiles of many shapes in many grids.
fn plans() -> Vec<Plan> {
    let mut plans = Vec::new();
    for side in [1, 2, 7, 32] {
        for resolution in [Resolution::Fixed(1), Resolution::Fixed(9), Resolution::UpTo(240)] {
            for culling in [Culling::Planes, Culling::None] {
                plans.push(Plan { packet: Packet::Tile { side }, resolution, culling, ..Plan::fast() });
            }
        }
    }
    plans
}

#[test]
fn every_picture_is_the_exact_one() {
    let (matrix, plans) = (Matrix::new().expect("all data that is there can be read"), plans());
    let levels = Level::available();
    let best = Level::best().expect("a level");
    let each = matrix.cases.par_iter().enumerate().map(|(i, case)| {
        let truth = exact(&case.scene, &case.camera);
        let (plan, level) = (plans[i % plans.len()], levels[i / plans.len() % levels.len()]);
        let chosen = Plan::for_scene(&case.scene).plan;
        for (plan, level, workers) in [(Plan::fast(), best, 1), (plan, level, 1 + i % 3), (chosen, level, 2)]
        {
            let mut session = Tracer::new(plan, level).workers(workers).session().expect("memory");
            let given = session.render(&case.scene, &case.camera).expect("nothing to refuse");
            assert_equal(&truth, &given.image, &|| {
                format!("{}; {plan}, {level}, {workers} workers", case.name)
            });
            let known =
                session.render_known(&case.scene, &case.camera, &Known::of(&truth)).expect("its size");
            assert_equal(&truth, &known.image, &|| format!("{}, known; {plan}, {level}", case.name));
        }
        3
    });
    let pictures: usize = each.sum();
    eprintln!("{pictures} pictures by {} plans at {} levels", plans.len() + 2, levels.len());
    assert!(pictures > 1_500, "too little was at stake");
}

/// Pictures of random spheres of all sizes from random places, many of whose tiles look along several axes.
#[test]
fn wide_views_from_within_are_exact() {
    let (seed, cases) = (seed(), count("CGT_TILE_PICTURES", 300));
    let split: u64 = (0..cases)
        .into_par_iter()
        .map(|i| {
            let mut rng = generator(seed, i);
            let mut ball = || Sphere {
                center: std::array::from_fn(|_| rng.random_range(-4.0f32..4.0)),
                radius: 2f32.powf(rng.random_range(-7.0..0.5)),
                color: std::array::from_fn(|_| rng.random()),
            };
            let spheres: Vec<Sphere> = (0..1 + i % 700).map(|_| ball()).collect();
            let mut vector =
                |size: f32| -> [f32; 3] { std::array::from_fn(|_| rng.random_range(-size..size)) };
            let (eye, corner, du, dv) = (vector(5.0), vector(1.0), vector(0.03), vector(0.03));
            let size = Size::new(1 + u32::try_from(i % 67).expect("small"), 45).expect("a size");
            let Ok(camera) = Camera::new(eye, corner, du, dv, size) else { return 0 };
            let scene = Scene::new(spheres, [1, 2, 3], DEFAULT_LIGHT).expect("valid");
            let rendering =
                Tracer::new(Plan::fast(), Level::best().expect("a level")).render(&scene, &camera);
            let given = rendering.expect("nothing to refuse").image;
            assert_equal(&exact(&scene, &camera), &given, &|| format!("CGT_SEED={seed}, case {i}"));
            1
        })
        .sum();
    assert!(split > cases * 9 / 10, "{split} of {cases} cameras");
}

/// Tiles of more than sixteen blocks across, whose ranges take more than one row of lanes.
#[test]
fn tiles_of_many_blocks_are_exact() {
    let seed = seed();
    let mut rng = generator(seed, 0);
    let mut ball = || Sphere {
        center: [
            rng.random_range(-10.0f32..10.0),
            rng.random_range(-0.4f32..0.4),
            rng.random_range(-1.0f32..1.0),
        ],
        radius: rng.random_range(0.02f32..0.2),
        color: std::array::from_fn(|_| rng.random()),
    };
    let scene = Scene::new((0..300).map(|_| ball()).collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(300, 12).expect("a size");
    let camera =
        Camera::new([0.0, 0.0, 15.0], [-0.66, 0.03, -1.0], [0.0044, 0.0, 0.0], [0.0, -0.005, 0.0], size);
    let camera = camera.expect("a camera");
    let truth = exact(&scene, &camera);
    let hits = truth.ids.iter().filter(|id| **id != MISS).count();
    for side in [16, 17, 32, 40, 64] {
        let plan = Plan { packet: Packet::Tile { side }, ..Plan::fast() };
        let given = Tracer::new(plan, Level::best().expect("a level")).render(&scene, &camera);
        let given = given.expect("nothing to refuse").image;
        assert_equal(&truth, &given, &|| format!("CGT_SEED={seed}, {plan}"));
    }
    eprintln!("CGT_SEED={seed}: {hits} pixels show a sphere");
    assert!(hits > 500 && hits < 3_000, "{hits} pixels show a sphere");
}

/// The eye within a few steps of f32 of a sphere's surface, on either side or on it, so that f32 cannot tell the side, and another sphere
/// inside that one: whichever of the two roots is taken for the hit decides what is seen.
#[test]
fn eyes_about_a_surface_see_what_is_there() {
    let size = Size::new(12, 12).expect("a size");
    let plans = [1, 3].map(|side| Plan { packet: Packet::Tile { side }, ..Plan::fast() });
    let plans = [Plan { packet: Packet::Block, ..Plan::fast() }, plans[0], plans[1]];
    let mut seen = [0u32; 3];
    for scale in [1.0, 2f32.powi(-9), 2f32.powi(9)] {
        for steps in -4..=4i32 {
            let radius = f32::from_bits(1f32.to_bits().wrapping_add_signed(steps)) * scale;
            let ball = |radius, red| Sphere { center: [0.0, 0.0, -scale], radius, color: [red, 9, 9] };
            let spheres = vec![ball(radius, 200), ball(0.5 * scale, 100)];
            let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
            for forward in [-1.0, 1.0] {
                let corner = [-0.9, 0.9, forward];
                let camera = Camera::new([0.0; 3], corner, [0.15, 0.0, 0.0], [0.0, -0.15, 0.0], size);
                let camera = camera.expect("a camera");
                let truth = exact(&scene, &camera);
                for plan in plans {
                    for level in [Level::SCALAR, Level::best().expect("a level")] {
                        let given = Tracer::new(plan, level).render(&scene, &camera);
                        let given = given.expect("nothing to refuse").image;
                        assert_equal(&truth, &given, &|| {
                            format!("{steps} steps, scale {scale:e}, {forward}; {plan}, {level}")
                        });
                    }
                }
                for id in truth.ids {
                    seen[if id == MISS { 2 } else { id as usize }] += 1;
                }
            }
        }
    }
    eprintln!("{seen:?} pixels show the sphere at the eye, the one in it, and none");
    assert!(seen.iter().all(|n| *n > 500), "{seen:?}");
}

/// What a session keeps from frame to frame is memory alone.
#[test]
fn a_frame_does_not_depend_on_the_one_before() {
    let matrix = Matrix::new().expect("all data that is there can be read");
    let mut session = Tracer::new(Plan::fast(), Level::best().expect("a level")).session().expect("memory");
    for case in matrix.cases.iter().step_by(7) {
        let fresh = Tracer::new(Plan::fast(), Level::best().expect("a level"));
        let fresh = fresh.render(&case.scene, &case.camera).expect("nothing to refuse");
        let given = session.render(&case.scene, &case.camera).expect("nothing to refuse");
        assert_equal(&fresh.image, &given.image, &|| case.name.clone());
        assert_eq!((&fresh.events, fresh.counts), (&given.events, given.counts), "{}", case.name);
    }
}

/// Which frames of a session are rendered by what is known of them: none, all, or every other one.
const KNOWN: [fn(usize) -> bool; 4] = [|_| false, |_| true, |i| i % 2 == 0, |i| i % 2 == 1];

/// Frames of one size in one session, of as many spheres, of others, of none, before other backgrounds: what the one before left, on the
/// image and in memory, is in none of them, whether they are known or not.
#[test]
fn frames_of_one_size_follow_each_other() {
    let (seed, mut frames) = (seed(), Vec::new());
    let mut rng = generator(seed, 0);
    for i in 0..24u8 {
        let count = [40, 40, 0, 3, 300, 300][usize::from(i) % 6];
        let mut ball = || Sphere {
            center: std::array::from_fn(|_| rng.random_range(-2.0f32..2.0)),
            // In every other six frames none is large.
            radius: rng.random_range(0.13f32..if i % 12 < 6 { 0.4 } else { 0.24 }),
            color: std::array::from_fn(|_| rng.random()),
        };
        let spheres: Vec<Sphere> = (0..count).map(|_| ball()).collect();
        let background = if i % 4 < 2 { [i, 2, 3] } else { [9; 3] };
        let eye: [f32; 3] = [rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0), 6.0];
        let size = Size::new(61, 47).expect("a size");
        let camera = Camera::new(eye, [-0.6, 0.5, -1.0], [0.02, 0.0, 0.0], [0.0, -0.02, 0.0], size);
        let scene = Scene::new(spheres, background, DEFAULT_LIGHT).expect("valid");
        frames.push((scene, camera.expect("a camera")));
    }
    let truths: Vec<Image> = frames.iter().map(|(scene, camera)| exact(scene, camera)).collect();
    let best = Level::best().expect("a level");
    for packet in
        [Packet::Block, Packet::Tile { side: 2 }, Packet::Tile { side: 8 }, Packet::Tile { side: 32 }]
    {
        for (level, workers) in [(best, 1), (best, 3), (Level::SCALAR, 2)] {
            let plan = Plan { packet, ..Plan::fast() };
            for (turn, is_known) in KNOWN.into_iter().enumerate() {
                let mut session = Tracer::new(plan, level).workers(workers).session().expect("memory");
                for (i, ((scene, camera), truth)) in frames.iter().zip(&truths).enumerate() {
                    let given = if is_known(i) {
                        session.render_known(scene, camera, &Known::of(truth))
                    } else {
                        session.render(scene, camera)
                    };
                    assert_equal(truth, &given.expect("nothing to refuse").image, &|| {
                        format!(
                            "frame {i} of CGT_SEED={seed}, known by turn {turn}; {plan}, {level}, {workers} workers"
                        )
                    });
                }
            }
        }
    }
    let misses = truths.iter().map(|truth| truth.ids.iter().filter(|id| **id == MISS).count()).sum::<usize>();
    assert!(
        misses > truths.len() * 61 * 47 / 4 && misses < truths.len() * 61 * 47 * 9 / 10,
        "{misses} misses"
    );
}

/// A frame that leaves something in one column of blocks alone, the first, the last or one between, and then one that shows nothing, though
/// there is a sphere behind the eye: nothing stays.
#[test]
fn what_one_column_of_blocks_shows_is_cleared() {
    let (width, height) = (23u16, 9u16);
    let size = Size::new(width.into(), height.into()).expect("a size");
    let corner = [-f32::from(width) / 2.0, f32::from(height) / 2.0, -20.0];
    let camera = Camera::new([0.0; 3], corner, [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size).expect("a camera");
    let behind = Sphere { center: [0.0, 0.0, 20.0], radius: 0.4, color: [200; 3] };
    let empty = Scene::new(vec![behind], [3; 3], DEFAULT_LIGHT).expect("valid");
    let truth = exact(&empty, &camera);
    assert!(truth.ids.iter().all(|id| *id == MISS));
    for x in 0..width {
        let ball =
            Sphere { center: [f32::from(x) + 0.5 + corner[0], 0.0, -20.0], radius: 0.4, color: [200; 3] };
        let scene = Scene::new(vec![ball], [3; 3], DEFAULT_LIGHT).expect("valid");
        for side in [1, 2, 8] {
            let plan = Plan { packet: Packet::Tile { side }, ..Plan::fast() };
            let tracer = Tracer::new(plan, Level::best().expect("a level"));
            let mut session = tracer.session().expect("memory");
            let shown = session.render(&scene, &camera).expect("nothing to refuse");
            let columns: Vec<usize> = (0..size.width() as usize)
                .filter(|x| shown.image.ids.iter().skip(*x).step_by(width.into()).any(|id| *id != MISS))
                .collect();
            assert_eq!(columns, [usize::from(x)], "more than one column is seen, or none");
            let given = session.render(&empty, &camera).expect("nothing to refuse");
            assert_equal(&truth, &given.image, &|| format!("after a sphere in column {x}; {plan}"));
            // A frame that is known leaves and clears as well.
            let shown = session.render(&scene, &camera).expect("nothing to refuse").image.clone();
            let nothing = Known::of(&truth);
            let given = session.render_known(&empty, &camera, &nothing).expect("nothing to refuse");
            assert_equal(&truth, &given.image, &|| format!("known, after a sphere in column {x}; {plan}"));
            session.render_known(&scene, &camera, &Known::of(&shown)).expect("nothing to refuse");
            let given = session.render(&empty, &camera).expect("nothing to refuse");
            assert_equal(&truth, &given.image, &|| format!("after a known sphere in column {x}; {plan}"));
        }
    }
}

/// Pictures of fewer columns than a block has, and something in one of many rows of blocks: nothing is written beside a row's end, which
/// is where the next one begins.
#[test]
fn rows_narrower_than_a_block_are_kept() {
    for (width, height) in (1u16..=5).flat_map(|width| [(width, 3u16), (width, 9), (width, 33)]) {
        let size = Size::new(width.into(), height.into()).expect("a size");
        let corner = [-f32::from(width) / 2.0, f32::from(height) / 2.0, -20.0];
        let camera =
            Camera::new([0.0; 3], corner, [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size).expect("a camera");
        for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
            let center = [corner[0] + f32::from(x) + 0.5, corner[1] - f32::from(y) - 0.5, -20.0];
            let ball = Sphere { center, radius: 0.4, color: [200; 3] };
            let scene = Scene::new(vec![ball], [3; 3], DEFAULT_LIGHT).expect("valid");
            let truth = exact(&scene, &camera);
            assert_eq!(truth.ids.iter().filter(|id| **id != MISS).count(), 1, "one pixel sees the ball");
            for packet in [Packet::Block, Packet::Tile { side: 1 }, Packet::Tile { side: 16 }] {
                let plan = Plan { packet, ..Plan::fast() };
                let given = Tracer::new(plan, Level::best().expect("a level")).render(&scene, &camera);
                let given = given.expect("nothing to refuse");
                assert_equal(&truth, &given.image, &|| {
                    format!("{width}x{height}, a ball at {x}, {y}; {plan}")
                });
            }
        }
    }
}

/// Many small spheres in one tile and in many slices, so that candidates come in several rounds, and hardly one hides another: whichever
/// were left out would be seen.
#[test]
fn candidates_of_every_round_are_met() {
    let (seed, side) = (seed(), 128u16);
    for i in 0..3 {
        let mut rng = generator(seed, i);
        let mut ball = || Sphere {
            center: std::array::from_fn(|axis| rng.random_range(-1.0f32..1.0) * [1.0, 1.0, 8.0][axis]),
            radius: rng.random_range(0.02f32..0.03),
            color: std::array::from_fn(|_| rng.random()),
        };
        let scene = Scene::new((0..2_000).map(|_| ball()).collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
        let step = 0.18 / f32::from(side);
        let size = Size::new(side.into(), side.into()).expect("a size");
        let camera =
            Camera::new([0.0, 0.0, 20.0], [-0.09, 0.09, -1.0], [step, 0.0, 0.0], [0.0, -step, 0.0], size);
        let camera = camera.expect("a camera");
        let truth = exact(&scene, &camera);
        let mut seen: Vec<u32> = truth.ids.iter().copied().filter(|id| *id != MISS).collect();
        seen.sort_unstable();
        seen.dedup();
        for slices in [6, 20, 60] {
            let plan = Plan { resolution: Resolution::Fixed(slices), ..Plan::fast() };
            let given = Tracer::new(plan, Level::best().expect("a level")).render(&scene, &camera);
            let given = given.expect("nothing to refuse").image;
            assert_equal(&truth, &given, &|| format!("{slices} slices, picture {i} of CGT_SEED={seed}"));
        }
        eprintln!("CGT_SEED={seed}: {} spheres are seen", seen.len());
        assert!(seen.len() > 1_000, "too little was at stake: {} spheres are seen", seen.len());
    }
}

/// Of many spheres those much larger than the others are in no cell but are shown to every tile; where they alone fill a round, no slice of the
/// grid has been looked at yet, and what is small may be before them.
#[test]
fn small_spheres_before_many_large_ones_are_seen() {
    let (seed, tries) = (seed(), count("CGT_TILE_LARGE", 6));
    let side = 24;
    let size = Size::new(side, side).expect("small");
    let before: u64 = (0..tries)
        .into_par_iter()
        .map(|i| {
            let mut rng = generator(seed, i);
            let number = 14_336 + rng.random_range(0..4000);
            // As many as may be large, or hardly any.
            let large = if i % 3 == 2 { 3 } else { number / 64 + 32 };
            let heading = rng.random_range(0..3);
            let sign = if rng.random() { 1.0 } else { -1.0 };
            let turned = |v: [f32; 3]| -> [f32; 3] { std::array::from_fn(|j| sign * v[(j + heading) % 3]) };
            let mut spheres: Vec<Sphere> = (0..number)
                .map(|k| {
                    let (center, radius) = if k < large {
                        (
                            [0, 1, 2].map(|j| {
                                if j < 2 {
                                    rng.random_range(-0.5..0.5)
                                } else {
                                    rng.random_range(12.0f32..14.0)
                                }
                            }),
                            4.0,
                        )
                    } else if k % 8 == 0 {
                        // In the first slice, near the axis, before the large ones.
                        let z = rng.random_range(3.0f32..7.0);
                        ([z * rng.random_range(-0.1..0.1), z * rng.random_range(-0.1..0.1), z], 0.007_812_5)
                    } else {
                        let far = |rng: &mut dyn Rng| if RngExt::random(rng) { 50.0f32 } else { -50.0 };
                        ([far(&mut rng), far(&mut rng), if rng.random() { 5.0 } else { 105.0 }], 0.007_812_5)
                    };
                    Sphere { center: turned(center), radius, color: [k as u8, (k >> 8) as u8, 99] }
                })
                .collect();
            // Ids say nothing of sizes.
            for k in (1..spheres.len()).rev() {
                spheres.swap(k, rng.random_range(0..=k));
            }
            let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
            let pixel = 0.2 / side as f32;
            let camera = Camera::new(
                turned([0.0; 3]),
                turned([-0.1, -0.1, 1.0]),
                turned([pixel, 0.0, 0.0]),
                turned([0.0, pixel, 0.0]),
                size,
            )
            .expect("a camera");
            let truth = exact(&scene, &camera);
            for plan in [Plan::fast(), Plan::for_scene(&scene).plan] {
                for level in Level::available() {
                    let image = Tracer::new(plan, level).render(&scene, &camera).expect("a picture").image;
                    assert_equal(&truth, &image, &|| format!("CGT_SEED={seed}, case {i}, {plan}, {level}"));
                }
            }
            let is_small = |id: &&u32| **id != MISS && scene.spheres()[**id as usize].radius < 1.0;
            truth.ids.iter().filter(is_small).count() as u64
        })
        .sum();
    eprintln!(
        "judged: {tries} scenes of 14,336 spheres and more, {before} pixels of a small one before large ones"
    );
    assert!(before > 20 * tries, "CGT_SEED={seed}: hardly a small one is seen: {before}");
}

#[test]
fn what_tiles_need_is_asked_for() {
    let matrix = Matrix::new().expect("all data that is there can be read");
    let case = &matrix.cases[0];
    let fast = Plan::fast();
    let lacking = [
        Plan { voxelizer: Voxelizer::BoxRange, ..fast },
        Plan { cells: Cells::Queue, ..fast },
        Plan { arithmetic: Arithmetic::Rounded(Form::Perpendicular), ..fast },
        Plan { margins: Margins::None, ..fast },
        Plan { packet: Packet::Tile { side: 0 }, ..fast },
        Plan { packet: Packet::Tile { side: 65 }, ..fast },
    ];
    for plan in lacking {
        let refused = Tracer::new(plan, Level::SCALAR).render(&case.scene, &case.camera);
        assert_eq!(refused.map(|_| ()), Err(RenderError::Tile { plan }));
    }
    let none = Plan { resolution: Resolution::UpTo(241), ..fast };
    let refused = Tracer::new(none, Level::SCALAR).render(&case.scene, &case.camera);
    assert_eq!(refused.map(|_| ()), Err(RenderError::Resolution { cells: 241 }));
}

#[test]
fn what_is_known_must_be_of_the_frame() {
    let (size, other) = (Size::new(8, 8).expect("a size"), Size::new(8, 4).expect("a size"));
    let camera = |size| {
        let camera = Camera::new([0.0, 0.0, 5.0], [-0.8, 0.8, -2.0], [0.2, 0.0, 0.0], [0.0, -0.2, 0.0], size);
        camera.expect("a camera")
    };
    let ball = |x: f32| Sphere { center: [x, 0.0, 0.0], radius: 1.0, color: [9; 3] };
    let scene = |spheres| Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
    let (two, one) = (scene(vec![ball(9.0), ball(0.0)]), scene(vec![ball(0.0)]));
    let mut session = Tracer::new(Plan::fast(), Level::SCALAR).session().expect("memory");
    let known = Known::of(&session.render(&two, &camera(size)).expect("a picture").image);
    let refused = session.render_known(&two, &camera(other), &known).map(|_| ());
    assert_eq!(refused, Err(RenderError::Known { known: size, asked: other }));
    let refused = session.render_known(&one, &camera(size), &known).map(|_| ());
    assert_eq!(refused, Err(RenderError::KnownId { id: 1, spheres: 1 }));
}

#[test]
#[should_panic(expected = "index out of bounds")]
fn an_image_that_lacks_ids_is_not_known() {
    let mut image = Image::new(Size::new(8, 8).expect("a size"), [0; 3]).expect("small");
    image.ids.truncate(63);
    let _ = Known::of(&image);
}

#[test]
fn a_plan_is_chosen_for_reasons() {
    let ball = |i: u16| Sphere { center: [f32::from(i), 0.0, 0.0], radius: 0.4, color: [9; 3] };
    let scene = |spheres: Vec<Sphere>| Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
    let few = Plan::for_scene(&scene((0..100).map(ball).collect()));
    assert_eq!((few.plan, few.reasons), (Plan::fast(), vec![Reason::Few { spheres: 100 }]));
    let many = Plan::for_scene(&scene((0..50_000).map(ball).collect()));
    assert_eq!(many.plan.packet, Packet::Tile { side: 16 });
    assert!(many.reasons[0].to_string().contains("50000 spheres"), "{}", many.reasons[0]);
    let tiny = Plan::for_scene(&scene(vec![Sphere { radius: 1e-20, ..ball(1) }]));
    assert_eq!((tiny.plan.packet, tiny.reasons), (Packet::Block, vec![Reason::OutOfRange]));
}

struct Bits([f32; LANES], [f32; LANES]);

impl Work for Bits {
    type Output = u32;

    fn on<M: Machine + Send + Sync>(self, m: M) -> u32 {
        m.within(|| m.to_bits(m.lt(m.lanes(self.0), m.lanes(self.1))))
    }
}

#[test]
fn bits_are_lanes_at_every_level() {
    let mut rng = generator(seed(), 0);
    for level in Level::available() {
        for _ in 0..1000 {
            let [x, y]: [[f32; LANES]; 2] =
                std::array::from_fn(|_| std::array::from_fn(|_| rng.random_range(-1.0f32..1.0)));
            let expected = (0..LANES).map(|i| u32::from(x[i] < y[i]) << i).sum::<u32>();
            assert_eq!(level.run(Bits(x, y)), expected, "{level}");
        }
    }
}

/// A grid for tiles, whoever builds it, lists every sphere once: in the cell of its centre, or apart if it is large.
#[test]
fn a_grid_lists_every_sphere_once_whoever_builds_it() {
    let seed = seed();
    // Above what one worker does alone, and below.
    for n in [300_000, 17, 1] {
        let mut rng = generator(seed, n);
        let mut sphere = || {
            let size = if rng.random_range(0..2_000) == 0 { 64.0 } else { rng.random_range(0.5f32..1.0) };
            let center = std::array::from_fn(|_| rng.random_range(-1.0f32..1.0));
            Sphere { center, radius: 0.001 * size, color: [1; 3] }
        };
        let spheres: Vec<Sphere> = (0..n).map(|_| sphere()).collect();
        let mut memory = Memory::default();
        let mut build = |workers: usize| {
            let crew = Crew::new(workers).expect("threads");
            let grid =
                Grid::by_center(Scalar, &Plan::fast(), &spheres, &mut memory, &crew).expect("in range");
            let cells: i32 = grid.axes.iter().map(|axis| axis.n).product();
            let rows: Vec<Vec<u32>> =
                (0..cells.unsigned_abs() as usize).map(|cell| grid.row([cell; 2]).to_vec()).collect();
            let large = grid.large.clone();
            let (axes, stride, widen) = (grid.axes.clone(), grid.strides(), grid.widen);
            memory.take(Some(grid));
            (axes, stride, rows, large, widen)
        };
        let (axes, stride, rows, large, widen) = build(1);
        // Several times, since at times one worker is so quick that the others find nothing to do.
        for workers in [2, 3, 8].repeat(6) {
            let again = build(workers);
            assert_eq!(
                (&again.2, &again.3, again.4),
                (&rows, &large, widen),
                "{workers} workers, seed {seed}"
            );
        }
        assert_eq!(n == 300_000, large.len() > 20, "{} large of {n}, seed {seed}", large.len());
        let mut place = vec![None; spheres.len()];
        for (cell, ids) in rows.iter().enumerate() {
            for &id in ids {
                let sphere = spheres[id as usize];
                let of = |i: usize| axes[i].cell(Scalar, Scalar.lanes([sphere.center[i]; LANES]))[0];
                let wanted: usize = (0..3).map(|i| of(i).unsigned_abs() as usize * stride[i]).sum();
                assert_eq!(cell, wanted, "sphere {id}: {sphere:?}, seed {seed}");
                assert!(sphere.radius <= widen, "sphere {id}: {sphere:?} beyond {widen}, seed {seed}");
                assert!(
                    place[id as usize].replace(cell).is_none(),
                    "sphere {id} is there twice, seed {seed}"
                );
            }
        }
        for &id in &large {
            assert!(
                place[id as usize].replace(usize::MAX).is_none(),
                "sphere {id} is there twice, seed {seed}"
            );
        }
        assert!(place.iter().all(Option::is_some), "a sphere is nowhere, seed {seed}");
        eprintln!("{n} spheres, {} cells, {} large", rows.len(), large.len());
    }
}

/// Frames of several workers, asked for by the workers of somebody else's pool, come to an end: no frame waits within another.
#[test]
fn a_foreign_pool_may_ask_for_frames() {
    let spheres =
        (0..40u8).map(|k| Sphere { center: [0.0, 0.1 * f32::from(k), 3.0], radius: 0.2, color: [k; 3] });
    let scene = Scene::new(spheres.collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(64, 64).expect("small");
    let camera =
        Camera::new([0.0; 3], [-0.5, -0.5, 1.0], [1.0 / 64.0, 0.0, 0.0], [0.0, 1.0 / 64.0, 0.0], size);
    let camera = camera.expect("not degenerate");
    let frame = || {
        let tracer = Tracer::new(Plan::fast(), Level::best().expect("a level")).workers(3);
        tracer.render(&scene, &camera).expect("a picture").image
    };
    let alone = pixels(&frame());
    let together: Vec<_> = (0..200).into_par_iter().map(|_| pixels(&frame())).collect();
    assert!(together.iter().all(|picture| *picture == alone), "pictures differ");
}

fn looking(size: [u32; 2], corner: [f32; 3], du: [f32; 3], dv: [f32; 3]) -> Camera {
    let size = Size::new(size[0], size[1]).expect("small");
    Camera::new([0.0; 3], corner, du, dv, size).expect("a camera")
}

fn plain(spheres: Vec<Sphere>, background: [u8; 3]) -> Scene {
    Scene::new(spheres, background, DEFAULT_LIGHT).expect("valid")
}

fn plain_ball(center: [f32; 3], radius: f32) -> Sphere {
    Sphere { center, radius, color: [200, 150, 100] }
}

/// Frames of one area and other sides, and of one size before backgrounds that share a channel or are black, as an image is at first: each
/// with a ball in its middle, and blocks that none ever wrote to.
#[test]
fn no_frame_has_the_sides_or_the_background_of_the_one_before() {
    let frames = [
        ([32, 8], [9, 0, 0]),
        ([8, 32], [9, 0, 0]),
        ([8, 32], [9, 5, 5]),
        ([8, 32], [9, 5, 6]),
        ([16, 16], [9, 5, 6]),
        ([32, 8], [9; 3]),
        ([32, 8], [0; 3]),
        ([8, 32], [0; 3]),
        ([8, 32], [0, 0, 1]),
        ([8, 32], [0; 3]),
    ];
    let ball = plain_ball([0.5, -0.5, -20.0], 1.2);
    for packet in [Packet::Block, Packet::Tile { side: 1 }, Packet::Tile { side: 8 }] {
        for workers in [1, 2] {
            let plan = Plan { packet, ..Plan::fast() };
            let tracer = Tracer::new(plan, Level::best().expect("a level")).workers(workers);
            for (turn, is_known) in KNOWN.into_iter().enumerate() {
                let mut session = tracer.session().expect("memory");
                for (i, (size, background)) in frames.into_iter().enumerate() {
                    let [w, h] = size.map(|n| n as f32 / 2.0);
                    let camera = looking(size, [-w, h, -20.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
                    let scene = plain(vec![ball], background);
                    let truth = exact(&scene, &camera);
                    assert!(truth.ids.contains(&0) && truth.ids.contains(&MISS), "frame {i}");
                    let given = if is_known(i) {
                        session.render_known(&scene, &camera, &Known::of(&truth))
                    } else {
                        session.render(&scene, &camera)
                    };
                    assert_equal(&truth, &given.expect("nothing to refuse").image, &|| {
                        format!("frame {i}, known by turn {turn}; {plan}, {workers} workers")
                    });
                }
            }
        }
    }
}

/// Rays of one block go along two axes, so that it is written in two parts; what the first frame shows there alone is not in the second.
#[test]
fn what_a_block_of_two_axes_shows_is_cleared() {
    // From 0.7 to 1.3 times as far to the right as ahead.
    let camera = looking([4, 4], [0.6, -0.2, -1.0], [0.2, 0.0, 0.0], [0.0, 0.1, 0.0]);
    let behind = plain(vec![plain_ball([0.0, 0.0, 20.0], 0.4)], [3; 3]);
    for x in [0.7, 0.9, 1.1, 1.3] {
        let scene = plain(vec![plain_ball([10.0 * x, 0.5, -10.0], 0.7)], [3; 3]);
        let (shown, cleared) = (exact(&scene, &camera), exact(&behind, &camera));
        assert!(shown.ids.contains(&0) && shown.ids.contains(&MISS) && !cleared.ids.contains(&0), "{x}");
        for packet in [Packet::Block, Packet::Tile { side: 1 }, Packet::Tile { side: 8 }] {
            let plan = Plan { packet, ..Plan::fast() };
            let mut session = Tracer::new(plan, Level::best().expect("a level")).session().expect("memory");
            for (scene, truth) in [(&scene, &shown), (&behind, &cleared)] {
                let given = session.render(scene, &camera).expect("nothing to refuse");
                assert_equal(truth, &given.image, &|| format!("{x}; {plan}"));
            }
        }
    }
}

/// After a frame that is refused the last one is whole: its picture, and what was told of it. So it is after one whose known picture is another's,
/// and the next good one is as if nothing had been.
#[test]
fn a_refused_frame_leaves_the_last_one_whole() {
    let refusing = |plan| Plan { on_event: OnEvent::Refuse, ..plan };
    let corners =
        Plan { voxelizer: Voxelizer::EightCorners, resolution: Resolution::Fixed(8), ..Plan::safe() };
    let view = |size| looking(size, [-0.8, 0.8, -2.0], [0.2, 0.0, 0.0], [0.0, -0.2, 0.0]);
    // Cells of 0.5 by 0.375 by 0.5.
    let small = [[-2.0, 0.0, -6.0], [2.0, 1.0, -8.0], [0.0, -2.0, -10.0]].map(|at| plain_ball(at, 0.01));
    let with = |radius| [vec![plain_ball([0.4, -0.4, -8.0], radius)], small.to_vec()].concat();
    let (good, spanning) = (plain(with(0.15), [1, 2, 3]), plain(with(1.0), [7; 3]));
    let out_of_range = plain(with(1e-20), [1, 2, 3]);
    let refused = [
        (refusing(Plan::fast()), &out_of_range),
        (refusing(Plan::safe()), &out_of_range),
        (refusing(corners), &out_of_range),
        (refusing(corners), &spanning),
    ];
    for (plan, bad) in refused {
        let mut session = Tracer::new(plan, Level::best().expect("a level")).session().expect("memory");
        assert_eq!(session.last().image.ids, [MISS], "before the first frame");
        assert!(session.render(bad, &view([8, 8])).is_err(), "{plan}: not refused");
        assert_eq!(session.last().image.ids, [MISS], "after a first frame that was refused");
        let first = session.render(&good, &view([8, 8])).expect("nothing to refuse").clone();
        assert!(first.image.ids.contains(&0) && first.events.count() == 0, "{plan}");
        for size in [[8, 8], [8, 4]] {
            assert!(session.render(bad, &view(size)).is_err(), "{plan}: not refused");
            let known = Known::of(&first.image);
            assert!(session.render_known(&good, &view([4, 8]), &known).is_err(), "{plan}: not refused");
            let last = session.last();
            assert_equal(&first.image, &last.image, &|| format!("after a refused frame; {plan}"));
            assert_eq!(
                (&last.events, last.counts, last.times),
                (&first.events, first.counts, first.times),
                "after a refused frame; {plan}"
            );
        }
        let again = session.render(&good, &view([8, 8])).expect("nothing to refuse");
        assert_equal(&first.image, &again.image, &|| format!("the next frame; {plan}"));
        assert_eq!((&again.events, again.counts), (&first.events, first.counts), "{plan}");
    }
}

/// Events are those of the frame, also of one whose picture is known.
#[test]
fn events_are_of_their_own_frame() {
    let camera = looking([8, 4], [-0.8, 0.4, -2.0], [0.2, 0.0, 0.0], [0.0, -0.2, 0.0]);
    let good = plain(vec![plain_ball([0.0, 0.0, -8.0], 2.0)], [0; 3]);
    let bad = plain(vec![plain_ball([0.0, 0.0, -8.0], 2.0), plain_ball([9.0; 3], 1e-20)], [0; 3]);
    let known = Known::of(&exact(&bad, &camera));
    for plan in [Plan::fast(), Plan::safe()] {
        let mut session = Tracer::new(plan, Level::best().expect("a level")).session().expect("memory");
        for _ in 0..2 {
            let given = session.render(&bad, &camera).expect("falls back");
            assert_eq!(given.events.first(), [Event::OutOfRange], "{plan}");
            let given = session.render_known(&bad, &camera, &known).expect("falls back");
            assert_eq!(given.events.first(), [Event::OutOfRange], "known; {plan}");
            let given = session.render_known(&good, &camera, &known).expect("nothing to tell");
            assert_eq!(given.events.count(), 0, "known, in range; {plan}");
        }
    }
}

/// What is known of a picture is of its sides, not of as many pixels; and of several ids that a scene has not the first is told.
#[test]
fn what_is_known_is_refused_by_what_is_seen_first() {
    let view = |size: [u32; 2]| {
        let [w, h] = size.map(|n| n as f32 / 2.0);
        looking(size, [-w, h, -20.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0])
    };
    let at = |x: f32| plain_ball([x, 0.5, -20.0], 0.9);
    let three = plain(vec![plain_ball([0.0, 0.0, 20.0], 1.0), at(-2.5), at(2.5)], [0; 3]);
    let swapped = plain(vec![plain_ball([0.0, 0.0, 20.0], 1.0), at(2.5), at(-2.5)], [0; 3]);
    let one = plain(vec![at(0.0)], [0; 3]);
    let [wide, high] = [[8, 4], [4, 8]].map(|[w, h]| Size::new(w, h).expect("small"));
    for plan in [Plan::fast(), Plan { packet: Packet::Block, ..Plan::fast() }] {
        let mut session = Tracer::new(plan, Level::SCALAR).session().expect("memory");
        for (scene, first) in [(&three, 1), (&swapped, 2)] {
            let known = Known::of(&session.render(scene, &view([8, 4])).expect("a picture").image);
            // As many blocks, in rows where they were in columns: each could be looked up.
            let turned = Known::of(&session.render(scene, &view([4, 8])).expect("a picture").image);
            let refused = session.render_known(scene, &view([8, 4]), &turned).map(|_| ());
            assert_eq!(refused, Err(RenderError::Known { known: high, asked: wide }), "{plan}");
            let refused = session.render_known(&one, &view([8, 4]), &known).map(|_| ());
            assert_eq!(refused, Err(RenderError::KnownId { id: first, spheres: 1 }), "{plan}");
        }
    }
}

/// One sphere out of range is enough, wherever it stands, and how many there are is told.
#[test]
fn a_plan_is_chosen_for_all_spheres() {
    let ball = |i: u16| Sphere { center: [f32::from(i), 0.0, 0.0], radius: 0.4, color: [9; 3] };
    for at in 0..3 {
        let mut spheres: Vec<Sphere> = (0..3).map(ball).collect();
        spheres[at].radius = 1e-20;
        let chosen = Plan::for_scene(&plain(spheres, [0; 3]));
        assert_eq!((chosen.plan.packet, chosen.reasons), (Packet::Block, vec![Reason::OutOfRange]), "{at}");
    }
    for (spheres, reason) in [
        (49_999, Reason::Few { spheres: 49_999 }),
        (50_000, Reason::Many { spheres: 50_000 }),
        (60_000, Reason::Many { spheres: 60_000 }),
    ] {
        let chosen = Plan::for_scene(&plain((0..spheres).map(ball).collect(), [0; 3]));
        assert_eq!(chosen.reasons, [reason]);
    }
}

/// A picture by blocks and by tiles, which must be the exact one; its hits.
fn judged(scene: &Scene, camera: &Camera, packets: &[Packet], resolution: Resolution, what: &str) -> usize {
    let truth = exact(scene, camera);
    for packet in packets {
        let plan = Plan { packet: *packet, resolution, ..Plan::fast() };
        let given = Tracer::new(plan, Level::best().expect("a level")).render(scene, camera);
        let given = given.expect("nothing to refuse").image;
        assert_equal(&truth, &given, &|| format!("{what}; {plan}"));
    }
    truth.ids.iter().filter(|id| **id != MISS).count()
}

/// Of a wall, a ball whose surface is some 4 in a million of its radius away, f64 knows t to one part in 10¹⁰, of other balls to one in 10¹² or
/// better. Each must have its own error: in blocks that show both, whichever comes last, and in tiles that show fewer than the first one did. Since
/// f32 has a boundary of rounding within the wall's error once in some thousand times, it takes many pictures.
#[test]
fn each_sphere_has_its_own_error() {
    let (seed, pictures) = (seed(), count("CGT_TILE_WALLS", 4_000));
    let each = (0..pictures).into_par_iter().map(|i| {
        let mut rng = generator(seed, i);
        // So far that it is certain in f32 on which side of it the eye is, but hardly farther.
        let toward: [f64; 3] = [1.0, rng.random_range(-0.3..0.3), rng.random_range(-0.3..-0.1)];
        let length = toward.iter().map(|x| x * x).sum::<f64>().sqrt();
        let away = 2f64.powi(19) + rng.random_range(1.6..2.4);
        #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
        let mut spheres = vec![plain_ball(toward.map(|x| (x / length * away) as f32), 524_288.0)];
        // About one to a block, or so few that the wall is not set apart as large, and most of them in the first tile.
        let (all, first) = [(120, 20), (30, 24)][usize::from(i % 4 == 3)];
        for k in 0..all {
            let low = if k < first { -1.0f32 } else { 1.0 };
            let (x, y) = (rng.random_range(-1.0..low.max(-0.6)), rng.random_range(-low.max(-0.6)..1.0));
            let distance = rng.random_range(0.2f32..0.3);
            let scale = distance / (1.0 + x * x + y * y).sqrt();
            spheres.push(plain_ball([x * scale, y * scale, -scale], distance / 20.0));
        }
        let camera = looking([40, 40], [-1.0, 1.0, -1.0], [0.05, 0.0, 0.0], [0.0, -0.05, 0.0]);
        let packets = [Packet::Block, Packet::Tile { side: 2 }];
        let scene = plain(spheres, [0; 3]);
        judged(&scene, &camera, &packets, Resolution::Fixed(1), &format!("picture {i} of CGT_SEED={seed}"))
            as u64
    });
    let hits: u64 = each.sum();
    eprintln!("CGT_SEED={seed}: {hits} hits");
    assert!(hits > 700 * pictures, "too little was at stake: {hits}");
}

/// Balls 50,000 radii away, on an axis and where the two lesser components of eye − centre make up for the greatest, of either sign: their whole disc,
/// whose rim f32 cannot tell, and their middle, where f64 is not sure of t.
#[test]
fn balls_from_afar_have_their_error_on_all_axes() {
    let (seed, mut hits, mut misses) = (seed(), 0, 0);
    let mut rng = generator(seed, 0);
    for turn in 0..3 {
        for [near, sense] in [[0.0, 1.0], [0.0, -1.0], [0.4, 1.0], [0.4, -1.0], [0.45, 1.0], [0.45, -1.0]] {
            let radius = rng.random_range(0.5f32..2.0);
            let far = sense * 45_000.0 * radius * rng.random_range(0.95f32..1.0);
            // |x| + |y| = |z|, or both are zero.
            let [x, y] = [near * far, if near > 0.0 { (1.0 - near) * far } else { 0.0 }];
            let turned = |v: [f32; 3]| -> [f32; 3] { std::array::from_fn(|i| v[(i + turn) % 3]) };
            let ball = plain_ball(turned([x, y, far]), radius);
            let scene = plain(vec![ball], [0; 3]);
            let packets = [Packet::Block, Packet::Tile { side: 8 }];
            for (pixels, radii) in [(128u16, 1.1f32), (192, 0.6)] {
                let step = 2.0 * radii * radius / f32::from(pixels);
                let corner = turned([x - radii * radius, y - radii * radius, far]);
                let size = [u32::from(pixels); 2];
                let camera = looking(size, corner, turned([step, 0.0, 0.0]), turned([0.0, step, 0.0]));
                let seen = judged(
                    &scene,
                    &camera,
                    &packets,
                    Resolution::UpTo(240),
                    &format!("{ball:?}, CGT_SEED={seed}"),
                );
                hits += seen;
                misses += usize::from(pixels).pow(2) - seen;
            }
        }
    }
    eprintln!("CGT_SEED={seed}: {hits} hits, {misses} misses");
    assert!(hits > 300_000 && misses > 20_000, "too little was at stake: {hits}, {misses}");
}

/// Two balls straight ahead whose surfaces are next to one another, and whose distances f32 rounds to different places: which is nearer it does not
/// know, by as much as they are away.
#[test]
fn which_is_nearer_from_afar_is_not_known_to_f32() {
    for (turn, sense) in (0..3).flat_map(|turn| [(turn, 1.0f32), (turn, -1.0)]) {
        let turned = |v: [f32; 3]| -> [f32; 3] { std::array::from_fn(|i| v[(i + turn) % 3]) };
        let ball = |at: f32, radius| plain_ball(turned([0.0, 0.0, sense * at]), radius);
        let spheres = [ball(65_535.5, 10.0), ball(65_536.5, 11.0)];
        for step in -4..=4i8 {
            let eye = turned([0.0, 0.0, 0.0011 * f32::from(step)]);
            let corner = turned([-1.0, -1.0, sense * 65_525.5]);
            let (du, dv) = (turned([0.05, 0.0, 0.0]), turned([0.0, 0.05, 0.0]));
            let camera =
                Camera::new(eye, corner, du, dv, Size::new(40, 40).expect("small")).expect("a camera");
            for spheres in [spheres.to_vec(), spheres.into_iter().rev().collect()] {
                let scene = plain(spheres, [0; 3]);
                let packets = [Packet::Block, Packet::Tile { side: 8 }];
                judged(&scene, &camera, &packets, Resolution::UpTo(240), &format!("{sense}, {eye:?}"));
                let nearer = |id: &u32| scene.spheres()[*id as usize].radius == 11.0;
                assert!(exact(&scene, &camera).ids.iter().all(nearer), "the flatter one is in front");
            }
        }
    }
}

/// Sixteen spheres are looked at together, of which the first and the last hold the eye, and of another the surface is so near that f32 cannot tell
/// the side: that is each one's own affair. A third lies between the two roots of that one.
#[test]
fn each_sphere_has_its_own_side() {
    let mut seen = [0u32; 3];
    for steps in -6..=6i32 {
        let radius = f32::from_bits(1f32.to_bits().wrapping_add_signed(steps));
        let around = |radius| plain_ball([0.0, 0.0, -0.5], radius);
        let near = |radius| plain_ball([0.0, 0.0, -1.0], radius);
        let spheres = vec![around(8.0), near(radius), near(0.5), around(9.0)];
        for spheres in [spheres.clone(), spheres.into_iter().rev().collect()] {
            let scene = plain(spheres, [0; 3]);
            for forward in [-1.0, 1.0] {
                let camera = looking([12, 12], [-0.9, 0.9, forward], [0.15, 0.0, 0.0], [0.0, -0.15, 0.0]);
                let packets = [Packet::Block, Packet::Tile { side: 1 }, Packet::Tile { side: 3 }];
                judged(
                    &scene,
                    &camera,
                    &packets,
                    Resolution::Fixed(1),
                    &format!("{steps} steps, {forward}, {:?}", scene.spheres()),
                );
                for id in exact(&scene, &camera).ids {
                    let radius = scene.spheres()[id as usize].radius;
                    seen[[0.7, 2.0].iter().filter(|limit| radius > **limit).count()] += 1;
                }
            }
        }
    }
    eprintln!("{seen:?} pixels show the inner one, the near one and one around");
    assert!(seen.iter().all(|n| *n > 500), "{seen:?}");
}

/// Of a ball that a ray grazes it may be certain in f32 that it is hit, and yet not to a thousandth of its radius where. Another one that the
/// ray faces, with its front within that thousandth and before the hit, must be met all the same: by tiles though 300 others behind both fill
/// a round before it comes, and by blocks though its centre is in a later slice, as near as it can be. A ray of its own for each place.
#[test]
fn what_is_faced_before_a_grazing_hit_is_met() {
    let rule = Rule::new(NEAREST);
    let (mut cases, mut between, mut seen) = (0usize, 0, [0u32; 2]);
    for (distance, half, step) in [10.0f32, 40.0]
        .into_iter()
        .flat_map(|at| (12..=34).map(move |half| (at, half)))
        .flat_map(|(at, half)| (5..=21i32).flat_map(move |k| [(at, half, k), (at, half, -k)]))
    {
        // The hit lies `off` behind the front of the other, or before it, and half a chord before the centre.
        let off = f64::from(step.signum()) * 2f64.powi(-step.abs());
        #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
        let aside = (1.0 - 2f64.powf(-0.5 * f64::from(half))).sqrt() as f32;
        let chord = (1.0 - f64::from(aside).powi(2)).sqrt();
        #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
        let grazed = [(f64::from(distance) + chord + off) as f32, aside, 0.0];
        let found = Rays::new(Scalar, [[0.0; LANES]; 2]).find(
            Scalar,
            &Ball { center: grazed, rr: 1.0, bound: rule.bound(grazed[0], 1.0), side: Side::Outside },
            [true; LANES],
        );
        let found = found.expect("it is not missed");
        // Slices begin at whole numbers, from 7 before to 9 behind, and nobody is larger than the others.
        let faced = [(distance + 1.0).next_up(), 0.0, 0.0];
        let mut centers = vec![grazed, faced, [distance - 7.0, 6.0, 6.0], [distance + 9.0, -6.0, -6.0]];
        centers.extend((0..300u16).map(|i| [distance + 0.5 + f32::from(i) / 1024.0, -0.99, 0.0]));
        // Along each axis in turn, in both senses.
        let (turn, sense) = (cases / 2 % 3, if cases / 6 % 2 == 0 { 1.0 } else { -1.0 });
        let turned = |v: [f32; 3]| -> [f32; 3] { std::array::from_fn(|i| sense * v[(i + turn) % 3]) };
        let scene =
            plain(centers.into_iter().map(|center| plain_ball(turned(center), 1.0)).collect(), [0; 3]);
        let (du, dv) = ([0.0, 0.25, 0.0], [0.0, 0.0, 0.25]);
        let camera = looking([1, 1], turned([1.0, -0.125, -0.125]), turned(du), turned(dv));
        let packets = [Packet::Block, Packet::Tile { side: 1 }, Packet::Tile { side: 32 }];
        let what = format!("{distance}, 2^-{half}/2, {step}, axis {turn}, {sense}");
        judged(&scene, &camera, &packets, Resolution::Fixed(16), &what);
        let owner = exact(&scene, &camera).ids[0];
        seen[owner as usize] += 1;
        // By more than all margins of the way to it.
        let before = found.lo[0] * (1.0 + 64.0 * NEAREST as f32) < distance;
        between += u32::from(owner == 1 && found.certain[0] && before);
        cases += 1;
    }
    eprintln!(
        "{cases} rays: {seen:?} see the grazed ball and the faced one, {between} of these between certain ends"
    );
    assert!(seen.iter().all(|n| *n > 500) && between > 250, "too little was at stake: {seen:?}, {between}");
}
