//! Do the margins of slices, culling, outlines and tiles cover all that rounding can do? The shipped kernels run on floats of few bits,
//! whose margins are so many of *their* roundings, over all inputs of a domain, and integers say what is true. Every domain must also find
//! out a margin that is too small: at 0 in any case, and the largest power of two at which it does is printed.
//!
//! Coordinates are just above a power of two, where roundings are largest, with the eye on either side of zero by nearly half of what is
//! rounded off. `CGT_MARGINS_VALUES` says how many neighbours of such a coordinate are taken, 3 every day.

use contract::{Camera, Size};
use optimized::frustum::Heading;
use optimized::machine::{LANES, Machine};
use rayon::prelude::*;
use verify::bounds::Whole;
use verify::margins::{Judged, Place, Trial};
use verify::seed::count;
use verify::small::{Mode, Small};

/// Steps of a whole coordinate to the unit in which eyes are given.
const FINER: i64 = 64;
/// Nearly half a step.
const OFF: i64 = 29;

fn values() -> i64 {
    i64::try_from(count("CGT_MARGINS_VALUES", 3)).expect("few").clamp(1, 32)
}

/// Of directions of 16 bits every so many on either axis are taken: 2,666 every day.
fn sparse() -> usize {
    usize::try_from(8000 / values()).expect("positive")
}

/// The floats of so many bits from a power of two on, `values` of them.
fn above(bits: u32) -> Vec<i64> {
    let low = 1i64 << (bits - 1);
    (low..low + values().min(low)).map(|x| FINER * x).collect()
}

/// These, the same with the other sign, and some more.
fn both(values: &[i64], more: &[i64]) -> Vec<i64> {
    let mut all: Vec<i64> = values.iter().flat_map(|&x| [x, -x]).chain(more.iter().copied()).collect();
    all.sort_unstable();
    all
}

/// All directions along (A, Y) of whole numbers of exactly so many bits, Y at most A, ascending in slope; or of both numbers every `step`-th.
fn directions(bits: u32, step: usize) -> Vec<[i64; 2]> {
    let most = 1i64 << bits;
    let aside = |a: i64| (-a..=a).step_by(step).map(move |y| [a, y]);
    let mut all: Vec<[i64; 2]> = (most / 2..most).step_by(step).flat_map(aside).collect();
    // Compared by cross products, so exactly.
    all.sort_unstable_by(|x, y| (x[1] * y[0]).cmp(&(y[1] * x[0])));
    all
}

/// How many there are.
fn number_of_directions(bits: u32, step: usize) -> u64 {
    let low = 1usize << (bits - 1);
    (0..low.div_ceil(step)).map(|i| 2 * (low + i * step) / step + 1).sum::<usize>() as u64
}

/// A vector along (A, Y, Z) for the heading of that number.
fn turned([a, y, z]: [i64; 3], number: usize) -> [i64; 3] {
    let Heading { order, forward } = Heading::all()[number % 6];
    let mut out = [0; 3];
    out[order[0]] = if forward { a } else { -a };
    (out[order[1]], out[order[2]]) = (y, z);
    out
}

/// Runs a check over all of a domain at full margins, by both roundings, and then with less and less of them.
fn hold<T: Sync>(what: &str, bits: u32, domain: &[T], check: impl Fn(Trial, &T) -> Judged + Sync) -> Judged {
    let each = |mode, factor| {
        let (trial, check) = (Trial { small: Small { bits, mode }, factor }, &check);
        domain.par_iter().map(move |of| check(trial, of))
    };
    let all = |mode, factor| each(mode, factor).reduce(Judged::default, |x, y| x + y);
    let [full, truncating] = [Mode::Nearest, Mode::Truncating].map(|mode| all(mode, 1.0));
    eprintln!("{what}, {bits} bits, to nearest: {full:?}");
    eprintln!("{what}, {bits} bits, truncating: {truncating:?}");
    assert_eq!(full.wrong, 0, "{what}: {:?}", full.first);
    assert_eq!(truncating.wrong, 0, "{what}, truncating: {:?}", truncating.first);
    assert_eq!(full.inputs, truncating.inputs);
    let fails = |factor| each(Mode::Nearest, factor).find_any(|judged| judged.wrong > 0).is_some();
    let largest = (1..=8).map(|power| 0.5f32.powi(power)).find(|&factor| fails(factor));
    let none = all(Mode::Nearest, 0.0);
    eprintln!("{what}: with {largest:?} of the margins it fails; without any, in {} inputs", none.wrong);
    assert!(none.wrong > 0, "{what}: the domain does not find out that there are no margins");
    full
}

/// What rays and slices are made of.
struct Slicing {
    bits: u32,
    /// Of directions.
    step: usize,
    majors: Vec<i64>,
    minors: Vec<i64>,
    reaches: Vec<i64>,
    planes: Vec<i64>,
}

/// A point of a ray in a slice lies between the slice's bounds, and so does whatever centre of a sphere is within reach of it: all floats of 4
/// bits up to 15 (those of 8-bit floats with 3 of fraction), and floats of 6 and of 16 bits just above a power of two. With few bits
/// roundings meet in all ways; with many, margins are small, and whatever else is wrong shows.
#[test]
fn a_ray_lies_between_the_bounds_of_its_slices() {
    let all: Vec<i64> = (-15..=15).collect();
    let mut domains = vec![Slicing {
        bits: 4,
        step: 1,
        majors: vec![-1, 0],
        minors: all.clone(),
        reaches: vec![0],
        planes: all,
    }];
    for (bits, step) in [(6, 1), (16, sparse())] {
        let near = above(bits);
        domains.push(Slicing {
            bits,
            step,
            majors: vec![-OFF, OFF],
            minors: both(&near[..near.len() / 2], &[0]),
            reaches: vec![0, 5 * FINER],
            planes: both(&near, &[-FINER, -1, 0, 1, FINER, near[0] + near[0] / 2]),
        });
    }
    for Slicing { bits, step, majors, minors, reaches, planes } in domains {
        let directions = directions(bits, step);
        let rays: Vec<[i64; 3]> = directions
            .iter()
            .enumerate()
            .map(|(number, &[a, y])| turned([a, y, if number % 12 < 6 { 0 } else { -y }], number))
            .collect();
        let full = hold("slices", bits, &rays, |trial, &ray| {
            let mut judged = Judged::default();
            let packet = trial.packet([ray; 2]).expect("one ray has a heading");
            for &major in &majors {
                for &minor in &minors {
                    for &reach in &reaches {
                        trial.slices(&packet, Place { major, minor, reach }, &planes, &mut judged);
                    }
                }
            }
            judged
        });
        let pairs = (planes.len() * (planes.len() + 1) / 2) as u64;
        let places = (majors.len() * minors.len() * reaches.len()) as u64;
        assert_eq!(full.inputs, number_of_directions(bits, step) * places * pairs * 2);
        assert!(full.demanded > full.inputs / 4, "hardly a slice is met: {full:?}");
        assert!(full.dropped > full.inputs / 20, "hardly a slice lies behind: {full:?}");
    }
}

/// Balls at all places of the domain, with the eye on either side of zero.
fn balls(a: &[i64], y: &[i64], z: &[i64], eyes: [&[i64]; 3]) -> Vec<Whole> {
    let axis = |own: &[i64], eyes: &[i64]| -> Vec<(i64, i64)> {
        own.iter().flat_map(|&own| eyes.iter().map(move |&eye| (own, eye))).collect()
    };
    let (a, y, z) = (axis(a, eyes[0]), axis(y, eyes[1]), axis(z, eyes[2]));
    let mut balls = Vec::new();
    for a in &a {
        for y in &y {
            for z in &z {
                let center = [a.0 - a.1, y.0 - y.1, z.0 - z.1];
                balls.push(Whole { center, eye: [a.1, y.1, z.1], radius: 1 });
            }
        }
    }
    balls
}

fn culled(what: &str, bits: u32, radii: usize, packets: &[[[i64; 3]; 2]], balls: &[Whole]) -> Judged {
    let full = hold(what, bits, packets, |trial, &rays| {
        let mut judged = Judged::default();
        let packet = trial.packet(rays).expect("rays of one heading");
        for ball in balls {
            trial.culling(&packet, ball, &mut judged);
        }
        judged
    });
    assert_eq!(full.inputs, (packets.len() * balls.len() * radii) as u64, "{what}");
    assert!(full.demanded > full.inputs / 3, "{what}: hardly a ball is touched: {full:?}");
    full
}

/// Packets of one ray, with the headings in turn.
fn single(directions: &[[i64; 2]]) -> Vec<[[i64; 3]; 2]> {
    directions.iter().enumerate().map(|(number, &[a, y])| [turned([a, y, 0], number); 2]).collect()
}

/// A ball that a ray of the packet touches is not culled, in the plane of the major and one minor axis, where margins are smallest: all
/// floats of 4 bits up to 15 (with margins that are as large as coordinates, so that hardly any ball is culled), and floats of 6 and
/// of 16 bits just above a power of two, in packets of one ray and of two.
#[test]
fn a_ball_that_is_touched_is_not_culled() {
    let all: Vec<i64> = (-15..=15).collect();
    let balls_of_four = balls(&all, &all, &[0], [&[-1], &[0], &[0]]);
    culled("culling, one ray", 4, 2, &single(&directions(4, 1)), &balls_of_four);

    for (bits, step) in [(6, 1), (16, sparse())] {
        let near = above(bits);
        let ahead = both(&near, &[-FINER, 0, FINER]);
        let beside = both(&near, &[-near[0] / 2, 0, near[0] / 4]);
        let balls = balls(&ahead, &beside, &[0], [&[-OFF, OFF], &[-OFF, OFF], &[0]]);
        let all = directions(bits, step);
        assert_eq!(number_of_directions(bits, step), all.len() as u64);
        let few: Vec<[i64; 2]> = all.iter().copied().step_by(all.len() / 40).collect();
        let pairs = few.iter().enumerate().flat_map(|(i, &x)| few[i + 1..].iter().map(move |&y| [x, y]));
        let two: Vec<[[i64; 3]; 2]> = pairs.map(|pair| pair.map(|[a, y]| [a, y, 0])).collect();
        for (what, radii, packets) in [("culling, one ray", 2, single(&all)), ("culling, two rays", 3, two)] {
            let full = culled(what, bits, radii, &packets, &balls);
            assert!(full.dropped > full.inputs / 100, "hardly a ball is culled: {full:?}");
        }
    }
}

/// The same for rays and balls anywhere in space: rays close to the diagonals.
#[test]
fn a_ball_that_is_touched_in_space_is_not_culled() {
    for (bits, step) in [(7, 1), (16, sparse())] {
        let near = above(bits);
        let beside = both(&near[..near.len().min(2)], &[]);
        let balls = balls(&near, &beside, &beside, [&[-OFF, OFF]; 3]);
        let mut packets = Vec::new();
        for a in (near[0] / FINER..2 * near[0] / FINER).step_by(step) {
            let sides =
                [(a, a), (a, a - 1), (a - 1, a), (a - 2, a - 1), (-a, a - 1), (a - 1, -a), (1 - a, 1 - a)];
            packets.extend(sides.map(|(y, z)| [[a, y, z]; 2]));
        }
        let full = culled("culling in space", bits, 2, &packets, &balls);
        assert!(full.dropped > full.inputs / 100, "hardly a ball is culled: {full:?}");
    }
}

/// A ball that a ray hits has the ray's slopes in its outline, and no point of it is nearer than the outline says; against all directions of
/// 10 bits, and a great many of 16.
#[test]
fn an_outline_holds_what_hits() {
    for (bits, step) in [(10, 1), (16, sparse() / 16)] {
        let directions = directions(bits, step);
        let near = above(bits);
        let with_eyes = |own: i64| [[own, -OFF], [own, OFF]];
        let ahead: Vec<[i64; 2]> = near.iter().copied().chain([0, -near[0]]).flat_map(with_eyes).collect();
        let beside: Vec<[i64; 2]> = (-64..=64).flat_map(|k| with_eyes(near[0] / 32 * k)).collect();
        let radii: [i64; LANES] = [1, 2, 3, 16, 17, 32, 33, 48, 64, 65, 96, 128, 129, 160, 200, 240]
            .map(|radius| near[0] / 512 * radius);
        let full = hold("outlines", bits, &beside, |trial, &[y, eye_y]| {
            let mut judged = Judged::default();
            for &[a, eye_a] in &ahead {
                trial.outlines([a, y], [eye_a, eye_y], radii, &directions, &mut judged);
            }
            judged
        });
        assert_eq!(directions.len() as u64, number_of_directions(bits, step));
        let outlines = (ahead.len() * beside.len() * 2 * LANES) as u64;
        assert_eq!(full.inputs, outlines * number_of_directions(bits, step));
        assert!(full.demanded > full.inputs / 100, "hardly a hit: {full:?}");
        assert!(full.dropped > full.inputs / 20, "hardly a ray outside an outline: {full:?}");
    }
}

/// All rays of a block have their slopes in its range, and the block passes for each heading that one of them has.
#[test]
fn a_range_holds_all_rays_of_a_block() {
    let bits = 16;
    // As small as roundings, and so large that the corners differ by more than margins.
    let spans: [&[i64]; 2] = [&[-13, -6, -1, 1, 3, 8], &[-25_000, -1, 1, 20_000]];
    let near = above(bits);
    let lean = [0, near[0] / 4, near[0] - FINER, near[0]];
    let mut cameras = Vec::new();
    for (number, &a) in near.iter().enumerate() {
        #[allow(clippy::cast_precision_loss, reason = "of 16 bits")]
        let turned = |v| turned(v, number).map(|x| x as f32);
        for y in lean {
            for [a_across, a_down, y_across, y_down] in spans.into_iter().flat_map(quadruples) {
                let (du, dv) = (turned([a_across, y_across, 1]), turned([a_down, y_down, 64]));
                let size = Size::new(4, 4).expect("one block");
                let camera = Camera::new([0.0; 3], turned([a, y, -y / 2]), du, dv, size);
                cameras.push(camera.expect("not parallel"));
            }
        }
    }
    let full = hold("ranges", bits, &cameras, |trial, camera| {
        let mut judged = Judged::default();
        trial.tile(camera, &mut judged);
        judged
    });
    assert_eq!(cameras.len(), near.len() * lean.len() * (6usize.pow(4) + 4usize.pow(4)));
    assert_eq!(full.inputs, (cameras.len() * 6 * LANES) as u64);
    assert!(full.demanded >= (cameras.len() * LANES) as u64, "a ray has no heading: {full:?}");
    assert!(full.dropped > full.inputs / 2, "hardly a ray outside: {full:?}");
}

fn quadruples(of: &[i64]) -> impl Iterator<Item = [i64; 4]> {
    let n = of.len();
    (0..n.pow(4)).map(move |i| [of[i % n], of[i / n % n], of[i / (n * n) % n], of[i / (n * n * n)]])
}

/// The eye is called outside a ball, or inside, only where it is: balls whose surface is from a third of the radius before the eye to a seventh behind it.
#[test]
fn the_side_of_the_eye_is_right() {
    let bits = 8;
    let near = above(bits);
    let balls = balls(&near, &near, &near, [&[-OFF, OFF]; 3]);
    let full = hold("sides", bits, &balls, |trial, ball| {
        let mut judged = Judged::default();
        // As many steps as the centre is away, and 80 less to 32 more; from 256 on only the even are floats.
        let steps = ball.center.iter().map(|c| c * c).sum::<i64>().isqrt() / FINER;
        for from in [-80, -48, -16, 0, 16] {
            let radius = |lane| match steps + from + i64::try_from(lane).expect("small") {
                few @ ..256 => FINER * few,
                many => FINER * (many / 2 * 2),
            };
            trial.sides(ball, std::array::from_fn(radius), &mut judged);
        }
        judged
    });
    assert_eq!(full.inputs, (balls.len() * 5 * LANES * 2) as u64);
    assert!(full.demanded > full.inputs / 3 && full.dropped > full.inputs / 10, "{full:?}");
}

/// x rounded to so many bits by whole numbers alone: halves to even, or cut off.
fn rounded(x: i64, bits: u32, mode: Mode) -> i64 {
    let size = x.unsigned_abs();
    let drop = (u64::BITS - size.leading_zeros()).saturating_sub(bits);
    let (kept, rest, half) = (size >> drop, size & ((1 << drop) - 1), (1u64 << drop) / 2);
    let up = mode == Mode::Nearest && drop > 0 && (rest > half || (rest == half && kept % 2 == 1));
    ((kept + u64::from(up)) << drop).cast_signed() * x.signum()
}

/// The judge's own machine: sums, differences and products of all floats of 4 bits up to 60.
#[test]
fn floats_of_few_bits_are_rounded_as_they_say() {
    let mut judged = [0u64; 2];
    for mode in [Mode::Nearest, Mode::Truncating] {
        let m = Small { bits: 4, mode };
        let floats: Vec<i64> = (-60..=60).filter(|&x| rounded(x, 4, mode) == x).collect();
        for &x in &floats {
            for &y in &floats {
                #[allow(clippy::cast_precision_loss, reason = "small")]
                let [p, q] = [x, y].map(|x| m.splat(x as f32));
                for (found, exact) in [(m.add(p, q), x + y), (m.sub(p, q), x - y), (m.mul(p, q), x * y)] {
                    let expected = rounded(exact, 4, mode);
                    #[allow(clippy::cast_possible_truncation, reason = "whole numbers")]
                    let found = found[0] as i64;
                    assert_eq!(found, expected, "{mode:?}: {exact} of {x} and {y}");
                    judged[usize::from(expected != exact)] += 1;
                }
            }
        }
    }
    eprintln!("{judged:?} exact results and others");
    assert!(judged.iter().all(|n| *n > 5_000));
}
