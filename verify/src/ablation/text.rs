//! An ablation as a table for the terminal.

use super::data::Ablation;
use crate::report::words::{NONE, count, figure};
use crate::spu::feature::Feature;
use std::fmt::Write;

/// The table.
#[must_use]
pub fn text(ablation: &Ablation) -> String {
    let mut text = String::new();
    let number = |value: Option<f64>| value.map_or_else(|| NONE.to_owned(), figure);
    let whole = |value: Option<u64>| value.map_or_else(|| NONE.to_owned(), count);
    for scene in &ablation.scenes {
        _ = writeln!(
            text,
            "{}, {} spheres, {}x{}",
            scene.scene,
            count(scene.spheres as u64),
            scene.size[0],
            scene.size[1]
        );
        if let (Some(ratio), Some(best)) = (scene.chosen_by_best, &scene.best_picked) {
            _ = writeln!(
                text,
                "  the chosen plan takes {} times as long as the best picked by hand, {best}",
                figure(ratio)
            );
        }
        for base in &scene.bases {
            _ = writeln!(
                text,
                "  {:<38}{:>10} ns a ray{:>10} wrong pixels",
                base.name,
                number(base.ns_per_ray),
                whole(base.wrong)
            );
            for row in &base.rows {
                _ = writeln!(
                    text,
                    "    {:<14}{:<22}{:>9} times the time{:>8} times the cycles{:>9} wrong{}",
                    row.concern,
                    row.choice,
                    number(row.time),
                    number(row.cycles),
                    whole(row.wrong),
                    row.remark.as_ref().map_or_else(String::new, |remark| format!("  {remark}"))
                );
            }
        }
        text += "\n";
    }
    for row in &ablation.model {
        let name = row.feature.map_or("the whole model of the paper's machine", Feature::words);
        let rates = row.frames_per_second.iter();
        let rates: Vec<_> =
            rates.map(|(scene, [a, b])| format!("{scene} {}-{}", figure(*a), figure(*b))).collect();
        let without = if row.feature.is_some() { "without " } else { "" };
        _ = writeln!(text, "{without}{name}: frames a second {}", rates.join(", "));
        for (claim, before, after) in &row.changed {
            _ = writeln!(text, "    {claim}: {} becomes {}", before.word(), after.word());
        }
    }
    text
}
