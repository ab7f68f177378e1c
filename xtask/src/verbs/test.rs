//! `test`: the tests that Rust alone can run; what needs more is skipped aloud.

use super::doctor;
use crate::browser;
use crate::child;
use crate::failure::Failure;
use crate::paths::{COST, FUZZ, OTHER_MACHINES, Paths, SPOT_CHECK};
use crate::pedpy;
use crate::print;
use crate::sums::Sums;
use crate::typeset;
use std::process::Command;

/// Runs the verb.
///
/// # Errors
/// Differs: a test fails.
pub fn run(paths: &Paths) -> Result<(), Failure> {
    let mut cargo = child::cargo();
    cargo.args(["test", "--release", "--locked", "--workspace"]).current_dir(&paths.root);
    step("cargo test", cargo.env("CARGO_TARGET_DIR", &paths.target))?;
    spot_check(paths)?;
    pedpy::check(paths)?;
    browser::test(paths)?;
    if typeset::at_hand(paths).is_none() {
        print::out("skipped: setting the report: no typst; cargo xtask paper installs it\n")?;
    }
    print::out(&format!("skipped: other machines ({OTHER_MACHINES}): cargo xtask ci --full\n"))?;
    print::out(&format!("skipped: instruction counts ({COST}): cargo xtask ci --full\n"))?;
    print::out(&format!("skipped: fuzzing beyond the kept inputs ({FUZZ}): cargo xtask ci --full\n"))
}

/// Runs one step of a list; its words go to our stdout and stderr.
///
/// # Errors
/// Differs: it fails. Unsupported: the program is missing.
pub fn step(name: &str, command: &mut Command) -> Result<(), Failure> {
    child::run_shown(command).map_err(|failure| match failure {
        Failure::Child(code) => Failure::Differs(format!("{name} failed (exit code {code})")),
        other => other,
    })
}

/// Values computed by NumPy, by other code than ours.
fn spot_check(paths: &Paths) -> Result<(), Failure> {
    if !paths.root.join(SPOT_CHECK).is_file() {
        return print::out(&format!("skipped: NumPy spot checks: there is no {SPOT_CHECK}\n"));
    }
    let tables = Sums::read(&paths.root.join(paths.sums(false)), paths.sums(false))?;
    let is_missing = |name: &String| name.ends_with(".csv") && !paths.root.join(name).is_file();
    if tables.is_none_or(|sums| sums.by_name.keys().any(is_missing)) {
        return print::out("skipped: NumPy spot checks: tables are missing; cargo xtask figures makes them\n");
    }
    // the environment of PedPy has it too
    let mut python = match (doctor::numpy(), pedpy::python(paths)?) {
        (Some(_), _) => Command::new("python3"),
        (None, Some(python)) => python.command(),
        (None, None) => {
            let why = "python3 with numpy not found; cargo xtask ci installs it below the target folder";
            return print::out(&format!("skipped: NumPy spot checks: {why}\n"));
        }
    };
    step(SPOT_CHECK, python.arg(SPOT_CHECK).current_dir(&paths.root))
}
