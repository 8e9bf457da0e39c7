//! What a report says of the run itself: program, machine, compiler, date, command line.

use verify::report::Environment;

pub(crate) fn environment(threads: usize) -> Environment {
    Environment {
        program: concat!("cgt ", env!("CARGO_PKG_VERSION")).into(),
        target: env!("CGT_TARGET").into(),
        cpu: cpu(),
        simd: optimized::Level::best().map_or_else(|error| error.to_string(), |level| level.to_string()),
        rustc: env!("CGT_RUSTC").into(),
        threads,
        date: jiff::Timestamp::now().round(jiff::Unit::Second).unwrap_or_default().to_string(),
        command_line: command_line(),
        seed: None,
    }
}

/// The model as Linux tells it; nothing elsewhere.
fn cpu() -> Option<String> {
    let info = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = info.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// A word as it can be typed into a shell.
pub(crate) fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// The command line with the program's bare name, fit to be typed again.
fn command_line() -> String {
    let words = std::env::args_os().skip(1).map(|word| quoted(&word.to_string_lossy()));
    std::iter::once("cgt".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}
