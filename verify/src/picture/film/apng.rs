//! Animated PNG: each frame whole, eight bits a channel without alpha, endlessly repeated. Decoding gives the same bytes back; who knows no
//! animation shows the first frame.

use super::{Announced, Encoder, FilmError, failed};
use contract::Image;
use std::io::Write;

pub(super) struct Apng<W: Write> {
    writer: png::Writer<W>,
    bytes: Vec<u8>,
}

impl<W: Write> Apng<W> {
    pub(super) fn new(announced: Announced, to: W) -> Result<Self, FilmError> {
        let Announced { size, frames, fps } = announced;
        let begin = || {
            let mut encoder = png::Encoder::new(to, size.width(), size.height());
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_depth(png::BitDepth::Eight);
            encoder.set_compression(png::Compression::Balanced);
            encoder.set_animated(frames, 0)?;
            encoder.set_frame_delay(1, fps)?;
            encoder.write_header()
        };
        Ok(Self { writer: begin().map_err(failed("APNG"))?, bytes: Vec::new() })
    }
}

impl<W: Write> Encoder for Apng<W> {
    fn frame(&mut self, _: u32, image: &Image) -> Result<(), FilmError> {
        self.bytes.clear();
        self.bytes.extend(image.rgba.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]));
        self.writer.write_image_data(&self.bytes).map_err(failed("APNG"))
    }

    fn finish(self: Box<Self>) -> Result<(), FilmError> {
        self.writer.finish().map_err(failed("APNG"))
    }
}
