//! The SPU as a [`Machine`]: values by another machine, cycles by the sequences of [`super::sequence`].
//!
//! Sixteen lanes are four quadwords, and each carries when it can be used. Lanes that are all alike, or four numbers again and
//! again, are one quadword, and what is made of such alone is one too: a compiler sees that from the source. What comes out of a
//! chore, or out of lanes as a plain number, can be used when the chore, or the lane, can.
//!
//! Values and cycles know nothing of each other: [`Spu`] takes any machine for its values. Operations are calls, unlike the host
//! machines': a kernel of inlined books would be enormous.

use super::recorder::{QUADS, Ready, with};
use super::sequence::{self as seq, Sequence};
use optimized::machine::{Chore, LANES, Machine, Site, Stage};

/// A machine that computes as `V` does and books as the SPU would.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spu<V>(pub V);

/// Lanes and when they can be used.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<T> {
    /// What they hold.
    pub value: T,
    ready: Ready,
    one: bool,
}

impl<T> Lanes<T> {
    /// When each quadword can be used, in cycles of the in-order clock.
    #[must_use]
    pub fn ready(&self) -> [u64; QUADS] {
        self.ready
    }

    fn quads(&self) -> usize {
        if self.one { 1 } else { QUADS }
    }

    fn of_memory(value: T) -> Self {
        let none = [0; QUADS];
        with(|r| {
            let ready = if r.is_muted() { [r.scalar(); QUADS] } else { r.run(seq::LOAD, [&none; 3], QUADS) };
            Self { value, ready, one: false }
        })
    }

    fn of_scalar(value: T) -> Self {
        Self { value, ready: [with(|r| r.scalar()); QUADS], one: true }
    }

    fn to_memory(&self) {
        with(|r| {
            if !r.is_muted() {
                r.run(seq::STORE, [&self.ready; 3], self.quads());
            }
        });
    }
}

/// Books a sequence of one, two or three operands.
#[inline]
fn book<T>(value: T, sequence: Sequence, inputs: [(&Ready, bool); 3]) -> Lanes<T> {
    let one = inputs.iter().all(|(_, one)| *one);
    with(|r| {
        let ready = if r.is_muted() {
            [r.scalar(); QUADS]
        } else {
            r.run(sequence, inputs.map(|(ready, _)| ready), if one { 1 } else { QUADS })
        };
        Lanes { value, ready, one }
    })
}

macro_rules! one {
    ($self:ident, $name:ident, $sequence:expr, $x:ident) => {{
        let x = (&$x.ready, $x.one);
        book($self.0.$name($x.value), $sequence, [x, x, x])
    }};
}

macro_rules! two {
    ($self:ident, $name:ident, $sequence:expr, $x:ident, $y:ident) => {{
        let (x, y) = ((&$x.ready, $x.one), (&$y.ready, $y.one));
        book($self.0.$name($x.value, $y.value), $sequence, [x, y, y])
    }};
}

macro_rules! three {
    ($self:ident, $name:ident, $sequence:expr, $x:ident, $y:ident, $z:ident) => {{
        let (x, y, z) = ((&$x.ready, $x.one), (&$y.ready, $y.one), (&$z.ready, $z.one));
        book($self.0.$name($x.value, $y.value, $z.value), $sequence, [x, y, z])
    }};
}

/// Quadwords brought together two and two, and two again; the quadword left, and when it can be used.
fn together<T>(x: &Lanes<T>, sequence: Sequence) -> u64 {
    let [a, b, c, d] = x.ready;
    if x.one {
        return a;
    }
    with(|r| {
        let [left, right, ..] = r.run(sequence, [&[a, c, 0, 0], &[b, d, 0, 0], &[0; QUADS]], 2);
        r.run(sequence, [&[left; QUADS], &[right; QUADS], &[0; QUADS]], 1)[0]
    })
}

/// The least or greatest, in every lane.
fn extreme<T>(value: T, x: &Lanes<T>) -> Lanes<T> {
    if with(|r| r.is_muted()) {
        return Lanes { value, ready: [with(|r| r.scalar()); QUADS], one: true };
    }
    let ready = together(x, seq::LESSER);
    let ready = with(|r| r.run(seq::LEAST, [&[ready; QUADS]; 3], 1));
    Lanes { value, ready, one: true }
}

impl<V: Machine> Machine for Spu<V> {
    type F = Lanes<V::F>;
    type I = Lanes<V::I>;
    type B = Lanes<V::B>;
    type Spu = V::Spu;

    fn spu(self) -> Self::Spu {
        self.0.spu()
    }

    fn unit(self) -> f32 {
        self.0.unit()
    }

    fn within<R>(self, work: impl FnOnce() -> R) -> R {
        self.0.within(work)
    }

    fn stage(self, stage: Stage) {
        with(|r| r.stage(stage));
    }

    #[inline(never)]
    fn branch(self, taken: bool, site: Site) -> bool {
        with(|r| {
            if !r.is_muted() {
                let ready = r.scalar();
                r.branch(seq::COUNT_AND_BRANCH, ready, taken, site);
            }
        });
        taken
    }

    fn beside<R>(self, chore: Chore, work: impl FnOnce() -> R) -> R {
        with(|r| r.begin(chore));
        let result = work();
        with(super::recorder::Recorder::end);
        result
    }

    #[inline(never)]
    fn lanes(self, x: [f32; LANES]) -> Self::F {
        Lanes::of_memory(self.0.lanes(x))
    }
    #[inline(never)]
    fn lanes_of_four(self, x: [f32; 4]) -> Self::F {
        let scalar = [with(|r| r.scalar()); QUADS];
        let x = Lanes { value: self.0.lanes_of_four(x), ready: scalar, one: true };
        book(x.value, seq::FOUR, [(&x.ready, true); 3])
    }
    #[inline(never)]
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        Lanes::of_memory(self.0.lanes_i(x))
    }
    #[inline(never)]
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        x.to_memory();
        self.0.to_array(x.value)
    }
    #[inline(never)]
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        x.to_memory();
        self.0.to_array_i(x.value)
    }
    #[inline(never)]
    fn first(self, x: Self::F) -> f32 {
        with(|r| r.comes_out(x.ready[0]));
        self.0.first(x.value)
    }
    #[inline(never)]
    fn first_i(self, x: Self::I) -> i32 {
        with(|r| r.comes_out(x.ready[0]));
        self.0.first_i(x.value)
    }
    #[inline(never)]
    fn to_bits(self, x: Self::B) -> u32 {
        with(|r| {
            if r.is_muted() {
                return;
            }
            let [a, b, c, d] = r.run(seq::GATHER, [&x.ready; 3], x.quads());
            let mut ready = a;
            if !x.one {
                for next in [b, c, d] {
                    ready = r.run(seq::JOIN, [&[next; QUADS], &[ready; QUADS], &[0; QUADS]], 1)[0];
                }
            }
            r.comes_out(ready);
        });
        self.0.to_bits(x.value)
    }
    #[inline(never)]
    fn splat(self, x: f32) -> Self::F {
        Lanes::of_scalar(self.0.splat(x))
    }
    #[inline(never)]
    fn splat_i(self, x: i32) -> Self::I {
        Lanes::of_scalar(self.0.splat_i(x))
    }
    #[inline(never)]
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        two!(self, add, seq::ADD, x, y)
    }
    #[inline(never)]
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        two!(self, sub, seq::SUB, x, y)
    }
    #[inline(never)]
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        two!(self, mul, seq::MUL, x, y)
    }
    #[inline(never)]
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        two!(self, div, seq::DIV, x, y)
    }
    #[inline(never)]
    fn sqrt(self, x: Self::F) -> Self::F {
        one!(self, sqrt, seq::SQRT, x)
    }
    #[inline(never)]
    fn neg(self, x: Self::F) -> Self::F {
        one!(self, neg, seq::NEG, x)
    }
    #[inline(never)]
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        two!(self, lt, seq::LT, x, y)
    }
    #[inline(never)]
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        two!(self, le, seq::LE, x, y)
    }
    #[inline(never)]
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        two!(self, lt_i, seq::LT_I, x, y)
    }
    #[inline(never)]
    fn and(self, x: Self::B, y: Self::B) -> Self::B {
        two!(self, and, seq::AND, x, y)
    }
    #[inline(never)]
    fn or(self, x: Self::B, y: Self::B) -> Self::B {
        two!(self, or, seq::OR, x, y)
    }
    #[inline(never)]
    fn not(self, x: Self::B) -> Self::B {
        one!(self, not, seq::NOT, x)
    }
    #[inline(never)]
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F {
        three!(self, select, seq::SELECT, choose, yes, no)
    }
    #[inline(never)]
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        three!(self, select_i, seq::SELECT, choose, yes, no)
    }
    #[inline(never)]
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        two!(self, add_i, seq::ADD_I, x, y)
    }
    #[inline(never)]
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        two!(self, or_i, seq::OR, x, y)
    }
    #[inline(never)]
    fn shl_16(self, x: Self::I) -> Self::I {
        one!(self, shl_16, seq::SHL_16, x)
    }
    #[inline(never)]
    fn shr_16(self, x: Self::I) -> Self::I {
        one!(self, shr_16, seq::SHR_16, x)
    }
    #[inline(never)]
    fn floor(self, x: Self::F) -> Self::I {
        one!(self, floor, seq::FLOOR, x)
    }
    #[inline(never)]
    fn truncate(self, x: Self::F) -> Self::I {
        one!(self, truncate, seq::TRUNCATE, x)
    }
    #[inline(never)]
    fn smallest(self, x: Self::F) -> Self::F {
        extreme(self.0.smallest(x.value), &x)
    }
    #[inline(never)]
    fn largest(self, x: Self::F) -> Self::F {
        extreme(self.0.largest(x.value), &x)
    }
    #[inline(never)]
    fn any(self, x: Self::B, site: Site) -> bool {
        let taken = self.0.any(x.value, site);
        if !with(|r| r.is_muted()) {
            let ready = together(&x, seq::OR);
            with(|r| r.branch(seq::BRANCH, ready, taken, site));
        }
        taken
    }
    fn again(self, x: Self::B, site: Site) -> bool {
        self.any(x, site)
    }
}
