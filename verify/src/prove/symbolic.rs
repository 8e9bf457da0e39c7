//! The symbolic machine: one lane, whose values are [`Term`]s. A kernel that runs on it leaves behind what it would do to any values.
//!
//! *Doors.* Where a kernel asks [`Machine::any`], both answers are possible. [`explore`] runs it once for each path: a path is the
//! list of answers given. Other lanes are not there; so *no* means no for this lane too, and of *yes* this lane knows
//! nothing ([`Lanes::Any`]). Where all lanes hold the same, as a walk's do, *yes* means yes for this one ([`Lanes::Alike`]).
//!
//! *Rim.* A kernel takes some numbers as plain f32 and spreads them. A term passes for one as a NaN that carries its place. Only a change of
//! sign is understood; what plain arithmetic would make of it is lost. This is why each statement is computed from its terms
//! for many inputs and held against the scalar machine before a solver sees it ([`super::theorem`]).

use super::term::{Node, Op, Sort, Term, Terms};
use optimized::machine::{LANES, Machine, Site};
use std::cell::{Cell, RefCell};
use thiserror::Error;

/// What is known of the other lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lanes {
    /// Nothing.
    Any,
    /// That they hold the same as this one.
    Alike,
}

/// A door, and the answer given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer {
    /// Where.
    pub site: Site,
    /// This lane's own.
    pub own: Term,
    /// Whether any lane said yes.
    pub any: bool,
}

/// Why a kernel could not be explored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum ExploreError {
    /// There are more paths than the budget allows.
    #[error("more than {0} paths")]
    Paths(usize),
    /// A path is longer than the budget allows.
    #[error("more than {0} doors on one path")]
    Doors(usize),
}

/// The most paths of a kernel.
pub const MAX_PATHS: usize = 4096;
/// The most doors on a path.
pub const MAX_DOORS: usize = 64;

/// Where terms are kept while paths are explored.
#[derive(Debug)]
pub struct Space {
    terms: RefCell<Terms>,
    /// Answers of the path that is run: first those it must give, then all others with yes.
    path: RefCell<Vec<Answer>>,
    given: RefCell<Vec<bool>>,
    too_long: Cell<bool>,
    /// What is known of the other lanes.
    pub lanes: Lanes,
}

/// The machine.
#[derive(Clone, Copy, Debug)]
pub struct Symbolic<'a>(&'a Space);

/// What a kernel gave on one path.
#[derive(Clone, Debug)]
pub struct Path<T> {
    /// The answers at its doors.
    pub answers: Vec<Answer>,
    /// What it gave.
    pub result: T,
}

impl<T> Path<T> {
    /// What this lane knows on the path: terms, and whether each holds.
    pub fn known(&self, lanes: Lanes) -> impl Iterator<Item = (Term, bool)> + use<'_, T> {
        self.answers
            .iter()
            .filter(move |answer| !answer.any || lanes == Lanes::Alike)
            .map(|answer| (answer.own, answer.any))
    }
}

impl Space {
    /// Nothing yet.
    #[must_use]
    pub fn new(lanes: Lanes) -> Self {
        Self {
            terms: RefCell::default(),
            path: RefCell::default(),
            given: RefCell::default(),
            too_long: Cell::new(false),
            lanes,
        }
    }

    /// A machine on it.
    #[must_use]
    pub fn machine(&self) -> Symbolic<'_> {
        Symbolic(self)
    }

    /// The terms made.
    #[must_use]
    pub fn into_terms(self) -> Terms {
        self.terms.into_inner()
    }

    /// The input of that number.
    #[must_use]
    pub fn input(&self, number: u32, sort: Sort) -> Term {
        self.make(Node::Input(number, sort))
    }

    fn make(&self, node: Node) -> Term {
        self.terms.borrow_mut().make(node)
    }

    fn op(&self, op: Op, operands: &[Term]) -> Term {
        let at = |i: usize| operands.get(i).copied().unwrap_or(operands[0]);
        self.make(Node::Op(op, [at(0), at(1), at(2)]))
    }
}

/// Runs work once for each path through its doors, in the order of their first answer that is no instead of yes.
///
/// # Errors
/// [`ExploreError`] if there is more to it than the budget allows.
pub fn explore<'a, T>(
    space: &'a Space,
    mut work: impl FnMut(Symbolic<'a>) -> T,
) -> Result<Vec<Path<T>>, ExploreError> {
    let mut paths = Vec::new();
    space.given.borrow_mut().clear();
    loop {
        space.path.borrow_mut().clear();
        let result = work(space.machine());
        if space.too_long.get() {
            return Err(ExploreError::Doors(MAX_DOORS));
        }
        let answers = space.path.borrow().clone();
        let mut given: Vec<bool> = answers.iter().map(|answer| answer.any).collect();
        paths.push(Path { answers, result });
        // The next path turns the last yes into a no.
        while given.pop_if(|any| !*any).is_some() {}
        let Some(last) = given.last_mut() else { return Ok(paths) };
        *last = false;
        if paths.len() == MAX_PATHS {
            return Err(ExploreError::Paths(MAX_PATHS));
        }
        *space.given.borrow_mut() = given;
    }
}

/// The bits of a NaN that carries a term: quiet, with a mark that arithmetic does not make by itself.
const TOKEN: u32 = 0x7fd0_0000;
/// The bits of the place.
const PLACE: u32 = 0x000f_ffff;
const SIGN: u32 = 0x8000_0000;

impl Symbolic<'_> {
    /// A term as a plain number, to be spread over lanes again.
    #[must_use]
    pub fn token(self, term: Term) -> f32 {
        f32::from_bits(TOKEN | term.place())
    }

    fn spread(self, x: f32) -> Term {
        let bits = x.to_bits();
        if bits & !PLACE & !SIGN != TOKEN {
            return self.0.make(Node::Number(bits));
        }
        let term = self.0.terms.borrow().at(bits & PLACE).expect("a NaN that carries no term");
        if bits & SIGN == 0 { term } else { self.neg(term) }
    }
}

impl Machine for Symbolic<'_> {
    type F = Term;
    type I = Term;
    type B = Term;
    type Spu = optimized::host::Spu;

    fn spu(self) -> Self::Spu {
        optimized::host::Spu
    }
    /// The first lane is taken for all.
    fn lanes(self, x: [f32; LANES]) -> Term {
        self.spread(x[0])
    }
    /// The first lane is taken for all.
    fn lanes_i(self, x: [i32; LANES]) -> Term {
        self.splat_i(x[0])
    }
    fn to_array(self, x: Term) -> [f32; LANES] {
        [self.token(x); LANES]
    }
    /// Only constants leave.
    fn to_array_i(self, x: Term) -> [i32; LANES] {
        match self.0.terms.borrow().node(x) {
            Node::Integer(x) => [x; LANES],
            other => panic!("an integer leaves by the rim that is not known: {other:?}"),
        }
    }
    /// None leaves.
    fn to_bits(self, x: Term) -> u32 {
        panic!("a truth leaves by the rim: {:?}", self.0.terms.borrow().node(x))
    }
    fn splat(self, x: f32) -> Term {
        self.spread(x)
    }
    fn splat_i(self, x: i32) -> Term {
        self.0.make(Node::Integer(x))
    }
    fn add(self, x: Term, y: Term) -> Term {
        self.0.op(Op::Add, &[x, y])
    }
    fn sub(self, x: Term, y: Term) -> Term {
        self.0.op(Op::Sub, &[x, y])
    }
    fn mul(self, x: Term, y: Term) -> Term {
        self.0.op(Op::Mul, &[x, y])
    }
    fn div(self, x: Term, y: Term) -> Term {
        self.0.op(Op::Div, &[x, y])
    }
    fn sqrt(self, x: Term) -> Term {
        self.0.op(Op::Sqrt, &[x])
    }
    fn lt(self, x: Term, y: Term) -> Term {
        self.0.op(Op::Lt, &[x, y])
    }
    fn le(self, x: Term, y: Term) -> Term {
        self.0.op(Op::Le, &[x, y])
    }
    fn lt_i(self, x: Term, y: Term) -> Term {
        self.0.op(Op::LtI, &[x, y])
    }
    fn and(self, x: Term, y: Term) -> Term {
        self.0.op(Op::And, &[x, y])
    }
    fn or(self, x: Term, y: Term) -> Term {
        self.0.op(Op::Or, &[x, y])
    }
    fn not(self, x: Term) -> Term {
        self.0.op(Op::Not, &[x])
    }
    fn select(self, choose: Term, yes: Term, no: Term) -> Term {
        self.0.op(Op::Select, &[choose, yes, no])
    }
    fn select_i(self, choose: Term, yes: Term, no: Term) -> Term {
        self.0.op(Op::SelectI, &[choose, yes, no])
    }
    fn add_i(self, x: Term, y: Term) -> Term {
        self.0.op(Op::AddI, &[x, y])
    }
    fn or_i(self, x: Term, y: Term) -> Term {
        self.0.op(Op::OrI, &[x, y])
    }
    fn shl_16(self, x: Term) -> Term {
        self.0.op(Op::Shl16, &[x])
    }
    fn shr_16(self, x: Term) -> Term {
        self.0.op(Op::Shr16, &[x])
    }
    fn floor(self, x: Term) -> Term {
        self.0.op(Op::Floor, &[x])
    }
    fn truncate(self, x: Term) -> Term {
        self.0.op(Op::Truncate, &[x])
    }
    /// There are no other lanes to compare with: a kernel that asks is not one that can be proved so.
    fn smallest(self, _: Term) -> Term {
        panic!("the smallest of all lanes is asked for, and there is one")
    }
    /// As [`smallest`](Self::smallest).
    fn largest(self, _: Term) -> Term {
        panic!("the largest of all lanes is asked for, and there is one")
    }
    fn any(self, own: Term, site: Site) -> bool {
        let mut path = self.0.path.borrow_mut();
        if path.len() == MAX_DOORS {
            self.0.too_long.set(true);
            // A loop ends if nobody wants to go on.
            return false;
        }
        // The same question has the same answer if the lanes are alike.
        let before = path.iter().find(|answer| answer.own == own);
        if let (Lanes::Alike, Some(answer)) = (self.0.lanes, before) {
            return answer.any;
        }
        let any = self.0.given.borrow().get(path.len()).copied().unwrap_or(true);
        path.push(Answer { site, own, any });
        any
    }
}
