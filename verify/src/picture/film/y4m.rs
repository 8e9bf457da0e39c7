//! YUV4MPEG2, as ffmpeg, mpv and x264 read it from a pipe: 4:4:4, so that each pixel has its own three numbers, 8 bits.
//!
//! The numbers are those of ITU-R BT.601 in studio range, which readers take for granted where a stream says nothing: Y from 16 to 235, U and V
//! from 16 to 240 about 128, each rounded to nearest ([`yuv`]). So a pixel read back is off by up to [`WORST`] in a channel.

use super::{Announced, Encoder, FilmError, failed};
use contract::Image;
use std::io::Write;

/// The most that a channel is off, of 256, when it is turned back to RGB by the inverse and rounded ([`rgb`]); found over all colours.
pub const WORST: u8 = 2;

pub(super) struct Y4m<W: Write> {
    encoder: ::y4m::Encoder<W>,
    planes: [Vec<u8>; 3],
}

impl<W: Write> Y4m<W> {
    pub(super) fn new(announced: Announced, to: W) -> Result<Self, FilmError> {
        let Announced { size, fps, .. } = announced;
        let rate = ::y4m::Ratio::new(fps.into(), 1);
        let encoder = ::y4m::encode(size.width() as usize, size.height() as usize, rate)
            .with_colorspace(::y4m::Colorspace::C444)
            .with_pixel_aspect(::y4m::Ratio::new(1, 1))
            .write_header(to)
            .map_err(failed("YUV4MPEG2"))?;
        Ok(Self { encoder, planes: Default::default() })
    }
}

impl<W: Write> Encoder for Y4m<W> {
    fn frame(&mut self, _: u32, image: &Image) -> Result<(), FilmError> {
        self.planes.iter_mut().for_each(Vec::clear);
        for &[r, g, b, _] in &image.rgba {
            for (plane, value) in self.planes.iter_mut().zip(yuv([r, g, b])) {
                plane.push(value);
            }
        }
        let [y, u, v] = &self.planes;
        self.encoder.write_frame(&::y4m::Frame::new([y, u, v], None)).map_err(failed("YUV4MPEG2"))
    }

    fn finish(self: Box<Self>) -> Result<(), FilmError> {
        Ok(())
    }
}

/// Y, U and V of a colour, in studio range: Y' = 0.299 R + 0.587 G + 0.114 B, U = (B − Y') / 1.772, V = (R − Y') / 1.402, scaled to 219 and
/// 224 steps and rounded to nearest.
#[must_use]
pub fn yuv(color: [u8; 3]) -> [u8; 3] {
    let [r, g, b] = color.map(|x| f64::from(x) / 255.0);
    let y = 0.299 * r + 0.587 * g + 0.114 * b;
    let [u, v] = [(b - y) / 1.772, (r - y) / 1.402];
    [16.0 + 219.0 * y, 128.0 + 224.0 * u, 128.0 + 224.0 * v].map(|x| x.round() as u8)
}

/// The colour of Y, U and V in studio range, rounded to nearest.
#[must_use]
pub fn rgb([y, u, v]: [u8; 3]) -> [u8; 3] {
    let y = (f64::from(y) - 16.0) / 219.0;
    let [u, v] = [u, v].map(|x| (f64::from(x) - 128.0) / 224.0);
    let (r, b) = (y + 1.402 * v, y + 1.772 * u);
    let g = (y - 0.299 * r - 0.114 * b) / 0.587;
    [r, g, b].map(|x| (255.0 * x).round() as u8)
}
