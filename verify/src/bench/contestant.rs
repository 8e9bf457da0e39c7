//! What is timed: anything that takes a frame's spheres anew, builds, traces every pixel, and leaves its answers in
//! memory that it keeps.
//!
//! In: a scene and a camera. Out: a [`Frame`], its answers to be looked at. What a contestant promises of
//! its answers ([`Oath`]) is checked before it is timed.

use crate::judge::band::{Band, band};
use crate::subject::{Promise, Rounding, SubjectError};
use contract::{Camera, Scene, Sphere};
use reference::Ray;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// The part a contestant plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// The tracer under test.
    Subject,
    /// The same kernel, told beforehand which spheres each block shows.
    Limit,
    /// The same tracer with a plan picked by hand.
    Picked,
    /// The reference, in one of its arithmetics.
    Naive,
    /// Embree, in one of its ways.
    Embree,
    /// A tracer of other people.
    Peer,
}

/// What a contestant's answers are held to.
#[derive(Clone, Copy)]
pub enum Oath {
    /// The truth, bit for bit: id, t and colour.
    Exact,
    /// What rounding can make of it, ray by sphere; `None` where nothing is stated.
    Within(fn(&Ray, &Sphere) -> Option<Band>),
}

impl Oath {
    /// Of a rounding form.
    #[must_use]
    pub fn rounded(rounding: Rounding) -> Self {
        Self::Within(match rounding {
            Rounding::TextbookF64 => |ray, sphere| band(Rounding::TextbookF64, ray, sphere),
            Rounding::TextbookF32 => |ray, sphere| band(Rounding::TextbookF32, ray, sphere),
            Rounding::PerpendicularF32 => |ray, sphere| band(Rounding::PerpendicularF32, ray, sphere),
            Rounding::TextbookSpu => |ray, sphere| band(Rounding::TextbookSpu, ray, sphere),
            Rounding::PerpendicularSpu => |ray, sphere| band(Rounding::PerpendicularSpu, ray, sphere),
        })
    }
}

impl From<Promise> for Oath {
    /// Of a promise of the naive picture the rounding alone is asked here; `cgt verify` asks for the rest.
    fn from(promise: Promise) -> Self {
        match promise {
            Promise::Exact => Self::Exact,
            Promise::Rounded(rounding) | Promise::EqualToNaive(rounding) => Self::rounded(rounding),
        }
    }
}

/// What a frame left, pixel (x, y) at index `y * width + x`.
#[derive(Clone, Copy, Debug)]
pub struct Layers<'a> {
    /// Spheres seen, or [`MISS`](contract::MISS).
    pub ids: &'a [u32],
    /// Ray parameters, +∞ for a miss.
    pub t: &'a [f32],
    /// Colours, of those who paint.
    pub rgba: Option<&'a [[u8; 4]]>,
}

/// A finished frame.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// How long it was from the beginning until all stood that rays share.
    pub build: Duration,
    /// How long all of it was, where the call takes longer by what is not the contestant's.
    pub took: Option<Duration>,
    /// What it left, in memory that the next frame will use again.
    pub layers: Layers<'a>,
}

/// A tracer to be timed, with its camera and threads chosen.
pub trait Contestant {
    /// Short and unique.
    fn name(&self) -> &str;

    /// One sentence: what it is, and what a frame of it does.
    fn description(&self) -> String;

    /// Its part.
    fn kind(&self) -> Kind;

    /// What it is held to.
    fn oath(&self) -> Oath;

    /// Takes a frame's spheres, builds and traces.
    ///
    /// # Errors
    /// Whatever keeps it from finishing.
    fn frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Frame<'_>, SubjectError>;
}
