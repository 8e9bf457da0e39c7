//! Real files, bundled or fetched, read whole: counts, first atoms, hashes.

use crate::samples::not_judged;
use contract::Sphere;
use sha2::{Digest, Sha256};
use verify::scenes::catalogue::{self, Data, ENTRIES, Source, SourceError};
use verify::scenes::elements;
use verify::scenes::read::{Loaded, read};

fn counts(loaded: &Loaded) -> (usize, usize) {
    (loaded.animation.frames()[0].spheres().len(), loaded.animation.frames().len())
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
