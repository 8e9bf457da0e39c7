//! A benchmark as one HTML page that needs nothing but itself: the ratios, a chart over the scenes, every contestant of
//! every scene in a table, and the curves. A [`Bench`] comes in, the page goes out; its data stands in the JSON file.

use super::contestant::Kind;
use super::data::{Bench, Curve, Row, SceneBench};

use super::text::sentences;
use crate::plot::{Axes, Scaling, Series, plot, short};
use crate::report::chapter::Chapter;
use crate::report::view::Badge;
use crate::report::words::{NONE, count, duration, figure};
use askama::Template;

#[derive(Template)]
#[template(path = "bench-part.html")]
struct Part {
    said: Vec<String>,
    tops: Vec<(&'static str, String)>,
    overview: Option<String>,
    tables: Vec<Table>,
    curves: Vec<Shown>,
}

/// A scene's contestants.
struct Table {
    heading: String,
    facts: String,
    ratios: Vec<(&'static str, String)>,
    rows: Vec<Line>,
}

/// One of them.
struct Line {
    name: String,
    description: String,
    badge: Badge,
    cells: Vec<String>,
    remark: Option<String>,
}

/// A curve and the scenes that it is made of.
struct Shown {
    title: &'static str,
    chart: Option<String>,
    growth: Vec<String>,
    tables: Vec<Table>,
}

/// The page.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn page(bench: &Bench) -> Result<String, askama::Error> {
    let badge = Badge::from(bench.verdict());
    let outsiders: String = bench.outsiders.iter().map(|name| format!(", {name}")).collect();
    Chapter {
        over: &format!("How fast: {} at {}{outsiders}", bench.plan, bench.level),
        sign: badge.sign,
        heading: badge.word,
        class: badge.class,
        lead: "",
        body: &part(bench)?,
        environment: &bench.environment,
        beside: format!(
            "The same data, to be read by programs: bench.json, schema {}.",
            bench.schema_version
        ),
    }
    .render()
}

/// What of it stands in a page of more.
///
/// # Errors
/// As [`page`].
pub fn part(bench: &Bench) -> Result<String, askama::Error> {
    let summary = bench.summary;
    let tops = [
        ("times as fast as Embree, geometric mean", summary.ratio_to_embree_mean),
        ("times at least", summary.ratio_to_embree_least),
        ("times the clairvoyant's time, geometric mean", summary.ratio_to_limit_mean),
        ("times at most", summary.ratio_to_limit_most),
        ("times the best plan's time at most", summary.ratio_to_picked_most),
    ];
    let part = Part {
        said: sentences(bench),
        tops: tops.into_iter().filter_map(|(what, value)| Some((what, figure(value?)))).collect(),
        overview: overview(&bench.scenes),
        tables: bench.scenes.iter().map(table).collect(),
        curves: bench.curves.iter().map(shown).collect(),
    };
    part.render()
}

fn table(scene: &SceneBench) -> Table {
    let frame = if scene.frame > 0 { format!(", frame {}", scene.frame) } else { String::new() };
    let ratios = [
        ("ratio to Embree", scene.ratio_to_embree),
        ("ratio to the limit", scene.ratio_to_limit),
        ("ratio to the best plan picked by hand", scene.ratio_to_picked),
    ];
    let own = scene.subject().and_then(Row::seconds);
    Table {
        heading: format!("{}{frame}", scene.name),
        facts: format!(
            "{} spheres, {} × {} pixels of which {} hit, {} threads, {} rounds. Truth: {}.",
            count(scene.spheres as u64),
            scene.width,
            scene.height,
            count(scene.truth.hits as u64),
            scene.threads,
            scene.rounds,
            scene.truth.how
        ),
        ratios: ratios.into_iter().filter_map(|(what, value)| Some((what, figure(value?)))).collect(),
        rows: scene.contestants.iter().map(|row| line(row, own)).collect(),
    }
}

fn line(row: &Row, own: Option<f64>) -> Line {
    let time = |of: fn(&super::rounds::Timing) -> f64| {
        row.timing.as_ref().map_or_else(|| NONE.to_owned(), |timing| duration(of(timing)))
    };
    let or_none = |value: Option<String>| value.unwrap_or_else(|| NONE.to_owned());
    Line {
        name: row.name.clone(),
        description: row.description.clone(),
        badge: row.verdict.into(),
        cells: vec![
            count(row.differing),
            count(row.wrong),
            time(|t| t.build.median),
            time(|t| t.trace.median),
            time(|t| t.total.median),
            time(|t| t.total.lower_quartile),
            time(|t| t.total.upper_quartile),
            or_none(row.timing.map(|t| t.frames.to_string())),
            or_none(row.mega_rays_per_second.map(figure)),
            or_none(row.seconds().zip(own).map(|(seconds, own)| figure(seconds / own))),
        ],
        remark: row.remark.clone(),
    }
}

/// The class that a part has in the page's style.
fn class(row: &Row) -> &'static str {
    match row.kind {
        Kind::Subject => "subject",
        Kind::Limit | Kind::Picked | Kind::Naive => "limit",
        Kind::Embree => "embree",
        Kind::Peer if row.name == "bvh" => "peer",
        Kind::Peer => "other",
    }
}

/// What is drawn of a scene: everyone that was timed, of Embree the best, no plan picked by hand.
fn drawn(scene: &SceneBench) -> impl Iterator<Item = &Row> {
    scene.contestants.iter().filter(|row| match row.kind {
        Kind::Embree => Some(&row.name) == scene.embree_best.as_ref(),
        Kind::Picked => false,
        Kind::Subject | Kind::Limit | Kind::Naive | Kind::Peer => true,
    })
}

/// A label that Embree's ways share.
fn label(row: &Row) -> String {
    if row.kind == Kind::Embree { "Embree".into() } else { row.name.clone() }
}

/// Speed over scenes, these side by side.
fn overview(scenes: &[SceneBench]) -> Option<String> {
    let series = gathered(scenes.iter().zip(1_u32..).flat_map(|(scene, k)| {
        drawn(scene)
            .filter_map(move |row| Some((label(row), class(row), [f64::from(k), row.mega_rays_per_second?])))
    }));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "numbers of scenes")]
    let name = |x: f64| scenes.get(x as usize - 1).map_or_else(String::new, |scene| scene.name.clone());
    let axes = Axes {
        x: "scenes",
        y: "Mray/s",
        x_word: &name,
        y_word: figure,
        x_scaling: Scaling::Linear,
        y_scaling: Scaling::Logarithmic,
        joined: false,
    };
    plot("Millions of rays a second on each scene", axes, &series, &[])
}

/// Points that belong together, in the order in which they are first met.
fn gathered(points: impl Iterator<Item = (String, &'static str, [f64; 2])>) -> Vec<Series> {
    let mut all: Vec<Series> = Vec::new();
    for (label, class, point) in points {
        match all.iter_mut().find(|series| series.label == label && series.class == class) {
            Some(series) => series.points.push(point),
            None => all.push(Series { label, class, points: vec![point] }),
        }
    }
    all
}

fn shown(curve: &Curve) -> Shown {
    let totals = curve.points.iter().flat_map(|point| {
        drawn(&point.scene).filter_map(|row| Some((label(row), class(row), [point.x, row.seconds()?])))
    });
    let builds = curve.points.iter().flat_map(|point| {
        let built = drawn(&point.scene).filter(|row| matches!(row.kind, Kind::Subject | Kind::Embree));
        built.filter_map(|row| {
            let class = if row.kind == Kind::Subject { "subject build" } else { "embree build" };
            Some((format!("{}, build", label(row)), class, [point.x, row.timing?.build.median]))
        })
    });
    let series = match curve.over {
        "spheres" => gathered(totals.chain(builds)),
        _ => gathered(totals),
    };
    let (title, x) = match curve.over {
        "spheres" => ("Spheres", "random spheres in a cube"),
        "pixels" => ("Pixels", "pixels"),
        _ => ("Threads", "threads"),
    };
    let axes = Axes {
        x,
        y: "time of a frame",
        x_word: &short,
        y_word: duration,
        x_scaling: if curve.over == "threads" { Scaling::Linear } else { Scaling::Logarithmic },
        y_scaling: Scaling::Logarithmic,
        joined: true,
    };
    Shown {
        title,
        chart: plot(&format!("Time of a frame over {}", curve.over), axes, &series, &[]),
        growth: curve.growth.iter().map(super::text::growth).collect(),
        tables: curve.points.iter().map(|point| table(&point.scene)).collect(),
    }
}
