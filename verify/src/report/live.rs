//! The live view of a scene: the certified tracer as a WebAssembly module, the scene and the camera as bytes, and the hash that the first frame
//! must have. A module that `verify/live/build` made comes in with a scene and a camera; what the page carries goes out, packed
//! and as text. The script `templates/live.js` does the rest in the browser.
//!
//! The hash is that of the frame which this program traces by the same plan at its own best level. Refused are files that are no
//! module, and scenes that a page should not carry.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use contract::{Camera, Scene};
use flate2::Compression;
use flate2::write::GzEncoder;
use live::{hash, wire};
use optimized::host::NoSuchLevel;
use optimized::{Level, Plan, RenderError, Tracer};
use std::fmt::Write as _;
use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The most bytes of a module; one has about one million.
pub const MAX_MODULE: u64 = 8 << 20;
/// The most spheres of a scene that a page carries: 4 MB before they are packed.
pub const MAX_SPHERES: usize = 200_000;
/// What every module begins with, and its version.
const MAGIC: [u8; 8] = *b"\0asm\x01\0\0\0";

/// Why there is no live view.
#[derive(Debug, Error)]
pub enum LiveError {
    /// The file of the module could not be read.
    #[error("the module `{}`: {cause}", path.display())]
    Read {
        /// As given.
        path: PathBuf,
        /// What the system says.
        #[source]
        cause: std::io::Error,
    },
    /// The file holds something else.
    #[error("`{}` is no WebAssembly module: it does not begin with {MAGIC:?}", path.display())]
    NoModule {
        /// As given.
        path: PathBuf,
    },
    /// The file is too large to be the module.
    #[error("the module `{}` has more than {MAX_MODULE} bytes", path.display())]
    Large {
        /// As given.
        path: PathBuf,
    },
    /// The scene is too large for a page.
    #[error("{spheres} spheres; a page carries {MAX_SPHERES} at most for its live view")]
    Spheres {
        /// How many there are.
        spheres: usize,
    },
    /// The first frame could not be traced here.
    #[error("no first frame for the live view: {0}")]
    Render(#[from] RenderError),
    /// No level to trace it at.
    #[error(transparent)]
    Level(#[from] NoSuchLevel),
    /// It could not be packed.
    #[error("the live view could not be packed: {0}")]
    Pack(std::io::Error),
}

/// A module that a page can carry.
#[derive(Clone, Debug)]
pub struct Module(Vec<u8>);

impl Module {
    /// Reads it.
    ///
    /// # Errors
    /// [`LiveError::Read`], [`LiveError::NoModule`], [`LiveError::Large`].
    pub fn read(path: &Path) -> Result<Self, LiveError> {
        let fault = |cause| LiveError::Read { path: path.into(), cause };
        let mut bytes = Vec::new();
        File::open(path).and_then(|file| file.take(MAX_MODULE + 1).read_to_end(&mut bytes)).map_err(fault)?;
        if !bytes.starts_with(&MAGIC) {
            return Err(LiveError::NoModule { path: path.into() });
        }
        if bytes.len() as u64 > MAX_MODULE {
            return Err(LiveError::Large { path: path.into() });
        }
        Ok(Self(bytes))
    }
}

/// What a page carries for a live view of one scene. Texts are base64.
#[derive(Clone, Debug)]
pub struct Live {
    /// The module, by gzip.
    pub(super) module: String,
    /// The scene as [`live::wire`] has it, by gzip.
    pub(super) scene: String,
    /// The camera as [`live::wire`] has it.
    pub(super) camera: String,
    /// Pixels of the picture: columns and rows.
    pub(super) size: [u32; 2],
    /// What the first frame must have: [`live::hash`], in hexadecimal digits.
    pub(super) hash: String,
    /// The level at which it was traced here.
    pub(super) level: &'static str,
}

impl Live {
    /// Packs module and scene, and traces the first frame.
    ///
    /// # Errors
    /// [`LiveError`].
    pub fn new(module: &Module, scene: &Scene, camera: &Camera) -> Result<Self, LiveError> {
        let spheres = scene.spheres().len();
        if spheres > MAX_SPHERES {
            return Err(LiveError::Spheres { spheres });
        }
        let level = Level::best()?;
        let frame = Tracer::new(Plan::fast(), level).render(scene, camera)?;
        Ok(Self {
            module: packed(&module.0)?,
            scene: packed(&wire::scene_bytes(scene))?,
            camera: BASE64_STANDARD.encode(wire::camera_bytes(camera)),
            size: [camera.size().width(), camera.size().height()],
            hash: hash(&frame.image).iter().fold(String::new(), |mut text, byte| {
                _ = write!(text, "{byte:02x}");
                text
            }),
            level: level.name(),
        })
    }
}

fn packed(bytes: &[u8]) -> Result<String, LiveError> {
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    let packed = packer.write_all(bytes).and_then(|()| packer.finish());
    Ok(BASE64_STANDARD.encode(packed.map_err(LiveError::Pack)?))
}
