//! Do the bounds of the f64 stage hold on all inputs of small domains, for floats of 8 and 16 bits, and is a part of them too little?
//!
//! The shipped source is run, on [`Few`] instead of f64; whole numbers are the judge. `CGT_ROUNDING_BITS` says how many bits the
//! directions have, and with them the balls: 3 every day, 4 in the long run, a hundred times as many.

use optimized::float::Float;
use rand::RngExt;
use rayon::prelude::*;
use std::cmp::Ordering::{self, Equal, Greater, Less};
use verify::few::Few;
use verify::rounding::{Case, Directions, Said};
use verify::seed::{count, generator, seed};

/// All of these rays against all of these balls.
struct Domain {
    name: &'static str,
    /// Balls and eyes; the directions of these are not looked at.
    balls: Vec<Case>,
    directions: Vec<Directions>,
}

fn bits() -> u32 {
    u32::try_from(count("CGT_ROUNDING_BITS", 3)).expect("3 or 4").clamp(3, 4)
}

/// All triples of these.
fn triples(each: &[i64]) -> impl Iterator<Item = [i64; 3]> + '_ {
    each.iter().flat_map(move |&x| each.iter().flat_map(move |&y| each.iter().map(move |&z| [x, y, z])))
}

/// All directions of so many bits that no smaller number is twice: negative ones mirror them, and balls come in all mirrored
/// positions.
fn directions() -> Vec<Directions> {
    let most = 1i64 << bits();
    let all: Vec<i64> = (0..most).collect();
    let large = |d: &[i64; 3]| d.iter().any(|&x| x >= most / 2);
    let all: Vec<[i64; 3]> = triples(&all).filter(large).collect();
    let count = usize::try_from(most.pow(3) - (most / 2).pow(3)).expect("small");
    assert_eq!((all.len(), count % 16), (count, 0), "directions");
    all.chunks(16).map(|sixteen| sixteen.try_into().expect("sixteen")).collect()
}

/// The eye at 0, all centres and radii of so many bits: inside, outside, behind, on the surface, tangent.
fn near() -> Domain {
    let most = (1i64 << bits()) - 1;
    let centers: Vec<i64> = (-most..=most).collect();
    let ball = |center| (1..=most).map(move |radius| Case { eye: [0; 3], dir: [0; 3], center, radius });
    let balls: Vec<Case> = triples(&centers).flat_map(ball).collect();
    assert_eq!(balls.len(), usize::try_from((2 * most + 1).pow(3) * most).expect("fits"), "balls");
    Domain { name: "near", balls, directions: directions() }
}

/// Centres of 4 bits some way along each diagonal, in units of which the eye is off by one part in `unit` on every axis, so that
/// what is between them is no float; all radii of 4 bits.
fn far(unit: i64) -> Domain {
    let some: Vec<i64> = (8..8 + (1 << (bits() - 2))).flat_map(|k| [k * unit, -k * unit]).collect();
    let mut balls = Vec::new();
    for center in triples(&some) {
        for eye in triples(&[-1, 1]) {
            balls.extend((1..=15).map(|k| Case { eye, dir: [0; 3], center, radius: k * unit }));
        }
    }
    assert_eq!(balls.len(), some.len().pow(3) * 8 * 15, "balls");
    Domain { name: "far", balls, directions: directions() }
}

impl Domain {
    fn inputs(&self) -> u64 {
        (self.balls.len() * self.directions.len() * 16) as u64
    }

    /// What is said of all of it.
    fn said(&self, what: &str, judge: impl Fn(&mut Said, &Case, &Directions) + Sync) -> Said {
        let said = self.balls.par_iter().map(|ball| {
            let mut said = Said::default();
            self.directions.iter().for_each(|directions| judge(&mut said, ball, directions));
            said
        });
        let said = said.reduce(Said::default, |x, y| x + y);
        eprintln!("{}, {what}: {said:?}", self.name);
        assert_eq!(said.inputs, self.inputs(), "inputs that were promised");
        said
    }

    /// Of [`optimized::double::root`], with floats of so many bits, narrowed to half of them.
    fn root<const BITS: u32, const HALF: u32, const TOLD: u32>(&self) -> Said {
        let what = format!("{BITS} bits, told 2^-{TOLD}");
        self.said(&what, |said, ball, directions| {
            for &dir in directions {
                said.root::<BITS, HALF, TOLD>(&Case { dir, ..*ball });
            }
        })
    }

    /// Of [`optimized::double::short_ends`], with floats of 16 bits, narrowed to `NARROW`.
    fn short<const NARROW: u32, const TOLD: u32>(&self) -> Said {
        let what = format!("16 bits, told 2^-{TOLD}, narrowed to {NARROW}");
        self.said(&what, Said::short::<16, NARROW, TOLD>)
    }
}

#[test]
fn the_root_is_where_it_is_said_on_all_inputs_of_8_bits() {
    let (near, far) = (near(), far(32));
    let said = near.root::<8, 4, 8>();
    assert_eq!(said.wrong, [0; 5], "{:?}", said.first);
    let n = said.inputs;
    assert!(
        said.tangent > n / 10_000 && said.surface > n / 1000 && said.inside > n / 10,
        "nothing is at stake"
    );
    assert!(said.hits > said.hit * 3 / 4 && said.misses > (n - said.hit) * 3 / 4, "little is decided");
    assert!(said.hits_inside > said.inside / 2, "little is decided inside");
    let said = far.root::<8, 4, 8>();
    assert_eq!(said.wrong, [0; 5], "{:?}", said.first);
    assert!(said.inexact > said.inputs / 2, "centres are exact");
    assert!(said.hits > said.hit / 2 && said.misses > (said.inputs - said.hit) / 2, "little is decided");
    assert!(said.hits_inside > said.inside / 4, "little is decided inside");
}

/// With more bits more is decided, and nearer to the silhouette: there the root's error is the discriminant's.
#[test]
fn the_root_is_where_it_is_said_near_the_silhouette() {
    let said = far(1 << 13).root::<16, 8, 16>();
    assert_eq!(said.wrong, [0; 5], "{:?}", said.first);
    assert!(
        said.hits > said.hit * 9 / 10 && said.misses > (said.inputs - said.hit) * 9 / 10,
        "little is decided"
    );
    assert!(said.rounded > said.hits / 10, "little is rounded: {said:?}");
}

/// A quarter holds on these inputs (a wider domain may have others): what the bound has to spare is less than eight times.
#[test]
fn an_eighth_of_the_roots_bound_is_too_little() {
    for domain in [near(), far(32)] {
        let said = domain.root::<8, 4, 11>();
        assert!(
            said.wrong[2] > said.hits / 10_000,
            "the eighth of the bound is hardly ever too little: {said:?}"
        );
    }
}

/// Narrowed to 5 bits, the root is rounded as is said; not narrowed, it lies between the ends.
#[test]
fn the_short_way_rounds_as_it_says_on_all_inputs_of_16_bits() {
    for domain in [near(), far(1 << 13)] {
        let said = domain.short::<5, 16>();
        assert_eq!(said.wrong, [0; 5], "{:?}", said.first);
        assert!(
            said.rounded > said.inputs / 100 && said.rounded > said.hits / 2,
            "little is rounded: {said:?}"
        );
        let said = domain.short::<24, 16>();
        assert_eq!(said.wrong, [0; 5], "{:?}", said.first);
        assert!(said.hits > said.hit / 20, "little is decided: {said:?}");
    }
}

/// One bound for all rays has more to spare: a 32nd is too little among far balls, half of that among near ones too.
#[test]
fn a_part_of_the_short_ways_bound_is_too_little() {
    let said = far(1 << 13).short::<24, 21>();
    assert!(said.wrong[2] > 0, "a 32nd of the bound is enough: {said:?}");
    let said = near().short::<24, 22>();
    assert!(said.wrong[2] > 0, "a 64th of the bound is enough: {said:?}");
}

/// The judge by hand: roots 2 and 8, 4 from inside and 2 the other way, 6 from the surface, a tangent at 5, and 5 − √8.
#[test]
fn roots_are_found_by_whole_numbers() {
    let found = |center, dir, xs: &[f64]| -> Vec<Option<Ordering>> {
        let case = Case { eye: [1, 2, 3], dir, center, radius: 3 };
        xs.iter().map(|&x| case.root_from(x)).collect()
    };
    let some =
        |expected: &[Ordering]| -> Vec<Option<Ordering>> { expected.iter().map(|&x| Some(x)).collect() };
    let ahead = [1, 0, 0];
    let xs = [0.0, 1.5, 2.0, 2.5, 5.0, 6.0, 8.0, 9.0];
    let outside = [Greater, Greater, Equal, Less, Less, Less, Less, Less];
    assert_eq!(found([6, 2, 3], ahead, &xs), some(&outside), "outside");
    assert_eq!(
        found([2, 2, 3], ahead, &[0.0, 3.5, 4.0, 4.5]),
        some(&[Greater, Greater, Equal, Less]),
        "inside"
    );
    assert_eq!(
        found([2, 2, 3], [-1, 0, 0], &[1.5, 2.0, 4.0]),
        some(&[Greater, Equal, Less]),
        "the other way"
    );
    assert_eq!(
        found([4, 2, 3], ahead, &[0.0, 5.5, 6.0, 7.0]),
        some(&[Greater, Greater, Equal, Less]),
        "surface"
    );
    assert_eq!(found([6, 5, 3], ahead, &[4.5, 5.0, 5.5]), some(&[Greater, Equal, Less]), "tangent");
    assert_eq!(found([6, 3, 3], ahead, &[2.125, 2.25]), some(&[Greater, Less]), "5 less the root of 8");
    assert_eq!(
        found([6, 2, 3], [4, 0, 0], &[0.25, 0.5, 0.75]),
        some(&[Greater, Equal, Less]),
        "four times as far"
    );
    for (center, dir) in
        [([6, 2, 3], [-1, 0, 0]), ([6, 6, 3], ahead), ([4, 2, 3], [-1, 0, 0]), ([6, 5, 4], ahead)]
    {
        assert_eq!(found(center, dir, &[1.0]), [None], "behind, beside, away from the surface, past it");
    }
}

/// Floats of 24 bits are f32, and what is narrowed to 24 is rounded as f32 is.
#[test]
fn floats_of_24_bits_are_those_of_the_processor() {
    type Single = Few<24, 24, 24>;
    let (seed, cases) = (seed(), 1_000_000);
    eprintln!("CGT_SEED={seed}, {cases} pairs");
    let mut rng = generator(seed, 0);
    for _ in 0..cases {
        let [x, y] = [0, 1].map(|_| rng.random_range(-1.0f32..1.0) * 2f32.powi(rng.random_range(-12..12)));
        let (p, q) = (Single::of(x), Single::of(y));
        for (what, few, single) in [
            ("+", p + q, x + y),
            ("-", p - q, x - y),
            ("*", p * q, x * y),
            ("/", p / q, x / y),
            ("root", p.abs().sqrt(), x.abs().sqrt()),
            ("least above", Single::at_least(f64::from(x.abs())), x.abs()),
        ] {
            assert!(
                few.value() == f64::from(single),
                "CGT_SEED={seed}: {x:e} {what} {y:e}: {few:?}, {single:e}"
            );
        }
        let wide = f64::from(x.abs()) * (1.0 + rng.random_range(0.0..1.0) / 1e6);
        let least = Single::at_least(wide).value();
        assert!(least >= wide && f64::from((least as f32).next_down()) < wide, "CGT_SEED={seed}: {wide:e}");
        let few = Few::<40, 24, 40>::at_least(wide);
        assert!(few.narrow() == few.value() as f32, "CGT_SEED={seed}: {wide:e}");
    }
}
