//! `cgt verify`: scenes in, verdicts on the terminal and a report folder out.

use super::distinct;
use crate::args::{EMBREE, Verify, View};
use crate::environment::{environment, quoted};
use crate::{Failure, progress, say};
use contract::{Animation, Scene, Size};
use optimized::Level;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;
use verify::case::folder::Kept;
use verify::case::shrink::shrink;
use verify::case::{self, Case, worst};
use verify::claims::claims;
use verify::judge::outside::Witness;
use verify::picture::check_folder;
use verify::report::{
    Absent, Live, Module, Report, SCHEMA_VERSION, ScenePictures, SceneReport, overall, text, write,
};
use verify::run::{Frame, run};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::scenes::read::Loaded;
use verify::subject::{Grid, NAIVE, NamedPlan, Subject};
use verify::verdict::Verdict;

pub(crate) fn verify(args: &Verify) -> Result<ExitCode, Failure> {
    let levels = levels(args)?;
    let owned = subjects(args, &levels)?;
    let subjects: Vec<&dyn Subject> = owned.iter().map(AsRef::as_ref).collect();
    distinct(subjects.iter().map(|subject| subject.name()))?;
    let (judges, absent) = outside(args);
    let witnesses: Vec<&dyn Witness> = judges.iter().map(AsRef::as_ref).collect();
    check_folder(&args.out)?;
    let module = args.live.as_deref().map(Module::read).transpose()?;
    let (mut scenes, mut pictures, mut kept) = (Vec::new(), Vec::new(), Vec::new());
    all_there(&args.scenes, args.frames.as_ref().map_or(args.view.frame, |frames| frames.end - 1))?;
    for word in &args.scenes {
        for frame in args.frames.clone().unwrap_or(args.view.frame..args.view.frame + 1) {
            let view = View { frame, ..args.view.clone() };
            let live = live(module.as_ref().filter(|_| scenes.is_empty()), word, &view)?;
            let (report, mut set) = judged(word, &view, &subjects, &witnesses)?;
            set.live = live;
            if let Some(folder) = &args.keep {
                keep(word, &view, &subjects, &report, folder, &mut kept)?;
            }
            scenes.push(report);
            pictures.push(set);
        }
    }
    let report = Report {
        schema_version: SCHEMA_VERSION,
        title: format!("Verdict on {}", args.scenes.join(", ")),
        verdict: overall(&scenes, &[], &absent),
        environment: environment(args.view.threads(), &levels),
        scenes,
        claims: claims(),
        broken: Vec::new(),
        absent,
    };
    let paths = write(&args.out, &report, &pictures, &[])?;
    let verdict = text(&report, std::io::stdout().is_terminal());
    say(&format!("{verdict}report: {}\n", paths.html.display()))?;
    for (_, kept) in kept {
        say(&format!("kept: {}\n", kept.command))?;
    }
    Ok(super::ending(report.verdict))
}

/// Questions that making a case smaller may ask.
pub(crate) const QUESTIONS: u32 = 5_000;

/// Judges a frame of a scene.
pub(crate) fn judged(
    word: &str,
    view: &View,
    subjects: &[&dyn Subject],
    witnesses: &[&dyn Witness],
) -> Result<(SceneReport, ScenePictures), Failure> {
    let (loaded, scene) = load(word, view.frame)?;
    warn(&loaded);
    let (description, provenance) = about(word);
    let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    let frame = Frame {
        name: word,
        description: &description,
        provenance: &provenance,
        scene: &scene,
        camera: &loaded.camera(&view.framing())?,
        frame: [view.frame, loaded.animation.frames().len()],
        warnings: &warnings,
        replay: &format!("cgt verify {}{}", quoted(word), view.words()),
    };
    let named = if view.frame == 0 { word.to_owned() } else { format!("{word}, frame {}", view.frame) };
    let progress = |what: &str, rows| progress::bar(&named, what, rows);
    Ok(run(&frame, subjects, witnesses, view.threads(), &progress)?)
}

/// Of each tracer that is wrong for the first time the smallest case of it.
fn keep(
    word: &str,
    view: &View,
    subjects: &[&dyn Subject],
    report: &SceneReport,
    folder: &Path,
    kept: &mut Vec<(String, Kept)>,
) -> Result<(), Failure> {
    for (subject, found) in subjects.iter().zip(&report.subjects) {
        let new = kept.iter().all(|(name, _)| name != subject.name());
        let Some(asked) = subject.asked(view.threads()) else { continue };
        if found.verdict != Verdict::Wrong || !new {
            continue;
        }
        let (loaded, scene) = load(word, view.frame)?;
        let case = Case {
            frames: Animation::new(vec![scene])?,
            camera: loaded.camera(&view.framing())?,
            asked,
            expected: Verdict::Wrong,
            pixel: None,
            why: format!("{} on {word}: {}", subject.name(), found.because),
        };
        let tick = progress::bar(subject.name(), "questions to make the case smaller", QUESTIONS);
        let smaller = shrink(&case, QUESTIONS, &|case| {
            tick();
            case.judge().is_ok_and(|judged| worst(&judged) == Verdict::Wrong)
        });
        drop(tick);
        // The file is what will be judged from now on, and is to be kept as a promise, not as a fault.
        let case = Case { expected: smaller.asked.promise().worst(), ..smaller };
        kept.push((subject.name().into(), case::folder::keep(&case, folder, subject.name())?));
    }
    Ok(())
}

/// A live view of a frame, if there is a module for one.
pub(crate) fn live(module: Option<&Module>, word: &str, view: &View) -> Result<Option<Live>, Failure> {
    let Some(module) = module else { return Ok(None) };
    let (loaded, scene) = load(word, view.frame)?;
    Ok(Some(Live::new(module, &scene, &loaded.camera(&view.framing())?)?))
}

/// The outside judges that were asked for and are there, and those that will not speak.
fn outside(args: &Verify) -> (Vec<Box<dyn Witness>>, Vec<Absent>) {
    let needed = args.judges.iter().any(|judge| judge == EMBREE);
    let absent = |why: String| vec![Absent { judge: "Embree".into(), why, needed }];
    if !needed {
        return (Vec::new(), absent("It was not asked; --judges embree asks it.".into()));
    }
    match embree() {
        Ok(witness) => (vec![witness], Vec::new()),
        Err(why) => (Vec::new(), absent(why)),
    }
}

#[cfg(feature = "embree")]
fn embree() -> Result<Box<dyn Witness>, String> {
    match verify::embree::Embree::new() {
        Ok(embree) => Ok(Box::new(embree)),
        Err(error) => Err(format!("It is there and cannot be used: {error}.")),
    }
}

#[cfg(not(feature = "embree"))]
fn embree() -> Result<Box<dyn Witness>, String> {
    Err("This program was built without it; tests/with-embree builds it with.".into())
}

/// The levels at which the grid tracer is judged.
fn levels(args: &Verify) -> Result<Vec<Level>, Failure> {
    Ok(match args.level.as_deref() {
        None => vec![Level::best()?],
        Some("all") => Level::available(),
        Some(name) => vec![Level::named(name)?],
    })
}

/// The naive tracers and the plans `fast` and `safe`, or those that were asked for.
fn subjects(args: &Verify, levels: &[Level]) -> Result<Vec<Box<dyn Subject>>, Failure> {
    let named = |name: &str| args.subjects.iter().chain(&args.plans).any(|n| n == name);
    let own = args.own.tracers()?;
    let all = args.subjects.is_empty() && args.plans.is_empty() && own.is_empty();
    let mut subjects: Vec<Box<dyn Subject>> = Vec::new();
    for naive in NAIVE {
        if all || named(naive.name()) {
            subjects.push(Box::new(naive));
        }
    }
    for plan in NamedPlan::ALL {
        if named(plan.name()) || (all && plan != NamedPlan::Paper) {
            let at = |level: &Level| Grid::new(plan, *level, levels.len() > 1, args.grid);
            subjects.extend(levels.iter().map(|level| Box::new(at(level)) as Box<dyn Subject>));
        }
    }
    subjects.extend(own.into_iter().map(|own| Box::new(own) as Box<dyn Subject>));
    Ok(subjects)
}

/// A scene's file or maker, and the frame asked for.
pub(crate) fn load(word: &str, frame: usize) -> Result<(Loaded, Scene), Failure> {
    let loaded = Source::parse(word)?.load()?;
    let frames = loaded.animation.frames();
    let Some(scene) = frames.get(frame) else {
        return Err(format!("{word} has frames 0 to {}, not {frame}", frames.len() - 1).into());
    };
    let scene = scene.clone();
    Ok((loaded, scene))
}

/// Of several scenes the one that is not there, or has no such frame, is told before minutes are spent on the others.
pub(crate) fn all_there(words: &[String], frame: usize) -> Result<(), Failure> {
    words.iter().try_for_each(|word| load(word, frame).map(drop))
}

/// How a scene is seen: as it is wished, then as it wants to be, of a size if none was wished.
pub(crate) fn framed(view: &View, loaded: &Loaded, [width, height]: [u32; 2]) -> Result<Framing, Failure> {
    let framing = view.framing().or(&loaded.framing.unwrap_or_default());
    let size = match framing.size {
        Some(size) => size,
        None => Size::new(width, height)?,
    };
    Ok(Framing { size: Some(size), ..framing })
}

/// What a reader passed over goes to standard error.
pub(crate) fn warn(loaded: &Loaded) {
    for warning in &loaded.warnings {
        _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
}

/// What a scene is and where it comes from.
fn about(word: &str) -> (String, String) {
    match Source::parse(word) {
        Ok(Source::Named(entry)) => (entry.what.into(), entry.provenance.into()),
        Ok(Source::Generated(_)) => ("a generated scene".into(), "made, the same on every machine".into()),
        _ => ("a file".into(), "the user's own".into()),
    }
}
