//! The difference of two images: the truth dimmed to grey, and on it every wrong pixel in the colour of its fault.
//! Truth and subject come in, a canvas of the same size goes out. Each pixel has one fault, the gravest: a wrong
//! id before a wrong t, a wrong t before a wrong colour. The colours are told apart with every common form of
//! colour blindness (Okabe and Ito, "Color Universal Design", 2008) and none of them is grey.
//! Pairs of different sizes are refused.

use super::{PictureError, check_pair};
use crate::judge::compare::{Fault, fault_at};
use contract::Image;
use image::{Rgba, RgbaImage};

/// A fault that at most one pixel in so many has is drawn larger by [`bold_difference`].
pub const RARE: usize = 500;

/// The colour of each fault in the difference panel and what a legend calls it, gravest first.
pub const PALETTE: [(Fault, [u8; 3], &str); 5] = [
    (Fault::Missing, [0xD5, 0x5E, 0x00], "missing: the truth hits, the subject does not"),
    (Fault::Extra, [0x56, 0xB4, 0xE9], "extra: the subject hits, the truth does not"),
    (Fault::Swapped, [0xF0, 0xE4, 0x42], "swapped: another sphere"),
    (Fault::T, [0x00, 0x9E, 0x73], "right sphere, wrong t"),
    (Fault::Color, [0xCC, 0x79, 0xA7], "only the colour is wrong"),
];

/// The colour of a fault in [`PALETTE`].
#[must_use]
pub fn fault_color(fault: Fault) -> [u8; 3] {
    PALETTE[fault as usize].1
}

/// The difference panel.
///
/// # Errors
/// [`PictureError::Layer`] and [`PictureError::Sizes`].
pub fn difference(truth: &Image, subject: &Image) -> Result<RgbaImage, PictureError> {
    check_pair(truth, subject)?;
    let (width, height) = (truth.size.width(), truth.size.height());
    Ok(RgbaImage::from_fn(width, height, |x, y| {
        let index = y as usize * width as usize + x as usize;
        let [r, g, b] =
            fault_at(truth, subject, index).map_or_else(|| dimmed(truth.rgba[index]), fault_color);
        Rgba([r, g, b, 255])
    }))
}

/// The difference panel for a small screen: as [`difference`], but each pixel of a rare fault (at most one pixel in
/// [`RARE`]) is drawn as a square of [`square_side`] pixels, so that it is still there when the picture is shown
/// at a third of its size. Where squares meet, the graver fault is seen.
///
/// # Errors
/// [`PictureError::Layer`] and [`PictureError::Sizes`].
pub fn bold_difference(truth: &Image, subject: &Image) -> Result<RgbaImage, PictureError> {
    let mut panel = difference(truth, subject)?;
    let (width, height) = (truth.size.width(), truth.size.height());
    let places = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let faults: Vec<_> = places
        .enumerate()
        .filter_map(|(index, place)| Some((fault_at(truth, subject, index)?, place)))
        .collect();
    for (fault, [r, g, b], _) in PALETTE.into_iter().rev() {
        let of_kind = || faults.iter().filter(|(kind, _)| *kind == fault);
        let rare = of_kind().count() * RARE <= truth.size.pixels();
        let half = if rare { square_side(width) / 2 } else { 0 };
        of_kind().for_each(|(_, place)| fill_square(&mut panel, *place, half, Rgba([r, g, b, 255])));
    }
    Ok(panel)
}

/// Grey of about the same lightness, in the range 24 to 88 of 255, so that every fault outshines it.
pub(crate) fn dimmed([r, g, b, _]: [u8; 4]) -> [u8; 3] {
    let luma = (u32::from(r) * 54 + u32::from(g) * 183 + u32::from(b) * 19) >> 8;
    [u8::try_from(24 + luma / 4).unwrap_or(u8::MAX); 3]
}

/// Side in pixels of the square for a rare fault in a panel of that width: 9 for 1280, 1 below 320.
#[must_use]
pub fn square_side(width: u32) -> u32 {
    width / 320 * 2 + 1
}

fn fill_square(panel: &mut RgbaImage, [x, y]: [u32; 2], half: u32, color: Rgba<u8>) {
    for row in y.saturating_sub(half)..=(y + half).min(panel.height() - 1) {
        for column in x.saturating_sub(half)..=(x + half).min(panel.width() - 1) {
            panel.put_pixel(column, row, color);
        }
    }
}
