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
use crate::double::{self, Answer};
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
#[derive(Clone, Copy, Debug)]
pub struct Answers {
    /// Correctly rounded.
    pub t: [f32; LANES],
    /// Exact.
    pub id: [i32; LANES],
}

impl Answers {
    /// All miss.
    pub const NONE: Self = Self { t: [f32::INFINITY; LANES], id: [NONE; LANES] };
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
    ) -> Answers {
        let mut answers = Answers { id: m.to_array_i(nearest.id), ..Answers::NONE };
        let (one, zero) = (m.splat_i(1), m.splat_i(0));
        let marked = m.to_array_i(m.select_i(nearest.marked(m), one, zero));
        counts.lanes += u64::from(wanted.count_ones());
        let rounded = self.round(&answers.id);
        for lane in 0..LANES {
            if wanted >> lane & 1 == 0 {
                answers.id[lane] = NONE;
            } else if marked[lane] != 0 {
                counts.asked_f64 += 1;
                (answers.t[lane], answers.id[lane]) = self.by_f64(lane, candidates, counts);
            } else if answers.id[lane] != NONE {
                let [t, above] = [rounded[0][lane], rounded[1][lane]];
                let id = answers.id[lane].unsigned_abs();
                let certain = t.to_bits() == above.to_bits();
                answers.t[lane] = if certain { t } else { self.round_exactly(lane, id, counts) };
            }
        }
        answers
    }

    /// Lower and upper end of the t of the spheres of those ids, one a lane, rounded to f32; anything where there is none.
    /// Gathered first, so that what follows are straight loops, which become vectors.
    #[inline(always)]
    fn round(&self, ids: &[i32; LANES]) -> [[f32; LANES]; 2] {
        let (mut center, mut radius) = ([[0.0; LANES]; 3], [1.0; LANES]);
        for lane in 0..LANES {
            if let Some(sphere) = self.spheres.get(ids[lane].unsigned_abs() as usize) {
                (center[0][lane], center[1][lane]) = (sphere.center[0], sphere.center[1]);
                (center[2][lane], radius[lane]) = (sphere.center[2], sphere.radius);
            }
        }
        let mut ends = [[0.0; LANES]; 2];
        for lane in 0..LANES {
            let center = [center[0][lane], center[1][lane], center[2][lane]];
            let root = double::root(self.eye, self.direction(lane), center, radius[lane]);
            let [lo, hi] = root.ends();
            (ends[0][lane], ends[1][lane]) = (lo, hi);
        }
        ends
    }

    #[inline(always)]
    fn direction(&self, lane: usize) -> [f32; 3] {
        [self.dir[0][lane], self.dir[1][lane], self.dir[2][lane]]
    }

    /// The nearest of the candidates, which may hold a sphere more than once.
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
            let root = double::root(eye, dir, sphere.center, sphere.radius);
            let [t, above] = root.ends();
            let certain = t.to_bits() == above.to_bits();
            let t = if certain { t } else { self.round_exactly(lane, lowest, counts) };
            return (t, lowest.cast_signed());
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
