//! Verbs whose arguments another program reads: builds the program and starts it with them.

use crate::cli::ForwardArgs;
use crate::compile::{self, FIGURES, PLANES};
use crate::lock::Lock;
use crate::sources::SourceHashes;
use checkout::failure::Failure;
use checkout::paths::Paths;
use checkout::process;
use std::process::Command;

/// `simulate` and `map`; paths among the arguments are relative to the current folder. The lock is held only while
/// building, so that a user's run does not block others.
///
/// # Errors
/// The program cannot be built; or its own exit code.
pub fn scene(paths: &Paths, name: &str, arguments: &ForwardArgs) -> Result<(), Failure> {
    {
        let _lock = Lock::take(paths)?;
        compile::tools(paths, FIGURES)?;
    }
    process::run_shown(Command::new(paths.binary(name)).args(&arguments.arguments))
}

/// `sweep`: as [`scene`], with the hash of what determines its numbers, which is the same wherever it was built.
///
/// # Errors
/// As [`scene`].
pub fn sweep(paths: &Paths, arguments: &ForwardArgs) -> Result<(), Failure> {
    let program = {
        let _lock = Lock::take(paths)?;
        compile::tools(paths, PLANES)?;
        SourceHashes::read(paths)?.sweep()
    };
    let mut command = Command::new(paths.binary("sweep"));
    process::run_shown(command.args(&arguments.arguments).arg(format!("--program={program}")))
}

/// `export`: SQLite is compiled for it, so it is built by this verb alone.
///
/// # Errors
/// As [`scene`].
pub fn export(paths: &Paths, arguments: &ForwardArgs) -> Result<(), Failure> {
    let mut export = {
        let _lock = Lock::take(paths)?;
        compile::tools(paths, FIGURES)?;
        compile::program(paths, "interchange", "export")?
    };
    process::run_shown(export.args(&arguments.arguments))
}

/// `bench`, under the lock: nothing of ours runs beside what is measured.
///
/// # Errors
/// As [`scene`].
pub fn bench(paths: &Paths, arguments: &ForwardArgs) -> Result<(), Failure> {
    let _lock = Lock::take(paths)?;
    process::run_shown(compile::program(paths, "measure", "measure")?.args(&arguments.arguments))
}
