//! `cgt bench`: scenes in, times on the terminal and into files out.

use super::files;
use super::verify::{all_there, load, warn};
use crate::args::{Bench as Args, default_scenes};
use crate::environment::environment;
use crate::{Failure, progress, say};
use optimized::Level;
use std::io::IsTerminal;
use std::process::ExitCode;
use std::time::Duration;
use verify::bench::baseline::compare;
use verify::bench::curves::Asked;
use verify::bench::data::{Held, SCHEMA_VERSION};
use verify::bench::text::text;
use verify::bench::{
    Bench, Effort, Field, Input, Outsider, SceneBench, Setting, Summary, bench, curves, page,
};
use verify::picture::{check_file, check_folder};
use verify::report::Absent;
use verify::seed::seed;
use verify::subject::NamedPlan;
use verify::verdict::Verdict;

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    // What is to be written and read is asked for before minutes are spent.
    if let Some(file) = &args.json {
        check_file(file)?;
    }
    if let Some(folder) = &args.out {
        check_folder(folder)?;
    }
    let report = measured(args)?;
    files::write("bench", (args.json.as_deref(), args.out.as_deref()), &report, page)?;
    say(&text(&report, std::io::stdout().is_terminal()))?;
    if let Some(folder) = &args.out {
        say(&format!("page: {}\n", folder.join("bench.html").display()))?;
    }
    let held = report.baseline.as_ref();
    Ok(match report.verdict() {
        Verdict::Wrong => ExitCode::from(1),
        Verdict::Undecidable | Verdict::NotJudged => ExitCode::from(3),
        _ if held.is_some_and(Held::is_slower) => ExitCode::from(4),
        _ if held.is_some_and(|held| !held.missing.is_empty()) => ExitCode::from(3),
        Verdict::Equal | Verdict::WithinBound => ExitCode::SUCCESS,
    })
}

/// Checks and times all that was asked for.
pub(crate) fn measured(args: &Args) -> Result<Bench, Failure> {
    let level = args.level.as_deref().map_or_else(Level::best, Level::named)?;
    let plan = NamedPlan::ALL.into_iter().find(|plan| plan.name() == args.plan).unwrap_or(NamedPlan::Fast);
    let threads = args.view.threads();
    let baseline = args.baseline.as_ref().map(|file| {
        let text = std::fs::read_to_string(file);
        text.map_err(|error| format!("the baseline `{}`: {error}", file.display()))
    });
    let baseline = baseline.transpose()?;
    let (field, absent) = field(args, level, threads);
    let effort = Effort { rounds: args.rounds.map(usize::from), time: Duration::from_secs_f64(args.seconds) };
    let setting = Setting { plan, level, threads, field: &field, picked: args.plans, effort, seed: seed() };
    let names = if args.scenes.is_empty() { default_scenes() } else { args.scenes.clone() };
    all_there(&names, args.view.frame)?;
    let scenes = names.iter().map(|word| one(word, args, &setting)).collect::<Result<Vec<_>, _>>()?;
    let curves =
        if args.curves { curves(&asked(args, &names[0], &setting), &bar("curves"))? } else { Vec::new() };
    let mut environment = environment(threads, &[level]);
    environment.seed = Some(setting.seed);
    let mut report = Bench {
        schema_version: SCHEMA_VERSION,
        kind: "bench",
        environment,
        plan: args.plan.clone(),
        level: level.name().into(),
        outsiders: field.names(),
        absent,
        summary: Summary::of(&scenes),
        scenes,
        curves,
        baseline: None,
    };
    if let Some(text) = baseline {
        report.baseline = Some(compare(&text, &report, args.tolerance / 100.0)?);
    }
    Ok(report)
}

/// The outsiders that were asked for and are there, and those that are not.
fn field(args: &Args, level: Level, threads: usize) -> (Field, Vec<Absent>) {
    let (mut field, mut absent) = (Field::new(threads), Vec::new());
    for outsider in outsiders(args) {
        let needed = args.peers.iter().any(|name| name == outsider.name());
        if let Err(why) = field.add(outsider, level) {
            absent.push(Absent { judge: outsider.name().into(), why, needed });
        }
    }
    (field, absent)
}

/// Those that were named; if none was, Embree.
fn outsiders(args: &Args) -> Vec<Outsider> {
    let named = |outsider: &Outsider| args.peers.iter().any(|name| name == outsider.name());
    let chosen =
        |outsider: &Outsider| named(outsider) || (args.peers.is_empty() && *outsider == Outsider::Embree);
    Outsider::ALL.into_iter().filter(chosen).collect()
}

fn one(word: &str, args: &Args, setting: &Setting<'_>) -> Result<SceneBench, Failure> {
    let (loaded, scene) = load(word, args.view.frame)?;
    warn(&loaded);
    let camera = loaded.camera(&args.view.framing())?;
    let input = Input { name: word, frame: args.view.frame, scene: &scene, camera: &camera };
    Ok(bench(&input, setting, &bar(word))?)
}

fn asked(args: &Args, scene: &str, setting: &Setting<'_>) -> Asked {
    Asked {
        scene: scene.into(),
        frame: args.view.frame,
        framing: args.view.framing(),
        plan: setting.plan,
        level: setting.level,
        outsiders: outsiders(args),
        effort: setting.effort,
        seed: setting.seed,
        threads: setting.threads,
        most_spheres: args.most_spheres,
        most_rows: args.most_rows,
        most_threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
    }
}

fn bar(word: &str) -> impl Fn(&str, u32) -> Box<dyn Fn() + Sync> {
    move |what, steps| progress::bar(word, what, steps)
}
