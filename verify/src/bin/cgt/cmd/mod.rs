//! The subcommands.

pub(crate) mod ablate;
pub(crate) mod bench;
pub(crate) mod campaign;
pub(crate) mod chart;
pub(crate) mod claims;
pub(crate) mod figures;
mod files;
pub(crate) mod manual;
pub(crate) mod prove;
pub(crate) mod render;
pub(crate) mod replay;
pub(crate) mod report;
pub(crate) mod scenes;
pub(crate) mod spu;
pub(crate) mod stability;
pub(crate) mod verify;
pub(crate) mod view;

use crate::Failure;
use ::verify::verdict::Verdict;
use std::collections::HashSet;
use std::io::Write;
use std::process::ExitCode;

/// Tracers are told apart by their names.
fn distinct<'a>(mut names: impl Iterator<Item = &'a str>) -> Result<(), Failure> {
    let mut known = HashSet::new();
    match names.find(|name| !known.insert(*name)) {
        Some(name) => {
            Err(format!("two tracers are called `{name}`; --subject-cmd NAME=COMMAND gives another name")
                .into())
        }
        None => Ok(()),
    }
}

/// The exit code of a report.
fn ending(verdict: Verdict) -> ExitCode {
    match verdict {
        Verdict::Equal | Verdict::WithinBound => ExitCode::SUCCESS,
        Verdict::Wrong => ExitCode::from(1),
        Verdict::Undecidable | Verdict::NotJudged => ExitCode::from(3),
    }
}

/// The exit code of a run in which these broke their promise of the truth; each is named on standard error.
fn kept(broken: &[String]) -> ExitCode {
    for line in broken {
        _ = writeln!(std::io::stderr(), "wrong where it promised not to be: {line}");
    }
    if broken.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) }
}
