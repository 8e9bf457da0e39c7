//! A frame: the grid is built, then stripes of four scanlines go to the workers as these become free, each stripe
//! in 4x4 blocks from left to right (the paper's SPUs and their blocks of scanlines).

use crate::camera::{BLOCK, Block, CameraLanes, middles};
use crate::frustum::Frustum;
use crate::grid::{Bounds, Grid};
use crate::machine::{LANES, Machine};
use crate::margin;
use crate::shade::{Surface, shade};
use crate::sphere::{Form, NONE, Nearest, Prepared};
use crate::walk::walk;
use contract::{Camera, Image, Scene, SizeError};
use std::sync::Mutex;

/// A frame's scene as seen from its camera: what all workers read.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The eye.
    pub eye: [f32; 3],
    /// The arithmetic.
    pub form: Form,
    /// The spheres relative to the eye, by id.
    pub spheres: Vec<Prepared>,
    /// The grid; `None` if there is nothing to hit or the scene is out of range ([`margin::in_range`]), when
    /// every sphere is met by every ray.
    pub grid: Option<Grid>,
}

impl Seen {
    /// Prepares spheres and builds the grid.
    #[must_use]
    pub fn new<M: Machine>(m: M, form: Form, scene: &Scene, camera: &Camera) -> Self {
        let eye = camera.eye();
        let spheres: Vec<Prepared> = scene.spheres().iter().map(|s| Prepared::new(eye, s)).collect();
        let bounds = |(p, s): (&Prepared, &contract::Sphere)| {
            Bounds::of_ball(s.center, margin::reach(form, p.f, s.radius))
        };
        let grid = margin::in_range(scene.spheres(), camera).then(|| {
            let bounds: Vec<Bounds> = spheres.iter().zip(scene.spheres()).map(bounds).collect();
            Grid::build(m, &bounds)
        });
        Self { eye, form, spheres, grid: grid.flatten() }
    }

    /// The nearest hit of each ray of a block. Rays without a common major axis go one by one.
    #[inline(always)]
    fn trace<M: Machine>(&self, m: M, block: &Block<M>) -> Nearest<M> {
        let Some(grid) = &self.grid else {
            let all = self.spheres.iter().zip(0..);
            return all.fold(
                Nearest::none(m),
                #[inline(always)]
                |nearest, (sphere, id)| nearest.meet(m, self.form, block, sphere, id),
            );
        };
        match Frustum::of_block(m, block) {
            Some(frustum) => walk(m, self, grid, block, &frustum),
            None => self.trace_singly(m, grid, block),
        }
    }

    #[inline(never)]
    fn trace_singly<M: Machine>(&self, m: M, grid: &Grid, block: &Block<M>) -> Nearest<M> {
        let (mut t, mut id) = ([f32::INFINITY; LANES], [NONE; LANES]);
        let dir = block.dir.map(|d| m.to_array(d));
        for lane in 0..LANES {
            let ray = Block::new(m, dir.map(|d| m.splat(d[lane])));
            // A direction of zero has no major axis, and hits nothing.
            let Some(frustum) = Frustum::of_block(m, &ray) else { continue };
            let nearest = walk(m, self, grid, &ray, &frustum);
            (t[lane], id[lane]) = (m.to_array(nearest.t)[lane], m.to_array_i(nearest.id)[lane]);
        }
        Nearest { t: m.lanes(t), id: m.lanes_i(id) }
    }
}

/// A stripe of the image under work: its rows of ids, t and colours.
struct Stripe<'a> {
    y: u32,
    ids: &'a mut [u32],
    t: &'a mut [f32],
    rgba: &'a mut [[u8; 4]],
}

/// Renders a frame with so many workers; the picture does not depend on them.
///
/// # Errors
/// [`SizeError::NoMemory`] if the image cannot be had.
///
/// # Panics
/// If a worker panicked.
pub fn render<M: Machine + Send + Sync>(
    m: M,
    form: Form,
    scene: &Scene,
    camera: &Camera,
    workers: usize,
) -> Result<Image, SizeError> {
    let mut image = Image::new(camera.size(), scene.background())?;
    let seen = Seen::new(m, form, scene, camera);
    let rows = camera.size().width() as usize * BLOCK as usize;
    let layers = image.ids.chunks_mut(rows).zip(image.t.chunks_mut(rows)).zip(image.rgba.chunks_mut(rows));
    let stripes = (0..).step_by(BLOCK as usize).zip(layers);
    let stripes = Mutex::new(stripes.map(|(y, ((ids, t), rgba))| Stripe { y, ids, t, rgba }));
    let next = || stripes.lock().expect("no worker panics while it holds the list").next();
    std::thread::scope(|scope| {
        for _ in 0..workers.max(1) {
            scope.spawn(|| {
                while let Some(mut stripe) = next() {
                    fill(m, &seen, scene, camera, &mut stripe);
                }
            });
        }
    });
    Ok(image)
}

fn fill<M: Machine>(m: M, seen: &Seen, scene: &Scene, camera: &Camera, stripe: &mut Stripe<'_>) {
    let lanes = CameraLanes::new(m, camera);
    for x in (0..camera.size().width()).step_by(BLOCK as usize) {
        let (xs, ys) = middles(m, camera, x, stripe.y);
        let block = lanes.block(m, xs, ys);
        let nearest = seen.trace(m, &block);
        write(m, scene, seen, &block, &nearest, x as usize, camera.size().width() as usize, stripe);
    }
}

/// Rim: colours a block and writes the pixels of it that hit.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "all of it differs from block to block")]
fn write<M: Machine>(
    m: M,
    scene: &Scene,
    seen: &Seen,
    block: &Block<M>,
    nearest: &Nearest<M>,
    x: usize,
    width: usize,
    stripe: &mut Stripe<'_>,
) {
    let (ids, t) = (m.to_array_i(nearest.id), m.to_array(nearest.t));
    if ids == [NONE; LANES] {
        return;
    }
    let mut gathered = [[0.0; LANES]; 7];
    for lane in 0..LANES {
        if let Some(s) = scene.spheres().get(ids[lane].unsigned_abs() as usize) {
            let [r, g, b] = s.color.map(f32::from);
            let values = [s.center[0], s.center[1], s.center[2], s.radius, r, g, b];
            for (lanes, value) in gathered.iter_mut().zip(values) {
                lanes[lane] = value;
            }
        }
    }
    let [cx, cy, cz, r, red, green, blue] = gathered.map(|lanes| m.lanes(lanes));
    let surface = Surface { center: [cx, cy, cz], radius: r, color: [red, green, blue] };
    let (eye, light) = (seen.eye.map(|x| m.splat(x)), scene.light().map(|x| m.splat(x)));
    let rgb = shade(m, eye, block.dir, light, nearest.t, &surface).map(|channel| m.to_array_i(channel));
    for lane in 0..LANES {
        let column = x + lane % BLOCK as usize;
        let pixel = lane / BLOCK as usize * width + column;
        if ids[lane] == NONE || column >= width || pixel >= stripe.ids.len() {
            continue;
        }
        stripe.ids[pixel] = ids[lane].unsigned_abs();
        stripe.t[pixel] = t[lane];
        stripe.rgba[pixel] = [to_byte(rgb[0][lane]), to_byte(rgb[1][lane]), to_byte(rgb[2][lane]), 255];
    }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255 by rule 4")]
fn to_byte(channel: i32) -> u8 {
    channel as u8
}
