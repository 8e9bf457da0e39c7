//! A scene to be looked at while it plays: camera, time, and what of the tracer is laid over its picture.
//!
//! In: an animation, a camera, and what keys, mouse and clock say ([`command`]). Out: a [`canvas`] to be shown, and where the time went
//! ([`clock`]). Without overlays the canvas is the tracer's picture, bit for bit. All of it works without a window: a [`window`] or a
//! [`terminal`] shows what a [`viewer::Viewer`] draws and passes on what is pressed.
//!
//! [`player`] says which frame, [`orbit`] from where, [`state`] by which plan; [`tally`] looks into a frame for the overlays that need it, and
//! [`overlay`] draws them, with words by [`text`].

pub mod canvas;
pub mod clock;
pub mod command;
pub mod orbit;
pub mod overlay;
pub mod player;
pub mod state;
pub mod tally;
pub mod terminal;
pub mod text;
pub mod viewer;
pub mod window;
