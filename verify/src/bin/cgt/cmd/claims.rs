//! `cgt claims`: the paper's claims one by one, computed anew.

use super::verify::{load, warn};
use crate::args::Claims as Args;
use crate::environment::environment;
use crate::{Failure, progress, say};
use contract::{Camera, Scene};
use optimized::Plan;
use rayon::prelude::*;
use std::process::ExitCode;
use verify::paper::record::{Record, SCENES, SCHEMA_VERSION};
use verify::paper::text::text;
use verify::paper::{LEMMAS, Looked, claims, look, proofs, ticks};
use verify::picture::{check_file, write_atomically};
use verify::prove::prover::{Finding, Outcome};
use verify::prove::solver::Solver;
use verify::scenes::catalogue::{Source, SourceError};
use verify::seed::seed;
use verify::spu::survey::Input;

/// A lemma is refuted, or a proof has something wrong.
const WRONG: u8 = 1;
/// No verdict on all of what was asked.
const NO_VERDICT: u8 = 3;

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    for file in [&args.json, &args.markdown].into_iter().flatten() {
        check_file(file)?;
    }
    let (mut scenes, mut absent) = (Vec::new(), 0_usize);
    for word in names(args) {
        // Of the scenes of choice some may not have been fetched; one that is named must be there.
        if args.scenes.is_empty()
            && let Err(SourceError::DataAbsent { name, how }) = Source::parse(&word)?.load()
        {
            say(&format!("not judged: {name}: data absent (run {how})\n"))?;
            absent += 1;
            continue;
        }
        let (loaded, scene) = load(&word, args.view.frame)?;
        warn(&loaded);
        let camera = loaded.camera(&args.view.framing())?;
        scenes.push((word, scene, camera));
    }
    let looked = all(args, &scenes)?;
    let (solvers, seed) = (Solver::all(), seed());
    let said = said(&solvers, seed);
    let claims = claims(&looked, &said, seed);
    say(&format!("CGT_SEED={seed}\n{}", text(&claims)))?;
    if solvers.is_empty() {
        say("not judged: proofs: no solver was found; tests/fetch-solvers brings two\n")?;
        absent += 1;
    }
    let mut wrong = 0_usize;
    for one in &said {
        match &one.outcome {
            Outcome::NotShown(why) => {
                say(&format!("not judged: {}: {why}\n", one.name))?;
                absent += 1;
            }
            Outcome::Refuted(_) => {
                say(&format!("WRONG: {} is refuted\n", one.name))?;
                wrong += 1;
            }
            Outcome::Proved | Outcome::NotJudged => {}
        }
        for why in &one.wrong {
            say(&format!("WRONG: {}: {why}\n", one.name))?;
            wrong += 1;
        }
    }
    let size =
        scenes.first().map_or([0; 2], |(_, _, camera)| [camera.size().width(), camera.size().height()]);
    let mut environment = environment(args.view.threads(), &[]);
    environment.seed = Some(seed);
    let record = Record {
        schema_version: SCHEMA_VERSION,
        kind: "claims".into(),
        environment,
        seed,
        size,
        sample: args.sample,
        scenes: scenes.into_iter().map(|(word, ..)| word).collect(),
        claims,
    };
    if let Some(file) = &args.json {
        write_atomically(file, (serde_json::to_string_pretty(&record)? + "\n").as_bytes())?;
    }
    if let Some(file) = &args.markdown {
        write_atomically(file, record.markdown().as_bytes())?;
    }
    Ok(match (wrong, absent) {
        (1.., _) => ExitCode::from(WRONG),
        (0, 1..) => ExitCode::from(NO_VERDICT),
        (0, 0) => ExitCode::SUCCESS,
    })
}

/// What the solvers say of the lemmas that claims rest on.
pub(crate) fn said(solvers: &[Solver], seed: u64) -> Vec<Finding> {
    let lemmas: usize = LEMMAS.iter().map(|names| names.len()).sum();
    let tick = progress::bar("claims", "lemmas", u32::try_from(lemmas).unwrap_or(u32::MAX));
    proofs(solvers, seed, &*tick)
}

fn names(args: &Args) -> Vec<String> {
    if args.scenes.is_empty() { SCENES.map(str::to_owned).into() } else { args.scenes.clone() }
}

/// Looks at all scenes, as many side by side as there are threads.
pub(crate) fn all(args: &Args, scenes: &[(String, Scene, Camera)]) -> Result<Vec<Looked>, Failure> {
    let rows = scenes.iter().map(|(_, _, camera)| ticks(camera.size().height())).sum();
    let tick = progress::bar("claims", "on the SPU model", rows);
    let one = |(name, scene, camera): &(String, Scene, Camera)| {
        let input = Input {
            name,
            frame: args.view.frame,
            scene,
            camera,
            plan: Plan::paper(),
            every: args.sample,
            unlimited: true,
        };
        look(&input, &*tick).map_err(|error| Failure::from(format!("{name}: {error}")))
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(args.view.threads()).build()?;
    pool.install(|| scenes.par_iter().map(one).collect())
}
