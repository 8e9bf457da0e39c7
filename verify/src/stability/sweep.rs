//! What is turned up: for each sweep its values from easy to hard, what is known to end where, and how a shot is made for a value.

use super::scenes::{Ball, NEAR, Shot, aimed, at_angle, cloud, crowd, direction, scene, sized, tangent};
use rand_pcg::Pcg64Mcg;

/// One thing that is turned up.
#[derive(Clone, Copy)]
pub struct Sweep {
    /// Short, for files and anchors.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What stands under the axis.
    pub axis: &'static str,
    /// In a sentence: what is seen, and what stays as it is.
    pub what: &'static str,
    /// The values, in the order of the axis.
    pub values: fn() -> Vec<f64>,
    /// The value that is easy: from there it is counted where a method breaks, toward both ends.
    pub easy: f64,
    /// What is assumed up to where, by the paper or by arithmetic.
    pub marks: &'static [(f64, &'static str)],
    /// A shot for a value; `None` if there is none.
    pub shot: fn(f64, &mut Pcg64Mcg) -> Option<Shot>,
    /// Rays of a shot.
    pub rays: u64,
    /// Cells on each axis of the plans' grids, where these are not the plans' own.
    pub cells: Option<u8>,
}

/// Powers of ten from one to another, so many in a decade.
fn decades(from: i32, to: i32, each: i32) -> Vec<f64> {
    (from * each..=to * each).map(|k| 10f64.powf(f64::from(k) / f64::from(each))).collect()
}

const PICTURE: u64 = (super::scenes::SIDE * super::scenes::SIDE) as u64;

/// All of them that are made of shots.
pub const SWEEPS: [Sweep; 7] = [
    Sweep {
        name: "distance",
        title: "Distance of the eye",
        axis: "distance by radius",
        what: "One ball of a cloud fills the picture, from any side and ever farther away.",
        values: || decades(0, 8, 4).split_off(2),
        easy: 10.0,
        marks: &[(4096.0, "r² is less than an ulp of |f|²")],
        shot: |radii, rng| {
            let (balls, toward) = (cloud(rng), direction(rng));
            aimed(&balls, radii, toward, rng)
        },
        rays: PICTURE,
        cells: None,
    },
    Sweep {
        name: "scale",
        title: "Scale of the scene",
        axis: "radius of a ball",
        what: "The same from 20 radii away, all positions and radii multiplied.",
        values: || (-19..=18).map(|k| 10f64.powi(2 * k)).collect(),
        easy: 1.0,
        marks: &[],
        shot: |scale, rng| {
            let near = cloud(rng).into_iter();
            let balls: Vec<Ball> = near
                .map(|b| Ball { center: b.center.map(|x| scale * x), radius: scale * b.radius })
                .collect();
            let toward = direction(rng);
            aimed(&balls, NEAR, toward, rng)
        },
        rays: PICTURE,
        cells: None,
    },
    Sweep {
        name: "size",
        title: "Size of spheres in cells",
        axis: "diameter by cell",
        what: "Balls of one size in a grid of 16 cells on an axis, about two in a cell, from 20 radii away.",
        values: || {
            vec![
                0.01, 0.03, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 1.0, 1.05, 1.1, 1.25, 1.5, 1.75, 2.0, 2.5,
                3.0, 4.0,
            ]
        },
        easy: 0.1,
        marks: &[(1.0, "the paper: no larger than a cell")],
        shot: |ratio, rng| {
            let (balls, toward) = (sized(ratio, rng), direction(rng));
            aimed(&balls, NEAR, toward, rng)
        },
        rays: PICTURE,
        cells: Some(16),
    },
    Sweep {
        name: "crowd",
        title: "Spheres in a cell",
        axis: "ids in one cell",
        what: "Balls of half a cell's width, all inside one cell, from 20 radii away.",
        values: || vec![1.0, 2.0, 4.0, 8.0, 12.0, 14.0, 15.0, 16.0, 17.0, 18.0, 20.0, 24.0, 32.0, 48.0, 64.0],
        easy: 1.0,
        marks: &[(16.0, "the paper: sixteen slots")],
        shot: |count, rng| {
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a small whole number"
            )]
            let count = count as usize;
            crowded(count, 0.5, rng)
        },
        rays: PICTURE,
        cells: Some(16),
    },
    Sweep {
        name: "tangency",
        title: "Distance from tangency",
        axis: "units in the last place of the radius between ray and tangent",
        what: "One ray past one ball, 20 radii away, outside or inside of a tangent by so much.",
        values: || (0..=22).map(|k| 2f64.powi(k)).rev().collect(),
        easy: 4_194_304.0,
        marks: &[],
        shot: |ulps, rng| {
            use rand::RngExt;
            #[allow(clippy::cast_possible_truncation, reason = "small whole numbers")]
            let ulps = if rng.random() { ulps as i64 } else { -(ulps as i64) };
            tangent(ulps, rng)
        },
        rays: 1,
        cells: None,
    },
    Sweep {
        name: "angle",
        title: "Angle of the view to the axes",
        axis: "degrees from the nearest axis",
        what: "One ball of a cloud from 100 radii away, along an axis and away from it up to the diagonal.",
        values: || (0..=11).map(|k| 5.0 * f64::from(k)).map(|x| if x > 54.0 { 54.7356 } else { x }).collect(),
        easy: 0.0,
        marks: &[(45.0, "the diagonal of a face")],
        shot: |degrees, rng| {
            let (balls, toward) = (cloud(rng), at_angle(degrees, rng));
            aimed(&balls, 100.0, toward, rng)
        },
        rays: PICTURE,
        cells: None,
    },
    Sweep {
        name: "offset",
        title: "Offset from the origin",
        axis: "offset by radius",
        what: "One ball of a cloud from 20 radii away, cloud and eye moved away from the origin together.",
        values: || decades(0, 8, 2),
        easy: 1.0,
        marks: &[],
        shot: |offset, rng| {
            let by = direction(rng);
            let balls: Vec<Ball> = cloud(rng)
                .into_iter()
                .map(|b| Ball { center: [0, 1, 2].map(|i| b.center[i] + offset * by[i]), ..b })
                .collect();
            let toward = direction(rng);
            aimed(&balls, NEAR, toward, rng)
        },
        rays: PICTURE,
        cells: None,
    },
];

/// Diameters by cells, and ids in a cell: the two assumptions of the paper against each other.
pub const RATIOS: [f64; 9] = [0.1, 0.5, 0.9, 1.0, 1.1, 1.5, 2.0, 3.0, 4.0];
/// See [`RATIOS`].
pub const CROWDS: [usize; 8] = [1, 4, 8, 16, 17, 24, 32, 64];

/// A shot of both.
pub fn crowded(count: usize, ratio: f64, rng: &mut Pcg64Mcg) -> Option<Shot> {
    let (balls, toward) = (crowd(count, ratio, rng), direction(rng));
    let among = aimed(&balls[..count], NEAR, toward, rng)?;
    Some(Shot { scene: scene(&balls)?, ..among })
}
