//! Sixteen colours, by rule 4 of the contract, bit for bit.

use crate::machine::{Machine, three};
use contract::{AMBIENT, DIFFUSE};

/// What each ray hit: sphere data gathered by the caller, lane by lane.
#[derive(Clone, Copy)]
pub struct Surface<M: Machine> {
    /// Centre of the sphere.
    pub center: [M::F; 3],
    /// Its radius.
    pub radius: M::F,
    /// Its colour, 0 to 255.
    pub color: [M::F; 3],
}

/// Kernel: red, green, blue, 0 to 255 each, for rays that hit; meaningless for rays that do not.
#[inline(always)]
pub fn shade<M: Machine>(
    m: M,
    eye: [M::F; 3],
    dir: [M::F; 3],
    light: [M::F; 3],
    t: M::F,
    surface: &Surface<M>,
) -> [M::I; 3] {
    let normal = three(
        [0, 1, 2],
        #[inline(always)]
        |i| m.sub(m.add(eye[i], m.mul(t, dir[i])), surface.center[i]),
    );
    let cosine = m.div(m.dot(normal, light), surface.radius);
    let s = m.add(m.splat(AMBIENT), m.mul(m.splat(DIFFUSE), cosine));
    let s = m.max(s, m.splat(0.0));
    let s = m.min(s, m.splat(1.0));
    three(
        surface.color,
        #[inline(always)]
        |channel| m.truncate(m.add(m.mul(channel, s), m.splat(0.5))),
    )
}
