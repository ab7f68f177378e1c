//! The paper's symbols of what scenes and tables name: one list for pictures and page.

/// Names and their symbols in LaTeX.
const SYMBOLS: [(&str, &str); 12] = [
    ("a_v", "\\tilde a_v"),
    ("d_gap", "d'"),
    ("delta", "\\delta"),
    ("epsilon", "\\varepsilon"),
    ("headway", "\\Delta y"),
    ("length", "L'"),
    ("mu", "\\mu"),
    ("pedestrians", "N"),
    ("phi", "\\Phi"),
    ("re_z", "\\mathrm{Re}\\,z^+"),
    ("shift", "\\epsilon_1"),
    ("v0", "v_0'"),
];

/// The symbol of a parameter or a column in LaTeX; the name itself where the paper has none.
pub fn latex(name: &str) -> &str {
    SYMBOLS.iter().find(|(known, _)| *known == name).map_or(name, |(_, symbol)| symbol)
}
