//! Does the program do what a person at a terminal relies on: exit codes, messages, files, numbers?
//!
//! Each case runs `cgt` as a process in a folder of its own. In every one of them a panic is a failure, and so is a
//! file that is half written.

use serde_json::Value;
use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

const CGT: &str = env!("CARGO_BIN_EXE_cgt");
const SMALL: &str = "64x36";

/// A folder to run in, with the files that cases speak of.
struct Desk(TempDir);

struct Said {
    code: i32,
    out: String,
    err: String,
}

impl Desk {
    fn new() -> Self {
        let desk = Self(tempfile::tempdir().expect("a temporary folder"));
        let dump = |radius| {
            format!(
                "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n\
                 ITEM: ATOMS id type x y z radius\n1 1 0 0 0 {radius}\n"
            )
        };
        let number = |x: f32| format!("{{\"dec\": {x:?}, \"bits\": \"{:08x}\"}}", x.to_bits());
        let (zero, light) = (number(0.0), number(1.0));
        let json = format!(
            "{{\"format\": \"cgt-scene\", \"version\": 1, \"frames\": [{{\"background\": [0, 0, 0], \
             \"light\": [{zero}, {zero}, {light}], \"spheres\": [{{\"center\": [{zero}, {zero}, {zero}], \
             \"radius\": {zero}, \"color\": [1, 2, 3]}}]}}]}}"
        );
        for (name, bytes) in [
            ("empty.pdb", Vec::new()),
            ("binary.pdb", vec![0x7f, b'E', b'L', b'F', 2, 1, 1, 0, 0, 0]),
            ("nan.xyz", b"1\nwater\nO nan 0 0\n".to_vec()),
            ("negative.lammpstrj", dump("-1").into_bytes()),
            ("none.lammpstrj", dump("0").into_bytes()),
            ("zero.json", json.into_bytes()),
            ("cut.xyz", b"2\none\nC 0 0 0\nO 1 0 0\n2\ntwo\nC 0 0 0\n".to_vec()),
            ("two words.xyz", b"1\nx\nC 0 0 0\n".to_vec()),
            ("notes.txt", b"not a scene".to_vec()),
            ("file", b"in the way".to_vec()),
        ] {
            std::fs::write(desk.path(name), bytes).expect("a file is written");
        }
        std::fs::create_dir(desk.path("no-data")).expect("a folder is made");
        std::fs::create_dir(desk.path("folder.png")).expect("made");
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run<S: AsRef<OsStr>>(&self, words: &[S]) -> Said {
        self.finish(self.command(CGT).args(words))
    }

    /// A program that finds no fetched data.
    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.current_dir(self.0.path()).env("CGT_DATA", self.path("no-data")).stdin(Stdio::null());
        command
    }

    /// Runs it; whatever it was, it must not have panicked and must have left no part of a file.
    fn finish(&self, command: &mut Command) -> Said {
        let Output { status, stdout, stderr } = command.output().expect("the program starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("it speaks UTF-8");
        let (out, err) = (text(stdout), text(stderr));
        let code = status.code().unwrap_or_else(|| panic!("{command:?}: ended by {status}\n{err}"));
        assert!(code != 101 && !err.contains("panicked"), "{command:?}: panicked\n{err}");
        let parts: Vec<_> = files(self.0.path()).into_iter().filter(|p| name(p).contains(".part")).collect();
        assert!(parts.is_empty(), "{command:?}: left {parts:?}");
        Said { code, out, err }
    }
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// All files under a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

fn report(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("report.json")).expect("there is a report.json");
    serde_json::from_str(&text).expect("it is JSON")
}

// ---- what is refused ----

/// Words, exit code, and what standard error must say.
type Refusal = (&'static [&'static str], &'static [&'static str]);

/// All of these end with code 2, print nothing on standard output, and write nothing.
const REFUSALS: &[Refusal] = &[
    (&["prove", "nosuch"], &["no lemma is named nosuch"]),
    (&["prove", "nosuch", "--json", "missing/prove.json"], &["`missing/prove.json`", "No such file"]),
    // Scenes.
    (&["nosuch"], &["nosuch", "1hvr", "sphereflake:LEVELS"]),
    (&[""], &["\"\" is no scene"]),
    (&["nosuch.pdb"], &["nosuch.pdb: No such file"]),
    (&["no/such"], &["no/such"]),
    (&["."], &["."]),
    (&["notes.txt"], &["notes.txt", "\"txt\"", ".pdb"]),
    (&["adk"], &["the data of adk is absent", "tests/fetch-data"]),
    // Before anything is traced, which would leave a file.
    (
        &["1hvr", "teapot", "--subject-cmd", "touch ran"],
        &["the data of teapot is absent", "tests/fetch-data"],
    ),
    (&["2juy", "1hvr", "--frames", "0..3", "--subject-cmd", "touch ran"], &["1hvr has frames 0 to 0, not 2"]),
    (&["chart", "1hvr", "teapot", "--subject-cmd", "touch ran"], &["the data of teapot is absent"]),
    (&["report", "1hvr", "teapot", "--subject-cmd", "touch ran"], &["the data of teapot is absent"]),
    (&["report", "--film", "nosuch", "--subject-cmd", "touch ran"], &["nosuch"]),
    (&["empty.pdb"], &["empty.pdb: is empty"]),
    (&["binary.pdb"], &["binary.pdb", "no text"]),
    (&["nan.xyz"], &["nan.xyz:3:3", "x is \"nan\"", "finite"]),
    (&["negative.lammpstrj"], &["negative.lammpstrj:10:11", "radius is \"-1\"", "above 0"]),
    (&["none.lammpstrj"], &["none.lammpstrj:10:11", "radius is \"0\"", "above 0"]),
    (&["zero.json"], &["zero.json:1:", "radius 0.0 is not above 0"]),
    (&["uniform:99999999999:1"], &["99999999999 spheres", "the limit is 134217728"]),
    (&["uniform:18446744073709551616:1"], &["18446744073709551616", "a whole number"]),
    (&["uniform:-1:1"], &["count is \"-1\""]),
    (&["uniform:10:1:7"], &["end is \"7\""]),
    (&["uniform"], &["count is \"\""]),
    (&["sphereflake:99"], &["the limit is 134217728"]),
    (&["lattice:99999999"], &["the limit is 134217728"]),
    (&["render", "nosuch", "x.png"], &["nosuch"]),
    // Before the first is measured, which would warn of its cut frame.
    (&["bench", "cut.xyz", "nosuch"], &["nosuch"]),
    (&["ablate", "cut.xyz", "nosuch"], &["nosuch"]),
    // Subjects and frames.
    (&["--subject", "nosuch"], &["nosuch", "naive-f64", "safe"]),
    (&["--frame", "99"], &["1hvr has frames 0 to 0, not 99"]),
    (&["2juy", "--frame", "24"], &["2juy has frames 0 to 23, not 24"]),
    (&["verify", "2juy", "--frames", "22..26"], &["2juy has frames 0 to 23, not 25"]),
    (&["chart", "1hvr", "--far", "0"], &["0.001 to 10000"]),
    (&["stability", "--rays", "0"], &["--rays"]),
    (&["stability", "--only", "nosuch"], &["`nosuch` is no sweep", "distance"]),
    (&["stability", "--methods", "nosuch"], &["`nosuch` is no method", "naive-f64"]),
    (&["report", "--skip", "nosuch"], &["nosuch", "ablation"]),
    (&["--frame", "99999999999999999999999"], &["--frame"]),
    (&["--threads", "1025"], &["--threads", "1024"]),
    // Pictures and cameras.
    (&["--size", "0x0"], &["0x0", "no pixel"]),
    (&["--size", "1x0"], &["1x0", "no pixel"]),
    (&["--size", "100000x100000"], &["100000x100000", "too large", "16384"]),
    (&["--size", "16384x16384"], &["16384x16384", "too large"]),
    (&["--size", "99999999999x1"], &["99999999999"]),
    (&["--size", "abc"], &["abc", "WIDTHxHEIGHT"]),
    (&["--size", "axb"], &["`a`"]),
    (&["--fov", "400"], &["400", "below 179"]),
    (&["--fov", "0"], &["above 0.001"]),
    (&["--fov", "NaN"], &["NaN"]),
    (&["--eye", "1,2,3", "--target", "1,2,3"], &["the eye and what it looks at are both [1.0, 2.0, 3.0]"]),
    (&["--eye", "0,0,nan"], &["NaN", "finite"]),
    (&["--eye", "0,0,1e999"], &["inf", "finite"]),
    (&["--eye", "1,2"], &["expected 3 numbers X,Y,Z, got 2"]),
    // Places.
    (&["--out", "file"], &["`file`", "Not a directory"]),
    (&["--out", "file/below"], &["`file/below`", "Not a directory"]),
    (&["--out", ""], &["--out"]),
    (&["render", "1hvr", "file/x.png"], &["`file/x.png`", "Not a directory"]),
    // Before the scene is looked at.
    (&["render", "nosuch", "missing/x.png"], &["`missing/x.png`", "No such file"]),
    (&["render", "nosuch", "missing/x%d.png", "--frames", "0..1"], &["`missing/x0.png`", "No such file"]),
    (&["render", "nosuch", "missing/x.gif", "--frames", "0..1"], &["`missing/x.gif`", "No such file"]),
    (&["render", "nosuch", "folder.png"], &["`folder.png`", "directory"]),
    (&["bench", "nosuch", "--json", "missing/bench.json"], &["`missing/bench.json`", "No such file"]),
    (&["spu", "nosuch", "--json", "missing/spu.json"], &["`missing/spu.json`", "No such file"]),
    (&["render", "1hvr", "x.jpg"], &["`x.jpg`", ".png", ".exr"]),
    (&["render", "1hvr", "x"], &["`x`", ".png", ".exr"]),
    (&["render", "1hvr", ""], &["<FILE>"]),
    // Figures and claims.
    (&["figures", "nosuch"], &["nosuch", "1hvr"]),
    (&["figures", "--pixel", "400,0"], &["pixel (400, 0) lies beyond the picture of 320x180"]),
    (&["figures", "--pixel", "0,0"], &["the block at (0, 0) comes to no cell"]),
    (&["figures", "--pixel", "3"], &["expected X,Y"]),
    (&["figures", "--plan", "fast"], &["fast", "paper", "safe"]),
    (&["figures", "--out", "file"], &["`file`", "Not a directory"]),
    (&["claims", "nosuch"], &["nosuch", "1hvr"]),
    (&["claims", "adk"], &["the data of adk is absent", "tests/fetch-data"]),
    (&["claims", "nosuch", "--json", "file/claims.json"], &["`file/claims.json`", "Not a directory"]),
    (&["claims", "nosuch", "--markdown", "missing/claims.md"], &["`missing/claims.md`", "No such file"]),
    (&["claims", "--sample", "0"], &["--sample"]),
    // Usage.
    (&["render"], &["<SCENE>", "<FILE>"]),
    (&["--nosuch"], &["--nosuch", "--help"]),
    (&["--size", SMALL, "scenes"], &["scenes"]),
];

#[test]
fn what_is_wrong_is_said_and_ends_with_2() {
    let desk = Desk::new();
    let before = files(desk.0.path());
    for (words, wanted) in REFUSALS {
        let said = desk.run(words);
        assert_eq!(said.code, 2, "{words:?}: {}{}", said.out, said.err);
        assert_eq!(said.out, "", "{words:?}: a refusal belongs on standard error");
        assert!(
            !said.err.contains("warning:"),
            "{words:?}: a scene was begun before the refusal\n{}",
            said.err
        );
        for want in *wanted {
            assert!(said.err.contains(want), "{words:?}: {want:?} is not said in\n{}", said.err);
        }
        assert_told_once(words, &said.err);
        assert_eq!(files(desk.0.path()), before, "{words:?}: something was written");
    }
}

/// No cause is told twice, no name of a temporary file is told at all.
fn assert_told_once(words: &[&str], err: &str) {
    let lines: Vec<_> = err.lines().filter(|line| !line.trim().is_empty()).collect();
    let mut sorted = lines.clone();
    sorted.sort_unstable();
    sorted.dedup();
    assert_eq!(sorted.len(), lines.len(), "{words:?}: a line comes twice in\n{err}");
    assert!(err.matches("os error").count() <= 1, "{words:?}: the system is quoted twice in\n{err}");
    assert!(!err.contains(".cgt-"), "{words:?}: a temporary file is named in\n{err}");
}

/// A judge that is asked for and cannot be had leaves no verdict, and everything else is still told.
#[cfg(not(feature = "embree"))]
#[test]
fn a_needed_judge_that_is_missing_is_no_pass() {
    let desk = Desk::new();
    let words = ["1hvr", "--size", SMALL, "--subject", "naive-f64"];
    let plain = desk.run(&words);
    assert_eq!(plain.code, 0);
    assert!(plain.out.contains("Embree: not judged. It was not asked"), "{}", plain.out);
    let asked = desk.run(&[&words[..], &["--judges", "embree"]].concat());
    assert_eq!(asked.code, 3, "{}{}", asked.out, asked.err);
    assert!(asked.out.contains("Embree: not judged. This program was built without it"), "{}", asked.out);
    assert!(asked.out.contains("naive-f64"), "{}", asked.out);
    let wrong = desk.run(&["1hvr", "--size", "320x180", "--plan", "paper", "--judges", "embree"]);
    assert_eq!(wrong.code, 1, "a mismatch is worse than a missing judge");
}

// ---- what succeeds ----

#[test]
fn without_a_subcommand_it_verifies_the_bundled_molecule() {
    let desk = Desk::new();
    let said = desk.run(&["--size", SMALL, "--out", "report"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    assert_eq!(said.err, "", "nothing to warn of, and no bar where there is no terminal");
    let report = report(&desk.path("report"));
    assert_eq!(report["schema_version"], 4);
    assert_eq!(report["verdict"], "WithinBound");
    assert_eq!(report["environment"]["command_line"], format!("cgt --size {SMALL} --out report"));
    assert_eq!([&report["scenes"][0]["width"], &report["scenes"][0]["height"]], [64, 36]);
    assert_eq!(report["scenes"][0]["spheres"], 1_890);
    let page = std::fs::read_to_string(desk.path("report/report.html")).expect("a page");
    assert!(page.trim_end().ends_with("</html>"), "the page is whole");
    assert!(said.out.contains("report: report/report.html"), "{}", said.out);
    assert_table_agrees(&said.out, &report);
    let explicit = desk.run(&["verify", "1hvr", "--size", SMALL, "--out", "again"]);
    assert_eq!(
        without_times(&said.out, "report"),
        without_times(&explicit.out, "again"),
        "`verify` is the default"
    );
}

/// Every subject has one line with the report's numbers in it; the last line but one is the verdict.
fn assert_table_agrees(out: &str, report: &Value) {
    let mut judged = 0;
    for scene in report["scenes"].as_array().expect("scenes") {
        for subject in scene["subjects"].as_array().expect("subjects") {
            let comparison = &subject["comparison"];
            let counts = [&comparison["wrong_ids"], &comparison["wrong_t"], &comparison["wrong_color"]];
            let numbers = counts.map(|n| n.as_u64().expect("a count").to_string()).to_vec();
            let name = subject["name"].as_str().expect("a name");
            let line = out.lines().find(|line| line.split_whitespace().any(|word| word == name));
            let line = line.unwrap_or_else(|| panic!("{name} has no line in\n{out}"));
            // Thousands are set apart by narrow spaces, which split_ascii_whitespace does not split.
            let words: Vec<String> =
                line.split_ascii_whitespace().map(|w| w.replace('\u{202f}', "")).collect();
            let found = words.windows(numbers.len()).any(|window| window == numbers);
            assert!(found, "{name}: {numbers:?} are not in {line:?}");
            let verdict = subject["verdict"].as_str().expect("a verdict");
            assert!(words.concat().to_lowercase().contains(&verdict.to_lowercase()), "{verdict}: {line}");
            assert!(
                subject["because"].as_str().expect("a reason").ends_with('.'),
                "{name}: a whole sentence"
            );
            judged += 1;
        }
    }
    assert!(judged > 0, "nothing was judged");
}

/// The output without the column of speeds and the place of the report.
fn without_times(out: &str, folder: &str) -> Vec<String> {
    let table = out.replace(&format!("report: {folder}/"), "report: ");
    let fixed = |line: &str| match line.split_ascii_whitespace().count() {
        9.. => line.trim_end().rsplit_once(' ').map_or(line, |(rest, _)| rest).trim_end().to_owned(),
        _ => line.to_owned(),
    };
    table.lines().skip(1).map(fixed).collect()
}

#[test]
fn every_kind_of_scene_is_judged_and_agrees() {
    let desk = Desk::new();
    let scenes =
        ["2juy", "sphereflake:1", "sphereflake:3", "uniform:0", "uniform:1:1", "lattice:10", "clump:500:3"];
    let said = desk.run(&[&scenes[..], &["--size", SMALL]].concat());
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    let report = report(&desk.path("cgt-report"));
    let names: Vec<_> = report["scenes"].as_array().expect("scenes").iter().map(|s| &s["name"]).collect();
    assert_eq!(names, scenes);
    for (scene, name) in report["scenes"].as_array().expect("scenes").iter().zip(scenes) {
        assert_eq!(scene["subjects"].as_array().expect("subjects").len(), 5, "{name}");
        assert_eq!(scene["hits"].as_u64() > Some(0), name != "uniform:0", "{name}: {}", scene["hits"]);
    }
}

#[test]
fn the_first_wrong_pixel_is_told_with_a_command_that_comes_to_it_again() {
    let desk = Desk::new();
    let words = [
        "two words.xyz",
        "--size",
        SMALL,
        "--eye",
        "0.1,-0.25,7",
        "--fov",
        "30",
        "--subject",
        "naive-f32-textbook",
    ];
    assert_eq!(desk.run(&words).code, 0);
    let account = |report: &Value| report["scenes"][0]["subjects"][0]["first_wrong"].clone();
    let first = account(&report(&desk.path("cgt-report")));
    let told = first.as_str().expect("the textbook form is never all equal here").to_owned();
    let labels: Vec<_> = told.lines().map(|line| line.split(' ').next().unwrap_or_default()).collect();
    assert_eq!(labels, ["pixel", "eye", "direction", "truth", "subject", "replay"]);
    let replay = replay(&told);
    let mut shell = desk.command("sh");
    let said = desk.finish(shell.args(["-c", &format!("\"$0\" {replay} --out replayed"), CGT]));
    assert_eq!(said.code, 0, "{replay}: {}", said.err);
    assert_eq!(account(&report(&desk.path("replayed"))), first);
}

/// The command in an account.
fn replay(told: &str) -> &str {
    told.lines().last().and_then(|line| line.strip_prefix("replay     cgt ")).expect("a command")
}

/// It has the frame, the whole view, and of the grid tracer the plan, the level of many and the cells: typed again, it comes to the same
/// account, of that tracer alone.
#[test]
fn an_account_says_what_comes_to_it_again() {
    let desk = Desk::new();
    let view = "--size 64x36 --eye 0,-60,5 --target 1,2,3 --up 0,0.3,1 --fov 40";
    let words = format!("verify 2juy --frame 3 --plan paper --level all --grid 7 {view}");
    assert_eq!(desk.run(&words.split(' ').collect::<Vec<_>>()).code, 1, "the paper's plan is wrong there");
    let all = report(&desk.path("cgt-report"));
    for subject in all["scenes"][0]["subjects"].as_array().expect("subjects").iter().take(2) {
        let told = subject["first_wrong"].as_str().expect("an account");
        let replay = replay(told);
        let said = desk.run(&format!("{replay} --out again").split(' ').collect::<Vec<_>>());
        assert_eq!(said.code, 1, "{replay}: {}{}", said.out, said.err);
        let again = report(&desk.path("again"));
        assert_eq!(again["scenes"][0]["subjects"].as_array().map(Vec::len), Some(1), "{replay}: one tracer");
        let again = again["scenes"][0]["subjects"][0].clone();
        assert_eq!(again["first_wrong"].as_str(), Some(told), "{replay}");
        // The tracer itself, not one that happens to be wrong in the same way.
        let level = subject["name"].as_str().and_then(|name| name.strip_prefix("paper@")).expect("a level");
        assert!(replay.contains(&format!("--plan paper --level {level} --grid 7")), "{replay}");
        assert_eq!(again["description"], subject["description"], "{replay}");
    }
}

#[test]
fn a_cut_frame_costs_that_frame_only_and_is_said() {
    let desk = Desk::new();
    let said = desk.run(&["cut.xyz", "--size", SMALL]);
    assert_eq!(said.code, 0, "{}", said.err);
    assert_eq!(said.err.matches("cut.xyz").count(), 1, "{}", said.err);
    for want in ["warning: cut.xyz:5: ", "ends within frame 1", "1 complete kept"] {
        assert!(said.err.contains(want), "{want:?} is not said in {}", said.err);
    }
    let report = report(&desk.path("cgt-report"));
    assert_eq!(report["scenes"][0]["frames"], 1);
    assert_eq!(report["scenes"][0]["warnings"].as_array().map(Vec::len), Some(1));
    assert_eq!(desk.run(&["cut.xyz", "--size", SMALL, "--frame", "1"]).code, 2);
}

#[test]
fn pictures_can_be_decoded() {
    let desk = Desk::new();
    for (file, method) in [("a.png", "exact"), ("b.PNG", "safe"), ("c.exr", "exact"), ("d.exr", "naive-f64")]
    {
        let said = desk.run(&["render", "1hvr", file, "--method", method, "--size", SMALL]);
        assert_eq!((said.code, said.out), (0, format!("wrote {file}\n")), "{}", said.err);
    }
    for file in ["a.png", "b.PNG"] {
        let bytes = std::fs::read(desk.path(file)).expect("written");
        let picture =
            image::load_from_memory_with_format(&bytes, image::ImageFormat::Png).expect("a PNG").to_rgba8();
        assert_eq!(picture.dimensions(), (64, 36));
        let first = picture.get_pixel(0, 0);
        assert!(picture.pixels().any(|pixel| pixel != first), "{file}: one colour all over");
    }
    for file in ["c.exr", "d.exr"] {
        use exr::prelude::*;
        let read = read_all_flat_layers_from_file(desk.path(file)).expect("an EXR");
        assert_eq!(read.attributes.display_window.size, Vec2(64, 36), "{file}");
        let channels = read.layer_data.iter().flat_map(|layer| &layer.channel_data.list);
        assert!(channels.count() >= 5, "{file}: colour, id and t");
    }
    assert_eq!(
        std::fs::read(desk.path("c.exr")).ok(),
        std::fs::read(desk.path("d.exr")).ok(),
        "f64 is exact here"
    );
}

/// Each chapter by itself: a page, data and a table.
fn chapters_alone(desk: &Desk) {
    let tiny = ["--size", "48x27", "--rounds", "1", "--threads", "1"];
    let made = |name: &str, words: &[&str], wants: &[&str]| {
        let met = desk.run(&[words, &["--out", name][..]].concat());
        assert_eq!((met.code, met.err.as_str()), (0, ""), "{name}: {}", met.out);
        for want in wants {
            assert!(met.out.contains(want), "{want} is not told: {}", met.out);
        }
        for kind in ["html", "json", "csv"] {
            let file = desk.path(name).join(format!("{name}.{kind}"));
            assert!(file.metadata().is_ok_and(|file| file.len() > 500), "{}", file.display());
        }
    };
    let chart = ["chart", "uniform:50:1", "--far", "1,100"];
    made("chart", &[&chart[..], &tiny[..]].concat(), &["naive-f32-textbook", "radii away", "page: "]);
    made(
        "stability",
        &["stability", "uniform:50:1", "--rays", "64"],
        &["Distance of the eye", "never", "page: "],
    );
    made(
        "ablation",
        &[&["ablate", "uniform:50:1", "--sample", "64"][..], &tiny[..]].concat(),
        &["for", "culling", "times the time"],
    );
}

/// Each chapter by itself, and all on one page: files, exit codes, and what is on the terminal.
#[test]
fn charts_maps_and_the_report_are_made() {
    let desk = &Desk::new();
    let report =
        ["report", "uniform:50:1", "--film", "none", "--rays", "64", "--rounds", "1", "--size", "48x27"];
    let report = &[&report[..], &["--skip", "proofs,bench,figures", "--out", "all"][..]].concat();
    // The longest, beside the others.
    let met = std::thread::scope(|scope| {
        let whole = scope.spawn(move || desk.run(report));
        chapters_alone(desk);
        whole.join().expect("it runs")
    });
    assert_eq!(met.code, 0, "{}{}", met.out, met.err);
    let page = std::fs::read_to_string(desk.path("all").join("report.html")).expect("there is a page");
    for chapter in ["advice", "chart", "stability", "ablation", "paper", "spu"] {
        assert!(page.contains(&format!("<section id=\"{chapter}\"")), "{chapter} is no chapter");
    }
    assert!(
        met.out.contains("Embree: not judged") && page.contains("<b>Embree: not judged.</b>"),
        "{}",
        met.out
    );
    assert!(!page.contains("<section id=\"proofs\"") && page.contains("shown as a known fault"));
    assert!(page.contains("frames of 48 × 27 pixels"), "claims of other frames than were asked for");
    for name in ["chart.csv", "stability.json", "ablation.csv", "report.json"] {
        assert!(desk.path("all").join(name).is_file(), "{name}");
    }
    let data = std::fs::read(desk.path("all").join("chart.json")).expect("there is data");
    let chart: Value = serde_json::from_slice(&data).expect("it is JSON");
    let views = chart["views"].as_array().expect("views");
    let asked = |view: &Value| view["size"] == serde_json::json!([48, 27]);
    assert!(
        !views.is_empty() && views.iter().all(asked),
        "charts of another size than was asked for: {chart:#}"
    );
    // A frame of so few pixels takes the model a hundredth of one of 1280x720, of which it makes less than 200 a second.
    let data = std::fs::read(desk.path("all").join("ablation.json")).expect("there is data");
    let ablation: Value = serde_json::from_slice(&data).expect("it is JSON");
    let rate = &ablation["model"][0]["frames_per_second"][0][1][0];
    assert!(
        rate.as_f64().is_some_and(|rate| rate > 2000.0),
        "a model of other frames than were asked for: {rate}"
    );
    // A film on one page.
    let met =
        desk.run(&["verify", "2juy", "--frames", "3..5", "--plan", "fast", "--size", SMALL, "--out", "film"]);
    assert_eq!(met.code, 0, "{}{}", met.out, met.err);
    let page = std::fs::read_to_string(desk.path("film").join("report.html")).expect("there is a page");
    assert!(
        page.contains("data-frame=\"3\"") && page.contains("data-frame=\"4\"") && met.out.contains("#3-4")
    );
}

#[test]
fn help_is_enough_for_a_stranger() {
    let desk = Desk::new();
    let help = desk.run(&["--help"]);
    assert_eq!((help.code, help.err.as_str()), (0, ""));
    for want in [
        "Exit codes",
        "report.html",
        "cgt scenes",
        "1hvr",
        "render",
        "--size",
        "--subject",
        "--judges",
        "safe",
    ] {
        assert!(help.out.contains(want), "{want:?} is not in the help");
    }
    for code in 0..=3 {
        assert!(
            help.out.lines().any(|line| line.starts_with(&format!("  {code}  "))),
            "code {code} is not told"
        );
    }
    for command in [
        "verify",
        "render",
        "scenes",
        "replay",
        "chart",
        "stability",
        "ablate",
        "report",
        "figures",
        "claims",
        "view",
    ] {
        let help = desk.run(&[command, "--help"]);
        assert_eq!(help.code, 0, "{command}");
        assert!(help.out.contains("Usage: cgt"), "{command}");
    }
    let version = desk.run(&["--version"]);
    assert_eq!((version.code, version.out), (0, format!("cgt {}\n", env!("CARGO_PKG_VERSION"))));
}

/// Shells and `man` learn of every subcommand and its options.
#[test]
fn shells_and_man_know_all_of_it() {
    let desk = Desk::new();
    let help = desk.run(&["--help"]).out;
    let listed = help.split("Commands:").nth(1).and_then(|text| text.split("\n\n").next()).expect("commands");
    let names: Vec<&str> =
        listed.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next()).collect();
    let names: Vec<&str> = names.into_iter().filter(|name| !["", "help"].contains(name)).collect();
    assert!(names.contains(&"verify") && names.contains(&"replay") && names.len() > 10, "{names:?}");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = desk.run(&["completions", shell]);
        assert_eq!((script.code, script.err.as_str()), (0, ""), "{shell}");
        let missing: Vec<_> = names.iter().filter(|name| !script.out.contains(**name)).collect();
        assert!(missing.is_empty(), "{shell} does not know {missing:?}");
        assert!(script.out.contains("subject-cmd"), "{shell}");
    }
    let parsed = Command::new("bash").arg("-n").stdin(Stdio::piped()).spawn().and_then(|mut bash| {
        let script = desk.run(&["completions", "bash"]).out;
        bash.stdin.take().map_or(Ok(()), |mut stdin| stdin.write_all(script.as_bytes()))?;
        bash.wait()
    });
    assert!(parsed.is_ok_and(|status| status.success()), "bash cannot read its completions");
    let pages = desk.run(&["man", "man1"]);
    assert_eq!((pages.code, pages.err.as_str()), (0, ""));
    for name in &names {
        let page = std::fs::read_to_string(desk.path(&format!("man1/cgt-{name}.1"))).expect("a page");
        assert!(page.contains(&format!(".TH cgt-{name} 1")), "{name}: {page:.200}");
        assert!(page.contains("DESCRIPTION") && page.contains("SYNOPSIS"), "{name}");
    }
    let page = std::fs::read_to_string(desk.path("man1/cgt.1")).expect("a page");
    assert!(page.contains("Exit codes"), "{page}");
    assert_eq!(files(&desk.path("man1")).len(), names.len() + 1);
}

/// A committed case: as it should be, with a pixel of choice, made smaller, kept; and what is no case, or no pixel of it.
#[test]
fn a_case_is_replayed_step_by_step() {
    let desk = Desk::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/cases");
    let case = folder.join("paper-to-the-letter.json").display().to_string();
    let said = desk.run(&["replay", &case]);
    assert_eq!((said.code, said.err.as_str()), (0, ""), "{}", said.out);
    for word in ["pixel      (", "frustum    along", "slice", "met        0 times", "Wrong, as it should be"]
    {
        assert!(said.out.contains(word), "no `{word}` in\n{}", said.out);
    }
    for (name, words) in [
        ("touches-a-plane.json", ["culling: kept", "relations  hold", "Equal, as it should be"]),
        (
            "paper-queue-overflows.json",
            ["culling: dropped", "sphere 17 pushed out sphere 0", "Wrong, as it should be"],
        ),
        ("block-is-split.json", ["each goes as a packet of its own", "culling: dropped", "as it should be"]),
    ] {
        let met = desk.run(&["replay", &folder.join(name).display().to_string()]);
        assert_eq!((met.code, met.err.as_str()), (0, ""), "{name}: {}", met.out);
        for word in words {
            assert!(met.out.contains(word), "no `{word}` in\n{}", met.out);
        }
    }
    let chosen = desk.run(&["replay", &case, "--pixel", "0,0", "--shrink", "--out", "kept"]);
    assert_eq!(chosen.code, 0, "{}{}", chosen.out, chosen.err);
    assert!(
        chosen.out.contains("pixel      (0, 0) of frame 0") && chosen.out.contains("shrunk     to"),
        "{}",
        chosen.out
    );
    let kept = desk.path("kept/paper-to-the-letter.json").display().to_string();
    assert_eq!(desk.run(&["replay", &kept]).code, 0);
    // The same scene held to what it does not do.
    let text = std::fs::read_to_string(&case).expect("a case").replace("\"wrong\"", "\"equal\"");
    std::fs::write(desk.path("held.json"), text).expect("written");
    let held = desk.run(&["replay", "held.json"]);
    assert_eq!(held.code, 1, "{}{}", held.out, held.err);
    assert!(held.out.contains("Wrong, NOT as it should be (Equal)"), "{}", held.out);
    // Of who refuses what the scene does, and may, nothing can be said.
    let text = std::fs::read_to_string(folder.join("queue-falls-back.json")).expect("a case");
    let text = text.replace("\"fall back\"", "\"refuse\"");
    std::fs::write(desk.path("refuses.json"), text).expect("written");
    let refused = desk.run(&["replay", "refuses.json"]);
    assert_eq!(refused.code, 3, "{}{}", refused.out, refused.err);
    assert!(refused.out.contains("frame 0 was refused: "), "{}", refused.out);
    assert!(refused.out.ends_with(", as its plan says\n"), "{}", refused.out);
    for (words, why) in [
        (vec!["replay", &case, "--pixel", "99,0"], "lies beyond the picture"),
        (vec!["replay", &case, "--pixel", "9"], "expected X,Y"),
        (vec!["replay", &case, "--frame", "7"], "not 7"),
        (vec!["replay", "cut.xyz"], "`cut.xyz`:"),
        (vec!["replay", "nowhere.json"], "`nowhere.json`:"),
    ] {
        let said = desk.run(&words);
        assert_eq!(said.code, 2, "{words:?}");
        assert!(said.err.contains(why), "{words:?}: {}", said.err);
    }
}

#[test]
fn every_named_scene_is_listed_and_absent_data_is_marked() {
    let said = Desk::new().run(&["scenes"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    let entries = verify::scenes::catalogue::ENTRIES;
    for entry in entries {
        let line =
            said.out.lines().find(|line| line.starts_with(&format!("{} ", entry.name))).expect(entry.name);
        let bundled = matches!(entry.data, verify::scenes::catalogue::Data::Bundled(..));
        assert_eq!(line.contains("(absent)"), !bundled, "{line}");
    }
    for want in ["uniform:COUNT:SEED", ".lammpstrj", "tests/fetch-data"] {
        assert!(said.out.contains(want), "{want:?} is not listed");
    }
}

/// A scene so small that f32 underflows: the naive f32 tracers state nothing there, and that is no pass.
#[test]
fn what_a_tracer_states_nothing_of_ends_with_3() {
    let desk = Desk::new();
    let sphere = contract::Sphere { center: [0.0; 3], radius: 1e-30, color: [200; 3] };
    let scene = contract::Scene::new(vec![sphere], [0; 3], contract::DEFAULT_LIGHT).expect("valid");
    let json = verify::scenes::write::json(&scene.into(), None);
    std::fs::write(desk.path("tiny.json"), json).expect("a temporary folder");
    let said = desk.run(&["tiny.json", "--size", SMALL, "--out", "report"]);
    assert_eq!(said.code, 3, "{}{}", said.out, said.err);
    let report = report(&desk.path("report"));
    assert_eq!(report["verdict"], "Undecidable");
    let subjects = report["scenes"][0]["subjects"].as_array().expect("subjects");
    let verdict = |name: &str| &subjects.iter().find(|s| s["name"] == name).expect("judged")["verdict"];
    assert_eq!(verdict("naive-f64"), "Equal");
    assert_eq!(verdict("naive-f32-textbook"), "Undecidable");
    let skip = ["--film", "none", "--skip", "methods,ablation,paper,figures,bench,proofs"];
    let said = desk.run(&[&["report", "tiny.json", "--size", SMALL, "--out", "all"][..], &skip].concat());
    assert_eq!(said.code, 3, "{}{}", said.out, said.err);
}

/// The paper's plan is wrong, says why, and ends with 1.
#[test]
fn the_papers_plan_ends_with_1_and_says_why() {
    let desk = Desk::new();
    let said = desk.run(&["1hvr", "--plan", "paper", "--size", "320x180", "--out", "report"]);
    assert_eq!(said.code, 1, "{}{}", said.out, said.err);
    let report = report(&desk.path("report"));
    let because = report["scenes"][0]["subjects"][0]["because"].as_str().expect("a reason");
    for want in ["pushes onto full queues", "more than two cells on an axis", "differ from the naive picture"]
    {
        assert!(because.contains(want), "{because}");
    }
}

/// All levels are judged side by side, each under its name.
#[test]
fn all_levels_are_judged() {
    let desk = Desk::new();
    let said = desk.run(&["1hvr", "--plan", "safe", "--level", "all", "--size", SMALL, "--out", "report"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    for level in optimized::Level::available() {
        assert!(said.out.contains(&format!("safe@{level}")), "{level}: {}", said.out);
    }
}

#[test]
fn a_level_that_is_not_there_is_refused() {
    let desk = Desk::new();
    for words in
        [&["1hvr", "--size", SMALL, "--out", "report"][..], &["render", "1hvr", "x.png", "--method", "safe"]]
    {
        let said = desk.finish(desk.command(CGT).args(words).env("CGT_LEVEL", "abacus"));
        assert_eq!((said.code, said.err.contains("abacus")), (2, true), "{}", said.err);
        assert!(!desk.path("x.png").exists() && !desk.path("report").exists());
    }
}

#[test]
fn the_report_names_the_level_that_was_used() {
    let desk = Desk::new();
    let verify = ["1hvr", "--size", SMALL, "--subject", "safe"];
    let said = desk.finish(desk.command(CGT).args(verify).env("CGT_LEVEL", "scalar"));
    assert_eq!(said.code, 0, "{}", said.err);
    assert_eq!(report(&desk.path("cgt-report"))["environment"]["simd"], "scalar");
}

// ---- places that fail ----

#[cfg(unix)]
#[test]
fn a_read_only_place_is_refused_before_anything_is_rendered() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    std::fs::create_dir(desk.path("locked")).expect("made");
    std::fs::set_permissions(desk.path("locked"), PermissionsExt::from_mode(0o555)).expect("locked");
    // To root a folder without write permission is as good as any; the kernel's own folders are not.
    let mut places = vec!["/proc".to_owned(), "/sys".to_owned()];
    places.retain(|place| Path::new(place).is_dir());
    if std::fs::write(desk.path("locked/x"), "").is_err() {
        places.push("locked".into());
    }
    if places.is_empty() {
        _ = writeln!(std::io::stderr(), "not judged: writing into a read-only place: none was found");
    }
    for place in places {
        // Only the look at the place before rendering says the first, and only one before the scene's the second.
        for (words, wanted) in [
            (
                vec!["1hvr", "--size", SMALL, "--out", &format!("{place}/report")],
                "cannot write into the folder",
            ),
            (vec!["render", "nosuch", &format!("{place}/x.png")], "cannot make a file in the folder"),
        ] {
            let said = desk.run(&words);
            assert_eq!((said.code, said.out.as_str()), (2, ""), "{words:?}: {}", said.err);
            assert!(said.err.contains(wanted), "{words:?}: {}", said.err);
        }
    }
}

/// A limit on the size of files stands for a full disk: the first bytes are taken, the rest is not.
#[cfg(unix)]
#[test]
fn a_disk_that_fills_up_leaves_nothing_half_written() {
    let desk = Desk::new();
    std::fs::write(desk.path("old.exr"), "what was there").expect("written");
    let limited = |words: &str| {
        let script = format!("trap '' XFSZ; ulimit -f 8 && exec \"$0\" {words}");
        desk.finish(desk.command("sh").args(["-c", &script, CGT]))
    };
    let said = limited("render 1hvr old.exr --size 640x360 --method safe");
    assert_eq!(said.code, 2, "{}", said.err);
    assert!(said.err.contains("cannot write the") && said.err.contains("`old.exr`"), "{}", said.err);
    assert_eq!(std::fs::read(desk.path("old.exr")).ok().as_deref(), Some(&b"what was there"[..]));
    let said = limited(&format!("1hvr --size {SMALL} --subject safe --out report"));
    assert_eq!((said.code, said.out.as_str()), (2, ""), "{}", said.err);
    for path in files(&desk.path("report")) {
        let whole = image::open(&path).is_ok();
        assert!(whole, "{} is neither whole nor absent", path.display());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error_and_a_closed_one_is_not() {
    let desk = Desk::new();
    for words in ["scenes".to_owned(), format!("1hvr --size {SMALL} --subject safe")] {
        let said = desk.finish(desk.command("sh").args(["-c", &format!("\"$0\" {words} >/dev/full"), CGT]));
        assert_eq!(said.code, 2, "{words}: {}", said.err);
        assert!(said.err.contains("standard output: No space left"), "{words}: {}", said.err);
        let script = format!("{{ \"$0\" {words}; echo $? >code; }} | true; cat code");
        let said = desk.finish(desk.command("sh").args(["-c", &script, CGT]));
        assert_eq!((said.out.as_str(), said.err.as_str()), ("0\n", ""), "{words}: into a closed pipe");
    }
}

// ---- figures and claims ----

/// Four files and a page, whole and each with the figure that the program's words tell of; written again they take the old ones' place.
#[test]
fn figures_are_files_and_a_page() {
    let desk = Desk::new();
    let words = ["figures", "uniform:300:1", "--size", "96x54", "--out", "drawn"];
    for time in 0..2 {
        let said = desk.run(&words);
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{}", said.out);
        let mut names: Vec<String> = files(&desk.path("drawn")).iter().map(|path| name(path)).collect();
        names.sort_unstable();
        assert_eq!(
            names,
            ["corners.svg", "figures.html", "frustum.svg", "loops.svg", "screen.svg"],
            "{time}"
        );
        let page = std::fs::read_to_string(desk.path("drawn/figures.html")).expect("a page");
        assert_eq!((page.matches("<svg").count(), page.matches("</svg>").count()), (4, 4));
        assert!(page.contains("--size 96x54"), "the page tells its command line");
        for figure in ["screen", "frustum", "loops", "corners"] {
            let svg = std::fs::read_to_string(desk.path(&format!("drawn/{figure}.svg"))).expect("a file");
            assert!(svg.contains("prefers-color-scheme: dark") && svg.ends_with("</svg>\n"), "{figure}");
            assert!(said.out.contains(&format!("{figure}.svg: ")), "{}", said.out);
        }
    }
}

/// Claims on the terminal, as data and as a table, which all say the same; of the scenes of choice the absent ones are named, and are no pass.
#[test]
fn claims_are_judged_anew() {
    let desk = Desk::new();
    let words =
        ["claims", "uniform:200:1", "--size", "64x36", "--json", "claims.json", "--markdown", "claims.md"];
    let said = desk.run(&words);
    // Without a solver on the path some claims are not judged.
    let code = if said.out.contains("not judged: proofs: no solver was found") { 3 } else { 0 };
    assert_eq!((said.code, said.err.as_str()), (code, ""), "{}", said.out);
    let text = std::fs::read_to_string(desk.path("claims.json")).expect("a file");
    let record: Value = serde_json::from_str(&text).expect("JSON");
    let table = std::fs::read_to_string(desk.path("claims.md")).expect("a file");
    let claims = record["claims"].as_array().expect("claims");
    assert!(claims.len() >= 40 && said.out.contains(&format!("CGT_SEED={}\n", record["seed"])));
    let rows = table.lines().filter(|line| line.starts_with("| ")).count();
    assert_eq!(rows, claims.len() + 1);
    for claim in claims {
        let statement = claim["statement"].as_str().expect("a statement");
        assert!(table.contains(&format!("| {statement} |")), "{statement}");
    }
    let absent = desk.run(&["claims", "--size", "4x4", "--sample", "1000"]);
    assert_eq!(absent.code, 3, "{}", absent.err);
    assert!(
        absent.out.starts_with("not judged: adk: data absent (run tests/fetch-data)\n"),
        "{}",
        absent.out
    );
}

// ---- proofs ----

/// Without a solver nothing is proved, and that is said; but what a solver would get is written all the same.
#[test]
fn without_a_solver_nothing_is_proved() {
    let desk = Desk::new();
    let mut command = desk.command(CGT);
    command.env("PATH", "").env_remove("CGT_SOLVERS");
    let said = desk.finish(command.args(["prove", "walk", "--smt", "smt", "--json", "prove.json"]));
    assert_eq!(said.code, 3, "{}{}", said.out, said.err);
    assert!(said.out.contains("not judged: no solver was found"), "{}", said.out);
    assert!(!said.out.contains("proved") && !said.out.contains("refuted"), "{}", said.out);
    // Nor do the paper's claims say so.
    let mut command = desk.command(CGT);
    command.env("PATH", "").env_remove("CGT_SOLVERS");
    let claims = desk.finish(command.args(["claims", "uniform:20:1", "--size", "16x8"]));
    assert_eq!(claims.code, 3, "{}{}", claims.out, claims.err);
    assert!(claims.out.contains("not judged: proofs: no solver was found"), "{}", claims.out);
    assert!(claims.out.lines().all(|line| line.get(23..29) != Some("proved")), "{}", claims.out);
    assert_eq!(claims.out.matches("not proved in this run").count(), 4, "{}", claims.out);
    let found: Value = serde_json::from_slice(&std::fs::read(desk.path("prove.json")).expect("it is there"))
        .expect("it is JSON");
    assert_eq!(found["lemmas"][0]["name"], "walk.successor");
    assert_eq!(found["lemmas"][0]["outcome"], "not-judged");
    let text = std::fs::read_to_string(desk.path("smt/walk.successor.smt2")).expect("it is there");
    assert!(text.starts_with("; in0 is slice\n") && text.contains("\n(check-sat)\n"), "{text}");
    assert_eq!(files(&desk.path("smt")).len(), found["lemmas"].as_array().expect("a list").len());
}

/// A program that is called as a solver is and says the same to all questions, in a folder of its own.
#[cfg(unix)]
fn liar(desk: &Desk, says: &str) -> PathBuf {
    use std::os::unix::fs::PermissionsExt;
    let folder = desk.path(&format!("who says {says}"));
    std::fs::create_dir(&folder).expect("a folder is made");
    let text = format!("#!/bin/sh\ncase $1 in --version) echo z3 0.0 ;; *) echo {says} ;; esac\n");
    std::fs::write(folder.join("z3"), text).expect("written");
    let mode = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(folder.join("z3"), mode).expect("it may run");
    folder
}

/// A solver that does not know leaves everything open, one that says yes to everything is caught: neither ends as a proof does.
#[cfg(unix)]
#[test]
fn a_solver_that_lies_or_does_not_know_proves_nothing() {
    let desk = Desk::new();
    for (says, code, word) in [("unknown", 3, "not shown"), ("unsat", 1, "WRONG")] {
        let liar = liar(&desk, says);
        // Nor are the paper's claims any better for it.
        let mut command = desk.command(CGT);
        command.env("PATH", "").env("CGT_SOLVERS", &liar);
        let said = desk.finish(command.args(["claims", "uniform:20:1", "--size", "16x8"]));
        let line = format!("{}: cell.corners.below: ", if code == 3 { "not judged" } else { "WRONG" });
        assert!(
            said.code == code && said.out.contains(&line),
            "{says}: {} {}{}",
            said.code,
            said.out,
            said.err
        );
        let mut command = desk.command(CGT);
        command.env("PATH", "").env("CGT_SOLVERS", liar);
        let met = desk.finish(command.args(["prove", "walk"]));
        assert_eq!(met.code, code, "{says}: {}{}", met.out, met.err);
        assert!(met.out.contains(word), "{says}: {}", met.out);
        let begins = |word: &str| met.out.lines().any(|line| line.starts_with(word));
        assert!(says != "unknown" || (begins("not shown") && !begins("proved")), "{says}: {}", met.out);
    }
}

/// What a chapter finds wrong is the report's verdict, and is told, though every picture is right.
#[cfg(unix)]
#[test]
fn a_report_is_as_wrong_as_its_chapters() {
    let desk = Desk::new();
    let mut command = desk.command(CGT);
    command.env("PATH", "").env("CGT_SOLVERS", liar(&desk, "unsat"));
    let words = ["report", "uniform:50:1", "--film", "none", "--rounds", "1", "--size", "48x27"];
    let skip = ["--skip", "methods,ablation,paper", "--out", "all"];
    let met = desk.finish(command.args(words).args(skip));
    assert_eq!(met.code, 1, "{}{}", met.out, met.err);
    assert!(met.out.contains("Wrong where it promised not to be"), "{}", met.out);
    let page = std::fs::read_to_string(desk.path("all").join("report.html")).expect("there is a page");
    for chapter in ["figures", "bench", "proofs"] {
        assert!(page.contains(&format!("<section id=\"{chapter}\"")), "{chapter} is no chapter");
    }
}

// ---- how much it can hold ----

/// Ten million spheres, a minute and about a gigabyte: with `CGT_LONG=1`.
#[test]
fn ten_million_spheres_are_judged() {
    if std::env::var_os("CGT_LONG").is_none_or(|value| value != "1") {
        _ = writeln!(std::io::stderr(), "not judged: ten million spheres (set CGT_LONG=1)");
        return;
    }
    let desk = Desk::new();
    let said = desk.run(&["verify", "uniform:10000000:1", "--size", SMALL, "--subject", "safe"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    assert_eq!(report(&desk.path("cgt-report"))["scenes"][0]["spheres"], 10_000_000);
}
