//! Do properties hold of whatever proptest draws: known answers of integers, the judge's verdict on any plan, and metamorphic relations?
//! Each run prints its seed and what was at stake, and has no verdict if that was too little. `CGT_PROPERTY_CASES` sets how many cases
//! each property draws.

use contract::{Animation, Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use optimized::event::{Event, Events};
use optimized::grid::{Axis, Bounds, Grid};
use optimized::host::Scalar;
use optimized::plan::Plan;
use optimized::seen::Counts;
use reference::{Arithmetic, Tracer};
use verify::case::Case;
use verify::properties::relations::RELATIONS;
use verify::properties::stakes::Stakes;
use verify::properties::{Property, judged};
use verify::seed::{count, seed};

/// Runs a property and asks whether enough was at stake.
fn hold(everyday: u64, least: &[(&str, u64)], property: Property) {
    let name = property.word();
    let (seed, cases) = (seed(), count("CGT_PROPERTY_CASES", everyday));
    assert!(cases > 0, "CGT_PROPERTY_CASES: no case is no verdict");
    let stakes = property.hold(seed, cases).unwrap_or_else(|account| panic!("{account}\nCGT_SEED={seed}"));
    eprintln!("{name}: CGT_SEED={seed}, {cases} cases: {stakes}");
    // Of longer runs as much more is asked.
    let least: Vec<_> = least.iter().map(|(what, n)| (*what, n * cases.div_ceil(everyday))).collect();
    let lacking = stakes.lacking(&least);
    assert!(
        lacking.is_empty(),
        "{name}: no verdict, too little was at stake: {}; CGT_SEED={seed}",
        lacking.join(", ")
    );
}

/// A scene whose rays can be counted by hand: one through the middle of a ball, one along its rim, one past it.
#[test]
fn what_is_at_stake_is_counted() {
    let ball = |center: [f32; 3], radius: f32| Sphere { center, radius, color: [9; 3] };
    // The sine of the angle to the rim is 1/20.
    let rim = (1.0 / 399f64.sqrt()) as f32;
    let size = Size::new(3, 1).expect("small");
    let camera = Camera::new([0.0; 3], [-rim / 2.0, -0.005, -1.0], [rim, 0.0, 0.0], [0.0, 0.01, 0.0], size)
        .expect("a camera");
    let counted = |spheres: &[Sphere]| {
        let scene = Scene::new(spheres.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
        let picture = Tracer::new(Arithmetic::Exact).render(&scene, &camera).expect("small").image;
        let mut stakes = Stakes::default();
        stakes.add_frame(&scene, &camera, &picture);
        stakes
    };
    let far = ball([0.0, 0.0, -20.0], 1.0);
    let all = [
        "frames",
        "rays",
        "rays along -z",
        "rays along +z",
        "rays near tangents",
        "rays from inside a sphere",
        "rays from a surface",
        "rays to spheres over 1,000 radii away",
    ];
    for (what, spheres, due) in [
        ("a ball", &[far][..], [1, 3, 3, 0, 1, 0, 0, 0]),
        ("a ball twice", &[far, far], [1, 3, 3, 0, 1, 0, 0, 0]),
        ("a ball about the eye", &[ball([0.0, 0.0, -1.0], 2.0)], [1, 3, 3, 0, 0, 3, 0, 0]),
        ("a ball that touches the eye", &[ball([0.0, 0.0, -1.0], 1.0)], [1, 3, 3, 0, 0, 0, 3, 0]),
        ("a speck", &[ball([9.0, 0.0, -20.0], 0.01)], [1, 3, 3, 0, 0, 0, 0, 3]),
    ] {
        let stakes = counted(spheres);
        assert_eq!(all.map(|what| stakes.count(what)), due, "{what}: {stakes}");
        // Whoever hits the twin hits it at the same t.
        let tied = if spheres.len() == 2 { stakes.count("hits") } else { 0 };
        assert_eq!(stakes.count("rays with an equal second hit"), tied, "{what}: {stakes}");
        assert!(stakes.count("hits") > 0 || what == "a speck", "{what}: {stakes}");
    }
}

/// Spheres whose cells can be counted by hand, in a grid whose planes are the whole numbers from 0 to 4.
#[test]
fn cells_and_planes_at_stake_are_counted() {
    let whole = Bounds::nearest([2.0; 3], 2.0);
    let mut grid = Grid::build(Scalar, &Plan::safe(), &[whole], &mut Events::default()).expect("one ball");
    grid.axes = [0, 1, 2].map(|_| Axis::new(Scalar, 0.0, 4.0, 4));
    assert_eq!(grid.axes[0].planes, [0.0, 1.0, 2.0, 3.0, 4.0]);
    // From 0.5 to 2 on x, but for so many units in the last place of 2.
    let ends_at = |ulps: i8| ([1.25, 1.5, 1.5], 0.75 + f32::from(ulps) * f32::EPSILON * 2.0);
    // In several cells, in three of an axis or more, near a plane.
    for (what, (center, radius), due) in [
        ("in a cell", ([0.5; 3], 0.25), [0, 0, 0]),
        ("in two", ([1.0, 0.5, 0.5], 0.25), [1, 0, 0]),
        ("in eight", ([1.0; 3], 0.25), [1, 0, 0]),
        ("in twenty-seven", ([1.5; 3], 0.75), [1, 1, 0]),
        ("up to a plane", ends_at(0), [1, 1, 1]),
        ("4 ulp beyond", ends_at(4), [1, 1, 1]),
        ("5 ulp beyond", ends_at(5), [1, 1, 0]),
        ("4 ulp below", ends_at(-4), [1, 1, 1]),
        ("5 ulp below", ends_at(-5), [1, 1, 0]),
        ("at the ends of the grid alone", ([2.0; 3], 2.0), [1, 1, 0]),
    ] {
        let scene = Scene::new(vec![Sphere { center, radius, color: [9; 3] }], [0; 3], DEFAULT_LIGHT);
        let mut stakes = Stakes::default();
        stakes.add_grid(&scene.expect("valid"), &grid);
        let all = [
            "spheres in several cells",
            "spheres that span three cells or more",
            "spheres within 4 ulp of a plane",
        ];
        assert_eq!(all.map(|what| stakes.count(what)), due, "{what}: {stakes}");
    }
}

/// Each number another, so that none can stand for another.
#[test]
fn what_a_tracer_needed_is_counted() {
    let counts = Counts {
        cells: 100,
        candidates: 90,
        culled: 80,
        split_blocks: 70,
        lanes: 60,
        asked_f64: 50,
        asked_integers: 40,
        rounded_by_integers: 30,
    };
    let mut events = Events::default();
    for (event, times) in [
        (Event::CellFull { cell: [1, 2, 3], pushed: 4, lost: 5 }, 4),
        (Event::SpansCells { sphere: 6, axis: 0, cells: 3 }, 3),
        (Event::TooManyIds { spheres: 70_000 }, 2),
        (Event::OutOfRange, 1),
    ] {
        (0..times).for_each(|_| events.push(event.clone()));
    }
    let mut stakes = Stakes::default();
    stakes.add_tracer(&counts, &events);
    for (what, due) in [
        ("cells visited", 100),
        ("candidates", 90),
        ("candidates culled", 80),
        ("blocks split", 70),
        ("rays that f32 left to f64", 50),
        ("rays that f64 left to integers", 40),
        ("t rounded by integers", 30),
        ("queues full", 4),
        ("too large for eight corners", 3),
        ("scenes of too many ids", 2),
        ("scenes out of range", 1),
    ] {
        assert_eq!(stakes.count(what), due, "{what}: {stakes}");
    }
}

#[test]
fn what_is_lacking_is_what_is_less_than_the_least() {
    let mut stakes = Stakes::default();
    stakes.add("rays", 5);
    let cases: [&[(&str, u64)]; 4] =
        [&[("rays", 5)], &[("rays", 6)], &[("hits", 1)], &[("hits", 1), ("rays", 9)]];
    for (least, lacking) in cases.into_iter().zip([0, 1, 1, 2]) {
        assert_eq!(stakes.lacking(least).len(), lacking, "{least:?}: {:?}", stakes.lacking(least));
    }
    assert_eq!(stakes.lacking(&[("rays", 6)]), ["rays: 5 of at least 6"]);
}

/// A second frame is held to the same promise as the first.
#[test]
fn what_breaks_in_a_later_frame_is_a_failure() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/paper-eight-corners-miss-the-middle.json");
    let case = Case::from_json(&std::fs::read(file).expect("it is there")).expect("readable");
    let scene = case.frames.frames()[0].clone();
    // Behind the eye nothing of it is lost.
    let mut spheres = scene.spheres().to_vec();
    spheres.iter_mut().for_each(|sphere| sphere.center[2] -= 100.0);
    let behind = Scene::new(spheres, scene.background(), scene.light()).expect("valid");
    let of = |frames: &[&Scene]| {
        let frames = frames.iter().copied().cloned().collect();
        judged(&Case { frames: Animation::new(frames).expect("frames"), ..case.clone() })
    };
    assert!(of(&[&behind, &behind]).is_ok_and(|stakes| stakes.count("frames") == 2));
    for (frames, which) in [([&scene, &behind], "frame 0 by"), ([&behind, &scene], "frame 1 by")] {
        let failure = of(&frames).expect_err(which);
        assert!(failure.message.starts_with(which), "{}", failure.message);
    }
}

#[test]
fn integers_know_what_every_tracer_says() {
    let least = [
        ("rays whose answer is known", 40_000),
        ("known hits", 1_000),
        ("known in the textbook form", 900),
        ("known in the perpendicular form", 25),
        ("known tangents", 150),
        ("known ties", 50),
        ("known from inside or on a surface", 600),
        ("pictures of the reference", 15_000),
        ("pictures of the grid tracer", 8_000),
    ];
    hold(4_000, &least, Property::Certain);
}

#[test]
fn no_promise_is_broken_on_directed_scenes() {
    let least = [
        ("hits", 25_000),
        ("rays along +x", 5_000),
        ("rays along -x", 5_000),
        ("rays along +y", 5_000),
        ("rays along -y", 5_000),
        ("rays along +z", 5_000),
        ("rays along -z", 5_000),
        ("rays near tangents", 10_000),
        ("rays from inside a sphere", 10_000),
        ("rays from a surface", 2_000),
        ("rays with an equal second hit", 400),
        ("rays to spheres over 1,000 radii away", 5_000),
        ("spheres in several cells", 4_000),
        ("spheres that span three cells or more", 1_500),
        ("spheres within 4 ulp of a plane", 250),
        ("candidates culled", 5_000),
        ("blocks split", 200),
        ("queues full", 15),
        ("too large for eight corners", 200),
        ("scenes out of range", 15),
        ("rays that f32 left to f64", 2_000),
        ("rays that f64 left to integers", 1_000),
        ("t rounded by integers", 15),
        ("frames refused", 5),
        ("frames within the bound of rounding", 300),
    ];
    hold(2_500, &least, Property::Pictures);
}

#[test]
fn no_promise_is_broken_among_hundreds_of_spheres() {
    let least = [
        ("grids of more spheres than a tile takes in one round", 150),
        ("hits", 3_000),
        ("spheres in several cells", 20_000),
    ];
    hold(400, &least, Property::Swarms);
}

#[test]
fn no_promise_is_broken_on_any_finite_numbers() {
    let least = [
        ("hits", 5_000),
        ("scenes out of range", 500),
        ("rays that f32 left to f64", 8_000),
        ("rays that f64 left to integers", 150),
        ("frames beyond a form's range", 50),
        ("frames refused", 10),
    ];
    hold(1_500, &least, Property::Wild);
}

#[test]
fn a_changed_case_changes_its_picture_as_it_must() {
    let least = RELATIONS.map(|relation| (relation.name(), 4_000));
    hold(800, &least, Property::Relations);
}
