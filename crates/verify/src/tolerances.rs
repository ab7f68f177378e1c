//! Tolerances for numbers on a machine whose bits differ: `data/tolerances.toml`.

use crate::numbers::Tolerance;
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{Paths, TOLERANCES};
use serde::Deserialize;

/// The file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerances {
    /// Of columns of tables. The first that fits counts; a column that none fits must be equal.
    #[serde(default, rename = "column")]
    pub columns: Vec<Entry>,
    /// Of times of events, by scene.
    #[serde(default, rename = "event")]
    pub events: Vec<EventEntry>,
}

/// The tolerance of some columns.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Tables: `fig04/stable`; `fig04/*` for all of a figure.
    pub tables: Vec<String>,
    /// Columns; `jams*` for all that begin so.
    pub columns: Vec<String>,
    /// In units of the column.
    #[serde(default)]
    pub absolute: f64,
    /// Times the larger of the two values.
    #[serde(default)]
    pub relative: f64,
    /// Times the largest absolute value of the column.
    #[serde(default)]
    pub of_scale: f64,
    /// Where it comes from: a rule of the head of the file.
    pub rule: Rule,
    /// The scene of `data/accuracy/error_growth.csv` whose growth of errors is meant.
    pub growth: Option<String>,
    /// Size of the perturbation at the start.
    pub perturbation: Option<f64>,
    /// Columns of stated errors, where they are not among `columns`.
    #[serde(default)]
    pub errors: Vec<String>,
    /// How many times further a number moves than what the stated error is of.
    pub factor: Option<f64>,
    /// The rule applied, in words.
    pub because: String,
}

/// The tolerance of the times of a scene's events.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EventEntry {
    /// The scene: `fig04-unstable`.
    pub scene: String,
    /// In units of t.
    pub absolute: f64,
    /// The scene of the growth of errors.
    pub growth: String,
    /// Size of the perturbation at the start.
    pub perturbation: f64,
    /// Where it comes from.
    pub because: String,
}

/// How a tolerance is derived; each is described in the head of the file, and a test derives it again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// Whole numbers, and axes that a few roundings give: nothing.
    Exact,
    /// Ten times the difference of two ways to compute the same closed form (the manifest), or ten roundings.
    TwoWays,
    /// Ten times the tolerance of the run, times how much faster errors grow than what is drawn.
    Condition,
    /// Ten times the tolerance of the run, times the growth of errors, times the perturbation.
    Growth,
    /// Ten times the largest error that the table itself states, in a column `error` or `NAME_error` or one that is
    /// named.
    Stated,
    /// The distance between the last two values tried.
    Bisection,
}

impl Tolerances {
    /// Reads the file; without a file there are no tolerances.
    ///
    /// # Errors
    /// Usage: it is malformed, with the place.
    pub fn read(paths: &Paths) -> Result<Tolerances, Failure> {
        let text = disk::read_text(&paths.root.join(TOLERANCES))?.unwrap_or_default();
        toml::from_str(&text).map_err(|error| Failure::Usage(format!("{TOLERANCES}: {error}")))
    }

    /// The entry of a column, if there is one: of the figure `fig04`, its table `stable.csv`.
    pub fn entry(&self, id: &str, file: &str, column: &str) -> Option<&Entry> {
        let table = format!("{id}/{}", file.trim_end_matches(".csv"));
        let fits = |pattern: &String, name: &str| match pattern.strip_suffix('*') {
            Some(start) => name.starts_with(start),
            None => pattern == name,
        };
        let any = |patterns: &[String], name: &str| patterns.iter().any(|pattern| fits(pattern, name));
        self.columns.iter().find(|entry| any(&entry.tables, &table) && any(&entry.columns, column))
    }

    /// How far the values of a column may be apart; nothing for one that has no entry.
    pub fn column(&self, id: &str, file: &str, column: &str) -> Tolerance {
        let entry = self.entry(id, file, column);
        entry.map_or_else(Tolerance::default, |entry| Tolerance {
            absolute: entry.absolute,
            relative: entry.relative,
            of_scale: entry.of_scale,
        })
    }

    /// How far the times of a scene's events may be apart.
    pub fn event(&self, scene: &str) -> f64 {
        self.events.iter().find(|entry| entry.scene == scene).map_or(0.0, |entry| entry.absolute)
    }
}
