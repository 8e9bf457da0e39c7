//! The judge's house: scenes come in, subjects render them, judges compare, a report goes out.
//!
//! The modules stand in the order in which data flows. Inputs: [`scenes`] reads, makes and frames them, [`matrix`] is the
//! set that every tracer is held against, [`directed`] makes rays that lie where decisions are close, [`seed`] draws what
//! is random. What is judged: [`subject`], in any language [`foreign`], of other people `peers` (behind
//! the feature of that name). How: [`judge`] by bits and by error bounds and by an outside witness
//! (`embree`, behind the feature of that name), [`visible`] from inside the grid tracer, [`bounds`], [`margins`] and [`rounding`] on floats
//! so [`small`] or so [`few`] of bits that all inputs can be tried, [`cells`] on all f32, [`fuzzed`] on any bytes, [`prove`] by solvers
//! for all inputs; a [`verdict`] is what they say. [`run`] does it all for one frame, a [`case`] is a failure that anyone can run again, a [`campaign`] as many scenes as many machines have time for, [`bench`](mod@bench) says how
//! fast, [`spu`] how fast on the paper's processor. [`methods`] are all ways to answer rays: [`chart`] has their speed against their error, [`stability`] where each
//! breaks, [`ablation`] what each choice of a plan buys, [`advice`] which to take. [`claims`], [`paper`] with what the paper claims, [`figures`], [`picture`] and [`report`] show it, and [`view`] while it plays.

pub mod directed;
pub mod few;
pub mod matrix;
pub mod scenes;
pub mod seed;
pub mod small;

pub mod subject;

pub mod foreign;

#[cfg(feature = "peers")]
pub mod peers;

#[cfg(feature = "embree")]
pub mod embree;

pub mod bounds;
pub mod cells;
pub mod margins;
pub mod rounding;
pub mod visible;
pub mod watch;

pub mod fuzzed;

pub mod prove;

pub mod judge;
pub mod verdict;

pub mod run;

pub mod case;

pub mod campaign;
pub mod properties;

pub mod bench;

pub mod ablation;
pub mod advice;
pub mod chart;
pub mod methods;
pub mod stability;

pub mod spu;

pub mod figures;

pub mod claims;
pub mod paper;
pub mod picture;
pub(crate) mod plot;
pub mod report;

pub mod view;
