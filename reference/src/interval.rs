//! Closed intervals of f64 that hold the true value whatever was rounded: each operation rounds to nearest
//! and then steps one f64 outward on both sides.
//!
//! From f32 input no step of the ray-sphere equation leaves the range of f64 (the products reach from 2⁻⁵⁹⁶
//! to 2⁵¹⁸), so an end is never infinite or NaN.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// All numbers from `lo` to `hi`, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

impl Interval {
    /// One f32, exactly.
    pub(crate) fn of(x: f32) -> Self {
        Self { lo: f64::from(x), hi: f64::from(x) }
    }

    /// The roots of what is not negative in it.
    pub(crate) fn sqrt(self) -> Self {
        let root = |x: f64| x.max(0.0).sqrt();
        Self { lo: root(self.lo).next_down().max(0.0), hi: root(self.hi).next_up() }
    }

    pub(crate) fn is_positive(self) -> bool {
        self.lo > 0.0
    }

    pub(crate) fn is_negative(self) -> bool {
        self.hi < 0.0
    }

    fn outward(lo: f64, hi: f64) -> Self {
        Self { lo: lo.next_down(), hi: hi.next_up() }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::outward(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (x, y) = (self, other);
        let ends = [x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi];
        Self::outward(
            ends.into_iter().fold(f64::INFINITY, f64::min),
            ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
        )
    }
}

impl Div for Interval {
    type Output = Self;

    /// For a divisor and a true quotient above zero: where the dividend's lower end is below zero, so is the quotient's.
    fn div(self, other: Self) -> Self {
        debug_assert!(other.is_positive(), "division by {other:?}");
        Self::outward(self.lo / other.hi, self.hi / other.lo)
    }
}
