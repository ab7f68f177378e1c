//! Errors in a picture's data.

use std::fmt;

/// Why a picture could not be made: the message carries the numbers and says what would be valid.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotError(pub(crate) String);

impl PlotError {
    /// A page or panel has no room; lengths in millimetres.
    pub(crate) fn room(what: &str, width: f64, height: f64) -> Self {
        Self(format!("{what} is {width} mm x {height} mm; both sides must be finite and between 5 and 2000 mm"))
    }

    /// An axis has an unusable range.
    pub(crate) fn range(axis: &str, from: f64, to: f64, valid: &str) -> Self {
        Self(format!("axis '{axis}' runs from {from} to {to}; {valid}"))
    }

    /// Two arrays that belong together differ in length.
    pub(crate) fn length(what: &str, expected: usize, found: usize) -> Self {
        Self(format!("{what}: {expected} values needed, {found} given"))
    }
}

impl fmt::Display for PlotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for PlotError {}
