//! The arithmetic of the SPU (contract, rule 6) in AVX-512, whose instructions can each be told to round towards zero.
//!
//! That differs from rule 6 in four ways, each mended: subnormal operands are made zero before an operation, subnormal results
//! and −0 are made +0 after it; where a result has the exponent 254 or more, as it has if an operand has 255, one of them might be a number
//! that IEEE 754 has not, and the operation is done again as [`Spu`] does it. No control register is touched.
#![allow(unsafe_code, reason = "intrinsics; each names why it may be called")]

use super::spu::{self, Spu, UNIT};
use crate::machine::{LANES, Machine, Site};
use contract::spu::{FREST, FRSQEST};
use fearless_simd::Avx512;
use std::arch::x86_64::*;

/// Sixteen lanes of SPU numbers in a register. That the token exists shows that the processor has AVX-512; this is the SAFETY of
/// every line below.
#[derive(Clone, Copy, Debug)]
pub struct Truncating(pub Avx512);

const TOWARDS_ZERO: i32 = _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC;
const EXPONENT: i32 = 0x7f80_0000;

/// Zeros for what is read as zero.
#[inline(always)]
fn read(x: __m512i) -> __m512i {
    // SAFETY: called by operations of `Truncating` alone.
    unsafe { _mm512_maskz_mov_epi32(_mm512_test_epi32_mask(x, _mm512_set1_epi32(EXPONENT)), x) }
}

/// Lanes of a result that may not be the SPU's: from the exponent of IEEE 754's greatest number on. An operand beyond that IEEE 754 has as
/// an infinity or no number, and then the result is one too.
#[inline(always)]
fn beyond(out: __m512i) -> __mmask16 {
    // SAFETY: called by operations of `Truncating` alone.
    unsafe {
        let exponent = _mm512_and_si512(out, _mm512_set1_epi32(EXPONENT));
        _mm512_cmpge_epi32_mask(exponent, _mm512_set1_epi32(0x7f00_0000))
    }
}

/// An operation of AVX-512, or where that may not do `again`.
#[inline(always)]
fn mended(
    operands: [__m512i; 3],
    operation: impl FnOnce([__m512; 3]) -> __m512,
    again: fn(u32, u32, u32) -> u32,
) -> __m512i {
    let [x, y, z] = operands;
    let [x, y, z] = [read(x), read(y), read(z)];
    // SAFETY: called by operations of `Truncating` alone.
    let out = unsafe {
        let [x, y, z] = [_mm512_castsi512_ps(x), _mm512_castsi512_ps(y), _mm512_castsi512_ps(z)];
        _mm512_castps_si512(operation([x, y, z]))
    };
    if beyond(out) == 0 { read(out) } else { by_spu([x, y, z], again) }
}

#[cold]
#[inline(never)]
fn by_spu(operands: [__m512i; 3], again: fn(u32, u32, u32) -> u32) -> __m512i {
    let [x, y, z] = operands.map(array);
    vector(std::array::from_fn(|i| again(x[i], y[i], z[i])))
}

#[inline(always)]
fn array(x: __m512i) -> [u32; LANES] {
    // SAFETY: both are 64 bytes of plain integers.
    unsafe { std::mem::transmute(x) }
}

#[inline(always)]
fn vector(x: [u32; LANES]) -> __m512i {
    // SAFETY: both are 64 bytes of plain integers.
    unsafe { std::mem::transmute(x) }
}

/// Numbers as integers in the same order.
#[inline(always)]
fn ranks(x: __m512i) -> __m512i {
    let x = read(x);
    // SAFETY: called by operations of `Truncating` alone.
    unsafe {
        let magnitude = _mm512_and_si512(x, _mm512_set1_epi32(0x7fff_ffff));
        let negative = _mm512_cmplt_epi32_mask(x, _mm512_setzero_si512());
        _mm512_mask_sub_epi32(magnitude, negative, _mm512_setzero_si512(), magnitude)
    }
}

impl Truncating {
    #[inline(always)]
    fn fma(self, x: __m512i, y: __m512i, z: __m512i) -> __m512i {
        mended(
            [x, y, z],
            // SAFETY: see `Truncating`.
            #[inline(always)]
            |[x, y, z]| unsafe { _mm512_fmadd_round_ps::<TOWARDS_ZERO>(x, y, z) },
            spu::fma,
        )
    }

    #[inline(always)]
    fn fnms(self, x: __m512i, y: __m512i, z: __m512i) -> __m512i {
        mended(
            [x, y, z],
            // SAFETY: see `Truncating`.
            #[inline(always)]
            |[x, y, z]| unsafe { _mm512_fnmadd_round_ps::<TOWARDS_ZERO>(x, y, z) },
            spu::fnms,
        )
    }

    /// `fi` of x and the entries of a table.
    #[inline(always)]
    fn interpolate(self, x: __m512i, exponent: __m512i, entry: __m512i) -> __m512i {
        // SAFETY: see `Truncating`.
        unsafe {
            let base = _mm512_or_si512(
                _mm512_set1_epi32(1 << 13),
                _mm512_and_si512(_mm512_srli_epi32::<10>(entry), _mm512_set1_epi32(0x1fff)),
            );
            let step = _mm512_and_si512(entry, _mm512_set1_epi32(0x3ff));
            let fall = _mm512_mullo_epi32(step, _mm512_and_si512(x, _mm512_set1_epi32(0x7_ffff)));
            let fall = _mm512_srli_epi32::<9>(_mm512_add_epi32(fall, _mm512_set1_epi32(511)));
            let fraction = _mm512_sub_epi32(_mm512_slli_epi32::<10>(base), fall);
            _mm512_or_si512(exponent, _mm512_and_si512(fraction, _mm512_set1_epi32(0x7f_ffff)))
        }
    }

    /// `fi(x, frest(x))`.
    #[inline(always)]
    fn reciprocal(self, x: __m512i) -> __m512i {
        // SAFETY: see `Truncating`; an index is below 32.
        unsafe {
            let sign = _mm512_and_si512(x, _mm512_set1_epi32(i32::MIN));
            let exponent = _mm512_and_si512(_mm512_srli_epi32::<23>(x), _mm512_set1_epi32(0xff));
            let flipped = _mm512_sub_epi32(_mm512_set1_epi32(253), exponent);
            let flipped = _mm512_max_epi32(flipped, _mm512_setzero_si512());
            let index = _mm512_and_si512(_mm512_srli_epi32::<18>(x), _mm512_set1_epi32(31));
            let entry = _mm512_i32gather_epi32::<4>(index, FREST.as_ptr().cast());
            let zero = _mm512_testn_epi32_mask(exponent, exponent);
            let largest = _mm512_set1_epi32(0x7fff_ffff);
            let entry = _mm512_mask_mov_epi32(entry, zero, largest);
            let flipped = _mm512_mask_mov_epi32(flipped, zero, _mm512_set1_epi32(255));
            self.interpolate(x, _mm512_or_si512(sign, _mm512_slli_epi32::<23>(flipped)), entry)
        }
    }

    /// `fi(x, frsqest(x))`.
    #[inline(always)]
    fn reciprocal_root(self, x: __m512i) -> __m512i {
        // SAFETY: see `Truncating`; an index is below 64.
        unsafe {
            let exponent = _mm512_and_si512(_mm512_srli_epi32::<23>(x), _mm512_set1_epi32(0xff));
            let half = _mm512_srli_epi32::<1>(_mm512_add_epi32(exponent, _mm512_set1_epi32(1)));
            let flipped = _mm512_sub_epi32(_mm512_set1_epi32(190), half);
            let index = _mm512_and_si512(_mm512_srli_epi32::<18>(x), _mm512_set1_epi32(63));
            let entry = _mm512_i32gather_epi32::<4>(index, FRSQEST.as_ptr().cast());
            let zero = _mm512_testn_epi32_mask(exponent, exponent);
            let entry = _mm512_mask_mov_epi32(entry, zero, _mm512_set1_epi32(0x7fff_ffff));
            let flipped = _mm512_mask_mov_epi32(flipped, zero, _mm512_set1_epi32(255));
            self.interpolate(x, _mm512_slli_epi32::<23>(flipped), entry)
        }
    }
}

impl Machine for Truncating {
    type F = __m512i;
    type I = __m512i;
    type B = __mmask16;
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
        // SAFETY: both are 64 bytes of which every pattern is a value.
        unsafe { std::mem::transmute(x) }
    }
    #[inline(always)]
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        // SAFETY: both are 64 bytes of which every pattern is a value.
        unsafe { std::mem::transmute(x) }
    }
    #[inline(always)]
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        // SAFETY: both are 64 bytes of which every pattern is a value.
        unsafe { std::mem::transmute(x) }
    }
    #[inline(always)]
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        // SAFETY: both are 64 bytes of which every pattern is a value.
        unsafe { std::mem::transmute(x) }
    }
    #[inline(always)]
    fn to_bits(self, x: Self::B) -> u32 {
        u32::from(x)
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Self::F {
        self.splat_i(x.to_bits().cast_signed())
    }
    #[inline(always)]
    fn splat_i(self, x: i32) -> Self::I {
        // SAFETY: see `Truncating`.
        unsafe { _mm512_set1_epi32(x) }
    }
    #[inline(always)]
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        mended(
            [x, y, y],
            // SAFETY: see `Truncating`.
            #[inline(always)]
            |[x, y, _]| unsafe { _mm512_add_round_ps::<TOWARDS_ZERO>(x, y) },
            |x, y, _| spu::add(x, y),
        )
    }
    #[inline(always)]
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        self.add(x, self.neg(y))
    }
    #[inline(always)]
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        mended(
            [x, y, y],
            // SAFETY: see `Truncating`.
            #[inline(always)]
            |[x, y, _]| unsafe { _mm512_mul_round_ps::<TOWARDS_ZERO>(x, y) },
            |x, y, _| spu::mul(x, y),
        )
    }
    #[inline(always)]
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        let w = self.reciprocal(y);
        let q = self.mul(x, w);
        self.fma(self.fnms(q, y, x), w, q)
    }
    #[inline(always)]
    fn sqrt(self, x: Self::F) -> Self::F {
        let w = self.reciprocal_root(x);
        let g = self.mul(x, w);
        self.fma(self.fnms(g, g, x), self.mul(w, self.splat(0.5)), g)
    }
    #[inline(always)]
    fn neg(self, x: Self::F) -> Self::F {
        // SAFETY: see `Truncating`.
        unsafe { _mm512_xor_si512(x, _mm512_set1_epi32(i32::MIN)) }
    }
    #[inline(always)]
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        self.lt_i(ranks(x), ranks(y))
    }
    #[inline(always)]
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        !self.lt(y, x)
    }
    #[inline(always)]
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        // SAFETY: see `Truncating`.
        unsafe { _mm512_cmplt_epi32_mask(x, y) }
    }
    #[inline(always)]
    fn and(self, x: Self::B, y: Self::B) -> Self::B {
        x & y
    }
    #[inline(always)]
    fn or(self, x: Self::B, y: Self::B) -> Self::B {
        x | y
    }
    #[inline(always)]
    fn not(self, x: Self::B) -> Self::B {
        !x
    }
    #[inline(always)]
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F {
        self.select_i(choose, yes, no)
    }
    #[inline(always)]
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        // SAFETY: see `Truncating`.
        unsafe { _mm512_mask_mov_epi32(no, choose, yes) }
    }
    #[inline(always)]
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        // SAFETY: see `Truncating`.
        unsafe { _mm512_add_epi32(x, y) }
    }
    #[inline(always)]
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        // SAFETY: see `Truncating`.
        unsafe { _mm512_or_si512(x, y) }
    }
    #[inline(always)]
    fn shl_16(self, x: Self::I) -> Self::I {
        // SAFETY: see `Truncating`.
        unsafe { _mm512_slli_epi32::<16>(x) }
    }
    #[inline(always)]
    fn shr_16(self, x: Self::I) -> Self::I {
        // SAFETY: see `Truncating`.
        unsafe { _mm512_srli_epi32::<16>(x) }
    }
    #[inline(always)]
    fn floor(self, x: Self::F) -> Self::I {
        self.lanes_i(Spu::default().floor(array(x)))
    }
    #[inline(always)]
    fn truncate(self, x: Self::F) -> Self::I {
        self.lanes_i(Spu::default().truncate(array(x)))
    }
    #[inline(always)]
    fn smallest(self, x: Self::F) -> Self::F {
        vector(Spu::default().smallest(array(x)))
    }
    #[inline(always)]
    fn largest(self, x: Self::F) -> Self::F {
        vector(Spu::default().largest(array(x)))
    }
    #[inline(always)]
    fn any(self, x: Self::B, _: Site) -> bool {
        x != 0
    }
}
