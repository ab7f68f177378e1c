//! Committed samples of tables: small enough for a repository, and dense enough to show where a number moved.

use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::outputs;
use checkout::paths::Paths;
use std::collections::BTreeMap;

/// Largest number of rows kept.
pub const ROWS: usize = 2000;

/// Every k-th row of a table, from the first, with the smallest k that leaves at most [`ROWS`]; header kept, lines
/// copied as they are.
pub fn sample(csv: &str) -> String {
    let step = step_of(csv);
    let mut text = String::new();
    for line in csv.lines().take(1).chain(csv.lines().skip(1).step_by(step)) {
        text.push_str(line);
        text.push('\n');
    }
    text
}

/// The smallest k for a table with the given number of rows.
pub fn step(rows: usize) -> usize {
    rows.div_ceil(ROWS).max(1)
}

/// The same for the text of a table.
pub fn step_of(csv: &str) -> usize {
    step(rows(csv))
}

fn rows(csv: &str) -> usize {
    csv.lines().count().saturating_sub(1)
}

/// The samples of the tables that a figure has below `made`, by file name.
///
/// # Errors
/// A table cannot be read.
pub fn samples(made: &Paths, figure: &Figure) -> Result<BTreeMap<String, String>, Failure> {
    let mut samples = BTreeMap::new();
    for name in outputs::tables(made, figure)? {
        samples.insert(file_name(&name), sample(&text(made, &name)?));
    }
    Ok(samples)
}

fn text(made: &Paths, name: &str) -> Result<String, Failure> {
    disk::read_text(&made.output(name))?.ok_or_else(|| Failure::Failed(format!("{name}: no such file")))
}

fn file_name(name: &str) -> String {
    name.rsplit('/').next().unwrap_or(name).to_owned()
}
