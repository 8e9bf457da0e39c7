//! `cgt ablate`: what each choice of a plan buys, on the terminal and into files out.

use super::files;
use super::verify::warn;
use crate::args::Ablate as Args;
use crate::environment::environment;
use crate::{Failure, progress, say};
use contract::{Camera, Scene, Size};
use optimized::{Level, Plan};
use std::process::ExitCode;
use verify::ablation::model::{Without, model, steps};
use verify::ablation::{Ablation, SCHEMA_VERSION, ablate, page, text};
use verify::chart::Distance;
use verify::picture::{check_folder, write_atomically};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::seed;
use verify::spu::survey::Input;

/// Scenes that are measured where none is named.
const SCENES: [&str; 3] = ["1hvr", "sphereflake:3", "uniform:2000:1"];
/// Columns and rows of a picture where no size is asked for.
const SIZE: [u32; 2] = [640, 360];

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    check_folder(&args.out)?;
    let found = found(args)?;
    std::fs::create_dir_all(&args.out)
        .map_err(|error| format!("the folder `{}`: {error}", args.out.display()))?;
    write_atomically(&args.out.join("ablation.csv"), &found.csv()?)?;
    files::write("ablation", (None, Some(&args.out)), &found, page::page)?;
    say(&text::text(&found))?;
    say(&format!("page: {}\n", args.out.join("ablation.html").display()))?;
    Ok(ExitCode::SUCCESS)
}

/// Measures all scenes.
pub(crate) fn found(args: &Args) -> Result<Ablation, Failure> {
    let level = args.level.as_deref().map_or_else(Level::best, Level::named)?;
    let (threads, seed) = (args.view.threads(), seed());
    let names = if args.scenes.is_empty() { SCENES.map(str::to_owned).to_vec() } else { args.scenes.clone() };
    let (mut scenes, mut looked) = (Vec::new(), Vec::new());
    for word in &names {
        let loaded = Source::parse(word)?.load()?;
        warn(&loaded);
        let (frames, frame) = (loaded.animation.frames(), args.view.frame);
        let scene = frames.get(frame).ok_or_else(|| format!("{word} has {} frames", frames.len()))?;
        let mut framing = args.view.framing().or(&loaded.framing.unwrap_or_default());
        if framing.size.is_none() {
            framing.size = Some(Size::new(SIZE[0], SIZE[1])?);
        }
        // The paper's claims are of its own size.
        let own = Framing { size: args.view.size, ..framing };
        looked.push((word.clone(), scene.clone(), own.camera(&loaded.animation)?));
        let at = Distance::new(&loaded.animation, &framing, 1.0)?;
        let how = (level, threads, args.rounds.into(), args.sample);
        scenes.push(ablate((word, frame, scene), &at, how, seed, &|what, steps| {
            progress::bar(word, what, steps)
        })?);
    }
    let model = modelled(&looked, args.sample, seed)?;
    let mut environment = environment(threads, &[level]);
    environment.seed = Some(seed);
    Ok(Ablation { schema_version: SCHEMA_VERSION, kind: "ablation", environment, scenes, model })
}

/// The model of the paper's machine without each of its features, on these scenes.
fn modelled(scenes: &[(String, Scene, Camera)], every: u32, seed: u64) -> Result<Vec<Without>, Failure> {
    let inputs = scenes.iter().map(|(name, scene, camera)| Input {
        name,
        frame: 0,
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
