//! Scenes with one thing in them that can be turned up, and cameras that look at one ball of them.
//!
//! The cloud holds all that the paper assumes of a scene: sixty-four balls, each smaller than a cell of a grid of 16 on an axis, hardly two
//! in a cell. So whatever fails on it fails for what was turned up. All numbers are made in f64 and rounded once.

use contract::{Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use rand::{Rng, RngExt};
use reference::Ray;

/// A scene and a camera.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The scene.
    pub scene: Scene,
    /// The camera.
    pub camera: Camera,
}

/// Three numbers before they are rounded.
pub type Vector = [f64; 3];

/// Pixels on a side of a shot.
pub const SIDE: u32 = 32;
/// Half a picture in radii of the ball that it shows.
const HALF: f64 = 1.25;
/// Radii between eye and ball where distance is not what is turned up.
pub const NEAR: f64 = 20.0;
/// Cells on an axis of the paper's grid.
pub const CELLS: f64 = 16.0;
/// Balls on an axis of the cloud, and radii between them.
const BALLS: i32 = 4;
const SPACING: f64 = 11.5;

#[allow(clippy::cast_possible_truncation, reason = "made in f64, rounded once")]
fn rounded(v: Vector) -> [f32; 3] {
    v.map(|x| x as f32)
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: Vector) -> Vector {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

fn plus(a: Vector, times: f64, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + times * b[i])
}

/// Any direction.
pub fn direction(rng: &mut impl Rng) -> Vector {
    loop {
        let v: Vector = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
        if (0.01..1.0).contains(&dot(v, v)) {
            return unit(v);
        }
    }
}

/// A direction at an angle to the nearest axis, toward the diagonal; which axis and which signs are drawn.
pub fn at_angle(degrees: f64, rng: &mut impl Rng) -> Vector {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let across = sine / f64::sqrt(2.0);
    let axis = rng.random_range(0..3);
    let mut v = [across; 3];
    v[axis] = cosine;
    v.map(|x| if rng.random() { x } else { -x })
}

/// A ball before it is rounded.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// Its centre.
    pub center: Vector,
    /// Its radius.
    pub radius: f64,
}

/// Balls of radius 1, none too large for a cell of the paper's grid about them.
pub fn cloud(rng: &mut impl Rng) -> Vec<Ball> {
    let mut balls = Vec::new();
    let places = || (0..BALLS).map(|i| SPACING * (f64::from(i) - f64::from(BALLS - 1) / 2.0));
    for x in places() {
        for y in places() {
            for z in places() {
                let center = [x, y, z].map(|x| x + rng.random_range(-0.5..0.5));
                balls.push(Ball { center, radius: 1.0 });
            }
        }
    }
    balls
}

/// Two balls that hold the box of the grid at the unit cube, whatever lies between them.
fn corners(radius: f64) -> [Ball; 2] {
    [radius, 1.0 - radius].map(|x| Ball { center: [x; 3], radius })
}

/// Balls of which each is `ratio` cells wide, as many as leave few in a cell.
pub fn sized(ratio: f64, rng: &mut impl Rng) -> Vec<Ball> {
    let radius = ratio / CELLS / 2.0;
    // A ball lies in about (1 + ratio)³ cells, and two on average are in each.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some hundred")]
    let count = (2.0 * (CELLS / (1.0 + ratio)).powi(3)).clamp(40.0, 600.0) as usize;
    let inside = |rng: &mut dyn FnMut() -> f64| Ball { center: [0; 3].map(|_| rng()), radius };
    let mut place = || rng.random_range(radius..1.0 - radius);
    let balls: Vec<Ball> = (0..count).map(|_| inside(&mut place)).collect();
    corners(radius).into_iter().chain(balls).collect()
}

/// So many balls about the middle of one cell, each `ratio` cells wide.
pub fn crowd(count: usize, ratio: f64, rng: &mut impl Rng) -> Vec<Ball> {
    let (cell, radius) = (1.0 / CELLS, ratio / CELLS / 2.0);
    // As long as there is room, no box leaves the cell.
    let slack = (0.48 - ratio / 2.0).max(0.1) * cell;
    let middle = 8.5 * cell;
    let ball = |rng: &mut dyn FnMut() -> f64| Ball { center: [0; 3].map(|_| middle + rng()), radius };
    let mut place = || rng.random_range(-slack..slack);
    let balls: Vec<Ball> = (0..count).map(|_| ball(&mut place)).collect();
    balls.into_iter().chain(corners(cell / 8.0)).collect()
}

/// Balls as a scene; `None` if f32 has no place for one.
pub fn scene(balls: &[Ball]) -> Option<Scene> {
    #[allow(clippy::cast_possible_truncation, reason = "made in f64, rounded once")]
    let sphere =
        |ball: &Ball| Sphere { center: rounded(ball.center), radius: ball.radius as f32, color: [200; 3] };
    Scene::new(balls.iter().map(sphere).collect(), [0; 3], DEFAULT_LIGHT).ok()
}

/// A camera at an eye that looks at a ball, which fills the picture. `None` if the contract has no such camera.
pub fn look(eye: Vector, ball: &Ball, side: u32, rng: &mut impl Rng) -> Option<Camera> {
    let eye = rounded(eye);
    let to = plus(ball.center, -1.0, eye.map(f64::from));
    let (distance, away) = (dot(to, to).sqrt(), unit(to));
    let half = HALF * ball.radius / distance;
    let right = unit(cross(away, direction(rng)));
    let up = cross(right, away);
    let step = 2.0 * half / f64::from(side);
    let corner = plus(plus(away, -half, right), half, up);
    let (du, dv) = (right.map(|x| step * x), up.map(|x| -step * x));
    Camera::new(eye, rounded(corner), rounded(du), rounded(dv), Size::new(side, side).ok()?).ok()
}

/// One of the balls, seen from so many radii away along a direction.
pub fn aimed(balls: &[Ball], radii: f64, toward: Vector, rng: &mut impl Rng) -> Option<Shot> {
    let ball = balls[rng.random_range(0..balls.len())];
    let eye = plus(ball.center, radii * ball.radius, toward);
    Some(Shot { scene: scene(balls)?, camera: look(eye, &ball, SIDE, rng)? })
}

/// One ray that passes a ball at so many units in the last place of its radius from a tangent, outside or inside. Two balls far off keep the
/// cells of a grid larger than it.
pub fn tangent(ulps: i64, rng: &mut impl Rng) -> Option<Shot> {
    let center = direction(rng).map(|x| 10.0 * x);
    let ball = Ball { center, radius: rng.random_range(1.0..2.0) };
    let camera = look(plus(center, NEAR * ball.radius, direction(rng)), &ball, 1, rng)?;
    // The ray's own distance from the centre becomes the radius: aside from the axis by any part of it.
    let aside = plus(ball.center, 0.7 * ball.radius, direction(rng));
    let ray = Ray::of_pixel(&camera, 0, 0);
    let (eye, dir) = (ray.eye.map(f64::from), unit(ray.dir.map(f64::from)));
    #[allow(clippy::cast_possible_truncation, reason = "rounded once")]
    let center = aside.map(|x| f64::from(x as f32));
    let from = plus(center, -1.0, eye);
    let apart = cross(from, dir);
    let radius = dot(apart, apart).sqrt();
    #[allow(clippy::cast_possible_truncation, reason = "rounded once, and moved by ulp")]
    let radius = f32::from_bits((radius as f32).to_bits().checked_add_signed(i32::try_from(ulps).ok()?)?);
    let far = 45.0 * f64::from(radius);
    let balls = [[far; 3], [-far; 3]].map(|center| Ball { center, radius: 1.0 });
    let touched = Ball { center, radius: f64::from(radius) };
    Some(Shot { scene: scene(&[touched, balls[0], balls[1]])?, camera })
}
