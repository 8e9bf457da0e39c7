//! The SPU model: what the tracer's own kernels cost on a PlayStation 3's processor, and whether a scene fits into it.
//!
//! In: a scene, a camera, a plan. Out: cycles by stage as a bracket, mispredicts by site and policy of hinting, what culling and a
//! mailbox save, a map of the local store. Refused: scenes that do not fit, with the map.
//!
//! The modules in the order in which a run goes through them: the instructions ([`isa`]), what each operation is in instructions
//! ([`sequence`]), the two clocks ([`pipeline`]), branches ([`predict`]), where all is booked ([`recorder`]), the
//! [`Machine`](optimized::machine::Machine) that books ([`machine`]), memory ([`store`], [`dma`]), a frame ([`model`](mod@model)), and what it costs
//! over six SPUs ([`cost`]), all that is to be said of a scene ([`survey`](mod@survey)), and of the
//! paper ([`claims`](mod@claims)). [`host`] has the same loops on this computer;
//! [`text`](mod@text), [`page`](mod@page) with its [`curves`](mod@curves), and [`data`] show it all.

pub mod claims;
pub mod cost;
pub mod curves;
pub mod data;
pub mod dma;
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
