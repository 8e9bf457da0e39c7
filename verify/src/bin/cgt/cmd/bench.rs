//! `cgt bench`: scenes in, times on the terminal and into files out.

use super::verify::{load, warn};
use crate::args::{Bench as Args, default_scenes};
use crate::environment::environment;
use crate::{Failure, progress, say};
use optimized::Level;
use std::io::IsTerminal;
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;
use verify::bench::data::SCHEMA_VERSION;
use verify::bench::text::text;
use verify::bench::{Bench, Effort, Field, Input, Outsider, SceneBench, Setting, Summary, bench};
use verify::picture::{check_folder, write_atomically};
use verify::report::Absent;
use verify::seed::seed;
use verify::subject::NamedPlan;
use verify::verdict::Verdict;

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let level = args.level.as_deref().map_or_else(Level::best, Level::named)?;
    let plan = NamedPlan::ALL.into_iter().find(|plan| plan.name() == args.plan).unwrap_or(NamedPlan::Fast);
    let threads = args.view.threads();
    if let Some(file) = &args.json {
        check_folder(file.parent().unwrap_or(Path::new(".")))?;
    }
    let (field, absent) = field(args, level, threads);
    let effort = Effort { rounds: args.rounds.map(usize::from), time: Duration::from_secs_f64(args.seconds) };
    let setting = Setting { plan, level, threads, field: &field, effort, seed: seed() };
    let names = if args.scenes.is_empty() { default_scenes() } else { args.scenes.clone() };
    let scenes = names.iter().map(|word| one(word, args, &setting)).collect::<Result<Vec<_>, _>>()?;
    let mut environment = environment(threads, &[level]);
    environment.seed = Some(setting.seed);
    let report = Bench {
        schema_version: SCHEMA_VERSION,
        kind: "bench",
        environment,
        plan: args.plan.clone(),
        level: level.name().into(),
        outsiders: field.names(),
        absent,
        summary: Summary::of(&scenes),
        scenes,
        curves: Vec::new(),
    };
    if let Some(file) = &args.json {
        write_atomically(file, (serde_json::to_string_pretty(&report)? + "\n").as_bytes())?;
    }
    say(&text(&report, std::io::stdout().is_terminal()))?;
    Ok(match report.verdict() {
        Verdict::Equal | Verdict::WithinBound => ExitCode::SUCCESS,
        Verdict::Wrong => ExitCode::from(1),
        Verdict::Undecidable | Verdict::NotJudged => ExitCode::from(3),
    })
}

/// The outsiders that were asked for and are there, and those that are not.
fn field(args: &Args, level: Level, threads: usize) -> (Field, Vec<Absent>) {
    let (mut field, mut absent) = (Field::new(threads), Vec::new());
    for outsider in Outsider::ALL {
        let needed = args.peers.iter().any(|name| name == outsider.name());
        // Unless it is said who is to be asked, Embree is, where it is built in.
        let asked = needed || (args.peers.is_empty() && outsider == Outsider::Embree);
        if asked && let Err(why) = field.add(outsider, level) {
            absent.push(Absent { judge: outsider.name().into(), why, needed });
        }
    }
    (field, absent)
}

fn one(word: &str, args: &Args, setting: &Setting<'_>) -> Result<SceneBench, Failure> {
    let (loaded, scene) = load(word, args.view.frame)?;
    warn(&loaded);
    let camera = loaded.camera(&args.view.framing())?;
    let input = Input { name: word, frame: args.view.frame, scene: &scene, camera: &camera };
    Ok(bench(&input, setting, &|what, steps| progress::bar(word, what, steps))?)
}
