//! Do readers read real files whole, name what is wrong with broken ones, and survive anything?
//!
//! Real files that are fetched and absent are said to be "not judged"; broken ones are small and stand here.

use contract::{Animation, Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use sha2::{Digest, Sha256};
use std::io::Write as _;
use std::path::Path;
use verify::scenes::catalogue::{self, Data, ENTRIES, Source, SourceError};
use verify::scenes::elements;
use verify::scenes::read::{Format, Loaded, MAX_WARNINGS, ReadError, gzip_limit, read, read_bytes};
use verify::scenes::write;

// ---- real files ----

fn counts(loaded: &Loaded) -> (usize, usize) {
    (loaded.animation.frames()[0].spheres().len(), loaded.animation.frames().len())
}

/// A fetched entry, or `None` and a line on stderr.
fn fetched(name: &str) -> Option<Loaded> {
    let entry = ENTRIES.iter().find(|e| e.name == name).expect("an entry of the catalogue");
    match entry.load(&catalogue::folder()) {
        Ok(loaded) => Some(loaded),
        Err(SourceError::DataAbsent { name, how }) => {
            eprintln!("not judged: {name}: data absent (run {how})");
            None
        }
        Err(error) => panic!("{name}: {error}"),
    }
}

#[test]
fn every_entry_has_the_spheres_and_frames_it_promises() {
    let mut judged = 0;
    for entry in ENTRIES {
        let Some(loaded) = fetched(entry.name) else { continue };
        assert_eq!(counts(&loaded), (entry.spheres, entry.frames), "{}", entry.name);
        let frames = loaded.animation.frames();
        assert!(frames.iter().all(|f| f.spheres().len() == entry.spheres), "{}: frames differ", entry.name);
        loaded.camera(&Default::default()).unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        judged += 1;
        eprintln!(
            "{}: {} spheres x {} frames, {} warnings",
            entry.name,
            entry.spheres,
            entry.frames,
            loaded.warnings.len()
        );
        for warning in &loaded.warnings {
            eprintln!("  {warning}");
        }
    }
    eprintln!("judged {judged} of {} entries", ENTRIES.len());
    assert!(judged >= 2, "the bundled ones are always there");
}

#[test]
fn bundled_data_is_unchanged() {
    let table = include_str!("data/README.md");
    for entry in ENTRIES {
        let Data::Bundled(name, packed) = entry.data else { continue };
        let mut hash = Sha256::new();
        std::io::copy(&mut flate2::read::GzDecoder::new(packed), &mut HashWriter(&mut hash)).expect("gzip");
        let hex: String = hash.finalize().iter().map(|b| format!("{b:02x}")).collect();
        let row = table.lines().find(|l| l.contains(name)).expect("each file has a row");
        assert!(row.contains(&hex), "{name}: SHA-256 is {hex}, and the table says {row}");
    }
}

struct HashWriter<'a>(&'a mut Sha256);

impl std::io::Write for HashWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn protease_has_the_atoms_that_stand_in_the_file() {
    let loaded = Source::parse(catalogue::DEFAULT).expect("a name").load().expect("bundled");
    let spheres = loaded.animation.frames()[0].spheres();
    assert_eq!((spheres[0].center, spheres[0].radius), ([-12.735, 38.918, 31.287], 1.55), "N of PRO 1");
    assert_eq!((spheres[1].center, spheres[1].radius), ([-12.709, 39.097, 29.830], 1.70), "CA of PRO 1");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let of = |radius: f32| spheres.iter().filter(|s| s.radius == radius).count();
    assert_eq!(of(1.70) + of(1.55) + of(1.52) + of(1.80) + of(1.20), 1_890, "C, N, O, S, H and nothing else");
}

#[test]
fn alternate_locations_are_left_out_and_counted() {
    let Some(loaded) = fetched("4e43") else { return };
    let left_out = loaded.warnings.iter().find(|w| w.text.contains("34 atoms at alternate locations"));
    assert!(left_out.is_some(), "1,877 records less 34: {:?}", loaded.warnings);
}

#[test]
fn dcd_frames_are_the_records_not_the_header() {
    let Some(loaded) = fetched("adk") else { return };
    let said = loaded.warnings.iter().any(|w| w.text.contains("promises 500 frames, the records hold 98"));
    assert!(said, "{:?}", loaded.warnings);
    let frames = loaded.animation.frames();
    assert_ne!(frames[0].spheres(), frames[97].spheres(), "it moves");
    let radii = |f: usize| -> Vec<f32> { frames[f].spheres().iter().map(|s| s.radius).collect() };
    assert_eq!(radii(0), radii(97), "and its atoms stay what they are");
    assert_eq!(
        frames[0].spheres()[0].center,
        [11.736044, 8.500797, -10.445281],
        "first atom, as its bytes stand"
    );
}

#[test]
fn adk_has_only_known_elements() {
    let folder = catalogue::folder();
    let path = folder.join("adk_open.pdb");
    if !path.exists() {
        eprintln!("not judged: adk_open.pdb: data absent (run {})", catalogue::FETCH);
        return;
    }
    let loaded = read(&path).expect("a real file");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    // Names are justified to the left there, so that 214 alpha carbons stand where calcium would.
    let calcium = elements::by_symbol("Ca").expect("in the table").radius;
    assert!(loaded.animation.frames()[0].spheres().iter().all(|s| s.radius != calcium));
}

// ---- samples of every format, small ----

const PDB: &str = "\
MODEL        1
ATOM      1  N   PRO A   1     -12.735  38.918  31.287  1.00 39.83           N  
HETATM    2 ZN    ZN A   2       1.000   2.000   3.000
ENDMDL
MODEL        2
ATOM      1  N   PRO A   1     -11.735  38.918  31.287  1.00 39.83           N  
HETATM    2 ZN    ZN A   2       1.500   2.000   3.000
ENDMDL
END
";
const XYZ: &str = "2\nfirst\nO 0 0 0\n1 0.96 0 0\n0\nempty\n1\nthird\nXx 1 2 3 9 9\n";
const NFF: &str = "\
# a comment
b 0.5 0 1
v
from 1 2 3
at 0 0 0
up 0 0 1
angle 45
hither 1
resolution 32 16
l 0 0 7
f 1 0.5 0 1 0 0 0 0
s 1 2 3 0.5
p 3
0 0 0
1 0 0
0 1 0
c
0 0 0 1
1 0 0 0
s -1 0 0 2
";
const LAMMPS: &str = "\
ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
0
ITEM: BOX BOUNDS pp pp ff
0 10
0 10
0 20
ITEM: ATOMS id type x y z radius
ITEM: TIMESTEP
100
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp ff
0 10
0 10
0 20
ITEM: ATOMS id type x y z radius
2 1 1 2 3 0.5
1 2 4 5 6 0.25
";
const POV: &str = "#default\nsphere {<1,2,3>,0.5}\n sphere{ < -1.5 , 2 , 0 > , R }\n";

/// A DCD of two frames of four atoms in either byte order; atom i of frame f stands at (i, f, -1.5).
fn dcd(big: bool, cell: bool, promised: i32, fixed: i32) -> Vec<u8> {
    let int = |n: i32| if big { n.to_be_bytes() } else { n.to_le_bytes() };
    let float = |x: f32| if big { x.to_be_bytes() } else { x.to_le_bytes() };
    let record = |contents: Vec<u8>| {
        let length = int(i32::try_from(contents.len()).expect("short"));
        [&length[..], &contents, &length[..]].concat()
    };
    let mut header = [0_i32; 20];
    header[0] = promised;
    header[8] = fixed;
    header[10] = i32::from(cell);
    header[19] = 24;
    let first = [b"CORD".to_vec(), header.iter().flat_map(|&n| int(n)).collect()].concat();
    let mut out =
        [record(first), record([&int(1)[..], &[b' '; 80]].concat()), record(int(4).to_vec())].concat();
    for frame in 0..2_u8 {
        if cell {
            out.extend(record(vec![0; 48]));
        }
        let axes = [[0.0, 1.0, 2.0, 3.0], [f32::from(frame); 4], [-1.5; 4]];
        for axis in axes {
            out.extend(record(axis.iter().flat_map(|&x| float(x)).collect()));
        }
    }
    out
}

/// An XTC of two frames of two atoms, which are few enough to stand uncompressed; atom i at (i, f, 0.5) nm.
fn small_xtc() -> Vec<u8> {
    let mut out = Vec::new();
    for frame in 0..2_u8 {
        for n in [1995_i32, 2, 0] {
            out.extend(n.to_be_bytes());
        }
        out.extend([0_u8; 40]);
        out.extend(2_i32.to_be_bytes());
        for x in [0.0, f32::from(frame), 0.5, 1.0, f32::from(frame), 0.5] {
            out.extend(x.to_be_bytes());
        }
    }
    out
}

/// A compressed XTC of two frames, written by hand: 12 atoms, all bits of the stream as given.
fn packed_xtc(stream: &[u8], low: i32, high: i32, width: i32, atoms: i32) -> Vec<u8> {
    let mut out = Vec::new();
    for _ in 0..2 {
        for n in [1995, atoms, 0] {
            out.extend(n.to_be_bytes());
        }
        out.extend([0_u8; 40]);
        out.extend(atoms.to_be_bytes());
        out.extend(1000_f32.to_be_bytes());
        for n in [low, low, low, high, high, high, width] {
            out.extend(n.to_be_bytes());
        }
        out.extend(i32::try_from(stream.len()).expect("short").to_be_bytes());
        out.extend(stream);
        out.extend(vec![0; (4 - stream.len() % 4) % 4]);
    }
    out
}

fn json_sample() -> String {
    let spheres = vec![
        Sphere { center: [0.1, -0.0, 1e30], radius: 1e-45, color: [1, 2, 3] },
        Sphere { center: [f32::MAX, f32::MIN_POSITIVE, 16_777_216.0], radius: 1.5, color: [255, 0, 9] },
    ];
    let frame = Scene::new(spheres, [7, 8, 9], [0.3, -0.4, 0.5]).expect("valid");
    let empty = Scene::new(Vec::new(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let camera = Camera::new([0.1; 3], [-1.0, 1.0, -2.0], [0.02, 0.0, 0.0], [0.0, -0.02, 0.0], size(100, 99));
    write::json(&Animation::new(vec![frame, empty]).expect("frames"), Some(&camera.expect("valid")))
}

fn size(width: u32, height: u32) -> Size {
    Size::new(width, height).expect("valid")
}

fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut out = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::new(6));
    out.write_all(bytes).expect("to memory");
    out.finish().expect("to memory")
}

/// Name and bytes of each sample; more than one frame where the format has frames.
fn samples() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("a.pdb", PDB.into()),
        ("a.xyz", XYZ.into()),
        ("a.dcd", dcd(false, true, 2, 0)),
        ("b.dcd", dcd(true, false, 2, 0)),
        ("a.xtc", small_xtc()),
        ("b.xtc", packed_xtc(&[0; 24], 0, 15, 20, 12)),
        ("a.nff", NFF.into()),
        ("a.lammpstrj", LAMMPS.into()),
        ("a.json", json_sample().into()),
        ("a.inc", POV.into()),
        ("a.xyz.gz", packed(XYZ.as_bytes())),
    ]
}

fn ok(name: &str, bytes: &[u8]) -> Loaded {
    read_bytes(name, bytes, None).unwrap_or_else(|e| panic!("{e}"))
}

fn frame_sizes(loaded: &Loaded) -> Vec<usize> {
    loaded.animation.frames().iter().map(|f| f.spheres().len()).collect()
}

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
    let lines: Vec<_> = nff.warnings.iter().map(|w| (w.line, w.text.as_str())).collect();
    assert_eq!(lines[0], (Some(13), "polygon \"p\" passed over"));
    assert_eq!(lines[1], (Some(17), "\"c\" passed over"));
    let lammps = ok("a.lammpstrj", LAMMPS.as_bytes());
    assert_eq!(frame_sizes(&lammps), [0, 2]);
    let sorted = lammps.animation.frames()[1].spheres();
    assert_eq!((sorted[0].center, sorted[0].radius), ([4.0, 5.0, 6.0], 0.25), "id 1 comes first");
    let pov = ok("a.inc", POV.as_bytes());
    assert_eq!(pov.animation.frames()[0].spheres()[0].center, [1.0, 2.0, -3.0]);
    assert_eq!(frame_sizes(&ok("a.xyz.gz", &packed(XYZ.as_bytes()))), [2, 0, 1]);
    assert_eq!(frame_sizes(&ok("a.xyz", &packed(XYZ.as_bytes()))), [2, 0, 1], "gzip is told by its bytes");
    assert_eq!(Format::of("X.PDB.GZ").expect("case does not matter"), Format::Pdb);
}

#[test]
fn carriage_returns_short_lines_and_junk_are_no_trouble() {
    let with_crlf = PDB.replace('\n', "\r\n").replace("           N  ", "   junk \u{fffd}");
    assert_eq!(ok("a.pdb", with_crlf.as_bytes()).animation, ok("a.pdb", PDB.as_bytes()).animation);
    assert_eq!(
        ok("a.xyz", XYZ.replace('\n', "\r\n").as_bytes()).animation,
        ok("a.xyz", XYZ.as_bytes()).animation
    );
    let cut_at_54: String = PDB.lines().map(|l| format!("{:.54}\n", l.trim_end())).collect();
    assert_eq!(ok("a.pdb", cut_at_54.as_bytes()).animation, ok("a.pdb", PDB.as_bytes()).animation);
}

#[test]
fn first_alternate_location_is_kept_atom_by_atom() {
    let atom = |location: char, name: &str, x: f32| {
        format!("ATOM      1 {name:4}{location}SER A   7    {x:8.3}   0.000   0.000\n")
    };
    let text = [
        atom(' ', " N", 1.0),
        atom('B', " CA", 2.0),
        atom('A', " CA", 3.0),
        atom('A', " CB", 4.0),
        atom('B', " CB", 5.0),
    ]
    .concat();
    let loaded = ok("a.pdb", text.as_bytes());
    let xs: Vec<f32> = loaded.animation.frames()[0].spheres().iter().map(|s| s.center[0]).collect();
    assert_eq!(xs, [1.0, 2.0, 4.0]);
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

/// molly decodes the real file; its own walk over the streams must agree to the last atom.
#[test]
fn xtc_positions_are_inside_the_box_and_move() {
    let Some(loaded) = fetched("adk-water") else { return };
    let frames = loaded.animation.frames();
    let inside = |s: &Sphere| s.center.iter().all(|x| (-60.0..160.0).contains(x));
    assert!(frames.iter().all(|f| f.spheres().iter().all(inside)), "Angstrom, not nanometres");
    let spread = frames[0].spheres().iter().map(|s| s.center[0]).fold(0.0, f32::max);
    assert!(spread > 50.0, "the box is about 80 Angstrom wide, not 8: {spread}");
    assert_ne!(frames[0].spheres(), frames[9].spheres());
}

// ---- cut files keep their whole frames ----

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

// ---- broken files ----

/// Each broken file must be refused with a message that holds all the given parts.
fn refused(cases: &[(&str, Vec<u8>, &[&str])]) {
    assert!(cases.len() >= 10, "ten broken files at least");
    for (name, bytes, parts) in cases {
        let error = read_bytes(name, bytes, None).expect_err("a broken file");
        let message = error.to_string();
        for part in *parts {
            assert!(
                message.contains(part),
                "{name} {:?}\n  {message:?}\n  lacks {part:?}",
                String::from_utf8_lossy(bytes)
            );
        }
    }
}

fn text(s: impl AsRef<str>) -> Vec<u8> {
    s.as_ref().into()
}

#[test]
fn broken_pdb() {
    let with = |old: &str, new: &str| text(PDB.replacen(old, new, 1));
    refused(&[
        ("a.pdb", vec![], &["a.pdb", "empty"]),
        ("a.pdb", text(" \n\r\n"), &["a.pdb", "empty"]),
        ("a.pdb", vec![0x7f, b'E', b'L', b'F', 0, 1], &["a.pdb: byte 4 is zero", "PDB"]),
        ("a.pdb", text("REMARK nothing\nEND\n"), &["a.pdb", "no ATOM or HETATM"]),
        ("a.pdb", with("-12.735", "    nan"), &["a.pdb:2:36", "x is \"nan\"", "finite"]),
        ("a.pdb", with("38.918", "   inf"), &["a.pdb:2:44", "y is \"inf\""]),
        ("a.pdb", with("  31.287", "   1e400"), &["a.pdb:2:50", "z is \"1e400\""]),
        ("a.pdb", with("-12.735", "-12,735"), &["a.pdb:2:32", "x is \"-12,735\""]),
        ("a.pdb", with("  31.287", "        "), &["a.pdb:2:", "z is missing"]),
        ("a.pdb", text(&PDB[..PDB.find("38.918").expect("there")]), &["a.pdb:2:", "y is missing"]),
        ("a.pdb", text("ATOM"), &["a.pdb:1:5", "x is missing"]),
        ("a.pdb", text("MODEL 1\nENDMDL\n"), &["no ATOM or HETATM"]),
        ("a.pdb", text(&PDB[..PDB.find("ENDMDL").expect("there")]), &["no complete frame", "without ENDMDL"]),
        ("a.pdb", [b"ATOM  ".to_vec(), vec![0xff; 80]].concat(), &["a.pdb:1:31", "x is"]),
    ]);
}

#[test]
fn broken_xyz() {
    refused(&[
        ("a.xyz", vec![], &["empty"]),
        ("a.xyz", text("two\n\n"), &["a.xyz:1:1", "count of atoms is \"two\""]),
        ("a.xyz", text("-1\n\n"), &["a.xyz:1:1", "\"-1\""]),
        ("a.xyz", text("99999999999\n\nH 0 0 0\n"), &["a.xyz:1:1", "count of atoms is 99999999999", "left"]),
        ("a.xyz", text("99999999999999999999999\n\nH 0 0 0\n"), &["a.xyz:1:1", "99999999999999999999999"]),
        ("a.xyz", text("1\n\nH 0 0\n"), &["a.xyz:3:6", "z is missing"]),
        ("a.xyz", text("1\n\nH 0 nan 0\n"), &["a.xyz:3:5", "y is \"nan\""]),
        ("a.xyz", text("1\n\nH 0 0 -inf\n"), &["a.xyz:3:7", "z is \"-inf\""]),
        ("a.xyz", text("1\n\nH 1e39 0 0\n"), &["a.xyz:3:3", "x is \"1e39\""]),
        ("a.xyz", text("2\n\nH 0 0 0\n\n\n\n\n\n\n\n"), &["a.xyz:4:1", "element is missing"]),
        ("a.xyz", text("1\n\nH 0 0 0\n\n1\n\nH 0 0 0\n"), &["a.xyz:4:1", "count of atoms is missing"]),
        ("a.xyz", text("1\n\nH 0 0 0\nH 0 0 0\n"), &["a.xyz:4:1", "\"H\""]),
        ("a.xyz", text("1\nno atoms"), &["a.xyz", "no complete frame"]),
        ("a.xyz", vec![b'1', 0, 0], &["byte 1 is zero"]),
    ]);
}

/// The DCD sample with four bytes at a place put in.
fn dcd_with(at: usize, four: [u8; 4]) -> Vec<u8> {
    let mut bytes = dcd(false, true, 2, 0);
    bytes[at..at + 4].copy_from_slice(&four);
    bytes
}

#[test]
fn broken_dcd() {
    let whole = dcd(false, true, 2, 0);
    // Where things stand: first record 0..92, titles 92..184, atoms 184..196, cell 196..252, x 252..276.
    refused(&[
        ("a.dcd", vec![], &["empty"]),
        ("a.dcd", text("not a trajectory"), &["no complete frame", "16 bytes"]),
        ("a.dcd", vec![7; 200], &["byte 0: length of the first record"]),
        ("a.dcd", dcd_with(4, *b"VELD"), &["byte 4: magic word is VELD", "CORD"]),
        ("a.dcd", dcd(false, true, 2, 3), &["3 fixed atoms"]),
        ("a.dcd", dcd_with(88, 85_i32.to_le_bytes()), &["byte 88: length after a record is 85", "84"]),
        ("a.dcd", dcd_with(92, (-4_i32).to_le_bytes()), &["byte 92: length of a record is -4"]),
        ("a.dcd", dcd_with(92, i32::MAX.to_le_bytes()), &["byte 92: length of a record is 2147483647"]),
        ("a.dcd", dcd_with(188, 0_i32.to_le_bytes()), &["byte 188: number of atoms is 0"]),
        ("a.dcd", dcd_with(188, (-5_i32).to_le_bytes()), &["byte 188: number of atoms is -5"]),
        ("a.dcd", dcd_with(188, i32::MAX.to_le_bytes()), &["no complete frame", "25769803844 bytes"]),
        ("a.dcd", dcd_with(196, 47_i32.to_le_bytes()), &["byte 247: length after a record", "47"]),
        ("a.dcd", dcd_with(252, 4_i32.to_be_bytes()), &["byte 252: length of a record"]),
        ("a.dcd", dcd_with(256, f32::NAN.to_le_bytes()), &["byte 256: x is NaN"]),
        ("a.dcd", dcd_with(284, f32::INFINITY.to_le_bytes()), &["byte 284: y is inf"]),
        ("a.dcd", whole[..92].to_vec(), &["no complete frame", "byte 92"]),
        ("a.dcd", whole[..196].to_vec(), &["no complete frame", "ends after its header"]),
        ("a.dcd", whole[..300].to_vec(), &["no complete frame", "a frame needs 128 bytes, 104 are left"]),
    ]);
}

#[test]
fn broken_xtc() {
    let with = |at: usize, four: i32| {
        let mut bytes = packed_xtc(&[0; 24], 0, 15, 20, 12);
        bytes[at..at + 4].copy_from_slice(&four.to_be_bytes());
        bytes
    };
    let small = |at: usize, four: [u8; 4]| {
        let mut bytes = small_xtc();
        bytes[at..at + 4].copy_from_slice(&four);
        bytes
    };
    refused(&[
        ("a.xtc", vec![], &["empty"]),
        ("a.xtc", vec![0, 0], &["no complete frame", "2 bytes"]),
        ("a.xtc", text("this is a text and no trajectory"), &["byte 0: magic number is 1952999795"]),
        ("a.xtc", small(0, 1995_i32.to_le_bytes()), &["byte 0: magic number is"]),
        ("a.xtc", small_xtc()[..40].to_vec(), &["no complete frame"]),
        ("a.xtc", small(4, (-2_i32).to_be_bytes()), &["byte 4: number of atoms is -2"]),
        ("a.xtc", small(52, 3_i32.to_be_bytes()), &["byte 52: number of atoms is 3", "2, as in byte 4"]),
        ("a.xtc", small(56, f32::NAN.to_be_bytes()), &["byte 0: position", "NaN"]),
        ("a.xtc", small(60, 1e38_f32.to_be_bytes()), &["byte 0: position", "inf"]),
        ("b.xtc", with(56, 0), &["byte 0: position", "NaN"]),
        ("b.xtc", with(60, i32::MIN), &["bound -2147483648"]),
        ("b.xtc", with(60, 16), &["bounds 16 to 15"]),
        ("b.xtc", with(84, 0), &["width 0"]),
        ("b.xtc", with(84, 73), &["width 73"]),
        ("b.xtc", with(84, -1), &["width 4294967295"]),
        ("b.xtc", with(88, i32::MAX), &["no complete frame"]),
        ("b.xtc", with(88, 4), &["byte 0: compressed frame", "the stream has 32"]),
        // 13 bits of position, a flag, a run of none; then the width goes up from 72, or down from 9.
        ("b.xtc", packed_xtc(&[0, 0x04, 0x40, 0, 0, 0, 0, 0], 0, 15, 72, 12), &["width 73"]),
        ("b.xtc", packed_xtc(&[0, 0x04, 0x00, 0, 0, 0, 0, 0], 0, 15, 9, 12), &["width 8"]),
    ]);
    // Two counts that agree on 2^31 - 1 atoms.
    let mut many = with(4, i32::MAX);
    many[52..56].copy_from_slice(&i32::MAX.to_be_bytes());
    refused_one("b.xtc", &many, &["compressed frame", "the stream has 192"]);
}

fn refused_one(name: &str, bytes: &[u8], parts: &[&str]) {
    let message = read_bytes(name, bytes, None).expect_err("a broken file").to_string();
    assert!(parts.iter().all(|p| message.contains(p)), "{name}: {message:?} lacks one of {parts:?}");
}

#[test]
fn broken_nff() {
    refused(&[
        ("a.nff", vec![], &["empty"]),
        ("a.nff", text("b 0 0 0\n"), &["no sphere"]),
        ("a.nff", text("s 0 0 0 0\n"), &["a.nff:1:9", "radius is \"0\"", "above 0"]),
        ("a.nff", text("s 0 0 0 -1\n"), &["a.nff:1:9", "radius is \"-1\""]),
        ("a.nff", text("s 0 0 0 NaN\n"), &["a.nff:1:9", "radius is \"NaN\""]),
        ("a.nff", text("s 0 0 0 1e-60\n"), &["a.nff:1:9", "radius is \"1e-60\""]),
        ("a.nff", text("s 0 inf 0 1\n"), &["a.nff:1:5", "y is \"inf\""]),
        ("a.nff", text("\n s 0 0 0\n"), &["a.nff:2:9", "radius is missing"]),
        ("a.nff", text("b 1 1\n"), &["a.nff:1:6", "blue is missing"]),
        ("a.nff", text("f one 0 0\n"), &["a.nff:1:3", "red is \"one\""]),
        ("a.nff", text("l 1 2 z\n"), &["a.nff:1:7", "z is \"z\""]),
        ("a.nff", text("v\nfrom 0 0 x\n"), &["a.nff:2:10", "z is \"x\""]),
        ("a.nff", text("v\nresolution 0 5\n"), &["a.nff:2:12", "width is \"0\""]),
        ("a.nff", text("v\nresolution 16384 16384\n"), &["a.nff:2:18", "height is \"16384\""]),
        ("a.nff", text("p 99999999999999999999999\n"), &["a.nff:1:3", "vertices is"]),
        ("a.nff", text("p 99999999999\ns\n"), &["a.nff:2:2", "x is missing"]),
        ("a.nff", vec![b's', 0], &["byte 1 is zero"]),
    ]);
}

#[test]
fn broken_lammps() {
    let with = |old: &str, new: &str| text(LAMMPS.replacen(old, new, 1));
    refused(&[
        ("a.dump", vec![], &["empty"]),
        ("a.dump", text("1 2 3\n"), &["a.dump:1:1", "ITEM:"]),
        ("a.dump", with("\n0\nITEM: BOX", "\n-1\nITEM: BOX"), &["a.dump:4:1", "\"-1\""]),
        (
            "a.dump",
            with("\n0\nITEM: BOX", "\n99999999999\nITEM: BOX"),
            &["a.dump:4:1", "99999999999", "left"],
        ),
        ("a.dump", with("0 20", "0"), &["a.dump:8:2", "high bound is missing"]),
        ("a.dump", with("0 20", "0 nan"), &["a.dump:8:3", "high bound is \"nan\""]),
        ("a.dump", with(" z radius", " radius"), &["a.dump:9:", "position is missing"]),
        ("a.dump", with("3 0.5", "3 0"), &["a.dump:19:11", "radius is \"0\""]),
        ("a.dump", with("3 0.5", "3 -0.5"), &["a.dump:19:11", "radius is \"-0.5\""]),
        ("a.dump", with("1 2 3 0.5", "1 2 inf 0.5"), &["a.dump:19:9", "z is \"inf\""]),
        ("a.dump", with("1 2 3 0.5", "1 2 3"), &["a.dump:19:10", "radius is missing"]),
        ("a.dump", with("2 1 1 2 3", "x 1 1 2 3"), &["a.dump:19:1", "id is \"x\""]),
        ("a.dump", text("ITEM: TIMESTEP\n0\n"), &["no complete frame"]),
        ("a.dump", text("ITEM: ATOMS x y z\n1 2 3\n"), &["a.dump:1:", "count of atoms is missing"]),
        (
            "a.dump",
            text("ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS xs ys zs\n0.5 0.5 0.5\n"),
            &["a.dump:4:1", "BOX BOUNDS"],
        ),
        ("a.dump", vec![b'I', 0], &["byte 1 is zero"]),
    ]);
}

#[test]
fn broken_json() {
    let sample = json_sample();
    let with = |old: &str, new: &str| {
        assert!(sample.contains(old), "the sample has no {old}");
        text(sample.replacen(old, new, 1))
    };
    refused(&[
        ("a.json", vec![], &["empty"]),
        ("a.json", text("{"), &["a.json:1:1", "EOF"]),
        ("a.json", text("[1]"), &["a.json:1:"]),
        ("a.json", with("cgt-scene", "cgt-scent"), &["a.json:1:", "cgt-scent"]),
        ("a.json", with("\"version\": 1", "\"version\": 2"), &["a.json:1:", "version 2"]),
        (
            "a.json",
            with("3dcccccd", "3dcccccc"),
            &["a.json:4:", "dec 0.1 (bits 3dcccccd)", "3dcccccc", "disagree"],
        ),
        ("a.json", with("\"dec\": 1.5", "\"dec\": 1.25"), &["a.json:5:", "dec 1.25", "disagree"]),
        ("a.json", with("3dcccccd", "7fc00000"), &["a.json:4:", "NaN", "finite"]),
        ("a.json", with("3dcccccd", "7f800000"), &["a.json:4:", "inf", "finite"]),
        ("a.json", with("3dcccccd", "3dccccc"), &["a.json:4:", "eight hex digits"]),
        ("a.json", with("\"dec\": 0.1", "\"dec\": \"NaN\""), &["a.json:4:", "no number"]),
        (
            "a.json",
            with(
                "\"radius\": {\"dec\": 1.5, \"bits\": \"3fc00000\"}",
                "\"radius\": {\"dec\": 0.0, \"bits\": \"00000000\"}",
            ),
            &["a.json:5:", "radius 0.0"],
        ),
        ("a.json", with("\"color\"", "\"colour\""), &["a.json:4:", "unknown field `colour`"]),
        ("a.json", with("[255, 0, 9]", "[256, 0, 9]"), &["a.json:5:", "256"]),
        ("a.json", with("\"size\": [100, 99]", "\"size\": [0, 99]"), &["a.json:8:", "0x99"]),
        ("a.json", text(&sample[..sample.len() / 2]), &["a.json:", "EOF"]),
        ("a.json", text("{\"format\": \"cgt-scene\", \"version\": 1, \"frames\": []}"), &["frames is empty"]),
        ("a.json", text("{\"format\": \"cgt-scene\", \"version\": 1}"), &["missing field `frames`"]),
        ("a.json", text("[".repeat(100_000)), &["a.json:1:"]),
        ("a.json", vec![b'{', 0], &["byte 1 is zero"]),
    ]);
}

#[test]
fn broken_pov_gzip_and_names() {
    let mut corrupt = packed(XYZ.as_bytes());
    let last = corrupt.len() - 6;
    corrupt[last] ^= 0xff;
    let bomb = packed(&vec![b' '; 40 << 20]);
    let limit = gzip_limit(bomb.len()).to_string();
    refused(&[
        ("a.inc", text("nothing"), &["no line with a sphere"]),
        ("a.inc", text("sphere {<1,2>,R}"), &["a.inc:1:", "sphere is missing"]),
        ("a.inc", text("\nsphere {<1,nan,3>,R}"), &["a.inc:2:12", "y is \"nan\""]),
        ("a.inc", text("sphere {<1,2,3>,0}"), &["a.inc:1:17", "radius is \"0\""]),
        ("a.inc", text("sphere {<1,2,3>,nan}"), &["a.inc:1:17", "radius is \"nan\""]),
        ("a.inc", text("sphere {<1,2,3>,-R}"), &["a.inc:1:17", "radius is \"-R\""]),
        ("a.xyz.gz", corrupt, &["a.xyz.gz: gzip:"]),
        ("a.xyz.gz", bomb, &["unpack to more than", &limit]),
        ("a.xyz.gz", packed(b""), &["empty"]),
        ("a.png", text("x"), &["a.png", "extension \"png\""]),
        ("README", text("x"), &["README", "extension \"\""]),
    ]);
    let absent = read(Path::new("no/such/file.pdb")).expect_err("no such file");
    assert!(matches!(&absent, ReadError::Io { file, .. } if file == "no/such/file.pdb"), "{absent}");
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

// ---- round trip ----

fn bits(animation: &Animation) -> Vec<u32> {
    let all = animation.frames().iter().flat_map(|f| {
        let spheres = f.spheres().iter().flat_map(|s| [s.center[0], s.center[1], s.center[2], s.radius]);
        spheres.chain(f.light())
    });
    all.map(f32::to_bits).collect()
}

#[test]
fn json_round_trip_is_bit_for_bit() {
    let first = ok("a.json", json_sample().as_bytes());
    let again = ok("b.json", write::json(&first.animation, first.camera.as_ref()).as_bytes());
    assert_eq!(bits(&first.animation), bits(&again.animation), "a zero keeps its sign");
    assert_eq!((&first.animation, first.camera), (&again.animation, again.camera));
    assert_eq!(first.animation.frames()[0].spheres()[0].center[1].to_bits(), 0x8000_0000);
    assert_eq!(first.camera.map(|c| c.size()), Some(size(100, 99)));
    assert_eq!(first.camera(&Default::default()).ok(), first.camera, "a file's camera is used as it is");
    let mut random = seeded("json_round_trip_is_bit_for_bit");
    let mut any = || loop {
        let x = f32::from_bits(random.next_u32());
        if x.is_finite() {
            return x;
        }
    };
    let spheres = (0..20_000).map(|_| Sphere {
        center: [any(), any(), any()],
        radius: any().abs().max(f32::from_bits(1)),
        color: [1, 2, 3],
    });
    let scene = Scene::new(spheres.collect(), [1, 2, 3], DEFAULT_LIGHT).expect("valid");
    let animation = Animation::from(scene);
    let read_back = ok("a.json", write::json(&animation, None).as_bytes());
    assert_eq!(bits(&animation), bits(&read_back.animation));
}

// ---- anything at all ----

/// A fresh seed, printed; `CGT_SEED` sets it.
fn seeded(test: &str) -> Pcg64 {
    let fresh = || {
        let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
        now.map_or(1, |d| d.as_nanos() as u64)
    };
    let set = std::env::var("CGT_SEED").ok().and_then(|s| s.parse().ok());
    let seed = set.unwrap_or_else(fresh);
    eprintln!("{test}: CGT_SEED={seed}");
    Pcg64::seed_from_u64(seed)
}

/// Flips, cuts, doubles and overwrites.
fn mutated(random: &mut Pcg64, bytes: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    let mut below = |n: usize| (random.next_u64() % n.max(1) as u64) as usize;
    for _ in 0..1 + below(4) {
        if out.is_empty() {
            break;
        }
        let at = below(out.len());
        match below(6) {
            0 => out[at] ^= 1 << below(8),
            1 => out[at] = b"\0\x01\x7f\x80\xff0 9-.eni\n"[below(14)],
            2 => out.truncate(at),
            3 => {
                let end = at + below(out.len() - at);
                let piece = out[at..end].to_vec();
                out.splice(at..at, piece);
            }
            4 => {
                out.drain(at..at + below(out.len() - at));
            }
            _ => {
                let big: &[u8] =
                    [&b"99999999999"[..], b"-1", b"nan", &[0x7f, 0xff, 0xff, 0xff], &[0xff; 4]][below(5)];
                let end = (at + big.len()).min(out.len());
                out.splice(at..end, big.iter().copied());
            }
        }
    }
    out
}

#[test]
fn nothing_makes_a_reader_panic() {
    let mut random = seeded("nothing_makes_a_reader_panic");
    let (mut read, mut refused) = (0_u32, 0_u32);
    for (name, bytes) in samples() {
        for round in 0..4_000 {
            let broken = mutated(&mut random, &bytes);
            let result = std::panic::catch_unwind(|| read_bytes(name, &broken, None));
            match result {
                Ok(Ok(_)) => read += 1,
                Ok(Err(_)) => refused += 1,
                Err(_) => panic!("{name}, round {round}: panicked on {broken:02x?}"),
            }
        }
    }
    eprintln!("{read} read, {refused} refused");
    assert!(read > 1_000 && refused > 10_000, "mutations must both spare and break files: {read}, {refused}");
}

/// The decoder of XTC trusts its stream; the real file's streams, broken at random, must not get through to it.
#[test]
fn broken_xtc_streams_do_not_reach_the_decoder() {
    let path = catalogue::folder().join("adk_oplsaa.xtc");
    let Ok(whole) = std::fs::read(path) else {
        eprintln!("not judged: adk_oplsaa.xtc: data absent (run {})", catalogue::FETCH);
        return;
    };
    let mut random = seeded("broken_xtc_streams_do_not_reach_the_decoder");
    let length = i32::from_be_bytes([whole[88], whole[89], whole[90], whole[91]]);
    let frame = 92 + usize::try_from(length).expect("positive").next_multiple_of(4);
    let (mut read, mut refused) = (0, 0);
    for round in 0..200_u64 {
        let mut broken = whole[..frame].to_vec();
        // Every fourth time in the header, else in the stream.
        let (start, end) = if round.is_multiple_of(4) { (0, 92) } else { (92, frame as u64) };
        for _ in 0..1 + random.next_u64() % 3 {
            let at = (start + random.next_u64() % (end - start)) as usize;
            broken[at] ^= 1 << (random.next_u64() % 8);
        }
        match std::panic::catch_unwind(|| read_bytes("a.xtc", &broken, None).map(|_| ())) {
            Ok(Ok(())) => read += 1,
            Ok(Err(_)) => refused += 1,
            Err(_) => panic!("round {round} panicked"),
        }
    }
    eprintln!("{read} read, {refused} refused");
    assert!(read > 10 && refused > 10, "some must reach the decoder and some not: {read}, {refused}");
}

/// Streams of random bits behind random headers: what the walk lets through, the decoder must decode.
#[test]
fn random_xtc_streams_do_not_make_the_decoder_panic() {
    let mut random = seeded("random_xtc_streams_do_not_make_the_decoder_panic");
    let (mut read, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let mut below = |n: u64| random.next_u64() % n;
        let low = (below(2 << 28) as i32 - (1 << 28)) >> below(29);
        let high = low.saturating_add(((below(1 << 30) as i32) >> below(30)).max(0));
        let (width, atoms) = (9 + below(64) as i32, 10 + below(30) as i32);
        // Mostly clear bits make short runs.
        let sparse = below(3);
        let stream: Vec<u8> =
            (0..below(1_200)).map(|_| (0..sparse).fold(255, |b, _| b & below(256) as u8)).collect();
        let bytes = packed_xtc(&stream, low, high, width, atoms);
        match std::panic::catch_unwind(|| read_bytes("a.xtc", &bytes, None).map(|_| ())) {
            Ok(Ok(())) => read += 1,
            Ok(Err(_)) => refused += 1,
            Err(_) => panic!("low {low}, high {high}, width {width}, {atoms} atoms, stream {stream:02x?}"),
        }
    }
    eprintln!("{read} read, {refused} refused");
    assert!(read > 1_000 && refused > 1_000, "{read} read, {refused} refused");
}

// ---- the catalogue ----

#[test]
fn words_stand_for_sources() {
    let good = [
        "1hvr",
        "1HVR",
        "2juy",
        "adk",
        "sphereflake",
        "sphereflake:2",
        "uniform:10",
        "uniform:10:3",
        "lattice:4",
    ];
    for word in good {
        Source::parse(word).unwrap_or_else(|e| panic!("{word}: {e}"));
    }
    let pair = Source::parse("some/run.dcd,some/atoms.pdb").expect("a path");
    assert!(matches!(&pair, Source::File { path, atoms: Some(a) }
        if path == Path::new("some/run.dcd") && a == Path::new("some/atoms.pdb")));
    for (word, parts) in [
        ("nothing", &["nothing", "1hvr", "sphereflake:LEVELS"][..]),
        ("uniform", &["count is \"\""]),
        ("uniform:x", &["count is \"x\""]),
        ("uniform:1:-1", &["seed is \"-1\""]),
        ("uniform:1:2:3", &["end is \"3\""]),
        ("lattice:3:1", &["end is \"1\""]),
    ] {
        let message = Source::parse(word).expect_err("no scene").to_string();
        assert!(parts.iter().all(|p| message.contains(p)), "{word}: {message}");
    }
    let too_many = Source::parse("uniform:99999999999").expect("well formed").load().expect_err("too many");
    assert!(matches!(too_many, SourceError::Generate(_)), "{too_many}");
}

#[test]
fn absent_data_says_how_to_get_it() {
    let nowhere = Path::new("no/such/folder");
    let mut absent = 0;
    for entry in ENTRIES {
        match (entry.data, entry.load(nowhere)) {
            (Data::Bundled(..), loaded) => assert!(loaded.is_ok(), "{} needs no folder", entry.name),
            (_, Err(SourceError::DataAbsent { name, how })) => {
                assert_eq!((name, how), (entry.name, catalogue::FETCH));
                absent += 1;
            }
            (_, other) => panic!("{}: {other:?}", entry.name),
        }
    }
    assert_eq!(absent, 7);
    assert_eq!(catalogue::list().len(), ENTRIES.len() + 4);
}

#[test]
fn elements_are_those_of_bondi() {
    for (symbol, number, radius) in
        [("H", 1, 1.20), ("C", 6, 1.70), ("N", 7, 1.55), ("O", 8, 1.52), ("P", 15, 1.80), ("S", 16, 1.80)]
    {
        let element = elements::by_symbol(symbol).expect("in the table");
        assert_eq!((element.number, element.radius), (number, radius), "{symbol}");
    }
    let all = elements::all();
    assert!(all.windows(2).all(|w| w[0].number < w[1].number), "sorted, none twice");
    assert!(all.iter().all(|e| e.radius > 1.0 && e.radius < 4.0));
    assert_eq!(elements::by_symbol("d").map(|e| e.symbol), Some("H"));
    assert_eq!(elements::by_symbol("Qq"), None);
}
