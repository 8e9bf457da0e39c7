"""Scratch copies of the repository and what cargo makes of them. Nothing is written outside the folder that is given."""

import hashlib
import json
import os
import shutil
import struct
import subprocess
from pathlib import Path

# Seconds for a build from nothing on two cores that others use as well.
BUILD_LIMIT = 3600


class CannotBuild(Exception):
    """What cargo says, where no fault is to blame."""


class Copy:
    """A scratch copy of a tree, brought up to date file by file, so that cargo builds anew only what differs."""

    def __init__(self, root, folder):
        self.root, self.folder = root, folder

    def update(self, changed):
        """Makes it the tree, but for some files whose texts are given."""
        names = files(self.root)
        for name in names:
            text = changed.get(name)
            self.put(name, (self.root / name).read_bytes() if text is None else text.encode())
        kept = set(names)
        for path in self.folder.rglob("*"):
            name = path.relative_to(self.folder).as_posix()
            if path.is_file() and name not in kept and not name.startswith(("fuzz/learned/", "fuzz/artifacts/")):
                path.unlink()

    def put(self, name, content):
        path = self.folder / name
        if path.is_file() and path.read_bytes() == content:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
        shutil.copymode(self.root / name, path)


def files(root):
    """Names of all files that belong to the tree: those that git knows and that are there."""
    if (root / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root,
                                stdout=subprocess.PIPE, check=True).stdout.decode().split("\0")
        return sorted({name for name in listed if name and (root / name).is_file()})
    found = (path.relative_to(root) for path in root.rglob("*") if path.is_file())
    return sorted(path.as_posix() for path in found if path.parts[0] != "target")


class Build:
    """What a run of cargo gave: test programs by name, and the errors with their places: lines, or lines and columns."""

    def __init__(self):
        self.programs, self.helpers, self.errors, self.spans = {}, [], [], []


# How test programs are built: what is their own as fast as it compiles, what they use as fast as it runs.
BUILD = ("--config", "profile.dev.opt-level=1", "--config", "profile.dev.debug=false", "--config", 'profile.dev.package."*".opt-level=3')


def build(folder, target, binaries, packages, offline, before=(), features=(), environment=None, limit=BUILD_LIMIT, settings=BUILD):
    """Test programs of some binaries of some packages; `before`: words before cargo's.

    Raises CannotBuild if cargo fails without an error in a file, and subprocess.TimeoutExpired.
    """
    refresh(folder, target)
    words = [*before, "cargo", "test", "--no-run", *settings]
    for feature in features:
        words += ["--features", feature]
    for package in sorted(packages):
        words += ["--package", package]
    for name in sorted(binaries):
        words += ["--test", name]
    return cargo(words, folder, target, offline, environment, limit)


def refresh(folder, target):
    """Makes what another copy has otherwise look new. Cargo tells packages of two copies in one target apart by nothing but the times of
    their files, and would take what it has made of the other."""
    last = target / "last-copy"
    other = Path(last.read_text(encoding="utf-8")) if last.is_file() else None
    if other is not None and other != folder:
        for path in folder.rglob("*"):
            twin = other / path.relative_to(folder)
            if path.is_file() and not (twin.is_file() and twin.read_bytes() == path.read_bytes()):
                os.utime(path)
    target.mkdir(parents=True, exist_ok=True)
    last.write_text(str(folder), encoding="utf-8")


def cargo(words, folder, target, offline, environment=None, limit=BUILD_LIMIT):
    """What those words to cargo make; raises as `build`."""
    command = [*words, "--message-format=json"]
    if (folder / "Cargo.lock").is_file():
        command.append("--locked")
    if offline:
        command.append("--offline")
    environment = dict(environment or os.environ, CARGO_TARGET_DIR=str(target), CARGO_TERM_COLOR="never")
    done = subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=limit)
    made = Build()
    for line in done.stdout.splitlines():
        message = json.loads(line) if line.startswith("{") else {}
        if message.get("reason") == "compiler-artifact" and message.get("executable"):
            if "test" in message["target"]["kind"]:
                made.programs[message["target"]["name"]] = Path(message["executable"])
            else:
                made.helpers.append(Path(message["executable"]))
        elif message.get("reason") == "compiler-message" and message["message"]["level"] == "error":
            spans = list(message["message"]["spans"])
            # What a macro makes stands where the macro is called.
            for span in message["message"]["spans"]:
                while span.get("expansion"):
                    span = span["expansion"]["span"]
                    spans.append(span)
            made.errors.append((message["message"]["message"], [(span["file_name"], span["line_start"]) for span in spans]))
            made.spans.append([(span["file_name"], (span["line_start"], span["column_start"]), span["is_primary"]) for span in spans])
    if done.returncode != 0 and not made.errors:
        raise CannotBuild("\n".join(done.stderr.strip().splitlines()[-15:]))
    return made


# Sections that hold what a program does and the numbers it does it with; not those with places in the source.
SECTIONS = (".text", ".rodata")


def digest(path):
    """What identifies a program's code."""
    data = path.read_bytes()
    found = sections(data)
    parts = [found[name] for name in SECTIONS if name in found]
    return hashlib.sha256(b"\0".join(parts) if parts else data).hexdigest()


def sections(data):
    """Contents of the sections of an ELF file of 64 bits by name; none if it is something else."""
    if data[:6] != b"\x7fELF\x02\x01":
        return {}
    offset, = struct.unpack_from("<Q", data, 40)
    size, count, names = struct.unpack_from("<HHH", data, 58)
    heads = [struct.unpack_from("<IIQQQQ", data, offset + i * size) for i in range(count)]
    strings = heads[names][4]
    out = {}
    for name, _, _, _, start, length in heads:
        end = data.index(b"\0", strings + name)
        out[data[strings + name:end].decode()] = data[start:start + length]
    return out
