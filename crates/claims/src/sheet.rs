//! Tables as the ledger reads them: with errors for their columns, and with a second table joined to them.

use files::table::{self, CellValue, Value};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// An error that is stated for a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stated {
    /// A fraction of the range of the column (largest minus smallest number); absolute if the range is 0.
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

/// A table with the error of each column's numbers, where one is stated for the whole column.
#[derive(Clone, Debug, PartialEq)]
pub struct LedgerTable {
    cells: table::MixedTable,
    errors: Vec<Option<Stated>>,
}

/// The suffix of a column of the second table.
pub const BESIDE: &str = "_beside";
/// The suffix of a column of the next row.
pub const NEXT: &str = "_next";

/// Cells that identify a row, with an order.
struct Key<'a>(Vec<&'a CellValue>);

impl Ord for Key<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        let cells = self.0.iter().zip(&other.0).map(|(one, other)| one.order(other));
        cells.fold(Ordering::Equal, Ordering::then)
    }
}

impl PartialOrd for Key<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Key<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Key<'_> {}

impl LedgerTable {
    /// A table, with the error of a column by its name, if one is stated.
    pub fn new(cells: table::MixedTable, error: &dyn Fn(&str) -> Option<Stated>) -> LedgerTable {
        let stated = |(place, name): (usize, &String)| match (error(name)?, range(&cells, place)) {
            (Stated::OfRange(part), range) if range > 0.0 => Some(Stated::Absolute(part * range)),
            (error, _) => Some(error),
        };
        LedgerTable { errors: cells.columns.iter().enumerate().map(stated).collect(), cells }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.cells.len()
    }

    /// A cell.
    pub fn cell(&self, place: usize, row: usize) -> &CellValue {
        &self.cells.row(row)[place]
    }

    /// The cells of a column.
    pub fn column(&self, place: usize) -> impl Iterator<Item = &CellValue> {
        self.cells.rows().map(move |row| &row[place])
    }

    /// The error stated for a column.
    pub fn error(&self, place: usize) -> Option<Stated> {
        self.errors[place]
    }

    /// The place of a column.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.cells.place(name).ok()
    }

    /// The names of the columns.
    pub fn names(&self) -> &[String] {
        &self.cells.columns
    }

    /// The columns without a stated error: they name rows.
    pub fn exact(&self) -> impl Iterator<Item = &String> {
        self.names().iter().zip(&self.errors).filter(|(_, error)| error.is_none()).map(|(name, _)| name)
    }

    /// The table with these rows only.
    pub fn rows_only(&self, rows: &[usize]) -> LedgerTable {
        let mut cells = empty(self.names());
        rows.iter().for_each(|&row| cells.push(self.cells.row(row)));
        LedgerTable { cells, errors: self.errors.clone() }
    }

    /// This table with another one beside it: each row with the one row of the other that has the same cells in the
    /// columns `on`. Columns of the other get [`BESIDE`] behind their names. Rows without a partner are left out.
    ///
    /// # Errors
    /// A column of `on` is missing, the other table has a key twice, or no row has a partner.
    pub fn beside(&self, other: &LedgerTable, on: &[String]) -> Result<LedgerTable, String> {
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
    pub fn next(&self, by: &str, on: &[String]) -> Result<LedgerTable, String> {
        let (groups, order) = (self.places(on)?, self.places(&[by.to_owned()])?);
        let mut rows: Vec<usize> = (0..self.rows()).collect();
        rows.sort_by_cached_key(|&row| (self.key(&groups, row), self.key(&order, row)));
        let same = |places: &[usize], pair: &[usize]| self.key(places, pair[0]) == self.key(places, pair[1]);
        if let Some(pair) = rows.windows(2).find(|pair| same(&groups, pair) && same(&order, pair)) {
            return Err(format!("rows {} and {} (from 0) have the same {by}: it orders nothing", pair[0], pair[1]));
        }
        let pairs: Vec<(usize, usize)> =
            rows.windows(2).filter(|pair| same(&groups, pair)).map(|pair| (pair[0], pair[1])).collect();
        Ok(self.paired(&pairs, self, &groups, NEXT))
    }

    fn places(&self, names: &[String]) -> Result<Vec<usize>, String> {
        names.iter().map(|name| self.place(name).ok_or_else(|| self.no_column(name))).collect()
    }

    /// The message for a column that is not there.
    pub fn no_column(&self, name: &str) -> String {
        format!("no column {name}; there are {}", self.names().join(", "))
    }

    fn key(&self, places: &[usize], row: usize) -> Key<'_> {
        Key(places.iter().map(|&place| self.cell(place, row)).collect())
    }

    fn paired(&self, pairs: &[(usize, usize)], other: &LedgerTable, keys: &[usize], suffix: &str) -> LedgerTable {
        let theirs: Vec<usize> = (0..other.names().len()).filter(|place| !keys.contains(place)).collect();
        let others = theirs.iter().map(|&place| format!("{}{suffix}", other.names()[place]));
        let mut cells = empty(&self.names().iter().cloned().chain(others).collect::<Vec<_>>());
        for &(mine, other_row) in pairs {
            let beside = theirs.iter().map(|&place| other.cell(place, other_row));
            cells.push(self.cells.row(mine).iter().chain(beside).cloned().collect::<Vec<_>>());
        }
        let errors = self.errors.iter().copied().chain(theirs.iter().map(|&place| other.errors[place]));
        LedgerTable { errors: errors.collect(), cells }
    }
}

fn empty(names: &[String]) -> table::MixedTable {
    table::MixedTable::new(&names.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Largest less smallest number of a column.
fn range(cells: &table::MixedTable, place: usize) -> f64 {
    let numbers = || cells.rows().filter_map(|row| row[place].number());
    let least = numbers().min_by(f64::total_cmp).unwrap_or(0.0);
    let largest = numbers().max_by(f64::total_cmp).unwrap_or(0.0);
    largest - least
}
