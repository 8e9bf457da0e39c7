"""What a run of a test says about a fault."""

import os
import posixpath
import re
import subprocess
import tempfile
import time

KILLED, SURVIVOR, COMPILE, TIMEOUT = "killed", "survivor", "compile error", "time-out"
PANIC, STALE, UNCHANGED, NO_TEST = "panic alone", "no longer applies", "unchanged", "no such test"
UNSOUND = "fails without the fault"
NOT_JUDGED = "not judged"

PANICKED = re.compile(r"panicked at (?P<file>[^\n]*?):\d+:\d+:\n(?P<message>[^\n]*)")
RAN = re.compile(r"^running (\d+) test", re.MULTILINE)


class Ran:
    """How a test program ended."""

    def __init__(self, code, output, seconds):
        self.code, self.output, self.seconds = code, output, seconds

    @property
    def passed(self):
        """Whether the one test ran and passed."""
        return self.code == 0 and self.counted

    @property
    def counted(self):
        """Whether one test ran at all."""
        found = RAN.search(self.output)
        return found is not None and found.group(1) == "1"


def run(program, test, folder, environment, limit, before=()):
    """Runs one test of a program in a folder; the code is None if it was not done in time. `before`: words before the program's."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as out:
        child = subprocess.Popen([*before, program, "--exact", test, "--nocapture"], cwd=folder, env=environment,
                                 stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            code = child.wait(limit)
        except subprocess.TimeoutExpired:
            code = None
            # With all that it has begun; the session is its own.
            os.killpg(child.pid, 9)
            child.wait()
        out.seek(0)
        text = out.read().decode(errors="replace")
    return Ran(code, text, time.monotonic() - start)


def is_check(path, of_suite):
    """Whether a panic in that file is a check that says no, and not the program that fell over. What the suite's own faults
    make fall over is judged by the tests alone."""
    # Tests that belong to another package are named from its folder: `verify/../tests/cli.rs`.
    path = posixpath.normpath(path)
    return path.startswith("tests/") or (not of_suite and path.startswith("verify/") and "/contract/" not in path)


def verdict(ran, of_suite):
    """A verdict and what was said first."""
    if ran.code is None:
        return TIMEOUT, f"not done after {ran.seconds:.0f} s"
    if not ran.counted:
        return NO_TEST, "no test of that name ran"
    if ran.code == 0:
        return SURVIVOR, ""
    panics = [(found["file"], found["message"].strip()) for found in PANICKED.finditer(ran.output)]
    checks = [message for path, message in panics if is_check(path, of_suite)]
    if checks:
        return KILLED, checks[0]
    if panics:
        path, message = panics[0]
        return PANIC, f"{path}: {message}"
    if ran.code < 0 or ran.code > 101:
        return PANIC, f"ended by signal {-ran.code}" if ran.code < 0 else f"ended with {ran.code}"
    # A test may give an error in place of a panic.
    said = re.search(r"^Error: (.*)", ran.output, re.MULTILINE)
    return KILLED, said.group(1) if said else "it failed"
