//! A TOML document as a tree that keeps line numbers, and a reader that extracts typed values. Every error names file,
//! line, key, the value found and what would be valid.

use crate::text::hint_in;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::{Bound, RangeBounds};
use toml::de::{DeTable, DeValue};

/// Greater than zero.
pub const POSITIVE: (Bound<f64>, Bound<f64>) = (Bound::Excluded(0.0), Bound::Unbounded);
/// Zero or greater.
pub const NOT_NEGATIVE: (Bound<f64>, Bound<f64>) = (Bound::Included(0.0), Bound::Unbounded);
/// Any finite number.
pub const FINITE: (Bound<f64>, Bound<f64>) = (Bound::Unbounded, Bound::Unbounded);

/// What is wrong with a scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// The file as the user named it.
    pub file: String,
    /// The line, counted from 1; 0 when the whole file is meant.
    pub line: usize,
    /// What was found and what would be valid.
    pub problem: String,
    /// The key that is wrong, where it is one.
    pub about: Option<Box<About>>,
}

/// The key that a complaint is about, for programs that show it in their own way.
#[derive(Clone, Debug, PartialEq)]
pub struct About {
    /// The key with its table: `run.t_end`.
    pub key: String,
    /// The value found; `None` where the key is missing.
    pub value: Option<Value>,
    /// What would be valid, in words: `a number > 0.0`.
    pub allowed: Option<String>,
}

impl SceneError {
    /// A complaint about a line.
    pub fn new(file: &str, line: usize, problem: String) -> SceneError {
        SceneError { file: file.to_owned(), line, problem, about: None }
    }
}

impl std::fmt::Display for SceneError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.line {
            0 => write!(f, "{}: {}", self.file, self.problem),
            line => write!(f, "{}:{line}: {}", self.file, self.problem),
        }
    }
}

impl std::error::Error for SceneError {}

/// A value of the file and its line.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Line, counted from 1.
    pub line: usize,
    /// The position of the value: line and column in characters, both counted from 1; for a text, the first character
    /// after the quotation mark. Values that come from no file have an order only.
    pub place: (usize, usize),
    /// The value.
    pub value: Value,
}

impl Entry {
    /// A value that comes from no file, or of which only the line is known.
    pub fn new(line: usize, value: Value) -> Entry {
        Entry { line, place: (line, 0), value }
    }

    /// Value number `index` of those given by a caller, which come from no file.
    pub fn given(index: usize, value: Value) -> Entry {
        Entry { line: 0, place: (IN_NO_FILE + index, 1), value }
    }

    /// Whether the value comes from no file.
    pub fn is_in_no_file(&self) -> bool {
        self.line == 0
    }
}

/// No file has as many lines.
const IN_NO_FILE: usize = 1 << 31;

/// A value of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number; whole numbers too.
    Number(f64),
    /// A string.
    Text(String),
    /// `true` or `false`.
    Flag(bool),
    /// A table.
    Section(Section),
    /// A value of a type that no scene uses (boolean, array, date), as written in the file.
    Other(String),
}

/// A table of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// The line of its header, counted from 1.
    pub line: usize,
    /// Its entries by key.
    pub entries: BTreeMap<String, Entry>,
}

/// Whether the parser rejects a text and does not say where.
fn is_rejected_without_place(text: &str) -> bool {
    DeTable::parse(text).is_err_and(|error| error.span().is_none())
}

impl Section {
    /// Parses a TOML document; `file` is only for messages.
    ///
    /// # Errors
    /// The line and the parser's message when the text is not TOML, or a number is not an `f64`.
    pub fn parse(file: &str, text: &str) -> Result<Section, SceneError> {
        let fail = |line, problem| SceneError::new(file, line, problem);
        let table = DeTable::parse(text).map_err(|error| {
            let line = match error.span() {
                Some(span) => line_of(text, span.start),
                // keys nested too deep: the parser does not say where, but says the same of that line alone
                None => text.lines().position(is_rejected_without_place).map_or(0, |index| index + 1),
            };
            let said = text.lines().nth(line.wrapping_sub(1)).map(str::trim);
            let hint = match said {
                Some(said) if error.message() == "duplicate key" => Some(format!("{said}; each key must occur once")),
                said => said.and_then(hint_in),
            };
            fail(line, format!("{}{}", error.message(), hint.map_or(String::new(), |hint| format!(": {hint}"))))
        })?;
        section(text, table.get_ref(), 1).map_err(|(line, problem)| fail(line, problem))
    }

    /// Lays `over` on top: its values replace equal keys, tables are merged key by key.
    pub fn overlay(&mut self, over: &Section) {
        for (key, entry) in &over.entries {
            match (self.entries.get_mut(key), &entry.value) {
                (Some(Entry { value: Value::Section(below), .. }), Value::Section(above)) => below.overlay(above),
                _ => {
                    self.entries.insert(key.clone(), entry.clone());
                }
            }
        }
    }

    /// The table under `key`, if there is one.
    pub fn section(&self, key: &str) -> Option<&Section> {
        match &self.entries.get(key)?.value {
            Value::Section(section) => Some(section),
            _ => None,
        }
    }

    /// Every value with its dotted key, sorted: the text that identifies a scene. Numbers in shortest form.
    pub fn canonical(&self, prefix: &str, lines: &mut Vec<String>) {
        for (key, entry) in &self.entries {
            let name = format!("{prefix}{key}");
            match &entry.value {
                Value::Number(number) => lines.push(format!("{name} = {number:?}")),
                Value::Text(text) => lines.push(format!("{name} = {text:?}")),
                Value::Flag(flag) => lines.push(format!("{name} = {flag}")),
                Value::Other(text) => lines.push(format!("{name} = {text}")),
                Value::Section(section) => section.canonical(&format!("{name}."), lines),
            }
        }
    }
}

fn section(text: &str, table: &DeTable<'_>, line: usize) -> Result<Section, (usize, String)> {
    let mut entries = BTreeMap::new();
    for (key, value) in table {
        let line = line_of(text, key.span().start);
        let place = place_of(text, value.span().start);
        let value = match value.get_ref() {
            DeValue::Integer(digits) => Value::Number(whole(digits.as_str(), digits.radix(), line)?),
            DeValue::Float(digits) => {
                Value::Number(digits.as_str().parse().map_err(|_| not_a_number(digits.as_str(), line))?)
            }
            DeValue::String(words) => Value::Text(words.to_string()),
            DeValue::Table(inner) => Value::Section(section(text, inner, line)?),
            DeValue::Boolean(flag) => Value::Flag(*flag),
            DeValue::Datetime(_) | DeValue::Array(_) => Value::Other(value.get_ref().type_str().to_owned()),
        };
        entries.insert(key.get_ref().to_string(), Entry { line, place, value });
    }
    Ok(Section { line, entries })
}

fn whole(digits: &str, radix: u32, line: usize) -> Result<f64, (usize, String)> {
    let number = i64::from_str_radix(digits, radix).map_err(|_| not_a_number(digits, line))?;
    let nearest = number as f64;
    // the largest i64 rounds up to a double that i64 cannot hold
    if nearest as i128 == i128::from(number) {
        Ok(nearest)
    } else {
        let problem =
            format!("{digits} is a whole number that a double cannot represent; the nearest is {}", nearest as i128);
        Err((line, problem))
    }
}

fn not_a_number(digits: &str, line: usize) -> (usize, String) {
    (line, format!("{digits} is not a number that fits"))
}

/// Line and column of a value; a text begins behind its quotation marks.
fn place_of(text: &str, offset: usize) -> (usize, usize) {
    let rest = &text[offset.min(text.len())..];
    let quotes = ["\"\"\"", "'''", "\"", "'"].iter().find(|quotes| rest.starts_with(**quotes));
    let start = offset + quotes.map_or(0, |quotes| quotes.len());
    let before = &text[..start.min(text.len())];
    let column = before.rsplit('\n').next().map_or(0, |line| line.chars().count());
    (line_of(text, start), column + 1)
}

fn line_of(text: &str, offset: usize) -> usize {
    1 + text.as_bytes()[..offset.min(text.len())].iter().filter(|&&byte| byte == b'\n').count()
}

/// Takes typed values from one table and at the end complains about keys that nothing asked for.
#[derive(Debug)]
pub struct Reader<'a> {
    file: &'a str,
    name: &'a str,
    section: &'a Section,
    asked: BTreeSet<&'static str>,
}

impl<'a> Reader<'a> {
    /// A reader of `section`, which the messages call `name` (`"law"`).
    pub fn new(file: &'a str, name: &'a str, section: &'a Section) -> Reader<'a> {
        Reader { file, name, section, asked: BTreeSet::new() }
    }

    /// Whether the table has this key, which counts as known from now on.
    pub fn has(&mut self, key: &'static str) -> bool {
        self.asked.insert(key);
        self.section.entries.contains_key(key)
    }

    /// Whether this key has a number; the key counts as known from now on.
    pub fn is_number(&mut self, key: &'static str) -> bool {
        self.has(key) && matches!(self.section.entries[key].value, Value::Number(_))
    }

    /// The number under `key`, which must lie in `range` and must not be missing.
    ///
    /// # Errors
    /// Missing, not a number, not finite, or out of range.
    pub fn number(&mut self, key: &'static str, range: impl RangeBounds<f64>) -> Result<f64, SceneError> {
        let wanted = describe(&range);
        match self.optional_number(key, range)? {
            Some(number) => Ok(number),
            None => Err(self.missing(key, &wanted)),
        }
    }

    /// The number under `key` if it is there, which must lie in `range`.
    ///
    /// # Errors
    /// Not a number, not finite, or out of range.
    pub fn optional_number(
        &mut self,
        key: &'static str,
        range: impl RangeBounds<f64>,
    ) -> Result<Option<f64>, SceneError> {
        self.asked.insert(key);
        match self.section.entries.get(key) {
            None => Ok(None),
            Some(Entry { value: Value::Number(number), .. }) if number.is_finite() && range.contains(number) => {
                Ok(Some(*number))
            }
            Some(entry) => Err(self.wrong(key, entry, &describe(&range))),
        }
    }

    /// The whole number under `key`, from `low` to `high`.
    ///
    /// # Errors
    /// Missing, not a whole number, or out of range.
    pub fn count(&mut self, key: &'static str, low: usize, high: usize) -> Result<usize, SceneError> {
        self.asked.insert(key);
        let wanted = format!("a whole number from {low} to {high}");
        match self.section.entries.get(key) {
            None => Err(self.missing(key, &wanted)),
            Some(Entry { value: Value::Number(number), .. })
                // the cast takes what is too large to the largest count, and what is negative to 0
                if number.fract() == 0.0 && *number >= 0.0 && (low..=high).contains(&(*number as usize)) =>
            {
                Ok(*number as usize)
            }
            Some(entry) => Err(self.wrong(key, entry, &wanted)),
        }
    }

    /// The text under `key`, which must be one of `choices`.
    ///
    /// # Errors
    /// Missing, not a text, or none of the choices.
    pub fn choice(&mut self, key: &'static str, choices: &[&'static str]) -> Result<&'static str, SceneError> {
        self.asked.insert(key);
        let wanted = format!("one of {}", choices.join(", "));
        match self.section.entries.get(key) {
            None => Err(self.missing(key, &wanted)),
            Some(entry) => match &entry.value {
                Value::Text(text) => choices
                    .iter()
                    .find(|&&choice| choice == text)
                    .copied()
                    .ok_or_else(|| self.wrong(key, entry, &wanted)),
                _ => Err(self.wrong(key, entry, &wanted)),
            },
        }
    }

    /// What the text under `key` names, which must be one of these names.
    ///
    /// # Errors
    /// Missing, not a text, or none of the names.
    pub fn one_of<T: Copy>(&mut self, key: &'static str, choices: &[(&'static str, T)]) -> Result<T, SceneError> {
        let names: Vec<&'static str> = choices.iter().map(|choice| choice.0).collect();
        let name = self.choice(key, &names)?;
        let named = choices.iter().find(|choice| choice.0 == name).map(|choice| choice.1);
        named.ok_or_else(|| self.missing(key, &names.join(", ")))
    }

    /// `true` or `false` under `key`.
    ///
    /// # Errors
    /// Missing, or neither.
    pub fn flag(&mut self, key: &'static str) -> Result<bool, SceneError> {
        self.asked.insert(key);
        match self.section.entries.get(key) {
            None => Err(self.missing(key, "true or false")),
            Some(Entry { value: Value::Flag(flag), .. }) => Ok(*flag),
            Some(entry) => Err(self.wrong(key, entry, "true or false")),
        }
    }

    /// The text under `key`, which the message calls `wanted`.
    ///
    /// # Errors
    /// Missing, or not a text.
    pub fn text(&mut self, key: &'static str, wanted: &str) -> Result<&'a str, SceneError> {
        self.asked.insert(key);
        match self.section.entries.get(key) {
            None => Err(self.missing(key, wanted)),
            Some(Entry { value: Value::Text(text), .. }) => Ok(text),
            Some(entry) => Err(self.wrong(key, entry, wanted)),
        }
    }

    /// The table under `key`.
    ///
    /// # Errors
    /// Missing, or not a table.
    pub fn section(&mut self, key: &'static str) -> Result<&'a Section, SceneError> {
        self.asked.insert(key);
        match self.section.entries.get(key) {
            None => Err(self.missing(key, "a table")),
            Some(Entry { value: Value::Section(section), .. }) => Ok(section),
            Some(entry) => Err(self.wrong(key, entry, "a table")),
        }
    }

    /// The error that `key` has a value which is valid in general but not here. The part of `problem` after "must be"
    /// states what would be valid.
    pub fn complaint(&self, key: &str, problem: &str) -> SceneError {
        let entry = self.section.entries.get(key);
        let line = entry.map_or(self.section.line, |entry| entry.line);
        let found = entry.map_or(String::new(), |entry| format!(" = {}", shown(&entry.value)));
        let allowed = problem.split_once("must be ").map(|(_, allowed)| allowed);
        self.error(line, key, format!("{found}: {problem}"), allowed)
    }

    /// Ends the reading.
    ///
    /// # Errors
    /// A key that nothing asked for; the message lists those that are known.
    pub fn finish(self) -> Result<(), SceneError> {
        match self.section.entries.iter().find(|(key, _)| !self.asked.contains(key.as_str())) {
            None => Ok(()),
            Some((key, entry)) => {
                let known = self.asked.iter().copied().collect::<Vec<&str>>().join(", ");
                Err(self.error(entry.line, key, format!(": unknown key; known here: {known}"), Some(&known)))
            }
        }
    }

    fn missing(&self, key: &str, wanted: &str) -> SceneError {
        let others: Vec<&str> = self.section.entries.keys().map(String::as_str).collect();
        let found = if others.is_empty() { String::new() } else { format!("; found here: {}", others.join(", ")) };
        self.error(self.section.line, key, format!(" is missing; it must be {wanted}{found}"), Some(wanted))
    }

    fn wrong(&self, key: &str, entry: &Entry, wanted: &str) -> SceneError {
        self.error(entry.line, key, format!(" = {}: must be {wanted}", shown(&entry.value)), Some(wanted))
    }

    /// `words` follow the key.
    fn error(&self, line: usize, key: &str, words: String, allowed: Option<&str>) -> SceneError {
        // a scene itself has no name in its file
        let name = if self.name == "scene" { key.to_owned() } else { format!("{}.{key}", self.name) };
        let value = self.section.entries.get(key).map(|entry| entry.value.clone());
        let about = About { key: name, value, allowed: allowed.map(str::to_owned) };
        let problem = format!("{}.{key}{words}", self.name);
        SceneError { about: Some(Box::new(about)), ..SceneError::new(self.file, line, problem) }
    }
}

fn shown(value: &Value) -> String {
    match value {
        Value::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => format!("{number}"),
        Value::Number(number) => format!("{number:?}"),
        Value::Text(text) => format!("{text:?}"),
        Value::Section(_) => "a table".to_owned(),
        Value::Flag(_) => "a value of type boolean".to_owned(),
        Value::Other(kind) => format!("a value of type {kind}"),
    }
}

/// A range in words.
fn describe(range: &impl RangeBounds<f64>) -> String {
    let low = match range.start_bound() {
        Bound::Included(low) => format!(" >= {low:?}"),
        Bound::Excluded(low) => format!(" > {low:?}"),
        Bound::Unbounded => String::new(),
    };
    let high = match range.end_bound() {
        Bound::Included(high) => format!(" <= {high:?}"),
        Bound::Excluded(high) => format!(" < {high:?}"),
        Bound::Unbounded => String::new(),
    };
    match (low.is_empty(), high.is_empty()) {
        (true, true) => "a finite number".to_owned(),
        (false, false) => format!("a number{low} and{high}"),
        _ => format!("a number{low}{high}"),
    }
}
