//! Two pictures held against each other, pixel by pixel, by their bits. Nothing is rounded, summed or sorted
//! before it is compared.

use crate::verdict::{Comparison, UlpSummary};
use contract::{Image, MISS};
use thiserror::Error;

/// Why two pictures cannot be compared.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("the truth has {truth} pixels and the subject's layers have {ids} ids, {t} t, {colors} colours")]
pub struct Shapeless {
    /// Pixels of the truth.
    pub truth: usize,
    /// Length of the subject's layer.
    pub ids: usize,
    /// Length of the subject's layer.
    pub t: usize,
    /// Length of the subject's layer.
    pub colors: usize,
}

/// What is wrong with a pixel, the gravest thing only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The truth hits, the subject does not.
    Missing,
    /// The subject hits, the truth does not.
    Extra,
    /// Both hit, different spheres.
    Swapped,
    /// The right id, but t has other bits; the colour may be wrong too.
    T,
    /// Id and t are right, the colour is not.
    Color,
}

impl Fault {
    /// 0 for a wrong id, 1 for a wrong t, 2 for a wrong colour.
    #[must_use]
    pub fn grade(self) -> usize {
        match self {
            Self::Missing | Self::Extra | Self::Swapped => 0,
            Self::T => 1,
            Self::Color => 2,
        }
    }
}

/// What is wrong at an index of the layers, if anything.
///
/// # Panics
/// If the index lies beyond a layer of either image.
#[must_use]
pub fn fault_at(truth: &Image, subject: &Image, index: usize) -> Option<Fault> {
    let same_t = truth.t[index].to_bits() == subject.t[index].to_bits();
    match (truth.ids[index], subject.ids[index]) {
        (a, b) if a != b && b == MISS => Some(Fault::Missing),
        (a, b) if a != b && a == MISS => Some(Fault::Extra),
        (a, b) if a != b => Some(Fault::Swapped),
        _ if !same_t => Some(Fault::T),
        _ if truth.rgba[index] != subject.rgba[index] => Some(Fault::Color),
        _ => None,
    }
}

/// Counts all differences. What explains them is another's business: `unexplained` and `undecidable` stay 0.
///
/// # Errors
/// [`Shapeless`] if a layer has not as many entries as the truth has pixels.
pub fn compare(truth: &Image, subject: &Image) -> Result<Comparison, Shapeless> {
    let shape = (subject.size, subject.ids.len(), subject.t.len(), subject.rgba.len());
    let pixels = truth.size.pixels();
    if shape != (truth.size, pixels, pixels, pixels) {
        let (_, ids, t, colors) = shape;
        return Err(Shapeless { truth: pixels, ids, t, colors });
    }
    let mut c = Comparison { pixels: pixels as u64, ..Comparison::default() };
    let mut first = [None; 3];
    let mut ulps = Vec::new();
    for i in 0..pixels {
        c.hits += u64::from(truth.ids[i] != MISS);
        match fault_at(truth, subject, i) {
            Some(Fault::Missing) => c.missing += 1,
            Some(Fault::Extra) => c.extra += 1,
            Some(Fault::Swapped) => c.swapped += 1,
            Some(Fault::T) => c.wrong_t += 1,
            Some(Fault::Color) | None => {}
        }
        if let Some(fault) = fault_at(truth, subject, i) {
            first[fault.grade()] = first[fault.grade()].or(Some(i));
        }
        if truth.ids[i] == subject.ids[i] && truth.ids[i] != MISS {
            ulps.push(ulps_apart(truth.t[i], subject.t[i]));
        }
        if truth.rgba[i] != subject.rgba[i] {
            c.wrong_color += 1;
            let channels = truth.rgba[i].iter().zip(&subject.rgba[i]);
            c.color_max = channels.map(|(x, y)| x.abs_diff(*y)).fold(c.color_max, u8::max);
        }
    }
    c.wrong_ids = c.missing + c.extra + c.swapped;
    c.t_ulp = summary(&mut ulps);
    c.first_wrong = first.into_iter().flatten().next().map(|i| pixel(i, truth.size.width()));
    Ok(c)
}

/// How many f32 steps lie between two values, -0 and +0 being one; NaN is as far as can be from anything else.
#[must_use]
pub fn ulps_apart(x: f32, y: f32) -> u64 {
    let place = |x: f32| {
        let magnitude = i64::from(x.to_bits() & 0x7fff_ffff);
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    if x.to_bits() != y.to_bits() && (x.is_nan() || y.is_nan()) {
        return u64::MAX;
    }
    place(x).abs_diff(place(y))
}

fn pixel(i: usize, width: u32) -> [u32; 2] {
    let i = u32::try_from(i).expect("an image has at most 2^27 pixels");
    [i % width, i / width]
}

fn summary(ulps: &mut [u64]) -> UlpSummary {
    ulps.sort_unstable();
    let at = |percent: usize| ulps.get((ulps.len().max(1) - 1) * percent / 100).copied().unwrap_or(0);
    UlpSummary { count: ulps.len() as u64, median: at(50), p99: at(99), max: at(100) }
}
