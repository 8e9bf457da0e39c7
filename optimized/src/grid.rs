//! The uniform grid, built anew for every frame: which spheres may be hit in which cell.
//!
//! A cell index is always found by one map, [`Axis::cell`]: floor((x − origin) · inverse cell size), clamped. Each
//! rounding in it is monotone, so the map is monotone over all f32. Hence an axis has exact *planes*:
//! `planes[i]` is the least f32 in cell i or above, found by binary search over bit patterns. A real number x
//! is said to lie in cell i if `planes[i] <= x < planes[i + 1]`; for f32 that agrees with the map (`tests/cells.rs`), and it makes
//! statements about real points exact, though the map rounds.
//!
//! A voxelizer lists a sphere in cells of its box: the centre minus and plus the reach of [`crate::margin`],
//! rounded outward. A real point P of the ball has lo <= P <= hi on each axis, so by monotony its cell lies
//! between those of lo and hi; a voxelizer is *complete* if it lists the sphere there.
//!
//! What a cell is, a queue or a piece of one list (Lagae and Dutré 2008), is the plan's choice. The ids of a cell come in
//! no order that anything may rely on.

use crate::bins::Bins;
use crate::crew::Crew;
use crate::event::{Event, Events, RenderError};
use crate::machine::{Chore, LANES, Machine, Site};
use crate::plan::{Cells, OnEvent, Plan, Resolution, Voxelizer};
use crate::queue::{MAX_IDS, Queue, push_all};
use crate::voxelize::CellBox;
use contract::Sphere;

/// The most cells on an axis.
pub const MAX_CELLS: usize = 240;
/// Cells a sphere should have for itself: λ of n = d ∛(λ N / V) (Wald et al. 2006 use 3 to 5).
const DENSITY: f64 = 4.0;

/// Ids in lists to a sphere, and to a grid beside, above which a grid that may choose is made coarser: where spheres are as large as
/// the grid, every cell lists nearly all of them, and memory would go with their square.
const LISTED: u64 = 512;
const LISTED_BESIDE: u64 = 1 << 22;

/// The same for tiles, whose cells are to hold about a row of lanes: measured, see [`crate::tile`].
const TILE_DENSITY: f64 = 1.0 / 32.0;

/// One axis of the grid.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Cells.
    pub n: i32,
    /// Where cell 0 begins.
    pub origin: f32,
    /// Cells to a unit of length.
    pub inverse: f32,
    /// n + 1 numbers: the least f32 of each cell, then the upper end of the grid.
    pub planes: Vec<f32>,
}

/// A ball in which a sphere may be hit, with a box around it.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Lower corner.
    pub lo: [f32; 3],
    /// Upper corner.
    pub hi: [f32; 3],
    /// Centre.
    pub center: [f32; 3],
    /// How far from the centre.
    pub radius: f32,
}

/// Cells and what they hold.
#[derive(Clone, Debug)]
pub struct Grid {
    /// The three axes.
    pub axes: [Axis; 3],
    /// How far from the packet's rays a cell may be and yet list a sphere that they hit: 0, or the largest reach if
    /// spheres are listed by centre.
    pub widen: f32,
    /// Spheres that are in no cell: every packet is to meet them. Only by centre, and so large that all packets would have to look as
    /// far around for their sake.
    pub large: Vec<u32>,
    storage: Storage,
}

/// What a grid for tiles was made in, kept for the next frame's.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    places: Vec<u32>,
    bins: Bins,
}

impl Memory {
    /// Takes back what a grid was made of.
    pub fn take(&mut self, grid: Option<Grid>) {
        if let Some(Grid { large, storage: Storage::Lists { offsets, ids }, .. }) = grid {
            self.bins = Bins { offsets, ids, large, radius: 0.0 };
        }
    }
}

#[derive(Clone, Debug)]
enum Storage {
    Queues(Vec<Queue>),
    Lists { offsets: Vec<u32>, ids: Vec<u32> },
}

impl Bounds {
    /// A ball and the box around it, rounded outward.
    #[must_use]
    pub fn outward(center: [f32; 3], radius: f32) -> Self {
        Self {
            lo: center.map(|c| (c - radius).next_down()),
            hi: center.map(|c| (c + radius).next_up()),
            center,
            radius,
        }
    }

    /// A ball and the box around it, rounded to nearest as the paper would.
    #[must_use]
    pub fn nearest(center: [f32; 3], radius: f32) -> Self {
        Self { lo: center.map(|c| c - radius), hi: center.map(|c| c + radius), center, radius }
    }

    /// The centre alone, with the radius it had.
    fn point(self) -> Self {
        Self { lo: self.center, hi: self.center, ..self }
    }
}

impl Axis {
    /// Divides lo..hi into n cells, 1 to [`MAX_CELLS`]; into one if lo = hi or hi − lo is beyond f32, since no f32 would lie in the others
    /// and yet their planes would be those of the one.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "n is small")]
    pub fn new<M: Machine>(m: M, lo: f32, hi: f32, n: i32) -> Self {
        let n = if lo < hi && (hi - lo).is_finite() { n } else { 1 };
        let mut axis = Self { n, origin: lo, inverse: n as f32 / (hi - lo), planes: vec![lo] };
        while axis.planes.len() < n.unsigned_abs() as usize {
            axis.find_planes(m, lo, hi);
        }
        axis.planes.truncate(n.unsigned_abs() as usize);
        axis.planes.push(hi);
        axis
    }

    /// Kernel: the cells of sixteen coordinates.
    #[inline(always)]
    pub fn cell<M: Machine>(&self, m: M, x: M::F) -> M::I {
        let scaled = m.mul(m.sub(x, m.splat(self.origin)), m.splat(self.inverse));
        let (cell, first, last) = (m.floor(scaled), m.splat_i(0), m.splat_i(self.n - 1));
        let cell = m.select_i(m.lt_i(cell, first), first, cell);
        m.select_i(m.lt_i(last, cell), last, cell)
    }

    /// Rim: the cells of sixteen coordinates, by way of the machine's door.
    fn cell_array<M: Machine>(&self, m: M, x: [f32; LANES]) -> [i32; LANES] {
        m.within(
            #[inline(always)]
            || m.to_array_i(self.cell(m, m.lanes(x))),
        )
    }

    /// The next sixteen planes: for each the least f32 whose cell is at least its index.
    fn find_planes<M: Machine>(&mut self, m: M, lo: f32, hi: f32) {
        let first = i32::try_from(self.planes.len()).expect("n is an i32");
        let (mut below, mut above) = ([rank(lo); LANES], [rank(hi) + 1; LANES]);
        while (0..LANES).any(|i| above[i] - below[i] > 1) {
            let middle: [i64; LANES] = std::array::from_fn(|i| below[i] + (above[i] - below[i]) / 2);
            let cells = self.cell_array(m, middle.map(unrank));
            for (i, wanted) in (0..LANES).zip(first..) {
                let half = if cells[i] >= wanted { &mut above } else { &mut below };
                half[i] = middle[i];
            }
        }
        self.planes.extend(above.map(|rank| unrank(rank).min(hi)));
    }
}

/// The place of a finite f32 in their order, −0 and +0 being one.
fn rank(x: f32) -> i64 {
    let magnitude = i64::from(x.to_bits() & 0x7fff_ffff);
    if x < 0.0 { -magnitude } else { magnitude }
}

#[allow(clippy::cast_possible_truncation, reason = "ranks of f32 have 31 bits and a sign")]
fn unrank(rank: i64) -> f32 {
    let magnitude = f32::from_bits(rank.unsigned_abs() as u32);
    if rank < 0 { -magnitude } else { magnitude }
}

impl Grid {
    /// A grid over the balls of all spheres, of which there is at least one, as the plan has it. Events are added to the
    /// list; the plan's fall-backs are taken. Where its lists do not fit it is made coarser ([`Resolution`]).
    ///
    /// # Errors
    /// [`RenderError::Refused`] if the plan refuses an event, [`RenderError::Resolution`] for one that is out of range,
    /// [`RenderError::Lists`] if there is no coarser grid, or the plan refuses one that has not the cells asked for.
    pub fn build<M: Machine>(
        m: M,
        plan: &Plan,
        balls: &[Bounds],
        events: &mut Events,
    ) -> Result<Self, RenderError> {
        let mut plan = *plan;
        let by_center = plan.voxelizer == Voxelizer::ByCenter;
        let boxes: Vec<Bounds> =
            balls.iter().map(|ball| if by_center { ball.point() } else { *ball }).collect();
        let widen = if by_center {
            widen(m.unit(), balls.iter().map(|ball| ball.radius).fold(0.0, f32::max))
        } else {
            0.0
        };
        let whole = whole(&boxes);
        let widest = balls.iter().map(|ball| f64::from(ball.radius)).fold(0.0, f64::max) * 2.001;
        let mut n = resolution(&plan, &whole, DENSITY * balls.len() as f64, widest)?;
        loop {
            let axes = [0, 1, 2].map(|i| Axis::new(m, whole[0][i], whole[1][i], n[i]));
            let cell_boxes: Vec<CellBox> =
                boxes.chunks(LANES).flat_map(|chunk| cell_boxes(m, &axes, chunk)).collect();
            if plan.voxelizer == Voxelizer::EightCorners {
                let mut spans = (0..).zip(&cell_boxes).filter_map(|(id, cells)| cells.spans(id));
                if let Some(event) = spans.next() {
                    plan.voxelizer = taken(&plan, &event, plan.voxelizer, Voxelizer::BoxRange)?;
                    events.push(event);
                    spans.for_each(|event| events.push(event));
                }
            }
            if plan.cells == Cells::Queue && balls.len() > MAX_IDS {
                let event = Event::TooManyIds { spheres: balls.len() };
                // Not even the paper can go on: an id would become another.
                taken(&plan, &event, plan.cells, Cells::Lists)?;
                events.push(event);
                plan.cells = Cells::Lists;
            }
            if plan.cells == Cells::Queue {
                match fill_queues(m, &plan, &axes, balls, &cell_boxes, events) {
                    Ok(queues) => {
                        return Ok(Self { axes, widen, large: Vec::new(), storage: Storage::Queues(queues) });
                    }
                    Err(full) => {
                        plan.cells = taken(&plan, &full, plan.cells, Cells::Lists)?;
                        events.push(full);
                    }
                }
            }
            if let Some(storage) = fill_lists(m, &plan, &axes, balls, &cell_boxes) {
                return Ok(Self { axes, widen, large: Vec::new(), storage });
            }
            let is_asked_for = matches!(plan.resolution, Resolution::Fixed(_));
            if n == [1; 3] || (is_asked_for && plan.on_event == OnEvent::Refuse) {
                return Err(RenderError::Lists { cells: axes.map(|axis| axis.n) });
            }
            n = n.map(|n| (n / 2).max(1));
        }
    }

    /// A grid for tiles: over the centres of spheres, of which there is at least one and whose reach is their radius, in the memory of
    /// an earlier one. Large spheres are set apart; a tile looks as far around as the largest of the others. It takes 8 bytes a sphere and
    /// 4 a cell, of which there is one to 32 spheres unless the plan says otherwise: 8.1 bytes beside the scene's own 20.
    ///
    /// # Errors
    /// [`RenderError::Resolution`] for one that is out of range.
    pub fn by_center<M: Machine + Send + Sync>(
        m: M,
        plan: &Plan,
        spheres: &[Sphere],
        memory: &mut Memory,
        crew: &Crew,
    ) -> Result<Self, RenderError> {
        let (whole, large_from) = m.within(
            #[inline(always)]
            || survey(m, spheres),
        );
        let n = resolution(plan, &whole, TILE_DENSITY * spheres.len() as f64, 0.0)?;
        let axes = [0, 1, 2].map(|i| Axis::new(m, whole[0][i], whole[1][i], n[i]));
        let mut bins = std::mem::take(&mut memory.bins);
        bins.fill(m, &axes, spheres, large_from, &mut memory.places, crew);
        let Bins { offsets, ids, large, radius } = bins;
        Ok(Self { axes, widen: widen(m.unit(), radius), large, storage: Storage::Lists { offsets, ids } })
    }

    /// Calls `visit` with each id of a cell. `live` = no makes every cell empty.
    #[inline(always)]
    pub fn for_each_id(&self, index: usize, live: bool, mut visit: impl FnMut(u32)) {
        match &self.storage {
            Storage::Queues(queues) if live => {
                for id in queues[index].ids() {
                    visit(id);
                }
            }
            Storage::Queues(_) => {}
            Storage::Lists { offsets, ids } => {
                let start = offsets[index] as usize;
                let end = if live { offsets[index + 1] as usize } else { start };
                for &id in &ids[start..end] {
                    visit(id);
                }
            }
        }
    }

    /// What a range of cells of a grid of lists holds; of queues, nothing.
    #[inline(always)]
    #[must_use]
    pub fn row(&self, [first, last]: [usize; 2]) -> &[u32] {
        let Storage::Lists { offsets, ids } = &self.storage else { return &[] };
        &ids[offsets[first] as usize..offsets[last + 1] as usize]
    }

    /// Whether its cells are queues.
    #[must_use]
    pub fn has_queues(&self) -> bool {
        matches!(self.storage, Storage::Queues(_))
    }

    /// How far apart in the list neighbours on each axis are.
    #[inline(always)]
    #[must_use]
    pub fn strides(&self) -> [usize; 3] {
        strides(&self.axes)
    }
}

fn strides(axes: &[Axis; 3]) -> [usize; 3] {
    let n = [0, 1, 2].map(|i| axes[i].n.unsigned_abs() as usize);
    [n[1] * n[2], n[2], 1]
}

fn index(strides: [usize; 3], cell: [i32; 3]) -> usize {
    (0..3).map(|i| cell[i].unsigned_abs() as usize * strides[i]).sum()
}

fn cells(axes: &[Axis; 3]) -> usize {
    axes.iter().map(|axis| axis.n.unsigned_abs() as usize).product()
}

/// What to take after an event.
fn taken<T>(plan: &Plan, event: &Event, chosen: T, instead: T) -> Result<T, RenderError> {
    match plan.on_event {
        OnEvent::GoOn => Ok(chosen),
        OnEvent::FallBack => Ok(instead),
        OnEvent::Refuse => Err(RenderError::Refused(event.clone())),
    }
}

/// The paper's voxelization: all queues of a sphere's cells are read before any is written. An overflow is an event if
/// the plan goes on, and an error if it does not.
fn fill_queues<M: Machine>(
    m: M,
    plan: &Plan,
    axes: &[Axis; 3],
    balls: &[Bounds],
    boxes: &[CellBox],
    events: &mut Events,
) -> Result<Vec<Queue>, Event> {
    let strides = strides(axes);
    let mut queues = m.beside(Chore::Clear(2 * cells(axes)), || vec![Queue::EMPTY; cells(axes)]);
    let (mut places, mut full) = (Vec::new(), Vec::new());
    for ((id, cells), ball) in (0..).zip(boxes).zip(balls) {
        places.clear();
        cells.for_each(plan.voxelizer, axes, ball, |cell| {
            let place = index(strides, cell);
            places.push(place);
            full.extend(queues[place].oldest().map(|lost| Event::CellFull { cell, pushed: id, lost }));
        });
        for event in full.drain(..) {
            if plan.on_event != OnEvent::GoOn {
                return Err(event);
            }
            events.push(event);
        }
        push_all(m, &mut queues, &places, id);
        m.branch(id as usize + 1 < balls.len(), Site::NextSphere);
    }
    Ok(queues)
}

/// Count, then write. `None` if there are more entries than u32 can number, than memory can hold or, where the plan lets a grid choose
/// its cells, than [`LISTED`] says: a coarser grid is needed.
fn fill_lists<M: Machine>(
    m: M,
    plan: &Plan,
    axes: &[Axis; 3],
    balls: &[Bounds],
    boxes: &[CellBox],
) -> Option<Storage> {
    let strides = strides(axes);
    // One cell lists each sphere once, which takes less than the scene itself.
    let is_coarsest = cells(axes) == 1;
    let most = match plan.resolution {
        Resolution::UpTo(_) if !is_coarsest => LISTED * balls.len() as u64 + LISTED_BESIDE,
        Resolution::UpTo(_) | Resolution::Fixed(_) => u64::MAX,
    };
    let mut counts = m.beside(Chore::Clear(cells(axes).div_ceil(4)), || vec![0u64; cells(axes)]);
    let mut listed = 0u64;
    for (cells, ball) in boxes.iter().zip(balls) {
        cells.for_each(plan.voxelizer, axes, ball, |cell| {
            m.beside(Chore::Entry, || counts[index(strides, cell)] += 1);
            listed += 1;
        });
        if listed > most {
            return None;
        }
    }
    let mut offsets = Vec::with_capacity(counts.len() + 1);
    let mut entries = 0u64;
    for count in counts {
        offsets.push(u32::try_from(entries).ok()?);
        entries += count;
    }
    offsets.push(u32::try_from(entries).ok()?);
    let mut next = offsets.clone();
    let (entries, mut ids) = (usize::try_from(entries).ok()?, Vec::<u32>::new());
    ids.try_reserve_exact(entries).ok()?;
    ids.resize(entries, 0);
    for ((id, cells), ball) in (0..).zip(boxes).zip(balls) {
        cells.for_each(plan.voxelizer, axes, ball, |cell| {
            m.beside(Chore::Entry, || {
                let next = &mut next[index(strides, cell)];
                ids[*next as usize] = id;
                *next += 1;
            });
        });
        m.branch(id as usize + 1 < balls.len(), Site::NextSphere);
    }
    Some(Storage::Lists { offsets, ids })
}

/// The cells of up to sixteen boxes.
fn cell_boxes<M: Machine>(
    m: M,
    axes: &[Axis; 3],
    chunk: &[Bounds],
) -> impl Iterator<Item = CellBox> + use<M> {
    m.beside(Chore::Boxes, || ());
    let corner = |i: usize, pick: fn(&Bounds) -> [f32; 3]| {
        let mut lanes = [0.0; LANES];
        for (lane, bounds) in lanes.iter_mut().zip(chunk) {
            *lane = pick(bounds)[i];
        }
        axes[i].cell_array(m, lanes)
    };
    let lo = [0, 1, 2].map(|i| corner(i, |b| b.lo));
    let hi = [0, 1, 2].map(|i| corner(i, |b| b.hi));
    (0..chunk.len())
        .map(move |lane| CellBox { lo: [0, 1, 2].map(|i| lo[i][lane]), hi: [0, 1, 2].map(|i| hi[i][lane]) })
}

/// How far around the rays of a packet cells list what they hit, where spheres are listed by centre: the largest reach, and 16u of it for the
/// roundings of the distances it is compared with.
#[must_use]
pub fn widen(unit: f32, reach: f32) -> f32 {
    (1.0 + 16.0 * unit) * reach
}

/// The box around all boxes.
fn whole(boxes: &[Bounds]) -> [[f32; 3]; 2] {
    boxes.iter().fold([[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]], |[lo, hi], b| {
        [[0, 1, 2].map(|i| lo[i].min(b.lo[i])), [0, 1, 2].map(|i| hi[i].max(b.hi[i]))]
    })
}

/// The box around all centres, and the radius from which on a sphere is large: the least power of two that one in 64 and 32 more spheres
/// reach at most.
#[inline(always)]
fn survey<M: Machine>(m: M, spheres: &[Sphere]) -> ([[f32; 3]; 2], f32) {
    let (mut lo, mut hi) = ([m.splat(f32::INFINITY); 3], [m.splat(f32::NEG_INFINITY); 3]);
    // Neighbours mostly have the same exponent: four counts for each, so that none waits for the one before.
    let mut of_exponents = [[0usize; 256]; 4];
    for chunk in spheres.chunks(LANES) {
        // Lanes that are left over have the first sphere's centre.
        let mut centers = [[0.0; LANES], [0.0; LANES], [0.0; LANES]];
        for lane in 0..LANES {
            let Sphere { center, .. } = chunk[if lane < chunk.len() { lane } else { 0 }];
            [centers[0][lane], centers[1][lane], centers[2][lane]] = center;
        }
        for i in 0..3 {
            let x = m.lanes(centers[i]);
            (lo[i], hi[i]) = (m.min(x, lo[i]), m.max(x, hi[i]));
        }
        for (lane, sphere) in chunk.iter().enumerate() {
            of_exponents[lane % 4][(sphere.radius.to_bits() >> 23) as usize] += 1;
        }
    }
    let of_exponent: [usize; 256] = std::array::from_fn(|i| of_exponents.iter().map(|of| of[i]).sum());
    let (mut large, mut from) = (0, f32::INFINITY);
    for (exponent, count) in (0..256u32).zip(of_exponent).rev() {
        // Not to be counted before it is asked: the rest may be all of one exponent, and those before it large nevertheless.
        if large + count > spheres.len() / 64 + 32 {
            break;
        }
        large += count;
        from = f32::from_bits(exponent << 23);
    }
    // Where all would be large, none is.
    let mut whole = [[0.0; 3]; 2];
    for i in 0..3 {
        (whole[0][i], whole[1][i]) = (m.to_array(m.smallest(lo[i]))[0], m.to_array(m.largest(hi[i]))[0]);
    }
    (whole, if large == spheres.len() { f32::INFINITY } else { from })
}

/// The most cells that a plan wants on an axis.
///
/// # Errors
/// [`RenderError::Resolution`] for zero or more than [`MAX_CELLS`].
pub(crate) fn limit(plan: &Plan) -> Result<u8, RenderError> {
    let (Resolution::Fixed(limit) | Resolution::UpTo(limit)) = plan.resolution;
    if limit == 0 || usize::from(limit) > MAX_CELLS {
        return Err(RenderError::Resolution { cells: limit });
    }
    Ok(limit)
}

/// Cells on each axis. Chosen ones are cubes, about as many as wanted; for eight corners they are wider than any
/// sphere's box.
#[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "a rule of thumb")]
fn resolution(
    plan: &Plan,
    [lo, hi]: &[[f32; 3]; 2],
    wanted: f64,
    widest: f64,
) -> Result<[i32; 3], RenderError> {
    let limit = limit(plan)?;
    if let Resolution::Fixed(n) = plan.resolution {
        return Ok([i32::from(n); 3]);
    }
    let extent = [0, 1, 2].map(|i| f64::from(hi[i]) - f64::from(lo[i]));
    // An axis without extent (one sphere by centre) has one cell; it counts as one unit in the volume.
    let volume: f64 = extent.iter().filter(|e| **e > 0.0).product();
    let per_unit = (wanted / volume).cbrt();
    Ok(extent.map(|e| {
        let n = ((e * per_unit).round() as i32).clamp(1, i32::from(limit));
        if plan.voxelizer == Voxelizer::EightCorners { n.min((e / widest) as i32).max(1) } else { n }
    }))
}
