//! What must be true before a document about the figures is made: they are up to date, and they are the committed ones.

use crate::failure::Failure;
use crate::figure::{self, Figure};
use crate::hashing;
use crate::paths::Paths;
use crate::record::{self, Records};
use crate::sources::Sources;
use crate::sums::{State, Sums};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Problems named in a message; the rest is counted.
const SHOWN: usize = 5;

/// Checks that the figures of the paper are fresh, that each of their outputs has the committed sum, and that so have the
/// committed pictures of the supplements. Runs nothing.
///
/// # Errors
/// Stale: a figure is older than what it is made from, or was never made. Differs: a file has another sum.
pub fn figures_verify(paths: &Paths, all: &[Figure]) -> Result<(), Failure> {
    let selected = figure::select(all, &[], false)?;
    let surveys = record::survey(paths, &selected, &Sources::read(paths)?, &Records::read(paths)?)?;
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
