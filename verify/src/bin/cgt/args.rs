//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum, value_parser};
use clap_complete::Shell;
use contract::Size;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use verify::campaign::shard::Which;
use verify::foreign::{Foreign, ForeignError, PROMISES};
use verify::scenes::frame::Framing;
use verify::view::command::Overlay;

/// Judge tracers of sphere scenes against exact arithmetic.
///
/// Without a subcommand `cgt` verifies: it renders each scene (the bundled molecule 1HVR if none is named)
/// exactly and with every tracer under test, compares the pictures pixel by pixel, prints a verdict and writes
/// a report that opens offline, `cgt-report/report.html`, with the same data in `report.json` beside it.
#[derive(Debug, Parser)]
#[command(name = "cgt", version, args_conflicts_with_subcommands = true, after_help = CODES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    #[command(flatten)]
    pub(crate) verify: Verify,
}

const CODES: &str = "\
Exit codes:
  0  every tracer keeps its promise: its picture equals the exact one, or every difference is one
     that rounding in its arithmetic explains
  1  a mismatch: at least one pixel is wrong beyond that
  2  bad input or usage; nothing was judged
  3  no verdict: something needed for it is missing, or lies outside what a tracer states
  4  slower than the baseline (`cgt bench --baseline`)

Examples:
  cgt                                   judge all tracers on the bundled molecule
  cgt verify 2juy --frame 3 --plan safe
  cgt verify uniform:5000:1 own.pdb     a generated scene and a file
  cgt verify --subject-cmd ./mytracer   a tracer of your own, in any language
  cgt render sphereflake:4 flake.png --size 800x600
  cgt render 2juy film.apng --frames 0..24
  cgt view 2juy                         a window; H lists its keys
  cgt report                            all of it on one page, in some minutes
  cgt bench 1hvr --peers embree --threads 1
  cgt chart 1hvr                        speed against error, every method
  cgt stability                         where each method breaks
  cgt ablate 1hvr                       what each choice of a plan buys
  cgt spu 1hvr                          cycles on a PlayStation 3, stage by stage
  cgt claims                            the paper's claims one by one, computed anew
  cgt figures 1hvr                      the paper's four figures of a scene, as SVG and on a page
  cgt prove                             proofs of the kernels, by solvers
  cgt replay tests/cases/NAME.json      a case again, its pixel step by step
  cgt scenes                            what can be named";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Judge tracers on scenes and write a report (the default)
    Verify(Verify),
    /// Make the whole report: pictures, speed against error, where methods break, what each choice buys, proofs
    Report(Report),
    /// Time the grid tracer, its limit and other people's tracers, each checked before it is timed
    Bench(Bench),
    /// Chart every method's speed against its error, from near and from far
    Chart(Chart),
    /// Map where every method breaks: over distance, scale, cells, crowds, tangency, angle, offset
    Stability(Stability),
    /// Change one choice of a plan at a time: what does each buy, in time, in cycles, in right pixels?
    Ablate(Ablate),
    #[allow(clippy::doc_markdown, reason = "shown to people as it stands")]
    /// Render one scene to a PNG or OpenEXR file, or an animation to a film or numbered files
    Render(Render),
    /// Look at a scene in a window or a terminal: orbit, plans, what the tracer does laid over the picture
    View(Viewer),
    /// Count the cycles of the PlayStation 3's processor: by stage, with mispredicts, memory and what each trick saves
    Spu(Spu),
    /// Hold each of the paper's claims against what is found: verdict, evidence, figures, counterexample
    Claims(Claims),
    /// Draw the paper's four figures from a scene: blocks and what they cost, a frustum, the loops, the eight corners
    Figures(Figures),
    /// Prove what the kernels do for all inputs, with the solvers that are there (z3, bitwuzla, cvc5)
    Prove(Prove),
    /// Judge a case again, by its own tracer or by yours, and tell a pixel of it step by step
    Replay(Replay),
    /// Judge more scenes than one run or one machine has time for, in shards that can be killed and go on
    Campaign(Campaign),
    /// List the scenes that have names, and the formats that are read
    Scenes,
    /// Print what a shell needs to complete this program's words
    Completions(Completions),
    /// Write this program's manual, a page for each subcommand
    Man(Man),
}

#[derive(Args, Debug)]
pub(crate) struct Campaign {
    #[command(subcommand)]
    pub(crate) step: CampaignStep,
}

#[derive(Debug, Subcommand)]
pub(crate) enum CampaignStep {
    /// Do a shard, or what is left of it
    Run {
        /// The campaign's plan, a TOML file (docs/campaigns.md)
        #[arg(long, value_name = "FILE")]
        plan: PathBuf,
        /// Which shard of how many, counted from 1
        #[arg(long, value_name = "I/N", default_value = "1/1")]
        shard: Which,
        /// Folder for the shard's file, which is made if it is missing
        #[arg(long, value_name = "FOLDER")]
        out: PathBuf,
        /// Threads, at most 1024; 0 is one a core. What is found does not depend on it
        #[arg(long, value_name = "N", default_value_t = 0, value_parser = value_parser!(u16).range(..=1024))]
        threads: u16,
    },
    /// Tell how far the shards in a folder are
    Status {
        /// The campaign's plan
        #[arg(long, value_name = "FILE")]
        plan: PathBuf,
        /// The shards' folder
        #[arg(value_name = "FOLDER")]
        folder: PathBuf,
    },
    /// Put all shards together: the same report, however the campaign was divided
    Merge {
        /// The campaign's plan
        #[arg(long, value_name = "FILE")]
        plan: PathBuf,
        /// Folders with shards, or their files
        #[arg(value_name = "FOLDER", required = true)]
        places: Vec<PathBuf>,
        /// Folder for campaign.json, campaign.txt, the page campaign.html, stakes.svg, and the failures as cases in cases/
        #[arg(long, value_name = "FOLDER")]
        out: PathBuf,
    },
}

#[derive(Args, Debug)]
pub(crate) struct Completions {
    /// Which shell
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}

#[derive(Args, Debug)]
pub(crate) struct Man {
    /// Folder for cgt.1, cgt-verify.1 and so on, which is made if it is missing; where `man` looks is ~/.local/share/man/man1
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
}

/// Tracers of the user's own.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct Own {
    /// A tracer of your own, in any language: a program that reads scene and rays from its standard input and writes ids and t
    /// (docs/own-tracer.md); `NAME=COMMAND` gives it another name than the program's
    #[arg(long = "subject-cmd", value_name = "COMMAND")]
    commands: Vec<String>,
    /// What it is held to: the truth, bit for bit, or what rounding can make of it in a form [default: f32-textbook]
    #[arg(long, value_name = "PROMISE", value_parser = PROMISES.map(|(word, _)| word), requires = "commands")]
    promise: Option<String>,
    /// How many seconds it may say nothing while an answer is due
    #[arg(long, value_name = "SECONDS", default_value_t = 300.0, value_parser = seconds)]
    patience: f64,
}

impl Own {
    /// The one tracer where no more can be asked.
    pub(crate) fn tracer(&self) -> Result<Option<Arc<Foreign>>, String> {
        match self.tracers().map_err(|error| error.to_string())?.as_slice() {
            [] => Ok(None),
            [one] => Ok(Some(one.clone())),
            more => Err(format!("one tracer can be asked, not {}", more.len())),
        }
    }

    /// The tracers, none of them started.
    pub(crate) fn tracers(&self) -> Result<Vec<Arc<Foreign>>, ForeignError> {
        let word = self.promise.as_deref().unwrap_or(PROMISES[0].0);
        let promise = PROMISES.iter().find(|(known, _)| *known == word).unwrap_or(&PROMISES[0]).1;
        let patience = Duration::from_secs_f64(self.patience);
        self.commands.iter().map(|command| Ok(Arc::new(Foreign::new(command, promise, patience)?))).collect()
    }
}

const SUBJECTS: [&str; 6] =
    ["naive-f64", "naive-f32-perpendicular", "naive-f32-textbook", "fast", "safe", "paper"];
const PLANS: [&str; 3] = ["fast", "safe", "paper"];
/// Of a report, beside its pictures: speed and breakdown with the advice from both, and so on.
const CHAPTERS: [&str; 6] = ["methods", "ablation", "paper", "figures", "bench", "proofs"];
const OUTSIDERS: [&str; 3] = ["embree", "bvh", "parry3d"];
/// The outside judge.
pub(crate) const EMBREE: &str = "embree";

#[derive(Args, Debug)]
pub(crate) struct Verify {
    /// Scenes: names or generators (see `cgt scenes`), or files; `trajectory.dcd,atoms.pdb` for two
    #[arg(value_name = "SCENE", default_values_t = [verify::scenes::catalogue::DEFAULT.to_owned()])]
    pub(crate) scenes: Vec<String>,
    /// Judge only these tracers
    #[arg(long = "subject", value_name = "NAME", value_parser = SUBJECTS)]
    pub(crate) subjects: Vec<String>,
    /// Judge only the grid tracer, with these plans: `paper` is the paper to the letter, and known to be wrong
    #[arg(long = "plan", value_name = "NAME", value_parser = PLANS)]
    pub(crate) plans: Vec<String>,
    /// SIMD level of the grid tracer: scalar, sse2, sse4.2, avx2, avx512, …, or `all` this processor has [default: the
    /// best, or the one that CGT_LEVEL names]
    #[arg(long, value_name = "LEVEL")]
    pub(crate) level: Option<String>,
    /// Cells of the grid on each axis, 1 to 240 [default: 16 for the plan `paper`, chosen for the scene for the others]
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(1..=240))]
    pub(crate) grid: Option<u8>,
    /// Have the exact pictures themselves judged by a tracer from outside; without it there is then no verdict
    #[arg(long, value_name = "NAME", value_parser = [EMBREE])]
    pub(crate) judges: Vec<String>,
    /// Frames of an animation, from and to, counted from 0, the last one not among them; the page then has a slider
    #[arg(long, value_name = "A..B", value_parser = range, conflicts_with = "frame")]
    pub(crate) frames: Option<Range<usize>>,
    /// Of each tracer that is wrong shrink the first frame where it is to the fewest spheres and pixels, and keep it as a case in this
    /// folder, with its picture and an account; `cgt replay` judges it again
    #[arg(long, value_name = "FOLDER")]
    pub(crate) keep: Option<PathBuf>,
    /// The tracer as a WebAssembly module, as `verify/live/build` makes it: the first scene can then be turned on the page
    #[arg(long, value_name = "FILE")]
    pub(crate) live: Option<PathBuf>,
    /// Folder of the report; files of the same names in it are replaced
    #[arg(long, value_name = "FOLDER", default_value = "cgt-report")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) own: Own,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Args, Debug)]
pub(crate) struct Report {
    /// Scenes, as for `verify` [default: 1hvr, sphereflake:3 and 2000 random spheres]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,
    /// Animation of which every frame is judged; `none` for none
    #[arg(long, value_name = "SCENE", default_value = "2juy")]
    pub(crate) film: String,
    /// Leave out a chapter
    #[arg(long, value_name = "CHAPTER", value_delimiter = ',', value_parser = CHAPTERS)]
    pub(crate) skip: Vec<String>,
    /// Rays at each value of the maps of where methods break
    #[arg(long, value_name = "N", default_value_t = 65_536, value_parser = value_parser!(u64).range(1..=1_000_000_000))]
    pub(crate) rays: u64,
    /// Rounds of measuring, wherever time is measured
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = value_parser!(u16).range(1..=10_000))]
    pub(crate) rounds: u16,
    /// Pixels of pictures, of what is timed and of what the paper claims; of a film 480x270 [default: 640x360, of charts 320x180, of claims
    /// 1280x720]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(crate) size: Option<Size>,
    /// Threads that make pictures, at most 1024; 0 is one a core. What is timed has one
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = value_parser!(u16).range(..=1024))]
    pub(crate) threads: u16,
    /// The tracer as a WebAssembly module, as `verify/live/build` makes it: the first scene can then be turned on the page
    #[arg(long, value_name = "FILE")]
    pub(crate) live: Option<PathBuf>,
    /// Folder of the report, with the data of each chapter beside it; files of the same names in it are replaced
    #[arg(long, value_name = "FOLDER", default_value = "cgt-report")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) own: Own,
}

/// What a benchmark is of, where no scene is named.
pub(crate) fn default_scenes() -> Vec<String> {
    ["1hvr", "adk", "sphereflake:4", "uniform:500:1", "uniform:2000:1", "uniform:4000:1"]
        .map(str::to_owned)
        .to_vec()
}

/// What is named; if nothing is, a molecule, spheres of many sizes that touch, and random ones.
pub(crate) fn or_few(scenes: &[String]) -> Vec<String> {
    if scenes.is_empty() {
        ["1hvr", "sphereflake:3", "uniform:2000:1"].map(str::to_owned).to_vec()
    } else {
        scenes.to_vec()
    }
}

#[derive(Args, Debug)]
pub(crate) struct Bench {
    /// Scenes, as for `verify` [default: 1hvr, adk, sphereflake:4, and 500, 2000 and 4000 random spheres]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,
    /// Tracers of other people to be timed too, with commas between; one that is missing is then no verdict [default:
    /// embree, if this program was built with it]
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = OUTSIDERS)]
    pub(crate) peers: Vec<String>,
    /// Plan of the grid tracer
    #[arg(long, value_name = "NAME", value_parser = PLANS, default_value = "fast")]
    pub(crate) plan: String,
    /// SIMD level of the grid tracer, and of Embree: scalar, sse2, sse4.2, avx2, avx512 [default: the best, or the one
    /// that CGT_LEVEL names]
    #[arg(long, value_name = "LEVEL")]
    pub(crate) level: Option<String>,
    /// Rounds of measuring [default: as many as the time allows, at least 5]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=10_000))]
    pub(crate) rounds: Option<u16>,
    /// Time for measuring on each scene, if there is no --rounds
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0, value_parser = seconds)]
    pub(crate) seconds: f64,
    /// Also time plans picked by hand: what does choosing one from the scene alone lose?
    #[arg(long)]
    pub(crate) plans: bool,
    /// Also time how times grow: with random spheres up to --most-spheres, with the pixels of the first scene up to --most-rows,
    /// with threads up to one a core
    #[arg(long)]
    pub(crate) curves: bool,
    /// Where the curve over spheres ends
    #[arg(long, value_name = "N", default_value_t = 10_000_000)]
    pub(crate) most_spheres: usize,
    /// Where the curve over pixels ends, in rows of a picture
    #[arg(long, value_name = "N", default_value_t = 2160)]
    pub(crate) most_rows: u32,
    /// File for all that was found, as JSON
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Folder for a page that opens offline, bench.html, with the same data in bench.json beside it
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// The JSON file of an earlier run on this machine: if a scene is slower now, the exit code is 4
    #[arg(long, value_name = "FILE")]
    pub(crate) baseline: Option<PathBuf>,
    /// How much slower a scene may be than in the baseline, in per cent
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0, value_parser = percent)]
    pub(crate) tolerance: f64,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Args, Debug)]
pub(crate) struct Chart {
    /// Scenes, as for `verify` [default: 1hvr, sphereflake:3 and 2000 random spheres]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,
    /// How many times as far as by default the eye stands, with commas between; the scene stays as large in the picture
    #[arg(long, value_name = "TIMES", value_delimiter = ',', default_value = "1,10,100,1000", value_parser = times)]
    pub(crate) far: Vec<f64>,
    /// Rounds of measuring
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = value_parser!(u16).range(1..=10_000))]
    pub(crate) rounds: u16,
    /// On the SPU model trace one of so many blocks; they stand for all
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = value_parser!(u32).range(1..=1000))]
    pub(crate) sample: u32,
    /// SIMD level of the grid tracer [default: the best, or the one that CGT_LEVEL names]; the exact plan is timed at every other too
    #[arg(long, value_name = "LEVEL")]
    pub(crate) level: Option<String>,
    /// Folder for a page that opens offline, chart.html, with the same data in chart.json and chart.csv beside it
    #[arg(long, value_name = "FOLDER", default_value = "cgt-chart")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) own: Own,
    #[command(flatten)]
    pub(crate) view: View,
}

impl Figures {
    /// A scene as it is seen by default, and the paper's plan.
    pub(crate) fn of(scene: &str, out: &std::path::Path) -> Self {
        Self {
            scene: scene.into(),
            out: out.to_path_buf(),
            pixel: None,
            plan: "paper".into(),
            grid: None,
            view: View::default(),
        }
    }
}

impl Bench {
    /// Some scenes in a view, and what else is asked for by default.
    pub(crate) fn of(scenes: &[String], view: &View) -> Self {
        Self {
            scenes: scenes.to_vec(),
            peers: Vec::new(),
            plan: PLANS[0].into(),
            level: None,
            rounds: None,
            seconds: 0.0,
            plans: false,
            curves: false,
            most_spheres: 0,
            most_rows: 0,
            json: None,
            out: None,
            baseline: None,
            tolerance: 0.0,
            view: view.clone(),
        }
    }
}

#[derive(Args, Debug)]
pub(crate) struct Stability {
    /// Scenes on which grid and packet are turned up [default: 1hvr, 2juy, sphereflake:3 and 2000 random spheres]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,
    /// Only these sweeps: distance, scale, size, crowd, tangency, angle, offset, turned, moved, scaled, assumptions, grids, packets
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub(crate) only: Vec<String>,
    /// Only these methods, as they are called in the table
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub(crate) methods: Vec<String>,
    /// Rays at each value; what happens once in a million is seen with a million alone
    #[arg(long, value_name = "N", default_value_t = 262_144, value_parser = value_parser!(u64).range(1..=1_000_000_000))]
    pub(crate) rays: u64,
    /// SIMD level of the grid tracer, and of Embree [default: the best, or the one that CGT_LEVEL names]
    #[arg(long, value_name = "LEVEL")]
    pub(crate) level: Option<String>,
    /// Folder for a page that opens offline, stability.html, with the same data in stability.json and stability.csv beside it, and each map as an SVG file
    #[arg(long, value_name = "FOLDER", default_value = "cgt-stability")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) own: Own,
}

#[derive(Args, Debug)]
pub(crate) struct Ablate {
    /// Scenes, as for `verify` [default: 1hvr, sphereflake:3 and 2000 random spheres]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,
    /// Rounds of measuring
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = value_parser!(u16).range(1..=10_000))]
    pub(crate) rounds: u16,
    /// On the SPU model trace one of so many blocks; they stand for all
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = value_parser!(u32).range(1..=1000))]
    pub(crate) sample: u32,
    /// SIMD level [default: the best, or the one that CGT_LEVEL names]
    #[arg(long, value_name = "LEVEL")]
    pub(crate) level: Option<String>,
    /// Folder for a page that opens offline, ablation.html, with the same data in ablation.json and ablation.csv beside it
    #[arg(long, value_name = "FOLDER", default_value = "cgt-ablation")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Args, Debug)]
pub(crate) struct Spu {
    /// Scenes, as for `verify`
    #[arg(value_name = "SCENE", default_values_t = [verify::scenes::catalogue::DEFAULT.to_owned()])]
    pub(crate) scenes: Vec<String>,
    /// Plan of the grid tracer
    #[arg(long, value_name = "NAME", value_parser = ["paper", "safe"], default_value = "paper")]
    pub(crate) plan: String,
    /// Cells of the grid on each axis, 1 to 64 [default: the plan's: 16 for `paper`, chosen for the scene for `safe`]
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(1..=64))]
    pub(crate) grid: Option<u8>,
    /// Frames of an animation, from and to, counted from 0, the last one not among them
    #[arg(long, value_name = "A..B", value_parser = range, conflicts_with = "frame")]
    pub(crate) frames: Option<Range<usize>>,
    /// Trace one of so many blocks; they stand for all
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=1000))]
    pub(crate) sample: u32,
    /// Measure scenes that do not fit into the local store as if they did, instead of refusing them
    #[arg(long)]
    pub(crate) unlimited: bool,
    /// Show how many spheres fit beside which grid, and measure nothing
    #[arg(long, conflicts_with_all = ["curves", "json", "frames"])]
    pub(crate) capacity: bool,
    /// Also measure over scene size and grid size, for the page spu.html in --out
    #[arg(long, requires = "out")]
    pub(crate) curves: bool,
    /// Also count mispredicts on this computer: simulated by Valgrind, and by the processor's counters
    #[arg(long)]
    pub(crate) host: bool,
    /// File for all that was found, as JSON
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Folder for a page that opens offline, spu.html, with the same data in spu.json beside it
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    /// Walk so many times by that loop and print the cells: what --host counts
    #[arg(long, hide = true, value_name = "LOOP:LEVEL:WALKS")]
    pub(crate) walk: Option<String>,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Args, Debug)]
pub(crate) struct Claims {
    /// Scenes, as for `verify` [default: 1hvr, adk, sphereflake:3 and :4, and 500 to 4000 random spheres]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,
    /// Trace one of so many blocks; they stand for all
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=1000))]
    pub(crate) sample: u32,
    /// File for all that was found, as JSON
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// File for the table of claims, in Markdown as in README
    #[arg(long, value_name = "FILE")]
    pub(crate) markdown: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Args, Debug)]
pub(crate) struct Figures {
    /// Scene: a name or generator (see `cgt scenes`), or a file
    #[arg(value_name = "SCENE", default_value = verify::scenes::catalogue::DEFAULT)]
    pub(crate) scene: String,
    /// Folder for screen.svg, frustum.svg, loops.svg, corners.svg and the page figures.html; files of the same names in it
    /// are replaced
    #[arg(long, value_name = "FOLDER", default_value = "cgt-figures")]
    pub(crate) out: PathBuf,
    /// Column and row of a pixel whose block is looked at [default: the block that visits most cells among those that hit]
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub(crate) pixel: Option<[u32; 2]>,
    /// Plan of the grid tracer
    #[arg(long, value_name = "NAME", value_parser = ["paper", "safe"], default_value = "paper")]
    pub(crate) plan: String,
    /// Cells of the grid on each axis, 1 to 64 [default: the plan's: 16 for `paper`, chosen for the scene for `safe`]
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(1..=64))]
    pub(crate) grid: Option<u8>,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Args, Debug)]
pub(crate) struct Render {
    /// Scene: a name or generator (see `cgt scenes`), or a file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: String,
    /// The file to write: .png, or .exr for colour, id and t as layers; of several frames see --frames
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// What decides the picture
    #[arg(long, value_enum, default_value_t = Method::Exact)]
    pub(crate) method: Method,
    #[allow(clippy::doc_markdown, reason = "shown to people as it stands")]
    /// Frames of an animation, from and to, counted from 0, the last one not among them. FILE is then .apng or .png for an animated PNG, bit for
    /// bit; .gif, rounded to 256 colours in each frame; .y4m, or - for standard output, YUV4MPEG2 in 4:4:4, BT.601, rounded to 8 bits;
    /// or a .png or .exr with {frame} or %04d in its name for a file each
    #[arg(long, value_name = "A..B", value_parser = range, conflicts_with = "frame")]
    pub(crate) frames: Option<Range<usize>>,
    /// Frames a second of a film; GIFs have delays in hundredths of a second, so beyond 50 viewers slow down
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = value_parser!(u16).range(1..=1000), requires = "frames")]
    pub(crate) fps: u16,
    #[command(flatten)]
    pub(crate) view: View,
}

#[derive(Args, Debug)]
#[command(after_help = keys())]
pub(crate) struct Viewer {
    /// Scene: a name or generator (see `cgt scenes`), or a file; `trajectory.dcd,atoms.pdb` for two
    #[arg(value_name = "SCENE", default_value = "2juy")]
    pub(crate) scene: String,
    /// Plan to begin with
    #[arg(long, value_name = "NAME", value_parser = PLANS, default_value = "fast")]
    pub(crate) plan: String,
    /// SIMD level to begin with [default: the best, or the one that CGT_LEVEL names]
    #[arg(long, value_name = "LEVEL")]
    pub(crate) level: Option<String>,
    /// Frames of the animation that are played in a second
    #[arg(long, value_name = "N", default_value_t = 30.0, value_parser = rate)]
    pub(crate) fps: f64,
    /// Overlays to begin with, with commas between: blocks, cells, culling, lanes, wrong, times, help
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = overlay)]
    pub(crate) overlay: Vec<Overlay>,
    /// Begin with the paper's plan left of a line and the exact one right of it
    #[arg(long)]
    pub(crate) wipe: bool,
    /// Begin standing still
    #[arg(long)]
    pub(crate) paused: bool,
    /// Show it in the terminal: by kitty's, iTerm's or sixel graphics where the terminal has them, else in half blocks; `=blocks` for these in any case
    #[arg(long, value_name = "WAY", num_args = 0..=1, require_equals = true, default_missing_value = "best", value_parser = ["best", "blocks"])]
    pub(crate) terminal: Option<String>,
    /// Show it nowhere, only measure it
    #[arg(long, requires = "limit", conflicts_with = "terminal")]
    pub(crate) no_window: bool,
    /// Play each frame once, as fast as can be, for so long; then print frames a second and where the time went
    #[arg(long, value_name = "N", value_parser = seconds, group = "limit")]
    pub(crate) seconds: Option<f64>,
    /// The same for so many frames, again from the first after the last
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..), group = "limit")]
    pub(crate) frames: Option<u64>,
    #[command(flatten)]
    pub(crate) view: View,
}

/// The keys of a view, as its help shows them.
fn keys() -> String {
    let lines: String = verify::view::command::help().iter().map(|line| format!("\n  {line}")).collect();
    format!("Keys, in the window and in the terminal:{lines}")
}

fn overlay(text: &str) -> Result<Overlay, String> {
    let found = Overlay::ALL.into_iter().find(|(_, name)| *name == text);
    found
        .map(|(overlay, _)| overlay)
        .ok_or_else(|| format!("expected one of {}", Overlay::ALL.map(|(_, name)| name).join(", ")))
}

fn rate(text: &str) -> Result<f64, String> {
    let rate = text.parse::<f64>().map_err(|e| e.to_string())?;
    if (0.01..=1000.0).contains(&rate) { Ok(rate) } else { Err("expected 0.01 to 1000".into()) }
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
    /// Packets through a grid, with the plan `fast`: the truth, exact
    Fast,
    /// The same with the plan `safe`: perpendicular form in f32
    Safe,
    /// The same with the plan `paper`: textbook form in f32, spheres lost where cells overflow
    Paper,
}

#[derive(Args, Clone, Debug, Default)]
pub(crate) struct View {
    /// Pixels, from 1x1 to 16384 on a side [default: the scene's own, else 1280x720; of `chart` 320x180 then, of `ablate` 640x360, and of
    /// `figures` always 320x180]
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
    /// Threads, at most 1024; 0 is one a core
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = value_parser!(u16).range(..=1024))]
    pub(crate) threads: u16,
}

#[derive(Debug, Args)]
pub(crate) struct Prove {
    /// Lemmas, by the beginnings of their names, as walk or nearest.order [default: all]
    pub(crate) lemmas: Vec<String>,
    /// Prove also what takes long, ask every solver, and do every operation of every kernel wrong in every way; minutes
    #[arg(long)]
    pub(crate) long: bool,
    /// Write what was found to a file as well
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Write each lemma into a folder as the solver gets it, in SMT-LIB
    #[arg(long, value_name = "DIR")]
    pub(crate) smt: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct Replay {
    /// The case's file, as a failure of a test or a fuzz target leaves it
    #[arg(value_name = "CASE")]
    pub(crate) case: PathBuf,
    /// Column and row of the pixel to tell [default: the case's own, else the first wrong one]
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub(crate) pixel: Option<[u32; 2]>,
    /// Frame of the case that the pixel is of, counted from 0 [default: the first wrong one, else the last]
    #[arg(long, value_name = "N")]
    pub(crate) frame: Option<usize>,
    /// First make the case smaller: spheres, then pixels, then rounder numbers, as long as it keeps failing
    #[arg(long)]
    pub(crate) shrink: bool,
    /// Folder for the case, its picture (what was promised, what came, the difference) and the account
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) own: Own,
}

impl View {
    /// What is wished of the camera.
    pub(crate) fn framing(&self) -> Framing {
        Framing { eye: self.eye, target: self.target, up: self.up, fov: self.fov, size: self.size }
    }

    /// What of it was said, as words of a command line. Decimals are the shortest that read back the same.
    pub(crate) fn words(&self) -> String {
        let mut words = String::new();
        if let Some(size) = self.size {
            words += &format!(" --size {}x{}", size.width(), size.height());
        }
        for (name, vector) in [("eye", self.eye), ("target", self.target), ("up", self.up)] {
            if let Some([x, y, z]) = vector {
                words += &format!(" --{name} {x:?},{y:?},{z:?}");
            }
        }
        if let Some(fov) = self.fov {
            words += &format!(" --fov {fov:?}");
        }
        if self.frame != 0 {
            words += &format!(" --frame {}", self.frame);
        }
        words
    }

    /// Threads as a number above 0.
    pub(crate) fn threads(&self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            n => n.into(),
        }
    }
}

fn size(text: &str) -> Result<Size, String> {
    let number = |text: &str| text.parse::<u32>().map_err(|e| format!("`{text}`: {e}"));
    let (width, height) = text.split_once(['x', 'X']).ok_or("expected WIDTHxHEIGHT, as 1280x720")?;
    Size::new(number(width)?, number(height)?).map_err(|e| e.to_string())
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let (x, y) = text.split_once(',').ok_or("expected X,Y, as 3,7")?;
    let number = |text: &str| text.trim().parse::<u32>().map_err(|e| format!("`{text}`: {e}"));
    Ok([number(x)?, number(y)?])
}

fn range(text: &str) -> Result<Range<usize>, String> {
    let (from, to) = text.split_once("..").ok_or("expected A..B, as 0..10")?;
    let number = |text: &str| text.parse::<usize>().map_err(|e| format!("`{text}`: {e}"));
    let range = number(from)?..number(to)?;
    if range.is_empty() { Err(format!("{text} has no frame")) } else { Ok(range) }
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse::<f64>().map_err(|e| e.to_string())?;
    if (0.0..=86_400.0).contains(&seconds) { Ok(seconds) } else { Err("expected 0 to 86400".into()) }
}

fn times(text: &str) -> Result<f64, String> {
    let times = text.trim().parse::<f64>().map_err(|e| e.to_string())?;
    if (1e-3..=1e4).contains(&times) { Ok(times) } else { Err("expected 0.001 to 10000".into()) }
}

fn percent(text: &str) -> Result<f64, String> {
    let percent = text.parse::<f64>().map_err(|e| e.to_string())?;
    if (0.0..100.0).contains(&percent) { Ok(percent) } else { Err("expected 0 to below 100".into()) }
}

fn vector(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|x| x.trim().parse::<f64>()).collect();
    let numbers = numbers.map_err(|e| e.to_string())?;
    <[f64; 3]>::try_from(numbers).map_err(|n| format!("expected 3 numbers X,Y,Z, got {}", n.len()))
}
