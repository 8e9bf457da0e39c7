//! Small files read whole: what was written comes out, however untidy, and is bounded in memory and warnings.

use crate::samples::*;
use contract::Sphere;
use verify::scenes::read::{Format, MAX_WARNINGS, ReadError, read_bytes};
#[test]
fn samples_hold_what_was_written() {
    let pdb = ok("a.pdb", PDB.as_bytes());
    assert_eq!(frame_sizes(&pdb), [2, 2]);
    assert_eq!(pdb.animation.frames()[1].spheres()[1].center, [1.5, 2.0, 3.0]);
    assert_eq!(pdb.animation.frames()[0].spheres()[1].radius, 1.39, "zinc by its name");
    let xyz = ok("a.xyz", XYZ.as_bytes());
    assert_eq!(frame_sizes(&xyz), [2, 0, 1]);
    assert_eq!(xyz.animation.frames()[0].spheres()[1].radius, 1.20, "hydrogen by its number");
    assert_eq!((xyz.warnings.len(), xyz.warnings[0].line), (1, Some(9)), "Xx is no element");
    for (big, cell) in [(false, false), (false, true), (true, false), (true, true)] {
        let loaded = ok("a.dcd", &dcd(big, cell, 2, 0));
        assert_eq!(frame_sizes(&loaded), [4, 4], "big-endian {big}, cell {cell}");
        assert_eq!(loaded.animation.frames()[1].spheres()[3].center, [3.0, 1.0, -1.5]);
    }
    // X-PLOR keeps a time step of 64 bits where CHARMM says that there is a cell.
    let mut xplor = dcd(false, false, 2, 0);
    xplor[44..52].copy_from_slice(&0.02f64.to_le_bytes());
    xplor[84..88].fill(0);
    assert_eq!(ok("a.dcd", &xplor).animation, ok("a.dcd", &dcd(false, false, 2, 0)).animation);
    let xtc = ok("a.xtc", &small_xtc());
    assert_eq!(frame_sizes(&xtc), [2, 2]);
    assert_eq!(xtc.animation.frames()[1].spheres()[1].center, [10.0, 10.0, 5.0], "in Angstrom");
    assert_eq!(frame_sizes(&ok("b.xtc", &packed_xtc(&[0; 24], 0, 15, 20, 12))), [12, 12]);
    let nff = ok("a.nff", NFF.as_bytes());
    let scene = &nff.animation.frames()[0];
    assert_eq!((scene.background(), scene.light()), ([128, 0, 255], [0.0, 0.0, 1.0]));
    let first = Sphere { center: [1.0, 2.0, 3.0], radius: 0.5, color: [255, 128, 0] };
    assert_eq!((scene.spheres()[0], scene.spheres().len()), (first, 2));
    let view = nff.framing.expect("a viewpoint");
    assert_eq!((view.eye, view.fov, view.size), (Some([1.0, 2.0, 3.0]), Some(45.0), Some(size(32, 16))));
    assert_eq!((view.target, view.up), (Some([1.0, 2.0, 4.0]), Some([0.0, 0.0, 1.0])));
    let lines: Vec<_> = nff.warnings.iter().map(|w| (w.line, w.text.as_str())).collect();
    assert_eq!(lines[0], (Some(13), "polygon \"p\" passed over"));
    assert_eq!(lines[1], (Some(17), "\"c\" passed over"));
    let lammps = ok("a.lammpstrj", LAMMPS.as_bytes());
    assert_eq!(frame_sizes(&lammps), [0, 2]);
    let sorted = lammps.animation.frames()[1].spheres();
    assert_eq!((sorted[0].center, sorted[0].radius), ([4.0, 5.0, 6.0], 0.25), "id 1 comes first");
    let pov = ok("a.inc", POV.as_bytes());
    assert_eq!(pov.animation.frames()[0].spheres()[0].center, [1.0, 3.0, 2.0], "right-handed, y up");
    assert_eq!(pov.animation.frames()[0].spheres()[1].radius, 0.05, "for a name");
    assert_eq!(frame_sizes(&ok("a.xyz.gz", &packed(XYZ.as_bytes()))), [2, 0, 1]);
    assert_eq!(frame_sizes(&ok("a.xyz", &packed(XYZ.as_bytes()))), [2, 0, 1], "gzip is told by its bytes");
    assert_eq!(Format::of("X.PDB.GZ").expect("case does not matter"), Format::Pdb);
}

/// The first light with a direction counts; NFF has them at places, we have them far away.
#[test]
fn nff_lights_that_cannot_be_kept_are_warned_of() {
    let loaded = ok("a.nff", b"l 0 0 0\nl 0 -3 4 1 1 1\nl 1 0 0\ns 0 0 0 1\n");
    assert_eq!(loaded.animation.frames()[0].light(), [0.0, -0.6, 0.8]);
    let lines: Vec<_> = loaded.warnings.iter().map(|w| w.line).collect();
    assert_eq!(lines, [Some(1), Some(3)]);
    let none = ok("a.nff", b"l 0 0 0\ns 0 0 0 1\n");
    assert_eq!(none.animation.frames()[0].light(), contract::DEFAULT_LIGHT);
}

#[test]
fn lammps_columns_are_found_by_name() {
    let dump = |columns: &str, atom: &str| {
        let head =
            "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n-1 1\n0 10\n5 25\n";
        ok("a.lammpstrj", format!("{head}ITEM: ATOMS {columns}\n{atom}\n\n").as_bytes())
    };
    for (columns, atom, center, radius) in [
        ("x y z", "1 2 3", [1.0, 2.0, 3.0], 0.5),
        ("zu yu xu", "1 2 3", [3.0, 2.0, 1.0], 0.5),
        ("id xs ys zs", "9 0.5 0.25 0.5", [0.0, 2.5, 15.0], 0.5),
        ("diameter x y z", "3 1 2 3", [1.0, 2.0, 3.0], 1.5),
        ("x y z radius vx", "1 2 3 4 5", [1.0, 2.0, 3.0], 4.0),
        ("element x y z", "O 1 2 3", [1.0, 2.0, 3.0], 1.52),
        ("element x y z", "C1 1 2 3", [1.0, 2.0, 3.0], 0.5),
        ("element x y z radius", "C1 1 2 3 2", [1.0, 2.0, 3.0], 2.0),
        ("xs x ys y zs z", "9 1 9 2 9 3", [1.0, 2.0, 3.0], 0.5),
    ] {
        let loaded = dump(columns, atom);
        let sphere = loaded.animation.frames()[0].spheres()[0];
        assert_eq!((sphere.center, sphere.radius), (center, radius), "{columns}");
        assert_eq!(loaded.warnings.len(), usize::from(radius == 0.5), "{columns}: a guess is a warning");
    }
    let color = |atom: &str| dump("type x y z", atom).animation.frames()[0].spheres()[0].color;
    assert_ne!(color("1 0 0 0"), color("2 0 0 0"), "types differ in colour");
}

/// Files of 2023 have a length of 64 bits; all else is as before.
#[test]
fn xtc_of_2023_is_read() {
    let old = packed_xtc(
        &[0x12, 0x34, 0x08, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
        0,
        15,
        20,
        12,
    );
    let mut new = Vec::new();
    for frame in old.chunks(old.len() / 2) {
        new.extend(2023_i32.to_be_bytes());
        new.extend(&frame[4..88]);
        new.extend([0; 4]);
        new.extend(&frame[88..]);
    }
    assert_eq!(ok("a.xtc", &new).animation, ok("a.xtc", &old).animation);
    let some = ok("a.xtc", &new).animation.frames()[0].spheres().iter().any(|s| s.center != [0.0; 3]);
    assert!(some, "not all at the origin");
}

#[test]
fn carriage_returns_short_lines_and_junk_are_no_trouble() {
    let with_crlf = PDB.replace('\n', "\r\n").replace("           N  ", "   junk \u{fffd}");
    assert_eq!(ok("a.pdb", with_crlf.as_bytes()).animation, ok("a.pdb", PDB.as_bytes()).animation);
    assert_eq!(
        ok("a.xyz", XYZ.replace('\n', "\r\n").as_bytes()).animation,
        ok("a.xyz", XYZ.as_bytes()).animation
    );
    let spaced = XYZ.replace("0\nempty\n", "\n \n0\nempty\n\n");
    assert_eq!(ok("a.xyz", spaced.as_bytes()).animation, ok("a.xyz", XYZ.as_bytes()).animation);
    let cut_at_54: String = PDB.lines().map(|l| format!("{:.54}\n", l.trim_end())).collect();
    assert_eq!(ok("a.pdb", cut_at_54.as_bytes()).animation, ok("a.pdb", PDB.as_bytes()).animation);
}

#[test]
fn first_alternate_location_is_kept_atom_by_atom() {
    let at = |place: &str, location: char, name: &str, x: f32| {
        format!("ATOM      1 {name:4}{location}SER {place:9}{x:8.3}   0.000   0.000\n")
    };
    let atom = |location: char, name: &str, x: f32| at("A   7", location, name, x);
    let text = [
        atom(' ', " N", 1.0),
        atom('B', " CA", 2.0),
        atom('A', " CA", 3.0),
        atom('A', " CB", 4.0),
        atom('B', " CB", 5.0),
        // Another chain, another residue, another atom of a longer name: each has a first location of its own.
        at("B   7", 'A', " CA", 6.0),
        at("A   8", 'A', " CA", 7.0),
        at("A   7", 'A', " CA2", 8.0),
        at("A   7A", 'A', " CA", 9.0),
    ]
    .concat();
    let loaded = ok("a.pdb", text.as_bytes());
    let xs: Vec<f32> = loaded.animation.frames()[0].spheres().iter().map(|s| s.center[0]).collect();
    assert_eq!(xs, [1.0, 2.0, 4.0, 6.0, 7.0, 8.0, 9.0]);
    assert_eq!(loaded.warnings.len(), 1);
}

#[test]
fn trajectories_take_their_atoms_from_another_file() {
    let atoms = "4\n\nH 0 0 0\nO 0 0 0\nS 0 0 0\nC 0 0 0\n";
    let loaded =
        read_bytes("a.dcd", &dcd(true, true, 2, 0), Some(("b.xyz", atoms.as_bytes()))).expect("four each");
    let radii: Vec<f32> = loaded.animation.frames()[1].spheres().iter().map(|s| s.radius).collect();
    assert_eq!(radii, [1.20, 1.52, 1.80, 1.70]);
    let three = "3\n\nH 0 0 0\nO 0 0 0\nS 0 0 0\n";
    for (name, bytes, count) in [("a.dcd", dcd(false, false, 2, 0), 4), ("a.xtc", small_xtc(), 2)] {
        match read_bytes(name, &bytes, Some(("b.xyz", three.as_bytes()))) {
            Err(ReadError::AtomCount { file, frame: 0, count: found, atoms_file, atoms: 3 }) => {
                assert_eq!((file.as_str(), found, atoms_file.as_str()), (name, count, "b.xyz"));
            }
            other => panic!("{name}: {other:?}"),
        }
    }
    let unused = read_bytes("a.xyz", XYZ.as_bytes(), Some(("b.xyz", three.as_bytes()))).expect("read");
    assert!(unused.warnings.iter().any(|w| w.text.contains("was not used")));
}

#[test]
fn a_cut_last_frame_costs_that_frame_and_a_warning() {
    let cases: Vec<(&str, Vec<u8>, usize, usize)> = vec![
        // name, bytes, bytes kept, frames expected
        ("a.pdb", PDB.into(), PDB.find("HETATM    2 ZN    ZN A   2       1.500").expect("there") + 30, 1),
        ("a.pdb", PDB.into(), PDB.len() - 12, 1),
        ("a.xyz", XYZ.into(), XYZ.len() - 10, 2),
        ("a.xyz", "1\n\nH 0 0 0\n2\n\nH 0 0 0\n".into(), 22, 1),
        ("a.xyz", "1\n\nH 0 0 0\n99999999999\n".into(), 23, 1),
        ("a.dcd", dcd(false, true, 2, 0), dcd(false, true, 2, 0).len() - 1, 1),
        ("a.dcd", dcd(true, false, 2, 0), dcd(true, false, 2, 0).len() - 70, 1),
        ("a.xtc", small_xtc(), small_xtc().len() - 1, 1),
        ("a.xtc", small_xtc(), small_xtc().len() / 2 + 3, 1),
        ("b.xtc", packed_xtc(&[0; 24], 0, 15, 20, 12), 230, 1),
        ("a.lammpstrj", LAMMPS.into(), LAMMPS.len() - 10, 1),
        ("a.lammpstrj", LAMMPS.into(), LAMMPS.len() - 60, 1),
    ];
    for (name, bytes, keep, frames) in cases {
        let whole = ok(name, &bytes);
        let keep = keep.min(bytes.len());
        let loaded = ok(name, &bytes[..keep]);
        assert_eq!(loaded.animation.frames().len(), frames, "{name} cut to {keep} bytes");
        assert_eq!(
            loaded.animation.frames(),
            &whole.animation.frames()[..frames],
            "{name} cut to {keep} bytes"
        );
        let said = loaded.warnings.iter().any(|w| w.text.contains("ends within frame"));
        assert!(said, "{name} cut to {keep} bytes: {:?}", loaded.warnings);
    }
    let gz = packed(XYZ.repeat(500).as_bytes());
    let loaded = ok("a.xyz.gz", &gz[..gz.len() / 2]);
    assert!(loaded.warnings.iter().any(|w| w.text.contains("gzip layer is cut")), "{:?}", loaded.warnings);
}

#[test]
fn warnings_are_counted_not_piled_up() {
    let loaded = ok("a.nff", format!("{}s 0 0 0 1\n", "q\n".repeat(5_000)).as_bytes());
    assert_eq!(loaded.warnings.len(), MAX_WARNINGS + 1);
    assert_eq!(loaded.warnings[MAX_WARNINGS].text, "4900 more warnings");
}

/// Frames without spheres cost more than the three bytes they stand in.
#[test]
fn memory_is_kept_account_of() {
    let error =
        read_bytes("a.xyz", "0\n\n".repeat(2_000_000).as_bytes(), None).expect_err("240 MB of frames");
    assert!(
        matches!(error, ReadError::Memory { input: 6_000_000, limit, .. } if limit < 70_000_000),
        "{error}"
    );
}

/// Whatever the header promises, frames are what the records hold, and a difference is a warning.
#[test]
fn a_dcd_has_the_frames_of_its_records() {
    for promised in [0, 1, 2, 3, 500] {
        let loaded = ok("a.dcd", &dcd(false, true, promised, 0));
        assert_eq!(loaded.animation.frames().len(), 2, "{promised} promised");
        let text = format!("the header promises {promised} frames, the records hold 2");
        let warned = loaded.warnings.iter().any(|warning| warning.text == text);
        assert_eq!(warned, promised != 2, "{promised} promised: {:?}", loaded.warnings);
    }
}
