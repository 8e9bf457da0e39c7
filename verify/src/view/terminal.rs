//! A [`Viewer`] in a terminal: by the protocols of kitty, iTerm or sixel where the terminal answers that it has them, else in half blocks, in true
//! colour where `COLORTERM` says so. The picture is as large as the terminal allows; the last line says what is seen. The terminal is left as it was,
//! whatever ends it: Ctrl-C is a key here. Where standard output or input is no terminal there is an error.

use super::canvas::{Canvas, channels};
use super::clock::{Limit, Run};
use super::command::{Command, Press, asked};
use super::viewer::{ViewError, Viewer};
use contract::{Size, SizeError};
use crossterm::cursor::{Hide, MoveTo, Show};
use crossterm::event::{Event, KeyCode, KeyEventKind, KeyModifiers, poll, read};
use crossterm::style::Print;
use crossterm::terminal::{Clear, ClearType, EnterAlternateScreen, LeaveAlternateScreen};
use crossterm::{execute, terminal};
use image::{DynamicImage, Rgb, RgbImage};
use std::io::{IsTerminal, Write, stdout};
use std::time::{Duration, Instant};
use thiserror::Error;

/// The least time between two pictures: terminals draw slowly.
const TICK: Duration = Duration::from_millis(33);
/// Pixels of a picture that goes by a protocol, at most, across.
const MOST: u32 = 960;

/// Why nothing is shown.
#[derive(Debug, Error)]
pub enum TerminalError {
    /// There is no terminal.
    #[error("standard {which} is no terminal; `cgt render --frames` writes files")]
    None {
        /// `input` or `output`.
        which: &'static str,
    },
    /// It does not do as it should.
    #[error("the terminal: {0}")]
    Io(#[from] std::io::Error),
    /// It cannot be drawn on.
    #[error("the terminal: {0}")]
    Draw(#[from] viuer::ViuError),
    /// It has no room for a picture.
    #[error("the terminal has {columns} columns and {rows} rows: {cause}")]
    Small {
        /// Across.
        columns: u16,
        /// Down.
        rows: u16,
        /// What is wrong with that.
        cause: SizeError,
    },
    /// There is nothing to show.
    #[error(transparent)]
    View(#[from] ViewError),
}

/// How pictures get onto a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The best that the terminal says it has.
    Best,
    /// Half blocks; the terminal is not asked.
    Blocks,
}

/// Puts a terminal into the state for pictures, and back when it is dropped.
struct Screen;

impl Screen {
    fn new() -> std::io::Result<Self> {
        terminal::enable_raw_mode()?;
        let screen = Self;
        execute!(stdout(), EnterAlternateScreen, Hide, Clear(ClearType::All))?;
        Ok(screen)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        _ = execute!(stdout(), Show, LeaveAlternateScreen);
        _ = terminal::disable_raw_mode();
    }
}

/// Shows a view until a key ends it or the limit is reached.
///
/// # Errors
/// [`TerminalError`] if there is no terminal, or no picture.
pub fn show(viewer: &mut Viewer, limit: Limit, way: Way) -> Result<Run, TerminalError> {
    for (there, which) in [(std::io::stdin().is_terminal(), "input"), (stdout().is_terminal(), "output")] {
        if !there {
            return Err(TerminalError::None { which });
        }
    }
    // Terminals are asked before their keys are read as commands.
    let fine = way == Way::Best
        && (viuer::get_kitty_support() != viuer::KittySupport::None
            || viuer::is_iterm_supported()
            || viuer::is_sixel_supported());
    let screen = Screen::new()?;
    let (mut run, begin) = (Run::default(), Instant::now());
    let mut last = begin;
    while !limit.reached(run.splits.len(), begin.elapsed()) {
        let (columns, rows) = terminal::size()?;
        let config = config(columns, rows, fine);
        fit(viewer, columns, rows, fine)?;
        if limit == Limit::Open {
            let now = Instant::now();
            viewer.player.advance(now - last);
            last = now;
            let drawn = viewer.draw()?;
            if viewer.write() | drawn {
                let start = Instant::now();
                put(viewer, &config, rows)?;
                viewer.presented(start.elapsed());
            }
        } else {
            viewer.next(&mut run, |viewer| put(viewer, &config, rows))?;
        }
        let patience =
            if limit == Limit::Open { TICK.saturating_sub(last.elapsed()) } else { Duration::ZERO };
        if !listen(viewer, patience)? {
            break;
        }
    }
    drop(screen);
    run.wall = begin.elapsed();
    Ok(run)
}

fn config(columns: u16, rows: u16, fine: bool) -> viuer::Config {
    viuer::Config {
        width: Some(columns.into()),
        height: Some(u32::from(rows).saturating_sub(1).max(1)),
        use_kitty: fine,
        use_iterm: fine,
        use_sixel: fine,
        ..viuer::Config::default()
    }
}

/// The picture takes the size of the terminal without its last row: of half blocks one pixel across and two down a character, else the
/// same shape in finer pixels.
fn fit(viewer: &mut Viewer, columns: u16, rows: u16, fine: bool) -> Result<(), TerminalError> {
    let [width, height] = [u32::from(columns), 2 * u32::from(rows.saturating_sub(1))];
    let times = if fine { (MOST / width.max(1)).max(1) } else { 1 };
    let size = Size::new(width * times, height * times);
    let size = size.map_err(|cause| TerminalError::Small { columns, rows, cause })?;
    if size != viewer.size() {
        viewer.orbit.resize(size);
    }
    Ok(())
}

fn put(viewer: &Viewer, config: &viuer::Config, rows: u16) -> Result<(), TerminalError> {
    let image = picture(viewer.canvas());
    let mut out = stdout();
    execute!(out, MoveTo(0, 0))?;
    viuer::print(&DynamicImage::ImageRgb8(image), config)?;
    let playing = if viewer.player.playing { "" } else { ", paused" };
    let line = format!(" {} | frame {}{playing}", viewer.title(), viewer.player.frame());
    let columns = usize::try_from(config.width.unwrap_or(0)).unwrap_or(0);
    let line: String = line.chars().take(columns.saturating_sub(1)).collect();
    execute!(out, MoveTo(0, rows.saturating_sub(1)), Clear(ClearType::CurrentLine), Print(line))?;
    Ok(out.flush()?)
}

fn picture(canvas: &Canvas) -> RgbImage {
    let size = canvas.size();
    RgbImage::from_fn(size.width(), size.height(), |x, y| Rgb(channels(canvas.get(x, y).unwrap_or(0))))
}

/// Does what was pressed in that time; whether that is not to end.
fn listen(viewer: &mut Viewer, mut patience: Duration) -> std::io::Result<bool> {
    while poll(patience)? {
        patience = Duration::ZERO;
        if let Event::Key(key) = read()?
            && key.kind != KeyEventKind::Release
        {
            let control = key.modifiers.contains(KeyModifiers::CONTROL);
            let command = match key.code {
                KeyCode::Char('c') if control => Some(Command::Quit),
                code => press(code).and_then(asked),
            };
            if command.is_some_and(|command| !viewer.command(command)) {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// A key as the table of [`super::command`] has it.
#[must_use]
pub fn press(code: KeyCode) -> Option<Press> {
    Some(match code {
        KeyCode::Left => Press::Left,
        KeyCode::Right => Press::Right,
        KeyCode::Up => Press::Up,
        KeyCode::Down => Press::Down,
        KeyCode::Home => Press::Home,
        KeyCode::Esc => Press::Escape,
        KeyCode::F(1) => Press::F1,
        KeyCode::Char(c) => Press::Char(c.to_ascii_lowercase()),
        _ => return None,
    })
}
