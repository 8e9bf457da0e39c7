//! From bytes to a plan, among all that the types allow.

use super::bytes::Bytes;
use optimized::Form;
use optimized::plan::{
    Arithmetic, Cells, Culling, Loop, Margins, OnEvent, Packet, Plan, Resolution, Sharing, Voxelizer,
};
use optimized::tile::MAX_SIDE;

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
