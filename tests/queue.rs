//! Is the paper's queue a queue? Sixteen ids, newest first; the seventeenth push loses exactly the oldest; an id is never
//! mistaken for empty; corners that share a cell list an id once.

use optimized::host::Level;
use optimized::machine::LANES;
use optimized::queue::{EMPTY, MAX_IDS, Queue, SLOTS};
use rand::RngExt;
use std::collections::{BTreeSet, VecDeque};
use verify::fuzzed::Push;
use verify::seed::{generator, seed};

#[test]
fn a_queue_holds_the_last_sixteen() {
    assert_eq!(size_of::<Queue>(), 32, "the paper's cell");
    assert_eq!(SLOTS, 16);
    let seed = seed();
    eprintln!("CGT_SEED={seed}");
    let levels = Level::available();
    for level in &levels {
        let mut rng = generator(seed, 1);
        let mut queues = [Queue::EMPTY; 9];
        let mut model = vec![VecDeque::new(); queues.len()];
        let (mut lost, mut shared) = (0, 0);
        for step in 0..3_000 {
            let id = if step % 7 == 0 { 0 } else { rng.random_range(0..u32::from(EMPTY)) };
            let corners = rng.random_range(1..=8);
            let places: Vec<usize> = (0..corners).map(|_| rng.random_range(0..queues.len())).collect();
            level.run(Push { queues: &mut queues, places: &places, id });
            let mut distinct = places.clone();
            distinct.sort_unstable();
            distinct.dedup();
            shared += places.len() - distinct.len();
            for place in distinct {
                let ids: &mut VecDeque<u32> = &mut model[place];
                ids.push_front(id);
                lost += usize::from(ids.len() > SLOTS);
                ids.truncate(SLOTS);
            }
            for (queue, ids) in queues.iter().zip(&model) {
                assert!(
                    queue.ids().eq(ids.iter().copied()),
                    "{level}, step {step}: {queue:?} is not {ids:?}"
                );
                assert_eq!(queue.oldest(), ids.get(SLOTS - 1).copied(), "{level}, step {step}");
            }
        }
        assert!(lost > 1_000 && shared > 1_000, "too little was at stake: {lost} lost, {shared} shared");
    }
    eprintln!("{} levels", levels.len());
}

/// All ways in which eight corners can share cells: of each corner the number of its cell, cells being numbered as they come.
fn coincidences() -> Vec<[usize; 8]> {
    let mut all = vec![([0; 8], 0)];
    for corner in 0..8 {
        let next = |(mut of, cells): ([usize; 8], usize), cell: usize| {
            of[corner] = cell;
            (of, cells.max(cell + 1))
        };
        all = all.into_iter().flat_map(|one| (0..=one.1).map(move |cell| next(one, cell))).collect();
    }
    all.into_iter().map(|(of, _)| of).collect()
}

/// All 4,140 coincidences of the corners of a box, with queues that hold 0 to 16 ids, all as many or each one more than the one before: every
/// cell lists the id once and first, keeps the others in their order, and loses of sixteen exactly the oldest; other cells stay.
#[test]
fn exhausted_over_coincidences_and_fill_levels() {
    let (all, levels) = (coincidences(), Level::available());
    assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), 4140, "the eighth Bell number");
    let ids =
        |cell: usize, fill: usize| (0..fill).map(move |i| u32::try_from(100 * cell + i).expect("small"));
    for level in &levels {
        // A queue of each cell, and one of a cell that is no corner's, filled so far.
        let mut filled = vec![[Queue::EMPTY; 9]; SLOTS + 1];
        for (fill, queues) in filled.iter_mut().enumerate() {
            for cell in 0..9 {
                for id in ids(cell, fill) {
                    level.run(Push { queues, places: &[cell], id });
                }
                assert!(queues[cell].ids().eq(ids(cell, fill).rev()), "{level}");
            }
        }
        let (mut pushes, mut lost) = (0, 0);
        for of in &all {
            for fill in 0..=SLOTS {
                for more in [0, 1] {
                    let fill_of = |cell: usize| (fill + more * cell) % (SLOTS + 1);
                    let before: [Queue; 9] = std::array::from_fn(|cell| filled[fill_of(cell)][cell]);
                    let mut queues = before;
                    level.run(Push { queues: &mut queues, places: of, id: 65_000 });
                    pushes += 1;
                    for (cell, queue) in queues.iter().enumerate() {
                        if of.contains(&cell) {
                            let kept = ids(cell, fill_of(cell)).rev().take(SLOTS - 1);
                            assert!(
                                queue.ids().eq(std::iter::once(65_000).chain(kept)),
                                "{level}, {of:?}, {fill}, {more}: {queue:?}"
                            );
                            lost += usize::from(fill_of(cell) == SLOTS);
                        } else {
                            assert_eq!(*queue, before[cell], "{level}, {of:?}, {fill}, {more}");
                        }
                    }
                }
            }
        }
        eprintln!("{level}: {pushes} pushes, {lost} ids lost");
        // Distinct cells of all coincidences: partitions of nine less those of eight, 21,147 − 4,140; each is full once in 17 fills.
        assert_eq!([pushes, lost], [4140 * 17 * 2, 2 * (21_147 - 4140)], "{level}");
    }
}

/// More places than a machine has lanes, if they differ.
#[test]
fn more_than_sixteen_places_are_pushed_to() {
    for level in Level::available() {
        let mut queues = [Queue::EMPTY; 40];
        let places: Vec<usize> = (0..37).rev().collect();
        level.run(Push { queues: &mut queues, places: &places, id: 7 });
        for (place, queue) in queues.iter().enumerate() {
            assert_eq!(queue.ids().collect::<Vec<_>>(), vec![7; usize::from(place < 37)], "{level}, {place}");
        }
    }
}

#[test]
fn every_id_differs_from_empty() {
    for id in 0..u32::try_from(MAX_IDS).expect("16 bits") {
        let mut queues = [Queue::EMPTY; 1];
        Level::SCALAR.run(Push { queues: &mut queues, places: &[0], id });
        assert!(queues[0].ids().eq([id]), "id {id}");
    }
    assert!(Queue::EMPTY.ids().next().is_none());
    assert_eq!(LANES, 16);
}
