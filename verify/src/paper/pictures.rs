//! Pictures, and what culling and mailboxes buy.

use super::cases::{FAR, LETTER};
use super::{Answer, Looked, PaperClaim, Proof, VISIBLE, alone, asked, cheaper, percent, several, shown};
use crate::prove::prover::Finding;
use crate::report::Evidence;
use crate::report::words::figure;
use crate::scenes::catalogue::Source;
use crate::scenes::frame::Framing;
use contract::Size;
use optimized::plan::{Arithmetic, Cells, Margins, Plan, Resolution, Voxelizer};
use optimized::{Form, Level, Tracer};
use std::sync::OnceLock;

pub(super) fn claims(looked: &[Looked], said: &[Finding]) -> Vec<PaperClaim> {
    let visible = Proof::of(VISIBLE, said);
    static AFAR: OnceLock<[(Vec<Answer>, String); 2]> = OnceLock::new();
    let [textbook, perpendicular] = AFAR.get_or_init(|| [Form::Textbook, Form::Perpendicular].map(from_afar));
    vec![
        asked("Culling cuts tests 4 to 8 times", Evidence::Measured, looked, |look| {
            let factor = look.survey.culling.factor;
            (
                factor.map_or(Answer::Silent, |f| (4.0..=8.0).contains(&f).into()),
                factor.map_or_else(String::new, figure),
            )
        }),
        asked("Culling saves cycles", Evidence::Measured, looked, |look| {
            let culling = &look.survey.culling;
            let gain = 100.0 * (1.0 - culling.cycles_with[1] / culling.cycles_without[1]);
            (cheaper(culling.cycles_with, culling.cycles_without), format!("{} %", figure(gain)))
        }),
        asked("No mailbox is needed: it would cost more than it saves", Evidence::Measured, looked, |look| {
            let mailbox = &look.survey.mailbox;
            let saved = mailbox.saved.map(|share| 100.0 * share);
            // The bounds of what is saved are those of two costs, not of one.
            let answer = cheaper(saved, [0.0; 2]);
            (
                answer,
                format!(
                    "{} % saved, {} % repeats",
                    shown(saved),
                    figure(percent(mailbox.repeats, mailbox.fetched))
                ),
            )
        }),
        alone(
            "Slices and culling lose nothing that a ray of the packet hits, but for rounding",
            visible.or(Evidence::NotShown),
            (visible.said, visible.figure),
        )
        .by(visible.command),
        asked("The picture is that of one loop over all spheres", Evidence::Sampled, looked, |look| {
            let picture = &look.survey.picture;
            ((picture.wrong == 0).into(), format!("{} % wrong", figure(percent(picture.wrong, picture.hits))))
        })
        .against(LETTER.told()),
        several(
            "… from any distance, where lists lose nothing: in the textbook form, without margins",
            Evidence::Sampled,
            (&textbook.0, textbook.1.clone()),
        )
        .against(FAR.told())
        .by(FAR.command()),
        several(
            "… in the perpendicular form",
            Evidence::Sampled,
            (&perpendicular.0, perpendicular.1.clone()),
        ),
    ]
}

/// How far away, in cells of the grid.
const DISTANCES: [f64; 3] = [20.0, 200.0, 2000.0];

/// Pixels that differ from those of one loop over all spheres in the same form, if nothing but the paper's lack of margins is wrong with the
/// grid; by distance.
fn from_afar(form: Form) -> (Vec<Answer>, String) {
    let differing: Option<Vec<[u64; 2]>> =
        DISTANCES.into_iter().map(|cells| differing(form, cells)).collect();
    let Some(differing) = differing else { return (Vec::new(), "no picture".into()) };
    let shown: Vec<String> = DISTANCES
        .iter()
        .zip(&differing)
        .map(|(cells, [wrong, hits])| format!("at {cells} cells {wrong} of {hits} pixels that hit differ"))
        .collect();
    (differing.iter().map(|[wrong, _]| (*wrong == 0).into()).collect(), shown.join(", "))
}

/// Pixels that differ, and pixels that hit.
fn differing(form: Form, cells: f64) -> Option<[u64; 2]> {
    let loaded = Source::parse("uniform:500:1").ok()?.load().ok()?;
    let scene = loaded.animation.frames().first()?;
    let of = |i: usize| scene.spheres().iter().map(move |s| f64::from(s.center[i]));
    let ends = |i: usize| [of(i).fold(f64::INFINITY, f64::min), of(i).fold(f64::NEG_INFINITY, f64::max)];
    let middle = [0, 1, 2].map(|i| f64::midpoint(ends(i)[0], ends(i)[1]));
    let side = ends(2)[1] - ends(2)[0];
    let distance = cells * side / 16.0;
    let framing = Framing {
        eye: Some([middle[0] + 0.1 * side, middle[1] + 0.2 * side, middle[2] + distance + side]),
        target: Some(middle),
        // The scene fills the picture's height.
        fov: Some(2.0 * (0.6 * side / (distance + side)).atan().to_degrees()),
        size: Some(Size::new(640, 360).ok()?),
        ..Framing::default()
    };
    let camera = framing.camera(&scene.clone().into()).ok()?;
    let level = Level::available().last().copied().unwrap_or(Level::SCALAR);
    let naive = match form {
        Form::Textbook => reference::Arithmetic::F32Textbook,
        Form::Perpendicular => reference::Arithmetic::F32Perpendicular,
    };
    let naive = reference::Tracer::new(naive).render(scene, &camera).ok()?.image;
    let bare = Plan {
        voxelizer: Voxelizer::BoxRange,
        cells: Cells::Lists,
        margins: Margins::None,
        resolution: Resolution::Fixed(16),
        arithmetic: Arithmetic::Rounded(form),
        ..Plan::paper()
    };
    let given = Tracer::new(bare, level).render(scene, &camera).ok()?.image;
    let differ = naive.ids.iter().zip(&given.ids).filter(|(a, b)| a != b).count();
    let hits = naive.ids.iter().filter(|id| **id != contract::MISS).count();
    Some([differ as u64, hits as u64])
}
