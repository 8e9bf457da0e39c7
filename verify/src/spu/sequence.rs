//! What each operation of a [`Machine`](optimized::machine::Machine), and each [`Chore`], is in instructions.
//!
//! An operation on sixteen lanes is its sequence on four quadwords, instruction by instruction; on lanes that are all alike, or
//! four numbers again and again, it is its sequence on one. [`TABLE`] has them all.
//!
//! *Division and square root* are an estimate (`frest`, `frsqest`) with `fi`, and one Newton step:
//! y ≈ 1/b, q = a y, q + y (a − q b); and y ≈ 1/√x, s = x y, s + (y/2)(x − s²). Either chain takes
//! 4 + 7 + 6 + 6 + 6 = 29 cycles, which is that of GCC's inline square root.
//!
//! *Compares.* The SPU has no NaN, so x <= y is "not x > y". *Rounding down* is cutting off, and one less where that is above.
//!
//! *Nothing is fused*, as the kernels fuse nothing; a compiler that may fuse a product and a sum saves up to one even instruction
//! for each product, by which both bounds err high. *Constants* lie in registers and cost nothing, by which both err low. *A scalar*
//! lies in its preferred slot; one that comes from memory is spread by a shuffle, which belongs to the chore that fetches it.

use super::isa::Op::{self, *};
use optimized::machine::Chore;

/// Whence an instruction has an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// The operation's own, first or second or third.
    In(usize),
    /// The result of an instruction before.
    Step(usize),
}

use Operand::{In, Step};

/// An instruction and its operands that may have to be waited for.
pub type Instruction = (Op, &'static [Operand]);

/// Instructions in their order. The last one's result is that of the whole.
pub type Sequence = &'static [Instruction];

const TWO: &[Operand] = &[In(0), In(1)];

/// x + y.
pub const ADD: Sequence = &[(Fa, TWO)];
/// x − y.
pub const SUB: Sequence = &[(Fs, TWO)];
/// x y.
pub const MUL: Sequence = &[(Fm, TWO)];
/// x / y.
pub const DIV: Sequence = &[
    (Frest, &[In(1)]),
    (Fi, &[In(1), Step(0)]),
    (Fm, &[In(0), Step(1)]),
    (Fnms, &[Step(2), In(1), In(0)]),
    (Fma, &[Step(3), Step(1), Step(2)]),
];
/// √x.
pub const SQRT: Sequence = &[
    (Frsqest, &[In(0)]),
    (Fi, &[In(0), Step(0)]),
    (Fm, &[In(0), Step(1)]),
    (Fm, &[Step(1)]),
    (Fnms, &[Step(2), In(0)]),
    (Fma, &[Step(4), Step(3), Step(2)]),
];
/// −x.
pub const NEG: Sequence = &[(Xor, &[In(0)])];
/// x < y.
pub const LT: Sequence = &[(Fcgt, TWO)];
/// x <= y.
pub const LE: Sequence = &[(Fcgt, TWO), (Nor, &[Step(0)])];
/// x < y, integers.
pub const LT_I: Sequence = &[(Cgt, TWO)];
/// Both.
pub const AND: Sequence = &[(And, TWO)];
/// Either.
pub const OR: Sequence = &[(Or, TWO)];
/// The opposite.
pub const NOT: Sequence = &[(Nor, &[In(0)])];
/// One or the other.
pub const SELECT: Sequence = &[(Selb, &[In(0), In(1), In(2)])];
/// x + y, integers.
pub const ADD_I: Sequence = &[(A, TWO)];
/// Times 2¹⁶.
pub const SHL_16: Sequence = &[(Shl, &[In(0)])];
/// The upper half.
pub const SHR_16: Sequence = &[(Rotm, &[In(0)])];
/// Down to an integer.
pub const FLOOR: Sequence =
    &[(Cflts, &[In(0)]), (Csflt, &[Step(0)]), (Fcgt, &[Step(1), In(0)]), (A, &[Step(0), Step(2)])];
/// Towards zero to an integer.
pub const TRUNCATE: Sequence = &[(Cflts, &[In(0)])];
/// The lesser or the greater.
pub const LESSER: Sequence = &[(Fcgt, TWO), (Selb, &[Step(0), In(0), In(1)])];
/// The least or greatest of a quadword, in all of it.
pub const LEAST: Sequence = &[
    (Rotqby, &[In(0)]),
    (Fcgt, &[In(0), Step(0)]),
    (Selb, &[Step(1), In(0), Step(0)]),
    (Rotqby, &[Step(2)]),
    (Fcgt, &[Step(2), Step(3)]),
    (Selb, &[Step(4), Step(2), Step(3)]),
];
/// The low bits of a quadword's words, side by side.
pub const GATHER: Sequence = &[(Gb, &[In(0)])];
/// One of three quadwords' bits beside those of the first.
pub const JOIN: Sequence = &[(Shl, &[In(0)]), (Or, &[Step(0), In(1)])];
/// Operand memory.
pub const LOAD: Sequence = &[(Lqx, &[In(0)])];
/// To memory.
pub const STORE: Sequence = &[(Stqx, &[In(0)])];
/// Four scalars in one quadword.
pub const FOUR: Sequence = &[(Shufb, &[In(0)]), (Shufb, &[In(0)]), (Shufb, &[Step(0), Step(1)])];
/// A loop's counter, its end, and the branch.
pub const COUNT_AND_BRANCH: Sequence = &[(A, &[]), (Cgt, &[Step(0), In(0)]), (Brnz, &[Step(1)])];
/// A branch by what was gathered.
pub const BRANCH: Sequence = &[(Gb, &[In(0)]), (Brnz, &[Step(0)])];

/// Each operation with its sequence on a quadword.
pub const TABLE: [(&str, Sequence); 27] = [
    ("add", ADD),
    ("sub", SUB),
    ("mul", MUL),
    ("div", DIV),
    ("sqrt", SQRT),
    ("neg", NEG),
    ("lt", LT),
    ("le", LE),
    ("lt_i", LT_I),
    ("and", AND),
    ("or, or_i", OR),
    ("not", NOT),
    ("select, select_i", SELECT),
    ("add_i", ADD_I),
    ("shl_16", SHL_16),
    ("shr_16", SHR_16),
    ("floor", FLOOR),
    ("truncate", TRUNCATE),
    ("min, max; smallest, largest: of two quadwords, three times", LESSER),
    ("smallest, largest: of the quadword left", LEAST),
    ("to_bits: each quadword", GATHER),
    ("to_bits: quadwords together, three times", JOIN),
    ("lanes, lanes_i: each quadword", LOAD),
    ("to_array, to_array_i: each quadword", STORE),
    ("lanes_of_four", FOUR),
    ("branch", COUNT_AND_BRANCH),
    ("any, again: after `or` of quadwords, three times", BRANCH),
];

/// Four of sixteen spheres: read, moved to the eye's place, written back; turned from x y z r into four of each; boxed; the box of
/// all boxes widened.
const BOXES: Sequence = &[
    (Lqx, &[]),
    (Lqx, &[]),
    (Lqx, &[]),
    (Lqx, &[]),
    (Fs, &[Step(0)]),
    (Fs, &[Step(1)]),
    (Fs, &[Step(2)]),
    (Fs, &[Step(3)]),
    (Stqx, &[Step(4)]),
    (Stqx, &[Step(5)]),
    (Stqx, &[Step(6)]),
    (Stqx, &[Step(7)]),
    (Shufb, &[Step(0), Step(2)]),
    (Shufb, &[Step(0), Step(2)]),
    (Shufb, &[Step(1), Step(3)]),
    (Shufb, &[Step(1), Step(3)]),
    (Shufb, &[Step(12), Step(14)]),
    (Shufb, &[Step(12), Step(14)]),
    (Shufb, &[Step(13), Step(15)]),
    (Shufb, &[Step(13), Step(15)]),
    (Fs, &[Step(16), Step(19)]),
    (Fs, &[Step(17), Step(19)]),
    (Fs, &[Step(18), Step(19)]),
    (Fa, &[Step(16), Step(19)]),
    (Fa, &[Step(17), Step(19)]),
    (Fa, &[Step(18), Step(19)]),
    (Fcgt, &[Step(20)]),
    (Fcgt, &[Step(21)]),
    (Fcgt, &[Step(22)]),
    (Fcgt, &[Step(23)]),
    (Fcgt, &[Step(24)]),
    (Fcgt, &[Step(25)]),
    (Selb, &[Step(26)]),
    (Selb, &[Step(27)]),
    (Selb, &[Step(28)]),
    (Selb, &[Step(29)]),
    (Selb, &[Step(30)]),
    (Selb, &[Step(31)]),
];
/// A quadword emptied.
const CLEAR: Sequence = &[(Stqx, &[])];
/// The addresses of a sphere's eight cells, 18 instructions for four spheres, and its id spread.
const ADDRESSES: Sequence =
    &[(Shl, &[In(0)]), (A, &[Step(0)]), (A, &[Step(1)]), (A, &[Step(1)]), (A, &[Step(1)]), (Shufb, &[])];
/// A queue read: its address to the preferred slot, its two quadwords.
const READ_QUEUE: Sequence = &[(Rotqby, &[In(0)]), (Lqx, &[Step(0)]), (Lqx, &[Step(0)])];
/// An id pushed onto it: what falls out of the first goes into the second.
const PUSH_QUEUE: Sequence = &[(Shufb, &[In(0)]), (Shufb, &[In(0)])];
/// It is written back.
const WRITE_QUEUE: Sequence = &[(Stqx, &[In(0)]), (Stqx, &[In(0)])];
/// A number in memory read, one added, and written.
const ENTRY: Sequence =
    &[(Lqx, &[In(0)]), (Rotqby, &[Step(0)]), (A, &[Step(1)]), (Shufb, &[Step(2)]), (Stqx, &[Step(3)])];
/// Four slices: planes read, the eye taken off, written.
const DISTANCES: Sequence =
    &[(Lqx, &[]), (Lqx, &[]), (Fs, &[Step(0)]), (Fs, &[Step(1)]), (Stqx, &[Step(2)]), (Stqx, &[Step(3)])];
/// The four numbers of a slice, each brought to the preferred slot.
const RECTANGLE: Sequence =
    &[(Lqx, &[In(0)]), (Rotqby, &[Step(0)]), (Rotqby, &[Step(0)]), (Rotqby, &[Step(0)])];
/// Three indices to an address, and the two quadwords there.
const CELL: Sequence = &[
    (Shl, &[In(0)]),
    (Shl, &[In(0)]),
    (Shl, &[In(0)]),
    (A, &[Step(0), Step(1)]),
    (A, &[Step(2), Step(3)]),
    (Lqx, &[Step(4)]),
    (Lqx, &[Step(4)]),
];
/// An id taken from a queue, cut to 16 bits, made an address; centre and radius there, and each spread.
const SPHERE: Sequence = &[
    (Rotqby, &[In(0)]),
    (And, &[Step(0)]),
    (Shl, &[Step(1)]),
    (Lqx, &[Step(2)]),
    (Shufb, &[Step(3)]),
    (Shufb, &[Step(3)]),
    (Shufb, &[Step(3)]),
    (Shufb, &[Step(3)]),
];
/// r² and f·f − r² of one that is spread: spheres have 16 bytes, and these are not among them.
const INVARIANTS: Sequence =
    &[(Fm, &[In(0)]), (Fm, &[In(0)]), (Fma, &[Step(1)]), (Fma, &[Step(2)]), (Fs, &[Step(3), Step(0)])];
/// An id to an address; centre, radius and colour there; the colour made numbers; each spread.
const OWNER: Sequence = &[
    (Rotqby, &[In(0)]),
    (Shl, &[Step(0)]),
    (Lqx, &[Step(1)]),
    (Lqx, &[Step(1)]),
    (Shufb, &[Step(3)]),
    (Csflt, &[Step(4)]),
    (Shufb, &[Step(2)]),
    (Shufb, &[Step(2)]),
    (Shufb, &[Step(2)]),
    (Shufb, &[Step(2)]),
    (Shufb, &[Step(5)]),
    (Shufb, &[Step(5)]),
    (Shufb, &[Step(5)]),
];
/// Four pixels: red with green, then blue and opacity.
const PIXELS: Sequence = &[(Shufb, &[In(0)]), (Shufb, &[Step(0)])];
/// A mailbox asked and written: where the packet's number stands for a sphere, and whether it is this one's.
pub const MAILBOX: Sequence = &[
    (Lqx, &[In(0)]),
    (Rotqby, &[Step(0)]),
    (Ceq, &[Step(1)]),
    (Brnz, &[Step(2)]),
    (Shufb, &[Step(0)]),
    (Stqx, &[Step(4)]),
];

/// A chore's sequences, each with how often it is done.
#[must_use]
pub fn of_chore(chore: Chore) -> [(Sequence, usize); 4] {
    const NOTHING: (Sequence, usize) = (&[], 0);
    let one = |sequence, times| [(sequence, times), NOTHING, NOTHING, NOTHING];
    match chore {
        Chore::Boxes => one(BOXES, 4),
        Chore::Clear(quadwords) => one(CLEAR, quadwords),
        // Straight-line code pushes all eight, equal or not.
        Chore::Push(cells) => {
            let cells = cells.max(8);
            [(ADDRESSES, 1), (READ_QUEUE, cells), (PUSH_QUEUE, cells), (WRITE_QUEUE, cells)]
        }
        Chore::Entry => one(ENTRY, 1),
        Chore::Packet | Chore::Block(_) | Chore::Settled { .. } => one(&[], 0),
        Chore::Distances(slices) => one(DISTANCES, slices.div_ceil(4)),
        Chore::Rectangle => one(RECTANGLE, 1),
        Chore::Cell { .. } => one(CELL, 1),
        Chore::Sphere(_) => one(SPHERE, 1),
        Chore::Invariants => one(INVARIANTS, 1),
        Chore::Owner => one(OWNER, 1),
        Chore::Pixels => one(PIXELS, 4),
    }
}
