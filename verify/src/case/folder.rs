//! Keeps a failure: the case's file, what was promised beside what came, and the account of its first wrong pixel, all under one name
//! in a folder; and the line that runs it again.

use super::account::account;
use super::{Asked, Case, CaseError};
use crate::picture::{PictureError, RgbaImage, WriteError, join, panels, png, write_atomically};
use crate::subject::Subject;
use image::imageops::{FilterType, resize};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The variable that names the folder for failures; without it `target/cases` of the workspace, wherever a test is run.
pub const VARIABLE: &str = "CGT_CASES";

/// Panels of less width are magnified to this at least.
const WIDTH: u32 = 160;

/// Why a failure was not kept.
#[derive(Debug, Error)]
#[allow(missing_docs, reason = "each says all itself")]
pub enum KeepError {
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Picture(#[from] PictureError),
    #[error(transparent)]
    Case(#[from] CaseError),
    #[error("the folder `{folder}`: {cause}")]
    Folder { folder: PathBuf, cause: std::io::Error },
}

/// What was kept.
#[derive(Clone, Debug)]
pub struct Kept {
    /// The case's file.
    pub file: PathBuf,
    /// The command that judges it again and accounts for its pixel.
    pub command: String,
    /// The account.
    pub account: String,
}

/// Where failures go.
#[must_use]
pub fn folder() -> PathBuf {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."));
    std::env::var_os(VARIABLE).map_or_else(|| workspace.join("target/cases"), PathBuf::from)
}

/// Writes `NAME.json`, `NAME.png` and `NAME.txt`; the first alone if the tracer gives no picture.
///
/// # Errors
/// [`KeepError`] if one of them cannot be made or written.
pub fn keep(case: &Case, folder: &Path, name: &str) -> Result<Kept, KeepError> {
    std::fs::create_dir_all(folder).map_err(|cause| KeepError::Folder { folder: folder.into(), cause })?;
    let file = folder.join(format!("{name}.json"));
    let judged = match case.judge() {
        Ok(judged) => judged,
        // There is nothing to show, but the case can be run again.
        Err(error) => {
            write_atomically(&file, case.to_json().as_bytes())?;
            let command = format!("cgt replay {}{}", file.display(), asking(case));
            return Ok(Kept { file, command, account: error.to_string() });
        }
    };
    let wrong = judged.iter().position(|judged| judged.wrong.is_some());
    let frame = wrong.unwrap_or(judged.len() - 1);
    let place = case.pixel.or(judged[frame].wrong);
    let pixel = place.unwrap_or([0, 0]);
    let case = Case { pixel: Some(pixel), ..case.clone() };
    write_atomically(&file, case.to_json().as_bytes())?;
    let panels =
        panels(&judged[frame].promised, &judged[frame].picture, place)?.map(|panel| magnified(&panel));
    write_atomically(&folder.join(format!("{name}.png")), &png(&join(&panels))?)?;
    let account = account(&case, frame, pixel)?;
    write_atomically(&folder.join(format!("{name}.txt")), account.as_bytes())?;
    let command = format!("cgt replay {} --pixel {},{}{}", file.display(), pixel[0], pixel[1], asking(&case));
    Ok(Kept { file, command, account })
}

/// What the command needs besides, where the tracer is a program.
fn asking(case: &Case) -> String {
    match &case.asked {
        Asked::Foreign { tracer: Some(tracer), .. } => format!(" {}", tracer.option()),
        _ => String::new(),
    }
}

/// Each pixel as a square of so many that a small panel can be seen.
fn magnified(panel: &RgbaImage) -> RgbaImage {
    let factor = WIDTH.div_ceil(panel.width().max(1));
    resize(panel, factor * panel.width(), factor * panel.height(), FilterType::Nearest)
}
