//! What is hit is visited and kept.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::visible(bytes);
});
