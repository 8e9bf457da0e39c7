//! The size of an image, and the image a tracer gives: for each pixel an id, a t and a colour.

use thiserror::Error;

/// The id of a pixel that hits nothing.
pub const MISS: u32 = u32::MAX;
/// The longest side of an image, in pixels. 8K is 7680 x 4320.
pub const MAX_SIDE: u32 = 16_384;
/// The most pixels in one image: 2²⁷, an [`Image`] of 1.6 GB.
pub const MAX_PIXELS: usize = 1 << 27;

/// Width and height of an image in pixels, both from 1 to [`MAX_SIDE`], at most [`MAX_PIXELS`] in all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    width: u32,
    height: u32,
}

/// Why a size was refused.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum SizeError {
    /// A side is zero.
    #[error("an image of {width}x{height} pixels has no pixel")]
    Zero {
        /// As given.
        width: u32,
        /// As given.
        height: u32,
    },
    /// A side or the whole is too large.
    #[error("an image of {width}x{height} pixels is too large; a side may have {side}, the whole {whole}",
        side = MAX_SIDE, whole = MAX_PIXELS)]
    TooLarge {
        /// As given.
        width: u32,
        /// As given.
        height: u32,
    },
    /// Memory for the image could not be had.
    #[error("no memory for an image of {width}x{height} pixels ({bytes} bytes)")]
    NoMemory {
        /// As given.
        width: u32,
        /// As given.
        height: u32,
        /// What the image needs.
        bytes: usize,
    },
}

impl Size {
    /// Checks and keeps a size.
    ///
    /// # Errors
    /// [`SizeError::Zero`] or [`SizeError::TooLarge`].
    pub fn new(width: u32, height: u32) -> Result<Self, SizeError> {
        if width == 0 || height == 0 {
            return Err(SizeError::Zero { width, height });
        }
        let too_large =
            width > MAX_SIDE || height > MAX_SIDE || width as usize * height as usize > MAX_PIXELS;
        if too_large {
            return Err(SizeError::TooLarge { width, height });
        }
        Ok(Self { width, height })
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(self) -> u32 {
        self.height
    }

    /// Pixels in the image.
    #[must_use]
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// What a tracer gives. Pixel (x, y) stands at index `y * width + x` of each layer; each layer has
/// [`Size::pixels`] entries.
#[derive(Clone, Debug)]
pub struct Image {
    /// Its size.
    pub size: Size,
    /// The sphere that is seen, or [`MISS`].
    pub ids: Vec<u32>,
    /// Ray parameter of the hit, +∞ for a miss.
    pub t: Vec<f32>,
    /// Red, green, blue, 255.
    pub rgba: Vec<[u8; 4]>,
}

impl Image {
    /// An image of that size, all of it misses before `background`.
    ///
    /// # Errors
    /// [`SizeError::NoMemory`] if its memory cannot be had.
    pub fn new(size: Size, background: [u8; 3]) -> Result<Self, SizeError> {
        let [r, g, b] = background;
        Ok(Self {
            size,
            ids: filled(size, MISS)?,
            t: filled(size, f32::INFINITY)?,
            rgba: filled(size, [r, g, b, 255])?,
        })
    }
}

fn filled<T: Clone>(size: Size, value: T) -> Result<Vec<T>, SizeError> {
    let mut layer = Vec::new();
    layer.try_reserve_exact(size.pixels()).map_err(|_| SizeError::NoMemory {
        width: size.width,
        height: size.height,
        bytes: size.pixels() * size_of::<(u32, f32, [u8; 4])>(),
    })?;
    layer.resize(size.pixels(), value);
    Ok(layer)
}
