//! What outside witnesses said, in words: a line for each witness on each scene, and the rows of the page's table.
//! Hearings come in, texts go out. A hearing that failed says so first.

use super::SceneReport;
use super::view::Badge;
use super::words::{count, word};
use crate::judge::outside::{Hearing, ULP_CLASSES};

/// Headings of [`row`], but for the error classes of t.
pub(super) const HEADINGS: [&str; 9] = [
    "rays",
    "seen by both",
    "not stated",
    "of these different",
    "in the band",
    "decided for the reference",
    "ties",
    "failures",
    "ulp of t, most",
];

/// A hearing as a row of the table.
pub(super) struct Row<'a> {
    pub(super) data: &'a Hearing,
    pub(super) badge: Badge,
    pub(super) cells: Vec<String>,
}

impl<'a> Row<'a> {
    pub(super) fn new(data: &'a Hearing) -> Self {
        let cells = [
            data.rays,
            data.hits,
            data.not_stated[0],
            data.not_stated[1],
            data.in_band,
            data.inside.reference,
            data.inside.ties,
            data.failures(),
            data.t_ulp_max,
        ];
        let cells = cells.into_iter().chain(data.t_ulp).map(count).collect();
        Self { data, badge: data.verdict().into(), cells }
    }
}

/// Headings of the histogram of t's error.
pub(super) fn classes() -> Vec<String> {
    let upper = ULP_CLASSES
        .into_iter()
        .map(|end| if end == 0 { "0 ulp".into() } else { format!("≤ {}", count(end)) });
    upper.chain(["more".to_owned()]).collect()
}

/// A sentence for each witness of a scene.
pub(super) fn sentences(scene: &SceneReport) -> Vec<String> {
    let mut witnesses: Vec<&str> = Vec::new();
    for hearing in &scene.outside {
        if !witnesses.contains(&hearing.witness.as_str()) {
            witnesses.push(&hearing.witness);
        }
    }
    let of = |name: &str| -> Vec<&Hearing> { scene.outside.iter().filter(|h| h.witness == name).collect() };
    witnesses.into_iter().map(|name| sentence(&scene.name, name, &of(name))).collect()
}

fn sentence(scene: &str, witness: &str, hearings: &[&Hearing]) -> String {
    let (mut modes, mut sum): (Vec<&str>, _) = (Vec::new(), Hearing::default());
    for hearing in hearings {
        let mode = hearing.mode.split(',').next().unwrap_or_default();
        if !modes.contains(&mode) {
            modes.push(mode);
        }
        sum = sum.and(hearing);
    }
    let mut text = format!(
        "{witness} on {scene}: {}. Asked in {} ways ({}), {} rays: {} in its band, of which integers decided {} for the \
         reference and {} as ties; {} not stated; t off by at most {} ulp.",
        word(sum.verdict()),
        hearings.len(),
        modes.join(", "),
        count(sum.rays),
        count(sum.in_band),
        count(sum.inside.reference),
        count(sum.inside.ties),
        count(sum.not_stated[0]),
        count(sum.t_ulp_max),
    );
    if sum.failures() > 0 {
        let first = sum.first.as_deref().unwrap_or_default();
        text += &format!(" {} answers cannot be explained, the first: {first}.", count(sum.failures()));
    }
    text
}
