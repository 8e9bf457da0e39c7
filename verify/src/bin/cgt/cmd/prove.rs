//! `cgt prove`: the shipped kernels put to the solvers that are there.

use super::files;
use crate::args::Prove as Args;
use crate::{Failure, progress, say};
use std::process::ExitCode;
use verify::picture::{check_file, write_atomically};
use verify::prove::claims::lemmas;
use verify::prove::run::{Proofs, run as prove};
use verify::prove::solver::Solver;
use verify::prove::theorem::Lemma;
use verify::seed::seed;

/// No verdict: there is no solver, or none could tell.
const NO_VERDICT: u8 = 3;

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    if let Some(file) = &args.json {
        check_file(file)?;
    }
    let wanted =
        |lemma: &Lemma| args.lemmas.is_empty() || args.lemmas.iter().any(|name| lemma.name.starts_with(name));
    let chosen: Vec<Lemma> = lemmas().into_iter().filter(wanted).collect();
    if chosen.is_empty() {
        return Err(format!("no lemma is named {}", args.lemmas.join(" or ")).into());
    }
    if let Some(folder) = &args.smt {
        files::folder(folder)?;
        for lemma in &chosen {
            let text = lemma.text().map_err(|why| format!("{}: {why}", lemma.name))?;
            write_atomically(&folder.join(format!("{}.smt2", lemma.name)), text.as_bytes())?;
        }
    }
    let solvers = Solver::all();
    let questions = Proofs::questions(args.long, wanted);
    let tick = progress::bar("prove", "lemmas and kernels", u32::try_from(questions).unwrap_or(u32::MAX));
    let proofs = prove(wanted, args.long, &solvers, seed(), &*tick);
    say(&proofs.to_string())?;
    files::write("prove", (args.json.as_deref(), None), &proofs, |_| Ok::<_, Failure>(String::new()))?;
    if !proofs.wrong().is_empty() {
        return Ok(ExitCode::FAILURE);
    }
    if solvers.is_empty() {
        say("not judged: no solver was found; tests/fetch-solvers brings two\n")?;
    }
    let told = !proofs.lemmas.is_empty() && proofs.not_shown().is_empty();
    Ok(if told { ExitCode::SUCCESS } else { ExitCode::from(NO_VERDICT) })
}
