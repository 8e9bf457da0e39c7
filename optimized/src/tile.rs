#![allow(missing_docs)]
//! A tile of blocks: its candidates are gathered once by a walk through the grid with the tile's frustum, and held by their outlines
//! against each of its blocks.

use crate::bound::{self, Rule};
use crate::camera::{BLOCK, CameraLanes, spread};
use crate::certain::{Ball, Nearest, Rays, Side};
use crate::cull;
use crate::frustum::{BEYOND, Frustum, Heading};
use crate::grid::Grid;
use crate::machine::{LANES, Machine, Site, three};
use crate::plan::Plan;
use crate::seen::Counts;
use crate::settle::{ALL, Question};
use crate::silhouette::{Outline, overlap};
use crate::stripe::{Painter, Stripe};
use contract::{Camera, Scene};

/// Candidates after which a tile's blocks are looked at before its walk goes on.
const ROUND: usize = 128;

/// Pixels.
#[derive(Clone, Copy, Debug)]
pub struct Rect {
    pub x: [u32; 2],
    pub y: [u32; 2],
}

/// The spheres a tile may see.
#[derive(Clone, Debug, Default)]
struct Candidates {
    balls: Vec<Ball>,
    ids: Vec<u32>,
    lo: [Vec<f32>; 2],
    hi: [Vec<f32>; 2],
    near: Vec<f32>,
    /// Of each sixteen, the nearest of these and all later ones of the same round.
    nearest: Vec<f32>,
}

/// What is kept of a block between rounds.
#[derive(Clone, Copy)]
struct State<M: Machine> {
    nearest: Nearest<M>,
    touched: bool,
}

/// A worker's tiles.
pub struct Tiles<'a, M: Machine> {
    pub m: M,
    pub plan: Plan,
    pub scene: &'a Scene,
    pub camera: &'a Camera,
    pub grid: &'a Grid,
    pub counts: Counts,
    lanes: CameraLanes<M>,
    painter: Painter<'a, M>,
    rule: Rule,
    /// More than the rounding of any direction, in any component.
    slack: f32,
    candidates: Candidates,
    range: [[Vec<f32>; 2]; 2],
    states: Vec<State<M>>,
    open: Vec<u32>,
    done: Vec<u32>,
    possible: Vec<u32>,
}

impl<'a, M: Machine> Tiles<'a, M> {
    pub fn new(m: M, plan: Plan, scene: &'a Scene, camera: &'a Camera, grid: &'a Grid) -> Self {
        let [w, h] = [camera.size().width() as f32, camera.size().height() as f32];
        let mut slack = 0.0f32;
        for i in 0..3 {
            let [c, u, v] = [camera.corner()[i].abs(), camera.du()[i].abs(), camera.dv()[i].abs()];
            slack = slack.max(c + w * u + h * v);
        }
        Self {
            m,
            plan,
            scene,
            camera,
            grid,
            counts: Counts::default(),
            lanes: CameraLanes::new(m, camera),
            painter: Painter::new(m, scene, camera),
            rule: Rule::new(bound::NEAREST),
            slack: slack * (8.0 / (1u32 << 24) as f32),
            candidates: Candidates::default(),
            range: Default::default(),
            states: Vec::new(),
            open: Vec::new(),
            done: Vec::new(),
            possible: Vec::new(),
        }
    }

    /// Direction through a point of the picture, as the contract gives it.
    fn direction(&self, x: f32, y: f32) -> [f32; 3] {
        let [corner, du, dv] = [self.camera.corner(), self.camera.du(), self.camera.dv()];
        [0, 1, 2].map(|i| (corner[i] + x * du[i]) + y * dv[i])
    }

    /// Traces a tile.
    #[inline(always)]
    pub fn trace(&mut self, rect: Rect, stripe: &mut Stripe<'_>) {
        let corners = {
            let x = rect.x.map(|x| x as f32);
            let y = rect.y.map(|y| y as f32);
            let [x, y] = [[x[0] + 0.5, x[1] - 0.5], [y[0] + 0.5, y[1] - 0.5]];
            [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| self.direction(x[i], y[j]))
        };
        let columns = (rect.x[1] - rect.x[0]).div_ceil(BLOCK);
        let rows = (rect.y[1] - rect.y[0]).div_ceil(BLOCK);
        let blocks = (columns * rows) as usize;
        self.done.clear();
        self.done.resize(blocks, 0);
        {
            for heading in Heading::all() {
                let along = corners.map(|d| heading.along(d));
                let slack = 2.0 * self.slack;
                let excess = along.map(|[a, y, z]| [a - y, a + y, a - z, a + z]);
                // Where even the tile's corners are steeper all to the same side, so are the rays between them.
                if (0..4).any(|i| excess.iter().all(|e| e[i] < -slack)) {
                    continue;
                }
                let pure = excess.iter().all(|e| e.iter().all(|&e| e > slack));
                self.pass(heading, &along, rect, [columns, rows], pure, stripe);
                if pure {
                    return;
                }
            }
        }
        for block in 0..blocks as u32 {
            let (x, y) = (rect.x[0] + block % columns * BLOCK, rect.y[0] + block / columns * BLOCK);
            let left = ALL & !self.done[block as usize];
            if left != 0 {
                self.painter.miss([x, y], left, stripe);
            }
        }
    }

    /// The range of slopes of rays between directions along (A, Y, Z), sixteen such rectangles at a time.
    #[inline(always)]
    fn range(&self, m: M, corners: [[M::F; 3]; 4]) -> [[M::F; 2]; 2] {
        let slack = m.splat(self.slack);
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
        let off = m.add(m.div(m.mul(slack, m.splat(4.0)), least), m.splat(1.0 / (1u32 << 20) as f32));
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

    #[inline(always)]
    fn pass(
        &mut self,
        heading: Heading,
        corners: &[[f32; 3]; 4],
        rect: Rect,
        [columns, rows]: [u32; 2],
        pure: bool,
        stripe: &mut Stripe<'_>,
    ) {
        let m = self.m;
        let [p, q, r, s] = *corners;
        let corners = [spread(m, p), spread(m, q), spread(m, r), spread(m, s)];
        let range = self.range(m, corners);
        let cone = Frustum { heading, slopes: range };
        let blocks = (columns * rows) as usize;
        self.ranges(heading, rect, [columns, rows]);
        self.candidates.clear();
        let grid = self.grid;
        let slices = cone.slices(m, self.camera.eye(), grid, self.plan.margins);
        self.states.clear();
        self.states.resize(blocks, State { nearest: Nearest::none(m), touched: false });
        self.open.clear();
        self.open.extend(0..blocks as u32);
        let strides = grid.strides();
        let stride = heading.order.map(|i| strides[i]);
        let mut slice = 0;
        loop {
            let from = self.candidates.ids.len();
            while slice < slices.count && self.candidates.ids.len() < from + ROUND {
                let i = if heading.forward { slice } else { slices.count - 1 - slice } * stride[0];
                let (first, last) = ([slices.first[0][slice], slices.first[1][slice]], [slices.last[0][slice], slices.last[1][slice]]);
                for j in first[0]..=last[0] {
                    let row = i + j.unsigned_abs() as usize * stride[1];
                    if stride[2] == 1 {
                        if first[1] <= last[1] {
                            let cells = [row + first[1].unsigned_abs() as usize, row + last[1].unsigned_abs() as usize];
                            self.counts.cells += (cells[1] - cells[0] + 1) as u64;
                            self.gather(heading, range, cells);
                        }
                    } else {
                        for k in first[1]..=last[1] {
                            let cell = row + k.unsigned_abs() as usize * stride[2];
                            self.counts.cells += 1;
                            self.gather(heading, range, [cell, cell]);
                        }
                    }
                }
                slice += 1;
            }
            self.candidates.close(from);
            let all = slice >= slices.count;
            let reached_slice = slice.saturating_sub(1);
            let end = slices.far.get(reached_slice).copied().unwrap_or(0.0);
            let mut open = std::mem::take(&mut self.open);
            let mut left = 0;
            for i in 0..open.len() {
                let block = open[i];
                if !self.block(heading, rect, columns, block, pure, from, all, end, stripe) {
                    open[left] = block;
                    left += 1;
                }
            }
            open.truncate(left);
            self.open = open;
            if all || self.open.is_empty() {
                break;
            }
        }
    }

    /// The ranges of slopes of all blocks.
    #[inline(always)]
    fn ranges(&mut self, heading: Heading, rect: Rect, [columns, rows]: [u32; 2]) {
        let m = self.m;
        let blocks = (columns * rows) as usize;
        for range in self.range.iter_mut().flatten() {
            range.resize(blocks.next_multiple_of(LANES) + LANES, 0.0);
        }
        let step = m.lanes([0.0, 4.0, 8.0, 12.0, 16.0, 20.0, 24.0, 28.0, 32.0, 36.0, 40.0, 44.0, 48.0, 52.0, 56.0, 60.0]);
        for row in 0..rows {
            let y = rect.y[0] + row * BLOCK;
            let ys = [y as f32 + 0.5, (y + BLOCK).min(rect.y[1]) as f32 - 0.5];
            for column in (0..columns).step_by(LANES) {
                let x = m.add(m.splat((rect.x[0] + column * BLOCK) as f32), step);
                let last = m.splat(rect.x[1] as f32 - 0.5);
                let xs = [m.add(x, m.splat(0.5)), m.min(m.add(x, m.splat(3.5)), last)];
                let mut corners = [[m.splat(0.0); 3]; 4];
                for (corner, [i, j]) in corners.iter_mut().zip([[0, 0], [1, 0], [0, 1], [1, 1]]) {
                    let dir = self.lanes.directions(m, xs[i], m.splat(ys[j]));
                    *corner = heading.along_lanes(m, dir);
                }
                let range = self.range(m, corners);
                let at = (row * columns + column) as usize;
                for (kept, range) in self.range.iter_mut().zip(range) {
                    kept[0][at..at + LANES].copy_from_slice(&m.to_array(range[0]));
                    kept[1][at..at + LANES].copy_from_slice(&m.to_array(range[1]));
                }
            }
        }
    }

    /// Takes the spheres of neighbouring cells that the tile may see.
    #[inline(always)]
    fn gather(&mut self, heading: Heading, range: [[M::F; 2]; 2], cells: [usize; 2]) {
        let m = self.m;
        let eye = self.camera.eye();
        let (ids, spheres) = self.grid.row(cells);
        self.counts.candidates += ids.len() as u64;
        let mut start = 0;
        while start < ids.len() {
            let n = (ids.len() - start).min(LANES);
            let [x, y, z, r] = spheres;
            let world = [m.lanes(sixteen(x, start)), m.lanes(sixteen(y, start)), m.lanes(sixteen(z, start))];
            let radius = m.lanes(sixteen(r, start));
            let sense = m.splat(if heading.forward { 1.0 } else { -1.0 });
            let mut c = three(
                heading.order,
                #[inline(always)]
                |i| m.sub(world[i], m.splat(eye[i])),
            );
            c[0] = m.mul(sense, c[0]);
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
                let [above, below, root] = self.rule.bounds(m, farthest, radius);
                let ff = m.dot(c, c);
                let slack = m.mul(m.add(ff, rr), m.splat(1.0 / (1u32 << 20) as f32));
                let outside = m.to_bits(m.lt(m.add(rr, slack), ff));
                let inside = m.to_bits(m.lt(m.add(ff, slack), rr));
                let fields = [c[0], c[1], c[2], rr, above, below, root, outline.near, outline.lo[0], outline.lo[1], outline.hi[0], outline.hi[1]];
                let mut rows = [[0.0; LANES]; 12];
                for (row, field) in rows.iter_mut().zip(fields) {
                    *row = m.to_array(field);
                }
                while kept != 0 {
                    let lane = kept.trailing_zeros() as usize;
                    kept &= kept - 1;
                    let get = |i: usize| rows[i][lane];
                    let side = if outside >> lane & 1 != 0 { Side::Outside } else if inside >> lane & 1 != 0 { Side::Inside } else { Side::Unknown };
                    let list = &mut self.candidates;
                    list.balls.push(Ball {
                        center: [get(0), get(1), get(2)],
                        rr: get(3),
                        bound: bound::Bound { hit_above: get(4), miss_below: get(5), root: get(6) },
                        side,
                    });
                    list.ids.push(ids[start + lane]);
                    list.near.push(get(7));
                    list.lo[0].push(get(8));
                    list.lo[1].push(get(9));
                    list.hi[0].push(get(10));
                    list.hi[1].push(get(11));
                }
            }
            start += LANES;
        }
    }

    /// Which of the sixteen candidates from there on overlap a block.
    #[inline(always)]
    fn overlapping(&self, at: usize, range: [[M::F; 2]; 2]) -> u32 {
        let m = self.m;
        let c = &self.candidates;
        let lo = [m.lanes(sixteen(&c.lo[0], at)), m.lanes(sixteen(&c.lo[1], at))];
        let hi = [m.lanes(sixteen(&c.hi[0], at)), m.lanes(sixteen(&c.hi[1], at))];
        m.to_bits(overlap(m, lo, hi, range))
    }

    /// Meets the candidates of a round; whether the block is finished.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn block(
        &mut self,
        heading: Heading,
        rect: Rect,
        columns: u32,
        block: u32,
        pure: bool,
        from: usize,
        all: bool,
        end: f32,
        stripe: &mut Stripe<'_>,
    ) -> bool {
        let m = self.m;
        let at = block as usize;
        let [[lo_y, hi_y], [lo_z, hi_z]] = &self.range;
        let range = [[m.splat(lo_y[at]), m.splat(hi_y[at])], [m.splat(lo_z[at]), m.splat(hi_z[at])]];
        let mut state = self.states[at];
        let count = self.candidates.ids.len();
        let mut chunk = from;
        let mut bits = 0;
        while chunk < count {
            bits = self.overlapping(chunk, range);
            if bits != 0 {
                break;
            }
            chunk += LANES;
        }
        let (x, y) = (rect.x[0] + block % columns * BLOCK, rect.y[0] + block / columns * BLOCK);
        if bits == 0 && !state.touched {
            if all && pure {
                self.painter.miss([x, y], ALL, stripe);
            }
            return all;
        }
        let xs = m.add(m.splat(x as f32), m.lanes([0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5]));
        let ys = m.add(m.splat(y as f32), m.lanes([0.5, 0.5, 0.5, 0.5, 1.5, 1.5, 1.5, 1.5, 2.5, 2.5, 2.5, 2.5, 3.5, 3.5, 3.5, 3.5]));
        let xs = m.min(xs, m.splat(rect.x[1] as f32 - 0.5));
        let ys = m.min(ys, m.splat(rect.y[1] as f32 - 0.5));
        let mut dir = self.lanes.directions(m, xs, ys);
        let mut wanted = ALL;
        if !pure {
            let own = heading.has(m, heading.along_lanes(m, dir));
            wanted = m.to_bits(own) & !self.done[at];
            if wanted == 0 {
                return true;
            }
            let lane = wanted.trailing_zeros() as usize;
            dir = three(
                dir,
                #[inline(always)]
                |d| m.select(own, d, m.splat(m.to_array(d)[lane])),
            );
        }
        let [a, sy, sz] = heading.along_lanes(m, dir);
        let rays = Rays::new(m, [m.div(sy, a), m.div(sz, a)]);
        state.touched = true;
        let mut nearest = state.nearest;
        while chunk < count {
            if bits != 0 {
                let near = m.splat(self.candidates.nearest[chunk / LANES]);
                if !m.any(m.le(near, nearest.hi), Site::Unfinished) {
                    break;
                }
            }
            while bits != 0 {
                let i = chunk + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                let ball = &self.candidates.balls[i];
                let ahead = m.le(m.splat(self.candidates.near[i]), nearest.hi);
                if let Some(found) = rays.find(m, ball, ahead) {
                    nearest = nearest.meet(m, &found, self.candidates.ids[i].cast_signed());
                }
            }
            chunk += LANES;
            if chunk < count {
                bits = self.overlapping(chunk, range);
            }
        }
        let finished = all || {
            let widen = self.grid.widen * BEYOND;
            let reached = m.add(m.mul(nearest.hi, m.splat(BEYOND)), m.splat(widen));
            !m.any(m.not(m.le(reached, m.splat(end))), Site::Unfinished)
        };
        if !finished {
            self.states[at] = State { nearest, touched: true };
            return false;
        }
        let marked = m.to_bits(nearest.marked(m)) & wanted;
        if marked != 0 {
            self.possible.clear();
            for chunk in (0..count).step_by(LANES) {
                let mut bits = self.overlapping(chunk, range);
                while bits != 0 {
                    self.possible.push(self.candidates.ids[chunk + bits.trailing_zeros() as usize]);
                    bits &= bits - 1;
                }
            }
        }
        self.done[at] |= wanted;
        let dirs = three(
            dir,
            #[inline(always)]
            |d| m.to_array(d),
        );
        let question = Question { eye: self.camera.eye(), dir: dirs, spheres: self.scene.spheres() };
        let answers = question.settle(m, &nearest, &self.possible, wanted, &mut self.counts);
        self.painter.write(m, dir, &answers, [x, y], wanted, stripe);
        true
    }
}

#[inline(always)]
fn sixteen(values: &[f32], at: usize) -> [f32; LANES] {
    let mut lanes = [0.0; LANES];
    lanes.copy_from_slice(&values[at..at + LANES]);
    lanes
}

impl Candidates {
    fn clear(&mut self) {
        self.balls.clear();
        self.ids.clear();
        self.near.clear();
        self.nearest.clear();
        for list in self.lo.iter_mut().chain(&mut self.hi) {
            list.clear();
        }
    }

    /// Ends a round: fills the last sixteen up with what no block overlaps.
    fn close(&mut self, from: usize) {
        while !self.ids.len().is_multiple_of(LANES) {
            self.balls.push(Ball::default());
            self.ids.push(0);
            self.near.push(f32::INFINITY);
            for list in &mut self.lo {
                list.push(f32::INFINITY);
            }
            for list in &mut self.hi {
                list.push(f32::NEG_INFINITY);
            }
        }
        self.nearest.resize(self.ids.len() / LANES, f32::INFINITY);
        let mut least = f32::INFINITY;
        for chunk in (from / LANES..self.nearest.len()).rev() {
            for &near in &self.near[chunk * LANES..(chunk + 1) * LANES] {
                least = least.min(near);
            }
            self.nearest[chunk] = least;
        }
    }
}
