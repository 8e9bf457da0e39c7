//! Is a tracer in another language judged as any other? The clients of docs/own-tracer.md, sound and with a fault in them, and programs that break
//! the protocol in every way, are asked by the library and by `cgt`.

#[allow(dead_code, unreachable_pub, reason = "an example of its own")]
#[path = "../verify/examples/own_tracer.rs"]
mod own_tracer;

use contract::{Animation, Camera, DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
use rayon::prelude::*;
use serde_json::Value;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tempfile::TempDir;
use verify::case::{Asked, Case};
use verify::chart::{self, Distance, measure};
use verify::foreign::{Foreign, ForeignError, PROMISES, method, serve, wire};
use verify::judge::judge;
use verify::properties::relations::Relation;
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::generator;
use verify::subject::{NAIVE, Subject};
use verify::verdict::Verdict;

const CGT: &str = env!("CARGO_BIN_EXE_cgt");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A folder from which the repository's own paths can be used, and nothing be left in it.
fn desk() -> TempDir {
    let desk = tempfile::tempdir().expect("a temporary folder");
    for name in ["verify", "tests"] {
        let linked = std::os::unix::fs::symlink(
            root().join(name).canonicalize().expect("it is there"),
            desk.path().join(name),
        );
        linked.expect("a link");
    }
    desk
}

fn has(program: &str) -> bool {
    let there = Command::new(program).arg("--version").output().is_ok();
    if !there {
        _ = writeln!(std::io::stderr(), "not judged: a tracer of one's own: {program} is not installed");
    }
    there
}

/// A Python program that is a tracer.
fn python(folder: &Path, name: &str, text: &str) -> String {
    let file = folder.join(name);
    std::fs::write(&file, text).expect("it is written");
    format!("mine=python3 '{}'", file.display())
}

fn client() -> String {
    std::fs::read_to_string(root().join("verify/examples/tracer.py")).expect("it is there")
}

/// The client with a line changed.
fn broken(from: &str, to: &str) -> String {
    let text = client();
    assert_eq!(text.matches(from).count(), 1, "`{from}`");
    text.replace(from, to)
}

fn scene(word: &str, size: [u32; 2]) -> (Scene, Camera) {
    let loaded = Source::parse(word).and_then(|source| source.load()).expect("generated");
    let size = Size::new(size[0], size[1]).expect("small");
    let camera = loaded.camera(&Framing { size: Some(size), ..Framing::default() }).expect("not degenerate");
    (loaded.animation.frames()[0].clone(), camera)
}

fn foreign(command: &str) -> Arc<Foreign> {
    Arc::new(Foreign::new(command, PROMISES[2].1, Duration::from_secs(20)).expect("a command"))
}

fn cgt(folder: &Path, words: &[&str]) -> Output {
    Command::new(CGT).args(words).current_dir(folder).env("CGT_SEED", "1").output().expect("it runs")
}

fn said(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// The two clients do as rule 5 of the contract says, in f64; so does the reference.
#[test]
fn the_clients_have_the_bits_of_the_naive_f64_tracer() {
    let desk = tempfile::tempdir().expect("a temporary folder");
    let mut clients = vec![];
    if has("python3") {
        clients.push(python(desk.path(), "tracer.py", &client()));
    }
    if has("cc") {
        let program = desk.path().join("tracer");
        let built = Command::new("cc")
            .args(["-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-o"])
            .args([&program, &root().join("verify/examples/tracer.c")])
            .arg("-lm")
            .output();
        let built = built.expect("it runs");
        assert!(built.status.success(), "{}", said(&built));
        clients.push(format!("'{}'", program.display()));
    }
    for command in clients {
        let tracer = foreign(&command);
        let mut hits = 0;
        // One process answers all of them.
        for (word, size) in [("uniform:60:1", [61, 37]), ("sphereflake:1", [40, 41]), ("uniform:1:3", [1, 1])]
        {
            let (scene, camera) = scene(word, size);
            let own = tracer.render(&scene, &camera, 1, &|| ()).expect("a picture").image;
            let naive = NAIVE[0].render(&scene, &camera, 1, &|| ()).expect("a picture").image;
            assert_eq!(own.ids, naive.ids, "{command} on {word}");
            let bits = |t: &[f32]| t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&own.t), bits(&naive.t), "{command} on {word}");
            assert_eq!(own.rgba, naive.rgba, "{command} on {word}");
            hits += own.ids.iter().filter(|id| **id != MISS).count();
        }
        assert!(hits > 500, "hardly a hit: {hits}");
    }
}

#[test]
fn a_fault_is_found_and_shown_and_kept_as_the_smallest_case() {
    if !has("python3") {
        return;
    }
    let desk = desk();
    // A sphere nearer by less than a thousandth does not count.
    let fault = broken("0 < t < best[1]", "0 < t < 0.999 * best[1]");
    let command = python(desk.path(), "faulty.py", &fault);
    let words = ["verify", "uniform:500:1", "--size", "96x54", "--promise", "f64", "--keep", "cases"];
    let output = cgt(desk.path(), &[&words[..], &["--subject-cmd", &command]].concat());
    let text = said(&output);
    assert_eq!(output.status.code(), Some(1), "{text}");
    let report: Value =
        serde_json::from_slice(&std::fs::read(desk.path().join("cgt-report/report.json")).expect("a report"))
            .expect("JSON");
    let subject = &report["scenes"][0]["subjects"][0];
    assert_eq!(subject["name"], "mine");
    assert_eq!(subject["verdict"], "Wrong", "{subject}");
    let wrong = subject["comparison"]["wrong_ids"].as_u64().expect("a number");
    assert!(wrong > 0, "{subject}");
    let account = subject["first_wrong"].as_str().expect("an account");
    assert!(account.contains("--subject-cmd \"mine=python3 "), "{account}");
    let picture = subject["picture"].as_str().expect("a triptych");
    assert!(
        desk.path().join("cgt-report").join(picture).metadata().is_ok_and(|file| file.len() > 1000),
        "{picture}"
    );
    // Two spheres are needed to see one of them in the other's place.
    let file = desk.path().join("cases/mine.json");
    let case = Case::from_json(&std::fs::read(&file).expect("a case")).expect("readable");
    assert_eq!(case.frames.frames()[0].spheres().len(), 2, "{text}");
    assert_eq!(case.camera.size().pixels(), 1, "{text}");
    // It is kept as a promise, and not as what must stay wrong.
    assert_eq!(case.expected, Verdict::Undecidable, "{text}");
    assert!(desk.path().join("cases/mine.png").exists());
    assert!(text.contains("kept: cgt replay cases/mine.json --pixel 0,0 --subject-cmd \"mine="), "{text}");

    let replay = |more: &[&str]| cgt(desk.path(), &[&["replay", "cases/mine.json"], more].concat());
    let alone = replay(&[]);
    assert_eq!(alone.status.code(), Some(1), "{}", said(&alone));
    assert!(said(&alone).contains("--subject-cmd"), "{}", said(&alone));
    let again = replay(&["--subject-cmd", &command, "--promise", "f64"]);
    assert_eq!(again.status.code(), Some(1), "{}", said(&again));
    assert!(said(&again).contains("NOT as it should be"), "{}", said(&again));
    assert!(said(&again).contains("itself t ="), "{}", said(&again));
    let mended = python(desk.path(), "sound.py", &client());
    let mended = replay(&["--subject-cmd", &mended, "--promise", "f64"]);
    assert_eq!(mended.status.code(), Some(0), "{}", said(&mended));
}

/// Each way to break the protocol has its own words.
#[test]
fn a_program_that_breaks_the_protocol_is_named_and_is_no_picture() {
    if !has("python3") {
        return;
    }
    let desk = tempfile::tempdir().expect("a temporary folder");
    let (scene, camera) = scene("uniform:5:1", [8, 4]);
    // Patience for a busy machine, but with the one that is silent.
    let failure = |name: &str, text: &str| {
        let command = python(desk.path(), name, text);
        let patience = Duration::from_millis(if name == "silent.py" { 700 } else { 30_000 });
        let tracer = Foreign::new(&command, PROMISES[0].1, patience).expect("a command");
        let error = Arc::new(tracer).render(&scene, &camera, 1, &|| ()).expect_err(name);
        *error.downcast::<ForeignError>().expect("one of its own")
    };
    let out = "out.write(b\"d\" +";
    let read_all = "import sys; sys.stdin.buffer.read(68 + 32 * 24); o = sys.stdout.buffer; ";
    assert!(matches!(
        failure("ends.py", "import sys; sys.exit(7)"),
        ForeignError::Ended { how, got: 0, due: 1, .. } if how.contains('7')
    ));
    assert!(matches!(
        failure(
            "short.py",
            &format!(
                "{read_all} o.write(b'r'); o.flush(); sys.stdin.buffer.read(1 + 5 * 16); o.write(b'd' + bytes(100))"
            )
        ),
        ForeignError::Ended { got: 100, due: 256, .. }
    ));
    // Who is given up is stopped before its time.
    let outlived = desk.path().join("outlived");
    let sleeps = format!("import time; time.sleep(20); open({outlived:?}, 'w').close()");
    assert!(matches!(failure("silent.py", &sleeps), ForeignError::Silent { got: 0, .. }));
    assert!(!outlived.exists(), "it was waited for to its end");
    assert!(matches!(
        failure("chatty.py", &broken(out, "print('tracing', flush=True), out.write(b\"d\" +")),
        ForeignError::Unexpected { said, due: 'd', .. } if said.starts_with("tracing")
    ));
    let refusing = format!("{read_all} o.write(b'e' + (9).to_bytes(4, 'little') + b'too large')");
    assert_eq!(failure("refuses.py", &refusing), ForeignError::Refused { said: "too large".into() });
    // What comes with an answer is surplus, of the last frame too; so is a `d` before `g`, which would stop a clock that has not begun.
    // In one piece, also where Python does not buffer (PYTHONUNBUFFERED).
    let more = broken("[t for _, t in hits]).tobytes())", "[t for _, t in hits]).tobytes() + bytes(3))");
    assert_eq!(failure("more.py", &more), ForeignError::Surplus { bytes: 3 });
    let early = broken("out.write(b\"r\")", "out.write(b\"rd\")").replace(out, "out.write(");
    assert_eq!(failure("early.py", &early), ForeignError::Surplus { bytes: 1 });
    // What comes later is found before the next frame.
    let sent = desk.path().join("sent");
    let late = format!(
        "    out.flush(), __import__('time').sleep(0.2), out.write(bytes(3)), out.flush(), open({sent:?}, 'w').close()\n"
    );
    let tracer = foreign(&python(desk.path(), "late.py", &broken("    out.flush()\n", &late)));
    tracer.render(&scene, &camera, 1, &|| ()).expect("the first frame is whole");
    let start = Instant::now();
    while !sent.exists() && start.elapsed() < Duration::from_secs(30) {
        std::thread::sleep(Duration::from_millis(10));
    }
    // Until a thread has read them.
    std::thread::sleep(Duration::from_millis(200));
    let error = tracer.render(&scene, &camera, 1, &|| ()).expect_err("three bytes too many");
    assert_eq!(error.downcast_ref(), Some(&ForeignError::Surplus { bytes: 3 }));
    // After a failure another process is asked.
    assert!(tracer.render(&scene, &camera, 1, &|| ()).is_ok());

    let refused = |command: &str| Foreign::new(command, PROMISES[0].1, Duration::ZERO).expect_err(command);
    assert!(matches!(refused("a 'b"), ForeignError::Words { .. }));
    assert_eq!(refused("name="), ForeignError::Empty);
    let absent = foreign("/nowhere/tracer --fast").render(&scene, &camera, 1, &|| ()).expect_err("not there");
    assert!(
        matches!(absent.downcast_ref(), Some(ForeignError::Start { program, .. }) if program == "/nowhere/tracer")
    );
}

/// A tracer that is slow in reading is not slow in tracing: what passes before `g` is not its time; all that passes after it is, whether it has
/// said that it is done or not.
#[test]
fn the_clock_runs_from_go_to_the_last_answer() {
    if !has("python3") {
        return;
    }
    let desk = tempfile::tempdir().expect("a temporary folder");
    let (scene, camera) = scene("uniform:5:1", [8, 4]);
    let sleep = "__import__('time').sleep(0.3)";
    for (name, from, to, counts) in [
        ("reads.py", "out.write(b\"r\")", format!("{sleep}, out.write(b\"r\")"), false),
        ("traces.py", "out.write(b\"d\" +", format!("{sleep}, out.write(b\"d\" +"), true),
        (
            "afterwards.py",
            "out.write(b\"d\" +",
            format!("out.write(b\"d\"), out.flush(), {sleep}, out.write("),
            true,
        ),
    ] {
        let tracer = foreign(&python(desk.path(), name, &broken(from, &to)));
        let start = Instant::now();
        let took = tracer.render(&scene, &camera, 1, &|| ()).expect("a picture").took.expect("it is timed");
        let left = start.elapsed() - took;
        // Both waits are at least that long on any machine.
        assert!(
            if counts { took } else { left } >= Duration::from_millis(300),
            "{name}: {took:?}, else {left:?}"
        );
        // In charts too.
        let method = method(&tracer, 1);
        let mut contestant = method.contestant(&scene, &camera).expect("it begins");
        let start = Instant::now();
        let took = contestant.frame(&scene, &camera).expect("a picture").took.expect("it is timed");
        let left = start.elapsed() - took;
        assert!(
            if counts { took } else { left } >= Duration::from_millis(300),
            "{name} in a chart: {took:?}, else {left:?}"
        );
    }
    // How many threads it may have it is told.
    let says = "import os, sys\nsys.stdin.buffer.read(68 + 32 * 24)\nsaid = os.environ['CGT_THREADS'].encode()\n\
                os.write(1, b'e' + len(said).to_bytes(4, 'little') + said)\n";
    let error = foreign(&python(desk.path(), "threads.py", says)).render(&scene, &camera, 13, &|| ());
    let error = error.expect_err("it refuses");
    assert_eq!(error.downcast_ref(), Some(&ForeignError::Refused { said: "13".into() }));
}

/// A program that would trace beforehand finds nothing to trace: until it has said that it has read the rays, no sphere has come.
#[test]
fn nothing_is_told_of_the_spheres_before_go() {
    if !has("python3") {
        return;
    }
    let desk = tempfile::tempdir().expect("a temporary folder");
    let (scene, camera) = scene("uniform:5:1", [8, 4]);
    let early = "import os, select, time
due = 68 + 32 * 24
while due: due -= len(os.read(0, due))
time.sleep(0.3)
said = b'%d' % len(os.read(0, 1000) if select.select([0], [], [], 0)[0] else b'')
os.write(1, b'e' + len(said).to_bytes(4, 'little') + said)
";
    let tracer = foreign(&python(desk.path(), "early.py", early));
    let error = tracer.render(&scene, &camera, 1, &|| ()).expect_err("it refuses");
    assert_eq!(error.downcast_ref(), Some(&ForeignError::Refused { said: "0".into() }), "bytes too early");
}

/// Cases that are in the repository can be asked of any tracer; what the paper's plan does there it need not do.
#[test]
fn a_case_of_others_is_asked_of_ones_own() {
    if !has("python3") {
        return;
    }
    let desk = desk();
    let command = python(desk.path(), "tracer.py", &client());
    for name in [
        "paper-eight-corners-miss-the-middle",
        "a-tangent-hits",
        "equal-roots",
        "beyond-the-range-of-margins",
    ] {
        let file = format!("tests/cases/{name}.json");
        let output = cgt(desk.path(), &["replay", &file, "--subject-cmd", &command, "--promise", "f64"]);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", said(&output));
        assert!(said(&output).contains("as it should be (Undecidable)"), "{name}: {}", said(&output));
    }
}

/// Pictures that are right are not enough: a tracer that answers otherwise once the scene is mirrored is not as it should be.
#[test]
fn a_tracer_at_odds_with_itself_is_not_as_it_should_be() {
    if !has("python3") {
        return;
    }
    let desk = desk();
    let ball = |x: f32, z: f32| Sphere { center: [x, 0.0, z], radius: 1.0, color: [90; 3] };
    let scene = Scene::new(vec![ball(0.0, -4.0), ball(1.0, -9.0)], [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(4, 4).expect("small");
    let camera = Camera::new([0.25, 0.5, 2.0], [-0.5, 0.5, -1.0], [0.25, 0.0, 0.0], [0.0, -0.25, 0.0], size);
    let case = Case {
        frames: Animation::from(scene),
        camera: camera.expect("a camera"),
        asked: Asked::Naive(NAIVE[0]),
        expected: Verdict::Equal,
        pixel: None,
        why: "two balls, one before the other".into(),
    };
    std::fs::write(desk.path().join("balls.json"), case.to_json()).expect("it is written");
    let sees = |one: &str| broken("0 < t < best[1]", &format!("0 < t < best[1] and (ex == 0.25 or {one})"));
    // Of twins in f32 whoever is first in the list is seen: right where that is the nearer one.
    let twin = |k: u16| Sphere { radius: 1.0 - f32::from(k) * f32::EPSILON / 2.0, ..ball(0.0, -5.0) };
    let four = Scene::new((0..4).map(twin).collect(), [0; 3], DEFAULT_LIGHT).expect("valid");
    let one = Size::new(1, 1).expect("small");
    let axis = Camera::new([0.0; 3], [-0.25, 0.25, -1.0], [0.5, 0.0, 0.0], [0.0, -0.5, 0.0], one);
    let twins = Case { frames: Animation::from(four), camera: axis.expect("a camera"), ..case.clone() };
    std::fs::write(desk.path().join("twins.json"), twins.to_json()).expect("it is written");
    let rounds = broken("0 < t < best[1]", "(lambda of: 0 < of[0] < of[1])(array(\"f\", [t, best[1]]))");
    let command = python(desk.path(), "rounds.py", &rounds);
    let output = cgt(desk.path(), &["replay", "twins.json", "--subject-cmd", &command, "--promise", "exact"]);
    let told = said(&output);
    assert!(told.contains("case       Equal, NOT as it should be"), "{told}");
    assert_eq!(output.status.code(), Some(1), "{told}");
    for (name, text, code, word) in [
        ("sound.py", client(), 0, "as it should be (Equal)"),
        ("odd.py", sees("i > 0"), 1, "NOT as it should be (Equal)"),
    ] {
        let command = python(desk.path(), name, &text);
        let output =
            cgt(desk.path(), &["replay", "balls.json", "--subject-cmd", &command, "--promise", "exact"]);
        let told = said(&output);
        assert_eq!(output.status.code(), Some(code), "{name}: {told}");
        assert!(told.contains("case       Equal, ") && told.contains(word), "{name}: {told}");
        assert_eq!(told.contains("relations  hold"), code == 0, "{name}: {told}");
    }
}

/// Who takes the spheres of the frame before where these are enough is right in each frame alone, and at odds with itself in a second one,
/// in which spheres have moved.
#[test]
fn who_remembers_the_frame_before_is_at_odds_with_itself() {
    if !has("python3") {
        return;
    }
    let desk = tempfile::tempdir().expect("a temporary folder");
    let (scene, camera) = scene("uniform:5:1", [8, 4]);
    let remembers = "before, now = globals().get(\"now\", []), read(4 * n)\n    \
                     spheres = before if len(before) > len(now) else now";
    for (name, text, sound) in
        [("sound.py", client(), true), ("remembers.py", broken("spheres = read(4 * n)", remembers), false)]
    {
        let asked = Asked::Foreign {
            name: name.into(),
            promise: PROMISES[0].1,
            tracer: Some(foreign(&python(desk.path(), name, &text))),
        };
        let frames = Animation::from(scene.clone());
        let case = Case { frames, camera, asked, expected: Verdict::Equal, pixel: None, why: name.into() };
        let held = Relation::Second.hold(&case, &mut generator(1, 0));
        assert_eq!(held.is_ok(), sound, "{name}: {held:?}");
        assert!(held.is_ok_and(|pixels| pixels == 32) || !sound, "{name}: another number of pixels");
    }
}

/// Whoever keeps answers for rays it has seen, or traces rays before the clock runs with the spheres that it had before, has no time in a
/// chart.
#[test]
fn who_has_its_answers_beforehand_has_no_time() {
    if !has("python3") {
        return;
    }
    let desk = tempfile::tempdir().expect("a temporary folder");
    let (scene, camera) = scene("uniform:20:1", [24, 16]);
    let hits = "hits = [nearest(spheres, *rays[i : i + 6]) for i in range(0, len(rays), 6)]";
    let table = "table = globals().get(\"table\", {})\n    if rays.tobytes() not in table:\n        \
                 table[rays.tobytes()] = [nearest(spheres, *rays[i : i + 6]) for i in range(0, len(rays), 6)]\n    \
                 hits = table[rays.tobytes()]";
    let beforehand = "before, now = globals().get(\"now\"), read(4 * n)\n    spheres = before or now";
    for (name, text, sound) in [
        ("sound.py", client(), true),
        ("table.py", broken(hits, table), false),
        ("beforehand.py", broken("spheres = read(4 * n)", beforehand), false),
    ] {
        let methods = [method(&foreign(&python(desk.path(), name, &text)), 1)];
        let asked =
            chart::Asked { name, frame: 0, scene: &scene, methods: &methods, rounds: 3, every: 1, seed: 1 };
        let at = Distance { times: 1.0, radii: 1.0, camera };
        let view = measure(&asked, &at, &|_, _| Box::new(|| ())).expect("small");
        let remark = view.points[0].remark.as_deref().unwrap_or_default();
        assert_eq!(view.points[0].ns_per_ray.is_some(), sound, "{name}: {remark}");
        assert_eq!(remark.is_empty(), sound, "{name}: {remark}");
        assert_eq!(remark.contains("drawn at random"), name == "table.py", "{name}: {remark}");
    }
}

/// Answers that no tracer can mean are wrong, not errors and not right.
#[test]
fn ids_of_no_sphere_and_t_that_is_no_number_are_wrong() {
    if !has("python3") {
        return;
    }
    let desk = tempfile::tempdir().expect("a temporary folder");
    let (scene, camera) = scene("uniform:5:1", [24, 16]);
    let truth =
        reference::Tracer::new(reference::Arithmetic::Exact).render(&scene, &camera).expect("small").image;
    for (name, from, to, wrong) in [
        ("beyond.py", "(i, t) if", "(i + 5, t) if", true),
        ("nan.py", "[t for _, t in hits]", "[math.nan for _ in hits]", true),
        ("t-of-misses.py", "(0xFFFFFFFF, math.inf)", "(0xFFFFFFFF, 1e30)", false),
    ] {
        let tracer = foreign(&python(desk.path(), name, &broken(from, to)));
        let image = tracer.render(&scene, &camera, 1, &|| ()).expect("a picture").image;
        let verdict = judge(&scene, &camera, &truth, &image, tracer.promise(), None).verdict;
        assert_eq!(verdict == Verdict::Wrong, wrong, "{name}: {verdict:?}");
        let mut misses = image.ids.iter().zip(&image.t).filter(|(id, _)| **id == MISS);
        assert!(misses.all(|(_, t)| *t == f32::INFINITY), "{name}: a miss is infinitely far");
        assert!(image.ids.iter().any(|id| *id != MISS), "nothing was at stake");
    }
}

#[test]
fn all_commands_of_the_page_run() {
    if !has("python3") {
        return;
    }
    let page = std::fs::read_to_string(root().join("docs/own-tracer.md")).expect("it is there");
    let commands: Vec<&str> =
        page.lines().filter(|line| line.starts_with("cgt ") && line.contains("tracer.py")).collect();
    assert!(commands.len() >= 5, "{commands:?}");
    // Side by side, each in a folder of its own.
    let ran = commands.par_iter().with_max_len(1).map(|command| {
        let desk = desk();
        let words = shlex::split(command).expect("a command");
        let words: Vec<&str> = words.iter().skip(1).map(String::as_str).collect();
        let output = cgt(desk.path(), &words);
        assert_eq!(output.status.code(), Some(0), "{command}\n{}", said(&output));
        assert!(said(&output).contains("mine"), "{command}\n{}", said(&output));
        desk
    });
    let desks: Vec<TempDir> = ran.collect();
    let of = |word: &str| {
        let place = commands.iter().position(|command| command.split(' ').nth(1) == Some(word));
        desks[place.expect(word)].path()
    };
    let table = std::fs::read_to_string(of("chart").join("cgt-chart/chart.csv")).expect("a table");
    let row = table.lines().find(|line| line.contains(",mine,foreign,")).expect("a row of its own");
    let cells: Vec<&str> = row.split(',').collect();
    assert!(cells[9].parse::<f64>().is_ok_and(|ns| ns > 10.0), "{row}");
    let report: Value = serde_json::from_slice(
        &std::fs::read(of("report").join("cgt-report/report.json")).expect("a report"),
    )
    .expect("JSON");
    let names =
        report["scenes"][0]["subjects"].as_array().expect("subjects").iter().map(|subject| &subject["name"]);
    assert!(names.into_iter().any(|name| name == "mine"), "{report}");
    // What stands in the page is what is read.
    for (byte, what) in
        [(wire::READ, "it has read all of it"), (wire::GO, "go, the clock runs"), (wire::DONE, "done")]
    {
        assert!(page.contains(&format!("| 1 | `{}`: {what} |", char::from(byte))), "{what}");
    }
}

/// Who is said to give the truth is held to it by charts and maps too; of whom nothing was said they only show how wrong it is. A run in
/// which nothing was compared has no verdict.
#[test]
fn a_promise_of_the_truth_is_asked_for_in_charts_and_maps() {
    if !has("python3") {
        return;
    }
    let desk = desk();
    let liar = python(desk.path(), "liar.py", &broken("(i, t) if", "(i + 100, t) if"));
    let chart = ["chart", "uniform:20:1", "--size", "24x16", "--rounds", "1", "--sample", "8"];
    let maps = ["stability", "uniform:20:1", "--only", "angle", "--methods", "mine", "--rays", "64"];
    for (words, command, promise, code, named) in [
        (&chart[..], &liar, "exact", 1, true),
        (&chart, &liar, "f64", 0, false),
        (&maps, &liar, "exact", 1, true),
        (&maps, &liar, "f64", 0, false),
        (&maps, &"mine=true".to_owned(), "exact", 1, true),
        (&maps, &"mine=true".to_owned(), "f64", 3, false),
    ] {
        let output = cgt(desk.path(), &[words, &["--subject-cmd", command, "--promise", promise]].concat());
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        let what = format!("{} of {command} that promises {promise}", words[0]);
        assert_eq!(output.status.code(), Some(code), "{what}: {}", said(&output));
        assert_eq!(told.contains("wrong where it promised not to be"), named, "{what}: {told}");
        assert!(!named || told.lines().all(|line| line.contains(", mine: ")), "{what}: {told}");
    }
}

#[test]
fn names_and_options_that_make_no_sense_are_refused() {
    let desk = tempfile::tempdir().expect("a temporary folder");
    for (words, part) in [
        (
            &["verify", "--subject", "naive-f64", "--subject-cmd", "naive-f64=true"][..],
            "two tracers are called",
        ),
        (&["verify", "--promise", "f64"], "--subject-cmd"),
        (&["verify", "--subject-cmd", "'open"], "quotation"),
        (&["chart", "--subject-cmd", "fast=true"], "two tracers are called `fast`"),
        (&["stability", "--subject-cmd", "paper=true"], "two tracers are called `paper`"),
    ] {
        let output = cgt(desk.path(), words);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {}", said(&output));
        assert!(said(&output).contains(part), "{words:?}: {}", said(&output));
    }
    let output = cgt(desk.path(), &["verify", "uniform:5:1", "--size", "8x8", "--subject-cmd", "true"]);
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    assert!(said(&output).contains("Gave no picture: it ended (exit status: 0)"), "{}", said(&output));
}

/// The example implements the trait; over the pipe it is the same tracer.
#[test]
fn a_rust_tracer_is_judged_directly_and_as_a_program() {
    let (scene, camera) = scene("uniform:100:1", [33, 22]);
    let own = own_tracer::Own;
    let image = own.render(&scene, &camera, 1, &|| ()).expect("a picture").image;
    let truth =
        reference::Tracer::new(reference::Arithmetic::Exact).render(&scene, &camera).expect("small").image;
    assert_ne!(judge(&scene, &camera, &truth, &image, own.promise(), None).verdict, Verdict::Wrong);
    let question = wire::question(&scene, &camera).expect("small").concat();
    let mut answer = Vec::new();
    serve(&own, 1, &mut Cursor::new(question.repeat(2)), &mut answer).expect("served");
    let (read, done) = ([wire::READ], [wire::DONE]);
    let ids: Vec<u8> = image.ids.iter().flat_map(|id| id.to_le_bytes()).collect();
    let t: Vec<u8> = image.t.iter().flat_map(|t| t.to_le_bytes()).collect();
    let once = [&read[..], &done, &ids, &t].concat();
    assert_eq!(answer, [once.clone(), once].concat());
    // Who gives no picture refuses, and says why in so many bytes.
    let absent = foreign("/nowhere/tracer");
    let why = absent.render(&scene, &camera, 1, &|| ()).expect_err("it is not there").to_string();
    let length = u32::try_from(why.len()).expect("short").to_le_bytes();
    answer.clear();
    serve(&absent, 1, &mut Cursor::new(&question), &mut answer).expect("served");
    assert_eq!(answer, [&read[..], &[wire::REFUSED], &length, why.as_bytes()].concat());
    // A stream that is cut is no question, nor is one without its go.
    let [first, last] = wire::question(&scene, &camera).expect("small");
    for length in [3, 19, 60, 100, first.len() - 1] {
        let ended = wire::asked(&mut Cursor::new(&first[..length]));
        assert!(
            if length == 3 { ended.is_ok_and(|asked| asked.is_none()) } else { ended.is_err() },
            "{length}"
        );
    }
    let asked = wire::asked(&mut Cursor::new(&first)).expect("whole").expect("a question");
    assert_eq!(asked, (camera, 100));
    // Nor is one of another protocol or of another version of it.
    for place in [0, 4] {
        let mut other = first.clone();
        other[place] ^= 3;
        let error = wire::asked(&mut Cursor::new(&other)).expect_err("another byte");
        assert!(error.to_string().contains("`CGTQ`, version 1 is read"), "byte {place}: {error}");
    }
    let told =
        |bytes: &[u8]| wire::told(&mut Cursor::new(bytes), 100).map(|scene| scene.spheres().len()).ok();
    assert_eq!(told(&last), Some(100));
    assert_eq!([told(&last[..last.len() - 1]), told(&last[1..]), told(&[])], [None; 3]);
}
