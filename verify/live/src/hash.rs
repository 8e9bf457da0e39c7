//! One number for a whole picture.

use contract::Image;
use sha2::{Digest, Sha256};

/// SHA-256 of width and height, then all ids, then all t as bits, each in four bytes, least first, then red, green, blue and 255 of all
/// pixels, row by row.
#[must_use]
pub fn hash(image: &Image) -> [u8; 32] {
    let mut sha = Sha256::new();
    sha.update(image.size.width().to_le_bytes());
    sha.update(image.size.height().to_le_bytes());
    for id in &image.ids {
        sha.update(id.to_le_bytes());
    }
    for t in &image.t {
        sha.update(t.to_bits().to_le_bytes());
    }
    sha.update(image.rgba.as_flattened());
    sha.finalize().into()
}
