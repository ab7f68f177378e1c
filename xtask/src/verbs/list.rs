//! `list`: figure, label, title, binary, scene, outputs, last run time.

use super::figures::{Times, read_times};
use crate::cli::ListArgs;
use crate::costs;
use crate::failure::Failure;
use crate::figure::{self, Figure};
use crate::ledger;
use crate::lock::Lock;
use crate::outputs;
use crate::paths::Paths;
use crate::print;
use serde_json::{Value, json};

/// Runs the verb.
///
/// # Errors
/// Usage: no such figure.
pub fn run(paths: &Paths, arguments: &ListArgs) -> Result<(), Failure> {
    if arguments.claims {
        let (text, value) = ledger::list(paths)?;
        return if arguments.json { print::json(value) } else { print::out(&text) };
    }
    let all = figure::discover(paths)?;
    let ids = &arguments.selection.ids;
    let selected = if ids.is_empty() { all.iter().collect() } else { figure::select(&all, ids, false)? };
    if arguments.costs {
        let _lock = Lock::take(paths)?;
        let text = costs::markdown(paths, &all)?;
        costs::put_in_document(paths, &text)?;
        return print::out(&text);
    }
    let times = read_times(paths)?;
    if arguments.json {
        let figures: Result<Vec<Value>, Failure> =
            selected.iter().map(|figure| to_json(paths, figure, &times)).collect();
        return print::json(json!({ "figures": figures? }));
    }
    let mut rows = vec![print::row(&["figure", "label", "seconds", "binary", "title"])];
    for figure in &selected {
        let seconds = times.get(&figure.slug).map_or("-".to_owned(), |seconds| format!("{seconds:.2}"));
        rows.push(print::row(&[&figure.id, figure.label(), &seconds, &figure.slug, figure.title()]));
    }
    let mut text = print::table(&rows);
    for figure in &selected {
        let lines: Vec<String> = names(paths, figure)?.into_iter().map(|name| format!("  {name}\n")).collect();
        text.push_str(&format!("{}\n  {}\n{}", figure.id, Paths::scene(&figure.slug), lines.concat()));
    }
    print::out(&text)
}

/// The tables that are there, and the pictures.
fn names(paths: &Paths, figure: &Figure) -> Result<Vec<String>, Failure> {
    let mut names = outputs::tables(paths, figure)?;
    names.extend(outputs::pictures(paths, figure));
    Ok(names)
}

fn to_json(paths: &Paths, figure: &Figure, times: &Times) -> Result<Value, Failure> {
    Ok(json!({
        "figure": figure.id, "label": figure.label(), "title": figure.title(), "binary": figure.slug,
        "scene": Paths::scene(&figure.slug), "outputs": names(paths, figure)?, "seconds": times.get(&figure.slug),
        "problem": figure.recipe.as_ref().err(),
    }))
}
