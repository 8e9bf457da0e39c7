//! Do the proofs hold, and would the prover notice if they did not?
//!
//! Everyday: all lemmas but those that take long, and six of each kernel's faults, drawn afresh. `CGT_LONG=1`: all of both, and every solver is asked.

use optimized::host::Scalar;
use optimized::machine::{LANES, Machine, Site};
use rand::RngExt;
use std::os::unix::fs::PermissionsExt;
use std::time::Duration;
use verify::prove::claims::{CLAIMS, lemmas};
use verify::prove::prover::{Effort, Outcome, any_bits, break_each, prove};
use verify::prove::run::{kernels, run};
use verify::prove::smt::{Numbers, query};
use verify::prove::solver::{Reply, Solver};
use verify::prove::symbolic::{ExploreError, Lanes, MAX_DOORS, Space, Symbolic, explore};
use verify::prove::term::{Node, Op, Sort, Term, Terms};
use verify::prove::theorem::{Ask, Expected, Explored, Lemma, Provable, Statement, Theorem};
use verify::report::Evidence;
use verify::seed::{generator, seed};

/// The solvers that are there; none is told.
fn solvers() -> Vec<Solver> {
    let solvers = Solver::all();
    match solvers.as_slice() {
        [] => eprintln!("not judged: proofs: no solver was found; tests/fetch-solvers brings two"),
        found => {
            let names: Vec<String> = found.iter().map(|s| format!("{} {}", s.name, s.version)).collect();
            eprintln!("judged by {}", names.join(", "));
        }
    }
    solvers
}

#[test]
fn lemmas_are_proved() {
    let (solvers, seed) = (solvers(), seed());
    let long = std::env::var_os("CGT_LONG").is_some();
    let proofs = run(|_| true, long, &solvers, seed, &|| ());
    eprintln!("{proofs}");
    assert!(proofs.wrong().is_empty(), "CGT_SEED={seed}: {:#?}", proofs.wrong());
    if solvers.len() > 1 {
        assert!(proofs.not_shown().is_empty(), "not shown: {:#?}", proofs.not_shown());
    } else if !solvers.is_empty() {
        for why in proofs.not_shown() {
            eprintln!("not judged: {why}");
        }
    }
    let tried: usize = proofs.faults.iter().map(|faults| faults.tried).sum();
    assert_eq!(proofs.faults.len(), kernels(&lemmas()).len(), "kernels");
    // What no solver decides has not been noticed, whether an operation was done wrong or an assumption left out.
    let decided: usize = proofs.faults.iter().map(|faults| faults.noticed + faults.harmless).sum();
    let open: Vec<&String> = proofs.faults.iter().flat_map(|faults| &faults.open).collect();
    let left_out: usize = proofs.lemmas.iter().map(|lemma| lemma.left_out).sum();
    let needed: usize = proofs.lemmas.iter().map(|lemma| lemma.needed).sum();
    eprintln!("{decided} of {tried} faults decided, {needed} of {left_out} assumptions left out were needed");
    assert!(10 * decided >= 9 * tried, "{decided} of {tried}: {open:#?}");
    assert!(10 * needed >= 9 * left_out, "{needed} of {left_out} assumptions");
    // One solver alone may know some kinds of numbers only, and is not asked about others.
    if solvers.len() > 1 {
        assert!(tried >= Effort::EVERYDAY.faults * proofs.faults.len() - 5, "only {tried} faults were tried");
        assert!(left_out >= 50, "only {left_out} assumptions were left out");
    } else if !solvers.is_empty() {
        eprintln!("not judged: whether enough was tried: it takes two solvers");
    }
}

/// Each lemma belongs to a claim, and no claim names one that is not there.
#[test]
fn claims_and_lemmas_belong_together() {
    let lemmas = lemmas();
    let mut names: Vec<&str> = lemmas.iter().map(|lemma| lemma.name).collect();
    for claim in CLAIMS {
        for name in claim.lemmas {
            assert!(names.contains(name), "{name}, of: {}", claim.statement);
        }
        // What is called proved is so by all of them, what is refuted by one at least.
        let of = lemmas.iter().filter(|lemma| claim.lemmas.contains(&lemma.name));
        let fails = of.filter(|lemma| lemma.expected == Expected::Fails).count();
        assert_eq!(fails > 0, claim.evidence == Evidence::Refuted, "{}", claim.statement);
        assert!(fails > 0 || claim.evidence == Evidence::Proved, "{}", claim.statement);
    }
    let claimed = |name: &str| CLAIMS.iter().any(|claim| claim.lemmas.contains(&name));
    assert_eq!(names.iter().find(|name| !claimed(name)), None, "belongs to no claim");
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), lemmas.len(), "a name stands twice");
}

/// The lemma with a statement beside it that contradicts one of its assumptions.
struct Contradicted(Box<dyn Provable>, usize);

impl Provable for Contradicted {
    fn on_symbols(
        &self,
        lanes: Lanes,
        wrong: Option<(usize, verify::prove::broken::Fault)>,
    ) -> Result<Explored, String> {
        self.0.on_symbols(lanes, wrong)
    }

    fn on_scalars(
        &self,
        value: &mut dyn FnMut(&'static str, Sort) -> u32,
        wrong: Option<(usize, verify::prove::broken::Fault)>,
    ) -> Statement<bool> {
        let mut statement = self.0.on_scalars(value, wrong);
        let (_, holds) = statement.assume[self.1];
        statement.assume.push(("the opposite", !holds));
        statement
    }
}

#[test]
fn witnesses_are_needed_and_contradictions_noticed() {
    let mut rng = generator(seed(), 1);
    let (mut judged, mut contradicted) = (0, 0);
    for i in 0..lemmas().len() {
        let lemma = lemmas().swap_remove(i);
        let name = lemma.name;
        let found = prove(&lemma, &[], &Effort::EVERYDAY, &mut rng);
        assert_eq!((found.wrong, found.outcome), (Vec::new(), Outcome::NotJudged), "{name}");
        let without = prove(&Lemma { witness: &[], ..lemma }, &[], &Effort::EVERYDAY, &mut rng);
        assert!(without.wrong.iter().any(|why| why.contains("the witness has no")), "{name}: {without:?}");
        let assumptions = {
            let lemma = lemmas().swap_remove(i);
            lemma.statement.on_scalars(&mut |_, _| 0, None).assume.len()
        };
        for assumption in 0..assumptions {
            let lemma = lemmas().swap_remove(i);
            let statement = Box::new(Contradicted(lemma.statement, assumption));
            let contrary = Lemma { statement, ..lemma };
            let found = prove(&contrary, &[], &Effort::EVERYDAY, &mut rng);
            assert!(found.wrong.iter().any(|why| why.contains("does not hold")), "{name}: {found:?}");
            contradicted += 1;
        }
        judged += 1;
    }
    eprintln!("{judged} witnesses, {contradicted} contradictions");
    assert!(judged >= 30 && contradicted >= 40);
}

/// What the symbolic operations mean to a solver, to [`Terms::values`] and to the scalar machine.
#[test]
fn operations_are_those_of_the_host() {
    const CASES: usize = 24;
    let (solvers, seed) = (solvers(), seed());
    let mut rng = generator(seed, 2);
    let mut terms = Terms::default();
    let (mut wanted, mut cases) = (Vec::new(), Vec::new());
    for op in Op::ALL {
        for case in 0..CASES {
            let mut operands: Vec<u32> = op.takes().iter().map(|sort| any_bits(*sort, &mut rng)).collect();
            // Every third pair is equal: there < and <= differ.
            if case % 3 == 0 && op.takes().len() == 2 {
                operands[1] = operands[0];
            }
            let expected = on_scalar(op, &operands);
            let result = of_constants(&mut terms, op, &operands);
            let values = terms.values(&[]);
            let found = values.bits(result);
            let nan = op.gives() == Sort::Number && f32::from_bits(expected).is_nan();
            let alike = if nan { f32::from_bits(found).is_nan() } else { found == expected };
            assert!(alike, "{op:?} of {operands:x?}: {found:#x}, not {expected:#x}; CGT_SEED={seed}");
            wanted.extend(is(&mut terms, op.gives(), result, expected));
            cases.push(format!("{op:?} of {operands:x?} is {expected:#010x}"));
        }
    }
    for solver in &solvers {
        let text = query(&terms, Numbers::Float, &[], &wanted).expect("a query");
        let reply = solver.ask(&text, &[], Duration::from_secs(60));
        assert_eq!(reply, Reply::Sat(Some(Vec::new())), "{}: {cases:#?}; CGT_SEED={seed}", solver.name);
        // And of anything else it says that it is not so.
        let (term, holds) = wanted[wanted.len() / 2];
        let mut other = wanted.clone();
        other.push((term, !holds));
        let text = query(&terms, Numbers::Float, &[], &other).expect("a query");
        assert_eq!(solver.ask(&text, &[], Duration::from_secs(60)), Reply::Unsat, "{}", solver.name);
    }
    eprintln!("{} results, {} solvers, CGT_SEED={seed}", cases.len(), solvers.len());
}

/// Of real numbers a solver must say what f32 says where nothing is rounded: of small quarters, quotients by powers of two, and roots of squares.
#[test]
fn operations_on_reals_are_exact() {
    let (solvers, seed) = (solvers(), seed());
    let mut rng = generator(seed, 5);
    let mut terms = Terms::default();
    let mut wanted = Vec::new();
    for op in [Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Sqrt, Op::Lt, Op::Le, Op::Select] {
        for case in 0..24 {
            let [x, y]: [f32; 2] = [(); 2].map(|()| f32::from(rng.random_range(-16i8..=16)) / 4.0);
            // Every third pair is equal: there < and <= differ.
            let (x, y) = if case % 3 == 0 { (x, x) } else { (x, y) };
            let operands = match op {
                Op::Div => vec![x.to_bits(), [0.25f32, -0.5, 1.0, 2.0, -4.0][case % 5].to_bits()],
                Op::Sqrt => vec![(x * x).to_bits()],
                Op::Select => vec![u32::from(x < y), x.to_bits(), y.to_bits()],
                _ => vec![x.to_bits(), y.to_bits()],
            };
            let result = of_constants(&mut terms, op, &operands);
            let expected = on_scalar(op, &operands);
            match op.gives() {
                Sort::Number => {
                    let other = constant(&mut terms, Sort::Number, expected);
                    wanted.extend(
                        [[result, other], [other, result]]
                            .map(|[x, y]| (terms.make(Node::Op(Op::Lt, [x, y, x])), false)),
                    );
                }
                _ => wanted.push((result, expected == 1)),
            }
        }
    }
    for solver in solvers.iter().filter(|solver| solver.knows(Numbers::Real)) {
        let text = query(&terms, Numbers::Real, &[], &wanted).expect("a query");
        let reply = solver.ask(&text, &[], Duration::from_secs(60));
        assert_eq!(reply, Reply::Sat(Some(Vec::new())), "{}, CGT_SEED={seed}", solver.name);
    }
    eprintln!("{} results, CGT_SEED={seed}", wanted.len());
}

/// Of numbers that are anything a solver must know nothing but that the same operation on the same gives the same.
#[test]
fn free_numbers_are_anything() {
    let mut terms = Terms::default();
    let [one, two] = [1.0f32, 2.0].map(|x| terms.make(Node::Number(x.to_bits())));
    let inputs = [0, 1].map(|i| terms.make(Node::Input(i, Sort::Number)));
    for op in [Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Sqrt] {
        let sum = terms.make(Node::Op(op, [one, one, one]));
        let same = terms.make(Node::Op(op, [one, one, one]));
        assert_eq!(sum, same);
        let below = terms.make(Node::Op(Op::Lt, [sum, two, sum]));
        let of_inputs = terms.make(Node::Op(op, [inputs[0], inputs[1], inputs[0]]));
        let other = terms.make(Node::Op(Op::Lt, [of_inputs, sum, of_inputs]));
        for solver in solvers() {
            for truth in [below, other] {
                for holds in [true, false] {
                    let sorts = [Sort::Number; 2];
                    let text = query(&terms, Numbers::Free, &sorts, &[(truth, holds)]).expect("a query");
                    let reply = solver.ask(&text, &sorts, Duration::from_secs(60));
                    assert!(matches!(reply, Reply::Sat(_)), "{}: {op:?}: {reply:?}", solver.name);
                }
            }
        }
    }
}

/// A constant of those bits.
fn constant(terms: &mut Terms, sort: Sort, bits: u32) -> Term {
    match sort {
        Sort::Number => terms.make(Node::Number(bits)),
        Sort::Integer => terms.make(Node::Integer(bits.cast_signed())),
        Sort::Truth => {
            let (one, two) = (terms.make(Node::Integer(1)), terms.make(Node::Integer(2)));
            let operands = if bits == 1 { [one, two, one] } else { [two, one, two] };
            terms.make(Node::Op(Op::LtI, operands))
        }
    }
}

/// What must hold of a term so that it has those bits; of a NaN any.
fn is(terms: &mut Terms, sort: Sort, term: Term, bits: u32) -> Vec<(Term, bool)> {
    let other = constant(terms, sort, bits);
    let mut op = |op, x, y| terms.make(Node::Op(op, [x, y, x]));
    match sort {
        Sort::Truth => vec![(term, bits == 1)],
        Sort::Integer => vec![(op(Op::LtI, term, other), false), (op(Op::LtI, other, term), false)],
        Sort::Number if f32::from_bits(bits).is_nan() => vec![(op(Op::Le, term, term), false)],
        Sort::Number => {
            let mut same = vec![(op(Op::Le, term, other), true), (op(Op::Le, other, term), true)];
            if f32::from_bits(bits) == 0.0 {
                let one = terms.make(Node::Number(1.0f32.to_bits()));
                let zero = terms.make(Node::Number(0));
                let inverse = terms.make(Node::Op(Op::Div, [one, term, one]));
                let positive = f32::from_bits(bits).is_sign_positive();
                same.push((terms.make(Node::Op(Op::Lt, [zero, inverse, zero])), positive));
            }
            same
        }
    }
}

/// An operation on constants.
fn of_constants(terms: &mut Terms, op: Op, operands: &[u32]) -> Term {
    let takes = op.takes().iter().zip(operands);
    let made: Vec<Term> = takes.map(|(sort, bits)| constant(terms, *sort, *bits)).collect();
    let at = |i: usize| made.get(i).copied().unwrap_or(made[0]);
    terms.make(Node::Op(op, [at(0), at(1), at(2)]))
}

/// The scalar machine's result, as bits.
fn on_scalar(op: Op, operands: &[u32]) -> u32 {
    let m = Scalar;
    let f = |i: usize| m.splat(f32::from_bits(operands[i]));
    let n = |i: usize| m.splat_i(operands[i].cast_signed());
    let b = |i: usize| m.lt_i(m.splat_i(0), m.splat_i(operands[i].cast_signed()));
    let number = |x: [f32; LANES]| x[0].to_bits();
    let integer = |x: [i32; LANES]| x[0].cast_unsigned();
    let truth = |x: [bool; LANES]| u32::from(x[0]);
    match op {
        Op::Add => number(m.add(f(0), f(1))),
        Op::Sub => number(m.sub(f(0), f(1))),
        Op::Mul => number(m.mul(f(0), f(1))),
        Op::Div => number(m.div(f(0), f(1))),
        Op::Sqrt => number(m.sqrt(f(0))),
        Op::Lt => truth(m.lt(f(0), f(1))),
        Op::Le => truth(m.le(f(0), f(1))),
        Op::LtI => truth(m.lt_i(n(0), n(1))),
        Op::And => truth(m.and(b(0), b(1))),
        Op::Or => truth(m.or(b(0), b(1))),
        Op::Not => truth(m.not(b(0))),
        Op::Select => number(m.select(b(0), f(1), f(2))),
        Op::SelectI => integer(m.select_i(b(0), n(1), n(2))),
        Op::AddI => integer(m.add_i(n(0), n(1))),
        Op::OrI => integer(m.or_i(n(0), n(1))),
        Op::Shl16 => integer(m.shl_16(n(0))),
        Op::Shr16 => integer(m.shr_16(n(0))),
        Op::Floor => integer(m.floor(f(0))),
        Op::Truncate => integer(m.truncate(f(0))),
    }
}

/// A program that says the same to all questions.
fn liar(folder: &tempfile::TempDir, says: &str) -> Solver {
    let file = folder.path().join("z3");
    std::fs::write(&file, format!("#!/bin/sh\n{says}\n")).expect("a file");
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o755)).expect("its rights");
    Solver::new("z3", file)
}

/// Who says "unsat" to all proves everything, and is noticed by the faults it does not notice; a counterexample that is none is not
/// believed; who says nothing in time, or something else, has not spoken.
#[test]
fn solvers_are_not_believed() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut rng = generator(seed(), 3);
    let effort = Effort { proof: Duration::from_millis(300), faults: usize::MAX, ..Effort::EVERYDAY };
    let successor = || lemmas().swap_remove(0);
    assert_eq!(successor().name, "walk.successor");
    let yes = [liar(&folder, "echo unsat")];
    let found = prove(&successor(), &yes, &effort, &mut rng);
    assert!(found.wrong.iter().any(|why| why.contains("is not needed")), "{found:?}");
    let faults = break_each(&[&successor()], &yes, &effort, &mut rng);
    assert!(faults.wrong.iter().any(|why| why.contains("the prover may say yes to all")), "{faults:?}");
    assert_eq!((faults.noticed, faults.tried), (0, successor().faults().len()));
    // Who does not know real numbers has not spoken of them.
    let real =
        run(|lemma| lemma.name == "find.line", false, &[Solver::new("bitwuzla", "".into())], 0, &|| ());
    assert_eq!(real.not_shown().len(), 1, "{real}");
    let values: String = (0..11).map(|i| format!("(in{i} #x0000000{i:x})")).collect();
    for says in [&format!("echo 'sat ({values})'"), "echo unknown", "sleep 2", "echo unsatisfiable", "exit 1"]
    {
        let found = prove(&successor(), &[liar(&folder, says)], &effort, &mut rng);
        assert!(matches!(found.outcome, Outcome::NotShown(_)), "{says}: {found:?}");
    }
}

/// A step that is false, and a conclusion that follows from it.
struct Stepped;

impl Theorem for Stepped {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        _: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let x = ask.number("x");
        let wrong = m.lt(x, x);
        Statement {
            steps: vec![("it is below itself", wrong)],
            assume: vec![],
            conclude: vec![("so it is", wrong)],
        }
    }
}

/// What follows from a step that nobody has shown is not shown, though a solver says that it follows.
#[test]
fn a_step_that_is_not_shown_shows_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let lemma = Lemma {
        name: "stepped",
        words: "",
        kernel: "",
        numbers: Numbers::Float,
        whole: false,
        lanes: Lanes::Any,
        expected: Expected::Holds,
        long: false,
        witness: &[("x", 0x3f80_0000)],
        harmless: &[],
        statement: Box::new(Stepped),
    };
    let effort = Effort { proof: Duration::from_secs(5), ..Effort::EVERYDAY };
    for first in ["unknown", "sat"] {
        let flag = folder.path().join(first);
        let says =
            format!("if [ -e '{0}' ]; then echo unsat; else : > '{0}'; echo {first}; fi", flag.display());
        let found = prove(&lemma, &[liar(&folder, &says)], &effort, &mut generator(seed(), 5));
        let told = matches!(&found.outcome, Outcome::NotShown(why) if why.contains("the step that it is below itself"));
        assert!(told, "after {first}: {found:?}");
    }
}

/// Work whose doors are counted.
fn doors(m: Symbolic<'_, 1>, x: &[Term], number: usize) -> u32 {
    let mut taken = 0;
    for i in 0..number {
        let limit = m.splat_i(i32::try_from(i).expect("few"));
        taken = 2 * taken + u32::from(m.any(m.lt_i([x[0]], limit), Site::NextId));
    }
    taken
}

#[test]
fn every_path_is_explored_once() {
    let space = Space::new(Lanes::Any);
    let x = [space.input(0, Sort::Integer)];
    let paths = explore(&space, |m| doors(m, &x, 5)).expect("32 paths");
    let taken: Vec<u32> = paths.iter().map(|path| path.result).collect();
    assert_eq!(taken, (0..32).rev().collect::<Vec<_>>());
    assert_eq!(explore(&space, |m| doors(m, &x, 13)).err(), Some(ExploreError::Paths(4096)));
    let endless = explore(&space, |m| {
        let mut i = 0;
        while m.any(m.lt_i([x[0]], m.splat_i(i)), Site::NextCell) {
            i += 1;
        }
    });
    assert_eq!(endless.err(), Some(ExploreError::Doors(MAX_DOORS)));
    // Where all lanes are alike, a question that was answered is not asked again.
    let space = Space::new(Lanes::Alike);
    let x = [space.input(0, Sort::Integer)];
    let twice = explore(&space, |m| [doors(m, &x, 1), doors(m, &x, 1)]).expect("2 paths");
    assert_eq!(twice.iter().map(|path| path.result).collect::<Vec<_>>(), [[1, 1], [0, 0]]);
}

/// Something that plain arithmetic does to a number on its way into lanes.
struct Plain(fn(f32) -> f32);

impl Theorem for Plain {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        _: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let x = m.splat(self.0(ask.plain("x")));
        Statement { steps: vec![], assume: vec![], conclude: vec![("it is above 0", m.lt(m.splat(0.0), x))] }
    }
}

/// A sign that is changed is understood; an addition would be lost, and the comparison with the scalar machine tells.
#[test]
fn plain_arithmetic_does_not_pass_unnoticed() {
    let lemma = |plain| Lemma {
        name: "plain",
        words: "",
        kernel: "",
        numbers: Numbers::Float,
        whole: false,
        lanes: Lanes::Any,
        expected: Expected::Fails,
        long: false,
        witness: &[("x", 0x3f80_0000)],
        harmless: &[],
        statement: Box::new(Plain(plain)),
    };
    let mut rng = generator(seed(), 4);
    let understood = prove(&lemma(|x| -x), &[], &Effort::EVERYDAY, &mut rng);
    assert_eq!(understood.wrong, Vec::<String>::new());
    let lost = prove(&lemma(|x| x + 1.0), &[], &Effort::EVERYDAY, &mut rng);
    assert!(lost.wrong.iter().any(|why| why.contains("terms say")), "{lost:?}");
}
