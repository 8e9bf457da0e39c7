//! `cgt render`: one picture into one file, or frames of an animation into a film, a pipe, or a file each.

use super::verify::{load, warn};
use crate::args::{Method, Render};
use crate::{Failure, progress, say};
use contract::{Camera, Image, Scene};
use optimized::{Level, Session};
use reference::{Arithmetic, Tracer};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use verify::picture::film::{Announced, Film, Format};
use verify::picture::{AtomicFile, canvas, check_file, exr, png, write_atomically};
use verify::subject::{NamedPlan, Rounding};

/// What a picture becomes.
type Encode = fn(&Image) -> Result<Vec<u8>, Failure>;

/// Where pictures go.
enum Target {
    /// One into one file.
    Picture(Encode),
    /// Each into a file of its own.
    Numbered(Pattern, Encode),
    /// All into one file.
    Film(Format),
    /// All onto standard output.
    Pipe,
}

pub(crate) fn render(args: &Render) -> Result<ExitCode, Failure> {
    let target = target(args)?;
    let frames = args.frames.clone().unwrap_or(args.view.frame..args.view.frame + 1);
    match &target {
        Target::Pipe => {}
        Target::Numbered(pattern, _) => check_file(&pattern.path(frames.start))?,
        Target::Picture(_) | Target::Film(_) => check_file(&args.file)?,
    }
    let (loaded, _) = load(&args.scene, frames.end - 1)?;
    warn(&loaded);
    let camera = loaded.camera(&args.view.framing())?;
    let rows = camera.size().height();
    let announced = Announced { size: camera.size(), frames: u32::try_from(frames.len())?, fps: args.fps };
    let tick = progress::bar(&args.scene, "render", rows.saturating_mul(announced.frames));
    let mut hand = Hand::new(args.method, args.view.threads())?;
    let scenes = loaded.animation.frames()[frames.clone()].iter();
    let told = match target {
        Target::Picture(encode) => {
            for scene in scenes {
                write_atomically(&args.file, &encode(hand.draw(scene, &camera, &*tick)?)?)?;
            }
            format!("wrote {}\n", args.file.display())
        }
        Target::Numbered(pattern, encode) => {
            for (frame, scene) in frames.clone().zip(scenes) {
                write_atomically(&pattern.path(frame), &encode(hand.draw(scene, &camera, &*tick)?)?)?;
            }
            let [first, last] = [frames.start, frames.end - 1].map(|frame| pattern.path(frame));
            format!("wrote {} to {}\n", first.display(), last.display())
        }
        Target::Film(format) => {
            let mut file = AtomicFile::new(&args.file)?;
            let shot = shoot(format, announced, &mut file, scenes, &mut hand, &camera, &*tick);
            // A full disk is told by the file, which knows its own name.
            if shot.is_ok() || file.has_failed() {
                file.finish()?;
            }
            shot?;
            format!("wrote {}, {} frames\n", args.file.display(), announced.frames)
        }
        Target::Pipe => {
            let mut pipe = Pipe { closed: false };
            let shot = shoot(Format::Y4m, announced, &mut pipe, scenes, &mut hand, &camera, &*tick);
            let shot = shot.and_then(|()| Ok(pipe.flush()?));
            // Who reads may have had enough.
            return if pipe.closed { Ok(ExitCode::SUCCESS) } else { shot.map(|()| ExitCode::SUCCESS) };
        }
    };
    say(&told)?;
    Ok(ExitCode::SUCCESS)
}

/// Draws all frames into a film.
fn shoot<'a>(
    format: Format,
    announced: Announced,
    to: impl Write,
    scenes: impl Iterator<Item = &'a Scene>,
    hand: &mut Hand,
    camera: &Camera,
    tick: &(dyn Fn() + Sync),
) -> Result<(), Failure> {
    let mut film = Film::new(format, announced, to)?;
    for scene in scenes {
        film.frame(hand.draw(scene, camera, tick)?)?;
    }
    Ok(film.finish()?)
}

/// By the file's name, and whether several frames are asked for.
fn target(args: &Render) -> Result<Target, Failure> {
    let file = &args.file;
    let ending = file.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let encode: Option<Encode> = match ending.as_deref() {
        Some("png") => Some(|image| Ok(png(&canvas(image)?)?)),
        Some("exr") => Some(|image| Ok(exr(image)?)),
        _ => None,
    };
    if args.frames.is_none() {
        let told = || format!("`{}` ends neither in .png nor in .exr; films need --frames", file.display());
        return Ok(Target::Picture(encode.ok_or_else(told)?));
    }
    if file == Path::new("-") {
        return Ok(Target::Pipe);
    }
    match (ending.as_deref(), Pattern::of(file), encode) {
        (_, Some(pattern), Some(encode)) => Ok(Target::Numbered(pattern, encode)),
        (Some("apng" | "png"), None, _) => Ok(Target::Film(Format::Apng)),
        (Some("gif"), None, _) => Ok(Target::Film(Format::Gif)),
        (Some("y4m"), None, _) => Ok(Target::Film(Format::Y4m)),
        (Some("exr"), None, _) => {
            Err(format!("`{}` is one file for many frames; put {{frame}} or %04d into its name", file.display()).into())
        }
        _ => Err(format!(
            "`{}` can have no frames: what can ends in .apng, .png, .gif or .y4m, or has {{frame}} or %04d before .png or .exr",
            file.display()
        )
        .into()),
    }
}

/// A name with a place for a number.
struct Pattern {
    before: String,
    /// Digits at least.
    digits: usize,
    after: String,
}

impl Pattern {
    /// `{frame}`, or `%d` with or without a width, in the last part of a path.
    fn of(path: &Path) -> Option<Self> {
        let whole = path.to_str()?;
        let name = path.file_name()?.to_str()?;
        let folder = whole.strip_suffix(name)?;
        let found = |before: &str, digits, after: &str| {
            Some(Self { before: format!("{folder}{before}"), digits, after: after.to_owned() })
        };
        if let Some((before, after)) = name.split_once("{frame}") {
            return found(before, 1, after);
        }
        let (before, rest) = name.split_once('%')?;
        let (width, after) = rest.split_once('d')?;
        let digits = if width.is_empty() { Some(1) } else { width.strip_prefix('0')?.parse().ok() };
        found(before, digits.filter(|digits| *digits <= 9)?, after)
    }

    fn path(&self, frame: usize) -> PathBuf {
        let Self { before, digits, after } = self;
        format!("{before}{frame:0digits$}{after}").into()
    }
}

/// Standard output, which remembers that nobody reads any more.
struct Pipe {
    closed: bool,
}

impl Pipe {
    fn told<T>(&mut self, result: std::io::Result<T>) -> std::io::Result<T> {
        self.closed |= result.as_ref().is_err_and(|error| error.kind() == std::io::ErrorKind::BrokenPipe);
        result
    }
}

impl Write for Pipe {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let written = std::io::stdout().write(bytes);
        self.told(written)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        let flushed = std::io::stdout().flush();
        self.told(flushed)
    }
}

/// Who draws one frame after another: the grid tracer in one session, or the reference.
enum Hand {
    Grid(Box<Session>),
    Naive(Tracer, Option<Image>),
}

impl Hand {
    fn new(method: Method, threads: usize) -> Result<Self, Failure> {
        let naive = |arithmetic| Ok(Self::Naive(Tracer::new(arithmetic).threads(threads), None));
        let grid = |plan: NamedPlan| {
            let tracer = optimized::Tracer::new(plan.plan(), Level::best()?).workers(threads);
            Ok(Self::Grid(Box::new(tracer.session()?)))
        };
        match method {
            Method::Exact => naive(Arithmetic::Exact),
            Method::NaiveF64 => naive(Rounding::TextbookF64.naive()),
            Method::NaiveF32Perpendicular => naive(Rounding::PerpendicularF32.naive()),
            Method::NaiveF32Textbook => naive(Rounding::TextbookF32.naive()),
            Method::Fast => grid(NamedPlan::Fast),
            Method::Safe => grid(NamedPlan::Safe),
            Method::Paper => grid(NamedPlan::Paper),
        }
    }

    fn draw(&mut self, scene: &Scene, camera: &Camera, tick: &(dyn Fn() + Sync)) -> Result<&Image, Failure> {
        match self {
            Self::Grid(session) => {
                let rendering = session.render(scene, camera)?;
                (0..camera.size().height()).for_each(|_| tick());
                Ok(&rendering.image)
            }
            Self::Naive(tracer, last) => Ok(last.insert(tracer.render_with(scene, camera, tick)?.image)),
        }
    }
}
