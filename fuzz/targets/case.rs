//! Any bytes as the file of a case.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::case(bytes);
});
