//! `cgt report`: everything the suite finds out, on one page that opens offline, with the data of each chapter beside it.

use super::verify::{all_there, judged, live, load};
use super::{ablate, bench, chart, claims, distinct, figures, files, stability};
use crate::args::{self, or_few};
use crate::environment::environment;
use crate::{Failure, progress, say};
use contract::Size;
use optimized::{Level, Plan};
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;
use verify::claims::claims as all_claims;
use verify::figures::alone;
use verify::figures::page::part as figure_part;
use verify::paper::claims as judge_claims;
use verify::paper::page::part as paper_part;
use verify::paper::record::{self, Record};
use verify::picture::{check_folder, write_atomically};
use verify::prove::prover::Finding;
use verify::prove::run::{Proofs, run as prove};
use verify::prove::solver::Solver;
use verify::report::{Absent, Module, Part, Report, SCHEMA_VERSION, overall, text, write};
use verify::seed::seed;
use verify::spu::curves::{Asked as Curves, POINTS, curves};
use verify::spu::data::{self, Report as Machine};
use verify::spu::page::part as spu_part;
use verify::subject::{Grid, NAIVE, NamedPlan, Subject};
use verify::{ablation, advice, prove as proofs};

/// Pixels where no size is asked for, and of a film.
const SIZE: [u32; 2] = [640, 360];
const FILM: [u32; 2] = [480, 270];
/// Stands for no film.
const NO_FILM: &str = "none";
/// Of so many blocks one is traced on the model of the paper's machine.
const SAMPLE: u32 = 16;

pub(crate) fn run(args: &args::Report) -> Result<ExitCode, Failure> {
    check_folder(&args.out)?;
    let names = or_few(&args.scenes);
    let level = Level::best()?;
    let size = match args.size {
        Some(size) => size,
        None => Size::new(SIZE[0], SIZE[1])?,
    };
    let view = args::View { size: Some(size), threads: args.threads, ..args::View::default() };
    let threads = view.threads();
    let module = args.live.as_deref().map(Module::read).transpose()?;
    all_there(&names, 0)?;
    if args.film != NO_FILM {
        load(&args.film, 0)?;
    }
    chapter("pictures");
    let (mut scenes, mut pictures) = (Vec::new(), Vec::new());
    let mut subjects = subjects(level);
    subjects.extend(args.own.tracers()?.into_iter().map(|own| Box::new(own) as Box<dyn Subject>));
    let subjects: Vec<&dyn Subject> = subjects.iter().map(AsRef::as_ref).collect();
    distinct(subjects.iter().map(|subject| subject.name()))?;
    for word in &names {
        let live = live(module.as_ref().filter(|_| scenes.is_empty()), word, &view)?;
        let (report, mut set) = judged(word, &view, &subjects, &[])?;
        set.live = live;
        scenes.push(report);
        pictures.push(set);
    }
    if args.film != NO_FILM {
        let frames = load(&args.film, 0)?.0.animation.frames().len();
        let two =
            [Grid::new(NamedPlan::Fast, level, false, None), Grid::new(NamedPlan::Paper, level, false, None)];
        let two: Vec<&dyn Subject> = two.iter().map(|subject| subject as &dyn Subject).collect();
        for frame in 0..frames {
            let view = args::View { size: Some(Size::new(FILM[0], FILM[1])?), frame, ..view.clone() };
            let (report, set) = judged(&args.film, &view, &two, &[])?;
            scenes.push(report);
            pictures.push(set);
        }
    }
    // The paper to the letter is here to be seen failing.
    let papers = scenes.iter_mut().flat_map(|scene| &mut scene.subjects);
    papers
        .filter(|subject| subject.name == NamedPlan::Paper.name())
        .for_each(|paper| paper.known_fault = true);
    let Chapters { parts, broken, mut absent } = chapters(args, &names, &view)?;
    // The same may be missing in more than one chapter.
    absent.dedup_by(|one, other| one.judge == other.judge);
    let report = Report {
        schema_version: SCHEMA_VERSION,
        title: "Sphere tracers, judged".into(),
        verdict: overall(&scenes, &broken, &absent),
        environment: environment(threads, &[level]),
        scenes,
        claims: all_claims(),
        broken,
        absent,
    };
    let paths = write(&args.out, &report, &pictures, &parts)?;
    say(&format!("{}report: {}\n", text(&report, std::io::stdout().is_terminal()), paths.html.display()))?;
    Ok(super::ending(report.verdict))
}

/// The naive tracers and all plans.
fn subjects(level: Level) -> Vec<Box<dyn Subject>> {
    let naive = NAIVE.into_iter().map(|naive| Box::new(naive) as Box<dyn Subject>);
    let plans = NamedPlan::ALL
        .into_iter()
        .map(|plan| Box::new(Grid::new(plan, level, false, None)) as Box<dyn Subject>);
    naive.chain(plans).collect()
}

/// What follows the pictures.
#[derive(Default)]
struct Chapters {
    parts: Vec<Part>,
    /// Who promised the truth and did not give it.
    broken: Vec<String>,
    /// Who could have spoken and did not.
    absent: Vec<Absent>,
}

/// What follows the pictures, and who broke a promise of the truth in it; the data of each chapter goes into the folder.
fn chapters(args: &args::Report, names: &[String], view: &args::View) -> Result<Chapters, Failure> {
    let folder = &args.out;
    // Times are those of one thread, which others on the machine disturb least.
    let view = &args::View { threads: 1, ..view.clone() };
    // Where no size is asked for, some chapters have their own.
    let asked = &args::View { size: args.size, ..view.clone() };
    files::folder(folder)?;
    let Chapters { mut parts, mut broken, mut absent } = Chapters::default();
    let wanted = |name: &str| !args.skip.iter().any(|skipped| skipped == name);
    let part = |anchor, title: &str, body| Part { anchor, title: title.into(), body };
    if wanted("methods") {
        chapter("speed against accuracy");
        let charted = chart::chart(&args::Chart {
            scenes: names.to_vec(),
            far: vec![1.0, 10.0, 100.0, 1000.0],
            rounds: args.rounds,
            sample: 8,
            level: None,
            out: folder.clone(),
            own: args.own.clone(),
            view: asked.clone(),
        })?;
        files::data("chart", folder, &charted, Some(charted.csv()?))?;
        chapter("where methods break");
        // Grids are turned up on the film's scene too.
        let film = Some(&args.film).filter(|film| *film != NO_FILM && !names.contains(film));
        let broken_at = stability::found(&args::Stability {
            scenes: names.iter().chain(film).cloned().collect(),
            only: Vec::new(),
            methods: Vec::new(),
            rays: args.rays,
            level: None,
            out: folder.clone(),
            own: args.own.clone(),
        })?;
        files::data("stability", folder, &broken_at, Some(broken_at.csv()?))?;
        broken.extend(charted.broken_promises().into_iter().chain(broken_at.broken_promises()));
        absent.extend(charted.absent.iter().cloned());
        let advice = advice::part(&advice::advice(&broken_at, &charted))?;
        parts.push(part("advice", "Which method for which scene", advice));
        parts.push(part("chart", "Speed against accuracy", verify::chart::page::part(&charted)?));
        parts.push(part("stability", "Where methods break", verify::stability::page::part(&broken_at)?));
    }
    if wanted("ablation") {
        chapter("what each choice buys");
        let ablated = ablate::found(&args::Ablate {
            scenes: names.to_vec(),
            rounds: args.rounds,
            sample: 16,
            level: None,
            out: folder.clone(),
            view: asked.clone(),
        })?;
        files::data("ablation", folder, &ablated, Some(ablated.csv()?))?;
        broken.extend(ablated.broken_promises());
        parts.push(part("ablation", "What each choice buys", ablation::page::part(&ablated)?));
    }
    let solvers = Solver::all();
    let proved = wanted("proofs").then(|| {
        chapter("proofs");
        let questions = Proofs::questions(false, |_| true);
        let tick = progress::bar("prove", "lemmas and kernels", u32::try_from(questions).unwrap_or(u32::MAX));
        prove(|_| true, false, &solvers, seed(), &*tick)
    });
    if wanted("paper") {
        chapter("the paper's claims");
        let said =
            proved.as_ref().map_or_else(|| claims::said(&solvers, seed()), |proved| proved.lemmas.clone());
        let (paper, machine) = paper(folder, names, &said, args.size, args.threads)?;
        parts.push(part("paper", "The paper's claims, one by one", paper));
        parts.push(part("spu", "The paper's machine", machine));
    }
    if wanted("figures") {
        chapter("the paper's figures");
        let drawn = figures::drawn(&args::Figures::of(&names[0], folder))?.1;
        for figure in &drawn {
            write_atomically(&folder.join(format!("{}.svg", figure.name)), alone(&figure.svg).as_bytes())?;
        }
        parts.push(part("figures", "The paper's four figures, drawn by the code", figure_part(&drawn)?));
    }
    if wanted("bench") {
        chapter("how fast");
        let benched =
            bench::measured(&args::Bench { rounds: Some(args.rounds), ..args::Bench::of(names, view) })?;
        files::data("bench", folder, &benched, None)?;
        broken.extend(benched.broken_promises());
        parts.push(part("bench", "How fast", verify::bench::page::part(&benched)?));
    }
    if solvers.is_empty() && (wanted("proofs") || wanted("paper")) {
        let why = "No solver was found; tests/fetch-solvers brings two.".into();
        absent.push(Absent { judge: "Proofs".into(), why, needed: false });
    }
    if let Some(proved) = proved {
        files::data("prove", folder, &proved, None)?;
        broken.extend(proved.wrong());
        parts.push(part("proofs", "Proved", proofs::page::part(&proved)?));
    }
    Ok(Chapters { parts, broken, absent })
}

/// The paper's claims on these scenes, and what a frame of them costs on its machine.
fn paper(
    folder: &Path,
    names: &[String],
    said: &[Finding],
    size: Option<Size>,
    threads: u16,
) -> Result<(String, String), Failure> {
    // At the paper's own size, if none is asked for.
    let view = args::View { size, threads, ..args::View::default() };
    let asked = args::Claims { scenes: names.to_vec(), sample: SAMPLE, json: None, markdown: None, view };
    let mut scenes = Vec::new();
    for word in names {
        let (loaded, scene) = load(word, 0)?;
        scenes.push((word.clone(), scene, loaded.camera(&asked.view.framing())?));
    }
    let (looked, seed) = (claims::all(&asked, &scenes)?, seed());
    let mut environment = environment(asked.view.threads(), &[]);
    environment.seed = Some(seed);
    let found = Record {
        schema_version: record::SCHEMA_VERSION,
        kind: "claims".into(),
        environment: environment.clone(),
        seed,
        size: [scenes[0].2.size().width(), scenes[0].2.size().height()],
        sample: SAMPLE,
        scenes: names.to_vec(),
        claims: judge_claims(&looked, said, seed),
    };
    files::data("claims", folder, &found, None)?;
    chapter("the paper's machine");
    let (name, scene, camera) = &scenes[0];
    let framing = asked.view.framing();
    let over =
        Curves { plan: Plan::paper(), every: SAMPLE, framing: &framing, name, frame: 0, scene, camera };
    let tick = progress::bar("curves", "on the SPU model", POINTS);
    let machine = Machine {
        schema_version: data::SCHEMA_VERSION,
        kind: "spu",
        environment,
        surveys: looked.into_iter().map(|looked| looked.survey).collect(),
        curves: curves(&over, &*tick)?.into(),
        host: None,
    };
    files::data("spu", folder, &machine, None)?;
    Ok((paper_part(&found)?, spu_part(&machine.surveys, &machine.curves, None)?))
}

/// What is being done goes to standard error.
fn chapter(name: &str) {
    _ = writeln!(std::io::stderr(), "== {name}");
}
