//! Is a campaign the same however it is divided and however often it is killed? Shards are put together for several N, killed and taken up again, cut in
//! any byte, left out, and given twice.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;
use verify::campaign::merge::{MergeError, Outcome, merge, status};
use verify::campaign::plan::{Plan, PlanError, Unit};
use verify::campaign::shard::{ShardError, Which, read, run};
use verify::campaign::text::{bin, text};
use verify::campaign::unit::Bench;
use verify::case::{Case, worst};
use verify::properties::Property;
use verify::subject::Rounding;
use verify::verdict::Verdict;

use contract::{DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
use optimized::Level;
use reference::{Arithmetic, Tracer};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;

const CGT: &str = env!("CARGO_BIN_EXE_cgt");

/// Small, with something of each kind: seven units, two of them not full.
const PLAN: &str = r#"
name = "small"
seed = 7
[[draw]]
property = "pictures"
cases = 300
[[draw]]
property = "certain"
cases = 20
[[film]]
scene = "2juy"
frames = "3..7"
size = "40x24"
subjects = ["fast", "naive-f32-textbook"]
[least]
"pictures: rays" = 1000
"#;

fn plan() -> Plan {
    Plan::parse(PLAN).expect("a plan")
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn which(text: &str) -> Which {
    text.parse().expect("a shard")
}

fn done(plan: &Plan, shard: &str, folder: &Path) -> PathBuf {
    run(plan, which(shard), Level::SCALAR, folder, &|_, _| ()).expect("it is done")
}

fn all(plan: &Plan, of: u64) -> TempDir {
    let folder = folder();
    // Not in their order.
    for shard in (1..=of).rev() {
        done(plan, &format!("{shard}/{of}"), folder.path());
    }
    folder
}

fn places(folder: &TempDir) -> Vec<PathBuf> {
    vec![folder.path().to_path_buf()]
}

fn cgt(words: &[&str]) -> Output {
    Command::new(CGT).args(words).output().expect("it runs")
}

fn said(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// How far the naive f32 tracer is off in any pixel of that frame of the plan's film, in units in the last place.
fn largest_error(frame: usize) -> u64 {
    let loaded = Source::parse("2juy").and_then(|source| source.load()).expect("it is bundled");
    let size = Some(Size::new(40, 24).expect("small"));
    let camera = loaded.camera(&Framing { size, ..Framing::default() }).expect("not degenerate");
    let scene = &loaded.animation.frames()[frame];
    let by = |arithmetic: Arithmetic| Tracer::new(arithmetic).render(scene, &camera).expect("small").image;
    let (truth, naive) = (by(Arithmetic::Exact), by(Rounding::TextbookF32.naive()));
    let both = (0..truth.t.len()).filter(|i| truth.ids[*i] == naive.ids[*i] && truth.ids[*i] != MISS);
    let apart = both.map(|i| u64::from(truth.t[i].to_bits().abs_diff(naive.t[i].to_bits())));
    apart.max().expect("something is seen")
}

#[test]
fn shards_of_any_number_are_one_run() {
    let plan = plan();
    let units: Vec<Unit> = plan.units().collect();
    assert_eq!(units.len(), 7);
    // 300 cases are 19 chunks of 16.
    assert_eq!(units[1], Unit::Drawn(Property::Pictures, 16..19));
    assert_eq!(units[6], Unit::Frame(0, 6));
    let one = all(&plan, 1);
    let whole = merge(&plan, &places(&one)).expect("all are there");
    assert_eq!(whole.outcome, Outcome::Held, "{}", text(&whole));
    assert_eq!(whole.counts["fast on 2juy: frames equal to the truth"], 4);
    assert_eq!(whole.counts["fast on 2juy: rays"], 4 * 40 * 24);
    assert!(whole.counts["pictures: hits"] > 1000, "{}", text(&whole));
    let errors = &whole.histograms["naive-f32-textbook on 2juy: largest error of t in a frame, ulp"];
    // Bin 0 has 0, bin k what has k binary digits; the last bin is not empty.
    let mut bins = vec![0; errors.len()];
    for largest in (3..7).map(largest_error) {
        bins[(u64::BITS - largest.leading_zeros()) as usize] += 1;
    }
    assert!(*errors == bins && bins.last() > Some(&0) && bins.len() > 4, "{errors:?}, not {bins:?}");
    let shown = (serde_json::to_string(&whole).expect("JSON"), text(&whole));
    for of in [2, 3, 7, 9] {
        let shards = all(&plan, of);
        let merged = merge(&plan, &places(&shards)).expect("all are there");
        assert_eq!((serde_json::to_string(&merged).expect("JSON"), text(&merged)), shown, "{of} shards");
        // Files by themselves, in another order and from different places.
        let mut files: Vec<PathBuf> =
            (1..=of).map(|shard| which(&format!("{shard}/{of}")).file(shards.path())).collect();
        let elsewhere = folder();
        let moved = elsewhere.path().join("one.jsonl");
        std::fs::rename(&files[0], &moved).expect("moved");
        files[0] = moved;
        files.reverse();
        assert_eq!(merge(&plan, &files).expect("all are there"), merged, "{of} shards");
    }
    eprintln!("judged: {} units in 1, 2, 3, 7 and 9 shards", whole.units);
}

#[test]
fn what_is_missing_or_double_or_of_something_else_is_refused() {
    let plan = plan();
    let shards = all(&plan, 3);
    let file = |shard: &str| which(shard).file(shards.path());
    // One is missing; then it is at work.
    let aside = folder();
    let moved = aside.path().join("two.jsonl");
    std::fs::rename(file("2/3"), &moved).expect("moved");
    let missing = |error| match error {
        MergeError::Missing { count: 2, of: 7, first: 1, shard, at_work } if shard == "2/3" => at_work,
        other => panic!("{other}"),
    };
    assert!(!missing(merge(&plan, &places(&shards)).expect_err("one is missing")));
    std::fs::write(which("2/3").part(shards.path()), b"").expect("written");
    assert!(missing(merge(&plan, &places(&shards)).expect_err("one is at work")));
    std::fs::remove_file(which("2/3").part(shards.path())).expect("removed");
    // It comes back, twice.
    let mut twice = places(&shards);
    twice.extend([moved.clone(), file("1/3")]);
    assert!(matches!(merge(&plan, &twice), Err(MergeError::Double { unit: 0, .. })));
    let mut back = places(&shards);
    back.push(moved.clone());
    assert!(merge(&plan, &back).is_ok());
    // Of shards of another division some units are double.
    let halves = all(&plan, 2);
    back.push(which("1/2").file(halves.path()));
    assert!(matches!(merge(&plan, &back), Err(MergeError::Double { .. })));
    // A whole file that lost its end, in a line and between two.
    let text = std::fs::read(&moved).expect("readable");
    let last = text[..text.len() - 1].iter().rposition(|byte| *byte == b'\n').expect("several lines") + 1;
    for (length, double) in [(text.len() - 1, false), (last, true)] {
        std::fs::write(&moved, &text[..length]).expect("written");
        let error = merge(&plan, &[places(&shards), vec![moved.clone()]].concat()).expect_err("it is cut");
        let expected = if double {
            matches!(error, MergeError::Missing { count: 1, .. })
        } else {
            error.to_string().contains("after its last whole line")
        };
        assert!(expected, "{length}: {error}");
    }
    std::fs::write(&moved, &text).expect("written");
    // Another plan, other levels, another program.
    let other = Plan { seed: 8, ..plan.clone() };
    assert!(matches!(
        merge(&other, std::slice::from_ref(&moved)),
        Err(MergeError::Shard(ShardError::Other { .. }))
    ));
    let program = format!("\"program\":\"{}\"", env!("CARGO_PKG_VERSION"));
    for (from, to) in [
        ("\"scalar\"", "\"neon\""),
        ("\"scenes\":[\"", "\"scenes\":[\"0"),
        (program.as_str(), "\"program\":\"0.0.0\""),
    ] {
        let changed = String::from_utf8(text.clone()).expect("text");
        assert!(changed.contains(from), "{changed:.300}");
        std::fs::write(&moved, changed.replacen(from, to, 1)).expect("written");
        let error = merge(&plan, &[places(&shards), vec![moved.clone()]].concat()).expect_err(to);
        assert!(matches!(error, MergeError::Different { .. }), "{error}");
    }
    // A shard that cannot be one of so many.
    let text = String::from_utf8(text).expect("text");
    assert!(text.contains("\"shard\":2,\"of\":3"), "{text:.300}");
    for to in [
        "\"shard\":2,\"of\":0",
        "\"shard\":0,\"of\":3",
        "\"shard\":2,\"of\":18446744073709551615",
        "\"shard\":2,\"of\":1000001",
    ] {
        std::fs::write(&moved, text.replacen("\"shard\":2,\"of\":3", to, 1)).expect("written");
        let error = merge(&plan, std::slice::from_ref(&moved)).expect_err(to);
        assert!(error.to_string().contains("shards count from 1 to N"), "{to}: {error}");
    }
    assert!(matches!(merge(&plan, &places(&folder())), Err(MergeError::None)));
}

/// A file that was cut in any byte is taken up and comes out the same.
#[test]
fn a_shard_that_was_cut_anywhere_goes_on() {
    let plan = plan();
    let whole = folder();
    let file = done(&plan, "3/3", whole.path());
    let text = std::fs::read(&file).expect("readable");
    let lines = read(&file).expect("readable").expect("whole");
    assert_eq!((lines.found.len(), lines.cut), (2, 0));
    let ends: Vec<usize> = (0..text.len()).filter(|at| text[*at] == b'\n').collect();
    for cut in
        [0, 1, ends[0], ends[0] + 1, ends[0] + 2, ends[1], ends[1] + 1, ends[2] - 1, ends[2], ends[2] + 1]
    {
        let again = folder();
        let part = which("3/3").part(again.path());
        std::fs::write(&part, &text[..cut]).expect("written");
        let file = done(&plan, "3/3", again.path());
        assert!(std::fs::read(&file).expect("readable") == text, "cut at {cut} of {}", text.len());
        assert!(!part.exists());
        // So is a whole one that lost its end later; of one without a first line nobody knows what it was.
        std::fs::write(&file, &text[..cut]).expect("written");
        if cut > ends[0] {
            assert_eq!(done(&plan, "3/3", again.path()), file);
            assert!(std::fs::read(&file).expect("readable") == text, "whole, cut at {cut} of {}", text.len());
            assert!(!part.exists());
            // What is done beside it already is neither lost nor done again by what is left of it.
            std::fs::write(&file, &text[..=ends[0]]).expect("written");
            std::fs::write(&part, &text[..=ends[1]]).expect("written");
            let begun = std::cell::Cell::new(None);
            let tick = |done, _| begun.set(begun.get().or(Some(done)));
            run(&plan, which("3/3"), Level::SCALAR, again.path(), &tick).expect("it goes on");
            assert_eq!(begun.get(), Some(1), "units that were there");
            assert!(std::fs::read(&file).expect("readable") == text, "beside a part, cut at {cut}");
        } else {
            let error = run(&plan, which("3/3"), Level::SCALAR, again.path(), &|_, _| ())
                .expect_err("nothing is left");
            assert!(error.to_string().contains("it is empty"), "{error}");
        }
    }
    // Nor is a whole shard of another plan taken for this one's.
    let other = Plan { seed: plan.seed + 1, ..plan.clone() };
    let error =
        run(&other, which("3/3"), Level::SCALAR, whole.path(), &|_, _| ()).expect_err("of another plan");
    assert!(matches!(error, ShardError::Other { .. }), "{error}");
    // What is not this shard's is not gone over.
    let strange = folder();
    std::fs::write(which("1/3").part(strange.path()), &text).expect("written");
    let error = run(&plan, which("1/3"), Level::SCALAR, strange.path(), &|_, _| ()).expect_err("it is 3/3");
    assert!(error.to_string().contains("it is shard 3/3"), "{error}");
    // Twice is once.
    assert_eq!(done(&plan, "3/3", whole.path()), file);
    assert_eq!(std::fs::read(&file).expect("readable"), text);
}

/// The program is killed after each of its units in turn, and once at once; in the end the file is that of a run in peace.
#[cfg(unix)]
#[test]
fn a_program_that_is_killed_at_any_time_loses_what_it_was_at() {
    let desk = folder();
    let file = desk.path().join("plan.toml");
    std::fs::write(&file, PLAN).expect("written");
    let out = desk.path().join("shards");
    let words =
        ["campaign", "run", "--plan", file.to_str().expect("UTF-8"), "--out", out.to_str().expect("UTF-8")];
    let part = which("1/1").part(&out);
    let lines = || std::fs::read(&part).map_or(0, |text| text.iter().filter(|byte| **byte == b'\n').count());
    let mut killed = 0;
    for want in [0, 2, 3] {
        let mut child = Command::new(CGT).args(words).stdout(Stdio::null()).spawn().expect("it starts");
        while lines() < want && child.try_wait().expect("asked").is_none() {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        killed += u32::from(child.kill().is_ok() && !child.wait().expect("ended").success());
        assert!(which("1/1").file(&out).exists() || lines() >= want);
    }
    assert!(killed >= 2, "it was done before it could be killed");
    let last = cgt(&words);
    assert_eq!(last.status.code(), Some(0), "{}", said(&last));
    let peace = folder();
    let undisturbed = done(&plan(), "1/1", peace.path());
    let killed = std::fs::read(which("1/1").file(&out)).expect("whole");
    assert!(killed == std::fs::read(undisturbed).expect("whole"), "what was killed differs");
}

#[test]
fn only_one_process_works_on_a_shard() {
    let shards = folder();
    let held = std::fs::File::create(which("1/1").part(shards.path())).expect("made");
    held.lock().expect("nobody else is there");
    let error =
        run(&plan(), which("1/1"), Level::SCALAR, shards.path(), &|_, _| ()).expect_err("it is taken");
    assert!(matches!(error, ShardError::Taken { .. }), "{error}");
    drop(held);
    done(&plan(), "1/1", shards.path());
}

#[test]
fn a_failure_is_one_case_however_often_it_is_found() {
    let desk = folder();
    let file = desk.path().join("plan.toml");
    let text = "name = \"broken\"\nseed = 1\n[[film]]\nscene = \"2juy\"\nframes = \"0..3\"\nsize = \"160x90\"\nsubjects = [\"paper\"]\n";
    std::fs::write(&file, text).expect("written");
    let place = |name: &str| desk.path().join(name).to_string_lossy().into_owned();
    let (plan, shards, out) = (place("plan.toml"), place("shards"), place("merged"));
    for shard in ["1/2", "2/2"] {
        let ran = cgt(&["campaign", "run", "--plan", &plan, "--shard", shard, "--out", &shards]);
        assert_eq!(ran.status.code(), Some(0), "{}", said(&ran));
    }
    let told = cgt(&["campaign", "status", "--plan", &plan, &shards]);
    // Frames 0 and 2 are of the first shard.
    for part in ["2 of 2 units, whole, 2 failures", "1 of 1 units, whole, 1 failures", "3 of 3 units"] {
        assert!(said(&told).contains(part), "{}", said(&told));
    }
    let merged = cgt(&["campaign", "merge", "--plan", &plan, &shards, "--out", &out]);
    assert_eq!(merged.status.code(), Some(1), "{}", said(&merged));
    let merged = merge(&Plan::parse(text).expect("a plan"), &[PathBuf::from(&shards)]).expect("whole");
    let times: u64 = merged.failures.iter().map(|failure| failure.times).sum();
    assert_eq!(times, 3, "{merged:?}");
    let mut names: Vec<&str> = merged.failures.iter().map(|failure| failure.name.as_str()).collect();
    names.dedup();
    assert_eq!(names.len(), merged.failures.len());
    for failure in &merged.failures {
        let file = Path::new(&out).join("cases").join(format!("{}.json", failure.name));
        let case = Case::from_json(&std::fs::read(file).expect("it is kept")).expect("readable");
        assert_eq!(worst(&case.judge().expect("judged")), Verdict::Wrong);
        assert_eq!(case.camera.size().pixels(), 1);
    }
    let page = std::fs::read_to_string(Path::new(&out).join("campaign.html")).expect("a page");
    assert!(
        page.contains("Promises were broken") && page.contains("cgt replay cases/paper-"),
        "{page:.2000}"
    );
}

/// Two units that find the same case, and one that finds another.
#[test]
fn the_same_smallest_case_is_one_failure() {
    let plan = plan();
    let shards = all(&plan, 1);
    let file = which("1/1").file(shards.path());
    let text = std::fs::read_to_string(&file).expect("text");
    let broken =
        |case: &str| format!("\"failures\":[{{\"of\":\"pictures\",\"message\":\"m\",\"case\":\"{case}\"}}]");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for (line, case) in [(1, "one"), (2, "two"), (6, "one")] {
        assert!(lines[line].contains("\"failures\":[]"), "{}", lines[line]);
        lines[line] = lines[line].replace("\"failures\":[]", &broken(case));
    }
    std::fs::write(&file, lines.join("\n") + "\n").expect("written");
    let merged = merge(&plan, &places(&shards)).expect("whole");
    assert_eq!(merged.outcome, Outcome::Broken);
    let mut told: Vec<_> =
        merged.failures.iter().map(|failure| (failure.case.as_str(), failure.times, failure.unit)).collect();
    told.sort_unstable();
    assert_eq!(told, [("one", 2, 0), ("two", 1, 1)]);
}

#[test]
fn a_campaign_with_too_little_at_stake_has_no_verdict() {
    let text = PLAN.replace("= 1000", "= 1000000000");
    let demanding = Plan::parse(&text).expect("a plan");
    // Only what is demanded differs, so the plans do: shards of one are none of the other.
    assert_ne!(demanding.hash(), plan().hash());
    let shards = folder();
    let only = Plan { draw: demanding.draw[1..].to_vec(), film: Vec::new(), ..demanding };
    done(&only, "1/1", shards.path());
    let merged = merge(&only, &places(&shards)).expect("whole");
    assert_eq!(merged.outcome, Outcome::TooLittle);
    assert!(
        merged.lacking[0].contains("of at least 1\u{202f}000\u{202f}000\u{202f}000"),
        "{:?}",
        merged.lacking
    );
}

/// What is demanded is what must be there: one more is too much, and what was never counted is not there.
#[test]
fn a_demand_is_met_or_not() {
    let with = |least: &str| {
        let text = PLAN.replace("\"pictures: rays\" = 1000", least);
        let whole = Plan::parse(&text).expect("a plan");
        let only = Plan { draw: whole.draw[1..].to_vec(), film: Vec::new(), ..whole };
        let shards = folder();
        done(&only, "1/1", shards.path());
        merge(&only, &places(&shards)).expect("whole")
    };
    let what = "certain: rays whose answer is known";
    let counted = with(&format!("\"{what}\" = 1")).counts[what];
    for (what, least, outcome) in [
        (what, counted, Outcome::Held),
        (what, counted + 1, Outcome::TooLittle),
        ("certain: no such count", 1, Outcome::TooLittle),
    ] {
        let merged = with(&format!("\"{what}\" = {least}"));
        assert_eq!(merged.outcome, outcome, "{what}: {least} of {counted}: {:?}", merged.lacking);
        assert_eq!(merged.lacking.len(), usize::from(outcome == Outcome::TooLittle));
    }
}

/// Whatever the spheres of a film are, in whichever frame, and what they are shown in: with another number it is another scene, whose shards are
/// not merged with these.
#[test]
fn a_film_with_another_number_is_another_film() {
    let folder = tempfile::tempdir().expect("a folder");
    let hash = |name: &str, text: &str, frames: usize| {
        let file = folder.path().join(name);
        std::fs::write(&file, text).expect("written");
        let plan = format!(
            "name = \"film\"\nseed = 1\n[[film]]\nscene = {file:?}\nframes = \"0..{frames}\"\nsize = \"8x8\"\nsubjects = [\"fast\"]\n"
        );
        let plan = Plan::parse(&plan).expect("a plan");
        Bench::new(&plan, Level::SCALAR).expect("it loads").scenes().concat()
    };
    let still = "b 0 0 0\nl 0 9 9\nf 1 0 0 1 0 0 0 0\ns 0 0 0 1\ns 3 0 0 1\n";
    let first = hash("still.nff", still, 1);
    assert_eq!(hash("again.nff", still, 1), first);
    for (part, other) in [
        ("b 0 0 0", "b 0 0 1"),
        ("l 0 9 9", "l 9 9 0"),
        ("f 1 0 0", "f 1 1 0"),
        ("3 0 0 1", "3 0 0 2"),
        ("3 0 0 1", "3 0 1 1"),
    ] {
        assert_ne!(hash("other.nff", &still.replace(part, other), 1), first, "{other}");
    }
    let moving = "1\n\nC 0 0 0\n1\n\nC 1 0 0\n";
    let first = hash("moving.xyz", moving, 2);
    assert_ne!(hash("other.xyz", &moving.replace("C 1", "C 2"), 2), first, "the last frame");
}

/// A film of whose frames its tracer states nothing was not judged, whatever the plan demands.
#[test]
fn a_film_of_which_nothing_is_stated_has_no_verdict() {
    let desk = folder();
    let sphere = Sphere { center: [0.0; 3], radius: 1e-30, color: [200; 3] };
    let scene = Scene::new(vec![sphere], [0; 3], DEFAULT_LIGHT).expect("valid");
    let place = |name: &str| desk.path().join(name).to_string_lossy().into_owned();
    std::fs::write(place("tiny.json"), verify::scenes::write::json(&scene.into(), None)).expect("written");
    let (plan, shards, out) = (place("plan.toml"), place("shards"), place("merged"));
    for (subjects, code, silent) in [
        ("\"naive-f32-textbook\"", 3, true),
        ("\"fast\", \"naive-f32-textbook\"", 3, true),
        ("\"fast\"", 0, false),
    ] {
        let text = format!(
            "name = \"tiny\"\nseed = 1\n[[film]]\nscene = {:?}\nframes = \"0..1\"\nsize = \"8x8\"\nsubjects = [{subjects}]\n",
            place("tiny.json")
        );
        std::fs::write(&plan, text).expect("written");
        _ = std::fs::remove_dir_all(&shards);
        let ran = cgt(&["campaign", "run", "--plan", &plan, "--shard", "1/1", "--out", &shards]);
        assert_eq!(ran.status.code(), Some(0), "{}", said(&ran));
        let merged = cgt(&["campaign", "merge", "--plan", &plan, &shards, "--out", &out]);
        assert_eq!(merged.status.code(), Some(code), "{subjects}: {}", said(&merged));
        let told = said(&merged);
        let named = told.contains("naive-f32-textbook on ")
            && told.contains("no frame of which anything could be judged");
        assert_eq!(named, silent, "{told}");
    }
}

#[test]
fn status_names_what_was_not_begun() {
    let plan = plan();
    let shards = folder();
    done(&plan, "2/4", shards.path());
    let text = std::fs::read(which("2/4").file(shards.path())).expect("readable");
    let cut = text.iter().position(|byte| *byte == b'\n').expect("a line") + 1;
    let half = String::from_utf8(text[..cut].to_vec()).expect("text").replace("\"shard\":2", "\"shard\":3");
    std::fs::write(which("3/4").part(shards.path()), half).expect("written");
    let all = status(&plan, shards.path()).expect("readable");
    let far: Vec<_> = all.iter().map(|one| (one.which.to_string(), one.done, one.whole)).collect();
    assert_eq!(far, [("2/4".into(), [2, 2], true), ("3/4".into(), [0, 2], false)]);
    let told = verify::campaign::text::status(&all);
    assert!(told.contains("not begun: 1, 4") && told.contains("2 of 4 units of these shards"), "{told}");
}

#[test]
fn plans_that_make_no_sense_are_refused() {
    let with = |from: &str, to: &str| {
        assert!(PLAN.contains(from), "{from}");
        Plan::parse(&PLAN.replacen(from, to, 1)).expect_err(to)
    };
    assert!(matches!(Plan::parse("name = \"x\"\nseed = 1\n"), Err(PlanError::Empty)));
    assert!(matches!(with("\"certain\"", "\"pictures\""), PlanError::Twice { word: "pictures" }));
    assert!(matches!(with("cases = 20", "cases = 0"), PlanError::NoCase { word: "certain" }));
    assert!(matches!(with("cases = 20", "cases = 1000000000000000"), PlanError::TooMuch { .. }));
    assert!(with("seed = 7", "seed = 7\nsede = 8").to_string().contains("sede"));
    assert!(with("\"pictures\"", "\"paintings\"").to_string().contains("paintings"));
    // A frame of a film counts once for a tracer: in one list, and in two films that overlap.
    let film = |frames: &str, size: &str, subjects: &str| {
        format!(
            "[[film]]\nscene = \"2juy\"\nframes = \"{frames}\"\nsize = \"{size}\"\nsubjects = [{subjects}]\n"
        )
    };
    let two = |one: String, other: String| Plan::parse(&format!("name = \"x\"\nseed = 1\n{one}{other}"));
    let again = |plan: Result<Plan, PlanError>| matches!(plan, Err(PlanError::Again { subject, .. }) if subject == "fast");
    assert!(again(two(film("0..4", "40x24", "\"fast\", \"safe\", \"fast\""), String::new())));
    for frames in ["3..7", "0..1", "1..2", "0..9"] {
        assert!(
            again(two(film("0..4", "40x24", "\"fast\""), film(frames, "40x24", "\"safe\", \"fast\""))),
            "{frames}"
        );
    }
    // However its scene and its size are written.
    for (scene, size) in [("2juy", "040x24"), ("2JUY", "40x24"), ("2Juy", "+40x0024")] {
        let other = film("3..7", size, "\"fast\"").replace("2juy", scene);
        assert!(again(two(film("0..4", "40x24", "\"fast\""), other)), "{scene} {size}");
    }
    for (frames, size, subject) in
        [("4..7", "40x24", "fast"), ("0..4", "40x25", "fast"), ("0..4", "40x24", "safe")]
    {
        let other = film(frames, size, &format!("\"{subject}\""));
        assert!(two(film("0..4", "40x24", "\"fast\""), other).is_ok(), "{frames} {size} {subject}");
    }
    for (from, to) in
        [("3..7", "7..3"), ("3..7", "3"), ("40x24", "0x24"), ("40x24", "wide"), ("\"fast\"", "\"slow\"")]
    {
        assert!(matches!(with(from, to), PlanError::Film { .. }), "{to}");
    }
    let beyond = Plan::parse(&PLAN.replace("3..7", "3..25")).expect("of a scene nothing is known yet");
    let error =
        run(&beyond, which("1/1"), Level::SCALAR, folder().path(), &|_, _| ()).expect_err("24 frames");
    assert!(error.to_string().contains("frames 0 to 23, not 24"), "{error}");
    for text in ["0/3", "4/3", "1/0", "one", "1/99999999999"] {
        assert!(text.parse::<Which>().is_err(), "{text}");
    }
    assert_eq!(
        [0, 1, 2, 5, 10].map(bin),
        ["0", "1", "2 to 3", "16 to 31", "512 to 1\u{202f}023"].map(str::to_owned)
    );
    assert!(bin(64).ends_with("551\u{202f}615"), "{}", bin(64));
}

/// What stands in docs/campaigns.md is what the program does.
#[test]
fn the_page_and_the_plans_beside_it_are_true() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let page = std::fs::read_to_string(docs.join("campaigns.md")).expect("it is there");
    let block =
        |kind: &str| page.split(&format!("```{kind}\n")).nth(1).and_then(|rest| rest.split("```").next());
    let shown = block("toml").expect("a plan");
    Plan::parse(shown).expect("the plan that is shown is one");
    let hunt = std::fs::read_to_string(docs.join("campaigns/hunt.toml")).expect("it is there");
    Plan::parse(&hunt).expect("a plan");
    // The same, smaller.
    let mut small = shown.split("[least]").next().expect("the rest").to_owned();
    for (from, to) in [("100_000", "256"), ("0..24", "0..2"), ("320x180", "32x18")] {
        assert!(small.contains(from), "{from}");
        small = small.replace(from, to);
    }
    let desk = folder();
    std::fs::write(desk.path().join("plan.toml"), small).expect("written");
    let commands: Vec<&str> = block("sh").expect("commands").lines().collect();
    assert_eq!(commands.len(), 4);
    for line in commands {
        let words = line.split(' ').skip(1);
        let ran = Command::new(CGT).args(words).current_dir(desk.path()).output().expect("it runs");
        assert_eq!(ran.status.code(), Some(0), "{line}: {}", said(&ran));
    }
    for name in ["campaign.json", "campaign.txt", "campaign.html", "stakes.svg"] {
        assert!(desk.path().join("report").join(name).exists(), "{name}");
    }
    for script in ["slurm-submit", "slurm-shard", "slurm-merge"] {
        let read = Command::new("bash").arg("-n").arg(docs.join("campaigns").join(script)).status();
        assert!(read.is_ok_and(|status| status.success()), "{script}");
    }
}

/// The chart of the hunt in README is that of its text.
#[test]
fn the_hunts_chart_shows_its_counts() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/campaigns");
    let read = |name: &str| std::fs::read_to_string(docs.join(name)).expect("it is there");
    let (text, chart) = (read("hunt.txt"), read("hunt.svg"));
    let words: Vec<&str> = chart.split("</text>").filter_map(|part| Some(part.rsplit_once('>')?.1)).collect();
    let mut seen = 0;
    for line in text.lines() {
        let Some((count, what)) = line.trim_start().split_once("  ") else { continue };
        // Not the rows of histograms.
        if let Some(at) = words.iter().position(|word| *word == what).filter(|_| what.contains(": ")) {
            assert_eq!(words[at + 1], count, "{what}");
            seen += 1;
        }
    }
    assert!(seen > 30, "only {seen} bars were compared");
    let failures = words.iter().position(|word| *word == "different failures").expect("it is told");
    assert_eq!(words[failures + 1] == "0", !text.contains("cgt replay"), "failures");
}
