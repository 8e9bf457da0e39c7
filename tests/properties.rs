//! Do properties hold of whatever proptest draws: known answers of integers, the judge's verdict on any plan, and metamorphic relations?
//! Each run prints its seed and what was at stake, and has no verdict if that was too little. `CGT_PROPERTY_CASES` sets how many cases
//! each property draws.

use verify::properties::Property;
use verify::properties::relations::RELATIONS;
use verify::seed::{count, seed};

/// Runs a property and asks whether enough was at stake.
fn hold(everyday: u64, least: &[(&str, u64)], property: Property) {
    let name = property.word();
    let (seed, cases) = (seed(), count("CGT_PROPERTY_CASES", everyday));
    let stakes = property.hold(seed, cases).unwrap_or_else(|account| panic!("{account}\nCGT_SEED={seed}"));
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
    let least = [
        ("rays whose answer is known", 40_000),
        ("known hits", 1_000),
        ("known in the textbook form", 900),
        ("known in the perpendicular form", 25),
        ("known tangents", 150),
        ("known ties", 50),
        ("known from inside or on a surface", 600),
        ("pictures of the reference", 15_000),
        ("pictures of the grid tracer", 8_000),
    ];
    hold(4_000, &least, Property::Certain);
}

#[test]
fn no_promise_is_broken_on_directed_scenes() {
    let least = [
        ("hits", 25_000),
        ("rays along +x", 5_000),
        ("rays along -x", 5_000),
        ("rays along +y", 5_000),
        ("rays along -y", 5_000),
        ("rays along +z", 5_000),
        ("rays along -z", 5_000),
        ("rays near tangents", 10_000),
        ("rays from inside a sphere", 10_000),
        ("rays from a surface", 2_000),
        ("rays with an equal second hit", 400),
        ("rays to spheres over 1,000 radii away", 5_000),
        ("spheres in several cells", 4_000),
        ("spheres that span three cells or more", 1_500),
        ("spheres within 4 ulp of a plane", 250),
        ("candidates culled", 5_000),
        ("blocks split", 200),
        ("queues full", 15),
        ("too large for eight corners", 200),
        ("scenes out of range", 15),
        ("rays that f32 left to f64", 2_000),
        ("rays that f64 left to integers", 1_000),
        ("t rounded by integers", 15),
        ("frames refused", 5),
        ("frames within the bound of rounding", 300),
    ];
    hold(2_500, &least, Property::Pictures);
}

#[test]
fn no_promise_is_broken_among_hundreds_of_spheres() {
    let least = [
        ("grids of more spheres than a tile takes in one round", 150),
        ("hits", 3_000),
        ("spheres in several cells", 20_000),
    ];
    hold(400, &least, Property::Swarms);
}

#[test]
fn no_promise_is_broken_on_any_finite_numbers() {
    let least = [
        ("hits", 5_000),
        ("scenes out of range", 500),
        ("rays that f32 left to f64", 8_000),
        ("rays that f64 left to integers", 150),
        ("frames beyond a form's range", 50),
        ("frames refused", 10),
    ];
    hold(1_500, &least, Property::Wild);
}

#[test]
fn a_changed_case_changes_its_picture_as_it_must() {
    let least = RELATIONS.map(|relation| (relation.name(), 4_000));
    hold(800, &least, Property::Relations);
}
