//! A table whose cells are kept as they are written: words and numbers side by side.

use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;

/// A table of the checkout.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Its name, relative to the root.
    pub name: String,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Sheet {
    /// Reads a table, by name.
    ///
    /// # Errors
    /// Stale: there is no such table. Failed: it cannot be read.
    pub fn read(paths: &Paths, name: &str) -> Result<Sheet, Failure> {
        let text = disk::read_text(&paths.root.join(name))?;
        let text = text.ok_or_else(|| Failure::Stale(format!("{name}: no such table; cargo xtask figures")))?;
        Ok(Sheet::parse(name, &text))
    }

    /// Parses a table; `name` is only for messages.
    pub fn parse(name: &str, text: &str) -> Sheet {
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let mut lines = text.lines();
        let columns = lines.next().map(cells).unwrap_or_default();
        Sheet { name: name.to_owned(), columns, rows: lines.map(cells).collect() }
    }

    /// The rows that have these words (or numbers, as they are written) in these columns.
    ///
    /// # Errors
    /// Usage: a column is not there, or no row fits; with the table and the columns it has.
    pub fn only(&self, wanted: &[(&str, &str)]) -> Result<Sheet, Failure> {
        let mut places = Vec::new();
        for (column, word) in wanted {
            places.push((self.place(column)?, *word));
        }
        let fits = |row: &&Vec<String>| places.iter().all(|(place, word)| row.get(*place).is_some_and(|is| is == word));
        let rows: Vec<Vec<String>> = self.rows.iter().filter(fits).cloned().collect();
        match rows.is_empty() {
            true => Err(Failure::Usage(format!("{}: no row with {wanted:?}", self.name))),
            false => Ok(Sheet { rows, ..self.clone() }),
        }
    }

    /// The numbers of a column from top to bottom; cells that hold none are left out.
    ///
    /// # Errors
    /// Usage: the column is not there, or holds no number.
    pub fn numbers(&self, column: &str) -> Result<Vec<f64>, Failure> {
        let place = self.place(column)?;
        let found: Vec<f64> = self.rows.iter().filter_map(|row| row.get(place)?.parse().ok()).collect();
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

    /// The words of a column from top to bottom.
    ///
    /// # Errors
    /// Usage: the column is not there.
    pub fn words(&self, column: &str) -> Result<Vec<&str>, Failure> {
        let place = self.place(column)?;
        Ok(self.rows.iter().map(|row| row.get(place).map_or("", String::as_str)).collect())
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    fn place(&self, column: &str) -> Result<usize, Failure> {
        let found = self.columns.iter().position(|name| name == column);
        let known = || self.columns.join(", ");
        found.ok_or_else(|| Failure::Usage(format!("{}: no column {column}; it has {}", self.name, known())))
    }
}
