//! The judge's house: scenes come in, subjects render them, judges compare, a report goes out.
//!
//! The modules stand in the order in which data flows.

pub mod scenes;
pub mod verdict;
