//! Do fuzz targets judge, and does every input in `fuzz/corpus`, and what is made of it by random damage, pass?

use rand::RngExt;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use verify::fuzzed::{TARGETS, Target, mutated};
use verify::seed::{count, generator, seed};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz")
}

/// Names of what a folder holds, in order.
fn names(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.expect("an entry").file_name();
    entries.map(|entry| name(entry).into_string().expect("a plain name")).collect()
}

/// A target's inputs with their names.
fn corpus(target: &Target) -> Vec<(String, Vec<u8>)> {
    let folder = folder().join("corpus").join(target.name);
    let read = |name: String| {
        let bytes = std::fs::read(folder.join(&name)).expect("an input");
        (name, bytes)
    };
    names(&folder).into_iter().map(read).collect()
}

/// Runs a target on an input; a panic is told with what is needed to see it again.
fn run(target: &Target, bytes: &[u8], what: &dyn Fn() -> String) -> u64 {
    std::panic::catch_unwind(|| (target.run)(bytes)).unwrap_or_else(|_| {
        let hex: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        panic!(
            "{} fails on {}: put these bytes into a file by `xxd -r -p`, and run fuzz/run {} 0 FILE\n{hex}",
            target.name,
            what(),
            target.name
        )
    })
}

/// The least that a target must come to: of a hundred inputs of its corpus so many judge something, and answers judged in all; and of a
/// thousand changed inputs so many judge something. What is changed in a file mostly makes it one to be refused, which a reader's
/// corpus is full of, too.
const LEAST: [(&str, u64, u64, u64); 17] = [
    ("case", 10, 5, 2),
    ("certified", 80, 2_000, 700),
    ("dcd", 10, 30, 10),
    ("filter", 70, 20, 600),
    ("json", 5, 10, 2),
    ("lammps", 10, 10, 20),
    ("nff", 10, 10, 20),
    ("pdb", 10, 20, 20),
    ("pov", 10, 5, 20),
    ("queue", 90, 1_000, 900),
    ("scene", 60, 500, 400),
    ("spu", 100, 10_000, 1_000),
    ("visible", 50, 500, 400),
    ("voxelize", 50, 5_000, 400),
    ("walk", 100, 1_000, 1_000),
    ("xtc", 10, 30, 20),
    ("xyz", 10, 20, 20),
];

#[test]
fn every_input_passes_and_most_are_judged() {
    assert_eq!(LEAST.map(|least| least.0), TARGETS.map(|target| target.name), "a target was added or lost");
    for (target, (_, share, answers, _)) in TARGETS.iter().zip(LEAST) {
        let corpus = corpus(target);
        let counts: Vec<u64> = corpus
            .par_iter()
            .map(|(name, bytes)| run(target, bytes, &|| format!("fuzz/corpus/{}/{name}", target.name)))
            .collect();
        let (judging, judged) =
            (counts.iter().filter(|count| **count > 0).count() as u64, counts.iter().sum::<u64>());
        let inputs = corpus.len() as u64;
        eprintln!("{}: {inputs} inputs, of which {judging} judge {judged} answers", target.name);
        assert!(inputs >= 3, "{}: {inputs} inputs are no corpus", target.name);
        assert!(100 * judging >= share * inputs, "{}: of {inputs} inputs only {judging} judge", target.name);
        assert!(judged >= answers, "{}: {judged} answers judged, {answers} at least", target.name);
    }
}

/// `CGT_FUZZ_ROUNDS` changed inputs for each that there is, 150 every day.
#[test]
fn changed_inputs_pass_too() {
    let (seed, rounds) = (seed(), count("CGT_FUZZ_ROUNDS", 150));
    assert!(rounds > 0, "CGT_FUZZ_ROUNDS: no round is no verdict");
    eprintln!("CGT_SEED={seed}, {rounds} rounds");
    for ((t, target), (.., least)) in (0..).zip(&TARGETS).zip(LEAST) {
        let corpus = corpus(target);
        let tasks = (0..rounds).into_par_iter().flat_map_iter(|round| {
            let inputs = 0..corpus.len() as u64;
            inputs.map(move |input| (round, input))
        });
        let judge = |(round, input): (u64, u64)| {
            let mut rng = generator(seed, (t << 48) + (input << 32) + round);
            let (name, bytes) = &corpus[usize::try_from(input).expect("few")];
            let (_, other) = &corpus[rng.random_range(0..corpus.len())];
            let changed = mutated(&mut rng, bytes, other);
            let what = || format!("round {round} of {name} with CGT_SEED={seed}");
            let judged = run(target, &changed, &what);
            [1, u64::from(judged > 0), judged]
        };
        let sum = |x: [u64; 3], y: [u64; 3]| [0, 1, 2].map(|i| x[i] + y[i]);
        let [runs, judging, judged] = tasks.map(judge).reduce(|| [0; 3], sum);
        eprintln!("{}: {runs} runs, of which {judging} judge {judged} answers", target.name);
        assert!(
            1000 * judging >= least * runs,
            "{}: of {runs} changed inputs only {judging} judge",
            target.name
        );
    }
}

/// Corpora stay small: they are read by everybody, and grow by what has failed.
#[test]
fn corpora_are_small() {
    for target in &TARGETS {
        let corpus = corpus(target);
        let bytes: usize = corpus.iter().map(|(_, bytes)| bytes.len()).sum();
        eprintln!("{}: {} inputs, {bytes} bytes", target.name, corpus.len());
        assert!(corpus.len() <= 60 && bytes <= 64 << 10, "{}: {bytes} bytes", target.name);
    }
}

/// `fuzz/targets`, `fuzz/Cargo.toml`, `fuzz/corpus` and [`TARGETS`] name the same, each program runs the body of its name, and for each
/// there is a fault that it must find.
#[test]
fn all_that_names_targets_agrees() {
    let known: BTreeSet<String> = TARGETS.iter().map(|target| target.name.to_owned()).collect();
    assert_eq!(known.len(), TARGETS.len(), "a name twice");
    assert!(TARGETS.iter().all(|target| !target.what.is_empty()));
    assert_eq!(names(&folder().join("corpus")), known, "fuzz/corpus");
    let files: BTreeSet<String> = known.iter().map(|name| format!("{name}.rs")).collect();
    assert_eq!(names(&folder().join("targets")), files, "fuzz/targets");
    for name in &known {
        let text = std::fs::read_to_string(folder().join(format!("targets/{name}.rs"))).expect("a target");
        let body = format!(
            "#![no_main]\n\nlibfuzzer_sys::fuzz_target!(|bytes: &[u8]| {{\n    verify::fuzzed::{name}(bytes);\n}});\n"
        );
        let code = text.split_once('\n').expect("a line that tells").1;
        assert_eq!(code, body, "fuzz/targets/{name}.rs");
    }
    let manifest = folder().join("Cargo.toml");
    let metadata = cargo_metadata::MetadataCommand::new().manifest_path(manifest).no_deps().exec();
    let metadata = metadata.expect("cargo metadata reads fuzz/Cargo.toml");
    let package = metadata.packages.first().expect("one package");
    let bins: BTreeSet<(String, String)> = package
        .targets
        .iter()
        .map(|bin| (bin.name.clone(), bin.src_path.file_name().expect("a file").to_owned()))
        .collect();
    let wanted = known.iter().map(|name| (name.clone(), format!("{name}.rs"))).collect();
    assert_eq!(bins, wanted, "fuzz/Cargo.toml");
    let faults = std::fs::read_to_string(folder().join("faults.toml")).expect("the faults");
    for name in &known {
        assert!(faults.lines().any(|line| line == format!("fuzz = \"{name}\"")), "no fault for {name}");
    }
    assert_eq!(package.metadata["cargo-fuzz"], serde_json::Value::Bool(true), "what cargo-fuzz asks for");
    // Without its checks half of what is wrong with a number would go by.
    let manifest = std::fs::read_to_string(folder().join("Cargo.toml")).expect("it is there");
    for check in ["debug-assertions = true", "overflow-checks = true"] {
        assert!(manifest.lines().any(|line| line == check), "fuzz/Cargo.toml: {check}");
    }
}
