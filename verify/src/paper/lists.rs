//! What cells list: false negatives and positives, full queues, and what a push does.

use super::cases::{CORNERS, OVERFLOW, ROUNDED};
use super::{Answer, Figured, Looked, NARROW, PUSH, PaperClaim, Proof, alone, asked, percent};
use crate::prove::prover::Finding;
use crate::report::Evidence;
use crate::report::words::figure;
use crate::seed::generator;
use crate::spu::machine::Spu;
use crate::spu::recorder::cycles;
use crate::visible::{overlapped, times_listed};
use contract::{Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use optimized::crew::Crew;
use optimized::grid::{Axis, Bounds, Memory};
use optimized::host::Scalar;
use optimized::machine::{LANES, Machine};
use optimized::plan::{Arithmetic, Cells, Margins, Plan};
use optimized::queue::{Queue, Queues, WORDS};
use optimized::seen::Seen;
use optimized::{Events, Form};
use rand::RngExt;

pub(super) fn claims(looked: &[Looked], said: &[Finding], seed: u64) -> Vec<PaperClaim> {
    let (cell, queue) = (Proof::of(NARROW, said), Proof::of(PUSH, said));
    vec![
        asked(
            "No false negatives: a sphere is listed in every cell that it meets",
            Evidence::Sampled,
            looked,
            |look| {
                let missed = look.survey.lists.false_negatives;
                ((missed == 0).into(), missed.to_string())
            },
        )
        .against(CORNERS.told()),
        asked(
            "No false negatives if no sphere spans more than two cells",
            Evidence::Sampled,
            looked,
            |look| {
                let lists = &look.survey.lists;
                let small = lists.spanning == 0;
                let answer = if small { (lists.false_negatives == 0).into() } else { Answer::Silent };
                (answer, format!("{} spanning", lists.spanning))
            },
        ),
        alone(
            "No false negatives if all spheres are narrower than cells, boxes being exact",
            cell.or(Evidence::Sampled),
            {
                let lost = diameters(seed);
                let shown: Vec<String> =
                    lost.iter().map(|(ratio, share)| format!("{ratio}: {} %", figure(*share))).collect();
                let so = lost.iter().all(|(ratio, share)| *ratio >= 1.0 || *share == 0.0);
                (
                    cell.and(so.into()),
                    format!(
                        "{}. Of {BALLS} random spheres by diameter in cells are lost: {}",
                        cell.figure,
                        shown.join(", ")
                    ),
                )
            },
        )
        .by(cell.command.clone()),
        alone("A sphere as wide as a cell spans two cells", Evidence::Refuted, equal_width())
            .against(Some(format!("radius 0.5 about {WIDE:?} in unit cells from −8")))
            .by(cell.command),
        alone(
            "No false negatives whatever the rounding of a sphere's box",
            Evidence::Sampled,
            rounded_boxes(seed),
        )
        .against(ROUNDED.told())
        .by(ROUNDED.command()),
        asked("False positives are rare: below 5 % of what is listed", Evidence::Sampled, looked, |look| {
            let share = percent(look.survey.lists.false_positives, look.survey.lists.ids);
            ((share < 5.0).into(), format!("{} %", figure(share)))
        }),
        asked("Sixteen slots suffice in 16x16x16 cells", Evidence::Sampled, looked, |look| {
            let lists = &look.survey.lists;
            ((lists.dropped == 0).into(), format!("{} dropped", lists.dropped))
        })
        .against(OVERFLOW.told()),
        asked(
            "Some grid of 1 to 16 cells on an axis has room for all, and no sphere that spans three cells",
            Evidence::Sampled,
            looked,
            |look| {
                let of: Vec<String> = look.sound.iter().map(u8::to_string).collect();
                (
                    (!of.is_empty()).into(),
                    if of.is_empty() { String::new() } else { format!("({})", of.join(", ")) },
                )
            },
        ),
        alone("A push is 6 SIMD logical instructions", Evidence::Measured, push()),
        alone(
            "Eight pushes to equal cells are one if all queues are read first",
            queue.or(Evidence::Sampled),
            {
                let (answer, times) = equal_cells(true);
                (queue.and(answer), format!("{}; {times}", queue.figure))
            },
        )
        .by(queue.command),
        alone(
            "… and also if each queue is read after the last was written",
            Evidence::Refuted,
            equal_cells(false),
        )
        .against(Some("one id, pushed twice onto an empty queue".into()))
        .by("cargo test --test queue"),
        alone(
            "\"Shift left, write to the first two bytes\" loses only the oldest, on a big-endian machine",
            Evidence::Refuted,
            literally(),
        )
        .against(Some("two ids, pushed onto an empty queue".into())),
        alone("An empty slot needs no value of its own", Evidence::Refuted, unmarked())
            .against(Some("sphere 0, pushed onto a queue of zeros".into())),
    ]
}

/// Spheres for each ratio of [`RATIOS`].
const BALLS: usize = 1000;
/// Diameters in cells.
const RATIOS: [f64; 6] = [0.5, 0.999, 1.001, 1.1, 1.5, 2.0];

/// Of random spheres of one diameter, by that in cells, what per cent are not listed in a cell that they meet: by the shipped voxelizer,
/// with boxes rounded outward. (In the textbook form they would also reach as far as it reports hits beyond the surface.)
#[allow(clippy::cast_possible_truncation, reason = "any radius near the ratio will do")]
fn diameters(seed: u64) -> Vec<(f64, f64)> {
    let plan = Plan {
        cells: Cells::Lists,
        margins: Margins::Derived,
        arithmetic: Arithmetic::Rounded(Form::Perpendicular),
        ..Plan::paper()
    };
    let of_ratio = |ratio: f64| {
        let mut rng = generator(seed, 4);
        // Centres within a cube of side 16; the grid is that cube and a radius around it.
        let radius = (8.0 * ratio / (16.0 - ratio)) as f32;
        let ball = |center| Sphere { center, radius, color: [0; 3] };
        let mut spheres = vec![ball([0.0; 3]), ball([16.0; 3])];
        for _ in 0..BALLS {
            spheres.push(ball(std::array::from_fn(|_| rng.random_range(0.0..16.0f32))));
        }
        let scene = Scene::new(spheres, [0; 3], DEFAULT_LIGHT).ok()?;
        let size = Size::new(1, 1).ok()?;
        let camera =
            Camera::new([8.0, 8.0, 99.0], [0.0, 0.0, -1.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], size).ok()?;
        let (mut memory, mut events) = (Memory::default(), Events::default());
        let seen = Seen::new(Scalar, plan, &scene, &camera, &mut memory, &mut events, &Crew::alone());
        let grid = seen.ok()?.grid?;
        let is_lost = |(id, sphere): &(u32, &Sphere)| {
            let cells = overlapped(&grid, sphere.center, sphere.radius);
            cells.into_iter().any(|cell| times_listed(&grid, cell, *id) == 0)
        };
        let lost = (0..).zip(scene.spheres()).skip(2).filter(is_lost).count();
        Some((ratio, percent(lost as u64, BALLS as u64)))
    };
    RATIOS.into_iter().filter_map(of_ratio).collect()
}

/// Found by a solver (`cell.corners.equal`): the middle of a ball of radius 0.5 that lies in three unit cells.
const WIDE: f32 = 0.499_999_5;

/// In which cells the shipped map has the ends of that ball's box.
fn equal_width() -> Figured {
    let axis = Axis::new(Scalar, -8.0, 8.0, 16);
    let bounds = Bounds::nearest([WIDE; 3], 0.5);
    let [first, last] = [bounds.lo[0], bounds.hi[0]].map(|x| axis.cell(Scalar, [x; LANES])[0]);
    ((last - first < 2).into(), format!("it is listed in cells {first} and {last}"))
}

/// Spheres about two units in the last place from a plane, their boxes rounded to nearest: how many are not in a cell of theirs.
fn rounded_boxes(seed: u64) -> Figured {
    const BALLS: u64 = 20_000;
    let (mut rng, mut lost) = (generator(seed, 3), 0);
    for _ in 0..BALLS {
        let (lo, width) = (rng.random_range(-8.0..8.0f32), rng.random_range(1.0..16.0f32));
        let axis = Axis::new(Scalar, lo, lo + width, 4);
        let (plane, radius) = (axis.planes[rng.random_range(1..4usize)], rng.random_range(0.01..0.2f32));
        let mut center = if rng.random() { plane + radius } else { plane - radius };
        for _ in 0..rng.random_range(0..3) {
            center = if rng.random() { center.next_up() } else { center.next_down() };
        }
        let bounds = Bounds::nearest([center; 3], radius);
        let cell = |x: f32| axis.cell(Scalar, [x; LANES])[0];
        // In f64 sum and difference of two such numbers are exact.
        let exact = |x: f64| axis.planes[1..4].iter().filter(|plane| f64::from(**plane) <= x).count();
        let (c, r) = (f64::from(center), f64::from(radius));
        let (first, last) =
            (cell(bounds.lo[0]).unsigned_abs() as usize, cell(bounds.hi[0]).unsigned_abs() as usize);
        lost += u64::from(first > exact(c - r) || last < exact(c + r));
    }
    (
        (lost == 0).into(),
        format!("{} % of {BALLS} spheres that touch a plane are lost", figure(percent(lost, BALLS))),
    )
}

/// The tracer's own push onto sixteen queues, in instructions by queue.
fn push() -> Figured {
    let m = Spu(Scalar);
    let empty = || Queues::read(m, &[Queue::EMPTY]);
    let ((), read) = cycles(|| _ = empty());
    let ((), both) = cycles(|| _ = empty().push(m, m.splat_i(1)));
    let instructions = both.even + both.odd - read.even - read.odd;
    let each = instructions as f64 / LANES as f64;
    ((instructions == 6 * LANES as u64).into(), format!("{} a queue, loads and stores apart", figure(each)))
}

/// An id pushed onto the same cell twice, with both queues read before, or one after the other.
fn equal_cells(read_first: bool) -> Figured {
    let push = |queue: &Queue| {
        let all = Queues::read(Scalar, &[*queue, *queue]).push(Scalar, Scalar.splat_i(7)).to_array(Scalar);
        [all[0], all[1]]
    };
    let [first, second] = push(&Queue::EMPTY);
    let result = if read_first { second } else { push(&first)[0] };
    let times = result.ids().filter(|id| *id == 7).count();
    let words = if times == 1 { "once".into() } else { format!("{times} times") };
    ((times == 1).into(), format!("the id is there {words}"))
}

/// The paper's words done to 32 bytes, the first the highest: by two bytes towards the first, then the id into the first two.
fn literally() -> Figured {
    let mut bytes = [0u8; 32];
    for id in [1u16, 2] {
        bytes.copy_within(2.., 0);
        bytes[30..].fill(0);
        bytes[..2].copy_from_slice(&id.to_be_bytes());
    }
    let kept: Vec<u16> =
        bytes.chunks(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).filter(|id| *id != 0).collect();
    (kept.contains(&1).into(), format!("of the ids 1 and 2 the queue holds {kept:?}"))
}

/// The shipped push of id 0 onto a queue of zeros.
fn unmarked() -> Figured {
    let zeros = Queues::<Scalar>([[0; LANES]; WORDS]);
    let pushed = zeros.push(Scalar, Scalar.splat_i(0));
    let same = pushed.0 == zeros.0;
    ((!same).into(), if same { "the queue is as before".into() } else { "it can be told".into() })
}
