//! Does `cgt bench` say what it measured, time nobody who is wrong, and end with the right code? No time is ever asserted.

use contract::{Camera, DEFAULT_LIGHT, Image, MISS, Scene, Sphere};
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};
use std::sync::mpsc::channel;
use std::time::Duration;
use tempfile::TempDir;
use verify::bench::baseline::{BaselineError, Step, compare};
use verify::bench::check::{Checked, check};
use verify::bench::contestant::{Contestant, Frame, Kind, Layers, Oath};
use verify::bench::data::{Curve, Growth, Point, SCHEMA_VERSION, Truth};
use verify::bench::rounds::Timing;
use verify::bench::scene::race;
use verify::bench::spread::Spread;
use verify::bench::text::{sentences, text};
use verify::bench::{Bench, Effort, Input, Row, SceneBench, Summary, page};
use verify::report::{Absent, Environment};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::subject::{Rounding, SubjectError};
use verify::verdict::Verdict;

/// Quick, and not whole blocks or packets at the right and lower edges.
const QUICK: [&str; 6] = ["--size", "70x37", "--rounds", "2", "--threads", "1"];

fn bench(desk: &TempDir, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cgt"));
    command.arg("bench").args(words).args(QUICK).current_dir(desk.path());
    command.output().expect("the program starts")
}

fn desk() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

fn code(output: &Output) -> i32 {
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!said.contains("panicked"), "{said}");
    output.status.code().unwrap_or_else(|| panic!("ended by {}", output.status))
}

fn json(file: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(file).expect("it is there")).expect("it is JSON")
}

fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value[name].as_array().unwrap_or_else(|| panic!("{name} is a list"))
}

fn median(row: &Value) -> Option<f64> {
    row["timing"]["total"]["median"].as_f64()
}

/// The fastest of a kind, of those that were timed in rounds.
fn fastest(scene: &Value, kind: &str) -> Option<f64> {
    let rows = list(scene, "contestants").iter().filter(|row| row["kind"] == kind && row["remark"].is_null());
    rows.filter_map(median).reduce(f64::min)
}

fn close(what: &str, found: Option<f64>, expected: Option<f64>) {
    match (found, expected) {
        (None, None) => {}
        (Some(x), Some(y)) if (x - y).abs() <= 1e-9 * y.abs() => {}
        _ => panic!("{what} is {found:?}, and by the numbers beside it {expected:?}"),
    }
}

/// What must hold of the numbers of any scene.
fn consistent(scene: &Value) {
    let pixels = scene["width"].as_f64().expect("a width") * scene["height"].as_f64().expect("a height");
    let subject = fastest(scene, "subject");
    let ratio = |x: Option<f64>, y: Option<f64>| Some(x? / y?);
    close(
        "the ratio to the limit",
        scene["ratio_to_limit"].as_f64(),
        ratio(subject, fastest(scene, "limit")),
    );
    let embree = fastest(scene, "embree");
    close("the ratio to Embree", scene["ratio_to_embree"].as_f64(), ratio(embree, subject));
    assert_eq!(scene["embree_best"].is_string(), embree.is_some(), "the best of Embree is named");
    let picked = fastest(scene, "picked");
    close("the ratio to picked plans", scene["ratio_to_picked"].as_f64(), ratio(subject, picked));
    assert_eq!(scene["picked_best"].is_string(), picked.is_some(), "the best plan is named");
    for row in list(scene, "contestants") {
        let name = &row["name"];
        close(
            "Mray/s",
            row["mega_rays_per_second"].as_f64(),
            median(row).map(|seconds| pixels / seconds / 1e6),
        );
        if row["timing"].is_null() {
            assert!(row["remark"].is_string(), "{name} was not timed, and it is not said why");
            continue;
        }
        for part in ["build", "trace", "total"] {
            let at = |name: &str| row["timing"][part][name].as_f64().expect("a number");
            let order = ["least", "lower_quartile", "median", "upper_quartile", "most"].map(at);
            assert!(order.is_sorted(), "{name}, {part}: {order:?}");
            assert!(order[0] >= 0.0, "{name}, {part}: {order:?}");
        }
        assert!(row["timing"]["frames"].as_u64() > Some(0), "{name}: no frame");
        assert_ne!(row["verdict"], "Wrong", "{name} is wrong and was timed");
    }
}

#[test]
fn numbers_agree_with_each_other_and_files_are_whole() {
    let desk = desk();
    let output = bench(&desk, &["2juy", "uniform:300:1", "--json", "b.json", "--out", "folder"]);
    assert_eq!(code(&output), 0, "{output:?}");
    let bench = json(&desk.path().join("b.json"));
    assert_eq!(bench, json(&desk.path().join("folder/bench.json")));
    assert_eq!(
        (&bench["schema_version"], &bench["kind"], &bench["plan"]),
        (&2.into(), &"bench".into(), &"fast".into())
    );
    for field in ["program", "target", "simd", "rustc", "date", "command_line"] {
        assert!(bench["environment"][field].as_str().is_some_and(|text| !text.is_empty()), "{field}");
    }
    assert!(bench["environment"]["seed"].is_u64());
    let scenes = list(&bench, "scenes");
    assert_eq!(scenes.len(), 2);
    for scene in scenes {
        consistent(scene);
        let timed = |kind| fastest(scene, kind).is_some();
        assert!(timed("subject") && timed("limit"), "{scene}");
        assert_eq!(scene["rounds"], 2, "other rounds than were asked for: {scene}");
        assert_eq!(
            (&scene["width"], &scene["height"], &scene["threads"]),
            (&70.into(), &37.into(), &1.into())
        );
        let subject = &list(scene, "contestants")[0];
        assert_eq!((&subject["verdict"], &subject["differing"]), (&"Equal".into(), &0.into()));
    }
    let ratios: Vec<f64> = scenes.iter().filter_map(|scene| scene["ratio_to_limit"].as_f64()).collect();
    let summary = &bench["summary"];
    close("the mean", summary["ratio_to_limit_mean"].as_f64(), Some((ratios[0] * ratios[1]).sqrt()));
    close("the most", summary["ratio_to_limit_most"].as_f64(), ratios.into_iter().reduce(f64::max));
    let page = std::fs::read_to_string(desk.path().join("folder/bench.html")).expect("a page");
    assert!(page.ends_with("</html>\n") || page.ends_with("</html>"), "the page is whole");
    for outside in ["http:", "https:", "src=", "@import", "url("] {
        assert!(!page.contains(outside), "the page asks for {outside}");
    }
    let table = String::from_utf8(output.stdout).expect("text");
    assert!(table.lines().all(|line| line.chars().count() <= 100), "{table}");
    assert!(table.contains("clairvoyant"), "{table}");
}

/// The chosen plan is held against others, each of which gives the exact picture too.
#[test]
fn plans_picked_by_hand_are_timed_beside_the_chosen_one() {
    let desk = desk();
    let output = bench(&desk, &["2juy", "--plans", "--json", "b.json"]);
    assert_eq!(code(&output), 0, "{output:?}");
    let bench = json(&desk.path().join("b.json"));
    let scene = &bench["scenes"][0];
    consistent(scene);
    let picked: Vec<_> = list(scene, "contestants").iter().filter(|row| row["kind"] == "picked").collect();
    assert!(picked.len() >= 10, "{} plans", picked.len());
    let descriptions: std::collections::BTreeSet<_> =
        picked.iter().map(|row| row["description"].to_string()).collect();
    assert_eq!(descriptions.len(), picked.len(), "some plan is there twice");
    for row in picked {
        assert_eq!((&row["verdict"], row["timing"].is_null()), (&"Equal".into(), false), "{row}");
    }
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("the best plan picked by hand"), "{said}");
}

#[test]
fn who_is_wrong_is_not_timed() {
    let desk = desk();
    let output = bench(&desk, &["2juy", "--plan", "paper", "--json", "b.json"]);
    assert_eq!(code(&output), 1, "{output:?}");
    let bench = json(&desk.path().join("b.json"));
    let scene = &bench["scenes"][0];
    let subject = &scene["contestants"][0];
    assert_eq!((&subject["name"], &subject["verdict"]), (&"paper".into(), &"Wrong".into()));
    assert!(subject["wrong"].as_u64() > Some(0) && subject["timing"].is_null(), "{subject}");
    assert!(subject["first_wrong"].is_array() && scene["ratio_to_limit"].is_null(), "{scene}");
    consistent(scene);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("Not timed."), "{said}");
}

/// Who is missing is no verdict, if it was asked for.
#[test]
fn a_missing_tracer_is_told() {
    let desk = desk();
    for (name, built_in) in [
        ("embree", cfg!(feature = "embree")),
        ("bvh", cfg!(feature = "peers")),
        ("parry3d", cfg!(feature = "peers")),
    ] {
        let output = bench(&desk, &["2juy", "--peers", name, "--json", "b.json"]);
        assert_eq!(code(&output), if built_in { 0 } else { 3 }, "{name}: {output:?}");
        let bench = json(&desk.path().join("b.json"));
        let absent = list(&bench, "absent").iter().any(|absent| absent["judge"] == name);
        assert_eq!(absent, !built_in, "{name}");
        consistent(&bench["scenes"][0]);
        let kind = if name == "embree" { "embree" } else { "peer" };
        assert_eq!(fastest(&bench["scenes"][0], kind).is_some(), built_in, "{name} was timed or not");
    }
    assert_eq!(code(&bench(&desk, &["2juy", "--peers", "nosuch"])), 2);
}

#[test]
fn a_baseline_is_held_to() {
    let desk = desk();
    let file = desk.path().join("b.json");
    assert_eq!(code(&bench(&desk, &["2juy", "--json", "b.json"])), 0);
    let honest = json(&file);
    // With or without Embree, what is compared was this much better then.
    let doctored = |factor: f64| {
        let mut bench = honest.clone();
        let scene = &mut bench["scenes"][0];
        let better = |value: &mut Value| {
            if let Some(x) = value.as_f64() {
                *value = (x * factor).into();
            }
        };
        better(&mut scene["ratio_to_embree"]);
        better(&mut scene["contestants"][0]["mega_rays_per_second"]);
        bench.to_string()
    };
    let mut other = honest.clone();
    other["environment"]["cpu"] = "another".into();
    let mut elsewhere = honest.clone();
    elsewhere["scenes"][0]["width"] = 71.into();
    let mut newer = honest.clone();
    newer["schema_version"] = 99.into();
    for (what, text, expected) in [
        ("far better then", doctored(1e6), 4),
        ("far worse then", doctored(1e-6), 0),
        ("another processor", other.to_string(), 2),
        ("another picture", elsewhere.to_string(), 2),
        ("another version", newer.to_string(), 2),
        ("no JSON", "nothing".into(), 2),
    ] {
        std::fs::write(&file, text).expect("written");
        let output = bench(&desk, &["2juy", "--baseline", "b.json"]);
        assert_eq!(code(&output), expected, "{what}: {output:?}");
    }
    assert_eq!(code(&bench(&desk, &["2juy", "--baseline", "nosuch.json"])), 2);
    assert_eq!(code(&bench(&desk, &["2juy", "--tolerance", "100"])), 2);
}

#[test]
fn curves_grow_and_are_checked() {
    let desk = desk();
    let limits = ["--curves", "--most-spheres", "10000", "--most-rows", "180"];
    let output = bench(&desk, &[&["2juy", "--json", "b.json", "--out", "folder"], &limits[..]].concat());
    assert_eq!(code(&output), 0, "{output:?}");
    let bench = json(&desk.path().join("b.json"));
    let curves = list(&bench, "curves");
    let over: Vec<_> = curves.iter().map(|curve| curve["over"].as_str().expect("a word")).collect();
    assert_eq!(over, ["spheres", "pixels", "threads"]);
    let mut grown = 0;
    for curve in curves {
        let points = list(curve, "points");
        assert!(!points.is_empty(), "{curve}");
        let x: Vec<f64> = points.iter().map(|point| point["x"].as_f64().expect("a number")).collect();
        assert!(x.is_sorted_by(|a, b| a < b), "{x:?}");
        for point in points {
            let scene = &point["scene"];
            consistent(scene);
            assert!(fastest(scene, "subject").is_some(), "{scene}");
            let grows = match curve["over"].as_str() {
                Some("spheres") => scene["spheres"].as_f64(),
                Some("threads") => scene["threads"].as_f64(),
                _ => Some(
                    scene["width"].as_f64().expect("a width") * scene["height"].as_f64().expect("a height"),
                ),
            };
            assert_eq!(point["x"].as_f64(), grows);
        }
        // How much something grew is told of the very times that stand at its two points.
        for growth in list(curve, "growth") {
            let [few, many] = [0, 1].map(|end| {
                let point =
                    points.iter().find(|point| point["x"] == growth["between"][end]).expect("a point");
                let timing = &list(&point["scene"], "contestants")[0]["timing"];
                let part = if growth["what"] == "rebuild" { "build" } else { "total" };
                timing[part]["median"].as_f64().expect("the subject was timed")
            });
            let factor = if growth["what"] == "frames a second" { few / many } else { many / few };
            close("a growth", growth["factor"].as_f64(), Some(factor));
            grown += 1;
        }
    }
    // That of building is there on any machine, that of frames a second only on one with several threads.
    assert!(grown > 0, "nothing was told to grow");
    let page = std::fs::read_to_string(desk.path().join("folder/bench.html")).expect("a page");
    assert_eq!(page.matches("<svg class=\"plot\"").count(), 4, "the scenes and three curves");
}

// ---- the check itself ----

fn exact(scene: &Scene, camera: &Camera) -> Image {
    reference::Tracer::new(reference::Arithmetic::Exact).render(scene, camera).expect("it fits").image
}

struct Picture {
    scene: Scene,
    camera: Camera,
    truth: Image,
}

impl Picture {
    fn new() -> Self {
        let loaded = Source::parse("uniform:300:1").and_then(|source| source.load()).expect("it is made");
        let size = contract::Size::new(70, 37).expect("a size");
        let camera = loaded.camera(&Framing { size: Some(size), ..Framing::default() }).expect("a camera");
        let scene = loaded.animation.frames()[0].clone();
        Self { truth: exact(&scene, &camera), scene, camera }
    }

    /// Wrong pixels of an image with or without its colours.
    fn wrong(&self, image: &Image, oath: Oath, colours: bool) -> u64 {
        let layers = Layers { ids: &image.ids, t: &image.t, rgba: colours.then_some(image.rgba.as_slice()) };
        check(&self.scene, &self.camera, &self.truth, layers, oath).wrong
    }
}

#[test]
fn planted_faults_are_wrong() {
    let picture = Picture::new();
    let within = Oath::rounded(Rounding::TextbookF32);
    let seen = picture.truth.ids.iter().position(|&id| id != MISS).expect("something is seen");
    let missed = picture.truth.ids.iter().position(|&id| id == MISS).expect("something is missed");
    assert_eq!(picture.wrong(&picture.truth, Oath::Exact, true), 0);
    assert_eq!(picture.wrong(&picture.truth, within, false), 0);
    type Fault = (&'static str, fn(&mut Image, [usize; 2]), [u64; 3]);
    // Under an oath of truth; within rounding, not painted and painted.
    let faults: [Fault; 8] = [
        ("a lost sphere", |i, [seen, _]| (i.ids[seen], i.t[seen]) = (MISS, f32::INFINITY), [1; 3]),
        ("another sphere", |i, [seen, _]| i.ids[seen] ^= 1, [1; 3]),
        ("a sphere that is not there", |i, [seen, _]| i.ids[seen] = 300, [1; 3]),
        ("a sphere where there is none", |i, [_, missed]| (i.ids[missed], i.t[missed]) = (0, 1.0), [1; 3]),
        ("a miss at a distance", |i, [_, missed]| i.t[missed] = 1.0, [1; 3]),
        // Of t rounding explains the last bits, and nothing explains a colour.
        ("a bit of t", |i, [seen, _]| i.t[seen] = f32::from_bits(i.t[seen].to_bits() ^ 1), [1, 0, 0]),
        ("a colour", |i, [seen, _]| i.rgba[seen][0] ^= 1, [1, 0, 1]),
        ("a background", |i, [_, missed]| i.rgba[missed][2] ^= 1, [1, 0, 1]),
    ];
    for (what, fault, [exact, bare, painted]) in faults {
        let mut image = picture.truth.clone();
        fault(&mut image, [seen, missed]);
        assert_eq!(picture.wrong(&image, Oath::Exact, true), exact, "{what}, exact");
        assert_eq!(picture.wrong(&image, within, false), bare, "{what}, rounded");
        assert_eq!(picture.wrong(&image, within, true), painted, "{what}, rounded and painted");
    }
    let mut short = picture.truth.clone();
    short.t.pop();
    assert_eq!(picture.wrong(&short, Oath::Exact, true), 70 * 37, "a layer is too short");
}

/// The first in the order of rows, told as column and row.
#[test]
fn the_first_wrong_pixel_is_told() {
    let picture = Picture::new();
    let mut image = picture.truth.clone();
    for [x, y] in [[30, 4], [2, 9], [31, 4]] {
        image.rgba[y * 70 + x][0] ^= 1;
    }
    for oath in [Oath::Exact, Oath::rounded(Rounding::TextbookF64)] {
        let layers = Layers { ids: &image.ids, t: &image.t, rgba: Some(&image.rgba) };
        let checked = check(&picture.scene, &picture.camera, &picture.truth, layers, oath);
        assert_eq!((checked.wrong, checked.first), (3, Some([30, 4])));
    }
}

/// A picture that shows the right spheres where rounding puts them is within it, and equal only if each t and colour is the exact one.
#[test]
fn right_spheres_at_other_distances_are_not_equal() {
    let picture = Picture::new();
    let seen = picture.truth.ids.iter().position(|&id| id != MISS).expect("something is seen");
    let mut other = picture.truth.clone();
    other.t[seen] = other.t[seen].next_up();
    for (image, wanted, inexact) in [(&picture.truth, Verdict::Equal, 0), (&other, Verdict::WithinBound, 1)] {
        let layers = Layers { ids: &image.ids, t: &image.t, rgba: None };
        let within = Oath::rounded(Rounding::TextbookF32);
        let checked = check(&picture.scene, &picture.camera, &picture.truth, layers, within);
        assert_eq!((checked.differing, checked.inexact, checked.wrong), (0, inexact, 0));
        assert_eq!(checked.verdict(), wanted);
    }
}

/// f32 states nothing of a sphere whose squared radius it has no number for: what is shown there is neither right nor wrong, and
/// nobody is timed for it.
#[test]
fn who_states_nothing_is_neither_equal_nor_timed() {
    let picture = Picture::new();
    let speck = Sphere { center: [0.0; 3], radius: 1e-30, color: [200; 3] };
    let scene = Scene::new(vec![speck], [0; 3], DEFAULT_LIGHT).expect("valid");
    let truth = exact(&scene, &picture.camera);
    let pixels = picture.camera.size().pixels();
    assert!(truth.ids.iter().all(|&id| id == MISS), "the speck is seen, and the test is of another");
    let (ids, t) = (vec![0; pixels], vec![1.0; pixels]);
    let layers = Layers { ids: &ids, t: &t, rgba: None };
    let within = Oath::rounded(Rounding::TextbookF32);
    let checked = check(&scene, &picture.camera, &truth, layers, within);
    let all = pixels as u64;
    assert_eq!(checked, Checked { differing: all, inexact: all, wrong: 0, not_stated: all, first: None });
    assert_eq!(checked.verdict(), Verdict::Undecidable);
    assert!(!checked.passes(Kind::Peer, pixels));

    let mut liar = Scripted::new(&scene, &truth);
    (liar.image.ids, liar.image.t, liar.kind, liar.oath) = (ids, t, Kind::Peer, within);
    let input = Input { name: "a speck", frame: 0, scene: &scene, camera: &picture.camera };
    let (rows, _) = race(vec![Box::new(liar)], &input, &truth, TWICE, 1, &silent).expect("nobody gives up");
    assert_eq!((rows[0].verdict, rows[0].not_stated, rows[0].timing), (Verdict::Undecidable, all, None));
    let remark = rows[0].remark.as_deref().unwrap_or_default();
    assert!(remark.contains("states nothing") && remark.contains(&all.to_string()), "{remark}");
}

#[test]
fn nobody_may_go_without_a_statement_in_more_than_a_pixel_in_ten_thousand() {
    let not_stated = |not_stated| Checked { not_stated, ..Checked::default() };
    for kind in [Kind::Subject, Kind::Limit, Kind::Picked, Kind::Naive, Kind::Embree, Kind::Peer] {
        assert!(
            not_stated(100).passes(kind, 1_000_000) && !not_stated(101).passes(kind, 1_000_000),
            "{kind:?}"
        );
    }
}

#[test]
fn only_others_may_lose_a_pixel_in_ten_thousand() {
    let wrong = |wrong| Checked { wrong, ..Default::default() };
    for kind in [Kind::Subject, Kind::Limit, Kind::Picked, Kind::Naive] {
        assert!(wrong(0).passes(kind, 1_000_000) && !wrong(1).passes(kind, 1_000_000), "{kind:?}");
    }
    for kind in [Kind::Embree, Kind::Peer] {
        assert!(wrong(100).passes(kind, 1_000_000) && !wrong(101).passes(kind, 1_000_000), "{kind:?}");
        assert!(!wrong(1).passes(kind, 9_999), "{kind:?}");
    }
}

// ---- the clock, with contestants whose times are made up ----

/// Shows a picture of a scene, the first times as it is and later with one pixel changed, of other scenes the exact one, or what it keeps of
/// the first, or with one pixel of so many wrong; does something at each frame, and says what time it took.
struct Scripted {
    kind: Kind,
    oath: Oath,
    scene: Scene,
    image: Image,
    moved: Image,
    /// Whether ids and t are those of the first scene, whatever is asked.
    keeps: [bool; 2],
    /// One pixel in so many is wrong in other scenes than the first.
    off: usize,
    frames: usize,
    sound: usize,
    build: Duration,
    took: Duration,
    at_each: Box<dyn Fn(&Scene)>,
}

impl Scripted {
    fn new(scene: &Scene, image: &Image) -> Self {
        let [build, took] = [1, 4].map(Duration::from_millis);
        let (kind, oath, scene) = (Kind::Naive, Oath::Exact, scene.clone());
        let (frames, sound, at_each) = (0, usize::MAX, Box::new(|_: &Scene| ()));
        let [image, moved] = [image, image].map(Clone::clone);
        let (keeps, off) = ([false; 2], usize::MAX);
        Self { kind, oath, scene, image, moved, keeps, off, frames, sound, build, took, at_each }
    }

    fn of(picture: &Picture) -> Self {
        Self::new(&picture.scene, &picture.truth)
    }
}

impl Contestant for Scripted {
    fn name(&self) -> &str {
        "scripted"
    }

    fn description(&self) -> String {
        "made up".into()
    }

    fn kind(&self) -> Kind {
        self.kind
    }

    fn oath(&self) -> Oath {
        self.oath
    }

    fn frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Frame<'_>, SubjectError> {
        if self.frames == self.sound {
            self.image.rgba[3 * 70 + 5][0] ^= 1;
        }
        self.frames += 1;
        (self.at_each)(scene);
        let now = if *scene == self.scene {
            &self.image
        } else {
            self.moved = exact(scene, camera);
            for id in self.moved.ids.iter_mut().skip(self.off - 1).step_by(self.off) {
                *id = if *id == MISS { 0 } else { MISS };
            }
            &self.moved
        };
        let [Image { ids, .. }, Image { t, .. }] =
            self.keeps.map(|kept| if kept { &self.image } else { now });
        let rgba = &now.rgba;
        // Colours are painted by who promises them.
        let rgba = matches!(self.oath, Oath::Exact).then_some(rgba.as_slice());
        Ok(Frame { build: self.build, took: Some(self.took), layers: Layers { ids, t, rgba } })
    }
}

const TWICE: Effort = Effort { rounds: Some(2), time: Duration::ZERO };

fn silent(_: &str, _: u32) -> Box<dyn Fn() + Sync> {
    Box::new(|| ())
}

#[test]
fn times_are_those_of_building_of_tracing_and_of_both() {
    let picture = Picture::new();
    let input = Input { name: "made up", frame: 0, scene: &picture.scene, camera: &picture.camera };
    let scripted: Box<dyn Contestant> = Box::new(Scripted::of(&picture));
    let (rows, rounds) = race(vec![scripted], &input, &picture.truth, TWICE, 1, &silent).expect("no failure");
    assert_eq!((rounds, rows.len(), rows[0].verdict), (2, 1, Verdict::Equal));
    let timing = rows[0].timing.expect("it passed");
    assert!(timing.frames >= 2, "{} frames in two rounds", timing.frames);
    for (what, spread, expected) in
        [("build", timing.build, 1e-3), ("trace", timing.trace, 3e-3), ("total", timing.total, 4e-3)]
    {
        for found in [spread.least, spread.median, spread.most] {
            close(what, Some(found), Some(expected));
        }
    }
    close("Mray/s", rows[0].mega_rays_per_second, Some(70.0 * 37.0 / 4e-3 / 1e6));
}

/// Of one tracer's many ways the fastest are timed, in whichever order they come; the others are told with their heat.
#[test]
fn of_many_ways_the_fastest_are_timed() {
    let picture = Picture::new();
    let input = Input { name: "made up", frame: 0, scene: &picture.scene, camera: &picture.camera };
    for order in [[1, 2, 3, 4, 5, 6], [6, 5, 4, 3, 2, 1], [3, 6, 1, 5, 2, 4]] {
        let way = |milliseconds| {
            let (build, took) = (Duration::ZERO, Duration::from_millis(milliseconds));
            Box::new(Scripted { kind: Kind::Embree, build, took, ..Scripted::of(&picture) })
                as Box<dyn Contestant>
        };
        let entrants = order.map(way).into();
        let (rows, _) = race(entrants, &input, &picture.truth, TWICE, 1, &silent).expect("nobody gives up");
        for (row, milliseconds) in rows.iter().zip(order) {
            let (timed, total) = (row.remark.is_none(), row.timing.expect("a heat at least").total);
            assert_eq!(timed, milliseconds <= 3, "{order:?}: {row:?}");
            close("its own time", Some(total.median), Some(milliseconds as f64 * 1e-3));
        }
    }
}

/// Frames as long as a turn, so that a turn has two, of which the second is counted; the second round begins with the other.
#[test]
fn each_round_begins_with_another_and_each_turn_with_a_frame_that_is_not_counted() {
    let picture = Picture::new();
    let input = Input { name: "made up", frame: 0, scene: &picture.scene, camera: &picture.camera };
    let (tell, asked) = channel();
    let entrant = |name: char| {
        let tell = tell.clone();
        let at_each = Box::new(move |_: &Scene| {
            tell.send(name).expect("somebody listens");
            std::thread::sleep(Duration::from_millis(20));
        });
        Box::new(Scripted { at_each, ..Scripted::of(&picture) }) as Box<dyn Contestant>
    };
    let entrants = vec![entrant('a'), entrant('b')];
    let (rows, _) = race(entrants, &input, &picture.truth, TWICE, 1, &silent).expect("nobody gives up");
    // Before and after the rounds each is checked.
    assert_eq!(asked.try_iter().collect::<String>(), "ab aabb bbaa ab".replace(' ', ""));
    for row in rows {
        assert_eq!(row.timing.map(|timing| timing.frames), Some(2), "in two rounds");
    }
}

/// One frame is checked before the clock runs and one after it has run.
#[test]
fn who_is_wrong_in_a_later_frame_is_not_timed() {
    let picture = Picture::new();
    let input = Input { name: "made up", frame: 0, scene: &picture.scene, camera: &picture.camera };
    let fickle = |kind, sound| {
        let scripted = Scripted { kind, sound, ..Scripted::of(&picture) };
        Box::new(scripted) as Box<dyn Contestant>
    };
    let entrants = vec![
        fickle(Kind::Subject, 1),
        fickle(Kind::Picked, usize::MAX),
        fickle(Kind::Naive, 0),
        fickle(Kind::Limit, 2),
    ];
    let (rows, _) = race(entrants, &input, &picture.truth, TWICE, 1, &silent).expect("nobody gives up");
    let told: Vec<_> =
        rows.iter().map(|row| (row.kind, row.verdict, row.first_wrong, row.timing.is_some())).collect();
    let place = Some([5, 3]);
    assert_eq!(
        told,
        [
            (Kind::Subject, Verdict::Wrong, place, false),
            (Kind::Picked, Verdict::Equal, None, true),
            (Kind::Naive, Verdict::Wrong, place, false),
            (Kind::Limit, Verdict::Wrong, place, false),
        ]
    );
    let remark = |k: usize| rows[k].remark.as_deref().unwrap_or_default();
    assert!(
        remark(0).contains("no longer after the rounds") && remark(0).contains("(5, 3)"),
        "{}",
        remark(0)
    );
    assert!(!remark(2).contains("no longer"), "{}", remark(2));
}

/// It passes before the rounds and after them, with what it has kept.
#[test]
fn who_answers_with_an_earlier_frame_is_wrong_and_not_timed() {
    let picture = Picture::new();
    let input = Input { name: "made up", frame: 0, scene: &picture.scene, camera: &picture.camera };
    let within = Oath::rounded(Rounding::TextbookF32);
    let keeping = |kind, oath, keeps| {
        Box::new(Scripted { kind, oath, keeps, ..Scripted::of(&picture) }) as Box<dyn Contestant>
    };
    let entrants = vec![
        keeping(Kind::Peer, within, [true; 2]),
        keeping(Kind::Embree, within, [true; 2]),
        keeping(Kind::Peer, within, [false, true]),
        keeping(Kind::Naive, within, [false; 2]),
        keeping(Kind::Naive, Oath::Exact, [false; 2]),
        // Told of one frame only.
        keeping(Kind::Limit, Oath::Exact, [true; 2]),
    ];
    let (rows, _) = race(entrants, &input, &picture.truth, TWICE, 1, &silent).expect("nobody gives up");
    let told: Vec<_> = rows.iter().map(|row| (row.kind, row.verdict, row.timing.is_some())).collect();
    assert_eq!(
        told,
        [
            (Kind::Peer, Verdict::Wrong, false),
            (Kind::Embree, Verdict::Wrong, false),
            (Kind::Peer, Verdict::Wrong, false),
            (Kind::Naive, Verdict::Equal, true),
            (Kind::Naive, Verdict::Equal, true),
            (Kind::Limit, Verdict::Equal, true),
        ]
    );
    for row in &rows[..3] {
        // Of the pixels of its two turns hardly one is what it should be.
        let remark = row.remark.as_deref().unwrap_or_default();
        let off = remark.strip_prefix("In frames that were timed ").and_then(|rest| rest.split_once(" of "));
        let (off, rest) = off.unwrap_or_else(|| panic!("{remark}"));
        assert!(rest.starts_with("128 pixels") && off.parse::<u64>().is_ok_and(|off| off >= 120), "{remark}");
        assert!(remark.ends_with("Not timed."), "{remark}");
    }
}

/// A picture of few pixels may be right by chance, and one of more may: who rounds may be off in the next, and only who promised the truth
/// may not.
#[test]
fn who_rounds_is_not_held_to_a_picture_of_few_pixels() {
    let picture = Picture::new();
    let one = Scene::new(picture.scene.spheres()[..1].to_vec(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let truth = exact(&one, &picture.camera);
    let [few, many] =
        [&truth, &picture.truth].map(|image| image.ids.iter().filter(|&&id| id != MISS).count());
    assert!((1..64).contains(&few) && many > 64, "{few} and {many} pixels show a sphere");
    let within = Oath::rounded(Rounding::TextbookF32);
    for (scene, truth, oath, off, timed) in [
        (&one, &truth, within, 1, true),
        (&one, &truth, Oath::Exact, 1, false),
        (&picture.scene, &picture.truth, within, 5, true),
        (&picture.scene, &picture.truth, within, 1, false),
        (&picture.scene, &picture.truth, Oath::Exact, 2, false),
    ] {
        let input = Input { name: "made up", frame: 0, scene, camera: &picture.camera };
        let scripted = Box::new(Scripted { oath, off, ..Scripted::new(scene, truth) });
        let (rows, _) = race(vec![scripted], &input, truth, TWICE, 1, &silent).expect("nobody gives up");
        let exact = matches!(oath, Oath::Exact);
        assert_eq!(rows[0].timing.is_some(), timed, "exact: {exact}, one pixel in {off}: {:?}", rows[0]);
        assert_eq!(rows[0].verdict, if timed { Verdict::Equal } else { Verdict::Wrong });
    }
}

/// All spheres of a frame move together, by one to four pixels along each axis of the picture, and in no two frames alike; for the clairvoyant
/// they stay.
#[test]
fn no_two_frames_that_are_timed_are_alike() {
    let picture = Picture::new();
    let input = Input { name: "made up", frame: 0, scene: &picture.scene, camera: &picture.camera };
    for kind in [Kind::Naive, Kind::Subject, Kind::Limit] {
        let (tell, asked) = channel();
        let at_each = Box::new(move |scene: &Scene| tell.send(scene.clone()).expect("somebody listens"));
        let scripted: Box<dyn Contestant> = Box::new(Scripted { kind, at_each, ..Scripted::of(&picture) });
        race(vec![scripted], &input, &picture.truth, TWICE, 1, &silent).expect("nobody gives up");
        let frames: Vec<Scene> = asked.try_iter().collect();
        let ways: Vec<[f64; 3]> = frames.iter().map(|frame| way(&picture, frame)).collect();
        let [checked, timed, again] = [&ways[..1], &ways[1..ways.len() - 1], &ways[ways.len() - 1..]];
        assert_eq!([checked, again].concat(), [[0.0; 3]; 2], "what is checked stands where it is");
        assert!(timed.len() >= 4, "{} frames", timed.len());
        for (k, way) in timed.iter().enumerate() {
            if kind == Kind::Limit {
                assert_eq!(*way, [0.0; 3]);
                continue;
            }
            assert!(way.iter().all(|steps| (0.99..4.01).contains(&steps.abs())), "{way:?} pixels");
            let apart = |other: &[f64; 3]| way.iter().zip(other).any(|(x, y)| (x - y).abs() > 1e-3);
            assert!(timed[..k].iter().all(apart), "frame {k} was there before");
        }
        // To both sides of each axis, but once in 2^(frames - 1) draws; the seed is set.
        for axis in 0..3 {
            let sides = [1.0, -1.0].map(|side| timed.iter().any(|way| way[axis] * side > 0.0));
            assert!(kind == Kind::Limit || sides == [true; 2], "axis {axis}: {timed:?}");
        }
    }
}

/// How far all spheres of a frame have moved: pixels to the side and up at the median of t, and as much in depth.
fn way(picture: &Picture, frame: &Scene) -> [f64; 3] {
    let pairs = frame.spheres().iter().zip(picture.scene.spheres());
    let moves: Vec<[f64; 3]> = pairs
        .map(|(now, then)| {
            assert_eq!((now.radius, now.color), (then.radius, then.color));
            std::array::from_fn(|i| f64::from(now.center[i]) - f64::from(then.center[i]))
        })
        .collect();
    let dot = |x: [f64; 3], y: [f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    let camera = &picture.camera;
    let [corner, du, dv] = [camera.corner(), camera.du(), camera.dv()].map(|v| v.map(f64::from));
    let middle: [f64; 3] = std::array::from_fn(|i| corner[i] + 35.0 * du[i] + 18.5 * dv[i]);
    let mut t: Vec<f32> = picture.truth.t.iter().copied().filter(|t| t.is_finite()).collect();
    t.sort_by(f32::total_cmp);
    let t = f64::from(t[t.len() / 2]);
    // The three are at right angles.
    let pixel = dot(du, du).sqrt() * t;
    let steps = |way: [f64; 3]| [du, dv, middle].map(|axis| dot(way, axis) / dot(axis, axis).sqrt() / pixel);
    for way in &moves {
        let apart = steps(std::array::from_fn(|i| way[i] - moves[0][i]));
        assert!(apart.iter().all(|steps| steps.abs() < 1e-2), "{way:?} and {:?}: not together", moves[0]);
    }
    steps(moves[0])
}

#[test]
fn a_spread_is_its_quantiles() {
    let spread = |times: &[f64]| Spread::of(times.to_vec());
    let told = |s: Spread| [s.least, s.lower_quartile, s.median, s.upper_quartile, s.most];
    for (times, expected) in [
        (&[5.0, 1.0, 4.0, 2.0, 3.0][..], [1.0, 2.0, 3.0, 4.0, 5.0]),
        (&[1.0, 2.0, 3.0, 4.0, 100.0], [1.0, 2.0, 3.0, 4.0, 100.0]),
        // Between two of them by the part of the way.
        (&[8.0, 2.0, 4.0, 1.0], [1.0, 1.75, 3.0, 5.0, 8.0]),
        (&[7.0], [7.0; 5]),
        (&[], [0.0; 5]),
    ] {
        assert_eq!(told(spread(times)), expected, "{times:?}");
    }
    // Parts of the median, whatever the times are counted in.
    for unit in [1e-6, 1e-3, 1.0, 1e3] {
        let times = [1.0, 2.0, 3.0, 4.0, 100.0].map(|time| time * unit);
        close("half the way between quartiles", Some(spread(&times).relative()), Some(1.0 / 3.0));
    }
}

// ---- what is told, of runs made up by hand ----

/// A contestant's row, timed with so many seconds, quartiles a tenth below and a fifth above.
fn row(kind: Kind, verdict: Verdict, seconds: f64) -> Row {
    let spread = |median: f64| Spread {
        median,
        lower_quartile: 0.9 * median,
        upper_quartile: 1.2 * median,
        least: 0.5 * median,
        most: 2.0 * median,
    };
    let timing =
        Timing { frames: 9, build: spread(seconds / 4.0), trace: spread(seconds), total: spread(seconds) };
    Row {
        name: format!("{kind:?}").to_lowercase(),
        kind,
        description: "made up".into(),
        verdict,
        differing: 0,
        wrong: 0,
        not_stated: 0,
        first_wrong: None,
        timing: Some(timing),
        mega_rays_per_second: Some(1e-2 / seconds),
        remark: None,
    }
}

fn scene(contestants: Vec<Row>) -> SceneBench {
    SceneBench {
        name: "made-up".into(),
        spheres: 3,
        frame: 2,
        width: 20,
        height: 10,
        threads: 4,
        truth: Truth { how: "by hand".into(), rays: 200, by_full_loop: 200, hits: 100 },
        rounds: 2,
        ratio_to_embree: None,
        embree_best: None,
        ratio_to_limit: None,
        ratio_to_picked: None,
        picked_best: None,
        contestants,
    }
}

fn subject(verdict: Verdict) -> SceneBench {
    scene(vec![row(Kind::Subject, verdict, 2e-3)])
}

fn made_up(scenes: Vec<SceneBench>, later: Vec<SceneBench>) -> Bench {
    let points = later.into_iter().zip(1..).map(|(scene, x)| Point { x: f64::from(x), scene }).collect();
    Bench {
        schema_version: SCHEMA_VERSION,
        kind: "bench",
        environment: Environment {
            program: "cgt".into(),
            target: "any".into(),
            cpu: Some("abacus".into()),
            simd: "scalar".into(),
            rustc: "rustc".into(),
            threads: 4,
            date: "2026-01-01".into(),
            command_line: "cgt bench".into(),
            seed: Some(1),
        },
        plan: "fast".into(),
        level: "scalar".into(),
        outsiders: Vec::new(),
        absent: Vec::new(),
        summary: Summary::of(&scenes),
        scenes,
        curves: vec![Curve { over: "spheres", points, growth: Vec::new() }],
        baseline: None,
    }
}

#[test]
fn the_word_of_a_run_is_that_of_its_worst_picture() {
    use Verdict::{Equal, NotJudged, Undecidable, WithinBound, Wrong};
    for (scenes, later, expected) in [
        (&[Equal, Equal][..], &[Equal][..], Equal),
        (&[Equal, WithinBound], &[Equal], WithinBound),
        (&[Equal], &[Equal, WithinBound], WithinBound),
        (&[Undecidable, WithinBound], &[Equal], Undecidable),
        (&[Equal], &[Undecidable], Undecidable),
        (&[Equal, Wrong], &[NotJudged], Wrong),
        (&[Equal], &[Equal, Wrong], Wrong),
        (&[Equal], &[NotJudged], NotJudged),
        (&[], &[], NotJudged),
    ] {
        let of = |verdicts: &[Verdict]| verdicts.iter().map(|verdict| subject(*verdict)).collect();
        let bench = made_up(of(scenes), of(later));
        assert_eq!(bench.verdict(), expected, "{scenes:?}, then {later:?}");
        let broken = [Wrong, NotJudged].contains(&expected);
        assert_eq!(!bench.broken_promises().is_empty(), broken, "{scenes:?}, then {later:?}");
    }
    assert_eq!(made_up(vec![subject(Equal)], vec![scene(Vec::new())]).verdict(), NotJudged, "nobody there");
    // Of other people's tracers it does not depend.
    for (kind, expected) in [
        (Kind::Limit, Wrong),
        (Kind::Picked, Wrong),
        (Kind::Naive, Wrong),
        (Kind::Embree, Equal),
        (Kind::Peer, Equal),
    ] {
        let beside = vec![row(Kind::Subject, Equal, 1.0), row(kind, Wrong, 1.0)];
        assert_eq!(made_up(vec![scene(beside)], Vec::new()).verdict(), expected, "{kind:?}");
    }
    let mut lacking = made_up(vec![subject(Equal)], Vec::new());
    for (needed, expected) in [(false, Equal), (true, NotJudged)] {
        lacking.absent = vec![Absent { judge: "embree".into(), why: "lost".into(), needed }];
        assert_eq!(lacking.verdict(), expected, "needed: {needed}");
    }
}

#[test]
fn a_summary_has_the_mean_and_the_worst_of_each_ratio() {
    let with = |[embree, limit, picked]: [Option<f64>; 3]| SceneBench {
        ratio_to_embree: embree,
        ratio_to_limit: limit,
        ratio_to_picked: picked,
        ..subject(Verdict::Equal)
    };
    let scenes = [
        with([Some(18.0), Some(2.0), Some(1.1)]),
        with([Some(8.0), Some(4.5), Some(1.3)]),
        with([None, None, Some(1.2)]),
    ];
    let summary = Summary::of(&scenes);
    close("the mean to Embree", summary.ratio_to_embree_mean, Some(12.0));
    close("the mean to the limit", summary.ratio_to_limit_mean, Some(3.0));
    let worst = [summary.ratio_to_embree_least, summary.ratio_to_limit_most, summary.ratio_to_picked_most];
    assert_eq!(worst, [Some(8.0), Some(4.5), Some(1.3)]);
    assert_eq!(Summary::of(&scenes[3..]), Summary::default());
}

#[test]
fn the_table_tells_times_by_those_of_the_subject() {
    let rows = [(Kind::Subject, 2e-3), (Kind::Limit, 1e-3), (Kind::Peer, 5e-3)];
    let rows = rows.map(|(kind, seconds)| row(kind, Verdict::Equal, seconds));
    let table = text(&made_up(vec![scene(rows.into())], Vec::new()), false);
    let told = |name: &str| -> Vec<String> {
        let line = table.lines().find(|line| line.starts_with(&format!("made-up {name} ")));
        let line = line.unwrap_or_else(|| panic!("{name} has no line: {table}"));
        let words: Vec<_> = line.split_whitespace().rev().take(3).map(str::to_owned).collect();
        words.into_iter().rev().collect()
    };
    // Half the way between quartiles in a hundred of the median, Mray/s, times the subject's.
    let number = |word: &String| word.parse::<f64>().unwrap_or_else(|_| panic!("{word}: {table}"));
    for (name, expected) in
        [("subject", [15.0, 5.0, 1.0]), ("limit", [15.0, 10.0, 0.5]), ("peer", [15.0, 2.0, 2.5])]
    {
        for (word, expected) in told(name).iter().zip(expected) {
            assert!((number(word) / expected - 1.0).abs() < 1e-3, "{name}: {word} for {expected}: {table}");
        }
    }
}

/// Cells of a row of the page's first table under their headings, but for the verdict's seal.
fn cells<'a>(page: &'a str, row: &str) -> Vec<(&'a str, &'a str)> {
    fn word(text: &str) -> &str {
        text.split(['>', '<']).nth(1).unwrap_or_default()
    }
    let head = page.lines().find(|line| line.starts_with("<thead>")).expect("a table");
    let row = page.lines().find(|line| line.contains("<th scope=\"row\"") && line.contains(row));
    let row = row.unwrap_or_else(|| panic!("no row: {page}"));
    let headings = head.split("<th scope=\"col\"").skip(2).map(word);
    headings.zip(row.split("<td").skip(1).map(word)).skip(1).collect()
}

/// Each number another, so that none can stand for another.
#[test]
fn page_and_terminal_have_each_number_under_its_heading() {
    let spread = |unit: f64| Spread {
        least: unit,
        lower_quartile: 2.0 * unit,
        median: 3.0 * unit,
        upper_quartile: 4.0 * unit,
        most: 5.0 * unit,
    };
    let peer = Row {
        differing: 700,
        wrong: 33,
        timing: Some(Timing { frames: 9, build: spread(1e-3), trace: spread(1e-2), total: spread(0.1) }),
        mega_rays_per_second: Some(12.5),
        ..row(Kind::Peer, Verdict::WithinBound, 1.0)
    };
    let mut bench = made_up(vec![scene(vec![row(Kind::Subject, Verdict::Equal, 0.15), peer])], Vec::new());
    bench.summary = Summary {
        ratio_to_embree_mean: Some(12.5),
        ratio_to_embree_least: Some(11.5),
        ratio_to_limit_mean: Some(1.5),
        ratio_to_limit_most: Some(1.75),
        ratio_to_picked_most: Some(1.25),
    };
    let shown = page(&bench).expect("filled in");
    let expected = [
        ("differing pixels", "700"),
        ("wrong pixels", "33"),
        ("build", "3.00 ms"),
        ("trace", "30.0 ms"),
        ("frame, median", "300 ms"),
        ("lower quartile", "200 ms"),
        ("upper quartile", "400 ms"),
        ("frames", "9"),
        ("Mray/s", "12.5"),
        ("times the subject's", "2.00"),
    ];
    assert_eq!(cells(&shown, ">peer</th>"), expected);
    for (value, what) in [
        ("12.5", "times as fast as Embree, geometric mean"),
        ("11.5", "times at least"),
        ("1.50", "times the clairvoyant's time, geometric mean"),
        ("1.75", "times at most"),
        ("1.25", "times the best plan's time at most"),
    ] {
        let what = what.replace('\'', "&#39;");
        assert!(shown.contains(&format!("<b>{value}</b> {what}</li>")), "{value} {what}: {shown}");
    }
    let table = text(&bench, false);
    let line = table.lines().find(|line| line.starts_with("made-up peer")).expect("a line of its own");
    let words: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(words.join(" "), "made-up peer ≈ within bound 700 3.00 ms 30.0 ms 33.3 12.5 2.00");
}

/// What is wanted at most is missed above it, what is wanted at least below it.
#[test]
fn who_misses_what_is_wanted_is_told_so() {
    for (factor, at_least, holds) in
        [(10.0, false, true), (12.0, false, false), (12.0, true, true), (10.0, true, false)]
    {
        let mut bench = made_up(vec![subject(Verdict::Equal)], Vec::new());
        let growth =
            Growth { what: "rebuild".into(), between: [10.0, 100.0], factor, wanted: 11.0, at_least };
        bench.curves[0].growth.push(growth);
        let said = sentences(&bench).join("\n");
        let told = format!(
            "rebuild from 10 to 100: {factor:.1} times, at {} 11.0 is wanted{}",
            if at_least { "least" } else { "most" },
            if holds { "." } else { ": MISSED." }
        );
        assert!(said.contains(&told), "{told}: {said}");
    }
    // A plan that is chosen from the scene alone may take 1.15 times what the best takes.
    for (ratio, missed) in [(1.1, false), (1.3, true)] {
        let scene = SceneBench { ratio_to_picked: Some(ratio), ..subject(Verdict::Equal) };
        let said = sentences(&made_up(vec![scene], Vec::new())).join("\n");
        assert!(said.contains("best plan picked by hand: at most 1.") && said.contains("1.15 is wanted"));
        assert_eq!(said.contains("MISSED"), missed, "{ratio}: {said}");
    }
}

/// A tenth may be lost, and no more.
#[test]
fn slower_is_by_more_than_the_tolerance() {
    let step = |now| Step { scene: "made-up".into(), measure: "Mray/s", before: 100.0, now };
    for (now, tolerance, slower) in [
        (91.0, 0.1, false),
        (89.0, 0.1, true),
        (100.0, 0.0, false),
        (99.9, 0.0, true),
        (200.0, 0.1, false),
        (71.0, 0.3, false),
        (69.0, 0.3, true),
    ] {
        assert_eq!(step(now).is_slower(tolerance), slower, "{now} by {tolerance}");
        assert_eq!(step(now).sentence(tolerance).contains(": slower"), slower, "{now} by {tolerance}");
    }
    assert!(step(89.0).sentence(0.1).contains("-11.0 %"), "{}", step(89.0).sentence(0.1));
}

#[test]
fn a_baseline_of_something_else_is_refused() {
    let bench = made_up(vec![subject(Verdict::Equal)], Vec::new());
    let honest = serde_json::to_value(&bench).expect("JSON");
    let held = |changes: &[(&str, Value)]| {
        let mut earlier = honest.clone();
        for (place, value) in changes {
            *earlier.pointer_mut(place).unwrap_or_else(|| panic!("{place} is not there")) = value.clone();
        }
        compare(&earlier.to_string(), &bench, 0.1)
    };
    let faster =
        held(&[("/scenes/0/contestants/0/mega_rays_per_second", json!(9.5))]).expect("the same scene");
    let step = Step { scene: "made-up".into(), measure: "Mray/s", before: 9.5, now: 1e-2 / 2e-3 };
    assert_eq!((faster.steps, faster.missing), (vec![step], Vec::new()));
    for (place, value) in
        [("/environment/cpu", json!("another")), ("/plan", json!("safe")), ("/level", json!("avx2"))]
    {
        assert!(matches!(held(&[(place, value)]), Err(BaselineError::Other { .. })), "{place}");
    }
    for (part, value) in [
        ("name", json!("another")),
        ("spheres", json!(4)),
        ("frame", json!(3)),
        ("width", json!(21)),
        ("height", json!(11)),
        ("threads", json!(8)),
    ] {
        let place = format!("/scenes/0/{part}");
        assert!(matches!(held(&[(&place, value)]), Err(BaselineError::Nothing)), "{part}");
    }
    // The ratio to Embree where both have it.
    let mut ours = bench.clone();
    ours.scenes[0].ratio_to_embree = Some(12.0);
    let theirs = |ratio: Value| {
        let mut earlier = honest.clone();
        earlier["scenes"][0]["ratio_to_embree"] = ratio;
        compare(&earlier.to_string(), &ours, 0.1).expect("the same scene").steps.remove(0)
    };
    let told = |step: Step| (step.measure, step.before, step.now);
    assert_eq!(told(theirs(json!(11.0))), ("ratio to Embree", 11.0, 12.0));
    assert_eq!(told(theirs(Value::Null)).0, "Mray/s");
    // A scene that the baseline has not is named, whatever the others are.
    let mut more = bench.clone();
    more.scenes.push(more.scenes[0].clone());
    more.scenes[1].name = "newer".into();
    let held = compare(&honest.to_string(), &more, 0.1).expect("one of two is the same");
    assert_eq!((held.steps.len(), held.missing.as_slice()), (1, &["newer".to_owned()][..]));
    more.baseline = Some(held);
    let told = text(&more, false);
    assert!(told.contains("baseline, newer: not compared."), "{told}");
}
