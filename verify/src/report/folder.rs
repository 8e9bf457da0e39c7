//! Puts a report into a folder: the pictures first, then `report.json`, then `report.html`, each whole or not at
//! all, so that a page that is there is complete. A report and the pictures of its scenes come in, the paths
//! that were written go out. Pictures that do not match the scenes and subjects one to one are refused before
//! anything is written.

use super::names::Names;
use super::{Part, Report, ScenePictures, SceneReport, html, json};
use crate::picture::{WriteError, write_atomically};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Paths {
    /// The page.
    pub html: PathBuf,
    /// The data.
    pub json: PathBuf,
    /// The pictures, in the order of scenes and subjects.
    pub pictures: Vec<PathBuf>,
}

/// Why a report was not written.
#[derive(Debug, Error)]
pub enum ReportError {
    /// There are not as many sets of pictures as scenes.
    #[error("{pictures} sets of pictures for {scenes} scenes")]
    Scenes {
        /// Scenes in the report.
        scenes: usize,
        /// Sets given.
        pictures: usize,
    },
    /// A scene has not as many pictures, given or skipped, as subjects.
    #[error("scene `{scene}`: {pictures} pictures for {subjects} subjects")]
    Subjects {
        /// Its name.
        scene: String,
        /// Its subjects.
        subjects: usize,
        /// Pictures given or skipped.
        pictures: usize,
    },
    /// The folder could not be made.
    #[error("cannot make the folder `{}`: {cause}", path.display())]
    Folder {
        /// As given.
        path: PathBuf,
        /// What the system says.
        #[source]
        cause: std::io::Error,
    },
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The page could not be filled in.
    #[error("HTML: {0}")]
    Html(#[from] askama::Error),
    /// The data could not be serialised.
    #[error("JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// Writes the report and its pictures into the folder, which is made if it is missing. `pictures` has one entry
/// for each scene; an entry without any picture stands for a scene that shows none. `parts` follow the scenes on the page.
///
/// # Errors
/// [`ReportError`], which names the scene, file or folder.
pub fn write(
    folder: &Path,
    report: &Report,
    pictures: &[ScenePictures],
    parts: &[Part],
) -> Result<Paths, ReportError> {
    check(report, pictures)?;
    let (named, files) = name_pictures(report, pictures);
    let (page, data) = (html(&named, pictures, parts)?, json(&named)?);
    std::fs::create_dir_all(folder)
        .map_err(|cause| ReportError::Folder { path: folder.to_path_buf(), cause })?;
    let mut written = Vec::with_capacity(files.len());
    for (name, bytes) in files {
        let path = folder.join(name);
        write_atomically(&path, bytes)?;
        written.push(path);
    }
    let paths =
        Paths { html: folder.join("report.html"), json: folder.join("report.json"), pictures: written };
    write_atomically(&paths.json, data.as_bytes())?;
    write_atomically(&paths.html, page.as_bytes())?;
    Ok(paths)
}

/// Whether there is one set of pictures for each scene and, if it has any at all, one for each subject.
pub(super) fn check(report: &Report, pictures: &[ScenePictures]) -> Result<(), ReportError> {
    let (scenes, sets) = (report.scenes.len(), pictures.len());
    if scenes != sets {
        return Err(ReportError::Scenes { scenes, pictures: sets });
    }
    for (scene, set) in report.scenes.iter().zip(pictures) {
        let (subjects, pictures) = (scene.subjects.len(), set.subjects.len());
        if pictures != 0 && pictures != subjects {
            return Err(ReportError::Subjects { scene: scene.name.clone(), subjects, pictures });
        }
    }
    Ok(())
}

/// The report with the names of its picture files filled in, and the files.
fn name_pictures<'a>(report: &Report, pictures: &'a [ScenePictures]) -> (Report, Vec<(String, &'a [u8])>) {
    let (mut report, mut names, mut files) = (report.clone(), Names::default(), Vec::new());
    for (scene, set) in report.scenes.iter_mut().zip(pictures) {
        let stem = scene_stem(scene);
        let mut file = |parts: &[&str], bytes: &'a [u8]| {
            let name = names.unique(parts) + ".png";
            files.push((name.clone(), bytes));
            name
        };
        scene.picture = set.truth.as_deref().map(|bytes| file(&[&stem, "truth"], bytes));
        for (subject, picture) in scene.subjects.iter_mut().zip(&set.subjects) {
            let triptych = picture.as_ref().map(|picture| picture.triptych.as_slice());
            subject.picture = triptych.map(|bytes| file(&[&stem, &subject.name, "triptych"], bytes));
        }
    }
    (report, files)
}

/// A scene's name, with the frame if there are several.
fn scene_stem(scene: &SceneReport) -> String {
    if scene.frames > 1 { format!("{} frame {}", scene.name, scene.frame) } else { scene.name.clone() }
}
