//! Does `cgt spu` do what a person relies on: tables, files, refusals? And do this computer's branches tell the same of the loops as
//! the model does, where Valgrind is there to simulate them?

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn cgt(words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cgt"));
    command.arg("spu").args(words).env("CGT_DATA", "no-data");
    command.output().expect("the program starts")
}

/// What it wrote to its two outputs, if it ended so.
fn said(words: &[&str], code: i32) -> [String; 2] {
    let output = cgt(words);
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    assert_eq!(output.status.code(), Some(code), "{words:?}: {out}{err}");
    assert!(!err.contains("panicked"), "{words:?}: {err}");
    [out, err]
}

fn json(file: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(file).expect("it is written")).expect("JSON")
}

#[test]
fn a_scene_is_measured_stage_by_stage() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("spu.json");
    let name = file.to_str().expect("a path in UTF-8");
    let [out, _] = said(&["2juy", "--frames", "1..3", "--size", "128x72", "--json", name], 0);
    for word in
        ["voxelize", "frustum", "walk", "cull", "intersect", "shade", "DMA", "frames a second", "Mailbox"]
    {
        assert_eq!(out.matches(word).count().min(2), 2, "{word} is missing in one of two frames: {out}");
    }
    assert!(!out.contains("counted"), "all blocks are traced: {out}");
    let report = json(&file);
    assert_eq!((report["schema_version"].as_u64(), report["kind"].as_str()), (Some(2), Some("spu")));
    let frames: Vec<_> = report["surveys"].as_array().expect("surveys").iter().map(|s| &s["frame"]).collect();
    assert_eq!(frames, [1, 2]);
    for survey in report["surveys"].as_array().expect("surveys") {
        for rate in survey["rates"].as_array().expect("rates") {
            let [least, most] = [0, 1].map(|i| rate["frames_per_second"][i].as_f64().expect("a number"));
            assert!(0.0 < least && least <= most, "{rate}");
            for stage in rate["stages"].as_array().expect("stages") {
                let [least, most] = [0, 1].map(|i| stage["per_ray"][i].as_f64().expect("a number"));
                assert!(0.0 < least && least <= most, "{stage}");
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_and_can_be_measured_all_the_same() {
    let small = ["sphereflake:4", "--size", "64x36", "--sample", "4"];
    let [_, err] = said(&small, 2);
    for part in ["the local store holds 262144 bytes", "grid", "131072", "118096", "too many"] {
        assert!(err.contains(part), "{part} is not in: {err}");
    }
    let [out, _] = said(&[&small[..], &["--unlimited"]].concat(), 0);
    assert!(out.contains("too many"), "{out}");
    // Tests are counted in a quarter of the blocks, cycles are those of a frame.
    let words: Vec<&str> = out.split_whitespace().collect();
    assert!(words.join(" ").contains(" with, counted in the blocks traced, a factor of "), "{out}");
    said(&["1hvr", "--grid", "20", "--size", "64x36"], 2);
    said(&["1hvr", "--grid", "8", "--size", "64x36", "--plan", "safe"], 0);
}

#[test]
fn capacity_and_bad_usage() {
    let [out, _] = said(&["--capacity"], 0);
    let line = out.lines().find(|line| line.starts_with("16^3")).expect("a line for the paper's grid");
    assert!(line.contains("131072"), "{line}");
    assert!(
        out.lines().any(|line| line.starts_with("20^3") && line.matches("no room").count() == 2),
        "{out}"
    );
    let fits = |scene: &str| {
        let line = out.lines().find(|line| line.starts_with(scene)).expect("a line for the scene");
        line.split_whitespace().rev().take(2).map(|word| word == "yes").collect::<Vec<_>>()
    };
    assert_eq!([fits("1hvr"), fits("sphereflake:4"), fits("adk-water")], [[true; 2], [false; 2], [false; 2]]);
    for words in [
        &["--plan", "fast"][..],
        &["--frames", "3..3"],
        &["--frames", "x"],
        &["--sample", "0"],
        &["--grid", "0"],
        &["--curves"],
        &["no-such-scene"],
        &["2juy", "--frame", "99"],
        &["--walk", "nested"],
        &["--walk", "nested:no-such-level:1"],
        &["--walk", "backwards:scalar:1"],
    ] {
        said(words, 2);
    }
}

#[test]
fn curves_make_a_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("page");
    let to = out.to_str().expect("a path");
    said(&["2juy", "--frame", "3", "--size", "64x36", "--curves", "--out", to], 0);
    let page = std::fs::read_to_string(out.join("spu.html")).expect("a page");
    assert!(page.matches("<svg").count() >= 10, "curves are missing");
    assert!(!page.contains("NaN") && !page.contains("inf,"), "a figure is no number");
    let report = json(&out.join("spu.json"));
    let points = |k: usize| report["curves"][k]["points"].as_array().map_or(0, Vec::len);
    assert_eq!([points(0), points(1)], [6, 7]);
    // Of random spheres there is one frame; over grid size it is the scene's own.
    for (k, frame) in [(0, 0), (1, 3)] {
        let points = report["curves"][k]["points"].as_array().expect("points");
        assert!(points.iter().all(|point| point["survey"]["frame"] == frame), "curve {k}: {points:?}");
    }
}

/// Of a picture that looks away from the scene there are no cells to divide by: a dash stands there, and null.
#[test]
fn what_is_told_by_cells_is_a_dash_without_cells() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("spu.json");
    let name = file.to_str().expect("a path in UTF-8");
    let away = ["2juy", "--eye", "0,0,300", "--target", "0,0,600", "--size", "64x36", "--json", name];
    let [out, _] = said(&away, 0);
    assert!(!out.contains(" inf ") && !out.contains("NaN") && out.contains(" – a cell"), "{out}");
    let loops = &json(&file)["surveys"][0]["loops"];
    for of in loops.as_array().expect("two loops") {
        assert!(of["cells"] == 0 && of["policies"][0]["per_cell"].is_null(), "{of}");
    }
}

/// Of what the processor counts, that is taken off which it counts of the same run without walks. The counters are a made-up `perf`'s.
#[cfg(unix)]
#[test]
fn counters_are_those_of_the_walks_alone() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let perf = folder.path().join("perf");
    let text = "#!/bin/sh\ncase \"$*\" in *:0) echo '100,,branches:u' >&2; echo '10,,branch-misses:u' >&2 ;;\n\
                *) echo '1100,,branches:u' >&2; echo '60,,branch-misses:u' >&2 ;; esac\n";
    std::fs::write(&perf, text).expect("written");
    std::fs::set_permissions(&perf, std::fs::Permissions::from_mode(0o755)).expect("it may run");
    let file = folder.path().join("spu.json");
    let mut command = Command::new(env!("CARGO_BIN_EXE_cgt"));
    command.args(["spu", "uniform:20:1", "--size", "16x16", "--host", "--json"]).arg(&file);
    // Nothing else is on the path, so nothing is simulated.
    let output = command.env("PATH", folder.path()).output().expect("the program starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let host = &json(&file)["host"];
    assert!(host["simulated"]["Err"].is_string(), "{}", host["simulated"]);
    let counted = host["counters"]["Ok"].as_array().unwrap_or_else(|| panic!("{}", host["counters"]));
    assert!(counted.len() >= 4, "{counted:?}");
    for of in counted {
        assert_eq!(of["branches"], serde_json::json!([1000, 50]), "{of}");
    }
    // The best level of those that Valgrind knows, though nothing is simulated.
    if cfg!(target_arch = "x86_64") && std::arch::is_x86_feature_detected!("avx2") {
        assert_eq!(host["level"], "avx2");
    }
}

/// Nested loops and masks mispredict many times a walk, selection about once, as on the model.
#[test]
fn this_computer_tells_the_same_of_the_loops() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("spu.json");
    let words = ["uniform:100:1", "--size", "16x16", "--host", "--json", file.to_str().expect("a path")];
    let [out, _] = said(&words, 0);
    eprintln!("{}", &out[out.find("mispredicts a walk").expect("the model's figures")..]);
    let host = &json(&file)["host"];
    if let Some(why) = host["counters"]["Err"].as_str() {
        eprintln!("not judged: the processor's counters: {why}");
    }
    if let Some(why) = host["simulated"]["Err"].as_str() {
        let there = Command::new("valgrind").arg("--version").output().is_ok();
        assert!(!there, "Valgrind is there, and no branches were simulated: {why}");
        eprintln!("not judged: simulated branches: {why}");
        return;
    }
    let counted = host["simulated"]["Ok"].as_array().expect("one or the other");
    let by_walk = |way: &str| {
        let of = counted.iter().find(|of| of["way"] == way).expect("every way is counted");
        of["branches"][1].as_f64().expect("a count") / of["walks"].as_f64().expect("a count")
    };
    let [nested, masks] = ["nested", "masks"].map(by_walk);
    let [selected, flattened] = ["selected", "flattened"].map(by_walk);
    assert!(nested > 5.0 && selected < 2.0 && flattened < 2.0, "{nested}, {selected}, {flattened}");
    eprintln!("masks: {masks} a walk; if that is few, this compiler put no branches back");
}
