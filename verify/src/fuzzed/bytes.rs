//! From bytes to numbers. Every read takes a fixed number of bytes, so that a change of one byte changes one number, and an input
//! that is cut or spliced keeps its meaning up to there; beyond the end there are zeros.
//!
//! A number takes five bytes: the first says how the other four are read, since numbers of any bits are hardly ever close to
//! one another, and it is where they are that tracers err.

use contract::Sphere;
use optimized::Level;
use rand_pcg::Pcg64Mcg;

/// What is left of an input.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bytes<'a>(pub(super) &'a [u8]);

impl Bytes<'_> {
    pub(super) fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// A number below n, which is not zero.
    pub(super) fn below(&mut self, n: u8) -> u8 {
        self.byte() % n
    }

    /// One of some.
    pub(super) fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[usize::from(self.byte()) % choices.len()]
    }

    pub(super) fn flag(&mut self) -> bool {
        self.byte() % 2 == 1
    }

    pub(super) fn word(&mut self) -> u32 {
        u32::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    /// A whole number from −128 to 127.
    pub(super) fn whole(&mut self) -> i8 {
        self.byte().cast_signed()
    }

    /// A generator that the next eight bytes seed.
    pub(super) fn generator(&mut self) -> Pcg64Mcg {
        let seed = u64::from(self.word()) << 32 | u64::from(self.word());
        crate::seed::generator(seed, 0)
    }

    /// Any bits, NaN among them; or a number of moderate size; of sixteenths; a whole one times any power of two; a whole one and a
    /// few ulp; or, three times in eight, a whole one.
    pub(super) fn number(&mut self) -> f32 {
        let (kind, word) = (self.byte(), self.word());
        let [a, b, c, _] = word.to_le_bytes();
        let (whole, short) = (f32::from(a.cast_signed()), f32::from(i16::from_le_bytes([a, b])));
        match kind % 8 {
            0 => f32::from_bits(word),
            1 => f32::from_bits((word & 0x807f_ffff) | ((117 + (word >> 23 & 15)) << 23)),
            2 => short / 16.0,
            3 => times_power(short, i32::from(c.cast_signed())),
            4 => ulps(whole, i32::from(b.cast_signed() % 4)),
            _ => whole,
        }
    }

    pub(super) fn vector(&mut self) -> [f32; 3] {
        std::array::from_fn(|_| self.number())
    }

    /// A number, mostly without its sign.
    pub(super) fn radius(&mut self) -> f32 {
        let (x, signed) = (self.number(), self.byte() > 250);
        if signed { x } else { x.abs() }
    }

    pub(super) fn sphere(&mut self) -> Sphere {
        Sphere { center: self.vector(), radius: self.radius(), color: std::array::from_fn(|_| self.byte()) }
    }

    /// Any level that the processor has.
    pub(super) fn level(&mut self) -> Level {
        self.one_of(&Level::available())
    }

    /// Moves some of the numbers by up to three ulp, as many times as the next byte says.
    pub(super) fn nudge(&mut self, numbers: &mut [&mut f32]) {
        for _ in 0..self.below(4) {
            let (which, steps) = (usize::from(self.byte()), self.whole() % 4);
            if let Some(x) = numbers.get_mut(which % numbers.len().max(1)) {
                **x = ulps(**x, i32::from(steps));
            }
        }
    }
}

/// So many steps up, or down.
fn ulps(x: f32, steps: i32) -> f32 {
    (0..steps.abs()).fold(x, |x, _| if steps > 0 { x.next_up() } else { x.next_down() })
}

/// x 2^e, rounded once; x has at most 16 bits.
#[allow(clippy::cast_possible_truncation, reason = "it is to be rounded")]
fn times_power(x: f32, e: i32) -> f32 {
    (f64::from(x) * 2f64.powi(e)) as f32
}
