//! `ci`: what continuous integration runs.

use super::test::{self, step};
use super::{bundle, figures, paper, verify};
use crate::browser;
use crate::bundle::git;
use crate::child;
use crate::cli::{BundleArgs, CiArgs, FiguresArgs, Selection, VerifyArgs};
use crate::failure::Failure;
use crate::paths::{COST, FUZZ, FUZZ_INPUTS, OTHER_MACHINES, Paths};
use crate::pedpy;
use crate::print;
use std::path::PathBuf;
use std::process::Command;

/// The version that is installed where there is none.
const CARGO_DENY: &str = "0.18.9";

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
        deny(paths)?;
        archive(paths)?;
        for inputs in ["--regress", FUZZ_INPUTS] {
            eprintln!("ci: {FUZZ} {inputs}");
            step(FUZZ, Command::new("bash").args([FUZZ, inputs]).current_dir(&paths.root))?;
        }
    }
    Ok(())
}

/// Licences and sources of all crates, and crates that are not allowed; installs the tool below target if it is missing.
fn deny(paths: &Paths) -> Result<(), Failure> {
    let mut program = PathBuf::from("cargo-deny");
    if child::first_line("cargo-deny", &["--version"]).is_none() {
        program = paths.tools().join("bin").join(format!("cargo-deny{}", std::env::consts::EXE_SUFFIX));
    }
    if child::first_line(&program.to_string_lossy(), &["--version"]).is_none() {
        let root = paths.tools();
        let root = root.to_string_lossy();
        cargo(paths, &["install", "--locked", "--version", CARGO_DENY, "--root", &root, "cargo-deny"])?;
    }
    eprintln!("ci: cargo deny");
    let mut command = Command::new(program);
    command.args(["--offline", "check", "licenses", "bans", "sources"]).current_dir(&paths.root);
    step("cargo deny", &mut command)
}

/// The archive, unpacked and tried; only of a commit.
fn archive(paths: &Paths) -> Result<(), Failure> {
    if git::modified(paths).map_or(true, |names| !names.is_empty()) {
        return print::out("skipped: bundle --check: it needs a commit, and no tracked file that differs from it\n");
    }
    eprintln!("ci: figures --all");
    let selection = Selection { all: true, ..Selection::default() };
    figures::run(paths, &FiguresArgs { selection, ..FiguresArgs::default() })?;
    eprintln!("ci: bundle --check");
    bundle::run(paths, &BundleArgs { out: None, check: true })
}

fn cargo(paths: &Paths, arguments: &[&str]) -> Result<(), Failure> {
    let name = format!("cargo {}", arguments.join(" "));
    eprintln!("ci: {name}");
    step(&name, child::cargo().args(arguments).current_dir(&paths.root).env("CARGO_TARGET_DIR", &paths.target))
}
