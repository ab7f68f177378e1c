//! Writes the committed costs of figures and claims as a document.

use checkout::costs::{Cost, Costs, read};
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::paths::Paths;
use checkout::print;
use claims::source::LedgerFiles;
use claims::tables::figure_of;
use std::collections::BTreeSet;

/// The document, by name.
const DOCUMENT: &str = "data/COSTS.md";

/// The text before the tables.
const PREFACE: &str = "# What each figure and each claim costs

Written by `cargo xtask list --costs` from `data/costs.csv`, which `cargo xtask verify --all --costs` measures: seconds of one
processor, the largest resident memory, and what lies on the disk afterwards. A run that several figures share counts at the first.
The second runs that estimate errors are not included. A claim is judged in well below a second once its tables are there; its costs
are those of the figures that it reads.

";

/// Writes the document and prints the tables.
///
/// # Errors
/// Usage: the costs or the ledger are malformed. Otherwise the document cannot be written.
pub fn tell(paths: &Paths) -> Result<(), Failure> {
    let text = markdown(paths, &figure::discover(paths)?)?;
    disk::write_if_changed(&paths.root.join(DOCUMENT), format!("{PREFACE}{text}").as_bytes())?;
    print::out(&text)
}

/// The costs of each figure: its programs one after the other. A run that several figures share is counted at the
/// first.
pub fn of_figures<'a>(all: &'a [Figure], costs: &Costs) -> Vec<(&'a Figure, Cost)> {
    let mine = |figure: &Figure, node: &str| node == figure.slug || node.starts_with(&format!("{} ", figure.id));
    let sum = |figure: &'a Figure| {
        let nodes = costs.iter().filter(|(node, _)| mine(figure, node)).map(|(_, cost)| cost);
        Some((figure, total(nodes)?))
    };
    all.iter().filter_map(sum).collect()
}

/// Costs of programs that run one after the other; nothing for none.
fn total<'a>(costs: impl Iterator<Item = &'a Cost>) -> Option<Cost> {
    costs.copied().reduce(|one, other| Cost {
        cpu: one.cpu + other.cpu,
        memory: if one.memory > other.memory { one.memory } else { other.memory },
        disk: one.disk + other.disk,
    })
}

/// What each figure and each claim costs, in Markdown.
///
/// # Errors
/// Usage: the costs or the ledger are malformed.
pub fn markdown(paths: &Paths, all: &[Figure]) -> Result<String, Failure> {
    let costs = of_figures(all, &read(paths)?);
    let row = |(figure, cost): &(&Figure, Cost)| {
        let (id, Cost { cpu, memory, disk }) = (&figure.id, cost);
        format!("| {id} | `cargo xtask figures {id}` | {cpu:.2} | {memory:.0} | {:.1} |\n", disk / 1024.0)
    };
    let figures: String = costs.iter().map(row).collect();
    let figures =
        format!("| figure | command | CPU seconds | memory, MiB | disk, MiB |\n|---|---|---|---|---|\n{figures}");
    let claims = claims(paths, &costs)?;
    if claims.is_empty() {
        return Ok(figures);
    }
    Ok(format!(
        "{figures}\n| claim | made from | CPU seconds | memory, MiB | disk, MiB |\n|---|---|---|---|---|\n{claims}"
    ))
}

/// A row for each claim: the tables it reads, and the cost of making them. A claim on committed tables alone costs
/// nothing.
fn claims(paths: &Paths, costs: &[(&Figure, Cost)]) -> Result<String, Failure> {
    let mut rows = String::new();
    for claim in LedgerFiles::read(paths)?.claims {
        let mut tables = BTreeSet::new();
        for (place, _, measure) in claim.all_tests() {
            tables.extend(measure.tables(&place)?);
        }
        let figures: BTreeSet<&str> = tables.iter().filter_map(|table| figure_of(table)).collect();
        let mine = costs.iter().filter(|(figure, _)| figures.contains(&*figure.id));
        let Cost { cpu, memory, disk } = total(mine.map(|(_, cost)| cost)).unwrap_or_default();
        let figures: Vec<&str> = figures.into_iter().collect();
        let (id, from) = (&claim.id, if figures.is_empty() { "committed tables".into() } else { figures.join(" ") });
        let disk = disk / 1024.0;
        rows.push_str(&format!("| `cargo xtask explain {id}` | {from} | {cpu:.2} | {memory:.0} | {disk:.1} |\n"));
    }
    Ok(rows)
}
