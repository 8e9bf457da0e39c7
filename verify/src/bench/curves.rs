//! How times grow: with the number of spheres, of pixels and of threads, one of them at a time.
//!
//! In: what is to be timed, and how far to go. Out: a [`Curve`] for each, whose points are scenes like any other, every
//! picture checked. Spheres are random ones in a cube, at the picture's size; pixels and threads are of one scene. Of Embree
//! all ways are asked at the first point and at each later one those that were best before it.

use super::contestant::Kind;
use super::data::{Curve, Growth, Point, SceneBench};
use super::outsiders::{Field, Outsider};
use super::rounds::Effort;
use super::scene::{BenchError, Input, Progress, Setting, bench};
use crate::scenes::catalogue::{Source, SourceError};
use crate::scenes::frame::Framing;
use crate::subject::NamedPlan;
use contract::{Camera, Scene, Size};
use optimized::Level;
use thiserror::Error;

/// What is timed, and how far the curves go.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The scene of the curves over pixels and threads.
    pub scene: String,
    /// Its frame.
    pub frame: usize,
    /// How it is seen; the curves over spheres and threads take its size too.
    pub framing: Framing,
    /// The plan of the tracer under test.
    pub plan: NamedPlan,
    /// Its level.
    pub level: Level,
    /// Who else is timed. Who is missing is passed over.
    pub outsiders: Vec<Outsider>,
    /// How long.
    pub effort: Effort,
    /// Of random rays.
    pub seed: u64,
    /// Threads but for the curve over threads.
    pub threads: usize,
    /// The most spheres.
    pub most_spheres: usize,
    /// The most rows of a picture.
    pub most_rows: u32,
    /// The most threads.
    pub most_threads: usize,
}

/// Why there is no curve.
#[derive(Debug, Error)]
pub enum CurveError {
    /// A scene cannot be had.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// It cannot be seen.
    #[error("{scene}: {cause}")]
    Camera {
        /// Its name.
        scene: String,
        /// Why.
        cause: String,
    },
    /// It cannot be timed.
    #[error(transparent)]
    Bench(#[from] BenchError),
}

/// Pictures of 16 to 9.
const SIZES: [[u32; 2]; 7] =
    [[320, 180], [640, 360], [1280, 720], [1920, 1080], [2560, 1440], [3840, 2160], [7680, 4320]];
const FEWEST_SPHERES: usize = 100;

/// All curves.
///
/// # Errors
/// [`CurveError`] for the first point that cannot be had.
pub fn curves(asked: &Asked, progress: Progress<'_>) -> Result<Vec<Curve>, CurveError> {
    Ok(vec![spheres(asked, progress)?, pixels(asked, progress)?, threads(asked, progress)?])
}

fn spheres(asked: &Asked, progress: Progress<'_>) -> Result<Curve, CurveError> {
    let counts = std::iter::successors(Some(FEWEST_SPHERES), |count| count.checked_mul(10));
    let mut course = Course::new(asked, asked.threads);
    let mut points = Vec::new();
    for count in counts.take_while(|&count| count <= asked.most_spheres) {
        let name = format!("uniform:{count}:1");
        let framing = Framing { size: asked.framing.size, ..Framing::default() };
        let (scene, camera) = scene(&name, 0, &framing)?;
        let scene =
            course.point(&Input { name: &name, frame: 0, scene: &scene, camera: &camera }, progress)?;
        points.push(Point { x: count as f64, scene });
    }
    let mut growth: Vec<Growth> = points
        .windows(2)
        .filter(|pair| pair[0].x >= 1000.0)
        .filter_map(|pair| grown("rebuild", &pair[0], &pair[1], build, 11.0, false))
        .collect();
    let at = |x: f64| points.iter().find(|point| point.x == x);
    if let (Some(few), Some(many)) = (at(1e4), at(1e6)) {
        growth.extend(grown("frame", few, many, total, 20.0, false));
    }
    Ok(Curve { over: "spheres", points, growth })
}

fn pixels(asked: &Asked, progress: Progress<'_>) -> Result<Curve, CurveError> {
    let mut course = Course::new(asked, asked.threads);
    let mut points = Vec::new();
    for [width, height] in SIZES.into_iter().filter(|[_, rows]| *rows <= asked.most_rows) {
        let size = Size::new(width, height).expect("not too large");
        let framing = Framing { size: Some(size), ..asked.framing };
        let (scene, camera) = scene(&asked.scene, asked.frame, &framing)?;
        let input = Input { name: &asked.scene, frame: asked.frame, scene: &scene, camera: &camera };
        points.push(Point { x: size.pixels() as f64, scene: course.point(&input, progress)? });
    }
    let at = |rows: u32| points.iter().find(|point| point.scene.height == rows);
    let growth = match (at(720), at(2160)) {
        (Some(few), Some(many)) => grown("frame", few, many, total, 7.0, false).into_iter().collect(),
        _ => Vec::new(),
    };
    Ok(Curve { over: "pixels", points, growth })
}

fn threads(asked: &Asked, progress: Progress<'_>) -> Result<Curve, CurveError> {
    let (scene, camera) = scene(&asked.scene, asked.frame, &asked.framing)?;
    let input = Input { name: &asked.scene, frame: asked.frame, scene: &scene, camera: &camera };
    let mut points = Vec::new();
    for threads in 1..=asked.most_threads {
        points.push(Point { x: threads as f64, scene: Course::new(asked, threads).point(&input, progress)? });
    }
    let growth = match points.as_slice() {
        [one, two, ..] => {
            grown("frames a second", one, two, |s| Some(1.0 / total(s)?), 1.85, true).into_iter().collect()
        }
        _ => Vec::new(),
    };
    Ok(Curve { over: "threads", points, growth })
}

fn scene(name: &str, frame: usize, framing: &Framing) -> Result<(Scene, Camera), CurveError> {
    let loaded = Source::parse(name)?.load()?;
    let fault = |cause: String| CurveError::Camera { scene: name.into(), cause };
    let camera = loaded.camera(framing).map_err(|error| fault(error.to_string()))?;
    let scene =
        loaded.animation.frames().get(frame).ok_or_else(|| fault(format!("it has no frame {frame}")))?;
    Ok((scene.clone(), camera))
}

/// Median seconds until all stood that rays share.
fn build(scene: &SceneBench) -> Option<f64> {
    scene.subject()?.timing.map(|timing| timing.build.median)
}

/// Median seconds of a frame.
fn total(scene: &SceneBench) -> Option<f64> {
    scene.subject()?.seconds()
}

fn grown(
    what: &str,
    few: &Point,
    many: &Point,
    of: fn(&SceneBench) -> Option<f64>,
    wanted: f64,
    at_least: bool,
) -> Option<Growth> {
    let factor = of(&many.scene)? / of(&few.scene)?;
    Some(Growth { what: what.into(), between: [few.x, many.x], factor, wanted, at_least })
}

/// One curve under way: who is asked next.
struct Course<'a> {
    asked: &'a Asked,
    threads: usize,
    field: Field,
}

impl<'a> Course<'a> {
    fn new(asked: &'a Asked, threads: usize) -> Self {
        let mut field = Field::new(threads);
        for outsider in &asked.outsiders {
            // Who is missing was told when it was asked for.
            _ = field.add(*outsider, asked.level);
        }
        Self { asked, threads, field }
    }

    fn point(&mut self, input: &Input<'_>, progress: Progress<'_>) -> Result<SceneBench, BenchError> {
        let Asked { plan, level, effort, seed, .. } = *self.asked;
        let setting =
            Setting { plan, level, threads: self.threads, field: &self.field, picked: false, effort, seed };
        let scene = bench(input, &setting, progress)?;
        let kept = scene.rows(Kind::Embree).filter(|row| row.timing.is_some() && row.remark.is_none());
        self.field.narrow(&kept.map(|row| row.name.as_str()).collect::<Vec<_>>());
        Ok(scene)
    }
}
