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

/// Radii in Ångström of A. Bondi, J. Phys. Chem. 68 (1964) 441.
const BONDI: &str = "\
    H 1.20 He 1.40 Li 1.82 C 1.70 N 1.55 O 1.52 F 1.47 Ne 1.54 Na 2.27 Mg 1.73 Si 2.10 P 1.80 S 1.80 Cl 1.75 \
    Ar 1.88 K 2.75 Ni 1.63 Cu 1.40 Zn 1.39 Ga 1.87 As 1.85 Se 1.90 Br 1.85 Kr 2.02 Pd 1.63 Ag 1.72 Cd 1.58 \
    In 1.93 Sn 2.17 Te 2.06 I 1.98 Xe 2.16 Pt 1.75 Au 1.66 Hg 1.55 Tl 1.96 Pb 2.02 U 1.86";

/// Those that Bondi has not: S. Alvarez, Dalton Trans. 42 (2013) 8617, table 1.
const ALVAREZ: &str = "\
    Be 1.98 B 1.91 Al 2.25 Ca 2.62 Sc 2.58 Ti 2.46 V 2.42 Cr 2.45 Mn 2.45 Fe 2.44 Co 2.40 Rb 3.21 Sr 2.84 \
    Mo 2.45 Cs 3.48 Ba 3.03";

/// Colours of Jmol's list (jmol.sourceforge.net/jscolors) that are kept as they are.
const JMOL: &str = "\
    He d9ffff Li cc80ff Be c2ff00 B ffb5b5 C 909090 F 90e050 Ne b3e3f5 Na ab5cf2 Al bfa6a6 Si f0c8a0 P ff8000 \
    Ar 80d1e3 K 8f40d4 Sc e6e6e6 Ti bfc2c7 V a6a6ab Cr 8a99c7 Mn 9c7ac7 Fe e06633 Co f090a0 Ni 50d050 Cu c88033 \
    Zn 7d80b0 Ga c28f8f As bd80e3 Se ffa100 Kr 5cb8d1 Mo 54b5b5 Ag c0c0c0 Cd ffd98f In a67573 Sn 668080 \
    Te d47a00 Xe 429eb0 Pt d0d0e0 Au ffd123 Hg b8b8d0 Tl a6544d Pb 575961";

/// Ours in place of Jmol's, which stand third.
const SOFTENED: &str = "\
    H f0f0f0 ffffff N 4664f8 3050f8 O f0281e ff0d0d Mg 64dc28 8aff00 S fadc32 ffff30 Cl 32e632 1ff01f \
    Ca 5aeb3c 3dff00 Br ba3d29 a62929 Rb 8442b0 702eb0 Sr 3cf03c 00ff00 Pd 3c7d99 006985 I a828a8 940094 \
    Cs 7535a3 57178f Ba 28c928 00c900 U 288fff 008fff";

/// The periodic table, row by row; the lanthanides and actinides where they stand by number.
const PERIODIC: &str = "\
    H He \
    Li Be B C N O F Ne \
    Na Mg Al Si P S Cl Ar \
    K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr \
    Rb Sr Y Zr Nb Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe \
    Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl Pb Bi Po At Rn \
    Fr Ra Ac Th Pa U";

/// Words in groups of `N`.
fn groups<const N: usize>(text: &str) -> Vec<[&str; N]> {
    let words: Vec<&str> = text.split_whitespace().collect();
    assert!(words.len().is_multiple_of(N), "{} words are no groups of {N}", words.len());
    words.chunks_exact(N).map(|group| std::array::from_fn(|i| group[i])).collect()
}

/// Is each row of the table what was published, number, radius and colour, and none beside them? The lists above are the
/// sources' as ASE 3.29 has them (`ase/data/vdw.py`, `vdw_alvarez.py` and `colors.py`), not from the table.
#[test]
fn every_element_is_as_it_was_published() {
    let numbers: Vec<&str> = PERIODIC.split_whitespace().collect();
    let radii = [groups::<2>(BONDI), groups::<2>(ALVAREZ)].concat();
    let softened = groups::<3>(SOFTENED).into_iter().map(|[symbol, ours, _]| [symbol, ours]);
    let colors: Vec<_> = groups::<2>(JMOL).into_iter().chain(softened).collect();
    let all = elements::all();
    assert_eq!((numbers.len(), all.len(), radii.len(), colors.len()), (92, 54, 54, 54));
    let of = |list: &[[&'static str; 2]], symbol: &str| {
        list.iter().find(|[s, _]| *s == symbol).unwrap_or_else(|| panic!("{symbol} was not published"))[1]
    };
    for element in all {
        let symbol = element.symbol;
        assert_eq!(numbers[usize::from(element.number) - 1], symbol, "the place in the periodic table");
        assert_eq!(format!("{:.2}", element.radius), of(&radii, symbol), "radius of {symbol}");
        let [red, green, blue] = element.color;
        assert_eq!(format!("{red:02x}{green:02x}{blue:02x}"), of(&colors, symbol), "colour of {symbol}");
        assert_eq!(elements::by_number(element.number.into()), Some(element), "{symbol} by its number");
        assert_eq!(elements::by_symbol(&symbol.to_uppercase()), Some(element), "{symbol} by its letters");
    }
    // Softened is no other hue: each channel is within 64 of Jmol's.
    for [symbol, ours, jmol] in groups::<3>(SOFTENED) {
        let channel = |hex: &str, i: usize| u8::from_str_radix(&hex[2 * i..2 * i + 2], 16).expect("hex");
        assert!(
            (0..3).all(|i| channel(ours, i).abs_diff(channel(jmol, i)) <= 64),
            "{symbol}: {ours} for {jmol}"
        );
    }
}
