//! Solvers: programs of other people that read SMT-LIB text. Whatever they say is one of three things, and that they did not say
//! anything in time is the third.

use super::smt::Numbers;
use super::term::Sort;
use crate::scenes::catalogue;
use std::io::{self, Read};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// The environment variable that names a folder to look into before the others.
pub const VARIABLE: &str = "CGT_SOLVERS";

/// One of the programs that are known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Solver {
    /// Its name: `z3`, `cvc5` or `bitwuzla`.
    pub name: &'static str,
    /// What it calls itself.
    pub version: String,
    program: PathBuf,
}

/// What a solver says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// There are such inputs: their bits, if it told them.
    Sat(Option<Vec<u32>>),
    /// There are none.
    Unsat,
    /// It does not know, or was not done in time, or failed: what it said.
    Unknown(String),
}

const KNOWN: [&str; 3] = ["bitwuzla", "z3", "cvc5"];

impl Solver {
    /// Those that are there: in the folder that [`VARIABLE`] names, among the fetched data, whose versions are pinned, or on the path.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut folders: Vec<PathBuf> = std::env::var_os(VARIABLE).map(PathBuf::from).into_iter().collect();
        folders.push(catalogue::folder().join("solvers"));
        folders.extend(std::env::var_os("PATH").iter().flat_map(std::env::split_paths));
        // The first of that name that runs.
        let find = |name: &'static str| folders.iter().find_map(|folder| Self::at(name, folder.join(name)));
        KNOWN.into_iter().filter_map(find).collect()
    }

    /// The program of that file, if it runs and says its version.
    fn at(name: &'static str, program: PathBuf) -> Option<Self> {
        if !program.is_file() {
            return None;
        }
        let said = Command::new(&program).arg("--version").stdin(Stdio::null()).output().ok()?;
        if !said.status.success() {
            return None;
        }
        // Its name apart, what begins with a digit.
        let text = String::from_utf8_lossy(&said.stdout);
        let version = text.split_whitespace().find(|word| word.starts_with(|c: char| c.is_ascii_digit()))?;
        Some(Self { name, version: version.to_owned(), program })
    }

    /// One of those that are known, somewhere else.
    #[must_use]
    pub fn new(name: &'static str, program: PathBuf) -> Self {
        Self { name, version: String::new(), program }
    }

    /// Whether it is good at such numbers: the first of those is asked first.
    #[must_use]
    pub fn rank(&self, numbers: Numbers) -> usize {
        let order = match numbers {
            Numbers::Float | Numbers::Free => ["bitwuzla", "cvc5", "z3"],
            Numbers::Real => ["z3", "cvc5", "bitwuzla"],
        };
        order.iter().position(|name| *name == self.name).unwrap_or(order.len())
    }

    /// Whether it knows such numbers at all.
    #[must_use]
    pub fn knows(&self, numbers: Numbers) -> bool {
        self.name != "bitwuzla" || numbers != Numbers::Real
    }

    /// Asks it, for so long at most.
    #[must_use]
    pub fn ask(&self, text: &str, inputs: &[Sort], limit: Duration) -> Reply {
        match self.output(text, limit) {
            Ok(Some(said)) => reply(&said, inputs),
            Ok(None) => Reply::Unknown(format!("not done after {} s", limit.as_secs())),
            Err(error) => Reply::Unknown(format!("{}: {error}", self.program.display())),
        }
    }

    fn output(&self, text: &str, limit: Duration) -> io::Result<Option<String>> {
        let file = tempfile::Builder::new().prefix("cgt-").suffix(".smt2").tempfile()?;
        std::fs::write(file.path(), text)?;
        let mut child = Command::new(&self.program)
            .arg(file.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let mut output = child.stdout.take().expect("it is piped");
        let reader = thread::spawn(move || {
            let mut said = String::new();
            output.read_to_string(&mut said).map(|_| said)
        });
        let start = Instant::now();
        while child.try_wait()?.is_none() {
            if start.elapsed() > limit {
                child.kill()?;
                child.wait()?;
                return Ok(None);
            }
            thread::sleep(Duration::from_millis(2));
        }
        reader.join().expect("reading does not panic").map(Some)
    }
}

/// The first word counts; after it, in parentheses, come a name and a value for each input.
fn reply(said: &str, inputs: &[Sort]) -> Reply {
    let (word, rest) = said.trim_start().split_once(char::is_whitespace).unwrap_or((said.trim(), ""));
    match word {
        "unsat" => Reply::Unsat,
        "sat" => Reply::Sat(values(rest, inputs)),
        _ => Reply::Unknown(said.lines().next().unwrap_or("nothing").to_owned()),
    }
}

fn values(text: &str, inputs: &[Sort]) -> Option<Vec<u32>> {
    let mut values = Vec::new();
    for (i, sort) in inputs.iter().enumerate() {
        // `(in3 VALUE)`: up to the parenthesis that closes the pair.
        let start = text.find(&format!("(in{i} "))?;
        let pair = &text[start + 1..];
        let mut depth = 1usize;
        let end = pair.find(|c: char| {
            depth = depth + usize::from(c == '(') - usize::from(c == ')');
            depth == 0
        })?;
        let (_, value) = pair[..end].split_once(' ')?;
        values.push(bits(value.trim(), *sort)?);
    }
    Some(values)
}

/// Bits of a value: of a real the nearest f32.
#[allow(clippy::cast_possible_truncation, reason = "the nearest f32 is what is wanted")]
fn bits(value: &str, sort: Sort) -> Option<u32> {
    if let Some(digits) = value.strip_prefix("#x") {
        return u32::from_str_radix(digits, 16).ok();
    }
    if let Some(digits) = value.strip_prefix("#b") {
        return u32::from_str_radix(digits, 2).ok();
    }
    match (sort, value) {
        (Sort::Truth, "true") => Some(1),
        (Sort::Truth, "false") => Some(0),
        (Sort::Number, _) => real(value).map(|x| (x as f32).to_bits()),
        _ => None,
    }
}

/// `1.5`, `1.5?` (cut off), `(- 2.0)`, `(/ 1.0 3.0)`.
fn real(value: &str) -> Option<f64> {
    let Some(inside) = value.strip_prefix('(') else {
        return value.trim_end_matches('?').parse().ok();
    };
    let inside = inside.strip_suffix(')')?.trim();
    let (operator, operands) = inside.split_once(' ')?;
    let operands = operands.trim();
    let mut depth = 0usize;
    let split = operands.find(|c: char| {
        depth = depth + usize::from(c == '(') - usize::from(c == ')');
        c == ' ' && depth == 0
    });
    match (operator, split) {
        ("-", None) => Some(-real(operands)?),
        ("/", Some(at)) => Some(real(&operands[..at])? / real(operands[at..].trim())?),
        _ => None,
    }
}
