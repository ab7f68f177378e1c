//! Tables as the ledger reads them: cells that are numbers, words or empty; two tables side by side.

use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Nothing is written.
    Empty,
    /// A finite number.
    Number(f64),
    /// Anything else.
    Word(Box<str>),
}

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// As in the header.
    pub name: String,
    /// From the first row to the last.
    pub cells: Vec<Cell>,
    /// The error of its numbers, where one is stated for the whole column.
    pub error: Option<Stated>,
}

/// An error that is stated for a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stated {
    /// A part of the range of the column: largest less smallest number; where that is 0, as it is.
    OfRange(f64),
    /// As it is for numbers below 1, and a part of those above.
    OfSize(f64),
    /// As it is.
    Absolute(f64),
}

impl Stated {
    /// The error of a number.
    pub fn at(self, number: f64) -> f64 {
        match self {
            Stated::OfSize(part) if number.abs() > 1.0 => part * number.abs(),
            Stated::OfRange(error) | Stated::OfSize(error) | Stated::Absolute(error) => error,
        }
    }
}

/// A table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Columns of equal length.
    pub columns: Vec<Column>,
}

/// What stands behind the name of a column of the second table.
pub const BESIDE: &str = "_beside";
/// What stands behind the name of a column of the next row.
pub const NEXT: &str = "_next";

/// A cell as a key: numbers by their order, equal only when their bits are.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Empty,
    Number(i64),
    Word(Box<str>),
}

impl Cell {
    fn parse(text: &str) -> Cell {
        match text.parse::<f64>() {
            _ if text.is_empty() => Cell::Empty,
            Ok(number) if number.is_finite() => Cell::Number(number),
            _ => Cell::Word(text.into()),
        }
    }

    fn key(&self) -> Key {
        match self {
            Cell::Empty => Key::Empty,
            Cell::Number(number) => Key::Number(in_order(*number)),
            Cell::Word(word) => Key::Word(word.clone()),
        }
    }
}

/// A whole number that is ordered as the double is; 0 and -0 are one.
fn in_order(number: f64) -> i64 {
    let bits = (number + 0.0).to_bits() as i64;
    if bits < 0 { i64::MIN - bits } else { bits }
}

impl Sheet {
    /// Reads CSV with a header. `error` gives the error of a column by its name, if one is stated.
    ///
    /// # Errors
    /// What is wrong, with the line.
    pub fn parse(bytes: &[u8], error: &dyn Fn(&str) -> Option<Stated>) -> Result<Sheet, String> {
        let mut reader = csv::Reader::from_reader(bytes);
        let header = reader.headers().map_err(|error| error.to_string())?.clone();
        let mut cells: Vec<Vec<Cell>> = header.iter().map(|_| Vec::new()).collect();
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(|error| error.to_string())? {
            for (column, cell) in cells.iter_mut().zip(&record) {
                column.push(Cell::parse(cell));
            }
        }
        let columns = header.iter().zip(cells).map(|(name, cells)| {
            let error = error(name).map(|error| match (error, range(&cells)) {
                (Stated::OfRange(part), range) if range > 0.0 => Stated::Absolute(part * range),
                _ => error,
            });
            Column { name: name.to_owned(), cells, error }
        });
        Ok(Sheet { columns: columns.collect() })
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.cells.len())
    }

    /// The place of a column.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }

    /// The names of the columns.
    pub fn names(&self) -> Vec<&str> {
        self.columns.iter().map(|column| column.name.as_str()).collect()
    }

    /// The table with these rows only.
    pub fn rows_only(&self, rows: &[usize]) -> Sheet {
        let taken = |column: &Column| Column {
            name: column.name.clone(),
            cells: rows.iter().map(|&row| column.cells[row].clone()).collect(),
            error: column.error,
        };
        Sheet { columns: self.columns.iter().map(taken).collect() }
    }

    /// This table with another one beside it: each row with the one row of the other that has the same cells in the
    /// columns `on`. Columns of the other get [`BESIDE`] behind their names. Rows without a partner are left out.
    ///
    /// # Errors
    /// A column of `on` is missing, the other table has a key twice, or no row has a partner.
    pub fn beside(&self, other: &Sheet, on: &[String]) -> Result<Sheet, String> {
        let (mine, theirs) = (self.places(on)?, other.places(on)?);
        let mut partners = BTreeMap::new();
        for row in 0..other.rows() {
            if partners.insert(other.key(&theirs, row), row).is_some() {
                let on = on.join(", ");
                return Err(format!("several rows beside one: {on} do not tell the rows apart (row {row} from 0)"));
            }
        }
        let pairs = (0..self.rows()).filter_map(|row| Some((row, *partners.get(&self.key(&mine, row))?)));
        let pairs: Vec<(usize, usize)> = pairs.collect();
        if pairs.is_empty() {
            return Err(format!("no row has a partner with the same {}", on.join(", ")));
        }
        Ok(self.paired(&pairs, other, &theirs, BESIDE))
    }

    /// Each row beside the one that follows it by the column `by`, among the rows with the same cells in the columns
    /// `on`. Columns of the following row get [`NEXT`] behind their names. The last row of each group is left out.
    ///
    /// # Errors
    /// A column is missing, or two rows of a group have the same cell in `by`.
    pub fn next(&self, by: &str, on: &[String]) -> Result<Sheet, String> {
        let (groups, order) = (self.places(on)?, self.places(&[by.to_owned()])?);
        let mut rows: Vec<usize> = (0..self.rows()).collect();
        rows.sort_by_cached_key(|&row| (self.key(&groups, row), self.key(&order, row)));
        let same = |pair: &[usize]| self.key(&groups, pair[0]) == self.key(&groups, pair[1]);
        if let Some(pair) = rows.windows(2).find(|pair| same(pair) && self.compare(&order, pair) == Ordering::Equal) {
            return Err(format!("rows {} and {} (from 0) have the same {by}: it orders nothing", pair[0], pair[1]));
        }
        let pairs: Vec<(usize, usize)> =
            rows.windows(2).filter(|pair| same(pair)).map(|pair| (pair[0], pair[1])).collect();
        Ok(self.paired(&pairs, self, &groups, NEXT))
    }

    fn compare(&self, places: &[usize], pair: &[usize]) -> Ordering {
        self.key(places, pair[0]).cmp(&self.key(places, pair[1]))
    }

    fn places(&self, names: &[String]) -> Result<Vec<usize>, String> {
        let find = |name: &String| self.place(name).ok_or_else(|| self.no_column(name));
        names.iter().map(find).collect()
    }

    /// The message for a column that is not there.
    pub fn no_column(&self, name: &str) -> String {
        format!("no column {name}; there are {}", self.names().join(", "))
    }

    fn key(&self, places: &[usize], row: usize) -> Vec<Key> {
        places.iter().map(|&place| self.columns[place].cells[row].key()).collect()
    }

    fn paired(&self, pairs: &[(usize, usize)], other: &Sheet, keys: &[usize], suffix: &str) -> Sheet {
        let taken = |column: &Column, name: String, row: &dyn Fn(&(usize, usize)) -> usize| Column {
            name,
            cells: pairs.iter().map(|pair| column.cells[row(pair)].clone()).collect(),
            error: column.error,
        };
        let mine = self.columns.iter().map(|column| taken(column, column.name.clone(), &|pair| pair.0));
        let others = other.columns.iter().enumerate().filter(|(place, _)| !keys.contains(place));
        let theirs = others.map(|(_, column)| taken(column, format!("{}{suffix}", column.name), &|pair| pair.1));
        Sheet { columns: mine.chain(theirs).collect() }
    }
}

fn range(cells: &[Cell]) -> f64 {
    let numbers = || {
        cells.iter().filter_map(|cell| match cell {
            Cell::Number(number) => Some(*number),
            _ => None,
        })
    };
    let least = numbers().min_by(f64::total_cmp).unwrap_or(0.0);
    let largest = numbers().max_by(f64::total_cmp).unwrap_or(0.0);
    largest - least
}
