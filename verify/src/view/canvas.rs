//! What a window shows: pixels of 32 bits, 0x00RRGGBB, row by row. Pictures are copied onto it unchanged; overlays blend and draw. What lies
//! outside is not drawn.

use contract::{Image, Size};
use optimized::stripe::Rect;
use std::ops::Range;

/// Pixels to be shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canvas {
    size: Size,
    pixels: Vec<u32>,
}

/// A colour as a canvas has it.
#[must_use]
pub fn packed([r, g, b]: [u8; 3]) -> u32 {
    u32::from_be_bytes([0, r, g, b])
}

/// And back.
#[must_use]
pub fn channels(pixel: u32) -> [u8; 3] {
    let [_, r, g, b] = pixel.to_be_bytes();
    [r, g, b]
}

impl Canvas {
    /// Black.
    #[must_use]
    pub fn new(size: Size) -> Self {
        Self { size, pixels: vec![0; size.pixels()] }
    }

    /// Its size.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// Its pixels, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }

    /// A pixel; `None` outside.
    #[must_use]
    pub fn get(&self, x: u32, y: u32) -> Option<u32> {
        let inside = x < self.size.width() && y < self.size.height();
        inside.then(|| self.pixels[y as usize * self.size.width() as usize + x as usize])
    }

    /// Becomes a picture of its own size, or columns of one, and takes that size first if it has another.
    pub fn take(&mut self, image: &Image, columns: Range<u32>) {
        if self.size != image.size {
            *self = Self::new(image.size);
        }
        let width = self.size.width() as usize;
        let columns =
            columns.start.min(self.size.width()) as usize..columns.end.min(self.size.width()) as usize;
        for (row, colors) in self.pixels.chunks_mut(width).zip(image.rgba.chunks(width)) {
            for (pixel, color) in row[columns.clone()].iter_mut().zip(&colors[columns.clone()]) {
                // Red, green, blue and opacity as bytes of a number, the first the highest; the opacity goes.
                *pixel = u32::from_be_bytes(*color) >> 8;
            }
        }
    }

    /// Copies another, and takes its size.
    pub fn copy(&mut self, other: &Self) {
        self.size = other.size;
        self.pixels.clone_from(&other.pixels);
    }

    /// Draws a pixel.
    pub fn put(&mut self, x: u32, y: u32, color: [u8; 3]) {
        self.change(x, y, |_| color);
    }

    /// Changes a pixel.
    pub fn change(&mut self, x: u32, y: u32, how: impl FnOnce([u8; 3]) -> [u8; 3]) {
        if x < self.size.width() && y < self.size.height() {
            let pixel = &mut self.pixels[y as usize * self.size.width() as usize + x as usize];
            *pixel = packed(how(channels(*pixel)));
        }
    }

    /// Lays a colour over a rectangle, `part` of 256 of it.
    pub fn blend(&mut self, rect: Rect, color: [u8; 3], part: u16) {
        for y in rect.y[0]..rect.y[1].min(self.size.height()) {
            for x in rect.x[0]..rect.x[1].min(self.size.width()) {
                self.change(x, y, |under| blended(under, color, part));
            }
        }
    }

    /// Makes all of it grey, as light as it was in a range that every colour outshines.
    pub fn dim(&mut self) {
        for pixel in &mut self.pixels {
            let [r, g, b] = channels(*pixel);
            *pixel = packed(crate::picture::dimmed([r, g, b, 255]));
        }
    }
}

/// `part` of 256 of a colour over another.
#[must_use]
pub fn blended(under: [u8; 3], over: [u8; 3], part: u16) -> [u8; 3] {
    let part = u32::from(part.min(256));
    std::array::from_fn(|i| {
        let sum = u32::from(over[i]) * part + u32::from(under[i]) * (256 - part);
        u8::try_from(sum / 256).unwrap_or(u8::MAX)
    })
}
