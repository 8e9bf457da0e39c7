//! Do readers keep to ten times their input and 64 MB, whatever they are given? Every byte on the heap is counted, in a program of its
//! own with one test, so that nothing else is.

#[path = "readers/samples.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod samples;

use peak_alloc::PeakAlloc;
use rand::RngExt;
use samples::{packed, packed_xtc, samples};
use std::path::Path;
use verify::fuzzed::TARGETS;
use verify::scenes::read::read_bytes;
use verify::seed::{generator, seed};

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

const MB: usize = 1 << 20;

/// Just so much that it is accepted of a packed file, however few bytes that has.
const UNPACKED: usize = 15 * MB;

/// A name, and bytes that are made when they are needed.
struct Case {
    name: String,
    bytes: Box<dyn Fn() -> Vec<u8>>,
}

fn case(name: &str, bytes: impl Fn() -> Vec<u8> + 'static) -> Case {
    Case { name: name.into(), bytes: Box::new(bytes) }
}

/// The names by which a target of `verify::fuzzed` has its bytes read.
const READERS: [(&str, &str); 8] = [
    ("dcd", "dcd"),
    ("json", "json"),
    ("lammps", "lammpstrj"),
    ("nff", "nff"),
    ("pdb", "pdb"),
    ("pov", "inc"),
    ("xtc", "xtc"),
    ("xyz", "xyz"),
];

/// A line again and again.
fn lines(head: &str, line: &str, times: usize) -> Vec<u8> {
    let mut out = head.as_bytes().to_vec();
    out.extend(line.as_bytes().repeat(times));
    out
}

/// Digits that pack to about half their size.
fn digits(bytes: usize) -> Vec<u8> {
    let mut rng = generator(1, 0);
    (0..bytes).map(|_| b'0' + rng.random_range(0..10u8)).collect()
}

/// The densest plain files: the shortest lines, atoms of the fewest bits, frames without spheres.
fn dense() -> Vec<Case> {
    let mut cases = vec![
        case("spheres.nff", || lines("", "s 1 1 1 1\n", 3 * MB / 2)),
        case("spheres.inc", || lines("", "sphere {<1,1,1>,1}\n", MB)),
        case("atoms.xyz", || lines("1000000\n\n", "H 1 1 1\n", 1_000_000)),
        case("frames.xyz", || lines("", "0\n\n", 5 * MB)),
        case("atoms.pdb", || {
            let line = "ATOM      1  N   PRO A   1     -12.735  38.918  31.287\n";
            lines("", line, MB / 2)
        }),
        case("places.pdb", || {
            let atom = |i: usize| {
                format!("ATOM      1 {:04x}APRO A{:05x}    1.0     1.0     1.0  \n", i & 0xffff, i)
            };
            (0..MB / 2).flat_map(|i| atom(i).into_bytes()).collect()
        }),
        case("models.pdb", || {
            let line = "MODEL\nATOM      1  N   PRO A   1          1       1       1\nENDMDL\n";
            lines("", line, MB / 4)
        }),
        case("atoms.lammpstrj", || {
            let head = format!("ITEM: NUMBER OF ATOMS\n{}\nITEM: ATOMS x y z\n", 2 * MB);
            lines(&head, "0 0 0\n", 2 * MB)
        }),
        case("backwards.lammpstrj", || {
            let head = format!("ITEM: NUMBER OF ATOMS\n{MB}\nITEM: ATOMS id x y z\n");
            let mut out = head.into_bytes();
            out.extend((0..MB).rev().flat_map(|id| format!("{id} 0 0 0\n").into_bytes()));
            out
        }),
        case("frames.lammpstrj", || lines("", "ITEM: NUMBER OF ATOMS\n0\nITEM: ATOMS x y z\n", MB / 2)),
        case("frames.json", || {
            let zero = r#"{"dec":0,"bits":"00000000"}"#;
            let frame = format!(r#"{{"background":[0,0,0],"light":[{zero},{zero},{zero}],"spheres":[]}}"#);
            let all = vec![frame; MB / 8].join(",");
            format!(r#"{{"format":"cgt-scene","version":1,"frames":[{all}]}}"#).into_bytes()
        }),
        case("spheres.json", || {
            let [zero, one] = [r#"{"dec":0,"bits":"00000000"}"#, r#"{"dec":1,"bits":"3f800000"}"#];
            let vector = format!("[{zero},{zero},{zero}]");
            let sphere = format!(r#"{{"center":{vector},"radius":{one},"color":[0,0,0]}}"#);
            let all = vec![sphere; MB / 8].join(",");
            let frame = format!(r#"{{"background":[0,0,0],"light":{vector},"spheres":[{all}]}}"#);
            format!(r#"{{"format":"cgt-scene","version":1,"frames":[{frame}]}}"#).into_bytes()
        }),
        // Runs of small differences take the fewest bits an atom.
        case("zeros.xtc", || packed_xtc(&vec![0; MB], 0, 0, 9, 4_000_000)),
        case("ones.xtc", || packed_xtc(&vec![0xff; MB], 0, 0, 9, 900_000)),
        case("atoms.dcd", || dcd(MB)),
    ];
    // The same, packed, to hold as many spheres as can be: a bomb each.
    for Case { name, bytes } in std::mem::take(&mut cases) {
        let plain = std::rc::Rc::new(bytes);
        let again = plain.clone();
        cases.push(case(&name, move || plain()));
        cases.push(case(&format!("{name}.gz"), move || {
            let mut plain = again();
            plain.truncate(UNPACKED);
            packed(&plain)
        }));
    }
    cases
}

/// A DCD of one frame of so many atoms.
fn dcd(atoms: usize) -> Vec<u8> {
    let mut out = samples::dcd(false, false, 1, 0)[..196].to_vec();
    out[188..192].copy_from_slice(&i32::try_from(atoms).expect("few").to_le_bytes());
    let length = i32::try_from(4 * atoms).expect("few").to_le_bytes();
    for _ in 0..3 {
        out.extend(length);
        out.extend(vec![0; 4 * atoms]);
        out.extend(length);
    }
    out
}

/// Headers that promise what is not there, packed files that unpack to far more than they are, lines without an end, brackets without one.
fn bombs() -> Vec<Case> {
    let mut cases = Vec::new();
    // Packed once for all readers; the last of some megabytes, most of it used up by what does not pack.
    let mut half = b"# ".to_vec();
    half.extend(digits(6 * MB));
    half.push(b'\n');
    half.extend(b"s 1 1 1 1\n".repeat(2 * MB));
    let bombs = [("blanks", vec![b' '; 40 * MB]), ("zeros", vec![0; 40 * MB]), ("half", half)];
    let bombs = bombs.map(|(what, plain)| (what, std::rc::Rc::new(packed(&plain))));
    for (_, extension) in READERS {
        let name = |what: &str| format!("{what}.{extension}");
        for (what, bomb) in bombs.clone() {
            cases.push(case(&(name(what) + ".gz"), move || bomb.to_vec()));
        }
        cases.push(case(&name("line"), || vec![b'x'; 15 * MB]));
        cases.push(case(&name("digits"), || digits(10 * MB)));
        cases.push(case(&name("words"), || lines("", "x ", 5 * MB)));
        cases.push(case(&name("brackets"), || vec![b'['; 10 * MB]));
    }
    cases.extend([
        case("many.xyz", || b"4294967296\n\nH 0 0 0\n".to_vec()),
        case("most.xyz", || b"18446744073709551615\n\nH 0 0 0\n".to_vec()),
        case("many.lammpstrj", || b"ITEM: NUMBER OF ATOMS\n4294967296\nITEM: ATOMS x y z\n0 0 0\n".to_vec()),
        case("many.dcd", || {
            let mut bytes = samples::dcd(false, true, 2, 0);
            bytes[188..192].copy_from_slice(&i32::MAX.to_le_bytes());
            bytes
        }),
        case("long.dcd", || {
            let mut bytes = samples::dcd(true, true, 2, 0);
            bytes[92..96].copy_from_slice(&i32::MAX.to_be_bytes());
            bytes
        }),
        case("many.xtc", || packed_xtc(&[0; 24], 0, 15, 20, i32::MAX)),
        case("long.xtc", || {
            let mut bytes = packed_xtc(&[0; 24], 0, 15, 20, 12);
            bytes[88..92].copy_from_slice(&i32::MAX.to_be_bytes());
            bytes
        }),
        // Long words that come back in messages.
        case("format.json", || {
            let word = "\u{e000}".repeat(8 * MB);
            format!(r#"{{"format":"{word}","version":1,"frames":[]}}"#).into_bytes()
        }),
        case("field.json", || {
            let word = "\u{e000}".repeat(8 * MB);
            format!(r#"{{"format":"cgt-scene","{word}":1}}"#).into_bytes()
        }),
        case("bits.json", || {
            let word = "9".repeat(20 * MB);
            let light = format!(r#"{{"dec":{word},"bits":"{word}"}}"#);
            format!(r#"{{"format":"cgt-scene","version":1,"frames":[{{"light":[{light}]}}]}}"#).into_bytes()
        }),
        case("name.inc", || lines("sphere {<1,2,3>,", "Radius", 4 * MB)),
        case("names.xyz", || lines("1\n\n", "Qq", 10 * MB)),
        case("key.nff", || lines("s 0 0 0 1\n", "key", 10 * MB)),
    ]);
    cases
}

/// Reads, and gives the most that was on the heap beyond what was there, and whether it was read.
fn peak(name: &str, bytes: &[u8]) -> (usize, bool) {
    let before = HEAP.current_usage();
    HEAP.reset_peak_usage();
    let read = read_bytes(name, bytes, None).is_ok();
    (HEAP.peak_usage() - before, read)
}

fn hold(name: &str, bytes: &[u8]) -> (f64, bool) {
    let limit = 10 * bytes.len() + 64 * MB;
    let (peak, read) = peak(name, bytes);
    assert!(
        peak <= limit,
        "{name}: {} bytes take {peak}, {:.1} MB more than {limit}",
        bytes.len(),
        (peak - limit) as f64 / MB as f64
    );
    (peak as f64 / limit as f64, read)
}

#[test]
fn readers_take_ten_times_the_input_and_64_mb_at_most() {
    // That the count counts.
    let before = HEAP.current_usage();
    HEAP.reset_peak_usage();
    drop(vec![1u8; 5 * MB]);
    assert!((5 * MB..6 * MB).contains(&(HEAP.peak_usage() - before)), "nothing is counted");

    let (mut read, mut refused, mut most) = (0, 0, (0.0, String::new()));
    let mut note = |name: &str, (part, ok): (f64, bool)| {
        (read, refused) = if ok { (read + 1, refused) } else { (read, refused + 1) };
        if part > most.0 {
            most = (part, name.to_owned());
        }
    };
    for (name, bytes) in samples() {
        note(name, hold(name, &bytes));
    }
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    for name in ["1hvr.pdb.gz", "2juy.pdb.gz"] {
        let bytes = std::fs::read(data.join(name)).expect("bundled");
        let held = hold(name, &bytes);
        assert!(held.1, "{name} is refused");
        note(name, held);
    }
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus");
    let mut inputs = 0;
    for (target, extension) in READERS {
        assert!(TARGETS.iter().any(|known| known.name == target), "{target}");
        for entry in std::fs::read_dir(corpus.join(target)).expect("a corpus") {
            let path = entry.expect("an entry").path();
            let bytes = std::fs::read(&path).expect("an input");
            inputs += 1;
            note(&path.display().to_string(), hold(&format!("input.{extension}"), &bytes));
        }
    }
    for Case { name, bytes } in dense().into_iter().chain(bombs()) {
        let bytes = bytes();
        let held = hold(&name, &bytes);
        eprintln!("{name}: {} bytes, {:.0} % of the limit, read {}", bytes.len(), 100.0 * held.0, held.1);
        note(&name, held);
    }
    eprintln!(
        "{read} read, {refused} refused, {inputs} of them of corpora; the most {:.0} %: {}",
        100.0 * most.0,
        most.1
    );
    assert!(read > 50 && refused > 100 && inputs > 50, "{read} read, {refused} refused, {inputs} of corpora");
    // Damaged samples beside them, of a fresh seed.
    let seed = seed();
    eprintln!("CGT_SEED={seed}");
    for (i, (name, bytes)) in (0..).zip(samples()) {
        let mut rng = generator(seed, i);
        for _ in 0..300 {
            let changed = verify::fuzzed::mutated(&mut rng, &bytes, b"99999999999999999999");
            hold(name, &changed);
        }
    }
}
