//! The error bound of the f32 stage held against whole numbers: what the shipped kernel says of a ball and sixteen rays must be
//! true, for all inputs of a domain or for inputs made so that its roundings add up.
//!
//! In: a machine, the unit roundoff its bound is made for, and a factor on the bound, which is 1 unless the check itself is on
//! trial. Out: how much was decided, and the first falsehood in full. All inputs are whole numbers, so the truth is a sign of
//! integers; only the ends of a root are compared in f64, 2⁻⁴⁰ of it being granted.

use crate::small::{Mode, Small};
use optimized::bound::{Bound, Rule};
use optimized::certain::{Ball, Rays, Side};
use optimized::machine::{LANES, Machine};
use rand::{Rng, RngExt};

/// A ball relative to the eye, in whole numbers.
#[derive(Clone, Copy, Debug)]
pub struct Whole {
    /// Its centre; A first, ahead.
    pub center: [i64; 3],
    /// Where the eye is on each axis: the centre's own coordinates are these plus `center`.
    pub eye: [i64; 3],
    /// Its radius.
    pub radius: i64,
}

/// What was said of rays and balls, and whether it was true.
#[derive(Clone, Debug, Default)]
pub struct Said {
    /// Rays and balls.
    pub inputs: u64,
    /// Certain hits.
    pub hits: u64,
    /// Certain misses.
    pub misses: u64,
    /// True hits whose root was held against its interval.
    pub roots: u64,
    /// Said of a ray and a ball, and false.
    pub wrong: u64,
    /// The first of these.
    pub first: Option<String>,
}

impl std::ops::Add for Said {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            inputs: self.inputs + other.inputs,
            hits: self.hits + other.hits,
            misses: self.misses + other.misses,
            roots: self.roots + other.roots,
            wrong: self.wrong + other.wrong,
            first: self.first.or(other.first),
        }
    }
}

/// A machine under trial.
#[derive(Clone, Copy, Debug)]
pub struct Trial<M> {
    /// The machine; every whole number given must be one of its floats.
    pub machine: M,
    /// The bounds of its arithmetic.
    pub rule: Rule,
    /// What the bound is multiplied by.
    pub factor: f32,
}

/// Sixteen directions (A, Y, Z) with A > 0 and no component larger.
pub type Directions = [[i64; 3]; LANES];

impl<M: Machine> Trial<M> {
    /// What the kernel says of a ball and the rays in these directions is held against the truth.
    pub fn check(&self, ball: &Whole, directions: &Directions, said: &mut Said) {
        let m = self.machine;
        let axis = |i: usize| {
            let mut lanes = [0.0; LANES];
            for (lane, direction) in lanes.iter_mut().zip(directions) {
                *lane = float(direction[i]);
            }
            m.lanes(lanes)
        };
        let rays = Rays::new(m, [m.div(axis(1), axis(0)), m.div(axis(2), axis(0))]);
        let center = [0, 1, 2].map(|i| {
            let (own, eye) = (float(ball.center[i] + ball.eye[i]), float(ball.eye[i]));
            m.to_array(m.sub(m.splat(own), m.splat(eye)))[0]
        });
        let radius = m.splat(float(ball.radius));
        let rr = m.to_array(m.mul(radius, radius))[0];
        let farthest = ball.center.iter().map(|c| c.unsigned_abs()).max().unwrap_or(0);
        #[allow(clippy::cast_precision_loss, reason = "below 2^24")]
        let bound = self.rule.bound(farthest as f32, ball.radius as f32);
        let bound = Bound {
            hit_above: bound.hit_above * self.factor,
            miss_below: bound.miss_below * self.factor,
            root: bound.root * self.factor,
        };
        let side = match ball.power() {
            0 => Side::Unknown,
            1.. => Side::Outside,
            _ => Side::Inside,
        };
        let found = rays.find(m, &Ball { center, rr, bound, side }, m.le(m.splat(0.0), m.splat(0.0)));
        let (one, zero) = (m.splat_i(1), m.splat_i(0));
        let yes = |mask| m.to_array_i(m.select_i(mask, one, zero)).map(|x| x == 1);
        let all = [0.0; LANES];
        let (possible, certain, lo, hi) = match &found {
            None => ([false; LANES], [false; LANES], all, all),
            Some(f) => (yes(f.possible), yes(f.certain), m.to_array(f.lo), m.to_array(f.hi)),
        };
        for lane in 0..LANES {
            let truth = ball.root(directions[lane]);
            let said_of = match (possible[lane], certain[lane], truth) {
                (false, _, Some(_)) => Err("a hit is called a miss"),
                (_, true, None) => Err("a miss is called a hit"),
                (true, _, Some(root)) if !within(root, lo[lane], hi[lane]) => Err("the root lies elsewhere"),
                (true, certain, Some(_)) => Ok((certain, false)),
                (possible, _, None) => Ok((false, !possible)),
            };
            said.inputs += 1;
            match said_of {
                Ok((hit, miss)) => {
                    said.hits += u64::from(hit);
                    said.misses += u64::from(miss);
                    said.roots += u64::from(truth.is_some());
                }
                Err(what) => {
                    said.wrong += 1;
                    said.first.get_or_insert_with(|| {
                        let interval = (lo[lane], hi[lane]);
                        format!("{what}: {ball:?}, direction {:?}, {interval:?}, {bound:?}", directions[lane])
                    });
                }
            }
        }
    }
}

impl Whole {
    /// |centre|² − r²: above 0 if the eye is outside.
    pub(crate) fn power(&self) -> i128 {
        self.center.iter().map(|&c| square(c)).sum::<i128>() - square(self.radius)
    }

    /// a r² − |c × d|², above or at 0 if the line through the eye hits.
    fn discriminant(&self, direction: [i64; 3]) -> i128 {
        let (c, d) = (self.center, direction);
        let cross = |i: usize, j: usize| square(c[i] * d[j] - c[j] * d[i]);
        let a: i64 = d.iter().map(|x| x * x).sum();
        i128::from(a) * i128::from(self.radius * self.radius) - (cross(0, 1) + cross(1, 2) + cross(2, 0))
    }

    /// Whether the ray, which begins at the eye, has a point in the closed ball.
    pub(crate) fn touches(&self, direction: [i64; 3]) -> bool {
        if self.along(direction) > 0 { self.discriminant(direction) >= 0 } else { self.power() <= 0 }
    }

    /// About how far the ray passes from the centre.
    #[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "about")]
    pub(crate) fn reached(&self, direction: [i64; 3]) -> i64 {
        let point = Self { radius: 0, ..*self };
        let a: i128 = direction.iter().map(|&x| square(x)).sum();
        let square = if self.along(direction) > 0 {
            -point.discriminant(direction) as f64 / a as f64
        } else {
            point.power() as f64
        };
        square.sqrt() as i64
    }

    /// c·d.
    fn along(&self, direction: [i64; 3]) -> i128 {
        (0..3).map(|i| i128::from(self.center[i]) * i128::from(direction[i])).sum()
    }

    /// The smallest positive root, as a distance along A.
    #[allow(clippy::cast_precision_loss, reason = "2^-40 are granted")]
    fn root(&self, direction: [i64; 3]) -> Option<f64> {
        let discriminant = self.discriminant(direction);
        let along = self.along(direction);
        let a: i128 = direction.iter().map(|&x| square(x)).sum();
        if discriminant < 0 || (self.power() >= 0 && along <= 0) {
            return None;
        }
        let half = (discriminant as f64).sqrt();
        let sum = if self.power() > 0 { along as f64 - half } else { along as f64 + half };
        Some(sum / a as f64 * direction[0] as f64)
    }
}

/// Of a number below 2⁶³, of which no product of two can be too large; what can is noticed.
fn square(x: i64) -> i128 {
    i128::from(x) * i128::from(x)
}

/// Whether a root lies in an interval, but for the rounding of its own computation.
fn within(root: f64, lo: f32, hi: f32) -> bool {
    let grant = root.abs() / (1u64 << 40) as f64;
    f64::from(lo) - grant <= root && root <= f64::from(hi) + grant
}

#[allow(clippy::cast_precision_loss, reason = "the caller gives floats")]
fn float(x: i64) -> f32 {
    x as f32
}

/// All directions of whole numbers of exactly `bits` bits along A whose other components are less by at most `less`, but not below
/// 0. The negative ones mirror these; balls come in all mirrored positions. In sixteens; the last of them repeat.
#[must_use]
pub fn all_directions(bits: u32, less: i64) -> Vec<Directions> {
    let most = 1i64 << bits;
    let minor = |a: i64| (a - less).max(0)..=a;
    let some = |a: i64| minor(a).flat_map(move |y| minor(a).map(move |z| [a, y, z]));
    let all: Vec<[i64; 3]> = (most / 2..most).flat_map(some).collect();
    let sixteen = |part: &[[i64; 3]]| {
        let mut directions = [part[0]; LANES];
        directions[..part.len()].copy_from_slice(part);
        directions
    };
    all.chunks(LANES).map(sixteen).collect()
}

/// A ball and a ray for floats of so many bits, made so that the roundings of the centre, of the slopes and often of the products
/// push the ray's distance one way, in the direction in which it counts, with the ray a hair inside the true silhouette (or, if
/// `outside`, beyond it). Floats of 7 bits and more have such inputs. Coordinates are just above a power of two and slopes just below 1, where roundings are largest. A
/// radius is about a hundredth of the distance.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "near enough; the truth is of integers"
)]
pub fn adverse(small: Small, outside: bool, rng: &mut impl Rng) -> (Whole, [i64; 3]) {
    const FINER: i64 = 64;
    let low = 1i64 << (small.bits - 1);
    let truncating = small.mode == Mode::Truncating;
    // Two slopes, of which the first comes out too small and the second too large, or at least not too small.
    let (direction, [y, z]) = loop {
        let a = rng.random_range(low..2 * low);
        let mut slope = || a - rng.random_range(0..=a / 16);
        let d = [a, slope(), slope()];
        let [y, z] = [d[1] as f64 / a as f64, d[2] as f64 / a as f64];
        let off = |x: f64| (f64::from(small.round(x)) - x) / small.unit() * 2.0;
        let [low_y, high_z] = if truncating { [-0.8, -0.1] } else { [-0.4, 0.4] };
        if off(y) < low_y && off(z) > high_z {
            break (d, [y, z]);
        }
    };
    // The centre's own coordinates are floats; the eye is off zero by less than what rounding takes off the difference.
    let mut near = |x: f64, up: bool| {
        let own = (x / FINER as f64).round() as i64 * FINER;
        let off =
            if truncating { rng.random_range(1..FINER / 8) } else { rng.random_range(FINER / 3..FINER / 2) };
        match (truncating, up) {
            (false, true) => [own, off],
            (false, false) => [own, -off],
            (true, true) => [own, 0],
            (true, false) => [own, off - FINER],
        }
    };
    let above = (low + low / 64 + 1) as f64 * FINER as f64;
    let [own_a, eye_a] = near(above, outside && !truncating);
    let along = (own_a - eye_a) as f64;
    let size = along / 100.0;
    // Y comes out too large and Z too small (or, truncated like A, about right); a ray inside is pushed out, one outside pulled in.
    let towards = if outside { -1.0 } else { 1.0 };
    let (big, small_part) = (towards * size, if truncating { 0.0 } else { -towards * size * 0.43 });
    let [own_y, eye_y] = near(y * along + big, true);
    let [own_z, eye_z] = near(z * along + small_part, false);
    let eye = [eye_a, eye_y, eye_z];
    let own = [own_a, own_y, own_z];
    let center = [0, 1, 2].map(|i| own[i] - eye[i]);
    let mut ball = Whole { center, eye, radius: 1 };
    // The least radius that hits, among floats.
    let a: f64 = direction.iter().map(|&x| (x * x) as f64).sum();
    let touching = ((-ball.discriminant(direction)) as f64 / a + 1.0).sqrt();
    ball.radius = touching as i64;
    while ball.discriminant(direction) < 0 {
        ball.radius += 1;
    }
    while ball.discriminant(direction) >= 0 {
        ball.radius -= 1;
    }
    ball.radius += i64::from(!outside);
    (ball, direction)
}
