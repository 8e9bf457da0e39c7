//! XYZ files: a line with a count, a comment line, then so many lines `element x y z`, again and again. The
//! element is a symbol or an atomic number; coordinates are Ångström; the count may differ from frame to frame
//! and be 0; further columns and blank lines between frames are passed over. Refused are counts the file has no bytes for and lines that hold
//! no atom.

use super::frames::{Frames, Input};
use super::text::{Line, Lines};
use super::{Format, Loaded, ReadError, looks};
use crate::scenes::elements::{UNKNOWN, by_number, by_symbol};
use contract::Sphere;

/// `H 0 0 0` and the end of its line.
const SHORTEST_ATOM: usize = 8;

pub(super) fn read(input: Input<'_>) -> Result<Loaded, ReadError> {
    let Input { file, bytes, .. } = input;
    let mut frames = Frames::new(input);
    let mut lines = Lines::new(file, "XYZ", bytes)?;
    loop {
        match frame(&mut lines, &mut frames) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) if lines.cut_by(&error) && frames.len() > 0 => {
                frames.cut(Some(lines.number()), error.to_string())?;
                break;
            }
            Err(error) => return Err(error),
        }
    }
    frames.finish(Format::Xyz, "no count of atoms")
}

/// Reads a frame; whether another may follow.
fn frame(lines: &mut Lines<'_>, frames: &mut Frames<'_>) -> Result<bool, ReadError> {
    let mut heads = lines.by_ref().filter_map(|line| Some((line, line.words().next()?)));
    let Some((head, word)) = heads.next() else { return Ok(false) };
    // A count is refused where the rest of the file has no room for it, unless frames before it are whole.
    let count = match word.count("count of atoms", SHORTEST_ATOM, lines.left() + 1) {
        Err(ReadError::Count { count, left, .. }) if frames.len() > 0 => {
            frames.cut(Some(head.number), format!("{count} atoms promised, {left} bytes left"))?;
            return Ok(false);
        }
        other => other?,
    };
    let mut spheres = frames.room(count)?;
    let mut at = head.number;
    let comment = lines.next();
    for _ in 0..count {
        let Some(line) = lines.next() else {
            frames.cut(Some(at), format!("{} of {count} atoms", spheres.len()))?;
            return Ok(false);
        };
        at = line.number;
        spheres.push(atom(line, frames)?);
    }
    if comment.is_none() {
        frames.cut(Some(head.number), "its comment line is missing".into())?;
        return Ok(false);
    }
    frames.push(spheres)?;
    Ok(true)
}

fn atom(line: Line<'_>, frames: &mut Frames<'_>) -> Result<Sphere, ReadError> {
    let mut words = line.words();
    let name = line.take(&mut words, "element", "a symbol or an atomic number must stand here")?;
    let center = line.vector(&mut words, ["x", "y", "z"])?;
    let text = std::str::from_utf8(name.text).unwrap_or("");
    let known = text.parse().map_or_else(|_| by_symbol(text), by_number);
    if known.is_none() {
        frames.warn(
            Some(line.number),
            format!("element {:?} is not known; drawn with radius 1.70", name.shown()),
        );
    }
    Ok(looks::element(known.unwrap_or(&UNKNOWN), center))
}
