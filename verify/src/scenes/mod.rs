//! Where scenes come from: files are read, generators run, and a catalogue gives names to both; what comes out
//! is an animation of the contract, with a camera that shows all of it.
//! Everything here refuses bad input by a typed error that names the place and the value; nothing prints.

pub mod catalogue;
pub mod elements;
pub mod frame;
pub mod generate;
pub mod read;
pub(crate) mod vector;
pub mod write;
