//! Is the judge's own ruler right, and no longer than it need be? Where its bands begin and end, found by bisection, is held against the
//! sums that `judge::band` derives, written down here from its text.

use contract::{DEFAULT_LIGHT, Scene, Sphere};
use rand::RngExt;
use rayon::prelude::*;
use reference::{Arithmetic, Ray, Tracer};
use verify::directed::{KINDS, aimed, case};
use verify::judge::band::{Band, Open, band, embree_band};
use verify::seed::{count, generator, seed};
use verify::subject::Rounding;

const U: f64 = 1.0 / (1u64 << 24) as f64;
const V: f64 = 1.0 / (1u64 << 53) as f64;

/// A form: how its band is asked for, and the constants of its derivation.
struct Form {
    name: &'static str,
    band: fn(&Ray, &Sphere) -> Option<Band>,
    constants: Constants,
    unit: f64,
}

#[derive(Clone, Copy)]
enum Constants {
    Textbook,
    /// Errors of h and of the root in units, and the second-order term of |l|²; and whether a search comes before it.
    Perpendicular {
        h: f64,
        root: f64,
        second: f64,
        search: bool,
    },
}

const NAIVE: Constants = Constants::Perpendicular { h: 10.0, root: 4.0, second: 170.0, search: false };
const EMBREE: Constants = Constants::Perpendicular { h: 13.0, root: 6.0, second: 256.0, search: true };

const FORMS: [Form; 6] = [
    Form {
        name: "textbook, f64",
        band: |ray, sphere| band(Rounding::TextbookF64, ray, sphere),
        constants: Constants::Textbook,
        unit: V,
    },
    Form {
        name: "textbook, f32",
        band: |ray, sphere| band(Rounding::TextbookF32, ray, sphere),
        constants: Constants::Textbook,
        unit: U,
    },
    Form {
        name: "perpendicular, f32",
        band: |ray, sphere| band(Rounding::PerpendicularF32, ray, sphere),
        constants: NAIVE,
        unit: U,
    },
    Form {
        name: "textbook, SPU",
        band: |ray, sphere| band(Rounding::TextbookSpu, ray, sphere),
        constants: Constants::Textbook,
        unit: 8.0 * U,
    },
    Form {
        name: "perpendicular, SPU",
        band: |ray, sphere| band(Rounding::PerpendicularSpu, ray, sphere),
        constants: NAIVE,
        unit: 8.0 * U,
    },
    Form { name: "Embree's sphere points", band: embree_band, constants: EMBREE, unit: U },
];

impl Form {
    /// How far r² − L² may be off for r = 1, by F, L and the centre's largest coordinate, and how much of it a search may lose on top.
    fn error(&self, far: f64, l: f64, corner: f64) -> [f64; 2] {
        let u = self.unit;
        match self.constants {
            Constants::Textbook => [1.02 * 21.0 * (u + V) * (far * far + 1.0), 0.0],
            Constants::Perpendicular { second, search, .. } => {
                let first = u * (6.0 * l * far + 4.0 * l * l + 2.0);
                let error = 1.02 * (first + second * u * u * far * far);
                let lost = 1.02 * U * ((corner + 1.0) + (far + 1.0));
                [error, if search { 2.0 * lost } else { 0.0 }]
            }
        }
    }

    /// How far a root may be off, to first order, for F, |d|, the half chord s in units of length, the error of r² − L², and t.
    fn error_of_t(&self, far: f64, n: f64, half: f64, error: f64, t: f64) -> f64 {
        let of_root = error / (2.0 * half * n);
        match self.constants {
            Constants::Textbook => {
                let u = self.unit + V;
                1.02 * (4.0 * u * far / n + u * half / n + 5.0 * u * t) + of_root + U * t
            }
            Constants::Perpendicular { h, root, .. } => {
                1.02 * self.unit * (h * far / n + root * half / n + t) + of_root + U * t
            }
        }
    }
}

/// A ray that passes the centre (1, 0, −z) of a unit sphere, scaled, at 1 − e.
fn passing(e: f32, z: f32, scale: f32) -> (Ray, Sphere) {
    let ray = Ray { eye: [e * scale, 0.0, 0.0], dir: [0.0, 0.0, -1.0] };
    (ray, Sphere { center: [scale, 0.0, -z * scale], radius: scale, color: [9; 3] })
}

/// The largest e for which something is not so, which is so from there on.
fn last(mut lo: f32, mut hi: f32, so: impl Fn(f32) -> bool) -> f64 {
    assert!(!so(lo) && so(hi), "it does not change between {lo} and {hi}");
    loop {
        let middle = ((f64::from(lo) + f64::from(hi)) / 2.0) as f32;
        if middle <= lo || middle >= hi {
            return f64::from(lo);
        }
        *if so(middle) { &mut hi } else { &mut lo } = middle;
    }
}

/// By r² − L² at which a hit begins to be explained, and at which a miss ceases to be: each is the error of D, beside the sphere, at some
/// distance, and where the second-order term counts.
#[test]
fn a_hit_is_open_as_far_as_the_error_of_the_discriminant() {
    for form in &FORMS {
        for z in [0.0f32, 1.0, 30.0, 1000.0, 1e6] {
            for scale in [1.0f32, 0.125, 512.0] {
                let what = format!("{}, {z} radii ahead, times {scale}", form.name);
                let far = |e: f64| (f64::from(z) * f64::from(z) + (1.0 - e) * (1.0 - e)).sqrt();
                let ask = |e: f32| {
                    let (ray, sphere) = passing(e, z, scale);
                    (form.band)(&ray, &sphere).expect("in range")
                };
                // Beyond a tenth of the radius first order does not hold.
                let corner = f64::from(z.max(1.0));
                let [error, _] = form.error(far(0.0), 1.0, corner);
                if error > 0.1 {
                    continue;
                }
                // A root must be ahead to be seen: beside the sphere the far one is.
                let open = last(-0.9, 0.5, |e| ask(e).may_hit.is_some());
                let certain = last(-0.9, 0.5, |e| ask(e).must_hit.is_some());
                for (e, sign) in [(open, -1.0), (certain, 1.0)] {
                    let [error, lost] = form.error(far(e), 1.0 - e, corner);
                    let due = if sign < 0.0 { -error } else { error + lost };
                    let is = 1.0 - (1.0 - e) * (1.0 - e);
                    // In f64 the numbers themselves have but so many digits.
                    let room = 0.01 * due.abs() + 4.0 * V * far(e) * far(e);
                    if z == 0.0 && sign > 0.0 {
                        // The eye is in the rim: whether the hit is ahead is open as well.
                        assert!(is >= due - room, "{what}: certain from {is:e}, {due:e} is due");
                    } else {
                        assert!((is - due).abs() < room, "{what}: from {is:e} on, {due:e} is due");
                    }
                }
            }
        }
    }
}

/// Head on and off the middle, from without and within, with directions of several lengths: t is as wide as its parts.
#[test]
fn t_is_as_wide_as_the_errors_of_its_parts() {
    for form in &FORMS {
        for (z, l) in [(5.0f32, 0.0f32), (5.0, 0.6), (20.0, 0.6), (0.25, 0.5)] {
            for n in [1.0f32, 0.25, 8.0] {
                let what = format!("{}, {z} ahead, {l} off, |d| = {n}", form.name);
                let ray = Ray { eye: [0.0; 3], dir: [0.0, 0.0, -n] };
                let sphere = Sphere { center: [l, 0.0, -z], radius: 1.0, color: [9; 3] };
                let found = (form.band)(&ray, &sphere).expect("in range");
                let [z, l, n] = [z, l, n].map(f64::from);
                let (far, half) = (z.hypot(l), (1.0 - l * l).sqrt());
                let t = if far > 1.0 { z - half } else { z + half } / n;
                let [error, lost] = form.error(far, l, z.max(l));
                let [lo, hi] = found.may_hit.expect("it is hit").ends();
                let due = form.error_of_t(far, n, half, error, t);
                assert!(
                    ((hi - lo) / 2.0 / due - 1.0).abs() < 0.02,
                    "{what}: {} wide, {due:e} is due",
                    (hi - lo) / 2.0
                );
                assert!(
                    ((hi + lo) / 2.0 - t).abs() < 0.02 * due + 8.0 * V * t,
                    "{what}: {found:?} is not about {t}"
                );
                let latest = found.must_hit.expect("it is certain");
                let delay = form.error_of_t(far, n, half, error + lost, t) - due
                    + if lost > 0.0 { 4.0 * U * t } else { 0.0 };
                assert!(
                    (latest - hi - delay).abs() < 0.02 * due,
                    "{what}: {found:?}, {delay:e} later is due"
                );
            }
        }
    }
}

/// A sphere is seen from within by its far root, in its rim by either, and not from before it.
#[test]
fn what_lies_behind_is_not_hit() {
    let ask = |form: &Form, z: f32| {
        let ray = Ray { eye: [0.0; 3], dir: [0.0, 0.0, -1.0] };
        (form.band)(&ray, &Sphere { center: [0.0, 0.0, -z], radius: 1.0, color: [9; 3] }).expect("in range")
    };
    for form in &FORMS {
        let nothing = Band { may_hit: None, must_hit: None };
        assert_eq!([-5.0, -1.01].map(|z| ask(form, z)), [nothing; 2], "{}: behind the eye", form.name);
        for z in [-0.99f32, 0.0, 0.99] {
            let Band { may_hit: Some(open), must_hit: Some(latest) } = ask(form, z) else {
                panic!("{}: from within, {z}: {:?}", form.name, ask(form, z))
            };
            let [lo, hi] = open.ends();
            let t = f64::from(z) + 1.0;
            assert!(lo < t && t < hi && hi - lo < 1e-4 && latest >= hi, "{}: from within, {z}", form.name);
        }
        // On the rim, looking inward: 0 is no hit, and 2 is one, and nothing between is either; looking outward, a hit so near may be
        // found and need not be.
        let inward = ask(form, 1.0);
        let open = inward.may_hit.expect("something is hit");
        let [lo, hi] = open.ends();
        assert!(
            lo < 1e-6 && hi > 2.0 && inward.must_hit.is_some_and(|t| t >= 2.0),
            "{}: {inward:?}",
            form.name
        );
        let held = [1e-3, 0.5, 1.0, 1.5, 1.999, 2.0].map(|t| open.holds(t));
        assert_eq!(held, [false, false, false, false, false, true], "{}: {open:?}", form.name);
        let outward = ask(form, -1.0);
        let [error, _] = form.error(1.0, 0.0, 1.0);
        let due = form.error_of_t(1.0, 1.0, 1.0, error, 0.0);
        let near = outward.may_hit.is_some_and(|open| (open.ends()[1] / due - 1.0).abs() < 0.02);
        assert!(near && outward.must_hit.is_none(), "{}: {outward:?}, {due:e} is due", form.name);
    }
}

/// Lengths and directions times powers of two change t, and nothing else.
#[test]
fn bands_go_with_the_scale() {
    let (seed, cases) = (seed(), count("CGT_RULER_CASES", 100_000));
    let stated: u64 = (0..cases)
        .into_par_iter()
        .map(|i| {
            let mut rng = generator(seed, i);
            let kind = KINDS[rng.random_range(0..KINDS.len())];
            let case = case(kind, &mut rng);
            let by = [0; 2].map(|_| rng.random_range(-12..=12));
            let [length, direction] = by.map(|e| 2f32.powi(e));
            let ball = case.spheres[0];
            let sphere =
                Sphere { center: ball.center.map(|x| x * length), radius: ball.radius * length, ..ball };
            let ray = Ray { eye: case.ray.eye.map(|x| x * length), dir: case.ray.dir.map(|x| x * direction) };
            let times = 2f64.powi(by[0] - by[1]);
            // Nothing may be lost of what is below the least normal number or beyond the largest.
            let exact = |x: f32, by: f32| x * by / by == x;
            let lengths = ball.center.into_iter().chain(case.ray.eye).chain([ball.radius]);
            if !lengths.into_iter().all(|x| exact(x, length))
                || !case.ray.dir.iter().all(|x| exact(*x, direction))
            {
                return 0;
            }
            let mut stated = 0;
            for form in &FORMS {
                let bands = [(form.band)(&case.ray, &ball), (form.band)(&ray, &sphere)];
                let [Some(one), Some(other)] = bands else { continue };
                // Below this the least f32 counts, which has no scale, or what is not flushed.
                let ranges = |band: Band| band.may_hit.map_or([None; 2], |Open(ranges)| ranges);
                let ends = |band: Band| ranges(band).into_iter().flatten().flatten().chain(band.must_hit);
                if ends(one).chain(ends(other)).any(|t| t != 0.0 && t.abs() < 1e-24) {
                    continue;
                }
                stated += 1;
                let same = |x: f64, y: f64| x * times == y || [x, y].contains(&f64::INFINITY);
                let alike = ranges(one).into_iter().zip(ranges(other)).all(|roots| match roots {
                    (Some(x), Some(y)) => same(x[0], y[0]) && same(x[1], y[1]),
                    (x, y) => x.is_none() && y.is_none(),
                }) && match (one.must_hit, other.must_hit) {
                    (Some(x), Some(y)) => same(x, y),
                    (x, y) => x.is_none() && y.is_none(),
                };
                assert!(
                    alike,
                    "{}: {one:?}, times {times} {other:?}; case {i} of CGT_SEED={seed}: {case:?}, by {by:?}",
                    form.name
                );
            }
            stated
        })
        .sum();
    assert!(stated > cases, "CGT_SEED={seed}: {stated} bands, hardly any");
}

/// Each end of the range in which something is stated, within a factor of two on the input.
#[test]
fn nothing_is_stated_beyond_the_range_of_f32() {
    // |d|, F and r as powers of two, and whether each of the two f32 forms, the two of the SPU and Embree's states something.
    let rows: [([i32; 3], [bool; 3]); 15] = [
        ([0, 3, 0], [true; 3]),
        // a F² reaches 2¹²⁶.
        ([10, 52, 40], [true, true, true]),
        ([10, 53, 40], [false, false, false]),
        // F²/a does.
        ([-10, 52, 40], [true, true, true]),
        ([-10, 53, 40], [false, false, false]),
        // a r² is 2⁻¹⁰⁹, 2⁻⁶⁰, 2⁻⁸⁶.
        ([-10, 0, -44], [true, false, false]),
        ([-10, 0, -45], [false, false, false]),
        ([-10, 0, -19], [true, true, true]),
        ([-10, 0, -20], [true, false, true]),
        ([-10, 0, -33], [true, false, false]),
        // r²/a is.
        ([10, 0, -44], [true, false, false]),
        ([10, 0, -45], [false, false, false]),
        ([10, 0, -32], [true, false, true]),
        // a itself is too small.
        ([-54, 4, 2], [true, false, false]),
        ([-55, 4, 4], [false, false, false]),
    ];
    for ([d, far, r], stated) in rows {
        let power = |e: i32| 2f32.powi(e);
        let ray = Ray { eye: [0.0; 3], dir: [0.0, 0.0, -power(d)] };
        let sphere = Sphere { center: [0.0, 0.0, -power(far)], radius: power(r), color: [9; 3] };
        for (form, of) in FORMS[1..].iter().zip([0, 0, 1, 1, 2]) {
            let is = (form.band)(&ray, &sphere).is_some();
            assert_eq!(is, stated[of], "{}: |d| = 2^{d}, F = 2^{far}, r = 2^{r}", form.name);
        }
        assert!((FORMS[0].band)(&ray, &sphere).is_some(), "f64 has room for all f32");
    }
}

/// Of Embree nothing is stated of spheres that it drops, nor of directions whose smallest components it replaces.
#[test]
fn nothing_is_stated_of_what_embree_drops() {
    let stated = |center: [f32; 3], radius: f32, eye: [f32; 3], n: f32| {
        let ray = Ray { eye, dir: [0.0, 0.0, -n] };
        embree_band(&ray, &Sphere { center, radius, color: [9; 3] }).is_some()
    };
    let power = |e: i32| 2f32.powi(e);
    assert!(
        stated([0.0, 0.0, -4.0], 1.0, [0.0; 3], power(-20))
            && !stated([0.0, 0.0, -4.0], 1.0, [0.0; 3], power(-21))
    );
    // Far from the origin and near the eye, or near the origin and far from the eye.
    for axis in 0..3 {
        let at = |e: i32, sign: f32| [0, 1, 2].map(|i| if i == axis { sign * power(e) } else { 0.0 });
        for sign in [1.0, -1.0] {
            assert!(stated(at(59, sign), power(57), at(59, sign), 1.0), "axis {axis}");
            assert!(!stated(at(60, sign), power(57), at(60, sign), 1.0), "axis {axis}");
            assert!(!stated(at(60, sign), power(57), [0.0; 3], 1.0), "axis {axis}");
        }
    }
    assert!(stated([0.0; 3], power(59), [0.0; 3], 1.0) && !stated([0.0; 3], 1.01 * power(60), [0.0; 3], 1.0));
    assert!(!stated([0.0; 3], power(58), [0.0, power(60), 1.01 * power(60)], 1.0));
}

/// What Embree is certain to miss the perpendicular form, which loses less, misses too; and what it is certain to find that one finds.
#[test]
fn embrees_band_holds_that_of_the_perpendicular_form() {
    let (seed, cases) = (seed(), count("CGT_RULER_CASES", 100_000));
    let kinds = |i: u64| KINDS[usize::try_from(i).expect("fits") % KINDS.len()];
    let [both, misses] = (0..cases)
        .into_par_iter()
        .map(|i| {
            let case = case(kinds(i), &mut generator(seed, i));
            let sphere = case.spheres[0];
            let bands =
                [embree_band(&case.ray, &sphere), band(Rounding::PerpendicularF32, &case.ray, &sphere)];
            let [Some(embree), Some(naive)] = bands else { return [0; 2] };
            let what = || format!("{embree:?}, {naive:?}; case {i} of CGT_SEED={seed}: {case:?}");
            match (embree.may_hit.map(|open| open.ends()), naive.may_hit.map(|open| open.ends())) {
                (Some([lo, hi]), Some([from, to])) => {
                    assert!(lo <= from.max(f64::from(f32::MIN_POSITIVE)) && hi >= to, "{}", what());
                }
                (None, Some(_)) => panic!("{}", what()),
                _ => {}
            }
            assert!(
                embree.must_hit.is_none() || naive.must_hit.is_some_and(|t| Some(t) <= embree.must_hit),
                "{}",
                what()
            );
            [1, u64::from(embree.may_hit.is_none())]
        })
        .reduce(|| [0; 2], |x, y| [x[0] + y[0], x[1] + y[1]]);
    assert!(
        both > cases / 2 && misses > cases / 50,
        "CGT_SEED={seed}: {both} bands of both, {misses} certain misses"
    );
}

/// Where f64 calls a hit a miss, or a miss a hit, its band says that it may.
#[test]
fn what_f64_gets_wrong_lies_in_its_band() {
    let (seed, cases) = (seed(), count("CGT_RULER_CASES", 100_000));
    let [wrong, open] = (0..cases)
        .into_par_iter()
        .map(|i| {
            let mut rng = generator(seed, i);
            let distance = 10f64.powf(rng.random_range(5.0..7.0));
            let case =
                aimed(distance, 1.0 + distance * distance * 1e-16 * rng.random_range(-4.0..4.0), &mut rng);
            let scene = Scene::new(case.spheres[..1].to_vec(), [0; 3], DEFAULT_LIGHT).expect("a sphere");
            let band = band(Rounding::TextbookF64, &case.ray, &case.spheres[0]).expect("f64 has room");
            let [answer, truth] =
                [Arithmetic::F64, Arithmetic::Exact].map(|form| Tracer::new(form).trace(&case.ray, &scene));
            let holds = match (answer, band.may_hit) {
                (None, _) => band.must_hit.is_none(),
                (Some(hit), Some(open)) => open.holds(hit.t),
                (Some(_), None) => false,
            };
            assert!(holds, "f64 answers {answer:?}, {band:?}; case {i} of CGT_SEED={seed}: {case:?}");
            [answer.is_some() != truth.is_some(), band.may_hit.is_some() && band.must_hit.is_none()]
                .map(u64::from)
        })
        .reduce(|| [0; 2], |x, y| [x[0] + y[0], x[1] + y[1]]);
    eprintln!("CGT_SEED={seed}: {cases} rays, {open} open, {wrong} answered wrongly");
    assert!(wrong > cases / 1000 && open < cases, "CGT_SEED={seed}: {open} open, {wrong} wrong");
}
