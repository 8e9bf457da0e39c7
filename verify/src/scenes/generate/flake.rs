//! The sphereflake of the Standard Procedural Databases ("balls", E. Haines, "A Proposal for Standard Graphics
//! Environments", IEEE CG&A 7(11), 1987). A number of levels comes in, spheres come out, parents before their
//! children.
//!
//! The first sphere has radius 1/2 and stands at the origin. Each sphere bears nine of a third of its radius, which
//! touch it. Their directions: three, (d, d, 0), (d, 0, -d) and (0, d, -d) with d = 1/sqrt 2, turned about
//! (1, -1, 0)/sqrt 2 by the angle whose sine is 2/sqrt 6, and these turned again by 120 and 240 degrees about z. They
//! are meant in the parent's frame, whose +z is its own direction. So six children stand on the equator and three
//! at height sqrt(2/3). Sines and cosines here are square roots, so that the result is the same everywhere.

use contract::{Rgb, Sphere};

type Vector = [f64; 3];

const COLORS: [Rgb; 6] =
    [[236, 200, 120], [110, 170, 235], [235, 120, 95], [130, 205, 130], [200, 140, 220], [235, 235, 225]];

pub(super) fn fill(spheres: &mut Vec<Sphere>, levels: u32) {
    let directions = directions();
    grow(spheres, &directions, levels, 0, [0.0; 3], 0.5, [0.0, 0.0, 1.0]);
}

fn grow(
    spheres: &mut Vec<Sphere>,
    directions: &[Vector; 9],
    levels: u32,
    level: u32,
    center: Vector,
    radius: f64,
    up: Vector,
) {
    let color = COLORS[level as usize % COLORS.len()];
    spheres.push(Sphere { center: center.map(|x| x as f32), radius: radius as f32, color });
    if level == levels {
        return;
    }
    for &direction in directions {
        let outward = from_z_to(up, direction);
        let child = std::array::from_fn(|i| center[i] + radius * 4.0 / 3.0 * outward[i]);
        grow(spheres, directions, levels, level + 1, child, radius / 3.0, outward);
    }
}

fn directions() -> [Vector; 9] {
    let d = 0.5_f64.sqrt();
    let (sine, cosine) = ((2.0_f64 / 3.0).sqrt(), (1.0_f64 / 3.0).sqrt());
    let trio = [[d, d, 0.0], [d, 0.0, -d], [0.0, d, -d]].map(|v| turn([d, -d, 0.0], sine, cosine, v));
    let third = 0.75_f64.sqrt();
    let thirds = [(0.0, 1.0), (third, -0.5), (-third, -0.5)];
    std::array::from_fn(|i| {
        let (sine, cosine) = thirds[i / 3];
        turn([0.0, 0.0, 1.0], sine, cosine, trio[i % 3])
    })
}

/// Turns v about an axis of length 1 (Rodrigues' formula).
fn turn(axis: Vector, sine: f64, cosine: f64, v: Vector) -> Vector {
    let along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let across = axis[j] * v[k] - axis[k] * v[j];
        v[i] * cosine + across * sine + axis[i] * along * (1.0 - cosine)
    })
}

/// Turns v by the shortest turn that takes +z to `up`; half a turn about y for -z.
fn from_z_to(up: Vector, v: Vector) -> Vector {
    let [a, b, c] = up;
    if c < -1.0 + 1e-12 {
        return [-v[0], v[1], -v[2]];
    }
    let w = 1.0 / (1.0 + c);
    [
        (1.0 - a * a * w) * v[0] - a * b * w * v[1] + a * v[2],
        -a * b * w * v[0] + (1.0 - b * b * w) * v[1] + b * v[2],
        -a * v[0] - b * v[1] + c * v[2],
    ]
}
