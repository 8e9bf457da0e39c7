//! The scene matrix: scenes times views, small pictures each, in which everything a grid tracer can get wrong is
//! at stake: all bundled, fetched and generated scenes; no, one and two spheres; touching and coincident ones; spheres
//! larger than cells; eyes outside, inside the grid, inside a sphere, far away; six major axes with both signs and
//! the diagonals between them; image sizes that are no multiple of 4.

use crate::scenes::catalogue::{ENTRIES, Source, SourceError};
use crate::scenes::frame::{Framing, FramingError};
use contract::{Animation, Camera, DEFAULT_LIGHT, Scene, SceneError, Size, SizeError, Sphere};
use thiserror::Error;

/// One picture to be rendered.
#[derive(Clone, Debug)]
pub struct Case {
    /// Scene and view.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// The camera.
    pub camera: Camera,
}

/// All cases, and the scenes whose data is absent.
#[derive(Clone, Debug, Default)]
pub struct Matrix {
    /// What can be rendered.
    pub cases: Vec<Case>,
    /// What was left out for want of data.
    pub absent: Vec<&'static str>,
}

/// Why the matrix could not be made.
#[derive(Debug, Error)]
#[allow(missing_docs, reason = "each says all itself")]
pub enum MatrixError {
    #[error(transparent)]
    Source(#[from] SourceError),
    #[error(transparent)]
    Framing(#[from] FramingError),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Size(#[from] SizeError),
}

/// Generated scenes of the matrix.
const GENERATED: [&str; 9] = [
    "sphereflake:2",
    "sphereflake:4",
    "uniform:1:7",
    "uniform:2:7",
    "uniform:500:1",
    "uniform:2000:2",
    "uniform:5000:3",
    "clump:2000:1",
    "lattice:7",
];

/// Image sizes, taken in turn.
const SIZES: [[u32; 2]; 6] = [[61, 47], [40, 36], [1, 1], [3, 5], [66, 2], [37, 64]];

/// Scenes of more spheres have smaller pictures, so that the naive tracer gets through.
const LARGE: usize = 10_000;

/// Frames of an animation that are rendered in one view each: the first 24.
const FRAMES: usize = 24;

impl Matrix {
    /// Makes it from what is there.
    ///
    /// # Errors
    /// [`MatrixError`] if data that is there is refused.
    pub fn new() -> Result<Self, MatrixError> {
        let mut matrix = Self::default();
        for entry in ENTRIES {
            match Source::Named(entry).load() {
                Ok(loaded) => matrix.add_animation(entry.name, &loaded.animation)?,
                Err(SourceError::DataAbsent { name, .. }) => matrix.absent.push(name),
                Err(error) => return Err(error.into()),
            }
        }
        for word in GENERATED {
            matrix.add_animation(word, &Source::parse(word)?.load()?.animation)?;
        }
        for (name, spheres) in hand_made() {
            let scene = Scene::new(spheres, [10, 20, 30], DEFAULT_LIGHT)?;
            matrix.add_animation(name, &Animation::from(scene))?;
        }
        Ok(matrix)
    }

    /// All views of the first frame that has spheres, one view of each other one of the first [`FRAMES`].
    fn add_animation(&mut self, name: &str, animation: &Animation) -> Result<(), MatrixError> {
        let frames = animation.frames();
        let first = frames.iter().position(|scene| !scene.spheres().is_empty()).unwrap_or(0);
        let views = views(&frames[first]);
        for (view, framing) in &views {
            self.add(format!("{name}, {view}"), &frames[first], framing)?;
        }
        for (i, scene) in frames.iter().enumerate().take(FRAMES).filter(|&(i, _)| i != first) {
            let (view, framing) = &views[i % views.len()];
            self.add(format!("{name} frame {i}, {view}"), scene, framing)?;
        }
        Ok(())
    }

    fn add(&mut self, name: String, scene: &Scene, framing: &Framing) -> Result<(), MatrixError> {
        let large = scene.spheres().len() > LARGE;
        let [width, height] = if large { [18, 13] } else { SIZES[self.cases.len() % SIZES.len()] };
        let size = Some(Size::new(width, height)?);
        let camera = Framing { size, ..*framing }.camera(&Animation::from(scene.clone()))?;
        self.cases.push(Case { name, scene: scene.clone(), camera });
        Ok(())
    }
}

/// Views of a scene by name. Distances are in units of its own size, the far ones in radii of its first sphere.
fn views(scene: &Scene) -> Vec<(String, Framing)> {
    let (middle, half) = extent(scene);
    let beside = |direction: [f64; 3], distance: f64| Framing {
        eye: Some([0, 1, 2].map(|i| middle[i] + distance * direction[i])),
        target: Some(middle),
        fov: Some(2.2 * half.atan2(distance).to_degrees()).map(|fov| fov.clamp(0.002, 120.0)),
        ..Framing::default()
    };
    let mut views = Vec::new();
    for (name, axis) in [("x", 0), ("y", 1), ("z", 2)] {
        for (sign, unit) in [("+", 1.0), ("-", -1.0)] {
            let mut direction = [0.013, 0.021, 0.017];
            direction[axis] = unit;
            views.push((format!("from {sign}{name}"), beside(direction, 2.5 * half)));
        }
    }
    views.push(("along an axis exactly".into(), beside([0.0, 0.0, 1.0], 3.0 * half)));
    views.push(("from a corner".into(), beside([0.58, -0.57, 0.58], 2.5 * half)));
    views.push(("from an edge".into(), beside([0.0, 0.7, -0.7], 2.5 * half)));
    let wide = Framing { fov: Some(120.0), ..beside([0.3, 0.2, 0.1], 0.5 * half) };
    views.push(("inside the grid, wide".into(), wide));
    let wide = Framing { fov: Some(100.0), ..beside([0.577, 0.577, 0.577], 0.9 * half) };
    views.push(("inside the grid, towards a corner".into(), wide));
    let Some(first) = scene.spheres().first() else { return views };
    let (center, radius) = (first.center.map(f64::from), f64::from(first.radius));
    let inside = Framing {
        eye: Some(center),
        target: Some([0, 1, 2].map(|i| center[i] - radius)),
        ..beside([1.0; 3], half)
    };
    views.push(("inside a sphere".into(), Framing { fov: Some(90.0), ..inside }));
    for radii in [100.0, 700.0, 2000.0] {
        views.push((format!("{radii} radii away"), beside([0.48, 0.6, 0.64], radii * radius)));
        views.push((format!("{radii} radii away on an axis"), beside([-1.0, 0.01, 0.02], radii * radius)));
    }
    views
}

/// Middle of the centres' box, and half its diagonal with the largest radius, at least 1.
fn extent(scene: &Scene) -> ([f64; 3], f64) {
    let axis = |i: usize| {
        let values = scene.spheres().iter().map(|s| f64::from(s.center[i]));
        let (lo, hi) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
        if lo > hi { [0.0, 0.0] } else { [lo, hi] }
    };
    let axes = [axis(0), axis(1), axis(2)];
    let radius = scene.spheres().iter().map(|s| f64::from(s.radius)).fold(0.0, f64::max);
    let diagonal = axes.map(|[lo, hi]| (hi - lo) * (hi - lo)).iter().sum::<f64>().sqrt();
    let half = diagonal / 2.0 + radius;
    (axes.map(|[lo, hi]| f64::midpoint(lo, hi)), if half > 0.0 { half } else { 1.0 })
}

/// Scenes in which ties and cell planes are at stake.
fn hand_made() -> Vec<(&'static str, Vec<Sphere>)> {
    let ball =
        |center: [f32; 3], radius: f32, color: u8| Sphere { center, radius, color: [color, 255 - color, 99] };
    // Whole numbers: exact ties at the touching points, boxes on cell planes.
    let at = |i: u8, step: f32| f32::from(i) * step;
    let cube = |n: u8, step: f32, radius: f32| {
        let mut spheres = Vec::new();
        for i in 0..n {
            for j in 0..n {
                for k in 0..n {
                    spheres.push(ball([at(i, step), at(j, step), at(k, step)], radius, 16 * (i + j + k)));
                }
            }
        }
        spheres
    };
    let mut coincident = cube(4, 3.0, 1.5);
    for (i, sphere) in (0..).zip(cube(4, 3.0, 1.5)) {
        coincident.push(Sphere { color: [i, 0, 255 - i], ..sphere });
    }
    let nested = (1..=40).map(|i| ball([0.0, f32::from(i) * 0.01, 0.0], f32::from(i), 6 * i)).collect();
    let mut mixed = cube(5, 1.0, 0.1);
    mixed.push(ball([2.0, 2.0, 2.0], 3.0, 77));
    mixed.push(ball([0.0, 0.0, 40.0], 30.0, 177));
    let scaled = |factor: f32| {
        let scale =
            |s: Sphere| Sphere { center: s.center.map(|x| factor * x), radius: factor * s.radius, ..s };
        cube(4, 3.0, 1.5).into_iter().map(scale).collect()
    };
    vec![
        ("tiny, where f32 underflows", scaled(1e-20)),
        ("huge, where f32 overflows", scaled(1e20)),
        ("nothing", Vec::new()),
        ("touching", cube(6, 2.0, 1.0)),
        ("coincident", coincident),
        ("nested", nested),
        (
            "far from the origin",
            cube(5, 2.0, 0.9)
                .into_iter()
                .map(|s| Sphere { center: s.center.map(|x| x + 8000.0), ..s })
                .collect(),
        ),
        ("small among large", mixed),
    ]
}
