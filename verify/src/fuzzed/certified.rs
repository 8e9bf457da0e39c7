//! Certified arithmetic stage by stage against the exact reference: what f32 and f64 say is never wrong, what integers say is right, and
//! so is what comes of all three.

use super::bytes::Bytes;
use super::view::rays_and_spheres;
use super::{bits, listed, vector};
use contract::{DEFAULT_LIGHT, Scene, Sphere};
use optimized::camera::Block;
use optimized::certain::{Ball, Rays};
use optimized::double::{self, Answer};
use optimized::frustum::Bundle;
use optimized::host::Work;
use optimized::machine::{LANES, Machine};
use optimized::seen::{Seen, Worker};
use optimized::sphere::NONE;
use optimized::{Level, Plan, exact};
use reference::{Arithmetic, Hit, Ray, Tracer};

/// Sixteen rays from one eye, the later ones a few ulp or a whole number off the first, and up to four spheres. Each ray's answer must
/// be the reference's, in id and bits of t; of each ray and sphere alone, what the f32 kernel and f64 call certain must be true, with the
/// root where they say; and `exact` alone must answer as the reference does. Answers are judged.
///
/// # Panics
/// If something false is said.
pub fn certified(bytes: &[u8]) -> u64 {
    let mut from = Bytes(bytes);
    let level = from.level();
    let (ray, spheres) = rays_and_spheres(&mut from, 4);
    let Ok(scene) = Scene::new(spheres, [0; 3], DEFAULT_LIGHT) else { return 0 };
    let rays: [Ray; LANES] =
        std::array::from_fn(|lane| Ray { eye: ray.eye, dir: off(&mut from, lane, ray.dir) });
    if !rays.iter().flat_map(|ray| ray.eye.iter().chain(&ray.dir)).all(|x| x.is_finite()) {
        return 0;
    }
    let said = level.run(Ask { scene: &scene, rays: &rays });
    let mut judged = 0;
    for (lane, ray) in rays.iter().enumerate() {
        judged += judge(ray, &scene, &said, lane, level);
    }
    judged
}

/// The direction of a lane.
fn off(from: &mut Bytes<'_>, lane: usize, dir: [f32; 3]) -> [f32; 3] {
    let mut dir = dir;
    if lane > 0 {
        let far = from.flag();
        for x in &mut dir {
            let step = from.whole() % 8;
            for _ in 0..step.unsigned_abs() {
                *x = if step > 0 { x.next_up() } else { x.next_down() };
            }
            if far {
                *x += f32::from(step);
            }
        }
    }
    dir
}

/// What is said of sixteen rays.
struct Said {
    /// t and id of each.
    answers: [(f32, i32); LANES],
    /// Of each sphere, what f32 says of each ray; nothing if the rays have no major axis.
    found: Vec<[Option<Interval>; LANES]>,
}

/// What f32 says of a ray and a sphere: whether a hit is possible and certain, and between which distances along the major axis,
/// that is t times |d| on it.
#[derive(Clone, Copy, Debug)]
struct Interval {
    possible: bool,
    certain: bool,
    lo: f32,
    hi: f32,
    /// |d| on the major axis.
    speed: f32,
}

impl Interval {
    /// Whether the truth, t of a hit or a miss, may be so.
    fn allows(self, truth: Option<f32>) -> bool {
        match truth {
            None => !self.certain,
            Some(t) => self.possible && meet([self.lo, self.hi].map(f64::from), t, f64::from(self.speed)),
        }
    }
}

struct Ask<'a> {
    scene: &'a Scene,
    rays: &'a [Ray; LANES],
}

impl Work for Ask<'_> {
    type Output = Said;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Said {
        let (scene, rays) = (self.scene, self.rays);
        let seen = Seen::without_grid(m, Plan::fast(), scene.spheres(), rays[0].eye);
        let dir = [0, 1, 2].map(|i| std::array::from_fn(|lane| rays[lane].dir[i]));
        let block = Block::new(m, dir.map(|d| m.lanes(d)));
        let mut worker = Worker::default();
        let answers = m.within(
            #[inline(always)]
            || seen.trace(m, scene.spheres(), &block, None, &mut worker),
        );
        let (t, id) = (m.to_array(answers.t), m.to_array_i(answers.owners.id));
        let found = match Bundle::of_block(m, &block) {
            None => Vec::new(),
            Some(bundle) => {
                let known = seen.spheres.iter().zip(&seen.bounds);
                let ball = known.map(|(sphere, &(bound, side))| {
                    let center = bundle.frustum.heading.towards(sphere.f);
                    find(m, &bundle, &Ball { center, rr: sphere.rr, bound, side })
                });
                ball.collect()
            }
        };
        Said { answers: std::array::from_fn(|lane| (t[lane], id[lane])), found }
    }
}

fn find<M: Machine>(m: M, bundle: &Bundle<M>, ball: &Ball) -> [Option<Interval>; LANES] {
    let found = m.within(
        #[inline(always)]
        || Rays::new(m, bundle.slope).find(m, ball, m.le(m.splat(0.0), m.splat(0.0))),
    );
    let speed = m.to_array(bundle.speed);
    let Some(found) = found else {
        let none = |speed| Interval { possible: false, certain: false, lo: 0.0, hi: 0.0, speed };
        return speed.map(|speed| Some(none(speed)));
    };
    let [possible, certain] = [found.possible, found.certain].map(|x| m.to_bits(x));
    let [lo, hi] = [found.lo, found.hi].map(|x| m.to_array(x));
    std::array::from_fn(|lane| {
        let [possible, certain] = [possible, certain].map(|x| x >> lane & 1 == 1);
        Some(Interval { possible, certain, lo: lo[lane], hi: hi[lane], speed: speed[lane] })
    })
}

fn judge(ray: &Ray, scene: &Scene, said: &Said, lane: usize, level: Level) -> u64 {
    let exactly = Tracer::new(Arithmetic::Exact);
    let truth = exactly.trace(ray, scene);
    let replay = || {
        let (eye, dir) = (vector(ray.eye), vector(ray.dir));
        format!("lane {lane} at {level}, eye {eye}, direction {dir}{}", listed(scene.spheres()))
    };
    let words = |hit: Option<(u32, f32)>| match hit {
        None => "a miss".to_owned(),
        Some((id, t)) => format!("sphere {id} at {}", bits(t)),
    };
    let expected = truth.map(|hit| (hit.id, hit.t));
    let (t, id) = said.answers[lane];
    let given = (id != NONE).then(|| (id.unsigned_abs(), t));
    let all = (0..).zip(scene.spheres());
    let integers = exact::nearest(ray.eye, ray.dir, all);
    let same = |hit: Option<(u32, f32)>| hit.map(|(id, t)| (id, t.to_bits()));
    for (who, answer) in [("the three stages", given), ("the integers", integers)] {
        assert!(
            same(answer) == same(expected),
            "{who} of `optimized` say {}, the reference {}; {}",
            words(answer),
            words(expected),
            replay()
        );
    }
    let mut judged = 2;
    for (id, sphere) in scene.spheres().iter().enumerate() {
        let truth = alone(&exactly, ray, sphere);
        let by_f64 = double::ask::<f64>(ray.eye, ray.dir, sphere);
        let agree = match (by_f64, truth) {
            (Answer::Undecided, _) | (Answer::Miss, None) => true,
            // The root lies between t's neighbours.
            (Answer::Hit([lo, hi]), Some(Hit { t, .. })) => meet([lo, hi], t, 1.0),
            _ => false,
        };
        assert!(agree, "f64 says {by_f64:?} of sphere {id}, the truth is {truth:?}; {}", replay());
        judged += 1;
        let Some(by_f32) = said.found.get(id).and_then(|found| found[lane]) else { continue };
        let agree = by_f32.allows(truth.map(|hit| hit.t));
        assert!(agree, "f32 says {by_f32:?} of sphere {id}, the truth is {truth:?}; {}", replay());
        judged += 1;
    }
    judged
}

fn alone(tracer: &Tracer, ray: &Ray, sphere: &Sphere) -> Option<Hit> {
    let scene = Scene::new(vec![*sphere], [0; 3], DEFAULT_LIGHT).ok()?;
    tracer.trace(ray, &scene)
}

/// Whether an interval has a point where the root can be whose correctly rounded value is t, times the speed; beyond f32 anywhere.
fn meet([lo, hi]: [f64; 2], t: f32, speed: f64) -> bool {
    let [before, after] = [t.next_down(), t.next_up()].map(|t| f64::from(t) * speed);
    !t.is_finite() || !after.is_finite() || (lo <= after && before <= hi)
}

#[cfg(test)]
mod tests {
    use super::Interval;

    /// What f32 says is false if a certain hit is none, an impossible one is, or the root lies beyond its ends.
    #[test]
    fn what_is_false_is_noticed() {
        let said = |possible, certain, lo, hi| Interval { possible, certain, lo, hi, speed: 2.0 };
        for (said, truth, so) in [
            (said(true, true, 3.0, 5.0), Some(2.0), true),
            (said(true, false, 3.0, 5.0), Some(2.0), true),
            (said(true, false, 3.0, 5.0), None, true),
            (said(false, false, 0.0, 0.0), None, true),
            (said(true, true, 3.0, 5.0), None, false),
            (said(false, false, 3.0, 5.0), Some(2.0), false),
            (said(true, true, 4.1, 5.0), Some(2.0), false),
            (said(true, true, 3.0, 3.9), Some(2.0), false),
            // The neighbours of t, times the speed, are the last that may be.
            (said(true, true, 2.0 * 2.0f32.next_up(), 5.0), Some(2.0), true),
            (said(true, true, (2.0 * 2.0f32.next_up()).next_up(), 5.0), Some(2.0), false),
        ] {
            assert_eq!(said.allows(truth), so, "{said:?}, {truth:?}");
        }
    }
}
