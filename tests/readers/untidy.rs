//! Files as programs write them: read whole in spite of their habits, and what is passed over is told.

use crate::samples::*;
use verify::scenes::read::{Loaded, ReadError, read_bytes};

/// The x of each sphere of the first frame.
fn xs(loaded: &Loaded) -> Vec<f32> {
    loaded.animation.frames()[0].spheres().iter().map(|s| s.center[0]).collect()
}

/// Line and text of each warning.
fn told(loaded: &Loaded) -> Vec<(Option<usize>, &str)> {
    loaded.warnings.iter().map(|w| (w.line, w.text.as_str())).collect()
}

/// Is a line over at a CR alone as at LF, and at CR CR LF once? Scenes, lines of warnings, and line and column of an error are the same.
#[test]
fn lines_end_in_any_way() {
    let ends = ["\n", "\r", "\r\n", "\r\r\n"];
    let texts = [("a.pdb", PDB), ("a.xyz", XYZ), ("a.nff", NFF), ("a.lammpstrj", LAMMPS), ("a.inc", POV)];
    for (name, text) in texts {
        let plain = ok(name, text.as_bytes());
        for end in ends {
            let other = ok(name, text.replace('\n', end).as_bytes());
            assert_eq!(other.animation, plain.animation, "{name}, lines end in {end:?}");
            assert_eq!(other.warnings, plain.warnings, "{name}, lines end in {end:?}");
        }
    }
    for end in ends {
        let text = "s 0 0 0 1\ns 3 0 0 1\n\ns 0 inf 0 1\n".replace('\n', end);
        let error = read_bytes("a.nff", text.as_bytes(), None).expect_err("y is infinite").to_string();
        assert!(error.starts_with("a.nff:4:5: y is \"inf\""), "lines end in {end:?}: {error}");
    }
    assert_eq!(
        xs(&ok("a.nff", b"s 1 0 0 1\rs 2 0 0 1\r\ns 3 0 0 1\ns 4 0 0 1")),
        [1.0, 2.0, 3.0, 4.0],
        "mixed"
    );
}

/// An atom of a PDB file: columns 1-11, name, location, residue, columns 22-27, and x.
fn atom(head: &str, name: &str, location: char, residue: &str, place: &str, x: f32) -> String {
    format!("{head:11} {name:4}{location}{residue:4}{place:9}{x:8.3}   0.000   0.000\n")
}

/// Are atoms read whose serial number leaves no blank before it, or runs into the name of the record, and no other records?
#[test]
fn serials_above_99_999_are_atoms() {
    let heads = ["ATOM  99999", "ATOM 100000", "ATOM1000000", "HETATM99999", "HETAT100000", "HETA1000000"];
    let others = ["ANISOU99999", "ANISO100000", "TER  100002"];
    let records = (0_u8..).zip(heads.into_iter().chain(others));
    let text: String =
        records.map(|(x, head)| atom(head, " CA", ' ', "SER", "A   7", f32::from(x))).collect();
    let loaded = ok("a.pdb", text.as_bytes());
    assert_eq!(xs(&loaded), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(told(&loaded), []);
}

/// Where two residues share a place, is one of them kept whole and nothing of the other? Places differ by chain, number and insertion
/// code, and atoms without a location are no alternates, whatever else has their place.
#[test]
fn of_residues_in_one_place_the_first_is_kept() {
    let atom = |location, name, residue, place, x| atom("ATOM      1", name, location, residue, place, x);
    let text = [
        atom('A', " CB", "SER", "A   7", 1.0),
        atom('A', " OG", "SER", "A   7", 2.0),
        atom('B', " CB", "CYS", "A   7", 3.0),
        atom('B', " SG", "CYS", "A   7", 4.0),
        atom(' ', " O", "HOH", "A   7", 5.0),
        atom('B', " SG", "CYS", "A   8", 6.0),
        atom('B', " SG", "CYS", "A   7A", 7.0),
        atom('B', " SG", "CYS", "B   7", 8.0),
        atom('A', " OG", "SER", "B   7", 9.0),
    ]
    .concat();
    let loaded = ok("a.pdb", text.as_bytes());
    assert_eq!(xs(&loaded), [1.0, 2.0, 5.0, 6.0, 7.0, 8.0]);
    assert_eq!(told(&loaded), [(None, "3 atoms at alternate locations left out")]);
}

/// Does END alone end a frame, as VMD writes trajectories, after MODEL too?
#[test]
fn frames_of_a_pdb_may_end_in_end_alone() {
    let one = |x: f32| atom("ATOM      1", " CA", ' ', "SER", "A   7", x);
    for (first, between, last) in
        [("", "END\n", "END\n"), ("", "END\n", ""), ("MODEL 1\n", "END\nMODEL 2\n", "END\n")]
    {
        let text = [first, &one(1.0), between, &one(2.0), &one(3.0), last].concat();
        let loaded = ok("a.pdb", text.as_bytes());
        assert_eq!(frame_sizes(&loaded), [1, 2], "{between:?} between, {last:?} at the end");
        assert_eq!(told(&loaded), [], "{between:?} between, {last:?} at the end");
    }
}

/// Are the columns of extended XYZ taken from where its comment names them, frame by frame, and is a file refused that names no element
/// or no position?
#[test]
fn columns_of_extended_xyz_are_those_named() {
    let text = "\
2
Lattice=\"9 0 0 0 9 0 0 0 9\" Properties=id:I:1:type:I:1:pos:R:3:move_mask:L:2:species:S:1 Time=0
1 9 0.5 0.6 0.7 T F O
2 9 1 2 3 F F 1
1
properties=\"species:S:1:pos:R:3:forces:R:3\"
S 4 5 6 7 8 9
1
plain
C 7 8 9
";
    let loaded = ok("a.xyz", text.as_bytes());
    let spheres = loaded.animation.frames().iter().flat_map(contract::Scene::spheres);
    let found: Vec<_> = spheres.map(|s| (s.radius, s.center)).collect();
    let want =
        [(1.52, [0.5, 0.6, 0.7]), (1.20, [1.0, 2.0, 3.0]), (1.80, [4.0, 5.0, 6.0]), (1.70, [7.0, 8.0, 9.0])];
    assert_eq!(found, want);
    assert_eq!(told(&loaded), []);
    for names in [
        "id:I:1:type:I:1:pos:R:3",
        "species:S:1:id:I:1",
        "species:S:1:pos:R:2",
        "species:S:1:pos:I:3",
        "species:S:2:pos:R:3",
        "species:S:1:pos:R:3:id",
        "species:S:1:pos:R:-3",
        "",
    ] {
        let text = format!("1\n Properties={names}\n1 1 0.5 0.6 0.7\n");
        match read_bytes("a.xyz", text.as_bytes(), None) {
            Err(ReadError::Value { place, field: "Properties", value, .. }) => {
                assert_eq!((place.line, place.column, value), (2, 2, format!("Properties={names}")));
            }
            other => panic!("{names}: {other:?}"),
        }
    }
}

/// Is what is commented out not drawn, and what is beside a comment drawn? Comments stand in each other, and none begins in a string.
/// Spheres that stand within a line, and a comment without an end, are told.
#[test]
fn povray_comments_are_no_spheres_and_spheres_within_a_line_are_told() {
    let text = r#"// sphere {<0,0,0>,1}
sphere {<1,0,0>,1} // {<of,radius>,1}
union { sphere {<2,0,0>,1} }
/* sphere {<3,0,0>,1}
sphere {<4,0,0>,1}
/* within */ sphere {<5,0,0>,1}
*/ sphere {<6,0,0>,1}
#debug "/* a \" sphere // \\"
/* a */ sphere /* b */ {<7,0,0>,/* c */ 1}
sphere_sweep { } sky_sphere { } // sphere {
#declare S = sphere
sphere {<8,0,0>,1}
 /*
sphere {<9,0,0>,1}
"#;
    let loaded = ok("a.inc", text.as_bytes());
    assert_eq!(xs(&loaded), [1.0, 6.0, 7.0, 8.0]);
    let want = [
        (Some(3), "2 lines with a sphere that do not begin with it passed over"),
        (Some(13), "a comment that does not end; what follows is passed over"),
    ];
    assert_eq!(told(&loaded), want);
    // What stands within braces of an earlier line may be moved there, or cut.
    let text = b"sphere {<1,0,0>,1}\nunion {\nsphere {<2,0,0>,1}\n#debug \"}\" // }\nsphere {<3,0,0>,1}\n  \
                 translate x*9 }\n}\nsphere {<4,0,0>,1}\n";
    let loaded = ok("a.inc", text);
    assert_eq!(xs(&loaded), [1.0, 2.0, 3.0, 4.0]);
    let told = told(&loaded);
    let [(Some(3), warning)] = told[..] else { panic!("{told:?}") };
    assert!(warning.starts_with("2 spheres within braces"), "{warning}");
    let error =
        read_bytes("a.inc", b"/* , */ sphere {<1,nan,3>,1}", None).expect_err("no number").to_string();
    assert!(error.starts_with("a.inc:1:20: y is \"nan\""), "columns are those of the file: {error}");
}

/// Are colours of lights and reflectances told of, where they are not what is drawn anyway?
#[test]
fn nff_is_white_and_matte_or_it_is_told() {
    let text = "f 1 0 0 0.8 0 0 0 0\nl 0 0 1 1 0.5 1\nf 1 1 1 1 1 7 1 1\ns 0 0 0 1\n";
    let light = (Some(2), "the light's colour passed over: it is drawn white");
    let fill = |line| (Some(line), "a reflectance passed over, the first: all is drawn matte");
    assert_eq!(told(&ok("a.nff", text.as_bytes())), [light, fill(1)]);
    let plain = "f 1 0 0\nl 0 0 1 1 1 1\nf 1 0 0 1 0 7 0 1\nf 1 1 1 1\ns 0 0 0 1\n";
    assert_eq!(told(&ok("a.nff", plain.as_bytes())), []);
    for reflectance in ["0.8", "1 0.5", "1 0 0 0.5", "one"] {
        let text = format!("s 0 0 0 1\nf 1 0 0 {reflectance}\n");
        assert_eq!(told(&ok("a.nff", text.as_bytes())), [fill(2)], "{reflectance}");
    }
}

/// Are scaled positions refused if any one side of their box is tilted, and only then?
#[test]
fn scaled_positions_in_a_skewed_box_are_refused() {
    let dump = |[xy, xz, yz]: [f32; 3], columns: &str| {
        let head = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n";
        let bounds = format!("0 10 {xy}\n0 10 {xz}\n0 10 {yz}\n");
        format!("{head}{bounds}ITEM: ATOMS {columns} radius\n0.5 0.5 0.5 1\n")
    };
    let center = |text: String| ok("a.dump", text.as_bytes()).animation.frames()[0].spheres()[0].center;
    for tilt in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1e-3, 0.0], [1.0; 3]] {
        let error =
            read_bytes("a.dump", dump(tilt, "xs ys zs").as_bytes(), None).expect_err("skewed").to_string();
        assert!(
            error.starts_with("a.dump:10:1: x is \"0.5\"") && error.contains("not skewed"),
            "{tilt:?}: {error}"
        );
        assert_eq!(center(dump(tilt, "x y z")), [0.5; 3], "{tilt:?}: positions that are not scaled");
    }
    assert_eq!(center(dump([0.0; 3], "xs ys zs")), [5.0; 3], "no tilt");
}

/// Is the fourth record of each frame passed over where integer 12 of the header says that there is one? Without, the next frame would begin
/// with it.
#[test]
fn a_fourth_dimension_of_a_dcd_is_passed_over() {
    for cell in [false, true] {
        let three = dcd(false, cell, 2, 0);
        let (header, frames) = three.split_at(196);
        let mut four = header.to_vec();
        // Length and `CORD` come before the integers.
        four[4 + 4 * 12] = 1;
        for frame in frames.chunks(frames.len() / 2) {
            four.extend(frame);
            four.extend([16_i32.to_le_bytes(), 7_f32.to_le_bytes(), 7_f32.to_le_bytes()].concat());
            four.extend([7_f32.to_le_bytes(), 7_f32.to_le_bytes(), 16_i32.to_le_bytes()].concat());
        }
        let (three, four) = (ok("a.dcd", &three), ok("a.dcd", &four));
        assert_eq!(frame_sizes(&four), [4, 4], "cell {cell}");
        assert_eq!(four.animation, three.animation, "cell {cell}");
        assert_eq!(four.warnings, three.warnings, "cell {cell}");
    }
}

/// Is a file of two gzip members, as bgzip and `cat a.gz b.gz` make them, the whole of both?
#[test]
fn all_members_of_a_gzip_are_read() {
    for at in [XYZ.find("0\nempty").expect("there"), XYZ.find("third").expect("there")] {
        let (first, second) = XYZ.as_bytes().split_at(at);
        let loaded = ok("a.xyz.gz", &[packed(first), packed(second)].concat());
        let whole = ok("a.xyz.gz", &packed(XYZ.as_bytes()));
        assert_eq!(frame_sizes(&loaded), [2, 0, 1], "cut at {at}");
        assert_eq!((&loaded.animation, &loaded.warnings), (&whole.animation, &whole.warnings), "cut at {at}");
    }
}

/// Does who reads a trajectory hear what was passed over in the file of its atoms?
#[test]
fn warnings_about_atoms_reach_who_reads_the_trajectory() {
    let xyz = "4\n\nH 0 0 0\nXx 0 0 0\nS 0 0 0\nC 0 0 0\n";
    let two = xyz.replace('4', "2").replace("S 0 0 0\nC 0 0 0\n", "");
    for (name, bytes, atoms) in [("a.dcd", dcd(false, false, 2, 0), xyz), ("a.xtc", small_xtc(), &two)] {
        let loaded = read_bytes(name, &bytes, Some(("b.xyz", atoms.as_bytes()))).expect("as many atoms");
        let of_atoms: Vec<_> = loaded.warnings.iter().filter(|w| w.file == "b.xyz").collect();
        assert_eq!(of_atoms.len(), 1, "{name}: {:?}", loaded.warnings);
        assert_eq!(of_atoms[0].line, Some(4), "{name}: where Xx stands");
        assert!(of_atoms[0].text.contains("\"Xx\""), "{name}: {}", of_atoms[0]);
    }
}
