//! What fits into the local store, and what is moved into it and out.

use super::{Answer, Looked, PaperClaim, alone, asked};
use crate::report::Evidence;
use crate::report::words::figure;
use crate::spu::cost::SPUS;
use crate::spu::dma::{ALIGNMENT, BYTES_PER_SECOND, MOST, Transfer};
use crate::spu::predict::Policy;
use crate::spu::store::{Buffers, CAPACITY, Map, PIXEL, code_bytes, queue_bytes};
use crate::spu::survey::Survey;
use optimized::Plan;

/// Pixels of the paper's scanline.
const WIDTH: u32 = 1280;

pub(super) fn claims(looked: &[Looked]) -> Vec<PaperClaim> {
    let fits = |claim, of: fn(&Survey) -> Map| {
        asked(claim, Evidence::Measured, looked, move |look| {
            let map = of(&look.survey);
            ((map.fits().is_ok()).into(), format!("{} of {CAPACITY}", map.total()))
        })
    };
    let most = code_bytes(Plan::paper()).map(|code| {
        let map = |buffers| Map::new(code, queue_bytes(16), 0, WIDTH, 16, buffers).most_spheres();
        [map(Buffers::Single), map(Buffers::Double)]
    });
    let most = most.map_or_else(
        |error| (Answer::Silent, error.to_string()),
        |[one, two]| {
            ((two >= 3000).into(), format!("{one} at most, with their colours; {two} with two pixel buffers"))
        },
    );
    let grid = queue_bytes(16);
    let transfers = Transfer::new(0, 20_480).map(|transfer| transfer.transfers);
    vec![
        fits("Scene, grid and program fit into a local store, with one pixel buffer", |s| s.store),
        fits("Scene, grid and program fit into a local store, with two pixel buffers", |s| s.store_double),
        alone(
            "Several hundred to a few thousand spheres (3,000) fit beside 16x16x16 cells",
            Evidence::Measured,
            most,
        )
        .by("cargo run --release -- spu --capacity"),
        alone(
            "A grid of 16x16x16 cells takes half of the local store",
            Evidence::Measured,
            ((2 * grid == CAPACITY).into(), format!("{grid} of {CAPACITY} bytes")),
        ),
        alone(
            "A block of scanlines, 20,480 bytes, is one transfer",
            Evidence::Measured,
            (
                transfers.map_or(Answer::Silent, |n| (n == 1).into()),
                transfers.map_or_else(|e| e.to_string(), |n| format!("{n} transfers")),
            ),
        )
        .against(Some(format!("{} bytes: a transfer moves {MOST}", MOST + ALIGNMENT))),
        asked(
            "Memory is what limits the frame rate: transfers are half of a frame or more",
            Evidence::Measured,
            looked,
            |look| {
                let rate = &look.survey.rates[Policy::Hinted as usize];
                let dma = rate.stages.iter().find(|stage| stage.stage == "DMA").map(|stage| stage.per_frame);
                let share = dma.map(|dma| 100.0 * dma[1] / SPUS as f64 / rate.frame_cycles[0]);
                let answer = share.map_or(Answer::Silent, |share| (share >= 50.0).into());
                (answer, share.map_or_else(String::new, |share| format!("{} %", figure(share))))
            },
        ),
        alone(
            "60 pictures of 1280x720 a second take half of what the memory can move, or more",
            Evidence::Measured,
            {
                let share = 100.0 * f64::from(WIDTH * 720) * PIXEL as f64 * 60.0 / BYTES_PER_SECOND;
                ((share >= 50.0).into(), format!("{} %", figure(share)))
            },
        ),
    ]
}
