//! The entries of the ledger as its files spell them: claims, errata, parameters, and the measures of their tests.

use serde::{Deserialize, Serialize};

/// The verdict on a statement.
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
    /// The sum.
    Sum,
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
            Take::Sum => "sum",
            Take::Span => "span",
            Take::Only => "only",
            Take::Count => "count",
            Take::Share => "share",
            Take::First => "first",
            Take::Last => "last",
        }
    }

    /// Whether rows are counted, regardless of their values.
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
}

/// A statement of the source: as its file has it, with measures as tests, or with what these gave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim<T = Measure> {
    /// Small letters, digits and hyphens.
    pub id: String,
    /// The LaTeX label near which it stands.
    pub label: String,
    /// The statement in our words.
    pub says: String,
    /// The verdict that is recorded.
    pub verdict: Verdict,
    /// The verdict of the tests; none in a file written by hand.
    pub verdict_found: Option<Verdict>,
    /// Under which condition it holds.
    pub condition: Option<String>,
    /// Why it cannot be decided.
    pub why: Option<String>,
    /// What is found, with placeholders, or with the numbers in their places.
    pub finding: String,
    /// Tests of the statement as it is written; those that were carried out, with those under the condition.
    #[serde(default = "Vec::new", alias = "test")]
    pub tests: Vec<T>,
    /// Tests of the statement under the condition.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub under: Vec<T>,
}

/// A slip in the source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Erratum<T = Measure> {
    /// Small letters, digits and hyphens.
    pub id: String,
    /// The LaTeX label near which it stands.
    pub label: String,
    /// What the source has.
    pub says: String,
    /// The corrected text.
    pub should: String,
    /// The derivation, or the number that shows it; as a finding.
    pub why: String,
    /// Figures that it touches.
    #[serde(default)]
    pub touches: Vec<String>,
    /// Whether all its tests hold; none without one, where the derivation stands alone, and in a file written by hand.
    pub confirmed: Option<bool>,
    /// Tests that show it; each must hold.
    #[serde(default = "Vec::new", alias = "test")]
    pub tests: Vec<T>,
}

/// A constant of the reproduction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter<T = Measure> {
    /// Small letters, digits and hyphens.
    pub id: String,
    /// LaTeX.
    pub symbol: String,
    /// In words.
    pub name: String,
    /// Figures that it enters.
    #[serde(default)]
    pub figures: Vec<String>,
    /// Its location: `fig11-trajectories/scene.toml: start.shift`.
    #[serde(default)]
    pub scenes: Vec<String>,
    /// A label of the source, or `chosen: why`.
    pub source: String,
    /// What depends on it; as a finding.
    pub influence: String,
    /// Whether all its tests hold; as that of an erratum.
    pub confirmed: Option<bool>,
    /// Tests; each must hold.
    #[serde(default = "Vec::new", alias = "test")]
    pub tests: Vec<T>,
}
