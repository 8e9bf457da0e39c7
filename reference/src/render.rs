//! A picture: every pixel's ray, traced alone. Rows go to the threads as these become free.

use crate::{Hit, Ray, Undecided, double, exact, shade, single, spu_forms};
use contract::{Camera, Image, Scene, SizeError};
use rayon::prelude::*;
use thiserror::Error;

/// What decides whether, where and in which order a ray hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// The truth: exact, by integers wherever f64 intervals cannot decide.
    Exact,
    /// The truth, by integers alone, and far slower.
    ExactUnfiltered,
    /// b² − a q in f64.
    F64,
    /// b² − a q in f32.
    F32Textbook,
    /// r² minus the squared distance of the centre from the ray, in f32.
    F32Perpendicular,
    /// b² − a q in the single precision of the Cell's SPU.
    SpuTextbook,
    /// r² minus the squared distance of the centre from the ray, in that precision.
    SpuPerpendicular,
}

/// A naive tracer with its arithmetic and number of threads chosen.
#[derive(Clone, Copy, Debug)]
pub struct Tracer {
    arithmetic: Arithmetic,
    threads: usize,
}

/// A picture and how it came about.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// The picture.
    pub image: Image,
    /// For [`Arithmetic::Exact`], what its filter left undecided; otherwise zeros.
    pub undecided: Undecided,
}

/// Why there is no picture.
#[derive(Debug, Error)]
pub enum RenderError {
    /// No memory for it.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The system gave no threads.
    #[error("cannot start {threads} threads: {cause}")]
    Threads {
        /// How many were asked for; 0 is one a core.
        threads: usize,
        /// What the system said.
        cause: rayon::ThreadPoolBuildError,
    },
}

impl Tracer {
    /// A tracer that uses every core.
    #[must_use]
    pub fn new(arithmetic: Arithmetic) -> Self {
        Self { arithmetic, threads: 0 }
    }

    /// The same with so many threads; 0 means one a core. The picture does not depend on it.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// Renders a scene.
    ///
    /// # Errors
    /// [`RenderError`] if memory or threads cannot be had.
    pub fn render(&self, scene: &Scene, camera: &Camera) -> Result<Rendering, RenderError> {
        self.render_with(scene, camera, &|| ())
    }

    /// Renders a scene and calls `row_done` from any thread after each row.
    ///
    /// # Errors
    /// As [`Tracer::render`].
    pub fn render_with(
        &self,
        scene: &Scene,
        camera: &Camera,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Rendering, RenderError> {
        let mut image = Image::new(camera.size(), scene.background())?;
        let width = image.size.width() as usize;
        let row = |(y, ((ids, t), rgba))| {
            let undecided = self.row(scene, camera, y, Row { ids, t, rgba });
            row_done();
            undecided
        };
        let (ids, t, rgba) = (&mut image.ids, &mut image.t, &mut image.rgba);
        let undecided = if self.threads == 1 {
            let rows = ids.chunks_mut(width).zip(t.chunks_mut(width)).zip(rgba.chunks_mut(width));
            rows.enumerate().map(row).fold(Undecided::default(), |x, y| x + y)
        } else {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads).build();
            let pool = pool.map_err(|cause| RenderError::Threads { threads: self.threads, cause })?;
            let ids = ids.par_chunks_mut(width);
            let rows = ids.zip(t.par_chunks_mut(width)).zip(rgba.par_chunks_mut(width));
            pool.install(|| rows.enumerate().map(row).reduce(Undecided::default, |x, y| x + y))
        };
        Ok(Rendering { image, undecided })
    }

    /// The nearest hit of one ray.
    #[must_use]
    pub fn trace(&self, ray: &Ray, scene: &Scene) -> Option<Hit> {
        self.trace_counting(ray, scene, &mut Undecided::default())
    }

    /// The nearest hit of one ray; what the filter of [`Arithmetic::Exact`] leaves undecided is added up.
    #[must_use]
    pub fn trace_counting(&self, ray: &Ray, scene: &Scene, undecided: &mut Undecided) -> Option<Hit> {
        let spheres = scene.spheres();
        match self.arithmetic {
            Arithmetic::Exact => exact::nearest(ray, spheres, undecided),
            Arithmetic::ExactUnfiltered => exact::nearest_unfiltered(ray, spheres),
            Arithmetic::F64 => double::nearest(ray, spheres),
            Arithmetic::F32Textbook => single::nearest::<single::Textbook>(ray, spheres),
            Arithmetic::F32Perpendicular => single::nearest::<single::Perpendicular>(ray, spheres),
            Arithmetic::SpuTextbook => spu_forms::nearest(ray, spheres, spu_forms::textbook),
            Arithmetic::SpuPerpendicular => spu_forms::nearest(ray, spheres, spu_forms::perpendicular),
        }
    }

    fn row(&self, scene: &Scene, camera: &Camera, y: usize, row: Row<'_>) -> Undecided {
        let mut undecided = Undecided::default();
        let y = u32::try_from(y).expect("rows are below 2^14");
        for (x, i) in (0..camera.size().width()).zip(0..) {
            let ray = Ray::of_pixel(camera, x, y);
            if let Some(hit) = self.trace_counting(&ray, scene, &mut undecided) {
                (row.ids[i], row.t[i], row.rgba[i]) = (hit.id, hit.t, shade(scene, &ray, hit));
            }
        }
        undecided
    }
}

/// One row of each layer of the image.
struct Row<'a> {
    ids: &'a mut [u32],
    t: &'a mut [f32],
    rgba: &'a mut [[u8; 4]],
}
