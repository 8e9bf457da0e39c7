//! Properties: cases drawn by proptest, each held to what must be true of it.
//!
//! Two moods. *Certain* ([`Property::Certain`]): integers, where answers are known without any tracer and all tracers must have them to the
//! last bit. *Anything*: directed recipes ([`recipe`]) and any finite f32 judged against the exact picture, and
//! [relations](Property::Relations) of a tracer with itself. A run gives what was at stake ([`stakes`]), and says nothing if that was too little.
//!
//! What fails is made simpler twice: its recipe by proptest, its numbers by [`crate::case::shrink`]; then it is kept as a case.

pub mod lattice;
pub mod laws;
pub mod place;
pub mod recipe;
pub mod relations;
pub mod stakes;

use crate::case::folder::{folder, keep};
use crate::case::shrink::shrink;
use crate::case::{Asked, Case, worst};
use crate::seed::generator;
use crate::subject::{NAIVE_ALL, Promise};
use crate::verdict::Verdict;
use contract::{Camera, Image};
use lattice::{Lattice, lattice};
use optimized::crew::Crew;
use optimized::event::Events;
use optimized::grid::Memory;
use optimized::host::Scalar;
use optimized::plan::Arithmetic;
use optimized::seen::Seen;
use optimized::sphere::Form;
use optimized::{Level, Plan, Tracer};
use proptest::prelude::*;
use proptest::strategy::BoxedStrategy;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};
use rand::RngExt;
use rayon::prelude::*;
use recipe::{ARITHMETICS, Recipe};
use reference::Arithmetic as Naively;
use relations::RELATIONS;
use serde::{Deserialize, Serialize};
use stakes::Stakes;
use std::cell::RefCell;
use std::fmt::Debug;

/// Cases that one runner draws.
pub const CHUNK: u64 = 16;
/// Arithmetics of which relations are stated.
const RELATED: &[Arithmetic] = ARITHMETICS.split_at(3).0;
/// Questions that shrinking may ask.
const QUESTIONS: u32 = 4_000;

/// What fails, and the case that shows it.
#[derive(Clone, Debug)]
pub struct Failure {
    /// What is wrong.
    pub message: String,
    /// The case.
    pub case: Box<Case>,
}

impl Failure {
    fn new(message: String, case: Case) -> Self {
        Self { message, case: Box::new(case) }
    }
}

/// Draws a chunk of cases and holds each to a property: what was at stake until the first failure, which proptest has made simpler.
fn chunk<T: Clone + Debug>(
    seed: u64,
    chunk: u64,
    strategy: &BoxedStrategy<T>,
    check: impl Fn(&T) -> Result<Stakes, Failure>,
) -> (Stakes, Option<Failure>) {
    let config = Config {
        cases: u32::try_from(CHUNK).expect("small"),
        failure_persistence: None,
        max_shrink_iters: 300,
        ..Config::default()
    };
    let bytes: [u8; 32] = generator(seed, chunk).random();
    let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &bytes));
    let (stakes, failure) = (RefCell::new(Stakes::default()), RefCell::new(None));
    let outcome = runner.run(strategy, |drawn| match check(&drawn) {
        Ok(found) => {
            // What is tried while it is made simpler is not counted.
            if failure.borrow().is_none() {
                let sum = stakes.borrow().clone().and(&found);
                stakes.replace(sum);
            }
            Ok(())
        }
        Err(failed) => {
            let message = failed.message.clone();
            failure.replace(Some(failed));
            Err(TestCaseError::fail(message))
        }
    });
    let failure = match outcome {
        Ok(()) => None,
        // The last that failed is the simplest, unless what failed is proptest itself, or a panic.
        Err(TestError::Fail(why, drawn)) => Some(failure.into_inner().unwrap_or_else(|| {
            panic!("{why}: {drawn:?}");
        })),
        Err(TestError::Abort(why)) => panic!("nothing could be drawn: {why}"),
    };
    (stakes.into_inner(), failure)
}

/// A property of whatever is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Property {
    /// What is known of lattices ([`Lattice`]), by every tracer: the naive ones in each of their arithmetics, and the grid tracer with a
    /// drawn plan in those that have the answer.
    Certain,
    /// Directed recipes, by any plan, level, number of workers and arithmetic, and naive tracers: the judge must find no promise broken.
    Pictures,
    /// The same with hundreds of spheres, by exact plans: what a tile does only where one round does not hold its candidates.
    Swarms,
    /// Any finite numbers for spheres and camera.
    Wild,
    /// Metamorphic relations of [`relations::Relation`], of exact plans mostly.
    Relations,
}

impl Property {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Certain, Self::Pictures, Self::Swarms, Self::Wild, Self::Relations];

    /// Its name.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Certain => "certain",
            Self::Pictures => "pictures",
            Self::Swarms => "swarms",
            Self::Wild => "wild",
            Self::Relations => "relations",
        }
    }

    /// Draws so many cases and holds each to it; what was at stake.
    ///
    /// # Errors
    /// The account of the first failure, as [`told`] gives it.
    pub fn hold(self, seed: u64, cases: u64) -> Result<Stakes, String> {
        let chunks = (0..cases.div_ceil(CHUNK)).into_par_iter().map(|chunk| match self.drawn(seed, chunk) {
            (stakes, None) => Ok(stakes),
            (_, Some(failure)) => Err(failure),
        });
        let stakes = chunks.try_reduce(Stakes::default, |a, b| Ok(a.and(&b)));
        stakes.map_err(|failure| told(self.word(), &failure, &|case| self.fails(case)))
    }

    /// The [`CHUNK`] cases of a seed's chunk: what was at stake, and the first that fails.
    #[must_use]
    pub fn drawn(self, seed: u64, chunk: u64) -> (Stakes, Option<Failure>) {
        let of_recipe = |check: &dyn Fn(&Case) -> Result<Stakes, Failure>,
                         strategy: BoxedStrategy<Recipe>| {
            self::chunk(seed, chunk, &strategy, |recipe| {
                place::case(recipe).map_or(Ok(none()), |case| check(&case))
            })
        };
        match self {
            Self::Certain => {
                let plans = recipe::plan(&ARITHMETICS[..1]);
                let strategy = (lattice(), plans, prop::sample::select(Level::available()), 1u8..=3).boxed();
                self::chunk(seed, chunk, &strategy, certain)
            }
            Self::Pictures => of_recipe(&judged, recipe::recipe(recipe::ball(), 14, 2, &ARITHMETICS).boxed()),
            Self::Swarms => {
                of_recipe(&judged, recipe::recipe(recipe::ball(), 4, 100, &ARITHMETICS[..1]).boxed())
            }
            Self::Wild => {
                let vector = || any::<[u32; 3]>().prop_map(|v| v.map(finite));
                let camera = [vector(), vector(), vector(), vector()];
                let strategy = (recipe::recipe(recipe::wild(), 6, 0, &ARITHMETICS), camera).boxed();
                self::chunk(seed, chunk, &strategy, wild)
            }
            Self::Relations => of_recipe(&related, recipe::recipe(recipe::ball(), 10, 2, RELATED).boxed()),
        }
    }

    /// Whether a case breaks it, as a failure of it is made smaller.
    #[must_use]
    pub fn fails(self, case: &Case) -> bool {
        match self {
            // What integers know of a lattice is lost once it is another scene.
            Self::Certain => case.judge().is_ok_and(|judged| worst(&judged) == Verdict::Wrong),
            Self::Pictures | Self::Swarms | Self::Wild => judged(case).is_err(),
            Self::Relations => related(case).is_err(),
        }
    }
}

/// Shrinks a failure, keeps it in [`folder()`], and says what is wrong, how it looks and how to run it again.
///
/// # Panics
/// Never: a case that cannot be kept is told of.
#[must_use]
pub fn told(property: &str, failure: &Failure, fails: &dyn Fn(&Case) -> bool) -> String {
    let small = shrink(&failure.case, QUESTIONS, fails);
    let spheres = small.frames.frames()[0].spheres().len();
    let size = small.camera.size();
    let name = format!("{property}-{:08x}", crc(small.to_json().as_bytes()));
    // As it was drawn, the picture shows more than its one pixel will.
    let drawn = Case { why: failure.message.clone(), ..(*failure.case).clone() };
    let drawn = keep(&drawn, &folder(), &format!("{name}-as-drawn"));
    let small = Case { expected: small.asked.promise().worst(), why: failure.message.clone(), ..small };
    let kept = match drawn.and_then(|_| keep(&small, &folder(), &name)) {
        Ok(kept) => format!("{}\n\nAgain: {}", kept.account, kept.command),
        Err(error) => format!("The case was not kept: {error}."),
    };
    format!(
        "{}\nSmallest found: {spheres} spheres, {}x{} pixels.\n{kept}",
        failure.message,
        size.width(),
        size.height()
    )
}

/// Tells cases apart in names of files.
fn crc(bytes: &[u8]) -> u32 {
    let mut crc = flate2::Crc::new();
    crc.update(bytes);
    crc.sum()
}

/// Holds a case to the verdict of the judge on each of its frames; what was at stake.
///
/// # Errors
/// What the judge says of it.
pub fn judged(case: &Case) -> Result<Stakes, Failure> {
    let mut stakes = Stakes::default();
    let judged = match case.judge() {
        Ok(judged) => judged,
        Err(error) if case.may_fail_with(&error) => {
            stakes.add("frames refused", 1);
            return Ok(stakes);
        }
        Err(error) => return Err(Failure::new(error.to_string(), case.clone())),
    };
    for (frame, judged) in judged.iter().enumerate() {
        let verdict = judged.judgement.verdict;
        if matches!(verdict, Verdict::Wrong | Verdict::NotJudged) {
            let message =
                format!("frame {frame} by {}: {verdict:?}. {}", case.asked, judged.judgement.because);
            return Err(Failure::new(message, Case { pixel: judged.wrong, ..case.clone() }));
        }
        stakes.add(
            match verdict {
                Verdict::Equal => "frames equal to the truth",
                Verdict::WithinBound => "frames within the bound of rounding",
                _ => "frames beyond a form's range",
            },
            1,
        );
        let scene = &case.frames.frames()[frame];
        stakes.add_frame(scene, &case.camera, &judged.promised);
        stakes.bin("spheres of a scene", scene.spheres().len() as u64);
        if let Some(comparison) = &judged.judgement.comparison {
            stakes.bin("largest error of t in a frame, ulp", comparison.t_ulp.max);
        }
    }
    if let Asked::Grid { plan, level, workers } = case.asked {
        let scene = &case.frames.frames()[0];
        let rendering = Tracer::new(plan, level).workers(workers.into()).render(scene, &case.camera);
        if let Ok(rendering) = rendering {
            stakes.add_tracer(&rendering.counts, &rendering.events);
        }
        let (mut memory, mut events) = (Memory::default(), Events::default());
        let seen = Seen::new(Scalar, plan, scene, &case.camera, &mut memory, &mut events, &Crew::alone());
        if let Some(grid) = seen.ok().and_then(|seen| seen.grid) {
            stakes.add_grid(scene, &grid);
        }
    }
    Ok(stakes)
}

fn wild((recipe, [eye, corner, du, dv]): &(Recipe, [[f32; 3]; 4])) -> Result<Stakes, Failure> {
    let Some(mut case) = place::case(recipe) else { return Ok(none()) };
    // Mostly the recipe's camera sees more of them.
    if let Ok(camera) = Camera::new(*eye, *corner, *du, *dv, case.camera.size()) {
        case.camera = camera;
    }
    judged(&case)
}

fn none() -> Stakes {
    let mut stakes = Stakes::default();
    stakes.add("recipes that give no case", 1);
    stakes
}

/// The finite number nearest to those bits in spirit: an exponent of all ones loses its highest.
fn finite(bits: u32) -> f32 {
    f32::from_bits(if bits >> 23 & 0xff == 0xff { bits ^ 1 << 30 } else { bits })
}

/// Whether relations are stated of a tracer: of the grid tracer in the arithmetics that [`Property::Relations`] draws, and of who promises the truth.
#[must_use]
pub fn has_relations(asked: &Asked) -> bool {
    match asked {
        Asked::Grid { plan, .. } => RELATED.contains(&plan.arithmetic),
        Asked::Naive(_) | Asked::Foreign { .. } => asked.promise() == Promise::Exact,
    }
}

/// Holds a case to all relations. What they draw, as an order of spheres, is a function of the case, so that it can be run again.
///
/// # Errors
/// The first that is broken.
pub fn related(case: &Case) -> Result<Stakes, Failure> {
    let mut stakes = Stakes::default();
    let mut rng = generator(crc(case.to_json().as_bytes()).into(), 0);
    for relation in RELATIONS {
        let failed = |message| Failure::new(format!("{message}; by {}", case.asked), case.clone());
        stakes.add(relation.name(), relation.hold(case, &mut rng).map_err(failed)?);
    }
    Ok(stakes)
}

fn certain((lattice, plan, level, workers): &(Lattice, Plan, Level, u8)) -> Result<Stakes, Failure> {
    let grid = |arithmetic| {
        let blocks = if arithmetic == Arithmetic::Certified {
            *plan
        } else {
            Plan { arithmetic, packet: optimized::plan::Packet::Block, ..*plan }
        };
        Asked::Grid { plan: blocks, level: *level, workers: *workers }
    };
    all_know(
        lattice,
        &[
            (Form::Textbook, true, grid(Arithmetic::Rounded(Form::Textbook))),
            (Form::Perpendicular, true, grid(Arithmetic::Rounded(Form::Perpendicular))),
            (Form::Textbook, false, grid(Arithmetic::Certified)),
        ],
    )
}

/// Every tracer of a lattice: in which form it computes, and whether it is held to what is known in that form only.
fn all_know(lattice: &Lattice, grids: &[(Form, bool, Asked)]) -> Result<Stakes, Failure> {
    let mut stakes = Stakes::default();
    let Some(case) = lattice.case(&grids[0].2) else { return Ok(none()) };
    let pixels: Vec<[u32; 2]> = {
        let (width, height) = (case.camera.size().width(), case.camera.size().height());
        (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).collect()
    };
    let known: Vec<_> = pixels.iter().map(|pixel| lattice.known(&case.camera, *pixel)).collect();
    for known in known.iter().flatten() {
        stakes.add("rays whose answer is known", 1);
        stakes.add("known hits", u64::from(known.answer.is_some()));
        stakes.add("known in the textbook form", u64::from(known.textbook && known.answer.is_some()));
        stakes
            .add("known in the perpendicular form", u64::from(known.perpendicular && known.answer.is_some()));
        stakes.add("known ties", u64::from(known.tie));
        stakes.add("known tangents", u64::from(known.tangent));
        stakes.add("known from inside or on a surface", u64::from(known.inside && known.answer.is_some()));
    }
    let hold = |asked: &Asked, name: &str, image: &Image, form: Option<Form>| {
        for ((i, pixel), known) in pixels.iter().enumerate().zip(&known) {
            let Some(known) = known else { continue };
            let is_known = match form {
                None => true,
                Some(Form::Textbook) => known.textbook,
                Some(Form::Perpendicular) => known.perpendicular,
            };
            let came = (image.ids[i], image.t[i].to_bits());
            if is_known && came != known.id_and_bits() {
                let message = format!(
                    "{name}: pixel {pixel:?} is id {} at t {:?} (0x{:08x}); integers know {:?}",
                    came.0, image.t[i], came.1, known.answer,
                );
                let asked = asked.clone();
                return Err(Failure::new(message, Case { asked, pixel: Some(*pixel), ..case.clone() }));
            }
        }
        Ok(())
    };
    let scene = &case.frames.frames()[0];
    for (arithmetic, form) in [
        (Naively::Exact, None),
        (Naively::ExactUnfiltered, None),
        (Naively::F64, None),
        (Naively::F32Textbook, Some(Form::Textbook)),
        (Naively::F32Perpendicular, Some(Form::Perpendicular)),
    ] {
        let image = reference::Tracer::new(arithmetic).threads(1).render(scene, &case.camera);
        let rendering = image.map_err(|error| Failure::new(error.to_string(), case.clone()))?;
        let naive = NAIVE_ALL.into_iter().find(|naive| naive.0.naive() == arithmetic).unwrap_or(NAIVE_ALL[0]);
        hold(&Asked::Naive(naive), &format!("reference, {arithmetic:?}"), &rendering.image, form)?;
        stakes.add("pictures of the reference", 1);
    }
    for (form, own, asked) in grids {
        match lattice.case(asked).map(|case| case.pictures()) {
            Some(Ok(images)) => {
                hold(asked, &asked.to_string(), &images[0], own.then_some(*form))?;
                stakes.add("pictures of the grid tracer", 1);
            }
            Some(Err(error)) if (Case { asked: asked.clone(), ..case.clone() }).may_fail_with(&error) => {
                stakes.add("frames refused", 1);
            }
            Some(Err(error)) => return Err(Failure::new(error.to_string(), case.clone())),
            None => {}
        }
    }
    Ok(stakes)
}
