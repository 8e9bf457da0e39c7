"""What the scripts share that bring packages: hashes, clients of registries, and files that are there whole or not."""

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER = Path(os.environ.get("CGT_DATA") or ROOT / "tests/data/fetched")
# Seconds for what computes; some 20 are needed.
RUN_LIMIT = 400


class Unavailable(Exception):
    """A package could not be had, or holds something else than it should."""


def say(text):
    print(text, file=sys.stderr)


def sha256(path):
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        for block in iter(lambda: file.read(1 << 20), b""):
            digest.update(block)
    return digest.hexdigest()


def fault(path, expected):
    """What is wrong with a file, or None."""
    if callable(expected):
        return expected(path)
    found = sha256(path)
    return None if found == expected else f"SHA-256 is {found}, expected {expected}"


def run(*command, cwd, env=None):
    """Runs a client; its output is shown only if it fails."""
    if shutil.which(command[0]) is None:
        raise Unavailable(f"{command[0]} is not installed")
    try:
        done = subprocess.run(command, cwd=cwd, env=env, timeout=RUN_LIMIT if env else None,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    except subprocess.TimeoutExpired as late:
        raise Unavailable(f"{' '.join(command)} was not done after {RUN_LIMIT} seconds") from late
    if done.returncode != 0:
        last = "\n    ".join(done.stdout.strip().splitlines()[-5:])
        raise Unavailable(f"{' '.join(command)} failed:\n    {last}")
    return done.stdout


def keep(source, name, expected, folder=FOLDER):
    """Puts a file into a folder under its name, if it is the right one."""
    wrong = fault(source, expected)
    if wrong:
        raise Unavailable(f"{name}: {wrong}; not kept")
    folder.mkdir(parents=True, exist_ok=True)
    handle, part = tempfile.mkstemp(prefix=f".{name}.", dir=folder)
    os.close(handle)
    try:
        shutil.copyfile(source, part)
        os.chmod(part, 0o644)
        os.replace(part, folder / name)
    except BaseException:
        os.unlink(part)
        raise
    say(f"  {name}")


def right(path, expected, what):
    """A file that is to be used; refused if it is missing or not the right one."""
    wrong = fault(path, expected) if path is not None else "not there"
    if wrong:
        raise Unavailable(f"{what}: {wrong}")
    return path


def wheel(package, version, expected, work, *options):
    """A wheel of a pinned version, by pip, checked."""
    run(sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary", ":all:", *options,
        f"{package}=={version}", cwd=work)
    return right(next(work.glob(f"{package}-*.whl"), None), expected, f"the wheel of {package} {version}")
