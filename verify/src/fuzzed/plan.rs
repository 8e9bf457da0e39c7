//! From bytes to a plan, among all that the types allow, and when a plan may refuse a frame.

use super::bytes::Bytes;
use optimized::grid::MAX_CELLS;
use optimized::plan::{
    Arithmetic, Cells, Culling, Loop, Margins, OnEvent, Packet, Plan, Resolution, Sharing, Voxelizer,
};
use optimized::tile::MAX_SIDE;
use optimized::{Form, RenderError};
use reference::Arithmetic as Naive;

pub(super) const VOXELIZERS: [Voxelizer; 4] =
    [Voxelizer::EightCorners, Voxelizer::BoxRange, Voxelizer::Overlap, Voxelizer::ByCenter];
/// The certified one is the likeliest.
pub(super) const ARITHMETICS: [Arithmetic; 8] = [
    Arithmetic::Certified,
    Arithmetic::Rounded(Form::Textbook),
    Arithmetic::Certified,
    Arithmetic::Rounded(Form::Perpendicular),
    Arithmetic::Certified,
    Arithmetic::Spu(Form::Textbook),
    Arithmetic::Certified,
    Arithmetic::Spu(Form::Perpendicular),
];

/// Any plan, most of them such that promise a picture. Grids are coarse enough to be built in no time, or so fine that they are refused.
pub(super) fn plan(from: &mut Bytes<'_>) -> Plan {
    let [packet, margins, event, cells, side] = [0; 5].map(|_| from.byte());
    let n = match cells {
        255 => 255,
        254 => 0,
        _ => 1 + cells % 20,
    };
    let plan = Plan {
        voxelizer: from.one_of(&VOXELIZERS),
        cells: from.one_of(&[Cells::Queue, Cells::Lists]),
        walk: from.one_of(&[Loop::Nested, Loop::Flattened, Loop::Nested, Loop::Flattened, Loop::Printed]),
        packet: Packet::Block,
        culling: from.one_of(&[Culling::Planes, Culling::None]),
        margins: if margins < 240 { Margins::Derived } else { Margins::None },
        arithmetic: from.one_of(&ARITHMETICS),
        resolution: if from.flag() { Resolution::Fixed(n) } else { Resolution::UpTo(n) },
        on_event: match event {
            0..220 => OnEvent::FallBack,
            220..240 => OnEvent::Refuse,
            _ => OnEvent::GoOn,
        },
        sharing: from.one_of(&[Sharing::Shared, Sharing::Shared, Sharing::Shared, Sharing::Mirrored]),
    };
    let in_tiles = |plan| Plan { packet: Packet::Tile { side: side % (MAX_SIDE + 2) }, ..plan };
    match packet {
        0..140 => plan,
        // What tiles ask for.
        140..250 => in_tiles(Plan {
            voxelizer: Voxelizer::ByCenter,
            cells: Cells::Lists,
            margins: Margins::Derived,
            arithmetic: Arithmetic::Certified,
            ..plan
        }),
        250.. => in_tiles(plan),
    }
}

/// The reference's arithmetic that a plan's picture is to be that of.
pub(super) fn naive(arithmetic: Arithmetic) -> Naive {
    match arithmetic {
        Arithmetic::Rounded(Form::Textbook) => Naive::F32Textbook,
        Arithmetic::Rounded(Form::Perpendicular) => Naive::F32Perpendicular,
        Arithmetic::Spu(Form::Textbook) => Naive::SpuTextbook,
        Arithmetic::Spu(Form::Perpendicular) => Naive::SpuPerpendicular,
        Arithmetic::Certified => Naive::Exact,
    }
}

/// Whether a plan's tiles, if it has any, have what they need.
pub(super) fn tiles_are_served(plan: &Plan) -> bool {
    let Packet::Tile { side } = plan.packet else { return true };
    let listed_once = (plan.voxelizer, plan.cells) == (Voxelizer::ByCenter, Cells::Lists);
    let certain = (plan.arithmetic, plan.margins) == (Arithmetic::Certified, Margins::Derived);
    listed_once && certain && (1..=MAX_SIDE).contains(&side)
}

/// Whether a plan may answer so.
pub(super) fn may_refuse(plan: &Plan, error: &RenderError) -> bool {
    let (Resolution::Fixed(n) | Resolution::UpTo(n)) = plan.resolution;
    match error {
        RenderError::Tile { .. } => !tiles_are_served(plan),
        RenderError::Refused(_) => plan.on_event == OnEvent::Refuse,
        RenderError::Resolution { cells } => *cells == n && (n == 0 || usize::from(n) > MAX_CELLS),
        _ => false,
    }
}
