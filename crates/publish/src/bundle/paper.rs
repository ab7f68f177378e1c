//! What the descriptions in the archive say of the paper and of this software: as CITATION.cff, which a test compares.

/// The paper's title.
pub const TITLE: &str = "Jamming transitions in force-based models for pedestrian dynamics";
/// Its authors: family name, given name.
pub const AUTHORS: [(&str, &str); 6] = [
    ("Chraibi", "Mohcine"),
    ("Ezaki", "Takahiro"),
    ("Tordeux", "Antoine"),
    ("Nishinari", "Katsuhiro"),
    ("Schadschneider", "Andreas"),
    ("Seyfried", "Armin"),
];
/// Its identifier.
pub const DOI: &str = "10.1103/PhysRevE.92.042809";
/// The title of this software.
pub const SOFTWARE: &str = "Jamming transitions in force-based models for pedestrian dynamics: a reproduction";
/// Who made it.
pub const MAKERS: &str = "The authors of this reproduction";
/// Words to find it by.
pub const KEYWORDS: [&str; 4] = ["pedestrian dynamics", "force-based models", "stop-and-go waves", "reproducibility"];
/// Its version.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What it is, in two sentences.
pub const DESCRIPTION: &str = "All figures of the paper computed again, with the same bits on every machine tried, and \
    what of its claims holds. Sources of the project and of everything it depends on, tables, pictures.";

/// The paper as an address.
pub fn address() -> String {
    format!("https://doi.org/{DOI}")
}
