//! Hands the compiler's name and the target on to the program, which prints them in every report.

use std::process::Command;

fn main() {
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    let version = Command::new(rustc).arg("--version").output();
    let version = version.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    let version = version.unwrap_or_else(|_| "unknown".into());
    let target = std::env::var("TARGET").unwrap_or_else(|_| "unknown".into());
    for (name, value) in [("CGT_RUSTC", version), ("CGT_TARGET", target)] {
        // The one way a build script speaks to cargo.
        #[allow(clippy::print_stdout)]
        {
            println!("cargo:rustc-env={name}={value}");
        }
    }
}
