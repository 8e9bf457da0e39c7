//! The reference: for each pixel its ray, for each ray one loop over all spheres. Nothing is skipped, nothing
//! is arranged; each file here is meant to be checked by eye against the rules of the crate `contract`.
//!
//! In: a checked [`contract::Scene`] and [`contract::Camera`], and the [`Arithmetic`] to decide with.
//! Out: a [`Rendering`]. Refused: nothing but an image that memory cannot hold, or a thread pool that the
//! system will not give.
//!
//! The simple program is [`Arithmetic::ExactUnfiltered`]: big integers for every decision. The one departure
//! from it is the filter of [`Arithmetic::Exact`], f64 intervals that decide most cases first and hand over
//! whatever they cannot decide. It makes the truth far cheaper and is tested against the simple
//! program. The other arithmetics are the usual roundings of the textbook, and the truncation of the Cell's [`spu`].
//!
//! Spheres are tried eight at once, which is for the compiler alone: it may put them side by side into registers, of AVX2 where
//! the processor has it. Every operation stays what it is and none is fused, so no result depends on it.
//!
//! Rows are traced in parallel; no row knows another, so the picture does not depend on threads.
//!
//! ```
//! use contract::{Camera, DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
//! use reference::{Arithmetic, Tracer};
//!
//! let sphere = Sphere { center: [0.0, 0.0, 0.0], radius: 1.0, color: [200, 80, 40] };
//! let scene = Scene::new(vec![sphere], [0, 0, 0], DEFAULT_LIGHT)?;
//! let size = Size::new(3, 3)?;
//! let camera = Camera::new([0.0, 0.0, 5.0], [-1.5, 1.5, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size)?;
//! let image = Tracer::new(Arithmetic::Exact).render(&scene, &camera)?.image;
//! assert_eq!(image.ids, [MISS, MISS, MISS, MISS, 0, MISS, MISS, MISS, MISS]);
//! assert_eq!(image.t[4], 4.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod double;
mod eights;
mod exact;
mod interval;
mod ray;
mod render;
mod root;
mod shade;
mod single;
pub mod spu;
mod spu_forms;

pub use ray::Ray;
pub use render::{Arithmetic, RenderError, Rendering, Tracer};
pub use shade::shade;

/// A ray's nearest sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the sphere.
    pub id: u32,
    /// Ray parameter, rounded to f32 as the arithmetic in use prescribes.
    pub t: f32,
}

/// How often the filter of [`Arithmetic::Exact`] could not decide and integers did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Undecided {
    /// Whether a sphere is hit, and at which root.
    pub hits: u64,
    /// Which of two roots is smaller.
    pub orders: u64,
    /// Which f32 is nearest to the root.
    pub roundings: u64,
}

impl std::ops::Add for Undecided {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            hits: self.hits + other.hits,
            orders: self.orders + other.orders,
            roundings: self.roundings + other.roundings,
        }
    }
}
