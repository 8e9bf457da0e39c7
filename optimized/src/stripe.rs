//! Where a worker writes: a few rows of the image, which are its own, and from answers to pixels.

use crate::camera::{BLOCK, spread};
use crate::machine::{Chore, LANES, Machine, Stage, three};
use crate::settle::{ALL, Answers};
use crate::shade::shade;
use crate::sphere::NONE;
use contract::{Camera, MISS, Scene};

/// Rows of an image under work: ids, t and colours.
#[derive(Debug)]
pub struct Stripe<'a> {
    /// The first of them in the image.
    pub y: u32,
    /// Pixels in a row.
    pub width: usize,
    /// Of each pixel, row by row.
    pub ids: &'a mut [u32],
    /// Of each pixel, row by row.
    pub t: &'a mut [f32],
    /// Of each pixel, row by row.
    pub rgba: &'a mut [[u8; 4]],
    /// Of each row of blocks, outside which columns every pixel is a miss; see [`NO_COLUMN`].
    pub columns: &'a mut [[u32; 2]],
}

/// Of a row of blocks that is nothing but misses: from and to, of which the first is beyond the second.
pub const NO_COLUMN: [u32; 2] = [u32::MAX, 0];

/// Pixels, from and to.
#[derive(Clone, Copy, Debug)]
pub struct Rect {
    /// Columns.
    pub x: [u32; 2],
    /// Rows.
    pub y: [u32; 2],
}

impl Rect {
    /// Squares of that side in a row, and rows of them.
    #[inline(always)]
    #[must_use]
    pub fn squares(&self, side: u32) -> [u32; 2] {
        [(self.x[1] - self.x[0]).div_ceil(side), (self.y[1] - self.y[0]).div_ceil(side)]
    }
}

/// What colours need besides the sphere that is hit.
#[derive(Clone, Copy)]
pub struct Painter<M: Machine> {
    eye: [M::F; 3],
    light: [M::F; 3],
    background: u32,
}

impl<M: Machine> Painter<M> {
    /// For a scene and a camera.
    #[inline(always)]
    pub fn new(m: M, scene: &Scene, camera: &Camera) -> Self {
        let [r, g, b] = scene.background();
        Self {
            eye: spread(m, camera.eye()),
            light: spread(m, scene.light()),
            background: u32::from_le_bytes([r, g, b, 255]),
        }
    }

    /// Writes the lanes `wanted` of the block whose first pixel is (x, y).
    #[inline(always)]
    pub fn write(
        &self,
        m: M,
        dir: [M::F; 3],
        answers: &Answers<M>,
        at: [u32; 2],
        wanted: u32,
        stripe: &mut Stripe<'_>,
    ) {
        m.stage(Stage::Shade);
        let channels = shade(m, self.eye, dir, self.light, answers.t, &answers.owners.surface);
        let colors = m.beside(
            Chore::Pixels,
            #[inline(always)]
            || pack(m, channels),
        );
        let hit = m.lt_i(answers.owners.id, m.splat_i(NONE));
        let colors = m.select_i(hit, colors, m.splat_i(self.background.cast_signed()));
        let ids = m.select_i(hit, answers.owners.id, m.splat_i(MISS.cast_signed()));
        stripe.put(at, wanted, &m.to_array_i(ids), &m.to_array(answers.t), &m.to_array_i(colors));
    }

    /// Makes misses of all pixels that are none. Written row by row they come into the cache as fast as they can, and most stay.
    #[inline(always)]
    pub fn clear(&self, stripe: &mut Stripe<'_>) {
        let background = self.background.to_le_bytes();
        let rows = stripe.ids.chunks_mut(stripe.width).zip(stripe.t.chunks_mut(stripe.width));
        for (y, ((ids, t), rgba)) in rows.zip(stripe.rgba.chunks_mut(stripe.width)).enumerate() {
            let [from, to] = stripe.columns[y / BLOCK as usize].map(|x| x as usize);
            if from < to {
                ids[from..to].fill(MISS);
                t[from..to].fill(f32::INFINITY);
                rgba[from..to].fill(background);
            }
        }
        stripe.columns.fill(NO_COLUMN);
    }
}

/// Rim: three channels of 0 to 255 and full opacity, a byte each.
#[inline(always)]
fn pack<M: Machine>(m: M, channels: [M::I; 3]) -> M::I {
    let [r, g, b] = three(
        channels,
        #[inline(always)]
        |channel| m.to_array_i(channel),
    );
    let mut colors = [0; LANES];
    for lane in 0..LANES {
        colors[lane] = r[lane] | g[lane] << 8 | b[lane] << 16 | 255 << 24;
    }
    m.lanes_i(colors)
}

impl Stripe<'_> {
    /// Writes lanes of the block whose first pixel is (x, y).
    #[inline(always)]
    fn put(
        &mut self,
        [x, y]: [u32; 2],
        wanted: u32,
        ids: &[i32; LANES],
        t: &[f32; LANES],
        colors: &[i32; LANES],
    ) {
        let columns = &mut self.columns[((y - self.y) / BLOCK) as usize];
        *columns = [columns[0].min(x), columns[1].max((x + BLOCK).min(self.width as u32))];
        let (x, side) = (x as usize, BLOCK as usize);
        let first = (y - self.y) as usize * self.width + x;
        if wanted == ALL && x + side <= self.width && first + 3 * self.width + side <= self.ids.len() {
            for row in 0..side {
                let (pixel, lane) = (first + row * self.width, row * side);
                let out = &mut self.ids[pixel..pixel + side];
                for i in 0..side {
                    out[i] = ids[lane + i].cast_unsigned();
                }
                self.t[pixel..pixel + side].copy_from_slice(&t[lane..lane + side]);
                let out = &mut self.rgba[pixel..pixel + side];
                for i in 0..side {
                    out[i] = colors[lane + i].to_le_bytes();
                }
            }
            return;
        }
        for lane in 0..LANES {
            let column = x + lane % side;
            let pixel = first + lane / side * self.width + lane % side;
            if wanted >> lane & 1 != 0 && column < self.width && pixel < self.ids.len() {
                self.ids[pixel] = ids[lane].cast_unsigned();
                self.t[pixel] = t[lane];
                self.rgba[pixel] = colors[lane].to_le_bytes();
            }
        }
    }
}
