//! The plainest machine: sixteen lanes are an array, each operation a loop over it.

use super::Spu;
use crate::machine::{LANES, Machine, Site};
use std::array::from_fn;

/// Arrays.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scalar;

impl Machine for Scalar {
    type F = [f32; LANES];
    type I = [i32; LANES];
    type B = [bool; LANES];
    type Spu = Spu;

    #[inline(always)]
    fn spu(self) -> Spu {
        Spu::default()
    }

    #[inline(always)]
    fn lanes(self, x: [f32; LANES]) -> Self::F {
        x
    }
    #[inline(always)]
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        x
    }
    #[inline(always)]
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        x
    }
    #[inline(always)]
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        x
    }
    #[inline(always)]
    fn to_bits(self, x: Self::B) -> u32 {
        (0..LANES).map(|i| u32::from(x[i]) << i).sum()
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Self::F {
        [x; LANES]
    }
    #[inline(always)]
    fn splat_i(self, x: i32) -> Self::I {
        [x; LANES]
    }
    #[inline(always)]
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        from_fn(|i| x[i] + y[i])
    }
    #[inline(always)]
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        from_fn(|i| x[i] - y[i])
    }
    #[inline(always)]
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        from_fn(|i| x[i] * y[i])
    }
    #[inline(always)]
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        from_fn(|i| x[i] / y[i])
    }
    #[inline(always)]
    fn sqrt(self, x: Self::F) -> Self::F {
        from_fn(|i| x[i].sqrt())
    }
    #[inline(always)]
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        from_fn(|i| x[i] < y[i])
    }
    #[inline(always)]
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        from_fn(|i| x[i] <= y[i])
    }
    #[inline(always)]
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        from_fn(|i| x[i] < y[i])
    }
    #[inline(always)]
    fn and(self, x: Self::B, y: Self::B) -> Self::B {
        from_fn(|i| x[i] & y[i])
    }
    #[inline(always)]
    fn or(self, x: Self::B, y: Self::B) -> Self::B {
        from_fn(|i| x[i] | y[i])
    }
    #[inline(always)]
    fn not(self, x: Self::B) -> Self::B {
        x.map(|x| !x)
    }
    #[inline(always)]
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F {
        from_fn(|i| if choose[i] { yes[i] } else { no[i] })
    }
    #[inline(always)]
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        from_fn(|i| if choose[i] { yes[i] } else { no[i] })
    }
    #[inline(always)]
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        from_fn(|i| x[i].wrapping_add(y[i]))
    }
    #[inline(always)]
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        from_fn(|i| x[i] | y[i])
    }
    #[inline(always)]
    fn shl_16(self, x: Self::I) -> Self::I {
        x.map(|x| x << 16)
    }
    #[inline(always)]
    fn shr_16(self, x: Self::I) -> Self::I {
        x.map(|x| x.cast_unsigned().wrapping_shr(16).cast_signed())
    }
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, reason = "`as` saturates, as the trait says")]
    fn floor(self, x: Self::F) -> Self::I {
        x.map(|x| x.floor() as i32)
    }
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, reason = "`as` saturates, as the trait says")]
    fn truncate(self, x: Self::F) -> Self::I {
        x.map(|x| x as i32)
    }
    #[inline(always)]
    fn smallest(self, x: Self::F) -> Self::F {
        [x.into_iter().fold(f32::INFINITY, |a, b| if a < b { a } else { b }); LANES]
    }
    #[inline(always)]
    fn largest(self, x: Self::F) -> Self::F {
        [x.into_iter().fold(f32::NEG_INFINITY, |a, b| if a > b { a } else { b }); LANES]
    }
    #[inline(always)]
    fn any(self, x: Self::B, _: Site) -> bool {
        x.contains(&true)
    }
}
