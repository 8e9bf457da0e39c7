//! Any bytes as a DCD trajectory.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::dcd(bytes);
});
