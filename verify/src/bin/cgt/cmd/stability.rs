//! `cgt stability`: where every method breaks, on the terminal and into files out.

use super::verify::{framed, load, warn};
use super::{distinct, files};
use crate::args::{Stability as Args, View};
use crate::environment::environment;
use crate::{Failure, progress};
use optimized::Level;
use std::io::Write;
use std::process::ExitCode;
use verify::foreign::method;
use verify::methods::{Method, swept};
use verify::picture::{check_folder, write_atomically};
use verify::report::Absent;
use verify::seed::seed;
use verify::stability::measure::{Named, names};
use verify::stability::{Asked, SCHEMA_VERSION, Stability, page, stability, steps, text};

/// Scenes on which grid and packet are turned up, where none is named.
const SCENES: [&str; 4] = ["1hvr", "2juy", "sphereflake:3", "uniform:2000:1"];
/// Columns and rows of a picture where no size is asked for.
const SIZE: [u32; 2] = [320, 180];

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    check_folder(&args.out)?;
    let found = found(args)?;
    files::folder(&args.out)?;
    for (name, svg) in page::files(&found) {
        write_atomically(&args.out.join(name), svg.as_bytes())?;
    }
    let shown = (page::page(&found)?, text::text(&found));
    files::chapter("stability", &args.out, &found, found.csv()?, (&shown.0, &shown.1))?;
    let broken = found.broken_promises();
    if broken.is_empty() && found.compared() == 0 {
        _ = writeln!(std::io::stderr(), "no verdict: no method gave a picture that could be compared");
        return Ok(ExitCode::from(3));
    }
    Ok(super::kept(&broken))
}

/// Measures all of it.
pub(crate) fn found(args: &Args) -> Result<Stability, Failure> {
    let level = args.level.as_deref().map_or_else(Level::best, Level::named)?;
    let words = if args.scenes.is_empty() { SCENES.map(str::to_owned).to_vec() } else { args.scenes.clone() };
    let mut scenes = Vec::new();
    for word in &words {
        let (loaded, scene) = load(word, 0)?;
        warn(&loaded);
        let framing = framed(&View::default(), &loaded, SIZE)?;
        scenes.push(Named { name: word.clone(), camera: loaded.camera(&framing)?, scene });
    }
    let mut absent: Vec<Absent> = Vec::new();
    // Who is missing is missing everywhere.
    let tracers = args.own.tracers()?;
    let swept = |cells, absent: &mut Vec<Absent>| -> Vec<Method> {
        let own = tracers.iter().map(|tracer| method(tracer, 1));
        swept(cells, level, absent).into_iter().chain(own).collect()
    };
    let all: Vec<String> = swept(None, &mut absent).into_iter().map(|method| method.name).collect();
    distinct(all.iter().map(String::as_str))?;
    known(&args.methods, &all, "method")?;
    known(&args.only, &names(), "sweep")?;
    let wanted = |method: &Method| args.methods.is_empty() || args.methods.contains(&method.name);
    let methods =
        |cells| -> Vec<Method> { swept(cells, &mut Vec::new()).into_iter().filter(&wanted).collect() };
    let seed = seed();
    let asked = Asked { methods: &methods, level, rays: args.rays, seed, scenes: &scenes, only: &args.only };
    let tick = progress::bar("stability", "values", steps(&asked));
    let (curves, maps) = stability(&asked, &*tick);
    let mut environment = environment(1, &[level]);
    environment.seed = Some(seed);
    Ok(Stability {
        schema_version: SCHEMA_VERSION,
        kind: "stability",
        environment,
        absent,
        rays: args.rays,
        curves,
        maps,
    })
}

/// Refuses names that are none.
fn known(given: &[String], all: &[String], what: &str) -> Result<(), Failure> {
    match given.iter().find(|name| !all.contains(name)) {
        Some(name) => Err(format!("`{name}` is no {what}; there are {}", all.join(", ")).into()),
        None => Ok(()),
    }
}
