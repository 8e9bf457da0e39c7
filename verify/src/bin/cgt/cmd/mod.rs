//! The subcommands.

pub(crate) mod ablate;
pub(crate) mod bench;
pub(crate) mod chart;
mod files;
pub(crate) mod prove;
pub(crate) mod render;
pub(crate) mod replay;
pub(crate) mod report;
pub(crate) mod scenes;
pub(crate) mod spu;
pub(crate) mod stability;
pub(crate) mod verify;
