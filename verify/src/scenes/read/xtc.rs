//! XTC trajectories of GROMACS, decoded by the crate `molly`. Nanometres come in, Ångström go out, with the
//! atoms' looks from another file. Each frame's header is checked here and its stream walked through
//! (`xtc_stream`) before `molly` sees it, since it trusts both. Refused are wrong magic numbers, counts that
//! disagree, streams that do not hold what they promise, and positions that are not finite.

use super::frames::{Frames, Input};
use super::looks::{self, Looks, NO_ATOMS};
use super::xtc_stream::{self, Prelude};
use super::{Format, Loaded, ReadError};
use contract::Sphere;
use molly::selection::AtomSelection;
use molly::{Frame, XTCReader};

/// Magic number, atoms, step, time, nine of the box, atoms again.
const HEADER: usize = 56;
/// Precision, two corners of the bounds, width of small differences.
const PRELUDE: usize = 32;
/// Up to so many atoms are not compressed.
const FEW: usize = 9;
const OLD: i32 = 1995;
/// As 1995, with sizes of 64 bits.
const NEW: i32 = 2023;

/// A checked frame: its bytes, and how many atoms.
struct Checked<'a> {
    bytes: &'a [u8],
    atoms: usize,
}

pub(super) fn read(input: Input<'_>, looks: Option<&Looks>) -> Result<Loaded, ReadError> {
    let Input { file, bytes, .. } = input;
    let mut frames = Frames::new(input);
    if looks.is_none() {
        frames.warn(None, NO_ATOMS);
    }
    let (mut at, mut frame, mut scratch) = (0, Frame::default(), Vec::new());
    while at < bytes.len() {
        let Some(checked) = check(file, bytes, at, &frames)? else {
            frames.cut(None, format!("{} bytes are left of it", bytes.len() - at))?;
            break;
        };
        if let Some(looks) = looks {
            looks.must_have(checked.atoms, file, frames.len())?;
        }
        let mut spheres = frames.room(checked.atoms)?;
        XTCReader::new(checked.bytes)
            .read_frame_with_scratch(&mut frame, &mut scratch, &AtomSelection::All)
            .map_err(|e| wrong(file, at, "frame", e, "a frame that molly decodes"))?;
        for (i, position) in frame.coords().enumerate() {
            let center = position.map(|nanometres| 10.0 * nanometres);
            if !center.iter().all(|x| x.is_finite()) {
                let value = format!("{center:?} for atom {i}");
                return Err(wrong(file, at, "position", value, "finite numbers"));
            }
            spheres.push(looks::atom(looks, i, center));
        }
        frames.push(spheres)?;
        at += checked.bytes.len();
    }
    frames.finish(Format::Xtc, "no frame")
}

fn wrong(file: &str, byte: usize, field: &'static str, value: impl ToString, want: &str) -> ReadError {
    let (value, want) = (value.to_string(), format!("{want} must stand here"));
    ReadError::Record { file: file.into(), byte, field, value, want }
}

/// The frame that begins at a byte, or `None` if the file ends within it.
fn check<'a>(
    file: &str,
    bytes: &'a [u8],
    at: usize,
    frames: &Frames<'_>,
) -> Result<Option<Checked<'a>>, ReadError> {
    let frame = &bytes[at..];
    let int = |i: usize| i32::from_be_bytes(std::array::from_fn(|k| frame[i + k]));
    if frame.len() < 4 {
        return Ok(None);
    }
    let magic = int(0);
    if magic != OLD && magic != NEW {
        return Err(wrong(file, at, "magic number", magic, "1995 or 2023"));
    }
    if frame.len() < HEADER {
        return Ok(None);
    }
    let (count, again) = (int(4), int(52));
    let atoms = usize::try_from(count).ok();
    let atoms = atoms.ok_or_else(|| wrong(file, at + 4, "number of atoms", count, "a number from 0"))?;
    if count != again {
        return Err(wrong(
            file,
            at + 52,
            "number of atoms",
            again,
            &format!("{count}, as in byte {},", at + 4),
        ));
    }
    if atoms <= FEW {
        let end = HEADER + 12 * atoms;
        return Ok(frame.get(..end).map(|bytes| Checked { bytes, atoms }));
    }
    let start = HEADER + PRELUDE + if magic == NEW { 8 } else { 4 };
    if frame.len() < start {
        return Ok(None);
    }
    let length = |first: usize| frame[first..start].iter().fold(0_u64, |n, &b| n << 8 | u64::from(b));
    let length = length(HEADER + PRELUDE);
    let padded = usize::try_from(length).ok().and_then(|n| n.checked_next_multiple_of(4));
    let end = padded.and_then(|n| n.checked_add(start));
    let Some(whole) = end.and_then(|end| frame.get(..end)) else {
        return Ok(None);
    };
    let low = [60, 64, 68].map(int);
    let high = [72, 76, 80].map(int);
    let width = u32::try_from(int(84)).unwrap_or(u32::MAX);
    let stream = &whole[start..start + length as usize];
    // Each atom takes two bits at least, so a count without its bytes is found before memory is taken for it.
    xtc_stream::check(&Prelude { low, high, width }, stream, atoms)
        .map_err(|what| wrong(file, at, "compressed frame", what, "a stream that holds its atoms"))?;
    // molly decodes into a list of its own, 12 bytes an atom, and copies the stream.
    frames.allowed((atoms.saturating_mul(8) / 5).saturating_add(stream.len() / size_of::<Sphere>()))?;
    Ok(Some(Checked { bytes: whole, atoms }))
}
