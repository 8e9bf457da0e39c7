//! Is what is hit also visited, and what overlaps listed? Decided in integers by `verify::visible`, on inputs made to lie
//! where rounding decides.

use contract::{Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use optimized::Form;
use optimized::crew::Crew;
use optimized::event::Events;
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::margin::in_range;
use optimized::plan::{Arithmetic, Cells, Margins, OnEvent, Plan, Resolution, Voxelizer};
use optimized::seen::Seen;
use rand::{Rng, RngExt};
use rayon::prelude::*;
use verify::seed::{count, generator, seed};
use verify::visible::{Checked, hits_are_visible, listing_is_complete, rays_are_walked};

const VOXELIZERS: [Voxelizer; 4] =
    [Voxelizer::EightCorners, Voxelizer::BoxRange, Voxelizer::Overlap, Voxelizer::ByCenter];

const ARITHMETICS: [Arithmetic; 5] = [
    Arithmetic::Rounded(Form::Textbook),
    Arithmetic::Rounded(Form::Perpendicular),
    Arithmetic::Spu(Form::Textbook),
    Arithmetic::Spu(Form::Perpendicular),
    Arithmetic::Certified,
];

/// Two spheres that pin the grid's ends, so that spheres added between them leave its planes where they are.
fn pins(size: f32, offset: f32) -> Vec<Sphere> {
    let at = |x: f32| Sphere { center: [x + offset; 3], radius: size / 100.0, color: [9; 3] };
    vec![at(0.0), at(size)]
}

fn seen(plan: Plan, spheres: &[Sphere], camera: &Camera) -> (Scene, Seen) {
    let scene = Scene::new(spheres.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid by construction");
    let seen = Seen::new(
        Scalar,
        plan,
        &scene,
        camera,
        &mut Memory::default(),
        &mut Events::default(),
        &Crew::alone(),
    )
    .expect("falls back");
    (scene, seen)
}

/// A camera of 4x4 rays that differ by about `spread`, towards a target.
fn beam(eye: [f32; 3], target: [f32; 3], spread: f32, rng: &mut impl Rng) -> Option<Camera> {
    let size = Size::new(4, 4).expect("one block");
    let span = |rng: &mut _| -> [f32; 3] {
        std::array::from_fn(|_| spread * RngExt::random_range(rng, -1.0f32..1.0))
    };
    let (du, dv) = (span(rng), span(rng));
    let corner = [0, 1, 2].map(|i| (target[i] - eye[i]) - 2.0 * (du[i] + dv[i]));
    Camera::new(eye, corner, du, dv, size).ok()
}

fn ulps(x: f32, steps: i32) -> f32 {
    (0..steps.abs()).fold(x, |x, _| if steps > 0 { x.next_up() } else { x.next_down() })
}

/// One scene of a few spheres that touch planes of the grid within 0, 1 or 2 ulp on one, two or three axes, and beams at
/// their rims.
fn check(plan: Plan, seed: u64, i: u64) -> Checked {
    let mut rng = generator(seed, i);
    // On the SPU smaller spheres are out of range.
    let least = if matches!(plan.arithmetic, Arithmetic::Spu(_)) { -1 } else { -3 };
    let size = 10f32.powi(rng.random_range(least..4));
    let offset = if rng.random() { 0.0 } else { -size * rng.random_range(0.0f32..100.0) };
    let mut spheres = pins(size, offset);
    let distance = [0.1, 0.6, 3.0, 40.0, 1000.0][rng.random_range(0..5usize)] * size;
    let side = |rng: &mut _| if RngExt::random(rng) { 1.0 } else { -1.0 };
    let mut eye: [f32; 3] = std::array::from_fn(|_| {
        offset + size * 0.5 + side(&mut rng) * distance * rng.random_range(0.1f32..1.0)
    });
    // An eye at the origin leaves the rounding of distances alone to be covered.
    if rng.random_range(0..4) == 0 {
        eye[rng.random_range(0..3usize)] = 0.0;
        eye[rng.random_range(0..3usize)] = 0.0;
    }
    let camera = beam(eye, [offset + size * 0.5; 3], size * 1e-3, &mut rng).expect("a beam");
    let planes = match seen(plan, &spheres, &camera).1.grid {
        Some(grid) => grid.axes.map(|axis| axis.planes),
        None => return Checked::default(),
    };
    for _ in 0..4 {
        let radius = size * [0.004, 0.02, 0.1][rng.random_range(0..3usize)];
        let axes = rng.random_range(1..=3);
        let center = [0, 1, 2].map(|axis| {
            let plane = planes[axis][rng.random_range(0..planes[axis].len())];
            let touching = ulps(plane + side(&mut rng) * radius, rng.random_range(-2..=2));
            let anywhere = offset + size * rng.random_range(0.1f32..0.9);
            let chosen = if axis < axes { touching } else { anywhere };
            chosen.clamp(offset + 0.09 * size, offset + 0.91 * size)
        });
        spheres.push(Sphere { center, radius, color: [9; 3] });
    }
    let (scene, listed) = seen(plan, &spheres, &camera);
    let mut checked = listing_is_complete(&listed, &scene)
        .unwrap_or_else(|wrong| panic!("{wrong}; scene {i} of CGT_SEED={seed}"));
    for _ in 0..3 {
        let aim = &spheres[rng.random_range(2..spheres.len())];
        // Where the box touches, or anywhere on the surface.
        let direction: [f32; 3] = match rng.random_range(0..3usize) {
            0 => std::array::from_fn(|_| rng.random_range(-1.0f32..1.0)),
            _ => {
                let axis = rng.random_range(0..3usize);
                let sign = side(&mut rng);
                std::array::from_fn(|i| if i == axis { sign } else { 0.0 })
            }
        };
        let length = direction.iter().map(|x| x * x).sum::<f32>().sqrt().max(0.1);
        let target = [0, 1, 2].map(|i| aim.center[i] + aim.radius * direction[i] / length);
        let spread = size * 10f32.powi(rng.random_range(-8..-1));
        let Some(camera) = beam(eye, target, spread, &mut rng) else { continue };
        // The camera's directions decide the range, so the scene is seen anew.
        let (scene, seen) = seen(plan, &spheres, &camera);
        let hits = hits_are_visible(&seen, &scene, &camera);
        checked = checked + hits.unwrap_or_else(|wrong| panic!("{wrong}; scene {i} of CGT_SEED={seed}"));
        let walked = rays_are_walked(&seen, &scene, &camera, &mut rng);
        let walked = walked.unwrap_or_else(|wrong| panic!("{wrong}; scene {i} of CGT_SEED={seed}"));
        checked = checked + walked;
    }
    // Beams at the corners of cells, where walk and slices are closest to a mistake.
    for _ in 0..6 {
        let mut target = [0, 1, 2].map(|axis| planes[axis][rng.random_range(0..planes[axis].len())]);
        // Listed by centre, it is the centre that should come to lie on a plane, a reach away from the ray.
        let widen = listed.grid.as_ref().map_or(0.0, |grid| grid.widen);
        target[rng.random_range(0..3usize)] += side(&mut rng) * widen;
        let spread = size * 10f32.powi(rng.random_range(-9..-4));
        let Some(camera) = beam(eye, target, spread, &mut rng) else { continue };
        let (scene, seen) = seen(plan, &spheres, &camera);
        let walked = rays_are_walked(&seen, &scene, &camera, &mut rng);
        checked = checked + walked.unwrap_or_else(|wrong| panic!("{wrong}; scene {i} of CGT_SEED={seed}"));
    }
    checked
}

#[test]
fn hits_are_visible_and_listings_complete() {
    let (seed, scenes) = (seed(), count("CGT_VISIBLE_SCENES", 300));
    eprintln!("CGT_SEED={seed}, {scenes} scenes for each plan");
    for voxelizer in VOXELIZERS {
        for arithmetic in ARITHMETICS {
            let resolution = Resolution::Fixed(if voxelizer == Voxelizer::EightCorners { 4 } else { 7 });
            let plan = Plan {
                voxelizer,
                arithmetic,
                resolution,
                cells: Cells::Lists,
                on_event: OnEvent::FallBack,
                ..Plan::safe()
            };
            let checked = (0..scenes)
                .into_par_iter()
                .map(|i| check(plan, seed, i))
                .reduce(Checked::default, |a, b| a + b);
            eprintln!("{voxelizer:?}, {arithmetic:?}: {checked:?}");
            assert!(
                checked.hits > scenes * 10 && checked.overlapping > scenes * 5,
                "too little was at stake: {checked:?}"
            );
            assert!(checked.points > scenes * 10 && checked.balls > scenes * 10, "{checked:?}");
            assert!(checked.near_planes > scenes / 20, "hardly a point near a plane: {checked:?}");
            assert!(
                arithmetic != Form::Textbook.into() || checked.beyond_surface > scenes,
                "no point beyond a surface"
            );
        }
    }
}

/// What is seen is spoilt in one place each, and the checks must say so. The spheres stand in a line, so that by centre the
/// grid has no extent on two axes.
#[test]
fn the_checks_can_say_no() {
    let ball = |x: f32| Sphere { center: [x, 0.3, 0.2], radius: 0.5, color: [9; 3] };
    let spheres = [ball(0.0), ball(2.0), ball(4.0)];
    let size = Size::new(8, 8).expect("small");
    let near = Camera::new([2.0, 0.3, 9.0], [-2.2, 0.6, -9.0], [0.55, 0.0, 0.0], [0.0, -0.15, 0.0], size);
    let near = near.expect("a camera");
    let plan = Plan { resolution: Resolution::Fixed(7), ..Plan::safe() };
    let hits = |plan: Plan, camera: &Camera, spoil: &dyn Fn(&mut Seen)| {
        let (scene, mut seen) = seen(plan, &spheres, camera);
        let sound = hits_are_visible(&seen, &scene, camera).expect("not spoilt yet");
        assert!(sound.hits > 2, "{sound:?}");
        spoil(&mut seen);
        hits_are_visible(&seen, &scene, camera).expect_err("spoilt")
    };
    let culled = hits(plan, &near, &|seen| seen.spheres[1].cull_radius = 0.01);
    assert!(culled.starts_with("culled: sphere 1"), "{culled}");
    let elsewhere = [ball(0.0), ball(4.0), ball(4.0)];
    let lost = hits(plan, &near, &|seen| seen.grid = self::seen(plan, &elsewhere, &near).1.grid);
    assert!(lost.contains("does not list the sphere: sphere 1"), "{lost}");
    let by_center = Plan { voxelizer: Voxelizer::ByCenter, ..plan };
    let unvisited = hits(by_center, &near, &|seen| seen.grid.as_mut().expect("in range").widen = 0.0);
    assert!(unvisited.starts_with("the walk does not come to cell"), "{unvisited}");
    // 2,000 radii away, where the textbook form reports hits beyond the surface.
    let far = Camera::new([2.0, 0.3, 999.0], [-2.2, 0.6, -999.0], [0.55, 0.0, 0.0], [0.0, -0.15, 0.0], size);
    let textbook = Plan { arithmetic: Form::Textbook.into(), ..plan };
    let beyond = hits(textbook, &far.expect("a camera"), &|seen| seen.plan.margins = Margins::None);
    assert!(beyond.starts_with("the reported point lies beyond the reach"), "{beyond}");

    let (scene, mut listed) = seen(plan, &spheres, &near);
    assert!(listing_is_complete(&listed, &scene).is_ok());
    listed.grid = seen(by_center, &spheres, &near).1.grid;
    let incomplete = listing_is_complete(&listed, &scene).expect_err("listed by centre alone");
    assert!(incomplete.contains("0 times"), "{incomplete}");
    let mut apart = spheres;
    (apart[0].center, apart[2].center) = ([0.0, -1.0, -1.0], [4.0, 1.0, 1.0]);
    let (scene, mut centered) = seen(by_center, &apart, &near);
    assert!(listing_is_complete(&centered, &scene).is_ok());
    let walked = |seen: &Seen| {
        let each = (0..200).map(|i| rays_are_walked(seen, &scene, &near, &mut generator(0, i)));
        each.reduce(Result::and).expect("200")
    };
    assert!(walked(&centered).is_ok());
    centered.grid.as_mut().expect("in range").widen *= 0.5;
    let unwalked = walked(&centered).expect_err("spoilt");
    assert!(unwalked.contains("a sphere with its centre at"), "{unwalked}");
}

/// Each limit of the range for which margins are derived, and one step beyond it.
#[test]
fn the_range_of_margins_ends_where_it_says() {
    let billion = (1u32 << 30) as f32;
    let size = Size::new(4, 4).expect("one block");
    let ball = |x: f32, radius: f32| vec![Sphere { center: [1.0, x, -3.0], radius, color: [9; 3] }];
    let by = |arithmetic, spheres: &[Sphere], eye: f32, corner: [f32; 3], du: f32| {
        let camera = Camera::new([0.0, 0.0, eye], corner, [du, 0.0, 0.0], [0.0, -du, 0.0], size);
        in_range(arithmetic, spheres, &camera.expect("a camera"))
    };
    let is = |spheres: &[Sphere], eye, corner, du| by(Arithmetic::Certified, spheres, eye, corner, du);
    let ahead = [-0.5, 0.5, -1.0];
    for (inside, outside) in [
        (ball(billion, 1.0), ball(billion.next_up(), 1.0)),
        (ball(-billion, 1.0), ball((-billion).next_down(), 1.0)),
        (ball(0.0, billion), ball(0.0, billion.next_up())),
        (ball(0.0, 1.0 / billion), ball(0.0, (1.0 / billion).next_down())),
    ] {
        assert!(is(&inside, 0.0, ahead, 0.25), "{inside:?}");
        assert!(!is(&outside, 0.0, ahead, 0.25), "{outside:?}");
    }
    // On the SPU spheres must be larger; elsewhere these are in range.
    let least = 1.0 / (1u32 << 14) as f32;
    for form in [Form::Textbook, Form::Perpendicular] {
        let spu = |radius: f32| by(Arithmetic::Spu(form), &ball(0.0, radius), 0.0, ahead, 0.25);
        assert!(spu(least) && !spu(least.next_down()) && is(&ball(0.0, least.next_down()), 0.0, ahead, 0.25));
    }
    let unit = ball(0.0, 1.0);
    assert!(is(&unit, billion, ahead, 0.25) && !is(&unit, billion.next_up(), ahead, 0.25), "eye");
    let short = |length: f32| is(&unit, 0.0, [-length, length, -length], length / 2.0);
    assert!(short(2e-6) && !short(9e-7), "directions shorter than 2^-20");
    assert!(short(1e5) && !short(1e6), "directions longer than 2^20");
}

/// So far from the origin that f32 moves points by more than any sphere reaches: where no centre is near enough, none is looked for, however
/// many steps of f32 there are.
#[test]
fn points_that_no_centre_reaches_are_passed_over() {
    let mut rng = generator(seed(), 0);
    let plan = Plan {
        voxelizer: Voxelizer::ByCenter,
        cells: Cells::Lists,
        resolution: Resolution::Fixed(4),
        ..Plan::safe()
    };
    let at = |x: f32| Sphere { center: [1e6 + x; 3], radius: 1e-3, color: [9; 3] };
    let mut points = 0;
    for _ in 0..20 {
        let camera = beam([1e6 - 1.0, 1e6, 1e6 + 2.0], [1e6 + 90.0, 1e6 + 70.0, 1e6 + 80.0], 1e-3, &mut rng);
        let (scene, seen) = seen(plan, &[at(0.0), at(100.0)], &camera.expect("a camera"));
        let camera = camera.expect("a camera");
        points +=
            rays_are_walked(&seen, &scene, &camera, &mut rng).unwrap_or_else(|why| panic!("{why}")).points;
    }
    assert!(points > 100, "{points} points within the grid");
}

/// A ball that touches a plane from below has a point in the cell that begins there; one that touches it from above has none in the
/// cell that ends there. Planes and radii are such that nothing is rounded.
#[test]
fn a_touched_cell_holds_a_point() {
    let camera = beam([0.5, 0.4, 99.0], [4.0; 3], 0.01, &mut generator(0, 0)).expect("a beam");
    let plan = Plan { arithmetic: Arithmetic::Certified, resolution: Resolution::Fixed(7), ..Plan::safe() };
    let pins = pins(8.0, 0.0);
    let overlapping = |spheres: &[Sphere]| {
        let (scene, seen) = seen(plan, spheres, &camera);
        let planes = seen.grid.as_ref().map(|grid| grid.axes[0].planes.clone()).expect("in range");
        let checked = listing_is_complete(&seen, &scene).expect("complete");
        (checked.overlapping, planes)
    };
    let (of_pins, planes) = overlapping(&pins);
    let radius = 1.0 / 16.0;
    let mut judged = 0;
    for axis in 0..3 {
        for &plane in &planes[1..7] {
            let middle = (planes[3] + planes[4]) / 2.0;
            for (offset, cells) in [(-radius, 2), (radius, 1)] {
                let mut center = [middle; 3];
                center[axis] = plane + offset;
                let exact = f64::from(plane) + f64::from(offset) == f64::from(center[axis]);
                if !exact {
                    continue;
                }
                let ball = Sphere { center, radius, color: [9; 3] };
                let (found, again) = overlapping(&[&pins[..], &[ball]].concat());
                assert_eq!(again, planes, "the pins hold the grid");
                assert_eq!(found - of_pins, cells, "{offset} from plane {plane} on axis {axis}");
                judged += 1;
            }
        }
    }
    eprintln!("{judged} balls that touch a plane");
    assert!(judged > 12, "too little was at stake");
}
