//! Random spheres in the unit cube. A count and a seed come in, spheres come out. The radius falls with the
//! cube root of the count, so that pictures of 10 and of 10 million spheres look alike.
//!
//! The normal distribution is the sum of twelve uniform numbers less 6: mean 0, variance 1, nothing beyond 6
//! standard deviations. It needs no logarithm, whose last bit differs between machines.

use contract::{Rgb, Sphere};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Colours that can be told apart, also by the colour-blind (after Okabe and Ito), and lightened.
#[rustfmt::skip]
const COLORS: [Rgb; 8] = [
    [235, 170, 40], [100, 185, 240], [40, 170, 130], [242, 230, 90],
    [80, 130, 210], [222, 110, 40], [212, 140, 180], [225, 225, 225],
];

pub(super) fn uniform(spheres: &mut Vec<Sphere>, count: usize, seed: u64) {
    let mut random = Pcg64::seed_from_u64(seed);
    let largest = 0.5 / cube_root(count as f64);
    for _ in 0..count {
        let center = std::array::from_fn(|_| unit(&mut random));
        spheres.push(sphere(&mut random, center, largest));
    }
}

pub(super) fn clump(spheres: &mut Vec<Sphere>, count: usize, seed: u64) {
    let mut random = Pcg64::seed_from_u64(seed);
    let largest = 0.25 / cube_root(count as f64);
    for _ in 0..count {
        let center = std::array::from_fn(|_| 0.5 + 0.125 * normal(&mut random));
        spheres.push(sphere(&mut random, center, largest));
    }
}

/// Half the largest radius up to all of it, of one of eight colours.
fn sphere(random: &mut Pcg64, center: [f64; 3], largest: f64) -> Sphere {
    let radius = largest * (0.5 + 0.5 * unit(random));
    let color = COLORS[(random.next_u64() >> 61) as usize];
    Sphere { center: center.map(|x| x as f32), radius: radius as f32, color }
}

/// From 0 to below 1, a multiple of 2^-53.
fn unit(random: &mut Pcg64) -> f64 {
    const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
    (random.next_u64() >> 11) as f64 * STEP
}

fn normal(random: &mut Pcg64) -> f64 {
    (0..12).map(|_| unit(random)).sum::<f64>() - 6.0
}

/// By Newton's method from above, with operations that are the same everywhere; 1 for 0.
fn cube_root(x: f64) -> f64 {
    let mut root = x.max(1.0);
    for _ in 0..128 {
        root -= (root - x.max(1.0) / (root * root)) / 3.0;
    }
    root
}
