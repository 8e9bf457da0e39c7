//! Theorems: what is claimed of a kernel, written once as a function of a machine. On symbols it becomes what the solver gets; on the
//! scalar machine it takes the witness, and every counterexample; on a [`Broken`] machine it is the fault under the prover.
//!
//! [`super::prover`] proves them.

use super::broken::{Breaker, Broken, Fault};
use super::smt::Numbers;
use super::symbolic::{Lanes, Path, Space, Symbolic, explore};
use super::term::{Sort, Term, Terms};
use optimized::host::Scalar;
use optimized::machine::{LANES, Machine};

/// Where a statement's inputs come from. One name is one input.
pub trait Ask<M: Machine> {
    /// Any f32.
    fn number(&mut self, name: &'static str) -> M::F;
    /// Any i32.
    fn integer(&mut self, name: &'static str) -> M::I;
    /// Any f32, as a plain number for kernels that spread it themselves.
    fn plain(&mut self, name: &'static str) -> f32;
    /// Any i32 above 0, as a plain number likewise; what is not above 0 counts as 1.
    fn count(&mut self, name: &'static str) -> i32;
}

/// What is assumed, and what follows.
#[derive(Clone, Debug)]
pub struct Statement<B> {
    /// Assumptions, each with its words.
    pub assume: Vec<(&'static str, B)>,
    /// What is shown on the way, each from the assumptions and those before it, and may be used then. Nothing of the kernel is in it.
    pub steps: Vec<(&'static str, B)>,
    /// Conclusions.
    pub conclude: Vec<(&'static str, B)>,
}

/// A statement about a kernel.
pub trait Theorem: Send + Sync {
    /// The statement: it is made with `m`, and the kernel runs on `kernel`, which may be broken.
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B>;
}

/// What is to come out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// It holds for all inputs.
    Holds,
    /// It does not.
    Fails,
}

/// Something done wrong that is to be found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrong {
    /// The operation of that number, in the order of execution.
    Operation(usize, Fault),
    /// The assumption of that number is left out.
    Assumption(usize),
}

/// A theorem with what stands beside it.
pub struct Lemma {
    /// Its name: `walk.successor`.
    pub name: &'static str,
    /// What it says, in a sentence.
    pub words: &'static str,
    /// What numbers are to the solver.
    pub numbers: Numbers,
    /// Whether it is about integers alone.
    pub whole: bool,
    /// What is known of other lanes.
    pub lanes: Lanes,
    /// What is to come out.
    pub expected: Expected,
    /// Whether it takes longer than everyday tests have.
    pub long: bool,
    /// The kernel it is about. All lemmas about one execute the same operations.
    pub kernel: &'static str,
    /// Inputs for which the assumptions hold.
    pub witness: &'static [(&'static str, u32)],
    /// What is done wrong and changes nothing, with the reason.
    pub harmless: &'static [(Wrong, &'static str)],
    /// The statement.
    pub statement: Box<dyn Provable>,
}
/// A theorem without its type.
pub trait Provable: Send + Sync {
    /// What it is in terms.
    ///
    /// # Errors
    /// A sentence that says why it cannot be explored.
    fn on_symbols(&self, lanes: Lanes, wrong: Option<(usize, Fault)>) -> Result<Explored, String>;

    /// What it is for given inputs.
    fn on_scalars(
        &self,
        value: &mut dyn FnMut(&'static str, Sort) -> u32,
        wrong: Option<(usize, Fault)>,
    ) -> Statement<bool>;
}

/// A statement in terms.
#[derive(Debug)]
pub struct Explored {
    /// The terms.
    pub terms: Terms,
    /// Names and sorts of the inputs.
    pub inputs: Vec<(&'static str, Sort)>,
    /// The paths.
    pub paths: Vec<Path<Statement<Term>>>,
    /// What could be done wrong.
    pub faults: Vec<(usize, Fault)>,
}

/// Inputs of terms, numbered as they are first asked for.
struct Symbols<'a> {
    space: &'a Space,
    inputs: &'a mut Vec<(&'static str, Sort)>,
}

impl Symbols<'_> {
    fn input(&mut self, name: &'static str, sort: Sort) -> Term {
        let number = self.inputs.iter().position(|(known, _)| *known == name).unwrap_or_else(|| {
            self.inputs.push((name, sort));
            self.inputs.len() - 1
        });
        assert_eq!(self.inputs[number].1, sort, "the input {name}");
        self.space.input(u32::try_from(number).expect("few inputs"), sort)
    }
}

impl<'a, const N: usize> Ask<Symbolic<'a, N>> for Symbols<'_> {
    fn number(&mut self, name: &'static str) -> [Term; N] {
        [self.input(name, Sort::Number); N]
    }
    fn integer(&mut self, name: &'static str) -> [Term; N] {
        [self.input(name, Sort::Integer); N]
    }
    fn plain(&mut self, name: &'static str) -> f32 {
        let term = self.input(name, Sort::Number);
        self.space.machine::<N>().token(term)
    }
    fn count(&mut self, name: &'static str) -> i32 {
        let (machine, given) = (self.space.machine::<N>(), [self.input(name, Sort::Integer); N]);
        let one = machine.splat_i(1);
        machine.count(machine.select_i(machine.lt_i(given, one), one, given)[0])
    }
}

/// Inputs of which the bits are told.
struct Told<'a>(&'a mut dyn FnMut(&'static str, Sort) -> u32);

impl Ask<Scalar> for Told<'_> {
    fn number(&mut self, name: &'static str) -> [f32; LANES] {
        [f32::from_bits((self.0)(name, Sort::Number)); LANES]
    }
    fn integer(&mut self, name: &'static str) -> [i32; LANES] {
        [(self.0)(name, Sort::Integer).cast_signed(); LANES]
    }
    fn plain(&mut self, name: &'static str) -> f32 {
        f32::from_bits((self.0)(name, Sort::Number))
    }
    fn count(&mut self, name: &'static str) -> i32 {
        (self.0)(name, Sort::Integer).cast_signed().max(1)
    }
}

fn on_symbols<const N: usize>(
    theorem: &impl Theorem,
    lanes: Lanes,
    wrong: Option<(usize, Fault)>,
) -> Result<Explored, String> {
    let (space, breaker, mut inputs) = (Space::new(lanes), Breaker::new(wrong), Vec::new());
    let paths = explore(&space, |machine: Symbolic<'_, N>| {
        breaker.restart();
        let mut ask = Symbols { space: &space, inputs: &mut inputs };
        let statement = theorem.state(machine, Broken { machine, breaker: &breaker }, &mut ask);
        statement.map(|lanes| space.all(&lanes))
    });
    let paths = paths.map_err(|error| error.to_string())?;
    Ok(Explored { terms: space.into_terms(), inputs, paths, faults: breaker.met() })
}

impl<T: Theorem> Provable for T {
    fn on_symbols(&self, lanes: Lanes, wrong: Option<(usize, Fault)>) -> Result<Explored, String> {
        match lanes {
            Lanes::Any | Lanes::Alike => on_symbols::<1>(self, lanes, wrong),
            Lanes::Four => on_symbols::<4>(self, lanes, wrong),
        }
    }

    fn on_scalars(
        &self,
        value: &mut dyn FnMut(&'static str, Sort) -> u32,
        wrong: Option<(usize, Fault)>,
    ) -> Statement<bool> {
        let breaker = Breaker::new(wrong);
        let kernel = Broken { machine: Scalar, breaker: &breaker };
        self.state(Scalar, kernel, &mut Told(value)).map(|lanes| lanes.iter().all(|holds| *holds))
    }
}

impl<B> Statement<B> {
    fn map<C>(self, mut each: impl FnMut(B) -> C) -> Statement<C> {
        let mut all =
            |said: Vec<(&'static str, B)>| said.into_iter().map(|(words, x)| (words, each(x))).collect();
        Statement { assume: all(self.assume), steps: all(self.steps), conclude: all(self.conclude) }
    }
}
impl std::fmt::Debug for Lemma {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Lemma").field("name", &self.name).field("words", &self.words).finish_non_exhaustive()
    }
}
