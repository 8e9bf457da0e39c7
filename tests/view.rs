//! Does a view do what its keys say, and is what overlays show what the tracer itself counted? Player and camera by laws, keys by their table,
//! canvases against pictures and counts that are had without the view.

use contract::{Animation, Camera, DEFAULT_LIGHT, Image, Scene, Size, Sphere};
use optimized::frame::Times;
use optimized::plan::{Arithmetic, Packet};
use optimized::{Form, Level, Plan, Session, Tracer};
use rand::{Rng, RngExt};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};
use verify::judge::compare::{Fault, compare, fault_at};
use verify::picture::{PALETTE, fault_color};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::{generator, seed};
use verify::subject::NamedPlan;
use verify::view::canvas::{Canvas, channels};
use verify::view::clock::Split;
use verify::view::command::{Command, KEYS, Overlay, Press, asked, help};
use verify::view::orbit::{Move, Orbit, REACH};
use verify::view::overlay::wrong::Marked;
use verify::view::overlay::{blocks, fallback, heat, times, wrong};
use verify::view::player::Player;
use verify::view::state::State;
use verify::view::tally::{Fallback, Tally, tally};
use verify::view::text::{Corner, LINE, Line, panel};
use verify::view::viewer::Viewer;

fn rng(stream: u64) -> impl Rng {
    let seed = seed();
    eprintln!("CGT_SEED={seed}");
    generator(seed, stream)
}

fn size(width: u32, height: u32) -> Size {
    Size::new(width, height).expect("a size")
}

/// A scene by its name, and its camera for a picture of that size.
fn seen(word: &str, framing: Framing) -> (Animation, Camera) {
    let loaded = Source::parse(word).and_then(|source| source.load()).expect("a scene");
    let camera = loaded.camera(&framing).expect("a camera");
    (loaded.animation, camera)
}

fn framed(width: u32, height: u32) -> Framing {
    Framing { size: Some(size(width, height)), ..Framing::default() }
}

/// Two balls of which each ray of the middle column hits both at one distance: only integers can tell that.
fn twins() -> (Animation, Camera) {
    let ball = |x| Sphere { center: [x, 0.0, 0.0], radius: 1.0, color: [200, 80, 40] };
    let scene = Scene::new(vec![ball(0.5), ball(-0.5)], [0; 3], DEFAULT_LIGHT).expect("a scene");
    let (du, dv) = ([0.0625, 0.0, 0.0], [0.0, -0.0625, 0.0]);
    let corner = [-13.5 * 0.0625, 10.5 * 0.0625, -1.0];
    (scene.into(), Camera::new([0.0, 0.0, 5.0], corner, du, dv, size(27, 21)).expect("a camera"))
}

fn viewer(word: &str, framing: Framing, plan: NamedPlan) -> Viewer {
    let (animation, camera) = seen(word, framing);
    let player = Player::new(animation.frames().len(), 0, 30.0);
    let state = State::new(plan, Level::best().expect("a level"), 2);
    Viewer::new(word, animation, camera, Some([0.0, 1.0, 0.0]), player, state)
}

fn picture(plan: Plan, scene: &Scene, camera: &Camera) -> Image {
    let level = Level::best().expect("a level");
    Tracer::new(plan, level).render(scene, camera).expect("a picture").image
}

/// Whether a canvas shows a picture and nothing else.
fn shows(canvas: &Canvas, image: &Image) -> bool {
    let colors = image.rgba.iter().map(|[r, g, b, _]| [*r, *g, *b]);
    canvas.size() == image.size && canvas.pixels().iter().map(|pixel| channels(*pixel)).eq(colors)
}

// ---- player ----

#[test]
fn frames_follow_time_and_loop() {
    let mut rng = rng(1);
    let cases = 2_000;
    for _ in 0..cases {
        let frames: usize = rng.random_range(1..200);
        let fps = [24.0, 30.0, 60.0][rng.random_range(0..3)];
        let first: usize = rng.random_range(0..frames);
        let mut player = Player::new(frames, first, fps);
        assert_eq!(player.frame(), first);
        let faster: i32 = rng.random_range(-5..=5);
        player.faster(faster);
        // In units that binary fractions hold, so that no step is lost: a 1024th of a second.
        let mut ticks = 0u64;
        for _ in 0..rng.random_range(1..40) {
            let step: u64 = rng.random_range(0..200);
            ticks += step;
            player.advance(Duration::from_nanos(step * 1_000_000_000 / 1024));
        }
        let exact = first as f64 + ticks as f64 / 1024.0 * fps * f64::from(faster).exp2();
        let off = (exact - exact.round()).abs();
        assert!(player.frame() < frames);
        if off > 1e-4 {
            assert_eq!(player.frame(), (exact as usize) % frames, "{player:?} after {ticks}/1024 s");
        }
        let frame = player.frame();
        player.playing = false;
        player.advance(Duration::from_secs(1));
        assert_eq!(player.frame(), frame, "it stands still");
        let by: i64 = rng.random_range(-500..500);
        player.step(by);
        let wanted =
            (i64::try_from(frame).expect("small") + by).rem_euclid(i64::try_from(frames).expect("small"));
        assert_eq!(i64::try_from(player.frame()).expect("small"), wanted);
        player.step(-by);
        assert_eq!((player.frame(), player.playing), (frame, false));
    }
    eprintln!("{cases} players");
}

#[test]
fn speed_doubles_and_has_ends() {
    let mut player = Player::new(10, 0, 30.0);
    player.faster(1);
    assert_eq!(player.speed(), 2.0);
    player.faster(-2);
    assert_eq!(player.speed(), 0.5);
    player.faster(i32::MAX);
    assert_eq!(player.speed(), 32.0);
    player.faster(i32::MIN);
    assert_eq!(player.speed(), 1.0 / 32.0);
}

// ---- camera ----

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

fn direction(camera: &Camera, x: f64, y: f64) -> [f64; 3] {
    std::array::from_fn(|i| {
        let [corner, du, dv] = [camera.corner(), camera.du(), camera.dv()].map(|v| f64::from(v[i]));
        corner + x * du + y * dv
    })
}

/// Where a point is in the picture: column and row, as Cramer's rule gives them.
fn pixel(camera: &Camera, point: [f64; 3]) -> [f64; 2] {
    let eye = camera.eye().map(f64::from);
    let to: [f64; 3] = std::array::from_fn(|i| point[i] - eye[i]);
    let [corner, du, dv] = [camera.corner(), camera.du(), camera.dv()].map(|v| v.map(f64::from));
    let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    // to = s (corner + x du + y dv)
    let all = det(corner, du, dv);
    let s = det(to, du, dv) / all;
    [det(corner, to, dv) / all / s, det(corner, du, to) / all / s]
}

fn orbit(word: &str, rng: &mut impl Rng) -> (Orbit, Camera) {
    let far: f64 = rng.random_range(1.0..4.0);
    let eye = [0; 3].map(|_| rng.random_range(-100.0..100.0) * far);
    let framing = Framing { eye: Some(eye), ..framed(320, 180) };
    let (animation, camera) = seen(word, framing);
    let middle = verify::scenes::frame::middle(animation.frames().iter().flat_map(Scene::spheres));
    (Orbit::new(camera, middle, Some([0.0, 1.0, 0.0])), camera)
}

#[test]
fn orbiting_keeps_the_distance_and_looks_at_the_target() {
    let mut rng = rng(2);
    let mut moves = 0;
    for _ in 0..20 {
        let (mut orbit, _) = orbit("2juy", &mut rng);
        let (distance, target) = (apart(orbit.eye(), orbit.target()), orbit.target());
        for _ in 0..200 {
            let by = [rng.random_range(-90.0..90.0), rng.random_range(-90.0..90.0)];
            orbit.go(Move::Orbit(by));
            let camera = orbit.camera().expect("a camera");
            assert!((apart(orbit.eye(), target) / distance - 1.0).abs() < 1e-12);
            let [x, y] = pixel(&camera, target);
            assert!((x - 160.0).abs() < 0.01 && (y - 90.0).abs() < 0.01, "the target is at ({x}, {y})");
            // A small turn to the right moves the eye to what was right, one up to what was up.
            let mut small = orbit.clone();
            let at = pixel(&camera, target);
            small.go(Move::Orbit([1.0, 0.0]));
            let shift: [f64; 3] = std::array::from_fn(|i| small.eye()[i] - orbit.eye()[i]);
            let right = camera.du().map(f64::from);
            assert!((0..3).map(|i| shift[i] * right[i]).sum::<f64>() > 0.0, "right is right, {at:?}");
            moves += 1;
        }
    }
    eprintln!("{moves} turns");
}

#[test]
fn up_is_up() {
    let (animation, camera) = seen("2juy", framed(320, 180));
    let middle = verify::scenes::frame::middle(animation.frames().iter().flat_map(Scene::spheres));
    let mut orbit = Orbit::new(camera, middle, Some([0.0, 1.0, 0.0]));
    let before = orbit.eye();
    assert!(orbit.go(Move::Orbit([0.0, 10.0])));
    assert!(orbit.eye()[1] > before[1]);
    // As far as it goes and back: never over the pole, from where up would be down.
    orbit.go(Move::Orbit([0.0, 1e6]));
    let top = orbit.camera().expect("a camera");
    assert!(top.dv()[1] < 0.0 || top.dv()[1].abs() < 1e-6, "{top:?}");
    assert!(!orbit.go(Move::Orbit([0.0, 1.0])), "there is no further up");
}

#[test]
fn zooming_and_panning_can_be_undone_and_pan_by_pixels() {
    let mut rng = rng(3);
    let mut moves = 0;
    for _ in 0..300 {
        let (mut orbit, _) = orbit("1hvr", &mut rng);
        orbit.go(Move::Orbit([rng.random_range(-180.0..180.0), rng.random_range(-80.0..80.0)]));
        let (eye, target) = (orbit.eye(), orbit.target());
        let distance = apart(eye, target);
        let steps = rng.random_range(-20.0..20.0);
        orbit.go(Move::Zoom(steps));
        let zoomed = apart(orbit.eye(), target) / distance;
        assert!((zoomed / 1.1f64.powf(-steps) - 1.0).abs() < 1e-12, "{steps} steps: {zoomed}");
        orbit.go(Move::Zoom(-steps));
        assert!(apart(orbit.eye(), eye) < 1e-12 * distance);
        let by = [rng.random_range(-100.0..100.0), rng.random_range(-60.0..60.0)];
        assert!(orbit.go(Move::Pan(by)));
        let [x, y] = pixel(&orbit.camera().expect("a camera"), target);
        let off = [x - 160.0 - by[0], y - 90.0 - by[1]];
        assert!(
            off.iter().all(|off| off.abs() < 0.02),
            "panned by {by:?}, it moved by {x}, {y} from 160, 90"
        );
        assert!((apart(orbit.eye(), orbit.target()) / distance - 1.0).abs() < 1e-12);
        orbit.go(Move::Pan(by.map(|x| -x)));
        assert!(apart(orbit.eye(), eye) < 1e-11 * distance);
        moves += 4;
    }
    eprintln!("{moves} moves");
}

#[test]
fn home_is_the_camera_of_the_beginning_bit_for_bit() {
    let mut rng = rng(4);
    for word in ["1hvr", "2juy", "sphereflake:2"] {
        let (mut orbit, camera) = orbit(word, &mut rng);
        assert_eq!(orbit.camera().expect("a camera"), camera, "{word}: before it is moved");
        for by in [Move::Orbit([12.0, -7.0]), Move::Pan([3.0, 4.0]), Move::Zoom(2.0)] {
            assert!(orbit.go(by), "{word}: {by:?}");
            assert_ne!(orbit.camera().expect("a camera"), camera, "{word}: {by:?}");
        }
        assert!(orbit.go(Move::Home));
        assert_eq!(orbit.camera().expect("a camera"), camera, "{word}: back home");
    }
}

#[test]
fn no_move_takes_the_camera_away() {
    let mut rng = rng(5);
    let (mut refused, mut made) = (0, 0);
    for _ in 0..40 {
        let (mut orbit, _) = orbit("2juy", &mut rng);
        let begin = apart(orbit.eye(), orbit.target());
        for _ in 0..100 {
            let wild = |rng: &mut dyn FnMut() -> f64| rng() * 10f64.powf(rng() * 40.0);
            let mut draw = || rng.random_range(-1.0..1.0);
            let by = match (draw() * 4.0 + 4.0) as u32 {
                0..2 => Move::Orbit([wild(&mut draw), wild(&mut draw)]),
                2..4 => Move::Pan([wild(&mut draw), wild(&mut draw)]),
                4..6 => Move::Zoom(wild(&mut draw)),
                _ => Move::Home,
            };
            let before = orbit.camera().expect("a camera");
            let went = orbit.go(by);
            let camera = orbit.camera().unwrap_or_else(|error| panic!("after {by:?}: {error}"));
            made += usize::from(went);
            if !went {
                refused += 1;
                assert_eq!(camera, before, "{by:?} was not made");
            }
            let middle = direction(&camera, 160.0, 90.0);
            assert!(middle.iter().all(|x| x.is_finite()) && middle != [0.0; 3], "{by:?}: {camera:?}");
            let distance = apart(orbit.eye(), orbit.target());
            assert!(distance < begin * REACH * 1.001 + 1e30, "{by:?}");
        }
        for (width, height) in [(1, 1), (16_384, 1), (3, 777)] {
            orbit.resize(size(width, height));
            assert_eq!(orbit.camera().expect("a camera").size(), size(width, height));
        }
    }
    eprintln!("{made} moves made, {refused} not");
    assert!(made > 1000 && refused > 50, "too few of either");
}

/// What is before the target follows the mouse, a drag from edge to edge is half a turn, and the right button moves all by its pixels.
#[test]
fn a_drag_takes_the_scene_with_it() {
    let begin = || viewer("2juy", framed(320, 180), NamedPlan::Fast);
    for by in [[40.0, 0.0], [-64.0, 0.0], [0.0, 30.0], [0.0, -20.0]] {
        let mut viewer = begin();
        let (eye, target) = (viewer.orbit.eye(), viewer.orbit.target());
        let front = std::array::from_fn(|i| target[i] + 0.2 * (eye[i] - target[i]));
        let before = pixel(&viewer.orbit.camera().expect("a camera"), front);
        viewer.drag(by, true, false);
        let after = pixel(&viewer.orbit.camera().expect("a camera"), front);
        let axis = usize::from(by[0] == 0.0);
        assert!((after[axis] - before[axis]) * by[axis] > 0.0, "{by:?}: {before:?} to {after:?}");
        // Round the axis that is up, or towards it.
        let angle = |eye: [f64; 3]| {
            let [x, y, z] = std::array::from_fn(|i| eye[i] - target[i]);
            [x.atan2(z), y.atan2(x.hypot(z))][axis].to_degrees()
        };
        let turned = (angle(viewer.orbit.eye()) - angle(eye) + 540.0).rem_euclid(360.0) - 180.0;
        assert!((turned.abs() - 180.0 * by[axis].abs() / 320.0).abs() < 1e-6, "{by:?}: {turned} degrees");

        let mut viewer = begin();
        let target = viewer.orbit.target();
        viewer.drag(by, false, false);
        let [x, y] = pixel(&viewer.orbit.camera().expect("a camera"), target);
        assert!((x - 160.0 - by[0]).abs() < 0.02 && (y - 90.0 - by[1]).abs() < 0.02, "{by:?}: {x}, {y}");
    }
    // The line of the wipe is moved alone, by who takes hold of it.
    let mut viewer = begin();
    assert!(!viewer.on_line(160.0), "there is no line");
    viewer.command(Command::Wipe);
    assert_eq!(
        [147.0, 148.0, 160.0, 172.0, 173.0].map(|x| viewer.on_line(x)),
        [false, true, true, true, false]
    );
    let camera = viewer.orbit.camera();
    viewer.drag([32.0, 9.0], true, true);
    assert!((viewer.state.line() - 0.6).abs() < 1e-12 && viewer.orbit.camera() == camera);
    viewer.drag([32.0, 9.0], false, true);
    assert!((viewer.state.line() - 0.6).abs() < 1e-12 && viewer.orbit.camera() != camera, "the right button");
}

#[test]
fn the_wheel_brings_the_scene_nearer() {
    // At most eight steps at once.
    for (steps, made) in [(1.0, 1.0), (-2.0, -2.0), (0.5, 0.5), (100.0, 8.0), (-100.0, -8.0)] {
        let mut viewer = viewer("2juy", framed(32, 18), NamedPlan::Fast);
        let distance = |viewer: &Viewer| apart(viewer.orbit.eye(), viewer.orbit.target());
        let before = distance(&viewer);
        viewer.wheel(steps);
        let times = distance(&viewer) / before;
        assert!((times / 1.1f64.powf(-made) - 1.0).abs() < 1e-12, "{steps} steps: {times} times as far");
    }
}

// ---- keys ----

fn digest(viewer: &Viewer) -> String {
    let State { threads, overlays, wiped, .. } = &viewer.state;
    let camera = viewer.orbit.camera();
    let (player, words, level, line) =
        (&viewer.player, viewer.state.words(), viewer.state.level(), viewer.state.line());
    format!("{player:?} {camera:?} {words} {level} {threads} {overlays:?} {wiped} {line}")
}

#[test]
fn every_key_in_the_help_does_what_it_says_once() {
    let help = help();
    let mut all = Vec::new();
    assert_eq!(help.len(), KEYS.len());
    for (binding, line) in KEYS.iter().zip(&help) {
        assert!(line.ends_with(binding.does), "{line}");
        for (press, command) in binding.keys {
            let (keys, _) = line.split_once("  ").expect("keys and words");
            assert!(keys.split(' ').any(|word| word == press.to_string()), "{press} is not in {line:?}");
            assert_eq!(asked(*press), Some(*command), "{press}");
            assert!(!all.contains(press), "{press} is there twice");
            all.push(*press);
            let mut viewer = viewer("2juy", framed(32, 18), NamedPlan::Fast);
            viewer.orbit.go(Move::Orbit([7.0, 3.0]));
            let before = digest(&viewer);
            let goes_on = viewer.command(*command);
            assert_eq!(goes_on, *command != Command::Quit, "{press}");
            assert!(digest(&viewer) != before || !goes_on, "{press} does nothing");
        }
    }
    eprintln!("{} keys", all.len());
    assert_eq!(asked(Press::Char('z')), None);
}

/// What is shown changes with each choice, and comes round.
#[test]
fn plans_arithmetics_and_levels_come_round() {
    let scene = &seen("2juy", framed(32, 18)).0.frames()[0].clone();
    let mut state = State::new(NamedPlan::Fast, Level::best().expect("a level"), 1);
    let mut plans = Vec::new();
    for _ in 0..3 {
        for _ in 0..6 {
            plans.push(state.plan_for(scene));
            state.next_arithmetic();
        }
        state.next_plan();
    }
    assert_eq!(state.plan_for(scene), plans[0], "round");
    assert_eq!([plans[0], plans[6], plans[12]], [Plan::fast(), Plan::safe(), Plan::paper()]);
    for at in [0, 6, 12] {
        let forms = plans[at..at + 6].iter().map(|plan| format!("{:?}", plan.arithmetic));
        assert_eq!(forms.skip(1).collect::<BTreeSet<_>>().len(), 5, "five arithmetics");
    }
    let mut names = BTreeSet::new();
    for _ in Level::available() {
        names.insert(state.level().name());
        state.next_level();
    }
    assert_eq!(names.len(), Level::available().len());
    assert_eq!(state.level().name(), Level::best().expect("a level").name(), "round");
    state.more_threads(-5);
    assert_eq!(state.threads, 1);
}

// ---- what is shown ----

#[test]
fn without_overlays_a_canvas_is_the_tracers_picture() {
    let mut shown = 0;
    for (width, height) in [(64, 36), (61, 35), (1, 1)] {
        let mut viewer = viewer("2juy", framed(width, height), NamedPlan::Fast);
        for _ in 0..3 {
            for _ in 0..6 {
                for level in Level::available() {
                    viewer.draw().expect("a picture");
                    let camera = viewer.orbit.camera().expect("a camera");
                    let tracer = Tracer::new(viewer.plan(), level).workers(3);
                    let image = tracer.render(viewer.scene(), &camera).expect("a picture").image;
                    assert!(shows(viewer.canvas(), &image), "{width}x{height}: {}", viewer.title());
                    viewer.command(Command::Level);
                    viewer.command(Command::Step(1));
                    viewer.command(Command::Camera(Move::Orbit([10.0, 2.0])));
                    shown += 1;
                }
                viewer.command(Command::Arithmetic);
            }
            viewer.command(Command::Plan);
        }
    }
    eprintln!("{shown} canvases");
}

#[test]
fn what_has_not_changed_is_not_traced_again() {
    let mut viewer = viewer("2juy", framed(64, 36), NamedPlan::Fast);
    viewer.player.playing = false;
    assert!(viewer.draw().expect("a picture"));
    assert!(!viewer.draw().expect("a picture"));
    viewer.player.advance(Duration::from_secs(1));
    assert!(!viewer.draw().expect("a picture"), "it stands still");
    for command in [
        Command::Step(1),
        Command::Camera(Move::Orbit([1.0, 0.0])),
        Command::Plan,
        Command::Arithmetic,
        Command::Level,
        Command::Threads(1),
        Command::Overlay(Overlay::Cells),
        Command::Wipe,
        Command::MoveWipe(5.0),
    ] {
        viewer.command(command);
        assert!(viewer.draw().expect("a picture"), "{command:?}");
        assert!(!viewer.draw().expect("a picture"), "{command:?} once");
    }
}

/// Who traces is who was chosen, which no picture shows, and the times told are its own; of the wipe those of both.
#[test]
fn who_was_chosen_traces_and_its_times_are_told() {
    let mut viewer = viewer("2juy", framed(64, 36), NamedPlan::Fast);
    assert!(viewer.sessions().is_empty(), "nothing was traced yet");
    let (mut met, mut both) = (BTreeSet::new(), 0);
    for command in [
        Command::Step(1),
        Command::Level,
        Command::Threads(1),
        Command::Threads(1),
        Command::Level,
        Command::Plan,
        Command::Arithmetic,
        Command::Threads(-1),
        Command::Wipe,
        Command::Level,
        Command::Threads(-1),
        Command::Wipe,
        Command::Level,
    ] {
        viewer.command(command);
        viewer.draw().expect("a picture");
        let State { threads, wiped, .. } = viewer.state;
        let plans = if wiped { vec![Plan::fast(), Plan::paper()] } else { vec![viewer.plan()] };
        let level = viewer.state.level().name();
        let chosen: Vec<_> = plans.into_iter().map(|plan| (plan, level, threads)).collect();
        let sessions = viewer.sessions();
        let who = |session: &&Session| (session.plan(), session.level().name(), session.workers());
        assert_eq!(sessions.iter().map(who).collect::<Vec<_>>(), chosen, "{command:?}");
        let sum = |of: fn(&Times) -> Duration| -> Duration {
            sessions.iter().map(|session| of(&session.last().times)).sum()
        };
        let split = viewer.split();
        assert_eq!((split.build, split.trace), (sum(|t| t.build), sum(|t| t.trace)), "{command:?}");
        met.insert((level, threads));
        both += usize::from(wiped && split.build != split.trace);
    }
    eprintln!("{} choices of level and threads", met.len());
    assert!(both > 0, "nothing could be mistaken");
}

/// As many as intervals, not as pictures, and of the last 32 pictures alone.
#[test]
fn frames_a_second_are_of_the_last_pictures_shown() {
    let mut viewer = viewer("2juy", framed(32, 18), NamedPlan::Fast);
    let pause = Duration::from_millis(60);
    assert_eq!(viewer.fps(), 0.0);
    viewer.presented(Duration::from_millis(7));
    assert_eq!((viewer.fps(), viewer.split().window), (0.0, Duration::from_millis(7)));
    let shows = |viewer: &mut Viewer, pictures: u32, pause: Duration| {
        let outer = Instant::now();
        viewer.presented(Duration::ZERO);
        let (inner, mut least) = (Instant::now(), Duration::ZERO);
        for _ in 1..pictures {
            std::thread::sleep(pause);
            least = inner.elapsed();
            viewer.presented(Duration::ZERO);
        }
        let n = f64::from(pictures - 1);
        let bounds = n / outer.elapsed().as_secs_f64()..=n / least.as_secs_f64();
        assert!(bounds.contains(&viewer.fps()), "{} is not within {bounds:?}", viewer.fps());
    };
    let mut fresh = self::viewer("2juy", framed(32, 18), NamedPlan::Fast);
    shows(&mut fresh, 3, pause);
    std::thread::sleep(pause);
    shows(&mut viewer, 32, Duration::from_millis(1));
    let told = viewer.title();
    assert!(told.contains(&format!(" {:.0} fps ", viewer.fps())), "{told}");
}

/// The bar's parts are as long as the frame's, and each stands beside its name in its colour.
#[test]
fn where_the_time_goes_is_drawn_to_scale() {
    let ms = Duration::from_millis;
    let split = Split { build: ms(10), trace: ms(20), copy: ms(30), overlay: ms(40), window: ms(60) };
    let mut canvas = Canvas::new(size(640, 240));
    times::draw(&mut canvas, vec!["some words".into()], &split);
    let row =
        |y: u32| -> Vec<[u8; 3]> { (0..640).map(|x| channels(canvas.get(x, y).expect("inside"))).collect() };
    // 320 pixels are 160 ms, from the sixteenth column on.
    let runs = |y: u32| -> Vec<usize> { row(y)[16..336].chunk_by(|a, b| a == b).map(<[_]>::len).collect() };
    let bar: Vec<u32> = (0..240).filter(|y| runs(*y) == [20, 40, 60, 80, 120]).collect();
    assert_eq!(bar.len(), LINE as usize - 6, "the bar is in rows {bar:?}");
    let colors: Vec<[u8; 3]> = row(bar[0])[16..336].chunk_by(|a, b| a == b).map(|run| run[0]).collect();
    let parts = [
        "build    10.000 ms",
        "trace    20.000 ms",
        "copy     30.000 ms",
        "overlay  40.000 ms",
        "window   60.000 ms",
    ];
    let head = ["some words", "a frame 160.000 ms, 6 a second could be had"]
        .map(|words| Line::from(words.to_owned()));
    let legend =
        parts.iter().zip(&colors).map(|(words, color)| Line { color: Some(*color), words: (*words).into() });
    let mut lines: Vec<Line> = head.into_iter().chain(legend).collect();
    lines.push(Line::from(" ".repeat(41)));
    let mut words = Canvas::new(canvas.size());
    panel(&mut words, Corner::TopLeft, &lines);
    for y in (0..240).filter(|y| !bar.contains(y)) {
        assert!((0..640).all(|x| words.get(x, y) == canvas.get(x, y)), "row {y} says something else");
    }
}

#[test]
fn every_overlay_fits_every_picture() {
    let mut drawn = 0;
    for (width, height) in [(1, 1), (3, 2), (17, 5), (200, 120)] {
        for (overlay, _) in Overlay::ALL {
            for plan in NamedPlan::ALL {
                let mut viewer = viewer("2juy", framed(width, height), plan);
                viewer.draw().expect("a picture");
                let bare = viewer.canvas().clone();
                viewer.command(Command::Overlay(overlay));
                viewer.draw().expect("a picture");
                viewer.write();
                assert_eq!(viewer.canvas().size(), size(width, height));
                assert!(width < 100 || *viewer.canvas() != bare, "{overlay:?} of {plan:?} is not to be seen");
                viewer.command(Command::Overlay(overlay));
                viewer.draw().expect("a picture");
                assert_eq!(*viewer.canvas(), bare, "{overlay:?} stays");
                drawn += 1;
            }
        }
    }
    eprintln!("{drawn} overlays");
}

// ---- packets ----

fn plans() -> Vec<Plan> {
    let blocks = Plan { packet: Packet::Block, ..Plan::fast() };
    let small = Plan { packet: Packet::Tile { side: 4 }, ..Plan::fast() };
    let spu = Plan { arithmetic: Arithmetic::Spu(Form::Textbook), ..Plan::safe() };
    vec![Plan::fast(), small, blocks, Plan::safe(), Plan::paper(), spu]
}

fn scenes() -> Vec<(&'static str, Animation, Camera)> {
    let far = Framing { eye: Some([0.0, 30_000.0, 170_000.0]), fov: Some(0.02), ..framed(101, 67) };
    let within = Framing { eye: Some([0.0, 0.5, 0.1]), fov: Some(150.0), ..framed(45, 31) };
    let [juy, far, within] = [("2juy", framed(99, 61)), ("1hvr", far), ("sphereflake:2", within)]
        .map(|(word, framing)| seen(word, framing));
    let (twins, eye) = twins();
    vec![
        ("2juy", juy.0, juy.1),
        ("1hvr from afar", far.0, far.1),
        ("within a sphereflake", within.0, within.1),
        ("twins", twins, eye),
    ]
}

/// Each packet's counts add up to the fast frame's, whichever level that had; each pixel belongs to one packet; the picture is the same.
#[test]
fn packets_add_up_to_the_frame() {
    let (mut frames, mut marked, mut integers, mut split) = (0, 0, 0, 0);
    for (name, animation, camera) in scenes() {
        let scene = &animation.frames()[0];
        for plan in plans()
            .into_iter()
            .filter(|plan| name == "twins" || !matches!(plan.arithmetic, Arithmetic::Spu(_)))
        {
            for (workers, level) in [1, 2, 3].into_iter().zip(Level::available().into_iter().rev()) {
                let told = format!("{name}, {plan}, {workers} workers, {level}");
                let frame =
                    Tracer::new(plan, level).workers(workers).render(scene, &camera).expect("a picture");
                let Tally { units, fallbacks, image, counts } =
                    tally(plan, workers, scene, &camera).expect("a tally");
                assert_eq!(counts, frame.counts, "{told}");
                let same = |a: &Image, b: &Image| {
                    let bits = |image: &Image| image.t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
                    (&a.ids, bits(a), &a.rgba) == (&b.ids, bits(b), &b.rgba)
                };
                assert!(same(&image, &frame.image), "{told}");
                let mut owners = vec![0; camera.size().pixels()];
                for unit in &units {
                    for y in unit.rect.y[0]..unit.rect.y[1] {
                        for x in unit.rect.x[0]..unit.rect.x[1] {
                            owners[y as usize * camera.size().width() as usize + x as usize] += 1;
                        }
                    }
                }
                assert!(owners.iter().all(|n| *n == 1), "{told}");
                let count =
                    |of: fn(&Fallback) -> bool| fallbacks.iter().filter(|lane| of(lane)).count() as u64;
                assert_eq!(count(|lane| lane.marked), counts.asked_f64, "{told}");
                assert_eq!(count(|lane| lane.integers), counts.by_integers(), "{told}");
                marked += counts.asked_f64;
                integers += counts.by_integers();
                split += counts.split_blocks;
                frames += 1;
            }
        }
    }
    eprintln!("{frames} frames, {marked} lanes asked f64, {integers} integers, {split} blocks split");
    assert!(marked > 100 && integers > 20 && split > 0, "too little was at stake");
}

/// Where only integers can decide, the lanes named are those of the middle column.
#[test]
fn lanes_are_named_where_they_are() {
    let (animation, camera) = twins();
    for plan in [Plan::fast(), Plan { packet: Packet::Block, ..Plan::fast() }] {
        let found = tally(plan, 2, &animation.frames()[0], &camera).expect("a tally");
        let columns: BTreeSet<u32> =
            found.fallbacks.iter().filter(|lane| lane.integers).map(|lane| lane.column).collect();
        assert_eq!(columns, BTreeSet::from([13]), "{plan}");
        let rows = (0..21u32).filter(|row| found.image.ids[*row as usize * 27 + 13] == 0).collect::<Vec<_>>();
        let named = found.fallbacks.iter().filter(|lane| lane.integers && lane.row < 21).map(|lane| lane.row);
        assert!(rows.iter().all(|row| named.clone().any(|named| named == *row)), "{plan}: {rows:?}");
        eprintln!("{} rows of column 13", rows.len());
    }
}

#[test]
fn fallback_marks_those_lanes_and_no_others() {
    let mut marks = 0;
    for (name, animation, camera) in scenes() {
        let plan = Plan::fast();
        let found = tally(plan, 2, &animation.frames()[0], &camera).expect("a tally");
        let mut canvas = Canvas::new(camera.size());
        canvas.take(&found.image, 0..camera.size().width());
        fallback::draw(&mut canvas, &found, &plan);
        let mut marked = Vec::new();
        for y in 0..camera.size().height() {
            for x in 0..camera.size().width() {
                // All else is grey, or the darker colour of a frame.
                let color = channels(canvas.get(x, y).expect("inside"));
                if [fallback::BY_F64, fallback::BY_INTEGERS, fallback::ONLY_T].contains(&color) {
                    marked.push((y, x, color));
                }
            }
        }
        let inside =
            |lane: &&Fallback| lane.column < camera.size().width() && lane.row < camera.size().height();
        let lanes = found.fallbacks.iter().filter(inside);
        let mut wanted: Vec<_> = lanes.map(|lane| (lane.row, lane.column, fallback::color(lane))).collect();
        wanted.dedup_by_key(|(y, x, _)| (*y, *x));
        assert_eq!(marked, wanted, "{name}");
        marks += marked.len();
    }
    eprintln!("{marks} marks");
    assert!(marks > 50);
}

#[test]
fn edges_are_where_the_frame_was_cut() {
    let (animation, camera) = seen("2juy", framed(300, 170));
    for plan in [Plan::fast(), Plan { packet: Packet::Tile { side: 16 }, ..Plan::fast() }, Plan::paper()] {
        for workers in [1, 2, 4] {
            let found = tally(plan, workers, &animation.frames()[0], &camera).expect("a tally");
            let mut canvas = Canvas::new(camera.size());
            blocks::draw(&mut canvas, &plan, workers);
            let columns: BTreeSet<u32> = found.units.iter().map(|unit| unit.rect.x[0]).collect();
            let rows: BTreeSet<u32> = found.units.iter().map(|unit| unit.rect.y[0]).collect();
            for y in 0..170 {
                for x in 0..300 {
                    let edge = channels(canvas.get(x, y).expect("inside")) == blocks::EDGE;
                    let wanted = plan.packet != Packet::Block && (columns.contains(&x) || rows.contains(&y));
                    assert_eq!(edge, wanted, "({x}, {y}) of {plan}, {workers} workers");
                }
            }
        }
    }
}

/// The dearest packet has the end of the scale, half of it the middle, none the dimmed picture.
#[test]
fn heat_follows_the_counts() {
    let lightness =
        |[r, g, b]: [u8; 3]| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
    let steps: Vec<f64> = (0..=100).map(|i| lightness(heat::color(f64::from(i) / 100.0))).collect();
    assert!(steps.is_sorted() && steps[100] > steps[0] + 100.0, "lighter is more");
    let (animation, camera) = seen("2juy", framed(160, 90));
    for (quantity, plan) in [(heat::Quantity::Cells, Plan::paper()), (heat::Quantity::Culled, Plan::safe())] {
        let found = tally(plan, 2, &animation.frames()[0], &camera).expect("a tally");
        let mut dim = Canvas::new(camera.size());
        dim.take(&found.image, 0..160);
        dim.dim();
        let mut canvas = Canvas::new(camera.size());
        canvas.take(&found.image, 0..160);
        heat::draw(&mut canvas, &found, quantity, &plan);
        // On the background, which is the same everywhere, more is lighter.
        let mut seen = Vec::new();
        for unit in &found.units {
            let counts = &unit.counts;
            let number = match quantity {
                heat::Quantity::Cells => counts.cells,
                heat::Quantity::Culled if counts.candidates == 0 => 0,
                heat::Quantity::Culled => counts.culled * 100 / counts.candidates,
            };
            let [x, y] = [unit.rect.x[0], unit.rect.y[0]];
            if number == 0 {
                assert_eq!(canvas.get(x, y), dim.get(x, y), "nothing is left as it is");
            } else if found.image.ids[y as usize * 160 + x as usize] == contract::MISS {
                seen.push((number, lightness(channels(canvas.get(x, y).expect("inside")))));
            }
        }
        seen.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        assert!(seen.is_sorted_by(|a, b| a.1 <= b.1 + 1.0), "{quantity:?}");
        let different = seen.iter().map(|(number, _)| number).collect::<BTreeSet<_>>().len();
        eprintln!("{quantity:?}: {} packets before the background, {different} numbers", seen.len());
        assert!(different > 3);
    }
}

// ---- wrong pixels ----

#[test]
fn wrong_pixels_are_those_that_differ() {
    let mut all = 0;
    for word in ["1hvr", "sphereflake:3", "2juy"] {
        let (animation, camera) = seen(word, framed(320, 180));
        let scene = &animation.frames()[0];
        let (truth, shown) = (picture(Plan::fast(), scene, &camera), picture(Plan::paper(), scene, &camera));
        let differ = |i: usize| {
            truth.ids[i] != shown.ids[i]
                || truth.t[i].to_bits() != shown.t[i].to_bits()
                || truth.rgba[i] != shown.rgba[i]
        };
        for (until, marks) in [
            (0, Marked::All),
            (100, Marked::All),
            (320, Marked::All),
            (100, Marked::Spheres),
            (320, Marked::Spheres),
        ] {
            let mut canvas = Canvas::new(camera.size());
            canvas.take(&shown, 0..until);
            canvas.take(&truth, until..320);
            let wrong = wrong::draw(&mut canvas, &truth, &shown, until, marks);
            let counted = (0..truth.ids.len()).filter(|i| differ(*i)).count() as u64;
            assert_eq!(wrong.all(), counted, "{word}");
            let judged = compare(&truth, &shown).expect("two pictures");
            let of = |fault: Fault| wrong.0[fault as usize];
            assert_eq!(
                [of(Fault::Missing), of(Fault::Extra), of(Fault::Swapped), of(Fault::T)],
                [judged.missing, judged.extra, judged.swapped, judged.wrong_t],
                "{word}"
            );
            let mut marked = 0;
            for (i, pixel) in canvas.pixels().iter().enumerate() {
                let (x, color) = (u32::try_from(i % 320).expect("small"), channels(*pixel));
                let of = |image: &Image| <[u8; 3]>::try_from(&image.rgba[i][..3]).expect("three");
                let told = match marks {
                    Marked::All => differ(i),
                    Marked::Spheres => truth.ids[i] != shown.ids[i],
                };
                match (x < until, told) {
                    (false, _) => assert_eq!(color, of(&truth), "{word}: right of the line"),
                    (true, false) => assert_eq!(color, of(&shown), "{word}: left of the line, right"),
                    (true, true) => {
                        assert!(PALETTE.iter().any(|(_, mark, _)| *mark == color), "{word}: unmarked");
                        marked += 1;
                    }
                }
            }
            let all = if marks == Marked::All { counted } else { judged.wrong_ids };
            assert!(until < 320 || marked == all, "{word}: all are marked");
        }
        all += compare(&truth, &shown).expect("two pictures").wrong_ids;
    }
    eprintln!("{all} wrong pixels of the paper's plan");
    assert!(all > 5_000);
}

/// The wipe shows the paper left and the truth right, above its panel, and moves.
#[test]
fn the_wipe_shows_both() {
    let mut viewer = viewer("1hvr", framed(640, 360), NamedPlan::Safe);
    viewer.command(Command::Wipe);
    let camera = viewer.orbit.camera().expect("a camera");
    let scene = viewer.scene().clone();
    let (truth, paper) = (picture(Plan::fast(), &scene, &camera), picture(Plan::paper(), &scene, &camera));
    for by in [0.0, -20.0, 30.0, 1000.0] {
        viewer.command(Command::MoveWipe(by));
        viewer.draw().expect("a picture");
        let column = (viewer.state.line() * 640.0).round() as u32;
        let (mut left, mut right) = (0, 0);
        for y in 0..200u32 {
            for x in 0..640u32 {
                let i = (y * 640 + x) as usize;
                let color = channels(viewer.canvas().get(x, y).expect("inside"));
                let of = |image: &Image| <[u8; 3]>::try_from(&image.rgba[i][..3]).expect("three");
                if x.abs_diff(column) <= 1 {
                    assert_eq!(color, if x == column { [0xFF; 3] } else { [0; 3] }, "the line at {column}");
                } else if x > column {
                    assert_eq!(color, of(&truth), "({x}, {y})");
                    right += 1;
                } else if truth.ids[i] != paper.ids[i] {
                    let fault = fault_at(&truth, &paper, i).expect("it differs");
                    assert_eq!(color, fault_color(fault), "({x}, {y}): {fault:?}");
                    left += 1;
                } else {
                    assert_eq!(color, of(&paper), "({x}, {y})");
                }
            }
        }
        eprintln!("line at {column}: {left} wrong pixels left of it, {right} pixels right");
        assert!((left > 0 || column < 320) && (right > 0) == (column < 638));
        let counted = viewer.wrong().expect("it was asked");
        let judged = compare(&truth, &paper).expect("two pictures");
        assert_eq!(counted.0[..4], [judged.missing, judged.extra, judged.swapped, judged.wrong_t]);
    }
}
