//! The SPU's operations against the reference's.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::spu(bytes);
});
