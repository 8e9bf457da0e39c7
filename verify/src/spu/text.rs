//! Surveys for the terminal: a table of stages for each scene, then loops, branches, culling, mailbox, lists, picture and memory, a line each.

use super::cost::Bracket;
use super::store::{Buffers, CAPACITY, Map, queue_bytes};
use super::survey::{LoopCost, SiteCount, Survey};
use crate::report::text::wrapped;
use crate::report::words::{NONE, count, figure};
use crate::scenes::catalogue::{Listing, list};

/// All that a survey found.
#[must_use]
pub fn text(survey: &Survey) -> String {
    let mut text = heading(survey) + &stages(survey) + &rates(survey) + &loops(survey) + &sites(survey);
    for line in sentences(survey) {
        text += &(wrapped(&line) + "\n");
    }
    text + &format!("Local store, {CAPACITY} bytes, with one pixel buffer:\n{}\n", survey.store)
}

fn heading(survey: &Survey) -> String {
    let Survey { scene, frame, spheres, size: [width, height], cells: [x, y, z], plan, blocks, .. } = survey;
    let frame = if *frame > 0 { format!(", frame {frame}") } else { String::new() };
    let line = format!(
        "{scene}{frame}: {} spheres, {width}x{height} pixels, {x}x{y}x{z} cells; {} of {} blocks traced. Plan: {plan}.",
        count(*spheres as u64),
        count(blocks[0]),
        count(blocks[1]),
    );
    wrapped(&line) + "\n"
}

fn or_none(value: Option<f64>) -> String {
    value.map_or_else(|| NONE.to_owned(), figure)
}

fn percent(part: u64, of: u64) -> String {
    or_none((of > 0).then(|| 100.0 * part as f64 / of as f64))
}

/// Least and most, the same figure once.
fn range([least, most]: Bracket) -> String {
    let (least, most) = (figure(least), figure(most));
    if least == most { least } else { format!("{least} to {most}") }
}

fn stages(survey: &Survey) -> String {
    let names = survey.rates.iter().map(|rate| format!("{:>22}", rate.policy)).collect::<String>();
    let mut text = format!("{:<12}{names}   cycles a ray\n", "stage");
    let Some(first) = survey.rates.first() else { return text };
    for (k, stage) in first.stages.iter().enumerate() {
        text += &format!("{:<12}", stage.stage);
        for rate in &survey.rates {
            text += &format!("{:>22}", range(rate.stages[k].per_ray));
        }
        text += "\n";
    }
    text
}

fn rates(survey: &Survey) -> String {
    let mut text = String::new();
    let of_rates = |title: &str, of: &dyn Fn(usize) -> String| {
        let cells: String = (0..survey.rates.len()).map(|k| format!("{:>22}", of(k))).collect();
        format!("{title:<12}{cells}")
    };
    let millions = |k: usize| range(survey.rates[k].frame_cycles.map(|cycles| cycles / 1e6));
    text += &(of_rates("frame", &millions) + "   million cycles, six SPUs\n");
    text += &(of_rates("", &|k| range(survey.rates[k].frames_per_second)) + "   frames a second\n");
    let double = |k: usize| range(survey.rates[k].frames_per_second_double);
    text + &of_rates("", &double) + "   the same, two pixel buffers\n"
}

fn loops(survey: &Survey) -> String {
    let mut text = String::new();
    for LoopCost { walk, traversals, cells, branches, policies, sites } in &survey.loops {
        text += &format!(
            "{walk}: {} traversals, {} cells, {} branches of the loop; mispredicts of it\n",
            count(*traversals),
            count(*cells),
            count(*branches)
        );
        if let Some(site) = sites.iter().find(|site| site.site == "NextCell") {
            let dead = percent(site.executed - cells, site.executed);
            text +=
                &format!("  {dead} % of its steps are for slices without cells, each taken like one cell\n");
        }
        for policy in policies {
            text += &format!(
                "  {:<11} {:>6} a cell {:>6} a traversal {:>5} % of its branches; all branches {:>6} a traversal; {} million cycles\n",
                policy.policy,
                or_none(policy.per_cell),
                or_none(policy.per_traversal),
                or_none(policy.per_branch.map(|share| 100.0 * share)),
                or_none(policy.all_per_traversal),
                range(policy.frame_cycles.map(|cycles| cycles / 1e6)),
            );
        }
    }
    text
}

/// Branch by branch, of the loop that the plan has and of the other.
fn sites(survey: &Survey) -> String {
    let mut text = String::new();
    for LoopCost { walk, sites, .. } in &survey.loops {
        text += &format!(
            "{:<22}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n",
            format!("branches, {walk}"),
            "executed",
            "taken",
            "unhinted",
            "hinted",
            "GCC's rule",
            "best"
        );
        for SiteCount { site, executed, taken, mispredicts: [a, b, c], best } in sites {
            let cells: String =
                [executed, taken, a, b, c, best].map(|n| format!("{:>12}", count(*n))).concat();
            text += &format!("  {site:<20}{cells}\n");
        }
    }
    text
}

fn sentences(survey: &Survey) -> Vec<String> {
    let Survey { culling, mailbox, lists, picture, blocks: [traced, blocks], .. } = survey;
    // Cycles are those of a frame in any case.
    let counted = if traced < blocks { ", counted in the blocks traced" } else { "" };
    let parts = |bracket: Bracket| range(bracket.map(|share| 100.0 * share));
    vec![
        format!(
            "Culling: {} tests of sixteen rays without, {} with{counted}, a factor of {}; {} and {} million cycles a frame.",
            count(culling.tests_without),
            count(culling.tests_with),
            or_none(culling.factor),
            range(culling.cycles_without.map(|c| c / 1e6)),
            range(culling.cycles_with.map(|c| c / 1e6)),
        ),
        format!(
            "Mailbox: {} of {} spheres fetched had been met by the packet before ({} %); they take {} % of tracing, of which a mailbox saves {} %.",
            count(mailbox.repeats),
            count(mailbox.fetched),
            percent(mailbox.repeats, mailbox.fetched),
            parts(mailbox.share),
            parts(mailbox.saved),
        ),
        format!(
            "Lists: {} ids, of which {} in cells that the ball does not meet ({} %); {} cells that it meets do not list it; {} spheres span more than two cells; {} ids fell out of full queues, of {} cells that are known.",
            count(lists.ids),
            count(lists.false_positives),
            percent(lists.false_positives, lists.ids),
            count(lists.false_negatives),
            count(lists.spanning),
            count(lists.dropped),
            count(lists.overfull),
        ),
        format!(
            "Picture: {} of {} pixels that hit are wrong ({} %); by the loop as printed {} more differ.",
            count(picture.wrong),
            count(picture.hits),
            percent(picture.wrong, picture.hits),
            count(picture.wrong_as_printed),
        ),
    ]
}

/// How many spheres fit beside a grid of queues, with one pixel buffer and with two, and which scenes beside the paper's grid.
#[must_use]
pub fn capacity(code: u64, width: u32) -> String {
    let mut text = format!(
        "{:<8}{:>10}{:>20}{:>20}   (rows of {width} pixels, {code} bytes of code, estimated)\n",
        "cells", "bytes", "spheres", "with two buffers"
    );
    for n in [4, 6, 8, 10, 12, 13, 14, 15, 16, 17, 18, 19, 20] {
        let map = |buffers| Map::new(code, queue_bytes(n), 0, width, n, buffers);
        let most = [Buffers::Single, Buffers::Double].map(|buffers| match map(buffers).fits() {
            Ok(map) => count(map.most_spheres()),
            Err(_) => "no room".into(),
        });
        text += &format!("{:<8}{:>10}{:>20}{:>20}\n", format!("{n}^3"), queue_bytes(n), most[0], most[1]);
    }
    text += &format!(
        "\n{:<28}{:>10}{:>12}{:>12}   (beside 16^3 cells)\n",
        "scene", "spheres", "fits", "two buffers"
    );
    for Listing { name, spheres, .. } in list() {
        let fits = [Buffers::Single, Buffers::Double].map(|buffers| {
            let most = Map::new(code, queue_bytes(16), 0, width, 16, buffers).most_spheres();
            if spheres <= most.into() { "yes" } else { "no" }
        });
        text += &format!("{name:<28}{spheres:>10}{:>12}{:>12}\n", fits[0], fits[1]);
    }
    text
}
