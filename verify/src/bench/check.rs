//! Whether a contestant may be timed: its layers against the exact picture, and every difference against its oath.
//!
//! Who promised the truth is wrong by the first bit that differs. Of the others a pixel counts as differing if it shows
//! another sphere, and as wrong if its rounding explains neither that nor its t, or if it has been painted and its colour is
//! not that of its id and t. Embree, asked as its users ask it, crosses boxes without a margin and may lose a ray on an
//! edge between two of them; to leave it out for that would leave out its fastest ways, in favour of the tracer under
//! test. So of those who are not the subject one pixel in [`ALLOWED`] may be wrong, and how many are is reported.
//!
//! Where a sphere is so small or so far that a form states nothing of it, any answer would pass. So of anybody one pixel in
//! [`ALLOWED`] may go without a statement, or its picture was not checked, and it is not timed.

use super::contestant::{Kind, Layers, Oath};
use crate::judge::band::{Band, Open};
use crate::judge::compare::{Shapeless, compare};
use crate::judge::outside::Stand;
use crate::judge::painted;
use crate::verdict::{Comparison, Verdict};
use contract::{Camera, Image, MISS, Scene};
use rayon::prelude::*;
use reference::{Hit, Ray};

/// One in so many pixels.
pub const ALLOWED: usize = 10_000;

/// What came of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checked {
    /// Pixels that show another sphere than the exact picture; of an exact oath also another t or colour.
    pub differing: u64,
    /// Pixels whose sphere, t or colour is not bit for bit that of the exact picture, whatever the oath.
    pub inexact: u64,
    /// Of all pixels those that the oath does not allow.
    pub wrong: u64,
    /// Pixels of which the oath states nothing.
    pub not_stated: u64,
    /// The first wrong pixel: column and row.
    pub first: Option<[u32; 2]>,
}

impl Checked {
    /// The word.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self { wrong: 1.., .. } => Verdict::Wrong,
            Self { not_stated: 1.., .. } => Verdict::Undecidable,
            Self { inexact: 1.., .. } => Verdict::WithinBound,
            _ => Verdict::Equal,
        }
    }

    /// Whether it may be timed.
    #[must_use]
    pub fn passes(&self, kind: Kind, pixels: usize) -> bool {
        let few = (pixels / ALLOWED) as u64;
        let wrong = match kind {
            Kind::Subject | Kind::Limit | Kind::Picked | Kind::Naive => 0,
            Kind::Embree | Kind::Peer => few,
        };
        self.wrong <= wrong && self.not_stated <= few
    }

    fn and(self, other: Self) -> Self {
        Self {
            differing: self.differing + other.differing,
            inexact: self.inexact + other.inexact,
            wrong: self.wrong + other.wrong,
            not_stated: self.not_stated + other.not_stated,
            first: self.first.or(other.first),
        }
    }
}

/// Holds a frame against the exact picture. A layer of another length than the picture is wrong in every pixel.
#[must_use]
pub fn check(scene: &Scene, camera: &Camera, truth: &Image, layers: Layers<'_>, oath: Oath) -> Checked {
    let pixels = camera.size().pixels();
    let lengths = [layers.ids.len(), layers.t.len(), layers.rgba.map_or(pixels, <[_]>::len)];
    if lengths != [pixels; 3] {
        let all = pixels as u64;
        return Checked { differing: all, inexact: all, wrong: all, not_stated: 0, first: Some([0, 0]) };
    }
    let width = camera.size().width();
    let rows = (0..camera.size().height()).into_par_iter().map(|y| {
        let mut row = Checked::default();
        for (x, i) in (0..width).zip(y as usize * width as usize..) {
            let inexact = differs(truth, layers, i);
            let (differs, allowed) = match oath {
                Oath::Exact => (inexact, Some(!inexact)),
                Oath::Within(band) => {
                    let ray = Ray::of_pixel(camera, x, y);
                    let differs = layers.ids[i] != truth.ids[i];
                    let answer = Hit { id: layers.ids[i], t: layers.t[i] };
                    let fits = layers.rgba.is_none_or(|rgba| rgba[i] == painted(scene, &ray, answer));
                    let allowed =
                        if fits { explained(scene, &ray, band, differs, answer) } else { Some(false) };
                    (differs, allowed)
                }
            };
            row.differing += u64::from(differs);
            row.inexact += u64::from(inexact);
            match allowed {
                Some(true) => {}
                Some(false) => {
                    row.wrong += 1;
                    row.first.get_or_insert([x, y]);
                }
                None => row.not_stated += 1,
            }
        }
        row
    });
    // In the order of rows, so that the first is the first.
    rows.collect::<Vec<_>>().into_iter().fold(Checked::default(), Checked::and)
}

/// Counts what differs from the exact picture, whatever the oath; colours that are not painted count as right.
///
/// # Errors
/// [`Shapeless`] if a layer has not as many entries as the picture has pixels.
pub fn held(truth: &Image, layers: Layers<'_>) -> Result<Comparison, Shapeless> {
    let rgba = layers.rgba.unwrap_or(&truth.rgba).to_vec();
    let image = Image { size: truth.size, ids: layers.ids.to_vec(), t: layers.t.to_vec(), rgba };
    compare(truth, &image)
}

fn differs(truth: &Image, layers: Layers<'_>, i: usize) -> bool {
    truth.ids[i] != layers.ids[i]
        || truth.t[i].to_bits() != layers.t[i].to_bits()
        || layers.rgba.is_some_and(|rgba| rgba[i] != truth.rgba[i])
}

/// Whether an answer is one that rounding leaves open. Of the right sphere only t is asked.
fn explained(
    scene: &Scene,
    ray: &Ray,
    band: fn(&Ray, &contract::Sphere) -> Option<Band>,
    differs: bool,
    answer: Hit,
) -> Option<bool> {
    let Hit { id, t } = answer;
    let within = |open: Option<Open>| open.is_some_and(|open| open.holds(t));
    if !differs && id == MISS {
        return Some(t == f32::INFINITY);
    }
    if differs {
        return Stand::new(ray, scene.spheres(), band).map(|stand| within(stand.open(id)));
    }
    let sphere = scene.spheres().get(id as usize)?;
    band(ray, sphere).map(|band| within(band.may_hit))
}
