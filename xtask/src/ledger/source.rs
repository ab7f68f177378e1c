//! The files written by hand: claims, errata, parameters. Read strictly, then checked for what a table cannot tell.

use super::expression::{Condition, Expression};
use super::requirement::Requirement;
use crate::disk;
use crate::failure::Failure;
use crate::paths::{LEDGER_SOURCES, Paths};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fmt::Display;

/// What is said of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Verdict {
    /// All its tests hold.
    #[serde(rename = "holds")]
    Holds,
    /// A test fails as the statement is written; all hold under the condition.
    #[serde(rename = "holds with a condition")]
    Conditional,
    /// A test fails.
    #[serde(rename = "does not hold")]
    Fails,
    /// There is no test, or the error of one reaches over the border.
    #[serde(rename = "cannot be decided")]
    Open,
}

impl Verdict {
    /// All verdicts, best first.
    pub const ALL: [Verdict; 4] = [Verdict::Holds, Verdict::Conditional, Verdict::Fails, Verdict::Open];

    /// As it stands in the files.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::Conditional => "holds with a condition",
            Verdict::Fails => "does not hold",
            Verdict::Open => "cannot be decided",
        }
    }
}

/// How rows become one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Take {
    /// The least value.
    Least,
    /// The largest value.
    Largest,
    /// The mean.
    Mean,
    /// Largest less least.
    Span,
    /// The value of the one row that is left.
    Only,
    /// The number of rows.
    Count,
    /// The number of rows as a part of those that `among` leaves.
    Share,
    /// The value of the first row.
    First,
    /// The value of the last row.
    Last,
}

impl Take {
    /// As it stands in the files.
    pub fn word(self) -> &'static str {
        match self {
            Take::Least => "least",
            Take::Largest => "largest",
            Take::Mean => "mean",
            Take::Span => "span",
            Take::Only => "only",
            Take::Count => "count",
            Take::Share => "share",
            Take::First => "first",
            Take::Last => "last",
        }
    }

    /// Whether rows are counted, whatever their values.
    pub fn counts(self) -> bool {
        matches!(self, Take::Count | Take::Share)
    }
}

/// A measure, and what must be true of it; the form is described in [`super`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measure {
    /// The name for placeholders.
    pub name: Option<String>,
    /// How rows become one number.
    pub take: Take,
    /// The column, or an expression of two.
    pub of: Option<String>,
    /// The table below `data`, without `.csv`.
    pub table: String,
    /// A table whose rows are put beside those of the first.
    pub beside: Option<String>,
    /// The column by which the next row is put beside each one.
    pub next: Option<String>,
    /// The columns that two rows side by side must share; without it those that have no stated error.
    pub on: Option<Vec<String>>,
    /// Conditions that the rows must meet.
    #[serde(default, rename = "where")]
    pub conditions: Vec<String>,
    /// Conditions of the rows that are looked at, before others are put beside them; `share` is a share of these.
    #[serde(default)]
    pub among: Vec<String>,
    /// The column that holds the errors of what `of` names.
    pub error_of: Option<String>,
    /// What must be true.
    pub is: Option<String>,
    /// A factor.
    pub times: Option<toml::Value>,
    /// A divisor.
    pub over: Option<toml::Value>,
    /// What is subtracted.
    pub less: Option<toml::Value>,
    /// What is added.
    pub plus: Option<toml::Value>,
}

/// A statement of the source.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Small letters, digits and hyphens.
    pub id: String,
    /// The LaTeX label near which it stands.
    pub label: String,
    /// The statement in our words.
    pub says: String,
    /// The verdict that is expected.
    pub verdict: Verdict,
    /// Under which condition it holds.
    pub condition: Option<String>,
    /// Why it cannot be decided.
    pub why: Option<String>,
    /// What is found, with placeholders.
    pub finding: String,
    /// Tests of the statement as it is written.
    #[serde(default, rename = "test")]
    pub tests: Vec<Measure>,
    /// Tests of the statement under the condition.
    #[serde(default)]
    pub under: Vec<Measure>,
}

/// A slip in the source.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Erratum {
    /// Small letters, digits and hyphens.
    pub id: String,
    /// The LaTeX label near which it stands.
    pub label: String,
    /// What the source has.
    pub says: String,
    /// What should stand there.
    pub should: String,
    /// The derivation, or the number that shows it, with placeholders.
    pub why: String,
    /// Figures that it touches.
    #[serde(default)]
    pub touches: Vec<String>,
    /// Tests that show it; each must hold.
    #[serde(default, rename = "test")]
    pub tests: Vec<Measure>,
}

/// A constant of the reproduction.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Small letters, digits and hyphens.
    pub id: String,
    /// LaTeX.
    pub symbol: String,
    /// In words.
    pub name: String,
    /// Figures that it enters.
    #[serde(default)]
    pub figures: Vec<String>,
    /// Where it stands: `fig11-trajectories/scene.toml: start.shift`.
    #[serde(default)]
    pub scenes: Vec<String>,
    /// A label of the source, or `chosen: why`.
    pub source: String,
    /// What depends on it, with placeholders.
    pub influence: String,
    /// Tests; each must hold.
    #[serde(default, rename = "test")]
    pub tests: Vec<Measure>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClaimsFile {
    #[serde(default)]
    claim: Vec<Claim>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ErrataFile {
    #[serde(default)]
    erratum: Vec<Erratum>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ParametersFile {
    #[serde(default)]
    parameter: Vec<Parameter>,
}

/// All three files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sources {
    /// In the order of the file.
    pub claims: Vec<Claim>,
    /// In the order of the file.
    pub errata: Vec<Erratum>,
    /// In the order of the file.
    pub parameters: Vec<Parameter>,
}

/// Where a message belongs: `paper/claims.toml, mu-critical, test 2`.
#[derive(Clone, Debug, PartialEq)]
pub struct Place(pub String);

impl Place {
    /// Code 2, with a key of this place and what is wrong with it.
    pub fn fail(&self, key: &str, problem: impl Display) -> Failure {
        Failure::Usage(format!("{}, {key}: {problem}", self.0))
    }
}

/// The tests of an entry, each with its place and whether it is one under a condition.
pub type Tests<'a> = Vec<(Place, bool, &'a Measure)>;

impl Sources {
    /// Reads the three files of the checkout; one that is not there is empty.
    ///
    /// # Errors
    /// Usage: a file is malformed, with its line; or an entry is, with its id and key.
    pub fn read(paths: &Paths) -> Result<Sources, Failure> {
        let [claims, errata, parameters] = LEDGER_SOURCES;
        Sources::parse([
            &disk::read_text(&paths.root.join(claims))?.unwrap_or_default(),
            &disk::read_text(&paths.root.join(errata))?.unwrap_or_default(),
            &disk::read_text(&paths.root.join(parameters))?.unwrap_or_default(),
        ])
    }

    /// Reads the texts of claims, errata and parameters.
    ///
    /// # Errors
    /// As [`Sources::read`].
    pub fn parse([claims, errata, parameters]: [&str; 3]) -> Result<Sources, Failure> {
        let [of_claims, of_errata, of_parameters] = LEDGER_SOURCES;
        let sources = Sources {
            claims: file::<ClaimsFile>(of_claims, claims)?.claim,
            errata: file::<ErrataFile>(of_errata, errata)?.erratum,
            parameters: file::<ParametersFile>(of_parameters, parameters)?.parameter,
        };
        sources.check()?;
        Ok(sources)
    }

    /// Whether nothing is written down.
    pub fn is_empty(&self) -> bool {
        self.claims.is_empty() && self.errata.is_empty() && self.parameters.is_empty()
    }

    fn check(&self) -> Result<(), Failure> {
        let mut ids = BTreeSet::new();
        for (file, id) in self.ids() {
            let place = Place(format!("{file}, {id}"));
            let good = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
            if id.is_empty() || !id.bytes().all(good) {
                return Err(place.fail("id", "must be small letters, digits and hyphens"));
            }
            if !ids.insert(id) {
                return Err(place.fail("id", "stands twice; an id is one of claims, errata and parameters together"));
            }
        }
        self.claims.iter().try_for_each(|claim| claim.check())?;
        self.entries().into_iter().flatten().try_for_each(|(place, _, measure)| measure.check(&place))
    }

    fn ids(&self) -> Vec<(&'static str, &str)> {
        let [claims, errata, parameters] = LEDGER_SOURCES;
        let of_claims = self.claims.iter().map(|one| (claims, one.id.as_str()));
        let of_errata = self.errata.iter().map(|one| (errata, one.id.as_str()));
        let of_parameters = self.parameters.iter().map(|one| (parameters, one.id.as_str()));
        of_claims.chain(of_errata).chain(of_parameters).collect()
    }

    /// The tests of every entry: claims, errata, parameters.
    pub fn entries(&self) -> Vec<Tests<'_>> {
        let claims = self.claims.iter().map(Claim::all_tests);
        let errata = self.errata.iter().map(Erratum::all_tests);
        claims.chain(errata).chain(self.parameters.iter().map(Parameter::all_tests)).collect()
    }

    /// The names of all tables that a test reads.
    pub fn tables(&self) -> Result<BTreeSet<String>, Failure> {
        let mut tables = BTreeSet::new();
        for (place, _, measure) in self.entries().into_iter().flatten() {
            tables.extend(measure.tables(&place)?);
        }
        Ok(tables)
    }
}

fn file<T: DeserializeOwned>(name: &str, text: &str) -> Result<T, Failure> {
    toml::from_str(text).map_err(|error| {
        let before = error.span().map_or("", |span| text.get(..span.start).unwrap_or(text));
        let line = before.matches('\n').count() + 1;
        let id = before.rsplit_once("\nid").and_then(|(_, rest)| rest.split('"').nth(1));
        let entry = id.map_or(String::new(), |id| format!(" (at or after {id})"));
        Failure::Usage(format!("{name}:{line}{entry}: {}", error.message()))
    })
}

fn tests_of<'a>(file: &str, id: &str, key: &str, under: bool, measures: &'a [Measure]) -> Tests<'a> {
    let place = |number: usize| Place(format!("{file}, {id}, {key} {number}"));
    measures.iter().enumerate().map(|(index, measure)| (place(index + 1), under, measure)).collect()
}

impl Claim {
    /// Its tests: of the statement, then under the condition.
    pub fn all_tests(&self) -> Tests<'_> {
        let mut tests = tests_of(LEDGER_SOURCES[0], &self.id, "test", false, &self.tests);
        tests.extend(tests_of(LEDGER_SOURCES[0], &self.id, "under", true, &self.under));
        tests
    }

    /// What a message about it begins with.
    pub fn place(&self) -> Place {
        Place(format!("{}, {}", LEDGER_SOURCES[0], self.id))
    }

    fn check(&self) -> Result<(), Failure> {
        let place = self.place();
        if self.under.is_empty() == self.condition.is_some() {
            return Err(place.fail("condition", "stands together with [[claim.under]] tests, or neither is there"));
        }
        if self.verdict == Verdict::Open && self.why.is_none() {
            return Err(place.fail("why", "is missing: a claim that cannot be decided says why"));
        }
        if self.verdict != Verdict::Open && self.why.is_some() {
            return Err(place.fail("why", "is only for a claim that cannot be decided; finding holds the rest"));
        }
        let decides = |tests: &[Measure]| tests.iter().any(|test| test.is.is_some());
        if self.verdict != Verdict::Open && !decides(&self.tests) {
            return Err(place.fail("test", "no test has an `is`: without one the verdict is \"cannot be decided\""));
        }
        Ok(())
    }
}

impl Erratum {
    /// Its tests.
    pub fn all_tests(&self) -> Tests<'_> {
        tests_of(LEDGER_SOURCES[1], &self.id, "test", false, &self.tests)
    }

    /// What a message about it begins with.
    pub fn place(&self) -> Place {
        Place(format!("{}, {}", LEDGER_SOURCES[1], self.id))
    }
}

impl Parameter {
    /// Its tests.
    pub fn all_tests(&self) -> Tests<'_> {
        tests_of(LEDGER_SOURCES[2], &self.id, "test", false, &self.tests)
    }

    /// What a message about it begins with.
    pub fn place(&self) -> Place {
        Place(format!("{}, {}", LEDGER_SOURCES[2], self.id))
    }
}

/// A second operand.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    /// A plain number.
    Number(f64),
    /// Another measure.
    Measure(Box<Measure>),
}

impl Measure {
    /// The sign and the second operand, if there is one.
    ///
    /// # Errors
    /// Usage: there are several, or it is neither a number nor a measure.
    pub fn operand(&self, place: &Place) -> Result<Option<(&'static str, Operand)>, Failure> {
        let all = [("times", &self.times), ("over", &self.over), ("less", &self.less), ("plus", &self.plus)];
        let mut given = all.into_iter().filter_map(|(key, value)| Some((key, value.as_ref()?)));
        let Some((key, value)) = given.next() else { return Ok(None) };
        if let Some((other, _)) = given.next() {
            return Err(place.fail(other, format!("stands beside {key}; a measure has one second operand")));
        }
        let operand = match value {
            toml::Value::Float(number) => Operand::Number(*number),
            toml::Value::Integer(number) => Operand::Number(*number as f64),
            toml::Value::Table(_) => {
                let measure: Result<Measure, _> = value.clone().try_into();
                Operand::Measure(Box::new(measure.map_err(|error| place.fail(key, error.message()))?))
            }
            other => return Err(place.fail(key, format!("{other}: must be a number or a measure {{ take.., of.. }}"))),
        };
        Ok(Some((key, operand)))
    }

    /// The tables that it reads.
    ///
    /// # Errors
    /// As [`Measure::operand`].
    pub fn tables(&self, place: &Place) -> Result<Vec<String>, Failure> {
        let mut tables = vec![self.table.clone()];
        tables.extend(self.beside.clone());
        if let Some((_, Operand::Measure(other))) = self.operand(place)? {
            tables.extend(other.tables(place)?);
        }
        Ok(tables)
    }

    /// Checks everything that needs no table.
    fn check(&self, place: &Place) -> Result<(), Failure> {
        if let Some(is) = &self.is {
            Requirement::parse(is).map_err(|problem| place.fail("is", problem))?;
        }
        let parts = self.table.split('/').chain(self.beside.iter().flat_map(|table| table.split('/')));
        let good = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
        for part in parts {
            if part.is_empty() || !part.bytes().all(good) {
                return Err(
                    place.fail("table", format!("{part:?}: valid are names such as fig11/trajectories, events"))
                );
            }
        }
        if !self.take.counts() && self.of.is_none() {
            return Err(place.fail("of", format!("is missing: `{}` needs a column", self.take.word())));
        }
        if self.take.counts() && self.of.is_some() && self.error_of.is_none() {
            return Err(place
                .fail("of", format!("`{}` counts rows; `of` only names whose error error_of is", self.take.word())));
        }
        if self.beside.is_some() && self.next.is_some() {
            return Err(place.fail("next", "stands beside `beside`; a measure has one of them"));
        }
        if self.on.is_some() && self.beside.is_none() && self.next.is_none() {
            return Err(place.fail("on", "is only for `beside` and `next`"));
        }
        for condition in self.conditions.iter().chain(&self.among) {
            Condition::parse(condition).map_err(|problem| place.fail("where", problem))?;
        }
        if let Some(of) = &self.of {
            Expression::parse(of).map_err(|problem| place.fail("of", problem))?;
        }
        match self.operand(place)? {
            Some((key, Operand::Measure(other))) => {
                if other.is.is_some() || other.name.is_some() {
                    return Err(place.fail(key, "name and is stand only in the test itself"));
                }
                other.check(&Place(format!("{}, {key}", place.0)))
            }
            _ => Ok(()),
        }
    }
}
