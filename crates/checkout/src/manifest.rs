//! The manifest: provenance and error of each output. It contains neither a time nor a commit.

use crate::disk;
use crate::failure::Failure;
use crate::paths::Paths;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// Errors above this part of the data range are flagged: at a hundred million parts nothing shows in a picture, but a
/// method that works stays far below.
pub const FLAGGED_ABOVE: f64 = 1e-8;

/// The form of the file.
const SCHEMA_VERSION: u32 = 1;

/// One output.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Entry {
    /// Hash of the file.
    pub sha256: String,
    /// Its size.
    pub bytes: u64,
    /// The program that wrote it.
    pub binary: String,
    /// Hash of the sources of that program.
    pub sources: String,
    /// Hash of the lock file's entries for the crates from which the program is built.
    pub lock: String,
    /// Hash of the scene file.
    pub scene: String,
    /// Key of the run it was read from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<String>,
    /// Method, tolerance (or step) and counts of that run (or the method that the figure's binary names).
    #[serde(flatten)]
    pub counts: BTreeMap<String, Value>,
    /// Error estimate of each column as a part of its drawn range; `null` without one.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub error: BTreeMap<String, Option<f64>>,
    /// Rows that only the run or only its check has.
    #[serde(skip_serializing_if = "is_zero")]
    pub unmatched_rows: usize,
    /// Whether an error is above [`FLAGGED_ABOVE`] or unknown.
    #[serde(skip_serializing_if = "is_false")]
    pub flagged: bool,
}

/// The whole file.
#[derive(Debug, Serialize, Deserialize)]
struct Manifest {
    schema_version: u32,
    outputs: BTreeMap<String, Entry>,
}

/// The entries of the manifest that is there; none when there is no file.
///
/// # Errors
/// Usage: the file cannot be read, or is not what [`write`] writes: what it says of figures not measured now would be
/// lost.
pub fn read(paths: &Paths) -> Result<BTreeMap<String, Entry>, Failure> {
    let path = paths.manifest();
    let bad = |problem: &str| {
        // an error of the operating system has the path in it
        let name = format!("{}: ", path.display());
        let problem = problem.strip_prefix(&name).unwrap_or(problem);
        Failure::Usage(format!("{name}{problem}; restore it (git restore), or delete it and run cargo xtask figures"))
    };
    let Some(text) = disk::read_text(&path).map_err(|failure| bad(failure.text()))? else {
        return Ok(BTreeMap::new());
    };
    parse(&text).map_err(|problem| bad(&problem))
}

/// The entries of a manifest's text.
///
/// # Errors
/// What is wrong with it.
pub fn parse(text: &str) -> Result<BTreeMap<String, Entry>, String> {
    let manifest: Manifest = serde_json::from_str(text).map_err(|error| error.to_string())?;
    match manifest.schema_version {
        SCHEMA_VERSION => Ok(manifest.outputs),
        other => Err(format!("expected schema_version {SCHEMA_VERSION}, found {other}")),
    }
}

/// The text of a manifest with these entries.
///
/// # Errors
/// Failed: a number that JSON cannot hold.
pub fn to_text(outputs: BTreeMap<String, Entry>) -> Result<String, Failure> {
    let manifest = Manifest { schema_version: SCHEMA_VERSION, outputs };
    let mut text = serde_json::to_string_pretty(&manifest).map_err(Failure::failed)?;
    text.push('\n');
    Ok(text)
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

fn is_false(flag: &bool) -> bool {
    !flag
}
