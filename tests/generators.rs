//! Do generated scenes have the spheres they promise, the same on every machine, and refuse what is too much?

use contract::{MAX_SPHERES, Scene};
use rand::Rng;
use std::collections::HashSet;
use std::process::Command;
use verify::directed::{Case, Kind, case};
use verify::judge::compare::ulps_apart;
use verify::scenes::generate::{GenerateError, Generator};
use verify::seed::{VARIABLE, generator, seed};

fn make(generator: Generator) -> Scene {
    generator.scene().unwrap_or_else(|e| panic!("{generator}: {e}"))
}

/// FNV-1a over all bits of all spheres.
fn digest(scene: &Scene) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut feed = |byte: u8| hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    for s in scene.spheres() {
        s.center.iter().chain([&s.radius]).flat_map(|x| x.to_bits().to_le_bytes()).for_each(&mut feed);
        s.color.into_iter().for_each(&mut feed);
    }
    hash
}

#[test]
fn counts_are_those_promised() {
    for (levels, count) in [(0, 1), (1, 10), (2, 91), (3, 820), (4, 7_381), (5, 66_430)] {
        let flake = Generator::Sphereflake { levels };
        assert_eq!((make(flake).spheres().len(), flake.count()), (count, count as u128), "{flake}");
    }
    for count in [0, 1, 2, 1_000] {
        for generator in [Generator::Uniform { count, seed: 7 }, Generator::Clump { count, seed: 7 }] {
            assert_eq!(make(generator).spheres().len(), count, "{generator}");
        }
    }
    for (side, count) in [(0, 0), (1, 1), (10, 1_000)] {
        assert_eq!(make(Generator::Lattice { side }).spheres().len(), count, "side {side}");
    }
}

/// Children touch their parent; every third radius; and the directions are the nine of the definition.
#[test]
fn sphereflake_touches() {
    let scene = make(Generator::Sphereflake { levels: 2 });
    let spheres = scene.spheres();
    let distance = |i: usize, j: usize| {
        let part = |k: usize| f64::from(spheres[i].center[k]) - f64::from(spheres[j].center[k]);
        (0..3).map(|k| part(k) * part(k)).sum::<f64>().sqrt()
    };
    assert_eq!((spheres[0].center, spheres[0].radius), ([0.0; 3], 0.5));
    let (mut flat, mut high) = (0, 0);
    for child in (1..91).step_by(10) {
        let gap = distance(0, child) - f64::from(spheres[0].radius + spheres[child].radius);
        assert!(gap.abs() < 1e-6, "child {child}: gap {gap}");
        assert_eq!(spheres[child].radius, 0.5 / 3.0);
        let height = f64::from(spheres[child].center[2]) / (2.0 / 3.0);
        flat += usize::from(height.abs() < 1e-6);
        high += usize::from((height - (2.0_f64 / 3.0).sqrt()).abs() < 1e-6);
        for grandchild in child + 1..child + 10 {
            let gap =
                distance(child, grandchild) - f64::from(spheres[child].radius + spheres[grandchild].radius);
            assert!(gap.abs() < 1e-6, "grandchild {grandchild}: gap {gap}");
            let clear = distance(0, grandchild) - f64::from(spheres[0].radius + spheres[grandchild].radius);
            assert!(clear > -1e-6, "grandchild {grandchild} is inside the first sphere by {clear}");
        }
    }
    assert_eq!((flat, high), (6, 3), "six children on the equator, three above");
    // (d, d, 0) turned up by the angle whose sine is 2/sqrt 6.
    let first = [1.0 / 6.0_f64.sqrt(), 1.0 / 6.0_f64.sqrt(), 2.0 / 6.0_f64.sqrt()];
    for (k, want) in first.into_iter().enumerate() {
        let got = f64::from(spheres[1].center[k]) * 1.5;
        assert!((got - want).abs() < 1e-6, "axis {k}: {got}, want {want}");
    }
}

/// The same bits everywhere: a change here is a change of published scenes.
#[test]
fn bits_are_pinned() {
    let pinned: [(Generator, u64); 4] = [
        (Generator::Sphereflake { levels: 4 }, 2_532_564_195_464_155_769),
        (Generator::Uniform { count: 2_000, seed: 1 }, 7_378_940_547_577_471_435),
        (Generator::Clump { count: 2_000, seed: 1 }, 9_564_194_474_643_711_290),
        (Generator::Lattice { side: 10 }, 10_676_688_488_782_153_781),
    ];
    let found = pinned.map(|(generator, _)| (generator, digest(&make(generator))));
    assert_eq!(found, pinned);
}

#[test]
fn seeds_differ_and_repeat() {
    let scene = |seed| make(Generator::Uniform { count: 100, seed });
    assert_eq!(scene(1), scene(1));
    assert_ne!(scene(1), scene(2));
    let first = |seed| scene(seed).spheres()[0].center;
    assert_ne!(first(1), first(2));
}

#[test]
fn distributions_are_what_they_say() {
    let count = 100_000;
    let moments = |generator| {
        let scene = make(generator);
        let each = |axis: usize, f: &dyn Fn(f64) -> f64| {
            scene.spheres().iter().map(|s| f(f64::from(s.center[axis]))).sum::<f64>() / count as f64
        };
        std::array::from_fn::<_, 3, _>(|axis| {
            let mean = each(axis, &|x| x);
            (mean, each(axis, &|x| (x - mean) * (x - mean)).sqrt())
        })
    };
    // Standard deviation of a uniform number is sqrt(1/12); of the mean of 100,000 below 0.001.
    for (generator, deviation) in [
        (Generator::Uniform { count, seed: 3 }, (1.0_f64 / 12.0).sqrt()),
        (Generator::Clump { count, seed: 3 }, 0.125),
    ] {
        for (axis, (mean, found)) in moments(generator).into_iter().enumerate() {
            assert!((mean - 0.5).abs() < 0.005, "{generator} axis {axis}: mean {mean}");
            assert!((found - deviation).abs() < 0.005, "{generator} axis {axis}: deviation {found}");
        }
    }
}

#[test]
fn too_much_is_refused_before_memory_is_taken() {
    let cases = [
        (Generator::Uniform { count: MAX_SPHERES + 1, seed: 1 }, MAX_SPHERES as u128 + 1),
        (Generator::Clump { count: usize::MAX, seed: 1 }, usize::MAX as u128),
        (Generator::Lattice { side: 513 }, 513 * 513 * 513),
        (Generator::Lattice { side: usize::MAX }, u128::MAX),
        (Generator::Sphereflake { levels: 9 }, 435_848_050),
        (Generator::Sphereflake { levels: u32::MAX }, u128::MAX),
    ];
    for (what, count) in cases {
        let error = what.scene().expect_err("more spheres than the contract allows");
        assert_eq!(error, GenerateError::TooMany { what, count });
        assert!(error.to_string().contains(&count.to_string()), "{error}");
    }
}

#[test]
fn ten_million_spheres_are_made() {
    let scene = make(Generator::Uniform { count: 10_000_000, seed: 5 });
    assert_eq!(scene.spheres().len(), 10_000_000);
}

/// What one user draws is neither what another draws nor what another seed gives, and comes again with both.
#[test]
fn streams_and_seeds_differ() {
    let first = |seed, stream| generator(seed, stream).next_u64();
    let of_streams: HashSet<u64> = (0..1000).map(|stream| first(7, stream)).collect();
    let of_seeds: HashSet<u64> = (0..1000).map(|seed| first(seed, 7)).collect();
    assert_eq!((of_streams.len(), of_seeds.len()), (1000, 1000));
    assert_eq!(first(7, 9), first(7, 9));
}

/// Says which seed it has; run by the next test.
#[test]
fn the_seed_is_told() {
    eprintln!("the seed is {};", seed());
}

/// A fresh seed for every run, and the one that is asked for.
#[test]
fn a_seed_is_fresh_unless_it_is_set() {
    let told = |set: Option<&str>| {
        let mut child = Command::new(std::env::current_exe().expect("this program"));
        child.args(["--exact", "the_seed_is_told", "--nocapture"]).env_remove(VARIABLE);
        let output = child.envs(set.map(|seed| (VARIABLE, seed))).output().expect("it runs");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let (_, rest) = said.split_once("the seed is ").unwrap_or_else(|| panic!("{said}"));
        rest.split(';').next().and_then(|seed| seed.parse::<u64>().ok()).expect("a seed")
    };
    assert_ne!(told(None), told(None));
    assert_eq!([told(Some("17")), told(Some("18446744073709551615"))], [17, u64::MAX]);
}

/// All numbers of a case.
fn numbers(case: &Case) -> Vec<f32> {
    let spheres = case.spheres.iter().flat_map(|s| [s.center[0], s.center[1], s.center[2], s.radius]);
    case.ray.eye.into_iter().chain(case.ray.dir).chain(spheres).collect()
}

/// A case that is near one of the lattice differs from it in one number, by 1 to 3 steps.
#[test]
fn near_cases_are_near() {
    let pairs = [
        (Kind::Tangent, Kind::NearTangent),
        (Kind::OnSurface, Kind::NearSurface),
        (Kind::EqualRoots, Kind::NearEqualRoots),
    ];
    let seed = seed();
    let mut steps = [0u64; 4];
    for (on, near) in pairs {
        for i in 0..2_000 {
            let [on, near] = [on, near].map(|kind| case(kind, &mut generator(seed, i)));
            let (on, near) = (numbers(&on), numbers(&near));
            assert_eq!(on.len(), near.len());
            let moved: Vec<u64> =
                on.iter().zip(&near).map(|(x, y)| ulps_apart(*x, *y)).filter(|n| *n > 0).collect();
            let [n] = moved[..] else { panic!("{moved:?} moved, case {i} of CGT_SEED={seed}") };
            steps[usize::try_from(n).expect("few").min(3)] += u64::from((1..=3).contains(&n));
        }
    }
    eprintln!("moved by 1, 2, 3 steps: {:?}", &steps[1..]);
    assert!(steps[1..].iter().sum::<u64>() == 6_000 && steps[1..].iter().all(|n| *n > 1_000), "{steps:?}");
}

/// Directed rays go along all axes, both ways.
#[test]
fn directed_cases_look_everywhere() {
    let (seed, mut ways) = (seed(), [[0u64; 2]; 3]);
    for i in 0..6_000 {
        let dir = case(Kind::Inside, &mut generator(seed, i)).ray.dir;
        let axis = (0..3).max_by(|&i, &j| dir[i].abs().total_cmp(&dir[j].abs())).expect("three");
        ways[axis][usize::from(dir[axis] > 0.0)] += 1;
    }
    eprintln!("backward and forward along each axis: {ways:?}");
    assert!(ways.as_flattened().iter().all(|n| *n > 600), "CGT_SEED={seed}: {ways:?}");
}
