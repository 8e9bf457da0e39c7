//! Transfers between main memory and a local store.
//!
//! One moves at most 16 KB between addresses that are multiples of 16 bytes (of 128 for full speed); a list of at most 2,048 of
//! them is one command. The memory gives 25.6 GB/s to all SPUs together, 8 bytes in a cycle at 3.2 GHz.
//!
//! Left out, so that times err low: how long the first byte takes, and who else uses the memory.

use super::isa::Op;
use thiserror::Error;

/// The most bytes of one transfer.
pub const MOST: u64 = 16 * 1024;
/// What addresses and sizes must be multiples of.
pub const ALIGNMENT: u64 = 16;
/// What they should be multiples of.
pub const BEST_ALIGNMENT: u64 = 128;
/// The most transfers of one list.
pub const LIST: u64 = 2048;
/// Bytes in a second, for all SPUs together.
pub const BYTES_PER_SECOND: f64 = 25.6e9;
/// Instructions that give a command to the transfer engine: one for each of its six numbers, and three to wait for its end.
pub const CHANNELS: [Op; 9] = [Op::Wrch; 9];

/// Why there is no such transfer.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum TransferError {
    /// An address or a size is not a multiple of 16.
    #[error("a transfer of {bytes} bytes at {address:#x}: both must be multiples of {ALIGNMENT}")]
    Unaligned {
        /// Where.
        address: u64,
        /// How many.
        bytes: u64,
    },
    /// More than a list holds.
    #[error("{bytes} bytes are {transfers} transfers of at most {MOST} bytes; a list holds {LIST}")]
    TooLong {
        /// How many.
        bytes: u64,
        /// Transfers that they need.
        transfers: u64,
    },
}

/// Transfers by which some bytes are moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transfer {
    /// How many bytes.
    pub bytes: u64,
    /// In how many transfers.
    pub transfers: u64,
    /// Whether each goes at full speed.
    pub best: bool,
}

impl Transfer {
    /// The transfers that move some bytes from or to an address.
    ///
    /// # Errors
    /// [`TransferError`] if they are not aligned, or too many for a list.
    pub fn new(address: u64, bytes: u64) -> Result<Self, TransferError> {
        if !address.is_multiple_of(ALIGNMENT) || !bytes.is_multiple_of(ALIGNMENT) {
            return Err(TransferError::Unaligned { address, bytes });
        }
        let transfers = bytes.div_ceil(MOST);
        if transfers > LIST {
            return Err(TransferError::TooLong { bytes, transfers });
        }
        let best = address.is_multiple_of(BEST_ALIGNMENT) && bytes.is_multiple_of(BEST_ALIGNMENT);
        Ok(Self { bytes, transfers, best })
    }

    /// Seconds that it takes, alone and with so many at once.
    #[must_use]
    pub fn seconds(&self, sharing: u32) -> [f64; 2] {
        let alone = self.bytes as f64 / BYTES_PER_SECOND;
        [alone, alone * f64::from(sharing)]
    }

    /// Cycles of the SPU in which it gives the commands.
    #[must_use]
    pub fn commands(&self) -> u64 {
        self.transfers * CHANNELS.len() as u64
    }
}
