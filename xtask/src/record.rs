//! Records of the inputs from which each figure was last made, and the reasons why a figure is stale.

use crate::measured::Measured;
use crate::pins::{CRATE, RUSTC};
use crate::sources::{Inputs, KEY, SourceHashes};
use crate::store;
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::hashing;
use checkout::outputs::{self, Hashes};
use checkout::paths::{Paths, Scheme};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// One figure as it was made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// One hash over all inputs.
    pub key: String,
    /// Every input with its hash.
    pub inputs: Inputs,
    /// Every output with its hash.
    pub outputs: Hashes,
    /// Hash of its program's report on accuracy; empty without a report.
    pub report: String,
    /// Its manifest entries, once its runs have been compared with their second runs.
    pub measured: Option<Measured>,
}

impl Record {
    /// A figure just made.
    pub fn new(inputs: Inputs, outputs: Hashes, report: String) -> Record {
        Record { key: hashing::digest(&inputs), inputs, outputs, report, measured: None }
    }
}

/// All figures as they were made, by folder of tables (which distinguishes the schemes).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Records {
    /// By the name of the folder of tables, `data/fig04`.
    pub figures: BTreeMap<String, Record>,
}

/// The file: the records with their sum, so that damage is noticed.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Sealed {
    sha256: String,
    #[serde(flatten)]
    records: Records,
}

fn sum(records: &Records) -> Result<String, Failure> {
    let text = serde_json::to_string(records).map_err(Failure::failed)?;
    Ok(files::write::sha256(text.as_bytes()))
}

impl Records {
    /// Reads the records. Without a file, or if it is malformed or not as it was written, there are none and everything
    /// counts as stale, since the errors and events in it would enter the manifest.
    ///
    /// # Errors
    /// Failed: the records cannot be serialised.
    pub fn read(paths: &Paths) -> Result<Records, Failure> {
        let sealed: Sealed = serde_json::from_str(&disk::read_own(&paths.state())).unwrap_or_default();
        let is_whole = sum(&sealed.records)? == sealed.sha256;
        Ok(if is_whole { sealed.records } else { Records::default() })
    }

    /// Writes the records.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, paths: &Paths) -> Result<(), Failure> {
        let sealed = Sealed { sha256: sum(self)?, records: self.clone() };
        let text = serde_json::to_string_pretty(&sealed).map_err(Failure::failed)?;
        disk::write_own(&paths.state(), text.as_bytes())
    }

    /// The record of a figure.
    pub fn get(&self, paths: &Paths, figure: &Figure) -> Option<&Record> {
        self.figures.get(&paths.tables(&figure.id))
    }
}

/// A figure, its present inputs, and the reasons why it is stale.
#[derive(Clone, Debug)]
pub struct FigureState<'a> {
    /// The figure.
    pub figure: &'a Figure,
    /// Its runs: panel and key.
    pub runs: Vec<(String, String)>,
    /// What it is made from now.
    pub inputs: Inputs,
    /// What it has now.
    pub outputs: Hashes,
    /// Why it is stale; empty when it is fresh.
    pub reasons: Vec<String>,
}

/// Compares each figure with its record.
///
/// # Errors
/// An output cannot be read.
pub fn survey<'a>(
    paths: &Paths,
    figures: &[&'a Figure],
    sources: &SourceHashes,
    records: &Records,
) -> Result<Vec<FigureState<'a>>, Failure> {
    let numeric = sources.numeric();
    let made = outputs::hash(paths, figures)?;
    let look = |(&figure, outputs): (&&'a Figure, Hashes)| {
        let runs = keys(paths, figure, &numeric);
        let inputs = sources.figure(figure, &runs);
        let record = records.get(paths, figure);
        let mut reasons = reasons(record, &inputs, &outputs);
        if let Some(record) = record.filter(|record| paths.scheme == Scheme::Adaptive && record.measured.is_none())
            && report(paths, figure)? != record.report
        {
            reasons.push("its stated accuracy differs from the record".to_owned());
        }
        Ok(FigureState { figure, runs, inputs, outputs, reasons })
    };
    figures.iter().zip(made).map(look).collect()
}

/// The hash of a program's report on accuracy; empty without a report.
///
/// # Errors
/// It cannot be read.
pub fn report(paths: &Paths, figure: &Figure) -> Result<String, Failure> {
    Ok(hashing::hash_all(&[paths.report(&figure.id)])?.swap_remove(0).unwrap_or_default())
}

/// The runs of a figure: panel and key.
pub fn keys(paths: &Paths, figure: &Figure, numeric: &str) -> Vec<(String, String)> {
    let key = |determinants: &str| store::key(determinants, numeric, paths.scheme);
    figure.runs().map(|panel| (panel.name.clone(), key(&panel.determinants()))).collect()
}

/// The scene under which a run's events are listed, by key: the first figure that has the run, and its panel.
pub fn scenes(paths: &Paths, all: &[Figure], numeric: &str) -> BTreeMap<String, String> {
    let mut scenes = BTreeMap::new();
    for figure in all {
        for (panel, key) in keys(paths, figure, numeric) {
            scenes.entry(key).or_insert_with(|| format!("{}-{panel}", figure.id));
        }
    }
    scenes
}

/// Why a figure is stale: each input and output that is not as recorded.
pub fn reasons(record: Option<&Record>, inputs: &Inputs, outputs: &Hashes) -> Vec<String> {
    let Some(record) = record else {
        return vec!["has not been made here yet".to_owned()];
    };
    let made_from = changes(&record.inputs, inputs, ["changed", "is gone", "is new"]);
    let made = changes(&record.outputs, outputs, ["was edited", "is missing", "was not made by the figure"]);
    let told = |(name, what): (&str, &str)| {
        let name_told = name.strip_prefix(KEY).or_else(|| name.strip_prefix(CRATE)).unwrap_or(name);
        format!("{} {name_told} {what}{}", kind(name), values(name, &record.inputs, inputs))
    };
    made_from
        .into_iter()
        .map(told)
        .chain(made.into_iter().map(|(name, what)| format!("output {name} {what}")))
        .collect()
}

/// Old and new value of an input that stands for itself; nothing for one that stands as a hash.
fn values(name: &str, old: &Inputs, new: &Inputs) -> String {
    if name != RUSTC && !name.starts_with(CRATE) && !name.starts_with(KEY) {
        return String::new();
    }
    match (old.get(name), new.get(name)) {
        (Some(old), Some(new)) => format!(": {old} -> {new}"),
        (Some(value), None) | (None, Some(value)) => format!(": {value}"),
        (None, None) => String::new(),
    }
}

/// The kind of input that a name denotes.
pub fn kind(name: &str) -> &'static str {
    match name {
        RUSTC => "toolchain",
        _ if name.starts_with(CRATE) => "crate",
        _ if name.starts_with(KEY) => "scene key",
        _ if name.starts_with("run ") => "key of",
        _ if name.ends_with("scene.toml") => "scene",
        _ if name.starts_with("data/") => "reference",
        _ => "source",
    }
}

/// Names whose hash is another one, or that stand on one side only, each with the word for it.
fn changes<'a>(old: &'a Inputs, new: &'a Inputs, words: [&'static str; 3]) -> Vec<(&'a str, &'static str)> {
    let names: BTreeSet<&String> = old.keys().chain(new.keys()).collect();
    let change = |name: &&'a String| match (old.get(*name), new.get(*name)) {
        (Some(before), Some(now)) => (before != now).then_some((name.as_str(), words[0])),
        (Some(_), None) => Some((name.as_str(), words[1])),
        _ => Some((name.as_str(), words[2])),
    };
    names.iter().filter_map(change).collect()
}
