//! The subcommands.

pub(crate) mod ablate;
pub(crate) mod bench;
pub(crate) mod chart;
pub(crate) mod claims;
pub(crate) mod figures;
mod files;
pub(crate) mod prove;
pub(crate) mod render;
pub(crate) mod replay;
pub(crate) mod report;
pub(crate) mod scenes;
pub(crate) mod spu;
pub(crate) mod stability;
pub(crate) mod verify;
pub(crate) mod view;

use std::io::Write;
use std::process::ExitCode;

/// The exit code of a run in which these broke their promise of the truth; each is named on standard error.
fn kept(broken: &[String]) -> ExitCode {
    for line in broken {
        _ = writeln!(std::io::stderr(), "wrong where it promised not to be: {line}");
    }
    if broken.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) }
}
