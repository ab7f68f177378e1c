//! `[law]`: kind and parameters. A term without a named parameter is not computed.

use files::reader::{About, Entry, NOT_NEGATIVE, POSITIVE, Reader, SceneError, Section, Value};
use formula::{Definition, Given, Location};
use jam::laws::presets::PRESETS;
use jam::laws::{Algebraic, Exponential, Formula, Law, Logarithmic, Model, Range};

/// Reads `[law]`.
///
/// # Errors
/// An unknown kind, preset or key, or a parameter out of its range; of a formula whatever is wrong, with its column.
pub fn read(file: &str, section: &Section) -> Result<Model, SceneError> {
    let mut law = Reader::new(file, "law", section);
    let model = match law.one_of("kind", &KINDS)? {
        Kind::Algebraic if law.has("preset") => Model::Algebraic(preset(&mut law)?),
        Kind::Algebraic => Model::Algebraic(parameters(&mut law, &[])?),
        Kind::Exponential => Model::Exponential(parameters(&mut law, &[])?),
        Kind::Logarithmic => Model::Logarithmic(parameters(&mut law, &[])?),
        Kind::Formula => return formula(file, section),
    };
    law.finish()?;
    Ok(model)
}

/// The kinds of laws.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Algebraic,
    Exponential,
    Logarithmic,
    Formula,
}

/// Their names.
const KINDS: [(&str, Kind); 4] = [
    ("algebraic", Kind::Algebraic),
    ("exponential", Kind::Exponential),
    ("logarithmic", Kind::Logarithmic),
    ("formula", Kind::Formula),
];

/// The law of `[law]` with arbitrary values, if it is one of the paper, so that its parameters are known before it is
/// read.
pub fn built_in(section: &Section) -> Option<Model> {
    let Value::Text(kind) = &section.entries.get("kind")?.value else { return None };
    match KINDS.iter().find(|(name, _)| name == kind)?.1 {
        Kind::Algebraic => Some(Model::Algebraic(Algebraic::default())),
        Kind::Exponential => Some(Model::Exponential(Exponential::default())),
        Kind::Logarithmic => Some(Model::Logarithmic(Logarithmic::default())),
        Kind::Formula => None,
    }
}

/// The parameters of a law, as its file lists them. Those that are `fixed` to a value must not be given, those fixed to
/// none must.
fn parameters<L: Law>(reader: &mut Reader<'_>, fixed: &[(&str, Option<f64>)]) -> Result<L, SceneError> {
    let mut law = L::default();
    for parameter in L::PARAMETERS {
        let range = match parameter.range {
            Range::Positive => POSITIVE,
            Range::NotNegative => NOT_NEGATIVE,
        };
        let fixed = fixed.iter().find(|(name, _)| *name == parameter.name).map(|(_, value)| *value);
        *(parameter.place)(&mut law) = match (fixed, parameter.default) {
            (Some(Some(value)), _) => value,
            (None, Some(default)) => reader.optional_number(parameter.name, range)?.unwrap_or(default),
            _ => reader.number(parameter.name, range)?,
        };
    }
    Ok(law)
}

/// A model of tab:model; the parameters that it leaves open must be given, the others must not.
fn preset(law: &mut Reader<'_>) -> Result<Algebraic, SceneError> {
    let preset = law.one_of("preset", &PRESETS.map(|preset| (preset.name, preset)))?;
    let (delta, q) = (Some(preset.delta), Some(preset.q));
    parameters(law, &[("mu", preset.mu), ("delta", delta), ("q", q), ("a_v", preset.a_v)])
}

/// A law as formulas: every key but `kind` is a parameter or an expression.
fn formula(file: &str, section: &Section) -> Result<Model, SceneError> {
    let mut lines: Vec<(&String, &Entry)> = section.entries.iter().filter(|(name, _)| *name != "kind").collect();
    lines.sort_by_key(|(_, entry)| entry.place);
    let mut definitions = Vec::new();
    for &(name, entry) in &lines {
        let given = match &entry.value {
            Value::Number(number) => Given::Number(*number),
            Value::Text(text) => Given::Text(text),
            Value::Section(_) | Value::Flag(_) | Value::Other(_) => {
                let law = Reader::new(file, "law", section);
                return Err(law.complaint(name, "must be a number or an expression in quotation marks"));
            }
        };
        // a key stands on the line of its value
        let (key, value) = (place(entry.place.0, 1), place(entry.place.0, entry.place.1));
        definitions.push(Definition { name, key, value, given });
    }
    let graph = formula::law(file, place(section.line, 1), &definitions);
    let law = graph.and_then(Formula::new).map_err(|error| {
        let line = error.place.line as usize;
        let problem = format!("column {}: {}; valid: {}", error.place.column, error.found, error.valid);
        // the last that begins no later than the error
        let entry = lines.iter().rev().find(|(_, entry)| entry.place.0 <= line);
        let about = entry.map(|(name, entry)| {
            let (key, value) = (format!("law.{name}"), Some(entry.value.clone()));
            Box::new(About { key, value, allowed: Some(error.valid) })
        });
        let line = if entry.is_some_and(|(_, entry)| entry.is_in_no_file()) { 0 } else { line };
        SceneError { about, ..SceneError::new(file, line, problem) }
    })?;
    Ok(Model::Formula(law))
}

fn place(line: usize, column: usize) -> Location {
    Location { line: line as u32, column: column as u32 }
}
