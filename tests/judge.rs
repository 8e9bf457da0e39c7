//! Can the judge be fooled? Pictures with one planted fault each must get the verdict and the counts that fit it;
//! sound pictures of every form must not be called wrong.

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Size, Sphere};
use rayon::prelude::*;
use reference::{Arithmetic, Hit, Ray, Tracer, shade};
use verify::directed::{KINDS, case};
use verify::judge::band::band;
use verify::judge::compare::{compare, ulps_apart};
use verify::judge::{Judgement, judge};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::{count, generator, seed};
use verify::subject::{Promise, Rounding};
use verify::verdict::{Comparison, Verdict};

const FORMS: [Rounding; 5] = [
    Rounding::TextbookF64,
    Rounding::TextbookF32,
    Rounding::PerpendicularF32,
    Rounding::TextbookSpu,
    Rounding::PerpendicularSpu,
];

struct Bench {
    scene: Scene,
    camera: Camera,
    truth: Image,
}

impl Bench {
    fn new() -> Self {
        let loaded = Source::parse("uniform:200:5").and_then(|s| s.load()).expect("generated");
        let size = Some(Size::new(96, 64).expect("small"));
        let camera = Framing { size, ..Framing::default() }.camera(&loaded.animation).expect("in view");
        let scene = loaded.animation.frames()[0].clone();
        let truth = Tracer::new(Arithmetic::Exact).render(&scene, &camera).expect("small").image;
        Self { scene, camera, truth }
    }

    fn naive(&self, rounding: Rounding) -> Image {
        Tracer::new(rounding.naive()).render(&self.scene, &self.camera).expect("small").image
    }

    fn judge(&self, subject: &Image, promise: Promise, naive: Option<&Image>) -> Judgement {
        judge(&self.scene, &self.camera, &self.truth, subject, promise, naive)
    }

    /// Puts an answer into a pixel, and its colour by rule 4.
    fn put(&self, image: &mut Image, at: usize, id: u32, t: f32) {
        let [x, y] = [at % 96, at / 96].map(|x| u32::try_from(x).expect("small"));
        let [r, g, b] = self.scene.background();
        let is_one = (id as usize) < self.scene.spheres().len();
        let ray = Ray::of_pixel(&self.camera, x, y);
        let color = if is_one { shade(&self.scene, &ray, Hit { id, t }) } else { [r, g, b, 255] };
        (image.ids[at], image.t[at], image.rgba[at]) = (id, t, color);
    }

    /// Multiplies the t of a hit.
    fn move_by(&self, image: &mut Image, factor: f32) {
        let at = self.pixel(true);
        self.put(image, at, self.truth.ids[at], self.truth.t[at] * factor);
    }

    /// The first pixel after the middle that hits, or that misses.
    fn pixel(&self, hit: bool) -> usize {
        let fits = |i: &usize| (self.truth.ids[*i] != MISS) == hit;
        (self.truth.ids.len() / 2..self.truth.ids.len()).find(fits).expect("both occur")
    }
}

#[test]
fn sound_pictures_pass() {
    let bench = Bench::new();
    assert_eq!(bench.judge(&bench.truth, Promise::Exact, None).verdict, Verdict::Equal);
    for rounding in FORMS {
        let image = bench.naive(rounding);
        for promise in [Promise::Rounded(rounding), Promise::EqualToNaive(rounding)] {
            let judgement = bench.judge(&image, promise, Some(&image));
            assert!(matches!(judgement.verdict, Verdict::Equal | Verdict::WithinBound), "{judgement:?}");
            let of_naive = judgement.because.starts_with("Bit for bit the naive picture. ");
            assert_eq!(of_naive, promise == Promise::EqualToNaive(rounding), "{judgement:?}");
        }
    }
    let f32 = bench.naive(Rounding::TextbookF32);
    assert_eq!(bench.judge(&f32, Promise::Exact, None).verdict, Verdict::Wrong);
    assert_eq!(
        bench.judge(&f32, Promise::EqualToNaive(Rounding::TextbookF32), None).verdict,
        Verdict::NotJudged
    );
    let other = bench.naive(Rounding::PerpendicularF32);
    let judgement = bench.judge(&f32, Promise::EqualToNaive(Rounding::TextbookF32), Some(&other));
    assert_eq!(judgement.verdict, Verdict::Wrong, "the picture of another form passed as the naive one");
}

/// The picture of a sphere that is hit, and of a second one behind it: the farther hit is one that its own bound explains,
/// and still wrong, since the nearer is certain.
#[test]
fn a_sphere_behind_another_is_wrong() {
    let ball = |z: f32, color: u8| Sphere { center: [0.0, 0.0, z], radius: 1.0, color: [color; 3] };
    let scene = |spheres| Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
    let both = scene(vec![ball(-9.0, 200), ball(-5.0, 100)]);
    let size = Size::new(1, 1).expect("a pixel");
    let camera = Camera::new([0.0; 3], [-0.5, 0.5, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size);
    let camera = camera.expect("a camera");
    let render = |scene| Tracer::new(Arithmetic::Exact).render(scene, &camera).expect("small").image;
    let (truth, behind) = (render(&both), render(&scene(vec![ball(-9.0, 200)])));
    assert_eq!([truth.ids[0], behind.ids[0]], [1, 0]);
    for rounding in FORMS {
        let judgement = judge(&both, &camera, &truth, &behind, Promise::Rounded(rounding), None);
        assert_eq!(judgement.verdict, Verdict::Wrong, "{rounding:?}: {judgement:?}");
    }
}

type Plant = (&'static str, fn(&Bench, &mut Image), fn(&Comparison) -> u64);

/// Faults, and the count that must rise by one: each alone, with all else as it is in the truth, and then with the colour that fits it, so that
/// nothing but itself gives it away.
const PLANTS: [Plant; 13] = [
    ("missing", |b, image| image.ids[b.pixel(true)] = MISS, |c| c.missing),
    ("extra", |b, image| image.ids[b.pixel(false)] = 3, |c| c.extra),
    ("swapped", |b, image| image.ids[b.pixel(true)] ^= 1, |c| c.swapped),
    ("t", |b, image| image.t[b.pixel(true)] *= 1.01, |c| c.wrong_t),
    ("t is NaN", |b, image| image.t[b.pixel(true)] = f32::NAN, |c| c.wrong_t),
    ("color", |b, image| image.rgba[b.pixel(true)][1] ^= 1, |c| c.wrong_color),
    ("missing, painted", |b, image| b.put(image, b.pixel(true), MISS, f32::INFINITY), |c| c.missing),
    ("extra, painted", |b, image| b.put(image, b.pixel(false), 3, 1.0), |c| c.extra),
    ("extra, but no hit", |b, image| b.put(image, b.pixel(false), 3, f32::INFINITY), |c| c.extra),
    (
        "swapped, painted",
        |b, image| b.put(image, b.pixel(true), b.truth.ids[b.pixel(true)] ^ 1, 1.0),
        |c| c.swapped,
    ),
    ("no such sphere", |b, image| b.put(image, b.pixel(true), 1_000_000, 1.0), |c| c.swapped),
    ("t, painted", |b, image| b.move_by(image, 1.01), |c| c.wrong_t),
    ("t is negative", |b, image| b.move_by(image, -1.0), |c| c.wrong_t),
];

#[test]
fn every_planted_fault_is_wrong_and_counted() {
    let bench = Bench::new();
    for rounding in FORMS {
        for (name, plant, count) in PLANTS {
            // The truth itself is an answer that rounding explains, so only the plant is at fault.
            let mut image = bench.truth.clone();
            plant(&bench, &mut image);
            for promise in [Promise::Exact, Promise::Rounded(rounding), Promise::EqualToNaive(rounding)] {
                let judgement = bench.judge(&image, promise, Some(&bench.truth));
                assert_eq!(judgement.verdict, Verdict::Wrong, "{name}, {promise:?}: {judgement:?}");
                let comparison = judgement.comparison.expect("compared");
                assert_eq!(count(&comparison), 1, "{name}, {promise:?}: {comparison:?}");
                assert!(comparison.first_wrong.is_some(), "{name}");
            }
        }
    }
}

/// No rounding brings a miss nearer: under every rounded promise its t is infinite or wrong.
#[test]
fn a_miss_at_a_distance_is_wrong() {
    let bench = Bench::new();
    let at = bench.pixel(false);
    for rounding in FORMS {
        let mut image = bench.naive(rounding);
        assert_eq!((image.ids[at], image.t[at]), (MISS, f32::INFINITY), "{rounding:?}");
        for t in [0.0, 1e30, f32::MAX, f32::NEG_INFINITY, f32::NAN] {
            image.t[at] = t;
            let judgement = bench.judge(&image, Promise::Rounded(rounding), None);
            assert_eq!(judgement.verdict, Verdict::Wrong, "{rounding:?}, t {t}: {judgement:?}");
            assert_eq!(judgement.comparison.map(|c| c.unexplained), Some(1), "{rounding:?}, t {t}");
        }
    }
}

/// Whatever rounding makes of id and t, their colour is one: that of another t, of the truth, or of nothing is wrong, and the
/// sound picture beside it is not.
#[test]
fn a_colour_not_of_its_t_is_wrong() {
    let bench = Bench::new();
    for rounding in FORMS {
        let at = bench.pixel(true);
        let sound = |t: f32| {
            let mut image = bench.truth.clone();
            bench.put(&mut image, at, bench.truth.ids[at], t);
            image
        };
        // In f64 nothing but the rounding of t at the end is open, and that is less than a step.
        let truth = bench.truth.t[at];
        let steps = [truth.next_up(), truth.next_down(), truth];
        let judged = |image: &Image| bench.judge(image, Promise::Rounded(rounding), None).verdict;
        let t = steps.into_iter().find(|t| judged(&sound(*t)) != Verdict::Wrong).expect("the truth is right");
        assert!(
            t != truth || rounding == Rounding::TextbookF64,
            "{rounding:?}: not a step from the truth is explained"
        );
        for color in [[0; 4], [0, 0, 0, 255], sound(t * 2.0).rgba[at], bench.truth.rgba[at].map(|x| x ^ 1)] {
            let mut image = sound(t);
            image.rgba[at] = color;
            let judgement = bench.judge(&image, Promise::Rounded(rounding), None);
            assert_eq!(judgement.verdict, Verdict::Wrong, "{rounding:?}, {color:?}: {judgement:?}");
            assert_eq!(judgement.comparison.map(|c| c.unexplained), Some(1), "{rounding:?}, {color:?}");
        }
    }
}

/// What is said of a tracer that gives this t for an eye exactly on the surface of a sphere, whose far side is at t = 2.
fn from_a_surface(t: f32, rounding: Rounding) -> Judgement {
    let ball = Sphere { center: [0.0, 0.0, -1.0], radius: 1.0, color: [9; 3] };
    let scene = Scene::new(vec![ball], [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(1, 1).expect("a pixel");
    let camera = Camera::new([0.0; 3], [-0.5, 0.5, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size);
    let camera = camera.expect("a camera");
    let truth = Tracer::new(Arithmetic::Exact).render(&scene, &camera).expect("small").image;
    assert_eq!((truth.ids[0], truth.t[0]), (0, 2.0));
    let ray = Ray::of_pixel(&camera, 0, 0);
    let image = Image { t: vec![t], rgba: vec![shade(&scene, &ray, Hit { id: 0, t })], ..truth.clone() };
    judge(&scene, &camera, &truth, &image, Promise::Rounded(rounding), None)
}

/// Such an eye sees one root or the other: no rounding makes a t of what lies between them, or beyond.
#[test]
fn what_lies_between_two_roots_is_wrong() {
    for rounding in FORMS {
        for t in [0.5f32, 1.0, 1.5, 1.99, 2.01, 4.0] {
            let judgement = from_a_surface(t, rounding);
            assert_eq!(judgement.verdict, Verdict::Wrong, "{rounding:?}, t {t:?}: {judgement:?}");
        }
        // A step of f32 is more than f64 is off.
        let step = if rounding == Rounding::TextbookF64 { Verdict::Wrong } else { Verdict::WithinBound };
        for (t, verdict) in [(2f32, Verdict::Equal), (2f32.next_up(), step)] {
            let judgement = from_a_surface(t, rounding);
            assert_eq!(judgement.verdict, verdict, "{rounding:?}, t {t:?}: {judgement:?}");
        }
    }
}

/// An eye exactly on a surface sees the far side, or by rounding the near one at a t above 0, and never at 0: that a hit needs t > 0 is no
/// matter of rounding. In f64 such a t may become 0 when it is rounded to f32, so nothing is asked there.
#[test]
fn who_sees_the_surface_it_is_on_is_wrong() {
    for rounding in FORMS.into_iter().filter(|form| *form != Rounding::TextbookF64) {
        for (t, verdict) in [
            (0.0, Verdict::Wrong),
            (-0.0, Verdict::Wrong),
            (-f32::MIN_POSITIVE, Verdict::Wrong),
            (f32::MIN_POSITIVE, Verdict::WithinBound),
        ] {
            let judgement = from_a_surface(t, rounding);
            assert_eq!(judgement.verdict, verdict, "{rounding:?}, t {t:?}: {judgement:?}");
        }
    }
}

/// Of a picture full of differences that rounding explains the first that it does not is told, the gravest of these, and not the first
/// of all.
#[test]
fn the_pixel_that_is_told_is_not_explained() {
    let bench = Bench::new();
    for rounding in FORMS.into_iter().filter(|form| *form != Rounding::TextbookF64) {
        let sound = bench.naive(rounding);
        let differs = compare(&bench.truth, &sound).expect("same shape").first_wrong.expect("it rounds");
        let mut image = sound.clone();
        let told = |image: &Image| {
            let judgement = bench.judge(image, Promise::Rounded(rounding), None);
            let comparison = judgement.comparison.expect("compared");
            (judgement.verdict, comparison.unexplained, comparison.first_wrong)
        };
        assert_eq!(told(&image), (Verdict::WithinBound, 0, Some(differs)), "{rounding:?}");
        let hits: Vec<usize> = (0..image.ids.len()).filter(|&i| image.ids[i] != MISS).collect();
        let place = |i: usize| Some([i % 96, i / 96].map(|x| u32::try_from(x).expect("small")));
        let [early, middle, late] = [hits.len() / 3, hits.len() / 2, hits.len() - 1].map(|n| hits[n]);
        let equal = |i: &usize| (bench.truth.ids[*i], bench.truth.t[*i]) == (sound.ids[*i], sound.t[*i]);
        let plain = hits.iter().copied().filter(equal).find(|i| *i > middle).expect("some are equal");
        image.rgba[plain][0] ^= 1;
        assert_eq!(told(&image), (Verdict::Wrong, 1, place(plain)), "{rounding:?}: a colour");
        image.t[late] *= 1.5;
        assert_eq!(told(&image), (Verdict::Wrong, 2, place(late)), "{rounding:?}: a t behind it");
        image.t[early] *= 1.5;
        assert_eq!(told(&image), (Verdict::Wrong, 3, place(early)), "{rounding:?}: a t before both");
        (image.ids[middle], image.t[middle]) = (MISS, f32::INFINITY);
        assert_eq!(told(&image), (Verdict::Wrong, 4, place(middle)), "{rounding:?}: an id behind it");
    }
}

#[test]
fn pictures_of_other_shapes_are_wrong() {
    let bench = Bench::new();
    let cut: [fn(&mut Image); 3] = [|i| _ = i.ids.pop(), |i| i.t.push(1.0), |i| i.rgba.clear()];
    for cut in cut {
        let mut image = bench.truth.clone();
        cut(&mut image);
        let judgement = bench.judge(&image, Promise::Exact, None);
        assert_eq!((judgement.verdict, judgement.comparison), (Verdict::Wrong, None));
    }
    let turned = Image::new(Size::new(64, 96).expect("small"), [0; 3]).expect("small");
    assert!(compare(&bench.truth, &turned).is_err(), "as many pixels, another shape");
}

#[test]
fn the_gravest_fault_is_first() {
    let bench = Bench::new();
    let mut image = bench.truth.clone();
    image.rgba[0][0] ^= 1;
    let first = |image: &Image| compare(&bench.truth, image).expect("same shape").first_wrong;
    assert_eq!(first(&image), Some([0, 0]));
    let nulls = Image { t: vec![0.0; image.t.len()], ..bench.truth.clone() };
    let mut other = nulls.clone();
    other.t[97] = -0.0;
    assert_eq!(compare(&nulls, &other).expect("same shape").first_wrong, Some([1, 1]), "-0 is no +0");
    let i = bench.pixel(true);
    image.t[i] = image.t[i].next_up();
    let place = [u32::try_from(i % 96).expect("small"), u32::try_from(i / 96).expect("small")];
    assert_eq!(first(&image), Some(place));
    let last = image.ids.len() - 1;
    image.ids[last] = 77;
    assert_eq!(first(&image), Some([95, 63]));
}

#[test]
fn ulps_are_steps() {
    assert_eq!(ulps_apart(1.0, 1.0f32.next_up()), 1);
    assert_eq!(ulps_apart(-0.0, 0.0), 0);
    assert_eq!(ulps_apart(f32::from_bits(1), -f32::from_bits(1)), 2);
    assert_eq!(ulps_apart(f32::MAX, f32::INFINITY), 1);
    assert_eq!(ulps_apart(1.0, 2.0), 1 << 23);
    assert_eq!(ulps_apart(f32::NAN, 1.0), u64::MAX);
}

#[test]
fn t_is_summed_up_by_rank() {
    let bench = Bench::new();
    let mut image = bench.truth.clone();
    let hits: Vec<usize> = (0..image.ids.len()).filter(|&i| image.ids[i] != MISS).collect();
    for (n, &i) in hits.iter().enumerate() {
        for _ in 0..(n % 100) {
            image.t[i] = image.t[i].next_up();
        }
    }
    let comparison = compare(&bench.truth, &image).expect("same shape");
    let moved = (0..hits.len()).filter(|n| n % 100 > 0).count();
    assert_eq!(comparison.wrong_t, moved as u64, "a step is a difference");
    let t = comparison.t_ulp;
    assert_eq!(t.count, hits.len() as u64);
    assert!((48..=50).contains(&t.median) && (97..=99).contains(&t.p99) && t.max == 99, "{t:?}");
}

/// The band of each form holds what the shipped form answers, and is no wider than it needs to be by much: among
/// close cases it must rule something out.
#[test]
fn bands_hold_what_the_forms_answer() {
    let (seed, cases) = (seed(), count("CGT_BAND_CASES", 200_000));
    eprintln!("CGT_SEED={seed}, {cases} rays");
    let tally = |i: u64| {
        let kind = KINDS[usize::try_from(i).expect("fits") % KINDS.len()];
        let case = case(kind, &mut generator(seed, i));
        let sphere = case.spheres[0];
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid by construction");
        let mut counts = [0u64; 3];
        for rounding in FORMS {
            let Some(band) = band(rounding, &case.ray, &sphere) else { continue };
            let answer = Tracer::new(rounding.naive()).trace(&case.ray, &scene);
            let holds = match (answer, band.may_hit) {
                (None, _) => band.must_hit.is_none(),
                (Some(hit), Some(open)) => open.holds(hit.t),
                (Some(_), None) => false,
            };
            assert!(
                holds,
                "{rounding:?} answers {answer:?}, {band:?}; case {i} of CGT_SEED={seed}: {case:?}"
            );
            let truth = Tracer::new(Arithmetic::Exact).trace(&case.ray, &scene);
            counts[0] += 1;
            counts[1] += u64::from(band.must_hit.is_some() == band.may_hit.is_some());
            counts[2] += u64::from(truth.is_some() != answer.is_some());
        }
        counts
    };
    let sum = |x: [u64; 3], y: [u64; 3]| [0, 1, 2].map(|i| x[i] + y[i]);
    let [stated, certain, wrong] = (0..cases).into_par_iter().map(tally).reduce(|| [0; 3], sum);
    eprintln!("{stated} answers, {certain} of them certain, {wrong} wrong");
    assert!(stated > cases, "the bound states something for hardly any ray");
    assert!(certain > stated / 3, "the bound rules hardly anything out");
    assert!(wrong > cases / 1000, "hardly any answer is wrong, so nothing was at stake");
}

/// Close by, a band is narrow: t within 2,000 units of rounding for the textbook form and 500 for the perpendicular, and a
/// ray that passes by a ten-thousandth of the radius is a certain miss.
#[test]
fn bands_are_narrow_close_by() {
    let ray = Ray { eye: [0.0; 3], dir: [0.0, 0.0, -1.0] };
    let ball = |x: f32| Sphere { center: [x, 0.0, -5.0], radius: 1.0, color: [9; 3] };
    for (rounding, units) in [(Rounding::TextbookF32, 2000.0), (Rounding::PerpendicularF32, 500.0)] {
        let head_on = band(rounding, &ray, &ball(0.0)).expect("in range");
        let [lo, hi] = head_on.may_hit.expect("head on").ends();
        assert!(
            head_on.must_hit.is_some() && hi - lo < units / f64::from(1u32 << 24),
            "{rounding:?}: {head_on:?}"
        );
        let beside = band(rounding, &ray, &ball(1.0001)).expect("in range");
        assert_eq!((beside.must_hit, beside.may_hit), (None, None), "{rounding:?}");
    }
}

/// "By at most" is of all pixels, not of the last that is wrong.
#[test]
fn the_farthest_colour_is_that_of_all_pixels() {
    let bench = Bench::new();
    let mut image = bench.truth.clone();
    for (i, off) in [(0, 2), (7, 9), (20, 3)] {
        image.rgba[i][1] = image.rgba[i][1].wrapping_add(off);
    }
    let found = compare(&bench.truth, &image).expect("same shape");
    let farthest = [0, 7, 20].map(|i| image.rgba[i][1].abs_diff(bench.truth.rgba[i][1])).into_iter().max();
    assert_eq!((found.wrong_color, Some(found.color_max)), (3, farthest));
}

/// Of faults that are equally grave the first in row order is told, whichever the others are.
#[test]
fn the_first_of_equal_faults_is_told() {
    let bench = Bench::new();
    type Spoil = fn(&mut Image, usize);
    let grades: [Spoil; 3] =
        [|image, i| image.rgba[i][2] ^= 1, |image, i| image.t[i] = 0.5, |image, i| image.ids[i] = 77];
    let mut image = bench.truth.clone();
    for (grade, spoil) in grades.into_iter().enumerate() {
        let place =
            |i: usize| Some([u32::try_from(i % 96).expect("small"), u32::try_from(i / 96).expect("small")]);
        let first = 300 + 7 * grade;
        for i in [5_000, first, 4_000] {
            spoil(&mut image, i);
        }
        assert_eq!(
            compare(&bench.truth, &image).expect("same shape").first_wrong,
            place(first),
            "grade {grade}"
        );
    }
}

/// A picture that promises to be the naive one and is not, in the last bit of one t, is wrong, although rounding would explain it.
#[test]
fn a_twin_differs_by_one_t() {
    let bench = Bench::new();
    for rounding in FORMS {
        let naive = bench.naive(rounding);
        let mut image = naive.clone();
        let i = bench.pixel(true);
        image.t[i] = image.t[i].next_up();
        let rounded = bench.judge(&image, Promise::Rounded(rounding), None);
        // In f64 nothing but the rounding of t at the end is open.
        let explained = [Verdict::Equal, Verdict::WithinBound].contains(&rounded.verdict);
        assert!(explained || rounding == Rounding::TextbookF64, "{rounding:?}: {rounded:?}");
        let judgement = bench.judge(&image, Promise::EqualToNaive(rounding), Some(&naive));
        assert_eq!(judgement.verdict, Verdict::Wrong, "{rounding:?}: {judgement:?}");
        // What is told is where the promise is broken, though the truth differs elsewhere, and earlier.
        let first = judgement.comparison.and_then(|comparison| comparison.first_wrong);
        assert_eq!(first.map(|[x, y]| y as usize * 96 + x as usize), Some(i), "{rounding:?}");
    }
}

/// Where a form states nothing, a difference is no agreement and no error either.
#[test]
fn what_the_form_states_nothing_of_is_undecidable() {
    let ball = Sphere { center: [0.0; 3], radius: 1e-30, color: [9; 3] };
    let scene = Scene::new(vec![ball], [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(8, 8).expect("small");
    let camera = Camera::new([0.0, 0.0, 1e-29], [-0.2, 0.2, -1.0], [0.05, 0.0, 0.0], [0.0, -0.05, 0.0], size);
    let camera = camera.expect("a camera");
    let truth = Tracer::new(Arithmetic::Exact).render(&scene, &camera).expect("small").image;
    let nothing = Image::new(size, [0; 3]).expect("small");
    let hits = truth.ids.iter().filter(|id| **id != MISS).count() as u64;
    let judgement = judge(&scene, &camera, &truth, &nothing, Promise::Rounded(Rounding::TextbookF32), None);
    let unstated = judgement.comparison.as_ref().map(|c| (c.undecidable, c.unexplained));
    assert_eq!((judgement.verdict, unstated), (Verdict::Undecidable, Some((hits, 0))), "{judgement:?}");
    assert!(hits > 4);
    // Nor is a hit on a sphere of which nothing is stated, the true one or another.
    let twins = Scene::new(vec![ball; 2], [0; 3], DEFAULT_LIGHT).expect("valid");
    let mut second = truth.clone();
    second.ids.iter_mut().filter(|id| **id == 0).for_each(|id| *id = 1);
    let judgement = judge(&twins, &camera, &truth, &second, Promise::Rounded(Rounding::TextbookF32), None);
    let unstated = judgement.comparison.as_ref().map(|c| (c.undecidable, c.unexplained));
    assert_eq!((judgement.verdict, unstated), (Verdict::Undecidable, Some((hits, 0))), "{judgement:?}");
    // Nor is another t of the right one.
    let mut farther = truth.clone();
    for (y, x) in (0..8).flat_map(|y| (0..8).map(move |x| (y, x))) {
        let i = (8 * y + x) as usize;
        if truth.ids[i] != MISS {
            farther.t[i] = truth.t[i].next_up();
            let answer = Hit { id: 0, t: farther.t[i] };
            farther.rgba[i] = shade(&scene, &Ray::of_pixel(&camera, x, y), answer);
        }
    }
    let judgement = judge(&scene, &camera, &truth, &farther, Promise::Rounded(Rounding::TextbookF32), None);
    let unstated = judgement.comparison.as_ref().map(|c| (c.undecidable, c.unexplained, c.wrong_t));
    assert_eq!((judgement.verdict, unstated), (Verdict::Undecidable, Some((hits, 0, hits))), "{judgement:?}");
}

/// One sphere of which nothing is stated excuses nobody who missed another, or saw what stands behind it; in whatever order they are.
#[test]
fn a_speck_excuses_nothing_else() {
    let speck = Sphere { center: [50.0, 0.0, 0.0], radius: 1e-30, color: [9; 3] };
    let ball = |z: f32| Sphere { center: [0.0, 0.0, z], radius: 1.0, color: [90; 3] };
    let size = Size::new(8, 8).expect("small");
    let camera = Camera::new([0.0; 3], [-0.04, 0.04, -1.0], [0.01, 0.0, 0.0], [0.0, -0.01, 0.0], size);
    let camera = camera.expect("a camera");
    for order in [[0, 1, 2], [2, 1, 0], [1, 0, 2], [1, 2, 0]] {
        let spheres = order.map(|k| [speck, ball(-5.0), ball(-9.0)][k]);
        let scene = Scene::new(spheres.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
        let by = |scene: &Scene| Tracer::new(Arithmetic::Exact).render(scene, &camera).expect("small").image;
        let truth = by(&scene);
        let rounded = Promise::Rounded(Rounding::TextbookF32);
        let judged = |image: &Image| judge(&scene, &camera, &truth, image, rounded, None);
        assert_eq!(judged(&truth).verdict, Verdict::Equal, "{order:?}");
        let nothing = judged(&Image::new(size, [0; 3]).expect("small"));
        let counts = nothing.comparison.as_ref().map(|c| (c.unexplained, c.undecidable));
        assert_eq!((nothing.verdict, counts), (Verdict::Wrong, Some((64, 0))), "{order:?}: {nothing:?}");
        // What stands behind, as it is seen where nothing is before it.
        let mut hidden = spheres.to_vec();
        hidden[order.iter().position(|k| *k == 1).expect("it is there")].center[0] = 50.0;
        let behind = judged(&by(&Scene::new(hidden, [0; 3], DEFAULT_LIGHT).expect("valid")));
        let counts = behind.comparison.as_ref().map(|c| (c.unexplained, c.undecidable));
        assert_eq!((behind.verdict, counts), (Verdict::Wrong, Some((64, 0))), "{order:?}: {behind:?}");
        // Nor who saw the speck itself, unless it could be before the ball.
        let id = order
            .iter()
            .position(|k| *k == 0)
            .map(|at| u32::try_from(at).expect("small"))
            .expect("it is there");
        let seen = |t: f32| {
            let mut image = truth.clone();
            let color = shade(&scene, &Ray::of_pixel(&camera, 1, 1), Hit { id, t });
            (image.ids[9], image.t[9], image.rgba[9]) = (id, t, color);
            judged(&image).verdict
        };
        assert_eq!(
            [seen(truth.t[9]), seen(truth.t[9] + 1.0)],
            [Verdict::Undecidable, Verdict::Wrong],
            "{order:?}"
        );
    }
}
