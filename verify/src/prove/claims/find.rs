//! Claim: without its roundings the f32 stage decides rightly. Its roundings are bounded in [`optimized::bound`], for every unit
//! roundoff below 1/8, and run over all inputs of domains of small floats in `tests/bound.rs`.
//!
//! The shipped [`Rays::find`](optimized::certain::Rays::find) runs on real numbers here, with any bound of the right sign: a ray (1, y, z) in distances A along the
//! packet's major axis, a ball of radius r about c, both relative to the eye.
//!
//! - `find.line`: what it compares r² with is the squared distance of the centre from the line, times a = 1 + y² + z² (Lagrange's identity).
//! - `find.possible`: if any point of the ray lies on the sphere, it is possibly hit.
//! - `find.root`: from outside, the nearest such point lies in the interval that it gives; `find.far`: from inside, the only one ahead.
//! - `find.certain`: what it calls certain has such a point; `find.miss`: what the line misses is dropped; `find.unknown`: where it is not known
//!   whether the eye is inside, nothing is certain. `find.sharp`: with nothing to bound, the interval is the root.

use super::{NONE, all, implies, same};
use crate::prove::broken::Fault;
use crate::prove::smt::Numbers;
use crate::prove::symbolic::Lanes;
use crate::prove::theorem::{Ask, Expected, Lemma, Statement, Theorem, Wrong};
use optimized::bound::Bound;
use optimized::certain::{Ball, Found, Rays, Side};
use optimized::machine::Machine;

/// A ray and a ball.
struct Scene<M: Machine> {
    slope: [M::F; 2],
    center: [f32; 3],
    rr: f32,
    bound: Bound,
}

fn scene<M: Machine>(ask: &mut impl Ask<M>) -> Scene<M> {
    Scene {
        slope: [ask.number("y"), ask.number("z")],
        center: ["c A", "c Y", "c Z"].map(|name| ask.plain(name)),
        rr: ask.plain("rr"),
        bound: Bound {
            hit_above: ask.plain("hit above"),
            miss_below: ask.plain("miss below"),
            root: ask.plain("root"),
        },
    }
}

fn square<M: Machine>(m: M, v: [M::F; 3]) -> M::F {
    m.add(m.add(m.mul(v[0], v[0]), m.mul(v[1], v[1])), m.mul(v[2], v[2]))
}

impl<M: Machine> Scene<M> {
    fn dir(&self, m: M) -> [M::F; 3] {
        [m.splat(1.0), self.slope[0], self.slope[1]]
    }

    fn center(&self, m: M) -> [M::F; 3] {
        self.center.map(|x| m.splat(x))
    }

    /// Whether the point at a distance lies on the sphere.
    fn touches(&self, m: M, at: M::F) -> M::B {
        let (dir, center) = (self.dir(m), self.center(m));
        let away = [0, 1, 2].map(|i| m.sub(m.mul(at, dir[i]), center[i]));
        same(m, square(m, away), m.splat(self.rr))
    }

    /// Half the sum of the two roots, times a.
    fn along(&self, m: M) -> M::F {
        let (dir, center) = (self.dir(m), self.center(m));
        m.dot(dir, center)
    }

    fn find<K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        side: Side,
    ) -> Option<Found<K>> {
        let zero = m.splat(0.0);
        let everywhere = m.le(zero, zero);
        let rays = Rays::<K>::new(kernel, self.slope);
        let ball = Ball { center: self.center, rr: self.rr, bound: self.bound, side };
        rays.find(kernel, &ball, everywhere)
    }
}

/// Lagrange's identity for what the kernel computes.
struct Line;

impl Theorem for Line {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        _: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let s = scene(ask);
        let [y, z] = s.slope;
        let [ca, cy, cz] = s.center(m);
        let (ey, ez) = (m.sub(cy, m.mul(y, ca)), m.sub(cz, m.mul(z, ca)));
        let ex = m.sub(m.mul(ey, z), m.mul(ez, y));
        let a = square(m, s.dir(m));
        let along = s.along(m);
        let wanted = m.sub(m.mul(a, square(m, [ca, cy, cz])), m.mul(along, along));
        Statement {
            steps: Vec::new(),
            assume: vec![],
            conclude: vec![(
                "|e|² is a |c|² less the square along the ray",
                same(m, square(m, [ey, ez, ex]), wanted),
            )],
        }
    }
}
const ONE: u32 = 0x3f80_0000;
const TWO: u32 = 0x4000_0000;

/// What is asked of the kernel.
enum What {
    /// A point of the ray is on the sphere.
    Possible,
    /// From outside it is the nearer of two.
    Root,
    /// From inside the farther.
    Far,
    /// What is certain from that side.
    Certain(Side),
    /// With nothing to bound the interval is the root, from that side; and what is behind is dropped.
    Sharp(Side),
    /// The line misses, seen from that side.
    Miss(Side),
    /// It is not known on which side the eye is.
    Unknown,
}

impl Theorem for What {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let s = scene(ask);
        let at = ask.number("A");
        let zero = m.splat(0.0);
        let (never, far) = (m.lt(zero, zero), m.splat(f32::INFINITY));
        let (a, along) = (square(m, s.dir(m)), s.along(m));
        let bounds = [s.bound.hit_above, s.bound.miss_below, s.bound.root].map(|x| m.splat(x));
        let [above, below, root] = bounds;
        let discriminant = {
            let distance = m.sub(m.mul(a, square(m, s.center(m))), m.mul(along, along));
            m.sub(m.mul(a, m.splat(s.rr)), distance)
        };
        let above = ("the bound of a hit is not negative", m.le(zero, above));
        let misses = ("that of a miss is not positive", m.le(below, zero));
        let wide = ("that of the root is not negative", m.le(zero, root));
        let touches = ("the point lies on the sphere", s.touches(m, at));
        let ahead = ("the point lies ahead", m.lt(zero, at));
        // The root itself, by the formula of the schools.
        let root_is = |side: Side| {
            let half = m.sqrt(discriminant);
            let sum = if side == Side::Outside { m.sub(along, half) } else { m.add(along, half) };
            ("the point is the root", same(m, m.mul(at, a), sum))
        };
        let (side, assume) = match self {
            Self::Possible => (Side::Unknown, vec![misses, touches]),
            Self::Root => {
                let nearer = ("it is the nearer of two", m.le(m.mul(at, a), along));
                (Side::Outside, vec![above, misses, wide, touches, ahead, nearer])
            }
            Self::Far => {
                let power = m.sub(square(m, s.center(m)), m.splat(s.rr));
                let inside = ("the eye is inside", m.lt(power, zero));
                (Side::Inside, vec![above, misses, wide, touches, ahead, inside])
            }
            Self::Certain(side) => {
                let mut assume = vec![above, wide, root_is(*side)];
                if *side == Side::Outside {
                    assume.push(misses);
                }
                (*side, assume)
            }
            Self::Sharp(side) => {
                let real = ("the line does not miss", m.le(zero, discriminant));
                let nothing = all(m, &bounds.map(|x| same(m, x, zero)));
                (*side, vec![("there is nothing to bound", nothing), real, root_is(*side)])
            }
            Self::Miss(side) => {
                (*side, vec![("the line misses by more than the bound", m.lt(discriminant, below))])
            }
            Self::Unknown => (Side::Unknown, vec![]),
        };
        let conclude = match (self, s.find(m, kernel, side)) {
            (Self::Certain(_), Some(found)) => vec![
                (touches.0, implies(m, found.certain, touches.1)),
                (ahead.0, implies(m, found.certain, ahead.1)),
            ],
            (Self::Sharp(_), Some(found)) => vec![
                ("the interval is a number", m.le(found.hi, found.lo)),
                ("what is behind is dropped", m.or(m.le(zero, at), m.not(found.possible))),
            ],
            (Self::Miss(_), Some(found)) => vec![("the sphere is not possibly hit", m.not(found.possible))],
            (Self::Unknown, Some(found)) => vec![
                ("no hit is certain", m.not(found.certain)),
                ("its root may lie anywhere", m.and(m.le(found.lo, zero), m.le(far, found.hi))),
            ],
            // Of what is missed nothing is certain.
            (Self::Certain(_) | Self::Miss(_) | Self::Unknown, None) => {
                vec![("nothing is claimed of a miss", m.not(never))]
            }
            (_, None) => vec![("the sphere is not missed", never)],
            (Self::Possible, Some(found)) => vec![("the sphere is possibly hit", found.possible)],
            (_, Some(found)) => vec![
                ("the sphere is possibly hit", found.possible),
                ("the point lies in the interval", m.and(m.le(found.lo, at), m.le(at, found.hi))),
            ],
        };
        let mut steps = Vec::new();
        if let Self::Far = self {
            let beyond = m.sub(m.mul(at, a), along);
            steps.push(("half the chord reaches from its middle to the point", {
                same(m, discriminant, m.mul(beyond, beyond))
            }));
            steps.push(("the point is beyond the middle", m.le(zero, beyond)));
        }
        Statement { steps, assume, conclude }
    }
}

/// On the axis, from 1 before it.
const AHEAD: &[(&str, u32)] = &[
    ("y", 0),
    ("z", 0),
    ("c A", TWO),
    ("c Y", 0),
    ("c Z", 0),
    ("r", ONE),
    ("rr", ONE),
    ("A", ONE),
    ("hit above", 0),
    ("miss below", 0),
    ("root", 0),
];
/// From the centre.
const INSIDE: &[(&str, u32)] = &[
    ("y", 0),
    ("z", 0),
    ("c A", 0),
    ("c Y", 0),
    ("c Z", 0),
    ("r", ONE),
    ("rr", ONE),
    ("A", ONE),
    ("hit above", 0),
    ("miss below", 0),
    ("root", 0),
];

/// Beside the ray.
const BESIDE: &[(&str, u32)] = &[
    ("y", 0),
    ("z", 0),
    ("c A", TWO),
    ("c Y", TWO),
    ("c Z", 0),
    ("rr", ONE),
    ("A", ONE),
    ("hit above", 0),
    ("miss below", 0),
    ("root", 0),
];

const UNKNOWN: &str = "optimized::certain::Rays::find, side unknown";

/// The lemmas.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    let lemma = |name, kernel, words, witness, statement| Lemma {
        name,
        words,
        kernel,
        numbers: Numbers::Real,
        whole: false,
        lanes: Lanes::Any,
        expected: Expected::Holds,
        long: false,
        witness,
        harmless: if kernel == UNKNOWN {
            &[
                (Wrong::Operation(4, Fault::FirstNumber), "1/a is used where the side is known"),
                (Wrong::Operation(22, Fault::Swapped), "a number is not below itself, either way"),
            ]
        } else if kernel == NONE {
            &[]
        } else {
            &[
                (Wrong::Operation(28, Fault::Border), "of two equal numbers either is the greater"),
                (Wrong::Operation(33, Fault::Border), "of two equal numbers either is the greater"),
                (Wrong::Operation(27, Fault::FirstNumber), "the bound of a miss is for rounding"),
                (Wrong::Operation(32, Fault::FirstNumber), "the bound of a hit is for rounding"),
                (Wrong::Operation(44, Fault::Border), "what touches is hit"),
                (Wrong::Operation(39, Fault::FirstNumber), "the bound of the root is for rounding"),
                (Wrong::Operation(40, Fault::FirstNumber), "the bound of the root is for rounding"),
                (Wrong::Operation(41, Fault::Border), "a root ahead has its upper end above 0"),
            ]
        },
        statement,
    };
    let find = "optimized::certain::Rays::find";
    vec![
        lemma(
            "find.line",
            NONE,
            "The f32 stage compares r² with the squared distance of the centre from the line, both times a",
            AHEAD,
            Box::new(Line),
        ),
        lemma(
            "find.possible",
            UNKNOWN,
            "Without rounding, a sphere that has a point of the ray ahead is possibly hit",
            AHEAD,
            Box::new(What::Possible),
        ),
        lemma(
            "find.unknown",
            UNKNOWN,
            "Where it is not known on which side of the surface the eye is, no hit is certain",
            AHEAD,
            Box::new(What::Unknown),
        ),
        lemma(
            "find.miss.unknown",
            UNKNOWN,
            "So it is where it is not known on which side the eye is",
            BESIDE,
            Box::new(What::Miss(Side::Unknown)),
        ),
        lemma(
            "find.miss",
            find,
            "Without rounding, a sphere that the line misses is not possibly hit",
            BESIDE,
            Box::new(What::Miss(Side::Outside)),
        ),
        lemma(
            "find.root",
            find,
            "Without rounding, the nearer root of a sphere seen from outside is the one that is found",
            AHEAD,
            Box::new(What::Root),
        ),
        lemma(
            "find.far",
            find,
            "Without rounding, the root ahead of a sphere seen from inside is the one that is found",
            INSIDE,
            Box::new(What::Far),
        ),
        lemma(
            "find.sharp.outside",
            find,
            "With nothing to bound, the interval of a root seen from outside is the root, and what is behind is dropped",
            AHEAD,
            Box::new(What::Sharp(Side::Outside)),
        ),
        lemma("find.sharp.inside", find, "So it is from inside", INSIDE, Box::new(What::Sharp(Side::Inside))),
        lemma(
            "find.certain.outside",
            find,
            "Without rounding, a hit that is certain from outside has the point that is found",
            AHEAD,
            Box::new(What::Certain(Side::Outside)),
        ),
        lemma(
            "find.certain.inside",
            find,
            "Without rounding, a hit that is certain from inside has the point that is found",
            INSIDE,
            Box::new(What::Certain(Side::Inside)),
        ),
    ]
}
