//! One frame of a scene on the model, and everything that the paper says of such frames, as plain data: the one source of the
//! table, the JSON file, the curves and the verdicts.
//!
//! Three frames are measured: as the plan has it, with the other kind of loop, and without culling (with it, if the plan has none).
//! What the grid lists is held against the balls themselves in exact arithmetic, and the picture against that of one loop over
//! all spheres.

use super::cost::{Bracket, bracket, frame_cost};
use super::dma::TransferError;
use super::model::{Measured, measure_nearest};
use super::predict::{LOOP_SITES, MISPREDICT, Policy, SITES};
use super::recorder::{Tally, ask_mailbox, cycles};
use super::store::{Buffers, LocalStoreFull, Map, code_bytes, grid_bytes};
use crate::visible::{Listed, listed};
use contract::{Camera, Image, MISS, Scene};
use optimized::crew::Crew;
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::machine::{Site, Stage};
use optimized::plan::{Arithmetic, Cells, Culling, Loop, Plan};
use optimized::seen::Seen;
use optimized::{Event, Events, Form, Level, RenderError, Tracer};
use serde::Serialize;
use thiserror::Error;

/// What is surveyed.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// What to call the scene.
    pub name: &'a str,
    /// Which of its frames it is.
    pub frame: usize,
    /// The frame.
    pub scene: &'a Scene,
    /// The camera.
    pub camera: &'a Camera,
    /// The plan.
    pub plan: Plan,
    /// One block of so many is traced.
    pub every: u32,
    /// Whether a scene that does not fit into the local store is measured as if it did.
    pub unlimited: bool,
}

/// Why there is no survey.
#[derive(Debug, Error)]
pub enum SurveyError {
    /// The tracer refuses the scene.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// It does not fit.
    #[error(transparent)]
    Full(#[from] LocalStoreFull),
    /// It cannot be moved.
    #[error(transparent)]
    Transfer(#[from] TransferError),
    /// The model has no such packets.
    #[error("the SPU model has packets of one block and the two f32 forms; the plan is: {plan}")]
    Plan {
        /// The plan.
        plan: Plan,
    },
}

/// Under a policy of hints.
#[derive(Clone, Debug, Serialize)]
pub struct Rate {
    /// The policy.
    pub policy: &'static str,
    /// Cycles of a frame over six SPUs, one pixel buffer: least, most.
    pub frame_cycles: Bracket,
    /// Frames a second: least, most.
    pub frames_per_second: Bracket,
    /// The same with two pixel buffers.
    pub frames_per_second_double: Bracket,
    /// By stage.
    pub stages: Vec<StageCost>,
}

/// A stage under a policy of hints.
#[derive(Clone, Debug, Serialize)]
pub struct StageCost {
    /// Its name.
    pub stage: &'static str,
    /// Cycles of a frame, on all six SPUs together.
    pub per_frame: Bracket,
    /// The same by the picture's pixels.
    pub per_ray: Bracket,
}

/// A kind of loop.
#[derive(Clone, Debug, Serialize)]
pub struct LoopCost {
    /// `nested` or `flattened`.
    pub walk: &'static str,
    /// Packets that were traced.
    pub traversals: u64,
    /// Cells they visited.
    pub cells: u64,
    /// Branches of the loop itself.
    pub branches: u64,
    /// By policy in the order of [`Policy::ALL`].
    pub policies: Vec<Mispredicts>,
    /// Branch by branch.
    pub sites: Vec<SiteCount>,
}

/// Of a kind of loop under a policy.
#[derive(Clone, Debug, Serialize)]
pub struct Mispredicts {
    /// The policy.
    pub policy: &'static str,
    /// By the loop's own branches; none, as below, if there is nothing to divide by.
    pub per_branch: Option<f64>,
    /// By cells.
    pub per_cell: Option<f64>,
    /// By traversals.
    pub per_traversal: Option<f64>,
    /// Those of all branches of tracing, by traversals.
    pub all_per_traversal: Option<f64>,
    /// Cycles of a frame over six SPUs.
    pub frame_cycles: Bracket,
}

/// A branch.
#[derive(Clone, Debug, Serialize)]
pub struct SiteCount {
    /// Where.
    pub site: String,
    /// How often it was come to.
    pub executed: u64,
    /// How often it was taken.
    pub taken: u64,
    /// Mispredicts by policy.
    pub mispredicts: [u64; 3],
    /// The least there could be if it were hinted, or not, once and for all.
    pub best: u64,
}

/// What culling buys.
#[derive(Clone, Debug, Serialize)]
pub struct Gain {
    /// Tests of sixteen rays against a sphere without culling.
    pub tests_without: u64,
    /// With culling.
    pub tests_with: u64,
    /// One by the other.
    pub factor: Option<f64>,
    /// Cycles of a frame over six SPUs without culling, hinted.
    pub cycles_without: Bracket,
    /// With it.
    pub cycles_with: Bracket,
}

/// What is done for want of a mailbox.
#[derive(Clone, Debug, Serialize)]
pub struct Mailbox {
    /// Spheres fetched by packets.
    pub fetched: u64,
    /// Of these, met before by the same packet.
    pub repeats: u64,
    /// Cycles for these, of all cycles of tracing, hinted: least and most bound.
    pub share: Bracket,
    /// The same less what asking the mailbox costs: below zero it costs more than it saves.
    pub saved: Bracket,
}

/// What the voxelizer lists, before any queue overflows.
#[derive(Clone, Debug, Serialize)]
pub struct Lists {
    /// Spheres whose box spans more than two cells on an axis.
    pub spanning: u64,
    /// Ids in cells.
    pub ids: u64,
    /// Of these, ids of spheres that have no point in the cell.
    pub false_positives: u64,
    /// Cells that hold a point of a sphere and do not list it.
    pub false_negatives: u64,
    /// Ids listed twice in a cell.
    pub twice: u64,
    /// Ids that fell out of full queues.
    pub dropped: u64,
    /// Cells that dropped one, of those that are known.
    pub overfull: u64,
}

/// The picture.
#[derive(Clone, Debug, Serialize)]
pub struct Picture {
    /// Pixels that hit a sphere.
    pub hits: u64,
    /// Pixels whose sphere is not that of one loop over all spheres.
    pub wrong: u64,
    /// Pixels that the loop as printed finds otherwise than the mended one.
    pub wrong_as_printed: u64,
}

/// All of it.
#[derive(Clone, Debug, Serialize)]
pub struct Survey {
    /// The scene.
    pub scene: String,
    /// Its frame.
    pub frame: usize,
    /// Spheres.
    pub spheres: usize,
    /// Pixels of a row and rows.
    pub size: [u32; 2],
    /// Cells on each axis.
    pub cells: [i32; 3],
    /// The plan in words.
    pub plan: String,
    /// Blocks traced, and all.
    pub blocks: [u64; 2],
    /// By policy.
    pub rates: Vec<Rate>,
    /// Nested, flattened.
    pub loops: Vec<LoopCost>,
    /// What culling buys.
    pub culling: Gain,
    /// What a mailbox would buy.
    pub mailbox: Mailbox,
    /// What the voxelizer lists.
    pub lists: Lists,
    /// What came of it.
    pub picture: Picture,
    /// The local store with one pixel buffer.
    pub store: Map,
    /// With two.
    pub store_double: Map,
}

const STAGE_NAMES: [(Stage, &str); 6] = [
    (Stage::Voxelize, "voxelize"),
    (Stage::Frustum, "frustum"),
    (Stage::Walk, "walk"),
    (Stage::Cull, "cull"),
    (Stage::Intersect, "intersect"),
    (Stage::Shade, "shade"),
];

/// Surveys a frame; `row_done` is called after each stripe of each of the [`FRAMES`] measured frames.
///
/// # Errors
/// [`SurveyError`] if the plan is not the model's, refuses the scene, or the scene does not fit.
pub fn survey(input: &Input<'_>, row_done: &dyn Fn()) -> Result<Survey, SurveyError> {
    let Input { scene, camera, plan, every, .. } = *input;
    let Arithmetic::Rounded(form) = plan.arithmetic else { return Err(SurveyError::Plan { plan }) };
    if plan.packet != optimized::plan::Packet::Block || plan.walk == Loop::Printed {
        return Err(SurveyError::Plan { plan });
    }
    let spheres = scene.spheres().len();
    let run = |plan| measure_nearest(plan, scene, camera, every, row_done);
    let [store, store_double] = [Buffers::Single, Buffers::Double].map(|buffers| map(input, buffers));
    let (store, store_double) = (store?, store_double?);
    if !input.unlimited {
        store.fits()?;
    }
    let frame = run(plan)?;
    let nested = run(Plan { walk: other(plan.walk), ..plan })?;
    let culling = if plan.culling == Culling::None { Culling::Planes } else { Culling::None };
    let uncut = run(Plan { culling, ..plan })?;
    let (with, without) = if culling == Culling::None { (&frame, &uncut) } else { (&uncut, &frame) };
    let (flat, nested) = if plan.walk == Loop::Flattened { (&frame, &nested) } else { (&nested, &frame) };
    let cost = |m: &Measured, policy, buffers| frame_cost(m, spheres, policy, buffers);
    let hinted = |m: &Measured| cost(m, Policy::Hinted, Buffers::Single).map(|cost| cost.cycles);
    let rates = Policy::ALL.map(|policy| rate(&frame, spheres, policy));
    let loops = [loop_cost("nested", nested, spheres)?, loop_cost("flattened", flat, spheres)?];
    let grid = frame.seen.grid.as_ref();
    Ok(Survey {
        scene: input.name.into(),
        frame: input.frame,
        spheres,
        size: [camera.size().width(), camera.size().height()],
        cells: grid.map_or([0; 3], |grid| [0, 1, 2].map(|i| grid.axes[i].n)),
        plan: plan.to_string(),
        blocks: frame.blocks(),
        rates: rates.into_iter().collect::<Result<_, _>>()?,
        loops: loops.into(),
        culling: Gain {
            tests_without: without.counts.candidates,
            tests_with: with.counts.candidates - with.counts.culled,
            factor: ratio(without.counts.candidates, with.counts.candidates - with.counts.culled),
            cycles_without: hinted(without)?,
            cycles_with: hinted(with)?,
        },
        mailbox: mailbox(&frame.trace),
        lists: lists(input, &frame.events)?,
        picture: picture(input, form)?,
        store,
        store_double,
    })
}

/// How many frames a survey measures.
pub const FRAMES: u32 = 3;

fn other(walk: Loop) -> Loop {
    if walk == Loop::Flattened { Loop::Nested } else { Loop::Flattened }
}

fn ratio(part: u64, of: u64) -> Option<f64> {
    (of > 0).then(|| part as f64 / of as f64)
}

/// What lies in the local store.
fn map(input: &Input<'_>, buffers: Buffers) -> Result<Map, SurveyError> {
    let Input { scene, camera, plan, .. } = *input;
    let seen = Seen::new(
        Scalar,
        plan,
        scene,
        camera,
        &mut Memory::default(),
        &mut Events::default(),
        &Crew::alone(),
    )?;
    let slices = seen.grid.as_ref().map_or(0, |grid| grid.axes.iter().map(|axis| axis.n).max().unwrap_or(0));
    let grid = seen.grid.as_ref().map_or(0, grid_bytes);
    let (code, width) = (code_bytes(plan)?, camera.size().width());
    Ok(Map::new(code, grid, scene.spheres().len(), width, slices.unsigned_abs().into(), buffers))
}

fn rate(frame: &Measured, spheres: usize, policy: Policy) -> Result<Rate, TransferError> {
    let single = frame_cost(frame, spheres, policy, Buffers::Single)?;
    let double = frame_cost(frame, spheres, policy, Buffers::Double)?;
    let rays = frame.image.size.pixels() as f64;
    let line =
        |stage, per_frame: Bracket| StageCost { stage, per_frame, per_ray: per_frame.map(|c| c / rays) };
    let spus = super::cost::SPUS as f64;
    let mut stages = Vec::new();
    for (stage, name) in STAGE_NAMES {
        let (booked, times) = match stage {
            Stage::Voxelize => (frame.voxelize.stage(stage), spus),
            _ => (frame.trace.stage(stage), frame.scale()),
        };
        stages.push(line(name, bracket(&booked, policy).map(|cycles| cycles * times)));
    }
    stages.push(line("DMA", single.dma.map(|cycles| cycles * spus)));
    Ok(Rate {
        policy: policy.name(),
        frame_cycles: single.cycles,
        frames_per_second: single.frames_per_second(),
        frames_per_second_double: double.frames_per_second(),
        stages,
    })
}

fn loop_cost(walk: &'static str, frame: &Measured, spheres: usize) -> Result<LoopCost, TransferError> {
    let (trace, cells) = (&frame.trace, frame.counts.cells);
    let branches = LOOP_SITES.iter().map(|site| trace.site(*site).executed).sum();
    let mut policies = Vec::new();
    for policy in Policy::ALL {
        let own = trace.mispredicts(&LOOP_SITES, policy);
        policies.push(Mispredicts {
            policy: policy.name(),
            per_branch: ratio(own, branches),
            per_cell: ratio(own, cells),
            per_traversal: ratio(own, trace.packets),
            all_per_traversal: ratio(trace.mispredicts(&SITES, policy), trace.packets),
            frame_cycles: frame_cost(frame, spheres, policy, Buffers::Single)?.cycles,
        });
    }
    let count = |site: Site| {
        let branches = trace.site(site);
        SiteCount {
            site: format!("{site:?}"),
            executed: branches.executed,
            taken: branches.taken,
            mispredicts: branches.mispredicts,
            best: branches.taken.min(branches.executed - branches.taken),
        }
    };
    let sites = SITES.into_iter().map(count).filter(|site| site.executed > 0).collect();
    Ok(LoopCost { walk, traversals: trace.packets, cells, branches, policies, sites })
}

fn mailbox(trace: &Tally) -> Mailbox {
    let ((), asked) = cycles(ask_mailbox);
    let (again, all) = (bracket(&trace.again(), Policy::Hinted), bracket(&trace.total(), Policy::Hinted));
    // Its own branch goes astray for the rarer answer.
    let astray = MISPREDICT * trace.repeats.min(trace.fetched - trace.repeats);
    let asking = asked.bracket(Policy::Hinted).map(|cycles| (cycles * trace.fetched + astray) as f64);
    Mailbox {
        fetched: trace.fetched,
        repeats: trace.repeats,
        share: [0, 1].map(|i| again[i] / all[i]),
        saved: [0, 1].map(|i| (again[i] - asking[i]) / all[i]),
    }
}

fn lists(input: &Input<'_>, events: &Events) -> Result<Lists, SurveyError> {
    let Input { scene, camera, plan, .. } = *input;
    let (mut found, memory) = (Events::default(), &mut Memory::default());
    let as_lists = Plan { cells: Cells::Lists, ..plan };
    let seen = Seen::new(Scalar, as_lists, scene, camera, memory, &mut found, &Crew::alone())?;
    let Listed { ids, needless, twice, missing } =
        seen.grid.as_ref().map_or_else(Listed::default, |grid| listed(grid, scene));
    let spanning = |event: &&Event| matches!(event, Event::SpansCells { .. });
    let mut overfull: Vec<[i32; 3]> = events
        .first()
        .iter()
        .filter_map(|event| if let Event::CellFull { cell, .. } = event { Some(*cell) } else { None })
        .collect();
    overfull.sort_unstable();
    overfull.dedup();
    Ok(Lists {
        spanning: found.first().iter().filter(spanning).count() as u64,
        ids,
        false_positives: needless,
        false_negatives: missing,
        twice,
        // Besides these there are spheres that span cells, the same in both.
        dropped: if plan.cells == Cells::Queue { events.count() - found.count() } else { 0 },
        overfull: overfull.len() as u64,
    })
}

/// The host's picture by the plan, by the plan that equals one loop over all spheres in the same form, and by the loop as printed.
fn picture(input: &Input<'_>, form: Form) -> Result<Picture, SurveyError> {
    let Input { scene, camera, plan, .. } = *input;
    let level = Level::available().last().copied().unwrap_or(Level::SCALAR);
    let render = |plan| Tracer::new(plan, level).render(scene, camera).map(|rendering| rendering.image);
    let naive = render(Plan { arithmetic: form.into(), ..Plan::safe() })?;
    let (own, printed) = (render(plan)?, render(Plan { walk: Loop::Printed, ..plan })?);
    let differ = |a: &Image, b: &Image| a.ids.iter().zip(&b.ids).filter(|(a, b)| a != b).count() as u64;
    Ok(Picture {
        hits: naive.ids.iter().filter(|id| **id != MISS).count() as u64,
        wrong: differ(&naive, &own),
        wrong_as_printed: differ(&own, &printed),
    })
}
