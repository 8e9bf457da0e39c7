//! Any bytes as a POV-Ray list of spheres.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    verify::fuzzed::pov(bytes);
});
