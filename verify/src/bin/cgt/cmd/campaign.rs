//! `cgt campaign`: a shard done, how far all are, all of them put together.

use super::files;
use crate::args::CampaignStep;
use crate::environment::environment;
use crate::{Failure, say};
use indicatif::{ProgressBar, ProgressStyle};
use optimized::Level;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use verify::campaign::merge::{Outcome, merge, status};
use verify::campaign::plan::Plan;
use verify::campaign::shard::{Which, run as work};
use verify::campaign::{page, text};
use verify::picture::write_atomically;

pub(crate) fn run(step: &CampaignStep) -> Result<ExitCode, Failure> {
    match step {
        CampaignStep::Run { plan, shard, out, threads } => shard_of(plan, *shard, out, *threads),
        CampaignStep::Status { plan, folder } => {
            say(&text::status(&status(&read(plan)?, folder)?))?;
            Ok(ExitCode::SUCCESS)
        }
        CampaignStep::Merge { plan, places, out } => merged(&read(plan)?, places, out),
    }
}

fn read(file: &Path) -> Result<Plan, Failure> {
    let place = |error: &dyn std::fmt::Display| format!("`{}`: {error}", file.display());
    let text = std::fs::read_to_string(file).map_err(|error| place(&error))?;
    Plan::parse(&text).map_err(|error| place(&error).into())
}

/// What it found is in its file: a shard that found failures is as whole as any.
fn shard_of(plan: &Path, which: Which, folder: &Path, threads: u16) -> Result<ExitCode, Failure> {
    let plan = read(plan)?;
    let style = ProgressStyle::with_template("{prefix:>20} {msg:26} {bar:30} {percent:>3} % {elapsed} {eta}");
    let bar = ProgressBar::new(0).with_prefix(format!("shard {which}")).with_message("units");
    if let Ok(style) = style {
        bar.set_style(style);
    }
    let tick = |done, all| {
        bar.set_length(all);
        bar.set_position(done);
    };
    let level = Level::best()?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build()?;
    let file = pool.install(|| work(&plan, which, level, folder, &tick))?;
    bar.finish();
    say(&format!("{}\n", file.display()))?;
    Ok(ExitCode::SUCCESS)
}

fn merged(plan: &Plan, places: &[PathBuf], out: &Path) -> Result<ExitCode, Failure> {
    let merged = merge(plan, places)?;
    let told = text::text(&merged);
    files::folder(out)?;
    for failure in &merged.failures {
        files::folder(&out.join("cases"))?;
        write_atomically(&out.join("cases").join(format!("{}.json", failure.name)), failure.case.as_bytes())?;
    }
    files::data("campaign", out, &merged, None)?;
    write_atomically(&out.join("campaign.txt"), told.as_bytes())?;
    write_atomically(&out.join("stakes.svg"), page::stakes(&merged).as_bytes())?;
    let page = page::page(&merged, &environment(1, &[]))?;
    write_atomically(&out.join("campaign.html"), page.as_bytes())?;
    say(&format!("{told}\npage: {}\n", out.join("campaign.html").display()))?;
    Ok(match merged.outcome {
        Outcome::Held => ExitCode::SUCCESS,
        Outcome::Broken => ExitCode::from(1),
        Outcome::TooLittle => ExitCode::from(3),
    })
}
