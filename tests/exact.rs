//! Is the truth true? The filtered exact tracer against the unfiltered one, and both against answers that are
//! known by construction.

use contract::{DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
use rand::RngExt;
use rayon::prelude::*;
use reference::{Arithmetic, Ray, Tracer, Undecided};
use std::collections::BTreeMap;
use verify::directed::{KINDS, Kind, aimed, case};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::{count, generator, seed};

#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    cases: u64,
    hits: u64,
    known: u64,
    undecided: Undecided,
}

/// `CGT_EXACT_CASES` directed and random rays, 100,000 every day.
#[test]
fn filtered_and_unfiltered_decide_alike() {
    let (seed, cases) = (seed(), count("CGT_EXACT_CASES", 100_000));
    eprintln!("CGT_SEED={seed}, {cases} rays");
    let tallies = (0..cases).into_par_iter().map(|i| {
        let kind = KINDS[usize::try_from(i).expect("fits") % KINDS.len()];
        BTreeMap::from([(kind, judge(kind, seed, i))])
    });
    let tallies = tallies.reduce(BTreeMap::new, |mut all, one| {
        for (kind, tally) in one {
            let sum = all.entry(kind).or_insert(Tally::default());
            sum.cases += tally.cases;
            sum.hits += tally.hits;
            sum.known += tally.known;
            sum.undecided = sum.undecided + tally.undecided;
        }
        all
    });
    for (kind, tally) in &tallies {
        eprintln!("{kind:?}: {tally:?}");
        assert!(tally.hits > tally.cases / 50, "{kind:?}: hardly a hit, nothing is at stake");
    }
    assert_eq!(tallies.len(), KINDS.len(), "a kind was not judged");
    let all = tallies.values().fold(Undecided::default(), |sum, tally| sum + tally.undecided);
    let reached = [all.hits, all.orders, all.roundings];
    assert!(
        reached.iter().all(|&n| n >= cases / 1000),
        "a stage behind the filter was hardly reached: {all:?}"
    );
    assert!(tallies.values().map(|t| t.known).sum::<u64>() > cases / 4);
}

fn judge(kind: Kind, seed: u64, i: u64) -> Tally {
    let case = case(kind, &mut generator(seed, i));
    let scene = Scene::new(case.spheres.clone(), [0; 3], DEFAULT_LIGHT).expect("valid by construction");
    let mut undecided = Undecided::default();
    let filtered = Tracer::new(Arithmetic::Exact).trace_counting(&case.ray, &scene, &mut undecided);
    let unfiltered = Tracer::new(Arithmetic::ExactUnfiltered).trace(&case.ray, &scene);
    let bits = |hit: Option<reference::Hit>| hit.map(|hit| (hit.id, hit.t.to_bits()));
    let replay = format!("case {i} of CGT_SEED={seed}: {case:?}");
    assert_eq!(bits(filtered), bits(unfiltered), "filtered, unfiltered; {replay}");
    if let Some(known) = case.known {
        let known = known.map(|(id, t)| (id, t.to_bits()));
        assert_eq!(bits(unfiltered), known, "unfiltered, known; {replay}");
    }
    Tally { cases: 1, hits: u64::from(filtered.is_some()), known: u64::from(case.known.is_some()), undecided }
}

/// The picture does not depend on how many threads there are.
#[test]
fn threads_change_nothing() {
    let loaded = Source::parse("clump:300:9").and_then(|source| source.load()).expect("generated");
    let size = Some(Size::new(67, 45).expect("small"));
    let camera = Framing { size, ..Framing::default() }.camera(&loaded.animation).expect("in view");
    // Each sphere twice, so that orders are left undecided, and their number must not depend on threads either.
    let frame = &loaded.animation.frames()[0];
    let spheres = [frame.spheres(), frame.spheres()].concat();
    let scene = &Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
    for arithmetic in [
        Arithmetic::Exact,
        Arithmetic::F64,
        Arithmetic::F32Textbook,
        Arithmetic::F32Perpendicular,
        Arithmetic::SpuTextbook,
        Arithmetic::SpuPerpendicular,
    ] {
        let render =
            |threads| Tracer::new(arithmetic).threads(threads).render(scene, &camera).expect("small");
        let one = render(1);
        assert!(one.image.ids.iter().any(|&id| id != MISS), "nothing is seen");
        assert!(arithmetic != Arithmetic::Exact || one.undecided.orders > 100, "{:?}", one.undecided);
        for threads in [0, 2, 3, 8] {
            let other = render(threads);
            let bits = |t: &[f32]| t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
            assert_eq!(one.image.ids, other.image.ids, "{arithmetic:?}, {threads} threads");
            assert_eq!(bits(&one.image.t), bits(&other.image.t), "{arithmetic:?}, {threads} threads");
            assert_eq!(one.image.rgba, other.image.rgba, "{arithmetic:?}, {threads} threads");
            assert_eq!(one.undecided, other.undecided, "{arithmetic:?}, {threads} threads");
        }
    }
}

/// t halfway between two f32 goes to the one whose last bit is 0, be that below or above.
#[test]
fn ties_of_t_go_to_even() {
    let two24 = 16_777_216.0f32;
    let ray = Ray { eye: [0.0; 3], dir: [0.0, 0.0, 1.0] };
    for (radius, t) in [(two24 - 1.0, two24), (two24 - 3.0, two24 + 4.0)] {
        let sphere = Sphere { center: [0.0, 0.0, 2.0 * two24], radius, color: [9; 3] };
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
        for arithmetic in [Arithmetic::Exact, Arithmetic::ExactUnfiltered, Arithmetic::F64] {
            let hit = Tracer::new(arithmetic).trace(&ray, &scene).expect("head on");
            assert_eq!(hit.t, t, "{arithmetic:?}, radius {radius}");
        }
    }
}

/// Where every step is exact in f64, the f64 form must give the known answer: roots, surfaces, tangents and ties.
#[test]
fn f64_is_exact_on_the_lattice() {
    let kinds = [Kind::Tangent, Kind::Inside, Kind::OnSurface, Kind::Coincident, Kind::EqualRoots];
    let (seed, cases) = (seed(), 10_000);
    eprintln!("CGT_SEED={seed}, {cases} rays of each kind");
    for kind in kinds {
        for i in 0..cases {
            let case = case(kind, &mut generator(seed, i));
            let scene =
                Scene::new(case.spheres.clone(), [0; 3], DEFAULT_LIGHT).expect("valid by construction");
            let hit = Tracer::new(Arithmetic::F64).trace(&case.ray, &scene).map(|hit| (hit.id, hit.t));
            assert_eq!(Some(hit), case.known, "case {i} of CGT_SEED={seed}: {case:?}");
        }
    }
}

/// Rays within a part in 10¹⁰ of a radius of the rim of spheres 10⁵ to 10⁷ radii away, where f64 alone calls some hits misses.
#[test]
fn the_filter_needs_its_bound_far_away() {
    let (seed, cases) = (seed(), count("CGT_FAR_CASES", 100_000));
    let each = (0..cases).into_par_iter().map(|i| {
        let mut rng = generator(seed, i);
        let distance = 10f64.powf(rng.random_range(5.0..7.0));
        let impact = 1.0 + distance * distance * 1e-16 * rng.random_range(-4.0..4.0);
        let case = aimed(distance, impact, &mut rng);
        let scene = Scene::new(case.spheres[..1].to_vec(), [0; 3], DEFAULT_LIGHT).expect("a sphere");
        let trace = |arithmetic| Tracer::new(arithmetic).trace(&case.ray, &scene);
        let (exact, unfiltered) = (trace(Arithmetic::Exact), trace(Arithmetic::ExactUnfiltered));
        assert_eq!(exact, unfiltered, "filtered, unfiltered; case {i} of CGT_SEED={seed}: {case:?}");
        [u64::from(exact.is_some()), u64::from(exact.is_some() != trace(Arithmetic::F64).is_some())]
    });
    let [hits, differ] = each.reduce(|| [0; 2], |x, y| [x[0] + y[0], x[1] + y[1]]);
    eprintln!("CGT_SEED={seed}: {cases} rays, {hits} hits, f64 differs in {differ}");
    assert!(hits > cases / 10 && hits < cases * 9 / 10 && differ > 20, "too little was at stake");
}

/// Rays that graze a sphere from within 10⁻¹³ radii of its surface, at any size: eye − centre is as long as the radius there, and the bound must count both.
#[test]
fn the_filter_needs_its_bound_at_a_surface() {
    let (seed, cases) = (seed(), count("CGT_SURFACE_CASES", 100_000));
    let each = (0..cases).into_par_iter().map(|i| {
        let mut rng = generator(seed, i);
        let scale = f32::from(rng.random_range(1..1000u16)) * 2f32.powi(rng.random_range(-40..40));
        // With the centre c = (3, 4, g) and d = (-4, 3, 1), D is zero at 52 c·eye = 25 g², but for higher powers of g.
        let g = 10f64.powf(rng.random_range(-8.5..-6.5)) * if rng.random() { 1.0 } else { -1.0 };
        let inward = g * g * rng.random_range(0.40..0.56) / 25.0;
        #[allow(clippy::cast_possible_truncation, reason = "made in f64, rounded once")]
        let scaled = |v: [f64; 3]| v.map(|x| x as f32 * scale);
        let sphere = Sphere { center: scaled([3.0, 4.0, g]), radius: 5.0 * scale, color: [9; 3] };
        let ray = Ray { eye: scaled([3.0 * inward, 4.0 * inward, 0.0]), dir: [-4.0, 3.0, 1.0] };
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("a sphere");
        let trace = |arithmetic| Tracer::new(arithmetic).trace(&ray, &scene);
        let (exact, unfiltered) = (trace(Arithmetic::Exact), trace(Arithmetic::ExactUnfiltered));
        assert_eq!(
            exact, unfiltered,
            "filtered, unfiltered; case {i} of CGT_SEED={seed}: {ray:?}, {scene:?}"
        );
        [u64::from(exact.is_some()), u64::from(exact.is_some() != trace(Arithmetic::F64).is_some())]
    });
    let [hits, differ] = each.reduce(|| [0; 2], |x, y| [x[0] + y[0], x[1] + y[1]]);
    eprintln!("CGT_SEED={seed}: {cases} rays, {hits} hits, f64 differs in {differ}");
    assert!(hits > cases / 10 && hits < cases * 9 / 10 && differ > cases / 100, "too little was at stake");
}

/// Rays that leave a ball's middle behind, from 10⁻⁶ to 10⁻²⁷ radii inside its surface, on it or outside: whoever is inside sees the surface, and
/// nobody else, however little that is.
#[test]
fn just_inside_a_surface_it_is_seen() {
    let (seed, cases) = (seed(), count("CGT_SURFACE_CASES", 100_000));
    let each = (0..cases).into_par_iter().map(|i| {
        let mut rng = generator(seed, i);
        let scale = f32::from(rng.random_range(1..1000u16)) * 2f32.powi(rng.random_range(-40..40));
        // The surface goes through the origin, and its normal there is (3, 4, 0).
        let sphere = Sphere { center: [-3.0 * scale, -4.0 * scale, 0.0], radius: 5.0 * scale, color: [9; 3] };
        let sign = [-1.0f32, 0.0, 1.0][rng.random_range(0..3)];
        let off = sign * 2f32.powi(rng.random_range(-90..-20)) * scale;
        let [along, up] = [(); 2].map(|()| rng.random_range(-1.0f32..1.0));
        let dir = [3.0 - 4.0 * along, 4.0 + 3.0 * along, up];
        let ray = Ray { eye: [3.0 * off, 4.0 * off, 0.0], dir };
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("a sphere");
        for arithmetic in [Arithmetic::Exact, Arithmetic::ExactUnfiltered] {
            let seen = Tracer::new(arithmetic).trace(&ray, &scene).is_some();
            let replay = || format!("{arithmetic:?}: case {i} of CGT_SEED={seed}: {ray:?}, {scene:?}");
            assert_eq!(seen, sign < 0.0, "seen, inside; {}", replay());
        }
        u64::from(sign < 0.0)
    });
    let inside: u64 = each.sum();
    assert!(
        inside > cases / 4 && inside < cases / 2,
        "{inside} of {cases} are inside: too little was at stake"
    );
}

/// Where no decision is close the filters decide, and integers are hardly asked.
#[test]
fn integers_are_hardly_asked_where_nothing_is_close() {
    let seed = seed();
    let loaded =
        Source::parse(&format!("uniform:300:{seed}")).and_then(|source| source.load()).expect("generated");
    let size = Some(Size::new(320, 180).expect("small"));
    let camera = Framing { size, ..Framing::default() }.camera(&loaded.animation).expect("in view");
    let rendering =
        Tracer::new(Arithmetic::Exact).render(&loaded.animation.frames()[0], &camera).expect("small");
    let hits = rendering.image.ids.iter().filter(|&&id| id != MISS).count();
    assert!(hits > 10_000, "CGT_SEED={seed}: {hits} pixels hit, nothing is at stake");
    let Undecided { hits, orders, roundings } = rendering.undecided;
    assert!(hits + orders + roundings < 20, "CGT_SEED={seed}: {:?} of 57,600 rays", rendering.undecided);
}
