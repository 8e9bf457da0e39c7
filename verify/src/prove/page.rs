//! Proofs as a part of a page: what is claimed and what was found of it, then lemma by lemma as on the terminal.

use super::run::Proofs;
use crate::report::Evidence;
use askama::Template;

#[derive(Template)]
#[template(path = "prove-part.html")]
struct Part<'a> {
    solvers: String,
    claims: Vec<(&'a str, &'static str, String)>,
    proofs: &'a Proofs,
    lemmas: usize,
    faults: usize,
    text: String,
}

/// The part.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn part(proofs: &Proofs) -> Result<String, askama::Error> {
    let claim = |claim: &'_ super::run::Found| {
        let word = claim.found.map_or("not judged", Evidence::word);
        (claim.statement, word, word.replace(' ', "-"))
    };
    Part {
        solvers: if proofs.solvers.is_empty() { "no solver".into() } else { proofs.solvers.join(", ") },
        claims: proofs.claims.iter().map(claim).collect(),
        lemmas: proofs.lemmas.len(),
        faults: proofs.faults.iter().map(|kernel| kernel.tried).sum(),
        text: proofs.to_string(),
        proofs,
    }
    .render()
}
