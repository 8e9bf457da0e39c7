//! Frames a second, what a frame consists of, and who shares it.

use super::{Answer, Standing};
use super::{Figured, Looked, PaperClaim, above, alone, asked, shown};
use crate::report::Evidence;
use crate::report::words::figure;
use crate::spu::cost::{HERTZ, SPUS};
use crate::spu::predict::Policy;

pub(super) fn claims(looked: &[Looked]) -> Vec<PaperClaim> {
    let at_least = |claim, wanted, policy: Policy| {
        asked(claim, Evidence::Measured, looked, move |look| {
            let rate = look.survey.rates[policy as usize].frames_per_second;
            (above(rate, wanted), shown(rate))
        })
    };
    let on_one = PaperClaim {
        how: "a PlayStation 3".into(),
        ..alone(
            "It runs so on a PlayStation 3",
            Evidence::NotShown,
            (
                Answer::Silent,
                "the paper has no measurement, and no such machine was at hand: all cycles are a model's"
                    .into(),
            ),
        )
    };
    debug_assert_eq!(on_one.verdict, Standing::NotShown, "nobody has measured it");
    vec![
        at_least("It is interactive: 30 frames a second on six SPUs, hinted", 30.0, Policy::Hinted),
        at_least("60 frames a second on six SPUs, hinted", 60.0, Policy::Hinted),
        at_least("60 frames a second on six SPUs, without a hint", 60.0, Policy::Unhinted),
        on_one,
        asked(
            "Voxelizing anew for every frame, on each SPU, is cheap: below 5 % of a frame",
            Evidence::Measured,
            looked,
            |look| {
                let rate = &look.survey.rates[Policy::Hinted as usize];
                let voxelize = rate.stages[0].per_frame.map(|cycles| cycles / SPUS as f64);
                let share = [0, 1].map(|i| 100.0 * voxelize[i] / rate.frame_cycles[i]);
                let most = share[0].max(share[1]);
                ((most < 5.0).into(), format!("{} %", figure(most)))
            },
        ),
        asked(
            "Stripes of four scanlines keep six SPUs at work, 95 % of a frame or more",
            Evidence::Measured,
            looked,
            |look| {
                let rate = &look.survey.rates[Policy::Hinted as usize];
                let share = [0, 1].map(|i| {
                    let all: f64 = rate.stages.iter().map(|stage| stage.per_frame[i]).sum();
                    100.0 * all / (SPUS as f64 * rate.frame_cycles[i])
                });
                let least = share[0].min(share[1]);
                ((least >= 95.0).into(), format!("{} %", figure(least)))
            },
        ),
        asked(
            "SPUs need nothing of each other: one, two and six workers give one picture",
            Evidence::Sampled,
            looked,
            |look| (look.workers_agree.into(), String::new()),
        ),
        alone(
            "The processor is 35 times an Opteron, as the paper counts operations",
            Evidence::Measured,
            peak(),
        ),
    ]
}

/// What it does at most, a product and a sum in each of four lanes in every cycle, against the 313 GFlops of which 35 times is said:
/// they are the graphics chip's (GeForce 7800 GTX).
fn peak() -> Figured {
    const GRAPHICS: f64 = 313e9;
    let of = |spus: usize| spus as f64 * 8.0 * HERTZ;
    let times = |flops: f64| figure(35.0 * flops / GRAPHICS);
    let (all, usable) = (of(8), of(SPUS));
    let evidence = format!(
        "{} times with eight SPUs ({} GFlops), {} with the six that can be used; 35 times is the 313 GFlops of the graphics chip",
        times(all),
        figure(all / 1e9),
        times(usable)
    );
    ((35.0 * all / GRAPHICS >= 35.0).into(), evidence)
}
