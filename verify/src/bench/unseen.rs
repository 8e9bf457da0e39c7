//! Frames that nobody has seen: who has kept an earlier frame's answers, or traced these rays before the clock ran, gains nothing.
//!
//! For each frame all spheres move together, by one to four pixels to a side, up or down, and to or fro, drawn anew: the work stays what it
//! was, and no answer does. Of the last frame of each turn a few pixels are drawn and held against the exact loop over all spheres when the
//! clock has stopped. Who promised the truth and gave it in every pixel must show it there too. Who rounds may be off, as far as
//! it was there ([`Standing`]), and who loses spheres loses others in another frame; but whoever is nearer to having all of them wrong than to
//! how it did there is not timed. How far rounding goes is not known from a few pixels: where less than [`ENOUGH`] show a sphere, it is
//! not held to that.
//!
//! The clairvoyant is told what one frame shows, so it is asked for that one, at the cost of being moved by nothing.

use super::contestant::{Layers, Oath};
use crate::judge::compare::ulps_apart;
use crate::seed::generator;
use crate::verdict::Comparison;
use contract::{Camera, Image, MISS, Scene, Size};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use reference::{Arithmetic, Ray, Tracer};

/// About how many spheres the loops over one turn's pixels meet together.
const TESTS: usize = 1 << 22;
/// Fewest and most pixels of a turn.
const LEAST: usize = 4;
const MOST: usize = 64;
/// So many pixels may be off whatever their number.
const FEW: f64 = 3.0;
/// The most of so many errors is exceeded by half of all others once in 2⁶⁴.
pub const ENOUGH: u64 = 64;

/// How far a contestant is off in a picture that was looked at as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// Whether it promised the truth, and gave it.
    pub exact: bool,
    /// Pixels that show a sphere.
    pub hits: u64,
    /// Of the pixels that show a sphere the part that should show another, or none.
    pub wrong: f64,
    /// The most that t of a right sphere is off, in steps of f32.
    pub ulps: u64,
}

impl Standing {
    /// Of who swore so, and was compared so.
    #[must_use]
    pub fn new(oath: Oath, c: &Comparison) -> Self {
        let exact = matches!(oath, Oath::Exact) && c.wrong_ids == 0 && c.wrong_t == 0;
        Self {
            exact,
            hits: c.hits,
            wrong: (c.missing + c.swapped) as f64 / c.hits.max(1) as f64,
            ulps: c.t_ulp.max,
        }
    }
}

/// What came of the pixels that were drawn.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// How far t is off, of the right sphere; none of another.
    apart: Vec<Option<u64>>,
}

impl Drawn {
    /// Why a contestant of such a standing has not shown what it was timed for; none if it has.
    #[must_use]
    pub fn reproach(&self, standing: Standing) -> Option<String> {
        if !standing.exact && standing.hits < ENOUGH {
            return None;
        }
        let pixels = self.apart.len();
        let off = self.apart.iter().filter(|apart| apart.is_none_or(|ulps| ulps > standing.ulps)).count();
        let part = if standing.exact { 0.0 } else { f64::midpoint(standing.wrong, 1.0) };
        (off as f64 > FEW + part * pixels as f64).then(|| {
            format!("In frames that were timed {off} of {pixels} pixels drawn at random are not what its spheres show.")
        })
    }
}

/// A scene whose frames are all new.
#[derive(Debug)]
pub struct Unseen<'a> {
    scene: &'a Scene,
    camera: &'a Camera,
    /// Pixels that show a sphere before anything moves.
    hits: Vec<u32>,
    /// A pixel's width, its height, and as much in depth, where the middle one of those spheres is.
    pixel: [[f64; 3]; 3],
    random: Pcg64Mcg,
}

/// A few pixels of a frame as its contestant left them: which, id and t.
pub(super) struct Left(Vec<(u32, Option<(u32, f32)>)>);

impl<'a> Unseen<'a> {
    /// Of a scene and its exact picture.
    #[must_use]
    pub fn new(scene: &'a Scene, camera: &'a Camera, truth: &Image, seed: u64) -> Self {
        let hits = (0..).zip(&truth.ids).filter(|&(_, &id)| id != MISS).map(|(i, _)| i).collect();
        Self { scene, camera, hits, pixel: pixel(camera, truth), random: generator(seed, 31) }
    }

    /// The camera, which stays where it is.
    pub(super) fn camera(&self) -> &'a Camera {
        self.camera
    }

    /// The next frame's spheres, or with `still` those that there were.
    pub(super) fn next(&mut self, still: bool) -> Scene {
        let mut way = [0.0; 3];
        for axis in self.pixel {
            let steps = self.random.random_range(1.0..4.0) * if self.random.random() { 1.0 } else { -1.0 };
            let steps = if still { 0.0 } else { steps };
            way = std::array::from_fn(|i| way[i] + steps * axis[i]);
        }
        let way = way.map(|x| x as f32);
        let mut spheres = self.scene.spheres().to_vec();
        for sphere in &mut spheres {
            sphere.center = std::array::from_fn(|i| sphere.center[i] + way[i]);
        }
        let moved = Scene::new(spheres, self.scene.background(), self.scene.light());
        // At the end of f32 there is no place to move to.
        moved.unwrap_or_else(|_| self.scene.clone())
    }

    /// Draws pixels, and keeps what a frame has left there.
    pub(super) fn draw(&mut self, layers: Layers<'_>) -> Left {
        let pixels = if self.hits.is_empty() {
            0
        } else {
            (TESTS / self.scene.spheres().len().max(1)).clamp(LEAST, MOST)
        };
        let left = (0..pixels).map(|_| {
            let at = self.hits[self.random.random_range(0..self.hits.len())];
            let id = layers.ids.get(at as usize);
            (at, id.copied().zip(layers.t.get(at as usize).copied()))
        });
        Left(left.collect())
    }

    /// Holds what was left of a frame against the exact loop over its spheres.
    pub(super) fn hold(&self, frame: &Scene, left: &Left, drawn: &mut Drawn) {
        let exact = Tracer::new(Arithmetic::Exact);
        for &(at, answer) in &left.0 {
            let [x, y] = place(at, self.camera.size());
            let hit = exact.trace(&Ray::of_pixel(self.camera, x, y), frame);
            let (id, t) = hit.map_or((MISS, f32::INFINITY), |hit| (hit.id, hit.t));
            drawn.apart.push(answer.filter(|answer| answer.0 == id).map(|answer| ulps_apart(answer.1, t)));
        }
    }
}

fn place(at: u32, size: Size) -> [u32; 2] {
    [at % size.width(), at / size.width()]
}

/// A pixel's steps in scene units at the median t of what is seen; zero if nothing is.
fn pixel(camera: &Camera, truth: &Image) -> [[f64; 3]; 3] {
    let mut t: Vec<f32> = truth.t.iter().copied().filter(|t| t.is_finite()).collect();
    if t.is_empty() {
        return [[0.0; 3]; 3];
    }
    let middle = t.len() / 2;
    let t = f64::from(*t.select_nth_unstable_by(middle, f32::total_cmp).1);
    let [corner, du, dv] = [camera.corner(), camera.du(), camera.dv()].map(|v| v.map(f64::from));
    let half = [camera.size().width(), camera.size().height()].map(|side| f64::from(side) / 2.0);
    let forward: [f64; 3] = std::array::from_fn(|i| corner[i] + half[0] * du[i] + half[1] * dv[i]);
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let depth = length(du) / length(forward).max(f64::MIN_POSITIVE);
    [du, dv, forward.map(|x| x * depth)].map(|axis| axis.map(|x| x * t))
}
