//! What is judged: any tracer that takes a scene and a camera and gives an image, with its promise.

use crate::case::{Asked, MOST_WORKERS};
use crate::verdict::Verdict;
use contract::{Camera, Image, Scene};
use optimized::grid::MAX_CELLS;
use optimized::plan::{Arithmetic, Cells, Margins, OnEvent, Packet, Resolution, Voxelizer};
use optimized::seen::Counts;
use optimized::tile::MAX_SIDE;
use optimized::{Event, Events, Form, Level, Plan, RenderError};
use reference::Arithmetic as Naively;
use std::time::Duration;

/// What a subject says of its own answers. A judge holds it to that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Promise {
    /// The picture is the truth, bit for bit.
    Exact,
    /// Every answer is one that rounding in this form can explain.
    Rounded(Rounding),
    /// As `Rounded`, and the picture is bit for bit that of the reference's naive tracer in the same form.
    EqualToNaive(Rounding),
}

/// The forms whose error bounds the judge knows ([`crate::judge::band`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounding {
    /// b² − a q in f64.
    TextbookF64,
    /// b² − a q in f32.
    TextbookF32,
    /// r² minus the squared distance of the centre from the ray, in f32.
    PerpendicularF32,
    /// b² − a q in the SPU's single precision.
    TextbookSpu,
    /// r² minus the squared distance of the centre from the ray, in the SPU's single precision.
    PerpendicularSpu,
}

impl Rounding {
    /// The reference's arithmetic of this form.
    #[must_use]
    pub fn naive(self) -> Naively {
        match self {
            Self::TextbookF64 => Naively::F64,
            Self::TextbookF32 => Naively::F32Textbook,
            Self::PerpendicularF32 => Naively::F32Perpendicular,
            Self::TextbookSpu => Naively::SpuTextbook,
            Self::PerpendicularSpu => Naively::SpuPerpendicular,
        }
    }
}

impl Promise {
    /// The reference's arithmetic that has the promised picture, or of a naive tracer its own.
    #[must_use]
    pub fn naive(self) -> Naively {
        match self {
            Self::Exact => Naively::Exact,
            Self::Rounded(rounding) | Self::EqualToNaive(rounding) => rounding.naive(),
        }
    }

    /// The worst verdict with which it is kept. Who states nothing of a scene has broken no promise there.
    #[must_use]
    pub fn worst(self) -> Verdict {
        match self {
            Self::Exact => Verdict::Equal,
            Self::Rounded(_) | Self::EqualToNaive(_) => Verdict::Undecidable,
        }
    }

    /// The promise in words, for the report.
    #[must_use]
    pub fn words(self) -> String {
        let form = |rounding| match rounding {
            Rounding::TextbookF64 => "the textbook form in f64",
            Rounding::TextbookF32 => "the textbook form in f32",
            Rounding::PerpendicularF32 => "the perpendicular form in f32",
            Rounding::TextbookSpu => "the textbook form on the SPU",
            Rounding::PerpendicularSpu => "the perpendicular form on the SPU",
        };
        match self {
            Self::Exact => "the truth, bit for bit".into(),
            Self::Rounded(rounding) => format!("within the rounding of {}", form(rounding)),
            Self::EqualToNaive(rounding) => {
                format!("bit for bit the naive picture of {}, hence within its rounding", form(rounding))
            }
        }
    }
}

/// Why a subject gave no picture.
pub type SubjectError = Box<dyn std::error::Error + Send + Sync>;

/// A tracer under test.
pub trait Subject: Sync {
    /// Short and unique, for tables and file names.
    fn name(&self) -> &str;

    /// One sentence: what it is.
    fn description(&self) -> &str;

    /// What it is held to.
    fn promise(&self) -> Promise;

    /// Renders with so many threads and calls `row_done` now and then, once a row in all.
    ///
    /// # Errors
    /// Whatever keeps it from giving a picture. That is reported as not judged, never as a pass.
    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Rendered, SubjectError>;

    /// What asks `cgt` for it on a command line.
    fn option(&self) -> String {
        format!("--subject {}", self.name())
    }

    /// How a case names it with so many threads, so that a failure can be shrunk and kept; none for a tracer that no file can name.
    fn asked(&self, _threads: usize) -> Option<Asked> {
        None
    }
}

/// What a subject gives.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The picture.
    pub image: Image,
    /// What the subject itself has to say of it, a sentence each.
    pub notes: Vec<String>,
    /// How long it took, where the call of [`Subject::render`] takes longer than that by what is not the tracer's.
    pub took: Option<Duration>,
}

/// The reference in one of its roundings.
#[derive(Clone, Copy, Debug)]
pub struct Naive(pub Rounding);

impl Subject for Naive {
    fn name(&self) -> &str {
        match self.0 {
            Rounding::TextbookF64 => "naive-f64",
            Rounding::TextbookF32 => "naive-f32-textbook",
            Rounding::PerpendicularF32 => "naive-f32-perpendicular",
            Rounding::TextbookSpu => "naive-spu-textbook",
            Rounding::PerpendicularSpu => "naive-spu-perpendicular",
        }
    }

    fn description(&self) -> &str {
        match self.0 {
            Rounding::TextbookF64 => "one loop over all spheres per ray, b² − ac in f64",
            Rounding::TextbookF32 => "one loop over all spheres per ray, b² − ac in f32",
            Rounding::PerpendicularF32 => {
                "one loop over all spheres per ray, distance of the centre from the ray in f32"
            }
            Rounding::TextbookSpu => "one loop over all spheres per ray, b² − ac in the SPU's f32",
            Rounding::PerpendicularSpu => {
                "one loop over all spheres per ray, distance of the centre from the ray in the SPU's f32"
            }
        }
    }

    fn promise(&self) -> Promise {
        Promise::Rounded(self.0)
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Rendered, SubjectError> {
        let tracer = reference::Tracer::new(self.0.naive()).threads(threads);
        let image = tracer.render_with(scene, camera, row_done)?.image;
        Ok(Rendered { image, notes: Vec::new(), took: None })
    }

    fn asked(&self, _: usize) -> Option<Asked> {
        Some(Asked::Naive(*self))
    }
}

/// The plans that have a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedPlan {
    /// [`Plan::paper`].
    Paper,
    /// [`Plan::safe`].
    Safe,
    /// [`Plan::fast`].
    Fast,
}

impl NamedPlan {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Safe, Self::Paper];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Safe => "safe",
            Self::Fast => "fast",
        }
    }

    /// The plan itself.
    #[must_use]
    pub fn plan(self) -> Plan {
        match self {
            Self::Paper => Plan::paper(),
            Self::Safe => Plan::safe(),
            Self::Fast => Plan::fast(),
        }
    }
}

/// The grid tracer of `optimized` with a plan, at a level.
#[derive(Clone, Debug)]
pub struct Grid {
    name: String,
    description: String,
    plan: Plan,
    level: Level,
    /// What asks for it on a command line.
    option: String,
}

impl Grid {
    /// The tracer of a named plan; `cells` on each axis instead of the plan's own choice. Its name carries the level if
    /// `several` are judged.
    #[must_use]
    pub fn new(plan: NamedPlan, level: Level, several: bool, cells: Option<u8>) -> Self {
        let name = if several { format!("{}@{level}", plan.name()) } else { plan.name().to_owned() };
        let chosen = plan.plan();
        let mut option = format!("--plan {} --level {level}", plan.name());
        if let Some(cells) = cells {
            option += &format!(" --grid {cells}");
        }
        let plan = Plan { resolution: cells.map_or(chosen.resolution, Resolution::Fixed), ..chosen };
        Self { option, ..Self::of(plan, level, name) }
    }

    /// The tracer of any plan, under a name of the caller's.
    #[must_use]
    pub fn of(plan: Plan, level: Level, name: String) -> Self {
        Self {
            option: format!("--subject {name}"),
            name,
            description: format!("packets of 4x4 rays through a grid rebuilt for the frame: {plan}"),
            plan,
            level,
        }
    }
}

impl Subject for Grid {
    fn name(&self) -> &str {
        &self.name
    }

    fn description(&self) -> &str {
        &self.description
    }

    fn promise(&self) -> Promise {
        promise(self.plan.arithmetic)
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Rendered, SubjectError> {
        let tracer = optimized::Tracer::new(self.plan, self.level).workers(threads);
        let rendering = tracer.render(scene, camera)?;
        (0..camera.size().height()).for_each(|_| row_done());
        let counts = rendering.counts;
        let mut notes = event_notes(&rendering.events);
        notes.push(format!(
            "{} cells visited, {} candidates found in them, {} of these culled, {} blocks split.",
            counts.cells, counts.candidates, counts.culled, counts.split_blocks
        ));
        if self.plan.arithmetic == Arithmetic::Certified {
            notes.push(stages(&counts));
        }
        Ok(Rendered { image: rendering.image, notes, took: None })
    }

    fn option(&self) -> String {
        self.option.clone()
    }

    fn asked(&self, threads: usize) -> Option<Asked> {
        let workers = u8::try_from(threads).unwrap_or(u8::MAX).clamp(1, MOST_WORKERS);
        Some(Asked::Grid { plan: self.plan, level: self.level, workers })
    }
}

/// What the grid tracer promises in an arithmetic. The paper claims no less: its grid is to lose nothing.
#[must_use]
pub fn promise(arithmetic: Arithmetic) -> Promise {
    match arithmetic {
        Arithmetic::Rounded(Form::Textbook) => Promise::EqualToNaive(Rounding::TextbookF32),
        Arithmetic::Rounded(Form::Perpendicular) => Promise::EqualToNaive(Rounding::PerpendicularF32),
        Arithmetic::Spu(Form::Textbook) => Promise::EqualToNaive(Rounding::TextbookSpu),
        Arithmetic::Spu(Form::Perpendicular) => Promise::EqualToNaive(Rounding::PerpendicularSpu),
        Arithmetic::Certified => Promise::Exact,
    }
}

/// Whether a plan's tiles, if it has any, have what they need.
#[must_use]
pub fn tiles_are_served(plan: &Plan) -> bool {
    let Packet::Tile { side } = plan.packet else { return true };
    let listed_once = (plan.voxelizer, plan.cells) == (Voxelizer::ByCenter, Cells::Lists);
    let certain = (plan.arithmetic, plan.margins) == (Arithmetic::Certified, Margins::Derived);
    listed_once && certain && (1..=MAX_SIDE).contains(&side)
}

/// Whether a plan may answer so. Whatever else keeps the grid tracer from giving a picture is a failure of it.
#[must_use]
pub fn may_refuse(plan: &Plan, error: &RenderError) -> bool {
    let (Resolution::Fixed(n) | Resolution::UpTo(n)) = plan.resolution;
    match error {
        RenderError::Tile { .. } => !tiles_are_served(plan),
        RenderError::Refused(_) => plan.on_event == OnEvent::Refuse,
        RenderError::Resolution { cells } => *cells == n && (n == 0 || usize::from(n) > MAX_CELLS),
        _ => false,
    }
}

/// How many rays needed which stage of certified arithmetic, in all and in a million.
fn stages(counts: &Counts) -> String {
    let part = |n: u64| format!("{n} ({:.1} in a million)", n as f64 * 1e6 / counts.lanes.max(1) as f64);
    format!(
        "Of {} rays f32 left {} to f64, which left {} to integers; integers rounded the t of {} more.",
        counts.lanes,
        part(counts.asked_f64),
        part(counts.asked_integers),
        part(counts.rounded_by_integers)
    )
}

/// How many of each kind of event there were, and the first of each in full.
fn event_notes(events: &Events) -> Vec<String> {
    type Kind = (&'static str, fn(&Event) -> bool);
    let kinds: [Kind; 4] = [
        ("pushes onto full queues", |e| matches!(e, Event::CellFull { .. })),
        ("spheres with more than two cells on an axis", |e| matches!(e, Event::SpansCells { .. })),
        ("scenes of too many ids", |e| matches!(e, Event::TooManyIds { .. })),
        ("scenes out of range", |e| matches!(e, Event::OutOfRange)),
    ];
    let note = |(what, is): Kind| {
        let first = events.first().iter().find(|event| is(event))?;
        let count = events.first().iter().filter(|event| is(event)).count();
        let more = if events.count() > events.first().len() as u64 { "at least " } else { "" };
        Some(format!("{more}{count} {what}, the first: {first}."))
    };
    kinds.into_iter().filter_map(note).collect()
}

/// Every naive subject there is.
pub const NAIVE_ALL: [Naive; 5] = [
    Naive(Rounding::TextbookF64),
    Naive(Rounding::PerpendicularF32),
    Naive(Rounding::TextbookF32),
    Naive(Rounding::PerpendicularSpu),
    Naive(Rounding::TextbookSpu),
];

/// The naive subjects of the report, in its order.
pub const NAIVE: [Naive; 3] =
    [Naive(Rounding::TextbookF64), Naive(Rounding::PerpendicularF32), Naive(Rounding::TextbookF32)];
