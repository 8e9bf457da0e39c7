//! Truth, subject and difference side by side, and the same three magnified around a wrong pixel, which the judge names.
//! Two images come in, canvases go out. A ring and four ticks mark the pixel in every panel, sized
//! to the image, so that a single wrong pixel among millions is found when the picture is shown small; the ring
//! leaves the pixels near its centre untouched. Pairs of different sizes are refused.

use super::{PictureError, bold_difference, canvas, difference};
use contract::Image;
use image::imageops::overlay;
use image::{Rgba, RgbaImage};

/// Pixels between two panels, transparent.
pub const GAP: u32 = 8;
/// Colour of the ring; it has a black rim, so that it shows on any ground.
pub const MARK: [u8; 4] = [255, 255, 255, 255];
const RIM: [u8; 4] = [0, 0, 0, 255];

/// Truth, subject and [`bold_difference`], each of the image's size, a pixel marked in each if one is to be.
///
/// # Errors
/// [`PictureError::Layer`] and [`PictureError::Sizes`].
pub fn panels(
    truth: &Image,
    subject: &Image,
    place: Option<[u32; 2]>,
) -> Result<[RgbaImage; 3], PictureError> {
    let mut panels = [canvas(truth)?, canvas(subject)?, bold_difference(truth, subject)?];
    if let Some(place) = place {
        panels.iter_mut().for_each(|panel| mark(panel, place));
    }
    Ok(panels)
}

/// [`panels`] joined to one picture.
///
/// # Errors
/// [`PictureError::Layer`] and [`PictureError::Sizes`].
pub fn triptych(truth: &Image, subject: &Image, place: Option<[u32; 2]>) -> Result<RgbaImage, PictureError> {
    panels(truth, subject, place).map(|panels| join(&panels))
}

/// The `side` x `side` pixels around one, each drawn as `scale` x `scale`, that one framed. The difference is the exact one, no pixel
/// enlarged beyond the others. What lies outside the image is transparent.
///
/// # Errors
/// [`PictureError::Layer`] and [`PictureError::Sizes`].
pub fn zoom(
    truth: &Image,
    subject: &Image,
    place: [u32; 2],
    side: u32,
    scale: u32,
) -> Result<[RgbaImage; 3], PictureError> {
    let panels = [canvas(truth)?, canvas(subject)?, difference(truth, subject)?];
    Ok(panels.map(|panel| magnified(&panel, place, side.max(1), scale.max(1))))
}

/// Panels from left to right with [`GAP`] between them.
#[must_use]
pub fn join(panels: &[RgbaImage; 3]) -> RgbaImage {
    let width = panels.iter().map(RgbaImage::width).sum::<u32>() + 2 * GAP;
    let height = panels.iter().map(RgbaImage::height).max().unwrap_or(0);
    let mut whole = RgbaImage::new(width, height);
    let mut left = 0;
    for panel in panels {
        overlay(&mut whole, panel, i64::from(left), 0);
        left += panel.width() + GAP;
    }
    whole
}

/// Radius in pixels of the ring in a panel of that width: a fortieth of it, but at least 6.
#[must_use]
pub fn ring_radius(width: u32) -> u32 {
    (width / 40).max(6)
}

/// The ring, its rim inside and outside, and ticks of one radius that point at the pixel.
fn mark(panel: &mut RgbaImage, [x, y]: [u32; 2]) {
    let (width, height) = (i64::from(panel.width()), i64::from(panel.height()));
    let (x, y) = (i64::from(x), i64::from(y));
    let radius = i64::from(ring_radius(panel.width()));
    let half = radius / 12;
    let rim = half + (half / 2).max(1);
    let reach = 2 * radius + rim;
    for row in (y - reach).max(0)..(y + reach + 1).min(height) {
        for column in (x - reach).max(0)..(x + reach + 1).min(width) {
            let color = match distance_from_mark(column - x, row - y, radius) {
                off if off <= half => MARK,
                off if off <= rim => RIM,
                _ => continue,
            };
            if let (Ok(column), Ok(row)) = (u32::try_from(column), u32::try_from(row)) {
                panel.put_pixel(column, row, Rgba(color));
            }
        }
    }
}

/// How many pixels (dx, dy) lies off the nearest line of the mark.
fn distance_from_mark(dx: i64, dy: i64, radius: i64) -> i64 {
    let squared = dx * dx + dy * dy;
    let ring = (squared.isqrt() - radius).abs();
    let (along, across) = (dx.abs().max(dy.abs()), dx.abs().min(dy.abs()));
    let beyond_ends = (radius - along).max(along - 2 * radius).max(0);
    ring.min(across.max(beyond_ends))
}

fn magnified(panel: &RgbaImage, [x, y]: [u32; 2], side: u32, scale: u32) -> RgbaImage {
    let half = i64::from(side / 2);
    let (left, top) = (i64::from(x) - half, i64::from(y) - half);
    let source = |at: u32, first: i64| u32::try_from(first + i64::from(at / scale)).ok();
    let mut zoomed = RgbaImage::from_fn(side * scale, side * scale, |column, row| {
        let inside = source(column, left).zip(source(row, top));
        inside.and_then(|(x, y)| panel.get_pixel_checked(x, y)).copied().unwrap_or(Rgba([0; 4]))
    });
    frame(&mut zoomed, side / 2 * scale, scale);
    zoomed
}

/// A white line with a black one around it, just outside the magnified pixel that starts at (`start`, `start`).
fn frame(zoomed: &mut RgbaImage, start: u32, scale: u32) {
    let (first, last) = (i64::from(start), i64::from(start + scale - 1));
    let outside = |at: u32| (first - i64::from(at)).max(i64::from(at) - last);
    for (column, row, pixel) in zoomed.enumerate_pixels_mut() {
        match outside(column).max(outside(row)) {
            1..=3 => *pixel = Rgba(MARK),
            4 | 5 => *pixel = Rgba(RIM),
            _ => {}
        }
    }
}
