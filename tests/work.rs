//! Does a frame do the work that its plan is there for, and no more? What no picture shows, a machine counts that is told of every step:
//! spheres that are hidden, spheres that culling spares, and the grids of workers who each build their own.

use contract::{Camera, Scene};
use optimized::crew::Crew;
use optimized::frame::{Frame, render};
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::machine::{Chore, LANES, Site};
use optimized::plan::{Culling, Sharing};
use optimized::{Known, Level, Plan, Tracer};
use std::sync::atomic::{AtomicU64, Ordering};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::watch::{Listener, Watch};

/// What was done in a frame.
#[derive(Debug, Default)]
struct Work {
    /// Spheres held against the rays of a block.
    met: AtomicU64,
    /// Comparisons of sixteen numbers.
    compared: AtomicU64,
    /// Spheres put into a cell.
    entries: AtomicU64,
}

impl Listener for &Work {
    fn chore(self, chore: Chore) {
        let entries = match chore {
            Chore::Entry => 1,
            Chore::Push(cells) => cells as u64,
            _ => 0,
        };
        self.entries.fetch_add(entries, Ordering::Relaxed);
    }

    fn compared(self, _: bool, _: [f32; LANES], _: [f32; LANES]) {
        self.compared.fetch_add(1, Ordering::Relaxed);
    }

    fn any(self, site: Site, _: u32) {
        self.met.fetch_add(u64::from(site == Site::Sphere), Ordering::Relaxed);
    }
}

/// A scene of the catalogue.
fn shown(name: &str, width: u32, height: u32, framing: Framing) -> (Scene, Camera) {
    let source = Source::parse(name).expect("a scene");
    let animation = source.load().expect("it is there").animation;
    let size = contract::Size::new(width, height).expect("small");
    let camera = Framing { size: Some(size), ..framing }.camera(&animation).expect("in sight");
    (animation.frames()[0].clone(), camera)
}

/// What a frame takes: spheres met, comparisons, and entries of cells.
fn work(plan: Plan, workers: usize, scene: &Scene, camera: &Camera, known: Option<&Known>) -> [u64; 3] {
    let done = Work::default();
    let m = Watch { values: Scalar, listener: &done };
    let crew = Crew::new(workers).expect("threads");
    let mut rendering = Tracer::new(plan, Level::SCALAR).render(scene, camera).expect("a picture");
    let image = rendering.image.clone();
    let frame = Frame { plan, scene, camera, crew: &crew, known };
    render(m, &frame, &mut Memory::default(), &mut rendering).expect("a picture");
    assert_eq!(rendering.image.ids, image.ids, "who is watched sees something else");
    [done.met, done.compared, done.entries].map(AtomicU64::into_inner)
}

/// Hidden spheres are not met, nor those beside a block, of which a patch has rid it, and the patch a tile: little more is done than by who
/// knows what is seen. Without culling there is no end of it.
#[test]
fn little_is_done_in_vain() {
    for name in ["1hvr", "uniform:2000:1", "sphereflake:3", "clump:2000:1"] {
        let (scene, camera) = shown(name, 320, 180, Framing::default());
        let plan = Plan::fast();
        let image = Tracer::new(plan, Level::SCALAR).render(&scene, &camera).expect("a picture").image;
        let [met, compared, _] = work(plan, 1, &scene, &camera, None);
        let [must, least, _] = work(plan, 1, &scene, &camera, Some(&Known::of(&image)));
        let of = |done: u64, least: u64| done as f64 / least as f64;
        let (met, compared) = (of(met, must), of(compared, least));
        eprintln!("{name}: meets {met:.2} times what it must, and compares {compared:.2} times as much");
        assert!(must > 1_000 && met < 2.0 && compared < 2.3, "{name}: {met}, {compared}");
        let [without, ..] = work(Plan { culling: Culling::None, ..plan }, 1, &scene, &camera, None);
        assert!(of(without, must) > 50.0, "{name}: {without} without culling of {must}");
    }
}

/// From close by a tile sees a part of what its cells list, and takes no more than that for its patches to look through: a third more would be
/// compared otherwise.
#[test]
fn a_tile_takes_what_it_may_see() {
    let close = Framing { eye: Some([30.0, 20.0, 400.0]), fov: Some(1.0), ..Framing::default() };
    let (scene, camera) = shown("clump:2000:1", 512, 256, close);
    let image = Tracer::new(Plan::fast(), Level::SCALAR).render(&scene, &camera).expect("a picture").image;
    let [_, compared, _] = work(Plan::fast(), 1, &scene, &camera, None);
    let [met, least, _] = work(Plan::fast(), 1, &scene, &camera, Some(&Known::of(&image)));
    let compared = compared as f64 / least as f64;
    eprintln!("compares {compared:.2} times what it must");
    assert!(met > 300 && compared < 4.0, "{compared} times");
}

/// Workers who share a grid find it built; of those who do not each builds its own, beside the one that is built for all.
#[test]
fn a_mirrored_grid_is_built_by_each_worker() {
    let (scene, camera) = shown("uniform:300:1", 64, 64, Framing::default());
    let built = |sharing, workers| work(Plan { sharing, ..Plan::paper() }, workers, &scene, &camera, None)[2];
    let once = built(Sharing::Shared, 1);
    assert!(once > 1_000, "{once} entries");
    for workers in [1, 3] {
        assert_eq!(built(Sharing::Shared, workers), once, "shared by {workers}");
        assert_eq!(built(Sharing::Mirrored, workers), once * (workers as u64 + 1), "mirrored by {workers}");
    }
}
