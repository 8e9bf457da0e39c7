//! Is each number that the tracer states, and that no picture need show, the one it states? Margins may not be smaller than derived, which other
//! tests find out, and not larger either; ranges begin and end where they say; cells are as many as chosen; and counts count.

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Size, Sphere};
use optimized::bound::{NEAREST, Rule, TRUNCATING};
use optimized::camera::Block;
use optimized::certain::{Side, sides};
use optimized::crew::Crew;
use optimized::frame::tile_size;
use optimized::frustum::{Bundle, Frustum, Heading, Slices};
use optimized::grid::{Bounds, Grid, Memory, widen};
use optimized::host::Scalar;
use optimized::machine::LANES;
use optimized::margin::{in_range, reach, sphere_in_range};
use optimized::plan::{
    Arithmetic, Cells, Culling, Loop, Margins, OnEvent, Packet, Plan, Reason, Resolution, Sharing, Voxelizer,
};
use optimized::seen::{Counts, Seen, Worker};
use optimized::silhouette::Outline;
use optimized::stripe::{NO_COLUMN, Painter, Stripe};
use optimized::{Event, Events, Form, Known, Level, RenderError, Tracer, cull, double, frustum, tile};
use rand::{Rng, RngExt};
use std::collections::{BTreeSet, HashSet};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use verify::case::Case;
use verify::seed::{generator, seed};

/// A number between two powers of two, all of these alike.
fn power(rng: &mut impl Rng, from: f64, to: f64) -> f64 {
    2f64.powf(rng.random_range(from..to))
}

#[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
fn vector(rng: &mut impl Rng, size: f64) -> [f32; 3] {
    std::array::from_fn(|_| (size * rng.random_range(-1.0..1.0)) as f32)
}

fn length(v: [f64; 3]) -> f64 {
    v[0].hypot(v[1]).hypot(v[2])
}

/// What is stated must be reached, and not be passed by more than its own roundings in f32, so many units of 2⁻²⁴.
fn assert_stated(stated: f64, given: f32, units: f64, what: &dyn Fn() -> String) {
    let given = f64::from(given);
    let (least, most) = (stated * (1.0 - 1e-12), stated * (1.0 + units * NEAREST));
    assert!((least..=most).contains(&given), "{given:e}, not {stated:e}; {}", what());
}

/// Reach, culling radius and widening of spheres from far and near.
#[test]
fn margins_of_spheres_are_those_derived() {
    let seed = seed();
    let mut rng = generator(seed, 0);
    let u = NEAREST;
    for case in 0..20_000 {
        let size = power(&mut rng, -3.0, 12.0);
        let (f, r) = (vector(&mut rng, size), power(&mut rng, -2.0, 2.0) as f32);
        let (far, wide) = (length(f.map(f64::from)), f64::from(r));
        let what = || format!("case {case} of CGT_SEED={seed}: {f:?}, {r:e}");
        for (arithmetic, units) in [
            (Arithmetic::Rounded as fn(Form) -> Arithmetic, 64.0 * u),
            (Arithmetic::Spu as fn(Form) -> Arithmetic, 256.0 * u),
        ] {
            let given = |form| reach(Margins::Derived, arithmetic(form), f, r);
            assert_stated(wide + units * (far + wide), given(Form::Perpendicular), 4.0, &what);
            // R² = r² + 64u (F + r)², by the length of a vector.
            let textbook = wide.hypot(units.sqrt() * (far + wide));
            assert_stated(textbook, given(Form::Textbook), 4.0, &what);
            for form in [Form::Perpendicular, Form::Textbook] {
                assert_eq!(reach(Margins::None, arithmetic(form), f, r).to_bits(), r.to_bits());
            }
        }
        assert_eq!(reach(Margins::Derived, Arithmetic::Certified, f, r).to_bits(), r.to_bits());

        let sum: f64 = f.iter().map(|x| f64::from(x.abs())).sum();
        let unit = u as f32;
        let culled = wide + 16.0 * u * (sum + wide);
        assert_stated(culled, cull::radius(unit, Margins::Derived, f, r), 4.0, &what);
        assert_eq!(cull::radius(unit, Margins::None, f, r).to_bits(), r.to_bits());
        let lanes = cull::radii(Scalar, f.map(|x| [x.abs(); LANES]), [r; LANES]);
        assert_stated((wide + 32.0 * u * (sum + wide)) * (1.0 - 4.0 * u), lanes[0], 8.0, &what);
        assert_stated(wide * (1.0 + 16.0 * u) * (1.0 - u), widen(unit, r), 2.0, &what);
        let at = f64::from(f[0].abs());
        assert_stated(16.0 * u * (at + wide) * (1.0 - 2.0 * u), frustum::pad(unit, f[0], r), 4.0, &what);
        assert_stated(1.0 + 16.0 * u, frustum::beyond(unit), 0.0, &what);
    }
    eprintln!("CGT_SEED={seed}: 20000 spheres");
}

/// A camera with spans in any direction.
fn camera(rng: &mut impl Rng, size: f64) -> Option<Camera> {
    let pixels = Size::new(rng.random_range(1..50), rng.random_range(1..50)).expect("small");
    let (c, u, v) = (vector(rng, size), vector(rng, size / 20.0), vector(rng, size / 20.0));
    Camera::new([0.5; 3], c, u, v, pixels).ok()
}

fn dot(u: [f64; 3], v: [f64; 3]) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// What is left of v without its part along u.
fn across(v: [f64; 3], u: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| v[i] - dot(v, u) / dot(u, u) * u[i])
}

/// The longest direction that a camera may have, and the distance of its picture's plane from the eye, in units of pixels as given.
fn lengths(camera: &Camera) -> [f64; 2] {
    let [c, u, v] = [camera.corner(), camera.du(), camera.dv()].map(|v| v.map(f64::from));
    let [w, h] = [camera.size().width(), camera.size().height()].map(f64::from);
    let longest = length(c) + w * length(u) + h * length(v);
    [longest, length(across(across(c, u), across(v, u)))]
}

/// A camera is in range if its directions are from 2⁻²⁰ to 2²⁰ long, with 1 % to spare: just within at either end, and just beyond.
#[test]
fn cameras_are_in_range_where_it_says() {
    let seed = seed();
    let mut rng = generator(seed, 1);
    let (million, mut judged) = (2f64.powi(20), [0u64; 4]);
    let is_in = |camera: &Camera| in_range(Arithmetic::Certified, &[], camera);
    for case in 0..40_000 {
        let Some(plain) = camera(&mut rng, 1.0) else { continue };
        let [longest, shortest] = lengths(&plain);
        for (at, scale, within) in [
            (0, 0.999 * million / (1.01 * longest), true),
            (1, 1.001 * million / (1.01 * longest), false),
            (2, 1.001 / million / (0.99 * shortest - 1e-5 * longest), true),
            (3, 0.999 / million / (0.99 * shortest - 1e-5 * longest), false),
        ] {
            // What limits it must be that end alone, and no rounding of it.
            let spare = [0.98 * shortest * scale * million, million / (1.02 * longest * scale)][at / 2];
            if scale <= 0.0 || spare < 1.0 || shortest < 0.02 * longest {
                continue;
            }
            #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
            let scaled = |v: [f32; 3]| v.map(|x| (f64::from(x) * scale) as f32);
            let given = Camera::new(
                plain.eye(),
                scaled(plain.corner()),
                scaled(plain.du()),
                scaled(plain.dv()),
                plain.size(),
            );
            let Ok(given) = given else { continue };
            assert_eq!(is_in(&given), within, "{at}, case {case} of CGT_SEED={seed}: {given:?}");
            judged[at] += 1;
        }
    }
    eprintln!("CGT_SEED={seed}: {judged:?} cameras just within and just beyond");
    assert!(judged.iter().all(|n| *n > 5_000), "too few: {judged:?}");
}

/// Directions are rounded by a part of their length, so a picture's plane that is very near the eye for the length of its directions is out of
/// range sooner: by 10⁻⁵ of the longest.
#[test]
fn cameras_that_nearly_touch_their_picture_are_in_range_where_it_says() {
    let seed = seed();
    let mut rng = generator(seed, 18);
    let size = Size::new(16, 16).expect("small");
    for case in 0..2_000 {
        // Directions are about one long.
        let near = power(&mut rng, -15.6, -10.0);
        let (x, y) = (rng.random_range(0.2..0.6), rng.random_range(0.2..0.6));
        let turn = case % 3;
        for (off, within) in [(1.003, true), (0.997, false)] {
            let longest = 1.01 * (length([x, y, near]) + 2.0 * 16.0 * 0.01);
            let scale = off * 2f64.powi(-20) / (0.99 * near - 1e-5 * longest);
            #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
            let scaled =
                |v: [f64; 3]| -> [f32; 3] { std::array::from_fn(|i| (v[(i + turn) % 3] * scale) as f32) };
            let (corner, du, dv) =
                (scaled([-x, y, -near]), scaled([0.01, 0.0, 0.0]), scaled([0.0, -0.01, 0.0]));
            let camera = Camera::new([0.5; 3], corner, du, dv, size).expect("valid");
            let given = in_range(Arithmetic::Certified, &[], &camera);
            assert_eq!(given, within, "{near:e} of the longest, case {case} of CGT_SEED={seed}: {camera:?}");
        }
    }
}

/// Positions up to 2³⁰, radii from 2⁻³⁰ to 2³⁰, on the SPU from 2⁻¹⁴: at each end, and one step beyond.
#[test]
fn spheres_are_in_range_where_it_says() {
    let (farthest, least) = (2f32.powi(30), 2f32.powi(-30));
    let ball = |center, radius| Sphere { center, radius, color: [1; 3] };
    for radius in [least, 1.0, farthest] {
        assert!(sphere_in_range(&ball([0.0; 3], radius)));
    }
    for radius in [least.next_down(), farthest.next_up()] {
        assert!(!sphere_in_range(&ball([0.0; 3], radius)));
    }
    let size = Size::new(2, 2).expect("small");
    let eyes =
        |eye| Camera::new(eye, [-1.0, 1.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size).expect("valid");
    let near = ball([0.0; 3], 1.0);
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let at = |x: f32| std::array::from_fn(|i| if i == axis { sign * x } else { 0.0 });
            for (x, within) in [(farthest, true), (farthest.next_up(), false)] {
                assert_eq!(sphere_in_range(&ball(at(x), 1.0)), within);
                assert_eq!(in_range(Arithmetic::Certified, &[near], &eyes(at(x))), within);
                assert_eq!(
                    in_range(Arithmetic::Certified, &[near, ball(at(x), 1.0)], &eyes([0.0; 3])),
                    within
                );
            }
        }
    }
    let small = 2f32.powi(-14);
    for form in [Form::Textbook, Form::Perpendicular] {
        for (radius, on_spu) in [(small, true), (small.next_down(), false)] {
            let asked = |arithmetic| in_range(arithmetic, &[near, ball([0.0; 3], radius)], &eyes([0.0; 3]));
            assert_eq!(asked(Arithmetic::Spu(form)), on_spu);
            assert!(asked(Arithmetic::Rounded(form)));
        }
    }
}

/// The slack of a camera's directions, and with it what a tile grants, is 8u of the largest component that any sign of its parts could give.
#[test]
fn slack_is_that_of_the_largest_direction() {
    let seed = seed();
    let mut rng = generator(seed, 2);
    for case in 0..5_000 {
        let size = power(&mut rng, -10.0, 10.0);
        let Some(camera) = camera(&mut rng, size) else { continue };
        let [w, h] = [camera.size().width(), camera.size().height()].map(f64::from);
        let mut largest = 0f64;
        for signs in 0..8u32 {
            let sign = |part: u32| if signs >> part & 1 == 0 { 1.0 } else { -1.0 };
            for i in 0..3 {
                let [c, u, v] = [camera.corner(), camera.du(), camera.dv()].map(|v| f64::from(v[i]));
                largest = largest.max(sign(0) * c + sign(1) * w * u + sign(2) * h * v);
            }
        }
        let given = f64::from(tile::slack(NEAREST as f32, &camera)) / (8.0 * NEAREST);
        assert!(
            (given / largest - 1.0).abs() < 1e-6,
            "case {case} of CGT_SEED={seed}: {given:e}, not {largest:e}"
        );
    }
}

/// Thresholds and roots of the certified stage against the derivation before it was sorted by powers of r and m.
#[test]
fn bounds_are_those_derived() {
    let seed = seed();
    let mut rng = generator(seed, 3);
    // A slack of 2⁻¹⁰, and a few roundings.
    let slack = 1.2 / 1024.0 / NEAREST;
    for unit in [NEAREST, TRUNCATING, 1.0 / 4096.0, 1.0 / 16.0] {
        for case in 0..5_000 {
            let (r, m) = (power(&mut rng, -20.0, 20.0) as f32, power(&mut rng, -20.0, 20.0) as f32);
            let given = Rule::new(unit).bound(m, r);
            let what =
                || format!("unit {unit:e}, case {case} of CGT_SEED={seed}: r {r:e}, m {m:e}, {given:?}");
            let (r, m) = (f64::from(r), f64::from(m));
            let [hit_above, miss_below] = thresholds(unit, r, m);
            assert_stated(hit_above, given.hit_above, slack, &what);
            assert_stated(miss_below, -given.miss_below, slack, &what);
            assert_stated(root(unit, r, m), given.root, slack, &what);
        }
    }
    eprintln!("CGT_SEED={seed}: 20000 bounds");
}

/// What many of the derivation's steps share: γ_k, K, β and κ.
fn steps(u: f64) -> (impl Fn(i32) -> f64, f64, f64, f64) {
    let gamma = move |k: i32| (1.0 + u).powi(k) - 1.0;
    let k = (1.0 + u) * (u + (1.0 + u) * u / 2.0 + (1.0 + u) * u) + u * u;
    let beta = (gamma(2) + 2.0 * gamma(5)) / 3.0;
    (gamma, k, beta, (1.0 + beta) * (1.0 + u).powi(2) - 1.0)
}

/// Above which D is positive, and below minus which negative.
fn thresholds(u: f64, r: f64, m: f64) -> [f64; 2] {
    let (gamma, k, _, kappa) = steps(u);
    let p = (6.0 * k * k + 3.0 * u * u).sqrt() * m + 2.0 * gamma(3) * (k + u) * m;
    let of_e = 3f64.sqrt() * gamma(2) + 2f64.sqrt() * gamma(3) * (1.0 + gamma(2));
    let rho = 3f64.sqrt() * r;
    let x = p + of_e * rho;
    let missed = kappa * rho.powi(2) + gamma(3) * (rho + x).powi(2) + 2.0 * rho * x + x.powi(2);
    let hit = (kappa + gamma(3)) * rho.powi(2) + 2.0 * rho * x;
    [hit, missed].map(|of| of + u * (rho.powi(2) + missed))
}

/// What the ends of a root's interval are off by.
fn root(u: f64, r: f64, m: f64) -> f64 {
    let (gamma, k, beta, _) = steps(u);
    let eta = (1.0 + u) / (1.0 - beta) - 1.0;
    let tau = (1.0 + eta) * (1.0 + u);
    let across = 0.5f64.sqrt() * (1.0 + gamma(3)) * (k + u) * m
        + (2f64 / 3.0).sqrt() * (gamma(2) + gamma(3) * (1.0 + gamma(2))) * r;
    let offset = tau * across + (tau - 1.0) * r;
    let foot = offset + u * m + u * (r + m + u * m + offset);
    // Both thresholds are a r² + b r m + c m², whose root is at most √a r + √b (r + m) / 2 + √c m.
    let both = |r, m| thresholds(u, r, m).iter().sum::<f64>();
    let (a, c) = (both(1.0, 0.0), both(0.0, 1.0));
    let b = both(1.0, 1.0) - a - c;
    let widest = r + a.sqrt() * r + b.sqrt() * (r + m) / 2.0 + c.sqrt() * m;
    assert!(widest >= r + both(r, m).sqrt() * (1.0 - 1e-9));
    let half = ((1.0 + eta) * (1.0 + u).powi(3) - 1.0) * widest;
    let ends = 2.0 * u * (1.0 + u) * (r + m + widest + foot + half);
    (foot + half + ends) * (1.0 + u) / (1.0 - u)
}

/// Outlines are the slopes of the tangents, and 256u (1 + |slope|) wider at either end.
#[test]
fn outlines_are_widened_as_derived() {
    let seed = seed();
    let mut rng = generator(seed, 19);
    for case in 0..20_000 {
        let scale = power(&mut rng, -15.0, 15.0);
        let (far, wide) = (power(&mut rng, 1.1, 12.0), rng.random_range(-1.5..1.5));
        #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
        let [a, y, r] = [far * scale, wide * far * scale, scale].map(|x| x as f32);
        let outline = Outline::new(Scalar, [a, y, y].map(|x| [x; LANES]), [r; LANES]);
        let [a, y, r] = [a, y, r].map(f64::from);
        let square = (a - r) * (a + r);
        for side in 0..2 {
            for (sign, given) in [(-1.0, outline.lo[side][0]), (1.0, outline.hi[side][0])] {
                let slope = (a * y + sign * r * (square + y * y).sqrt()) / square;
                let wider = (f64::from(given) - slope) * sign / (1.0 + slope.abs()) / NEAREST;
                // Its own roundings are less than a fifth of that.
                assert!(
                    (208.0..304.0).contains(&wider),
                    "wider by {wider}u; A {a:e}, Y {y:e}, R {r:e}, case {case} of CGT_SEED={seed}"
                );
            }
        }
    }
}

/// Tiles know the eye's side from 16u of both squares on: 32u of one, where they are nearly the same, at every scale.
#[test]
fn the_side_is_known_from_where_it_says() {
    let u = NEAREST as f32;
    for exponent in -60..=60 {
        let one = 2f32.powi(exponent);
        for (ff, side) in [
            (1.0 + 34.0 * u, Side::Outside),
            (1.0 + 32.0 * u, Side::Unknown),
            (1.0, Side::Unknown),
            (1.0 - 32.0 * u, Side::Unknown),
            (1.0 - 33.0 * u, Side::Inside),
        ] {
            let [outside, inside] = sides(Scalar, [ff * one; LANES], [one; LANES]);
            let wanted = (side == Side::Outside, side == Side::Inside);
            assert_eq!((outside[0], inside[0]), wanted, "{ff:e} times the radius' square, {one:e}");
        }
    }
}

/// Of each sphere the certified stage has the bound of its distance from the eye, wherever the two are, and the eye's side at every scale: on the
/// surface neither, and one step of the radius away from it the one it is on.
#[test]
fn spheres_have_their_bound_and_side() {
    let seed = seed();
    let mut rng = generator(seed, 11);
    let plan = Plan { arithmetic: Arithmetic::Certified, ..Plan::safe() };
    let slack = 1.2 / 1024.0 / NEAREST;
    for case in 0..2_000 {
        let (eye, center) = (vector(&mut rng, 8.0), vector(&mut rng, 8.0));
        let radius = power(&mut rng, -6.0, 6.0) as f32;
        let seen = Seen::without_grid(Scalar, plan, &[Sphere { center, radius, color: [1; 3] }], eye);
        let (given, _) = seen.bounds[0];
        let m = (0..3).map(|i| (f64::from(eye[i]) - f64::from(center[i])).abs()).fold(0.0, f64::max);
        let what =
            || format!("case {case} of CGT_SEED={seed}: eye {eye:?}, {center:?}, {radius:e}, {given:?}");
        let [hit_above, miss_below] = thresholds(NEAREST, f64::from(radius), m);
        assert_stated(hit_above, given.hit_above, slack, &what);
        assert_stated(miss_below, -given.miss_below, slack, &what);
        assert_stated(root(NEAREST, f64::from(radius), m), given.root, slack, &what);
    }
    for exponent in -28..=28 {
        let scale = 2f32.powi(exponent);
        let (eye, center) = ([scale; 3], [4.0 * scale, 5.0 * scale, scale]);
        for (radius, side) in [
            (4.0, Side::Outside),
            (5f32.next_down(), Side::Outside),
            (5.0, Side::Unknown),
            (5f32.next_up(), Side::Inside),
            (6.0, Side::Inside),
        ] {
            let ball = Sphere { center, radius: radius * scale, color: [1; 3] };
            let seen = Seen::without_grid(Scalar, plan, &[ball], eye);
            assert_eq!(seen.bounds[0].1, side, "{ball:?} from {eye:?}");
        }
    }
    // Of two squares of 2⁴⁶ the slack is an eighth.
    let radius = 8_388_609.0;
    for (off, side) in [(0.25, Side::Unknown), (0.75, Side::Outside)] {
        let ball = Sphere { center: [radius, off, 0.0], radius, color: [1; 3] };
        let seen = Seen::without_grid(Scalar, plan, &[ball], [0.0; 3]);
        assert_eq!(seen.bounds[0].1, side, "{ball:?}");
    }
}

/// The error of t that f64 says is the one derived, on whole numbers for which its steps but for roots and quotients are exact, and is the same
/// at every scale: a bound that is not of its quantity's dimension is too small at one end and decides nothing at the other.
#[test]
fn errors_of_roots_are_those_derived() {
    let seed = seed();
    let mut rng = generator(seed, 12);
    let mut judged = [0u64; 5];
    for case in 0..40_000 {
        let mut whole = |most: i32| [0; 3].map(|_| rng.random_range(-most..=most));
        let dir = whole(100);
        // Every fourth ball lies ahead, or behind, in the very line of the ray, and up to 2⁴⁸ radii away; some are level with the eye.
        let (eye, f, far) = if case % 4 == 0 {
            ([0; 3], dir, rng.random_range(0..=40))
        } else if case % 16 == 13 {
            (whole(1000), [-5 * dir[1], 5 * dir[0], 0], 0)
        } else {
            (whole(1000), whole(1000), 0)
        };
        let [f, d] = [f.map(|x| f64::from(x) * 2f64.powi(far)), dir.map(f64::from)];
        if dot(d, d) == 0.0 {
            continue;
        }
        let w = [f[1] * d[2] - f[2] * d[1], f[2] * d[0] - f[0] * d[2], f[0] * d[1] - f[1] * d[0]];
        // Some in their middle, some at their rim, and some around the eye.
        let rim = (dot(w, w) / dot(d, d)).sqrt().ceil();
        let r = [rim + 1.0, rim.max(1.0), rim + f64::from(rng.random_range(1..50)), length(f).ceil() + 1.0];
        let r = if far > 0 { f64::from(rng.random_range(1..100)) } else { r[case / 4 % 4] };
        let sign = if case % 8 < 4 { 1.0 } else { -1.0 };
        let stated = Stated::of(f.map(|x| sign * x), d, r);
        for [near, along] in [[0, 0], [-60, 0], [40, 0], [0, -50], [0, 60], [-30, 30]] {
            let [near, along] = [near, along].map(|exponent| 2f64.powi(exponent));
            let scaled = |v: [f64; 3], scale: f64| v.map(|x| (x * scale) as f32);
            let eye = eye.map(f64::from);
            let center = [0, 1, 2].map(|i| eye[i] - sign * f[i]);
            let given = double::root::<f64>(
                scaled(eye, near),
                scaled(d, along),
                scaled(center, near),
                (r * near) as f32,
            );
            let what = || {
                format!(
                    "case {case} of CGT_SEED={seed}, scales {near:e} and {along:e}: f {f:?}, d {d:?}, r {r}: \
                     {given:?}, {stated:?}"
                )
            };
            assert_eq!((given.miss, given.hit), (stated.miss, stated.hit), "{}", what());
            judged[0] += u64::from(given.miss);
            if given.hit {
                let t = given.t * along / near;
                assert!((t / stated.t - 1.0).abs() < 1e-12, "t; {}", what());
                assert!((given.error / stated.error - 1.0).abs() < 1e-9, "error; {}", what());
                judged[1 + usize::from(stated.inside)] += 1;
                judged[3] += u64::from(stated.at_rim);
                judged[4] += u64::from(far > 30);
            }
        }
    }
    eprintln!("CGT_SEED={seed}: misses, hits from outside, from inside, at the rim, from afar: {judged:?}");
    assert!(judged.iter().all(|n| *n > 2_000), "too few: {judged:?}");
}

/// What the derivation of [`double`] says of a ray and a ball.
#[derive(Debug)]
struct Stated {
    miss: bool,
    hit: bool,
    t: f64,
    error: f64,
    inside: bool,
    /// Most of the error is the discriminant's.
    at_rim: bool,
}

impl Stated {
    /// f is eye − centre.
    fn of(f: [f64; 3], d: [f64; 3], r: f64) -> Self {
        let (v, more) = (2f64.powi(-53), 1.01);
        let w = [f[1] * d[2] - f[2] * d[1], f[2] * d[0] - f[0] * d[2], f[0] * d[1] - f[1] * d[0]];
        let (ff, a, b, ww) = (dot(f, f), dot(d, d), dot(f, d), dot(w, w));
        let (of_d, q) = (a * r * r - ww, ff - r * r);
        // |D̂ − D| by steps 4 to 6, |b̂ − b| by 8, |q̂ − q| by 7.
        let slack = more * v * (7.0 * (a * ff * ww).sqrt() + 5.0 * (a * r * r + ww)) + 14.0 * v * v * a * ff;
        let b_slack = 4.0 * more * v * (a * ff).sqrt();
        let q_slack = more * v * (6.0 * ff + r * r);
        let (outside, inside) = (q > q_slack, q < -q_slack);
        let miss = of_d < -slack || (outside && b > b_slack);
        let s = of_d.max(0.0).sqrt();
        let sum = b.abs() + s;
        // Seen from inside and coming nearer to the centre: the far root as a sum.
        let (t, own) =
            if inside && b < 0.0 { (sum / a, 3.0 * v) } else { (q.abs() / sum, q_slack / q.abs()) };
        let of_discriminant = slack / s / sum;
        let error = more * (own + 2.0 * b_slack / sum + of_discriminant + v * s / sum + 4.0 * v);
        let hit = of_d > 2.0 * slack && (inside || (outside && b < -b_slack)) && error < 0.5;
        Self { miss, hit, t, error, inside, at_rim: of_discriminant > error / 2.0 }
    }
}

/// The short way's error is v g (16 + 1280 |f|₁/r) and 2 % at most, with 1 % for its roundings; it is gone by rays that come from outside and
/// not at the rim, at every scale, and whoever may not go it has two ends that differ.
#[test]
fn the_short_way_is_gone_where_it_says() {
    let seed = seed();
    let mut rng = generator(seed, 13);
    let (v, kappa) = (2f64.powi(-53), 2f64.powi(-12));
    let (mut gone, mut barred, mut rims, mut equal) = (0u64, 0u64, 0u64, 0u64);
    for case in 0..4_000 {
        let scale = power(&mut rng, -20.0, 20.0);
        let (eye, center) = ([0f32; 3], vector(&mut rng, scale));
        let f = center.map(|x| -f64::from(x));
        let radius = (length(f) * power(&mut rng, -7.0, 0.2)) as f32;
        let (r, ff) = (f64::from(radius), dot(f, f));
        let magnitude = f.map(|x| [x.abs() as f32; LANES]);
        let error = double::short_error::<f64, _>(Scalar, magnitude, [radius; LANES]);
        let sum: f64 = f.iter().map(|x| x.abs()).sum();
        let stated = v * ff / (ff - r * r) * (16.0 + 1280.0 * sum / r);
        let what = || format!("case {case} of CGT_SEED={seed}: {center:?}, {radius:e}");
        if (ff / (2.0 * r * r) - 1.0).abs() < 1e-5 {
            continue;
        }
        let apart = ff > 2.0 * r * r;
        if apart {
            assert!(stated < 2f64.powi(-27), "near the limit; {}", what());
            let given = f64::from(error[0]);
            assert!((stated..stated * 1.03).contains(&given), "{given:e}, not {stated:e}; {}", what());
        } else {
            assert_eq!(error[0], f32::INFINITY, "{}", what());
        }
        // Towards the ball or away from it, through it or past its rim, by the impact in radii.
        let along = power(&mut rng, -20.0, 20.0);
        let lanes: [[f64; 3]; LANES] = std::array::from_fn(|lane| {
            let side = across(vector(&mut rng, 1.0).map(f64::from), f);
            let impact = match lane % 4 {
                0 | 1 => rng.random_range(0.0..0.99),
                2 => (1.0 - kappa * rng.random_range(0.0f64..2.0)).sqrt(),
                _ => rng.random_range(0.99..1.5),
            };
            // A line from the eye at that distance from the centre.
            let sine = (impact * r / length(f)).min(0.999);
            let tangent = sine / (1.0 - sine * sine).sqrt() * length(f) / length(side);
            let sign = if lane % 5 == 0 { -along } else { along };
            [0, 1, 2].map(|i| sign * (tangent * side[i] - f[i]) / length(f))
        });
        let dir: [[f32; LANES]; 3] = std::array::from_fn(|i| lanes.map(|d| d[i] as f32));
        let [lo, hi] =
            double::short_ends::<f64>(eye, &dir, &center.map(|x| [x; LANES]), &[radius; LANES], &error);
        for lane in 0..LANES {
            let d = dir.map(|d| f64::from(d[lane]));
            let (a, b, q) = (dot(d, d), dot(f, d), ff - r * r);
            let x = (b * b - a * q) / (a * r * r * kappa);
            if (x - 1.0).abs() < 0.01 {
                continue;
            }
            let [lo, hi] = [lo[lane], hi[lane]];
            let what = || format!("{lo:e}, {hi:e}, {x} of the rim's measure, {d:?}; {}", what());
            if apart && x > 1.0 && b < 0.0 {
                let t = q / ((b * b - a * q).sqrt() - b);
                let off = |end: f32| (f64::from(end) / t - 1.0).abs();
                assert!(lo <= hi && off(lo) < 2e-7 && off(hi) < 2e-7, "not {t:e}; {}", what());
                gone += 1;
                equal += u64::from(lo == hi);
            } else {
                assert!(lo != hi, "{}", what());
                barred += 1;
                rims += u64::from(apart && b < 0.0 && x > 0.0);
            }
        }
    }
    eprintln!(
        "CGT_SEED={seed}: {gone} rays go the short way, {equal} to the end; {barred} do not, {rims} for the rim"
    );
    assert!(equal > gone * 99 / 100 && gone > 10_000 && barred > 10_000 && rims > 1_000, "too few");
}

/// The short way ends at an error of 2⁻²⁶: to balls that are farther away than some 100,000 radii it is not gone.
#[test]
fn the_short_way_ends_at_its_limit() {
    let seed = seed();
    let mut rng = generator(seed, 14);
    let drawn: Vec<f64> = (0..2_000).map(|_| power(&mut rng, 10.0, 24.0)).collect();
    let mut judged = [0u64; 2];
    for radii in drawn.into_iter().chain([100_000.0, 105_000.0]) {
        // On an axis |f|₁ is the distance.
        let radius = power(&mut rng, -15.0, 10.0) as f32;
        let magnitude = [[0.0; LANES], [(radii * f64::from(radius)) as f32; LANES], [0.0; LANES]];
        let error = double::short_error::<f64, _>(Scalar, magnitude, [radius; LANES])[0];
        let what = format!("CGT_SEED={seed}: {radii} radii of {radius:e} away: {error:e}");
        // v (16 + 1280 F/r), 2 % more or none, against 2⁻²⁶.
        if radii <= 100_000.0 {
            judged[0] += 1;
            assert!(error < 2f32.powi(-26), "{what}");
        } else if radii >= 105_000.0 {
            judged[1] += 1;
            assert_eq!(error, f32::INFINITY, "{what}");
        }
    }
    assert!(judged.iter().all(|n| *n > 300), "{judged:?}");
}

fn scattered(rng: &mut impl Rng, count: usize, extent: [f32; 3]) -> Vec<Sphere> {
    let mut ball = || Sphere {
        center: extent.map(|e| if e > 0.0 { rng.random_range(-e..e) + 3.0 } else { 3.0 }),
        #[allow(clippy::cast_possible_truncation, reason = "any f32 will do")]
        radius: power(rng, -8.0, 1.0) as f32,
        color: [1; 3],
    };
    (0..count).map(|_| ball()).collect()
}

/// Cells on an axis that a box of that extent should have: cubes, about so many in all, from 1 to the limit.
fn assert_cubes(n: [i32; 3], extent: [f64; 3], wanted: f64, limit: i32, what: &dyn Fn() -> String) {
    let volume: f64 = extent.iter().filter(|e| **e > 0.0).product();
    let side = (volume / wanted).cbrt();
    for (n, e) in n.into_iter().zip(extent) {
        let cubes = (e / side).clamp(1.0, limit.into());
        assert!((f64::from(n) - cubes).abs() < 0.501, "{n} cells, not {cubes}; {}", what());
    }
}

/// A grid for tiles is over the box of the centres, with 1/32 cell a sphere; large are those from the least power of two that one in 64 and
/// 32 more reach at most; and packets look as far around as the largest of the others.
#[test]
fn grids_for_tiles_are_as_stated() {
    let seed = seed();
    let mut rng = generator(seed, 4);
    let (mut memory, mut all_alike, mut with_large) = (Memory::default(), 0, 0);
    for case in 0..300 {
        let extent =
            [power(&mut rng, -3.0, 5.0) as f32, power(&mut rng, -3.0, 5.0) as f32, [0.0, 7.0][case % 2]];
        let count = rng.random_range(1..4_000);
        let mut spheres = scattered(&mut rng, count, extent);
        if case % 5 == 0 {
            // All of one power of two, but for a few.
            spheres.iter_mut().for_each(|sphere| sphere.radius = 0.25);
            spheres.iter_mut().take(case % 4).for_each(|sphere| sphere.radius = 3.0);
        } else {
            // Now fewer than make spheres large, now more.
            let some = count / 128 * (case % 3) + 16;
            spheres.iter_mut().take(some).for_each(|sphere| sphere.radius *= 8.0);
        }
        let what = || format!("case {case} of CGT_SEED={seed}: {count} spheres in {extent:?}");
        let crew = Crew::new(1 + case % 2).expect("threads");
        let grid = Grid::by_center(Scalar, &Plan::fast(), &spheres, &mut memory, &crew).expect("in range");

        let end = |i: usize, pick: fn(f32, f32) -> f32| {
            spheres.iter().map(|s| s.center[i]).reduce(pick).expect("at least one")
        };
        let [lo, hi] =
            [f32::min as fn(f32, f32) -> f32, f32::max].map(|pick| [0, 1, 2].map(|i| end(i, pick)));
        for i in 0..3 {
            let planes = &grid.axes[i].planes;
            assert_eq!((planes[0], planes.last().copied()), (lo[i], Some(hi[i])), "axis {i}; {}", what());
        }
        let extent = [0, 1, 2].map(|i| f64::from(hi[i]) - f64::from(lo[i]));
        let n = [0, 1, 2].map(|i| grid.axes[i].n);
        assert_cubes(n, extent, count as f64 / 32.0, 240, &what);

        // From which power of two on are there few enough?
        let from = (-40..40)
            .map(|power| 2f32.powi(power))
            .find(|from| spheres.iter().filter(|sphere| sphere.radius >= *from).count() <= count / 64 + 32);
        let from = from.expect("none is that large");
        let is_large = |sphere: &Sphere| sphere.radius >= from && count > count / 64 + 32;
        let large: Vec<u32> = (0..).zip(&spheres).filter(|(_, s)| is_large(s)).map(|(id, _)| id).collect();
        assert_eq!(grid.large, large, "{}", what());
        let rest = spheres.iter().filter(|s| !is_large(s)).map(|s| s.radius).fold(0.0, f32::max);
        assert_eq!(grid.widen.to_bits(), widen(NEAREST as f32, rest).to_bits(), "{}", what());
        all_alike += u32::from(large.is_empty());
        with_large += u32::from(!large.is_empty());
        memory.take(Some(grid));
    }
    eprintln!("CGT_SEED={seed}: {with_large} grids with large spheres, {all_alike} without");
    assert!(with_large > 100 && all_alike > 10, "too little was at stake");
}

/// A sphere whose radius is the very power of two from which on spheres are large is large.
#[test]
fn the_least_large_radius_is_large() {
    let at = |i: u16| [i % 17, i % 19, i / 323].map(f32::from);
    let ball =
        |i| Sphere { center: at(i), radius: if i % 126 == 5 { 0.015_625 } else { 0.01 }, color: [1; 3] };
    let spheres: Vec<Sphere> = (0..5_040).map(ball).collect();
    let large: Vec<u32> = (0..5_040).filter(|id| id % 126 == 5).collect();
    for workers in [1, 2] {
        let crew = Crew::new(workers).expect("threads");
        let grid = Grid::by_center(Scalar, &Plan::fast(), &spheres, &mut Memory::default(), &crew);
        let grid = grid.expect("in range");
        assert_eq!(grid.large, large);
        assert_eq!(grid.widen.to_bits(), widen(NEAREST as f32, 0.01).to_bits());
    }
}

/// A grid for blocks is over the boxes of all spheres, or their centres, with four cells a sphere; for eight corners these are wider than any box.
#[test]
fn grids_for_blocks_are_as_stated() {
    let seed = seed();
    let mut rng = generator(seed, 5);
    let mut limited = 0;
    for case in 0..300 {
        let extent =
            [power(&mut rng, -3.0, 5.0) as f32, power(&mut rng, -3.0, 5.0) as f32, [0.0, 7.0][case % 2]];
        let count = rng.random_range(1..500);
        let balls: Vec<Bounds> = scattered(&mut rng, count, extent)
            .iter()
            .map(|sphere| Bounds::outward(sphere.center, sphere.radius))
            .collect();
        let what = || format!("case {case} of CGT_SEED={seed}: {count} spheres in {extent:?}");
        for voxelizer in [Voxelizer::BoxRange, Voxelizer::ByCenter, Voxelizer::EightCorners] {
            let plan = Plan { voxelizer, resolution: Resolution::UpTo(40), ..Plan::safe() };
            let mut events = Events::default();
            let grid = Grid::build(Scalar, &plan, &balls, &mut events).expect("falls back");
            let by_center = voxelizer == Voxelizer::ByCenter;
            let [lo, hi] = [0, 1].map(|end| {
                [0, 1, 2].map(|i| {
                    let all = balls.iter().map(|ball| [ball.lo, ball.hi][end][i]);
                    let centers = balls.iter().map(|ball| ball.center[i]);
                    let pick = [f32::min as fn(f32, f32) -> f32, f32::max][end];
                    if by_center { centers.reduce(pick) } else { all.reduce(pick) }.expect("at least one")
                })
            });
            let extent = [0, 1, 2].map(|i| f64::from(hi[i]) - f64::from(lo[i]));
            let n = [0, 1, 2].map(|i| grid.axes[i].n);
            let widest =
                balls.iter().map(|ball| f64::from(ball.hi[0]) - f64::from(ball.lo[0])).fold(0.0, f64::max);
            if voxelizer == Voxelizer::EightCorners {
                assert_eq!(events.count(), 0, "a box spans three cells; {}", what());
                // Not for want of cells: one more on an axis would be too narrow, or more than are wanted.
                for i in 0..3 {
                    let more = extent[i] / f64::from(n[i] + 1);
                    let volume: f64 = extent.iter().product();
                    let cubes = (volume / (4.0 * count as f64)).cbrt();
                    assert!(
                        n[i] == 40 || more < 1.01 * widest || more < cubes * 1.01,
                        "axis {i}; {}",
                        what()
                    );
                    limited += u32::from(more < 1.01 * widest);
                }
            } else {
                assert_cubes(n, extent, 4.0 * count as f64, 40, &what);
            }
            let largest = balls.iter().map(|ball| ball.radius).fold(0.0, f32::max);
            let stated = if by_center { widen(NEAREST as f32, largest) } else { 0.0 };
            assert_eq!(grid.widen.to_bits(), stated.to_bits(), "{}", what());
        }
    }
    assert!(limited > 100, "hardly a box limits cells");
}

/// By overlap a sphere is listed in the cells that its ball meets, and in no other of its box: by the distance of each cell from its centre,
/// found another way, and left open where it is the radius to a millionth.
#[test]
fn cells_by_overlap_are_those_that_are_met() {
    let seed = seed();
    let mut rng = generator(seed, 7);
    let (mut listed, mut spared) = (0u64, 0u64);
    for case in 0..12 {
        let spheres = scattered(&mut rng, 40, [4.0, 3.0, 2.0]);
        let balls: Vec<Bounds> = spheres.iter().map(|s| Bounds::outward(s.center, s.radius)).collect();
        let plan = Plan { voxelizer: Voxelizer::Overlap, resolution: Resolution::Fixed(11), ..Plan::safe() };
        let grid = Grid::build(Scalar, &plan, &balls, &mut Events::default()).expect("nothing to refuse");
        for index in 0..11 * 11 * 11 {
            let cell = [index / 121, index / 11 % 11, index % 11];
            let mut ids = Vec::new();
            grid.for_each_id(index, true, |id| ids.push(id));
            for (id, ball) in (0..).zip(&balls) {
                let off = [0, 1, 2].map(|i| {
                    let [lo, hi] =
                        [grid.axes[i].planes[cell[i]], grid.axes[i].planes[cell[i] + 1]].map(f64::from);
                    let center = f64::from(ball.center[i]);
                    center - center.clamp(lo, hi)
                });
                let (distance, radius) = (length(off), f64::from(ball.radius));
                if (distance / radius - 1.0).abs() < 1e-6 {
                    continue;
                }
                let what = || format!("cell {cell:?}, sphere {id}, case {case} of CGT_SEED={seed}");
                assert_eq!(ids.contains(&id), distance < radius, "{}", what());
                *(if distance < radius { &mut listed } else { &mut spared }) += 1;
            }
        }
    }
    eprintln!("CGT_SEED={seed}: {listed} entries, {spared} cells without");
    assert!(listed > 5_000 && spared > 5_000);
}

/// Balls and cells in whole numbers, many of which just touch: by overlap a ball is listed where the distance is its radius, and not beyond.
#[test]
fn cells_that_are_touched_list_the_ball() {
    let ball = |center: f32, radius: f32| Bounds {
        lo: [center - radius; 3],
        hi: [center + radius; 3],
        center: [center; 3],
        radius,
    };
    let (balls, mut touched) = ([ball(8.0, 8.0), ball(8.0, 5.0), ball(7.0, 3.0)], 0);
    let plan = Plan { voxelizer: Voxelizer::Overlap, resolution: Resolution::Fixed(16), ..Plan::safe() };
    let grid = Grid::build(Scalar, &plan, &balls, &mut Events::default()).expect("nothing to refuse");
    let whole: Vec<f32> = (0..=16u8).map(f32::from).collect();
    assert!(grid.axes.iter().all(|axis| axis.planes == whole), "{:?}", grid.axes);
    for (index, id) in (0..16 * 16 * 16).flat_map(|index| [(index, 1), (index, 2)]) {
        let [center, radius] = [[8, 5], [7, 3]][id as usize - 1];
        let off = |at: i32| (at - center).max(center - (at + 1)).max(0);
        let cell = [index / 256, index / 16 % 16, index % 16];
        // A point on a plane belongs to the cell above.
        if !cell.iter().all(|at| (center - radius..=center + radius).contains(at)) {
            continue;
        }
        let square: i32 = cell.iter().map(|at| off(*at).pow(2)).sum();
        let mut ids = BTreeSet::new();
        grid.for_each_id(index.unsigned_abs() as usize, true, |id| {
            ids.insert(id);
        });
        assert_eq!(ids.contains(&id), square <= radius * radius, "cell {cell:?}, ball {id}, {square}");
        touched += u32::from(square == radius * radius);
    }
    assert!(touched > 50, "only {touched} cells are just touched");
}

/// Cells are queues or lists as the plan has it, and hold something for those who are alive alone.
#[test]
fn cells_are_empty_for_who_is_not_alive() {
    let seed = seed();
    let spheres = scattered(&mut generator(seed, 14), 15, [4.0; 3]);
    let balls: Vec<Bounds> = spheres.iter().map(|s| Bounds::outward(s.center, s.radius)).collect();
    for (cells, queues) in [(Cells::Queue, true), (Cells::Lists, false)] {
        let plan = Plan { cells, resolution: Resolution::Fixed(5), ..Plan::safe() };
        let grid = Grid::build(Scalar, &plan, &balls, &mut Events::default()).expect("they have room");
        assert_eq!(grid.has_queues(), queues, "{plan}");
        let listed = |live: bool| {
            let mut ids = 0;
            (0..125).for_each(|cell| grid.for_each_id(cell, live, |_| ids += 1));
            ids
        };
        let [alive, not] = [listed(true), listed(false)];
        assert!(alive >= 15 && not == 0, "CGT_SEED={seed}: {alive} ids, else {not}; {plan}");
    }
}

/// A grid has from 1 to 240 cells on an axis; what else is asked for is refused with its number, by blocks and by tiles.
#[test]
fn resolutions_are_refused_beyond_their_limits() {
    let balls = [-1.0, 0.0, 2.0].map(|x| Sphere { center: [x; 3], radius: 0.25, color: [1; 3] });
    let scene = Scene::new(balls.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(8, 8).expect("small");
    let camera = Camera::new([0.0; 3], [0.5; 3], [0.1, 0.0, -0.1], [0.0, 0.1, -0.1], size).expect("valid");
    for plan in [Plan::safe(), Plan::fast()] {
        let render = |resolution| {
            let tracer = Tracer::new(Plan { resolution, ..plan }, Level::SCALAR);
            tracer.render(&scene, &camera).map(|_| ())
        };
        for cells in [0, 241, 255] {
            for resolution in [Resolution::Fixed(cells), Resolution::UpTo(cells)] {
                assert_eq!(render(resolution), Err(RenderError::Resolution { cells }), "{resolution:?}");
            }
        }
        for resolution in [Resolution::Fixed(1), Resolution::UpTo(1), Resolution::UpTo(240)] {
            assert_eq!(render(resolution), Ok(()), "{resolution:?}");
        }
    }
}

/// So it is where there will be no grid: of an empty scene, and of one that is out of range.
#[test]
fn resolutions_are_refused_whatever_the_scene() {
    let size = Size::new(8, 8).expect("small");
    let camera = Camera::new([0.0; 3], [0.5; 3], [0.1, 0.0, -0.1], [0.0, 0.1, -0.1], size).expect("valid");
    let tiny = Sphere { center: [9.0; 3], radius: 1e-20, color: [1; 3] };
    for spheres in [vec![], vec![tiny]] {
        let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
        for plan in [Plan::safe(), Plan::fast(), Plan { on_event: OnEvent::Refuse, ..Plan::fast() }] {
            for cells in [0, 241, 255] {
                for resolution in [Resolution::Fixed(cells), Resolution::UpTo(cells)] {
                    let plan = Plan { resolution, ..plan };
                    let refused = Tracer::new(plan, Level::SCALAR).render(&scene, &camera).map(|_| ());
                    assert_eq!(refused, Err(RenderError::Resolution { cells }), "{plan}, {scene:?}");
                }
            }
        }
    }
}

/// The cells of a slice reach as far as the packet's slopes and the pad of the farthest slice, also where neither the eye's place nor a
/// widening adds to it.
#[test]
fn slices_are_padded_for_the_farthest() {
    let ball = Bounds { lo: [0.0; 3], hi: [16.0; 3], center: [8.0; 3], radius: 8.0 };
    let plan = Plan { resolution: Resolution::Fixed(16), ..Plan::safe() };
    let grid = Grid::build(Scalar, &plan, &[ball], &mut Events::default()).expect("nothing to refuse");
    let u = NEAREST as f32;
    for axis in 0..3 {
        // The pad is 16u of 16: rays nearer than that to the next cell come there, others do not.
        for (below, more) in [(1.0, 1), (8.0, 1), (4096.0, 0)] {
            let slope = [[1.0 - below * u; LANES]; 2];
            let frustum = Frustum { heading: Heading::new(axis, true), slopes: [slope; 2] };
            for (margins, more) in [(Margins::Derived, more), (Margins::None, 0)] {
                let slices = frustum.slices(Scalar, [0.0; 3], &grid, margins);
                for s in 0..16u8 {
                    let last = [0, 1].map(|side| slices.last[side][usize::from(s)]);
                    let wanted = (i32::from(s) + more).min(15);
                    assert_eq!(last, [wanted; 2], "slice {s} on axis {axis}, {below}u below 1, {margins:?}");
                }
            }
        }
    }
}

/// The eye's place on the axis across counts for the pad as the farthest slice does, and its place along the rays does not stand for it: far
/// from zero that is where sums are rounded.
#[test]
fn slices_are_padded_for_the_eye() {
    let u = NEAREST as f32;
    let plan = Plan { resolution: Resolution::Fixed(16), ..Plan::safe() };
    for axis in 0..3 {
        let from = |along: f32| std::array::from_fn(|i| if i == axis { along } else { 4096.0 });
        let [lo, hi, center] = [0.0, 16.0, 8.0].map(|x| from(0.0).map(|at: f32| at + x));
        let grid =
            Grid::build(Scalar, &plan, &[Bounds { lo, hi, center, radius: 8.0 }], &mut Events::default());
        let grid = grid.expect("nothing to refuse");
        // The pad is 16u of 4112, and the last place of 4096 is 8192u: a slope's end that is less than that below the next cell comes there.
        for (below, more) in [(4096.0, 1), (262_144.0, 0)] {
            let slope = [[1.0 - below * u; LANES]; 2];
            let frustum = Frustum { heading: Heading::new(axis, true), slopes: [slope; 2] };
            for (margins, more) in [(Margins::Derived, more), (Margins::None, 0)] {
                let slices = frustum.slices(Scalar, from(0.0), &grid, margins);
                for s in 1..15u8 {
                    let last = [0, 1].map(|side| slices.last[side][usize::from(s)]);
                    let wanted = i32::from(s) + more;
                    assert_eq!(last, [wanted; 2], "slice {s} on axis {axis}, {below}u below 1, {margins:?}");
                }
            }
        }
    }
}

/// The widening of a grid by centres counts for the pad as the farthest slice does.
#[test]
fn slices_are_padded_for_the_widening() {
    let ball = |at: f32| Bounds { lo: [at - 4.0; 3], hi: [at + 4.0; 3], center: [at; 3], radius: 4.0 };
    let plan = Plan { voxelizer: Voxelizer::ByCenter, resolution: Resolution::Fixed(16), ..Plan::safe() };
    let grid = Grid::build(Scalar, &plan, &[ball(0.0), ball(16.0)], &mut Events::default());
    let grid = grid.expect("nothing to refuse");
    let u = NEAREST as f32;
    // Slice s ends at s + 1 and is widened by 4 + 64u; what is seen there ends 4 + 64u and the pad, 16u of 20, beyond the slope's end: at
    // s + 9 and 448u more, but for what the slope is below 1.
    for (below, more) in [(384.0, 1), (512.0, 0)] {
        for s in 0..=6u8 {
            let slope = [[1.0 - below / f32::from(s + 5) * u; LANES]; 2];
            let frustum = Frustum { heading: Heading::new(0, true), slopes: [slope; 2] };
            let slices = frustum.slices(Scalar, [0.0; 3], &grid, Margins::Derived);
            let last = [0, 1].map(|side| slices.last[side][usize::from(s)]);
            assert_eq!(last, [i32::from(s) + 8 + more; 2], "slice {s}, {below}u below s + 9");
        }
    }
}

/// Cells in the rectangles of all slices.
fn cells_of(slices: &Slices) -> u64 {
    let wide = |side: usize, slice: usize| {
        u64::try_from(slices.last[side][slice] - slices.first[side][slice] + 1).unwrap_or(0)
    };
    (0..slices.count).map(|slice| wide(0, slice) * wide(1, slice)).sum()
}

/// Whoever walks, a block or a tile, comes to the cells of padded slices, and to no others: seen far from zero, where the pad decides of one in
/// some packets.
#[test]
fn packets_come_to_the_cells_of_padded_slices() {
    let seed = seed();
    let mut rng = generator(seed, 20);
    let size = Size::new(4, 4).expect("small");
    let corner = |i: usize, corner: usize| if corner >> i & 1 == 0 { 8192.0 } else { 8208.0 };
    let balls =
        (0..8).map(|at| Sphere { center: [0, 1, 2].map(|i| corner(i, at)), radius: 0.01, color: [1; 3] });
    let scene = Scene::new(balls.collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let (mut walked, mut padded) = ([0u64; 2], [0u64; 2]);
    for case in 0..600 {
        let heading = Heading::new(case % 3, case % 2 == 0);
        // From along the major axis and the other two.
        let placed = |v: [f32; 3]| {
            let mut placed = [0.0; 3];
            (0..3).for_each(|i| placed[heading.order[i]] = v[i]);
            placed
        };
        let sense = if heading.forward { 1.0 } else { -1.0 };
        let mut any = |most: f32| rng.random_range(-most..most);
        let eye = placed([8200.0 - sense * 11.0, 8200.0 + any(7.0), 8200.0 + any(7.0)]);
        let toward = placed([sense, any(0.4), any(0.4)]);
        let (du, dv) = (placed([0.0, 0.003, 0.0]), placed([0.0, 0.0, 0.003]));
        let camera = Camera::new(eye, toward, du, dv, size).expect("valid");
        let resolution = Resolution::Fixed(16);
        let blocks = [Arithmetic::Certified, Arithmetic::Rounded(Form::Perpendicular)]
            .map(|arithmetic| Plan { arithmetic, resolution, ..Plan::safe() });
        let tiles = Plan { packet: Packet::Tile { side: 1 }, resolution, ..Plan::fast() };
        for plan in [tiles, blocks[0], blocks[1]] {
            let (counts, image) = costs(&scene, &camera, plan, 1);
            if image.ids.iter().any(|id| *id != MISS) {
                continue;
            }
            let (mut memory, mut events) = (Memory::default(), Events::default());
            let seen = Seen::new(Scalar, plan, &scene, &camera, &mut memory, &mut events, &Crew::alone());
            let grid = seen.expect("nothing to refuse").grid.expect("in range");
            let dir = |x, y| reference::Ray::of_pixel(&camera, x, y).dir;
            let is_tile = plan == tiles;
            let frustum = if is_tile {
                let corners = [[0, 0], [3, 0], [0, 3], [3, 3]].map(|[x, y]| heading.along(dir(x, y)));
                let slack = tile::slack(NEAREST as f32, &camera);
                Frustum {
                    heading,
                    slopes: tile::range(Scalar, slack, corners.map(|c| c.map(|x| [x; LANES]))),
                }
            } else {
                let lanes =
                    [0, 1, 2].map(|i| std::array::from_fn(|lane| dir(lane as u32 % 4, lane as u32 / 4)[i]));
                Bundle::of_block(Scalar, &Block::new(Scalar, lanes)).expect("one axis").frustum
            };
            let [derived, none] = [Margins::Derived, Margins::None]
                .map(|margins| cells_of(&frustum.slices(Scalar, eye, &grid, margins)));
            assert_eq!(counts.cells, derived, "case {case} of CGT_SEED={seed}: {camera:?}, {plan}");
            walked[usize::from(is_tile)] += 1;
            padded[usize::from(is_tile)] += u64::from(derived != none);
        }
    }
    eprintln!("CGT_SEED={seed}: {walked:?} blocks and tiles, of which the pad decides in {padded:?}");
    assert!(padded.iter().all(|n| *n > 20), "too little was at stake: {padded:?} of {walked:?}");
}

/// The range of slopes between directions is that of their slopes, and beyond it (4 s/A + 16u) (1 + |slope|), within −1 to 1; all of it where
/// A is not above 1024 s.
#[test]
fn ranges_of_slopes_are_those_derived() {
    let seed = seed();
    let mut rng = generator(seed, 15);
    for case in 0..20_000 {
        let size = power(&mut rng, -19.0, 19.0);
        let corners: [[f32; 3]; 4] = std::array::from_fn(|_| {
            let a = rng.random_range(0.5..1.0) * size;
            [a, a * rng.random_range(-1.0..1.0), a * rng.random_range(-1.0..1.0)].map(|x| x as f32)
        });
        let slack = (size * power(&mut rng, -30.0, -9.0)) as f32;
        let given = tile::range(Scalar, slack, corners.map(|corner| corner.map(|x| [x; LANES])));
        let least = corners.iter().map(|c| f64::from(c[0])).fold(f64::INFINITY, f64::min);
        for (side, [lo, hi]) in given.iter().enumerate() {
            let given = [f64::from(lo[0]), f64::from(hi[0])];
            let slopes = corners.map(|c| f64::from(c[side + 1]) / f64::from(c[0]));
            let ends = [f64::min as fn(f64, f64) -> f64, f64::max]
                .map(|pick| slopes.into_iter().reduce(pick).expect("four"));
            let steepest = 1.0 + ends[0].abs().max(ends[1].abs());
            let pad = (4.0 * f64::from(slack) / least + 16.0 * NEAREST) * steepest;
            let wanted = if least <= 1024.0 * f64::from(slack) {
                [-1.0, 1.0]
            } else {
                [(ends[0] - pad).max(-1.0), (ends[1] + pad).min(1.0)]
            };
            // A quotient, and what makes the pad, are rounded.
            let off = 4.0 * NEAREST * steepest;
            assert!(
                (0..2).all(|end| (given[end] - wanted[end]).abs() <= off),
                "{given:?}, not {wanted:?}; case {case} of CGT_SEED={seed}: slack {slack:e}, {corners:?}"
            );
        }
    }
}

/// A tile that looks along one row of cells, wherever in the grid that is and whatever its axis and sense, looks at its cells alone.
#[test]
fn cells_of_narrow_tiles_are_counted() {
    let at = |i: usize, corner: usize| if corner >> i & 1 == 0 { 0.0 } else { 16.0 };
    let corners =
        (0..8).map(|corner| Sphere { center: [0, 1, 2].map(|i| at(i, corner)), radius: 0.01, color: [1; 3] });
    let scene = Scene::new(corners.collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(4, 4).expect("small");
    let plan = Plan { resolution: Resolution::Fixed(16), packet: Packet::Tile { side: 1 }, ..Plan::fast() };
    for axis in 0..3 {
        let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
        for (from, sense) in [(-1.0, 1.0), (17.0, -1.0)] {
            for [y, z] in [[0.5, 12.5], [12.5, 9.5], [14.5, 1.5]] {
                let vector = |x: f32, y: f32, z: f32| {
                    let mut v = [x; 3];
                    (v[second], v[third]) = (y, z);
                    v
                };
                let (du, dv) = (vector(0.0, 0.001, 0.0), vector(0.0, 0.0, 0.001));
                let camera = Camera::new(vector(from, y, z), vector(sense, -0.002, -0.002), du, dv, size);
                let (counts, _) = costs(&scene, &camera.expect("valid"), plan, 1);
                assert_eq!(
                    (counts.cells, counts.candidates),
                    (16, 0),
                    "axis {axis}, {sense}, {y}, {z}: {counts:?}"
                );
            }
        }
    }
}

/// Who knows what is seen shows it also where a tile's rays go along several axes.
#[test]
fn the_clairvoyant_sees_along_all_axes() {
    let seed = seed();
    let mut rng = generator(seed, 16);
    let (mut splits, mut shown) = (0, 0);
    for case in 0..12 {
        let scene = Scene::new(scattered(&mut rng, 90, [3.0; 3]), [7; 3], DEFAULT_LIGHT).expect("valid");
        let size = Size::new(rng.random_range(20..45), rng.random_range(20..45)).expect("small");
        let camera =
            Camera::new([3.0; 3], [-1.1, 1.3, -1.0], [0.11, 0.013, 0.02], [0.017, -0.12, 0.01], size);
        let camera = camera.expect("valid");
        for side in [1, 2, 5, 16] {
            let plan = Plan { packet: Packet::Tile { side }, ..Plan::fast() };
            let (_, image) = costs(&scene, &camera, plan, 1);
            let mut session = Tracer::new(plan, Level::best().expect("a level")).session().expect("memory");
            let known = session.render_known(&scene, &camera, &Known::of(&image)).expect("it is known");
            let what = format!("case {case} of CGT_SEED={seed}, {plan}");
            assert_eq!((&known.image.ids, &known.image.rgba), (&image.ids, &image.rgba), "{what}");
            shown += image.ids.iter().filter(|id| **id != MISS).count();
        }
        splits += split_blocks(&camera);
    }
    eprintln!("CGT_SEED={seed}: {splits} blocks along several axes, {shown} pixels with a sphere");
    assert!(splits > 40 && shown > 5_000, "too little was at stake: {splits}, {shown}");
}

/// A row of spheres in a grid with as many slices as there may be, looked through from end to end by every loop that is right.
#[test]
fn as_many_slices_as_there_may_be_are_walked() {
    let spheres = (0..200u8).map(|i| Sphere {
        center: [f32::from(i % 14) * 0.02 - 0.13, f32::from(i % 11) * 0.02 - 0.1, -f32::from(i)],
        radius: 0.004,
        color: [i; 3],
    });
    let scene = Scene::new(spheres.collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(24, 24).expect("small");
    for sign in [1.0, -1.0] {
        let eye = [0.0, 0.0, if sign > 0.0 { 9.0 } else { -209.0 }];
        let camera = Camera::new(eye, [-6e-4, 6e-4, -sign], [5e-5, 0.0, 0.0], [0.0, -5e-5, 0.0], size);
        let camera = camera.expect("valid");
        let naive = reference::Tracer::new(reference::Arithmetic::F32Perpendicular);
        let truth = naive.threads(1).render(&scene, &camera).expect("small").image;
        for walk in [Loop::Nested, Loop::Flattened] {
            let plan = Plan { walk, resolution: Resolution::UpTo(240), ..Plan::safe() };
            let (counts, image) = costs(&scene, &camera, plan, 1);
            assert_eq!((&image.ids, &image.t), (&truth.ids, &truth.t), "{plan}");
            assert!(counts.cells > 36 * 100, "not all slices are walked: {counts:?}");
        }
    }
}

/// The paper's plan is the paper to the letter: each choice is the one that the plan's own texts name so.
#[test]
fn the_papers_plan_is_the_paper() {
    let words = "eight corners into queues of 16, 4x4 blocks, flattened loop, four planes, no margins, textbook f32, 16 cells on an axis, \
                 goes on in any event, a grid for each worker";
    assert_eq!(Plan::paper().to_string(), words);
}

/// So are the numbers of the other two what was measured to be fast.
#[test]
fn plans_have_the_numbers_that_were_measured() {
    let safe = "box range into lists, 4x4 blocks, flattened loop, four planes, derived margins, perpendicular f32, up to 32 cells on an \
                axis, falls back, one grid";
    let fast = "by centre into lists, tiles of 32x32 blocks, nested loops, four planes, derived margins, certified exact, up to 240 cells \
                on an axis, falls back, one grid";
    assert_eq!([Plan::safe().to_string(), Plan::fast().to_string()], [safe, fast]);
}

/// Events and errors name the place and the values, each where it belongs.
#[test]
fn errors_are_said_with_their_numbers() {
    let events = [
        (
            Event::CellFull { cell: [3, 5, 7], pushed: 11, lost: 13 },
            "cell [3, 5, 7] is full: sphere 11 pushed out sphere 13; a queue holds 16",
        ),
        (
            Event::SpansCells { sphere: 17, axis: 2, cells: 5 },
            "sphere 17 spans 5 cells on axis 2; eight corners reach two",
        ),
        (Event::TooManyIds { spheres: 70_000 }, "70000 spheres; ids of 2 bytes number at most 65535"),
        (Event::OutOfRange, "the scene is out of the range for which margins are derived"),
    ];
    let mut errors: Vec<(RenderError, String)> = Vec::new();
    for (event, words) in events {
        assert_eq!(event.to_string(), words);
        errors.push((RenderError::Refused(event), format!("refused by the plan: {words}")));
    }
    let size = |width, height| Size::new(width, height).expect("small");
    let none = Size::new(0, 3).expect_err("no pixels");
    let plan = Plan::safe();
    let tiles = format!(
        "tiles need spheres listed once, by centre in lists, certified arithmetic, derived margins, and 1 to 64 blocks on a side; the plan \
         is: {plan}"
    );
    errors.extend([
        (RenderError::Size(none), none.to_string()),
        (
            RenderError::Workers { workers: 19, cause: "no room".to_owned() },
            "no threads for 19 workers: no room".to_owned(),
        ),
        (
            RenderError::Resolution { cells: 241 },
            "a grid of 241 cells on an axis; it must be from 1 to 240".to_owned(),
        ),
        (
            RenderError::Lists { cells: [47, 53, 59] },
            "the lists of a grid of [47, 53, 59] cells do not fit, in 32 bits or in memory".to_owned(),
        ),
        (RenderError::Tile { plan }, tiles),
        (
            RenderError::KnownId { id: 29, spheres: 23 },
            "what is known names sphere 29, the scene has 23".to_owned(),
        ),
        (
            RenderError::Known { known: size(31, 37), asked: size(41, 43) },
            "what is known belongs to a picture of 31x37, that asked for has 41x43".to_owned(),
        ),
    ]);
    for (error, words) in errors {
        assert_eq!(error.to_string(), words, "{error:?}");
    }
}

/// So do the reasons of a plan, of which each limit is another number than what it limits.
#[test]
fn reasons_are_said_with_their_numbers() {
    for (reason, words) in [
        (
            Reason::OutOfRange,
            "a sphere lies beyond the range of the margins: all spheres meet all rays, in 4x4 blocks",
        ),
        (
            Reason::Few { spheres: 61 },
            "61 spheres, fewer than 50000: large tiles see their candidates in one round",
        ),
        (
            Reason::Many { spheres: 67_000 },
            "67000 spheres, not fewer than 50000: small tiles need fewer rounds",
        ),
    ] {
        assert_eq!(reason.to_string(), words);
    }
}

/// As many events are kept as it says.
#[test]
fn ten_thousand_events_are_kept() {
    assert_eq!(Events::KEPT, 10_000);
    let mut events = Events::default();
    for id in 0..10_007 {
        events.push(Event::SpansCells { sphere: id, axis: 1, cells: 3 });
    }
    assert_eq!((events.count(), events.first().len()), (10_007, 10_000));
    assert!(
        (0..)
            .zip(events.first())
            .all(|(id, event)| matches!(event, Event::SpansCells { sphere, .. } if *sphere == id))
    );
}

/// Plans that promise the naive picture, and words in which no two plans are alike.
#[test]
fn plans_promise_and_say_what_they_are() {
    let safe = Plan::safe();
    assert!(
        safe.promises_equality() && Plan::fast().promises_equality() && !Plan::paper().promises_equality()
    );
    let broken = [
        Plan { on_event: OnEvent::GoOn, ..safe },
        Plan { margins: Margins::None, ..safe },
        Plan { walk: Loop::Printed, ..safe },
    ];
    for plan in broken {
        assert!(!plan.promises_equality(), "{plan}");
    }
    assert!(Plan { on_event: OnEvent::Refuse, ..safe }.promises_equality());
    let mut others = vec![
        safe,
        Plan { cells: Cells::Queue, ..safe },
        Plan { walk: Loop::Nested, ..safe },
        Plan { culling: Culling::None, ..safe },
        Plan { sharing: Sharing::Mirrored, ..safe },
        Plan { on_event: OnEvent::Refuse, ..safe },
        Plan { packet: Packet::Tile { side: 3 }, ..safe },
        Plan { packet: Packet::Tile { side: 4 }, ..safe },
        Plan { resolution: Resolution::UpTo(31), ..safe },
        Plan { resolution: Resolution::Fixed(32), ..safe },
    ];
    others.extend(broken);
    for voxelizer in [Voxelizer::EightCorners, Voxelizer::Overlap, Voxelizer::ByCenter] {
        others.push(Plan { voxelizer, ..safe });
    }
    for form in [Form::Textbook, Form::Perpendicular] {
        others.extend(
            [Arithmetic::Rounded(form), Arithmetic::Spu(form)].map(|arithmetic| Plan { arithmetic, ..safe }),
        );
    }
    others.push(Plan { arithmetic: Arithmetic::Certified, ..safe });
    others.retain(|plan| *plan != safe);
    let mut words: Vec<String> = others.iter().chain([&safe]).map(Plan::to_string).collect();
    words.sort();
    let all = words.len();
    words.dedup();
    assert_eq!(words.len(), all, "two plans are said alike");
    assert_eq!(all, 20);
}

/// Workers are as many as asked for, and none is as good as one.
#[test]
fn a_crew_has_its_size() {
    for (asked, size) in [(0, 1), (1, 1), (2, 2), (3, 3)] {
        assert_eq!(Crew::new(asked).expect("threads").size(), size);
    }
    assert_eq!(Crew::alone().size(), 1);
}

/// As many tasks as there are workers wait until all are begun, which they are only if each worker, a thread of its own, has one; asked for by
/// a worker of somebody else's pool too. Who waits in vain gives up after a time in which any thread gets to run.
#[test]
fn all_workers_of_a_crew_are_at_work() {
    for size in [1, 2, 3, 8] {
        let crew = Crew::new(size).expect("threads");
        let meet = || {
            let (begun, patience) = (AtomicUsize::new(0), Duration::from_secs(20));
            let met = crew.share(0..size, |next| {
                let mut tasks = 0;
                while next().is_some() {
                    tasks += 1;
                    begun.fetch_add(1, Ordering::SeqCst);
                    let start = Instant::now();
                    while begun.load(Ordering::SeqCst) < size && start.elapsed() < patience {
                        std::thread::yield_now();
                    }
                }
                (tasks, std::thread::current().id())
            });
            let threads: HashSet<_> = met.iter().map(|(_, thread)| *thread).collect();
            (met.iter().map(|(tasks, _)| *tasks).collect::<Vec<u32>>(), threads.len())
        };
        assert_eq!(meet(), (vec![1; size], size), "tasks of each worker, threads");
        assert_eq!(rayon::join(meet, || ()).0, (vec![1; size], size), "within another pool");
    }
}

/// The variable that says that the test below is run with little memory.
const LITTLE_MEMORY: &str = "CGT_LITTLE_MEMORY";

/// Asks for more workers than there is room for their stacks; run by the next test with so little.
#[test]
fn too_many_workers_are_asked_for() {
    if std::env::var_os(LITTLE_MEMORY).is_some() {
        let error = Crew::new(5_000).expect_err("more than there can be");
        eprintln!("asked for 5000: {error}");
    }
}

/// Workers that cannot be had are refused with the number that was asked for. Stacks of 2 GiB in 8 GiB: one of the first has no
/// room, and all else has.
#[test]
#[cfg(target_os = "linux")]
fn workers_that_cannot_be_had_are_refused() {
    let script = "ulimit -v 8388608 && exec \"$0\" --exact too_many_workers_are_asked_for --nocapture";
    let mut child = std::process::Command::new("sh");
    child.args(["-c", script]).arg(std::env::current_exe().expect("this program"));
    child.env(LITTLE_MEMORY, "1").env("RUST_MIN_STACK", (2u64 << 30).to_string());
    let output = child.output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("no threads for 5000 workers: "), "{said}");
}

/// Asks for frames, and for work within another pool, where no further thread can be had; run by the next test.
#[test]
fn no_further_thread_can_be_had() {
    if std::env::var_os(LITTLE_MEMORY).is_none() {
        return;
    }
    let balls = scattered(&mut generator(1, 0), 40, [3.0; 3]);
    let scene = Scene::new(balls, [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(64, 64).expect("small");
    let (du, dv) = ([0.02, 0.0, 0.0], [0.0, -0.02, 0.0]);
    let camera = Camera::new([3.0, 3.0, 12.0], [-0.64, 0.64, -1.0], du, dv, size).expect("valid");
    let mut session = Tracer::new(Plan::fast(), Level::SCALAR).workers(2).session().expect("one thread more");
    let mut ids = Vec::new();
    for _ in 0..3 {
        ids.clone_from(&session.render(&scene, &camera).expect("its own workers are enough").image.ids);
    }
    Crew::new(2).expect_err("there is room for another thread");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).stack_size(1 << 22).build();
    let pool = pool.expect("a small one");
    let alone =
        pool.install(|| session.render(&scene, &camera).expect("by the caller alone").image.ids.clone());
    assert_eq!(alone, ids);
    let hits = alone.iter().filter(|id| **id != MISS).count();
    eprintln!("no further thread for {hits} pixels");
}

/// A session asks for its threads once and not for each frame; and who gets no thread to wait in, within another pool, works alone. Stacks
/// of 2 GiB in 6 GiB: the test's own and one more have room, and a third has not.
#[test]
#[cfg(target_os = "linux")]
fn no_thread_is_asked_for_in_vain() {
    let script =
        "ulimit -v 6291456 && exec \"$0\" --exact no_further_thread_can_be_had --nocapture --test-threads 2";
    let mut child = std::process::Command::new("sh");
    child.args(["-c", script]).arg(std::env::current_exe().expect("this program"));
    child.env(LITTLE_MEMORY, "1").env("RUST_MIN_STACK", (2u64 << 30).to_string());
    let output = child.output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    let told = said.contains("no further thread for ") && !said.contains("for 0 pixels");
    assert!(output.status.success() && told, "{said}");
}

/// A stripe is as high as a tile, but of several workers each may take eight, in whole patches of 32 scanlines.
#[test]
fn stripes_are_as_high_as_it_says() {
    let tile = |side: u8| Packet::Tile { side };
    for (packet, rows, workers, [side, height]) in [
        (Packet::Block, 1080, 1, [4, 4]),
        (Packet::Block, 1080, 4, [4, 4]),
        (tile(1), 1080, 2, [4, 4]),
        (tile(8), 1080, 8, [32, 32]),
        (tile(9), 1080, 1, [36, 36]),
        (tile(9), 1080, 8, [36, 32]),
        (tile(9), 1080, 2, [36, 36]),
        (tile(16), 1080, 1, [64, 64]),
        (tile(16), 1080, 2, [64, 64]),
        (tile(32), 1080, 2, [128, 96]),
        (tile(32), 1080, 3, [128, 64]),
        (tile(32), 1080, 8, [128, 32]),
        (tile(32), 4000, 2, [128, 128]),
        (tile(32), 511, 2, [128, 32]),
        (tile(32), 528, 2, [128, 64]),
        (tile(32), 10, 2, [128, 32]),
        (tile(32), 1080, usize::MAX / 8, [128, 32]),
        (tile(32), 1080, usize::MAX, [128, 32]),
    ] {
        let given = tile_size(packet, rows, workers);
        assert_eq!(given, [side, height], "{packet:?}, {rows} rows, {workers} workers");
    }
}

/// Building and tracing follow one another within the time that a frame takes.
#[test]
fn times_are_parts_of_the_frame() {
    let mut rng = generator(seed(), 15);
    let scene = Scene::new(scattered(&mut rng, 200_000, [2.0; 3]), [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(4, 4).expect("small");
    let camera = Camera::new([9.0; 3], [-1.0; 3], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0], size).expect("valid");
    for plan in [Plan::fast(), Plan::safe()] {
        let tracer = Tracer::new(plan, Level::best().expect("a level"));
        let start = Instant::now();
        let times = tracer.render(&scene, &camera).expect("nothing to refuse").times;
        let whole = start.elapsed();
        assert!(times.build > Duration::ZERO && times.trace > Duration::ZERO, "{plan}: {times:?}");
        assert!(times.build + times.trace <= whole, "{plan}: {times:?} of {whole:?}");
        // Lists of so many spheres, boxed one by one, take nearly all of it.
        assert!(plan == Plan::fast() || times.build > whole * 3 / 5, "{plan}: {times:?} of {whole:?}");
    }
}

/// What was cleared is all misses, and known to be: the next frame clears none of it again.
#[test]
fn what_is_cleared_is_not_cleared_again() {
    let scene = Scene::new(vec![], [7, 8, 9], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(12, 8).expect("small");
    let camera = Camera::new([0.0; 3], [-1.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], size).expect("valid");
    let (mut ids, mut t, mut rgba) = ([3; 96], [2.0; 96], [[1; 4]; 96]);
    let mut columns = [[4, 8], [0, 12]];
    let mut stripe =
        Stripe { y: 0, width: 12, ids: &mut ids, t: &mut t, rgba: &mut rgba, columns: &mut columns };
    Painter::new(Scalar, &scene, &camera).clear(&mut stripe);
    assert_eq!(columns, [NO_COLUMN; 2]);
    for (i, id) in ids.iter().enumerate() {
        let within = i >= 48 || (4..8).contains(&(i % 12));
        let wanted = if within { (MISS, f32::INFINITY, [7, 8, 9, 255]) } else { (3, 2.0, [1; 4]) };
        assert_eq!((*id, t[i], rgba[i]), wanted, "pixel {i}");
    }
}

/// What a packet may hit is forgotten before the next: a worker holds no more after a hundred packets than after one.
#[test]
fn a_worker_holds_what_one_packet_may_hit() {
    let nested = (1..=20u8).map(|i| Sphere { center: [0.01; 3], radius: i.into(), color: [1; 3] });
    let scene = Scene::new(nested.collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(4, 4).expect("small");
    let (du, dv) = ([0.1, 0.0, 0.0], [0.0, -0.1, 0.0]);
    let camera = Camera::new([0.0; 3], [-0.2, 0.2, -1.0], du, dv, size).expect("valid");
    let plan = Plan { packet: Packet::Block, ..Plan::fast() };
    let (mut memory, mut events) = (Memory::default(), Events::default());
    let seen = Seen::new(Scalar, plan, &scene, &camera, &mut memory, &mut events, &Crew::alone());
    let seen = seen.expect("nothing to refuse");
    let dir = |lane: usize| reference::Ray::of_pixel(&camera, lane as u32 % 4, lane as u32 / 4).dir;
    let block = Block::new(Scalar, [0, 1, 2].map(|i| std::array::from_fn(|lane| dir(lane)[i])));
    let mut worker = Worker::default();
    // The ids are a private part of it, and told by its words alone.
    let held = |worker: &Worker| {
        let words = format!("{worker:?}");
        let (_, list) = words.split_once("possible: [").expect("it holds ids");
        let (list, _) = list.split_once(']').expect("a list");
        list.split(',').count()
    };
    seen.trace(Scalar, scene.spheres(), &block, None, &mut worker);
    let one = held(&worker);
    (0..100).for_each(|_| {
        seen.trace(Scalar, scene.spheres(), &block, None, &mut worker);
    });
    assert_eq!((one, held(&worker)), (20, 20), "{worker:?}");
}

/// What f64 is not sure of has two ends that differ, so that nobody takes one of them for t.
#[test]
fn an_uncertain_root_has_two_ends() {
    let seed = seed();
    let mut rng = generator(seed, 8);
    let mut uncertain = 0;
    for _ in 0..2_000 {
        let (eye, dir) = (vector(&mut rng, 4.0), vector(&mut rng, 1.0));
        let root = double::root::<f64>(eye, dir, vector(&mut rng, 4.0), 1.0);
        let [lo, hi] = root.ends();
        if !root.hit {
            uncertain += 1;
            assert_ne!(lo.to_bits(), hi.to_bits(), "CGT_SEED={seed}: {root:?}");
        }
    }
    assert!(uncertain > 500);
}

/// One tile that sees all cells looks at all of them and all spheres, unless something hides them; and of small spheres that stand apart f32
/// is certain.
#[test]
fn counts_of_tiles_are_what_they_say() {
    let seed = seed();
    let mut rng = generator(seed, 9);
    let size = Size::new(64, 60).expect("small");
    // The walk's margins are relative, so it must end as early in a small scene.
    for scale in [1.0f32, 2f32.powi(-10)] {
        let camera = Camera::new(
            [0.0, 0.0, 9.0 * scale],
            [-0.32, 0.3, -1.0],
            [0.01, 0.0, 0.0],
            [0.0, -0.01, 0.0],
            size,
        );
        let camera = camera.expect("valid");
        let mut ball = |radius: f32| Sphere {
            center: [0, 1, 2].map(|_| scale * rng.random_range(-1.0f32..1.0)),
            radius: scale * radius,
            color: [1; 3],
        };
        let mut spheres: Vec<Sphere> = (0..3_000).map(|_| ball(0.001)).collect();
        let open = Scene::new(spheres.clone(), [0; 3], DEFAULT_LIGHT).expect("valid");
        // All that a tile sees is hidden: by spheres before all others, over the whole picture.
        for i in 0..40u8 {
            for j in 0..40u8 {
                let at = |i: u8| scale * (f32::from(i) * 0.14 - 2.73);
                spheres.push(Sphere {
                    center: [at(i), at(j), 1.2 * scale],
                    radius: 0.13 * scale,
                    color: [2; 3],
                });
            }
        }
        let hidden = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
        let plan =
            Plan { resolution: Resolution::Fixed(16), packet: Packet::Tile { side: 16 }, ..Plan::fast() };
        let (counts, _) = costs(&open, &camera, plan, 1);
        let what = format!("scale {scale:e}, CGT_SEED={seed}: {counts:?}");
        assert_eq!(
            (counts.cells, counts.candidates, counts.split_blocks),
            (16 * 16 * 16, 3_000, 0),
            "{what}"
        );
        assert!(counts.lanes > 300 && counts.asked_f64 * 20 < counts.lanes, "{what}");
        for (packet, name) in [(Packet::Tile { side: 16 }, "tile"), (Packet::Block, "blocks")] {
            let plan = Plan { packet, ..plan };
            let [all, few] = [&open, &hidden].map(|scene| costs(scene, &camera, plan, 1).0);
            assert!(few.cells * 2 < all.cells, "{name}: {all:?}, behind a wall {few:?}; {what}");
        }
    }
}

/// From within a sphere, or twenty one around another, every ray is answered once, whatever its major axis, and by f32 alone.
#[test]
fn every_lane_is_answered_once() {
    let ball = |radius: u16| Sphere { center: [0.01, 0.02, -0.03], radius: radius.into(), color: [1; 3] };
    let nested = [9, 17, 12, 23, 6, 14, 20, 8, 11, 19, 24, 7, 16, 5, 10, 22, 13, 18, 21, 15];
    let scenes = [(vec![5], 0), (nested.to_vec(), 13)];
    for ((width, height), (radii, nearest)) in [(32, 32), (29, 31), (4, 4), (65, 33)]
        .into_iter()
        .flat_map(|size| scenes.iter().map(move |scene| (size, scene)))
    {
        let scene =
            Scene::new(radii.iter().map(|r| ball(*r)).collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
        let size = Size::new(width, height).expect("small");
        // Directions of whole numbers, of which many are as long on two axes.
        let camera = Camera::new([0.0; 3], [-20.5, -19.5, -20.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.0], size);
        let camera = camera.expect("valid");
        for side in [1, 2, 16] {
            let plan = Plan { packet: Packet::Tile { side }, ..Plan::fast() };
            let (counts, image) = costs(&scene, &camera, plan, 1);
            let lanes = 16 * u64::from(width.div_ceil(4) * height.div_ceil(4));
            let what = format!("{width}x{height}, {} spheres, {plan}: {counts:?}", radii.len());
            assert_eq!((counts.lanes, counts.asked_f64), (lanes, 0), "{what}");
            assert!(image.ids.iter().all(|id| id == nearest), "{what}");
        }
    }
}

/// Twins around the eye leave f32 no lane, so each is asked of f64, and none twice or in a pass that is not its own, be it a tile's or that of one
/// ray of a split block; as they are the same sphere, integers are not asked.
#[test]
fn every_marked_lane_is_asked_once() {
    let twin = Sphere { center: [0.01, 0.02, -0.03], radius: 5.0, color: [1; 3] };
    let scene = Scene::new(vec![twin; 2], [0; 3], DEFAULT_LIGHT).expect("valid");
    let mut splits = 0;
    for (width, height) in [(32, 32), (29, 31), (4, 4), (65, 33)] {
        let size = Size::new(width, height).expect("small");
        let camera = Camera::new([0.0; 3], [-20.5, -19.5, -20.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.0], size);
        let camera = camera.expect("valid");
        splits += split_blocks(&camera);
        for packet in
            [Packet::Block, Packet::Tile { side: 1 }, Packet::Tile { side: 2 }, Packet::Tile { side: 16 }]
        {
            let plan = Plan { packet, ..Plan::fast() };
            let (counts, image) = costs(&scene, &camera, plan, 1);
            let lanes = 16 * u64::from(width.div_ceil(4) * height.div_ceil(4));
            let what = format!("{width}x{height}, {plan}: {counts:?}");
            assert_eq!((counts.lanes, counts.asked_f64, counts.asked_integers), (lanes, lanes, 0), "{what}");
            assert!(image.ids.iter().all(|id| *id == 0), "{what}");
        }
    }
    assert!(splits > 20, "hardly a block is split: {splits}");
}

/// Beyond the picture's edge a block's lanes repeat its last column or row: here the next ray would go backwards, but for its sense along a line
/// through the ball.
#[test]
fn lanes_beyond_the_edge_repeat_the_last_ray() {
    let ball = Sphere { center: [10.0, -0.5, 0.0], radius: 3.0, color: [1; 3] };
    let scene = Scene::new(vec![ball], [0; 3], DEFAULT_LIGHT).expect("valid");
    let (only, long, short) = ([1.0f32, 0.1, 0.0], [-3.0f32, 0.3, 0.0], [0.0f32, 0.0, 0.01]);
    for [du, dv] in [[long, short], [short, long]] {
        let corner = [0, 1, 2].map(|i| only[i] - 0.5 * (du[i] + dv[i]));
        let size = Size::new(1, 1).expect("small");
        let camera = Camera::new([0.0; 3], corner, du, dv, size).expect("valid");
        for packet in [Packet::Block, Packet::Tile { side: 1 }, Packet::Tile { side: 16 }] {
            let plan = Plan { packet, ..Plan::fast() };
            let (counts, image) = costs(&scene, &camera, plan, 1);
            let what = format!("du {du:?}, dv {dv:?}, {plan}: {counts:?}");
            assert_eq!((counts.lanes, counts.asked_f64, &image.ids[..]), (16, 0, &[0][..]), "{what}");
            assert!(counts.cells > 0, "without a grid: {what}");
        }
    }
}

/// Who knows what each block shows meets that and nothing else: by tiles each sphere once, by blocks once for each.
#[test]
fn the_clairvoyant_meets_what_is_seen() {
    let seed = seed();
    let mut rng = generator(seed, 10);
    for case in 0..12 {
        let scene = Scene::new(scattered(&mut rng, 60, [3.0; 3]), [7; 3], DEFAULT_LIGHT).expect("valid");
        let [width, height] = [rng.random_range(5..60), rng.random_range(5..60)];
        let size = Size::new(width, height).expect("small");
        let (across, down) = (0.9 / width as f32, -0.9 / height as f32);
        let camera =
            Camera::new([3.1, 2.9, 12.0], [-0.45, 0.45, -1.0], [across, 0.0, 0.0], [0.0, down, 0.0], size);
        let camera = camera.expect("valid");
        for (packet, side) in
            [(Packet::Block, 4), (Packet::Tile { side: 2 }, 8), (Packet::Tile { side: 5 }, 20)]
        {
            let plan = Plan { packet, ..Plan::fast() };
            let (_, image) = costs(&scene, &camera, plan, 1);
            // Of each tile or block, who owns a pixel of it.
            let mut owners: BTreeSet<(u32, u32, u32)> = BTreeSet::new();
            for (pixel, id) in (0..).zip(&image.ids).filter(|(_, id)| **id != MISS) {
                owners.insert((pixel % width / side, pixel / width / side, *id));
            }
            let mut session = Tracer::new(plan, Level::best().expect("a level")).session().expect("memory");
            let known = session.render_known(&scene, &camera, &Known::of(&image)).expect("it is known");
            let what = format!("case {case} of CGT_SEED={seed}: {width}x{height}, {plan}");
            assert_eq!((&known.image.ids, &known.image.rgba), (&image.ids, &image.rgba), "{what}");
            assert_eq!(known.counts.candidates, owners.len() as u64, "{what}");
            assert!(owners.len() > 5, "{what}: hardly a sphere is seen");
        }
    }
}

fn costs(scene: &Scene, camera: &Camera, plan: Plan, workers: usize) -> (Counts, Image) {
    let tracer = Tracer::new(plan, Level::best().expect("a level")).workers(workers);
    let rendering = tracer.render(scene, camera).expect("falls back");
    (rendering.counts, rendering.image)
}

/// By blocks too, where they are split: each of sixteen rays meets whom its block shows, and no cell is walked.
#[test]
fn the_clairvoyant_walks_no_cell_of_a_split_block() {
    let seed = seed();
    let mut rng = generator(seed, 17);
    let (mut splits, mut met) = (0, 0);
    for case in 0..12 {
        let scene = Scene::new(scattered(&mut rng, 90, [3.0; 3]), [7; 3], DEFAULT_LIGHT).expect("valid");
        let size = Size::new(rng.random_range(20..45), rng.random_range(20..45)).expect("small");
        let camera =
            Camera::new([3.0; 3], [-1.1, 1.3, -1.0], [0.11, 0.013, 0.02], [0.017, -0.12, 0.01], size);
        let camera = camera.expect("valid");
        for arithmetic in [Arithmetic::Certified, Arithmetic::Rounded(Form::Perpendicular)] {
            let plan = Plan { packet: Packet::Block, arithmetic, ..Plan::fast() };
            let (_, image) = costs(&scene, &camera, plan, 1);
            let known = Known::of(&image);
            let mut wanted = 0;
            for block in blocks(size) {
                let rays = if is_split(&camera, block) { 16 } else { 1 };
                wanted += rays * known.block(block).len() as u64;
            }
            let mut session = Tracer::new(plan, Level::best().expect("a level")).session().expect("memory");
            let given = session.render_known(&scene, &camera, &known).expect("it is known");
            let what = format!("case {case} of CGT_SEED={seed}, {plan}: {:?}", given.counts);
            assert_eq!((&given.image.ids, &given.image.rgba), (&image.ids, &image.rgba), "{what}");
            assert_eq!((given.counts.cells, given.counts.candidates), (0, wanted), "{what}");
            met += wanted;
        }
        splits += split_blocks(&camera);
    }
    eprintln!("CGT_SEED={seed}: {splits} blocks are split, {met} spheres met");
    assert!(splits > 40 && met > 2_000, "too little was at stake: {splits}, {met}");
}

/// Lanes, spheres without a grid, and blocks without a common major axis, against what they count.
#[test]
fn counts_of_blocks_are_what_they_say() {
    let seed = seed();
    let mut rng = generator(seed, 6);
    let mut splits = 0;
    for case in 0..40 {
        let far = if case % 2 == 0 { 1.0 } else { 2f32.powi(31) };
        let mut spheres = scattered(&mut rng, 30, [2.0; 3]);
        spheres[0].center[0] = 3.0 * far;
        let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
        let [width, height] = [rng.random_range(1..40), rng.random_range(1..40)];
        let size = Size::new(width, height).expect("small");
        // A wide view, so that major axes change within it.
        let camera =
            Camera::new([0.1; 3], [-1.1, 1.3, -1.0], [0.11, 0.013, 0.02], [0.017, -0.12, 0.01], size);
        let camera = camera.expect("valid");
        let plan = Plan {
            arithmetic: Arithmetic::Certified,
            packet: Packet::Block,
            walk: Loop::Nested,
            ..Plan::safe()
        };
        let (counts, _) = costs(&scene, &camera, plan, 1 + case % 3);
        let split = split_blocks(&camera);
        let blocks = u64::from(width.div_ceil(4) * height.div_ceil(4));
        let what = format!("case {case} of CGT_SEED={seed}: {counts:?}, {camera:?}");
        assert_eq!(counts.split_blocks, split, "{what}");
        assert_eq!(counts.lanes, 16 * blocks, "{what}");
        if far > 1.0 {
            assert_eq!(counts.candidates, 30 * (blocks + 15 * split), "{what}");
            assert_eq!((counts.cells, counts.culled), (0, 0), "{what}");
        }
        splits += split;
    }
    assert!(splits > 40, "hardly a block was split");
}

/// The first pixels of a picture's blocks.
fn blocks(size: Size) -> impl Iterator<Item = [u32; 2]> {
    let rows = (0..size.height()).step_by(4);
    rows.flat_map(move |y| (0..size.width()).step_by(4).map(move |x| [x, y]))
}

/// Blocks of which no axis is the longest of all rays, in one sense.
fn split_blocks(camera: &Camera) -> u64 {
    blocks(camera.size()).filter(|block| is_split(camera, *block)).count() as u64
}

fn is_split(camera: &Camera, [x, y]: [u32; 2]) -> bool {
    let size = camera.size();
    let mut together = [true; 6];
    for lane in 0..16 {
        let column = (x + lane % 4).min(size.width() - 1);
        let row = (y + lane / 4).min(size.height() - 1);
        let d = reference::Ray::of_pixel(camera, column, row).dir;
        for (i, together) in together.iter_mut().enumerate() {
            let along = if i < 3 { d[i] } else { -d[i - 3] };
            *together &= along > 0.0 && d.iter().all(|x| x.abs() <= along);
        }
    }
    together == [false; 6]
}

/// Each of the stages behind f32 is counted where a committed case needs it, by blocks and by tiles, and no worker's count is lost.
#[test]
fn counts_of_certified_stages_are_what_they_say() {
    let sum = |name: &str, pick: fn(&Counts) -> u64| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
        let case = Case::from_json(&std::fs::read(path).expect("it is committed")).expect("a case");
        for packet in [Packet::Block, Packet::Tile { side: 2 }] {
            for workers in [1, 2] {
                let plan = Plan { packet, on_event: OnEvent::FallBack, ..Plan::fast() };
                let (counts, _) = costs(&case.frames.frames()[0], &case.camera, plan, workers);
                assert!(pick(&counts) > 0, "{name}, {plan}, {workers} workers: {counts:?}");
                assert!(counts.lanes >= counts.asked_f64 && counts.asked_f64 >= counts.asked_integers);
                assert!(
                    counts.lanes
                        <= 16
                            * u64::from(case.camera.size().width())
                            * u64::from(case.camera.size().height())
                );
            }
        }
    };
    sum("integers-round-t.json", |counts| counts.rounded_by_integers);
    sum("integers-decide-a-tangent.json", |counts| counts.asked_integers);
    sum("equal-roots.json", |counts| counts.asked_f64);
}
