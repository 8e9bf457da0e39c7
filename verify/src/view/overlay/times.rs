//! Where the time of a frame goes, as numbers and as a bar: building, tracing, copying onto the canvas, overlays, and the window.

use crate::view::canvas::Canvas;
use crate::view::clock::Split;
use crate::view::text::{Corner, LINE, Line, panel};
use optimized::stripe::Rect;

/// Pixels of the bar.
const WIDE: u32 = 320;
/// The colours of the parts, of Okabe and Ito.
const COLORS: [[u8; 3]; 5] =
    [[0xE6, 0x9F, 0x00], [0x56, 0xB4, 0xE9], [0x00, 0x9E, 0x73], [0xCC, 0x79, 0xA7], [0xF0, 0xE4, 0x42]];

/// Draws it, below some words.
pub fn draw(canvas: &mut Canvas, head: Vec<String>, split: &Split) {
    let mut lines: Vec<Line> = head.into_iter().map(Line::from).collect();
    let sum = split.sum().as_secs_f64();
    lines.push(Line::from(format!(
        "a frame {:7.3} ms, {:.0} a second could be had",
        sum * 1e3,
        1.0 / sum.max(1e-9)
    )));
    for ((name, part), color) in split.parts().into_iter().zip(COLORS) {
        let words = format!("{name:<7} {:7.3} ms", part.as_secs_f64() * 1e3);
        lines.push(Line { color: Some(color), words });
    }
    lines.push(Line::from(" ".repeat(WIDE as usize / 8 + 1)));
    panel(canvas, Corner::TopLeft, &lines);
    let y = 16 + (u32::try_from(lines.len()).unwrap_or(1) - 1) * LINE;
    let mut x = 16;
    for ((_, part), color) in split.parts().into_iter().zip(COLORS) {
        let wide = (f64::from(WIDE) * part.as_secs_f64() / sum.max(1e-9)).round() as u32;
        canvas.blend(Rect { x: [x, x + wide], y: [y + 3, y + LINE - 3] }, color, 256);
        x += wide;
    }
}
