//! Words for scenes, and the tables of names and elements.

use contract::Size;
use std::path::Path;
use verify::scenes::catalogue::{self, Data, ENTRIES, Source, SourceError};
use verify::scenes::elements;
use verify::scenes::frame::{Framing, in_view};

#[test]
fn words_stand_for_sources() {
    let good = [
        "1hvr",
        "1HVR",
        "2juy",
        "adk",
        "sphereflake",
        "sphereflake:2",
        "uniform:10",
        "uniform:10:3",
        "lattice:4",
    ];
    for word in good {
        Source::parse(word).unwrap_or_else(|e| panic!("{word}: {e}"));
    }
    let pair = Source::parse("some/run.dcd,some/atoms.pdb").expect("a path");
    assert!(matches!(&pair, Source::File { path, atoms: Some(a) }
        if path == Path::new("some/run.dcd") && a == Path::new("some/atoms.pdb")));
    for (word, parts) in [
        ("nothing", &["nothing", "1hvr", "sphereflake:LEVELS"][..]),
        ("uniform", &["count is \"\""]),
        ("uniform:x", &["count is \"x\""]),
        ("uniform:1:-1", &["seed is \"-1\""]),
        ("uniform:1:2:3", &["end is \"3\""]),
        ("lattice:3:1", &["end is \"1\""]),
    ] {
        let message = Source::parse(word).expect_err("no scene").to_string();
        assert!(parts.iter().all(|p| message.contains(p)), "{word}: {message}");
    }
    let too_many = Source::parse("uniform:99999999999").expect("well formed").load().expect_err("too many");
    assert!(matches!(too_many, SourceError::Generate(_)), "{too_many}");
}

/// The sphereflake is shown as its author shows it; a wish for another size keeps the rest.
#[test]
fn sphereflake_brings_its_own_view() {
    let flake = Source::parse("sphereflake:2").expect("a generator").load().expect("made");
    let wish = Framing { size: Size::new(64, 64).ok(), ..Framing::default() };
    for wish in [Framing::default(), wish] {
        let camera = flake.camera(&wish).expect("framed");
        assert_eq!(camera.eye(), [2.1, 1.3, 1.7]);
        assert!(flake.animation.frames()[0].spheres().iter().all(|s| in_view(&camera, s)));
        assert_eq!(Some(camera.size()), wish.size.or(Size::new(1280, 720).ok()));
    }
}

#[test]
fn absent_data_says_how_to_get_it() {
    let nowhere = Path::new("no/such/folder");
    let mut absent = 0;
    for entry in ENTRIES {
        match (entry.data, entry.load(nowhere)) {
            (Data::Bundled(..), loaded) => assert!(loaded.is_ok(), "{} needs no folder", entry.name),
            (_, Err(SourceError::DataAbsent { name, how })) => {
                assert_eq!((name, how), (entry.name, catalogue::FETCH));
                absent += 1;
            }
            (_, other) => panic!("{}: {other:?}", entry.name),
        }
    }
    assert_eq!(absent, 8);
    assert_eq!(catalogue::list().len(), ENTRIES.len() + 4);
}

#[test]
fn elements_are_those_of_bondi() {
    for (symbol, number, radius) in
        [("H", 1, 1.20), ("C", 6, 1.70), ("N", 7, 1.55), ("O", 8, 1.52), ("P", 15, 1.80), ("S", 16, 1.80)]
    {
        let element = elements::by_symbol(symbol).expect("in the table");
        assert_eq!((element.number, element.radius), (number, radius), "{symbol}");
    }
    let all = elements::all();
    assert!(all.windows(2).all(|w| w[0].number < w[1].number), "sorted, none twice");
    assert!(all.iter().all(|e| e.radius > 1.0 && e.radius < 4.0));
    assert_eq!(elements::by_symbol("d").map(|e| e.symbol), Some("H"));
    assert_eq!(elements::by_symbol("Qq"), None);
}
