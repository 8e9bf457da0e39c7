//! Terms as SMT-LIB 2.6 text, for any solver that reads it. Inputs are declared as bit vectors, so that answers come back as bits; or
//! as reals, where a statement is about formulas and not about their rounding.

use super::term::{Node, Op, Sort, Term, Terms};
use std::fmt::Write as _;
use thiserror::Error;

/// What f32 operations mean to the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Numbers {
    /// What they are: IEEE 754, to nearest, ties to even.
    Float,
    /// The real results: a statement about formulas. Infinity is some number, of which nothing is known.
    Real,
    /// Anything, but the same for the same operands: a statement that needs none of them. Comparisons are those of f32.
    Free,
}

/// Why terms have no text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PrintError {
    /// A NaN in a statement about reals.
    #[error("the constant {0:#010x} is no real number")]
    NotReal(u32),
    /// An operation between numbers and integers in a statement about reals.
    #[error("{0:?} has no counterpart among reals here")]
    NotAmongReals(Op),
}

/// Asks whether inputs exist for which each of the terms is what it is said to be. If so, the inputs are asked for, in their order.
///
/// # Errors
/// [`PrintError`] if something of it is no statement about such numbers.
pub fn query(
    terms: &Terms,
    numbers: Numbers,
    inputs: &[Sort],
    wanted: &[(Term, bool)],
) -> Result<String, PrintError> {
    let mut text = format!(
        "(set-option :produce-models true)\n{}(set-logic {})\n",
        if numbers == Numbers::Real { "(set-option :pp.decimal true)\n" } else { "" },
        logic(terms, numbers, wanted)
    );
    if numbers == Numbers::Real {
        text += "(declare-const infinity Real)\n";
    }
    for (i, sort) in inputs.iter().enumerate() {
        let sort = match (sort, numbers) {
            (Sort::Number, Numbers::Real) => "Real",
            (Sort::Truth, _) => "Bool",
            _ => "(_ BitVec 32)",
        };
        _ = writeln!(text, "(declare-const in{i} {sort})");
    }
    let roots: Vec<Term> = wanted.iter().map(|(term, _)| *term).collect();
    for term in terms.below(&roots) {
        define(terms, numbers, term, &mut text)?;
    }
    for (term, holds) in wanted {
        let name = name(*term);
        _ = writeln!(text, "(assert {})", if *holds { name } else { format!("(not {name})") });
    }
    text += "(check-sat)\n";
    if !inputs.is_empty() {
        let names: Vec<String> = (0..inputs.len()).map(|i| format!("in{i}")).collect();
        _ = writeln!(text, "(get-value ({}))", names.join(" "));
    }
    Ok(text)
}

/// The narrowest logic that solvers agree on.
fn logic(terms: &Terms, numbers: Numbers, wanted: &[(Term, bool)]) -> &'static str {
    let roots: Vec<Term> = wanted.iter().map(|(term, _)| *term).collect();
    let below = terms.below(&roots);
    let has = |sort| below.iter().any(|term| terms.sort(*term) == sort);
    match (numbers, has(Sort::Number), has(Sort::Integer)) {
        (_, false, _) => "QF_BV",
        (Numbers::Real, true, false) => "QF_NRA",
        (Numbers::Real, true, true) => "ALL",
        (Numbers::Float | Numbers::Free, true, _) => "QF_BVFP",
    }
}

fn name(term: Term) -> String {
    format!("x{}", term.place())
}

const FLOAT: &str = "(_ FloatingPoint 8 24)";
const FROM_BITS: &str = "(_ to_fp 8 24)";

fn sort(sort: Sort, numbers: Numbers) -> &'static str {
    match (sort, numbers) {
        (Sort::Number, Numbers::Real) => "Real",
        (Sort::Number, _) => FLOAT,
        (Sort::Integer, _) => "(_ BitVec 32)",
        (Sort::Truth, _) => "Bool",
    }
}

fn define(terms: &Terms, numbers: Numbers, term: Term, text: &mut String) -> Result<(), PrintError> {
    let (name, sort) = (name(term), sort(terms.sort(term), numbers));
    let value = match terms.node(term) {
        Node::Input(i, Sort::Number) if numbers != Numbers::Real => format!("({FROM_BITS} in{i})"),
        Node::Input(i, _) => format!("in{i}"),
        Node::Number(bits) if numbers == Numbers::Real => real(bits)?,
        Node::Number(bits) => format!("({FROM_BITS} #x{bits:08x})"),
        Node::Integer(x) => format!("#x{:08x}", x.cast_unsigned()),
        Node::Op(op, [x, y, z]) => {
            let [x, y, z] = [x, y, z].map(self::name);
            match (op, numbers) {
                (Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Sqrt, Numbers::Free) => {
                    // The same operands make the same term, which is declared once.
                    _ = writeln!(text, "(declare-const {name} {sort})");
                    return Ok(());
                }
                (Op::Sqrt, Numbers::Real) => {
                    _ = writeln!(text, "(declare-const {name} Real)");
                    _ = writeln!(
                        text,
                        "(assert (=> (<= 0.0 {x}) (and (<= 0.0 {name}) (= (* {name} {name}) {x}))))"
                    );
                    return Ok(());
                }
                (Op::Floor | Op::Truncate, Numbers::Real) => return Err(PrintError::NotAmongReals(op)),
                (Op::Add, Numbers::Real) => format!("(+ {x} {y})"),
                (Op::Sub, Numbers::Real) => format!("(- {x} {y})"),
                (Op::Mul, Numbers::Real) => format!("(* {x} {y})"),
                (Op::Div, Numbers::Real) => format!("(/ {x} {y})"),
                (Op::Lt, Numbers::Real) => format!("(< {x} {y})"),
                (Op::Le, Numbers::Real) => format!("(<= {x} {y})"),
                (Op::Add, _) => format!("(fp.add RNE {x} {y})"),
                (Op::Sub, _) => format!("(fp.sub RNE {x} {y})"),
                (Op::Mul, _) => format!("(fp.mul RNE {x} {y})"),
                (Op::Div, _) => format!("(fp.div RNE {x} {y})"),
                (Op::Sqrt, _) => format!("(fp.sqrt RNE {x})"),
                (Op::Lt, _) => format!("(fp.lt {x} {y})"),
                (Op::Le, _) => format!("(fp.leq {x} {y})"),
                (Op::LtI, _) => format!("(bvslt {x} {y})"),
                (Op::And, _) => format!("(and {x} {y})"),
                (Op::Or, _) => format!("(or {x} {y})"),
                (Op::Not, _) => format!("(not {x})"),
                (Op::Select | Op::SelectI, _) => format!("(ite {x} {y} {z})"),
                (Op::AddI, _) => format!("(bvadd {x} {y})"),
                (Op::OrI, _) => format!("(bvor {x} {y})"),
                (Op::Shl16, _) => format!("(bvshl {x} #x00000010)"),
                (Op::Shr16, _) => format!("(bvlshr {x} #x00000010)"),
                (Op::Floor, _) => whole("RTN", &x),
                (Op::Truncate, _) => whole("RTZ", &x),
            }
        }
    };
    _ = writeln!(text, "(define-fun {name} () {sort} {value})");
    Ok(())
}

/// To an integer in a direction, saturated, 0 for NaN: outside its range SMT-LIB leaves the conversion open.
fn whole(mode: &str, x: &str) -> String {
    format!(
        "(ite (fp.isNaN {x}) #x00000000 (ite (fp.leq ({FROM_BITS} #x4f000000) {x}) #x7fffffff \
         (ite (fp.leq {x} ({FROM_BITS} #xcf000000)) #x80000000 ((_ fp.to_sbv 32) {mode} {x}))))"
    )
}

/// The number of an f32, exactly.
fn real(bits: u32) -> Result<String, PrintError> {
    let x = f32::from_bits(bits);
    if x.is_nan() {
        return Err(PrintError::NotReal(bits));
    }
    if x.is_infinite() {
        return Ok(if x > 0.0 { "infinity".into() } else { "(- infinity)".into() });
    }
    // Every f32 is a whole number of its least bit.
    let exponent = (bits >> 23 & 0xff).max(1).cast_signed() - 150;
    let units = (bits & 0x007f_ffff) | u32::from(bits >> 23 & 0xff != 0) << 23;
    let power = |e: u32| dashu_int::UBig::ONE << e as usize;
    let size = match exponent {
        0.. => format!("(* {units}.0 {}.0)", power(exponent.unsigned_abs())),
        _ => format!("(/ {units}.0 {}.0)", power(exponent.unsigned_abs())),
    };
    Ok(if x < 0.0 { format!("(- {size})") } else { size })
}
