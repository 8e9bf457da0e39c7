//! From a recipe to a case: words of geometry become numbers. A recipe that asks for what is not there (a twin of nothing) gets the next
//! simplest thing. All in f64, rounded once, then moved by whole ulp; nothing here needs to be exact, since the truth is found from the
//! numbers that come out.

use super::recipe::{Ball, Recipe, View};
use crate::case::{Asked, Case};
use crate::seed::generator;
use crate::verdict::Verdict;
use contract::{Animation, Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use optimized::crew::Crew;
use optimized::event::Events;
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::plan::{OnEvent, Plan};
use optimized::seen::Seen;
use rand::RngExt;
use reference::Ray;

/// The case, if the contract accepts its numbers.
#[must_use]
pub fn case(recipe: &Recipe) -> Option<Case> {
    let camera = camera(recipe)?;
    let size = 10f64.powf(f64::from(recipe.size));
    let corner = size * f64::from(recipe.offset);
    let mut spheres = pins(corner, size);
    let planes = planes(&recipe.asked, &spheres, &camera);
    for ball in &recipe.balls {
        add(&mut spheres, ball, corner, size, &camera, planes.as_ref());
    }
    // Without other spheres than those that hold the grid's ends, there are none.
    if recipe.balls.is_empty() {
        spheres.clear();
    }
    for (i, sphere) in (0u32..).zip(&mut spheres) {
        let [low, ..] = i.to_le_bytes();
        sphere.color = [low.wrapping_mul(37), 255 - low.wrapping_mul(11), 90];
    }
    let scene = |spheres: Vec<Sphere>| Scene::new(spheres, [10, 20, 30], DEFAULT_LIGHT).ok();
    let mut frames = vec![scene(spheres.clone())?];
    if let (Some((which, by)), false) = (recipe.moved, spheres.is_empty()) {
        let chosen = usize::from(which) % spheres.len();
        for (x, by) in spheres[chosen].center.iter_mut().zip(by) {
            *x += single(size) * by;
        }
        frames.push(scene(spheres)?);
    }
    Some(Case {
        frames: Animation::new(frames).ok()?,
        camera,
        asked: recipe.asked.clone(),
        expected: Verdict::Undecidable,
        pixel: None,
        why: "drawn by a property".into(),
    })
}

#[allow(clippy::cast_possible_truncation, reason = "made in f64, rounded once")]
fn single(x: f64) -> f32 {
    x as f32
}

fn ulps(x: f32, steps: i8) -> f32 {
    (0..steps.unsigned_abs()).fold(x, |x, _| if steps > 0 { x.next_up() } else { x.next_down() })
}

/// Two spheres that hold the grid's ends, so that planes stay where they are whatever comes between them.
fn pins(corner: f64, size: f64) -> Vec<Sphere> {
    let pin = |x: f64| Sphere { center: [single(x); 3], radius: single(size / 100.0), color: [9; 3] };
    vec![pin(corner), pin(corner + size)]
}

/// The inner planes of the grid that the tracer makes of the pins.
fn planes(asked: &Asked, pins: &[Sphere], camera: &Camera) -> Option<[Vec<f32>; 3]> {
    let Asked::Grid { plan, .. } = *asked else { return None };
    let scene = Scene::new(pins.to_vec(), [0; 3], DEFAULT_LIGHT).ok()?;
    let plan = Plan { on_event: OnEvent::FallBack, ..plan };
    let (mut memory, mut events) = (Memory::default(), Events::default());
    let seen = Seen::new(Scalar, plan, &scene, camera, &mut memory, &mut events, &Crew::alone()).ok()?;
    let planes = seen.grid?.axes.map(|axis| axis.planes);
    Some(planes)
}

fn camera(recipe: &Recipe) -> Option<Camera> {
    let View { heading, distance, off, straight, width, target, size, mirrored } = recipe.view.clone();
    let scene = 10f64.powf(f64::from(recipe.size));
    let axis = usize::from(heading % 3);
    let sense = if heading < 3 { 1.0 } else { -1.0 };
    let away = scene * 10f64.powf(f64::from(distance));
    // What is looked at: a place in the cube that depends on the target's number alone.
    let middle = scene * f64::from(recipe.offset);
    let at = [0, 1, 2].map(|i| middle + scene * (0.3 + 0.4 * f64::from(target >> i & 7) / 7.0));
    let mut way = [0.0; 3];
    way[axis] = sense * away;
    if !straight {
        way[(axis + 1) % 3] = f64::from(off[0]) * away;
        way[(axis + 2) % 3] = f64::from(off[1]) * away;
    }
    let eye = [0, 1, 2].map(|i| single(at[i] - way[i]));
    let pixels = [f64::from(size[0]), f64::from(size[1])];
    // Rounded, so that straight ahead the middle one of an odd number of columns has no part of `du` at all.
    let step = f64::from(single(scene * f64::from(width) / pixels[0].max(pixels[1])));
    let (mut du, mut dv) = ([0.0; 3], [0.0; 3]);
    du[(axis + 1) % 3] = if mirrored { -step } else { step };
    dv[(axis + 2) % 3] = -step;
    let corner = [0, 1, 2].map(|i| single(way[i] - (pixels[0] * du[i] + pixels[1] * dv[i]) / 2.0));
    let size = Size::new(size[0].into(), size[1].into()).ok()?;
    Camera::new(eye, corner, du.map(single), dv.map(single), size).ok()
}

/// What cannot be a sphere is left out: which recipes give none is no matter.
fn push(spheres: &mut Vec<Sphere>, center: [f32; 3], radius: f32) {
    if center.iter().all(|x| x.is_finite()) && radius.is_finite() && radius > 0.0 {
        spheres.push(Sphere { center, radius, color: [0; 3] });
    }
}

fn add(
    spheres: &mut Vec<Sphere>,
    ball: &Ball,
    corner: f64,
    size: f64,
    camera: &Camera,
    planes: Option<&[Vec<f32>; 3]>,
) {
    let within = |at: [f32; 3]| at.map(|x| single(corner + size * (0.1 + 0.8 * f64::from(x))));
    let large = |radius: f32| single(size * f64::from(radius));
    match *ball {
        Ball::Anywhere { at, radius } => push(spheres, within(at), large(radius)),
        Ball::Touching { at, radius, axes, turn, planes: chosen, upper, ulps: off } => {
            let (mut center, radius) = (within(at), large(radius));
            for n in 0..usize::from(axes) {
                let i = (n + usize::from(turn)) % 3;
                let Some(plane) = planes.and_then(|p| p[i].get(usize::from(chosen[i]) % p[i].len())) else {
                    continue;
                };
                center[i] = ulps(if upper[i] { plane + radius } else { plane - radius }, off[i]);
            }
            push(spheres, center, radius);
        }
        Ball::Twin { of } => {
            let Sphere { center, radius, .. } = spheres[usize::from(of) % spheres.len()];
            push(spheres, center, radius);
        }
        Ball::Mirrored { of, axis } => {
            let Sphere { mut center, radius, .. } = spheres[usize::from(of) % spheres.len()];
            let axis = usize::from(axis);
            center[axis] = 2.0 * camera.eye()[axis] - center[axis];
            push(spheres, center, radius);
        }
        Ball::Around { of, factor } => {
            let Sphere { center, radius, .. } = spheres[usize::from(of) % spheres.len()];
            push(spheres, center, radius * factor);
        }
        Ball::Beside { of, axis, upper } => {
            let Sphere { mut center, radius, .. } = spheres[usize::from(of) % spheres.len()];
            center[usize::from(axis)] += if upper { 2.0 * radius } else { -2.0 * radius };
            push(spheres, center, radius);
        }
        Ball::AroundEye { off, radius } => {
            let radius = large(radius);
            push(spheres, [0, 1, 2].map(|i| camera.eye()[i] + radius * (off[i] - 0.5)), radius);
        }
        Ball::OnEye { radius, axis, upper, ulps: off } => {
            let (mut center, radius, axis) = (camera.eye(), large(radius), usize::from(axis));
            let eye = center[axis];
            center[axis] = if upper { eye + radius } else { eye - radius };
            // The radius that the rounded centre asks for: without ulp the eye is on it exactly, wherever that is a float.
            let radius = (center[axis] - eye).abs();
            center[axis] = ulps(center[axis], off);
            push(spheres, center, radius);
        }
        Ball::Behind { distance, radius } => {
            let middle = Ray::of_pixel(camera, camera.size().width() / 2, camera.size().height() / 2).dir;
            push(spheres, [0, 1, 2].map(|i| camera.eye()[i] - (0.1 + distance) * middle[i]), large(radius));
        }
        Ball::Crowd { count, at, radius } => {
            for n in 0..count {
                let mut center = within(at);
                center[usize::from(n % 3)] += single(size * f64::from(n) * 1e-4);
                push(spheres, center, large(radius));
            }
        }
        Ball::Swarm { count, seed } => {
            let mut rng = generator(seed.into(), 0);
            for _ in 0..count {
                let center = [0, 1, 2].map(|_| single(corner + size * rng.random_range(0.0..1.0)));
                // Radii over a decade, so that some are set apart as large.
                push(spheres, center, single(size * 10f64.powf(rng.random_range(-2.3..-1.2))));
            }
        }
        Ball::Grazed { pixel, along, radius, turn, ulps: off } => {
            let (ray, radius) = (ray(camera, pixel), large(radius));
            let point = ahead(&ray, corner, size, along);
            let across = across(ray.dir, turn);
            let center = [0, 1, 2].map(|i| single(point[i] + f64::from(radius) * across[i]));
            // The radius that the rounded centre asks for.
            let exact = distance(&ray, center);
            push(spheres, center, ulps(single(exact), off));
        }
        Ball::SameHit { of, pixel, radius, inside } => {
            let ray = ray(camera, pixel);
            let other = spheres[usize::from(of) % spheres.len()];
            let one = Scene::new(vec![other], [0; 3], DEFAULT_LIGHT).ok();
            let hit = one
                .and_then(|scene| reference::Tracer::new(reference::Arithmetic::Exact).trace(&ray, &scene));
            let radius = f64::from(large(radius));
            let length = ray.dir.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
            let t = hit.map_or(1.0, |hit| f64::from(hit.t));
            // Its centre lies on the ray, one radius behind the hit, or before it.
            let s = if inside { t - radius / length } else { t + radius / length };
            push(
                spheres,
                [0, 1, 2].map(|i| single(f64::from(ray.eye[i]) + s * f64::from(ray.dir[i]))),
                single(radius),
            );
        }
        Ball::Wild { center, radius } => {
            let finite =
                |bits: u32| f32::from_bits(if bits >> 23 & 0xff == 0xff { bits ^ 1 << 30 } else { bits });
            push(spheres, center.map(finite), finite(radius).abs());
        }
    }
}

fn ray(camera: &Camera, [x, y]: [u8; 2]) -> Ray {
    Ray::of_pixel(camera, u32::from(x) % camera.size().width(), u32::from(y) % camera.size().height())
}

/// A point of the ray in the scene's cube or near it.
fn ahead(ray: &Ray, corner: f64, size: f64, along: f32) -> [f64; 3] {
    let middle = corner + size / 2.0;
    let [d, e] = [ray.dir, ray.eye].map(|v| v.map(f64::from));
    let dd: f64 = d.iter().map(|x| x * x).sum();
    let to_middle: f64 = (0..3).map(|i| (middle - e[i]) * d[i]).sum::<f64>() / dd;
    let s = to_middle + (f64::from(along) - 0.5) * size / dd.sqrt();
    [0, 1, 2].map(|i| e[i] + s * d[i])
}

/// A unit vector at right angles to another, one of 256.
fn across(d: [f32; 3], turn: u8) -> [f64; 3] {
    let d = d.map(f64::from);
    let angle = f64::from(turn) / 256.0 * std::f64::consts::TAU;
    let largest = (0..3).fold(0, |best, i| if d[i].abs() > d[best].abs() { i } else { best });
    let mut u = [0.0; 3];
    (u[largest], u[(largest + 1) % 3]) = (-d[(largest + 1) % 3], d[largest]);
    let v: [f64; 3] = [0, 1, 2].map(|i| d[(i + 1) % 3] * u[(i + 2) % 3] - d[(i + 2) % 3] * u[(i + 1) % 3]);
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| if length > 0.0 { x / length } else { 0.0 })
    };
    let (u, v) = (unit(u), unit(v));
    [0, 1, 2].map(|i| angle.cos() * u[i] + angle.sin() * v[i])
}

/// Distance of a point from the ray's line.
fn distance(ray: &Ray, point: [f32; 3]) -> f64 {
    let d = ray.dir.map(f64::from);
    let f = [0, 1, 2].map(|i| f64::from(point[i]) - f64::from(ray.eye[i]));
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let h = dot(f, d) / dot(d, d);
    let l = [0, 1, 2].map(|i| f[i] - h * d[i]);
    dot(l, l).sqrt()
}
