//! Instability without any truth: a scene changed so that nothing should change, and how often a method then sees another sphere than
//! before. Each change is exact in f32, so that it is the same scene to the last bit.

use super::scenes::{Shot, aimed, cloud, direction};
use contract::{Camera, Scene, Sphere};
use rand_pcg::Pcg64Mcg;

/// A change that is turned up, or whose scene is.
#[derive(Clone, Copy)]
pub struct Relation {
    /// Short, for files and anchors.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What stands under the axis.
    pub axis: &'static str,
    /// In a sentence.
    pub what: &'static str,
    /// The values.
    pub values: fn() -> Vec<f64>,
    /// The value from which it is counted where a method breaks.
    pub easy: f64,
    /// A shot and the same one changed; `None` if the change is not exact there.
    pub pair: fn(f64, &mut Pcg64Mcg) -> Option<[Shot; 2]>,
}

/// All of them.
pub const RELATIONS: [Relation; 3] = [
    Relation {
        name: "turned",
        title: "Turned by 90 degrees",
        axis: "distance by radius",
        what: "One ball of a cloud, and all of it turned by a quarter about the x axis: what was y is z, what was z is −y. Sums of three squares are then added in another order.",
        values: || (2..=16).map(|k| 10f64.powf(f64::from(k) / 2.0)).collect(),
        easy: 10.0,
        pair: |radii, rng| {
            let (balls, toward) = (cloud(rng), direction(rng));
            let shot = aimed(&balls, radii, toward, rng)?;
            let turn = |v: [f32; 3]| [v[0], -v[2], v[1]];
            let turned = changed(&shot, turn, turn, 1.0)?;
            Some([shot, turned])
        },
    },
    Relation {
        name: "moved",
        title: "Moved as a whole",
        axis: "radii moved along each axis",
        what: "One ball of a cloud on a lattice of 1/64, from 20 radii away, and all of it moved by a power of two.",
        values: || (0..=17).map(|k| 2f64.powi(k)).collect(),
        easy: 1.0,
        pair: |by, rng| {
            let toward = direction(rng);
            let shot = on_lattice(&aimed(&cloud(rng), super::scenes::NEAR, toward, rng)?)?;
            #[allow(clippy::cast_possible_truncation, reason = "a power of two")]
            let by = by as f32;
            let moved = changed(&shot, |v| v.map(|x| x + by), |v| v, 1.0)?;
            Some([shot, moved])
        },
    },
    Relation {
        name: "scaled",
        title: "Scaled by powers of two",
        axis: "times as large",
        what: "One ball of a cloud from 20 radii away, and all positions and radii times a power of two.",
        values: || (-15..=15).map(|k| 2f64.powi(8 * k)).collect(),
        easy: 1.0,
        pair: |by, rng| {
            let toward = direction(rng);
            let shot = on_lattice(&aimed(&cloud(rng), super::scenes::NEAR, toward, rng)?)?;
            #[allow(clippy::cast_possible_truncation, reason = "a power of two")]
            let by = by as f32;
            let scaled = changed(&shot, |v| v.map(|x| x * by), |v| v, by)?;
            Some([shot, scaled])
        },
    },
];

/// Positions rounded to the lattice of 1/64, where sums with small powers of two are exact.
fn on_lattice(shot: &Shot) -> Option<Shot> {
    changed(shot, |v| v.map(|x| (x * 64.0).round() / 64.0), |v| v, 1.0)
}

/// A shot with its positions, its directions and its radii changed.
fn changed(
    shot: &Shot,
    position: impl Fn([f32; 3]) -> [f32; 3],
    direction: impl Fn([f32; 3]) -> [f32; 3],
    radius: f32,
) -> Option<Shot> {
    let moved = |s: &Sphere| Sphere { center: position(s.center), radius: s.radius * radius, ..*s };
    let (old, scene) = (&shot.camera, &shot.scene);
    let [corner, du, dv] = [old.corner(), old.du(), old.dv()].map(direction);
    Some(Shot {
        scene: Scene::new(scene.spheres().iter().map(moved).collect(), scene.background(), scene.light())
            .ok()?,
        camera: Camera::new(position(old.eye()), corner, du, dv, old.size()).ok()?,
    })
}

#[cfg(test)]
mod tests {
    use super::{RELATIONS, Relation};
    use crate::seed::generator;
    use reference::{Arithmetic, Tracer};

    /// The exact tracer sees the same sphere before and after, or the change is not exact.
    #[test]
    fn changes_are_exact() {
        for Relation { name, values, pair, .. } in RELATIONS {
            let mut held = 0;
            for (k, value) in (0..).zip(values()) {
                let Some(two) = pair(value, &mut generator(7, k)) else { continue };
                let [before, after] = two.map(|shot| {
                    Tracer::new(Arithmetic::Exact).render(&shot.scene, &shot.camera).expect("small").image
                });
                assert_eq!(before.ids, after.ids, "{name} at {value}");
                held += 1;
            }
            assert!(held > 10, "{name}: {held} pairs");
        }
    }
}
