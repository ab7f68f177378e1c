//! `paper`, `report` and `bundle`: once the figures are found to be the committed ones, another program writes the
//! document.

use crate::cli::{BundleArgs, PaperArgs, ReportArgs};
use crate::compile;
use crate::gate;
use crate::lock::Lock;
use crate::module;
use checkout::failure::Failure;
use checkout::figure;
use checkout::paths::Paths;
use checkout::process;
use std::process::Command;

/// The check of the archive.
const BUNDLE_CHECK: &str = "checks/bundle/check.sh";

fn program(paths: &Paths) -> Result<Command, Failure> {
    compile::program(paths, "publish", "publish")
}

/// `paper`.
///
/// # Errors
/// Stale, Differs: the figures do not verify. Otherwise what the program says.
pub fn paper(paths: &Paths, arguments: &PaperArgs) -> Result<(), Failure> {
    let _lock = Lock::take(paths)?;
    gate::figures_verify(paths, &figure::discover(paths)?)?;
    process::run_shown(program(paths)?.arg("article").args(arguments.bless.then_some("--bless")))
}

/// `report`.
///
/// # Errors
/// As [`paper`].
pub fn report(paths: &Paths, arguments: &ReportArgs) -> Result<(), Failure> {
    let _lock = Lock::take(paths)?;
    gate::figures_verify(paths, &figure::discover(paths)?)?;
    let mut page = program(paths)?;
    page.arg("page").args(arguments.check.then_some("--check"));
    if let Some(file) = module::build(paths)? {
        page.arg("--module").arg(file);
    }
    if let Some(file) = &arguments.out {
        page.arg("--out").arg(file);
    }
    process::run_shown(&mut page)
}

/// `bundle`.
///
/// # Errors
/// Stale: a figure or supplement is. Differs: an output is not as committed. Otherwise what the program says.
pub fn bundle(paths: &Paths, arguments: &BundleArgs) -> Result<(), Failure> {
    let archive = arguments.out.clone().unwrap_or_else(|| paths.archive());
    {
        let _lock = Lock::take(paths)?;
        let modified = gate::modified(paths)?.unwrap_or_default();
        if !modified.is_empty() {
            return Err(Failure::Differs(format!("modified, commit first: {}", modified.join(" "))));
        }
        gate::everything_verifies(paths, &figure::discover(paths)?)?;
        process::run_shown(program(paths)?.arg("bundle").arg("--out").arg(&archive))?;
    }
    match arguments.check {
        true => super::checks::step(Command::new("bash").arg(BUNDLE_CHECK).arg(archive).current_dir(&paths.root)),
        false => Ok(()),
    }
}
