//! `cgt spu`: scenes in, what they would cost on a PlayStation 3 on the terminal and into files out.

use super::verify::{load, warn};
use crate::args::Spu as Args;
use crate::{Failure, progress, say};
use optimized::Plan;
use optimized::camera::BLOCK;
use optimized::plan::Resolution;
use std::path::Path;
use std::process::ExitCode;
use verify::picture::{check_folder, write_atomically};
use verify::spu::store::code_bytes;
use verify::spu::survey::{FRAMES, Input, Survey, survey};
use verify::spu::text::{capacity, text};

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    if args.capacity {
        return show_capacity(args);
    }
    if let Some(file) = &args.json {
        check_folder(file.parent().unwrap_or(Path::new(".")))?;
    }
    let mut surveys = Vec::new();
    for word in scenes(args) {
        for frame in args.frames.clone().unwrap_or(args.view.frame..args.view.frame + 1) {
            let survey = one(args, &word, frame)?;
            say(&(text(&survey) + "\n"))?;
            surveys.push(survey);
        }
    }
    if let Some(file) = &args.json {
        write_atomically(file, (serde_json::to_string_pretty(&surveys)? + "\n").as_bytes())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What is surveyed where no scene is named.
fn scenes(args: &Args) -> Vec<String> {
    if args.scenes.is_empty() { vec![verify::scenes::catalogue::DEFAULT.into()] } else { args.scenes.clone() }
}

fn plan(args: &Args) -> Plan {
    let plan = if args.plan == "safe" { Plan::safe() } else { Plan::paper() };
    match args.grid {
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
        unlimited: args.unlimited || args.claims,
    };
    let tick = progress::bar(word, "on the SPU model", FRAMES * camera.size().height().div_ceil(BLOCK));
    Ok(survey(&input, &*tick).map_err(|error| format!("{word}: {error}"))?)
}

/// How many spheres fit, and which of the scenes that are named.
fn show_capacity(args: &Args) -> Result<ExitCode, Failure> {
    let width = args.view.size.map_or(verify::scenes::frame::SIZE[0], |size| size.width());
    say(&capacity(code_bytes(plan(args))?, width))?;
    Ok(ExitCode::SUCCESS)
}
