//! The calls into Embree: the only unsafe code of this package. Handles come in and go out as types that release
//! themselves; every call that computes runs with flush-to-zero set, as the library's manual asks, and only such a call
//! does ([`flush`]). Errors go out as codes.
#![allow(
    unsafe_code,
    reason = "a C library cannot be called otherwise; nothing outside this folder is unsafe"
)]

pub(super) mod flush;

use super::error::Code;
use super::packet::{Packet, Valid};
use embree4_sys::*;
use std::ffi::CString;
use std::sync::Arc;

/// A device of the library.
#[derive(Debug)]
pub(super) struct RawDevice(RTCDevice);

// SAFETY: the library's manual allows all calls on one device from several threads; errors are kept for each thread.
unsafe impl Send for RawDevice {}
// SAFETY: as above.
unsafe impl Sync for RawDevice {}

impl RawDevice {
    pub(super) fn new(config: &str) -> Result<Self, Code> {
        let config = CString::new(config).map_err(|_| Code::InvalidArgument)?;
        // SAFETY: the text ends in a zero byte and the library copies what it keeps of it.
        let device = unsafe { rtcNewDevice(config.as_ptr()) };
        if device.is_null() { Err(last_error(device)) } else { Ok(Self(device)) }
    }

    pub(super) fn property(&self, property: RTCDeviceProperty) -> isize {
        // SAFETY: the device is alive.
        unsafe { rtcGetDeviceProperty(self.0, property) }
    }

    /// The first error since it was last asked.
    pub(super) fn checked(&self) -> Result<(), Code> {
        match last_error(self.0) {
            Code::None => Ok(()),
            code => Err(code),
        }
    }
}

impl Drop for RawDevice {
    fn drop(&mut self) {
        // SAFETY: the device is alive and this is the only release of the one reference that is held here.
        unsafe { rtcReleaseDevice(self.0) };
    }
}

/// The error of a device, or of this thread if it is null. The bindings have the code as an enum that lacks codes which
/// newer versions return, and such a value would be undefined; so it is taken as the number it is.
fn last_error(device: RTCDevice) -> Code {
    type Typed = unsafe extern "C" fn(RTCDevice) -> RTCError;
    type Plain = unsafe extern "C" fn(RTCDevice) -> u32;
    // SAFETY: the enum is `repr(u32)`, so both types are called alike.
    let plain = unsafe { std::mem::transmute::<Typed, Plain>(rtcGetDeviceError) };
    // SAFETY: the device is alive or null, which the library allows.
    Code::from(unsafe { plain(device) })
}

/// A committed scene of one point geometry, or of none.
#[derive(Debug)]
pub(super) struct RawScene {
    scene: RTCScene,
    geometry: Option<Points>,
    /// Released after the scene.
    device: Arc<RawDevice>,
}

#[derive(Debug)]
struct Points {
    geometry: RTCGeometry,
    buffer: *mut [f32; 4],
    count: usize,
}

// SAFETY: the library's manual allows queries of a committed scene from several threads; what changes it takes `&mut`.
unsafe impl Send for RawScene {}
// SAFETY: as above.
unsafe impl Sync for RawScene {}

impl RawScene {
    /// Centre and radius of each sphere.
    pub(super) fn new(
        device: &Arc<RawDevice>,
        points: impl ExactSizeIterator<Item = [f32; 4]>,
        flags: RTCSceneFlags,
        quality: RTCBuildQuality,
    ) -> Result<Self, (&'static str, Code)> {
        // SAFETY: the device is alive.
        let scene = unsafe { rtcNewScene(device.0) };
        let mut built = Self { scene, geometry: None, device: Arc::clone(device) };
        if scene.is_null() {
            return Err(("rtcNewScene", last_error(device.0)));
        }
        // SAFETY: the scene is alive.
        unsafe {
            rtcSetSceneFlags(scene, flags);
            rtcSetSceneBuildQuality(scene, quality);
        }
        if points.len() > 0 {
            built.attach(points.len())?;
        }
        built.fill(points)?;
        Ok(built)
    }

    fn attach(&mut self, count: usize) -> Result<(), (&'static str, Code)> {
        // SAFETY: the device is alive.
        let geometry = unsafe { rtcNewGeometry(self.device.0, RTCGeometryType::SPHERE_POINT) };
        if geometry.is_null() {
            return Err(("rtcNewGeometry", last_error(self.device.0)));
        }
        let (kind, format, stride) = (RTCBufferType::VERTEX, RTCFormat::FLOAT4, size_of::<[f32; 4]>());
        // SAFETY: the geometry is alive; the library allocates `count` items of `stride` bytes.
        let buffer = unsafe { rtcSetNewGeometryBuffer(geometry, kind, 0, format, stride, count) };
        self.geometry = Some(Points { geometry, buffer: buffer.cast(), count });
        if buffer.is_null() {
            return Err(("rtcSetNewGeometryBuffer", last_error(self.device.0)));
        }
        // SAFETY: scene and geometry are alive; the scene takes a reference of its own.
        unsafe { rtcAttachGeometry(self.scene, geometry) };
        self.device.checked().map_err(|code| ("rtcAttachGeometry", code))
    }

    /// How many spheres there are.
    pub(super) fn count(&self) -> usize {
        self.geometry.as_ref().map_or(0, |points| points.count)
    }

    /// Overwrites all spheres and builds anew. There must be as many as before.
    pub(super) fn fill(
        &mut self,
        points: impl ExactSizeIterator<Item = [f32; 4]>,
    ) -> Result<(), (&'static str, Code)> {
        assert_eq!(points.len(), self.count(), "as many spheres as the scene was made for");
        if let Some(held) = &self.geometry {
            for (at, point) in points.take(held.count).enumerate() {
                // SAFETY: the buffer holds `count` items and is aligned to 16 bytes; no query runs, since this takes `&mut`.
                unsafe { held.buffer.add(at).write(point) };
            }
            // SAFETY: the geometry is alive.
            unsafe {
                rtcUpdateGeometryBuffer(held.geometry, RTCBufferType::VERTEX, 0);
                rtcCommitGeometry(held.geometry);
            }
        }
        // SAFETY: `rtcCommitScene` takes a scene, and this one is alive.
        unsafe {
            flush::call(rtcCommitScene as *const (), [self.scene.cast(); 4].map(<*mut ()>::cast_const));
        };
        self.device.checked().map_err(|code| ("rtcCommitScene", code))
    }

    /// Traces the valid lanes of a packet.
    pub(super) fn intersect<const W: usize, const S: usize>(
        &self,
        valid: &Valid<W>,
        packet: &mut Packet<W, S>,
    ) {
        let valid = std::ptr::from_ref(valid).cast::<()>();
        let (function, arguments, _) = self.question(valid, packet, std::ptr::null());
        // SAFETY: the arguments are those of the function, as `question` says; null for its own means the defaults. The packet
        // is borrowed mutably for as long as the call takes.
        unsafe { flush::call(function, arguments) };
    }

    /// Traces the valid lanes of each packet, all of them with flush-to-zero set once. The packets of a batch look much the
    /// same way if they are `coherent`.
    pub(super) fn intersect_all<const W: usize, const S: usize>(
        &self,
        valid: &[Valid<W>],
        packets: &mut [Packet<W, S>],
        coherent: bool,
    ) {
        assert_eq!(valid.len(), packets.len(), "a mask for each packet");
        let Some(first) = packets.first_mut() else { return };
        let arguments = Arguments::new(coherent);
        let masks = valid.as_ptr().cast::<()>();
        let (function, firsts, steps) = self.question(masks, first, (&raw const arguments).cast());
        // SAFETY: the arguments are those of the function for the first packet, as `question` says, and a step leads from a
        // packet to the next and from its mask to the next, of which there are as many as packets. The packets are borrowed
        // mutably, and `arguments` lives, for as long as the calls take.
        unsafe { flush::call_all(function, firsts, steps, packets.len()) };
    }

    /// The function that takes packets of this width; its arguments: a committed scene, a mask and a packet of its width, both
    /// aligned to 64 bytes and the packet laid out as its headers say (asserted in `packet`), with guard words behind what
    /// newer versions write, and the arguments of the query; and how far it is from a packet's to the next one's.
    fn question<const W: usize, const S: usize>(
        &self,
        mask: *const (),
        packet: &mut Packet<W, S>,
        query: *const (),
    ) -> (*const (), [*const (); 4], [usize; 4]) {
        let scene = self.scene.cast::<()>().cast_const();
        let packet = std::ptr::from_mut(packet).cast::<()>().cast_const();
        let (masks, packets) = (size_of::<Valid<W>>(), size_of::<Packet<W, S>>());
        let wide = ([mask, scene, packet, query], [masks, 0, packets, 0]);
        let (function, (arguments, steps)) = match W {
            1 => (rtcIntersect1 as *const (), ([scene, packet, query, query], [0, packets, 0, 0])),
            4 => (rtcIntersect4 as *const (), wide),
            8 => (rtcIntersect8 as *const (), wide),
            16 => (rtcIntersect16 as *const (), wide),
            _ => unreachable!("packets are of 1, 4, 8 and 16 rays"),
        };
        (function, arguments, steps)
    }
}

/// What a query is told of its rays: as the library's `rtcInitIntersectArguments` sets it, with zeros behind for what newer
/// versions may read.
#[repr(C)]
struct Arguments {
    known: RTCIntersectArguments,
    later: [u64; 8],
}

impl Arguments {
    fn new(coherent: bool) -> Self {
        let flags = if coherent { RTCRayQueryFlags::COHERENT } else { RTCRayQueryFlags::INCOHERENT };
        let known = RTCIntersectArguments {
            flags,
            feature_mask: RTCFeatureFlags::RTC_FEATURE_FLAG_ALL,
            context: std::ptr::null_mut(),
            filter: None,
            intersect: None,
        };
        Self { known, later: [0; 8] }
    }
}

impl Drop for RawScene {
    fn drop(&mut self) {
        if let Some(points) = &self.geometry {
            // SAFETY: the geometry is alive and this releases the one reference that is held here.
            unsafe { rtcReleaseGeometry(points.geometry) };
        }
        if !self.scene.is_null() {
            // SAFETY: as for the geometry.
            unsafe { rtcReleaseScene(self.scene) };
        }
    }
}
