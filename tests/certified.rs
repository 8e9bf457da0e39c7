//! Is the certified arithmetic right where decisions are close, and is each of its stages needed? Directed rays against the exact
//! reference, every stage reached; each stage alone against what it must not say.

use contract::{DEFAULT_LIGHT, Scene};
use optimized::bound::{Bound, NEAREST, Rule};
use optimized::camera::Block;
use optimized::double::{self, Answer};
use optimized::host::{Scalar, Work};
use optimized::machine::{LANES, Machine};
use optimized::seen::{Counts, Seen, Worker};
use optimized::sphere::NONE;
use optimized::{Level, Plan, exact};
use rand::{Rng, RngExt};
use rayon::prelude::*;
use reference::{Arithmetic, Ray, Tracer};
use std::collections::BTreeMap;
use verify::directed::{Case, KINDS, Kind, case};
use verify::seed::{count, generator, seed};

#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    rays: u64,
    hits: u64,
    counts: Counts,
    /// Spheres about which f64 alone was asked, and those that it left undecided.
    asked: u64,
    undecided: u64,
}

impl std::ops::Add for Tally {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            hits: self.hits + other.hits,
            counts: self.counts + other.counts,
            asked: self.asked + other.asked,
            undecided: self.undecided + other.undecided,
        }
    }
}

/// Sixteen rays at some level, without a grid.
struct Trace<'a>(&'a Seen, &'a Scene, [[f32; LANES]; 3]);

impl Work for Trace<'_> {
    type Output = ([f32; LANES], [i32; LANES], Counts);

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        let Self(seen, scene, dir) = self;
        let mut worker = Worker::default();
        let block = Block::new(m, dir.map(|d| m.lanes(d)));
        let answers = m.within(|| seen.trace(m, scene.spheres(), &block, None, &mut worker));
        (m.to_array(answers.t), m.to_array_i(answers.owners.id), worker.counts)
    }
}

/// A case's ray, and fifteen whose directions are off it by a few ulp.
fn rays(case: &Case, rng: &mut impl Rng) -> [[f32; LANES]; 3] {
    let mut dir = case.ray.dir.map(|d| [d; LANES]);
    for lane in 1..LANES {
        for axis in &mut dir {
            for _ in 0..rng.random_range(0..3) {
                let moved = if rng.random() { axis[lane].next_up() } else { axis[lane].next_down() };
                axis[lane] = if moved.is_finite() { moved } else { axis[lane] };
            }
        }
    }
    dir
}

type Bits = Option<(u32, u32)>;

fn truth(ray: &Ray, scene: &Scene) -> Bits {
    Tracer::new(Arithmetic::Exact).trace(ray, scene).map(|hit| (hit.id, hit.t.to_bits()))
}

fn judge(kind: Kind, seed: u64, i: u64, levels: &[Level]) -> Tally {
    let mut rng = generator(seed, i);
    let case = case(kind, &mut rng);
    let scene = Scene::new(case.spheres.clone(), [0; 3], DEFAULT_LIGHT).expect("valid by construction");
    let seen = Seen::without_grid(Scalar, Plan::fast(), scene.spheres(), case.ray.eye);
    let dir = rays(&case, &mut rng);
    let level = levels[usize::try_from(i).expect("fits") / KINDS.len() % levels.len()];
    let (t, id, counts) = level.run(Trace(&seen, &scene, dir));
    let mut tally = Tally { rays: LANES as u64, counts, ..Tally::default() };
    for lane in 0..LANES {
        let ray = Ray { eye: case.ray.eye, dir: dir.map(|d| d[lane]) };
        let expected = truth(&ray, &scene);
        let given = (id[lane] != NONE).then(|| (id[lane].unsigned_abs(), t[lane].to_bits()));
        let replay = || format!("lane {lane} of case {i} of CGT_SEED={seed} at {level}: {ray:?} {case:?}");
        assert_eq!(expected, given, "exact, certified; {}", replay());
        tally.hits += u64::from(expected.is_some());
        if lane > 0 {
            continue;
        }
        let all = (0..).zip(scene.spheres());
        let integers = exact::nearest(ray.eye, ray.dir, all).map(|(id, t)| (id, t.to_bits()));
        assert_eq!(expected, integers, "exact, the integers of `optimized`; {}", replay());
        for sphere in scene.spheres() {
            let alone = Scene::new(vec![*sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
            let t = Tracer::new(Arithmetic::Exact).trace(&ray, &alone).map(|hit| f64::from(hit.t));
            tally.asked += 1;
            match (double::ask::<f64>(ray.eye, ray.dir, sphere), t) {
                (Answer::Undecided, _) => tally.undecided += 1,
                (Answer::Miss, None) => {}
                // t is rounded to f32, so half an ulp beyond the interval is no contradiction.
                (Answer::Hit([lo, hi]), Some(t)) if around(lo, hi, t) => {}
                (answer, t) => panic!("f64 says {answer:?} of {sphere:?}, the truth is {t:?}; {}", replay()),
            }
        }
    }
    tally
}

#[allow(clippy::cast_possible_truncation, reason = "as t is rounded")]
fn around(lo: f64, hi: f64, t: f64) -> bool {
    f64::from(lo as f32) <= t && t <= f64::from(hi as f32)
}

/// `CGT_CERTIFIED_RAYS` directed rays of every kind, a million every day, in turn at every level.
#[test]
fn certified_is_exact_where_decisions_are_close() {
    let (seed, rays, levels) = (seed(), count("CGT_CERTIFIED_RAYS", 1_000_000), Level::available());
    let cases = rays.div_ceil(LANES as u64);
    eprintln!("CGT_SEED={seed}, {cases} cases of {LANES} rays");
    let tallies = (0..cases).into_par_iter().map(|i| {
        let kind = KINDS[usize::try_from(i).expect("fits") % KINDS.len()];
        BTreeMap::from([(kind, judge(kind, seed, i, &levels))])
    });
    let tallies = tallies.reduce(BTreeMap::new, |mut all, one| {
        for (kind, tally) in one {
            let sum: &mut Tally = all.entry(kind).or_default();
            *sum = *sum + tally;
        }
        all
    });
    assert_eq!(tallies.len(), KINDS.len(), "a kind was not judged");
    for (kind, tally) in &tallies {
        eprintln!("{kind:?}: {tally:?}");
        assert!(tally.hits > tally.rays / 50, "{kind:?}: hardly a hit, nothing is at stake");
        // Exactly on a surface nothing but integers can tell.
        assert!(tally.undecided < tally.asked || *kind == Kind::OnSurface, "{kind:?}: f64 decides nothing");
    }
    let all = tallies.values().fold(Tally::default(), |sum, tally| sum + *tally);
    let Counts { lanes, asked_f64, asked_integers, rounded_by_integers, .. } = all.counts;
    assert!(asked_f64 > rays / 20 && asked_f64 < lanes * 19 / 20, "{all:?}: f32 decides all or nothing");
    assert!(asked_integers > rays / 100 && asked_integers < asked_f64 * 19 / 20, "{all:?}");
    assert!(rounded_by_integers > rays / 10_000, "{all:?}: hardly a t is close to a rounding boundary");
}

/// Outside the range for which the bound is derived f32 decides nothing.
#[test]
fn the_bound_knows_its_range() {
    let (far, rule) = (2f32.powi(41), Rule::new(NEAREST));
    for (farthest, radius) in [(far, 1.0), (1.0, 1.0 / far), (f32::INFINITY, 1.0), (1.0, far)] {
        assert_eq!(rule.bound(farthest, radius), Bound::NONE, "{farthest:?}, {radius:?}");
    }
    assert_ne!(rule.bound(1e6, 1e-6), Bound::NONE);
}

/// A plan without certainty on the same rays is wrong on some, or nothing was close.
#[test]
fn rounding_alone_is_not_enough() {
    let (seed, mut wrong) = (seed(), 0);
    let plan = Plan::safe();
    for i in 0..2000 {
        let case = case(Kind::NearEqualRoots, &mut generator(seed, i));
        let scene = Scene::new(case.spheres.clone(), [0; 3], DEFAULT_LIGHT).expect("valid by construction");
        let seen = Seen::without_grid(Scalar, plan, scene.spheres(), case.ray.eye);
        let (t, id, _) = Trace(&seen, &scene, case.ray.dir.map(|d| [d; LANES])).on(Scalar);
        let given = (id[0] != NONE).then(|| (id[0].unsigned_abs(), t[0].to_bits()));
        wrong += u32::from(given != truth(&case.ray, &scene));
    }
    assert!(wrong > 100, "{wrong} of 2,000 wrong, CGT_SEED={seed}");
}
