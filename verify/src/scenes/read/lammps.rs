//! LAMMPS text dumps. Each `ITEM: TIMESTEP` begins a frame; the columns of `ITEM: ATOMS` are found by name: `x y z`,
//! unwrapped `xu yu zu` or scaled `xs ys zs` (by `ITEM: BOX BOUNDS`), with `radius` or `diameter`, `type`, `element`
//! and `id` where there are. Spheres are sorted by id; a frame may have none. Refused are frames without positions
//! and counts the file has no bytes for.
//!
//! Atoms without a radius get 0.5, half of sigma in LAMMPS' units `lj`, with a warning, or their element's. The box
//! of a triclinic cell is not undone for scaled positions; they are refused.

use super::frames::{Frames, Input};
use super::text::{Line, Lines};
use super::{Format, Loaded, ReadError};
use crate::scenes::elements::by_symbol;
use contract::{Rgb, Sphere};

/// Half of sigma.
const RADIUS: f32 = 0.5;
const WANT_COLUMNS: &str = "columns x y z, xu yu zu or xs ys zs must be named";
#[rustfmt::skip]
const BY_TYPE: [Rgb; 8] = [
    [230, 159, 0], [86, 180, 233], [0, 158, 115], [240, 228, 66],
    [70, 120, 200], [213, 94, 0], [204, 121, 167], [160, 160, 160],
];

/// Where in a line of atoms things stand.
#[derive(Default)]
struct Columns {
    position: [Option<(usize, bool)>; 3],
    radius: Option<(usize, bool)>,
    id: Option<usize>,
    kind: Option<usize>,
    element: Option<usize>,
}

enum End {
    Whole(Vec<Sphere>),
    File,
    Cut { line: usize, detail: String },
}

pub(super) fn read(input: Input<'_>) -> Result<Loaded, ReadError> {
    let Input { file, bytes, .. } = input;
    let mut frames = Frames::new(input);
    let mut lines = Lines::new(file, "LAMMPS dump", bytes)?;
    let mut guessed = None;
    loop {
        match frame(&mut lines, &frames, &mut guessed) {
            Ok(End::Whole(spheres)) => frames.push(spheres)?,
            Ok(End::File) => break,
            Ok(End::Cut { line, detail }) => {
                frames.cut(Some(line), detail)?;
                break;
            }
            Err(error) if lines.cut_by(&error) && frames.len() > 0 => {
                frames.cut(Some(lines.number()), error.to_string())?;
                break;
            }
            Err(error) => return Err(error),
        }
    }
    if let Some(line) = guessed {
        frames
            .warn(Some(line), format!("no column radius or diameter, nor a known element; {RADIUS} is used"));
    }
    frames.finish(Format::Lammps, "no ITEM: ATOMS")
}

/// Reads up to the end of the next block of atoms.
fn frame(lines: &mut Lines<'_>, frames: &Frames<'_>, guessed: &mut Option<usize>) -> Result<End, ReadError> {
    let mut count = None;
    let mut bounds = None;
    let mut last = 0;
    while let Some(line) = lines.next() {
        let Some(item) = line.text.trim_ascii().strip_prefix(b"ITEM:") else {
            if line.text.trim_ascii().is_empty() {
                continue;
            }
            return Err(line.columns(1, usize::MAX).wrong("line", "a line ITEM: must stand here"));
        };
        last = line.number;
        let item = item.trim_ascii_start();
        if item.starts_with(b"NUMBER OF ATOMS") {
            let Some(next) = lines.next() else { break };
            let word = next.words().next().ok_or_else(|| next.missing("atoms", "a count must stand here"))?;
            // Counts that leave no room for at least `0 0 0` and an end of line for each atom are refused.
            count = match word.count("count of atoms", 6, lines.left() + 1) {
                Err(ReadError::Count { count, left, .. }) if frames.len() > 0 => {
                    let detail = format!("{count} atoms promised, {left} bytes left");
                    return Ok(End::Cut { line: next.number, detail });
                }
                other => Some(other?),
            };
        } else if item.starts_with(b"BOX BOUNDS") {
            match box_bounds(lines)? {
                Some(found) => bounds = Some(found),
                None => break,
            }
        } else if item.starts_with(b"ATOMS") {
            let columns = columns(line)?;
            let want = "ITEM: NUMBER OF ATOMS must come before ITEM: ATOMS";
            let count = count.ok_or_else(|| line.missing("count of atoms", want))?;
            return atoms(lines, frames, &columns, count, bounds, line, guessed);
        } else if lines.next().is_none() {
            // TIMESTEP, UNITS and TIME have one line each.
            break;
        }
    }
    let begun = last > 0;
    Ok(if begun { End::Cut { line: last, detail: "no ITEM: ATOMS".into() } } else { End::File })
}

/// Three lines `low high`, with a tilt where the box is skewed; `None` if the file ends within.
fn box_bounds(lines: &mut Lines<'_>) -> Result<Option<[[f64; 3]; 3]>, ReadError> {
    let mut bounds = [[0.0; 3]; 3];
    for bound in &mut bounds {
        let Some(line) = lines.next() else { return Ok(None) };
        let mut words = line.words();
        for (i, field) in ["low bound", "high bound", "tilt"].into_iter().enumerate() {
            match words.next() {
                Some(word) => bound[i] = f64::from(word.number(field)?),
                None if i == 2 => {}
                None => return Err(line.missing(field, "a number must stand here")),
            }
        }
    }
    Ok(Some(bounds))
}

fn columns(line: Line<'_>) -> Result<Columns, ReadError> {
    let mut found = Columns::default();
    for (at, word) in line.words().skip(2).enumerate() {
        match word.text {
            b"x" | b"xu" => found.position[0] = Some((at, false)),
            b"y" | b"yu" => found.position[1] = Some((at, false)),
            b"z" | b"zu" => found.position[2] = Some((at, false)),
            b"xs" | b"xsu" => found.position[0] = found.position[0].or(Some((at, true))),
            b"ys" | b"ysu" => found.position[1] = found.position[1].or(Some((at, true))),
            b"zs" | b"zsu" => found.position[2] = found.position[2].or(Some((at, true))),
            b"radius" => found.radius = Some((at, false)),
            b"diameter" => found.radius = found.radius.or(Some((at, true))),
            b"id" => found.id = Some(at),
            b"type" => found.kind = Some(at),
            b"element" => found.element = Some(at),
            _ => {}
        }
    }
    if found.position.contains(&None) {
        return Err(line.missing("position", WANT_COLUMNS));
    }
    Ok(found)
}

fn atoms(
    lines: &mut Lines<'_>,
    frames: &Frames<'_>,
    columns: &Columns,
    count: usize,
    bounds: Option<[[f64; 3]; 3]>,
    head: Line<'_>,
    guessed: &mut Option<usize>,
) -> Result<End, ReadError> {
    frames.room(count)?;
    let mut found: Vec<(u64, Sphere)> = Vec::with_capacity(count);
    for order in 0..count as u64 {
        let line = lines.next();
        let blank = line.is_none_or(|l| l.text.trim_ascii().is_empty() && lines.only_blank_left());
        let Some(line) = line.filter(|_| !blank) else {
            return Ok(End::Cut { line: head.number, detail: format!("{order} of {count} atoms") });
        };
        found.push(atom(line, columns, bounds, order, guessed)?);
    }
    found.sort_by_key(|&(id, _)| id);
    Ok(End::Whole(found.into_iter().map(|(_, sphere)| sphere).collect()))
}

fn atom(
    line: Line<'_>,
    columns: &Columns,
    bounds: Option<[[f64; 3]; 3]>,
    order: u64,
    guessed: &mut Option<usize>,
) -> Result<(u64, Sphere), ReadError> {
    let word = |at: usize, field| {
        line.words().nth(at).ok_or_else(|| line.missing(field, "each named column must be filled"))
    };
    let mut center = [0.0; 3];
    for (axis, field) in ["x", "y", "z"].into_iter().enumerate() {
        let (at, scaled) = columns.position[axis].unwrap_or_default();
        let value = word(at, field)?;
        center[axis] = value.number(field)?;
        if scaled {
            let want = "scaled positions need ITEM: BOX BOUNDS of a box that is not skewed";
            let [low, high, _] = bounds
                .filter(|b| b.iter().all(|b| b[2] == 0.0))
                .ok_or_else(|| value.wrong(field, want))?[axis];
            center[axis] = (low + f64::from(center[axis]) * (high - low)) as f32;
            if !center[axis].is_finite() {
                return Err(value.wrong(field, "the box must not take it beyond f32"));
            }
        }
    }
    let element = columns.element.map(|at| word(at, "element")).transpose()?;
    let element = element.and_then(|w| std::str::from_utf8(w.text).ok()).and_then(by_symbol);
    let kind = columns.kind.map_or(Ok(1), |at| word(at, "type")?.whole("type"))?;
    let id = columns.id.map_or(Ok(order), |at| word(at, "id")?.whole("id"))?;
    let radius = match columns.radius {
        Some((at, halve)) => {
            let value = word(at, "radius")?;
            let radius = value.radius("radius")? * if halve { 0.5 } else { 1.0 };
            if radius > 0.0 {
                radius
            } else {
                return Err(value.wrong("radius", "half of it must be above 0"));
            }
        }
        None => element.map_or_else(
            || {
                guessed.get_or_insert(line.number);
                RADIUS
            },
            |e| e.radius,
        ),
    };
    let color = element.map_or(BY_TYPE[(kind.wrapping_sub(1) % 8) as usize], |e| e.color);
    Ok((id, Sphere { center, radius, color }))
}
