//! Starts programs that share the terminal, and reads single lines from the output of others.

use crate::failure::Failure;
use std::io::ErrorKind;
use std::path::Path;
use std::process::{Command, Stdio};

/// Runs a program that shares our stdout and stderr.
///
/// # Errors
/// It cannot be started; or it failed and has reported why.
pub fn run_shown(command: &mut Command) -> Result<(), Failure> {
    let name = command.get_program().to_string_lossy().into_owned();
    let status = command.status().map_err(|error| not_started(&name, &error))?;
    match status.code() {
        Some(0) => Ok(()),
        Some(code) => Err(Failure::Child(code)),
        None => Err(Failure::Failed(format!("{name}: {status}"))),
    }
}

/// Cargo, as cargo named itself to us.
pub fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// The first line that a program prints, or `None` when it cannot be run or ends badly.
pub fn first_line(program: &str, arguments: &[&str]) -> Option<String> {
    let bytes = output(Command::new(program).args(arguments))?;
    Some(String::from_utf8_lossy(&bytes).lines().next().unwrap_or("").trim().to_owned())
}

/// As [`first_line`], in another folder.
pub fn first_line_in(folder: &Path, program: &str, arguments: &[&str]) -> Option<String> {
    let bytes = output(Command::new(program).args(arguments).current_dir(folder))?;
    String::from_utf8_lossy(&bytes).lines().next().map(|line| line.trim().to_owned())
}

/// What a program prints, or `None` when it cannot be run or ends badly.
pub fn output(command: &mut Command) -> Option<Vec<u8>> {
    let output = command.stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    output.status.success().then_some(output.stdout)
}

/// The failure of a program that could not be started.
pub fn not_started(name: &str, error: &std::io::Error) -> Failure {
    let text = format!("{name}: {error}");
    match error.kind() {
        ErrorKind::NotFound => Failure::Unsupported(text),
        _ => Failure::Failed(text),
    }
}
