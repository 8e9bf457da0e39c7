//! The verdict for the terminal: one line for each subject on each scene, columns aligned, at most
//! [`TEXT_WIDTH`] columns wide, with or without colour. A [`Report`] comes in, text with a newline at its end goes
//! out. Long names end in an ellipsis; control characters in them are replaced, so no name can steer a terminal.

use super::outside::sentences;
use super::words::{NONE, count, mega_rays, sign, word};
use super::{Report, SceneReport, SubjectReport};
use crate::verdict::Verdict;
use anstyle::{AnsiColor, Style};
use textwrap::core::display_width;

/// The widest line, in columns.
pub const TEXT_WIDTH: usize = 100;

/// Columns of the table: heading and the most it may take. With one space between them and two for the margin
/// the whole is within [`TEXT_WIDTH`].
const COLUMNS: [(&str, usize); 8] = [
    ("scene", 18),
    ("subject", 23),
    ("verdict", 14),
    ("ids", 7),
    ("t", 8),
    ("colour", 8),
    ("ulp max", 8),
    ("Mray/s", 7),
];
/// Columns from here on are numbers and stand to the right.
const FIRST_NUMBER: usize = 3;

/// The report as a short table. `color` adds ANSI escapes to the verdicts.
#[must_use]
pub fn text(report: &Report, color: bool) -> String {
    let mut rows = Vec::new();
    for film in report.scenes.chunk_by(SceneReport::is_followed_by) {
        match film {
            [scene] => rows.extend(scene.subjects.iter().map(|s| (s.verdict, cells(scene, s)))),
            _ => rows.extend(film[0].subjects.iter().map(|subject| summed(film, &subject.name))),
        }
    }
    let widths: [usize; 8] = std::array::from_fn(|k| {
        let (heading, limit) = COLUMNS[k];
        let widest = rows.iter().map(|(_, row)| display_width(&row[k])).max().unwrap_or(0);
        widest.max(heading.len()).min(limit)
    });
    let mut text = line(&COLUMNS.map(|(heading, _)| heading.to_owned()), &widths, Style::new());
    for (verdict, row) in &rows {
        text += &line(row, &widths, style(*verdict, color));
    }
    text += &ending(report, color);
    text
}

fn cells(scene: &SceneReport, subject: &SubjectReport) -> [String; 8] {
    let frame = if scene.frames > 1 { format!(" #{}", scene.frame) } else { String::new() };
    let verdict = format!("{} {}", sign(subject.verdict), word(subject.verdict));
    let counts = subject.comparison.as_ref().map(|c| [c.wrong_ids, c.wrong_t, c.wrong_color, c.t_ulp.max]);
    let [ids, t, colors, ulp] = counts.map_or_else(|| [NONE; 4].map(str::to_owned), |c| c.map(brief));
    let room = COLUMNS[0].1 - frame.len().min(COLUMNS[0].1);
    let scene = clipped(&scene.name, room) + &frame;
    [scene, subject.name.clone(), verdict, ids, t, colors, ulp, mega_rays(subject.rays_per_second)]
}

/// A subject over all frames of a film: the worst verdict, sums, and the largest error.
fn summed(film: &[SceneReport], name: &str) -> (Verdict, [String; 8]) {
    let all: Vec<&SubjectReport> =
        film.iter().flat_map(|scene| &scene.subjects).filter(|subject| subject.name == name).collect();
    let verdict = Verdict::worst_of(all.iter().map(|subject| subject.verdict));
    let compared: Vec<_> = all.iter().filter_map(|subject| subject.comparison.as_ref()).collect();
    let sum = |of: fn(&crate::verdict::Comparison) -> u64| brief(compared.iter().map(|c| of(c)).sum());
    let most = brief(compared.iter().map(|c| c.t_ulp.max).max().unwrap_or(0));
    let counts = if compared.is_empty() {
        [NONE; 4].map(str::to_owned)
    } else {
        [sum(|c| c.wrong_ids), sum(|c| c.wrong_t), sum(|c| c.wrong_color), most]
    };
    let [ids, t, colors, ulp] = counts;
    let frames = format!(" #{}-{}", film[0].frame, film[film.len() - 1].frame);
    let scene = clipped(&film[0].name, COLUMNS[0].1 - frames.len().min(COLUMNS[0].1)) + &frames;
    let seconds: Option<f64> = all.iter().map(|subject| subject.seconds).sum();
    let pixels: u64 = compared.iter().map(|c| c.pixels).sum();
    let speed = mega_rays(seconds.filter(|_| pixels > 0).map(|seconds| pixels as f64 / seconds));
    (
        verdict,
        [scene, name.to_owned(), format!("{} {}", sign(verdict), word(verdict)), ids, t, colors, ulp, speed],
    )
}

/// A count in at most seven columns.
fn brief(value: u64) -> String {
    #[allow(clippy::cast_precision_loss, reason = "three digits are shown")]
    if value < 1_000_000 { count(value) } else { format!("{:.1e}", value as f64) }
}

fn line(row: &[String; 8], widths: &[usize; 8], verdict: Style) -> String {
    let cell = |k: usize| {
        let shown = clipped(&row[k], widths[k]);
        let blank = " ".repeat(widths[k] - display_width(&shown));
        match k {
            2 => format!("{verdict}{shown}{verdict:#}{blank}"),
            FIRST_NUMBER.. => blank + &shown,
            _ => shown + &blank,
        }
    };
    let line = (0..row.len()).map(cell).collect::<Vec<_>>().join(" ");
    format!("{}\n", line.trim_end())
}

/// What outside witnesses said, why someone was not judged, who did not judge, and the word for the whole.
fn ending(report: &Report, color: bool) -> String {
    let films = report.scenes.chunk_by(SceneReport::is_followed_by);
    let said = films.flat_map(|film| sentences(&film.iter().collect::<Vec<_>>()));
    let said: String = said.map(|line| wrapped(&line) + "\n").collect();
    let silent =
        report.scenes.iter().flat_map(|scene| scene.subjects.iter().map(move |subject| (scene, subject)));
    let silent = silent.filter(|(_, subject)| subject.verdict == Verdict::NotJudged);
    let why = silent
        .map(|(scene, subject)| format!("{} on {}: {}", subject.name, scene.called(1), subject.because));
    let why: String = why.map(|line| wrapped(&line) + "\n").collect();
    let broken = report
        .broken
        .iter()
        .map(|line| wrapped(&format!("Wrong where it promised not to be: {line}")) + "\n");
    let broken: String = broken.collect();
    let absent = report.absent.iter().map(|absent| format!("{}: not judged. {}", absent.judge, absent.why));
    let absent: String = absent.map(|line| wrapped(&line) + "\n").collect();
    let verdict = style(report.verdict, color);
    format!(
        "{said}{why}{broken}{absent}{verdict}{} {}{verdict:#}\n",
        sign(report.verdict),
        word(report.verdict)
    )
}

pub(crate) fn wrapped(line: &str) -> String {
    textwrap::fill(&tame(line), textwrap::Options::new(TEXT_WIDTH).subsequent_indent("  "))
}

fn tame(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

/// The text in at most that many columns, with an ellipsis for what is left out.
pub(crate) fn clipped(text: &str, width: usize) -> String {
    let text = tame(text);
    if display_width(&text) <= width {
        return text;
    }
    let mut short = String::new();
    for c in text.chars() {
        let longer = format!("{short}{c}");
        if display_width(&longer) + 1 > width {
            break;
        }
        short = longer;
    }
    short + "…"
}

pub(crate) fn style(verdict: Verdict, color: bool) -> Style {
    let shade = match verdict {
        Verdict::Equal => AnsiColor::Green,
        Verdict::WithinBound => AnsiColor::Cyan,
        Verdict::Undecidable | Verdict::NotJudged => AnsiColor::Yellow,
        Verdict::Wrong => AnsiColor::Red,
    };
    if color { shade.on_default().bold() } else { Style::new() }
}
