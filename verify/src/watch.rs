//! A machine that computes as another one does and tells a [`Listener`] what is visited, met and compared: how accounts, figures and the
//! viewer's overlays see into the tracer without a second one being written.
//!
//! In: what a frame prepared, and the directions of a block. Out: the notes in the order in which things happened, what the packet
//! counted itself, and its answers.

use contract::Scene;
use optimized::camera::Block;
use optimized::host::Scalar;
use optimized::machine::{Chore, LANES, Machine, Site, Stage};
use optimized::seen::{Counts, Seen, Worker};
use std::cell::RefCell;

/// Which part of the work a comparison belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Cull,
    Intersect,
    Other,
}

/// What happened.
#[derive(Clone, Debug)]
pub(crate) enum Note {
    /// A part of the work begins.
    Part(Part),
    /// A cell is come to: number of its slice in the walk, j, k, and whether it is visited.
    Cell { slice: usize, j: i32, k: i32, live: bool },
    /// A sphere is met.
    Sphere(u32),
    /// x < y was asked, or if not `strict` x <= y.
    Compared { strict: bool, x: [f32; LANES], y: [f32; LANES] },
    /// Whether any lane says yes; the lanes that do.
    Any(Site, u32),
}

/// Who is told what a watched machine does; what does not matter to it, it leaves out.
pub trait Listener: Copy {
    /// A part of the work begins.
    fn stage(self, _: Stage) {}
    /// Plain numbers do something beside the lanes.
    fn chore(self, _: Chore) {}
    /// x < y was asked, or if not `strict` x <= y.
    fn compared(self, _strict: bool, _x: [f32; LANES], _y: [f32; LANES]) {}
    /// Whether any lane says yes was asked; the lanes that do.
    fn any(self, _: Site, _lanes: u32) {}
}

/// Computes as `values` does and tells of it.
#[derive(Clone, Copy, Debug)]
pub struct Watch<V, L> {
    /// Who computes.
    pub values: V,
    /// Who is told.
    pub listener: L,
}

/// Notes all.
type Notes<'a> = &'a RefCell<Vec<Note>>;

impl Listener for Notes<'_> {
    fn stage(self, stage: Stage) {
        self.borrow_mut().push(Note::Part(match stage {
            Stage::Cull => Part::Cull,
            Stage::Intersect => Part::Intersect,
            Stage::Voxelize | Stage::Frustum | Stage::Walk | Stage::Shade => Part::Other,
        }));
    }

    fn chore(self, chore: Chore) {
        match chore {
            Chore::Sphere(id) => self.borrow_mut().push(Note::Sphere(id)),
            Chore::Cell { slice, j, k, live } => self.borrow_mut().push(Note::Cell { slice, j, k, live }),
            _ => {}
        }
    }

    fn compared(self, strict: bool, x: [f32; LANES], y: [f32; LANES]) {
        self.borrow_mut().push(Note::Compared { strict, x, y });
    }

    fn any(self, site: Site, lanes: u32) {
        self.borrow_mut().push(Note::Any(site, lanes));
    }
}

/// A block that was traced under watch.
pub(crate) struct Watched {
    /// What happened, in its order.
    pub(crate) notes: Vec<Note>,
    /// What the packet counted itself.
    pub(crate) counts: Counts,
    /// t of each lane.
    pub(crate) t: [f32; LANES],
    /// Id of each lane; [`NONE`](optimized::sphere::NONE) is a miss.
    pub(crate) ids: [i32; LANES],
}

/// Traces the block of those directions, by axis and lane, on the scalar machine.
pub(crate) fn watched(seen: &Seen, scene: &Scene, dir: [[f32; LANES]; 3]) -> Watched {
    let notes = RefCell::new(Vec::new());
    let m = Watch { values: Scalar, listener: &notes };
    let mut worker = Worker::default();
    let answers = seen.trace(m, scene.spheres(), &Block::new(m, dir), None, &mut worker);
    let (t, ids) = (m.to_array(answers.t), m.to_array_i(answers.owners.id));
    Watched { notes: notes.into_inner(), counts: worker.counts, t, ids }
}

macro_rules! same {
    ($($name:ident($($x:ident: $of:ident),*) -> $to:ident;)*) => {
        $(fn $name(self, $($x: Self::$of),*) -> Self::$to {
            self.values.$name($($x),*)
        })*
    };
}

impl<V: Machine, L: Listener> Machine for Watch<V, L> {
    type F = V::F;
    type I = V::I;
    type B = V::B;
    type Spu = Watch<V::Spu, L>;

    fn spu(self) -> Self::Spu {
        Watch { values: self.values.spu(), listener: self.listener }
    }
    fn unit(self) -> f32 {
        self.values.unit()
    }
    fn within<R>(self, work: impl FnOnce() -> R) -> R {
        self.values.within(work)
    }
    fn stage(self, stage: Stage) {
        self.listener.stage(stage);
    }
    fn beside<R>(self, chore: Chore, work: impl FnOnce() -> R) -> R {
        self.listener.chore(chore);
        work()
    }

    fn lanes(self, x: [f32; LANES]) -> Self::F {
        self.values.lanes(x)
    }
    fn lanes_i(self, x: [i32; LANES]) -> Self::I {
        self.values.lanes_i(x)
    }
    fn to_array(self, x: Self::F) -> [f32; LANES] {
        self.values.to_array(x)
    }
    fn to_array_i(self, x: Self::I) -> [i32; LANES] {
        self.values.to_array_i(x)
    }
    fn to_bits(self, x: Self::B) -> u32 {
        self.values.to_bits(x)
    }
    fn splat(self, x: f32) -> Self::F {
        self.values.splat(x)
    }
    fn splat_i(self, x: i32) -> Self::I {
        self.values.splat_i(x)
    }
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        self.listener.compared(true, self.to_array(x), self.to_array(y));
        self.values.lt(x, y)
    }
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        self.listener.compared(false, self.to_array(x), self.to_array(y));
        self.values.le(x, y)
    }
    fn any(self, x: Self::B, site: Site) -> bool {
        self.listener.any(site, self.to_bits(x));
        self.values.any(x, site)
    }
    same! {
        add(x: F, y: F) -> F;
        sub(x: F, y: F) -> F;
        mul(x: F, y: F) -> F;
        div(x: F, y: F) -> F;
        sqrt(x: F) -> F;
        lt_i(x: I, y: I) -> B;
        and(x: B, y: B) -> B;
        or(x: B, y: B) -> B;
        not(x: B) -> B;
        select(choose: B, yes: F, no: F) -> F;
        select_i(choose: B, yes: I, no: I) -> I;
        add_i(x: I, y: I) -> I;
        or_i(x: I, y: I) -> I;
        shl_16(x: I) -> I;
        shr_16(x: I) -> I;
        floor(x: F) -> I;
        truncate(x: F) -> I;
        smallest(x: F) -> F;
        largest(x: F) -> F;
    }
}
