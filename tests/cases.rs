//! Are the cases that were once found judged as they should be? Each file of `tests/cases` is a scene, a camera and a tracer; those that were
//! failures must be right, and those that show what is wrong with the paper must stay wrong. And do cases come back from their
//! files as they went in, shrink to what matters, and tell what the tracer did?

use contract::{Animation, Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use image::GenericImageView;
use optimized::crew::Crew;
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::plan::{Arithmetic, OnEvent, Packet};
use optimized::seen::Seen;
use optimized::{Events, Form, Level, Plan};
use std::path::{Path, PathBuf};
use verify::case::account::account;
use verify::case::folder::keep;
use verify::case::shrink::shrink;
use verify::case::text::TextError;
use verify::case::{Asked, Case, worst};
use verify::foreign::PROMISES;
use verify::properties::recipe::plan;
use verify::subject::NAIVE_ALL;
use verify::verdict::Verdict;
use verify::view::tally::tally;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cases")
}

fn read(path: &Path) -> Case {
    let bytes = std::fs::read(path).expect("it is listed");
    Case::from_json(&bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A case is as bad as its worst frame, wherever that stands.
#[test]
fn one_wrong_frame_is_enough() {
    let case = read(&folder().join("paper-eight-corners-miss-the-middle.json"));
    let scene = case.frames.frames()[0].clone();
    // Behind the eye nothing of it is lost.
    let mut spheres = scene.spheres().to_vec();
    spheres.iter_mut().for_each(|sphere| sphere.center[2] -= 100.0);
    let behind = Scene::new(spheres, scene.background(), scene.light()).expect("valid");
    let verdict = |frames: &[&Scene]| {
        let frames = frames.iter().copied().cloned().collect();
        let case = Case { frames: Animation::new(frames).expect("frames"), ..case.clone() };
        worst(&case.judge().expect("it is judged"))
    };
    let alone = verdict(&[&behind]);
    assert!([Verdict::Equal, Verdict::WithinBound].contains(&alone), "{alone:?}");
    for frames in [&[&scene][..], &[&behind, &scene], &[&scene, &behind], &[&behind, &scene, &behind]] {
        assert_eq!(verdict(frames), Verdict::Wrong, "of {} frames", frames.len());
    }
    assert_eq!(worst(&[]), Verdict::NotJudged);
}

/// Who is to keep a promise may do better than that, and nobody may do worse; what is known to be wrong must stay so.
#[test]
fn a_verdict_is_as_expected_or_not() {
    use Verdict::{Equal, NotJudged, Undecidable, WithinBound, Wrong};
    let case = read(&folder().join("a-tangent-hits.json"));
    for (expected, right) in [
        (Equal, &[Equal][..]),
        (WithinBound, &[Equal, WithinBound]),
        (Undecidable, &[Equal, WithinBound, Undecidable]),
        (Wrong, &[Wrong]),
        (NotJudged, &[NotJudged]),
    ] {
        let case = Case { expected, ..case.clone() };
        for verdict in [Equal, WithinBound, Undecidable, Wrong, NotJudged] {
            assert_eq!(
                case.is_as_expected(verdict),
                right.contains(&verdict),
                "{verdict:?} for {expected:?}"
            );
        }
    }
}

/// The same at every level, as the file names only one.
#[test]
fn each_case_is_judged_as_it_should_be() {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(folder()).expect("it is there").map(|e| e.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "json"));
    paths.sort();
    let (mut right, mut wrong) = (0, 0);
    for path in &paths {
        let case = read(path);
        assert!(case.why.len() > 20, "{}: it does not say what it shows", path.display());
        let asked = match case.asked.clone() {
            Asked::Foreign { name, .. } => {
                panic!("{}: `{name}` is a program, which no test has", path.display())
            }
            naive @ Asked::Naive(_) => vec![naive],
            Asked::Grid { plan, workers, .. } => {
                Level::available().into_iter().map(|level| Asked::Grid { plan, level, workers }).collect()
            }
        };
        for asked in asked {
            let case = Case { asked, ..case.clone() };
            let judged = case.judge().unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let verdict = worst(&judged);
            assert!(
                case.is_as_expected(verdict),
                "{}, {}: {verdict:?} instead of {:?}: {}; cgt replay {}",
                path.display(),
                case.asked,
                case.expected,
                judged[0].judgement.because,
                path.display(),
            );
        }
        *if case.expected == Verdict::Wrong { &mut wrong } else { &mut right } += 1;
    }
    eprintln!(
        "{right} cases are right, {wrong} are wrong as they should be, at {} levels",
        Level::available().len()
    );
    assert!(right >= 5 && wrong >= 5, "too few cases");
}

fn ball(center: [f32; 3], radius: f32) -> Sphere {
    Sphere { center, radius, color: [200, 100, 50] }
}

/// A row of spheres seen from so far that the textbook form loses their rims, with a plan of the paper's loop and no margins.
fn failing() -> Case {
    let spheres = (0u8..9).map(|i| ball([f32::from(i) * 2.5 - 10.0, 0.3, 0.1], 1.0)).collect();
    let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
    let size = Size::new(32, 24).expect("small");
    let camera =
        Camera::new([0.0, 0.0, 5000.0], [-12.0, 6.0, -5000.0], [0.75, 0.0, 0.0], [0.0, -0.5, 0.0], size);
    let plan =
        Plan { arithmetic: Arithmetic::Rounded(Form::Textbook), packet: Packet::Block, ..Plan::safe() };
    Case {
        frames: Animation::from(scene),
        camera: camera.expect("a camera"),
        asked: Asked::Grid { plan, level: Level::SCALAR, workers: 2 },
        expected: Verdict::Equal,
        pixel: Some([3, 4]),
        why: "a \"row\" of spheres,\nseen from far away".into(),
    }
}

#[test]
fn a_case_comes_back_from_its_file_as_it_went_in() {
    let plain = failing();
    let mut seen = 0;
    let naive = NAIVE_ALL.map(Asked::Naive);
    let level = Level::best().expect("a level");
    let plans =
        [Plan::paper(), Plan::safe(), Plan::fast(), Plan { on_event: OnEvent::Refuse, ..Plan::safe() }];
    let grids = plans.map(|plan| Asked::Grid { plan, level, workers: 3 });
    let programs = PROMISES.map(|(_, promise)| Asked::Foreign { name: "mine".into(), promise, tracer: None });
    for asked in naive.into_iter().chain(grids).chain(programs) {
        for expected in [Verdict::Equal, Verdict::WithinBound, Verdict::Undecidable, Verdict::Wrong] {
            let case = Case { asked: asked.clone(), expected, pixel: None, ..plain.clone() };
            let text = case.to_json();
            let back = Case::from_json(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(back.to_json(), text);
            assert_eq!(format!("{back:?}"), format!("{case:?}"));
            seen += 1;
        }
    }
    assert_eq!(seen, 52);
    // Every word of every plan.
    let mut rng = proptest::test_runner::TestRunner::deterministic();
    for _ in 0..300 {
        use proptest::strategy::{Strategy, ValueTree};
        let drawn =
            plan(&verify::properties::recipe::ARITHMETICS).new_tree(&mut rng).expect("drawn").current();
        let case = Case { asked: Asked::Grid { plan: drawn, level, workers: 1 }, ..plain.clone() };
        let back = Case::from_json(case.to_json().as_bytes()).expect("as written");
        assert!(matches!(back.asked, Asked::Grid { plan, .. } if plan == drawn), "{drawn}");
    }
}

#[test]
fn what_is_no_case_is_refused_with_the_reason() {
    let text = failing().to_json();
    let refused = |from: &str, to: &str| {
        assert!(text.contains(from), "{from} is not in {text}");
        Case::from_json(text.replacen(from, to, 1).as_bytes()).expect_err(to)
    };
    let says = |error: TextError, what: &str| assert!(error.to_string().contains(what), "{error}");
    assert!(matches!(
        refused("\"version\": 1,\n\"why", "\"version\": 2,\n\"why"),
        TextError::Version { version: 2, .. }
    ));
    assert!(matches!(refused("cgt-case", "cgt-cases"), TextError::Version { .. }));
    says(refused("\"expected\": \"equal\"", "\"expected\": \"fine\""), "unknown variant `fine`");
    says(refused("\"pixel\": [3, 4]", "\"pixel\": [3, 4], \"more\": 1"), "unknown field `more`");
    says(
        refused("\"walk\": \"flattened\"", "\"walk\": \"backwards\""),
        "walk `backwards` is none of nested, flattened, printed",
    );
    says(refused("\"workers\": 2", "\"workers\": 0"), "0 workers; 1 to 64 can be had");
    says(refused("\"level\": \"scalar\"", "\"level\": \"mmx\""), "`mmx` is no level of this processor");
    says(
        refused("\"resolution\": \"up to 32\"", "\"resolution\": \"up to 0\""),
        "`0` is no number from 1 to 255",
    );
    says(refused("\"bits\": \"3f800000\"", "\"bits\": \"7fc00000\""), "a finite number must stand here");
    assert!(matches!(Case::from_json(&text.as_bytes()[..text.len() / 2]), Err(TextError::Json(_))));
    assert!(matches!(Case::from_json(b"[]"), Err(TextError::Json(_))));
    let without = text.split(",\n\"camera\"").next().expect("a part").to_owned() + "}}";
    assert!(matches!(Case::from_json(without.as_bytes()), Err(TextError::NoCamera)), "{without}");
}

/// A failing case ends with one sphere and one pixel, and still fails; one that does not fail stays as it is.
#[test]
fn a_failing_case_shrinks_to_what_matters() {
    let case = Case { asked: Asked::Naive(NAIVE_ALL[2]), ..failing() };
    let differs = |case: &Case| {
        case.judge()
            .is_ok_and(|judged| judged[0].judgement.comparison.as_ref().is_some_and(|c| c.wrong_ids > 0))
    };
    assert!(differs(&case), "far away the textbook form should lose rims");
    let small = shrink(&case, 5_000, &differs);
    assert!(differs(&small));
    let scene = &small.frames.frames()[0];
    let size = small.camera.size();
    assert_eq!((scene.spheres().len(), size.width(), size.height()), (1, 1, 1), "{}", small.to_json());
    let whole = |v: [f32; 3]| v.iter().filter(|x| x.fract() == 0.0).count();
    let round =
        [small.camera.eye(), small.camera.du(), small.camera.dv(), scene.spheres()[0].center].map(whole);
    assert!(round.iter().sum::<usize>() >= 8, "numbers are hardly rounder: {}", small.to_json());
    assert_eq!(
        shrink(&case, 5_000, &differs).to_json(),
        small.to_json(),
        "the same case shrinks the same way"
    );
    let fine = shrink(&case, 100, &|_| false);
    assert_eq!(fine.to_json(), case.to_json());
    eprintln!("9 spheres and 768 pixels became one of each");
}

/// The account's numbers are those of the kernel: the discriminant it shows has the sign and size of the one found in f64, and what it
/// says of ids and t is in the picture.
#[test]
fn an_account_tells_what_the_tracer_did() {
    let mut apart = 0;
    for arithmetic in [
        Arithmetic::Certified,
        Form::Textbook.into(),
        Form::Perpendicular.into(),
        Arithmetic::Spu(Form::Textbook),
    ] {
        let near = Camera::new(
            [0.0, 0.0, 9.0],
            [-12.0, 6.0, -9.0],
            [0.75, 0.0, 0.0],
            [0.0, -0.5, 0.0],
            failing().camera.size(),
        );
        let plan = Plan { arithmetic, packet: Packet::Block, ..Plan::safe() };
        let asked = Asked::Grid { plan, level: Level::SCALAR, workers: 1 };
        let case = Case { asked, camera: near.expect("a camera"), ..failing() };
        let judged = &case.judge().expect("small")[0];
        let width = case.camera.size().width();
        let hit = judged.picture.ids.iter().position(|id| *id != contract::MISS).expect("something is seen");
        let pixel = [hit as u32 % width, hit as u32 / width];
        let told = account(&case, 0, pixel).expect("small");
        let id = judged.picture.ids[hit];
        let t = judged.picture.t[hit];
        assert!(
            told.contains(&format!("tracer's   sphere {id} at t = {t:?} (0x{:08x})", t.to_bits())),
            "{told}"
        );
        let exact = reference::Tracer::new(reference::Arithmetic::Exact);
        let exact = exact.render(&case.frames.frames()[0], &case.camera).expect("small").image;
        let (sees, at) = (exact.ids[hit], exact.t[hit]);
        let truth = format!("truth      sphere {sees} at t = {at:?} (0x{:08x})", at.to_bits());
        assert!(told.contains(&truth), "no {truth} in {told}");
        apart += u32::from(at.to_bits() != t.to_bits());
        for word in [
            "frustum    along -",
            "slice",
            "lists",
            "distance from the plane of the lowest Y",
            "culling: kept",
            "discriminant",
            "packet     ",
        ] {
            assert!(told.contains(word), "{arithmetic:?}: no `{word}` in\n{told}");
        }
        let met =
            told.split("\n  sphere ").find(|part| part.starts_with(&format!("{id}\n"))).expect("it is met");
        let line = met.lines().find(|line| line.contains("discriminant")).expect("it is compared");
        let numbers: Vec<f64> = line.split([' ', '?', ':']).filter_map(|word| word.parse().ok()).collect();
        // The certified form's has slopes for directions, the textbook form's directions, the perpendicular form's none.
        let ray = reference::Ray::of_pixel(&case.camera, pixel[0], pixel[1]);
        let (d, sphere) = (ray.dir.map(f64::from), failing().frames.frames()[0].spheres()[id as usize]);
        let f = [0, 1, 2].map(|i| f64::from(ray.eye[i]) - f64::from(sphere.center[i]));
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let (a, b, q) = (dot(d, d), dot(f, d), dot(f, f) - f64::from(sphere.radius).powi(2));
        let fastest = d.iter().fold(0.0f64, |fastest, x| fastest.max(x.abs()));
        let scale = match arithmetic {
            Arithmetic::Certified => fastest * fastest,
            Arithmetic::Rounded(Form::Perpendicular) => a,
            _ => 1.0,
        };
        let (expected, came) =
            ((b * b - a * q) / scale, numbers[usize::from(arithmetic != Arithmetic::Certified)]);
        assert!(
            (came - expected).abs() < 1e-3 * (b * b / scale),
            "{arithmetic:?}: {expected} is told as {line}"
        );
        assert!(told.contains(&format!("  sphere {id} at ")) && told.contains("alone"), "{told}");
    }
    assert!(apart > 0, "truth and tracer never differ, and either may stand for the other");
}

/// The grid's cells and ends are those of the grid, and the packet's counts those of the packet, each in its place.
#[test]
fn an_account_tells_the_grid_and_what_the_packet_cost() {
    // Two that each ray of the middle column hits at once, which integers decide, and two that are apart by so little that f64 can.
    let nearly = 1.0 + f32::EPSILON;
    let [up, down] = [2.5, -2.5].map(|y| move |x, radius| ball([x, y, 0.0], radius));
    let spheres = vec![up(0.5, 1.0), up(-0.5, 1.0), down(0.5, 1.0), down(-0.5, nearly)];
    let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("valid");
    let (du, dv) = ([0.0625, 0.0, 0.0], [0.0, -0.0625, 0.0]);
    let corner = [-13.5 * 0.0625, 26.5 * 0.0625, -1.0];
    let camera = Camera::new([0.0, 0.0, 5.0], corner, du, dv, Size::new(27, 53).expect("small"));
    let camera = camera.expect("a camera");
    let plan = Plan { arithmetic: Arithmetic::Certified, packet: Packet::Block, ..Plan::safe() };
    let asked = Asked::Grid { plan, level: Level::SCALAR, workers: 1 };
    let case = Case { frames: scene.clone().into(), camera, asked, ..failing() };

    let (mut memory, mut events) = (Memory::default(), Events::default());
    let seen = Seen::new(Scalar, plan, &scene, &camera, &mut memory, &mut events, &Crew::alone());
    let grid = seen.expect("small").grid.expect("there are spheres");
    let cells = grid.axes.each_ref().map(|axis| axis.n);
    let [from, to] = [0, 1].map(|end| {
        grid.axes.each_ref().map(|axis| axis.planes[if end == 0 { 0 } else { axis.planes.len() - 1 }])
    });
    assert!(cells[0] != cells[1] && from[0] != from[1] && from != to, "nothing could be mistaken");
    let line =
        format!("grid       {cells:?} cells from {from:?} to {to:?}, looked around in by {:?}", grid.widen);
    // Packets of which one number cannot stand for the next: by f64 and integers, by integers and roundings, by candidates and culled.
    let (mut told, mut apart) = (0, [0; 3]);
    for unit in tally(plan, 1, &scene, &camera).expect("small").units {
        if !(unit.rect.x[0]..unit.rect.x[1]).contains(&13) || unit.counts.split_blocks > 0 {
            continue;
        }
        let text = account(&case, 0, [13, unit.rect.y[0]]).expect("small");
        assert!(text.lines().any(|found| found == line), "no {line:?} in\n{text}");
        let c = unit.counts;
        let due = format!(
            "packet     {} cells visited, {} candidates, {} culled; of its {} lanes f32 left {} to f64, that left {} to integers, which rounded the t of {} more",
            c.cells, c.candidates, c.culled, c.lanes, c.asked_f64, c.asked_integers, c.rounded_by_integers,
        );
        assert!(text.lines().any(|found| found == due), "no {due:?} in\n{text}");
        told += 1;
        apart[0] += u32::from(c.asked_f64 != c.asked_integers);
        apart[1] += u32::from(c.asked_integers != c.rounded_by_integers);
        apart[2] += u32::from(c.cells != c.candidates && c.candidates != c.culled);
    }
    eprintln!("{told} packets, {apart:?} of them with other numbers beside each other");
    assert!(apart.iter().all(|n| *n > 0), "nothing could be mistaken: {apart:?}");
}

/// Where a block is split, what is told is of the pixel's own ray: with culling, a plane's distance is that of its slopes.
#[test]
fn an_account_of_a_split_block_tells_of_the_pixels_own_ray() {
    let case = read(&folder().join("equal-roots.json"));
    let (mut told, mut split) = (0, 0);
    for pixel in [[0, 0], [2, 0], [1, 1]] {
        let text = account(&case, 0, pixel).expect("small");
        split += u32::from(text.contains("each goes as a packet of its own"));
        let scene = &case.frames.frames()[0];
        let ray = reference::Ray::of_pixel(&case.camera, pixel[0], pixel[1]);
        let alone =
            |id: u32| Scene::new(vec![scene.spheres()[id as usize]], [0; 3], DEFAULT_LIGHT).expect("valid");
        for part in text.split("\n  sphere ").skip(1) {
            let Some(line) = part.lines().find(|line| line.contains("discriminant above its bound: a hit"))
            else {
                continue;
            };
            let id = part.lines().next().and_then(|id| id.parse().ok()).expect("an id");
            let hit = reference::Tracer::new(reference::Arithmetic::Exact).trace(&ray, &alone(id)).is_some();
            assert_eq!(line.ends_with("yes"), hit, "pixel {pixel:?}, sphere {id}: {line}");
            told += 1;
        }
    }
    assert!(split == 3 && told >= 5, "{split} split, {told} told");
}

/// What is kept is three files and a command, and the command's file is the case.
#[test]
fn a_failure_is_kept_with_its_picture_and_account() {
    let folder = tempfile::tempdir().expect("a folder");
    let case = Case { asked: Asked::Naive(NAIVE_ALL[2]), ..failing() };
    let kept = keep(&case, folder.path(), "row").expect("kept");
    let names: Vec<bool> =
        ["row.json", "row.png", "row.txt"].iter().map(|n| folder.path().join(n).is_file()).collect();
    assert_eq!(names, [true; 3]);
    assert_eq!(kept.command, format!("cgt replay {} --pixel 3,4", kept.file.display()));
    assert_eq!(read(&kept.file).to_json(), case.to_json());
    assert_eq!(std::fs::read_to_string(folder.path().join("row.txt")).expect("text"), kept.account);
    let picture = image::open(folder.path().join("row.png")).expect("a picture");
    assert_eq!((picture.width(), picture.height()), (3 * 5 * 32 + 2 * 8, 5 * 24), "three panels, magnified");
    // What came is not what was promised, and so it is shown.
    let picture = picture.to_rgb8();
    let [promised, came] =
        [0, 5 * 32 + 8].map(|left| picture.view(left, 0, 5 * 32, 5 * 24).to_image().into_raw());
    assert_ne!(promised, came, "the tracer's panel shows the promise");
}
