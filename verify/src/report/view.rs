//! The report as the page shows it: every number already a text, every picture already a `data:` URI, every place
//! on the page with its anchor. [`Report`](super::Report) data and encoded pictures come in, what the template
//! reads goes out; escaping is the template's.

use super::chart::Chart;
use super::outside::{Row, rows, sentences};
use super::pictures::{Differing, SubjectPictures};
use super::words::{NONE, count, duration, mega_rays, sign, word};
use super::{ScenePictures, SceneReport, SubjectReport};
use crate::verdict::{Comparison, Verdict};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;

/// A verdict as word, sign and style.
#[derive(Clone, Copy)]
pub(crate) struct Badge {
    pub(crate) class: &'static str,
    pub(crate) sign: &'static str,
    pub(crate) word: &'static str,
}

/// A scene on the page.
pub(super) struct SceneView<'a> {
    pub(super) anchor: String,
    pub(super) data: &'a SceneReport,
    pub(super) facts: Vec<(&'static str, String)>,
    pub(super) counters: Vec<(&'a str, String)>,
    pub(super) camera: [(&'static str, String, String); 4],
    pub(super) truth: Option<String>,
    pub(super) chart: Chart,
    pub(super) subjects: Vec<SubjectView<'a>>,
    pub(super) outside: Vec<Row>,
    pub(super) said: Vec<String>,
    /// Whether its pictures are shown larger than they are, so that their pixels are to be seen as such.
    pub(super) small: bool,
}

/// A subject on the page.
pub(super) struct SubjectView<'a> {
    pub(super) anchor: String,
    pub(super) data: &'a SubjectReport,
    pub(super) badge: Badge,
    pub(super) cells: Vec<String>,
    pub(super) time: Option<String>,
    pub(super) speed: String,
    pub(super) differing: Option<Shown>,
    /// Whether a picture was compared and no pixel of it differs.
    pub(super) same: bool,
}

/// Pictures of a difference, as URIs: each with the name of its panel.
pub(super) struct Shown {
    pub(super) panels: [(&'static str, String); 3],
    pub(super) zoom: [(&'static str, String); 3],
}

/// Pictures narrower than this are shown magnified.
const SMALL: u32 = 360;

/// Headings of [`SubjectView::cells`].
pub(super) const HEADINGS: [&str; 12] = [
    "wrong ids",
    "missing",
    "extra",
    "swapped",
    "wrong t",
    "ulp of t, median",
    "ulp of t, 99\u{a0}%",
    "ulp of t, most",
    "wrong colours",
    "by at most",
    "first wrong",
    "Mray/s",
];

impl From<Verdict> for Badge {
    fn from(verdict: Verdict) -> Self {
        let class = match verdict {
            Verdict::Equal => "equal",
            Verdict::WithinBound => "within",
            Verdict::Undecidable => "undecidable",
            Verdict::Wrong => "wrong",
            Verdict::NotJudged => "unjudged",
        };
        Self { class, sign: sign(verdict), word: word(verdict) }
    }
}

impl<'a> SceneView<'a> {
    pub(super) fn new(number: usize, data: &'a SceneReport, pictures: &ScenePictures) -> Self {
        let anchor = format!("scene-{number}");
        let picture = |k: usize| pictures.subjects.get(k).and_then(Option::as_ref);
        let subjects = data.subjects.iter().enumerate();
        let camera = [
            ("eye", &data.camera.eye),
            ("corner", &data.camera.corner),
            ("du", &data.camera.du),
            ("dv", &data.camera.dv),
        ];
        Self {
            facts: facts(data),
            counters: data.judge.counters.iter().map(|c| (c.name.as_str(), count(c.value))).collect(),
            camera: camera
                .map(|(name, v)| (name, v.decimal.map(|x| x.to_string()).join("  "), v.bits.join("  "))),
            truth: pictures.truth.as_deref().map(uri),
            chart: Chart::new(&data.subjects),
            subjects: subjects.map(|(k, s)| SubjectView::new(&anchor, k, s, picture(k))).collect(),
            outside: rows(&[data]),
            said: sentences(&[data]),
            anchor,
            data,
            small: data.width < SMALL,
        }
    }
}

fn facts(scene: &SceneReport) -> Vec<(&'static str, String)> {
    let pixels = u64::from(scene.width) * u64::from(scene.height);
    let mut facts = vec![
        ("spheres", count(u64::try_from(scene.spheres).unwrap_or(u64::MAX))),
        ("pixels", format!("{} × {}", scene.width, scene.height)),
        ("rays that hit", format!("{} of {}", count(scene.hits), count(pixels))),
        ("judge", scene.judge.name.clone()),
        ("from", scene.provenance.clone()),
    ];
    if scene.frames > 1 {
        facts.insert(1, ("frame", format!("{}, counted from 0, of {}", scene.frame, scene.frames)));
    }
    facts
}

impl<'a> SubjectView<'a> {
    fn new(scene: &str, k: usize, data: &'a SubjectReport, picture: Option<&SubjectPictures>) -> Self {
        let speed = mega_rays(data.rays_per_second);
        let mut cells = data.comparison.as_ref().map_or_else(|| vec![NONE.to_owned(); 11], cells);
        cells.push(speed.clone());
        let differing = picture.and_then(|picture| picture.differing.as_ref());
        Self {
            anchor: format!("{scene}-subject-{}", k + 1),
            badge: data.verdict.into(),
            cells,
            time: data.seconds.map(duration),
            speed,
            same: picture.is_some() && differing.is_none(),
            differing: differing.map(Shown::new),
            data,
        }
    }
}

fn cells(c: &Comparison) -> Vec<String> {
    let ulp = |value: u64| if c.t_ulp.count == 0 { NONE.to_owned() } else { count(value) };
    let first = c.first_wrong.map_or_else(|| NONE.to_owned(), |[x, y]| format!("{x}, {y}"));
    vec![
        count(c.wrong_ids),
        count(c.missing),
        count(c.extra),
        count(c.swapped),
        count(c.wrong_t),
        ulp(c.t_ulp.median),
        ulp(c.t_ulp.p99),
        ulp(c.t_ulp.max),
        count(c.wrong_color),
        count(c.color_max),
        first,
    ]
}

impl Shown {
    fn new(pictures: &Differing) -> Self {
        let named = |bytes: &[Vec<u8>; 3]| {
            let [promised, subject, difference] = bytes;
            [(pictures.against, uri(promised)), ("Subject", uri(subject)), ("Difference", uri(difference))]
        };
        Self { panels: named(&pictures.panels), zoom: named(&pictures.zoom) }
    }
}

fn uri(png: &[u8]) -> String {
    "data:image/png;base64,".to_owned() + &BASE64_STANDARD.encode(png)
}
