//! Two clocks for one stream of instructions.
//!
//! The *issue bound* counts instructions on each pipe and takes the larger count: no schedule can be shorter, since a pipe takes
//! one a cycle. The *dependence bound* issues them in the order in which they come: one even and one odd in a cycle at most, never
//! before their operands, never before one that came earlier. A compiler's schedule lies between the two, but for what it fuses or
//! shares.
//!
//! Left out, each so that the dependence bound errs low: that the even instruction of a pair must come first and lie on an even
//! word, that fetching takes turns with loads and stores, and that 128 registers may be too few.

use super::isa::{Op, Pipe};

/// The in-order clock.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pipeline {
    cycle: u64,
    used: [bool; 2],
}

impl Pipeline {
    /// Issues an instruction whose operands can be used from `ready` on. Its result can be used from the cycle that is given back.
    #[inline]
    pub fn issue(&mut self, op: Op, ready: u64) -> u64 {
        let class = op.class();
        let pipe = usize::from(class.pipe() == Pipe::Odd);
        let taken = ready <= self.cycle && self.used[pipe];
        let at = self.cycle.max(ready) + u64::from(taken);
        if at > self.cycle {
            self.cycle = at;
            self.used = [false; 2];
        }
        self.used[pipe] = true;
        at + class.latency()
    }

    /// What follows is issued in a later cycle, as it is after a branch.
    #[inline]
    pub fn part(&mut self) {
        self.cycle = self.elapsed();
        self.used = [false; 2];
    }

    /// Cycles in which something was or could have been issued so far.
    #[inline]
    #[must_use]
    pub fn elapsed(&self) -> u64 {
        self.cycle + u64::from(self.used[0] | self.used[1])
    }
}
