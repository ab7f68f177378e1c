//! `explain`: every input of a figure with its hash, which one changed, and the command to rebuild; or a claim, an
//! erratum or a parameter with its tests.

use super::judge;
use crate::cli::ExplainArgs;
use crate::record::{self, FigureState, Record, Records};
use crate::sources::SourceHashes;
use checkout::failure::Failure;
use checkout::figure;
use checkout::paths::Paths;
use checkout::print;
use serde_json::{Value, json};

/// Digits of a hash that are shown in the table; JSON has all.
const DIGITS: usize = 12;

/// Runs the verb.
///
/// # Errors
/// Usage: no such figure, and no such entry of the ledger.
pub fn run(paths: &Paths, arguments: &ExplainArgs) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    let selected = match figure::select(&all, std::slice::from_ref(&arguments.id), false) {
        Ok(selected) => selected,
        Err(failure) => {
            let mut explain = judge::program(paths)?;
            explain.args(["explain", &arguments.id, "--no-figure", failure.text()]);
            return judge::run(explain.args(arguments.json.then_some("--json")));
        }
    };
    let records = Records::read(paths)?;
    let surveys = record::survey(paths, &selected, &SourceHashes::read(paths)?, &records)?;
    for survey in &surveys {
        let record = records.get(paths, survey.figure);
        if arguments.json {
            print::json(to_json(survey, record))?;
        } else {
            print::out(&to_text(survey, record))?;
        }
    }
    Ok(())
}

fn command(survey: &FigureState<'_>) -> String {
    format!("cargo xtask figures {}", survey.figure.id)
}

/// How an input compares with the record.
fn change(record: Option<&Record>, name: &str, hash: &str) -> &'static str {
    match record.map(|record| record.inputs.get(name)) {
        None => "",
        Some(None) => "new",
        Some(Some(old)) if old == hash => "unchanged",
        Some(Some(_)) => "changed",
    }
}

fn to_text(survey: &FigureState<'_>, record: Option<&Record>) -> String {
    let figure = survey.figure;
    let mut rows = Vec::new();
    for (name, hash) in &survey.inputs {
        rows.push(print::row(&[
            record::kind(name),
            name,
            hash.get(..DIGITS).unwrap_or(hash),
            change(record, name, hash),
        ]));
    }
    let reasons: Vec<String> = survey.reasons.iter().map(|reason| format!("  {reason}\n")).collect();
    let state = if reasons.is_empty() { "fresh\n".to_owned() } else { format!("stale:\n{}", reasons.concat()) };
    let title = figure.title();
    format!("{} {} {title}\n{}{state}rebuild: {}\n", figure.slug, figure.label(), print::table(&rows), command(survey))
}

fn to_json(survey: &FigureState<'_>, record: Option<&Record>) -> Value {
    let input = |(name, hash): (&String, &String)| {
        let (kind, change) = (record::kind(name), change(record, name, hash));
        json!({ "kind": kind, "name": name, "sha256": hash, "change": change })
    };
    let inputs: Vec<Value> = survey.inputs.iter().map(input).collect();
    json!({
        "figure": survey.figure.id, "binary": survey.figure.slug, "inputs": inputs, "why": survey.reasons,
        "command": command(survey),
    })
}
