//! Why a file was refused. Every variant names the file; a text file also the line, column and value, a
//! binary one the byte. The numbers are fields, so that a caller can act on them without parsing a message.

use contract::SceneError;
use std::fmt;
use thiserror::Error;

/// Where in a text file, counted from 1; the column is in bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// As the caller named it.
    pub file: String,
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// Why a file was refused.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file could not be read at all.
    #[error("{file}: {source}")]
    Io {
        /// The file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// More bytes than are ever read.
    #[error("{file}: more than {limit} bytes, the most that is read")]
    FileTooLarge {
        /// The file.
        file: String,
        /// The most that is read.
        limit: u64,
    },
    /// The extension names no format that is read.
    #[error(
        "{file}: extension {extension:?} is none of .pdb .ent .xyz .dcd .xtc .nff .lammpstrj .dump .json .inc, alone or followed by .gz"
    )]
    UnknownFormat {
        /// The file.
        file: String,
        /// Its extension, without `.gz`.
        extension: String,
    },
    /// No bytes, or none but white space.
    #[error("{file}: is empty")]
    Empty {
        /// The file.
        file: String,
    },
    /// A text format with a zero byte in it.
    #[error("{file}: byte {byte} is zero: this is no text, and {format} is a text format")]
    Binary {
        /// The file.
        file: String,
        /// The format its extension names.
        format: &'static str,
        /// Where the first zero byte stands, from 0.
        byte: usize,
    },
    /// A value in a text file is not what must stand there.
    #[error("{place}: {field} is {value:?}; {want}")]
    Value {
        /// Where it stands.
        place: Place,
        /// What was read.
        field: &'static str,
        /// As it stands there, cut after 40 bytes.
        value: String,
        /// What must stand there.
        want: &'static str,
    },
    /// A line of a text file ends before a value that must be there.
    #[error("{place}: {field} is missing; {want}")]
    Missing {
        /// The end of the line.
        place: Place,
        /// What should have come.
        field: &'static str,
        /// What must stand there.
        want: &'static str,
    },
    /// A count promises more than the rest of the file can hold.
    #[error("{place}: {field} is {count}, but {left} bytes are left in the file, not enough for it")]
    Count {
        /// Where the count stands.
        place: Place,
        /// What is counted.
        field: &'static str,
        /// As given.
        count: u64,
        /// Bytes after it.
        left: usize,
    },
    /// A value in a binary file is not what must stand there.
    #[error("{file}: byte {byte}: {field} is {value}; {want}")]
    Record {
        /// The file.
        file: String,
        /// Where it stands, from 0.
        byte: usize,
        /// What was read.
        field: &'static str,
        /// As read.
        value: String,
        /// What must stand there.
        want: String,
    },
    /// Some atoms of a DCD stand still and are not repeated in each frame; this is not read.
    #[error("{file}: {fixed} fixed atoms (NAMNF); files with fixed atoms are not read")]
    FixedAtoms {
        /// The file.
        file: String,
        /// How many.
        fixed: i32,
    },
    /// The file ends before its first frame does.
    #[error("{file}: holds no complete frame: {detail}")]
    NoFrame {
        /// The file.
        file: String,
        /// What was found instead.
        detail: String,
    },
    /// Trajectory and atoms do not belong together.
    #[error("{file}: frame {frame} has {count} atoms, but {atoms_file} has {atoms}")]
    AtomCount {
        /// The trajectory.
        file: String,
        /// Its frame, from 0.
        frame: usize,
        /// Atoms in it.
        count: usize,
        /// The file of atoms.
        atoms_file: String,
        /// Atoms there.
        atoms: usize,
    },
    /// The gzip layer is broken.
    #[error("{file}: gzip: {detail}")]
    Gzip {
        /// The file.
        file: String,
        /// What the decompressor says.
        detail: String,
    },
    /// The gzip layer unpacks to more than is accepted of a file of this size.
    #[error("{file}: gzip: {packed} bytes unpack to more than {limit}, the most that is accepted of them")]
    GzipLimit {
        /// The file.
        file: String,
        /// Its size in bytes.
        packed: usize,
        /// The limit in bytes.
        limit: u64,
    },
    /// The frames would take more memory than is given for a file of this size.
    #[error(
        "{file}: frame {frame} would bring the scenes to {need} bytes; the limit for {input} bytes of input is {limit}"
    )]
    Memory {
        /// The file.
        file: String,
        /// The frame, from 0.
        frame: usize,
        /// Bytes needed by then.
        need: u64,
        /// Bytes of the file.
        input: usize,
        /// Bytes given.
        limit: u64,
    },
    /// The JSON is not well formed, or not a scene of this project.
    #[error("{place}: {detail}")]
    Json {
        /// Where the parser stood.
        place: Place,
        /// What it says.
        detail: String,
    },
    /// A frame that the contract refuses.
    #[error("{file}: frame {frame}: {source}")]
    Scene {
        /// The file.
        file: String,
        /// The frame, from 0.
        frame: usize,
        /// Why.
        source: SceneError,
    },
}
