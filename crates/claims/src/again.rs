//! Judges claims again on the tables of another run. Where a test has no value, the claim stays open, with the reason.

use crate::entry::{Claim, Measure, Verdict};
use crate::measure;
use crate::report;
use crate::requirement::Requirement;
use crate::source::LedgerFiles;
use crate::tables::{EVENTS, Tables};
use crate::uncertain::{Outcome, Uncertain};
use crate::words;
use checkout::failure::Failure;

/// A test and its present result.
#[derive(Clone, Debug, PartialEq)]
pub struct Again {
    /// Whether it tests the statement under the condition, not as it is written.
    pub under: bool,
    /// The measure in words.
    pub words: String,
    /// What must be true.
    pub is: Option<String>,
    /// The value with its error, or the reason why it is missing.
    pub value: Result<Uncertain, String>,
    /// Whether the requirement is met; `None` for a measure that only reports.
    pub outcome: Option<Outcome>,
}

/// The tests and the verdict that follows from them.
///
/// # Errors
/// Usage: a test is malformed.
pub fn judge(claim: &Claim, tables: &Tables<'_>) -> Result<(Verdict, Vec<Again>), Failure> {
    let tests = claim.all_tests();
    let tests = tests.iter().map(|(place, under, measure)| {
        let value = measure::evaluate(measure, tables, place).map_err(|failure| {
            let (text, before) = (failure.text(), format!("{}, ", place.0));
            text.strip_prefix(&before).unwrap_or(text).to_owned()
        });
        let requirement = measure.is.as_deref().map(Requirement::parse).transpose();
        let requirement = requirement.map_err(|problem| place.fail("is", problem))?;
        let judged = |requirement: Requirement| match &value {
            Ok(value) => requirement.judge(*value),
            Err(_) => Outcome::Undecided,
        };
        let (words, is) = (words::describe(measure, place)?, measure.is.clone());
        Ok(Again { under: *under, words, is, outcome: requirement.map(judged), value })
    });
    let tests = tests.collect::<Result<Vec<Again>, Failure>>()?;
    let outcomes: Vec<(bool, Option<Outcome>)> = tests.iter().map(|test| (test.under, test.outcome)).collect();
    Ok((report::verdict_of(&outcomes), tests))
}

/// The claims whose tests read these tables alone, the list of events aside, which holds those of every run.
///
/// # Errors
/// Usage: a test is malformed.
pub fn about<'a>(sources: &'a LedgerFiles, is_own: &dyn Fn(&str) -> bool) -> Result<Vec<&'a Claim>, Failure> {
    let mut found = Vec::new();
    for claim in &sources.claims {
        let mut tables = Vec::new();
        for (place, _, measure) in claim.all_tests() {
            tables.extend(Measure::tables(measure, &place)?);
        }
        tables.retain(|table| table != EVENTS);
        if !tables.is_empty() && tables.iter().all(|table| is_own(table)) {
            found.push(claim);
        }
    }
    Ok(found)
}
