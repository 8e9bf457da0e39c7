//! The truth about scenes that one loop over all spheres per ray takes too long for: the same exact loop, narrowed for
//! each tile of pixels to the spheres that can be seen there at all.
//!
//! *Why it is the same picture.* Let m be the direction through the middle of the picture and X, Y a pixel's place
//! counted from there. Its ray has the direction M (X, Y, 1) + ε with M = [du dv m] and ε from rule 1's roundings: in each
//! component at most u (2|corner| + 3w|du| + 2h|dv|) and three times half the least subnormal, u = 2⁻²⁴. So a point p of the
//! ray at t > 0 has M⁻¹ (p − eye) = t (X + δx, Y + δy, 1 + δz), δ = M⁻¹ε, and with (α, β, γ) for the left side α/γ = (X + δx) / (1 +
//! δz). Over a ball of radius r, each of α, β, γ ranges over its value at the centre ± r times the length of M⁻¹'s row. If
//! γ > 0 on all of the ball, X therefore lies between the extreme quotients, widened by |α/γ||δz| + |δx|, and Y likewise; within
//! the picture |α/γ| is at most (|X| + |δx|) / (1 − |δz|). If γ < 0 on all of it, the ball is behind the eye.
//! A sphere for which γ may have either sign is kept for every tile, and so is every sphere where M is too nearly singular
//! to be inverted in f64 (its determinant below 2⁻²⁰ of the product of its columns' lengths, which leaves rows that are good
//! to 2⁻³⁰, for which 2⁻²⁴ is put on top) or where δz exceeds 1/4. A whole pixel is added on each side.
//! A tile's spheres stay in the order of their ids, so ties go to the lowest id as before.
//!
//! In: a scene and a camera. Out: the exact picture. It shares nothing with the tracers under test but the contract. A
//! sample of rays goes through the full loop as well, and a difference is an error, not a verdict.

use contract::{Camera, Image, MISS, Scene, Size, SizeError, Sphere};
use rand::RngExt;
use rayon::prelude::*;
use reference::{Arithmetic, Hit, Ray, Tracer, shade};
use thiserror::Error;

/// Side of a tile in pixels.
const TILE: u32 = 8;
/// A sphere that touches more tiles than this is kept for every one.
const WIDE: usize = 256;
/// Rays of the sample, times spheres: about how much [`narrowed`] gives the full loop to do.
pub const SAMPLE: usize = 1 << 31;
/// Rays of any sample, if the picture has as many.
pub const LEAST: usize = 256;

/// Why there is no truth.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum NarrowedError {
    /// No memory for the picture.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The narrowed loop and the full one differ: one of them is broken.
    #[error("pixel ({x}, {y}): the exact loop gives {full:?}, narrowed to a tile {narrowed:?}; seed {seed}")]
    Differs {
        /// Column.
        x: u32,
        /// Row.
        y: u32,
        /// Id and t of the full loop.
        full: (u32, f32),
        /// Id and t of the narrowed one.
        narrowed: (u32, f32),
        /// Of the sample.
        seed: u64,
    },
}

/// An exact picture, and how many of its pixels went through the full loop too.
#[derive(Clone, Debug)]
pub struct Narrowed {
    /// The picture.
    pub image: Image,
    /// Rays on which narrowed and full loop agreed.
    pub sampled: usize,
}

/// The exact picture by narrowed loops, and a sample of it by the full one.
///
/// # Errors
/// [`NarrowedError`] if memory cannot be had or the sample differs.
pub fn narrowed(scene: &Scene, camera: &Camera, seed: u64) -> Result<Narrowed, NarrowedError> {
    let image = picture(scene, camera, &Tiles::new(scene.spheres(), camera))?;
    let sampled = sample(scene, camera, &image, SAMPLE, seed)?;
    Ok(Narrowed { image, sampled })
}

/// Holds random pixels of a picture against the full loop and says how many there were: rays times spheres are about `work`, but
/// [`LEAST`] rays at least, and all pixels if that takes no longer.
///
/// # Errors
/// [`NarrowedError::Differs`] for one that differs.
pub fn sample(
    scene: &Scene,
    camera: &Camera,
    image: &Image,
    work: usize,
    seed: u64,
) -> Result<usize, NarrowedError> {
    let (size, exact) = (camera.size(), Tracer::new(Arithmetic::Exact));
    let rays = (work / scene.spheres().len().max(1)).max(LEAST);
    let mut rng = crate::seed::generator(seed, 7);
    let pixels: Vec<usize> = if rays >= size.pixels() {
        (0..size.pixels()).collect()
    } else {
        (0..rays).map(|_| rng.random_range(0..size.pixels())).collect()
    };
    pixels.par_iter().try_for_each(|&i| {
        let [x, y] = place(i, size);
        let full = answer(exact.trace(&Ray::of_pixel(camera, x, y), scene));
        let narrowed = (image.ids[i], image.t[i]);
        if (full.0, full.1.to_bits()) == (narrowed.0, narrowed.1.to_bits()) {
            Ok(())
        } else {
            Err(NarrowedError::Differs { x, y, full, narrowed, seed })
        }
    })?;
    Ok(pixels.len())
}

fn answer(hit: Option<Hit>) -> (u32, f32) {
    hit.map_or((MISS, f32::INFINITY), |hit| (hit.id, hit.t))
}

fn place(index: usize, size: Size) -> [u32; 2] {
    let (index, width) = (u32::try_from(index).expect("at most 2^27 pixels"), size.width());
    [index % width, index / width]
}

/// The picture whose tiles are asked only for their own spheres.
fn picture(scene: &Scene, camera: &Camera, tiles: &Tiles) -> Result<Image, SizeError> {
    let size = camera.size();
    let mut image = Image::new(size, scene.background())?;
    let exact = Tracer::new(Arithmetic::Exact);
    let pixels = size.width() as usize * TILE as usize;
    let layers = image.ids.par_chunks_mut(pixels).zip(image.t.par_chunks_mut(pixels));
    let strips = layers.zip(image.rgba.par_chunks_mut(pixels)).enumerate();
    strips.for_each(|(row, ((ids, t), rgba))| {
        for column in 0..tiles.columns {
            let own = tiles.ids(row * tiles.columns + column);
            let spheres = own.iter().map(|&id| scene.spheres()[id as usize]).collect();
            let few = Scene::new(spheres, scene.background(), scene.light()).expect("part of a scene");
            let left = u32::try_from(column).expect("few tiles") * TILE;
            for x in left..(left + TILE).min(size.width()) {
                for y in 0..ids.len() / size.width() as usize {
                    let at = y * size.width() as usize + x as usize;
                    let y = u32::try_from(row * TILE as usize + y).expect("a row");
                    let ray = Ray::of_pixel(camera, x, y);
                    if let Some(hit) = exact.trace(&ray, &few) {
                        rgba[at] = shade(&few, &ray, hit);
                        (ids[at], t[at]) = (own[hit.id as usize], hit.t);
                    }
                }
            }
        }
    });
    Ok(image)
}

/// For each tile the spheres that can be seen in it.
struct Tiles {
    columns: usize,
    /// Where each tile's spheres begin.
    offsets: Vec<usize>,
    ids: Vec<u32>,
    everywhere: Vec<u32>,
}

impl Tiles {
    fn new(spheres: &[Sphere], camera: &Camera) -> Self {
        let size = camera.size();
        let [columns, rows] = [size.width(), size.height()].map(|side| side.div_ceil(TILE) as usize);
        let view = View::new(camera);
        let reach: Vec<Reach> = spheres
            .par_iter()
            .map(|sphere| match view.as_ref().and_then(|view| view.pixels(sphere)) {
                Some(pixels) => Reach::new(pixels, size),
                None => Reach::Everywhere,
            })
            .collect();
        let mut offsets = vec![0; columns * rows + 1];
        let tiles = |[x, y]: [[usize; 2]; 2]| {
            (y[0]..y[1]).flat_map(move |row| (x[0]..x[1]).map(move |column| row * columns + column))
        };
        for reach in &reach {
            if let Reach::Tiles(range) = reach {
                tiles(*range).for_each(|tile| offsets[tile + 1] += 1);
            }
        }
        for tile in 0..columns * rows {
            offsets[tile + 1] += offsets[tile];
        }
        let (mut ids, mut ends, mut everywhere) =
            (vec![0; offsets[columns * rows]], offsets.clone(), Vec::new());
        for (id, reach) in (0..).zip(&reach) {
            match reach {
                Reach::Everywhere => everywhere.push(id),
                Reach::Tiles(range) => tiles(*range).for_each(|tile| {
                    ids[ends[tile]] = id;
                    ends[tile] += 1;
                }),
            }
        }
        Self { columns, offsets, ids, everywhere }
    }

    /// A tile's spheres in the order of their ids.
    fn ids(&self, tile: usize) -> Vec<u32> {
        let own = &self.ids[self.offsets[tile]..self.offsets[tile + 1]];
        let mut ids = [own, &self.everywhere].concat();
        if !self.everywhere.is_empty() {
            ids.sort_unstable();
        }
        ids
    }
}

/// The tiles in which a sphere may be seen: first and end of columns and rows.
enum Reach {
    Everywhere,
    Tiles([[usize; 2]; 2]),
}

impl Reach {
    /// From pixels, not whole ones, counted from the picture's corner.
    fn new(pixels: [[f64; 2]; 2], size: Size) -> Self {
        let sides = [size.width(), size.height()];
        let range = [0, 1].map(|axis| {
            let [lo, hi] = pixels[axis].map(|x| x.clamp(-1.0, f64::from(sides[axis]) + 1.0));
            if hi < 0.0 || lo > f64::from(sides[axis]) {
                return [0, 0];
            }
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "clamped to the picture"
            )]
            let tile = |x: f64| (x.max(0.0) / f64::from(TILE)) as usize;
            [tile(lo), (tile(hi) + 1).min(sides[axis].div_ceil(TILE) as usize)]
        });
        let [columns, rows] = range.map(|[first, end]| end - first);
        if columns * rows > WIDE { Self::Everywhere } else { Self::Tiles(range) }
    }
}

type Vector = [f64; 3];

fn dot(u: Vector, v: Vector) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

fn cross(u: Vector, v: Vector) -> Vector {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

/// Pixels that are added on each side beyond what the derivation asks for.
pub const SURPLUS: f64 = 1.0;

/// The camera turned round: from points to pixels.
#[derive(Clone, Copy, Debug)]
pub struct View {
    eye: Vector,
    /// Rows of the inverse of M, and their lengths.
    rows: [Vector; 3],
    lengths: [f64; 3],
    /// Half the picture.
    middle: [f64; 2],
    /// What is added on each side, in pixels.
    pad: [f64; 2],
}

impl View {
    /// `None` for a camera of which nothing can be said.
    #[must_use]
    pub fn new(camera: &Camera) -> Option<Self> {
        let wide = |v: [f32; 3]| v.map(f64::from);
        let (eye, corner, du, dv) =
            (wide(camera.eye()), wide(camera.corner()), wide(camera.du()), wide(camera.dv()));
        let [w, h] = [camera.size().width(), camera.size().height()].map(f64::from);
        let middle = [w / 2.0, h / 2.0];
        let m = [0, 1, 2].map(|i| corner[i] + middle[0] * du[i] + middle[1] * dv[i]);
        let determinant = dot(du, cross(dv, m));
        let lengths = length(du) * length(dv) * length(m);
        // False on NaN.
        if !(determinant.abs() > 2f64.powi(-20) * lengths && lengths > 0.0) {
            return None;
        }
        let rows = [cross(dv, m), cross(m, du), cross(du, dv)].map(|row| row.map(|x| x / determinant));
        let lengths = rows.map(|row| length(row) * (1.0 + 2f64.powi(-24)));
        let rounding = 2f64.powi(-24) * (2.0 * length(corner) + 3.0 * w * length(du) + 2.0 * h * length(dv));
        // Of three components, with what is of second order.
        let rounding = 1.01 * 3f64.sqrt() * (rounding + 3.0 * 2f64.powi(-150));
        let delta = lengths.map(|length| length * rounding);
        // NaN lies in no range.
        if !(0.0..0.25).contains(&delta[2]) {
            return None;
        }
        let pad = [0, 1].map(|i| SURPLUS + 1.34 * (middle[i] + delta[i]) * delta[2] + delta[i]);
        Some(Self { eye, rows, lengths, middle, pad })
    }

    /// From where to where in x and in y a sphere may be seen, in pixels from the picture's corner, a pixel being where its
    /// middle is; `None` if that cannot be said.
    #[must_use]
    pub fn pixels(&self, sphere: &Sphere) -> Option<[[f64; 2]; 2]> {
        let (r, c) = (f64::from(sphere.radius), sphere.center.map(f64::from));
        let f = [0, 1, 2].map(|i| c[i] - self.eye[i]);
        let far = length(f);
        let span = |k: usize| {
            let (value, slack) = (dot(self.rows[k], f), self.lengths[k] * (r + 2f64.powi(-24) * (far + r)));
            [value - slack, value + slack]
        };
        let [near, beyond] = span(2);
        if beyond < 0.0 {
            return Some([[f64::NEG_INFINITY; 2]; 2]);
        }
        if !(near > 0.0 && beyond.is_finite()) {
            return None;
        }
        Some([0, 1].map(|k| {
            let [lo, hi] = span(k);
            let lo = if lo < 0.0 { lo / near } else { lo / beyond };
            let hi = if hi > 0.0 { hi / near } else { hi / beyond };
            [self.middle[k] + lo - self.pad[k], self.middle[k] + hi + self.pad[k]]
        }))
    }
}
