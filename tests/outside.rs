//! Can the court of outside witnesses be fooled? Made-up witnesses with one fault each, and a reference with one, must
//! get the verdict and the counts that fit. No Embree is needed: a witness here is the naive perpendicular form.

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Size, Sphere};
use reference::{Arithmetic, Ray, Tracer};
use verify::judge::band::{Band, Open, band};
use verify::judge::outside::{Adjudicated, Hearing, Stand, Testimony, Witness, hear};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::subject::{Rounding, SubjectError};
use verify::verdict::Verdict;

/// The perpendicular form, and what is done to its picture.
struct Perpendicular<F: Fn(&mut Image) + Sync>(F);

impl<F: Fn(&mut Image) + Sync> Witness for Perpendicular<F> {
    fn name(&self) -> String {
        "perpendicular".into()
    }

    fn band(&self, ray: &Ray, sphere: &Sphere) -> Option<Band> {
        band(Rounding::PerpendicularF32, ray, sphere)
    }

    fn testify(&self, scene: &Scene, camera: &Camera) -> Result<Vec<Testimony>, SubjectError> {
        let mut image = Tracer::new(Arithmetic::F32Perpendicular).render(scene, camera)?.image;
        (self.0)(&mut image);
        Ok(vec![Testimony { mode: "plain".into(), ids: image.ids, t: image.t }])
    }
}

struct Bench {
    scene: Scene,
    camera: Camera,
    truth: Image,
}

impl Bench {
    fn new(scene: Scene, framing: &Framing) -> Self {
        let camera = framing.camera(&scene.clone().into()).expect("in view");
        let truth = Tracer::new(Arithmetic::Exact).render(&scene, &camera).expect("small").image;
        Self { scene, camera, truth }
    }

    fn random() -> Self {
        let loaded = Source::parse("uniform:200:5").and_then(|s| s.load()).expect("generated");
        Self::new(loaded.animation.frames()[0].clone(), &sized(96, 64))
    }

    fn hear(&self, fault: impl Fn(&mut Image) + Sync) -> Hearing {
        self.hear_of(&self.truth, fault)
    }

    fn hear_of(&self, truth: &Image, fault: impl Fn(&mut Image) + Sync) -> Hearing {
        let witness = Perpendicular(fault);
        let mut hearings = hear(&self.scene, &self.camera, truth, &witness).expect("it answers");
        assert_eq!(hearings.len(), 1);
        hearings.remove(0)
    }

    /// A pixel that hits and lies outside the band.
    fn plain(&self) -> usize {
        let decided = |i: &usize| {
            let (x, y) = (u32::try_from(i % 96).expect("fits"), u32::try_from(i / 96).expect("fits"));
            let ray = Ray::of_pixel(&self.camera, x, y);
            let rounded = |ray: &Ray, sphere: &Sphere| band(Rounding::PerpendicularF32, ray, sphere);
            Stand::new(&ray, self.scene.spheres(), rounded).is_some_and(|stand| stand.is_decided())
        };
        (0..self.truth.ids.len())
            .filter(|&i| self.truth.ids[i] != MISS)
            .find(decided)
            .expect("nearly all are")
    }
}

fn sized(width: u32, height: u32) -> Framing {
    Framing { size: Some(Size::new(width, height).expect("small")), ..Framing::default() }
}

#[test]
fn a_sound_witness_and_the_reference_agree() {
    let hearing = Bench::random().hear(|_| ());
    assert_eq!((hearing.failures(), hearing.verdict()), (0, Verdict::WithinBound), "{hearing:?}");
    assert_eq!(
        (hearing.witness.as_str(), hearing.mode.as_str(), hearing.rays),
        ("perpendicular", "plain", 96 * 64)
    );
    assert!(hearing.hits > 500 && hearing.not_stated == [0, 0]);
    assert_eq!(hearing.t_ulp.iter().sum::<u64>(), hearing.hits, "a t was left out of the histogram");
    assert!(hearing.t_ulp[0] < hearing.hits && hearing.t_ulp_max > 0, "f32 is never off?");
}

#[test]
fn every_fault_of_a_witness_is_a_failure() {
    let bench = Bench::random();
    let at = bench.plain();
    type Spoil = fn(&mut Image, usize);
    let outside: [(&str, Spoil); 3] = [
        ("a wrong id", |image, at| image.ids[at] = (image.ids[at] + 1) % 200),
        ("a miss", |image, at| (image.ids[at], image.t[at]) = (MISS, f32::INFINITY)),
        ("an id that is none", |image, at| image.ids[at] = 200),
    ];
    for (what, spoil) in outside {
        let hearing = bench.hear(|image| spoil(image, at));
        assert_eq!((hearing.outside, hearing.failures()), (1, 1), "{what}: {hearing:?}");
        assert_eq!(hearing.verdict(), Verdict::Wrong, "{what}");
        let pixel = format!("pixel ({}, {})", at % 96, at / 96);
        assert!(
            hearing.first.is_some_and(|first| first.starts_with(&pixel)),
            "{what}: the first is not told"
        );
    }
    for factor in [1.0001, 0.9999, f32::NAN] {
        let hearing = bench.hear(|image| image.t[at] *= factor);
        assert_eq!((hearing.wrong_t, hearing.failures()), (1, 1), "t times {factor}: {hearing:?}");
    }
}

/// The reference is judged too: a fault of its own is not taken for the truth.
#[test]
fn every_fault_of_the_reference_is_a_failure() {
    let bench = Bench::random();
    let at = bench.plain();
    let spoilt = |spoil: fn(&mut Image, usize)| {
        let mut truth = bench.truth.clone();
        spoil(&mut truth, at);
        bench.hear_of(&truth, |_| ())
    };
    assert_eq!(spoilt(|truth, at| truth.ids[at] = (truth.ids[at] + 1) % 200).outside, 1);
    assert_eq!(spoilt(|truth, at| truth.ids[at] = MISS).outside, 1);
    assert_eq!(spoilt(|truth, at| truth.t[at] *= 1.0001).wrong_t, 1);
    // Both wrong in the same way.
    let mut truth = bench.truth.clone();
    truth.ids[at] = MISS;
    assert_eq!(bench.hear_of(&truth, |image| image.ids[at] = MISS).outside, 1);
}

/// Coincident spheres: whichever of the twins a witness takes is a tie; integers say so.
#[test]
fn ties_are_told_from_errors() {
    let ball = |z: f32| Sphere { center: [0.0, 0.0, z], radius: 1.0, color: [9; 3] };
    let scene = Scene::new(vec![ball(0.0), ball(0.0), ball(1e-7)], [0; 3], DEFAULT_LIGHT).expect("valid");
    let framing = Framing { eye: Some([0.0, 0.0, -9.0]), ..sized(32, 32) };
    let bench = Bench::new(scene, &framing);
    let hits = bench.truth.ids.iter().filter(|&&id| id == 0).count() as u64;
    assert!(hits > 40 && !bench.truth.ids.contains(&1));
    let take = |id: u32| {
        move |image: &mut Image| image.ids.iter_mut().filter(|id| **id != MISS).for_each(|seen| *seen = id)
    };
    let tied = bench.hear(take(1));
    assert_eq!((tied.inside.ties, tied.failures()), (hits, 0), "{tied:?}");
    // The third is farther by less than rounding sees: in the band, and wrong.
    let behind = bench.hear(take(2));
    assert_eq!((behind.inside.reference, behind.inside.ties, behind.failures()), (hits, 0, 0), "{behind:?}");
    // A reference that takes it is found out by the integers alone.
    let mut truth = bench.truth.clone();
    take(2)(&mut truth);
    let found = bench.hear_of(&truth, |image| take(0)(image));
    assert_eq!((found.inside.witness, found.verdict()), (hits, Verdict::Wrong), "{found:?}");
    let both = bench.hear_of(&truth, take(1));
    assert_eq!((both.inside.neither, both.verdict()), (hits, Verdict::Wrong), "{both:?}");
}

/// Where the witness's range ends nothing is stated, and that is no agreement.
#[test]
fn silence_is_counted() {
    let ball = Sphere { center: [0.0; 3], radius: 1e-30, color: [9; 3] };
    let scene = Scene::new(vec![ball], [0; 3], DEFAULT_LIGHT).expect("valid");
    let framing = Framing { eye: Some([0.0, 0.0, -1e-29]), target: Some([0.0; 3]), ..sized(16, 16) };
    let bench = Bench::new(scene, &framing);
    assert!(bench.truth.ids.contains(&0), "the truth sees it");
    let hearing = bench.hear(|_| ());
    assert_eq!((hearing.not_stated[0], hearing.verdict()), (256, Verdict::NotJudged), "{hearing:?}");
    assert!(hearing.not_stated[1] > 0, "f32 underflows here");
}

/// A witness that sees a sphere behind the one that must be hit is wrong, with the right t of the wrong sphere.
#[test]
fn who_sees_through_a_sphere_is_wrong() {
    let ball = |z: f32| Sphere { center: [0.0, 0.0, z], radius: 1.0, color: [9; 3] };
    let scene = |balls: &[Sphere]| Scene::new(balls.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let framing = Framing { eye: Some([0.0, 0.0, -9.0]), ..sized(64, 64) };
    let bench = Bench::new(scene(&[ball(0.0), ball(5.0)]), &framing);
    let far = Tracer::new(Arithmetic::F32Perpendicular).render(&scene(&[ball(5.0)]), &bench.camera);
    let far = far.expect("small").image;
    let hearing = bench.hear(|image| {
        for (i, id) in far.ids.iter().enumerate().filter(|(_, id)| **id != MISS) {
            (image.ids[i], image.t[i]) = (id + 1, far.t[i]);
        }
    });
    let through =
        far.ids.iter().zip(&bench.truth.ids).filter(|(far, id)| **far == 0 && **id == 0).count() as u64;
    assert_eq!(hearing.outside + hearing.beyond, through, "{hearing:?}");
    assert!(through > 40 && hearing.verdict() == Verdict::Wrong, "{hearing:?}");
}

/// A sphere whose surface the eye is on is open at its near side; its far side is not, where another is certain to be hit before.
#[test]
fn nothing_is_open_behind_what_is_certain() {
    let ball = |z: f32, radius: f32| Sphere { center: [0.0, 0.0, z], radius, color: [9; 3] };
    let ray = Ray { eye: [0.0; 3], dir: [0.0, 0.0, -1.0] };
    let open = |spheres: &[Sphere]| {
        let stand = Stand::new(&ray, spheres, |ray, sphere| band(Rounding::PerpendicularF32, ray, sphere));
        let [near, far] =
            [1e-9, 20.0].map(|t| stand.as_ref().is_some_and(|s| s.open(0).is_some_and(|o| o.holds(t))));
        (near, far, stand.and_then(|stand| stand.open(1)).is_some_and(|open| open.holds(4.0)))
    };
    assert_eq!(open(&[ball(-10.0, 10.0)]), (true, true, false));
    assert_eq!(open(&[ball(-10.0, 10.0), ball(-5.0, 1.0)]), (true, false, true));
}

/// Each ray is counted once in each of its places, and what is a failure is named.
#[test]
fn every_count_rises_where_it_should() {
    let ball = |z: f32| Sphere { center: [0.0, 0.0, z], radius: 1.0, color: [9; 3] };
    let scene = Scene::new(vec![ball(-5.0), ball(-10.0), ball(-5.0)], [0; 3], DEFAULT_LIGHT).expect("valid");
    let ray = Ray { eye: [0.0; 3], dir: [0.0, 0.0, -1.0] };
    let stand = |miss: bool, spheres: &[u32]| {
        let range = |id: u32| if id == 1 { [8.9, 9.1] } else { [3.9, 4.1] };
        let open = |id: &u32| (*id, Open([Some(range(*id)), None]));
        Stand { miss, spheres: spheres.iter().map(open).collect() }
    };
    let (miss, near, far, twin) = ((MISS, f32::INFINITY), (0, 4.0), (1, 9.0), (2, 4.0));
    let exact = Hearing { rays: 1, hits: 1, t_ulp: one_at(0), ..Hearing::default() };
    let both_open = Hearing { rays: 1, hits: 1, in_band: 1, ..Hearing::default() };
    let blank = Hearing { rays: 1, ..Hearing::default() };
    let decided = Some(stand(false, &[0]));
    let open = Some(stand(true, &[0, 1, 2]));
    let steps = |n: u32| (0, f32::from_bits(4f32.to_bits() + n));
    type Row = (Option<Stand>, [(u32, f32); 2], Hearing, Option<&'static str>);
    let rows: [Row; 20] = [
        (None, [near, near], Hearing { not_stated: [1, 0], ..blank.clone() }, None),
        (None, [near, far], Hearing { not_stated: [1, 1], ..blank.clone() }, None),
        (decided.clone(), [near, near], exact.clone(), None),
        (Some(stand(true, &[])), [miss, miss], blank.clone(), None),
        (open.clone(), [miss, miss], Hearing { in_band: 1, ..blank.clone() }, None),
        (
            decided.clone(),
            [near, steps(3)],
            Hearing { t_ulp: one_at(3), t_ulp_max: 3, ..exact.clone() },
            None,
        ),
        (
            decided.clone(),
            [steps(70_000), near],
            Hearing { t_ulp: one_at(11), t_ulp_max: 70_000, ..exact.clone() },
            None,
        ),
        (decided.clone(), [near, miss], Hearing { outside: 1, ..blank.clone() }, Some("the witness's id")),
        (decided.clone(), [miss, near], Hearing { outside: 1, ..blank.clone() }, Some("the reference's id")),
        (
            decided.clone(),
            [near, far],
            Hearing { outside: 1, hits: 1, ..blank.clone() },
            Some("the witness's id"),
        ),
        (
            Some(stand(false, &[0, 2])),
            [near, far],
            Hearing { beyond: 1, ..both_open.clone() },
            Some("the witness's id"),
        ),
        (
            Some(stand(true, &[0])),
            [far, near],
            Hearing { beyond: 1, ..both_open.clone() },
            Some("the reference's id"),
        ),
        (decided.clone(), [near, (0, 4.2)], Hearing { wrong_t: 1, hits: 1, ..blank.clone() }, Some("t")),
        (decided, [(0, 3.8), near], Hearing { wrong_t: 1, hits: 1, ..blank.clone() }, Some("t")),
        (Some(stand(true, &[])), [miss, (MISS, 9.0)], Hearing { wrong_t: 1, ..blank.clone() }, Some("t")),
        (Some(stand(true, &[])), [(MISS, 9.0), miss], Hearing { wrong_t: 1, ..blank.clone() }, Some("t")),
        (Some(stand(true, &[])), [miss, (MISS, f32::NAN)], Hearing { wrong_t: 1, ..blank }, Some("t")),
        (open.clone(), [near, far], one_inside(&both_open, |inside| &mut inside.reference), None),
        (open.clone(), [near, twin], one_inside(&both_open, |inside| &mut inside.ties), None),
        (
            open.clone(),
            [far, near],
            one_inside(&both_open, |inside| &mut inside.witness),
            Some("integers say that the reference is wrong"),
        ),
    ];
    for (stand, answers, due, failure) in rows {
        let mut hearing = Hearing::default();
        let said = hearing.count(&scene, &ray, stand.as_ref(), answers);
        assert_eq!((&hearing, said), (&due, failure), "{stand:?}, {answers:?}");
        assert_eq!(hearing.failures(), u64::from(failure.is_some()), "{hearing:?}");
    }
    let mut hearing = Hearing::default();
    let said = hearing.count(&scene, &ray, open.as_ref(), [far, twin]);
    assert_eq!(
        (hearing, said),
        (one_inside(&both_open, |inside| &mut inside.neither), Some("integers say that both are wrong"))
    );
}

fn one_at(class: usize) -> [u64; 12] {
    std::array::from_fn(|i| u64::from(i == class))
}

fn one_inside(hearing: &Hearing, which: fn(&mut Adjudicated) -> &mut u64) -> Hearing {
    let mut hearing = hearing.clone();
    *which(&mut hearing.inside) += 1;
    hearing
}

/// Sums take every count, and the first failure of the first that has one.
#[test]
fn hearings_add_up() {
    let made = |k: u64, first: Option<&str>| Hearing {
        witness: "w".into(),
        mode: "m".into(),
        rays: k,
        hits: 2 * k,
        not_stated: [3 * k, 4 * k],
        in_band: 5 * k,
        outside: 6 * k,
        beyond: 7 * k,
        inside: Adjudicated { reference: 8 * k, witness: 9 * k, neither: 10 * k, ties: 11 * k },
        wrong_t: 12 * k,
        t_ulp: std::array::from_fn(|i| (13 + i as u64) * k),
        t_ulp_max: 30 * k,
        first: first.map(str::to_owned),
    };
    let (one, ten) = (made(1, None), made(10, Some("here")));
    for (sum, first) in [(one.clone().and(&ten), "here"), (ten.clone().and(&made(1, Some("there"))), "here")]
    {
        let due = Hearing { t_ulp_max: 300, ..made(11, Some(first)) };
        assert_eq!(sum, due);
    }
    assert_eq!(one.failures(), 6 + 7 + 12 + 9 + 10);
    let word = |change: fn(&mut Hearing)| {
        let mut hearing = Hearing { rays: 5, ..Hearing::default() };
        change(&mut hearing);
        hearing.verdict()
    };
    assert_eq!(word(|_| ()), Verdict::WithinBound);
    assert_eq!(word(|hearing| hearing.not_stated[0] = 4), Verdict::Undecidable);
    assert_eq!(word(|hearing| hearing.not_stated[0] = 5), Verdict::NotJudged);
    let failures: [fn(&mut Hearing); 5] = [
        |hearing| hearing.outside = 1,
        |hearing| hearing.beyond = 1,
        |hearing| hearing.wrong_t = 1,
        |hearing| hearing.inside.witness = 1,
        |hearing| (hearing.inside.neither, hearing.not_stated[0]) = (1, 4),
    ];
    for wrong in failures {
        assert_eq!(word(wrong), Verdict::Wrong);
    }
    assert_eq!(
        word(|hearing| (hearing.inside.reference, hearing.inside.ties) = (3, 2)),
        Verdict::WithinBound
    );
}
