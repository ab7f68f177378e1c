//! `verify`: recomputes into a scratch folder and has the result compared with what is committed, on four levels.

use super::figures::read_times;
use super::judge;
use crate::cli::VerifyArgs;
use crate::compile::{self, Package};
use crate::costs;
use crate::gate;
use crate::lock::Lock;
use crate::plan::{self, Needs, Node};
use crate::record::{self, FigureState, Records};
use crate::sources::SourceHashes;
use crate::work::{self, NodeOutput};
use checkout::costs::Costs;
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::paths::Paths;
use checkout::print::duration;
use checkout::request::Request;
use checkout::sums::Committed;

/// Runs the verb.
///
/// # Errors
/// Differs: something is not as committed (with `--tolerant`: is not within tolerance), or nothing is committed.
/// Otherwise what kept a figure from being made.
pub fn run(paths: &Paths, arguments: &VerifyArgs) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    // read before the work, so that a malformed list is told at once
    let committed = Committed::read(paths)?;
    figure::select(&all, &arguments.selection.ids, arguments.selection.all)?;
    let _lock = Lock::take(paths)?;
    let mut selected = choose(paths, &all, arguments)?;
    refuse_without_sums(paths, &selected, &committed)?;
    work::sweep(paths, &all)?;
    let sources = SourceHashes::read(paths)?;
    compile::ensure(paths, &all, &sources, &Package::of(&selected))?;
    let scratch = paths.scratch();
    disk::remove(&scratch.base)?;
    let left_out = match arguments.budget {
        Some(budget) => keep_what_fits(paths, &scratch, &mut selected, &sources, arguments, budget)?,
        None => Vec::new(),
    };
    // what a failed figure has left in the scratch folder says nothing; its words are on stderr
    let surveys = recompute(paths, &scratch, &selected, &sources, arguments).inspect_err(|_| {
        let _ = disk::remove(&scratch.base);
    })?;
    let request = Request {
        whole: arguments.selection.ids.is_empty() && left_out.is_empty(),
        all: arguments.selection.all,
        left_out,
        jobs: arguments.effort.threads(),
        ..judge::about(&scratch, &all, &sources, &surveys)
    };
    let mut verify = judge::about_request(paths, &request)?;
    let options = [("--tolerant", arguments.tolerant), ("--attest", arguments.attest), ("--json", arguments.json)];
    verify.args(options.iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name));
    if let Some(file) = &arguments.report {
        verify.arg("--report").arg(file);
    }
    judge::run(&mut verify)?;
    // what differs stays, to be looked at
    disk::remove(&scratch.base)
}

/// Judges these figures and supplements, or all of them if none is named, where `ci` has just made them. The claims
/// that read others are left out.
///
/// # Errors
/// Stale: something is older than what it is made from. Otherwise as [`run`].
pub fn made(paths: &Paths, ids: &[String]) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    let _lock = Lock::take(paths)?;
    let sources = SourceHashes::read(paths)?;
    let selected = figure::select(&all, ids, ids.is_empty())?;
    let surveys = record::survey(paths, &selected, &sources, &Records::read(paths)?)?;
    gate::fresh(&surveys)?;
    let is_whole = selected.len() == all.len();
    let request = Request { whole: is_whole, all: is_whole, jobs: 1, ..judge::about(paths, &all, &sources, &surveys) };
    judge::run(&mut judge::about_request(paths, &request)?)
}

/// The figures meant; without one those of the paper and the supplements that the ledger reads.
fn choose<'a>(paths: &Paths, all: &'a [Figure], arguments: &VerifyArgs) -> Result<Vec<&'a Figure>, Failure> {
    let selected = figure::select(all, &arguments.selection.ids, arguments.selection.all)?;
    if !arguments.selection.ids.is_empty() {
        return Ok(selected);
    }
    // a figure that the ledger names and that does not exist is told, with the claim, when the claim is judged
    let read = judge::figures_of_the_ledger(paths)?.into_iter().filter(|id| all.iter().any(|figure| figure.id == *id));
    let ids: Vec<String> = selected.iter().map(|figure| figure.id.clone()).chain(read).collect();
    figure::select(all, &ids, false)
}

fn refuse_without_sums(paths: &Paths, selected: &[&Figure], committed: &Committed) -> Result<(), Failure> {
    match selected.iter().find(|figure| committed.list(figure.is_supplement()).is_none()) {
        None => Ok(()),
        Some(figure) => {
            let name = paths.sums(figure.is_supplement());
            Err(Failure::Differs(format!("{name} does not exist yet: nothing to verify {} against", figure.id)))
        }
    }
}

/// Takes the figures that do not fit into the budget out of `selected`; they are returned with their seconds.
fn keep_what_fits(
    paths: &Paths,
    scratch: &Paths,
    selected: &mut Vec<&Figure>,
    sources: &SourceHashes,
    arguments: &VerifyArgs,
    budget: f64,
) -> Result<Vec<(String, Option<f64>)>, Failure> {
    let surveys = record::survey(scratch, selected, sources, &Records::default())?;
    let known = (&read_times(paths)?, &checkout::costs::read(paths)?);
    let choice = costs::choose(scratch, &surveys, known, arguments.effort.threads(), budget)?;
    let (count, seconds) = (choice.fits.len(), duration(choice.seconds));
    eprintln!("{count} of {} figures fit, about {seconds} by earlier runs", surveys.len());
    selected.retain(|figure| choice.fits.iter().any(|fits| fits.slug == figure.slug));
    Ok(choice
        .left_out
        .into_iter()
        .map(|(figure, seconds)| (figure.id.clone(), Some(seconds).filter(|one| one.is_finite())))
        .collect())
}

/// Makes everything that the figures need in the scratch folder.
fn recompute<'a>(
    paths: &Paths,
    scratch: &Paths,
    selected: &[&'a Figure],
    sources: &SourceHashes,
    arguments: &VerifyArgs,
) -> Result<Vec<FigureState<'a>>, Failure> {
    let surveys = record::survey(scratch, selected, sources, &Records::default())?;
    let needs = vec![Needs { draw: true, measure: false }; surveys.len()];
    let nodes = plan::make(scratch, &surveys, &needs, true)?;
    let threads = if arguments.costs { 1 } else { arguments.effort.threads() };
    let mut measured = Costs::new();
    let mut made = |node: &Node, made: &NodeOutput| {
        measured.insert(node.name.clone(), costs::of(made.usage, made.bytes));
        Ok(())
    };
    let outcomes = work::carry_out(scratch, &surveys, &nodes, threads, arguments.effort.keep_going, &mut made)?;
    work::verdict(&nodes, &outcomes)?;
    if arguments.costs {
        checkout::costs::write(paths, &measured)?;
    }
    record::survey(scratch, selected, sources, &Records::default())
}
