//! The paper's queue against plain lists: what it holds after any pushes, and what a grid of queues reports of those that overflow.

use super::bytes::Bytes;
use super::voxelize::cell_on;
use optimized::event::Events;
use optimized::grid::{Bounds, Grid};
use optimized::host::Work;
use optimized::machine::Machine;
use optimized::plan::{Cells, OnEvent, Plan, Resolution, Voxelizer};
use optimized::queue::{EMPTY, Queue, SLOTS, push_all};
use optimized::{Event, Level, RenderError};
use std::collections::VecDeque;

/// Pushes onto nine queues, or a grid of queues over up to 64 balls that goes on when a queue is full. Each queue must hold the last
/// sixteen ids of its list, newest first, and the grid must report each push that lost an id, and which. Queues are judged.
///
/// # Panics
/// If a queue holds something else, or an overflow is not reported.
pub fn queue(bytes: &[u8]) -> u64 {
    let mut from = Bytes(bytes);
    let level = from.level();
    if from.flag() { grid(&mut from, level) } else { pushes(&mut from, level) }
}

/// A list and its sixteen newest.
#[derive(Clone, Debug, Default)]
struct List(VecDeque<u32>);

impl List {
    /// Gives what was lost.
    fn push(&mut self, id: u32) -> Option<u32> {
        self.0.push_front(id);
        if self.0.len() > 16 { self.0.pop_back() } else { None }
    }
}

fn pushes(from: &mut Bytes<'_>, level: Level) -> u64 {
    let (mut queues, mut lists) = ([Queue::EMPTY; 9], vec![List::default(); 9]);
    let mut judged = 0;
    for step in 0..200 {
        if from.0.is_empty() && step > 0 {
            break;
        }
        let (corners, wide) = (from.byte(), from.flag());
        let id = if wide { from.word() % u32::from(EMPTY) } else { u32::from(from.byte()) };
        let places: Vec<usize> = (0..=corners % 8).map(|_| usize::from(from.below(9))).collect();
        level.run(Push { queues: &mut queues, places: &places, id });
        let mut distinct = places.clone();
        distinct.sort_unstable();
        distinct.dedup();
        for place in distinct {
            lists[place].push(id);
        }
        for (place, (queue, List(list))) in queues.iter().zip(&lists).enumerate() {
            let held = || queue.ids().collect::<Vec<_>>();
            assert!(
                held().iter().eq(list),
                "queue {place} holds {:?}, not {list:?}, after push {step} of {id} (0x{id:04x}) to {places:?}; {level}",
                held()
            );
            let last = list.get(SLOTS - 1).copied();
            assert_eq!(queue.oldest(), last, "the next id to be lost of queue {place}, {list:?}; {level}");
            judged += 1;
        }
    }
    judged
}

/// Balls on a lattice of sixteenths, in few cells.
fn grid(from: &mut Bytes<'_>, level: Level) -> u64 {
    let (count, n, corners) = (from.below(64) + 1, from.below(4) + 1, from.flag());
    let balls: Vec<Bounds> = (0..count)
        .map(|_| {
            let center = std::array::from_fn(|_| f32::from(from.whole() % 32) / 16.0);
            Bounds::outward(center, f32::from(from.below(8) + 1) / 16.0)
        })
        .collect();
    let plan = Plan {
        voxelizer: if corners { Voxelizer::EightCorners } else { Voxelizer::BoxRange },
        cells: Cells::Queue,
        resolution: Resolution::Fixed(n),
        on_event: OnEvent::GoOn,
        ..Plan::safe()
    };
    let (grid, events) = match level.run(Build { plan, balls: &balls }) {
        Ok(built) => built,
        Err(error) => panic!("{error}; {plan}, {level}, {balls:?}"),
    };
    assert!(grid.has_queues(), "queues were asked for; {plan}");
    let cells = grid.axes.each_ref().map(|axis| axis.planes.len() - 1);
    let strides = grid.strides();
    let mut lists = vec![List::default(); cells.iter().product()];
    let mut due = Vec::new();
    for (id, ball) in (0..).zip(&balls) {
        let ends = |i: usize| {
            let [lo, hi] = [ball.lo[i], ball.hi[i]].map(|x| cell_on(&grid.axes[i], x));
            if corners && lo < hi { vec![lo, hi] } else { (lo..=hi).collect() }
        };
        for i in ends(0) {
            for j in ends(1) {
                for k in ends(2) {
                    let index = i * strides[0] + j * strides[1] + k * strides[2];
                    if let Some(lost) = lists[index].push(id) {
                        due.push((index, id, lost));
                    }
                }
            }
        }
    }
    let mut told: Vec<(usize, u32, u32)> = Vec::new();
    for event in events.first() {
        if let &Event::CellFull { cell, pushed, lost } = event {
            let index = (0..3).map(|i| cell[i].unsigned_abs() as usize * strides[i]).sum();
            told.push((index, pushed, lost));
        }
    }
    due.sort_unstable();
    told.sort_unstable();
    assert!(
        due == told,
        "of overflows (place, pushed, lost) {told:?} are told, {due:?} happened; {plan}, {level}, {balls:?}"
    );
    for (index, List(list)) in lists.iter().enumerate() {
        let mut held = Vec::new();
        grid.for_each_id(index, true, |id| held.push(id));
        assert!(
            held.iter().eq(list),
            "cell {index} holds {held:?}, not {list:?}; {plan}, {level}, {balls:?}"
        );
    }
    lists.len() as u64
}

/// Pushes an id onto the queues at these places as the voxelizer does.
#[derive(Debug)]
#[allow(missing_docs, reason = "its fields are what it says")]
pub struct Push<'a> {
    pub queues: &'a mut [Queue],
    pub places: &'a [usize],
    pub id: u32,
}

impl Work for Push<'_> {
    type Output = ();

    fn on<M: Machine + Send + Sync>(self, m: M) {
        push_all(m, self.queues, self.places, self.id);
    }
}

struct Build<'a> {
    plan: Plan,
    balls: &'a [Bounds],
}

impl Work for Build<'_> {
    type Output = Result<(Grid, Events), RenderError>;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        let mut events = Events::default();
        Ok((Grid::build(m, &self.plan, self.balls, &mut events)?, events))
    }
}
