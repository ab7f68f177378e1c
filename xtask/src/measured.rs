//! Measures each figure that was made: the errors of its runs, for the manifest, and their events.

use crate::estimate::{self, Estimate};
use crate::pins::{CRATE, RUSTC};
use crate::record::FigureState;
use crate::sources::KEY;
use checkout::disk;
use checkout::events;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::hashing;
use checkout::manifest::{Entry, FLAGGED_ABOVE, read, to_text};
use checkout::outputs;
use checkout::paths::{EVENTS, Paths};
use files::pairs::KEYS;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// What was measured of one figure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Entries by the name of the output.
    pub entries: BTreeMap<String, Entry>,
    /// Lines of the table of events, by scene.
    pub events: BTreeMap<String, Vec<String>>,
}

impl Measured {
    /// Every error above [`FLAGGED_ABOVE`] or unknown, in words: table, column, number.
    pub fn flags(&self) -> Vec<String> {
        let errors = self.entries.iter().flat_map(|(name, entry)| entry.error.iter().map(move |error| (name, error)));
        let flagged = errors.filter(|(_, (_, error))| is_flagged(**error));
        let words = |(name, (column, error)): (&String, (&String, &Option<f64>))| match error {
            Some(error) => format!("error of {name}, column {column}: {error:.1e} of the data range"),
            None => format!("error of {name}, column {column}: unknown: the second run gives no estimate"),
        };
        flagged.map(words).collect()
    }

    /// The largest error of any column of the figure.
    pub fn largest_error(&self) -> Option<f64> {
        let errors = self.entries.values().flat_map(|entry| entry.error.values());
        errors.map(|error| error.unwrap_or(f64::INFINITY)).max_by(f64::total_cmp)
    }
}

/// The report of a figure's program on its tables (`--report`).
#[derive(Debug, Default, Deserialize)]
struct Report {
    #[serde(default)]
    tables: BTreeMap<String, TableReport>,
}

#[derive(Debug, Default, Deserialize)]
struct TableReport {
    /// Error of each column as a part of its drawn range, where the binary knows it better than a comparison of runs.
    #[serde(default)]
    error: BTreeMap<String, Option<f64>>,
    /// How the table was computed.
    method: Option<Value>,
    /// The panel whose run it was read from.
    run: Option<String>,
}

/// Measures one figure that is up to date. `estimates` has every run of it by key; `scenes` gives the scene under which
/// a run's events are listed, by key.
///
/// # Errors
/// An output or the program's report on it cannot be read.
pub fn measure(
    paths: &Paths,
    survey: &FigureState<'_>,
    estimates: &BTreeMap<String, Estimate>,
    scenes: &BTreeMap<String, String>,
) -> Result<Measured, Failure> {
    let report = read_report(&paths.report(&survey.figure.id))?;
    let common = common(survey);
    let tables = paths.tables(&survey.figure.id);
    let mut measured = Measured::default();
    for (name, hash) in &survey.outputs {
        let path = paths.output(name);
        let bytes = path.metadata().map_err(Failure::at(&path))?.len();
        let mut entry = Entry { sha256: hash.clone(), bytes, ..common.clone() };
        let table = name.strip_prefix(&tables).and_then(|rest| rest.strip_prefix('/')?.strip_suffix(".csv"));
        if let Some(table) = table {
            describe_table(&mut entry, survey, table, &path, &report, estimates)?;
        }
        measured.entries.insert(name.clone(), entry);
    }
    for (_, key) in &survey.runs {
        if let (Some(estimate), Some(scene)) = (estimates.get(key), scenes.get(key)) {
            let lines = events::lines(scene, &estimate.events, &estimate.check_events);
            measured.events.insert(scene.clone(), lines);
        }
    }
    Ok(measured)
}

/// What all outputs of a figure share.
fn common(survey: &FigureState<'_>) -> Entry {
    let scene = Paths::scene(&survey.figure.slug);
    let hash = |name: &str| survey.inputs.get(name).cloned().unwrap_or_default();
    let mut sources = survey.inputs.clone();
    let mut crates = sources.clone();
    let apart = ["run ", KEY, CRATE];
    sources.retain(|name, _| name != RUSTC && *name != scene && !apart.iter().any(|start| name.starts_with(start)));
    crates.retain(|name, _| name.starts_with(CRATE));
    Entry {
        binary: survey.figure.slug.clone(),
        sources: hashing::digest(&sources),
        lock: hashing::digest(&crates),
        scene: hash(&scene),
        ..Entry::default()
    }
}

fn describe_table(
    entry: &mut Entry,
    survey: &FigureState<'_>,
    table: &str,
    path: &Path,
    report: &Report,
    estimates: &BTreeMap<String, Estimate>,
) -> Result<(), Failure> {
    let said = report.tables.get(table);
    let key = run_of(survey, table, said.and_then(|said| said.run.as_deref()));
    if let Some((key, estimate)) = key.and_then(|key| Some((key, estimates.get(key)?))) {
        entry.run = Some(key.to_owned());
        entry.unmatched_rows = estimate.unmatched;
        entry.counts = counts(&estimate.summary);
        entry.error = relative_errors(path, estimate)?;
    }
    if let Some(said) = said {
        entry.error.extend(said.error.clone());
        entry.counts.extend(said.method.clone().map(|method| ("method".to_owned(), method)));
    }
    entry.flagged = entry.error.values().any(|&error| is_flagged(error));
    Ok(())
}

/// Method, tolerance (or step) and counts of a run.
fn counts(summary: &Value) -> BTreeMap<String, Value> {
    let named =
        ["method", "steps", "rejected", "right_hand_sides"].map(|name| (name.to_owned(), summary[name].clone()));
    let control =
        summary["control"].as_object().into_iter().flatten().map(|(name, value)| (name.clone(), value.clone()));
    named.into_iter().chain(control).filter(|(_, value)| !value.is_null()).collect()
}

/// The key of the run a table was read from: of the panel the binary names, of the panel named as the table, or of the
/// figure's only run.
fn run_of<'a>(survey: &'a FigureState<'_>, table: &str, said: Option<&str>) -> Option<&'a str> {
    let wanted = said.unwrap_or(table);
    let named = survey.runs.iter().find(|(panel, _)| panel == wanted);
    let only = || survey.runs.first().filter(|_| survey.runs.len() == 1 && said.is_none());
    named.or_else(only).map(|(_, key)| key.as_str())
}

/// The run's largest difference from its check, divided by the range that the table draws: largest less smallest value
/// of the column, for `x` the ring's length. A table that shows a part of the run gets the error of the whole: a bound.
fn relative_errors(path: &Path, estimate: &Estimate) -> Result<BTreeMap<String, Option<f64>>, Failure> {
    let table = estimate::table(path)?;
    let mut errors = BTreeMap::new();
    for name in table.columns.iter().filter(|name| !KEYS.contains(&name.as_str())) {
        let Some(&difference) = estimate.columns.get(name) else { continue };
        let column = table.column(name).map_err(Failure::at(path))?;
        let range = estimate.length().filter(|_| name == "x").unwrap_or_else(|| spread(&column));
        // a column that stays at one value has no range; its difference is given as it is
        let error = if range > 0.0 { difference / range } else { difference };
        errors.insert(name.clone(), Some(error).filter(|error| error.is_finite()));
    }
    Ok(errors)
}

fn spread(column: &[f64]) -> f64 {
    let least = column.iter().copied().min_by(f64::total_cmp).unwrap_or(0.0);
    let largest = column.iter().copied().max_by(f64::total_cmp).unwrap_or(0.0);
    largest - least
}

fn read_report(path: &Path) -> Result<Report, Failure> {
    match disk::read_text(path)? {
        Some(text) => serde_json::from_str(&text).map_err(Failure::at(path)),
        None => Ok(Report::default()),
    }
}

fn is_flagged(error: Option<f64>) -> bool {
    error.is_none_or(|error| error > FLAGGED_ABOVE)
}

/// Writes the manifest and the table of events: the figures measured in place of their old entries; entries of figures
/// that are not measured now stay, those of figures that no longer exist go.
///
/// # Errors
/// A file cannot be read or written.
pub fn write(paths: &Paths, all: &[Figure], measured: &[(&Figure, &Measured)]) -> Result<(), Failure> {
    let mine =
        |figure: &Figure, name: &str| outputs::beginnings(paths, figure).iter().any(|start| name.starts_with(start));
    let is_measured = |figure: &Figure| measured.iter().any(|(other, _)| other.slug == figure.slug);
    let stays = |name: &str| all.iter().any(|figure| !is_measured(figure) && mine(figure, name));
    let mut entries: BTreeMap<String, Entry> = read(paths)?.into_iter().filter(|(name, _)| stays(name)).collect();
    entries.extend(measured.iter().flat_map(|(_, measured)| measured.entries.clone()));
    disk::write_if_changed(&paths.manifest(), to_text(entries)?.as_bytes())?;
    write_events(paths, all, measured)
}

fn write_events(paths: &Paths, all: &[Figure], measured: &[(&Figure, &Measured)]) -> Result<(), Failure> {
    let fresh: BTreeMap<&String, &Vec<String>> = measured.iter().flat_map(|(_, measured)| &measured.events).collect();
    let lines: Vec<String> = fresh.values().flat_map(|lines| lines.iter().cloned()).collect();
    let is_measured = |id: &str| measured.iter().any(|(figure, _)| figure.id == id);
    let dropped = |scene: &str| {
        let id = scene.split('-').next().unwrap_or("");
        fresh.contains_key(&scene.to_owned()) || is_measured(id) || !all.iter().any(|figure| figure.id == id)
    };
    let path = paths.root.join(EVENTS);
    let old = disk::read_text(&path)?.unwrap_or_default();
    disk::write_if_changed(&path, events::merge(&old, &lines, &dropped).as_bytes())
}
