//! Certified arithmetic, stage by stage, against the exact reference.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::certified(bytes);
});
