//! Checks of entries and measures that need no table.

use crate::entry::{Claim, Erratum, Measure, Parameter, Verdict};
use crate::expression::{Condition, Expression};
use crate::requirement::Requirement;
use crate::source::{ClaimLocation, Tests};
use checkout::failure::Failure;
use checkout::paths::LEDGER_SOURCES;

fn tests_of<'a>(file: &str, id: &str, key: &str, under: bool, measures: &'a [Measure]) -> Tests<'a> {
    let place = |number: usize| ClaimLocation(format!("{file}, {id}, {key} {number}"));
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
    pub fn place(&self) -> ClaimLocation {
        ClaimLocation(format!("{}, {}", LEDGER_SOURCES[0], self.id))
    }

    /// Whether verdict, condition, reason and tests fit together.
    ///
    /// # Errors
    /// Usage: they do not.
    pub(crate) fn check(&self) -> Result<(), Failure> {
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
    pub fn place(&self) -> ClaimLocation {
        ClaimLocation(format!("{}, {}", LEDGER_SOURCES[1], self.id))
    }
}

impl Parameter {
    /// Its tests.
    pub fn all_tests(&self) -> Tests<'_> {
        tests_of(LEDGER_SOURCES[2], &self.id, "test", false, &self.tests)
    }

    /// What a message about it begins with.
    pub fn place(&self) -> ClaimLocation {
        ClaimLocation(format!("{}, {}", LEDGER_SOURCES[2], self.id))
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
    pub fn operand(&self, place: &ClaimLocation) -> Result<Option<(&'static str, Operand)>, Failure> {
        let all = [("times", &self.times), ("over", &self.over), ("less", &self.less)];
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
    pub fn tables(&self, place: &ClaimLocation) -> Result<Vec<String>, Failure> {
        let mut tables = vec![self.table.clone()];
        tables.extend(self.beside.clone());
        if let Some((_, Operand::Measure(other))) = self.operand(place)? {
            tables.extend(other.tables(place)?);
        }
        Ok(tables)
    }

    /// Checks everything that needs no table.
    ///
    /// # Errors
    /// Usage: the key, and what would be valid.
    pub fn check(&self, place: &ClaimLocation) -> Result<(), Failure> {
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
                other.check(&ClaimLocation(format!("{}, {key}", place.0)))
            }
            _ => Ok(()),
        }
    }
}
