//! Is memory used as the language allows, and by one worker at a time? Small frames by every way there is, made to be run by Miri, which
//! sees each access to memory (`tests/sanitize miri`), and by the thread sanitizer (`tests/sanitize threads`); without them the
//! pictures alone are judged.
//!
//! Miri executes many thousand times slower than a processor: pictures are of a few blocks, and under it of fewer still.

use contract::{Animation, Camera, DEFAULT_LIGHT, Image, Scene, Size, Sphere};
use optimized::plan::{Arithmetic, Cells, Packet, Resolution, Sharing, Voxelizer};
use optimized::{Form, Level, Plan, Tracer};
use reference::Arithmetic as Naively;
use verify::judge::compare::compare;

/// Spheres before, behind and around the eye, touching and twice the same, and a camera whose last block is not whole.
fn scene() -> (Scene, Camera) {
    let ball = |center: [f32; 3], radius: f32, red: u8| Sphere { center, radius, color: [red, 90, 30] };
    let mut spheres = vec![
        ball([0.0, 0.0, -4.0], 1.0, 10),
        ball([0.0, 0.0, -4.0], 1.0, 20),
        ball([2.0, 0.5, -5.0], 1.0, 30),
        ball([-1.5, -0.5, -3.0], 0.75, 40),
        ball([0.0, 0.0, 3.0], 1.0, 50),
        ball([0.0, 6.0, -4.0], 5.0, 60),
    ];
    for i in 0u8..if cfg!(miri) { 1 } else { 6 } {
        spheres.push(ball([f32::from(i) * 0.25 - 0.7, -0.8, -2.5], 0.1, 100 + i));
    }
    let size = if cfg!(miri) { Size::new(5, 3) } else { Size::new(9, 6) }.expect("small");
    let camera = Camera::new([0.0; 3], [-0.9, 0.6, -1.0], [0.2, 0.0, 0.0], [0.0, -0.2, 0.0], size);
    (Scene::new(spheres, [1, 2, 3], DEFAULT_LIGHT).expect("valid"), camera.expect("a camera"))
}

/// The plans that differ in how they use memory.
fn plans() -> Vec<Plan> {
    let small = Plan { resolution: Resolution::Fixed(3), ..Plan::safe() };
    vec![
        small,
        Plan { cells: Cells::Queue, voxelizer: Voxelizer::EightCorners, ..small },
        Plan {
            voxelizer: Voxelizer::Overlap,
            sharing: Sharing::Mirrored,
            arithmetic: Form::Textbook.into(),
            ..small
        },
        Plan { arithmetic: Arithmetic::Certified, voxelizer: Voxelizer::ByCenter, ..small },
        Plan { packet: Packet::Tile { side: 1 }, resolution: Resolution::Fixed(3), ..Plan::fast() },
        Plan { packet: Packet::Tile { side: 2 }, resolution: Resolution::UpTo(4), ..Plan::fast() },
    ]
}

fn first_wrong(expected: &Image, given: &Image) -> Option<[u32; 2]> {
    compare(expected, given).expect("of one size").first_wrong
}

/// Each plan, level and number of workers, two frames in one session of which the second is smaller.
#[test]
fn small_frames_are_the_naive_ones() {
    let (scene, camera) = scene();
    let fewer = Scene::new(scene.spheres()[2..5].to_vec(), scene.background(), scene.light()).expect("valid");
    let frames = Animation::new(vec![scene, fewer]).expect("two");
    let naive = |scene: &Scene, arithmetic| {
        reference::Tracer::new(arithmetic).threads(1).render(scene, &camera).expect("small").image
    };
    let mut pictures = 0;
    for plan in plans() {
        let own = match plan.arithmetic {
            Arithmetic::Certified => Naively::Exact,
            Arithmetic::Rounded(Form::Textbook) => Naively::F32Textbook,
            _ => Naively::F32Perpendicular,
        };
        for level in Level::available() {
            for workers in [1, 3] {
                // One of both is enough for whom it takes a minute.
                if cfg!(miri)
                    && (workers == 1) == (plan.sharing == Sharing::Mirrored || plan.packet != Packet::Block)
                {
                    continue;
                }
                let mut session = Tracer::new(plan, level).workers(workers).session().expect("threads");
                for scene in frames.frames() {
                    let image = &session.render(scene, &camera).expect("falls back").image;
                    let wrong = first_wrong(&naive(scene, own), image);
                    assert_eq!(wrong, None, "{plan}, {level}, {workers} workers");
                    pictures += 1;
                }
            }
        }
    }
    let levels: Vec<_> = Level::available().iter().map(|level| level.name()).collect();
    eprintln!("{pictures} pictures at {}", levels.join(", "));
}

/// The reference, in each arithmetic, by one thread and by two.
#[test]
fn the_reference_does_not_depend_on_threads() {
    let (scene, camera) = scene();
    for arithmetic in [
        Naively::Exact,
        Naively::ExactUnfiltered,
        Naively::F64,
        Naively::F32Textbook,
        Naively::F32Perpendicular,
        Naively::SpuTextbook,
        Naively::SpuPerpendicular,
    ] {
        let by = |threads| {
            reference::Tracer::new(arithmetic).threads(threads).render(&scene, &camera).expect("small").image
        };
        assert_eq!(first_wrong(&by(1), &by(2)), None, "{arithmetic:?}");
    }
    let of = |arithmetic| {
        reference::Tracer::new(arithmetic).threads(1).render(&scene, &camera).expect("small").image
    };
    assert_eq!(first_wrong(&of(Naively::Exact), &of(Naively::ExactUnfiltered)), None);
}
