//! Embree as a contestant, in one of its ways ([`Mode`]): it gives ids and t, no colours, and its loop is as lean as this
//! project could make it ([`Animated`]).

use super::contestant::{Contestant, Frame, Kind, Layers, Oath};
use crate::embree::{Animated, Device, Mode};
use crate::judge::band::embree_band;
use crate::subject::SubjectError;
use contract::{Camera, MISS, Scene};
use std::time::Instant;

/// Embree with its way, camera and threads chosen.
pub(crate) struct Entrant {
    name: String,
    description: String,
    animated: Animated,
    threads: usize,
    ids: Vec<u32>,
    t: Vec<f32>,
}

/// What the contestant of a way is called.
pub(super) fn name(mode: Mode) -> String {
    format!("embree-{mode}")
}

impl Entrant {
    /// Lays out its rays.
    #[must_use]
    pub(super) fn new(device: &Device, mode: Mode, camera: &Camera, threads: usize) -> Self {
        Self::named(name(mode), device, mode, camera, threads)
    }

    /// The same under another name.
    #[must_use]
    pub(crate) fn named(name: String, device: &Device, mode: Mode, camera: &Camera, threads: usize) -> Self {
        let pixels = camera.size().pixels();
        Self {
            name,
            description: format!(
                "Embree {} at {}: ids and t, its tree built again in every frame; directions laid out before",
                device.version(),
                device.isa()
            ),
            animated: Animated::new(device, mode, camera),
            threads,
            ids: vec![MISS; pixels],
            t: vec![f32::INFINITY; pixels],
        }
    }
}

impl Contestant for Entrant {
    fn name(&self) -> &str {
        &self.name
    }

    fn description(&self) -> String {
        self.description.clone()
    }

    fn kind(&self) -> Kind {
        Kind::Embree
    }

    fn oath(&self) -> Oath {
        Oath::Within(embree_band)
    }

    fn frame(&mut self, scene: &Scene, _: &Camera) -> Result<Frame<'_>, SubjectError> {
        let start = Instant::now();
        self.animated.build(scene)?;
        let build = start.elapsed();
        self.animated.trace(self.threads, &mut self.ids, &mut self.t)?;
        Ok(Frame { build, took: None, layers: Layers { ids: &self.ids, t: &self.t, rgba: None } })
    }
}
