//! Through the cells: slice by slice from the eye outward, in each slice the packet's rectangle, in an order and with an
//! end that three loops share, or should (the paper's Figure 3).
//!
//! *Nested* is the simple program: for each slice, for each j from first to last, for each k from first to last.
//!
//! *Flattened* is one loop. Its [`step`] computes the three cases "next k", "next j", "next slice" and selects; the
//! loop's own branch is the only one. Four things had to be mended against the print: k runs innermost as in the nested
//! loops (the print runs j); a new slice starts at *its* bounds (the print keeps the first slice's); a cell of an
//! empty slice is not visited (the print visits it); and the loop ends by a flag for the slice reached and not by a
//! comparison after the increment.
//!
//! *Printed* is the print.
//!
//! # The end
//!
//! After a slice the walk may stop if no later slice can win. A sphere not yet met is listed, if it has a hit that wins, in
//! the slice of that hit's point P (the lemma of [`crate::margin`]). If for every ray the nearest hit so far lies, by
//! A = t |d_X|, strictly before the end of the current slice, then so does any P with a smaller or equal t, and its
//! slice has been visited. A is computed with two roundings and enlarged by 2⁻²⁰ to cover them and those of the
//! slice's distance. If spheres are listed by centre, which is up to w from P, then P must lie w before the end; w is as much
//! larger than the largest reach ([`crate::grid::widen`]), so that their sum covers its own rounding too.

use crate::frustum::Slices;
use crate::machine::{Chore, Machine, Site, three};
use crate::plan::Loop;

/// A slice and a cell of its rectangle, the same in all lanes.
#[derive(Clone, Copy)]
pub struct Cursor<M: Machine> {
    /// Slice, in the order of the walk.
    pub slice: M::I,
    /// Cell on the second axis.
    pub j: M::I,
    /// Cell on the third axis.
    pub k: M::I,
}

/// First and last cell of a slice on the second and third axis, the same in all lanes.
#[derive(Clone, Copy)]
pub struct Rectangle<M: Machine> {
    /// First.
    pub first: [M::I; 2],
    /// Last; below the first if there is no cell.
    pub last: [M::I; 2],
}

/// What is done at the cells of a walk, and whether it may end.
pub trait Visitor<M: Machine> {
    /// Called for each cell: number of the slice in the walk, j, k. Not `live`: called only because the loop does not
    /// branch; nothing is to be done.
    fn visit(&mut self, slice: usize, j: i32, k: i32, live: bool);

    /// Rays for which a slice after this one may still win.
    fn unfinished(&self, slice: usize) -> M::B;
}

/// Walks the slices by the loop of choice.
#[inline(always)]
pub fn walk<M: Machine>(m: M, walk: Loop, slices: &Slices, visitor: &mut impl Visitor<M>) {
    match walk {
        Loop::Nested => nested(m, slices, visitor),
        Loop::Flattened => flattened(m, slices, visitor),
        Loop::Printed => printed(slices, visitor),
    }
}

#[inline(always)]
fn nested<M: Machine>(m: M, slices: &Slices, visitor: &mut impl Visitor<M>) {
    let mut s = 0;
    loop {
        m.beside(
            Chore::Rectangle,
            #[inline(always)]
            || (),
        );
        if !m.branch(slices.is_empty(s), Site::EmptySlice) {
            rows(m, slices, s, visitor);
        }
        if !m.branch(s + 1 < slices.count, Site::NextSlice)
            || !m.again(visitor.unfinished(s), Site::Unfinished)
        {
            return;
        }
        s += 1;
    }
}

/// The two inner loops, in a slice that has cells; each ends with its branch.
#[inline(always)]
fn rows<M: Machine>(m: M, slices: &Slices, s: usize, visitor: &mut impl Visitor<M>) {
    let mut j = slices.first[0][s];
    loop {
        let mut k = slices.first[1][s];
        loop {
            visitor.visit(s, j, k, true);
            if !m.branch(k < slices.last[1][s], Site::NextK) {
                break;
            }
            k += 1;
        }
        if !m.branch(j < slices.last[0][s], Site::NextJ) {
            return;
        }
        j += 1;
    }
}

#[inline(always)]
fn flattened<M: Machine>(m: M, slices: &Slices, visitor: &mut impl Visitor<M>) {
    let last_slice = slices.count - 1;
    let start = rectangle(m, slices, 0);
    let mut at = Cursor { slice: m.splat_i(0), j: start.first[0], k: start.first[1] };
    let end = m.splat_i(i32::try_from(slices.count).expect("at most MAX_CELLS"));
    loop {
        let [s, j, k] = three(
            [at.slice, at.j, at.k],
            #[inline(always)]
            |x| m.first_i(x),
        );
        let s = s.unsigned_abs() as usize;
        visitor.visit(s, j, k, !slices.is_empty(s));
        let next = step(m, at, &rectangle(m, slices, s), &rectangle(m, slices, (s + 1).min(last_slice)));
        let same = m.not(m.lt_i(at.slice, next.slice));
        let go_on = m.and(m.lt_i(next.slice, end), m.or(same, visitor.unfinished(s)));
        if !m.again(go_on, Site::NextCell) {
            return;
        }
        at = next;
    }
}

/// Rim: the rectangle of a slice.
#[inline(always)]
fn rectangle<M: Machine>(m: M, slices: &Slices, slice: usize) -> Rectangle<M> {
    let ([first_j, first_k], [last_j, last_k]) = (&slices.first, &slices.last);
    m.beside(
        Chore::Rectangle,
        #[inline(always)]
        || Rectangle {
            first: [m.splat_i(first_j[slice]), m.splat_i(first_k[slice])],
            last: [m.splat_i(last_j[slice]), m.splat_i(last_k[slice])],
        },
    )
}

/// Kernel: the successor of a cell, given its slice's rectangle and the next slice's. Straight-line: the three cases are
/// all computed, and selected. A slice without cells is left at once.
#[inline(always)]
pub fn step<M: Machine>(m: M, at: Cursor<M>, here: &Rectangle<M>, next: &Rectangle<M>) -> Cursor<M> {
    let one = m.splat_i(1);
    let some = m.not(m.or(m.lt_i(here.last[0], here.first[0]), m.lt_i(here.last[1], here.first[1])));
    let more_k = m.and(some, m.lt_i(at.k, here.last[1]));
    let more_j = m.and(some, m.lt_i(at.j, here.last[0]));
    let more = m.or(more_k, more_j);
    let restart_k = m.select_i(more_j, here.first[1], next.first[1]);
    let advance_j = m.select_i(more_j, m.add_i(at.j, one), next.first[0]);
    Cursor {
        slice: m.select_i(more, at.slice, m.add_i(at.slice, one)),
        j: m.select_i(more_k, at.j, advance_j),
        k: m.select_i(more_k, m.add_i(at.k, one), restart_k),
    }
}

/// The loop as printed: bounds of the first slice for all, j innermost, a visit before any check. (The cells it visits are
/// those of the grid, since the cell map gives no others.)
#[inline(always)]
fn printed<M: Machine>(slices: &Slices, visitor: &mut impl Visitor<M>) {
    let [first_j, first_k] = [slices.first[0][0], slices.first[1][0]];
    let [last_j, last_k] = [slices.last[0][0], slices.last[1][0]];
    let (mut i, mut j, mut k) = (0, first_j, first_k);
    while i < slices.count {
        visitor.visit(i, j, k, true);
        if j < last_j {
            j += 1;
        } else if k < last_k {
            (j, k) = (first_j, k + 1);
        } else {
            (i, j, k) = (i + 1, first_j, first_k);
        }
    }
}
