//! What the model has, and what it would say without: each feature can be left out for a run, to see whether any conclusion rests on it.
//!
//! A model that needs less is better understood; a feature that changes no conclusion is there for its figures alone. What is left out holds for
//! one thread, within [`without`].

use serde::Serialize;
use std::cell::Cell;

/// A part of the model that can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Feature {
    /// Two instructions in a cycle, one on each pipe.
    DualIssue,
    /// Waiting for operands, in the order as written.
    Latencies,
    /// 18 cycles for a branch that was predicted wrongly.
    Mispredicts,
    /// Cycles for setting hints.
    Hints,
    /// Moving the scene in and stripes out.
    Transfers,
    /// Each SPU's own building of the grid.
    Building,
}

impl Feature {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::DualIssue, Self::Latencies, Self::Mispredicts, Self::Hints, Self::Transfers, Self::Building];

    /// What it is.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::DualIssue => "two instructions a cycle",
            Self::Latencies => "waiting for operands",
            Self::Mispredicts => "mispredicts",
            Self::Hints => "cycles for hints",
            Self::Transfers => "transfers",
            Self::Building => "building the grid on each SPU",
        }
    }
}

thread_local! {
    static WITHOUT: Cell<Option<Feature>> = const { Cell::new(None) };
}

/// Whether the model has a feature now.
pub(super) fn has(feature: Feature) -> bool {
    WITHOUT.get() != Some(feature)
}

/// Does something on the model without a feature, on this thread.
pub fn without<R>(feature: Feature, work: impl FnOnce() -> R) -> R {
    let before = WITHOUT.replace(Some(feature));
    let result = work();
    WITHOUT.set(before);
    result
}
