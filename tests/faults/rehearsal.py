"""Faults in a made-up project of three small packages, one for each verdict that there is. In each way of building, every verdict must
be the one that is known."""

import sys
import tempfile
import time
from pathlib import Path

import catalogue
import verdicts

MANIFEST = '[package]\nname = "{name}"\nversion = "0.0.0"\nedition = "2021"\n'
FILES = {
    "Cargo.toml": '[workspace]\nresolver = "2"\nmembers = ["verify/contract", "optimized", "tests"]\n',
    "verify/contract/Cargo.toml": MANIFEST.format(name="contract"),
    "verify/contract/src/lib.rs": "//! Nothing.\n",
    "optimized/Cargo.toml": MANIFEST.format(name="optimized") + '[dependencies]\ncontract = { path = "../verify/contract" }\n',
    "optimized/src/lib.rs": """\
/// Their sum.
pub fn sum(x: u32, y: u32) -> u32 {
    x + y
}

/// What nobody tests.
pub fn untested(x: u32) -> u32 {
    x * 3
}

/// How often x is halved until it is 0.
pub fn halvings(mut x: u32) -> u32 {
    let mut count = 0;
    while x > 0 {
        x /= 2;
        count = (count + 1) % 1000;
    }
    count
}

/// One of three.
pub fn third(at: usize) -> u32 {
    let three = [5, 6, 7];
    three[at]
}

/// Twice x.
pub fn double(x: u32) -> u32 {
    2 * x
}

/// Twice x, again.
pub fn again(x: u32) -> u32 {
    let y = x;
    2 * y
}

/// x in words.
pub fn words(x: u32) -> String {
    format!("{x} of them")
}
""",
    "tests/Cargo.toml": MANIFEST.format(name="tests") + """autotests = false
[lib]
path = "lib.rs"
[dependencies]
contract = { path = "../verify/contract" }
optimized = { path = "../optimized" }
[[test]]
name = "small"
path = "small.rs"
""",
    "tests/lib.rs": "",
    "tests/small.rs": """\
//! Are they what they say?

use optimized::{again, double, halvings, sum, third, untested, words};

#[test]
fn sums() {
    assert_eq!(sum(2, 3), 5);
}

#[test]
fn something() {
    assert!(untested(1) > 0);
}

#[test]
fn ends() {
    assert_eq!(halvings(8), 4);
}

#[test]
fn thirds() {
    assert_eq!(third(2), 7);
}

#[test]
fn doubles() {
    assert_eq!([double(4), again(4)], [8, 8]);
}

#[test]
fn speaks() {
    assert_eq!(words(7), "7 of them");
}

#[test]
fn fails_anyway() {
    assert_eq!(sum(1, 1), 3);
}
""",
}
# name, line, what it becomes, killer, whether it is alone in any case, the verdict
CASES = [
    ("a-killed-one", "x + y", "x - y.min(x)", "sums", False, verdicts.KILLED),
    ("a-survivor", "x * 3", "x * 4", "something", False, verdicts.SURVIVOR),
    ("a-compile-error", "x + y", "x + z", "sums", False, verdicts.COMPILE),
    ("an-endless-one", "x /= 2;", "x /= 1;", "ends", False, verdicts.TIMEOUT),
    ("a-panic", "three[at]", "three[at + 1]", "thirds", False, verdicts.PANIC),
    ("a-stale-line", "x +  y", "x - y", "sums", False, verdicts.STALE),
    ("a-line-that-stands-twice", "}", "};", "sums", False, verdicts.STALE),
    ("an-unchanged-one", "2 * x", "x * 2", "doubles", False, verdicts.UNCHANGED),
    ("a-killed-one-alone", "count = (count + 1) % 1000;", "count = (count + 2) % 1000;", "ends", True, verdicts.KILLED),
    ("a-text-of-a-macro", 'format!("{x} of them")', 'format!("{x} of us")', "speaks", False, verdicts.KILLED),
    ("a-killer-that-is-not-there", "2 * y", "3 * y", "nothing", False, verdicts.NO_TEST),
    ("a-killer-that-fails-anyway", "2 * y", "4 * y", "fails_anyway", False, verdicts.UNSOUND),
]


def main(trial, options, _):
    """Plants them, switched and alone; 0 if every verdict is the expected one."""
    import building
    start = time.monotonic()
    wrong = 0
    with tempfile.TemporaryDirectory(prefix="cgt-faults-") as folder:
        root = Path(folder) / "root"
        for name, text in FILES.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        entries = [catalogue.Fault({"name": name, "file": "optimized/src/lib.rs", "line": line, "becomes": becomes,
                                    "property": "V", "killer": f"small::{test}", "alone": alone}, "rehearsal")
                   for name, line, becomes, test, alone, _ in CASES]
        # Each way has a build of its own, so that none gets what the other has made.
        for flags in ([], ["--alone"]):
            given = options(["--offline", "--jobs", "2", *flags])
            attempt = trial(root, entries, entries, Path(folder) / ("alone" if flags else "switched"), given, 1)
            attempt.limits = (2, 1)
            found = attempt.run()
            for verdict, (name, *_, expected) in zip(found, CASES):
                apart = name.startswith("a-text") and verdict.how != ("alone" if flags else "switched")
                if verdict.word != expected or apart:
                    wrong += 1
                    print(f"{name}, {' '.join(flags) or 'switched'}: {verdict.word} ({verdict.said}), {verdict.how}; expected: {expected}")
        if not building.sections(Path(sys.executable).resolve().read_bytes()):
            print("not judged: code by its sections: programs here are no ELF files")
    print(f"{2 * len(CASES)} verdicts, {wrong} wrong; {time.monotonic() - start:.1f} s")
    return 1 if wrong else 0
