//! Two tracers of other people as [`Subject`](crate::subject::Subject)s, judged against the truth like any other: the crates `bvh` and `parry3d`. They cost
//! little and share no search with this project.
//!
//! In: a scene and a camera. Out: a picture whose ids and t are the peer's; a peer has no colours, so the reference's rule 4
//! paints what it found. Both are given boxes a little larger than the spheres, so that what they promise is the rounding
//! of the root alone, and a sphere that their search loses is wrong. A third, [`tachyon`], is a program that gives pictures
//! only, and is asked if it is installed.

mod bvh;
mod parry;
pub mod tachyon;

pub use self::bvh::BvhCrate;
pub(crate) use self::bvh::Search as BvhSearch;
pub use parry::Parry;
pub(crate) use parry::Search as ParrySearch;

use crate::subject::{Rendered, SubjectError};
use contract::{Camera, Image, Scene, Sphere};
use rayon::prelude::*;
use reference::{Hit, Ray, shade};

/// A picture by a function that finds the nearest hit of a ray.
fn picture(
    scene: &Scene,
    camera: &Camera,
    threads: usize,
    row_done: &(dyn Fn() + Sync),
    nearest: impl Fn(&Ray) -> Option<Hit> + Sync,
) -> Result<Rendered, SubjectError> {
    let mut image = Image::new(camera.size(), scene.background())?;
    let width = image.size.width() as usize;
    let rows = image.ids.par_chunks_mut(width).zip(image.t.par_chunks_mut(width));
    let rows = (0..camera.size().height()).into_par_iter().zip(rows).zip(image.rgba.par_chunks_mut(width));
    rayon::ThreadPoolBuilder::new().num_threads(threads).build()?.install(|| {
        rows.for_each(|((y, (ids, t)), rgba)| {
            for (x, i) in (0..camera.size().width()).zip(0..) {
                let ray = Ray::of_pixel(camera, x, y);
                if let Some(hit) = nearest(&ray) {
                    (ids[i], t[i], rgba[i]) = (hit.id, hit.t, shade(scene, &ray, hit));
                }
            }
            row_done();
        });
    });
    Ok(Rendered { image, notes: Vec::new(), took: None })
}

/// The largest coordinate in play, eye and spheres: what rounding in a box test is relative to.
fn reach(scene: &Scene, camera: &Camera) -> f64 {
    let far =
        |s: &Sphere| s.center.iter().map(|x| f64::from(x.abs()) + f64::from(s.radius)).fold(0.0, f64::max);
    let eye = camera.eye().into_iter().map(|x| f64::from(x.abs())).fold(0.0, f64::max);
    scene.spheres().iter().map(far).fold(eye, f64::max)
}
