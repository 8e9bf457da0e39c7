//! From what f32 left open to the answer of the contract: id and correctly rounded t of each ray of a packet.
//!
//! In: [`Nearest`](crate::certain::Nearest) of a packet, the rays, and the spheres that any of them may hit. Three stages follow the f32 one, each for what
//! the one before could not decide:
//!
//! 1. An unmarked ray has its sphere; t is asked of f64 ([`crate::double`]) for the whole packet at once.
//! 2. A marked ray asks f64 about all those spheres, and about t. (A sphere that is not among them is missed for certain, or lies
//!    in a slice that the walk did not need to visit, hence behind the nearest certain hit.)
//! 3. Where f64 does not know which sphere or which f32, integers do ([`crate::exact`]).

use crate::double::{self, Answer};
use crate::exact;
use crate::machine::{Chore, LANES, Machine, Site, three};
use crate::seen::Counts;
use crate::shade::Surface;
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

/// t and sphere of each ray; +∞ and [`NONE`] for a miss.
#[derive(Clone, Copy)]
pub struct Answers<M: Machine> {
    /// Correctly rounded.
    pub t: M::F,
    /// Exact.
    pub owners: Owners<M>,
}

impl<M: Machine> Answers<M> {
    /// With the spheres of those ids.
    #[inline(always)]
    pub fn new(m: M, t: M::F, id: M::I, spheres: &[Sphere]) -> Self {
        let hits = m.to_bits(m.lt_i(id, m.splat_i(NONE)));
        let owners = Owners::of(
            m,
            id,
            hits,
            #[inline(always)]
            |id| Owner { id, sphere: &spheres[id.unsigned_abs() as usize], error: f32::INFINITY },
        );
        Self { t, owners }
    }
}

/// What a ray's sphere has to give, one a lane.
#[derive(Clone, Copy)]
pub struct Owners<M: Machine> {
    /// Its id.
    pub id: M::I,
    /// What it looks like.
    pub surface: Surface<M>,
    /// The relative error of t by the short way ([`double::short_error`]).
    error: M::F,
}

/// A sphere that a ray hits, by the number that the packet knows it by.
#[derive(Clone, Copy, Debug)]
pub struct Owner<'a> {
    /// Its id.
    pub id: i32,
    /// The sphere.
    pub sphere: &'a Sphere,
    /// The relative error of t by the short way ([`double::short_error`]).
    pub error: f32,
}

impl<M: Machine> Owners<M> {
    /// No lane has one.
    #[inline(always)]
    fn none(m: M) -> Self {
        let zero = m.splat(0.0);
        let surface = Surface { center: [zero; 3], radius: m.splat(1.0), color: [zero; 3] };
        Self { id: m.splat_i(NONE), surface, error: m.splat(f32::INFINITY) }
    }

    /// The owners of the lanes `rest`, whose numbers are given.
    #[inline(always)]
    fn of<'a>(m: M, numbers: M::I, mut rest: u32, owner: impl Fn(i32) -> Owner<'a>) -> Self {
        let (mut owners, each) = (Self::none(m), m.to_array_i(numbers));
        while rest != 0 {
            let number = each[rest.trailing_zeros() as usize];
            m.beside(
                Chore::Owner,
                #[inline(always)]
                || (),
            );
            let Owner { id, sphere, error } = owner(number);
            let same = same(m, numbers, number);
            let s = &mut owners.surface;
            for i in 0..3 {
                s.center[i] = m.select(same, m.splat(sphere.center[i]), s.center[i]);
                s.color[i] = m.select(same, m.splat(f32::from(sphere.color[i])), s.color[i]);
            }
            s.radius = m.select(same, m.splat(sphere.radius), s.radius);
            owners.error = m.select(same, m.splat(error), owners.error);
            owners.id = m.select_i(same, m.splat_i(id), owners.id);
            rest &= !m.to_bits(same);
            m.branch(rest != 0, Site::NextOwner);
        }
        owners
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
    /// Settles the lanes whose bits are set in `wanted`; the others stay misses. Of the lanes that are not `marked` the sphere is
    /// known, or that there is none, by a number that `owner` understands; `possible` are the ids of all spheres that a marked lane may hit.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "all of it differs from packet to packet")]
    pub fn settle<'b, M: Machine>(
        &self,
        m: M,
        numbers: M::I,
        marked: u32,
        owner: impl Fn(i32) -> Owner<'b>,
        possible: &[u32],
        wanted: u32,
        counts: &mut Counts,
    ) -> Answers<M> {
        counts.lanes += u64::from(wanted.count_ones());
        let hit = m.lt_i(numbers, m.splat_i(NONE));
        let hits = m.to_bits(hit) & wanted & !marked;
        if hits | marked == 0 {
            return Answers { t: m.splat(f32::INFINITY), owners: Owners::none(m) };
        }
        let owners = Owners::of(m, numbers, hits, owner);
        let Surface { center, radius, .. } = owners.surface;
        let center = three(
            center,
            #[inline(always)]
            |x| m.to_array(x),
        );
        let [lo, hi] = double::short_ends::<f64>(
            self.eye,
            &self.dir,
            &center,
            &m.to_array(radius),
            &m.to_array(owners.error),
        );
        let [lo, hi] = [m.lanes(lo), m.lanes(hi)];
        let settled = m.and(m.le(lo, hi), m.le(hi, lo));
        let unsettled = hits & !m.to_bits(settled);
        let t = m.select(m.lt_i(owners.id, m.splat_i(NONE)), lo, m.splat(f32::INFINITY));
        let mut answers = Answers { t, owners };
        if unsettled | marked != 0 {
            let (mut t, mut id) = (m.to_array(answers.t), m.to_array_i(answers.owners.id));
            let integers = self.finish(marked, unsettled, possible, &mut t, &mut id, counts);
            m.beside(
                Chore::Settled { marked, only_t: unsettled, integers },
                #[inline(always)]
                || (),
            );
            answers = Answers::new(m, m.lanes(t), m.lanes_i(id), self.spheres);
        }
        answers
    }

    /// Settles what is left, lane by lane; the lanes for which integers were asked.
    #[cold]
    fn finish(
        &self,
        marked: u32,
        unsettled: u32,
        possible: &[u32],
        t: &mut [f32; LANES],
        id: &mut [i32; LANES],
        counts: &mut Counts,
    ) -> u32 {
        let mut integers = 0;
        for lane in 0..LANES {
            let before = counts.by_integers();
            if marked >> lane & 1 != 0 {
                counts.asked_f64 += 1;
                (t[lane], id[lane]) = self.by_f64(lane, possible, counts);
            } else if unsettled >> lane & 1 != 0 {
                t[lane] = self.root_of(lane, id[lane].unsigned_abs(), counts);
            }
            integers |= u32::from(counts.by_integers() != before) << lane;
        }
        integers
    }

    /// The t of a sphere that is certainly hit.
    #[cold]
    fn root_of(&self, lane: usize, id: u32, counts: &mut Counts) -> f32 {
        let sphere = &self.spheres[id as usize];
        let [t, above] =
            double::root::<f64>(self.eye, self.direction(lane), sphere.center, sphere.radius).ends();
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
        let ask = |&id: &u32| match double::ask::<f64>(eye, dir, &self.spheres[id as usize]) {
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
