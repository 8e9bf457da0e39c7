//! An ablation as a part of a page: for each base its variants, scene beside scene.

use super::data::{Ablation, Row};
use crate::report::chapter::Chapter;
use crate::report::words::{NONE, count, figure};
use crate::spu::feature::Feature;
use askama::Template;

#[derive(Template)]
#[template(path = "ablation-part.html")]
struct Part {
    scenes: Vec<String>,
    chosen: Vec<String>,
    bases: Vec<Base>,
    model: Vec<Model>,
}

/// The model without a feature.
struct Model {
    name: &'static str,
    rates: Vec<String>,
    changed: Vec<String>,
}

/// A base over all scenes.
struct Base {
    name: String,
    what: String,
    plan: String,
    on_spu: bool,
    own: Vec<[String; 3]>,
    rows: Vec<(String, String, Vec<[String; 3]>)>,
}

/// The part, as it stands in a page that has the style of charts.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn part(ablation: &Ablation) -> Result<String, askama::Error> {
    let scenes = &ablation.scenes;
    let number = |value: Option<f64>| value.map_or_else(|| NONE.to_owned(), figure);
    let whole = |value: Option<u64>| value.map_or_else(|| NONE.to_owned(), count);
    let bases = scenes.first().map_or(&[][..], |scene| &scene.bases).iter().enumerate().map(|(k, base)| {
        let own = scenes.iter().map(|scene| {
            let base = &scene.bases[k];
            let cycles = base.cycles_per_ray.map(|[_, most]| most);
            [number(base.ns_per_ray), number(cycles), whole(base.wrong)]
        });
        let rows = base.rows.iter().enumerate().map(|(j, row)| {
            let cell = |row: &Row| [number(row.time), number(row.cycles), whole(row.wrong)];
            let cells = scenes.iter().map(|scene| cell(&scene.bases[k].rows[j])).collect();
            (row.concern.clone(), row.choice.clone(), cells)
        });
        Base {
            name: base.name.clone(),
            what: base.what.clone(),
            plan: base.plan.clone(),
            on_spu: base.cycles_per_ray.is_some(),
            own: own.collect(),
            rows: rows.collect(),
        }
    });
    let chosen = scenes.iter().filter_map(|scene| {
        let (ratio, best) = (scene.chosen_by_best?, scene.best_picked.as_ref()?);
        Some(format!(
            "{}: the plan chosen from the scene alone takes {} times as long as the best of those picked by hand ({best}). {}.",
            scene.scene,
            figure(ratio),
            scene.reasons.join("; ")
        ))
    });
    let model = ablation.model.iter().map(|row| Model {
        name: row.feature.map_or("nothing", Feature::words),
        rates: row
            .frames_per_second
            .iter()
            .map(|(_, [a, b])| format!("{}–{}", figure(*a), figure(*b)))
            .collect(),
        changed: row
            .changed
            .iter()
            .map(|(claim, before, after)| format!("{claim}: {} becomes {}", before.word(), after.word()))
            .collect(),
    });
    Part {
        model: model.collect(),
        scenes: scenes.iter().map(|scene| scene.scene.clone()).collect(),
        chosen: chosen.collect(),
        bases: bases.collect(),
    }
    .render()
}

/// A page of its own.
///
/// # Errors
/// As [`part`].
pub fn page(ablation: &Ablation) -> Result<String, askama::Error> {
    let heading = "What each choice buys";
    Chapter::plain(heading, ("ablation", ablation.schema_version), &part(ablation)?, &ablation.environment)
        .render()
}
