//! The report as JSON: the same data as the page, with the names of the picture files instead of the pictures.
//! A [`Report`] comes in, UTF-8 text goes out, `schema_version` first, fields in the order of their declaration.
//! Numbers that JSON cannot hold (NaN, infinities) become null; their bits stand beside them.

use super::Report;

/// The report as indented JSON with a newline at its end.
///
/// # Errors
/// If serialisation fails, which the types of [`Report`] give no cause for.
pub fn json(report: &Report) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(report).map(|text| text + "\n")
}
