"""Mutants of the made-up project of `rehearsal`, some for each thing that may become of one. What is explained wrongly must be told, and
with right explanations the run must be content, until a test kills what was explained."""

import contextlib
import io
import json
import tempfile
import time
from pathlib import Path

import mutations
import rehearsal
import verdicts

FILE = "optimized/src/lib.rs"
SOURCE = rehearsal.FILES[FILE] + """
/// How many there are; no `if` can choose it.
pub const COUNT: usize = 3 - 1;

/// Bytes of a row, on which another package depends.
pub const WIDTH: usize = 8 / 2;

/// What no test comes to.
pub fn unreached(x: u32) -> u32 {
    x + 1
}

/// Numbers up to x.
pub fn numbers(x: u32) -> impl Iterator<Item = u32> {
    0..x
}

/// Whether x is among some.
pub fn among(x: u32) -> bool {
    match x {
        3 => true,
        4 | 5 if x != 5 => true,
        _ => false,
    }
}

/// Doubled where it can be.
pub fn twice_or_none(x: Option<u32>) -> u32 {
    if let Some(x) = x && x < 10 { x * 2 } else { 0 }
}
"""
TESTS = rehearsal.FILES["tests/small.rs"] + """
#[test]
fn others() {
    use optimized::{among, numbers, twice_or_none, COUNT};
    assert_eq!([COUNT; 1], [2]);
    let row: [u8; optimized::WIDTH] = [1, 2, 3, 4];
    assert_eq!(row[3], 4);
    assert!(numbers(3).eq([0, 1, 2]));
    assert_eq!([2, 3, 4, 5].map(among), [false, true, true, false]);
    assert_eq!([Some(3), Some(10), None].map(twice_or_none), [6, 0, 0]);
}
"""
PANIC, TIMEOUT = "killed by a panic elsewhere", "killed by a time-out"
CHECK, SURVIVOR, UNVIABLE = "killed by a check", "survivor", "unviable"
# genre, function, its line, what is replaced there, by what, what must become of it
CASES = [
    ("BinaryOperator", "sum", "x + y", "+", "*", CHECK),
    ("FnValue", "sum", "x + y", "x + y", "1", CHECK),
    ("FnValue", "sum", "x + y", "x + y", "None", UNVIABLE),
    ("BinaryOperator", "untested", "x * 3", "*", "+", SURVIVOR),
    ("BinaryOperator", "untested", "x * 3", "*", "/", CHECK),
    ("BinaryOperator", "halvings", "while x > 0 {", ">", ">=", TIMEOUT),
    ("BinaryOperator", "halvings", "x /= 2;", "/=", "*=", PANIC),
    ("BinaryOperator", "halvings", "count = (count + 1) % 1000;", "%", "/", CHECK),
    ("FnValue", "third", "three[at]", "three[at]", "three[at + 1]", PANIC),
    ("BinaryOperator", "COUNT", "pub const COUNT: usize = 3 - 1;", "-", "+", CHECK),
    ("BinaryOperator", "WIDTH", "pub const WIDTH: usize = 8 / 2;", "/", "*", UNVIABLE),
    ("BinaryOperator", "unreached", "x + 1", "+", "-", SURVIVOR),
    ("FnValue", "numbers", "0..x", "0..x", "::std::iter::empty()", CHECK),
    ("FnValue", "numbers", "0..x", "0..x", "::std::iter::once(1)", CHECK),
    ("MatchArm", "among", "3 => true,", "3 => true,", "", CHECK),
    ("MatchArmGuard", "among", "4 | 5 if x != 5 => true,", "x != 5", "true", CHECK),
    ("BinaryOperator", "among", "4 | 5 if x != 5 => true,", "!=", "==", CHECK),
    ("BinaryOperator", "twice_or_none", "if let Some(x) = x && x < 10 {", "<", "<=", CHECK),
    ("BinaryOperator", "twice_or_none", "if let Some(x) = x && x < 10 {", "<", ">", CHECK),
]


def listing():
    """What cargo-mutants would say of them."""
    out = []
    for genre, function, line, old, new, _ in CASES:
        start = SOURCE.index(function if function.isupper() else f"fn {function}(")
        at = SOURCE.index(line, SOURCE.rindex("\n", 0, start)) + (line.rindex(old) if genre != "FnValue" else 0)
        row, column = SOURCE.count("\n", 0, at) + 1, at - SOURCE.rindex("\n", 0, at)
        span = {"start": {"line": row, "column": column}, "end": {"line": row, "column": column + len(old)}}
        returns = "-> impl Iterator<Item = u32>" if function == "numbers" else "-> u32"
        name = f"{FILE}:{row}:{column}: replace {old} with {new} in {function}"
        out.append({"file": FILE, "genre": genre, "replacement": new, "span": span, "name": name,
                    "function": {"function_name": function, "return_type": returns, "span": span}})
    return json.dumps(out)


def main(script):
    """Plants them; 0 if what becomes of each is what is known."""
    start, wrong = time.monotonic(), []
    script.LEAST_LIMIT, script.LIMIT_TIMES = 2, 1
    mutants = mutations.parse(listing())
    expected = {f"{FILE}: replace {old} with {new} in {function}": becomes for _, function, _, old, new, becomes in CASES}
    if set(expected) != {mutant.name for mutant in mutants}:
        wrong.append("names are not as expected")
    survivors = [name for name, becomes in expected.items() if becomes == SURVIVOR]
    reason = 'class = "cost"\nwhy = "a made-up one, of no account"\n'
    explained = lambda names: script.Explanations(f"[[explained]]\nmutants = {json.dumps(names)}\n{reason}" if names else "")
    with tempfile.TemporaryDirectory(prefix="cgt-mutants-") as folder:
        root, scratch = Path(folder) / "root", Path(folder) / "scratch"
        for name, text in {**rehearsal.FILES, FILE: SOURCE, "tests/small.rs": TESTS}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text.replace('edition = "2021"', 'edition = "2024"'), encoding="utf-8")
        options = script.Options(["--offline", "--jobs", "2"])

        def judged(explanations):
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                code = script.judge(root, mutants, mutants, scratch, options, 1, explanations, [(lambda _: True, script.plain)])
            return code, out.getvalue()

        killed = next(name for name, becomes in expected.items() if becomes == CHECK)
        unviable = next(name for name, becomes in expected.items() if becomes == UNVIABLE)
        code, said = judged(explained([survivors[0], killed, unviable, "optimized/src/lib.rs: replace gone with lost in sum"]))
        book = json.loads((scratch / "verdicts.json").read_text(encoding="utf-8"))
        names = {verdicts.KILLED: CHECK, verdicts.PANIC: PANIC, verdicts.TIMEOUT: TIMEOUT}
        for name, becomes in expected.items():
            entry = book.get(name, {"verdict": "nothing"})
            found = names[entry["how"]] if entry["verdict"] == verdicts.KILLED else entry["verdict"]
            if found != becomes:
                wrong.append(f"{name}: {found} {entry}, expected: {becomes}")
        complaints = [f"survivor, not explained: {survivors[1]} (no test comes there)", f"explained, but killed by small::sums: {killed}",
                      f"explained, but does not compile: {unviable}",
                      "explained, but there is no such mutant: optimized/src/lib.rs: replace gone with lost in sum"]
        wrong += [f"not told: {text}" for text in complaints if text not in said]
        if code != 1:
            wrong.append(f"with wrong explanations the code is {code}")
        # Only survivors are asked again, of which all that passed is known.
        code, said = judged(explained(survivors))
        if code != 0 or "2 explained (cost)" not in said:
            wrong.append(f"with right explanations the code is {code}: {said}")
        # A test that comes later kills one, whose explanation must go.
        (root / "tests/small.rs").write_text(TESTS.replace("untested(1) > 0", "untested(2) == 6"), encoding="utf-8")
        code, said = judged(explained(survivors))
        if code != 1 or f"explained, but killed by small::something: {survivors[0]}" not in said:
            wrong.append(f"with a test that kills one the code is {code}: {said}")
    for text in wrong:
        print(text)
    print(f"{len(CASES)} mutants, {len(wrong)} wrong; {time.monotonic() - start:.1f} s")
    return 1 if wrong else 0
