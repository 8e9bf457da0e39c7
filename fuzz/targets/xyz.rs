//! Any bytes as an XYZ file.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::xyz(bytes);
});
