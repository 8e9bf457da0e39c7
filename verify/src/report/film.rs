//! Frames of one animation as one thing on the page: consecutive scenes of one name come in, a film with its frames, each with the truth and
//! what differs from it, goes out, and what was said of them: warnings, reasons, the first wrong pixel, outside witnesses. The page's own
//! script turns it; without it the first frame is seen.

use super::outside::{Row, rows, sentences};
use super::pictures::TRUTH;
use super::view::{Badge, SceneView, SubjectView};
use super::words::{count, word};
use super::{SceneReport, SubjectReport};
use crate::judge::outside::Hearing;
use crate::verdict::{Comparison, Verdict};

/// An animation on the page.
pub(super) struct Film<'a> {
    pub(super) anchor: String,
    pub(super) first: &'a SceneView<'a>,
    pub(super) frames: Vec<Frame<'a>>,
    pub(super) columns: Vec<&'a str>,
    pub(super) warnings: Vec<String>,
    pub(super) subjects: Vec<Told<'a>>,
    pub(super) outside: Vec<Row>,
    pub(super) said: Vec<String>,
}

/// A subject over all frames of a film.
pub(super) struct Told<'a> {
    pub(super) first: &'a SubjectView<'a>,
    /// Of its worst verdict.
    pub(super) badge: Badge,
    /// The first frame that has that verdict.
    pub(super) worst: Reason<'a>,
    /// Of each frame.
    pub(super) reasons: Vec<Reason<'a>>,
    /// The first wrong pixel and its frame, of the frames with that verdict before all others.
    pub(super) wrong: Option<(usize, &'a str)>,
}

/// Why a frame has its verdict.
#[derive(Clone, Copy)]
pub(super) struct Reason<'a> {
    pub(super) number: usize,
    pub(super) badge: Badge,
    pub(super) because: &'a str,
}

/// One of its frames.
pub(super) struct Frame<'a> {
    pub(super) number: usize,
    pub(super) panels: Vec<(String, &'a str)>,
    pub(super) told: String,
    /// Of each subject its verdict and its pixels with a wrong id, a wrong t, and a wrong colour.
    pub(super) row: Vec<(Badge, [String; 3])>,
    /// The worst that outside witnesses said, if any was heard.
    pub(super) outside: Option<Badge>,
    verdicts: Vec<Verdict>,
}

/// What stands on the page in a row.
pub(super) enum Item<'a> {
    /// A frame by itself.
    Scene(&'a SceneView<'a>),
    /// Many of one animation.
    Film(Film<'a>),
}

impl Item<'_> {
    /// Its anchor.
    pub(super) fn anchor(&self) -> &str {
        match self {
            Self::Scene(scene) => &scene.anchor,
            Self::Film(film) => &film.anchor,
        }
    }

    /// Its name, with the frames it is of.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Scene(scene) => scene.data.called(1),
            Self::Film(film) => film.first.data.called(film.frames.len()),
        }
    }

    /// The verdict on a subject, of a film the worst, and where it is told.
    pub(super) fn cell(&self, subject: &str) -> Option<(Badge, &str)> {
        match self {
            Self::Scene(scene) => {
                let view = scene.subjects.iter().find(|view| view.data.name == subject)?;
                Some((view.badge, &view.anchor))
            }
            Self::Film(film) => {
                let k = film.columns.iter().position(|name| *name == subject)?;
                let verdicts = film.frames.iter().filter_map(|frame| frame.verdicts.get(k));
                Some((Verdict::worst_of(verdicts.copied()).into(), &film.anchor))
            }
        }
    }
}

/// Scenes in their order; those that follow each other under one name are one film.
pub(super) fn items<'a>(scenes: &'a [SceneView<'a>]) -> Vec<Item<'a>> {
    scenes
        .chunk_by(|one, next| one.data.is_followed_by(next.data))
        .map(|group| match group {
            [scene] => Item::Scene(scene),
            _ => Item::Film(film(group)),
        })
        .collect()
}

fn film<'a>(scenes: &'a [SceneView<'a>]) -> Film<'a> {
    let first = &scenes[0];
    let data: Vec<&SceneReport> = scenes.iter().map(|scene| scene.data).collect();
    Film {
        anchor: first.anchor.clone(),
        first,
        columns: first.subjects.iter().map(|subject| subject.data.name.as_str()).collect(),
        frames: scenes.iter().map(frame).collect(),
        warnings: warnings(&data),
        subjects: (0..first.subjects.len()).map(|k| told(scenes, k)).collect(),
        outside: rows(&data),
        said: sentences(&data),
    }
}

/// What was warned of, each once, with its frames if not all have it.
fn warnings(scenes: &[&SceneReport]) -> Vec<String> {
    let mut all: Vec<(&str, Vec<usize>)> = Vec::new();
    for scene in scenes {
        for warning in &scene.warnings {
            match all.iter_mut().find(|(known, _)| known == warning) {
                Some((_, frames)) if frames.last() == Some(&scene.frame) => {}
                Some((_, frames)) => frames.push(scene.frame),
                None => all.push((warning, vec![scene.frame])),
            }
        }
    }
    let told = |(warning, frames): (&str, Vec<usize>)| {
        if frames.len() == scenes.len() {
            return warning.to_owned();
        }
        let frames: Vec<String> = frames.iter().map(usize::to_string).collect();
        format!("{warning} (of frame {})", frames.join(", "))
    };
    all.into_iter().map(told).collect()
}

/// What is told of the subject of that number.
fn told<'a>(scenes: &'a [SceneView<'a>], k: usize) -> Told<'a> {
    let own = || scenes.iter().map(move |scene| (scene.data.frame, scene.subjects[k].data));
    let reason = |(number, data): (usize, &'a SubjectReport)| Reason {
        number,
        badge: data.verdict.into(),
        because: &data.because,
    };
    let verdict = Verdict::worst_of(own().map(|(_, data)| data.verdict));
    let worst = || own().filter(|(_, data)| data.verdict == verdict);
    let wrong = worst().chain(own()).find_map(|(number, data)| Some((number, data.first_wrong.as_deref()?)));
    let first = &scenes[0].subjects[k];
    Told {
        first,
        badge: verdict.into(),
        worst: reason(worst().next().unwrap_or((scenes[0].data.frame, first.data))),
        reasons: own().map(reason).collect(),
        wrong,
    }
}

fn frame<'a>(scene: &'a SceneView<'a>) -> Frame<'a> {
    let verdicts = scene.subjects.iter().map(|subject| subject.data.verdict).collect();
    let mut panels = Vec::new();
    if let Some(truth) = &scene.truth {
        panels.push(("Truth".to_owned(), truth.as_str()));
    }
    let mut told = Vec::new();
    for subject in &scene.subjects {
        let name = &subject.data.name;
        if let Some(shown) = &subject.differing {
            let [(against, _), (_, own), (_, difference)] = &shown.panels;
            panels.push((name.clone(), own.as_str()));
            let from = if *against == TRUTH { "the truth" } else { "its promise" };
            panels.push((format!("Difference of {name} from {from}"), difference.as_str()));
        }
        told.push(match &subject.data.comparison {
            Some(c) => format!(
                "{name}: {}, {} wrong ids, {} wrong t",
                word(subject.data.verdict),
                count(c.wrong_ids),
                count(c.wrong_t)
            ),
            None => format!("{name}: {}", word(subject.data.verdict)),
        });
    }
    let cell = |subject: &SubjectView<'_>| {
        let of = |which: fn(&Comparison) -> u64| {
            subject.data.comparison.as_ref().map_or_else(String::new, |c| count(which(c)))
        };
        (subject.badge, [of(|c| c.wrong_ids), of(|c| c.wrong_t), of(|c| c.wrong_color)])
    };
    let heard = scene.data.outside.iter().map(Hearing::verdict);
    Frame {
        number: scene.data.frame,
        panels,
        told: told.join("; "),
        row: scene.subjects.iter().map(cell).collect(),
        outside: (!scene.data.outside.is_empty()).then(|| Verdict::worst_of(heard).into()),
        verdicts,
    }
}
