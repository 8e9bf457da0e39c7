//! The three loops against all cells of the slices in order, along both major directions, with an end after any slice.

use super::bytes::Bytes;
use optimized::frustum::{Heading, Slices};
use optimized::grid::MAX_CELLS;
use optimized::host::Work;
use optimized::machine::Machine;
use optimized::plan::Loop;
use optimized::walk::{Visitor, walk as walk_by};
use std::collections::BTreeSet;

type Cell = [i32; 3];

/// First and last j, first and last k.
type Bounds = [i32; 4];

/// Up to 24 slices of up to 8x8 cells, empty ones among them, are walked by each loop. Nested and flattened must come to the cells
/// of the slices up to the end, slice by slice along the heading, j by j, k by k, each once; the flattened one makes one more visit,
/// which is not live, for each slice without cells. The printed one must come to the first slice's rectangle in every slice, j
/// innermost, and one cell of it where that is empty. Cells are judged, and each walk.
///
/// # Panics
/// If a loop goes otherwise.
pub fn walk(bytes: &[u8]) -> u64 {
    let mut from = Bytes(bytes);
    let (level, axis) = (from.level(), usize::from(from.below(3)));
    let (forward, count) = (from.flag(), usize::from(from.below(24)) + 1);
    let done = if from.flag() { usize::MAX } else { usize::from(from.below(26)) };
    let heading = Heading::new(axis, forward);
    let bounds: Vec<Bounds> = (0..count)
        .map(|_| {
            let [j, k] = [from.byte(), from.byte()].map(i32::from);
            // The last is below the first in one of four.
            [j % 8, (j % 8 + j / 8 % 4 - 1).min(7), k % 8, (k % 8 + k / 8 % 4 - 1).min(7)]
        })
        .collect();
    let mut slices =
        Slices { count, first: [[0; MAX_CELLS]; 2], last: [[-1; MAX_CELLS]; 2], far: [0.0; MAX_CELLS] };
    for (s, [first_j, last_j, first_k, last_k]) in bounds.iter().enumerate() {
        (slices.first[0][s], slices.last[0][s]) = (*first_j, *last_j);
        (slices.first[1][s], slices.last[1][s]) = (*first_k, *last_k);
    }
    let go = |which| level.run(Walk { which, slices: &slices, heading, done });

    let all = in_order(&bounds, done, forward);
    let replay = || format!("{heading:?}, done after slice {done}, {level}, bounds {bounds:?}");
    let [nested, flattened] = [Loop::Nested, Loop::Flattened].map(go);
    assert!(nested.cells == all, "the nested loops come to {:?}, not {all:?}; {}", nested.cells, replay());
    assert!(
        flattened.cells == all,
        "the flattened loop comes to {:?}, not {all:?}; {}",
        flattened.cells,
        replay()
    );
    let empty = bounds[..=done.min(count - 1)].iter().filter(|b| b[1] < b[0] || b[3] < b[2]).count();
    for (name, walked, dead) in [("nested", &nested, 0), ("flattened", &flattened, empty)] {
        assert_eq!(walked.dead, dead, "visits of the {name} loop that are not live; {}", replay());
    }

    let printed = go(Loop::Printed);
    let all_printed = as_printed(bounds[0], count, forward);
    assert!(
        printed.cells == all_printed,
        "the printed loop comes to {:?}, not {all_printed:?}; {}",
        printed.cells,
        replay()
    );
    (3 + nested.cells.len() + flattened.cells.len() + printed.cells.len()) as u64
}

/// All cells up to the end, in lexicographic order along the walk.
fn in_order(bounds: &[Bounds], done: usize, forward: bool) -> Vec<Cell> {
    let slices = (0..).zip(bounds).take(done.saturating_add(1));
    let all: BTreeSet<Cell> = slices
        .flat_map(|(s, &[first_j, last_j, first_k, last_k])| {
            (first_j..=last_j).flat_map(move |j| (first_k..=last_k).map(move |k| [s, j, k]))
        })
        .collect();
    all.into_iter().map(|[s, j, k]| [along(bounds.len(), s, forward), j, k]).collect()
}

/// The grid's slice that is the walk's s-th.
fn along(count: usize, s: i32, forward: bool) -> i32 {
    let last = i32::try_from(count).unwrap_or(i32::MAX) - 1;
    if forward { s } else { last - s }
}

/// The same rectangle in every slice, k by k, then j by j; at least one cell of it on each axis.
fn as_printed([first_j, last_j, first_k, last_k]: Bounds, count: usize, forward: bool) -> Vec<Cell> {
    let mut cells = Vec::new();
    for (s, _) in (0..).zip(0..count) {
        for k in first_k..=last_k.max(first_k) {
            cells.extend((first_j..=last_j.max(first_j)).map(|j| [along(count, s, forward), j, k]));
        }
    }
    cells
}

struct Walk<'a> {
    which: Loop,
    slices: &'a Slices,
    heading: Heading,
    done: usize,
}

/// The cells that a loop came to, and the visits that were not live.
#[derive(Clone, Debug, Default)]
struct Walked {
    cells: Vec<Cell>,
    dead: usize,
}

struct Recorder<'a, M> {
    m: M,
    walk: &'a Walk<'a>,
    walked: Walked,
}

impl Work for Walk<'_> {
    type Output = Walked;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Walked {
        let mut recorder = Recorder { m, walk: &self, walked: Walked::default() };
        m.within(
            #[inline(always)]
            || walk_by(m, self.which, self.slices, &mut recorder),
        );
        recorder.walked
    }
}

impl<M: Machine> Visitor<M> for Recorder<'_, M> {
    fn visit(&mut self, slice: usize, j: i32, k: i32, live: bool) {
        let Walked { cells, dead } = &mut self.walked;
        assert!(cells.len() + *dead < 10_000, "the walk does not end: {:?}", self.walk.which);
        if live {
            let index = self.walk.heading.slice_index(self.walk.slices.count, slice);
            cells.push([i32::try_from(index).unwrap_or(i32::MAX), j, k]);
        } else {
            *dead += 1;
        }
    }

    #[inline(always)]
    fn unfinished(&self, slice: usize) -> M::B {
        let m = self.m;
        let one = m.splat_i(i32::from(slice < self.walk.done));
        m.lt_i(m.splat_i(0), one)
    }
}
