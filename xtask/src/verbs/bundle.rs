//! `bundle`: one deterministic archive of the commit, everything it needs and everything it makes.

use super::summary::Committed;
use crate::bundle::{self, check, git, tarball};
use crate::cli::BundleArgs;
use crate::failure::Failure;
use crate::figure::{self, Figure};
use crate::lock::Lock;
use crate::paths::{BUNDLE_TOP, Paths};
use crate::print;
use crate::record::{self, Records};
use crate::sources::Sources;
use crate::sums::State;

/// Runs the verb.
///
/// # Errors
/// Differs: a tracked file is modified, or an output is not as committed. Stale: a figure is. Otherwise what kept the
/// archive from being written or checked.
pub fn run(paths: &Paths, arguments: &BundleArgs) -> Result<(), Failure> {
    let archive = arguments.out.clone().unwrap_or_else(|| paths.archive());
    {
        let _lock = Lock::take(paths)?;
        let commit = git::commit(paths)?;
        let modified = git::modified(paths)?;
        if !modified.is_empty() {
            return Err(Failure::Differs(format!("modified, commit first: {}", modified.join(" "))));
        }
        let figures = figure::discover(paths)?;
        refuse_unmade(paths, &figures)?;
        let members = bundle::gather(paths, &figures, &commit)?;
        tarball::write(&archive, BUNDLE_TOP, commit.seconds, &members)?;
        print::out(&format!("{} files of commit {}\n", members.len() + 1, commit.hash))?;
    }
    let hash = files::write::sha256_file(&archive).map_err(Failure::failed)?;
    print::out(&format!("{hash}  {}\n", archive.display()))?;
    if arguments.check { check::run(paths, &archive, BUNDLE_TOP) } else { Ok(()) }
}

/// The archive holds all tables and pictures, also those of supplements, with the committed sums.
fn refuse_unmade(paths: &Paths, figures: &[Figure]) -> Result<(), Failure> {
    let all: Vec<&Figure> = figures.iter().collect();
    let surveys = record::survey(paths, &all, &Sources::read(paths)?, &Records::read(paths)?)?;
    let stale = surveys.iter().filter(|survey| !survey.reasons.is_empty()).map(|survey| survey.figure.id.as_str());
    let stale: Vec<&str> = stale.collect();
    if !stale.is_empty() {
        return Err(Failure::Stale(format!("stale: {}; run cargo xtask figures --all first", stale.join(" "))));
    }
    let committed = Committed::read(paths)?;
    let states = surveys.iter().flat_map(|survey| committed.judge(paths, survey));
    let wrong: Vec<String> = states.filter(|(_, state)| *state != State::Same).map(|(name, _)| name).collect();
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!("not as committed: {}", wrong.join(" ")))),
    }
}
