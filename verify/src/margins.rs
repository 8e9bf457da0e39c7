//! The margins of slices, culling, outlines and tiles held against whole numbers: what the shipped kernels drop must not be hit, for all
//! inputs of a domain.
//!
//! In: a machine of few bits, a factor on its margins, which is 1 unless the check itself is on trial, and inputs in whole numbers, each
//! of which must be one of the machine's floats. Out: how much was demanded of the kernels, what they dropped, and the first
//! falsehood in full. Truth is a comparison of integers, or of products of two floats of few bits, which are exact in f64.
//!
//! Kernels take their margins as multiples of [`Machine::unit`], so a machine of p bits has margins of 2⁻ᵖ where f32 has them of
//! 2⁻²⁴. A few plain numbers are computed in f32 beside the lanes; that a machine of few bits would round each of these operations is
//! granted by a smaller unit, and by rounding what comes out to one of its floats, the worse way unless the kernel rounds it the other.

use crate::bounds::Whole;
use crate::small::{Mode, Small};
use contract::{Camera, Sphere};
use optimized::camera::{Block, CameraLanes};
use optimized::certain::sides;
use optimized::cull::{self, Planes};
use optimized::frustum::{Bundle, Extent, Frustum, Heading, pad};
use optimized::grid::widen;
use optimized::machine::{LANES, Machine, Site};
use optimized::plan::Margins;
use optimized::silhouette::Outline;
use optimized::sphere::Prepared;
use optimized::tile::{Share, range, share, slack};
use std::array::from_fn;

/// What was judged.
#[derive(Clone, Debug, Default)]
pub struct Judged {
    /// Inputs, each in itself.
    pub inputs: u64,
    /// Of these, what a kernel must not drop.
    pub demanded: u64,
    /// What it did drop.
    pub dropped: u64,
    /// What it dropped against the demand.
    pub wrong: u64,
    /// The first of these.
    pub first: Option<String>,
}

impl Judged {
    fn judge(&mut self, demanded: bool, dropped: bool, what: impl FnOnce() -> String) {
        self.inputs += 1;
        self.demanded += u64::from(demanded);
        self.dropped += u64::from(dropped);
        if demanded && dropped {
            self.wrong += 1;
            self.first.get_or_insert_with(what);
        }
    }
}

impl std::ops::Add for Judged {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            inputs: self.inputs + other.inputs,
            demanded: self.demanded + other.demanded,
            dropped: self.dropped + other.dropped,
            wrong: self.wrong + other.wrong,
            first: self.first.or(other.first),
        }
    }
}

/// Another machine, but for its unit roundoff, which is multiplied by a factor, and with it all margins.
#[derive(Clone, Copy, Debug)]
pub struct Scaled<M> {
    /// Who does the arithmetic.
    pub machine: M,
    /// What its unit is multiplied by.
    pub factor: f32,
}

macro_rules! handed_on {
    ($($name:ident($($x:ident: $t:ty),*) -> $out:ty;)*) => {
        $(fn $name(self, $($x: $t),*) -> $out {
            self.machine.$name($($x),*)
        })*
    };
}

impl<M: Machine> Machine for Scaled<M> {
    type F = M::F;
    type I = M::I;
    type B = M::B;
    type Spu = M::Spu;

    fn unit(self) -> f32 {
        self.factor * self.machine.unit()
    }

    handed_on! {
        spu() -> M::Spu;
        lanes(x: [f32; LANES]) -> M::F;
        lanes_i(x: [i32; LANES]) -> M::I;
        to_array(x: M::F) -> [f32; LANES];
        to_array_i(x: M::I) -> [i32; LANES];
        to_bits(x: M::B) -> u32;
        splat(x: f32) -> M::F;
        splat_i(x: i32) -> M::I;
        add(x: M::F, y: M::F) -> M::F;
        sub(x: M::F, y: M::F) -> M::F;
        mul(x: M::F, y: M::F) -> M::F;
        div(x: M::F, y: M::F) -> M::F;
        sqrt(x: M::F) -> M::F;
        lt(x: M::F, y: M::F) -> M::B;
        le(x: M::F, y: M::F) -> M::B;
        lt_i(x: M::I, y: M::I) -> M::B;
        and(x: M::B, y: M::B) -> M::B;
        or(x: M::B, y: M::B) -> M::B;
        not(x: M::B) -> M::B;
        select(choose: M::B, yes: M::F, no: M::F) -> M::F;
        select_i(choose: M::B, yes: M::I, no: M::I) -> M::I;
        add_i(x: M::I, y: M::I) -> M::I;
        or_i(x: M::I, y: M::I) -> M::I;
        shl_16(x: M::I) -> M::I;
        shr_16(x: M::I) -> M::I;
        floor(x: M::F) -> M::I;
        truncate(x: M::F) -> M::I;
        smallest(x: M::F) -> M::F;
        largest(x: M::F) -> M::F;
        any(x: M::B, site: Site) -> bool;
    }
}

/// Margins under trial.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// The floats; every whole number given must be one of them.
    pub small: Small,
    /// What all margins are multiplied by.
    pub factor: f32,
}

/// A packet, and all that is made of it once.
#[derive(Clone, Copy)]
pub struct Packet {
    /// The directions of its rays along (A, Y, Z), some more than once.
    rays: [[i64; 3]; 2],
    frustum: Frustum<Scaled<Small>>,
    planes: Planes<Scaled<Small>>,
}

/// An eye and what a slice is held against.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The eye on the major axis.
    pub major: i64,
    /// And on the minor one.
    pub minor: i64,
    /// The largest radius, if spheres are listed by centre.
    pub reach: i64,
}

impl Trial {
    fn machine(self) -> Scaled<Small> {
        Scaled { machine: self.small, factor: self.factor }
    }

    /// The unit for plain numbers, of which up to five operations are rounded.
    #[allow(clippy::cast_possible_truncation, reason = "a constant of a check")]
    fn plain(self) -> f32 {
        self.machine().unit() * (1.0 - self.small.unit()).powi(5) as f32
    }

    fn down(self, x: f32) -> f32 {
        Small { mode: Mode::Truncating, ..self.small }.round(x.into())
    }

    /// The least float of the machine from x on, x >= 0.
    fn up(self, x: f32) -> f32 {
        let below = self.down(x);
        let step = f32::from_bits((1 << (24 - self.small.bits)) + below.to_bits());
        if below == x { x } else { step }
    }

    /// A packet of two rays in these directions of the world; `None` if they have no heading in common.
    #[must_use]
    pub fn packet(self, world: [[i64; 3]; 2]) -> Option<Packet> {
        let m = self.machine();
        let dir = [0, 1, 2].map(|i| from_fn(|lane| float(world[lane % 2][i])));
        let frustum = Bundle::of_block(m, &Block::new(m, dir))?.frustum;
        let rays = world.map(|d| along(&frustum.heading, d));
        Some(Packet { rays, frustum, planes: Planes::new(m, &frustum, Margins::Derived) })
    }

    /// All slices between two of the planes, in ascending order, on both minor axes: a point of the packet's first ray in the slice must lie
    /// between the slice's bounds, and a sphere whose centre is in the slice and within reach of such a point too.
    pub fn slices(self, packet: &Packet, place: Place, planes: &[i64], judged: &mut Judged) {
        let (m, heading) = (self.machine(), packet.frustum.heading);
        let widen = self.down(widen(self.plain(), float(place.reach)));
        let [speed, ..] = packet.rays[0];
        for (number, &end) in planes.iter().enumerate() {
            let starts = if heading.forward { &planes[..=number] } else { &planes[number..] };
            for starts in starts.chunks(LANES) {
                let start = |lane: usize| starts[lane.min(starts.len() - 1)];
                let eye = m.splat(float(place.major));
                let lower = m.sub(m.lanes(from_fn(|lane| float(start(lane).min(end)))), eye);
                let upper = m.sub(m.lanes(from_fn(|lane| float(start(lane).max(end)))), eye);
                let ahead: [[f32; 2]; LANES] = from_fn(|lane| heading.ahead([lower[lane], upper[lane]]));
                let (near, far) = (ahead.map(|[near, _]| near), ahead.map(|[_, far]| far));
                for (side, minor) in packet.rays[0][1..].iter().enumerate() {
                    let pad = self.down(pad(self.plain(), float(place.minor), far[0].abs() + widen));
                    let Extent { low, high, behind } =
                        packet.frustum.extent(m, side, float(place.minor), widen, near, far, pad);
                    for (lane, &start) in starts.iter().enumerate() {
                        let sense = if heading.forward { 1 } else { -1 };
                        let from = (sense * (start - place.major) - place.reach).max(0);
                        let to = sense * (end - place.major) + place.reach;
                        // The coordinate times A, which is linear in the distance and so extreme at an end.
                        let at = |distance: i64, off: i64| (place.minor + off) * speed + distance * minor;
                        let least = at(from, -place.reach).min(at(to, -place.reach));
                        let most = at(from, place.reach).max(at(to, place.reach));
                        let outside = product(low[lane], speed) > whole(least)
                            || product(high[lane], speed) < whole(most);
                        judged.judge(to >= 0, behind[lane] || outside, || {
                            let (low, high, behind) = (low[lane], high[lane], behind[lane]);
                            format!(
                                "{heading:?}, {:?}, {place:?}, slice {start} to {end}, side {side}: {least} and {most} over \
                                 {speed} in {low} to {high}, behind: {behind}",
                                packet.rays[0]
                            )
                        });
                    }
                }
            }
        }
    }

    /// A ball that just touches either ray, and the one of radius 1, must be kept if a ray of the packet comes near enough. `ball` is along
    /// (A, Y, Z); of its radius nothing is taken.
    pub fn culling(self, packet: &Packet, ball: &Whole, judged: &mut Judged) {
        let (m, heading) = (self.machine(), packet.frustum.heading);
        let own = world(&heading, [0, 1, 2].map(|i| ball.center[i] + ball.eye[i])).map(float);
        let eye = world(&heading, ball.eye).map(float);
        let f = Prepared::on(m, eye, &Sphere { center: own, radius: 1.0, color: [0; 3] }).f;
        let center = heading.towards(f).map(|x| m.splat(x));
        let [first, second] = packet.rays;
        let rays = if first == second { &packet.rays[..1] } else { &packet.rays[..] };
        for radius in rays.iter().map(|&ray| self.least(ball, ray)).chain([1]) {
            let ball = Whole { radius, ..*ball };
            let enlarged = self.up(cull::radius(self.plain(), Margins::Derived, f, float(radius)));
            let culled = packet.planes.cull(m, center, m.splat(enlarged));
            let touched = rays.iter().any(|&d| ball.touches(d));
            judged.judge(touched, culled, || format!("{:?}, {heading:?}, {ball:?}", packet.rays));
        }
    }

    /// The least radius of a ball around this one's centre that the ray touches.
    fn least(self, ball: &Whole, direction: [i64; 3]) -> i64 {
        let step = |radius: i64| {
            let bits = i64::BITS - radius.leading_zeros();
            1i64 << bits.saturating_sub(self.small.bits)
        };
        let mut radius = step(ball.reached(direction)).max(1);
        radius *= ball.reached(direction) / radius;
        let touches = |radius: i64| Whole { radius, ..*ball }.touches(direction);
        while radius > 1 && touches(radius - step(radius - 1)) {
            radius -= step(radius - 1);
        }
        radius = radius.max(1);
        while !touches(radius) {
            radius += step(radius);
        }
        radius
    }

    /// Outlines of balls of sixteen radii around a centre (A, Y, 0) or (A, 0, Y), against all directions of a list that ascends in slope:
    /// those that hit must have their slopes in the outline, and no point of the ball is nearer than it says.
    pub fn outlines(
        self,
        own: [i64; 2],
        eye: [i64; 2],
        radii: [i64; LANES],
        directions: &[[i64; 2]],
        judged: &mut Judged,
    ) {
        let m = self.machine();
        let [a, y] = [0, 1].map(|i| m.sub(m.splat(float(own[i])), m.splat(float(eye[i]))));
        let [center_a, center_y] = [0, 1].map(|i| own[i] - eye[i]);
        for side in 0..2 {
            let c = if side == 0 { [a, y, m.splat(0.0)] } else { [a, m.splat(0.0), y] };
            let radius = cull::radii(m, c.map(|x| m.max(x, m.neg(x))), m.lanes(radii.map(float)));
            let outline = Outline::new(m, c, radius);
            for (lane, &radius) in radii.iter().enumerate() {
                let ball = Whole { center: [center_a, center_y, 0], eye: [0; 3], radius };
                let hits = |&[a, y]: &[i64; 2]| ball.touches([a, y, 0]);
                // The directions that hit are neighbours: from the one through the centre they reach to either side.
                let middle = directions.partition_point(|[a, y]| y * center_a < center_y * a);
                let (before, after) = directions.split_at(middle);
                let surrounded = center_a <= radius;
                let first = if surrounded { 0 } else { before.partition_point(|d| !hits(d)) };
                let last = if surrounded { directions.len() } else { middle + after.partition_point(hits) };
                let (lo, hi) = (outline.lo[side][lane], outline.hi[side][lane]);
                let from = directions.partition_point(|&[a, y]| f64::from(lo) * whole(a) > whole(y));
                let to = directions.partition_point(|&[a, y]| f64::from(hi) * whole(a) >= whole(y)).max(from);
                let any = first < last && (center_a > radius || center_a + radius >= 0);
                let lost = any && (first < from || to < last);
                let near = f64::from(outline.near[lane]) > whole(center_a - radius);
                judged.inputs += directions.len() as u64;
                judged.demanded += if any { (last - first) as u64 } else { 0 };
                judged.dropped += (directions.len() - (to - from)) as u64;
                if lost || near {
                    judged.wrong += 1;
                    judged.first.get_or_insert_with(|| {
                        let near = outline.near[lane];
                        format!(
                            "{ball:?}, own {own:?}: hit by {:?} to {:?}, outline {lo} to {hi}, near {near}",
                            directions.get(first),
                            directions[..last].last()
                        )
                    });
                }
            }
        }
    }

    /// The eye must not be called outside a ball that holds it, nor inside one that does not; sixteen radii at a time.
    pub fn sides(self, ball: &Whole, radii: [i64; LANES], judged: &mut Judged) {
        let m = self.machine();
        let c = [0, 1, 2]
            .map(|i| m.sub(m.splat(float(ball.center[i] + ball.eye[i])), m.splat(float(ball.eye[i]))));
        let r = m.lanes(radii.map(float));
        let [outside, inside] = sides(m, m.dot(c, c), m.mul(r, r));
        for (lane, &radius) in radii.iter().enumerate() {
            let ball = Whole { radius, ..*ball };
            judged.judge(ball.power() <= 0, outside[lane], || format!("{ball:?} is called outside"));
            judged.judge(ball.power() >= 0, inside[lane], || format!("{ball:?} is called inside"));
        }
    }

    /// All rays of a picture of 4x4 pixels that have a heading must have their slopes in the range that is made of its corners, and be in
    /// the share of the heading; what is dropped is what lies outside either.
    pub fn tile(self, camera: &Camera, judged: &mut Judged) {
        let m = self.machine();
        let lanes = CameraLanes::new(m, camera);
        let slack = self.down(slack(self.plain(), camera));
        let column = |lane: usize| [0.5, 1.5, 2.5, 3.5][lane % 4];
        let dir = lanes.directions(m, from_fn(column), from_fn(|lane| column(lane / 4)));
        let corner = |x: f32, y: f32| lanes.directions(m, m.splat(x), m.splat(y));
        let corners = [corner(0.5, 0.5), corner(3.5, 0.5), corner(0.5, 3.5), corner(3.5, 3.5)];
        for heading in Heading::all() {
            let along = heading.along_lanes(m, dir);
            let corners = corners.map(|d| heading.along_lanes(m, d));
            let share = share(slack, &corners.map(|d| d.map(|x| m.first(x))));
            let range = range(m, slack, corners);
            let has = heading.has(m, along);
            for lane in 0..LANES {
                let [a, y, z] = along.map(|x| f64::from(x[lane]));
                let holds = |[lo, hi]: [[f32; LANES]; 2], d: f64| {
                    f64::from(lo[lane]) * a <= d && d <= f64::from(hi[lane]) * a
                };
                let within = share != Share::None && holds(range[0], y) && holds(range[1], z);
                judged.judge(has[lane], !within, || {
                    format!("{camera:?}, {heading:?}, lane {lane}: {share:?}, {range:?}")
                });
                if share == Share::All && !has[lane] {
                    judged.wrong += 1;
                    judged.first.get_or_insert_with(|| format!("{camera:?}, {heading:?}: not all have it"));
                }
            }
        }
    }
}

/// A vector along (A, Y, Z) in the world.
fn world(heading: &Heading, v: [i64; 3]) -> [i64; 3] {
    let mut out = [0; 3];
    for (i, x) in heading.order.into_iter().zip(v) {
        out[i] = x;
    }
    let major = heading.order[0];
    out[major] = if heading.forward { out[major] } else { -out[major] };
    out
}

/// A vector of the world along (A, Y, Z).
fn along(heading: &Heading, v: [i64; 3]) -> [i64; 3] {
    let [a, y, z] = heading.order.map(|i| v[i]);
    [if heading.forward { a } else { -a }, y, z]
}

#[allow(clippy::cast_precision_loss, reason = "the caller gives floats")]
fn float(x: i64) -> f32 {
    x as f32
}

#[allow(clippy::cast_precision_loss, reason = "below 2^53")]
fn whole(x: i64) -> f64 {
    x as f64
}

fn product(x: f32, y: i64) -> f64 {
    f64::from(x) * whole(y)
}
