//! The programs as a user meets them: sums, redrawing, exit codes, files left behind.

mod failures;
mod formulas;
mod pictures;
mod resume;
mod sums;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A binary of this package.
pub fn binary(name: &str) -> PathBuf {
    Path::new(env!("CARGO_BIN_EXE_simulate")).with_file_name(format!("{name}{}", std::env::consts::EXE_SUFFIX))
}

/// Runs a binary of this package from the root.
pub fn run(binary: &str, arguments: &[&str]) -> Output {
    Command::new(self::binary(binary)).args(arguments).current_dir(root()).output().expect("the binary starts")
}

/// Runs a binary that must succeed.
pub fn succeed(binary: &str, arguments: &[&str]) {
    let output = run(binary, arguments);
    assert!(output.status.success(), "{binary} {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
}
