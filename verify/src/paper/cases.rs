//! Smallest counterexamples: cases of `tests/cases`, judged again by whoever asks, and told with their numbers.

use crate::case::{Case, Judged};
use crate::verdict::Verdict;
use contract::{Image, MISS};

/// A file of `tests/cases`.
pub(super) struct Kept {
    name: &'static str,
    bytes: &'static [u8],
}

macro_rules! kept {
    ($constant:ident, $name:literal) => {
        pub(super) const $constant: Kept = Kept {
            name: concat!("tests/cases/", $name, ".json"),
            bytes: include_bytes!(concat!("../../bundled/", $name, ".json")),
        };
    };
}

kept!(CORNERS, "paper-eight-corners-miss-the-middle");
kept!(ROUNDED, "paper-rounded-boxes");
kept!(OVERFLOW, "paper-queue-overflows");
kept!(PRINTED, "paper-printed-loop");
kept!(FAR, "paper-textbook-far-away");
kept!(LETTER, "paper-to-the-letter");

impl Kept {
    /// What it shows, if it still does: file, size, and what came instead of what.
    pub(super) fn told(&self) -> Option<String> {
        let case = Case::from_json(self.bytes).ok()?;
        let judged = case.judge().ok()?;
        let frame = judged.iter().position(|judged| judged.judgement.verdict == Verdict::Wrong)?;
        let Judged { promised, picture, wrong, .. } = &judged[frame];
        let [x, y] = (*wrong)?;
        let spheres = case.frames.frames()[frame].spheres().len();
        let (size, word) = (case.camera.size(), if spheres == 1 { "sphere" } else { "spheres" });
        let index = y as usize * size.width() as usize + x as usize;
        Some(format!(
            "`{}`: {spheres} {word}, {}x{} pixels, {} where {} is right",
            self.name,
            size.width(),
            size.height(),
            answer(picture, index),
            answer(promised, index),
        ))
    }

    /// The command that tells it step by step.
    pub(super) fn command(&self) -> String {
        format!("cargo run --release -- replay {}", self.name)
    }
}

fn answer(image: &Image, index: usize) -> String {
    match image.ids[index] {
        MISS => "a miss".into(),
        id => format!("sphere {id} at t = {:?}", image.t[index]),
    }
}
