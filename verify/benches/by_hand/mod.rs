//! Machines written with `std::arch` alone, to be compared with the library's: sixteen lanes are one register of AVX-512,
//! or two of AVX2.

#![allow(
    unsafe_code,
    reason = "intrinsics are unsafe where their instruction set is not enabled for the function"
)]

use optimized::machine::{LANES, Machine, Site};
use std::arch::x86_64::*;

/// A call of intrinsics.
macro_rules! at {
    ($call:expr) => {{
        // SAFETY: a machine of this file is made by its `detect` only, which has found the instruction set.
        unsafe { $call }
    }};
}

/// AVX-512 on this processor.
#[derive(Clone, Copy)]
pub(crate) struct Avx512(());

/// AVX2 on this processor.
#[derive(Clone, Copy)]
pub(crate) struct Avx2(());

impl Avx512 {
    pub(crate) fn detect() -> Option<Self> {
        let there = is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq");
        there.then_some(Self(()))
    }
}

impl Avx2 {
    pub(crate) fn detect() -> Option<Self> {
        is_x86_feature_detected!("avx2").then_some(Self(()))
    }
}

impl Machine for Avx512 {
    type F = __m512;
    type I = __m512i;
    type B = __mmask16;
    type Spu = optimized::host::Spu;

    #[inline(always)]
    fn spu(self) -> Self::Spu {
        optimized::host::Spu::default()
    }

    #[inline(always)]
    fn within<R>(self, work: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "avx512f,avx512dq")]
        fn door<R>(work: impl FnOnce() -> R) -> R {
            work()
        }
        at!(door(work))
    }
    #[inline(always)]
    fn lanes(self, x: [f32; LANES]) -> Self::F {
        at!(_mm512_loadu_ps(x.as_ptr()))
    }
    #[inline(always)]
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        at!(_mm512_loadu_si512(x.as_ptr().cast()))
    }
    #[inline(always)]
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        let mut array = [0.0; LANES];
        at!(_mm512_storeu_ps(array.as_mut_ptr(), x));
        array
    }
    #[inline(always)]
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        let mut array = [0; LANES];
        at!(_mm512_storeu_si512(array.as_mut_ptr().cast(), x));
        array
    }
    #[inline(always)]
    fn to_bits(self, x: Self::B) -> u32 {
        x.into()
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Self::F {
        at!(_mm512_set1_ps(x))
    }
    #[inline(always)]
    fn splat_i(self, x: i32) -> Self::I {
        at!(_mm512_set1_epi32(x))
    }
    #[inline(always)]
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        at!(_mm512_add_ps(x, y))
    }
    #[inline(always)]
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        at!(_mm512_sub_ps(x, y))
    }
    #[inline(always)]
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        at!(_mm512_mul_ps(x, y))
    }
    #[inline(always)]
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        at!(_mm512_div_ps(x, y))
    }
    #[inline(always)]
    fn sqrt(self, x: Self::F) -> Self::F {
        at!(_mm512_sqrt_ps(x))
    }
    #[inline(always)]
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        at!(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(x, y))
    }
    #[inline(always)]
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        at!(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(x, y))
    }
    #[inline(always)]
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        at!(_mm512_cmplt_epi32_mask(x, y))
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
        at!(_mm512_mask_blend_ps(choose, no, yes))
    }
    #[inline(always)]
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        at!(_mm512_mask_blend_epi32(choose, no, yes))
    }
    #[inline(always)]
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        at!(_mm512_add_epi32(x, y))
    }
    #[inline(always)]
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        at!(_mm512_or_si512(x, y))
    }
    #[inline(always)]
    fn shl_16(self, x: Self::I) -> Self::I {
        at!(_mm512_slli_epi32::<16>(x))
    }
    #[inline(always)]
    fn shr_16(self, x: Self::I) -> Self::I {
        at!(_mm512_srli_epi32::<16>(x))
    }
    #[inline(always)]
    fn floor(self, x: Self::F) -> Self::I {
        self.truncate(at!(_mm512_roundscale_ps::<0b1001>(x)))
    }
    #[inline(always)]
    fn truncate(self, x: Self::F) -> Self::I {
        at!({
            let large = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(x, _mm512_set1_ps(2_147_483_648.0));
            let number = _mm512_cmp_ps_mask::<_CMP_ORD_Q>(x, x);
            _mm512_mask_mov_epi32(_mm512_maskz_cvttps_epi32(number, x), large, _mm512_set1_epi32(i32::MAX))
        })
    }
    #[inline(always)]
    fn smallest(self, x: Self::F) -> Self::F {
        self.splat(at!(_mm512_reduce_min_ps(x)))
    }
    #[inline(always)]
    fn largest(self, x: Self::F) -> Self::F {
        self.splat(at!(_mm512_reduce_max_ps(x)))
    }
    #[inline(always)]
    fn any(self, x: Self::B, _: Site) -> bool {
        x != 0
    }
}

/// Saturated; 0 for NaN.
#[target_feature(enable = "avx2")]
#[inline]
fn truncate(x: __m256) -> __m256i {
    let large = _mm256_cmp_ps::<_CMP_GE_OQ>(x, _mm256_set1_ps(2_147_483_648.0));
    let number = _mm256_cmp_ps::<_CMP_ORD_Q>(x, x);
    // What does not fit becomes i32::MIN, the complement of i32::MAX.
    let saturated = _mm256_xor_si256(_mm256_cvttps_epi32(x), _mm256_castps_si256(large));
    _mm256_and_si256(saturated, _mm256_castps_si256(number))
}

impl Machine for Avx2 {
    type F = [__m256; 2];
    type I = [__m256i; 2];
    type B = [__m256; 2];
    type Spu = optimized::host::Spu;

    #[inline(always)]
    fn spu(self) -> Self::Spu {
        optimized::host::Spu::default()
    }

    #[inline(always)]
    fn within<R>(self, work: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "avx2")]
        fn door<R>(work: impl FnOnce() -> R) -> R {
            work()
        }
        at!(door(work))
    }
    #[inline(always)]
    fn lanes(self, x: [f32; LANES]) -> Self::F {
        at!([_mm256_loadu_ps(x.as_ptr()), _mm256_loadu_ps(x.as_ptr().add(8))])
    }
    #[inline(always)]
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        at!([_mm256_loadu_si256(x.as_ptr().cast()), _mm256_loadu_si256(x.as_ptr().add(8).cast())])
    }
    #[inline(always)]
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        let mut array = [0.0; LANES];
        at!(_mm256_storeu_ps(array.as_mut_ptr(), x[0]));
        at!(_mm256_storeu_ps(array.as_mut_ptr().add(8), x[1]));
        array
    }
    #[inline(always)]
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        let mut array = [0; LANES];
        at!(_mm256_storeu_si256(array.as_mut_ptr().cast(), x[0]));
        at!(_mm256_storeu_si256(array.as_mut_ptr().add(8).cast(), x[1]));
        array
    }
    #[inline(always)]
    fn to_bits(self, x: Self::B) -> u32 {
        at!((_mm256_movemask_ps(x[0]) | _mm256_movemask_ps(x[1]) << 8).cast_unsigned())
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Self::F {
        at!([_mm256_set1_ps(x); 2])
    }
    #[inline(always)]
    fn splat_i(self, x: i32) -> Self::I {
        at!([_mm256_set1_epi32(x); 2])
    }
    #[inline(always)]
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        at!([_mm256_add_ps(x[0], y[0]), _mm256_add_ps(x[1], y[1])])
    }
    #[inline(always)]
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        at!([_mm256_sub_ps(x[0], y[0]), _mm256_sub_ps(x[1], y[1])])
    }
    #[inline(always)]
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        at!([_mm256_mul_ps(x[0], y[0]), _mm256_mul_ps(x[1], y[1])])
    }
    #[inline(always)]
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        at!([_mm256_div_ps(x[0], y[0]), _mm256_div_ps(x[1], y[1])])
    }
    #[inline(always)]
    fn sqrt(self, x: Self::F) -> Self::F {
        at!([_mm256_sqrt_ps(x[0]), _mm256_sqrt_ps(x[1])])
    }
    #[inline(always)]
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        at!([_mm256_cmp_ps::<_CMP_LT_OQ>(x[0], y[0]), _mm256_cmp_ps::<_CMP_LT_OQ>(x[1], y[1])])
    }
    #[inline(always)]
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        at!([_mm256_cmp_ps::<_CMP_LE_OQ>(x[0], y[0]), _mm256_cmp_ps::<_CMP_LE_OQ>(x[1], y[1])])
    }
    #[inline(always)]
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        at!([
            _mm256_castsi256_ps(_mm256_cmpgt_epi32(y[0], x[0])),
            _mm256_castsi256_ps(_mm256_cmpgt_epi32(y[1], x[1]))
        ])
    }
    #[inline(always)]
    fn and(self, x: Self::B, y: Self::B) -> Self::B {
        at!([_mm256_and_ps(x[0], y[0]), _mm256_and_ps(x[1], y[1])])
    }
    #[inline(always)]
    fn or(self, x: Self::B, y: Self::B) -> Self::B {
        at!([_mm256_or_ps(x[0], y[0]), _mm256_or_ps(x[1], y[1])])
    }
    #[inline(always)]
    fn not(self, x: Self::B) -> Self::B {
        let all = at!(_mm256_castsi256_ps(_mm256_set1_epi32(-1)));
        at!([_mm256_xor_ps(x[0], all), _mm256_xor_ps(x[1], all)])
    }
    #[inline(always)]
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F {
        at!([_mm256_blendv_ps(no[0], yes[0], choose[0]), _mm256_blendv_ps(no[1], yes[1], choose[1])])
    }
    #[inline(always)]
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        at!([
            _mm256_blendv_epi8(no[0], yes[0], _mm256_castps_si256(choose[0])),
            _mm256_blendv_epi8(no[1], yes[1], _mm256_castps_si256(choose[1]))
        ])
    }
    #[inline(always)]
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        at!([_mm256_add_epi32(x[0], y[0]), _mm256_add_epi32(x[1], y[1])])
    }
    #[inline(always)]
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        at!([_mm256_or_si256(x[0], y[0]), _mm256_or_si256(x[1], y[1])])
    }
    #[inline(always)]
    fn shl_16(self, x: Self::I) -> Self::I {
        at!([_mm256_slli_epi32::<16>(x[0]), _mm256_slli_epi32::<16>(x[1])])
    }
    #[inline(always)]
    fn shr_16(self, x: Self::I) -> Self::I {
        at!([_mm256_srli_epi32::<16>(x[0]), _mm256_srli_epi32::<16>(x[1])])
    }
    #[inline(always)]
    fn floor(self, x: Self::F) -> Self::I {
        self.truncate(at!([_mm256_floor_ps(x[0]), _mm256_floor_ps(x[1])]))
    }
    #[inline(always)]
    fn truncate(self, x: Self::F) -> Self::I {
        at!([truncate(x[0]), truncate(x[1])])
    }
    #[inline(always)]
    fn smallest(self, x: Self::F) -> Self::F {
        let mut least = f32::INFINITY;
        for lane in self.to_array(x) {
            least = if lane < least { lane } else { least };
        }
        self.splat(least)
    }
    #[inline(always)]
    fn largest(self, x: Self::F) -> Self::F {
        let mut largest = f32::NEG_INFINITY;
        for lane in self.to_array(x) {
            largest = if lane > largest { lane } else { largest };
        }
        self.splat(largest)
    }
    #[inline(always)]
    fn any(self, x: Self::B, _: Site) -> bool {
        at!(_mm256_movemask_ps(_mm256_or_ps(x[0], x[1])) != 0)
    }
}
