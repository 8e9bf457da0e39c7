//! The report as one HTML page that needs nothing but itself: style inline, pictures as `data:` URIs, and two scripts, one that turns films and
//! one for a live view. A [`Report`], the pictures of its scenes and what else belongs on the page come in, the page goes out. All text is escaped by
//! the template `templates/report.html`; its content security policy forbids it to load anything, and any script but these, which it knows by
//! their hashes. A page without a film lacks the one, and a page without a live view the other and the leave to compile WebAssembly.

use super::film::{Item, items};
use super::outside;
use super::pictures::ZOOM_SIDE;
use super::view::{Badge, HEADINGS, SceneView};
use super::words::{VERDICTS, Whose, sentence};
use super::{Evidence, Live, Report, ScenePictures};
use crate::picture::{PALETTE, RARE};
use askama::Template;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest, Sha256};

/// The page's scripts.
const SCRIPT: &str = include_str!("../../templates/report.js");
const LIVE_SCRIPT: &str = include_str!("../../templates/live.js");

/// A chapter of the page that other modules wrote, in the style of this one.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its anchor.
    pub anchor: &'static str,
    /// Its heading.
    pub title: String,
    /// Its HTML, all text in it escaped.
    pub body: String,
}

#[derive(Template)]
#[template(path = "report.html")]
struct Page<'a> {
    report: &'a Report,
    badge: Badge,
    sentence: &'static str,
    tally: Vec<(Badge, usize)>,
    known_faults: Vec<&'a str>,
    headings: [&'static str; 12],
    outside_headings: Vec<String>,
    legend: Vec<(String, &'static str)>,
    how_drawn: String,
    zoom_side: u32,
    evidence: Vec<(&'static str, usize)>,
    columns: Vec<&'a str>,
    scenes: &'a [SceneView<'a>],
    items: Vec<Item<'a>>,
    parts: &'a [Part],
    live: Option<&'a Live>,
    /// What the policy allows; empty if there is no script.
    policy: String,
    scripts: Vec<&'static str>,
}

/// The page. `pictures` has one entry for each scene; what lacks is left out of the page. `parts` follow the scenes.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn html(report: &Report, pictures: &[ScenePictures], parts: &[Part]) -> Result<String, askama::Error> {
    let none = ScenePictures::default();
    let scenes = report.scenes.iter().enumerate();
    let scenes: Vec<SceneView<'_>> =
        scenes.map(|(k, scene)| SceneView::new(k + 1, scene, pictures.get(k).unwrap_or(&none))).collect();
    let items = items(&scenes);
    let turns = items.iter().any(|item| matches!(item, Item::Film(_)));
    let live = pictures.first().and_then(|set| set.live.as_ref());
    let scripts: Vec<&str> =
        turns.then_some(SCRIPT).into_iter().chain(live.is_some().then_some(LIVE_SCRIPT)).collect();
    let page = Page {
        report,
        badge: report.verdict.into(),
        sentence: sentence(report.verdict, whose(report)),
        tally: tally(report),
        known_faults: known_faults(report),
        headings: HEADINGS,
        outside_headings: outside::HEADINGS
            .map(str::to_owned)
            .into_iter()
            .chain(outside::classes())
            .collect(),
        legend: PALETTE
            .iter()
            .map(|(_, [r, g, b], what)| (format!("#{r:02x}{g:02x}{b:02x}"), *what))
            .collect(),
        how_drawn: format!(
            "The ring marks the first wrong pixel. Faults of fewer than one pixel in {RARE} are drawn larger."
        ),
        zoom_side: ZOOM_SIDE,
        evidence: Evidence::ALL.iter().map(|kind| (kind.word(), rests_on(report, *kind))).collect(),
        columns: columns(report),
        live,
        policy: policy(&scripts, live.is_some()),
        items,
        scenes: &scenes,
        parts,
        scripts,
    };
    page.render()
}

/// What of its content security policy depends on the page: these scripts, and whether they may compile WebAssembly.
fn policy(scripts: &[&str], compiles: bool) -> String {
    if scripts.is_empty() {
        return String::new();
    }
    let hash = |script: &&str| format!(" 'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(script)));
    let hashes: String = scripts.iter().map(hash).collect();
    format!("; script-src{hashes}{}", if compiles { " 'wasm-unsafe-eval'" } else { "" })
}

/// Who alone has the verdict of the whole, subjects before witnesses.
fn whose(report: &Report) -> Whose {
    let subjects = report.scenes.iter().flat_map(|scene| &scene.subjects).filter(|s| !s.known_fault);
    let mut witnesses = report.scenes.iter().flat_map(|scene| &scene.outside);
    match report.verdict {
        verdict if subjects.map(|subject| subject.verdict).any(|own| own == verdict) => Whose::Subject,
        verdict if witnesses.any(|hearing| hearing.verdict() == verdict) => Whose::Witness,
        _ if !report.broken.is_empty() => Whose::Chapter,
        _ => Whose::Subject,
    }
}

/// How often each verdict was given, zeros included; known faults are not counted.
fn tally(report: &Report) -> Vec<(Badge, usize)> {
    let counted = || report.scenes.iter().flat_map(|scene| &scene.subjects).filter(|s| !s.known_fault);
    let given = |verdict| counted().filter(|subject| subject.verdict == verdict).count();
    VERDICTS.map(|verdict| (Badge::from(verdict), given(verdict))).to_vec()
}

/// Subjects that are shown as known faults, each once.
fn known_faults(report: &Report) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for subject in
        report.scenes.iter().flat_map(|scene| &scene.subjects).filter(|subject| subject.known_fault)
    {
        if !names.contains(&subject.name.as_str()) {
            names.push(&subject.name);
        }
    }
    names
}

fn rests_on(report: &Report, kind: Evidence) -> usize {
    report.claims.iter().filter(|claim| claim.evidence == kind).count()
}

/// The names of all subjects, each once, in the order of their first scene.
fn columns(report: &Report) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for subject in report.scenes.iter().flat_map(|scene| &scene.subjects) {
        if !names.contains(&subject.name.as_str()) {
            names.push(&subject.name);
        }
    }
    names
}
