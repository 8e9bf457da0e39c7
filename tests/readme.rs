//! Is every word of README that can be checked true? Its commands are run, its table of claims is the program's, its
//! links lead somewhere, its pictures come out again, and the output it shows is what the program prints.

use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use tempfile::TempDir;
use verify::prove::solver::Solver;
use verify::scenes::catalogue::{Data, ENTRIES};

/// Commands that are not run here, and why. Each must occur, and each script of them must be there to be run.
const NOT_RUN: [(&str, &str); 20] = [
    ("tests/run", "it is what runs this test"),
    ("tests/fetch-data", "it needs a network"),
    ("tests/run --long", "it takes ten minutes"),
    ("tests/faults/run", "it takes an hour; tests/faults.rs runs what it judges by"),
    ("tests/faults/run --sample 12", "it builds the workspace with faults in it; .ci/run runs it"),
    (
        "fuzz/run scene 60",
        "it builds for a fuzzer, with a C++ compiler; tests/fuzz.rs runs the target itself",
    ),
    (
        "cargo run --release -p verify --example own_tracer",
        "it builds the example; tests/own.rs judges it, by its trait and over the pipe",
    ),
    (
        "cgt campaign run --plan docs/campaigns/hunt.toml --shard 1/100 --out shards",
        "it takes minutes; tests/campaign.rs runs smaller plans",
    ),
    (
        "docs/campaigns/slurm-submit docs/campaigns/hunt.toml shards 100 report --cpus-per-task=2",
        "it needs a cluster; tests/run --cluster runs it on one of its own",
    ),
    (
        "cgt campaign merge --plan docs/campaigns/hunt.toml shards --out report",
        "it needs all shards; tests/campaign.rs merges smaller ones",
    ),
    ("cargo run --release -- prove", "tests/proofs.rs proves the same; the line after it is run"),
    ("cargo run --release -- view 2juy", "it opens a window; tests/window.rs runs it"),
    (
        "verify/live/build --out live.wasm",
        "it needs Rust's library for WebAssembly; tests/live.rs runs it, where that is",
    ),
    (
        "cargo run --release -- verify 1hvr --plan fast --live live.wasm",
        "it needs what the line before makes; tests/live.rs runs it",
    ),
    ("cargo install --path verify", "it builds everything again, and changes the user's own folder"),
    ("cargo run --release -- report", "it takes five minutes; a small report is run in its place"),
    ("tests/sanitize miri", "it needs nightly Rust and minutes; tests/accesses.rs is what it runs"),
    (
        "tests/instructions",
        "it needs Valgrind; tests/instructions.rs runs its comparison on counts that are made up",
    ),
    (
        "tests/with-embree cargo run --release --features embree -- verify 1hvr --judges embree --size 640x360",
        "tests/embree.rs runs it, where there is an Embree",
    ),
    (
        "tests/with-embree cargo run --release --features embree,peers -- bench --peers embree,bvh,parry3d --threads 1 --curves --out fast",
        "it takes most of an hour, and Embree; tests/bench.rs runs all its parts on small pictures",
    ),
];

const FIRST_COMMAND: &str = "cargo run --release";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn readme() -> String {
    std::fs::read_to_string(root().join("README.md")).expect("there is a README.md")
}

/// The lines between ```` ```kind ```` and the closing fence, of each such block.
fn blocks(text: &str, kind: &str) -> Vec<Vec<String>> {
    let (mut blocks, mut open) = (Vec::new(), None);
    for line in text.lines() {
        match line.strip_prefix("```") {
            Some(kind) if open.is_none() => open = Some((kind.to_owned(), Vec::new())),
            Some(_) => blocks.extend(open.take()),
            None => {
                if let Some((_, lines)) = &mut open {
                    lines.push(line.to_owned());
                }
            }
        }
    }
    assert!(open.is_none(), "a fence is not closed");
    blocks.into_iter().filter(|(found, _)| found == kind).map(|(_, lines)| lines).collect()
}

/// What `cgt` is given by a command line of README, or `None` if it is none of `cgt`.
fn words(line: &str) -> Option<Vec<String>> {
    let rest = match line.strip_prefix("cargo run --release") {
        Some("") => "",
        Some(rest) => rest.strip_prefix(" -- ")?,
        None => line.strip_prefix("cgt ")?,
    };
    shlex::split(rest)
}

/// Runs a command line in a new folder that has the files which README takes for the user's own.
fn run(line: &str) -> (TempDir, Output) {
    let desk = tempfile::tempdir().expect("a temporary folder");
    std::fs::create_dir(desk.path().join("docs")).expect("made");
    let bundled = ENTRIES.iter().find_map(|entry| match entry.data {
        Data::Bundled("2juy.pdb.gz", bytes) => Some(bytes),
        _ => None,
    });
    std::fs::write(desk.path().join("molecule.pdb.gz"), bundled.expect("bundled")).expect("written");
    let path = "2\none\nC 0 0 0\nO 1.2 0 0\n2\ntwo\nC 0 0 0\nO 1.3 0 0\n";
    std::fs::write(desk.path().join("path.xyz"), path).expect("written");
    for folder in ["tests/cases", "verify/examples"] {
        let copies = desk.path().join(folder);
        std::fs::create_dir_all(&copies).expect("made");
        for file in std::fs::read_dir(root().join(folder)).expect("it is there") {
            let file = file.expect("an entry");
            std::fs::copy(file.path(), copies.join(file.file_name())).expect("copied");
        }
    }
    let words =
        words(line).unwrap_or_else(|| panic!("README names a command this test does not know: {line}"));
    // The seed that README's drawings were made with.
    let mut command = Command::new(env!("CARGO_BIN_EXE_cgt"));
    let output = command.args(words).current_dir(desk.path()).env("CGT_SEED", "1").output();
    (desk, output.expect("the program starts"))
}

/// README's first command at its full size, run once for the tests that ask about it.
fn first() -> &'static (TempDir, Output) {
    static FIRST: OnceLock<(TempDir, Output)> = OnceLock::new();
    FIRST.get_or_init(|| run(FIRST_COMMAND))
}

#[test]
fn commands_work_and_pictures_come_out_again() {
    let commands: Vec<String> = blocks(&readme(), "sh").concat();
    assert!(commands.len() > NOT_RUN.len(), "README has hardly a command");
    for (line, why) in NOT_RUN {
        assert!(
            commands.iter().any(|command| command == line),
            "{line} ({why}) is exempt and does not occur"
        );
        let script = line.split(' ').next().unwrap_or_default();
        assert!(
            ["cargo", "cgt"].contains(&script) || executable(&root().join(script)),
            "{line} cannot be run"
        );
    }
    let mut pictures = drawn(&root().join("docs"));
    assert!(!pictures.is_empty(), "README has pictures");
    let lines: Vec<&String> =
        commands.iter().filter(|line| NOT_RUN.iter().all(|(exempt, _)| exempt != line)).collect();
    // Side by side, each in a folder of its own.
    let own = |line: &&String| (line.as_str() != FIRST_COMMAND).then(|| run(line));
    let ran: Vec<_> = lines.par_iter().with_max_len(1).map(own).collect();
    for (line, own) in lines.into_iter().zip(&ran) {
        let (desk, output) = own.as_ref().unwrap_or_else(|| first());
        let said = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        // The paper's plan is shown because it is wrong: a mismatch.
        let mut code = i32::from(line.contains("--plan paper"));
        let asks_solvers = [" prove", " claims"].iter().any(|word| line.contains(word));
        if asks_solvers && Solver::all().is_empty() {
            eprintln!("not judged: `{line}`: no solver was found");
            code = 3;
        }
        assert_eq!(
            output.status.code(),
            Some(code),
            "{line}: {}{}",
            said(&output.stdout),
            said(&output.stderr)
        );
        let made = [drawn(&desk.path().join("docs")), drawn(&desk.path().join("cgt-report"))].concat();
        pictures.retain(|picture| {
            !made.iter().any(|made| made.file_name() == picture.file_name() && same(made, picture))
        });
    }
    assert!(pictures.is_empty(), "no command of README makes these, as they are: {pictures:?}");
}

fn drawn(folder: &Path) -> Vec<PathBuf> {
    let entries =
        std::fs::read_dir(folder).into_iter().flatten().map(|entry| entry.expect("an entry").path());
    entries
        .filter(|path| path.extension().is_some_and(|extension| extension == "png" || extension == "svg"))
        .collect()
}

/// Whether two files hold the same pixels, however packed, or the same drawing.
fn same(one: &Path, other: &Path) -> bool {
    if one.extension().is_some_and(|extension| extension == "svg") {
        let text = |path: &Path| std::fs::read_to_string(path).expect("a drawing");
        return text(one) == text(other);
    }
    let bytes = |path: &Path| std::fs::read(path).expect("a picture");
    // Of an animation all frames count, and it is packed in one way.
    if bytes(other).windows(4).any(|word| word == b"acTL") {
        return bytes(one) == bytes(other);
    }
    let pixels = |path: &Path| image::open(path).expect("a picture").to_rgba8();
    pixels(one) == pixels(other)
}

#[cfg(unix)]
fn executable(path: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    path.metadata().is_ok_and(|data| data.is_file() && data.permissions().mode() & 0o111 == 0o111)
}

#[cfg(not(unix))]
fn executable(path: &Path) -> bool {
    path.is_file()
}

#[test]
fn what_the_first_command_prints_is_what_is_shown() {
    let shown = blocks(&readme(), "text");
    let [shown] = shown.as_slice() else { panic!("one block shows output, not {}", shown.len()) };
    let printed = String::from_utf8(first().1.stdout.clone()).expect("UTF-8");
    let printed: Vec<_> = printed.lines().map(without_speed).collect();
    let shown: Vec<_> = shown.iter().map(|line| without_speed(line)).collect();
    assert_eq!(shown, printed, "left as README shows it, right as it is printed");
}

/// A row of the table without the blanks and the last column, which is time's; other lines as they are.
fn without_speed(line: &str) -> String {
    let mut cells: Vec<_> = line.split_ascii_whitespace().collect();
    if line.starts_with("1hvr ") {
        let speed = cells.pop().unwrap_or_default();
        assert!(speed.parse::<f64>().is_ok_and(|speed| speed > 0.0), "a speed ends the row: {line}");
    }
    cells.join(" ")
}

#[test]
fn the_table_of_claims_is_the_programs() {
    let text = readme();
    let (_, rest) = text.split_once("<!-- claims -->\n").expect("the table's beginning is marked");
    let (table, _) = rest.split_once("<!-- /claims -->").expect("and its end");
    assert_eq!(table, verify::claims::markdown(), "replace README's table by the right one");
    for claim in verify::claims::claims() {
        if let Some(test) = claim.how.strip_prefix("cargo test --test ") {
            assert!(
                root().join(format!("tests/{test}.rs")).is_file(),
                "{}: there is no such test",
                claim.how
            );
        }
    }
}

/// What a heading is called in a link.
fn anchor(line: &str) -> Option<String> {
    let heading = line.strip_prefix("## ")?.to_lowercase().replace(' ', "-");
    Some(heading.chars().filter(|c| c.is_alphanumeric() || *c == '-').collect())
}

/// The piece of Rust is the one that `cargo test --doc` runs.
#[test]
fn the_example_in_rust_is_one_that_runs() {
    let text = readme();
    let (_, rest) = text.split_once("```rust\n").expect("there is a piece of Rust");
    let (shown, rest) = rest.split_once("```\n").expect("and its end");
    assert!(!rest.contains("```rust"), "there is one");
    let path = root().join("optimized/src/lib.rs");
    let source = std::fs::read_to_string(path).expect("it is there");
    let run: Vec<&str> = source
        .lines()
        .skip_while(|line| *line != "/// ```")
        .skip(1)
        .take_while(|line| *line != "/// ```")
        .filter_map(|line| line.strip_prefix("///"))
        .map(|line| line.strip_prefix(' ').unwrap_or(line))
        .filter(|line| !line.starts_with("# "))
        .collect();
    assert_eq!(shown.lines().collect::<Vec<_>>(), run, "README shows `optimized::Tracer`'s example");
}

#[test]
fn links_lead_somewhere() {
    let text = readme();
    let mut seen = 0;
    for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        seen += 1;
        let there = match target.strip_prefix('#') {
            Some(heading) => text.lines().any(|line| anchor(line) == Some(heading.into())),
            None => target.starts_with("https://") || root().join(target).exists(),
        };
        assert!(there, "README links to {target}, which is not there");
    }
    assert!(seen >= 10, "only {seen} links were found");
}

#[test]
fn every_folder_is_on_the_map() {
    let text = readme();
    for folder in ["verify/contract", "reference", "optimized", "verify", "tests", "fuzz"] {
        assert!(root().join(folder).is_dir(), "{folder} is no folder");
        assert!(text.contains(&format!("| [`{folder}`](")), "{folder} is not on the map");
    }
}
