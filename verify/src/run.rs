//! One frame judged: the truth is rendered, then each subject, each is compared and pictured, and what was found
//! becomes a [`SceneReport`].
//!
//! In: a scene, a camera, subjects. Out: data for the report and its pictures. A subject that gives no picture
//! is reported as not judged; only a truth that cannot be had is an error.

use crate::case::Asked;
use crate::judge::compare::fault_at;
use crate::judge::judge;
use crate::judge::outside::{Witness, hear};
use crate::picture::PictureError;
use crate::report::{Counter, Judge, ScenePictures, SceneReport, SubjectReport, TRUTH};
use crate::subject::{Naive, Promise, Rendered, Rounding, Subject, SubjectError};
use crate::verdict::{Comparison, Verdict};
use contract::{Camera, Image, MISS, Scene};
use reference::{Arithmetic, Ray, RenderError, Tracer, Undecided};
use std::time::Instant;
use thiserror::Error;

/// What is rendered, and what the report says of it.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// What it is.
    pub description: &'a str,
    /// Where it comes from.
    pub provenance: &'a str,
    /// This frame's spheres.
    pub scene: &'a Scene,
    /// The camera.
    pub camera: &'a Camera,
    /// This frame, from 0, and how many there are.
    pub frame: [usize; 2],
    /// What its reader had to say.
    pub warnings: &'a [String],
    /// The command that judges this frame again, with all subjects; empty if there is none.
    pub replay: &'a str,
}

/// Why a frame could not be judged at all.
#[derive(Debug, Error)]
pub enum RunError {
    /// There is no truth to judge by.
    #[error("no truth to judge by: {0}")]
    Truth(#[from] RenderError),
    /// A picture for the report failed.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// An outside witness failed.
    #[error("no word from an outside judge: {0}")]
    Witness(SubjectError),
}

/// Called before each rendering with its name and its rows; the closure it gives is called once a row.
pub type Progress<'a> = &'a dyn Fn(&str, u32) -> Box<dyn Fn() + Sync>;

/// Renders the truth and every subject, and judges; the truth itself is held against each outside witness.
///
/// # Errors
/// [`RunError`] if the truth cannot be had or a picture cannot be encoded.
pub fn run(
    frame: &Frame<'_>,
    subjects: &[&dyn Subject],
    witnesses: &[&dyn Witness],
    threads: usize,
    progress: Progress<'_>,
) -> Result<(SceneReport, ScenePictures), RunError> {
    let Frame { scene, camera, .. } = *frame;
    let rows = camera.size().height();
    let tick = progress("exact", rows);
    let truth = Tracer::new(Arithmetic::Exact).threads(threads).render_with(scene, camera, &*tick)?;
    let hits = truth.image.ids.iter().filter(|&&id| id != MISS).count() as u64;
    let witness = Judge { name: "reference, exact".into(), counters: counters(camera, truth.undecided) };
    let truth = truth.image;
    let mut outside = Vec::new();
    for witness in witnesses {
        outside.extend(hear(scene, camera, &truth, *witness).map_err(RunError::Witness)?);
    }
    let mut pictures = ScenePictures::new(&truth)?;
    let mut reports = Vec::new();
    let mut naive = NaivePictures::default();
    for subject in subjects {
        let tick = progress(subject.name(), rows);
        let start = Instant::now();
        let rendered = subject.render(scene, camera, threads, &*tick);
        let seconds = start.elapsed().as_secs_f64();
        let mut report = blank(*subject);
        match rendered {
            Ok(Rendered { image, notes, took }) => {
                let seconds = took.map_or(seconds, |took| took.as_secs_f64());
                let twin = naive.for_promise(subject.promise(), frame, threads, progress);
                let verdict = judge(scene, camera, &truth, &image, subject.promise(), twin);
                let place = verdict.comparison.as_ref().and_then(|comparison| comparison.first_wrong);
                let promised = broken(twin, &image, place);
                report.seconds = Some(seconds);
                report.rays_per_second = Some(camera.size().pixels() as f64 / seconds);
                report.first_wrong = verdict
                    .comparison
                    .as_ref()
                    .and_then(|c| account(frame, &subject.option(), &truth, promised, &image, c));
                (report.verdict, report.because) = (verdict.verdict, verdict.because);
                report.comparison = verdict.comparison;
                for note in notes {
                    report.because += &format!(" {note}");
                }
                match &report.comparison {
                    Some(_) => pictures.add(held_against(&truth, promised, &image, place), &image, place)?,
                    None => pictures.skip(),
                }
                naive.keep(*subject, threads, image);
            }
            Err(error) => {
                report.because = format!("Gave no picture: {error}.");
                pictures.skip();
            }
        }
        reports.push(report);
    }
    let report = SceneReport {
        name: frame.name.into(),
        description: frame.description.into(),
        provenance: frame.provenance.into(),
        spheres: scene.spheres().len(),
        frame: frame.frame[0],
        frames: frame.frame[1],
        width: camera.size().width(),
        height: rows,
        camera: camera.into(),
        warnings: frame.warnings.to_vec(),
        judge: witness,
        hits,
        picture: None,
        subjects: reports,
        outside,
    };
    Ok((report, pictures))
}

fn counters(camera: &Camera, undecided: Undecided) -> Vec<Counter> {
    let counter = |name: &str, value: u64| Counter { name: name.into(), value };
    vec![
        counter("rays", camera.size().pixels() as u64),
        counter("hits that integers decided", undecided.hits),
        counter("orders of two roots that integers decided", undecided.orders),
        counter("roundings of t that integers decided", undecided.roundings),
    ]
}

fn blank(subject: &dyn Subject) -> SubjectReport {
    SubjectReport {
        name: subject.name().into(),
        description: subject.description().into(),
        promise: subject.promise().words(),
        known_fault: false,
        verdict: Verdict::NotJudged,
        because: String::new(),
        comparison: None,
        seconds: None,
        rays_per_second: None,
        picture: None,
        first_wrong: None,
    }
}

/// The naive pictures a promise of equality is held against: kept when they were subjects, else rendered.
#[derive(Default)]
struct NaivePictures(Vec<(Rounding, Image)>);

impl NaivePictures {
    fn keep(&mut self, subject: &dyn Subject, threads: usize, image: Image) {
        // Not by its name, which anyone may take.
        if let Some(Asked::Naive(Naive(rounding))) = subject.asked(threads) {
            self.0.push((rounding, image));
        }
    }

    fn for_promise(
        &mut self,
        promise: Promise,
        frame: &Frame<'_>,
        threads: usize,
        progress: Progress<'_>,
    ) -> Option<&Image> {
        let Promise::EqualToNaive(rounding) = promise else { return None };
        if !self.0.iter().any(|(kept, _)| *kept == rounding) {
            let twin = Naive(rounding);
            let tick = progress(twin.name(), frame.camera.size().height());
            let image: Result<Rendered, SubjectError> =
                twin.render(frame.scene, frame.camera, threads, &*tick);
            self.0.push((rounding, image.ok()?.image));
        }
        self.0.iter().find(|(kept, _)| *kept == rounding).map(|(_, image)| image)
    }
}

/// The picture that was promised, where it and the subject's differ at a place.
fn broken<'a>(twin: Option<&'a Image>, subject: &Image, place: Option<[u32; 2]>) -> Option<&'a Image> {
    let index = place.map(|place| index(subject, place))?;
    twin.filter(|twin| fault_at(twin, subject, index).is_some())
}

/// What a picture is shown beside: the truth, or where that shows no difference at a place, what was promised.
fn held_against<'a>(
    truth: &'a Image,
    promised: Option<&'a Image>,
    subject: &Image,
    place: Option<[u32; 2]>,
) -> (&'static str, &'a Image) {
    let same = place.is_some_and(|place| fault_at(truth, subject, index(truth, place)).is_none());
    promised.filter(|_| same).map_or((TRUTH, truth), |twin| ("Promised", twin))
}

fn index(image: &Image, [x, y]: [u32; 2]) -> usize {
    y as usize * image.size.width() as usize + x as usize
}

/// The first wrong pixel in full, one thing a line: its ray and all answers, in decimal and in bits, and the
/// command that comes to it again.
fn account(
    frame: &Frame<'_>,
    option: &str,
    truth: &Image,
    promised: Option<&Image>,
    subject: &Image,
    comparison: &Comparison,
) -> Option<String> {
    let [x, y] = comparison.first_wrong?;
    let i = index(truth, [x, y]);
    let ray = Ray::of_pixel(frame.camera, x, y);
    let number = |x: f32| format!("{x:?} (0x{:08x})", x.to_bits());
    let vector = |v: [f32; 3]| v.map(number).join(", ");
    let answer = |image: &Image| match image.ids[i] {
        MISS => "a miss".into(),
        id => format!("sphere {id} at t = {}, colour {:?}", number(image.t[i]), &image.rgba[i][..3]),
    };
    let mut text = format!(
        "pixel      ({x}, {y})\neye        {}\ndirection  {}\ntruth      {}",
        vector(ray.eye),
        vector(ray.dir),
        answer(truth),
    );
    if let Some(promised) = promised {
        text += &format!("\npromised   {}", answer(promised));
    }
    text += &format!("\nsubject    {}", answer(subject));
    if !frame.replay.is_empty() {
        text += &format!("\nreplay     {} {option}", frame.replay);
    }
    Some(text)
}
