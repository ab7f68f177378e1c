//! Positions in a file, and errors that carry one.

/// A place in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Location {
    /// Line, counted from 1.
    pub line: u32,
    /// Column in characters, counted from 1.
    pub column: u32,
}

impl std::fmt::Display for Location {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

/// What is wrong with a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The file as the user named it.
    pub file: String,
    /// Where in the file.
    pub place: Location,
    /// What was found there.
    pub found: String,
    /// What would be valid.
    pub valid: String,
}

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}: {}; valid: {}", self.file, self.place, self.found, self.valid)
    }
}

impl std::error::Error for Error {}

/// What is wrong, in a file whose name is added on the way out.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    pub(crate) place: Location,
    pub(crate) found: String,
    pub(crate) valid: String,
}

impl Problem {
    pub(crate) fn new(place: Location, found: impl Into<String>, valid: impl Into<String>) -> Problem {
        Problem { place, found: found.into(), valid: valid.into() }
    }

    pub(crate) fn within(self, file: &str) -> Error {
        Error { file: file.to_owned(), place: self.place, found: self.found, valid: self.valid }
    }
}
