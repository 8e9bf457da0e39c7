//! Does what is told of a frame say what was rendered: the first wrong pixel, counts, speed, and whose picture a twin is?

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Size, Sphere};
use optimized::{Event, Level};
use reference::{Arithmetic, Ray, Tracer};
use std::time::Duration;
use verify::report::{Environment, Report, SCHEMA_VERSION, ScenePictures, SceneReport, html};
use verify::run::{Frame, run};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::subject::{Grid, Naive, NamedPlan, Promise, Rendered, Rounding, Subject, SubjectError};
use verify::verdict::Verdict;

/// The exact picture with something done to it or told of it, under any name and promise.
struct Spoilt {
    name: &'static str,
    promise: Promise,
    spoil: fn(&mut Rendered),
}

impl Subject for Spoilt {
    fn name(&self) -> &str {
        self.name
    }

    fn description(&self) -> &str {
        "made up"
    }

    fn promise(&self) -> Promise {
        self.promise
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        _: usize,
        _: &(dyn Fn() + Sync),
    ) -> Result<Rendered, SubjectError> {
        let image = Tracer::new(Arithmetic::Exact).render(scene, camera)?.image;
        let mut rendered = Rendered { image, notes: Vec::new(), took: None };
        (self.spoil)(&mut rendered);
        Ok(rendered)
    }
}

const WIDTH: usize = 48;

fn made() -> (Scene, Camera) {
    let loaded = Source::parse("uniform:60:5").and_then(|source| source.load()).expect("generated");
    let size = Some(Size::new(48, 32).expect("small"));
    let camera = Framing { size, ..Framing::default() }.camera(&loaded.animation).expect("in view");
    (loaded.animation.frames()[0].clone(), camera)
}

fn told(scene: &Scene, camera: &Camera, replay: &str, subjects: &[&dyn Subject]) -> SceneReport {
    shown(scene, camera, replay, subjects).0
}

fn shown(
    scene: &Scene,
    camera: &Camera,
    replay: &str,
    subjects: &[&dyn Subject],
) -> (SceneReport, ScenePictures) {
    let frame = Frame {
        name: "a",
        description: "b",
        provenance: "c",
        scene,
        camera,
        frame: [0, 1],
        warnings: &[],
        replay,
    };
    run(&frame, subjects, &[], 1, &|_, _| Box::new(|| ())).expect("it is judged")
}

fn page(scenes: Vec<SceneReport>, pictures: ScenePictures) -> String {
    let report = Report {
        schema_version: SCHEMA_VERSION,
        title: "a".into(),
        verdict: Verdict::Wrong,
        environment: Environment {
            program: "cgt".into(),
            target: "any".into(),
            cpu: None,
            simd: "scalar".into(),
            rustc: "rustc".into(),
            threads: 1,
            date: "2026-01-01".into(),
            command_line: "cgt verify".into(),
            seed: None,
        },
        scenes,
        claims: Vec::new(),
        broken: Vec::new(),
        absent: Vec::new(),
    };
    html(&report, &[pictures], &[]).expect("a page")
}

/// The first pixel that hits from row 10 and column 4 on, so that neither is 0 and none is the other.
fn first_seen(image: &Image) -> usize {
    let seen = |i: &usize| image.ids[*i] != MISS && i % WIDTH > 3;
    (10 * WIDTH..image.ids.len()).find(seen).expect("something is seen")
}

#[test]
fn the_first_wrong_pixel_is_told_in_full() {
    let (scene, camera) = made();
    let truth = Tracer::new(Arithmetic::Exact).render(&scene, &camera).expect("small").image;
    let at = first_seen(&truth);
    assert_ne!(at % WIDTH, at / WIDTH);
    fn spoil(Rendered { image, .. }: &mut Rendered) {
        let at = first_seen(image);
        (image.ids[at], image.t[at]) = (MISS, f32::INFINITY);
        (image.ids[at + 60], image.t[at + 60]) = (7, 1.5);
    }
    let spoilt = Spoilt { name: "spoilt", promise: Promise::Exact, spoil };
    let report = told(&scene, &camera, "cgt verify a", &[&spoilt]);
    let ray = Ray::of_pixel(&camera, (at % WIDTH) as u32, (at / WIDTH) as u32);
    let bits = |x: f32| format!("{x:?} (0x{:08x})", x.to_bits());
    let three = |v: [f32; 3]| format!("{}, {}, {}", bits(v[0]), bits(v[1]), bits(v[2]));
    let [r, g, b, _] = truth.rgba[at];
    let due = [
        format!("pixel      ({}, {})", at % WIDTH, at / WIDTH),
        format!("eye        {}", three(ray.eye)),
        format!("direction  {}", three(ray.dir)),
        format!("truth      sphere {} at t = {}, colour [{r}, {g}, {b}]", truth.ids[at], bits(truth.t[at])),
        "subject    a miss".into(),
        "replay     cgt verify a --subject spoilt".into(),
    ];
    let subject = &report.subjects[0];
    assert_eq!(subject.verdict, Verdict::Wrong);
    assert_eq!(subject.first_wrong.as_deref(), Some(due.join("\n").as_str()));
    let unasked = told(&scene, &camera, "", &[&spoilt]);
    assert_eq!(unasked.subjects[0].first_wrong.as_deref(), Some(due[..5].join("\n").as_str()));
}

#[test]
fn what_was_asked_and_how_fast_is_told() {
    let (_, camera) = made();
    let ball = |z: f32| Sphere { center: [0.5, 0.5, z], radius: 0.4, color: [90; 3] };
    // Twins, so that integers are asked which comes first.
    let scene = Scene::new(vec![ball(0.5), ball(0.5)], [0; 3], DEFAULT_LIGHT).expect("valid");
    let report = told(&scene, &camera, "", &[&Naive(Rounding::TextbookF64)]);
    let undecided = Tracer::new(Arithmetic::Exact).render(&scene, &camera).expect("small").undecided;
    let counts: Vec<(&str, u64)> = report.judge.counters.iter().map(|c| (c.name.as_str(), c.value)).collect();
    let due = [
        ("rays", 48 * 32),
        ("hits that integers decided", undecided.hits),
        ("orders of two roots that integers decided", undecided.orders),
        ("roundings of t that integers decided", undecided.roundings),
    ];
    assert_eq!(counts, due);
    assert!(undecided.orders > 20 && report.hits >= undecided.orders, "{undecided:?}");
    let subject = &report.subjects[0];
    let (seconds, speed) =
        (subject.seconds.expect("it took time"), subject.rays_per_second.expect("it has a speed"));
    assert!((seconds * speed / (48.0 * 32.0) - 1.0).abs() < 1e-9, "{seconds} s at {speed} a second");
    // What was around it does not count for who says what it took.
    let spoil = |rendered: &mut Rendered| rendered.took = Some(Duration::from_secs(2));
    let timed = Spoilt { name: "timed", promise: Promise::Exact, spoil };
    let report = told(&scene, &camera, "", &[&timed]);
    let subject = &report.subjects[0];
    assert_eq!((subject.seconds, subject.rays_per_second), (Some(2.0), Some(24.0 * 32.0)));
}

/// Numbers of a sentence, in their order.
fn numbers(sentence: &str) -> Vec<f64> {
    let words = sentence.split(|c: char| !c.is_ascii_digit() && c != '.').map(|word| word.trim_matches('.'));
    words.filter(|word| !word.is_empty()).map(|word| word.parse().expect("a number")).collect()
}

/// What the grid tracer says of its own picture are the counts of the very same frame, each in its place.
#[test]
fn the_notes_of_a_picture_are_its_counts() {
    let ball = |x: f32, y: f32, radius| Sphere { center: [x, y, 0.0], radius, color: [90; 3] };
    // Two that each ray of the middle column hits at once, which integers decide, and two that are apart by so little that f64 can.
    let nearly = 1.0 + f32::EPSILON;
    let pairs = [ball(0.5, 2.5, 1.0), ball(-0.5, 2.5, 1.0), ball(0.5, -2.5, 1.0), ball(-0.5, -2.5, nearly)];
    let scene = Scene::new(pairs.to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(27, 53).expect("small");
    let (du, dv) = ([0.0625, 0.0, 0.0], [0.0, -0.0625, 0.0]);
    let corner = [-13.5 * 0.0625, 26.5 * 0.0625, -1.0];
    let camera = Camera::new([0.0, 0.0, 5.0], corner, du, dv, size).expect("a camera");
    let level = Level::best().expect("there is one");
    let notes = |plan: NamedPlan, scene: &Scene| {
        let grid = Grid::new(plan, level, false, None);
        grid.render(scene, &camera, 1, &|| ()).expect("a picture").notes
    };
    for plan in [NamedPlan::Fast, NamedPlan::Safe] {
        let counts =
            optimized::Tracer::new(plan.plan(), level).render(&scene, &camera).expect("small").counts;
        let told = notes(plan, &scene);
        let due = [counts.cells, counts.candidates, counts.culled, counts.split_blocks].map(|n| n as f64);
        assert_eq!(numbers(&told[0]), due, "{}", told[0]);
        assert!(told[0].contains("cells visited") && due[1] > due[2], "{}", told[0]);
        if plan != NamedPlan::Fast {
            assert_eq!(told.len(), 1, "who asks nobody tells of no stages: {told:?}");
            continue;
        }
        assert!(told[1].starts_with("Of ") && told[1].contains(" in a million) to f64"), "{}", told[1]);
        let lanes = counts.lanes as f64;
        let stages = [counts.asked_f64, counts.asked_integers, counts.rounded_by_integers];
        let due = stages.map(|n| [n as f64, n as f64 / lanes * 1e6]).concat();
        let said = numbers(&told[1].replace("f32", "").replace("f64", ""));
        assert_eq!((said[0], said.len()), (lanes, 7), "{}", told[1]);
        assert!(said[1..].iter().zip(&due).all(|(x, y)| (x - y).abs() < 0.051), "{due:?}: {}", told[1]);
        eprintln!("{}", told[1]);
        let [f64s, integers, rounded] = stages;
        assert!(f64s > integers && integers > 0 && rounded != integers, "nothing could be mistaken");
    }
    let empty = Scene::new(Vec::new(), [0; 3], DEFAULT_LIGHT).expect("valid");
    assert!(notes(NamedPlan::Fast, &empty).iter().all(|note| !note.contains("NaN")));
}

/// Of each kind of event how many there were, and the first in full; where not all were kept, at least so many.
#[test]
fn the_notes_of_events_count_each_kind() {
    let (_, camera) = made();
    let speck = Sphere { center: [0.01, 0.02, 0.03], radius: 1e-4, color: [90; 3] };
    let large = Sphere { center: [0.5; 3], radius: 0.45, color: [90; 3] };
    let level = Level::best().expect("there is one");
    type Is = fn(&Event) -> bool;
    let kinds: [(Is, &str); 2] = [
        (|event| matches!(event, Event::CellFull { .. }), "pushes onto full queues"),
        (|event| matches!(event, Event::SpansCells { .. }), "spheres with more than two cells on an axis"),
    ];
    for (specks, all_are_kept) in [(40, true), (optimized::Events::KEPT + 100, false)] {
        let spheres = [vec![large, Sphere { radius: 0.4, ..large }], vec![speck; specks]].concat();
        let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
        let events = optimized::Tracer::new(NamedPlan::Paper.plan(), level).render(&scene, &camera);
        let events = events.expect("small").events;
        let paper = Grid::new(NamedPlan::Paper, level, false, None);
        let notes = paper.render(&scene, &camera, 1, &|| ()).expect("a picture").notes;
        assert_eq!(events.count() == events.first().len() as u64, all_are_kept, "{} events", events.count());
        let more = if all_are_kept { "" } else { "at least " };
        for (is, what) in kinds {
            let own: Vec<&Event> = events.first().iter().filter(|event| is(event)).collect();
            let note = format!("{more}{} {what}, the first: {}.", own.len(), own.first().expect("at stake"));
            assert!(notes.contains(&note), "no {note:?} in {notes:?}");
        }
        assert_eq!(notes.len(), 3, "and the counts: {notes:?}");
    }
}

/// Where a promise to be the naive picture is broken, that is told, marked and shown, though the pixel is the truth's own.
#[test]
fn a_broken_twin_is_shown_beside_its_promise() {
    let (scene, camera) = made();
    let by = |arithmetic: Arithmetic| Tracer::new(arithmetic).render(&scene, &camera).expect("small").image;
    let (truth, naive) = (by(Arithmetic::Exact), by(Rounding::TextbookF32.naive()));
    let at = (0..naive.t.len()).find(|i| naive.t[*i] != truth.t[*i] && naive.ids[*i] == truth.ids[*i]);
    let at = at.expect("f32 rounds");
    // The exact picture differs from the naive one there first, and nowhere from the truth.
    let promise = Promise::EqualToNaive(Rounding::TextbookF32);
    let exact = Spoilt { name: "better", promise, spoil: |_| () };
    let (report, pictures) = shown(&scene, &camera, "", &[&exact]);
    let subject = &report.subjects[0];
    let comparison = subject.comparison.as_ref().expect("it is compared");
    assert_eq!((subject.verdict, comparison.wrong_ids + comparison.wrong_t), (Verdict::Wrong, 0));
    let place = [(at % WIDTH) as u32, (at / WIDTH) as u32];
    assert_eq!(comparison.first_wrong, Some(place));
    let account = subject.first_wrong.as_deref().expect("it is told");
    let line = |head: &str| account.lines().find(|line| line.starts_with(head)).expect(head).to_owned();
    let bits = |x: f32| format!("0x{:08x}", x.to_bits());
    for (head, t) in [("truth ", truth.t[at]), ("promised ", naive.t[at]), ("subject ", truth.t[at])] {
        assert!(line(head).contains(&bits(t)), "{head}: {account}");
    }
    // Beside the truth there would be nothing to see.
    let html = page(vec![report.clone()], pictures);
    assert!(html.contains("<p>Promised</p>") && !html.contains("has the bits of the exact picture"));
    // Who is as promised has no such line, though it differs from the truth.
    let own = Naive(Rounding::TextbookF32);
    let (report, pictures) = shown(&scene, &camera, "", &[&own]);
    let account = report.subjects[0].first_wrong.as_deref().expect("it rounds");
    assert!(!account.contains("promised"), "{account}");
    let html = page(vec![report.clone()], pictures);
    assert!(html.contains("<p>Truth</p>") && !html.contains("<p>Promised</p>"));
}

/// Whoever is called as the naive tracer is, or comes before it, a promise to be equal to it is held against the naive tracer itself.
#[test]
fn a_twin_is_the_naive_tracers_own() {
    let (scene, camera) = made();
    let safe = Grid::new(NamedPlan::Safe, Level::best().expect("there is one"), false, None);
    let Promise::EqualToNaive(rounding) = safe.promise() else {
        panic!("safe promises to be a naive picture")
    };
    let naive = Naive(rounding);
    let rounded = Promise::Rounded(rounding);
    let namesake = Spoilt {
        name: "naive-f32-perpendicular",
        promise: rounded,
        spoil: |rendered| rendered.image.ids.fill(3),
    };
    assert_eq!(namesake.name, naive.name());
    let other = Naive(Rounding::TextbookF32);
    let before: [&[&dyn Subject]; 5] =
        [&[], &[&naive], &[&other], &[&namesake], &[&other, &namesake, &naive]];
    for before in before {
        let subjects = [before, &[&safe]].concat();
        let report = told(&scene, &camera, "", &subjects);
        let last = report.subjects.last().expect("it is told of");
        let names: Vec<_> = before.iter().map(|subject| subject.name()).collect();
        assert_eq!(last.name, safe.name());
        assert!(
            [Verdict::Equal, Verdict::WithinBound].contains(&last.verdict),
            "after {names:?}: {}",
            last.because
        );
    }
}
