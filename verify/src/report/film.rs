//! Frames of one animation as one thing on the page: consecutive scenes of one name come in, a film with its frames, each with the truth and
//! what differs from it, goes out. The page's own script turns it; without it the first frame is seen.

use super::pictures::TRUTH;
use super::view::{Badge, SceneView};
use super::words::{count, word};
use crate::verdict::{Comparison, Verdict};

/// An animation on the page.
pub(super) struct Film<'a> {
    pub(super) anchor: String,
    pub(super) first: &'a SceneView<'a>,
    pub(super) frames: Vec<Frame<'a>>,
    pub(super) columns: Vec<&'a str>,
}

/// One of its frames.
pub(super) struct Frame<'a> {
    pub(super) number: usize,
    pub(super) panels: Vec<(String, &'a str)>,
    pub(super) told: String,
    /// Of each subject its verdict and its pixels with a wrong id, a wrong t, and a wrong colour.
    pub(super) row: Vec<(Badge, [String; 3])>,
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
            Self::Scene(scene) if scene.data.frames > 1 => {
                format!("{}, frame {}", scene.data.name, scene.data.frame)
            }
            Self::Scene(scene) => scene.data.name.clone(),
            Self::Film(film) => format!("{}, {} frames", film.first.data.name, film.frames.len()),
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
    Film {
        anchor: first.anchor.clone(),
        first,
        columns: first.subjects.iter().map(|subject| subject.data.name.as_str()).collect(),
        frames: scenes.iter().map(frame).collect(),
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
    let cell = |subject: &super::view::SubjectView<'_>| {
        let of = |which: fn(&Comparison) -> u64| {
            subject.data.comparison.as_ref().map_or_else(String::new, |c| count(which(c)))
        };
        (subject.badge, [of(|c| c.wrong_ids), of(|c| c.wrong_t), of(|c| c.wrong_color)])
    };
    Frame {
        number: scene.data.frame,
        panels,
        told: told.join("; "),
        row: scene.subjects.iter().map(cell).collect(),
        verdicts,
    }
}
