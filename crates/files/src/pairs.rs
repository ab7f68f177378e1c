//! The rows of two tables that belong together.

use crate::table::{Grid, Value};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Columns that name a row.
pub const KEYS: [&str; 2] = ["t", "n"];

/// A row of each table, with the place of the first, from 0.
pub type Pair<'a, V> = (usize, &'a [V], &'a [V]);

/// The rows that name the same, in the order of the first table, and the number of rows without a partner. A row is named
/// by its cells in the columns [`KEYS`] that both tables have, and by its words; of several rows of one name the k-th
/// belongs to the k-th. The rows of tables in which nothing names them belong together in their order.
pub fn pairs<'a, V: Value>(one: &'a Grid<V>, other: &'a Grid<V>) -> (Vec<Pair<'a, V>>, usize) {
    let keys = KEYS.iter().filter_map(|name| Some((one.place(name).ok()?, other.place(name).ok()?)));
    let (mine, theirs): (Vec<usize>, Vec<usize>) = keys.unzip();
    let names = |table: &'a Grid<V>, keys: &[usize]| -> Vec<Name<'a, V>> {
        let is_key = |place: usize, cell: &V| keys.contains(&place) || cell.is_word();
        let name = |row: &'a [V]| row.iter().enumerate().filter(|(place, cell)| is_key(*place, cell));
        table.rows().map(|row| Name(name(row).map(|(_, cell)| cell).collect())).collect()
    };
    let mut partners: BTreeMap<Name<'_, V>, Vec<usize>> = BTreeMap::new();
    for (row, name) in names(other, &theirs).into_iter().enumerate() {
        partners.entry(name).or_default().push(row);
    }
    // the first of each name is taken from the end
    partners.values_mut().for_each(|rows| rows.reverse());
    let rows: Vec<&[V]> = other.rows().collect();
    let mut found = Vec::new();
    for ((row, cells), name) in one.rows().enumerate().zip(names(one, &mine)) {
        if let Some(partner) = partners.get_mut(&name).and_then(Vec::pop) {
            found.push((row, cells, rows[partner]));
        }
    }
    let unmatched = one.len() + other.len() - 2 * found.len();
    (found, unmatched)
}

/// The cells that name a row.
struct Name<'a, V>(Vec<&'a V>);

impl<V: Value> Ord for Name<'_, V> {
    fn cmp(&self, other: &Self) -> Ordering {
        let cells = self.0.iter().zip(&other.0).map(|(one, other)| one.order(other)).find(|order| order.is_ne());
        cells.unwrap_or(self.0.len().cmp(&other.0.len()))
    }
}

impl<V: Value> PartialOrd for Name<'_, V> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<V: Value> PartialEq for Name<'_, V> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<V: Value> Eq for Name<'_, V> {}
