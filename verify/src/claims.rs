//! What the suite claims as a whole, each with its kind of evidence: the table in README and report. A test holds
//! README to it. What a single run shows stands in that run's report, not here.

use crate::report::{Claim, Evidence};

/// Statement, kind, figure, command.
type Row = (&'static str, Evidence, &'static str, &'static str);

const ROWS: [Row; 9] = [
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
        "The grid tracer's picture is the naive one of the same form, bit for bit",
        Evidence::Sampled,
        "all bundled and generated scenes, and directed cameras",
        "cargo test --test grid",
    ),
    ("The optimized picture equals the exact one, bit for bit", Evidence::NotShown, "0", "a later version"),
    ("The reference agrees with Embree outside the silhouettes", Evidence::NotShown, "0", "a later version"),
    ("Faster than Embree", Evidence::NotShown, "0", "a later version"),
    (
        "The paper's flattened loop visits the cells of its nested loops",
        Evidence::NotShown,
        "0",
        "a later version",
    ),
    ("The paper's voxelization has no false negatives", Evidence::NotShown, "0", "a later version"),
    (
        "The paper's scenes fit and run in real time on its machine",
        Evidence::NotShown,
        "0",
        "a later version",
    ),
];

/// All claims, in the order of the table.
#[must_use]
pub fn claims() -> Vec<Claim> {
    let claim = |(statement, evidence, figure, how): Row| Claim {
        statement: statement.into(),
        evidence,
        figure: figure.into(),
        how: how.into(),
    };
    ROWS.into_iter().map(claim).collect()
}

/// The table in Markdown, as it stands in the README.
#[must_use]
pub fn markdown() -> String {
    let mut table = String::from("| claim | evidence | figure | how to see it |\n|---|---|---|---|\n");
    for (statement, evidence, figure, how) in ROWS {
        let how = if how.starts_with("cargo") { format!("`{how}`") } else { how.into() };
        table += &format!("| {statement} | {} | {figure} | {how} |\n", evidence.word());
    }
    table
}
