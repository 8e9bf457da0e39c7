//! A frame over six SPUs: each fetches the scene and builds the grid for itself (the paper), then takes stripes of four scanlines as
//! it becomes free, and writes each to memory.
//!
//! Every figure is a bracket: the issue bound with a free memory and transfers that are hidden where there are two buffers; the
//! dependence bound with all six at the memory at once, and nothing hidden where there is one.

use super::dma::{Transfer, TransferError};
use super::feature::{Feature, has};
use super::model::Measured;
use super::predict::Policy;
use super::recorder::Booked;
use super::store::{Buffers, PIXEL, SPHERE};
use optimized::camera::BLOCK;

/// SPUs that a PlayStation 3 leaves to programs.
pub const SPUS: usize = 6;
/// Cycles in a second.
pub const HERTZ: f64 = 3.2e9;

/// Least and most.
pub type Bracket = [f64; 2];

/// Cycles of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameCost {
    /// From the scene's arrival to the last pixel's departure.
    pub cycles: Bracket,
    /// Of these, building the grid on each SPU.
    pub voxelize: Bracket,
    /// All transfers of one SPU, with their commands: of the scene, and of a sixth of the stripes.
    pub dma: Bracket,
}

impl FrameCost {
    /// Frames in a second: least and most.
    #[must_use]
    pub fn frames_per_second(&self) -> Bracket {
        [HERTZ / self.cycles[1], HERTZ / self.cycles[0]]
    }
}

/// Both bounds of what was booked.
#[must_use]
pub fn bracket(booked: &Booked, policy: Policy) -> Bracket {
    booked.bracket(policy).map(|cycles| cycles as f64)
}

/// Cycles that a transfer takes, alone and with all SPUs at once, and those of its commands.
fn transfer(bytes: u64) -> Result<Bracket, TransferError> {
    let transfer = Transfer::new(0, bytes)?;
    Ok(transfer.seconds(SPUS as u32).map(|seconds| seconds * HERTZ + transfer.commands() as f64))
}

/// A measured frame's cost under a policy of hints.
///
/// # Errors
/// [`TransferError`] if scene or stripe cannot be transferred.
pub fn frame_cost(
    measured: &Measured,
    spheres: usize,
    policy: Policy,
    buffers: Buffers,
) -> Result<FrameCost, TransferError> {
    let free = [0.0; 2];
    let built = bracket(&measured.voxelize.total(), policy);
    let voxelize = if has(Feature::Building) { built } else { free };
    let moved = |bytes| if has(Feature::Transfers) { transfer(bytes) } else { Ok(free) };
    let scene = moved(SPHERE * spheres as u64)?;
    let width = u64::from(measured.image.size.width());
    // The last quadword of a row that is no multiple of one is moved whole.
    let stripe = moved((PIXEL * u64::from(BLOCK) * width).next_multiple_of(super::dma::ALIGNMENT))?;
    let mut cycles = [0.0; 2];
    for (bound, cycles) in cycles.iter_mut().enumerate() {
        let stripes = measured.stripes.iter().map(|s| {
            let traced = bracket(&s.tally.total(), policy)[bound] * f64::from(s.blocks) / f64::from(s.traced);
            match buffers {
                Buffers::Double => traced.max(stripe[bound]),
                Buffers::Single => traced + stripe[bound],
            }
        });
        *cycles = scene[bound] + voxelize[bound] + dealt(stripes);
    }
    let share = measured.stripes.len().div_ceil(SPUS) as f64;
    let dma = [0, 1].map(|bound| scene[bound] + share * stripe[bound]);
    Ok(FrameCost { cycles, voxelize, dma })
}

/// When the last is done, if each stripe goes to the SPU that is free first.
#[must_use]
pub fn dealt(stripes: impl Iterator<Item = f64>) -> f64 {
    let mut free = [0.0f64; SPUS];
    for cycles in stripes {
        free.sort_by(f64::total_cmp);
        free[0] += cycles;
    }
    free.into_iter().fold(0.0, f64::max)
}
