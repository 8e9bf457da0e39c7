//! Any bytes as a LAMMPS dump.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::lammps(bytes);
});
