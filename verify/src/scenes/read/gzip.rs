//! The gzip layer, told by its first two bytes. Packed bytes come in, plain ones go out; what unpacks to more
//! than [`limit`] is refused before it takes the memory, a cut stream gives what it held, a corrupt one is refused.

use super::ReadError;
use flate2::read::MultiGzDecoder;
use std::borrow::Cow;
use std::io::{ErrorKind, Read};

/// The most that so many packed bytes may unpack to, in bytes: 64 times as many and 16 MB. Coordinates as text
/// pack 3 to 10 times; a bomb packs 1,000 times.
#[must_use]
pub fn limit(packed: usize) -> u64 {
    64 * packed as u64 + (16 << 20)
}

/// Bytes without their gzip layer, and whether that was cut.
pub(super) fn unpack<'a>(file: &str, bytes: &'a [u8]) -> Result<(Cow<'a, [u8]>, bool), ReadError> {
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok((Cow::Borrowed(bytes), false));
    }
    let limit = limit(bytes.len());
    let mut plain = Vec::new();
    let end = MultiGzDecoder::new(bytes).take(limit + 1).read_to_end(&mut plain);
    if plain.len() as u64 > limit {
        return Err(ReadError::GzipLimit { file: file.into(), packed: bytes.len(), limit });
    }
    match end {
        Ok(_) => Ok((Cow::Owned(plain), false)),
        Err(e) if e.kind() == ErrorKind::UnexpectedEof => Ok((Cow::Owned(plain), true)),
        Err(e) => Err(ReadError::Gzip { file: file.into(), detail: e.to_string() }),
    }
}
