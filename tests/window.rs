//! Is what a window and a terminal show the tracer's picture, and do keys and mouse reach it? The program runs under Xvfb, keys are sent as a
//! keyboard would, and pixels are read back from the server; a terminal is lent by `script`. Where these are not installed, nothing is judged.
//! `CGT_SHOTS` names a folder for screenshots.

use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, Command, Output, Stdio};
use std::time::{Duration, Instant};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::subject::NamedPlan;
use verify::view::canvas::{Canvas, packed};
use verify::view::clock::{Run, Split};
use verify::view::command::{Command as Asked, KEYS, Overlay, Press, asked};
use verify::view::player::Player;
use verify::view::state::State;
use verify::view::viewer::Viewer;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{ConnectionExt, ImageFormat, InputFocus, Window};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

const CGT: &str = env!("CARGO_BIN_EXE_cgt");
/// How long is waited for what must come.
const PATIENCE: Duration = Duration::from_secs(30);

/// A process that ends with its test, whatever becomes of that.
struct Ended(Child);

impl Drop for Ended {
    fn drop(&mut self) {
        _ = self.0.kill();
        _ = self.0.wait();
    }
}

/// A display of our own.
struct Display {
    name: String,
    server: RustConnection,
    _process: Ended,
}

impl Display {
    /// `None` where there is no Xvfb.
    fn new() -> Option<Self> {
        let mut command = Command::new("Xvfb");
        command.args(["-displayfd", "1", "-screen", "0", "1400x900x24", "-nolisten", "tcp"]);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
        let Ok(mut process) = command.spawn() else {
            eprintln!("not judged: windows: Xvfb is not installed");
            return None;
        };
        let out = process.stdout.take().expect("a pipe");
        let process = Ended(process);
        let mut number = String::new();
        BufReader::new(out).read_line(&mut number).expect("Xvfb tells its display");
        let name = format!(":{}", number.trim());
        let (server, _) = x11rb::connect(Some(&name)).expect("the display answers");
        // A window needs two libraries that a bare machine may lack.
        let first = ["view", "2juy", "--frames", "1", "--size", "16x16"];
        let output =
            Command::new(CGT).args(first).env("DISPLAY", &name).output().expect("the program starts");
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.code() == Some(2) && said.contains("failed to load X") {
            eprintln!("not judged: windows: {}", said.trim());
            return None;
        }
        Some(Self { name, server, _process: process })
    }

    /// The program with a window on this display.
    fn view(&self, words: &str) -> Shown<'_> {
        let mut command = Command::new(CGT);
        command.arg("view").args(words.split(' ')).env("DISPLAY", &self.name).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let process = Ended(command.spawn().expect("the program starts"));
        let mut shown = Shown { display: self, process, window: 0, size: [0; 2] };
        shown.find();
        shown
    }
}

/// The program at work.
struct Shown<'a> {
    display: &'a Display,
    process: Ended,
    window: Window,
    size: [u16; 2],
}

impl Shown<'_> {
    /// Waits for its window, and looks at it as a user would, so that keys go there.
    fn find(&mut self) {
        let server = &self.display.server;
        let root = server.setup().roots[0].root;
        let begin = Instant::now();
        loop {
            let tree = server.query_tree(root).expect("a request").reply().expect("an answer");
            let large = tree.children.iter().find_map(|&window| {
                let shape = server.get_geometry(window).ok()?.reply().ok()?;
                let state = server.get_window_attributes(window).ok()?.reply().ok()?;
                let viewable = state.map_state == x11rb::protocol::xproto::MapState::VIEWABLE;
                (viewable && shape.width > 10).then_some((window, [shape.width, shape.height]))
            });
            if let Some((window, size)) = large {
                (self.window, self.size) = (window, size);
                break;
            }
            if let Some(status) = self.process.0.try_wait().expect("a state") {
                panic!("the program ended before there was a window: {status}");
            }
            assert!(begin.elapsed() < PATIENCE, "there is no window");
            std::thread::sleep(Duration::from_millis(10));
        }
        let focus = server.set_input_focus(InputFocus::PARENT, self.window, x11rb::CURRENT_TIME);
        focus.expect("a request").check().expect("the window takes keys");
    }

    /// The pixels of the window.
    fn grab(&self) -> Vec<u32> {
        let [width, height] = self.size;
        let server = &self.display.server;
        let image = server.get_image(ImageFormat::Z_PIXMAP, self.window, 0, 0, width, height, u32::MAX);
        let image = image.expect("a request").reply().expect("an answer");
        image.data.as_chunks().0.iter().map(|bytes| u32::from_le_bytes(*bytes) & 0x00FF_FFFF).collect()
    }

    /// Waits until the window shows what is wanted, and if it never does, says how far off it is.
    fn until(&self, what: &str, wanted: impl Fn(&[u32]) -> bool) -> Vec<u32> {
        let begin = Instant::now();
        loop {
            let seen = self.grab();
            if wanted(&seen) {
                return seen;
            }
            assert!(begin.elapsed() < PATIENCE, "the window never shows {what}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    fn until_canvas(&self, what: &str, canvas: &Canvas) -> Vec<u32> {
        assert_eq!([canvas.size().width(), canvas.size().height()], self.size.map(u32::from), "{what}");
        self.until(what, |seen| seen == canvas.pixels())
    }

    /// Presses a key of the keyboard and lets it go.
    fn key(&self, symbol: u32) {
        let server = &self.display.server;
        let (low, high) = (server.setup().min_keycode, server.setup().max_keycode);
        let map =
            server.get_keyboard_mapping(low, high - low + 1).expect("a request").reply().expect("a map");
        let each = usize::from(map.keysyms_per_keycode);
        let at =
            map.keysyms.chunks(each).position(|symbols| symbols[0] == symbol).expect("there is such a key");
        let code = low + u8::try_from(at).expect("a key's number");
        for kind in [2, 3] {
            self.send(kind, code, [0, 0]);
        }
    }

    /// Puts the mouse on a pixel of the window.
    fn point(&self, [x, y]: [i16; 2]) {
        let server = &self.display.server;
        let root = server.setup().roots[0].root;
        let place = server.translate_coordinates(self.window, root, x, y).expect("a request");
        let place = place.reply().expect("an answer");
        self.send(6, 0, [place.dst_x, place.dst_y]);
    }

    /// Sends an event as a device would: 2, 3 a key down, up; 4, 5 a button; 6 the mouse.
    fn send(&self, kind: u8, detail: u8, [x, y]: [i16; 2]) {
        let root = self.display.server.setup().roots[0].root;
        let sent = self.display.server.xtest_fake_input(kind, detail, x11rb::CURRENT_TIME, root, x, y, 0);
        sent.expect("a request").check().expect("XTEST takes it");
    }

    /// Ends with the key Q.
    fn quit(mut self) -> Output {
        self.key(u32::from('q'));
        let begin = Instant::now();
        while self.process.0.try_wait().expect("a state").is_none() {
            assert!(begin.elapsed() < PATIENCE, "Q does not end it");
            std::thread::sleep(Duration::from_millis(10));
        }
        self.output()
    }

    fn output(&mut self) -> Output {
        let read = |from: &mut dyn std::io::Read| {
            let mut bytes = Vec::new();
            from.read_to_end(&mut bytes).expect("readable");
            bytes
        };
        let status = self.process.0.wait().expect("it ends");
        let stdout = read(&mut self.process.0.stdout.take().expect("a pipe"));
        let stderr = read(&mut self.process.0.stderr.take().expect("a pipe"));
        Output { status, stdout, stderr }
    }

    fn shoot(&self, name: &str) {
        let Some(folder) = std::env::var_os("CGT_SHOTS").map(PathBuf::from) else { return };
        let [width, height] = self.size.map(u32::from);
        let bytes: Vec<u8> =
            self.grab().into_iter().flat_map(|pixel| pixel.to_be_bytes()[1..].to_vec()).collect();
        let image = image::RgbImage::from_raw(width, height, bytes).expect("as many pixels");
        image.save(folder.join(format!("{name}.png"))).expect("a file");
    }
}

/// The same view without a window.
fn viewer(word: &str, [width, height]: [u32; 2], frame: usize) -> Viewer {
    let loaded = Source::parse(word).and_then(|source| source.load()).expect("a scene");
    let size = contract::Size::new(width, height).expect("a size");
    let camera = loaded.camera(&Framing { size: Some(size), ..Framing::default() }).expect("a camera");
    let player = Player::new(loaded.animation.frames().len(), frame, 30.0);
    let state = State::new(NamedPlan::Fast, optimized::Level::best().expect("a level"), 2);
    Viewer::new(word, loaded.animation, camera, Some([0.0, 1.0, 0.0]), player, state)
}

/// The exact picture as a single run of the program gives it.
fn exact(word: &str, size: &str, frame: usize) -> Vec<u32> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("exact.png");
    let words = format!("render {word} {} --size {size} --frame {frame} --method exact", file.display());
    let output = Command::new(CGT).args(words.split(' ')).output().expect("the program starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    image::open(file).expect("a PNG").to_rgb8().pixels().map(|pixel| packed(pixel.0)).collect()
}

const RIGHT: u32 = 0xFF53;

/// Plays an animation as a user does: what is seen is the exact picture, and each key does what it says.
#[test]
fn a_window_shows_the_exact_picture_and_obeys() {
    let Some(display) = Display::new() else { return };
    let shown = display.view("2juy --size 640x360 --frame 3 --paused --threads 2");
    let third = exact("2juy", "640x360", 3);
    shown.until("the exact picture of frame 3", |seen| seen == third);
    shown.shoot("window");

    let mut same = viewer("2juy", [640, 360], 3);
    same.player.playing = false;
    let press = |same: &mut Viewer, press: Press, symbol: u32| {
        shown.key(symbol);
        same.command(asked(press).expect("a key"));
        same.draw().expect("a picture");
        same.write();
    };
    press(&mut same, Press::Char('.'), u32::from('.'));
    shown.until_canvas("frame 4", same.canvas());
    let fourth = exact("2juy", "640x360", 4);
    assert!(same.canvas().pixels() == fourth, "frame 4 is the exact one");
    press(&mut same, Press::Char(','), u32::from(','));
    shown.until_canvas("frame 3 again", same.canvas());

    press(&mut same, Press::Right, RIGHT);
    let turned = shown.until_canvas("the scene from the right", same.canvas());
    assert!(turned != third, "an orbit changes it");
    press(&mut same, Press::Char('p'), u32::from('p'));
    press(&mut same, Press::Char('p'), u32::from('p'));
    let paper = shown.until_canvas("the paper's plan", same.canvas());
    assert!(paper != turned, "the paper's plan loses spheres");
    for (key, name) in [
        ('x', "wipe"),
        ('x', ""),
        ('b', "blocks"),
        ('v', "cells"),
        ('c', "culling"),
        ('c', ""),
        ('e', "wrong"),
    ] {
        press(&mut same, Press::Char(key), u32::from(key));
        shown.until_canvas(name, same.canvas());
        if !name.is_empty() {
            shown.shoot(&format!("small-{name}"));
        }
    }
    press(&mut same, Press::Char('r'), u32::from('r'));
    for key in ['e', 'b', 'p'] {
        press(&mut same, Press::Char(key), u32::from(key));
    }
    let home = shown.until_canvas("all as at first", same.canvas());
    assert!(home == third, "all as at first");
    press(&mut same, Press::Char('h'), u32::from('h'));
    shown.until_canvas("the keys", same.canvas());
    shown.shoot("help");
    press(&mut same, Press::Char('h'), u32::from('h'));
    shown.until_canvas("no keys", same.canvas());

    // It plays until it is told not to.
    shown.key(u32::from(' '));
    let moving = shown.until("another frame", |seen| seen != third);
    shown.until("yet another frame", |seen| seen != third && seen != moving);
    shown.key(u32::from(' '));
    // What was under way when the key came may still be shown.
    std::thread::sleep(Duration::from_millis(300));
    let still = shown.grab();
    for _ in 0..5 {
        std::thread::sleep(Duration::from_millis(60));
        assert!(shown.grab() == still, "a pause stops it");
    }
    assert!((0..24).any(|frame| still == picture(frame)), "it stands at some frame, whole");

    let output = shown.quit();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{}: {said}", output.status);
    eprintln!("18 canvases, equal pixel by pixel");
}

fn picture(frame: usize) -> Vec<u32> {
    let mut viewer = viewer("2juy", [640, 360], frame);
    viewer.draw().expect("a picture");
    viewer.canvas().pixels().to_vec()
}

/// A drag turns the scene, the wheel brings it nearer, and the line of the wipe is dragged.
#[test]
fn the_mouse_reaches_it() {
    let Some(display) = Display::new() else { return };
    let shown = display.view("1hvr --size 320x180 --paused");
    let first = exact("1hvr", "320x180", 0);
    shown.until("the exact picture", |seen| seen == first);
    let drag = |button: u8, from: [i16; 2], to: [i16; 2]| {
        shown.point(from);
        std::thread::sleep(Duration::from_millis(100));
        shown.send(4, button, [0; 2]);
        std::thread::sleep(Duration::from_millis(100));
        shown.point(to);
        std::thread::sleep(Duration::from_millis(100));
        shown.send(5, button, [0; 2]);
    };
    let mut before = first.clone();
    let mut change = |what: &str, act: &dyn Fn()| {
        act();
        let begin = Instant::now();
        loop {
            let now = shown.grab();
            if now != before {
                before = now;
                break;
            }
            assert!(begin.elapsed() < PATIENCE, "{what} does nothing");
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    change("a drag", &|| drag(1, [100, 60], [140, 70]));
    change("the right button", &|| drag(3, [100, 60], [120, 50]));
    let covered = || shown.grab().iter().filter(|pixel| **pixel != first[0]).count();
    let far = covered();
    change("the wheel", &|| {
        for kind in [4, 5] {
            shown.send(kind, 4, [0; 2]);
        }
    });
    assert!(covered() > far, "turned away from who turns it, the wheel brings the scene nearer");
    shown.key(u32::from('r'));
    shown.until("the view of the beginning", |seen| seen == first);
    shown.key(u32::from('x'));
    let line = |x: usize| {
        move |seen: &[u32]| {
            (0..180).all(|y| seen[y * 320 + x] == 0x00FF_FFFF) || {
                // The panel covers its lower part.
                (0..60).all(|y| seen[y * 320 + x] == 0x00FF_FFFF)
            }
        }
    };
    shown.until("the line in the middle", line(160));
    drag(1, [161, 20], [221, 20]);
    shown.until("the line where it was dragged", line(220));
    shown.quit();
}

/// Every overlay, for screenshots as large as one is looked at; what is shown is what the library draws.
#[test]
fn overlays_arrive_in_the_window() {
    let Some(display) = Display::new() else { return };
    let large = std::env::var_os("CGT_SHOTS").is_some();
    let size = if large { [1280, 720] } else { [320, 180] };
    let pixels = format!("{}x{}", size[0], size[1]);
    for (overlay, name) in Overlay::ALL {
        if [Overlay::Times, Overlay::Help].contains(&overlay) {
            continue;
        }
        for plan in [NamedPlan::Fast, NamedPlan::Paper] {
            let words =
                format!("1hvr --size {pixels} --paused --overlay {name} --plan {} --threads 2", plan.name());
            let shown = display.view(&words);
            let mut same = viewer("1hvr", size, 0);
            same.state.plan = plan;
            same.command(Asked::Overlay(overlay));
            same.draw().expect("a picture");
            shown.until_canvas(name, same.canvas());
            shown.shoot(&format!("{name}-{}", plan.name()));
        }
    }
    for (words, name) in [
        ("1hvr --size 1280x720 --paused --wipe --overlay times", "wipe"),
        ("2juy --size 1280x720 --overlay times,cells --plan paper", "times"),
    ] {
        if large {
            let shown = display.view(words);
            shown.until("anything", |seen| seen.iter().any(|pixel| *pixel != 0));
            std::thread::sleep(Duration::from_millis(800));
            shown.shoot(name);
        }
    }
}

/// Every key of the table is a key of the window and of the terminal, and no other key stands for it.
#[test]
fn every_key_of_the_table_can_be_pressed() {
    use Press::{Char, Down, Escape, F1, Home, Left, Right, Up};
    use crossterm::event::KeyCode;
    use minifb::Key;
    use verify::view::{terminal, window};
    let named = [
        (Key::Left, Left),
        (Key::Right, Right),
        (Key::Up, Up),
        (Key::Down, Down),
        (Key::Home, Home),
        (Key::Escape, Escape),
        (Key::F1, F1),
        (Key::Space, Char(' ')),
        (Key::Comma, Char(',')),
        (Key::Period, Char('.')),
        (Key::LeftBracket, Char('[')),
        (Key::RightBracket, Char(']')),
        (Key::Equal, Char('=')),
        (Key::NumPadPlus, Char('+')),
        (Key::Minus, Char('-')),
        (Key::NumPadMinus, Char('-')),
    ];
    let letters = [
        Key::A,
        Key::B,
        Key::C,
        Key::D,
        Key::E,
        Key::F,
        Key::G,
        Key::H,
        Key::I,
        Key::J,
        Key::K,
        Key::L,
        Key::M,
        Key::N,
        Key::O,
        Key::P,
        Key::Q,
        Key::R,
        Key::S,
        Key::T,
        Key::U,
        Key::V,
        Key::W,
        Key::X,
        Key::Y,
        Key::Z,
    ];
    // A letter is called after itself.
    let letters = letters.into_iter().zip('a'..='z').map(|(key, letter)| {
        assert_eq!(format!("{key:?}").to_ascii_lowercase(), letter.to_string());
        (key, Char(letter))
    });
    let keys: Vec<(Key, Press)> = named.into_iter().chain(letters).collect();
    for (key, press) in &keys {
        assert_eq!(window::press(*key), Some(*press), "{key:?}");
    }
    assert_eq!([Key::Enter, Key::F2, Key::Key0].map(window::press), [None; 3]);
    let code = |press: Press| match press {
        Char(letter) => KeyCode::Char(letter),
        Left => KeyCode::Left,
        Right => KeyCode::Right,
        Up => KeyCode::Up,
        Down => KeyCode::Down,
        Home => KeyCode::Home,
        Escape => KeyCode::Esc,
        F1 => KeyCode::F(1),
    };
    let mut pressed = 0;
    for (press, _) in KEYS.iter().flat_map(|binding| binding.keys) {
        assert!(keys.iter().any(|(_, other)| other == press), "no key of a window is {press}");
        assert_eq!(terminal::press(code(*press)), Some(*press));
        if let Char(letter) = press {
            let large = KeyCode::Char(letter.to_ascii_uppercase());
            assert_eq!(terminal::press(large), Some(*press), "with Shift");
        }
        pressed += 1;
    }
    assert_eq!([KeyCode::Enter, KeyCode::F(2), KeyCode::Tab].map(terminal::press), [None; 3]);
    eprintln!("{pressed} keys");
}

/// A limited run tells how fast it was, in a window and without one.
#[test]
fn medians_are_of_each_part_by_itself() {
    let ms = Duration::from_millis;
    let split = |build, trace, window| Split {
        build: ms(build),
        trace: ms(trace),
        copy: ms(2 * build),
        overlay: ms(3 * trace),
        window: ms(window),
    };
    let run = Run { splits: vec![split(9, 1, 4), split(2, 8, 4), split(5, 3, 40)], wall: ms(1500) };
    assert_eq!(run.medians(), split(5, 3, 4));
    let words = "3 frames in 1.50 s, 2.0 frames a second; medians in ms: build 5.000, trace 3.000, copy 10.000, overlay 9.000, window 4.000";
    assert_eq!(run.words(), words);
    assert_eq!(split(9, 1, 4).sum(), ms(9 + 1 + 18 + 3 + 4));
}

#[test]
fn a_run_is_measured() {
    let measured = |said: &str| {
        for word in ["5 frames in", "frames a second", "build", "trace", "copy", "overlay", "window"] {
            assert!(said.contains(word), "{said}");
        }
    };
    let words = ["view", "2juy", "--size", "64x36", "--frames", "5"];
    let output = Command::new(CGT).args(words).arg("--no-window").output().expect("the program starts");
    assert!(output.status.success());
    measured(&String::from_utf8_lossy(&output.stdout));
    let Some(display) = Display::new() else { return };
    let output = Command::new(CGT).args(words).env("DISPLAY", &display.name).output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    measured(&String::from_utf8_lossy(&output.stdout));
    eprintln!("{}", String::from_utf8_lossy(&output.stdout).trim());
}

#[test]
fn without_a_display_or_a_terminal_it_says_what_else_there_is() {
    let refused = |words: &str, says: &[&str]| {
        let mut command = Command::new(CGT);
        command
            .args(words.split(' '))
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .stdin(Stdio::null());
        let output = command.output().expect("the program starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        assert!(says.iter().all(|word| said.contains(word)) && !said.contains("panicked"), "{words}: {said}");
        assert_eq!(String::from_utf8_lossy(&output.stdout), "", "{words}");
    };
    refused("view 2juy", &["no window", "--terminal", "render --frames"]);
    refused("view 2juy --terminal", &["is no terminal", "render --frames"]);
    refused("view 2juy --no-window", &["--seconds", "--frames"]);
    refused("view nosuch", &["nosuch"]);
    refused("view 2juy --frame 24", &["2juy has frames 0 to 23, not 24"]);
    refused("view 2juy --overlay nothing", &["blocks, cells, culling, lanes, wrong, times, help"]);
    refused("view 2juy --frames 3 --seconds 2", &["cannot be used with"]);
    refused("view 2juy --fps 0", &["0.01 to 1000"]);
}

/// `cgt view --help` lists every key.
#[test]
fn the_help_lists_the_keys() {
    let output = Command::new(CGT).args(["view", "--help"]).output().expect("the program starts");
    let said = String::from_utf8_lossy(&output.stdout).split_whitespace().collect::<Vec<_>>().join(" ");
    for line in verify::view::command::help() {
        let line = line.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(&line), "{line:?} is not in the help");
    }
}

// ---- terminal ----

/// The program in a terminal of 40 columns and 13 rows, to which `keys` are typed after a while, some time between any two strokes.
fn terminal(words: &str, keys: &[&[u8]]) -> Option<(Output, String)> {
    let line = format!("stty cols 40 rows 13 && exec '{CGT}' view {words}");
    let mut command = Command::new("script");
    command.args(["-qec", &line, "/dev/null"]).env("COLORTERM", "truecolor").env("TERM", "xterm-256color");
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let Ok(mut child) = command.spawn() else {
        eprintln!("not judged: terminals: `script` is not installed");
        return None;
    };
    let mut typed: ChildStdin = child.stdin.take().expect("a pipe");
    let mut child = Ended(child);
    let keys: Vec<Vec<u8>> = keys.iter().map(|keys| keys.to_vec()).collect();
    let typist = std::thread::spawn(move || {
        for keys in keys {
            std::thread::sleep(Duration::from_millis(1_500));
            _ = typed.write_all(&keys).and_then(|()| typed.flush());
        }
        // Held open until the program is done, as a keyboard is.
        typed
    });
    let mut out = Vec::new();
    let mut from = child.0.stdout.take().expect("a pipe");
    std::io::Read::read_to_end(&mut from, &mut out).expect("readable");
    let status = child.0.wait().expect("it ends");
    drop(typist.join());
    let said = String::from_utf8_lossy(&out).into_owned();
    Some((Output { status, stdout: out, stderr: Vec::new() }, said))
}

/// Upper and lower half of each character of the last picture in a terminal's output.
fn halves(said: &str) -> Vec<[u32; 2]> {
    let (mut upper, mut lower, mut seen) = (0, 0, Vec::new());
    let mut rest = said;
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        if letter == '▄' {
            seen.push([upper, lower]);
        }
        if letter == '\u{1b}'
            && let Some(codes) = rest.strip_prefix('[')
            && let Some(end) = codes.find(|c: char| c.is_ascii_alphabetic())
        {
            let numbers: Vec<u8> = codes[..end].split(';').filter_map(|n| n.parse().ok()).collect();
            match (&codes[end..=end], &numbers[..]) {
                ("m", [48, 2, r, g, b]) => upper = packed([*r, *g, *b]),
                ("m", [38, 2, r, g, b]) => lower = packed([*r, *g, *b]),
                // A new picture begins at the upper left.
                ("H", [1, 1]) => seen.clear(),
                _ => {}
            }
            rest = &codes[end + 1..];
        }
    }
    seen
}

/// A picture of 40 by 24 half characters is the tracer's, and the terminal is left as it was.
#[test]
fn a_terminal_shows_the_picture_and_is_left_clean() {
    let Some((output, said)) = terminal("2juy --terminal=blocks --frames 2", &[]) else { return };
    assert!(output.status.success(), "{said}");
    let mut same = viewer("2juy", [40, 24], 1);
    same.draw().expect("a picture");
    let wanted = wanted(&same);
    assert_eq!(halves(&said), wanted);
    clean(&said);
    eprintln!("{} half blocks", 2 * wanted.len());
}

fn clean(said: &str) {
    let place = |what: &str| said.rfind(what).unwrap_or_else(|| panic!("{what:?} is not in {said:?}"));
    assert!(place("\u{1b}[?1049h") < place("\u{1b}[?1049l"), "the other screen is left");
    assert!(place("\u{1b}[?25l") < place("\u{1b}[?25h"), "the cursor is back");
}

/// H shows the keys, there as in a window.
#[test]
fn the_keys_are_told_on_a_terminal() {
    let Some((output, said)) = terminal("2juy --terminal=blocks --paused", &[b"h", b"q"]) else { return };
    assert!(output.status.success(), "{said}");
    let mut same = viewer("2juy", [40, 24], 0);
    same.player.playing = false;
    same.draw().expect("a picture");
    let plain = wanted(&same);
    assert!(same.command(Asked::Overlay(Overlay::Help)) && same.write());
    assert_ne!(wanted(&same), plain, "nothing is at stake");
    assert_eq!(halves(&said), wanted(&same));
    clean(&said);
}

/// What a terminal shows of a view of 40 columns.
fn wanted(viewer: &Viewer) -> Vec<[u32; 2]> {
    let rows: Vec<_> = viewer.canvas().pixels().chunks(40).collect();
    rows.chunks(2).flat_map(|pair| pair[0].iter().zip(pair[1]).map(|(up, low)| [*up, *low])).collect()
}

/// Ctrl-C and Q leave it clean too; a pause is told.
#[test]
fn keys_end_a_terminal_cleanly() {
    for keys in [&b"\x03"[..], b"q", b" q"] {
        let Some((output, said)) = terminal("2juy --terminal=blocks", &[keys]) else { return };
        assert!(output.status.success(), "{keys:?}: {said}");
        clean(&said);
    }
}
