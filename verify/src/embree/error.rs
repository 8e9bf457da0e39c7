//! What can go wrong with Embree, each with its numbers.

use super::{Isa, Version, Width};
use thiserror::Error;

/// Why Embree gave no answer that counts.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EmbreeError {
    /// A call of the library failed.
    #[error("Embree: {call} failed: {code}")]
    Call {
        /// The function.
        call: &'static str,
        /// What the library says.
        code: Code,
    },
    /// The layout of this version's structures is not known here.
    #[error("Embree {0} is not known here; 4.2, 4.3 and 4.4 are")]
    UnknownVersion(Version),
    /// The library was built without point geometry.
    #[error("this Embree was built without spheres")]
    NoSpheres,
    /// The processor lacks what was asked for.
    #[error("this processor has no {0}")]
    NoIsa(Isa),
    /// The library took the instruction set and uses another.
    #[error(
        "Embree took isa={isa} and traces packets of 8 and 16 natively: {native:?}, expected {expected:?}"
    )]
    IsaIgnored {
        /// What was asked for.
        isa: Isa,
        /// Whether it says that 8 and 16 rays are native.
        native: [bool; 2],
        /// What they are at this instruction set.
        expected: [bool; 2],
    },
    /// The library wrote past the structure that was handed to it.
    #[error("Embree wrote 0x{value:08x} into guard word {word} behind {width} rays")]
    Overrun {
        /// Rays at once.
        width: Width,
        /// Index of the guard word.
        word: usize,
        /// What stands there.
        value: u32,
    },
    /// A call of the library came back with subnormal numbers flushed to zero.
    #[error("subnormal numbers count as zero after a call of Embree")]
    FlushStuck,
    /// A hit that is plainly there did not come back.
    #[error("canary: {width} rays at once, ray {ray}: expected sphere {expected:?}, got {found:?}")]
    Canary {
        /// Rays at once.
        width: Width,
        /// Which ray.
        ray: usize,
        /// Id and t.
        expected: Option<(u32, f32)>,
        /// Id and t.
        found: Option<(u32, f32)>,
    },
}

/// An error code of the library; newer versions have more of them than the headers of `embree4-sys`.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[allow(missing_docs, reason = "each says all itself")]
pub enum Code {
    #[error("it gives no reason")]
    None,
    #[error("unknown error")]
    Unknown,
    #[error("invalid argument")]
    InvalidArgument,
    #[error("invalid operation")]
    InvalidOperation,
    #[error("out of memory")]
    OutOfMemory,
    #[error("unsupported processor")]
    UnsupportedCpu,
    #[error("cancelled")]
    Cancelled,
    #[error("error code {0}")]
    Other(u32),
}

impl From<u32> for Code {
    fn from(code: u32) -> Self {
        use Code::*;
        let named =
            [None, Unknown, InvalidArgument, InvalidOperation, OutOfMemory, UnsupportedCpu, Cancelled];
        named.get(code as usize).copied().unwrap_or(Other(code))
    }
}
