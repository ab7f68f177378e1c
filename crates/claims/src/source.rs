//! Reads and checks the three files that are written by hand: claims, errata, parameters.

use crate::entry::{Claim, Erratum, Measure, Parameter};
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{LEDGER_SOURCES, Paths};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;
use std::fmt::Display;

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
pub struct LedgerFiles {
    /// In the order of the file.
    pub claims: Vec<Claim>,
    /// In the order of the file.
    pub errata: Vec<Erratum>,
    /// In the order of the file.
    pub parameters: Vec<Parameter>,
}

/// Where a message belongs: `paper/claims.toml, mu-critical, test 2`.
#[derive(Clone, Debug, PartialEq)]
pub struct ClaimLocation(pub String);

impl ClaimLocation {
    /// Code 2, with a key of this place and what is wrong with it.
    pub fn fail(&self, key: &str, problem: impl Display) -> Failure {
        Failure::Usage(format!("{}, {key}: {problem}", self.0))
    }
}

/// The tests of an entry, each with its place and whether it is one under a condition.
pub type Tests<'a> = Vec<(ClaimLocation, bool, &'a Measure)>;

impl LedgerFiles {
    /// Reads the three files of the checkout; one that is not there is empty.
    ///
    /// # Errors
    /// Usage: a file is malformed, with its line; or an entry is, with its id and key.
    pub fn read(paths: &Paths) -> Result<LedgerFiles, Failure> {
        let [claims, errata, parameters] = LEDGER_SOURCES;
        LedgerFiles::parse([
            &disk::read_text(&paths.root.join(claims))?.unwrap_or_default(),
            &disk::read_text(&paths.root.join(errata))?.unwrap_or_default(),
            &disk::read_text(&paths.root.join(parameters))?.unwrap_or_default(),
        ])
    }

    /// Reads the texts of claims, errata and parameters.
    ///
    /// # Errors
    /// As [`LedgerFiles::read`].
    pub fn parse([claims, errata, parameters]: [&str; 3]) -> Result<LedgerFiles, Failure> {
        let [of_claims, of_errata, of_parameters] = LEDGER_SOURCES;
        let sources = LedgerFiles {
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
            let place = ClaimLocation(format!("{file}, {id}"));
            let good = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
            if id.is_empty() || !id.bytes().all(good) {
                return Err(place.fail("id", "must be small letters, digits and hyphens"));
            }
            if !ids.insert(id) {
                return Err(place.fail("id", "appears twice; claims, errata and parameters share their ids"));
            }
        }
        let found =
            self.claims.iter().find(|one| one.verdict_found.is_some()).map(|one| (one.place(), "verdict_found"));
        let erratum = self.errata.iter().find(|one| one.confirmed.is_some()).map(|one| (one.place(), "confirmed"));
        let parameter =
            self.parameters.iter().find(|one| one.confirmed.is_some()).map(|one| (one.place(), "confirmed"));
        if let Some((place, key)) = found.or(erratum).or(parameter) {
            return Err(place.fail(key, "is found by the tests: leave it out"));
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
