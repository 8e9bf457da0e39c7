//! `cgt spu`: scenes in, what they would cost on a PlayStation 3 on the terminal and into files out.

use super::files;
use super::verify::{load, warn};
use crate::args::Spu as Args;
use crate::environment::environment;
use crate::{Failure, progress, say};
use optimized::Plan;
use optimized::camera::BLOCK;
use optimized::plan::Resolution;
use std::process::ExitCode;
use verify::picture::{check_file, check_folder};
use verify::spu::curves::{Asked, Curve, POINTS, curves};
use verify::spu::data::{Report, SCHEMA_VERSION};
use verify::spu::host::{SEED, Way, on_host, walks};
use verify::spu::page::page;
use verify::spu::store::code_bytes;
use verify::spu::survey::{FRAMES, Input, Survey, survey};
use verify::spu::text::{capacity, text};

/// Walks that --host counts.
const WALKS: u64 = 5000;

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    if args.capacity {
        return show_capacity(args);
    }
    if let Some(word) = &args.walk {
        return walk(word);
    }
    if let Some(file) = &args.json {
        check_file(file)?;
    }
    if let Some(folder) = &args.out {
        check_folder(folder)?;
    }
    let mut surveys = Vec::new();
    for word in &args.scenes {
        for frame in args.frames.clone().unwrap_or(args.view.frame..args.view.frame + 1) {
            let survey = one(args, word, frame)?;
            say(&(text(&survey) + "\n"))?;
            surveys.push(survey);
        }
    }
    let host = if args.host { Some(on_host(&std::env::current_exe()?, WALKS)) } else { None };
    if let Some(host) = &host {
        say(&host.to_string())?;
    }
    let curves = if args.curves { both_curves(args)? } else { Vec::new() };
    let environment = environment(1, &[]);
    let report = Report { schema_version: SCHEMA_VERSION, kind: "spu", environment, surveys, curves, host };
    files::write("spu", (args.json.as_deref(), args.out.as_deref()), &report, page)?;
    if let Some(folder) = &args.out {
        say(&format!("page: {}\n", folder.join("spu.html").display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Blocks of which one is traced for a point of a curve, if --sample does not pass over more.
const SAMPLE: u32 = 8;

fn both_curves(args: &Args) -> Result<Vec<Curve>, Failure> {
    let word = args.scenes[0].clone();
    let (loaded, scene) = load(&word, args.view.frame)?;
    let framing = args.view.framing();
    let camera = loaded.camera(&framing)?;
    let asked = Asked {
        plan: plan(args),
        every: args.sample.max(SAMPLE),
        framing: &framing,
        name: &word,
        frame: args.view.frame,
        scene: &scene,
        camera: &camera,
    };
    let tick = progress::bar("curves", "on the SPU model", POINTS);
    Ok(curves(&asked, &*tick)?.into())
}

fn plan(args: &Args) -> Plan {
    plan_named(&args.plan, args.grid)
}

/// A plan of the model by its name, with so many cells on an axis if they are said.
pub(super) fn plan_named(name: &str, cells: Option<u8>) -> Plan {
    let plan = if name == "safe" { Plan::safe() } else { Plan::paper() };
    match cells {
        Some(n) => Plan { resolution: Resolution::Fixed(n), ..plan },
        None => plan,
    }
}

fn one(args: &Args, word: &str, frame: usize) -> Result<Survey, Failure> {
    let (loaded, scene) = load(word, frame)?;
    warn(&loaded);
    let camera = loaded.camera(&args.view.framing())?;
    let input = Input {
        name: word,
        frame,
        scene: &scene,
        camera: &camera,
        plan: plan(args),
        every: args.sample,
        unlimited: args.unlimited,
    };
    let tick = progress::bar(word, "on the SPU model", FRAMES * camera.size().height().div_ceil(BLOCK));
    Ok(survey(&input, &*tick).map_err(|error| format!("{word}: {error}"))?)
}

/// Walks by one of the ways that --host counts, told as `nested:avx2:1000`.
fn walk(word: &str) -> Result<ExitCode, Failure> {
    let mut parts = word.split(':');
    let (way, level, times) = (parts.next(), parts.next(), parts.next().and_then(|n| n.parse().ok()));
    let way = Way::ALL.into_iter().find(|known| Some(known.name()) == way);
    let (Some(way), Some(level), Some(times)) = (way, level, times) else {
        return Err(format!("`{word}`: expected LOOP:LEVEL:WALKS").into());
    };
    let [cells, places] = walks(way, level, times, SEED)?;
    say(&format!("{cells} cells, {places}\n"))?;
    Ok(ExitCode::SUCCESS)
}

/// How many spheres fit, and which of the scenes that are named.
fn show_capacity(args: &Args) -> Result<ExitCode, Failure> {
    let width = args.view.size.map_or(verify::scenes::frame::SIZE[0], contract::Size::width);
    say(&capacity(code_bytes(plan(args))?, width))?;
    Ok(ExitCode::SUCCESS)
}
