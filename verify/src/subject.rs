//! What is judged: any tracer that takes a scene and a camera and gives an image, with its promise.

use contract::{Camera, Image, Scene};
use reference::Arithmetic;

/// What a subject says of its own answers. A judge holds it to that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Promise {
    /// The picture is the truth, bit for bit.
    Exact,
    /// Every answer is one that rounding in this form can explain.
    Rounded(Rounding),
    /// As `Rounded`, and the picture is bit for bit that of the reference's naive tracer in the same form.
    EqualToNaive(Rounding),
}

/// The forms whose error bounds the judge knows ([`crate::judge::band`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounding {
    /// b² − a q in f64.
    TextbookF64,
    /// b² − a q in f32.
    TextbookF32,
    /// r² minus the squared distance of the centre from the ray, in f32.
    PerpendicularF32,
}

impl Rounding {
    /// The reference's arithmetic of this form.
    #[must_use]
    pub fn naive(self) -> Arithmetic {
        match self {
            Self::TextbookF64 => Arithmetic::F64,
            Self::TextbookF32 => Arithmetic::F32Textbook,
            Self::PerpendicularF32 => Arithmetic::F32Perpendicular,
        }
    }
}

impl Promise {
    /// The promise in words, for the report.
    #[must_use]
    pub fn words(self) -> String {
        let form = |rounding| match rounding {
            Rounding::TextbookF64 => "the textbook form in f64",
            Rounding::TextbookF32 => "the textbook form in f32",
            Rounding::PerpendicularF32 => "the perpendicular form in f32",
        };
        match self {
            Self::Exact => "the truth, bit for bit".into(),
            Self::Rounded(rounding) => format!("within the rounding of {}", form(rounding)),
            Self::EqualToNaive(rounding) => {
                format!("bit for bit the naive picture of {}, hence within its rounding", form(rounding))
            }
        }
    }
}

/// Why a subject gave no picture.
pub type SubjectError = Box<dyn std::error::Error + Send + Sync>;

/// A tracer under test.
pub trait Subject: Sync {
    /// Short and unique, for tables and file names.
    fn name(&self) -> &'static str;

    /// One sentence: what it is.
    fn description(&self) -> &'static str;

    /// What it is held to.
    fn promise(&self) -> Promise;

    /// Renders with so many threads and calls `row_done` now and then, once a row in all.
    ///
    /// # Errors
    /// Whatever keeps it from giving a picture. That is reported as not judged, never as a pass.
    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Image, SubjectError>;
}

/// The reference in one of its roundings.
#[derive(Clone, Copy, Debug)]
pub struct Naive(pub Rounding);

impl Subject for Naive {
    fn name(&self) -> &'static str {
        match self.0 {
            Rounding::TextbookF64 => "naive-f64",
            Rounding::TextbookF32 => "naive-f32-textbook",
            Rounding::PerpendicularF32 => "naive-f32-perpendicular",
        }
    }

    fn description(&self) -> &'static str {
        match self.0 {
            Rounding::TextbookF64 => "one loop over all spheres per ray, b² − ac in f64",
            Rounding::TextbookF32 => "one loop over all spheres per ray, b² − ac in f32",
            Rounding::PerpendicularF32 => {
                "one loop over all spheres per ray, distance of the centre from the ray in f32"
            }
        }
    }

    fn promise(&self) -> Promise {
        Promise::Rounded(self.0)
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Image, SubjectError> {
        let tracer = reference::Tracer::new(self.0.naive()).threads(threads);
        Ok(tracer.render_with(scene, camera, row_done)?.image)
    }
}

/// The grid tracer of `optimized`.
#[derive(Clone, Copy, Debug)]
pub struct Grid;

impl Subject for Grid {
    fn name(&self) -> &'static str {
        "grid"
    }

    fn description(&self) -> &'static str {
        "packets of 4x4 rays through a uniform grid rebuilt for the frame, perpendicular form in f32"
    }

    fn promise(&self) -> Promise {
        Promise::EqualToNaive(Rounding::PerpendicularF32)
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Image, SubjectError> {
        let tracer =
            optimized::Tracer::new(optimized::Plan::safe(), optimized::Level::best()?).workers(threads);
        let rendering = tracer.render(scene, camera)?;
        (0..camera.size().height()).for_each(|_| row_done());
        Ok(rendering.image)
    }
}

/// Every subject that `cgt verify` judges when none is named, in the order of the report.
pub static SUBJECTS: [&dyn Subject; 4] =
    [&Naive(Rounding::TextbookF64), &Naive(Rounding::PerpendicularF32), &Naive(Rounding::TextbookF32), &Grid];
