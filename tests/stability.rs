//! Do the maps of where methods break show the breakdowns that are known, and nothing where there is nothing?

use contract::Size;
use optimized::{Level, Plan};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use verify::advice::advice;
use verify::chart::{Chart, Point, View};
use verify::methods::{Family, Method, swept};
use verify::report::Environment;
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::{count, seed};
use verify::stability::breakdown::breakdown;
use verify::stability::data::Count;
use verify::stability::measure::Named;
use verify::stability::{Asked, SCHEMA_VERSION, Stability, stability, steps};

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
        let (seed, rays) = (seed(), count("CGT_STABILITY_RAYS", 24_576));
        eprintln!("CGT_SEED={seed}, {rays} rays at each value");
        let methods = |cells| swept(cells, Level::best().expect("a level"), &mut Vec::new());
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
    for map in ["grids", "packets"] {
        let map = found.map(map).expect("it was measured");
        let exact = map
            .rows
            .iter()
            .zip(&map.counts)
            .filter(|(name, _)| map.name == "packets" || name.contains("exact"));
        assert!(
            exact.clone().count() == 1 && exact.flat_map(|(_, row)| row).all(|c| c.rays > 0 && c.wrong == 0)
        );
    }
}

/// As FACTS of this project were measured before: the textbook form by a thousand radii, the perpendicular one a hundred times later.
#[test]
fn rounding_breaks_where_it_is_known_to() {
    let found = all();
    let at = |method, radii| rate(found, "distance", method, radii);
    assert!((1e-3..0.1).contains(&at("naive-f32-textbook", 1000.0)), "{}", at("naive-f32-textbook", 1000.0));
    assert!(at("naive-f32-textbook", 1e4) > 0.2);
    // By a third, where it begins; at 1,000 radii by too little for so few rays.
    let early = |method| [177.8279, 316.2278, 562.3413].map(|radii| at(method, radii)).iter().sum::<f64>();
    let (spu, textbook) = (early("safe-spu-textbook"), early("naive-f32-textbook"));
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
    let (one, again) = (run(&methods, 2048, 5, &[]), run(&methods, 2048, 5, &[]));
    let lines = |found: &Stability| serde_json::to_string(&found.curves).expect("JSON");
    assert_eq!(lines(&one), lines(&again));
    assert_ne!(lines(&one), lines(&run(&methods, 2048, 6, &[])));
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
    assert!(verify::stability::page::page(&blind).expect("filled in").contains(": not measured</title>"));
    assert!(!verify::stability::page::page(&found).expect("filled in").contains(": not measured</title>"));
}
