//! How fast? Every tracer that a user could pick, on the same frames, checked before it is timed.
//!
//! In: frames of scenes, a plan, a level, a number of threads, and the outsiders to be asked. Out: a [`Bench`], told as a
//! table, a page and a JSON file. Refused: to time who is wrong.
//!
//! What is timed is the same for all: a frame's spheres are taken anew, whatever the tracer builds is built, all pixels of the
//! camera are traced, and ids and t are left in memory that is kept from frame to frame. The tracer under test leaves
//! colours too. The order of modules is that of a run: who takes part ([`contestant`], [`ours`], [`outsiders`] with `embree` and
//! `peers`), who may ([`check`](mod@check)), the clock ([`rounds`](mod@rounds), [`spread`]), one scene ([`scene`]), many
//! ([`curves`](mod@curves)), and what is said ([`data`], [`baseline`], [`text`], [`page`](mod@page)).

pub mod contestant;
pub(crate) mod naive;
pub mod ours;
pub mod outsiders;

#[cfg(feature = "embree")]
pub(crate) mod embree;
#[cfg(feature = "peers")]
pub(crate) mod peers;

pub mod check;
pub mod rounds;
pub mod spread;
pub mod unseen;

pub mod scene;

pub mod curves;

pub mod baseline;
pub mod data;
pub mod page;
pub mod text;

pub use curves::curves;
pub use data::{Bench, Row, SceneBench, Summary};
pub use outsiders::{Field, Outsider};
pub use page::page;
pub use rounds::Effort;
pub use scene::{BenchError, Input, Setting, bench};
