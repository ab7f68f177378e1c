//! Tests of the accuracy tables and of the evidence for claims.

mod evidence;
mod hard;
mod precision;
mod studies;

use std::path::{Path, PathBuf};
use std::process::Command;

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs a binary of this package, which must succeed, from the root.
pub fn succeed(binary: &str, arguments: &[&str]) {
    let hard = Path::new(env!("CARGO_BIN_EXE_hard"));
    let program = hard.with_file_name(format!("{binary}{}", std::env::consts::EXE_SUFFIX));
    let output = Command::new(program).args(arguments).current_dir(root()).output().expect("the binary starts");
    assert!(output.status.success(), "{binary} {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
}
