//! Does the reference compute as the contract says that an SPU does (rule 6)? Against results worked out by hand,
//! against big integers in which each operation is exact and cut off by a search, and against the true quotients and
//! roots, over whole ranges of fractions.

use contract::spu::{FREST, FRSQEST};
use contract::{DEFAULT_LIGHT, Scene, Sphere};
use num_bigint::{BigInt, Sign};
use rand::{Rng, RngExt};
use rayon::prelude::*;
use reference::spu::Spu;
use reference::{Arithmetic, Ray, Tracer};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use verify::seed::{count, generator, seed};

const ONE: u32 = 0x3f80_0000;
const TWO: u32 = 0x4000_0000;
const HALF: u32 = 0x3f00_0000;
const BELOW_ONE: u32 = 0x3f7f_ffff;
const MINUS_ZERO: u32 = 0x8000_0000;
const SUBNORMAL: u32 = 0x007f_ffff;
const FRACTION: u32 = 0x007f_ffff;
/// 2^-126, 2^-63 and 2^-60.
const LEAST: u32 = 0x0080_0000;
const TINY: u32 = 0x2000_0000;
const SMALL: u32 = 0x2180_0000;
/// 2^128 and the largest number.
const TWO_128: u32 = 0x7f80_0000;
const LARGEST: u32 = 0x7fff_ffff;

const fn minus(x: u32) -> u32 {
    x ^ MINUS_ZERO
}

/// Every pattern of these, in every place.
const EDGES: [u32; 30] = [
    0,
    MINUS_ZERO,
    1,
    SUBNORMAL,
    minus(SUBNORMAL),
    LEAST,
    minus(LEAST),
    LEAST + 1,
    0x00ff_ffff,
    0x0100_0000,
    TINY,
    minus(TINY),
    SMALL,
    HALF,
    BELOW_ONE,
    minus(BELOW_ONE),
    ONE,
    minus(ONE),
    ONE + 1,
    minus(ONE + 1),
    0x3fff_ffff,
    TWO,
    0x5f00_0000,
    0x7f00_0000,
    0x7f7f_ffff,
    TWO_128,
    minus(TWO_128),
    TWO_128 + 1,
    LARGEST,
    minus(LARGEST),
];

type Unary = (&'static str, fn(Spu) -> Spu, u32, u32);
type Binary = (&'static str, fn(Spu, Spu) -> Spu, [u32; 2], u32);
type Ternary = (&'static str, fn(Spu, Spu, Spu) -> Spu, [u32; 3], u32);

#[test]
fn results_worked_out_by_hand() {
    let unary: [Unary; 24] = [
        ("neg", |x| -x, 0, MINUS_ZERO),
        ("neg", |x| -x, minus(SUBNORMAL), SUBNORMAL),
        ("neg", |x| -x, LARGEST, 0xffff_ffff),
        // The first entry under 1 is 0x7ffbe0, and 253 - 127 = 126.
        ("frest", Spu::frest, ONE, 0x3f7f_fbe0),
        ("frest", Spu::frest, minus(ONE), 0xbf7f_fbe0),
        ("frest", Spu::frest, 0x3fff_ffff, 0x3f04_1d07),
        ("frest", Spu::frest, LEAST, 0x7e7f_fbe0),
        // 253 - 252 = 1; then 0, where the entry still stands but the number is zero; below 0 it stays 0.
        ("frest", Spu::frest, 0x7e00_0000, 0x00ff_fbe0),
        ("frest", Spu::frest, 0x7e80_0000, 0x007f_fbe0),
        ("frest", Spu::frest, minus(TWO_128), 0x807f_fbe0),
        ("frest", Spu::frest, SUBNORMAL, LARGEST),
        ("frest", Spu::frest, MINUS_ZERO, minus(LARGEST)),
        // Under 1 the exponent is odd: entry 32, and 190 - 64 = 126. Under 2 and 1/2 it is even: entry 0, and 126 and 127.
        ("frsqest", Spu::frsqest, ONE, 0x3f7f_fdf4),
        ("frsqest", Spu::frsqest, minus(ONE), 0x3f7f_fdf4),
        ("frsqest", Spu::frsqest, TWO, 0x3f35_0160),
        ("frsqest", Spu::frsqest, HALF, 0x3fb5_0160),
        ("frsqest", Spu::frsqest, LARGEST, 0x1f37_e8ba),
        ("frsqest", Spu::frsqest, minus(SUBNORMAL), LARGEST),
        // w = 1 - 2^-14 = g; g + (1 - g^2) w / 2 = 1 - 3 2^-29 + 2^-43.
        ("sqrt", Spu::sqrt, ONE, BELOW_ONE),
        // Entry 31 goes down to 1 + 262 2^-32, cut off to w = 1; then g = x, and x + x (1 - x) / 2 = 1 - 2^-24 - 2^-47.
        ("sqrt", Spu::sqrt, 0x3f7f_fffe, 0x3f7f_fffe),
        // In exact fractions: were the step cut off before it is added, the result would be the next number.
        ("sqrt", Spu::sqrt, 0x3f9d_2f39, 0x3f8d_d7f6),
        ("sqrt", Spu::sqrt, 0x4015_be58, 0x3fc3_caa4),
        ("sqrt", Spu::sqrt, 0, 0),
        ("sqrt", Spu::sqrt, minus(SUBNORMAL), 0),
    ];
    let binary: [Binary; 43] = [
        ("add", |x, y| x + y, [ONE, ONE], TWO),
        // 1 + 2^-23 + (1 - 2^-24) = 2 + 2^-24, cut off.
        ("add", |x, y| x + y, [ONE + 1, BELOW_ONE], TWO),
        ("add", |x, y| x + y, [ONE, SMALL], ONE),
        ("add", |x, y| x + y, [ONE, minus(SMALL)], BELOW_ONE),
        ("add", |x, y| x + y, [minus(ONE), SMALL], minus(BELOW_ONE)),
        ("add", |x, y| x + y, [ONE + 1, minus(SMALL)], ONE),
        ("add", |x, y| x + y, [TWO_128, minus(LEAST)], 0x7f7f_ffff),
        ("add", |x, y| x + y, [minus(LEAST), TWO_128 + 1], TWO_128),
        // 2^128 + 2^128 = 2^129 is too much; less by 2^105 it is the largest number, and by 2^104 it is cut off to that.
        ("add", |x, y| x + y, [TWO_128, TWO_128], LARGEST),
        ("add", |x, y| x + y, [TWO_128, TWO_128 - 1], LARGEST),
        ("add", |x, y| x + y, [TWO_128, TWO_128 - 2], LARGEST),
        ("add", |x, y| x + y, [TWO_128, TWO_128 - 4], LARGEST - 1),
        ("add", |x, y| x + y, [minus(LARGEST), minus(LEAST)], minus(LARGEST)),
        ("add", |x, y| x + y, [minus(LARGEST), minus(LARGEST)], minus(LARGEST)),
        ("add", |x, y| x + y, [MINUS_ZERO, MINUS_ZERO], 0),
        ("add", |x, y| x + y, [SUBNORMAL, ONE], ONE),
        ("add", |x, y| x + y, [SUBNORMAL, SUBNORMAL], 0),
        ("sub", |x, y| x - y, [ONE, SMALL], BELOW_ONE),
        ("sub", |x, y| x - y, [SMALL, ONE], minus(BELOW_ONE)),
        ("sub", |x, y| x - y, [ONE, BELOW_ONE], 0x3380_0000),
        ("sub", |x, y| x - y, [minus(ONE), minus(ONE)], 0),
        // 2^-126 (1 + 2^-23) - 2^-126 = 2^-149 would be subnormal.
        ("sub", |x, y| x - y, [LEAST, LEAST + 1], 0),
        ("sub", |x, y| x - y, [MINUS_ZERO, 0], 0),
        ("mul", |x, y| x * y, [TWO_128, HALF], 0x7f00_0000),
        ("mul", |x, y| x * y, [minus(TWO_128), HALF], 0xff00_0000),
        ("mul", |x, y| x * y, [TWO_128, TWO], LARGEST),
        ("mul", |x, y| x * y, [minus(LARGEST), LARGEST], minus(LARGEST)),
        // (1 - 2^-24)^2 = 1 - 2^-23 + 2^-48; (1 + 2^-23)^2 = 1 + 2^-22 + 2^-46.
        ("mul", |x, y| x * y, [BELOW_ONE, BELOW_ONE], 0x3f7f_fffe),
        ("mul", |x, y| x * y, [ONE + 1, minus(ONE + 1)], minus(ONE + 2)),
        // A result of 2^-126 (1 - 2^-24) is below 2^-126, however little.
        ("mul", |x, y| x * y, [LEAST, BELOW_ONE], 0),
        ("mul", |x, y| x * y, [minus(LEAST), BELOW_ONE], 0),
        ("mul", |x, y| x * y, [minus(ONE), MINUS_ZERO], 0),
        ("mul", |x, y| x * y, [minus(LARGEST), SUBNORMAL], 0),
        // On the line of the first entry, 1 + 8190 2^-13 - 992 2^-32 Y, Y = 1 takes off 1.9 of 2^-23; cut off, that is 2.
        ("fi", Spu::fi, [ONE, 0x3f7f_fbe0], 0x3f7f_f800),
        ("fi", Spu::fi, [ONE + 1, 0x3f7f_fbe0], 0x3f7f_f7fe),
        // 1 + 8191 2^-13 - 1023 (2^19 - 1) 2^-32 = 1 + 7340033.998 2^-23.
        ("fi", Spu::fi, [0x0007_ffff, minus(LARGEST)], 0xfff0_0001),
        // w = 1 - 2^-13 = q; q + 2^-13 w = 1 - 2^-26. Even 1 / 1 is not 1.
        ("div", |x, y| x / y, [ONE, ONE], BELOW_ONE),
        ("div", |x, y| x / y, [minus(ONE), TWO], minus(BELOW_ONE - 0x0080_0000)),
        // In exact fractions, as for sqrt.
        ("div", |x, y| x / y, [0x3f9b_e869, 0x3fbd_9e88], 0x3f52_7cb2),
        ("div", |x, y| x / y, [minus(0x3fcd_1ad7), 0x3fe3_876b], minus(0x3f66_c517)),
        // w is zero from 2^126 on.
        ("div", |x, y| x / y, [LARGEST, 0x7e80_0000], 0),
        ("div", |x, y| x / y, [minus(ONE), MINUS_ZERO], LARGEST),
        ("div", |x, y| x / y, [0, 0], 0),
    ];
    let ternary: [Ternary; 15] = [
        ("fma", Spu::fma, [TWO, TWO, minus(ONE)], 0x4040_0000),
        // (1 + 2^-23)^2 - (1 + 2^-22) = 2^-46: once cut off, not twice.
        ("fma", Spu::fma, [ONE + 1, ONE + 1, minus(ONE + 2)], 0x2880_0000),
        ("fnms", Spu::fnms, [ONE + 1, ONE + 1, ONE + 2], 0xa880_0000),
        ("fnms", Spu::fnms, [TWO, TWO, ONE], 0xc040_0000),
        // 2^-252 beside 2^128, and the other way round.
        ("fma", Spu::fma, [LEAST, LEAST, TWO_128], TWO_128),
        ("fma", Spu::fma, [LEAST, LEAST, minus(TWO_128)], minus(TWO_128 - 1)),
        ("fnms", Spu::fnms, [LEAST, LEAST, TWO_128], TWO_128 - 1),
        ("fma", Spu::fma, [minus(LEAST), LEAST, LEAST], 0),
        ("fma", Spu::fma, [LEAST, LEAST, LEAST], LEAST),
        // 2^129 less than nothing is not too much, but all but 2^129: the largest number.
        ("fma", Spu::fma, [TWO_128, TWO, minus(LEAST)], LARGEST),
        // 2^256 - 2^129 is still far too much; 2^129 - 2^128 is not.
        ("fma", Spu::fma, [TWO_128, TWO_128, minus(LARGEST)], LARGEST),
        ("fnms", Spu::fnms, [TWO_128, TWO, TWO_128], minus(TWO_128)),
        ("fma", Spu::fma, [SUBNORMAL, LARGEST, MINUS_ZERO], 0),
        ("fma", Spu::fma, [SUBNORMAL, LARGEST, minus(ONE)], minus(ONE)),
        ("fnms", Spu::fnms, [ONE, ONE, ONE], 0),
    ];
    for (name, operation, x, want) in unary {
        let is = operation(Spu(x)).0;
        assert_eq!(is, want, "{name}({x:#010x}) is {is:#010x}, not {want:#010x}");
    }
    for (name, operation, [x, y], want) in binary {
        let is = operation(Spu(x), Spu(y)).0;
        assert_eq!(is, want, "{name}({x:#010x}, {y:#010x}) is {is:#010x}, not {want:#010x}");
    }
    for (name, operation, [x, y, z], want) in ternary {
        let is = operation(Spu(x), Spu(y), Spu(z)).0;
        assert_eq!(is, want, "{name}({x:#010x}, {y:#010x}, {z:#010x}) is {is:#010x}, not {want:#010x}");
    }
    let rising = [minus(LARGEST), minus(TWO_128), minus(ONE), minus(LEAST), 0, LEAST, ONE, TWO_128, LARGEST];
    for (i, &x) in rising.iter().enumerate() {
        for (j, &y) in rising.iter().enumerate() {
            assert_eq!((Spu(x).less(Spu(y)), Spu(x).less_equal(Spu(y))), (i < j, i <= j), "{x:#x}, {y:#x}");
        }
    }
    for [x, y] in [[0, MINUS_ZERO], [MINUS_ZERO, 0], [SUBNORMAL, minus(SUBNORMAL)], [minus(1), SUBNORMAL]] {
        assert_eq!((Spu(x).less(Spu(y)), Spu(x).less_equal(Spu(y))), (false, true), "{x:#x}, {y:#x}");
    }
    eprintln!("{} results", unary.len() + binary.len() + ternary.len() + rising.len().pow(2) + 4);
}

/// What a pattern stands for, in units of 2^-149.
fn number(x: u32) -> BigInt {
    let (exponent, fraction) = ((x >> 23) & 0xff, x & FRACTION);
    if exponent == 0 {
        return BigInt::ZERO;
    }
    let magnitude = BigInt::from(fraction + 0x0080_0000) << (exponent - 1);
    if x >> 31 == 0 { magnitude } else { -magnitude }
}

/// The pattern for a real result in units of 2^-298: the largest one whose number is not above it in magnitude.
fn cut_off(result: &BigInt) -> u32 {
    let magnitude = BigInt::from(result.magnitude().clone());
    let (mut low, mut above) = (0u32, 0x8000_0000u32);
    while above - low > 1 {
        let middle = low + (above - low) / 2;
        if number(middle) << 149 <= magnitude { low = middle } else { above = middle }
    }
    match (low < LEAST, result.sign()) {
        (true, _) => 0,
        (_, Sign::Minus) => minus(low),
        _ => low,
    }
}

/// What was at stake in the results compared.
#[derive(Clone, Copy, Debug, Default)]
struct Stakes {
    results: u64,
    underflows: u64,
    overflows: u64,
    /// Sums that lost 20 leading bits or more, and are not zero.
    cancelled: u64,
    /// Sums of numbers too far apart for a bit of the smaller one to be kept, where it yet changed the result.
    nudged: u64,
}

impl Stakes {
    fn plus(self, other: Self) -> Self {
        Self {
            results: self.results + other.results,
            underflows: self.underflows + other.underflows,
            overflows: self.overflows + other.overflows,
            cancelled: self.cancelled + other.cancelled,
            nudged: self.nudged + other.nudged,
        }
    }

    /// Every operation on one triple of patterns.
    fn judge([x, y, z]: [u32; 3], replay: &str) -> Self {
        let mut stakes = Self::default();
        let [a, b, c] = [x, y, z].map(number);
        let product = &a * &b;
        let [a149, b149, c149]: [BigInt; 3] = [&a << 149, &b << 149, &c << 149];
        let zero = BigInt::ZERO;
        let (p, q, r) = (Spu(x), Spu(y), Spu(z));
        for (name, is, [left, right]) in [
            ("add", p + q, [&a149, &b149]),
            ("sub", p - q, [&a149, &-b149.clone()]),
            ("mul", p * q, [&product, &zero]),
            ("fma", p.fma(q, r), [&product, &c149]),
            ("fnms", p.fnms(q, r), [&-product.clone(), &c149]),
        ] {
            let result = left + right;
            let want = cut_off(&result);
            assert_eq!(
                is.0, want,
                "{name} of {x:#010x}, {y:#010x}, {z:#010x} is {:#010x}, not {want:#010x}; {replay}",
                is.0
            );
            let (lower, higher) = (left.bits().min(right.bits()), left.bits().max(right.bits()));
            stakes.results += 1;
            stakes.underflows += u64::from(want == 0 && result != zero);
            stakes.overflows += u64::from(result.bits() > 149 + 129 + 149);
            stakes.cancelled += u64::from(want != 0 && result.bits() + 20 <= higher);
            let alone = cut_off(if left.bits() < right.bits() { right } else { left });
            stakes.nudged += u64::from(lower > 0 && higher - lower > 50 && want != alone);
        }
        assert_eq!(p.less(q), a < b, "{x:#010x} < {y:#010x}; {replay}");
        assert_eq!(p.less_equal(q), a <= b, "{x:#010x} <= {y:#010x}; {replay}");
        assert_eq!((number((-p).0), (-p).0 ^ x), (-a, MINUS_ZERO), "-{x:#010x}; {replay}");
        stakes
    }
}

/// Fractions with few bits, few gaps or anything; exponents at the ends, about 1 or anywhere.
fn operand(rng: &mut impl Rng) -> u32 {
    let exponent = match rng.random_range(0..4) {
        0 => rng.random_range(0..4),
        1 => rng.random_range(252..256),
        2 => rng.random_range(120..135),
        _ => rng.random_range(0..256),
    };
    let fraction = match rng.random_range(0..5) {
        0 => 0,
        1 => 1 << rng.random_range(0..23),
        2 => FRACTION - (rng.random_range(0..2) << rng.random_range(0..23)),
        _ => rng.random_range(0..0x0080_0000),
    };
    (u32::from(rng.random::<bool>()) << 31) | (exponent << 23) | fraction
}

/// Three operands, the third of which may nearly be the product of the others, or the second nearly the first, of
/// either sign.
fn operands(rng: &mut impl Rng) -> [u32; 3] {
    let [x, y, z] = [0; 3].map(|_| operand(rng));
    let mut close = |to: u32| to.wrapping_add(rng.random_range(0..7)).wrapping_sub(3) ^ (z & MINUS_ZERO);
    match z % 4 {
        0 => [x, y, close(cut_off(&(number(x) * number(y))))],
        1 => [x, close(x), z],
        _ => [x, y, z],
    }
}

/// All triples of edges and `CGT_SPU_CASES` random triples of operands, 60,000 every day.
#[test]
fn operations_are_the_real_results_cut_off() {
    let (seed, cases) = (seed(), count("CGT_SPU_CASES", 60_000));
    eprintln!("CGT_SEED={seed}, {cases} triples, {} of edges", EDGES.len().pow(3));
    let edges = EDGES.par_iter().flat_map_iter(|&x| {
        EDGES.iter().flat_map(move |&y| EDGES.iter().map(move |&z| Stakes::judge([x, y, z], "edges")))
    });
    let edges = edges.reduce(Stakes::default, Stakes::plus);
    let random = (0..cases).into_par_iter().map(|i| {
        let operands = operands(&mut generator(seed, i));
        Stakes::judge(operands, &format!("case {i} of CGT_SEED={seed}"))
    });
    let random = random.reduce(Stakes::default, Stakes::plus);
    for (what, stakes, triples) in [("edges", edges, 30u64.pow(3)), ("random", random, cases)] {
        eprintln!("{what}: {stakes:?}");
        assert_eq!(stakes.results, 5 * triples);
        let Stakes { results, underflows, overflows, cancelled, nudged } = stakes;
        let least = underflows.min(overflows).min(cancelled).min(nudged);
        assert!(least >= results / 500, "{what}: too little is at stake");
    }
}

/// Both worlds read these tables, so nothing else tells a wrong digit from a right one. The sums are those of the tables in RPCS3
/// (`spu_frest_fraction_lut` and `spu_frsqest_fraction_lut` of `rpcs3/Emu/Cell/SPUThread.cpp`), each entry four bytes, the highest first.
#[test]
fn tables_are_those_that_emulators_record() {
    let sum = |table: &[u32]| -> String {
        let bytes: Vec<u8> = table.iter().flat_map(|entry| entry.to_be_bytes()).collect();
        Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
    };
    let sums = [
        "b53f869c48656714f36d13d62747604cfe7d727788de31c9771a56a453818f40",
        "2c89bf5d511a536effc476553b2200e50bf194390e2d1b57dea25e6951a9ea54",
    ];
    assert_eq!([sum(&FREST), sum(&FRSQEST)], sums, "FREST, FRSQEST");
}

/// The pattern of a number from 1 up to below 2.
fn from_one(fraction: u32) -> Spu {
    Spu(ONE + fraction)
}

fn significand(x: Spu) -> i64 {
    i64::from((x.0 & FRACTION) + 0x0080_0000)
}

/// Along every line of the tables `fi` is what the rule says, and never below 1.
#[test]
fn interpolation_stays_above_one_for_all_entries() {
    let entries: Vec<u32> = FREST.into_iter().chain(FRSQEST).collect();
    let lowest = entries.par_iter().map(|&entry| {
        let (base, step) = (u64::from(entry >> 10), u64::from(entry & 0x3ff));
        let mut lowest = u64::MAX;
        for along in 0..1u32 << 19 {
            let line = (1u64 << 32) + (base << 19) - step * u64::from(along);
            let is = Spu(0xa5f8_0000 | along).fi(Spu(0xc200_0000 | entry));
            assert_eq!(
                u64::from(is.0),
                0xc180_0000 + (line >> 9),
                "entry {entry:#x}, Y = {along:#x}: {:#x}",
                is.0
            );
            lowest = lowest.min(line);
        }
        lowest
    });
    let lowest = lowest.min().expect("96 entries");
    eprintln!("{} lines of 2^19 values, the lowest 1 + {} 2^-32", entries.len(), lowest - (1 << 32));
    assert_eq!(lowest, (1 << 32) + 131);
    // Of a line that falls below 1, as no entry's does, the fraction's bits stay as they are.
    assert_eq!(Spu(0xa5f8_0001).fi(Spu(0xc200_0001)), Spu(0xc27f_ffff));
}

/// w x against 1, and w² x against 1, for every fraction, of either parity of the exponent.
#[test]
fn estimates_are_as_near_as_their_tables_allow() {
    let reciprocal = |x: Spu| x.fi(x.frest());
    let root = |x: Spu| x.fi(x.frsqest());
    // w x in units of 2^-47, w² x in units of 2^-71; the latter errs twice as much as w.
    let errors = (0..1u32 << 23).into_par_iter().map(|fraction| {
        let x = from_one(fraction);
        let w = reciprocal(x);
        assert_eq!(w.0 >> 23, 126, "1/{x:?}");
        let of_reciprocal = (significand(x) * significand(w) - (1 << 47)).unsigned_abs();
        let of_root = [(x, 1), (Spu(x.0 + LEAST), 2)].map(|(x, double)| {
            let w = root(x);
            assert!(w.0 >> 23 == 126 || w.0 == ONE, "1/sqrt {x:?}");
            let w_units = i128::from(significand(w)) << ((w.0 >> 23) - 126);
            (double * i128::from(significand(x)) * w_units * w_units - (1i128 << 71)).unsigned_abs()
        });
        [u128::from(of_reciprocal) << 24, of_root[0], of_root[1]]
    });
    let errors = errors.reduce(|| [0; 3], |x, y| [x[0].max(y[0]), x[1].max(y[1]), x[2].max(y[2])]);
    let bits = |error: u128, parts: f64| (error as f64).log2() - parts;
    let found = [bits(errors[0], 71.0), bits(errors[1], 72.0), bits(errors[2], 72.0)];
    eprintln!(
        "error of 1/x at most 2^{:.3}; of 1/sqrt x 2^{:.3} where x is 1 to 2, 2^{:.3} where it is 2 to 4",
        found[0], found[1], found[2]
    );
    assert!((-12.22..-12.21).contains(&found[0]));
    assert!((-12.77..-12.76).contains(&found[1]));
    assert!((-12.52..-12.51).contains(&found[2]));
}

/// The other exponents are the same: the estimate's is the negative of x's, or half of that, as far as there is one.
#[test]
fn estimates_scale_with_the_exponent() {
    let seed = seed();
    eprintln!("CGT_SEED={seed}, 1000 fractions of each exponent and sign");
    for exponent in 1..=255u32 {
        let mut rng = generator(seed, u64::from(exponent));
        for _ in 0..1000 {
            let fraction = rng.random_range(0..LEAST);
            let sign = u32::from(rng.random::<bool>()) << 31;
            let x = Spu(sign | (exponent << 23) | fraction);
            let (at_one, of_parity) = (Spu(ONE | fraction), Spu(((128 - exponent % 2) << 23) | fraction));
            let [is, from_one] = [x, at_one].map(|x| x.fi(x.frest()).0);
            if exponent <= 252 {
                assert_eq!((is ^ sign) + (exponent << 23), from_one + ONE, "1/{x:?}");
            } else {
                assert_eq!(is & !FRACTION, sign, "1/{x:?}: from 2^126 on it is zero");
            }
            let halves = exponent.div_ceil(2);
            let [is, from_one] = [x, of_parity].map(|x| x.fi(x.frsqest()).0);
            assert_eq!(is + (halves << 23), from_one + (64 << 23), "1/sqrt {x:?}");
        }
    }
}

fn range(counts: &BTreeMap<i64, u64>) -> [i64; 2] {
    [*counts.keys().next().expect("some"), *counts.keys().next_back().expect("some")]
}

fn tally(of: impl ParallelIterator<Item = i64>) -> BTreeMap<i64, u64> {
    let counts = of.fold(BTreeMap::new, |mut counts, n| {
        *counts.entry(n).or_default() += 1;
        counts
    });
    counts.reduce(BTreeMap::new, |mut x, y| {
        y.into_iter().for_each(|(n, count)| *x.entry(n).or_default() += count);
        x
    })
}

/// In units of the last place.
fn steps(is: Spu, want: u32) -> i64 {
    i64::from(is.0) - i64::from(want)
}

/// The pattern of the root of a number that is at least 2^-126, cut off.
fn true_root(x: Spu) -> u32 {
    let (exponent, odd) = (x.0 >> 23, (x.0 >> 23) % 2);
    let root = (significand(x).unsigned_abs() << (24 - odd)).isqrt();
    (((exponent + 126 + odd) / 2) << 23) + (u32::try_from(root).expect("24 bits") - LEAST)
}

/// The pattern of a quotient of numbers above zero, cut off, where it has an exponent from 1 to 255.
fn true_quotient(x: Spu, y: Spu) -> u32 {
    let (m, n) = (significand(x), significand(y));
    let below_one = u32::from(m < n);
    let quotient = u32::try_from((m << (23 + below_one)) / n).expect("24 bits");
    (((x.0 >> 23) + 127 - (y.0 >> 23) - below_one) << 23) + (quotient - LEAST)
}

/// From this exponent on no remainder x − g² or x − qy underflows: being whole multiples of 2^-47 of x's power of two,
/// they are 2^-126 at least or zero.
const NOTHING_UNDERFLOWS: u32 = 48;
/// What the estimates are worth without the step that remainders are for: 2^24 × 2^-12.2.
const BARE: i64 = 3566;

/// All fractions of two exponents are all there is, as long as nothing underflows: the others are the same. Below that
/// exponent the step of Newton's fades, until the estimate stands alone.
#[test]
fn roots_are_cut_off_or_one_below() {
    let of = |x: u32| steps(Spu(x).sqrt(), true_root(Spu(x)));
    let counts = tally((0..1u32 << 24).into_par_iter().map(|x| of(ONE + x)));
    eprintln!("2^24 roots, units in the last place from the true root cut off: {counts:?}");
    assert_eq!((range(&counts), counts.values().sum()), ([-1, 0], 1u64 << 24));

    let seed = seed();
    eprintln!("CGT_SEED={seed}, 4096 fractions of each exponent");
    let any = |exponent: u32| {
        let mut rng = generator(seed, u64::from(exponent));
        (0..4096).map(move |_| (exponent << 23) | rng.random_range(0..LEAST))
    };
    for x in (NOTHING_UNDERFLOWS..=255).flat_map(any) {
        let exponent = x >> 23;
        let from_one = (x & FRACTION) | ((128 - exponent % 2) << 23);
        let halves = exponent.div_ceil(2) << 23;
        assert_eq!(Spu(x).sqrt().0 + (64 << 23), Spu(from_one).sqrt().0 + halves, "{x:#x}");
    }
    let worst = (1..NOTHING_UNDERFLOWS).map(|e| (e, range(&tally(any(e).par_bridge().map(of)))));
    let worst: Vec<(u32, [i64; 2])> = worst.collect();
    eprintln!("of x = 2^(e - 127) to twice that, by e: {worst:?}");
    assert!(worst.iter().all(|(_, [low, high])| -BARE <= *low && *high <= BARE));
    let alone = worst.iter().any(|(_, [low, high])| *low < -1000 && *high > 1000);
    assert!(alone, "at the bottom the estimate stands alone");
}

/// All inverses of one exponent and `CGT_SPU_QUOTIENTS` random quotients, 2^21 every day.
#[test]
fn quotients_are_cut_off_or_one_below() {
    let (seed, cases) = (seed(), count("CGT_SPU_QUOTIENTS", 1 << 21));
    eprintln!("CGT_SEED={seed}, {cases} quotients");
    let of = |x: Spu, y: Spu| steps(x / y, true_quotient(x, y));
    let inverse = tally((0..1u32 << 23).into_par_iter().map(|y| of(Spu(ONE), from_one(y))));
    eprintln!("2^23 inverses, units in the last place from the true one cut off: {inverse:?}");
    assert_eq!((range(&inverse), inverse.values().sum()), ([-1, 0], 1u64 << 23));

    let pattern = |exponents: std::ops::Range<u32>, rng: &mut dyn Rng| {
        Spu(rng.random_range(exponents.start << 23..exponents.end << 23))
    };
    let any = tally((0..cases).into_par_iter().map(|i| {
        let mut rng = generator(seed, i);
        let y = pattern(1..253, &mut rng);
        // So that the quotient is from 2^-125 to 2^127.
        let lowest = NOTHING_UNDERFLOWS.max((y.0 >> 23).saturating_sub(124));
        let x = pattern(lowest..256.min((y.0 >> 23) + 127), &mut rng);
        of(x, y)
    }));
    eprintln!("random quotients: {any:?}");
    assert_eq!((range(&any), any.values().sum()), ([-1, 0], cases));

    let worst = (1..NOTHING_UNDERFLOWS).map(|e| {
        let mut rng = generator(seed, u64::from(e));
        let pairs = (0..4096).map(|_| (pattern(e..e + 1, &mut rng), pattern(100..101, &mut rng)));
        (e, range(&tally(pairs.collect::<Vec<_>>().into_par_iter().map(|(x, y)| of(x, y)))))
    });
    let worst: Vec<(u32, [i64; 2])> = worst.collect();
    eprintln!("of x = 2^(e - 127) to twice that by 2^-27 to 2^-26, by e: {worst:?}");
    assert!(worst.iter().all(|(_, [low, high])| -BARE <= *low && *high <= BARE));
    let alone = worst.iter().any(|(_, [low, high])| *low < -1000 && *high > 1000);
    assert!(alone, "at the bottom the estimate stands alone");
}

const FORMS: [Arithmetic; 2] = [Arithmetic::SpuTextbook, Arithmetic::SpuPerpendicular];

fn ball(center: [f32; 3], radius: f32) -> Sphere {
    Sphere { center, radius, color: [9; 3] }
}

/// The nearest hit of a ray: id and pattern of t.
fn hit_of(form: Arithmetic, ray: Ray, spheres: &[Sphere]) -> Option<(u32, u32)> {
    let scene = Scene::new(spheres.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
    Tracer::new(form).trace(&ray, &scene).map(|hit| (hit.id, hit.t.to_bits()))
}

/// That of a ray from the origin.
fn hit(form: Arithmetic, dir: [f32; 3], spheres: &[Sphere]) -> Option<(u32, u32)> {
    hit_of(form, Ray { eye: [0.0; 3], dir }, spheres)
}

#[test]
fn hits_worked_out_by_hand() {
    let ahead = [0.0, 0.0, 1.0];
    let unit = |z| ball([0.0, 0.0, z], 1.0);
    let both = |dir, spheres: &[Sphere]| FORMS.map(|form| hit(form, dir, spheres));
    // sqrt(1) = 1 - 2^-24, so near = 5 - that = 4, and 4 / 1 = 4 - 2^-22. Of the other form w = 1 / 1 = 1 - 2^-24, h = -5 + 2^-21,
    // l = -2^-21, D = 1 - 2^-24, D w = 1 - 2^-23 = s and near = 4 - 3 2^-23.
    assert_eq!(both(ahead, &[unit(5.0)]), [Some((0, 0x407f_ffff)), Some((0, 0x407f_fffe))]);
    // From the centre: far = sqrt(1) = 1 - 2^-24, by 1 again cut off; or the root of D w = 1 - 2^-24, which is that.
    assert_eq!(both(ahead, &[unit(0.0)]), [Some((0, 0x3f7f_fffe)), Some((0, BELOW_ONE))]);
    assert_eq!(both(ahead, &[unit(-5.0), ball([3.0, 0.0, 5.0], 1.0)]), [None, None]);
    assert_eq!(both(ahead, &[]), [None, None]);
    // The nearest of several, and the first of equals, one of which has a radius that is zero here and on which D = 0.
    let several = [unit(9.0), unit(5.0), unit(7.0), unit(5.0)];
    assert_eq!(both(ahead, &several), [Some((1, 0x407f_ffff)), Some((1, 0x407f_fffe))]);
    let speck = ball([0.0, 0.0, 5.0], f32::from_bits(SUBNORMAL));
    assert_eq!(hit(FORMS[0], ahead, &[speck]), Some((0, 0x409f_ffff)));

    // A direction of zeros hits nothing, even from inside. That its square underflows does not make it zero: then w is
    // the largest number, and t its root.
    let zeros = [0.0, -0.0, f32::from_bits(SUBNORMAL)];
    assert_eq!(both(zeros, &[unit(0.0)]), [None, None]);
    let root = Spu(LARGEST).sqrt().0;
    assert_eq!(both([0.0, 0.0, 1e-30], &[unit(0.0)]), [None, Some((0, root))]);
    assert!(steps(Spu(root), true_root(Spu(LARGEST))).abs() <= 1);
}

/// Rays askew, whose t were worked out in exact fractions, apart from all programs here. t is another where a sum of
/// products is fused or added up from its other end, or where b² − a q or f − h d is fused.
#[test]
fn operations_of_the_forms_stand_in_the_order_of_the_contract() {
    let cases = [
        ([-2.3, -1.5, 0.9], [0.3, 1.2, 1.6], [-0.3, 3.4, 10.5], 2.2, [0x4098_e317, 0x4098_e31c]),
        ([0.1, -0.7, -1.3], [-0.4, 0.8, 1.3], [-1.8, 2.6, 5.0], 1.4, [0x4074_bff7, 0x4074_bfed]),
        ([0.2, -2.4, 0.5], [-0.2, -0.7, 1.3], [-2.0, -5.8, 6.7], 2.9, [0x4048_e4d0, 0x4048_e4ce]),
        ([0.1, 2.1, 1.2], [-0.5, 0.1, -0.4], [-4.4, 2.0, 0.0], 2.2, [0x40a4_53bd, 0x40a4_53c3]),
    ];
    for (eye, dir, center, radius, t) in cases {
        let is = FORMS.map(|form| hit_of(form, Ray { eye, dir }, &[ball(center, radius)]));
        assert_eq!(is, t.map(|t| Some((0, t))), "{eye:?} + t {dir:?}, {center:?}, {radius}");
    }
}

/// t up to the pattern of +∞ is a hit, t above is none.
#[test]
fn t_ends_with_two_to_the_128th() {
    let along = [0.0, 0.0, f32::from_bits(TINY)];
    let two64 = f32::from_bits((127 + 64) << 23);
    // The far side at 2^65, to some units: 0.6 and 1.4 times 2^64 add up to that. The other form needs a centre there.
    // The direction being 2^-63, t is 2^128.
    let inside = |k: u32| ball([0.0, 0.0, 0.6 * two64], f32::from_bits((1.4 * two64).to_bits() - 40 + k));
    let outside = |k: u32| ball([0.0, 0.0, f32::from_bits((2.0 * two64).to_bits() - 40 + k)], 4e13);
    let t_of = |form, ball| hit(form, along, &[ball]).map(|(_, t)| t);
    let textbook: Vec<Option<u32>> = (0..80).map(|k| t_of(FORMS[0], inside(k))).collect();
    let perpendicular: Vec<Option<u32>> = (0..80).map(|k| t_of(FORMS[1], outside(k))).collect();
    for (form, t) in FORMS.into_iter().zip([textbook, perpendicular]) {
        let hits: Vec<u32> = t.iter().map_while(|&t| t).collect();
        eprintln!("{form:?}: {} balls hit up to t = 2^128, {} not hit", hits.len(), t.len() - hits.len());
        assert!(hits.is_sorted() && hits.len() >= 20 && t.len() - hits.len() >= 20, "{form:?}: {t:x?}");
        assert_eq!(hits.last(), Some(&TWO_128), "{form:?}");
        assert_eq!(hits.len(), t.iter().flatten().count(), "{form:?}: a hit above 2^128");
    }
}
