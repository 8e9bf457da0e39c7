//! Writes a file whole or not at all: the bytes go to a temporary file in the same folder, which then takes the
//! file's name. A path and bytes come in; what fails is named with the path and the cause, and then the file
//! that was there before is still there and the temporary one is gone. Of a link to a file that file is written; what is
//! no file (a pipe, a device) is written to as it is; permissions stay as they were.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};
use thiserror::Error;

/// Why a file was not written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The path has no file name: it is empty, a root, or ends in `..`.
    #[error("`{}` names no file", path.display())]
    NoName {
        /// As given.
        path: PathBuf,
    },
    /// No file could be made beside it: the folder is missing, read-only, or no folder.
    #[error("cannot make a file in the folder of `{}`: {cause}", path.display())]
    Folder {
        /// As given.
        path: PathBuf,
        /// What the system says.
        #[source]
        cause: std::io::Error,
    },
    /// Nothing can be written into a folder: it or one above it is read-only or no folder.
    #[error("cannot write into the folder `{}`: {cause}", folder.display())]
    Unwritable {
        /// As given.
        folder: PathBuf,
        /// What the system says.
        #[source]
        cause: std::io::Error,
    },
    /// The bytes did not all reach the disk: it is full, or a quota is.
    #[error("cannot write the {bytes} bytes of `{}`: {cause}", path.display())]
    Bytes {
        /// As given.
        path: PathBuf,
        /// How many there are.
        bytes: usize,
        /// What the system says.
        #[source]
        cause: std::io::Error,
    },
    /// The finished file could not take its name: a folder has it, or its owner forbids.
    #[error("cannot put a file in the place of `{}`: {cause}", path.display())]
    Place {
        /// As given.
        path: PathBuf,
        /// What the system says.
        #[source]
        cause: std::io::Error,
    },
}

/// Writes the bytes to the path, in place of a file that may be there.
///
/// # Errors
/// [`WriteError`], which names the path and the step that failed.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let mut file = AtomicFile::new(path)?;
    // What fails here is told at the end.
    _ = file.write_all(bytes);
    file.finish()
}

/// A file that is written piece by piece and takes its name when it is finished; given up before, it leaves nothing.
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    file: Sink,
    bytes: usize,
    /// The first failure, which [`AtomicFile::finish`] tells: an encoder between may have dressed it up.
    failed: Option<std::io::Error>,
}

/// Where bytes go.
#[derive(Debug)]
enum Sink {
    /// A temporary file, and the place that it is to take.
    Beside(NamedTempFile, PathBuf),
    /// What is no file and cannot be replaced by one.
    Straight(File),
}

impl AtomicFile {
    /// Begins one.
    ///
    /// # Errors
    /// [`WriteError::NoName`], [`WriteError::Folder`] and, for what is no file, [`WriteError::Place`].
    pub fn new(path: &Path) -> Result<Self, WriteError> {
        let at = || path.to_path_buf();
        if path.file_name().is_none() {
            return Err(WriteError::NoName { path: at() });
        }
        let there = std::fs::metadata(path).ok();
        if there.as_ref().is_some_and(|there| !there.is_file() && !there.is_dir()) {
            let file = File::options().write(true).open(path);
            let file = file.map_err(|cause| WriteError::Place { path: at(), cause })?;
            return Ok(Self { path: at(), file: Sink::Straight(file), bytes: 0, failed: None });
        }
        let place = if path.is_symlink() { path.canonicalize().unwrap_or_else(|_| at()) } else { at() };
        // The parent of a bare name is the empty path, which means the current folder but cannot be opened.
        let folder = place.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let file =
            temporary(folder).map_err(|cause| WriteError::Folder { path: at(), cause: bare(cause) })?;
        if let Some(there) = there.filter(std::fs::Metadata::is_file) {
            let kept = file.as_file().set_permissions(there.permissions());
            kept.map_err(|cause| WriteError::Place { path: at(), cause })?;
        }
        Ok(Self { path: at(), file: Sink::Beside(file, place), bytes: 0, failed: None })
    }

    /// Whether a write has failed, which [`AtomicFile::finish`] tells with the file's name.
    #[must_use]
    pub fn has_failed(&self) -> bool {
        self.failed.is_some()
    }

    /// Gives it its name, in place of a file that may be there.
    ///
    /// # Errors
    /// [`WriteError::Bytes`] if any write failed or the bytes do not reach the disk, [`WriteError::Place`].
    pub fn finish(self) -> Result<(), WriteError> {
        let Self { path, file, bytes, failed } = self;
        if let Some(cause) = failed {
            return Err(WriteError::Bytes { path, bytes, cause });
        }
        let Sink::Beside(file, place) = file else { return Ok(()) };
        // Some file systems tell of a full disk only when the bytes must reach it.
        match file.as_file().sync_all() {
            Err(cause) => Err(WriteError::Bytes { path, bytes, cause }),
            Ok(()) => match file.persist(place) {
                Ok(_) => Ok(()),
                Err(failed) => Err(WriteError::Place { path, cause: failed.error }),
            },
        }
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.write_all(bytes).map(|()| bytes.len())
    }

    fn write_all(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.bytes += bytes.len();
        self.file.get().write_all(bytes).map_err(|error| {
            let told = std::io::Error::new(error.kind(), error.to_string());
            self.failed.get_or_insert(error);
            told
        })
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.get().flush()
    }
}

impl Sink {
    fn get(&mut self) -> &mut File {
        match self {
            Self::Beside(file, _) => file.as_file_mut(),
            Self::Straight(file) => file,
        }
    }
}

/// Whether files could be made in that folder or, where it is missing, in the nearest one above it. To be asked
/// before minutes are spent on what is to be written there; it changes nothing, and promises nothing.
///
/// # Errors
/// [`WriteError::Unwritable`] with what the system says.
pub fn check_folder(folder: &Path) -> Result<(), WriteError> {
    let there = folder.ancestors().find(|above| above.as_os_str().is_empty() || above.exists());
    let there = there.filter(|above| !above.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let refused = |cause| WriteError::Unwritable { folder: folder.into(), cause: bare(cause) };
    temporary(there).map(drop).map_err(refused)
}

/// Whether a file could be made there, whose folder must be there already; asked as [`check_folder`] is. Of what is no file (a pipe, a device) nothing
/// is asked, since who reads would take the end of the question for the end of the answer.
///
/// # Errors
/// As [`AtomicFile::new`], and [`WriteError::Place`] where a folder has that name.
pub fn check_file(path: &Path) -> Result<(), WriteError> {
    match std::fs::metadata(path) {
        Ok(there) if there.is_dir() => {
            let cause = std::io::ErrorKind::IsADirectory.into();
            Err(WriteError::Place { path: path.into(), cause })
        }
        Ok(there) if !there.is_file() => Ok(()),
        _ => AtomicFile::new(path).map(drop),
    }
}

/// The system's error without the name of the temporary file, which `tempfile` adds and which says nothing to a
/// person. It hands out the original only as text.
fn bare(error: std::io::Error) -> std::io::Error {
    match error.to_string().split_once(" at path ") {
        Some((said, _)) => std::io::Error::new(error.kind(), said),
        None => error,
    }
}

/// Temporary files are private unless told otherwise; a report is as readable as the umask lets it be.
fn temporary(folder: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".cgt-").suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}
