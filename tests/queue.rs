//! Is the paper's queue a queue? Sixteen ids, newest first; the seventeenth push loses exactly the oldest; an id is never
//! mistaken for empty; corners that share a cell list an id once.

use optimized::host::Level;
use optimized::host::Work;
use optimized::machine::{LANES, Machine};
use optimized::queue::{EMPTY, MAX_IDS, Queue, Queues, SLOTS};
use rand::RngExt;
use std::collections::VecDeque;
use verify::seed::{generator, seed};

/// Pushes an id onto the queues at these places as the voxelizer does: all are read before any is written.
struct Push<'a> {
    queues: &'a mut [Queue],
    places: &'a [usize],
    id: u32,
}

impl Work for Push<'_> {
    type Output = ();

    fn on<M: Machine + Send + Sync>(self, m: M) {
        let read: Vec<Queue> = self.places.iter().map(|&place| self.queues[place]).collect();
        let pushed = Queues::read(m, &read).push(m, m.splat_i(self.id.cast_signed())).to_array(m);
        for (&place, queue) in self.places.iter().zip(pushed) {
            self.queues[place] = queue;
        }
    }
}

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
