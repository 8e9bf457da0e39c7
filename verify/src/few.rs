//! Floats of few bits for the stage between f32 and integers, so that its own code can be run on all inputs of a domain.
//!
//! Each operation is done in f64 and rounded to so many bits, to nearest, ties to even. Up to 25 bits the two roundings are one, since
//! f64 has more than twice as many and one over; exponents are f64's, and no input comes near their ends. What is narrowed has fewer
//! bits still, as f32 has fewer than f64.

use optimized::float::Float;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A float of `BITS` significant bits, narrowed to `NARROW`, whose bounds are told that its unit roundoff is 2^−`TOLD`: with
/// `TOLD` = `BITS` they are its own, with 3 more they are an eighth of that.
#[derive(Clone, Copy, Debug)]
pub struct Few<const BITS: u32, const NARROW: u32, const TOLD: u32>(f64);

/// x rounded to so many bits, to nearest, ties to even.
#[inline(always)]
#[must_use]
pub fn nearest(x: f64, bits: u32) -> f64 {
    let drop = 53 - bits;
    let half = (1u64 << (drop - 1)) - 1 + (x.to_bits() >> drop & 1);
    f64::from_bits((x.to_bits() + half) >> drop << drop)
}

impl<const BITS: u32, const NARROW: u32, const TOLD: u32> Few<BITS, NARROW, TOLD> {
    #[inline(always)]
    fn rounded(x: f64) -> Self {
        Self(nearest(x, BITS))
    }

    /// What it stands for.
    #[must_use]
    pub fn value(self) -> f64 {
        self.0
    }
}

impl<const BITS: u32, const NARROW: u32, const TOLD: u32> Float for Few<BITS, NARROW, TOLD> {
    const UNIT: f64 = 1.0 / (1u64 << TOLD) as f64;
    // Of its own unit, whatever it is told: what is on trial is the sum of the terms of first order.
    const MORE: f64 = 1.0 + 40.0 / (1u64 << BITS) as f64;
    const ROOT_KAPPA: f64 = 0.5;
    const LIMIT: f64 = 1.0 / (1u64 << (BITS / 2)) as f64;

    #[inline(always)]
    fn of(x: f32) -> Self {
        debug_assert!(nearest(f64::from(x), BITS) == f64::from(x), "{x} is no float of {BITS} bits");
        Self(f64::from(x))
    }
    #[inline(always)]
    fn at_least(x: f64) -> Self {
        let below = nearest(x, BITS);
        let next = f64::from_bits(below.to_bits() + (1 << (53 - BITS)));
        Self(if below < x { next } else { below })
    }
    #[inline(always)]
    #[allow(clippy::cast_possible_truncation, reason = "few bits are left")]
    fn narrow(self) -> f32 {
        nearest(self.0, NARROW) as f32
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::rounded(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
}

macro_rules! operation {
    ($trait:ident, $name:ident) => {
        impl<const BITS: u32, const NARROW: u32, const TOLD: u32> $trait for Few<BITS, NARROW, TOLD> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self::rounded(self.0.$name(other.0))
            }
        }
    };
}

operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);
operation!(Div, div);

impl<const BITS: u32, const NARROW: u32, const TOLD: u32> Neg for Few<BITS, NARROW, TOLD> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<const BITS: u32, const NARROW: u32, const TOLD: u32> PartialEq for Few<BITS, NARROW, TOLD> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<const BITS: u32, const NARROW: u32, const TOLD: u32> PartialOrd for Few<BITS, NARROW, TOLD> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}
