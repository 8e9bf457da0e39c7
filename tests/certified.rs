//! Is the certified arithmetic right where decisions are close, and is each of its stages needed? Directed rays against the exact
//! reference, every stage reached; each stage alone against what it must not say.

use contract::{DEFAULT_LIGHT, Scene, Sphere};
use num_bigint::{BigInt, Sign};
use optimized::bound::{Bound, NEAREST, Rule};
use optimized::camera::Block;
use optimized::double::{self, Answer};
use optimized::host::{Scalar, Work};
use optimized::integer::Wide;
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

/// Outside the range for which the bound is derived f32 decides nothing, and within it something: up to 2⁴⁰ away, for radii from 2⁻⁴⁰ to 2⁴⁰.
#[test]
fn the_bound_knows_its_range() {
    let (limit, rule) = (2f32.powi(40), Rule::new(NEAREST));
    let least = limit.recip();
    for (farthest, radius) in
        [(limit, 1.0), (1.0, limit), (1.0, least), (0.0, limit), (limit, least), (1e6, 1e-6)]
    {
        assert_ne!(rule.bound(farthest, radius), Bound::NONE, "{farthest:e}, {radius:e}");
    }
    for (farthest, radius) in [
        (limit.next_up(), 1.0),
        (1.0, limit.next_up()),
        (1.0, least.next_down()),
        (f32::INFINITY, 1.0),
        (1.0, f32::NAN),
    ] {
        assert_eq!(rule.bound(farthest, radius), Bound::NONE, "{farthest:e}, {radius:e}");
    }
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

/// t halfway between two f32 goes to the one whose last bit is 0, by the integers and by all stages together.
#[test]
fn ties_of_t_go_to_even() {
    let two24 = 16_777_216.0f32;
    let (eye, dir) = ([0.0; 3], [0.0, 0.0, 1.0]);
    for (radius, t) in [(two24 - 1.0, two24), (two24 - 3.0, two24 + 4.0)] {
        let sphere = Sphere { center: [0.0, 0.0, 2.0 * two24], radius, color: [9; 3] };
        assert_eq!(exact::nearest(eye, dir, std::iter::once((0, &sphere))), Some((0, t)), "radius {radius}");
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
        let seen = Seen::without_grid(Scalar, Plan::fast(), scene.spheres(), eye);
        for level in Level::available() {
            let (found, id, counts) = level.run(Trace(&seen, &scene, dir.map(|d| [d; LANES])));
            assert_eq!((found[0], id[0]), (t, 0), "{level}, radius {radius}");
            assert!(counts.rounded_by_integers + counts.asked_integers > 0, "{level}: {counts:?}");
        }
    }
}

/// Beside a grazing ray of the least numbers there are f64 rounds the cross product by a ninth, since it holds it in 53 bits: eye − centre is
/// (2⁵³ + 1, 2⁵³ + 19, 0) times 2⁻¹⁴⁹, the ball's radius 13 of these, and D = 2 · 13² − 18² = 14. Rounded it is 2 · 13² − 20², whose bound is a product
/// that the range of f64 does not hold, but for roots taken first.
#[test]
fn the_least_numbers_leave_f64_its_bound() {
    let (least, far) = (f32::from_bits(1), 2f32.powi(-96));
    let eye = [far, far, 0.0];
    let dir = [-least, -least, 0.0];
    let ball = |times: [f32; 2], radius| Sphere {
        center: [-times[0] * least, -times[1] * least, 0.0],
        radius: radius * least,
        color: [9; 3],
    };
    // The last is passed by: 2 · 13² − 19² is below zero.
    for (sphere, hit) in
        [(ball([1.0, 19.0], 13.0), true), (ball([19.0, 1.0], 13.0), true), (ball([1.0, 20.0], 13.0), false)]
    {
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
        let expected = truth(&Ray { eye, dir }, &scene);
        assert_eq!(expected.is_some(), hit, "the reference; {sphere:?}");
        let asked = double::ask::<f64>(eye, dir, &sphere);
        assert!(
            asked == Answer::Undecided || matches!(asked, Answer::Hit(_)) == hit,
            "f64 says {asked:?} of {sphere:?}, which is {}",
            if hit { "hit" } else { "missed" }
        );
        let seen = Seen::without_grid(Scalar, Plan::fast(), scene.spheres(), eye);
        for level in Level::available() {
            let (t, id, _) = level.run(Trace(&seen, &scene, dir.map(|d| [d; LANES])));
            let given = (id[0] != NONE).then(|| (id[0].unsigned_abs(), t[0].to_bits()));
            assert_eq!(expected, given, "exact, certified; {level}, {sphere:?}");
        }
    }
}

/// Along (0, 0, 0) nothing is hit, from within a sphere and from its surface too; integers say so, and f64 says nothing else.
#[test]
fn no_direction_hits_nothing() {
    for center in [[0.0; 3], [3.0, 4.0, 0.0], [30.0, 40.0, 0.0]] {
        let sphere = Sphere { center, radius: 5.0, color: [9; 3] };
        for dir in [[0.0; 3], [-0.0; 3]] {
            let found = exact::nearest([0.0; 3], dir, std::iter::once((0, &sphere)));
            assert_eq!(found, None, "{center:?}");
            let asked = double::ask::<f64>([0.0; 3], dir, &sphere);
            assert!(!matches!(asked, Answer::Hit(_)), "f64 says {asked:?} of {center:?}");
        }
    }
}

/// The number with these limbs, the lowest first, in both libraries. Pieces do not overlap, so no sum carries.
fn both(limbs: &[u64], negative: bool) -> (Wide, BigInt) {
    let (mut wide, mut big) = (Wide::ZERO, BigInt::ZERO);
    for (i, limb) in (0u32..).zip(limbs) {
        for (half, shift) in [(limb & 0xffff_ffff, 64 * i), (limb >> 32, 64 * i + 32)] {
            let half = i64::try_from(half).expect("32 bits");
            wide = wide.add(&Wide::new(half, shift));
            big += BigInt::from(half) << shift;
        }
    }
    if negative { (wide.negated(), -big) } else { (wide, big) }
}

/// That number in the integers of `optimized`.
fn wide(big: &BigInt) -> Wide {
    let (sign, limbs) = big.to_u64_digits();
    both(&limbs, sign == Sign::Minus).0
}

/// Sums, differences and products of integers whose limbs are all zeros, all ones, the same in both, or anything, up to the capacity.
#[test]
fn whole_numbers_are_those_of_another_library() {
    let (seed, cases) = (seed(), count("CGT_WIDE_CASES", 30_000));
    eprintln!("CGT_SEED={seed}, {cases} pairs");
    let each = (0..cases).into_par_iter().map(|i| {
        let mut rng = generator(seed, i);
        let limb = |rng: &mut _| match RngExt::random_range(rng, 0..4) {
            0 => 0,
            1 => u64::MAX,
            2 => 1u64 << RngExt::random_range(rng, 0..64),
            _ => RngExt::random(rng),
        };
        let lengths = [rng.random_range(0..=14), rng.random_range(0..=14)];
        let mut x: Vec<u64> = (0..lengths[0]).map(|_| limb(&mut rng)).collect();
        let y: Vec<u64> = (0..lengths[1]).map(|_| limb(&mut rng)).collect();
        for (x, y) in x.iter_mut().zip(&y) {
            *x = if rng.random_range(0..3) == 0 { *y } else { *x };
        }
        let ((p, a), (q, b)) = (both(&x, rng.random()), both(&y, rng.random()));
        for (what, found, expected) in
            [("sum", p.add(&q), &a + &b), ("difference", p.sub(&q), &a - &b), ("product", p.mul(&q), &a * &b)]
        {
            // A product takes up the limbs in use alone.
            let off = found.mul(&Wide::new(1, 0)).sub(&wide(&expected)).sign();
            let signs = (found.sign(), expected.cmp(&BigInt::ZERO));
            assert!(
                off.is_eq() && signs.0 == signs.1,
                "{what} of {x:x?} and {y:x?}: {signs:?}, CGT_SEED={seed}"
            );
        }
        u64::from(lengths == [14, 14])
    });
    let full: u64 = each.sum();
    eprintln!("{full} products as long as there is room");
    assert!(full > cases / 1000, "too little was at stake");
}
