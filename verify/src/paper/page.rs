//! Claims as a piece of an HTML page in the report's style: of which frames, how many have which standing, and the table.

use super::record::Record;
use super::{PaperClaim, Standing};
use askama::Template;

#[derive(Template)]
#[template(path = "paper-claims.html")]
struct Part<'a> {
    width: u32,
    height: u32,
    sample: u32,
    tally: Vec<(Standing, usize)>,
    claims: &'a [PaperClaim],
}

/// The piece.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn part(record: &Record) -> Result<String, askama::Error> {
    let tally = Standing::ALL.map(|standing| (standing, record.count(standing))).into();
    let (Record { claims, sample, .. }, [width, height]) = (record, record.size);
    Part { width, height, sample: *sample, tally, claims }.render()
}
