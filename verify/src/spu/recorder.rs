//! Where a run is booked: by stages, on both clocks, with branches, packets and repeats.
//!
//! The recorder belongs to the thread, since a machine is a value that is copied into every kernel and has no room for one.
//! [`record`] starts one, runs some work and gives what was booked; runs do not nest.

use super::feature::{Feature, has};
use super::isa::{Op, Pipe};
use super::pipeline::Pipeline;
use super::predict::{Branches, MISPREDICT, Policy, Predictor, SITES};
use super::sequence::{MAILBOX, Operand, Sequence, of_chore};
use optimized::machine::{Chore, Site, Stage};
use serde::Serialize;
use std::cell::RefCell;
use std::ops::{Add, AddAssign};

/// Quadwords of sixteen lanes.
pub(super) const QUADS: usize = 4;

/// The stages in their order.
pub const STAGES: [Stage; 6] =
    [Stage::Voxelize, Stage::Frustum, Stage::Walk, Stage::Cull, Stage::Intersect, Stage::Shade];

/// What some work came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Booked {
    /// Instructions on the even pipe.
    pub even: u64,
    /// Instructions on the odd pipe, but for hints.
    pub odd: u64,
    /// Cycles of the in-order clock, without mispredicts.
    pub in_order: u64,
    /// Mispredicts under each policy.
    pub mispredicts: [u64; 3],
    /// Hints under each policy.
    pub hints: [u64; 3],
}

impl Booked {
    /// Cycles that no schedule can be below.
    #[must_use]
    pub fn issue_bound(&self, policy: Policy) -> u64 {
        let odd = self.odd + self.hinting(policy);
        let issued = if has(Feature::DualIssue) { self.even.max(odd) } else { self.even + odd };
        issued + self.astray(policy)
    }

    /// Cycles in the order as written.
    #[must_use]
    pub fn dependence_bound(&self, policy: Policy) -> u64 {
        if !has(Feature::Latencies) || !has(Feature::DualIssue) {
            return self.issue_bound(policy);
        }
        self.in_order + self.hinting(policy) + self.astray(policy)
    }

    /// Cycles for setting hints.
    fn hinting(&self, policy: Policy) -> u64 {
        if has(Feature::Hints) { self.hints[policy as usize] } else { 0 }
    }

    /// Cycles for mispredicts.
    fn astray(&self, policy: Policy) -> u64 {
        if has(Feature::Mispredicts) { MISPREDICT * self.mispredicts[policy as usize] } else { 0 }
    }

    /// Both: least and most.
    #[must_use]
    pub fn bracket(&self, policy: Policy) -> [u64; 2] {
        [self.issue_bound(policy), self.dependence_bound(policy)]
    }
}

impl Add for Booked {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = |a: [u64; 3], b: [u64; 3]| std::array::from_fn(|i| a[i] + b[i]);
        Self {
            even: self.even + other.even,
            odd: self.odd + other.odd,
            in_order: self.in_order + other.in_order,
            mispredicts: sum(self.mispredicts, other.mispredicts),
            hints: sum(self.hints, other.hints),
        }
    }
}

/// What a run came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// By stage in the order of [`STAGES`]; of each what was done for spheres that the packet met for the first time, and again.
    pub stages: [[Booked; 2]; STAGES.len()],
    /// By site in the order of [`SITES`].
    pub sites: [Branches; SITES.len()],
    /// Packets.
    pub packets: u64,
    /// Spheres fetched from cells.
    pub fetched: u64,
    /// Of these, ones that the packet had met before.
    pub repeats: u64,
}

impl Tally {
    /// All of a stage.
    #[must_use]
    pub fn stage(&self, stage: Stage) -> Booked {
        let [first, again] = self.stages[stage as usize];
        first + again
    }

    /// All stages.
    #[must_use]
    pub fn total(&self) -> Booked {
        STAGES.iter().fold(Booked::default(), |sum, stage| sum + self.stage(*stage))
    }

    /// What was done for spheres met again.
    #[must_use]
    pub fn again(&self) -> Booked {
        self.stages.iter().fold(Booked::default(), |sum, [_, again]| sum + *again)
    }

    /// What happened at a site.
    #[must_use]
    pub fn site(&self, site: Site) -> Branches {
        self.sites[site as usize]
    }

    /// Mispredicts at some sites under a policy.
    #[must_use]
    pub fn mispredicts(&self, sites: &[Site], policy: Policy) -> u64 {
        sites.iter().map(|site| self.site(*site).mispredicts[policy as usize]).sum()
    }
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        for (sum, part) in self.stages.iter_mut().zip(other.stages) {
            *sum = [sum[0] + part[0], sum[1] + part[1]];
        }
        for (sum, part) in self.sites.iter_mut().zip(other.sites) {
            sum.executed += part.executed;
            sum.taken += part.taken;
            for (sum, part) in sum.mispredicts.iter_mut().zip(part.mispredicts) {
                *sum += part;
            }
        }
        self.packets += other.packets;
        self.fetched += other.fetched;
        self.repeats += other.repeats;
    }
}

/// Runs work on this thread and gives what it booked besides what it gave.
pub fn record<R>(work: impl FnOnce() -> R) -> (R, Tally) {
    RECORDER.with_borrow_mut(|recorder| *recorder = Recorder::default());
    let result = work();
    let tally = RECORDER.with_borrow_mut(|recorder| {
        recorder.close();
        recorder.tally
    });
    (result, tally)
}

/// The same for what has no branch and no stage: its cycles on both clocks.
pub fn cycles<R>(work: impl FnOnce() -> R) -> (R, Booked) {
    let (result, tally) = record(work);
    (result, tally.total())
}

/// Books asking a mailbox about one sphere.
pub(super) fn ask_mailbox() {
    with(|r| _ = r.run(MAILBOX, [&[0; QUADS]; 3], 1));
}

thread_local! {
    static RECORDER: RefCell<Recorder> = RefCell::new(Recorder::default());
}

/// What machines of this thread book into.
#[inline]
pub(super) fn with<R>(work: impl FnOnce(&mut Recorder) -> R) -> R {
    RECORDER.with_borrow_mut(work)
}

/// When each quadword can be used.
pub(super) type Ready = [u64; QUADS];

#[derive(Debug, Default)]
pub(super) struct Recorder {
    pipeline: Pipeline,
    predictor: Predictor,
    tally: Tally,
    /// Stage, and whether for a sphere met again.
    slot: [usize; 2],
    /// When the slot was entered, and what was booked in it since.
    entered: u64,
    open: Booked,
    /// Chores under way: what they do is booked by their sequences.
    muted: u32,
    /// When the scalars that were made last can be used.
    scalar: u64,
    /// Instructions so far.
    instructions: u64,
    /// The packet in which each sphere was last met.
    met: Vec<u64>,
    /// When the results of each instruction of a sequence under way can be used, on quadwords and of chores.
    results: Vec<Ready>,
    side_by_side: Vec<[u64; BATCH]>,
}

impl Recorder {
    /// The packet's stage changes. Instructions of two stages are not issued in one cycle.
    pub(super) fn stage(&mut self, stage: Stage) {
        self.enter([
            stage as usize,
            if matches!(stage, Stage::Cull | Stage::Intersect) { self.slot[1] } else { 0 },
        ]);
    }

    fn enter(&mut self, slot: [usize; 2]) {
        if slot != self.slot {
            self.close();
            self.slot = slot;
        }
    }

    fn close(&mut self) {
        self.pipeline.part();
        let now = self.pipeline.elapsed();
        self.open.in_order = now - self.entered;
        let sum = &mut self.tally.stages[self.slot[0]][self.slot[1]];
        *sum = *sum + self.open;
        self.tally.sites = self.predictor.sites;
        (self.open, self.entered) = (Booked::default(), now);
    }

    #[inline]
    pub(super) fn is_muted(&self) -> bool {
        self.muted > 0
    }

    #[inline]
    pub(super) fn scalar(&self) -> u64 {
        self.scalar
    }

    /// A scalar comes out of lanes.
    #[inline]
    pub(super) fn comes_out(&mut self, ready: u64) {
        self.scalar = self.scalar.max(ready);
    }

    #[inline]
    fn book(&mut self, op: Op, times: usize) {
        let of = match op.class().pipe() {
            Pipe::Even => &mut self.open.even,
            Pipe::Odd => &mut self.open.odd,
        };
        *of += times as u64;
        self.instructions += times as u64;
    }

    /// A sequence on so many quadwords, each instruction on all of them before the next.
    pub(super) fn run(&mut self, sequence: Sequence, inputs: [&Ready; 3], quads: usize) -> Ready {
        if self.results.len() < sequence.len() {
            self.results.resize(sequence.len(), [0; QUADS]);
        }
        for (step, (op, operands)) in sequence.iter().enumerate() {
            let mut results = [0; QUADS];
            for quad in 0..quads {
                let mut ready = 0;
                for from in *operands {
                    ready = ready.max(match from {
                        Operand::In(i) => inputs[*i][quad],
                        Operand::Step(i) => self.results[*i][quad],
                    });
                }
                results[quad] = self.pipeline.issue(*op, ready);
            }
            self.results[step] = results;
            self.book(*op, quads);
        }
        let mut last = self.results[sequence.len() - 1];
        if quads == 1 {
            last = [last[0]; QUADS];
        }
        last
    }

    /// A chore begins: its sequences are booked, and nothing else until it ends.
    pub(super) fn begin(&mut self, chore: Chore) {
        if self.is_muted() {
            self.muted += 1;
            return;
        }
        match chore {
            Chore::Packet => self.tally.packets += 1,
            Chore::Sphere(id) => self.meet(id),
            _ => {}
        }
        for (sequence, times) in of_chore(chore) {
            let mut latest = self.scalar;
            let mut left = times;
            while left > 0 {
                let now = left.min(BATCH);
                latest = latest.max(self.batch(sequence, now));
                left -= now;
            }
            self.scalar = latest;
        }
        self.muted += 1;
    }

    pub(super) fn end(&mut self) {
        self.muted -= 1;
    }

    /// A sequence so many times side by side, from the last scalars; when all of it can be used.
    fn batch(&mut self, sequence: Sequence, times: usize) -> u64 {
        let (start, mut latest) = (self.scalar, 0);
        if self.side_by_side.len() < sequence.len() {
            self.side_by_side.resize(sequence.len(), [0; BATCH]);
        }
        for (step, (op, operands)) in sequence.iter().enumerate() {
            for one in 0..times {
                let mut ready = 0;
                for from in *operands {
                    ready = ready.max(match from {
                        Operand::In(_) => start,
                        Operand::Step(i) => self.side_by_side[*i][one],
                    });
                }
                let result = self.pipeline.issue(*op, ready);
                self.side_by_side[step][one] = result;
                latest = latest.max(result);
            }
            self.book(*op, times);
        }
        latest
    }

    fn meet(&mut self, id: u32) {
        let (index, packet) = (id as usize, self.tally.packets);
        if self.met.len() <= index {
            self.met.resize(index + 1, 0);
        }
        let again = self.met[index] == packet;
        self.met[index] = packet;
        self.tally.fetched += 1;
        self.tally.repeats += u64::from(again);
        self.enter([self.slot[0], usize::from(again)]);
    }

    /// A branch that is decided by what can be used from `ready` on.
    pub(super) fn branch(&mut self, sequence: Sequence, ready: u64, taken: bool, site: Site) {
        self.run(sequence, [&[ready; QUADS]; 3], 1);
        let cost = self.predictor.decide(site, taken, self.instructions);
        for i in 0..Policy::ALL.len() {
            self.open.mispredicts[i] += u64::from(cost.mispredicted[i]);
            self.open.hints[i] += u64::from(cost.hinted[i]);
        }
        self.pipeline.part();
    }
}

/// Repetitions of a chore's sequence that are done side by side.
const BATCH: usize = 8;
