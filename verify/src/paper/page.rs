//! Claims as a piece of an HTML page in the report's style: how many have which standing, and the table.

use super::{PaperClaim, Standing};
use askama::Template;

#[derive(Template)]
#[template(path = "paper-claims.html")]
struct Part<'a> {
    tally: Vec<(Standing, usize)>,
    claims: &'a [PaperClaim],
}

/// The piece.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn part(claims: &[PaperClaim]) -> Result<String, askama::Error> {
    let number = |standing| claims.iter().filter(|claim| claim.verdict == standing).count();
    Part { tally: Standing::ALL.map(|standing| (standing, number(standing))).into(), claims }.render()
}
