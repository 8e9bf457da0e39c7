//! Derivations, step by step: statements about real numbers and no kernel, written in Rust's operators.
//!
//! A step is a function of [`Reals`], which gives its inputs; [`step!`] makes a theorem of it. What a machine computes goes in and comes
//! out as [`Real`]. A constant is an f32, and a decimal, which is none, is a quotient: 3.48 is `r.ratio(348.0, 100.0)`.

use super::NONE;
use crate::prove::smt::Numbers;
use crate::prove::symbolic::Lanes;
use crate::prove::theorem::{Ask, Expected, Lemma, Provable, Statement};
use optimized::machine::Machine;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number of a machine.
#[derive(Clone, Copy)]
pub(super) struct Real<M: Machine> {
    m: M,
    x: M::F,
}

/// The inputs of a step.
pub(super) struct Reals<'a, M, A> {
    m: M,
    ask: &'a mut A,
}

/// A theorem of a step.
macro_rules! step {
    ($step:ident) => {{
        struct Step;
        impl $crate::prove::theorem::Theorem for Step {
            fn state<
                M: optimized::machine::Machine,
                K: optimized::machine::Machine<F = M::F, I = M::I, B = M::B>,
            >(
                &self,
                m: M,
                _: K,
                ask: &mut impl $crate::prove::theorem::Ask<M>,
            ) -> $crate::prove::theorem::Statement<M::B> {
                $step(&mut $crate::prove::claims::real::Reals::new(m, ask))
            }
        }
        Box::new(Step)
    }};
}
pub(super) use step;

/// The lemma of a step.
pub(super) fn lemma(
    name: &'static str,
    words: &'static str,
    witness: &'static [(&'static str, u32)],
    statement: Box<dyn Provable>,
) -> Lemma {
    Lemma {
        name,
        words,
        numbers: Numbers::Real,
        whole: false,
        lanes: Lanes::Any,
        expected: Expected::Holds,
        long: false,
        kernel: NONE,
        witness,
        harmless: &[],
        statement,
    }
}

/// What follows from what.
pub(super) fn follows<B>(
    assume: Vec<(&'static str, B)>,
    steps: Vec<(&'static str, B)>,
    conclude: Vec<(&'static str, B)>,
) -> Statement<B> {
    Statement { assume, steps, conclude }
}

impl<'a, M: Machine, A: Ask<M>> Reals<'a, M, A> {
    pub(super) fn new(m: M, ask: &'a mut A) -> Self {
        Self { m, ask }
    }
    /// The input of that name.
    pub(super) fn get(&mut self, name: &'static str) -> Real<M> {
        Real { m: self.m, x: self.ask.number(name) }
    }
    /// The inputs of those names.
    pub(super) fn each<const N: usize>(&mut self, names: [&'static str; N]) -> [Real<M>; N] {
        names.map(|name| self.get(name))
    }
    /// A number that an f32 is.
    pub(super) fn number(&self, x: f32) -> Real<M> {
        constant(self.m, x)
    }
    /// x / y.
    pub(super) fn ratio(&self, x: f32, y: f32) -> Real<M> {
        self.number(x) / self.number(y)
    }
    /// Whether all of them hold.
    pub(super) fn all(&self, truths: &[M::B]) -> M::B {
        super::all(self.m, truths)
    }
    /// If x then y.
    pub(super) fn implies(&self, x: M::B, y: M::B) -> M::B {
        super::implies(self.m, x, y)
    }
    /// Whether 0 < x <= 1/n.
    pub(super) fn in_unit(&self, x: Real<M>, n: f32) -> M::B {
        self.m.and(self.number(0.0).below(x), x.at_most(self.ratio(1.0, n)))
    }
    /// Whether none of them is negative.
    pub(super) fn not_negative<const N: usize>(&self, numbers: [Real<M>; N]) -> M::B {
        self.all(&numbers.map(|x| self.number(0.0).at_most(x)))
    }
    /// Whether each is within the limit, either way.
    pub(super) fn within<const N: usize>(&self, numbers: [Real<M>; N], limit: Real<M>) -> M::B {
        self.all(&numbers.map(|x| x.within(limit)))
    }
}

fn constant<M: Machine>(m: M, x: f32) -> Real<M> {
    assert!((x * 1024.0).fract() == 0.0, "{x} is no f32 that was meant: write a quotient");
    Real { m, x: m.splat(x) }
}

impl<M: Machine> Real<M> {
    /// To that power.
    pub(super) fn power(self, n: u32) -> Self {
        (1..n).fold(self, |product, _| product * self)
    }
    /// x².
    pub(super) fn square(self) -> Self {
        self * self
    }
    /// √x, of what is not negative.
    pub(super) fn root(self) -> Self {
        Self { x: self.m.sqrt(self.x), ..self }
    }
    /// |x|.
    pub(super) fn size(self) -> Self {
        let negative = self.m.lt(self.x, self.m.splat(0.0));
        Self { x: self.m.select(negative, (-self).x, self.x), ..self }
    }
    /// The greater of the two.
    pub(super) fn or_more(self, other: Self) -> Self {
        Self { x: self.m.select(self.m.lt(self.x, other.x), other.x, self.x), ..self }
    }
    pub(super) fn at_most(self, other: Self) -> M::B {
        self.m.le(self.x, other.x)
    }
    pub(super) fn below(self, other: Self) -> M::B {
        self.m.lt(self.x, other.x)
    }
    pub(super) fn equals(self, other: Self) -> M::B {
        super::same(self.m, self.x, other.x)
    }
    /// |x| <= limit.
    pub(super) fn within(self, limit: Self) -> M::B {
        self.m.and((-limit).at_most(self), self.at_most(limit))
    }
}

impl<M: Machine> Neg for Real<M> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { x: self.m.sub(self.m.splat(0.0), self.x), ..self }
    }
}

macro_rules! operator {
    ($operator:ident, $name:ident, $of:ident) => {
        impl<M: Machine> $operator for Real<M> {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Self { x: self.m.$of(self.x, other.x), ..self }
            }
        }
        impl<M: Machine> $operator<f32> for Real<M> {
            type Output = Self;
            fn $name(self, other: f32) -> Self {
                self.$name(constant(self.m, other))
            }
        }
        impl<M: Machine> $operator<Real<M>> for f32 {
            type Output = Real<M>;
            fn $name(self, other: Real<M>) -> Real<M> {
                constant(other.m, self).$name(other)
            }
        }
    };
}
operator!(Add, add, add);
operator!(Sub, sub, sub);
operator!(Mul, mul, mul);
operator!(Div, div, div);

pub(super) const ZERO: u32 = 0;
pub(super) const ONE: u32 = 1f32.to_bits();
pub(super) const TWO: u32 = 2f32.to_bits();
pub(super) const HALF: u32 = 0.5f32.to_bits();
/// 2⁻⁴.
pub(super) const SIXTEENTH: u32 = 0.0625f32.to_bits();
/// 2⁻¹⁰.
pub(super) const SMALL: u32 = (1.0 / 1024f32).to_bits();
/// 2⁻¹³.
pub(super) const SMALLER: u32 = (1.0 / 8192f32).to_bits();
/// 2⁻⁷.
pub(super) const TINY: u32 = (1.0 / 128f32).to_bits();
pub(super) const QUARTER: u32 = 0.25f32.to_bits();
pub(super) const SEVEN_SIXTEENTHS: u32 = 0.4375f32.to_bits();
pub(super) const THREE: u32 = 3f32.to_bits();
pub(super) const MINUS_ONE: u32 = (-1f32).to_bits();
pub(super) const MINUS_TWO: u32 = (-2f32).to_bits();
