//! A frame: the grid is built, then stripes of scanlines go to the workers as these become free. A stripe is four scanlines, in 4x4
//! blocks from left to right (the paper's SPUs and their blocks of scanlines), or as many as its tiles are high.

use crate::camera::{BLOCK, CameraLanes, middles};
use crate::clock::Clock;
use crate::crew::Crew;
use crate::event::{Events, RenderError};
use crate::grid::Memory;
use crate::machine::{Chore, Machine, Stage};
use crate::plan::{Packet, Plan, Sharing};
use crate::seen::{Counts, Seen, Worker};
use crate::settle::ALL;
use crate::stripe::{NO_COLUMN, Painter, Rect, Stripe};
use crate::tile::{self, Tiles};
use contract::{Camera, Image, MISS, Scene, Size};
use std::time::Duration;

/// A picture and how it came about.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// The picture.
    pub image: Image,
    /// What the scene did that the plan's choices do not allow, in the order in which it was found. If there is any, the
    /// plan's [`OnEvent`](crate::plan::OnEvent) says what followed.
    pub events: Events,
    /// What tracing cost.
    pub counts: Counts,
    /// How long it took.
    pub times: Times,
    /// Where the image is not just background, so that the next frame need not clear all of it.
    left: Left,
}

/// What a frame left on its image.
#[derive(Clone, Debug, Default)]
struct Left {
    background: [u8; 3],
    /// As [`Stripe::columns`], of all rows of blocks.
    columns: Vec<[u32; 2]>,
}

/// Where the time of a frame went; zero on a target without a clock, which is WebAssembly by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// Until everything stood that all rays share: the grid, and the spheres as seen from the eye.
    pub build: Duration,
    /// From there to the finished picture.
    pub trace: Duration,
}

/// What a tracer would have to know beforehand to do nothing in vain: of each 4x4 block the spheres that own a pixel of it.
/// Who is given that ([`Session::render_known`](crate::Session::render_known)) shows how fast the sphere kernel could go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Known {
    size: Size,
    offsets: Vec<u32>,
    ids: Vec<u32>,
}

impl Known {
    /// From a picture that has been made.
    ///
    /// # Panics
    /// If the image has fewer ids than its size says, which none has that a tracer gave.
    #[must_use]
    pub fn of(image: &Image) -> Self {
        let (width, height) = (image.size.width(), image.size.height());
        let mut known = Self { size: image.size, offsets: vec![0], ids: Vec::new() };
        for y in (0..height).step_by(BLOCK as usize) {
            for x in (0..width).step_by(BLOCK as usize) {
                let first = known.ids.len();
                for row in y..(y + BLOCK).min(height) {
                    for column in x..(x + BLOCK).min(width) {
                        let id = image.ids[row as usize * width as usize + column as usize];
                        if id != MISS && !known.ids[first..].contains(&id) {
                            known.ids.push(id);
                        }
                    }
                }
                known.offsets.push(u32::try_from(known.ids.len()).expect("fewer than pixels"));
            }
        }
        known
    }

    /// Whether a frame can be the one that is known.
    fn check(&self, scene: &Scene, camera: &Camera) -> Result<(), RenderError> {
        if self.size != camera.size() {
            return Err(RenderError::Known { known: self.size, asked: camera.size() });
        }
        let spheres = scene.spheres().len();
        match self.ids.iter().find(|id| **id as usize >= spheres) {
            Some(&id) => Err(RenderError::KnownId { id, spheres }),
            None => Ok(()),
        }
    }

    /// The owners of the block whose first pixel is (x, y).
    #[inline(always)]
    #[must_use]
    pub fn block(&self, [x, y]: [u32; 2]) -> &[u32] {
        let index = (y / BLOCK * self.size.width().div_ceil(BLOCK) + x / BLOCK) as usize;
        &self.ids[self.offsets[index] as usize..self.offsets[index + 1] as usize]
    }
}

impl Rendering {
    /// An empty frame, whose memory is taken by those that follow.
    pub(crate) fn nothing() -> Result<Self, RenderError> {
        let (image, events) = (Image::new(Size::new(1, 1)?, [0; 3])?, Events::default());
        Ok(Self { image, events, counts: Counts::default(), times: Times::default(), left: Left::default() })
    }
}

/// What is to be rendered, and how.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The plan.
    pub plan: Plan,
    /// The scene.
    pub scene: &'a Scene,
    /// The camera.
    pub camera: &'a Camera,
    /// The workers; the picture does not depend on their number.
    pub crew: &'a Crew,
    /// What is known of the picture beforehand, if anything.
    pub known: Option<&'a Known>,
}

/// Renders a frame into the memory of the one before, which stays whole if there is an error.
///
/// # Errors
/// [`RenderError`] if the image cannot be had, the plan refuses what the scene does, or what is known is of another size.
///
/// # Panics
/// If a worker panicked.
pub fn render<M: Machine + Send + Sync>(
    m: M,
    frame: &Frame<'_>,
    memory: &mut Memory,
    rendering: &mut Rendering,
) -> Result<(), RenderError> {
    let Frame { plan, scene, camera, crew, known } = *frame;
    if let Some(known) = known {
        known.check(scene, camera)?;
    }
    let start = Clock::start();
    // Nothing of the last frame is touched before it is certain that there will be another.
    let mut events = Events::default();
    let seen = Seen::new(m, plan, scene, camera, memory, &mut events, crew)?;
    let build = start.elapsed();
    let (image, left) = (&mut rendering.image, &mut rendering.left);
    if image.size != camera.size() || left.background != scene.background() || left.columns.is_empty() {
        *image = Image::new(camera.size(), scene.background())?;
        let rows_of_blocks = camera.size().height().div_ceil(BLOCK) as usize;
        *left = Left { background: scene.background(), columns: vec![NO_COLUMN; rows_of_blocks] };
    }
    let width = camera.size().width() as usize;
    let [side, height] = tile_size(plan.packet, camera.size().height(), crew.size());
    let rows = width * height as usize;
    let layers = image.ids.chunks_mut(rows).zip(image.t.chunks_mut(rows)).zip(image.rgba.chunks_mut(rows));
    let layers = layers.zip(left.columns.chunks_mut((height / BLOCK) as usize));
    let stripes = (0..).step_by(height as usize).zip(layers);
    let stripes = stripes.map(|(y, (((ids, t), rgba), columns))| Stripe { y, width, ids, t, rgba, columns });
    let counts = crew.share(stripes, |next| {
        let mirrored = match plan.sharing {
            Sharing::Shared => None,
            // The same grid with the same events once more; an error would have come the first time.
            Sharing::Mirrored => {
                let (mut memory, mut events) = (Memory::default(), Events::default());
                Seen::new(m, plan, scene, camera, &mut memory, &mut events, &Crew::alone()).ok()
            }
        };
        let seen = mirrored.as_ref().unwrap_or(&seen);
        if let (Packet::Tile { .. }, Some(grid)) = (plan.packet, &seen.grid) {
            let mut tiles = m.within(
                #[inline(always)]
                || Tiles::new(m, plan, scene, camera, grid),
            );
            while let Some(mut stripe) = next() {
                m.within(
                    #[inline(always)]
                    || fill_tiles(&mut tiles, side, camera, known, &mut stripe),
                );
            }
            return tiles.counts();
        }
        let mut worker = Worker::default();
        while let Some(mut stripe) = next() {
            m.within(
                #[inline(always)]
                || fill(m, seen, scene, camera, known, &mut stripe, &mut worker),
            );
        }
        worker.counts
    });
    rendering.counts = counts.into_iter().fold(Counts::default(), |sum, counts| sum + counts);
    rendering.events = events;
    memory.take(seen.grid);
    rendering.times = Times { build, trace: start.elapsed() - build };
    Ok(())
}

/// Pixels across a packet, and scanlines of a stripe: as many as a tile has, but for several workers so few that each may take eight
/// stripes, lest one is left waiting for the other; whole patches of a tile if that can be.
#[must_use]
pub fn tile_size(packet: Packet, rows: u32, workers: usize) -> [u32; 2] {
    let side = match packet {
        Packet::Block => BLOCK,
        Packet::Tile { side } => u32::from(side) * BLOCK,
    };
    [side, stripe_height(side, rows, workers)]
}

fn stripe_height(side: u32, rows: u32, workers: usize) -> u32 {
    const PATCH: u32 = tile::PATCH * BLOCK;
    if workers <= 1 || side <= PATCH {
        return side;
    }
    let stripes = u32::try_from(workers.saturating_mul(8)).unwrap_or(u32::MAX);
    (rows / stripes).next_multiple_of(PATCH).clamp(PATCH, side)
}

/// Fills a stripe block by block.
#[inline(always)]
fn fill<M: Machine>(
    m: M,
    seen: &Seen,
    scene: &Scene,
    camera: &Camera,
    known: Option<&Known>,
    stripe: &mut Stripe<'_>,
    worker: &mut Worker,
) {
    let (lanes, painter) = (CameraLanes::new(m, camera), Painter::new(m, scene, camera));
    let rows = stripe.ids.len() / stripe.width;
    for y in (stripe.y..).step_by(BLOCK as usize).take(rows.div_ceil(BLOCK as usize)) {
        for x in (0..camera.size().width()).step_by(BLOCK as usize) {
            let owners = known.map(
                #[inline(always)]
                |known| known.block([x, y]),
            );
            block(m, seen, scene, camera, (&lanes, &painter), owners, [x, y], stripe, worker);
        }
    }
}

/// Traces and colours the block whose first pixel is (x, y), into the stripe that holds it.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "all that a block needs")]
pub fn block<M: Machine>(
    m: M,
    seen: &Seen,
    scene: &Scene,
    camera: &Camera,
    (lanes, painter): (&CameraLanes<M>, &Painter<M>),
    owners: Option<&[u32]>,
    [x, y]: [u32; 2],
    stripe: &mut Stripe<'_>,
    worker: &mut Worker,
) {
    m.beside(
        Chore::Block([x, y]),
        #[inline(always)]
        || (),
    );
    m.stage(Stage::Frustum);
    let (xs, ys) = middles(m, camera, x, y);
    let block = lanes.block(m, xs, ys);
    let answers = seen.trace(m, scene.spheres(), &block, owners, worker);
    painter.write(m, block.dir, &answers, [x, y], ALL, stripe);
}

/// Fills a stripe tile by tile, after it was cleared of what the last frame left there.
#[inline(always)]
fn fill_tiles<M: Machine>(
    tiles: &mut Tiles<'_, M>,
    side: u32,
    camera: &Camera,
    known: Option<&Known>,
    stripe: &mut Stripe<'_>,
) {
    let y = [stripe.y, stripe.y + u32::try_from(stripe.ids.len() / stripe.width).expect("rows of an image")];
    let width = camera.size().width();
    tiles.clear(stripe);
    for x in (0..width).step_by(side as usize) {
        tiles.trace(Rect { x: [x, (x + side).min(width)], y }, known, stripe);
    }
}
