//! `cgt chart`: scenes in, every method's speed against its error on the terminal and into files out.

use super::files;
use super::verify::warn;
use crate::args::Chart as Args;
use crate::environment::environment;
use crate::{Failure, progress, say};
use optimized::Level;
use std::process::ExitCode;
use verify::chart::{Asked, Chart, Distance, SCHEMA_VERSION, measure, page, text};
use verify::methods::{Method, charted};
use verify::picture::{check_folder, write_atomically};
use verify::report::Absent;
use verify::scenes::catalogue::Source;
use verify::seed::seed;

/// Scenes that are charted where none is named.
const SCENES: [&str; 3] = ["1hvr", "sphereflake:3", "uniform:2000:1"];
/// Columns and rows of a picture where no size is asked for.
const SIZE: [u32; 2] = [320, 180];

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    check_folder(&args.out)?;
    let chart = chart(args)?;
    std::fs::create_dir_all(&args.out)
        .map_err(|error| format!("the folder `{}`: {error}", args.out.display()))?;
    write_atomically(&args.out.join("chart.csv"), &chart.csv()?)?;
    files::write("chart", (None, Some(&args.out)), &chart, page::page)?;
    say(&text::text(&chart))?;
    say(&format!("page: {}\n", args.out.join("chart.html").display()))?;
    Ok(super::kept(&chart.broken_promises()))
}

/// Measures all views of all scenes.
pub(crate) fn chart(args: &Args) -> Result<Chart, Failure> {
    let level = args.level.as_deref().map_or_else(Level::best, Level::named)?;
    let (threads, mut absent) = (args.view.threads(), Vec::<Absent>::new());
    let methods: Vec<Method> = charted(level, threads, &mut absent);
    let (names, seed) = (scenes(args), seed());
    let mut views = Vec::new();
    for word in &names {
        let loaded = Source::parse(word)?.load()?;
        warn(&loaded);
        let frames = loaded.animation.frames();
        let frame = args.view.frame;
        let scene = frames.get(frame).ok_or_else(|| format!("{word} has {} frames", frames.len()))?;
        let mut framing = args.view.framing().or(&loaded.framing.unwrap_or_default());
        if framing.size.is_none() {
            framing.size = Some(contract::Size::new(SIZE[0], SIZE[1])?);
        }
        for times in &args.far {
            let at = Distance::new(&loaded.animation, &framing, *times)?;
            let asked = Asked {
                name: word,
                frame,
                scene,
                methods: &methods,
                rounds: args.rounds.into(),
                every: args.sample,
                seed,
            };
            let named = format!("{word}, {times} times");
            views.push(measure(&asked, &at, &|what, steps| progress::bar(&named, what, steps))?);
        }
    }
    let mut environment = environment(threads, &[level]);
    environment.seed = Some(seed);
    Ok(Chart { schema_version: SCHEMA_VERSION, kind: "chart", environment, absent, views })
}

fn scenes(args: &Args) -> Vec<String> {
    if args.scenes.is_empty() { SCENES.map(str::to_owned).to_vec() } else { args.scenes.clone() }
}
