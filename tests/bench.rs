//! Does `cgt bench` say what it measured, time nobody who is wrong, and end with the right code? No time is ever asserted.

use contract::{Camera, Image, MISS, Scene};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;
use verify::bench::check::check;
use verify::bench::contestant::{Kind, Layers, Oath};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::subject::Rounding;

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
    let limits = ["--curves", "--most-spheres", "1000", "--most-rows", "180"];
    let output = bench(&desk, &[&["2juy", "--json", "b.json", "--out", "folder"], &limits[..]].concat());
    assert_eq!(code(&output), 0, "{output:?}");
    let bench = json(&desk.path().join("b.json"));
    let curves = list(&bench, "curves");
    let over: Vec<_> = curves.iter().map(|curve| curve["over"].as_str().expect("a word")).collect();
    assert_eq!(over, ["spheres", "pixels", "threads"]);
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
    }
    let page = std::fs::read_to_string(desk.path().join("folder/bench.html")).expect("a page");
    assert_eq!(page.matches("<svg class=\"plot\"").count(), 4, "the scenes and three curves");
}

// ---- the check itself ----

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
        let truth = reference::Tracer::new(reference::Arithmetic::Exact).render(&scene, &camera);
        Self { truth: truth.expect("it fits").image, scene, camera }
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

#[test]
fn only_others_may_lose_a_pixel_in_ten_thousand() {
    let wrong = |wrong| verify::bench::check::Checked { wrong, ..Default::default() };
    for kind in [Kind::Subject, Kind::Limit] {
        assert!(wrong(0).passes(kind, 1_000_000) && !wrong(1).passes(kind, 1_000_000), "{kind:?}");
    }
    for kind in [Kind::Embree, Kind::Peer] {
        assert!(wrong(100).passes(kind, 1_000_000) && !wrong(101).passes(kind, 1_000_000), "{kind:?}");
        assert!(!wrong(1).passes(kind, 9_999), "{kind:?}");
    }
}
