//! A tile of blocks: its candidates are gathered once, by a walk through the grid with the tile's frustum, and held by their outlines
//! against each of its blocks.
//!
//! In: a frame's grid ([`Grid::by_center`]), a rectangle of pixels. Out: these pixels, where they hit. The simple program is
//! [`crate::seen`], which walks the grid for each block anew. Step by step:
//!
//! 1. The tile's frustum walks the grid, slice by slice. What its cells list is looked at sixteen at a time: relative to the eye, with
//!    error bound and [`Outline`]; who overlaps the tile's range of slopes is a candidate. Some hundred candidates are a *round*.
//! 2. A *patch* of 8x8 blocks takes from a round what overlaps its own range, the nearest first.
//! 3. A block meets those of its patch that overlap it, until none can be nearer than what each ray has hit ([`crate::certain`]).
//! 4. Blocks that no later slice can change are finished; the others wait for the next round.
//! 5. A row of finished blocks is settled and coloured together ([`crate::settle`], [`crate::stripe`]).
//!
//! # What is lost, and why nothing
//!
//! A tile's rays need not share a major axis. Then it is traced once for each [`Heading`] that some of them have, and of each block
//! those lanes count that have it; slopes are at most 1 then, as everywhere.
//!
//! *Ranges.* A direction is c + x u + y v with three roundings a component, so it is off an affine function of (x, y) by less than
//! 3u G, G the largest |c| + W|u| + H|v|; we take s = 8u G. Slopes of the affine function, quotients of which the lower is positive, are
//! extreme at a rectangle's corners. Those of rounded directions differ from them by (1 + |slope|) s / (A − s) each, twice that in all; we
//! put on 4 (1 + |slope|) s / A and 16u (1 + |slope|) for the divisions. If A at some corner is not above 1024 s, the range is all of −1 to 1,
//! to which every other one is cut.
//!
//! *Candidates.* A hit's cell need not list its sphere, but the cell of the centre does, and slices look that far around (module
//! [`crate::frustum`]); large spheres are candidates of every tile. Who hits overlaps every range that holds the ray (module
//! [`crate::silhouette`]).
//!
//! *Ends.* A candidate is met, unless for each ray its nearest point lies behind the farthest that the ray's hit can be. A block is
//! finished as the walk's end has it (module [`crate::walk`]), w being the grid's widening.
//!
//! # What was tried
//!
//! One thread, AVX-512, 1280x720, rebuild included; the geometric mean over 1HVR, adenylate kinase, sphereflake 4 and 500, 2,000 and
//! 4,000 random spheres, in millions of rays a second, on an AMD EPYC (family 26), 24 November 2026. Each line is the state of the work when
//! it was tried, so lines compare with their neighbours.
//!
//! | tried | Mray/s |
//! |---|---|
//! | 4x4 blocks, a walk for each | 31 |
//! | tiles of 4x4, 8x8, 12x12, 16x16, 24x24, 32x32 blocks, no patches | 55, 95, 129, 142, 163, 165 |
//! | patches of 8x8 blocks, written patch by patch | 139 |
//! | the same, written in rows over all patches of the tile | 182 |
//! | large spheres apart (sphereflake 4: 8.2 to 5.3 ms), leaner grid | 191 |
//! | tiles cleared one by one, stripes cleared as a whole | 177, 208 |
//! | f64 and colours for all owners of a block at once, in place of for each | 201 (from 208: nothing won) |
//! | f64 and colours for a row of blocks at once | 208 |
//! | patches of 4x4 blocks | 197 |
//! | candidates of a patch sorted by how near they come | 224 |
//! | 1/32 cell a sphere in place of 4 | 243 |
//! | tiles of 16x16, 24x24, 64x64 blocks, then | 238, 240, 232 |
//! | tiles of 64x32, 32x16 blocks, then | 236, 243 |
//!
//! On another machine of that family, 25 November 2026:
//!
//! | tried | Mray/s |
//! |---|---|
//! | before | 337 |
//! | spheres by their ids from the scene, in place of copies in the order of cells ([`Grid::by_center`]) | 345 |
//! | cleared only where the last frame left something ([`crate::stripe`]) | 340 (on 1HVR 405 to 415, at 3840x2160 19.3 to 17.5 ms) |
//!
//! A plain memory fill of the picture took 0.15 ms, in pieces of 128x128 pixels 0.25 ms, of a frame's 3 to 5 ms. Of the rest, on 1HVR,
//! blocks meeting candidates take half, f64 and colours a third. The clairvoyant ([`Known`]) is 1.2 to 1.6 times as fast, so that little is left
//! to be won on the way to the spheres. Not tried: fused operations in the f32 filter, a Newton step in place of the f64
//! root.

use crate::bound::{self, Rule};
use crate::camera::{BLOCK, CameraLanes, spread};
use crate::certain::{Ball, Nearest, Rays, Side, sides};
use crate::cull;
use crate::double::short_error;
use crate::frame::Known;
use crate::frustum::{Frustum, Heading, Slices, beyond};
use crate::grid::Grid;
use crate::machine::{Chore, LANES, Machine, Site, three};
use crate::plan::{Culling, Plan};
use crate::seen::Counts;
use crate::settle::{ALL, Owner, Question};
use crate::silhouette::{Outline, overlap};
use crate::stripe::{Painter, Rect, Stripe};
use contract::{Camera, Scene, Sphere};

/// The most blocks on a side of a tile.
pub const MAX_SIDE: u8 = 64;
/// Candidates after which a tile's blocks are looked at before its walk goes on.
const ROUND: usize = 256;
/// Blocks on a side of a patch.
pub(crate) const PATCH: u32 = 8;

/// Of a sphere that is no candidate, and of one that lies behind the rays.
const NOT_TAKEN: u32 = u32::MAX;
const NOT_AHEAD: u32 = u32::MAX - 1;

/// Outlines, and how near what they belong to can be.
#[derive(Clone, Debug, Default)]
struct Outlines {
    lo: [Vec<f32>; 2],
    hi: [Vec<f32>; 2],
    near: Vec<f32>,
}

/// The spheres a tile may see.
#[derive(Clone, Debug, Default)]
struct Candidates {
    balls: Vec<Ball>,
    ids: Vec<u32>,
    /// Relative errors of t by the short way.
    errors: Vec<f32>,
    outlines: Outlines,
}

/// Of these, what a patch may see in a round.
#[derive(Clone, Debug, Default)]
struct Few {
    outlines: Outlines,
    /// Which candidates.
    index: Vec<u32>,
    /// How near they can be, and which.
    order: Vec<(i32, u32)>,
}

/// Ranges of slopes of many rectangles.
#[derive(Clone, Debug, Default)]
struct Ranges([[Vec<f32>; 2]; 2]);

/// What all tiles of a frame read.
#[derive(Clone, Copy)]
struct Look<'a, M: Machine> {
    m: M,
    plan: Plan,
    scene: &'a Scene,
    camera: &'a Camera,
    grid: &'a Grid,
    lanes: CameraLanes<M>,
    painter: Painter<M>,
    rule: Rule,
    /// More than the rounding of any direction, in any component.
    slack: f32,
}

/// A worker's tiles.
pub struct Tiles<'a, M: Machine> {
    look: Look<'a, M>,
    work: Work<M>,
}

/// What is made for a tile, kept for its memory.
struct Work<M: Machine> {
    counts: Counts,
    candidates: Candidates,
    few: Vec<Few>,
    blocks: Ranges,
    patches: Ranges,
    nearest: Vec<Nearest<M>>,
    /// Blocks that have met a sphere.
    touched: Vec<bool>,
    /// Blocks that are finished.
    closed: Vec<bool>,
    /// Lanes that are written.
    done: Vec<u32>,
    possible: Vec<u32>,
    /// By id the number of a sphere among the candidates, where what is seen is known.
    numbers: Vec<u32>,
    finished: Vec<Finished<M>>,
}

impl<'a, M: Machine> Tiles<'a, M> {
    /// For a frame.
    #[inline(always)]
    pub fn new(m: M, plan: Plan, scene: &'a Scene, camera: &'a Camera, grid: &'a Grid) -> Self {
        let look = Look {
            m,
            plan,
            scene,
            camera,
            grid,
            lanes: CameraLanes::new(m, camera),
            painter: Painter::new(m, scene, camera),
            rule: Rule::new(m.unit().into()),
            slack: slack(m.unit(), camera),
        };
        let work = Work {
            counts: Counts::default(),
            candidates: Candidates::default(),
            few: Vec::new(),
            blocks: Ranges::default(),
            patches: Ranges::default(),
            nearest: Vec::new(),
            touched: Vec::new(),
            closed: Vec::new(),
            done: Vec::new(),
            possible: Vec::new(),
            numbers: Vec::new(),
            finished: Vec::new(),
        };
        Self { look, work }
    }

    /// Traces a tile.
    #[inline(always)]
    pub fn trace(&mut self, tile: Rect, known: Option<&Known>, stripe: &mut Stripe<'_>) {
        self.work.trace(&self.look, tile, known, stripe);
    }

    /// Makes misses of all pixels; a tile writes those that hit.
    #[inline(always)]
    pub fn clear(&self, stripe: &mut Stripe<'_>) {
        self.look.painter.clear(stripe);
    }

    /// What they cost.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.work.counts
    }
}

impl<M: Machine> Work<M> {
    #[inline(always)]
    fn trace(&mut self, look: &Look<'_, M>, tile: Rect, known: Option<&Known>, stripe: &mut Stripe<'_>) {
        let corners = look.corners(tile);
        let [columns, rows] = tile.squares(BLOCK);
        let blocks = (columns * rows) as usize;
        self.done.clear();
        self.done.resize(blocks, 0);
        for heading in Heading::all() {
            let mut along = corners;
            for corner in &mut along {
                *corner = heading.along(*corner);
            }
            let share = share(look.slack, &along);
            if share != Share::None {
                self.pass(look, heading, &along, tile, share == Share::All, known, stripe);
            }
            if share == Share::All {
                return;
            }
        }
    }

    /// The rays of a tile that have a heading; `pure`: all of them have.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "a tile's state")]
    fn pass(
        &mut self,
        look: &Look<'_, M>,
        heading: Heading,
        corners: &[[f32; 3]; 4],
        tile: Rect,
        pure: bool,
        known: Option<&Known>,
        stripe: &mut Stripe<'_>,
    ) {
        let m = look.m;
        let [p, q, r, s] = *corners;
        let range = range(m, look.slack, [spread(m, p), spread(m, q), spread(m, r), spread(m, s)]);
        let slices =
            Frustum { heading, slopes: range }.slices(m, look.camera.eye(), look.grid, look.plan.margins);
        let strides = look.grid.strides();
        let [i, j, k] = heading.order;
        let stride = [strides[i], strides[j], strides[k]];
        look.ranges(heading, tile, BLOCK, &mut self.blocks);
        look.ranges(heading, tile, BLOCK * PATCH, &mut self.patches);
        let [columns, rows] = tile.squares(BLOCK);
        let blocks = (columns * rows) as usize;
        if self.nearest.len() < blocks {
            self.nearest.resize(blocks, Nearest::none(m));
        }
        for flags in [&mut self.touched, &mut self.closed] {
            flags.clear();
            flags.resize(blocks, false);
        }
        self.candidates.clear();
        if let Some(known) = known {
            self.known(look, heading, tile, pure, known, stripe);
            return;
        }
        let range = look.seen_from(range);
        self.take(look, heading, range, &look.grid.large);
        let (mut slice, mut from) = (0, 0);
        loop {
            while slice < slices.count && self.candidates.ids.len() < from + ROUND {
                self.gather_slice(look, heading, range, &slices, slice, stride);
                slice += 1;
            }
            self.candidates.outlines.pad();
            let all = slice >= slices.count;
            // Large spheres alone may fill a round, before any slice.
            let end = slice.checked_sub(1).map_or(f32::NEG_INFINITY, |last| slices.far[last]);
            let round = Round { heading, pure, from, all, end };
            let open = self.round(look, round, tile, stripe);
            if all || open == 0 {
                return;
            }
            self.candidates.trim();
            from = self.candidates.ids.len();
        }
    }

    /// Shows each block the spheres that are known to own pixels of it.
    #[inline(always)]
    fn known(
        &mut self,
        look: &Look<'_, M>,
        heading: Heading,
        tile: Rect,
        pure: bool,
        known: &Known,
        stripe: &mut Stripe<'_>,
    ) {
        let m = look.m;
        let everywhere = [m.splat(f32::MIN), m.splat(f32::MAX)];
        let round = Round { heading, pure, from: 0, all: true, end: 0.0 };
        let [columns, rows] = tile.squares(BLOCK);
        let corner = |i: u32, j: u32| [tile.x[0] + i * BLOCK, tile.y[0] + j * BLOCK];
        // Each sphere is prepared once for the tile.
        self.numbers.resize(look.scene.spheres().len(), NOT_TAKEN);
        let mut owners = std::mem::take(&mut self.possible);
        owners.clear();
        for j in 0..rows {
            for i in 0..columns {
                for &id in known.block(corner(i, j)) {
                    if self.numbers[id as usize] == NOT_TAKEN {
                        self.numbers[id as usize] = NOT_AHEAD;
                        owners.push(id);
                    }
                }
            }
        }
        self.take(look, heading, [everywhere; 2], &owners);
        self.candidates.outlines.pad();
        for (number, &id) in (0..).zip(&self.candidates.ids) {
            self.numbers[id as usize] = number;
        }
        for j in 0..rows {
            for i in 0..columns {
                let (at, corner) = ((j * columns + i) as usize, corner(i, j));
                let owners = known.block(corner);
                if owners.is_empty() {
                    continue;
                }
                let Some((rays, wanted)) = self.rays(look, round, tile, corner, at) else { continue };
                let mut nearest = Nearest::none(m);
                for &id in owners {
                    let number = self.numbers[id as usize];
                    if number != NOT_AHEAD {
                        let ball = &self.candidates.balls[number as usize];
                        let ahead = m.le(m.splat(self.candidates.outlines.near[number as usize]), nearest.hi);
                        if let Some(found) = rays.find(m, ball, ahead) {
                            nearest = nearest.meet(m, &found, number.cast_signed());
                        }
                    }
                }
                self.close(m, at, corner, wanted, &nearest);
            }
            self.finish(look, tile, stripe);
        }
        for &id in &owners {
            self.numbers[id as usize] = NOT_TAKEN;
        }
        self.possible = owners;
    }

    /// Takes the spheres of a slice's cells that the tile may see.
    #[inline(always)]
    fn gather_slice(
        &mut self,
        look: &Look<'_, M>,
        heading: Heading,
        range: [[M::F; 2]; 2],
        slices: &Slices,
        slice: usize,
        stride: [usize; 3],
    ) {
        let start = heading.slice_index(slices.count, slice) * stride[0];
        let [first_k, last_k] = [slices.first[1][slice], slices.last[1][slice]];
        if last_k < first_k {
            return;
        }
        let [first_k, last_k] = [first_k.unsigned_abs() as usize, last_k.unsigned_abs() as usize];
        for j in slices.first[0][slice]..=slices.last[0][slice] {
            let row = start + j.unsigned_abs() as usize * stride[1];
            self.counts.cells += (last_k - first_k + 1) as u64;
            if stride[2] == 1 {
                self.take(look, heading, range, look.grid.row([row + first_k, row + last_k]));
            } else {
                for k in first_k..=last_k {
                    self.take(look, heading, range, look.grid.row([row + k * stride[2]; 2]));
                }
            }
        }
    }

    /// Shows the candidates of a round to the blocks that are open; how many of these are so still. Blocks are taken row by row over
    /// all patches, since the image is written so.
    #[inline(always)]
    fn round(&mut self, look: &Look<'_, M>, round: Round, tile: Rect, stripe: &mut Stripe<'_>) -> usize {
        let [columns, rows] = tile.squares(BLOCK);
        let [across, down] = tile.squares(BLOCK * PATCH);
        let mut few = std::mem::take(&mut self.few);
        few.resize_with(across as usize, Few::default);
        let mut open = 0;
        for j in 0..down {
            for (few, i) in few.iter_mut().zip(0..) {
                let range = self.patches.get(look.m, (j * across + i) as usize);
                few.take(look.m, &self.candidates, round.from, range);
            }
            for row in j * PATCH..((j + 1) * PATCH).min(rows) {
                for column in 0..columns {
                    let at = (row * columns + column) as usize;
                    if self.closed[at] {
                        continue;
                    }
                    let corner = [tile.x[0] + column * BLOCK, tile.y[0] + row * BLOCK];
                    let few = &few[(column / PATCH) as usize];
                    self.closed[at] = self.block(look, round, few, tile, corner, at);
                    open += usize::from(!self.closed[at]);
                }
                self.finish(look, tile, stripe);
            }
        }
        self.few = few;
        open
    }

    /// Meets the candidates of a round; whether the block is finished.
    #[inline(always)]
    fn block(
        &mut self,
        look: &Look<'_, M>,
        round: Round,
        few: &Few,
        tile: Rect,
        corner: [u32; 2],
        at: usize,
    ) -> bool {
        let m = look.m;
        let range = self.blocks.get(m, at);
        let count = few.index.len();
        let (mut chunk, mut bits) = (0, 0);
        while chunk < count {
            bits = few.outlines.overlapping(m, chunk, range);
            if bits != 0 {
                break;
            }
            chunk += LANES;
        }
        if bits == 0 && !self.touched[at] {
            return round.all;
        }
        let Some((rays, wanted)) = self.rays(look, round, tile, corner, at) else { return true };
        let mut nearest = if self.touched[at] { self.nearest[at] } else { Nearest::none(m) };
        'all: while chunk < count {
            while bits != 0 {
                let i = chunk + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let ahead = m.le(m.splat(few.outlines.near[i]), nearest.hi);
                // The nearest come first, so no later one is nearer.
                if !m.any(ahead, Site::Ahead) {
                    break 'all;
                }
                let ball = &self.candidates.balls[few.index[i] as usize];
                if let Some(found) = rays.find(m, ball, ahead) {
                    nearest = nearest.meet(m, &found, few.index[i].cast_signed());
                }
            }
            chunk += LANES;
            if chunk < count {
                bits = few.outlines.overlapping(m, chunk, range);
            }
        }
        let finished = round.all || {
            let along = m.mul(nearest.hi, m.splat(beyond(m.unit())));
            let reached = m.add(along, m.splat(look.grid.widen));
            !m.any(m.not(m.le(reached, m.splat(round.end))), Site::Unfinished)
        };
        if !finished {
            (self.nearest[at], self.touched[at]) = (nearest, true);
            return false;
        }
        self.close(m, at, corner, wanted, &nearest);
        true
    }

    /// A block's rays of the round's heading, and which lanes they are; in the other lanes one of them is repeated. `None` if there are none.
    #[inline(always)]
    fn rays(
        &self,
        look: &Look<'_, M>,
        round: Round,
        tile: Rect,
        corner: [u32; 2],
        at: usize,
    ) -> Option<(Rays<M>, u32)> {
        let (m, heading) = (look.m, round.heading);
        let mut along = heading.along_lanes(m, look.directions(tile, corner));
        let mut wanted = ALL;
        if !round.pure {
            let own = heading.has(m, along);
            wanted = m.to_bits(own) & !self.done[at];
            if wanted == 0 {
                return None;
            }
            let lane = wanted.trailing_zeros() as usize;
            along = three(
                along,
                #[inline(always)]
                |d| m.select(own, d, m.splat(m.to_array(d)[lane])),
            );
        }
        let [a, y, z] = along;
        Some((Rays::new(m, [m.div(y, a), m.div(z, a)]), wanted))
    }

    /// Puts a block among those that are finished.
    #[inline(always)]
    fn close(&mut self, m: M, at: usize, corner: [u32; 2], wanted: u32, nearest: &Nearest<M>) {
        self.done[at] |= wanted;
        let marked = m.to_bits(nearest.marked(m)) & wanted;
        self.finished.push(Finished { at, corner, wanted, marked, id: nearest.id });
    }

    /// Answers and colours of the blocks that are finished. Done for many at once, since it has hardly a branch, and the processor
    /// can do one block's work while it waits for another's.
    #[inline(always)]
    fn finish(&mut self, look: &Look<'_, M>, tile: Rect, stripe: &mut Stripe<'_>) {
        let m = look.m;
        let (candidates, spheres) = (&self.candidates, look.scene.spheres());
        for block in &self.finished {
            m.beside(
                Chore::Block(block.corner),
                #[inline(always)]
                || (),
            );
            if block.marked != 0 {
                candidates.overlapping(m, self.blocks.get(m, block.at), &mut self.possible);
            }
            let dir = look.directions(tile, block.corner);
            let dirs = three(
                dir,
                #[inline(always)]
                |d| m.to_array(d),
            );
            let question = Question { eye: look.camera.eye(), dir: dirs, spheres };
            let (wanted, marked) = (block.wanted, block.marked);
            let answers = question.settle(
                m,
                block.id,
                marked,
                #[inline(always)]
                |number| candidates.owner(number, spheres),
                &self.possible,
                wanted,
                &mut self.counts,
            );
            look.painter.write(m, dir, &answers, block.corner, wanted, stripe);
        }
        self.finished.clear();
    }
}

/// A block of which it is known which candidates its rays hit.
#[derive(Clone, Copy)]
struct Finished<M: Machine> {
    at: usize,
    corner: [u32; 2],
    /// Lanes that count.
    wanted: u32,
    /// Of these, those that are not certain.
    marked: u32,
    /// Numbers of candidates.
    id: M::I,
}

/// What a tile's blocks are shown.
#[derive(Clone, Copy)]
struct Round {
    heading: Heading,
    pure: bool,
    /// The first candidate that is new.
    from: usize,
    /// No others will come;
    all: bool,
    /// or none that is nearer along the major axis, but for the grid's widening.
    end: f32,
}

impl<M: Machine> Look<'_, M> {
    /// Directions through the pixels at the corners of a rectangle, as the contract gives them.
    fn corners(&self, rect: Rect) -> [[f32; 3]; 4] {
        let [corner, du, dv] = [self.camera.corner(), self.camera.du(), self.camera.dv()];
        let middle = |[from, to]: [u32; 2]| [from as f32 + 0.5, to as f32 - 0.5];
        let (x, y) = (middle(rect.x), middle(rect.y));
        let through = |x: f32, y: f32| [0, 1, 2].map(|i| (corner[i] + x * du[i]) + y * dv[i]);
        [through(x[0], y[0]), through(x[1], y[0]), through(x[0], y[1]), through(x[1], y[1])]
    }

    /// Directions of a block's rays; pixels beyond the tile repeat its last column or row.
    #[inline(always)]
    fn directions(&self, tile: Rect, [x, y]: [u32; 2]) -> [M::F; 3] {
        let m = self.m;
        const X: [f32; LANES] =
            [0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5];
        const Y: [f32; LANES] =
            [0.5, 0.5, 0.5, 0.5, 1.5, 1.5, 1.5, 1.5, 2.5, 2.5, 2.5, 2.5, 3.5, 3.5, 3.5, 3.5];
        let xs = m.min(m.add(m.splat(x as f32), m.lanes(X)), m.splat(tile.x[1] as f32 - 0.5));
        let ys = m.min(m.add(m.splat(y as f32), m.lanes(Y)), m.splat(tile.y[1] as f32 - 0.5));
        self.lanes.directions(m, xs, ys)
    }

    /// The range of slopes that outlines are held against: without culling all numbers, but not infinity, at which that begins and ends
    /// which is not to be seen.
    #[inline(always)]
    fn seen_from(&self, range: [[M::F; 2]; 2]) -> [[M::F; 2]; 2] {
        match self.plan.culling {
            Culling::None => [[self.m.splat(f32::MIN), self.m.splat(f32::MAX)]; 2],
            Culling::Planes => range,
        }
    }

    /// The ranges of slopes of all squares of a side in a tile.
    #[inline(always)]
    fn ranges(&self, heading: Heading, tile: Rect, side: u32, ranges: &mut Ranges) {
        let m = self.m;
        let [columns, rows] = tile.squares(side);
        let squares = (columns * rows) as usize;
        for range in ranges.0.iter_mut().flatten() {
            if range.len() < squares + LANES {
                range.resize(squares + LANES, 0.0);
            }
        }
        const NUMBERS: [f32; LANES] =
            [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];
        let size = side as f32;
        let [last_x, last_y] = [tile.x[1] as f32 - 0.5, tile.y[1] as f32 - 0.5];
        for row in 0..rows {
            let y = (tile.y[0] + row * side) as f32 + 0.5;
            let ys = [m.splat(y), m.splat((y + (size - 1.0)).min(last_y))];
            for column in (0..columns).step_by(LANES) {
                let first = m.splat((tile.x[0] + column * side) as f32 + 0.5);
                let x = m.add(first, m.mul(m.lanes(NUMBERS), m.splat(size)));
                let xs = [m.min(x, m.splat(last_x)), m.min(m.add(x, m.splat(size - 1.0)), m.splat(last_x))];
                let through = [
                    self.lanes.directions(m, xs[0], ys[0]),
                    self.lanes.directions(m, xs[1], ys[0]),
                    self.lanes.directions(m, xs[0], ys[1]),
                    self.lanes.directions(m, xs[1], ys[1]),
                ];
                let corners = [
                    heading.along_lanes(m, through[0]),
                    heading.along_lanes(m, through[1]),
                    heading.along_lanes(m, through[2]),
                    heading.along_lanes(m, through[3]),
                ];
                let [[lo_y, hi_y], [lo_z, hi_z]] = self.seen_from(range(m, self.slack, corners));
                let at = (row * columns + column) as usize;
                let [[out_lo_y, out_hi_y], [out_lo_z, out_hi_z]] = &mut ranges.0;
                out_lo_y[at..at + LANES].copy_from_slice(&m.to_array(lo_y));
                out_hi_y[at..at + LANES].copy_from_slice(&m.to_array(hi_y));
                out_lo_z[at..at + LANES].copy_from_slice(&m.to_array(lo_z));
                out_hi_z[at..at + LANES].copy_from_slice(&m.to_array(hi_z));
            }
        }
    }
}

/// More than the rounding of any direction of a camera, in any component: 8u of the largest |corner| + W|du| + H|dv|.
#[inline(always)]
#[must_use]
pub fn slack(unit: f32, camera: &Camera) -> f32 {
    let [w, h] = [camera.size().width() as f32, camera.size().height() as f32];
    let mut slack = 0.0f32;
    for i in 0..3 {
        let [c, u, v] = [camera.corner()[i].abs(), camera.du()[i].abs(), camera.dv()[i].abs()];
        slack = slack.max(c + w * u + h * v);
    }
    slack * (8.0 * unit)
}

/// How many of a rectangle's rays have a heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    /// None has, for certain.
    None,
    /// Some may have.
    Some,
    /// All have, for certain.
    All,
}

/// How many have a heading, by their directions (A, Y, Z) at its corners. Where all corners are steeper to the same side, so are the rays
/// between them, but for twice the `slack` of a direction.
#[inline(always)]
#[must_use]
pub fn share(slack: f32, corners: &[[f32; 3]; 4]) -> Share {
    let slack = 2.0 * slack;
    let (mut all, mut any) = (true, [false; 4]);
    for &[a, y, z] in corners {
        for (any, excess) in any.iter_mut().zip([a - y, a + y, a - z, a + z]) {
            all &= excess > slack;
            *any |= excess >= -slack;
        }
    }
    if all {
        Share::All
    } else if any == [true; 4] {
        Share::Some
    } else {
        Share::None
    }
}

/// Kernel: the range of slopes of rays between directions along (A, Y, Z), sixteen such rectangles at a time; `slack` is more than the
/// rounding of any direction ([`slack`]).
#[inline(always)]
pub fn range<M: Machine>(m: M, slack: f32, corners: [[M::F; 3]; 4]) -> [[M::F; 2]; 2] {
    let slack = m.splat(slack);
    let mut least = corners[0][0];
    let mut slopes = [[m.splat(f32::INFINITY), m.splat(f32::NEG_INFINITY)]; 2];
    for [a, y, z] in corners {
        least = m.min(least, a);
        for (slope, d) in slopes.iter_mut().zip([y, z]) {
            let s = m.div(d, a);
            *slope = [m.min(slope[0], s), m.max(slope[1], s)];
        }
    }
    // Directions are off by `slack`, and slopes for that by twice (1 + |slope|) slack / a, and their own rounding.
    let off = m.add(m.div(m.mul(slack, m.splat(4.0)), least), m.splat(16.0 * m.unit()));
    let far = m.le(least, m.mul(slack, m.splat(1024.0)));
    let (one, minus) = (m.splat(1.0), m.splat(-1.0));
    let mut out = slopes;
    for [lo, hi] in &mut out {
        let size = m.add(one, m.max(m.max(*hi, m.neg(*hi)), m.max(*lo, m.neg(*lo))));
        let pad = m.mul(off, size);
        *lo = m.select(far, minus, m.max(m.sub(*lo, pad), minus));
        *hi = m.select(far, one, m.min(m.add(*hi, pad), one));
    }
    out
}

impl<M: Machine> Work<M> {
    /// Takes of spheres those that the tile may see.
    #[inline(always)]
    fn take(&mut self, look: &Look<'_, M>, heading: Heading, range: [[M::F; 2]; 2], ids: &[u32]) {
        self.counts.candidates += ids.len() as u64;
        for ids in ids.chunks(LANES) {
            let mut world = [[0.0; LANES]; 4];
            for (lane, &id) in ids.iter().enumerate() {
                let Sphere { center: [x, y, z], radius, .. } = look.scene.spheres()[id as usize];
                (world[0][lane], world[1][lane], world[2][lane], world[3][lane]) = (x, y, z, radius);
            }
            self.consider(look, heading, range, ids, &world);
        }
    }

    /// Takes of up to sixteen spheres, whose centres and radii are given, those that the tile may see.
    #[inline(always)]
    fn consider(
        &mut self,
        look: &Look<'_, M>,
        heading: Heading,
        range: [[M::F; 2]; 2],
        ids: &[u32],
        [x, y, z, r]: &[[f32; LANES]; 4],
    ) {
        let (m, eye, n) = (look.m, look.camera.eye(), ids.len());
        let world = [m.lanes(*x), m.lanes(*y), m.lanes(*z)];
        let radius = m.lanes(*r);
        let c = three(
            [0, 1, 2],
            #[inline(always)]
            |i| m.sub(world[i], m.splat(eye[i])),
        );
        let c = heading.along_lanes(m, c);
        let magnitude = three(
            c,
            #[inline(always)]
            |x| m.max(x, m.neg(x)),
        );
        let enlarged = cull::radii(m, magnitude, radius);
        let outline = Outline::new(m, c, enlarged);
        let mut kept = m.to_bits(outline.overlap(m, range)) & ((1 << n) - 1);
        if kept != 0 {
            let farthest = m.max(m.max(magnitude[0], magnitude[1]), magnitude[2]);
            let rr = m.mul(radius, radius);
            let [above, below, root] = look.rule.bounds(m, farthest, radius);
            let ff = m.dot(c, c);
            let [outside, inside] = sides(m, ff, rr);
            let [outside, inside] = [m.to_bits(outside), m.to_bits(inside)];
            let fields = [
                c[0],
                c[1],
                c[2],
                rr,
                above,
                below,
                root,
                outline.near,
                outline.lo[0],
                outline.lo[1],
                outline.hi[0],
                outline.hi[1],
                short_error::<f64, _>(m, magnitude, radius),
            ];
            let mut rows = [[0.0; LANES]; 13];
            for (row, field) in rows.iter_mut().zip(fields) {
                *row = m.to_array(field);
            }
            while kept != 0 {
                let lane = kept.trailing_zeros() as usize;
                kept &= kept - 1;
                let get = |i: usize| rows[i][lane];
                let side = if outside >> lane & 1 != 0 {
                    Side::Outside
                } else if inside >> lane & 1 != 0 {
                    Side::Inside
                } else {
                    Side::Unknown
                };
                let list = &mut self.candidates;
                list.balls.push(Ball {
                    center: [get(0), get(1), get(2)],
                    rr: get(3),
                    bound: bound::Bound { hit_above: get(4), miss_below: get(5), root: get(6) },
                    side,
                });
                list.ids.push(ids[lane]);
                list.errors.push(get(12));
                list.outlines.push([get(8), get(9)], [get(10), get(11)], get(7));
            }
        }
    }
}

#[inline(always)]
fn sixteen(values: &[f32], at: usize) -> [f32; LANES] {
    let mut lanes = [0.0; LANES];
    lanes.copy_from_slice(&values[at..at + LANES]);
    lanes
}

impl Ranges {
    /// One of them, in all lanes.
    #[inline(always)]
    fn get<M: Machine>(&self, m: M, at: usize) -> [[M::F; 2]; 2] {
        let [[lo_y, hi_y], [lo_z, hi_z]] = &self.0;
        [[m.splat(lo_y[at]), m.splat(hi_y[at])], [m.splat(lo_z[at]), m.splat(hi_z[at])]]
    }
}

impl Outlines {
    #[inline(always)]
    fn push(&mut self, lo: [f32; 2], hi: [f32; 2], near: f32) {
        let ([lo_y, lo_z], [hi_y, hi_z]) = (&mut self.lo, &mut self.hi);
        lo_y.push(lo[0]);
        lo_z.push(lo[1]);
        hi_y.push(hi[0]);
        hi_z.push(hi[1]);
        self.near.push(near);
    }

    fn truncate(&mut self, count: usize) {
        for list in self.lo.iter_mut().chain(&mut self.hi).chain([&mut self.near]) {
            list.truncate(count);
        }
    }

    /// Fills the last sixteen up with what nothing overlaps.
    #[inline(always)]
    fn pad(&mut self) {
        let count = self.near.len().next_multiple_of(LANES);
        let ([lo_y, lo_z], [hi_y, hi_z]) = (&mut self.lo, &mut self.hi);
        lo_y.resize(count, f32::INFINITY);
        lo_z.resize(count, f32::INFINITY);
        hi_y.resize(count, f32::NEG_INFINITY);
        hi_z.resize(count, f32::NEG_INFINITY);
        self.near.resize(count, f32::INFINITY);
    }

    /// Which of the sixteen from there on overlap a range.
    #[inline(always)]
    fn overlapping<M: Machine>(&self, m: M, at: usize, range: [[M::F; 2]; 2]) -> u32 {
        let lo = [m.lanes(sixteen(&self.lo[0], at)), m.lanes(sixteen(&self.lo[1], at))];
        let hi = [m.lanes(sixteen(&self.hi[0], at)), m.lanes(sixteen(&self.hi[1], at))];
        m.to_bits(overlap(m, lo, hi, range))
    }
}

impl Candidates {
    fn clear(&mut self) {
        self.balls.clear();
        self.ids.clear();
        self.errors.clear();
        self.outlines.truncate(0);
    }

    /// A candidate by its number.
    #[inline(always)]
    fn owner<'a>(&self, number: i32, spheres: &'a [Sphere]) -> Owner<'a> {
        let number = number.unsigned_abs() as usize;
        let id = self.ids[number];
        Owner { id: id.cast_signed(), sphere: &spheres[id as usize], error: self.errors[number] }
    }

    /// Takes back what pads the outlines.
    fn trim(&mut self) {
        self.outlines.truncate(self.ids.len());
    }

    /// The ids of all that overlap a range.
    #[inline(always)]
    fn overlapping<M: Machine>(&self, m: M, range: [[M::F; 2]; 2], ids: &mut Vec<u32>) {
        ids.clear();
        for chunk in (0..self.ids.len()).step_by(LANES) {
            let mut bits = self.outlines.overlapping(m, chunk, range);
            while bits != 0 {
                ids.push(self.ids[chunk + bits.trailing_zeros() as usize]);
                bits &= bits - 1;
            }
        }
    }
}

impl Few {
    fn clear(&mut self) {
        self.order.clear();
        self.index.clear();
        self.outlines.truncate(0);
    }

    /// Takes a candidate.
    #[inline(always)]
    fn push(&mut self, near: f32, number: u32) {
        // As whole numbers floats have their own order, once the negative ones are turned round.
        let bits = near.to_bits().cast_signed();
        self.order.push((bits ^ ((bits >> 31) & i32::MAX), number));
    }

    /// Ends it: the nearest come first.
    #[inline(always)]
    fn close(&mut self, o: &Outlines) {
        self.order.sort_unstable();
        for &(_, number) in &self.order {
            let i = number as usize;
            self.index.push(number);
            self.outlines.push([o.lo[0][i], o.lo[1][i]], [o.hi[0][i], o.hi[1][i]], o.near[i]);
        }
        self.outlines.pad();
    }

    /// Those of the candidates from there on that overlap a range.
    #[inline(always)]
    fn take<M: Machine>(&mut self, m: M, all: &Candidates, from: usize, range: [[M::F; 2]; 2]) {
        self.clear();
        for chunk in (from / LANES * LANES..all.ids.len()).step_by(LANES) {
            let mut bits = all.outlines.overlapping(m, chunk, range);
            if chunk < from {
                bits &= ALL << (from - chunk);
            }
            while bits != 0 {
                let i = chunk + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                self.push(all.outlines.near[i], u32::try_from(i).expect("as many as ids"));
            }
        }
        self.close(&all.outlines);
    }
}
