//! Pairs the rows of two tables.

use crate::table::{Grid, Value};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Columns that name a row.
pub const KEYS: [&str; 2] = ["t", "n"];

/// A row of each table, with the place of the first, from 0.
pub type Pair<'a, V> = (usize, &'a [V], &'a [V]);

/// The rows that name the same, in the order of the first table, and the number of rows without a partner. A row is
/// named by its cells in the columns [`KEYS`] that both tables have, and by its words; of several rows of one name the
/// k-th belongs to the k-th. Rows left over are tried once more without their words: another word is a difference in a
/// row, not another row.
pub fn pairs<'a, V: Value>(one: &'a Grid<V>, other: &'a Grid<V>) -> (Vec<Pair<'a, V>>, usize) {
    let keys = KEYS.iter().filter_map(|name| Some((one.place(name).ok()?, other.place(name).ok()?)));
    let (mine, theirs): (Vec<usize>, Vec<usize>) = keys.unzip();
    let [ones, others] = [one, other].map(|table| table.rows().collect::<Vec<&[V]>>());
    let same = |(one, other): (&&'a [V], &&'a [V])| Name::of(one, &mine, true) == Name::of(other, &theirs, true);
    if ones.len() == others.len() && ones.iter().zip(&others).all(same) {
        let rows = ones.into_iter().zip(others).enumerate();
        return (rows.map(|(row, (one, other))| (row, one, other)).collect(), 0);
    }
    let mut found: Vec<(usize, usize)> = Vec::new();
    let (mut left, mut right): (Vec<usize>, Vec<usize>) = ((0..ones.len()).collect(), (0..others.len()).collect());
    for with_words in [true, false] {
        let mut partners: BTreeMap<Name<'_, V>, Vec<usize>> = BTreeMap::new();
        // taken from the end: the first of a name last
        for &row in right.iter().rev() {
            partners.entry(Name::of(others[row], &theirs, with_words)).or_default().push(row);
        }
        left.retain(|&row| {
            let partner = partners.get_mut(&Name::of(ones[row], &mine, with_words)).and_then(Vec::pop);
            found.extend(partner.map(|partner| (row, partner)));
            partner.is_none()
        });
        right = partners.into_values().flatten().collect();
        right.sort_unstable();
    }
    found.sort_unstable();
    let unmatched = left.len() + right.len();
    (found.into_iter().map(|(row, partner)| (row, ones[row], others[partner])).collect(), unmatched)
}

/// The cells that name a row.
struct Name<'a, V>(Vec<&'a V>);

impl<'a, V: Value> Name<'a, V> {
    fn of(row: &'a [V], keys: &[usize], with_words: bool) -> Name<'a, V> {
        let is_name = |place: usize, cell: &V| keys.contains(&place) || (with_words && cell.is_word());
        Name(row.iter().enumerate().filter(|(place, cell)| is_name(*place, cell)).map(|(_, cell)| cell).collect())
    }
}

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
