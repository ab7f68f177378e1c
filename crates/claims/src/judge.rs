//! Judges the ledger on the present tables, compares the result with the committed ledger, and writes it.

use crate::entry::{Claim, Erratum, Parameter, Verdict};
use crate::report::{Ledger, Tested};
use crate::show;
use crate::source::{LedgerFiles, Tests};
use crate::tables::{Tables, figure_of};
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{LEDGER, LEDGER_SOURCES, Paths};
use checkout::sums::State;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// The level "claims" of `verify`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdicts {
    /// What is found.
    pub ledger: Ledger,
    /// How the committed ledger compares with it; nothing when only a part was judged.
    pub committed: Option<State>,
}

/// Judges the ledger on the tables below `made`: all of it, or the entries that read tables of these figures and of no
/// others.
///
/// # Errors
/// Usage: a file of the ledger is malformed, or a test cannot be evaluated.
pub fn judge(paths: &Paths, made: &Paths, figures: Option<&BTreeSet<&str>>) -> Result<Verdicts, Failure> {
    let mut sources = LedgerFiles::read(paths)?;
    if let Some(figures) = figures {
        sources = part(sources, figures)?;
    }
    let ledger = Ledger::new(&sources, &Tables::new(paths, made)?)?;
    let committed = match figures {
        Some(_) => None,
        None => Some(state(paths, &sources, &ledger)?),
    };
    Ok(Verdicts { ledger, committed })
}

/// How the committed file compares.
fn state(paths: &Paths, sources: &LedgerFiles, ledger: &Ledger) -> Result<State, Failure> {
    let committed = disk::read_text(&paths.ledger())?;
    Ok(match committed {
        None if sources.is_empty() => State::Same,
        None => State::Missing,
        Some(text) if text == ledger.to_text()? => State::Same,
        Some(_) => State::Differs,
    })
}

/// The entries that read tables of these figures and of no other ones.
fn part(sources: LedgerFiles, figures: &BTreeSet<&str>) -> Result<LedgerFiles, Failure> {
    let belongs = |tests: Tests<'_>| -> Result<bool, Failure> {
        let mut own = false;
        for (place, _, measure) in tests {
            for figure in measure.tables(&place)?.iter().filter_map(|table| figure_of(table)) {
                match figures.contains(figure) {
                    true => own = true,
                    false => return Ok(false),
                }
            }
        }
        Ok(own)
    };
    Ok(LedgerFiles {
        claims: keep(sources.claims, |one| belongs(Claim::all_tests(one)))?,
        errata: keep(sources.errata, |one| belongs(Erratum::all_tests(one)))?,
        parameters: keep(sources.parameters, |one| belongs(Parameter::all_tests(one)))?,
    })
}

fn keep<T>(all: Vec<T>, belongs: impl Fn(&T) -> Result<bool, Failure>) -> Result<Vec<T>, Failure> {
    let mut kept = Vec::new();
    for one in all {
        if belongs(&one)? {
            kept.push(one);
        }
    }
    Ok(kept)
}

/// The figures and supplements whose tables the ledger reads.
///
/// # Errors
/// Usage: a file of the ledger is malformed.
pub fn figures(paths: &Paths) -> Result<BTreeSet<String>, Failure> {
    let tables = LedgerFiles::read(paths)?.tables()?;
    Ok(tables.iter().filter_map(|table| figure_of(table)).map(str::to_owned).collect())
}

/// Whether every table that the ledger reads is there.
///
/// # Errors
/// Usage: a file of the ledger is malformed.
pub fn is_complete(paths: &Paths) -> Result<bool, Failure> {
    let tables = Tables::new(paths, paths)?;
    Ok(LedgerFiles::read(paths)?.tables()?.iter().all(|table| tables.has(table)))
}

/// Writes `data/ledger.json` as it was found on all tables.
///
/// # Errors
/// The file cannot be written.
pub fn write(paths: &Paths, ledger: &Ledger) -> Result<(), Failure> {
    let is_empty = ledger.claims.is_empty() && ledger.errata.is_empty() && ledger.parameters.is_empty();
    match is_empty && !paths.ledger().exists() {
        true => Ok(()),
        false => disk::write_if_changed(&paths.ledger(), ledger.to_text()?.as_bytes()),
    }
}

impl Claim<Tested> {
    /// The verdict of the tests.
    pub fn found(&self) -> Verdict {
        self.verdict_found.unwrap_or(self.verdict)
    }

    /// Whether the verdict found is the recorded one.
    pub fn is_as_recorded(&self) -> bool {
        self.verdict == self.found()
    }
}

impl Verdicts {
    /// The claims of which another verdict is found than the recorded one.
    pub fn changed(&self) -> impl Iterator<Item = &Claim<Tested>> {
        self.ledger.claims.iter().filter(|claim| !claim.is_as_recorded())
    }

    /// Whether every verdict is the recorded one, every test of the errata and parameters holds, and the committed
    /// ledger is what is found.
    pub fn is_same(&self) -> bool {
        let confirmed = self.unconfirmed().is_empty();
        self.changed().next().is_none() && confirmed && self.committed.is_none_or(|state| state == State::Same)
    }

    /// Errata and parameters of which a test fails.
    fn unconfirmed(&self) -> Vec<(&str, &str, &[Tested])> {
        let [_, errata, parameters] = LEDGER_SOURCES;
        let of_errata = self.ledger.errata.iter().map(|one| (errata, &*one.id, one.confirmed, &*one.tests));
        let of_parameters = self.ledger.parameters.iter().map(|one| (parameters, &*one.id, one.confirmed, &*one.tests));
        let all = of_errata.chain(of_parameters).filter(|(_, _, confirmed, _)| *confirmed == Some(false));
        all.map(|(file, id, _, tests)| (file, id, tests)).collect()
    }

    /// What is not as recorded, and whether the committed ledger is what is found; a line each, with the numbers.
    pub fn details(&self) -> Vec<String> {
        let mut lines = self.differences();
        if let Some(state) = self.committed.filter(|state| *state != State::Same) {
            lines.push(format!("  {}: {LEDGER} (cargo xtask bless accepts it)", state.word()));
        }
        lines
    }

    /// Claims with another verdict than the recorded one, and tests of errata and parameters that do not hold; with the
    /// numbers.
    pub fn differences(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for claim in self.changed() {
            let (recorded, found) = (claim.verdict.words(), claim.found().words());
            lines.push(format!("  claim {}: recorded {recorded:?}, found {found:?}", claim.id));
            lines.extend(
                claim.tests.iter().filter(|test| test.is.is_some()).map(|test| format!("    {}", show::line(test))),
            );
        }
        for (file, id, tests) in self.unconfirmed() {
            lines.push(format!("  {file}, {id}: a test does not hold"));
            lines.extend(tests.iter().filter(|test| test.is.is_some()).map(|test| format!("    {}", show::line(test))));
        }
        lines
    }

    /// How many claims have each verdict, best first.
    pub fn counts(&self) -> Vec<(Verdict, usize)> {
        let count = |verdict| self.ledger.claims.iter().filter(|claim| claim.found() == verdict).count();
        Verdict::ALL.into_iter().map(|verdict| (verdict, count(verdict))).collect()
    }

    /// One line: how many claims were judged, and how.
    pub fn line(&self) -> String {
        let counts = self.counts().into_iter().filter(|(_, count)| *count > 0);
        let counts: Vec<String> = counts.map(|(verdict, count)| format!("{} {count}", verdict.words())).collect();
        match counts.is_empty() {
            true => "no claim was judged".to_owned(),
            false => format!("{} claims: {}", self.ledger.claims.len(), counts.join(", ")),
        }
    }

    /// For JSON.
    pub fn to_json(&self) -> Value {
        let claims = self.ledger.claims.iter().map(
            |claim| json!({ "id": claim.id, "recorded": claim.verdict, "found": claim.found(), "tests": claim.tests }),
        );
        let word = if self.is_same() { State::Same.word() } else { State::Differs.word() };
        json!({
            "verdict": word, "claims": claims.collect::<Vec<_>>(),
            "unconfirmed": self.unconfirmed().iter().map(|(_, id, _)| *id).collect::<Vec<_>>(),
            "ledger": self.committed.map(State::word),
        })
    }
}
