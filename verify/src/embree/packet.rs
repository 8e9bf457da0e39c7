//! Rays and hits as Embree lays them out, for 1, 4, 8 and 16 lanes: one structure of arrays, since a lane's order of
//! fields is the same in all four.
//!
//! The headers that `embree4-sys` carries are those of 4.2. From 4.3 on a hit has one more field (`instPrimID`, a
//! word a lane), which the library writes on every hit, past the end of the older structure. So a packet has room for
//! it (`spare`), guard words behind that, and the alignment of the widest: the library loads packets and masks with
//! aligned instructions. That all other fields lie where the headers have them is asserted while compiling.

use super::error::EmbreeError;
use super::fault::Fault;
use super::tracer::Width;
use contract::MISS;
use embree4_sys::{RTCRayHit, RTCRayHit4, RTCRayHit8, RTCRayHit16};
use reference::Ray;
use std::mem::offset_of;

/// Words behind the structure that must stay as they are: more than any version has added.
const GUARDS: usize = 32;
/// What stands in them.
const GUARD: u32 = 0xfeed_c0de;
/// The geometry of a ray that hit nothing.
pub(super) const NO_GEOMETRY: u32 = u32::MAX;
/// Words a lane that versions after 4.2 have added.
pub(super) const GROWTH: usize = 1;

/// `W` rays and their hits, with `S` spare words a lane.
#[repr(C, align(64))]
#[derive(Clone, Debug)]
pub(super) struct Packet<const W: usize, const S: usize> {
    org: [[f32; W]; 3],
    tnear: [f32; W],
    dir: [[f32; W]; 3],
    time: [f32; W],
    tfar: [f32; W],
    mask: [u32; W],
    id: [u32; W],
    flags: [u32; W],
    normal: [[f32; W]; 3],
    uv: [[f32; W]; 2],
    prim: [u32; W],
    geom: [u32; W],
    inst: [u32; W],
    spare: [[u32; W]; S],
    guards: [u32; GUARDS],
}

/// Which lanes are to be traced: -1 yes, 0 no.
#[repr(C, align(64))]
#[derive(Clone, Debug)]
pub(super) struct Valid<const W: usize>(pub(super) [i32; W]);

impl<const W: usize, const S: usize> Packet<W, S> {
    pub(super) fn new() -> Self {
        Self {
            org: [[0.0; W]; 3],
            tnear: [f32::MIN_POSITIVE; W],
            dir: [[0.0; W]; 3],
            time: [0.0; W],
            tfar: [f32::INFINITY; W],
            mask: [u32::MAX; W],
            id: [0; W],
            flags: [0; W],
            normal: [[0.0; W]; 3],
            uv: [[0.0; W]; 2],
            prim: [NO_GEOMETRY; W],
            geom: [NO_GEOMETRY; W],
            inst: [NO_GEOMETRY; W],
            spare: [[GUARD; W]; S],
            guards: [GUARD; GUARDS],
        }
    }

    /// Puts a ray into a lane and forgets what was found there. t counts from the least normal number on, since t > 0
    /// is asked for and Embree takes t >= tnear; what is smaller it would flush to zero.
    pub(super) fn set(&mut self, lane: usize, ray: &Ray, fault: Fault) {
        for i in 0..3 {
            (self.org[i][lane], self.dir[i][lane]) = (ray.eye[i], ray.dir[i]);
        }
        self.mask[lane] = if fault == Fault::MaskDropped { 0 } else { u32::MAX };
        if fault != Fault::LimitKept {
            self.tfar[lane] = f32::INFINITY;
        }
        if fault != Fault::IdKept {
            self.geom[lane] = NO_GEOMETRY;
        }
    }

    /// A packet of rays from one eye.
    pub(super) fn from_eye(eye: [f32; 3]) -> Self {
        Self { org: eye.map(|x| [x; W]), ..Self::new() }
    }

    /// Gives all rays a direction and forgets what was found. No fault is planted here.
    #[inline]
    pub(super) fn aim(&mut self, dir: &[[f32; W]; 3]) {
        self.dir = *dir;
        self.tfar = [f32::INFINITY; W];
        self.prim = [MISS; W];
        self.geom = [NO_GEOMETRY; W];
    }

    /// Ids and t of all lanes since [`aim`](Self::aim): a miss is [`MISS`] and +∞.
    #[inline]
    pub(super) fn found(&self) -> (&[u32; W], &[f32; W]) {
        (&self.prim, &self.tfar)
    }

    /// Id and t of the sphere that a lane hit.
    pub(super) fn hit(&self, lane: usize) -> Option<(u32, f32)> {
        (self.geom[lane] != NO_GEOMETRY).then(|| (self.prim[lane], self.tfar[lane]))
    }

    /// Whether the field that 4.3 added was written to in a lane.
    pub(super) fn grew(&self, lane: usize) -> bool {
        self.spare.iter().any(|words| words[lane] != GUARD)
    }

    /// Whether the library kept to its structure.
    pub(super) fn check(&self, width: Width) -> Result<(), EmbreeError> {
        match self.guards.iter().position(|&word| word != GUARD) {
            None => Ok(()),
            Some(word) => Err(EmbreeError::Overrun { width, word, value: self.guards[word] }),
        }
    }
}

/// Holds the layout of a packet against a structure of the headers.
macro_rules! laid_out_as {
    ($lanes:literal, $both:ty) => {
        const _: () = {
            type Ours = Packet<$lanes, GROWTH>;
            assert!(offset_of!(Ours, org) == offset_of!($both, ray.org_x));
            assert!(offset_of!(Ours, tnear) == offset_of!($both, ray.tnear));
            assert!(offset_of!(Ours, dir) == offset_of!($both, ray.dir_x));
            assert!(offset_of!(Ours, time) == offset_of!($both, ray.time));
            assert!(offset_of!(Ours, tfar) == offset_of!($both, ray.tfar));
            assert!(offset_of!(Ours, mask) == offset_of!($both, ray.mask));
            assert!(offset_of!(Ours, id) == offset_of!($both, ray.id));
            assert!(offset_of!(Ours, flags) == offset_of!($both, ray.flags));
            assert!(offset_of!(Ours, normal) == offset_of!($both, hit.Ng_x));
            assert!(offset_of!(Ours, uv) == offset_of!($both, hit.u));
            assert!(offset_of!(Ours, prim) == offset_of!($both, hit.primID));
            assert!(offset_of!(Ours, geom) == offset_of!($both, hit.geomID));
            assert!(offset_of!(Ours, inst) == offset_of!($both, hit.instID));
            assert!(offset_of!(Ours, spare) == size_of::<$both>());
            assert!(offset_of!(Ours, guards) >= size_of::<$both>() + 4 * $lanes * GROWTH);
            assert!(align_of::<Ours>() >= align_of::<$both>() && align_of::<Ours>() >= 4 * $lanes);
            assert!(align_of::<Valid<$lanes>>() >= 4 * $lanes);
        };
    };
}
laid_out_as!(1, RTCRayHit);
laid_out_as!(4, RTCRayHit4);
laid_out_as!(8, RTCRayHit8);
laid_out_as!(16, RTCRayHit16);
