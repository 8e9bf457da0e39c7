//! Claims for the terminal: verdict, kind of evidence and statement in columns, under it figures, counterexample and command.

use super::{PaperClaim, Standing};
use crate::report::TEXT_WIDTH;
use textwrap::{Options, fill};

/// Columns of verdict and evidence.
const INDENT: usize = 36;

/// All claims, and how many have which standing.
#[must_use]
pub fn text(claims: &[PaperClaim]) -> String {
    let blank = " ".repeat(INDENT);
    let mut text =
        format!("{:<23}{:<13}{}\n", "verdict", "evidence", "claim, figure, counterexample, command");
    for claim in claims {
        let head = format!("{:<23}{:<13}", claim.verdict.word(), claim.evidence.word());
        let options = Options::new(TEXT_WIDTH).subsequent_indent(&blank);
        text += &(fill(&claim.statement, options.clone().initial_indent(&head)) + "\n");
        let against = claim.counterexample.as_ref().map(|against| format!("against it: {against}"));
        let below = [Some(claim.figure.clone()), against, Some(claim.how.clone())];
        for line in below.into_iter().flatten().filter(|line| !line.is_empty()) {
            text += &(fill(&line, options.clone().initial_indent(&blank)) + "\n");
        }
    }
    for standing in Standing::ALL {
        let number = claims.iter().filter(|claim| claim.verdict == standing).count();
        text += &format!("{number:>4} {}\n", standing.word());
    }
    text
}
