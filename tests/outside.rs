//! Can the court of outside witnesses be fooled? Made-up witnesses with one fault each, and a reference with one, must
//! get the verdict and the counts that fit. No Embree is needed: a witness here is the naive perpendicular form.

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Size, Sphere};
use reference::{Arithmetic, Ray, Tracer};
use verify::judge::band::{Band, band};
use verify::judge::outside::{Hearing, Stand, Testimony, Witness, hear};
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
    assert_eq!(hearing.rays, 96 * 64);
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
