//! What a report says, as plain data: the one source of the HTML page, the JSON file and the terminal's table.
//! Judges and commands fill it; nothing here measures, reads a clock or looks at the machine. Every public field
//! is written to `report.json` under its own name, so a changed field means a new [`SCHEMA_VERSION`].

use crate::judge::outside::Hearing;
use crate::verdict::{Comparison, Verdict};
use contract::Camera;
use serde::{Deserialize, Serialize};

/// Version of the layout of `report.json`.
pub const SCHEMA_VERSION: u32 = 4;

/// Everything one run found out.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// [`SCHEMA_VERSION`]; first, so that a reader can stop here.
    pub schema_version: u32,
    /// Heading of the page.
    pub title: String,
    /// The word for the whole run; [`overall`] finds it.
    pub verdict: Verdict,
    /// Where, when and how the run was made.
    pub environment: Environment,
    /// What was rendered.
    pub scenes: Vec<SceneReport>,
    /// What is claimed, and what the claim rests on.
    pub claims: Vec<Claim>,
    /// Promises that other chapters found broken, a sentence each.
    pub broken: Vec<String>,
    /// Judges that could have spoken and did not.
    pub absent: Vec<Absent>,
}

/// Where, when and how a run was made.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Environment {
    /// Name and version of the program.
    pub program: String,
    /// Target triple, or the architecture.
    pub target: String,
    /// Model of the processor, if known.
    pub cpu: Option<String>,
    /// The SIMD level that was used.
    pub simd: String,
    /// The compiler, as it names itself.
    pub rustc: String,
    /// Threads that rendered.
    pub threads: usize,
    /// Date, ISO 8601.
    pub date: String,
    /// The command line that made the run, fit to be repeated.
    pub command_line: String,
    /// Seed of everything random, if anything was.
    pub seed: Option<u64>,
}

/// One frame of one scene, and all subjects that rendered it.
#[derive(Clone, Debug, Serialize)]
pub struct SceneReport {
    /// Its name.
    pub name: String,
    /// What it shows and why it is here.
    pub description: String,
    /// Where its data come from.
    pub provenance: String,
    /// Spheres in this frame.
    pub spheres: usize,
    /// This frame, counted from 0.
    pub frame: usize,
    /// Frames of the animation.
    pub frames: usize,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The camera.
    pub camera: CameraRecord,
    /// What its reader or the plan had to say.
    pub warnings: Vec<String>,
    /// Who knows the truth, and how it was found.
    pub judge: Judge,
    /// Pixels where the truth is a hit.
    pub hits: u64,
    /// File name of the truth's picture, filled in by [`write()`](super::write()).
    pub picture: Option<String>,
    /// The subjects.
    pub subjects: Vec<SubjectReport>,
    /// What outside witnesses said of the judge, and it of them.
    pub outside: Vec<Hearing>,
}

/// A camera, in decimal and in bits.
#[derive(Clone, Debug, Serialize)]
pub struct CameraRecord {
    /// Where all rays start.
    pub eye: Vector,
    /// Direction of the outer corner of pixel (0, 0).
    pub corner: Vector,
    /// From a pixel to the next in its row.
    pub du: Vector,
    /// From a row to the next.
    pub dv: Vector,
}

/// Three f32 numbers, in decimal and in bits.
#[derive(Clone, Debug, Serialize)]
pub struct Vector {
    /// The shortest decimals that read back as the same numbers.
    pub decimal: [f32; 3],
    /// Their IEEE 754 bits, hexadecimal.
    pub bits: [String; 3],
}

/// Who knows the truth, and how it was found.
#[derive(Clone, Debug, Serialize)]
pub struct Judge {
    /// Its name.
    pub name: String,
    /// What it counted, say how many rays reached each exact stage. Zeros belong here.
    pub counters: Vec<Counter>,
}

/// A number and what it counts.
#[derive(Clone, Debug, Serialize)]
pub struct Counter {
    /// What is counted.
    pub name: String,
    /// How many.
    pub value: u64,
}

/// One subject on one scene.
#[derive(Clone, Debug, Serialize)]
pub struct SubjectReport {
    /// Its name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// What it promises, in words: the judge holds it to this.
    pub promise: String,
    /// Whether it is shown as a known fault: then its verdict is its own, and not the run's.
    pub known_fault: bool,
    /// The verdict.
    pub verdict: Verdict,
    /// Why that verdict.
    pub because: String,
    /// The counts; none if nothing was compared.
    pub comparison: Option<Comparison>,
    /// Seconds it took to render, if it was timed.
    pub seconds: Option<f64>,
    /// Rays a second, if it was timed.
    pub rays_per_second: Option<f64>,
    /// File name of its triptych, filled in by [`write()`](super::write()).
    pub picture: Option<String>,
    /// The first wrong pixel told in full: ray, ids and t in decimal and bits, and the line that replays it.
    pub first_wrong: Option<String>,
}

/// A sentence with its kind of evidence.
#[derive(Clone, Debug, Serialize)]
pub struct Claim {
    /// What is claimed.
    pub statement: String,
    /// What it rests on.
    pub evidence: Evidence,
    /// The number that goes with it.
    pub figure: String,
    /// The command that shows it again.
    pub how: String,
}

/// What a claim rests on, from strong to weak.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Evidence {
    /// For all inputs, by a solver or an exhaustive run.
    Proved,
    /// All of a small domain that is stated.
    Exhausted,
    /// In this run, by a bound that was checked.
    Certified,
    /// On n cases.
    Sampled,
    /// On a clock or a counter.
    Measured,
    /// False, with a counterexample.
    Refuted,
    /// Nobody has shown it.
    NotShown,
}

impl Evidence {
    /// All kinds, from strong to weak.
    pub const ALL: [Self; 7] = [
        Self::Proved,
        Self::Exhausted,
        Self::Certified,
        Self::Sampled,
        Self::Measured,
        Self::Refuted,
        Self::NotShown,
    ];

    /// The kind as a word.
    #[must_use]
    pub fn word(self) -> &'static str {
        ["proved", "exhausted", "certified", "sampled", "measured", "refuted", "not shown"][self as usize]
    }
}

/// A judge that did not speak.
#[derive(Clone, Debug, Serialize)]
pub struct Absent {
    /// Its name.
    pub judge: String,
    /// Why, and what would make it speak.
    pub why: String,
    /// Whether it was asked for: then there is no verdict without it.
    pub needed: bool,
}

impl From<[f32; 3]> for Vector {
    fn from(decimal: [f32; 3]) -> Self {
        Self { decimal, bits: decimal.map(|x| format!("0x{:08x}", x.to_bits())) }
    }
}

impl From<&Camera> for CameraRecord {
    fn from(camera: &Camera) -> Self {
        Self {
            eye: camera.eye().into(),
            corner: camera.corner().into(),
            du: camera.du().into(),
            dv: camera.dv().into(),
        }
    }
}

/// The verdict on a whole run: its worst part. One wrong subject or witness or broken promise makes it wrong, one that nobody judged makes
/// it not judged, and so do a judge that was asked for and is absent, and an empty run. A known fault is shown and not counted.
#[must_use]
pub fn overall(scenes: &[SceneReport], broken: &[String], absent: &[Absent]) -> Verdict {
    let counted = || scenes.iter().flat_map(|scene| &scene.subjects).filter(|subject| !subject.known_fault);
    let subjects = counted().map(|subject| subject.verdict);
    let witnesses = scenes.iter().flat_map(|scene| &scene.outside).map(Hearing::verdict);
    let missing = absent.iter().filter(|judge| judge.needed).map(|_| Verdict::NotJudged);
    // Witnesses alone are no run: what is judged is subjects.
    let nobody = counted().next().is_none().then_some(Verdict::NotJudged);
    let broken = broken.iter().map(|_| Verdict::Wrong);
    Verdict::worst_of(subjects.chain(witnesses).chain(missing).chain(nobody).chain(broken))
}

impl SceneReport {
    /// Whether another one is the next frame of the same film: of one name and size, by the same subjects, and a later frame.
    pub(super) fn is_followed_by(&self, next: &Self) -> bool {
        let subjects =
            |scene: &'_ Self| scene.subjects.iter().map(|subject| subject.name.clone()).collect::<Vec<_>>();
        let same = (&self.name, self.frames, self.width, self.height)
            == (&next.name, next.frames, next.width, next.height);
        same && self.frame < next.frame && subjects(self) == subjects(next)
    }

    /// What so many frames are called of which it is the first.
    pub(super) fn called(&self, frames: usize) -> String {
        match frames {
            1 if self.frames > 1 => format!("{}, frame {}", self.name, self.frame),
            1 => self.name.clone(),
            _ => format!("{}, {frames} frames", self.name),
        }
    }
}
