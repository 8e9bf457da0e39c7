//! From bytes to spheres and what looks at them: rays and cameras that are free, or aimed at where it is close.

use super::bytes::Bytes;
use crate::directed::{KINDS, case};
use contract::{Camera, CameraError, DEFAULT_LIGHT, Scene, SceneError, Size, Sphere};
use reference::Ray;

/// A ray and up to so many spheres: as the bytes say, or one of the cases of [`crate::directed`] with some of its numbers moved
/// by a few ulp.
pub(super) fn rays_and_spheres(from: &mut Bytes<'_>, most: u8) -> (Ray, Vec<Sphere>) {
    let free = from.flag();
    if !free {
        let kind = from.one_of(&KINDS);
        let mut case = case(kind, &mut from.generator());
        case.spheres.truncate(usize::from(most));
        let mut numbers: Vec<&mut f32> = case.ray.eye.iter_mut().chain(&mut case.ray.dir).collect();
        for sphere in &mut case.spheres {
            numbers.extend(&mut sphere.center);
            numbers.push(&mut sphere.radius);
        }
        from.nudge(&mut numbers);
        return (case.ray, case.spheres);
    }
    let count = from.below(most + 1);
    let ray = Ray { eye: from.vector(), dir: from.vector() };
    (ray, (0..count).map(|_| from.sphere()).collect())
}

/// Up to so many spheres, and all of them again up to three times, each time moved by a whole number on one axis: the same ones in
/// the same place, or more than a cell or a tile's round holds.
pub(super) fn spheres(from: &mut Bytes<'_>, most: u8) -> Vec<Sphere> {
    let (count, copies, axis, step) = (from.below(most + 1), from.byte(), from.below(3), from.whole());
    let given: Vec<Sphere> = (0..count).map(|_| from.sphere()).collect();
    let mut all = given.clone();
    for copy in 1..=if copies < 128 { 0 } else { copies % 4 } {
        all.extend(given.iter().map(|sphere| {
            let mut sphere = *sphere;
            sphere.center[usize::from(axis)] += f32::from(copy) * f32::from(step);
            sphere
        }));
    }
    all
}

/// A scene of those spheres, or its typed refusal.
///
/// # Panics
/// If the contract refuses a scene that it must accept, or the other way round.
pub(super) fn scene(from: &mut Bytes<'_>, most: u8) -> Result<Scene, SceneError> {
    let all = spheres(from, most);
    let light = if from.flag() { from.vector() } else { DEFAULT_LIGHT };
    let finite = |x: &f32| x.to_bits() & 0x7f80_0000 != 0x7f80_0000;
    let valid = all.iter().all(|s| s.center.iter().all(finite) && finite(&s.radius) && s.radius > 0.0)
        && light.iter().all(finite);
    let scene = Scene::new(all, [7, 8, 9], light);
    assert_eq!(scene.is_ok(), valid, "what the contract says of {scene:?}");
    scene
}

/// A camera of up to 12x12 pixels: free, or with an axis each for its columns, its rows and its view, aimed at a sphere, whose
/// rim its pixels may be as fine as.
pub(super) fn camera(from: &mut Bytes<'_>, spheres: &[Sphere]) -> Result<Camera, CameraError> {
    let (width, height) = (from.below(12) + 1, from.below(12) + 1);
    let size = Size::new(width.into(), height.into()).unwrap_or_else(|e| panic!("{width}x{height}: {e}"));
    let (way, eye) = (from.byte(), from.vector());
    if way % 4 == 0 || spheres.is_empty() {
        return Camera::new(eye, from.vector(), from.vector(), from.vector(), size);
    }
    let aim = spheres[usize::from(from.byte()) % spheres.len()];
    let axes = from.one_of(&[[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]]);
    let (fine, rim, turn) = (from.below(24), from.whole(), from.flag());
    let step = aim.radius * 2f32.powi(2 - i32::from(fine));
    let (mut du, mut dv) = ([0.0; 3], [0.0; 3]);
    (du[axes[0]], dv[axes[1]]) = if turn { (-step, step) } else { (step, -step) };
    if way % 4 == 1 {
        // Askew: no component of a direction is the same for all pixels.
        (du[axes[2]], dv[axes[2]]) = (step / 3.0, step / 7.0);
    }
    let mut target = aim.center;
    target[axes[0]] += aim.radius * f32::from(rim) / 64.0;
    let half = [width, height].map(|n| f32::from(n) / 2.0);
    let corner = [0, 1, 2].map(|i| (target[i] - eye[i]) - (half[0] * du[i] + half[1] * dv[i]));
    Camera::new(eye, corner, du, dv, size)
}
