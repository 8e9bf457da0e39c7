//! The screen in blocks and stripes, and what each of them costs.
//!
//! In: every block as the SPU model booked it, and every stripe as it was timed on this computer. Out: a map of the blocks, the more
//! cycles the darker, with a scale, and beside each stripe of four scanlines how long it took here.

use super::svg::{LEFT, Svg, WIDTH};
use super::{Figure, FigureError, Input};
use crate::plot::short;
use crate::report::words::{count, figure};
use crate::spu::model::BlockTally;
use crate::spu::predict::Policy;
use contract::{Camera, Scene, Size};
use optimized::camera::BLOCK;
use optimized::plan::{Plan, Sharing};
use optimized::{RenderError, Tracer};

/// How often a stripe is timed; the median counts.
pub const RUNS: usize = 5;
/// Shades of the map, each from its least cycles to so many times these.
const SHADES: usize = 8;

/// Microseconds that each stripe of four scanlines takes on this computer, at the level asked for, one thread: each is a picture of its own,
/// timed from the finished grid to the last pixel.
///
/// # Errors
/// [`FigureError`] if the tracer refuses the scene.
pub fn timed(input: &Input<'_>) -> Result<Vec<f64>, FigureError> {
    let Input { scene, camera, plan, level, .. } = *input;
    // A grid of one's own would be built within the time that counts.
    let mut session = Tracer::new(Plan { sharing: Sharing::Shared, ..plan }, level).session()?;
    let mut stripe = |camera: &Camera, scene: &Scene| {
        let mut times = Vec::new();
        for _ in 0..RUNS {
            times.push(session.render(scene, camera)?.times.trace);
        }
        times.sort_unstable();
        Ok::<_, RenderError>(times[RUNS / 2].as_secs_f64() * 1e6)
    };
    let rows = (0..camera.size().height()).step_by(BLOCK as usize);
    rows.map(|y| Ok(stripe(&rows_of(camera, y)?, scene)?)).collect()
}

/// The camera of a stripe alone. Its rays are those of the picture but for the rounding of its corner, which is added up otherwise.
fn rows_of(camera: &Camera, y: u32) -> Result<Camera, RenderError> {
    let size = camera.size();
    let size = Size::new(size.width(), BLOCK.min(size.height() - y))?;
    #[allow(clippy::cast_precision_loss, reason = "below 2^14")]
    let corner = [0, 1, 2].map(|i| camera.corner()[i] + y as f32 * camera.dv()[i]);
    // What has an area has one for fewer rows, but where rounding takes it away; then the first rows stand for these.
    let own = Camera::new(camera.eye(), corner, camera.du(), camera.dv(), size);
    Ok(own.unwrap_or(*camera))
}

/// Cycles of a block: hinted, in the order as written.
fn cycles(block: &BlockTally) -> u64 {
    block.booked.dependence_bound(Policy::Hinted)
}

/// The drawing. `chosen` is the first pixel of the block that the other figures are of.
#[must_use]
pub fn draw(input: &Input<'_>, blocks: &[BlockTally], stripes: &[f64], chosen: [u32; 2]) -> Figure {
    let title = "The screen in blocks and stripes";
    let mut svg = Svg::new(&format!("{title}: what each block of {} costs", input.name));
    let size = [input.camera.size().width(), input.camera.size().height()];
    let [columns, rows] = size.map(|pixels| pixels.div_ceil(BLOCK)).map(f64::from);
    let (left, top) = (46.0, 44.0);
    let side = (440.0 / columns).min(420.0 / rows);
    let (width, height) = (side * columns, side * rows);
    svg.words("head", "start", [LEFT, 14.0], "cycles of each 4x4 block, SPU model");
    let bars = left + width + 24.0;
    let room = WIDTH - LEFT - 40.0 - bars;
    svg.words("head", "start", [bars, 14.0], "µs of each stripe, here");

    let [least, most] =
        [blocks.iter().map(cycles).min(), blocks.iter().map(cycles).max()].map(Option::unwrap_or_default);
    // Blocks cost from once to a hundred times the least: steps that are equal on a logarithmic scale show both ends.
    let step = (most as f64 / (least as f64).max(1.0)).powf(1.0 / SHADES as f64).max(1.0 + 1e-9);
    let edge = |shade: usize| (least as f64).max(1.0) * step.powi(i32::try_from(shade).unwrap_or(0));
    let shade = |block: &BlockTally| {
        (1..SHADES).find(|shade| (cycles(block) as f64) < edge(*shade)).unwrap_or(SHADES) - 1
    };
    svg.raw(&format!("<g transform=\"translate({left:.2} {top:.2}) scale({side:.4})\">"));
    let per_row = columns as usize;
    for of in 0..SHADES {
        let mut path = String::new();
        for (y, row) in blocks.chunks(per_row).enumerate() {
            let mut x = 0;
            while x < row.len() {
                let run = row[x..].iter().take_while(|block| shade(block) == of).count();
                if run > 0 {
                    path += &format!("M{x} {y}h{run}v1h-{run}z");
                }
                x += run.max(1);
            }
        }
        if !path.is_empty() {
            svg.raw(&format!("<path class=\"heat h{}\" d=\"{path}\"/>", of + 1));
        }
    }
    svg.raw("</g>");
    svg.rect("border", [left, top], [width, height]);
    let block = chosen.map(|pixel| f64::from(pixel / BLOCK));
    svg.rect("chosen", [left + side * block[0] - 2.0, top + side * block[1] - 2.0], [side + 4.0; 2]);
    for i in 0..2 {
        let pixels = f64::from(size[i]);
        for mark in ticks(pixels, [6.0, 5.0][i]) {
            let along = mark / f64::from(BLOCK) * side;
            let (at, anchor) =
                [([left + along, top - 6.0], "middle"), ([left - 6.0, top + along + 4.0], "end")][i];
            svg.words("faint", anchor, at, &short(mark));
        }
    }

    let longest = stripes.iter().copied().fold(0.0, f64::max).max(1e-3);
    for (row, time) in stripes.iter().enumerate() {
        let y = top + side * row as f64;
        svg.rect("bar", [bars, y + 0.1 * side], [room * time / longest, 0.8 * side]);
    }
    for mark in ticks(longest, 3.0) {
        let x = bars + room * mark / longest;
        svg.line("mesh", [x, top], [x, top + height]);
        svg.words("faint", "middle", [x, top - 6.0], &short(mark));
    }

    let foot = top + height + 18.0;
    let swatch = 52.0;
    for of in 0..SHADES {
        let place = [left + swatch * of as f64, foot];
        svg.rect(&format!("heat h{}", of + 1), place, [swatch, 12.0]);
        svg.words("faint", "middle", [place[0], foot + 26.0], &thousands(edge(of)));
    }
    let end = left + swatch * SHADES as f64;
    svg.rect("border", [left, foot], [end - left, 12.0]);
    svg.words("faint", "middle", [end, foot + 26.0], &thousands(most as f64));
    svg.words("", "start", [end + 34.0, foot + 10.0], "cycles of a block");
    svg.words("faint", "start", [end + 34.0, foot + 26.0], "ringed: the other figures' block");

    let sum: u64 = blocks.iter().map(cycles).sum();
    let dearest = blocks.iter().max_by_key(|block| cycles(block)).map_or([0, 0], |block| block.at);
    let shortest = stripes.iter().copied().fold(f64::INFINITY, f64::min);
    let split = match blocks.iter().filter(|block| block.counts.split_blocks > 0).count() {
        0 => String::new(),
        n => format!(" The rays of {} blocks have no common major axis and go one by one.", count(n as u64)),
    };
    let caption = format!(
        "{}: {} blocks of 4x4 pixels in {} stripes of four scanlines. On the SPU model, hinted and in the order as written, a block costs {} to {} cycles, {} in the mean; the dearest is at pixel ({}, {}).{split} On this computer, {}, one thread, a stripe takes {} to {} µs, the median of {RUNS} runs, without building the grid.",
        input.name,
        count(blocks.len() as u64),
        count(stripes.len() as u64),
        count(least),
        count(most),
        count(sum / (blocks.len() as u64).max(1)),
        dearest[0],
        dearest[1],
        input.level.name(),
        figure(shortest),
        figure(longest),
    );
    Figure { name: "screen", title: title.into(), caption, svg: svg.finish() }
}

/// 1, 2 or 5 times a power of ten, not below a number.
fn nice(least: f64) -> f64 {
    let power = 10f64.powf(least.max(1e-9).log10().floor());
    let within = [1.0, 2.0, 5.0, 10.0].into_iter().find(|factor| factor * power >= least * (1.0 - 1e-9));
    within.unwrap_or(10.0) * power
}

/// About so many round numbers from 0 on.
fn ticks(most: f64, about: f64) -> Vec<f64> {
    let step = nice(most / about);
    let all = (0..=100u32).map(|k| step * f64::from(k));
    all.take_while(|mark| *mark <= most * (1.0 + 1e-9)).collect()
}

/// A number of cycles in two digits: 3.2 k, 20 k.
fn thousands(cycles: f64) -> String {
    match cycles / 1000.0 {
        thousands if thousands >= 10.0 => format!("{thousands:.0} k"),
        thousands => format!("{thousands:.1} k"),
    }
}
