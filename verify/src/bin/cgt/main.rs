//! `cgt`: renders sphere scenes, judges tracers of them, and writes what it found into a report.
//!
//! Exit codes: 0 all agree, 1 a mismatch, 2 bad input or usage, 3 something needed for a verdict is missing,
//! 4 slower than the baseline.

mod args;
mod cmd;
mod environment;
mod progress;

use args::{Cli, Command};
use clap::Parser;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// Any error that ends the program with code 2.
type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match cli.command {
        None => cmd::verify::verify(&cli.verify),
        Some(Command::Verify(args)) => cmd::verify::verify(&args),
        Some(Command::Report(args)) => cmd::report::run(&args),
        Some(Command::Render(args)) => cmd::render::render(&args),
        Some(Command::View(args)) => cmd::view::run(&args),
        Some(Command::Bench(args)) => cmd::bench::run(&args),
        Some(Command::Chart(args)) => cmd::chart::run(&args),
        Some(Command::Stability(args)) => cmd::stability::run(&args),
        Some(Command::Ablate(args)) => cmd::ablate::run(&args),
        Some(Command::Spu(args)) => cmd::spu::run(&args),
        Some(Command::Claims(args)) => cmd::claims::run(&args),
        Some(Command::Figures(args)) => cmd::figures::run(&args),
        Some(Command::Prove(args)) => cmd::prove::run(&args),
        Some(Command::Replay(args)) => cmd::replay::run(&args),
        Some(Command::Campaign(args)) => cmd::campaign::run(&args.step),
        Some(Command::Scenes) => cmd::scenes::scenes(),
        Some(Command::Completions(args)) => cmd::manual::completions(&args),
        Some(Command::Man(args)) => cmd::manual::man(&args),
    };
    outcome.unwrap_or_else(|failure| {
        // One line for the error, one for each cause below it that says something new.
        let mut text = format!("cgt: {failure}");
        let mut cause = failure.source();
        while let Some(error) = cause {
            let line = error.to_string();
            if !text.contains(&line) {
                text += &format!("\n  because {line}");
            }
            cause = error.source();
        }
        _ = writeln!(std::io::stderr(), "{text}");
        ExitCode::from(2)
    })
}

/// Prints to standard output. A reader that has gone away is no error; a full disk is.
fn say(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(format!("standard output: {error}").into())
        }
        _ => Ok(()),
    }
}
