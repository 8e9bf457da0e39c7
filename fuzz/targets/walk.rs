//! The three loops against all cells in order.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::walk(bytes);
});
