//! Any bytes as this project's JSON.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::json(bytes);
});
