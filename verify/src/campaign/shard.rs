//! A shard: every N-th unit, done in order, each a line of a file as soon as it is done. While the shard is at work the file is called
//! `shard-I-of-N.part`; the whole one, `shard-I-of-N.jsonl`, takes its name at once. Killed at any time it loses the unit it was at: what stands in the file
//! is read again, and a last line that was cut is written anew.
//!
//! In: a plan, which shard, a folder. Out: the file. Refused: a file of another plan, program or SIMD levels; a shard on which another process works.

use super::plan::{Plan, Unit};
use super::unit::{Bench, Found, UnitError};
use optimized::Level;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use thiserror::Error;

/// What a shard's file is called in its first line.
const FORMAT: &str = "cgt-campaign-shard";
const VERSION: u32 = 1;
/// The most shards of a campaign.
pub const MOST_SHARDS: u64 = 1_000_000;

/// Which shard of how many, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Numbers")]
pub struct Which {
    /// Which.
    pub shard: u64,
    /// Of how many.
    pub of: u64,
}

/// Both numbers as a file has them.
#[derive(Deserialize)]
struct Numbers {
    shard: u64,
    of: u64,
}

impl TryFrom<Numbers> for Which {
    type Error = String;

    fn try_from(Numbers { shard, of }: Numbers) -> Result<Self, String> {
        if shard == 0 || shard > of || of > MOST_SHARDS {
            return Err(format!(
                "`{shard}/{of}`: shards count from 1 to N, of which there are at most {MOST_SHARDS}"
            ));
        }
        Ok(Self { shard, of })
    }
}

impl FromStr for Which {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        let (shard, of) = numbers.ok_or_else(|| format!("`{text}` is not I/N, as 3/7"))?;
        Numbers { shard, of }.try_into()
    }
}

impl fmt::Display for Which {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.shard, self.of)
    }
}

impl Which {
    /// Whether a unit is among its own.
    #[must_use]
    pub fn has(self, unit: u64) -> bool {
        unit % self.of == self.shard - 1
    }

    /// How many of so many units are its own.
    #[must_use]
    pub fn share(self, units: u64) -> u64 {
        units / self.of + u64::from(self.shard <= units % self.of)
    }

    /// Its file, when it is whole.
    #[must_use]
    pub fn file(self, folder: &Path) -> PathBuf {
        folder.join(format!("shard-{}-of-{}.jsonl", self.shard, self.of))
    }

    /// Its file while it is at work.
    #[must_use]
    pub fn part(self, folder: &Path) -> PathBuf {
        self.file(folder).with_extension("part")
    }
}

/// The first line of a shard's file: what its lines are a function of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    format: String,
    version: u32,
    /// The campaign's name.
    pub campaign: String,
    /// [`Plan::hash`].
    pub plan: String,
    /// Version of the program.
    pub program: String,
    /// The SIMD levels that cases are drawn from.
    pub levels: Vec<String>,
    /// Of each film's scene a hash of its numbers: a file may have another content elsewhere.
    pub scenes: Vec<String>,
    /// Which shard.
    #[serde(flatten)]
    pub which: Which,
}

impl Head {
    /// Of a shard of a plan, on this machine.
    #[must_use]
    pub fn new(plan: &Plan, which: Which, scenes: Vec<String>) -> Self {
        Self {
            format: FORMAT.into(),
            version: VERSION,
            campaign: plan.name.clone(),
            plan: plan.hash(),
            program: env!("CARGO_PKG_VERSION").into(),
            levels: Level::available().iter().map(|level| level.name().to_owned()).collect(),
            scenes,
            which,
        }
    }

    /// In what respect another is of something else; nothing if both belong together.
    #[must_use]
    pub fn differs(&self, other: &Self) -> Option<String> {
        let levels = |head: &Self| head.levels.join(", ");
        let pairs = [
            ("format", self.format.clone(), other.format.clone()),
            ("version of the format", self.version.to_string(), other.version.to_string()),
            ("plan", self.plan.clone(), other.plan.clone()),
            ("version of the program", self.program.clone(), other.program.clone()),
            ("SIMD levels", levels(self), levels(other)),
            ("films", self.scenes.join(", "), other.scenes.join(", ")),
        ];
        let (what, own, its) = pairs.into_iter().find(|(_, own, its)| own != its)?;
        Some(format!("its {what} is `{its}`, not `{own}`"))
    }
}

/// Why a shard was not done, or its file not read.
#[derive(Debug, Error)]
#[allow(missing_docs, reason = "each says all itself")]
pub enum ShardError {
    #[error("`{}`: {cause}", path.display())]
    File { path: PathBuf, cause: io::Error },
    #[error("`{}`, line {line}: {why}", path.display())]
    Line { path: PathBuf, line: usize, why: String },
    #[error("`{}` is of something else: {why}", path.display())]
    Other { path: PathBuf, why: String },
    #[error("another process works on `{}`", path.display())]
    Taken { path: PathBuf },
    #[error(transparent)]
    Unit(#[from] UnitError),
}

/// A file's lines: its head, what each unit found, and how many bytes these take; what follows them is no whole line.
#[derive(Debug)]
pub struct Lines {
    /// The first line.
    pub head: Head,
    /// What units found, in the order of their numbers.
    pub found: Vec<Found>,
    /// Bytes of whole lines.
    pub bytes: u64,
    /// Bytes after them.
    pub cut: u64,
}

/// Reads a shard's file; nothing of a file whose first line was cut.
///
/// # Errors
/// [`ShardError`] for what cannot be read, a line that is no unit of the shard, or one out of order.
pub fn read(path: &Path) -> Result<Option<Lines>, ShardError> {
    let mut text = Vec::new();
    let read = File::open(path).and_then(|mut file| file.read_to_end(&mut text));
    read.map_err(|cause| ShardError::File { path: path.into(), cause })?;
    parse(&text, path)
}

fn parse(text: &[u8], path: &Path) -> Result<Option<Lines>, ShardError> {
    let whole = text.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    let fault = |line: usize, why: String| ShardError::Line { path: path.into(), line: line + 1, why };
    let mut lines = text[..whole].split_inclusive(|byte| *byte == b'\n').enumerate();
    let Some((_, first)) = lines.next() else { return Ok(None) };
    let head: Head = serde_json::from_slice(first).map_err(|error| fault(0, error.to_string()))?;
    let mut found: Vec<Found> = Vec::new();
    for (i, line) in lines {
        let one: Found = serde_json::from_slice(line).map_err(|error| fault(i, error.to_string()))?;
        let due = found.last().map_or(head.which.shard - 1, |last| last.unit + head.which.of);
        if one.unit != due {
            return Err(fault(i, format!("unit {} where {due} is due", one.unit)));
        }
        found.push(one);
    }
    Ok(Some(Lines { head, found, bytes: whole as u64, cut: (text.len() - whole) as u64 }))
}

/// Does a shard, or what is left of it. `tick` learns how many units are done, of how many.
///
/// # Errors
/// [`ShardError`]; what was done stays.
pub fn run(
    plan: &Plan,
    which: Which,
    level: Level,
    folder: &Path,
    tick: &dyn Fn(u64, u64),
) -> Result<PathBuf, ShardError> {
    let (whole, part) = (which.file(folder), which.part(folder));
    let at = |path: &Path| {
        let path = path.to_path_buf();
        move |cause| ShardError::File { path, cause }
    };
    let bench = Bench::new(plan, level).map_err(UnitError::from)?;
    let head = Head::new(plan, which, bench.scenes());
    let same = |lines: &Lines, path: &Path| match head.differs(&lines.head) {
        None if lines.head.which == which => Ok(()),
        None => {
            Err(ShardError::Other { path: path.into(), why: format!("it is shard {}", lines.head.which) })
        }
        Some(why) => Err(ShardError::Other { path: path.into(), why }),
    };
    if whole.exists() {
        let lines = read(&whole)?;
        let nothing = || ShardError::Other { path: whole.clone(), why: "it is empty".into() };
        let lines = lines.ok_or_else(nothing)?;
        same(&lines, &whole)?;
        if lines.cut == 0 && lines.found.len() as u64 == which.share(plan.units().count() as u64) {
            return Ok(whole);
        }
        // It lost its end, in a copy perhaps. What is left is gone on from, but where somebody is or was at work on it again.
        if !part.exists() {
            std::fs::rename(&whole, &part).map_err(at(&part))?;
        }
    }
    std::fs::create_dir_all(folder).map_err(at(folder))?;
    let open = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&part);
    let mut file = open.map_err(at(&part))?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => return Err(ShardError::Taken { path: part }),
        Err(TryLockError::Error(cause)) => return Err(ShardError::File { path: part, cause }),
    }
    let mut text = Vec::new();
    file.read_to_end(&mut text).map_err(at(&part))?;
    let kept = parse(&text, &part)?;
    if let Some(lines) = &kept {
        same(lines, &part)?;
    }
    let (bytes, done) = kept.map_or((0, 0), |lines| (lines.bytes, lines.found.len() as u64));
    // A line that was cut goes.
    file.set_len(bytes).and_then(|()| file.seek(SeekFrom::End(0)).map(drop)).map_err(at(&part))?;
    let mut put = |line: Vec<u8>| {
        file.write_all(&line)
            .and_then(|()| file.write_all(b"\n"))
            .and_then(|()| file.sync_data())
            .map_err(at(&part))
    };
    let line = |error: serde_json::Error| ShardError::File { path: part.clone(), cause: error.into() };
    if bytes == 0 {
        put(serde_json::to_vec(&head).map_err(line)?)?;
    }
    let own: Vec<(u64, Unit)> = (0..).zip(plan.units()).filter(|(number, _)| which.has(*number)).collect();
    let all = own.len() as u64;
    tick(done, all);
    for ((number, unit), k) in own.iter().zip(1..).skip(usize::try_from(done).unwrap_or(usize::MAX)) {
        let found = bench.work(*number, unit)?;
        put(serde_json::to_vec(&found).map_err(line)?)?;
        tick(k, all);
    }
    std::fs::rename(&part, &whole).map_err(at(&whole))?;
    Ok(whole)
}
