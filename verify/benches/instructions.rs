//! How many instructions do the kernels, a rebuild and whole frames take? Counted by Valgrind's callgrind, which does not
//! depend on what else the machine does, at the levels that Valgrind knows: it has no AVX-512.
//!
//! `tests/instructions` runs this, and holds the counts against those in `instructions.json` beside this file.
#![allow(
    clippy::exit,
    missing_docs,
    unreachable_pub,
    unused_qualifications,
    reason = "what the macros of gungraun make"
)]

use contract::{Camera, Scene, Size, Sphere};
use gungraun::{Callgrind, prelude::*};
use optimized::bound::{NEAREST, Rule};
use optimized::camera::Block;
use optimized::certain::{self, Ball, Rays, Side};
use optimized::host::{Level, Work};
use optimized::machine::{LANES, Machine};
use optimized::sphere::{Form, Nearest, Prepared};
use optimized::{Plan, Session, Tracer};
use rand::RngExt;
use std::hint::black_box;
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;

/// Spheres that a kernel meets.
const SPHERES: usize = 1024;

/// The level of that name, on the processor that Valgrind shows.
fn level(name: &str) -> Level {
    Level::named(name).unwrap_or_else(|error| panic!("{error}"))
}

/// A tracer that has its memory from a frame before, and its next frame.
struct Next {
    session: Session,
    scene: Scene,
    camera: Camera,
}

/// One thread of the fast plan.
fn next(scene: &str, [width, height]: [u32; 2], name: &str) -> Next {
    let animation =
        Source::parse(scene).and_then(|source| source.load()).expect("bundled or generated").animation;
    let framing = Framing { size: Some(Size::new(width, height).expect("a size")), ..Framing::default() };
    let camera = framing.camera(&animation).expect("it can be seen");
    let scene = animation.frames()[0].clone();
    let mut session = Tracer::new(Plan::fast(), level(name)).session().expect("memory");
    session.render(&scene, &camera).expect("the plan refuses nothing");
    Next { session, scene, camera }
}

/// The same, of one block in the middle of the view, a thousandth as wide: little is left but the rebuild.
fn needle(scene: &str, name: &str) -> Next {
    let mut next = next(scene, [4, 4], name);
    let [corner, du, dv] = [next.camera.corner(), next.camera.du(), next.camera.dv()];
    let middle = [0, 1, 2].map(|i| corner[i] + 2.0 * (du[i] + dv[i]));
    let [du, dv] = [du, dv].map(|step| step.map(|x| x / 1000.0));
    next.camera = Camera::new(next.camera.eye(), middle, du, dv, next.camera.size()).expect("it has an area");
    next.session.render(&next.scene, &next.camera).expect("the plan refuses nothing");
    next
}

/// Gives the tracer back, so that its end is not counted.
fn render(mut next: Next) -> Next {
    next.session.render(black_box(&next.scene), black_box(&next.camera)).expect("the plan refuses nothing");
    next
}

/// Sixteen rays about −z, and spheres of which about one in eight is hit by one of them at least.
struct Rows {
    level: Level,
    spheres: Vec<Prepared>,
    balls: Vec<Ball>,
    dir: [[f32; LANES]; 3],
}

fn rows(name: &str) -> Rows {
    let mut rng = verify::seed::generator(7, 0);
    let rule = Rule::new(NEAREST);
    let (mut spheres, mut balls) = (Vec::new(), Vec::new());
    for _ in 0..SPHERES {
        let mut at = |scale: f32| scale * (rng.random::<f32>() - 0.5);
        let center @ [x, y, z] = [at(6.0), at(6.0), at(20.0) - 20.0];
        let radius = 1.0;
        spheres.push(Prepared::new([0.0; 3], &Sphere { center, radius, color: [0; 3] }));
        let bound = rule.bound(-z, radius);
        balls.push(Ball { center: [-z, x, y], rr: radius * radius, bound, side: Side::Outside });
    }
    let mut dir = [[0.0; LANES], [0.0; LANES], [-1.0; LANES]];
    for (lane, at) in (0u8..).zip(0..LANES) {
        dir[0][at] = f32::from(lane % 4) * 0.002;
        dir[1][at] = f32::from(lane / 4) * 0.002;
    }
    Rows { level: level(name), spheres, balls, dir }
}

/// Bits of what a kernel found, and ids.
type Hits = ([u32; LANES], [i32; LANES]);

struct Plain<'a>(&'a Rows);

impl Work for Plain<'_> {
    type Output = Hits;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Hits {
        m.within(
            #[inline(always)]
            || {
                let [x, y, z] = self.0.dir;
                let block = Block::new(m, [m.lanes(x), m.lanes(y), m.lanes(z)]);
                let mut nearest = Nearest::none(m);
                for (sphere, id) in self.0.spheres.iter().zip(0..) {
                    nearest = nearest.meet(m, Form::Perpendicular, &block, sphere, id);
                }
                (m.to_array(nearest.t).map(f32::to_bits), m.to_array_i(nearest.id))
            },
        )
    }
}

struct Certified<'a>(&'a Rows);

impl Work for Certified<'_> {
    type Output = Hits;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Hits {
        m.within(
            #[inline(always)]
            || {
                let [x, y, _] = self.0.dir;
                let rays = Rays::new(m, [m.lanes(x), m.lanes(y)]);
                let all = m.le(m.splat(0.0), m.splat(0.0));
                let mut nearest = certain::Nearest::none(m);
                for (ball, id) in self.0.balls.iter().zip(0..) {
                    if let Some(found) = rays.find(m, ball, all) {
                        nearest = nearest.meet(m, &found, id);
                    }
                }
                (m.to_array(nearest.lo).map(f32::to_bits), m.to_array_i(nearest.id))
            },
        )
    }
}

#[library_benchmark]
#[bench::sse2(args = ("sse2"), setup = rows)]
#[bench::sse4_2(args = ("sse4.2"), setup = rows)]
#[bench::avx2(args = ("avx2"), setup = rows)]
fn sphere_kernel(rows: Rows) -> (Hits, Rows) {
    (rows.level.run(Plain(black_box(&rows))), rows)
}

#[library_benchmark]
#[bench::sse2(args = ("sse2"), setup = rows)]
#[bench::sse4_2(args = ("sse4.2"), setup = rows)]
#[bench::avx2(args = ("avx2"), setup = rows)]
fn certified_kernel(rows: Rows) -> (Hits, Rows) {
    (rows.level.run(Certified(black_box(&rows))), rows)
}

#[library_benchmark]
#[bench::uniform_4000_sse2(args = ("uniform:4000:1", "sse2"), setup = needle)]
#[bench::uniform_4000_sse4_2(args = ("uniform:4000:1", "sse4.2"), setup = needle)]
#[bench::uniform_4000_avx2(args = ("uniform:4000:1", "avx2"), setup = needle)]
fn rebuild(next: Next) -> Next {
    render(next)
}

#[library_benchmark]
#[bench::uniform_500_sse2(args = ("uniform:500:1", [160, 96], "sse2"), setup = next)]
#[bench::uniform_500_sse4_2(args = ("uniform:500:1", [160, 96], "sse4.2"), setup = next)]
#[bench::uniform_500_avx2(args = ("uniform:500:1", [160, 96], "avx2"), setup = next)]
#[bench::molecule_1hvr_sse2(args = ("1hvr", [160, 96], "sse2"), setup = next)]
#[bench::molecule_1hvr_sse4_2(args = ("1hvr", [160, 96], "sse4.2"), setup = next)]
#[bench::molecule_1hvr_avx2(args = ("1hvr", [160, 96], "avx2"), setup = next)]
fn frame(next: Next) -> Next {
    render(next)
}

library_benchmark_group!(name = counted, benchmarks = [sphere_kernel, certified_kernel, rebuild, frame]);

main!(
    config = LibraryBenchmarkConfig::default().tool(Callgrind::with_args(["--cache-sim=no"])),
    library_benchmark_groups = counted
);
