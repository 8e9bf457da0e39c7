//! What is chosen of a view: plan, arithmetic, level, threads, overlays, and the line of the wipe. Keys change it; a [`Plan`] comes out of it.

use super::command::Overlay;
use crate::bench::ours::chosen;
use crate::subject::{NamedPlan, tiles_are_served};
use contract::Scene;
use optimized::plan::{Arithmetic, Packet};
use optimized::{Form, Level, Plan};
use std::collections::BTreeSet;

/// What can be chosen in place of the plan's own arithmetic, with its name.
const ARITHMETICS: [(Option<Arithmetic>, &str); 6] = [
    (None, ""),
    (Some(Arithmetic::Certified), "certified exact"),
    (Some(Arithmetic::Rounded(Form::Perpendicular)), "perpendicular f32"),
    (Some(Arithmetic::Rounded(Form::Textbook)), "textbook f32"),
    (Some(Arithmetic::Spu(Form::Perpendicular)), "perpendicular, SPU"),
    (Some(Arithmetic::Spu(Form::Textbook)), "textbook, SPU"),
];

/// What is chosen.
#[derive(Clone, Debug)]
pub struct State {
    /// The plan.
    pub plan: NamedPlan,
    /// Which of the arithmetics.
    arithmetic: usize,
    /// Which of this processor's levels.
    level: usize,
    levels: Vec<Level>,
    /// Workers, at least one.
    pub threads: usize,
    /// What is laid over the picture.
    pub overlays: BTreeSet<Overlay>,
    /// Whether the paper's plan is shown beside the exact one.
    pub wiped: bool,
    /// Where the line between them is, as a part of the picture's width.
    line: f64,
}

impl State {
    /// A plan at a level, with so many workers and nothing laid over.
    #[must_use]
    pub fn new(plan: NamedPlan, level: Level, threads: usize) -> Self {
        let levels = Level::available();
        let at = levels.iter().position(|one| one.name() == level.name()).unwrap_or(0);
        let overlays = BTreeSet::new();
        Self {
            plan,
            arithmetic: 0,
            level: at,
            levels,
            threads: threads.max(1),
            overlays,
            wiped: false,
            line: 0.5,
        }
    }

    /// The plan for a scene. Tiles can only be had with certified arithmetic, so with another one it has blocks.
    #[must_use]
    pub fn plan_for(&self, scene: &Scene) -> Plan {
        let mut plan = chosen(self.plan, scene).plan;
        plan.arithmetic = ARITHMETICS[self.arithmetic].0.unwrap_or(plan.arithmetic);
        if !tiles_are_served(&plan) {
            plan.packet = Packet::Block;
        }
        plan
    }

    /// The level.
    #[must_use]
    pub fn level(&self) -> Level {
        self.levels[self.level]
    }

    /// Plan, and arithmetic if it is not the plan's own, in a few words.
    #[must_use]
    pub fn words(&self) -> String {
        match ARITHMETICS[self.arithmetic].1 {
            "" => self.plan.name().to_owned(),
            own => format!("{}, {own}", self.plan.name()),
        }
    }

    /// The next plan.
    pub fn next_plan(&mut self) {
        let at = NamedPlan::ALL.iter().position(|plan| *plan == self.plan).unwrap_or(0);
        self.plan = NamedPlan::ALL[(at + 1) % NamedPlan::ALL.len()];
    }

    /// The next arithmetic.
    pub fn next_arithmetic(&mut self) {
        self.arithmetic = (self.arithmetic + 1) % ARITHMETICS.len();
    }

    /// The next level, after the widest the plainest.
    pub fn next_level(&mut self) {
        self.level = (self.level + 1) % self.levels.len();
    }

    /// More threads or less, from one to twice as many as there are cores, or four.
    pub fn more_threads(&mut self, by: i32) {
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let most = (2 * cores).max(4);
        let by = isize::try_from(by).unwrap_or(0);
        self.threads = self.threads.saturating_add_signed(by).clamp(1, most.max(self.threads));
    }

    /// Whether an overlay is shown.
    #[must_use]
    pub fn shows(&self, overlay: Overlay) -> bool {
        self.overlays.contains(&overlay)
    }

    /// Shows an overlay or hides it. Cells and culling both colour whole packets, so one takes the other's place.
    pub fn toggle(&mut self, overlay: Overlay) {
        if self.overlays.remove(&overlay) {
            return;
        }
        match overlay {
            Overlay::Cells => _ = self.overlays.remove(&Overlay::Culling),
            Overlay::Culling => _ = self.overlays.remove(&Overlay::Cells),
            _ => {}
        }
        self.overlays.insert(overlay);
    }

    /// Moves the line, within the picture.
    pub fn move_line(&mut self, to: f64) {
        self.line = to.clamp(0.0, 1.0);
    }

    /// Where the line is, as a part of the width.
    #[must_use]
    pub fn line(&self) -> f64 {
        self.line
    }

    /// The first column right of the line in a picture of that width.
    #[must_use]
    pub fn column(&self, width: u32) -> u32 {
        (self.line * f64::from(width)).round() as u32
    }
}
