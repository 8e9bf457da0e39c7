//! `cgt figures`: the paper's four figures of a scene into a folder, each as a file and all on a page.

use super::files;
use super::spu::plan_named;
use super::verify::{load, warn};
use crate::args::Figures as Args;
use crate::environment::environment;
use crate::{Failure, progress, say};
use contract::Size;
use optimized::Level;
use optimized::camera::BLOCK;
use std::process::ExitCode;
use verify::figures::page::{About, page};
use verify::figures::{Figure, Input, alone, figures};
use verify::picture::{check_folder, write_atomically};
use verify::scenes::frame::Framing;

/// Pixels of the picture whose blocks are drawn, where none are asked for: so many blocks that each can be seen.
const SIZE: [u32; 2] = [320, 180];

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    check_folder(&args.out)?;
    let (about, drawn) = drawn(args)?;
    let page = page(&about, &drawn)?;
    files::folder(&args.out)?;
    for figure in &drawn {
        let file = args.out.join(format!("{}.svg", figure.name));
        write_atomically(&file, alone(&figure.svg).as_bytes())?;
        say(&format!("{}: {}\n", file.display(), figure.caption))?;
    }
    let file = args.out.join("figures.html");
    write_atomically(&file, page.as_bytes())?;
    say(&format!("page: {}\n", file.display()))?;
    Ok(ExitCode::SUCCESS)
}

/// Draws them.
pub(crate) fn drawn(args: &Args) -> Result<(About, Vec<Figure>), Failure> {
    let level = Level::best()?;
    let (loaded, scene) = load(&args.scene, args.view.frame)?;
    warn(&loaded);
    let size = args.view.size.map_or_else(|| Size::new(SIZE[0], SIZE[1]), Ok)?;
    let camera = loaded.camera(&Framing { size: Some(size), ..args.view.framing() })?;
    let plan = plan_named(&args.plan, args.grid);
    let input = Input { name: &args.scene, scene: &scene, camera: &camera, plan, pixel: args.pixel, level };
    let tick = progress::bar(&args.scene, "on the SPU model", size.height().div_ceil(BLOCK));
    let drawn = figures(&input, &*tick)?;
    let about = About {
        scene: args.scene.clone(),
        facts: format!(
            "{} spheres, {} × {} pixels. Plan: {plan}.",
            scene.spheres().len(),
            size.width(),
            size.height()
        ),
        environment: environment(1, &[level]),
    };
    Ok((about, drawn))
}
