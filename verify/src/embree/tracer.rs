//! A scene in Embree's hands, and the questions that can be put to it.
//!
//! In: a checked scene; rays, or a camera whose rays are asked block by block. Out: for each ray its id and t, [`MISS`]
//! and +∞ if Embree sees nothing. After each packet the guard words are looked at, after each batch the subnormal canary.

use super::device::Device;
use super::error::EmbreeError;
use super::fault::Fault;
use super::ffi::{RawScene, flush};
use super::packet::{GROWTH, Packet, Valid};
use contract::{Camera, MISS, Scene};
use embree4_sys::{RTCBuildQuality, RTCSceneFlags};
use reference::Ray;
use std::fmt;

/// How many rays are asked at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Width {
    One,
    Four,
    Eight,
    Sixteen,
}

impl Width {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::One, Self::Four, Self::Eight, Self::Sixteen];

    /// The number of rays.
    #[must_use]
    pub fn lanes(self) -> usize {
        let [width, height] = self.block();
        (width * height) as usize
    }

    /// The block of pixels that a packet is.
    pub(super) fn block(self) -> [u32; 2] {
        match self {
            Self::One => [1, 1],
            Self::Four => [2, 2],
            Self::Eight => [4, 2],
            Self::Sixteen => [4, 4],
        }
    }
}

impl fmt::Display for Width {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.lanes())
    }
}

/// How Embree is to build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Build {
    /// Boxes are crossed so that none is missed by rounding: for judging.
    Robust,
    /// What Embree does if it is told nothing.
    Plain,
    /// As plain, and fast to build again for the next frame.
    Dynamic,
}

impl Build {
    pub(super) fn flags(self) -> (RTCSceneFlags, RTCBuildQuality) {
        match self {
            Self::Robust => (RTCSceneFlags::ROBUST, RTCBuildQuality::MEDIUM),
            Self::Plain => (RTCSceneFlags::NONE, RTCBuildQuality::MEDIUM),
            Self::Dynamic => (RTCSceneFlags::DYNAMIC, RTCBuildQuality::LOW),
        }
    }
}

/// A scene that Embree has built.
#[derive(Debug)]
pub struct Tracer {
    raw: RawScene,
    device: Device,
    build: Build,
    fault: Fault,
}

impl Tracer {
    /// Hands a scene over and has it built.
    ///
    /// # Errors
    /// [`EmbreeError::Call`] if the library refuses.
    pub fn new(device: &Device, scene: &Scene, build: Build) -> Result<Self, EmbreeError> {
        Self::with_fault(device, scene, build, Fault::None)
    }

    /// The same with a fault planted.
    ///
    /// # Errors
    /// As [`Tracer::new`].
    pub fn with_fault(
        device: &Device,
        scene: &Scene,
        build: Build,
        fault: Fault,
    ) -> Result<Self, EmbreeError> {
        let raw = Self::built(device, &points(scene, fault), build)?;
        Ok(Self { raw, device: device.clone(), build, fault })
    }

    fn built(device: &Device, points: &[[f32; 4]], build: Build) -> Result<RawScene, EmbreeError> {
        let (flags, quality) = build.flags();
        checked(RawScene::new(&device.raw, points.iter().copied(), flags, quality))
    }

    /// Hands over the next frame's spheres and has them built.
    ///
    /// # Errors
    /// As [`Tracer::new`].
    pub fn update(&mut self, scene: &Scene) -> Result<(), EmbreeError> {
        let points = points(scene, self.fault);
        if points.len() == self.raw.count() {
            checked(self.raw.fill(points.iter().copied()))
        } else {
            self.raw = Self::built(&self.device, &points, self.build)?;
            Ok(())
        }
    }

    /// Traces rays in the order given, so many at once; the last packet is filled up with lanes that are not valid.
    ///
    /// # Errors
    /// [`EmbreeError::Overrun`] or [`EmbreeError::FlushStuck`] if the library broke what it was lent.
    ///
    /// # Panics
    /// If there are not as many places for ids or t as rays.
    pub fn trace(
        &self,
        width: Width,
        rays: &[Ray],
        ids: &mut [u32],
        t: &mut [f32],
    ) -> Result<(), EmbreeError> {
        assert_eq!([ids.len(), t.len()], [rays.len(); 2], "a place for each ray");
        let lists = rays.chunks(width.lanes()).zip(0..).map(|(rays, k)| (rays, k * width.lanes()));
        self.ask(
            width,
            lists,
            |(rays, first), lane| Some((*rays.get(lane)?, first + lane)),
            |at, hit| {
                (ids[at], t[at]) = hit;
            },
        )
    }

    /// Traces all rays of a camera, a block of pixels at once. Pixel (x, y) stands at index `y * width + x`.
    ///
    /// # Errors
    /// As [`Tracer::trace`].
    ///
    /// # Panics
    /// If there are not as many places for ids or t as pixels.
    pub fn render(
        &self,
        camera: &Camera,
        width: Width,
        ids: &mut [u32],
        t: &mut [f32],
    ) -> Result<(), EmbreeError> {
        let (size, [w, h]) = (camera.size(), width.block());
        assert_eq!([ids.len(), t.len()], [size.pixels(); 2], "a place for each pixel");
        let columns = move || (0..size.width()).step_by(w as usize);
        let blocks = (0..size.height()).step_by(h as usize).flat_map(|y| columns().map(move |x| [x, y]));
        let pixel = |[x, y]: [u32; 2], lane: usize| {
            let lane = u32::try_from(lane).expect("at most 16");
            let (x, y) = (x + lane % w, y + lane / w);
            let inside = x < size.width() && y < size.height();
            inside.then(|| (Ray::of_pixel(camera, x, y), y as usize * size.width() as usize + x as usize))
        };
        self.ask(width, blocks, pixel, |at, hit| (ids[at], t[at]) = hit)
    }

    /// Asks packet by packet. `ray` gives a packet's ray of a lane and its place, `keep` takes what was found.
    fn ask<P: Copy>(
        &self,
        width: Width,
        packets: impl Iterator<Item = P>,
        ray: impl Fn(P, usize) -> Option<(Ray, usize)>,
        keep: impl FnMut(usize, (u32, f32)),
    ) -> Result<(), EmbreeError> {
        match (width, self.fault) {
            (Width::One, Fault::Shrunk) => self.ask_lanes::<P, 1, 0>(width, packets, ray, keep),
            (Width::Four, Fault::Shrunk) => self.ask_lanes::<P, 4, 0>(width, packets, ray, keep),
            (Width::Eight, Fault::Shrunk) => self.ask_lanes::<P, 8, 0>(width, packets, ray, keep),
            (Width::Sixteen, Fault::Shrunk) => self.ask_lanes::<P, 16, 0>(width, packets, ray, keep),
            (Width::One, _) => self.ask_lanes::<P, 1, GROWTH>(width, packets, ray, keep),
            (Width::Four, _) => self.ask_lanes::<P, 4, GROWTH>(width, packets, ray, keep),
            (Width::Eight, _) => self.ask_lanes::<P, 8, GROWTH>(width, packets, ray, keep),
            (Width::Sixteen, _) => self.ask_lanes::<P, 16, GROWTH>(width, packets, ray, keep),
        }
    }

    fn ask_lanes<P: Copy, const W: usize, const S: usize>(
        &self,
        width: Width,
        packets: impl Iterator<Item = P>,
        ray: impl Fn(P, usize) -> Option<(Ray, usize)>,
        mut keep: impl FnMut(usize, (u32, f32)),
    ) -> Result<(), EmbreeError> {
        let (mut packet, mut valid) = (Packet::<W, S>::new(), Valid([0; W]));
        for block in packets {
            let mut places = [None; W];
            for (lane, (place, valid)) in places.iter_mut().zip(&mut valid.0).enumerate() {
                *valid = 0;
                if let Some((ray, at)) = ray(block, lane) {
                    (*place, *valid) = (Some(at), -1);
                    packet.set(lane, &ray, self.fault);
                }
            }
            self.raw.intersect(&valid, &mut packet);
            packet.check(width)?;
            for (lane, place) in places.into_iter().enumerate() {
                if let Some(place) = place {
                    keep(place, packet.hit(lane).unwrap_or((MISS, f32::INFINITY)));
                }
            }
        }
        if flush::subnormals_count() { Ok(()) } else { Err(EmbreeError::FlushStuck) }
    }

    /// Whether the field that 4.3 added is written to when a ray hits.
    pub(super) fn writes_growth(&self, ray: &Ray) -> bool {
        let (mut packet, valid) = (Packet::<16, GROWTH>::new(), Valid([-1; 16]));
        (0..16).for_each(|lane| packet.set(lane, ray, Fault::None));
        self.raw.intersect(&valid, &mut packet);
        (0..16).all(|lane| packet.hit(lane).is_some() && packet.grew(lane))
    }
}

/// Centre and radius of each sphere.
fn points(scene: &Scene, fault: Fault) -> Vec<[f32; 4]> {
    let point = |s: &contract::Sphere| [s.center[0], s.center[1], s.center[2], s.radius];
    let mut points: Vec<_> = scene.spheres().iter().map(point).collect();
    if fault == Fault::SwappedIds && points.len() > 1 {
        points.swap(0, 1);
    }
    points
}

pub(super) fn checked<T>(outcome: Result<T, (&'static str, super::Code)>) -> Result<T, EmbreeError> {
    outcome.map_err(|(call, code)| EmbreeError::Call { call, code })
}
