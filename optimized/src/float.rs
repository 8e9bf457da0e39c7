//! The floats of the stage between f32 and integers: f64, and in tests floats of so few bits that all inputs can be tried.
//!
//! [`crate::double`] is written over this trait, so that what is exhausted on small floats is the source that ships. An
//! operation is that of real numbers, rounded once to nearest, ties to even. Everything is inlined: for f64 nothing is left of it.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Floats of one precision, and what its bounds need to know of it.
pub trait Float:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Unit roundoff v: half the distance from 1 to the next float. At most 2⁻⁸.
    const UNIT: f64;
    /// At least 1 + 40 v: over terms of higher order, and over the bounds' own rounding.
    const MORE: f64;
    /// √κ, a power of two: where the short way may be gone ([`crate::double`]).
    const ROOT_KAPPA: f64;
    /// The error at which the short way ends: at most √(2 v).
    const LIMIT: f64;

    /// An input, which is a float of this precision; its products with other inputs are exact.
    fn of(x: f32) -> Self;
    /// The least float not below x.
    fn at_least(x: f64) -> Self;
    /// Rounded to nearest to what results are given in, ties to even.
    fn narrow(self) -> f32;
    /// √x, NaN below zero.
    #[must_use]
    fn sqrt(self) -> Self;
    /// |x|.
    #[must_use]
    fn abs(self) -> Self;
}

impl Float for f64 {
    const UNIT: Self = 1.0 / (1u64 << 53) as Self;
    const MORE: Self = 1.01;
    const ROOT_KAPPA: Self = 1.0 / 64.0;
    const LIMIT: Self = 1.0 / (1u64 << 26) as Self;

    #[inline(always)]
    fn of(x: f32) -> Self {
        Self::from(x)
    }
    #[inline(always)]
    fn at_least(x: f64) -> Self {
        x
    }
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, reason = "this is the rounding of rule 3")]
    fn narrow(self) -> f32 {
        self as f32
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
}
