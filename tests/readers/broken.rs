//! Broken files, ten and more of each format, each refused by a message with place and value.

use crate::samples::*;
use std::path::Path;
use verify::scenes::read::{ReadError, gzip_limit, read, read_bytes};

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
        // Nine atoms take more than the nine bytes that are left.
        ("a.xyz", text("9\n\nH 0 0 0\n"), &["a.xyz:1:1", "count of atoms is 9", "left"]),
        ("a.xyz", text("1\n\nH 0 0\n"), &["a.xyz:3:6", "z is missing"]),
        ("a.xyz", text("1\n\nH 0 nan 0\n"), &["a.xyz:3:5", "y is \"nan\""]),
        ("a.xyz", text("1\n\nH 0 0 -inf\n"), &["a.xyz:3:7", "z is \"-inf\""]),
        ("a.xyz", text("1\n\nH 1e39 0 0\n"), &["a.xyz:3:3", "x is \"1e39\""]),
        ("a.xyz", text("2\n\nH 0 0 0\n\n\n\n\n\n\n\n"), &["a.xyz:4:1", "element is missing"]),
        ("a.xyz", text("1\n\nH 0 0 0\n \n\nO 0 0 0\n"), &["a.xyz:6:1", "count of atoms is \"O\""]),
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
    // A record of x that is too short, with one of y that makes up for it, and lengths that agree.
    let mut uneven = whole.clone();
    for (at, length) in [(252, 8_u8), (264, 8), (268, 24), (296, 24)] {
        uneven[at..at + 4].copy_from_slice(&[length, 0, 0, 0]);
    }
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
        ("a.dcd", uneven, &["byte 252: length of a record of coordinates is 8", "16"]),
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
        // The two zeros are equal and not the same.
        ("a.json", with("80000000", "00000000"), &["a.json:", "dec -0.0 (bits 80000000)", "disagree"]),
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
