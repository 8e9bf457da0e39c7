//! Voxelizers against exact integers: every cell that holds a point of a ball lists it.

use super::bytes::Bytes;
use super::plan::{ARITHMETICS, VOXELIZERS};
use super::{bits, listed, view};
use crate::visible::listing_is_complete;
use contract::{Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use optimized::crew::Crew;
use optimized::event::Events;
use optimized::grid::{Axis, Grid, Memory};
use optimized::host::Work;
use optimized::machine::Machine;
use optimized::plan::{Arithmetic, Cells, Packet, Plan, Resolution, Voxelizer};
use optimized::seen::Seen;
use optimized::{Level, RenderError};

/// A grid of up to six cells on an axis is built over up to twelve spheres, some of which are moved to where their boxes end within
/// two ulp of the planes that the grid then has; it is built again, and [`listing_is_complete`] decides. Where it is built for tiles,
/// each sphere must be in the cell of its centre, once, or among the large ones, and the grid must look as far around as all
/// others reach. Cells are judged.
///
/// # Panics
/// If a cell does not list what it must.
pub fn voxelize(bytes: &[u8]) -> u64 {
    let mut from = Bytes(bytes);
    let (plan, level) = (plan(&mut from), from.level());
    let Ok(mut scene) = view::scene(&mut from, 12) else { return 0 };
    let Ok(camera) = camera(&mut from) else { return 0 };
    let replay = |scene: &Scene| format!("{plan}, {level}, {camera:?}{}", listed(scene.spheres()));
    let build = |scene: &Scene| match build(level, plan, scene, &camera) {
        Ok(seen) => seen,
        Err(error) => panic!("{error}; {}", replay(scene)),
    };
    for _ in 0..from.below(3) {
        let Some(grid) = build(&scene).grid else { return 0 };
        let Ok(moved) = moved(&mut from, &scene, &grid) else { return 0 };
        scene = moved;
    }
    let seen = build(&scene);
    let Some(grid) = &seen.grid else { return 0 };
    if plan.packet != Packet::Block {
        return listed_for_tiles(grid, scene.spheres())
            .unwrap_or_else(|why| panic!("{why}; {}", replay(&scene)));
    }
    match listing_is_complete(&seen, &scene) {
        Ok(checked) => checked.cells,
        Err(why) => panic!("{why}; {}", replay(&scene)),
    }
}

/// A plan that falls back, so that its listing is to be complete.
fn plan(from: &mut Bytes<'_>) -> Plan {
    let n = from.below(6) + 1;
    let plan = Plan {
        voxelizer: from.one_of(&VOXELIZERS),
        cells: from.one_of(&[Cells::Queue, Cells::Lists]),
        arithmetic: from.one_of(&ARITHMETICS),
        resolution: if from.flag() { Resolution::UpTo(n) } else { Resolution::Fixed(n) },
        ..Plan::safe()
    };
    match from.below(4) {
        0 => Plan {
            packet: Packet::Tile { side: 8 },
            voxelizer: Voxelizer::ByCenter,
            cells: Cells::Lists,
            arithmetic: Arithmetic::Certified,
            ..plan
        },
        _ => plan,
    }
}

/// The eye's place matters for margins alone, and the directions not at all.
fn camera(from: &mut Bytes<'_>) -> Result<Camera, contract::CameraError> {
    let size = Size::new(4, 4).unwrap_or_else(|error| panic!("4x4: {error}"));
    Camera::new(from.vector(), [-2.0, 2.0, -4.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size)
}

/// A sphere's box ends near a plane on one axis.
fn moved(from: &mut Bytes<'_>, scene: &Scene, grid: &Grid) -> Result<Scene, contract::SceneError> {
    let mut spheres = scene.spheres().to_vec();
    let (which, axis) = (usize::from(from.byte()) % spheres.len().max(1), usize::from(from.below(3)));
    let plane = from.one_of(&grid.axes[axis].planes);
    let (upper, steps) = (from.flag(), from.whole() % 3);
    if let Some(Sphere { center, radius, .. }) = spheres.get_mut(which) {
        let mut at = if upper { plane - *radius } else { plane + *radius };
        for _ in 0..steps.unsigned_abs() {
            at = if steps > 0 { at.next_up() } else { at.next_down() };
        }
        center[axis] = at;
    }
    Scene::new(spheres, scene.background(), DEFAULT_LIGHT)
}

struct Build<'a>(Plan, &'a Scene, &'a Camera);

impl Work for Build<'_> {
    type Output = Result<Seen, RenderError>;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        let Self(plan, scene, camera) = self;
        let (mut memory, mut events) = (Memory::default(), Events::default());
        Seen::new(m, plan, scene, camera, &mut memory, &mut events, &Crew::alone())
    }
}

/// What packets read, made at a level.
pub(super) fn build(level: Level, plan: Plan, scene: &Scene, camera: &Camera) -> Result<Seen, RenderError> {
    level.run(Build(plan, scene, camera))
}

/// How many times spheres are listed, which must be once.
fn listed_for_tiles(grid: &Grid, spheres: &[Sphere]) -> Result<u64, String> {
    let strides = grid.strides();
    let cells: usize = grid.axes.iter().map(|axis| axis.planes.len() - 1).product();
    let mut cell_of = vec![None; spheres.len()];
    for cell in 0..cells {
        let mut twice = None;
        grid.for_each_id(cell, true, |id| {
            if cell_of[id as usize].replace(cell).is_some() {
                twice = Some(id);
            }
        });
        if let Some(id) = twice {
            return Err(format!("sphere {id} is listed twice, the second time in cell {cell}"));
        }
    }
    for &id in &grid.large {
        if let Some(cell) = cell_of[id as usize].replace(usize::MAX) {
            return Err(format!("sphere {id} is among the large and in cell {cell}"));
        }
    }
    for ((id, sphere), cell) in spheres.iter().enumerate().zip(cell_of) {
        let due: usize = (0..3).map(|i| cell_on(&grid.axes[i], sphere.center[i]) * strides[i]).sum();
        match cell {
            Some(usize::MAX) => {}
            Some(cell) if cell == due && sphere.radius <= grid.widen => {}
            Some(cell) if cell == due => {
                let (radius, widen) = (bits(sphere.radius), bits(grid.widen));
                return Err(format!("sphere {id} reaches {radius}, and tiles look {widen} around"));
            }
            other => return Err(format!("sphere {id} is in cell {other:?} of the list, not in {due}")),
        }
    }
    Ok(spheres.len() as u64)
}

/// As many inner planes as are not above it.
pub(super) fn cell_on(axis: &Axis, x: f32) -> usize {
    axis.planes[1..axis.planes.len() - 1].iter().filter(|plane| **plane <= x).count()
}
