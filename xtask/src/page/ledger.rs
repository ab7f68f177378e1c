//! The ledger of claims, errata and parameters, as `data/ledger.json` has it.

use crate::disk;
use crate::failure::Failure;
use crate::paths::Paths;
use serde::Deserialize;

/// The verdicts, in the order in which they are shown.
pub const VERDICTS: [&str; 4] = ["holds", "holds with a condition", "does not hold", "cannot be decided"];

/// The whole file.
#[derive(Clone, Debug, Default, Deserialize)]
pub struct Ledger {
    /// Checkable statements of the paper.
    pub claims: Vec<Claim>,
    /// What should read otherwise there.
    pub errata: Vec<Erratum>,
    /// What a run needs, and where each number comes from.
    pub parameters: Vec<Parameter>,
}

/// A statement of the paper and what was found.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct Claim {
    /// Its name.
    pub id: String,
    /// Where it stands in the paper.
    pub label: String,
    /// What the paper says, in our words.
    pub says: String,
    /// One of [`VERDICTS`].
    pub verdict: String,
    /// What the tables say; the same, unless one of them changed.
    pub verdict_found: String,
    /// The condition, if there is one.
    pub condition: Option<String>,
    /// Why it cannot be decided, if so.
    pub why: Option<String>,
    /// What was found.
    pub finding: String,
    /// The tests that decide it.
    pub tests: Vec<Test>,
}

/// A correction.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct Erratum {
    /// Its name.
    pub id: String,
    /// Where it stands in the paper.
    pub label: String,
    /// What the paper says.
    pub says: String,
    /// What it should say.
    pub should: String,
    /// Why.
    pub why: String,
    /// Figures that change with it.
    pub touches: Vec<String>,
    /// Numbers that show it.
    pub tests: Vec<Test>,
}

/// A parameter.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct Parameter {
    /// Its name.
    pub id: String,
    /// The paper's symbol, in LaTeX.
    pub symbol: String,
    /// In words.
    pub name: String,
    /// Figures that use it.
    pub figures: Vec<String>,
    /// Where it stands, `fig04-algebraic-std/scene.toml: law.mu`.
    pub scenes: Vec<String>,
    /// A label of the paper, or `chosen: why`.
    pub source: String,
    /// How much the results depend on it.
    pub influence: String,
    /// Numbers that show it.
    pub tests: Vec<Test>,
}

/// A number taken from a table, and whether it is as claimed.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct Test {
    /// Its name; may be empty.
    pub name: Option<String>,
    /// Whether it tests the statement under its condition, not as it is written.
    pub under: bool,
    /// What is measured.
    pub words: String,
    /// How to see it again.
    pub command: String,
    /// What was found; nothing where no row is left.
    pub value: Option<f64>,
    /// How far it may be off.
    pub error: Option<f64>,
    /// What must be true of it.
    pub is: Option<String>,
    /// `true`, `false` or `undecided`; nothing for a number that is only reported.
    pub outcome: Option<serde_json::Value>,
}

impl Test {
    /// The outcome in words; empty where nothing was asked.
    pub fn outcome(&self) -> &str {
        match &self.outcome {
            Some(serde_json::Value::Bool(true)) => "true",
            Some(serde_json::Value::Bool(false)) => "false",
            Some(serde_json::Value::String(word)) => word,
            _ => "",
        }
    }
}

impl Ledger {
    /// Reads the file.
    ///
    /// # Errors
    /// Stale: there is none. Failed: it is malformed, or a verdict is not one of [`VERDICTS`].
    pub fn read(paths: &Paths) -> Result<Ledger, Failure> {
        let path = paths.ledger();
        let missing = || Failure::Stale(format!("{}: no such file; cargo xtask verify makes it", path.display()));
        let text = disk::read_text(&path)?.ok_or_else(missing)?;
        let ledger: Ledger = serde_json::from_str(&text).map_err(Failure::at(&path))?;
        match ledger.claims.iter().find(|claim| !VERDICTS.contains(&claim.verdict.as_str())) {
            None => Ok(ledger),
            Some(claim) => Err(Failure::at(&path)(format!(
                "verdict {:?} of {}; valid: {}",
                claim.verdict,
                claim.id,
                VERDICTS.join(", ")
            ))),
        }
    }

    /// The number of claims with a verdict.
    pub fn count(&self, verdict: &str) -> usize {
        self.claims.iter().filter(|claim| claim.verdict == verdict).count()
    }
}
