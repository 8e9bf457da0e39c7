//! The crate `parry3d`: its tree, its ray-box test and its own ray-ball test, all in f32; so its promise is the textbook
//! form in f32, which that test is.
//!
//! Its box test rounds three times a face, so by less than 2⁻¹⁸ of the largest coordinate, which is what the boxes are larger
//! by. It takes t = 0 for a hit and the contract does not.

use super::{picture, reach};
use crate::subject::{Promise, Rendered, Rounding, Subject, SubjectError};
use contract::{Camera, Scene, Sphere};
use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use parry3d::query::details::ray_toi_with_ball;
use reference::{Hit, Ray};

/// The crate `parry3d` with balls as its shapes.
#[derive(Clone, Copy, Debug)]
pub struct Parry;

impl Subject for Parry {
    fn name(&self) -> &str {
        "parry3d"
    }

    fn description(&self) -> &str {
        "tree and balls of the crate `parry3d`, b² − ac in f32"
    }

    fn promise(&self) -> Promise {
        Promise::Rounded(Rounding::TextbookF32)
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Rendered, SubjectError> {
        let search = Search::new(scene, camera);
        picture(scene, camera, threads, row_done, |ray| search.nearest(scene, ray))
    }
}

/// The tree over a scene.
pub(crate) struct Search(Bvh);

impl Search {
    pub(crate) fn new(scene: &Scene, camera: &Camera) -> Self {
        let margin = reach(scene, camera) * 2f64.powi(-18);
        #[allow(clippy::cast_possible_truncation, reason = "far less than the margin")]
        let aabb = |s: &Sphere| {
            let half = Vector::splat((f64::from(s.radius) + margin) as f32);
            Aabb::new(Vector::from(s.center) - half, Vector::from(s.center) + half)
        };
        let boxes: Vec<Aabb> = scene.spheres().iter().map(aabb).collect();
        Self(Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes))
    }

    /// `scene` is the one that the tree is over.
    pub(crate) fn nearest(&self, scene: &Scene, ray: &Ray) -> Option<Hit> {
        let ray = parry3d::query::Ray::new(ray.eye.into(), ray.dir.into());
        let hit = self.0.cast_ray(&ray, f32::MAX, |id, _| {
            let ball = &scene.spheres()[id as usize];
            ray_toi_with_ball(ball.center.into(), ball.radius, &ray, false).1.filter(|t| *t > 0.0)
        });
        hit.map(|(id, t)| Hit { id, t })
    }
}
