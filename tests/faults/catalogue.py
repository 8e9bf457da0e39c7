"""The catalogue: which line becomes which, and who should notice. Each fault is one line of a file that is shipped.

A file of TOML has entries `[[fault]]` with

  name      of lower-case words and hyphens
  file      from the root of the repository
  line      the line as it stands, but for the blank at its ends; it must stand there once,
  within    or once in the item that begins with a line holding this text (a list: within that, within that)
  becomes   the line that takes its place; empty: it is left out
  property  letters: V voxelization complete, O cells and order of the walk, H hit => visible, I image, C culling, X exact
            adjudication or Embree, R reproducibility, S stated limits and ties, B branches in the machine code, M memory;
            or "suite" for what is no tracer
  killer    `binary::test`, with the test's modules between; it may be left out where `fuzz` stands, and --fuzz alone judges
  env       counts for that test, if the everyday ones are too many or too few
  needs     what the killer cannot do without: an instruction set (avx2, avx512), solver, embree, fetched data (data), or Rust's library
            for WebAssembly and a Chromium (wasm)
  alone     true if it cannot be switched at run time and has a build of its own (see `switches`)
  fuzz      a target of fuzz/ that should find it too
  why       the killer sees it, if that is not plain
"""

import re
import tomllib

PROPERTIES = set("VOHICXRSBM")
KEYS = {"name": str, "file": str, "line": str, "becomes": str, "property": str, "killer": str, "within": (str, list),
        "env": dict, "needs": str, "alone": bool, "fuzz": str, "why": str}
NEEDED = ("name", "file", "line", "becomes", "property")
NEEDS = ("avx2", "avx512", "solver", "embree", "data", "wasm")


class Malformed(Exception):
    """A catalogue that cannot be read."""


class Stale(Exception):
    """A line that is not there, or not once."""


class Fault:
    """One entry, with its place in the source once that was looked up."""

    def __init__(self, entry, origin):
        for key, value in entry.items():
            if key not in KEYS:
                raise Malformed(f"{origin}: {key} is no key of a fault")
            if not isinstance(value, KEYS[key]):
                raise Malformed(f"{origin}: {key} is {value!r}")
        missing = [key for key in NEEDED if key not in entry]
        if "killer" not in entry and "fuzz" not in entry:
            missing.append("killer")
        if missing:
            raise Malformed(f"{origin}: {entry.get('name', 'a fault')} has no {', '.join(missing)}")
        self.name, self.file, self.property = entry["name"], entry["file"], entry["property"]
        self.line, self.becomes = entry["line"].strip(), entry["becomes"].strip()
        within = entry.get("within", [])
        self.within = [within] if isinstance(within, str) else within
        self.killer, self.env = entry.get("killer"), {key: str(value) for key, value in entry.get("env", {}).items()}
        self.needs, self.alone, self.fuzz = entry.get("needs"), entry.get("alone", False), entry.get("fuzz")
        self.why = entry.get("why", "")
        if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", self.name):
            raise Malformed(f"{origin}: {self.name!r} is no name")
        if self.property != "suite" and not (self.property and set(self.property) <= PROPERTIES):
            raise Malformed(f"{self.name}: {self.property!r} is no property")
        if self.needs is not None and self.needs not in NEEDS:
            raise Malformed(f"{self.name}: needs {self.needs!r}; known are {', '.join(NEEDS)}")
        if "\n" in self.line + self.becomes or not self.line:
            raise Malformed(f"{self.name}: a fault is one line")
        if " ".join(self.line.split()) == " ".join(self.becomes.split()):
            raise Malformed(f"{self.name}: the line becomes itself")
        if self.killer is not None and "::" not in self.killer:
            raise Malformed(f"{self.name}: the killer {self.killer!r} is not binary::test")

    @property
    def finder(self):
        """Who should find it, in a word."""
        return self.killer or f"fuzz/{self.fuzz}"

    @property
    def binary(self):
        """Name of the killer's test binary."""
        return self.killer and self.killer.split("::", 1)[0]

    @property
    def test(self):
        """The killer's name within it."""
        return self.killer and self.killer.split("::", 1)[1]

    @property
    def run(self):
        """What is run: the same for faults that one run without a fault stands for."""
        return self.killer, tuple(sorted(self.env.items()))

    def place(self, lines):
        """Index of the line among those of its file.

        Raises Stale if it is not there once.
        """
        start, end = 0, len(lines)
        for text in self.within:
            heads = [i for i in range(start, end) if text in lines[i]]
            if len(heads) != 1:
                raise Stale(f"{self.file}: {len(heads)} lines hold {text!r}")
            start = heads[0]
            end = closing(lines, start, end)
        found = [i for i in range(start, end) if lines[i].strip() == self.line]
        if len(found) != 1:
            raise Stale(f"{self.file}: the line stands there {len(found)} times: {self.line}")
        return found[0]

    def faulty(self, old):
        """The line in place of an old one, with its indentation."""
        return indentation(old) + self.becomes if self.becomes else ""


def indentation(line):
    return line[:len(line) - len(line.lstrip())]


def closing(lines, start, end):
    """Where the item ends that begins at `start`: after the first line of its indentation that closes something."""
    own = indentation(lines[start])
    for i in range(start + 1, end):
        if indentation(lines[i]) == own and lines[i].lstrip()[:1] in ("}", ")", "]"):
            # `) -> T {` closes arguments and opens a body.
            if not lines[i].rstrip().endswith("{"):
                return i + 1
    return end


def load(paths):
    """All faults of some files, in their order.

    Raises Malformed.
    """
    faults = []
    for path in paths:
        try:
            text = tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise Malformed(f"{path.name}: {error}") from error
        unknown = set(text) - {"fault"}
        if unknown:
            raise Malformed(f"{path.name}: {', '.join(sorted(unknown))} stands beside the faults")
        faults += [Fault(entry, path.name) for entry in text.get("fault", [])]
    names = [fault.name for fault in faults]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise Malformed(f"a name stands twice: {', '.join(twice)}")
    same = {}
    for fault in faults:
        key = (fault.file, tuple(fault.within), fault.line, fault.becomes)
        if key in same:
            raise Malformed(f"{fault.name} is {same[key]} once more")
        same[key] = fault.name
    return faults


def binaries(root):
    """Name of each test binary: its package and its source."""
    found = {}
    for manifest in ("tests/Cargo.toml", "verify/Cargo.toml"):
        path = root / manifest
        if path.is_file():
            text = tomllib.loads(path.read_text(encoding="utf-8"))
            for test in text.get("test", []):
                found[test["name"]] = (text["package"]["name"], (path.parent / test["path"]).resolve())
    return found


def has_test(source, name):
    """Whether a file of tests, or one of its modules, has a function of that name with `#[test]` before it."""
    *modules, function = name.split("::")
    for module in modules:
        # The root of a test binary has its modules in a folder of its name, or beside itself.
        beside = [source.with_suffix("") / f"{module}.rs", source.parent / f"{module}.rs"]
        source = next((path for path in beside if path.is_file()), None)
        if source is None:
            return False
    text = source.read_text(encoding="utf-8")
    return re.search(rf"#\[test\]\s*(#\[[^\]]*\]\s*)*(pub\s+)?fn {re.escape(function)}\s*\(", text) is not None


def wrong(root, fault, tests):
    """What is wrong with a fault as the source stands, or None."""
    path = root / fault.file
    if not path.is_file():
        return f"{fault.file} is not there"
    try:
        fault.place(path.read_text(encoding="utf-8").splitlines())
    except Stale as stale:
        return str(stale)
    if fault.killer is not None and fault.binary not in tests:
        return f"there is no test binary {fault.binary}"
    if fault.killer is not None and not has_test(tests[fault.binary][1], fault.test):
        return f"{fault.binary} has no test {fault.test}"
    if fault.fuzz is not None and not (root / "fuzz/targets" / f"{fault.fuzz}.rs").is_file():
        return f"there is no fuzz target {fault.fuzz}"
    return None
