//! Claim: without its roundings the f32 stage decides rightly. Its roundings are bounded in [`optimized::bound`], for every unit
//! roundoff below 1/8, and run over all inputs of domains of small floats in `tests/bound.rs`.
//!
//! The shipped [`Rays::find`](optimized::certain::Rays::find) runs on real numbers here, with a bound of zero: a ray (1, y, z) in distances A along the
//! packet's major axis, a ball of radius r about c, both relative to the eye.
//!
//! - `find.line`: what it compares r² with is the squared distance of the centre from the line, times a = 1 + y² + z² (Lagrange's identity).
//! - `find.possible`: if any point of the ray lies on the sphere, it is possibly hit.
//! - `find.root`: from outside, the nearest such point lies in the interval that it gives; `find.far`: from inside, the only one ahead.
//! - `find.certain`: what it calls certain has such a point.

use super::{NONE, same};
use crate::prove::smt::Numbers;
use crate::prove::symbolic::Lanes;
use crate::prove::theorem::{Ask, Expected, Lemma, Statement, Theorem};
use optimized::bound::Bound;
use optimized::certain::{Ball, Rays, Side};
use optimized::machine::Machine;

const ZERO: Bound = Bound { hit_above: 0.0, miss_below: 0.0, root: 0.0 };

/// A ray and a ball.
struct Scene<M: Machine> {
    slope: [M::F; 2],
    center: [f32; 3],
    radius: M::F,
    rr: f32,
}

fn scene<M: Machine>(ask: &mut impl Ask<M>) -> Scene<M> {
    Scene {
        slope: [ask.number("y"), ask.number("z")],
        center: ["c A", "c Y", "c Z"].map(|name| ask.plain(name)),
        radius: ask.number("r"),
        rr: ask.plain("rr"),
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

    /// The radius and its square.
    fn round(&self, m: M) -> (&'static str, M::B) {
        let positive = m.lt(m.splat(0.0), self.radius);
        let rr = m.splat(self.rr);
        ("rr is the square of a radius", m.and(positive, same(m, rr, m.mul(self.radius, self.radius))))
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
    ) -> Option<[M::F; 2]> {
        let rays = Rays::<K>::new(kernel, self.slope);
        let ball = Ball { center: self.center, rr: self.rr, bound: ZERO, side };
        let everywhere = m.le(m.splat(0.0), m.splat(0.0));
        rays.find(kernel, &ball, everywhere).map(|found| [found.lo, found.hi])
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
        let (a, along) = (square(m, s.dir(m)), s.along(m));
        let power = m.sub(square(m, s.center(m)), m.splat(s.rr));
        let mut assume = vec![
            s.round(m),
            ("the point lies on the sphere", s.touches(m, at)),
            ("and ahead", m.lt(zero, at)),
        ];
        let side = match self {
            Self::Possible => Side::Unknown,
            Self::Root => {
                assume.push(("the eye is outside", m.lt(zero, power)));
                assume.push(("it is the nearer of two", m.le(m.mul(at, a), along)));
                Side::Outside
            }
            Self::Far => {
                assume.push(("the eye is inside", m.lt(power, zero)));
                Side::Inside
            }
        };
        let found = s.find(m, kernel, side);
        let never = m.lt(zero, zero);
        let conclude = match (self, found) {
            (_, None) => vec![("the sphere is not missed", never)],
            (Self::Possible, Some(_)) => vec![("the sphere is possibly hit", m.not(never))],
            (_, Some([lo, hi])) => {
                vec![("the point lies in the interval", m.and(m.le(lo, at), m.le(at, hi)))]
            }
        };
        Statement { assume, conclude }
    }
}

/// On the axis, from 1 before it.
const AHEAD: &[(&str, u32)] =
    &[("y", 0), ("z", 0), ("c A", TWO), ("c Y", 0), ("c Z", 0), ("r", ONE), ("rr", ONE), ("A", ONE)];
/// From the centre.
const INSIDE: &[(&str, u32)] =
    &[("y", 0), ("z", 0), ("c A", 0), ("c Y", 0), ("c Z", 0), ("r", ONE), ("rr", ONE), ("A", ONE)];

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
        harmless: &[],
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
            find,
            "Without rounding, a sphere that has a point of the ray ahead is possibly hit",
            AHEAD,
            Box::new(What::Possible),
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
    ]
}
