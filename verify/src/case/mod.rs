//! A case: a scene of one frame or more, a camera and one tracer, in a file that anyone can run again. Failures of properties, of
//! fuzzing and of campaigns end as cases; those in `tests/cases` are judged in every run of the tests.
//!
//! In: parts, or the JSON of [`text`]. Out: the verdict of the judge on each frame ([`Case::judge`]). A case that fails is made small
//! by [`shrink`], told step by step by [`account`](mod@account), and written with its picture by [`folder`].

pub mod account;
pub mod folder;
pub mod plan_words;
pub mod shrink;
pub mod text;

use crate::foreign::Foreign;
use crate::judge::{Judgement, judge};
use crate::subject::{Naive, Promise, Subject, SubjectError, may_refuse, promise};
use crate::verdict::Verdict;
use contract::{Animation, Camera, Image, Scene};
use optimized::{Level, Plan, RenderError, Tracer};
use reference::Arithmetic;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use thiserror::Error;

/// A tracer and what it is to trace.
#[derive(Clone, Debug)]
pub struct Case {
    /// Frames, rendered one after another by one session of the tracer.
    pub frames: Animation,
    /// The camera of all of them.
    pub camera: Camera,
    /// Who traces.
    pub asked: Asked,
    /// The verdict that is right for it: [`Verdict::Wrong`] for what is known to fail, as the paper's plan does.
    pub expected: Verdict,
    /// A pixel to look at, if any.
    pub pixel: Option<[u32; 2]>,
    /// What it shows, in a sentence.
    pub why: String,
}

/// The most workers that a case may have.
pub const MOST_WORKERS: u8 = 64;

/// A tracer that a case names.
#[derive(Clone, Debug)]
pub enum Asked {
    /// The reference in one of its roundings.
    Naive(Naive),
    /// The grid tracer.
    Grid {
        /// Its plan.
        plan: Plan,
        /// Its level.
        level: Level,
        /// Its workers, from 1 to [`MOST_WORKERS`].
        workers: u8,
    },
    /// A program. A file names no command that reading it would run: who replays the case gives the tracer anew.
    Foreign {
        /// Its name.
        name: String,
        /// What it is held to.
        promise: Promise,
        /// The program.
        tracer: Option<Arc<Foreign>>,
    },
}

/// Why a case was not judged.
#[derive(Debug, Error)]
pub enum CaseError {
    /// The grid tracer refused or could not render a frame.
    #[error("frame {frame} was refused: {error}")]
    Refused {
        /// Which, from 0.
        frame: usize,
        /// Why.
        error: RenderError,
    },
    /// The tracer panicked, of which nobody can say where it would have led.
    #[error("the tracer panicked: {0}")]
    Panicked(String),
    /// The tracer is a program, and none was given.
    #[error("its tracer `{name}` is a program: --subject-cmd gives it")]
    NoProgram {
        /// Its name.
        name: String,
    },
    /// The program gave no picture.
    #[error("frame {frame}: {error}")]
    Foreign {
        /// Which, from 0.
        frame: usize,
        /// Why.
        error: SubjectError,
    },
    /// The reference gave no picture.
    #[error("no truth to judge by: {0}")]
    Reference(#[from] reference::RenderError),
}

impl fmt::Display for Asked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Naive(naive) => f.write_str(naive.name()),
            Self::Grid { plan, level, workers } => write!(f, "{plan}; {level}, {workers} workers"),
            Self::Foreign { name, tracer: None, .. } => write!(f, "{name}, a program"),
            Self::Foreign { name, tracer: Some(tracer), .. } => {
                write!(f, "{name}, `{}`", tracer.description())
            }
        }
    }
}

impl Asked {
    /// What it is held to.
    #[must_use]
    pub fn promise(&self) -> Promise {
        match self {
            Self::Naive(naive) => naive.promise(),
            Self::Grid { plan, .. } => promise(plan.arithmetic),
            Self::Foreign { promise, .. } => *promise,
        }
    }
}

/// A frame as it was rendered and judged.
#[derive(Clone, Debug)]
pub struct Judged {
    /// What the tracer promised: the exact picture, or the naive one of its arithmetic.
    pub promised: Image,
    /// The tracer's.
    pub picture: Image,
    /// What the judge says.
    pub judgement: Judgement,
    /// The first pixel that breaks the promise, if one does: with a wrong id, else t, else colour.
    pub wrong: Option<[u32; 2]>,
}

impl Case {
    /// Whether the tracer may answer so: its plan says that it refuses what the scene does. All else is a failure.
    #[must_use]
    pub fn may_fail_with(&self, error: &CaseError) -> bool {
        match (&self.asked, error) {
            (Asked::Grid { plan, .. }, CaseError::Refused { error, .. }) => may_refuse(plan, error),
            _ => false,
        }
    }

    /// The tracer's pictures of all frames.
    ///
    /// # Errors
    /// [`CaseError`] if there is none; a panic is one, so that it can be shrunk and kept as any other failure.
    pub fn pictures(&self) -> Result<Vec<Image>, CaseError> {
        catch_unwind(AssertUnwindSafe(|| self.rendered())).unwrap_or_else(|panic| {
            let said = panic.downcast_ref::<String>().cloned();
            let said = said.or_else(|| panic.downcast_ref::<&str>().map(|said| (*said).to_owned()));
            Err(CaseError::Panicked(said.unwrap_or_else(|| "it did not say why".into())))
        })
    }

    fn rendered(&self) -> Result<Vec<Image>, CaseError> {
        let frames = self.frames.frames();
        match &self.asked {
            Asked::Naive(naive) => {
                let tracer = reference::Tracer::new(naive.0.naive()).threads(1);
                frames.iter().map(|scene| Ok(tracer.render(scene, &self.camera)?.image)).collect()
            }
            Asked::Foreign { name, tracer: None, .. } => Err(CaseError::NoProgram { name: name.clone() }),
            Asked::Foreign { tracer: Some(tracer), .. } => {
                let render = |(frame, scene): (usize, &Scene)| {
                    let rendered = tracer.render(scene, &self.camera, 1, &|| ());
                    rendered
                        .map(|rendered| rendered.image)
                        .map_err(|error| CaseError::Foreign { frame, error })
                };
                frames.iter().enumerate().map(render).collect()
            }
            &Asked::Grid { plan, level, workers } => {
                let refused = |frame: usize| move |error| CaseError::Refused { frame, error };
                let tracer = Tracer::new(plan, level).workers(workers.max(1).into());
                let mut session = tracer.session().map_err(refused(0))?;
                let mut render = |(i, scene): (usize, &Scene)| {
                    session.render(scene, &self.camera).map(|r| r.image.clone()).map_err(refused(i))
                };
                frames.iter().enumerate().map(&mut render).collect()
            }
        }
    }

    /// Renders all frames, exactly and by the tracer, and has the judge compare each.
    ///
    /// # Errors
    /// [`CaseError`] if there is nothing to compare.
    pub fn judge(&self) -> Result<Vec<Judged>, CaseError> {
        let pictures = self.pictures()?;
        let naive = |scene: &Scene, arithmetic: Arithmetic| {
            reference::Tracer::new(arithmetic).threads(1).render(scene, &self.camera)
        };
        let promise = self.asked.promise();
        let each = self.frames.frames().iter().zip(pictures).map(|(scene, picture)| {
            let truth = naive(scene, Arithmetic::Exact)?.image;
            let twin = match promise {
                Promise::EqualToNaive(rounding) => Some(naive(scene, rounding.naive())?.image),
                Promise::Exact | Promise::Rounded(_) => None,
            };
            let judgement = judge(scene, &self.camera, &truth, &picture, promise, twin.as_ref());
            let differs = judgement.comparison.as_ref().and_then(|comparison| comparison.first_wrong);
            let wrong = differs.filter(|_| judgement.verdict == Verdict::Wrong);
            Ok(Judged { promised: twin.unwrap_or(truth), picture, judgement, wrong })
        });
        each.collect()
    }

    /// Whether a verdict is the one that is right for the case: a tracer that is to keep its promise may be better than it says.
    #[must_use]
    pub fn is_as_expected(&self, verdict: Verdict) -> bool {
        match self.expected {
            Verdict::Equal => verdict == Verdict::Equal,
            Verdict::WithinBound => matches!(verdict, Verdict::Equal | Verdict::WithinBound),
            Verdict::Undecidable => {
                matches!(verdict, Verdict::Equal | Verdict::WithinBound | Verdict::Undecidable)
            }
            Verdict::Wrong | Verdict::NotJudged => verdict == self.expected,
        }
    }
}

/// The worst verdict on any frame.
#[must_use]
pub fn worst(judged: &[Judged]) -> Verdict {
    Verdict::worst_of(judged.iter().map(|judged| judged.judgement.verdict))
}
