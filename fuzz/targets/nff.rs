//! Any bytes as an NFF file.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::nff(bytes);
});
