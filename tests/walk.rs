//! Do the loops visit the same cells in the same order, and does the printed one not?

use optimized::frustum::Slices;
use optimized::grid::MAX_CELLS;
use optimized::host::Scalar;
use optimized::machine::LANES;
use optimized::plan::Loop;
use optimized::walk::{Visitor, walk};
use rand::RngExt;
use rayon::prelude::*;
use std::collections::BTreeSet;
use verify::seed::{count, generator, seed};

type Cell = (usize, i32, i32);

/// Bounds of a slice: first and last j, first and last k.
type Bounds = [i32; 4];

/// Keeps the live cells, and says after which slice nothing can win any more.
struct Recorder {
    cells: Vec<Cell>,
    visits: u64,
    done: usize,
}

impl Visitor<Scalar> for Recorder {
    fn visit(&mut self, slice: usize, j: i32, k: i32, live: bool) {
        self.visits += 1;
        assert!(self.visits < 100_000, "the walk does not end");
        if live {
            self.cells.push((slice, j, k));
        }
    }

    fn unfinished(&self, slice: usize) -> [bool; LANES] {
        [slice < self.done; LANES]
    }
}

impl Recorder {
    fn new(done: usize) -> Self {
        Self { cells: Vec::new(), visits: 0, done }
    }

    /// Walks anew.
    fn record(&mut self, which: Loop, slices: &Slices) {
        self.cells.clear();
        self.visits = 0;
        walk(Scalar, which, slices, self);
    }
}

fn slices(bounds: &[Bounds]) -> Slices {
    let mut slices =
        Slices { count: 0, first: [[0; MAX_CELLS]; 2], last: [[-1; MAX_CELLS]; 2], far: [0.0; MAX_CELLS] };
    set(&mut slices, bounds);
    slices
}

fn set(slices: &mut Slices, bounds: &[Bounds]) {
    slices.count = bounds.len();
    for (s, [first_j, last_j, first_k, last_k]) in bounds.iter().enumerate() {
        (slices.first[0][s], slices.last[0][s]) = (*first_j, *last_j);
        (slices.first[1][s], slices.last[1][s]) = (*first_k, *last_k);
    }
}

fn cells(which: Loop, bounds: &[Bounds], done: usize) -> Vec<Cell> {
    let mut recorder = Recorder::new(done);
    recorder.record(which, &slices(bounds));
    recorder.cells
}

/// What three nested loops are, said once more and differently: all cells in lexicographic order.
fn expected(bounds: &[Bounds]) -> Vec<Cell> {
    let all = bounds.iter().enumerate().flat_map(|(s, &[first_j, last_j, first_k, last_k])| {
        (first_j..=last_j).flat_map(move |j| (first_k..=last_k).map(move |k| (s, j, k)))
    });
    let set: BTreeSet<Cell> = all.collect();
    set.into_iter().collect()
}

/// Whether these are all cells of the slices in lexicographic order, each once: they ascend, none lies outside its slice, and there are as
/// many as the slices have.
fn are_all(cells: &[Cell], bounds: &[Bounds]) -> bool {
    let inside = |&(s, j, k): &Cell| {
        let [first_j, last_j, first_k, last_k] = bounds[s];
        (first_j..=last_j).contains(&j) && (first_k..=last_k).contains(&k)
    };
    let area = |&[first_j, last_j, first_k, last_k]: &Bounds| {
        (last_j - first_j + 1).max(0) * (last_k - first_k + 1).max(0)
    };
    let count: i32 = bounds.iter().map(area).sum();
    cells.is_sorted_by(|x, y| x < y) && cells.iter().all(inside) && usize::try_from(count) == Ok(cells.len())
}

/// What all walks through a domain came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Tally {
    walks: u64,
    cells: u64,
    /// Visits of the flattened loop beyond these: one for each slice without cells.
    empty: u64,
    /// Walks in which the printed loop visits the same cells in the same order.
    same_order: u64,
    /// Walks in which it visits the same cells.
    same_set: u64,
}

impl std::ops::Add for Tally {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            walks: self.walks + other.walks,
            cells: self.cells + other.cells,
            empty: self.empty + other.empty,
            same_order: self.same_order + other.same_order,
            same_set: self.same_set + other.same_set,
        }
    }
}

/// Walks by all three loops, and says where the printed one is right: in the cells if and only if all slices have one and the same
/// rectangle, which is not empty; in their order if and only if it is one cell wide on one axis as well.
fn tally(
    bounds: &[Bounds],
    slices: &mut Slices,
    [nested, other]: &mut [Recorder; 2],
) -> Result<Tally, String> {
    set(slices, bounds);
    nested.record(Loop::Nested, slices);
    if !are_all(&nested.cells, bounds) {
        return Err(format!("nested, {bounds:?}: {:?}", nested.cells));
    }
    other.record(Loop::Flattened, slices);
    if nested.cells != other.cells {
        return Err(format!("nested, flattened, {bounds:?}: {:?}, {:?}", nested.cells, other.cells));
    }
    let is_empty = |&[first_j, last_j, first_k, last_k]: &Bounds| last_j < first_j || last_k < first_k;
    let empty = bounds.iter().filter(|bounds| is_empty(bounds)).count() as u64;
    if other.visits != other.cells.len() as u64 + empty {
        return Err(format!("flattened, {bounds:?}: {} visits", other.visits));
    }

    other.record(Loop::Printed, slices);
    let same_order = other.cells == nested.cells;
    other.cells.sort_unstable();
    other.cells.dedup();
    let same_set = other.cells == nested.cells;
    let [first_j, last_j, first_k, last_k] = bounds[0];
    let alike = empty == 0 && bounds.iter().all(|other| *other == bounds[0]);
    let narrow = first_j == last_j || first_k == last_k;
    if [same_order, same_set] != [alike && narrow, alike] {
        return Err(format!("printed, {bounds:?}: same order {same_order}, same set {same_set}"));
    }
    let [cells, same_order, same_set] =
        [nested.cells.len() as u64, u64::from(same_order), u64::from(same_set)];
    Ok(Tally { walks: 1, cells, empty, same_order, same_set })
}

/// Walks through all sequences of so many slices, each with any of the rectangles.
fn exhaust(rectangles: &[Bounds], count: u32) -> Tally {
    let n = rectangles.len();
    let walks = n.pow(count);
    let scratch = || (slices(&[]), [Recorder::new(usize::MAX), Recorder::new(usize::MAX)]);
    (0..walks)
        .into_par_iter()
        .map_init(scratch, |(slices, recorders), number| {
            let bounds: Vec<Bounds> = (0..count).map(|s| rectangles[number / n.pow(s) % n]).collect();
            tally(&bounds, slices, recorders)
        })
        .try_reduce(Tally::default, |x, y| Ok(x + y))
        .unwrap_or_else(|wrong| panic!("{wrong}"))
}

/// The slice's bounds with that number: 3^4 of them, empty ones among them.
fn small(number: u32) -> Bounds {
    [0, 1, 2, 3].map(|digit| i32::try_from(number / 3u32.pow(digit) % 3).expect("a digit"))
}

/// All 531,441 triples of slices with bounds from 0 to 2.
#[test]
fn exhausted_over_three_small_slices() {
    let rectangles: Vec<Bounds> = (0..81).map(small).collect();
    let tally = exhaust(&rectangles, 3);
    eprintln!("triples within 3 cells: {tally:?}");
    // Of the 81, 36 are not empty, and 27 of these are one cell wide on one axis; a side has 10 cells in all.
    let expected = Tally {
        walks: 81 * 81 * 81,
        cells: 3 * 81 * 81 * 100,
        empty: 3 * 81 * 81 * 45,
        same_order: 27,
        same_set: 36,
    };
    assert_eq!(tally, expected);
}

/// Every rectangle of cells within six on both axes: 21 intervals that are not empty and one that is, on each.
fn rectangles() -> Vec<Bounds> {
    let mut intervals = vec![[0, -1]];
    intervals.extend((0..6).flat_map(|first| (first..6).map(move |last| [first, last])));
    let both = |j: &[i32; 2]| intervals.iter().map(|k| [j[0], j[1], k[0], k[1]]).collect::<Vec<_>>();
    intervals.iter().flat_map(both).collect()
}

/// All sequences of `CGT_WALK_SLICES` slices, 2 every day, with any rectangle within six cells: 234,256 pairs, or 113,379,904 triples.
#[test]
fn exhausted_over_slices_within_six_cells() {
    let rectangles = rectangles();
    let slices = u32::try_from(count("CGT_WALK_SLICES", 2)).expect("few").clamp(1, 3);
    let tally = exhaust(&rectangles, slices);
    eprintln!("{slices} slices within 6 cells: {tally:?}");
    let others = 484u64.pow(slices - 1) * u64::from(slices);
    // The 22 intervals have 56 cells in all, so the 484 rectangles 56 times 56; 43 are empty, 216 one cell wide on one axis.
    let expected = Tally {
        walks: 484u64.pow(slices),
        cells: others * 56 * 56,
        empty: others * 43,
        same_order: 216,
        same_set: 441,
    };
    assert_eq!(tally, expected);
}

/// Every rectangle within six cells in one to six slices.
#[test]
fn exhausted_over_boxes() {
    let mut all = Tally::default();
    let (mut slices, mut recorders) = (slices(&[]), [Recorder::new(usize::MAX), Recorder::new(usize::MAX)]);
    for rectangle in rectangles() {
        for count in 1..=6 {
            let one = tally(&vec![rectangle; count], &mut slices, &mut recorders);
            all = all + one.unwrap_or_else(|wrong| panic!("{wrong}"));
        }
    }
    eprintln!("boxes within 6 cells: {all:?}");
    let expected =
        Tally { walks: 484 * 6, cells: 21 * 56 * 56, empty: 21 * 43, same_order: 6 * 216, same_set: 6 * 441 };
    assert_eq!(all, expected);
}

/// The smallest cases in which the printed loop differs: one slice of 2x2 cells comes in another order; two slices with
/// different bounds, of one cell each, come out with the first one's; an empty slice is visited.
#[test]
fn the_printed_loop_differs() {
    let one = [[0, 1, 0, 1]];
    assert_eq!(cells(Loop::Printed, &one, 9), [(0, 0, 0), (0, 1, 0), (0, 0, 1), (0, 1, 1)]);
    assert_eq!(cells(Loop::Flattened, &one, 9), [(0, 0, 0), (0, 0, 1), (0, 1, 0), (0, 1, 1)]);
    let two = [[0, 0, 0, 0], [1, 1, 0, 0]];
    assert_eq!(cells(Loop::Printed, &two, 9), [(0, 0, 0), (1, 0, 0)]);
    assert_eq!(cells(Loop::Flattened, &two, 9), [(0, 0, 0), (1, 1, 0)]);
    let empty = [[1, 0, 0, 0]];
    assert_eq!(cells(Loop::Printed, &empty, 9), [(0, 1, 0)]);
    assert_eq!(cells(Loop::Flattened, &empty, 9), []);
}

/// Up to 64 slices of up to 64x64 cells, some of them empty, with an end after any slice.
#[test]
fn random_walks_agree_and_end_alike() {
    let (seed, walks) = (seed(), count("CGT_WALKS", 5_000));
    eprintln!("CGT_SEED={seed}, {walks} walks");
    let tally = |i: u64| {
        let mut rng = generator(seed, i);
        let side = *[2, 5, 16, 64].get(rng.random_range(0..4usize)).expect("four");
        let mut axis = || {
            let first = rng.random_range(0..side);
            let empty = rng.random_range(0..6) == 0;
            (first, if empty { -1 } else { (first + rng.random_range(0..4)).min(side - 1) })
        };
        let bounds: Vec<Bounds> = (0..side)
            .map(|_| {
                let ((first_j, last_j), (first_k, last_k)) = (axis(), axis());
                [first_j, last_j, first_k, last_k]
            })
            .collect();
        let done = rng.random_range(0..bounds.len() + 2);
        let nested = cells(Loop::Nested, &bounds, done);
        assert_eq!(
            nested,
            cells(Loop::Flattened, &bounds, done),
            "walk {i} of CGT_SEED={seed}: {bounds:?}, {done}"
        );
        assert!(expected(&bounds).starts_with(&nested), "walk {i} of CGT_SEED={seed}: {bounds:?}, {done}");
        let ended_early = nested.len() < expected(&bounds).len();
        [nested.len() as u64, u64::from(ended_early)]
    };
    let [cells, early] =
        (0..walks).into_par_iter().map(tally).reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    eprintln!("{cells} cells, {early} walks ended early");
    assert!(cells > 10 * walks && early > walks / 5, "too little was at stake");
}
