//! What is asked of the library before it is believed: spheres that are plainly there must come back from each width,
//! each ray with its own; the field that 4.3 added must be written to from that version on, as is expected; and
//! flush-to-zero must be set within a call and not after it.

use super::device::Device;
use super::error::EmbreeError;
use super::fault::Fault;
use super::ffi::flush;
use super::tracer::{Build, Tracer, Width};
use contract::{DEFAULT_LIGHT, MISS, Scene, Sphere};
use reference::Ray;

/// More than a packet, so that the second one has lanes that are not valid.
const RAYS: u8 = 19;
/// Rays from this one on see nothing.
const SEEING: u8 = 17;

/// Ray k runs along z beside ray k − 1 and meets the sphere of id k at t = 9 + k, a second one behind it; the last ones
/// meet nothing. All of it is exact but for Embree's estimate of 1/1.
pub(super) fn check(device: &Device, fault: Fault) -> Result<(), EmbreeError> {
    if flush::state_within() != flush::FLUSHED || !flush::subnormals_count() {
        return Err(EmbreeError::FlushStuck);
    }
    let at = |k: u8, z: f32| Sphere { center: [4.0 * f32::from(k), 0.0, z], radius: 1.0, color: [0; 3] };
    let near = (0..SEEING).map(|k| at(k, 10.0 + f32::from(k)));
    let far = (0..SEEING).map(|k| at(k, 50.0));
    let scene = Scene::new(near.chain(far).collect(), [0; 3], DEFAULT_LIGHT).expect("plain numbers");
    let tracer = Tracer::with_fault(device, &scene, Build::Robust, fault)?;
    let ray = |k: u8| Ray { eye: [4.0 * f32::from(k), 0.0, 0.0], dir: [0.0, 0.0, 1.0] };
    let rays: Vec<Ray> = (0..RAYS).map(ray).collect();
    for width in Width::ALL {
        let (mut ids, mut t) = (vec![0; rays.len()], vec![0.0; rays.len()]);
        tracer.trace(width, &rays, &mut ids, &mut t)?;
        for k in 0..RAYS {
            let i = usize::from(k);
            let expected = (k < SEEING).then(|| (u32::from(k), 9.0 + f32::from(k)));
            let found = (ids[i] != MISS).then(|| (ids[i], t[i]));
            let agree = match (expected, found) {
                (Some((id, t)), Some((found, at))) => id == found && (t - at).abs() <= t * 1e-6,
                (expected, found) => expected.is_none() && found.is_none(),
            };
            if !agree {
                return Err(EmbreeError::Canary { width, ray: i, expected, found });
            }
        }
    }
    // A library that does not write what its version is known to write is not the version that it says it is.
    if tracer.writes_growth(&rays[0]) == device.version().has_grown() {
        Ok(())
    } else {
        Err(EmbreeError::UnknownVersion(device.version()))
    }
}
