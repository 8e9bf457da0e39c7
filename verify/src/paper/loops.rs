//! The loops over cells: which cells, in which order, and with how many mispredicts.

use super::cases::PRINTED;
use super::{Answer, Figured, Looked, PaperClaim, Proof, STEP, alone, asked, cheaper, shown};
use crate::figures::loops::visited;
use crate::prove::prover::Finding;
use crate::report::Evidence;
use crate::report::words::figure;
use crate::spu::host::{Summing, random_slices};
use crate::spu::machine::Spu;
use crate::spu::predict::{Policy, SITES};
use crate::spu::recorder::record;
use crate::spu::survey::{LoopCost, Survey};
use optimized::frustum::Slices;
use optimized::grid::MAX_CELLS;
use optimized::host::Scalar;
use optimized::machine::Machine;
use optimized::plan::Loop;
use optimized::walk::{Cursor, Rectangle, step, walk};

pub(super) fn claims(looked: &[Looked], said: &[Finding], seed: u64) -> Vec<PaperClaim> {
    let nested = |claim, policy: Policy| {
        asked(claim, Evidence::Measured, looked, move |look| {
            let nested = of_kind(&look.survey, "nested");
            match nested.and_then(|nested| nested.policies[policy as usize].per_branch) {
                Some(share) => ((share > 0.5).into(), format!("{} %", figure(100.0 * share))),
                None => (Answer::Silent, String::new()),
            }
        })
    };
    let against = |claim, policy: Policy| {
        asked(claim, Evidence::Measured, looked, move |look| {
            let cost = |kind, policy: Policy| {
                Some(of_kind(&look.survey, kind)?.policies[policy as usize].frame_cycles)
            };
            match (cost("flattened", Policy::Hinted), cost("nested", policy)) {
                (Some(flat), Some(nested)) => {
                    let millions = |cycles: [f64; 2]| shown(cycles.map(|c| c / 1e6));
                    (cheaper(flat, nested), format!("{} for {} Mcycles", millions(flat), millions(nested)))
                }
                _ => (Answer::Silent, String::new()),
            }
        })
    };
    let mended = Proof::of(STEP, said);
    vec![
        alone(
            "The flattened loop as printed visits the cells of the nested loops in their order",
            Evidence::Exhausted,
            printed_order(),
        )
        .against(smallest_printed())
        .by(mended.command.clone()),
        asked("The flattened loop as printed finds the same picture", Evidence::Sampled, looked, |look| {
            let wrong = look.survey.picture.wrong_as_printed;
            ((wrong == 0).into(), format!("{wrong} pixels differ"))
        })
        .against(PRINTED.told()),
        alone(
            "One loop can visit the cells of the nested loops in their order (mended: each slice's own bounds, k innermost, no empty slice)",
            mended.or(Evidence::Exhausted),
            (mended.and(mended_order()), mended.figure),
        )
        .by(mended.command),
        alone("The three cases of its step are computed and selected without a branch", Evidence::Measured, branches_of_a_step()),
        nested("Nested loops mispredict over 50 percent, without hints", Policy::Unhinted),
        nested("Nested loops mispredict over 50 percent with a hint for each loop", Policy::Hinted),
        asked("The flattened loop with a hint mispredicts once a traversal", Evidence::Measured, looked, |look| {
            once(&look.survey)
        }),
        asked(
            "The flattened loop without a hint mispredicts at every cell but the last",
            Evidence::Measured,
            looked,
            |look| {
                let site = next_cell(&look.survey);
                let right = |[executed, traversals, unhinted, _]: [u64; 4]| unhinted == executed - traversals;
                let answer = site.map_or(Answer::Silent, |site| right(site).into());
                (answer, site.map_or_else(String::new, |[.., unhinted, _]| unhinted.to_string()))
            },
        ),
        alone(
            "The flattened loop alone, hinted, is faster than nested loops without hints, 1 to 3 cells on an axis, no slice empty",
            Evidence::Measured,
            loop_alone(Policy::Unhinted, seed),
        ),
        alone(
            "… than nested loops with a hint for each loop",
            Evidence::Measured,
            loop_alone(Policy::Hinted, seed),
        ),
        against(
            "In a whole frame, flattening, hinted, is faster than nested loops without hints",
            Policy::Unhinted,
        ),
        against("… than nested loops with a hint for each loop", Policy::Hinted),
    ]
}

fn of_kind<'a>(survey: &'a Survey, kind: &str) -> Option<&'a LoopCost> {
    survey.loops.iter().find(|of| of.walk == kind)
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

/// The shipped step on the model: its instructions, and the branches among them.
fn branches_of_a_step() -> Figured {
    let m = Spu(Scalar);
    let ((), tally) = record(|| {
        let two = || [m.splat_i(0), m.splat_i(1)];
        let rectangle = || Rectangle { first: two(), last: two() };
        let at = Cursor { slice: m.splat_i(0), j: m.splat_i(0), k: m.splat_i(0) };
        step(m, at, &rectangle(), &rectangle());
    });
    let (booked, branches) =
        (tally.total(), SITES.iter().map(|site| tally.site(*site).executed).sum::<u64>());
    ((branches == 0).into(), format!("{} instructions, {branches} branches", booked.even + booked.odd))
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

/// Slices with those bounds: first and last j, first and last k.
fn slices(bounds: &[[i32; 4]]) -> Slices {
    let mut slices = Slices {
        count: bounds.len(),
        first: [[0; MAX_CELLS]; 2],
        last: [[-1; MAX_CELLS]; 2],
        far: [0.0; MAX_CELLS],
    };
    for (s, [first_j, last_j, first_k, last_k]) in bounds.iter().enumerate() {
        (slices.first[0][s], slices.last[0][s]) = (*first_j, *last_j);
        (slices.first[1][s], slices.last[1][s]) = (*first_k, *last_k);
    }
    slices
}

/// All pairs of slices with bounds from 0 to 2, empty ones among them.
fn pairs() -> impl Iterator<Item = Slices> {
    let bound = |number: i32, digit: u32| number / 3i32.pow(digit) % 3;
    (0..3i32.pow(8)).map(move |number| {
        let of = |first: u32| [0, 1, 4, 5].map(|digit| bound(number, first + digit));
        slices(&[of(0), of(2)])
    })
}

/// In how many of them the loop as printed has the nested loops' order, and their cells.
fn printed_order() -> Figured {
    let (mut order, mut set, mut all) = (0, 0, 0);
    for slices in pairs() {
        let (nested, mut printed) = (visited(Loop::Nested, &slices), visited(Loop::Printed, &slices));
        order += u32::from(nested == printed);
        printed.sort_unstable();
        set += u32::from(nested == printed);
        all += 1;
    }
    ((order == all).into(), format!("the order of {order} and the cells of {set} of {all} pairs of slices"))
}

/// Whether the mended loop has their order in all of them.
fn mended_order() -> Answer {
    pairs().all(|slices| visited(Loop::Nested, &slices) == visited(Loop::Flattened, &slices)).into()
}

/// The fewest cells of one slice in which the printed loop leaves the nested loops' order.
fn smallest_printed() -> Option<String> {
    let sides = (1..=3).flat_map(|j| (1..=3).map(move |k| [j, k]));
    let wrong = |[j, k]: &[i32; 2]| {
        let slice = slices(&[[0, j - 1, 0, k - 1]]);
        visited(Loop::Nested, &slice) != visited(Loop::Printed, &slice)
    };
    let [j, k] = sides.filter(wrong).min_by_key(|[j, k]| j * k)?;
    let slice = slices(&[[0, j - 1, 0, k - 1]]);
    let path = |which| {
        let cells = visited(which, &slice);
        cells.iter().map(|[_, j, k]| format!("{j}{k}")).collect::<Vec<_>>().join(" ")
    };
    Some(format!(
        "one slice of {j}x{k} cells: {} nested, {} as printed",
        path(Loop::Nested),
        path(Loop::Printed)
    ))
}
