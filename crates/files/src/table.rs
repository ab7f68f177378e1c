//! Tables of numbers: named columns, rows of `f64`, CSV with LF and numbers in shortest round-trip form.

use crate::write;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

/// A table: column names and rows, all numbers `f64` (whole numbers are written without a point).
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Names of the columns, snake_case, left to right.
    pub columns: Vec<String>,
    /// The cells row by row; the length is a multiple of `columns.len()`.
    cells: Vec<f64>,
}

/// Why a table could not be read: where, and what was found.
#[derive(Debug)]
pub enum TableError {
    /// The file could not be read.
    Io(io::Error),
    /// Line (from 1) and what is wrong there.
    Malformed {
        /// Line of the file, counted from 1.
        line: u64,
        /// What was found and what was expected.
        problem: String,
    },
    /// No column of this name; the names that exist.
    NoColumn {
        /// The name asked for.
        name: String,
        /// The names that exist.
        columns: Vec<String>,
    },
}

impl std::fmt::Display for TableError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            TableError::Io(error) => write!(f, "{error}"),
            TableError::Malformed { line, problem } => write!(f, "line {line}: {problem}"),
            TableError::NoColumn { name, columns } => {
                write!(f, "no column {name}; the table has {}", columns.join(", "))
            }
        }
    }
}

impl std::error::Error for TableError {}

impl Table {
    /// An empty table with these columns.
    pub fn new(columns: &[&str]) -> Table {
        Table { columns: columns.iter().map(|&name| name.to_owned()).collect(), cells: Vec::new() }
    }

    /// Appends a row.
    ///
    /// # Panics
    /// If the row has not one number for each column: an error of the program, not of its input.
    pub fn push(&mut self, row: &[f64]) {
        assert_eq!(row.len(), self.columns.len(), "a row of {:?}", self.columns);
        self.cells.extend_from_slice(row);
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.cells.len() / self.columns.len().max(1)
    }

    /// Whether the table has no row.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// The rows, each a slice with one number for each column.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.cells.chunks_exact(self.columns.len().max(1))
    }

    /// One column from the first row to the last.
    ///
    /// # Errors
    /// [`TableError::NoColumn`] when there is no column of this name.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, TableError> {
        let Some(index) = self.columns.iter().position(|column| column == name) else {
            return Err(TableError::NoColumn { name: name.to_owned(), columns: self.columns.clone() });
        };
        Ok(self.rows().map(|row| row[index]).collect())
    }

    /// The table as CSV: a header, then a line for each row, numbers in shortest form that reads back to the same bits.
    pub fn to_csv(&self) -> Vec<u8> {
        let mut text = self.columns.join(",");
        text.push('\n');
        text.reserve(self.cells.len() * 18);
        for row in self.rows() {
            for (index, &number) in row.iter().enumerate() {
                if index > 0 {
                    text.push(',');
                }
                push_number(&mut text, number);
            }
            text.push('\n');
        }
        text.into_bytes()
    }

    /// Reads CSV as [`Table::to_csv`] writes it.
    ///
    /// # Errors
    /// [`TableError::Malformed`] with the line, for a name of a column that is not in small letters, digits and `_` or
    /// stands twice, a cell that is not a finite number, or a row of another length.
    pub fn parse(bytes: &[u8]) -> Result<Table, TableError> {
        let mut reader = csv::Reader::from_reader(bytes);
        let header = reader.byte_headers().map_err(malformed)?;
        let line = header.position().map_or(1, csv::Position::line);
        let columns = names(header).map_err(|problem| TableError::Malformed { line, problem })?;
        let mut cells = Vec::new();
        let mut record = csv::ByteRecord::new();
        while reader.read_byte_record(&mut record).map_err(malformed)? {
            let line = record.position().map_or(0, csv::Position::line);
            for cell in &record {
                cells.push(number(cell).ok_or_else(|| TableError::Malformed {
                    line,
                    problem: format!("{:?} is not a finite number", String::from_utf8_lossy(cell)),
                })?);
            }
        }
        Ok(Table { columns, cells })
    }

    /// Reads a CSV file.
    ///
    /// # Errors
    /// As [`Table::parse`], or the file cannot be read.
    pub fn read(path: &Path) -> Result<Table, TableError> {
        let bytes = std::fs::read(path).map_err(|error| TableError::Io(write::with_path(error, path)))?;
        Table::parse(&bytes)
    }
}

/// Appends the shortest decimal form that reads back to the same bits; whole numbers below 2^53 without a point.
pub fn push_number(text: &mut String, number: f64) {
    const EXACT_WHOLE: f64 = 9_007_199_254_740_992.0;
    if number.fract() == 0.0 && number.abs() < EXACT_WHOLE && (number != 0.0 || number.is_sign_positive()) {
        // writing to a String cannot fail
        let _ = write!(text, "{}", number as i64);
    } else {
        let _ = write!(text, "{number:?}");
    }
}

/// The names of the columns: what [`Table::to_csv`] writes without quotes and a name finds again.
fn names(header: &csv::ByteRecord) -> Result<Vec<String>, String> {
    let mut names: Vec<String> = Vec::new();
    for bytes in header {
        let name = String::from_utf8_lossy(bytes).into_owned();
        let is_good = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_';
        if name.is_empty() || !name.bytes().all(is_good) {
            return Err(format!("{name:?} is no name of a column; small letters, digits and _ make one"));
        }
        if names.contains(&name) {
            return Err(format!("the column {name} stands twice"));
        }
        names.push(name);
    }
    match names.is_empty() {
        true => Err("there is no header".to_owned()),
        false => Ok(names),
    }
}

fn number(cell: &[u8]) -> Option<f64> {
    std::str::from_utf8(cell).ok()?.parse().ok().filter(|number: &f64| number.is_finite())
}

fn malformed(error: csv::Error) -> TableError {
    let line = error.position().map_or(0, csv::Position::line);
    TableError::Malformed { line, problem: error.to_string() }
}
