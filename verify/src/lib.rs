//! The judge's house: scenes come in, subjects render them, judges compare, a report goes out.
//!
//! The modules stand in the order in which data flows.

pub mod directed;
pub mod matrix;
pub mod scenes;
pub mod seed;

pub mod subject;

pub mod judge;
pub mod verdict;
pub mod visible;

pub mod claims;
pub mod picture;
pub mod report;
pub mod run;
