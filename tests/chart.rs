//! Does the chart of speed against error show what the judge finds, of every method, from every distance? No time is asserted.

use contract::{Camera, Image, Scene, Size};
use optimized::{Level, Plan};
use reference::{Arithmetic, Tracer};
use std::time::Duration;
use verify::ablation::data::BaseRows;
use verify::ablation::model::{Without, model, steps};
use verify::ablation::{Ablation, Row, ablate, told};
use verify::bench::contestant::{Contestant, Frame, Kind, Layers, Oath};
use verify::bench::ours::picked;
use verify::chart::page::page;
use verify::chart::text::text;
use verify::chart::{Asked, Chart, Distance, Point, SCHEMA_VERSION, View, measure};
use verify::judge::compare::compare;
use verify::methods::{Family, Method, charted};
use verify::report::Environment;
use verify::scenes::catalogue::Source;
use verify::scenes::frame::{Framing, in_view};
use verify::scenes::read::Loaded;
use verify::spu::feature::Feature;
use verify::spu::predict::Policy;
use verify::spu::survey::{Input, survey};
use verify::subject::SubjectError;
use verify::verdict::{Comparison, UlpSummary};

fn loaded() -> Loaded {
    Source::parse("uniform:60:1").and_then(|source| source.load()).expect("generated")
}

fn at(loaded: &Loaded, times: f64) -> Distance {
    let size = Size::new(50, 37).expect("a size");
    Distance::new(&loaded.animation, &Framing { size: Some(size), ..Framing::default() }, times)
        .expect("a camera")
}

fn silent(_: &str, _: u32) -> Box<dyn Fn() + Sync> {
    Box::new(|| ())
}

fn view(methods: &[Method], times: f64) -> View {
    let loaded = loaded();
    let scene = &loaded.animation.frames()[0];
    let asked = Asked { name: "sixty", frame: 0, scene, methods, rounds: 1, every: 3, seed: 1 };
    measure(&asked, &at(&loaded, times), &silent).expect("small")
}

fn environment() -> Environment {
    Environment {
        program: "cgt".into(),
        target: "any".into(),
        cpu: None,
        simd: "scalar".into(),
        rustc: "rustc".into(),
        threads: 1,
        date: "2026-01-01".into(),
        command_line: "cgt chart <here>".into(),
        seed: Some(1),
    }
}

fn chart(views: Vec<View>) -> Chart {
    Chart {
        schema_version: SCHEMA_VERSION,
        kind: "chart",
        environment: environment(),
        absent: Vec::new(),
        views,
    }
}

#[test]
fn every_method_is_held_against_the_exact_picture() {
    let mut absent = Vec::new();
    let methods = charted(Level::best().expect("a level"), 1, &mut absent);
    let near = view(&methods, 1.0);
    assert_eq!(near.points.len(), methods.len());
    for point in &near.points {
        let comparison =
            point.comparison.as_ref().unwrap_or_else(|| panic!("{}: {:?}", point.method, point.remark));
        assert_eq!((comparison.pixels, comparison.hits), (50 * 37, near.hits), "{}", point.method);
        assert!(point.ns_per_ray.is_some_and(|ns| ns > 0.0), "{} was not timed", point.method);
        assert_eq!(
            point.spu_cycles_per_ray.is_some(),
            ["safe", "safe-textbook", "paper"].contains(&point.method.as_str())
        );
    }
    // A method's counts are those of its own picture.
    let loaded = loaded();
    let (scene, camera) = (&loaded.animation.frames()[0], at(&loaded, 300.0).camera);
    let render = |arithmetic| Tracer::new(arithmetic).render(scene, &camera).expect("small").image;
    let expected = compare(&render(Arithmetic::Exact), &render(Arithmetic::F32Textbook)).expect("one size");
    let far = view(&methods, 300.0);
    // The angle of view shrinks with the distance, or hardly a pixel would hit.
    assert!(
        far.hits * 10 > near.hits * 6 && far.hits * 6 < near.hits * 10,
        "{} and {} pixels hit",
        near.hits,
        far.hits
    );
    let textbook = far.points.iter().find(|p| p.method == "naive-f32-textbook").expect("it takes part");
    assert_eq!(textbook.comparison.as_ref(), Some(&expected));
    assert!(expected.wrong_ids > 0, "nothing is wrong so far away: nothing was at stake");
    // Who rounds is not reproached for it when it is timed.
    for point in &far.points {
        assert!(point.ns_per_ray.is_some(), "{} was not timed: {:?}", point.method, point.remark);
    }
    // The same form by a grid gives the same picture.
    let safe = far.points.iter().find(|p| p.method == "safe-textbook").expect("it takes part");
    assert_eq!(safe.comparison, textbook.comparison);
    let chart = chart(vec![near, far]);
    assert_eq!(chart.broken_promises(), Vec::<String>::new());
    eprintln!("judged {} methods at 2 distances, {} absent", methods.len(), absent.len());
}

#[test]
fn who_promises_the_truth_and_is_wrong_is_named() {
    let level = Level::best().expect("a level");
    let liar = Method::grid("liar", Family::Exact, |_| Plan::paper(), level, 1);
    let rounded = Method::grid("rounded", Family::Perpendicular, |_| Plan::safe(), level, 1);
    let broken = chart(vec![view(&[liar, rounded], 1.0)]).broken_promises();
    assert!(broken.len() == 1 && broken[0].contains("liar") && broken[0].contains("wrong ids"), "{broken:?}");
}

/// Shows the exact picture, of a frame that it has been shown with another colour later on, and says what time it took: 1 ms to build of 4.
struct Scripted {
    scene: Scene,
    image: Image,
    moved: Image,
    frames: usize,
    sound: usize,
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
        if self.frames == self.sound {
            self.image.rgba[0][0] ^= 1;
        }
        self.frames += 1;
        let Image { ids, t, rgba, .. } = if *scene == self.scene {
            &self.image
        } else {
            self.moved = Tracer::new(Arithmetic::Exact).render(scene, camera)?.image;
            &self.moved
        };
        let [build, took] = [1, 4].map(Duration::from_millis);
        Ok(Frame { build, took: Some(took), layers: Layers { ids, t, rgba: Some(rgba) } })
    }
}

fn scripted(name: &str, family: Family, sound: usize) -> Method {
    Method::made(name, family, move |scene, camera| {
        let image = Tracer::new(Arithmetic::Exact).render(scene, camera)?.image;
        Ok(Box::new(Scripted { scene: scene.clone(), moved: image.clone(), image, frames: 0, sound }))
    })
}

/// A frame's time is all of it. Whose picture is another one after the rounds has no time, and has broken its promise.
#[test]
fn a_time_is_that_of_whole_frames_and_of_who_stays_right() {
    let methods = [
        scripted("steady", Family::Exact, usize::MAX),
        scripted("fickle", Family::Exact, 1),
        scripted("fickle and unsworn", Family::Foreign, 1),
    ];
    let view = view(&methods, 1.0);
    let [steady, fickle, unsworn] = &view.points[..] else { panic!("{} points", view.points.len()) };
    let (found, expected) = (steady.ns_per_ray.expect("it was timed"), 4e6 / (50.0 * 37.0));
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} ns a ray of {expected}");
    for fickle in [fickle, unsworn] {
        assert_eq!(fickle.ns_per_ray, None, "{}", fickle.method);
        assert_eq!(fickle.comparison.as_ref().map(|c| c.wrong_color), Some(1), "{}", fickle.method);
        assert!(
            fickle.remark.as_ref().is_some_and(|remark| remark.contains("another picture")),
            "{fickle:?}"
        );
    }
    let broken = chart(vec![view]).broken_promises();
    assert!(
        broken.len() == 1 && broken[0].contains("fickle") && broken[0].contains("1 colours"),
        "{broken:?}"
    );
}

/// Each number another, so that none can stand for another.
fn comparison() -> Comparison {
    Comparison {
        pixels: 1001,
        hits: 502,
        wrong_ids: 33,
        missing: 10,
        extra: 11,
        swapped: 12,
        wrong_t: 44,
        t_ulp: UlpSummary { count: 400, median: 5, p99: 66, max: 777 },
        wrong_color: 88,
        color_max: 99,
        first_wrong: None,
        unexplained: 0,
        undecidable: 0,
    }
}

fn point(method: &str, ns: Option<f64>) -> Point {
    Point {
        method: method.into(),
        family: Family::Foreign,
        exact: false,
        description: String::new(),
        ns_per_ray: ns,
        spu_cycles_per_ray: None,
        comparison: None,
        paints: true,
        remark: None,
    }
}

fn seen(points: Vec<Point>) -> View {
    View {
        scene: "made up".into(),
        frame: 3,
        spheres: 60,
        size: [50, 37],
        times_as_far: 10.0,
        radii: 123.5,
        hits: 502,
        rounds: 2,
        points,
    }
}

/// Whoever promised the truth keeps it only by a picture in which something was compared and all is right.
#[test]
fn a_promise_is_broken_by_any_layer_by_no_picture_and_by_nothing_compared() {
    let right = Comparison { pixels: 1001, hits: 502, ..Comparison::default() };
    for (what, comparison, broken) in [
        ("all right", Some(right.clone()), 0),
        ("an id", Some(Comparison { wrong_ids: 1, ..right.clone() }), 1),
        ("a t", Some(Comparison { wrong_t: 1, ..right.clone() }), 1),
        ("a colour", Some(Comparison { wrong_color: 1, ..right.clone() }), 1),
        ("nothing compared", Some(Comparison::default()), 1),
        ("no picture", None, 1),
    ] {
        let exact = Point { exact: true, comparison: comparison.clone(), ..point("sworn", None) };
        let other = Point { comparison, ..point("unsworn", None) };
        let found = chart(vec![seen(vec![exact, other])]).broken_promises();
        assert_eq!(found.len(), broken, "{what}: {found:?}");
        assert!(found.iter().all(|line| line.contains(", sworn: ")), "{what}: {found:?}");
    }
}

#[test]
fn the_table_has_each_number_under_its_heading() {
    let full = Point {
        ns_per_ray: Some(4.25),
        spu_cycles_per_ray: Some([7.5, 9.5]),
        comparison: Some(comparison()),
        ..point("own", None)
    };
    let unpainted = Point { paints: false, ..full.clone() };
    let csv = chart(vec![seen(vec![full, unpainted, point("silent", None)])]).csv().expect("in memory");
    let csv = String::from_utf8(csv).expect("text");
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let expected = [
        ("scene", "made up"),
        ("frame", "3"),
        ("spheres", "60"),
        ("width", "50"),
        ("height", "37"),
        ("times_as_far", "10"),
        ("radii", "123.5"),
        ("method", "own"),
        ("family", "foreign"),
        ("ns_per_ray", "4.25"),
        ("spu_cycles_least", "7.5"),
        ("spu_cycles_most", "9.5"),
        ("pixels", "1001"),
        ("hits", "502"),
        ("wrong_ids", "33"),
        ("wrong_t", "44"),
        ("t_ulp_median", "5"),
        ("t_ulp_p99", "66"),
        ("t_ulp_max", "777"),
        ("wrong_colours", "88"),
        ("colour_max", "99"),
    ];
    let told = |row: usize| rows[0].iter().copied().zip(rows[row].iter().copied()).collect::<Vec<_>>();
    assert_eq!(told(1), expected);
    // Who paints no colours has none wrong, and who gave no picture has no number.
    let colours = |heading: &str| heading.contains("colour");
    let bare = expected.map(|(heading, cell)| (heading, if colours(heading) { "" } else { cell }));
    assert_eq!(told(2), bare);
    assert!(told(3)[9..].iter().all(|(_, cell)| cell.is_empty()), "{:?}", told(3));
}

/// Who paints no colours has none wrong there either, and who gave no picture has no number.
#[test]
fn page_and_terminal_have_each_number_under_its_heading() {
    let full = Point {
        ns_per_ray: Some(4.25),
        spu_cycles_per_ray: Some([7.5, 9.5]),
        comparison: Some(comparison()),
        ..point("own", None)
    };
    let unpainted = Point { method: "bare".into(), paints: false, ..full.clone() };
    let chart = chart(vec![seen(vec![full, unpainted, point("silent", None)])]);
    let page = page(&chart).expect("filled in");
    let word = |cell: &str| cell.split(['>', '<']).nth(1).unwrap_or_default().to_owned();
    let head = page.lines().find(|line| line.starts_with("<thead>")).expect("a table");
    let headings: Vec<String> = head.split("<th scope=\"col\"").skip(2).map(word).collect();
    let cells = |method: &str| -> Vec<String> {
        let row = page.lines().find(|line| line.contains(&format!("<th scope=\"row\">{method}</th>")));
        row.unwrap_or_else(|| panic!("{method} has no row: {page}")).split("<td").skip(1).map(word).collect()
    };
    // 33 of 1,001 pixels are wrong.
    let expected = [
        ("ns a ray", "4.25"),
        ("SPU cycles a ray", "7.50–9.50"),
        ("wrong pixels", "33"),
        ("in a million", "32967"),
        ("wrong t", "44"),
        ("ulp of t, median", "5"),
        ("99 %", "66"),
        ("most", "777"),
        ("wrong colours", "88"),
        ("by at most", "99"),
        ("on the front", "yes"),
    ];
    assert_eq!(headings, expected.map(|(heading, _)| heading));
    assert_eq!(cells("own"), expected.map(|(_, cell)| cell));
    let bare = expected.map(|(heading, cell)| match heading {
        "wrong colours" | "by at most" => "–",
        _ => cell,
    });
    assert_eq!(cells("bare"), bare);
    assert_eq!(cells("silent"), ["–", "–", "–", "–", "–", "–", "–", "–", "–", "–", ""]);

    let table = text(&chart);
    let line = |start: &str| {
        let line = table.lines().find(|line| line.trim_start().starts_with(start));
        let words: Vec<&str> = line.unwrap_or_else(|| panic!("{table}")).split_whitespace().collect();
        words.join(" ")
    };
    assert_eq!(line("method"), "method ns a ray SPU cycles wrong ids ulp of t at most colours");
    assert_eq!(line("own"), "own 4.25 7.50-9.50 33 66 777 88");
    assert_eq!(line("bare"), "bare 4.25 7.50-9.50 33 66 777 –");
    assert_eq!(line("silent"), "silent – – – – – –");
}

/// Of two that are right the quicker one is named as the fastest. In the picture it stands lower, at the height of its time, and who is
/// wrong to the right.
#[test]
fn the_fastest_of_those_that_are_right_is_named_and_stands_lowest() {
    let right = Comparison { pixels: 1001, hits: 502, ..Comparison::default() };
    let dot = |method: &str, ns: f64, comparison: &Comparison| Point {
        family: Family::Exact,
        comparison: Some(comparison.clone()),
        ..point(method, Some(ns))
    };
    let points = vec![dot("slow", 9.0, &right), dot("quick", 1.0, &right), dot("rash", 2.0, &comparison())];
    let page = page(&chart(vec![seen(points)])).expect("filled in");
    let said =
        "2 of 3 methods show the right sphere in every pixel; of these quick is the fastest, 1.00 ns a ray.";
    assert!(page.contains(said), "{page}");
    let svg = &page[page.find("time a ray against wrong pixels").expect("its chart")..];
    let svg = &svg[..svg.find("</svg>").expect("an end")];
    let number = |text: &str, name: &str| -> f64 {
        let from = text.find(&format!(" {name}=\"")).expect(name) + name.len() + 3;
        text[from..].split('"').next().and_then(|number| number.parse().ok()).expect("a number")
    };
    let place = |method: &str| {
        let dot = &svg[svg.find(&format!("<title>{method}: ")).expect(method)..];
        ["cx", "cy"].map(|name| number(dot, name))
    };
    let [slow, quick, rash] = ["slow", "quick", "rash"].map(place);
    assert!(quick[1] > rash[1] && rash[1] > slow[1], "lower is faster: {quick:?}, {rash:?}, {slow:?}");
    assert!(rash[0] > quick[0] && (quick[0] - slow[0]).abs() < 0.1, "{quick:?}, {rash:?}, {slow:?}");
    // The axes say the same: each label with the place of its middle.
    let labels = |anchor: &str, name: &str| -> Vec<(String, f64)> {
        let all = svg.split("<text ").filter(|text| text.starts_with(&format!("text-anchor=\"{anchor}\"")));
        let label = |text: &str| text.split(['>', '<']).nth(1).unwrap_or_default().to_owned();
        all.map(|text| (label(text), number(text, name))).collect()
    };
    let of = |labels: &[(String, f64)], word: &str| {
        labels.iter().find(|(label, _)| label == word).unwrap_or_else(|| panic!("{word}: {labels:?}")).1
    };
    let (times, errors) = (labels("end", "y"), labels("middle", "x"));
    let near = |dot: f64, label: f64| (dot - label).abs() < 6.0;
    assert!(near(quick[1], of(&times, "1")) && near(rash[1], of(&times, "2")), "{quick:?}, {times:?}");
    assert!(of(&times, "5") > slow[1] && of(&times, "10") < slow[1], "{slow:?}, {times:?}");
    assert!(near(quick[0], of(&errors, "0")), "{quick:?}, {errors:?}");
    assert!(of(&errors, "10⁴") < rash[0] && rash[0] < of(&errors, "10⁵"), "{rash:?}, {errors:?}");
}

#[test]
fn data_and_page_have_every_point() {
    let level = Level::best().expect("a level");
    let methods = [
        Method::grid("exact & quick", Family::Exact, |_| Plan::fast(), level, 1),
        Method::grid("rounded", Family::Perpendicular, |_| Plan::safe(), level, 1),
    ];
    let chart = chart(vec![view(&methods, 1.0), view(&methods, 10.0)]);
    let csv = String::from_utf8(chart.csv().expect("in memory")).expect("text");
    assert_eq!(csv.lines().count(), 1 + 2 * methods.len(), "{csv}");
    let fields = csv.lines().map(|line| line.split(',').count()).collect::<Vec<_>>();
    assert!(fields.iter().all(|count| *count == fields[0]), "{csv}");
    let page = page(&chart).expect("filled in");
    for word in ["exact &#38; quick", "rounded", "radii away", "<svg", "Every number"] {
        assert!(page.contains(word), "{word} is not on the page");
    }
    assert!(!page.contains("exact & quick"), "text stands on the page as HTML");
    assert!(!page.contains("http://") && !page.contains("<script"), "the page needs more than itself");
}

#[test]
fn an_ablation_changes_one_thing_at_a_time() {
    let loaded = loaded();
    let level = Level::best().expect("a level");
    let scene = &loaded.animation.frames()[0];
    let found = ablate(("sixty", 0, scene), &at(&loaded, 1.0), (level, 1, 1, 4), 1, &silent).expect("small");
    assert!(found.chosen_by_best.is_some_and(|ratio| ratio > 0.0) && found.best_picked.is_some());
    for base in &found.bases {
        assert!(base.ns_per_ray.is_some() && !base.rows.is_empty(), "{}", base.name);
        assert_eq!(
            base.cycles_per_ray.is_some(),
            ["safe", "paper"].contains(&base.name.as_str()),
            "{}",
            base.name
        );
        for row in &base.rows {
            assert!(
                row.remark.is_none() && row.time.is_some(),
                "{}, {}: {:?}",
                base.name,
                row.choice,
                row.remark
            );
        }
        // What is exact stays so, whatever else is changed, but for its arithmetic.
        if base.name.starts_with("fast") {
            let exact =
                base.rows.iter().filter(|row| !["arithmetic", "margins"].contains(&row.concern.as_str()));
            assert!(base.wrong == Some(0) && exact.clone().all(|row| row.wrong == Some(0)), "{base:?}");
        }
    }
    let kept =
        |base: &BaseRows| base.rows.iter().filter_map(|row| row.kept).chain(base.kept).collect::<Vec<_>>();
    let kept = found.bases.iter().flat_map(kept).collect::<Vec<_>>();
    assert!(
        kept.len() > 25 && kept.iter().all(|kept| *kept),
        "of {} plans that promise the truth one is wrong",
        kept.len()
    );
    let mut ablation = Ablation {
        schema_version: 1,
        kind: "ablation",
        environment: environment(),
        scenes: vec![found.clone()],
        model: Vec::new(),
    };
    assert_eq!(ablation.broken_promises(), Vec::<String>::new());
    ablation.scenes[0].bases[1].rows[2].kept = Some(false);
    assert_eq!(ablation.broken_promises().len(), 1);
    let paper = found.bases.iter().find(|base| base.name == "paper").expect("it is a base");
    let mended = |choice: &str| paper.rows.iter().find(|row| row.choice == choice).and_then(|row| row.wrong);
    assert!(paper.wrong > Some(0), "nothing was to be mended: {paper:?}");
    for choice in ["lists", "box range"] {
        assert!(mended(choice).is_some_and(|wrong| Some(wrong) <= paper.wrong), "{choice}: {paper:?}");
    }
}

/// Ratios and promises of a view that is made up.
#[test]
fn an_ablation_divides_by_its_base_and_the_best_is_the_fastest() {
    let loaded = loaded();
    let scene = &loaded.animation.frames()[0];
    let right = Comparison { pixels: 1850, hits: 502, ..Comparison::default() };
    let pictured = |name: &str, ns: f64, comparison| Point {
        spu_cycles_per_ray: Some([ns, 8.0 * ns]),
        comparison: Some(comparison),
        ..point(name, Some(ns))
    };
    let names: Vec<String> = picked(scene).into_iter().map(|(name, _)| name).collect();
    let view = seen(vec![
        pictured("fast-blocks", 5.0, right.clone()),
        pictured("fast-blocks, voxelizer: box range", 10.0, right.clone()),
        pictured("fast-blocks, voxelizer: exact overlap", 2.5, Comparison { wrong_t: 1, ..right.clone() }),
        Point { remark: Some("Did not begin.".into()), ..point("fast-blocks, grid: 4 cells", None) },
        pictured("fast-blocks, arithmetic: textbook f32", 5.0, comparison()),
        pictured("for_scene", 4.5, right.clone()),
        pictured(&names[1], 30.0, right.clone()),
        pictured(&names[2], 3.0, right.clone()),
        point(&names[3], None),
    ]);
    let found = told(scene, &view);
    assert_eq!((found.best_picked.as_ref(), found.chosen_by_best), (Some(&names[2]), Some(1.5)));
    let base = &found.bases[1];
    assert_eq!(
        (base.name.as_str(), base.ns_per_ray, base.wrong, base.kept),
        ("fast-blocks", Some(5.0), Some(0), Some(true))
    );
    let row = |choice: &str| {
        let row = base.rows.iter().find(|row| row.choice == choice);
        let Row { time, cycles, wrong, kept, .. } = row.unwrap_or_else(|| panic!("{choice} is no variant"));
        (*time, *cycles, *wrong, *kept)
    };
    assert_eq!(row("box range"), (Some(2.0), Some(2.0), Some(0), Some(true)));
    assert_eq!(row("exact overlap"), (Some(0.5), Some(0.5), Some(0), Some(false)));
    assert_eq!(row("4 cells"), (None, None, None, Some(false)), "who gives no picture keeps nothing");
    assert_eq!(row("textbook f32"), (Some(1.0), Some(1.0), Some(33), None), "it promises no truth");
    let scenes = vec![found];
    let ablation = Ablation {
        schema_version: 1,
        kind: "ablation",
        environment: environment(),
        scenes,
        model: Vec::new(),
    };
    let csv = String::from_utf8(ablation.csv().expect("in memory")).expect("text");
    let line =
        |start: &str| csv.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("{csv}"));
    assert_eq!(line("scene,"), "scene,base,concern,choice,times_the_time,times_the_cycles,wrong_ids");
    assert_eq!(
        line("made up,fast-blocks,arithmetic,textbook f32,"),
        "made up,fast-blocks,arithmetic,textbook f32,1,1,33"
    );
    assert_eq!(
        line("made up,fast-blocks,voxelizer,exact overlap,"),
        "made up,fast-blocks,voxelizer,exact overlap,0.5,0.5,0"
    );
    assert_eq!(line("made up,fast-blocks,grid,4 cells,"), "made up,fast-blocks,grid,4 cells,,,");
}

#[test]
fn from_farther_away_the_scene_stays_in_view() {
    let loaded = loaded();
    let spheres = loaded.animation.frames()[0].spheres();
    for times in [1.0, 10.0, 1000.0] {
        let far = at(&loaded, times);
        let seen = spheres.iter().filter(|sphere| in_view(&far.camera, sphere)).count();
        assert!(
            seen >= spheres.len() * 9 / 10,
            "{times} times as far {seen} of {} are in view",
            spheres.len()
        );
        let ratio = far.radii / at(&loaded, 1.0).radii;
        assert!((ratio / times - 1.0).abs() < 1e-6, "{times} times as far is {ratio} times as many radii");
        // What is said of the distance is the camera's.
        let eye = far.camera.eye().map(f64::from);
        let length = eye.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut radii: Vec<f32> = spheres.iter().map(|sphere| sphere.radius).collect();
        radii.sort_by(f32::total_cmp);
        let own = length / f64::from(radii[radii.len() / 2]);
        assert!(
            (0.5..2.0).contains(&(own / far.radii)),
            "{own} radii from the origin, {} are told",
            far.radii
        );
    }
}

/// Cycles of a ray are those of the frame on six SPUs, as a survey of it has them.
#[test]
fn cycles_are_those_of_the_survey() {
    let (loaded, paper) = (loaded(), Plan::paper());
    let (scene, far) = (&loaded.animation.frames()[0], at(&loaded, 1.0));
    let method = Method::grid("paper", Family::Paper, move |_| paper, Level::SCALAR, 1).with_spu(paper);
    let asked = Asked { name: "sixty", frame: 0, scene, methods: &[method], rounds: 1, every: 1, seed: 1 };
    let view = measure(&asked, &far, &silent).expect("small");
    let input =
        Input { name: "sixty", frame: 0, scene, camera: &far.camera, plan: paper, every: 1, unlimited: true };
    let survey = survey(&input, &|| ()).expect("the model has such packets");
    let expected =
        survey.rates[Policy::Hinted as usize].frame_cycles.map(|cycles| cycles * 6.0 / (50.0 * 37.0));
    let found = view.points[0].spu_cycles_per_ray.expect("the model ran");
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} cycles a ray, the survey has {expected}");
    }
}

/// Without a cost a frame is faster, without the second pipe slower, and none of it is left behind.
#[test]
fn the_model_is_told_without_each_feature() {
    let (loaded, plan) = (loaded(), Plan::paper());
    let (scene, far) = (&loaded.animation.frames()[0], at(&loaded, 1.0));
    let input =
        Input { name: "sixty", frame: 0, scene, camera: &far.camera, plan, every: 1, unlimited: true };
    let ticks = std::cell::Cell::new(0);
    let rows = model(&[input], 1, &|| ticks.set(ticks.get() + 1)).expect("the model has such packets");
    assert_eq!((ticks.get(), rows.len()), (steps(1), 1 + Feature::ALL.len()));
    let rate = |row: &Without| row.frames_per_second[0].1;
    let whole = rate(&rows[0]);
    assert!(rows[0].feature.is_none() && rows[0].changed.is_empty());
    for row in &rows[1..] {
        let (feature, [least, most]) = (row.feature.expect("all but the first"), rate(row));
        match feature {
            Feature::DualIssue => {
                assert!(most < whole[1], "{feature:?}: {most} frames a second, whole {whole:?}");
            }
            Feature::Latencies => {
                assert!(least > whole[0] && most.to_bits() == whole[1].to_bits(), "{feature:?}");
            }
            _ => assert!(
                least > whole[0] && most >= whole[1],
                "{feature:?}: {least} to {most}, whole {whole:?}"
            ),
        }
    }
    let again = survey(&input, &|| ()).expect("as before").rates[Policy::Hinted as usize].frames_per_second;
    assert_eq!(again.map(f64::to_bits), whole.map(f64::to_bits), "a feature stays left out");
}
