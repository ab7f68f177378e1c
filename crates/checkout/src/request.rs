//! A request from the runner to the program `verify`: which figures were made, from which runs, and where their outputs
//! lie.

use crate::failure::Failure;
use crate::figure::{self, Figure};
use crate::outputs::Hashes;
use crate::paths::{Paths, Scheme};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The file that contains the request.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// What the names of outputs are relative to.
    pub base: PathBuf,
    /// Whose outputs are meant.
    pub scheme: Scheme,
    /// The figures, as they were made.
    pub figures: Vec<Entry>,
    /// The scene under which a run's events are listed, by key.
    pub scenes: BTreeMap<String, String>,
    /// Whether no figure was picked and none left out.
    pub whole: bool,
    /// Whether the supplements were asked for too.
    pub all: bool,
    /// Figures that did not fit into a budget, with their seconds where they are known.
    pub left_out: Vec<(String, Option<f64>)>,
    /// The number of programs run in parallel.
    pub jobs: usize,
}

/// A figure of a request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Its id.
    pub id: String,
    /// Its runs: panel and key.
    pub runs: Vec<(String, String)>,
    /// What it has.
    pub outputs: Hashes,
}

/// A figure that was made.
#[derive(Clone, Debug)]
pub struct MadeFigure<'a> {
    /// The figure.
    pub figure: &'a Figure,
    /// Its runs: panel and key.
    pub runs: Vec<(String, String)>,
    /// What it has.
    pub outputs: Hashes,
}

impl Request {
    /// Reads the file.
    ///
    /// # Errors
    /// Failed: it cannot be read, or is no request.
    pub fn read(file: &Path) -> Result<Request, Failure> {
        let text = std::fs::read_to_string(file).map_err(Failure::at(file))?;
        serde_json::from_str(&text).map_err(Failure::at(file))
    }

    /// The text of the file.
    ///
    /// # Errors
    /// Failed: a path that is not UTF-8.
    pub fn to_text(&self) -> Result<String, Failure> {
        serde_json::to_string_pretty(self).map_err(Failure::failed)
    }

    /// The checkout as far as what was made is meant.
    pub fn made(&self, paths: &Paths) -> Paths {
        Paths { base: self.base.clone(), scheme: self.scheme, ..paths.clone() }
    }

    /// The figures with their scenes.
    ///
    /// # Errors
    /// Usage: a figure that the checkout does not have.
    pub fn figures<'a>(&self, all: &'a [Figure]) -> Result<Vec<MadeFigure<'a>>, Failure> {
        let made = |one: &Entry| {
            let figure = figure::find(all, &one.id)?;
            Ok(MadeFigure { figure, runs: one.runs.clone(), outputs: one.outputs.clone() })
        };
        self.figures.iter().map(made).collect()
    }
}
