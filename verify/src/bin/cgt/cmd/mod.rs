//! The subcommands.

pub(crate) mod bench;
pub(crate) mod render;
pub(crate) mod scenes;
pub(crate) mod spu;
pub(crate) mod verify;
