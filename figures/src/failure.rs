//! What a program says: results, words about its work, and failures with their exit codes.

use files::table::TableError;
use std::io::Write as _;
use std::process::ExitCode;

/// Why a binary could not do its work: the message for the user, and the exit code.
#[derive(Debug)]
pub struct Failure {
    /// One clear message: what, where, and what would be valid.
    pub message: String,
    /// 2: bad input; 4: the work itself failed (disk full, integration impossible).
    pub code: u8,
}

impl Failure {
    /// Bad input.
    pub fn input(problem: impl std::fmt::Display) -> Failure {
        Failure { message: problem.to_string(), code: 2 }
    }

    /// The work failed.
    pub fn work(problem: impl std::fmt::Display) -> Failure {
        Failure { message: problem.to_string(), code: 4 }
    }
}

impl From<scene::SceneError> for Failure {
    fn from(error: scene::SceneError) -> Failure {
        Failure::input(error)
    }
}

impl From<String> for Failure {
    fn from(problem: String) -> Failure {
        Failure::input(problem)
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Failure {
        // a pipe, a device or one name twice, where files are to be written
        match error.kind() {
            std::io::ErrorKind::InvalidInput => Failure::input(error),
            _ => Failure::work(error),
        }
    }
}

impl From<TableError> for Failure {
    fn from(error: TableError) -> Failure {
        match error {
            TableError::Io(_) => Failure::work(error),
            TableError::Malformed { .. } | TableError::NoColumn { .. } => Failure::input(error),
        }
    }
}

/// Prints a line to stdout. A reader that has gone away (`| head`) is no failure.
///
/// # Errors
/// stdout cannot be written for another reason.
pub fn print(line: &str) -> Result<(), Failure> {
    match writeln!(std::io::stdout(), "{line}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::work(format!("stdout: {error}"))),
        _ => Ok(()),
    }
}

/// Writes a line to stderr. If there is no reader, as after a kill of the runner, the run continues.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Prints a failure and turns the result into the exit code of the process.
pub fn exit(result: Result<(), Failure>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {}", failure.message);
            ExitCode::from(failure.code)
        }
    }
}
