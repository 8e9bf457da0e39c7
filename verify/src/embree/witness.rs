//! Embree as the outside judge: asked at every instruction set that the processor has and at every width.

use super::device::{Device, Isa};
use super::error::EmbreeError;
use super::fault::Fault;
use super::tracer::{Build, Tracer, Width};
use crate::judge::band::{Band, embree_band};
use crate::judge::outside::{Testimony, Witness};
use crate::subject::SubjectError;
use contract::{Camera, MISS, Scene, Sphere};
use rayon::prelude::*;
use reference::Ray;

/// Embree at several instruction sets.
#[derive(Clone, Debug)]
pub struct Embree {
    devices: Vec<Device>,
    fault: Fault,
}

impl Embree {
    /// Embree at every instruction set there is.
    ///
    /// # Errors
    /// [`EmbreeError`] if the library fails at any of them.
    pub fn new() -> Result<Self, EmbreeError> {
        let devices = Isa::available().into_iter().map(|isa| Device::new(isa, 1));
        Ok(Self { devices: devices.collect::<Result<_, _>>()?, fault: Fault::None })
    }

    /// The same with a fault planted after the devices were checked.
    #[must_use]
    pub fn spoilt(&self, fault: Fault) -> Self {
        Self { fault, ..self.clone() }
    }

    /// The instruction sets that it is asked at.
    #[must_use]
    pub fn devices(&self) -> &[Device] {
        &self.devices
    }
}

impl Witness for Embree {
    fn name(&self) -> String {
        let version = self.devices.first().map(|device| device.version().to_string());
        format!("Embree {}", version.unwrap_or_default())
    }

    fn band(&self, ray: &Ray, sphere: &Sphere) -> Option<Band> {
        embree_band(ray, sphere)
    }

    fn testify(&self, scene: &Scene, camera: &Camera) -> Result<Vec<Testimony>, SubjectError> {
        let at = |device: &Device| -> Result<Vec<Testimony>, EmbreeError> {
            let tracer = Tracer::with_fault(device, scene, Build::Robust, self.fault)?;
            let picture = |width: Width| {
                let pixels = camera.size().pixels();
                let (mut ids, mut t) = (vec![MISS; pixels], vec![f32::INFINITY; pixels]);
                tracer.render(camera, width, &mut ids, &mut t)?;
                Ok(Testimony { mode: format!("{}, {width} wide", device.isa()), ids, t })
            };
            Width::ALL.into_iter().map(picture).collect()
        };
        let testimonies: Result<Vec<_>, _> = self.devices.par_iter().map(at).collect();
        Ok(testimonies?.concat())
    }
}
