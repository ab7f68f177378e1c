//! Building the binaries, only when their sources have changed.

use crate::child;
use crate::disk;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::hashing;
use crate::paths::{FONT_SUMS, FONTS_REMEDY, Paths};
use crate::sources::Sources;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::UNIX_EPOCH;

/// Binaries beside those of the figures.
pub const TOOLS: [&str; 5] = ["simulate", "map", "precision", "hard", "studies"];

/// What was built: the hash of the sources, and size and date of each binary, so that one that was built by hand since
/// then is not taken for ours.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
struct Built {
    sources: String,
    binaries: BTreeMap<String, (u64, u128)>,
}

/// The command that builds the binaries, as a user would type it.
pub const COMMAND: &str = "cargo build --release --locked -p figures";

/// Whether the binaries are older than their sources, or missing.
///
/// # Errors
/// The record of the last build cannot be read.
pub fn is_needed(paths: &Paths, figures: &[Figure], sources: &Sources) -> Result<bool, Failure> {
    let text = disk::read_text(&paths.build_record())?.unwrap_or_default();
    let recorded: Built = serde_json::from_str(&text).unwrap_or_default();
    Ok(recorded != current(paths, figures, sources) || recorded.binaries.len() != names(figures).count())
}

/// Builds the binaries if needed; cargo's words go to stderr.
///
/// # Errors
/// Unsupported: no cargo, or a font is missing or damaged. Failed: the build fails, or leaves a binary unmade.
pub fn ensure(paths: &Paths, figures: &[Figure], sources: &Sources) -> Result<(), Failure> {
    if !is_needed(paths, figures, sources)? {
        return Ok(());
    }
    check_fonts(paths)?;
    disk::remove(&paths.build_record())?;
    let mut cargo = child::cargo();
    cargo.args(COMMAND.split(' ').skip(1)).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target);
    child::run_shown(&mut cargo).map_err(|failure| match failure {
        Failure::Child(code) => Failure::Failed(format!("{COMMAND}: exit code {code}")),
        other => other,
    })?;
    let built = current(paths, figures, sources);
    if let Some(name) = names(figures).find(|name| !built.binaries.contains_key(*name)) {
        return Err(Failure::Failed(format!("{COMMAND} made no binary {name}")));
    }
    disk::write(&paths.build_record(), json(&built)?.as_bytes())
}

/// Whether the fonts that the pictures embed are there, byte for byte.
///
/// # Errors
/// Unsupported: one is missing or damaged, with its name. Failed: one cannot be read.
pub fn check_fonts(paths: &Paths) -> Result<(), Failure> {
    let files = FONT_SUMS.map(|(name, _)| paths.fonts().join(name));
    for ((file, hash), (_, expected)) in files.iter().zip(hashing::hash_all(&files)?).zip(FONT_SUMS) {
        let problem = match hash {
            None => "no such font".to_owned(),
            Some(hash) if hash != expected => format!("damaged font: its SHA-256 is {hash} in place of {expected}"),
            Some(_) => continue,
        };
        let file = file.display();
        return Err(Failure::Unsupported(format!("{file}: {problem}; {FONTS_REMEDY}")));
    }
    Ok(())
}

fn names(figures: &[Figure]) -> impl Iterator<Item = &str> {
    TOOLS.into_iter().chain(figures.iter().map(|figure| figure.slug.as_str()))
}

fn current(paths: &Paths, figures: &[Figure], sources: &Sources) -> Built {
    let binaries = names(figures).filter_map(|name| Some((name.to_owned(), stamp(&paths.binary(name))?)));
    Built { sources: sources.build(), binaries: binaries.collect() }
}

/// Bytes, and nanoseconds since 1970.
fn stamp(path: &Path) -> Option<(u64, u128)> {
    let data = path.metadata().ok()?;
    let date = data.modified().ok()?.duration_since(UNIX_EPOCH).ok()?;
    Some((data.len(), date.as_nanos()))
}

fn json(built: &Built) -> Result<String, Failure> {
    serde_json::to_string_pretty(built).map_err(Failure::failed)
}
