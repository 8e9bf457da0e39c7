//! Frames of one size, one after another, into one file: APNG, GIF, or YUV4MPEG2 for other programs.
//!
//! In: a format, a size, how many frames of how many a second, and the frames. Out: bytes, as the frames come, so that no more than one
//! frame is held. APNG keeps every bit of colour; GIF has 256 colours a frame; YUV4MPEG2 rounds ([`y4m`]). Refused are frames
//! of another size than the film's, more or fewer of them than were announced, and sizes that a format has no numbers for.

mod apng;
mod gif;
pub mod y4m;

use super::{PictureError, check_layers};
use contract::{Image, Size};
use std::io::Write;
use thiserror::Error;

/// What a film is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Animated PNG: bit for bit.
    Apng,
    /// GIF: 256 colours in each frame, and delays in hundredths of a second.
    Gif,
    /// YUV4MPEG2, 4:4:4, 8 bits.
    Y4m,
}

/// What a film will be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Announced {
    /// Pixels of every frame.
    pub size: Size,
    /// How many frames will come, at least one.
    pub frames: u32,
    /// Frames in a second, at least one.
    pub fps: u16,
}

/// Why a film was not written.
#[derive(Debug, Error)]
pub enum FilmError {
    /// A frame is no picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A frame is not of the film's size.
    #[error("frame {frame} has {}x{} pixels, the film {}x{}", got.width(), got.height(), film.width(), film.height())]
    Size {
        /// Its number, from 0.
        frame: u32,
        /// Its size.
        got: Size,
        /// The film's.
        film: Size,
    },
    /// There are more or fewer frames than announced.
    #[error("{got} frames came of a film of {announced}")]
    Count {
        /// As announced.
        announced: u32,
        /// As came, at least.
        got: u32,
    },
    /// No frames, or none in a second.
    #[error("a film of {frames} frames, {fps} a second; both must be at least 1")]
    Nothing {
        /// As announced.
        frames: u32,
        /// As announced.
        fps: u16,
    },
    /// The format cannot hold it, or its writer failed.
    #[error("{format}: {cause}")]
    Encoder {
        /// Its name.
        format: &'static str,
        /// What it says.
        #[source]
        cause: Box<dyn std::error::Error + Send + Sync>,
    },
}

/// What takes frames in a format.
trait Encoder {
    fn frame(&mut self, number: u32, image: &Image) -> Result<(), FilmError>;
    fn finish(self: Box<Self>) -> Result<(), FilmError>;
}

/// A film under way.
pub struct Film<'w> {
    announced: Announced,
    taken: u32,
    encoder: Box<dyn Encoder + 'w>,
}

impl<'w> Film<'w> {
    /// Begins one.
    ///
    /// # Errors
    /// [`FilmError::Nothing`], and [`FilmError::Encoder`] for what the format cannot hold or if its head cannot be written.
    pub fn new(format: Format, announced: Announced, to: impl Write + 'w) -> Result<Self, FilmError> {
        let Announced { frames, fps, .. } = announced;
        if frames == 0 || fps == 0 {
            return Err(FilmError::Nothing { frames, fps });
        }
        let encoder: Box<dyn Encoder + 'w> = match format {
            Format::Apng => Box::new(apng::Apng::new(announced, to)?),
            Format::Gif => Box::new(gif::Gif::new(announced, to)?),
            Format::Y4m => Box::new(y4m::Y4m::new(announced, to)?),
        };
        Ok(Self { announced, taken: 0, encoder })
    }

    /// Takes the next frame.
    ///
    /// # Errors
    /// [`FilmError::Size`], [`FilmError::Count`], [`FilmError::Picture`], and [`FilmError::Encoder`] if it cannot be written.
    pub fn frame(&mut self, image: &Image) -> Result<(), FilmError> {
        let Announced { size, frames, .. } = self.announced;
        check_layers(image)?;
        if image.size != size {
            return Err(FilmError::Size { frame: self.taken, got: image.size, film: size });
        }
        if self.taken == frames {
            return Err(FilmError::Count { announced: frames, got: frames + 1 });
        }
        self.encoder.frame(self.taken, image)?;
        self.taken += 1;
        Ok(())
    }

    /// Ends it.
    ///
    /// # Errors
    /// [`FilmError::Count`] if frames are missing, [`FilmError::Encoder`] if its end cannot be written.
    pub fn finish(self) -> Result<(), FilmError> {
        if self.taken != self.announced.frames {
            return Err(FilmError::Count { announced: self.announced.frames, got: self.taken });
        }
        self.encoder.finish()
    }
}

/// An encoder's failure under its format's name.
fn failed<E: Into<Box<dyn std::error::Error + Send + Sync>>>(
    format: &'static str,
) -> impl Fn(E) -> FilmError {
    move |cause| FilmError::Encoder { format, cause: cause.into() }
}
