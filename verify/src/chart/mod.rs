//! Speed against accuracy: every method on the same frame, seen from growing distances, as a point of time a ray against error.
//!
//! In: a scene, methods, how far away. Out: a [`Chart`] as plain data, and its pictures. All methods of a view answer the same rays in one
//! run, in interleaved rounds ([`crate::bench::rounds`]), and all are held against the exact picture. Who is wrong is timed too: that is what
//! is to be seen. The order of modules is that of a run: from where ([`view`]), what is found ([`measure`](mod@measure), [`data`]), how it is shown
//! ([`page`], [`text`]).

pub mod data;
pub mod measure;
pub mod page;
pub mod text;
pub mod view;

pub use data::{Chart, Point, SCHEMA_VERSION, View};
pub use measure::{Asked, measure};
pub use view::Distance;
