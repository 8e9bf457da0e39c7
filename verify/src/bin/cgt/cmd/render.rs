//! `cgt render`: one picture into one file.

use super::verify::{load, warn};
use crate::args::{Method, Render};
use crate::{Failure, progress, say};
use contract::Image;
use optimized::Level;
use reference::{Arithmetic, Tracer};
use std::process::ExitCode;
use verify::picture::{canvas, check_folder, exr, png, write_atomically};
use verify::subject::{Grid, Naive, NamedPlan, Rounding, Subject};

pub(crate) fn render(args: &Render) -> Result<ExitCode, Failure> {
    let encode: fn(&Image) -> Result<Vec<u8>, Failure> =
        match args.file.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("png") => |image| Ok(png(&canvas(image)?)?),
            Some("exr") => |image| Ok(exr(image)?),
            _ => return Err(format!("`{}` ends neither in .png nor in .exr", args.file.display()).into()),
        };
    check_folder(args.file.parent().unwrap_or(&args.file))?;
    let (loaded, scene) = load(&args.scene, args.view.frame)?;
    warn(&loaded);
    let camera = loaded.camera(&args.view.framing())?;
    let tick = progress::bar(&args.scene, "render", camera.size().height());
    let threads = args.view.threads();
    let naive = |rounding| Naive(rounding).render(&scene, &camera, threads, &*tick).map(|r| r.image);
    let grid = |plan| -> Result<Image, Failure> {
        let subject = Grid::new(plan, Level::best()?, false, None);
        Ok(subject.render(&scene, &camera, threads, &*tick)?.image)
    };
    let image = match args.method {
        Method::Exact => {
            Tracer::new(Arithmetic::Exact).threads(threads).render_with(&scene, &camera, &*tick)?.image
        }
        Method::NaiveF64 => naive(Rounding::TextbookF64)?,
        Method::NaiveF32Perpendicular => naive(Rounding::PerpendicularF32)?,
        Method::NaiveF32Textbook => naive(Rounding::TextbookF32)?,
        Method::Fast => grid(NamedPlan::Fast)?,
        Method::Safe => grid(NamedPlan::Safe)?,
        Method::Paper => grid(NamedPlan::Paper)?,
    };
    write_atomically(&args.file, &encode(&image)?)?;
    say(&format!("wrote {}\n", args.file.display()))?;
    Ok(ExitCode::SUCCESS)
}
