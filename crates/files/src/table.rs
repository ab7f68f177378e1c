//! Tables with named columns, written as CSV with LF line ends and numbers in shortest round-trip form. The cells of a
//! [`Table`] are numbers; those of a [`MixedTable`] may also be words or empty.

use crate::text;
use crate::write;
use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt::{Display, Write as _};
use std::io;
use std::path::Path;

/// The content of a cell.
pub trait Value: Clone + PartialEq {
    /// The value of a cell's text.
    ///
    /// # Errors
    /// What is wrong with it.
    fn parse(text: &str) -> Result<Self, String>;
    /// Appends the cell's text.
    fn write(&self, text: &mut String);
    /// An order in which cells are equal only when they are the same to the bit, except for 0 and -0.
    fn order(&self, other: &Self) -> Ordering;
    /// Whether it is a word.
    fn is_word(&self) -> bool;
}

/// A number, a word, or nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum CellValue {
    /// A finite number.
    Number(f64),
    /// A word.
    Word(String),
    /// Nothing: there is no such number.
    Empty,
}

impl CellValue {
    fn rank(&self) -> u8 {
        match self {
            CellValue::Empty => 0,
            CellValue::Number(_) => 1,
            CellValue::Word(_) => 2,
        }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            CellValue::Number(number) => Some(*number),
            _ => None,
        }
    }
}

impl Display for CellValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut text = String::new();
        self.write(&mut text);
        f.write_str(&text)
    }
}

impl Value for f64 {
    fn parse(text: &str) -> Result<f64, String> {
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => {
                let hint = text::hint(text).map_or(String::new(), |hint| format!(": {hint}"));
                Err(format!("{text:?} is not a finite number{hint}"))
            }
        }
    }

    fn write(&self, text: &mut String) {
        push_number(text, *self);
    }

    fn order(&self, other: &f64) -> Ordering {
        (self + 0.0).total_cmp(&(other + 0.0))
    }

    fn is_word(&self) -> bool {
        false
    }
}

impl Value for CellValue {
    fn parse(text: &str) -> Result<CellValue, String> {
        Ok(match text.parse() {
            Ok(number) if f64::is_finite(number) => CellValue::Number(number),
            _ if text.is_empty() => CellValue::Empty,
            _ => CellValue::Word(text.to_owned()),
        })
    }

    fn write(&self, text: &mut String) {
        match self {
            CellValue::Number(number) => push_number(text, *number),
            CellValue::Word(word) => text.push_str(word),
            CellValue::Empty => {}
        }
    }

    fn order(&self, other: &CellValue) -> Ordering {
        match (self, other) {
            (CellValue::Number(one), CellValue::Number(other)) => one.order(other),
            (CellValue::Word(one), CellValue::Word(other)) => one.cmp(other),
            _ => self.rank().cmp(&other.rank()),
        }
    }

    fn is_word(&self) -> bool {
        matches!(self, CellValue::Word(_))
    }
}

impl From<f64> for CellValue {
    fn from(number: f64) -> CellValue {
        CellValue::Number(number)
    }
}

impl From<usize> for CellValue {
    fn from(number: usize) -> CellValue {
        CellValue::Number(number as f64)
    }
}

impl From<u64> for CellValue {
    fn from(number: u64) -> CellValue {
        CellValue::Number(number as f64)
    }
}

impl From<&str> for CellValue {
    fn from(word: &str) -> CellValue {
        CellValue::Word(word.to_owned())
    }
}

impl<T: Into<CellValue>> From<Option<T>> for CellValue {
    fn from(cell: Option<T>) -> CellValue {
        cell.map_or(CellValue::Empty, T::into)
    }
}

/// A table of numbers.
pub type Table = Grid<f64>;
/// A table of numbers, words and empty cells.
pub type MixedTable = Grid<CellValue>;

/// Column names and rows. Whole numbers are written without a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<V> {
    /// Names of the columns, snake_case, left to right.
    pub columns: Vec<String>,
    /// The cells row by row; the length is a multiple of `columns.len()`.
    cells: Vec<V>,
}

/// Why a table could not be read: where, and what was found.
#[derive(Debug)]
pub enum TableError {
    /// The file could not be read.
    Io(io::Error),
    /// What is wrong in a line.
    Malformed {
        /// The file; empty for bytes.
        file: String,
        /// Line of the file, counted from 1; 0 for the whole of it.
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

impl Display for TableError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            TableError::Io(error) => write!(f, "{error}"),
            TableError::Malformed { file, line, problem } => match (file.is_empty(), line) {
                (true, _) => write!(f, "line {line}: {problem}"),
                (false, 0) => write!(f, "{file}: {problem}"),
                (false, _) => write!(f, "{file}:{line}: {problem}"),
            },
            TableError::NoColumn { name, columns } => {
                write!(f, "no column {name}; the table has {}", columns.join(", "))
            }
        }
    }
}

impl std::error::Error for TableError {}

fn malformed(line: u64, problem: String) -> TableError {
    TableError::Malformed { file: String::new(), line, problem }
}

impl<V: Value> Grid<V> {
    /// An empty table with these columns.
    pub fn new(columns: &[&str]) -> Grid<V> {
        Grid { columns: columns.iter().map(|&name| name.to_owned()).collect(), cells: Vec::new() }
    }

    /// Appends a row.
    ///
    /// # Panics
    /// If the row has not one cell for each column: an error of the program, not of its input.
    pub fn push<'a>(&mut self, row: impl Into<Cow<'a, [V]>>)
    where
        V: 'a,
    {
        let row = row.into();
        assert_eq!(row.len(), self.columns.len(), "a row of {:?}", self.columns);
        self.cells.extend_from_slice(&row);
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.cells.len() / self.columns.len().max(1)
    }

    /// Whether the table has no row.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// All cells, row by row.
    pub fn into_cells(self) -> Vec<V> {
        self.cells
    }

    /// The rows, each a slice with one cell for each column.
    pub fn rows(&self) -> impl Iterator<Item = &[V]> {
        self.cells.chunks_exact(self.columns.len().max(1))
    }

    /// A row, from 0.
    ///
    /// # Panics
    /// There is no such row: an error of the program.
    pub fn row(&self, index: usize) -> &[V] {
        &self.cells[index * self.columns.len()..][..self.columns.len()]
    }

    /// The place of a column, from 0.
    ///
    /// # Errors
    /// [`TableError::NoColumn`] when there is no column of this name.
    pub fn place(&self, name: &str) -> Result<usize, TableError> {
        let found = self.columns.iter().position(|column| column == name);
        found.ok_or_else(|| TableError::NoColumn { name: name.to_owned(), columns: self.columns.clone() })
    }

    /// One column from the first row to the last.
    ///
    /// # Errors
    /// [`TableError::NoColumn`] when there is no column of this name.
    pub fn column(&self, name: &str) -> Result<Vec<V>, TableError> {
        let index = self.place(name)?;
        Ok(self.rows().map(|row| row[index].clone()).collect())
    }

    /// The table as CSV: a header, then a line for each row, numbers in shortest form that reads back to the same bits.
    pub fn to_csv(&self) -> Vec<u8> {
        let mut writer = csv::WriterBuilder::new().buffer_capacity(1 << 16).from_writer(Vec::new());
        let mut text = String::new();
        // a vector takes every byte, and every row has a cell for each column
        let _ = writer.write_record(&self.columns);
        for row in self.rows() {
            for cell in row {
                text.clear();
                cell.write(&mut text);
                let _ = writer.write_field(&text);
            }
            let _ = writer.write_record(None::<&[u8]>);
        }
        writer.into_inner().unwrap_or_default()
    }

    /// Reads CSV as [`Grid::to_csv`] writes it.
    ///
    /// # Errors
    /// [`TableError::Malformed`] with the line, for text that is not UTF-8, a column name that does not consist of
    /// lower-case letters, digits and `_` or is repeated, a cell that is not a value, or a row of another length.
    pub fn parse(bytes: &[u8]) -> Result<Grid<V>, TableError> {
        let text = text::decode(bytes.to_vec()).map_err(|(line, problem)| malformed(line as u64, problem))?;
        let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
        let broken = |error: csv::Error| malformed(error.position().map_or(0, csv::Position::line), error.to_string());
        let header = reader.headers().map_err(broken)?;
        let line = header.position().map_or(1, csv::Position::line);
        let columns = names(header).map_err(|problem| malformed(line, problem))?;
        let mut cells = Vec::new();
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(broken)? {
            let line = record.position().map_or(0, csv::Position::line);
            if record.len() != columns.len() {
                return Err(malformed(line, other_length(&record, columns.len())));
            }
            for cell in &record {
                cells.push(V::parse(cell).map_err(|problem| malformed(line, problem))?);
            }
        }
        Ok(Grid { columns, cells })
    }

    /// Reads a CSV file.
    ///
    /// # Errors
    /// As [`Grid::parse`], with the file; or the file cannot be read.
    pub fn read(path: &Path) -> Result<Grid<V>, TableError> {
        let bytes = std::fs::read(path).map_err(|error| TableError::Io(write::with_path(error, path)))?;
        Grid::parse(&bytes).map_err(|error| match error {
            TableError::Malformed { line, problem, .. } => {
                TableError::Malformed { file: path.display().to_string(), line, problem }
            }
            other => other,
        })
    }
}

impl MixedTable {
    /// The rows that have these words in these columns, as numbers of the columns `take`; rows without one are left
    /// out.
    ///
    /// # Errors
    /// There is no such column.
    pub fn select(&self, words: &[(&str, &str)], take: &[&str]) -> Result<Table, TableError> {
        let wanted: Vec<(usize, CellValue)> = words
            .iter()
            .map(|&(name, word)| Ok((self.place(name)?, CellValue::from(word))))
            .collect::<Result<_, _>>()?;
        let places: Vec<usize> = take.iter().map(|&name| self.place(name)).collect::<Result<_, _>>()?;
        let mut table = Table::new(take);
        for row in self.rows().filter(|row| wanted.iter().all(|(index, word)| row[*index] == *word)) {
            if let Some(numbers) = places.iter().map(|&index| row[index].number()).collect::<Option<Vec<f64>>>() {
                table.push(&numbers);
            }
        }
        Ok(table)
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

/// The names of the columns: what [`Grid::to_csv`] writes without quotes and a name finds again.
fn names(header: &csv::StringRecord) -> Result<Vec<String>, String> {
    const SEPARATORS: [(char, &str); 3] = [(';', "semicolons"), ('\t', "tabs"), ('|', "pipes (|)")];
    let mut names: Vec<String> = Vec::new();
    for name in header {
        let is_good = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_';
        if let Some((_, separators)) = SEPARATORS.iter().find(|(separator, _)| name.contains(*separator)) {
            return Err(format!(
                "the cells are separated by {separators}; separate them by commas, numbers with a point"
            ));
        }
        if name.is_empty() && header.len() > 1 && names.is_empty() {
            return Err("the first column has no name: row names of R? write.csv(..., row.names = FALSE)".to_owned());
        }
        if name.is_empty() || !name.bytes().all(is_good) {
            return Err(format!("{name:?} is not a name of a column; valid: small letters, digits and _"));
        }
        if names.iter().any(|other| other == name) {
            return Err(format!("the column {name} appears twice"));
        }
        names.push(name.to_owned());
    }
    match names.is_empty() {
        true => Err("there is no header".to_owned()),
        false => Ok(names),
    }
}

fn other_length(record: &csv::StringRecord, expected: usize) -> String {
    let found = record.len();
    let why = match () {
        () if found == 2 * expected => ": numbers with decimal commas? write points",
        () if found == expected + 1 => ": row names of R (row.names = FALSE leaves them out), or a decimal comma?",
        () => "",
    };
    format!("expected {expected} cells, found {found}{why}")
}
