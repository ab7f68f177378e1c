//! `bless`: accepts new sums and samples after showing what changes, and which claims get another verdict.

use super::summary::Committed;
use crate::cli::BlessArgs;
use crate::disk;
use crate::failure::Failure;
use crate::figure;
use crate::golden;
use crate::judging::reference::Reference;
use crate::judging::{self, states, words};
use crate::ledger;
use crate::lock::Lock;
use crate::outputs;
use crate::paths::{LEDGER_SOURCES, Paths, Scheme};
use crate::print;
use crate::record::{self, Records, Survey};
use crate::sources::Sources;
use crate::sums::{State, Sums};
use std::io::ErrorKind;
use std::process::Command;

/// What changes for one figure.
struct Change {
    /// Lines that say so.
    lines: Vec<String>,
    /// Whether a table is other than the committed one.
    numbers_moved: bool,
}

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
    let sources = Sources::read(paths)?;
    let surveys = record::survey(paths, &selected, &sources, &Records::read(paths)?)?;
    refuse_stale(&surveys)?;
    let reference = Reference::of_last_commit(paths, &all, &sources)?;
    let mut moved = Vec::new();
    for survey in &surveys {
        let change = change(paths, survey, &reference)?;
        print::out(&change.lines.concat())?;
        if change.numbers_moved {
            moved.push(survey.figure.id.as_str());
        }
    }
    let changed = changed_verdicts(paths)?;
    print::out(&changed.concat())?;
    if !changed.is_empty() && !arguments.numbers {
        let problem =
            "claims are not as recorded; nothing written (--numbers accepts the numbers, the verdicts stand in";
        return Err(Failure::Differs(format!("{problem} {})", LEDGER_SOURCES.join(", "))));
    }
    if !moved.is_empty() && !arguments.numbers {
        let moved = moved.join(" ");
        return Err(Failure::Differs(format!("numbers moved: {moved}; nothing written (--numbers accepts them)")));
    }
    // a list without figures that no longer exist, when all of them were asked for
    let whole = arguments.selection.ids.is_empty();
    for supplement in [false, true] {
        write_sums(paths, &surveys, &reference.sums, supplement, whole)?;
    }
    print::out(&format!("{} figures accepted\n", surveys.len()))?;
    if paths.scheme == Scheme::Paper {
        return Ok(());
    }
    surveys.iter().try_for_each(|survey| write_samples(paths, survey, &reference))?;
    if ledger::is_complete(paths)? {
        ledger::write(paths)?;
    }
    Ok(())
}

/// What the tables that are there now say of the claims, where it is not what is recorded; nothing while tables are
/// missing.
fn changed_verdicts(paths: &Paths) -> Result<Vec<String>, Failure> {
    if paths.scheme == Scheme::Paper || !ledger::is_complete(paths)? {
        return Ok(Vec::new());
    }
    let lines = ledger::judge(paths, paths, None)?.differences();
    Ok(lines.into_iter().map(|line| line + "\n").collect())
}

fn refuse_stale(surveys: &[Survey<'_>]) -> Result<(), Failure> {
    let stale: Vec<&str> =
        surveys.iter().filter(|survey| !survey.reasons.is_empty()).map(|survey| &*survey.figure.id).collect();
    match stale.is_empty() {
        true => Ok(()),
        false => Err(Failure::Stale(format!("stale: {}; run cargo xtask figures first", stale.join(" ")))),
    }
}

/// Sums stand for sources that anyone can get back: tracked files that are no outputs must be as committed.
fn refuse_modified(paths: &Paths) -> Result<(), Failure> {
    let mut git = Command::new("git");
    git.arg("-C").arg(&paths.root).args(["status", "--porcelain", "-z", "--untracked-files=no", "--no-renames"]);
    let output = match git.output() {
        Ok(output) if output.status.success() => output,
        Ok(_) => return note_no_repository(),
        Err(error) if error.kind() == ErrorKind::NotFound => return note_no_repository(),
        Err(error) => return Err(Failure::Failed(format!("git: {error}"))),
    };
    let text = String::from_utf8_lossy(&output.stdout);
    let modified = text.split('\0').filter_map(|entry| entry.get(3..)).filter(|name| !Paths::is_output(name));
    let names: Vec<&str> = modified.collect();
    match names.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!("modified, commit first: {}", names.join(" ")))),
    }
}

fn note_no_repository() -> Result<(), Failure> {
    eprintln!("no git repository: nothing says whether the sources are as committed");
    Ok(())
}

fn change(paths: &Paths, survey: &Survey<'_>, reference: &Reference) -> Result<Change, Failure> {
    if paths.scheme == Scheme::Paper {
        let states = reference.sums.judge(paths, survey);
        let changed: Vec<_> = states.into_iter().filter(|(_, state)| *state != State::Same).collect();
        let lines = changed.iter().map(|(name, state)| format!("{}: {name}\n", state.word())).collect();
        let moved = |(name, state): &(String, State)| name.ends_with(".csv") && *state != State::New;
        return Ok(Change { lines, numbers_moved: changed.iter().any(moved) });
    }
    let judgement = judging::judge(paths, paths, survey, reference, Some(&paths.differences()))?;
    let moved = |(name, state): (&String, &State)| name.ends_with(".csv") && !matches!(state, State::Same | State::New);
    let numbers_moved = judgement.files.iter().any(moved)
        || judgement.tables.values().flatten().any(|one| !one.is_same())
        || !judgement.events.is_empty();
    let mut lines: Vec<String> = words::details(&judgement).into_iter().map(|line| format!("{line}\n")).collect();
    if !lines.is_empty() {
        lines.insert(0, format!("{}: {}\n", judgement.id, judgement.verdict().meaning()));
    }
    Ok(Change { lines, numbers_moved })
}

fn write_sums(
    paths: &Paths,
    surveys: &[Survey<'_>],
    committed: &Committed,
    supplement: bool,
    whole: bool,
) -> Result<(), Failure> {
    let mine: Vec<&Survey<'_>> = surveys.iter().filter(|survey| survey.figure.is_supplement() == supplement).collect();
    if mine.is_empty() {
        return Ok(());
    }
    let old = committed.list(supplement).cloned().filter(|_| !whole).unwrap_or_default();
    let starts: Vec<String> = mine.iter().flat_map(|survey| outputs::beginnings(paths, survey.figure)).collect();
    let replaced = old.below(&starts);
    let mut by_name = old.by_name;
    by_name.retain(|name, _| !replaced.by_name.contains_key(name));
    by_name.extend(mine.iter().flat_map(|survey| survey.outputs.clone()));
    let path = paths.root.join(paths.sums(supplement));
    disk::write_if_changed(&path, Sums { by_name }.to_text().as_bytes())
}

/// Samples of the tables, hashes of the states of the runs.
fn write_samples(paths: &Paths, survey: &Survey<'_>, reference: &Reference) -> Result<(), Failure> {
    let folder = paths.root.join(Paths::golden(&survey.figure.id));
    let samples = golden::samples(paths, survey.figure)?;
    for name in disk::names(&folder)?.iter().filter(|name| !samples.contains_key(*name)) {
        disk::remove(&folder.join(name))?;
    }
    for (name, text) in &samples {
        disk::write_if_changed(&folder.join(name), text.as_bytes())?;
    }
    for (scene, panel, key) in states::own_runs(survey, &reference.scenes) {
        let text = states::to_csv(&states::of_run(paths, survey, panel, key)?);
        disk::write_if_changed(&paths.root.join(Paths::states(scene)), text.as_bytes())?;
    }
    Ok(())
}
