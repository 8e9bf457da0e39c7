//! The gzip layer, told by its first two bytes. Packed bytes come in, plain ones go out; what unpacks to more
//! than [`limit`] is refused before it takes the memory, a cut stream gives what it held, a corrupt one is refused.
//!
//! It is unpacked twice, first to see how long it is: a list that grew would take three times the memory.

use super::ReadError;
use flate2::read::MultiGzDecoder;
use std::borrow::Cow;
use std::io::{ErrorKind, Read, copy, sink};

/// The most that so many packed bytes may unpack to, in bytes: 8 times as many and 16 MB, which leaves twice as many and 40 MB for
/// the scene. Coordinates as text pack 3 to 5 times; a bomb packs 1,000 times.
#[must_use]
pub fn limit(packed: usize) -> u64 {
    8 * packed as u64 + (16 << 20)
}

/// Bytes without their gzip layer, and whether that was cut.
pub(super) fn unpack<'a>(file: &str, bytes: &'a [u8]) -> Result<(Cow<'a, [u8]>, bool), ReadError> {
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok((Cow::Borrowed(bytes), false));
    }
    let limit = limit(bytes.len());
    let beyond = || ReadError::GzipLimit { file: file.into(), packed: bytes.len(), limit };
    let mut counted = MultiGzDecoder::new(bytes).take(limit + 1);
    // Where it breaks off is told when it is read.
    _ = copy(&mut counted, &mut sink());
    let length = limit + 1 - counted.limit();
    if length > limit {
        return Err(beyond());
    }
    let mut plain = Vec::new();
    let room = usize::try_from(length).ok().and_then(|length| plain.try_reserve_exact(length).ok());
    room.ok_or_else(beyond)?;
    let end = MultiGzDecoder::new(bytes).take(limit + 1).read_to_end(&mut plain);
    match end {
        Ok(_) => Ok((Cow::Owned(plain), false)),
        Err(e) if e.kind() == ErrorKind::UnexpectedEof => Ok((Cow::Owned(plain), true)),
        Err(e) => Err(ReadError::Gzip { file: file.into(), detail: e.to_string() }),
    }
}
