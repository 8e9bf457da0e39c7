//! Does a frame do the work that its plan is there for, and no more? What no picture shows, a machine counts that is told of every step:
//! spheres that are hidden, spheres that culling spares, and the grids of workers who each build their own.

use contract::{Camera, Scene};
use optimized::crew::Crew;
use optimized::frame::{Frame, render};
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::machine::{Chore, LANES, Site};
use optimized::plan::{Culling, Packet, Sharing};
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

/// A scene of the catalogue, as it is shown.
fn shown(name: &str, width: u32, height: u32) -> (Scene, Camera) {
    let source = Source::parse(name).expect("a scene");
    let animation = source.load().expect("it is there").animation;
    let size = contract::Size::new(width, height).expect("small");
    let camera = Framing { size: Some(size), ..Framing::default() }.camera(&animation).expect("in sight");
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

#[test]
fn measure() {
    for name in ["1hvr", "uniform:2000:1", "sphereflake:3", "clump:2000:1"] {
        let (scene, camera) = shown(name, 320, 180);
        for side in [4, 8, 12, 32] {
            for culling in [Culling::Planes, Culling::None] {
                let plan = Plan { culling, packet: Packet::Tile { side }, ..Plan::fast() };
                let image =
                    Tracer::new(plan, Level::SCALAR).render(&scene, &camera).expect("a picture").image;
                let known = Known::of(&image);
                let [a, b] = [None, Some(&known)].map(|known| work(plan, 1, &scene, &camera, known));
                eprintln!("{name} side {side} {culling:?}: {a:?} known {b:?}");
            }
        }
        for sharing in [Sharing::Shared, Sharing::Mirrored] {
            for workers in [1, 3] {
                let plan = Plan { sharing, ..Plan::paper() };
                eprintln!("{sharing:?} {workers} {:?}", work(plan, workers, &scene, &camera, None));
                let plan = Plan { sharing, ..Plan::fast() };
                eprintln!("{sharing:?} {workers} {:?}", work(plan, workers, &scene, &camera, None));
            }
        }
    }
}
