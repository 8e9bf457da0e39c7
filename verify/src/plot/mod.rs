//! Charts as inline SVG that takes its colours from the page: lines over an axis ([`lines`]), points by speed and error
//! ([`scatter`]), bars ([`bars`](mod@bars)) and rows of cells ([`heat`]). Values come in, an `<svg>` element goes out; where a value of zero is possible it has a
//! place of its own on a logarithmic axis ([`scale`]).

pub(crate) mod bars;
pub(crate) mod heat;
pub(crate) mod lines;
pub(crate) mod scale;
pub(crate) mod scatter;

pub(crate) use lines::{Axes, Mark, Series, plot};
pub(crate) use scale::Scaling;

use crate::report::words::figure;
use std::fmt::Write;

pub(crate) fn line(svg: &mut String, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
    _ = write!(svg, "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>");
}

pub(crate) fn words(svg: &mut String, anchor: &str, [x, y]: [f64; 2], text: &str) {
    _ = write!(svg, "<text text-anchor=\"{anchor}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escaped(text));
}

pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The beginning of a chart of a size; `title` is what it is called by those who do not see it.
pub(crate) fn begin([width, height]: [f64; 2], title: &str) -> String {
    format!(
        "<svg class=\"plot\" viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-label=\"{}\">",
        escaped(title)
    )
}

/// A drawing as a file of its own, in the colours of its reader's choice; `style` is that of what it draws.
#[must_use]
pub(crate) fn alone(svg: &str, style: &str) -> String {
    const COLORS: &str = include_str!("../../templates/colors.css");
    let fonts = ":root { --sans: system-ui, \"Segoe UI\", \"Helvetica Neue\", Arial, \"DejaVu Sans\", sans-serif; background: var(--paper); }";
    // On a page an element needs no name space, in a file it does.
    let svg = if svg.contains("xmlns=") {
        svg.to_owned()
    } else {
        svg.replacen("<svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"", 1)
    };
    let head = svg.find('>').map_or(0, |end| end + 1);
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}<style>\n{COLORS}{fonts}\n{style}</style>{}\n",
        &svg[..head],
        &svg[head..]
    )
}

/// The style of charts.
pub(crate) const STYLE: &str = include_str!("../../templates/plot.css");

/// A large number in few digits: 100, 10 k, 3.69 M.
#[must_use]
pub(crate) fn short(value: f64) -> String {
    match value {
        v if v >= 1e9 => power(v),
        v if v >= 1e6 => format!("{} M", trimmed(v / 1e6)),
        v if v >= 1e4 => format!("{} k", trimmed(v / 1e3)),
        v => trimmed(v),
    }
}

/// A number by its power of ten where it is one, else in few digits.
#[must_use]
pub(crate) fn power(value: f64) -> String {
    if value <= 0.0 {
        return trimmed(value);
    }
    let exponent = value.log10().round();
    let is_power = (value.log10() - exponent).abs() < 1e-9;
    match exponent {
        e if is_power && !(-2.0..=3.0).contains(&e) => format!("10{}", superscript(&format!("{e:.0}"))),
        _ if (1e-3..1e6).contains(&value) => trimmed(value),
        _ => {
            let exponent = value.log10().floor();
            format!("{}·10{}", trimmed(value / 10f64.powf(exponent)), superscript(&format!("{exponent:.0}")))
        }
    }
}

/// Digits raised, as an exponent.
pub(crate) fn superscript(digits: &str) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => c.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(c),
    };
    digits.chars().map(raised).collect()
}

/// Three digits without zeros behind the point.
pub(crate) fn trimmed(value: f64) -> String {
    let text = figure(value);
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{power, short};

    #[test]
    fn numbers_are_short() {
        let said = [0.0, 0.5, 1.0, 100.0, 1e4, 3.69e6, 1e-30, 2e-7, 1e8].map(power);
        assert_eq!(said, ["0", "0.5", "1", "100", "10⁴", "3.69·10⁶", "10⁻³⁰", "2·10⁻⁷", "10⁸"]);
        assert_eq!([1e4, 3.69e6, 250.0].map(short), ["10 k", "3.69 M", "250"]);
    }
}
