//! The paper's queue against plain lists.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::queue(bytes);
});
