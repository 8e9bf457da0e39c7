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
use contract::{Camera, Image, MISS, Scene, Size, SizeError};
use std::sync::Mutex;
use std::time::{Duration, Instant};

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
    /// How long it took.
    pub times: Times,
}

/// Where the time of a frame went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// Until everything stood that all rays share: the grid, and the spheres as seen from the eye.
    pub build: Duration,
    /// From there to the finished picture.
    pub trace: Duration,
}

/// What a tracer would have to know beforehand to do nothing in vain: of each 4x4 block the spheres that own a pixel of it.
/// Who is given that ([`Session::render_known`](crate::Session::render_known)) shows how fast the sphere kernel could go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Known {
    size: Size,
    offsets: Vec<u32>,
    ids: Vec<u32>,
}

impl Known {
    /// From a picture that has been made.
    #[must_use]
    pub fn of(image: &Image) -> Self {
        let (width, height) = (image.size.width(), image.size.height());
        let mut known = Self { size: image.size, offsets: vec![0], ids: Vec::new() };
        for y in (0..height).step_by(BLOCK as usize) {
            for x in (0..width).step_by(BLOCK as usize) {
                let first = known.ids.len();
                for row in y..(y + BLOCK).min(height) {
                    for column in x..(x + BLOCK).min(width) {
                        let id = image.ids[row as usize * width as usize + column as usize];
                        if id != MISS && !known.ids[first..].contains(&id) {
                            known.ids.push(id);
                        }
                    }
                }
                known.offsets.push(u32::try_from(known.ids.len()).expect("fewer than pixels"));
            }
        }
        known
    }

    /// The owners in the block whose first pixel is (x, y).
    #[inline(always)]
    fn block(&self, x: u32, y: u32) -> &[u32] {
        let index = (y / BLOCK * self.size.width().div_ceil(BLOCK) + x / BLOCK) as usize;
        &self.ids[self.offsets[index] as usize..self.offsets[index + 1] as usize]
    }
}

/// A stripe of the image under work: its rows of ids, t and colours.
struct Stripe<'a> {
    y: u32,
    ids: &'a mut [u32],
    t: &'a mut [f32],
    rgba: &'a mut [[u8; 4]],
}

impl Rendering {
    /// An empty frame, whose memory is taken by those that follow.
    pub(crate) fn nothing() -> Result<Self, RenderError> {
        let (image, events) = (Image::new(Size::new(1, 1)?, [0; 3])?, Events::default());
        Ok(Self { image, events, counts: Counts::default(), times: Times::default() })
    }
}

/// Renders a frame with so many workers into the memory of the one before; the picture depends on neither.
///
/// # Errors
/// [`RenderError`] if the image cannot be had, the plan refuses what the scene does, or what is known is of another size.
///
/// # Panics
/// If a worker panicked.
pub fn render<M: Machine + Send + Sync>(
    m: M,
    plan: Plan,
    scene: &Scene,
    camera: &Camera,
    workers: usize,
    known: Option<&Known>,
    rendering: &mut Rendering,
) -> Result<(), RenderError> {
    if let Some(known) = known
        && known.size != camera.size()
    {
        return Err(RenderError::Known { known: known.size, asked: camera.size() });
    }
    let start = Instant::now();
    rendering.events = Events::default();
    let seen = match known {
        None => Seen::new(m, plan, scene, camera, &mut rendering.events)?,
        Some(_) => Seen::without_grid(plan, scene.spheres(), camera.eye()),
    };
    rendering.times.build = start.elapsed();
    clear(&mut rendering.image, camera.size(), scene.background())?;
    let image = &mut rendering.image;
    let rows = camera.size().width() as usize * BLOCK as usize;
    let layers = image.ids.chunks_mut(rows).zip(image.t.chunks_mut(rows)).zip(image.rgba.chunks_mut(rows));
    let stripes = (0..).step_by(BLOCK as usize).zip(layers);
    let stripes = Mutex::new(stripes.map(|(y, ((ids, t), rgba))| Stripe { y, ids, t, rgba }));
    let next = || stripes.lock().expect("no worker panics while it holds the list").next();
    let work = || {
        let mirrored = match (plan.sharing, known) {
            // The same grid with the same events once more; an error would have come the first time.
            (Sharing::Mirrored, None) => Seen::new(m, plan, scene, camera, &mut Events::default()).ok(),
            _ => None,
        };
        let seen = mirrored.as_ref().unwrap_or(&seen);
        let mut worker = Worker::default();
        while let Some(mut stripe) = next() {
            m.within(
                #[inline(always)]
                || fill(m, seen, scene, camera, known, &mut stripe, &mut worker),
            );
        }
        worker.counts
    };
    rendering.counts = if workers <= 1 {
        work()
    } else {
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
            let counts = workers.into_iter().map(|worker| worker.join().expect("a worker panicked"));
            counts.fold(Counts::default(), |sum, counts| sum + counts)
        })
    };
    rendering.times.trace = start.elapsed() - rendering.times.build;
    Ok(())
}

/// Makes all of an image misses before a background, in its own memory if its size is the same.
fn clear(image: &mut Image, size: Size, [r, g, b]: [u8; 3]) -> Result<(), SizeError> {
    if image.size != size {
        *image = Image::new(size, [r, g, b])?;
        return Ok(());
    }
    image.ids.fill(MISS);
    image.t.fill(f32::INFINITY);
    image.rgba.fill([r, g, b, 255]);
    Ok(())
}

#[inline(always)]
fn fill<M: Machine>(
    m: M,
    seen: &Seen,
    scene: &Scene,
    camera: &Camera,
    known: Option<&Known>,
    stripe: &mut Stripe<'_>,
    worker: &mut Worker,
) {
    let lanes = CameraLanes::new(m, camera);
    for x in (0..camera.size().width()).step_by(BLOCK as usize) {
        let (xs, ys) = middles(m, camera, x, stripe.y);
        let block = lanes.block(m, xs, ys);
        let owners = known.map(
            #[inline(always)]
            |known| known.block(x, stripe.y),
        );
        let answers = seen.trace(m, scene.spheres(), &block, owners, worker);
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
