//! `cgt chart`: scenes in, every method's speed against its error on the terminal and into files out.

use super::verify::{all_there, framed, load, warn};
use super::{distinct, files};
use crate::args::{Chart as Args, or_few};
use crate::environment::environment;
use crate::{Failure, progress};
use optimized::Level;
use std::process::ExitCode;
use verify::chart::{Asked, Chart, Distance, SCHEMA_VERSION, measure, page, text};
use verify::foreign::method;
use verify::methods::{Method, charted};
use verify::picture::check_folder;
use verify::report::Absent;
use verify::seed::seed;

/// Columns and rows of a picture where no size is asked for: slow methods take part.
const SIZE: [u32; 2] = [320, 180];

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    check_folder(&args.out)?;
    let chart = chart(args)?;
    let shown = (page::page(&chart)?, text::text(&chart));
    files::chapter("chart", &args.out, &chart, chart.csv()?, (&shown.0, &shown.1))?;
    Ok(super::kept(&chart.broken_promises()))
}

/// Measures all views of all scenes.
pub(crate) fn chart(args: &Args) -> Result<Chart, Failure> {
    let level = args.level.as_deref().map_or_else(Level::best, Level::named)?;
    let (threads, mut absent) = (args.view.threads(), Vec::<Absent>::new());
    let mut methods: Vec<Method> = charted(level, threads, &mut absent);
    methods.extend(args.own.tracers()?.iter().map(|tracer| method(tracer, threads)));
    distinct(methods.iter().map(|method| method.name.as_str()))?;
    let (names, seed) = (or_few(&args.scenes), seed());
    let (mut views, frame) = (Vec::new(), args.view.frame);
    all_there(&names, frame)?;
    for word in &names {
        let (loaded, scene) = load(word, frame)?;
        warn(&loaded);
        let framing = framed(&args.view, &loaded, SIZE)?;
        for times in &args.far {
            let at = Distance::new(&loaded.animation, &framing, *times)?;
            let asked = Asked {
                name: word,
                frame,
                scene: &scene,
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
