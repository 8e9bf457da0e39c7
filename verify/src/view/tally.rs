//! What each packet of a frame cost, and which rays fell back: what a fast frame only adds up.
//!
//! In: a plan, a scene, a camera, and how many workers the frame has, which decides how high its tiles are. Out: a [`Tally`]. The frame is traced once
//! more by the same kernels, packet by packet, on a machine that tells which lanes were settled how (`watch`). Values and counts are those
//! of every level, since results are; that the sum is the fast frame's own count is tested.

use crate::watch::{Listener, Watch};
use contract::{Camera, Image, Scene};
use optimized::camera::{BLOCK, CameraLanes};
use optimized::crew::Crew;
use optimized::frame::{self, tile_size};
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::machine::Chore;
use optimized::plan::Packet;
use optimized::seen::{Counts, Seen, Worker};
use optimized::stripe::{NO_COLUMN, Painter, Rect, Stripe};
use optimized::tile::Tiles;
use optimized::{Events, Plan, RenderError};
use std::cell::RefCell;

/// A packet: a block or a tile.
#[derive(Clone, Copy, Debug)]
pub struct Unit {
    /// Its pixels.
    pub rect: Rect,
    /// What it cost.
    pub counts: Counts,
}

/// A lane that f32 left open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fallback {
    /// Its pixel, row first; lanes of a block that sticks out of the picture lie beyond it.
    pub row: u32,
    /// Column.
    pub column: u32,
    /// Whether f64 was asked which sphere it hits; else only its t was open.
    pub marked: bool,
    /// Whether integers were asked.
    pub integers: bool,
}

/// What a frame cost.
#[derive(Clone, Debug)]
pub struct Tally {
    /// All packets, row by row.
    pub units: Vec<Unit>,
    /// All lanes that were not settled by f32 and the short way to t, row by row. Of certified arithmetic only.
    pub fallbacks: Vec<Fallback>,
    /// The picture, which is that of the fast frame.
    pub image: Image,
    /// The sum of all packets.
    pub counts: Counts,
}

/// What a worker found.
#[derive(Debug, Default)]
struct Part {
    units: Vec<Unit>,
    heard: RefCell<Heard>,
}

#[derive(Debug, Default)]
struct Heard {
    block: [u32; 2],
    fallbacks: Vec<Fallback>,
}

/// Notes lanes that fall back.
#[derive(Clone, Copy)]
struct Lanes<'a>(&'a RefCell<Heard>);

impl Listener for Lanes<'_> {
    fn chore(self, chore: Chore) {
        match chore {
            Chore::Block(at) => self.0.borrow_mut().block = at,
            Chore::Settled { marked, only_t, integers } => {
                let heard = &mut *self.0.borrow_mut();
                let has = |bits: u32, lane: u32| bits >> lane & 1 != 0;
                for lane in (0..BLOCK * BLOCK).filter(|lane| has(marked | only_t, *lane)) {
                    let [column, row] = [heard.block[0] + lane % BLOCK, heard.block[1] + lane / BLOCK];
                    let (marked, integers) = (has(marked, lane), has(integers, lane));
                    heard.fallbacks.push(Fallback { row, column, marked, integers });
                }
            }
            _ => {}
        }
    }
}

/// Traces a frame packet by packet.
///
/// # Errors
/// [`RenderError`] as of the fast frame.
pub fn tally(plan: Plan, workers: usize, scene: &Scene, camera: &Camera) -> Result<Tally, RenderError> {
    let crew = Crew::new(workers)?;
    let (mut memory, mut events) = (Memory::default(), Events::default());
    let seen = Seen::new(Scalar, plan, scene, camera, &mut memory, &mut events, &crew)?;
    let mut image = Image::new(camera.size(), scene.background())?;
    let [side, height] = tile_size(plan.packet, camera.size().height(), workers);
    let width = camera.size().width() as usize;
    let rows = width * height as usize;
    let mut columns = vec![NO_COLUMN; camera.size().height().div_ceil(BLOCK) as usize];
    let layers = image.ids.chunks_mut(rows).zip(image.t.chunks_mut(rows)).zip(image.rgba.chunks_mut(rows));
    let layers = layers.zip(columns.chunks_mut((height / BLOCK) as usize));
    let stripes = (0..).step_by(height as usize).zip(layers);
    let stripes = stripes.map(|(y, (((ids, t), rgba), columns))| Stripe { y, width, ids, t, rgba, columns });
    let parts = crew.share(stripes, |next| {
        let mut part = Part::default();
        while let Some(stripe) = next() {
            part.stripe(&seen, scene, camera, side, stripe);
        }
        part
    });
    let (mut units, mut fallbacks) = (Vec::new(), Vec::new());
    for part in parts {
        units.extend(part.units);
        fallbacks.extend(part.heard.into_inner().fallbacks);
    }
    units.sort_by_key(|unit| (unit.rect.y[0], unit.rect.x[0]));
    fallbacks.sort_unstable();
    let counts = units.iter().fold(Counts::default(), |sum, unit| sum + unit.counts);
    Ok(Tally { units, fallbacks, image, counts })
}

impl Part {
    fn stripe(&mut self, seen: &Seen, scene: &Scene, camera: &Camera, side: u32, mut stripe: Stripe<'_>) {
        let m = Watch { values: Scalar, listener: Lanes(&self.heard) };
        let width = camera.size().width();
        let rows = u32::try_from(stripe.ids.len() / stripe.width).unwrap_or(0);
        if let (Packet::Tile { .. }, Some(grid)) = (seen.plan.packet, &seen.grid) {
            let y = [stripe.y, stripe.y + rows];
            for x in (0..width).step_by(side as usize) {
                let rect = Rect { x: [x, (x + side).min(width)], y };
                let mut tiles = Tiles::new(m, seen.plan, scene, camera, grid);
                tiles.trace(rect, None, &mut stripe);
                self.units.push(Unit { rect, counts: tiles.counts() });
            }
            return;
        }
        let kit = (&CameraLanes::new(m, camera), &Painter::new(m, scene, camera));
        for y in (stripe.y..stripe.y + rows).step_by(BLOCK as usize) {
            for x in (0..width).step_by(BLOCK as usize) {
                let mut worker = Worker::default();
                frame::block(m, seen, scene, camera, kit, None, [x, y], &mut stripe, &mut worker);
                let rect = Rect { x: [x, (x + BLOCK).min(width)], y: [y, (y + BLOCK).min(stripe.y + rows)] };
                self.units.push(Unit { rect, counts: worker.counts });
            }
        }
    }
}
