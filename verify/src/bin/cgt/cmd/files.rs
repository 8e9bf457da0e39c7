//! What a command leaves: all it found as JSON where that was asked for, and a folder with a page and the same data.

use crate::{Failure, say};
use serde::Serialize;
use std::path::Path;
use verify::picture::write_atomically;

/// Makes a folder that is not there yet.
pub(crate) fn folder(folder: &Path) -> Result<(), Failure> {
    let made = std::fs::create_dir_all(folder);
    made.map_err(|error| format!("the folder `{}`: {error}", folder.display()).into())
}

/// Writes a report to `json`, and to NAME.html and NAME.json in `folder`; neither if not asked for.
pub(crate) fn write<R: Serialize, E>(
    name: &str,
    (json, folder): (Option<&Path>, Option<&Path>),
    report: &R,
    page: impl FnOnce(&R) -> Result<String, E>,
) -> Result<(), Failure>
where
    Failure: From<E>,
{
    if let Some(file) = json {
        write_atomically(file, text(report)?.as_bytes())?;
    }
    if let Some(folder) = folder {
        let page = page(report)?;
        data(name, folder, report, None)?;
        write_atomically(&folder.join(format!("{name}.html")), page.as_bytes())?;
    }
    Ok(())
}

/// Writes NAME.json and, if there is a table, NAME.csv into a folder, which is made if it is missing.
pub(crate) fn data(
    name: &str,
    folder: &Path,
    report: &impl Serialize,
    csv: Option<Vec<u8>>,
) -> Result<(), Failure> {
    self::folder(folder)?;
    if let Some(csv) = csv {
        write_atomically(&folder.join(format!("{name}.csv")), &csv)?;
    }
    Ok(write_atomically(&folder.join(format!("{name}.json")), text(report)?.as_bytes())?)
}

/// Leaves a chapter: its data, its page, and on the terminal its table and where the page is.
pub(crate) fn chapter(
    name: &str,
    folder: &Path,
    report: &impl Serialize,
    csv: Vec<u8>,
    (page, told): (&str, &str),
) -> Result<(), Failure> {
    data(name, folder, report, Some(csv))?;
    let file = folder.join(format!("{name}.html"));
    write_atomically(&file, page.as_bytes())?;
    say(told)?;
    say(&format!("page: {}\n", file.display()))
}

fn text(report: &impl Serialize) -> Result<String, Failure> {
    Ok(serde_json::to_string_pretty(report)? + "\n")
}
