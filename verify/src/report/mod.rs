//! The report of a run: data and pictures come in; a folder with one self-contained HTML page, the same data as
//! JSON, and the pictures as PNG files goes out, and a short table for the terminal.
//!
//! The order is that of the data: what is said ([`Report`]), the pictures that go with it ([`ScenePictures`]),
//! the words for both, the page, the JSON, the table, and [`write()`], which puts them into a folder. Refused are
//! pictures that do not match the scenes of the report. No module here reads a clock or the machine it runs on.

pub(crate) mod chapter;
mod chart;
mod data;
mod film;
mod folder;
mod html;
mod json;
mod live;
mod names;
mod outside;
mod pictures;
pub(crate) mod text;
pub(crate) mod view;
pub(crate) mod words;

pub use data::{
    Absent, CameraRecord, Claim, Counter, Environment, Evidence, Judge, Report, SCHEMA_VERSION, SceneReport,
    SubjectReport, Vector, overall,
};
pub use folder::{Paths, ReportError, write};
pub use html::{Part, html};
pub use json::json;
pub use live::{Live, LiveError, MAX_MODULE, MAX_SPHERES, Module};
pub use names::sanitized;
pub use pictures::{ScenePictures, TRUTH};
pub use text::{TEXT_WIDTH, text};
pub use words::word;
