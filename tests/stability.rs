//! Do the maps of where methods break show the breakdowns that are known, and nothing where there is nothing?

use contract::{Camera, Image, MISS, Scene, Size, Sphere};
use optimized::{Level, Plan};
use reference::{Arithmetic, Ray, Tracer};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;
use verify::advice::advice;
use verify::bench::contestant::{Contestant, Frame, Kind, Layers, Oath};
use verify::chart::{Chart, Point, View};
use verify::methods::{Family, Method, swept};
use verify::report::Environment;
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::{count, generator, seed};
use verify::stability::breakdown::breakdown;
use verify::stability::data::{Count, Curve, Line, Map};
use verify::stability::measure::Named;
use verify::stability::sweep::SWEEPS;
use verify::stability::text::text;
use verify::stability::{Asked, SCHEMA_VERSION, Stability, stability, steps};
use verify::subject::SubjectError;

fn named(word: &str) -> Named {
    let loaded = Source::parse(word).and_then(|source| source.load()).expect("bundled or generated");
    let framing = Framing { size: Size::new(160, 90).ok(), ..loaded.framing.unwrap_or_default() };
    let camera = framing.camera(&loaded.animation).expect("a camera");
    Named { name: word.into(), scene: loaded.animation.frames()[0].clone(), camera }
}

fn run(
    methods: &(dyn Fn(Option<u8>) -> Vec<Method> + Sync),
    rays: u64,
    seed: u64,
    scenes: &[Named],
) -> Stability {
    let level = Level::best().expect("a level");
    let ticks = AtomicU32::new(0);
    let asked = Asked { methods, level, rays, seed, scenes, only: &[] };
    let (curves, maps) = stability(&asked, &|| _ = ticks.fetch_add(1, Ordering::Relaxed));
    assert_eq!(ticks.into_inner(), steps(&asked), "the progress bar does not end where it should");
    told(rays, seed, curves, maps)
}

fn told(rays: u64, seed: u64, curves: Vec<Curve>, maps: Vec<Map>) -> Stability {
    let environment = Environment {
        program: "cgt".into(),
        target: "any".into(),
        cpu: None,
        simd: "best".into(),
        rustc: "rustc".into(),
        threads: 1,
        date: "2026-01-01".into(),
        command_line: "cgt stability".into(),
        seed: Some(seed),
    };
    let absent = Vec::new();
    Stability { schema_version: SCHEMA_VERSION, kind: "stability", environment, absent, rays, curves, maps }
}

/// Of all methods, once for the tests that ask about it.
fn all() -> &'static Stability {
    static ALL: OnceLock<Stability> = OnceLock::new();
    ALL.get_or_init(|| {
        let (seed, rays) = (seed(), count("CGT_STABILITY_RAYS", 16_384));
        eprintln!("CGT_SEED={seed}, {rays} rays at each value");
        // One of the SPU's two forms: nothing is asked of the other here, and where an SPU is emulated it takes as long as all the rest.
        let methods = |cells| {
            let mut methods = swept(cells, Level::best().expect("a level"), &mut Vec::new());
            methods.retain(|method| method.name != "safe-spu-perpendicular");
            methods
        };
        run(&methods, rays, seed, &[named("2juy")])
    })
}

fn rate(found: &Stability, curve: &str, method: &str, at: f64) -> f64 {
    let curve = found.curve(curve).expect("it was measured");
    let near = |value: &f64| (value - at).abs() <= 1e-3 * at.abs();
    let k =
        curve.values.iter().position(near).unwrap_or_else(|| panic!("{at} is no value of {}", curve.name));
    curve
        .line(method)
        .and_then(|line| line.counts[k].rate())
        .unwrap_or_else(|| panic!("{method} at {at}: not judged"))
}

#[test]
fn the_exact_method_breaks_nowhere() {
    let found = all();
    assert_eq!(found.broken_promises(), Vec::<String>::new());
    let exact: Vec<&Count> =
        found.curves.iter().flat_map(|curve| &curve.line("fast").expect("it takes part").counts).collect();
    let (rays, hits) = (exact.iter().map(|c| c.rays).sum::<u64>(), exact.iter().map(|c| c.hits).sum::<u64>());
    eprintln!("judged {rays} rays of the exact method, {hits} of them hits");
    assert!(exact.iter().all(|count| count.rays > 0), "some value was not judged");
    assert!(hits > rays / 5, "hardly anything was hit");
    // Who is asked for the truth in a map is known by its row.
    for (map, expected) in [("grids", &["2juy, exact"][..]), ("packets", &["2juy"]), ("assumptions", &[])] {
        let map = found.map(map).expect("it was measured");
        let exact = map.rows.iter().zip(&map.exact).zip(&map.counts).filter(|((_, exact), _)| **exact);
        assert_eq!(
            exact.clone().map(|((name, _), _)| name.as_str()).collect::<Vec<_>>(),
            expected,
            "{}",
            map.name
        );
        assert!(exact.flat_map(|(_, row)| row).all(|c| c.rays > 0 && c.wrong == 0), "{map:?}");
        assert_eq!(map.exact.len(), map.rows.len(), "{}", map.name);
    }
}

/// As FACTS of this project were measured before: the textbook form by a thousand radii, the perpendicular one a hundred times later.
#[test]
fn rounding_breaks_where_it_is_known_to() {
    let found = all();
    let at = |method, radii| rate(found, "distance", method, radii);
    assert!((1e-3..0.1).contains(&at("naive-f32-textbook", 1000.0)), "{}", at("naive-f32-textbook", 1000.0));
    assert!(at("naive-f32-textbook", 1e4) > 0.2);
    // What is cut off is off more often than what is rounded to nearest. Of t there are thousands; of wrong spheres, where these begin, too few.
    let off = |method| {
        let line = found.curve("distance").and_then(|curve| curve.line(method)).expect("measured");
        [0, 2].map(|k| line.counts[k].wrong_t.expect("t was compared")).iter().sum::<u64>()
    };
    let (spu, textbook) = (off("safe-spu-textbook"), off("naive-f32-textbook"));
    assert!(spu > textbook, "SPU {spu}, f32 {textbook}, CGT_SEED={:?}", found.environment.seed);
    assert!(at("naive-f32-perpendicular", 1e4) < 1e-3 && at("naive-f32-perpendicular", 1e6) > 1e-3);
    assert!(at("naive-f64", 1e5) < 1e-3 && at("naive-f64", 1e8) > 1e-3, "f64 has its end too");
    let breakdown =
        |method| found.curve("distance").and_then(|c| c.line(method)).expect("measured").breakdown.up[2];
    let (textbook, perpendicular) = (breakdown("naive-f32-textbook"), breakdown("naive-f32-perpendicular"));
    assert!(
        textbook.zip(perpendicular).is_some_and(|(a, b)| 30.0 * a <= b),
        "{textbook:?} {perpendicular:?}"
    );
    // A grid changes nothing of the form that it carries.
    let lines = |method| {
        found.curves.iter().filter(|c| c.by_truth).map(move |c| &c.line(method).expect("measured").counts)
    };
    assert!(lines("safe").eq(lines("naive-f32-perpendicular")), "the safe plan is not the naive form");
    for scale in [1e-30, 1e30] {
        assert!(rate(found, "scale", "naive-f32-perpendicular", scale) > 0.1, "{scale}");
    }
    assert!(rate(found, "tangency", "naive-f32-perpendicular", 1.0) > 0.1);
    assert!(rate(found, "tangency", "naive-f32-perpendicular", 65_536.0) < 1e-9);
}

#[test]
fn the_paper_is_right_within_its_assumptions_and_wrong_beyond() {
    let found = all();
    let map = found.map("assumptions").expect("it was measured");
    for (row, counts) in map.rows.iter().zip(&map.counts) {
        let ratio: f64 = row.split(' ').next().and_then(|word| word.parse().ok()).expect("a number");
        for (column, count) in map.columns.iter().zip(counts) {
            let (ids, rate) =
                (column.parse::<u32>().expect("a number"), count.rate().expect("it was judged"));
            // At the width of a cell itself rounding decides.
            if ratio < 1.0 && ids <= 16 {
                assert_eq!(count.wrong, 0, "{row}, {column} ids");
            } else if ratio > 1.0 {
                assert!(rate > 1e-3, "{row}, {column} ids: {rate}");
            }
        }
    }
    assert!(rate(found, "crowd", "paper", 16.0) < 1e-3 && rate(found, "crowd", "paper", 64.0) > 1e-2);
    assert!(rate(found, "size", "paper", 0.9) < 1e-3 && rate(found, "size", "paper", 1.5) > 1e-2);
    let grids = found.map("grids").expect("it was measured");
    let paper = grids.rows.iter().position(|row| row == "2juy, paper").expect("a row");
    for (cells, count) in grids.columns.iter().zip(&grids.counts[paper]) {
        assert!(!["8", "16"].contains(&cells.as_str()) || count.rate() > Some(1e-3), "{cells}: {count:?}");
    }
}

#[test]
fn changes_without_a_truth_show_what_is_unstable() {
    let found = all();
    assert!(rate(found, "turned", "naive-f32-textbook", 1e4) > 1e-2, "another order of sums changes nothing");
    assert!(rate(found, "turned", "naive-f32-textbook", 10.0) < 1e-3);
    assert!(
        rate(found, "moved", "naive-f32-textbook", 131_072.0) < 1e-9,
        "differences of lattice points are exact"
    );
    assert!(rate(found, "scaled", "naive-f32-textbook", 256.0) < 1e-9);
    assert!(rate(found, "scaled", "naive-f32-textbook", 2f64.powi(120)) > 0.1);
}

#[test]
fn a_run_is_its_seed_and_a_liar_is_named() {
    let level = Level::best().expect("a level");
    let methods = move |_| {
        vec![
            Method::grid("liar", Family::Exact, |_| Plan::paper(), level, 1),
            Method::grid("rounded", Family::Textbook, |_| Plan::safe(), level, 1),
            // Its spheres are right, near by; its t are rounded.
            Method::grid("in t", Family::Exact, |_| Plan::safe(), level, 1),
        ]
    };
    let (one, again) = (run(&methods, 512, 5, &[]), run(&methods, 512, 5, &[]));
    let lines = |found: &Stability| serde_json::to_string(&found.curves).expect("JSON");
    assert_eq!(lines(&one), lines(&again));
    assert_ne!(lines(&one), lines(&run(&methods, 512, 6, &[])));
    let broken = one.broken_promises();
    let of = |name: &str| broken.iter().filter(|line| line.contains(name)).count();
    assert!(of("liar") > 0 && of("in t") > 0 && of("rounded") == 0, "{broken:?}");
    let near = one.curve("distance").and_then(|c| c.line("in t")).expect("measured").counts[2];
    assert!(near.wrong == 0 && near.wrong_t > Some(0) && near.t_ulp_p99.is_some(), "{near:?}");
    let turned = one.curve("turned").and_then(|c| c.line("in t")).expect("measured").counts[0];
    assert_eq!((turned.wrong_t, turned.t_ulp_p99), (None, None), "of t nothing was compared");
    let csv = String::from_utf8(one.csv().expect("in memory")).expect("text");
    let expected = one.curves.iter().map(|c| c.values.len() * c.lines.len()).sum::<usize>()
        + one.maps.iter().map(|m| m.counts.iter().map(Vec::len).sum::<usize>()).sum::<usize>();
    assert_eq!(csv.lines().count(), 1 + expected);
    let page = verify::stability::page::page(&one).expect("filled in");
    assert!(page.contains("liar") && page.contains("Where each method breaks") && !page.contains("http://"));
}

#[test]
fn breakdowns_are_looked_for_away_from_the_easy_value() {
    let values = [0.01, 0.1, 1.0, 10.0, 100.0];
    let rates = [Some(0.5), Some(0.0), Some(0.0), Some(1e-5), Some(0.02)];
    let found = breakdown(&values, &rates, 1.0);
    assert_eq!(found.up, [Some(10.0), Some(10.0), Some(100.0), Some(100.0)]);
    assert_eq!(found.down, [Some(0.01); 4]);
    let unknown = breakdown(&values, &[None, None, Some(0.0), None, None], 1.0);
    assert_eq!((unknown.up, unknown.down), ([None; 4], [None; 4]), "what was not measured breaks nothing");
    let easy = breakdown(&[1.0, 2.0], &[Some(1.0), Some(0.0)], 1.0);
    assert_eq!((easy.up[3], easy.down[3]), (Some(1.0), Some(1.0)));
}

/// Of rates that are made up, so that nothing depends on what is drawn.
#[test]
fn advice_is_what_was_measured() {
    let mut found = all().clone();
    found.curves.retain(|curve| curve.name == "distance");
    let ns = |method: &str, ns: f64| Point {
        method: method.into(),
        family: Family::Exact,
        exact: true,
        description: String::new(),
        ns_per_ray: Some(ns),
        spu_cycles_per_ray: None,
        comparison: None,
        paints: false,
        remark: None,
    };
    let view = View {
        scene: "made up".into(),
        frame: 0,
        spheres: 1,
        size: [1, 1],
        times_as_far: 1.0,
        radii: 1.0,
        hits: 1,
        rounds: 1,
        points: vec![ns("fast", 10.0), ns("safe", 5.0), ns("safe-textbook", 40.0)],
    };
    let environment = found.environment.clone();
    let chart =
        Chart { schema_version: 1, kind: "chart", environment, absent: Vec::new(), views: vec![view] };
    let said = advice(&found, &chart);
    let of = |name: &str| said.iter().find(|advice| advice.method.starts_with(name)).expect("it is told of");
    assert!(
        of("fast").never_wrong
            && of("fast").holds_within.is_empty()
            && of("fast").word.starts_with("Take this")
    );
    let safe = of("perpendicular");
    assert!(!safe.never_wrong && safe.word.contains("0.500"), "{safe:?}");
    let line = found.curve("distance").and_then(|curve| curve.line("safe")).expect("measured");
    let last = line.counts.iter().take_while(|count| count.rate() < Some(1e-3)).count() - 1;
    let expected = found.curve("distance").expect("measured").values[last];
    assert!(
        safe.holds_within.len() == 1 && safe.holds_within[0].starts_with("distance by radius: at most"),
        "{safe:?}"
    );
    assert!((3e4..3e6).contains(&expected), "{expected}");
    assert!(of("textbook form in f32").word.contains("nothing speaks for it"));
    let page = verify::advice::part(&said).expect("filled in");
    assert!(page.contains("never wrong in all that was tried") && page.contains("made up 10.0 ns"));
    // What was not measured is no pass.
    let mut blind = found.clone();
    blind.curves[0]
        .lines
        .iter_mut()
        .filter(|line| line.method == "fast")
        .for_each(|line| line.counts[3] = Count::default());
    assert!(!advice(&blind, &chart)[0].never_wrong);
    let mut untold = found.clone();
    untold.curves[0].by_truth = false;
    assert!(!advice(&untold, &chart)[0].never_wrong, "no truth was asked, and it is never wrong");
    // To give no picture is no way to be right.
    let mut refusing = found.clone();
    let curve = &mut refusing.curves[0];
    let line = curve.lines.iter_mut().find(|line| line.method == "fast").expect("measured");
    line.counts[7..].fill(Count { refused: 1, ..Count::default() });
    let said = &advice(&refusing, &chart)[0];
    let limits: Vec<_> = said.holds_within.iter().filter(|limit| limit.contains(": at most ")).collect();
    assert!(!said.never_wrong && limits.len() == 1, "{said:?}");
    assert!(verify::stability::page::page(&blind).expect("filled in").contains(": not measured</title>"));
    assert!(!verify::stability::page::page(&found).expect("filled in").contains(": not measured</title>"));
}

/// The middle ray goes at the angle to the nearest axis that is told, and the cloud stands as far from the origin, with the eye at its
/// distance of one of its balls. Few methods break by either, so that no rate tells whether it is turned up.
#[test]
fn what_is_said_to_be_turned_up_is() {
    let length = |v: [f64; 3]| v.into_iter().map(|x| x * x).sum::<f64>().sqrt();
    let sweep = |name: &str| SWEEPS.iter().find(|sweep| sweep.name == name).expect("it is one of them");
    let (angle, offset) = (sweep("angle"), sweep("offset"));
    for shot in 0..8 {
        for degrees in (angle.values)() {
            let shot = (angle.shot)(degrees, &mut generator(7, shot)).expect("a shot");
            let size = shot.camera.size();
            let dir = Ray::of_pixel(&shot.camera, size.width() / 2, size.height() / 2).dir.map(f64::from);
            let along = dir.into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let found = (along / length(dir)).acos().to_degrees();
            assert!((found - degrees).abs() < 0.1, "{found} degrees of {degrees}");
        }
        for radii in (offset.values)() {
            let shot = (offset.shot)(radii, &mut generator(7, shot)).expect("a shot");
            let (balls, eye) = (shot.scene.spheres(), shot.camera.eye().map(f64::from));
            let middle = [0, 1, 2].map(|i| {
                balls.iter().map(|ball| f64::from(ball.center[i])).sum::<f64>() / balls.len() as f64
            });
            // In units in the last place of so large a number.
            let error = 0.5 + 1e-6 * radii;
            assert!((length(middle) - radii).abs() < error, "{middle:?} for an offset of {radii}");
            let apart = |ball: &Sphere| length([0, 1, 2].map(|i| f64::from(ball.center[i]) - eye[i])) - 20.0;
            assert!(balls.iter().any(|ball| apart(ball).abs() < error), "no ball 20 radii from {eye:?}");
        }
    }
}

// ---- methods and runs that are made up ----

/// The exact picture with some of its t moved: of its hits, counted from 0, those of which `moved` says by how many units in the last place.
struct Scripted {
    moved: fn(usize) -> u32,
    image: Option<Image>,
}

impl Contestant for Scripted {
    fn name(&self) -> &str {
        "scripted"
    }

    fn description(&self) -> String {
        "made up".into()
    }

    fn kind(&self) -> Kind {
        Kind::Naive
    }

    fn oath(&self) -> Oath {
        Oath::Exact
    }

    fn frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Frame<'_>, SubjectError> {
        let image = self.image.insert(Tracer::new(Arithmetic::Exact).threads(1).render(scene, camera)?.image);
        let hits = image.ids.iter().zip(&mut image.t).filter(|(id, _)| **id != MISS);
        for (k, (_, t)) in hits.enumerate() {
            *t = f32::from_bits(t.to_bits() + (self.moved)(k));
        }
        let layers = Layers { ids: &image.ids, t: &image.t, rgba: None };
        Ok(Frame { build: Duration::ZERO, took: None, layers })
    }
}

fn moved(name: &str, moved: fn(usize) -> u32) -> Method {
    Method::made(name, Family::F64, move |_, _| Ok(Box::new(Scripted { moved, image: None })))
}

/// Of a hundred errors in order the 99th is told: not their middle, and not the farthest.
#[test]
fn errors_of_t_are_told_at_99_in_100() {
    let methods = |_| {
        vec![
            moved("none", |_| 0),
            moved("two in a hundred", |k| if k % 50 == 0 { 900 } else { 0 }),
            moved("one in a picture", |k| if k == 0 { 5000 } else { 0 }),
            Method::made("refuses", Family::Exact, |_, _| Err("it would not".into())),
        ]
    };
    let (level, only) = (Level::best().expect("a level"), ["angle".to_owned()]);
    let asked = Asked { methods: &methods, level, rays: 2048, seed: 3, scenes: &[], only: &only };
    let (curves, maps) = stability(&asked, &|| ());
    assert!(curves.len() == 1 && maps.is_empty());
    let counts = |name: &str| &curves[0].line(name).expect("it took part").counts;
    for (name, p99) in [("none", 0), ("two in a hundred", 900), ("one in a picture", 0)] {
        assert_eq!(counts(name).len(), curves[0].values.len());
        for count in counts(name) {
            assert_eq!((count.rays, count.wrong, count.refused), (2048, 0, 0), "{name}");
            assert!(count.hits > 400, "hardly a hit");
            assert_eq!(count.t_ulp_p99, Some(p99), "{name}: {count:?}");
        }
    }
    let wrong = |name: &str| counts(name).iter().map(|count| count.wrong_t).collect::<Vec<_>>();
    assert!(wrong("none").iter().all(|wrong| *wrong == Some(0)));
    assert!(wrong("one in a picture").iter().all(|wrong| *wrong == Some(2)), "one in each of two pictures");
    for count in counts("refuses") {
        assert_eq!(*count, Count { refused: 2, ..Count::default() });
    }
    let found = told(2048, 3, curves.clone(), maps);
    assert_eq!(found.broken_promises().len(), curves[0].values.len(), "who only refuses is not named");
    assert_eq!(found.compared(), 3 * 2048 * curves[0].values.len() as u64);
}

/// Each number another, so that none can stand for another.
const COUNT: Count =
    Count { rays: 1000, hits: 500, wrong: 3, wrong_t: Some(44), t_ulp_p99: Some(55), refused: 6 };
/// Asked, and all of it right.
const RIGHT: Count =
    Count { rays: 1000, hits: 500, wrong: 0, wrong_t: Some(0), t_ulp_p99: Some(0), refused: 0 };

fn curve(lines: Vec<(&str, bool, Vec<Count>)>) -> Curve {
    let values = vec![0.25, 0.5, 1.0, 2.0, 4.0];
    let line = |(method, exact, counts): (&str, bool, Vec<Count>)| {
        let rates: Vec<_> = counts.iter().map(Count::rate).collect();
        let breakdown = breakdown(&values, &rates, 1.0);
        Line { method: method.into(), family: Family::Foreign, exact, counts, breakdown }
    };
    Curve {
        name: "turned-up".into(),
        title: "Turned up".into(),
        axis: "how far".into(),
        what: "Something is turned up.".into(),
        by_truth: true,
        easy: 1.0,
        lines: lines.into_iter().map(line).collect(),
        values,
        marks: Vec::new(),
    }
}

fn map(exact: [bool; 2], counts: [[Count; 2]; 2]) -> Map {
    Map {
        name: "mapped".into(),
        title: "Mapped".into(),
        what: "Two things are turned up.".into(),
        axis: "how many".into(),
        columns: vec!["one".into(), "two".into()],
        rows: vec!["first row".into(), "second row".into()],
        exact: exact.into(),
        counts: counts.map(Vec::from).into(),
        marks: Vec::new(),
        row_marks: Vec::new(),
    }
}

/// In curves and in maps, and by who promised it alone: to be wrong in an id or a t breaks it, to refuse, and to be asked nothing.
#[test]
fn a_promise_of_the_truth_is_kept_by_answers_that_are_right() {
    for (what, count, broken) in [
        ("all is right", RIGHT, false),
        ("t is not compared", Count { wrong_t: None, t_ulp_p99: None, ..RIGHT }, false),
        ("another sphere", Count { wrong: 1, ..RIGHT }, true),
        ("another t", Count { wrong_t: Some(1), ..RIGHT }, true),
        ("refused once", Count { refused: 1, ..RIGHT }, true),
        ("refused always", Count { refused: 24, ..Count::default() }, true),
        ("nothing was asked", Count::default(), true),
    ] {
        let row = vec![RIGHT, RIGHT, RIGHT, count, RIGHT];
        let curves =
            |exact| vec![curve(vec![("steady", true, vec![RIGHT; 5]), ("asked", exact, row.clone())])];
        let maps = |exact| vec![map([true, exact], [[RIGHT; 2], [RIGHT, count]])];
        let named = |curves, maps| told(1000, 1, curves, maps).broken_promises();
        let by_curve = named(curves(true), Vec::new());
        assert_eq!(by_curve.len(), usize::from(broken), "{what}, on a curve: {by_curve:?}");
        assert!(by_curve.iter().all(|line| line.starts_with("turned-up at 2, asked: ")), "{by_curve:?}");
        let by_map = named(Vec::new(), maps(true));
        assert_eq!(by_map.len(), usize::from(broken), "{what}, on a map: {by_map:?}");
        assert!(by_map.iter().all(|line| line.starts_with("mapped at two, second row: ")), "{by_map:?}");
        assert_eq!(named(curves(true), maps(true)).len(), 2 * usize::from(broken), "{what}");
        assert_eq!(
            named(curves(false), maps(false)),
            Vec::<String>::new(),
            "{what}: nobody promised anything"
        );
    }
}

#[test]
fn the_table_has_each_number_under_its_heading() {
    let bare = Count { wrong_t: None, t_ulp_p99: None, ..COUNT };
    let curves = vec![curve(vec![("own", false, vec![RIGHT, COUNT, bare, RIGHT, RIGHT])])];
    let found = told(1000, 1, curves, vec![map([false; 2], [[RIGHT; 2], [RIGHT, COUNT]])]);
    let csv = String::from_utf8(found.csv().expect("in memory")).expect("text");
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], "what,method_or_row,value,rays,hits,wrong,wrong_t,t_ulp_p99,refused");
    assert_eq!(
        lines[1..4],
        [
            "turned-up,own,0.25,1000,500,0,0,0,0",
            "turned-up,own,0.5,1000,500,3,44,55,6",
            "turned-up,own,1,1000,500,3,,,6"
        ]
    );
    assert_eq!(
        lines[6..9],
        [
            "mapped,first row,one,1000,500,0,0,0,0",
            "mapped,first row,two,1000,500,0,0,0,0",
            "mapped,second row,one,1000,500,0,0,0,0",
        ]
    );
    assert_eq!(lines[9], "mapped,second row,two,1000,500,3,44,55,6");
    assert_eq!(lines.len(), 10);
}

/// "Never" is said of who answered everywhere, on the terminal and on the page, and toward the end that is meant.
#[test]
fn who_refused_is_not_never_wrong() {
    let refused = Count { refused: 3, ..Count::default() };
    let curve = curve(vec![
        ("right", true, vec![RIGHT; 5]),
        ("refuses-above", false, vec![RIGHT, RIGHT, RIGHT, RIGHT, refused]),
        ("refuses-one", false, vec![Count { refused: 1, ..RIGHT }, RIGHT, RIGHT, RIGHT, RIGHT]),
        ("unasked-below", false, vec![Count::default(), RIGHT, RIGHT, RIGHT, RIGHT]),
        ("wrong-first", false, vec![RIGHT, RIGHT, RIGHT, Count { wrong: 1000, ..RIGHT }, refused]),
    ]);
    let said = |name: &str| [false, true].map(|up| curve.never(curve.line(name).expect("a line"), up));
    assert_eq!(said("right"), ["never"; 2]);
    assert_eq!(said("refuses-above"), ["never", "refused"]);
    assert_eq!(said("refuses-one"), ["refused", "never"]);
    assert_eq!(said("unasked-below"), ["–", "never"]);
    let found = told(1000, 1, vec![curve.clone()], Vec::new());
    let table = text(&found);
    for (name, word) in [
        ("right", "never"),
        ("refuses-above", "refused"),
        ("refuses-one", "refused"),
        ("unasked-below", "–"),
        ("wrong-first", "2"),
    ] {
        let line = table.lines().find(|line| line.trim_start().starts_with(name)).expect("a line of its own");
        let words: Vec<&str> = line.split_whitespace().collect();
        assert_eq!([words[1], words[3], words[4]], [word; 3], "{line}");
    }
    let page = verify::stability::page::page(&found).expect("filled in");
    for (name, below, above) in [
        ("right", "never", "never"),
        ("refuses-above", "never", "refused"),
        ("refuses-one", "refused", "never"),
        ("unasked-below", "–", "never"),
        ("wrong-first", "never", "2"),
    ] {
        let row = page.lines().find(|line| line.contains(&format!("<th scope=\"row\">{name}</th>")));
        let row = row.unwrap_or_else(|| panic!("{name} has no row"));
        let cells: Vec<&str> =
            row.split("<td").skip(1).map(|cell| cell.split(['>', '<']).nth(1).unwrap_or_default()).collect();
        // Once in a million is not seen with so few rays.
        assert_eq!(cells, [below, "–", below, below, above, "–", above, above], "{name}: {row}");
    }
}

/// The most that was seen wrong is the last figure of a line, and who compared nothing has none; a map marks what was refused.
#[test]
fn what_was_refused_has_no_figure_on_the_terminal() {
    let refused = Count { refused: 3, ..Count::default() };
    let partly = Count { refused: 3, ..RIGHT };
    let curve = curve(vec![
        ("right", true, vec![RIGHT; 5]),
        ("sometimes-wrong", false, vec![RIGHT, Count { wrong: 500, ..RIGHT }, COUNT, RIGHT, refused]),
        ("refuses-all", false, vec![refused; 5]),
        ("never-asked", false, vec![Count::default(); 5]),
    ]);
    let counts = [[partly, Count { wrong: 125, ..partly }], [refused, Count::default()]];
    let table = text(&told(1000, 1, vec![curve], vec![map([false; 2], counts)]));
    let words = |name: &str| -> Vec<&str> {
        let line = table.lines().find_map(|line| line.trim_start().strip_prefix(name));
        line.unwrap_or_else(|| panic!("{name} has no line in {table}")).split_whitespace().collect()
    };
    assert!(words("right").ends_with(&["0"]), "{table}");
    assert!(words("sometimes-wrong").ends_with(&["50", "%"]), "{table}");
    assert_eq!(words("refuses-all"), ["refused", "–", "refused", "refused", "–"]);
    assert_eq!(words("never-asked"), ["–"; 5]);
    assert_eq!(words("first row"), ["0*", "12.5", "%*"]);
    assert_eq!(words("second row"), ["refused", "–"]);
    assert!(table.contains("\n  * of those that were answered; others were refused\n"), "{table}");
    let whole = text(&told(1000, 1, Vec::new(), vec![map([false; 2], [[RIGHT, COUNT], [refused, RIGHT]])]));
    assert!(whole.contains("others were refused"), "a part of {COUNT:?} is");
    let whole = text(&told(1000, 1, Vec::new(), vec![map([false; 2], [[RIGHT; 2], [refused, RIGHT]])]));
    assert!(!whole.contains("others were refused"), "none was refused in part");
}
