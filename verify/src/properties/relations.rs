//! Metamorphic relations: a case changed so that the picture must change in a known way, or not at all. No truth is needed but for which roots are
//! equal, only the tracer, twice; so they hold a tracer even to what a judge and it might both have misread.

use crate::case::{Asked, Case};
use crate::subject::Promise;
use contract::{Animation, Camera, Image, MISS, Scene, Size, Sphere};
use optimized::plan::OnEvent;
use rand::seq::SliceRandom;
use rand::{Rng, RngExt};
use reference::{Arithmetic, Ray, Tracer};

/// How a case is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Relation {
    /// Spheres in another order: ids follow them, but where roots are equal.
    Permuted,
    /// An axis turned round: nothing changes. Rounding to nearest and cutting off know no direction.
    Mirrored,
    /// Axes in another order: ids and t stay for the exact tracer; others sum in another order.
    Turned,
    /// Positions times a power of two: t times it.
    Scaled,
    /// Directions times a power of two: t divided by it.
    Stretched,
    /// A sphere more, behind the eye: nothing changes.
    Behind,
    /// A sphere more, inside one that the eye is outside of: nothing changes, for the exact tracer.
    Hidden,
    /// Rendered in two halves, of which the left one has the same directions: its half of the picture.
    Halved,
    /// After another frame in the same session: as if alone.
    Second,
    /// By three workers: nothing changes.
    Shared,
}

/// All of them.
pub const RELATIONS: [Relation; 10] = [
    Relation::Permuted,
    Relation::Mirrored,
    Relation::Turned,
    Relation::Scaled,
    Relation::Stretched,
    Relation::Behind,
    Relation::Hidden,
    Relation::Halved,
    Relation::Second,
    Relation::Shared,
];

impl Relation {
    /// What is counted when it was held.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Permuted => "pixels with spheres permuted",
            Self::Mirrored => "pixels mirrored",
            Self::Turned => "pixels with axes turned",
            Self::Scaled => "pixels scaled",
            Self::Stretched => "pixels with directions stretched",
            Self::Behind => "pixels with a sphere behind the eye",
            Self::Hidden => "pixels with a hidden sphere",
            Self::Halved => "pixels of half a picture",
            Self::Second => "pixels of a second frame",
            Self::Shared => "pixels shared by workers",
        }
    }

    /// Holds a case to it. How many pixels were compared; 0 if it says nothing of this case, or changes nothing of it.
    ///
    /// # Errors
    /// What differs, in a sentence.
    ///
    /// # Panics
    /// Never: an image's pixels can be numbered.
    pub fn hold(self, case: &Case, rng: &mut impl Rng) -> Result<u64, String> {
        // What refuses one frame may take another that says the same.
        if matches!(case.asked, Asked::Grid { plan, .. } if plan.on_event == OnEvent::Refuse) {
            return Ok(0);
        }
        let exact = case.asked.promise() == Promise::Exact;
        let scene = case.frames.frames()[0].clone();
        let before = Case { frames: Animation::from(scene.clone()), ..case.clone() };
        let spheres = scene.spheres().to_vec();
        let old = last(&before).map_err(|error| self.says(&error))?;
        let with = |spheres: Vec<Sphere>, light: [f32; 3], camera: Option<Camera>, asked: &Asked| {
            let scene = Scene::new(spheres, scene.background(), light).ok()?;
            let new = Case {
                frames: Animation::from(scene),
                camera: camera?,
                asked: asked.clone(),
                ..before.clone()
            };
            // A picture that is held against itself shows nothing.
            let parts = |case: &Case| (case.frames.clone(), case.camera, case.asked.to_string());
            (parts(&new) != parts(&before)).then_some(new)
        };
        let plain = |spheres| with(spheres, scene.light(), Some(case.camera), &case.asked);
        let same = |t: f32| t;
        let keep = |id: u32| id;
        match self {
            Self::Permuted => {
                let mut order: Vec<u32> = (0u32..).take(spheres.len()).collect();
                order.shuffle(rng);
                let Some(new) = plain(order.iter().map(|i| spheres[*i as usize]).collect()) else {
                    return Ok(0);
                };
                let new = last(&new).map_err(|error| self.says(&error))?;
                // Equal roots may now have another owner; then whichever of the two comes first is seen.
                let owner = |id: u32| order[id as usize];
                let both = |a: u32, b: u32| {
                    let two = vec![spheres[a as usize], spheres[b as usize]];
                    Scene::new(two, scene.background(), scene.light()).ok()
                };
                let first_of = |a: u32, b: u32, i: usize| {
                    let two = both(a, b).map(|two| Case { frames: Animation::from(two), ..before.clone() });
                    two.and_then(|two| last(&two).ok()).is_some_and(|image| image.ids[i] == 0)
                };
                // Whoever promises the truth may not take two roots for equal that only round to one f32.
                let truly_first = |a: u32, b: u32, i: usize| {
                    let i = u32::try_from(i).expect("an image has at most 2^27 pixels");
                    let width = case.camera.size().width();
                    let ray = Ray::of_pixel(&case.camera, i % width, i / width);
                    let exact = Tracer::new(Arithmetic::Exact);
                    both(a, b).is_some_and(|two| exact.trace(&ray, &two).is_some_and(|hit| hit.id == 0))
                };
                let first = |a: u32, b: u32, i: usize| first_of(a, b, i) && (!exact || truly_first(a, b, i));
                let tied =
                    |i: usize, a: u32, b: u32| a != MISS && b != MISS && first(a, b, i) && first(b, a, i);
                self.compare(&old, &new, owner, same, tied)
            }
            Self::Mirrored => {
                let axis = rng.random_range(0..3usize);
                let flip = |mut v: [f32; 3]| {
                    v[axis] = -v[axis];
                    v
                };
                let moved = spheres.iter().map(|s| Sphere { center: flip(s.center), ..*s }).collect();
                let Some(new) =
                    with(moved, flip(scene.light()), mapped(&case.camera, flip, flip), &case.asked)
                else {
                    return Ok(0);
                };
                self.against(&old, &new, same)
            }
            Self::Turned if exact => {
                let by = rng.random_range(1..3usize);
                let turn = |v: [f32; 3]| [0, 1, 2].map(|i| v[(i + by) % 3]);
                let moved = spheres.iter().map(|s| Sphere { center: turn(s.center), ..*s }).collect();
                let Some(new) =
                    with(moved, turn(scene.light()), mapped(&case.camera, turn, turn), &case.asked)
                else {
                    return Ok(0);
                };
                let mut new = last(&new).map_err(|error| self.says(&error))?;
                // Colours are f32 sums in a stated order, and may move by their last bit.
                new.rgba.clone_from(&old.rgba);
                self.compare(&old, &new, keep, same, |_, _, _| false)
            }
            Self::Scaled | Self::Stretched => {
                let power = 2f32.powi(*[-3, -1, 1, 4].get(rng.random_range(0..4usize)).unwrap_or(&1));
                let scale = |v: [f32; 3]| v.map(|x| power * x);
                let is_exact =
                    |v: [f32; 3]| v.iter().all(|x| (power * x) / power == *x && (power * x).is_finite());
                let stay = |v: [f32; 3]| v;
                let camera = &case.camera;
                let new = if self == Self::Scaled {
                    let fits = spheres.iter().all(|s| is_exact(s.center) && is_exact([s.radius; 3]));
                    let moved = spheres.iter().map(|s| Sphere {
                        center: scale(s.center),
                        radius: power * s.radius,
                        ..*s
                    });
                    let camera = mapped(camera, scale, stay).filter(|_| fits && is_exact(camera.eye()));
                    with(moved.collect(), scene.light(), camera, &case.asked)
                } else {
                    let fits = [camera.corner(), camera.du(), camera.dv()].iter().all(|v| is_exact(*v));
                    with(spheres, scene.light(), mapped(camera, stay, scale).filter(|_| fits), &case.asked)
                };
                // Forms may over- or underflow where the exact tracer does not; and t itself may.
                let tame = |x: f32| x == 0.0 || (1e-6..1e6).contains(&x.abs());
                let all_tame =
                    scene.spheres().iter().all(|s| s.center.iter().chain([&s.radius]).all(|x| tame(*x)))
                        && [camera.eye(), camera.corner(), camera.du(), camera.dv()]
                            .iter()
                            .flatten()
                            .all(|x| tame(*x));
                let Some(new) = new.filter(|_| all_tame) else { return Ok(0) };
                let factor = if self == Self::Scaled { power } else { power.recip() };
                let new = last(&new).map_err(|error| self.says(&error))?;
                // A hit point is then rounded elsewhere on the grid of f32 only if it under- or overflows; colours stay.
                self.compare(&old, &new, keep, |t| factor * t, |_, _, _| false)
            }
            Self::Behind if exact => {
                let Some(extra) = behind(&case.camera, rng) else { return Ok(0) };
                let Some(new) = plain(spheres.into_iter().chain([extra]).collect()) else { return Ok(0) };
                self.against(&old, &new, same)
            }
            Self::Hidden if exact && !spheres.is_empty() => {
                let around = spheres[rng.random_range(0..spheres.len())];
                let apart = |i: usize| f64::from(around.center[i]) - f64::from(case.camera.eye()[i]);
                let outside =
                    (0..3).map(|i| apart(i).powi(2)).sum::<f64>() > 1.01 * f64::from(around.radius).powi(2);
                let extra = Sphere { radius: around.radius * 0.5, color: [1, 2, 3], ..around };
                let Some(new) = plain(spheres.into_iter().chain([extra]).collect()).filter(|_| outside)
                else {
                    return Ok(0);
                };
                self.against(&old, &new, same)
            }
            Self::Halved => {
                let (width, height) = (case.camera.size().width(), case.camera.size().height());
                let Some(size) = Size::new(width.div_ceil(2), height.div_ceil(2)).ok() else { return Ok(0) };
                let half = Camera::new(
                    case.camera.eye(),
                    case.camera.corner(),
                    case.camera.du(),
                    case.camera.dv(),
                    size,
                );
                let Some(new) = with(spheres, scene.light(), half.ok(), &case.asked) else { return Ok(0) };
                let new = last(&new).map_err(|error| self.says(&error))?;
                let Ok(mut part) = Image::new(size, scene.background()) else { return Ok(0) };
                for i in 0..part.ids.len() {
                    let columns = size.width() as usize;
                    let whole = i / columns * width as usize + i % columns;
                    (part.ids[i], part.t[i], part.rgba[i]) = (old.ids[whole], old.t[whole], old.rgba[whole]);
                }
                self.compare(&part, &new, keep, same, |_, _, _| false)
            }
            Self::Second => {
                let mut first = spheres.clone();
                for sphere in &mut first {
                    sphere.center = sphere.center.map(|x| x + sphere.radius * rng.random_range(-2.0f32..2.0));
                }
                first.extend(spheres.iter().take(3).copied());
                let Ok(first) = Scene::new(first, scene.background(), scene.light()) else { return Ok(0) };
                let Ok(frames) = Animation::new(vec![first, scene.clone()]) else { return Ok(0) };
                self.against(&old, &Case { frames, ..before }, same)
            }
            Self::Shared => {
                let Asked::Grid { plan, level, workers } = case.asked else { return Ok(0) };
                let workers = if workers == 1 { 3 } else { 1 };
                let Some(new) =
                    with(spheres, scene.light(), Some(case.camera), &Asked::Grid { plan, level, workers })
                else {
                    return Ok(0);
                };
                self.against(&old, &new, same)
            }
            Self::Turned | Self::Behind | Self::Hidden => Ok(0),
        }
    }

    fn says(self, what: &dyn std::fmt::Display) -> String {
        format!("{self:?}: {what}")
    }

    fn against(self, old: &Image, new: &Case, t: impl Fn(f32) -> f32) -> Result<u64, String> {
        let new = last(new).map_err(|error| self.says(&error))?;
        self.compare(old, &new, |id| id, t, |_, _, _| false)
    }

    /// Holds a picture against the one before the change: ids as `id` maps the new ones, t as `t` maps the old ones, colours as they
    /// are; `may` excuses a pixel with other ids.
    fn compare(
        self,
        old: &Image,
        new: &Image,
        id: impl Fn(u32) -> u32,
        t: impl Fn(f32) -> f32,
        may: impl Fn(usize, u32, u32) -> bool,
    ) -> Result<u64, String> {
        if old.size != new.size {
            return Err(self.says(&"the pictures have different sizes"));
        }
        for i in 0..old.ids.len() {
            let came = if new.ids[i] == MISS { MISS } else { id(new.ids[i]) };
            let (expected, given) =
                ((old.ids[i], t(old.t[i]).to_bits(), old.rgba[i]), (came, new.t[i].to_bits(), new.rgba[i]));
            if expected != given && !(expected.1 == given.1 && may(i, expected.0, given.0)) {
                let width = old.size.width() as usize;
                return Err(self.says(&format!(
                    "pixel ({}, {}): expected id {}, t {:?}, colour {:?}; came id {}, t {:?}, colour {:?}",
                    i % width,
                    i / width,
                    expected.0,
                    t(old.t[i]),
                    old.rgba[i],
                    came,
                    new.t[i],
                    new.rgba[i],
                )));
            }
        }
        Ok(old.ids.len() as u64)
    }
}

/// The last picture.
fn last(case: &Case) -> Result<Image, String> {
    let pictures = case.pictures().map_err(|error| error.to_string())?;
    pictures.into_iter().next_back().ok_or_else(|| "no picture".into())
}

/// A camera with its eye and its directions changed.
fn mapped(
    camera: &Camera,
    position: impl Fn([f32; 3]) -> [f32; 3],
    direction: impl Fn([f32; 3]) -> [f32; 3],
) -> Option<Camera> {
    let [corner, du, dv] = [camera.corner(), camera.du(), camera.dv()].map(direction);
    Camera::new(position(camera.eye()), corner, du, dv, camera.size()).ok()
}

/// A sphere that no ray reaches, if all rays go to one side of a plane through the eye.
fn behind(camera: &Camera, rng: &mut impl Rng) -> Option<Sphere> {
    let (width, height) = (camera.size().width(), camera.size().height());
    let middle = Ray::of_pixel(camera, width / 2, height / 2).dir.map(f64::from);
    let dot = |v: [f32; 3]| (0..3).map(|i| middle[i] * f64::from(v[i])).sum::<f64>();
    for x in [0, width - 1] {
        for y in [0, height - 1] {
            let d = Ray::of_pixel(camera, x, y).dir;
            if dot(d) <= 1e-3 * middle.iter().map(|x| x * x).sum::<f64>() {
                return None;
            }
        }
    }
    let length = middle.iter().map(|x| x * x).sum::<f64>().sqrt();
    let radius = 10f64.powf(rng.random_range(-1.0..1.0)) * length;
    let away = radius * rng.random_range(1.1..3.0) / length;
    #[allow(clippy::cast_possible_truncation, reason = "any such sphere will do")]
    let center = [0, 1, 2].map(|i| (f64::from(camera.eye()[i]) - away * middle[i]) as f32);
    #[allow(clippy::cast_possible_truncation, reason = "any such sphere will do")]
    let radius = radius as f32;
    let apart: f64 =
        (0..3).map(|i| (f64::from(center[i]) - f64::from(camera.eye()[i])) * -middle[i]).sum::<f64>()
            / length;
    let sphere = Sphere { center, radius, color: [9, 9, 9] };
    (apart > f64::from(radius) * 1.01).then_some(sphere)
}
