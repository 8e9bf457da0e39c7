//! Sixteen rays against one sphere, where an answer is only given if it is certain: hit, miss, or not decided, and for what
//! may be hit an interval that holds the root.
//!
//! In: the slopes of a packet's rays, spheres relative to the eye with their [`Bound`]. Out: [`Nearest`], of each ray the sphere that
//! is hit first for certain and the lower end of the nearest other one that may be hit. A ray for which the two overlap is *marked*;
//! [`crate::settle`] decides it. The formulas and why they can be trusted stand in [`crate::bound`].
//!
//! Roots are kept as distances along the packet's major axis, t |d_A|: their order is that of t, and they need
//! no division by a ray's length.

use crate::bound::Bound;
use crate::machine::{Machine, Site};
use crate::sphere::NONE;

/// What a packet's rays have in common with all spheres.
#[derive(Clone, Copy)]
pub struct Rays<M: Machine> {
    /// d_Y/|d_A| and d_Z/|d_A|.
    slope: [M::F; 2],
    /// 1 + y² + z².
    a: M::F,
    /// 1 / a.
    inverse: M::F,
}

impl<M: Machine> Rays<M> {
    /// Kernel: of their slopes, at most 1 in magnitude.
    #[inline(always)]
    pub fn new(m: M, slope: [M::F; 2]) -> Self {
        let one = m.splat(1.0);
        let [y, z] = slope;
        let a = m.add(m.add(one, m.mul(y, y)), m.mul(z, z));
        Self { slope, a, inverse: m.div(one, a) }
    }
}

/// Where the eye is, decided in f64 once a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// Outside the sphere: the nearer root counts.
    Outside,
    /// Inside: the farther root counts.
    Inside,
    /// Too close to the surface to tell, or beyond the range of the bound.
    #[default]
    Unknown,
}

/// Kernel: in which lanes the eye is outside its sphere for certain, and in which inside, from the computed squares of the centre's
/// distance and of the radius. The one is off by 5u of itself (the centre's difference counts twice, a product and two sums once), the
/// other by u; 16u of both are granted.
#[inline(always)]
pub fn sides<M: Machine>(m: M, ff: M::F, rr: M::F) -> [M::B; 2] {
    let slack = m.mul(m.add(ff, rr), m.splat(16.0 * m.unit()));
    [m.lt(m.add(rr, slack), ff), m.lt(m.add(ff, slack), rr)]
}

/// A sphere relative to the eye: its centre along (A, Y, Z), r², its bound, the eye's side.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ball {
    /// Centre minus eye.
    pub center: [f32; 3],
    /// r².
    pub rr: f32,
    /// What rounding can do to it.
    pub bound: Bound,
    /// Where the eye is.
    pub side: Side,
}

/// What is known of a ball and sixteen rays.
#[derive(Clone, Copy)]
pub struct Found<M: Machine> {
    /// Not certainly missed.
    pub possible: M::B,
    /// Certainly hit.
    pub certain: M::B,
    /// If hit, then from here
    pub lo: M::F,
    /// to here.
    pub hi: M::F,
}

impl<M: Machine> Rays<M> {
    /// Kernel: what can be said of a ball for the rays `of` a packet; `None` if all of these certainly miss it.
    #[inline(always)]
    pub fn find(&self, m: M, ball: &Ball, of: M::B) -> Option<Found<M>> {
        let [y, z] = self.slope;
        let [ca, cy, cz] = [m.splat(ball.center[0]), m.splat(ball.center[1]), m.splat(ball.center[2])];
        let ey = m.sub(cy, m.mul(y, ca));
        let ez = m.sub(cz, m.mul(z, ca));
        let ex = m.sub(m.mul(ey, z), m.mul(ez, y));
        let square = m.dot([ey, ez, ex], [ey, ez, ex]);
        let discriminant = m.sub(m.mul(self.a, m.splat(ball.rr)), square);
        let (above, below) = (m.splat(ball.bound.hit_above), m.splat(ball.bound.miss_below));
        // A NaN is not below, hence possible.
        let possible = m.and(of, m.not(m.lt(discriminant, below)));
        if !m.any(possible, Site::Sphere) {
            return None;
        }
        if ball.side == Side::Unknown {
            let nowhere = m.lt(above, above);
            return Some(Found { possible, certain: nowhere, lo: m.splat(0.0), hi: m.splat(f32::INFINITY) });
        }
        let zero = m.splat(0.0);
        let middle = m.add(ca, m.mul(m.add(m.mul(y, ey), m.mul(z, ez)), self.inverse));
        let longest = m.mul(m.sqrt(m.max(m.sub(discriminant, below), zero)), self.inverse);
        let shortest = m.mul(m.sqrt(m.max(m.sub(discriminant, above), zero)), self.inverse);
        let [lo, hi] = if ball.side == Side::Outside {
            [m.sub(middle, longest), m.sub(middle, shortest)]
        } else {
            [m.add(middle, shortest), m.add(middle, longest)]
        };
        let (lo, hi) = (m.sub(lo, m.splat(ball.bound.root)), m.add(hi, m.splat(ball.bound.root)));
        let behind = m.lt(hi, zero);
        Some(Found {
            possible: m.and(possible, m.not(behind)),
            certain: m.and(m.lt(above, discriminant), m.lt(zero, lo)),
            lo,
            hi,
        })
    }
}

/// Of each ray what is nearest so far, and what may be nearer.
#[derive(Clone, Copy)]
pub struct Nearest<M: Machine> {
    /// The sphere that is certainly hit, whose root has the lowest upper end; [`NONE`] at first.
    pub id: M::I,
    /// Lower end of its root.
    pub lo: M::F,
    /// Upper end, +∞ at first.
    pub hi: M::F,
    /// The lowest lower end of all others that may be hit, +∞ at first.
    pub rival: M::F,
}

impl<M: Machine> Nearest<M> {
    /// Nothing yet.
    #[inline(always)]
    pub fn none(m: M) -> Self {
        let far = m.splat(f32::INFINITY);
        Self { id: m.splat_i(NONE), lo: far, hi: far, rival: far }
    }

    /// Kernel: takes a sphere into account, in whatever order they come and however often.
    #[inline(always)]
    pub fn meet(self, m: M, found: &Found<M>, id: i32) -> Self {
        let id = m.splat_i(id);
        let other = m.or(m.lt_i(id, self.id), m.lt_i(self.id, id));
        let counts = m.and(found.possible, other);
        let wins = m.and(m.and(counts, found.certain), m.lt(found.hi, self.hi));
        let loser = m.select(wins, self.lo, found.lo);
        Self {
            id: m.select_i(wins, id, self.id),
            lo: m.select(wins, found.lo, self.lo),
            hi: m.select(wins, found.hi, self.hi),
            rival: m.select(m.and(counts, m.lt(loser, self.rival)), loser, self.rival),
        }
    }

    /// Kernel: rays whose nearest sphere is not certain.
    #[inline(always)]
    pub fn marked(&self, m: M) -> M::B {
        m.and(m.le(self.rival, self.hi), m.lt(self.rival, m.splat(f32::INFINITY)))
    }
}
