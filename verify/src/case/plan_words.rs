//! A plan as a case's file has it: one word for each concern, and back again.

use optimized::Plan;
use optimized::plan::{
    Arithmetic, Cells, Culling, Loop, Margins, OnEvent, Packet, Resolution, Sharing, Voxelizer,
};
use optimized::sphere::Form;
use serde::{Deserialize, Serialize};

/// The words.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "as the fields of a plan")]
pub struct PlanWords {
    pub voxelizer: String,
    pub cells: String,
    pub walk: String,
    pub packet: String,
    pub culling: String,
    pub margins: String,
    pub arithmetic: String,
    pub resolution: String,
    pub on_event: String,
    pub sharing: String,
}

type Words<T> = [(&'static str, T)];

/// How spheres get into cells.
pub const VOXELIZERS: [(&str, Voxelizer); 4] = [
    ("eight corners", Voxelizer::EightCorners),
    ("box range", Voxelizer::BoxRange),
    ("overlap", Voxelizer::Overlap),
    ("by centre", Voxelizer::ByCenter),
];
/// What a cell is.
pub const CELLS: [(&str, Cells); 2] = [("queue", Cells::Queue), ("lists", Cells::Lists)];
/// How cells are gone through.
pub const LOOPS: [(&str, Loop); 3] =
    [("nested", Loop::Nested), ("flattened", Loop::Flattened), ("printed", Loop::Printed)];
/// What is dropped beforehand.
pub const CULLINGS: [(&str, Culling); 2] = [("none", Culling::None), ("planes", Culling::Planes)];
/// What covers rounding.
pub const MARGINS: [(&str, Margins); 2] = [("none", Margins::None), ("derived", Margins::Derived)];
/// How hits are decided.
pub const ARITHMETICS: [(&str, Arithmetic); 5] = [
    ("textbook", Arithmetic::Rounded(Form::Textbook)),
    ("perpendicular", Arithmetic::Rounded(Form::Perpendicular)),
    ("spu textbook", Arithmetic::Spu(Form::Textbook)),
    ("spu perpendicular", Arithmetic::Spu(Form::Perpendicular)),
    ("certified", Arithmetic::Certified),
];
/// What follows an event.
pub const ON_EVENTS: [(&str, OnEvent); 3] =
    [("go on", OnEvent::GoOn), ("fall back", OnEvent::FallBack), ("refuse", OnEvent::Refuse)];
/// Who has the grid.
pub const SHARINGS: [(&str, Sharing); 2] = [("shared", Sharing::Shared), ("mirrored", Sharing::Mirrored)];

fn word<T: Copy + PartialEq>(words: &Words<T>, value: T) -> String {
    words.iter().find(|(_, v)| *v == value).map_or(String::new(), |(word, _)| (*word).to_owned())
}

fn value<T: Copy>(words: &Words<T>, what: &str, text: &str) -> Result<T, String> {
    let found = words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
    found.ok_or_else(|| {
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        format!("{what} `{text:.40}` is none of {}", known.join(", "))
    })
}

fn number(what: &str, text: &str) -> Result<u8, String> {
    text.parse()
        .ok()
        .filter(|n| *n > 0)
        .ok_or_else(|| format!("{what} `{text:.40}` is no number from 1 to 255"))
}

impl From<Plan> for PlanWords {
    fn from(plan: Plan) -> Self {
        Self {
            voxelizer: word(&VOXELIZERS, plan.voxelizer),
            cells: word(&CELLS, plan.cells),
            walk: word(&LOOPS, plan.walk),
            packet: match plan.packet {
                Packet::Block => "block".into(),
                Packet::Tile { side } => format!("tile {side}"),
            },
            culling: word(&CULLINGS, plan.culling),
            margins: word(&MARGINS, plan.margins),
            arithmetic: word(&ARITHMETICS, plan.arithmetic),
            resolution: match plan.resolution {
                Resolution::Fixed(n) => format!("{n}"),
                Resolution::UpTo(n) => format!("up to {n}"),
            },
            on_event: word(&ON_EVENTS, plan.on_event),
            sharing: word(&SHARINGS, plan.sharing),
        }
    }
}

impl TryFrom<PlanWords> for Plan {
    type Error = String;

    fn try_from(words: PlanWords) -> Result<Self, String> {
        Ok(Self {
            voxelizer: value(&VOXELIZERS, "voxelizer", &words.voxelizer)?,
            cells: value(&CELLS, "cells", &words.cells)?,
            walk: value(&LOOPS, "walk", &words.walk)?,
            packet: match words.packet.strip_prefix("tile ") {
                Some(side) => Packet::Tile { side: number("tile", side)? },
                None => value(&[("block", Packet::Block)], "packet", &words.packet)?,
            },
            culling: value(&CULLINGS, "culling", &words.culling)?,
            margins: value(&MARGINS, "margins", &words.margins)?,
            arithmetic: value(&ARITHMETICS, "arithmetic", &words.arithmetic)?,
            resolution: match words.resolution.strip_prefix("up to ") {
                Some(n) => Resolution::UpTo(number("resolution", n)?),
                None => Resolution::Fixed(number("resolution", &words.resolution)?),
            },
            on_event: value(&ON_EVENTS, "on_event", &words.on_event)?,
            sharing: value(&SHARINGS, "sharing", &words.sharing)?,
        })
    }
}
