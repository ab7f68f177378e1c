//! `list`: figure, label, title, binary, scene, outputs, last run time.

use super::figures::{Times, read_times};
use super::judge;
use crate::cli::ListArgs;
use crate::lock::Lock;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::outputs;
use checkout::paths::Paths;
use checkout::print;
use serde_json::{Value, json};

/// Runs the verb.
///
/// # Errors
/// Usage: no such figure.
pub fn run(paths: &Paths, arguments: &ListArgs) -> Result<(), Failure> {
    if arguments.claims {
        return judge::run(judge::program(paths)?.arg("claims").args(arguments.json.then_some("--json")));
    }
    let all = figure::discover(paths)?;
    let ids = &arguments.selection.ids;
    let selected = if ids.is_empty() { all.iter().collect() } else { figure::select(&all, ids, false)? };
    if arguments.costs {
        let _lock = Lock::take(paths)?;
        return judge::run(judge::program(paths)?.arg("costs"));
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

/// The existing tables, and the pictures.
fn names(paths: &Paths, figure: &Figure) -> Result<Vec<String>, Failure> {
    let mut names = outputs::tables(paths, figure)?;
    names.extend(outputs::pictures(paths, figure));
    Ok(names)
}

fn to_json(paths: &Paths, figure: &Figure, times: &Times) -> Result<Value, Failure> {
    Ok(json!({
        "figure": figure.id, "label": figure.label(), "title": figure.title(), "binary": figure.slug,
        "scene": Paths::scene(&figure.slug), "outputs": names(paths, figure)?, "seconds": times.get(&figure.slug),
        "problem": figure.scene_file.as_ref().err(),
    }))
}
