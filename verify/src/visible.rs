//! *Hit => visible*: whenever a form reports a hit, the packet's walk comes to a cell that lists the sphere, and culling
//! keeps it. And *complete*: a voxelizer lists a ball in every cell that holds a real point of it. Both are decided
//! here in integers, from the grid's planes and the reported t alone, with none of the tracer's own arithmetic.
//!
//! Every finite f32 is an integer times 2⁻¹⁴⁹; a point P = eye + t d is one times 2⁻²⁹⁸.

use contract::{Camera, Scene, Sphere};
use dashu_int::IBig;
use optimized::camera::{BLOCK, Block, CameraLanes, middles};
use optimized::cull::{self, Planes};
use optimized::frustum::{Bundle, Frustum, Slices};
use optimized::grid::{Axis, Grid};
use optimized::host::Scalar;
use optimized::machine::{LANES, Machine};
use optimized::plan::{Arithmetic, Culling, Voxelizer};
use optimized::seen::Seen;
use optimized::sphere::Prepared;
use optimized::{Form, margin};
use rand::{Rng, RngExt};
use reference::{Arithmetic as Naive, Ray, Tracer};

/// How much was checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Checked {
    /// Reported hits.
    pub hits: u64,
    /// Of these, with a P within 2⁻¹² of the grid's extent from a plane of it, on some axis.
    pub near_planes: u64,
    /// Of these, with a P outside the sphere by more than 2⁻²⁰ of its radius.
    pub beyond_surface: u64,
    /// Points of rays, hit or not.
    pub points: u64,
    /// Balls held against the culling planes.
    pub balls: u64,
    /// Cells held against balls.
    pub cells: u64,
    /// Of these, cells that hold a point of the ball.
    pub overlapping: u64,
}

impl std::ops::Add for Checked {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            hits: self.hits + other.hits,
            near_planes: self.near_planes + other.near_planes,
            beyond_surface: self.beyond_surface + other.beyond_surface,
            points: self.points + other.points,
            balls: self.balls + other.balls,
            cells: self.cells + other.cells,
            overlapping: self.overlapping + other.overlapping,
        }
    }
}

/// Every reported hit of every ray of a small picture, for every sphere of a small scene.
///
/// # Errors
/// A sentence that says which hit is not visible, and why.
pub fn hits_are_visible(seen: &Seen, scene: &Scene, camera: &Camera) -> Result<Checked, String> {
    let mut checked = Checked::default();
    for_each_ray(seen, scene, camera, |packet| {
        (0..).zip(scene.spheres()).try_for_each(|(id, sphere)| packet.check_hit(id, sphere, &mut checked))
    })?;
    Ok(checked)
}

/// What walk and culling promise of any point of a ray, whether a sphere is hit there or not: its cell is visited, and a
/// ball that reaches it is kept. Points are taken where the ray crosses planes of the grid, a few f32 steps before and after,
/// and balls whose surface goes through the point, but for the rounding of their radius upwards.
///
/// # Errors
/// A sentence that says which point is missed.
pub fn rays_are_walked(
    seen: &Seen,
    scene: &Scene,
    camera: &Camera,
    rng: &mut impl Rng,
) -> Result<Checked, String> {
    let mut checked = Checked::default();
    for_each_ray(seen, scene, camera, |packet| packet.check_crossings(rng, &mut checked))?;
    Ok(checked)
}

/// Each ray of a picture in its packet.
fn for_each_ray(
    seen: &Seen,
    scene: &Scene,
    camera: &Camera,
    mut check: impl FnMut(&Packet<'_>) -> Result<(), String>,
) -> Result<(), String> {
    let Some(grid) = &seen.grid else { return Ok(()) };
    let planes = planes(grid);
    let reach =
        |(p, s): (&Prepared, &Sphere)| margin::reach(seen.plan.margins, seen.plan.arithmetic, p.f, s.radius);
    let farthest = seen.spheres.iter().zip(scene.spheres()).map(reach).fold(0.0, f32::max);
    let m = Scalar;
    let lanes = CameraLanes::new(m, camera);
    for y in (0..camera.size().height()).step_by(BLOCK as usize) {
        for x in (0..camera.size().width()).step_by(BLOCK as usize) {
            let (xs, ys) = middles(m, camera, x, y);
            let block = lanes.block(m, xs, ys);
            // Rays without a common axis are packets of their own.
            let single = |lane: usize| (Block::new(m, block.dir.map(|d| [d[lane]; LANES])), vec![lane]);
            let packets: Vec<(Block<Scalar>, Vec<usize>)> = match Bundle::of_block(m, &block) {
                Some(_) => vec![(block, (0..LANES).collect())],
                None => (0..LANES).map(single).collect(),
            };
            for (packet, lanes) in packets {
                let Some(Bundle { frustum, .. }) = Bundle::of_block(m, &packet) else { continue };
                let slices = frustum.slices(m, seen.eye, grid, seen.plan.margins);
                for lane in lanes {
                    let ray = Ray { eye: seen.eye, dir: packet.dir.map(|d| d[lane]) };
                    check(&Packet {
                        seen,
                        grid,
                        planes: &planes,
                        frustum: &frustum,
                        slices: &slices,
                        ray,
                        farthest,
                    })?;
                }
            }
        }
    }
    Ok(())
}

struct Packet<'a> {
    seen: &'a Seen,
    grid: &'a Grid,
    /// Its planes on each axis, as a point's coordinates are.
    planes: &'a [Vec<IBig>; 3],
    frustum: &'a Frustum<Scalar>,
    slices: &'a Slices,
    ray: Ray,
    /// The largest reach of any sphere.
    farthest: f32,
}

impl Packet<'_> {
    fn check_hit(&self, id: u32, sphere: &Sphere, checked: &mut Checked) -> Result<(), String> {
        let plan = &self.seen.plan;
        let form = match plan.arithmetic {
            Arithmetic::Rounded(Form::Textbook) => Naive::F32Textbook,
            Arithmetic::Rounded(Form::Perpendicular) => Naive::F32Perpendicular,
            Arithmetic::Spu(Form::Textbook) => Naive::SpuTextbook,
            Arithmetic::Spu(Form::Perpendicular) => Naive::SpuPerpendicular,
            Arithmetic::Certified => Naive::Exact,
        };
        let alone = Scene::new(vec![*sphere], [0; 3], [0.0; 3]).map_err(|e| e.to_string())?;
        let Some(hit) = Tracer::new(form).trace(&self.ray, &alone) else { return Ok(()) };
        let say =
            |what: &str| Err(format!("{what}: sphere {id} {sphere:?}, {:?}, {hit:?}, {plan}", self.ray));
        let point = Point::on(&self.ray, hit.t);
        let f = self.seen.spheres[id as usize].f;
        let reach = margin::reach(plan.margins, plan.arithmetic, f, sphere.radius);
        let cell = match (plan.voxelizer, plan.arithmetic) {
            (Voxelizer::ByCenter, _) => cell_of(self.planes, &Point::at(sphere.center)),
            (_, Arithmetic::Rounded(_) | Arithmetic::Spu(_)) => cell_of(self.planes, &point),
            // The true point lies between those of t's neighbours, and so does its cell.
            (_, Arithmetic::Certified) => {
                let [before, after] = [hit.t.next_down(), hit.t.next_up()];
                let cell = cell_of(self.planes, &Point::on(&self.ray, before));
                if cell != cell_of(self.planes, &Point::on(&self.ray, after)) {
                    return Ok(());
                }
                cell
            }
        };
        if plan.arithmetic != Arithmetic::Certified && !point.within(sphere.center, reach) {
            return say("the reported point lies beyond the reach");
        }
        if times_listed(self.grid, cell, id) == 0 {
            return say(&format!("cell {cell:?} holds the point and does not list the sphere"));
        }
        self.visits(cell).or_else(|why| say(&why))?;
        let prepared = &self.seen.spheres[id as usize];
        if plan.culling == Culling::Planes && self.culls(prepared.f, prepared.cull_radius) {
            return say("culled");
        }
        checked.hits += 1;
        checked.near_planes += u64::from(point.near_plane(self.planes));
        checked.beyond_surface +=
            u64::from(!point.within(sphere.center, sphere.radius * (1.0 + 1.0 / 1_048_576.0)));
        Ok(())
    }

    /// Whether the walk comes to a cell.
    fn visits(&self, cell: [usize; 3]) -> Result<(), String> {
        let [i, j, k] = self.frustum.heading.order.map(|axis| cell[axis]);
        let slice = self.frustum.heading.slice_index(self.slices.count, i);
        let [first, last] = [&self.slices.first, &self.slices.last];
        let range = |side: usize| first[side][slice]..=last[side][slice];
        let within = |side: usize, x: usize| i32::try_from(x).is_ok_and(|x| range(side).contains(&x));
        if within(0, j) && within(1, k) {
            return Ok(());
        }
        Err(format!(
            "the walk does not come to cell {cell:?} in slice {slice}: {:?}, {:?}",
            range(0),
            range(1)
        ))
    }

    /// Whether culling drops a ball, given by eye − centre.
    fn culls(&self, f: [f32; 3], radius: f32) -> bool {
        let center = self.frustum.heading.towards(f).map(|x| [x; LANES]);
        Planes::new(Scalar, self.frustum, self.seen.plan.margins).cull(Scalar, center, [radius; LANES])
    }

    /// Where spheres are listed by centre: a centre as far from the point as any sphere reaches, on one axis.
    fn check_center(&self, point: &Point, rng: &mut impl Rng) -> Result<(), String> {
        if self.seen.plan.voxelizer != Voxelizer::ByCenter {
            return Ok(());
        }
        let near = point.0.each_ref().map(to_f32);
        let (i, outward) = (rng.random_range(0..3), rng.random::<bool>());
        let reaches = |x: f32| {
            let mut center = near;
            center[i] = x;
            point.within(center, self.farthest)
        };
        // The point is not rounded: a sphere smaller than what rounding moves it by reaches it from nowhere.
        if !reaches(near[i]) {
            return Ok(());
        }
        let mut beyond = if outward { near[i] + self.farthest } else { near[i] - self.farthest };
        let mut reached = if reaches(beyond) { beyond } else { near[i] };
        loop {
            let middle = reached + (beyond - reached) / 2.0;
            if middle == reached || middle == beyond {
                break;
            }
            *if reaches(middle) { &mut reached } else { &mut beyond } = middle;
        }
        let mut center = near;
        center[i] = reached;
        let planes = &self.grid.axes[i].planes;
        if !(planes[0]..=planes[planes.len() - 1]).contains(&center[i]) {
            return Ok(());
        }
        self.visits(cell_of(self.planes, &Point::at(center)))
            .map_err(|why| format!("a sphere with its centre at {center:?} reaches the point; {why}"))
    }

    #[allow(clippy::cast_possible_truncation, reason = "any t near the crossing will do")]
    fn check_crossings(&self, rng: &mut impl Rng, checked: &mut Checked) -> Result<(), String> {
        let ray = &self.ray;
        for i in 0..3 {
            let axis = &self.grid.axes[i];
            let plane = axis.planes[rng.random_range(0..axis.planes.len())];
            let crossing = (f64::from(plane) - f64::from(ray.eye[i])) / f64::from(ray.dir[i]);
            // A beam reaches what it is aimed at about t = 1.
            let mut t = if rng.random() { 1.0 } else { crossing as f32 };
            for _ in 0..rng.random_range(0..3) {
                t = if rng.random() { t.next_up() } else { t.next_down() };
            }
            let point = Point::on(ray, if t.is_finite() && t > 0.0 { t } else { continue });
            if !point.within_planes(self.planes) {
                continue;
            }
            let say = |what: &str| Err(format!("{what}: t = {t:?}, {ray:?}, {}", self.seen.plan));
            self.visits(cell_of(self.planes, &point)).or_else(|why| say(&why))?;
            checked.points += 1;
            self.check_center(&point, rng).or_else(|why| say(&why))?;

            // A ball beside the point, sideways on a minor axis, whose surface goes through it.
            let side = self.frustum.heading.order[rng.random_range(1..3)];
            let distance = rng.random_range(-1.0f32..1.0) * 10f32.powi(rng.random_range(-6..2)) * t;
            let near: [f32; 3] = std::array::from_fn(|i| ray.eye[i] + t * ray.dir[i]);
            let center: [f32; 3] =
                std::array::from_fn(|i| if i == side { near[i] + distance } else { near[i] });
            let Some(radius) = point.distance_up(center) else { continue };
            let f = [0, 1, 2].map(|i| ray.eye[i] - center[i]);
            if self.culls(f, cull::radius(Scalar.unit(), self.seen.plan.margins, f, radius)) {
                return say(&format!("the ball at {center:?}, radius {radius:?}, is culled"));
            }
            checked.balls += 1;
        }
        Ok(())
    }
}

/// A ball is listed in every cell that holds a real point of it; by centre, in the cell of its centre and no other. No cell
/// lists it twice.
///
/// # Errors
/// A sentence that says which cell does not list which sphere.
pub fn listing_is_complete(seen: &Seen, scene: &Scene) -> Result<Checked, String> {
    let mut checked = Checked::default();
    let Some(grid) = &seen.grid else { return Ok(checked) };
    let planes = planes(grid);
    for (id, sphere) in (0..).zip(scene.spheres()) {
        let prepared = &seen.spheres[id as usize];
        let reach = margin::reach(seen.plan.margins, seen.plan.arithmetic, prepared.f, sphere.radius);
        let reach_square = square(reach);
        let home = cell_of(&planes, &Point::at(sphere.center));
        let gaps = [0, 1, 2].map(|i| -> Vec<Gap> {
            (0..planes[i].len() - 1).map(|cell| Gap::of(&grid.axes[i], cell, sphere.center[i])).collect()
        });
        for cell in all_cells(grid) {
            let holds = match seen.plan.voxelizer {
                Voxelizer::ByCenter => cell == home,
                _ => reaches([0, 1, 2].map(|i| &gaps[i][cell[i]]), &reach_square),
            };
            checked.cells += 1;
            checked.overlapping += u64::from(holds);
            let times = times_listed(grid, cell, id);
            let most = usize::from(holds || seen.plan.voxelizer != Voxelizer::ByCenter);
            if !(usize::from(holds)..=most).contains(&times) {
                return Err(format!(
                    "cell {cell:?} lists sphere {id} {sphere:?} {times} times, reach {reach:?}; {}",
                    seen.plan
                ));
            }
        }
    }
    Ok(checked)
}

/// A grid's lists held against the balls themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Listed {
    /// Ids in cells.
    pub ids: u64,
    /// Of these, spheres that have no point in the cell.
    pub needless: u64,
    /// Of these, ids that the cell lists more than once.
    pub twice: u64,
    /// Cells that hold a point of a sphere and do not list it.
    pub missing: u64,
}

/// Counts what a grid lists in vain, twice, and not at all, sphere by sphere with its own radius.
#[must_use]
pub fn listed(grid: &Grid, scene: &Scene) -> Listed {
    let (mut listed, strides) = (Listed::default(), grid.strides());
    let mut lists: Vec<Vec<u32>> = Vec::new();
    for cell in all_cells(grid) {
        let index: usize = (0..3).map(|i| cell[i] * strides[i]).sum();
        lists.resize(lists.len().max(index + 1), Vec::new());
        grid.for_each_id(index, true, |id| lists[index].push(id));
    }
    for cell in all_cells(grid) {
        let index: usize = (0..3).map(|i| cell[i] * strides[i]).sum();
        let list = &mut lists[index];
        listed.ids += list.len() as u64;
        let before = list.len();
        list.sort_unstable();
        list.dedup();
        listed.twice += (before - list.len()) as u64;
        for &id in &*list {
            let sphere = &scene.spheres()[id as usize];
            listed.needless += u64::from(!meets(grid, cell, sphere.center, sphere.radius));
        }
    }
    for (id, sphere) in (0..).zip(scene.spheres()) {
        for cell in overlapped(grid, sphere.center, sphere.radius) {
            let index: usize = (0..3).map(|axis| cell[axis] * strides[axis]).sum();
            listed.missing += u64::from(lists[index].binary_search(&id).is_err());
        }
    }
    listed
}

/// The cells that hold a real point of a closed ball, in the order of their indices.
#[must_use]
pub fn overlapped(grid: &Grid, center: [f32; 3], radius: f32) -> Vec<[usize; 3]> {
    let range = |i: usize| {
        let at = |x: f64| {
            let inner = &grid.axes[i].planes[1..grid.axes[i].planes.len() - 1];
            inner.iter().filter(|&&plane| f64::from(plane) <= x).count()
        };
        let (c, r) = (f64::from(center[i]), f64::from(radius));
        // A cell more than f64 says on either side.
        at(c - r).saturating_sub(1)..(at(c + r) + 2).min(grid.axes[i].planes.len() - 1)
    };
    let [x, y, z] = [0, 1, 2].map(|i| -> Vec<_> {
        range(i).map(|cell| (cell, Gap::of(&grid.axes[i], cell, center[i]))).collect()
    });
    let (square, mut cells) = (square(radius), Vec::new());
    for (i, on_x) in &x {
        for (j, on_y) in &y {
            cells.extend(
                z.iter().filter(|(_, on_z)| reaches([on_x, on_y, on_z], &square)).map(|(k, _)| [*i, *j, *k]),
            );
        }
    }
    cells
}

/// A point times 2²⁹⁸.
struct Point([IBig; 3]);

impl Point {
    fn on(ray: &Ray, t: f32) -> Self {
        Self([0, 1, 2].map(|i| (integer(ray.eye[i]) << 149) + integer(t) * integer(ray.dir[i])))
    }

    fn at(place: [f32; 3]) -> Self {
        Self(place.map(|x| integer(x) << 149))
    }

    fn within(&self, center: [f32; 3], radius: f32) -> bool {
        let center = Self::at(center);
        let d = [0, 1, 2].map(|i| &self.0[i] - &center.0[i]);
        let r = integer(radius) << 149;
        &d[0] * &d[0] + &d[1] * &d[1] + &d[2] * &d[2] <= &r * &r
    }

    fn within_planes(&self, planes: &[Vec<IBig>; 3]) -> bool {
        (0..3).all(|i| planes[i][0] <= self.0[i] && self.0[i] <= planes[i][planes[i].len() - 1])
    }

    /// The least f32 not below the distance of a point; `None` beyond f32.
    #[allow(clippy::cast_possible_truncation, reason = "a start for the search")]
    fn distance_up(&self, from: [f32; 3]) -> Option<f32> {
        let center = Self::at(from);
        let d = [0, 1, 2].map(|i| to_f64(&(&self.0[i] - &center.0[i])));
        let mut radius = d.iter().map(|x| x * x).sum::<f64>().sqrt() as f32;
        while radius > 0.0 && self.within(from, radius) {
            radius = radius.next_down();
        }
        while radius.is_finite() && !self.within(from, radius) {
            radius = radius.next_up();
        }
        (radius.is_finite() && radius > 0.0).then_some(radius)
    }

    fn near_plane(&self, planes: &[Vec<IBig>; 3]) -> bool {
        (0..3).any(|i| {
            let limit = (&planes[i][planes[i].len() - 1] - &planes[i][0]) >> 12;
            planes[i].iter().any(|plane| (-&limit..=limit.clone()).contains(&(&self.0[i] - plane)))
        })
    }
}

/// A grid's planes on each axis, times 2²⁹⁸.
fn planes(grid: &Grid) -> [Vec<IBig>; 3] {
    grid.axes.each_ref().map(|axis| axis.planes.iter().map(|&plane| integer(plane) << 149).collect())
}

/// The cell of a point: on each axis as many planes as are not above it, but for the two ends.
fn cell_of(planes: &[Vec<IBig>; 3], point: &Point) -> [usize; 3] {
    [0, 1, 2].map(|i| {
        let inner = &planes[i][1..planes[i].len() - 1];
        inner.iter().filter(|&plane| *plane <= point.0[i]).count()
    })
}

/// What lies between a coordinate and a cell's stretch of an axis. A cell has its lower plane and not its upper one; the cells
/// at the ends reach on for ever.
struct Gap {
    /// The distance, squared, times 2²⁹⁸.
    square: IBig,
    /// Whether the cell ends just short of that distance: at its upper plane.
    open: bool,
}

impl Gap {
    fn of(axis: &Axis, cell: usize, x: f32) -> Self {
        let (planes, x) = (&axis.planes, integer(x));
        let lower = (cell > 0).then(|| integer(planes[cell]));
        let upper = (cell + 2 < planes.len()).then(|| integer(planes[cell + 1]));
        let below = lower.map(|lower| lower - &x).filter(|d| *d > IBig::ZERO);
        let above = upper.map(|upper| x - upper).filter(|d| *d >= IBig::ZERO);
        let open = above.is_some();
        let outside = below.or(above).unwrap_or(IBig::ZERO);
        Self { square: &outside * &outside, open }
    }
}

/// A radius, squared, times 2²⁹⁸.
fn square(radius: f32) -> IBig {
    let radius = integer(radius);
    &radius * &radius
}

/// Whether a closed ball so far from a cell on each axis, and of a radius whose square is `limit`, holds a real point of it.
fn reaches(gaps: [&Gap; 3], limit: &IBig) -> bool {
    let (square, open) =
        (&gaps[0].square + &gaps[1].square + &gaps[2].square, gaps.iter().any(|gap| gap.open));
    if open { square < *limit } else { square <= *limit }
}

/// Whether a closed ball holds a real point of a cell.
fn meets(grid: &Grid, cell: [usize; 3], center: [f32; 3], radius: f32) -> bool {
    let gaps = [0, 1, 2].map(|i| Gap::of(&grid.axes[i], cell[i], center[i]));
    reaches(gaps.each_ref(), &square(radius))
}

/// All cells of a grid, in the order of their indices.
pub(crate) fn all_cells(grid: &Grid) -> impl Iterator<Item = [usize; 3]> + use<> {
    let n = [0, 1, 2].map(|i| grid.axes[i].planes.len() - 1);
    (0..n[0]).flat_map(move |i| (0..n[1]).flat_map(move |j| (0..n[2]).map(move |k| [i, j, k])))
}

/// How often a cell lists a sphere.
pub(crate) fn times_listed(grid: &Grid, cell: [usize; 3], id: u32) -> usize {
    let strides = grid.strides();
    let mut times = 0;
    let index = (0..3).map(|i| cell[i] * strides[i]).sum();
    grid.for_each_id(index, true, |listed| times += usize::from(listed == id));
    times
}

/// About x 2⁻²⁹⁸.
fn to_f64(x: &IBig) -> f64 {
    x.to_f64().value() * 2f64.powi(-298)
}

#[allow(clippy::cast_possible_truncation, reason = "about")]
fn to_f32(x: &IBig) -> f32 {
    to_f64(x) as f32
}

/// A finite f32 times 2¹⁴⁹.
fn integer(x: f32) -> IBig {
    assert!(x.is_finite(), "{x} is no number");
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 23) & 0xff, bits & 0x7f_ffff);
    let magnitude = match exponent {
        0 => IBig::from(fraction),
        _ => IBig::from(fraction | 0x80_0000) << (exponent as usize - 1),
    };
    if x.is_sign_negative() { -magnitude } else { magnitude }
}
