//! The symbolic machine: one lane or a few, whose values are [`Term`]s. A kernel that runs on it leaves behind what it would do to any
//! values.
//!
//! *Doors.* Where a kernel asks [`Machine::any`], both answers are possible. [`explore`] runs it once for each path: a path is the
//! list of answers given. If other lanes are not there, *no* means no for this lane too, and of *yes* this lane knows
//! nothing ([`Lanes::Any`]). Where all lanes hold the same, as a walk's do, or all that differ are there, as the four planes of a frustum are, *yes*
//! means yes for one of these ([`Lanes::Alike`], [`Lanes::Four`]).
//!
//! *Rim.* A kernel takes some numbers as plain f32 and spreads them. A term passes for one as a NaN that carries its place. Only a change of
//! sign is understood; what plain arithmetic would make of it is lost. Likewise a count passes for a plain i32, of which only one less is
//! understood. This is why each statement is computed from its terms for many inputs and held against the scalar machine before a solver
//! sees it ([`super::theorem`]).

use super::term::{Node, Op, Sort, Term, Terms};
use optimized::machine::{LANES, Machine, Site};
use std::array::from_fn;
use std::cell::{Cell, RefCell};
use thiserror::Error;

/// Which lanes there are, and what is known of the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lanes {
    /// One, and nothing.
    Any,
    /// One, and that they hold the same.
    Alike,
    /// Four, and that they repeat these.
    Four,
}

/// A door, and the answer given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// Where.
    pub site: Site,
    /// What each lane says that is there.
    pub own: Vec<Term>,
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

/// The machine, of `N` lanes.
#[derive(Clone, Copy, Debug)]
pub struct Symbolic<'a, const N: usize>(&'a Space);

/// What a kernel gave on one path.
#[derive(Clone, Debug)]
pub struct Path<T> {
    /// The answers at its doors.
    pub answers: Vec<Answer>,
    /// What it gave.
    pub result: T,
}

impl<T> Path<T> {
    /// What is known on the path: terms, and whether each holds, in one of several cases, of which one is so.
    #[must_use]
    pub fn known(&self, lanes: Lanes) -> Vec<Vec<(Term, bool)>> {
        let mut cases = vec![Vec::new()];
        for answer in &self.answers {
            match (answer.any, lanes) {
                (false, _) => {
                    for case in &mut cases {
                        case.extend(answer.own.iter().map(|own| (*own, false)));
                    }
                }
                (true, Lanes::Any) => {}
                (true, Lanes::Alike | Lanes::Four) => {
                    let mut split = Vec::new();
                    for case in cases {
                        for own in &answer.own {
                            let mut case = case.clone();
                            case.push((*own, true));
                            split.push(case);
                        }
                    }
                    cases = split;
                }
            }
        }
        cases
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
    pub fn machine<const N: usize>(&self) -> Symbolic<'_, N> {
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

    /// That all of these hold.
    #[must_use]
    pub fn all(&self, truths: &[Term]) -> Term {
        let mut all = truths[0];
        for truth in &truths[1..] {
            if *truth != all {
                all = self.make(Node::Op(Op::And, [all, *truth, all]));
            }
        }
        all
    }

    fn make(&self, node: Node) -> Term {
        self.terms.borrow_mut().make(node)
    }
}

/// Runs work once for each path through its doors, in the order of their first answer that is no instead of yes.
///
/// # Errors
/// [`ExploreError`] if there is more to it than the budget allows.
pub fn explore<'a, const N: usize, T>(
    space: &'a Space,
    mut work: impl FnMut(Symbolic<'a, N>) -> T,
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
/// The bits of an i32 that carries a term, above its place and, in the last one, whether it is the count itself or one less.
const COUNT: i32 = 0x5c00_0000;

impl<const N: usize> Symbolic<'_, N> {
    /// A term as a plain number, to be spread over lanes again.
    #[must_use]
    pub fn token(self, term: Term) -> f32 {
        f32::from_bits(TOKEN | term.place())
    }

    /// A count as a plain number, to be spread over lanes again, or one less than it.
    #[must_use]
    pub fn count(self, term: Term) -> i32 {
        COUNT | (term.place() << 1).cast_signed() | 1
    }

    fn integer(self, x: i32) -> Term {
        let bits = (x ^ COUNT).cast_unsigned();
        if bits >> 1 > PLACE {
            return self.0.make(Node::Integer(x));
        }
        let term = self.0.terms.borrow().at(bits >> 1).expect("an integer that carries no term");
        if bits & 1 == 1 {
            return term;
        }
        let less = self.0.make(Node::Integer(-1));
        self.0.make(Node::Op(Op::AddI, [term, less, term]))
    }

    fn term(self, x: f32) -> Term {
        let bits = x.to_bits();
        if bits & !PLACE & !SIGN != TOKEN {
            return self.0.make(Node::Number(bits));
        }
        let term = self.0.terms.borrow().at(bits & PLACE).expect("a NaN that carries no term");
        if bits & SIGN == 0 {
            return term;
        }
        let minus_zero = self.0.make(Node::Number(SIGN));
        self.0.make(Node::Op(Op::Sub, [minus_zero, term, minus_zero]))
    }

    fn one(self, op: Op, x: [Term; N]) -> [Term; N] {
        x.map(|x| self.0.make(Node::Op(op, [x; 3])))
    }

    fn two(self, op: Op, x: [Term; N], y: [Term; N]) -> [Term; N] {
        from_fn(|i| self.0.make(Node::Op(op, [x[i], y[i], x[i]])))
    }

    fn three(self, op: Op, x: [Term; N], y: [Term; N], z: [Term; N]) -> [Term; N] {
        from_fn(|i| self.0.make(Node::Op(op, [x[i], y[i], z[i]])))
    }
}

impl<const N: usize> Machine for Symbolic<'_, N> {
    type F = [Term; N];
    type I = [Term; N];
    type B = [Term; N];
    type Spu = optimized::host::Spu;

    fn spu(self) -> Self::Spu {
        optimized::host::Spu::default()
    }
    /// The first lanes are taken for all.
    fn lanes(self, x: [f32; LANES]) -> [Term; N] {
        from_fn(|i| self.term(x[i]))
    }
    /// The first lanes are taken for all.
    fn lanes_i(self, x: [i32; LANES]) -> [Term; N] {
        from_fn(|i| self.0.make(Node::Integer(x[i])))
    }
    fn to_array(self, x: [Term; N]) -> [f32; LANES] {
        from_fn(|i| self.token(x[i % N]))
    }
    /// Only constants leave.
    fn to_array_i(self, x: [Term; N]) -> [i32; LANES] {
        from_fn(|i| match self.0.terms.borrow().node(x[i % N]) {
            Node::Integer(x) => x,
            other => panic!("an integer leaves by the rim that is not known: {other:?}"),
        })
    }
    /// None leaves.
    fn to_bits(self, x: [Term; N]) -> u32 {
        panic!("a truth leaves by the rim: {:?}", self.0.terms.borrow().node(x[0]))
    }
    fn splat(self, x: f32) -> [Term; N] {
        [self.term(x); N]
    }
    fn splat_i(self, x: i32) -> [Term; N] {
        [self.integer(x); N]
    }
    fn add(self, x: Self::F, y: Self::F) -> Self::F {
        self.two(Op::Add, x, y)
    }
    fn sub(self, x: Self::F, y: Self::F) -> Self::F {
        self.two(Op::Sub, x, y)
    }
    fn mul(self, x: Self::F, y: Self::F) -> Self::F {
        self.two(Op::Mul, x, y)
    }
    fn div(self, x: Self::F, y: Self::F) -> Self::F {
        self.two(Op::Div, x, y)
    }
    fn sqrt(self, x: Self::F) -> Self::F {
        self.one(Op::Sqrt, x)
    }
    fn lt(self, x: Self::F, y: Self::F) -> Self::B {
        self.two(Op::Lt, x, y)
    }
    fn le(self, x: Self::F, y: Self::F) -> Self::B {
        self.two(Op::Le, x, y)
    }
    fn lt_i(self, x: Self::I, y: Self::I) -> Self::B {
        self.two(Op::LtI, x, y)
    }
    fn and(self, x: Self::B, y: Self::B) -> Self::B {
        self.two(Op::And, x, y)
    }
    fn or(self, x: Self::B, y: Self::B) -> Self::B {
        self.two(Op::Or, x, y)
    }
    fn not(self, x: Self::B) -> Self::B {
        self.one(Op::Not, x)
    }
    fn select(self, choose: Self::B, yes: Self::F, no: Self::F) -> Self::F {
        self.three(Op::Select, choose, yes, no)
    }
    fn select_i(self, choose: Self::B, yes: Self::I, no: Self::I) -> Self::I {
        self.three(Op::SelectI, choose, yes, no)
    }
    fn add_i(self, x: Self::I, y: Self::I) -> Self::I {
        self.two(Op::AddI, x, y)
    }
    fn or_i(self, x: Self::I, y: Self::I) -> Self::I {
        self.two(Op::OrI, x, y)
    }
    fn shl_16(self, x: Self::I) -> Self::I {
        self.one(Op::Shl16, x)
    }
    fn shr_16(self, x: Self::I) -> Self::I {
        self.one(Op::Shr16, x)
    }
    fn floor(self, x: Self::F) -> Self::I {
        self.one(Op::Floor, x)
    }
    fn truncate(self, x: Self::F) -> Self::I {
        self.one(Op::Truncate, x)
    }
    /// There may be other lanes: a kernel that asks is not one that can be proved so.
    fn smallest(self, _: Self::F) -> Self::F {
        panic!("the smallest of all lanes is asked for, and not all are there")
    }
    /// As [`smallest`](Self::smallest).
    fn largest(self, _: Self::F) -> Self::F {
        panic!("the largest of all lanes is asked for, and not all are there")
    }
    fn any(self, x: Self::B, site: Site) -> bool {
        let own = x.to_vec();
        let mut path = self.0.path.borrow_mut();
        if path.len() == MAX_DOORS {
            self.0.too_long.set(true);
            // A loop ends if nobody wants to go on.
            return false;
        }
        // The same question has the same answer if no lane is unknown.
        let before = path.iter().find(|answer| answer.own == own).map(|answer| answer.any);
        if let (Lanes::Alike | Lanes::Four, Some(any)) = (self.0.lanes, before) {
            return any;
        }
        let any = self.0.given.borrow().get(path.len()).copied().unwrap_or(true);
        path.push(Answer { site, own, any });
        any
    }
}
