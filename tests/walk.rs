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
        assert!(self.visits < 1_000_000, "the walk does not end");
        if live {
            self.cells.push((slice, j, k));
        }
    }

    fn unfinished(&self, slice: usize) -> [bool; LANES] {
        [slice < self.done; LANES]
    }
}

fn slices(bounds: &[Bounds]) -> Slices {
    let count = bounds.len();
    let mut slices =
        Slices { count, first: [[0; MAX_CELLS]; 2], last: [[-1; MAX_CELLS]; 2], far: [0.0; MAX_CELLS] };
    for (s, [first_j, last_j, first_k, last_k]) in bounds.iter().enumerate() {
        (slices.first[0][s], slices.last[0][s]) = (*first_j, *last_j);
        (slices.first[1][s], slices.last[1][s]) = (*first_k, *last_k);
    }
    slices
}

fn cells(which: Loop, bounds: &[Bounds], done: usize) -> Vec<Cell> {
    let mut recorder = Recorder { cells: Vec::new(), visits: 0, done };
    walk(Scalar, which, &slices(bounds), &mut recorder);
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

/// The slice's bounds with that number: 3^4 of them, empty ones among them.
fn small(number: u32) -> Bounds {
    [0, 1, 2, 3].map(|digit| i32::try_from(number / 3u32.pow(digit) % 3).expect("a digit"))
}

/// All 531,441 triples of slices with bounds from 0 to 2.
#[test]
fn exhausted_over_three_small_slices() {
    let triples = 81u32.pow(3);
    let same = (0..triples).into_par_iter().map(|number| {
        let bounds = [small(number % 81), small(number / 81 % 81), small(number / 6561)];
        let expected = expected(&bounds);
        assert_eq!(cells(Loop::Nested, &bounds, usize::MAX), expected, "nested, {bounds:?}");
        assert_eq!(cells(Loop::Flattened, &bounds, usize::MAX), expected, "flattened, {bounds:?}");
        let printed = cells(Loop::Printed, &bounds, usize::MAX);
        let set = |cells: &[Cell]| cells.iter().copied().collect::<BTreeSet<_>>();
        [u64::from(printed == expected), u64::from(set(&printed) == set(&expected))]
    });
    let [same_order, same_set] = same.reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    eprintln!("{triples} triples; printed: same order in {same_order}, same set in {same_set}");
    // Right only if all three slices have one and the same rectangle, of the 36 that are not empty; and in the same order
    // only if that is one cell wide on one axis, as 27 of them are.
    assert_eq!([same_order, same_set], [27, 36]);
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
