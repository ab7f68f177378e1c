//! `simulate` and `map`: passed on to the release binary, which reads the arguments.

use crate::child;
use crate::cli::ForwardArgs;
use crate::compile;
use crate::failure::Failure;
use crate::figure;
use crate::lock::Lock;
use crate::paths::Paths;
use crate::sources::Sources;
use std::process::Command;

/// Runs the verb; paths among the arguments are relative to the current folder.
///
/// # Errors
/// The binary cannot be built; or its own exit code.
pub fn run(paths: &Paths, name: &str, arguments: &ForwardArgs) -> Result<(), Failure> {
    build(paths)?;
    child::run_shown(Command::new(paths.binary(name)).args(&arguments.arguments))
}

/// Builds the figures' binaries and tools if needed. The lock is held while building only: a user's run keeps nobody
/// waiting.
///
/// # Errors
/// They cannot be built.
pub fn build(paths: &Paths) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    let _lock = Lock::take(paths)?;
    compile::ensure(paths, &all, &Sources::read(paths)?)
}
