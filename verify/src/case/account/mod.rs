//! One pixel told step by step, by the shipped code itself: its ray, the grid, the slices and cells its packet comes to, what they list,
//! each culling and each intersection with the numbers that were compared, what the stages decided, and the exact answer.
//!
//! In: a case, a frame, a pixel. Out: text. The tracer's kernels run on a machine that notes every comparison (`watch`); nothing of
//! them is written a second time here. Plans with tiles are told by the walk of the pixel's own block, which a tile makes for many at once.

use super::{Asked, Case, CaseError};
use crate::watch::{Note, Part, watched};
use contract::{Camera, Image, MISS, Scene, Size, Sphere};
use optimized::camera;
use optimized::crew::Crew;
use optimized::event::Events;
use optimized::frustum::{Bundle, Heading, Slices};
use optimized::grid::{Grid, Memory};
use optimized::host::Scalar;
use optimized::machine::{LANES, Site};
use optimized::plan::{Arithmetic, Packet, Plan};
use optimized::seen::Seen;
use reference::{Arithmetic as Naively, Ray, Tracer};
use std::fmt::Write as _;

/// The most spheres and cells that are told of one by one.
const MOST: usize = 40;

/// What is compared of one sphere, in the order in which the kernels of [`optimized::sphere`] and [`optimized::certain`] do it.
const ROUNDED: [&str; 5] =
    ["discriminant", "near root", "root taken", "before the nearest", "not after the nearest"];
const CERTIFIED: [&str; 9] = [
    NOTHING,
    "discriminant below its bound: a miss",
    "discriminant's upper end",
    "discriminant's lower end",
    "root's upper end behind the eye",
    "discriminant above its bound: a hit",
    "root's lower end ahead of the eye",
    "root's upper end before the nearest",
    "loser's lower end before the rival's",
];
const UNKNOWN_SIDE: [&str; 5] =
    [NOTHING, CERTIFIED[1], "the eye's side is not certain, so neither is a hit", CERTIFIED[7], CERTIFIED[8]];
/// A number compared with itself, to have a mask of all lanes.
const NOTHING: &str = "";
const PLANES: [&str; 4] = ["lowest Y", "highest Y", "lowest Z", "highest Z"];

/// The account of a pixel.
///
/// # Errors
/// [`CaseError`] if the frame cannot be rendered.
///
/// # Panics
/// If there is no such frame or pixel.
pub fn account(case: &Case, frame: usize, [x, y]: [u32; 2]) -> Result<String, CaseError> {
    let scene = &case.frames.frames()[frame];
    let (width, camera) = (case.camera.size().width() as usize, &case.camera);
    let i = y as usize * width + x as usize;
    let ray = Ray::of_pixel(camera, x, y);
    let judged = &case.judge()?[frame];
    let exact = Tracer::new(Naively::Exact).threads(1).render(scene, camera)?.image;
    let mut out = String::new();
    line(&mut out, format_args!("pixel      ({x}, {y}) of frame {frame}, {} spheres", scene.spheres().len()));
    line(&mut out, format_args!("tracer     {}", case.asked));
    line(&mut out, format_args!("eye        {}", vector(ray.eye)));
    line(&mut out, format_args!("direction  {}", vector(ray.dir)));
    line(&mut out, format_args!("truth      {}", answer(&exact, i)));
    line(&mut out, format_args!("promised   {}", answer(&judged.promised, i)));
    line(&mut out, format_args!("tracer's   {}", answer(&judged.picture, i)));
    line(
        &mut out,
        format_args!("verdict    {:?} on the frame. {}", judged.judgement.verdict, judged.judgement.because),
    );
    if let Asked::Grid { plan, .. } = case.asked {
        walked(&mut out, plan, scene, camera, [x, y]);
    }
    alone(&mut out, case, scene, &ray, i);
    Ok(out)
}

fn line(out: &mut String, text: std::fmt::Arguments<'_>) {
    let taken = out.write_fmt(text);
    debug_assert!(taken.is_ok(), "a string takes everything");
    out.push('\n');
}

fn number(x: f32) -> String {
    format!("{x:?} (0x{:08x})", x.to_bits())
}

fn vector(v: [f32; 3]) -> String {
    v.map(number).join(", ")
}

fn answer(image: &Image, i: usize) -> String {
    match image.ids[i] {
        MISS => "a miss".into(),
        id => format!("sphere {id} at t = {}, colour {:?}", number(image.t[i]), &image.rgba[i][..3]),
    }
}

/// The way of the pixel's block through the grid.
fn walked(out: &mut String, plan: Plan, scene: &Scene, camera: &Camera, [x, y]: [u32; 2]) {
    if let Packet::Tile { .. } = plan.packet {
        line(
            out,
            format_args!(
                "\nTold by the walk of the pixel's block alone, which its tile makes for many blocks at once."
            ),
        );
    }
    let plan = Plan { packet: Packet::Block, ..plan };
    let (mut memory, mut events) = (Memory::default(), Events::default());
    let seen = Seen::new(Scalar, plan, scene, camera, &mut memory, &mut events, &Crew::alone());
    let seen = match seen {
        Ok(seen) => seen,
        Err(error) => return line(out, format_args!("\nThe frame is refused: {error}")),
    };
    for event in events.first().iter().take(MOST) {
        line(out, format_args!("event      {event}"));
    }
    if events.count() > MOST as u64 {
        line(out, format_args!("           and {} more", events.count() - MOST as u64));
    }
    let [left, top] = [x, y].map(|v| v / camera::BLOCK * camera::BLOCK);
    let lane = ((y - top) * camera::BLOCK + (x - left)) as usize;
    line(out, format_args!("\nblock      first pixel ({left}, {top}), lane {lane}"));
    let lanes = camera::CameraLanes::new(Scalar, camera);
    let (xs, ys) = camera::middles(Scalar, camera, left, top);
    let mut block = lanes.block(Scalar, xs, ys);
    let bundle = match Bundle::of_block(Scalar, &block) {
        Some(bundle) => Some(bundle),
        None => {
            line(
                out,
                format_args!(
                    "           its rays have no common major axis: each goes as a packet of its own"
                ),
            );
            // Sixteen times this one, as the tracer takes it.
            block = camera::Block::new(Scalar, [0, 1, 2].map(|i| [block.dir[i][lane]; LANES]));
            Bundle::of_block(Scalar, &block)
        }
    };
    let Some(bundle) = bundle else {
        return line(
            out,
            format_args!("           the direction is zero: it has no major axis and hits nothing"),
        );
    };
    let heading = bundle.frustum.heading;
    let [[lo_y, hi_y], [lo_z, hi_z]] = bundle.frustum.slope_arrays(Scalar);
    let axis = ["x", "y", "z"];
    let [a, b, c] = heading.order.map(|i| axis[i]);
    let sign = if heading.forward { '+' } else { '-' };
    line(
        out,
        format_args!("frustum    along {sign}{a}; slopes {b} {lo_y:?} to {hi_y:?}, {c} {lo_z:?} to {hi_z:?}"),
    );
    match &seen.grid {
        None => line(out, format_args!("grid       none: every sphere is met")),
        Some(grid) => {
            let slices = bundle.frustum.slices(Scalar, seen.eye, grid, plan.margins);
            told_grid(out, grid, &slices, heading);
        }
    }
    told_meetings(out, &seen, scene, block.dir, lane);
}

fn told_grid(out: &mut String, grid: &Grid, slices: &Slices, heading: Heading) {
    let axis = ["x", "y", "z"];
    let cells = grid.axes.each_ref().map(|axis| axis.n);
    let from = grid.axes.each_ref().map(|axis| axis.planes[0]);
    let to = grid.axes.each_ref().map(|axis| axis.planes[axis.planes.len() - 1]);
    line(
        out,
        format_args!(
            "grid       {cells:?} cells from {from:?} to {to:?}, looked around in by {:?}",
            grid.widen
        ),
    );
    let (order, strides, mut told) = (heading.order, grid.strides(), 0);
    for s in 0..slices.count {
        let index = heading.slice_index(slices.count, s);
        if slices.is_empty(s) {
            continue;
        }
        let [[first_j, last_j], [first_k, last_k]] =
            [0, 1].map(|side| [slices.first[side][s], slices.last[side][s]]);
        line(
            out,
            format_args!(
                "slice {s:3}  {}[{index}], to {:?} from the eye: {}[{first_j}..={last_j}], {}[{first_k}..={last_k}]",
                axis[order[0]], slices.far[s], axis[order[1]], axis[order[2]],
            ),
        );
        for j in first_j..=last_j {
            for k in first_k..=last_k {
                let mut at = [0; 3];
                at[order[0]] = index;
                at[order[1]] = j.unsigned_abs() as usize;
                at[order[2]] = k.unsigned_abs() as usize;
                let mut ids = Vec::new();
                grid.for_each_id((0..3).map(|i| at[i] * strides[i]).sum(), true, |id| ids.push(id));
                told += 1;
                if !ids.is_empty() && told <= MOST {
                    let more = if ids.len() > MOST { ", …" } else { "" };
                    let shown: Vec<String> = ids.iter().take(MOST).map(u32::to_string).collect();
                    line(out, format_args!("  cell {at:?} lists {}{more}", shown.join(", ")));
                }
            }
        }
    }
    if told > MOST {
        line(
            out,
            format_args!("  ({told} cells in all; of the first {MOST} those that list something are shown)"),
        );
    }
}

/// Each sphere that a packet meets, with what was compared, in the order in which that happened.
fn told_meetings(out: &mut String, seen: &Seen, scene: &Scene, dir: [[f32; LANES]; 3], lane: usize) {
    let packet = watched(seen, scene, dir);
    let meetings = Meeting::all(&packet.notes);
    line(
        out,
        format_args!("\nmet        {} times a sphere by the packet; lane {lane} of each:", meetings.len()),
    );
    for meeting in meetings.iter().take(MOST) {
        meeting.told(out, seen.plan.arithmetic, lane);
    }
    if meetings.len() > MOST {
        line(out, format_args!("  ({} more)", meetings.len() - MOST));
    }
    let counts = packet.counts;
    line(
        out,
        format_args!(
            "packet     {} cells visited, {} candidates, {} culled; of its {} lanes f32 left {} to f64, that left {} to integers, which rounded the t of {} more",
            counts.cells,
            counts.candidates,
            counts.culled,
            counts.lanes,
            counts.asked_f64,
            counts.asked_integers,
            counts.rounded_by_integers,
        ),
    );
}

/// What a packet did with a sphere.
struct Meeting {
    id: u32,
    /// Distances from the four planes, and what they are held against.
    planes: Option<Compared>,
    dropped: bool,
    /// What the intersection compared.
    compared: Vec<Compared>,
    /// Whether any ray may hit it.
    possible: Option<bool>,
}

/// x < y if strict, else x <= y.
#[derive(Clone, Copy)]
struct Compared {
    strict: bool,
    x: [f32; LANES],
    y: [f32; LANES],
}

impl Compared {
    fn told(&self, i: usize) -> String {
        let (x, y, sign) = (self.x[i], self.y[i], if self.strict { "<" } else { "<=" });
        let holds = if self.strict { x < y } else { x <= y };
        format!("{} {sign} {}? {}", number(x), number(y), if holds { "yes" } else { "no" })
    }

    fn is_of_the_same(&self) -> bool {
        self.x.map(f32::to_bits) == self.y.map(f32::to_bits)
    }
}

impl Meeting {
    fn all(notes: &[Note]) -> Vec<Self> {
        let (mut meetings, mut part) = (Vec::<Self>::new(), Part::Other);
        for note in notes {
            if let Note::Sphere(id) = *note {
                meetings.push(Self {
                    id,
                    planes: None,
                    dropped: false,
                    compared: Vec::new(),
                    possible: None,
                });
            }
            let Some(meeting) = meetings.last_mut() else { continue };
            match *note {
                Note::Part(new) => part = new,
                Note::Compared { strict, x, y } => match part {
                    Part::Cull => meeting.planes = Some(Compared { strict, x, y }),
                    Part::Intersect => meeting.compared.push(Compared { strict, x, y }),
                    Part::Other => {}
                },
                Note::Any(Site::Culled, lanes) => meeting.dropped = lanes != 0,
                Note::Any(Site::Sphere, lanes) => meeting.possible = Some(lanes != 0),
                Note::Any(..) | Note::Sphere(_) | Note::Cell { .. } => {}
            }
        }
        meetings
    }

    fn told(&self, out: &mut String, arithmetic: Arithmetic, lane: usize) {
        line(out, format_args!("  sphere {}", self.id));
        if let Some(planes) = self.planes {
            for (i, plane) in PLANES.iter().enumerate() {
                line(out, format_args!("    distance from the plane of the {plane}: {}", planes.told(i)));
            }
            let said = if self.dropped { "dropped: wholly outside a plane" } else { "kept" };
            line(out, format_args!("    culling: {said}"));
        }
        let labels: &[&str] = match arithmetic {
            Arithmetic::Rounded(_) | Arithmetic::Spu(_) => &ROUNDED,
            // Where the eye is not certain to be on a side, the kernel compares a bound with itself.
            Arithmetic::Certified if self.compared.get(2).is_some_and(Compared::is_of_the_same) => {
                &UNKNOWN_SIDE
            }
            Arithmetic::Certified => &CERTIFIED,
        };
        for (compared, label) in self.compared.iter().zip(labels).filter(|(_, label)| **label != NOTHING) {
            line(out, format_args!("    {label}: {}", compared.told(lane)));
        }
        if self.possible == Some(false) {
            line(out, format_args!("    no ray of the packet can hit it"));
        }
    }
}

/// What the exact and the tracer's own arithmetic say of each sphere for itself, where either finds a hit.
fn alone(out: &mut String, case: &Case, scene: &Scene, ray: &Ray, i: usize) {
    // The truth is told beside it, so of who promises that the other way to it is taken.
    let own = match case.asked.promise().naive() {
        Naively::Exact => Naively::ExactUnfiltered,
        own => own,
    };
    line(
        out,
        format_args!(
            "\nalone      each sphere that the ray hits, exactly and in the tracer's arithmetic ({own:?}){}:",
            if matches!(case.asked, Asked::Foreign { .. }) {
                ", and what the tracer itself says of it"
            } else {
                ""
            }
        ),
    );
    let mut shown = 0;
    for (id, sphere) in scene.spheres().iter().enumerate() {
        let Ok(one) = Scene::new(vec![*sphere], scene.background(), scene.light()) else { continue };
        let of = |arithmetic| Tracer::new(arithmetic).trace(ray, &one).map(|hit| hit.t);
        let (truth, naive) = (of(Naively::Exact), of(own));
        if truth.is_none() && naive.is_none() {
            continue;
        }
        shown += 1;
        if shown <= MOST {
            let word = |t: Option<f32>| t.map_or("a miss".into(), |t| format!("t = {}", number(t)));
            line(
                out,
                format_args!(
                    "  sphere {id} at {} with radius {}: exactly {}, there {}{}; {}",
                    vector(sphere.center),
                    number(sphere.radius),
                    word(truth),
                    word(naive),
                    itself(case, one, i),
                    margin(ray, sphere),
                ),
            );
        }
    }
    match shown {
        0 => line(out, format_args!("  none")),
        n if n > MOST => line(out, format_args!("  ({} more)", n - MOST)),
        _ => {}
    }
}

/// What a program says of a pixel that has one sphere before it.
fn itself(case: &Case, one: Scene, i: usize) -> String {
    if !matches!(case.asked, Asked::Foreign { .. }) {
        return String::new();
    }
    let one = Case { frames: one.into(), ..case.clone() };
    match one.pictures() {
        Ok(pictures) if pictures[0].ids[i] == MISS => ", itself a miss".into(),
        Ok(pictures) => format!(", itself t = {}", number(pictures[0].t[i])),
        Err(error) => format!(", itself nothing: {error}"),
    }
}

/// How far a ray passes a sphere's surface, in f64: for the eye, no verdict rests on it.
fn margin(ray: &Ray, sphere: &Sphere) -> String {
    let d = ray.dir.map(f64::from);
    let f = [0, 1, 2].map(|i| f64::from(ray.eye[i]) - f64::from(sphere.center[i]));
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let h = dot(f, d) / dot(d, d);
    let across = [0, 1, 2].map(|i| f[i] - h * d[i]);
    let impact = dot(across, across).sqrt() / f64::from(sphere.radius);
    format!(
        "the ray passes its centre at {impact:.9} radii, {:.6} radii from the eye",
        dot(f, f).sqrt() / f64::from(sphere.radius)
    )
}

/// The size of an image that holds a pixel, or what is wrong with it.
///
/// # Errors
/// A sentence for a pixel beyond the picture.
pub fn check_pixel(size: Size, [x, y]: [u32; 2]) -> Result<(), String> {
    if x < size.width() && y < size.height() {
        return Ok(());
    }
    Err(format!("pixel ({x}, {y}) lies beyond the picture of {}x{}", size.width(), size.height()))
}
