//! Every way there is here to answer the rays of a camera: the reference's loops, plans of the grid tracer, Embree at each instruction set
//! and width, the tracers of other people. What charts and maps compare are these.
//!
//! In: a level and a number of threads. Out: [`Method`]s, each of which makes a [`Contestant`] for a scene and a camera. What is not
//! there, or not built in, is [`Absent`] with its reason, never left out silently.

use crate::bench::contestant::Contestant;
use crate::bench::naive::Naive;
use crate::bench::ours::{Ours, chosen};
use crate::report::Absent;
use crate::subject::{NamedPlan, Rounding, SubjectError};
use contract::{Camera, Scene};
use optimized::plan::{Packet, Resolution};
use optimized::{Form, Level, Plan};
use serde::Serialize;

/// What decides a method's answers. Methods of a family are drawn alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    /// Real arithmetic: bounds, and integers where these leave something open.
    Exact,
    /// b² − ac in f64.
    F64,
    /// b² − ac in f32.
    Textbook,
    /// The distance of the centre from the ray in f32.
    Perpendicular,
    /// f32 as the SPU cuts it off.
    Spu,
    /// The paper's plan, whatever its arithmetic.
    Paper,
    /// Embree.
    Embree,
    /// A tracer of other people.
    Peer,
    /// The user's own, a program ([`crate::foreign`]).
    Foreign,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Exact,
        Self::F64,
        Self::Textbook,
        Self::Perpendicular,
        Self::Spu,
        Self::Paper,
        Self::Embree,
        Self::Peer,
        Self::Foreign,
    ];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::F64 => "f64",
            Self::Textbook => "textbook, f32",
            Self::Perpendicular => "perpendicular, f32",
            Self::Spu => "SPU, cut off",
            Self::Paper => "the paper's plan",
            Self::Embree => "Embree",
            Self::Peer => "other crates",
            Self::Foreign => "your own",
        }
    }

    /// Its class in a page's style.
    pub(crate) fn class(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::F64 => "double",
            Self::Textbook => "textbook",
            Self::Perpendicular => "perpendicular",
            Self::Spu => "cut",
            Self::Paper => "paper",
            Self::Embree => "embree",
            Self::Peer => "peer",
            Self::Foreign => "foreign",
        }
    }
}

/// What makes a contestant of a method.
type Maker = Box<dyn Fn(&Scene, &Camera) -> Result<Box<dyn Contestant>, SubjectError> + Send + Sync>;

/// A way to answer rays.
pub struct Method {
    /// Short and unique.
    pub name: String,
    /// What decides its answers.
    pub family: Family,
    /// Whether it promises the truth, bit for bit: all of [`Family::Exact`] do, and a program of which it was said.
    pub exact: bool,
    /// The plan as the SPU model can run it, of those that have one.
    pub on_spu: Option<Plan>,
    maker: Maker,
}

impl Method {
    /// Ready for a scene and a camera.
    ///
    /// # Errors
    /// Whatever keeps it from beginning.
    pub fn contestant(&self, scene: &Scene, camera: &Camera) -> Result<Box<dyn Contestant>, SubjectError> {
        (self.maker)(scene, camera)
    }

    /// One that is made for a scene and a camera when it is asked.
    pub fn made(
        name: impl Into<String>,
        family: Family,
        maker: impl Fn(&Scene, &Camera) -> Result<Box<dyn Contestant>, SubjectError> + Send + Sync + 'static,
    ) -> Self {
        let exact = family == Family::Exact;
        Self { name: name.into(), family, exact, on_spu: None, maker: Box::new(maker) }
    }

    /// The reference in an arithmetic.
    #[must_use]
    pub fn naive(name: &'static str, family: Family, rounding: Option<Rounding>, threads: usize) -> Self {
        Self::made(name, family, move |_, _| Ok(Box::new(Naive::new(name, rounding, threads)?)))
    }

    /// The grid tracer with a plan that may depend on the scene.
    pub fn grid(
        name: impl Into<String>,
        family: Family,
        plan: impl Fn(&Scene) -> Plan + Send + Sync + 'static,
        level: Level,
        threads: usize,
    ) -> Self {
        let name = name.into();
        let own = name.clone();
        Self::made(name, family, move |scene, _| {
            Ok(Box::new(Ours::of(own.clone(), plan(scene), level, threads)?))
        })
    }

    /// The same with a plan that the SPU model can run.
    #[must_use]
    pub fn with_spu(self, plan: Plan) -> Self {
        Self { on_spu: Some(plan), ..self }
    }
}

/// The naive tracers: name, family, rounding.
const NAIVE: [(&str, Family, Option<Rounding>); 6] = [
    ("naive-exact", Family::Exact, None),
    ("naive-f64", Family::F64, Some(Rounding::TextbookF64)),
    ("naive-f32-textbook", Family::Textbook, Some(Rounding::TextbookF32)),
    ("naive-f32-perpendicular", Family::Perpendicular, Some(Rounding::PerpendicularF32)),
    ("naive-spu-textbook", Family::Spu, Some(Rounding::TextbookSpu)),
    ("naive-spu-perpendicular", Family::Spu, Some(Rounding::PerpendicularSpu)),
];

/// The reference's loops.
#[must_use]
pub fn naive(threads: usize) -> Vec<Method> {
    NAIVE.map(|(name, family, rounding)| Method::naive(name, family, rounding, threads)).into()
}

/// The plan `safe` in another form, or in the SPU's arithmetic.
fn safe(arithmetic: optimized::plan::Arithmetic) -> Plan {
    Plan { arithmetic, ..Plan::safe() }
}

/// The plans that have a name, and what lies between them: the exact one in the paper's blocks, the safe one in each arithmetic.
#[must_use]
pub fn plans(level: Level, threads: usize) -> Vec<Method> {
    use optimized::plan::Arithmetic::{Rounded, Spu};
    let fixed = |name, family, plan: Plan| Method::grid(name, family, move |_| plan, level, threads);
    let blocks = Plan { packet: Packet::Block, ..Plan::fast() };
    vec![
        Method::grid("fast", Family::Exact, |scene| chosen(NamedPlan::Fast, scene).plan, level, threads),
        fixed("fast-blocks", Family::Exact, blocks),
        fixed("safe", Family::Perpendicular, Plan::safe()).with_spu(Plan::safe()),
        fixed("safe-textbook", Family::Textbook, safe(Rounded(Form::Textbook)))
            .with_spu(safe(Rounded(Form::Textbook))),
        fixed("safe-spu-textbook", Family::Spu, safe(Spu(Form::Textbook))),
        fixed("safe-spu-perpendicular", Family::Spu, safe(Spu(Form::Perpendicular))),
        fixed("paper", Family::Paper, Plan::paper()).with_spu(Plan::paper()),
    ]
}

/// The exact plan at every level below.
#[must_use]
pub fn levels(best: Level, threads: usize) -> Vec<Method> {
    let others = Level::available().into_iter().filter(|level| level.name() != best.name());
    let at = |level: Level| {
        let plan = |scene: &Scene| chosen(NamedPlan::Fast, scene).plan;
        Method::grid(format!("fast@{level}"), Family::Exact, plan, level, threads)
    };
    others.map(at).collect()
}

/// A plan with so many cells on each axis.
#[must_use]
pub fn with_cells(plan: Plan, cells: u8) -> Plan {
    Plan { resolution: Resolution::Fixed(cells), ..plan }
}

/// Embree, one ray and sixteen at a time, or at each width and instruction set; the other crates. `absent` learns who is missing.
#[must_use]
pub fn outsiders(every: bool, level: Level, threads: usize, absent: &mut Vec<Absent>) -> Vec<Method> {
    let mut methods = Vec::new();
    match embree(every, level, threads) {
        Ok(ways) => methods.extend(ways),
        Err(why) => absent.push(Absent { judge: "Embree".into(), why, needed: false }),
    }
    match peers(threads) {
        Ok(crates) => methods.extend(crates),
        Err(why) => absent.push(Absent { judge: "bvh, parry3d".into(), why, needed: false }),
    }
    methods
}

#[cfg(feature = "embree")]
fn embree(every: bool, level: Level, threads: usize) -> Result<Vec<Method>, String> {
    use crate::bench::embree::Entrant;
    use crate::embree::{Build, Device, Isa, Mode, Width};
    let own = |isa: &Isa| isa.name() == level.name();
    let isas = Isa::available().into_iter().filter(|isa| every || own(isa));
    let mut methods = Vec::new();
    for isa in isas {
        let device =
            Device::new(isa, threads).map_err(|error| format!("It is there and cannot be used: {error}."))?;
        for width in
            Width::ALL.into_iter().filter(|width| every || [Width::One, Width::Sixteen].contains(width))
        {
            let mode = Mode { build: Build::Plain, width, coherent: width != Width::One };
            let name = format!("embree-{width}@{isa}");
            let (device, own) = (device.clone(), name.clone());
            methods.push(Method::made(name, Family::Embree, move |_, camera| {
                Ok(Box::new(Entrant::named(own.clone(), &device, mode, camera, threads)))
            }));
        }
    }
    Ok(methods)
}

#[cfg(not(feature = "embree"))]
fn embree(_: bool, _: Level, _: usize) -> Result<Vec<Method>, String> {
    Err("This program was built without it; tests/with-embree builds it with.".into())
}

#[cfg(feature = "peers")]
#[allow(clippy::unnecessary_wraps, reason = "without the feature there is an error")]
fn peers(threads: usize) -> Result<Vec<Method>, String> {
    use crate::bench::outsiders::Outsider;
    let of = |peer: Outsider| {
        Method::made(peer.name(), Family::Peer, move |_, camera| {
            Ok(crate::bench::peers::entrant(peer, camera, threads))
        })
    };
    Ok(vec![of(Outsider::Bvh), of(Outsider::Parry3d)])
}

#[cfg(not(feature = "peers"))]
fn peers(_: usize) -> Result<Vec<Method>, String> {
    Err("This program was built without them; the feature `peers` builds them in.".into())
}

/// Those whose breakdown is looked for: each form, the plans with so many cells on each axis if that is given, Embree and the other crates.
#[must_use]
pub fn swept(cells: Option<u8>, level: Level, absent: &mut Vec<Absent>) -> Vec<Method> {
    let mut methods = naive(1);
    // Of the truth itself nothing is to be seen, and the SPU's is had faster below.
    methods.retain(|method| ![Family::Exact, Family::Spu].contains(&method.family));
    let of = |name, family, plan: Plan| {
        let plan = cells.map_or(plan, |cells| with_cells(plan, cells));
        Method::grid(name, family, move |_| plan, level, 1)
    };
    use optimized::plan::Arithmetic::Spu;
    methods.push(of("safe", Family::Perpendicular, Plan::safe()));
    methods.push(of("safe-spu-textbook", Family::Spu, safe(Spu(Form::Textbook))));
    methods.push(of("safe-spu-perpendicular", Family::Spu, safe(Spu(Form::Perpendicular))));
    methods.push(of("paper", Family::Paper, Plan::paper()));
    methods.extend(outsiders(false, level, 1, absent));
    methods.push(of("fast", Family::Exact, Plan::fast()));
    methods
}

/// Those of a chart: loops, plans, levels, Embree at each width and instruction set, other crates. The reference's SPU is left out: it has
/// the bits of `safe-spu-…`, by integers, a thousand times slower.
#[must_use]
pub fn charted(level: Level, threads: usize, absent: &mut Vec<Absent>) -> Vec<Method> {
    let mut methods = naive(threads);
    methods.retain(|method| method.family != Family::Spu);
    methods.extend(plans(level, threads));
    methods.extend(levels(level, threads));
    methods.extend(outsiders(true, level, threads, absent));
    methods
}
