//! `verify`: recomputes into a scratch folder and judges against what is committed, on four levels.

use super::figures::read_times;
use crate::attest::{self, Attestation};
use crate::cli::VerifyArgs;
use crate::compile;
use crate::costs::{self, Cost, Costs};
use crate::disk;
use crate::failure::Failure;
use crate::figure::{self, Figure};
use crate::hashing;
use crate::judging::findings::Findings;
use crate::judging::reference::Reference;
use crate::judging::{self, page};
use crate::ledger;
use crate::lock::Lock;
use crate::outputs::Hashes;
use crate::paths::{ATTESTATIONS, Paths, TOLERANCES};
use crate::plan::{self, Node, Wish};
use crate::print;
use crate::progress::duration;
use crate::record::{self, Records, Survey};
use crate::sources::Sources;
use crate::work::{self, Made};
use std::collections::BTreeSet;

/// Runs the verb.
///
/// # Errors
/// Differs: something is not as committed (with `--tolerant`: is not within tolerance), or nothing is committed.
/// Otherwise what kept a figure from being made.
pub fn run(paths: &Paths, arguments: &VerifyArgs) -> Result<(), Failure> {
    let all = figure::discover(paths)?;
    let mut selected = choose(paths, &all, arguments)?;
    let mut reference = Reference::read(paths)?;
    refuse_without_sums(paths, &selected, &reference)?;
    let _lock = Lock::take(paths)?;
    work::sweep(paths, &all)?;
    let sources = Sources::read(paths)?;
    compile::ensure(paths, &all, &sources)?;
    reference.name_runs(paths, &all, &sources);
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
    let whole = arguments.selection.ids.is_empty() && left_out.is_empty();
    let listed = figure::select(&all, &[], arguments.selection.all)?;
    let findings = Findings {
        strays: if whole { reference.strays(paths, &listed) } else { Vec::new() },
        left_out,
        ..judge(paths, &scratch, &surveys, &reference, whole)?
    };
    show(&findings, arguments.json)?;
    keep(paths, arguments, &findings)?;
    conclude(&findings, arguments, &scratch)
}

/// The figures meant; without one those of the paper and the supplements that the ledger reads.
fn choose<'a>(paths: &Paths, all: &'a [Figure], arguments: &VerifyArgs) -> Result<Vec<&'a Figure>, Failure> {
    let read = ledger::figures(paths)?;
    let selected = figure::select(all, &arguments.selection.ids, arguments.selection.all)?;
    if !arguments.selection.ids.is_empty() {
        return Ok(selected);
    }
    // a figure that the ledger names and that does not exist is told, with the claim, when the claim is judged
    let read = read.into_iter().filter(|id| all.iter().any(|figure| figure.id == *id));
    let ids: Vec<String> = selected.iter().map(|figure| figure.id.clone()).chain(read).collect();
    figure::select(all, &ids, false)
}

fn refuse_without_sums(paths: &Paths, selected: &[&Figure], reference: &Reference) -> Result<(), Failure> {
    match selected.iter().find(|figure| reference.sums.list(figure.is_supplement()).is_none()) {
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
    sources: &Sources,
    arguments: &VerifyArgs,
    budget: f64,
) -> Result<Vec<(String, f64)>, Failure> {
    let surveys = record::survey(scratch, selected, sources, &Records::default())?;
    let known = (&read_times(paths)?, &costs::read(paths)?);
    let choice = costs::choose(scratch, &surveys, known, arguments.effort.threads(), budget)?;
    let (count, seconds) = (choice.fits.len(), duration(choice.seconds));
    eprintln!("{count} of {} figures fit, about {seconds} by earlier runs", surveys.len());
    selected.retain(|figure| choice.fits.iter().any(|fits| fits.slug == figure.slug));
    Ok(choice.left_out.into_iter().map(|(figure, seconds)| (figure.id.clone(), seconds)).collect())
}

/// Makes everything that the figures need in the scratch folder.
fn recompute<'a>(
    paths: &Paths,
    scratch: &Paths,
    selected: &[&'a Figure],
    sources: &Sources,
    arguments: &VerifyArgs,
) -> Result<Vec<Survey<'a>>, Failure> {
    let surveys = record::survey(scratch, selected, sources, &Records::default())?;
    let wishes = vec![Wish { draw: true, measure: false }; surveys.len()];
    let nodes = plan::make(scratch, &surveys, &wishes, true)?;
    let threads = if arguments.costs { 1 } else { arguments.effort.threads() };
    let mut measured = Costs::new();
    let mut made = |node: &Node, made: &Made| {
        measured.extend(Cost::of(made).map(|cost| (node.name.clone(), cost)));
        Ok(())
    };
    let outcomes = work::carry_out(scratch, &surveys, &nodes, threads, arguments.effort.keep_going, &mut made)?;
    work::verdict(&nodes, &outcomes)?;
    if arguments.costs {
        costs::write(paths, &measured)?;
    }
    record::survey(scratch, selected, sources, &Records::default())
}

fn judge(
    paths: &Paths,
    scratch: &Paths,
    surveys: &[Survey<'_>],
    reference: &Reference,
    whole: bool,
) -> Result<Findings, Failure> {
    let differences = paths.differences();
    disk::remove(&differences)?;
    let judge = |survey: &Survey<'_>| judging::judge(paths, scratch, survey, reference, Some(&differences));
    let ids: BTreeSet<&str> = surveys.iter().map(|survey| &*survey.figure.id).collect();
    let made: Hashes =
        surveys.iter().filter(|one| !one.figure.is_supplement()).flat_map(|one| one.outputs.clone()).collect();
    Ok(Findings {
        figures: surveys.iter().map(judge).collect::<Result<_, _>>()?,
        claims: ledger::judge(paths, scratch, (!whole).then_some(&ids))?,
        sums: hashing::digest(&made),
        ..Findings::default()
    })
}

fn show(findings: &Findings, as_json: bool) -> Result<(), Failure> {
    match as_json {
        true => print::json(findings.to_json()),
        false => print::out(&findings.to_text()),
    }
}

/// Writes what was asked for: a line of attestation, a page.
fn keep(paths: &Paths, arguments: &VerifyArgs, findings: &Findings) -> Result<(), Failure> {
    if arguments.attest {
        let verdict = findings.verdict().word();
        let line = Attestation::here(arguments.effort.threads(), &findings.sums, verdict);
        let done = if attest::append(paths, &line)? { "one line more" } else { "this line is there already" };
        eprintln!("{ATTESTATIONS}: {done}");
    }
    match &arguments.report {
        Some(file) => disk::write(file, page::html(findings, &attest::read(paths)?)?.as_bytes()),
        None => Ok(()),
    }
}

fn conclude(findings: &Findings, arguments: &VerifyArgs, scratch: &Paths) -> Result<(), Failure> {
    if findings.are_same() {
        return disk::remove(&scratch.base);
    }
    let mut wrong: Vec<&str> = findings.figures.iter().filter(|one| !one.is_same()).map(|one| &*one.id).collect();
    wrong.extend((!findings.claims.is_same()).then_some("claims"));
    wrong.extend((!findings.strays.is_empty()).then_some("lines that belong to no figure"));
    let place = scratch.base.display();
    let words = format!("not as committed: {}; what was made now lies in {place}", wrong.join(" "));
    if arguments.tolerant && findings.are_within() {
        eprintln!("{words}\nwithin the tolerances of {TOLERANCES}");
        return Ok(());
    }
    Err(Failure::Differs(words))
}
