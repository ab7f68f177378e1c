//! The distance of a run from its check, column by column.

use crate::store;
use checkout::disk;
use checkout::events::{self, Event};
use checkout::failure::Failure;
use checkout::paths::{Paths, RUN_TABLES};
use files::pairs::{KEYS, pairs};
use files::table::Table;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Method, counts and lengths of a stored run.
const RUN_SUMMARY: &str = "summary.json";

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
        let mut estimate = Estimate { summary: summary(&run)?, events: events::of_run(&run)?, ..Estimate::default() };
        if same_method(&estimate.summary, &summary(&check)?) {
            return Ok(estimate);
        }
        estimate.check_events = events::of_run(&check)?;
        for name in RUN_TABLES.iter().filter(|name| run.join(name).exists()) {
            let (columns, unmatched) = differences(&table(&run.join(name))?, &table(&check.join(name))?);
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

/// The largest absolute difference of each column of the run that names no row, over the rows of both (NaN when a
/// difference is none, the check lacks the column, or no row has a partner); and the number of rows without a partner.
pub fn differences(run: &Table, check: &Table) -> (BTreeMap<String, f64>, usize) {
    let (rows, unmatched) = pairs(run, check);
    let nothing = rows.is_empty() && !(run.is_empty() && check.is_empty());
    let values = run.columns.iter().enumerate().filter(|(_, name)| !KEYS.contains(&name.as_str()));
    let largest = values.map(|(a, name)| {
        let largest = check.place(name).ok().filter(|_| !nothing).map(|b| {
            let differences = rows.iter().map(|(_, mine, theirs)| (mine[a] - theirs[b]).abs());
            // NaN is above every number in this order, and what is not compared with it is lost
            differences.max_by(f64::total_cmp).unwrap_or(0.0)
        });
        (name.clone(), largest.unwrap_or(f64::NAN))
    });
    (largest.collect(), unmatched)
}

/// Reads a table that a program of ours has written.
///
/// # Errors
/// It cannot be read, or is no table.
pub fn table(path: &Path) -> Result<Table, Failure> {
    Table::read(path).map_err(Failure::failed)
}

fn same_method(run: &Value, check: &Value) -> bool {
    run["method"] == check["method"] && run["control"] == check["control"]
}

fn summary(run: &Path) -> Result<Value, Failure> {
    let path = run.join(RUN_SUMMARY);
    let text = disk::read_text(&path)?.unwrap_or_else(|| "{}".to_owned());
    serde_json::from_str(&text).map_err(Failure::at(&path))
}
