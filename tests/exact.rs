//! Is the truth true? The filtered exact tracer against the unfiltered one, and both against answers that are
//! known by construction.

use contract::{Camera, DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
use rand::RngExt;
use rayon::prelude::*;
use reference::{Arithmetic, Hit, Ray, Tracer, Undecided};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU32, Ordering};
use verify::directed::{KINDS, Kind, aimed, case};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::{count, generator, seed};

/// All but the one that asks integers everything.
const FILTERED: [Arithmetic; 6] = [
    Arithmetic::Exact,
    Arithmetic::F64,
    Arithmetic::F32Textbook,
    Arithmetic::F32Perpendicular,
    Arithmetic::SpuTextbook,
    Arithmetic::SpuPerpendicular,
];

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
    let bits = |hit: Option<Hit>| hit.map(|hit| (hit.id, hit.t.to_bits()));
    let replay = format!("case {i} of CGT_SEED={seed}: {case:?}");
    assert_eq!(bits(filtered), bits(unfiltered), "filtered, unfiltered; {replay}");
    if let Some(known) = case.known {
        let known = known.map(|(id, t)| (id, t.to_bits()));
        assert_eq!(bits(unfiltered), known, "unfiltered, known; {replay}");
    }
    Tally { cases: 1, hits: u64::from(filtered.is_some()), known: u64::from(case.known.is_some()), undecided }
}

/// Among so many spheres that most are tried eight at once, a ray finds what it finds of each alone: the nearest, and of equal ones the first.
#[test]
fn eight_at_once_are_each_tried() {
    let (seed, mut in_eights, mut after, mut ties) = (seed(), 0, 0, 0);
    for arithmetic in FILTERED {
        let find = |ray: &Ray, spheres: Vec<Sphere>| {
            let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
            Tracer::new(arithmetic).trace(ray, &scene)
        };
        for i in 0..3_000 {
            let mut rng = generator(seed, i);
            let mut whole = |range: std::ops::RangeInclusive<i8>| f32::from(rng.random_range(range));
            let ray =
                Ray { eye: [whole(-3..=3), whole(-3..=3), -30.0], dir: [whole(-2..=2), whole(-2..=2), 8.0] };
            let n = whole(0..=40) as usize;
            let spheres = (0..n).map(|_| Sphere {
                center: [0; 3].map(|_| whole(-9..=9)),
                radius: whole(1..=3),
                color: [9; 3],
            });
            let mut spheres: Vec<Sphere> = spheres.collect();
            // Every fourth is another once more.
            (3..n).step_by(4).for_each(|i| spheres[i] = spheres[rng.random_range(0..i)]);
            let alone = |(id, sphere): (u32, &Sphere)| find(&ray, vec![*sphere]).map(|hit| Hit { id, ..hit });
            let alone: Vec<Hit> = (0..).zip(&spheres).filter_map(alone).collect();
            let nearest = alone.iter().copied().reduce(|a, b| if b.t < a.t { b } else { a });
            let found = find(&ray, spheres.clone());
            let replay = format!("{arithmetic:?}, case {i} of CGT_SEED={seed}: {ray:?}, {spheres:?}");
            assert_eq!(found.map(|hit| hit.t.to_bits()), nearest.map(|hit| hit.t.to_bits()), "{replay}");
            let (Some(found), Some(nearest)) = (found, nearest) else { continue };
            let equal: Vec<u32> = alone.iter().filter(|hit| hit.t == nearest.t).map(|hit| hit.id).collect();
            // Two roots may be one number only once they are rounded at the end.
            let rounded_last = matches!(arithmetic, Arithmetic::Exact | Arithmetic::F64);
            let right = found.id == nearest.id || rounded_last && equal.contains(&found.id);
            assert!(right, "{found:?} is none of {equal:?}, or not the first: {replay}");
            *if (found.id as usize) < n / 8 * 8 { &mut in_eights } else { &mut after } += 1;
            ties += u64::from(equal.len() > 1);
        }
    }
    eprintln!("CGT_SEED={seed}: {in_eights} hits among eights, {after} after them, {ties} ties");
    assert!(in_eights > 2_000 && after > 500 && ties > 100, "{in_eights}, {after}, {ties}");
}

/// The picture does not depend on how many threads there are.
#[test]
fn threads_change_nothing() {
    let loaded = Source::parse("clump:300:9").and_then(|source| source.load()).expect("generated");
    let size = Some(Size::new(37, 25).expect("small"));
    let camera = Framing { size, ..Framing::default() }.camera(&loaded.animation).expect("in view");
    // Each sphere twice, so that orders are left undecided, and their number must not depend on threads either.
    let frame = &loaded.animation.frames()[0];
    let spheres = [frame.spheres(), frame.spheres()].concat();
    let scene = &Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
    for arithmetic in FILTERED {
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

/// The variable that says that the test below is run with little memory.
const LITTLE_MEMORY: &str = "CGT_LITTLE_MEMORY";

/// Asks for more threads than there is room for their stacks; run by the next test with so little.
#[test]
fn too_many_threads_are_asked_for() {
    if std::env::var_os(LITTLE_MEMORY).is_some() {
        let scene = Scene::new(vec![], [0; 3], DEFAULT_LIGHT).expect("empty");
        let size = Size::new(3, 17).expect("small");
        let camera = Camera::new([0.0; 3], [-1.0, 1.0, -1.0], [0.5, 0.0, 0.0], [0.0, -0.1, 0.0], size);
        let tracer = Tracer::new(Arithmetic::Exact).threads(5_000);
        let error = tracer.render(&scene, &camera.expect("a camera")).expect_err("more than there can be");
        eprintln!("asked for 5000: {error}");
    }
}

/// Threads that cannot be had are refused with the number that was asked for. Stacks of 2 GiB in 8 GiB: one of the first has no
/// room, and all else has, which small stacks that fill up everything would not leave it.
#[test]
#[cfg(target_os = "linux")]
fn threads_that_cannot_be_had_are_refused() {
    let script = "ulimit -v 8388608 && exec \"$0\" --exact too_many_threads_are_asked_for --nocapture";
    let mut child = std::process::Command::new("sh");
    child.args(["-c", script]).arg(std::env::current_exe().expect("this program"));
    child.env(LITTLE_MEMORY, "1").env("RUST_MIN_STACK", (2u64 << 30).to_string());
    let output = child.output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("cannot start 5000 threads: "), "{said}");
}

/// Each row is told once, by whatever thread.
#[test]
fn every_row_is_told() {
    let scene = Scene::new(vec![], [0; 3], DEFAULT_LIGHT).expect("empty");
    let size = Size::new(3, 17).expect("small");
    let camera = Camera::new([0.0; 3], [-1.0, 1.0, -1.0], [0.5, 0.0, 0.0], [0.0, -0.1, 0.0], size);
    let camera = camera.expect("a camera");
    for threads in [0, 1, 3] {
        let rows = AtomicU32::new(0);
        let row_done = || {
            rows.fetch_add(1, Ordering::Relaxed);
        };
        let tracer = Tracer::new(Arithmetic::Exact).threads(threads);
        tracer.render_with(&scene, &camera, &row_done).expect("small");
        assert_eq!(rows.into_inner(), 17, "{threads} threads");
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

/// The sums of rule 5, each step in f64: D, a (|f|² + r²), and t if there is one. `fused` has D with one rounding less.
fn textbook(ray: &Ray, sphere: &Sphere, fused: bool) -> (f64, f64, Option<f64>) {
    let [d, eye, center] = [ray.dir, ray.eye, sphere.center].map(|v| v.map(f64::from));
    let r = f64::from(sphere.radius);
    let f = [eye[0] - center[0], eye[1] - center[1], eye[2] - center[2]];
    let dot = |u: [f64; 3], v: [f64; 3]| (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2];
    let (a, b, ff) = (dot(d, d), dot(f, d), dot(f, f));
    let q = ff - r * r;
    let discriminant = if fused { b.mul_add(b, -(a * q)) } else { b * b - a * q };
    let s = discriminant.sqrt();
    let (near, far) = ((-b - s) / a, (-b + s) / a);
    let t = if near > 0.0 { near } else { far };
    (discriminant, a * (ff + r * r), (discriminant >= 0.0 && t > 0.0).then_some(t))
}

/// A ray towards the rim of a ball some 10⁷ radii away: roundings of D are all that decides.
fn towards_a_far_rim(seed: u64, i: u64) -> (Ray, Sphere) {
    let mut rng = generator(seed, i);
    let distance = 10f64.powf(rng.random_range(6.5..7.5));
    let case = aimed(distance, rng.random_range(0.5..1.5), &mut rng);
    (case.ray, case.spheres[0])
}

/// The filter says *certain miss* of a D that is below minus 32 units of a (|f|² + r²), which its derivation needs 21 of, and of no other: what it
/// leaves comes to the intervals, some of which do not know the sign.
#[test]
fn the_filter_has_the_bound_it_says() {
    let (seed, unit) = (seed(), f64::EPSILON / 2.0);
    let each = (0..100_000).into_par_iter().map(|i| {
        let (ray, sphere) = towards_a_far_rim(seed, i);
        let (discriminant, size, _) = textbook(&ray, &sphere, false);
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("a sphere");
        let mut undecided = Undecided::default();
        let _ = Tracer::new(Arithmetic::Exact).trace_counting(&ray, &scene, &mut undecided);
        match -discriminant / (size * unit) {
            within if (22.0..31.9).contains(&within) => [1, undecided.hits, 0, 0],
            beyond if (32.1..40.0).contains(&beyond) => [0, 0, 1, undecided.hits],
            _ => [0; 4],
        }
    });
    let sum = |x: [u64; 4], y: [u64; 4]| -> [u64; 4] { std::array::from_fn(|i| x[i] + y[i]) };
    let [within, open, beyond, told] = each.reduce(|| [0; 4], sum);
    eprintln!(
        "CGT_SEED={seed}: of {within} rays within the bound {open} are open, of {beyond} beyond {told}"
    );
    assert!(within > 1_000 && open > within / 5, "the filter decides within its bound: {open} of {within}");
    assert!(beyond > 1_000 && told == 0, "the filter leaves what is beyond its bound: {told} of {beyond}");
}

/// The form in f64 is rule 5 to the bit, where a fused step would show.
#[test]
fn f64_is_the_form_that_is_written() {
    let (seed, mut hits, mut others) = (seed(), 0u64, 0u64);
    for i in 0..20_000 {
        let (ray, sphere) = towards_a_far_rim(seed, i);
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("a sphere");
        #[allow(clippy::cast_possible_truncation, reason = "the one rounding of t that rule 5 prescribes")]
        let bits = |t: Option<f64>| t.map(|t| (t as f32).to_bits());
        let written = bits(textbook(&ray, &sphere, false).2);
        let given = Tracer::new(Arithmetic::F64).trace(&ray, &scene).map(|hit| hit.t.to_bits());
        assert_eq!(given, written, "case {i} of CGT_SEED={seed}: {ray:?}, {sphere:?}");
        hits += u64::from(given.is_some());
        others += u64::from(bits(textbook(&ray, &sphere, true).2) != written);
    }
    eprintln!("CGT_SEED={seed}: {hits} of 20000 hit, {others} would be others with a fused step");
    assert!(hits > 2_000 && others > 100, "too little was at stake: {hits}, {others}");
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

/// By rule 5 f64 rounds t after the nearest is chosen: of two roots that are one in f32 the lower one's sphere is seen, whatever its id.
#[test]
fn f64_compares_roots_before_they_are_rounded() {
    let ulp = f32::EPSILON;
    let ball = |radius| Sphere { center: [0.0, 0.0, 5.0], radius, color: [9; 3] };
    let ray = Ray { eye: [0.0; 3], dir: [0.0, 0.0, 1.0] };
    // The roots are 4 + 2⁻²³ and 4 + 2⁻²⁴, every step is exact.
    let [farther, nearer] = [ball(1.0 - ulp), ball(1.0 - ulp / 2.0)];
    for (spheres, id) in [([farther, nearer], 1), ([nearer, farther], 0)] {
        let scene = Scene::new(spheres.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
        for arithmetic in [Arithmetic::F64, Arithmetic::Exact, Arithmetic::ExactUnfiltered] {
            let hit = Tracer::new(arithmetic).trace(&ray, &scene).map(|hit| (hit.id, hit.t));
            assert_eq!(hit, Some((id, 4.0)), "{arithmetic:?}");
        }
    }
}

/// The eye is on one sphere's surface, so that its far root is known by integers alone and to a step of f32 either way; the other's root
/// lies between that one and the f32 it is rounded to, a sixth of a step from both.
#[test]
fn roots_within_a_step_of_each_other_are_told_apart() {
    let ray = Ray { eye: [0.0; 3], dir: [1.0; 3] };
    // Far roots 14/3 and 22/3, a third of a step above their f32 and as much below.
    for (center, radius, far, other_is_nearer) in
        [([3.0, 4.0, 0.0], 5.0, 14.0 / 3.0, true), ([2.0, 3.0, 6.0], 7.0, 22.0 / 3.0, false)]
    {
        let on_surface = Sphere { center, radius, color: [9; 3] };
        #[allow(clippy::cast_possible_truncation, reason = "it is rounded as t is")]
        let rounded = far as f32;
        let root = f64::midpoint(far, f64::from(rounded));
        let step = f64::from(rounded.next_up()) - f64::from(rounded);
        // Head on the near root is that of the centre less r / √3.
        #[allow(clippy::cast_possible_truncation, reason = "the rounding is a tenth of a step")]
        let other = {
            let at = (far * 4.0).round() / 4.0 + 0.25;
            Sphere { center: [at as f32; 3], radius: ((at - root) * 3f64.sqrt()) as f32, color: [9; 3] }
        };
        let off = f64::from(other.center[0]) - f64::from(other.radius) / 3f64.sqrt() - root;
        assert!(off.abs() < step / 10.0, "{off:e} off, of a step of {step:e}");
        for (spheres, id) in [
            ([on_surface, other], u32::from(other_is_nearer)),
            ([other, on_surface], u32::from(!other_is_nearer)),
        ] {
            let scene = Scene::new(spheres.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
            for arithmetic in [Arithmetic::ExactUnfiltered, Arithmetic::Exact] {
                let hit = Tracer::new(arithmetic).trace(&ray, &scene).map(|hit| (hit.id, hit.t));
                assert_eq!(hit, Some((id, rounded)), "{arithmetic:?}, {spheres:?}");
            }
        }
    }
}

/// A ray without direction hits nothing, from within a sphere and from its surface too.
#[test]
fn no_direction_hits_nothing() {
    for center in [[0.0; 3], [3.0, 4.0, 0.0], [30.0, 40.0, 0.0]] {
        let sphere = Sphere { center, radius: 5.0, color: [9; 3] };
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
        for dir in [[0.0; 3], [-0.0; 3]] {
            for arithmetic in [
                Arithmetic::Exact,
                Arithmetic::ExactUnfiltered,
                Arithmetic::F64,
                Arithmetic::F32Textbook,
                Arithmetic::F32Perpendicular,
                Arithmetic::SpuTextbook,
                Arithmetic::SpuPerpendicular,
            ] {
                let hit = Tracer::new(arithmetic).trace(&Ray { eye: [0.0; 3], dir }, &scene);
                assert_eq!(hit, None, "{arithmetic:?}, {center:?}");
            }
        }
    }
}
