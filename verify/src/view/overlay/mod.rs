//! What is laid over the picture, one idea a file: each draws onto a [`Canvas`](super::canvas::Canvas) what the tracer itself reported, and says in words what is seen.

pub mod blocks;
pub mod fallback;
pub mod heat;
pub mod times;
pub mod wrong;
