//! How a frame's cost and its by-ways grow with the number of spheres, and with the grid's cells: each point a survey.

use super::survey::{Input, Survey, SurveyError, survey};
use crate::scenes::catalogue::{Source, SourceError};
use crate::scenes::frame::Framing;
use contract::{Camera, Scene};
use optimized::plan::{Plan, Resolution};
use serde::Serialize;
use thiserror::Error;

/// Random spheres of the curve over scene size.
pub const SPHERES: [u32; 6] = [250, 500, 1000, 2000, 4000, 8000];
/// Cells on each axis of the curve over grid size.
pub const CELLS: [u8; 7] = [4, 6, 8, 12, 16, 20, 24];

/// Surveys side by side.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    /// `spheres` or `cells`.
    pub over: &'static str,
    /// The scenes, or the scene.
    pub of: String,
    /// From small to large.
    pub points: Vec<Point>,
}

/// One of them.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// Spheres, or cells on each axis.
    pub x: f64,
    /// What was found there.
    pub survey: Survey,
}

/// Why there is no curve.
#[derive(Debug, Error)]
pub enum CurveError {
    /// A scene cannot be had.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// It cannot be seen.
    #[error(transparent)]
    Framing(#[from] crate::scenes::frame::FramingError),
    /// It cannot be surveyed.
    #[error(transparent)]
    Survey(#[from] SurveyError),
}

/// What the curves are of.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The plan.
    pub plan: Plan,
    /// One block of so many is traced.
    pub every: u32,
    /// How scenes are seen.
    pub framing: &'a Framing,
    /// The scene of the curve over grid size.
    pub name: &'a str,
    /// Which of its frames it is.
    pub frame: usize,
    /// The frame.
    pub scene: &'a Scene,
    /// Its camera.
    pub camera: &'a Camera,
}

/// Both curves; `done` is called after each point, of which there are [`POINTS`].
///
/// # Errors
/// [`CurveError`] if a scene cannot be made, seen or surveyed.
pub fn curves(asked: &Asked<'_>, done: &dyn Fn()) -> Result<[Curve; 2], CurveError> {
    let Asked { plan, every, framing, name, frame, scene, camera } = *asked;
    let at = |(name, frame): (&str, usize), plan, scene: &Scene, camera: &Camera| {
        let input = Input { name, frame, scene, camera, plan, every, unlimited: true };
        let survey = survey(&input, &|| ());
        done();
        survey
    };
    let (mut spheres, mut cells) = (Vec::new(), Vec::new());
    for n in SPHERES {
        let name = format!("uniform:{n}:1");
        let loaded = Source::parse(&name)?.load()?;
        let camera = loaded.camera(framing)?;
        let survey = at((&name, 0), plan, &loaded.animation.frames()[0], &camera)?;
        spheres.push(Point { x: n.into(), survey });
    }
    for n in CELLS {
        let plan = Plan { resolution: Resolution::Fixed(n), ..plan };
        cells.push(Point { x: n.into(), survey: at((name, frame), plan, scene, camera)? });
    }
    Ok([
        Curve { over: "spheres", of: "random spheres in a cube".into(), points: spheres },
        Curve { over: "cells", of: name.into(), points: cells },
    ])
}

/// Points of both curves.
pub const POINTS: u32 = (SPHERES.len() + CELLS.len()) as u32;
