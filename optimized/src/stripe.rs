//! Where a worker writes: a few rows of the image, which are its own, and from answers to pixels.

use crate::camera::{BLOCK, spread};
use crate::machine::{LANES, Machine, three};
use crate::settle::{ALL, Answers, same};
use crate::shade::{Surface, shade};
use crate::sphere::NONE;
use contract::{Camera, MISS, Scene, Sphere};

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
}

/// What colours need besides the sphere that is hit.
#[derive(Clone, Copy)]
pub struct Painter<'a, M: Machine> {
    spheres: &'a [Sphere],
    eye: [M::F; 3],
    light: [M::F; 3],
    background: u32,
}

impl<'a, M: Machine> Painter<'a, M> {
    /// For a scene and a camera.
    #[inline(always)]
    pub fn new(m: M, scene: &'a Scene, camera: &Camera) -> Self {
        let [r, g, b] = scene.background();
        Self {
            spheres: scene.spheres(),
            eye: spread(m, camera.eye()),
            light: spread(m, scene.light()),
            background: u32::from_le_bytes([r, g, b, 255]),
        }
    }

    /// Colours of the rays of a packet, four bytes each; the background's for those that miss.
    #[inline(always)]
    fn colors(&self, m: M, dir: [M::F; 3], answers: &Answers<M>) -> M::I {
        let mut colors = m.splat_i(self.background.cast_signed());
        let ids = m.to_array_i(answers.id);
        let mut rest = m.to_bits(m.lt_i(answers.id, m.splat_i(NONE)));
        while rest != 0 {
            let id = ids[rest.trailing_zeros() as usize];
            let sphere = &self.spheres[id.unsigned_abs() as usize];
            let color = three(
                sphere.color,
                #[inline(always)]
                |channel| m.splat(f32::from(channel)),
            );
            let surface =
                Surface { center: spread(m, sphere.center), radius: m.splat(sphere.radius), color };
            let [r, g, b] = three(
                shade(m, self.eye, dir, self.light, answers.t, &surface),
                #[inline(always)]
                |channel| m.to_array_i(channel),
            );
            let mut packed = [0; LANES];
            for lane in 0..LANES {
                packed[lane] = r[lane] | g[lane] << 8 | b[lane] << 16 | 255 << 24;
            }
            let same = same(m, answers.id, id);
            colors = m.select_i(same, m.lanes_i(packed), colors);
            rest &= !m.to_bits(same);
        }
        colors
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
        let colors = self.colors(m, dir, answers);
        let hit = m.lt_i(answers.id, m.splat_i(NONE));
        let ids = m.select_i(hit, answers.id, m.splat_i(MISS.cast_signed()));
        stripe.put(at, wanted, &m.to_array_i(ids), &m.to_array(answers.t), &m.to_array_i(colors));
    }

    /// Makes misses of the lanes `wanted` of the block whose first pixel is (x, y).
    #[inline(always)]
    pub fn miss(&self, at: [u32; 2], wanted: u32, stripe: &mut Stripe<'_>) {
        let colors = [self.background.cast_signed(); LANES];
        stripe.put(at, wanted, &[MISS.cast_signed(); LANES], &[f32::INFINITY; LANES], &colors);
    }
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
