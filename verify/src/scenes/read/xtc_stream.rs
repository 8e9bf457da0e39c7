//! Walks through the compressed positions of an XTC frame without decoding them. The crate `molly` decodes, and
//! panics where a broken stream makes it read past its end, leave its table of sizes or overflow an integer; what
//! passes here cannot. Bytes come in; out goes nothing, or what is wrong with them.
//!
//! Why this suffices. How many bits come next depends on three things only: the width of a whole position, fixed
//! by the header; a flag of one bit; and, where the flag is set, five bits that give the length of the run of small
//! differences to follow, and whether their width, an index into a table of 73, goes down or up by one afterwards.
//! So the walk reads flags and counts bits, in the decoder's own order, and sees the end and the table's bounds
//! exactly. With bounds of at most 2^28 in size, a position is below 2^30 + 2^28, and the ten differences of
//! a run, each below 2^25, do not take it past 2^31.

/// The smallest index into the table of widths that stands for a width.
const FIRST: u32 = 9;
/// The largest.
const LAST: u32 = 72;
/// The largest absolute value of a bound.
const BOUND: u32 = 1 << 28;

/// The fixed part of a frame's positions.
pub(super) struct Prelude {
    pub(super) low: [i32; 3],
    pub(super) high: [i32; 3],
    pub(super) width: u32,
}

impl Prelude {
    /// Refuses bounds and widths that the decoder would overflow on.
    pub(super) fn check(&self) -> Result<(), String> {
        let bounds = self.low.iter().chain(&self.high);
        if let Some(bound) = bounds.clone().find(|b| b.unsigned_abs() > BOUND) {
            return Err(format!("bound {bound}; its size must not be above {BOUND}"));
        }
        if let Some(axis) = (0..3).find(|&a| self.low[a] > self.high[a]) {
            return Err(format!(
                "bounds {} to {}; they are the wrong way round",
                self.low[axis], self.high[axis]
            ));
        }
        width_in_range(self.width)
    }

    /// Bits of a whole position: of the product of the three ranges, or of each where one is above 2^24.
    fn bits(&self) -> u64 {
        let ranges: [u64; 3] = std::array::from_fn(|a| u64::from(self.high[a].abs_diff(self.low[a])) + 1);
        let length = |n: u128| u64::from(u128::BITS - n.leading_zeros());
        if ranges.iter().any(|&r| r > 0x00ff_ffff) {
            return ranges.iter().map(|&r| length(u128::from(r))).sum();
        }
        length(ranges.iter().map(|&r| u128::from(r)).product())
    }
}

/// Walks through the stream of so many atoms.
pub(super) fn check(prelude: &Prelude, stream: &[u8], atoms: usize) -> Result<(), String> {
    prelude.check()?;
    let whole = prelude.bits();
    let mut bits = Bits { stream, at: 0 };
    let (mut width, mut run, mut atom) = (prelude.width, 0, 0);
    while atom < atoms {
        bits.skip(whole)?;
        let mut change = 1;
        if bits.take(1)? == 1 {
            let code = bits.take(5)?;
            change = code % 3;
            run = code / 3;
        }
        // A whole position, then `run` differences from it, each an atom. The decoder reads the first
        // difference before it looks whether all atoms are there, since it swaps the two.
        atom += 1;
        for difference in 0..run {
            if difference > 0 && atom >= atoms {
                break;
            }
            bits.skip(u64::from(width))?;
            atom += 1;
        }
        if atom < atoms {
            width = (width + change).saturating_sub(1);
            width_in_range(width)?;
        }
    }
    Ok(())
}

fn width_in_range(width: u32) -> Result<(), String> {
    if (FIRST..=LAST).contains(&width) {
        return Ok(());
    }
    Err(format!("width {width} of small differences; it must be from {FIRST} to {LAST}"))
}

struct Bits<'a> {
    stream: &'a [u8],
    at: u64,
}

impl Bits<'_> {
    fn skip(&mut self, bits: u64) -> Result<(), String> {
        self.at += bits;
        let have = 8 * self.stream.len() as u64;
        if self.at <= have {
            Ok(())
        } else {
            Err(format!("bit {} of positions; the stream has {have}", self.at))
        }
    }

    /// Up to 8 bits, highest first.
    fn take(&mut self, bits: u32) -> Result<u32, String> {
        let first = self.at;
        self.skip(u64::from(bits))?;
        let bit = |at: u64| u32::from(self.stream[(at / 8) as usize] >> (7 - at % 8)) & 1;
        Ok((first..self.at).fold(0, |word, at| 2 * word + bit(at)))
    }
}
