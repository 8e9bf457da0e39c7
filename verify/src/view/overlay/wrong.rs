//! Pixels that differ from the exact picture, in the report's colours ([`PALETTE`]), of all columns or of those left of a line, with how many
//! of each kind there are in the whole picture.

use crate::judge::compare::{Fault, fault_at};
use crate::picture::{PALETTE, fault_color};
use crate::view::canvas::Canvas;
use crate::view::text::Line;
use contract::Image;

/// Wrong pixels by their kind, in the order of [`PALETTE`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wrong(pub [u64; PALETTE.len()]);

impl Wrong {
    /// All of them.
    #[must_use]
    pub fn all(&self) -> u64 {
        self.0.iter().sum()
    }
}

/// Marks the wrong pixels of `shown` in the columns before `until`; both pictures are of the canvas's size, or nothing is done.
pub fn draw(canvas: &mut Canvas, truth: &Image, shown: &Image, until: u32) -> Wrong {
    let mut wrong = Wrong::default();
    if truth.size != canvas.size() || shown.size != canvas.size() {
        return wrong;
    }
    let size = canvas.size();
    for y in 0..size.height() {
        for x in 0..size.width() {
            let index = y as usize * size.width() as usize + x as usize;
            if let Some(fault) = fault_at(truth, shown, index) {
                wrong.0[fault as usize] += 1;
                if x < until {
                    canvas.put(x, y, fault_color(fault));
                }
            }
        }
    }
    wrong
}

/// What is seen, in words.
#[must_use]
pub fn words(wrong: &Wrong, of: &str, pixels: usize) -> Vec<Line> {
    let part = 100.0 * wrong.all() as f64 / pixels as f64;
    let mut lines = vec![Line::from(format!("{of}: {} of {pixels} pixels wrong, {part:.2} %", wrong.all()))];
    for (fault, color, what) in PALETTE {
        let count = wrong.0[fault as usize];
        if count != 0 || matches!(fault, Fault::Missing | Fault::Swapped) {
            lines.push(Line { color: Some(color), words: format!("{count} {what}") });
        }
    }
    lines
}
