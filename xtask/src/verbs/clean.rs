//! `clean`: removes what can be made again; committed files stay.

use crate::lock::Lock;
use crate::work;
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure;
use checkout::paths::{DOCUMENT_PDF, PICTURE_PDFS, Paths, Scheme};
use checkout::print;
use std::path::PathBuf;

/// Runs the verb: stored runs, the runner's own records (not its lock), scratch folders, tables of both schemes,
/// what a run that was broken off has left.
///
/// # Errors
/// Something cannot be removed.
pub fn run(paths: &Paths) -> Result<(), Failure> {
    let _lock = Lock::take(paths)?;
    let mut doomed: Vec<PathBuf> = vec![paths.store()];
    let own = disk::names(&paths.xtask())?.into_iter().map(|name| paths.xtask().join(name));
    doomed.extend(own.filter(|path| *path != paths.lock()));
    let scratch = disk::names(&paths.target)?.into_iter().filter(|name| Paths::is_scratch(name));
    doomed.extend(scratch.map(|name| paths.target.join(name)));
    let all = figure::discover(paths)?;
    for figure in &all {
        for scheme in [Scheme::Adaptive, Scheme::Paper] {
            doomed.push(paths.output(&paths.with_scheme(scheme).tables(&figure.id)));
        }
    }
    doomed.extend([paths.root.join(DOCUMENT_PDF), paths.root.join(PICTURE_PDFS)]);
    doomed.extend(work::leftovers(paths, &all)?);
    for path in doomed.iter().filter(|path| path.exists()) {
        disk::remove(path)?;
        print::out(&format!("removed {}\n", path.display()))?;
    }
    Ok(())
}
