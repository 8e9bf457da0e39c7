//! Does the optimized SPU arithmetic, by way of f64 and in AVX-512, do to the bit what the reference does with integers?
//!
//! One operand is exhausted: all 2³² patterns with `CGT_SPU_STEP=1` (about a quarter of an hour on two cores), every 4,093rd in the everyday run. Pairs, as many as
//! `CGT_SPU_PAIRS` says, are directed at what differs from IEEE 754: zeros of both signs, subnormal patterns, powers of two with their neighbours,
//! the last exponents, and sums that nearly cancel. Each machine is told apart from IEEE 754 by how often it differs.

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Size, Sphere};
use optimized::host::{Scalar, Spu, Work};
use optimized::machine::{LANES, Machine};
use optimized::plan::{Plan, Voxelizer};
use optimized::{Form, Level, Tracer};
use rand::{Rng, RngExt};
use rayon::prelude::*;
use reference::Arithmetic;
use reference::spu::Spu as Naive;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicU64, Ordering};
use verify::seed::{count, generator, seed};

/// Patterns in sixteen lanes.
type Lanes = [u32; LANES];

fn floats(x: Lanes) -> [f32; LANES] {
    x.map(f32::from_bits)
}

/// What the operations of a machine make of two patterns a lane: numbers, then yes or no, then integers.
struct Outcome {
    numbers: Vec<(&'static str, Lanes)>,
    answers: Vec<(&'static str, u32)>,
    integers: Vec<(&'static str, [i32; LANES])>,
}

fn outcome<M: Machine>(m: M, x: Lanes, y: Lanes) -> Outcome {
    m.within(
        #[inline(always)]
        || {
            let bits = |out: M::F| m.to_array(out).map(f32::to_bits);
            let (x, y) = (m.lanes(floats(x)), m.lanes(floats(y)));
            Outcome {
                numbers: vec![
                    ("add", bits(m.add(x, y))),
                    ("sub", bits(m.sub(x, y))),
                    ("mul", bits(m.mul(x, y))),
                    ("div", bits(m.div(x, y))),
                    ("sqrt", bits(m.sqrt(x))),
                    ("neg", bits(m.neg(x))),
                    ("select", bits(m.select(m.lt(x, y), x, y))),
                ],
                answers: vec![("lt", m.to_bits(m.lt(x, y))), ("le", m.to_bits(m.le(x, y)))],
                integers: vec![
                    ("floor", m.to_array_i(m.floor(x))),
                    ("truncate", m.to_array_i(m.truncate(x))),
                ],
            }
        },
    )
}

/// The SPU's machine beside that of a level.
struct OnLevel(Lanes, Lanes);

impl Work for OnLevel {
    type Output = Outcome;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Outcome {
        m.within(
            #[inline(always)]
            || outcome(m.spu(), self.0, self.1),
        )
    }
}

/// What the reference makes of one lane, in the order of [`Outcome::numbers`].
fn by_integers(x: u32, y: u32) -> [u32; 7] {
    let (p, q) = (Naive(x), Naive(y));
    let less = if p.less(q) { x } else { y };
    [(p + q).0, (p - q).0, (p * q).0, (p / q).0, p.sqrt().0, (-p).0, less]
}

/// Holds all machines of this processor against the reference; gives how often a number was not what IEEE 754 makes.
fn judge(x: Lanes, y: Lanes) -> u64 {
    let by_f64 = outcome(Spu::default(), x, y);
    let say = |what: &str, i: usize| format!("{what} of {:#010x} and {:#010x}", x[i], y[i]);
    for i in 0..LANES {
        let wanted = by_integers(x[i], y[i]);
        for ((what, out), wanted) in by_f64.numbers.iter().zip(wanted) {
            assert_eq!(format!("{:#010x}", out[i]), format!("{wanted:#010x}"), "{}", say(what, i));
        }
        let (p, q) = (Naive(x[i]), Naive(y[i]));
        for ((what, out), wanted) in by_f64.answers.iter().zip([p.less(q), p.less_equal(q)]) {
            assert_eq!(out >> i & 1 != 0, wanted, "{}", say(what, i));
        }
    }
    for level in Level::available() {
        let wide = level.run(OnLevel(x, y));
        for ((what, out), (_, wanted)) in wide.numbers.iter().zip(&by_f64.numbers) {
            for i in 0..LANES {
                let (out, wanted) = (format!("{:#010x}", out[i]), format!("{:#010x}", wanted[i]));
                assert_eq!(out, wanted, "{level}: {}", say(what, i));
            }
        }
        assert_eq!(wide.answers, by_f64.answers, "{level}: {x:x?}, {y:x?}");
        assert_eq!(wide.integers, by_f64.integers, "{level}: {x:x?}, {y:x?}");
    }
    let ieee = outcome(Scalar, x, y);
    let differs =
        |(out, ieee): (&(&str, Lanes), &(&str, Lanes))| (0..LANES).filter(|&i| out.1[i] != ieee.1[i]).count();
    by_f64.numbers.iter().zip(&ieee.numbers).map(differs).sum::<usize>() as u64
}

/// A pattern near one at which something changes, or any, of an exponent of these.
fn pattern(of: &RangeInclusive<u32>, rng: &mut impl Rng) -> u32 {
    let sign = rng.random::<u32>() & 1 << 31;
    let exponent = [0u32, 1, 2, 3, 64, 126, 127, 128, 150, 189, 190, 251, 252, 253, 254, 255];
    let exponent = if rng.random() { exponent[rng.random_range(0..16)] } else { rng.random_range(0..256) };
    let exponent = if of.contains(&exponent) { exponent } else { rng.random_range(of.clone()) };
    let fraction = match rng.random_range(0..4) {
        0 => [0, 1, 2, 0x3f_ffff, 0x40_0000, 0x7f_fffe, 0x7f_ffff][rng.random_range(0..7)],
        1 => 1 << rng.random_range(0..23),
        _ => rng.random_range(0..1 << 23),
    };
    sign | exponent << 23 | fraction
}

/// A partner: any, or one with which sums nearly cancel.
fn partner(x: u32, of: &RangeInclusive<u32>, rng: &mut impl Rng) -> u32 {
    if rng.random() {
        pattern(of, rng)
    } else {
        (x ^ 1 << 31).wrapping_add(rng.random_range(0..5)).wrapping_sub(2)
    }
}

/// One lane with a number that f32 has not sends all sixteen another way, so of four blocks two have none, neither operand nor
/// product, and one of these no quotient; and in one all lanes are alike.
#[test]
fn pairs_are_those_of_the_reference() {
    let seed = seed();
    let (blocks, other) = (count("CGT_SPU_PAIRS", 200_000) / LANES as u64, AtomicU64::new(0));
    (0..blocks).into_par_iter().for_each(|k| {
        let mut rng = generator(seed, k);
        let of = [0..=189, 64..=189, 0..=255, 0..=255][(k % 4) as usize].clone();
        let mut x: Lanes = std::array::from_fn(|_| pattern(&of, &mut rng));
        let mut y = x.map(|x| partner(x, &of, &mut rng));
        if k % 4 == 3 {
            (x, y) = ([x[0]; LANES], [y[0]; LANES]);
        }
        other.fetch_add(judge(x, y), Ordering::Relaxed);
    });
    let (pairs, other) = (blocks * LANES as u64, other.into_inner());
    eprintln!("{pairs} pairs, seed {seed}; {other} numbers are not those of IEEE 754");
    assert!(other > pairs / 2, "only {other} of {pairs} pairs show that this is not IEEE 754");
}

/// What the operations of one operand make of a pattern, in the order of [`single`]: the root, the reciprocal by way of the
/// estimate, and as integers the floor and the part before the point.
fn single_by_integers(x: u32) -> ([u32; 2], [i32; 2]) {
    let naive = Naive(x);
    ([naive.sqrt().0, (Naive::ONE / naive).0], whole(naive))
}

/// Floor and truncation of an SPU number, saturated, from its pattern alone.
fn whole(x: Naive) -> [i32; 2] {
    if x.is_zero() {
        return [0, 0];
    }
    let (negative, exponent) = (x.0 >> 31 != 0, (x.0 >> 23 & 0xff).cast_signed() - 127);
    if exponent >= 31 {
        return [if negative { i32::MIN } else { i32::MAX }; 2];
    }
    let units = i64::from(x.0 & 0x7f_ffff | 0x80_0000) << 31;
    // In units of 2^-54 before the shift: `units` is 1.f 2^54.
    let shift = (54 - exponent).min(62);
    let (before, rest) = (units >> shift, units & ((1i64 << shift) - 1) != 0);
    let (cut, up) = (before as i32, i32::from(rest));
    if negative { [-cut - up, -cut] } else { [cut, cut] }
}

fn single<M: Machine>(m: M, x: Lanes) -> ([Lanes; 2], [[i32; LANES]; 2]) {
    m.within(
        #[inline(always)]
        || {
            let x = m.lanes(floats(x));
            let bits = |out: M::F| m.to_array(out).map(f32::to_bits);
            let numbers = [bits(m.sqrt(x)), bits(m.div(m.splat(1.0), x))];
            (numbers, [m.to_array_i(m.floor(x)), m.to_array_i(m.truncate(x))])
        },
    )
}

/// The SPU's machine beside that of a level, with one operand.
struct SingleOnLevel(Lanes);

impl Work for SingleOnLevel {
    type Output = ([Lanes; 2], [[i32; LANES]; 2]);

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        m.within(
            #[inline(always)]
            || single(m.spu(), self.0),
        )
    }
}

/// All patterns, as the one operand of every operation that has one, or every so manieth.
#[test]
fn one_operand_is_exhausted() {
    let step = count("CGT_SPU_STEP", 4093);
    // Other levels have the SPU by f64 as it is asked here.
    let levels: Vec<Level> = Level::available()
        .into_iter()
        .filter(|level| ["avx2", "avx512"].contains(&level.to_string().as_str()))
        .collect();
    let judged = AtomicU64::new(0);
    (0..1u64 << 16).into_par_iter().for_each(|upper| {
        let first = upper % step;
        let lowers: Vec<u64> = (first..1 << 16).step_by(step as usize).collect();
        for lowers in lowers.chunks(LANES) {
            let x: Lanes =
                std::array::from_fn(|lane| (upper << 16 | lowers[lane.min(lowers.len() - 1)]) as u32);
            let by_f64 = single(Spu::default(), x);
            for (lane, x) in x.into_iter().enumerate() {
                let (numbers, integers) = single_by_integers(x);
                let say = |what: &str| format!("{what} of {x:#010x}");
                for (i, what) in ["root", "reciprocal"].into_iter().enumerate() {
                    let (out, wanted) = (by_f64.0[i][lane], numbers[i]);
                    assert!(out == wanted, "{}: {out:#010x}, not {wanted:#010x}", say(what));
                }
                for (i, what) in ["floor", "truncation"].into_iter().enumerate() {
                    let (out, wanted) = (by_f64.1[i][lane], integers[i]);
                    assert!(out == wanted, "{}: {out}, not {wanted}", say(what));
                }
            }
            for level in &levels {
                assert!(level.run(SingleOnLevel(x)) == by_f64, "{level}: {x:x?}");
            }
            judged.fetch_add(lowers.len() as u64, Ordering::Relaxed);
        }
    });
    let judged = judged.into_inner();
    let unheld = if levels.is_empty() { "; no AVX-512 here, embedded rounding was not judged" } else { "" };
    eprintln!("{judged} of 2^32 patterns{unheld}");
    let least = (1 << 32) / step / 2;
    assert!(judged > least && (step > 1 || judged == 1 << 32), "{judged} of 2^32 patterns");
}

/// A picture of the optimized tracer in the SPU's arithmetic is that of the reference's loop, whatever the way to the spheres.
#[test]
fn pictures_are_those_of_the_reference() {
    let seed = seed();
    let voxelizers = [Voxelizer::BoxRange, Voxelizer::Overlap, Voxelizer::ByCenter, Voxelizer::EightCorners];
    let (scenes, hits, other) = (count("CGT_SPU_SCENES", 48), AtomicU64::new(0), AtomicU64::new(0));
    (0..scenes).into_par_iter().for_each(|k| {
        let mut rng = generator(seed, k);
        // From within to so far that rounding alone decides; every fourth scene has each sphere twice.
        let (far, size) = (2f32.powf(rng.random_range(-1.0..12.0)), Size::new(21, 13).expect("small"));
        let sphere = |rng: &mut _| Sphere {
            center: std::array::from_fn(|i| {
                RngExt::random_range(rng, -1.0f32..1.0) + if i == 2 { far } else { 0.0 }
            }),
            radius: RngExt::random_range(rng, 0.02f32..0.4),
            color: [RngExt::random(rng), 100, 200],
        };
        let mut spheres: Vec<Sphere> = (0..25).map(|_| sphere(&mut rng)).collect();
        if k % 4 == 0 {
            spheres.extend_from_within(..);
        }
        let scene = Scene::new(spheres, [3, 2, 1], DEFAULT_LIGHT).expect("valid");
        let (w, h) = (2.4 / far.max(1.0) / 21.0, 2.4 / far.max(1.0) / 13.0);
        let camera = Camera::new([0.0; 3], [-10.5 * w, -6.5 * h, 1.0], [w, 0.0, 0.0], [0.0, h, 0.0], size);
        let camera = camera.expect("not degenerate");
        let pixels = |image: &Image| -> Vec<_> {
            let t = image.t.iter().map(|t| t.to_bits());
            image.ids.iter().copied().zip(t).zip(image.rgba.iter().copied()).collect()
        };
        for (form, naive, ieee) in [
            (Form::Textbook, Arithmetic::SpuTextbook, Arithmetic::F32Textbook),
            (Form::Perpendicular, Arithmetic::SpuPerpendicular, Arithmetic::F32Perpendicular),
        ] {
            let by = |naive| {
                reference::Tracer::new(naive).threads(1).render(&scene, &camera).expect("small").image
            };
            let (truth, ieee) = (by(naive), by(ieee));
            hits.fetch_add(truth.ids.iter().filter(|id| **id != MISS).count() as u64, Ordering::Relaxed);
            let differs = pixels(&truth).iter().zip(pixels(&ieee)).filter(|(x, y)| **x != *y).count();
            other.fetch_add(differs as u64, Ordering::Relaxed);
            for voxelizer in voxelizers {
                let plan =
                    Plan { voxelizer, arithmetic: optimized::plan::Arithmetic::Spu(form), ..Plan::safe() };
                for level in Level::available() {
                    let image = Tracer::new(plan, level).render(&scene, &camera).expect("a picture").image;
                    for (i, (out, wanted)) in pixels(&image).into_iter().zip(pixels(&truth)).enumerate() {
                        assert_eq!(
                            out, wanted,
                            "pixel {i}, {level}, {plan}, far {far}, scene {k}, seed {seed}"
                        );
                    }
                }
            }
        }
    });
    let (hits, other) = (hits.into_inner(), other.into_inner());
    eprintln!("{scenes} scenes, seed {seed}: {hits} hits, {other} pixels are not those of IEEE 754");
    assert!(hits > 20 * scenes && other > 10 * scenes, "too little at stake: {hits} hits, {other} different");
}

/// Directions that are zero on the SPU and not in IEEE 754 hit nothing, even from within a sphere.
#[test]
fn directions_that_are_zero_on_the_spu_hit_nothing() {
    let sphere = Sphere { center: [0.5, 0.0, 0.0], radius: 2.0, color: [200; 3] };
    let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(5, 5).expect("small");
    let tiny = f32::MIN_POSITIVE / 64.0;
    let camera =
        Camera::new([0.0; 3], [-tiny, -tiny, tiny], [tiny / 4.0, 0.0, 0.0], [0.0, tiny / 4.0, 0.0], size);
    let camera = camera.expect("not degenerate");
    for (form, naive) in
        [(Form::Textbook, Arithmetic::SpuTextbook), (Form::Perpendicular, Arithmetic::SpuPerpendicular)]
    {
        let naive = reference::Tracer::new(naive).threads(1).render(&scene, &camera).expect("small").image;
        assert_eq!(naive.ids, [MISS; 25], "{form:?}, reference");
        let plan = Plan { arithmetic: optimized::plan::Arithmetic::Spu(form), ..Plan::safe() };
        for level in Level::available() {
            let image = Tracer::new(plan, level).render(&scene, &camera).expect("a picture").image;
            assert_eq!(image.ids, [MISS; 25], "{form:?}, {level}");
        }
    }
}
