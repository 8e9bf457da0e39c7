//! Aims a camera so that a whole animation is in view. Wishes come in - eye, target, up, angle, size, each may be
//! left open - and the contract's camera goes out. Refused are wishes that are not finite, an eye at its target, an
//! angle not between 0 and 180 degrees, and scenes so far out that no f32 eye sees all of them.
//!
//! Where to stand. The view is a pyramid of four planes through the eye with unit normals n pointing inward; a
//! sphere's silhouette is in the picture if its centre is at least r inside each: n (c - eye) >= r. With the eye at
//! target - s w, w the direction of view, this is s >= (r - n (c - target)) / (n w), where n w > 0 is the sine of half
//! the angle. So the least s is the maximum over spheres, planes and frames: no search. The planes used are
//! drawn in by [`MARGIN`], and a result that rounding to f32 has spoiled - it is checked - is moved back further.
//!
//! All in f64, rounded to f32 once. Tangents come from the system's library and may differ in their last bit
//! between systems; who needs a camera to the bit keeps it (`write::json`).

use super::vector::{Vector, cross, dot, sub, unit};
use contract::{Animation, Camera, CameraError, Scene, Size, Sphere};
use thiserror::Error;

/// The part of half the picture that stays free round the scene.
pub const MARGIN: f64 = 0.04;
/// The angle of the picture's height in degrees, unless another is wished for.
pub const FOV: f64 = 45.0;
/// Pixels, unless others are wished for.
pub const SIZE: [u32; 2] = [1280, 720];
/// How often the eye is moved back before giving up, by a half more each time.
const TRIES: u32 = 400;

/// What is wished for; what is `None` is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Framing {
    /// Where to stand; chosen so that all of the scene is seen.
    pub eye: Option<Vector>,
    /// What to look at; the middle of the scene's box.
    pub target: Option<Vector>,
    /// What is up in the picture; +y. Another axis is taken where this is the direction of view.
    pub up: Option<Vector>,
    /// Angle of the picture's height, in degrees; [`FOV`].
    pub fov: Option<f64>,
    /// Pixels; [`SIZE`].
    pub size: Option<Size>,
}

/// Why no camera came of it.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum FramingError {
    /// A wish has a NaN or an infinity.
    #[error("{field} is {value:?}; every component must be finite")]
    NotFinite {
        /// `eye`, `target` or `up`.
        field: &'static str,
        /// As wished.
        value: Vector,
    },
    /// The eye is at the target: there is no direction of view.
    #[error("the eye and what it looks at are both {eye:?}; there is no direction of view")]
    EyeIsTarget {
        /// Both.
        eye: Vector,
    },
    /// The angle is no angle of a picture.
    #[error("the angle of view is {fov} degrees; it must be above 0.001 and below 179")]
    Angle {
        /// As wished.
        fov: f64,
    },
    /// No eye within f32 sees all of the scene.
    #[error("no place within f32 has all of the scene in view; the last one tried is {eye:?}")]
    OutOfReach {
        /// The last one tried.
        eye: Vector,
    },
    /// The contract refuses the camera.
    #[error(transparent)]
    Camera(#[from] CameraError),
}

/// Unit vectors to the right, up and away from the eye, and half the picture at distance 1.
struct Aim {
    right: Vector,
    up: Vector,
    away: Vector,
    half: [f64; 2],
}

impl Framing {
    /// What is open here is taken from another.
    #[must_use]
    pub fn or(&self, other: &Self) -> Self {
        Self {
            eye: self.eye.or(other.eye),
            target: self.target.or(other.target),
            up: self.up.or(other.up),
            fov: self.fov.or(other.fov),
            size: self.size.or(other.size),
        }
    }

    /// Whether no other view is wished: nothing at all, or a size and no more.
    #[must_use]
    pub fn is_size(&self) -> bool {
        *self == Self { size: self.size, ..Self::default() }
    }

    /// A camera for all frames of an animation.
    ///
    /// # Errors
    /// [`FramingError`] if no camera fulfils the wishes.
    pub fn camera(&self, animation: &Animation) -> Result<Camera, FramingError> {
        self.camera_of(|| animation.frames().iter().flat_map(Scene::spheres))
    }

    /// A camera for all spheres that `spheres` gives, each time it is asked.
    ///
    /// # Errors
    /// [`FramingError`] if no camera fulfils the wishes.
    pub fn camera_of<'a, I>(&self, spheres: impl Fn() -> I) -> Result<Camera, FramingError>
    where
        I: Iterator<Item = &'a Sphere>,
    {
        self.check()?;
        let target = self.target.unwrap_or_else(|| middle(spheres()));
        if let Some(eye) = self.eye {
            let aim = self.aim(eye, target)?;
            return Ok(aim.camera(eye, self.size())?);
        }
        let aim = self.aim([0.0, 0.0, 1.0], [0.0; 3])?;
        let mut distance = aim.distance(spheres(), target);
        let mut eye = target;
        for _ in 0..TRIES {
            eye = std::array::from_fn(|i| f64::from((target[i] - distance * aim.away[i]) as f32));
            if !eye.iter().all(|x| x.is_finite()) {
                break;
            }
            let fits = |camera: &Camera| Pyramid::of(camera).is_some_and(|p| spheres().all(|s| p.holds(s)));
            match self.aim(eye, target).and_then(|aim| Ok(aim.camera(eye, self.size())?)) {
                Ok(camera) if fits(&camera) => return Ok(camera),
                _ => distance *= 1.5,
            }
        }
        Err(FramingError::OutOfReach { eye })
    }

    fn check(&self) -> Result<(), FramingError> {
        for (field, value) in [("eye", self.eye), ("target", self.target), ("up", self.up)] {
            if let Some(value) = value.filter(|v| !v.iter().all(|x| x.is_finite())) {
                return Err(FramingError::NotFinite { field, value });
            }
        }
        let fov = self.fov.unwrap_or(FOV);
        if fov > 0.001 && fov < 179.0 { Ok(()) } else { Err(FramingError::Angle { fov }) }
    }

    fn size(&self) -> Size {
        let [width, height] = SIZE;
        self.size.or_else(|| Size::new(width, height).ok()).expect("the default size is valid")
    }

    fn aim(&self, eye: Vector, target: Vector) -> Result<Aim, FramingError> {
        let away = unit(sub(target, eye)).ok_or(FramingError::EyeIsTarget { eye })?;
        let wished = unit(self.up.unwrap_or([0.0, 1.0, 0.0])).unwrap_or([0.0, 1.0, 0.0]);
        let right = [wished, least_axis(away)].into_iter().map(|up| cross(away, up));
        let right = right.clone().find(|r| dot(*r, *r) > 1e-12).and_then(unit);
        let right = right.ok_or(FramingError::EyeIsTarget { eye })?;
        let size = self.size();
        let half = (self.fov.unwrap_or(FOV) / 2.0).to_radians().tan();
        let aspect = f64::from(size.width()) / f64::from(size.height());
        Ok(Aim { right, up: cross(right, away), away, half: [half * aspect, half] })
    }
}

impl Aim {
    /// How far from the target the eye must stand; 1 for no spheres.
    fn distance<'a>(&self, spheres: impl Iterator<Item = &'a Sphere>, target: Vector) -> f64 {
        let planes = [(self.right, self.half[0]), (self.up, self.half[1])].map(|(side, half)| {
            let half = half * (1.0 - MARGIN);
            let length = (1.0 + half * half).sqrt();
            (side, half / length, 1.0 / length)
        });
        let need = |sphere: &Sphere| {
            let offset = sub(sphere.center.map(f64::from), target);
            let depth = dot(self.away, offset);
            let each = planes.map(|(side, sine, cosine)| {
                // The two planes of a pair differ in the sign of `side`.
                let reach = f64::from(sphere.radius) + dot(side, offset).abs() * cosine;
                reach / sine - depth
            });
            each[0].max(each[1])
        };
        let far = spheres.map(need).fold(0.0, f64::max);
        if far > 0.0 { far } else { 1.0 }
    }

    /// Rule 1 of the contract upside down: y grows downward.
    fn camera(&self, eye: Vector, size: Size) -> Result<Camera, CameraError> {
        let [across, high] = self.half;
        let corner =
            std::array::from_fn(|i| (self.away[i] - across * self.right[i] + high * self.up[i]) as f32);
        let du = self.right.map(|x| (2.0 * across / f64::from(size.width()) * x) as f32);
        let dv = self.up.map(|x| (-2.0 * high / f64::from(size.height()) * x) as f32);
        Camera::new(eye.map(|x| x as f32), corner, du, dv, size)
    }
}

/// A camera's view in other pixels of the same shape: as high as before, and of a wider picture more is seen on both sides, as the angle of view
/// has it.
///
/// # Errors
/// [`CameraError`] if its steps become too small or too large.
pub fn in_pixels(camera: &Camera, size: Size) -> Result<Camera, CameraError> {
    if size == camera.size() {
        return Ok(*camera);
    }
    let [width, height] = [camera.size().width(), camera.size().height()].map(f64::from);
    let smaller = height / f64::from(size.height());
    let [du, dv] = [camera.du(), camera.dv()].map(|step| step.map(|x| (f64::from(x) * smaller) as f32));
    // Half of what is seen more, in the camera's own columns.
    let beside = (f64::from(size.width()) * smaller - width) / 2.0;
    let corner =
        [0, 1, 2].map(|i| (f64::from(camera.corner()[i]) - beside * f64::from(camera.du()[i])) as f32);
    Camera::new(camera.eye(), corner, du, dv, size)
}

/// Whether the whole silhouette of a sphere lies in the picture of a camera, and the eye outside the sphere.
#[must_use]
pub fn in_view(camera: &Camera, sphere: &Sphere) -> bool {
    Pyramid::of(camera).is_some_and(|p| p.holds(sphere))
}

/// What a camera sees: unit normals of its four planes, inward, as its f32 vectors give them.
struct Pyramid {
    eye: Vector,
    normals: [Vector; 4],
}

impl Pyramid {
    /// `None` where two corners of the picture are one direction.
    fn of(camera: &Camera) -> Option<Self> {
        let [corner, du, dv] = [camera.corner(), camera.du(), camera.dv()].map(|v| v.map(f64::from));
        let (width, height) = (f64::from(camera.size().width()), f64::from(camera.size().height()));
        let at = |x: f64, y: f64| -> Vector { std::array::from_fn(|i| corner[i] + x * du[i] + y * dv[i]) };
        let corners = [at(0.0, 0.0), at(width, 0.0), at(width, height), at(0.0, height)];
        let middle = at(width / 2.0, height / 2.0);
        let mut normals = [[0.0; 3]; 4];
        for (i, normal) in normals.iter_mut().enumerate() {
            let across = unit(cross(corners[i], corners[(i + 1) % 4]))?;
            let sign = dot(across, middle).signum();
            *normal = across.map(|x| sign * x);
        }
        Some(Self { eye: camera.eye().map(f64::from), normals })
    }

    fn holds(&self, sphere: &Sphere) -> bool {
        let offset = sub(sphere.center.map(f64::from), self.eye);
        self.normals.iter().all(|&normal| dot(normal, offset) >= f64::from(sphere.radius))
    }
}

/// The middle of the box round all spheres; the origin if there are none.
#[must_use]
pub fn middle<'a>(spheres: impl Iterator<Item = &'a Sphere>) -> Vector {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for sphere in spheres {
        let radius = f64::from(sphere.radius);
        for (i, x) in sphere.center.map(f64::from).into_iter().enumerate() {
            low[i] = low[i].min(x - radius);
            high[i] = high[i].max(x + radius);
        }
    }
    if low[0] > high[0] { [0.0; 3] } else { std::array::from_fn(|i| low[i] / 2.0 + high[i] / 2.0) }
}

/// The axis most across a direction.
fn least_axis(v: Vector) -> Vector {
    let least = (0..3).min_by(|&i, &j| v[i].abs().total_cmp(&v[j].abs())).unwrap_or(0);
    std::array::from_fn(|i| if i == least { 1.0 } else { 0.0 })
}
