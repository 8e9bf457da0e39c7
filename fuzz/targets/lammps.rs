//! Any bytes as a LAMMPS dump: read or refused, never a panic, and what is read can be framed or is refused.
#![no_main]

use libfuzzer_sys::fuzz_target;
use verify::scenes::{frame::Framing, read::read_bytes};

fuzz_target!(|bytes: &[u8]| {
    if let Ok(loaded) = read_bytes("fuzzed.lammpstrj", bytes, None) {
        _ = loaded.camera(&Framing::default());
    }
});
