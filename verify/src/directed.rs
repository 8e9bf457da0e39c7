//! Rays and spheres made to lie where decisions are close: what random scenes practically never hold.
//!
//! Most cases start on a lattice of integers, where the answer is known exactly without any tracer
//! ([`Case::known`]); then coordinates are permuted, mirrored, shifted within 24 bits and scaled by powers of two, none of
//! which changes ids, and t only by a known factor. The `Near…` kinds take such a case and move one number by a few ulp.

use contract::Sphere;
use rand::{Rng, RngExt};
use reference::Ray;

/// What is close in a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// The ray touches the sphere in one point.
    Tangent,
    /// As `Tangent`, one number moved by 1 to 3 ulp.
    NearTangent,
    /// The eye is inside.
    Inside,
    /// The eye is on the surface.
    OnSurface,
    /// As `OnSurface`, one number moved by 1 to 3 ulp.
    NearSurface,
    /// Several spheres are the same.
    Coincident,
    /// Different spheres are hit at the same t.
    EqualRoots,
    /// As `EqualRoots`, one number moved by 1 to 3 ulp.
    NearEqualRoots,
    /// Spheres 10² to 10⁷ radii away, rays round their silhouettes.
    Far,
    /// Everything scaled down, to 10⁻³⁰ and so.
    Tiny,
    /// Everything scaled up, to 10³⁰ and so.
    Huge,
    /// Positions, radii or directions below the least normal f32.
    Subnormal,
    /// Every number with an exponent of its own.
    AnyExponents,
    /// Some spheres somewhere ahead.
    Random,
}

/// All kinds.
pub const KINDS: [Kind; 14] = [
    Kind::Tangent,
    Kind::NearTangent,
    Kind::Inside,
    Kind::OnSurface,
    Kind::NearSurface,
    Kind::Coincident,
    Kind::EqualRoots,
    Kind::NearEqualRoots,
    Kind::Far,
    Kind::Tiny,
    Kind::Huge,
    Kind::Subnormal,
    Kind::AnyExponents,
    Kind::Random,
];

/// One ray and a few spheres.
#[derive(Clone, Debug)]
pub struct Case {
    /// What is close in it.
    pub kind: Kind,
    /// The ray.
    pub ray: Ray,
    /// The spheres.
    pub spheres: Vec<Sphere>,
    /// The true answer where the construction tells it: `Some(None)` is a miss, else id and t.
    pub known: Option<Option<(u32, f32)>>,
}

/// Integer vectors w with |w| an integer, and two integer vectors at right angles to each.
const FRAMES: [([i32; 3], i32, [[i32; 3]; 2]); 4] = [
    ([2, 3, 6], 7, [[3, -2, 0], [0, 2, -1]]),
    ([1, 2, 2], 3, [[2, -1, 0], [0, 1, -1]]),
    ([4, 4, 7], 9, [[1, -1, 0], [0, 7, -4]]),
    ([0, 0, 1], 1, [[1, 0, 0], [0, 1, 0]]),
];

/// Makes a case of a kind.
pub fn case(kind: Kind, rng: &mut impl Rng) -> Case {
    match kind {
        Kind::Tangent => tangent(rng).place(kind, moderate(rng), rng),
        Kind::NearTangent => nudged(tangent(rng).place(kind, moderate(rng), rng), rng),
        Kind::Inside => inside(rng).place(kind, moderate(rng), rng),
        Kind::OnSurface => on_surface(rng).place(kind, moderate(rng), rng),
        Kind::NearSurface => nudged(on_surface(rng).place(kind, moderate(rng), rng), rng),
        Kind::Coincident => coincident(rng).place(kind, moderate(rng), rng),
        Kind::EqualRoots => equal_roots(rng).place(kind, moderate(rng), rng),
        Kind::NearEqualRoots => nudged(equal_roots(rng).place(kind, moderate(rng), rng), rng),
        Kind::Tiny => any_lattice(rng).place(kind, exponents(-110..-80, rng), rng),
        Kind::Huge => any_lattice(rng).place(kind, exponents(80..100, rng), rng),
        Kind::Subnormal => any_lattice(rng).place(kind, exponents(-149..-130, rng), rng),
        Kind::Far => far(rng),
        Kind::AnyExponents => any_exponents(rng),
        Kind::Random => random(rng),
    }
}

/// A case in integers: its only answer is `known`, id and t, or a miss.
struct Lattice {
    dir: [i32; 3],
    /// Centres relative to the eye, and radii.
    spheres: Vec<([i32; 3], i32)>,
    known: Option<(u32, i32)>,
}

impl Lattice {
    /// Shifts, permutes, mirrors and scales by 2^p (positions) and 2^q (directions), then turns to f32.
    fn place(&self, kind: Kind, [p, q]: [i32; 2], rng: &mut impl Rng) -> Case {
        let eye: [i32; 3] = std::array::from_fn(|_| rng.random_range(-1000..=1000));
        let (turn, swap) = (rng.random_range(0..3), rng.random::<bool>());
        let signs: [bool; 3] = rng.random();
        let arrange = |v: [i32; 3], exponent: i32| -> [f32; 3] {
            std::array::from_fn(|i| {
                let from = (if swap { 2 - i } else { i } + turn) % 3;
                scale(if signs[from] { -v[from] } else { v[from] }, exponent)
            })
        };
        let sphere = |&(c, r): &([i32; 3], i32)| Sphere {
            center: arrange(sum(eye, c), p),
            radius: scale(r, p),
            color: [200, 150, 100],
        };
        #[allow(clippy::cast_possible_truncation, reason = "rule 3: rounded once")]
        let t = |t: i32| (f64::from(t) * 2f64.powi(p - q)) as f32;
        Case {
            kind,
            ray: Ray { eye: arrange(eye, p), dir: arrange(self.dir, q) },
            spheres: self.spheres.iter().map(sphere).collect(),
            known: Some(self.known.map(|(id, x)| (id, t(x)))),
        }
    }
}

/// x 2^e, which must be an f32.
#[allow(clippy::cast_possible_truncation, reason = "asserted to be exact")]
fn scale(x: i32, e: i32) -> f32 {
    let exact = f64::from(x) * 2f64.powi(e);
    let scaled = exact as f32;
    assert_eq!(f64::from(scaled), exact, "{x} * 2^{e} is no f32");
    scaled
}

fn sum(u: [i32; 3], v: [i32; 3]) -> [i32; 3] {
    [0, 1, 2].map(|i| u[i] + v[i])
}

fn times(k: i32, v: [i32; 3]) -> [i32; 3] {
    v.map(|x| k * x)
}

fn moderate(rng: &mut impl Rng) -> [i32; 2] {
    exponents(-12..12, rng)
}

fn exponents(positions: std::ops::Range<i32>, rng: &mut impl Rng) -> [i32; 2] {
    [rng.random_range(positions.clone()), rng.random_range(positions)]
}

fn any_lattice(rng: &mut impl Rng) -> Lattice {
    match rng.random_range(0..5) {
        0 => tangent(rng),
        1 => inside(rng),
        2 => on_surface(rng),
        3 => coincident(rng),
        _ => equal_roots(rng),
    }
}

/// The centre stands at a right angle beside point s of the ray, one radius away.
fn tangent(rng: &mut impl Rng) -> Lattice {
    let (w, n, [d1, d2]) = FRAMES[rng.random_range(0..FRAMES.len())];
    let (alpha, beta) = (rng.random_range(-3..=3), rng.random_range(1..=3));
    let dir = sum(times(alpha, d1), times(beta, d2));
    let (s, k) = (rng.random_range(-5..=50), rng.random_range(1..=10));
    let known = (s > 0).then_some((0, s));
    Lattice { dir, spheres: vec![(sum(times(s, dir), times(k, w)), k * n)], known }
}

/// The eye is within the sphere, on its axis along the ray.
fn inside(rng: &mut impl Rng) -> Lattice {
    let (w, n, _) = FRAMES[rng.random_range(0..FRAMES.len())];
    let k = rng.random_range(1..=30);
    let s = rng.random_range(1 - k..k);
    Lattice { dir: w, spheres: vec![(times(s, w), k * n)], known: Some((0, s + k)) }
}

/// The eye is one radius from the centre; the ray goes through it, away from it, or along the surface.
fn on_surface(rng: &mut impl Rng) -> Lattice {
    let (w, n, [d1, _]) = FRAMES[rng.random_range(0..FRAMES.len())];
    let k = rng.random_range(1..=30);
    let (dir, known) = match rng.random_range(0..3) {
        0 => (w, Some((0, 2 * k))),
        1 => (times(-1, w), None),
        _ => (d1, None),
    };
    Lattice { dir, spheres: vec![(times(k, w), k * n)], known }
}

/// One sphere several times, behind one that is farther away.
fn coincident(rng: &mut impl Rng) -> Lattice {
    let (w, n, _) = FRAMES[rng.random_range(0..FRAMES.len())];
    let (k, gap) = (rng.random_range(1..=10), rng.random_range(1..=30));
    let twin = (times(k + gap, w), k * n);
    let mut spheres = vec![twin; rng.random_range(2..=4)];
    let farther = rng.random_range(0..2);
    for _ in 0..farther {
        spheres.insert(0, (times(k + gap + 50, w), k * n));
    }
    Lattice { dir: w, spheres, known: Some((farther, gap)) }
}

/// Spheres of different size that all have a hit at t, some from outside, some from inside.
fn equal_roots(rng: &mut impl Rng) -> Lattice {
    let (w, n, _) = FRAMES[rng.random_range(0..FRAMES.len())];
    let t = rng.random_range(1..=30);
    let mut spheres = Vec::new();
    let farther = rng.random_range(0..2);
    for _ in 0..farther {
        spheres.push((times(t + 60, w), 5 * n));
    }
    for _ in 0..rng.random_range(2..=4) {
        let k = rng.random_range(1..=20);
        // From inside: s + k = t and the eye within, so k > t / 2.
        let from_inside = rng.random::<bool>() && 2 * k > t;
        let s = if from_inside { t - k } else { t + k };
        spheres.push((times(s, w), k * n));
    }
    Lattice { dir: w, spheres, known: Some((farther, t)) }
}

/// One of the numbers moved by 1 to 3 ulp.
fn nudged(mut case: Case, rng: &mut impl Rng) -> Case {
    let mut numbers: Vec<&mut f32> = case.ray.eye.iter_mut().chain(&mut case.ray.dir).collect();
    for sphere in &mut case.spheres {
        numbers.extend(&mut sphere.center);
        numbers.push(&mut sphere.radius);
    }
    let chosen = rng.random_range(0..numbers.len());
    let (steps, up) = (rng.random_range(1..=3), rng.random::<bool>());
    for _ in 0..steps {
        *numbers[chosen] = if up { numbers[chosen].next_up() } else { numbers[chosen].next_down() };
    }
    case.known = None;
    case
}

/// A unit sphere or two far away, and a ray aimed at a silhouette, from far off it to within its last ulp.
fn far(rng: &mut impl Rng) -> Case {
    let distance = 10f64.powf(rng.random_range(2.0..7.0));
    let off = 10f64.powf(rng.random_range(-9.0..0.0)) * if rng.random() { 1.0 } else { -1.0 };
    aimed(distance, 1.0 + off, rng)
}

/// A unit sphere at a distance in any direction from the eye, and a ray that passes its centre at `impact`
/// radii, but for the rounding of the direction. Sometimes a second sphere touches it.
#[allow(clippy::cast_possible_truncation, reason = "made in f64, rounded once")]
pub fn aimed(distance: f64, impact: f64, rng: &mut impl Rng) -> Case {
    let mut unit = || loop {
        let v: [f64; 3] = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (0.1..1.0).contains(&length) {
            return v.map(|x| x / length);
        }
    };
    let (axis, other) = (unit(), unit());
    let along = (0..3).map(|i| axis[i] * other[i]).sum::<f64>();
    let across: [f64; 3] = std::array::from_fn(|i| other[i] - along * axis[i]);
    let length = across.iter().map(|x| x * x).sum::<f64>().sqrt();
    let center: [f64; 3] = std::array::from_fn(|i| distance * axis[i]);
    let target: [f64; 3] = std::array::from_fn(|i| center[i] + impact * across[i] / length);
    let sphere = |c: [f64; 3]| Sphere { center: c.map(|x| x as f32), radius: 1.0, color: [200; 3] };
    let mut spheres = vec![sphere(center)];
    if rng.random() {
        spheres.push(sphere(std::array::from_fn(|i| center[i] + 2.0 * axis[i])));
    }
    let dir = target.map(|x| (x / distance) as f32);
    Case { kind: Kind::Far, ray: Ray { eye: [0.0; 3], dir }, spheres, known: None }
}

/// Any finite numbers, of all exponents or of a range of some.
fn any_exponents(rng: &mut impl Rng) -> Case {
    let center = rng.random_range(-100..100);
    let spread = if rng.random() { 127 } else { 4 };
    let mut number = || {
        let exponent = (center + rng.random_range(-spread..=spread)).clamp(-149, 127);
        let x = rng.random_range(1.0..2.0) * 2f64.powi(exponent) * if rng.random() { 1.0 } else { -1.0 };
        #[allow(clippy::cast_possible_truncation, reason = "rounded once")]
        let x = x as f32;
        if x.is_finite() { x } else { f32::MAX }
    };
    let mut vector = || [number(), number(), number()];
    let ray = Ray { eye: vector(), dir: vector() };
    let centers = [vector(), vector()];
    let spheres = centers.map(|center| Sphere { center, radius: number().abs(), color: [200; 3] });
    Case { kind: Kind::AnyExponents, ray, spheres: spheres.to_vec(), known: None }
}

fn random(rng: &mut impl Rng) -> Case {
    let mut within = |lo: f32, hi: f32| rng.random_range(lo..hi);
    let ray = Ray {
        eye: [within(-0.2, 0.2), within(-0.2, 0.2), -2.0],
        dir: [within(-0.3, 0.3), within(-0.3, 0.3), 1.0],
    };
    let spheres = (0..6).map(|_| Sphere {
        center: [within(-0.6, 0.6), within(-0.6, 0.6), within(-1.0, 1.0)],
        radius: within(0.05, 0.5),
        color: [200; 3],
    });
    Case { kind: Kind::Random, ray, spheres: spheres.collect(), known: None }
}
