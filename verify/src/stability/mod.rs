//! Where each method breaks: the same question asked from easy to hard, over distance, scale, size of cells, crowds in them, tangency,
//! angle, offset, grid and packet.
//!
//! In: methods and a number of rays. Out: a [`Stability`] as plain data, and its pictures. The order of modules is that of a run: the scenes
//! ([`scenes`]), what is varied in them ([`sweep`]), how often a method then shows another sphere than the exact picture ([`measure`]), or,
//! without any truth, another one than in the same scene turned, moved or scaled ([`relation`]), from where on it does ([`breakdown`]), and how
//! it is told ([`data`], [`page`], [`text`]).

pub mod breakdown;
pub mod data;
pub mod measure;
pub mod page;
pub mod relation;
pub mod scenes;
pub mod sweep;
pub mod text;

pub use data::{SCHEMA_VERSION, Stability};
pub use measure::{Asked, stability, steps};
