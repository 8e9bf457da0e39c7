//! Do the scripts that run and fetch for the tests say what failed, and keep nothing that is not what it should be?

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A program that says something and ends with a code.
#[cfg(unix)]
fn made_up(folder: &Path, name: &str, says: &str, code: i32) {
    use std::os::unix::fs::PermissionsExt;
    let file = folder.join(name);
    std::fs::write(&file, format!("#!/bin/sh\ncat <<'TEXT'\n{says}TEXT\nexit {code}\n")).expect("written");
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o755)).expect("it may run");
}

/// The one command that runs all tests fails if one of them does, if Embree's do, or if none ran. Its `cargo` is made up, and so is the Python
/// that would have Embree asked.
#[cfg(unix)]
#[test]
fn a_run_fails_if_a_test_does_or_none_ran() {
    let [good, bad] = ["ok. 3 passed; 0 failed", "FAILED. 2 passed; 1 failed"]
        .map(|word| format!("not judged: x: y\ntest result: {word}; 0 ignored\njudged by z 1.0\n"));
    for (says, code, embree, ends, judged) in [
        (good.as_str(), 0, 0, 0, "judged: 3 tests passed, 0 failed"),
        (&bad, 101, 0, 101, "judged: 2 tests passed, 1 failed"),
        // It did not even compile.
        ("", 101, 0, 101, "judged: 0 tests passed, 0 failed"),
        // Embree cannot be had; Embree's tests fail.
        (&good, 0, 3, 0, "judged: 3 tests passed, 0 failed"),
        (&good, 0, 101, 101, "judged: 3 tests passed, 0 failed"),
        (&bad, 101, 3, 101, "judged: 2 tests passed, 1 failed"),
        ("", 0, 0, 1, "judged: 0 tests passed, 0 failed"),
    ] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        made_up(folder.path(), "cargo", says, code);
        made_up(folder.path(), "python3", "", embree);
        let path = format!("{}:/usr/bin:/bin", folder.path().display());
        let mut command = Command::new("bash");
        command.arg(root().join("tests/run")).arg("--offline").env("PATH", path);
        let output = command.output().expect("there is a bash");
        let out = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(ends), "{code}, {embree}: {out}");
        assert!(out.contains(judged), "{out}");
        for line in ["judged by z 1.0", "not judged: x: y"] {
            assert_eq!(out.lines().rev().take(5).any(|told| told == line), !says.is_empty(), "{line}: {out}");
        }
    }
}

/// A file that is not the one that was pinned is refused, with both hashes, and leaves nothing behind.
#[test]
fn what_has_another_hash_is_not_kept() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("brought"), "abc").expect("written");
    let program = "import sys\nfrom pathlib import Path\nfrom fetching import Unavailable, keep, right\n\
                   here, digest = Path(sys.argv[1]), sys.argv[2]\n\
                   for use in (lambda: keep(here / 'brought', 'kept', digest, here / 'to'), lambda: right(here / 'brought', digest, 'it')):\n    \
                       try:\n        use()\n        print('taken')\n    \
                       except Unavailable as why:\n        print('refused:', why)\n";
    let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    let other = abc.replace("ba78", "ba79");
    for (digest, word) in [(&other, "refused"), (&abc.to_owned(), "taken")] {
        let mut command = Command::new("python3");
        command.args(["-c", program]).arg(folder.path()).arg(digest).current_dir(root().join("tests"));
        let Ok(output) = command.env("PYTHONDONTWRITEBYTECODE", "1").output() else {
            eprintln!("not judged: what is fetched: python3 is not installed");
            return;
        };
        let out = String::from_utf8_lossy(&output.stdout);
        let lines: Vec<&str> = out.lines().collect();
        assert!(
            lines.len() == 2 && lines.iter().all(|line| line.starts_with(word)),
            "{out}{}",
            String::from_utf8_lossy(&output.stderr)
        );
        if word == "refused" {
            assert!(lines.iter().all(|line| line.contains(abc) && line.contains(&other)), "{out}");
            assert!(!folder.path().join("to").exists(), "something was kept");
        } else {
            assert_eq!(std::fs::read_to_string(folder.path().join("to/kept")).expect("it is kept"), "abc");
        }
    }
}
