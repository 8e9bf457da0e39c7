//! Any bytes as an XTC trajectory.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::xtc(bytes);
});
