//! Shapes into an `<svg>` element: a width and a height go in, then shapes with their classes, and text comes out.
//!
//! Colours are the page's: shapes have classes, and `templates/figures.css` says what a class looks like in light, in the dark and on
//! paper. Lengths are in pixels of a figure 720 wide. [`alone`] makes a file that carries its style with it.

use crate::plot::escaped;
use std::fmt::Write as _;

/// Width of every figure.
pub(super) const WIDTH: f64 = 720.0;
/// Where captions of panels and legends begin.
pub(super) const LEFT: f64 = 10.0;
/// About how wide a letter is.
const LETTER: f64 = 6.4;
/// From one line of text to the next.
const LINE: f64 = 20.0;

const STYLE: &str = include_str!("../../templates/figures.css");

/// A figure under work.
#[derive(Debug)]
pub(super) struct Svg {
    body: String,
    label: String,
    height: f64,
}

/// What stands beside a word of a legend.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sign {
    /// A small square.
    Box(&'static str),
    /// A small circle.
    Round(&'static str),
    /// A short line.
    Stroke(&'static str),
}

impl Svg {
    /// Nothing yet; `label` is what the figure is called by those who do not see it.
    pub(super) fn new(label: &str) -> Self {
        Self { body: String::new(), label: label.into(), height: 0.0 }
    }

    pub(super) fn raw(&mut self, text: &str) {
        self.body += text;
    }

    /// A rectangle by its upper left corner, width and height.
    pub(super) fn rect(&mut self, class: &str, [x, y]: [f64; 2], [width, height]: [f64; 2]) {
        _ = write!(
            self.body,
            "<rect class=\"{class}\" x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\"/>"
        );
        self.reaches(y + height);
    }

    pub(super) fn line(&mut self, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        _ = write!(
            self.body,
            "<line class=\"{class}\" x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\"/>"
        );
        self.reaches(y1.max(y2));
    }

    /// A circle; `title` is shown where a pointer rests on it.
    pub(super) fn circle(&mut self, class: &str, [x, y]: [f64; 2], r: f64, title: Option<&str>) {
        _ = write!(self.body, "<circle class=\"{class}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{r:.2}\"");
        self.body += &match title {
            Some(title) => format!("><title>{}</title></circle>", escaped(title)),
            None => "/>".into(),
        };
    }

    /// An area within points.
    pub(super) fn polygon(&mut self, class: &str, points: &[[f64; 2]]) {
        let points: Vec<String> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
        _ = write!(self.body, "<polygon class=\"{class}\" points=\"{}\"/>", points.join(" "));
    }

    /// Words; `anchor` is `start`, `middle` or `end`.
    pub(super) fn words(&mut self, class: &str, anchor: &str, [x, y]: [f64; 2], text: &str) {
        _ = write!(
            self.body,
            "<text class=\"{class}\" text-anchor=\"{anchor}\" x=\"{x:.2}\" y=\"{y:.2}\">{}</text>",
            escaped(text)
        );
        self.reaches(y + 6.0);
    }

    /// What follows, up to [`Svg::end`], is cut off outside a rectangle; `name` is one that no other figure of a page has.
    pub(super) fn clipped(&mut self, name: &str, [x, y]: [f64; 2], [width, height]: [f64; 2]) {
        _ = write!(
            self.body,
            "<clipPath id=\"{name}\"><rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\"/></clipPath><g clip-path=\"url(#{name})\">"
        );
        self.reaches(y + height);
    }

    pub(super) fn end(&mut self) {
        self.body += "</g>";
    }

    /// Signs with their words, from left to right and in as many lines as that takes; where the next thing may stand.
    pub(super) fn legend(&mut self, top: f64, entries: &[(Sign, &str)]) -> f64 {
        let (mut x, mut y) = (LEFT, top + 12.0);
        for (sign, text) in entries {
            let width = 24.0 + LETTER * text.chars().count() as f64 + 18.0;
            if x + width > WIDTH && x > LEFT {
                (x, y) = (LEFT, y + LINE);
            }
            match sign {
                Sign::Box(class) => self.rect(class, [x, y - 11.0], [16.0, 13.0]),
                Sign::Round(class) => self.circle(class, [x + 8.0, y - 4.0], 6.5, None),
                Sign::Stroke(class) => self.line(class, [x, y - 4.0], [x + 17.0, y - 4.0]),
            }
            self.words("", "start", [x + 24.0, y], text);
            x += width;
        }
        y + 10.0
    }

    fn reaches(&mut self, y: f64) {
        self.height = self.height.max(y);
    }

    /// The element.
    pub(super) fn finish(self) -> String {
        let Self { body, label, height } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"figure\" viewBox=\"0 0 {WIDTH} {:.0}\" role=\"img\" aria-label=\"{}\">{body}</svg>",
            (height + 4.0).ceil(),
            escaped(&label)
        )
    }
}

/// A figure as a file of its own, in the colours of its reader's choice.
#[must_use]
pub fn alone(svg: &str) -> String {
    crate::plot::alone(svg, STYLE)
}
