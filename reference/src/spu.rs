//! The single precision of the Cell's SPU (contract, rule 6), by integers alone.
//!
//! In and out are patterns of 32 bits: a sign, an exponent e of 8 bits and a fraction f of 23. Such a pattern is zero
//! if e = 0, and ±1.f 2^(e − 127) for every other e, 255 included. No operation fails and none gives anything but a
//! number: sums and products, fused or not, are the real result of their operands, cut off towards zero once; quotients
//! and roots are chains of these behind an estimate. Units do not come into it.
//!
//! The simple program: a number is an integer times a power of two (`Real`); products and sums of such numbers are
//! such numbers again, and `Real::cut_off` makes a pattern of the result. The one departure from it is a sum of numbers
//! so far apart that no integer of 128 bits holds it: there the smaller one cannot be told from any other of its sign,
//! and `Real::plus` says why.
//!
//! ```
//! use reference::spu::Spu;
//!
//! let number = |x: f32| Spu(x.to_bits());
//! // A billionth less than one is the number below one: nothing is rounded up.
//! assert_eq!(number(1.0) - number(1e-9), Spu(0x3f7f_ffff));
//! // What is infinity elsewhere is 2^128 here.
//! assert_eq!(Spu(0x7f80_0000) * number(0.5), Spu(0x7f00_0000));
//! ```

use contract::spu::{FREST, FRSQEST};
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A pattern of 32 bits, read as the SPU reads it. `==` compares patterns, and so tells the zeros apart;
/// [`less`](Self::less) and [`less_equal`](Self::less_equal) compare numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spu(pub u32);

/// The number `units` × 2^`exponent`.
#[derive(Clone, Copy)]
struct Real {
    units: i128,
    exponent: i32,
}

/// The bits of a pattern.
const SIGN: u32 = 0x8000_0000;
const FRACTION: u32 = 0x007f_ffff;
/// The bit before the fraction's, which patterns leave out.
const LEADING: u32 = 0x0080_0000;

impl Spu {
    /// The one zero that arithmetic gives.
    pub const ZERO: Self = Self(0);
    /// 1/2.
    pub const HALF: Self = Self(0x3f00_0000);
    /// 1.
    pub const ONE: Self = Self(0x3f80_0000);
    /// 2¹²⁸, which has the pattern of f32's +∞.
    pub const TWO_128: Self = Self(0x7f80_0000);
    /// (2 − 2⁻²³) 2¹²⁸, the largest number.
    pub const LARGEST: Self = Self(0x7fff_ffff);

    /// The number that has the pattern of an f32.
    #[must_use]
    pub fn of(x: f32) -> Self {
        Self(x.to_bits())
    }

    /// Whether it is zero: its exponent is 0, its fraction and sign are anything.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.biased() == 0
    }

    /// xy + z, cut off once; `self` is x.
    #[must_use]
    pub fn fma(self, y: Self, z: Self) -> Self {
        self.real().times(y.real()).plus(z.real()).cut_off()
    }

    /// z − xy, cut off once; `self` is x.
    #[must_use]
    pub fn fnms(self, y: Self, z: Self) -> Self {
        z.real().plus((-self).real().times(y.real())).cut_off()
    }

    /// Whether the number x (`self`) is below y.
    #[must_use]
    pub fn less(self, y: Self) -> bool {
        self.rank() < y.rank()
    }

    /// Whether the number x (`self`) is y or below.
    #[must_use]
    pub fn less_equal(self, y: Self) -> bool {
        self.rank() <= y.rank()
    }

    /// The estimate of 1/x for [`fi`](Self::fi), a base of 13 bits and a step of 10 in place of the fraction: good for
    /// a relative error of 2⁻¹²·² after it. Zero from x = 2¹²⁶ on, the largest number of zero.
    #[must_use]
    pub fn frest(self) -> Self {
        if self.is_zero() {
            return Self((self.0 & SIGN) | Self::LARGEST.0);
        }
        let entry = FREST[(self.fraction() >> 18) as usize];
        Self((self.0 & SIGN) | (253u32.saturating_sub(self.biased()) << 23) | entry)
    }

    /// The estimate of 1/√|x| for [`fi`](Self::fi), in the form of [`frest`](Self::frest)'s: good for a relative error
    /// of 2⁻¹²·⁵ after it. The largest number of zero.
    #[must_use]
    pub fn frsqest(self) -> Self {
        if self.is_zero() {
            return Self::LARGEST;
        }
        let odd = self.biased() % 2;
        let entry = FRSQEST[(odd * 32 + (self.fraction() >> 18)) as usize];
        Self(((190 - self.biased().div_ceil(2)) << 23) | entry)
    }

    /// The number on the line that `estimate` gives, at the place of x in its interval; `self` is the x it was made of.
    ///
    /// From [`frest`](Self::frest) and [`frsqest`](Self::frsqest) the line never falls below 1. From other patterns it
    /// can, and of a fraction below 1 the contract does not speak: here its 23 bits stay as they are.
    #[must_use]
    pub fn fi(self, estimate: Self) -> Self {
        let base = u64::from(estimate.fraction() >> 10);
        let step = u64::from(estimate.fraction() & 0x3ff);
        let along = u64::from(self.0 & 0x0007_ffff);
        // In units of 2^-32; cut off to units of 2^-23.
        let line = ((1 << 32) + (base << 19) - step * along) >> 9;
        #[allow(clippy::cast_possible_truncation, reason = "the fraction's 23 bits are wanted")]
        let line = line as u32;
        Self((estimate.0 & !FRACTION) | (line & FRACTION))
    }

    /// About √x, by an estimate and one step of Newton's: the root cut off or one unit in the last place below, from
    /// x = 2⁻⁷⁹ on. Further down the remainder x − g² underflows, and in the end only the estimate's 12 bits are
    /// right. Of x < 0 it is a number without a meaning.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let w = self.fi(self.frsqest());
        let g = self * w;
        g.fnms(g, self).fma(w * Self::HALF, g)
    }

    fn biased(self) -> u32 {
        (self.0 & !SIGN) >> 23
    }

    fn fraction(self) -> u32 {
        self.0 & FRACTION
    }

    /// Grows with the number, since exponent and fraction stand in the pattern in the order of their weight.
    fn rank(self) -> i64 {
        let magnitude = if self.is_zero() { 0 } else { i64::from(self.0 & !SIGN) };
        if self.0 & SIGN == 0 { magnitude } else { -magnitude }
    }

    fn real(self) -> Real {
        if self.is_zero() {
            return Real { units: 0, exponent: 0 };
        }
        let magnitude = i128::from(LEADING | self.fraction());
        let units = if self.0 & SIGN == 0 { magnitude } else { -magnitude };
        Real { units, exponent: self.biased().cast_signed() - 150 }
    }
}

/// x + y, cut off.
impl Add for Spu {
    type Output = Self;

    fn add(self, y: Self) -> Self {
        self.real().plus(y.real()).cut_off()
    }
}

/// x − y, cut off.
impl Sub for Spu {
    type Output = Self;

    fn sub(self, y: Self) -> Self {
        self.real().plus((-y).real()).cut_off()
    }
}

/// xy, cut off.
impl Mul for Spu {
    type Output = Self;

    fn mul(self, y: Self) -> Self {
        self.real().times(y.real()).cut_off()
    }
}

/// About x / y, by an estimate and one step of Newton's: the quotient cut off or one unit in the last place below, from
/// |x| = 2⁻⁷⁹ on and as long as nothing else underflows. Further down only the estimate's 12 bits are right in the end;
/// from |y| = 2¹²⁶ on it is zero; of y = 0 about 2¹³⁰ x, or the largest number.
impl Div for Spu {
    type Output = Self;

    #[allow(clippy::suspicious_arithmetic_impl, reason = "the SPU has no division, only products")]
    fn div(self, y: Self) -> Self {
        let w = y.fi(y.frest());
        let q = self * w;
        q.fnms(y, self).fma(w, q)
    }
}

/// The same with the other sign bit, zeros too.
impl Neg for Spu {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0 ^ SIGN)
    }
}

impl Real {
    /// Exact. Of patterns' numbers: below 2⁴⁸ units, and zero or 2⁴⁶ at least.
    fn times(self, other: Self) -> Self {
        Self { units: self.units * other.units, exponent: self.exponent + other.exponent }
    }

    /// Exact up to a distance of 64 between the exponents; beyond that, some number that is cut off to the same pattern.
    ///
    /// Numbers are zero or of 24 to 48 bits. So at a distance of more than 64 the lower number, of less than 2⁴⁸ of its
    /// own units, is less than 2⁻¹⁶ of the higher one's. The last bit kept of the sum is worth one unit of the higher
    /// number at least, or half of one where something has been taken from a power of two. So whatever the lower number
    /// is, the sum lies between the same two neighbours that are kept, just above the higher number or just
    /// below; and so it does with 2⁻⁶⁴ units in place of the lower number.
    fn plus(self, other: Self) -> Self {
        if self.units == 0 {
            return other;
        }
        if other.units == 0 {
            return self;
        }
        let (high, low) = if self.exponent < other.exponent { (other, self) } else { (self, other) };
        match high.exponent - low.exponent {
            distance @ 0..=64 => Self { units: (high.units << distance) + low.units, exponent: low.exponent },
            _ => Self { units: (high.units << 64) + low.units.signum(), exponent: high.exponent - 64 },
        }
    }

    /// The pattern of the number, cut off towards zero to 24 bits; +0 below 2⁻¹²⁶, the largest number from 2¹²⁹ on.
    fn cut_off(self) -> Spu {
        let magnitude = self.units.unsigned_abs();
        let Some(top) = magnitude.checked_ilog2() else {
            return Spu::ZERO;
        };
        let kept = match top.cmp(&23) {
            Ordering::Less => magnitude << (23 - top),
            _ => magnitude >> (top - 23),
        };
        let kept = u32::try_from(kept).expect("24 bits are kept");
        let sign = if self.units < 0 { SIGN } else { 0 };
        // The number is 1.f × 2^(exponent + top).
        let biased = i64::from(self.exponent) + i64::from(top) + 127;
        match u32::try_from(biased) {
            Err(_) | Ok(0) => Spu::ZERO,
            Ok(biased @ 1..=255) => Spu(sign | (biased << 23) | (kept & FRACTION)),
            Ok(256..) => Spu(sign | Spu::LARGEST.0),
        }
    }
}
