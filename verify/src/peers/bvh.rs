//! The crate `bvh`: its tree and its ray-box test, in f64. It leaves the primitive to its user, so the root is computed here,
//! b² − a q in f64, and what it witnesses is that the search loses nothing.
//!
//! Its box test rounds three times a face, so by less than 2⁻⁴⁰ of the largest coordinate, which is what the boxes are
//! larger by.

use super::{picture, reach};
use crate::subject::{Promise, Rendered, Rounding, Subject, SubjectError};
use ::bvh::aabb::{Aabb, Bounded};
use ::bvh::bounding_hierarchy::BHShape;
use ::bvh::bvh::Bvh;
use contract::{Camera, Scene, Sphere};
use nalgebra::{Point3, Vector3};
use reference::{Hit, Ray};

/// The crate `bvh` with spheres as its shapes.
#[derive(Clone, Copy, Debug)]
pub struct BvhCrate;

struct Shape {
    id: u32,
    sphere: Sphere,
    margin: f64,
    node: usize,
}

impl Shape {
    fn center(&self) -> Point3<f64> {
        Point3::from(self.sphere.center.map(f64::from))
    }
}

impl Bounded<f64, 3> for Shape {
    fn aabb(&self) -> Aabb<f64, 3> {
        let half = Vector3::repeat(f64::from(self.sphere.radius) + self.margin);
        Aabb::with_bounds(self.center() - half, self.center() + half)
    }
}

impl BHShape<f64, 3> for Shape {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Subject for BvhCrate {
    fn name(&self) -> &str {
        "bvh"
    }

    fn description(&self) -> &str {
        "the tree of the crate `bvh` in f64, roots by b² − ac"
    }

    fn promise(&self) -> Promise {
        Promise::Rounded(Rounding::TextbookF64)
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Rendered, SubjectError> {
        let search = Search::new(scene, camera);
        picture(scene, camera, threads, row_done, |ray| search.nearest(ray))
    }
}

/// The tree over a scene.
pub(crate) struct Search {
    tree: Bvh<f64, 3>,
    shapes: Vec<Shape>,
}

impl Search {
    pub(crate) fn new(scene: &Scene, camera: &Camera) -> Self {
        let margin = reach(scene, camera) * 2f64.powi(-40);
        let shape = |(id, sphere): (u32, &Sphere)| Shape { id, sphere: *sphere, margin, node: 0 };
        let mut shapes: Vec<Shape> = (0..).zip(scene.spheres()).map(shape).collect();
        Self { tree: Bvh::build(&mut shapes), shapes }
    }

    pub(crate) fn nearest(&self, ray: &Ray) -> Option<Hit> {
        nearest(&self.tree, &self.shapes, ray)
    }
}

/// The nearest of the shapes whose boxes the ray crosses, the lowest id among equals.
fn nearest(tree: &Bvh<f64, 3>, shapes: &[Shape], ray: &Ray) -> Option<Hit> {
    let (eye, dir) = (Point3::from(ray.eye.map(f64::from)), Vector3::from(ray.dir.map(f64::from)));
    let query = ::bvh::ray::Ray::new(eye, dir);
    let crossed = tree.traverse_iterator(&query, shapes);
    let hits = crossed.filter_map(|shape| Some((root(eye, dir, shape)?, shape.id)));
    let (t, id) = hits.min_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)))?;
    #[allow(clippy::cast_possible_truncation, reason = "the one rounding of t that rule 5 prescribes")]
    Some(Hit { id, t: t as f32 })
}

fn root(eye: Point3<f64>, dir: Vector3<f64>, shape: &Shape) -> Option<f64> {
    let (f, r) = (eye - shape.center(), f64::from(shape.sphere.radius));
    let (a, b, q) = (dir.norm_squared(), f.dot(&dir), f.norm_squared() - r * r);
    let s = (b * b - a * q).sqrt();
    [(-b - s) / a, (-b + s) / a].into_iter().find(|t| *t > 0.0)
}
