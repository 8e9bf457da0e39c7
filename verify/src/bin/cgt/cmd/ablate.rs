//! `cgt ablate`: what each choice of a plan buys, on the terminal and into files out.

use super::files;
use super::verify::{all_there, framed, load, warn};
use crate::args::{Ablate as Args, or_few};
use crate::environment::environment;
use crate::{Failure, progress};
use contract::{Camera, Scene};
use optimized::{Level, Plan};
use std::process::ExitCode;
use verify::ablation::model::{Without, model, steps};
use verify::ablation::{Ablation, SCHEMA_VERSION, ablate, page, text};
use verify::chart::Distance;
use verify::picture::check_folder;
use verify::seed::seed;
use verify::spu::survey::Input;

/// Columns and rows of a picture where no size is asked for.
const SIZE: [u32; 2] = [640, 360];

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    check_folder(&args.out)?;
    let found = found(args)?;
    let shown = (page::page(&found)?, text::text(&found));
    files::chapter("ablation", &args.out, &found, found.csv()?, (&shown.0, &shown.1))?;
    Ok(super::kept(&found.broken_promises()))
}

/// Measures all scenes.
pub(crate) fn found(args: &Args) -> Result<Ablation, Failure> {
    let level = args.level.as_deref().map_or_else(Level::best, Level::named)?;
    let (threads, seed) = (args.view.threads(), seed());
    let frame = args.view.frame;
    let (mut scenes, mut looked) = (Vec::new(), Vec::new());
    let names = or_few(&args.scenes);
    all_there(&names, frame)?;
    for word in &names {
        let (loaded, scene) = load(word, frame)?;
        warn(&loaded);
        let framing = framed(&args.view, &loaded, SIZE)?;
        // The paper's claims are of its own size, if none is asked for, whatever is timed here.
        looked.push((word.clone(), scene.clone(), loaded.camera(&args.view.framing())?));
        let at = Distance::new(&loaded.animation, &framing, 1.0)?;
        let how = (level, threads, args.rounds.into(), args.sample);
        scenes.push(ablate((word, frame, &scene), &at, how, seed, &|what, steps| {
            progress::bar(word, what, steps)
        })?);
    }
    let model = modelled(&looked, frame, args.sample, seed)?;
    let mut environment = environment(threads, &[level]);
    environment.seed = Some(seed);
    Ok(Ablation { schema_version: SCHEMA_VERSION, kind: "ablation", environment, scenes, model })
}

/// The model of the paper's machine without each of its features, on these scenes.
fn modelled(
    scenes: &[(String, Scene, Camera)],
    frame: usize,
    every: u32,
    seed: u64,
) -> Result<Vec<Without>, Failure> {
    let inputs = scenes.iter().map(|(name, scene, camera)| Input {
        name,
        frame,
        scene,
        camera,
        plan: Plan::paper(),
        every,
        unlimited: true,
    });
    let inputs: Vec<Input<'_>> = inputs.collect();
    let tick = progress::bar("model", "without each feature", steps(inputs.len()));
    Ok(model(&inputs, seed, &*tick)?)
}
