//! The binaries as a user meets them: sums, redrawing, exit codes, what is left behind.

mod failures;
mod pictures;
mod resume;
mod sums;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Runs a binary of this package from the root.
pub fn run(binary: &str, arguments: &[&str]) -> Output {
    let simulate = Path::new(env!("CARGO_BIN_EXE_simulate"));
    let program = simulate.with_file_name(format!("{binary}{}", std::env::consts::EXE_SUFFIX));
    Command::new(program).args(arguments).current_dir(root()).output().expect("the binary starts")
}

/// Runs a binary that must succeed.
pub fn succeed(binary: &str, arguments: &[&str]) {
    let output = run(binary, arguments);
    assert!(output.status.success(), "{binary} {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
}
