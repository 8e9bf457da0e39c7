//! Sixteen rays against one sphere, in the two f32 forms of the contract (rule 5), bit for bit, and the
//! nearest hit so far. (The truth is asked for in [`crate::certain`].)
//!
//! All rays of a frame start at one eye, so what depends on the sphere and the eye alone is made once a frame
//! ([`Prepared`]): f = eye − c, r², and for the textbook form q = f·f − r². The operations and their order are
//! the contract's; only who performs them, and how often, differs.

use crate::camera::Block;
use crate::machine::{Machine, Site, three};
use contract::Sphere;

/// The f32 forms of the contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// b² − a q.
    Textbook,
    /// r² minus the squared distance of the centre from the ray.
    Perpendicular,
}

/// A sphere as seen from the eye.
#[derive(Clone, Copy, Debug, Default)]
pub struct Prepared {
    /// eye − centre.
    pub f: [f32; 3],
    /// r².
    pub rr: f32,
    /// f·f − r².
    pub q: f32,
    /// The radius that culling goes by ([`crate::cull::radius`]); the sphere's own until that is known.
    pub cull_radius: f32,
}

impl Prepared {
    /// What the forms need of a sphere, seen from `eye`.
    #[must_use]
    pub fn new(eye: [f32; 3], sphere: &Sphere) -> Self {
        let f = [0, 1, 2].map(|i| eye[i] - sphere.center[i]);
        let rr = sphere.radius * sphere.radius;
        let ff = (f[0] * f[0] + f[1] * f[1]) + f[2] * f[2];
        Self { f, rr, q: ff - rr, cull_radius: sphere.radius }
    }
}

impl Prepared {
    /// The same by a machine's own arithmetic.
    #[inline(always)]
    #[must_use]
    pub fn on<M: Machine>(m: M, eye: [f32; 3], sphere: &Sphere) -> Self {
        let f = three(
            [0, 1, 2],
            #[inline(always)]
            |i| m.sub(m.splat(eye[i]), m.splat(sphere.center[i])),
        );
        let rr = m.mul(m.splat(sphere.radius), m.splat(sphere.radius));
        let q = m.sub(m.dot(f, f), rr);
        let f = three(
            f,
            #[inline(always)]
            |x| m.to_array(x)[0],
        );
        Self { f, rr: m.to_array(rr)[0], q: m.to_array(q)[0], cull_radius: sphere.radius }
    }
}

/// The nearest hit of each ray so far.
#[derive(Clone, Copy)]
pub struct Nearest<M: Machine> {
    /// Ray parameter, +∞ at first.
    pub t: M::F,
    /// Sphere, [`NONE`] at first.
    pub id: M::I,
}

/// No sphere yet: above every id.
pub const NONE: i32 = i32::MAX;

impl<M: Machine> Nearest<M> {
    /// Nothing hit yet.
    #[inline(always)]
    pub fn none(m: M) -> Self {
        Self { t: m.splat(f32::INFINITY), id: m.splat_i(NONE) }
    }

    /// Kernel: takes a sphere into account. Where two t are equal the lower id stays, in whatever order the
    /// spheres come and however often.
    #[inline(always)]
    pub fn meet(self, m: M, form: Form, block: &Block<M>, sphere: &Prepared, id: i32) -> Self {
        let f = three(
            sphere.f,
            #[inline(always)]
            |x| m.splat(x),
        );
        match form {
            Form::Textbook => self.textbook(m, block, f, m.splat(sphere.q), id),
            Form::Perpendicular => self.perpendicular(m, block, f, m.splat(sphere.rr), id),
        }
    }

    #[inline(always)]
    fn textbook(self, m: M, block: &Block<M>, f: [M::F; 3], q: M::F, id: i32) -> Self {
        let b = m.dot(f, block.dir);
        let discriminant = m.sub(m.mul(b, b), m.mul(block.dd, q));
        let within = m.le(m.splat(0.0), discriminant);
        if !m.any(within, Site::Sphere) {
            return self;
        }
        let (s, minus_b) = (m.sqrt(discriminant), m.neg(b));
        let near = m.div(m.sub(minus_b, s), block.dd);
        let far = m.div(m.add(minus_b, s), block.dd);
        self.closer(m, within, near, far, id)
    }

    #[inline(always)]
    fn perpendicular(self, m: M, block: &Block<M>, f: [M::F; 3], rr: M::F, id: i32) -> Self {
        let h = m.mul(m.dot(f, block.dir), block.inv_dd);
        let l = three(
            [0, 1, 2],
            #[inline(always)]
            |i| m.sub(f[i], m.mul(h, block.dir[i])),
        );
        let discriminant = m.sub(rr, m.dot(l, l));
        let within = m.le(m.splat(0.0), discriminant);
        if !m.any(within, Site::Sphere) {
            return self;
        }
        let (s, minus_h) = (m.sqrt(m.mul(discriminant, block.inv_dd)), m.neg(h));
        self.closer(m, within, m.sub(minus_h, s), m.add(minus_h, s), id)
    }

    #[inline(always)]
    fn closer(self, m: M, within: M::B, near: M::F, far: M::F, id: i32) -> Self {
        let (zero, id) = (m.splat(0.0), m.splat_i(id));
        let t = m.select(m.lt(zero, near), near, far);
        let hit = m.and(within, m.lt(zero, t));
        let first = m.or(m.lt(t, self.t), m.lt_i(id, self.id));
        let wins = m.and(hit, m.and(m.le(t, self.t), first));
        Self { t: m.select(wins, t, self.t), id: m.select_i(wins, id, self.id) }
    }
}
