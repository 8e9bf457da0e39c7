//! The arithmetic of the SPU (contract, rule 6) on any host: its numbers as bits, its operations by way of f64.
//!
//! An f64 holds every number of the SPU and every product of two. A sum is rounded to f64 and its error found exactly (Knuth's
//! two-sum); where the error points towards zero, the f64 below is taken. It has 29 more bits than are kept, so that cutting these off
//! cuts off the real sum: between the f64 and the real sum there is no number of 24 bits but possibly the f64 itself.
//!
//! Where f32 has all operands and results of sixteen lanes, the host converts between f32 and f64, several lanes at once; else that is
//! done bit by bit.
//!
//! These operations are calls, unlike those of the machines that are there for speed: inlined into every kernel of every level they
//! make a program that takes a quarter of an hour to compile.

use crate::machine::{LANES, Machine, Site};
use contract::spu::{FREST, FRSQEST};
use fearless_simd::Level;
#[cfg(target_arch = "x86_64")]
use fearless_simd::Simd;

/// Sixteen lanes of SPU numbers, as patterns; by default in the instructions that every processor of this kind has.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spu(Option<Level>);

impl Spu {
    /// In the instructions of a level, where that makes a difference.
    #[allow(dead_code, reason = "WebAssembly without SIMD128 has no level")]
    #[inline(always)]
    pub(super) fn at(level: Level) -> Self {
        Self(Some(level))
    }

    /// Does work in those instructions.
    #[inline(always)]
    fn door<R>(self, f: impl FnOnce() -> R) -> R {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Some(Level::Avx2(simd)) => simd.vectorize(f),
            _ => f(),
        }
    }
}

/// The largest number.
const LARGEST: u32 = 0x7fff_ffff;
const SIGN: u32 = 1 << 31;
const EXPONENT: u32 = 0x7f80_0000;

/// Twice the step from a number of 24 bits to the next: quotients and roots are cut off, or one unit in the last place below.
pub(super) const UNIT: f32 = 1.0 / (1u32 << 22) as f32;

/// The number that a pattern is.
#[inline(always)]
fn number(x: u32) -> f64 {
    let exponent = x >> 23 & 0xff;
    let magnitude = u64::from(exponent + 1023 - 127) << 52 | u64::from(x & 0x7f_ffff) << 29;
    let sign = u64::from(x & SIGN) << 32;
    if exponent == 0 { 0.0 } else { f64::from_bits(sign | magnitude) }
}

/// The pattern of a number that f64 holds, cut off.
#[inline(always)]
#[allow(clippy::cast_possible_truncation, reason = "of bits that are few enough")]
fn cut(x: f64) -> u32 {
    let bits = x.to_bits();
    let (sign, exponent) = ((bits >> 32) as u32 & SIGN, (bits >> 52) as i32 & 0x7ff);
    let exponent = exponent - (1023 - 127);
    if exponent <= 0 {
        0
    } else if exponent > 255 {
        sign | LARGEST
    } else {
        sign | exponent.cast_unsigned() << 23 | ((bits >> 29) as u32 & 0x7f_ffff)
    }
}

/// A sum of two numbers, which cut off is the real sum cut off.
#[inline(always)]
fn sum(x: f64, y: f64) -> f64 {
    let sum = x + y;
    let part = sum - x;
    let error = (x - (sum - part)) + (y - part);
    let below = f64::from_bits(sum.to_bits().wrapping_sub(1));
    if error != 0.0 && (error < 0.0) != (sum < 0.0) { below } else { sum }
}

#[inline(always)]
pub(super) fn add(x: u32, y: u32) -> u32 {
    cut(sum(number(x), number(y)))
}

/// x y + z.
#[inline(always)]
pub(super) fn fma(x: u32, y: u32, z: u32) -> u32 {
    cut(sum(number(x) * number(y), number(z)))
}

/// z − x y.
#[inline(always)]
pub(super) fn fnms(x: u32, y: u32, z: u32) -> u32 {
    cut(sum(number(z), -(number(x) * number(y))))
}

#[inline(always)]
pub(super) fn mul(x: u32, y: u32) -> u32 {
    cut(number(x) * number(y))
}

/// Zero for what is read as zero.
#[inline(always)]
fn read(x: u32) -> u32 {
    if x & EXPONENT == 0 { 0 } else { x }
}

/// The number that a pattern is, as an integer in the same order.
#[inline(always)]
fn rank(x: u32) -> i32 {
    let x = read(x);
    let magnitude = (x & !SIGN).cast_signed();
    if x & SIGN == 0 { magnitude } else { -magnitude }
}

/// An operation of f64 cut off, or `again` on all lanes if f32 has not every operand and result. What f32 has not is an infinity or no number
/// there, and what comes of it is one too.
#[inline(always)]
fn by_f32(
    [x, y, z]: [[u32; LANES]; 3],
    operation: impl Fn(f64, f64, f64) -> f64,
    again: impl Fn(u32, u32, u32) -> u32,
) -> [u32; LANES] {
    let (mut out, mut beyond) = ([0; LANES], false);
    for i in 0..LANES {
        let [x, y, z] = [x[i], y[i], z[i]].map(
            #[inline(always)]
            |x| f64::from(f32::from_bits(read(x))),
        );
        let cut = f64::from_bits(operation(x, y, z).to_bits() & !0x1fff_ffff);
        let kept = if cut.abs() < f64::from(f32::MIN_POSITIVE) { 0.0 } else { cut };
        #[allow(clippy::cast_possible_truncation, reason = "of 24 bits")]
        let kept = (kept as f32).to_bits();
        beyond |= kept & EXPONENT == EXPONENT;
        out[i] = kept;
    }
    if beyond { by_bits([x, y, z], again) } else { out }
}

#[cold]
#[inline(never)]
fn by_bits([x, y, z]: [[u32; LANES]; 3], again: impl Fn(u32, u32, u32) -> u32) -> [u32; LANES] {
    let mut out = [0; LANES];
    for i in 0..LANES {
        out[i] = again(x[i], y[i], z[i]);
    }
    out
}

/// x y on all lanes.
#[inline(always)]
fn mul_each(x: [u32; LANES], y: [u32; LANES]) -> [u32; LANES] {
    by_f32(
        [x, y, y],
        #[inline(always)]
        |x, y, _| x * y,
        #[inline(always)]
        |x, y, _| mul(x, y),
    )
}

/// x y + z on all lanes.
#[inline(always)]
fn fma_each(x: [u32; LANES], y: [u32; LANES], z: [u32; LANES]) -> [u32; LANES] {
    by_f32(
        [x, y, z],
        #[inline(always)]
        |x, y, z| sum(x * y, z),
        fma,
    )
}

/// z − x y on all lanes.
#[inline(always)]
fn fnms_each(x: [u32; LANES], y: [u32; LANES], z: [u32; LANES]) -> [u32; LANES] {
    by_f32(
        [x, y, z],
        #[inline(always)]
        |x, y, z| sum(z, -(x * y)),
        fnms,
    )
}

/// Rule 6's `frest`.
#[inline(always)]
fn frest(x: u32) -> u32 {
    let (sign, exponent) = (x & SIGN, x >> 23 & 0xff);
    if exponent == 0 {
        return sign | LARGEST;
    }
    sign | 253u32.saturating_sub(exponent) << 23 | FREST[(x >> 18 & 31) as usize]
}

/// Rule 6's `frsqest`.
#[inline(always)]
fn frsqest(x: u32) -> u32 {
    let exponent = x >> 23 & 0xff;
    if exponent == 0 {
        return LARGEST;
    }
    (190 - exponent.div_ceil(2)) << 23 | FRSQEST[(x >> 18 & 63) as usize]
}

/// Rule 6's `fi`, in units of 2⁻²³.
#[inline(always)]
fn fi(x: u32, y: u32) -> u32 {
    let (base, step) = (1 << 13 | y >> 10 & 0x1fff, y & 0x3ff);
    let fall = (step * (x & 0x7_ffff)).div_ceil(1 << 9);
    y & 0xff80_0000 | ((base << 10) - fall) & 0x7f_ffff
}

/// What one operation does, on all lanes. A loop and no `from_fn`: that may stay a call.
#[inline(always)]
fn each<A: Copy, B: Copy, R: Copy>(
    x: [A; LANES],
    y: [B; LANES],
    zero: R,
    f: impl Fn(A, B) -> R,
) -> [R; LANES] {
    let mut out = [zero; LANES];
    for i in 0..LANES {
        out[i] = f(x[i], y[i]);
    }
    out
}

/// The number as an integer that is reached by `f`, saturated.
#[inline(always)]
#[allow(clippy::cast_possible_truncation, reason = "`as` saturates")]
fn integer(x: [u32; LANES], f: impl Fn(f64) -> f64) -> [i32; LANES] {
    each(
        x,
        x,
        0,
        #[inline(always)]
        |x, _| f(number(x)) as i32,
    )
}

impl Machine for Spu {
    type F = [u32; LANES];
    type I = [i32; LANES];
    type B = [bool; LANES];
    type Spu = Self;

    #[inline(always)]
    fn spu(self) -> Self {
        self
    }
    #[inline(always)]
    fn unit(self) -> f32 {
        UNIT
    }
    #[inline(always)]
    fn lanes(self, x: [f32; LANES]) -> Self::F {
        each(
            x,
            x,
            0,
            #[inline(always)]
            |x, _| x.to_bits(),
        )
    }
    #[inline(always)]
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        x
    }
    #[inline(always)]
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        each(
            x,
            x,
            0.0,
            #[inline(always)]
            |x, _| f32::from_bits(x),
        )
    }
    #[inline(always)]
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        x
    }
    #[inline(always)]
    fn to_bits(self, x: Self::B) -> u32 {
        let mut bits = 0;
        for (i, x) in x.into_iter().enumerate() {
            bits |= u32::from(x) << i;
        }
        bits
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Self::F {
        [x.to_bits(); LANES]
    }
    #[inline(always)]
    fn splat_i(self, x: i32) -> Self::I {
        [x; LANES]
    }
    #[inline(never)]
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        self.door(
            #[inline(always)]
            || {
                by_f32(
                    [x, y, y],
                    #[inline(always)]
                    |x, y, _| sum(x, y),
                    #[inline(always)]
                    |x, y, _| add(x, y),
                )
            },
        )
    }
    #[inline(always)]
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        self.add(x, self.neg(y))
    }
    #[inline(never)]
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        self.door(
            #[inline(always)]
            || mul_each(x, y),
        )
    }
    #[inline(never)]
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        self.door(
            #[inline(always)]
            || {
                let w = each(
                    y,
                    y,
                    0,
                    #[inline(always)]
                    |y, _| fi(y, frest(y)),
                );
                let q = mul_each(x, w);
                fma_each(fnms_each(q, y, x), w, q)
            },
        )
    }
    #[inline(never)]
    fn sqrt(self, x: Self::F) -> Self::F {
        self.door(
            #[inline(always)]
            || {
                let w = each(
                    x,
                    x,
                    0,
                    #[inline(always)]
                    |x, _| fi(x, frsqest(x)),
                );
                let g = mul_each(x, w);
                fma_each(fnms_each(g, g, x), mul_each(w, [0.5f32.to_bits(); LANES]), g)
            },
        )
    }
    #[inline(always)]
    fn neg(self, x: Self::F) -> Self::F {
        each(
            x,
            x,
            0,
            #[inline(always)]
            |x, _| x ^ SIGN,
        )
    }
    #[inline(never)]
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        each(
            x,
            y,
            false,
            #[inline(always)]
            |x, y| rank(x) < rank(y),
        )
    }
    #[inline(never)]
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        each(
            x,
            y,
            false,
            #[inline(always)]
            |x, y| rank(x) <= rank(y),
        )
    }
    #[inline(always)]
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        each(
            x,
            y,
            false,
            #[inline(always)]
            |x, y| x < y,
        )
    }
    #[inline(always)]
    fn and(self, x: Self::B, y: Self::B) -> Self::B {
        each(
            x,
            y,
            false,
            #[inline(always)]
            |x, y| x & y,
        )
    }
    #[inline(always)]
    fn or(self, x: Self::B, y: Self::B) -> Self::B {
        each(
            x,
            y,
            false,
            #[inline(always)]
            |x, y| x | y,
        )
    }
    #[inline(always)]
    fn not(self, x: Self::B) -> Self::B {
        each(
            x,
            x,
            false,
            #[inline(always)]
            |x, _| !x,
        )
    }
    #[inline(always)]
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F {
        let mut out = no;
        for i in 0..LANES {
            out[i] = if choose[i] { yes[i] } else { no[i] };
        }
        out
    }
    #[inline(always)]
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        let mut out = no;
        for i in 0..LANES {
            out[i] = if choose[i] { yes[i] } else { no[i] };
        }
        out
    }
    #[inline(always)]
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        each(x, y, 0, i32::wrapping_add)
    }
    #[inline(always)]
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        each(
            x,
            y,
            0,
            #[inline(always)]
            |x, y| x | y,
        )
    }
    #[inline(always)]
    fn shl_16(self, x: Self::I) -> Self::I {
        each(
            x,
            x,
            0,
            #[inline(always)]
            |x, _| x << 16,
        )
    }
    #[inline(always)]
    fn shr_16(self, x: Self::I) -> Self::I {
        each(
            x,
            x,
            0,
            #[inline(always)]
            |x, _| (x.cast_unsigned() >> 16).cast_signed(),
        )
    }
    #[inline(never)]
    fn floor(self, x: Self::F) -> Self::I {
        integer(x, f64::floor)
    }
    #[inline(never)]
    fn truncate(self, x: Self::F) -> Self::I {
        integer(x, f64::trunc)
    }
    #[inline(never)]
    fn smallest(self, x: Self::F) -> Self::F {
        let mut least = x[0];
        for x in x {
            least = if rank(x) < rank(least) { x } else { least };
        }
        [least; LANES]
    }
    #[inline(never)]
    fn largest(self, x: Self::F) -> Self::F {
        let mut most = x[0];
        for x in x {
            most = if rank(x) > rank(most) { x } else { most };
        }
        [most; LANES]
    }
    #[inline(always)]
    fn any(self, x: Self::B, _: Site) -> bool {
        self.to_bits(x) != 0
    }
}
