//! Building the binaries, only when their sources have changed.

use crate::child;
use crate::disk;
use crate::failure::Failure;
use crate::figure::Figure;
use crate::hashing;
use crate::paths::{FONT_SUMS, FONTS_REMEDY, Paths};
use crate::sources::{Inputs, Sources};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

/// Binaries beside those of the figures.
pub const TOOLS: [&str; 5] = ["simulate", "map", "precision", "hard", "studies"];

/// What was built: the hashes of the sources, and size and date of each binary, so that one that was built by hand since
/// then is not taken for ours.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
struct Built {
    sources: Inputs,
    binaries: BTreeMap<String, (u64, u128)>,
}

/// The command that builds the binaries, as a user would type it.
pub const COMMAND: &str = "cargo build --release --locked -p figures";

/// Removes what is built of our own sources.
const CLEAN: &str =
    "clean --quiet --release --locked -p math -p ode -p jam -p files -p scene -p plot -p reference -p figures";

/// Whether the binaries are older than their sources, or missing.
///
/// # Errors
/// The record of the last build cannot be read.
pub fn is_needed(paths: &Paths, figures: &[Figure], sources: &Sources) -> Result<bool, Failure> {
    let recorded = recorded(paths);
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
    forget_newer(paths, figures, &recorded(paths).sources, sources)?;
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
    disk::write_own(&paths.build_record(), json(&built)?.as_bytes())
}

fn recorded(paths: &Paths) -> Built {
    serde_json::from_str(&disk::read_own(&paths.build_record())).unwrap_or_default()
}

/// Cargo compares dates. A source that has changed since the last build and yet is older than what was built then (the
/// clock was set back, or an archive has kept its dates) would leave the binary as it was: then what was built goes.
fn forget_newer(paths: &Paths, figures: &[Figure], built_from: &Inputs, sources: &Sources) -> Result<(), Failure> {
    let newest = names(figures).filter_map(|name| date(&paths.binary(name))).max();
    let changed = |(name, hash): &(&String, &String)| built_from.get(*name) != Some(*hash);
    let mut changed = sources.files.iter().filter(|_| !built_from.is_empty()).filter(changed);
    if !changed.any(|(name, _)| date(&paths.root.join(name)) <= newest) {
        return Ok(());
    }
    let mut cargo = child::cargo();
    cargo.args(CLEAN.split(' ')).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target);
    child::run_shown(&mut cargo).map_err(|_| Failure::Failed(format!("cargo {CLEAN} failed")))
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
    Built { sources: sources.files.clone(), binaries: binaries.collect() }
}

/// Bytes, and nanoseconds since 1970.
fn stamp(path: &Path) -> Option<(u64, u128)> {
    let date = date(path)?.duration_since(UNIX_EPOCH).ok()?;
    Some((path.metadata().ok()?.len(), date.as_nanos()))
}

fn date(path: &Path) -> Option<SystemTime> {
    path.metadata().and_then(|data| data.modified()).ok()
}

fn json(built: &Built) -> Result<String, Failure> {
    serde_json::to_string_pretty(built).map_err(Failure::failed)
}
