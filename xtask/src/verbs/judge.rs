//! Builds the judging program when a verb needs it, and passes it what was made.

use crate::compile;
use crate::record::{self, FigureState};
use crate::sources::SourceHashes;
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::paths::Paths;
use checkout::process;
use checkout::request::{Entry, Request};
use std::path::PathBuf;
use std::process::Command;

/// The program.
///
/// # Errors
/// It cannot be built.
pub fn program(paths: &Paths) -> Result<Command, Failure> {
    compile::program(paths, "verify", "verify")
}

/// The program, asked to judge what was made.
///
/// # Errors
/// It cannot be built, or the request cannot be written.
pub fn about_request(paths: &Paths, request: &Request) -> Result<Command, Failure> {
    let mut program = program(paths)?;
    program.arg("judge").arg("--request").arg(self::request(paths, request)?);
    Ok(program)
}

/// Starts it; its words are ours.
///
/// # Errors
/// Its own exit code.
pub fn run(command: &mut Command) -> Result<(), Failure> {
    process::run_shown(command)
}

/// Writes down what was made, for the program.
///
/// # Errors
/// The file cannot be written.
pub fn request(paths: &Paths, request: &Request) -> Result<PathBuf, Failure> {
    let file = paths.xtask().join("request.json");
    disk::write_own(&file, request.to_text()?.as_bytes())?;
    Ok(file)
}

/// A request about these figures; everything else is as without figures picked.
pub fn about(made: &Paths, all: &[Figure], sources: &SourceHashes, surveys: &[FigureState<'_>]) -> Request {
    let entry = |one: &FigureState<'_>| Entry {
        id: one.figure.id.clone(),
        runs: one.runs.clone(),
        outputs: one.outputs.clone(),
    };
    Request {
        base: made.base.clone(),
        scheme: made.scheme,
        figures: surveys.iter().map(entry).collect(),
        scenes: record::scenes(made, all, &sources.numeric()),
        ..Request::default()
    }
}

/// The figures and supplements whose tables the ledger reads.
///
/// # Errors
/// Usage: a file of the ledger is malformed.
pub fn figures_of_the_ledger(paths: &Paths) -> Result<Vec<String>, Failure> {
    let output = program(paths)?.arg("figures").stderr(std::process::Stdio::inherit()).output();
    let output = output.map_err(|error| Failure::Failed(format!("verify figures: {error}")))?;
    match output.status.code() {
        Some(0) => Ok(String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect()),
        code => Err(Failure::Child(code.unwrap_or(4))),
    }
}
