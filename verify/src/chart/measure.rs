//! One view: the exact picture, every method's picture held against it, then all of them timed in turn, and looked at once more: whose
//! picture is then another has no time, and none who was timed for showing something else.

use super::data::{Point, View};
use super::view::Distance;
use crate::bench::check::held;
use crate::bench::contestant::Contestant;
use crate::bench::rounds::{Effort, rounds};
use crate::bench::scene::{BenchError, Progress, truth};
use crate::bench::unseen::{Standing, Unseen};
use crate::methods::Method;
use crate::spu::cost::{SPUS, frame_cost};
use crate::spu::model::measure_nearest;
use crate::spu::predict::Policy;
use crate::spu::store::Buffers;
use crate::verdict::Comparison;
use contract::{Camera, Image, Scene};
use std::time::Duration;

/// What is measured.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// Its frame.
    pub frame: usize,
    /// The frame's spheres.
    pub scene: &'a Scene,
    /// Who takes part.
    pub methods: &'a [Method],
    /// Rounds of measuring.
    pub rounds: usize,
    /// On the SPU model one block of so many is traced; they stand for all.
    pub every: u32,
    /// Of random rays, where the truth is sampled.
    pub seed: u64,
}

/// Measures a view.
///
/// # Errors
/// [`BenchError`] if there is no truth, or a method gives up in the middle.
pub fn measure(asked: &Asked<'_>, at: &Distance, progress: Progress<'_>) -> Result<View, BenchError> {
    let Asked { scene, methods, .. } = *asked;
    let camera = &at.camera;
    let (image, found) = truth(scene, camera, asked.seed, progress)?;
    let tick = progress("methods", u32::try_from(methods.len()).unwrap_or(u32::MAX));
    let (mut points, mut entrants, mut places) = (Vec::new(), Vec::new(), Vec::new());
    for method in methods {
        let mut point = Point {
            method: method.name.clone(),
            family: method.family,
            exact: method.exact,
            description: String::new(),
            ns_per_ray: None,
            spu_cycles_per_ray: None,
            comparison: None,
            paints: false,
            remark: None,
        };
        match method.contestant(scene, camera) {
            Err(error) => point.remark = Some(format!("Did not begin: {error}.")),
            Ok(mut entrant) => {
                point.description = entrant.description();
                match pictured(entrant.as_mut(), scene, camera, &image) {
                    Err(why) => point.remark = Some(format!("Gave no picture: {why}.")),
                    Ok((comparison, paints)) => {
                        (point.comparison, point.paints) = (Some(comparison), paints);
                        places.push(points.len());
                        entrants.push(entrant);
                    }
                }
            }
        }
        if let Some(plan) = method.on_spu {
            point.spu_cycles_per_ray =
                measure_nearest(plan, scene, camera, asked.every, &|| ()).ok().and_then(|m| {
                    let cost = frame_cost(&m, scene.spheres().len(), Policy::Hinted, Buffers::Single).ok()?;
                    let rays = camera.size().pixels() as f64;
                    Some(cost.cycles.map(|cycles| cycles * SPUS as f64 / rays))
                });
        }
        points.push(point);
        tick();
    }
    time(asked, at, &image, (&mut points, &places), &mut entrants, progress)?;
    Ok(View {
        scene: asked.name.into(),
        frame: asked.frame,
        spheres: scene.spheres().len(),
        size: [camera.size().width(), camera.size().height()],
        times_as_far: at.times,
        radii: at.radii,
        hits: found.hits as u64,
        rounds: asked.rounds,
        points,
    })
}

/// A frame against the exact picture, and whether it has colours.
fn pictured(
    entrant: &mut dyn Contestant,
    scene: &Scene,
    camera: &Camera,
    truth: &Image,
) -> Result<(Comparison, bool), String> {
    let layers = entrant.frame(scene, camera).map_err(|error| error.to_string())?.layers;
    Ok((held(truth, layers).map_err(|error| error.to_string())?, layers.rgba.is_some()))
}

/// Times those that gave a picture, and keep to it.
fn time(
    asked: &Asked<'_>,
    at: &Distance,
    truth: &Image,
    (points, places): (&mut [Point], &[usize]),
    entrants: &mut [Box<dyn Contestant>],
    progress: Progress<'_>,
) -> Result<(), BenchError> {
    if entrants.is_empty() {
        return Ok(());
    }
    let tick = progress("rounds", u32::try_from(asked.rounds).unwrap_or(u32::MAX));
    let effort = Effort { rounds: Some(asked.rounds), time: Duration::ZERO };
    let mut unseen = Unseen::new(asked.scene, &at.camera, truth, asked.seed);
    let (taken, _) = rounds(entrants, &mut unseen, effort, &*tick).map_err(BenchError::Contestant)?;
    let rays = at.camera.size().pixels() as f64;
    for ((place, entrant), taken) in places.iter().zip(entrants).zip(taken) {
        let point = &mut points[*place];
        let after = pictured(entrant.as_mut(), asked.scene, &at.camera, truth).map(|(after, _)| after).ok();
        if after == point.comparison {
            let standing = after.as_ref().map(|after| Standing::new(entrant.oath(), after));
            point.remark = standing.and_then(|standing| taken.reproach(standing));
            match &point.remark {
                None => point.ns_per_ray = taken.timing().map(|timing| timing.total.median * 1e9 / rays),
                Some(_) => point.comparison = None,
            }
        } else {
            point.remark = Some("Gave another picture after it was timed.".into());
            // The worse one is told, and none at all is worst.
            let wrong = |c: &Comparison| c.wrong_ids + c.wrong_t + c.wrong_color;
            let both = after.zip(point.comparison.take());
            point.comparison =
                both.map(|(after, before)| if wrong(&after) > wrong(&before) { after } else { before });
        }
    }
    Ok(())
}
