//! Hands the compiler's name and the target on to the program, which prints them in every report; with the feature
//! `embree`, tells the linker and the programs where the library is that `EMBREE_DIR` names.

use std::path::{Path, PathBuf};
use std::process::Command;

fn main() {
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    let version = Command::new(rustc).arg("--version").output();
    let version = version.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    let version = version.unwrap_or_else(|_| "unknown".into());
    let target = std::env::var("TARGET").unwrap_or_else(|_| "unknown".into());
    tell(&format!("rustc-env=CGT_RUSTC={version}"));
    tell(&format!("rustc-env=CGT_TARGET={target}"));
    if std::env::var_os("CARGO_FEATURE_EMBREE").is_some() {
        embree();
    }
}

/// The library's folder: to be searched when linking, and written into the programs of this package.
fn embree() {
    tell("rerun-if-env-changed=EMBREE_DIR");
    let Ok(given) = std::env::var("EMBREE_DIR") else { return };
    let given = Path::new(&given);
    let there = |folder: &PathBuf| folder.join("libembree4.so").exists();
    if let Some(folder) =
        [given.join("lib"), given.join("lib64"), given.to_path_buf()].into_iter().find(there)
    {
        tell(&format!("rustc-link-search=native={}", folder.display()));
        tell(&format!("rustc-link-arg=-Wl,-rpath,{}", folder.display()));
    }
}

/// The one way a build script speaks to cargo.
#[allow(clippy::print_stdout)]
fn tell(what: &str) {
    println!("cargo:{what}");
}
