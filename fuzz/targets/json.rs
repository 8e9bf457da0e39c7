//! Any bytes as this project's JSON: read or refused, and what is read comes back from what is written of it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use verify::scenes::{read::read_bytes, write};

fuzz_target!(|bytes: &[u8]| {
    let Ok(first) = read_bytes("fuzzed.json", bytes, None) else { return };
    let text = write::json(&first.animation, first.camera.as_ref());
    let again = read_bytes("written.json", text.as_bytes(), None).expect("what was written is read");
    assert_eq!((first.animation, first.camera), (again.animation, again.camera));
});
