//! `bless`: has new sums and samples accepted once it has checked that they come from committed sources.

use super::judge;
use crate::cli::BlessArgs;
use crate::gate;
use crate::lock::Lock;
use crate::record::{self, Records};
use crate::sources::SourceHashes;
use checkout::failure::Failure;
use checkout::figure;
use checkout::paths::{Paths, Scheme};
use checkout::request::Request;

/// Runs the verb. Nothing is written unless everything can be accepted.
///
/// # Errors
/// Stale: a figure is. Differs: a tracked file other than an output is modified, or numbers moved or a claim got
/// another verdict and `--numbers` was not given.
pub fn run(paths: &Paths, arguments: &BlessArgs) -> Result<(), Failure> {
    let paths = &paths.with_scheme(arguments.scheme);
    let all = figure::discover(paths)?;
    let mut selected = figure::select(&all, &arguments.selection.ids, arguments.selection.all)?;
    selected.retain(|figure| paths.scheme == Scheme::Adaptive || figure.runs().next().is_some());
    let _lock = Lock::take(paths)?;
    refuse_modified(paths)?;
    let sources = SourceHashes::read(paths)?;
    let surveys = record::survey(paths, &selected, &sources, &Records::read(paths)?)?;
    gate::fresh(&surveys)?;
    let whole = arguments.selection.ids.is_empty();
    let request = Request { whole, ..judge::about(paths, &all, &sources, &surveys) };
    let mut verify = judge::program(paths)?;
    verify.arg("bless").arg("--request").arg(judge::request(paths, &request)?);
    judge::run(verify.args(arguments.numbers.then_some("--numbers")))
}

/// Sums must belong to sources that can be retrieved: tracked files other than outputs must be as committed.
fn refuse_modified(paths: &Paths) -> Result<(), Failure> {
    let Some(mut names) = gate::modified(paths)? else {
        eprintln!("no git repository: nothing says whether the sources are as committed");
        return Ok(());
    };
    names.retain(|name| !Paths::is_output(name));
    match names.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!("modified, commit first: {}", names.join(" ")))),
    }
}
