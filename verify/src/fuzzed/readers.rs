//! Readers on any bytes: read or refused, never a panic; what is read can be framed, or that is refused. Spheres read are judged,
//! and frames.

use crate::case::Case;
use crate::scenes::frame::Framing;
use crate::scenes::read::{Loaded, read_bytes};
use crate::scenes::write;

/// For trajectories of one atom.
const ATOMS: &[u8] = b"ATOM      1  N   PRO A   1       0.000   0.000   0.000  1.00  0.00           N\n";

fn size(loaded: &Loaded) -> u64 {
    let frames = loaded.animation.frames();
    frames.iter().map(|frame| 1 + frame.spheres().len() as u64).sum()
}

fn read(name: &str, bytes: &[u8], atoms: Option<(&str, &[u8])>) -> u64 {
    let Ok(loaded) = read_bytes(name, bytes, atoms) else { return 0 };
    _ = loaded.camera(&Framing::default());
    size(&loaded)
}

/// As a PDB file.
pub fn pdb(bytes: &[u8]) -> u64 {
    read("fuzzed.pdb", bytes, None)
}

/// As an XYZ file.
pub fn xyz(bytes: &[u8]) -> u64 {
    read("fuzzed.xyz", bytes, None)
}

/// As a DCD trajectory, first alone, then with a PDB of one atom for its atoms.
pub fn dcd(bytes: &[u8]) -> u64 {
    read("fuzzed.dcd", bytes, None) + read("fuzzed.dcd", bytes, Some(("atoms.pdb", ATOMS)))
}

/// As an XTC trajectory, first alone, then with a PDB of one atom for its atoms.
pub fn xtc(bytes: &[u8]) -> u64 {
    read("fuzzed.xtc", bytes, None) + read("fuzzed.xtc", bytes, Some(("atoms.pdb", ATOMS)))
}

/// As an NFF file.
pub fn nff(bytes: &[u8]) -> u64 {
    read("fuzzed.nff", bytes, None)
}

/// As a LAMMPS dump.
pub fn lammps(bytes: &[u8]) -> u64 {
    read("fuzzed.lammpstrj", bytes, None)
}

/// As a POV-Ray list of spheres.
pub fn pov(bytes: &[u8]) -> u64 {
    read("fuzzed.inc", bytes, None)
}

/// As this project's JSON; what is read must come back from what is written of it, to the bit.
///
/// # Panics
/// If it does not.
pub fn json(bytes: &[u8]) -> u64 {
    let Ok(first) = read_bytes("fuzzed.json", bytes, None) else { return 0 };
    let text = write::json(&first.animation, first.camera.as_ref());
    let again = match read_bytes("written.json", text.as_bytes(), None) {
        Ok(again) => again,
        Err(error) => panic!("what was written is refused: {error}"),
    };
    // Zeros keep their signs.
    let bits = |loaded: &Loaded| {
        let frames = loaded.animation.frames().iter();
        let numbers = frames.flat_map(|frame| {
            let spheres = frame.spheres().iter().flat_map(|s| s.center.into_iter().chain([s.radius]));
            frame.light().into_iter().chain(spheres)
        });
        let camera = loaded.camera.iter().flat_map(|c| [c.eye(), c.corner(), c.du(), c.dv()]).flatten();
        numbers.chain(camera).map(f32::to_bits).collect::<Vec<_>>()
    };
    assert_eq!(bits(&first), bits(&again), "the bits of all numbers, read and read again");
    assert_eq!((&first.animation, first.camera), (&again.animation, again.camera), "read, read again");
    size(&first)
}

/// As a case; what is read must come back from what is written of it.
///
/// # Panics
/// If it does not.
pub fn case(bytes: &[u8]) -> u64 {
    let Ok(first) = Case::from_json(bytes) else { return 0 };
    let text = first.to_json();
    let again = match Case::from_json(text.as_bytes()) {
        Ok(again) => again,
        Err(error) => panic!("what was written is refused: {error}\n{text}"),
    };
    // Its text has the bits of every number.
    assert_eq!(text, again.to_json(), "written, and written again");
    assert_eq!((&first.frames, first.camera), (&again.frames, again.camera), "read, read again");
    let said = |case: &Case| (case.asked.to_string(), case.expected, case.pixel, case.why.clone());
    assert_eq!(said(&first), said(&again), "read, read again");
    first.frames.frames().len() as u64
}
