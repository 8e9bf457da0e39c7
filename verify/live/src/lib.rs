//! The certified tracer behind plain bytes, for who can pass no more than these: a page with the module that
//! `verify/live/build` makes of this crate for WebAssembly.
//!
//! In: a scene and a camera as bytes ([`wire`]), and which level is to trace. Out: ids, t, colours, what tracing cost, and the picture's
//! [`hash`](fn@hash), by which pages that are made natively and frames that a browser traces are held against each other. Whatever the
//! bytes say, the answer is a picture or a sentence ([`View`]); only a want of memory that was not foreseen ends the module.
//!
//! A program has none of this but the types. The functions that a module exports are in `exports`, which is compiled for WebAssembly alone.

mod hash;
pub mod wire;

mod view;

#[cfg(target_family = "wasm")]
pub mod exports;

pub use hash::hash;
pub use view::{MAX_PIXELS, MAX_SPHERES, Refusal, View};
