//! What outside witnesses said, in words: a line for each witness on each scene or film, and the rows of the page's table.
//! Scenes with their hearings come in, texts go out. A hearing that failed says so first.

use super::SceneReport;
use super::view::Badge;
use super::words::{count, word};
use crate::judge::outside::{Hearing, ULP_CLASSES};
use crate::verdict::Verdict;

/// Headings of [`rows`], but for the error classes of t.
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

/// What a witness, asked in one way, said of a scene or of all frames of a film, as a row of the table.
pub(super) struct Row {
    pub(super) name: String,
    pub(super) badge: Badge,
    pub(super) cells: Vec<String>,
}

/// A row for each witness and each way in which it was asked.
pub(super) fn rows(frames: &[&SceneReport]) -> Vec<Row> {
    let all = || frames.iter().flat_map(|scene| &scene.outside);
    let asked = |hearing: &Hearing| format!("{}, {}", hearing.witness, hearing.mode);
    let row = |name: String| {
        let (verdict, data) = summed(all().filter(|hearing| asked(hearing) == name));
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
        Row { name, badge: verdict.into(), cells }
    };
    each_once(all().map(asked)).into_iter().map(row).collect()
}

/// Hearings added up. What a witness left open in one frame no other frame makes good, so the verdict is the worst of all.
fn summed<'a>(hearings: impl Iterator<Item = &'a Hearing> + Clone) -> (Verdict, Hearing) {
    let verdict = Verdict::worst_of(hearings.clone().map(Hearing::verdict));
    (verdict, hearings.fold(Hearing::default(), Hearing::and))
}

fn each_once<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut met = Vec::new();
    for one in all {
        if !met.contains(&one) {
            met.push(one);
        }
    }
    met
}

/// Headings of the histogram of t's error.
pub(super) fn classes() -> Vec<String> {
    let upper = ULP_CLASSES
        .into_iter()
        .map(|end| if end == 0 { "0 ulp".into() } else { format!("≤ {}", count(end)) });
    upper.chain(["more".to_owned()]).collect()
}

/// A sentence for each witness of a scene, or of all frames of a film.
pub(super) fn sentences(frames: &[&SceneReport]) -> Vec<String> {
    let all =
        || frames.iter().flat_map(|scene| scene.outside.iter().map(move |hearing| (scene.frame, hearing)));
    let of = |name: &str| -> Vec<(usize, &Hearing)> { all().filter(|(_, h)| h.witness == name).collect() };
    let what = frames.first().map_or_else(String::new, |scene| scene.called(frames.len()));
    let film = frames.len() > 1;
    let witnesses = each_once(all().map(|(_, hearing)| hearing.witness.as_str()));
    witnesses.into_iter().map(|name| sentence(&what, film, name, &of(name))).collect()
}

fn sentence(what: &str, film: bool, witness: &str, hearings: &[(usize, &Hearing)]) -> String {
    let (verdict, sum) = summed(hearings.iter().map(|(_, hearing)| *hearing));
    let ways = each_once(hearings.iter().map(|(_, hearing)| &hearing.mode));
    let modes = each_once(ways.iter().map(|mode| mode.split(',').next().unwrap_or_default()));
    let mut text = format!(
        "{witness} on {what}: {}. Asked in {} ways ({}), {} rays: {} in its band, of which integers decided {} for the \
         reference and {} as ties; {} not stated; t off by at most {} ulp.",
        word(verdict),
        ways.len(),
        modes.join(", "),
        count(sum.rays),
        count(sum.in_band),
        count(sum.inside.reference),
        count(sum.inside.ties),
        count(sum.not_stated[0]),
        count(sum.t_ulp_max),
    );
    if sum.failures() > 0 {
        let first = hearings.iter().find_map(|(frame, hearing)| Some((frame, hearing.first.as_deref()?)));
        let first = match first {
            Some((frame, first)) if film => format!("in frame {frame}: {first}"),
            first => first.map_or_else(String::new, |(_, first)| first.to_owned()),
        };
        text += &format!(" {} answers cannot be explained, the first: {first}.", count(sum.failures()));
    }
    text
}
