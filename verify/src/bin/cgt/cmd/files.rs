//! What a command leaves: all it found as JSON where that was asked for, and a folder with a page and the same JSON.

use crate::Failure;
use serde::Serialize;
use std::path::Path;
use verify::picture::write_atomically;

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
    let text = serde_json::to_string_pretty(report)? + "\n";
    if let Some(file) = json {
        write_atomically(file, text.as_bytes())?;
    }
    if let Some(folder) = folder {
        let page = page(report)?;
        std::fs::create_dir_all(folder)
            .map_err(|error| format!("the folder `{}`: {error}", folder.display()))?;
        write_atomically(&folder.join(format!("{name}.json")), text.as_bytes())?;
        write_atomically(&folder.join(format!("{name}.html")), page.as_bytes())?;
    }
    Ok(())
}
