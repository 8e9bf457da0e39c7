//! Claim: a push puts the id into the newest slot, moves every other id by one, and loses exactly the oldest; an id is never taken for
//! an empty slot.
//!
//! For all contents of a queue and all ids of 16 bits. That corners which share a cell list an id once rests on this and on reading
//! all queues before any is written: the same queue with the same id pushed is the same queue. All coincidences of eight corners are
//! run over in `tests/queue.rs`.

use super::{all, implies, same_i};
use crate::prove::broken::Fault;
use crate::prove::smt::Numbers;
use crate::prove::symbolic::Lanes;
use crate::prove::theorem::{Ask, Expected, Lemma, Statement, Theorem, Wrong};
use optimized::machine::Machine;
use optimized::queue::{EMPTY, Queues};

const WORDS: [&str; 8] = ["word 0", "word 1", "word 2", "word 3", "word 4", "word 5", "word 6", "word 7"];

/// The sixteen slots, newest first.
fn slots<M: Machine>(m: M, words: &[M::I; 8]) -> Vec<M::I> {
    let halves = |word: &M::I| [m.shr_16(m.shl_16(*word)), m.shr_16(*word)];
    words.iter().flat_map(halves).collect()
}

struct Push;

impl Theorem for Push {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (words, id) = (WORDS.map(|name| ask.integer(name)), ask.integer("id"));
        let pushed = Queues::<K>(words).push(kernel, id).0;
        let (before, after) = (slots(m, &words), slots(m, &pushed));
        let moved: Vec<M::B> = before[..15].iter().zip(&after[1..]).map(|(x, y)| same_i(m, *x, *y)).collect();
        let zero = m.splat_i(0);
        let bits = m.and(m.not(m.lt_i(id, zero)), m.lt_i(id, m.splat_i(1 << 16)));
        Statement {
            steps: Vec::new(),
            assume: vec![("the id has 16 bits", bits)],
            conclude: vec![
                ("the newest slot holds the id", same_i(m, after[0], id)),
                ("every other slot holds what the one before it held", all(m, &moved)),
            ],
        }
    }
}

struct Occupied;

impl Theorem for Occupied {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (words, id) = (WORDS.map(|name| ask.integer(name)), ask.integer("id"));
        let pushed = Queues::<K>(words).push(kernel, id).0;
        let (before, after) = (slots(m, &words), slots(m, &pushed));
        let empty = m.splat_i(i32::from(EMPTY));
        let kept: Vec<M::B> = before[..15]
            .iter()
            .zip(&after[1..])
            .map(|(x, y)| implies(m, m.not(same_i(m, *x, empty)), m.not(same_i(m, *y, empty))))
            .collect();
        let below = m.and(m.not(m.lt_i(id, m.splat_i(0))), m.lt_i(id, empty));
        Statement {
            steps: Vec::new(),
            assume: vec![("the id is below the one that means empty", below)],
            conclude: vec![
                ("its slot is not empty", m.not(same_i(m, after[0], empty))),
                ("no slot becomes empty but the one that is lost", all(m, &kept)),
            ],
        }
    }
}

/// A full queue.
const FULL: &[(&str, u32)] = &[
    ("word 0", 0x0001_0002),
    ("word 1", 0x0003_0004),
    ("word 2", 0x0005_0006),
    ("word 3", 0x0007_0008),
    ("word 4", 0x0009_000a),
    ("word 5", 0x000b_000c),
    ("word 6", 0x000d_000e),
    ("word 7", 0x8001_0010),
    ("id", 0),
];

/// The lemmas.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    let lemma = |name, words, statement| Lemma {
        name,
        words,
        kernel: "optimized::queue::Queues::push",
        numbers: Numbers::Float,
        whole: true,
        lanes: Lanes::Any,
        expected: Expected::Holds,
        long: false,
        witness: FULL,
        harmless: &[(
            Wrong::Operation(21, Fault::Nothing),
            "what falls out of the last word is found, and not used",
        )],
        statement,
    };
    vec![
        lemma(
            "queue.push",
            "A push puts the id into the newest slot, moves all others by one, and loses exactly the oldest",
            Box::new(Push),
        ),
        lemma("queue.occupied", "An id that is pushed is never taken for an empty slot", Box::new(Occupied)),
    ]
}
