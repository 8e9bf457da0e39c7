//! The claims that are proved, one to a file, and the table of them.

pub mod bound;
pub mod cell;
pub mod find;
pub mod nearest;
pub mod queue;
mod real;
pub mod rounding;
pub mod visible;
pub mod walk;

use super::theorem::{Expected, Lemma};
use crate::report::Evidence;
use optimized::machine::Machine;

/// The kernel of a lemma that is about none.
pub const NONE: &str = "none";

/// A claim of the suite, and the lemmas that it rests on.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// What is claimed.
    pub statement: &'static str,
    /// The kind of evidence.
    pub evidence: Evidence,
    /// The names of the lemmas.
    pub lemmas: &'static [&'static str],
    /// What it rests on beside them.
    pub beside: &'static str,
}

/// What is claimed of kernels for all inputs.
pub const CLAIMS: [Claim; 11] = [
    Claim {
        statement: "The mended flattened loop visits the cells of the nested loops in their order, and ends",
        evidence: Evidence::Proved,
        lemmas: &["walk.successor", "walk.empty", "walk.forward"],
        beside: "all 32-bit bounds; by induction, and start and end exhausted over all pairs of rectangles within 6x6 cells",
    },
    Claim {
        statement: "The paper's loop as printed does",
        evidence: Evidence::Refuted,
        lemmas: &["walk.printed.any", "walk.printed.right", "walk.printed.wide", "walk.printed.stale"],
        beside: "one slice of 2x2 cells; right if and only if all slices have one rectangle, one cell wide on an axis",
    },
    Claim {
        statement: "A push puts the id first, keeps the order of fifteen others, loses exactly the oldest, and is never taken for empty",
        evidence: Evidence::Proved,
        lemmas: &["queue.push", "queue.occupied"],
        beside: "all contents and ids; all 4,140 coincidences of eight corners exhausted",
    },
    Claim {
        statement: "Kernels in selects do what their branching forms do: the step of the walk, the cell map, the nearest hit",
        evidence: Evidence::Proved,
        lemmas: &[
            "walk.successor",
            "cell.branches",
            "nearest.branches.textbook",
            "nearest.branches.perpendicular",
        ],
        beside: "all 32-bit inputs",
    },
    Claim {
        statement: "The cell map is monotone over all f32, for every grid, so a ball's box range holds the cell of each of its points",
        evidence: Evidence::Proved,
        lemmas: &["cell.monotone", "cell.difference", "cell.product", "cell.between"],
        beside: "that rounding keeps the order of products is its definition; all 2^32 f32 exhausted for given grids",
    },
    Claim {
        statement: "Eight corners miss no cell if objects are no larger than cells (the paper)",
        evidence: Evidence::Refuted,
        lemmas: &["cell.corners.equal", "cell.corners.below", "cell.corners"],
        beside: "in unit cells from −8 a ball of radius 0.5 about 0.49999949 is listed in cells 7 and 9 and not in 8; a diameter of 2⁻¹⁴ less is enough there, and each run certifies its own grid",
    },
    Claim {
        statement: "The nearest hit with the lowest id stays, in whatever order spheres come; what is not marked is certain",
        evidence: Evidence::Proved,
        lemmas: &[
            "nearest.rule.textbook",
            "nearest.rule.perpendicular",
            "nearest.order.textbook",
            "nearest.order.perpendicular",
            "nearest.tie.textbook",
            "nearest.tie.perpendicular",
            "nearest.twice.textbook",
            "nearest.twice.perpendicular",
            "nearest.rival",
            "nearest.unmarked",
            "nearest.marked",
        ],
        beside: "whatever the arithmetic gives, and whatever other rays of the packet do",
    },
    Claim {
        statement: "The f32 stage of the exact plan decides rightly but for rounding",
        evidence: Evidence::Proved,
        lemmas: &[
            "find.line",
            "find.possible",
            "find.unknown",
            "find.miss",
            "find.miss.unknown",
            "find.root",
            "find.far",
            "find.sharp.outside",
            "find.sharp.inside",
            "find.certain.outside",
            "find.certain.inside",
        ],
        beside: "the shipped formulas over the reals; rounding has its own bound, below",
    },
    Claim {
        statement: "Slices and culling lose no sphere that a ray of the packet hits, but for rounding",
        evidence: Evidence::Proved,
        lemmas: &["visible.slice", "visible.slice.widened", "visible.planes", "visible.planes.drop"],
        beside: "the shipped formulas over the reals; rounding has its margins, below",
    },
    Claim {
        statement: "The f64 stage's bound follows from its steps, for every unit roundoff up to 2⁻⁸ (root) and 2⁻¹² (short way)",
        evidence: Evidence::Proved,
        lemmas: &[
            "rounding.more",
            "rounding.back",
            "rounding.root.1",
            "rounding.root.2.lengths",
            "rounding.root.2.products",
            "rounding.root.2.cauchy",
            "rounding.root.2",
            "rounding.root.3",
            "rounding.root.4",
            "rounding.root.5",
            "rounding.root.6.a",
            "rounding.root.6.b",
            "rounding.root.6.c",
            "rounding.root.6",
            "rounding.root.7.error",
            "rounding.root.7",
            "rounding.root.8.error",
            "rounding.root.8",
            "rounding.root.9.sign",
            "rounding.root.9.line",
            "rounding.root.9.behind",
            "rounding.root.9.outside",
            "rounding.root.9.inside",
            "rounding.root.10.range",
            "rounding.root.10",
            "rounding.root.11",
            "rounding.root.12",
            "rounding.root.13.share",
            "rounding.root.13.upper",
            "rounding.root.13.lower",
            "rounding.root.13.hi",
            "rounding.root.13.lo",
            "rounding.root.14.upper",
            "rounding.root.14.lower",
            "rounding.root.14.hi",
            "rounding.root.14.lo",
            "rounding.short.1",
            "rounding.short.1.q",
            "rounding.short.2",
            "rounding.short.2.difference",
            "rounding.short.3",
            "rounding.short.4",
            "rounding.short.4.b",
            "rounding.short.5",
            "rounding.short.5.apart",
            "rounding.short.6",
            "rounding.short.7.upper",
            "rounding.short.7.lower",
            "rounding.short.7.hi",
            "rounding.short.7.lo",
        ],
        beside: "each inequality of the derivation over the reals, for a cross product, a discriminant and a quotient of any size; how often a term is rounded is read off the source, which all floats of 8 and 16 bits go through",
    },
    Claim {
        statement: "The f32 stage's bound follows from its steps, for every unit roundoff below 1/8",
        evidence: Evidence::Proved,
        lemmas: &[
            "rounding.more",
            "rounding.root.1",
            "rounding.root.2.cauchy",
            "bound.cross",
            "bound.error",
            "bound.error.own",
            "bound.error.rest",
            "bound.error.parts",
            "bound.error.both",
            "bound.map",
            "bound.map.constant",
            "bound.map.scaled",
            "bound.products",
            "bound.triangle",
            "bound.a",
            "bound.kappa",
            "bound.sign.hit",
            "bound.sign.miss",
            "bound.sign.error",
            "bound.sign.larger",
            "bound.sign.last",
            "bound.sign.last.miss",
            "bound.sign.forms",
            "bound.root.foot",
            "bound.root.slopes",
            "bound.root.across",
            "bound.root.inverse",
            "bound.root.term",
            "bound.root.offset",
            "bound.root.sum",
            "bound.root.middle",
            "bound.root.added",
            "bound.root.chord",
            "bound.root.half",
            "bound.root.forms",
            "bound.root.lower",
            "bound.root.upper",
        ],
        beside: "each inequality of the derivation over the reals; how often a term is rounded is read off the source, which all floats of 8 bits go through, and what underflows is bounded by hand",
    },
];

impl Claim {
    /// The command that proves it again: the beginnings of its lemmas' names.
    #[must_use]
    pub fn command(&self) -> String {
        let mut stems: Vec<&str> =
            self.lemmas.iter().map(|name| name.split('.').next().unwrap_or(name)).collect();
        stems.dedup();
        let long = lemmas().iter().any(|lemma| lemma.long && self.lemmas.contains(&lemma.name));
        format!("cargo run --release -- prove {}{}", stems.join(" "), if long { " --long" } else { "" })
    }

    /// What stands beside it in the table: counted, not remembered.
    #[must_use]
    pub fn figure(&self) -> String {
        self.figure_of(self.lemmas)
    }

    /// The same of some of its lemmas: how many they are, and in how many ways an operation of their kernels can be done wrong, all of which are
    /// tried where time is not short (`cgt prove --long`).
    #[must_use]
    pub fn figure_of(&self, names: &[&str]) -> String {
        let lemmas: Vec<Lemma> = lemmas().into_iter().filter(|lemma| names.contains(&lemma.name)).collect();
        let mut kernels: Vec<(&str, usize)> = Vec::new();
        for lemma in lemmas.iter().filter(|lemma| lemma.expected == Expected::Holds) {
            if lemma.kernel != NONE && !kernels.iter().any(|(kernel, _)| *kernel == lemma.kernel) {
                kernels.push((lemma.kernel, lemma.faults().len()));
            }
        }
        let faults: usize = kernels.iter().map(|(_, faults)| faults).sum();
        let (lemmas, whose) = match lemmas.len() {
            1 => ("1 lemma".into(), "its kernel"),
            n => (format!("{n} lemmas"), "their kernels"),
        };
        let wrong = if faults == 0 { String::new() } else { format!(", {faults} ways to do {whose} wrong") };
        format!("{lemmas}{wrong}; {}", self.beside)
    }
}

/// All lemmas, in the order of the claims.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    [
        walk::lemmas(),
        queue::lemmas(),
        cell::lemmas(),
        nearest::lemmas(),
        find::lemmas(),
        visible::lemmas(),
        rounding::lemmas(),
        bound::lemmas(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// x = y.
fn same_i<M: Machine>(m: M, x: M::I, y: M::I) -> M::B {
    m.not(m.or(m.lt_i(x, y), m.lt_i(y, x)))
}

/// x <= y.
fn le_i<M: Machine>(m: M, x: M::I, y: M::I) -> M::B {
    m.not(m.lt_i(y, x))
}

/// x = y as numbers.
fn same<M: Machine>(m: M, x: M::F, y: M::F) -> M::B {
    m.and(m.le(x, y), m.le(y, x))
}

/// If x then y.
fn implies<M: Machine>(m: M, x: M::B, y: M::B) -> M::B {
    m.or(m.not(x), y)
}

/// All of them.
fn all<M: Machine>(m: M, truths: &[M::B]) -> M::B {
    let mut all = truths[0];
    for truth in &truths[1..] {
        all = m.and(all, *truth);
    }
    all
}

/// The first of each pair is not above the second.
fn le_all<M: Machine>(m: M, pairs: &[[M::F; 2]]) -> M::B {
    let truths: Vec<M::B> = pairs.iter().map(|[x, y]| m.le(*x, *y)).collect();
    all(m, &truths)
}
