//! What was at stake in a run: how many of its pixels, spheres and frames lay where tracers go wrong. A run states the least of each that
//! it needs; below that it judged too little, and has no verdict, however green it was.
//!
//! Counted by the judge's own ruler, in f64 and by the picture that was promised; only what stages a tracer needed, and the planes of its grid, are
//! taken from the tracer.

use contract::{Camera, Image, MISS, Scene};
use optimized::grid::Grid;
use optimized::seen::Counts;
use optimized::{Event, Events};
use rayon::prelude::*;
use reference::{Arithmetic, Ray, Tracer};
use std::collections::BTreeMap;
use std::fmt;

/// Counts by what they are of.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stakes {
    counts: BTreeMap<&'static str, u64>,
    /// How often a value was 0, how often 1, from 2 to 3, from 4 to 7, and so on.
    histograms: BTreeMap<&'static str, Vec<u64>>,
}

/// Rays by their major axis and its sign.
const AXES: [[&str; 2]; 3] = [
    ["rays along +x", "rays along -x"],
    ["rays along +y", "rays along -y"],
    ["rays along +z", "rays along -z"],
];

impl Stakes {
    /// Counts.
    pub fn add(&mut self, what: &'static str, n: u64) {
        *self.counts.entry(what).or_default() += n;
    }

    /// How many of something there were.
    #[must_use]
    pub fn count(&self, what: &str) -> u64 {
        self.counts.get(what).copied().unwrap_or(0)
    }

    /// Counts a value where it lies between powers of two.
    pub fn bin(&mut self, what: &'static str, value: u64) {
        self.bins(what, (u64::BITS - value.leading_zeros()) as usize, 1);
    }

    fn bins(&mut self, what: &'static str, k: usize, n: u64) {
        let bins = self.histograms.entry(what).or_default();
        bins.resize(bins.len().max(k + 1), 0);
        bins[k] += n;
    }

    /// All counts.
    pub fn counts(&self) -> impl Iterator<Item = (&'static str, u64)> {
        self.counts.iter().map(|(what, n)| (*what, *n))
    }

    /// All histograms.
    pub fn histograms(&self) -> impl Iterator<Item = (&'static str, &[u64])> {
        self.histograms.iter().map(|(what, bins)| (*what, bins.as_slice()))
    }

    /// Together with those of another run.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        for (what, n) in &other.counts {
            self.add(what, *n);
        }
        for (what, bins) in &other.histograms {
            bins.iter().enumerate().for_each(|(k, n)| self.bins(what, k, *n));
        }
        self
    }

    /// What of the least that is needed is lacking, in words; nothing if the run may have a verdict.
    #[must_use]
    pub fn lacking(&self, least: &[(&str, u64)]) -> Vec<String> {
        let lacking = least.iter().filter(|(what, least)| self.count(what) < *least);
        lacking.map(|(what, least)| format!("{what}: {} of at least {least}", self.count(what))).collect()
    }

    /// Counts what lies in a frame for any tracer; whose pixels are which is told by the picture that was promised.
    ///
    /// # Panics
    /// Never: an image's pixels can be numbered.
    pub fn add_frame(&mut self, scene: &Scene, camera: &Camera, picture: &Image) {
        self.add("frames", 1);
        self.add("rays", picture.ids.len() as u64);
        self.add("hits", picture.ids.iter().filter(|id| **id != MISS).count() as u64);
        let width = camera.size().width();
        let rays = (0..picture.ids.len()).into_par_iter().map(|i| {
            let i = u32::try_from(i).expect("an image has at most 2^27 pixels");
            let ray = Ray::of_pixel(camera, i % width, i / width);
            let mut stakes = Self::default();
            stakes.add_ray(scene, &ray, picture.ids[i as usize]);
            stakes
        });
        *self = rays.reduce(Self::default, |a, b| a.and(&b)).and(self);
    }

    fn add_ray(&mut self, scene: &Scene, ray: &Ray, owner: u32) {
        let d = ray.dir.map(f64::from);
        let major = (0..3).fold(0, |best, i| if d[i].abs() > d[best].abs() { i } else { best });
        self.add(AXES[major][usize::from(d[major] < 0.0)], 1);
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let (mut tangent, mut inside, mut surface, mut far) = (0, 0, 0, 0);
        for sphere in scene.spheres() {
            let f = [0, 1, 2].map(|i| f64::from(ray.eye[i]) - f64::from(sphere.center[i]));
            let rr = f64::from(sphere.radius) * f64::from(sphere.radius);
            let (a, ff) = (dot(d, d), dot(f, f));
            let h = dot(f, d) / a;
            let across = [0, 1, 2].map(|i| f[i] - h * d[i]);
            // Within some hundred f32 roundings of the terms that the discriminant is made of.
            tangent += u64::from((rr - dot(across, across)).abs() < 1e-5 * (rr + ff));
            inside += u64::from(ff < rr);
            surface += u64::from((ff - rr).abs() < 1e-5 * rr);
            far += u64::from(ff > 1e6 * rr);
        }
        self.add("rays near tangents", u64::from(tangent > 0));
        self.add("rays from inside a sphere", u64::from(inside > 0));
        self.add("rays from a surface", u64::from(surface > 0));
        self.add("rays to spheres over 1,000 radii away", u64::from(far > 0));
        if owner != MISS {
            self.add("rays with an equal second hit", u64::from(is_tied(scene, ray, owner)));
        }
    }

    /// Counts what a grid makes of a scene.
    pub fn add_grid(&mut self, scene: &Scene, grid: &Grid) {
        self.add("grids", 1);
        self.add(
            "grids of more spheres than a tile takes in one round",
            u64::from(scene.spheres().len() > 256),
        );
        for sphere in scene.spheres() {
            let mut cells = 1usize;
            let mut near = false;
            for (i, axis) in grid.axes.iter().enumerate() {
                let (lo, hi) = (sphere.center[i] - sphere.radius, sphere.center[i] + sphere.radius);
                let inner = &axis.planes[1..axis.planes.len() - 1];
                cells *= 1 + inner.iter().filter(|plane| (lo..hi).contains(*plane)).count();
                let ulp = |x: f32| f64::from(x.abs().next_up() - x.abs());
                let close = |end: f32, plane: f32| {
                    let scale = ulp(end).max(ulp(plane)).max(ulp(sphere.center[i]));
                    f64::from(end - plane).abs() <= 4.0 * scale
                };
                near |= inner.iter().any(|plane| close(lo, *plane) || close(hi, *plane));
            }
            self.add("spheres in several cells", u64::from(cells > 1));
            self.add("spheres that span three cells or more", u64::from(cells > 8));
            self.add("spheres within 4 ulp of a plane", u64::from(near));
        }
    }

    /// Counts what a tracer says it needed, each fall-back and each stage.
    pub fn add_tracer(&mut self, counts: &Counts, events: &Events) {
        self.add("cells visited", counts.cells);
        self.add("candidates", counts.candidates);
        self.add("candidates culled", counts.culled);
        self.add("blocks split", counts.split_blocks);
        self.add("rays that f32 left to f64", counts.asked_f64);
        self.add("rays that f64 left to integers", counts.asked_integers);
        self.add("t rounded by integers", counts.rounded_by_integers);
        for event in events.first() {
            self.add(
                match event {
                    Event::CellFull { .. } => "queues full",
                    Event::SpansCells { .. } => "too large for eight corners",
                    Event::TooManyIds { .. } => "scenes of too many ids",
                    Event::OutOfRange => "scenes out of range",
                },
                1,
            );
        }
    }
}

/// Whether another sphere is hit at the same f32.
fn is_tied(scene: &Scene, ray: &Ray, owner: u32) -> bool {
    let t = |id: usize| {
        let one = Scene::new(vec![scene.spheres()[id]], [0; 3], scene.light()).ok()?;
        Tracer::new(Arithmetic::Exact).trace(ray, &one).map(|hit| hit.t.to_bits())
    };
    let nearest = t(owner as usize);
    let f = |id: usize| {
        let s = &scene.spheres()[id];
        let apart: f64 = (0..3).map(|i| (f64::from(ray.eye[i]) - f64::from(s.center[i])).powi(2)).sum();
        apart.sqrt()
    };
    // Only who can be as near is asked.
    let reach = f(owner as usize) + f64::from(scene.spheres()[owner as usize].radius);
    (0..scene.spheres().len())
        .filter(|id| {
            *id != owner as usize && f(*id) - f64::from(scene.spheres()[*id].radius) <= reach * 1.001
        })
        .any(|id| t(id) == nearest)
}

impl fmt::Display for Stakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: Vec<String> = self.counts().map(|(what, n)| format!("{n} {what}")).collect();
        f.write_str(&all.join(", "))
    }
}
