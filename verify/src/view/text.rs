//! Words on a canvas: Noto Sans Mono, anti-aliased, sixteen pixels high, on a dark panel so that they can be read on any picture. What the font lacks
//! is left blank.

use super::canvas::{Canvas, blended};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use optimized::stripe::Rect;

/// Pixels from a line to the next.
pub const LINE: u32 = 18;
/// Pixels round the words of a panel.
const PAD: u32 = 8;
const INK: [u8; 3] = [0xF2, 0xF2, 0xF2];
const GROUND: [u8; 3] = [0x10, 0x12, 0x16];

/// A line of a panel: a square of a colour if there is one, and words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Of a legend.
    pub color: Option<[u8; 3]>,
    /// What is written.
    pub words: String,
}

impl From<String> for Line {
    fn from(words: String) -> Self {
        Self { color: None, words }
    }
}

/// Where a panel is put.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// Above, left.
    TopLeft,
    /// Below, left.
    BottomLeft,
    /// In the middle.
    Middle,
}

/// Pixels of a character across.
fn wide() -> u32 {
    u32::try_from(get_raster_width(FontWeight::Regular, RasterHeight::Size16)).unwrap_or(0)
}

/// Draws lines on a panel.
pub fn panel(canvas: &mut Canvas, corner: Corner, lines: &[Line]) {
    let square = |line: &Line| if line.color.is_some() { 2 } else { 0 };
    let letters = |line: &Line| u32::try_from(line.words.chars().count()).unwrap_or(0) + square(line);
    let width = lines.iter().map(letters).max().unwrap_or(0) * wide() + 2 * PAD;
    let height = u32::try_from(lines.len()).unwrap_or(0) * LINE + 2 * PAD;
    let size = canvas.size();
    let [x, y] = match corner {
        Corner::TopLeft => [PAD, PAD],
        Corner::BottomLeft => [PAD, size.height().saturating_sub(height + PAD)],
        Corner::Middle => [size.width().saturating_sub(width) / 2, size.height().saturating_sub(height) / 2],
    };
    canvas.blend(Rect { x: [x, x + width], y: [y, y + height] }, GROUND, 208);
    for (line, row) in lines.iter().zip(0..) {
        let [mut x, y] = [x + PAD, y + PAD + row * LINE];
        if let Some(color) = line.color {
            canvas.blend(Rect { x: [x, x + wide() + 2], y: [y + 4, y + LINE - 4] }, color, 256);
            x += square(line) * wide();
        }
        write(canvas, [x, y], &line.words, INK);
    }
}

/// Writes words with their upper left corner at (x, y).
pub fn write(canvas: &mut Canvas, [mut x, y]: [u32; 2], words: &str, ink: [u8; 3]) {
    for letter in words.chars() {
        if let Some(raster) = get_raster(letter, FontWeight::Regular, RasterHeight::Size16) {
            for (row, line) in (0..).zip(raster.rows()) {
                for (column, &cover) in (0..).zip(line) {
                    if cover != 0 {
                        let part = u16::from(cover) + 1;
                        canvas.change(x + column, y + row, |under| blended(under, ink, part));
                    }
                }
            }
        }
        x += wide();
    }
}

/// Pixels that words take across.
#[must_use]
pub fn width(words: &str) -> u32 {
    u32::try_from(words.chars().count()).unwrap_or(0) * wide()
}
