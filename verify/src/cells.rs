//! The map from a coordinate to a cell, held against the grid's planes over all f32: it is monotone, and cell i is what lies from
//! plane i on and before plane i + 1.
//!
//! In: an axis, a level, and how many f32 are left out. Out: how many were tried, and the first that is in another cell than its planes
//! say. The planes cut the f32, in their order from −∞ to +∞, into as many runs as there are cells, and the shipped map must give every
//! f32 of a run the run's cell. That includes monotony: it is equal within a run, and ascends from run to run. What is no number must be
//! in cell 0.

use optimized::Level;
use optimized::grid::Axis;
use optimized::host::Work;
use optimized::machine::{LANES, Machine};
use rayon::prelude::*;

/// What was swept over.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Swept {
    /// f32, with the infinities and both zeros.
    pub numbers: u64,
    /// Patterns that are no number.
    pub nans: u64,
    /// Those that are not in the cell they should be in.
    pub wrong: u64,
    /// The first of these.
    pub first: Option<String>,
}

impl std::ops::Add for Swept {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            numbers: self.numbers + other.numbers,
            nans: self.nans + other.nans,
            wrong: self.wrong + other.wrong,
            first: self.first.or(other.first),
        }
    }
}

const SIGN: u32 = 1 << 31;
/// One more than the pattern of +∞, the last number.
const END: u32 = 0x7f80_0001;
/// Rows of sixteen patterns that one piece of work has at most.
const PIECE: u32 = 1 << 18;

/// Neighbouring patterns that belong in a cell.
#[derive(Clone, Copy, Debug)]
struct Run<'a> {
    axis: &'a Axis,
    cell: i32,
    first: u32,
    count: u32,
}

/// Some rows of a run: every so many, and the run's last.
#[derive(Clone, Copy, Debug)]
struct Rows<'a> {
    run: Run<'a>,
    from: u32,
    to: u32,
    step: u32,
}

/// Tries of the patterns of each run, cut into rows of sixteen, every `step`-th row from the first on, and the last: so all if it is 1, and the
/// neighbours of every plane in any case.
///
/// # Panics
/// If the step is 0.
#[must_use]
pub fn sweep(level: Level, axis: &Axis, step: u32) -> Swept {
    let all = |runs: Vec<Run<'_>>| {
        let rows = runs.into_iter().flat_map(|run| run.rows(step)).collect::<Vec<_>>();
        rows.into_par_iter().map(|rows| level.run(rows)).reduce(Swept::default, |x, y| x + y)
    };
    let numbers = all((0..axis.n).flat_map(|cell| Run::of_cell(axis, cell)).collect());
    let nans = all([0, SIGN].map(|sign| Run { axis, cell: 0, first: sign | END, count: SIGN - END }).into());
    Swept { numbers: numbers.numbers, nans: nans.numbers, ..numbers + nans }
}

impl<'a> Run<'a> {
    /// The numbers that the planes put into a cell, those with a sign and those without.
    fn of_cell(axis: &'a Axis, cell: i32) -> [Self; 2] {
        // The cells at the ends reach on for ever.
        let inner = &axis.planes[1..axis.planes.len() - 1];
        let index = cell.unsigned_abs() as usize;
        let (lower, upper) = (index.checked_sub(1).map(|i| inner[i]), inner.get(index).copied());
        // x >= plane: without a sign from some magnitude on, with one below some magnitude; zeros are equal.
        let from = |plane: f32| if plane > 0.0 { plane.to_bits() } else { 0 };
        let below = |plane: f32| if plane > 0.0 { 0 } else { (plane.to_bits() & !SIGN) + 1 };
        let run = |sign: u32, from: u32, to: u32| Self { axis, cell, first: sign | from, count: to - from };
        [
            run(0, lower.map_or(0, from), upper.map_or(END, from)),
            run(SIGN, upper.map_or(0, below), lower.map_or(END, below)),
        ]
    }

    fn rows(self, step: u32) -> impl Iterator<Item = Rows<'a>> {
        let all = self.count.div_ceil(LANES as u32);
        let piece = move |from: u32| Rows { run: self, from, to: all.min(from + PIECE), step };
        (0..all.div_ceil(PIECE)).map(move |number| piece(number * PIECE))
    }
}

impl Work for Rows<'_> {
    type Output = Swept;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Swept {
        m.within(
            #[inline(always)]
            || self.all(m),
        )
    }
}

impl Rows<'_> {
    #[inline(always)]
    fn all<M: Machine>(self, m: M) -> Swept {
        let mut swept = Swept::default();
        let last = (self.run.count - 1) / LANES as u32;
        let mut row = self.from.next_multiple_of(self.step);
        while row < self.to {
            self.one(m, row, &mut swept);
            row += self.step;
        }
        if self.to > last && !last.is_multiple_of(self.step) {
            self.one(m, last, &mut swept);
        }
        swept
    }

    /// The last row of a run repeats its last number.
    #[inline(always)]
    fn one<M: Machine>(self, m: M, row: u32, swept: &mut Swept) {
        let start = row * LANES as u32;
        let count = (self.run.count - start).min(LANES as u32);
        let mut numbers = [0.0; LANES];
        for (lane, number) in (0..).zip(&mut numbers) {
            let offset = if lane < count { lane } else { count - 1 };
            *number = f32::from_bits(self.run.first + start + offset);
        }
        let (found, cell) = (self.run.axis.cell(m, m.lanes(numbers)), m.splat_i(self.run.cell));
        let elsewhere =
            m.to_bits(m.or(m.lt_i(found, cell), m.lt_i(cell, found))) & (u32::MAX >> (32 - count));
        swept.numbers += u64::from(count);
        if elsewhere != 0 {
            self.wrong(m.to_array_i(found), elsewhere, start, swept);
        }
    }

    #[cold]
    #[inline(never)]
    fn wrong(&self, found: [i32; LANES], lanes: u32, start: u32, swept: &mut Swept) {
        swept.wrong += u64::from(lanes.count_ones());
        let lane = lanes.trailing_zeros();
        let (pattern, found) = (self.run.first + start + lane, found[lane as usize]);
        swept.first.get_or_insert_with(|| {
            let x = f32::from_bits(pattern);
            format!("{x:e} ({pattern:#010x}) is in cell {found}, by its planes in {}", self.run.cell)
        });
    }
}
