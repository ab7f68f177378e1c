//! Rows of cells, each made from a word, a number or an optional number.

pub use files::table::{CellValue, MixedTable as Rows};

/// A row for a table of words and numbers.
macro_rules! row {
    ($($cell:expr),+ $(,)?) => { vec![$($crate::hard::rows::CellValue::from($cell)),+] };
}
pub(crate) use row;
