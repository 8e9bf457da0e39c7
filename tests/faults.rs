//! Does each seeded fault still apply, and do the scripts that plant faults and mutants tell their verdicts apart? Whether they are killed is what
//! `tests/faults/run` and `tests/faults/mutants` find out, which takes longer than a test may.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const JUDGED: i32 = 0;
const WRONG: i32 = 1;
const USAGE: i32 = 2;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Where Python 3 is, from 3.11 on; without it nothing is judged here.
fn python() -> Option<PathBuf> {
    let asked = Command::new("python3").args(["-c", "import sys, tomllib; print(sys.executable)"]).output();
    let found = asked.ok().filter(|output| output.status.success());
    if found.is_none() {
        eprintln!("not judged: seeded faults: python3 is not installed, or older than 3.11");
    }
    found.map(|output| String::from_utf8_lossy(&output.stdout).trim().into())
}

fn script(words: &[&str]) -> Option<Output> {
    started("tests/faults/run", words)
}

fn started(name: &str, words: &[&str]) -> Option<Output> {
    let mut command = Command::new(python()?);
    Some(command.arg(root().join(name)).args(words).output().expect("it starts"))
}

/// What a run said, which must end with a code.
fn said(output: &Output, code: i32) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    assert!(!err.contains("Traceback"), "{err}");
    assert_eq!(output.status.code(), Some(code), "{out}{err}");
    format!("{out}{err}")
}

/// Every line stands where it should, once, and every killer is there.
#[test]
fn every_fault_applies() {
    let Some(output) = script(&["--check"]) else { return };
    let said = said(&output, JUDGED);
    eprint!("{said}");
    let faults: usize = said.split_whitespace().next().and_then(|n| n.parse().ok()).expect("their number");
    assert!(faults >= 250, "faults were lost: {said}");
}

/// The catalogue has faults of every property and of the suite, by many killers.
#[test]
fn every_property_has_faults() {
    let Some(output) = script(&["--list"]) else { return };
    let (mut properties, mut killers): (BTreeMap<char, usize>, BTreeMap<String, usize>) = Default::default();
    let (mut suite, mut all) = (0, 0);
    for line in said(&output, JUDGED).lines() {
        let [_, property, killer, ..] = line.split_whitespace().collect::<Vec<_>>()[..] else { continue };
        all += 1;
        *killers.entry(killer.trim_end_matches(',').to_owned()).or_default() += 1;
        if property == "suite" {
            suite += 1;
        } else {
            property.chars().for_each(|letter| *properties.entry(letter).or_default() += 1);
        }
    }
    eprintln!("{all} faults, {suite} of them the suite's own: {properties:?}; {} killers", killers.len());
    assert_eq!(properties.keys().collect::<String>(), "BCHIMORSVX", "{properties:?}");
    assert!(suite >= 90 && all - suite >= 140 && killers.len() >= 90);
    // Whoever kills most of them would hide that nobody else can.
    assert!(killers.values().all(|n| n * 8 < all), "{killers:?}");
}

/// A catalogue with something wrong is refused, or what does not apply is named.
#[test]
fn what_does_not_apply_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let fault = |change: &[(&str, &str)]| {
        let mut keys = BTreeMap::from([
            ("name", "a-fault"),
            ("file", "optimized/src/walk.rs"),
            ("line", "let one = m.splat_i(1);"),
            ("becomes", "let one = m.splat_i(2);"),
            ("property", "O"),
            ("killer", "walk::exhausted_over_boxes"),
        ]);
        keys.extend(change.iter().copied());
        let lines = keys.iter().filter(|(_, value)| **value != "none");
        lines.fold("[[fault]]\n".to_owned(), |text, (key, value)| format!("{text}{key} = '''{value}'''\n"))
    };
    let cases = [
        (fault(&[]), JUDGED, "1 faults, 0 of which do not apply"),
        (
            fault(&[("line", "let one = m.splat_i(7);")]),
            WRONG,
            "a-fault: optimized/src/walk.rs: the line stands there 0 times",
        ),
        (fault(&[("line", "return;")]), WRONG, "the line stands there 3 times"),
        (fault(&[("within", "fn no_such")]), WRONG, "0 lines hold 'fn no_such'"),
        (fault(&[("within", "pub fn step<M: Machine>")]), JUDGED, "0 of which"),
        (fault(&[("within", "fn printed<M: Machine>")]), WRONG, "the line stands there 0 times"),
        (fault(&[("file", "optimized/src/no_such.rs")]), WRONG, "is not there"),
        (fault(&[("killer", "walk::exhausted_over_boxe")]), WRONG, "walk has no test exhausted_over_boxe"),
        (fault(&[("killer", "walk::tally")]), WRONG, "walk has no test tally"),
        (fault(&[("killer", "stroll::exhausted_over_boxes")]), WRONG, "no test binary stroll"),
        (fault(&[("fuzz", "no-such")]), WRONG, "no fuzz target no-such"),
        (fault(&[]) + &fault(&[]), USAGE, "a name stands twice"),
        (fault(&[]) + &fault(&[("name", "another")]), USAGE, "another is a-fault once more"),
        (fault(&[("becomes", "let  one = m.splat_i(1);")]), USAGE, "the line becomes itself"),
        (fault(&[("property", "Z")]), USAGE, "'Z' is no property"),
        (fault(&[("killer", "walk")]), USAGE, "is not binary::test"),
        (fault(&[("because", "of that")]), USAGE, "because is no key of a fault"),
        (fault(&[("needs", "luck")]), USAGE, "needs 'luck'"),
        (fault(&[("killer", "none")]), USAGE, "a-fault has no killer"),
        ("[[fault]\n".to_owned(), USAGE, "catalogue.toml"),
        (String::new(), WRONG, "0 faults"),
    ];
    for (text, code, expected) in &cases {
        let file = folder.path().join("catalogue.toml");
        std::fs::write(&file, text).expect("it can be written");
        let Some(output) = script(&["--catalogue", file.to_str().expect("UTF-8"), "--check"]) else { return };
        let said = said(&output, *code);
        assert!(said.contains(expected), "{expected:?} is not in {said:?} of\n{text}");
    }
    eprintln!("{} catalogues", cases.len());
}

#[test]
fn words_that_are_not_understood_are_told() {
    for (words, expected) in [
        (&["--no-such"][..], "--no-such is no option"),
        (&["--sample"], "--sample needs a value"),
        (&["--sample", "0"], "a number from 1"),
        (&["--seed", "-4"], "a number from 0"),
        (&["no-such-fault"], "no fault has the name, file, property or killer no-such-fault"),
    ] {
        let Some(output) = script(words) else { return };
        let said = said(&output, USAGE);
        assert!(said.contains(expected), "{words:?}: {said}");
    }
    let Some(output) = script(&["--help"]) else { return };
    let said = said(&output, JUDGED);
    assert!(
        said.starts_with("Usage: tests/faults/run") && said.contains("Exit codes: 0 all are killed"),
        "{said}"
    );
}

/// In a made-up project a survivor, a compile error, a time-out, a panic alone, a stale line, one that is not the only one, an unchanged
/// program, and killers that are not there or fail anyway are told from faults that are killed, switched and alone.
#[test]
fn every_verdict_is_recognised() {
    let Some(output) = script(&["--self-test"]) else { return };
    let said = said(&output, JUDGED);
    assert!(said.contains("24 verdicts, 0 wrong"), "{said}");
}

/// In the same project, mutants that are killed by a check, by a panic or by a time-out, that do not compile, that survive, and that no test
/// comes to are told apart, and explanations that are lacking, wrong or stale are named.
#[test]
fn every_end_of_a_mutant_is_recognised() {
    let Some(output) = started("tests/faults/mutants", &["--self-test"]) else { return };
    let said = said(&output, JUDGED);
    assert!(said.contains("19 mutants, 0 wrong"), "{said}");
}

/// Each explanation of a mutant that survives has a file, and a mutant if there is cargo-mutants to list it.
#[test]
fn every_explanation_has_its_mutant() {
    let Some(output) = started("tests/faults/mutants", &["--check"]) else { return };
    let said = said(&output, JUDGED);
    eprint!("{said}");
    assert!(said.contains(" explained, 0 of which are no mutants"), "{said}");
}
