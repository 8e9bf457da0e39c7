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

/// Which faults are marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marked {
    /// Where another sphere is seen, or none, or one where there is none.
    Spheres,
    /// Also where only t or the colour is wrong.
    All,
}

impl Marked {
    /// Whether a fault is among them.
    #[must_use]
    pub fn has(self, fault: Fault) -> bool {
        self == Self::All || fault.grade() == 0
    }
}

impl Wrong {
    /// All of them.
    #[must_use]
    pub fn all(&self) -> u64 {
        self.0.iter().sum()
    }
}

/// Marks the wrong pixels of `shown` in the columns before `until`, those that show a wrong sphere or all of them, and counts all; both pictures
/// are of the canvas's size, or nothing is done.
pub fn draw(canvas: &mut Canvas, truth: &Image, shown: &Image, until: u32, marked: Marked) -> Wrong {
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
                if x < until && marked.has(fault) {
                    canvas.put(x, y, fault_color(fault));
                }
            }
        }
    }
    wrong
}

/// What is seen, in words.
#[must_use]
pub fn words(wrong: &Wrong, of: &str, pixels: usize, marked: Marked) -> Vec<Line> {
    let part = 100.0 * wrong.all() as f64 / pixels as f64;
    let mut lines = vec![Line::from(format!("{of}: {} of {pixels} pixels wrong, {part:.2} %", wrong.all()))];
    for (fault, color, what) in PALETTE {
        let count = wrong.0[fault as usize];
        if count != 0 || matches!(fault, Fault::Missing | Fault::Swapped) {
            let (color, told) =
                if marked.has(fault) { (Some(color), "") } else { (None, " (unmarked; E marks it)") };
            lines.push(Line { color, words: format!("{count} {what}{told}") });
        }
    }
    lines
}
