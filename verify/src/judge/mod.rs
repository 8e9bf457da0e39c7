//! Judges: the truth is the reference's `Exact` picture; a subject's picture is compared with it bit by bit,
//! and every difference is held against the error bound of the subject's own promise.
//!
//! Who judges the truth itself is an [`outside`] witness, ray by ray, and integers between the two.
//!
//! In: truth, subject's picture, promise, and for a promise of equality the naive picture of the same form.
//! Out: a [`Judgement`]. A picture that cannot be compared is `Wrong`, one that was never made `NotJudged`.

pub mod band;
pub mod compare;
pub mod narrowed;
pub mod outside;

use crate::subject::{Promise, Rounding};
use crate::verdict::{Comparison, Verdict};
use band::band;
use compare::{Fault, compare, fault_at};
use contract::{Camera, Image, MISS, Scene};
use rayon::prelude::*;
use reference::{Hit, Ray, shade};

/// A verdict and what it rests on.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The word.
    pub verdict: Verdict,
    /// One sentence on why.
    pub because: String,
    /// The counts; `None` if nothing was compared.
    pub comparison: Option<Comparison>,
}

/// Judges a subject's picture. `naive` is the reference's picture in the form of the promise, needed for
/// [`Promise::EqualToNaive`] only.
#[must_use]
pub fn judge(
    scene: &Scene,
    camera: &Camera,
    truth: &Image,
    subject: &Image,
    promise: Promise,
    naive: Option<&Image>,
) -> Judgement {
    let mut comparison = match compare(truth, subject) {
        Ok(comparison) => comparison,
        Err(shapeless) => return wrong(None, format!("The pictures cannot be compared: {shapeless}.")),
    };
    let equal = comparison.wrong_ids + comparison.wrong_t + comparison.wrong_color == 0;
    let rounding = match promise {
        Promise::Exact if equal => {
            return judgement(Verdict::Equal, comparison, "Equal to the truth, bit for bit.");
        }
        Promise::Exact => return wrong(Some(comparison), "Differs where it promised not to.".into()),
        Promise::Rounded(rounding) => rounding,
        Promise::EqualToNaive(rounding) => {
            let twin = naive.map(|naive| (naive, compare(naive, subject)));
            match twin {
                None => return judgement(Verdict::NotJudged, comparison, "The naive picture is missing."),
                Some((_, Err(shapeless))) => {
                    return wrong(Some(comparison), format!("The pictures cannot be compared: {shapeless}."));
                }
                Some((naive, Ok(twin))) if twin.first_wrong.is_some() => {
                    comparison.first_wrong = twin.first_wrong;
                    let [x, y] = twin.first_wrong.unwrap_or_default();
                    let differing = (0..naive.ids.len()).filter(|i| fault_at(naive, subject, *i).is_some());
                    let text = format!(
                        "Of its pixels {} differ from the naive picture of the same form, first ({x}, {y}).",
                        differing.count(),
                    );
                    return wrong(Some(comparison), text);
                }
                Some((_, Ok(_))) => rounding,
            }
        }
    };
    explain(scene, camera, truth, subject, rounding, &mut comparison);
    let as_naive = match promise {
        Promise::EqualToNaive(_) => "Bit for bit the naive picture. ",
        _ => "",
    };
    if comparison.unexplained > 0 {
        let text =
            format!("{as_naive}{} pixels are wrong beyond what rounding explains.", comparison.unexplained);
        wrong(Some(comparison), text)
    } else if comparison.undecidable > 0 {
        let text = format!("{as_naive}{} pixels lie beyond the form's range.", comparison.undecidable);
        judgement(Verdict::Undecidable, comparison, &text)
    } else if equal {
        judgement(Verdict::Equal, comparison, &format!("{as_naive}Equal to the truth, bit for bit."))
    } else {
        let text = format!("{as_naive}Rounding explains every difference from the truth.");
        judgement(Verdict::WithinBound, comparison, &text)
    }
}

fn judgement(verdict: Verdict, comparison: Comparison, because: &str) -> Judgement {
    Judgement { verdict, because: because.into(), comparison: Some(comparison) }
}

fn wrong(comparison: Option<Comparison>, because: String) -> Judgement {
    Judgement { verdict: Verdict::Wrong, because, comparison }
}

/// Holds every differing pixel against the form's bound, counts those it does not explain, and names the first.
fn explain(
    scene: &Scene,
    camera: &Camera,
    truth: &Image,
    subject: &Image,
    rounding: Rounding,
    comparison: &mut Comparison,
) {
    let width = truth.size.width() as usize;
    let rows = (0..camera.size().height()).into_par_iter().map(|y| {
        let (mut counts, mut first) = ([0u64; 2], [None; 3]);
        for (x, i) in (0..camera.size().width()).zip(y as usize * width..) {
            let Some(fault) = fault_at(truth, subject, i) else { continue };
            let ray = Ray::of_pixel(camera, x, y);
            let answer = Hit { id: subject.ids[i], t: subject.t[i] };
            match explains(scene, &ray, rounding, fault, answer, subject.rgba[i]) {
                Some(true) => {}
                Some(false) => {
                    counts[0] += 1;
                    first[fault.grade()] = first[fault.grade()].or(Some([x, y]));
                }
                None => counts[1] += 1,
            }
        }
        (counts, first)
    });
    let none = ([0; 2], [None; 3]);
    let ([unexplained, undecidable], first) = rows.reduce(
        || none,
        |(a, one), (b, other)| ([a[0] + b[0], a[1] + b[1]], [0, 1, 2].map(|i| one[i].or(other[i]))),
    );
    (comparison.unexplained, comparison.undecidable) = (unexplained, undecidable);
    comparison.first_wrong = first.into_iter().flatten().next().or(comparison.first_wrong);
}

/// The one colour of an answer, whoever gives it: by rule 4 of a hit, the background of a miss, or of an id of no sphere.
#[must_use]
pub fn painted(scene: &Scene, ray: &Ray, answer: Hit) -> [u8; 4] {
    let [r, g, b] = scene.background();
    let is_sphere = (answer.id as usize) < scene.spheres().len();
    if is_sphere { shade(scene, ray, answer) } else { [r, g, b, 255] }
}

/// Whether rounding can turn this ray's truth into that answer. `None` if the bound states nothing.
///
/// The answer's own sphere must be one that may be hit, at a t that may be had; and no sphere that must be
/// hit may be certain to be nearer, which contradicts the answer whatever is not stated of others. The t of a miss is
/// never a matter of rounding, nor is a colour.
fn explains(
    scene: &Scene,
    ray: &Ray,
    rounding: Rounding,
    fault: Fault,
    answer: Hit,
    color: [u8; 4],
) -> Option<bool> {
    let Hit { id, t } = answer;
    if color != painted(scene, ray, answer) || (id == MISS && t != f32::INFINITY) {
        return Some(false);
    }
    let mut stated = true;
    if id != MISS {
        let Some(sphere) = scene.spheres().get(id as usize) else { return Some(false) };
        match band(rounding, ray, sphere) {
            Some(own) if !own.may_hit.is_some_and(|open| open.holds(t)) => return Some(false),
            own => {
                stated = own.is_some();
            }
        }
    }
    if fault == Fault::T {
        return stated.then_some(true);
    }
    for sphere in scene.spheres() {
        let Some(band) = band(rounding, ray, sphere) else {
            stated = false;
            continue;
        };
        if band.must_hit.is_some_and(|hi| id == MISS || hi < f64::from(t)) {
            return Some(false);
        }
    }
    stated.then_some(true)
}
