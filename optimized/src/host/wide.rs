//! SSE2, SSE4.2, AVX2, AVX-512, NEON and WebAssembly's SIMD128: one machine over `fearless_simd`, whose token S stands
//! for an instruction set that has been found on this processor. Sixteen lanes are as many registers as it takes.
//!
//! Every operation is one of the library's that is defined to the bit on every level: no fused operation, no
//! `approximate_…`, no relaxed conversion, no sum over lanes. Minimum and maximum over lanes need no order, since
//! no lane is NaN.
//!
//! # Why this and not `std::arch`
//!
//! Both were measured on the sphere kernel: 1,024 spheres against one block, medians of 301 runs of 20 calls in turn, on
//! one core of an AMD EPYC (family 26, model 2), rustc 1.95.0, 22 November 2026 (`cargo bench -p verify --bench hosts`).
//! Nanoseconds a sphere, library and by hand:
//!
//! | | textbook | perpendicular |
//! |---|---|---|
//! | AVX2 | 2.18, 2.31 | 4.41, 4.40 |
//! | AVX-512 | 1.37, 1.37 | 2.26, 2.25 |
//!
//! So the library costs at most 1 %; it needs no unsafe line here, and brings all levels where by hand each is a
//! machine of its own. What it asks for in return: every closure and function between a door and an operation must be
//! inlined ([`three`](crate::machine::three)), which `tests/machine_code.rs` judges. Before that was so, frames took 1.7
//! times as long at AVX-512 and 2.4 times at AVX2, by their ratios to the naive tracer.

use crate::machine::{LANES, Machine, Site};
use fearless_simd::prelude::*;
use fearless_simd::{f32x16, i32x16, mask32x16};

/// Sixteen lanes in the registers of an instruction set.
#[derive(Clone, Copy, Debug)]
pub struct Wide<S: Simd>(pub S);

/// An instruction set, and who does the SPU's arithmetic in it.
pub trait Level: Simd {
    /// The machine.
    type Spu: Machine + Send + Sync;

    /// The machine, of the token.
    fn spu(self) -> Self::Spu;
}

/// Those that cannot round towards zero.
macro_rules! emulated {
    ($($(#[$on:meta])* $level:ident),*) => {$(
        $(#[$on])*
        impl Level for fearless_simd::$level {
            type Spu = super::Spu;

            #[inline(always)]
            fn spu(self) -> super::Spu {
                super::Spu::at(self.level())
            }
        }
    )*};
}

emulated!(
    #[cfg(target_arch = "x86_64")]
    Sse2,
    #[cfg(target_arch = "x86_64")]
    Sse4_2,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "aarch64")]
    Neon,
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    WasmSimd128
);

#[cfg(target_arch = "x86_64")]
impl Level for fearless_simd::Avx512 {
    type Spu = super::Truncating;

    #[inline(always)]
    fn spu(self) -> super::Truncating {
        super::Truncating(self)
    }
}

impl<S: Level> Machine for Wide<S> {
    type F = f32x16<S>;
    type I = i32x16<S>;
    type B = mask32x16<S>;
    type Spu = S::Spu;

    #[inline(always)]
    fn spu(self) -> S::Spu {
        self.0.spu()
    }

    #[inline(always)]
    fn within<R>(self, work: impl FnOnce() -> R) -> R {
        self.0.vectorize(work)
    }
    #[inline(always)]
    fn lanes(self, x: [f32; LANES]) -> Self::F {
        x.simd_into(self.0)
    }
    #[inline(always)]
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        x.simd_into(self.0)
    }
    #[inline(always)]
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        x.into()
    }
    #[inline(always)]
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        x.into()
    }
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, reason = "sixteen bits")]
    fn to_bits(self, x: Self::B) -> u32 {
        self.0.to_bitmask_mask32x16(x) as u32
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Self::F {
        self.0.splat_f32x16(x)
    }
    #[inline(always)]
    fn splat_i(self, x: i32) -> Self::I {
        self.0.splat_i32x16(x)
    }
    #[inline(always)]
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        self.0.add_f32x16(x, y)
    }
    #[inline(always)]
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        self.0.sub_f32x16(x, y)
    }
    #[inline(always)]
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        self.0.mul_f32x16(x, y)
    }
    #[inline(always)]
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        self.0.div_f32x16(x, y)
    }
    #[inline(always)]
    fn sqrt(self, x: Self::F) -> Self::F {
        self.0.sqrt_f32x16(x)
    }
    #[inline(always)]
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        self.0.simd_lt_f32x16(x, y)
    }
    #[inline(always)]
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        self.0.simd_le_f32x16(x, y)
    }
    #[inline(always)]
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        self.0.simd_lt_i32x16(x, y)
    }
    #[inline(always)]
    fn and(self, x: Self::B, y: Self::B) -> Self::B {
        self.0.and_mask32x16(x, y)
    }
    #[inline(always)]
    fn or(self, x: Self::B, y: Self::B) -> Self::B {
        self.0.or_mask32x16(x, y)
    }
    #[inline(always)]
    fn not(self, x: Self::B) -> Self::B {
        self.0.not_mask32x16(x)
    }
    #[inline(always)]
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F {
        self.0.select_f32x16(choose, yes, no)
    }
    #[inline(always)]
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        self.0.select_i32x16(choose, yes, no)
    }
    #[inline(always)]
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        self.0.add_i32x16(x, y)
    }
    #[inline(always)]
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        self.0.or_i32x16(x, y)
    }
    #[inline(always)]
    fn shl_16(self, x: Self::I) -> Self::I {
        self.0.shl_i32x16(x, 16)
    }
    #[inline(always)]
    fn shr_16(self, x: Self::I) -> Self::I {
        let shifted = self.0.shr_i32x16(x, 16);
        self.0.and_i32x16(shifted, self.0.splat_i32x16(0xffff))
    }
    #[inline(always)]
    fn floor(self, x: Self::F) -> Self::I {
        self.0.cvt_i32_precise_f32x16(self.0.floor_f32x16(x))
    }
    #[inline(always)]
    fn truncate(self, x: Self::F) -> Self::I {
        self.0.cvt_i32_precise_f32x16(x)
    }
    #[inline(always)]
    fn smallest(self, x: Self::F) -> Self::F {
        self.splat(self.0.reduce_min_f32x16(x))
    }
    #[inline(always)]
    fn largest(self, x: Self::F) -> Self::F {
        self.splat(self.0.reduce_max_f32x16(x))
    }
    #[inline(always)]
    fn any(self, x: Self::B, _: Site) -> bool {
        self.0.any_true_mask32x16(x)
    }
}
