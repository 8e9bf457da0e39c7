//! The same loops on this computer: how often are their branches mispredicted? Simulated by Valgrind, which knows no AVX-512 and so is
//! asked at a lower level, and counted by the processor where it has counters.
//!
//! The program runs itself: [`walks`] is what is counted. Of a simulated run only that is, and of a counted one the same run
//! without walks is taken off. What is not there is not available, and never a zero.

use super::machine::Spu;
use super::predict::{LOOP_SITES, Policy};
use super::recorder::record;
use crate::seed::generator;
use optimized::frustum::Slices;
use optimized::grid::MAX_CELLS;
use optimized::host::{Scalar, Work};
use optimized::machine::{Machine, Site};
use optimized::plan::Loop;
use optimized::walk::{Visitor, walk};
use optimized::{Level, host::NoSuchLevel};
use rand::RngExt;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt;
use std::hint::{black_box, select_unpredictable};
use std::path::Path;
use std::process::Command;

/// How the cells are gone through.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub enum Way {
    /// The tracer's nested loops.
    Nested,
    /// One loop on plain numbers whose cases are selected by masks: the compiler may make branches of them, and does.
    Masks,
    /// The same with cases that it is told not to branch on.
    Selected,
    /// The tracer's flattened loop, on lanes.
    Flattened,
}

impl Way {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Nested, Self::Masks, Self::Selected, Self::Flattened];

    /// Its word on a command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Nested => "nested",
            Self::Masks => "masks",
            Self::Selected => "selected",
            Self::Flattened => "flattened",
        }
    }
}

/// Slices of a walk; from 1 to 3 cells on each axis of each.
const SLICES: usize = 16;
/// Different walks that are repeated.
const DIFFERENT: usize = 64;

/// What one walk goes through.
pub(crate) fn random_slices(seed: u64) -> Vec<Slices> {
    let mut rng = generator(seed, 1);
    let mut one = |_| {
        let mut slices = Slices {
            count: SLICES,
            first: [[0; MAX_CELLS]; 2],
            last: [[-1; MAX_CELLS]; 2],
            far: [0.0; MAX_CELLS],
        };
        for axis in 0..2 {
            for s in 0..SLICES {
                slices.first[axis][s] = rng.random_range(0..8);
                slices.last[axis][s] = slices.first[axis][s] + rng.random_range(0..3);
            }
        }
        slices
    };
    (0..DIFFERENT).map(&mut one).collect()
}

/// Sums what it visits, so that no visit can be left out.
#[derive(Clone, Copy, Default)]
struct Sum {
    cells: u64,
    places: u64,
}

impl Sum {
    #[inline(always)]
    fn add(&mut self, slice: usize, j: i32, k: i32) {
        self.cells += 1;
        self.places +=
            black_box(slice as u64 + u64::from(j.unsigned_abs()) * 8 + u64::from(k.unsigned_abs()));
    }
}

pub(crate) struct Summing<M>(pub(crate) M, Sum);

impl<M> Summing<M> {
    /// Nothing visited yet.
    pub(crate) fn new(m: M) -> Self {
        Self(m, Sum::default())
    }

    /// Cells visited.
    pub(crate) fn cells(&self) -> u64 {
        self.1.cells
    }
}

impl<M: Machine> Visitor<M> for Summing<M> {
    #[inline(always)]
    fn visit(&mut self, slice: usize, j: i32, k: i32, _: bool) {
        self.1.add(slice, j, k);
    }

    #[inline(always)]
    fn unfinished(&self, _: usize) -> M::B {
        let m = self.0;
        m.lt(m.splat(0.0), m.splat(1.0))
    }
}

/// Walks so many times by a way at a level, through slices drawn from a seed; cells and a sum of their places.
///
/// # Errors
/// [`NoSuchLevel`] if this processor has it not.
pub fn walks(way: Way, level: &str, times: u64, seed: u64) -> Result<[u64; 2], NoSuchLevel> {
    let level = Level::named(level)?;
    Ok(counted_walks(way, level, times, &random_slices(seed)))
}

/// What a simulated run counts, by its name.
#[inline(never)]
fn counted_walks(way: Way, level: Level, times: u64, slices: &[Slices]) -> [u64; 2] {
    let sum = level.run(Walks { way, times, slices });
    [sum.cells, sum.places]
}

struct Walks<'a> {
    way: Way,
    times: u64,
    slices: &'a [Slices],
}

impl Work for Walks<'_> {
    type Output = Sum;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Sum {
        let mut summing = Summing::new(m);
        for slices in self.slices.iter().cycle().take(usize::try_from(self.times).unwrap_or(usize::MAX)) {
            match self.way {
                Way::Masks => masks(slices, &mut summing.1),
                Way::Selected => selected(slices, &mut summing.1),
                Way::Nested => m.within(
                    #[inline(always)]
                    || walk(m, Loop::Nested, slices, &mut summing),
                ),
                Way::Flattened => m.within(
                    #[inline(always)]
                    || walk(m, Loop::Flattened, slices, &mut summing),
                ),
            }
        }
        summing.1
    }
}

/// All ones if so.
fn mask(so: bool) -> i32 {
    -i32::from(so)
}

/// The flattened loop with masks, for slices none of which is empty.
fn masks(slices: &Slices, sum: &mut Sum) {
    let choose = |mask: i32, yes: i32, no: i32| (mask & yes) | (!mask & no);
    let (mut s, mut j, mut k) = (0, slices.first[0][0], slices.first[1][0]);
    while s < slices.count {
        sum.add(s, j, k);
        let next = (s + 1).min(slices.count - 1);
        let more_k = mask(k < slices.last[1][s]);
        let more_j = mask(j < slices.last[0][s]) & !more_k;
        let more = more_k | more_j;
        k = choose(more_k, k + 1, choose(more_j, slices.first[1][s], slices.first[1][next]));
        j = choose(more_k, j, choose(more_j, j + 1, slices.first[0][next]));
        s += usize::from(more == 0);
    }
}

/// The same, its cases selected.
fn selected(slices: &Slices, sum: &mut Sum) {
    let (mut s, mut j, mut k) = (0, slices.first[0][0], slices.first[1][0]);
    while s < slices.count {
        sum.add(s, j, k);
        let next = (s + 1).min(slices.count - 1);
        let (more_k, more_j) = (k < slices.last[1][s], j < slices.last[0][s]);
        let row = select_unpredictable(more_j, slices.first[1][s], slices.first[1][next]);
        let column = select_unpredictable(more_j, j + 1, slices.first[0][next]);
        k = select_unpredictable(more_k, k + 1, row);
        j = select_unpredictable(more_k, j, column);
        s = select_unpredictable(more_k | more_j, s, s + 1);
    }
}

/// The flattened loop as a compiler likes it, its branches told to the SPU.
fn branching(m: Spu<Scalar>, slices: &Slices) {
    let (mut s, mut j, mut k) = (0, slices.first[0][0], slices.first[1][0]);
    loop {
        if m.branch(k < slices.last[1][s], Site::NextK) {
            k += 1;
        } else if m.branch(j < slices.last[0][s], Site::NextJ) {
            (j, k) = (j + 1, slices.first[1][s]);
        } else {
            s += 1;
            if s < slices.count {
                (j, k) = (slices.first[0][s], slices.first[1][s]);
            }
        }
        if !m.branch(s < slices.count, Site::NextCell) {
            return;
        }
    }
}

/// Branches and mispredicts of loops on the SPU, by policies.
#[derive(Clone, Debug, Serialize)]
pub struct OnModel {
    /// The way.
    pub way: &'static str,
    /// Walks.
    pub walks: u64,
    /// Branches of the loops.
    pub branches: u64,
    /// Mispredicts in the order of [`Policy::ALL`].
    pub mispredicts: [u64; 3],
}

/// The walks that are counted on this computer, on the SPU model: nested, flattened with branches, flattened as intended.
#[must_use]
pub fn on_model(seed: u64) -> [OnModel; 3] {
    let (m, slices) = (Spu(Scalar), random_slices(seed));
    let count = |way, work: &dyn Fn(&Slices)| {
        let ((), tally) = record(|| slices.iter().for_each(work));
        OnModel {
            way,
            walks: slices.len() as u64,
            branches: LOOP_SITES.iter().map(|site| tally.site(*site).executed).sum(),
            mispredicts: Policy::ALL.map(|policy| tally.mispredicts(&LOOP_SITES, policy)),
        }
    };
    [
        count(Way::Nested.name(), &|slices| walk(m, Loop::Nested, slices, &mut Summing::new(m))),
        count("branching", &|slices| branching(m, slices)),
        count(Way::Flattened.name(), &|slices| walk(m, Loop::Flattened, slices, &mut Summing::new(m))),
    ]
}

/// What was counted of one way.
#[derive(Clone, Debug, Serialize)]
pub struct Counted {
    /// The way.
    pub way: &'static str,
    /// Walks.
    pub walks: u64,
    /// Cells visited.
    pub cells: u64,
    /// Conditional branches, and mispredicts of them.
    pub branches: [u64; 2],
}

/// What can be counted on this computer.
#[derive(Clone, Debug, Serialize)]
pub struct OnHost {
    /// The level of the walks.
    pub level: String,
    /// On the SPU model, the same walks.
    pub model: [OnModel; 3],
    /// By Valgrind's predictor; none with the reason.
    pub simulated: Result<Vec<Counted>, String>,
    /// By the processor's counters; none with the reason.
    pub counters: Result<Vec<Counted>, String>,
}

/// For the terminal.
impl fmt::Display for OnHost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "mispredicts a walk on the SPU model, {}:", Policy::ALL.map(Policy::name).join(", "))?;
        for OnModel { way, walks, branches, mispredicts } in &self.model {
            let [a, b, c] = mispredicts.map(|n| n as f64 / *walks as f64);
            let all = *branches as f64 / *walks as f64;
            writeln!(f, "  {way:<10} {a:.2}, {b:.2}, {c:.2} of {all:.1} branches of the loop")?;
        }
        for (how, counts) in
            [("Valgrind's predictor", &self.simulated), ("the processor's counters", &self.counters)]
        {
            match counts {
                Err(why) => writeln!(f, "mispredicts by {how}: not available: {why}")?,
                Ok(counts) => {
                    writeln!(f, "mispredicts by {how}, at {}:", self.level)?;
                    for Counted { way, walks, cells, branches: [all, missed] } in counts {
                        let by = |n: u64| *missed as f64 / n as f64;
                        writeln!(
                            f,
                            "  {way:<10} {walks} walks, {cells} cells, {all} branches, {missed} mispredicts: {:.2} a walk, {:.3} a cell, {:.1} %",
                            by(*walks),
                            by(*cells),
                            100.0 * by(*all)
                        )?;
                    }
                }
            }
        }
        Ok(())
    }
}

/// The best level that Valgrind knows.
#[must_use]
pub fn simulated_level() -> &'static str {
    let names: Vec<_> = Level::available().iter().map(|level| level.name()).collect();
    ["avx2", "sse4.2", "sse2"].into_iter().find(|name| names.contains(name)).unwrap_or("scalar")
}

/// Counts all ways, by a program that walks when it is told `spu --walk WAY:LEVEL:WALKS`.
#[must_use]
pub fn on_host(program: &Path, times: u64) -> OnHost {
    let level = simulated_level();
    let counted = |way: Way, count: fn(&Path, &str, u64) -> Result<[u64; 2], String>| {
        let word = |times| format!("{}:{level}:{times}", way.name());
        let [cells, _] = walks(way, level, times, SEED).map_err(|error| error.to_string())?;
        let branches = count(program, &word(times), times)?;
        Ok(Counted { way: way.name(), walks: times, cells, branches })
    };
    OnHost {
        level: level.into(),
        model: on_model(SEED),
        // Side by side, which changes no count; the processor's counters would notice.
        simulated: Way::ALL.into_par_iter().map(|way| counted(way, simulate)).collect(),
        counters: Way::ALL.into_iter().map(|way| counted(way, read_counters)).collect(),
    }
}

/// Of the slices: a program's walks are the same in every run.
pub const SEED: u64 = 2007;

/// Runs a command; what it wrote to its two outputs.
fn said(command: &mut Command) -> Result<[String; 2], String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    if output.status.success() {
        Ok([out, err])
    } else {
        Err(format!("{name} ended with {}: {err}", output.status))
    }
}

fn simulate(program: &Path, word: &str, _: u64) -> Result<[u64; 2], String> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let file = folder.path().join("counts");
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--branch-sim=yes", "--toggle-collect=*counted_walks*"]);
    command.arg(format!("--callgrind-out-file={}", file.display())).arg(program);
    said(command.args(["spu", "--walk", word]))?;
    let text = std::fs::read_to_string(&file).map_err(|error| error.to_string())?;
    totals(&text).ok_or_else(|| "valgrind wrote no counts of branches".into())
}

/// Conditional branches and their mispredicts, from the file that callgrind writes.
fn totals(text: &str) -> Option<[u64; 2]> {
    let line = |name: &str| text.lines().rev().find_map(|line| line.strip_prefix(name));
    let events: Vec<_> = line("events:")?.split_whitespace().collect();
    let counts: Vec<u64> =
        line("totals:")?.split_whitespace().map(|n| n.parse().ok()).collect::<Option<_>>()?;
    let of = |event: &str| counts.get(events.iter().position(|name| *name == event)?).copied();
    let branches = [of("Bc")?, of("Bcm")?];
    (branches[0] > 0).then_some(branches)
}

fn read_counters(program: &Path, word: &str, times: u64) -> Result<[u64; 2], String> {
    // So many more that the rest of the program hardly counts, and what is left of it is taken off.
    let idle = word.replace(&format!(":{times}"), ":0");
    let count = |word: &str| {
        let mut command = Command::new("perf");
        command.args(["stat", "-x", ",", "-e", "branches:u,branch-misses:u", "--"]).arg(program);
        let [_, text] = said(command.args(["spu", "--walk", word]))?;
        counters(&text).ok_or_else(|| "perf says that the processor has no such counters".to_owned())
    };
    let ([all, missed], [idle, missed_idle]) = (count(word)?, count(&idle)?);
    Ok([all.saturating_sub(idle), missed.saturating_sub(missed_idle)])
}

/// From perf's lines of values with commas; a counter that is not there has words in place of a number.
fn counters(text: &str) -> Option<[u64; 2]> {
    let of = |event: &str| {
        let line = text.lines().find(|line| line.contains(event))?;
        line.split(',').next()?.parse().ok()
    };
    Some([of("branches")?, of("branch-misses")?])
}
