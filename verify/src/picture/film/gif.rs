//! GIF: 256 colours in each frame, chosen for it (`NeuQuant`, after Dekker 1994); a frame that has no more than that keeps them all. The rest is
//! rounded to the nearest of them, so a GIF is to be looked at and not to be compared. Delays are in hundredths of a second; each frame ends
//! where its end lies nearest to the true one, so that no time is lost over many. Sides have 16 bits, more than the contract allows.

use super::{Announced, Encoder, FilmError, failed};
use contract::Image;
use std::io::Write;

/// How coarsely `NeuQuant` samples, 1 to 30: every fifth pixel teaches the palette.
const SPEED: i32 = 5;

pub(super) struct Gif<W: Write> {
    encoder: gif::Encoder<W>,
    announced: Announced,
}

impl<W: Write> Gif<W> {
    pub(super) fn new(announced: Announced, to: W) -> Result<Self, FilmError> {
        let [width, height] = sides(&announced)?;
        let mut encoder = gif::Encoder::new(to, width, height, &[]).map_err(failed("GIF"))?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(failed("GIF"))?;
        Ok(Self { encoder, announced })
    }
}

fn sides(announced: &Announced) -> Result<[u16; 2], FilmError> {
    let side = |side: u32| u16::try_from(side).map_err(failed("GIF"));
    Ok([side(announced.size.width())?, side(announced.size.height())?])
}

/// Hundredths of a second from the beginning to the end of so many frames.
fn end(frames: u32, fps: u16) -> u64 {
    (u64::from(frames) * 200 + u64::from(fps)) / (2 * u64::from(fps))
}

impl<W: Write> Encoder for Gif<W> {
    fn frame(&mut self, number: u32, image: &Image) -> Result<(), FilmError> {
        let [width, height] = sides(&self.announced)?;
        let mut bytes = image.rgba.as_flattened().to_vec();
        let mut frame = gif::Frame::from_rgba_speed(width, height, &mut bytes, SPEED);
        let delay = end(number + 1, self.announced.fps) - end(number, self.announced.fps);
        frame.delay = u16::try_from(delay).map_err(failed("GIF"))?;
        self.encoder.write_frame(&frame).map_err(failed("GIF"))
    }

    fn finish(self: Box<Self>) -> Result<(), FilmError> {
        self.encoder.into_inner().map(drop).map_err(failed("GIF"))
    }
}
