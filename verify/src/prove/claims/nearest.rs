//! Claim: of the spheres that a ray meets, in whatever order and however often, the nearest with the lowest id stays; and what the certified stage
//! leaves unmarked is certain.
//!
//! *Order.* Two spheres met one after the other leave the same t and id as in the other order (`nearest.order`), and a sphere met twice
//! the same as once (`nearest.twice`), for whatever numbers the arithmetic gives: in both forms, at every branch that another ray of the packet may cause.
//! Ids are compared and nothing else, so three orders of two ids stand for all.
//!
//! *Marks.* By induction over the spheres met, each root's interval being right: whoever is not the owner and may be hit has its lower
//! end at or above `rival` (`nearest.rival`); an unmarked ray's `rival` is above the owner's upper end, so no other root is as near
//! (`nearest.unmarked`). That the intervals are right is the bound of [`optimized::bound`], exhausted over small floats in `tests/bound.rs`.

use super::{all, implies, same, same_i};
use crate::prove::broken::Fault;
use crate::prove::smt::Numbers;
use crate::prove::symbolic::Lanes;
use crate::prove::theorem::{Ask, Expected, Lemma, Statement, Theorem, Wrong};
use optimized::Form;
use optimized::camera::Block;
use optimized::certain;
use optimized::machine::{Machine, Site, Stage};
use optimized::sphere::{NONE, Nearest, Prepared};

fn sphere<M: Machine>(ask: &mut impl Ask<M>, names: [&'static str; 5]) -> Prepared {
    let [x, y, z, rr, q] = names.map(|name| ask.plain(name));
    Prepared { f: [x, y, z], rr, q, cull_radius: 0.0 }
}

/// A ray, as a packet knows it.
fn ray<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(ask: &mut impl Ask<M>) -> Block<K> {
    let dir = ["d x", "d y", "d z"].map(|name| ask.number(name));
    Block { dir, inv_dd: ask.number("1/dd"), dd: ask.number("dd") }
}

/// What the certified stage knows of a ray so far.
fn so_far<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
    ask: &mut impl Ask<M>,
) -> certain::Nearest<K> {
    certain::Nearest {
        id: ask.integer("owner"),
        lo: ask.number("lo"),
        hi: ask.number("hi"),
        rival: ask.number("rival"),
    }
}

/// Two spheres in either order.
struct Order {
    form: Form,
    ids: [i32; 2],
}

impl Theorem for Order {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let block = ray::<M, K>(ask);
        let one = sphere(ask, ["f x", "f y", "f z", "rr", "q"]);
        let other = sphere(ask, ["g x", "g y", "g z", "ss", "p"]);
        let (t, id) = (ask.number("t"), ask.integer("id"));
        let start = || Nearest::<K> { t, id };
        let [a, b] = self.ids;
        let meet = |nearest: Nearest<K>, sphere: &Prepared, id: i32| {
            kernel.stage(Stage::Intersect);
            nearest.meet(kernel, self.form, &block, sphere, id)
        };
        let forth = meet(meet(start(), &one, a), &other, b);
        let back = meet(meet(start(), &other, b), &one, a);
        Statement {
            steps: Vec::new(),
            assume: vec![("the nearest t so far is a number", m.le(t, t))],
            conclude: vec![
                ("t is the same", same(m, forth.t, back.t)),
                ("the sphere is the same", same_i(m, forth.id, back.id)),
            ],
        }
    }
}

/// One sphere, by the contract's rule with nothing selected but what is nearest in the end: rule 2 of t, and rule 4 of ids.
struct Rule {
    form: Form,
    /// Said with branches, as for one ray; else for a ray among others.
    branches: bool,
}

impl Theorem for Rule {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        const ID: i32 = 4;
        let block = ray::<M, K>(ask);
        let sphere = sphere(ask, ["f x", "f y", "f z", "rr", "q"]);
        let start = Nearest::<K> { t: ask.number("t"), id: ask.integer("id") };
        let after = start.meet(kernel, self.form, &block, &sphere, ID);
        let (f, dir) = (sphere.f.map(|x| m.splat(x)), block.dir);
        let along = m.add(m.add(m.mul(f[0], dir[0]), m.mul(f[1], dir[1])), m.mul(f[2], dir[2]));
        let (discriminant, middle, half) = match self.form {
            Form::Textbook => {
                let d = m.sub(m.mul(along, along), m.mul(block.dd, m.splat(sphere.q)));
                (d, m.neg(along), m.sqrt(d))
            }
            Form::Perpendicular => {
                let h = m.mul(along, block.inv_dd);
                let l = [0, 1, 2].map(|i| m.sub(f[i], m.mul(h, dir[i])));
                let ll = m.add(m.add(m.mul(l[0], l[0]), m.mul(l[1], l[1])), m.mul(l[2], l[2]));
                let d = m.sub(m.splat(sphere.rr), ll);
                (d, m.neg(h), m.sqrt(m.mul(d, block.inv_dd)))
            }
        };
        let ends = [m.sub(middle, half), m.add(middle, half)];
        let [near, far] = match self.form {
            Form::Textbook => ends.map(|end| m.div(end, block.dd)),
            Form::Perpendicular => ends,
        };
        let (zero, id) = (m.splat(0.0), m.splat_i(ID));
        let (real, ahead) = (m.le(zero, discriminant), m.lt(zero, near));
        let nearer = |t: M::F| m.or(m.lt(t, start.t), m.and(same(m, t, start.t), m.lt_i(id, start.id)));
        let (t, owner) = if self.branches {
            let door = |x: M::B| m.any(x, Site::Sphere);
            let t = if door(ahead) { near } else { far };
            let hit = door(real) && door(m.lt(zero, t)) && door(nearer(t));
            if hit { (t, id) } else { (start.t, start.id) }
        } else {
            let t = m.select(ahead, near, far);
            let hit = all(m, &[real, m.lt(zero, t), nearer(t)]);
            (m.select(hit, t, start.t), m.select_i(hit, id, start.id))
        };
        Statement {
            steps: Vec::new(),
            assume: vec![("the nearest t so far is a number", m.le(start.t, start.t))],
            conclude: vec![
                ("t is that of the contract", same(m, after.t, t)),
                ("the sphere is that of the contract", same_i(m, after.id, owner)),
            ],
        }
    }
}

struct Twice(Form);

impl Theorem for Twice {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let block = ray::<M, K>(ask);
        let sphere = sphere(ask, ["f x", "f y", "f z", "rr", "q"]);
        let start = Nearest::<K> { t: ask.number("t"), id: ask.integer("id") };
        let once = start.meet(kernel, self.0, &block, &sphere, 3);
        kernel.stage(Stage::Intersect);
        let twice = once.meet(kernel, self.0, &block, &sphere, 3);
        let nearer = m.le(once.t, start.t);
        Statement {
            steps: Vec::new(),
            assume: vec![("the nearest t so far is a number", m.le(start.t, start.t))],
            conclude: vec![
                ("t is the same", same(m, once.t, twice.t)),
                ("the sphere is the same", same_i(m, once.id, twice.id)),
                ("no hit is farther than the one before", nearer),
            ],
        }
    }
}

/// What stays true of all spheres that were met.
struct Rival;

impl Theorem for Rival {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let before = so_far::<M, K>(ask);
        let zero = m.splat_i(0);
        let yes = |x: M::I| m.lt_i(zero, x);
        let (possible, certain) = (yes(ask.integer("possible")), yes(ask.integer("certain")));
        let found =
            certain::Found::<K> { possible, certain, lo: ask.number("found lo"), hi: ask.number("found hi") };
        let id = 5;
        let after = before.meet(kernel, &found, id);
        let new = m.splat_i(id);
        let kept = same_i(m, after.id, before.id);
        // An upper end may be no number, which is neither above nor below another.
        let apart = m.or(m.lt(before.hi, after.hi), m.lt(after.hi, before.hi));
        let interval = m.and(same(m, after.lo, before.lo), m.not(apart));
        let unchanged = all(m, &[kept, interval, same(m, after.rival, before.rival)]);
        let again = same_i(m, before.id, new);
        Statement {
            steps: Vec::new(),
            assume: vec![
                ("the owner's lower end is a number", m.le(before.lo, before.lo)),
                ("the rival's lower end is a number", m.le(before.rival, before.rival)),
                ("the sphere's lower end is a number", m.le(found.lo, found.lo)),
            ],
            conclude: vec![
                ("whoever was a rival still is no nearer than the rival", m.le(after.rival, before.rival)),
                ("an owner that loses is no nearer than the rival", {
                    implies(m, m.not(kept), m.le(after.rival, before.lo))
                }),
                ("a sphere that may be hit and does not become owner is no nearer than the rival", {
                    let stays = all(m, &[possible, kept, m.not(again)]);
                    implies(m, stays, m.le(after.rival, found.lo))
                }),
                ("an owner is certainly hit, and its interval is the one found", {
                    let own = all(m, &[certain, possible, same_i(m, after.id, new)]);
                    let ends = m.and(same(m, after.lo, found.lo), same(m, after.hi, found.hi));
                    implies(m, m.not(kept), m.and(own, ends))
                }),
                ("an owner that is met again changes nothing", implies(m, again, unchanged)),
                ("an owner is replaced by one whose upper end is lower", {
                    implies(m, m.not(kept), m.lt(after.hi, before.hi))
                }),
                ("who stays owner keeps its interval", implies(m, kept, interval)),
            ],
        }
    }
}

/// What an unmarked ray is certain of.
struct Unmarked;

impl Theorem for Unmarked {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let nearest = so_far::<M, K>(ask);
        let (own, other) = (ask.number("the owner's root"), ask.number("another root"));
        let unmarked = m.not(nearest.marked(kernel));
        let far = m.splat(f32::INFINITY);
        Statement {
            steps: Vec::new(),
            assume: vec![
                ("the owner's root is not above its upper end", m.le(own, nearest.hi)),
                ("the other's root is not below the rival's lower end", m.le(nearest.rival, other)),
                ("the other's root is finite", m.lt(other, far)),
                ("the ray is not marked", unmarked),
            ],
            conclude: vec![("the owner's root is nearer", m.lt(own, other))],
        }
    }
}

/// Who is marked.
struct Marked;

impl Theorem for Marked {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let nearest = so_far::<M, K>(ask);
        let far = m.splat(f32::INFINITY);
        Statement {
            steps: Vec::new(),
            assume: vec![("the ray is marked", nearest.marked(kernel))],
            conclude: vec![
                ("another sphere may be hit", m.lt(nearest.rival, far)),
                ("and may be as near as the owner", m.le(nearest.rival, nearest.hi)),
            ],
        }
    }
}

const ONE: u32 = 0x3f80_0000;
const TWO: u32 = 0x4000_0000;
const INFINITY: u32 = 0x7f80_0000;

/// A ray along z, a sphere that it touches, and one that it hits.
const RAY: &[(&str, u32)] = &[
    ("d x", 0),
    ("d y", 0),
    ("d z", ONE),
    ("dd", ONE),
    ("1/dd", ONE),
    ("f x", ONE),
    ("f y", 0),
    ("f z", 0xc080_0000),
    ("rr", ONE),
    ("q", 0x4180_0000),
    ("g x", 0),
    ("g y", 0),
    ("g z", 0xc040_0000),
    ("ss", ONE),
    ("p", 0x4100_0000),
    ("t", INFINITY),
    ("id", NONE.cast_unsigned()),
];
const MET: &[(&str, u32)] = &[
    ("owner", 2),
    ("lo", ONE),
    ("hi", ONE),
    ("rival", TWO),
    ("possible", 1),
    ("certain", 1),
    ("found lo", ONE),
    ("found hi", TWO),
    ("the owner's root", ONE),
    ("another root", TWO),
];

const TEXTBOOK: &str = "optimized::sphere::Nearest::meet, textbook";
const PERPENDICULAR: &str = "optimized::sphere::Nearest::meet, perpendicular";
const MEET: &str = "optimized::certain::Nearest::meet";
const SAME: &str = "a sphere that is met again at the same t replaces itself by itself";

/// The lemmas.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    let lemma = |name, kernel, words, numbers, witness, statement| Lemma {
        name,
        words,
        kernel,
        numbers,
        whole: false,
        lanes: Lanes::Any,
        expected: Expected::Holds,
        long: false,
        witness,
        harmless: match kernel {
            TEXTBOOK => &[(Wrong::Operation(21, Fault::Border), SAME)],
            PERPENDICULAR => &[(Wrong::Operation(30, Fault::Border), SAME)],
            MEET => &[(Wrong::Operation(12, Fault::Border), "of two equal lower ends either is the lowest")],
            _ => &[],
        },
        statement,
    };
    let mut lemmas = Vec::new();
    for (form, kernel, names) in [
        (
            Form::Textbook,
            TEXTBOOK,
            [
                "nearest.rule.textbook",
                "nearest.branches.textbook",
                "nearest.order.textbook",
                "nearest.tie.textbook",
                "nearest.twice.textbook",
            ],
        ),
        (
            Form::Perpendicular,
            PERPENDICULAR,
            [
                "nearest.rule.perpendicular",
                "nearest.branches.perpendicular",
                "nearest.order.perpendicular",
                "nearest.tie.perpendicular",
                "nearest.twice.perpendicular",
            ],
        ),
    ] {
        let [rule, branches, order, tie, twice] = names;
        let words =
            "Meeting a sphere leaves t and id by the contract's rules, whatever other rays of the packet hit";
        lemmas.push(lemma(rule, kernel, words, Numbers::Free, RAY, Box::new(Rule { form, branches: false })));
        let words = "Meeting a sphere in selects leaves what the branching form leaves";
        let statement = Box::new(Rule { form, branches: true });
        lemmas.push(Lemma {
            lanes: Lanes::Alike,
            ..lemma(branches, kernel, words, Numbers::Free, RAY, statement)
        });
        let words = "Two spheres leave the same t and id in whatever order they are met";
        for (name, ids) in [(order, [3, 5]), (tie, [5, 3])] {
            lemmas.push(lemma(name, kernel, words, Numbers::Free, RAY, Box::new(Order { form, ids })));
        }
        let words =
            "A sphere met twice leaves what it left when met once, and no hit is farther than the one before";
        lemmas.push(lemma(twice, kernel, words, Numbers::Free, RAY, Box::new(Twice(form))));
    }
    lemmas.push(lemma(
        "nearest.rival",
        MEET,
        "Whatever may be hit and is not the owner is no nearer than the rival",
        Numbers::Free,
        MET,
        Box::new(Rival),
    ));
    lemmas.push(lemma(
        "nearest.unmarked",
        "optimized::certain::Nearest::marked",
        "On an unmarked ray the owner's root is nearer than any other",
        Numbers::Free,
        MET,
        Box::new(Unmarked),
    ));
    lemmas.push(lemma(
        "nearest.marked",
        "optimized::certain::Nearest::marked",
        "No ray is marked for which no other sphere may be as near",
        Numbers::Free,
        &[("owner", 2), ("lo", ONE), ("hi", TWO), ("rival", ONE)],
        Box::new(Marked),
    ));
    lemmas
}
