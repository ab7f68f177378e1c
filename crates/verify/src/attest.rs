//! Attestations of bits (`data/attestations.jsonl`): one line of JSON for each machine and result. A line contains no
//! host name, user name, path or time.

use checkout::disk;
use checkout::failure::Failure;
use checkout::hashing;
use checkout::machine;
use checkout::paths::{ATTESTATIONS, Paths};
use checkout::sums::Sums;
use serde::{Deserialize, Serialize};
use std::env::consts;

/// A machine and its result.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Attestation {
    /// The form of the line.
    pub schema_version: u32,
    /// `x86_64`.
    pub architecture: String,
    /// The processor's model.
    pub processor: String,
    /// Instructions it has, of those on which a choice depends: `avx2`.
    pub features: Vec<String>,
    /// The operating system and its version.
    pub system: String,
    /// The compiler, its version and target.
    pub rustc: String,
    /// Processors that may be used.
    pub processors: usize,
    /// The number of programs run in parallel.
    pub jobs: usize,
    /// SHA-256 over the list of sums of the paper's figures, as they were made.
    pub sums: String,
    /// The verdict, as `verify --json` has it.
    pub verdict: String,
}

/// The form of a line.
const SCHEMA_VERSION: u32 = 1;

impl Attestation {
    /// Of this machine.
    pub fn here(jobs: usize, sums: &str, verdict: &str) -> Attestation {
        let features = machine::features().into_iter().filter(|(_, has)| *has).map(|(name, _)| name.to_owned());
        Attestation {
            schema_version: SCHEMA_VERSION,
            architecture: consts::ARCH.to_owned(),
            processor: machine::processor(),
            features: features.collect(),
            system: machine::system_name(),
            rustc: machine::rustc_brief(),
            processors: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            jobs,
            sums: sums.to_owned(),
            verdict: verdict.to_owned(),
        }
    }
}

/// Every line; none when there is no file.
///
/// # Errors
/// Usage: a line is malformed, with its number.
pub fn read(paths: &Paths) -> Result<Vec<Attestation>, Failure> {
    let text = disk::read_text(&paths.root.join(ATTESTATIONS))?.unwrap_or_default();
    let line = |(index, line): (usize, &str)| {
        serde_json::from_str(line).map_err(|error| Failure::Usage(format!("{ATTESTATIONS}:{}: {error}", index + 1)))
    };
    text.lines().enumerate().map(line).collect()
}

/// Every line, and whether it has the bits that are committed: for pages and documents that show who got the same.
///
/// # Errors
/// As [`read`]; or the list of sums cannot be read.
pub fn compared(paths: &Paths) -> Result<Vec<(Attestation, bool)>, Failure> {
    let name = paths.sums(false);
    let committed = Sums::read(&paths.root.join(name), name)?.unwrap_or_default();
    let digest = hashing::digest(&committed.by_name);
    let same = |one: Attestation| {
        let same = one.sums == digest;
        (one, same)
    };
    Ok(read(paths)?.into_iter().map(same).collect())
}

/// Appends a line unless it already exists; returns whether it did.
///
/// # Errors
/// The file is malformed, or cannot be read or written.
pub fn append(paths: &Paths, attestation: &Attestation) -> Result<bool, Failure> {
    if read(paths)?.contains(attestation) {
        return Ok(false);
    }
    let path = paths.root.join(ATTESTATIONS);
    let old = disk::read_text(&path)?.unwrap_or_default();
    let line = serde_json::to_string(attestation).map_err(Failure::failed)?;
    disk::write(&path, format!("{old}{line}\n").as_bytes())?;
    Ok(true)
}
