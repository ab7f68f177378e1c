//! Named measures of the ledger of claims, and how many claims there are of each verdict.

use super::form::Form;
use super::{Quantities, Source};
use crate::disk;
use crate::failure::Failure;
use crate::paths::LEDGER;
use serde_json::Value;
use std::collections::BTreeMap;

/// Adds `claim.ID.NAME` (and `erratum`, `parameter`) for each test with a name, and `claims.VERDICT`.
///
/// # Errors
/// Stale: there is no ledger. Usage: it is not JSON.
pub fn collect(source: &Source<'_>, all: &mut Quantities) -> Result<(), Failure> {
    let text = disk::read_text(&source.paths.root.join(LEDGER))?;
    let text = text.ok_or_else(|| Failure::Stale(format!("{LEDGER}: no such file")))?;
    let ledger: Value = serde_json::from_str(&text).map_err(|error| Failure::Usage(format!("{LEDGER}: {error}")))?;
    for (list, short) in [("claims", "claim"), ("errata", "erratum"), ("parameters", "parameter")] {
        let entries = ledger[list].as_array().map_or(&[][..], Vec::as_slice);
        all.exact(&format!("{list}.count"), entries.len() as f64, LEDGER);
        for entry in entries {
            let id = entry["id"].as_str().unwrap_or("");
            for test in entry["tests"].as_array().into_iter().flatten() {
                measure(all, &format!("{short}.{id}"), test);
            }
        }
    }
    let verdicts =
        ledger["claims"].as_array().into_iter().flatten().filter_map(|claim| claim["verdict_found"].as_str());
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    verdicts.for_each(|verdict| *counts.entry(verdict.replace(' ', "-")).or_default() += 1);
    for verdict in ["holds", "holds-with-a-condition", "does-not-hold", "cannot-be-decided"] {
        let count = counts.get(verdict).copied().unwrap_or(0);
        all.exact(&format!("claims.{verdict}"), count as f64, LEDGER);
    }
    Ok(())
}

fn measure(all: &mut Quantities, start: &str, test: &Value) {
    let (Some(name), Some(value)) = (test["name"].as_str(), test["value"].as_f64()) else { return };
    let error = test["error"].as_f64().filter(|error| *error > 0.0);
    // three digits say what a measure is; where its error is larger they are fewer
    let rounded = Form::rounded(value, 3);
    let form = match error {
        Some(error) if error > value.abs() * 1e-3 => Form::uncertain(value, error),
        _ if value.fract() == 0.0 => Form::exact(value),
        _ => rounded,
    };
    all.add(&format!("{start}.{name}"), Some(value), error, form, &format!("{LEDGER}: {start}"));
}
