//! An outside witness and the reference, ray by ray: each judges the other, and where they disagree integers decide.
//!
//! The witness states a [`Band`] for each ray and sphere: what its own rounding can make of them. From the bands of all
//! spheres follows which answers a ray leaves open ([`Stand`]). If only one is open, the ray lies *outside the band* and
//! both must give it: a disagreement there is a failure, whoever is wrong. If several are open, each must be one of
//! them, and if they are not the same, the unfiltered integers say whose is right, or that it is a tie: equal roots,
//! of which the witness may take any. Its t must lie within its band; how far it is from the exact one is counted in
//! units in the last place. Rays for which the witness states nothing are counted apart, never as agreement.
//!
//! In: scene, camera, the reference's exact picture, the witness. Out: a [`Hearing`] for each way it was asked.

use super::band::{Band, Open};
use super::compare::ulps_apart;
use crate::subject::SubjectError;
use crate::verdict::Verdict;
use contract::{Camera, Image, MISS, Scene, Sphere};
use rayon::prelude::*;
use reference::{Arithmetic, Ray, Tracer};
use serde::Serialize;

/// A tracer that shares nothing with this project.
pub trait Witness: Sync {
    /// Its name and version.
    fn name(&self) -> String;

    /// What its rounding can make of a ray and a sphere; `None` where it states nothing.
    fn band(&self, ray: &Ray, sphere: &Sphere) -> Option<Band>;

    /// Its answers to all rays of a camera, once for each way in which it can be asked.
    ///
    /// # Errors
    /// Whatever keeps it from answering.
    fn testify(&self, scene: &Scene, camera: &Camera) -> Result<Vec<Testimony>, SubjectError>;
}

/// One picture of a witness. Ids and t stand as in [`Image`].
#[derive(Clone, Debug)]
pub struct Testimony {
    /// How it was asked.
    pub mode: String,
    /// The sphere of each pixel, or [`MISS`].
    pub ids: Vec<u32>,
    /// t of each pixel.
    pub t: Vec<f32>,
}

/// Upper ends of the classes of [`Hearing::t_ulp`]; the last class has none.
pub const ULP_CLASSES: [u64; 11] = [0, 1, 2, 4, 8, 16, 64, 256, 1024, 4096, 65_536];

/// What came of one testimony.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Hearing {
    /// Who was asked.
    pub witness: String,
    /// How.
    pub mode: String,
    /// Rays asked.
    pub rays: u64,
    /// Rays that both say hit.
    pub hits: u64,
    /// Rays for which the witness states nothing, and how many of them are answered differently.
    pub not_stated: [u64; 2],
    /// Rays whose answer the witness's rounding leaves open.
    pub in_band: u64,
    /// Disagreements outside the band: each is a failure.
    pub outside: u64,
    /// Answers in the band that are none of those that are open: each is a failure too.
    pub beyond: u64,
    /// Disagreements in the band, by who is right.
    pub inside: Adjudicated,
    /// t of the witness that lie outside its bound: each is a failure.
    pub wrong_t: u64,
    /// Error of t where both see the same sphere, counted in [`ULP_CLASSES`] and above.
    pub t_ulp: [u64; ULP_CLASSES.len() + 1],
    /// The largest of these errors.
    pub t_ulp_max: u64,
    /// The first failure in full.
    pub first: Option<String>,
}

/// Disagreements that integers decided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Adjudicated {
    /// The reference is right.
    pub reference: u64,
    /// The witness is right.
    pub witness: u64,
    /// Neither is.
    pub neither: u64,
    /// Both see a sphere at the same exact root; the reference's is of the lower id.
    pub ties: u64,
}

impl Hearing {
    /// Failures of every kind.
    #[must_use]
    pub fn failures(&self) -> u64 {
        let Adjudicated { witness, neither, .. } = self.inside;
        self.outside + self.beyond + self.wrong_t + witness + neither
    }

    /// The word: wrong if anything failed, undecidable if a ray went without a statement, never more than within bound.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match () {
            () if self.failures() > 0 => Verdict::Wrong,
            () if self.not_stated[0] == self.rays => Verdict::NotJudged,
            () if self.not_stated[0] > 0 => Verdict::Undecidable,
            () => Verdict::WithinBound,
        }
    }

    /// Adds up what another hearing of the same kind counted.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        self.rays += other.rays;
        self.hits += other.hits;
        self.not_stated = [0, 1].map(|i| self.not_stated[i] + other.not_stated[i]);
        self.in_band += other.in_band;
        self.outside += other.outside;
        self.beyond += other.beyond;
        self.inside.reference += other.inside.reference;
        self.inside.witness += other.inside.witness;
        self.inside.neither += other.inside.neither;
        self.inside.ties += other.inside.ties;
        self.wrong_t += other.wrong_t;
        self.t_ulp = std::array::from_fn(|i| self.t_ulp[i] + other.t_ulp[i]);
        self.t_ulp_max = self.t_ulp_max.max(other.t_ulp_max);
        self.first = self.first.or_else(|| other.first.clone());
        self
    }
}

/// Which answers to a ray are open.
#[derive(Clone, Debug, PartialEq)]
pub struct Stand {
    /// A miss is.
    pub miss: bool,
    /// These spheres are, each with these t; none lies behind what is certainly hit.
    pub spheres: Vec<(u32, Open)>,
}

impl Stand {
    /// From the bands of all spheres; `None` if one of them states nothing.
    pub fn new(ray: &Ray, spheres: &[Sphere], band: impl Fn(&Ray, &Sphere) -> Option<Band>) -> Option<Self> {
        let (mut open, mut latest) = (Vec::new(), f64::INFINITY);
        for (id, sphere) in (0..).zip(spheres) {
            let band = band(ray, sphere)?;
            if let Some(own) = band.may_hit.and_then(|own| own.until(latest)) {
                open.push((id, own));
                latest = band.must_hit.map_or(latest, |hi| latest.min(hi));
            }
        }
        let spheres = open.into_iter().filter_map(|(id, own)| Some((id, own.until(latest)?))).collect();
        Some(Self { miss: latest == f64::INFINITY, spheres })
    }

    /// Whether one answer alone is open.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        usize::from(self.miss) + self.spheres.len() == 1
    }

    /// The t for which an answer is open, if it is; of a miss, infinity alone.
    #[must_use]
    pub fn open(&self, id: u32) -> Option<Open> {
        match id {
            MISS => self.miss.then_some(Open([Some([f64::INFINITY; 2]), None])),
            id => self.spheres.iter().find(|(open, _)| *open == id).map(|(_, t)| *t),
        }
    }
}

/// Hears a witness in every way it can be asked.
///
/// # Errors
/// Whatever keeps it from answering.
pub fn hear(
    scene: &Scene,
    camera: &Camera,
    truth: &Image,
    witness: &dyn Witness,
) -> Result<Vec<Hearing>, SubjectError> {
    let testimonies = witness.testify(scene, camera)?;
    Ok(confront(scene, camera, truth, witness, &testimonies))
}

/// Holds testimonies against the truth, ray by ray.
#[must_use]
pub fn confront(
    scene: &Scene,
    camera: &Camera,
    truth: &Image,
    witness: &dyn Witness,
    testimonies: &[Testimony],
) -> Vec<Hearing> {
    let blank = |testimony: &Testimony| Hearing {
        witness: witness.name(),
        mode: testimony.mode.clone(),
        ..Hearing::default()
    };
    let blank: Vec<_> = testimonies.iter().map(blank).collect();
    let (width, band) = (camera.size().width(), |ray: &Ray, sphere: &Sphere| witness.band(ray, sphere));
    let rows = (0..camera.size().height()).into_par_iter().map(|y| {
        let mut hearings = blank.clone();
        for (x, i) in (0..width).zip(y as usize * width as usize..) {
            let ray = Ray::of_pixel(camera, x, y);
            let stand = Stand::new(&ray, scene.spheres(), band);
            for (hearing, testimony) in hearings.iter_mut().zip(testimonies) {
                let answers = [(truth.ids[i], truth.t[i]), (testimony.ids[i], testimony.t[i])];
                if let Some(failure) = hearing.count(scene, &ray, stand.as_ref(), answers) {
                    let account =
                        || format!("pixel ({x}, {y}), {failure}: {ray:?}, reference and witness {answers:?}");
                    hearing.first.get_or_insert_with(account);
                }
            }
        }
        hearings
    });
    let sum = |all: Vec<Hearing>, row: Vec<Hearing>| {
        all.into_iter().zip(&row).map(|(sum, one)| sum.and(one)).collect()
    };
    rows.reduce(|| blank.clone(), sum)
}

impl Hearing {
    /// Counts one ray, its stand and the answers of reference and witness, and names the failure if it is one.
    pub fn count(
        &mut self,
        scene: &Scene,
        ray: &Ray,
        stand: Option<&Stand>,
        answers: [(u32, f32); 2],
    ) -> Option<&'static str> {
        let [(reference, exact), (witness, t)] = answers;
        self.rays += 1;
        let Some(stand) = stand else {
            self.not_stated[0] += 1;
            self.not_stated[1] += u64::from(reference != witness);
            return None;
        };
        self.hits += u64::from(reference != MISS && witness != MISS);
        self.in_band += u64::from(!stand.is_decided());
        let open = [reference, witness].map(|id| stand.open(id));
        if open.contains(&None) {
            let kind = if stand.is_decided() { &mut self.outside } else { &mut self.beyond };
            *kind += 1;
            return Some(if open[0].is_none() { "the reference's id" } else { "the witness's id" });
        }
        let within = |open: Option<Open>, t: f32| open.is_some_and(|open| open.holds(t));
        // What lies below the least normal number the reference may give, though no witness that flushes it can.
        if !within(open[0], exact.max(f32::MIN_POSITIVE)) || !within(open[1], t) {
            self.wrong_t += 1;
            return Some("t");
        }
        if reference == witness {
            if reference != MISS {
                self.error_of_t(ulps_apart(exact, t));
            }
            return None;
        }
        match adjudicate(scene, ray, reference, witness) {
            Side::Reference => self.inside.reference += 1,
            Side::Tie => self.inside.ties += 1,
            Side::Witness => {
                self.inside.witness += 1;
                return Some("integers say that the reference is wrong");
            }
            Side::Neither => {
                self.inside.neither += 1;
                return Some("integers say that both are wrong");
            }
        }
        None
    }

    fn error_of_t(&mut self, ulps: u64) {
        let class = ULP_CLASSES.iter().position(|&end| ulps <= end).unwrap_or(ULP_CLASSES.len());
        self.t_ulp[class] += 1;
        self.t_ulp_max = self.t_ulp_max.max(ulps);
    }
}

/// Who is right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Reference,
    Witness,
    Neither,
    Tie,
}

/// Asks the unfiltered integers who is right of two ids that differ.
fn adjudicate(scene: &Scene, ray: &Ray, reference: u32, witness: u32) -> Side {
    let integers = Tracer::new(Arithmetic::ExactUnfiltered);
    let exact = integers.trace(ray, scene).map_or(MISS, |hit| hit.id);
    match exact {
        _ if exact == reference && is_tie(&integers, scene, ray, [reference, witness]) => Side::Tie,
        _ if exact == reference => Side::Reference,
        _ if exact == witness => Side::Witness,
        _ => Side::Neither,
    }
}

/// Whether two spheres have the same root: each wins against the other if it comes first.
fn is_tie(integers: &Tracer, scene: &Scene, ray: &Ray, ids: [u32; 2]) -> bool {
    let [Some(one), Some(other)] = ids.map(|id| scene.spheres().get(id as usize).copied()) else {
        return false;
    };
    [[one, other], [other, one]].into_iter().all(|pair| {
        let pair = Scene::new(pair.to_vec(), [0; 3], scene.light()).expect("checked spheres");
        integers.trace(ray, &pair).is_some_and(|hit| hit.id == 0)
    })
}
