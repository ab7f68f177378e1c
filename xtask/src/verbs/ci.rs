//! `ci`: what continuous integration runs.

use super::test::{self, step};
use super::{figures, paper, verify};
use crate::browser;
use crate::child;
use crate::cli::{CiArgs, FiguresArgs, VerifyArgs};
use crate::failure::Failure;
use crate::paths::{COST, OTHER_MACHINES, Paths};
use crate::pedpy;
use std::process::Command;

/// Runs the verb; stops at the first step that fails.
///
/// # Errors
/// Differs: a step fails.
pub fn run(paths: &Paths, arguments: &CiArgs) -> Result<(), Failure> {
    cargo(paths, &["fmt", "--all", "--check"])?;
    cargo(paths, &["clippy", "--locked", "--workspace", "--all-targets", "--", "-D", "warnings"])?;
    // the tables first: the NumPy checks of `test` read them
    eprintln!("ci: figures");
    figures::run(paths, &FiguresArgs::default())?;
    eprintln!("ci: what the check by PedPy needs");
    pedpy::prepare(paths)?;
    browser::install(paths)?;
    // what it installs, tests of the document find
    eprintln!("ci: paper");
    paper::ci(paths)?;
    eprintln!("ci: test");
    test::run(paths)?;
    eprintln!("ci: verify");
    verify::run(paths, &VerifyArgs::default())?;
    if arguments.full {
        cargo(paths, &["test", "--release", "--locked", "--workspace", "--", "--ignored"])?;
        eprintln!("ci: {OTHER_MACHINES}");
        step(OTHER_MACHINES, Command::new("bash").arg(OTHER_MACHINES).current_dir(&paths.root))?;
        eprintln!("ci: {COST}");
        let mut cost = Command::new("bash");
        step(COST, cost.arg(COST).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target))?;
    }
    Ok(())
}

fn cargo(paths: &Paths, arguments: &[&str]) -> Result<(), Failure> {
    let name = format!("cargo {}", arguments.join(" "));
    eprintln!("ci: {name}");
    step(&name, child::cargo().args(arguments).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target))
}
