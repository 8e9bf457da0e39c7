//! Do the proofs hold?

use std::time::Instant;
use verify::prove::claims::lemmas;
use verify::prove::solver::Solver;
use verify::prove::theorem::{Effort, Expected, Lemma, break_each, prove};
use verify::seed::{generator, seed};

#[test]
fn lemmas_are_proved() {
    let seed = seed();
    let solvers = Solver::all();
    let only = std::env::var("CGT_PROOFS").unwrap_or_default();
    eprintln!("CGT_SEED={seed}; {:?}", solvers.iter().map(|s| &s.version).collect::<Vec<_>>());
    let start = Instant::now();
    let mut bad = Vec::new();
    let lemmas: Vec<Lemma> = lemmas().into_iter().filter(|lemma| lemma.name.starts_with(&only)).collect();
    for (i, lemma) in (0..).zip(&lemmas) {
        let f = prove(lemma, &solvers, &Effort::EVERYDAY, &mut generator(seed, i));
        eprintln!(
            "{:24} {:.2} s, {} paths, {} compared, {} needed: {:?}",
            f.name, f.seconds, f.paths, f.compared, f.needed, f.outcome
        );
        bad.extend(f.wrong.iter().map(|wrong| format!("{}: {wrong}", f.name)));
    }
    let mut kernels: Vec<&str> = lemmas.iter().map(|lemma| lemma.kernel).collect();
    kernels.dedup();
    for kernel in kernels {
        let about: Vec<&Lemma> = lemmas
            .iter()
            .filter(|lemma| lemma.kernel == kernel && lemma.expected == Expected::Holds)
            .collect();
        let f = break_each(&about, &solvers, &Effort::EVERYDAY, &mut generator(seed, 99));
        eprintln!(
            "{:32} {:.2} s, {} tried, {} noticed, {} harmless, {} open",
            f.kernel, f.seconds, f.tried, f.noticed, f.harmless, f.open
        );
        bad.extend(f.wrong.iter().map(|wrong| format!("{}: {wrong}", f.kernel)));
    }
    eprintln!("{:.1} s", start.elapsed().as_secs_f64());
    assert!(bad.is_empty(), "{bad:#?}");
}
