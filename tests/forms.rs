//! How wrong are the forms of f32 and of the SPU far away? Figures measured before this project began (200,000 rays at a
//! unit sphere at distance D) must come out again from the shipped forms against the exact truth.
//!
//! Those figures do not say how far the rays spread; a disc of 1.7 radii fits them best. Hence a factor of 1.8
//! either way on the textbook form; the spread of the disc enters its share of wrong rays, and not its median error.

use contract::{DEFAULT_LIGHT, Scene};
use optimized::camera::Block;
use optimized::host::{Scalar, Work};
use optimized::machine::Machine;
use optimized::seen::{Seen, Worker};
use optimized::sphere::NONE;
use optimized::{Form, Level, Plan};
use rand::RngExt;
use rayon::prelude::*;
use reference::{Arithmetic, Hit, Ray, Tracer};
use verify::directed::{KINDS, aimed, case};
use verify::seed::{count, generator, seed};

const SPREAD: f64 = 1.7;
const FACTOR: f64 = 1.8;

/// Distance in radii; textbook rays wrong, in percent; its median error of t, in radii; textbook rays wrong where results
/// are cut off, as on the SPU; most perpendicular rays wrong, in percent (10 times the figure measured then: that was 2 to
/// 6 rays of 200,000).
///
/// Of results cut off the last figure was 61.9 then, which does not come out: it is printed, and not judged. Beyond 4,096 radii
/// r² is less than the last place of |f|², and what is left of it depends on details of that arithmetic that are not known
/// (with sums of products and b² − a q fused it was 34, not fused 24).
const ROWS: [(f64, f64, f64, Option<f64>, f64); 4] = [
    (100.0, 0.023, 4e-4, Some(0.024), 0.003),
    (1000.0, 2.2, 3e-2, Some(3.0), 0.01),
    (2000.0, 9.2, 0.13, Some(11.7), 0.03),
    (4100.0, 27.7, 0.9, None, 0.03),
];

#[test]
fn forms_fail_as_measured() {
    let (seed, rays) = (seed(), count("CGT_FORM_RAYS", 1_000_000));
    eprintln!("CGT_SEED={seed}, {rays} rays a row");
    for (distance, wrong, median, cut_off, perpendicular) in ROWS {
        let shots: Vec<Shot> = (0..rays).into_par_iter().map(|i| shoot(distance, seed, i)).collect();
        let percent = |pick: fn(&Shot) -> bool| {
            100.0 * shots.iter().filter(|shot| pick(shot)).count() as f64 / rays as f64
        };
        let (textbook_is, perpendicular_is) =
            (percent(|s| s.textbook_wrong), percent(|s| s.perpendicular_wrong));
        let (cut_off_is, spu_perpendicular_is) =
            (percent(|s| s.spu_textbook_wrong), percent(|s| s.spu_perpendicular_wrong));
        let mut errors: Vec<f64> = shots.iter().filter_map(|shot| shot.textbook_error).collect();
        errors.sort_by(f64::total_cmp);
        let median_is = errors[errors.len() / 2];
        eprintln!(
            "{distance} radii: textbook {textbook_is:.3} % wrong (then {wrong} %), median error of t {median_is:.1e} radii (then {median:.0e}), perpendicular {perpendicular_is:.4} % wrong"
        );
        eprintln!(
            "on the SPU: textbook {cut_off_is:.3} % (then {cut_off:?}), perpendicular {spu_perpendicular_is:.4} %"
        );
        let near = |is: f64, then: f64| (then / FACTOR..=then * FACTOR).contains(&is);
        assert!(
            near(textbook_is, wrong),
            "textbook at {distance}: {textbook_is} % wrong, expected {wrong} %"
        );
        assert!(
            cut_off.is_none_or(|then| near(cut_off_is, then)),
            "textbook of the SPU at {distance}: {cut_off_is} % wrong, expected {cut_off:?}"
        );
        assert!(near(median_is, median), "textbook at {distance}: median {median_is}, expected {median}");
        assert!(perpendicular_is <= perpendicular, "perpendicular at {distance}: {perpendicular_is} % wrong");
        assert!(
            spu_perpendicular_is <= perpendicular,
            "perpendicular of the SPU at {distance}: {spu_perpendicular_is} % wrong"
        );
    }
}

struct Shot {
    textbook_wrong: bool,
    textbook_error: Option<f64>,
    perpendicular_wrong: bool,
    spu_textbook_wrong: bool,
    spu_perpendicular_wrong: bool,
}

fn shoot(distance: f64, seed: u64, i: u64) -> Shot {
    let mut rng = generator(seed, i);
    let impact = SPREAD * rng.random_range(0.0f64..1.0).sqrt();
    let case = aimed(distance, impact, &mut rng);
    let scene = Scene::new(case.spheres[..1].to_vec(), [0; 3], DEFAULT_LIGHT).expect("a unit sphere");
    let trace = |arithmetic| Tracer::new(arithmetic).trace(&case.ray, &scene);
    let (truth, textbook) = (trace(Arithmetic::Exact), trace(Arithmetic::F32Textbook));
    let perpendicular = trace(Arithmetic::F32Perpendicular);
    let error = |x: Hit, y: Hit| (f64::from(x.t) - f64::from(y.t)).abs() * length(&case.ray);
    Shot {
        textbook_wrong: truth.is_some() != textbook.is_some(),
        textbook_error: truth.zip(textbook).map(|(x, y)| error(x, y)),
        perpendicular_wrong: truth.is_some() != perpendicular.is_some(),
        spu_textbook_wrong: truth.is_some() != trace(Arithmetic::SpuTextbook).is_some(),
        spu_perpendicular_wrong: truth.is_some() != trace(Arithmetic::SpuPerpendicular).is_some(),
    }
}

fn length(ray: &Ray) -> f64 {
    ray.dir.iter().map(|&x| f64::from(x) * f64::from(x)).sum::<f64>().sqrt()
}

/// One ray in all lanes by a form's kernel, at some level and without a grid.
struct Kernel<'a>(&'a Seen, &'a Scene, [f32; 3]);

impl Work for Kernel<'_> {
    type Output = Option<(u32, u32)>;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        let Self(seen, scene, dir) = self;
        let block = Block::new(m, dir.map(|d| m.splat(d)));
        let mut worker = Worker::default();
        let answers = m.within(|| seen.trace(m, scene.spheres(), &block, None, &mut worker));
        let (id, t) = (m.to_array_i(answers.owners.id)[0], m.to_array(answers.t)[0]);
        (id != NONE).then(|| (id.unsigned_abs(), t.to_bits()))
    }
}

/// Directed rays of every kind by the kernels of `optimized`: tangents, ties, eyes on surfaces, and t beyond f32 come out as the contract
/// rounds them.
#[test]
fn kernels_are_the_naive_forms_where_decisions_are_close() {
    let (seed, cases, levels) = (seed(), count("CGT_FORM_CASES", 60_000), Level::available());
    eprintln!("CGT_SEED={seed}, {cases} rays");
    let forms =
        [(Form::Textbook, Arithmetic::F32Textbook), (Form::Perpendicular, Arithmetic::F32Perpendicular)];
    let judge = |i: u64| {
        let at = usize::try_from(i).expect("few");
        let case = case(KINDS[at % KINDS.len()], &mut generator(seed, i));
        let scene = Scene::new(case.spheres.clone(), [0; 3], DEFAULT_LIGHT).expect("valid by construction");
        let level = levels[at / KINDS.len() % levels.len()];
        forms.map(|(form, naive)| {
            let plan = Plan { arithmetic: form.into(), ..Plan::safe() };
            let seen = Seen::without_grid(Scalar, plan, scene.spheres(), case.ray.eye);
            let given = level.run(Kernel(&seen, &scene, case.ray.dir));
            let expected = Tracer::new(naive).trace(&case.ray, &scene).map(|hit| (hit.id, hit.t.to_bits()));
            assert_eq!(
                expected, given,
                "naive, kernel; {form:?} at {level}, case {i} of CGT_SEED={seed}: {case:?}"
            );
            [
                u64::from(given.is_some()),
                u64::from(given.is_some_and(|(_, t)| f32::from_bits(t).is_infinite())),
            ]
        })
    };
    let sum = |x: [[u64; 2]; 2], y: [[u64; 2]; 2]| [0, 1].map(|f| [0, 1].map(|i| x[f][i] + y[f][i]));
    let hits = (0..cases).into_par_iter().map(judge).reduce(|| [[0; 2]; 2], sum);
    eprintln!("of each form hits, and of these at an infinite t: {hits:?}");
    assert!(
        hits.iter().all(|[hits, infinite]| *hits > cases / 4 && *infinite > 0),
        "too little was at stake"
    );
}
