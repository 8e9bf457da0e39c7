//! Do properties hold of whatever proptest draws: known answers of integers, the judge's verdict on any plan, and metamorphic relations?
//! Each run prints its seed and what was at stake, and has no verdict if that was too little. `CGT_PROPERTY_CASES` sets how many cases
//! each property draws.

use verify::properties::stakes::Stakes;
use verify::properties::{certain, pictures, relations, wild};
use verify::seed::{count, seed};

/// Runs a property and asks whether enough was at stake.
fn hold(
    name: &str,
    everyday: u64,
    least: &[(&str, u64)],
    property: impl Fn(u64, u64) -> Result<Stakes, String>,
) {
    let (seed, cases) = (seed(), count("CGT_PROPERTY_CASES", everyday));
    let stakes = property(seed, cases).unwrap_or_else(|account| panic!("{account}\nCGT_SEED={seed}"));
    eprintln!("{name}: CGT_SEED={seed}, {cases} cases: {stakes}");
    // Of longer runs as much more is asked.
    let least: Vec<_> = least.iter().map(|(what, n)| (*what, n * cases.div_ceil(everyday))).collect();
    let lacking = stakes.lacking(&least);
    assert!(
        lacking.is_empty(),
        "{name}: no verdict, too little was at stake: {}; CGT_SEED={seed}",
        lacking.join(", ")
    );
}

#[test]
fn what_integers_know_is_what_every_tracer_says() {
    hold("certain", 1_000, &[], certain);
}

#[test]
fn no_promise_is_broken_on_directed_scenes() {
    hold("pictures", 1_000, &[], pictures);
}

#[test]
fn no_promise_is_broken_on_any_finite_numbers() {
    hold("wild", 1_000, &[], wild);
}

#[test]
fn a_changed_case_changes_its_picture_as_it_must() {
    hold("relations", 400, &[], relations);
}
