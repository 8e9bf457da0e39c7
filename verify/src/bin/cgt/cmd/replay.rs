//! `cgt replay`: a case judged again, and one of its pixels told step by step.

use super::verify::QUESTIONS;
use crate::args::Replay as Args;
use crate::{Failure, say};
use std::process::ExitCode;
use verify::case::account::{account, check_pixel};
use verify::case::folder::keep;
use verify::case::shrink::shrink;
use verify::case::{Case, worst};
use verify::properties::{has_relations, related};
use verify::subject::Subject;
use verify::verdict::Verdict;

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let place = |error: &dyn std::fmt::Display| format!("`{}`: {error}", args.case.display());
    let bytes = std::fs::read(&args.case).map_err(|error| place(&error))?;
    let mut case = Case::from_json(&bytes).map_err(|error| place(&error))?;
    if let Some(own) = args.own.tracer()? {
        // Whoever asks for it wants to know whether it keeps its promise there.
        if let Some(asked) = own.asked(1) {
            case = Case { expected: asked.promise().worst(), asked, ..case };
        }
    }
    if args.shrink {
        let verdict = worst(&case.judge()?);
        let same = |smaller: &Case| smaller.judge().is_ok_and(|judged| worst(&judged) == verdict);
        case = shrink(&case, QUESTIONS, &same);
        say(&format!(
            "shrunk     to {} spheres and {}x{} pixels\n",
            case.frames.frames()[0].spheres().len(),
            case.camera.size().width(),
            case.camera.size().height()
        ))?;
    }
    let judged = match case.judge() {
        Ok(judged) => judged,
        Err(error) => {
            let due = case.may_fail_with(&error);
            say(&format!("{}\n\n{error}{}\n", case.why, if due { ", as its plan says" } else { "" }))?;
            return Ok(ExitCode::from(if due { 3 } else { 1 }));
        }
    };
    let frames = judged.len();
    let wrong = judged.iter().position(|judged| judged.wrong.is_some());
    let frame = args.frame.or(wrong).unwrap_or(frames - 1);
    if frame >= frames {
        return Err(format!("the case has frames 0 to {}, not {frame}", frames - 1).into());
    }
    let pixel = args.pixel.or(case.pixel).or(judged[frame].wrong).unwrap_or([0, 0]);
    check_pixel(case.camera.size(), pixel)?;
    let verdict = worst(&judged);
    say(&format!("{}\n\n{}", case.why, account(&case, frame, pixel)?))?;
    // A tracer may be at odds with itself where no picture of it is wrong.
    let stated = has_relations(&case.asked);
    let broken = if stated { related(&case).err() } else { None };
    if stated {
        let told = broken.as_ref().map(|failure| failure.message.as_str());
        let told = told.unwrap_or("hold: turned, mirrored, scaled or in another order it says the same");
        say(&format!("\nrelations  {told}\n"))?;
    }
    let as_expected = case.is_as_expected(verdict) && (broken.is_none() || case.expected == Verdict::Wrong);
    let word = if as_expected { "as it should be" } else { "NOT as it should be" };
    say(&format!("\ncase       {verdict:?}, {word} ({:?})\n", case.expected))?;
    if let Some(folder) = &args.out {
        let name = args.case.file_stem().map_or("case".into(), |name| name.to_string_lossy());
        let kept = keep(&Case { pixel: Some(pixel), ..case }, folder, &name)?;
        say(&format!("kept       {}\n", kept.file.display()))?;
    }
    Ok(if as_expected { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
