//! Protein Data Bank files. Each `ATOM` or `HETATM` record becomes a sphere of its van der Waals radius in
//! Ångström, each `MODEL` a frame; hydrogens, water and ligands are kept. Refused are atoms without three finite
//! coordinates in columns 31 to 54 and files without atoms.
//!
//! Short lines, CR LF, other records and what follows column 54 are no trouble, nor are serial numbers above 99,999,
//! which begin in column 6 or 5. Where an atom has alternate locations (column 17), the first letter that occurs for
//! that atom of that residue is kept and the others are left out, since they are places the atom is in at other times;
//! a warning counts them. Where the alternates of a place are residues of several names, only the first is kept.

use super::frames::{Frames, Input};
use super::text::{Line, Lines, NUMBER};
use super::{Format, Loaded, ReadError, looks, pdb_element};
use crate::scenes::elements::UNKNOWN;
use contract::Sphere;
use std::collections::HashMap;

/// Chain, residue number, insertion code and name of an atom: columns 13-16 and 22-27.
type AtomKey = [u8; 10];
/// Chain, residue number and insertion code: columns 22-27.
type ResidueKey = [u8; 6];

#[derive(Default)]
struct Model {
    spheres: Vec<Sphere>,
    first_location: HashMap<AtomKey, u8>,
    /// Columns 18-21 of the first atom with alternates.
    first_name: HashMap<ResidueKey, [u8; 4]>,
    open: bool,
}

#[derive(Default)]
struct Tally {
    alternates: usize,
    unknown: usize,
    first_unknown: Option<(usize, String)>,
}

pub(super) fn read(input: Input<'_>) -> Result<Loaded, ReadError> {
    let Input { file, bytes, .. } = input;
    let mut frames = Frames::new(input);
    let (mut model, mut tally) = (Model::default(), Tally::default());
    let mut lines = Lines::new(file, "PDB", bytes)?;
    while let Some(line) = lines.next() {
        match record(line) {
            b"ATOM" | b"HETATM" | b"HETAT" | b"HETA" => match sphere(line, &mut model, &frames, &mut tally) {
                // Beside it, at most, stand its first location and its residue's first name.
                Ok(Some(sphere)) => frames.put(&mut model.spheres, sphere, 1)?,
                Ok(None) => {}
                Err(error) if lines.cut_by(&error) && frames.len() > 0 => {
                    frames.cut(Some(line.number), error.to_string())?;
                    model = Model::default();
                    break;
                }
                Err(error) => return Err(error),
            },
            b"MODEL" => {
                close(&mut frames, &mut model)?;
                model.open = true;
            }
            b"ENDMDL" | b"END" => close(&mut frames, &mut model)?,
            _ => {}
        }
    }
    if model.open {
        frames.cut(None, "MODEL without ENDMDL".into())?;
    } else if !model.spheres.is_empty() {
        close(&mut frames, &mut model)?;
    }
    if tally.alternates > 0 {
        frames.warn(None, format!("{} atoms at alternate locations left out", tally.alternates));
    }
    if let Some((line, name)) = tally.first_unknown {
        let text = format!(
            "{} atoms of no known element, the first {name:?}; drawn with radius 1.70",
            tally.unknown
        );
        frames.warn(Some(line), text);
    }
    frames.finish(Format::Pdb, "no ATOM or HETATM record")
}

/// What a line is: columns 1 to 6 without the first digits of a serial number.
fn record(line: Line<'_>) -> &[u8] {
    let name = line.columns(1, 6).text;
    let digits = name.iter().rev().take_while(|b| b.is_ascii_digit()).count();
    name[..name.len() - digits].trim_ascii_end()
}

/// Keeps a model that has atoms.
fn close(frames: &mut Frames<'_>, model: &mut Model) -> Result<(), ReadError> {
    let done = std::mem::take(model);
    if done.spheres.is_empty() { Ok(()) } else { frames.push(done.spheres) }
}

/// The sphere of an atom, or `None` for another location of one that is there.
fn sphere(
    line: Line<'_>,
    model: &mut Model,
    frames: &Frames<'_>,
    tally: &mut Tally,
) -> Result<Option<Sphere>, ReadError> {
    let mut center = [0.0; 3];
    for (axis, field) in ["x", "y", "z"].into_iter().enumerate() {
        let word = line.columns(31 + 8 * axis, 38 + 8 * axis);
        if word.text.is_empty() {
            return Err(line.missing(field, NUMBER));
        }
        center[axis] = word.number(field)?;
    }
    let location = line.text[16];
    if location != b' ' {
        // The maps grow at other times than the list, and take less than it does while it grows.
        frames.allowed(2 * model.spheres.len())?;
        let residue = std::array::from_fn(|i| line.text[21 + i]);
        let name = std::array::from_fn(|i| line.text[17 + i]);
        let is_other_residue = *model.first_name.entry(residue).or_insert(name) != name;
        let key = std::array::from_fn(|i| line.text[if i < 4 { 12 + i } else { 17 + i }]);
        if is_other_residue || *model.first_location.entry(key).or_insert(location) != location {
            tally.alternates += 1;
            return Ok(None);
        }
    }
    let (symbol, residue) = (line.columns(77, 78).text, line.columns(18, 21).text);
    let known = pdb_element::element(symbol, &line.text[12..16], residue);
    if known.is_none() {
        tally.unknown += 1;
        let name = String::from_utf8_lossy(line.text[12..16].trim_ascii()).into_owned();
        tally.first_unknown.get_or_insert((line.number, name));
    }
    Ok(Some(looks::element(known.unwrap_or(&UNKNOWN), center)))
}
