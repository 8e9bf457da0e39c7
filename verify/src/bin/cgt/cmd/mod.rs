//! The subcommands.

pub(crate) mod bench;
pub(crate) mod claims;
pub(crate) mod figures;
mod files;
pub(crate) mod prove;
pub(crate) mod render;
pub(crate) mod replay;
pub(crate) mod scenes;
pub(crate) mod spu;
pub(crate) mod verify;
