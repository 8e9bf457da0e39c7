//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use contract::Size;
use std::path::PathBuf;
use verify::scenes::frame::Framing;

/// Judge sphere tracers against exact arithmetic.
///
/// Without a subcommand `cgt` verifies: it renders the scenes (the bundled molecule 1HVR if none is named)
/// exactly and with every tracer under test, compares pixel by pixel, prints a verdict and writes
/// `cgt-report/report.html`.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true, after_help = CODES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    #[command(flatten)]
    pub(crate) verify: Verify,
}

const CODES: &str = "Exit codes: 0 all agree, 1 a mismatch, 2 bad input or usage, 3 something needed for a verdict is missing";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Judge tracers on scenes and write a report (the default)
    Verify(Verify),
    /// Render one scene to a PNG or `OpenEXR` file
    Render(Render),
    /// List the scenes that have names, and the formats that are read
    Scenes,
}

#[derive(Args, Debug)]
pub(crate) struct Verify {
    /// Scenes: names or generators (see `cgt scenes`), or files; `trajectory.dcd,atoms.pdb` for two
    #[arg(value_name = "SCENE", default_values_t = [verify::scenes::catalogue::DEFAULT.to_owned()])]
    pub(crate) scenes: Vec<String>,
    /// Judge only these tracers
    #[arg(long = "subject", value_name = "NAME", value_parser = verify::subject::SUBJECTS.map(|s| s.name()))]
    pub(crate) subjects: Vec<String>,
    /// Folder of the report; files of an earlier report in it are replaced
    #[arg(long, value_name = "FOLDER", default_value = "cgt-report")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Args, Debug)]
pub(crate) struct Render {
    /// Scene: a name or generator (see `cgt scenes`), or a file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: String,
    /// The file to write: .png, or .exr for colour, id and t as layers
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// What decides the picture
    #[arg(long, value_enum, default_value_t = Method::Exact)]
    pub(crate) method: Method,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Method {
    /// The truth, exact
    Exact,
    /// One loop over all spheres, textbook form in f64
    NaiveF64,
    /// One loop over all spheres, perpendicular form in f32
    NaiveF32Perpendicular,
    /// One loop over all spheres, textbook form in f32
    NaiveF32Textbook,
    /// Packets through a grid, perpendicular form in f32
    Grid,
}

#[derive(Args, Debug)]
pub(crate) struct View {
    /// Pixels, from 1x1 to 16384 on a side [default: the scene's own, else 1280x720]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(crate) size: Option<Size>,
    /// Where to stand [default: chosen so that the scene fills the picture]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(crate) eye: Option<[f64; 3]>,
    /// What to look at [default: the middle of the scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(crate) target: Option<[f64; 3]>,
    /// Which way is up [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(crate) up: Option<[f64; 3]>,
    /// Vertical field of view in degrees [default: 45]
    #[arg(long, value_name = "DEGREES")]
    pub(crate) fov: Option<f64>,
    /// Frame of an animation, counted from 0
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) frame: usize,
    /// Threads; 0 is one a core
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) threads: usize,
}

impl View {
    /// What is wished of the camera.
    pub(crate) fn framing(&self) -> Framing {
        Framing { eye: self.eye, target: self.target, up: self.up, fov: self.fov, size: self.size }
    }

    /// Threads as a number above 0.
    pub(crate) fn threads(&self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            n => n,
        }
    }
}

fn size(text: &str) -> Result<Size, String> {
    let number = |text: &str| text.parse::<u32>().map_err(|e| format!("`{text}`: {e}"));
    let (width, height) = text.split_once(['x', 'X']).ok_or("expected WIDTHxHEIGHT, as 1280x720")?;
    Size::new(number(width)?, number(height)?).map_err(|e| e.to_string())
}

fn vector(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|x| x.trim().parse::<f64>()).collect();
    let numbers = numbers.map_err(|e| e.to_string())?;
    <[f64; 3]>::try_from(numbers).map_err(|n| format!("expected 3 numbers X,Y,Z, got {}", n.len()))
}
