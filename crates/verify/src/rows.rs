//! Compares tables of rows with committed ones, byte for byte.

/// How the rows of a table that was made must lie to those of the committed one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// The same bytes.
    Same,
    /// Each is among the committed ones, in the same order.
    Fewer,
    /// All the committed ones are among them, in the same order.
    More,
}

/// The first line that keeps the two tables from lying so, with its number in its own table; nothing when they do.
pub fn first_stranger(made: &str, committed: &str, relation: Relation) -> Option<String> {
    let stranger = |few: &str, many: &str, whose: &str| {
        let mut left = many.lines();
        // a header is a row like the others: it comes first in both
        let lost = few.lines().enumerate().find(|(_, line)| !left.any(|other| other == *line))?;
        Some(format!("{whose} line {}: {}", lost.0 + 1, lost.1))
    };
    match relation {
        Relation::Fewer => stranger(made, committed, "made"),
        Relation::More => stranger(committed, made, "committed"),
        Relation::Same if made == committed => None,
        Relation::Same => stranger(made, committed, "made")
            .or_else(|| stranger(committed, made, "committed"))
            .or_else(|| Some("line ends".to_owned())),
    }
}
