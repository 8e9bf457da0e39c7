//! From the camera to a block: the directions of its 4x4 rays, by rule 1 of the contract, bit for bit.
//! Lane 4 j + i is column i, row j of the block.

use crate::machine::{LANES, Machine, three};
use contract::Camera;

/// Side of a block in pixels (the paper's packet).
pub const BLOCK: u32 = 4;

/// The rays of one block. They start at the eye, which is not kept: everything is seen from there.
#[derive(Clone, Copy)]
pub struct Block<M: Machine> {
    /// Directions, as the contract gives them.
    pub dir: [M::F; 3],
    /// 1 / d·d.
    pub inv_dd: M::F,
    /// d·d.
    pub dd: M::F,
}

/// A camera spread over lanes once a frame.
#[derive(Clone, Copy)]
pub struct CameraLanes<M: Machine> {
    corner: [M::F; 3],
    du: [M::F; 3],
    dv: [M::F; 3],
}

impl<M: Machine> CameraLanes<M> {
    /// Spreads a camera.
    #[inline(always)]
    pub fn new(m: M, camera: &Camera) -> Self {
        Self { corner: spread(m, camera.corner()), du: spread(m, camera.du()), dv: spread(m, camera.dv()) }
    }

    /// Kernel: the directions through the pixels whose middles are (x, y).
    #[inline(always)]
    pub fn directions(&self, m: M, x: M::F, y: M::F) -> [M::F; 3] {
        three(
            [0, 1, 2],
            #[inline(always)]
            |i| m.add(m.add(self.corner[i], m.mul(x, self.du[i])), m.mul(y, self.dv[i])),
        )
    }

    /// Kernel: the rays through them.
    #[inline(always)]
    pub fn block(&self, m: M, x: M::F, y: M::F) -> Block<M> {
        Block::new(m, self.directions(m, x, y))
    }
}

impl<M: Machine> Block<M> {
    /// Kernel: a block of given directions.
    #[inline(always)]
    pub fn new(m: M, dir: [M::F; 3]) -> Self {
        let dd = m.dot(dir, dir);
        Self { dir, inv_dd: m.div(m.splat(1.0), dd), dd }
    }
}

/// A vector, the same in all lanes.
#[inline(always)]
pub fn spread<M: Machine>(m: M, v: [f32; 3]) -> [M::F; 3] {
    three(
        v,
        #[inline(always)]
        |x| m.splat(x),
    )
}

/// Rim: the middles of the pixels of the block whose first pixel is (x, y). Pixels beyond the image repeat
/// its last column or row.
#[inline(always)]
#[allow(clippy::cast_precision_loss, reason = "pixel indices are below 2^14, exact in f32")]
pub fn middles<M: Machine>(m: M, camera: &Camera, x: u32, y: u32) -> (M::F, M::F) {
    let size = camera.size();
    let column = |lane: u32| (x + lane % BLOCK).min(size.width() - 1) as f32 + 0.5;
    let row = |lane: u32| (y + lane / BLOCK).min(size.height() - 1) as f32 + 0.5;
    let mut ys = [0.0; LANES];
    for (lane, y) in (0..).zip(&mut ys) {
        *y = row(lane);
    }
    (m.lanes_of_four([column(0), column(1), column(2), column(3)]), m.lanes(ys))
}
