//! What each choice of a plan buys: one concern changed at a time, in time, in cycles of the paper's processor, and in pixels.
//!
//! In: a scene and a camera. Out: [`SceneAblation`], and over scenes an [`Ablation`]. Base and variants are timed in interleaved rounds of one
//! run, as in a [chart](crate::chart), so that their ratios mean something. The plan that is chosen from the scene alone
//! ([`Plan::for_scene`](optimized::Plan::for_scene)) stands among plans picked by hand. What is changed is in [`variants`](mod@variants). Of the model of the paper's machine each feature
//! is left out in turn ([`model`](mod@model)).

pub mod data;
pub mod measure;
pub mod model;
pub mod page;
pub mod text;
pub mod variants;

pub use data::{Ablation, Row, SCHEMA_VERSION, SceneAblation};
pub use measure::{ablate, told};
