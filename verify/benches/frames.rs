//! How much faster is the safe plan than the naive tracer it equals? 1HVR at 1280x720, the grid rebuilt in every frame,
//! with the same number of threads. Checked first, then timed; the ratio is of one interleaved run.
//!
//! Measured on two shared cores of an AMD EPYC (family 26, model 2), rustc 1.95.0, 22 November 2026, as many times as fast
//! as naive (3.9 s) with one thread: scalar 61, SSE2 68, SSE4.2 91, AVX2 125, AVX-512 136 (28.7 ms). With two threads, when
//! other work held one of the cores: 62, 64, 97, 108, 126.
//!
//! And what certainty costs: blocks with certified arithmetic against the same in the perpendicular form, one thread, AVX-512, on the same machine,
//! 24 November 2026, medians of two runs: 1HVR 1.24 and 1.31 times as much, adenylate kinase 1.27 and 1.32, sphereflake 4 1.39 and
//! 1.26, 2,000 random spheres 1.40 and 1.37; geometric means 1.32 and 1.31.

use contract::{Camera, Image, Scene};
use criterion::{BenchmarkId, Criterion};
use optimized::{Level, Plan, Rendering, Tracer};
use reference::Arithmetic;
use std::hint::black_box;
use std::time::{Duration, Instant};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;

/// Threads of both.
const THREADS: [usize; 2] = [1, 2];
/// Runs that a ratio is made of, each of all subjects in turn. Quoted are medians.
const ROUNDS: usize = 5;
/// Frames of the grid tracer for each of the naive one, since it is so much shorter.
const FRAMES: u32 = 10;
/// What is wanted of the best level.
const WANTED: f64 = 10.0;

/// Where certainty is priced, and at most how much it is to cost.
const SCENES: [&str; 4] = ["1hvr", "adk", "sphereflake:4", "uniform:2000:1"];
const AT_MOST: f64 = 1.4;

struct Input {
    name: &'static str,
    scene: Scene,
    camera: Camera,
}

impl Input {
    fn new(name: &'static str) -> Option<Self> {
        let animation = match Source::parse(name).and_then(|source| source.load()) {
            Ok(loaded) => loaded.animation,
            Err(error) => {
                eprintln!("not judged: {error}");
                return None;
            }
        };
        let camera = Framing::default().camera(&animation).expect("it can be seen");
        Some(Self { name, scene: animation.frames()[0].clone(), camera })
    }

    fn naive(&self, arithmetic: Arithmetic, threads: usize) -> Image {
        let tracer = reference::Tracer::new(arithmetic).threads(threads);
        tracer.render(&self.scene, &self.camera).expect("it fits").image
    }

    fn grid(&self, plan: Plan, level: Level, threads: usize) -> Rendering {
        let tracer = Tracer::new(plan, level).workers(threads);
        tracer.render(&self.scene, &self.camera).expect("the plan refuses nothing")
    }

    fn safe(&self, level: Level, threads: usize) -> Image {
        self.grid(Plan::safe(), level, threads).image
    }

    /// Time of a naive frame, and of a frame at each level, in one round.
    fn round(&self, threads: usize, levels: &[Level]) -> (Duration, Vec<Duration>) {
        let naive = time(1, || self.naive(Arithmetic::F32Perpendicular, threads));
        (naive, levels.iter().map(|&level| time(FRAMES, || self.safe(level, threads))).collect())
    }
}

fn time<R>(frames: u32, frame: impl Fn() -> R) -> Duration {
    let start = Instant::now();
    for _ in 0..frames {
        black_box(frame());
    }
    start.elapsed() / frames
}

/// # Panics
/// If a picture differs by a bit.
fn check(input: &Input, plan: Plan, naive: Arithmetic, levels: &[Level]) {
    let naive = input.naive(naive, 2);
    let bits = |image: &Image| image.t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
    for level in levels {
        for threads in THREADS {
            let grid = input.grid(plan, *level, threads).image;
            let equal = grid.ids == naive.ids && grid.rgba == naive.rgba && bits(&grid) == bits(&naive);
            let name = input.name;
            assert!(
                equal,
                "{name}, {level}, {threads} threads: the pictures differ, there is nothing to time"
            );
        }
    }
}

/// What certainty costs: the safe plan with certified arithmetic against the same in the perpendicular form, one thread, the best level.
/// (Tiles are certified only; `cgt bench` times these.)
fn certainty(level: Level) {
    let rounded = Plan::safe();
    let certain = Plan { arithmetic: optimized::plan::Arithmetic::Certified, ..rounded };
    let mut product = (0, 1.0);
    for input in SCENES.into_iter().filter_map(Input::new) {
        check(&input, certain, Arithmetic::Exact, &[level]);
        let round = |plan: Plan| time(FRAMES, || input.grid(plan, level, 1));
        let rounds: Vec<_> = (0..ROUNDS).map(|_| (round(rounded), round(certain))).collect();
        let plain = median(rounds.iter().map(|(plain, _)| *plain).collect());
        let certified = median(rounds.iter().map(|(_, certified)| *certified).collect());
        let counts = input.grid(certain, level, 1).counts;
        let in_a_million = |n: u64| n as f64 * 1e6 / counts.lanes as f64;
        eprintln!(
            "{}: {level}, perpendicular {:.2} ms, certified {:.2} ms, {:.2} times as much; of a million rays {:.1} to f64, \
             {:.1} to integers, {:.1} rounded by integers",
            input.name,
            1e3 * plain,
            1e3 * certified,
            certified / plain,
            in_a_million(counts.asked_f64),
            in_a_million(counts.asked_integers),
            in_a_million(counts.rounded_by_integers)
        );
        product = (product.0 + 1, product.1 * certified / plain);
    }
    let mean = product.1.powf(1.0 / f64::from(product.0));
    eprintln!("{} scenes: certified costs {mean:.2} times as much, at most {AT_MOST} is wanted", product.0);
    if mean > AT_MOST {
        eprintln!("MISSED: certified arithmetic is to cost at most {AT_MOST} times the perpendicular form");
    }
}

fn median(mut times: Vec<Duration>) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64()
}

fn ratios(input: &Input, levels: &[Level]) {
    for threads in THREADS {
        let rounds: Vec<_> = (0..ROUNDS).map(|_| input.round(threads, levels)).collect();
        let naive = median(rounds.iter().map(|(naive, _)| *naive).collect());
        eprintln!("{threads} threads: naive {:.1} ms", 1e3 * naive);
        for (i, level) in levels.iter().enumerate() {
            let safe = median(rounds.iter().map(|(_, safe)| safe[i]).collect());
            eprintln!("{threads} threads: {level} {:.2} ms, {:.1} times as fast", 1e3 * safe, naive / safe);
            let best = i + 1 == levels.len();
            if best && naive < WANTED * safe {
                eprintln!("{threads} threads: MISSED: the best level is to be {WANTED} times as fast");
            }
        }
    }
}

fn main() {
    let (input, levels) = (Input::new("1hvr").expect("bundled"), Level::available());
    certainty(*levels.last().expect("scalar at least"));
    check(&input, Plan::safe(), Arithmetic::F32Perpendicular, &levels);
    ratios(&input, &levels);
    let mut criterion = Criterion::default().configure_from_args().sample_size(10);
    for threads in THREADS {
        let mut group = criterion.benchmark_group(format!("1HVR, 1280x720, {threads} threads"));
        for level in &levels {
            group.bench_function(BenchmarkId::new("safe", level), |b| b.iter(|| input.safe(*level, threads)));
        }
        group.bench_function("naive", |b| b.iter(|| input.naive(Arithmetic::F32Perpendicular, threads)));
        group.finish();
    }
    criterion.final_summary();
}
