//! A chart as a part of a page: for each scene speed against error from near, then error over distance, and all numbers in tables.

use super::data::{Chart, Point, View};
use crate::methods::Family;
use crate::plot::scatter::{Dot, Shape, scatter};
use crate::plot::{Axes, Scaling, Series, plot, power, short};
use crate::report::chapter::Chapter;
use crate::report::words::{NONE, count, figure};
use askama::Template;

#[derive(Template)]
#[template(path = "chart-part.html")]
struct Part<'a> {
    chart: &'a Chart,
    legend: Vec<(&'static str, String)>,
    scenes: Vec<SceneCharts>,
}

/// Of a scene.
struct SceneCharts {
    name: String,
    facts: String,
    said: Vec<String>,
    wrong: Option<String>,
    ulp: Option<String>,
    cycles: Option<String>,
    over: Vec<(&'static str, String)>,
    tables: Vec<Table>,
}

/// Of a view.
struct Table {
    heading: String,
    rows: Vec<(String, Vec<String>)>,
    remarks: Vec<String>,
}

/// The part, as it stands in a page that has the style of charts.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn part(chart: &Chart) -> Result<String, askama::Error> {
    let mut names: Vec<&str> = chart.views.iter().map(|view| view.scene.as_str()).collect();
    names.dedup();
    let legend = Family::ALL.into_iter().filter(|family| {
        chart.views.iter().flat_map(|view| &view.points).any(|point| point.family == *family)
    });
    let part = Part {
        chart,
        legend: legend.map(|family| (family.words(), sample(family))).collect(),
        scenes: names.into_iter().filter_map(|name| scene(chart, name)).collect(),
    };
    part.render()
}

/// A page of its own.
///
/// # Errors
/// As [`part`].
pub fn page(chart: &Chart) -> Result<String, askama::Error> {
    let heading = "Speed against accuracy";
    Chapter::plain(heading, ("chart", chart.schema_version), &part(chart)?, &chart.environment).render()
}

/// A family's mark, small.
fn sample(family: Family) -> String {
    let mut svg = format!(
        "<svg width=\"16\" height=\"16\" aria-hidden=\"true\" class=\"plot-key\"><g class=\"dot {}\">",
        family.class()
    );
    shape(family).draw(&mut svg, [8.0, 8.0]);
    svg + "</g></svg>"
}

fn shape(family: Family) -> Shape {
    match family {
        Family::Exact => Shape::Circle,
        Family::F64 | Family::Perpendicular | Family::Foreign => Shape::Square,
        Family::Textbook => Shape::Triangle,
        Family::Spu | Family::Peer => Shape::Down,
        Family::Paper | Family::Embree => Shape::Diamond,
    }
}

fn scene(chart: &Chart, name: &str) -> Option<SceneCharts> {
    let views: Vec<&View> = chart.views.iter().filter(|view| view.scene == name).collect();
    let near = *views.first()?;
    let embree =
        near.points.iter().filter(|point| point.family == Family::Embree && point.ns_per_ray.is_some());
    let fastest =
        embree.min_by(|a, b| a.ns_per_ray.unwrap_or_default().total_cmp(&b.ns_per_ray.unwrap_or_default()));
    let best_outside = fastest.map(|point| point.method.as_str());
    let by = |error: fn(&Point) -> Option<f64>, time: fn(&Point) -> Option<f64>| -> Vec<Dot> {
        near.points.iter().filter_map(|point| dot(point, error(point)?, time(point)?, best_outside)).collect()
    };
    let ns = |point: &Point| point.ns_per_ray;
    let cycles = |point: &Point| point.spu_cycles_per_ray.map(|[_, most]| most);
    let ulp = |point: &Point| point.comparison.as_ref().map(|c| c.t_ulp.p99 as f64);
    let draw = |what: &str, titles, dots: Vec<Dot>| scatter(&format!("{name}: {what}"), titles, &dots);
    Some(SceneCharts {
        facts: format!(
            "{} spheres, {} × {} pixels of which {} hit; the eye is {} radii away",
            count(near.spheres as u64),
            near.size[0],
            near.size[1],
            count(near.hits),
            figure(near.radii)
        ),
        said: said(&views),
        wrong: draw(
            "time a ray against wrong pixels",
            ["wrong pixels in a million", "ns a ray"],
            by(Point::wrong_per_million, ns),
        ),
        ulp: draw(
            "time a ray against the error of t",
            ["error of t at 99 in 100, in units in the last place", "ns a ray"],
            by(ulp, ns),
        ),
        cycles: draw(
            "cycles a ray on the SPU against wrong pixels",
            ["wrong pixels in a million", "cycles a ray on an SPU, at most"],
            by(Point::wrong_per_million, cycles),
        ),
        over: over(name, &views),
        tables: views.iter().map(|view| table(view)).collect(),
        name: name.to_owned(),
    })
}

fn dot(point: &Point, error: f64, time: f64, best_outside: Option<&str>) -> Option<Dot> {
    // Of many that are alike one name is enough: of Embree's ways that of the fastest.
    let named = !point.method.contains('@') || best_outside == Some(&point.method);
    (time > 0.0).then(|| Dot {
        label: point.method.clone(),
        told: format!("{}: error {}, {}", point.method, figure(error), figure(time)),
        class: point.family.class(),
        shape: shape(point.family),
        at: [error, time],
        named,
    })
}

/// Who is fastest without an error, and by how much.
fn said(views: &[&View]) -> Vec<String> {
    let mut said = Vec::new();
    for view in views {
        let mut right: Vec<&Point> = view
            .points
            .iter()
            .filter(|p| p.wrong_per_million() == Some(0.0) && p.ns_per_ray.is_some())
            .collect();
        right.sort_by(|a, b| a.ns_per_ray.unwrap_or_default().total_cmp(&b.ns_per_ray.unwrap_or_default()));
        let asked = view.points.iter().filter(|point| point.comparison.is_some()).count();
        let away = format!("{} radii away", short(view.radii.round()));
        said.push(match right.first() {
            None => format!("{away} none of {asked} methods shows the right sphere in every pixel."),
            Some(best) => format!(
                "{away} {} of {asked} methods show the right sphere in every pixel; of these {} is the fastest, {} ns a ray.",
                right.len(),
                best.method,
                best.ns_per_ray.map_or_else(|| NONE.to_owned(), figure)
            ),
        });
    }
    said
}

/// Error over distance, of those that stand for their family.
fn over(name: &str, views: &[&View]) -> Vec<(&'static str, String)> {
    if views.len() < 2 {
        return Vec::new();
    }
    let drawn = [
        "fast",
        "naive-f64",
        "safe",
        "safe-textbook",
        "safe-spu-perpendicular",
        "safe-spu-textbook",
        "paper",
        "embree-16@avx512",
        "embree-16@avx2",
        "bvh",
        "parry3d",
    ];
    let series = |of: fn(&Point) -> Option<f64>| -> Vec<Series> {
        let line = |method: &&str| {
            let at = |view: &&View| {
                let point = view.points.iter().find(|point| point.method == **method)?;
                Some(([view.radii, of(point)?], point.family.class()))
            };
            let found: Vec<_> = views.iter().filter_map(at).collect();
            let class = found.first()?.1;
            Some(Series {
                label: (*method).into(),
                class,
                points: found.into_iter().map(|(point, _)| point).collect(),
            })
        };
        drawn.iter().filter_map(line).collect()
    };
    let axes = |y| Axes {
        x: "distance of the eye in radii",
        y,
        x_word: &short,
        y_word: power,
        x_scaling: Scaling::Logarithmic,
        y_scaling: Scaling::WithZero,
        joined: true,
    };
    let charts = [
        (
            "Wrong pixels over distance",
            plot(
                &format!("{name}: wrong pixels over distance"),
                axes("wrong in a million"),
                &series(Point::wrong_per_million),
                &[],
            ),
        ),
        (
            "Error of t over distance",
            plot(
                &format!("{name}: error of t over distance"),
                axes("ulp of t, median"),
                &series(|point| point.comparison.as_ref().map(|c| c.t_ulp.median as f64)),
                &[],
            ),
        ),
    ];
    charts.into_iter().filter_map(|(title, svg)| Some((title, svg?))).collect()
}

/// Headings of a table's cells.
const HEADINGS: [&str; 11] = [
    "ns a ray",
    "SPU cycles a ray",
    "wrong pixels",
    "in a million",
    "wrong t",
    "ulp of t, median",
    "99 %",
    "most",
    "wrong colours",
    "by at most",
    "on the front",
];

fn table(view: &View) -> Table {
    let at: Vec<[f64; 2]> = view
        .points
        .iter()
        .map(|p| [p.wrong_per_million().unwrap_or(f64::INFINITY), p.ns_per_ray.unwrap_or(f64::INFINITY)])
        .collect();
    let front = crate::plot::scatter::front(&at);
    let row = |(point, best): (&Point, bool)| {
        let of = |get: fn(&crate::verdict::Comparison) -> u64| {
            point.comparison.as_ref().map_or_else(|| NONE.to_owned(), |c| count(get(c)))
        };
        let color = |get| if point.paints { of(get) } else { NONE.to_owned() };
        let cells = vec![
            point.ns_per_ray.map_or_else(|| NONE.to_owned(), figure),
            point
                .spu_cycles_per_ray
                .map_or_else(|| NONE.to_owned(), |[a, b]| format!("{}–{}", figure(a), figure(b))),
            of(|c| c.wrong_ids),
            point.wrong_per_million().map_or_else(|| NONE.to_owned(), figure),
            of(|c| c.wrong_t),
            of(|c| c.t_ulp.median),
            of(|c| c.t_ulp.p99),
            of(|c| c.t_ulp.max),
            color(|c| c.wrong_color),
            color(|c| c.color_max.into()),
            if best && point.ns_per_ray.is_some() { "yes".into() } else { String::new() },
        ];
        (point.method.clone(), cells)
    };
    Table {
        heading: format!("{}, {} radii away", view.scene, short(view.radii.round())),
        rows: view.points.iter().zip(front).map(row).collect(),
        remarks: view
            .points
            .iter()
            .filter_map(|p| Some(format!("{}: {}", p.method, p.remark.as_ref()?)))
            .collect(),
    }
}

impl Part<'_> {
    fn headings(&self) -> [&'static str; 11] {
        HEADINGS
    }
}
