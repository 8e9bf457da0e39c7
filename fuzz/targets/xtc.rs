//! Any bytes as an XTC trajectory, first alone, then with a PDB of one atom for its atoms: read or refused, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use verify::scenes::{frame::Framing, read::read_bytes};

const ATOMS: &[u8] = b"ATOM      1  N   PRO A   1       0.000   0.000   0.000  1.00  0.00           N\n";

fuzz_target!(|bytes: &[u8]| {
    for atoms in [None, Some(("atoms.pdb", ATOMS))] {
        if let Ok(loaded) = read_bytes("fuzzed.xtc", bytes, atoms) {
            _ = loaded.camera(&Framing::default());
        }
    }
});
