//! A table of the checkout, with messages that name it.

use checkout::failure::Failure;
use checkout::paths::Paths;
use files::table::{self, Cell, Value as _};

/// A table of the checkout.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Its name, relative to the root.
    pub name: String,
    cells: table::Sheet,
}

impl Sheet {
    /// Reads a table, by name.
    ///
    /// # Errors
    /// Stale: there is no such table. Failed: it cannot be read.
    pub fn read(paths: &Paths, name: &str) -> Result<Sheet, Failure> {
        let path = paths.root.join(name);
        if !path.is_file() {
            return Err(Failure::Stale(format!("{name}: no such table; cargo xtask figures --all")));
        }
        Ok(Sheet { name: name.to_owned(), cells: table::Sheet::read(&path).map_err(Failure::failed)? })
    }

    /// The rows that have these words or numbers in these columns.
    ///
    /// # Errors
    /// Usage: a column is not there, or no row fits; with the table and the columns it has.
    pub fn only(&self, wanted: &[(&str, &str)]) -> Result<Sheet, Failure> {
        let mut places = Vec::new();
        for (column, word) in wanted {
            places.push((self.place(column)?, Cell::parse(word).map_err(Failure::Usage)?));
        }
        let mut cells = table::Sheet::new(&self.cells.columns.iter().map(String::as_str).collect::<Vec<_>>());
        for row in self.cells.rows().filter(|row| places.iter().all(|(place, wanted)| row[*place] == *wanted)) {
            cells.push(row);
        }
        match cells.is_empty() {
            true => Err(Failure::Usage(format!("{}: no row with {wanted:?}", self.name))),
            false => Ok(Sheet { name: self.name.clone(), cells }),
        }
    }

    /// The numbers of a column from top to bottom; cells that hold none are left out.
    ///
    /// # Errors
    /// Usage: the column is not there, or holds no number.
    pub fn numbers(&self, column: &str) -> Result<Vec<f64>, Failure> {
        let place = self.place(column)?;
        let found: Vec<f64> = self.cells.rows().filter_map(|row| row[place].number()).collect();
        match found.is_empty() {
            true => Err(Failure::Usage(format!("{}: column {column} holds no number", self.name))),
            false => Ok(found),
        }
    }

    /// The first number of a column.
    ///
    /// # Errors
    /// As [`Sheet::numbers`].
    pub fn first(&self, column: &str) -> Result<f64, Failure> {
        Ok(self.numbers(column)?[0])
    }

    /// The number that comes last in the order of values.
    ///
    /// # Errors
    /// As [`Sheet::numbers`].
    pub fn largest(&self, column: &str) -> Result<f64, Failure> {
        let numbers = self.numbers(column)?;
        Ok(numbers.into_iter().fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a }))
    }

    /// The number that comes first in the order of values.
    ///
    /// # Errors
    /// As [`Sheet::numbers`].
    pub fn least(&self, column: &str) -> Result<f64, Failure> {
        let numbers = self.numbers(column)?;
        Ok(numbers.into_iter().fold(f64::INFINITY, |a, b| if b < a { b } else { a }))
    }

    /// The cells of a column as they are written, from top to bottom.
    ///
    /// # Errors
    /// Usage: the column is not there.
    pub fn words(&self, column: &str) -> Result<Vec<String>, Failure> {
        let place = self.place(column)?;
        Ok(self.cells.rows().map(|row| row[place].to_string()).collect())
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    fn place(&self, column: &str) -> Result<usize, Failure> {
        self.cells.place(column).map_err(|error| Failure::Usage(format!("{}: {error}", self.name)))
    }
}
