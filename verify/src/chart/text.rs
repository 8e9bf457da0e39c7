//! A chart as a table for the terminal: of each view the methods, from fast to slow.

use super::data::{Chart, Point};
use crate::report::words::{NONE, count, figure};
use std::fmt::Write;

/// The table.
#[must_use]
pub fn text(chart: &Chart) -> String {
    let mut text = String::new();
    for view in &chart.views {
        _ = writeln!(
            text,
            "{}, {} spheres, {} radii away, {}x{}",
            view.scene,
            count(view.spheres as u64),
            figure(view.radii),
            view.size[0],
            view.size[1]
        );
        _ = writeln!(
            text,
            "  {:<26}{:>10}{:>14}{:>12}{:>12}{:>12}{:>10}",
            "method", "ns a ray", "SPU cycles", "wrong ids", "ulp of t", "at most", "colours"
        );
        let mut points: Vec<&Point> = view.points.iter().collect();
        points.sort_by(|a, b| {
            a.ns_per_ray.unwrap_or(f64::INFINITY).total_cmp(&b.ns_per_ray.unwrap_or(f64::INFINITY))
        });
        for point in points {
            _ = writeln!(text, "{}", row(point));
        }
        text += "\n";
    }
    for absent in &chart.absent {
        _ = writeln!(text, "{}: not there. {}", absent.judge, absent.why);
    }
    text
}

fn row(point: &Point) -> String {
    let none = || NONE.to_owned();
    let of = |get: fn(&crate::verdict::Comparison) -> u64| {
        point.comparison.as_ref().map_or_else(none, |c| count(get(c)))
    };
    let cycles = point.spu_cycles_per_ray;
    format!(
        "  {:<26}{:>10}{:>14}{:>12}{:>12}{:>12}{:>10}{}",
        point.method,
        point.ns_per_ray.map_or_else(none, figure),
        cycles.map_or_else(none, |[a, b]| format!("{}-{}", figure(a), figure(b))),
        of(|c| c.wrong_ids),
        of(|c| c.t_ulp.p99),
        of(|c| c.t_ulp.max),
        if point.paints { of(|c| c.wrong_color) } else { none() },
        point.remark.as_ref().map_or_else(String::new, |remark| format!("  {remark}")),
    )
}
