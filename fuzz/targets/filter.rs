//! The filtered exact tracer against the unfiltered one.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::filter(bytes);
});
