//! A frame: the grid is built, then stripes of four scanlines go to the workers as these become free, each stripe
//! in 4x4 blocks from left to right (the paper's SPUs and their blocks of scanlines).

use crate::camera::{BLOCK, Block, CameraLanes, middles, spread};
use crate::event::{Events, RenderError};
use crate::machine::{LANES, Machine, three};
use crate::plan::{Plan, Sharing};
use crate::seen::{Counts, Seen, Worker};
use crate::settle::Answers;
use crate::shade::{Surface, shade};
use crate::sphere::NONE;
use contract::{Camera, Image, Scene};
use std::sync::Mutex;

/// A picture and how it came about.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// The picture.
    pub image: Image,
    /// What the scene did that the plan's choices do not allow, in the order in which it was found. If there is any, the
    /// plan's [`OnEvent`](crate::plan::OnEvent) says what followed.
    pub events: Events,
    /// What tracing cost.
    pub counts: Counts,
}

/// A stripe of the image under work: its rows of ids, t and colours.
struct Stripe<'a> {
    y: u32,
    ids: &'a mut [u32],
    t: &'a mut [f32],
    rgba: &'a mut [[u8; 4]],
}

/// Renders a frame with so many workers; the picture does not depend on them.
///
/// # Errors
/// [`RenderError`] if the image cannot be had or the plan refuses what the scene does.
///
/// # Panics
/// If a worker panicked.
pub fn render<M: Machine + Send + Sync>(
    m: M,
    plan: Plan,
    scene: &Scene,
    camera: &Camera,
    workers: usize,
) -> Result<Rendering, RenderError> {
    let mut image = Image::new(camera.size(), scene.background())?;
    let mut events = Events::default();
    let seen = Seen::new(m, plan, scene, camera, &mut events)?;
    let rows = camera.size().width() as usize * BLOCK as usize;
    let layers = image.ids.chunks_mut(rows).zip(image.t.chunks_mut(rows)).zip(image.rgba.chunks_mut(rows));
    let stripes = (0..).step_by(BLOCK as usize).zip(layers);
    let stripes = Mutex::new(stripes.map(|(y, ((ids, t), rgba))| Stripe { y, ids, t, rgba }));
    let next = || stripes.lock().expect("no worker panics while it holds the list").next();
    let work = || {
        let mirrored = match plan.sharing {
            Sharing::Shared => None,
            // The same grid with the same events once more; an error would have come the first time.
            Sharing::Mirrored => Seen::new(m, plan, scene, camera, &mut Events::default()).ok(),
        };
        let seen = mirrored.as_ref().unwrap_or(&seen);
        let mut worker = Worker::default();
        while let Some(mut stripe) = next() {
            m.within(
                #[inline(always)]
                || fill(m, seen, scene, camera, &mut stripe, &mut worker),
            );
        }
        worker.counts
    };
    let counts = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..workers.max(1)).map(|_| scope.spawn(work)).collect();
        let counts = workers.into_iter().map(|worker| worker.join().expect("a worker panicked"));
        counts.fold(Counts::default(), |sum, counts| sum + counts)
    });
    Ok(Rendering { image, events, counts })
}

#[inline(always)]
fn fill<M: Machine>(
    m: M,
    seen: &Seen,
    scene: &Scene,
    camera: &Camera,
    stripe: &mut Stripe<'_>,
    worker: &mut Worker,
) {
    let lanes = CameraLanes::new(m, camera);
    for x in (0..camera.size().width()).step_by(BLOCK as usize) {
        let (xs, ys) = middles(m, camera, x, stripe.y);
        let block = lanes.block(m, xs, ys);
        let answers = seen.trace(m, scene.spheres(), &block, worker);
        write(m, scene, seen, &block, &answers, x as usize, camera.size().width() as usize, stripe);
    }
}

/// Rim: colours a block and writes the pixels of it that hit.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "all of it differs from block to block")]
fn write<M: Machine>(
    m: M,
    scene: &Scene,
    seen: &Seen,
    block: &Block<M>,
    answers: &Answers,
    x: usize,
    width: usize,
    stripe: &mut Stripe<'_>,
) {
    let Answers { t, id: ids } = *answers;
    if ids == [NONE; LANES] {
        return;
    }
    let mut gathered = [[0.0; LANES]; 7];
    for lane in 0..LANES {
        if let Some(s) = scene.spheres().get(ids[lane].unsigned_abs() as usize) {
            let [r, g, b] = s.color.map(f32::from);
            let values = [s.center[0], s.center[1], s.center[2], s.radius, r, g, b];
            for (lanes, value) in gathered.iter_mut().zip(values) {
                lanes[lane] = value;
            }
        }
    }
    let [cx, cy, cz, radius, r, g, b] = gathered;
    let (center, color) = ([cx, cy, cz], [r, g, b]);
    let surface = Surface { center: gather(m, center), radius: m.lanes(radius), color: gather(m, color) };
    let (eye, light) = (spread(m, seen.eye), spread(m, scene.light()));
    let rgb = three(
        shade(m, eye, block.dir, light, m.lanes(t), &surface),
        #[inline(always)]
        |channel| m.to_array_i(channel),
    );
    for lane in 0..LANES {
        let column = x + lane % BLOCK as usize;
        let pixel = lane / BLOCK as usize * width + column;
        if ids[lane] == NONE || column >= width || pixel >= stripe.ids.len() {
            continue;
        }
        stripe.ids[pixel] = ids[lane].unsigned_abs();
        stripe.t[pixel] = t[lane];
        stripe.rgba[pixel] = [to_byte(rgb[0][lane]), to_byte(rgb[1][lane]), to_byte(rgb[2][lane]), 255];
    }
}

#[inline(always)]
fn gather<M: Machine>(m: M, lanes: [[f32; LANES]; 3]) -> [M::F; 3] {
    three(
        lanes,
        #[inline(always)]
        |lanes| m.lanes(lanes),
    )
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255 by rule 4")]
fn to_byte(channel: i32) -> u8 {
    channel as u8
}
