//! Accepts outputs: shows how they differ from the last commit, then writes their sums, samples, state hashes and the
//! ledger.

use crate::reference::Reference;
use crate::{golden, judgement, states, words};
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure;
use checkout::outputs;
use checkout::paths::{LEDGER_SOURCES, Paths, Scheme};
use checkout::print;
use checkout::request::{MadeFigure, Request};
use checkout::sums::{Committed, State, Sums};

/// What changes in a figure.
struct Change {
    lines: Vec<String>,
    /// Whether a number that the last commit has is another one.
    numbers_moved: bool,
}

/// Shows the changes, then accepts them if `numbers` is given or no number and no verdict has changed.
///
/// # Errors
/// Differs: numbers or verdicts moved, and `numbers` was not given; nothing is written. Otherwise what kept a file from
/// being read or written.
pub fn run(paths: &Paths, request: &Request, numbers: bool) -> Result<(), Failure> {
    let paths = &paths.with_scheme(request.scheme);
    let all = figure::discover(paths)?;
    let surveys = request.figures(&all)?;
    let reference = Reference::of_last_commit(paths, request)?;
    let mut moved = Vec::new();
    for survey in &surveys {
        let change = change(paths, survey, &reference)?;
        print::out(&change.lines.concat())?;
        if change.numbers_moved {
            moved.push(survey.figure.id.as_str());
        }
    }
    let claims = match paths.scheme == Scheme::Adaptive && claims::is_complete(paths)? {
        true => Some(claims::judge(paths, paths, None)?),
        false => None,
    };
    if claims.is_none() && paths.scheme == Scheme::Adaptive {
        eprintln!("claims are not judged: tables that they read are missing; cargo xtask figures --all makes them");
    }
    let changed = claims.as_ref().map(claims::Verdicts::differences).unwrap_or_default();
    print::out(&changed.iter().map(|line| format!("{line}\n")).collect::<String>())?;
    if !changed.is_empty() && !numbers {
        let problem =
            "claims are not as recorded; nothing written (--numbers accepts the numbers, the verdicts stand in";
        return Err(Failure::Differs(format!("{problem} {})", LEDGER_SOURCES.join(", "))));
    }
    if !moved.is_empty() && !numbers {
        let moved = moved.join(" ");
        return Err(Failure::Differs(format!("numbers moved: {moved}; nothing written (--numbers accepts them)")));
    }
    for supplement in [false, true] {
        // a list without figures that no longer exist, when all of them were asked for
        write_sums(paths, &surveys, &reference.sums, supplement, request.whole)?;
    }
    print::out(&format!("{} figures accepted\n", surveys.len()))?;
    if paths.scheme == Scheme::Paper {
        return Ok(());
    }
    surveys.iter().try_for_each(|survey| write_samples(paths, survey, &reference))?;
    claims.map_or(Ok(()), |claims| claims::write(paths, &claims.ledger))
}

fn change(paths: &Paths, survey: &MadeFigure<'_>, reference: &Reference) -> Result<Change, Failure> {
    if paths.scheme == Scheme::Paper {
        let states = reference.sums.judge(paths, survey.figure, &survey.outputs);
        let changed: Vec<_> = states.into_iter().filter(|(_, state)| *state != State::Same).collect();
        let lines = changed.iter().map(|(name, state)| format!("{}: {name}\n", state.word())).collect();
        let moved = |(name, state): &(String, State)| name.ends_with(".csv") && *state != State::New;
        return Ok(Change { lines, numbers_moved: changed.iter().any(moved) });
    }
    let judgement = judgement::judge(paths, paths, survey, reference, Some(&paths.differences()))?;
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
    surveys: &[MadeFigure<'_>],
    committed: &Committed,
    supplement: bool,
    whole: bool,
) -> Result<(), Failure> {
    let mine: Vec<&MadeFigure<'_>> =
        surveys.iter().filter(|survey| survey.figure.is_supplement() == supplement).collect();
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
fn write_samples(paths: &Paths, survey: &MadeFigure<'_>, reference: &Reference) -> Result<(), Failure> {
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
