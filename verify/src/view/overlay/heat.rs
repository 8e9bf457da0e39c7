//! Each packet coloured by what it cost: cells visited, or the part of its candidates that the frustum's planes dropped. Tiles are marked with their
//! numbers. The scale goes from nothing to the frame's dearest packet, and is written beside the picture.

use crate::view::canvas::Canvas;
use crate::view::tally::{Tally, Unit};
use crate::view::text::{self, LINE, Line};
use optimized::plan::{Packet, Plan};

/// From nothing to most: matplotlib's viridis at five points, which every eye tells apart by lightness alone.
const SCALE: [[u8; 3]; 5] =
    [[0x44, 0x01, 0x54], [0x3B, 0x52, 0x8B], [0x21, 0x91, 0x8C], [0x5E, 0xC9, 0x62], [0xFD, 0xE7, 0x25]];
/// Of 256, how much of the picture is covered.
const COVER: u16 = 176;

/// What is shown of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Cells of the grid that it visited.
    Cells,
    /// Of the spheres found in them, per cent that were culled.
    Culled,
}

impl Quantity {
    /// The number of a packet.
    #[must_use]
    pub fn of(self, unit: &Unit) -> u64 {
        let counts = &unit.counts;
        match self {
            Self::Cells => counts.cells,
            Self::Culled => (counts.culled * 100).checked_div(counts.candidates).unwrap_or(0),
        }
    }
}

/// The colour of a part of the scale, 0 to 1.
#[must_use]
pub fn color(part: f64) -> [u8; 3] {
    let steps = (SCALE.len() - 1) as f64;
    let at = (part.clamp(0.0, 1.0) * steps).min(steps - 1e-9);
    let (low, within) = (at as usize, at.fract());
    std::array::from_fn(|i| {
        let [from, to] = [SCALE[low][i], SCALE[low + 1][i]].map(f64::from);
        (from + within * (to - from)).round() as u8
    })
}

/// Draws it.
pub fn draw(canvas: &mut Canvas, tally: &Tally, quantity: Quantity, plan: &Plan) -> Vec<Line> {
    if quantity == Quantity::Culled && plan.packet != Packet::Block {
        let told = "culling: tiles take spheres by their outlines, no plane culls; P has plans of blocks";
        return vec![Line::from(told.to_owned())];
    }
    canvas.dim();
    let most = tally.units.iter().map(|unit| quantity.of(unit)).max().unwrap_or(0);
    for unit in &tally.units {
        let number = quantity.of(unit);
        if number == 0 {
            continue;
        }
        canvas.blend(unit.rect, color(number as f64 / most as f64), COVER);
        let words = number.to_string();
        let room = [unit.rect.x[1] - unit.rect.x[0], unit.rect.y[1] - unit.rect.y[0]];
        if room[0] > text::width(&words) + 4 && room[1] > LINE {
            text::write(canvas, [unit.rect.x[0] + 3, unit.rect.y[0] + 1], &words, [0xFF; 3]);
        }
    }
    let counts = &tally.counts;
    let (packet, packets) = match plan.packet {
        Packet::Block => ("block", "blocks"),
        Packet::Tile { .. } => ("tile", "tiles"),
    };
    let told = match quantity {
        Quantity::Cells => format!("cells visited: {} by {} {packets}", counts.cells, tally.units.len()),
        Quantity::Culled => {
            let part = 100.0 * counts.culled as f64 / counts.candidates.max(1) as f64;
            format!("culled: {} of {} candidates, {part:.1} %", counts.culled, counts.candidates)
        }
    };
    let unit = if quantity == Quantity::Culled { " %" } else { "" };
    let mut lines = vec![Line::from(told)];
    for (step, name) in [(1.0, "most"), (0.5, "half of that")] {
        let words = format!("{}{unit} in a {packet}, {name}", (most as f64 * step).round());
        lines.push(Line { color: Some(color(step)), words });
    }
    lines
}
