//! A frame's scene as seen from its camera: what is made once a frame and read by every packet. Spheres relative to
//! the eye, their radii for culling, and the grid.

use crate::camera::Block;
use crate::cull::{self, Planes};
use crate::event::{Event, Events, RenderError};
use crate::frustum::{Frustum, Slices};
use crate::grid::{Bounds, Grid};
use crate::machine::{LANES, Machine, three};
use crate::margin;
use crate::plan::{Culling, Margins, OnEvent, Plan};
use crate::sphere::{NONE, Nearest, Prepared};
use crate::walk::{Visitor, walk};
use contract::{Camera, Scene};

/// 1 + 2⁻²⁰: more than the roundings of t |d_X| and of a slice's distance.
const BEYOND: f32 = 1.0 + 1.0 / (1u32 << 20) as f32;

/// What all packets of a frame read.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The eye.
    pub eye: [f32; 3],
    /// The plan.
    pub plan: Plan,
    /// The spheres relative to the eye, by id.
    pub spheres: Vec<Prepared>,
    /// The grid; `None` if there is nothing to hit, or if margins are wanted for a scene for which there are none: then
    /// every sphere is met by every ray.
    pub grid: Option<Grid>,
}

/// What tracing cost, and what culling saved.
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
}

impl std::ops::Add for Counts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            cells: self.cells + other.cells,
            candidates: self.candidates + other.candidates,
            culled: self.culled + other.culled,
            split_blocks: self.split_blocks + other.split_blocks,
        }
    }
}

impl Seen {
    /// Prepares spheres and builds the grid.
    ///
    /// # Errors
    /// [`RenderError`] if the plan refuses what the scene does.
    pub fn new<M: Machine>(
        m: M,
        plan: Plan,
        scene: &Scene,
        camera: &Camera,
        events: &mut Events,
    ) -> Result<Self, RenderError> {
        let eye = camera.eye();
        let mut spheres: Vec<Prepared> = scene.spheres().iter().map(|s| Prepared::new(eye, s)).collect();
        let mut seen = Self { eye, plan, spheres: Vec::new(), grid: None };
        if plan.margins == Margins::Derived && !margin::in_range(scene.spheres(), camera) {
            events.push(Event::OutOfRange);
            if plan.on_event == OnEvent::Refuse {
                return Err(RenderError::Refused(Event::OutOfRange));
            }
        } else if !spheres.is_empty() {
            let ball = |(p, s): (&mut Prepared, &contract::Sphere)| {
                let reach = margin::reach(plan.margins, plan.form, p.f, s.radius);
                p.cull_radius = cull::radius(plan.margins, p.f, reach);
                match plan.margins {
                    Margins::None => Bounds::nearest(s.center, reach),
                    Margins::Derived => Bounds::outward(s.center, reach),
                }
            };
            let balls: Vec<Bounds> = spheres.iter_mut().zip(scene.spheres()).map(ball).collect();
            seen.grid = Some(Grid::build(m, &plan, &balls, events)?);
        }
        seen.spheres = spheres;
        Ok(seen)
    }

    /// The nearest hit of each ray of a block. Rays without a common major axis go one by one.
    #[inline(always)]
    pub fn trace<M: Machine>(&self, m: M, block: &Block<M>, counts: &mut Counts) -> Nearest<M> {
        let Some(grid) = &self.grid else {
            counts.candidates += self.spheres.len() as u64;
            let mut nearest = Nearest::none(m);
            for (sphere, id) in self.spheres.iter().zip(0..) {
                nearest = nearest.meet(m, self.plan.form, block, sphere, id);
            }
            return nearest;
        };
        match Frustum::of_block(m, block) {
            Some(frustum) => self.trace_packet(m, grid, block, &frustum, counts),
            None => self.trace_singly(m, grid, block, counts),
        }
    }

    /// Sixteen times the same ray is a packet with a frustum of its own.
    #[inline(always)]
    fn trace_singly<M: Machine>(
        &self,
        m: M,
        grid: &Grid,
        block: &Block<M>,
        counts: &mut Counts,
    ) -> Nearest<M> {
        counts.split_blocks += 1;
        let (mut t, mut id) = ([f32::INFINITY; LANES], [NONE; LANES]);
        let dir = three(
            block.dir,
            #[inline(always)]
            |d| m.to_array(d),
        );
        for lane in 0..LANES {
            let ray = Block::new(m, [m.splat(dir[0][lane]), m.splat(dir[1][lane]), m.splat(dir[2][lane])]);
            // A direction of zero has no major axis, and hits nothing.
            let Some(frustum) = Frustum::of_block(m, &ray) else { continue };
            let nearest = self.trace_packet(m, grid, &ray, &frustum, counts);
            (t[lane], id[lane]) = (m.to_array(nearest.t)[lane], m.to_array_i(nearest.id)[lane]);
        }
        Nearest { t: m.lanes(t), id: m.lanes_i(id) }
    }

    #[inline(always)]
    fn trace_packet<M: Machine>(
        &self,
        m: M,
        grid: &Grid,
        block: &Block<M>,
        frustum: &Frustum<M>,
        counts: &mut Counts,
    ) -> Nearest<M> {
        let slices = frustum.slices(m, self.eye, grid, self.plan.margins);
        let planes = match self.plan.culling {
            Culling::None => None,
            Culling::Planes => Some(Planes::new(m, frustum, self.plan.margins)),
        };
        let strides = grid.strides();
        let [x, y, z] = frustum.order;
        let stride = [strides[x], strides[y], strides[z]];
        let nearest = Nearest::none(m);
        let mut meeting = Meeting {
            m,
            seen: self,
            grid,
            block,
            frustum,
            slices: &slices,
            planes,
            stride,
            nearest,
            counts: *counts,
        };
        walk(m, self.plan.walk, &slices, &mut meeting);
        *counts = meeting.counts;
        meeting.nearest
    }
}

/// A packet meeting the spheres of the cells it visits.
struct Meeting<'a, M: Machine> {
    m: M,
    seen: &'a Seen,
    grid: &'a Grid,
    block: &'a Block<M>,
    frustum: &'a Frustum<M>,
    slices: &'a Slices,
    planes: Option<Planes<M>>,
    stride: [usize; 3],
    nearest: Nearest<M>,
    counts: Counts,
}

impl<M: Machine> Visitor<M> for Meeting<'_, M> {
    #[inline(always)]
    fn visit(&mut self, slice: usize, j: i32, k: i32, live: bool) {
        let i = self.frustum.slice_index(self.slices.count, slice);
        let [x, y, z] = self.stride;
        let index = i * x + j.unsigned_abs() as usize * y + k.unsigned_abs() as usize * z;
        self.counts.cells += u64::from(live);
        let grid = self.grid;
        grid.for_each_id(
            index,
            live,
            #[inline(always)]
            |id| self.meet(id),
        );
    }

    #[inline(always)]
    fn unfinished(&self, slice: usize) -> M::B {
        let m = self.m;
        let (beyond, widen) = match self.seen.plan.margins {
            Margins::None => (1.0, self.grid.widen),
            Margins::Derived => (BEYOND, self.grid.widen * BEYOND),
        };
        let reached = m.mul(m.mul(self.nearest.t, self.frustum.speed), m.splat(beyond));
        let end = m.splat(self.slices.far[slice]);
        m.not(m.le(m.add(reached, m.splat(widen)), end))
    }
}

impl<M: Machine> Meeting<'_, M> {
    #[inline(always)]
    fn meet(&mut self, id: u32) {
        let m = self.m;
        let sphere = &self.seen.spheres[id as usize];
        self.counts.candidates += 1;
        if let Some(planes) = &self.planes {
            let [x, y, z] = sphere.f;
            let center = self.frustum.along([-x, -y, -z]);
            let center = [m.splat(center[0]), m.splat(center[1]), m.splat(center[2])];
            if planes.cull(m, center, m.splat(sphere.cull_radius)) {
                self.counts.culled += 1;
                return;
            }
        }
        self.nearest = self.nearest.meet(m, self.seen.plan.form, self.block, sphere, id.cast_signed());
    }
}
