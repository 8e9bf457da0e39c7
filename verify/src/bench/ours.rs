//! The tracer of `optimized` with a plan, and its limit: the clairvoyant, the same sphere kernel told beforehand which
//! spheres own a pixel of each block, so that it needs no grid, culls nothing and meets no sphere in vain.
//!
//! Both give colours too, which nobody else does: that is more than is asked of the others.

use super::contestant::{Contestant, Frame, Kind, Layers, Oath};
use crate::subject::{Grid, NamedPlan, Subject, SubjectError};
use contract::{Camera, Image, Scene};
use optimized::plan::Chosen;
use optimized::{Known, Level, Plan, Session, Tracer};

/// The plan that is timed on a scene: the one place where it is chosen.
#[must_use]
pub fn chosen(plan: NamedPlan, scene: &Scene) -> Chosen {
    match plan {
        NamedPlan::Fast => Plan::for_scene(scene),
        NamedPlan::Safe | NamedPlan::Paper => Chosen { plan: plan.plan(), reasons: Vec::new() },
    }
}

/// The tracer, or with `known` its limit.
pub struct Ours {
    name: String,
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
        let oath = Grid::new(plan, level, false, None).promise().into();
        let (name, plan) = (plan.name().to_owned(), chosen(plan, scene));
        let session = Tracer::new(plan.plan, level).workers(threads).session()?;
        Ok(Self { name, plan, oath, session, known: None })
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
        Ok(Self { name: "clairvoyant".into(), known: Some(Known::of(truth)), ..ours })
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
        if self.known.is_some() { Kind::Limit } else { Kind::Subject }
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
        Ok(Frame { build: rendering.times.build, layers: Layers { ids, t, rgba: Some(rgba) } })
    }
}
