//! Cells list what they hold a point of.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::voxelize(bytes);
});
