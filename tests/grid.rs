//! Is the grid tracer's picture the naive one of the same arithmetic, bit for bit, on the whole scene matrix, whatever the plan,
//! the level and the number of workers?

use contract::{AMBIENT, Camera, DIFFUSE, Image, MISS, Scene, Size, Sphere};
use optimized::plan::{
    Arithmetic, Cells, Culling, Loop, Margins, OnEvent, Packet, Plan, Resolution, Sharing, Voxelizer,
};
use optimized::{Event, Events, Form, Level, Tracer};
use rayon::prelude::*;
use reference::Arithmetic as Naive;
use std::collections::BTreeMap;
use std::io::Write;
use std::sync::OnceLock;
use verify::matrix::{Case, Matrix};
use verify::scenes::catalogue::{DATA_VARIABLE, ENTRIES, Source};
use verify::seed::{count, seed};

fn matrix() -> Matrix {
    let matrix = Matrix::new().expect("all data that is there can be read");
    for name in &matrix.absent {
        // Past the capture of output: who runs the tests must see it.
        _ = writeln!(std::io::stderr(), "not judged: {name}: data absent (run tests/fetch-data)");
    }
    matrix
}

const ARITHMETICS: [Arithmetic; 3] =
    [Arithmetic::Rounded(Form::Textbook), Arithmetic::Rounded(Form::Perpendicular), Arithmetic::Certified];

fn naive(case: &Case, arithmetic: Arithmetic) -> Image {
    let arithmetic = match arithmetic {
        Arithmetic::Rounded(Form::Textbook) => Naive::F32Textbook,
        Arithmetic::Rounded(Form::Perpendicular) => Naive::F32Perpendicular,
        Arithmetic::Spu(_) => unreachable!("tests/spu_machine.rs has the SPU's pictures"),
        Arithmetic::Certified => Naive::Exact,
    };
    reference::Tracer::new(arithmetic).threads(1).render(&case.scene, &case.camera).expect("small").image
}

/// The matrix with its naive pictures, each made once, by whichever test asks for it first.
struct Pictures {
    matrix: Matrix,
    naive: Vec<[OnceLock<Image>; ARITHMETICS.len()]>,
}

impl Pictures {
    fn all() -> &'static Self {
        static ALL: OnceLock<Pictures> = OnceLock::new();
        ALL.get_or_init(|| {
            let matrix = matrix();
            let naive = matrix.cases.iter().map(|_| [const { OnceLock::new() }; ARITHMETICS.len()]).collect();
            Self { matrix, naive }
        })
    }

    fn naive(&self, case: usize, arithmetic: Arithmetic) -> &Image {
        let of = ARITHMETICS.iter().position(|&other| other == arithmetic).expect("one of the three");
        self.naive[case][of].get_or_init(|| naive(&self.matrix.cases[case], arithmetic))
    }
}

/// What was at stake in a picture.
type Stakes = BTreeMap<&'static str, u64>;

fn judge(case: &Case, naive: &Image, plan: Plan, level: Level, workers: usize) -> Stakes {
    assert!(plan.promises_equality(), "{plan} promises nothing");
    let rendering = Tracer::new(plan, level).workers(workers).render(&case.scene, &case.camera);
    let rendering = rendering.unwrap_or_else(|error| panic!("{}: {plan}: {error}", case.name));
    for i in 0..naive.ids.len() {
        let pixel = |image: &Image| (image.ids[i], image.t[i].to_bits(), image.rgba[i]);
        let (expected, given) = (pixel(naive), pixel(&rendering.image));
        assert_eq!(
            expected, given,
            "naive, grid; {}, pixel {i} of {:?}; {plan}, {level}, {workers} workers",
            case.name, naive.size
        );
    }
    let count =
        |is: fn(&Event) -> bool| rendering.events.first().iter().filter(|event| is(event)).count() as u64;
    let counts = rendering.counts;
    if plan.culling == Culling::None {
        assert_eq!(counts.culled, 0, "{}: {plan}, {level}: dropped by planes that are not there", case.name);
    }
    BTreeMap::from([
        ("pictures", 1),
        ("hits", naive.ids.iter().filter(|&&id| id != MISS).count() as u64),
        ("cells visited", counts.cells),
        ("candidates", counts.candidates),
        ("candidates culled", counts.culled),
        ("blocks split", counts.split_blocks),
        ("marked by f32", counts.asked_f64),
        ("queue overflows", count(|event| matches!(event, Event::CellFull { .. }))),
        ("spans of three cells", count(|event| matches!(event, Event::SpansCells { .. }))),
        ("scenes out of range", count(|event| matches!(event, Event::OutOfRange))),
    ])
}

fn sum(mut all: Stakes, one: Stakes) -> Stakes {
    for (what, n) in one {
        *all.entry(what).or_default() += n;
    }
    all
}

fn report(stakes: &Stakes, none_of: &[&str]) {
    eprintln!("{stakes:?}");
    for (what, n) in stakes {
        assert!(*n > 0 || none_of.contains(what), "no {what}: too little was at stake");
    }
}

/// `Plan::safe()` in every arithmetic on every case, at the best level.
#[test]
fn the_safe_plan_changes_nothing_anywhere() {
    let (pictures, level) = (Pictures::all(), Level::best().expect("a level"));
    let each = pictures.matrix.cases.par_iter().enumerate().map(|(i, case)| {
        ARITHMETICS.map(|arithmetic| {
            judge(case, pictures.naive(i, arithmetic), Plan { arithmetic, ..Plan::safe() }, level, 1)
        })
    });
    let stakes = each.flatten_iter().reduce(Stakes::new, sum);
    report(&stakes, &["queue overflows", "spans of three cells"]);
    assert!(stakes["pictures"] > 500 && stakes["hits"] > 250_000, "too little was at stake: {stakes:?}");
}

/// Every combination of choices that promises the naive picture.
fn plans() -> Vec<Plan> {
    let mut plans = Vec::new();
    for voxelizer in [Voxelizer::EightCorners, Voxelizer::BoxRange, Voxelizer::Overlap, Voxelizer::ByCenter] {
        for cells in [Cells::Queue, Cells::Lists] {
            for walk in [Loop::Nested, Loop::Flattened] {
                for culling in [Culling::None, Culling::Planes] {
                    for resolution in [Resolution::Fixed(5), Resolution::UpTo(40)] {
                        for arithmetic in ARITHMETICS {
                            plans.push(Plan {
                                voxelizer,
                                cells,
                                walk,
                                culling,
                                resolution,
                                arithmetic,
                                ..Plan::safe()
                            });
                        }
                    }
                }
            }
        }
    }
    plans
}

/// Every plan at every level, with two of five numbers of workers (`CGT_GRID_WORKERS`: with so many of them), each on a case of the matrix in
/// turn. Where there are three levels, every plan meets every number of workers and both ways of sharing; every case is met, and which plan meets
/// which case is another with each seed.
#[test]
fn every_combination_changes_nothing() {
    let (pictures, levels) = (Pictures::all(), Level::available());
    let cases = &pictures.matrix.cases;
    let plans = plans();
    let workers = [1, 2, 3, 5, 8];
    let numbers = usize::try_from(count("CGT_GRID_WORKERS", 2)).expect("few").clamp(1, workers.len());
    let (mut tasks, seed) = (Vec::new(), seed());
    eprintln!("CGT_SEED={seed}, {numbers} numbers of workers");
    let first = (seed % cases.len() as u64) as usize;
    for (p, plan) in plans.iter().enumerate() {
        for (l, level) in levels.iter().enumerate() {
            for n in 0..numbers {
                let sharing = if (p + l + n) % 4 == 0 { Sharing::Mirrored } else { Sharing::Shared };
                let case = (first + tasks.len()) % cases.len();
                tasks.push((
                    Plan { sharing, ..*plan },
                    *level,
                    workers[(p + l + 2 * n) % workers.len()],
                    case,
                ));
            }
        }
    }
    assert_eq!(plans.len(), 192, "a choice was added or lost");
    assert!(tasks.len() == 192 * levels.len() * numbers && tasks.len() >= cases.len(), "{}", tasks.len());
    eprintln!("levels: {}", levels.iter().map(|level| level.name()).collect::<Vec<_>>().join(", "));
    let each = tasks.par_iter().map(|&(plan, level, workers, case)| {
        judge(&cases[case], pictures.naive(case, plan.arithmetic), plan, level, workers)
    });
    let stakes = each.reduce(Stakes::new, sum);
    report(&stakes, &[]);
    assert_eq!(stakes["pictures"], tasks.len() as u64);
}

/// A plan that refuses says what it refuses; one that falls back says from what.
#[test]
fn events_are_never_silent() {
    let matrix = matrix();
    let case = matrix.cases.iter().find(|case| case.name.starts_with("1hvr")).expect("bundled");
    let level = Level::best().expect("a level");
    let render = |plan: Plan| Tracer::new(plan, level).render(&case.scene, &case.camera);
    let queues = Plan { cells: Cells::Queue, resolution: Resolution::Fixed(8), ..Plan::safe() };
    let refused =
        render(Plan { on_event: OnEvent::Refuse, ..queues }).expect_err("1HVR overflows queues at 8");
    assert!(matches!(refused, optimized::RenderError::Refused(Event::CellFull { .. })), "{refused}");
    let events = render(queues).expect("falls back").events;
    let events = events.first();
    assert!(events.iter().all(|e| matches!(e, Event::CellFull { .. })) && !events.is_empty(), "{events:?}");
    let corners =
        Plan { voxelizer: Voxelizer::EightCorners, resolution: Resolution::Fixed(40), ..Plan::safe() };
    let refused = render(Plan { on_event: OnEvent::Refuse, ..corners }).expect_err("1HVR spans cells at 40");
    assert!(matches!(refused, optimized::RenderError::Refused(Event::SpansCells { .. })), "{refused}");
    for cells in [0, 241, 255] {
        let plan = Plan { resolution: Resolution::Fixed(cells), ..Plan::safe() };
        assert_eq!(render(plan).expect_err("no such grid"), optimized::RenderError::Resolution { cells });
    }
}

/// 65,535 ids are what a queue can tell from empty; one more is an event, whatever the plan does then.
#[test]
fn ids_of_two_bytes_end_where_they_say() {
    let loaded = Source::parse("lattice:41").and_then(|source| source.load()).expect("generated");
    let all = loaded.animation.frames()[0].spheres();
    let plan = Plan {
        voxelizer: Voxelizer::ByCenter,
        cells: Cells::Queue,
        resolution: Resolution::Fixed(64),
        ..Plan::safe()
    };
    let level = Level::best().expect("a level");
    let camera = square([30.0, 30.0, 200.0]);
    let render = |spheres: usize, on_event| {
        let scene = Scene::new(all[..spheres].to_vec(), [0; 3], contract::DEFAULT_LIGHT).expect("valid");
        Tracer::new(Plan { on_event, ..plan }, level).render(&scene, &camera)
    };
    let most = render(65_535, OnEvent::Refuse).expect("as many as there are ids");
    assert_eq!(most.events.count(), 0);
    let event = Event::TooManyIds { spheres: 65_536 };
    let refused = render(65_536, OnEvent::Refuse).expect_err("one too many");
    assert_eq!(refused, optimized::RenderError::Refused(event.clone()));
    for on_event in [OnEvent::FallBack, OnEvent::GoOn] {
        assert_eq!(render(65_536, on_event).expect("lists").events.first(), std::slice::from_ref(&event));
    }
}

/// A camera of 8x8 pixels that looks from a point along -z.
fn square(eye: [f32; 3]) -> Camera {
    let size = Size::new(8, 8).expect("small");
    Camera::new(eye, [-0.5, 0.5, -1.0], [0.125, 0.0, 0.0], [0.0, -0.125, 0.0], size).expect("a camera")
}

fn ball(center: [f32; 3], radius: f32) -> Sphere {
    Sphere { center, radius, color: [200, 100, 50] }
}

/// A scene without margins is refused if the plan refuses, and each sphere that spans three cells is told of.
#[test]
fn every_event_is_told() {
    let level = Level::best().expect("a level");
    let render = |plan: Plan, spheres: Vec<Sphere>| {
        let scene = Scene::new(spheres, [0; 3], contract::DEFAULT_LIGHT).expect("valid");
        Tracer::new(plan, level).render(&scene, &square([0.0, 0.0, 9.0]))
    };
    let strict = Plan { on_event: OnEvent::Refuse, ..Plan::safe() };
    let refused = render(strict, vec![ball([0.0; 3], 1e-20)]).expect_err("out of range");
    assert_eq!(refused, optimized::RenderError::Refused(Event::OutOfRange));
    let corners =
        Plan { voxelizer: Voxelizer::EightCorners, resolution: Resolution::Fixed(8), ..Plan::safe() };
    // The last one's box spans three cells of 0.63 on each axis, no more.
    let spheres = vec![ball([0.0; 3], 1.0), ball([4.0; 3], 0.01), ball([1.0; 3], 1.0), ball([1.8; 3], 0.4)];
    let events = render(corners, spheres).expect("falls back").events;
    let told: Vec<u32> = events
        .first()
        .iter()
        .filter_map(|event| match event {
            Event::SpansCells { sphere, .. } => Some(*sphere),
            _ => None,
        })
        .collect();
    assert_eq!(told, [0, 2, 3]);
}

/// Each event names its sphere, the axis and how many cells, and what is refused is the first; where a range ends is the arithmetic's own
/// affair, and who has no margins has no range.
#[test]
fn events_say_what_was_found() {
    let level = Level::best().expect("a level");
    let corners =
        Plan { voxelizer: Voxelizer::EightCorners, resolution: Resolution::Fixed(8), ..Plan::safe() };
    for axis in 0..3 {
        // Cells of 1 on that axis and 5 on the others, in which the balls span three, four and seven, and one or two.
        let at = |x: f32, y: f32, z: f32| {
            let mut center = [y, y, y];
            (center[axis], center[(axis + 1) % 3], center[(axis + 2) % 3]) = (x, y, z);
            center
        };
        let wide = ball(at(3.5, 12.5, 15.1), 1.0);
        let spheres = vec![
            ball([0.0; 3], 0.001),
            wide,
            ball(at(8.0, 40.0, 40.0), 0.001),
            ball(at(5.0, 2.5, 2.5), 1.5),
            ball(at(4.2, 10.0, 20.0), 2.9),
        ];
        let scene = Scene::new(spheres, [0; 3], contract::DEFAULT_LIGHT).expect("valid");
        let render = |on_event| {
            Tracer::new(Plan { on_event, ..corners }, level).render(&scene, &square([20.0, 20.0, 90.0]))
        };
        let spans = [(1, 3), (3, 4), (4, 7)];
        let expected = spans.map(|(sphere, cells)| Event::SpansCells { sphere, axis, cells });
        for on_event in [OnEvent::FallBack, OnEvent::GoOn] {
            assert_eq!(render(on_event).expect("goes on").events.first(), expected, "axis {axis}");
        }
        let refused = render(OnEvent::Refuse).expect_err("three cells");
        assert_eq!(refused, optimized::RenderError::Refused(expected[0].clone()));
    }

    let camera = square([0.0, 0.0, 9.0]);
    let events = |plan: Plan, radius: f32| -> Result<(Vec<Event>, bool), optimized::RenderError> {
        let spheres = vec![ball([0.0; 3], 1.0), ball([1.0; 3], radius)];
        let scene = Scene::new(spheres, [0; 3], contract::DEFAULT_LIGHT).expect("valid");
        let rendering = Tracer::new(plan, level).render(&scene, &camera)?;
        Ok((rendering.events.first().to_vec(), rendering.counts.cells > 0))
    };
    for form in [Form::Textbook, Form::Perpendicular] {
        for (arithmetic, on_spu) in [(Arithmetic::Spu(form), true), (Arithmetic::Rounded(form), false)] {
            let plan = Plan { arithmetic, ..Plan::safe() };
            let strict = Plan { on_event: OnEvent::Refuse, ..plan };
            let (found, refused) = (events(plan, 2f32.powi(-15)), events(strict, 2f32.powi(-15)));
            if on_spu {
                assert_eq!(found, Ok((vec![Event::OutOfRange], false)), "{plan}");
                assert_eq!(refused, Err(optimized::RenderError::Refused(Event::OutOfRange)), "{strict}");
            } else {
                assert_eq!((found, refused), (Ok((vec![], true)), Ok((vec![], true))), "{plan}");
            }
        }
    }
    let found = events(Plan::paper(), 2f32.powi(-31)).expect("goes on");
    assert!(!found.0.contains(&Event::OutOfRange) && found.1, "{found:?}");
    assert_eq!(events(Plan::safe(), 2f32.powi(-31)), Ok((vec![Event::OutOfRange], false)));
}

/// A pixel whose direction is (0, 0, 0) is a miss by rule 2, from within a sphere too, and the pixels about it are none: whatever the plan and
/// the level, wherever in its block it stands, and whether the others of the block share an axis or not. It has no axis, so its block is split.
#[test]
fn a_pixel_without_direction_is_a_miss_alone() {
    let spans = [
        ([1.0, 0.0, 0.0], [0.0, 0.25, -0.25]),
        ([-1.0, 0.0, 0.0], [0.0, 0.25, -0.25]),
        ([0.0, 0.125, -0.5], [0.25, 0.0, 0.0]),
        ([0.0, 0.0, 2.0], [0.0, -1.0, 0.5]),
    ];
    let mut pictures = Vec::new();
    for (du, dv) in spans {
        for (width, height, pixels) in [
            (7u16, 6u16, vec![[0u16, 0u16], [3, 0], [2, 1], [5, 4], [6, 5]]),
            (4, 1, vec![[0, 0], [3, 0]]),
            (1, 5, vec![[0, 4], [0, 0]]),
        ] {
            for [x, y] in pixels {
                let [x, y] = [x, y].map(|at| f32::from(at) + 0.5);
                let corner = [0, 1, 2].map(|i: usize| -(x * du[i]) - y * dv[i]);
                let size = Size::new(width.into(), height.into()).expect("small");
                let camera = Camera::new([0.25, -0.5, 0.125], corner, du, dv, size).expect("a camera");
                pictures.push(camera);
            }
        }
    }
    let mut others = vec![ball([0.0; 3], 60.0)];
    // Most lie about the picture's plane, which goes through the eye.
    for i in 0..40u8 {
        let [x, y] = [i % 8, i / 8].map(|at| f32::from(at) * 5.0 - 15.0);
        others.push(ball([x, y, -y], 1.5));
        others.push(ball([y, x / 4.0, -x], 1.25));
    }
    let around = vec![ball([0.0; 3], 5.0), ball([0.25, 0.0, 0.0], 4.0)];
    let scenes = [around, others].map(|spheres| Scene::new(spheres, [7; 3], [0.3, 0.5, 0.4]).expect("valid"));
    let mut plans = Vec::new();
    for form in [Form::Textbook, Form::Perpendicular] {
        let naive =
            [[Naive::F32Textbook, Naive::SpuTextbook], [Naive::F32Perpendicular, Naive::SpuPerpendicular]];
        let [rounded, on_spu] = naive[usize::from(form == Form::Perpendicular)];
        for (arithmetic, naive) in [(Arithmetic::Rounded(form), rounded), (Arithmetic::Spu(form), on_spu)] {
            plans.push((Plan { arithmetic, ..Plan::safe() }, naive));
        }
    }
    plans.push((Plan { arithmetic: Arithmetic::Certified, ..Plan::safe() }, Naive::Exact));
    for side in [1, 32] {
        plans.push((Plan { packet: Packet::Tile { side }, ..Plan::fast() }, Naive::Exact));
    }
    // Such a picture is beyond the range of margins, and who has these has no grid; without them there is one.
    plans.push((Plan { margins: Margins::None, ..Plan::safe() }, Naive::F32Perpendicular));
    let levels = Level::available();
    let (mut without, mut split) = (0, 0);
    for (camera, scene) in pictures.iter().flat_map(|camera| scenes.iter().map(move |scene| (camera, scene)))
    {
        let blocks = split_blocks(camera);
        for (plan, naive) in &plans {
            let truth = reference::Tracer::new(*naive).threads(1).render(scene, camera).expect("small").image;
            let misses: Vec<usize> = (0..truth.ids.len()).filter(|i| truth.ids[*i] == MISS).collect();
            let directions: Vec<[f32; 3]> = (0..camera.size().height())
                .flat_map(|y| (0..camera.size().width()).map(move |x| (x, y)))
                .map(|(x, y)| reference::Ray::of_pixel(camera, x, y).dir)
                .collect();
            let none: Vec<usize> = (0..directions.len()).filter(|i| directions[*i] == [0.0; 3]).collect();
            assert_eq!((&misses, none.len()), (&none, 1), "the reference; {camera:?}");
            for level in &levels {
                let given = Tracer::new(*plan, *level).render(scene, camera).expect("falls back");
                for (i, direction) in directions.iter().enumerate() {
                    let pixel = |image: &Image| (image.ids[i], image.t[i].to_bits(), image.rgba[i]);
                    assert_eq!(
                        pixel(&truth),
                        pixel(&given.image),
                        "{naive:?}, grid; pixel {i}, {direction:?}; {plan}, {level}, {camera:?}"
                    );
                }
                assert_eq!(given.counts.split_blocks, blocks, "blocks split; {plan}, {level}, {camera:?}");
                without += 1;
                split += blocks;
            }
        }
    }
    eprintln!("{without} pictures with a pixel that has no direction, {split} blocks split");
    assert!(without > 500, "too little was at stake");
}

/// Blocks of which no axis is the longest of all rays, in one sense.
fn split_blocks(camera: &Camera) -> u64 {
    let size = camera.size();
    let is_split = |[x, y]: [u32; 2]| {
        let lane = |lane: u32| {
            let [column, row] = [(x + lane % 4).min(size.width() - 1), (y + lane / 4).min(size.height() - 1)];
            reference::Ray::of_pixel(camera, column, row).dir
        };
        let together = |along: usize| {
            (0..16).map(lane).all(|d| {
                let speed = if along < 3 { d[along] } else { -d[along - 3] };
                speed > 0.0 && d.iter().all(|x| x.abs() <= speed)
            })
        };
        !(0..6).any(together)
    };
    let rows = (0..size.height()).step_by(4);
    let blocks = rows.flat_map(|y| (0..size.width()).step_by(4).map(move |x| [x, y]));
    blocks.filter(|block| is_split(*block)).count() as u64
}

/// A grid chosen for eight corners has cells wider than any sphere's box.
#[test]
fn cells_chosen_for_eight_corners_are_wide_enough() {
    let (matrix, level) = (matrix(), Level::best().expect("a level"));
    let plan = Plan {
        voxelizer: Voxelizer::EightCorners,
        resolution: Resolution::UpTo(64),
        on_event: OnEvent::Refuse,
        ..Plan::safe()
    };
    let small = matrix.cases.iter().filter(|case| case.scene.spheres().len() < 1_000);
    let each = small.map(|case| match Tracer::new(plan, level).render(&case.scene, &case.camera) {
        Err(optimized::RenderError::Refused(Event::OutOfRange)) => 0,
        given => given.map(|_| 1).unwrap_or_else(|error| panic!("{}: {error}", case.name)),
    });
    assert!(each.sum::<u64>() > 100, "too little was at stake");
}

/// Rule 4 at both its ends and by its numbers: light that is far too bright, from behind, beyond f32, and none.
#[test]
fn light_of_any_length_is_clamped_alike() {
    assert_eq!([AMBIENT, DIFFUSE], [0.5625, 0.4375], "rule 4");
    let camera = square([0.0, 0.0, 4.0]);
    let level = Level::best().expect("a level");
    let lights = [[0.0; 3], [0.3, 0.2, 1.7], [-3.0, 1.0, -2.0], [3e38, -3e38, 3e38], [0.0, 0.0, 40.0]];
    let mut shades = Vec::new();
    for light in lights {
        let scene = Scene::new(vec![ball([0.0, 0.0, 0.0], 1.5)], [7; 3], light).expect("finite");
        let case = Case { name: format!("light {light:?}"), scene, camera };
        for arithmetic in ARITHMETICS {
            let naive = naive(&case, arithmetic);
            judge(&case, &naive, Plan { arithmetic, ..Plan::safe() }, level, 1);
            shades.extend(naive.rgba);
        }
    }
    // 200, 100, 50 in full, in no light at all, and by ambient light alone: times 0.5625 and rounded.
    for rgba in [[200, 100, 50, 255], [0, 0, 0, 255], [113, 56, 28, 255]] {
        assert!(shades.contains(&rgba), "{rgba:?} is nowhere");
    }
}

/// Rule 4 where both sums of the light overflow, one to each side: their sum is a NaN, which is no light at all, and neither full light nor none
/// stands beside it.
#[test]
fn light_that_is_no_number_is_none() {
    let scene = Scene::new(vec![ball([0.0; 3], 4.0)], [7; 3], [3e38, -3e38, 0.0]).expect("finite");
    let case = Case { name: "light of no number".to_owned(), scene, camera: square([0.0, 0.0, 7.0]) };
    for arithmetic in ARITHMETICS {
        let naive = naive(&case, arithmetic);
        // Normals of the corners are some 1.6 long on both axes; those of the upper right and the lower left have both of one sign.
        for (corner, rgba) in [(0, [0; 3]), (63, [200, 100, 50]), (7, [0; 3]), (56, [0; 3])] {
            assert_eq!(
                (naive.ids[corner], naive.rgba[corner][..3].to_vec()),
                (0, rgba.to_vec()),
                "pixel {corner}"
            );
        }
        for level in Level::available() {
            judge(&case, &naive, Plan { arithmetic, ..Plan::safe() }, level, 1);
        }
    }
}

/// What tracing cost is the sum over all workers, so it does not depend on how many there are.
#[test]
fn counts_are_those_of_all_workers() {
    let matrix = matrix();
    let case = matrix.cases.iter().find(|case| case.name.starts_with("1hvr")).expect("bundled");
    let level = Level::best().expect("a level");
    let counts = |workers: usize| {
        let tracer = Tracer::new(Plan::safe(), level).workers(workers);
        tracer.render(&case.scene, &case.camera).expect("safe").counts
    };
    let one = counts(1);
    assert!(one.cells > 0 && one.candidates > one.culled && one.culled > 0, "{one:?}");
    for workers in [2, 3, 8] {
        assert_eq!(counts(workers), one, "{workers} workers");
    }
}

/// The flattened loop does the work of the nested ones, no less and no more: what its step comes to without branching, in
/// slices that the packet does not touch, is not met.
#[test]
fn both_loops_do_the_same_work() {
    let matrix = matrix();
    let level = Level::best().expect("a level");
    let (mut candidates, mut cases) = (0, 0);
    for case in matrix.cases.iter().step_by(9) {
        for cells in [Cells::Lists, Cells::Queue] {
            let counts = [Loop::Nested, Loop::Flattened].map(|walk| {
                let plan = Plan { walk, cells, ..Plan::safe() };
                Tracer::new(plan, level).render(&case.scene, &case.camera).expect("falls back").counts
            });
            assert_eq!(counts[0], counts[1], "nested, flattened; {}, {cells:?}", case.name);
            candidates += counts[0].candidates;
            cases += 1;
        }
    }
    assert!(
        cases > 60 && candidates > 100_000,
        "too little was at stake: {cases} cases, {candidates} candidates"
    );
}

/// Of many events the first are kept, and all are counted.
#[test]
fn more_events_are_counted_than_kept() {
    let mut events = Events::default();
    for sphere in 0..12_345 {
        events.push(Event::SpansCells { sphere, axis: 0, cells: 3 });
    }
    assert_eq!((events.count(), events.first().len()), (12_345, Events::KEPT));
    let last = u32::try_from(Events::KEPT - 1).expect("few");
    assert!(matches!(events.first().last(), Some(Event::SpansCells { sphere, .. }) if *sphere == last));
}

/// The axis along which the middle of a picture is looked at, and the sense.
fn looks(camera: &Camera) -> (usize, bool) {
    let [width, height] = [camera.size().width(), camera.size().height()].map(|n| n as f32 / 2.0);
    let d: [f32; 3] =
        std::array::from_fn(|i| camera.corner()[i] + width * camera.du()[i] + height * camera.dv()[i]);
    let axis = (0..3).max_by(|&i, &j| d[i].abs().total_cmp(&d[j].abs())).expect("three");
    (axis, d[axis] > 0.0)
}

/// Nothing that the matrix is there for has been lost from it: sizes, views along all axes, eyes within spheres, and twins.
#[test]
fn the_matrix_has_all_that_can_go_wrong() {
    let matrix = matrix();
    let mut views: BTreeMap<(usize, bool), u64> = BTreeMap::new();
    let mut sizes: BTreeMap<[u32; 2], u64> = BTreeMap::new();
    let (mut within, mut twins) = (0, 0);
    for Case { name, scene, camera } in &matrix.cases {
        *views.entry(looks(camera)).or_default() += 1;
        *sizes.entry([camera.size().width(), camera.size().height()]).or_default() += 1;
        let inside = |s: &Sphere| {
            let squares = (0..3).map(|i| (f64::from(s.center[i]) - f64::from(camera.eye()[i])).powi(2));
            squares.sum::<f64>() < f64::from(s.radius).powi(2)
        };
        within += u64::from(scene.spheres().iter().any(inside));
        let mut bits: Vec<[u32; 4]> = (scene.spheres().iter())
            .map(|s| [s.center[0], s.center[1], s.center[2], s.radius].map(f32::to_bits))
            .collect();
        let all = bits.len();
        bits.sort_unstable();
        bits.dedup();
        twins += u64::from(name.starts_with("coincident") && 2 * bits.len() == all);
    }
    eprintln!("views {views:?}, sizes {sizes:?}, {within} eyes within a sphere, {twins} scenes of twins");
    assert!(views.len() == 6 && views.values().all(|n| *n > 15), "{views:?}");
    let odd = sizes.iter().filter(|([w, h], _)| w % 4 != 0 || h % 4 != 0).map(|(_, n)| n).sum::<u64>();
    assert!(sizes.len() >= 6 && odd > 300, "{sizes:?}");
    assert!(
        sizes.contains_key(&[1, 1]) && sizes.keys().any(|[w, h]| w > h) && sizes.keys().any(|[w, h]| w < h)
    );
    assert!(within > 10 && twins >= 17, "{within} eyes within, {twins} scenes of twins");
}

/// Spheres that are all as large as the grid, each in nearly every cell of it.
fn crowd(spheres: u32) -> Scene {
    let at = |i: u32, step: u32| (i * step % spheres) as f32 / spheres as f32;
    let ball = |i| Sphere { center: [at(i, 1), at(i, 7), at(i, 31)], radius: 10.0, color: [9; 3] };
    Scene::new((0..spheres).map(ball).collect(), [0; 3], contract::DEFAULT_LIGHT).expect("valid")
}

/// Memory does not go with the square of the spheres: where each is in nearly every cell, cells are made fewer, and no fewer than need be;
/// the picture stays.
#[test]
fn lists_of_a_crowd_do_not_go_with_its_square() {
    let camera = square([0.5, 0.5, 60.0]);
    let ids = |spheres: u32, plan: Plan| {
        let (scene, level) = (crowd(spheres), Level::best().expect("a level"));
        let mut memory = optimized::grid::Memory::default();
        let seen = optimized::seen::Seen::new(
            optimized::host::Scalar,
            plan,
            &scene,
            &camera,
            &mut memory,
            &mut Events::default(),
            &optimized::crew::Crew::alone(),
        );
        let grid = seen.expect("no event").grid.expect("in range");
        let (cells, mut listed): (usize, u64) =
            (grid.axes.iter().map(|axis| axis.planes.len() - 1).product(), 0);
        (0..cells).for_each(|cell| grid.for_each_id(cell, true, |_| listed += 1));
        let image = Tracer::new(plan, level).render(&scene, &camera).expect("no event").image;
        let naive =
            reference::Tracer::new(Naive::F32Perpendicular).render(&scene, &camera).expect("small").image;
        assert!((image.ids == naive.ids) && (image.rgba == naive.rgba), "{spheres} spheres");
        assert!(
            image.t.iter().zip(&naive.t).all(|(one, other)| one.to_bits() == other.to_bits()),
            "{spheres}"
        );
        assert!(image.ids.iter().any(|id| *id != MISS), "{spheres} spheres, none seen");
        listed
    };
    for (spheres, divided) in [(900, false), (1_500, true), (3_000, true)] {
        let (listed, most) = (ids(spheres, Plan::safe()), 512 * u64::from(spheres) + (1 << 22));
        assert!(listed <= most, "{spheres} spheres: {listed} ids, {most} at most");
        // Half as many cells on each axis are an eighth in all, and a little more at the ends.
        assert!(!divided || listed > most / 16, "{spheres} spheres: {listed} ids, of {most} that may be");
        let fixed = Plan { resolution: Resolution::Fixed(16), ..Plan::safe() };
        assert!(ids(spheres, fixed) > u64::from(spheres) * 3_000, "what is asked for is had");
    }
}

/// Balls that touch on a lattice are as wide as whole parts of it, but for rounding: cells chosen for eight corners are wider.
#[test]
fn cells_chosen_for_balls_that_touch_are_wide_enough() {
    let level = Level::best().expect("a level");
    let mut scenes = 0;
    for (side, radius, offset) in (2..=9u8)
        .flat_map(|side| [1.0f32, 0.75, 0.3].map(|radius| (side, radius)))
        .flat_map(|(side, radius)| [0.0, 1.0, -2.5].map(|offset| (side, radius, offset)))
    {
        let at = |i: u8| offset + 2.0 * radius * f32::from(i);
        let balls = (0..side).flat_map(|x| (0..side).map(move |y| (x, y)));
        let balls = balls.flat_map(|(x, y)| (0..side).map(move |z| [x, y, z]));
        let balls = balls.map(|corner| ball(corner.map(at), radius)).collect();
        let scene = Scene::new(balls, [0; 3], contract::DEFAULT_LIGHT).expect("valid");
        for arithmetic in ARITHMETICS {
            let plan = Plan {
                voxelizer: Voxelizer::EightCorners,
                resolution: Resolution::UpTo(40),
                on_event: OnEvent::Refuse,
                arithmetic,
                ..Plan::safe()
            };
            let given = Tracer::new(plan, level).render(&scene, &square([1.0, 1.0, 30.0])).map(|_| ());
            assert_eq!(given, Ok(()), "{side} balls of {radius} on a side, from {offset}; {plan}");
            scenes += 1;
        }
    }
    assert_eq!(scenes, 8 * 3 * 3 * 3);
}

/// Ids need more than 16 bits from 65,536 spheres on, which the nearest ones have here: lists, tiles and what f64 is asked about must hold
/// them in full. A thousand of them are there twice, so that no ray is sure of them.
#[test]
fn ids_of_more_than_two_bytes_are_seen() {
    let back = (0..66_000u32).map(|i| {
        let [x, y, z] = [i % 41, i / 41 % 41, i / 1_681].map(|at| at as f32);
        ball([x, y, -z], 0.3)
    });
    let twins = (0..2_000u32).map(|i| ball([(i / 2 % 40) as f32, (i / 80) as f32, 3.0], 0.45));
    let front = (0..2_000u32).map(|i| ball([(i % 40) as f32 + 0.5, (i / 40) as f32 + 0.5, 2.0], 0.45));
    let spheres: Vec<Sphere> = back.chain(twins).chain(front).collect();
    assert_eq!(spheres.len(), 70_000);
    let scene = Scene::new(spheres, [0; 3], contract::DEFAULT_LIGHT).expect("valid");
    let size = Size::new(24, 16).expect("small");
    let (du, dv) = ([1.05, 0.0, 0.0], [0.0, -1.05, 0.0]);
    let camera = Camera::new([20.1, 12.2, 30.0], [-12.6, 8.4, -27.0], du, dv, size).expect("a camera");
    let truth = reference::Tracer::new(Naive::Exact).render(&scene, &camera).expect("small").image;
    let seen = |from: u32, to: u32| truth.ids.iter().filter(|id| (from..to).contains(*id)).count();
    let (twins, front) = (seen(66_000, 68_000), seen(68_000, 70_000));
    eprintln!("{twins} pixels show twins, {front} show others of long ids");
    assert!(twins > 50 && front > 20, "too little was at stake: {twins} and {front}");
    let certified = Plan { arithmetic: Arithmetic::Certified, ..Plan::safe() };
    for plan in [
        Plan::fast(),
        Plan::for_scene(&scene).plan,
        Plan { packet: Packet::Block, ..Plan::fast() },
        certified,
    ] {
        let given = Tracer::new(plan, Level::best().expect("a level")).render(&scene, &camera);
        let given = given.expect("nothing to refuse");
        assert_eq!(given.image.ids, truth.ids, "{plan}");
        assert!(
            given.image.t.iter().zip(&truth.t).all(|(one, other)| one.to_bits() == other.to_bits()),
            "{plan}"
        );
        assert!(given.counts.asked_f64 >= twins as u64, "{plan}: {:?}", given.counts);
    }
}

/// The variable that says that the test below is run with little memory.
const LITTLE_MEMORY: &str = "CGT_LITTLE_MEMORY";

/// Asks for more ids in lists than there is memory for; run by the next test with so little.
#[test]
fn more_ids_are_asked_for_than_fit() {
    if std::env::var_os(LITTLE_MEMORY).is_some() {
        let (scene, camera) = (crowd(1_000), square([0.5, 0.5, 60.0]));
        let plan = Plan { resolution: Resolution::Fixed(64), ..Plan::safe() };
        let tracer = Tracer::new(plan, Level::best().expect("a level"));
        let image = tracer.render(&scene, &camera).expect("a coarser grid").image;
        eprintln!("{} pixels hit", image.ids.iter().filter(|id| **id != MISS).count());
        let strict = Tracer::new(Plan { on_event: OnEvent::Refuse, ..plan }, Level::SCALAR);
        eprintln!("refused: {}", strict.render(&scene, &camera).expect_err("as many cells as asked for"));
    }
}

/// A grid that memory cannot hold is made coarser: 64 cells on an axis would list 1 GB of ids, 32 an eighth of it. A plan that refuses is told.
#[test]
#[cfg(target_os = "linux")]
fn ids_that_do_not_fit_make_a_grid_coarser() {
    let script = "ulimit -v 786432 && exec \"$0\" --exact more_ids_are_asked_for_than_fit --nocapture";
    let mut child = std::process::Command::new("sh");
    child.args(["-c", script]).arg(std::env::current_exe().expect("this program")).env(LITTLE_MEMORY, "1");
    let output = child.output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && said.contains(" pixels hit") && !said.contains("\n0 pixels"),
        "{said}"
    );
    assert!(said.contains("refused: the lists of a grid of [64, 64, 64] cells do not fit"), "{said}");
}

/// Makes the matrix and no more; run by the next test where there is no data.
#[test]
fn the_matrix_is_made() {
    assert!(matrix().cases.len() > 100);
}

/// Scenes whose data is not there are named, so that nobody takes them for judged.
#[test]
fn the_matrix_says_what_it_lacks() {
    let mut child = std::process::Command::new(std::env::current_exe().expect("this program"));
    child.args(["--exact", "the_matrix_is_made", "--nocapture"]).env(DATA_VARIABLE, "no-such-folder");
    let output = child.output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr);
    let told = |name: &str| said.contains(&format!("not judged: {name}: data absent"));
    let absent: Vec<&str> = ENTRIES.iter().map(|entry| entry.name).filter(|name| told(name)).collect();
    eprintln!("absent: {absent:?}");
    assert!(output.status.success() && absent.len() >= 6 && !absent.contains(&"1hvr"), "{said}");
}
