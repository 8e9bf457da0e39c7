//! The SPU model: what the tracer's own kernels cost on a PlayStation 3's processor, and whether a scene fits into it.
//!
//! In: a scene, a camera, a plan. Out: cycles by stage as a bracket, mispredicts by site and policy of hinting, what culling and a
//! mailbox save, a map of the local store. Refused: scenes that do not fit, with the map.
//!
//! The modules in the order in which a run goes through them: the instructions ([`isa`]), what each operation is in instructions
//! ([`sequence`]), the two clocks ([`pipeline`]), branches ([`predict`]), where all is booked ([`recorder`]), the
//! [`Machine`](optimized::machine::Machine) that books ([`machine`]), memory ([`store`], [`dma`]), a frame ([`model`](mod@model)), and what it costs
//! over six SPUs ([`cost`]), what of all this a conclusion rests on ([`feature`]), and all that is to be said of a scene ([`survey`](mod@survey));
//! [`crate::paper`] holds the paper's claims against it. [`host`] has the same loops on this computer;
//! [`text`](mod@text), [`page`](mod@page) with its [`curves`](mod@curves), and [`data`] show it all.
//!
//! # What is left out, and in which direction that errs
//!
//! Low in both bounds: constants (they lie in registers), the loops over blocks and stripes, calls and their frames, what 128 registers
//! cannot hold, and how long a transfer takes to begin. Under the plan `safe` also what lists need beyond queues (a load for
//! every few ids), and the margins of each sphere. Of a grid's planes the arithmetic on bit patterns; the search itself is booked as it is done.
//!
//! High in both bounds: nothing is fused, though a compiler may fuse a product and a sum where the last bit does not matter; ids and t
//! are written along with the colours, 8 stores more a block; what a sphere of the certified plans would need is selected along
//! with its surface, 4 instructions for each sphere of a block.
//!
//! Low in the dependence bound: how pairs of instructions must lie in memory ([`pipeline`]). High in it: two stages never share a cycle, and a
//! mispredict's 18 cycles are added to waits for operands that they would hide.
//!
//! Neither: values. They are those of the machine inside [`Spu`], and no branch is taken otherwise for the model's sake.

pub mod cost;
pub mod curves;
pub mod data;
pub mod dma;
pub mod feature;
pub mod host;
pub mod isa;
pub mod machine;
pub mod model;
pub mod page;
pub mod pipeline;
pub mod predict;
pub mod recorder;
pub mod sequence;
pub mod store;
pub mod survey;
pub mod text;

pub use machine::Spu;
