//! The reference as a contestant: one loop over all spheres per ray, in any of its arithmetics. It builds nothing, and gives colours.

use super::contestant::{Contestant, Frame, Kind, Layers, Oath};
use crate::subject::{Rounding, SubjectError};
use contract::{Camera, Image, Scene, Size};
use reference::{Arithmetic, Tracer};
use std::time::Duration;

/// The reference with its arithmetic and threads chosen; `rounding` is none of the exact one.
pub(crate) struct Naive {
    name: String,
    rounding: Option<Rounding>,
    tracer: Tracer,
    image: Image,
}

impl Naive {
    /// Before its first frame.
    ///
    /// # Errors
    /// If there is no memory for a pixel.
    pub(crate) fn new(name: &str, rounding: Option<Rounding>, threads: usize) -> Result<Self, SubjectError> {
        let arithmetic = rounding.map_or(Arithmetic::Exact, Rounding::naive);
        let image = Image::new(Size::new(1, 1)?, [0; 3])?;
        Ok(Self { name: name.into(), rounding, tracer: Tracer::new(arithmetic).threads(threads), image })
    }
}

impl Contestant for Naive {
    fn name(&self) -> &str {
        &self.name
    }

    fn description(&self) -> String {
        "one loop over all spheres per ray: ids, t and colours".into()
    }

    fn kind(&self) -> Kind {
        Kind::Naive
    }

    fn oath(&self) -> Oath {
        self.rounding.map_or(Oath::Exact, Oath::rounded)
    }

    fn frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Frame<'_>, SubjectError> {
        self.image = self.tracer.render(scene, camera)?.image;
        let Image { ids, t, rgba, .. } = &self.image;
        Ok(Frame { build: Duration::ZERO, took: None, layers: Layers { ids, t, rgba: Some(rgba) } })
    }
}
