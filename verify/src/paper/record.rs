//! What a run of `cgt claims` found, as plain data: its JSON file, and the table in README, which is made of the file that is part of the
//! repository. A test computes again what is quickly computed, a long run all of it.

use super::{PaperClaim, Standing};
use crate::report::Environment;
use serde::{Deserialize, Serialize};

/// Version of the layout of the JSON file.
pub const SCHEMA_VERSION: u32 = 1;

/// Where the file of the repository lies in it.
pub const FILE: &str = "tests/data/paper-claims.json";

/// Scenes on which claims are judged.
pub const SCENES: [&str; 8] = [
    "1hvr",
    "adk",
    "sphereflake:3",
    "sphereflake:4",
    "uniform:500:1",
    "uniform:1000:1",
    "uniform:2000:1",
    "uniform:4000:1",
];

/// All of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// [`SCHEMA_VERSION`]; first, so that a reader can stop here.
    pub schema_version: u32,
    /// What this file is: `claims`.
    pub kind: String,
    /// Where, when and how the run was made.
    pub environment: Environment,
    /// Seed of what is random.
    pub seed: u64,
    /// Pixels of a row, and rows.
    pub size: [u32; 2],
    /// One block of so many was traced.
    pub sample: u32,
    /// The scenes that were looked at.
    pub scenes: Vec<String>,
    /// The claims, in the order of the paper.
    pub claims: Vec<PaperClaim>,
}

impl Record {
    /// A run from its file; README shows that of [`FILE`].
    ///
    /// # Errors
    /// If the file has another layout than this program's.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }

    /// How many claims have a standing.
    #[must_use]
    pub fn count(&self, standing: Standing) -> usize {
        self.claims.iter().filter(|claim| claim.verdict == standing).count()
    }

    /// How many claims have which verdict, and the table, folded, in Markdown, as both stand in README.
    #[must_use]
    pub fn markdown(&self) -> String {
        let tally: Vec<String> =
            Standing::ALL.map(|standing| format!("{} {}", self.count(standing), standing.word())).into();
        let mut text = format!(
            "Of {} claims {}.\n\n<details><summary>All of them</summary>\n\n\
             | the paper claims | verdict | evidence | figure | smallest counterexample | how to see it |\n|---|---|---|---|---|---|\n",
            self.claims.len(),
            tally.join(", ")
        );
        for claim in &self.claims {
            let PaperClaim { statement, verdict, evidence, figure, counterexample, how, .. } = claim;
            let against = counterexample.as_deref().unwrap_or("–");
            let how = if how.starts_with("cargo") { format!("`{how}`") } else { how.clone() };
            text += &format!(
                "| {statement} | {} | {} | {figure} | {against} | {how} |\n",
                verdict.word(),
                evidence.word()
            );
        }
        text + "\n</details>\n"
    }
}
