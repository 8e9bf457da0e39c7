//! The edges of the 4x4 blocks, and of the tiles that the frame was cut into: those of a plan without tiles are stripes of four rows.

use crate::view::canvas::{Canvas, blended};
use crate::view::text::Line;
use optimized::camera::BLOCK;
use optimized::frame::tile_size;
use optimized::plan::{Packet, Plan};

/// Colour of a tile's edge.
pub const EDGE: [u8; 3] = [0x56, 0xB4, 0xE9];

/// Draws them as a frame of so many workers has them.
pub fn draw(canvas: &mut Canvas, plan: &Plan, workers: usize) -> Vec<Line> {
    let (width, height) = (canvas.size().width(), canvas.size().height());
    let [across, down] = tile_size(plan.packet, height, workers);
    let tiles = plan.packet != Packet::Block;
    for y in 0..height {
        for x in 0..width {
            if tiles && (x % across == 0 || y % down == 0) {
                canvas.put(x, y, EDGE);
            } else if x % BLOCK == 0 || y % BLOCK == 0 {
                canvas.change(x, y, |under| blended(under, [0; 3], 96));
            }
        }
    }
    let blocks = format!("{} x {} blocks of 4x4 rays", width.div_ceil(BLOCK), height.div_ceil(BLOCK));
    let mut lines = vec![Line::from(blocks)];
    if tiles {
        let words = format!("tiles of {across}x{down} pixels for {workers} threads");
        lines.push(Line { color: Some(EDGE), words });
    }
    lines
}
