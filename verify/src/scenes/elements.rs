//! The table of elements: symbol, van der Waals radius and a colour to draw it in. Out goes the row for a
//! symbol or an atomic number; what the table does not hold is `None`, and the readers then use [`UNKNOWN`]
//! and say so.
//!
//! Radii in Ångström: A. Bondi, "van der Waals Volumes and Radii", J. Phys. Chem. 68 (1964) 441; where Bondi
//! gives none, S. Alvarez, "A cartography of the van der Waals territories", Dalton Trans. 42 (2013) 8617.
//! Colours are those of Jmol's list, which follow the habit of Corey, Pauling and Koltun's models, softened where dark or
//! glaring ones would hide the shading.

use contract::Rgb;

/// What is known of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// Protons; 0 for [`UNKNOWN`].
    pub number: u8,
    /// One or two letters, as the periodic table spells them.
    pub symbol: &'static str,
    /// Van der Waals radius in Ångström.
    pub radius: f32,
    /// Colour it is drawn in.
    pub color: Rgb,
}

/// What stands in for an element that is not known: the size of carbon, pink.
pub const UNKNOWN: Element = row(0, "?", 1.70, [255, 105, 180]);

/// The row of a symbol, whatever the case of its letters; `D` is hydrogen.
#[must_use]
pub fn by_symbol(symbol: &str) -> Option<&'static Element> {
    let symbol = if symbol.eq_ignore_ascii_case("D") { "H" } else { symbol };
    TABLE.iter().find(|e| e.symbol.eq_ignore_ascii_case(symbol))
}

/// The row of an atomic number.
#[must_use]
pub fn by_number(number: u64) -> Option<&'static Element> {
    TABLE.iter().find(|e| u64::from(e.number) == number)
}

/// All rows, by atomic number.
#[must_use]
pub fn all() -> &'static [Element] {
    TABLE
}

const fn row(number: u8, symbol: &'static str, radius: f32, color: Rgb) -> Element {
    Element { number, symbol, radius, color }
}

const TABLE: &[Element] = &[
    row(1, "H", 1.20, [240, 240, 240]),
    row(2, "He", 1.40, [217, 255, 255]),
    row(3, "Li", 1.82, [204, 128, 255]),
    row(4, "Be", 1.98, [194, 255, 0]),  // Alvarez
    row(5, "B", 1.91, [255, 181, 181]), // Alvarez
    row(6, "C", 1.70, [144, 144, 144]),
    row(7, "N", 1.55, [70, 100, 248]),
    row(8, "O", 1.52, [240, 40, 30]),
    row(9, "F", 1.47, [144, 224, 80]),
    row(10, "Ne", 1.54, [179, 227, 245]),
    row(11, "Na", 2.27, [171, 92, 242]),
    row(12, "Mg", 1.73, [100, 220, 40]),
    row(13, "Al", 2.25, [191, 166, 166]), // Alvarez
    row(14, "Si", 2.10, [240, 200, 160]),
    row(15, "P", 1.80, [255, 128, 0]),
    row(16, "S", 1.80, [250, 220, 50]),
    row(17, "Cl", 1.75, [50, 230, 50]),
    row(18, "Ar", 1.88, [128, 209, 227]),
    row(19, "K", 2.75, [143, 64, 212]),
    row(20, "Ca", 2.62, [90, 235, 60]),   // Alvarez
    row(21, "Sc", 2.58, [230, 230, 230]), // Alvarez
    row(22, "Ti", 2.46, [191, 194, 199]), // Alvarez
    row(23, "V", 2.42, [166, 166, 171]),  // Alvarez
    row(24, "Cr", 2.45, [138, 153, 199]), // Alvarez
    row(25, "Mn", 2.45, [156, 122, 199]), // Alvarez
    row(26, "Fe", 2.44, [224, 102, 51]),  // Alvarez
    row(27, "Co", 2.40, [240, 144, 160]), // Alvarez
    row(28, "Ni", 1.63, [80, 208, 80]),
    row(29, "Cu", 1.40, [200, 128, 51]),
    row(30, "Zn", 1.39, [125, 128, 176]),
    row(31, "Ga", 1.87, [194, 143, 143]),
    row(33, "As", 1.85, [189, 128, 227]),
    row(34, "Se", 1.90, [255, 161, 0]),
    row(35, "Br", 1.85, [186, 61, 41]),
    row(36, "Kr", 2.02, [92, 184, 209]),
    row(37, "Rb", 3.21, [132, 66, 176]), // Alvarez
    row(38, "Sr", 2.84, [60, 240, 60]),  // Alvarez
    row(42, "Mo", 2.45, [84, 181, 181]), // Alvarez
    row(46, "Pd", 1.63, [60, 125, 153]),
    row(47, "Ag", 1.72, [192, 192, 192]),
    row(48, "Cd", 1.58, [255, 217, 143]),
    row(49, "In", 1.93, [166, 117, 115]),
    row(50, "Sn", 2.17, [102, 128, 128]),
    row(52, "Te", 2.06, [212, 122, 0]),
    row(53, "I", 1.98, [168, 40, 168]),
    row(54, "Xe", 2.16, [66, 158, 176]),
    row(55, "Cs", 3.48, [117, 53, 163]), // Alvarez
    row(56, "Ba", 3.03, [40, 201, 40]),  // Alvarez
    row(78, "Pt", 1.75, [208, 208, 224]),
    row(79, "Au", 1.66, [255, 209, 35]),
    row(80, "Hg", 1.55, [184, 184, 208]),
    row(81, "Tl", 1.96, [166, 84, 77]),
    row(82, "Pb", 2.02, [87, 89, 97]),
    row(92, "U", 1.86, [40, 143, 255]),
];
