//! Rows of cells, each made of a word, a number or an option of one.

pub use files::table::{Cell, Sheet as Rows};

/// A row for a table of words and numbers.
macro_rules! row {
    ($($cell:expr),+ $(,)?) => { vec![$($crate::hard::rows::Cell::from($cell)),+] };
}
pub(crate) use row;
