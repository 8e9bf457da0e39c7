//! Does the SPU model count what can be counted by hand, and do its machine's pictures have the bits of the host's?
//!
//! Cycle counts of short sequences are written out instruction by instruction; mispredicts of nested loops are held against their
//! closed form; random kernels must keep the two bounds in order.

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Size, Sphere};
use optimized::frustum::Slices;
use optimized::grid::{Bounds, Grid, MAX_CELLS};
use optimized::host::Scalar;
use optimized::machine::{Chore, LANES, Machine, Site, Stage};
use optimized::plan::{Culling, Loop, Resolution, Voxelizer};
use optimized::walk::{Cursor, Rectangle, Visitor, step, walk};
use optimized::{Event, Events, Level, Plan, Tracer};
use rand::{Rng, RngExt};
use std::collections::BTreeSet;
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::{count, generator, seed};
use verify::spu::Spu;
use verify::spu::cost::{dealt, frame_cost};
use verify::spu::dma::{Transfer, TransferError};
use verify::spu::host::{SEED, Way, on_model, walks};
use verify::spu::isa::{Class, Op, Pipe};
use verify::spu::machine::Lanes;
use verify::spu::model::{Measured, measure_nearest};
use verify::spu::pipeline::Pipeline;
use verify::spu::predict::{LOOP_SITES, Policy, Predictor, SITES};
use verify::spu::recorder::{Booked, STAGES, Tally, cycles, record};
use verify::spu::sequence::{Operand, TABLE};
use verify::spu::store::{Buffers, CAPACITY, LocalStoreFull, Map, code_bytes, queue_bytes};
use verify::spu::survey::{Gain, Input, Lists, Mailbox, Picture, Rate, SurveyError, survey};
use verify::spu::text::{capacity, text};
use verify::visible::listed;

const M: Spu<Scalar> = Spu(Scalar);

/// Work by hand: what it must come to on both clocks, without mispredicts, and when its result can be used.
fn by_hand<T>(name: &str, work: impl FnOnce() -> Lanes<T>, [even, odd]: [u64; 2], in_order: u64, ready: u64) {
    let (result, booked) = cycles(work);
    eprintln!("{name}: {booked:?}, usable from {:?}", result.ready());
    assert_eq!([booked.even, booked.odd], [even, odd], "{name}: instructions on the even and the odd pipe");
    assert_eq!(booked.issue_bound(Policy::Unhinted), even.max(odd), "{name}: issue bound");
    assert_eq!(booked.dependence_bound(Policy::Unhinted), in_order, "{name}: dependence bound");
    assert_eq!(result.ready().into_iter().max(), Some(ready), "{name}: result");
}

/// The class, pipe and latency of the published table, written here a second time.
#[test]
fn pipes_and_latencies_are_the_published_ones() {
    let published = [
        (Class::Float, Pipe::Even, 6),
        (Class::Convert, Pipe::Even, 7),
        (Class::Fixed, Pipe::Even, 2),
        (Class::Shift, Pipe::Even, 4),
        (Class::Memory, Pipe::Odd, 6),
        (Class::Shuffle, Pipe::Odd, 4),
        (Class::Branch, Pipe::Odd, 4),
        (Class::Hint, Pipe::Odd, 15),
        (Class::Channel, Pipe::Odd, 6),
    ];
    assert_eq!(published.map(|(class, ..)| class), Class::ALL);
    for (class, pipe, latency) in published {
        assert_eq!((class.pipe(), class.latency()), (pipe, latency), "{class:?}");
    }
    for (op, class) in [
        (Op::Fma, Class::Float),
        (Op::Fi, Class::Convert),
        (Op::Csflt, Class::Convert),
        (Op::Selb, Class::Fixed),
        (Op::Fcgt, Class::Fixed),
        (Op::Shl, Class::Shift),
        (Op::Lqx, Class::Memory),
        (Op::Frsqest, Class::Shuffle),
        (Op::Gb, Class::Shuffle),
        (Op::Brnz, Class::Branch),
    ] {
        assert_eq!(op.class(), class, "{op:?}");
    }
}

/// Sites are numbered as they are listed.
#[test]
fn every_site_has_its_place() {
    for (index, site) in SITES.into_iter().enumerate() {
        assert_eq!(site as usize, index, "{site:?}");
    }
    assert_eq!(Site::NextSphere as usize, SITES.len() - 1, "the last site of the trait");
}

/// Every sequence names only operands that it has, earlier ones, and its chain is what its latencies make it.
#[test]
fn sequences_are_well_formed() {
    for (name, sequence) in TABLE {
        for (at, (_, operands)) in sequence.iter().enumerate() {
            let earlier = operands.iter().all(|from| match from {
                Operand::In(i) => *i < 3,
                Operand::Step(i) => *i < at,
            });
            assert!(earlier, "{name}: instruction {at}");
        }
    }
    // Every operand of an operation is waited for.
    let one = ["sqrt", "neg", "not", "shl_16", "shr_16", "floor", "truncate"];
    let two = ["add", "sub", "mul", "div", "lt", "le", "lt_i", "and", "or, or_i", "add_i"];
    let three = ["select, select_i"];
    let mut judged = 0;
    for (names, arity) in [(&one[..], 1), (&two, 2), (&three, 3)] {
        for (name, sequence) in TABLE.into_iter().filter(|(name, _)| names.contains(name)) {
            for i in 0..arity {
                let waits = sequence.iter().any(|(_, operands)| operands.contains(&Operand::In(i)));
                assert!(waits, "{name}: operand {i}");
            }
            judged += 1;
        }
    }
    assert_eq!(judged, one.len() + two.len() + three.len());
    // The published chain of GCC's inline square root.
    let chain = |name| {
        let (_, sequence) = TABLE.into_iter().find(|(n, _)| *n == name).expect("it is in the table");
        let mut ready = Vec::new();
        for (op, operands) in sequence {
            let from =
                operands.iter().map(|from| if let Operand::Step(i) = from { ready[*i] } else { 0 }).max();
            ready.push(from.unwrap_or(0) + op.class().latency());
        }
        ready.last().copied()
    };
    assert_eq!([chain("sqrt"), chain("div")], [Some(29), Some(29)]);
}

/// One quadword, two additions of which one needs the other:
///
/// ```text
/// even  0 fa    result at 6
///       6 fa    result at 12        7 cycles
/// ```
#[test]
fn a_chain_of_two_additions() {
    let work = || {
        let x = M.splat(1.0);
        let y = M.add(x, x);
        M.add(y, y)
    };
    by_hand("two additions", work, [2, 0], 7, 12);
}

/// Sixteen lanes and sixteen others from memory, added:
///
/// ```text
/// odd   0..3  lqx x    usable at 6, 7, 8, 9
///       4..7  lqx y    usable at 10, 11, 12, 13
/// even  10 fa, 11 fa, 12 fa, 13 fa    usable at 16..19        14 cycles, 8 on the odd pipe
/// ```
#[test]
fn sixteen_sums_from_memory() {
    by_hand("sums", || M.add(M.lanes([1.0; LANES]), M.lanes([2.0; LANES])), [4, 8], 14, 19);
}

/// A quotient, every instruction waiting for the one before:
///
/// ```text
/// odd   0 frest    usable at 4
/// even  4 fi       at 11
///       11 fm      at 17
///       17 fnms    at 23
///       23 fma     at 29        24 cycles
/// ```
#[test]
fn a_quotient() {
    by_hand("a quotient", || M.div(M.splat(1.0), M.splat(3.0)), [4, 1], 24, 29);
}

/// A root; half the estimate is made while x times it is waited for:
///
/// ```text
/// odd   0 frsqest    usable at 4
/// even  4 fi         at 11
///       11 fm s      at 17
///       12 fm y/2    at 18
///       17 fnms      at 23
///       23 fma       at 29        24 cycles
/// ```
#[test]
fn a_root() {
    by_hand("a root", || M.sqrt(M.splat(2.0)), [5, 1], 24, 29);
}

/// Sixteen lanes compared, and a branch if any is below zero:
///
/// ```text
/// odd   0..3 lqx                  usable at 6, 7, 8, 9
/// even  6, 7, 8, 9 fcgt           at 8, 9, 10, 11
///       10 or a b                 at 12 (a pipe takes one a cycle)
///       11 or c d                 at 13
///       13 or                     at 15
/// odd   15 gb                     at 19
///       19 brnz                   20 cycles; 7 on the even pipe, 6 on the odd
/// ```
///
/// Not taken it costs that; taken it is a mispredict under every policy, since sphere hits are never hinted: 18 more.
#[test]
fn a_branch_if_any() {
    for (x, mispredicts) in [(1.0, 0), (-1.0, 1)] {
        let (taken, tally) = record(|| M.any(M.lt(M.lanes([x; LANES]), M.splat(0.0)), Site::Sphere));
        let booked = tally.total();
        eprintln!("a branch, taken: {taken}: {booked:?}");
        assert_eq!((taken, booked.even, booked.odd), (mispredicts == 1, 7, 6));
        for policy in Policy::ALL {
            assert_eq!(booked.bracket(policy), [7 + 18 * mispredicts, 20 + 18 * mispredicts], "{policy:?}");
        }
    }
}

/// The flattened loop's step, all of it on one quadword and on the even pipe, 17 instructions:
///
/// ```text
/// some    0 cgt, 1 cgt, 3 or, 5 nor           usable at 7
/// more_k  6 cgt, 8 and                        at 10
/// more_j  9 cgt, 11 and                       at 13
/// more    13 or                               at 15
/// k       14 selb                             at 16
/// j       15 a, 17 selb                       at 19
/// slice   18 a, 20 selb                       at 22
/// j       21 selb                             at 23
/// k       22 a, 24 selb                       at 26        25 cycles
/// ```
#[test]
fn the_step_of_the_flattened_loop() {
    let work = || {
        let n = |x| M.splat_i(x);
        let at = Cursor { slice: n(3), j: n(0), k: n(0) };
        let rectangle = || Rectangle { first: [n(0), n(0)], last: [n(1), n(1)] };
        let next = step(M, at, &rectangle(), &rectangle());
        assert_eq!([next.slice, next.j, next.k].map(|x| x.value[0]), [3, 0, 1]);
        next.k
    };
    by_hand("the step", work, [17, 0], 25, 26);
}

/// Every operand of an operation is waited for: one that comes late makes its result late. A quotient asks for its dividend 11
/// cycles after its divisor, and on a machine that issues in order nothing is so late any more.
#[test]
fn every_operand_is_waited_for() {
    type F = Lanes<[f32; LANES]>;
    type I = Lanes<[i32; LANES]>;
    type B = Lanes<[bool; LANES]>;
    /// Its name, how many operands it has, and when its result can be used.
    type Operation<T> = (&'static str, usize, fn([T; 3]) -> u64);
    let numbers: [Operation<F>; 11] = [
        ("add", 2, |[x, y, _]| M.add(x, y).ready()[0]),
        ("sub", 2, |[x, y, _]| M.sub(x, y).ready()[0]),
        ("mul", 2, |[x, y, _]| M.mul(x, y).ready()[0]),
        ("div, its divisor", 1, |[x, y, _]| M.div(y, x).ready()[0]),
        ("sqrt", 1, |[x, ..]| M.sqrt(x).ready()[0]),
        ("neg", 1, |[x, ..]| M.neg(x).ready()[0]),
        ("floor", 1, |[x, ..]| M.floor(x).ready()[0]),
        ("truncate", 1, |[x, ..]| M.truncate(x).ready()[0]),
        ("smallest", 1, |[x, ..]| M.smallest(x).ready()[0]),
        ("lt", 2, |[x, y, _]| M.lt(x, y).ready()[0]),
        ("le", 2, |[x, y, _]| M.le(x, y).ready()[0]),
    ];
    let integers: [Operation<I>; 5] = [
        ("lt_i", 2, |[x, y, _]| M.lt_i(x, y).ready()[0]),
        ("add_i", 2, |[x, y, _]| M.add_i(x, y).ready()[0]),
        ("or_i", 2, |[x, y, _]| M.or_i(x, y).ready()[0]),
        ("shl_16", 1, |[x, ..]| M.shl_16(x).ready()[0]),
        ("shr_16", 1, |[x, ..]| M.shr_16(x).ready()[0]),
    ];
    let masks: [Operation<B>; 3] = [
        ("and", 2, |[x, y, _]| M.and(x, y).ready()[0]),
        ("or", 2, |[x, y, _]| M.or(x, y).ready()[0]),
        ("not", 1, |[x, ..]| M.not(x).ready()[0]),
    ];
    // The late one is an estimate's last step; it is made in any case, and used or not.
    let two_numbers = || (M.splat(2.0), M.sqrt(M.splat(2.0)));
    let two_integers = || (M.splat_i(2), M.truncate(M.sqrt(M.splat(2.0))));
    let two_masks = || {
        let (early, late) = (M.le(M.splat(1.0), M.splat(2.0)), M.sqrt(M.splat(2.0)));
        (early, M.le(late, late))
    };
    let mut judged = 0;
    let mut judge = |name: &str, i: usize, [late, early]: [u64; 2]| {
        eprintln!("{name}: usable at {late} with a late operand {i}, else at {early}");
        assert!(late > early, "{name}: operand {i} is not waited for");
        judged += 1;
    };
    fn pair<T: Copy>(two: impl Fn() -> (T, T), op: fn([T; 3]) -> u64, i: usize) -> [u64; 2] {
        [true, false].map(|is_late| {
            let work = || {
                let (early, late) = two();
                let mut operands = [early; 3];
                if is_late {
                    operands[i] = late;
                }
                op(operands)
            };
            cycles(work).0
        })
    }
    for (name, arity, op) in numbers {
        (0..arity).for_each(|i| judge(name, i, pair(two_numbers, op, i)));
    }
    for (name, arity, op) in integers {
        (0..arity).for_each(|i| judge(name, i, pair(two_integers, op, i)));
    }
    for (name, arity, op) in masks {
        (0..arity).for_each(|i| judge(name, i, pair(two_masks, op, i)));
    }
    // Selections have operands of two kinds.
    let choose = |[b, ..]: [B; 3]| M.select(b, M.splat(1.0), M.splat(2.0)).ready()[0];
    let choose_i = |[b, ..]: [B; 3]| M.select_i(b, M.splat_i(1), M.splat_i(2)).ready()[0];
    judge("select, its mask", 0, pair(two_masks, choose, 0));
    judge("select_i, its mask", 0, pair(two_masks, choose_i, 0));
    fn yes() -> B {
        M.le(M.splat(1.0), M.splat(2.0))
    }
    for i in 0..2 {
        let of = |[x, y, _]: [F; 3]| M.select(yes(), x, y).ready()[0];
        let of_i = |[x, y, _]: [I; 3]| M.select_i(yes(), x, y).ready()[0];
        judge("select", i, pair(two_numbers, of, i));
        judge("select_i", i, pair(two_integers, of_i, i));
    }
    assert_eq!(judged, 16 + 8 + 5 + 6, "operands of numbers, integers, masks and selections");
}

/// Chores by hand: instructions on the even and the odd pipe, and when all of it can be used. Of sixteen or of several, each
/// instruction is issued for all of them before the next one:
///
/// ```text
/// a cell       0, 1, 2 shl at 4, 5, 6; 5 a at 7; 7 a at 9; 9, 10 lqx at 15, 16
/// a sphere     0 rotqby at 4; 4 and at 6; 6 shl at 10; 10 lqx at 16; 16..19 shufb at 20..23
/// its form     0, 1 fm at 6, 7; 7 fma at 13; 13 fma at 19; 19 fs at 25
/// a rectangle  0 lqx at 6; 6..8 rotqby at 10..12
/// an entry     0 lqx at 6; 6 rotqby at 10; 10 a at 12; 12 shufb at 16; 16 stqx at 22
/// an owner     0 rotqby at 4; 4 shl at 8; 8, 9 lqx at 14, 15; 15 shufb at 19; 19 csflt at 26, beside it
///              19..22 shufb at 23..26; 26..28 shufb at 30..32
/// pixels       0..3 shufb at 4..7; 4..7 shufb at 8..11
/// emptied      0..4 stqx at 6..10
/// distances    0..7 lqx at 6..13; 7..10 fs at 13..16; 11..14 fs at 17..20; 14..17 stqx at 20..23; 18..21 stqx at 24..27
/// a push       0 shl at 4; 4 a at 6; 6..8 a at 8..10, beside the last 8 shufb at 12; 12..19 rotqby; 20..35 lqx, the last at 41;
///              41..56 shufb, the last at 60; 60..75 stqx, the last at 81
/// boxes        0..15 lqx; 15..30 fs; 30..45 stqx; 46..61 shufb; 62..77 shufb, the last at 81; 78..101 fs and fa, the last at 107;
///              102..125 fcgt; 126..149 selb, the last at 151
/// ```
#[test]
fn chores_by_hand() {
    for (chore, [even, odd], ready) in [
        (Chore::Cell { slice: 0, j: 0, k: 0, live: true }, [5, 2], 16),
        (Chore::Sphere(0), [2, 6], 23),
        (Chore::Invariants, [5, 0], 25),
        (Chore::Rectangle, [0, 4], 12),
        (Chore::Entry, [1, 4], 22),
        (Chore::Owner, [2, 11], 32),
        (Chore::Pixels, [0, 8], 11),
        (Chore::Clear(5), [0, 5], 10),
        (Chore::Distances(16), [8, 16], 27),
        (Chore::Distances(13), [8, 16], 27),
        (Chore::Push(8), [5, 57], 81),
        // Straight-line code pushes all eight.
        (Chore::Push(3), [5, 57], 81),
        (Chore::Boxes, [88, 64], 151),
        (Chore::Packet, [0, 0], 0),
        (Chore::Block([4, 8]), [0, 0], 0),
        (Chore::Settled { marked: 6, only_t: 1, integers: 2 }, [0, 0], 0),
    ] {
        let (scalar, booked) = cycles(|| M.beside(chore, || M.splat(1.0)));
        eprintln!("{chore:?}: {booked:?}, usable from {}", scalar.ready()[0]);
        assert_eq!(
            [booked.even, booked.odd],
            [even, odd],
            "{chore:?}: instructions on the even and the odd pipe"
        );
        assert_eq!(scalar.ready()[0], ready, "{chore:?}: usable");
    }
}

/// Queues are emptied before they are filled, two quadwords a cell: what a grid of more cells costs more is that.
#[test]
fn queues_are_emptied_by_quadwords() {
    let ball = Bounds { lo: [1.0; 3], hi: [2.0; 3], center: [1.5; 3], radius: 0.5 };
    let odd = |cells: u8| {
        let plan = Plan { resolution: Resolution::Fixed(cells), ..Plan::paper() };
        let (grid, booked) = cycles(|| Grid::build(M, &plan, &[ball], &mut Events::default()));
        assert!(grid.expect("the paper's plan goes on").has_queues());
        booked.odd
    };
    for [few, many] in [[4u8, 8], [8, 12]] {
        let more = 2 * (u64::from(many).pow(3) - u64::from(few).pow(3));
        assert_eq!(odd(many) - odd(few), more, "{few} and {many} cells on an axis");
    }
}

/// One even and one odd instruction go in one cycle, two of a pipe do not.
#[test]
fn two_pipes_issue_together() {
    let mut pipeline = Pipeline::default();
    assert_eq!([pipeline.issue(Op::Fa, 0), pipeline.issue(Op::Lqx, 0)], [6, 6]);
    assert_eq!(pipeline.elapsed(), 1);
    assert_eq!([pipeline.issue(Op::Lqx, 0), pipeline.issue(Op::Fa, 0), pipeline.issue(Op::Fa, 0)], [7, 7, 8]);
    assert_eq!(pipeline.elapsed(), 3);
    pipeline.part();
    assert_eq!(pipeline.issue(Op::Lqx, 0), 9, "after a branch");
}

/// A visitor that does nothing at the cells but count them.
struct Counting(u64);

impl Visitor<Spu<Scalar>> for Counting {
    fn visit(&mut self, _: usize, _: i32, _: i32, live: bool) {
        self.0 += u64::from(live);
    }

    fn unfinished(&self, _: usize) -> <Spu<Scalar> as Machine>::B {
        M.lt(M.splat(0.0), M.splat(1.0))
    }
}

/// Slices with so many cells on the two axes.
fn slices(sizes: &[[i32; 2]]) -> Slices {
    let mut slices = Slices {
        count: sizes.len(),
        first: [[0; MAX_CELLS]; 2],
        last: [[-1; MAX_CELLS]; 2],
        far: [0.0; MAX_CELLS],
    };
    for (s, [j, k]) in sizes.iter().enumerate() {
        (slices.last[0][s], slices.last[1][s]) = (j - 1, k - 1);
    }
    slices
}

fn walked(which: Loop, sizes: &[[i32; 2]]) -> (u64, Tally) {
    record(|| {
        let mut visitor = Counting(0);
        walk(M, which, &slices(sizes), &mut visitor);
        visitor.0
    })
}

/// N slices of j rows of k cells. A loop's branch stands at its end: executed once a round, not taken once a loop. With 1 to 3
/// rows and cells, each pair equally often, a slice has on average 4 branches of the inner loop, 2 of the middle one and 1 of
/// the outer; not taken are 2, 1, and one of all the slices'. So of 7 N branches 4 N − 1 are taken, the mispredicts without
/// hints: 57 %; and 3 N + 1 are not, the mispredicts with hints: 43 %.
#[test]
fn mispredicts_of_nested_loops_have_a_closed_form() {
    let sizes: Vec<[i32; 2]> = (0..234).map(|s| [s % 3 + 1, s / 3 % 3 + 1]).collect();
    let n = sizes.len() as u64;
    let (cells, tally) = walked(Loop::Nested, &sizes);
    assert_eq!(cells, 4 * n, "cells");
    let loops = [Site::NextK, Site::NextJ, Site::NextSlice];
    let executed: u64 = loops.iter().map(|site| tally.site(*site).executed).sum();
    assert_eq!(executed, 7 * n);
    let [unhinted, hinted, gcc] = Policy::ALL.map(|policy| tally.mispredicts(&loops, policy));
    eprintln!("{executed} branches; mispredicts unhinted {unhinted}, hinted {hinted}, by GCC's rule {gcc}");
    assert_eq!([unhinted, hinted], [4 * n - 1, 3 * n + 1]);
    let per_cent = |part: u64| (100.0 * part as f64 / executed as f64).round();
    assert_eq!([per_cent(unhinted), per_cent(hinted)], [57.0, 43.0]);
    // A slice without cells is passed by, and that is the mispredict of its own branch.
    let (cells, tally) = walked(Loop::Nested, &[[1, 1], [0, 3], [2, 1]]);
    let empty = tally.site(Site::EmptySlice);
    assert_eq!((cells, empty.executed, empty.taken, empty.mispredicts), (3, 3, 1, [1; 3]));
}

/// One loop, one branch: with a hint it is mispredicted once a traversal, without one at every cell but the last.
#[test]
fn mispredicts_of_the_flattened_loop_have_a_closed_form() {
    let (seed, walks) = (seed(), count("CGT_SPU_WALKS", 500));
    eprintln!("CGT_SEED={seed}, {walks} walks");
    let mut rng = generator(seed, 0);
    let mut most = 0;
    for _ in 0..walks {
        let sizes: Vec<[i32; 2]> = (0..rng.random_range(1..=16))
            .map(|_| [rng.random_range(1..=3), rng.random_range(1..=3)])
            .collect();
        let (cells, tally) = walked(Loop::Flattened, &sizes);
        let loops = tally.site(Site::NextCell);
        assert_eq!(loops.executed, cells, "CGT_SEED={seed}: {sizes:?}");
        assert_eq!(loops.mispredicts, [cells - 1, 1, 1], "CGT_SEED={seed}: {sizes:?}");
        most = most.max(cells);
        let (nested, tally) = walked(Loop::Nested, &sizes);
        assert_eq!(nested, cells);
        let ends =
            1 + sizes.len() as u64 + sizes.iter().map(|[j, _]| u64::from(j.unsigned_abs())).sum::<u64>();
        let hinted = tally.mispredicts(&[Site::NextK, Site::NextJ, Site::NextSlice], Policy::Hinted);
        assert_eq!(hinted, ends, "CGT_SEED={seed}: {sizes:?}: one for the end of each loop");
    }
    assert!(most > 30, "too little was at stake");
}

/// A kernel of operations drawn at random on what was made before; the bounds after each.
fn random_kernel(rng: &mut impl Rng, length: usize) -> Vec<Booked> {
    let ops: Vec<[usize; 4]> =
        (0..length).map(|_| std::array::from_fn(|_| rng.random_range(0..1 << 20))).collect();
    let run = |length: usize| {
        let work = || {
            let mut x = vec![M.splat(2.0), M.lanes([3.0; LANES])];
            let mut b = vec![M.le(x[0], x[0])];
            for [op, i, j, k] in &ops[..length] {
                let (p, q, choose) = (x[i % x.len()], x[j % x.len()], b[k % b.len()]);
                match op % 14 {
                    0 => x.push(M.add(p, q)),
                    1 => x.push(M.mul(p, q)),
                    2 => x.push(M.sub(p, q)),
                    3 => x.push(M.div(p, q)),
                    4 => x.push(M.sqrt(p)),
                    5 => x.push(M.neg(p)),
                    6 => x.push(M.select(choose, p, q)),
                    7 => b.push(M.lt(p, q)),
                    8 => b.push(M.le(p, q)),
                    9 => x.push(M.lanes(M.to_array(p))),
                    10 => x.push(M.smallest(p)),
                    11 => b.push(M.and(choose, M.not(choose))),
                    12 => _ = M.any(choose, Site::Culled),
                    _ => _ = M.first_i(M.floor(p)),
                }
            }
        };
        cycles(work).1
    };
    (0..=length).map(run).collect()
}

#[test]
fn bounds_keep_their_order_on_random_kernels() {
    let (seed, kernels) = (seed(), count("CGT_SPU_KERNELS", 200));
    eprintln!("CGT_SEED={seed}, {kernels} kernels");
    let (mut apart, mut judged) = (0, 0);
    for i in 0..kernels {
        let mut rng = generator(seed, i);
        let length = rng.random_range(1..60);
        let after = random_kernel(&mut rng, length);
        for policy in Policy::ALL {
            for pair in after.windows(2) {
                let ([issue, dependence], before) = (pair[1].bracket(policy), pair[0].bracket(policy));
                assert!(issue <= dependence, "CGT_SEED={seed}, kernel {i}: {pair:?}");
                // An operation more is never a cycle less.
                assert!(
                    before[0] <= issue && before[1] <= dependence,
                    "CGT_SEED={seed}, kernel {i}: {pair:?}"
                );
                apart += u64::from(issue < dependence);
                judged += 1;
            }
        }
        let last = after[after.len() - 1];
        // Nothing takes longer than one instruction after the other would.
        let longest = 29 * (last.even + last.odd) + 18;
        assert!(last.in_order <= longest, "CGT_SEED={seed}, kernel {i}: {last:?}");
    }
    eprintln!("{judged} prefixes, the bounds differ in {apart}");
    assert!(apart > judged / 10, "the bounds were hardly ever apart");
}

/// A bundled or generated scene and a small view of it.
fn view(word: &str, [width, height]: [u32; 2]) -> (Scene, Camera) {
    let loaded = Source::parse(word).and_then(|source| source.load()).expect("bundled or generated");
    let framing = Framing { size: Some(Size::new(width, height).expect("a size")), ..Framing::default() };
    let camera = loaded.camera(&framing).expect("it can be seen");
    (loaded.animation.frames()[0].clone(), camera)
}

fn measured(plan: Plan, scene: &Scene, camera: &Camera, every: u32) -> Measured {
    measure_nearest(plan, scene, camera, every, &|| ()).expect("the plan refuses nothing")
}

/// The machine's pictures, events and counts are those of the host's scalar machine through its own door, bit for bit.
#[test]
fn its_pictures_are_those_of_the_scalar_machine() {
    let nested = Plan { walk: Loop::Nested, ..Plan::paper() };
    let uncut = Plan { culling: Culling::None, ..Plan::safe() };
    let mut hits = 0;
    for word in ["1hvr", "uniform:300:1", "sphereflake:3"] {
        let (scene, camera) = view(word, [94, 51]);
        for plan in [Plan::paper(), Plan::safe(), nested, uncut] {
            let model = measured(plan, &scene, &camera, 1);
            let host = Tracer::new(plan, Level::SCALAR).render(&scene, &camera).expect("a picture");
            let same = model.image.ids == host.image.ids
                && model.image.rgba == host.image.rgba
                && bits(&model.image.t) == bits(&host.image.t);
            assert!(same, "{word}: {plan}");
            assert_eq!(model.counts, host.counts, "{word}: {plan}");
            assert_eq!(model.events, host.events, "{word}: {plan}");
            hits += host.image.ids.iter().filter(|id| **id != MISS).count();
        }
    }
    eprintln!("{hits} pixels of {} hit", 12 * 94 * 51);
    assert!(hits > 10_000, "too little was hit");
}

fn bits(t: &[f32]) -> Vec<u32> {
    t.iter().map(|t| t.to_bits()).collect()
}

/// What the model books agrees with what the tracer itself counts, in every stage, and the bounds keep their order.
#[test]
fn its_books_agree_with_the_tracers_counts() {
    let (scene, camera) = view("1hvr", [160, 90]);
    for walk in [Loop::Nested, Loop::Flattened] {
        let plan = Plan { walk, ..Plan::paper() };
        let model = measured(plan, &scene, &camera, 1);
        let (trace, counts) = (&model.trace, model.counts);
        eprintln!("{walk:?}: {counts:?}, {} packets, {} repeats", trace.packets, trace.repeats);
        assert_eq!(trace.fetched, counts.candidates);
        let [culled, looped] = [Site::Culled, Site::NextId].map(|site| trace.site(site));
        assert_eq!([culled.executed, culled.taken], [counts.candidates, counts.culled]);
        assert_eq!(trace.site(Site::Sphere).executed, counts.candidates - counts.culled);
        let listing = trace.site(Site::EmptyCell);
        assert_eq!(
            listing.executed - listing.taken + looped.taken,
            counts.candidates,
            "rounds of the loop over ids"
        );
        // A loop over ids ends with its question, and one over none is passed by with its own.
        assert_eq!(looped.executed, counts.candidates, "{walk:?}: questions for another id");
        let cells =
            [Site::NextK, Site::NextCell].map(|site| trace.site(site).executed).into_iter().sum::<u64>();
        assert_eq!(listing.executed, cells, "{walk:?}: cells asked whether they list any");
        let ends = trace.site(Site::Unfinished).executed;
        let slices = trace.site(Site::NextSlice).taken;
        assert_eq!(ends, slices, "{walk:?}: early ends asked for after slices but the last");
        let owners = trace.site(Site::NextOwner);
        let [all, blocks] = owners_of_blocks(&model.image);
        assert_eq!(
            [owners.executed, owners.executed - owners.taken],
            [all, blocks],
            "{walk:?}: owners, blocks that hit"
        );
        assert!(trace.repeats > 0 && trace.repeats < trace.fetched);
        let voxelized = model.voxelize.stage(Stage::Voxelize);
        assert_eq!(voxelized, model.voxelize.total(), "only the grid is built before rays are traced");
        for stage in STAGES {
            let booked = if stage == Stage::Voxelize { voxelized } else { trace.stage(stage) };
            assert!(booked.even + booked.odd > 0, "{walk:?}: nothing was booked in {stage:?}");
            for policy in Policy::ALL {
                let [least, most] = booked.bracket(policy);
                assert!(0 < least && least <= most, "{walk:?}, {stage:?}, {policy:?}: {booked:?}");
            }
        }
        // Each loop has its own branches, and only these.
        let nested = trace.site(Site::NextK).executed;
        let flattened = trace.site(Site::NextCell).executed;
        match walk {
            Loop::Nested => assert_eq!((nested, flattened), (counts.cells, 0)),
            _ => {
                assert!(
                    nested == 0 && flattened >= counts.cells,
                    "{flattened} steps, {} cells",
                    counts.cells
                );
            }
        }
    }
}

/// Spheres that blocks of 4x4 pixels hit, each once a block, and blocks that hit any.
fn owners_of_blocks(image: &Image) -> [u64; 2] {
    let [width, height] = [image.size.width(), image.size.height()].map(|n| n as usize);
    let mut sum = [0, 0];
    for (y, x) in (0..height).step_by(4).flat_map(|y| (0..width).step_by(4).map(move |x| (y, x))) {
        let rows = (y..height.min(y + 4)).flat_map(|y| &image.ids[y * width..][x..width.min(x + 4)]);
        let owners = rows.filter(|id| **id != MISS).collect::<BTreeSet<_>>().len() as u64;
        sum = [sum[0] + owners, sum[1] + u64::from(owners > 0)];
    }
    sum
}

/// Spheres are put into cells by one loop with one branch, into queues and into lists.
#[test]
fn the_loop_over_spheres_tells_its_branch() {
    let (scene, camera) = view("1hvr", [16, 12]);
    for plan in [Plan::paper(), Plan::safe()] {
        let model = measured(plan, &scene, &camera, 1);
        let (next, n) = (model.voxelize.site(Site::NextSphere), scene.spheres().len() as u64);
        eprintln!("{plan}: {next:?} of {n} spheres");
        assert_eq!([next.executed, next.taken], [n, n - 1], "{plan}: one branch a sphere");
        // Hinted it is mispredicted once, at its end; unhinted each time but there.
        let [unhinted, hinted, _] = next.mispredicts;
        assert_eq!([unhinted, hinted], [n - 1, 1], "{plan}");
    }
}

/// A part of the blocks stands for all of them: cycles scaled up are near those of the whole.
#[test]
fn a_lattice_of_blocks_stands_for_all() {
    let (scene, camera) = view("uniform:300:1", [320, 180]);
    let costs = [1, 4].map(|every| {
        let model = measured(Plan::paper(), &scene, &camera, every);
        let [traced, blocks] = model.blocks();
        assert_eq!([blocks, traced], [80 * 45, 80 * 45 / u64::from(every)]);
        frame_cost(&model, 300, Policy::Hinted, Buffers::Single).expect("it can be moved")
    });
    let ratio = [0, 1].map(|bound| costs[1].cycles[bound] / costs[0].cycles[bound]);
    eprintln!("whole {:?}, a quarter scaled up: times {ratio:?}", costs[0]);
    assert!(ratio.into_iter().all(|r| (0.9..1.1).contains(&r)), "{ratio:?}");
    let [slow, fast] = costs[0].frames_per_second();
    assert!(0.0 < slow && slow <= fast);
}

/// The block of 20,480 bytes takes two transfers; a list ends at 2,048; odd addresses are refused.
#[test]
fn transfers_have_limits() {
    let transfers = |address, bytes| Transfer::new(address, bytes).map(|t| (t.transfers, t.best));
    assert_eq!(transfers(0, 20_480), Ok((2, true)));
    assert_eq!(transfers(0, 16_384), Ok((1, true)));
    assert_eq!(transfers(16, 16_400), Ok((2, false)));
    assert_eq!(transfers(0, 0), Ok((0, true)));
    assert_eq!(transfers(8, 16), Err(TransferError::Unaligned { address: 8, bytes: 16 }));
    assert_eq!(transfers(0, 20), Err(TransferError::Unaligned { address: 0, bytes: 20 }));
    assert_eq!(transfers(0, 2048 * 16_384), Ok((2048, true)));
    let bytes = 2048 * 16_384 + 16;
    assert_eq!(transfers(0, bytes), Err(TransferError::TooLong { bytes, transfers: 2049 }));
    // 256 KiB at 25.6 GB/s: 10.24 µs.
    let whole = Transfer::new(0, 262_144).expect("it can be moved");
    assert_eq!(whole.seconds(6).map(|s| (s * 1e8).round()), [1024.0, 6144.0]);
}

/// 16³ cells of 32 bytes are half the local store. What does not fit is refused with its map, and one sphere less may fit.
#[test]
fn what_does_not_fit_is_refused_with_its_map() {
    assert_eq!(queue_bytes(16), 128 * 1024);
    let code = code_bytes(Plan::paper()).expect("a sphere is not refused");
    eprintln!("code: {code} bytes");
    assert!((2_000..30_000).contains(&code), "{code}");
    for buffers in [Buffers::Single, Buffers::Double] {
        let map = |spheres| Map::new(code, queue_bytes(16), spheres, 1280, 16, buffers);
        let most = map(0).most_spheres() as usize;
        eprintln!("{buffers:?}: at most {most} spheres\n{}", map(most));
        assert_eq!(map(most).fits(), Ok(map(most)));
        let full = map(most + 1).fits().expect_err("one more");
        assert_eq!(full, LocalStoreFull { map: map(most + 1) });
        assert!(full.map.total() > CAPACITY && full.to_string().contains("131072"), "{full}");
        let parts = [full.map.code, full.map.grid, full.map.spheres, full.map.colors, full.map.pixels];
        assert_eq!(parts.iter().sum::<u64>() + full.map.slices + full.map.stack, full.map.total());
    }
    let double = Map::new(code, 0, 0, 1280, 0, Buffers::Double);
    assert_eq!(double.pixels, 40_960);
    // Sphereflake of level 4 with its grid: 243 of 256 KiB before there is any program.
    let flake = Map::new(code, queue_bytes(16), 7381, 1280, 16, Buffers::Single);
    assert_eq!((flake.grid + flake.spheres) / 1024, 243);
    assert!(flake.fits().is_err());
}

/// The ways in which loops are counted on this computer all go through the same cells, at each level.
#[test]
fn counted_loops_visit_the_same_cells() {
    for level in Level::available() {
        let sums = Way::ALL.map(|way| walks(way, level.name(), 100, SEED).expect("it is available"));
        eprintln!("{level}: {sums:?}");
        assert!(sums[0][0] > 100 * 16 && sums.iter().all(|sum| *sum == sums[0]), "{level}: {sums:?}");
    }
    assert!(walks(Way::Nested, "no-such-level", 1, SEED).is_err());
}

/// Of the same walks on the model: a flattened loop with branches mispredicts at least as often as its cases change, with
/// selection once a walk.
#[test]
fn on_the_model_selection_is_what_saves() {
    let [nested, branching, flattened] = on_model(SEED);
    eprintln!("{nested:?}\n{branching:?}\n{flattened:?}");
    // One branch a cell; with branches, also one for the row's end at each cell and one at each row's end; nested, these two, and of
    // each walk 16 for empty slices, 16 for the next slice, and 15 for an early end.
    let ends = nested.branches - 47 * nested.walks;
    assert_eq!(branching.branches, flattened.branches + ends);
    assert!(ends > flattened.branches && ends < 2 * flattened.branches);
    let hinted = Policy::Hinted as usize;
    assert_eq!(flattened.mispredicts[hinted], flattened.walks);
    assert!(branching.mispredicts[hinted] > 10 * flattened.walks);
    assert!(nested.mispredicts[hinted] > 10 * flattened.walks);
}

/// The survey's own sums: culling, mailbox and lists against the tracer's counts.
#[test]
fn a_survey_agrees_with_the_tracer() {
    let (scene, camera) = view("1hvr", [160, 90]);
    let input = |plan, unlimited| Input {
        name: "1hvr",
        frame: 0,
        scene: &scene,
        camera: &camera,
        plan,
        every: 1,
        unlimited,
    };
    let found = survey(&input(Plan::paper(), false), &|| ()).expect("it fits");
    let host = |plan| Tracer::new(plan, Level::SCALAR).render(&scene, &camera).expect("a picture");
    let (with, without) = (host(Plan::paper()), host(Plan { culling: Culling::None, ..Plan::paper() }));
    assert_eq!(found.culling.tests_without, without.counts.candidates);
    assert_eq!(found.culling.tests_with, with.counts.candidates - with.counts.culled);
    assert_eq!(found.mailbox.fetched, with.counts.candidates);
    assert_eq!(found.lists.dropped + found.lists.spanning, with.events.count());
    assert!(found.lists.spanning > 0 && found.lists.false_negatives > 0, "it has spheres larger than cells");
    // What it calls wrong is what one loop over all spheres shows otherwise.
    let naive = reference::Tracer::new(reference::Arithmetic::F32Textbook).render(&scene, &camera);
    let naive = naive.expect("a picture").image.ids;
    let wrong = naive.iter().zip(&with.image.ids).filter(|(a, b)| a != b).count() as u64;
    let hits = naive.iter().filter(|id| **id != MISS).count() as u64;
    assert_eq!((found.picture.wrong, found.picture.hits), (wrong, hits));
    assert!(wrong > 0, "it loses no sphere: nothing was at stake");
    // No hint that is given once and for all beats the better of both.
    for site in found.loops.iter().flat_map(|of| &of.sites) {
        assert!(
            site.mispredicts.iter().take(2).all(|n| site.best <= *n) && 2 * site.best <= site.executed,
            "{site:?}"
        );
        assert_eq!(site.best, site.taken.min(site.executed - site.taken), "{site:?}");
    }
    // What is told by rays, branches, cells and traversals is told of what was counted.
    let same = |what: &str, found: f64, due: f64| {
        assert!((found - due).abs() <= 1e-9 * due, "{what}: {found} of {due}");
    };
    for stage in found.rates.iter().flat_map(|rate| &rate.stages) {
        for (ray, frame) in stage.per_ray.into_iter().zip(stage.per_frame) {
            same(stage.stage, ray * 160.0 * 90.0, frame);
        }
    }
    for of in &found.loops {
        let is_own = |name: &str| LOOP_SITES.iter().any(|site| format!("{site:?}") == name);
        for (policy, k) in of.policies.iter().zip(0..) {
            let all: u64 = of.sites.iter().map(|site| site.mispredicts[k]).sum();
            let own = of.sites.iter().filter(|site| is_own(&site.site));
            let own = own.map(|site| site.mispredicts[k]).sum::<u64>();
            for (what, share, times, due) in [
                ("branches", policy.per_branch, of.branches, own),
                ("cells", policy.per_cell, of.cells, own),
                ("traversals", policy.per_traversal, of.traversals, own),
                ("traversals, all branches", policy.all_per_traversal, of.traversals, all),
            ] {
                same(what, share.expect("there are some") * times as f64, due as f64);
            }
        }
    }
    assert!(found.loops.iter().any(|of| of.branches != of.cells && of.cells != of.traversals));
    // A second buffer hides transfers, and costs nothing.
    let more = |rate: &Rate| [0, 1].map(|i| rate.frames_per_second_double[i] / rate.frames_per_second[i]);
    let more: Vec<f64> = found.rates.iter().flat_map(more).collect();
    assert!(more.iter().all(|more| *more >= 1.0) && more.iter().any(|more| *more > 1.0), "{more:?}");
    // Cells are counted, not the ids that each of them drops.
    let full = with.events.first().iter().filter_map(|event| match event {
        Event::CellFull { cell, .. } => Some(*cell),
        _ => None,
    });
    let (ids, cells) = (full.clone().count(), full.collect::<BTreeSet<_>>().len());
    assert_eq!(found.lists.overfull, cells as u64);
    assert!(ids > cells && cells > 0, "no cell drops two: {ids} ids, {cells} cells");
    let stages = &found.rates[0].stages;
    assert_eq!(stages.len(), 7, "six stages and transfers");
    let sum: f64 = stages.iter().map(|stage| stage.per_frame[1]).sum();
    // Six SPUs cannot be quicker than a sixth of the work, nor much slower with stripes of four scanlines.
    let ratio = 6.0 * found.rates[0].frame_cycles[1] / sum;
    assert!((0.99..1.6).contains(&ratio), "{ratio}");
    // The safe plan lists what it must, and finds the right picture.
    let safe = survey(&input(Plan::safe(), true), &|| ()).expect("it can be measured");
    assert_eq!((safe.picture.wrong, safe.lists.false_negatives, safe.lists.dropped), (0, 0, 0));
    // Certified packets are none of the model's.
    assert!(matches!(survey(&input(Plan::fast(), true), &|| ()), Err(SurveyError::Plan { .. })));
}

/// Each number of a survey stands in its own place, whatever the numbers are.
#[test]
fn the_text_has_each_number_in_its_place() {
    let (scene, camera) = view("uniform:50:1", [64, 36]);
    let input = Input {
        name: "fifty",
        frame: 0,
        scene: &scene,
        camera: &camera,
        plan: Plan::paper(),
        every: 1,
        unlimited: true,
    };
    let mut survey = survey(&input, &|| ()).expect("it fits");
    survey.culling = Gain {
        tests_without: 7001,
        tests_with: 1003,
        factor: Some(6.98),
        cycles_without: [11e6, 12e6],
        cycles_with: [3e6, 4e6],
    };
    survey.mailbox = Mailbox { fetched: 500, repeats: 30, share: [0.07, 0.08], saved: [0.01, 0.02] };
    survey.lists = Lists {
        spanning: 41,
        ids: 2000,
        false_positives: 100,
        false_negatives: 42,
        twice: 43,
        dropped: 44,
        overfull: 45,
    };
    survey.picture = Picture { hits: 800, wrong: 8, wrong_as_printed: 9 };
    for (k, rate) in (1..).zip(&mut survey.rates) {
        let k = f64::from(k);
        rate.frame_cycles = [k * 1e6, k * 1e6 + 5e5];
        (rate.frames_per_second, rate.frames_per_second_double) = ([100.0 + k; 2], [200.0 + k; 2]);
    }
    for of in &mut survey.loops {
        for policy in &mut of.policies {
            (policy.per_cell, policy.per_traversal) = (Some(0.25), Some(21.0));
            (policy.per_branch, policy.all_per_traversal) = (Some(0.13), Some(31.0));
        }
    }
    // One blank for all that stands between words; the groups of a number keep theirs.
    let lines = |text: &str| {
        let words = text.split([' ', '\n']).filter(|word| !word.is_empty());
        words.collect::<Vec<_>>().join(" ")
    };
    let told = lines(&text(&survey));
    for due in [
        "Culling: 7\u{202f}001 tests of sixteen rays without, 1\u{202f}003 with, a factor of 6.98; 11.0 to 12.0 and 3.00 to 4.00 million cycles a frame.",
        "Mailbox: 30 of 500 spheres fetched had been met by the packet before (6.00 %); they take 7.00 to 8.00 % of tracing, of which a mailbox saves 1.00 to 2.00 %.",
        "Lists: 2\u{202f}000 ids, of which 100 in cells that the ball does not meet (5.00 %); 42 cells that it meets do not list it; 41 spheres span more than two cells; 44 ids fell out of full queues, of 45 cells that are known.",
        "Picture: 8 of 800 pixels that hit are wrong (1.00 %); by the loop as printed 9 more differ.",
        "frame 1.00 to 1.50 2.00 to 2.50 3.00 to 3.50 million cycles, six SPUs",
        "101 102 103 frames a second",
        "201 202 203 the same, two pixel buffers",
        "0.250 a cell 21.0 a traversal 13.0 % of its branches; all branches 31.0 a traversal;",
    ] {
        assert!(told.contains(due), "`{due}` is not in {told}");
    }
    // A second buffer costs spheres.
    let told = capacity(20_000, 1280);
    let row = told.lines().find(|line| line.starts_with("16^3 ")).expect("a row");
    let most = [Buffers::Single, Buffers::Double]
        .map(|buffers| Map::new(20_000, queue_bytes(16), 0, 1280, 16, buffers).most_spheres().to_string());
    assert_ne!(most[0], most[1]);
    let cells: Vec<String> =
        row.split(' ').filter(|word| !word.is_empty()).map(|word| word.replace('\u{202f}', "")).collect();
    assert_eq!(cells[2..], most, "{row}");
}

/// Hints by hand: GCC needs eight instructions of a straight line, or a loop of at most 600 bytes with its hint still in force; of
/// two hinted branches in turn each sets its hint anew.
#[test]
fn hints_by_hand() {
    let gcc = Policy::Gcc as usize;
    let hinted = Policy::Hinted as usize;
    let mut predictor = Predictor::default();
    let mut decide = |site, taken, instructions| predictor.decide(site, taken, instructions);
    let cost = decide(Site::NextK, true, 7);
    assert_eq!((cost.mispredicted, cost.hinted), ([true, false, true], [false, true, false]), "too near");
    let cost = decide(Site::NextK, true, 15);
    assert_eq!((cost.mispredicted, cost.hinted), ([true, false, false], [false, false, true]), "eight ahead");
    let cost = decide(Site::NextK, true, 16);
    assert_eq!((cost.mispredicted, cost.hinted), ([true, false, false], [false; 3]), "a small loop");
    let cost = decide(Site::NextJ, true, 17);
    assert_eq!((cost.mispredicted[gcc], cost.hinted[hinted]), (true, true), "another branch");
    let cost = decide(Site::NextK, false, 18);
    assert_eq!(
        (cost.mispredicted, cost.hinted[hinted]),
        ([false, true, true], true),
        "its hint was replaced"
    );
    // A loop of 151 instructions is too long for its hint, and as a straight line it has room for another.
    let cost = decide(Site::NextK, true, 18 + 151);
    assert_eq!((cost.mispredicted[gcc], cost.hinted[gcc]), (false, true));
    let cost = decide(Site::Culled, true, 200);
    assert_eq!((cost.mispredicted, cost.hinted), ([true; 3], [false; 3]), "unlikely ones are never hinted");
    let cost = decide(Site::Culled, false, 201);
    assert_eq!(cost.mispredicted, [false; 3]);
}

/// Stripes to whoever is free: six at once, then where there is room.
#[test]
fn stripes_are_dealt_to_six() {
    let all = |cycles: &[f64]| dealt(cycles.iter().copied());
    assert_eq!(all(&[]).to_bits(), 0.0f64.to_bits());
    for (cycles, last) in [
        (&[5.0][..], 5.0),
        (&[1.0; 6], 1.0),
        (&[1.0; 7], 2.0),
        (&[5.0, 1.0, 1.0, 1.0, 1.0, 1.0, 3.0, 4.0], 5.0),
        (&[5.0, 1.0, 1.0, 1.0, 1.0, 1.0, 3.0, 4.5], 5.5),
    ] {
        assert!((all(cycles) - last).abs() < 1e-12, "{cycles:?}");
    }
}

/// A sphere in many cells, all of which a packet may come to.
fn sphere_in_many_cells() -> (Scene, Plan) {
    let sphere = Sphere { center: [0.0; 3], radius: 1.0, color: [9; 3] };
    let plan = Plan {
        voxelizer: Voxelizer::BoxRange,
        culling: Culling::None,
        resolution: Resolution::Fixed(6),
        ..Plan::paper()
    };
    (Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("a scene"), plan)
}

/// One sphere in many cells: each time but the first that a packet finds it is a repeat.
#[test]
fn repeats_of_one_sphere_are_all_but_the_first() {
    let (scene, plan) = sphere_in_many_cells();
    let mut most = 0;
    for step in 0..40u8 {
        let at = f32::from(step) * 0.05 - 1.0;
        let size = Size::new(4, 4).expect("a size");
        let camera = Camera::new([0.0, 0.0, 4.0], [at, at, -4.0], [0.02, 0.0, 0.0], [0.0, 0.02, 0.0], size);
        let model = measured(plan, &scene, &camera.expect("it has an area"), 1);
        let (candidates, repeats) = (model.counts.candidates, model.trace.repeats);
        assert_eq!(model.trace.packets, 1);
        assert_eq!((model.trace.fetched, repeats), (candidates, candidates.saturating_sub(1)), "at {at}");
        let again = model.trace.again();
        assert_eq!(again.even + again.odd > 0, repeats > 0, "at {at}");
        assert!(again.in_order < model.trace.total().in_order);
        most = most.max(repeats);
    }
    eprintln!("up to {most} repeats");
    assert!(most >= 3, "no packet met it often");
}

/// With many packets too, all in one stripe: the blocks of a picture as small as a point meet the sphere as often as the first does.
#[test]
fn repeats_do_not_end_with_many_packets() {
    let (scene, plan) = sphere_in_many_cells();
    let counted = |blocks: u32| {
        let size = Size::new(4 * blocks, 4).expect("a size");
        let camera =
            Camera::new([0.0, 0.0, 4.0], [-0.9, -0.9, -4.0], [1e-6, 0.0, 0.0], [0.0, 1e-6, 0.0], size);
        let model = measured(plan, &scene, &camera.expect("it has an area"), 1);
        [model.trace.packets, model.trace.fetched, model.trace.repeats]
    };
    let [_, fetched, repeats] = counted(1);
    eprintln!("a packet fetches {fetched}, of which {repeats} again");
    assert_eq!(counted(300), [300, 300 * fetched, 300 * repeats]);
    assert!(repeats > 1);
}

/// Balls and cells by hand. A ball of radius 0.1 whose centre is 0.065 from a corner of cells on each axis meets all eight but the
/// opposite one, since 0.065 √2 < 0.1 < 0.065 √3. One of radius 1.6 about the middle of 4x4x4 unit cells meets all but the eight at
/// the corners, and these are the ones in which eight corners list it.
#[test]
fn false_positives_and_negatives_by_hand() {
    let ends = [0.0, 4.0].map(|x| Sphere { center: [x; 3], radius: 0.001, color: [0; 3] });
    for (center, radius, expected) in [(2.065, 0.1, [10, 1, 0]), (2.0, 1.6, [10, 8, 56])] {
        let spheres = [&ends[..], &[Sphere { center: [center; 3], radius, color: [0; 3] }]].concat();
        let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("a scene");
        let (_, camera) = view("uniform:10:1", [4, 4]);
        let plan = Plan { resolution: Resolution::Fixed(4), ..Plan::paper() };
        let model = measured(plan, &scene, &camera, 1);
        let listed = listed(model.seen.grid.as_ref().expect("a grid"), &scene);
        assert_eq!([listed.ids, listed.needless, listed.missing], expected, "{listed:?}");
        assert_eq!(listed.twice, 0);
    }
}
