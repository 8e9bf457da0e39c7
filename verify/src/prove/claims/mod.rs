//! The claims that are proved, one to a file.

pub mod cell;
pub mod find;
pub mod nearest;
pub mod queue;
pub mod walk;

use super::theorem::Lemma;
use optimized::machine::Machine;

/// The kernel of a lemma that is about none.
const NONE: &str = "none";

/// All lemmas, in the order of the claims.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    [walk::lemmas(), queue::lemmas(), cell::lemmas(), nearest::lemmas(), find::lemmas()]
        .into_iter()
        .flatten()
        .collect()
}

/// x = y.
fn same_i<M: Machine>(m: M, x: M::I, y: M::I) -> M::B {
    m.not(m.or(m.lt_i(x, y), m.lt_i(y, x)))
}

/// x <= y.
fn le_i<M: Machine>(m: M, x: M::I, y: M::I) -> M::B {
    m.not(m.lt_i(y, x))
}

/// x = y as numbers.
fn same<M: Machine>(m: M, x: M::F, y: M::F) -> M::B {
    m.and(m.le(x, y), m.le(y, x))
}

/// If x then y.
fn implies<M: Machine>(m: M, x: M::B, y: M::B) -> M::B {
    m.or(m.not(x), y)
}

/// All of them.
fn all<M: Machine>(m: M, truths: &[M::B]) -> M::B {
    let mut all = truths[0];
    for truth in &truths[1..] {
        all = m.and(all, *truth);
    }
    all
}
