//! Embree 4, the judge that shares nothing with this project: spheres as its point geometry, asked 1, 4, 8 or 16 rays at
//! a time, at an instruction set of choice.
//!
//! In: a checked scene and rays. Out: for each ray the id and t that Embree found, and nothing of how. Refused, as
//! [`EmbreeError`]: a version whose structures are not known, an instruction set that it does not take, a library that
//! writes outside its structures, leaves the flush-to-zero mode set, or cannot find spheres that are plainly there.
//!
//! The order is that of a question: [`Device`] loads and checks the library, [`Tracer`] holds a scene and asks,
//! [`Animated`] does so at the library's best speed, [`Witness`](crate::judge::outside::Witness) is what the judge sees of it. Unsafe code stands in `ffi` alone. What tests
//! plant to see the checks turn red is a [`Fault`].

mod animated;
mod canary;
mod device;
mod error;
mod fault;
mod ffi;
mod packet;
mod tracer;
mod witness;

pub use animated::{Animated, Mode};
pub use device::{Device, Isa, Version};
pub use error::{Code, EmbreeError};
pub use fault::Fault;
pub use tracer::{Build, Tracer, Width};
pub use witness::Embree;

#[cfg(not(all(target_arch = "x86_64", unix)))]
compile_error!("the feature `embree` knows the processor state and calls of x86-64 Unix alone");
