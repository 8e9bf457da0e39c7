//! What fuzzers run. Any bytes come in; each body makes an input of them, has shipped code work on it, and panics with a sentence that
//! names what disagreed, in decimal and in bits. Out goes how many answers were judged: none if the bytes made no valid input, which
//! is then refused by a typed error.
//!
//! The bodies stand here, so that the same code is run by libFuzzer (`fuzz/run`) and, on the inputs in `fuzz/corpus`, by
//! `tests/fuzz.rs`. How bytes become numbers is told in `bytes`.

mod bytes;
mod certified;
mod filter;
mod mutate;
mod plan;
mod queue;
mod readers;
mod scene;
mod spu;
mod view;
mod visible;
mod voxelize;
mod walk;

pub use certified::certified;
pub use filter::filter;
pub use mutate::mutated;
pub use queue::{Push, queue};
pub use readers::{case, dcd, json, lammps, nff, pdb, pov, xtc, xyz};
pub use scene::scene;
pub use spu::spu;
pub use visible::visible;
pub use voxelize::voxelize;
pub use walk::walk;

/// A body with its name.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Of its file in `fuzz/targets` and its folder in `fuzz/corpus`.
    pub name: &'static str,
    /// What it holds against what.
    pub what: &'static str,
    /// Any bytes in, answers judged out.
    pub run: fn(&[u8]) -> u64,
}

/// All bodies, by name.
pub const TARGETS: [Target; 17] = [
    Target {
        name: "case",
        what: "a case is read or refused, and comes back from what is written",
        run: case,
    },
    Target {
        name: "certified",
        what: "sixteen rays and a few spheres, what f32, f64 and integers say of them against the exact reference",
        run: certified,
    },
    Target { name: "dcd", what: "a DCD trajectory is read or refused", run: dcd },
    Target { name: "filter", what: "the filtered exact tracer against the unfiltered one", run: filter },
    Target { name: "json", what: "JSON is read or refused, and comes back from what is written", run: json },
    Target { name: "lammps", what: "a LAMMPS dump is read or refused", run: lammps },
    Target { name: "nff", what: "an NFF file is read or refused", run: nff },
    Target { name: "pdb", what: "a PDB file is read or refused", run: pdb },
    Target { name: "pov", what: "a POV-Ray list of spheres is read or refused", run: pov },
    Target { name: "queue", what: "pushes and overflows against plain lists", run: queue },
    Target { name: "scene", what: "a picture by any plan against the reference's", run: scene },
    Target { name: "spu", what: "the SPU's operations against the reference's", run: spu },
    Target { name: "visible", what: "what is hit is visited and kept, by exact integers", run: visible },
    Target {
        name: "voxelize",
        what: "cells list what they hold a point of, by exact integers",
        run: voxelize,
    },
    Target { name: "walk", what: "the three loops against all cells in order", run: walk },
    Target { name: "xtc", what: "an XTC trajectory is read or refused", run: xtc },
    Target { name: "xyz", what: "an XYZ file is read or refused", run: xyz },
];

/// A number in decimal and in bits.
fn bits(x: f32) -> String {
    format!("{x:?} (0x{:08x})", x.to_bits())
}

/// Three of them.
fn vector(v: [f32; 3]) -> String {
    format!("[{}]", v.map(bits).join(", "))
}

/// Spheres by id, a line each.
fn listed(spheres: &[contract::Sphere]) -> String {
    let line = |(id, s): (usize, &contract::Sphere)| {
        format!("\n  sphere {id}: centre {}, radius {}", vector(s.center), bits(s.radius))
    };
    spheres.iter().enumerate().map(line).collect()
}
