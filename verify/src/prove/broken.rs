//! A machine that does one operation wrong: the fault under the prover. The kernel is the shipped one; the fault lies in what
//! executes it, on symbols and on the scalar machine alike, so that a counterexample found on the one can be replayed on the other.
//! Where a statement calls a kernel more than once, it notes a stage before each call, and the same operation of each is done wrong.

use optimized::machine::{LANES, Machine, Site, Stage};
use std::cell::{Cell, RefCell};

/// What can be wrong with an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fault {
    /// `select` and `select_i` take the other.
    OtherArm,
    /// x < y becomes x <= y, and x <= y becomes x < y.
    Border,
    /// x < y becomes y < x, and so on.
    Swapped,
    /// *And* becomes *or*, and *or* becomes *and*.
    OtherJoin,
    /// *Not* or a shift does nothing.
    Nothing,
    /// The second operand of an addition or an *or* of integers is left out.
    FirstAlone,
    /// x + y becomes x − y, and x − y becomes x + y.
    OtherSign,
    /// The second operand of an operation of numbers is left out.
    FirstNumber,
    /// A root does nothing.
    NoRoot,
    /// An integer constant is one more.
    OneMore,
    /// Floor becomes truncation, and truncation becomes floor.
    OtherWhole,
}

impl Fault {
    /// Whether it is one of the results of numbers, which a statement about any results cannot notice.
    #[must_use]
    pub fn of_numbers(self) -> bool {
        matches!(self, Self::OtherSign | Self::FirstNumber | Self::NoRoot)
    }
}

/// Counts operations and does the one of a number wrong.
#[derive(Debug, Default)]
pub struct Breaker {
    at: Cell<usize>,
    fault: Cell<Option<(usize, Fault)>>,
    /// What could be done wrong, if nothing was.
    met: RefCell<Vec<(usize, Fault)>>,
}

impl Breaker {
    /// Does that wrong, or nothing.
    #[must_use]
    pub fn new(fault: Option<(usize, Fault)>) -> Self {
        Self { fault: Cell::new(fault), ..Self::default() }
    }

    /// Begins to count anew, for another run.
    pub fn restart(&self) {
        self.at.set(0);
    }

    /// Every fault there was occasion for, by the number of the operation.
    #[must_use]
    pub fn met(&self) -> Vec<(usize, Fault)> {
        let mut met = self.met.borrow().clone();
        met.sort_by_key(|(at, _)| *at);
        met.dedup();
        met
    }

    /// The next operation, which can have those faults: the one that it has.
    fn next(&self, faults: &[Fault]) -> Option<Fault> {
        let at = self.at.replace(self.at.get() + 1);
        let mut met = self.met.borrow_mut();
        for &fault in faults {
            if !met.contains(&(at, fault)) {
                met.push((at, fault));
            }
        }
        self.fault
            .get()
            .filter(|(place, fault)| *place == at && faults.contains(fault))
            .map(|(_, fault)| fault)
    }
}

/// The machine, beside one that does all else.
#[derive(Clone, Copy, Debug)]
pub struct Broken<'a, M> {
    /// Who does it right.
    pub machine: M,
    /// What is done wrong.
    pub breaker: &'a Breaker,
}

impl<M: Machine> Machine for Broken<'_, M> {
    type F = M::F;
    type I = M::I;
    type B = M::B;
    type Spu = M::Spu;

    fn spu(self) -> M::Spu {
        self.machine.spu()
    }
    /// A call of the kernel begins: its operations are counted anew.
    fn stage(self, _: Stage) {
        self.breaker.restart();
    }
    fn lanes(self, x: [f32; LANES]) -> M::F {
        self.machine.lanes(x)
    }
    fn lanes_i(self, x: [i32; LANES]) -> M::I {
        self.machine.lanes_i(x)
    }
    fn to_array(self, x: M::F) -> [f32; LANES] {
        self.machine.to_array(x)
    }
    fn to_array_i(self, x: M::I) -> [i32; LANES] {
        self.machine.to_array_i(x)
    }
    fn to_bits(self, x: M::B) -> u32 {
        self.machine.to_bits(x)
    }
    fn splat(self, x: f32) -> M::F {
        self.machine.splat(x)
    }
    fn splat_i(self, x: i32) -> M::I {
        match self.breaker.next(&[Fault::OneMore]) {
            Some(_) => self.machine.splat_i(x.wrapping_add(1)),
            None => self.machine.splat_i(x),
        }
    }
    fn add(self, x: M::F, y: M::F) -> M::F {
        match self.breaker.next(&[Fault::OtherSign, Fault::FirstNumber]) {
            Some(Fault::FirstNumber) => x,
            Some(_) => self.machine.sub(x, y),
            None => self.machine.add(x, y),
        }
    }
    fn sub(self, x: M::F, y: M::F) -> M::F {
        match self.breaker.next(&[Fault::OtherSign, Fault::FirstNumber]) {
            Some(Fault::FirstNumber) => x,
            Some(_) => self.machine.add(x, y),
            None => self.machine.sub(x, y),
        }
    }
    fn mul(self, x: M::F, y: M::F) -> M::F {
        match self.breaker.next(&[Fault::FirstNumber]) {
            Some(_) => x,
            None => self.machine.mul(x, y),
        }
    }
    fn div(self, x: M::F, y: M::F) -> M::F {
        match self.breaker.next(&[Fault::FirstNumber]) {
            Some(_) => x,
            None => self.machine.div(x, y),
        }
    }
    fn sqrt(self, x: M::F) -> M::F {
        match self.breaker.next(&[Fault::NoRoot]) {
            Some(_) => x,
            None => self.machine.sqrt(x),
        }
    }
    fn lt(self, x: M::F, y: M::F) -> M::B {
        match self.breaker.next(&[Fault::Border, Fault::Swapped]) {
            Some(Fault::Border) => self.machine.le(x, y),
            Some(_) => self.machine.lt(y, x),
            None => self.machine.lt(x, y),
        }
    }
    fn le(self, x: M::F, y: M::F) -> M::B {
        match self.breaker.next(&[Fault::Border, Fault::Swapped]) {
            Some(Fault::Border) => self.machine.lt(x, y),
            Some(_) => self.machine.le(y, x),
            None => self.machine.le(x, y),
        }
    }
    fn lt_i(self, x: M::I, y: M::I) -> M::B {
        match self.breaker.next(&[Fault::Border, Fault::Swapped]) {
            Some(Fault::Border) => self.machine.not(self.machine.lt_i(y, x)),
            Some(_) => self.machine.lt_i(y, x),
            None => self.machine.lt_i(x, y),
        }
    }
    fn and(self, x: M::B, y: M::B) -> M::B {
        match self.breaker.next(&[Fault::OtherJoin]) {
            Some(_) => self.machine.or(x, y),
            None => self.machine.and(x, y),
        }
    }
    fn or(self, x: M::B, y: M::B) -> M::B {
        match self.breaker.next(&[Fault::OtherJoin]) {
            Some(_) => self.machine.and(x, y),
            None => self.machine.or(x, y),
        }
    }
    fn not(self, x: M::B) -> M::B {
        match self.breaker.next(&[Fault::Nothing]) {
            Some(_) => x,
            None => self.machine.not(x),
        }
    }
    fn select(self, choose: M::B, yes: M::F, no: M::F) -> M::F {
        match self.breaker.next(&[Fault::OtherArm]) {
            Some(_) => self.machine.select(choose, no, yes),
            None => self.machine.select(choose, yes, no),
        }
    }
    fn select_i(self, choose: M::B, yes: M::I, no: M::I) -> M::I {
        match self.breaker.next(&[Fault::OtherArm]) {
            Some(_) => self.machine.select_i(choose, no, yes),
            None => self.machine.select_i(choose, yes, no),
        }
    }
    fn add_i(self, x: M::I, y: M::I) -> M::I {
        match self.breaker.next(&[Fault::FirstAlone]) {
            Some(_) => x,
            None => self.machine.add_i(x, y),
        }
    }
    fn or_i(self, x: M::I, y: M::I) -> M::I {
        match self.breaker.next(&[Fault::FirstAlone]) {
            Some(_) => x,
            None => self.machine.or_i(x, y),
        }
    }
    fn shl_16(self, x: M::I) -> M::I {
        match self.breaker.next(&[Fault::Nothing]) {
            Some(_) => x,
            None => self.machine.shl_16(x),
        }
    }
    fn shr_16(self, x: M::I) -> M::I {
        match self.breaker.next(&[Fault::Nothing]) {
            Some(_) => x,
            None => self.machine.shr_16(x),
        }
    }
    fn floor(self, x: M::F) -> M::I {
        match self.breaker.next(&[Fault::OtherWhole]) {
            Some(_) => self.machine.truncate(x),
            None => self.machine.floor(x),
        }
    }
    fn truncate(self, x: M::F) -> M::I {
        match self.breaker.next(&[Fault::OtherWhole]) {
            Some(_) => self.machine.floor(x),
            None => self.machine.truncate(x),
        }
    }
    fn smallest(self, x: M::F) -> M::F {
        self.machine.smallest(x)
    }
    fn largest(self, x: M::F) -> M::F {
        self.machine.largest(x)
    }
    fn any(self, x: M::B, site: Site) -> bool {
        self.machine.any(x, site)
    }
}
