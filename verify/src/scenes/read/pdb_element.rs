//! Which element an atom of a PDB file is. Columns 77 and 78 say it where they are filled; else it follows from
//! the atom's name in columns 13 to 16. What comes out is a row of the table of elements, or nothing.
//!
//! The name's rule: the element stands right-justified in columns 13 and 14, so " CA " is carbon and "CA  "
//! calcium. It has exceptions that real files live by. Four-letter hydrogens begin in column 13 ("HG11"), digits
//! may come first ("1HG1"), and many programs justify all names to the left, so that the alpha carbon of a
//! methionine stands as "CA  ". Hence in residues made of H, C, N, O, S and P only - amino acids, nucleotides,
//! water - the first letter decides; and CHARMM's ions go by the residue's name.

use crate::scenes::elements::{Element, by_symbol};

/// `symbol` is columns 77-78, `name` columns 13-16 as they stand, `residue` columns 18-21 without white space.
pub(super) fn element(symbol: &[u8], name: &[u8], residue: &[u8]) -> Option<&'static Element> {
    by_letters(symbol).or_else(|| ion(residue, name)).or_else(|| by_name(name, residue))
}

fn by_letters(letters: &[u8]) -> Option<&'static Element> {
    std::str::from_utf8(letters.trim_ascii()).ok().and_then(by_symbol)
}

fn by_name(name: &[u8], residue: &[u8]) -> Option<&'static Element> {
    let letters: Vec<u8> =
        name.trim_ascii().iter().copied().skip_while(|b| !b.is_ascii_alphabetic()).collect();
    let first = letters.get(..1)?;
    let two = letters.get(..2).filter(|t| t[1].is_ascii_alphabetic());
    if ORGANIC.contains(&residue) {
        return by_letters(first);
    }
    let starts_at_13 = name.first().is_some_and(u8::is_ascii_alphabetic);
    let long_hydrogen = first == b"H" && letters.len() >= 4;
    let two = two.filter(|_| starts_at_13 && !long_hydrogen).and_then(by_letters);
    two.or_else(|| by_letters(first))
}

/// Ions whose residue and atom have one name.
fn ion(residue: &[u8], name: &[u8]) -> Option<&'static Element> {
    let symbol = match residue {
        b"SOD" | b"NA" | b"NA+" => "Na",
        b"POT" | b"K" | b"K+" => "K",
        b"CLA" | b"CL" | b"CL-" => "Cl",
        b"CAL" => "Ca",
        b"MG2" => "Mg",
        b"ZN2" => "Zn",
        _ => return None,
    };
    (name.trim_ascii() == residue).then(|| by_symbol(symbol)).flatten()
}

#[rustfmt::skip]
const ORGANIC: &[&[u8]] = &[
    b"ALA", b"ARG", b"ASN", b"ASP", b"CYS", b"GLN", b"GLU", b"GLY", b"HIS", b"ILE", b"LEU", b"LYS", b"MET",
    b"PHE", b"PRO", b"SER", b"THR", b"TRP", b"TYR", b"VAL", b"ASX", b"GLX", b"ACE", b"NH2", b"NME",
    b"HSD", b"HSE", b"HSP", b"HID", b"HIE", b"HIP", b"CYX", b"CYM", b"ASH", b"GLH", b"LYN",
    b"A", b"C", b"G", b"U", b"T", b"I", b"DA", b"DC", b"DG", b"DT", b"DU", b"DI", b"ADE", b"CYT", b"GUA", b"THY", b"URA",
    b"HOH", b"WAT", b"H2O", b"SOL", b"DOD", b"TIP", b"TIP3", b"TIP4", b"SPC",
];

#[cfg(test)]
mod tests {
    use super::element;

    #[test]
    fn element_follows_columns_then_name() {
        let cases: &[(&str, &str, &str, Option<&str>)] = &[
            (" C", " CA ", "MET", Some("C")),
            ("ZN", "ZN  ", "ZN", Some("Zn")),
            ("", " CA ", "MET", Some("C")),
            ("", "CA  ", "CA", Some("Ca")),
            ("", "CA  ", "MET", Some("C")),
            ("", " CA ", "XXX", Some("C")),
            ("", "HG11", "VAL", Some("H")),
            ("", "HG11", "LIG", Some("H")),
            ("", "HG  ", "HG", Some("Hg")),
            ("", "1HG2", "ILE", Some("H")),
            ("", "2HB ", "XXX", Some("H")),
            ("", "SD  ", "MET", Some("S")),
            ("", "SOD ", "SOD", Some("Na")),
            ("", "CLA ", "CLA", Some("Cl")),
            ("", "FE  ", "HEM", Some("Fe")),
            ("", " FE ", "HEM", Some("F")),
            ("", " OW ", "SOL", Some("O")),
            ("", " MW ", "SOL", None),
            ("", "    ", "ALA", None),
            ("", "12  ", "ALA", None),
            ("Q9", " N  ", "ALA", Some("N")),
        ];
        for &(symbol, name, residue, want) in cases {
            let got = element(symbol.as_bytes(), name.as_bytes(), residue.as_bytes()).map(|e| e.symbol);
            assert_eq!(got, want, "columns 77-78 {symbol:?}, name {name:?}, residue {residue:?}");
        }
    }
}
