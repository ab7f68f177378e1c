//! What can be wrong with a picture's data; each message carries the numbers and says what would be valid.

use std::fmt;

/// Why a picture could not be made.
#[derive(Debug, Clone, PartialEq)]
pub enum PlotError {
    /// The page or a panel has no room; lengths in millimetres.
    Room {
        /// What is too small, for instance "page" or "panel (b)".
        what: String,
        /// Width found.
        width: f64,
        /// Height found.
        height: f64,
    },
    /// An axis or a colour scale has an unusable range.
    Range {
        /// The label of the axis.
        axis: String,
        /// Lower end given.
        from: f64,
        /// Upper end given.
        to: f64,
        /// What a valid range looks like.
        valid: &'static str,
    },
    /// A label's markup cannot be read.
    Markup {
        /// The whole label.
        label: String,
        /// Where it went wrong, counted in characters from 0.
        position: usize,
        /// What was expected.
        reason: String,
    },
    /// Neither vendored face has a glyph for the character.
    Glyph {
        /// The character without a glyph.
        character: char,
    },
    /// Two arrays that belong together differ in length.
    Length {
        /// What the arrays describe.
        what: String,
        /// Number of entries needed.
        expected: usize,
        /// Number of entries given.
        found: usize,
    },
    /// The panels do not fit the grid, or a colour scale is missing.
    Layout(String),
    /// The drawing could not be turned into pixels or a file; never caused by data.
    Backend(String),
}

impl fmt::Display for PlotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Room { what, width, height } => {
                write!(f, "{what} is {width} mm x {height} mm; both sides must be finite and between 5 and 2000 mm")
            }
            Self::Range { axis, from, to, valid } => {
                write!(f, "axis '{axis}' runs from {from} to {to}; {valid}")
            }
            Self::Markup { label, position, reason } => {
                write!(f, "label '{label}', character {position}: {reason}")
            }
            Self::Glyph { character } => {
                let code = u32::from(*character);
                write!(f, "the vendored fonts have no glyph for '{character}' (U+{code:04X})")
            }
            Self::Length { what, expected, found } => {
                write!(f, "{what}: {expected} values needed, {found} given")
            }
            Self::Layout(reason) => write!(f, "layout: {reason}"),
            Self::Backend(reason) => write!(f, "drawing: {reason}"),
        }
    }
}

impl std::error::Error for PlotError {}
