//! Proofs: what the shipped kernels do for *all* inputs, asked of solvers that this project did not write.
//!
//! A kernel of `optimized` is generic over the machine that executes it, so the source that ships runs on symbols too
//! ([`symbolic`]) and leaves behind [`term`]s, which are printed for a solver ([`smt`], [`solver`]). What is claimed of it is a function of
//! the machine as well ([`theorem`], [`prover`]): one text is what the solver gets, what the witness and each counterexample are replayed on, and,
//! on a machine that does one operation wrong ([`broken`]), the fault that the prover must notice. [`claims`] are the
//! claims, one to a file.

pub mod broken;
pub mod claims;
pub mod page;
pub mod prover;
pub mod run;
pub mod smt;
pub mod solver;
pub mod symbolic;
pub mod term;
pub mod theorem;
