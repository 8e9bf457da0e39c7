//! The tracer of `optimized` with a plan, and its limit: the clairvoyant, the same sphere kernel told beforehand which
//! spheres own a pixel of each block, so that it needs no grid, culls nothing and meets no sphere in vain.
//!
//! Both give colours too, which nobody else does: that is more than is asked of the others.

use super::contestant::{Contestant, Frame, Kind, Layers, Oath};
use crate::subject::{NamedPlan, SubjectError, promise};
use contract::{Camera, Image, Scene};
use optimized::plan::{Chosen, Packet, Resolution};
use optimized::{Known, Level, Plan, Session, Tracer};

/// The plan that is timed on a scene: the one place where it is chosen.
#[must_use]
pub fn chosen(plan: NamedPlan, scene: &Scene) -> Chosen {
    match plan {
        NamedPlan::Fast => Plan::for_scene(scene),
        NamedPlan::Safe | NamedPlan::Paper => Chosen { plan: plan.plan(), reasons: Vec::new() },
    }
}

/// Plans picked by hand, that the chosen one is to be held against: [`Plan::fast`] with other tiles, with other grids and the chosen tile,
/// and without tiles. Each with its name.
#[must_use]
pub fn picked(scene: &Scene) -> Vec<(String, Plan)> {
    let chosen = Plan::for_scene(scene).plan;
    let sides = [8, 16, 24, 32, 48, 64].map(|side| (format!("tiles-{side}"), Packet::Tile { side }));
    let packets = sides.into_iter().chain([("blocks".to_owned(), Packet::Block)]);
    let packets = packets.map(|(name, packet)| (name, Plan { packet, ..chosen }));
    let grids = [2, 4, 8, 16, 32, 64]
        .map(|n| (format!("grid-{n}"), Plan { resolution: Resolution::Fixed(n), ..chosen }));
    packets.chain(grids).collect()
}

/// The tracer, or with `known` its limit.
pub struct Ours {
    name: String,
    kind: Kind,
    plan: Chosen,
    oath: Oath,
    session: Session,
    known: Option<Known>,
}

impl Ours {
    /// The tracer of a plan.
    ///
    /// # Errors
    /// If there is no memory at all.
    pub fn new(plan: NamedPlan, scene: &Scene, level: Level, threads: usize) -> Result<Self, SubjectError> {
        let oath = promise(plan.plan().arithmetic).into();
        let (name, plan) = (plan.name().to_owned(), chosen(plan, scene));
        let session = Tracer::new(plan.plan, level).workers(threads).session()?;
        Ok(Self { name, kind: Kind::Subject, plan, oath, session, known: None })
    }

    /// The tracer with any plan, held to what its arithmetic promises.
    ///
    /// # Errors
    /// As [`Ours::new`].
    pub fn of(name: String, plan: Plan, level: Level, threads: usize) -> Result<Self, SubjectError> {
        let session = Tracer::new(plan, level).workers(threads).session()?;
        let oath: Oath = promise(plan.arithmetic).into();
        let plan = Chosen { plan, reasons: Vec::new() };
        Ok(Self { name, kind: Kind::Picked, plan, oath, session, known: None })
    }

    /// The same told what it will see, from the exact picture.
    ///
    /// # Errors
    /// As [`Ours::new`].
    pub fn clairvoyant(
        plan: NamedPlan,
        scene: &Scene,
        level: Level,
        threads: usize,
        truth: &Image,
    ) -> Result<Self, SubjectError> {
        let ours = Self::new(plan, scene, level, threads)?;
        Ok(Self { name: "clairvoyant".into(), kind: Kind::Limit, known: Some(Known::of(truth)), ..ours })
    }
}

impl Contestant for Ours {
    fn name(&self) -> &str {
        &self.name
    }

    fn description(&self) -> String {
        match self.known {
            None => {
                let Chosen { plan, reasons } = &self.plan;
                let reasons: String = reasons.iter().map(|reason| format!("; {reason}")).collect();
                format!("ids, t and colours, built from nothing in every frame: {plan}{reasons}")
            }
            Some(_) => {
                "the same kernel, told which spheres own a pixel of each block: no grid, no culling".into()
            }
        }
    }

    fn kind(&self) -> Kind {
        self.kind
    }

    fn oath(&self) -> Oath {
        self.oath
    }

    fn frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Frame<'_>, SubjectError> {
        let rendering = match &self.known {
            None => self.session.render(scene, camera)?,
            Some(known) => self.session.render_known(scene, camera, known)?,
        };
        let Image { ids, t, rgba, .. } = &rendering.image;
        Ok(Frame { build: rendering.times.build, took: None, layers: Layers { ids, t, rgba: Some(rgba) } })
    }
}
