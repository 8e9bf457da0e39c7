//! Lines and words of a text file, each knowing where it stands. Bytes come in, numbers go out; what is
//! refused is named with file, line, column and value. Lines end in LF, CR or both, the last one may lack it;
//! bytes that are no UTF-8 are kept, since only names and comments have them.

use super::{Place, ReadError};

/// The lines of a file, in order.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    file: &'a str,
    rest: &'a [u8],
    number: usize,
    /// Whether the file ends in the last line given without an end of line: it may have been cut.
    open: bool,
}

/// One line without its end.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub(super) file: &'a str,
    /// From 1.
    pub(super) number: usize,
    pub(super) text: &'a [u8],
}

/// Some bytes of a line.
#[derive(Clone, Copy)]
pub(super) struct Word<'a> {
    line: Line<'a>,
    start: usize,
    pub(super) text: &'a [u8],
}

impl<'a> Lines<'a> {
    /// Refuses a file with a zero byte, and one of white space only.
    pub(super) fn new(file: &'a str, format: &'static str, bytes: &'a [u8]) -> Result<Self, ReadError> {
        if let Some(byte) = bytes.iter().position(|&b| b == 0) {
            return Err(ReadError::Binary { file: file.into(), format, byte });
        }
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err(ReadError::Empty { file: file.into() });
        }
        Ok(Self { file, rest: bytes, number: 0, open: false })
    }

    /// Bytes that are not yet read.
    pub(super) fn left(&self) -> usize {
        self.rest.len()
    }

    /// Whether an error may come of the file's having been cut within its last line.
    pub(super) fn cut_by(&self, error: &ReadError) -> bool {
        self.open && matches!(error, ReadError::Value { .. } | ReadError::Missing { .. })
    }

    /// Number of the last line given.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// Whether nothing but white space is left.
    pub(super) fn only_blank_left(&self) -> bool {
        self.rest.iter().all(u8::is_ascii_whitespace)
    }
}

/// The ends of a line, the longest first.
const ENDS: [&[u8]; 4] = [b"\r\r\n", b"\r\n", b"\r", b"\n"];

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|&b| matches!(b, b'\n' | b'\r'));
        self.open = end.is_none();
        let (text, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        // CR CR LF is what becomes of CR LF where LF is written as CR LF once more.
        let end = ENDS.iter().find_map(|end| rest.strip_prefix(*end));
        self.rest = end.unwrap_or(rest);
        Some(Line { file: self.file, number: self.number, text })
    }
}

impl<'a> Line<'a> {
    /// Words between white space.
    pub(super) fn words(self) -> impl Iterator<Item = Word<'a>> {
        let mut at = 0;
        std::iter::from_fn(move || {
            let start = at + self.text[at..].iter().position(|b| !b.is_ascii_whitespace())?;
            let length = self.text[start..].iter().position(u8::is_ascii_whitespace);
            at = length.map_or(self.text.len(), |n| start + n);
            Some(Word { line: self, start, text: &self.text[start..at] })
        })
    }

    /// The bytes in columns `first` to `last`, counted from 1, as far as the line goes, without the white
    /// space round them.
    pub(super) fn columns(self, first: usize, last: usize) -> Word<'a> {
        let end = last.min(self.text.len());
        let start = (first - 1).min(end);
        let field = &self.text[start..end];
        let start = start + field.iter().take_while(|b| b.is_ascii_whitespace()).count();
        Word { line: self, start, text: field.trim_ascii() }
    }

    /// The next word, or the error that `field` is missing.
    pub(super) fn take(
        self,
        words: &mut impl Iterator<Item = Word<'a>>,
        field: &'static str,
        want: &'static str,
    ) -> Result<Word<'a>, ReadError> {
        words.next().ok_or_else(|| self.missing(field, want))
    }

    /// Three finite numbers.
    pub(super) fn vector(
        self,
        words: &mut impl Iterator<Item = Word<'a>>,
        fields: [&'static str; 3],
    ) -> Result<[f32; 3], ReadError> {
        let mut out = [0.0; 3];
        for (out, field) in out.iter_mut().zip(fields) {
            *out = self.take(words, field, NUMBER)?.number(field)?;
        }
        Ok(out)
    }

    pub(super) fn missing(self, field: &'static str, want: &'static str) -> ReadError {
        ReadError::Missing { place: self.place(self.text.len()), field, want }
    }

    pub(super) fn place(self, start: usize) -> Place {
        Place { file: self.file.into(), line: self.number, column: start + 1 }
    }
}

/// What a coordinate must be.
pub(super) const NUMBER: &str = "a finite number within f32 must stand here";
/// What a radius must be.
pub(super) const RADIUS: &str = "a radius must be finite and above 0 in f32";
/// What a count must be.
pub(super) const COUNT: &str = "a whole number from 0 must stand here";

impl Word<'_> {
    /// The text for people; bytes that are no UTF-8 are replaced.
    pub(super) fn shown(self) -> String {
        String::from_utf8_lossy(&self.text[..self.text.len().min(40)]).into_owned()
    }

    pub(super) fn wrong(self, field: &'static str, want: &'static str) -> ReadError {
        ReadError::Value { place: self.line.place(self.start), field, value: self.shown(), want }
    }

    fn parse<T: std::str::FromStr>(self) -> Option<T> {
        std::str::from_utf8(self.text).ok()?.parse().ok()
    }

    /// A finite f32, the nearest to the decimal that stands there.
    pub(super) fn number(self, field: &'static str) -> Result<f32, ReadError> {
        self.parse().filter(|x: &f32| x.is_finite()).ok_or_else(|| self.wrong(field, NUMBER))
    }

    /// A finite f32 above zero.
    pub(super) fn radius(self, field: &'static str) -> Result<f32, ReadError> {
        let radius: Option<f32> = self.parse();
        radius.filter(|x| x.is_finite() && *x > 0.0).ok_or_else(|| self.wrong(field, RADIUS))
    }

    /// A whole number.
    pub(super) fn whole(self, field: &'static str) -> Result<u64, ReadError> {
        self.parse().ok_or_else(|| self.wrong(field, COUNT))
    }

    /// A count of things of at least `each` bytes, which must fit in the bytes `left`.
    pub(super) fn count(self, field: &'static str, each: usize, left: usize) -> Result<usize, ReadError> {
        let count = self.whole(field)?;
        let place = self.line.place(self.start);
        let room = u64::try_from(left / each).unwrap_or(u64::MAX);
        match usize::try_from(count) {
            Ok(n) if count <= room => Ok(n),
            _ => Err(ReadError::Count { place, field, count, left }),
        }
    }
}
