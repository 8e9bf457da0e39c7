//! One scene: all bases, all variants and all plans picked by hand as the methods of one view, and their ratios.

use super::data::{BaseRows, Row, SceneAblation};
use super::variants::{bases, is_on_spu, variants};
use crate::bench::ours::{chosen, picked};
use crate::bench::scene::{BenchError, Progress};
use crate::chart::{Asked, Distance, Point, View, measure};
use crate::methods::{Family, Method};
use crate::subject::NamedPlan;
use crate::verdict::Comparison;
use contract::Scene;
use optimized::plan::Arithmetic;
use optimized::{Level, Plan};

/// What the chosen plan is called among the methods.
const CHOSEN: &str = "for_scene";

/// Measures a scene.
///
/// # Errors
/// [`BenchError`] if there is no truth, or a plan gives up in the middle.
pub fn ablate(
    (name, frame, scene): (&str, usize, &Scene),
    at: &Distance,
    (level, threads, rounds, every): (Level, usize, usize, u32),
    seed: u64,
    progress: Progress<'_>,
) -> Result<SceneAblation, BenchError> {
    let method = |name: String, plan: Plan| {
        let method = Method::grid(name, Family::Exact, move |_| plan, level, threads);
        if is_on_spu(&plan) { method.with_spu(plan) } else { method }
    };
    let mut methods = Vec::new();
    for base in bases() {
        methods.push(method(base.name.into(), base.plan));
        for variant in variants(base.plan) {
            methods.push(method(named(base.name, variant.concern, &variant.choice), variant.plan));
        }
    }
    let (best, picks) = (chosen(NamedPlan::Fast, scene), picked(scene));
    methods.push(method(CHOSEN.into(), best.plan));
    methods.extend(picks.iter().map(|(name, plan)| method(name.clone(), *plan)));
    let asked = Asked { name, frame, scene, methods: &methods, rounds, every, seed };
    Ok(told(scene, &measure(&asked, at, progress)?))
}

/// What a view of all these methods says of each choice. A view that lacks one says nothing of it.
#[must_use]
pub fn told(scene: &Scene, view: &View) -> SceneAblation {
    let (best, picks) = (chosen(NamedPlan::Fast, scene), picked(scene));
    let time = |name: &str| point(view, name).and_then(|point| point.ns_per_ray);
    let fastest = picks.iter().filter_map(|(name, _)| Some((name, time(name)?)));
    let fastest = fastest.min_by(|a, b| a.1.total_cmp(&b.1));
    SceneAblation {
        scene: view.scene.clone(),
        spheres: scene.spheres().len(),
        size: view.size,
        bases: bases().map(|base| rows(view, &base)).into(),
        chosen_by_best: time(CHOSEN).zip(fastest).map(|(chosen, (_, best))| chosen / best),
        best_picked: fastest.map(|(name, _)| name.clone()),
        reasons: best.reasons.iter().map(ToString::to_string).collect(),
    }
}

fn named(base: &str, concern: &str, choice: &str) -> String {
    format!("{base}, {concern}: {choice}")
}

fn point<'a>(view: &'a View, name: &str) -> Option<&'a Point> {
    view.points.iter().find(|point| point.method == name)
}

fn rows(view: &View, base: &super::variants::Base) -> BaseRows {
    let own = point(view, base.name);
    let ns = own.and_then(|point| point.ns_per_ray);
    let cycles = own.and_then(|point| point.spu_cycles_per_ray);
    let wrong = |point: Option<&Point>| Some(point?.comparison.as_ref()?.wrong_ids);
    let kept = |plan: &Plan, point: Option<&Point>| {
        let promised = plan.arithmetic == Arithmetic::Certified && plan.promises_equality();
        let same = |c: &Comparison| c.wrong_ids + c.wrong_t + c.wrong_color == 0;
        promised.then(|| point.and_then(|point| point.comparison.as_ref()).is_some_and(same))
    };
    let row = |variant: super::variants::Variant| {
        let point = point(view, &named(base.name, variant.concern, &variant.choice));
        Row {
            kept: kept(&variant.plan, point),
            concern: variant.concern.into(),
            choice: variant.choice,
            time: point.and_then(|point| point.ns_per_ray).zip(ns).map(|(own, base)| own / base),
            cycles: point.and_then(|p| p.spu_cycles_per_ray).zip(cycles).map(|(own, base)| own[1] / base[1]),
            wrong: wrong(point),
            remark: point.and_then(|point| point.remark.clone()),
        }
    };
    BaseRows {
        name: base.name.into(),
        what: base.what.into(),
        plan: base.plan.to_string(),
        ns_per_ray: ns,
        cycles_per_ray: cycles,
        wrong: wrong(own),
        kept: kept(&base.plan, own),
        rows: variants(base.plan).into_iter().map(row).collect(),
    }
}
