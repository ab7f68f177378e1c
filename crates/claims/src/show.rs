//! The ledger for a reader: one entry with all its tests, or all claims with their verdicts.

use crate::entry::{Claim, Erratum, Parameter};
use crate::report::{Ledger, Tested};
use crate::source::LedgerFiles;
use crate::tables::Tables;
use crate::uncertain::Outcome;
use checkout::failure::Failure;
use checkout::paths::Paths;
use checkout::print;
use serde_json::{Value, json};

/// The entry with this id as text and as JSON; `None` if it does not exist.
///
/// # Errors
/// Usage: a file of the ledger is malformed, or a test of this entry cannot be evaluated.
pub fn explain(paths: &Paths, id: &str) -> Result<Option<(String, Value)>, Failure> {
    let mut sources = LedgerFiles::read(paths)?;
    sources.claims.retain(|one| one.id == id);
    sources.errata.retain(|one| one.id == id);
    sources.parameters.retain(|one| one.id == id);
    if sources.is_empty() {
        return Ok(None);
    }
    let ledger = Ledger::new(&sources, &Tables::new(paths, paths)?)?;
    let claim = ledger.claims.first().map(|one| (of_claim(one), json!({ "claim": one })));
    let erratum = ledger.errata.first().map(|one| (of_erratum(one), json!({ "erratum": one })));
    let parameter = ledger.parameters.first().map(|one| (of_parameter(one), json!({ "parameter": one })));
    Ok(claim.or(erratum).or(parameter))
}

/// All claims with their recorded verdicts.
///
/// # Errors
/// Usage: a file of the ledger is malformed.
pub fn list(paths: &Paths) -> Result<(String, Value), Failure> {
    let sources = LedgerFiles::read(paths)?;
    let mut rows = vec![print::row(&["claim", "label", "verdict", "says"])];
    for claim in &sources.claims {
        rows.push(print::row(&[&claim.id, &claim.label, claim.verdict.words(), &claim.says]));
    }
    let claims = sources
        .claims
        .iter()
        .map(|claim| json!({ "id": claim.id, "label": claim.label, "verdict": claim.verdict, "says": claim.says }));
    Ok((print::table(&rows), json!({ "claims": claims.collect::<Vec<_>>() })))
}

fn of_claim(claim: &Claim<Tested>) -> String {
    let mut text = format!("{} ({})\nsays: {}\n", claim.id, claim.label, claim.says);
    text.push_str(&format!("verdict: {}", claim.found().words()));
    if !claim.is_as_recorded() {
        text.push_str(&format!(", but recorded is: {}", claim.verdict.words()));
    }
    text.push('\n');
    for (key, words) in [("condition", &claim.condition), ("why", &claim.why)] {
        text.push_str(&words.as_ref().map_or(String::new(), |words| format!("{key}: {words}\n")));
    }
    format!("{text}finding: {}\n{}", claim.finding, tests(&claim.tests))
}

fn of_erratum(erratum: &Erratum<Tested>) -> String {
    let Erratum { id, label, says, should, why, touches, tests: all, .. } = erratum;
    let touches = if touches.is_empty() { "no figure".to_owned() } else { touches.join(", ") };
    format!("{id} ({label})\nsays: {says}\nshould: {should}\nwhy: {why}\ntouches: {touches}\n{}", tests(all))
}

fn of_parameter(parameter: &Parameter<Tested>) -> String {
    let Parameter { id, symbol, name, figures, scenes, source, influence, tests: all, .. } = parameter;
    let (figures, scenes) = (figures.join(", "), scenes.join("\n        "));
    format!(
        "{id}: {symbol}, {name}\nfigures: {figures}\nscenes: {scenes}\nsource: {source}\ninfluence: {influence}\n{}",
        tests(all)
    )
}

fn tests(tests: &[Tested]) -> String {
    let block = |test: &Tested| {
        let kind = if test.under { "under the condition" } else { "test" };
        let name = test.name.as_ref().map_or(String::new(), |name| format!(" {name}"));
        format!("{kind}{name}\n  {}\n  {}\n  command: {}\n", test.words, verdict(test), test.command)
    };
    tests.iter().map(block).collect()
}

/// Value, error, what must be true and whether it is.
fn verdict(test: &Tested) -> String {
    let error = if test.error == 0.0 { String::new() } else { format!(" +- {:.1e}", test.error) };
    let value = format!("{:?}{error}", test.value);
    match (&test.is, test.outcome) {
        (Some(is), Some(outcome)) => format!("{value}, must be {is}: {}", outcome.word()),
        _ => value,
    }
}

/// A test in one line.
pub(crate) fn line(test: &Tested) -> String {
    let under = if test.under { "under the condition: " } else { "" };
    let mark = if test.outcome == Some(Outcome::True) { "" } else { "! " };
    format!("{mark}{under}{}: {}", test.words, verdict(test))
}
