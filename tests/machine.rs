//! Does every operation of `Machine` do what the trait says, in every lane, at every level, to the bit?
//!
//! The judge is a table with one line of plain Rust for each operation: f32 arithmetic by way of f64 (which rounds
//! right for these five operations, since f64 has more than twice the bits), comparisons by the order of bit
//! patterns, conversions by 64-bit integers. Lanes are bit patterns: of an f32, of an i32, or 0 and 1 for no and yes.

use optimized::host::{Level, NoSuchLevel, VARIABLE, Work};
use optimized::machine::{Chore, LANES, Machine, Site, Stage};
use rand::{Rng, RngExt};
use std::collections::BTreeMap;
use std::process::Command;
use verify::seed::{count, generator, seed};

/// Vectors of random bits for each operation and level.
const VECTORS: &str = "CGT_MACHINE_VECTORS";

type Lanes = [u32; LANES];

/// When two results are the same.
#[derive(Clone, Copy, PartialEq)]
enum Same {
    /// Bit for bit, NaNs too: nothing is computed, bits are moved.
    Bits,
    /// Bit for bit, but any NaN is any NaN.
    Number,
    /// And zeros are one: the trait leaves open which of them is the smallest.
    Value,
}

/// What an operation gives.
enum Oracle {
    /// In each lane, from that lane of its arguments.
    Each(fn(&[u32]) -> u32),
    /// In all lanes, from all lanes of its one argument.
    All(fn(&Lanes) -> u32),
}

use Oracle::{All, Each};

struct Operation {
    name: &'static str,
    /// Of each argument: F is f32, N is f32 but NaN, I is i32, B is yes or no.
    takes: &'static str,
    same: Same,
    oracle: Oracle,
}

const fn operation(name: &'static str, takes: &'static str, same: Same, oracle: Oracle) -> Operation {
    Operation { name, takes, same, oracle }
}

const OPERATIONS: [Operation; 33] = [
    operation("lanes", "F", Same::Bits, Each(|x| x[0])),
    operation("lanes_i", "I", Same::Bits, Each(|x| x[0])),
    operation("to_array", "F", Same::Bits, Each(|x| x[0])),
    operation("to_array_i", "I", Same::Bits, Each(|x| x[0])),
    operation("first", "F", Same::Bits, All(|x| x[0])),
    operation("first_i", "I", Same::Bits, All(|x| x[0])),
    operation("splat", "F", Same::Bits, All(|x| x[0])),
    operation("splat_i", "I", Same::Bits, All(|x| x[0])),
    operation("add", "FF", Same::Number, Each(|x| add(x[0], x[1]))),
    operation("sub", "FF", Same::Number, Each(|x| rounded(f(x[0]) - f(x[1])))),
    operation("mul", "FF", Same::Number, Each(|x| mul(x[0], x[1]))),
    operation("div", "FF", Same::Number, Each(|x| rounded(f(x[0]) / f(x[1])))),
    operation("sqrt", "F", Same::Number, Each(|x| rounded(f(x[0]).sqrt()))),
    operation("lt", "FF", Same::Bits, Each(|x| less(x[0], x[1]).into())),
    operation("le", "FF", Same::Bits, Each(|x| (less(x[0], x[1]) || equal(x[0], x[1])).into())),
    operation("lt_i", "II", Same::Bits, Each(|x| (i(x[0]) < i(x[1])).into())),
    operation("and", "BB", Same::Bits, Each(|x| x[0] * x[1])),
    operation("or", "BB", Same::Bits, Each(|x| (x[0] + x[1]).min(1))),
    operation("not", "B", Same::Bits, Each(|x| 1 - x[0])),
    operation("select", "BFF", Same::Bits, Each(|x| if x[0] == 1 { x[1] } else { x[2] })),
    operation("select_i", "BII", Same::Bits, Each(|x| if x[0] == 1 { x[1] } else { x[2] })),
    operation("add_i", "II", Same::Bits, Each(|x| modulo(i(x[0]) + i(x[1])))),
    operation("or_i", "II", Same::Bits, Each(|x| x[0] | x[1])),
    operation("shl_16", "I", Same::Bits, Each(|x| modulo(i(x[0]) * 65_536))),
    operation("shr_16", "I", Same::Bits, Each(|x| x[0] / 65_536)),
    operation("floor", "F", Same::Bits, Each(|x| integer(x[0], true))),
    operation("truncate", "F", Same::Bits, Each(|x| integer(x[0], false))),
    operation("smallest", "N", Same::Value, All(|x| extreme(x, less))),
    operation("largest", "N", Same::Value, All(|x| extreme(x, |a, b| less(b, a)))),
    operation("neg", "F", Same::Number, Each(|x| x[0] ^ 1 << 31)),
    operation("min", "FF", Same::Bits, Each(|x| if less(x[0], x[1]) { x[0] } else { x[1] })),
    operation("max", "FF", Same::Bits, Each(|x| if less(x[1], x[0]) { x[0] } else { x[1] })),
    operation("dot", "FFFFFF", Same::Number, Each(dot)),
];

/// Operations with tests of their own; `spu` in `spu_machine.rs`.
const OTHERS: [&str; 10] =
    ["within", "spu", "unit", "stage", "branch", "beside", "lanes_of_four", "any", "again", "to_bits"];

fn f(bits: u32) -> f64 {
    f32::from_bits(bits).into()
}

fn rounded(x: f64) -> u32 {
    (x as f32).to_bits()
}

fn i(bits: u32) -> i64 {
    bits.cast_signed().into()
}

fn modulo(x: i64) -> u32 {
    u32::try_from(x.rem_euclid(1 << 32)).expect("below 2^32")
}

fn add(x: u32, y: u32) -> u32 {
    rounded(f(x) + f(y))
}

fn mul(x: u32, y: u32) -> u32 {
    rounded(f(x) * f(y))
}

/// (x x' + y y') + z z', each rounded.
fn dot(x: &[u32]) -> u32 {
    add(add(mul(x[0], x[3]), mul(x[1], x[4])), mul(x[2], x[5]))
}

fn is_nan(bits: u32) -> bool {
    bits & 0x7fff_ffff > 0x7f80_0000
}

/// Place in the order of f32; NaN has none, and the zeros have one.
fn rank(bits: u32) -> Option<i64> {
    let magnitude = i64::from(bits & 0x7fff_ffff);
    (!is_nan(bits)).then_some(if bits >> 31 == 1 { -magnitude } else { magnitude })
}

fn less(x: u32, y: u32) -> bool {
    rank(x).zip(rank(y)).is_some_and(|(x, y)| x < y)
}

fn equal(x: u32, y: u32) -> bool {
    rank(x).zip(rank(y)).is_some_and(|(x, y)| x == y)
}

/// The first that comes before all others.
fn extreme(x: &Lanes, before: fn(u32, u32) -> bool) -> u32 {
    *x.iter().find(|&&a| x.iter().all(|&b| !before(b, a))).expect("no lane is NaN")
}

/// The integer part or the largest integer not above, saturated; 0 for NaN.
fn integer(bits: u32, down: bool) -> u32 {
    if is_nan(bits) {
        return 0;
    }
    let x = f(bits).clamp(-1e12, 1e12);
    let cut = x as i64;
    let whole = if down && cut as f64 > x { cut - 1 } else { cut };
    let saturated = whole.clamp(i32::MIN.into(), i32::MAX.into());
    i32::try_from(saturated).expect("saturated").cast_unsigned()
}

/// The operation of that name on a machine: the one place that calls it.
#[inline(always)]
fn apply<M: Machine>(m: M, name: &str, x: &[Lanes]) -> Lanes {
    let f = |n: usize| m.lanes(x[n].map(f32::from_bits));
    let i = |n: usize| m.lanes_i(x[n].map(u32::cast_signed));
    let b = |n: usize| m.lt_i(m.splat_i(0), i(n));
    let of_f = |y: M::F| m.to_array(y).map(f32::to_bits);
    let of_i = |y: M::I| m.to_array_i(y).map(i32::cast_unsigned);
    let of_b = |y: M::B| of_i(m.select_i(y, m.splat_i(1), m.splat_i(0)));
    match name {
        "lanes" | "to_array" => of_f(f(0)),
        "lanes_i" | "to_array_i" => of_i(i(0)),
        "first" => of_f(m.splat(m.first(f(0)))),
        "first_i" => of_i(m.splat_i(m.first_i(i(0)))),
        "splat" => of_f(m.splat(f32::from_bits(x[0][0]))),
        "splat_i" => of_i(m.splat_i(x[0][0].cast_signed())),
        "add" => of_f(m.add(f(0), f(1))),
        "sub" => of_f(m.sub(f(0), f(1))),
        "mul" => of_f(m.mul(f(0), f(1))),
        "div" => of_f(m.div(f(0), f(1))),
        "sqrt" => of_f(m.sqrt(f(0))),
        "lt" => of_b(m.lt(f(0), f(1))),
        "le" => of_b(m.le(f(0), f(1))),
        "lt_i" => of_b(m.lt_i(i(0), i(1))),
        "and" => of_b(m.and(b(0), b(1))),
        "or" => of_b(m.or(b(0), b(1))),
        "not" => of_b(m.not(b(0))),
        "select" => of_f(m.select(b(0), f(1), f(2))),
        "select_i" => of_i(m.select_i(b(0), i(1), i(2))),
        "add_i" => of_i(m.add_i(i(0), i(1))),
        "or_i" => of_i(m.or_i(i(0), i(1))),
        "shl_16" => of_i(m.shl_16(i(0))),
        "shr_16" => of_i(m.shr_16(i(0))),
        "floor" => of_i(m.floor(f(0))),
        "truncate" => of_i(m.truncate(f(0))),
        "smallest" => of_f(m.smallest(f(0))),
        "largest" => of_f(m.largest(f(0))),
        "neg" => of_f(m.neg(f(0))),
        "min" => of_f(m.min(f(0), f(1))),
        "max" => of_f(m.max(f(0), f(1))),
        "dot" => of_f(m.dot([f(0), f(1), f(2)], [f(3), f(4), f(5)])),
        _ => panic!("no test applies {name}"),
    }
}

impl Same {
    fn holds(self, x: u32, y: u32) -> bool {
        x == y || self != Self::Bits && is_nan(x) && is_nan(y) || self == Self::Value && equal(x, y)
    }
}

impl Operation {
    fn expected(&self, x: &[Lanes], lane: usize) -> u32 {
        match self.oracle {
            Each(oracle) => oracle(&x.iter().map(|x| x[lane]).collect::<Vec<_>>()),
            All(oracle) => oracle(&x[0]),
        }
    }

    fn result_is_f32(&self) -> bool {
        self.same != Same::Bits || self.takes.ends_with('F') && !self.gives_no_f32()
    }

    fn gives_no_f32(&self) -> bool {
        ["lt", "le", "floor", "truncate"].contains(&self.name)
    }
}

/// Bit patterns of f32 at which something changes, of both signs.
fn edges_f() -> Vec<u32> {
    let two = |exponent: i32| 2f32.powi(exponent);
    let mut magnitudes = vec![0.0, f32::INFINITY, f32::MAX, f32::MIN_POSITIVE, f32::EPSILON];
    // Halves, to see floor from truncate; numbers without halves; the limits of i32 and u32.
    magnitudes.extend([0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 65_535.0, 65_536.5, 1e10, 1e30, 1e-30]);
    magnitudes.extend([22, 23, 24, 30, 31, 32, 63, 64, 126, 127].map(two));
    magnitudes.extend([-1, -12, -24, -63, -75, -100].map(two));
    let neighbours = magnitudes.iter().flat_map(|x| [x.next_down(), *x, x.next_up()]);
    let mut bits: Vec<u32> = neighbours.filter(|x| !x.is_nan()).map(f32::to_bits).collect();
    // Subnormal numbers: one, two, three, half of the least normal one, the largest.
    bits.extend([1, 2, 3, 0x0040_0000, 0x007f_ffff]);
    // NaNs: quiet, quiet with all bits, signalling, signalling with all bits.
    bits.extend([0x7fc0_0000, 0x7fff_ffff, 0x7f80_0001, 0x7fbf_ffff]);
    with_signs(bits)
}

fn with_signs(bits: Vec<u32>) -> Vec<u32> {
    let mut both: Vec<u32> = bits.into_iter().flat_map(|x| [x, x ^ 1 << 31]).collect();
    both.sort_unstable();
    both.dedup();
    both
}

fn edges_i() -> Vec<u32> {
    let powers = (0..32).map(|shift| 1 << shift);
    with_signs(powers.flat_map(|x: u32| [x.wrapping_sub(1), x, x + 1, !x]).collect())
}

fn edges(kind: char) -> Vec<u32> {
    match kind {
        'F' => edges_f(),
        'N' => edges_f().into_iter().filter(|&x| !is_nan(x)).collect(),
        'I' => edges_i(),
        _ => vec![0, 1],
    }
}

/// Vectors in which all combinations of edge values occur, in random order; for six arguments, as many random ones
/// of them as there are combinations of two.
fn edge_vectors(takes: &str, rng: &mut impl Rng) -> Vec<Vec<Lanes>> {
    let edges: Vec<_> = takes.chars().map(edges).collect();
    let combinations: usize = edges.iter().take(3).map(Vec::len).product();
    let all = takes.len() <= 3;
    let mut order: Vec<usize> =
        (0..if all { combinations } else { edges[0].len() * edges[1].len() }).collect();
    for n in (1..order.len()).rev() {
        order.swap(n, rng.random_range(0..=n));
    }
    let mut combination = |mut index: usize| -> Vec<u32> {
        let mut pick = |edges: &Vec<u32>| {
            let at = if all { index % edges.len() } else { rng.random_range(0..edges.len()) };
            index /= edges.len();
            edges[at]
        };
        edges.iter().map(&mut pick).collect()
    };
    let combinations: Vec<Vec<u32>> = order.into_iter().map(&mut combination).collect();
    let lane = |chunk: &[Vec<u32>], argument: usize, lane: usize| chunk[lane % chunk.len()][argument];
    let vector = |chunk: &[Vec<u32>]| {
        (0..edges.len()).map(|argument| std::array::from_fn(|n| lane(chunk, argument, n))).collect()
    };
    combinations.chunks(LANES).map(vector).collect()
}

/// One lane: any bits, or an edge value, or a number near the other arguments' (so that differences cancel).
fn random_lane(kind: char, edges: &[u32], near: &mut Option<u32>, rng: &mut impl Rng) -> u32 {
    let bits: u32 = rng.random();
    let lane = match (kind, rng.random_range(0..4), *near) {
        ('B', ..) => bits & 1,
        (_, 0, _) => edges[bits as usize % edges.len()],
        (_, 1 | 2, Some(near)) => (near ^ (bits & 1 << 31)).wrapping_add(bits % 64).wrapping_sub(32),
        _ => bits,
    };
    let lane = if kind == 'N' && is_nan(lane) { lane & 0x807f_ffff } else { lane };
    *near = Some(lane);
    lane
}

fn random_vector(takes: &str, edges: &[Vec<u32>], rng: &mut impl Rng) -> Vec<Lanes> {
    let mut vector = vec![[0; LANES]; takes.len()];
    for lane in 0..LANES {
        let mut near = None;
        for ((argument, kind), edges) in vector.iter_mut().zip(takes.chars()).zip(edges) {
            argument[lane] = random_lane(kind, edges, &mut near, rng);
        }
    }
    vector
}

/// What was judged.
#[derive(Default)]
struct Judged {
    /// Lanes, by operation.
    lanes: BTreeMap<&'static str, u64>,
    /// Of these, expected results that are subnormal.
    subnormal: u64,
    /// Expected results that are NaN.
    nan: u64,
}

/// All operations on one machine.
struct Judge {
    seed: u64,
    vectors: u64,
}

impl Judge {
    #[inline(always)]
    fn vector<M: Machine>(&self, m: M, operation: &Operation, x: &[Lanes], judged: &mut Judged) {
        let given = m.within(
            #[inline(always)]
            || apply(m, operation.name, x),
        );
        for (lane, &given) in given.iter().enumerate() {
            let expected = operation.expected(x, lane);
            if !operation.same.holds(expected, given) {
                self.fail(operation, x, lane, expected, given);
            }
            if operation.result_is_f32() {
                judged.subnormal += u64::from(f32::from_bits(expected).is_subnormal());
                judged.nan += u64::from(is_nan(expected));
            }
        }
        *judged.lanes.entry(operation.name).or_default() += LANES as u64;
    }

    fn fail(&self, operation: &Operation, x: &[Lanes], lane: usize, expected: u32, given: u32) -> ! {
        let show = |bits: u32| format!("{bits:#010x} ({:e}, {})", f32::from_bits(bits), bits.cast_signed());
        let arguments: Vec<_> = match operation.oracle {
            Each(_) => x.iter().map(|x| show(x[lane])).collect(),
            All(_) => x[0].iter().map(|&x| show(x)).collect(),
        };
        panic!(
            "{} of {}, lane {lane}: expected {}, given {}; replay with CGT_SEED={} {VECTORS}={}",
            operation.name,
            arguments.join(" and "),
            show(expected),
            show(given),
            self.seed,
            self.vectors
        );
    }
}

impl Work for &Judge {
    type Output = Judged;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Judged {
        let mut judged = Judged::default();
        for (stream, operation) in (0..).zip(&OPERATIONS) {
            let mut rng = generator(self.seed, stream);
            for x in edge_vectors(operation.takes, &mut rng) {
                self.vector(m, operation, &x, &mut judged);
            }
            let edges: Vec<_> = operation.takes.chars().map(edges).collect();
            for _ in 0..self.vectors {
                let x = random_vector(operation.takes, &edges, &mut rng);
                self.vector(m, operation, &x, &mut judged);
            }
        }
        judged
    }
}

#[test]
fn every_operation_gives_in_every_lane_what_the_trait_says() {
    let judge = Judge { seed: seed(), vectors: count(VECTORS, 2000) };
    eprintln!("CGT_SEED={} {VECTORS}={}", judge.seed, judge.vectors);
    for level in Level::available() {
        let judged = level.run(&judge);
        let lanes: u64 = judged.lanes.values().sum();
        let Judged { subnormal, nan, .. } = judged;
        eprintln!(
            "{level}: {} operations, {lanes} lanes, {subnormal} subnormal and {nan} NaN results",
            judged.lanes.len()
        );
        assert_eq!(judged.lanes.len(), OPERATIONS.len(), "{level}: an operation was not judged");
        assert!(judged.lanes.values().all(|&n| n >= judge.vectors * 16 + 16), "{level}: too few lanes");
        assert!(subnormal > 10_000 && nan > 10_000, "{level}: too little was at stake");
    }
}

/// A lane's result is the same whatever the others hold.
struct Independence(u64);

impl Work for Independence {
    type Output = u64;

    fn on<M: Machine + Send + Sync>(self, m: M) -> u64 {
        let mut judged = 0;
        let each = OPERATIONS.iter().filter(|operation| matches!(operation.oracle, Each(_)));
        for (stream, operation) in (100..).zip(each) {
            let mut rng = generator(self.0, stream);
            let edges: Vec<_> = operation.takes.chars().map(edges).collect();
            for lane in (0..LANES).cycle().take(20 * LANES) {
                let x = random_vector(operation.takes, &edges, &mut rng);
                let mut y = random_vector(operation.takes, &edges, &mut rng);
                for (x, y) in x.iter().zip(&mut y) {
                    y[lane] = x[lane];
                }
                let [given, other] = [&x, &y].map(|x| m.within(|| apply(m, operation.name, x))[lane]);
                let same = operation.same.holds(given, other);
                assert!(
                    same,
                    "{}, lane {lane}: {x:x?} and {y:x?} differ; CGT_SEED={}",
                    operation.name, self.0
                );
                judged += 1;
            }
        }
        judged
    }
}

#[test]
fn a_lane_depends_on_no_other() {
    let seed = seed();
    eprintln!("CGT_SEED={seed}");
    for level in Level::available() {
        let judged = level.run(Independence(seed));
        eprintln!("{level}: {judged} lanes, each among two sets of others");
        assert_eq!(judged, 27 * 20 * LANES as u64, "{level}: an operation was not judged");
    }
}

/// The doors, on every mask at every site.
struct Doors;

impl Work for Doors {
    type Output = u64;

    fn on<M: Machine + Send + Sync>(self, m: M) -> u64 {
        let sites = [Site::Incoherent, Site::Sphere, Site::Unfinished, Site::Culled, Site::NextCell];
        let mut judged = 0;
        for mask in 0..1u32 << LANES {
            let lanes: [i32; LANES] = std::array::from_fn(|lane| (mask >> lane & 1).cast_signed());
            for site in sites {
                let [any, again] = m.within(|| {
                    let mask = m.lt_i(m.splat_i(0), m.lanes_i(lanes));
                    [m.any(mask, site), m.again(mask, site)]
                });
                assert_eq!([any, again], [mask != 0; 2], "mask {mask:#018b}, {site:?}");
                judged += 1;
            }
        }
        judged
    }
}

#[test]
fn the_doors_open_for_any_lane() {
    for level in Level::available() {
        let judged = level.run(Doors);
        eprintln!("{level}: any and again on {judged} masks and sites");
        assert_eq!(judged, 5 << LANES);
    }
}

/// What `within` is given is done once, and its result comes out.
struct Within;

impl Work for Within {
    type Output = (u32, u32);

    fn on<M: Machine + Send + Sync>(self, m: M) -> (u32, u32) {
        let mut times = 0;
        let result = m.within(|| {
            times += 1;
            41 + times
        });
        (times, result)
    }
}

#[test]
fn work_within_a_machine_is_done_once() {
    for level in Level::available() {
        assert_eq!(level.run(Within), (1, 42), "{level}");
    }
}

/// Four numbers in sixteen lanes, and what is only noted.
struct Notes;

impl Work for Notes {
    type Output = (Lanes, [bool; 2], u32);

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        let mut times = 0;
        let four = m.within(|| {
            m.stage(Stage::Cull);
            m.beside(Chore::Cell { slice: 0, j: 1, k: 2, live: true }, || {
                times += 1;
                m.to_array(m.lanes_of_four([1, 2, 0x7fc0_0005, 0x8000_0000].map(f32::from_bits)))
            })
        });
        let branches = [false, true].map(|taken| m.branch(taken, Site::NextK));
        (four.map(f32::to_bits), branches, times)
    }
}

#[test]
fn notes_change_nothing() {
    let four: Lanes = std::array::from_fn(|lane| [1, 2, 0x7fc0_0005, 0x8000_0000][lane % 4]);
    for level in Level::available() {
        assert_eq!(level.run(Notes), (four, [false, true], 1), "{level}");
    }
}

/// A few results known by heart, since the oracle's f64 could be flushed by the same fault as the subject's f32.
struct Subnormals;

impl Work for Subnormals {
    type Output = [Lanes; 5];

    fn on<M: Machine + Send + Sync>(self, m: M) -> [Lanes; 5] {
        let bits = |bits: u32| std::hint::black_box([bits; LANES]);
        [
            apply(m, "add", &[bits(1), bits(1)]),
            apply(m, "sub", &[bits(0x0080_0000), bits(1)]),
            apply(m, "mul", &[bits(0x0080_0000), bits(0x3f00_0000)]),
            apply(m, "div", &[bits(3), bits(0x4000_0000)]),
            apply(m, "lt", &[bits(0), bits(1)]),
        ]
    }
}

#[test]
fn subnormal_numbers_are_numbers() {
    for level in Level::available() {
        // One and one is two; least normal less one; half the least normal; 3/2 to even; 0 < least.
        let expected = [2, 0x007f_ffff, 0x0040_0000, 2, 1].map(|lane| [lane; LANES]);
        assert_eq!(level.run(Subnormals), expected, "{level}");
    }
}

/// One and the unit; one and the number after it; and of the SPU's machine beside it the unit and the worst error of its quotients and
/// roots, relative.
struct Units([Lanes; 2]);

impl Work for Units {
    type Output = ([f32; 2], [f64; 2]);

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        let unit = m.unit();
        let sums = [unit, unit.next_up()].map(|x| [x.to_bits(); LANES]);
        let one = [1.0f32.to_bits(); LANES];
        let sums = sums.map(|x| f32::from_bits(apply(m, "add", &[one, x])[0]));
        let s = m.spu();
        let [x, y] = self.0;
        let (quotient, root) = (apply(s, "div", &[x, y]), apply(s, "sqrt", &[x]));
        let off = |found: u32, real: f64| ((f64::from(f32::from_bits(found)) - real) / real).abs();
        let mut worst = 0.0f64;
        for lane in 0..LANES {
            worst = worst.max(off(quotient[lane], f(x[lane]) / f(y[lane])));
            worst = worst.max(off(root[lane], f(x[lane]).sqrt()));
        }
        (sums, [s.unit().into(), worst])
    }
}

/// The unit is half the distance from one to the next number; on the SPU, what a quotient or a root is off by, and less than four times that.
#[test]
fn the_unit_is_what_an_operation_is_off_by() {
    let seed = seed();
    let mut rng = generator(seed, 9);
    for level in Level::available() {
        let mut worst = 0.0f64;
        for _ in 0..2_000 {
            let numbers = [(); 2].map(|()| std::array::from_fn(|_| rng.random_range(1.0f32..4.0).to_bits()));
            let (sums, [unit, off]) = level.run(Units(numbers));
            assert_eq!(sums, [1.0, 1.0f32.next_up()], "{level}");
            assert!(off <= unit, "{level}: {off} above {unit}: {numbers:x?}, CGT_SEED={seed}");
            worst = worst.max(off / unit);
        }
        assert!(
            worst > 0.25,
            "{level}: the SPU's unit is over four times what was found: {worst}, CGT_SEED={seed}"
        );
    }
}

/// Names the machine it is given.
struct Named;

impl Work for Named {
    type Output = String;

    fn on<M: Machine + Send + Sync>(self, _: M) -> String {
        std::any::type_name::<M>().replace('_', ".").to_lowercase()
    }
}

/// Nobody would see by its results that a level runs another one's machine.
#[test]
fn each_level_runs_its_own_machine() {
    for level in Level::available() {
        let machine = level.run(Named);
        let own = machine.split(['<', '>', ':']).any(|word| word == level.name());
        assert!(own, "{level} runs {machine}");
    }
}

/// The names of the trait's operations, from its source.
fn operations_of_the_trait() -> Vec<&'static str> {
    let source = include_str!("../optimized/src/machine.rs");
    let (_, body) = source.split_once("pub trait Machine").expect("the trait");
    let (body, _) = body.split_once("\n}").expect("its end");
    let after = body.lines().filter_map(|line| line.trim_start().strip_prefix("fn "));
    after.filter_map(|line| line.split(['<', '(']).next()).collect()
}

#[test]
fn every_operation_has_a_test() {
    let mut tested: Vec<_> = OPERATIONS.iter().map(|operation| operation.name).chain(OTHERS).collect();
    let mut there = operations_of_the_trait();
    tested.sort_unstable();
    there.sort_unstable();
    assert_eq!(tested, there, "tested, and there to be tested");
    assert_eq!(there.len(), 43, "the count in this test is the one thing to change after a new test");
}

#[test]
fn levels_have_names() {
    let levels = Level::available();
    for level in &levels {
        assert_eq!(Level::named(level.name()).expect("available").name(), level.name());
        assert_eq!(Level::named(&level.name().to_uppercase()).expect("available").name(), level.name());
        assert_eq!(level.to_string(), level.name());
    }
    let names: Vec<_> = levels.iter().map(|level| level.name()).collect();
    assert_eq!(names[0], "scalar");
    // From plain to wide, since the last is the best.
    let order = ["scalar", "sse2", "sse4.2", "avx2", "avx512", "neon", "simd128"];
    let places: Vec<_> = names.iter().map(|name| order.iter().position(|known| known == name)).collect();
    assert!(places.iter().all(Option::is_some) && places.windows(2).all(|two| two[0] < two[1]), "{names:?}");
    for name in ["", "avx", "sse3", "fallback", "avx512 "] {
        let error = Level::named(name).expect_err("no such level");
        assert_eq!(error, NoSuchLevel { name: name.into(), available: names.clone() });
        let text = error.to_string();
        assert!(
            names.iter().all(|name| text.contains(name)) && text.contains(&format!("`{name}`")),
            "{text}"
        );
    }
}

/// The standard library asks the processor itself: what it has all instructions of is a level, and nothing else is.
#[test]
#[cfg(target_arch = "x86_64")]
fn levels_are_those_that_the_processor_has() {
    macro_rules! has {
        ($($feature:tt),*) => { [$(std::arch::is_x86_feature_detected!($feature)),*].iter().all(|has| *has) };
    }
    let sse2 = has!("sse2", "fxsr");
    let sse42 = sse2 && has!("sse4.2", "cmpxchg16b", "popcnt");
    // x86-64-v3, and Ice Lake's server.
    let avx2 = sse42 && has!("avx2", "bmi1", "bmi2", "f16c", "fma", "lzcnt", "movbe", "xsave");
    let avx512 = avx2
        && has!(
            "adx",
            "aes",
            "avx512bitalg",
            "avx512bw",
            "avx512cd",
            "avx512dq",
            "avx512f",
            "avx512ifma",
            "avx512vbmi",
            "avx512vbmi2",
            "avx512vl",
            "avx512vnni",
            "avx512vpopcntdq",
            "gfni",
            "pclmulqdq",
            "rdrand",
            "rdseed",
            "sha",
            "vaes",
            "vpclmulqdq",
            "xsavec",
            "xsaveopt",
            "xsaves"
        );
    let all = [("scalar", true), ("sse2", sse2), ("sse4.2", sse42), ("avx2", avx2), ("avx512", avx512)];
    let has: Vec<_> = all.into_iter().filter(|(_, has)| *has).map(|(name, _)| name).collect();
    let names: Vec<_> = Level::available().iter().map(|level| level.name()).collect();
    assert_eq!(names, has, "levels, and what the processor has");
}

/// Says which level is the best; run by the next test with the variable set.
#[test]
fn the_best_level_is_available() {
    match Level::best() {
        Ok(level) => eprintln!("best level: {level}"),
        Err(error) => panic!("no best level: {error}"),
    }
}

/// What that test says with the variable set to `value`, and whether it passes.
fn best_with(value: Option<&std::ffi::OsStr>) -> (bool, String) {
    let mut child = Command::new(std::env::current_exe().expect("this program"));
    child.args(["--exact", "the_best_level_is_available", "--nocapture"]);
    match value {
        Some(value) => child.env(VARIABLE, value),
        None => child.env_remove(VARIABLE),
    };
    let output = child.output().expect("it runs");
    (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn the_variable_names_the_level() {
    let levels = Level::available();
    for level in &levels {
        let (passed, said) = best_with(Some(level.name().as_ref()));
        assert!(passed && said.contains(&format!("best level: {level}\n")), "{level}: {said}");
    }
    let last = levels.last().expect("scalar at least");
    let (passed, said) = best_with(None);
    assert!(passed && said.contains(&format!("best level: {last}\n")), "{said}");
    for name in ["sse9", "scalar ", " scalar", ""] {
        let (passed, said) = best_with(Some(name.as_ref()));
        let listed = levels.iter().all(|level| said.contains(level.name()));
        assert!(!passed && said.contains(&format!("`{name}`")) && listed, "{name:?}: {said}");
    }
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        let (passed, said) = best_with(Some(std::ffi::OsStr::from_bytes(b"avx\xff")));
        assert!(!passed && said.contains("no level of this processor"), "{said}");
    }
}
