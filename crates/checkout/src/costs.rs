//! The costs of each program in a verification (`data/costs.csv`), measured by `verify --costs`, which runs one program
//! at a time.

use crate::disk;
use crate::failure::Failure;
use crate::paths::{COSTS, Paths};
use std::collections::BTreeMap;

/// The header.
const HEADER: &str = "node,cpu_seconds,peak_mib,kib_written";

/// What one program costs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Seconds on a processor.
    pub cpu: f64,
    /// Largest resident memory in MiB.
    pub memory: f64,
    /// What it leaves on the disk, in KiB.
    pub disk: f64,
}

/// Costs by the name of the node.
pub type Costs = BTreeMap<String, Cost>;

/// The committed costs; none when there is no file.
///
/// # Errors
/// Usage: it is malformed, with the line.
pub fn read(paths: &Paths) -> Result<Costs, Failure> {
    let text = disk::read_text(&paths.root.join(COSTS))?.unwrap_or_default();
    let mut costs = Costs::new();
    for (index, line) in text.lines().enumerate() {
        let fail = || Failure::Usage(format!("{COSTS}:{}: expected {HEADER}, found {line:?}", index + 1));
        if index == 0 {
            if line == HEADER { continue } else { return Err(fail()) }
        }
        let cells: Vec<&str> = line.split(',').collect();
        let [node, cpu, memory, disk] = cells[..] else { return Err(fail()) };
        let number = |cell: &str| cell.parse::<f64>().map_err(|_| fail());
        let cost = Cost { cpu: number(cpu)?, memory: number(memory)?, disk: number(disk)? };
        costs.insert(node.to_owned(), cost);
    }
    Ok(costs)
}

/// Writes the costs in place of those of the same nodes.
///
/// # Errors
/// The file cannot be read or written.
pub fn write(paths: &Paths, measured: &Costs) -> Result<(), Failure> {
    let mut costs = read(paths)?;
    costs.extend(measured.iter().map(|(node, cost)| (node.clone(), *cost)));
    let line =
        |(node, Cost { cpu, memory, disk }): (&String, &Cost)| format!("{node},{cpu:.3},{memory:.1},{disk:.0}\n");
    let text = format!("{HEADER}\n{}", costs.iter().map(line).collect::<String>());
    disk::write_if_changed(&paths.root.join(COSTS), text.as_bytes())
}
