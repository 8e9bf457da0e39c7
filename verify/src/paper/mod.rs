//! The paper's claims one by one: what is claimed, what became of it, what that rests on, the figure, the smallest counterexample, and how
//! to see it again.
//!
//! In: what scenes show ([`look`]) and a seed. Out: [`PaperClaim`]s, in the order of the paper. Nothing in them is typed that can be computed:
//! the shipped tracer, the SPU model and the judges are asked, cases of `tests/cases` are judged again, and solvers are asked, if there are any,
//! for the lemmas that a claim rests on: without them it rests on less, or is not shown.
//!
//! A claim is a question. Scenes answer it with yes or no, leave it open if both lie within the model's bracket, or have nothing to say.
//! Only yes is *confirmed*; no without any yes *refuted*; yes on some and not on others *true under conditions*, with the scenes on
//! either side; all else is *not shown*. Where the paper has a word and no number ("rare", "cheap"), the number that stands for it here is in the
//! claim.

mod cases;
mod lists;
mod loops;
mod memory;
pub mod page;
mod pictures;
pub mod record;
mod speed;
pub mod text;

use crate::prove::claims::{CLAIMS, lemmas};
use crate::prove::prover::{Effort, Finding, Outcome};
use crate::prove::run::ask;
use crate::prove::solver::Solver;
use crate::prove::theorem::Lemma;
use crate::report::Evidence;
use crate::spu::survey::{Input, Survey, SurveyError, survey};
use optimized::camera::BLOCK;
use optimized::crew::Crew;
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::plan::Resolution;
use optimized::seen::Seen;
use optimized::{Events, Level, Plan, RenderError, Tracer};
use serde::{Deserialize, Serialize};

/// What becomes of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Standing {
    /// On all scenes that have something to say.
    Confirmed,
    /// So on some, and on others not, or left open.
    Conditional,
    /// Not so on some, and so on none.
    Refuted,
    /// Left open, or nobody has anything to say.
    NotShown,
}

/// What a scene says to a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Answer {
    /// It is so.
    Yes,
    /// It is not.
    No,
    /// The model's bracket holds both.
    Open,
    /// The scene does not do what the claim is about.
    Silent,
}

/// A scene's answer and its figure.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Answered {
    /// The scene.
    pub scene: String,
    /// Its spheres.
    pub spheres: usize,
    /// What it says.
    pub answer: Answer,
    /// The number that says it.
    pub figure: String,
}

/// A claim of the paper and what was found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PaperClaim {
    /// What is claimed.
    pub statement: String,
    /// What became of it.
    pub verdict: Standing,
    /// What that rests on.
    pub evidence: Evidence,
    /// The figures, of scenes those of [`PaperClaim::answers`] in words.
    pub figure: String,
    /// The smallest case in which it is not so, if one is known.
    pub counterexample: Option<String>,
    /// The command that shows it again.
    pub how: String,
    /// Scene by scene; none for a claim that needs no scene.
    pub answers: Vec<Answered>,
}

/// What a scene shows.
#[derive(Clone, Debug)]
pub struct Looked {
    /// On the SPU model.
    pub survey: Survey,
    /// Cells on an axis, of 1 to 16, with which no sphere spans more than two cells and no queue overflows.
    pub sound: Vec<u8>,
    /// Whether one worker, two and six give the same picture.
    pub workers_agree: bool,
}

/// What is proved of a sphere narrower than cells.
const NARROW: &[&str] = &["cell.corners.below"];
/// Of a push onto a queue.
const PUSH: &[&str] = &["queue.push", "queue.occupied"];
/// Of the mended loop's step.
const STEP: &[&str] = &["walk.successor", "walk.empty", "walk.forward"];
/// Of slices and culling.
const VISIBLE: &[&str] = &["visible.slice", "visible.slice.widened", "visible.planes", "visible.planes.drop"];
/// All lemmas that claims of the paper rest on.
pub const LEMMAS: [&[&str]; 4] = [NARROW, PUSH, STEP, VISIBLE];

/// Cells on an axis that the paper's grid has at most.
const MOST_CELLS: u8 = 16;

/// The command that computes claims again.
pub const HOW: &str = "cargo run --release -- claims";

/// An answer and its figure.
type Figured = (Answer, String);

impl Standing {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Confirmed, Self::Conditional, Self::Refuted, Self::NotShown];

    /// From answers.
    #[must_use]
    pub fn of(answers: &[Answer]) -> Self {
        let [yes, no, open] = [Answer::Yes, Answer::No, Answer::Open].map(|answer| answers.contains(&answer));
        match (yes, no, open) {
            (true, false, false) => Self::Confirmed,
            (true, ..) => Self::Conditional,
            (false, true, _) => Self::Refuted,
            (false, false, _) => Self::NotShown,
        }
    }

    /// In words.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Conditional => "true under conditions",
            Self::Refuted => "refuted",
            Self::NotShown => "not shown",
        }
    }

    /// Its class in a page's style.
    #[must_use]
    pub fn class(self) -> &'static str {
        match self {
            Self::Confirmed => "equal",
            Self::Conditional => "undecidable",
            Self::Refuted => "wrong",
            Self::NotShown => "unjudged",
        }
    }
}

impl From<bool> for Answer {
    fn from(so: bool) -> Self {
        if so { Self::Yes } else { Self::No }
    }
}

/// How many rows of blocks [`look`] tells of for a picture of so many rows of pixels.
#[must_use]
pub fn ticks(rows: u32) -> u32 {
    crate::spu::survey::FRAMES * rows.div_ceil(BLOCK)
}

/// Looks at a scene as the paper's plan sees it.
///
/// # Errors
/// [`SurveyError`] if the tracer refuses it.
pub fn look(input: &Input<'_>, row_done: &dyn Fn()) -> Result<Looked, SurveyError> {
    let survey = survey(input, row_done)?;
    let mut sound = Vec::new();
    for n in 1..=MOST_CELLS {
        let plan = Plan { resolution: Resolution::Fixed(n), ..input.plan };
        let (mut memory, mut events) = (Memory::default(), Events::default());
        Seen::new(Scalar, plan, input.scene, input.camera, &mut memory, &mut events, &Crew::alone())?;
        if events.count() == 0 {
            sound.push(n);
        }
    }
    let level = Level::available().last().copied().unwrap_or(Level::SCALAR);
    let picture = |workers| {
        let tracer = Tracer::new(input.plan, level).workers(workers);
        let image = tracer.render(input.scene, input.camera)?.image;
        let t: Vec<u32> = image.t.iter().map(|t| t.to_bits()).collect();
        Ok::<_, RenderError>((image.ids, t, image.rgba))
    };
    let one = picture(1)?;
    let same = |workers| Ok::<_, RenderError>(picture(workers)? == one);
    Ok(Looked { survey, sound, workers_agree: same(2)? && same(6)? })
}

/// All claims, in the order of the paper; `seed` is that of directed and random inputs, `said` what solvers say ([`proofs`]).
#[must_use]
pub fn claims(looked: &[Looked], said: &[Finding], seed: u64) -> Vec<PaperClaim> {
    let mut claims = speed::claims(looked);
    claims.extend(lists::claims(looked, said, seed));
    claims.extend(loops::claims(looked, said, seed));
    claims.extend(pictures::claims(looked, said));
    claims.extend(memory::claims(looked));
    claims
}

/// A claim that scenes answer.
fn asked(
    statement: &str,
    evidence: Evidence,
    looked: &[Looked],
    question: impl Fn(&Looked) -> Figured,
) -> PaperClaim {
    let answers = looked.iter().map(|looked| {
        let (answer, figure) = question(looked);
        Answered { scene: looked.survey.scene.clone(), spheres: looked.survey.spheres, answer, figure }
    });
    let answers: Vec<Answered> = answers.collect();
    PaperClaim {
        statement: statement.into(),
        verdict: Standing::of(&answers.iter().map(|one| one.answer).collect::<Vec<_>>()),
        evidence,
        figure: in_words(&answers),
        counterexample: smallest(&answers),
        how: HOW.into(),
        answers,
    }
}

/// The scene with the fewest spheres that says no, in words.
#[must_use]
pub fn smallest(answers: &[Answered]) -> Option<String> {
    let no = answers.iter().filter(|one| one.answer == Answer::No);
    let Answered { scene, spheres, figure, .. } = no.min_by_key(|one| one.spheres)?;
    Some(format!("{spheres} spheres, {scene}: {figure}").trim_end_matches([' ', ':']).into())
}

/// Answers by what they say.
#[must_use]
pub fn in_words(answers: &[Answered]) -> String {
    let group = |wanted: Answer, word: &str| {
        let of = answers.iter().filter(|one| one.answer == wanted);
        let of: Vec<String> =
            of.map(|one| format!("{} {}", one.scene, one.figure).trim_end().into()).collect();
        (!of.is_empty()).then(|| format!("{word}: {}", of.join(", ")))
    };
    let groups = [
        group(Answer::Yes, "yes"),
        group(Answer::No, "no"),
        group(Answer::Open, "open"),
        group(Answer::Silent, "nothing to say"),
    ];
    groups.into_iter().flatten().collect::<Vec<_>>().join("; ")
}

/// A claim that needs no scene.
fn alone(statement: &str, evidence: Evidence, (answer, figure): Figured) -> PaperClaim {
    several(statement, evidence, (&[answer], figure))
}

/// A claim that needs no scene and has several answers.
fn several(statement: &str, evidence: Evidence, (answers, figure): (&[Answer], String)) -> PaperClaim {
    PaperClaim {
        statement: statement.into(),
        verdict: Standing::of(answers),
        evidence,
        figure,
        counterexample: None,
        how: HOW.into(),
        answers: Vec::new(),
    }
}

impl PaperClaim {
    /// With a smaller counterexample than a scene.
    fn against(self, counterexample: Option<String>) -> Self {
        Self { counterexample: counterexample.or(self.counterexample), ..self }
    }

    /// Seen again otherwise.
    fn by(self, how: impl Into<String>) -> Self {
        Self { how: how.into(), ..self }
    }
}

/// Lemmas of [`crate::prove`] on which a claim rests: what solvers say of all of them in this run, what stands beside them, and the command
/// that proves them.
struct Proof {
    said: Answer,
    figure: String,
    command: String,
}

impl Proof {
    fn of(lemmas: &[&str], said: &[Finding]) -> Self {
        let of = |name: &&str| said.iter().find(|one| one.name == *name);
        let proved =
            |name| of(name).is_some_and(|one| one.outcome == Outcome::Proved && one.wrong.is_empty());
        let refuted = |name| of(name).is_some_and(|one| matches!(one.outcome, Outcome::Refuted(_)));
        let claim = CLAIMS.iter().find(|claim| lemmas.iter().all(|name| claim.lemmas.contains(name)));
        let (figure, command) =
            claim.map_or((String::new(), HOW.into()), |claim| (claim.figure_of(lemmas), claim.command()));
        let all = lemmas.iter().all(proved);
        let (said, figure) = if all {
            (Answer::Yes, figure)
        } else if lemmas.iter().any(refuted) {
            (Answer::No, format!("refuted in this run; {figure}"))
        } else {
            (Answer::Silent, format!("not proved in this run; {figure}"))
        };
        Self { said, figure, command }
    }

    /// The kind of evidence of a claim that has something else beside the proof.
    fn or(&self, beside: Evidence) -> Evidence {
        match self.said {
            Answer::Yes => Evidence::Proved,
            Answer::No => Evidence::Refuted,
            Answer::Open | Answer::Silent => beside,
        }
    }

    /// Its answer: whatever is beside it, a lemma that is refuted is none that holds.
    fn and(&self, beside: Answer) -> Answer {
        if self.said == Answer::No { Answer::No } else { beside }
    }
}

/// What solvers, if any are there, say of the lemmas that the paper's claims rest on.
#[must_use]
pub fn proofs(solvers: &[Solver], seed: u64, tick: &(dyn Fn() + Sync)) -> Vec<Finding> {
    let wanted = |lemma: &Lemma| LEMMAS.iter().any(|names| names.contains(&lemma.name));
    let lemmas: Vec<Lemma> = lemmas().into_iter().filter(wanted).collect();
    ask(&lemmas, solvers, &Effort::EVERYDAY, seed, tick)
}

fn percent(part: u64, of: u64) -> f64 {
    if of == 0 { 0.0 } else { 100.0 * part as f64 / of as f64 }
}

/// Whether a bracket lies above a number.
fn above([least, most]: [f64; 2], number: f64) -> Answer {
    if least >= number {
        Answer::Yes
    } else if most < number {
        Answer::No
    } else {
        Answer::Open
    }
}

/// Whether one bracket's bounds are each below the other's.
fn cheaper(one: [f64; 2], other: [f64; 2]) -> Answer {
    match (one[0] < other[0], one[1] < other[1]) {
        (true, true) => Answer::Yes,
        (false, false) => Answer::No,
        _ => Answer::Open,
    }
}

fn shown([least, most]: [f64; 2]) -> String {
    use crate::report::words::figure;
    format!("{} to {}", figure(least), figure(most))
}
