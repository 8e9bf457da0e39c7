//! The prover: a lemma goes in, with solvers and the time there is, and what was found of it comes out.
//!
//! In this order:
//!
//! 1. *Witness.* For the inputs that stand with it all assumptions hold, and all that is concluded: so the assumptions do not
//!    contradict each other.
//! 2. *Agreement.* For many inputs, from every class of bit patterns, the terms say what the scalar machine says.
//! 3. *Proof.* For each path through the kernel's doors a solver finds no inputs that meet the assumptions and not the conclusion. An
//!    answer that does not come in time is no answer.
//! 4. *Faults.* For each operation of the kernel, each way to do it wrong, and each assumption left out, a solver must find inputs for which
//!    the conclusion fails, and it must fail for them on the scalar machine too. What changes nothing stands with the theorem, with the reason.

use super::broken::Fault;
use super::smt::{Numbers, query};
use super::solver::{Reply, Solver};
use super::symbolic::{Answer, Lanes, Path};
use super::term::{Node, Op, Sort, Term};
use super::theorem::{Expected, Explored, Lemma, Statement, Wrong};
use rand::{Rng, RngExt};
use serde::Serialize;
use std::time::{Duration, Instant};

/// What was found about a lemma.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// Its name.
    pub name: &'static str,
    /// What it says.
    pub words: &'static str,
    /// What came of it.
    pub outcome: Outcome,
    /// Who said so.
    pub solvers: Vec<String>,
    /// Seconds that it took, without faults.
    pub seconds: f64,
    /// Paths through the kernel.
    pub paths: usize,
    /// Inputs for which terms and scalar machine were compared.
    pub compared: u64,
    /// Assumptions that were left out, one at a time.
    pub left_out: usize,
    /// Those of them without which it fails; of the others no solver could tell.
    pub needed: usize,
    /// What is wrong with the proof itself; empty if nothing is.
    pub wrong: Vec<String>,
}

/// What was found about the faults of a kernel.
#[derive(Clone, Debug, Serialize)]
pub struct Faults {
    /// The kernel.
    pub kernel: &'static str,
    /// The faults that were tried.
    pub tried: usize,
    /// Those that a lemma noticed, with a counterexample that fails on the scalar machine.
    pub noticed: usize,
    /// Those that change nothing, as is stated.
    pub harmless: usize,
    /// Those of which nothing is known, with the reason: no solver could tell in time, or no counterexample fails on the scalar machine.
    pub open: Vec<String>,
    /// Seconds that it took.
    pub seconds: f64,
    /// What is wrong; empty if nothing is.
    pub wrong: Vec<String>,
}

/// What came of a lemma.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// It holds for all inputs.
    Proved,
    /// It fails for these, on the scalar machine too.
    Refuted(Vec<(&'static str, u32)>),
    /// No solver could tell in time.
    NotShown(String),
    /// There is no solver.
    NotJudged,
}

/// How much time there is.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// For each question about the lemma.
    pub proof: Duration,
    /// For each such question to a further solver, once one has answered.
    pub second: Duration,
    /// For each fault.
    pub fault: Duration,
    /// At most so many faults of a kernel are tried, and one assumption of a lemma is left out, drawn from all; or all, if this is the
    /// largest number.
    pub faults: usize,
}

impl Effort {
    /// What everyday tests have.
    pub const EVERYDAY: Self = Self {
        proof: Duration::from_secs(20),
        second: Duration::ZERO,
        fault: Duration::from_secs(3),
        faults: 6,
    };
    /// What long runs have.
    pub const LONG: Self = Self {
        proof: Duration::from_secs(400),
        second: Duration::from_secs(20),
        fault: Duration::from_secs(30),
        faults: usize::MAX,
    };
}

/// Inputs that are tried where the solver's counterexample is none of the scalar machine's.
const TRIES: u64 = 20_000;

/// What a solver found of a statement.
enum Found {
    Nothing,
    Inputs(Vec<u32>),
    Unknown(String),
}

/// Proves a lemma, or refutes it, and leaves out each of its assumptions.
pub fn prove(lemma: &Lemma, solvers: &[Solver], effort: &Effort, rng: &mut impl Rng) -> Finding {
    let start = Instant::now();
    let mut finding = Finding {
        name: lemma.name,
        words: lemma.words,
        outcome: Outcome::NotJudged,
        solvers: Vec::new(),
        seconds: 0.0,
        paths: 0,
        compared: 0,
        left_out: 0,
        needed: 0,
        wrong: lemma.witnessed(),
    };
    match lemma.statement.on_symbols(lemma.lanes, None) {
        Err(why) => finding.outcome = Outcome::NotShown(why),
        Ok(explored) => {
            finding.paths = explored.paths.len();
            lemma.agree(&explored, rng, &mut finding);
            let known: Vec<&Solver> = lemma.solvers(solvers);
            if !known.is_empty() {
                lemma.judge(&explored, &known, effort, &mut finding);
                if lemma.expected == Expected::Holds {
                    lemma.leave_out_each(&explored, &known, effort, rng, &mut finding);
                }
            }
        }
    }
    finding.seconds = start.elapsed().as_secs_f64();
    finding
}

/// Does each operation of a kernel wrong in each way, or as many of these as there is time for: one of the lemmas about it must notice,
/// and each lemma must notice something.
pub fn break_each(lemmas: &[&Lemma], solvers: &[Solver], effort: &Effort, rng: &mut impl Rng) -> Faults {
    let start = Instant::now();
    let mut faults = Faults {
        kernel: lemmas[0].kernel,
        tried: 0,
        noticed: 0,
        harmless: 0,
        open: Vec::new(),
        seconds: 0.0,
        wrong: Vec::new(),
    };
    let mut left: Vec<Wrong> =
        lemmas[0].faults().into_iter().map(|(at, fault)| Wrong::Operation(at, fault)).collect();
    if lemmas[0].solvers(solvers).is_empty() {
        return faults;
    }
    let harmless = |wrong: &Wrong| {
        let mut all = lemmas.iter().flat_map(|lemma| lemma.harmless);
        all.find(|(known, _)| known == wrong).map(|(_, reason)| *reason)
    };
    for (wrong, _) in lemmas.iter().flat_map(|lemma| lemma.harmless) {
        if !left.contains(wrong) {
            faults.wrong.push(format!("{wrong:?} is said to be harmless, and there is no such fault"));
        }
    }
    while left.len() > effort.faults {
        left.swap_remove(rng.random_range(0..left.len()));
    }
    faults.tried = left.len();
    let mut open: Vec<(Wrong, String)> = Vec::new();
    let mut noticed: Vec<Wrong> = Vec::new();
    for lemma in lemmas {
        let known = lemma.solvers(solvers);
        let mut own = 0;
        // Where all are tried, each lemma must notice one: of those that another has noticed, if of no new one.
        let before = if effort.faults == usize::MAX { noticed.clone() } else { Vec::new() };
        let tried = std::mem::take(&mut left);
        for (wrong, new) in tried.iter().map(|x| (*x, true)).chain(before.iter().map(|x| (*x, false))) {
            if !new && own > 0 {
                break;
            }
            match (lemma.try_fault(wrong, &known, effort, rng), new) {
                (Found::Inputs(values), _) => {
                    own += 1;
                    if new {
                        noticed.push(wrong);
                        if let Some(reason) = harmless(&wrong) {
                            faults.wrong.push(format!("{wrong:?} is not harmless ({reason}): {values:x?}"));
                        }
                    }
                }
                (Found::Nothing, true) => left.push(wrong),
                (Found::Unknown(why), true) => {
                    open.push((wrong, why));
                    left.push(wrong);
                }
                (_, false) => {}
            }
        }
        if own == 0 && faults.tried > 0 && effort.faults == usize::MAX {
            faults.wrong.push(format!("{} notices no fault: the prover may say yes to all", lemma.name));
        }
    }
    for wrong in left {
        match (open.iter().find(|(of, _)| *of == wrong), harmless(&wrong)) {
            (Some((_, why)), _) => faults.open.push(format!("{wrong:?}: {why}")),
            (None, Some(_)) => faults.harmless += 1,
            (None, None) => faults.wrong.push(format!("{wrong:?} is not noticed")),
        }
    }
    faults.noticed = noticed.len();
    faults.seconds = start.elapsed().as_secs_f64();
    faults
}

impl Lemma {
    /// What can be done wrong in its kernel that it could notice.
    #[must_use]
    pub fn faults(&self) -> Vec<(usize, Fault)> {
        let faults =
            self.statement.on_symbols(self.lanes, None).map_or(Vec::new(), |explored| explored.faults);
        let counts = |(_, fault): &(usize, Fault)| self.numbers != Numbers::Free || !fault.of_numbers();
        faults.into_iter().filter(counts).collect()
    }

    /// What is wrong with the witness, if anything is.
    fn witnessed(&self) -> Vec<String> {
        let mut wrong = Vec::new();
        let statement = self.statement.on_scalars(
            &mut |name, _| match self.witness.iter().find(|(known, _)| *known == name) {
                Some((_, bits)) => *bits,
                None => {
                    wrong.push(format!("the witness has no {name}"));
                    0
                }
            },
            None,
        );
        for (words, holds) in &statement.assume {
            if !holds {
                wrong.push(format!("for the witness it does not hold that {words}"));
            }
        }
        if let (Expected::Holds, Some((words, _))) =
            (self.expected, statement.conclude.iter().find(|(_, holds)| !holds))
        {
            wrong.push(format!("for the witness it does not follow that {words}"));
        }
        if statement.conclude.is_empty() {
            wrong.push("nothing is concluded".into());
        }
        wrong
    }

    /// Those that know such numbers, the best first.
    fn solvers<'a>(&self, solvers: &'a [Solver]) -> Vec<&'a Solver> {
        let mut known: Vec<&Solver> = solvers.iter().filter(|solver| solver.knows(self.numbers)).collect();
        // Statements about integers alone are z3's, whose start is the quickest.
        known.sort_by_key(|solver| (solver.name != "z3" || !self.whole, solver.rank(self.numbers)));
        known
    }

    /// Holds terms against the scalar machine.
    fn agree(&self, explored: &Explored, rng: &mut impl Rng, finding: &mut Finding) {
        const CASES: u64 = 500;
        for case in 0..CASES {
            let values = self.some_inputs(explored, case, rng);
            let scalar = self.statement.on_scalars(&mut by_name(explored, &values), None);
            let computed = explored.terms.values(&values);
            let takes = |answer: &Answer| answer.own.iter().any(|own| computed.holds(*own)) == answer.any;
            let mut taken = explored.paths.iter().filter(|path| path.answers.iter().all(takes));
            let (Some(path), None) = (taken.next(), taken.next()) else {
                finding.wrong.push(format!("{values:x?} take not exactly one path"));
                return;
            };
            let sides = [
                (&path.result.assume, &scalar.assume, "assumed"),
                (&path.result.conclude, &scalar.conclude, "concluded"),
            ];
            for (terms, scalars, what) in sides {
                let terms: Vec<_> =
                    terms.iter().map(|(words, term)| (*words, computed.holds(*term))).collect();
                if terms != *scalars {
                    finding.wrong.push(format!(
                        "{what} of {values:x?}: terms say {terms:?}, the scalar machine {scalars:?}"
                    ));
                    return;
                }
            }
            finding.compared += 1;
        }
    }

    /// Asks the solvers whether the lemma fails for any inputs.
    fn judge(&self, explored: &Explored, solvers: &[&Solver], effort: &Effort, finding: &mut Finding) {
        let mut said = Vec::new();
        for solver in solvers {
            let first = said.iter().all(|(_, outcome)| matches!(outcome, Outcome::NotShown(_)));
            let limit = if first { effort.proof } else { effort.second };
            if limit.is_zero() {
                break;
            }
            let found = match self.stepwise(explored, solver, limit) {
                Err(why) => Found::Unknown(why),
                Ok(()) => self.fails(explored, std::slice::from_ref(solver), None, true, self.lanes, limit),
            };
            let outcome = match found {
                Found::Unknown(why) => Outcome::NotShown(why),
                Found::Nothing => Outcome::Proved,
                Found::Inputs(values) => match self.replay(explored, &values) {
                    Ok(inputs) => Outcome::Refuted(inputs),
                    Err(why) => Outcome::NotShown(why),
                },
            };
            said.push((*solver, outcome));
        }
        let told = |outcome: &Outcome| !matches!(outcome, Outcome::NotShown(_));
        let proved = said.iter().any(|(_, outcome)| *outcome == Outcome::Proved);
        let refuted = said.iter().any(|(_, outcome)| matches!(outcome, Outcome::Refuted(_)));
        if proved && refuted {
            finding.wrong.push(format!("solvers disagree: {said:?}"));
        }
        let decided = said.iter().filter(|(_, outcome)| told(outcome));
        finding.solvers = decided.map(|(solver, _)| format!("{} {}", solver.name, solver.version)).collect();
        // A counterexample that replays is worth more than any proof.
        let best = said.iter().position(|(_, outcome)| matches!(outcome, Outcome::Refuted(_)));
        let best = best.or_else(|| said.iter().position(|(_, outcome)| told(outcome))).unwrap_or(0);
        if let Some((_, outcome)) = said.into_iter().nth(best) {
            finding.outcome = outcome;
        }
        let as_expected = match finding.outcome {
            Outcome::Proved => self.expected == Expected::Holds,
            Outcome::Refuted(_) => self.expected == Expected::Fails,
            Outcome::NotShown(_) | Outcome::NotJudged => true,
        };
        if !as_expected {
            finding.wrong.push(format!("expected: {:?}; found: {:?}", self.expected, finding.outcome));
        }
    }

    /// Leaves out each assumption, or one that is drawn if there is no time for all: the lemma must fail then.
    fn leave_out_each(
        &self,
        explored: &Explored,
        solvers: &[&Solver],
        effort: &Effort,
        rng: &mut impl Rng,
        finding: &mut Finding,
    ) {
        let assume = &explored.paths[0].result.assume;
        let drawn = rng.random_range(0..assume.len().max(1));
        for (i, (words, _)) in assume.iter().enumerate() {
            if i != drawn && effort.faults < usize::MAX {
                continue;
            }
            finding.left_out += 1;
            match self.try_fault(Wrong::Assumption(i), solvers, effort, rng) {
                Found::Inputs(_) => finding.needed += 1,
                Found::Unknown(_) => {}
                Found::Nothing => finding.wrong.push(format!("it is not needed that {words}")),
            }
        }
    }

    /// What a solver finds of the lemma with something done wrong; only inputs that fail on the scalar machine too count.
    fn try_fault(&self, wrong: Wrong, solvers: &[&Solver], effort: &Effort, rng: &mut impl Rng) -> Found {
        let (fault, left_out) = match wrong {
            Wrong::Operation(at, fault) => (Some((at, fault)), None),
            Wrong::Assumption(i) => (None, Some(i)),
        };
        // With no lane unknown, so that the counterexample can be replayed.
        let lanes = if self.lanes == Lanes::Any { Lanes::Alike } else { self.lanes };
        let explored = match self.statement.on_symbols(lanes, fault) {
            Ok(explored) => explored,
            Err(why) => return Found::Unknown(why),
        };
        // A step is used if it still follows.
        let follows = |solver: &&Solver| self.stepwise(&explored, solver, effort.fault).is_ok();
        let steps = left_out.is_none() && solvers.iter().any(follows);
        match self.fails(&explored, solvers, left_out, steps, lanes, effort.fault) {
            Found::Inputs(values) if self.fails_for(&explored, &values, fault, left_out) => {
                Found::Inputs(values)
            }
            // What the solver took for the result of an operation may be no result; then some are tried that are.
            Found::Inputs(_) => (0..TRIES)
                .map(|case| self.some_inputs(&explored, case, rng))
                .find(|values| self.fails_for(&explored, values, fault, left_out))
                .map_or(
                    Found::Unknown("no counterexample fails on the scalar machine".into()),
                    Found::Inputs,
                ),
            other => other,
        }
    }

    /// Whether the lemma, with something done wrong, fails for these inputs on the scalar machine.
    fn fails_for(
        &self,
        explored: &Explored,
        values: &[u32],
        fault: Option<(usize, Fault)>,
        left_out: Option<usize>,
    ) -> bool {
        let statement = self.statement.on_scalars(&mut by_name(explored, values), fault);
        let mut kept = statement.assume.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
        kept.all(|(_, (_, holds))| *holds) && statement.conclude.iter().any(|(_, holds)| !holds)
    }

    /// Inputs near the witness, where assumptions may hold, or anywhere.
    fn some_inputs(&self, explored: &Explored, case: u64, rng: &mut impl Rng) -> Vec<u32> {
        let mut one = |(name, sort): &(&'static str, Sort)| {
            let witness = self.witness.iter().find(|(known, _)| known == name).map(|(_, bits)| *bits);
            let any = any_bits(*sort, rng);
            match (witness, case % 3) {
                (Some(bits), 0) => bits.wrapping_add(rng.random_range(0..3)),
                (Some(bits), 1) if rng.random_range(0..4) > 0 => bits,
                _ => any,
            }
        };
        explored.inputs.iter().map(&mut one).collect()
    }

    /// Asks for inputs that meet the assumptions, but for one, and the steps if they are given, and not the conclusion.
    fn fails(
        &self,
        explored: &Explored,
        solvers: &[&Solver],
        left_out: Option<usize>,
        with_steps: bool,
        lanes: Lanes,
        limit: Duration,
    ) -> Found {
        let sorts: Vec<Sort> = explored.inputs.iter().map(|(_, sort)| *sort).collect();
        let mut terms = explored.terms.clone();
        let mut unknown = None;
        for path in &explored.paths {
            let Statement { assume, steps, conclude } = &path.result;
            let mut all = conclude[0].1;
            for (_, conclusion) in &conclude[1..] {
                all = terms.make(Node::Op(Op::And, [all, *conclusion, all]));
            }
            let kept = assume.iter().enumerate().filter(|(i, _)| Some(*i) != left_out);
            let mut given: Vec<(Term, bool)> = kept.map(|(_, (_, term))| (*term, true)).collect();
            if with_steps {
                given.extend(steps.iter().map(|(_, step)| (*step, true)));
            }
            for mut wanted in path.known(lanes) {
                wanted.extend(&given);
                wanted.push((all, false));
                let text = match query(&terms, self.numbers, &sorts, &wanted) {
                    Ok(text) => text,
                    Err(error) => return Found::Unknown(error.to_string()),
                };
                match ask_each(solvers, &text, &sorts, limit) {
                    Found::Nothing => {}
                    Found::Unknown(why) => unknown = unknown.or(Some(why)),
                    found @ Found::Inputs(_) => return found,
                }
            }
        }
        unknown.map_or(Found::Nothing, Found::Unknown)
    }

    /// Shows each step from the assumptions and the steps before it; says which cannot be shown.
    fn stepwise(&self, explored: &Explored, solver: &Solver, limit: Duration) -> Result<(), String> {
        let sorts: Vec<Sort> = explored.inputs.iter().map(|(_, sort)| *sort).collect();
        let Statement { assume, steps, .. } = &explored.paths[0].result;
        if !steps.is_empty() {
            let same =
                |path: &Path<Statement<Term>>| (&path.result.assume, &path.result.steps) == (assume, steps);
            if !explored.paths.iter().all(same) {
                return Err("a step depends on the path".into());
            }
        }
        let mut given: Vec<(Term, bool)> = assume.iter().map(|(_, term)| (*term, true)).collect();
        for (words, step) in steps {
            for lane in explored.terms.conjuncts(*step) {
                let mut wanted = given.clone();
                wanted.push((lane, false));
                let text = query(&explored.terms, self.numbers, &sorts, &wanted);
                let text = text.map_err(|error| error.to_string())?;
                match solver.ask(&text, &sorts, limit) {
                    Reply::Unsat => {}
                    other => return Err(format!("the step that {words}: {other:?}")),
                }
            }
            given.push((*step, true));
        }
        Ok(())
    }

    /// The inputs by name, if the lemma fails for them on the scalar machine.
    fn replay(&self, explored: &Explored, values: &[u32]) -> Result<Vec<(&'static str, u32)>, String> {
        let inputs: Vec<_> =
            explored.inputs.iter().map(|(name, _)| *name).zip(values.iter().copied()).collect();
        if self.fails_for(explored, values, None, None) {
            Ok(inputs)
        } else {
            Err(format!("a counterexample that does not fail on the scalar machine: {inputs:x?}"))
        }
    }

    /// The text that the solver gets for the first conclusion of the first path.
    ///
    /// # Errors
    /// A sentence that says why there is none.
    pub fn text(&self) -> Result<String, String> {
        let explored = self.statement.on_symbols(self.lanes, None)?;
        let sorts: Vec<Sort> = explored.inputs.iter().map(|(_, sort)| *sort).collect();
        let path = explored.paths.first().ok_or("there is no path")?;
        let (_, conclusion) = path.result.conclude.first().ok_or("nothing is concluded")?;
        let mut wanted = path.known(self.lanes).swap_remove(0);
        wanted.extend(path.result.assume.iter().map(|(_, term)| (*term, true)));
        wanted.push((*conclusion, false));
        let mut text = String::new();
        for (i, (name, _)) in explored.inputs.iter().enumerate() {
            text += &format!("; in{i} is {name}\n");
        }
        query(&explored.terms, self.numbers, &sorts, &wanted)
            .map(|query| text + &query)
            .map_err(|error| error.to_string())
    }
}

/// Asks one solver after the other, until one knows.
fn ask_each(solvers: &[&Solver], text: &str, sorts: &[Sort], limit: Duration) -> Found {
    let mut unknown = "there is no solver".to_owned();
    for solver in solvers {
        match solver.ask(text, sorts, limit) {
            Reply::Unsat => return Found::Nothing,
            Reply::Sat(Some(values)) => return Found::Inputs(values),
            Reply::Sat(None) => unknown = format!("{}: sat, without values that can be read", solver.name),
            Reply::Unknown(said) => unknown = format!("{}: {said}", solver.name),
        }
    }
    Found::Unknown(unknown)
}

/// Bits by the name of the input.
fn by_name<'a>(explored: &'a Explored, values: &'a [u32]) -> impl FnMut(&'static str, Sort) -> u32 + use<'a> {
    |name, _| {
        let at = explored.inputs.iter().position(|(known, _)| *known == name);
        at.map_or(0, |at| values[at])
    }
}

/// A pattern of any class.
pub fn any_bits(sort: Sort, rng: &mut impl Rng) -> u32 {
    match sort {
        Sort::Truth => rng.random_range(0..2),
        Sort::Integer => match rng.random_range(0..4) {
            0 => rng.random(),
            1 => [0, 1, 2, u32::MAX, 1 << 31, i32::MAX.cast_unsigned(), 0xffff, 0x1_0000]
                [rng.random_range(0..8)],
            _ => rng.random_range(0..20),
        },
        Sort::Number => {
            let sign = rng.random::<u32>() & 1 << 31;
            let exponent = match rng.random_range(0..4) {
                0 => [0, 1, 254, 255][rng.random_range(0..4)],
                1 => rng.random_range(0..256),
                _ => rng.random_range(120..136),
            };
            let fraction = match rng.random_range(0..3) {
                0 => [0, 1, 0x40_0000, 0x7f_ffff][rng.random_range(0..4)],
                _ => rng.random_range(0..1 << 23),
            };
            // No NaN may pass for a term.
            if exponent == 255 && fraction != 0 { 0x7fc0_0000 } else { sign | exponent << 23 | fraction }
        }
    }
}
