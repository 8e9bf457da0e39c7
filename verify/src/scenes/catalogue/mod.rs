//! Scenes by name. A word comes in - a name of the catalogue, a generator with its numbers, or a path - and a
//! loaded scene with its framing goes out. Some scenes are part of this program, some are fetched because
//! their licences or sizes keep them out of the repository, some are made. A scene whose data is not there is a
//! typed error that says how to get it, never an empty picture.

mod entries;

pub use entries::{Data, ENTRIES, Entry};

use super::frame::Framing;
use super::generate::{GenerateError, Generator};
use super::read::{self, Format, Loaded, ReadError};
use contract::Animation;
use entries::EXAMPLES;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The scene of choice where none is named.
pub const DEFAULT: &str = "1hvr";
/// Names the folder of fetched data, if it is not the source tree's.
pub const DATA_VARIABLE: &str = "CGT_DATA";
/// The command that fetches data.
pub const FETCH: &str = "tests/fetch-data";

/// What a word stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A scene of the catalogue.
    Named(&'static Entry),
    /// A scene to be made.
    Generated(Generator),
    /// A file, and for a trajectory perhaps the file of its atoms.
    File {
        /// The file.
        path: PathBuf,
        /// Its atoms.
        atoms: Option<PathBuf>,
    },
}

/// Why there is no scene.
#[derive(Debug, Error)]
pub enum SourceError {
    /// Neither a name nor a path.
    #[error("{word:?} is no scene: not a name ({names}), not a generator ({generators}), and no path to a file", generators = GENERATORS)]
    Unknown {
        /// As given.
        word: String,
        /// The names there are.
        names: String,
    },
    /// A generator with wrong numbers.
    #[error("{word:?}: {part} is {value:?}; {want}")]
    Generator {
        /// As given.
        word: String,
        /// `count`, `seed`, …
        part: &'static str,
        /// What stands for it.
        value: String,
        /// What should.
        want: &'static str,
    },
    /// The data was not fetched.
    #[error("the data of {name} is absent; {how} brings it")]
    DataAbsent {
        /// The scene.
        name: &'static str,
        /// The command that brings it.
        how: &'static str,
    },
    /// The file was refused.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The scene was not made.
    #[error(transparent)]
    Generate(#[from] GenerateError),
}

/// A line of the list of scenes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listing {
    /// What to call it by.
    pub name: String,
    /// What it is.
    pub what: &'static str,
    /// Spheres in the frame that has the most.
    pub spheres: u128,
    /// Frames.
    pub frames: usize,
    /// Whence, and under which terms.
    pub provenance: &'static str,
    /// Whether it can be loaded now.
    pub present: bool,
}

const GENERATORS: &str = "sphereflake:LEVELS, uniform:COUNT:SEED, clump:COUNT:SEED, lattice:SIDE";
impl Source {
    /// What a word stands for: a name, a generator, else a path, or `trajectory,atoms`.
    ///
    /// # Errors
    /// [`SourceError::Generator`] for a generator's wrong numbers, [`SourceError::Unknown`] for a word that is
    /// none of these.
    pub fn parse(word: &str) -> Result<Self, SourceError> {
        if let Some(entry) = ENTRIES.iter().find(|e| e.name.eq_ignore_ascii_case(word)) {
            return Ok(Self::Named(entry));
        }
        let mut parts = word.split(':');
        if let Some(kind) =
            parts.next().filter(|k| ["sphereflake", "uniform", "clump", "lattice"].contains(k))
        {
            return generator(word, kind, parts.collect()).map(Self::Generated);
        }
        // A comma divides only where a file of the whole name does not exist.
        let (path, atoms) = match word.split_once(',') {
            Some((path, atoms)) if !Path::new(word).exists() => (path, Some(PathBuf::from(atoms))),
            _ => (word, None),
        };
        let path = PathBuf::from(path);
        let a_path = path.extension().is_some() || path.components().count() > 1 || path.exists();
        if a_path {
            return Ok(Self::File { path, atoms });
        }
        let names: Vec<&str> = ENTRIES.iter().map(|e| e.name).collect();
        Err(SourceError::Unknown { word: word.into(), names: names.join(", ") })
    }

    /// Reads or makes the scene.
    ///
    /// # Errors
    /// [`SourceError`] if the data is absent or refused, or too much is asked for.
    pub fn load(&self) -> Result<Loaded, SourceError> {
        match self {
            Self::Named(entry) => entry.load(&folder()),
            Self::Generated(generator) => Ok(Loaded {
                animation: Animation::from(generator.scene()?),
                format: Format::Generated,
                warnings: Vec::new(),
                framing: Some(framing_of(*generator)),
                camera: None,
            }),
            Self::File { path, atoms: None } => Ok(read::read(path)?),
            Self::File { path, atoms: Some(atoms) } => Ok(read::read_with_atoms(path, atoms)?),
        }
    }
}

/// All scenes, with whether their data is there; generators by examples.
#[must_use]
pub fn list() -> Vec<Listing> {
    let folder = folder();
    let named = ENTRIES.iter().map(|e| Listing {
        name: e.name.into(),
        what: e.what,
        spheres: e.spheres as u128,
        frames: e.frames,
        provenance: e.provenance,
        present: e.present(&folder),
    });
    let made = EXAMPLES.iter().map(|&(generator, what)| Listing {
        name: generator.to_string(),
        what,
        spheres: generator.count(),
        frames: 1,
        provenance: "made, the same on every machine",
        present: true,
    });
    named.chain(made).collect()
}

/// Where fetched data is looked for: the folder that [`DATA_VARIABLE`] names, or that of the source tree.
#[must_use]
pub fn folder() -> PathBuf {
    let wished = std::env::var_os(DATA_VARIABLE).filter(|name| !name.is_empty()).map(PathBuf::from);
    let tree = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."));
    wished.unwrap_or_else(|| tree.join("tests/data/fetched"))
}

/// How a generated scene wants to be seen: the sphereflake as its author shows it.
fn framing_of(generator: Generator) -> Framing {
    match generator {
        Generator::Sphereflake { .. } => Framing {
            eye: Some([2.1, 1.3, 1.7]),
            target: Some([0.0; 3]),
            up: Some([0.0, 0.0, 1.0]),
            fov: Some(45.0),
            size: None,
        },
        _ => Framing::default(),
    }
}

fn generator(word: &str, kind: &str, parts: Vec<&str>) -> Result<Generator, SourceError> {
    let wrong = |part, value: &str, want| SourceError::Generator {
        word: word.into(),
        part,
        value: value.into(),
        want,
    };
    let number = |at: usize, part, or: Option<u64>| match (parts.get(at), or) {
        (None, Some(value)) => Ok(value),
        (text, _) => {
            let text = text.copied().unwrap_or("");
            text.parse().map_err(|_| wrong(part, text, "a whole number from 0 must stand here"))
        }
    };
    let known = if matches!(kind, "uniform" | "clump") { 2 } else { 1 };
    if let Some(extra) = parts.get(known) {
        return Err(wrong("end", extra, "nothing more may stand here"));
    }
    let count = |part, or| Ok::<_, SourceError>(usize::try_from(number(0, part, or)?).unwrap_or(usize::MAX));
    Ok(match kind {
        "sphereflake" => {
            let levels = u32::try_from(number(0, "levels", Some(4))?).unwrap_or(u32::MAX);
            Generator::Sphereflake { levels }
        }
        "uniform" => Generator::Uniform { count: count("count", None)?, seed: number(1, "seed", Some(1))? },
        "clump" => Generator::Clump { count: count("count", None)?, seed: number(1, "seed", Some(1))? },
        _ => Generator::Lattice { side: count("side", None)? },
    })
}
