//! Signed integers of at most 1,792 bits on the stack: no memory is asked for, and no step loses anything.
//!
//! The widest number that the exact decisions need has 4P + 2Q + 9 bits, where positions are spread over P bits and
//! directions over Q; f32 gives P, Q <= 278, hence 1,677 bits. [`Wide::mul`] and the sums panic beyond the capacity
//! rather than lose a bit.

use std::cmp::Ordering;

const LIMBS: usize = 28;

/// Sign and magnitude, the lowest limb first.
#[derive(Clone, Copy)]
pub struct Wide {
    negative: bool,
    /// Limbs in use: the last of them is not 0.
    len: usize,
    limbs: [u64; LIMBS],
}

impl Wide {
    /// 0.
    pub const ZERO: Self = Self { negative: false, len: 0, limbs: [0; LIMBS] };

    /// A small one, times 2^shift.
    ///
    /// # Panics
    /// If it does not fit.
    #[must_use]
    pub fn new(x: i64, shift: u32) -> Self {
        let mut wide = Self { negative: x < 0, ..Self::ZERO };
        let (limb, bits) = ((shift / 64) as usize, shift % 64);
        let shifted = u128::from(x.unsigned_abs()) << bits;
        #[allow(clippy::cast_possible_truncation, reason = "the lower half")]
        let low = shifted as u64;
        wide.limbs[limb] = low;
        let high = (shifted >> 64) as u64;
        if high != 0 {
            wide.limbs[limb + 1] = high;
        }
        wide.len = if high != 0 { limb + 2 } else { limb + 1 };
        wide.trimmed()
    }

    /// Its sign.
    #[must_use]
    pub fn sign(&self) -> Ordering {
        match (self.len, self.negative) {
            (0, _) => Ordering::Equal,
            (_, true) => Ordering::Less,
            (_, false) => Ordering::Greater,
        }
    }

    /// −x.
    #[must_use]
    pub fn negated(mut self) -> Self {
        self.negative = !self.negative && self.len > 0;
        self
    }

    /// x + y.
    ///
    /// # Panics
    /// If it does not fit.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        if self.negative == other.negative {
            return Self { negative: self.negative, ..self.add_magnitude(other) };
        }
        match self.cmp_magnitude(other) {
            Ordering::Equal => Self::ZERO,
            Ordering::Greater => Self { negative: self.negative, ..self.sub_magnitude(other) },
            Ordering::Less => Self { negative: other.negative, ..other.sub_magnitude(self) },
        }
    }

    /// x − y.
    ///
    /// # Panics
    /// If it does not fit.
    #[must_use]
    pub fn sub(&self, other: &Self) -> Self {
        self.add(&other.negated())
    }

    /// x y.
    ///
    /// # Panics
    /// If it does not fit.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "the lower half, with the upper one carried on")]
    pub fn mul(&self, other: &Self) -> Self {
        let mut product = Self { negative: self.negative != other.negative, ..Self::ZERO };
        for i in 0..self.len {
            let mut carry = 0u128;
            for j in 0..other.len {
                let sum = u128::from(product.limbs[i + j])
                    + u128::from(self.limbs[i]) * u128::from(other.limbs[j])
                    + carry;
                product.limbs[i + j] = sum as u64;
                carry = sum >> 64;
            }
            if carry != 0 {
                product.limbs[i + other.len] = carry as u64;
            }
        }
        product.len = (self.len + other.len).min(LIMBS);
        product.trimmed()
    }

    fn trimmed(mut self) -> Self {
        while self.len > 0 && self.limbs[self.len - 1] == 0 {
            self.len -= 1;
        }
        self.negative &= self.len > 0;
        self
    }

    fn cmp_magnitude(&self, other: &Self) -> Ordering {
        let [mine, others] = [&self.limbs[..self.len], &other.limbs[..other.len]];
        self.len.cmp(&other.len).then_with(|| mine.iter().rev().cmp(others.iter().rev()))
    }

    #[allow(clippy::cast_possible_truncation, reason = "the lower half, with the upper one carried on")]
    fn add_magnitude(&self, other: &Self) -> Self {
        let (longer, shorter) = if self.len < other.len { (other, self) } else { (self, other) };
        let mut sum = *longer;
        let mut carry = 0;
        for i in 0..longer.len {
            let limb = u128::from(longer.limbs[i]) + u128::from(shorter.limbs[i]) + carry;
            (sum.limbs[i], carry) = (limb as u64, limb >> 64);
        }
        if carry != 0 {
            sum.limbs[longer.len] = 1;
            sum.len += 1;
        }
        sum
    }

    fn sub_magnitude(&self, smaller: &Self) -> Self {
        let mut difference = *self;
        let mut borrow = false;
        for i in 0..self.len {
            let (x, first) = self.limbs[i].overflowing_sub(smaller.limbs[i]);
            let (x, second) = x.overflowing_sub(u64::from(borrow));
            (difference.limbs[i], borrow) = (x, first || second);
        }
        difference.trimmed()
    }
}
