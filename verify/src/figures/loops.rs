//! Both loops of the paper's Figure 3, and the flattened one as it is printed, over three slices of a real packet: which cells they come
//! to, and in which order.
//!
//! In: a packet's slices. Out: the cells that the shipped loops visit, and the drawing of their paths. Chosen are the three slices in which
//! the printed loop goes most astray.

use super::svg::{LEFT, Sign, Svg, WIDTH};
use super::{Figure, Input};
use optimized::frustum::Slices;
use optimized::grid::MAX_CELLS;
use optimized::host::Scalar;
use optimized::machine::LANES;
use optimized::plan::Loop;
use optimized::walk::{Visitor, walk};

/// Slices that are drawn, if the packet has so many.
const DRAWN: usize = 3;
/// The most cells of these, if it can be.
const MOST: usize = 36;

/// What the loops visit.
#[derive(Clone, Debug)]
pub struct Loops {
    /// Number of the first slice in the packet's walk.
    pub from: usize,
    /// First and last j, first and last k of each slice.
    pub slices: Vec<[i32; 4]>,
    /// Number of the slice among these, j and k, in the order of the visits: nested, flattened, as printed.
    pub visits: [Vec<[i32; 3]>; 3],
}

struct Visits(Vec<[i32; 3]>);

impl Visitor<Scalar> for Visits {
    fn visit(&mut self, slice: usize, j: i32, k: i32, live: bool) {
        if live {
            self.0.push([i32::try_from(slice).unwrap_or(i32::MAX), j, k]);
        }
    }

    fn unfinished(&self, _: usize) -> [bool; LANES] {
        [true; LANES]
    }
}

/// The cells that a loop visits in slices to their end, in its order: number of the slice, j, k.
#[must_use]
pub fn visited(which: Loop, slices: &Slices) -> Vec<[i32; 3]> {
    let mut visits = Visits(Vec::new());
    walk(Scalar, which, slices, &mut visits);
    visits.0
}

/// Some neighbouring slices of a packet for themselves.
fn part(slices: &Slices, from: usize, count: usize) -> Slices {
    let mut part =
        Slices { count, first: [[0; MAX_CELLS]; 2], last: [[-1; MAX_CELLS]; 2], far: [0.0; MAX_CELLS] };
    part.far[..count].copy_from_slice(&slices.far[from..from + count]);
    for side in 0..2 {
        part.first[side][..count].copy_from_slice(&slices.first[side][from..from + count]);
        part.last[side][..count].copy_from_slice(&slices.last[side][from..from + count]);
    }
    part
}

impl Loops {
    fn new(slices: &Slices, from: usize, count: usize) -> Self {
        let part = part(slices, from, count);
        let bounds = |s: usize| [part.first[0][s], part.last[0][s], part.first[1][s], part.last[1][s]];
        let visits = [Loop::Nested, Loop::Flattened, Loop::Printed].map(|which| visited(which, &part));
        Self { from, slices: (0..count).map(bounds).collect(), visits }
    }

    /// Whether a cell lies in its slice's rectangle.
    #[must_use]
    pub fn is_within(&self, [slice, j, k]: [i32; 3]) -> bool {
        let bounds = usize::try_from(slice).ok().and_then(|slice| self.slices.get(slice));
        bounds.is_some_and(|[j0, j1, k0, k1]| (*j0..=*j1).contains(&j) && (*k0..=*k1).contains(&k))
    }

    /// The cells that the nested loops visit and another does not.
    #[must_use]
    pub fn missed(&self, which: usize) -> Vec<[i32; 3]> {
        self.visits[0].iter().filter(|cell| !self.visits[which].contains(cell)).copied().collect()
    }

    /// How many visits of a loop are of no cell of the packet.
    #[must_use]
    pub fn extra(&self, which: usize) -> usize {
        self.visits[which].iter().filter(|cell| !self.is_within(**cell)).count()
    }

    /// How many cells a loop visits at another place in the order than the nested loops do.
    #[must_use]
    pub fn disordered(&self, which: usize) -> usize {
        let nested = &self.visits[0];
        let other =
            |(place, cell): (usize, &[i32; 3])| self.is_within(*cell) && nested.get(place) != Some(cell);
        self.visits[which].iter().enumerate().filter(|visit| other(*visit)).count()
    }

    /// How far astray the printed loop goes; small pictures first.
    fn worth(&self) -> (bool, usize) {
        let astray = self.missed(2).len() + self.extra(2) + self.disordered(2);
        (self.visits[0].len().max(self.visits[2].len()) <= MOST, astray)
    }
}

/// Three neighbouring slices that have cells, of a packet that has some; fewer if it has fewer.
#[must_use]
pub fn of(slices: &Slices) -> Loops {
    let full = |from: usize, count: usize| (from..from + count).all(|s| !slices.is_empty(s));
    for count in (1..=DRAWN.min(slices.count)).rev() {
        let all = (0..=slices.count - count).filter(|from| full(*from, count));
        let all = all.map(|from| Loops::new(slices, from, count));
        // Of equals the first.
        let best = all.rev().max_by_key(Loops::worth);
        if let Some(best) = best {
            return best;
        }
    }
    Loops::new(slices, 0, slices.count.min(1))
}

const NAMES: [&str; 3] = ["nested", "flattened, mended", "flattened, as printed"];

/// The drawing.
#[must_use]
pub fn draw(input: &Input<'_>, loops: &Loops) -> Figure {
    let title = "Both loops, and the one that is printed";
    let mut svg = Svg::new(&format!("{title}: their paths through three slices of {}", input.name));
    let all = || loops.visits.iter().flatten();
    let ends = |i: usize| {
        let of = || all().map(move |cell| cell[i]);
        [of().min().unwrap_or(0), of().max().unwrap_or(0)]
    };
    let ([j0, j1], [k0, k1]) = (ends(1), ends(2));
    let [rows, columns] = [j1 - j0 + 1, k1 - k0 + 1].map(f64::from);
    let count = loops.slices.len() as f64;
    let label = 122.0;
    let gap = 34.0;
    let side = ((WIDTH - label - gap * count) / (count * columns)).min(130.0 / rows).clamp(12.0, 36.0);
    for s in 0..loops.slices.len() {
        let x = label + s as f64 * (columns * side + gap);
        svg.words("head", "start", [x, 14.0], &format!("slice {}", loops.from + s));
    }
    svg.words("faint", "start", [LEFT, 14.0], "j down, k right");
    let mut top = 28.0;
    for (which, visits) in loops.visits.iter().enumerate() {
        let corner = |[s, j, k]: [i32; 3]| {
            let x = label + f64::from(s) * (columns * side + gap) + f64::from(k - k0) * side;
            [x, top + f64::from(j - j0) * side]
        };
        for (row, words) in NAMES[which].split(", ").enumerate() {
            let class = if row == 0 { "head" } else { "faint" };
            svg.words(class, "start", [LEFT, top + 16.0 + 16.0 * row as f64], words);
        }
        for s in (0..).take(loops.slices.len()) {
            for (j, k) in (j0..=j1).flat_map(|j| (k0..=k1).map(move |k| (j, k))) {
                let cell = [s, j, k];
                let class = if loops.is_within(cell) { "inside" } else { "outside" };
                svg.rect(class, corner(cell), [side; 2]);
            }
        }
        for (place, cell) in visits.iter().enumerate() {
            let class = if !loops.is_within(*cell) {
                "extra"
            } else if loops.visits[0].get(place) == Some(cell) {
                "ordered"
            } else {
                "disordered"
            };
            svg.rect(class, corner(*cell), [side; 2]);
        }
        for cell in loops.missed(which) {
            let [x, y] = corner(cell);
            let (near, far) = (0.25 * side, 0.75 * side);
            svg.rect("missed", [x, y], [side; 2]);
            svg.line("cross", [x + near, y + near], [x + far, y + far]);
            svg.line("cross", [x + near, y + far], [x + far, y + near]);
        }
        let middles: Vec<[f64; 2]> =
            visits.iter().map(|cell| corner(*cell).map(|x| x + side / 2.0)).collect();
        for (pair, ends) in middles.windows(2).zip(visits.windows(2)) {
            let class = if ends[0][0] == ends[1][0] { "path" } else { "path onward" };
            svg.line(class, pair[0], pair[1]);
        }
        for (place, [x, y]) in middles.into_iter().enumerate() {
            let number = (place + 1).to_string();
            if side >= 18.0 {
                svg.circle("plate", [x, y], 9.0, None);
                svg.words("order", "middle", [x, y + 4.2], &number);
            }
        }
        top += rows * side + 22.0;
    }
    svg.legend(
        top - 4.0,
        &[
            (Sign::Box("ordered"), "visited in the nested loops' order"),
            (Sign::Box("disordered"), "visited at another place in it"),
            (Sign::Box("extra"), "visited, no cell of the packet"),
            (Sign::Box("missed"), "crossed: missed"),
            (Sign::Stroke("path"), "path"),
            (Sign::Stroke("path onward"), "to the next slice"),
        ],
    );
    let told = |which: usize| {
        let (visits, same) = (loops.visits[which].len(), loops.visits[which] == loops.visits[0]);
        if same {
            return format!("{visits} cells, the same in the same order");
        }
        format!(
            "{visits} visits, of which {} are of no cell of the packet and {} out of order, with {} cells missed",
            loops.extra(which),
            loops.disordered(which),
            loops.missed(which).len()
        )
    };
    let caption = format!(
        "Slices {} to {} of the same packet. Nested: {} cells. Flattened and mended: {}. As printed: {}.",
        loops.from,
        loops.from + loops.slices.len() - 1,
        loops.visits[0].len(),
        told(1),
        told(2)
    );
    Figure { name: "loops", title: title.into(), caption, svg: svg.finish() }
}
