//! Real files, bundled or fetched, read whole: counts, first atoms, hashes.

use crate::samples::not_judged;
use contract::Sphere;
use sha2::{Digest, Sha256};
use verify::scenes::catalogue::{self, Data, ENTRIES, Source, SourceError};
use verify::scenes::elements;
use verify::scenes::read::{Loaded, read, read_bytes};

/// Spheres frame by frame.
fn counts(loaded: &Loaded) -> Vec<usize> {
    loaded.animation.frames().iter().map(|f| f.spheres().len()).collect()
}

/// A fetched entry, or `None` and a line on stderr.
fn fetched(name: &str) -> Option<Loaded> {
    let entry = ENTRIES.iter().find(|e| e.name == name).expect("an entry of the catalogue");
    match entry.load(&catalogue::folder()) {
        Ok(loaded) => Some(loaded),
        Err(SourceError::DataAbsent { name, .. }) => {
            not_judged(name);
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
        let counts = counts(&loaded);
        assert_eq!(counts.iter().max(), Some(&entry.spheres), "{}", entry.name);
        assert_eq!(counts.len(), entry.frames, "{}", entry.name);
        let same = counts.iter().all(|&n| n == entry.spheres);
        assert_eq!(same, entry.name != "pour", "{}: {counts:?}", entry.name);
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
    let table = include_str!("../data/README.md");
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
        not_judged("adk_open.pdb");
        return;
    }
    let loaded = read(&path).expect("a real file");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    // Names are justified to the left there, so that 214 alpha carbons stand where calcium would.
    let calcium = elements::by_symbol("Ca").expect("in the table").radius;
    assert!(loaded.animation.frames()[0].spheres().iter().all(|s| s.radius != calcium));
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

/// The lines of atoms of a dump as they stand, frame by frame: id, x, y, z, radius.
fn rows(text: &str) -> Vec<Vec<(u64, [f32; 4])>> {
    let frames = text.split("ITEM: TIMESTEP\n").skip(1);
    let row = |line: &str| {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |i: usize| words[i].parse().expect("a number");
        (words[0].parse().expect("an id"), [number(2), number(3), number(4), number(5)])
    };
    frames
        .map(|frame| {
            let (_, atoms) = frame.split_once("ITEM: ATOMS id type x y z radius\n").expect("a head");
            atoms.lines().map(row).collect()
        })
        .collect()
}

#[test]
fn a_pour_begins_with_nothing_and_grows() {
    let Some(loaded) = fetched("pour") else { return };
    let counts = counts(&loaded);
    assert_eq!((counts[0], counts[1] > 0, counts[50]), (0, true, 3_000), "{counts:?}");
    assert!(counts.is_sorted(), "none is lost: {counts:?}");
    let mut sizes = counts.clone();
    sizes.dedup();
    assert!(sizes.len() > 5, "poured bit by bit: {sizes:?}");
    let frames = loaded.animation.frames();
    assert_ne!(frames[49].spheres(), frames[50].spheres(), "it moves after all is poured");
    assert!(loaded.warnings.is_empty(), "radii are given, so none is guessed: {:?}", loaded.warnings);
}

/// The dump's own lines, sorted by id, are the spheres to the bit; and its radii are what the column says, not the
/// reader's guess, which is the same 0.5: called diameters, they are half as large.
#[test]
fn spheres_of_a_pour_are_the_lines_of_the_dump() {
    let Some(loaded) = fetched("pour") else { return };
    let packed = std::fs::read(catalogue::folder().join("pour.lammpstrj.gz")).expect("it was just read");
    let text = std::io::read_to_string(flate2::read::GzDecoder::new(&packed[..])).expect("text in gzip");
    let (mut rows, mut unsorted) = (rows(&text), 0);
    assert_eq!(rows.len(), loaded.animation.frames().len());
    for (rows, frame) in rows.iter_mut().zip(loaded.animation.frames()) {
        unsorted += usize::from(!rows.is_sorted_by_key(|row| row.0));
        rows.sort_by_key(|row| row.0);
        let read = frame.spheres().iter().map(|s| [s.center[0], s.center[1], s.center[2], s.radius]);
        assert!(read.map(|s| s.map(f32::to_bits)).eq(rows.iter().map(|row| row.1.map(f32::to_bits))));
    }
    assert!(unsorted > 0, "LAMMPS writes in the order of its cells, so that sorting is at stake");
    let halved = read_bytes("halved.lammpstrj", text.replace("z radius", "z diameter").as_bytes(), None);
    let halved = halved.expect("the same but for a word");
    let radii = |loaded: &Loaded| -> Vec<f32> {
        loaded.animation.frames().iter().flat_map(|f| f.spheres().iter().map(|s| s.radius)).collect()
    };
    let (whole, halved) = (radii(&loaded), radii(&halved));
    assert!(whole.iter().map(|r| r / 2.0).eq(halved), "halves");
}
