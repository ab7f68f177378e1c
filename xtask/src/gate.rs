//! Preconditions of documents about the figures: the figures are up to date, and they are the committed ones.

use crate::record::{self, FigureState, Records};
use crate::sources::SourceHashes;
use checkout::failure::Failure;
use checkout::figure::{self, Figure};
use checkout::hashing;
use checkout::paths::Paths;
use checkout::sums::{Committed, State, Sums};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::Command;

/// Problems named in a message; the rest is counted.
const SHOWN: usize = 5;

/// Checks that the figures of the paper are up to date, and that their outputs and the committed pictures of the
/// supplements have the committed sums. Runs nothing.
///
/// # Errors
/// Stale: a figure is older than what it is made from, or was never made. Differs: a file has another sum.
pub fn figures_verify(paths: &Paths, all: &[Figure]) -> Result<(), Failure> {
    let selected = figure::select(all, &[], false)?;
    let surveys = record::survey(paths, &selected, &SourceHashes::read(paths)?, &Records::read(paths)?)?;
    let made: BTreeMap<String, String> = surveys.iter().flat_map(|survey| survey.outputs.clone()).collect();
    let committed = committed(paths, false)?;
    let mut wrong = judge(&committed, &made);
    wrong.extend(judge_supplements(paths)?);
    if !wrong.is_empty() {
        return Err(Failure::Differs(complain("not as committed", &wrong)));
    }
    let stale =
        surveys.iter().flat_map(|survey| survey.reasons.iter().map(|why| format!("{}: {why}", survey.figure.id)));
    match stale.collect::<Vec<_>>() {
        reasons if reasons.is_empty() => Ok(()),
        reasons => Err(Failure::Stale(complain("stale", &reasons))),
    }
}

/// Checks that all figures and supplements are fresh, and each of their outputs has the committed sum. Runs nothing.
///
/// # Errors
/// As [`figures_verify`].
pub fn everything_verifies(paths: &Paths, all: &[Figure]) -> Result<(), Failure> {
    let figures: Vec<&Figure> = all.iter().collect();
    let surveys = record::survey(paths, &figures, &SourceHashes::read(paths)?, &Records::read(paths)?)?;
    fresh(&surveys)?;
    let committed = Committed::read(paths)?;
    let states = surveys.iter().flat_map(|survey| committed.judge(paths, survey.figure, &survey.outputs));
    let wrong: Vec<String> = states.filter(|(_, state)| *state != State::Same).map(|(name, _)| name).collect();
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(Failure::Differs(format!("not as committed: {}", wrong.join(" ")))),
    }
}

/// Checks that nothing is older than what it is made from.
///
/// # Errors
/// Stale: with the figures that are.
pub fn fresh(surveys: &[FigureState<'_>]) -> Result<(), Failure> {
    let stale = surveys.iter().filter(|survey| !survey.reasons.is_empty()).map(|survey| survey.figure.id.as_str());
    match stale.collect::<Vec<&str>>() {
        stale if stale.is_empty() => Ok(()),
        stale => Err(Failure::Stale(format!("stale: {}; run cargo xtask figures --all first", stale.join(" ")))),
    }
}

fn committed(paths: &Paths, supplements: bool) -> Result<Sums, Failure> {
    let name = paths.sums(supplements);
    Ok(Sums::read(&paths.root.join(name), name)?.unwrap_or_default())
}

fn judge(committed: &Sums, made: &BTreeMap<String, String>) -> Vec<String> {
    let states = committed.judge(made).into_iter().filter(|(_, state)| *state != State::Same);
    states.map(|(name, state)| format!("{name} {}", state.word())).collect()
}

/// Pictures of the supplements are committed, their tables are not: only the pictures are compared.
fn judge_supplements(paths: &Paths) -> Result<Vec<String>, Failure> {
    let mut sums = committed(paths, true)?;
    sums.by_name.retain(|name, _| name.ends_with(".png") || name.ends_with(".svg"));
    let files: Vec<PathBuf> = sums.by_name.keys().map(|name| paths.output(name)).collect();
    let hashes = sums.by_name.keys().cloned().zip(hashing::hash_all(&files)?);
    let made = hashes.filter_map(|(name, hash)| Some((name, hash?))).collect();
    Ok(judge(&sums, &made))
}

fn complain(what: &str, problems: &[String]) -> String {
    let more = match problems.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!("\nand {more} more"),
    };
    let shown = problems[..problems.len().min(SHOWN)].join("\n");
    format!("the figures do not verify, {what}:\n{shown}{more}\ncargo xtask figures makes them again")
}

/// Tracked files that are not as committed; `None` where there is no git or no repository.
///
/// # Errors
/// Git cannot be started.
pub fn modified(paths: &Paths) -> Result<Option<Vec<String>>, Failure> {
    let mut git = Command::new("git");
    git.arg("-C").arg(&paths.root).args(["status", "--porcelain", "-z", "--untracked-files=no", "--no-renames"]);
    let output = match git.output() {
        Ok(output) if output.status.success() => output,
        Ok(_) => return Ok(None),
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(Failure::Failed(format!("git: {error}"))),
    };
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(Some(text.split('\0').filter_map(|entry| entry.get(3..)).map(str::to_owned).collect()))
}
