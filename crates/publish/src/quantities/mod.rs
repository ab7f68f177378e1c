//! The numbers in the article, each with a name, its source and its written form. This is the only place that collects
//! them; the article reads `paper/numbers.json`, and LaTeX reads `paper/numbers.tex`.

mod accuracy;
pub mod form;
mod ledger;
mod measured;
mod published;
mod runs;
mod scenes;

use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::manifest;
use checkout::paths::Paths;
use files::table::{CellValue, Grid, MixedTable};
use form::Form;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// One number.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The number; `None` for a word, such as the name of a method.
    pub value: Option<f64>,
    /// The estimate of its error, in the same unit.
    pub error: Option<f64>,
    /// How it is written.
    pub form: Form,
    /// Where it comes from: a file of the checkout, and what in it.
    pub from: String,
}

/// Numbers by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Quantities {
    /// Sorted by name.
    pub by_name: BTreeMap<String, Quantity>,
}

/// What the numbers are collected from.
pub struct Source<'a> {
    /// The checkout.
    pub paths: &'a Paths,
    /// All its figures.
    pub figures: &'a [Figure],
    /// What is known of each output.
    pub manifest: BTreeMap<String, manifest::Entry>,
}

/// A table of the checkout.
///
/// # Errors
/// Stale: there is no such table. Failed: it cannot be read.
fn table<V: files::table::Value>(paths: &Paths, name: &str) -> Result<Grid<V>, Failure> {
    let path = paths.root.join(name);
    match path.is_file() {
        true => Grid::read(&path).map_err(Failure::failed),
        false => Err(Failure::Stale(format!("{name}: no such table; cargo xtask figures --all"))),
    }
}

/// The numbers of a column, from top to bottom.
///
/// # Errors
/// Failed: there is no such column.
fn numbers(sheet: &MixedTable, column: &str) -> Result<Vec<f64>, Failure> {
    let cells = sheet.column(column).map_err(Failure::failed)?;
    Ok(cells.iter().filter_map(CellValue::number).collect())
}

/// The largest of numbers, of which there must be one.
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().copied().max_by(f64::total_cmp).unwrap_or(f64::NAN)
}

/// The least of numbers, of which there must be one.
fn least(numbers: &[f64]) -> f64 {
    numbers.iter().copied().min_by(f64::total_cmp).unwrap_or(f64::NAN)
}

impl Quantities {
    /// Collects all numbers from scenes, tables and manifest.
    ///
    /// # Errors
    /// Stale: a table is missing. Usage: a table lacks a column or a row. Otherwise what kept a file from being read.
    pub fn collect(paths: &Paths, figures: &[Figure]) -> Result<Quantities, Failure> {
        let source = Source { paths, figures, manifest: manifest::read(paths)? };
        let mut all = Quantities::default();
        scenes::collect(&source, &mut all);
        runs::collect(&source, &mut all)?;
        published::collect(&source, &mut all)?;
        accuracy::collect(&source, &mut all)?;
        measured::collect(&source, &mut all)?;
        ledger::collect(&source, &mut all)?;
        Ok(all)
    }

    /// Adds a number with all its digits.
    pub fn exact(&mut self, name: &str, value: f64, from: &str) {
        self.add(name, Some(value), None, Form::exact(value), from);
    }

    /// Adds a number rounded to `digits` significant digits.
    pub fn rounded(&mut self, name: &str, value: f64, digits: usize, from: &str) {
        self.add(name, Some(value), None, Form::rounded(value, digits), from);
    }

    /// Adds a number rounded where its error begins.
    pub fn uncertain(&mut self, name: &str, value: f64, error: f64, from: &str) {
        self.add(name, Some(value), Some(error), Form::uncertain(value, error), from);
    }

    /// Adds a word.
    pub fn word(&mut self, name: &str, word: &str, from: &str) {
        self.add(name, None, None, Form::plain(word.to_owned()), from);
    }

    fn add(&mut self, name: &str, value: Option<f64>, error: Option<f64>, form: Form, from: &str) {
        self.by_name.insert(name.to_owned(), Quantity { value, error, form, from: from.to_owned() });
    }

    /// The numbers as JSON, a line for each.
    ///
    /// # Errors
    /// A number is not finite.
    pub fn to_json(&self) -> Result<String, Failure> {
        let mut lines = Vec::new();
        for (name, quantity) in &self.by_name {
            let mut entry = Map::new();
            entry.insert("from".to_owned(), quantity.from.clone().into());
            entry.insert("mantissa".to_owned(), quantity.form.mantissa.clone().into());
            let optional = [("value", quantity.value), ("error", quantity.error)];
            for (key, number) in optional.iter().filter_map(|(key, number)| Some((key, (*number)?))) {
                let number = serde_json::Number::from_f64(number);
                let number = number.ok_or_else(|| Failure::Failed(format!("number {name}: {key} is not finite")))?;
                entry.insert((*key).to_owned(), Value::Number(number));
            }
            entry.extend(quantity.form.exponent.map(|exponent| ("exponent".to_owned(), exponent.into())));
            lines.push(format!("    {}: {}", json!(name), Value::Object(entry)));
        }
        Ok(format!("{{\n  \"schema_version\": 1,\n  \"numbers\": {{\n{}\n  }}\n}}\n", lines.join(",\n")))
    }

    /// The numbers as LaTeX macros: `\jamnumber{NAME}`.
    pub fn to_tex(&self) -> String {
        let mut text = TEX_HEAD.to_owned();
        for (name, quantity) in &self.by_name {
            let body = if quantity.value.is_some() { quantity.form.to_tex() } else { quantity.form.mantissa.clone() };
            text.push_str(&format!("\\expandafter\\def\\csname jam:{name}\\endcsname{{{body}}}% {}\n", quantity.from));
        }
        text
    }
}

/// What stands before the macros.
const TEX_HEAD: &str = "% The numbers of the report, written by `cargo xtask paper --bless`; do not edit.
% \\input this file, then \\jamnumber{NAME} is the number, in text or in mathematics. Behind each: where it comes from.
\\newcommand*{\\jamnumber}[1]{\\ifcsname jam:#1\\endcsname\\csname jam:#1\\endcsname\\else\\errmessage{no number #1}\\fi}
";
