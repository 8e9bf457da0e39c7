//! Terms: what a kernel did, as a graph. A term is an operation of [`Machine`](optimized::machine::Machine) on earlier terms, a
//! constant, or an input; equal terms are one. The same graph is printed for solvers ([`super::smt`]) and computed here for given inputs
//! ([`Terms::values`]), which is held against the scalar machine before any proof.

use std::collections::HashMap;

/// A term, by its place in [`Terms`]; it stands after all that it is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Term(u32);

/// What a term stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sort {
    /// An f32, or a real number.
    Number,
    /// An i32.
    Integer,
    /// Yes or no.
    Truth,
}

/// The operations of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "each is the operation of Machine that has its name")]
pub enum Op {
    Add,
    Sub,
    Mul,
    Div,
    Sqrt,
    Lt,
    Le,
    LtI,
    And,
    Or,
    Not,
    Select,
    SelectI,
    AddI,
    OrI,
    Shl16,
    Shr16,
    Floor,
    Truncate,
}

/// How a term is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// The input of that number.
    Input(u32, Sort),
    /// The f32 of those bits.
    Number(u32),
    /// An integer.
    Integer(i32),
    /// An operation on as many terms as it takes; the rest repeat the first.
    Op(Op, [Term; 3]),
}

impl Op {
    /// Every one.
    pub const ALL: [Self; 19] = [
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::Div,
        Self::Sqrt,
        Self::Lt,
        Self::Le,
        Self::LtI,
        Self::And,
        Self::Or,
        Self::Not,
        Self::Select,
        Self::SelectI,
        Self::AddI,
        Self::OrI,
        Self::Shl16,
        Self::Shr16,
        Self::Floor,
        Self::Truncate,
    ];

    /// What it takes.
    #[must_use]
    pub fn takes(self) -> &'static [Sort] {
        use Sort::{Integer, Number, Truth};
        match self {
            Self::Add | Self::Sub | Self::Mul | Self::Div | Self::Lt | Self::Le => &[Number, Number],
            Self::Sqrt | Self::Floor | Self::Truncate => &[Number],
            Self::LtI | Self::AddI | Self::OrI => &[Integer, Integer],
            Self::And | Self::Or => &[Truth, Truth],
            Self::Not => &[Truth],
            Self::Select => &[Truth, Number, Number],
            Self::SelectI => &[Truth, Integer, Integer],
            Self::Shl16 | Self::Shr16 => &[Integer],
        }
    }

    /// What it gives.
    #[must_use]
    pub fn gives(self) -> Sort {
        match self {
            Self::Add | Self::Sub | Self::Mul | Self::Div | Self::Sqrt | Self::Select => Sort::Number,
            Self::Lt | Self::Le | Self::LtI | Self::And | Self::Or | Self::Not => Sort::Truth,
            _ => Sort::Integer,
        }
    }

    /// Its result for operands as bits; yes is 1.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "`as` saturates, as Machine says")]
    fn value(self, [x, y, z]: [u32; 3]) -> u32 {
        let (f, g) = (f32::from_bits(x), f32::from_bits(y));
        let (i, j) = (x.cast_signed(), y.cast_signed());
        match self {
            Self::Add => (f + g).to_bits(),
            Self::Sub => (f - g).to_bits(),
            Self::Mul => (f * g).to_bits(),
            Self::Div => (f / g).to_bits(),
            Self::Sqrt => f.sqrt().to_bits(),
            Self::Lt => u32::from(f < g),
            Self::Le => u32::from(f <= g),
            Self::LtI => u32::from(i < j),
            Self::And => x & y,
            Self::Or | Self::OrI => x | y,
            Self::Not => 1 - x,
            Self::Select | Self::SelectI => [z, y][x as usize],
            Self::AddI => i.wrapping_add(j).cast_unsigned(),
            Self::Shl16 => x << 16,
            Self::Shr16 => x >> 16,
            Self::Floor => (f.floor() as i32).cast_unsigned(),
            Self::Truncate => (f as i32).cast_unsigned(),
        }
    }
}

/// All terms of a run.
#[derive(Clone, Debug, Default)]
pub struct Terms {
    nodes: Vec<Node>,
    known: HashMap<Node, Term>,
}

impl Terms {
    /// The term that is made so.
    ///
    /// # Panics
    /// If operands are of the wrong sort, or there are more than 2²⁰ terms.
    pub fn make(&mut self, node: Node) -> Term {
        if let Node::Op(op, operands) = node {
            for (operand, sort) in operands.into_iter().zip(op.takes()) {
                assert_eq!(self.sort(operand), *sort, "an operand of {op:?}");
            }
        }
        let next = Term(u32::try_from(self.nodes.len()).expect("fewer than 2^32 terms"));
        assert!(next.0 < 1 << 20, "more than 2^20 terms");
        *self.known.entry(node).or_insert_with(|| {
            self.nodes.push(node);
            next
        })
    }

    /// How a term is made.
    #[must_use]
    pub fn node(&self, term: Term) -> Node {
        self.nodes[term.0 as usize]
    }

    /// What a term stands for.
    #[must_use]
    pub fn sort(&self, term: Term) -> Sort {
        match self.node(term) {
            Node::Input(_, sort) => sort,
            Node::Number(_) => Sort::Number,
            Node::Integer(_) => Sort::Integer,
            Node::Op(op, _) => op.gives(),
        }
    }

    /// The term of that place, if there is one.
    #[must_use]
    pub fn at(&self, place: u32) -> Option<Term> {
        ((place as usize) < self.nodes.len()).then_some(Term(place))
    }

    /// What is joined by *and* to make a truth.
    #[must_use]
    pub fn conjuncts(&self, truth: Term) -> Vec<Term> {
        match self.node(truth) {
            Node::Op(Op::And, [x, y, _]) => [self.conjuncts(x), self.conjuncts(y)].concat(),
            _ => vec![truth],
        }
    }

    /// All terms of which the given ones are made, and these, in an order in which each stands after its operands.
    #[must_use]
    pub fn below(&self, roots: &[Term]) -> Vec<Term> {
        let mut wanted = vec![false; self.nodes.len()];
        for root in roots {
            wanted[root.0 as usize] = true;
        }
        for i in (0..self.nodes.len()).rev() {
            if let (true, Node::Op(op, operands)) = (wanted[i], self.nodes[i]) {
                for operand in &operands[..op.takes().len()] {
                    wanted[operand.0 as usize] = true;
                }
            }
        }
        (0..).zip(wanted).filter(|(_, wanted)| *wanted).map(|(i, _)| Term(i)).collect()
    }

    /// The bits of every term for given inputs, f32 being what f32 is; yes is 1.
    #[must_use]
    pub fn values(&self, inputs: &[u32]) -> Values {
        let mut values: Vec<u32> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            values.push(match *node {
                Node::Input(i, _) => inputs[i as usize],
                Node::Number(bits) => bits,
                Node::Integer(x) => x.cast_unsigned(),
                Node::Op(op, operands) => op.value(operands.map(|operand| values[operand.0 as usize])),
            });
        }
        Values(values)
    }
}

impl Term {
    /// Its place.
    #[must_use]
    pub fn place(self) -> u32 {
        self.0
    }
}

/// What [`Terms::values`] found.
#[derive(Clone, Debug)]
pub struct Values(Vec<u32>);

impl Values {
    /// The bits of a term.
    #[must_use]
    pub fn bits(&self, term: Term) -> u32 {
        self.0[term.0 as usize]
    }

    /// Whether a truth is yes.
    #[must_use]
    pub fn holds(&self, term: Term) -> bool {
        self.bits(term) == 1
    }
}
