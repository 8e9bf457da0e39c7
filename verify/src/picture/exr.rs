//! The whole answer of a tracer as `OpenEXR`: an image comes in, the bytes of a file with three layers go out.
//!
//! Layer `color` has R, G and B as f32, each the 8-bit value divided by 255; layer `id` has one u32 channel
//! `id` with [`contract::MISS`] = 4294967295 for a miss; layer `t` has one f32 channel `t`, +∞ for a miss. The
//! compression (ZIP, 16 lines a block) loses nothing: ids and t come back bit for bit, infinities included.
//! An image whose layers do not fit its size is refused.

use super::{PictureError, check_layers};
use contract::Image;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image as Exr, ImageAttributes,
    IntegerBounds, Layer, LayerAttributes, LineOrder, Vec2, WritableImage,
};
use std::io::Cursor;

const LOSSLESS: Encoding = Encoding {
    compression: Compression::ZIP16,
    blocks: Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// The image as the bytes of an `OpenEXR` file.
///
/// # Errors
/// [`PictureError::Layer`] if a layer of the image has the wrong length, [`PictureError::Exr`] if the encoder
/// refuses.
pub fn exr(image: &Image) -> Result<Vec<u8>, PictureError> {
    check_layers(image)?;
    let size = Vec2(image.size.width() as usize, image.size.height() as usize);
    let layer = |name: &str, channels| {
        let channels = AnyChannels::sort(channels);
        Layer::new(size, LayerAttributes::named(name), LOSSLESS, channels)
    };
    let level =
        |k: usize| FlatSamples::F32(image.rgba.iter().map(|pixel| f32::from(pixel[k]) / 255.0).collect());
    let color = ["R", "G", "B"].into_iter().zip(0..).map(|(name, k)| AnyChannel::new(name, level(k)));
    let id = AnyChannel::new("id", FlatSamples::U32(image.ids.clone()));
    let t = AnyChannel::new("t", FlatSamples::F32(image.t.clone()));
    let layers = [
        layer("color", color.collect()),
        layer("id", std::iter::once(id).collect()),
        layer("t", std::iter::once(t).collect()),
    ];
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    let mut bytes = Cursor::new(Vec::new());
    Exr::from_layers(attributes, layers.into_iter().collect::<exr::prelude::SmallVec<_>>())
        .write()
        .to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}
