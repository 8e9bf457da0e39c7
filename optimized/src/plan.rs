//! A plan: one choice for each concern of the tracer, each with what it needs to be right.
//!
//! [`Plan::paper`] is Chapman's paper to the letter, so that it can be seen to fail; [`Plan::safe`] is the same with every
//! precondition enforced or mended. A precondition that a scene breaks is an [`Event`](crate::event::Event); the plan
//! says what then happens ([`OnEvent`]), and the event is in the result in any case.

use crate::margin;
use crate::sphere::Form;
use contract::Scene;
use std::fmt;

/// How spheres get into cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Voxelizer {
    /// Into the cells of the eight corners of the sphere's box (the paper). Needs: no sphere's box spans more than
    /// two cells on an axis, [`Event::SpansCells`](crate::event::Event::SpansCells).
    EightCorners,
    /// Into all cells of the sphere's box.
    BoxRange,
    /// Into the cells of its box whose own box the ball meets. Buys 3 to 4 % of the SPU's cycles and no time (`cgt ablate`); kept as what the
    /// others are held against: it lists no id in vain.
    Overlap,
    /// Into the cell of its centre alone; packets are widened by the largest radius instead (Gribble et al. 2007).
    ByCenter,
}

/// What a cell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cells {
    /// 32 bytes: sixteen ids of 2 bytes, newest first (the paper). Needs: at most sixteen spheres in a cell,
    /// [`Event::CellFull`](crate::event::Event::CellFull), and at most 65,535 in the scene,
    /// [`Event::TooManyIds`](crate::event::Event::TooManyIds).
    Queue,
    /// One list of ids with an offset for each cell.
    Lists,
}

/// How a packet goes through its slices and cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Loop {
    /// Three nested loops (the paper's Figure 3, top).
    Nested,
    /// One loop whose step selects among three cases without a branch (Figure 3, bottom), mended. Buys nothing: a frame took 1.3 to 5.3 times as
    /// long as with nested loops, and 1.2 to 1.3 times the SPU's cycles, on three scenes (`cgt ablate`). Kept as the paper's own.
    Flattened,
    /// That loop as it is printed. A known fault: it keeps the first slice's bounds, runs Y innermost, and visits empty
    /// slices. It is kept to be refuted.
    Printed,
}

/// Which rays go through the grid together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Packet {
    /// Those of a 4x4 block (the paper).
    Block,
    /// Those of a square tile of blocks: candidates are gathered once for the tile, and held by their outlines against each of its blocks
    /// ([`crate::tile`]). Needs: spheres listed once, that is by centre and in lists; certified arithmetic; derived margins;
    /// [`RenderError::Tile`](crate::RenderError::Tile). Its cells are taken row by row, so the plan's loop has no part in it.
    Tile {
        /// Blocks on a side, from 1 to [`MAX_SIDE`](crate::tile::MAX_SIDE).
        side: u8,
    },
}

/// What is done with a sphere of a visited cell before sixteen rays are intersected with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Culling {
    /// Nothing.
    None,
    /// It is dropped if it lies outside one of the frustum's four planes. In 4x4 blocks that buys 6 to 8 % of the SPU's cycles and no time on a
    /// host; in tiles it is what makes them fast (`cgt ablate`).
    Planes,
}

/// What covers the rounding of the tracer's own arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Margins {
    /// Nothing (the paper).
    None,
    /// The derived ones of [`crate::margin`], [`crate::frustum`], [`crate::cull`] and [`crate::walk`]. Needs: a scene
    /// in range, [`Event::OutOfRange`](crate::event::Event::OutOfRange).
    Derived,
}

/// How a hit is decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// As one of the f32 forms rounds it (the paper).
    Rounded(Form),
    /// As one of them cuts it off on the SPU (contract, rule 6). The way to the spheres is gone in IEEE 754, with margins that cover the
    /// SPU's errors; the sphere kernel alone runs in its arithmetic.
    Spu(Form),
    /// As it is in truth: f32 where its error bound allows ([`crate::certain`]), else f64, else integers ([`crate::settle`]).
    Certified,
}

impl From<Form> for Arithmetic {
    fn from(form: Form) -> Self {
        Self::Rounded(form)
    }
}

/// Cells on each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Resolution {
    /// So many on each axis, from 1 to [`MAX_CELLS`](crate::grid::MAX_CELLS). The paper's grid has 16. Lists of more than 2³² ids, or than
    /// memory holds, do not fit: then there are half as many on each axis, and so on until they do, and the picture stays; a plan that
    /// refuses is told instead, [`RenderError::Lists`](crate::RenderError::Lists).
    Fixed(u8),
    /// Chosen for the scene, at most so many on an axis.
    UpTo(u8),
}

/// What happens when a scene breaks a precondition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OnEvent {
    /// The tracer goes on as the paper would, and the picture may be wrong.
    GoOn,
    /// The next choice whose preconditions hold is taken: box range for eight corners, lists for queues, every sphere a
    /// candidate where margins state nothing. The picture is right.
    FallBack,
    /// The frame is refused.
    Refuse,
}

/// Who has the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sharing {
    /// One, read by all workers.
    Shared,
    /// Each worker builds its own (the paper: every SPU voxelizes the whole scene). Buys nothing where memory is shared; kept as the paper's own.
    Mirrored,
}

/// One choice for each concern.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "each field is explained at its type")]
pub struct Plan {
    pub voxelizer: Voxelizer,
    pub cells: Cells,
    pub walk: Loop,
    pub packet: Packet,
    pub culling: Culling,
    pub margins: Margins,
    pub arithmetic: Arithmetic,
    pub resolution: Resolution,
    pub on_event: OnEvent,
    pub sharing: Sharing,
}

impl Plan {
    /// The paper to the letter, but for the printed loop ([`Loop::Printed`]), with which hardly any picture is one.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            voxelizer: Voxelizer::EightCorners,
            cells: Cells::Queue,
            walk: Loop::Flattened,
            packet: Packet::Block,
            culling: Culling::Planes,
            margins: Margins::None,
            arithmetic: Arithmetic::Rounded(Form::Textbook),
            resolution: Resolution::Fixed(16),
            on_event: OnEvent::GoOn,
            sharing: Sharing::Mirrored,
        }
    }

    /// The paper with every precondition enforced or mended: its picture is that of the naive tracer of the same
    /// form, bit for bit, for every scene.
    #[must_use]
    pub fn safe() -> Self {
        Self {
            voxelizer: Voxelizer::BoxRange,
            cells: Cells::Lists,
            walk: Loop::Flattened,
            packet: Packet::Block,
            culling: Culling::Planes,
            margins: Margins::Derived,
            arithmetic: Arithmetic::Rounded(Form::Perpendicular),
            resolution: Resolution::UpTo(32),
            on_event: OnEvent::FallBack,
            sharing: Sharing::Shared,
        }
    }

    /// What a user wants: the exact picture, as fast as we can. [`Plan::for_scene`] fits it to a scene.
    #[must_use]
    pub fn fast() -> Self {
        Self {
            voxelizer: Voxelizer::ByCenter,
            arithmetic: Arithmetic::Certified,
            walk: Loop::Nested,
            packet: Packet::Tile { side: 32 },
            resolution: Resolution::UpTo(240),
            ..Self::safe()
        }
    }

    /// The cheapest plan that gives the exact picture of a scene, with the reasons. It reads each sphere once, for the range of the margins,
    /// as every frame does again.
    #[must_use]
    pub fn for_scene(scene: &Scene) -> Chosen {
        let (spheres, fast) = (scene.spheres(), Self::fast());
        if spheres.iter().any(|sphere| !margin::sphere_in_range(sphere)) {
            let plan = Self { packet: Packet::Block, ..fast };
            return Chosen { plan, reasons: vec![Reason::OutOfRange] };
        }
        if spheres.len() < MANY {
            return Chosen { plan: fast, reasons: vec![Reason::Few { spheres: spheres.len() }] };
        }
        let plan = Self { packet: Packet::Tile { side: 16 }, ..fast };
        Chosen { plan, reasons: vec![Reason::Many { spheres: spheres.len() }] }
    }

    /// Whether the plan promises the naive picture of its arithmetic for every scene it does not refuse.
    #[must_use]
    pub fn promises_equality(&self) -> bool {
        self.on_event != OnEvent::GoOn && self.margins == Margins::Derived && self.walk != Loop::Printed
    }
}

/// Spheres from which smaller tiles are cheaper: with more of them candidates come from more rounds, of which a smaller tile needs fewer.
/// Measured (AVX-512, one thread, 1280x720, random spheres): 10,000 take 5.7 ms in tiles of 32x32 blocks and 6.0 in those of 16x16,
/// 100,000 take 13.1 and 12.0 ms, 1,000,000 take 68.6 and 64.2 ms.
const MANY: usize = 50_000;

/// A plan and why it was chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chosen {
    /// The plan.
    pub plan: Plan,
    /// What spoke for it.
    pub reasons: Vec<Reason>,
}

/// What speaks for a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "each says what it is")]
pub enum Reason {
    /// No margins hold for some sphere, so that there is no grid and no tile.
    OutOfRange,
    /// So few that a large tile's candidates are seen in one round.
    Few { spheres: usize },
    /// So many that small tiles need fewer rounds.
    Many { spheres: usize },
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange => f.write_str(
                "a sphere lies beyond the range of the margins: all spheres meet all rays, in 4x4 blocks",
            ),
            Self::Few { spheres } => {
                write!(
                    f,
                    "{spheres} spheres, fewer than {MANY}: large tiles see their candidates in one round"
                )
            }
            Self::Many { spheres } => {
                write!(f, "{spheres} spheres, not fewer than {MANY}: small tiles need fewer rounds")
            }
        }
    }
}

/// In words, as reports show it.
impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let voxelizer = match self.voxelizer {
            Voxelizer::EightCorners => "eight corners",
            Voxelizer::BoxRange => "box range",
            Voxelizer::Overlap => "exact overlap",
            Voxelizer::ByCenter => "by centre",
        };
        let cells = match self.cells {
            Cells::Queue => "queues of 16",
            Cells::Lists => "lists",
        };
        let walk = match self.walk {
            Loop::Nested => "nested loops",
            Loop::Flattened => "flattened loop",
            Loop::Printed => "the loop as printed",
        };
        let culling = match self.culling {
            Culling::None => "no culling",
            Culling::Planes => "four planes",
        };
        let margins = match self.margins {
            Margins::None => "no margins",
            Margins::Derived => "derived margins",
        };
        let packet = match self.packet {
            Packet::Block => "4x4 blocks".to_owned(),
            Packet::Tile { side } => format!("tiles of {side}x{side} blocks"),
        };
        let arithmetic = match self.arithmetic {
            Arithmetic::Rounded(Form::Textbook) => "textbook f32",
            Arithmetic::Rounded(Form::Perpendicular) => "perpendicular f32",
            Arithmetic::Spu(Form::Textbook) => "textbook on the SPU",
            Arithmetic::Spu(Form::Perpendicular) => "perpendicular on the SPU",
            Arithmetic::Certified => "certified exact",
        };
        let on_event = match self.on_event {
            OnEvent::GoOn => "goes on in any event",
            OnEvent::FallBack => "falls back",
            OnEvent::Refuse => "refuses",
        };
        let sharing = match self.sharing {
            Sharing::Shared => "one grid",
            Sharing::Mirrored => "a grid for each worker",
        };
        write!(f, "{voxelizer} into {cells}, {packet}, {walk}, {culling}, {margins}, {arithmetic}, ")?;
        match self.resolution {
            Resolution::Fixed(n) => write!(f, "{n} cells on an axis, ")?,
            Resolution::UpTo(n) => write!(f, "up to {n} cells on an axis, ")?,
        }
        write!(f, "{on_event}, {sharing}")
    }
}
