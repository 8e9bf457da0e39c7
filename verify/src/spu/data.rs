//! All of a run of `cgt spu` as plain data, whose JSON these types are. A changed field means a new [`SCHEMA_VERSION`].

use super::curves::Curve;
use super::host::OnHost;
use super::survey::Survey;
use crate::report::Environment;
use serde::Serialize;

/// Version of the layout of the JSON file.
pub const SCHEMA_VERSION: u32 = 2;

/// All of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// [`SCHEMA_VERSION`]; first, so that a reader can stop here.
    pub schema_version: u32,
    /// What this file is: `spu`.
    pub kind: &'static str,
    /// Where, when and how the run was made.
    pub environment: Environment,
    /// Scene by scene.
    pub surveys: Vec<Survey>,
    /// How figures grow, if it was asked.
    pub curves: Vec<Curve>,
    /// Counts of this computer, if they were asked for.
    pub host: Option<OnHost>,
}
