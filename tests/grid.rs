//! Is the grid tracer's picture the naive one of the same form, bit for bit, on the whole scene matrix, whatever the plan,
//! the level and the number of workers?

use contract::{Image, MISS};
use optimized::plan::{Cells, Culling, Loop, OnEvent, Plan, Resolution, Sharing, Voxelizer};
use optimized::{Event, Form, Level, Tracer};
use rayon::prelude::*;
use reference::Arithmetic;
use std::collections::BTreeMap;
use std::io::Write;
use verify::matrix::{Case, Matrix};

fn matrix() -> Matrix {
    let matrix = Matrix::new().expect("all data that is there can be read");
    for name in &matrix.absent {
        // Past the capture of output: who runs the tests must see it.
        _ = writeln!(std::io::stderr(), "not judged: {name}: data absent (run tests/fetch-data)");
    }
    matrix
}

fn naive(case: &Case, form: Form) -> Image {
    let arithmetic = match form {
        Form::Textbook => Arithmetic::F32Textbook,
        Form::Perpendicular => Arithmetic::F32Perpendicular,
    };
    reference::Tracer::new(arithmetic).threads(1).render(&case.scene, &case.camera).expect("small").image
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
    BTreeMap::from([
        ("pictures", 1),
        ("hits", naive.ids.iter().filter(|&&id| id != MISS).count() as u64),
        ("cells visited", counts.cells),
        ("candidates", counts.candidates),
        ("candidates culled", counts.culled),
        ("blocks split", counts.split_blocks),
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

/// `Plan::safe()` in both forms on every case, at the best level.
#[test]
fn the_safe_plan_changes_nothing_anywhere() {
    let (matrix, level) = (matrix(), Level::best().expect("a level"));
    let each = matrix.cases.par_iter().map(|case| {
        [Form::Textbook, Form::Perpendicular]
            .map(|form| judge(case, &naive(case, form), Plan { form, ..Plan::safe() }, level, 1))
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
                        for form in [Form::Textbook, Form::Perpendicular] {
                            plans.push(Plan {
                                voxelizer,
                                cells,
                                walk,
                                culling,
                                resolution,
                                form,
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

/// Plans times levels times workers, each on a few cases of the matrix in turn, so that every plan, level and number of
/// workers meets every other and every case is met.
#[test]
fn every_combination_changes_nothing() {
    let (matrix, levels) = (matrix(), Level::available());
    let plans = plans();
    let workers = [1, 2, 3, 5, 8];
    let mut tasks = Vec::new();
    for (p, plan) in plans.iter().enumerate() {
        for (l, level) in levels.iter().enumerate() {
            for (w, workers) in workers.iter().enumerate() {
                let sharing = if (p + l + w) % 4 == 0 { Sharing::Mirrored } else { Sharing::Shared };
                let case = (tasks.len() * 7) % matrix.cases.len();
                tasks.push((Plan { sharing, ..*plan }, *level, *workers, case));
            }
        }
    }
    assert_eq!(plans.len(), 128, "a choice was added or lost");
    assert_eq!(tasks.len(), 128 * levels.len() * workers.len());
    eprintln!("levels: {}", levels.iter().map(|level| level.name()).collect::<Vec<_>>().join(", "));
    let each = tasks.par_iter().map(|&(plan, level, workers, case)| {
        let case = &matrix.cases[case];
        judge(case, &naive(case, plan.form), plan, level, workers)
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
    for cells in [0, 65, 255] {
        let plan = Plan { resolution: Resolution::Fixed(cells), ..Plan::safe() };
        assert_eq!(render(plan).expect_err("no such grid"), optimized::RenderError::Resolution { cells });
    }
}
