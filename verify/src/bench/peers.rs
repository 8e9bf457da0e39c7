//! The crates `bvh` and `parry3d` as contestants: they give ids and t, no colours, one ray at a time as their interfaces have
//! it, the tree made anew in every frame.

use super::contestant::{Contestant, Frame, Kind, Layers, Oath};
use super::outsiders::Outsider;
use crate::peers::{BvhSearch, ParrySearch};
use crate::subject::{Rounding, SubjectError};
use contract::{Camera, MISS, Scene};
use reference::{Hit, Ray};
use std::sync::Mutex;
use std::time::Instant;

/// The contestant of a crate; of Embree there is none here, and `bvh` stands in.
#[must_use]
pub(crate) fn entrant(peer: Outsider, camera: &Camera, threads: usize) -> Box<dyn Contestant> {
    let pixels = camera.size().pixels();
    Box::new(Entrant { peer, threads, ids: vec![MISS; pixels], t: vec![f32::INFINITY; pixels] })
}

struct Entrant {
    peer: Outsider,
    threads: usize,
    ids: Vec<u32>,
    t: Vec<f32>,
}

impl Contestant for Entrant {
    fn name(&self) -> &str {
        self.peer.name()
    }

    fn description(&self) -> String {
        format!("the crate `{}`: ids and t, its tree built again in every frame", self.peer.name())
    }

    fn kind(&self) -> Kind {
        Kind::Peer
    }

    fn oath(&self) -> Oath {
        Oath::rounded(match self.peer {
            Outsider::Parry3d => Rounding::TextbookF32,
            _ => Rounding::TextbookF64,
        })
    }

    fn frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Frame<'_>, SubjectError> {
        let start = Instant::now();
        let build = if self.peer == Outsider::Parry3d {
            let search = ParrySearch::new(scene, camera);
            let build = start.elapsed();
            self.trace(camera, |ray| search.nearest(scene, ray));
            build
        } else {
            let search = BvhSearch::new(scene, camera);
            let build = start.elapsed();
            self.trace(camera, |ray| search.nearest(ray));
            build
        };
        Ok(Frame { build, took: None, layers: Layers { ids: &self.ids, t: &self.t, rgba: None } })
    }
}

impl Entrant {
    /// Rows go to the threads as these become free.
    fn trace(&mut self, camera: &Camera, nearest: impl Fn(&Ray) -> Option<Hit> + Sync) {
        let width = camera.size().width() as usize;
        let rows = Mutex::new((0..).zip(self.ids.chunks_mut(width).zip(self.t.chunks_mut(width))));
        let next = || rows.lock().expect("no thread panics while it holds the list").next();
        let work = || {
            while let Some((y, (ids, t))) = next() {
                for (x, (id, t)) in (0..).zip(ids.iter_mut().zip(t)) {
                    let hit = nearest(&Ray::of_pixel(camera, x, y));
                    (*id, *t) = hit.map_or((MISS, f32::INFINITY), |hit| (hit.id, hit.t));
                }
            }
        };
        if self.threads <= 1 {
            return work();
        }
        std::thread::scope(|scope| (0..self.threads).for_each(|_| _ = scope.spawn(work)));
    }
}
