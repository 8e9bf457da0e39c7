//! *Hit => visible* on any small scene: what is hit lies in a cell that is visited and lists the sphere, and culling keeps it.

use super::bytes::Bytes;
use super::plan::{ARITHMETICS, VOXELIZERS};
use super::voxelize::build;
use super::{listed, view};
use crate::visible::{hits_are_visible, rays_are_walked};
use optimized::plan::{Cells, Plan, Resolution};

/// Up to five spheres are seen from a camera of up to 12x12 pixels with a grid of up to eight cells on an axis: [`hits_are_visible`]
/// for every ray and sphere, and [`rays_are_walked`] for some points of every ray. Hits and points are judged.
///
/// # Panics
/// If something that is hit is not visible.
pub fn visible(bytes: &[u8]) -> u64 {
    let mut from = Bytes(bytes);
    let (n, fixed) = (from.below(8) + 1, from.flag());
    let plan = Plan {
        voxelizer: from.one_of(&VOXELIZERS),
        cells: from.one_of(&[Cells::Queue, Cells::Lists]),
        arithmetic: from.one_of(&ARITHMETICS),
        resolution: if fixed { Resolution::Fixed(n) } else { Resolution::UpTo(n) },
        ..Plan::safe()
    };
    let (level, mut rng) = (from.level(), from.generator());
    let Ok(scene) = view::scene(&mut from, 5) else { return 0 };
    let Ok(camera) = view::camera(&mut from, scene.spheres()) else { return 0 };
    let seen = build(level, plan, &scene, &camera);
    let checked = seen.map_err(|error| error.to_string()).and_then(|seen| {
        Ok(hits_are_visible(&seen, &scene, &camera)? + rays_are_walked(&seen, &scene, &camera, &mut rng)?)
    });
    match checked {
        Ok(checked) => checked.hits + checked.points,
        Err(why) => panic!("{why}; {level}, {camera:?}{}", listed(scene.spheres())),
    }
}
