//! The certain mood: eye, centres, radii and directions are small integers, and of many rays the answer is known from these integers
//! alone, without any tracer, down to the last bit of t.
//!
//! For a ray and a sphere in integers a = d·d, b = f·d, q = f·f − r² and D = b² − a q are integers. Where D is a square s² the roots
//! (−b ± s)/a are fractions. An answer is *known* if the winning root is such a fraction and an f32, and every other sphere's is a fraction
//! too, or irrational and more than one part in 10⁴ away. Fractions are compared by multiplying out; equal ones go to the
//! lowest id. It is known *in a form* besides if every number that the form computes on the way to D is an integer below 2²⁴, or an integer over
//! a power of two that is exact: then each of its roundings up to there does nothing, the winner's do nothing at all, and whoever computes
//! in it must have the very same bits. For the textbook form that is asked of b², a q and D; for the perpendicular form a must be
//! a power of two.
//!
//! Random integers hardly ever have such roots, so most spheres are aimed: their centre lies on a pixel's ray whose direction has a whole
//! length n, their radius is a multiple of n; or a unit vector at right angles to the ray leads to it, and the ray is a tangent.

use crate::case::{Asked, Case};
use crate::verdict::Verdict;
use contract::{Animation, Camera, DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
use proptest::collection::vec;
use proptest::prelude::*;
use reference::Ray;

/// Integers below this are f32, and so are their sums and products if they are below it too.
const EXACT: i64 = 1 << 24;

/// How a sphere of a lattice comes to be.
#[derive(Clone, Debug)]
pub enum Placed {
    /// There, with that radius.
    Free([i8; 3], u8),
    /// On the ray of a pixel with a direction of whole length n: `along` directions from the eye, with a radius of `half` n.
    Through {
        /// Which of the pixels that have one.
        pixel: u8,
        /// How many directions from the eye.
        along: i8,
        /// Half of what the ray goes through, in directions.
        half: u8,
    },
    /// Touched by the ray of a pixel whose direction has a component 0, in the middle, `along` directions from the eye.
    Touched {
        /// Which of the pixels that have one.
        pixel: u8,
        /// How many directions from the eye.
        along: i8,
        /// Its radius, above on the axis of that component or, if negative, below.
        radius: i8,
    },
}

/// A scene and a camera in integers; lengths and directions are then scaled by powers of two, which changes no answer but t.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// What is in it.
    pub spheres: Vec<Placed>,
    /// The eye.
    pub eye: [i8; 3],
    /// Axis and sense of the view, 0 to 5.
    pub heading: u8,
    /// How far the picture's plane is away.
    pub plane: u8,
    /// Where in it the picture's corner is.
    pub corner: [i8; 2],
    /// Steps from pixel to pixel, negative ones too, in units of 2 so that the middles of pixels are integers.
    pub step: [i8; 2],
    /// Pixels.
    pub size: [u8; 2],
    /// Powers of two for positions and directions.
    pub scale: [i8; 2],
}

/// What integers know of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// Id and t; `None` is a miss.
    pub answer: Option<(u32, f32)>,
    /// Known in the textbook form too.
    pub textbook: bool,
    /// Known in the perpendicular form too.
    pub perpendicular: bool,
    /// Two spheres have the root that wins.
    pub tie: bool,
    /// The ray touches what it hits.
    pub tangent: bool,
    /// The eye is inside a sphere, or on one.
    pub inside: bool,
}

/// Any of them.
pub fn lattice() -> impl Strategy<Value = Lattice> {
    let near = -6i8..=6;
    let along = || prop_oneof![4 => 1i8..=7, 1 => -2i8..=0];
    let radius = prop_oneof![1i8..=4, -4i8..=-1];
    let sphere = prop_oneof![
        2 => ([near.clone(), near.clone(), near], 1u8..=5).prop_map(|(center, radius)| Placed::Free(center, radius)),
        4 => (any::<u8>(), along(), 1u8..=4).prop_map(|(pixel, along, half)| Placed::Through { pixel, along, half }),
        1 => (any::<u8>(), along(), radius)
            .prop_map(|(pixel, along, radius)| Placed::Touched { pixel, along, radius }),
    ];
    let side = prop_oneof![1u8..=12, Just(4), Just(8)];
    let step = prop_oneof![Just(1i8), Just(-1), Just(2), Just(-2)];
    (
        vec(sphere, 0..=8),
        [-9i8..=9, -9i8..=9, -9i8..=9],
        0u8..6,
        prop_oneof![Just(1u8), Just(2), Just(4), Just(8), 1u8..=9],
        [-12i8..=6, -12i8..=6],
        [step.clone(), step],
        [side.clone(), side],
        [-20i8..=20, -6i8..=6],
    )
        .prop_map(|(spheres, eye, heading, plane, corner, step, size, scale)| Lattice {
            spheres,
            eye,
            heading,
            plane,
            corner,
            step,
            size,
            scale,
        })
}

impl Lattice {
    /// The direction of a pixel in integers.
    fn direction(&self, [x, y]: [u32; 2]) -> [i64; 3] {
        let axis = usize::from(self.heading % 3);
        let mut d = [0; 3];
        d[axis] = if self.heading < 3 { i64::from(self.plane) } else { -i64::from(self.plane) };
        for (i, pixel) in [x, y].into_iter().enumerate() {
            // (n + 1/2) 2 step + corner.
            d[(axis + 1 + i) % 3] =
                i64::from(self.corner[i]) + (2 * i64::from(pixel) + 1) * i64::from(self.step[i]);
        }
        d
    }

    /// Centres and radii. What asks for a pixel that is not there is left out.
    fn placed(&self) -> Vec<([i64; 3], i64)> {
        let [width, height] = self.size.map(u32::from);
        let all = (0..height).flat_map(|y| (0..width).map(move |x| self.direction([x, y])));
        let length = |d: &[i64; 3]| d.iter().map(|x| x * x).sum::<i64>();
        let whole: Vec<_> = all.clone().filter(|d| length(d).isqrt().pow(2) == length(d)).collect();
        let flat: Vec<_> = all.filter(|d| d.contains(&0)).collect();
        let chosen = |of: &[[i64; 3]], pixel: u8| of.get(usize::from(pixel) % of.len().max(1)).copied();
        let eye = self.eye.map(i64::from);
        let place = |placed: &Placed| match *placed {
            Placed::Free(center, radius) => Some((center.map(i64::from), i64::from(radius))),
            Placed::Through { pixel, along, half } => {
                let d = chosen(&whole, pixel)?;
                let center = [0, 1, 2].map(|i| eye[i] + i64::from(along) * d[i]);
                Some((center, i64::from(half) * length(&d).isqrt()))
            }
            Placed::Touched { pixel, along, radius } => {
                let d = chosen(&flat, pixel)?;
                let axis = d.iter().position(|x| *x == 0)?;
                let mut center = [0, 1, 2].map(|i| eye[i] + i64::from(along) * d[i]);
                center[axis] += i64::from(radius);
                Some((center, i64::from(radius).abs()))
            }
        };
        self.spheres.iter().filter_map(place).collect()
    }

    /// The case for a tracer, in f32: no number of it is rounded.
    #[must_use]
    pub fn case(&self, asked: &Asked) -> Option<Case> {
        let [p, q] = self.scale.map(|e| 2f32.powi(e.into()));
        let axis = usize::from(self.heading % 3);
        #[allow(clippy::cast_precision_loss, reason = "below 2^24")]
        let sphere = |((center, radius), i): (([i64; 3], i64), u8)| Sphere {
            center: center.map(|x| p * x as f32),
            radius: p * radius as f32,
            color: [i.wrapping_mul(90), 60, 200],
        };
        let spheres = self.placed().into_iter().zip(0u8..).map(sphere).collect();
        let scene = Scene::new(spheres, [1, 2, 3], DEFAULT_LIGHT).ok()?;
        let [mut corner, mut du, mut dv] = [[0.0; 3]; 3];
        corner[axis] = q * f32::from(self.plane) * if self.heading < 3 { 1.0 } else { -1.0 };
        for i in 0..2 {
            corner[(axis + 1 + i) % 3] = q * f32::from(self.corner[i]);
        }
        du[(axis + 1) % 3] = q * 2.0 * f32::from(self.step[0]);
        dv[(axis + 2) % 3] = q * 2.0 * f32::from(self.step[1]);
        let size = Size::new(self.size[0].into(), self.size[1].into()).ok()?;
        Some(Case {
            frames: Animation::from(scene),
            camera: Camera::new(self.eye.map(|x| p * f32::from(x)), corner, du, dv, size).ok()?,
            asked: asked.clone(),
            expected: Verdict::Undecidable,
            pixel: None,
            why: "a lattice, where integers know the answer".into(),
        })
    }

    /// What integers know of a pixel; `None` where they do not.
    ///
    /// # Panics
    /// If the camera of [`Lattice::case`] has another direction there than these integers say.
    #[must_use]
    pub fn known(&self, camera: &Camera, pixel: [u32; 2]) -> Option<Known> {
        let d = self.direction(pixel);
        let [p, q] = self.scale.map(i32::from);
        let given = Ray::of_pixel(camera, pixel[0], pixel[1]).dir.map(|x| f64::from(x) / 2f64.powi(q));
        #[allow(clippy::cast_precision_loss, reason = "small")]
        let meant = d.map(|x| x as f64);
        assert_eq!(given, meant, "the contract's direction of pixel {pixel:?}");
        let dot = |u: [i64; 3], v: [i64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let a = dot(d, d);
        let mut best: Option<(u32, i64)> = None;
        // The least of those that are not fractions.
        let mut irrational = f64::INFINITY;
        let mut known = Known {
            answer: None,
            textbook: true,
            perpendicular: a.count_ones() == 1,
            tie: false,
            tangent: false,
            inside: false,
        };
        for (id, (center, radius)) in (0..).zip(self.placed()) {
            let f = [0, 1, 2].map(|i| i64::from(self.eye[i]) - center[i]);
            let (b, q) = (dot(f, d), dot(f, f) - radius * radius);
            let discriminant = b * b - a * q;
            known.textbook &= b * b < EXACT && (a * q).abs() < EXACT && discriminant.abs() < EXACT;
            // b/a, its products with d and the squares of what is left are multiples of 1/a²: below 2²⁴ of them, none is rounded.
            known.perpendicular &= a * a * (dot(f, f) + b.abs() + a) < EXACT;
            known.inside |= q <= 0;
            if discriminant < 0 {
                continue;
            }
            let s = discriminant.isqrt();
            #[allow(clippy::cast_precision_loss, reason = "below 2^53")]
            if s * s != discriminant {
                let root = (discriminant as f64).sqrt();
                let t = if q > 0 { -b as f64 - root } else { -b as f64 + root };
                if t > 0.0 {
                    irrational = irrational.min(t);
                }
                continue;
            }
            let root = if q > 0 { -b - s } else { -b + s };
            if root <= 0 {
                continue;
            }
            known.tie |= best.is_some_and(|(_, nearest)| nearest == root);
            if best.is_none_or(|(_, nearest)| root < nearest) {
                (best, known.tie, known.tangent) = (Some((id, root)), false, s == 0);
            }
        }
        if irrational < f64::INFINITY && best.is_none() {
            return None;
        }
        let Some((id, root)) = best else { return Some(known) };
        #[allow(clippy::cast_precision_loss, reason = "below 2^53")]
        if irrational < 1.0001 * root as f64 {
            return None;
        }
        #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "asked right after")]
        let t = root as f32 / a as f32;
        if f64::from(t) * a as f64 != root as f64 {
            return None;
        }
        known.answer = Some((id, t * 2f32.powi(p - q)));
        Some(known)
    }
}

impl Known {
    /// The answer as an image has it.
    #[must_use]
    pub fn id_and_bits(&self) -> (u32, u32) {
        self.answer.map_or((MISS, f32::INFINITY.to_bits()), |(id, t)| (id, t.to_bits()))
    }
}
