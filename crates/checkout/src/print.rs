//! Text and JSON for stdout.

use crate::failure::Failure;
use serde_json::Value;
use std::io::{self, Write};

/// Writes to stdout. A reader that went away (`| head`) is no error.
///
/// # Errors
/// stdout cannot be written for another reason.
pub fn out(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Failed(format!("stdout: {error}"))),
        _ => Ok(()),
    }
}

/// Writes an object to stdout with `schema_version` in it.
///
/// # Errors
/// As [`out`].
pub fn json(mut value: Value) -> Result<(), Failure> {
    value["schema_version"] = 1.into();
    let text = serde_json::to_string_pretty(&value).map_err(Failure::failed)?;
    out(&format!("{text}\n"))
}

/// Rows as text, columns as wide as their widest cell, two blanks between; the first row is the header.
pub fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let line = |row: &Vec<String>| {
        let cells: Vec<String> = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:<width$}")).collect();
        format!("{}\n", cells.join("  ").trim_end())
    };
    rows.iter().map(line).collect()
}

/// The cells of a row.
pub fn row(cells: &[&str]) -> Vec<String> {
    cells.iter().map(|&cell| cell.to_owned()).collect()
}

/// Seconds in words: `48 s`, `5 min`, `2.1 h`.
pub fn duration(seconds: f64) -> String {
    match seconds {
        ..90.0 => format!("{seconds:.0} s"),
        90.0..5400.0 => format!("{:.0} min", seconds / 60.0),
        _ => format!("{:.1} h", seconds / 3600.0),
    }
}
