//! Pictures for people and for other programs: PNG, `OpenEXR`, films of many, and the triptych that shows where two images differ.
//! A [`contract::Image`] comes in, bytes or an [`RgbaImage`] go out; nothing here decides who is right.
//! Refused are images whose layers are not as long as their size says, and pairs of different sizes.

mod difference;
mod exr;
pub mod film;
mod png;
mod triptych;
mod write;

pub(crate) use self::difference::dimmed;
pub use self::difference::{PALETTE, RARE, bold_difference, difference, fault_color, square_side};
pub use self::exr::exr;
pub use self::png::{canvas, png};
pub use self::triptych::{GAP, MARK, join, panels, ring_radius, triptych, zoom};
pub use self::write::{AtomicFile, WriteError, check_file, check_folder, write_atomically};
pub use image::RgbaImage;

use contract::Image;
use thiserror::Error;

/// Why a picture could not be made.
#[derive(Debug, Error)]
pub enum PictureError {
    /// A layer of the image has more or fewer entries than the image has pixels.
    #[error("layer {layer} has {entries} entries for an image of {pixels} pixels")]
    Layer {
        /// `ids`, `t` or `rgba`.
        layer: &'static str,
        /// Its length.
        entries: usize,
        /// What it should be.
        pixels: usize,
    },
    /// Two images that were to be compared differ in size.
    #[error("the truth has {truth:?} pixels, the subject {subject:?}")]
    Sizes {
        /// Width and height.
        truth: [u32; 2],
        /// Width and height.
        subject: [u32; 2],
    },
    /// The PNG encoder refused.
    #[error("PNG: {0}")]
    Png(#[from] image::ImageError),
    /// The `OpenEXR` encoder refused.
    #[error("OpenEXR: {0}")]
    Exr(#[from] ::exr::error::Error),
}

/// The layers of an [`Image`] are public vectors, so their lengths are checked where they are relied on.
fn check_layers(image: &Image) -> Result<(), PictureError> {
    let pixels = image.size.pixels();
    for (layer, entries) in [("ids", image.ids.len()), ("t", image.t.len()), ("rgba", image.rgba.len())] {
        if entries != pixels {
            return Err(PictureError::Layer { layer, entries, pixels });
        }
    }
    Ok(())
}

fn check_pair(truth: &Image, subject: &Image) -> Result<(), PictureError> {
    check_layers(truth)?;
    check_layers(subject)?;
    if truth.size == subject.size {
        return Ok(());
    }
    let sides = |image: &Image| [image.size.width(), image.size.height()];
    Err(PictureError::Sizes { truth: sides(truth), subject: sides(subject) })
}
