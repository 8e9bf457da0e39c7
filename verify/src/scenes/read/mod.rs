//! Readers of scene files. A path or bytes with a name come in; an animation goes out, with the warnings that
//! reading it gave rise to. The format is told by the extension, a gzip layer by its first bytes.
//!
//! Real files break the rules of their formats, so readers accept what can have one meaning only and say what
//! they passed over. What is refused is named by place and value ([`ReadError`]). In formats of many frames a
//! last frame that is cut off costs that frame and a warning; a file without one whole frame is refused. No memory
//! is taken on the word of a header: see `frames`.

mod dcd;
mod error;
mod frames;
mod gzip;
mod json;
mod lammps;
mod looks;
mod nff;
mod pdb;
mod pdb_element;
mod pov;
mod text;
mod xtc;
mod xtc_stream;
mod xyz;

pub use error::{Place, ReadError};
pub use frames::{MAX_WARNINGS, Warning};
pub use gzip::limit as gzip_limit;

use crate::scenes::frame::{Framing, FramingError, in_pixels};
use contract::{Animation, Camera};
use frames::Input;
pub(super) use json::{FORMAT as JSON_FORMAT, VERSION as JSON_VERSION};
use looks::Looks;
use std::borrow::Cow;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The most bytes read of a file: 4 GiB.
pub const MAX_FILE: u64 = 4 << 30;

/// What a file held.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// Its frames, at least one.
    pub animation: Animation,
    /// How it was read.
    pub format: Format,
    /// What was passed over or guessed.
    pub warnings: Vec<Warning>,
    /// The view it asks for, all `None` unless it does.
    pub framing: Option<Framing>,
    /// The camera it gives, to the bit.
    pub camera: Option<Camera>,
}

impl Loaded {
    /// The camera to show it with: what `wish` leaves open is taken from the file's own view, then chosen so
    /// that all of it is seen. The file's camera is used as it is if `wish` is empty, and with as many pixels as are wished
    /// if `wish` is a size and no more.
    ///
    /// # Errors
    /// [`FramingError`] if no such camera exists.
    pub fn camera(&self, wish: &Framing) -> Result<Camera, FramingError> {
        match self.camera {
            Some(camera) if wish.is_size() => match wish.size {
                Some(size) => Ok(in_pixels(&camera, size)?),
                None => Ok(camera),
            },
            _ => wish.or(&self.framing.unwrap_or_default()).camera(&self.animation),
        }
    }
}

/// The formats that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Protein Data Bank, fixed columns; Ångström.
    Pdb,
    /// Count, comment, atoms; Ångström.
    Xyz,
    /// CHARMM and NAMD trajectories; Ångström.
    Dcd,
    /// GROMACS trajectories; nanometres, given in Ångström.
    Xtc,
    /// Eric Haines' neutral file format.
    Nff,
    /// LAMMPS text dump.
    Lammps,
    /// This project's own.
    Json,
    /// A POV-Ray list of spheres.
    Pov,
    /// Made, not read.
    Generated,
}

impl Format {
    /// The format that a file name asks for.
    ///
    /// # Errors
    /// [`ReadError::UnknownFormat`] if it asks for none.
    pub fn of(name: &str) -> Result<Self, ReadError> {
        let lower = name.to_ascii_lowercase();
        let plain = lower.strip_suffix(".gz").unwrap_or(&lower);
        let extension = Path::new(plain).extension().map_or(String::new(), |e| e.to_string_lossy().into());
        Ok(match extension.as_str() {
            "pdb" | "ent" => Self::Pdb,
            "xyz" => Self::Xyz,
            "dcd" => Self::Dcd,
            "xtc" => Self::Xtc,
            "nff" => Self::Nff,
            "lammpstrj" | "dump" => Self::Lammps,
            "json" => Self::Json,
            "inc" => Self::Pov,
            _ => return Err(ReadError::UnknownFormat { file: name.into(), extension }),
        })
    }

    /// Its name for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pdb => "PDB",
            Self::Xyz => "XYZ",
            Self::Dcd => "DCD",
            Self::Xtc => "XTC",
            Self::Nff => "NFF",
            Self::Lammps => "LAMMPS dump",
            Self::Json => "cgt-scene JSON",
            Self::Pov => "POV-Ray spheres",
            Self::Generated => "generated",
        }
    }

    /// Whether it holds positions only, so that another file must say what the atoms are.
    #[must_use]
    pub fn wants_atoms(self) -> bool {
        matches!(self, Self::Dcd | Self::Xtc)
    }
}

/// Reads a file.
///
/// # Errors
/// [`ReadError`] for the first thing found wrong.
pub fn read(path: &Path) -> Result<Loaded, ReadError> {
    read_bytes(&path.to_string_lossy(), &bytes_of(path)?, None)
}

/// Reads a trajectory whose atoms, with their radii and colours, stand in another file (its first frame).
///
/// # Errors
/// [`ReadError`] for the first thing found wrong in either, and if their counts of atoms differ.
pub fn read_with_atoms(path: &Path, atoms: &Path) -> Result<Loaded, ReadError> {
    let companion = bytes_of(atoms)?;
    read_bytes(&path.to_string_lossy(), &bytes_of(path)?, Some((&atoms.to_string_lossy(), &companion)))
}

/// Reads bytes as if they were a file of that name. `atoms` is name and bytes of the file that says what the
/// atoms of a trajectory are; a format that says it itself passes it over with a warning.
///
/// # Errors
/// [`ReadError`] for the first thing found wrong.
pub fn read_bytes(name: &str, bytes: &[u8], atoms: Option<(&str, &[u8])>) -> Result<Loaded, ReadError> {
    let format = Format::of(name)?;
    let (plain, cut) = gzip::unpack(name, bytes)?;
    if plain.is_empty() {
        return Err(ReadError::Empty { file: name.into() });
    }
    let looks = match atoms {
        Some((file, bytes)) if format.wants_atoms() => Some(Looks::of(file, &read_bytes(file, bytes, None)?)),
        _ => None,
    };
    let packed = matches!(plain, Cow::Owned(_)).then_some(bytes.len());
    let input = Input { file: name, bytes: &plain, packed };
    let mut loaded = match format {
        Format::Pdb => pdb::read(input),
        Format::Xyz => xyz::read(input),
        Format::Dcd => dcd::read(input, looks.as_ref()),
        Format::Xtc => xtc::read(input, looks.as_ref()),
        Format::Nff => nff::read(input),
        Format::Lammps => lammps::read(input),
        Format::Json => json::read(input),
        Format::Pov => pov::read(input),
        Format::Generated => Err(ReadError::UnknownFormat { file: name.into(), extension: String::new() }),
    }?;
    let mut warn = |text: &str| {
        loaded.warnings.push(Warning { file: name.into(), line: None, text: text.into() });
    };
    if cut {
        warn("the gzip layer is cut off; what it held so far was read");
    }
    if atoms.is_some() && looks.is_none() {
        warn("this format says what its atoms are; the file of atoms was not used");
    }
    loaded.warnings.extend(looks.into_iter().flat_map(|l| l.warnings));
    Ok(loaded)
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, ReadError> {
    let file = path.to_string_lossy();
    let refused = |source| ReadError::Io { file: file.clone().into_owned(), source };
    let mut bytes = Vec::new();
    let opened = File::open(path).map_err(refused)?;
    let size = opened.metadata().map_or(0, |m| m.len()).min(MAX_FILE);
    bytes.try_reserve(usize::try_from(size).unwrap_or(0)).map_err(|e| refused(e.into()))?;
    opened.take(MAX_FILE + 1).read_to_end(&mut bytes).map_err(refused)?;
    if bytes.len() as u64 > MAX_FILE {
        return Err(ReadError::FileTooLarge { file: file.into_owned(), limit: MAX_FILE });
    }
    Ok(bytes)
}
