//! Claim: slices and culling lose no sphere that a ray of the packet hits: *hit => visible*, joined from what is proved elsewhere.
//!
//! Let a ray of a packet hit a sphere, P = eye + t d be the point that is reported, and R the sphere's reach. Then its cell is visited, lists the
//! sphere, and culling keeps it. Step by step, with what each rests on:
//!
//! 1. *|P − c| <= R.* By derivation in [`optimized::margin`]; for the certified plan R is the radius, and P is on the sphere. (By hand;
//!    sampled by `tests/visible.rs`.)
//! 2. *P lies in the ball's box.* Its ends are c − R and c + R, rounded to nearest and then one f32 outward: beyond the real number, since
//!    rounding to nearest stops at one of its two neighbours. (By the definition of rounding.)
//! 3. *The cell of P is one of the box's.* The cell map is monotone over all f32, for every grid, and a real point's cell goes by the
//!    map's planes: `cell.monotone`, `cell.between`. (Proved, with one step, a rounded product's order, by definition.)
//! 4. *The cell lists the sphere.* Box ranges list all of the box's cells; eight corners do unless a box spans three cells, which is
//!    an event: `cell.corners`. (Proved; certified in each run.) A queue keeps what is pushed until the seventeenth: `queue.push`, which
//!    is an event too. (Proved; certified in each run.)
//! 5. *The slice's rectangle has the cell.* Of the real numbers the packet's extent holds P: `visible.slice`; listed by centre, it holds the
//!    centre, which is within the widening of P: `visible.slice.widened`. (Proved.) With rounding, the pad covers it: all inputs
//!    of small floats in `tests/margins.rs`. (Exhausted.) Ends and map are one, by step 3.
//! 6. *The walk comes to it.* All cells of all rectangles are visited in order: `walk.successor`, `walk.empty`, `walk.forward`. (Proved.) It ends early
//!    only behind the nearest hit, by derivation in [`optimized::walk`]. (By hand.)
//! 7. *Culling keeps it.* Of the real numbers, a ball that holds a point of the frustum is outside none of its four planes:
//!    `visible.planes`. (Proved.) With rounding, the margin covers it: `tests/margins.rs`. (Exhausted.)

use super::le_all;
use crate::prove::broken::Fault;
use crate::prove::smt::Numbers;
use crate::prove::symbolic::Lanes;
use crate::prove::theorem::{Ask, Expected, Lemma, Statement, Theorem, Wrong};
use optimized::cull::Planes;
use optimized::frustum::{Extent, Frustum, Heading};
use optimized::machine::Machine;
use optimized::plan::Margins;

/// A frustum of any slopes, and a ray in it.
fn frustum<M: Machine>(ask: &mut impl Ask<M>) -> ([[M::F; 2]; 2], [M::F; 2]) {
    let slopes = [["lo Y", "hi Y"], ["lo Z", "hi Z"]].map(|side| side.map(|name| ask.number(name)));
    (slopes, ["y", "z"].map(|name| ask.number(name)))
}

/// Whether a point of the frustum lies in a slice's extent.
struct Slice {
    /// Spheres are listed by centre, as far from the point as that.
    widened: bool,
}

impl Theorem for Slice {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let ([[lo, hi], side], [slope, _]) = frustum::<M>(ask);
        let (near, far, eye) = (ask.number("near"), ask.number("far"), ask.plain("eye"));
        let at = ask.number("A");
        let zero = m.splat(0.0);
        let position = m.add(m.splat(eye), m.mul(at, slope));
        let mut assume = vec![
            ("the ray lies in the frustum", m.and(m.le(lo, slope), m.le(slope, hi))),
            ("the point lies ahead", m.le(zero, at)),
        ];
        let frustum = Frustum::<K> { heading: Heading::new(0, true), slopes: [[lo, hi], side] };
        let widen = if self.widened { ask.plain("widen") } else { 0.0 };
        let (along, across) = if self.widened {
            let [along, across] = ["centre A", "centre Y"].map(|name| ask.number(name));
            let reach = m.splat(widen);
            let close = |x: M::F, y: M::F| m.and(m.le(m.sub(x, reach), y), m.le(y, m.add(x, reach)));
            assume.push(("the centre is as near on the major axis", close(at, along)));
            assume.push(("and on the minor one", close(position, across)));
            (along, across)
        } else {
            (at, position)
        };
        assume.push(("it lies in the slice", m.and(m.le(near, along), m.le(along, far))));
        let Extent { low, high, behind } = frustum.extent(kernel, 0, eye, widen, near, far, 0.0);
        Statement {
            steps: Vec::new(),
            assume,
            conclude: vec![
                ("the slice is not behind", m.not(behind)),
                ("its extent reaches from below", m.le(low, across)),
                ("to above", m.le(across, high)),
            ],
        }
    }
}

/// Whether culling drops a ball that lies outside a plane.
struct Drops;

impl Theorem for Drops {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (slopes, _) = frustum::<M>(ask);
        let center = ["c A", "c Y", "c Z"].map(|name| ask.number(name));
        let radius = ask.number("R");
        let (zero, one, lo) = (m.splat(0.0), m.splat(1.0), slopes[0][0]);
        let across = m.sub(center[1], m.mul(lo, center[0]));
        let square = m.mul(m.mul(radius, radius), m.add(one, m.mul(lo, lo)));
        let frustum = Frustum::<K> { heading: Heading::new(0, true), slopes };
        let culled = Planes::<K>::new(kernel, &frustum, Margins::None).cull(kernel, center, radius);
        let never = m.lt(zero, zero);
        Statement {
            steps: Vec::new(),
            assume: vec![
                ("the centre lies outside the lower plane along Y", m.lt(across, zero)),
                ("farther than the radius", m.lt(square, m.mul(across, across))),
            ],
            conclude: vec![("the ball is dropped", if culled { m.not(never) } else { never })],
        }
    }
}

/// Whether culling keeps a ball with a point in the frustum.
struct Keeps;

impl Theorem for Keeps {
    fn state<M: Machine, K: Machine<F = M::F, I = M::I, B = M::B>>(
        &self,
        m: M,
        kernel: K,
        ask: &mut impl Ask<M>,
    ) -> Statement<M::B> {
        let (slopes, [y, z]) = frustum::<M>(ask);
        let [[lo_y, hi_y], [lo_z, hi_z]] = slopes;
        let center = ["c A", "c Y", "c Z"].map(|name| ask.number(name));
        let (radius, at) = (ask.number("R"), ask.number("A"));
        let (zero, one) = (m.splat(0.0), m.splat(1.0));
        let away = [m.sub(at, center[0]), m.sub(m.mul(at, y), center[1]), m.sub(m.mul(at, z), center[2])];
        let frustum = Frustum::<K> { heading: Heading::new(0, true), slopes };
        let planes = Planes::<K>::new(kernel, &frustum, Margins::None);
        let culled = planes.cull(kernel, center, radius);
        let never = m.lt(zero, zero);
        // The planes, one a lane: how far beyond each the point is of the centre, on its normal (along, across).
        let along =
            m.lanes_of_four([-ask.plain("lo Y"), ask.plain("hi Y"), -ask.plain("lo Z"), ask.plain("hi Z")]);
        let across = m.add(
            m.mul(m.lanes_of_four([1.0, -1.0, 0.0, 0.0]), away[1]),
            m.mul(m.lanes_of_four([0.0, 0.0, 1.0, -1.0]), away[2]),
        );
        let beyond = m.add(m.mul(along, away[0]), across);
        let normal = m.add(one, m.mul(along, along));
        let reach = m.mul(m.sqrt(normal), radius);
        let in_plane = m.add(m.mul(away[0], away[0]), m.mul(across, across));
        let square = m.mul(beyond, beyond);
        Statement {
            assume: vec![
                ("the ray lies in the frustum", le_all(m, &[[lo_y, y], [y, hi_y], [lo_z, z], [z, hi_z]])),
                ("the point lies ahead", m.le(zero, at)),
                ("the radius is not negative", m.le(zero, radius)),
                ("the point lies in the ball", m.le(m.dot(away, away), m.mul(radius, radius))),
            ],
            steps: vec![
                ("a product of vectors is at most that of their lengths (Cauchy, Schwarz)", {
                    m.le(square, m.mul(normal, in_plane))
                }),
                ("the point is within R of the centre, across the plane's own axis", {
                    m.le(in_plane, m.mul(radius, radius))
                }),
                ("so its square is at most that of the reach", m.le(square, m.mul(reach, reach))),
                ("and it is at most the reach", m.le(beyond, reach)),
            ],
            conclude: vec![("the ball is kept", if culled { never } else { m.not(never) })],
        }
    }
}

const ONE: u32 = 0x3f80_0000;
const TWO: u32 = 0x4000_0000;
const HALF: u32 = 0x3f00_0000;

const EXTENT: &str = "optimized::frustum::Frustum::extent";
const PLANES: &str = "optimized::cull::Planes";
const LONGER: &str = "a slice that begins behind the eye is longer and holds no less";

/// The lemmas.
#[must_use]
pub fn lemmas() -> Vec<Lemma> {
    let lemma = |name, kernel, words, lanes, witness, statement| Lemma {
        name,
        words,
        kernel,
        numbers: Numbers::Real,
        whole: false,
        lanes,
        expected: Expected::Holds,
        long: false,
        witness,
        harmless: match kernel {
            EXTENT => &[
                (Wrong::Operation(3, Fault::Border), "of two equal ends either is the greater"),
                (Wrong::Operation(3, Fault::Swapped), LONGER),
                (Wrong::Operation(4, Fault::OtherArm), LONGER),
                (Wrong::Operation(5, Fault::OtherSign), "the pad is for rounding, and 0 here"),
                (Wrong::Operation(5, Fault::FirstNumber), "the pad is for rounding, and 0 here"),
                (Wrong::Operation(8, Fault::Border), "of two equal ends either is the lesser"),
                (Wrong::Operation(14, Fault::Border), "of two equal ends either is the greater"),
            ],
            PLANES => &[(
                Wrong::Operation(3, Fault::FirstNumber),
                "what makes a normal longer is for rounding, and 1 here",
            )],
            _ => &[],
        },
        statement,
    };
    let slice: &[(&str, u32)] = &[
        ("lo Y", 0xbf00_0000),
        ("hi Y", HALF),
        ("lo Z", 0),
        ("hi Z", 0),
        ("y", 0),
        ("z", 0),
        ("near", ONE),
        ("far", TWO),
        ("eye", HALF),
        ("A", ONE),
        ("widen", HALF),
        ("centre A", ONE),
        ("centre Y", HALF),
    ];
    vec![
        lemma(
            "visible.slice",
            EXTENT,
            "Without rounding, a slice's extent holds every point ahead that a ray of the packet has in the slice",
            Lanes::Any,
            slice,
            Box::new(Slice { widened: false }),
        ),
        lemma(
            "visible.slice.widened",
            EXTENT,
            "Without rounding, it holds every centre in the slice that is within the widening of a ray's point ahead",
            Lanes::Any,
            slice,
            Box::new(Slice { widened: true }),
        ),
        lemma(
            "visible.planes.drop",
            PLANES,
            "Without rounding, culling drops every ball that lies wholly outside a plane",
            Lanes::Four,
            &[
                ("lo Y", 0),
                ("hi Y", HALF),
                ("lo Z", 0),
                ("hi Z", HALF),
                ("y", HALF),
                ("z", 0),
                ("c A", ONE),
                ("c Y", 0xc000_0000),
                ("c Z", 0),
                ("R", ONE),
            ],
            Box::new(Drops),
        ),
        lemma(
            "visible.planes",
            PLANES,
            "Without rounding, culling keeps every ball that holds a point of a ray ahead",
            Lanes::Four,
            &[
                ("lo Y", 0),
                ("hi Y", HALF),
                ("lo Z", 0),
                ("hi Z", HALF),
                ("y", HALF),
                ("z", 0),
                ("c A", ONE),
                ("c Y", ONE),
                ("c Z", 0),
                ("R", ONE),
                ("A", ONE),
            ],
            Box::new(Keeps),
        ),
    ]
}
