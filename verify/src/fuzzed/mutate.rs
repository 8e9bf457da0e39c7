//! Random damage to an input, for runs without libFuzzer.

use rand::{Rng, RngExt};

/// What text formats and binary ones stumble over.
const BIG: [&[u8]; 6] =
    [b"99999999999", b"-1", b"nan", &[0x7f, 0xff, 0xff, 0xff], &[0xff; 4], &[0, 0, 0x80, 0x7f]];

/// The input with one change, or half the time up to four: a bit flipped, a byte put in place of another or moved by a little, a piece left out, doubled,
/// overwritten, or taken from the other input.
pub fn mutated(rng: &mut impl Rng, bytes: &[u8], other: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    let more = if rng.random() { rng.random_range(0..=3) } else { 0 };
    for _ in 0..=more {
        if out.is_empty() {
            return other.to_vec();
        }
        let at = rng.random_range(0..out.len());
        let end = (at + rng.random_range(1..=32)).min(out.len());
        match rng.random_range(0..8) {
            0 => out[at] ^= 1 << rng.random_range(0..8),
            1 => out[at] = rng.random(),
            2 => out[at] = out[at].wrapping_add(rng.random_range(0..7)).wrapping_sub(3),
            3 => out.truncate(at),
            4 => {
                out.drain(at..end);
            }
            5 => {
                let piece = out[at..end].to_vec();
                out.splice(at..at, piece);
            }
            6 => {
                let big = BIG[rng.random_range(0..BIG.len())];
                let end = (at + big.len()).min(out.len());
                out.splice(at..end, big.iter().copied());
            }
            _ => {
                let from = rng.random_range(0..=other.len());
                let to = (from + rng.random_range(1..=64)).min(other.len());
                out.splice(at..end, other[from..to].iter().copied());
            }
        }
    }
    out
}
