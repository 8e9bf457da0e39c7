//! Seeds: fresh for every run, printed by whoever draws one, settable by the environment variable `CGT_SEED`.
//! The generator is PCG, whose numbers are the same on every platform.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::hash::{BuildHasher, RandomState};

/// The variable that sets the seed.
pub const VARIABLE: &str = "CGT_SEED";

/// The seed in `CGT_SEED`, else a fresh one.
///
/// # Panics
/// If the variable holds something other than a number below 2⁶⁴.
#[must_use]
pub fn seed() -> u64 {
    match std::env::var(VARIABLE) {
        Ok(text) => {
            text.parse().unwrap_or_else(|_| panic!("{VARIABLE} is `{text}`, not a number below 2^64"))
        }
        Err(_) => RandomState::new().hash_one(std::process::id()),
    }
}

/// The generator for a seed; `stream` tells apart several users of one seed.
#[must_use]
pub fn generator(seed: u64, stream: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed ^ stream.wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// A count from the environment, so that long runs are the everyday tests with larger numbers.
///
/// # Panics
/// If the variable holds something other than a number.
#[must_use]
pub fn count(variable: &str, everyday: u64) -> u64 {
    match std::env::var(variable) {
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{variable} is `{text}`, not a number")),
        Err(_) => everyday,
    }
}
