//! DCD trajectories of CHARMM, NAMD and X-PLOR, in either byte order. Records of positions in Ångström come in, with the
//! atoms' looks from another file; frames go out. The number of frames is what the records hold: headers of real
//! files promise others, which is a warning. Refused are records whose two lengths differ, coordinates that are not
//! finite, and fixed atoms, whose positions later frames leave out.
//!
//! The file is Fortran's: each record has its length before and after it. First comes `CORD` with 20 integers, then
//! titles, then the number of atoms; each frame is a unit cell of 48 bytes where integer 11 says so, x, y, z, and a
//! fourth dimension where integer 12 says so.

use super::frames::{Frames, Input};
use super::looks::{self, Looks, NO_ATOMS};
use super::{Format, Loaded, ReadError};

/// Bytes of the first record.
const HEADER: usize = 84;
/// Bytes of the record of a unit cell.
const CELL: usize = 48;

struct Records<'a> {
    file: &'a str,
    bytes: &'a [u8],
    at: usize,
    big: bool,
}

struct Header {
    promised: i32,
    cell: bool,
    fourth: bool,
    atoms: usize,
}

pub(super) fn read(input: Input<'_>, looks: Option<&Looks>) -> Result<Loaded, ReadError> {
    let Input { file, bytes, .. } = input;
    let mut frames = Frames::new(input);
    let mut records = Records::new(file, bytes)?;
    let header = records.header()?;
    if let Some(looks) = looks {
        looks.must_have(header.atoms, file, 0)?;
    } else {
        frames.warn(None, NO_ATOMS);
    }
    let need = header.frame_bytes();
    while records.left() > 0 {
        if (records.left() as u64) < need {
            frames.cut(None, format!("a frame needs {need} bytes, {} are left", records.left()))?;
            break;
        }
        let mut spheres = frames.room(header.atoms)?;
        records.positions(&header, |i, center| spheres.push(looks::atom(looks, i, center)))?;
        frames.push(spheres)?;
    }
    let promised = header.promised;
    if usize::try_from(promised).ok() != Some(frames.len()) {
        let text = format!("the header promises {promised} frames, the records hold {}", frames.len());
        frames.warn(None, text);
    }
    frames.finish(Format::Dcd, "it ends after its header")
}

impl Header {
    /// Bytes of a frame with the lengths round its records.
    fn frame_bytes(&self) -> u64 {
        let axes = if self.fourth { 4 } else { 3 };
        let cell = if self.cell { CELL as u64 + 8 } else { 0 };
        axes * (4 * self.atoms as u64 + 8) + cell
    }
}

impl<'a> Records<'a> {
    /// Finds the byte order from the length of the first record.
    fn new(file: &'a str, bytes: &'a [u8]) -> Result<Self, ReadError> {
        let mut records = Self { file, bytes, at: 0, big: false };
        if bytes.len() < HEADER + 8 {
            let detail = format!("{} bytes, and its first record alone takes {}", bytes.len(), HEADER + 8);
            return Err(ReadError::NoFrame { file: file.into(), detail });
        }
        let length = records.int(0);
        records.big = length.swap_bytes() == 84;
        if length == 84 || records.big {
            return Ok(records);
        }
        Err(records.wrong(0, "length of the first record", length, "84 in either byte order"))
    }

    fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn four(&self, at: usize) -> [u8; 4] {
        std::array::from_fn(|i| self.bytes[at + i])
    }

    fn int(&self, at: usize) -> i32 {
        if self.big { i32::from_be_bytes(self.four(at)) } else { i32::from_le_bytes(self.four(at)) }
    }

    fn float(&self, at: usize) -> f32 {
        if self.big { f32::from_be_bytes(self.four(at)) } else { f32::from_le_bytes(self.four(at)) }
    }

    fn wrong(
        &self,
        byte: usize,
        field: &'static str,
        value: impl ToString,
        want: impl Into<String>,
    ) -> ReadError {
        let (value, want) = (value.to_string(), format!("{} must stand here", want.into()));
        ReadError::Record { file: self.file.into(), byte, field, value, want }
    }

    /// Where the contents of the next record begin, and how long they are.
    fn record(&mut self) -> Result<(usize, usize), ReadError> {
        let start = self.at + 4;
        if self.left() < 8 {
            let detail = format!("it ends at byte {}, within its header", self.bytes.len());
            return Err(ReadError::NoFrame { file: self.file.into(), detail });
        }
        let length = self.int(self.at);
        let room = self.left() - 8;
        let fits = usize::try_from(length).ok().filter(|&n| n <= room);
        let want = format!("a length of 0 to {room}");
        let size = fits.ok_or_else(|| self.wrong(self.at, "length of a record", length, want))?;
        let after = self.int(start + size);
        if after != length {
            return Err(self.wrong(start + size, "length after a record", after, length.to_string()));
        }
        self.at = start + size + 4;
        Ok((start, size))
    }

    /// A record whose length is known.
    fn record_of(&mut self, size: usize, field: &'static str) -> Result<usize, ReadError> {
        let at = self.at;
        let (start, found) = self.record()?;
        if found == size { Ok(start) } else { Err(self.wrong(at, field, found, size.to_string())) }
    }

    fn header(&mut self) -> Result<Header, ReadError> {
        let start = self.record_of(HEADER, "length of the first record")?;
        let word = self.four(start);
        if &word != b"CORD" {
            return Err(self.wrong(start, "magic word", String::from_utf8_lossy(&word), "CORD"));
        }
        let flag = |n: usize| self.int(start + 4 * n);
        // X-PLOR, whose version is 0, has a time step of 64 bits where CHARMM has one of 32 and these two.
        let charmm = flag(20) != 0;
        let (promised, fixed, cell, fourth) =
            (flag(1), flag(9), charmm && flag(11) != 0, charmm && flag(12) != 0);
        if fixed != 0 {
            return Err(ReadError::FixedAtoms { file: self.file.into(), fixed });
        }
        self.record()?;
        let start = self.record_of(4, "length of the record with the number of atoms")?;
        let count = self.int(start);
        let atoms = usize::try_from(count).ok().filter(|&n| n > 0);
        let atoms = atoms.ok_or_else(|| self.wrong(start, "number of atoms", count, "a number above 0"))?;
        Ok(Header { promised, cell, fourth, atoms })
    }

    /// Reads a frame that is known to be there.
    fn positions(&mut self, header: &Header, mut atom: impl FnMut(usize, [f32; 3])) -> Result<(), ReadError> {
        if header.cell {
            self.record_of(CELL, "length of a unit cell")?;
        }
        let mut starts = [0; 3];
        for start in &mut starts {
            *start = self.record_of(4 * header.atoms, "length of a record of coordinates")?;
        }
        if header.fourth {
            self.record_of(4 * header.atoms, "length of a record of coordinates")?;
        }
        for i in 0..header.atoms {
            let mut center = [0.0; 3];
            for ((value, start), field) in center.iter_mut().zip(starts).zip(["x", "y", "z"]) {
                *value = self.float(start + 4 * i);
                if !value.is_finite() {
                    return Err(self.wrong(start + 4 * i, field, *value, "a finite number"));
                }
            }
            atom(i, center);
        }
        Ok(())
    }
}
