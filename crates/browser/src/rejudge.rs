//! Judges the claims of the paper again, on the tables of a run that started from one of the paper's scenes.

use crate::compute::at;
use crate::figures::{Content, Entry, FIGURES};
use claims::again;
use claims::sheet::{LedgerTable, Stated};
use claims::source::LedgerFiles;
use claims::tables::{EVENTS, Tables};
use files::scene_file;
use files::table::{self, CellValue, Table};
use jam::errors::Errors;
use jam::run::Outcome;
use scene::tables;
use serde_json::{Value, json};

/// A run that has ended, and the errors of its numbers.
#[derive(Debug)]
pub struct Ran {
    /// Its tables and events.
    pub outcome: Outcome,
    /// The errors of positions and speeds are those at the end, used for all samples.
    pub errors: Errors,
}

/// Judges claims on a run that replaces the one of a panel. The first line of the text is the panel, `fig04 unstable`,
/// the others are claims as in `paper/claims.toml`; those that read only tables of this run are returned: `id`, `says`,
/// `before` and `now` (verdicts), `tests` with `words`, `is`, `outcome`, `value` and `error` (null: not bounded) or
/// `problem`.
///
/// # Errors
/// There is no such panel, or a claim is malformed; `problem` in words.
pub fn judge(text: &str, ran: &Ran) -> Result<Value, Value> {
    told(text, ran).map_err(|problem| json!({ "problem": problem }))
}

fn told(text: &str, ran: &Ran) -> Result<Value, String> {
    let (panel, claims) = text.split_once('\n').unwrap_or((text, ""));
    let (figure, panel) = panel.split_once(' ').ok_or_else(|| format!("{panel:?}: must be a figure and a panel"))?;
    let failed = |failure: checkout::failure::Failure| failure.text().to_owned();
    let sources = LedgerFiles::parse([claims, "", ""]).map_err(failed)?;
    let tables = Tables::of_memory(sheets(figure, panel, ran)?);
    let mut told = Vec::new();
    for claim in again::about(&sources, &|table| tables.has(table)).map_err(failed)? {
        let (verdict, tests) = again::judge(claim, &tables).map_err(failed)?;
        let tests: Vec<Value> = tests.iter().map(test).collect();
        told.push(json!({
            "id": claim.id, "says": claim.says, "before": claim.verdict, "now": verdict, "tests": tests,
        }));
    }
    Ok(Value::Array(told))
}

fn test(test: &again::Again) -> Value {
    let mut told = json!({ "words": test.words, "is": test.is, "under": test.under, "outcome": test.outcome });
    match &test.value {
        Ok(value) => {
            told["value"] = json!(value.value);
            told["error"] = json!(value.error);
        }
        Err(problem) => told["problem"] = json!(problem),
    }
    told
}

/// The tables of all figures that are made from the run of this panel, and its events.
fn sheets(figure: &str, panel: &str, ran: &Ran) -> Result<Vec<(String, LedgerTable)>, String> {
    let wanted = determinants(figure, panel)?;
    let mut sheets = vec![(EVENTS.to_owned(), events(&format!("{figure}-{panel}"), ran))];
    for figure in &FIGURES {
        for entry in figure.tables {
            if determinants(figure.id, entry.panel)? == wanted
                && let Some(sheet) = sheet(entry, ran)
            {
                sheets.push((format!("{}/{}", figure.id, entry.name), sheet));
            }
        }
    }
    Ok(sheets)
}

fn determinants(id: &str, panel: &str) -> Result<String, String> {
    let figure = FIGURES.iter().find(|figure| figure.id == id).ok_or_else(|| format!("no figure {id}"))?;
    let parsed = scene_file::parse(id, figure.scene).map_err(|error| error.to_string())?;
    Ok(parsed.panel(panel).map_err(|error| error.to_string())?.determinants())
}

/// A table of the run; `None` if the run does not record its contents.
fn sheet(entry: &Entry, ran: &Ran) -> Option<LedgerTable> {
    let Ran { outcome, errors } = ran;
    let table = match entry.content {
        Content::Std => tables::std(&outcome.samples),
        Content::Trajectories => tables::trajectories(&outcome.samples),
        Content::At(time) => at(&tables::trajectories(&outcome.samples), time),
        Content::Map | Content::Curve => return None,
    };
    if entry.content != Content::Std && outcome.samples.positions.is_empty() {
        return None;
    }
    let error = |column: &str| {
        let error = match column {
            "std" => errors.std,
            "x" => errors.positions,
            "v" => errors.speeds,
            _ => return None,
        };
        Some(Stated::Absolute(error.unwrap_or(f64::INFINITY)))
    };
    Some(LedgerTable::new(cells(&table), &error))
}

fn cells(table: &Table) -> table::MixedTable {
    let names: Vec<&str> = table.columns.iter().map(String::as_str).collect();
    let mut sheet = table::MixedTable::new(&names);
    table
        .rows()
        .for_each(|row| sheet.push(row.iter().map(|&number| CellValue::from(number)).collect::<Vec<CellValue>>()));
    sheet
}

/// The events of the run, in the columns of `data/events.csv`.
fn events(scene: &str, ran: &Ran) -> LedgerTable {
    let mut sheet = table::MixedTable::new(&["scene", "event", "t", "n", "uncertainty"]);
    for (event, error) in ran.outcome.events.iter().zip(&ran.errors.events) {
        let error = error.map_or(CellValue::Empty, CellValue::from);
        let (kind, time) = (CellValue::from(event.kind.name()), CellValue::from(event.time));
        sheet.push(vec![CellValue::from(scene), kind, time, CellValue::from(event.pedestrian), error]);
    }
    LedgerTable::new(sheet, &|_| None)
}
