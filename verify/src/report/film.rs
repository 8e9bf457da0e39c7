//! Frames of one animation as one thing on the page: consecutive scenes of one name come in, a film with its frames, each with the truth and
//! what differs from it, goes out. The page's own script turns it; without it the first frame is seen.

use super::view::{Badge, SceneView};
use super::words::{count, word};

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
    /// Of each subject its verdict and its wrong pixels.
    pub(super) row: Vec<(Badge, String)>,
}

/// What stands on the page in a row.
pub(super) enum Item<'a> {
    /// A frame by itself.
    Scene(&'a SceneView<'a>),
    /// Many of one animation.
    Film(Film<'a>),
}

/// Scenes in their order; those that follow each other under one name are one film.
pub(super) fn items<'a>(scenes: &'a [SceneView<'a>]) -> Vec<Item<'a>> {
    let same = |a: &SceneView<'_>, b: &SceneView<'_>| a.data.name == b.data.name && a.data.frames > 1;
    scenes
        .chunk_by(same)
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
    let mut panels = Vec::new();
    if let Some(truth) = &scene.truth {
        panels.push(("Truth".to_owned(), truth.as_str()));
    }
    let mut told = Vec::new();
    for subject in &scene.subjects {
        let name = &subject.data.name;
        if let Some(shown) = &subject.differing {
            let [_, (_, own), (_, difference)] = &shown.panels;
            panels.push((name.clone(), own.as_str()));
            panels.push((format!("Difference of {name}"), difference.as_str()));
        }
        told.push(match &subject.data.comparison {
            Some(c) => format!("{name}: {}, {} wrong pixels", word(subject.data.verdict), count(c.wrong_ids)),
            None => format!("{name}: {}", word(subject.data.verdict)),
        });
    }
    let cell = |subject: &super::view::SubjectView<'_>| {
        let wrong = subject.data.comparison.as_ref().map_or_else(String::new, |c| count(c.wrong_ids));
        (subject.badge, wrong)
    };
    Frame { number: scene.data.frame, panels, told: told.join("; "), row: scene.subjects.iter().map(cell).collect() }
}
