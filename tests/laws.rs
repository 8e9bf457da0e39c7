//! Do laws between operations hold on every machine, for every class of bit patterns? `CGT_LAW_TESTS` sets how many drawings each
//! machine gets.

use verify::properties::laws::{CLASSES, laws, laws_miss};
use verify::seed::{count, seed};

#[test]
fn every_machine_keeps_the_laws() {
    let (seed, tests) = (seed(), count("CGT_LAW_TESTS", 3_000));
    let (drawn, machines) = laws(seed, tests).unwrap_or_else(|broken| panic!("{broken}; CGT_SEED={seed}"));
    eprintln!("CGT_SEED={seed}, {tests} drawings for each of {}: {drawn:?}", machines.join(", "));
    for class in CLASSES {
        let lanes = drawn.get(&class).copied().unwrap_or(0);
        assert!(lanes > 1_000, "hardly any lane was {class:?}: {lanes}; CGT_SEED={seed}");
    }
    assert!(machines.len() > 3, "only {machines:?}: no level but the scalar one was asked");
}

#[test]
fn a_machine_with_one_operation_wrong_breaks_a_law() {
    let seed = seed();
    let faults = laws_miss(seed, 300).unwrap_or_else(|missed| panic!("{missed}; CGT_SEED={seed}"));
    eprintln!("CGT_SEED={seed}: {faults} wrong machines, each found");
}
