//! Any bytes as a PDB file.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::pdb(bytes);
});
