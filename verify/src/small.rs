//! A machine whose floats have few significant bits, so that a kernel can be run on all inputs of a domain.
//!
//! Each f32 operation is done in f64 and rounded to so many bits, to nearest (ties to even) or towards zero. For at most 16 bits
//! that is the correctly rounded result: sums and products of such numbers, no farther apart than 2²⁸, are exact in f64, and
//! quotients and roots come no closer to a rounding boundary than f64 resolves. (Of sums farther apart, a truncated one may be off by 2⁻⁵³
//! of itself, within its unit.) Exponents are f32's: the bounds under test exclude
//! over- and underflow anyway. Integer lanes and masks are those of the scalar machine.

use optimized::host::Scalar;
use optimized::machine::{LANES, Machine, Site};

/// Where a result between two floats goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// To the nearest, ties to even.
    Nearest,
    /// Towards zero.
    Truncating,
}

/// Floats of so many significant bits.
#[derive(Clone, Copy, Debug)]
pub struct Small {
    /// From 2 to 16.
    pub bits: u32,
    /// Their rounding.
    pub mode: Mode,
}

impl Small {
    /// The largest relative error of one operation.
    #[must_use]
    pub fn unit(self) -> f64 {
        let nearest = f64::from(1u32 << self.bits).recip();
        match self.mode {
            Mode::Nearest => nearest,
            Mode::Truncating => 2.0 * nearest,
        }
    }

    /// The float that stands for x.
    #[inline]
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "few bits are left")]
    pub fn round(self, x: f64) -> f32 {
        let drop = 53 - self.bits;
        let half = match self.mode {
            Mode::Nearest => ((1u64 << (drop - 1)) - 1).wrapping_add(x.to_bits() >> drop & 1),
            Mode::Truncating => 0,
        };
        // Of no number is a sum too large; without a check of it lanes are done side by side.
        f64::from_bits(x.to_bits().wrapping_add(half) >> drop << drop) as f32
    }

    fn each(self, mut x: [f32; LANES], y: [f32; LANES], op: impl Fn(f64, f64) -> f64) -> [f32; LANES] {
        for (x, y) in x.iter_mut().zip(y) {
            *x = self.round(op(f64::from(*x), f64::from(y)));
        }
        x
    }
}

impl Machine for Small {
    type F = [f32; LANES];
    type I = [i32; LANES];
    type B = [bool; LANES];
    type Spu = optimized::host::Spu;

    fn spu(self) -> Self::Spu {
        optimized::host::Spu::default()
    }
    #[allow(clippy::cast_possible_truncation, reason = "a power of two")]
    fn unit(self) -> f32 {
        Self::unit(self) as f32
    }
    fn lanes(self, x: [f32; LANES]) -> Self::F {
        x
    }
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        x
    }
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        x
    }
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        x
    }
    fn to_bits(self, x: Self::B) -> u32 {
        Scalar.to_bits(x)
    }
    fn splat(self, x: f32) -> Self::F {
        [x; LANES]
    }
    fn splat_i(self, x: i32) -> Self::I {
        [x; LANES]
    }
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        self.each(x, y, |x, y| x + y)
    }
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        self.each(x, y, |x, y| x - y)
    }
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        self.each(x, y, |x, y| x * y)
    }
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        self.each(x, y, |x, y| x / y)
    }
    fn sqrt(self, x: Self::F) -> Self::F {
        x.map(|x| self.round(f64::from(x).sqrt()))
    }
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        Scalar.lt(x, y)
    }
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        Scalar.le(x, y)
    }
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        Scalar.lt_i(x, y)
    }
    fn and(self, x: Self::B, y: Self::B) -> Self::B {
        Scalar.and(x, y)
    }
    fn or(self, x: Self::B, y: Self::B) -> Self::B {
        Scalar.or(x, y)
    }
    fn not(self, x: Self::B) -> Self::B {
        Scalar.not(x)
    }
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F {
        Scalar.select(choose, yes, no)
    }
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        Scalar.select_i(choose, yes, no)
    }
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        Scalar.add_i(x, y)
    }
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        Scalar.or_i(x, y)
    }
    fn shl_16(self, x: Self::I) -> Self::I {
        Scalar.shl_16(x)
    }
    fn shr_16(self, x: Self::I) -> Self::I {
        Scalar.shr_16(x)
    }
    fn floor(self, x: Self::F) -> Self::I {
        Scalar.floor(x)
    }
    fn truncate(self, x: Self::F) -> Self::I {
        Scalar.truncate(x)
    }
    fn smallest(self, x: Self::F) -> Self::F {
        Scalar.smallest(x)
    }
    fn largest(self, x: Self::F) -> Self::F {
        Scalar.largest(x)
    }
    fn any(self, x: Self::B, _: Site) -> bool {
        x.contains(&true)
    }
}
