//! Claim: the mended flattened loop visits the cells of the nested loops, in their order, and ends; the loop as printed does so if and
//! only if all slices have one and the same rectangle of cells, which is one cell wide on an axis.
//!
//! The shipped [`step`] is held against the successor of a cell in the nested loops, said with branches (`nested`), at 32 bits and
//! for every rectangle of every slice. From a cell of a slice the two agree (`walk.successor`); from a slice without cells the
//! step goes to the first cell of the next (`walk.empty`), whose visit is not live. So by induction over the steps the live cells
//! are those of the nested loops in their order. Each step goes forward and stays within the rectangle (`walk.forward`), and a
//! rectangle has finitely many cells: the walk ends.
//!
//! What surrounds the step, start and end of the shipped loop, is plain code, and is run over every pair of rectangles within 6 by 6
//! cells (`tests/walk.rs`).

use super::{all, implies, le_i, same_i};
use crate::prove::smt::Numbers;
use crate::prove::symbolic::Lanes;
use crate::prove::theorem::{Ask, Expected, Lemma, Statement, Theorem};
use optimized::machine::{Machine, Site};
use optimized::walk::{Cursor, Rectangle, step};

/// A cell, the rectangle of its slice, and the next slice's.
struct Place<M: Machine> {
    at: Cursor<M>,
    here: Rectangle<M>,
    next: Rectangle<M>,
}

fn place<M: Machine>(ask: &mut impl Ask<M>) -> Place<M> {
    let at = Cursor { slice: ask.integer("slice"), j: ask.integer("j"), k: ask.integer("k") };
    let here = Rectangle {
        first: [ask.integer("first j"), ask.integer("first k")],
        last: [ask.integer("last j"), ask.integer("last k")],
    };
    let next = Rectangle {
        first: [ask.integer("next first j"), ask.integer("next first k")],
        last: [ask.integer("next last j"), ask.integer("next last k")],
    };
    Place { at, here, next }
}

impl<M: Machine> Place<M> {
    /// The shipped kernel.
    fn step<K: Machine<F = M::F, I = M::I, B = M::B>>(&self, kernel: K) -> Cursor<M> {
        let at = Cursor { slice: self.at.slice, j: self.at.j, k: self.at.k };
        let of = |r: &Rectangle<M>| Rectangle { first: r.first, last: r.last };
        let Cursor { slice, j, k } = step(kernel, at, &of(&self.here), &of(&self.next));
        Cursor { slice, j, k }
    }

    fn within(&self, m: M, at: &Cursor<M>) -> M::B {
        let Rectangle { first, last } = self.here;
        let j = m.and(le_i(m, first[0], at.j), le_i(m, at.j, last[0]));
        m.and(j, m.and(le_i(m, first[1], at.k), le_i(m, at.k, last[1])))
    }

    /// Whether the next slice has the same rectangle.
    fn alike(&self, m: M) -> M::B {
        let same = |side: usize| {
            let first = same_i(m, self.here.first[side], self.next.first[side]);
            m.and(first, same_i(m, self.here.last[side], self.next.last[side]))
        };
        m.and(same(0), same(1))
    }

    fn first_of_next(&self, m: M) -> Cursor<M> {
        let slice = m.add_i(self.at.slice, m.splat_i(1));
        Cursor { slice, j: self.next.first[0], k: self.next.first[1] }
    }
}

fn equal<M: Machine>(m: M, x: &Cursor<M>, y: &Cursor<M>) -> M::B {
    all(m, &[same_i(m, x.slice, y.slice), same_i(m, x.j, y.j), same_i(m, x.k, y.k)])
}

/// The cell after one of a slice that has cells, in `for each slice { for each j { for each k { … } } }`: with branches.
fn nested<M: Machine>(m: M, place: &Place<M>) -> Cursor<M> {
    let Place { at, here, .. } = place;
    let one = m.splat_i(1);
    if m.any(m.lt_i(at.k, here.last[1]), Site::NextK) {
        return Cursor { slice: at.slice, j: at.j, k: m.add_i(at.k, one) };
    }
    if m.any(m.lt_i(at.j, here.last[0]), Site::NextJ) {
        return Cursor { slice: at.slice, j: m.add_i(at.j, one), k: here.first[1] };
    }
    place.first_of_next(m)
}

/// The cell after one by the paper's Figure 3, bottom, with the first slice's bounds: `first` and `last`.
fn printed<M: Machine>(m: M, at: &Cursor<M>, Rectangle { first, last }: &Rectangle<M>) -> Cursor<M> {
    let one = m.splat_i(1);
    if m.any(m.lt_i(at.j, last[0]), Site::NextJ) {
        return Cursor { slice: at.slice, j: m.add_i(at.j, one), k: at.k };
    }
    if m.any(m.lt_i(at.k, last[1]), Site::NextK) {
        return Cursor { slice: at.slice, j: first[0], k: m.add_i(at.k, one) };
    }
    Cursor { slice: m.add_i(at.slice, one), j: first[0], k: first[1] }
}

struct Successor;

impl Theorem for Successor {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let place = place(ask);
        let within = place.within(m, &place.at);
        let conclusion = equal(m, &place.step(kernel), &nested(m, &place));
        Statement {
            steps: Vec::new(),
            assume: vec![("the cell lies in its slice's rectangle", within)],
            conclude: vec![("the step goes where the nested loops go", conclusion)],
        }
    }
}

struct Empty;

impl Theorem for Empty {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let place = place(ask);
        let Rectangle { first, last } = &place.here;
        let empty = m.or(m.lt_i(last[0], first[0]), m.lt_i(last[1], first[1]));
        let conclusion = equal(m, &place.step(kernel), &place.first_of_next(m));
        Statement {
            steps: Vec::new(),
            assume: vec![("the slice has no cell", empty)],
            conclude: vec![("the step goes to the first cell of the next slice", conclusion)],
        }
    }
}

struct Forward;

impl Theorem for Forward {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let place = place(ask);
        let next = place.step(kernel);
        let Cursor { slice, j, k } = place.at;
        let same_slice = same_i(m, next.slice, slice);
        let in_row = m.and(same_i(m, next.j, j), m.lt_i(k, next.k));
        let later = m.or(m.lt_i(j, next.j), in_row);
        let within = place.within(m, &next);
        Statement {
            steps: Vec::new(),
            assume: vec![("the cell lies in its slice's rectangle", place.within(m, &place.at))],
            conclude: vec![
                ("no slice is left for an earlier one or left out", {
                    m.or(same_slice, same_i(m, next.slice, m.add_i(slice, m.splat_i(1))))
                }),
                ("in a slice each step goes to a later cell", implies(m, same_slice, later)),
                ("in a slice each step stays in the rectangle", implies(m, same_slice, within)),
            ],
        }
    }
}

/// What the printed loop is held to.
enum Printed {
    /// It is right where all slices have one rectangle, one cell wide on an axis.
    Right,
    /// It is right where all slices have one rectangle: it is not.
    AnyWidth,
    /// From the first cell of a rectangle that is wider on both axes it goes wrong.
    Wide,
    /// From the last cell of a slice it goes wrong if the next slice begins elsewhere.
    Stale,
}

impl Theorem for Printed {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let place = place(ask);
        let Rectangle { first, last } = place.here;
        let single = |side: usize| same_i(m, first[side], last[side]);
        let right = equal(m, &printed(m, &place.at, &place.here), &place.step(kernel));
        let mut assume = Vec::new();
        if !matches!(self, Self::Stale) {
            assume.push(("the cell lies in its slice's rectangle", place.within(m, &place.at)));
        }
        let at_first = m.and(same_i(m, place.at.j, first[0]), same_i(m, place.at.k, first[1]));
        let at_last = m.and(same_i(m, place.at.j, last[0]), same_i(m, place.at.k, last[1]));
        let conclusion = match self {
            Self::Right => {
                assume.push(("the next slice has the same rectangle", place.alike(m)));
                assume.push(("it is one cell wide on an axis", m.or(single(0), single(1))));
                ("the printed loop goes where the mended one goes", right)
            }
            Self::AnyWidth => {
                let (zero, two) = (m.splat_i(0), m.splat_i(2));
                let small = |x: M::I| m.and(le_i(m, zero, x), m.lt_i(x, two));
                let small = all(m, &[small(first[0]), small(first[1]), small(last[0]), small(last[1])]);
                assume.push(("the next slice has the same rectangle", place.alike(m)));
                assume.push(("bounds are 0 and 1, and the walk begins", {
                    all(m, &[small, at_first, same_i(m, place.at.slice, zero)])
                }));
                ("the printed loop goes where the mended one goes", right)
            }
            Self::Wide => {
                assume.push(("it is the first cell", at_first));
                assume.push(("the rectangle is wider on both axes", m.not(m.or(single(0), single(1)))));
                ("the printed loop goes elsewhere", m.not(right))
            }
            Self::Stale => {
                let alike =
                    m.and(same_i(m, first[0], place.next.first[0]), same_i(m, first[1], place.next.first[1]));
                assume.push(("it is the last cell", at_last));
                assume.push(("the next slice begins elsewhere", m.not(alike)));
                ("the printed loop goes elsewhere", m.not(right))
            }
        };
        Statement { steps: Vec::new(), assume, conclude: vec![conclusion] }
    }
}

/// A cell in the middle of 3 by 3, with a next slice that begins elsewhere.
const MIDDLE: &[(&str, u32)] = &[
    ("slice", 4),
    ("j", 6),
    ("k", 8),
    ("first j", 5),
    ("first k", 7),
    ("last j", 7),
    ("last k", 9),
    ("next first j", 1),
    ("next first k", 2),
    ("next last j", 3),
    ("next last k", 4),
];
/// Below zero, the slice has no cell.
const NO_CELL: &[(&str, u32)] = &[
    ("slice", 0),
    ("j", 3),
    ("k", 5),
    ("first j", 3),
    ("first k", 5),
    ("last j", u32::MAX),
    ("last k", 9),
    ("next first j", 1),
    ("next first k", 2),
    ("next last j", 3),
    ("next last k", 4),
];
/// One row, the same in the next slice.
const ROW: &[(&str, u32)] = &[
    ("slice", 0),
    ("j", 3),
    ("k", 5),
    ("first j", 3),
    ("first k", 5),
    ("last j", 3),
    ("last k", 9),
    ("next first j", 3),
    ("next first k", 5),
    ("next last j", 3),
    ("next last k", 9),
];
/// The first cell of 2 by 2, the same in the next slice.
const SQUARE: &[(&str, u32)] = &[
    ("slice", 0),
    ("j", 0),
    ("k", 0),
    ("first j", 0),
    ("first k", 0),
    ("last j", 1),
    ("last k", 1),
    ("next first j", 0),
    ("next first k", 0),
    ("next last j", 1),
    ("next last k", 1),
];
/// The only cell of a slice; the next slice begins elsewhere.
const MOVED: &[(&str, u32)] = &[
    ("slice", 0),
    ("j", 0),
    ("k", 0),
    ("first j", 0),
    ("first k", 0),
    ("last j", 0),
    ("last k", 0),
    ("next first j", 1),
    ("next first k", 0),
    ("next last j", 1),
    ("next last k", 0),
];

/// The lemmas.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    let lemma = |name, words, expected, witness, statement| Lemma {
        name,
        words,
        kernel: "optimized::walk::step",
        numbers: Numbers::Float,
        whole: true,
        lanes: Lanes::Alike,
        expected,
        long: false,
        witness,
        harmless: &[],
        statement,
    };
    use Expected::{Fails, Holds};
    vec![
        lemma(
            "walk.successor",
            "From every cell of a slice the flattened step goes where the nested loops go, in all 32-bit bounds",
            Holds,
            MIDDLE,
            Box::new(Successor),
        ),
        lemma(
            "walk.empty",
            "From a slice without cells the flattened step goes to the first cell of the next slice",
            Holds,
            NO_CELL,
            Box::new(Empty),
        ),
        lemma(
            "walk.forward",
            "Each flattened step goes to a later cell of the slice, or to the next slice: the walk ends",
            Holds,
            MIDDLE,
            Box::new(Forward),
        ),
        lemma(
            "walk.printed.right",
            "The printed step is right where all slices have one rectangle that is one cell wide on an axis",
            Holds,
            ROW,
            Box::new(Printed::Right),
        ),
        lemma(
            "walk.printed.any",
            "The printed step is right where all slices have one rectangle",
            Fails,
            SQUARE,
            Box::new(Printed::AnyWidth),
        ),
        lemma(
            "walk.printed.wide",
            "The printed step is wrong at the first cell of every rectangle that is wider on both axes",
            Holds,
            SQUARE,
            Box::new(Printed::Wide),
        ),
        lemma(
            "walk.printed.stale",
            "The printed step is wrong at the last cell of every slice whose successor begins elsewhere",
            Holds,
            MOVED,
            Box::new(Printed::Stale),
        ),
    ]
}
