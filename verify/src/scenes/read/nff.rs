//! Eric Haines' neutral file format (Standard Procedural Databases). Read are `b` background, `v` viewpoint, `l`
//! light, `f` fill colour and `s` sphere; every other line is passed over with a warning that names it, polygons
//! with the lines of their vertices. Refused are numbers that are none, radii not above zero and files without
//! a sphere.
//!
//! Colours are clamped to 0 to 1. Our light is a direction: from the origin towards the first light. `v` becomes a
//! [`Framing`]; its angle is that of the picture's height. A light of another colour than white is drawn white, and what shines or
//! lets light through is drawn matte, each with a warning.

use super::frames::{Frames, Input};
use super::text::{Line, Lines, NUMBER, Word};
use super::{Format, Loaded, ReadError};
use crate::scenes::frame::Framing;
use contract::{Rgb, Size, Sphere};

struct State {
    color: Rgb,
    light: Option<[f32; 3]>,
    view: Option<Framing>,
    spheres: Vec<Sphere>,
    /// Lines of vertices still to pass over.
    vertices: u64,
    /// What the line before began as, if it was a viewpoint.
    in_view: bool,
    /// The first line of a fill colour that is not matte.
    not_matte: Option<usize>,
}

pub(super) fn read(input: Input<'_>) -> Result<Loaded, ReadError> {
    let Input { file, bytes, .. } = input;
    let mut frames = Frames::new(input);
    let mut state = State {
        color: [255, 255, 255],
        light: None,
        view: None,
        spheres: Vec::new(),
        vertices: 0,
        in_view: false,
        not_matte: None,
    };
    for line in Lines::new(file, "NFF", bytes)? {
        read_line(line, &mut state, &mut frames)?;
    }
    if state.vertices > 0 {
        frames.warn(None, format!("the file ends {} vertices before its last polygon does", state.vertices));
    }
    if let Some(line) = state.not_matte {
        frames.warn(Some(line), "a reflectance passed over, the first: all is drawn matte");
    }
    frames.light = state.light.unwrap_or(frames.light);
    if !state.spheres.is_empty() {
        frames.push(state.spheres)?;
    }
    let mut loaded = frames.finish(Format::Nff, "no sphere")?;
    loaded.framing = state.view;
    Ok(loaded)
}

fn read_line(line: Line<'_>, state: &mut State, frames: &mut Frames<'_>) -> Result<(), ReadError> {
    let mut words = line.words();
    let Some(key) = words.next() else { return Ok(()) };
    if state.vertices > 0 && key.text[0].is_ascii_alphabetic() {
        frames.warn(Some(line.number), format!("a polygon ends {} vertices early", state.vertices));
        state.vertices = 0;
    } else if state.vertices > 0 {
        state.vertices -= 1;
        return Ok(());
    }
    if state.in_view && view_line(line, key, &mut words, state)? {
        return Ok(());
    }
    state.in_view = false;
    match key.text {
        b"b" => frames.background = color(line, &mut words)?,
        b"v" => {
            state.in_view = true;
            state.view = Some(Framing::default());
        }
        b"l" => light(line, &mut words, state, frames)?,
        b"f" => {
            state.color = color(line, &mut words)?;
            if !is_matte(words) {
                state.not_matte.get_or_insert(line.number);
            }
        }
        b"s" => {
            let center = line.vector(&mut words, ["x", "y", "z"])?;
            let radius = line.take(&mut words, "radius", NUMBER)?.radius("radius")?;
            frames.put(&mut state.spheres, Sphere { center, radius, color: state.color }, 0)?;
        }
        text if text[0] == b'#' => {}
        b"p" | b"pp" | b"tpp" => {
            let count = line.take(&mut words, "vertices", "a count must stand here")?;
            state.vertices = count.whole("vertices")?;
            frames.warn(Some(line.number), format!("polygon {:?} passed over", key.shown()));
        }
        _ => frames.warn(Some(line.number), format!("{:?} passed over", key.shown())),
    }
    Ok(())
}

/// Reads a line that belongs to the viewpoint; whether it did.
fn view_line<'a>(
    line: Line<'a>,
    key: Word<'a>,
    words: &mut impl Iterator<Item = Word<'a>>,
    state: &mut State,
) -> Result<bool, ReadError> {
    let mut view = state.view.unwrap_or_default();
    let axes = ["x", "y", "z"];
    match key.text {
        b"from" => view.eye = Some(line.vector(words, axes)?.map(f64::from)),
        b"at" => view.target = Some(line.vector(words, axes)?.map(f64::from)),
        b"up" => view.up = Some(line.vector(words, axes)?.map(f64::from)),
        b"angle" => view.fov = Some(f64::from(line.take(words, "angle", NUMBER)?.number("angle")?)),
        b"hither" => {
            line.take(words, "hither", NUMBER)?.number("hither")?;
        }
        b"resolution" => {
            let width = side(line.take(words, "width", SIDE)?, "width")?;
            let height_word = line.take(words, "height", SIDE)?;
            let height = side(height_word, "height")?;
            view.size = Some(Size::new(width, height).map_err(|_| height_word.wrong("height", SIDE))?);
        }
        _ => return Ok(false),
    }
    state.view = Some(view);
    Ok(true)
}

const SIDE: &str = "pixels must be from 1 to 16384, and not too many in all";

fn side(word: Word<'_>, field: &'static str) -> Result<u32, ReadError> {
    let side = u32::try_from(word.whole(field)?).ok();
    side.filter(|n| (1..=contract::MAX_SIDE).contains(n)).ok_or_else(|| word.wrong(field, SIDE))
}

fn color<'a>(line: Line<'a>, words: &mut impl Iterator<Item = Word<'a>>) -> Result<Rgb, ReadError> {
    let parts = line.vector(words, ["red", "green", "blue"])?;
    Ok(parts.map(|part| (part.clamp(0.0, 1.0) * 255.0 + 0.5) as u8))
}

/// Whether Kd, Ks, shine and T, where they follow a colour, are those of what is drawn.
fn is_matte<'a>(words: impl Iterator<Item = Word<'a>>) -> bool {
    let matte = [Some(1.0), Some(0.0), None, Some(0.0)];
    words.zip(matte).all(|(word, want)| want.is_none() || word.number("reflectance").ok() == want)
}

/// Keeps the first light's direction, of length 1; a light at the origin has none.
fn light<'a>(
    line: Line<'a>,
    words: &mut impl Iterator<Item = Word<'a>>,
    state: &mut State,
    frames: &mut Frames<'_>,
) -> Result<(), ReadError> {
    let [x, y, z] = line.vector(words, ["x", "y", "z"])?.map(f64::from);
    let length = (x * x + y * y + z * z).sqrt();
    if state.light.is_some() || length == 0.0 {
        let why = if length == 0.0 { "stands at the origin" } else { "is not the first" };
        frames.warn(Some(line.number), format!("light passed over: it {why}"));
        return Ok(());
    }
    if words.any(|word| word.number("color").ok() != Some(1.0)) {
        frames.warn(Some(line.number), "the light's colour passed over: it is drawn white");
    }
    state.light = Some([x, y, z].map(|part| (part / length) as f32));
    Ok(())
}
