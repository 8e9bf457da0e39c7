//! The rays that f32 left open, each pixel in the colour of what settled it, on the picture dimmed to grey. There are few, so each has a darker
//! frame round it, which leaves its neighbours as they are.

use crate::view::canvas::{Canvas, blended};
use crate::view::tally::{Fallback, Tally};
use crate::view::text::Line;
use optimized::plan::{Arithmetic, Plan};

/// f64 found the sphere.
pub const BY_F64: [u8; 3] = [0xF0, 0xE4, 0x42];
/// Integers found the sphere, or how t is rounded.
pub const BY_INTEGERS: [u8; 3] = [0xD5, 0x5E, 0x00];
/// The sphere was certain, and f64 found t by the longer way.
pub const ONLY_T: [u8; 3] = [0x56, 0xB4, 0xE9];
/// Pixels from a ray to its frame.
const FRAME: i64 = 5;

/// The colour of a lane.
#[must_use]
pub fn color(lane: &Fallback) -> [u8; 3] {
    match lane {
        Fallback { integers: true, .. } => BY_INTEGERS,
        Fallback { marked: true, .. } => BY_F64,
        _ => ONLY_T,
    }
}

/// Draws them.
pub fn draw(canvas: &mut Canvas, tally: &Tally, plan: &Plan) -> Vec<Line> {
    if plan.arithmetic != Arithmetic::Certified {
        let told = "fallback: only certified arithmetic falls back; M chooses it";
        return vec![Line::from(told.to_owned())];
    }
    canvas.dim();
    let size = canvas.size();
    let inside = |lane: &&Fallback| lane.column < size.width() && lane.row < size.height();
    for lane in tally.fallbacks.iter().filter(inside) {
        frame(canvas, lane);
    }
    for lane in tally.fallbacks.iter().filter(inside) {
        canvas.put(lane.column, lane.row, color(lane));
    }
    let of = |kind: [u8; 3]| tally.fallbacks.iter().filter(|lane| color(lane) == kind).count();
    let line = |kind, words: &str| Line { color: Some(kind), words: format!("{} {words}", of(kind)) };
    vec![
        Line::from(format!("rays that f32 left open, of {}:", tally.counts.lanes)),
        line(BY_F64, "whose sphere f64 found"),
        line(ONLY_T, "whose t f64 found by the longer way"),
        line(BY_INTEGERS, "that integers settled"),
    ]
}

fn frame(canvas: &mut Canvas, lane: &Fallback) {
    let (x, y) = (i64::from(lane.column), i64::from(lane.row));
    for along in -FRAME..=FRAME {
        for (dx, dy) in [(along, -FRAME), (along, FRAME), (-FRAME, along), (FRAME, along)] {
            if let (Ok(x), Ok(y)) = (u32::try_from(x + dx), u32::try_from(y + dy)) {
                canvas.put(x, y, blended([0; 3], color(lane), 208));
            }
        }
    }
}
