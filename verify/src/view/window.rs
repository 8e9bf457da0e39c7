//! A window that shows a [`Viewer`]: X11 on Linux (and under Wayland by its own X server), the system's own elsewhere. Keys and mouse go to the
//! viewer, what it draws is shown pixel by pixel; the picture follows the window's size. Without a display there is a typed error.

use super::clock::{Limit, Run};
use super::command::{Command, Press, asked};
use super::viewer::{ViewError, Viewer};
use contract::Size;
use minifb::{InputCallback, Key, MouseButton, MouseMode, ScaleMode, Window, WindowOptions};
use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};
use thiserror::Error;

/// Between two looks at keys and clock.
const TICK: Duration = Duration::from_micros(8_000);
/// After which a picture is shown again though it is the same: another window may have lain over it.
const AGAIN: Duration = Duration::from_millis(100);
/// Between two titles.
const TITLE: Duration = Duration::from_millis(250);

/// Why there is no window.
#[derive(Debug, Error)]
pub enum WindowError {
    /// It cannot be had or was lost.
    #[error(
        "no window: {cause}; `--terminal` shows it in a terminal, `--no-window` only times it, `cgt render --frames` writes files"
    )]
    Display {
        /// What the system says.
        cause: String,
    },
    /// There is nothing to show.
    #[error(transparent)]
    View(#[from] ViewError),
}

/// Shows a view until it is closed or the limit is reached. Without a limit it plays in real time; with one, frame after frame, each once, as
/// fast as it can, and neither waits for the display.
///
/// # Errors
/// [`WindowError`] if there is no window or no picture.
pub fn show(viewer: &mut Viewer, limit: Limit) -> Result<Run, WindowError> {
    let [width, height] = sides(viewer);
    let options =
        WindowOptions { resize: true, scale_mode: ScaleMode::UpperLeft, ..WindowOptions::default() };
    let mut window = Window::new(&viewer.title(), width, height, options).map_err(lost)?;
    // What paces is the clock below, so that no wait counts as the window's time.
    window.set_target_fps(0);
    let keys = Keys::default();
    window.set_input_callback(Box::new(keys.clone()));
    let (mut run, begin) = (Run::default(), Instant::now());
    let (mut last, mut titled) = (begin, begin);
    let mut shown: Option<Instant> = None;
    let mut mouse = Mouse::default();
    while window.is_open() && !limit.reached(run.splits.len(), begin.elapsed()) {
        if !keys.take().into_iter().all(|command| viewer.command(command)) {
            break;
        }
        mouse.moved(&window, viewer);
        follow(&window, viewer);
        if limit == Limit::Open {
            let now = Instant::now();
            viewer.player.advance(now - last);
            last = now;
            let drawn = viewer.draw()?;
            let written = viewer.write();
            if drawn || written || shown.is_none_or(|shown| shown.elapsed() > AGAIN) {
                let start = Instant::now();
                present(&mut window, viewer)?;
                shown = Some(start);
                if drawn {
                    viewer.presented(start.elapsed());
                }
            } else {
                window.update();
            }
            std::thread::sleep(TICK.saturating_sub(last.elapsed()));
        } else {
            viewer.next(&mut run, |viewer| present(&mut window, viewer))?;
        }
        if titled.elapsed() > TITLE {
            window.set_title(&viewer.title());
            titled = Instant::now();
        }
    }
    run.wall = begin.elapsed();
    Ok(run)
}

fn lost(error: minifb::Error) -> WindowError {
    WindowError::Display { cause: error.to_string() }
}

fn sides(viewer: &Viewer) -> [usize; 2] {
    let size = viewer.size();
    [size.width() as usize, size.height() as usize]
}

fn present(window: &mut Window, viewer: &Viewer) -> Result<(), WindowError> {
    let canvas = viewer.canvas();
    let [width, height] = [canvas.size().width() as usize, canvas.size().height() as usize];
    window.update_with_buffer(canvas.pixels(), width, height).map_err(lost)
}

/// What was pressed, in its order: none is lost, however long a frame takes and however shortly a key is down.
#[derive(Clone, Default)]
struct Keys(Rc<RefCell<Pressed>>);

#[derive(Default)]
struct Pressed {
    held: Vec<Key>,
    asked: Vec<Command>,
}

impl Keys {
    /// What has been asked since.
    fn take(&self) -> Vec<Command> {
        std::mem::take(&mut self.0.borrow_mut().asked)
    }
}

impl InputCallback for Keys {
    fn add_char(&mut self, _: u32) {}

    fn set_key_state(&mut self, key: Key, down: bool) {
        let pressed = &mut *self.0.borrow_mut();
        let held = pressed.held.contains(&key);
        if !down {
            pressed.held.retain(|other| *other != key);
        } else if let Some(command) = press(key).and_then(asked)
            && (!held || command.repeats())
        {
            pressed.asked.push(command);
        }
        if down && !held {
            pressed.held.push(key);
        }
    }
}

/// The picture takes the window's size, if it may have that.
fn follow(window: &Window, viewer: &mut Viewer) {
    let (width, height) = window.get_size();
    if let (Ok(width), Ok(height)) = (u32::try_from(width), u32::try_from(height))
        && let Ok(size) = Size::new(width, height)
        && size != viewer.size()
    {
        _ = viewer.orbit.resize(size);
    }
}

/// What the mouse is doing.
#[derive(Default)]
struct Mouse {
    at: Option<[f64; 2]>,
    /// Whether the drag under way moves the line of the wipe.
    on_line: bool,
}

impl Mouse {
    fn moved(&mut self, window: &Window, viewer: &mut Viewer) {
        if let Some((_, wheel)) = window.get_scroll_wheel() {
            viewer.wheel(f64::from(wheel));
        }
        let [left, right] =
            [MouseButton::Left, MouseButton::Right].map(|button| window.get_mouse_down(button));
        let at = window.get_mouse_pos(MouseMode::Pass).map(|(x, y)| [f64::from(x), f64::from(y)]);
        let Some(now) = at.filter(|_| left || right) else {
            self.at = None;
            return;
        };
        match self.at {
            None => self.on_line = left && viewer.on_line(now[0]),
            Some(before) if before != now => {
                viewer.drag([now[0] - before[0], now[1] - before[1]], left, self.on_line);
            }
            Some(_) => {}
        }
        self.at = Some(now);
    }
}

/// A key as the table of [`super::command`] has it.
#[must_use]
pub fn press(key: Key) -> Option<Press> {
    Some(match key {
        Key::Left => Press::Left,
        Key::Right => Press::Right,
        Key::Up => Press::Up,
        Key::Down => Press::Down,
        Key::Home => Press::Home,
        Key::Escape => Press::Escape,
        Key::F1 => Press::F1,
        Key::Space => Press::Char(' '),
        Key::Comma => Press::Char(','),
        Key::Period => Press::Char('.'),
        Key::LeftBracket => Press::Char('['),
        Key::RightBracket => Press::Char(']'),
        Key::Equal => Press::Char('='),
        Key::NumPadPlus => Press::Char('+'),
        Key::Minus | Key::NumPadMinus => Press::Char('-'),
        letter => Press::Char(LETTERS.iter().find(|(key, _)| *key == letter)?.1),
    })
}

const LETTERS: [(Key, char); 26] = [
    (Key::A, 'a'),
    (Key::B, 'b'),
    (Key::C, 'c'),
    (Key::D, 'd'),
    (Key::E, 'e'),
    (Key::F, 'f'),
    (Key::G, 'g'),
    (Key::H, 'h'),
    (Key::I, 'i'),
    (Key::J, 'j'),
    (Key::K, 'k'),
    (Key::L, 'l'),
    (Key::M, 'm'),
    (Key::N, 'n'),
    (Key::O, 'o'),
    (Key::P, 'p'),
    (Key::Q, 'q'),
    (Key::R, 'r'),
    (Key::S, 's'),
    (Key::T, 't'),
    (Key::U, 'u'),
    (Key::V, 'v'),
    (Key::W, 'w'),
    (Key::X, 'x'),
    (Key::Y, 'y'),
    (Key::Z, 'z'),
];
