//! The result of judging: each entry with its tests, values, outcomes and verdict, as `data/ledger.json` stores them.

use crate::entry::{Claim, Erratum, Measure, Parameter, Verdict};
use crate::measure;
use crate::requirement::Requirement;
use crate::source::{ClaimLocation, LedgerFiles, Tests};
use crate::tables::Tables;
use crate::uncertain::{Outcome, Uncertain};
use crate::words;
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;

/// The form of the file.
const SCHEMA_VERSION: u32 = 1;

/// A test and its result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tested {
    /// The name for placeholders.
    pub name: Option<String>,
    /// Whether it tests the statement under the condition, not as it is written.
    pub under: bool,
    /// The measure in words.
    pub words: String,
    /// How to see it again.
    pub command: String,
    /// The files that it reads.
    pub tables: Vec<String>,
    /// The value; `null` if it is not a number.
    #[serde(deserialize_with = "or_not_a_number")]
    pub value: f64,
    /// Its error; `null` (infinite) when nothing bounds it.
    #[serde(deserialize_with = "or_infinite")]
    pub error: f64,
    /// The value in a few digits.
    pub text: String,
    /// What must be true.
    pub is: Option<String>,
    /// Whether it is; `null` for a measure that only reports.
    pub outcome: Option<Outcome>,
}

/// The ledger.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// The form of the file.
    pub schema_version: u32,
    /// In the order of their file.
    pub claims: Vec<Claim<Tested>>,
    /// In the order of their file.
    pub errata: Vec<Erratum<Tested>>,
    /// In the order of their file.
    pub parameters: Vec<Parameter<Tested>>,
}

impl Ledger {
    /// Judges every entry.
    ///
    /// # Errors
    /// Usage: a test cannot be evaluated, with its place and what would be valid.
    pub fn new(sources: &LedgerFiles, tables: &Tables<'_>) -> Result<Ledger, Failure> {
        Ok(Ledger {
            schema_version: SCHEMA_VERSION,
            claims: sources.claims.iter().map(|one| claim(one, tables)).collect::<Result<_, _>>()?,
            errata: sources.errata.iter().map(|one| erratum(one, tables)).collect::<Result<_, _>>()?,
            parameters: sources.parameters.iter().map(|one| parameter(one, tables)).collect::<Result<_, _>>()?,
        })
    }

    /// Reads `data/ledger.json`.
    ///
    /// # Errors
    /// Stale: the file does not exist. Usage: it is malformed.
    pub fn read(paths: &Paths) -> Result<Ledger, Failure> {
        let path = paths.ledger();
        let missing = || Failure::Stale(format!("{}: no such file; cargo xtask verify makes it", path.display()));
        let text = disk::read_text(&path)?.ok_or_else(missing)?;
        serde_json::from_str(&text).map_err(|error| Failure::Usage(format!("{}: {error}", path.display())))
    }

    /// The number of claims with a recorded verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.claims.iter().filter(|claim| claim.verdict == verdict).count()
    }

    /// The file.
    ///
    /// # Errors
    /// Failed: it cannot be written as JSON.
    pub fn to_text(&self) -> Result<String, Failure> {
        serde_json::to_string_pretty(self).map(|text| text + "\n").map_err(Failure::failed)
    }
}

fn or_not_a_number<'de, D: Deserializer<'de>>(value: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(value)?.unwrap_or(f64::NAN))
}

fn or_infinite<'de, D: Deserializer<'de>>(value: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(value)?.unwrap_or(f64::INFINITY))
}

/// The verdict of a claim's tests. A failure of the statement as written is distinguished from a condition only if
/// there are tests under the condition.
pub fn verdict(tests: &[Tested]) -> Verdict {
    verdict_of(&tests.iter().map(|test| (test.under, test.outcome)).collect::<Vec<_>>())
}

/// The same, from whether each test is one under the condition, and its outcome.
pub(crate) fn verdict_of(tests: &[(bool, Option<Outcome>)]) -> Verdict {
    let outcome = |of: bool| {
        let outcomes: Vec<Outcome> =
            tests.iter().filter(|(under, _)| *under == of).filter_map(|(_, outcome)| *outcome).collect();
        match () {
            () if outcomes.is_empty() => None,
            () if outcomes.contains(&Outcome::False) => Some(Outcome::False),
            () if outcomes.contains(&Outcome::Undecided) => Some(Outcome::Undecided),
            () => Some(Outcome::True),
        }
    };
    match (outcome(false), outcome(true)) {
        (None | Some(Outcome::Undecided), _) => Verdict::Open,
        (Some(Outcome::True), _) => Verdict::Holds,
        (Some(Outcome::False), None | Some(Outcome::False)) => Verdict::Fails,
        (Some(Outcome::False), Some(Outcome::True)) => Verdict::Conditional,
        (Some(Outcome::False), Some(Outcome::Undecided)) => Verdict::Open,
    }
}

fn claim(claim: &Claim, tables: &Tables<'_>) -> Result<Claim<Tested>, Failure> {
    let (place, id) = (claim.place(), &claim.id);
    let all = claim.all_tests();
    let tests = tested(&all, id, tables, &place)?;
    let texts = [claim.says.as_str()].into_iter().chain(claim.condition.as_deref());
    let known = known(texts, &all);
    let finding = filled(&claim.finding, &tests, &place, "finding", &known)?;
    let fill = |text: &Option<String>, key: &str| {
        text.as_ref().map(|text| filled(text, &tests, &place, key, &known)).transpose()
    };
    Ok(Claim {
        id: id.clone(),
        label: claim.label.clone(),
        says: claim.says.clone(),
        verdict: claim.verdict,
        verdict_found: Some(verdict(&tests)),
        condition: fill(&claim.condition, "condition")?,
        why: fill(&claim.why, "why")?,
        finding,
        tests,
        under: Vec::new(),
    })
}

fn erratum(erratum: &Erratum, tables: &Tables<'_>) -> Result<Erratum<Tested>, Failure> {
    let (place, id) = (erratum.place(), &erratum.id);
    let tests = tested(&erratum.all_tests(), id, tables, &place)?;
    Ok(Erratum {
        id: id.clone(),
        label: erratum.label.clone(),
        says: erratum.says.clone(),
        should: erratum.should.clone(),
        // a derivation has numbers of its own
        why: words::fill(&erratum.why, &named(&tests), &place, "why")?,
        touches: erratum.touches.clone(),
        confirmed: confirmed(&tests),
        tests,
    })
}

fn parameter(parameter: &Parameter, tables: &Tables<'_>) -> Result<Parameter<Tested>, Failure> {
    let (place, id) = (parameter.place(), &parameter.id);
    let all = parameter.all_tests();
    let tests = tested(&all, id, tables, &place)?;
    let known = known([parameter.name.as_str(), parameter.source.as_str()].into_iter(), &all);
    let influence = filled(&parameter.influence, &tests, &place, "influence", &known)?;
    Ok(Parameter {
        id: id.clone(),
        symbol: parameter.symbol.clone(),
        name: parameter.name.clone(),
        figures: parameter.figures.clone(),
        scenes: parameter.scenes.clone(),
        source: parameter.source.clone(),
        influence,
        confirmed: confirmed(&tests),
        tests,
    })
}

/// Whether all tests with an outcome hold; `None` without such tests.
fn confirmed(tests: &[Tested]) -> Option<bool> {
    let mut outcomes = tests.iter().filter_map(|test| test.outcome).peekable();
    outcomes.peek()?;
    Some(outcomes.all(|outcome| outcome == Outcome::True))
}

fn tested(tests: &Tests<'_>, id: &str, tables: &Tables<'_>, place: &ClaimLocation) -> Result<Vec<Tested>, Failure> {
    let done: Vec<Tested> = tests
        .iter()
        .map(|(place, under, measure)| test(measure, place, *under, id, tables))
        .collect::<Result<_, _>>()?;
    let mut names: Vec<&String> = done.iter().filter_map(|test| test.name.as_ref()).collect();
    names.sort();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(place.fail("name", format!("{} appears twice", pair[0]))),
        None => Ok(done),
    }
}

fn test(
    measure: &Measure,
    place: &ClaimLocation,
    under: bool,
    id: &str,
    tables: &Tables<'_>,
) -> Result<Tested, Failure> {
    let found = measure::evaluate(measure, tables, place)?;
    let requirement = measure.is.as_deref().map(Requirement::parse).transpose();
    let requirement = requirement.map_err(|problem| place.fail("is", problem))?;
    let mut files: Vec<String> = measure.tables(place)?.iter().map(|table| Paths::table(table)).collect();
    files.sort();
    files.dedup();
    Ok(Tested {
        name: measure.name.clone(),
        under,
        words: words::describe(measure, place)?,
        command: format!("cargo xtask explain {id}"),
        tables: files,
        value: found.value,
        error: found.error,
        text: words::number(found, None),
        is: measure.is.clone(),
        outcome: requirement.map(|requirement| requirement.judge(found)),
    })
}

fn named(tests: &[Tested]) -> BTreeMap<&str, Uncertain> {
    let value = |test: &Tested| Uncertain { value: test.value, error: test.error };
    tests.iter().filter_map(|test| Some((test.name.as_deref()?, value(test)))).collect()
}

/// A text with its placeholders filled, refused when a measured number is typed into it.
fn filled(text: &str, tests: &[Tested], place: &ClaimLocation, key: &str, known: &str) -> Result<String, Failure> {
    if let Some(number) = words::typed_number(text, known) {
        let remedy = "measured numbers stand as {name} of a test; those of the source must be in `says`";
        return Err(place.fail(key, format!("{number} is typed; {remedy}")));
    }
    words::fill(text, &named(tests), place, key)
}

/// What an entry repeats of the source, and the numbers of its tests.
fn known<'a>(texts: impl Iterator<Item = &'a str>, tests: &Tests<'_>) -> String {
    let mut known: Vec<String> = texts.map(str::to_owned).collect();
    for (_, _, measure) in tests {
        known.extend(measure.conditions.iter().chain(&measure.among).chain(&measure.is).cloned());
    }
    known.join(" ")
}
