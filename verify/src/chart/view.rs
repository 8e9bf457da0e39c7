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

#[cfg(test)]
mod tests {
    use super::Distance;
    use crate::scenes::catalogue::Source;
    use crate::scenes::frame::{Framing, in_view};

    #[test]
    fn the_scene_stays_in_view() {
        let loaded = Source::parse("uniform:50:1").and_then(|source| source.load()).expect("generated");
        let at = |times| Distance::new(&loaded.animation, &Framing::default(), times).expect("far away");
        let spheres = loaded.animation.frames()[0].spheres();
        for times in [1.0, 10.0, 1000.0] {
            let seen = spheres.iter().filter(|sphere| in_view(&at(times).camera, sphere)).count();
            assert!(
                seen >= spheres.len() * 9 / 10,
                "{times} times as far {seen} of {} are in view",
                spheres.len()
            );
        }
        let ratio = at(100.0).radii / at(1.0).radii;
        assert!((ratio - 100.0).abs() < 1e-3, "100 times as far is {ratio} times as many radii");
    }
}
