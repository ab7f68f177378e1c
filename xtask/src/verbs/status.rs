//! `status`: what is stale and why, without running anything.

use crate::cli::StatusArgs;
use crate::record::{self, FigureState, Records};
use crate::sources::SourceHashes;
use checkout::failure::Failure;
use checkout::figure;
use checkout::paths::Paths;
use checkout::print;
use serde_json::{Value, json};

/// Reasons shown for a figure; the rest is counted (`explain` has all).
const SHOWN: usize = 3;

/// Runs the verb.
///
/// # Errors
/// Stale: something is, and `--exit-code` was given.
pub fn run(paths: &Paths, arguments: &StatusArgs) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    let selected = figure::select(&all, &arguments.selection.ids, arguments.selection.all)?;
    let surveys = record::survey(paths, &selected, &SourceHashes::read(paths)?, &Records::read(paths)?)?;
    if arguments.json {
        let figures: Vec<Value> = surveys.iter().map(to_json).collect();
        print::json(json!({ "figures": figures }))?;
    } else {
        let mut rows = vec![print::row(&["figure", "state", "why"])];
        rows.extend(surveys.iter().map(|survey| print::row(&[&survey.figure.id, state(survey), &why(survey)])));
        print::out(&print::table(&rows))?;
    }
    let stale = surveys.iter().filter(|survey| !survey.reasons.is_empty()).count();
    match stale {
        1.. if arguments.exit_code => Err(Failure::Stale(format!("{stale} of {} figures stale", surveys.len()))),
        _ => Ok(()),
    }
}

fn state(survey: &FigureState<'_>) -> &'static str {
    if survey.reasons.is_empty() { "fresh" } else { "stale" }
}

fn why(survey: &FigureState<'_>) -> String {
    let shown: Vec<&str> = survey.reasons.iter().take(SHOWN).map(String::as_str).collect();
    match survey.reasons.len().saturating_sub(SHOWN) {
        0 => shown.join("; "),
        more => format!("{}; and {more} more", shown.join("; ")),
    }
}

fn to_json(survey: &FigureState<'_>) -> Value {
    json!({ "figure": survey.figure.id, "binary": survey.figure.slug, "state": state(survey), "why": survey.reasons })
}
