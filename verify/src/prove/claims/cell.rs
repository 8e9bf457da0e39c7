//! Claim: the cell map is monotone over all f32, for every grid; so a ball's box range holds the cell of each of its points, and eight corners
//! miss none if and only if no box spans three cells, which a diameter below the cell by 2⁻¹⁴ of it ensures and the paper's condition does not.
//!
//! *Monotone, for every grid.* The shipped [`Axis::cell`] keeps the order of x and y if one subtraction and one multiplication
//! do (`cell.monotone`: origin, inverse cell size and number of cells are inputs too); a subtraction does (`cell.difference`, all f32),
//! and so does a multiplication by a number that is not negative (`cell.product`: over the reals, and what rounds the real product to f32 keeps
//! its order by its definition; a bit-level proof of the rounded product was not done in 15 minutes of any solver). All
//! values of f32 are swept for given grids in `tests/grid.rs`.
//!
//! *Box range.* Where a real point P of a ball has lo <= P <= hi on an axis, lo and hi being f32, and P is said to lie in the last cell whose
//! least f32 is not above it, P's cell lies between those of lo and hi: `cell.between`, by the order of planes alone.
//!
//! *Eight corners.* If a box spans three cells m, m + 1 and m + 2, it is wider than cell m + 1 from plane to plane (`cell.corners`), and this is
//! what is compared for each sphere when it is listed (`Event::SpansCells`): certified in each run. In a grid of unit cells about −8 a diameter
//! of 1 − 2⁻¹⁴ is enough for every f32 position (`cell.corners.below`), and a diameter of 1, the paper's condition, is not (`cell.corners.equal`).

use super::{NONE, all, implies, le_i, same_i};
use crate::prove::broken::Fault;
use crate::prove::smt::Numbers;
use crate::prove::symbolic::Lanes;
use crate::prove::theorem::{Ask, Expected, Lemma, Statement, Theorem, Wrong};
use optimized::grid::Axis;
use optimized::machine::{Machine, Site, Stage};

/// An axis of any origin, scale and number of cells.
fn any_axis<M: Machine>(ask: &mut impl Ask<M>) -> Axis {
    Axis { n: ask.count("n"), origin: ask.plain("origin"), inverse: ask.plain("inverse"), planes: Vec::new() }
}

/// Sixteen cells of size 1, from −8.
fn unit_axis() -> Axis {
    Axis { n: 16, origin: -8.0, inverse: 1.0, planes: Vec::new() }
}

fn finite<M: Machine>(m: M, x: M::F) -> M::B {
    m.and(m.le(m.splat(f32::MIN), x), m.le(x, m.splat(f32::MAX)))
}

/// The map keeps order, if its two roundings do.
struct Monotone;

impl Theorem for Monotone {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (axis, x, y) = (any_axis(ask), ask.number("x"), ask.number("y"));
        let cell = |x: M::F| {
            kernel.stage(Stage::Voxelize);
            axis.cell(kernel, x)
        };
        let [cell_x, cell_y] = [cell(x), cell(y)];
        let (origin, inverse) = (m.splat(axis.origin), m.splat(axis.inverse));
        let scaled = |x: M::F| m.mul(m.sub(x, origin), inverse);
        let last = m.splat_i(axis.n - 1);
        let zero = m.splat_i(0);
        Statement {
            steps: Vec::new(),
            assume: vec![("scaled, the two are in order", m.le(scaled(x), scaled(y)))],
            conclude: vec![
                ("their cells are in order", le_i(m, cell_x, cell_y)),
                ("there is such a cell", all(m, &[le_i(m, zero, cell_x), le_i(m, cell_x, last)])),
            ],
        }
    }
}

/// The map in its branching form.
struct Branches;

impl Theorem for Branches {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (axis, x) = (any_axis(ask), ask.number("x"));
        let cell = axis.cell(kernel, x);
        let scaled = m.floor(m.mul(m.sub(x, m.splat(axis.origin)), m.splat(axis.inverse)));
        let (first, last) = (m.splat_i(0), m.splat_i(axis.n - 1));
        let wanted = if m.any(m.lt_i(scaled, first), Site::EmptyCell) {
            first
        } else if m.any(m.lt_i(last, scaled), Site::EmptyCell) {
            last
        } else {
            scaled
        };
        Statement {
            steps: Vec::new(),
            assume: vec![],
            conclude: vec![("it is the cell of the branching form", same_i(m, cell, wanted))],
        }
    }
}

/// A subtraction keeps order.
struct Difference;

impl Theorem for Difference {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        _: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (x, y, origin) = (ask.number("x"), ask.number("y"), ask.number("origin"));
        let order = m.le(m.sub(x, origin), m.sub(y, origin));
        Statement {
            steps: Vec::new(),
            assume: vec![("the two are in order", m.le(x, y)), ("the origin is finite", finite(m, origin))],
            conclude: vec![("less the origin they are in order", order)],
        }
    }
}

/// A product with what is not negative keeps order, in reals.
struct Product;

impl Theorem for Product {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        _: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (x, y, inverse) = (ask.number("x"), ask.number("y"), ask.number("inverse"));
        let order = m.le(m.mul(x, inverse), m.mul(y, inverse));
        Statement {
            steps: Vec::new(),
            assume: vec![
                ("the two are in order", m.le(x, y)),
                ("the factor is not negative", m.le(m.splat(0.0), inverse)),
            ],
            conclude: vec![("their products are in order", order)],
        }
    }
}

/// A real point between the ends of a box lies between their cells: cells by their planes.
struct Between;

impl Theorem for Between {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        _: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (lo, p, hi) = (ask.number("lo"), ask.number("P"), ask.number("hi"));
        let plane = ask.number("a plane");
        Statement {
            steps: Vec::new(),
            assume: vec![("the point is not below the box", m.le(lo, p)), ("nor above it", m.le(p, hi))],
            conclude: vec![
                ("where lo is in that cell or a later one, so is P", {
                    implies(m, m.le(plane, lo), m.le(plane, p))
                }),
                ("where P is in that cell or a later one, so is hi", {
                    implies(m, m.le(plane, p), m.le(plane, hi))
                }),
            ],
        }
    }
}

/// What spans three cells is wider than the middle one.
struct Corners;

impl Theorem for Corners {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        _: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (lo, hi) = (ask.number("lo"), ask.number("hi"));
        let (begin, end) = (ask.number("begin of the middle cell"), ask.number("end of the middle cell"));
        Statement {
            steps: Vec::new(),
            assume: vec![
                ("the box begins before the middle cell", m.lt(lo, begin)),
                ("and ends after it", m.le(end, hi)),
            ],
            conclude: vec![("the box is wider than the cell", m.lt(m.sub(end, begin), m.sub(hi, lo)))],
        }
    }
}

/// Whether the corners of a ball in the unit grid have equal or neighbouring cells.
struct Unit {
    /// The largest diameter.
    diameter: f32,
}

impl Theorem for Unit {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (axis, c, r) = (unit_axis(), ask.number("c"), ask.number("r"));
        let [lo, hi] = [m.sub(c, r), m.add(c, r)].map(|x| {
            kernel.stage(Stage::Voxelize);
            axis.cell(kernel, x)
        });
        let small = m.and(m.lt(m.splat(0.0), r), m.le(m.add(r, r), m.splat(self.diameter)));
        Statement {
            steps: Vec::new(),
            assume: vec![("the diameter is at most that", small)],
            conclude: vec![(
                "the corners' cells are equal or neighbours",
                le_i(m, hi, m.add_i(lo, m.splat_i(1))),
            )],
        }
    }
}

const ONE: u32 = 0x3f80_0000;
const TWO: u32 = 0x4000_0000;
const HALF: u32 = 0x3f00_0000;

/// The lemmas.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    use Expected::{Fails, Holds};
    let cell = "optimized::grid::Axis::cell";
    let harmless: &[(Wrong, &str)] = &[
        (
            Wrong::Operation(2, Fault::OtherWhole),
            "floor and truncation differ below 0 alone, which is cell 0 by both",
        ),
        (Wrong::Operation(5, Fault::Border), "cell 0 is cell 0 by either arm"),
        (Wrong::Operation(7, Fault::Border), "the last cell is the last by either arm"),
    ];
    let lemma = |name, kernel, words, numbers, expected, witness, statement| Lemma {
        name,
        words,
        kernel,
        numbers,
        whole: false,
        lanes: Lanes::Any,
        expected,
        long: false,
        witness,
        harmless: &[],
        statement,
    };
    let order: &[(&str, u32)] = &[("x", ONE), ("y", TWO), ("origin", HALF), ("inverse", TWO), ("n", 16)];
    vec![
        lemma(
            "cell.monotone",
            cell,
            "For every grid the cell map keeps the order of any two f32 and gives a cell that exists, if what it scales is in order",
            Numbers::Free,
            Holds,
            order,
            Box::new(Monotone),
        ),
        Lemma {
            lanes: Lanes::Alike,
            harmless,
            ..lemma(
                "cell.branches",
                cell,
                "For every grid the cell map in selects gives the cell of its branching form",
                Numbers::Free,
                Holds,
                order,
                Box::new(Branches),
            )
        },
        Lemma {
            long: true,
            ..lemma(
                "cell.difference",
                NONE,
                "An f32 subtraction of any finite number keeps the order of any two f32",
                Numbers::Float,
                Holds,
                order,
                Box::new(Difference),
            )
        },
        lemma(
            "cell.product",
            NONE,
            "A multiplication by what is not negative keeps the order of any two real numbers",
            Numbers::Real,
            Holds,
            order,
            Box::new(Product),
        ),
        lemma(
            "cell.between",
            NONE,
            "The cell of a real point of a box lies between those of the box's ends",
            Numbers::Real,
            Holds,
            &[("lo", HALF), ("P", ONE), ("hi", TWO), ("a plane", ONE)],
            Box::new(Between),
        ),
        lemma(
            "cell.corners",
            NONE,
            "A box that spans three cells is wider than the middle one from plane to plane",
            Numbers::Real,
            Holds,
            &[("lo", 0), ("hi", TWO), ("begin of the middle cell", HALF), ("end of the middle cell", ONE)],
            Box::new(Corners),
        ),
        lemma(
            "cell.corners.below",
            cell,
            "In unit cells about −8, a ball of diameter at most 1 − 2⁻¹⁴ has corners in equal or neighbouring cells on each axis",
            Numbers::Float,
            Holds,
            &[("c", HALF), ("r", 0x3e80_0000)],
            Box::new(Unit { diameter: 1.0 - 1.0 / 16384.0 }),
        ),
        lemma(
            "cell.corners.equal",
            cell,
            "So it has with a diameter of 1, the paper's condition",
            Numbers::Float,
            Fails,
            &[("c", HALF), ("r", 0x3e80_0000)],
            Box::new(Unit { diameter: 1.0 }),
        ),
    ]
}
