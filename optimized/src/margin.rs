//! How far beyond a sphere's surface a reported hit may lie, so that the grid can list the sphere there.
//!
//! # The lemma that everything rests on
//!
//! Let a form report t for a ray and a sphere, and let P = eye + t d in real arithmetic, for that rounded t.
//! Then |P − c| <= R with R = [`reach`] of the sphere. So P lies in the sphere's box of half width R; the cell
//! that holds P lists the sphere; and since t > 0, the walk comes through that cell. Nothing else is needed:
//! the walk does not care where the true hit is, or whether there is one.
//!
//! # Derivation
//!
//! u = 2⁻²⁴, F = |eye − c|, n = |d|, a = n², b = (eye − c)·d, L the distance of c from the line, D the form's
//! discriminant in real arithmetic and D̂ as computed; terms of second order in u are covered by the slack in
//! the last step. P − c has the part L across the ray and b/n + t n along it, so
//! |P − c|² = L² + (b/n + t n)².
//!
//! *Common.* f is rounded once: error uF. b: uFn from f, 3uFn from the dot product, 4uFn in all. a: 3ua.
//!
//! *Perpendicular.* w = 1/a: 4u relative. h = b w: at most (4 + 4 + 1) uF/n, call it 10uF/n. l = f − h d: the
//! error of h is along d, where it meets l at a right angle; across it uF from f, uF from the products, uL from
//! the difference. So |l|² is off by at most 2L·3uF + 3uL² + (13uF)², r² by ur², their difference by uD;
//! E = u (6LF + 4L² + 2r²) + 170 (uF)². A hit is reported only if D̂ >= 0, hence L² <= r² + E, from which
//! L <= 1.5 r + 20uF. Along the ray: |b/n − h n| <= 10uF; s n is within 6u of √D̂; t is rounded once, at most
//! u (F + 2r) after multiplication by n. With D̂ <= r² − L² + E:
//! |P − c|² <= r² + E + 2√D̂ (11uF + 8ur) + (11uF + 8ur)² <= r² + 66 uFr + 830 (uF)² + 60 ur²
//! <= (r + 33uF + 30ur)². We take **R = r + 64u (F + r)**.
//!
//! *Textbook.* δ(b²) <= 9u aF²; q = f·f − r²: 6uF² + 2ur²; a q: ua (10F² + 6r²); the last subtraction
//! ua (F² + r²): E <= 21 ua (F² + r²). D̂ >= 0 gives L² <= r² + 21u (F² + r²). Along the ray, with
//! S = √(D̂/a) <= r + 4.6√u (F + r): the error is at most 4uF + 6u (F + S) <= 20u (F + r), so
//! |P − c|² <= r² + 21u (F² + r²) + 40u (F + r) S + (20u (F + r))². We take **R² = r² + 64u (F + r)²**. At
//! F = 2,000 r that is R = 4 r: the textbook form really does report hits that far out.
//!
//! *On the SPU* (contract, rule 6) an operation is off by less than 2u of its result, division and root by less than 4u where nothing is
//! lost below 2⁻¹²⁶ (`tests/spu_values.rs`: they are the result cut off, or one unit in the last place below). In the derivations division and root
//! stand once on a path, so no term is more than four times as large: we take **256u in place of 64u**. Of a number below 2⁻⁷⁹ the
//! root is off by up to 2⁻¹² of itself, for its remainder is lost: D w or D/a is below 2⁻⁷⁹ then, and P moves by less than 2⁻¹² 2⁻³⁹
//! 2²⁰ = 2⁻³¹, which 256u r exceeds for radii from 2⁻¹⁴; [`in_range`] asks for that. A quotient of a number below 2⁻⁷⁹ is off by as much of
//! itself; it is t then, and moves P by less than 2⁻¹² 2⁻⁷⁹ 2²⁰.
//!
//! *Certified.* The hit is the true one, whose point is on the surface: **R = r**. Its P is that of the true root, not of the
//! rounded t; the walk's early end goes by an upper bound of the root, below which no visited slice is missing.
//!
//! # Range
//!
//! The derivation knows no over- or underflow. [`in_range`] makes sure of that: positions up to 2³⁰, radii from
//! 2⁻³⁰, |d|² from 2⁻⁴⁰ to 2⁴⁰. Then the largest product is below 2¹⁰³, the smallest that matters above 2⁻¹⁰⁰, and an
//! underflow of 2⁻¹⁴⁹ anywhere stays below u times the terms kept (the nearest case, D w under the root, moves
//! P by 2⁻⁵⁴ <= u r). A scene out of range is still rendered, with every sphere a candidate of every ray.

use crate::plan::{Arithmetic, Margins};
use crate::sphere::Form;
use contract::{Camera, Sphere};

/// 64 units of f32 rounding.
const SLACK: f64 = 64.0 / (1u32 << 24) as f64;

/// The radius within which every reported hit lies, rounded up; the bare radius without margins.
///
/// `f` is eye − centre, `radius` the sphere's.
#[must_use]
#[allow(clippy::cast_possible_truncation, reason = "rounded up right after")]
pub fn reach(margins: Margins, arithmetic: Arithmetic, f: [f32; 3], radius: f32) -> f32 {
    let (form, slack) = match arithmetic {
        Arithmetic::Certified => return radius,
        Arithmetic::Rounded(form) => (form, SLACK),
        Arithmetic::Spu(form) => (form, 4.0 * SLACK),
    };
    if margins == Margins::None {
        return radius;
    }
    let r = f64::from(radius);
    let distance = f.iter().map(|&x| f64::from(x) * f64::from(x)).sum::<f64>().sqrt();
    let reach = match form {
        Form::Perpendicular => r + slack * (distance + r),
        Form::Textbook => (r * r + slack * (distance + r) * (distance + r)).sqrt(),
    };
    (reach as f32).next_up()
}

/// The farthest position.
const FARTHEST: f32 = (1u32 << 30) as f32;

/// The least radius on the SPU.
const LEAST_ON_SPU: f32 = 1.0 / (1u32 << 14) as f32;

/// Whether the derivation above holds for a sphere, with a camera that is in range.
#[must_use]
pub fn sphere_in_range(sphere: &Sphere) -> bool {
    let [x, y, z] = sphere.center;
    (sphere.radius >= 1.0 / FARTHEST)
        & (sphere.radius <= FARTHEST)
        & (x.abs() <= FARTHEST)
        & (y.abs() <= FARTHEST)
        & (z.abs() <= FARTHEST)
}

/// Whether the derivation above holds for a scene: no step of either form can over- or underflow.
#[must_use]
pub fn in_range(arithmetic: Arithmetic, spheres: &[Sphere], camera: &Camera) -> bool {
    let (shortest, longest) = direction_lengths(camera);
    let million = f64::from(1u32 << 20);
    camera.eye().iter().all(|&x| x.abs() <= FARTHEST)
        && shortest >= 1.0 / million
        && longest <= million
        && spheres.iter().all(sphere_in_range)
        && (!matches!(arithmetic, Arithmetic::Spu(_)) || spheres.iter().all(|s| s.radius >= LEAST_ON_SPU))
}

/// Lower and upper bounds of |d| over all pixels: the distance of the picture's plane from the eye, and the
/// sum of the spans. The errors of f32 directions and of f64 here are far below the 1 % taken off and put on.
fn direction_lengths(camera: &Camera) -> (f64, f64) {
    let [corner, du, dv] = [camera.corner(), camera.du(), camera.dv()].map(|v| v.map(f64::from));
    let cross: [f64; 3] = [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        du[j] * dv[k] - du[k] * dv[j]
    });
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let along = corner[0] * cross[0] + corner[1] * cross[1] + corner[2] * cross[2];
    let (width, height) = (f64::from(camera.size().width()), f64::from(camera.size().height()));
    let longest = 1.01 * (length(corner) + width * length(du) + height * length(dv));
    let shortest = 0.99 * along.abs() / length(cross) - 1e-5 * longest;
    (shortest, longest)
}
