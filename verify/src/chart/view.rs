//! The same scene from farther away: the eye moves along its line of sight, and the angle of view shrinks so that the scene stays as
//! large in the picture. What changes is how many radii lie between eye and spheres, on which rounding depends.

use crate::scenes::frame::{FOV, Framing, FramingError, middle};
use contract::{Animation, Camera, Scene, Sphere};

/// A scene's camera and how far away it stands.
#[derive(Clone, Copy, Debug)]
pub struct Distance {
    /// How many times as far as the scene is seen by default.
    pub times: f64,
    /// The camera.
    pub camera: Camera,
    /// From the eye to what it looks at, in radii of the median sphere; 0 of an empty scene.
    pub radii: f64,
}

impl Distance {
    /// So many times as far as a framing has it.
    ///
    /// # Errors
    /// [`FramingError`], as where the angle of view becomes too small.
    pub fn new(animation: &Animation, framing: &Framing, times: f64) -> Result<Self, FramingError> {
        let spheres = || animation.frames().iter().flat_map(Scene::spheres);
        let near = framing.camera(animation)?;
        let target = framing.target.unwrap_or_else(|| middle(spheres()));
        let eye = near.eye().map(f64::from);
        let away: [f64; 3] = [0, 1, 2].map(|i| times * (eye[i] - target[i]));
        let half = (framing.fov.unwrap_or(FOV) / 2.0).to_radians().tan() / times;
        let far = Framing {
            eye: Some([0, 1, 2].map(|i| target[i] + away[i])),
            target: Some(target),
            fov: Some(2.0 * half.atan().to_degrees()),
            ..*framing
        };
        let camera = far.camera(animation)?;
        let length = away.iter().map(|x| x * x).sum::<f64>().sqrt();
        Ok(Self { times, camera, radii: median_radius(spheres()).map_or(0.0, |radius| length / radius) })
    }
}

fn median_radius<'a>(spheres: impl Iterator<Item = &'a Sphere>) -> Option<f64> {
    let mut radii: Vec<f32> = spheres.map(|sphere| sphere.radius).collect();
    radii.sort_by(f32::total_cmp);
    radii.get(radii.len() / 2).map(|radius| f64::from(*radius))
}
