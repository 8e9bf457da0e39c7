//! Does the error bound of the f32 stage hold, and is half of it too little? On all inputs of two domains of small floats, and on
//! inputs made so that roundings add up, at the precision that ships.

use contract::{Camera, DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
use optimized::bound::{NEAREST, Rule};
use optimized::host::Scalar;
use optimized::machine::{LANES, Machine};
use optimized::plan::{Packet, Plan, Resolution};
use optimized::{Level, Tracer};
use rayon::prelude::*;
use verify::bounds::{Directions, Said, Trial, Whole, adverse, all_directions};
use verify::seed::{count, generator, seed};
use verify::small::{Mode, Small};

/// All of these balls against all of these rays.
fn exhaust(small: Small, factor: f32, balls: &[Whole], directions: &[Directions]) -> Said {
    let trial = Trial { machine: small, rule: Rule::new(small.unit()), factor };
    let said = balls.par_iter().map(|ball| {
        let mut said = Said::default();
        for directions in directions {
            trial.check(ball, directions, &mut said);
        }
        said
    });
    said.reduce(Said::default, |x, y| x + y)
}

/// Balls whose own coordinates are any of these, the eye at any of those on each axis.
fn balls(own: [&[i64]; 3], eyes: &[i64], radii: &[i64]) -> Vec<Whole> {
    let axis = |i: usize| own[i].iter().flat_map(|&x| eyes.iter().map(move |&eye| (x, eye)));
    let mut balls = Vec::new();
    for a in axis(0) {
        for y in axis(1) {
            for z in axis(2) {
                for &radius in radii {
                    let eye = [a.1, y.1, z.1];
                    balls.push(Whole { center: [a.0 - a.1, y.0 - y.1, z.0 - z.1], eye, radius });
                }
            }
        }
    }
    balls
}

/// 8-bit floats (sign, 4 bits of exponent, 3 of fraction): all rays with whole directions of 4 bits against all balls with whole
/// coordinates of 4 bits and the eye at 0 or −1 on every axis, so that the difference may need 5 bits. Of the 15 radii
/// `CGT_BOUND_RADII` are taken, 1 every day.
#[test]
fn it_holds_for_all_floats_of_8_bits() {
    let radii = i64::try_from(count("CGT_BOUND_RADII", 1)).expect("at most 15").clamp(1, 15);
    let radii: Vec<i64> = (0..radii).map(|i| 1 + i * 15 / radii).collect();
    let (signed, ahead): (Vec<i64>, Vec<i64>) = ((-15..=15).collect(), (1..=15).collect());
    let balls = balls([&ahead, &signed, &signed], &[0, -1], &radii);
    let directions = all_directions(4, 15);
    for mode in [Mode::Nearest, Mode::Truncating] {
        let said = exhaust(Small { bits: 4, mode }, 1.0, &balls, &directions);
        eprintln!("{mode:?}: {said:?}");
        assert_eq!(said.wrong, 0, "{mode:?}: {:?}", said.first);
        assert_eq!(said.inputs, (balls.len() * directions.len() * LANES) as u64);
        assert!(said.roots > said.inputs / 1000, "{mode:?}: hardly a root, nothing is at stake");
        assert!(said.misses > said.inputs / 2000, "nothing was decided");
    }
}

/// Floats with 8 significant bits (those of bfloat16): all rays within 4 of the diagonal, all balls of small radius whose
/// coordinates are the floats just above a power of two, the eye at either end of what rounding takes off.
#[test]
fn it_holds_for_all_floats_about_the_worst_case_and_half_of_it_does_not() {
    let small = Small { bits: 8, mode: Mode::Nearest };
    let near: Vec<i64> = (128..=132).map(|x| 64 * x).collect();
    let balls = balls([&[64 * 131], &near, &near], &[-29, 29], &[16, 18, 20]);
    let directions = all_directions(8, 4);
    for (factor, holds) in [(1.0, true), (0.5, false)] {
        let said = exhaust(small, factor, &balls, &directions);
        eprintln!("{factor} of the bound: {said:?}");
        assert_eq!(said.wrong == 0, holds, "{factor} of the bound: {:?}", said.first);
        assert!(said.roots > said.inputs / 1000 && said.misses > said.inputs / 1000, "nothing is at stake");
    }
}

/// `CGT_BOUND_CASES` adverse inputs, 200,000 every day.
fn adversity<M: Machine + Sync + Send>(trial: Trial<M>, small: Small) -> Said {
    let (seed, cases) = (seed(), count("CGT_BOUND_CASES", 200_000));
    let said = (0..cases).into_par_iter().map(|i| {
        let (ball, direction) = adverse(small, i % 2 == 1, &mut generator(seed, i));
        let mut said = Said::default();
        trial.check(&ball, &[direction; LANES], &mut said);
        said
    });
    let said = said.reduce(Said::default, |x, y| x + y);
    eprintln!("CGT_SEED={seed}, {small:?}, {} of the bound: {said:?}", trial.factor);
    said
}

#[test]
fn it_holds_where_roundings_add_up_and_half_of_it_does_not() {
    let f32s = Small { bits: 24, mode: Mode::Nearest };
    let whole = adversity(Trial { machine: Scalar, rule: Rule::new(NEAREST), factor: 1.0 }, f32s);
    assert_eq!(whole.wrong, 0, "{:?}", whole.first);
    let half = adversity(Trial { machine: Scalar, rule: Rule::new(NEAREST), factor: 0.5 }, f32s);
    assert!(half.wrong > half.inputs / 1000, "half of the bound is hardly ever too little: {half:?}");
}

/// Pictures too need the whole bound: of one pixel, which shows an adverse input, by blocks and by tiles.
#[test]
fn pictures_of_adverse_inputs_are_exact() {
    let (seed, small) = (seed(), Small { bits: 24, mode: Mode::Nearest });
    let (level, size) = (Level::best().expect("a level"), Size::new(1, 1).expect("a pixel"));
    let each = (0..8_000u64).into_par_iter().map(|i| {
        let (ball, direction) = adverse(small, i % 2 == 1, &mut generator(seed, i));
        // Into the range of the margins, by powers of two.
        #[allow(clippy::cast_precision_loss, reason = "all are floats")]
        let [place, along] = [2f32.powi(-24), 2f32.powi(-20)].map(|scale| move |x: i64| x as f32 * scale);
        let center = [0, 1, 2].map(|axis| place(ball.center[axis] + ball.eye[axis]));
        let sphere = Sphere { center, radius: place(ball.radius), color: [9; 3] };
        let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
        // So little to the next pixel that its middle is the corner, but for rounding.
        let step = 2f32.powi(-22);
        let (eye, corner) = (ball.eye.map(place), direction.map(along));
        let camera = Camera::new(eye, corner, [0.0, step, 0.0], [0.0, 0.0, step], size).expect("valid");
        let ray = reference::Ray::of_pixel(&camera, 0, 0);
        assert_eq!(ray.dir, corner, "case {i} of CGT_SEED={seed}: another direction");
        let truth = reference::Tracer::new(reference::Arithmetic::Exact).trace(&ray, &scene);
        for packet in [Packet::Block, Packet::Tile { side: 1 }] {
            let plan = Plan { packet, resolution: Resolution::Fixed(1), ..Plan::fast() };
            let rendering = Tracer::new(plan, level).render(&scene, &camera).expect("nothing to refuse");
            assert_eq!(rendering.events.count(), 0, "out of range: {camera:?}, {sphere:?}");
            let [id, t] = [rendering.image.ids[0], rendering.image.t[0].to_bits()];
            let wanted = truth.map_or([MISS, f32::INFINITY.to_bits()], |hit| [hit.id, hit.t.to_bits()]);
            assert_eq!([id, t], wanted, "case {i} of CGT_SEED={seed}: {ball:?}, {direction:?}, {plan}");
        }
        u64::from(truth.is_some())
    });
    let hits: u64 = each.sum();
    eprintln!("CGT_SEED={seed}: 8000 pixels, {hits} hits");
    assert!((3_000..5_000).contains(&hits), "too little was at stake: {hits}");
}

/// Truncation needs twice the unit roundoff of rounding to nearest.
#[test]
fn truncation_needs_its_own_bound() {
    let small = Small { bits: 12, mode: Mode::Truncating };
    let own = adversity(Trial { machine: small, rule: Rule::new(small.unit()), factor: 1.0 }, small);
    assert_eq!(own.wrong, 0, "{:?}", own.first);
    let nearest = Small { mode: Mode::Nearest, ..small }.unit();
    let others = adversity(Trial { machine: small, rule: Rule::new(nearest), factor: 1.0 }, small);
    assert!(others.wrong > 0, "the bound for rounding to nearest is enough: {others:?}");
}

/// The check of roots alone: without any bound the sphere that is hit is told from the one that is not, mostly, and nearly no root lies
/// where it should.
#[test]
fn without_a_bound_roots_lie_elsewhere() {
    let (signed, ahead): (Vec<i64>, Vec<i64>) = ((-15..=15).collect(), (1..=15).collect());
    let balls = balls([&ahead, &signed, &signed], &[0], &[9]);
    let small = Small { bits: 4, mode: Mode::Nearest };
    let directions = all_directions(4, 3);
    let (full, none) = (exhaust(small, 1.0, &balls, &directions), exhaust(small, 0.0, &balls, &directions));
    eprintln!("{full:?}, without: {none:?}");
    assert_eq!(full.wrong, 0, "{:?}", full.first);
    assert!(
        none.wrong > full.roots / 3,
        "of {} roots {} lie elsewhere without a bound",
        full.roots,
        none.wrong
    );
}
