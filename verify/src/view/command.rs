//! What can be asked of a view, and the keys that ask it: one table, from which the window, the terminal and both helps are made.

use super::orbit::Move;
use std::fmt;

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// Play, or stand still.
    Pause,
    /// So many frames on, or back, and stand still.
    Step(i64),
    /// Twice as fast so many times, or half.
    Faster(i32),
    /// Move the camera.
    Camera(Move),
    /// The next plan.
    Plan,
    /// The next arithmetic.
    Arithmetic,
    /// The next SIMD level.
    Level,
    /// So many threads more, or less.
    Threads(i32),
    /// Show an overlay, or hide it.
    Overlay(Overlay),
    /// Show the paper's plan beside the exact one, or no longer.
    Wipe,
    /// Move the line between them by so many hundredths of the picture.
    MoveWipe(f64),
    /// End.
    Quit,
}

impl Command {
    /// Whether a key that is held asks it again and again.
    #[must_use]
    pub fn repeats(self) -> bool {
        matches!(self, Self::Step(_) | Self::Camera(_) | Self::MoveWipe(_))
    }
}

/// What can be laid over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Overlay {
    /// The edges of blocks and tiles.
    Blocks,
    /// Cells of the grid that each packet visited.
    Cells,
    /// What part of its candidates each packet culled.
    Culling,
    /// Rays that f32 left to f64 or integers.
    Lanes,
    /// Pixels that differ from the exact picture.
    Wrong,
    /// Where the time goes.
    Times,
    /// The keys.
    Help,
}

impl Overlay {
    /// All of them with a word for each.
    pub const ALL: [(Self, &'static str); 7] = [
        (Self::Blocks, "blocks"),
        (Self::Cells, "cells"),
        (Self::Culling, "culling"),
        (Self::Lanes, "lanes"),
        (Self::Wrong, "wrong"),
        (Self::Times, "times"),
        (Self::Help, "help"),
    ];
}

/// A key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// What it writes, in lower case.
    Char(char),
    /// An arrow.
    Left,
    /// An arrow.
    Right,
    /// An arrow.
    Up,
    /// An arrow.
    Down,
    /// Back to the beginning.
    Home,
    /// Away.
    Escape,
    /// The first function key.
    F1,
}

impl fmt::Display for Press {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Char(' ') => f.write_str("Space"),
            Self::Char(c) => write!(f, "{}", c.to_uppercase()),
            other => write!(f, "{other:?}"),
        }
    }
}

/// Keys and what they ask: of a line of the help as many commands as keys, or one for all of them.
#[derive(Clone, Copy, Debug)]
pub struct Binding {
    /// Each with its command.
    pub keys: &'static [(Press, Command)],
    /// What they do.
    pub does: &'static str,
}

const fn key(c: char, command: Command) -> (Press, Command) {
    (Press::Char(c), command)
}

/// Degrees that a key turns the camera by.
const TURN: f64 = 5.0;
/// Pixels that a key moves the picture by.
const SHIFT: f64 = 20.0;

const fn orbit(x: f64, y: f64) -> Command {
    Command::Camera(Move::Orbit([x, y]))
}

const fn pan(x: f64, y: f64) -> Command {
    Command::Camera(Move::Pan([x, y]))
}

/// All keys, in the order of the help.
pub const KEYS: &[Binding] = &[
    Binding { keys: &[key(' ', Command::Pause)], does: "pause, or play on" },
    Binding {
        keys: &[key(',', Command::Step(-1)), key('.', Command::Step(1))],
        does: "a frame back, a frame on, and pause",
    },
    Binding {
        keys: &[key('[', Command::Faster(-1)), key(']', Command::Faster(1))],
        does: "half as fast, twice as fast",
    },
    Binding {
        keys: &[
            (Press::Left, orbit(-TURN, 0.0)),
            (Press::Right, orbit(TURN, 0.0)),
            (Press::Up, orbit(0.0, TURN)),
            (Press::Down, orbit(0.0, -TURN)),
        ],
        does: "orbit (or drag)",
    },
    Binding {
        keys: &[
            key('w', pan(0.0, SHIFT)),
            key('a', pan(SHIFT, 0.0)),
            key('s', pan(0.0, -SHIFT)),
            key('d', pan(-SHIFT, 0.0)),
        ],
        does: "pan (or drag with the right button)",
    },
    Binding {
        keys: &[
            key('+', Command::Camera(Move::Zoom(1.0))),
            key('=', Command::Camera(Move::Zoom(1.0))),
            key('-', Command::Camera(Move::Zoom(-1.0))),
        ],
        does: "nearer, farther (or the wheel)",
    },
    Binding {
        keys: &[(Press::Home, Command::Camera(Move::Home)), key('r', Command::Camera(Move::Home))],
        does: "the view of the beginning",
    },
    Binding { keys: &[key('p', Command::Plan)], does: "next plan: fast, safe, paper" },
    Binding {
        keys: &[key('m', Command::Arithmetic)],
        does: "next arithmetic: the plan's own, exact, f32, SPU",
    },
    Binding { keys: &[key('l', Command::Level)], does: "next SIMD level" },
    Binding {
        keys: &[key('t', Command::Threads(1)), key('y', Command::Threads(-1))],
        does: "a thread more, a thread less",
    },
    Binding { keys: &[key('b', Command::Overlay(Overlay::Blocks))], does: "blocks and tiles" },
    Binding { keys: &[key('v', Command::Overlay(Overlay::Cells))], does: "cells visited, a packet" },
    Binding {
        keys: &[key('c', Command::Overlay(Overlay::Culling))],
        does: "part of the candidates that is culled",
    },
    Binding {
        keys: &[key('f', Command::Overlay(Overlay::Lanes))],
        does: "rays that fall back to f64, to integers",
    },
    Binding {
        keys: &[key('e', Command::Overlay(Overlay::Wrong))],
        does: "pixels that differ from the exact ones",
    },
    Binding { keys: &[key('x', Command::Wipe)], does: "the paper's plan | the exact one (drag the line)" },
    Binding {
        keys: &[key('j', Command::MoveWipe(-5.0)), key('k', Command::MoveWipe(5.0))],
        does: "move the line between them",
    },
    Binding { keys: &[key('i', Command::Overlay(Overlay::Times))], does: "where the time goes" },
    Binding {
        keys: &[key('h', Command::Overlay(Overlay::Help)), (Press::F1, Command::Overlay(Overlay::Help))],
        does: "these keys",
    },
    Binding { keys: &[key('q', Command::Quit), (Press::Escape, Command::Quit)], does: "end" },
];

/// What a key asks, if anything.
#[must_use]
pub fn asked(press: Press) -> Option<Command> {
    let all = KEYS.iter().flat_map(|binding| binding.keys);
    all.clone().find(|(key, _)| *key == press).map(|(_, command)| *command)
}

/// The table as lines: keys, two spaces, what they do.
#[must_use]
pub fn help() -> Vec<String> {
    let keys = |binding: &Binding| {
        binding.keys.iter().map(|(press, _)| press.to_string()).collect::<Vec<_>>().join(" ")
    };
    let wide = KEYS.iter().map(|binding| keys(binding).len()).max().unwrap_or(0);
    KEYS.iter().map(|binding| format!("{:<wide$}  {}", keys(binding), binding.does)).collect()
}
