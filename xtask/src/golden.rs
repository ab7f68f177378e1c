//! Committed samples of tables: small enough for a repository, enough to say where a number moved.

use crate::disk;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::numbers::{self, Distance};
use crate::outputs;
use crate::paths::Paths;
use files::table::Table;
use std::collections::{BTreeMap, BTreeSet};

/// At most so many rows are kept.
pub const ROWS: usize = 2000;

/// Distances of a figure's tables from their committed samples by file name, `left.csv`; or why there is none.
pub type Distances = BTreeMap<String, Result<Distance, String>>;

/// Every k-th row of a table, from the first, with the smallest k that leaves at most [`ROWS`]; header kept, lines
/// copied as they are.
pub fn sample(csv: &str) -> String {
    let step = step(rows(csv));
    let mut text = String::new();
    for line in csv.lines().take(1).chain(csv.lines().skip(1).step_by(step)) {
        text.push_str(line);
        text.push('\n');
    }
    text
}

/// The smallest k for a table of so many rows.
pub fn step(rows: usize) -> usize {
    rows.div_ceil(ROWS).max(1)
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

/// Compares the tables that a figure has below `made` with the samples committed in `reference`.
///
/// # Errors
/// A table or a sample cannot be read.
pub fn judge(reference: &Paths, made: &Paths, figure: &Figure) -> Result<Distances, Failure> {
    let folder = reference.root.join(Paths::golden(&figure.id));
    let tables: BTreeMap<String, String> =
        outputs::tables(made, figure)?.into_iter().map(|name| (file_name(&name), name)).collect();
    let committed = disk::names(&folder)?;
    let mut distances = Distances::new();
    for file in tables.keys().chain(&committed).collect::<BTreeSet<_>>() {
        let golden = disk::read_text(&folder.join(file))?;
        let distance = match (golden, tables.get(file)) {
            (Some(golden), Some(name)) => distance(&golden, &text(made, name)?),
            (None, _) => Err("no committed sample".to_owned()),
            (_, None) => Err("the table was not made".to_owned()),
        };
        distances.insert(file.clone(), distance);
    }
    Ok(distances)
}

fn distance(golden: &str, csv: &str) -> Result<Distance, String> {
    let fresh = sample(csv);
    if fresh == golden {
        return Ok(Distance::default());
    }
    let parse = |text: &str, which: &str| Table::parse(text.as_bytes()).map_err(|error| format!("{which}: {error}"));
    numbers::compare(&parse(golden, "sample")?, &parse(&fresh, "table")?, step(rows(csv)))
}

fn text(made: &Paths, name: &str) -> Result<String, Failure> {
    disk::read_text(&made.output(name))?.ok_or_else(|| Failure::Failed(format!("{name}: no such file")))
}

fn file_name(name: &str) -> String {
    name.rsplit('/').next().unwrap_or(name).to_owned()
}
