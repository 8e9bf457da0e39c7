//! Is what is hit also visited, and what overlaps listed? Decided in integers by `verify::visible`, on inputs made to lie
//! where rounding decides.

use contract::{Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use optimized::Form;
use optimized::event::Events;
use optimized::host::Scalar;
use optimized::plan::{Cells, OnEvent, Plan, Resolution, Voxelizer};
use optimized::seen::Seen;
use rand::{Rng, RngExt};
use rayon::prelude::*;
use verify::seed::{count, generator, seed};
use verify::visible::{Checked, hits_are_visible, listing_is_complete, rays_are_walked};

const VOXELIZERS: [Voxelizer; 4] =
    [Voxelizer::EightCorners, Voxelizer::BoxRange, Voxelizer::Overlap, Voxelizer::ByCenter];

/// Two spheres that pin the grid's ends, so that spheres added between them leave its planes where they are.
fn pins(size: f32, offset: f32) -> Vec<Sphere> {
    let at = |x: f32| Sphere { center: [x + offset; 3], radius: size / 100.0, color: [9; 3] };
    vec![at(0.0), at(size)]
}

fn seen(plan: Plan, spheres: &[Sphere], camera: &Camera) -> (Scene, Seen) {
    let scene = Scene::new(spheres.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid by construction");
    let seen = Seen::new(Scalar, plan, &scene, camera, &mut Events::default()).expect("falls back");
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
    let size = 10f32.powi(rng.random_range(-3..4));
    let offset = if rng.random() { 0.0 } else { -size * rng.random_range(0.0f32..100.0) };
    let mut spheres = pins(size, offset);
    let distance = [0.1, 0.6, 3.0, 40.0, 1000.0][rng.random_range(0..5usize)] * size;
    let side = |rng: &mut _| if RngExt::random(rng) { 1.0 } else { -1.0 };
    let eye: [f32; 3] = std::array::from_fn(|_| {
        offset + size * 0.5 + side(&mut rng) * distance * rng.random_range(0.1f32..1.0)
    });
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
    let (seed, scenes) = (seed(), count("CGT_VISIBLE_SCENES", 600));
    eprintln!("CGT_SEED={seed}, {scenes} scenes for each plan");
    for voxelizer in VOXELIZERS {
        for form in [Form::Textbook, Form::Perpendicular] {
            let resolution = Resolution::Fixed(if voxelizer == Voxelizer::EightCorners { 4 } else { 7 });
            let plan = Plan {
                voxelizer,
                form,
                resolution,
                cells: Cells::Lists,
                on_event: OnEvent::FallBack,
                ..Plan::safe()
            };
            let checked = (0..scenes)
                .into_par_iter()
                .map(|i| check(plan, seed, i))
                .reduce(Checked::default, |a, b| a + b);
            eprintln!("{voxelizer:?}, {form:?}: {checked:?}");
            assert!(
                checked.hits > scenes * 10 && checked.overlapping > scenes * 5,
                "too little was at stake: {checked:?}"
            );
            assert!(checked.points > scenes * 10 && checked.balls > scenes * 10, "{checked:?}");
            assert!(checked.near_planes > scenes / 20, "hardly a point near a plane: {checked:?}");
            assert!(
                form == Form::Perpendicular || checked.beyond_surface > scenes,
                "no point beyond a surface"
            );
        }
    }
}
