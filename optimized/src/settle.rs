//! From what f32 left open to the answer of the contract: id and correctly rounded t of each ray of a packet.
//!
//! In: [`Nearest`] of a packet, the rays, and the spheres that any of them may hit. Three stages follow the f32 one, each for what
//! the one before could not decide:
//!
//! 1. An unmarked ray has its sphere; t is asked of f64 ([`crate::double`]) for the whole packet at once.
//! 2. A marked ray asks f64 about all those spheres, and about t. (A sphere that is not among them is missed for certain, or lies
//!    in a slice that the walk did not need to visit, hence behind the nearest certain hit.)
//! 3. Where f64 does not know which sphere or which f32, integers do ([`crate::exact`]).

use crate::certain::Nearest;
use crate::double::{self, Answer, Apart, Directions};
use crate::exact;
use crate::machine::{LANES, Machine};
use crate::seen::Counts;
use crate::sphere::NONE;
use contract::Sphere;

/// Rays of a packet as numbers, and the spheres of the scene.
#[derive(Clone, Copy)]
pub struct Question<'a> {
    /// Where all rays start.
    pub eye: [f32; 3],
    /// Directions, by axis and lane.
    pub dir: [[f32; LANES]; 3],
    /// All spheres, by id.
    pub spheres: &'a [Sphere],
}

/// t and id of each ray; +∞ and [`NONE`] for a miss.
#[derive(Clone, Copy)]
pub struct Answers<M: Machine> {
    /// Correctly rounded.
    pub t: M::F,
    /// Exact.
    pub id: M::I,
}

impl<M: Machine> Answers<M> {
    /// All miss.
    #[inline(always)]
    pub fn none(m: M) -> Self {
        Self { t: m.splat(f32::INFINITY), id: m.splat_i(NONE) }
    }
}

/// All lanes.
pub const ALL: u32 = (1 << LANES) - 1;

/// Kernel: the lanes that hold that id.
#[inline(always)]
pub fn same<M: Machine>(m: M, ids: M::I, id: i32) -> M::B {
    let id = m.splat_i(id);
    m.not(m.or(m.lt_i(ids, id), m.lt_i(id, ids)))
}

impl Question<'_> {
    /// Settles the lanes whose bits are set in `wanted`; the others stay misses.
    #[inline(always)]
    pub fn settle<M: Machine>(
        &self,
        m: M,
        nearest: &Nearest<M>,
        candidates: &[u32],
        wanted: u32,
        counts: &mut Counts,
    ) -> Answers<M> {
        let mut answers = Answers::none(m);
        counts.lanes += u64::from(wanted.count_ones());
        let marked = m.to_bits(nearest.marked(m)) & wanted;
        let mut unsettled = marked;
        let mut rest = m.to_bits(m.lt_i(nearest.id, m.splat_i(NONE))) & wanted & !marked;
        if rest != 0 {
            let (rays, ids) = (Directions::new(&self.dir), m.to_array_i(nearest.id));
            while rest != 0 {
                let id = ids[rest.trailing_zeros() as usize];
                let same = same(m, nearest.id, id);
                if let Some(apart) = Apart::new(self.eye, &self.spheres[id.unsigned_abs() as usize]) {
                    let [lo, hi] = apart.ends(&rays);
                    let [lo, hi] = [m.lanes(lo), m.lanes(hi)];
                    unsettled |= rest & m.to_bits(m.and(same, m.lt(lo, hi)));
                    answers.t = m.select(same, lo, answers.t);
                } else {
                    unsettled |= rest & m.to_bits(same);
                }
                answers.id = m.select_i(same, m.splat_i(id), answers.id);
                rest &= !m.to_bits(same);
            }
        }
        if unsettled != 0 || wanted != ALL {
            self.finish(m, nearest, marked, unsettled, wanted, candidates, &mut answers, counts);
        }
        answers
    }

    /// Settles what is left, lane by lane, and makes misses of what is not wanted.
    #[inline(never)]
    #[allow(clippy::too_many_arguments, reason = "the state of `settle`")]
    fn finish<M: Machine>(
        &self,
        m: M,
        nearest: &Nearest<M>,
        marked: u32,
        unsettled: u32,
        wanted: u32,
        candidates: &[u32],
        answers: &mut Answers<M>,
        counts: &mut Counts,
    ) {
        let (mut t, mut id) = (m.to_array(answers.t), m.to_array_i(answers.id));
        let nearest = m.to_array_i(nearest.id);
        for lane in 0..LANES {
            let has = |bits: u32| bits >> lane & 1 != 0;
            if has(marked) {
                counts.asked_f64 += 1;
                (t[lane], id[lane]) = self.by_f64(lane, candidates, counts);
            } else if has(unsettled) {
                t[lane] = self.root_of(lane, nearest[lane].unsigned_abs(), counts);
            } else if !has(wanted) {
                (t[lane], id[lane]) = (f32::INFINITY, NONE);
            }
        }
        *answers = Answers { t: m.lanes(t), id: m.lanes_i(id) };
    }

    /// The t of a sphere that is certainly hit.
    #[cold]
    fn root_of(&self, lane: usize, id: u32, counts: &mut Counts) -> f32 {
        let sphere = &self.spheres[id as usize];
        let [t, above] = double::root(self.eye, self.direction(lane), sphere.center, sphere.radius).ends();
        if t.to_bits() == above.to_bits() { t } else { self.round_exactly(lane, id, counts) }
    }

    #[inline(always)]
    fn direction(&self, lane: usize) -> [f32; 3] {
        [self.dir[0][lane], self.dir[1][lane], self.dir[2][lane]]
    }

    /// The nearest of the candidates, which may hold a sphere more than once.
    #[cold]
    fn by_f64(&self, lane: usize, candidates: &[u32], counts: &mut Counts) -> (f32, i32) {
        let (eye, dir) = (self.eye, self.direction(lane));
        let ask = |&id: &u32| match double::ask(eye, dir, &self.spheres[id as usize]) {
            Answer::Miss => None,
            Answer::Hit(t) => Some((id, t)),
            Answer::Undecided => Some((id, [0.0, f64::INFINITY])),
        };
        let possible: Vec<(u32, [f64; 2])> = candidates.iter().filter_map(ask).collect();
        let nearest = possible.iter().map(|(_, [_, hi])| *hi).fold(f64::INFINITY, f64::min);
        let rest = possible.iter().filter(|(_, [lo, _])| *lo <= nearest);
        let Some(&(lowest, [_, hi])) = rest.clone().min_by_key(|(id, _)| *id) else {
            return (f32::INFINITY, NONE);
        };
        // One sphere, or the same several times, which the lowest id has.
        let sphere = &self.spheres[lowest as usize];
        let same = |other: &Sphere| (other.center, other.radius) == (sphere.center, sphere.radius);
        if hi.is_finite() && rest.clone().all(|&(id, _)| same(&self.spheres[id as usize])) {
            return (self.root_of(lane, lowest, counts), lowest.cast_signed());
        }
        counts.asked_integers += 1;
        let found = exact::nearest(eye, dir, rest.map(|&(id, _)| (id, &self.spheres[id as usize])));
        found.map_or((f32::INFINITY, NONE), |(id, t)| (t, id.cast_signed()))
    }

    /// The t of a sphere that is certainly hit.
    #[cold]
    fn round_exactly(&self, lane: usize, id: u32, counts: &mut Counts) -> f32 {
        counts.rounded_by_integers += 1;
        let sphere = std::iter::once((id, &self.spheres[id as usize]));
        let (_, t) =
            exact::nearest(self.eye, self.direction(lane), sphere).expect("the sphere is certainly hit");
        t
    }
}
