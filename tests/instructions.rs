//! Does the gate on instruction counts close? Counts that are made up go through `tests/instructions`, which needs no Valgrind
//! for it.

use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

const JUDGED: i32 = 0;
const USAGE: i32 = 2;
const NOT_JUDGED: i32 = 3;
const SLOWER: i32 = 4;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Where Python 3 is; without it nothing is judged here.
fn python() -> Option<PathBuf> {
    let asked = Command::new("python3").args(["-c", "import sys; print(sys.executable)"]).output();
    let found = asked.ok().filter(|output| output.status.success());
    if found.is_none() {
        eprintln!("not judged: the gate on instruction counts: python3 is not installed");
    }
    found.map(|output| String::from_utf8_lossy(&output.stdout).trim().into())
}

struct Gate {
    python: PathBuf,
    desk: TempDir,
}

impl Gate {
    fn new() -> Option<Self> {
        Some(Self { python: python()?, desk: tempfile::tempdir().expect("a folder") })
    }

    fn file(&self, name: &str, text: &str) -> PathBuf {
        let file = self.desk.path().join(name);
        std::fs::write(&file, text).expect("it can be written");
        file
    }

    fn command(&self) -> Command {
        let mut command = Command::new(&self.python);
        command.arg(root().join("tests/instructions"));
        command
    }

    /// Holds counts against others.
    fn compare(&self, stored: &str, found: &str) -> Output {
        let (stored, found) = (self.file("stored.json", stored), self.file("found.json", found));
        let mut command = self.command();
        command.arg("--baseline").arg(stored).arg("--counts").arg(found).output().expect("it starts")
    }

    fn judge(&self, what: &str, [stored, found]: [&Value; 2], expected: i32, said: &str) {
        let output = self.compare(&stored.to_string(), &found.to_string());
        ended(what, &output, expected, said);
    }
}

fn ended(what: &str, output: &Output, expected: i32, said: &str) {
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    assert!(!err.contains("Traceback"), "{what}: {err}");
    assert_eq!(output.status.code(), Some(expected), "{what}: {out}{err}");
    assert!(out.contains(said) || err.contains(said), "{what}: not said is {said:?}: {out}{err}");
}

fn counts(compiler: &str, instructions: Value) -> Value {
    json!({ "compiler": compiler, "date": "2026-11-25", "instructions": instructions })
}

#[test]
fn a_slower_count_ends_with_4_and_an_equal_one_with_0() {
    let Some(gate) = Gate::new() else { return };
    let stored = counts("rustc 1", json!({ "a": 100_000, "b": 2_000_000 }));
    let found = |a: u64, b: u64| counts("rustc 1", json!({ "a": a, "b": b }));
    let judge = |what, found: &Value, code, said| gate.judge(what, [&stored, found], code, said);
    judge("equal", &stored, JUDGED, "none slower");
    judge("faster", &found(50_000, 1), JUDGED, "none slower");
    judge("slower by 2 %, which is allowed", &found(102_000, 2_000_000), JUDGED, "+2.00 %");
    judge("slower by a little more", &found(102_001, 2_000_000), SLOWER, "more than 2 %: a\n");
    judge("one slower, one faster", &found(50_000, 2_100_000), SLOWER, "more than 2 %: b\n");
    judge("both slower", &found(200_000, 4_000_000), SLOWER, "more than 2 %: a, b\n");
}

#[test]
fn what_cannot_be_compared_is_not_judged() {
    let Some(gate) = Gate::new() else { return };
    let stored = counts("rustc 1", json!({ "a": 100, "b": 200 }));
    let judge = |what, found: &Value, code, said| gate.judge(what, [&stored, found], code, said);
    let other = counts("rustc 2", json!({ "a": 1000, "b": 200 }));
    judge("another compiler", &other, NOT_JUDGED, "stored are those of rustc 1, this is rustc 2");
    judge("one is gone", &counts("rustc 1", json!({ "a": 100 })), NOT_JUDGED, "b is not counted");
    let new = counts("rustc 1", json!({ "a": 100, "b": 200, "c": 300 }));
    judge("one is new", &new, NOT_JUDGED, "c is not stored");
    judge("one is gone, the other slower", &counts("rustc 1", json!({ "a": 200 })), SLOWER, "2 %: a\n");
    let nothing = counts("rustc 1", json!({}));
    gate.judge("nothing", [&nothing, &nothing], NOT_JUDGED, "nothing");
}

#[test]
fn what_is_no_file_of_counts_is_refused() {
    let Some(gate) = Gate::new() else { return };
    let good = counts("rustc 1", json!({ "a": 100 })).to_string();
    let zero = counts("rustc 1", json!({ "a": 0 })).to_string();
    let word = counts("rustc 1", json!({ "a": "100" })).to_string();
    for bad in ["", "[]", "{}", "1", r#"{ "compiler": 1, "instructions": { "a": 1 } }"#, &zero, &word] {
        ended(bad, &gate.compare(bad, &good), USAGE, "no counts");
        ended(bad, &gate.compare(&good, bad), USAGE, "no counts");
    }
    let both = gate.command().args(["--store", "--counts", "x"]).output().expect("it starts");
    ended("--store with --counts", &both, USAGE, "--counts counts nothing");
}

#[test]
fn what_is_stored_can_be_held_against() {
    let Some(gate) = Gate::new() else { return };
    let file = root().join("verify/benches/instructions.json");
    let stored: Value =
        serde_json::from_str(&std::fs::read_to_string(file).expect("it is there")).expect("JSON");
    gate.judge("the stored counts", [&stored, &stored], JUDGED, "none slower");
    let mut doctored = stored.clone();
    for count in doctored["instructions"].as_object_mut().expect("counts by name").values_mut() {
        *count = (count.as_u64().expect("a count") * 9 / 10).into();
    }
    gate.judge("less had been stored", [&doctored, &stored], SLOWER, "slower than stored");
    gate.judge("more had been stored", [&stored, &doctored], JUDGED, "none slower");
}

#[test]
fn without_valgrind_nothing_is_judged() {
    let Some(gate) = Gate::new() else { return };
    let output = gate.command().env("PATH", gate.desk.path()).output().expect("it starts");
    ended("no Valgrind", &output, NOT_JUDGED, "not judged: instruction counts: valgrind is not installed");
}
