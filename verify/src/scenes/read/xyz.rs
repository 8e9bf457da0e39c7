//! XYZ files: a line with a count, a comment line, then so many lines `element x y z`, again and again. The
//! element is a symbol or an atomic number; coordinates are Ångström; the count may differ from frame to frame
//! and be 0; further columns and blank lines between frames are passed over. Where the comment names the columns, as that of extended XYZ
//! does (`Properties=id:I:1:species:S:1:pos:R:3`), `species` and `pos` are looked for where they stand. Refused are names of columns
//! without the two, counts the file has no bytes for and lines that hold no atom.

use super::frames::{Frames, Input};
use super::text::{Line, Lines, Word};
use super::{Format, Loaded, ReadError, looks};
use crate::scenes::elements::{UNKNOWN, by_number, by_symbol};
use contract::Sphere;

/// `H 0 0 0` and the end of its line.
const SHORTEST_ATOM: usize = 8;
/// What the names of columns follow.
const NAMES: &[u8] = b"Properties=";
const WANT_NAMES: &str = "triples name:type:count must stand here, species:S:1 and pos:R:3 among them";

/// Where in the line of an atom things begin, in words from 0.
#[derive(Clone, Copy)]
struct Columns {
    element: usize,
    position: usize,
}

const PLAIN: Columns = Columns { element: 0, position: 1 };

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
    let columns = comment.map_or(Ok(PLAIN), columns)?;
    for _ in 0..count {
        let Some(line) = lines.next() else {
            frames.cut(Some(at), format!("{} of {count} atoms", spheres.len()))?;
            return Ok(false);
        };
        at = line.number;
        spheres.push(atom(line, columns, frames)?);
    }
    if comment.is_none() {
        frames.cut(Some(head.number), "its comment line is missing".into())?;
        return Ok(false);
    }
    frames.push(spheres)?;
    Ok(true)
}

/// The columns that a comment names; without names, those of plain XYZ.
fn columns(comment: Line<'_>) -> Result<Columns, ReadError> {
    let names = |word: &Word<'_>| word.text.get(..NAMES.len()).is_some_and(|w| w.eq_ignore_ascii_case(NAMES));
    let Some(word) = comment.words().find(names) else { return Ok(PLAIN) };
    named(&word.text[NAMES.len()..]).ok_or_else(|| word.wrong("Properties", WANT_NAMES))
}

fn named(text: &[u8]) -> Option<Columns> {
    let mut parts = std::str::from_utf8(text).ok()?.trim_matches('"').split(':');
    let (mut element, mut position, mut at) = (None, None, 0_usize);
    while let Some(name) = parts.next() {
        let (kind, count) = (parts.next()?, parts.next()?.parse().ok()?);
        match (name, kind, count) {
            ("species", "S", 1) => element = Some(at),
            ("pos", "R", 3) => position = Some(at),
            _ => {}
        }
        at = at.checked_add(count)?;
    }
    Some(Columns { element: element?, position: position? })
}

fn atom(line: Line<'_>, columns: Columns, frames: &mut Frames<'_>) -> Result<Sphere, ReadError> {
    let mut words = line.words().skip(columns.element);
    let name = line.take(&mut words, "element", "a symbol or an atomic number must stand here")?;
    let center = line.vector(&mut line.words().skip(columns.position), ["x", "y", "z"])?;
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
