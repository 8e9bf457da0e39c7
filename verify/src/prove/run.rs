//! Claims put to the solvers, and what came of it: lemma by lemma, kernel by kernel.

use super::claims::{CLAIMS, Claim, NONE, lemmas};
use super::prover::{Effort, Faults, Finding, Outcome, break_each, prove};
use super::solver::Solver;
use super::theorem::{Expected, Lemma};
use crate::report::Evidence;
use crate::seed::generator;
use rayon::prelude::*;
use serde::Serialize;

/// Version of the layout of the JSON.
pub const SCHEMA_VERSION: u32 = 1;

/// Everything that was found out.
#[derive(Clone, Debug, Serialize)]
pub struct Proofs {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Who was asked.
    pub solvers: Vec<String>,
    /// Seed of what was drawn.
    pub seed: u64,
    /// What is claimed of what was asked for, and what was found of it in this run.
    pub claims: Vec<Found>,
    /// Each lemma.
    pub lemmas: Vec<Finding>,
    /// Each kernel with its operations done wrong.
    pub faults: Vec<Faults>,
    /// Lemmas that need more time than this run had.
    pub left_out: Vec<&'static str>,
}

/// A claim, and what was found of it.
#[derive(Clone, Debug, Serialize)]
pub struct Found {
    /// What is claimed.
    pub statement: &'static str,
    /// The kind of evidence that is promised.
    pub promised: Evidence,
    /// The kind that this run gave, if it judged the claim at all.
    pub found: Option<Evidence>,
}

/// One lemma after the other, then one kernel after the other, two or more at a time.
#[must_use]
pub fn run(
    wanted: impl Fn(&Lemma) -> bool,
    long: bool,
    solvers: &[Solver],
    seed: u64,
    tick: &(dyn Fn() + Sync),
) -> Proofs {
    let effort = if long { Effort::LONG } else { Effort::EVERYDAY };
    let (lemmas, left_out): (Vec<Lemma>, Vec<Lemma>) =
        lemmas().into_iter().filter(wanted).partition(|lemma| long || !lemma.long);
    let findings = ask(&lemmas, solvers, &effort, seed, tick);
    let faults = kernels(&lemmas)
        .into_par_iter()
        .enumerate()
        .with_max_len(1)
        .map(|(i, about)| {
            let faults = break_each(&about, solvers, &effort, &mut generator(seed, 1000 + i as u64));
            tick();
            faults
        })
        .collect();
    let asked = |claim: &&Claim| {
        claim
            .lemmas
            .iter()
            .any(|name| findings.iter().any(|f| f.name == *name) || left_out.iter().any(|l| l.name == *name))
    };
    let claims = CLAIMS.iter().filter(asked).map(|claim| found(claim, &findings)).collect();
    Proofs {
        schema_version: SCHEMA_VERSION,
        solvers: solvers.iter().map(|solver| format!("{} {}", solver.name, solver.version)).collect(),
        seed,
        claims,
        lemmas: findings,
        faults,
        left_out: left_out.iter().map(|lemma| lemma.name).collect(),
    }
}

/// What solvers say of lemmas; no kernel is broken for it.
#[must_use]
pub fn ask(
    lemmas: &[Lemma],
    solvers: &[Solver],
    effort: &Effort,
    seed: u64,
    tick: &(dyn Fn() + Sync),
) -> Vec<Finding> {
    let one = |(i, lemma): (usize, &Lemma)| {
        let finding = prove(lemma, solvers, effort, &mut generator(seed, i as u64));
        tick();
        finding
    };
    lemmas.par_iter().enumerate().with_max_len(1).map(one).collect()
}

/// Lemmas that hold, by the kernel they are about.
#[must_use]
pub fn kernels(lemmas: &[Lemma]) -> Vec<Vec<&Lemma>> {
    let mut kernels: Vec<Vec<&Lemma>> = Vec::new();
    for lemma in lemmas.iter().filter(|lemma| lemma.expected == Expected::Holds && lemma.kernel != NONE) {
        match kernels.iter_mut().find(|about| about[0].kernel == lemma.kernel) {
            Some(about) => about.push(lemma),
            None => kernels.push(vec![lemma]),
        }
    }
    kernels
}

fn found(claim: &Claim, findings: &[Finding]) -> Found {
    let of = |name: &str| findings.iter().find(|finding| finding.name == name);
    let all: Option<Vec<&Finding>> = claim.lemmas.iter().map(|name| of(name)).collect();
    let found = all.and_then(|all| {
        let judged = all.iter().all(|finding| finding.outcome != Outcome::NotJudged);
        let proved = |finding: &&Finding| finding.outcome == Outcome::Proved;
        let told = |finding: &&Finding| proved(finding) || matches!(finding.outcome, Outcome::Refuted(_));
        let found = if !all.iter().all(|finding| finding.wrong.is_empty() && told(finding)) {
            Evidence::NotShown
        } else if all.iter().all(proved) {
            Evidence::Proved
        } else {
            Evidence::Refuted
        };
        judged.then_some(found)
    });
    Found { statement: claim.statement, promised: claim.evidence, found }
}

impl Proofs {
    /// Everything that is wrong with any of it.
    #[must_use]
    pub fn wrong(&self) -> Vec<String> {
        let lemmas = self.lemmas.iter().map(|lemma| (lemma.name, &lemma.wrong));
        let kernels = self.faults.iter().map(|faults| (faults.kernel, &faults.wrong));
        lemmas
            .chain(kernels)
            .flat_map(|(name, wrong)| wrong.iter().map(move |wrong| format!("{name}: {wrong}")))
            .collect()
    }

    /// Lemmas of which no solver told, with the reason.
    #[must_use]
    pub fn not_shown(&self) -> Vec<String> {
        let why = |lemma: &Finding| match &lemma.outcome {
            Outcome::NotShown(why) => Some(format!("{}: {why}", lemma.name)),
            Outcome::NotJudged => Some(format!("{}: there is no solver that knows such numbers", lemma.name)),
            Outcome::Proved | Outcome::Refuted(_) => None,
        };
        self.lemmas.iter().filter_map(why).collect()
    }

    /// Lemmas and kernels that are asked about.
    #[must_use]
    pub fn questions(long: bool, wanted: impl Fn(&Lemma) -> bool) -> usize {
        let lemmas: Vec<Lemma> =
            lemmas().into_iter().filter(|lemma| (long || !lemma.long) && wanted(lemma)).collect();
        lemmas.len() + kernels(&lemmas).len()
    }
}

impl std::fmt::Display for Proofs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let solvers = if self.solvers.is_empty() { "none".into() } else { self.solvers.join(", ") };
        writeln!(f, "solvers: {solvers}; CGT_SEED={}", self.seed)?;
        writeln!(f, "{:30} {:9} {:>6} {:>7}", "lemma", "", "paths", "s")?;
        for lemma in &self.lemmas {
            let (word, rest) = match &lemma.outcome {
                Outcome::Proved => ("proved", String::new()),
                Outcome::NotShown(why) => ("not shown", why.clone()),
                Outcome::NotJudged => ("not judged", String::new()),
                Outcome::Refuted(inputs) => {
                    let inputs: Vec<String> =
                        inputs.iter().map(|(name, bits)| format!("{name} = {bits:#010x}")).collect();
                    ("refuted", inputs.join(", "))
                }
            };
            let line =
                format!("{:30} {word:10} {:>5} {:>7.2} {rest}", lemma.name, lemma.paths, lemma.seconds);
            writeln!(f, "{}", line.trim_end())?;
        }
        writeln!(
            f,
            "\n{:48} {:>6} {:>7} {:>8} {:>6} {:>7}",
            "kernel, done wrong", "faults", "noticed", "harmless", "open", "s"
        )?;
        for faults in &self.faults {
            let Faults { kernel, tried, noticed, harmless, open, seconds, .. } = faults;
            writeln!(
                f,
                "{kernel:48} {tried:>6} {noticed:>7} {harmless:>8} {:>6} {seconds:>7.2}",
                open.len()
            )?;
        }
        writeln!(f)?;
        for Found { statement, found, .. } in &self.claims {
            writeln!(f, "{:10} {statement}", found.map_or("not judged", Evidence::word))?;
        }
        for Faults { kernel, open, .. } in &self.faults {
            for fault in open {
                writeln!(f, "open: {kernel}: {fault}")?;
            }
        }
        for name in &self.left_out {
            writeln!(f, "left out: {name} takes long; --long proves it")?;
        }
        for wrong in self.wrong() {
            writeln!(f, "WRONG {wrong}")?;
        }
        Ok(())
    }
}
