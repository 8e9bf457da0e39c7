//! Can the crates leave this repository? What their code includes must be in their packages, and nothing that they print or keep may be global.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Packages, and the folders of their sources.
const PACKAGES: [(&str, &str); 5] = [
    ("live", "verify/live"),
    ("contract", "verify/contract"),
    ("reference", "reference"),
    ("optimized", "optimized"),
    ("verify", "verify"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let all = entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] });
    all.filter(|path| path.extension().is_some_and(|end| end == "rs")).collect()
}

/// The files that a text includes when it is compiled, by the names it gives them; of a name that a macro puts together the folder.
fn included(text: &str) -> Vec<String> {
    let starts = ["include_bytes!(", "include_str!(", "include!("];
    let found =
        starts.iter().flat_map(|start| text.match_indices(start).map(move |(at, _)| at + start.len()));
    let name = |at: usize| text[at..].trim_start_matches("concat!(").split('"').nth(1).map(str::to_owned);
    found.filter_map(name).collect()
}

#[test]
fn what_is_included_is_packed() {
    let mut count = 0;
    for (package, folder) in PACKAGES {
        let mut list = Command::new(env!("CARGO"));
        list.args(["package", "--list", "--allow-dirty", "--offline", "-p", package]).current_dir(root());
        let list = list.output().expect("cargo runs");
        assert!(list.status.success(), "{package}: {}", String::from_utf8_lossy(&list.stderr));
        let packed = String::from_utf8(list.stdout).expect("names of files");
        let packed: Vec<&str> = packed.lines().collect();
        assert!(packed.contains(&"Cargo.toml") && packed.contains(&"README.md"), "{package}: {packed:?}");
        let home = root().join(folder).canonicalize().expect("it is there");
        for source in sources(&home.join("src")) {
            let text = std::fs::read_to_string(&source).expect("readable");
            for name in included(&text) {
                let mut place = source.parent().expect("it has a folder").to_path_buf();
                for part in Path::new(&name) {
                    if part == ".." { assert!(place.pop(), "{name}") } else { place.push(part) }
                }
                let inside = place.strip_prefix(&home);
                let inside =
                    inside.unwrap_or_else(|_| panic!("{}: {name} lies outside {package}", source.display()));
                let inside = inside.to_string_lossy();
                assert!(
                    packed.iter().any(|file| file.starts_with(&*inside)),
                    "{}: {inside} is not packed with {package}",
                    source.display()
                );
                count += 1;
            }
        }
        for template in std::fs::read_dir(home.join("templates")).into_iter().flatten() {
            let name = template.expect("an entry").file_name();
            let name = format!("templates/{}", name.to_string_lossy());
            assert!(packed.contains(&name.as_str()), "{name} is not packed");
            count += 1;
        }
    }
    assert!(count > 20, "hardly a file was looked at: {count}");
}

/// Nothing of the libraries lives beyond a call: no state that two users of one process would share.
#[test]
fn the_tracers_keep_nothing_global() {
    for package in ["verify/contract", "reference", "optimized"] {
        for source in sources(&root().join(package).join("src")) {
            let text = std::fs::read_to_string(&source).expect("readable");
            for word in [
                "static mut",
                "thread_local!",
                "OnceLock",
                "LazyLock",
                "OnceCell",
                "AtomicPtr",
                "println!",
                "print!(",
                "eprint",
            ] {
                let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
                let line = code.into_iter().find(|line| line.contains(word));
                assert_eq!(line, None, "{}: {word}", source.display());
            }
        }
    }
}
