//! Tables whose cells are words or numbers; a cell may be empty.

use crate::failure::Failure;
use files::table::{Table, push_number};
use std::path::Path;

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A word without commas.
    Word(String),
    /// A number; it must be finite when the table is written.
    Number(f64),
    /// Nothing: the run has no such number.
    Nothing,
}

impl From<f64> for Cell {
    fn from(number: f64) -> Cell {
        Cell::Number(number)
    }
}

impl From<usize> for Cell {
    fn from(number: usize) -> Cell {
        Cell::Number(number as f64)
    }
}

impl From<u64> for Cell {
    fn from(number: u64) -> Cell {
        Cell::Number(number as f64)
    }
}

impl From<&str> for Cell {
    fn from(word: &str) -> Cell {
        Cell::Word(word.to_owned())
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(cell: Option<T>) -> Cell {
        cell.map_or(Cell::Nothing, T::into)
    }
}

/// Named columns and rows of cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    columns: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

/// A row of cells, each made of a word, a number or an option of one.
macro_rules! row {
    ($($cell:expr),+ $(,)?) => { vec![$($crate::hard::rows::Cell::from($cell)),+] };
}
pub(crate) use row;

impl Rows {
    /// An empty table with these columns.
    pub fn new(columns: &[&str]) -> Rows {
        Rows { columns: columns.iter().map(|&name| name.to_owned()).collect(), rows: Vec::new() }
    }

    /// Appends a row.
    ///
    /// # Panics
    /// If the row has not one cell for each column: an error of the program, not of its input.
    pub fn push(&mut self, row: Vec<Cell>) {
        assert_eq!(row.len(), self.columns.len(), "a row of {:?}", self.columns);
        self.rows.push(row);
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The table as CSV; `name` is for the message.
    ///
    /// # Errors
    /// A number is not finite: no table holds one.
    pub fn to_csv(&self, name: &str) -> Result<Vec<u8>, Failure> {
        let mut text = self.columns.join(",");
        for (line, row) in self.rows.iter().enumerate() {
            for (index, (cell, column)) in row.iter().zip(&self.columns).enumerate() {
                text.push(if index == 0 { '\n' } else { ',' });
                match cell {
                    Cell::Word(word) => text.push_str(word),
                    Cell::Number(number) if number.is_finite() => push_number(&mut text, *number),
                    Cell::Number(number) => {
                        return Err(Failure::work(format!("{name}.csv: row {}: {column} = {number}", line + 1)));
                    }
                    Cell::Nothing => {}
                }
            }
        }
        text.push('\n');
        Ok(text.into_bytes())
    }

    /// Reads a table as [`Rows::to_csv`] writes it.
    ///
    /// # Errors
    /// The file cannot be read, or a row has another number of cells than the header.
    pub fn read(path: &Path) -> Result<Rows, Failure> {
        let text = std::fs::read_to_string(path).map_err(|error| files::write::with_path(error, path))?;
        let mut lines = text.lines().map(|line| line.split(','));
        let columns = lines.next().map(|names| names.map(str::to_owned).collect()).unwrap_or_default();
        // `inf` and `nan` are words: no table holds such a number
        let cell = |text: &str| match text.parse() {
            Ok(number) if f64::is_finite(number) => Cell::Number(number),
            Ok(_) => Cell::Word(text.to_owned()),
            Err(_) if text.is_empty() => Cell::Nothing,
            Err(_) => Cell::Word(text.to_owned()),
        };
        let columns: Vec<String> = columns;
        let rows: Vec<Vec<Cell>> = lines.map(|cells| cells.map(cell).collect()).collect();
        match rows.iter().position(|row| row.len() != columns.len()) {
            None => Ok(Rows { columns, rows }),
            Some(index) => Err(Failure::input(format!(
                "{}: line {}: {} cells; must be {}, one for each column",
                path.display(),
                index + 2,
                rows[index].len(),
                columns.len()
            ))),
        }
    }

    /// The rows that have these words in these columns, as numbers of the columns `take`; rows without one are left out.
    ///
    /// # Errors
    /// There is no such column.
    pub fn select(&self, words: &[(&str, &str)], take: &[&str]) -> Result<Table, Failure> {
        let place = |name: &str| {
            let found = self.columns.iter().position(|column| column == name);
            found.ok_or_else(|| Failure::work(format!("no column {name}; the table has {}", self.columns.join(", "))))
        };
        let wanted: Vec<(usize, Cell)> =
            words.iter().map(|&(name, word)| Ok((place(name)?, Cell::from(word)))).collect::<Result<_, Failure>>()?;
        let places: Vec<usize> = take.iter().map(|&name| place(name)).collect::<Result<_, Failure>>()?;
        let mut table = Table::new(take);
        for row in self.rows.iter().filter(|row| wanted.iter().all(|(index, word)| row.get(*index) == Some(word))) {
            let number = |&index: &usize| match row.get(index) {
                Some(Cell::Number(number)) => Some(*number),
                _ => None,
            };
            if let Some(numbers) = places.iter().map(number).collect::<Option<Vec<f64>>>() {
                table.push(&numbers);
            }
        }
        Ok(table)
    }
}
