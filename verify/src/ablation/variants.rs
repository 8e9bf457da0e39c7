//! Plans that differ from another in one concern.

use crate::subject::tiles_are_served;
use optimized::plan::{Arithmetic, Cells, Culling, Loop, Margins, Packet, Resolution, Sharing, Voxelizer};
use optimized::{Form, Plan};

/// A plan that others are compared with.
#[derive(Clone, Copy, Debug)]
pub struct Base {
    /// Its name.
    pub name: &'static str,
    /// In a sentence, what its variants show.
    pub what: &'static str,
    /// The plan.
    pub plan: Plan,
}

/// A plan with one concern changed.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The concern.
    pub concern: &'static str,
    /// The other choice.
    pub choice: String,
    /// The plan.
    pub plan: Plan,
}

/// The plans with a name, and the exact one in the paper's blocks, in which concerns can be changed that tiles do not have.
#[must_use]
pub fn bases() -> [Base; 4] {
    [
        Base { name: "fast", what: "What a user gets: exact, in tiles.", plan: Plan::fast() },
        Base {
            name: "fast-blocks",
            what: "The same in the paper's 4x4 blocks, so that each concern can be changed.",
            plan: Plan { packet: Packet::Block, ..Plan::fast() },
        },
        Base { name: "safe", what: "The paper with everything mended.", plan: Plan::safe() },
        Base {
            name: "paper",
            what: "The paper to the letter, one thing mended at a time.",
            plan: Plan::paper(),
        },
    ]
}

/// All plans that differ from one in one concern, but for those that lack what their tiles need. Two concerns that go together are changed
/// together: without margins the plan goes on in any event.
#[must_use]
pub fn variants(base: Plan) -> Vec<Variant> {
    let mut all = Vec::new();
    let mut add = |concern, choice: &str, plan: Plan| {
        if plan != base && tiles_are_served(&plan) {
            all.push(Variant { concern, choice: choice.into(), plan });
        }
    };
    for (choice, voxelizer) in [
        ("eight corners", Voxelizer::EightCorners),
        ("box range", Voxelizer::BoxRange),
        ("exact overlap", Voxelizer::Overlap),
        ("by centre", Voxelizer::ByCenter),
    ] {
        add("voxelizer", choice, Plan { voxelizer, ..base });
    }
    for (choice, cells) in [("queues of 16", Cells::Queue), ("lists", Cells::Lists)] {
        add("cells", choice, Plan { cells, ..base });
    }
    for (choice, walk) in [("nested", Loop::Nested), ("flattened", Loop::Flattened)] {
        if base.packet == Packet::Block {
            add("loop", choice, Plan { walk, ..base });
        }
    }
    let sides = [8, 16, 32, 64].map(|side| (format!("tiles of {side}"), Packet::Tile { side }));
    for (choice, packet) in sides.into_iter().chain([("4x4 blocks".into(), Packet::Block)]) {
        add("packet", &choice, Plan { packet, ..base });
    }
    for (choice, culling) in [("none", Culling::None), ("four planes", Culling::Planes)] {
        add("culling", choice, Plan { culling, ..base });
    }
    for (choice, margins) in [("none", Margins::None), ("derived", Margins::Derived)] {
        add("margins", choice, Plan { margins, ..base });
    }
    for (choice, arithmetic) in [
        ("textbook f32", Arithmetic::Rounded(Form::Textbook)),
        ("perpendicular f32", Arithmetic::Rounded(Form::Perpendicular)),
        ("textbook, SPU", Arithmetic::Spu(Form::Textbook)),
        ("perpendicular, SPU", Arithmetic::Spu(Form::Perpendicular)),
        ("certified", Arithmetic::Certified),
    ] {
        add("arithmetic", choice, Plan { arithmetic, ..base });
    }
    for n in [4, 8, 16, 32, 64] {
        add("grid", &format!("{n} cells"), Plan { resolution: Resolution::Fixed(n), ..base });
    }
    for (choice, sharing) in [("one for all", Sharing::Shared), ("one a worker", Sharing::Mirrored)] {
        add("grid's owner", choice, Plan { sharing, ..base });
    }
    all
}

/// Whether the SPU model can run a plan: blocks, one of the two forms of f32.
#[must_use]
pub fn is_on_spu(plan: &Plan) -> bool {
    plan.packet == Packet::Block
        && matches!(plan.arithmetic, Arithmetic::Rounded(_))
        && plan.walk != Loop::Printed
}

#[cfg(test)]
mod tests {
    use super::{bases, variants};
    use std::collections::HashSet;

    #[test]
    fn each_variant_is_another_plan() {
        for base in bases() {
            let plans: Vec<_> = variants(base.plan).into_iter().map(|variant| variant.plan).collect();
            let different: HashSet<_> = plans.iter().collect();
            assert_eq!(different.len(), plans.len(), "{}", base.name);
            assert!(!different.contains(&base.plan), "{}", base.name);
        }
        let concerns: HashSet<_> =
            bases().iter().flat_map(|base| variants(base.plan)).map(|variant| variant.concern).collect();
        assert_eq!(concerns.len(), 9, "{concerns:?}");
    }
}
