//! Coherent grid traversal of sphere scenes, after Chapman 2007 and Wald et al. 2006.
//!
//! In: a checked [`contract::Scene`] and [`contract::Camera`]. Out: a [`contract::Image`], bit for bit what one
//! loop over all spheres per ray would give in the same arithmetic ([`Form`]).
//!
//! The simple program is that loop. The departures from it, each in its module, in the order in which data
//! flows: sixteen rays share each decision ([`machine`], [`camera`], [`sphere`]); a grid lists the spheres of
//! each cell ([`margin`], [`grid`]); a packet meets only the cells its frustum overlaps ([`frustum`], [`walk`]);
//! spheres outside the frustum's planes are dropped ([`cull`]); many blocks share one walk and hold its spheres by their outlines
//! ([`tile`], [`silhouette`]); colours are computed for a block at once ([`shade`]); stripes of the image go to workers ([`frame`]). Which of them are taken, and how, is a [`Plan`].
//!
//! Kernels are generic over [`machine::Machine`] and free of memory access; the machines of the host are in
//! [`host`].
//!
//! ```
//! use contract::{Camera, DEFAULT_LIGHT, MISS, Scene, Size, Sphere};
//! use optimized::{Level, Plan, Tracer};
//!
//! let sphere = Sphere { center: [0.0, 0.0, 0.0], radius: 1.0, color: [200, 80, 40] };
//! let scene = Scene::new(vec![sphere], [0, 0, 0], DEFAULT_LIGHT)?;
//! let size = Size::new(3, 3)?;
//! let camera = Camera::new([0.0, 0.0, 5.0], [-1.5, 1.5, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], size)?;
//! let image = Tracer::new(Plan::safe(), Level::best()?).render(&scene, &camera)?.image;
//! assert_eq!(image.ids, [MISS, MISS, MISS, MISS, 0, MISS, MISS, MISS, MISS]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod plan;

pub mod machine;

pub mod host;

pub mod camera;
pub mod sphere;

pub mod bound;
pub mod certain;

pub mod margin;

pub mod queue;

pub mod voxelize;

pub mod grid;

pub mod frustum;

pub mod cull;

pub mod walk;

pub mod float;

pub mod double;
pub mod integer;

pub mod exact;
pub mod settle;

mod bins;
pub mod silhouette;
pub mod stripe;
pub mod tile;

pub mod seen;

pub mod shade;

mod clock;
pub mod crew;
pub mod event;
pub mod frame;

pub use event::{Event, Events, RenderError};
pub use frame::{Known, Rendering};
pub use host::Level;
pub use plan::Plan;
pub use sphere::Form;

use contract::{Camera, Scene};
use crew::Crew;
use frame::Frame;
use grid::Memory;
use machine::Machine;

/// A grid tracer with its plan, level and number of workers chosen. Nothing is kept outside it, and nothing printed.
///
/// ```
/// use contract::{Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
/// use optimized::{Level, Plan, Tracer};
///
/// // A ball that falls, frame by frame.
/// let ball = |y| Sphere { center: [0.0, y, 0.0], radius: 1.0, color: [200, 80, 40] };
/// let frames = [3.0, 0.0, -3.0].map(|y| Scene::new(vec![ball(y)], [0, 0, 0], DEFAULT_LIGHT));
/// let size = Size::new(64, 64)?;
/// let camera = Camera::new([0.0, 0.0, 5.0], [-1.0, 1.0, -1.0], [1.0 / 32.0, 0.0, 0.0], [0.0, -1.0 / 32.0, 0.0], size)?;
/// let mut session = Tracer::new(Plan::fast(), Level::best()?).workers(2).session()?;
/// let mut rows = Vec::new();
/// for scene in frames {
///     let rendering = session.render(&scene?, &camera)?;
///     rows.push(rendering.image.ids.iter().position(|id| *id == 0).map(|i| i / 64));
/// }
/// // Its upper rim comes down.
/// assert!(rows[0].is_some() && rows[0] < rows[1] && rows[1] < rows[2]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Tracer {
    plan: Plan,
    level: Level,
    workers: usize,
}

impl Tracer {
    /// A tracer with one worker, at a level that the processor has.
    #[must_use]
    pub fn new(plan: Plan, level: Level) -> Self {
        Self { plan, level, workers: 1 }
    }

    /// The same with so many workers, at least one. The picture does not depend on it.
    #[must_use]
    pub fn workers(self, workers: usize) -> Self {
        Self { workers, ..self }
    }

    /// Renders one scene, grid building included. For more than one, [`Tracer::session`] saves getting the memory anew.
    ///
    /// # Errors
    /// [`RenderError`] if the image cannot be had or the plan refuses what the scene does.
    pub fn render(&self, scene: &Scene, camera: &Camera) -> Result<Rendering, RenderError> {
        let mut session = self.session()?;
        session.render(scene, camera)?;
        Ok(session.rendering)
    }

    /// A tracer at work on one frame after another.
    ///
    /// # Errors
    /// [`RenderError::Size`] if there is no memory at all, [`RenderError::Workers`] if there are no threads.
    pub fn session(&self) -> Result<Session, RenderError> {
        let (crew, rendering) = (Crew::new(self.workers)?, Rendering::nothing()?);
        Ok(Session { tracer: *self, crew, memory: Memory::default(), rendering })
    }
}

/// A tracer at work on one frame after another, each built from nothing; only memory and workers are kept from frame to frame.
#[derive(Clone, Debug)]
pub struct Session {
    tracer: Tracer,
    crew: Crew,
    memory: Memory,
    rendering: Rendering,
}

impl Session {
    /// The plan that it traces by.
    #[must_use]
    pub fn plan(&self) -> Plan {
        self.tracer.plan
    }

    /// The level that it runs at.
    #[must_use]
    pub fn level(&self) -> Level {
        self.tracer.level
    }

    /// Its workers, the calling thread included.
    #[must_use]
    pub fn workers(&self) -> usize {
        self.crew.size()
    }

    /// Renders a frame.
    ///
    /// # Errors
    /// As [`Tracer::render`].
    pub fn render(&mut self, scene: &Scene, camera: &Camera) -> Result<&Rendering, RenderError> {
        self.frame(scene, camera, None)
    }

    /// Renders a frame of which it is known what is seen in each block: no walk, no culling, no sphere in vain. All else is done as ever, and
    /// so it is a limit to what a better way to the spheres could bring. (The grid is built too, and left alone; its time is
    /// [`Times::build`](frame::Times::build).)
    ///
    /// # Errors
    /// As [`Tracer::render`], and [`RenderError::Known`].
    pub fn render_known(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        known: &Known,
    ) -> Result<&Rendering, RenderError> {
        self.frame(scene, camera, Some(known))
    }

    /// The last frame again, with all that was told of it; one that was refused since left it as it was. Before there was one, a picture of
    /// one pixel.
    #[must_use]
    pub fn last(&self) -> &Rendering {
        &self.rendering
    }

    fn frame(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        known: Option<&Known>,
    ) -> Result<&Rendering, RenderError> {
        let Tracer { plan, level, .. } = self.tracer;
        let frame = Frame { plan, scene, camera, crew: &self.crew, known };
        level.run(Work { frame, memory: &mut self.memory, rendering: &mut self.rendering })?;
        Ok(&self.rendering)
    }
}

struct Work<'a> {
    frame: Frame<'a>,
    memory: &'a mut Memory,
    rendering: &'a mut Rendering,
}

impl host::Work for Work<'_> {
    type Output = Result<(), RenderError>;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        frame::render(m, &self.frame, self.memory, self.rendering)
    }
}
