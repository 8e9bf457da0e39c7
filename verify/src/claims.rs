//! What the suite claims as a whole, each with its kind of evidence: the table in README and report. A test holds
//! README to it. What a single run shows stands in that run's report, not here; what the paper claims, in [`crate::paper`].

use crate::prove::claims::CLAIMS;
use crate::report::{Claim, Evidence};

/// Statement, kind, figure, command.
type Row = (&'static str, Evidence, &'static str, &'static str);

const ROWS: [Row; 16] = [
    (
        "The exact reference decides as integers without a filter do",
        Evidence::Sampled,
        "100,000 directed and random rays of 14 kinds in every test run",
        "cargo test --test exact",
    ),
    (
        "The f32 forms fail far away as was measured before this project",
        Evidence::Measured,
        "1,000,000 rays at each of 4 distances",
        "cargo test --test forms",
    ),
    (
        "A plan's picture is the naive one of the same arithmetic, bit for bit",
        Evidence::Sampled,
        "over 500 pictures; 192 combinations of choices at every SIMD level with 1 to 8 workers",
        "cargo test --test grid",
    ),
    (
        "What is hit is visited and kept, what overlaps a cell is listed there",
        Evidence::Sampled,
        "over 1,000,000 points of rays on cell planes and 200,000 hits, decided in integers",
        "cargo test --test visible",
    ),
    (
        "Kernels are inlined into code of the chosen SIMD level, and the flattened step has no jump",
        Evidence::Measured,
        "the machine code of the test itself",
        "cargo test --test machine_code",
    ),
    (
        "The safe plan is over 10 times as fast as the naive tracer on the same threads",
        Evidence::Measured,
        "136 times on 1HVR at 1280x720, one thread, AVX-512, rebuild included",
        "cargo bench --bench frames",
    ),
    (
        "The fast plan's picture is the exact one, bit for bit",
        Evidence::Sampled,
        "1,000,000 directed rays of 14 kinds, over 500 pictures, 10 to 10,000,000 radii away, at scales of 1e-30 to 1e30",
        "cargo test --test certified",
    ),
    (
        "The error bound of its f32 stage holds",
        Evidence::Exhausted,
        "all 149 million rays and balls of one radius in a domain of 8-bit floats, rounded and truncated; of half of it 2 % of \
         adverse f32 inputs are a counterexample",
        "cargo test --test bound",
    ),
    (
        "What its f64 stage says of hit, miss, t and its rounding is true",
        Evidence::Exhausted,
        "floats of 8 and 16 bits, 17,465,280 inputs of the root and 14,024,640 of the short way; an eighth and a 32nd of the bound are wrong",
        "cargo test --test rounding",
    ),
    (
        "Margins of slices, culling, outlines and tiles cover all that rounding does",
        Evidence::Exhausted,
        "floats of 4 to 16 bits, all inputs of fourteen domains, nearest and truncating; an eighth of them does not for slices and tiles, \
         a 16th for culling, a 32nd for outlines",
        "cargo test --test margins",
    ),
    (
        "Every f32 lies in the cell whose planes hold it, and cells are in its order",
        Evidence::Exhausted,
        "all 2^32 f32 in the long run, 33 axes of scenes and directed ones",
        "cargo test --test cells",
    ),
    (
        "Whatever is hit is visible: its cell is visited and lists it, and culling keeps it",
        Evidence::Exhausted,
        "seven steps: four proved, the rounding of two exhausted on small floats, and by hand how far a reported point lies from the surface, \
         that rounding stops at a neighbour, and the walk's early end",
        "cargo run --release -- prove walk queue cell visible",
    ),
    (
        "Certainty costs at most 1.4 times the perpendicular form in f32",
        Evidence::Measured,
        "1.3 times, geometric mean of four scenes at 1280x720, one thread, AVX-512, rebuild included",
        "cargo bench --bench frames",
    ),
    (
        "The reference agrees with Embree outside the silhouettes",
        Evidence::Sampled,
        "over 350 pictures at five instruction sets and four widths, 410,000 rays at each of 4 distances, 30,000 directed",
        "tests/run",
    ),
    (
        "The exact picture comes faster than Embree's, rebuild included",
        Evidence::Measured,
        "12 to 17 times on six scenes, one thread, AVX-512, 1280x720",
        "tests/with-embree cargo run --release --features embree,peers -- bench --threads 1",
    ),
    (
        "The optimized arithmetic of the SPU is the naive one, operation by operation and picture by picture",
        Evidence::Sampled,
        "all 2^32 patterns of one operand and 100,000,000 directed pairs in the long run, 48 scenes by four voxelizers at five levels",
        "cargo test --test spu_machine",
    ),
];

/// All claims, in the order of the table: first those of [`crate::prove`], counted from the lemmas themselves.
#[must_use]
pub fn claims() -> Vec<Claim> {
    let claim = |(statement, evidence, figure, how): Row| Claim {
        statement: statement.into(),
        evidence,
        figure: figure.into(),
        how: how.into(),
    };
    let proved = CLAIMS.iter().map(|claim| Claim {
        statement: claim.statement.into(),
        evidence: claim.evidence,
        figure: claim.figure(),
        how: claim.command(),
    });
    proved.chain(ROWS.into_iter().map(claim)).collect()
}

/// The table in Markdown, as it stands in the README.
#[must_use]
pub fn markdown() -> String {
    let mut table = String::from("| claim | evidence | figure | how to see it |\n|---|---|---|---|\n");
    for Claim { statement, evidence, figure, how } in claims() {
        let how =
            if how.starts_with("cargo") || how.starts_with("tests/") { format!("`{how}`") } else { how };
        table += &format!("| {statement} | {} | {figure} | {how} |\n", evidence.word());
    }
    table
}
