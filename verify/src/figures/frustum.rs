//! A packet's frustum on its way through the slices, from two sides.
//!
//! In: the grid and what the packet noted. Out: the drawing, seen along each of the minor axes in turn: the major axis runs to the right, from
//! the eye outward, lengths are the scene's. Each visited cell is drawn once in each view, so that cells one behind the other are darker; a
//! sphere is its outline.

use super::block::{Fate, Met, Walked};
use super::svg::{LEFT, Sign, Svg, WIDTH};
use super::{Figure, Input};
use crate::report::words::count;
use optimized::grid::Grid;

const AXES: [&str; 3] = ["x", "y", "z"];

/// What one view needs.
struct View<'a> {
    input: &'a Input<'a>,
    grid: &'a Grid,
    eye: [f32; 3],
    walked: &'a Walked,
    /// Which of the minor axes is upwards.
    side: usize,
}

/// The drawing.
#[must_use]
pub fn draw(input: &Input<'_>, grid: &Grid, eye: [f32; 3], walked: &Walked) -> Figure {
    let title = "A frustum on its way through the slices";
    let mut svg = Svg::new(&format!("{title}: one packet of {}, from two sides", input.name));
    let mut at = 0.0;
    for side in 0..2 {
        at = View { input, grid, eye, walked, side }.draw(&mut svg, at) + 14.0;
    }
    svg.legend(
        at,
        &[
            (Sign::Box("visited"), "visited cell, darker where several are behind each other"),
            (Sign::Box("touched"), "cells it would have come to: no ray needs them"),
            (Sign::Box("beam"), "frustum"),
            (Sign::Stroke("ray"), "rays, up to what they hit"),
            (Sign::Round("seen"), "sphere that is seen"),
            (Sign::Round("vain"), "intersected in vain"),
            (Sign::Round("culled"), "culled"),
        ],
    );
    let fate = |fate| walked.met.iter().filter(|met| met.fate == fate).count() as u64;
    let counts = walked.counts;
    let slices = (0..walked.slices.count).filter(|s| !walked.slices.is_empty(*s)).count() as u64;
    let mut entered: Vec<i32> = walked.cells.iter().map(|cell| cell[0]).collect();
    entered.dedup();
    let caption = format!(
        "The block at pixel ({}, {}), along {}. Its frustum touches {} of {} slices; the packet enters {} of them and visits {} cells. There it finds {} spheres, of which {} are met for the first time: {} are culled, {} intersected in vain, {} seen.",
        walked.at[0],
        walked.at[1],
        direction(walked),
        count(slices),
        count(walked.slices.count as u64),
        count(entered.len() as u64),
        count(counts.cells),
        count(counts.candidates),
        count(walked.met.len() as u64),
        count(fate(Fate::Culled)),
        count(fate(Fate::InVain)),
        count(fate(Fate::Seen)),
    );
    Figure { name: "frustum", title: title.into(), caption, svg: svg.finish() }
}

fn direction(walked: &Walked) -> String {
    let sign = if walked.heading.forward { '+' } else { '−' };
    format!("{sign}{}", AXES[walked.heading.order[0]])
}

impl View<'_> {
    /// Near and far plane of a slice, along the major axis from the eye.
    fn slab(&self, slice: usize) -> [f64; 2] {
        let heading = self.walked.heading;
        let (planes, eye) = (&self.grid.axes[heading.order[0]].planes, self.eye[heading.order[0]]);
        let index = heading.slice_index(self.walked.slices.count, slice);
        heading.ahead([planes[index] - eye, planes[index + 1] - eye]).map(f64::from)
    }

    fn draw(&self, svg: &mut Svg, top: f64) -> f64 {
        let Walked { heading, slices, cells, slope, slopes, reached, .. } = self.walked;
        let (minor, depth) = (heading.order[self.side + 1], heading.order[2 - self.side]);
        let planes: Vec<f64> = self.grid.axes[minor].planes.iter().map(|x| f64::from(*x)).collect();
        let eye = f64::from(self.eye[minor]);
        let (first, last) = (&slices.first[self.side], &slices.last[self.side]);
        let full: Vec<usize> = (0..slices.count).filter(|s| !slices.is_empty(*s)).collect();
        let (Some(&s0), Some(&s1)) = (full.first(), full.last()) else { return top };
        let [near, far] = [self.slab(s0)[0], self.slab(s1)[1]];
        let lowest = full.iter().map(|s| first[*s]).min().unwrap_or(0);
        let highest = full.iter().map(|s| last[*s]).max().unwrap_or(0);
        let row = |cell: i32| usize::try_from(cell.max(0)).unwrap_or(0).min(planes.len() - 2);
        let (lowest, highest) = (row(lowest - 1), row(highest + 1));
        let (low, high) = (planes[lowest], planes[highest + 1]);
        let left = 52.0;
        let scale = ((WIDTH - left - LEFT) / (far - near)).min(250.0 / (high - low));
        let (width, height) = (scale * (far - near), scale * (high - low));
        let y0 = top + 40.0;
        let at = |a: f64, b: f64| [left + scale * (a - near), y0 + scale * (high - b)];
        let head = format!(
            "along {} to the right, {} upwards, seen along {}",
            direction(self.walked),
            AXES[minor],
            AXES[depth]
        );
        svg.words("head", "start", [LEFT, top + 14.0], &head);

        svg.clipped(&format!("frustum-{}", self.side), [left, y0], [width, height]);
        for &s in &full {
            let [a, b] = self.slab(s);
            let [from, to] = [at(a, planes[row(last[s]) + 1]), at(b, planes[row(first[s])])];
            svg.rect("touched", from, [to[0] - from[0], to[1] - from[1]]);
        }
        for cell in cells {
            let (s, row) = (usize::try_from(cell[0]).unwrap_or(0), row(cell[1 + self.side]));
            let [a, b] = self.slab(s);
            let [from, to] = [at(a, planes[row + 1]), at(b, planes[row])];
            svg.rect("visited", from, [to[0] - from[0], to[1] - from[1]]);
        }
        for plane in &planes[lowest..=highest + 1] {
            svg.line("mesh", at(near, *plane), at(far, *plane));
        }
        for s in s0..=s1 {
            let [a, _] = self.slab(s);
            svg.line("mesh", at(a, low), at(a, high));
        }
        let start = near.max(0.0);
        let [lo, hi] = slopes[self.side].map(f64::from);
        let beam = [
            at(start, eye + lo * start),
            at(far, eye + lo * far),
            at(far, eye + hi * far),
            at(start, eye + hi * start),
        ];
        svg.polygon("beam", &beam);
        for fate in [Fate::Culled, Fate::InVain, Fate::Seen] {
            for met in self.walked.met.iter().filter(|met| met.fate == fate) {
                self.sphere(svg, met, minor, scale, &at);
            }
        }
        let end = cells.iter().map(|cell| usize::try_from(cell[0]).unwrap_or(0)).max().unwrap_or(0);
        let end = self.slab(end)[1];
        for (slope, reached) in slope[self.side].iter().zip(reached) {
            let (slope, stop) = (f64::from(*slope), f64::from(*reached).min(end));
            svg.line("ray", at(start, eye + slope * start), at(stop, eye + slope * stop));
            if reached.is_finite() {
                svg.circle("end", at(stop, eye + slope * stop), 1.8, None);
            }
        }
        svg.end();
        svg.rect("border", [left, y0], [width, height]);
        // As many numbers as there is room for.
        let mut free = f64::NEG_INFINITY;
        for s in s0..=s1 {
            let [x, _] = at(f64::midpoint(self.slab(s)[0], self.slab(s)[1]), low);
            if x >= free {
                svg.words("faint", "middle", [x, y0 - 6.0], &s.to_string());
                free = x + 24.0;
            }
        }
        let mut free = f64::INFINITY;
        for cell in lowest..=highest {
            let [_, y] = at(near, f64::midpoint(planes[cell], planes[cell + 1]));
            if y <= free {
                svg.words("faint", "end", [left - 6.0, y + 4.0], &format!("{}={cell}", AXES[minor]));
                free = y - 14.0;
            }
        }
        y0 + height
    }

    fn sphere(&self, svg: &mut Svg, met: &Met, minor: usize, scale: f64, at: &dyn Fn(f64, f64) -> [f64; 2]) {
        let sphere = &self.input.scene.spheres()[met.id as usize];
        let (class, word) = match met.fate {
            Fate::Culled => ("culled", "culled"),
            Fate::InVain => ("vain", "intersected in vain"),
            Fate::Seen => ("seen", "seen"),
        };
        let from = [0, 1, 2].map(|i| sphere.center[i] - self.eye[i]);
        let along = f64::from(self.walked.heading.along(from)[0]);
        let title = format!("sphere {}, {word}, met {} times", met.id, met.times);
        let center = at(along, f64::from(sphere.center[minor]));
        svg.circle(class, center, scale * f64::from(sphere.radius), Some(&title));
    }
}
