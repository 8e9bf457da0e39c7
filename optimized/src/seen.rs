//! A frame's scene as seen from its camera: what is made once a frame and read by every packet. Spheres relative to
//! the eye, their radii for culling and the bounds on their rounding, and the grid. And a packet's way through it.

use crate::bound::{Bound, Rule};
use crate::camera::Block;
use crate::certain::{self, Ball, Rays, Side};
use crate::crew::Crew;
use crate::cull::{self, Planes};
use crate::double;
use crate::event::{Event, Events, RenderError};
use crate::frustum::{Bundle, Heading, Slices, beyond};
use crate::grid::{Bounds, Grid, Memory, limit};
use crate::machine::{Chore, LANES, Machine, Site, Stage, three};
use crate::margin;
use crate::plan::{Arithmetic, Cells, Culling, Margins, OnEvent, Packet, Plan, Voxelizer};
use crate::settle::{ALL, Answers, Owner, Question};
use crate::sphere::{Form, NONE, Nearest, Prepared};
use crate::tile;
use crate::walk::{Visitor, walk};
use contract::{Camera, Scene, Sphere};

/// What all packets of a frame read.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The eye.
    pub eye: [f32; 3],
    /// The plan.
    pub plan: Plan,
    /// The spheres relative to the eye, by id; none where tiles prepare what they need.
    pub spheres: Vec<Prepared>,
    /// Their bounds and the eye's side, if the plan's arithmetic is certified.
    pub bounds: Vec<(Bound, Side)>,
    /// The spheres relative to the eye in the SPU's arithmetic, if the plan has it.
    pub on_spu: Vec<Prepared>,
    /// The grid; `None` if there is nothing to hit, or if margins are wanted for a scene for which there are none: then
    /// every sphere is met by every ray.
    pub grid: Option<Grid>,
}

/// What tracing cost, what culling saved, and how far the certified stages were needed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cells visited by packets.
    pub cells: u64,
    /// Spheres found in them, each time.
    pub candidates: u64,
    /// Of these, dropped by the frustum's planes; the others were intersected with sixteen rays.
    pub culled: u64,
    /// Blocks whose rays went one by one for want of a common major axis.
    pub split_blocks: u64,
    /// Lanes answered by certified arithmetic.
    pub lanes: u64,
    /// Of these, marked by f32, so that f64 was asked about every sphere that may be hit.
    pub asked_f64: u64,
    /// Of these, not decided by f64, so that integers were asked.
    pub asked_integers: u64,
    /// Lanes whose sphere was certain, while only integers knew to which f32 its t is rounded.
    pub rounded_by_integers: u64,
}

/// What a worker keeps from packet to packet.
#[derive(Clone, Debug, Default)]
pub struct Worker {
    /// What its packets cost.
    pub counts: Counts,
    /// Ids of spheres that some ray of the packet may hit, some more than once; kept for its memory.
    possible: Vec<u32>,
}

impl Counts {
    /// Lanes for which integers were asked, for the sphere or for the rounding of t.
    #[must_use]
    pub fn by_integers(&self) -> u64 {
        self.asked_integers + self.rounded_by_integers
    }
}

impl std::ops::Add for Counts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            cells: self.cells + other.cells,
            candidates: self.candidates + other.candidates,
            culled: self.culled + other.culled,
            split_blocks: self.split_blocks + other.split_blocks,
            lanes: self.lanes + other.lanes,
            asked_f64: self.asked_f64 + other.asked_f64,
            asked_integers: self.asked_integers + other.asked_integers,
            rounded_by_integers: self.rounded_by_integers + other.rounded_by_integers,
        }
    }
}

impl Seen {
    /// Prepares spheres and builds the grid; for tiles, all workers do.
    ///
    /// # Errors
    /// [`RenderError`] if the plan cannot be followed, or refuses what the scene does.
    pub fn new<M: Machine + Send + Sync>(
        m: M,
        plan: Plan,
        scene: &Scene,
        camera: &Camera,
        memory: &mut Memory,
        events: &mut Events,
        crew: &Crew,
    ) -> Result<Self, RenderError> {
        let tiles = match plan.packet {
            Packet::Block => false,
            Packet::Tile { side } => {
                let listed_once = plan.voxelizer == Voxelizer::ByCenter && plan.cells == Cells::Lists;
                let certain = plan.arithmetic == Arithmetic::Certified && plan.margins == Margins::Derived;
                if !listed_once || !certain || side == 0 || side > tile::MAX_SIDE {
                    return Err(RenderError::Tile { plan });
                }
                true
            }
        };
        // Asked of every scene, lest it depend on one whether it has a grid and its plan is refused.
        limit(&plan)?;
        let scene = scene.spheres();
        let in_range = plan.margins == Margins::None || margin::in_range(plan.arithmetic, scene, camera);
        if !in_range {
            events.push(Event::OutOfRange);
            if plan.on_event == OnEvent::Refuse {
                return Err(RenderError::Refused(Event::OutOfRange));
            }
        }
        if !in_range || scene.is_empty() {
            return Ok(Self::without_grid(m, plan, scene, camera.eye()));
        }
        if tiles {
            let grid = Some(Grid::by_center(m, &plan, scene, memory, crew)?);
            let (spheres, bounds, on_spu) = (Vec::new(), Vec::new(), Vec::new());
            return Ok(Self { eye: camera.eye(), plan, spheres, bounds, on_spu, grid });
        }
        let mut seen = Self::without_grid(m, plan, scene, camera.eye());
        let ball = |(p, s): (&mut Prepared, &Sphere)| {
            let reach = margin::reach(plan.margins, plan.arithmetic, p.f, s.radius);
            p.cull_radius = cull::radius(m.unit(), plan.margins, p.f, reach);
            match plan.margins {
                Margins::None => Bounds::nearest(s.center, reach),
                Margins::Derived => Bounds::outward(s.center, reach),
            }
        };
        let balls: Vec<Bounds> = seen.spheres.iter_mut().zip(scene).map(ball).collect();
        seen.grid = Some(Grid::build(m, &plan, &balls, events)?);
        Ok(seen)
    }

    /// Prepares spheres alone: every one is met by every ray.
    #[must_use]
    pub fn without_grid<M: Machine>(m: M, plan: Plan, scene: &[Sphere], eye: [f32; 3]) -> Self {
        let bounds = match plan.arithmetic {
            Arithmetic::Rounded(_) | Arithmetic::Spu(_) => Vec::new(),
            Arithmetic::Certified => {
                let rule = Rule::new(m.unit().into());
                scene.iter().map(|s| bounds(&rule, eye, s)).collect()
            }
        };
        let mut on_spu = Vec::new();
        if let Arithmetic::Spu(_) = plan.arithmetic {
            m.within(
                #[inline(always)]
                || {
                    for sphere in scene {
                        on_spu.push(Prepared::on(m.spu(), eye, sphere));
                    }
                },
            );
        }
        let spheres = scene.iter().map(|s| Prepared::new(eye, s)).collect();
        Self { eye, plan, spheres, bounds, on_spu, grid: None }
    }

    /// t and id of each ray of a block, in the scene that this was made of. If it is known which spheres own its pixels, they alone
    /// are met.
    ///
    /// # Panics
    /// If it was made for tiles and has a grid: then no sphere is prepared ([`Seen::spheres`]).
    #[inline(always)]
    pub fn trace<M: Machine>(
        &self,
        m: M,
        scene: &[Sphere],
        block: &Block<M>,
        known: Option<&[u32]>,
        worker: &mut Worker,
    ) -> Answers<M> {
        if let Some(bundle) = Bundle::of_block(m, block) {
            return self.trace_packet(m, scene, block, &bundle, ALL, known, worker);
        }
        // Sixteen times the same ray is a packet with a frustum of its own.
        worker.counts.split_blocks += 1;
        let [x, y, z] = arrays(m, block);
        let (mut t, mut id) = ([f32::INFINITY; LANES], [NONE; LANES]);
        for (lane, ((x, y), z)) in x.into_iter().zip(y).zip(z).enumerate() {
            m.stage(Stage::Frustum);
            let ray = Block::new(m, [m.splat(x), m.splat(y), m.splat(z)]);
            // A direction of zero has no major axis, and hits nothing.
            let Some(bundle) = Bundle::of_block(m, &ray) else { continue };
            let alone = self.trace_packet(m, scene, &ray, &bundle, 1 << lane, known, worker);
            (t[lane], id[lane]) = (m.to_array(alone.t)[lane], m.to_array_i(alone.owners.id)[lane]);
        }
        Answers::new(m, m.lanes(t), m.lanes_i(id), scene)
    }

    /// A sphere that is hit.
    #[inline(always)]
    fn owner<'a, M: Machine>(&self, m: M, scene: &'a [Sphere], id: i32) -> Owner<'a> {
        let sphere = &scene[id.unsigned_abs() as usize];
        let [x, y, z] = self.spheres[id.unsigned_abs() as usize].f;
        let magnitude = [m.splat(x.abs()), m.splat(y.abs()), m.splat(z.abs())];
        let error = m.to_array(double::short_error::<f64, _>(m, magnitude, m.splat(sphere.radius)))[0];
        Owner { id, sphere, error }
    }

    #[inline(always)]
    fn question<'a, M: Machine>(&self, m: M, scene: &'a [Sphere], block: &Block<M>) -> Question<'a> {
        Question { eye: self.eye, dir: arrays(m, block), spheres: scene }
    }

    /// The lanes `wanted` of a packet; the others may be misses.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "all of it differs from packet to packet")]
    fn trace_packet<M: Machine>(
        &self,
        m: M,
        scene: &[Sphere],
        block: &Block<M>,
        bundle: &Bundle<M>,
        wanted: u32,
        known: Option<&[u32]>,
        worker: &mut Worker,
    ) -> Answers<M> {
        m.beside(
            Chore::Packet,
            #[inline(always)]
            || (),
        );
        match self.plan.arithmetic {
            Arithmetic::Rounded(form) => {
                let rounded = Rounded { form, block, bundle, nearest: Nearest::none(m) };
                let nearest = self.meet_all(m, bundle, rounded, known, &mut worker.counts).nearest;
                m.stage(Stage::Shade);
                Answers::new(m, nearest.t, nearest.id, scene)
            }
            Arithmetic::Spu(form) => {
                let s = m.spu();
                let dir = three(
                    block.dir,
                    #[inline(always)]
                    |d| s.lanes(m.to_array(d)),
                );
                let (block, nearest) = (&Block::new(s, dir), Nearest::none(s));
                let on_spu = OnSpu { form, block, bundle, spheres: &self.on_spu, nearest };
                let nearest = self.meet_all(m, bundle, on_spu, known, &mut worker.counts).nearest;
                // A direction may be zero on the SPU that is not so in IEEE 754.
                let mut moves = s.lt(s.splat(0.0), s.splat(0.0));
                for d in dir {
                    moves = s.or(moves, s.or(s.lt(d, s.splat(0.0)), s.lt(s.splat(0.0), d)));
                }
                let none = Nearest::none(s);
                let t = s.to_array(s.select(moves, nearest.t, none.t));
                let id = s.to_array_i(s.select_i(moves, nearest.id, none.id));
                Answers::new(m, m.lanes(t), m.lanes_i(id), scene)
            }
            Arithmetic::Certified => {
                let rays = Rays::new(m, bundle.slope);
                let certified = Certified {
                    rays,
                    bounds: &self.bounds,
                    nearest: certain::Nearest::none(m),
                    possible: &mut worker.possible,
                };
                certified.possible.clear();
                let nearest = self.meet_all(m, bundle, certified, known, &mut worker.counts).nearest;
                m.stage(Stage::Shade);
                let question = self.question(m, scene, block);
                let marked = m.to_bits(nearest.marked(m)) & wanted;
                question.settle(
                    m,
                    nearest.id,
                    marked,
                    #[inline(always)]
                    |id| self.owner(m, scene, id),
                    &worker.possible,
                    wanted,
                    &mut worker.counts,
                )
            }
        }
    }

    /// Meets every sphere that a ray may hit: those that are known, or those that the walk comes to and culling keeps, or without a
    /// grid all.
    #[inline(always)]
    fn meet_all<M: Machine, H: Hits<M>>(
        &self,
        m: M,
        bundle: &Bundle<M>,
        mut hits: H,
        known: Option<&[u32]>,
        counts: &mut Counts,
    ) -> H {
        let heading = bundle.frustum.heading;
        if let Some(ids) = known {
            counts.candidates += ids.len() as u64;
            for &id in ids {
                let sphere = &self.spheres[id as usize];
                hits.meet(m, sphere, heading.towards(sphere.f), id);
            }
            return hits;
        }
        let Some(grid) = &self.grid else {
            counts.candidates += self.spheres.len() as u64;
            m.stage(Stage::Intersect);
            for (id, sphere) in (0..).zip(&self.spheres) {
                m.beside(
                    Chore::Sphere(id),
                    #[inline(always)]
                    || (),
                );
                hits.meet(m, sphere, heading.towards(sphere.f), id);
            }
            return hits;
        };
        let slices = bundle.frustum.slices(m, self.eye, grid, self.plan.margins);
        let planes = match self.plan.culling {
            Culling::None => None,
            Culling::Planes => Some(Planes::new(m, &bundle.frustum, self.plan.margins)),
        };
        let strides = grid.strides();
        let [x, y, z] = heading.order;
        let stride = [strides[x], strides[y], strides[z]];
        let spheres = &self.spheres;
        let mut meeting = Meeting {
            m,
            spheres,
            margins: self.plan.margins,
            grid,
            heading,
            slices: &slices,
            planes,
            stride,
            hits,
            counts: *counts,
        };
        m.stage(Stage::Walk);
        walk(m, self.plan.walk, &slices, &mut meeting);
        *counts = meeting.counts;
        meeting.hits
    }
}

/// The bound of a sphere, and on which side of its surface the eye is, in f64 from f32: each of the two squares is off by less
/// than 6 · 2⁻⁵³ of itself (see [`crate::double`]).
fn bounds(rule: &Rule, eye: [f32; 3], sphere: &Sphere) -> (Bound, Side) {
    let f = [0, 1, 2].map(|i| f64::from(eye[i]) - f64::from(sphere.center[i]));
    let r = f64::from(sphere.radius);
    let (ff, rr) = (f[0] * f[0] + f[1] * f[1] + f[2] * f[2], r * r);
    let slack = (ff + rr) / (1u64 << 50) as f64;
    let farthest = [0, 1, 2].map(|i| (eye[i] - sphere.center[i]).abs().next_up());
    let bound = rule.bound(farthest.into_iter().fold(0.0, f32::max), sphere.radius);
    let side = if bound == Bound::NONE {
        Side::Unknown
    } else if ff - rr > slack {
        Side::Outside
    } else if ff - rr < -slack {
        Side::Inside
    } else {
        Side::Unknown
    };
    (bound, side)
}

/// Rim: directions by axis and lane.
#[inline(always)]
fn arrays<M: Machine>(m: M, block: &Block<M>) -> [[f32; LANES]; 3] {
    three(
        block.dir,
        #[inline(always)]
        |d| m.to_array(d),
    )
}

/// What a packet knows of its hits.
trait Hits<M: Machine> {
    /// Takes a sphere into account, whose centre relative to the eye is given along (A, Y, Z).
    fn meet(&mut self, m: M, sphere: &Prepared, center: [f32; 3], id: u32);

    /// How far along A from the eye each ray's nearest hit is at most.
    fn reached(&self, m: M) -> M::F;
}

/// In one of the f32 forms.
struct Rounded<'a, M: Machine> {
    form: Form,
    block: &'a Block<M>,
    bundle: &'a Bundle<M>,
    nearest: Nearest<M>,
}

impl<M: Machine> Hits<M> for Rounded<'_, M> {
    #[inline(always)]
    fn meet(&mut self, m: M, sphere: &Prepared, _: [f32; 3], id: u32) {
        self.nearest = self.nearest.meet(m, self.form, self.block, sphere, id.cast_signed());
    }

    #[inline(always)]
    fn reached(&self, m: M) -> M::F {
        m.mul(self.nearest.t, self.bundle.speed)
    }
}

/// In one of the forms on the SPU.
struct OnSpu<'a, M: Machine> {
    form: Form,
    block: &'a Block<M::Spu>,
    bundle: &'a Bundle<M>,
    spheres: &'a [Prepared],
    nearest: Nearest<M::Spu>,
}

impl<M: Machine> OnSpu<'_, M> {
    /// One function for all who meet, and one door: inlined into every way through the grid it would take minutes to compile.
    #[inline(never)]
    fn meet_one(&mut self, m: M, id: u32) {
        m.within(
            #[inline(always)]
            || {
                let sphere = &self.spheres[id as usize];
                self.nearest = self.nearest.meet(m.spu(), self.form, self.block, sphere, id.cast_signed());
            },
        );
    }
}

impl<M: Machine> Hits<M> for OnSpu<'_, M> {
    #[inline(always)]
    fn meet(&mut self, m: M, _: &Prepared, _: [f32; 3], id: u32) {
        self.meet_one(m, id);
    }

    #[inline(always)]
    fn reached(&self, m: M) -> M::F {
        m.mul(m.lanes(m.spu().to_array(self.nearest.t)), self.bundle.speed)
    }
}

/// With certainty, or not at all.
struct Certified<'a, M: Machine> {
    rays: Rays<M>,
    bounds: &'a [(Bound, Side)],
    nearest: certain::Nearest<M>,
    possible: &'a mut Vec<u32>,
}

impl<M: Machine> Hits<M> for Certified<'_, M> {
    #[inline(always)]
    fn meet(&mut self, m: M, sphere: &Prepared, center: [f32; 3], id: u32) {
        let (bound, side) = self.bounds[id as usize];
        let all = m.le(m.splat(0.0), m.splat(0.0));
        if let Some(found) = self.rays.find(m, &Ball { center, rr: sphere.rr, bound, side }, all) {
            self.nearest = self.nearest.meet(m, &found, id.cast_signed());
            self.possible.push(id);
        }
    }

    #[inline(always)]
    fn reached(&self, _: M) -> M::F {
        self.nearest.hi
    }
}

/// A packet meeting the spheres of the cells it visits.
struct Meeting<'a, M: Machine, H> {
    m: M,
    spheres: &'a [Prepared],
    margins: Margins,
    grid: &'a Grid,
    heading: Heading,
    slices: &'a Slices,
    planes: Option<Planes<M>>,
    stride: [usize; 3],
    hits: H,
    counts: Counts,
}

impl<M: Machine, H: Hits<M>> Visitor<M> for Meeting<'_, M, H> {
    #[inline(always)]
    fn visit(&mut self, slice: usize, j: i32, k: i32, live: bool) {
        let m = self.m;
        let i = self.heading.slice_index(self.slices.count, slice);
        let [x, y, z] = self.stride;
        let index = m.beside(
            Chore::Cell { slice, j, k, live },
            #[inline(always)]
            || i * x + j.unsigned_abs() as usize * y + k.unsigned_abs() as usize * z,
        );
        self.counts.cells += u64::from(live);
        let grid = self.grid;
        // The loop's branches are told as those of a loop that is passed by or ends with its question.
        let mut site = Site::EmptyCell;
        grid.for_each_id(
            index,
            live,
            #[inline(always)]
            |id| {
                m.branch(site == Site::NextId, site);
                site = Site::NextId;
                self.meet(id);
            },
        );
        m.branch(site == Site::EmptyCell, site);
    }

    #[inline(always)]
    fn unfinished(&self, slice: usize) -> M::B {
        let m = self.m;
        let beyond = match self.margins {
            Margins::None => 1.0,
            Margins::Derived => beyond(m.unit()),
        };
        let reached = m.mul(self.hits.reached(m), m.splat(beyond));
        let end = m.splat(self.slices.far[slice]);
        m.not(m.le(m.add(reached, m.splat(self.grid.widen)), end))
    }
}

impl<M: Machine, H: Hits<M>> Meeting<'_, M, H> {
    #[inline(always)]
    fn meet(&mut self, id: u32) {
        let m = self.m;
        let sphere = &self.spheres[id as usize];
        self.counts.candidates += 1;
        m.beside(
            Chore::Sphere(id),
            #[inline(always)]
            || (),
        );
        let center = self.heading.towards(sphere.f);
        if let Some(planes) = &self.planes {
            let center = [m.splat(center[0]), m.splat(center[1]), m.splat(center[2])];
            m.stage(Stage::Cull);
            if planes.cull(m, center, m.splat(sphere.cull_radius)) {
                self.counts.culled += 1;
                m.stage(Stage::Walk);
                return;
            }
        }
        m.stage(Stage::Intersect);
        m.beside(
            Chore::Invariants,
            #[inline(always)]
            || (),
        );
        self.hits.meet(m, sphere, center, id);
        m.stage(Stage::Walk);
    }
}
