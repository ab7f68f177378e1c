//! The claims that the page judges again on a reader's run: those that read only tables of runs.

use super::source::Source;
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{LEDGER_SOURCES, Paths};
use claims::again;
use claims::source::LedgerFiles;
use std::collections::BTreeSet;

/// They, as `paper/claims.toml` has them.
///
/// # Errors
/// The file is malformed.
pub fn text(source: &Source<'_>) -> Result<String, Failure> {
    let text = disk::read_text(&source.paths.root.join(LEDGER_SOURCES[0]))?.unwrap_or_default();
    let sources = LedgerFiles::parse([&text, "", ""])?;
    let is_of_run = |table: &str| {
        let entry = source.manifest.get(&Paths::table(table));
        table.starts_with("fig") && entry.is_some_and(|entry| entry.run.is_some())
    };
    let wanted: BTreeSet<&str> = again::about(&sources, &is_of_run)?.iter().map(|claim| claim.id.as_str()).collect();
    let mut file: toml::Table = toml::from_str(&text).map_err(Failure::failed)?;
    if let Some(toml::Value::Array(claims)) = file.get_mut("claim") {
        claims.retain(|claim| claim.get("id").and_then(toml::Value::as_str).is_some_and(|id| wanted.contains(id)));
    }
    toml::to_string(&file).map_err(Failure::failed)
}
