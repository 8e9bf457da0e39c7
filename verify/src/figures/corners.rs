//! A sphere, its box with eight corners, and the cells around it: which list it, which it truly meets, and which are missed.
//!
//! In: a plan, a scene, a camera. Out: what the shipped grid lists of two spheres, held against the exact overlap, and the drawing: the
//! cells slice by slice along the axis on which the sphere spans fewest. In a slice the disc is the largest section of the ball, so that a
//! cell is met by the ball if and only if its square is met by the disc.

use super::svg::{LEFT, Sign, Svg, WIDTH};
use super::{Figure, FigureError, Input};
use crate::report::words::{count, figure};
use crate::visible::{all_cells, overlapped, times_listed};
use contract::{Camera, Scene, Sphere};
use optimized::Events;
use optimized::crew::Crew;
use optimized::grid::{Bounds, Grid, Memory};
use optimized::host::Scalar;
use optimized::margin;
use optimized::plan::{Cells, Margins, Plan, Voxelizer};
use optimized::seen::Seen;
use std::collections::BTreeMap;

/// What a cell is to a sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    /// The voxelizer lists the sphere in it.
    pub listed: bool,
    /// It holds a point of the ball.
    pub met: bool,
    /// It lists it in the end: a full queue loses its oldest.
    pub kept: bool,
}

impl Cell {
    /// A false negative.
    #[must_use]
    pub fn is_missed(&self) -> bool {
        self.met && !self.listed
    }

    /// A false positive.
    #[must_use]
    pub fn is_needless(&self) -> bool {
        self.listed && !self.met
    }

    /// Lost to newer ids.
    #[must_use]
    pub fn is_pushed_out(&self) -> bool {
        self.listed && !self.kept
    }

    fn class(&self) -> &'static str {
        match (self.listed, self.met) {
            (true, true) => "right",
            (true, false) => "needless",
            (false, _) => "missed",
        }
    }
}

/// A sphere and the cells around it.
#[derive(Clone, Debug)]
pub struct Ball {
    /// Its id.
    pub id: u32,
    /// Itself.
    pub sphere: Sphere,
    /// The box whose corners or cells are listed.
    pub bounds: Bounds,
    /// Cells that list it or hold a point of it.
    pub cells: BTreeMap<[usize; 3], Cell>,
}

/// What was found of all spheres, and two of them to be drawn.
#[derive(Clone, Debug)]
pub struct Corners {
    /// The plan.
    pub plan: Plan,
    /// The grid as the plan has it.
    pub grid: Grid,
    /// Spheres.
    pub spheres: usize,
    /// Of these, ones whose box spans more than two cells on an axis.
    pub spanning: u64,
    /// Cells that hold a point of a sphere and do not list it, over all spheres.
    pub missed: u64,
    /// Of the spheres that are wider than a cell on some axis, or of all if there is none, the one with the most missed cells, and of equals
    /// with the most needless ones.
    pub large: Ball,
    /// Whether it is narrower than a cell on every axis, as then all are.
    pub all_small: bool,
    /// Of those that are narrower than a cell on every axis, the one with the most needless cells.
    pub small: Option<Ball>,
}

impl Ball {
    /// How many cells are so.
    #[must_use]
    pub fn count(&self, so: impl Fn(&Cell) -> bool) -> u64 {
        self.cells.values().filter(|cell| so(cell)).count() as u64
    }
}

/// Holds what a plan lists of each sphere against the exact overlap.
///
/// # Errors
/// [`FigureError`] if there is no grid, or the tracer refuses the scene.
pub fn of(plan: Plan, scene: &Scene, camera: &Camera) -> Result<Corners, FigureError> {
    let prepared = |plan: Plan| {
        let (mut memory, mut events) = (Memory::default(), Events::default());
        let seen = Seen::new(Scalar, plan, scene, camera, &mut memory, &mut events, &Crew::alone())?;
        Ok::<_, FigureError>((seen, events))
    };
    // Before any queue overflows.
    let (lists, events) = prepared(Plan { cells: Cells::Lists, ..plan })?;
    let (kept, _) = prepared(plan)?;
    let (Some(grid), Some(kept)) = (lists.grid, kept.grid) else { return Err(FigureError::NoGrid) };
    let strides = grid.strides();
    let index = |cell: [usize; 3]| -> usize { (0..3).map(|axis| cell[axis] * strides[axis]).sum() };
    let mut listing: Vec<Vec<[usize; 3]>> = vec![Vec::new(); scene.spheres().len()];
    for cell in all_cells(&grid) {
        grid.for_each_id(index(cell), true, |id| listing[id as usize].push(cell));
    }
    let ball = |id: u32| {
        let sphere = scene.spheres()[id as usize];
        let reach = margin::reach(plan.margins, plan.arithmetic, lists.spheres[id as usize].f, sphere.radius);
        let bounds = match plan.margins {
            Margins::None => Bounds::nearest(sphere.center, reach),
            Margins::Derived => Bounds::outward(sphere.center, reach),
        };
        let mut cells = BTreeMap::<[usize; 3], Cell>::new();
        for &cell in &listing[id as usize] {
            let kept = times_listed(&kept, cell, id) > 0;
            cells.insert(cell, Cell { listed: true, met: false, kept });
        }
        for cell in overlapped(&grid, sphere.center, sphere.radius) {
            cells.entry(cell).or_default().met = true;
        }
        Ball { id, sphere, bounds, cells }
    };
    // Narrower than the narrowest cell of each axis, by its planes.
    let narrowest = [0, 1, 2].map(|axis| {
        let planes = &grid.axes[axis].planes;
        planes.windows(2).map(|pair| f64::from(pair[1]) - f64::from(pair[0])).fold(f64::INFINITY, f64::min)
    });
    let is_small = |ball: &Ball| narrowest.iter().all(|width| 2.0 * f64::from(ball.sphere.radius) < *width);
    let (mut large, mut small, mut missed) = (None::<([u64; 2], Ball)>, None::<([u64; 2], Ball)>, 0);
    for id in (0..).take(scene.spheres().len()) {
        let ball = ball(id);
        let misses = ball.count(Cell::is_missed);
        missed += misses;
        let best = if is_small(&ball) { &mut small } else { &mut large };
        let rank = [misses, ball.count(Cell::is_needless)];
        if best.as_ref().is_none_or(|(most, _)| rank > *most) {
            *best = Some((rank, ball));
        }
    }
    // With lists nothing else can happen to a plan that has a grid.
    let spanning = events.count();
    let all_small = large.is_none();
    let (large, small) = match (large, small) {
        (Some((_, large)), small) => (large, small.map(|(_, small)| small)),
        (None, Some((_, small))) => (small, None),
        (None, None) => return Err(FigureError::NoGrid),
    };
    let spheres = scene.spheres().len();
    Ok(Corners { plan, grid: kept, spheres, spanning, missed, large, all_small, small })
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// The drawing.
#[must_use]
pub fn draw(input: &Input<'_>, found: &Corners) -> Figure {
    let title = match found.plan.voxelizer {
        Voxelizer::EightCorners => "Eight corners, and the cells between them",
        Voxelizer::BoxRange | Voxelizer::Overlap | Voxelizer::ByCenter => "The cells that list a sphere",
    };
    let mut svg = Svg::new(&format!("{title}: two spheres of {}", input.name));
    let mut at = ball(&mut svg, &found.grid, &found.large, 0.0);
    if let Some(small) = &found.small {
        at = ball(&mut svg, &found.grid, small, at + 24.0);
    }
    svg.legend(
        at + 8.0,
        &[
            (Sign::Box("right"), "listed, and met"),
            (Sign::Box("needless"), "listed, not met: false positive"),
            (Sign::Box("missed"), "met, not listed: missed"),
            (Sign::Stroke("pushed"), "crossed: pushed out of its full queue"),
            (Sign::Round("section"), "the ball's largest section in the slice"),
            (Sign::Round("corner"), "corners of its box"),
        ],
    );
    let n = found.grid.axes.each_ref().map(|axis| axis.n);
    let small = found.small.as_ref().map_or_else(
        || {
            let which = if found.all_small { "All spheres are" } else { "No sphere is" };
            format!(" {which} narrower than a cell on every axis.")
        },
        |small| format!(" Below it one that is narrower than a cell: {}", sentence(small)),
    );
    // Only for eight corners is that a broken precondition, and told by the grid.
    let spanning = match found.plan.voxelizer {
        Voxelizer::EightCorners => {
            format!("; {} spheres span more than two cells on an axis", count(found.spanning))
        }
        Voxelizer::BoxRange | Voxelizer::Overlap | Voxelizer::ByCenter => String::new(),
    };
    let caption = format!(
        "{} spheres in {}x{}x{} cells, {}. {}{small} Over all spheres {} cells hold a point of one and do not list it{spanning}.",
        count(found.spheres as u64),
        n[0],
        n[1],
        n[2],
        voxelizer(found.plan.voxelizer),
        sentence(&found.large),
        count(found.missed),
    );
    Figure { name: "corners", title: title.into(), caption, svg: svg.finish() }
}

fn voxelizer(voxelizer: Voxelizer) -> &'static str {
    match voxelizer {
        Voxelizer::EightCorners => "listed where the eight corners of their boxes lie",
        Voxelizer::BoxRange => "listed in all cells of their boxes",
        Voxelizer::Overlap => "listed in all cells that they meet",
        Voxelizer::ByCenter => "listed where their centres lie",
    }
}

fn sentence(ball: &Ball) -> String {
    let pushed = match ball.count(Cell::is_pushed_out) {
        0 => String::new(),
        n => format!("; {} lost it from full queues", count(n)),
    };
    format!(
        "Sphere {} of radius {} meets {} cells; {} list it, {} of them in vain; {} miss it{pushed}.",
        ball.id,
        figure(ball.sphere.radius.into()),
        count(ball.count(|cell| cell.met)),
        count(ball.count(|cell| cell.listed)),
        count(ball.count(Cell::is_needless)),
        count(ball.count(Cell::is_missed)),
    )
}

/// The cells of a sphere, from `top` on; where the next thing may stand.
fn ball(svg: &mut Svg, grid: &Grid, ball: &Ball, top: f64) -> f64 {
    let span = |axis: usize| {
        let of = || ball.cells.keys().map(|cell| cell[axis]);
        [of().min().unwrap_or(0), of().max().unwrap_or(0)]
    };
    // Along the axis with the fewest slices; the other two are drawn as they are seen from its far end.
    let along = (0..3).min_by_key(|&axis| span(axis)[1] - span(axis)[0]).unwrap_or(2);
    let [across, up] = [(along + 1) % 3, (along + 2) % 3];
    let planes = |axis: usize| grid.axes[axis].planes.iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
    let ends = |axis: usize| {
        let ([first, last], planes) = (span(axis), planes(axis));
        [planes[first], planes[last + 1]]
    };
    let ([left, right], [low, high]) = (ends(across), ends(up));
    let [first, last] = span(along);
    let slices = last - first + 1;
    let (in_row, gap) = (slices.min(6), 14.0);
    let room = (WIDTH - 2.0 * LEFT - gap * (in_row - 1) as f64) / in_row as f64;
    let scale = (room.min(220.0) / (right - left)).min(220.0 / (high - low));
    let (width, height) = (scale * (right - left), scale * (high - low));
    let words = format!(
        "sphere {}: {} to the right, {} upwards, slices along {}",
        ball.id, AXES[across], AXES[up], AXES[along]
    );
    svg.words("head", "start", [LEFT, top + 14.0], &words);
    let mut bottom = top;
    for (number, slice) in (first..=last).enumerate() {
        let x0 = LEFT + (number % in_row) as f64 * (width + gap).max(62.0);
        let y0 = top + 46.0 + (number / in_row) as f64 * (height + 30.0);
        let at = |u: f64, v: f64| [x0 + scale * (u - left), y0 + scale * (high - v)];
        svg.words("faint", "start", [x0, y0 - 6.0], &format!("{} = {slice}", AXES[along]));
        for (place, cell) in ball.cells.iter().filter(|(place, _)| place[along] == slice) {
            let (us, vs) = (planes(across), planes(up));
            let corner = at(us[place[across]], vs[place[up] + 1]);
            let size = [
                scale * (us[place[across] + 1] - us[place[across]]),
                scale * (vs[place[up] + 1] - vs[place[up]]),
            ];
            svg.rect(cell.class(), corner, size);
            if cell.is_pushed_out() {
                let inset = size.map(|side| 0.2 * side);
                let other = [corner[0] + size[0] - inset[0], corner[1] + size[1] - inset[1]];
                svg.line("pushed", [corner[0] + inset[0], corner[1] + inset[1]], other);
                svg.line("pushed", [corner[0] + inset[0], other[1]], [other[0], corner[1] + inset[1]]);
            }
        }
        svg.rect("border", [x0, y0], [width, height]);
        let (center, radius) = (ball.sphere.center.map(f64::from), f64::from(ball.sphere.radius));
        let slab = planes(along);
        // Cells at the ends reach on for ever.
        let below = if slice == 0 { f64::NEG_INFINITY } else { slab[slice] };
        let above = if slice + 2 == slab.len() { f64::INFINITY } else { slab[slice + 1] };
        let off = (below - center[along]).max(center[along] - above).max(0.0);
        if off < radius {
            let section = (radius * radius - off * off).sqrt();
            svg.circle("section", at(center[across], center[up]), scale * section, None);
        }
        for corner in 0..8u8 {
            let of = |axis: usize| {
                let end = if corner >> axis & 1 == 0 { ball.bounds.lo } else { ball.bounds.hi };
                f64::from(end[axis])
            };
            if below <= of(along) && of(along) < above {
                svg.circle("corner", at(of(across), of(up)), 2.5, None);
            }
        }
        bottom = y0 + height;
    }
    bottom
}
