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
        points: &[[f32; 4]],
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
        if !points.is_empty() {
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
    pub(super) fn fill(&mut self, points: &[[f32; 4]]) -> Result<(), (&'static str, Code)> {
        assert_eq!(points.len(), self.count(), "as many spheres as the scene was made for");
        if let Some(held) = &self.geometry {
            // SAFETY: the buffer holds `count` items, as asserted, is aligned to 16 bytes, and overlaps nothing of Rust's;
            // no query runs, since this takes `&mut`.
            unsafe {
                std::ptr::copy_nonoverlapping(points.as_ptr(), held.buffer, held.count);
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
        let (mask, scene) = (std::ptr::from_ref(valid).cast::<()>(), self.scene.cast::<()>().cast_const());
        let packet = std::ptr::from_mut(packet).cast::<()>().cast_const();
        let no_arguments = std::ptr::null::<()>();
        let (function, arguments) = match W {
            1 => (rtcIntersect1 as *const (), [scene, packet, no_arguments, no_arguments]),
            4 => (rtcIntersect4 as *const (), [mask, scene, packet, no_arguments]),
            8 => (rtcIntersect8 as *const (), [mask, scene, packet, no_arguments]),
            16 => (rtcIntersect16 as *const (), [mask, scene, packet, no_arguments]),
            _ => unreachable!("packets are of 1, 4, 8 and 16 rays"),
        };
        // SAFETY: the arguments are those of the function: a committed scene, a mask and a packet of its width, aligned to
        // 64 bytes and laid out as its headers say (asserted in `packet`), with guard words behind what newer versions
        // write; null for the arguments means the defaults. The packet is borrowed mutably for as long as the call takes.
        unsafe { flush::call(function, arguments) };
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
