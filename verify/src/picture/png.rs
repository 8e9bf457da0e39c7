//! Colours as PNG: the colour layer of an image, or any canvas drawn here, becomes the bytes of a PNG file.
//! Eight bits a channel with alpha and no colour profile, so that decoding gives the same bytes back.
//! An image whose layers do not fit its size is refused.

use super::{PictureError, check_layers};
use contract::Image;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, RgbaImage};

/// The colour layer as a canvas to draw on.
///
/// # Errors
/// [`PictureError::Layer`] if a layer of the image has the wrong length.
pub fn canvas(image: &Image) -> Result<RgbaImage, PictureError> {
    check_layers(image)?;
    let (width, height) = (image.size.width(), image.size.height());
    let color = |x: u32, y: u32| image.rgba[y as usize * width as usize + x as usize];
    Ok(RgbaImage::from_fn(width, height, |x, y| image::Rgba(color(x, y))))
}

/// A canvas as the bytes of a PNG file.
///
/// # Errors
/// [`PictureError::Png`] if the canvas has no pixel.
pub fn png(canvas: &RgbaImage) -> Result<Vec<u8>, PictureError> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Default, FilterType::Adaptive).write_image(
        canvas.as_raw(),
        canvas.width(),
        canvas.height(),
        ExtendedColorType::Rgba8,
    )?;
    Ok(bytes)
}
