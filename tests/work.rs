//! Does a frame do the work that its plan is there for, and no more? What no picture shows, a machine counts that is told of every step:
//! spheres that are hidden, spheres that culling spares, the grids of workers who each build their own, what is done outside the door to
//! wide instructions, and who goes the long way to t.

use contract::{Camera, DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
use optimized::crew::Crew;
use optimized::double::{short_ends, short_error};
use optimized::frame::{Frame, render};
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::machine::{Chore, LANES, Machine, Site, Stage};
use optimized::plan::{Arithmetic, Culling, Packet, Sharing};
use optimized::seen::Counts;
use optimized::{Form, Known, Level, Plan, Tracer};
use std::cell::Cell;
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
    /// Lanes whose sphere is known, and whose t is asked by the long way.
    long: AtomicU64,
    /// Packets that are bounded.
    bounded: AtomicU64,
}

impl Listener for &Work {
    fn chore(self, chore: Chore) {
        let entries = match chore {
            Chore::Entry => 1,
            Chore::Push(cells) => cells as u64,
            _ => 0,
        };
        self.entries.fetch_add(entries, Ordering::Relaxed);
        if let Chore::Settled { only_t, .. } = chore {
            self.long.fetch_add(only_t.count_ones().into(), Ordering::Relaxed);
        }
    }

    fn stage(self, stage: Stage) {
        self.bounded.fetch_add(u64::from(stage == Stage::Frustum), Ordering::Relaxed);
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
    let size = Size::new(width, height).expect("small");
    let camera = Framing { size: Some(size), ..framing }.camera(&animation).expect("in sight");
    (animation.frames()[0].clone(), camera)
}

/// What a frame takes: spheres met, comparisons, and entries of cells.
fn work(plan: Plan, workers: usize, scene: &Scene, camera: &Camera, known: Option<&Known>) -> [u64; 3] {
    let done = Work::default();
    count(Watch { values: Scalar, listener: &done }, plan, workers, scene, camera, known);
    [done.met, done.compared, done.entries].map(AtomicU64::into_inner)
}

/// Renders a frame on a machine that counts; what the frame counts itself.
fn count<M: Machine + Send + Sync>(
    m: M,
    plan: Plan,
    workers: usize,
    scene: &Scene,
    camera: &Camera,
    known: Option<&Known>,
) -> Counts {
    let crew = Crew::new(workers).expect("threads");
    let mut rendering = Tracer::new(plan, Level::SCALAR).render(scene, camera).expect("a picture");
    let image = rendering.image.clone();
    let frame = Frame { plan, scene, camera, crew: &crew, known };
    render(m, &frame, &mut Memory::default(), &mut rendering).expect("a picture");
    assert_eq!(rendering.image.ids, image.ids, "who is watched sees something else");
    rendering.counts
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

/// A ball so far away that the error of the short way is a tenth of a step of t: so many rays of its middle go the long way as that error
/// says, no fewer and no more, whether by blocks or by tiles.
#[test]
fn the_long_way_is_gone_where_the_short_one_is_open() {
    let far = 40_000.0;
    let ball = Sphere { center: [0.0, 0.0, -far], radius: 1.0, color: [9; 3] };
    let scene = Scene::new(vec![ball], [0; 3], DEFAULT_LIGHT).expect("valid");
    let (size, step) = (Size::new(64, 64).expect("small"), 1.0 / 64.0);
    let camera = Camera::new([0.0; 3], [-0.5, 0.5, -far], [step, 0.0, 0.0], [0.0, -step, 0.0], size);
    let camera = camera.expect("valid");
    let error = short_error::<f64, _>(Scalar, [0.0, 0.0, far].map(|x| [x; LANES]), [1.0; LANES]);
    let is_open = |pixel: u32| {
        let dir = reference::Ray::of_pixel(&camera, pixel % 64, pixel / 64).dir.map(|d| [d; LANES]);
        let [lo, hi] =
            short_ends::<f64>([0.0; 3], &dir, &ball.center.map(|x| [x; LANES]), &[1.0; LANES], &error);
        lo[0].to_bits() != hi[0].to_bits()
    };
    let wanted = (0..64 * 64).filter(|pixel| is_open(*pixel)).count() as u64;
    for packet in [Packet::Block, Packet::Tile { side: 8 }] {
        let (plan, done) = (Plan { packet, ..Plan::fast() }, Work::default());
        let counts = count(Watch { values: Scalar, listener: &done }, plan, 1, &scene, &camera, None);
        let given = done.long.into_inner();
        eprintln!("{packet:?}: {given} of 4096 rays go the long way, {wanted} are open");
        assert_eq!(
            (counts.lanes, counts.asked_f64),
            (4096, 0),
            "f32 is not certain of the middle: {counts:?}"
        );
        assert!((200..2_000).contains(&wanted), "too little is at stake: {wanted}");
        assert!(given.abs_diff(wanted) * 20 <= wanted, "{packet:?}: {given}, not {wanted}");
    }
}

/// Of a molecule hardly a ray goes the long way.
#[test]
fn hardly_a_ray_goes_the_long_way() {
    let (scene, camera) = shown("1hvr", 320, 180, Framing::default());
    let image = Tracer::new(Plan::fast(), Level::SCALAR).render(&scene, &camera).expect("a picture").image;
    let hits = image.ids.iter().filter(|id| **id != MISS).count() as u64;
    for packet in [Packet::Block, Packet::Tile { side: 32 }] {
        let (plan, done) = (Plan { packet, ..Plan::fast() }, Work::default());
        count(Watch { values: Scalar, listener: &done }, plan, 1, &scene, &camera, None);
        let long = done.long.into_inner();
        eprintln!("{packet:?}: {long} of {hits} rays");
        assert!(hits > 5_000 && long * 100 < hits, "{packet:?}: {long} of {hits}");
    }
}

/// Each block is bounded, and of a block that has no axis each of its sixteen rays once more.
#[test]
fn each_ray_of_a_split_block_is_bounded() {
    let (scene, _) = shown("uniform:300:1", 8, 8, Framing::default());
    let size = Size::new(24, 24).expect("small");
    let camera = Camera::new([0.1; 3], [-1.1, 1.3, -1.0], [0.11, 0.013, 0.02], [0.017, -0.12, 0.01], size);
    let (plan, done) = (Plan { packet: Packet::Block, ..Plan::fast() }, Work::default());
    let m = Watch { values: Scalar, listener: &done };
    let counts = count(m, plan, 1, &scene, &camera.expect("valid"), None);
    assert!(counts.split_blocks > 3, "hardly a block is split: {counts:?}");
    assert_eq!(done.bounded.into_inner(), 36 + 16 * counts.split_blocks);
}

thread_local! {
    /// Doors that this thread is behind.
    static BEHIND: Cell<u32> = const { Cell::new(0) };
}

/// Doors that were gone through, and operations behind one and outside.
#[derive(Debug, Default)]
struct Doors {
    doors: AtomicU64,
    inside: AtomicU64,
    outside: AtomicU64,
}

/// Computes as `values` does, and tells where.
#[derive(Clone, Copy)]
struct Guarded<'a, V> {
    values: V,
    told: &'a Doors,
}

macro_rules! told {
    ($($name:ident($($x:ident: $of:ty),*) -> $to:ty;)*) => {
        $(fn $name(self, $($x: $of),*) -> $to {
            let place = if BEHIND.get() > 0 { &self.told.inside } else { &self.told.outside };
            place.fetch_add(1, Ordering::Relaxed);
            self.values.$name($($x),*)
        })*
    };
}

impl<'a, V: Machine> Machine for Guarded<'a, V> {
    type F = V::F;
    type I = V::I;
    type B = V::B;
    type Spu = Guarded<'a, V::Spu>;

    fn spu(self) -> Self::Spu {
        Guarded { values: self.values.spu(), told: self.told }
    }
    fn unit(self) -> f32 {
        self.values.unit()
    }
    fn within<R>(self, work: impl FnOnce() -> R) -> R {
        self.told.doors.fetch_add(1, Ordering::Relaxed);
        BEHIND.set(BEHIND.get() + 1);
        let result = self.values.within(work);
        BEHIND.set(BEHIND.get() - 1);
        result
    }

    told! {
        lanes(x: [f32; LANES]) -> Self::F;
        lanes_i(x: [i32; LANES]) -> Self::I;
        to_array(x: Self::F) -> [f32; LANES];
        to_array_i(x: Self::I) -> [i32; LANES];
        to_bits(x: Self::B) -> u32;
        splat(x: f32) -> Self::F;
        splat_i(x: i32) -> Self::I;
        add(x: Self::F, y: Self::F) -> Self::F;
        sub(x: Self::F, y: Self::F) -> Self::F;
        mul(x: Self::F, y: Self::F) -> Self::F;
        div(x: Self::F, y: Self::F) -> Self::F;
        sqrt(x: Self::F) -> Self::F;
        lt(x: Self::F, y: Self::F) -> Self::B;
        le(x: Self::F, y: Self::F) -> Self::B;
        lt_i(x: Self::I, y: Self::I) -> Self::B;
        and(x: Self::B, y: Self::B) -> Self::B;
        or(x: Self::B, y: Self::B) -> Self::B;
        not(x: Self::B) -> Self::B;
        select(choose: Self::B, yes: Self::F, no: Self::F) -> Self::F;
        select_i(choose: Self::B, yes: Self::I, no: Self::I) -> Self::I;
        add_i(x: Self::I, y: Self::I) -> Self::I;
        or_i(x: Self::I, y: Self::I) -> Self::I;
        shl_16(x: Self::I) -> Self::I;
        shr_16(x: Self::I) -> Self::I;
        floor(x: Self::F) -> Self::I;
        truncate(x: Self::F) -> Self::I;
        smallest(x: Self::F) -> Self::F;
        largest(x: Self::F) -> Self::F;
        any(x: Self::B, site: Site) -> bool;
    }
}

/// Outside a machine's door its operations are calls, which takes a frame many times as long and changes no picture: none is done there,
/// by whatever plan. Spheres that are met on the SPU have a function of their own, and so a door each.
#[test]
fn no_operation_is_done_outside_a_door() {
    let (scene, camera) = shown("uniform:300:1", 48, 36, Framing::default());
    let by_blocks = Plan { packet: Packet::Block, ..Plan::fast() };
    let on_spu = Plan { arithmetic: Arithmetic::Spu(Form::Perpendicular), ..Plan::safe() };
    let image = Tracer::new(Plan::fast(), Level::SCALAR).render(&scene, &camera).expect("a picture").image;
    let known = Known::of(&image);
    for (plan, known) in [
        (Plan::fast(), None),
        (Plan::fast(), Some(&known)),
        (by_blocks, None),
        (by_blocks, Some(&known)),
        (Plan::safe(), None),
        (Plan::paper(), None),
        (on_spu, None),
    ] {
        let told = Doors::default();
        let counts = count(Guarded { values: Scalar, told: &told }, plan, 2, &scene, &camera, known);
        let [doors, inside, outside] = [told.doors, told.inside, told.outside].map(AtomicU64::into_inner);
        eprintln!("{plan}: {inside} operations behind {doors} doors, {outside} outside");
        assert!(inside > 10_000 && doors > 3, "{plan}: {inside} operations behind {doors} doors");
        assert_eq!(outside, 0, "{plan}: operations outside a door");
        let met = counts.candidates - counts.culled;
        assert!(plan != on_spu || (met > 100 && doors > met), "{plan}: {doors} doors for {met} spheres");
    }
}
