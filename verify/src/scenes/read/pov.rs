//! Lists of spheres written for POV-Ray, one a line: `sphere {<x,y,z>,r}`, where r may be the name of a constant.
//! This is no reader of the scene language: every other line is passed over, and a radius that is a name is drawn as
//! [`NAMED_RADIUS`] with a warning. A line that begins as a sphere and is none is refused; a sphere that stands elsewhere in a line,
//! as in `union { sphere {<x,y,z>,r} }`, is passed over with a warning. One on a line of its own, within braces that were opened before, is
//! drawn where it stands there, with a warning too. What is commented out, by `//` or `/* */`, is not there.
//!
//! POV-Ray's coordinates are left-handed, and lists like the teapot's have z up. y and z are exchanged, which makes
//! them right-handed, so that pictures are not mirrored, with y up.

use super::frames::{Frames, Input};
use super::text::{Line, Lines};
use super::{Format, Loaded, ReadError};
use contract::Sphere;
use std::borrow::Cow;

/// The radius where the file gives a name: that of POV-Ray's own example with the teapot.
pub(super) const NAMED_RADIUS: f32 = 0.05;
const WANT: &str = "a line of spheres must read: sphere {<x,y,z>,r}";

pub(super) fn read(input: Input<'_>) -> Result<Loaded, ReadError> {
    let Input { file, bytes, .. } = input;
    let mut frames = Frames::new(input);
    let mut spheres = Vec::new();
    let (mut named, mut passed, mut within, mut comment) = (None, None, None, Comment::default());
    let mut depth = 0_usize;
    for line in Lines::new(file, "POV-Ray spheres", bytes)? {
        let code = comment.blanked(line);
        let line = Line { text: &code, ..line };
        let rest = line.text.trim_ascii_start().strip_prefix(b"sphere");
        if rest.and_then(<[u8]>::first).is_some_and(|b| *b == b'{' || b.is_ascii_whitespace()) {
            frames.put(&mut spheres, sphere(line, &mut named)?, 0)?;
            if depth > 0 {
                within.get_or_insert((line.number, 0)).1 += 1;
            }
        } else if has_sphere(line.text) {
            passed.get_or_insert((line.number, 0)).1 += 1;
        }
        for brace in line.text {
            match brace {
                b'{' => depth += 1,
                b'}' => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
    }
    if let Some((line, number)) = within {
        let said =
            "spheres within braces that were opened before: what moves or cuts them there is not heeded";
        frames.warn(Some(line), format!("{number} {said}"));
    }
    if let Some((line, lines)) = passed {
        frames.warn(Some(line), format!("{lines} lines with a sphere that do not begin with it passed over"));
    }
    if comment.depth > 0 {
        frames.warn(Some(comment.begun), "a comment that does not end; what follows is passed over");
    }
    if let Some((line, name)) = named {
        frames.warn(Some(line), format!("radius {name:?} is a name; {NAMED_RADIUS} is used for it"));
    }
    if !spheres.is_empty() {
        frames.push(spheres)?;
    }
    frames.finish(Format::Pov, "no line with a sphere")
}

/// Whether the word occurs, and not as a part of another.
fn has_sphere(code: &[u8]) -> bool {
    code.split(|&b| !b.is_ascii_alphanumeric() && b != b'_').any(|word| word == b"sphere")
}

/// How many comments are open, since they may stand in each other, and the line where the outermost began.
#[derive(Default)]
struct Comment {
    depth: usize,
    begun: usize,
}

impl Comment {
    /// A line with blanks where comments and strings are, so that its columns stay what they were.
    fn blanked<'a>(&mut self, line: Line<'a>) -> Cow<'a, [u8]> {
        let mut code = Cow::Borrowed(line.text);
        let (mut at, mut quoted) = (0, false);
        while at < line.text.len() {
            let rest = &line.text[at..];
            let (length, is_code) = match rest {
                [b'/', b'*', ..] if !quoted => {
                    if self.depth == 0 {
                        self.begun = line.number;
                    }
                    self.depth += 1;
                    (2, false)
                }
                [b'*', b'/', ..] if self.depth > 0 => {
                    self.depth -= 1;
                    (2, false)
                }
                [b'/', b'/', ..] if !quoted && self.depth == 0 => (rest.len(), false),
                [b'\\', _, ..] if quoted => (2, false),
                [b'"', ..] if self.depth == 0 => {
                    quoted = !quoted;
                    (1, true)
                }
                _ => (1, !quoted && self.depth == 0),
            };
            if !is_code {
                code.to_mut()[at..at + length].fill(b' ');
            }
            at += length;
        }
        code
    }
}

fn sphere(line: Line<'_>, named: &mut Option<(usize, String)>) -> Result<Sphere, ReadError> {
    let delimiter = |b: &u8| matches!(b, b'<' | b'>' | b'{' | b'}' | b',');
    let mut fields = Vec::new();
    let mut start = line.text.iter().position(delimiter);
    // Four fields make a sphere, a fifth spoils it, and more are not looked at.
    while let Some(first) = start.filter(|_| fields.len() < 5) {
        start = line.text[first + 1..].iter().position(delimiter).map(|n| first + 1 + n);
        let field = start.map(|end| line.columns(first + 2, end));
        fields.extend(field.filter(|word| !word.text.is_empty()));
    }
    let [x, y, z, r] = fields[..] else { return Err(line.missing("sphere", WANT)) };
    let center = [x.number("x")?, y.number("y")?, z.number("z")?];
    let center = [center[0], center[2], center[1]];
    let is_name = r.text[0].is_ascii_alphabetic() && r.number("radius").is_err();
    let radius = if is_name && !names_no_number(r.text) {
        named.get_or_insert_with(|| (line.number, r.shown()));
        NAMED_RADIUS
    } else {
        r.radius("radius")?
    };
    let color = [214, 190, 150];
    Ok(Sphere { center, radius, color })
}

/// Words that stand for no finite number.
fn names_no_number(text: &[u8]) -> bool {
    [&b"nan"[..], b"inf", b"infinity"].iter().any(|word| text.eq_ignore_ascii_case(word))
}
