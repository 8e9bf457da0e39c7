//! Shards put together: every unit must be there once. What comes out does not depend on how many shards there were, who did them, or in which
//! order they are read.

use super::plan::{Film, Plan};
use super::shard::{Head, Lines, ShardError, Which, read};
use super::unit::{self, Broken, Found};
use crate::report::words;
use crate::verdict::Verdict;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Version of the layout of the JSON file.
pub const SCHEMA_VERSION: u32 = 1;

/// What a campaign comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// No promise was broken, and enough was at stake.
    Held,
    /// At least one was.
    Broken,
    /// None was, but less was at stake than the plan demands, or of a film nothing could be judged.
    TooLittle,
}

/// A failure, as often as it was found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// The property, or the film's subject.
    pub of: String,
    /// What is wrong, as it was said first.
    pub message: String,
    /// The name of its case.
    pub name: String,
    /// How often.
    pub times: u64,
    /// The first unit that found it.
    pub unit: u64,
    /// The text of its case.
    #[serde(skip)]
    pub case: String,
}

/// A whole campaign: the same for the same plan, however it was divided.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Merged {
    /// [`SCHEMA_VERSION`]; first, so that a reader can stop here.
    pub schema_version: u32,
    /// What this file is: `campaign`.
    pub kind: &'static str,
    /// The campaign.
    pub plan: Plan,
    /// [`Plan::hash`].
    pub hash: String,
    /// Version of the program.
    pub program: String,
    /// The SIMD levels that cases are drawn from.
    pub levels: Vec<String>,
    /// What it comes to.
    pub outcome: Outcome,
    /// What is lacking of what the plan demands, in words.
    pub lacking: Vec<String>,
    /// Units done.
    pub units: u64,
    /// Counts by what they are of.
    pub counts: BTreeMap<String, u64>,
    /// Histograms: how often the value was 0, how often 1, from 2 to 3, from 4 to 7, and so on.
    pub histograms: BTreeMap<String, Vec<u64>>,
    /// Each failure once.
    pub failures: Vec<Failure>,
}

/// Why shards were not put together.
#[derive(Debug, Error)]
#[allow(missing_docs, reason = "each says all itself")]
pub enum MergeError {
    #[error(transparent)]
    Shard(#[from] ShardError),
    #[error("no file of a whole shard is there")]
    None,
    #[error("`{}` and `{}` are of different work: {why}", one.display(), other.display())]
    Different { one: PathBuf, other: PathBuf, why: String },
    #[error("unit {unit} is in `{}` and in `{}`", one.display(), other.display())]
    Double { unit: u64, one: PathBuf, other: PathBuf },
    #[error("`{}` has unit {unit}; the plan has units 0 to {last}", file.display())]
    Beyond { file: PathBuf, unit: u64, last: u64 },
    #[error("{count} of {of} units are missing, the first is {first}, of shard {shard}{}", if *at_work { ", which is not finished" } else { "" })]
    Missing { count: u64, of: u64, first: u64, shard: String, at_work: bool },
}

/// The whole shards in these folders, or these files, in the order of their names.
fn files(places: &[PathBuf]) -> Result<Vec<PathBuf>, ShardError> {
    let mut files = Vec::new();
    for place in places {
        let fault = |cause| ShardError::File { path: place.clone(), cause };
        if !place.is_dir() {
            files.push(place.clone());
            continue;
        }
        for entry in std::fs::read_dir(place).map_err(fault)? {
            let path = entry.map_err(fault)?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if name.starts_with("shard-") && name.ends_with(".jsonl") {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// Puts all shards in some folders together.
///
/// # Errors
/// [`MergeError`]: a file that cannot be read or was cut, shards of different plans, programs or SIMD levels, a unit that is missing or
/// there twice.
pub fn merge(plan: &Plan, places: &[PathBuf]) -> Result<Merged, MergeError> {
    let units = plan.units().count() as u64;
    let files = files(places)?;
    let mut all: BTreeMap<u64, (Found, usize)> = BTreeMap::new();
    let mut first: Option<(Head, usize)> = None;
    for (k, file) in files.iter().enumerate() {
        let cut = |why: &str| ShardError::Line { path: file.clone(), line: 1, why: why.into() };
        let lines: Lines = read(file)?.ok_or_else(|| cut("it has no whole line"))?;
        if lines.cut > 0 {
            return Err(cut(&format!("{} bytes after its last whole line", lines.cut)).into());
        }
        let (expected, one) = first.get_or_insert_with(|| (lines.head.clone(), k));
        if let Some(why) = expected.differs(&lines.head) {
            return Err(MergeError::Different { one: files[*one].clone(), other: file.clone(), why });
        }
        for found in lines.found {
            let unit = found.unit;
            if unit >= units {
                return Err(MergeError::Beyond { file: file.clone(), unit, last: units - 1 });
            }
            if let Some((_, earlier)) = all.insert(unit, (found, k)) {
                return Err(MergeError::Double { unit, one: files[earlier].clone(), other: file.clone() });
            }
        }
    }
    let (head, k) = first.ok_or(MergeError::None)?;
    if head.plan != plan.hash() {
        let why = format!("it was made by the plan {}, not by this, which is {}", head.plan, plan.hash());
        return Err(ShardError::Other { path: files[k].clone(), why }.into());
    }
    if let Some(first) = (0..units).find(|unit| !all.contains_key(unit)) {
        let of = head.which.of;
        let which = Which { shard: first % of + 1, of };
        let at_work = places.iter().any(|place| which.part(place).exists());
        let count = units - all.len() as u64;
        return Err(MergeError::Missing { count, of: units, first, shard: which.to_string(), at_work });
    }
    let mut sum = Found::default();
    let mut failures: BTreeMap<(String, String), Failure> = BTreeMap::new();
    for (unit, (found, _)) in &all {
        for broken in &found.failures {
            let key = (broken.of.clone(), broken.key());
            failures.entry(key).or_insert_with(|| failure(broken, *unit)).times += 1;
        }
        sum.and(found);
    }
    let of = |what: &String| sum.counts.get(what).copied().unwrap_or(0);
    let lacking = plan.least.iter().filter(|(what, least)| of(what) < **least);
    let lacking = lacking.map(|(what, least)| {
        format!("{what}: {} of at least {}", words::count(of(what)), words::count(*least))
    });
    // Whoever has no frame that anything can be said of has kept no promise.
    let named = |film: &'_ Film| {
        film.subjects.iter().map(|name| format!("{name} on {}", film.scene)).collect::<Vec<_>>()
    };
    let frames = |who: &String, verdict| of(&format!("{who}: {}", unit::word(verdict)));
    let judged = |who: &String| {
        [Verdict::Equal, Verdict::WithinBound, Verdict::Wrong].map(|verdict| frames(who, verdict))
    };
    let silent = plan.film.iter().flat_map(named).filter(|who| judged(who) == [0; 3]);
    let silent = silent.map(|who| format!("{who}: no frame of which anything could be judged"));
    let lacking: Vec<String> = lacking.chain(silent).collect();
    let outcome = match (failures.is_empty(), lacking.is_empty()) {
        (false, _) => Outcome::Broken,
        (true, false) => Outcome::TooLittle,
        (true, true) => Outcome::Held,
    };
    Ok(Merged {
        schema_version: SCHEMA_VERSION,
        kind: "campaign",
        plan: plan.clone(),
        hash: head.plan,
        program: head.program,
        levels: head.levels,
        outcome,
        lacking,
        units,
        counts: sum.counts,
        histograms: sum.histograms,
        failures: failures.into_values().collect(),
    })
}

fn failure(broken: &Broken, unit: u64) -> Failure {
    let word = broken.of.split(' ').next().unwrap_or_default();
    Failure {
        of: broken.of.clone(),
        message: broken.message.clone(),
        name: format!("{word}-{}", broken.key()),
        times: 0,
        unit,
        case: broken.case.clone(),
    }
}

/// How far a shard is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Which.
    pub which: Which,
    /// Units done and to be done.
    pub done: [u64; 2],
    /// Failures found.
    pub failures: u64,
    /// Whether its file is whole.
    pub whole: bool,
}

/// How far all shards in a folder are, in their order; those that were never begun are told by [`Progress::which`] of the others.
///
/// # Errors
/// [`ShardError`] for a folder or a file that cannot be read, or is of another plan.
pub fn status(plan: &Plan, folder: &Path) -> Result<Vec<Progress>, ShardError> {
    let fault = |cause| ShardError::File { path: folder.into(), cause };
    let units = plan.units().count() as u64;
    let mut all: Vec<Progress> = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(fault)? {
        let path = entry.map_err(fault)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let whole = name.ends_with(".jsonl");
        if !name.starts_with("shard-") || !(whole || name.ends_with(".part")) {
            continue;
        }
        // One that was just begun has no line.
        let Some(lines) = read(&path)? else { continue };
        if lines.head.plan != plan.hash() {
            let why = format!("it was made by the plan {}", lines.head.plan);
            return Err(ShardError::Other { path, why });
        }
        let which = lines.head.which;
        let failures = lines.found.iter().map(|found| found.failures.len() as u64).sum();
        all.push(Progress { which, done: [lines.found.len() as u64, which.share(units)], failures, whole });
    }
    all.sort_by_key(|progress| (progress.which.of, progress.which.shard));
    Ok(all)
}
