//! What each program of a verification costs: `data/costs.csv`, measured by `verify --costs`, one program at a time.

use crate::disk;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::ledger::{self, tables::figure_of};
use crate::paths::{COSTS, Paths, REPRODUCING};
use crate::plan::{self, Node, Wish};
use crate::record::Survey;
use crate::verbs::figures::{Times, forecast};
use crate::work::Made;
use std::collections::{BTreeMap, BTreeSet};

/// The header.
const HEADER: &str = "node,cpu_seconds,peak_mib,kib_written";

/// What stands in the document before the tables.
const FROM: &str = "<!-- from here on: cargo xtask list --costs -->\n";
/// And behind them.
const TO: &str = "<!-- up to here -->\n";

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

impl Cost {
    /// Of a program that has ended; nothing where the machine does not tell.
    pub fn of(made: &Made) -> Option<Cost> {
        let memory = made.usage.memory? as f64 / 1_048_576.0;
        Some(Cost { cpu: made.usage.cpu?, memory, disk: made.bytes as f64 / 1024.0 })
    }
}

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

/// Figures that fit into a time, and those that do not, each with the seconds that it takes alone.
#[derive(Clone, Debug, Default)]
pub struct Choice<'a> {
    /// In the order of the figures.
    pub fits: Vec<&'a Figure>,
    /// In the order of the figures.
    pub left_out: Vec<(&'a Figure, f64)>,
    /// Seconds that all that fit take together.
    pub seconds: f64,
}

/// The figures that fit into `budget` seconds on so many threads, the cheapest first: by the seconds of the last runs
/// here, where there are none by the committed ones. A program of which neither is known does not fit.
///
/// # Errors
/// A stored run cannot be read.
pub fn choose<'a>(
    scratch: &Paths,
    surveys: &[Survey<'a>],
    (times, costs): (&Times, &Costs),
    threads: usize,
    budget: f64,
) -> Result<Choice<'a>, Failure> {
    let last = |node: &Node| times.get(&node.name).copied().or_else(|| costs.get(&node.name).map(|cost| cost.cpu));
    let seconds = |chosen: &[bool]| {
        let wishes: Vec<Wish> = chosen.iter().map(|&draw| Wish { draw, measure: false }).collect();
        let nodes = plan::make(scratch, surveys, &wishes, true)?;
        let forecast = forecast(&nodes, threads, &last);
        Ok(if forecast.unknown > 0 { f64::INFINITY } else { forecast.seconds })
    };
    let only = |index: usize| (0..surveys.len()).map(|other| other == index).collect::<Vec<bool>>();
    let alone = (0..surveys.len()).map(|index| seconds(&only(index))).collect::<Result<Vec<f64>, Failure>>()?;
    let mut order: Vec<usize> = (0..surveys.len()).collect();
    order.sort_by(|&one, &other| alone[one].total_cmp(&alone[other]));
    let (mut chosen, mut taken) = (vec![false; surveys.len()], 0.0);
    for index in order {
        let mut more = chosen.clone();
        more[index] = true;
        let needed = seconds(&more)?;
        if needed <= budget {
            (chosen, taken) = (more, needed);
        }
    }
    let figures = || surveys.iter().map(|survey| survey.figure).zip(&chosen);
    Ok(Choice {
        fits: figures().filter(|(_, chosen)| **chosen).map(|(figure, _)| figure).collect(),
        left_out: figures().zip(alone).filter(|((_, fits), _)| !**fits).map(|((figure, _), s)| (figure, s)).collect(),
        seconds: taken,
    })
}

/// The costs of each figure: its programs one after the other. A run that several figures share is counted at the first.
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

/// A row for each claim: what it reads, and what that costs to make. A claim on committed tables alone costs nothing.
fn claims(paths: &Paths, costs: &[(&Figure, Cost)]) -> Result<String, Failure> {
    let mut rows = String::new();
    for claim in ledger::source::Sources::read(paths)?.claims {
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

/// Puts the tables between the two marks of the document; one without marks is left alone.
///
/// # Errors
/// The document cannot be read or written.
pub fn put_in_document(paths: &Paths, tables: &str) -> Result<(), Failure> {
    let path = paths.root.join(REPRODUCING);
    let text = disk::read_text(&path)?.unwrap_or_default();
    match parts(&text) {
        Some((before, _, after)) => disk::write_if_changed(&path, format!("{before}{tables}{after}").as_bytes()),
        None => Ok(()),
    }
}

/// What stands before, between and after the marks of the document.
pub fn parts(text: &str) -> Option<(&str, &str, &str)> {
    let (start, end) = (text.find(FROM)? + FROM.len(), text.find(TO)?);
    Some((&text[..start], text.get(start..end)?, &text[end..]))
}
