//! What executes a kernel: sixteen lanes of f32, of i32 and of yes/no, and the few operations on them.
//!
//! A kernel takes a [`Machine`] first, then lanes, and gives lanes; it never touches memory. So the same
//! source runs on host SIMD, on a model that counts cycles, and on symbols that a solver reads. Every f32
//! operation is one IEEE 754 operation rounded to nearest, ties to even, with subnormal numbers, in each lane.
//! There is no fused operation, no estimate, and no sum over lanes.
//!
//! Data steers control flow by two doors only, [`Machine::any`] and [`Machine::again`]; each names its
//! [`Site`]. The *rim* (`lanes…`, `to_…`) is where values enter and leave; only what calls kernels uses it.
//!
//! What is done by plain numbers beside the lanes, a machine would not see. One that counts is told: [`Machine::stage`] which part
//! of a frame is under way, [`Machine::branch`] where plain numbers decide, [`Machine::beside`] what else they do. On the host
//! these are nothing at all.

/// Lanes of a machine: the rays of a 4x4 block, or sixteen slices of a grid.
pub const LANES: usize = 16;

/// The same done to each of three. Kernels use this and plain loops in place of the standard library's `map`, `fold` and
/// `for_each`: these may stay calls, and what they call is then compiled without the machine's instructions.
#[inline(always)]
pub fn three<A, B>(x: [A; 3], mut f: impl FnMut(A) -> B) -> [B; 3] {
    let [x, y, z] = x;
    [f(x), f(y), f(z)]
}

/// A place where data decides what is executed next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Site {
    /// Do the block's rays lack a common major axis and sign?
    Incoherent,
    /// Does any ray of the block come within the sphere's radius?
    Sphere,
    /// Can the sphere still win for any ray?
    Ahead,
    /// Can a later slice still win for any ray?
    Unfinished,
    /// Does the sphere lie outside any plane of the frustum?
    Culled,
    /// Is there another cell? (The one branch of the flattened loop.)
    NextCell,
    /// Has the slice no cell? (Of the nested loops, as are the next three.)
    EmptySlice,
    /// Is there another cell on the third axis?
    NextK,
    /// Is there another row of cells on the second axis?
    NextJ,
    /// Is there another slice?
    NextSlice,
    /// Does the cell list no sphere?
    EmptyCell,
    /// Does it list another?
    NextId,
    /// Is there another sphere that a ray of the block hit?
    NextOwner,
    /// Is there another sphere to be put into cells?
    NextSphere,
}

/// A part of a frame's work, by which a machine that counts keeps its tally.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// The grid is built.
    Voxelize,
    /// Rays are made and bounded, and the cells of each slice found.
    Frustum,
    /// From cell to cell, and from sphere to sphere of a cell.
    Walk,
    /// A sphere is held against the planes.
    Cull,
    /// Rays are intersected with a sphere.
    Intersect,
    /// Colours are found and written.
    Shade,
}

/// What plain numbers do beside the lanes, of which a machine that counts must be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Chore {
    /// Sixteen spheres are read, seen from the eye, and boxed.
    Boxes,
    /// So many quadwords of cells are emptied.
    Clear(usize),
    /// An id is pushed onto the queues of so many cells.
    Push(usize),
    /// A cell's list is counted one longer, or an id is put into it.
    Entry,
    /// A packet begins.
    Packet,
    /// The distances of so many slices from the eye are found.
    Distances(usize),
    /// The rectangle of a slice is read.
    Rectangle,
    /// The place of a cell is found, and what it lists is read.
    Cell {
        /// Number of its slice in the walk.
        slice: usize,
        /// Cell on the second axis.
        j: i32,
        /// Cell on the third axis.
        k: i32,
        /// Whether it is visited: see [`Visitor::visit`](crate::walk::Visitor::visit).
        live: bool,
    },
    /// An id is taken from what a cell lists, and its sphere read and spread over lanes.
    Sphere(u32),
    /// What a form needs of a sphere beside its centre is found.
    Invariants,
    /// What a colour needs of a sphere is read and spread over lanes.
    Owner,
    /// Sixteen colours are packed.
    Pixels,
    /// What follows, until the next such note, are answers of the block whose first pixel is (x, y). It costs nothing.
    Block([u32; 2]),
    /// Lanes of the block that f32 or the short way to t left open are settled ([`crate::settle`]): bit i is lane i. It costs nothing, since
    /// whoever counts has counted it already.
    Settled {
        /// Marked by f32, so that f64 was asked which sphere they hit.
        marked: u32,
        /// Of known spheres, so that f64 was asked for t by the longer way.
        only_t: u32,
        /// Of both, those for which integers were asked too, for the sphere or for the rounding of t.
        integers: u32,
    },
}

/// Sixteen lanes and what can be done with them.
pub trait Machine: Copy {
    /// Sixteen f32.
    type F: Copy;
    /// Sixteen i32.
    type I: Copy;
    /// Sixteen times yes or no.
    type B: Copy;
    /// Who does the SPU's arithmetic (contract, rule 6) beside this machine: a machine whose f32 are the SPU's numbers.
    type Spu: Machine;

    /// That machine.
    fn spu(self) -> Self::Spu;

    /// Unit roundoff, a constant: what an f32 operation gives is off by at most so much of itself. Margins of kernels are multiples of it.
    #[inline(always)]
    fn unit(self) -> f32 {
        1.0 / (1u32 << 24) as f32
    }

    /// Rim: does work with this machine's instructions enabled, the one door into them. Everything below it is
    /// inlined into it.
    #[inline(always)]
    fn within<R>(self, work: impl FnOnce() -> R) -> R {
        work()
    }
    /// Note: what follows belongs to that part of a frame.
    #[inline(always)]
    fn stage(self, _: Stage) {}
    /// Note: plain numbers decide here, as they do at once.
    #[inline(always)]
    fn branch(self, taken: bool, _: Site) -> bool {
        taken
    }
    /// Note: does work that belongs to a chore, rim and all.
    #[inline(always)]
    fn beside<R>(self, _: Chore, work: impl FnOnce() -> R) -> R {
        work()
    }

    /// Rim: lanes from an array.
    fn lanes(self, x: [f32; LANES]) -> Self::F;
    /// Rim: four numbers, again and again.
    #[inline(always)]
    fn lanes_of_four(self, [a, b, c, d]: [f32; 4]) -> Self::F {
        self.lanes([a, b, c, d, a, b, c, d, a, b, c, d, a, b, c, d])
    }
    /// Rim: the first lane.
    #[inline(always)]
    fn first(self, x: Self::F) -> f32 {
        self.to_array(x)[0]
    }
    /// Rim: the first lane.
    #[inline(always)]
    fn first_i(self, x: Self::I) -> i32 {
        self.to_array_i(x)[0]
    }
    /// Rim: lanes from an array.
    fn lanes_i(self, x: [i32; LANES]) -> Self::I;
    /// Rim: an array from lanes.
    fn to_array(self, x: Self::F) -> [f32; LANES];
    /// Rim: an array from lanes.
    fn to_array_i(self, x: Self::I) -> [i32; LANES];

    /// Rim: bit i is lane i.
    fn to_bits(self, x: Self::B) -> u32;

    /// The same number in every lane.
    fn splat(self, x: f32) -> Self::F;
    /// The same number in every lane.
    fn splat_i(self, x: i32) -> Self::I;

    /// x + y.
    fn add(self, x: Self::F, y: Self::F) -> Self::F;
    /// x − y.
    fn sub(self, x: Self::F, y: Self::F) -> Self::F;
    /// x y.
    fn mul(self, x: Self::F, y: Self::F) -> Self::F;
    /// x / y.
    fn div(self, x: Self::F, y: Self::F) -> Self::F;
    /// √x, NaN below zero.
    fn sqrt(self, x: Self::F) -> Self::F;

    /// x < y; no if either is NaN.
    fn lt(self, x: Self::F, y: Self::F) -> Self::B;
    /// x <= y; no if either is NaN.
    fn le(self, x: Self::F, y: Self::F) -> Self::B;
    /// x < y.
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B;
    /// Both.
    fn and(self, x: Self::B, y: Self::B) -> Self::B;
    /// Either or both.
    fn or(self, x: Self::B, y: Self::B) -> Self::B;
    /// The opposite.
    fn not(self, x: Self::B) -> Self::B;
    /// `yes` where `choose`, else `no`.
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F;
    /// `yes` where `choose`, else `no`.
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I;

    /// x + y, modulo 2³².
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I;
    /// Bits of either.
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I;
    /// x times 2¹⁶, modulo 2³².
    fn shl_16(self, x: Self::I) -> Self::I;
    /// The upper 16 bits of x.
    fn shr_16(self, x: Self::I) -> Self::I;
    /// The largest integer not above x, saturated to i32; 0 for NaN.
    fn floor(self, x: Self::F) -> Self::I;
    /// x cut off towards zero, saturated to i32; 0 for NaN.
    fn truncate(self, x: Self::F) -> Self::I;

    /// The smallest lane, in every lane. No lane may be NaN. If both zeros are smallest, either is given.
    fn smallest(self, x: Self::F) -> Self::F;
    /// The largest lane, in every lane. No lane may be NaN. If both zeros are largest, either is given.
    fn largest(self, x: Self::F) -> Self::F;

    /// Door: is any lane yes? A machine without a hint takes not taken for the likely way; which one is likely differs from site to
    /// site (`cgt spu` counts them).
    fn any(self, x: Self::B, site: Site) -> bool;

    /// Door: go round the loop again, since any lane says so? Mostly yes, so taken is the likely way.
    #[inline(always)]
    fn again(self, x: Self::B, site: Site) -> bool {
        self.any(x, site)
    }

    /// −x, by an operation that is exact for every x.
    #[inline(always)]
    fn neg(self, x: Self::F) -> Self::F {
        self.sub(self.splat(-0.0), x)
    }

    /// The lesser; y if either is NaN.
    #[inline(always)]
    fn min(self, x: Self::F, y: Self::F) -> Self::F {
        self.select(self.lt(x, y), x, y)
    }

    /// The greater; y if either is NaN.
    #[inline(always)]
    fn max(self, x: Self::F, y: Self::F) -> Self::F {
        self.select(self.lt(y, x), x, y)
    }

    /// (u·v) summed as the contract sums it: `(x + y) + z`.
    #[inline(always)]
    fn dot(self, u: [Self::F; 3], v: [Self::F; 3]) -> Self::F {
        let [x, y, z] = three(
            [0, 1, 2],
            #[inline(always)]
            |i| self.mul(u[i], v[i]),
        );
        self.add(self.add(x, y), z)
    }
}
