//! How far a run is from its check, column by column.

use crate::disk;
use crate::events::{self, Event};
use crate::failure::Failure;
use crate::paths::{Paths, RUN_EVENTS, RUN_SUMMARY, RUN_TABLES};
use crate::store;
use files::table::Table;
use serde_json::Value;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::path::Path;

/// Columns that name a row.
pub const KEYS: [&str; 2] = ["t", "n"];

/// A run compared with its check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Estimate {
    /// Largest absolute difference of each column over the whole run; NaN where nothing could be compared.
    pub columns: BTreeMap<String, f64>,
    /// Rows that only one of the two has.
    pub unmatched: usize,
    /// The run's `summary.json`.
    pub summary: Value,
    /// Events of the run.
    pub events: Vec<Event>,
    /// Events of the check.
    pub check_events: Vec<Event>,
}

impl Estimate {
    /// Compares the stored run `key` with its check. A check by the same method with the same steps (a scene that asks
    /// for fixed steps) says nothing about the error: then nothing is compared.
    ///
    /// # Errors
    /// A stored file cannot be read, or is not what a run writes.
    pub fn of(paths: &Paths, key: &str) -> Result<Estimate, Failure> {
        let (run, check) = (store::folder(paths, key), store::folder(paths, &store::check_key(key)));
        let mut estimate = Estimate { summary: summary(&run)?, events: events_of(&run)?, ..Estimate::default() };
        if same_method(&estimate.summary, &summary(&check)?) {
            return Ok(estimate);
        }
        estimate.check_events = events_of(&check)?;
        for name in RUN_TABLES.iter().filter(|name| run.join(name).exists()) {
            let table_of_run = table(&run.join(name))?;
            let (columns, unmatched) = differences(&table_of_run, &table(&check.join(name))?);
            // what the check lacks has no estimate, which is not the same as none being asked for
            let values = table_of_run.columns.iter().filter(|name| !KEYS.contains(&name.as_str()));
            estimate.columns.extend(values.map(|name| (name.clone(), f64::NAN)));
            estimate.columns.extend(columns);
            estimate.unmatched += unmatched;
        }
        Ok(estimate)
    }

    /// The length of the ring, which is the drawn range of positions.
    pub fn length(&self) -> Option<f64> {
        self.summary.get("length")?.as_f64()
    }
}

/// The largest absolute difference of each column that both tables have and that names no row, over the rows with equal
/// [`KEYS`] (NaN when a difference is none, or no rows are equal); and the number of rows without a partner. Both tables are sorted by their keys.
pub fn differences(run: &Table, check: &Table) -> (BTreeMap<String, f64>, usize) {
    let columns = common_values(run, check);
    let mut largest = vec![0.0_f64; columns.len()];
    let (rows, unmatched) = matched(run, check);
    for (mine, theirs) in &rows {
        for (largest, &(_, (a, b))) in largest.iter_mut().zip(&columns) {
            let difference = (mine[a] - theirs[b]).abs();
            *largest = if largest.is_nan() || difference <= *largest { *largest } else { difference };
        }
    }
    if rows.is_empty() && !(run.is_empty() && check.is_empty()) {
        largest.fill(f64::NAN);
    }
    (columns.into_iter().zip(largest).map(|((name, _), largest)| (name.clone(), largest)).collect(), unmatched)
}

/// The place of a column in each of two tables, if both have it.
fn places(one: &Table, other: &Table, name: &str) -> Option<(usize, usize)> {
    let index = |table: &Table| table.columns.iter().position(|column| column == name);
    Some((index(one)?, index(other)?))
}

/// The columns that both tables have and that name no row, each with its places.
pub fn common_values<'a>(one: &'a Table, other: &Table) -> Vec<(&'a String, (usize, usize))> {
    let values = one.columns.iter().filter(|name| !KEYS.contains(&name.as_str()));
    values.filter_map(|name| Some((name, places(one, other, name)?))).collect()
}

/// Pairs of rows, one of each table.
pub type RowPairs<'a> = Vec<(&'a [f64], &'a [f64])>;

/// The rows with equal [`KEYS`], in pairs, and the number of rows without a partner. Both tables are sorted by their keys.
pub fn matched<'a>(one: &'a Table, other: &'a Table) -> (RowPairs<'a>, usize) {
    let keys: Vec<(usize, usize)> = KEYS.iter().filter_map(|name| places(one, other, name)).collect();
    let (mut pairs, mut unmatched) = (Vec::new(), 0);
    let (mut left, mut right) = (one.rows().peekable(), other.rows().peekable());
    while let (Some(&mine), Some(&theirs)) = (left.peek(), right.peek()) {
        let order = keys.iter().map(|&(a, b)| mine[a].total_cmp(&theirs[b])).find(|order| order.is_ne());
        let order = order.unwrap_or(Ordering::Equal);
        match order {
            Ordering::Equal => pairs.push((mine, theirs)),
            Ordering::Less | Ordering::Greater => unmatched += 1,
        }
        if order.is_le() {
            left.next();
        }
        if order.is_ge() {
            right.next();
        }
    }
    (pairs, unmatched + left.count() + right.count())
}

/// Reads a table that a program of ours has written.
///
/// # Errors
/// It cannot be read, or is no table.
pub fn table(path: &Path) -> Result<Table, Failure> {
    Table::read(path).map_err(Failure::at(path))
}

fn same_method(run: &Value, check: &Value) -> bool {
    run["method"] == check["method"] && run["control"] == check["control"]
}

fn summary(run: &Path) -> Result<Value, Failure> {
    let path = run.join(RUN_SUMMARY);
    let text = disk::read_text(&path)?.unwrap_or_else(|| "{}".to_owned());
    serde_json::from_str(&text).map_err(Failure::at(&path))
}

/// The events of a stored run; none when it has no such file.
///
/// # Errors
/// The file cannot be read, or is not what a run writes.
pub fn events_of(run: &Path) -> Result<Vec<Event>, Failure> {
    let path = run.join(RUN_EVENTS);
    match disk::read_text(&path)? {
        Some(text) => events::parse(&path.display().to_string(), &text),
        None => Ok(Vec::new()),
    }
}
