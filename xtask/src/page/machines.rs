//! Who got the same bits: the lines that `verify --attest` has added, against the committed sums.

use super::html::{escape, table};
use super::source::Source;
use crate::disk;
use crate::failure::Failure;
use serde::Deserialize;

/// What the page tells of a machine.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Machine {
    architecture: String,
    processor: String,
    features: Vec<String>,
    system: String,
    rustc: String,
    /// SHA-256 over the list of sums that it got.
    sums: String,
}

/// A row for each machine; a sentence where none is recorded.
///
/// # Errors
/// A line of the log is malformed, or the committed sums cannot be read.
pub fn rows(source: &Source<'_>) -> Result<String, Failure> {
    let log = source.paths.attestation_log();
    let committed = source.text(source.paths.sums(false))?;
    let lines = disk::read_text(&log)?.unwrap_or_default();
    let machines = lines.lines().map(serde_json::from_str::<Machine>).collect::<Result<Vec<_>, _>>();
    let machines = machines.map_err(Failure::at(&log))?;
    Ok(render(&machines, &files::write::sha256(committed.as_bytes())))
}

fn render(machines: &[Machine], committed: &str) -> String {
    if machines.is_empty() {
        return "<p>No machine is recorded.</p>\n".to_owned();
    }
    let row = |machine: &Machine| {
        let verdict = if machine.sums == committed { "the committed bits" } else { "other bits" };
        vec![
            escape(&machine.processor),
            escape(&machine.architecture),
            escape(&machine.features.join(", ")),
            escape(&machine.system),
            escape(&machine.rustc),
            verdict.to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = machines.iter().map(row).collect();
    table("Machines", &["processor", "architecture", "instructions", "system", "compiler", "what it got"], &rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_sums_are_other_bits() {
        let machine = |sums: &str| Machine { sums: sums.to_owned(), ..Machine::default() };
        assert!(render(&[machine("a")], "a").contains("the committed bits"));
        assert!(render(&[machine("b")], "a").contains("other bits"));
        assert!(render(&[], "a").contains("No machine"));
    }
}
