//! Points by two measures, both the better the smaller: error to the right, time upward. The points that no other one beats in both are
//! joined by a line, the Pareto front.

use super::scale::{Scale, Scaling, has_place};
use super::{begin, escaped, line, words};
use std::fmt::Write;

/// A point.
#[derive(Clone, Debug)]
pub(crate) struct Dot {
    /// What it is called.
    pub(crate) label: String,
    /// What is shown of it to who points at it.
    pub(crate) told: String,
    /// Its class in the page's style.
    pub(crate) class: &'static str,
    /// Its shape, so that it is told apart without colour.
    pub(crate) shape: Shape,
    /// Error and time.
    pub(crate) at: [f64; 2],
    /// Whether its name stands beside it.
    pub(crate) named: bool,
}

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 690.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 390.0;
const LETTER: f64 = 6.7;
const HIGH: f64 = 15.0;

/// Which of some points no other one beats: none is at least as good in both and better in one.
#[must_use]
pub(crate) fn front(points: &[[f64; 2]]) -> Vec<bool> {
    let beats = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[0] && a[1] <= b[1] && a != b;
    points.iter().map(|point| !points.iter().any(|other| beats(other, point))).collect()
}

/// The chart.
#[must_use]
pub(crate) fn scatter(title: &str, [x_title, y_title]: [&str; 2], dots: &[Dot]) -> Option<String> {
    let dots: Vec<&Dot> = dots
        .iter()
        .filter(|dot| has_place(dot.at[0], Scaling::WithZero) && has_place(dot.at[1], Scaling::Logarithmic))
        .collect();
    let x =
        Scale::over(dots.iter().map(|dot| dot.at[0]), [LEFT + 24.0, RIGHT - 12.0], true, Scaling::WithZero)?;
    let y = Scale::over(dots.iter().map(|dot| dot.at[1]), [BOTTOM - 8.0, TOP], true, Scaling::Logarithmic)?;
    let mut svg = begin([WIDTH, HEIGHT], title);
    for value in y.ticks() {
        let at = y.at(value);
        line(&mut svg, "grid", [LEFT, at], [RIGHT, at]);
        words(&mut svg, "end", [LEFT - 8.0, at + 4.0], &super::power(value));
    }
    for value in x.ticks() {
        let at = x.at(value);
        line(&mut svg, if value == 0.0 { "axis" } else { "grid" }, [at, TOP], [at, BOTTOM]);
        words(&mut svg, "middle", [at, BOTTOM + 18.0], &super::power(value));
    }
    words(&mut svg, "middle", [(LEFT + RIGHT) / 2.0, HEIGHT - 8.0], x_title);
    words(&mut svg, "start", [8.0, 14.0], y_title);
    let at: Vec<[f64; 2]> = dots.iter().map(|dot| dot.at).collect();
    let mut best: Vec<[f64; 2]> =
        at.iter().zip(front(&at)).filter(|(_, best)| *best).map(|(point, _)| *point).collect();
    best.sort_by(|a, b| a[0].total_cmp(&b[0]));
    best.dedup();
    // To the right and upward of the front all is beaten.
    let mut path = best.first().map_or_else(String::new, |first| format!("{:.1},{TOP:.1}", x.at(first[0])));
    let mut before = None;
    for [error, time] in &best {
        let [px, py] = [x.at(*error), y.at(*time)];
        if let Some(before) = before {
            _ = write!(path, " {px:.1},{before:.1}");
        }
        _ = write!(path, " {px:.1},{py:.1}");
        before = Some(py);
    }
    if let Some(before) = before {
        _ = write!(path, " {RIGHT:.1},{before:.1}");
    }
    _ = write!(svg, "<polyline class=\"front\" points=\"{path}\"/>");
    let mut taken: Vec<[f64; 4]> =
        at.iter().map(|p| [x.at(p[0]) - 6.0, y.at(p[1]) - 6.0, x.at(p[0]) + 6.0, y.at(p[1]) + 6.0]).collect();
    for dot in &dots {
        let [px, py] = [x.at(dot.at[0]), y.at(dot.at[1])];
        _ = write!(svg, "<g class=\"dot {}\"><title>{}</title>", dot.class, escaped(&dot.told));
        dot.shape.draw(&mut svg, [px, py]);
        svg += "</g>";
    }
    for dot in dots.iter().filter(|dot| dot.named) {
        let [px, py] = [x.at(dot.at[0]), y.at(dot.at[1])];
        if let Some((anchor, place, room)) = room(&dot.label, [px, py], &taken) {
            taken.push(room);
            words(&mut svg, anchor, place, &dot.label);
        }
    }
    Some(svg + "</svg>")
}

/// A place for a name that covers nothing: right, left, above or below its point; none if all are taken.
fn room(label: &str, [x, y]: [f64; 2], taken: &[[f64; 4]]) -> Option<(&'static str, [f64; 2], [f64; 4])> {
    #[allow(clippy::cast_precision_loss, reason = "short words")]
    let wide = label.chars().count() as f64 * LETTER;
    let rows = [0.0, -14.0, 14.0, -26.0, 26.0];
    let places = rows.into_iter().flat_map(|up| {
        [
            ("start", [x + 10.0, y + 4.0 + up], [x + 8.0, x + 10.0 + wide]),
            ("end", [x - 10.0, y + 4.0 + up], [x - 10.0 - wide, x - 8.0]),
        ]
    });
    places.into_iter().find_map(|(anchor, place, [from, to])| {
        let own = [from, place[1] - HIGH + 3.0, to, place[1] + 3.0];
        let inside = from > LEFT && to < WIDTH && own[1] > TOP - 8.0 && own[3] < BOTTOM;
        let free = taken.iter().all(|t| own[2] < t[0] || own[0] > t[2] || own[3] < t[1] || own[1] > t[3]);
        (inside && free).then_some((anchor, place, own))
    })
}

/// How a point is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    Circle,
    Square,
    Triangle,
    Diamond,
    Down,
}

impl Shape {
    /// About a place.
    pub(crate) fn draw(self, svg: &mut String, [x, y]: [f64; 2]) {
        let corners = |corners: &[[f64; 2]]| {
            let corners: Vec<_> =
                corners.iter().map(|[dx, dy]| format!("{:.1},{:.1}", x + dx, y + dy)).collect();
            format!("<polygon points=\"{}\"/>", corners.join(" "))
        };
        *svg += &match self {
            Self::Circle => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\"/>"),
            Self::Square => corners(&[[-4.5, -4.5], [4.5, -4.5], [4.5, 4.5], [-4.5, 4.5]]),
            Self::Triangle => corners(&[[0.0, -6.0], [5.5, 4.5], [-5.5, 4.5]]),
            Self::Diamond => corners(&[[0.0, -6.0], [6.0, 0.0], [0.0, 6.0], [-6.0, 0.0]]),
            Self::Down => corners(&[[0.0, 6.0], [5.5, -4.5], [-5.5, -4.5]]),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::front;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points = [[0.0, 5.0], [0.0, 4.0], [1.0, 3.0], [2.0, 3.0], [9.0, 1.0], [9.0, 1.0]];
        assert_eq!(front(&points), [false, true, true, false, true, true]);
    }
}
