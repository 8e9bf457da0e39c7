//! Coherent grid traversal of sphere scenes, after Chapman 2007 and Wald et al. 2006.
//!
//! In: a checked [`contract::Scene`] and [`contract::Camera`]. Out: a [`contract::Image`], bit for bit what one
//! loop over all spheres per ray would give in the same arithmetic ([`Form`]).
//!
//! The simple program is that loop. The departures from it, each in its module, in the order in which data
//! flows: sixteen rays share each decision ([`machine`], [`camera`], [`sphere`]); a grid lists the spheres of
//! each cell ([`margin`], [`grid`]); a packet meets only the cells its frustum overlaps ([`frustum`], [`walk`]);
//! colours are computed for a block at once ([`shade`]); stripes of the image go to workers ([`frame`]).
//!
//! Kernels are generic over [`machine::Machine`] and free of memory access; the machines of the host are in
//! [`host`].
//!
//! ```
//! use contract::{Camera, DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
//! use optimized::{Form, Tracer};
//!
//! let sphere = Sphere { center: [0.0, 0.0, 0.0], radius: 1.0, color: [200, 80, 40] };
//! let scene = Scene::new(vec![sphere], [0, 0, 0], DEFAULT_LIGHT)?;
//! let size = Size::new(3, 3)?;
//! let camera = Camera::new([0.0, 0.0, 5.0], [-1.5, 1.5, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size)?;
//! let image = Tracer::new(Form::Perpendicular).render(&scene, &camera)?;
//! assert_eq!(image.ids, [MISS, MISS, MISS, MISS, 0, MISS, MISS, MISS, MISS]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod machine;

pub mod camera;
pub mod sphere;

pub mod margin;

pub mod grid;

pub mod frustum;
pub mod walk;

pub mod shade;

pub mod frame;

pub mod host;

pub use sphere::Form;

use contract::{Camera, Image, Scene, SizeError};

/// A grid tracer with its arithmetic and number of workers chosen.
#[derive(Clone, Copy, Debug)]
pub struct Tracer {
    form: Form,
    workers: usize,
}

impl Tracer {
    /// A tracer with one worker.
    #[must_use]
    pub fn new(form: Form) -> Self {
        Self { form, workers: 1 }
    }

    /// The same with so many workers, at least one. The picture does not depend on it.
    #[must_use]
    pub fn workers(self, workers: usize) -> Self {
        Self { workers, ..self }
    }

    /// Renders a scene, grid building included.
    ///
    /// # Errors
    /// [`SizeError::NoMemory`] if the image cannot be had.
    pub fn render(&self, scene: &Scene, camera: &Camera) -> Result<Image, SizeError> {
        frame::render(host::Scalar, self.form, scene, camera, self.workers)
    }
}
