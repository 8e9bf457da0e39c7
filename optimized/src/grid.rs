//! The uniform grid, built anew for every frame: which spheres may be hit in which cell.
//!
//! A cell index is always found by one map, [`Axis::cell`]: floor((x − origin) · inverse cell size), clamped. Each
//! rounding in it is monotone, so the map is monotone over all f32. Hence an axis has exact *planes*:
//! `planes[i]` is the least f32 in cell i or above, found by binary search over bit patterns. A real number x
//! is said to lie in cell i if planes[i] <= x < planes[i + 1]; for f32 that agrees with the map, and it makes
//! statements about real points exact, though the map rounds.
//!
//! The voxelizer lists a sphere in all cells that its box overlaps. The box is the centre minus and plus the
//! reach of [`crate::margin`], rounded outward; a real point P of the ball has lo <= P <= hi on each
//! axis, so by monotony its cell lies between those of lo and hi, and lists the sphere.

use crate::machine::{LANES, Machine};

/// The most cells on an axis.
pub const MAX_CELLS: i32 = 64;
/// Cells a sphere should have for itself: λ of n = d ∛(λ N / V) (Wald et al. 2006 use 3 to 5).
const DENSITY: f64 = 4.0;

/// One axis of the grid.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Cells.
    pub n: i32,
    origin: f32,
    inverse: f32,
    /// n + 1 numbers: the least f32 of each cell, then the upper end of the grid.
    pub planes: Vec<f32>,
}

/// A box around what a sphere may be hit in, rounded outward.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Lower corner.
    pub lo: [f32; 3],
    /// Upper corner.
    pub hi: [f32; 3],
}

/// Cells with the ids of their spheres, ascending, as one list with offsets (Lagae and Dutré 2008).
#[derive(Clone, Debug)]
pub struct Grid {
    /// The three axes.
    pub axes: [Axis; 3],
    offsets: Vec<u32>,
    ids: Vec<u32>,
}

impl Bounds {
    /// The box of a ball.
    #[must_use]
    pub fn of_ball(center: [f32; 3], radius: f32) -> Self {
        Self { lo: center.map(|c| (c - radius).next_down()), hi: center.map(|c| (c + radius).next_up()) }
    }

    fn join(self, other: &Self) -> Self {
        Self {
            lo: [0, 1, 2].map(|i| self.lo[i].min(other.lo[i])),
            hi: [0, 1, 2].map(|i| self.hi[i].max(other.hi[i])),
        }
    }
}

impl Axis {
    /// Divides lo..hi into n cells.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "n is small")]
    pub fn new<M: Machine>(m: M, lo: f32, hi: f32, n: i32) -> Self {
        let mut axis = Self { n, origin: lo, inverse: n as f32 / (hi - lo), planes: vec![lo] };
        while axis.planes.len() < n.unsigned_abs() as usize {
            axis.find_planes(m, lo, hi);
        }
        axis.planes.truncate(n.unsigned_abs() as usize);
        axis.planes.push(hi);
        axis
    }

    /// Kernel: the cells of sixteen coordinates.
    #[inline(always)]
    pub fn cell<M: Machine>(&self, m: M, x: M::F) -> M::I {
        let scaled = m.mul(m.sub(x, m.splat(self.origin)), m.splat(self.inverse));
        let (cell, first, last) = (m.floor(scaled), m.splat_i(0), m.splat_i(self.n - 1));
        let cell = m.select_i(m.lt_i(cell, first), first, cell);
        m.select_i(m.lt_i(last, cell), last, cell)
    }

    /// The next sixteen planes: for each the least f32 whose cell is at least its index.
    fn find_planes<M: Machine>(&mut self, m: M, lo: f32, hi: f32) {
        let first = i32::try_from(self.planes.len()).expect("n is an i32");
        let (mut below, mut above) = ([rank(lo); LANES], [rank(hi) + 1; LANES]);
        while (0..LANES).any(|i| above[i] - below[i] > 1) {
            let middle: [i64; LANES] = std::array::from_fn(|i| below[i] + (above[i] - below[i]) / 2);
            let cells = m.to_array_i(self.cell(m, m.lanes(middle.map(unrank))));
            for (i, wanted) in (0..LANES).zip(first..) {
                let half = if cells[i] >= wanted { &mut above } else { &mut below };
                half[i] = middle[i];
            }
        }
        self.planes.extend(above.map(|rank| unrank(rank).min(hi)));
    }
}

/// The place of a finite f32 in their order, −0 and +0 being one.
fn rank(x: f32) -> i64 {
    let magnitude = i64::from(x.to_bits() & 0x7fff_ffff);
    if x < 0.0 { -magnitude } else { magnitude }
}

#[allow(clippy::cast_possible_truncation, reason = "ranks of f32 have 31 bits and a sign")]
fn unrank(rank: i64) -> f32 {
    let magnitude = f32::from_bits(rank.unsigned_abs() as u32);
    if rank < 0 { -magnitude } else { magnitude }
}

impl Grid {
    /// A grid over the boxes of all spheres. `None` if there is no sphere.
    #[must_use]
    pub fn build<M: Machine>(m: M, bounds: &[Bounds]) -> Option<Self> {
        let whole = bounds.iter().skip(1).fold(*bounds.first()?, Bounds::join);
        let mut n = resolution(&whole, bounds.len());
        loop {
            let axes = [0, 1, 2].map(|i| Axis::new(m, whole.lo[i], whole.hi[i], n[i]));
            if let Some(grid) = Self::fill(m, axes, bounds) {
                return Some(grid);
            }
            n = n.map(|n| (n / 2).max(1));
        }
    }

    /// The ids of the spheres of cell (i, j, k), ascending.
    #[inline]
    #[must_use]
    pub fn cell(&self, index: usize) -> &[u32] {
        &self.ids[self.offsets[index] as usize..self.offsets[index + 1] as usize]
    }

    /// How far apart in the list neighbours on each axis are.
    #[must_use]
    pub fn strides(&self) -> [usize; 3] {
        let n = [0, 1, 2].map(|i| self.axes[i].n.unsigned_abs() as usize);
        [n[1] * n[2], n[2], 1]
    }

    /// Count, then write. `None` if there are more entries than u32 can number: a coarser grid is needed.
    fn fill<M: Machine>(m: M, axes: [Axis; 3], bounds: &[Bounds]) -> Option<Self> {
        let cells = axes.iter().map(|a| a.n.unsigned_abs() as usize).product::<usize>();
        let mut grid = Self { axes, offsets: vec![0; cells + 1], ids: Vec::new() };
        let boxes: Vec<CellBox> = bounds.chunks(LANES).flat_map(|chunk| grid.cell_boxes(m, chunk)).collect();
        let mut entries = 0u64;
        for cell_box in &boxes {
            entries += cell_box.cells();
            grid.for_each_cell(cell_box, |grid, cell| grid.offsets[cell + 1] += 1);
        }
        u32::try_from(entries).ok()?;
        for cell in 0..cells {
            grid.offsets[cell + 1] += grid.offsets[cell];
        }
        grid.ids = vec![0; usize::try_from(entries).ok()?];
        let mut next = grid.offsets.clone();
        for (id, cell_box) in (0..).zip(&boxes) {
            grid.for_each_cell(cell_box, |grid, cell| {
                grid.ids[next[cell] as usize] = id;
                next[cell] += 1;
            });
        }
        Some(grid)
    }

    fn for_each_cell(&mut self, cells: &CellBox, mut visit: impl FnMut(&mut Self, usize)) {
        let [stride_x, stride_y, stride_z] = self.strides();
        for i in cells.range(0) {
            for j in cells.range(1) {
                for k in cells.range(2) {
                    visit(self, i * stride_x + j * stride_y + k * stride_z);
                }
            }
        }
    }

    /// The cells of up to sixteen boxes.
    fn cell_boxes<M: Machine>(&self, m: M, chunk: &[Bounds]) -> impl Iterator<Item = CellBox> + use<M> {
        let corner = |i: usize, pick: fn(&Bounds) -> [f32; 3]| {
            let mut lanes = [0.0; LANES];
            for (lane, bounds) in lanes.iter_mut().zip(chunk) {
                *lane = pick(bounds)[i];
            }
            m.to_array_i(self.axes[i].cell(m, m.lanes(lanes)))
        };
        let lo = [0, 1, 2].map(|i| corner(i, |b| b.lo));
        let hi = [0, 1, 2].map(|i| corner(i, |b| b.hi));
        (0..chunk.len()).map(move |lane| CellBox {
            lo: [0, 1, 2].map(|i| lo[i][lane]),
            hi: [0, 1, 2].map(|i| hi[i][lane]),
        })
    }
}

/// First and last cell of a box on each axis.
struct CellBox {
    lo: [i32; 3],
    hi: [i32; 3],
}

impl CellBox {
    fn range(&self, axis: usize) -> std::ops::RangeInclusive<usize> {
        self.lo[axis].unsigned_abs() as usize..=self.hi[axis].unsigned_abs() as usize
    }

    fn cells(&self) -> u64 {
        [0, 1, 2].map(|i| u64::from(self.hi[i].abs_diff(self.lo[i])) + 1).iter().product()
    }
}

/// Cells on each axis: cubes, about [`DENSITY`] a sphere, at most [`MAX_CELLS`] on an axis.
#[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "a rule of thumb")]
fn resolution(whole: &Bounds, spheres: usize) -> [i32; 3] {
    let extent = [0, 1, 2].map(|i| f64::from(whole.hi[i]) - f64::from(whole.lo[i]));
    let volume = extent[0] * extent[1] * extent[2];
    let per_unit = (DENSITY * spheres as f64 / volume).cbrt();
    extent.map(|e| ((e * per_unit).round() as i32).clamp(1, MAX_CELLS))
}
