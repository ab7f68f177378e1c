//! Combines shards: the table of the plane, its picture, and their sums.

use super::journal::Shard;
use super::{Arguments, Task};
use figures::failure::{Failure, print};
use files::write::{atomic_all, sha256, with_path};
use jam::outcome::Class;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::ErrorKind;
use std::path::PathBuf;
use sweep::{CellOutcome, DecidedBy, table};

/// The files that are written to the folder of a plane.
pub(super) const OUTPUTS: [&str; 5] = ["cells.csv", "sweep.png", "sweep.svg", "summary.json", "SHA256SUMS"];

/// Gathers the shards in the folder.
///
/// # Errors
/// Missing shards, named (code 3); foreign or damaged ones (code 2); two that disagree.
pub(super) fn gather(task: &Task, arguments: &Arguments) -> Result<(), Failure> {
    let cells = cells(task)?;
    let [of_cells, png, svg, of_summary, of_sums] = OUTPUTS.map(|name| task.out.join(name));
    let csv = table::table(&task.sweep, &cells);
    let summary = summary(task, &cells);
    let mut files: Vec<(PathBuf, Vec<u8>)> = vec![(of_cells, csv.into_bytes())];
    if !arguments.tables_only {
        let rendered = crate::picture::picture(&task.sweep, &cells)?.render().map_err(Failure::work)?;
        files.push((png, rendered.png));
        files.push((svg, rendered.svg));
    }
    files.push((of_summary, format!("{summary:#}\n").into_bytes()));
    let name = |path: &PathBuf| path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned());
    let mut sums: Vec<String> =
        files.iter().map(|(path, bytes)| format!("{}  {}\n", sha256(bytes), name(path))).collect();
    sums.sort_by(|a, b| a[66..].cmp(&b[66..]));
    files.push((of_sums, sums.concat().into_bytes()));
    atomic_all(&files)?;
    if arguments.json {
        return print(&summary.to_string());
    }
    let mut words = format!("{}: {} cells", task.parsed.file, cells.len());
    for class in Class::ALL {
        let count = cells.iter().filter(|cell| cell.class == class).count();
        if count > 0 {
            // writing to a String cannot fail
            let _ = write!(words, "; {} {:.2} %", class.in_words(), 100.0 * count as f64 / cells.len() as f64);
        }
    }
    print(&words)
}

/// How many cells have each outcome, and how many were run.
fn summary(task: &Task, cells: &[CellOutcome]) -> Value {
    let count = |is: &dyn Fn(&CellOutcome) -> bool| cells.iter().filter(|cell| is(cell)).count();
    let outcomes: serde_json::Map<String, Value> =
        Class::ALL.iter().map(|class| (class.name().to_owned(), json!(count(&|cell| cell.class == *class)))).collect();
    json!({
        "schema_version": 1,
        "law": task.sweep.model.name(),
        "x": task.sweep.x.parameter,
        "y": task.sweep.y.parameter,
        "cells": cells.len(),
        "run": count(&|cell| cell.decided_by != DecidedBy::Neighbours),
        "backward_flow": count(&|cell| cell.backward_flow),
        "outcomes": outcomes,
        "sweep": task.hash,
    })
}

/// All cells of the plane, column by column.
fn cells(task: &Task) -> Result<Vec<CellOutcome>, Failure> {
    let count = split(task)?;
    let rows = task.sweep.y.cells;
    let mut found: Vec<Option<CellOutcome>> = vec![None; task.sweep.cells()];
    let mut missing = Vec::new();
    for index in 1..=count {
        let shard = Shard { index, count };
        let Some(cells) = shard.read(task)? else {
            missing.push(index);
            continue;
        };
        for (cell, new) in cells {
            match &mut found[cell[0] * rows + cell[1]] {
                Some(old) if !agree(old, &new) => {
                    let path = shard.file(task);
                    let problem = format!("cell {cell:?} is another one in another shard: the machines differ");
                    return Err(Failure { message: format!("{}: {problem}", path.display()), code: 1 });
                }
                Some(_) => (),
                place => *place = Some(new),
            }
        }
    }
    if !missing.is_empty() {
        let names: Vec<String> = missing.iter().map(|index| format!("{index}/{count}")).collect();
        let scene = &task.parsed.file;
        let message = format!(
            "missing shards: {}; compute each with: sweep {scene} --out DIR --shard I/{count}",
            names.join(", ")
        );
        return Err(Failure { message, code: 3 });
    }
    found.into_iter().collect::<Option<Vec<CellOutcome>>>().ok_or_else(|| Failure::work("shards without all cells"))
}

/// The same outcome and the same bits.
fn agree(one: &CellOutcome, other: &CellOutcome) -> bool {
    let bits = |cell: &CellOutcome| cell.numbers.map(f64::to_bits);
    (one.class, one.backward_flow, one.decided_by) == (other.class, other.backward_flow, other.decided_by)
        && bits(one) == bits(other)
}

/// Into how many shards the plane was split, by the names of the files.
fn split(task: &Task) -> Result<usize, Failure> {
    let folder = task.out.join("shards");
    let none = || Failure { message: format!("{}: no shard yet", folder.display()), code: 3 };
    let entries = match std::fs::read_dir(&folder) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Err(none()),
        entries => entries.map_err(|error| with_path(error, &folder))?,
    };
    let mut counts: Vec<usize> = Vec::new();
    for entry in entries {
        let name = entry?.file_name().to_string_lossy().into_owned();
        let Some(stem) = name.strip_suffix(".csv") else { continue };
        let count = stem.split_once("-of-").and_then(|(_, count)| count.parse().ok());
        match count {
            Some(count) if count > 0 => counts.push(count),
            _ => return Err(Failure::input(format!("{}: {name}: not a shard; must be I-of-N.csv", folder.display()))),
        }
    }
    counts.sort_unstable();
    counts.dedup();
    match counts[..] {
        [count] => Ok(count),
        [] => Err(none()),
        _ => Err(Failure::input(format!("{}: shards of several splits: {counts:?}; must be of one", folder.display()))),
    }
}
