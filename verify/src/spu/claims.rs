//! The paper's claims, each with a verdict that is computed from surveys of scenes.
//!
//! A claim is a question that each scene answers with yes or no, leaves open if both lie within the model's bracket, or has nothing to
//! say to. Only yes is *confirmed*; no without any yes *refuted*; yes on some and not on others *true under conditions*, with the
//! scenes on either side; only open *undecided*; and nothing at all *not judged*. Where the paper has a word and no number
//! ("rare", "cheap"), the number that stands for it here is in the claim.

use super::cost::{HERTZ, SPUS};
use super::dma::{BYTES_PER_SECOND, Transfer};
use super::host::{Summing, random_slices};
use super::machine::Spu;
use super::predict::Policy;
use super::recorder::{cycles, record};
use super::store::{Buffers, CAPACITY, Map, queue_bytes};
use super::survey::{LoopCost, Survey};
use crate::report::text::wrapped;
use crate::report::words::figure;
use crate::seed::generator;
use optimized::frustum::Slices;
use optimized::grid::{Axis, Bounds, MAX_CELLS};
use optimized::host::Scalar;
use optimized::machine::{LANES, Machine};
use optimized::plan::Loop;
use optimized::queue::{Queue, Queues};
use optimized::walk::{Visitor, walk};
use rand::RngExt;
use serde::Serialize;
use std::fmt;

/// What becomes of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Judgement {
    /// On all scenes that have something to say.
    Confirmed,
    /// Not so on some, and so on none.
    Refuted,
    /// So on some, and on others not, or left open.
    Conditional,
    /// Left open on all.
    Undecided,
    /// No scene has anything to say.
    NotJudged,
}

/// What a scene says to a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It is so.
    Yes,
    /// It is not.
    No,
    /// The model's bracket holds both.
    Open,
    /// The scene does not do what the claim is about.
    Silent,
}

impl From<bool> for Answer {
    fn from(so: bool) -> Self {
        if so { Self::Yes } else { Self::No }
    }
}

impl fmt::Display for Judgement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Confirmed => "confirmed",
            Self::Refuted => "refuted",
            Self::Conditional => "true under conditions",
            Self::Undecided => "undecided",
            Self::NotJudged => "not judged",
        })
    }
}

/// A claim and what was found.
#[derive(Clone, Debug, Serialize)]
pub struct Claim {
    /// The claim.
    pub claim: &'static str,
    /// The verdict.
    pub judgement: Judgement,
    /// The figures.
    pub evidence: String,
}

/// An answer and its figure.
type Figured = (Answer, String);

impl Judgement {
    /// From answers.
    #[must_use]
    pub fn of(answers: &[Answer]) -> Self {
        let [yes, no, open] = [Answer::Yes, Answer::No, Answer::Open].map(|answer| answers.contains(&answer));
        match (yes, no, open) {
            (true, false, false) => Self::Confirmed,
            (true, ..) => Self::Conditional,
            (false, true, _) => Self::Refuted,
            (false, false, true) => Self::Undecided,
            (false, false, false) => Self::NotJudged,
        }
    }
}

/// A claim that scenes answer.
fn asked(claim: &'static str, surveys: &[Survey], question: impl Fn(&Survey) -> Figured) -> Claim {
    let answers: Vec<Figured> = surveys.iter().map(question).collect();
    let judgement = Judgement::of(&answers.iter().map(|(answer, _)| *answer).collect::<Vec<_>>());
    let group = |wanted: Answer, word: &str| {
        let of: Vec<String> = surveys
            .iter()
            .zip(&answers)
            .filter(|(_, (answer, _))| *answer == wanted)
            .map(|(survey, (_, figure))| format!("{} {figure}", survey.scene))
            .collect();
        (!of.is_empty()).then(|| format!("{word}: {}", of.join(", ")))
    };
    let groups = [
        group(Answer::Yes, "yes"),
        group(Answer::No, "no"),
        group(Answer::Open, "open"),
        group(Answer::Silent, "nothing to say"),
    ];
    Claim { claim, judgement, evidence: groups.into_iter().flatten().collect::<Vec<_>>().join("; ") }
}

/// A claim that needs no scene.
fn alone(claim: &'static str, (answer, evidence): Figured) -> Claim {
    Claim { claim, judgement: Judgement::of(&[answer]), evidence }
}

/// All claims, in the order of the paper.
#[must_use]
pub fn claims(surveys: &[Survey], seed: u64) -> Vec<Claim> {
    let mut claims = speed(surveys);
    claims.extend(lists(surveys, seed));
    claims.extend(loops(surveys, seed));
    claims.extend(savings(surveys));
    claims.extend(memory(surveys));
    claims.push(alone("The processor is 35 times an Opteron, as the paper counts operations", peak()));
    claims
}

/// What it does at most, a product and a sum in each of four lanes in every cycle, against the 313 GFlops of which 35 times is said:
/// they are the graphics chip's (GeForce 7800 GTX).
fn peak() -> Figured {
    const GRAPHICS: f64 = 313e9;
    let of = |spus: usize| spus as f64 * 8.0 * HERTZ;
    let times = |flops: f64| figure(35.0 * flops / GRAPHICS);
    let (all, usable) = (of(8), of(SPUS));
    let evidence = format!(
        "{} times with eight SPUs ({} GFlops), {} with the six that can be used; 35 times is the 313 GFlops of the graphics chip",
        times(all),
        figure(all / 1e9),
        times(usable)
    );
    ((35.0 * all / GRAPHICS >= 35.0).into(), evidence)
}

fn percent(part: u64, of: u64) -> f64 {
    if of == 0 { 0.0 } else { 100.0 * part as f64 / of as f64 }
}

/// Whether a bracket lies above a number.
fn above([least, most]: [f64; 2], number: f64) -> Answer {
    if least >= number {
        Answer::Yes
    } else if most < number {
        Answer::No
    } else {
        Answer::Open
    }
}

/// Whether one bracket's bounds are each below the other's.
fn cheaper(one: [f64; 2], other: [f64; 2]) -> Answer {
    match (one[0] < other[0], one[1] < other[1]) {
        (true, true) => Answer::Yes,
        (false, false) => Answer::No,
        _ => Answer::Open,
    }
}

fn rates(survey: &Survey, policy: Policy) -> [f64; 2] {
    survey.rates[policy as usize].frames_per_second
}

fn shown([least, most]: [f64; 2]) -> String {
    format!("{} to {}", figure(least), figure(most))
}

fn speed(surveys: &[Survey]) -> Vec<Claim> {
    let at_least = |claim, wanted, policy| {
        asked(claim, surveys, move |s| {
            let rate = rates(s, policy);
            (above(rate, wanted), shown(rate))
        })
    };
    vec![
        at_least(
            "It is interactive: 30 frames a second at this size on six SPUs, hinted",
            30.0,
            Policy::Hinted,
        ),
        at_least("60 frames a second at this size on six SPUs, hinted", 60.0, Policy::Hinted),
        at_least("60 frames a second at this size on six SPUs, without a hint", 60.0, Policy::Unhinted),
        asked("Voxelizing anew on each SPU is cheap: below 5 % of a frame", surveys, |s| {
            let rate = &s.rates[Policy::Hinted as usize];
            let spus = SPUS as f64;
            let voxelize = rate.stages[0].per_frame.map(|cycles| cycles / spus);
            let share = [0, 1].map(|i| 100.0 * voxelize[i] / rate.frame_cycles[i]);
            let most = share[0].max(share[1]);
            ((most < 5.0).into(), format!("{} %", figure(most)))
        }),
        asked("The picture is that of one loop over all spheres", surveys, |s| {
            (
                (s.picture.wrong == 0).into(),
                format!("{} % wrong", figure(percent(s.picture.wrong, s.picture.hits))),
            )
        }),
    ]
}

fn lists(surveys: &[Survey], seed: u64) -> Vec<Claim> {
    vec![
        asked("No false negatives", surveys, |s| {
            ((s.lists.false_negatives == 0).into(), s.lists.false_negatives.to_string())
        }),
        asked("No false negatives if all spheres are smaller than cells", surveys, |s| {
            let small = s.lists.spanning == 0;
            (
                if small { (s.lists.false_negatives == 0).into() } else { Answer::Silent },
                format!("{} spanning", s.lists.spanning),
            )
        }),
        alone("… whatever the rounding of a sphere's box", rounded_boxes(seed)),
        asked("False positives are rare: below 5 % of what is listed", surveys, |s| {
            let share = percent(s.lists.false_positives, s.lists.ids);
            ((share < 5.0).into(), format!("{} %", figure(share)))
        }),
        asked("Sixteen slots suffice", surveys, |s| {
            ((s.lists.dropped == 0).into(), format!("{} dropped", s.lists.dropped))
        }),
        alone("A push is 6 SIMD logical instructions", push()),
        alone("Eight pushes to equal cells are one if all queues are read first", equal_cells(true)),
        alone("… and also if each is read after the last was written", equal_cells(false)),
    ]
}

/// Spheres about two units in the last place from a plane, their boxes rounded to nearest: how many are not in a cell of theirs.
fn rounded_boxes(seed: u64) -> Figured {
    const BALLS: u64 = 20_000;
    let (mut rng, mut lost) = (generator(seed, 3), 0);
    for _ in 0..BALLS {
        let (lo, width) = (rng.random_range(-8.0..8.0f32), rng.random_range(1.0..16.0f32));
        let axis = Axis::new(Scalar, lo, lo + width, 4);
        let (plane, radius) = (axis.planes[rng.random_range(1..4usize)], rng.random_range(0.01..0.2f32));
        let mut center = if rng.random() { plane + radius } else { plane - radius };
        for _ in 0..rng.random_range(0..3) {
            center = if rng.random() { center.next_up() } else { center.next_down() };
        }
        let bounds = Bounds::nearest([center; 3], radius);
        let cell = |x: f32| axis.cell(Scalar, [x; LANES])[0];
        // In f64 sum and difference of two such numbers are exact.
        let exact = |x: f64| axis.planes[1..4].iter().filter(|plane| f64::from(**plane) <= x).count();
        let (c, r) = (f64::from(center), f64::from(radius));
        let (first, last) =
            (cell(bounds.lo[0]).unsigned_abs() as usize, cell(bounds.hi[0]).unsigned_abs() as usize);
        lost += u64::from(first > exact(c - r) || last < exact(c + r));
    }
    (
        (lost == 0).into(),
        format!("{} % of {BALLS} spheres that touch a plane are lost", figure(percent(lost, BALLS))),
    )
}

/// The tracer's own push onto sixteen queues, in instructions by queue.
fn push() -> Figured {
    let m = Spu(Scalar);
    let empty = || Queues::read(m, &[Queue::EMPTY]);
    let ((), read) = cycles(|| _ = empty());
    let ((), both) = cycles(|| _ = empty().push(m, m.splat_i(1)));
    let instructions = both.even + both.odd - read.even - read.odd;
    let each = instructions as f64 / LANES as f64;
    ((instructions == 6 * LANES as u64).into(), format!("{} a queue, loads and stores apart", figure(each)))
}

/// An id pushed onto the same cell twice, with both queues read before, or one after the other.
fn equal_cells(read_first: bool) -> Figured {
    let push = |queue: &Queue| {
        let all = Queues::read(Scalar, &[*queue, *queue]).push(Scalar, Scalar.splat_i(7)).to_array(Scalar);
        [all[0], all[1]]
    };
    let [first, second] = push(&Queue::EMPTY);
    let result = if read_first { second } else { push(&first)[0] };
    let times = result.ids().filter(|id| *id == 7).count();
    ((times == 1).into(), format!("the id is there {times} times"))
}

fn of_kind<'a>(survey: &'a Survey, kind: &str) -> Option<&'a LoopCost> {
    survey.loops.iter().find(|of| of.walk == kind)
}

fn loops(surveys: &[Survey], seed: u64) -> Vec<Claim> {
    let nested = |claim, policy: Policy| {
        asked(claim, surveys, move |s| match of_kind(s, "nested") {
            Some(nested) => {
                let share = 100.0 * nested.policies[policy as usize].per_branch;
                ((share > 50.0).into(), format!("{} %", figure(share)))
            }
            None => (Answer::Silent, String::new()),
        })
    };
    let against = |claim, policy: Policy| {
        asked(claim, surveys, move |s| {
            let cost = |kind, policy: Policy| Some(of_kind(s, kind)?.policies[policy as usize].frame_cycles);
            match (cost("flattened", Policy::Hinted), cost("nested", policy)) {
                (Some(flat), Some(nested)) => {
                    let millions = |cycles: [f64; 2]| shown(cycles.map(|c| c / 1e6));
                    (cheaper(flat, nested), format!("{} for {} Mcycles", millions(flat), millions(nested)))
                }
                _ => (Answer::Silent, String::new()),
            }
        })
    };
    vec![
        alone(
            "The flattened loop as printed visits the cells of the nested loops in their order",
            printed_order(),
        ),
        asked("The flattened loop as printed finds the same picture", surveys, |s| {
            (
                (s.picture.wrong_as_printed == 0).into(),
                format!("{} pixels differ", s.picture.wrong_as_printed),
            )
        }),
        nested("Nested loops mispredict over 50 percent, without hints", Policy::Unhinted),
        nested("… with a hint for each loop", Policy::Hinted),
        asked("The flattened loop with a hint mispredicts once a traversal", surveys, once),
        asked("The flattened loop without a hint mispredicts at every cell but the last", surveys, |s| {
            let site = next_cell(s);
            let right = |[executed, traversals, unhinted, _]: [u64; 4]| unhinted == executed - traversals;
            let answer = site.map_or(Answer::Silent, |site| right(site).into());
            (answer, site.map_or_else(String::new, |[.., unhinted, _]| unhinted.to_string()))
        }),
        alone(
            "The flattened loop alone, hinted, is faster than nested loops without hints, 1 to 3 cells on an axis, no slice empty",
            loop_alone(Policy::Unhinted, seed),
        ),
        alone("… than nested loops with a hint for each loop", loop_alone(Policy::Hinted, seed)),
        against(
            "In a whole frame, flattening, hinted, is faster than nested loops without hints",
            Policy::Unhinted,
        ),
        against("… than nested loops with a hint for each loop", Policy::Hinted),
    ]
}

/// Cycles a cell of the flattened loop, hinted, and of the nested loops under a policy, with nothing done at the cells.
fn loop_alone(policy: Policy, seed: u64) -> Figured {
    let m = Spu(Scalar);
    let slices = random_slices(seed);
    let [flat, nested] =
        [(Loop::Flattened, Policy::Hinted), (Loop::Nested, policy)].map(|(which, policy)| {
            let (visited, tally) = record(|| {
                let mut summing = Summing::new(m);
                slices.iter().for_each(|slices| walk(m, which, slices, &mut summing));
                summing.cells()
            });
            tally.total().bracket(policy).map(|cycles| cycles as f64 / visited as f64)
        });
    (cheaper(flat, nested), format!("{} for {} cycles a cell", shown(flat), shown(nested)))
}

/// Steps, traversals, mispredicts unhinted and hinted of the flattened loop's one branch.
fn next_cell(survey: &Survey) -> Option<[u64; 4]> {
    let flat = of_kind(survey, "flattened")?;
    let site = flat.sites.iter().find(|site| site.site == "NextCell")?;
    let [unhinted, hinted, _] = site.mispredicts;
    Some([site.executed, flat.traversals, unhinted, hinted])
}

fn once(survey: &Survey) -> Figured {
    match next_cell(survey) {
        Some([_, traversals, _, hinted]) => {
            ((hinted == traversals).into(), figure(hinted as f64 / traversals as f64))
        }
        None => (Answer::Silent, String::new()),
    }
}

struct Cells(Vec<[i32; 3]>);

impl Visitor<Scalar> for Cells {
    fn visit(&mut self, slice: usize, j: i32, k: i32, live: bool) {
        if live {
            self.0.push([i32::try_from(slice).unwrap_or(i32::MAX), j, k]);
        }
    }

    fn unfinished(&self, _: usize) -> [bool; LANES] {
        [true; LANES]
    }
}

/// All pairs of slices with bounds from 0 to 2: in how many the loop as printed has the nested loops' order, and their cells.
fn printed_order() -> Figured {
    let bound = |number: i32, digit: u32| number / 3i32.pow(digit) % 3;
    let (mut order, mut set, all) = (0, 0, 3i32.pow(8));
    for number in 0..all {
        let mut slices = Slices {
            count: 2,
            first: [[0; MAX_CELLS]; 2],
            last: [[-1; MAX_CELLS]; 2],
            far: [0.0; MAX_CELLS],
        };
        for (digit, (axis, s)) in (0..).step_by(2).zip([(0, 0), (1, 0), (0, 1), (1, 1)]) {
            (slices.first[axis][s], slices.last[axis][s]) = (bound(number, digit), bound(number, digit + 1));
        }
        let cells = |which| {
            let mut cells = Cells(Vec::new());
            walk(Scalar, which, &slices, &mut cells);
            cells.0
        };
        let (nested, mut printed) = (cells(Loop::Nested), cells(Loop::Printed));
        order += u32::from(nested == printed);
        printed.sort_unstable();
        set += u32::from(nested == printed);
    }
    (
        (i64::from(order) == i64::from(all)).into(),
        format!("the order of {order} and the cells of {set} of {all} pairs of slices"),
    )
}

fn savings(surveys: &[Survey]) -> Vec<Claim> {
    vec![
        asked("Culling cuts tests 4 to 8 times", surveys, |s| {
            let factor = s.culling.factor;
            (
                factor.map_or(Answer::Silent, |f| (4.0..=8.0).contains(&f).into()),
                factor.map_or_else(String::new, figure),
            )
        }),
        asked("Culling saves cycles", surveys, |s| {
            let gain = 100.0 * (1.0 - s.culling.cycles_with[1] / s.culling.cycles_without[1]);
            (cheaper(s.culling.cycles_with, s.culling.cycles_without), format!("{} %", figure(gain)))
        }),
        asked("No mailbox is needed: it would cost more than it saves", surveys, |s| {
            let saved = s.mailbox.saved.map(|share| 100.0 * share);
            // The bounds of what is saved are those of two costs, not of one.
            let answer = cheaper(saved, [0.0; 2]);
            (
                answer,
                format!(
                    "{} % saved, {} % repeats",
                    shown(saved),
                    figure(percent(s.mailbox.repeats, s.mailbox.fetched))
                ),
            )
        }),
    ]
}

fn memory(surveys: &[Survey]) -> Vec<Claim> {
    let fits = |claim, of: fn(&Survey) -> Map| {
        asked(claim, surveys, move |s| {
            let map = of(s);
            ((map.fits().is_ok()).into(), format!("{} of {CAPACITY}", map.total()))
        })
    };
    let mut claims = vec![
        fits("Scene, grid and program fit into a local store, with one pixel buffer", |s| s.store),
        fits("… with two", |s| s.store_double),
    ];
    if let Some(first) = surveys.first() {
        let most =
            Map::new(first.store.code, queue_bytes(16), 0, first.size[0], 16, Buffers::Single).most_spheres();
        claims.push(alone(
            "Several hundred to a few thousand spheres (3,000) fit beside 16x16x16 cells",
            ((most >= 3000).into(), format!("{most} at most, with their colours")),
        ));
    }
    let grid = queue_bytes(16);
    claims.push(alone(
        "A grid of 16x16x16 cells takes half of the local store",
        ((2 * grid == CAPACITY).into(), format!("{grid} of {CAPACITY} bytes")),
    ));
    let transfers = Transfer::new(0, 20_480).map(|transfer| transfer.transfers);
    claims.push(alone(
        "A block of scanlines, 20,480 bytes, is one transfer",
        (
            transfers.map_or(Answer::Silent, |n| (n == 1).into()),
            transfers.map_or_else(|e| e.to_string(), |n| format!("{n} transfers")),
        ),
    ));
    claims.push(asked(
        "Memory is what limits the frame rate: transfers are half of a frame or more",
        surveys,
        |s| {
            let rate = &s.rates[Policy::Hinted as usize];
            let dma = rate.stages.iter().find(|stage| stage.stage == "DMA").map(|stage| stage.per_frame);
            let share = dma.map(|dma| 100.0 * dma[1] / SPUS as f64 / rate.frame_cycles[0]);
            let pixels = f64::from(s.size[0]) * f64::from(s.size[1]) * 4.0 * 60.0;
            let line = 100.0 * pixels / BYTES_PER_SECOND;
            let words = |share| {
                format!(
                    "{} % at most; 60 pictures a second are {} % of the memory's rate",
                    figure(share),
                    figure(line)
                )
            };
            (
                share.map_or(Answer::Silent, |share| (share >= 50.0).into()),
                share.map_or_else(String::new, words),
            )
        },
    ));
    claims
}

/// The claims for the terminal.
#[must_use]
pub fn text(claims: &[Claim]) -> String {
    claims
        .iter()
        .map(|Claim { claim, judgement, evidence }| {
            wrapped(&format!("{judgement}: {claim}. [{evidence}]")) + "\n"
        })
        .collect()
}
