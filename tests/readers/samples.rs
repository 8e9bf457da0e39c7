//! A small file of every format, as text or made byte by byte.

use contract::{Animation, Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use std::io::Write as _;
use verify::scenes::read::{Loaded, read_bytes};
use verify::scenes::write;

pub(crate) const PDB: &str = "\
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
pub(crate) const XYZ: &str = "2\nfirst\nO 0 0 0\n1 0.96 0 0\n0\nempty\n1\nthird\nXx 1 2 3 9 9\n";
pub(crate) const NFF: &str = "\
# a comment
b 0.5 0 1
v
from 1 2 3
at 1 2 4
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
pub(crate) const LAMMPS: &str = "\
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
pub(crate) const POV: &str = "#default\nsphere {<1,2,3>,0.5}\n sphere{ < -1.5 , 2 , 0 > , R }\n";

/// A DCD of two frames of four atoms in either byte order; atom i of frame f stands at (i, f, -1.5).
pub(crate) fn dcd(big: bool, cell: bool, promised: i32, fixed: i32) -> Vec<u8> {
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
pub(crate) fn small_xtc() -> Vec<u8> {
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
pub(crate) fn packed_xtc(stream: &[u8], low: i32, high: i32, width: i32, atoms: i32) -> Vec<u8> {
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

pub(crate) fn json_sample() -> String {
    let spheres = vec![
        Sphere { center: [0.1, -0.0, 1e30], radius: 1e-45, color: [1, 2, 3] },
        Sphere { center: [f32::MAX, f32::MIN_POSITIVE, 16_777_216.0], radius: 1.5, color: [255, 0, 9] },
    ];
    let frame = Scene::new(spheres, [7, 8, 9], [0.3, -0.4, 0.5]).expect("valid");
    let empty = Scene::new(Vec::new(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let camera = Camera::new([0.1; 3], [-1.0, 1.0, -2.0], [0.02, 0.0, 0.0], [0.0, -0.02, 0.0], size(100, 99));
    write::json(&Animation::new(vec![frame, empty]).expect("frames"), Some(&camera.expect("valid")))
}

pub(crate) fn size(width: u32, height: u32) -> Size {
    Size::new(width, height).expect("valid")
}

pub(crate) fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut out = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    out.write_all(bytes).expect("to memory");
    out.finish().expect("to memory")
}

/// Name and bytes of each sample; more than one frame where the format has frames.
pub(crate) fn samples() -> Vec<(&'static str, Vec<u8>)> {
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

pub(crate) fn ok(name: &str, bytes: &[u8]) -> Loaded {
    read_bytes(name, bytes, None).unwrap_or_else(|e| panic!("{e}"))
}

pub(crate) fn frame_sizes(loaded: &Loaded) -> Vec<usize> {
    loaded.animation.frames().iter().map(|f| f.spheres().len()).collect()
}

/// Says past the capture of test output that a real file is absent.
pub(crate) fn not_judged(what: &str) {
    let line = format!("not judged: {what}: data absent (run {})\n", verify::scenes::catalogue::FETCH);
    std::io::stderr().write_all(line.as_bytes()).expect("stderr");
}
