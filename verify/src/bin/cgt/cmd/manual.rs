//! `cgt completions` and `cgt man`: what a shell and `man` need to know of this program, made from its own command line.

use super::files;
use crate::args::{Cli, Completions, Man};
use crate::{Failure, say};
use clap::CommandFactory;
use std::process::ExitCode;
use verify::picture::write_atomically;

pub(crate) fn completions(args: &Completions) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "cgt", &mut script);
    say(&String::from_utf8(script)?)?;
    Ok(ExitCode::SUCCESS)
}

pub(crate) fn man(args: &Man) -> Result<ExitCode, Failure> {
    files::folder(&args.folder)?;
    let mut program = Cli::command();
    program.build();
    let mut pages = vec![(String::from("cgt"), program.clone())];
    let subcommands = program.get_subcommands().filter(|command| command.get_name() != "help");
    pages.extend(subcommands.map(|command| (format!("cgt-{}", command.get_name()), command.clone())));
    for (name, command) in pages {
        let mut page = Vec::new();
        clap_mangen::Man::new(command).render(&mut page)?;
        let file = args.folder.join(format!("{name}.1"));
        write_atomically(&file, &page)?;
        say(&format!("{}\n", file.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}
